//! Shading points: where rays meet primitives, off the surface by no more than the rounding of the point itself.
//!
//! The point where a ray meets a primitive is computed in double precision, moved along the normal, and rounded to single precision. The
//! rounding moves it by at most ½ ulp of each coordinate, that is by δ = 2⁻²⁴ Σ|nₖ pₖ| along the normal n. So a lift of 2δ leaves the point
//! between δ and 3δ above its surface, whatever the size of the primitive, of the scene or of a light. To that comes 2⁻⁴⁴ of the greatest
//! coordinate of the scene (within limits, see [`reach_of_points`](crate::bvh::Bvh::reach_of_points)), which is more than the error of tests in
//! double precision.

use crate::packet::{V8, narrow_points, widen_points};
use etendue::{Mask, Real, Vec3, f64x8};

pub(super) type D8 = Vec3<f64x8>;

/// The lift of a point, relative to Σ|nₖ pₖ|: 2δ.
pub(crate) const LIFT: f64 = 1.0 / 8_388_608.0;
/// The lift of points near the origin, relative to the greatest coordinate of the scene.
pub(crate) const LEAST: f64 = 1.0 / (1_u64 << 44) as f64;

/// Lifted shading points, and unit normals on the side of the ray.
pub(crate) struct Points {
    pub(crate) point: V8,
    pub(crate) normal: V8,
}

pub(super) fn zero() -> f64x8 {
    Real::lit(0.0)
}

/// A number that is not 0: 1 instead of what is not greater than 0 in magnitude.
#[inline(always)]
fn divisor(x: f64x8) -> f64x8 {
    Real::blend(x.abs().gt(zero()), x, Real::lit(1.0))
}

/// The unit vector; 0 for the zero vector.
#[inline(always)]
pub(super) fn unit(v: D8) -> D8 {
    v * (f64x8::lit(1.0) / divisor(v.length()))
}

/// The normal on the side of the incoming ray.
#[inline(always)]
pub(super) fn facing(normal: D8, direction: D8) -> D8 {
    let away = normal.dot(direction).gt(zero());
    normal.map(|x| x.negate_where(away))
}

/// The point, lifted along the normal.
#[inline(always)]
pub(super) fn lifted(p: D8, n: D8, reach: f32) -> D8 {
    let along = (p.x * n.x).abs() + (p.y * n.y).abs() + (p.z * n.z).abs();
    n.mul_add(along.mul_add(f64x8::lit(LIFT), f64x8::lit(f64::from(reach) * LEAST)), p)
}

/// The points and normals that `of` returns for the rays' origins and directions.
#[inline(always)]
pub(super) fn each([origin, direction]: [V8; 2], of: impl FnOnce(D8, D8) -> [D8; 2]) -> Points {
    let [point, normal] = of(widen_points(origin), widen_points(direction));
    Points { point: narrow_points(point), normal: narrow_points(normal) }
}

/// A triangle, prepared in double precision.
#[derive(Clone, Copy)]
struct Prepared<R> {
    corner: Vec3<R>,
    edges: [Vec3<R>; 2],
    normal: Vec3<R>,
    /// Barycentric coordinates are dot products with these.
    duals: [Vec3<R>; 2],
}

impl<R: Real> Prepared<R> {
    #[inline(always)]
    fn new([a, b, c]: [Vec3<R>; 3]) -> Self {
        // rounded as it comes: double precision has digits to spare
        let cross = |a: Vec3<R>, b: Vec3<R>| {
            let of = |a: R, b: R, c: R, d: R| a.mul_add(b, -(c * d));
            Vec3::new(of(a.y, b.z, a.z, b.y), of(a.z, b.x, a.x, b.z), of(a.x, b.y, a.y, b.x))
        };
        let (u, v, zero) = (b - a, c - a, R::lit(0.0));
        let across = cross(u, v);
        let square = across.length_squared();
        let inverse = R::lit(1.0) / R::blend(square.gt(zero), square, R::lit(1.0));
        let duals = [cross(v, across) * inverse, cross(across, u) * inverse];
        Self { corner: a, edges: [u, v], normal: across * (square.sqrt() * inverse), duals }
    }
    /// The same in every lane.
    #[inline(always)]
    fn splat<S: Real<Scalar = R>>(self) -> Prepared<S> {
        Prepared {
            corner: Vec3::splat(self.corner),
            edges: [Vec3::splat(self.edges[0]), Vec3::splat(self.edges[1])],
            normal: Vec3::splat(self.normal),
            duals: [Vec3::splat(self.duals[0]), Vec3::splat(self.duals[1])],
        }
    }
}

impl Prepared<f64x8> {
    /// Where rays meet the triangles. What the rounding of a ray puts outside of a triangle is moved to its edge.
    #[inline(always)]
    fn meet(&self, origin: D8, direction: D8, reach: f32) -> [D8; 2] {
        let Self { corner, edges: [u, v], normal, duals } = *self;
        let (one, to_corner) = (f64x8::lit(1.0), corner - origin);
        let distance = normal.dot(to_corner) / divisor(normal.dot(direction));
        let relative = direction.mul_add(distance, -to_corner);
        let (mut s, mut t) = (relative.dot(duals[0]).greater(zero()), relative.dot(duals[1]).greater(zero()));
        let sum = s + t;
        if sum.gt(one).any() {
            let shrink = one / sum.greater(one);
            (s, t) = (s * shrink, t * shrink);
        }
        let p = u.mul_add(s, v.mul_add(t, corner));
        let normal = facing(normal, direction);
        [lifted(p, normal, reach), normal]
    }
}

/// Where rays meet triangles, one per lane.
#[inline(always)]
pub(crate) fn on_triangles([a, b, c]: [V8; 3], [origin, direction]: [V8; 2], reach: f32) -> Points {
    let triangles = Prepared::new([widen_points(a), widen_points(b), widen_points(c)]);
    each([origin, direction], |origin, direction| triangles.meet(origin, direction, reach))
}

/// Where rays meet the planes of triangles, one per lane, which are so large that rounding in proportion to their size would move points by
/// more than that of rays does.
#[inline(never)]
pub(crate) fn on_vast_triangles([a, b, c]: [V8; 3], [origin, direction]: [V8; 2], reach: f32) -> Points {
    let Prepared { corner, normal, .. } = Prepared::new([widen_points(a), widen_points(b), widen_points(c)]);
    each([origin, direction], |origin, direction| along([corner, normal], [origin, direction], reach))
}

/// Where rays meet the same triangle.
#[inline(always)]
pub(crate) fn on_triangle(corners: [Vec3<f64>; 3], [origin, direction]: [V8; 2], reach: f32) -> Points {
    let triangle = Prepared::new(corners).splat();
    each([origin, direction], |origin, direction| triangle.meet(origin, direction, reach))
}

/// Where rays meet the plane of a flat shape, given by a point and the unit normal.
pub(super) fn on_plane([point, normal]: [Vec3<f64>; 2], [origin, direction]: [V8; 2], reach: f32) -> Points {
    each([origin, direction], |origin, direction| {
        along([D8::splat(point), D8::splat(normal)], [origin, direction], reach)
    })
}

/// The points of rays on planes, lifted, and the normals on the sides of the rays.
#[inline(always)]
fn along([point, normal]: [D8; 2], [origin, direction]: [D8; 2], reach: f32) -> [D8; 2] {
    let distance = normal.dot(point - origin) / divisor(normal.dot(direction));
    let normal = facing(normal, direction);
    [lifted(direction.mul_add(distance, origin), normal, reach), normal]
}
