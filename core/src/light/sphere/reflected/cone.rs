//! Elliptic cones, to which a linear map turns spheres as they are seen from a point.

use crate::math::{polynomial, ratio, rsqrt};
use crate::real::{Mask, Real};
use crate::vector::{Frame, Vec3};
use core::f64::consts::PI;

/// A symmetric matrix, by its diagonal and the entries across from it, and the axes in which it is given.
#[derive(Clone, Copy)]
struct Symmetric<R> {
    diagonal: [R; 3],
    /// Entry k is in the row and column that are not k.
    across: [R; 3],
    axes: [Vec3<R>; 3],
}

impl<R: Real> Symmetric<R> {
    /// Rotates axes P and Q, where Q follows P in the cycle 0, 1, 2, so that their common entry becomes 0 (Jacobi 1846; Golub and Van Loan,
    /// 8.5.2).
    #[inline(always)]
    fn rotate<const P: usize, const Q: usize>(&mut self) {
        let (zero, one, r) = (R::lit(0.0), R::lit(1.0), 3 - P - Q);
        let (half, off) = ((self.diagonal[Q] - self.diagonal[P]) * R::lit(0.5), self.across[r]);
        let sum = half.abs() + half.mul_add(half, off * off).sqrt();
        let tan = (off.negate_where(half.lt(zero)) / R::blend(sum.gt(zero), sum, one)).keep(sum.gt(zero));
        let cos = rsqrt(tan.mul_add(tan, one));
        let sin = tan * cos;
        self.diagonal[P] -= tan * off;
        self.diagonal[Q] += tan * off;
        let (a, b) = (self.across[Q], self.across[P]);
        self.across[Q] = a.mul_add(cos, -(sin * b));
        self.across[P] = a.mul_add(sin, cos * b);
        self.across[r] = zero;
        let (a, b) = (self.axes[P], self.axes[Q]);
        self.axes[P] = a.mul_add(cos, b * -sin);
        self.axes[Q] = a.mul_add(sin, b * cos);
    }
    fn numbers(&self) -> [R; 15] {
        let Self { diagonal: [a, b, c], across: [d, e, f], axes: [p, q, r] } = *self;
        [a, b, c, d, e, f, p.x, p.y, p.z, q.x, q.y, q.z, r.x, r.y, r.z]
    }
    fn of([a, b, c, d, e, f, rest @ ..]: [R; 15]) -> Self {
        let axes = [0, 3, 6].map(|i| Vec3::new(rest[i], rest[i + 1], rest[i + 2]));
        Self { diagonal: [a, b, c], across: [d, e, f], axes }
    }
    /// Lanes in which an entry across from the diagonal is not negligible beside those of its row and column, however small these are.
    #[inline(always)]
    fn is_open(&self) -> R::Mask {
        let least = R::lit(if R::DOUBLE { 1e-30 } else { 1e-14 });
        (0..3).fold(R::Mask::splat(false), |open, k| {
            let beside = (self.diagonal[(k + 1) % 3] * self.diagonal[(k + 2) % 3]).abs();
            open | (self.across[k] * self.across[k]).gt(beside * least)
        })
    }
    /// The eigenvalues and the unit eigenvectors.
    #[inline(always)]
    fn eigen(self) -> ([R; 3], [Vec3<R>; 3]) {
        let step = |numbers: [R; 15], [open]: [R::Mask; 1]| {
            let mut next = Self::of(numbers);
            next.rotate::<0, 1>();
            next.rotate::<2, 0>();
            next.rotate::<1, 2>();
            let rotated = next.numbers();
            (core::array::from_fn(|k| R::blend(open, rotated[k], numbers[k])), [open & next.is_open()])
        };
        let Self { diagonal, axes, .. } = Self::of(R::iterate(6, self.numbers(), [self.is_open()], step));
        (diagonal, axes)
    }
}

/// The principal axes of a cone: unit vectors across it and along it, a right-handed frame, with the tangents of the half-angles across it.
struct Principal<R> {
    axes: [Vec3<R>; 3],
    tangents: [R; 2],
}

impl<R: Real> Principal<R> {
    /// The axes of the cone over the ellipse with this centre and two conjugate radii. The planes p that touch it have p·D·p = 0 with D =
    /// u uᵀ + v vᵀ − c cᵀ, whose eigenvectors are the axes. About the centre as third axis, the entries of D keep their digits however
    /// narrow the cone is.
    #[inline]
    fn new(center: Vec3<R>, u: Vec3<R>, v: Vec3<R>) -> Self {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let frame = Frame::new(center);
        let [u, v] = [u, v].map(|r| frame.to_local(r)).map(|v| [v.x, v.y, v.z]);
        let entry = |i: usize, j: usize| u[i].mul_add(u[j], v[i] * v[j]);
        let diagonal = [entry(0, 0), entry(1, 1), entry(2, 2) - one];
        let across = [entry(1, 2), entry(2, 0), entry(0, 1)];
        let (mut m, mut axes) = Symmetric { diagonal, across, axes: [frame.s, frame.t, frame.n] }.eigen();
        // one eigenvalue is negative, that of the axis along the cone; it stays in its place unless the cone is wide
        for k in 0..2 {
            let less = m[k].lt(m[2]);
            (m[k], m[2]) = (R::blend(less, m[2], m[k]), R::blend(less, m[k], m[2]));
            (axes[k], axes[2]) = (Vec3::blend(less, axes[2], axes[k]), Vec3::blend(less, axes[k], axes[2]));
        }
        // the first is the wider one
        let less = m[0].lt(m[1]);
        (m[0], m[1]) = (R::blend(less, m[1], m[0]), R::blend(less, m[0], m[1]));
        (axes[0], axes[1]) = (Vec3::blend(less, axes[1], axes[0]), Vec3::blend(less, axes[0], axes[1]));
        axes[2] = axes[2] * one.copysign(axes[2].dot(center));
        axes[0] = axes[0] * one.copysign(axes[0].cross(axes[1]).dot(axes[2]));
        let tangent = |square: R| ratio(square.greater(zero), -m[2]).sqrt();
        Self { axes, tangents: [tangent(m[0]), tangent(m[1])] }
    }
}

/// artanh(x)/x from x² and 1 − x², for x in [0, 1): halved by artanh x = 2 artanh(x/(1 + √(1 − x²))) until the series suffices.
#[inline(always)]
fn artanh_over<R: Real>(mut square: R, mut rest: R) -> R {
    let (one, mut factor) = (R::lit(1.0), R::lit(1.0));
    for _ in 0..6 {
        let part = one / (one + rest.greater(R::lit(0.0)).sqrt());
        square = square * part * part;
        rest = one - square;
        factor *= part + part;
    }
    factor * polynomial(square, [1.0, 1.0 / 3.0, 1.0 / 5.0, 1.0 / 7.0, 1.0 / 9.0, 1.0 / 11.0, 1.0 / 13.0])
}

/// The projected solid angle, on a surface with normal +z and above its horizon, of the cone over the ellipse with this centre and two
/// conjugate radii: directions c + u cos t + v sin t and all between them. The cone must be narrower than a half space.
///
/// In the axes of the cone, with the tangents A ≥ B of its half-angles, its edge is p(t) = (A cos t, B sin t, 1), and Ω⊥ = ½ ∮ n·(p × p′)/|p|² dt
/// (Lambert) = ½ ∮ (AB n₃ − B n₁ cos t − A n₂ sin t)/(P cos²t + Q sin²t) dt with P = 1 + A², Q = 1 + B²: over the whole edge π AB n₃/√(PQ).
/// Where the horizon cuts the cone, the edge is above it between two values of t, the integral has closed forms, and the horizon closes the
/// curve.
#[inline]
pub(super) fn projected_solid_angle<R: Real>(center: Vec3<R>, u: Vec3<R>, v: Vec3<R>) -> R {
    let (zero, one, half) = (R::lit(0.0), R::lit(1.0), R::lit(0.5));
    let (axis, length) = center.unit_and_length();
    let scale = ratio(one, length);
    let Principal { axes, tangents: [a, b] } = Principal::new(axis, u * scale, v * scale);
    let [n1, n2, n3] = axes.map(|axis| axis.z);
    let (p, q) = (a.mul_add(a, one), b.mul_add(b, one));
    let over = rsqrt(p * q);
    let whole = R::lit(PI) * a * b * n3 * over;
    let (x, y) = (a * n1, b * n2);
    let reach = x.mul_add(x, y * y).sqrt();
    let cut = n3.abs().lt(reach);
    let above = whole.keep(n3.ge(reach));
    R::where_any(cut, above, || {
        // from the middle of the part above the horizon to either end
        let some = reach.gt(zero);
        let inverse = one / R::blend(some, reach, one);
        let (cos, sin) = (R::blend(some, x * inverse, one), y * inverse);
        let cosine = (-n3 * inverse).clamped(-one, one);
        let sine = ((one - cosine) * (one + cosine)).sqrt();
        let from = [cos.mul_add(cosine, sin * sine), sin.mul_add(cosine, -(cos * sine))];
        let to = [cos.mul_add(cosine, -(sin * sine)), sin.mul_add(cosine, cos * sine)];
        let turn = |[a, b]: [R; 2], [c, d]: [R; 2]| {
            let turn = a.mul_add(d, -(b * c)).atan2(a.mul_add(c, b * d));
            R::blend(turn.lt(zero), turn + R::lit(2.0 * PI), turn)
        };
        let (root_p, root_q) = (p.sqrt(), q.sqrt());
        let stretched = |[c, s]: [R; 2]| [c * root_p, s * root_q];
        let even = turn(stretched(from), stretched(to)) * over;
        let difference = (a - b) * (a + b);
        // ∫ cos t and ∫ sin t over P cos²t + Q sin²t
        let by_cosine = |[c, s]: [R; 2]| {
            let square = c.mul_add(c * p, s * s * q);
            ratio(s, p) * artanh_over(s * s * ratio(difference, p), ratio(square, p))
        };
        let by_sine = |[c, _]: [R; 2]| {
            let root = difference.greater(zero).sqrt();
            let tangent = c * root * ratio(one, root_q);
            let small = tangent.abs().lt(R::lit(1e-3));
            let angle = R::blend(
                small,
                one - tangent * tangent * R::lit(1.0 / 3.0),
                tangent.atan2(one) / R::blend(small, one, tangent),
            );
            -(ratio(c, q) * angle)
        };
        let arc =
            a * b * n3 * even - b * n1 * (by_cosine(to) - by_cosine(from)) - a * n2 * (by_sine(to) - by_sine(from));
        // the horizon from the end of the edge back to its beginning
        let point = |[c, s]: [R; 2]| axes[0].mul_add(a * c, axes[1].mul_add(b * s, axes[2]));
        let (start, end) = (point(from), point(to));
        let back = end.x.mul_add(start.y, -(end.y * start.x)).atan2(end.x.mul_add(start.x, end.y * start.y));
        ((arc + back) * half).greater(zero)
    })
}
