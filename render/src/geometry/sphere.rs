//! Spheres. As lights, they are the centre, and the radius in x of the second vector.

use super::ends::Segment;
use super::form::{Approach, Chart, Extent, Form, Hittable, Meeting, NEAR, wide};
use super::points::{D8, Points, each, facing, lifted, unit, zero};
use super::spread::Spread;
use crate::packet::{M8, V8, X8, widen};
use crate::technique::Measure;
use etendue::light::{self, Picture};
use etendue::{Frame, LightSample, LightSampler, Mask, Real, Vec2, Vec3, f64x8};
use etendue_visible::{Occluder, Solid};
use std::f64::consts::PI;
use std::ops::RangeInclusive;

/// The radii of spheres whose squares are normal numbers in single precision. Others are met in double precision.
const SINGLE: RangeInclusive<f32> = 1.0 / (1_u64 << 40) as f32..=(1_u64 << 40) as f32;

/// Rays from a sphere whose way to the height of its centre is negative by more than this part of the radius surely leave it.
const LEAVES: f32 = 1.0 / 65_536.0;

/// A whole sphere; its normal points outwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre.
    pub center: [f32; 3],
    /// Radius, greater than 0.
    pub radius: f32,
}

impl Sphere {
    /// The light with these vectors.
    #[inline(always)]
    pub(crate) fn light([center, radius, _]: [V8; 3]) -> light::Sphere<X8> {
        light::Sphere { center, radius: radius.x }
    }
    /// Lanes of points inside of the spheres.
    #[inline(always)]
    fn contains(light: &light::Sphere<X8>, p: V8) -> M8 {
        (light.center - p).length_squared().lt(light.radius * light.radius)
    }
    /// The sphere about the points `p`, in the axes of a picture.
    #[inline]
    fn in_axes(&self, axes: &[[f32; 3]; 3], p: V8) -> light::Sphere<X8> {
        light::Sphere::new(inwards(axes, V8::from(self.center) - p), X8::splat(self.radius))
    }
}

impl Form for Sphere {
    type Hittable = Self;
    const CHART: Option<Chart> = Some(Chart::Sphere);
    const SILHOUETTE: f64 = 0.25;
    const SHARE: f64 = PI;

    fn bounds(&self) -> [[f32; 3]; 2] {
        [self.center.map(|x| x - self.radius), self.center.map(|x| x + self.radius)]
    }
    fn area(&self) -> f64 {
        4.0 * PI * f64::from(self.radius).powi(2)
    }
    fn plane(&self) -> Option<[Vec3<f64>; 2]> {
        None
    }
    fn middle(&self) -> Vec3<f64> {
        wide(self.center)
    }
    fn halves(&self, direction: Vec3<f64>) -> [Vec3<f64>; 2] {
        across(direction, f64::from(self.radius))
    }
    fn hittable(&self) -> Self {
        *self
    }
    #[cfg(feature = "analytic")]
    #[inline(always)]
    fn outwards(&self, points: V8) -> V8 {
        points - V8::from(self.center)
    }
    #[inline(always)]
    fn outward_at(&self, [origin, direction]: [V8; 2], distance: X8) -> V8 {
        direction.mul_add(distance, origin - V8::from(self.center)).normalize()
    }
    fn points(&self, rays: [V8; 2], distance: X8, reach: f32) -> Points {
        let distances = widen(distance);
        each(rays, |origin, direction| {
            let (c, r) = (D8::lit(self.center.map(f64::from)), f64x8::lit(f64::from(self.radius)));
            let to_center = c - origin;
            let square = direction.length_squared();
            let along = to_center.dot(direction) / square;
            // the point of the ray that is nearest to the centre, relative to it
            let foot = direction.mul_add(along, -to_center);
            let half_chord = ((r * r - foot.length_squared()).greater(zero()) / square).sqrt();
            let is_far = distances.gt(along);
            let outward = unit(direction.mul_add(half_chord.negate_where(!is_far), foot));
            let normal = facing(outward, direction);
            [lifted(outward.mul_add(r, c), normal, reach), normal]
        })
    }
    fn vectors(&self) -> [[f32; 3]; 3] {
        [self.center, [self.radius, 0.0, 0.0], [0.0; 3]]
    }
    fn extent([center, radius, _]: [Vec3<f64>; 3]) -> Extent {
        Extent { center, radius: radius.x, normal: Vec3::default() }
    }
    #[inline]
    fn sample<D: From<LightSample<X8>>>(vectors: [V8; 3], measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> D {
        let light = Self::light(vectors);
        match measure {
            Measure::Area => {
                // From outside, the far side is behind the near one, even if it emits inwards. The light does not occlude itself.
                let drawn = light.by_area(p).sample(u);
                LightSample { pdf: drawn.pdf.keep(drawn.emits | Self::contains(&light, p)), ..drawn }.into()
            }
            Measure::SolidAngle => light.by_solid_angle(p).sample(u).into(),
            Measure::Projected => light.by_projected_solid_angle(p, normal).sample(u).into(),
        }
    }
    #[inline]
    fn pdf(&self, _spread: Option<Spread<f32>>, p: V8, w: V8) -> X8 {
        light::Sphere::new(self.center.into(), X8::splat(self.radius)).by_solid_angle(p).pdf_of_hit(w)
    }
    /// From outside, the far side is behind the near one.
    fn sample_picture(
        &self,
        picture: &Picture<'_>,
        axes: &[[f32; 3]; 3],
        _measure: Measure,
        [p, _]: [V8; 2],
        u: Vec2<X8>,
    ) -> LightSample<X8> {
        let light = self.in_axes(axes, p);
        let drawn = picture.on(light).by_visible_area(Vec3::default()).draw(u).light;
        let inside = (V8::from(self.center) - p).length_squared().lt(X8::splat(self.radius * self.radius));
        LightSample {
            direction: outwards(axes, drawn.direction),
            normal: outwards(axes, drawn.normal),
            pdf: drawn.pdf.keep(drawn.emits | inside),
            ..drawn
        }
    }
    fn pdf_of_picture(&self, picture: &Picture<'_>, axes: &[[f32; 3]; 3], p: V8, w: V8) -> X8 {
        picture.on(self.in_axes(axes, p)).by_visible_area(Vec3::default()).pdf(inwards(axes, w))
    }
    fn outline(&self) -> Occluder<'static> {
        Occluder::Whole(Solid::Sphere { center: wide(self.center), radius: self.radius.into() })
    }
}

impl Hittable for Sphere {
    #[inline(always)]
    fn meet<const ANY: bool>(&self, rays: &Approach<'_>) -> Meeting {
        let (zero, none) = (X8::lit(0.0), M8::splat(false));
        // uses the foot of the perpendicular instead of |c − o|², which keeps the edges of distant spheres accurate
        let to_center = V8::from(self.center) - rays.origin;
        let along = to_center.dot(rays.direction);
        let foot = rays.direction.mul_add(-along, to_center);
        let r = X8::splat(self.radius);
        let square = r.mul_add(r, -foot.length_squared());
        let half = square.greater(zero).sqrt();
        let near = along - half;
        let distance = Real::blend(near.gt(zero), near, along + half);
        // to the outside of the sphere on which it begins, no ray meets it: the error of `along` is less than 2⁻²⁰ of it and the radius
        let leaves = rays.own & along.lt(X8::splat(self.radius * -LEAVES));
        let met = square.ge(zero) & distance.gt(zero) & !leaves;
        let size = self.radius * NEAR as f32;
        let close = |distance: X8| distance.abs().lt(X8::splat(size));
        let near_limit = rays.near_limit::<ANY>(distance, size);
        let mut unclear =
            rays.lanes & square.ge(zero) & !leaves & (rays.own | close(near) | close(along + half) | near_limit);
        if !SINGLE.contains(&self.radius) {
            unclear = rays.lanes;
        }
        let mut meeting = Meeting { distance, hit: met, level: none };
        if unclear.any() {
            meeting = rays.closely::<ANY>(unclear, meeting, |segment, begins_here| {
                let (center, radius) = (wide(self.center), f64::from(self.radius));
                let Segment { origin, direction, length } = segment;
                let found = to_sphere(center, radius, origin, direction, begins_here);
                // of the near side, the end is beyond what is inside of the sphere; of the far one, what is outside
                let inwards = radius - (direction.mul_add(length, origin) - center).length();
                let is_near = found.is_some_and(|found| found < direction.dot(center - origin));
                let end = segment.end(if is_near && length > direction.dot(center - origin) {
                    f64::INFINITY
                } else if is_near {
                    inwards
                } else {
                    -inwards
                });
                (found, end)
            });
            meeting.hit = met & !unclear | unclear & meeting.distance.gt(zero);
        }
        meeting.hit = meeting.hit & meeting.distance.lt(rays.limit);
        meeting
    }
    #[inline]
    fn fronts(&self, [origin, direction]: [V8; 2], distance: X8) -> M8 {
        direction.dot(direction.mul_add(distance, origin - V8::from(self.center))).lt(X8::lit(0.0))
    }
    fn reached_by(&self, segment: Segment) -> Segment {
        let (to_center, radius) = (wide(self.center) - segment.origin, f64::from(self.radius));
        let square = segment.direction.length_squared();
        let along = to_center.dot(segment.direction) / square;
        let foot = to_center - segment.direction * along;
        let half = ((radius * radius - foot.length_squared()).max(0.0) / square).sqrt();
        segment.to(if segment.length < along { along - half } else { along + half })
    }
}

/// The first positive distance along a ray to a sphere; `None` if there is none. If the ray begins on the sphere, only the other
/// intersection counts, and only if the ray runs through the inside.
fn to_sphere(
    center: Vec3<f64>,
    radius: f64,
    origin: Vec3<f64>,
    direction: Vec3<f64>,
    begins_here: bool,
) -> Option<f64> {
    let to_center = center - origin;
    let square = direction.length_squared();
    let along = to_center.dot(direction) / square;
    let foot = to_center - direction * along;
    let half = (radius * radius - foot.length_squared()) / square;
    if half.is_nan() || half < 0.0 || (begins_here && along <= 0.0) {
        return None;
    }
    let half = half.sqrt();
    let distance = if begins_here || along <= half { along + half } else { along - half };
    (distance > 0.0).then_some(distance)
}

/// Two vectors of this length across another.
pub(crate) fn across(v: Vec3<f64>, length: f64) -> [Vec3<f64>; 2] {
    let frame = Frame::new(v.normalize());
    [frame.s * length, frame.t * length]
}

/// From world space to the axes of a picture, given as the rows of a rotation.
#[inline]
fn inwards(axes: &[[f32; 3]; 3], v: V8) -> V8 {
    let [x, y, z] = axes.map(|row| V8::from(row).dot(v));
    Vec3::new(x, y, z)
}

/// From the axes of a picture to world space.
#[inline]
fn outwards(axes: &[[f32; 3]; 3], v: V8) -> V8 {
    let [x, y, z] = axes.map(V8::from);
    x.mul_add(v.x, y.mul_add(v.y, z * v.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    type V64 = Vec3<f64>;

    #[test]
    fn spheres_hide_only_what_is_behind_their_far_side_from_their_own_points() {
        let (center, radius) = (V64::new(1.0, 2.0, 3.0), 2.0);
        let top = V64::new(1.0, 4.0, 3.0);
        let (up, down) = (V64::new(0.0, 1.0, 0.0), V64::new(0.0, -1.0, 0.0));
        assert_eq!(to_sphere(center, radius, top, up, true), None);
        assert_eq!(to_sphere(center, radius, top, down, true), Some(4.0));
        let aside = V64::new(0.6, -0.8, 0.0);
        let chord = to_sphere(center, radius, top, aside, true).unwrap();
        assert!((chord - 3.2).abs() < 1e-15, "{chord}");
        assert_eq!(to_sphere(center, radius, top + up, down, false), Some(1.0));
        assert_eq!(to_sphere(center, radius, top + up, up, false), None);
        assert_eq!(to_sphere(center, radius, center, up, false), Some(2.0));
        assert_eq!(to_sphere(center, radius, top + V64::new(3.0, 0.0, 0.0), down, false), None);
    }
}
