//! Clipping a triangle to the horizon.

use super::piece::Corners;
use crate::math::{difference_of_products, ratio, rsqrt};
use crate::real::Real;
use crate::vector::Vec3;

/// Quantities of a triangle in twice the working precision, before the normal is normalised.
pub(super) struct Exact<R> {
    /// from each vertex to the next
    pub(super) edges: [Vec3<R>; 3],
    /// cross products of each vertex and the next, as unevaluated sums
    pub(super) products: [[Vec3<R>; 2]; 3],
    /// products of the vertices with the normal
    pub(super) heights: [[R; 2]; 3],
    /// products of `products` with the normal
    pub(super) volumes: [[R; 2]; 3],
    /// 1 over the length of the normal that `heights` and `volumes` use
    pub(super) shrink: R,
}

/// What the horizon leaves of a triangle: one or two triangles, and the normal of the plane between them, pointing to the
/// second.
#[inline(never)]
pub(super) fn clip<R: Real>(
    corners: &Corners<R>,
    exact: &Exact<R>,
    normal: Vec3<R>,
) -> (Corners<R>, Corners<R>, Vec3<R>) {
    let (zero, one) = (R::lit(0.0), R::lit(1.0));
    let Corners { vertices: v, poles, lengths, areas, heights: z, volume } = *corners;
    let below = z.map(|z| z.lt(zero));
    // rotated so that the first vertex is above and the last below
    let (by1, by2) = (!below[1] & below[0], !below[2] & below[1]);
    let next = |i: usize, k: usize| (i + k) % 3;
    let pick = |x: [R; 3], i: usize| R::blend(by1, x[next(i, 1)], R::blend(by2, x[next(i, 2)], x[i]));
    let turned = |x: [Vec3<R>; 3], i: usize| Vec3::blend(by1, x[next(i, 1)], Vec3::blend(by2, x[next(i, 2)], x[i]));
    let [v0, v1, v2]: [Vec3<R>; 3] = core::array::from_fn(|i| turned(v, i));
    let [e0, e1, e2]: [Vec3<R>; 3] = core::array::from_fn(|i| turned(exact.edges, i));
    let [p0, p1, p2]: [Vec3<R>; 3] = core::array::from_fn(|i| turned(poles, i));
    let [z0, z1, z2]: [R; 3] = core::array::from_fn(|i| pick(z, i));
    let [l0, l1, l2]: [R; 3] = core::array::from_fn(|i| pick(lengths, i));
    let [a0, a1, a2]: [R; 3] = core::array::from_fn(|i| pick(areas, i));
    let whole = !(below[0] | below[1] | below[2]);
    let none = below[0] & below[1] & below[2];
    // the parameter at which an edge from above meets the horizon
    let part = |a: R, b: R| ratio(a.greater(zero), a.greater(zero) - b.lesser(zero));
    let (t0, t1, t2) = (part(z0, z1), part(z1, z2), part(z0, z2));
    let r1 = part(-z2, -z1);
    let quad = z1.ge(zero);
    // near the point that sum cancels: take the line in which the edge's plane meets the horizon
    let meet = |v: Vec3<R>, e: Vec3<R>, t: R, pole: Vec3<R>| {
        let sum = e.mul_add(t, v);
        let line = pole.cross(normal);
        let squared = line.length_squared();
        let better = (squared * v.length_squared()).gt(sum.length_squared());
        Vec3::blend(better, line * ratio(sum.dot(line), squared), sum)
    };
    let (h0, h1, h2) = (meet(v0, e0, t0, p0), meet(v1, e1, t1, p1), meet(v0, -e2, t2, p2));
    let choose = |of_quad: Vec3<R>, of_triangle: Vec3<R>, all: Vec3<R>| {
        Vec3::blend(whole, all, Vec3::blend(quad, of_quad, of_triangle))
    };
    let of = |of_quad: R, of_triangle: R, all: R| R::blend(whole, all, R::blend(quad, of_quad, of_triangle));
    // v0×h1, for the diagonal and for what lies on the horizon
    let pair = |x: [[R; 2]; 3], i: usize| [pick(x.map(|x| x[0]), i), pick(x.map(|x| x[1]), i)];
    let vectors = |i: usize| [0, 1].map(|k| turned(exact.products.map(|m| m[k]), i));
    let (high, low) = (pair(exact.heights, 1), pair(exact.heights, 2));
    let share = ratio(one, (high[0] + high[1]) - (low[0] + low[1])).lesser(R::lit(1e37));
    // −(low·from + high·to)/(high − low), a product of unevaluated sums
    let between = |from: [R; 2], to: [R; 2]| {
        let rest = low[0].mul_add(from[1], low[1] * from[0]) + high[0].mul_add(to[1], high[1] * to[0]);
        -(difference_of_products(low[0], from[0], -high[0], to[0]) + rest) * share
    };
    let ([m0, r0], [m2, r2]) = (vectors(0), vectors(2));
    let axis = |f: fn(Vec3<R>) -> R| between([f(m0), f(r0)], [f(m2), f(r2)]);
    let diagonal = Vec3::new(axis(|v| v.x), axis(|v| v.y), axis(|v| v.z));
    let area = between(pair(exact.volumes, 0), pair(exact.volumes, 2)) * exact.shrink;
    let squared = diagonal.length_squared();
    let inverse = rsqrt(squared).keep(squared.gt(R::lit(1e-36)));
    let (diagonal, length) = (diagonal * inverse, squared * inverse);
    let (first_volume, second_volume) = (volume * R::blend(quad, t1, t0 * t2), volume * r1 * t2);
    // at most the product of two lengths, however small the height of the vertex
    let level = |volume: R| ratio(volume, z0).clamped(R::lit(-16.0), R::lit(16.0));
    let (first_level, second_level) = (level(first_volume), level(second_volume));
    let turn = one.negate_where(volume.lt(zero));
    let horizon = normal * turn;
    let first = Corners {
        vertices: [v0, choose(v1, h0, v1), choose(h1, h2, v2)],
        poles: [p0, choose(p1, horizon, p1), choose(-diagonal, p2, p2)],
        lengths: [of(l0, l0 * t0, l0), of(l1 * t1, first_level.abs(), l1), of(length, l2 * t2, l2)],
        areas: [of(a0, a0 * t0, a0), of(a1 * t1, first_level, a1), of(-area, a2 * t2, a2)],
        heights: [z0, R::blend(quad, z1, zero), z2.keep(whole)],
        volume: R::blend(whole, volume, first_volume.keep(!none)),
    };
    let second = Corners {
        vertices: [v0, h1, h2],
        poles: [diagonal, horizon, p2],
        lengths: [length, second_level.abs(), l2 * t2],
        areas: [area, second_level, a2 * t2],
        heights: [z0, zero, zero],
        volume: second_volume.keep(quad & !whole & !none),
    };
    (first, second, diagonal * turn)
}
