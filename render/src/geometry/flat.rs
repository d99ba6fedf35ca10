//! What flat forms have in common.

use super::ends::Segment;
use super::form::{Approach, Hittable, Meeting, NEAR};
use crate::packet::{M8, V8, X8};
use crate::technique::Measure;
use etendue::light::{FlatLight, Picture};
use etendue::{LightSample, Mask, Real, Vec2, Vec3};

type V64 = Vec3<f64>;

/// A plane, prepared for rays.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    /// A point of it.
    point: [f32; 3],
    normal: [f32; 3],
    /// The same point and unit normal in double precision.
    exact: [V64; 2],
    /// Hits that are nearer to the origin of a ray are computed in double precision.
    near: f32,
}

impl Plane {
    /// The plane through a point with this unit normal, for a form that extends so far in scene units.
    pub(super) fn new(point: [f32; 3], normal: V64, extent: f64) -> Self {
        let exact = [Vec3::from(point.map(f64::from)), normal];
        Self { point, normal: narrow(normal), exact, near: (extent * NEAR) as f32 }
    }
    /// As of [`Hittable::meet`], for the part of the plane whose points, relative to the point of the plane, are `inside`.
    #[inline(always)]
    pub(super) fn meet<const ANY: bool>(&self, rays: &Approach<'_>, inside: impl FnOnce(V8) -> M8) -> Meeting {
        let (zero, one, none) = (X8::lit(0.0), X8::lit(1.0), M8::splat(false));
        let to_point = V8::from(self.point) - rays.origin;
        let normal = V8::from(self.normal);
        let slope = rays.direction.dot(normal);
        let some = slope.abs().gt(zero);
        let distance = to_point.dot(normal) / Real::blend(some, slope, one);
        let inside = some & inside(rays.direction.mul_add(distance, -to_point)) & !rays.own;
        let unclear = inside
            & rays.lanes
            & (distance.abs().lt(X8::splat(self.near)) | rays.near_limit::<ANY>(distance, self.near));
        let mut meeting = Meeting { distance, hit: none, level: none };
        if unclear.any() {
            meeting = rays.closely::<ANY>(unclear, meeting, |segment, _| {
                let [point, normal] = self.exact;
                let found = normal.dot(point - segment.origin) / normal.dot(segment.direction);
                (found.is_finite().then_some(found), segment.end_at_plane(point, normal))
            });
        }
        meeting.hit = inside & meeting.distance.gt(zero) & meeting.distance.lt(rays.limit);
        meeting
    }
    /// As of [`Hittable::reached_by`].
    pub(super) fn reached_by(&self, segment: Segment) -> Segment {
        segment.to_plane(self.exact[0], self.exact[1])
    }
    /// Lanes of rays in these directions that meet the side of the normal.
    #[inline(always)]
    pub(super) fn fronts(&self, direction: V8) -> M8 {
        direction.dot(V8::from(self.normal)).lt(X8::lit(0.0))
    }
}

/// A triangle or parallelogram p + s·u + t·v, prepared for rays: s and t are dot products with the dual vectors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edged<const TRIANGLE: bool> {
    plane: Plane,
    dual: [[f32; 3]; 2],
}

impl<const TRIANGLE: bool> Edged<TRIANGLE> {
    pub(super) fn new(p: [f32; 3], u: V64, v: V64) -> Self {
        let normal = u.cross(v);
        let extent = u.length().max(v.length()).max((u - v).length());
        Self { plane: Plane::new(p, normal.normalize(), extent), dual: duals(u, v).map(narrow) }
    }
}

impl<const TRIANGLE: bool> Hittable for Edged<TRIANGLE> {
    #[inline(always)]
    fn meet<const ANY: bool>(&self, rays: &Approach<'_>) -> Meeting {
        let (zero, one) = (X8::lit(0.0), X8::lit(1.0));
        self.plane.meet::<ANY>(rays, |point| {
            let (s, t) = (point.dot(self.dual[0].into()), point.dot(self.dual[1].into()));
            let far_side = if TRIANGLE { (s + t).le(one) } else { s.le(one) & t.le(one) };
            s.ge(zero) & t.ge(zero) & far_side
        })
    }
    #[inline]
    fn fronts(&self, [_, direction]: [V8; 2], _distance: X8) -> M8 {
        self.plane.fronts(direction)
    }
    fn reached_by(&self, segment: Segment) -> Segment {
        self.plane.reached_by(segment)
    }
}

fn narrow(v: V64) -> [f32; 3] {
    [v.x as f32, v.y as f32, v.z as f32]
}

/// The vectors whose dot products with s·u + t·v are s and t.
fn duals(u: V64, v: V64) -> [V64; 2] {
    let normal = u.cross(v);
    let inverse = 1.0 / normal.length_squared();
    [v.cross(normal) * inverse, normal.cross(u) * inverse]
}

/// The coordinates (s, t) of points p + s·u + t·v, within [0, 1].
#[inline]
pub(super) fn coordinates(p: [f32; 3], u: V64, v: V64, point: V8) -> Vec2<X8> {
    let from_corner = point - V8::from(p);
    let inside = |x: X8| x.clamped(X8::lit(0.0), X8::lit(1.0));
    let [s, t] = duals(u, v).map(|dual| inside(from_corner.dot(V8::from(narrow(dual)))));
    Vec2::new(s, t)
}

/// Samples a light in proportion to a picture.
pub(super) fn sample_picture(
    picture: &Picture<'_>,
    light: impl FlatLight<X8>,
    measure: Measure,
    [p, normal]: [V8; 2],
    u: Vec2<X8>,
) -> LightSample<X8> {
    let light = picture.on(light);
    match measure {
        Measure::Area => light.by_area(p).draw(u).light,
        Measure::SolidAngle => light.by_solid_angle(p).draw(u).light,
        Measure::Projected => light.by_projected_solid_angle(p, normal).draw(u).light,
    }
}
