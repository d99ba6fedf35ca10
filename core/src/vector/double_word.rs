//! Products and sums of vectors in twice the working precision, as unevaluated sums of two numbers, so that small differences
//! keep their digits. Built from TwoSum and TwoProd (Ogita, Rump and Oishi 2005, "Accurate Sum and Dot Product", algorithm
//! 5.3).

use crate::math::rsqrt;
use crate::real::Real;
use crate::vector::Vec3;

/// a·b, rounded once.
#[inline(always)]
pub(crate) fn compensated_dot<R: Real>(a: Vec3<R>, b: Vec3<R>) -> R {
    let [sum, rest] = dot_dw(a, b);
    sum + rest
}

/// a·b, as an unevaluated sum.
#[inline(always)]
pub(crate) fn dot_dw<R: Real>(a: Vec3<R>, b: Vec3<R>) -> [R; 2] {
    R::dot_in_two(a.to_array(), b.to_array())
}

/// The sum of two such numbers, rounded once.
#[inline(always)]
pub(crate) fn rounded_sum<R: Real>([a, ra]: [R; 2], [b, rb]: [R; 2]) -> R {
    let (sum, rest) = a.two_sum(b);
    sum + (rest + (ra + rb))
}

/// p·n for an unevaluated sum n, rounded once: the height of a far point over a plane is a small difference.
#[inline(always)]
pub(crate) fn compensated_height<R: Real>(p: Vec3<R>, n: [Vec3<R>; 2]) -> R {
    let [sum, rest] = height_dw(p, n);
    sum + rest
}

/// p·(a×b), given the rounded product n = a×b: a sum of rounded terms to within 6e−7 of itself where they cancel by less than half, and
/// in twice the working precision elsewhere.
#[inline(always)]
pub(crate) fn height_over<R: Real>(p: Vec3<R>, [a, b]: [Vec3<R>; 2], n: Vec3<R>) -> R {
    let plain = p.dot(n);
    let terms = p.x.abs().mul_add(n.x.abs(), p.y.abs().mul_add(n.y.abs(), (p.z * n.z).abs()));
    let cancel = (plain + plain).abs().lt(terms);
    let [height] = R::where_any(cancel, [plain], || [compensated_height(p, cross_dw(a, b))]);
    height
}

/// p·n for an unevaluated sum n, not rounded.
#[inline(always)]
pub fn height_dw<R: Real>(p: Vec3<R>, [n, more]: [Vec3<R>; 2]) -> [R; 2] {
    let [sum, rest] = dot_dw(p, n);
    [sum, rest + p.dot(more)]
}

/// u×v, as an unevaluated sum.
#[inline(always)]
pub(crate) fn cross_dw<R: Real>(u: Vec3<R>, v: Vec3<R>) -> [Vec3<R>; 2] {
    let cross = |a: R, b: R, c: R, d: R| {
        let (ab, cd) = (a * b, c * d);
        let (sum, error) = ab.two_sum(-cd);
        (sum, error + (R::two_prod_error(a, b, ab) - R::two_prod_error(c, d, cd)))
    };
    let ((x, ex), (y, ey), (z, ez)) = (cross(u.y, v.z, u.z, v.y), cross(u.z, v.x, u.x, v.z), cross(u.x, v.y, u.y, v.x));
    [Vec3::new(x, y, z), Vec3::new(ex, ey, ez)]
}

/// a×b for two unevaluated sums.
#[inline(always)]
pub(crate) fn cross_sums<R: Real>([a, ra]: [Vec3<R>; 2], [b, rb]: [Vec3<R>; 2]) -> [Vec3<R>; 2] {
    let [n, rest] = cross_dw(a, b);
    [n, rest + (a.cross(rb) + ra.cross(b))]
}

/// a + b for two unevaluated sums; a plain vector has the rest 0.
#[inline(always)]
pub fn sum_dw<R: Real>([a, ra]: [Vec3<R>; 2], [b, rb]: [Vec3<R>; 2]) -> [Vec3<R>; 2] {
    let ((x, ex), (y, ey), (z, ez)) = (a.x.two_sum(b.x), a.y.two_sum(b.y), a.z.two_sum(b.z));
    [Vec3::new(x, y, z), Vec3::new(ex, ey, ez) + (ra + rb)]
}

/// The unit normal; the normal times a power of two, unrounded; and 1 over the length of the latter. A zero normal counts as z.
#[inline(always)]
pub(crate) fn unit_normal<R: Real>(normal: Vec3<R>) -> (Vec3<R>, Vec3<R>, R) {
    let (zero, one) = (R::lit(0.0), R::lit(1.0));
    let scaled = normal * normal.max_abs().pow2_scale();
    let squared = scaled.length_squared();
    let flat = squared.le(zero);
    let scaled = Vec3::new(scaled.x, scaled.y, R::blend(flat, one, scaled.z));
    let shrink = rsqrt(R::blend(flat, one, squared));
    (scaled * shrink, scaled, shrink)
}
