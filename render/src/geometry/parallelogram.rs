//! Parallelograms. As lights, they are a corner and the edges from there.

use super::bounds::bounds_of;
use super::flat::{Edged, coordinates, sample_picture};
use super::form::{Chart, Extent, Form, projected, wide};
use super::points::{Points, on_plane};
use super::spread::Spread;
use crate::packet::{V8, X8};
use crate::technique::Measure;
use etendue::light::{self, Picture};
use etendue::{LightSample, LightSampler, Vec2, Vec3};
use etendue_visible::{Occluder, Solid};

/// The parallelogram `p + s u + t v` for s, t in \[0,1\]; the normal is u × v.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parallelogram {
    /// One corner.
    pub p: [f32; 3],
    /// First edge from that corner.
    pub u: [f32; 3],
    /// Second edge from that corner.
    pub v: [f32; 3],
}

impl Parallelogram {
    /// The light with these vectors.
    #[inline(always)]
    pub(crate) fn light([corner, edge_s, edge_t]: [V8; 3]) -> light::Parallelogram<X8> {
        light::Parallelogram { corner, edge_s, edge_t }
    }
    /// The parallelogram in all lanes.
    #[inline(always)]
    fn splat(&self) -> light::Parallelogram<X8> {
        Self::light(self.vectors().map(V8::from))
    }
}

impl Form for Parallelogram {
    type Hittable = Edged<false>;
    const CHART: Option<Chart> = Some(Chart::Parallelogram);
    const SHARE: f64 = 4.0;

    fn bounds(&self) -> [[f32; 3]; 2] {
        let Self { p, u, v } = *self;
        let add = |a: [f32; 3], b: [f32; 3]| std::array::from_fn(|k| a[k] + b[k]);
        bounds_of(&[p, add(p, u), add(p, v), add(add(p, u), v)])
    }
    fn area(&self) -> f64 {
        wide(self.u).cross(wide(self.v)).length()
    }
    fn plane(&self) -> Option<[Vec3<f64>; 2]> {
        Some([wide(self.p), wide(self.u).cross(wide(self.v)).normalize()])
    }
    fn middle(&self) -> Vec3<f64> {
        let [u, v] = self.halves(Vec3::default());
        wide(self.p) + u + v
    }
    fn halves(&self, _direction: Vec3<f64>) -> [Vec3<f64>; 2] {
        [wide(self.u) * 0.5, wide(self.v) * 0.5]
    }
    fn hittable(&self) -> Self::Hittable {
        Edged::new(self.p, wide(self.u), wide(self.v))
    }
    fn points(&self, rays: [V8; 2], _distance: X8, reach: f32) -> Points {
        on_plane(self.plane().unwrap_or_default(), rays, reach)
    }
    fn vectors(&self) -> [[f32; 3]; 3] {
        [self.p, self.u, self.v]
    }
    fn extent([p, u, v]: [Vec3<f64>; 3]) -> Extent {
        let radius = 0.5 * (u + v).length().max((u - v).length());
        Extent { center: p + (u + v) * 0.5, radius, normal: u.cross(v) }
    }
    #[inline]
    fn sample<D: From<LightSample<X8>>>(vectors: [V8; 3], measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> D {
        let light = Self::light(vectors);
        match measure {
            Measure::Area => light.by_area(p).sample(u).into(),
            Measure::SolidAngle => light.by_solid_angle(p).sample(u).into(),
            Measure::Projected => projected(|| light.by_projected_solid_angle(p, normal).sample(u).into()),
        }
    }
    #[inline]
    fn pdf(&self, spread: Option<Spread<f32>>, p: V8, w: V8) -> X8 {
        let mut light = self.splat();
        if let Some(spread) = spread {
            light = spread.splat().visible_part(&light, p);
        }
        light.by_solid_angle(p).pdf_of_hit(w)
    }
    #[inline]
    fn coordinates(&self, point: V8) -> Vec2<X8> {
        coordinates(self.p, wide(self.u), wide(self.v), point)
    }
    fn sample_picture(
        &self,
        picture: &Picture<'_>,
        _axes: &[[f32; 3]; 3],
        measure: Measure,
        place: [V8; 2],
        u: Vec2<X8>,
    ) -> LightSample<X8> {
        sample_picture(picture, self.splat(), measure, place, u)
    }
    fn pdf_of_picture(&self, picture: &Picture<'_>, _axes: &[[f32; 3]; 3], p: V8, w: V8) -> X8 {
        picture.on(self.splat()).by_solid_angle(p).pdf(w)
    }
    /// It keeps its edges, as samplers and rays have them.
    fn outline(&self) -> Occluder<'static> {
        Occluder::Whole(Solid::Parallelogram { corner: wide(self.p), edges: [wide(self.u), wide(self.v)] })
    }
}
