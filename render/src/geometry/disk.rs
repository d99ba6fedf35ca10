//! Disks. As lights, they are the centre, the normal, and the radius in x of the third vector.
//!
//! They are sampled by solid angle also where projected solid angle is asked for, show the mean of a picture, and have no closed forms:
//! these take them for the squares around them.

use super::ends::Segment;
use super::flat::Plane;
use super::form::{Approach, Extent, Form, Hittable, Meeting, wide};
use super::points::{Points, on_plane};
use super::spread::Spread;
use crate::packet::{M8, V8, X8};
use crate::technique::Measure;
use etendue::light;
use etendue::{Frame, LightSample, LightSampler, Real, Vec2, Vec3};
use etendue_visible::{Occluder, Solid};
use std::f64::consts::PI;

/// A disk that emits from the side of its normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disk {
    /// Centre.
    pub center: [f32; 3],
    /// Unit normal.
    pub normal: [f32; 3],
    /// Radius, greater than 0.
    pub radius: f32,
}

impl Disk {
    /// The light with these vectors.
    #[inline(always)]
    fn light([center, normal, radius]: [V8; 3]) -> light::Disk<X8> {
        light::Disk { center, normal, radius: radius.x }
    }
    /// The unit normal in double precision.
    fn axis(&self) -> Vec3<f64> {
        wide(self.normal).normalize()
    }
}

impl Form for Disk {
    type Hittable = Round;
    const SHARE: f64 = PI;

    fn bounds(&self) -> [[f32; 3]; 2] {
        let Vec3 { x, y, z } = self.axis();
        let half = [x, y, z].map(|n| f64::from(self.radius) * (1.0 - n * n).max(0.0).sqrt());
        [-1.0, 1.0].map(|side| std::array::from_fn(|k| (f64::from(self.center[k]) + side * half[k]) as f32))
    }
    fn area(&self) -> f64 {
        PI * f64::from(self.radius).powi(2)
    }
    fn plane(&self) -> Option<[Vec3<f64>; 2]> {
        Some([wide(self.center), self.axis()])
    }
    fn middle(&self) -> Vec3<f64> {
        wide(self.center)
    }
    fn halves(&self, _direction: Vec3<f64>) -> [Vec3<f64>; 2] {
        let (frame, radius) = (Frame::new(self.axis()), f64::from(self.radius));
        [frame.s * radius, frame.t * radius]
    }
    fn hittable(&self) -> Round {
        Round { plane: Plane::new(self.center, self.axis(), 2.0 * f64::from(self.radius)), radius: self.radius }
    }
    fn points(&self, rays: [V8; 2], _distance: X8, reach: f32) -> Points {
        on_plane([wide(self.center), self.axis()], rays, reach)
    }
    fn vectors(&self) -> [[f32; 3]; 3] {
        [self.center, self.normal, [self.radius, 0.0, 0.0]]
    }
    fn extent([center, normal, radius]: [Vec3<f64>; 3]) -> Extent {
        Extent { center, radius: radius.x, normal }
    }
    #[inline(always)]
    fn normals([_, normal, _]: [V8; 3]) -> V8 {
        normal
    }
    #[inline]
    fn sample<D: From<LightSample<X8>>>(vectors: [V8; 3], measure: Measure, p: V8, _normal: V8, u: Vec2<X8>) -> D {
        let light = Self::light(vectors);
        match measure {
            Measure::Area => light.by_area(p).sample(u).into(),
            Measure::SolidAngle | Measure::Projected => light.by_solid_angle(p).sample(u).into(),
        }
    }
    #[inline]
    fn pdf(&self, _spread: Option<Spread<f32>>, p: V8, w: V8) -> X8 {
        Self::light(self.vectors().map(V8::from)).by_solid_angle(p).pdf_of_hit(w)
    }
    fn outline(&self) -> Occluder<'static> {
        // wider than the rounding of its corners
        let (center, radius) = (self.middle(), f64::from(self.radius));
        let wider = 1.0 + 1e-6 * (1.0 + center.max_abs() / radius);
        let [s, t] = self.halves(center).map(|half| half * wider);
        let narrow = |v: Vec3<f64>| v.map(|x| f64::from(x as f32));
        Occluder::Within(Solid::Parallelogram { corner: narrow(center - s - t), edges: [narrow(s + s), narrow(t + t)] })
    }
}

/// A disk, prepared for rays.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Round {
    plane: Plane,
    radius: f32,
}

impl Hittable for Round {
    #[inline(always)]
    fn meet<const ANY: bool>(&self, rays: &Approach<'_>) -> Meeting {
        let square = X8::splat(self.radius * self.radius);
        self.plane.meet::<ANY>(rays, |from_center| from_center.length_squared().le(square))
    }
    #[inline]
    fn fronts(&self, [_, direction]: [V8; 2], _distance: X8) -> M8 {
        self.plane.fronts(direction)
    }
    fn reached_by(&self, segment: Segment) -> Segment {
        self.plane.reached_by(segment)
    }
}
