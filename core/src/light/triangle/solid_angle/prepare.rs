//! Prepares a triangle for a point, with the names of Arvo and of Peters: V from the point to the vertices, l their lengths, d the cosines
//! between them, G₀ : T = tan(Ω/2).

use super::{Planes, SphericalTriangle};
use crate::light::surface::SURFACE_SLACK;
use crate::math::rsqrt;
use crate::real::{Real, blended};
use crate::vector::{Vec2, Vec3};

/// Square of the length below which the cross product of two vertices counts as 0.
const LEAST_SQUARED: f64 = 1e-37;

/// Where v1 is so many times as far as v2, the edge between them is so much longer than V₂ that its rounding counts, and V₂ takes its place.
const FAR: f64 = 128.0;

/// The vertices as the point sees them.
#[derive(Clone, Copy)]
struct Corners<R> {
    v: [Vec3<R>; 3],
    /// l
    length: [R; 3],
    /// 1/l; 0 at a vertex
    inverse: [R; 3],
    d01: R,
    d02: R,
    d12: R,
    /// V₁/l₁
    apex: Vec3<R>,
}

impl<R: Real> Corners<R> {
    #[inline(always)]
    fn new([v0, v1, v2]: [Vec3<R>; 3]) -> Self {
        let (s0, s1, s2) = (v0.length_squared(), v1.length_squared(), v2.length_squared());
        let inverse = |s: R| rsqrt(s).keep(s.gt(R::lit(1e-36)));
        let (i0, i1, i2) = (inverse(s0), inverse(s1), inverse(s2));
        let apex = v1 * i1;
        Self {
            v: [v0, v1, v2],
            length: [s0 * i0, s1 * i1, s2 * i2],
            inverse: [i0, i1, i2],
            d01: v0.dot(v1) * i0 * i1,
            d02: v0.dot(v2) * i0 * i2,
            d12: apex.dot(v2) * i2,
            apex,
        }
    }
    /// True unless the point is a vertex.
    #[inline(always)]
    fn apart(&self) -> R::Mask {
        let ([i0, i1, i2], zero) = (self.inverse, R::lit(0.0));
        i0.gt(zero) & i1.gt(zero) & i2.gt(zero)
    }
}

/// The side c from v0 to v1.
struct Side<R> {
    /// 1/|V₀×V₁|
    inverse: R,
    /// sin c
    sin: R,
    /// 2/sin c
    stretch: R,
    /// k = tan(c/2)
    tan_half: R,
    /// G₂ = 1 + d₀₁
    g2: R,
}

impl<R: Real> Side<R> {
    #[inline(always)]
    fn new(corners: &Corners<R>, n01: Vec3<R>) -> Self {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let (&Corners { d01, .. }, [i0, i1, _], [l0, l1, _]) = (corners, corners.inverse, corners.length);
        let squared = n01.length_squared();
        let inverse = rsqrt(squared).keep(squared.gt(R::lit(LEAST_SQUARED)));
        let sin = squared * inverse * i0 * i1;
        let inv_sin = inverse * l0 * l1;
        // the smaller one of 1 − d₀₁ and 1 + d₀₁ comes from the sine
        let small = sin * sin / (one + d01.abs());
        let obtuse = d01.lt(zero);
        let (minus, g2) = (R::blend(obtuse, one - d01, small), R::blend(obtuse, small, one + d01));
        Self { inverse, sin, stretch: R::lit(2.0) * inv_sin, tan_half: minus * inv_sin, g2 }
    }
}

/// What v2 adds to the side from v0 to v1.
#[derive(Clone, Copy)]
struct Opposite<R> {
    /// T = 1 + d₀₁ + d₀₂ + d₁₂
    total: R,
    /// V₂/l₂ along the tangents at v1: towards v0, and across
    x2: R,
    y2: R,
    one_plus_d02: R,
    one_plus_d12: R,
    /// 1 − d₀₂²
    sin02_squared: R,
}
blended!(Opposite { total, x2, y2, one_plus_d02, one_plus_d12, sin02_squared });

impl<R: Real> Opposite<R> {
    #[inline(always)]
    fn new(corners: &Corners<R>, side: &Side<R>, planes: &Planes<R>, along: Vec3<R>) -> Self {
        let ([v0, _, v2], [i0, _, i2]) = (corners.v, corners.inverse);
        let one = R::lit(1.0);
        Self {
            // as (V₀/l₀ + V₁/l₁)·V₂/l₂, so that opposite unit vectors cancel first
            total: (v0 * i0 + corners.apex).dot(v2).mul_add(i2, side.g2),
            x2: along.dot(planes.edge) * i2,
            y2: planes.volume.abs() * side.inverse * i2,
            one_plus_d02: one + corners.d02,
            one_plus_d12: one + corners.d12,
            sin02_squared: planes.n02.length_squared() * (i0 * i2) * (i0 * i2),
        }
    }
    /// The same where a side of more than 120° needs sums of nearly opposite unit vectors. By value: what a closure borrows is copied where it
    /// is not inlined.
    #[inline]
    fn widened(mut self, corners: Corners<R>, inverse: R, [n01, n02, n12]: [Vec3<R>; 3]) -> Self {
        let ([v0, v1, v2], [i0, i1, i2]) = (corners.v, corners.inverse);
        let Corners { d01, d02, d12, .. } = corners;
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let s01 = sum_of_units([v0, v1], [i0, i1], n01);
        let s02 = sum_of_units([v0, v2], [i0, i2], n02);
        let s12 = sum_of_units([v1, v2], [i1, i2], n12);
        // T at the vertex to which the others are least opposite
        let (at0, at1, at2) = (s01.dot(s02), s01.dot(s12), s02.dot(s12));
        self.total = R::blend(d01.gt(d02.greater(d12)), at2, R::blend(d02.gt(d12), at1, at0));
        self.x2 = -(n01.dot(n12) * inverse * i1 * i2);
        let behind = self.x2.mul_add(self.x2, self.y2 * self.y2) / (one + d12.abs());
        self.one_plus_d12 = R::blend(d12.lt(zero), behind, self.one_plus_d12);
        let behind = self.sin02_squared / (one + d02.abs());
        self.one_plus_d02 = R::blend(d02.lt(zero), behind, self.one_plus_d02);
        self
    }
}

/// Va/lₐ + Vb/l_b for a and b more than 90° apart, given n = Va×Vb: accurate relative to its own size, from the foot of the
/// perpendicular on the line through both.
#[inline]
fn sum_of_units<R: Real>([a, b]: [Vec3<R>; 2], [ia, ib]: [R; 2], n: Vec3<R>) -> Vec3<R> {
    let (zero, one) = (R::lit(0.0), R::lit(1.0));
    let plain = a * ia + b * ib;
    let opposite = a.dot(b).lt(zero);
    let edge = b - a;
    let squared = edge.length_squared();
    let some = squared.gt(R::lit(1e-36));
    let inverse = rsqrt(R::blend(some, squared, one));
    let by = inverse * inverse;
    let foot = edge.cross(n) * by;
    let height = n.length_squared() * by;
    let along = edge * inverse;
    // 1 − |a·along|/lₐ
    let lack = |v: Vec3<R>, i: R| height * i * i / (one + v.dot(along).abs() * i);
    let sum = foot.mul_add(ia + ib, along * (lack(a, ia) - lack(b, ib)));
    Vec3::blend(opposite & some, sum, plain)
}

/// The solid angle Ω, and H = Ω/2.
struct Half<R> {
    solid_angle: R,
    /// (sinH, cosH)
    half: Vec2<R>,
    /// 1/sinH
    inv_sin: R,
    /// 1/G₀
    inv_g0: R,
}

impl<R: Real> Half<R> {
    #[inline(always)]
    fn new(g0: R, total: R, some: R::Mask) -> Self {
        let solid_angle = (R::lit(2.0) * g0.atan2(total)).keep(some & g0.gt(R::lit(0.0)));
        let inv_g0 = R::lit(1.0) / R::blend(g0.gt(R::lit(1e-37)), g0, R::lit(1.0));
        let squared = g0.mul_add(g0, total * total).greater(R::lit(1e-36));
        let over = rsqrt(squared);
        Self { solid_angle, half: Vec2::new(g0 * over, total * over), inv_sin: inv_g0 * squared * over, inv_g0 }
    }
    /// (sin, cos)(α−H)/sinα from v2, where the sweep ends: P there has the coordinates (X, Y) = tan(δ₂/2) (cosψ, sinψ), δ₂ the arc from v1 to v2
    /// and ψ its angle at v1 with the side c.
    #[inline(always)]
    fn turned(&self, side: &Side<R>, opposite: &Opposite<R>) -> Vec2<R> {
        let by_plus = R::lit(1.0) / opposite.one_plus_d12.greater(R::lit(1e-30));
        // sin c / (2 sinH)
        let by_swept = R::lit(0.5) * side.sin * self.inv_sin;
        let some = by_swept.lt(R::lit(1e30));
        let most = R::lit(1e18);
        Vec2::new(
            (opposite.y2 * by_plus * by_swept).lesser(most).keep(some),
            (opposite.x2.mul_add(-by_plus, side.tan_half) * by_swept).clamped(-most, most).keep(some),
        )
    }
}

/// cotα at v0, from sinα : cosα = |volume| l₀ : n₀₁·n₀₂, and where it is known: the sine of a narrower angle would underflow.
#[inline(always)]
fn cot_alpha<R: Real>(corners: &Corners<R>, planes: &Planes<R>) -> (R, R::Mask) {
    let opposite = planes.volume.abs() * corners.length[0];
    let angle = opposite.gt(R::lit(1e-37));
    ((planes.n01.dot(planes.n02) / R::blend(angle, opposite, R::lit(1.0))).keep(angle), angle)
}

/// True where the plane through each side is known: the square of a shorter normal would underflow. A side on whose line the point lies, between
/// its ends, has a plane that is short as well; only the map, which begins at v0 v1, cannot do without it.
#[inline(always)]
fn measurable<R: Real>(corners: &Corners<R>, side: &Side<R>, opposite: &Opposite<R>, planes: &Planes<R>) -> R::Mask {
    let ([_, l1, l2], &Opposite { x2, y2, .. }) = (corners.length, opposite);
    let (zero, both) = (R::lit(0.0), l1 * l2);
    let known = |squared: R, d: R| squared.gt(R::lit(LEAST_SQUARED)) | d.lt(zero);
    let side02 = known(planes.n02.length_squared(), corners.d02);
    // |V₁×V₂|, which samples alone need not
    let side12 = known(x2.mul_add(x2, y2 * y2) * (both * both), corners.d12);
    side.inverse.gt(zero) & side02 & side12
}

/// How far a direction may be beyond each plane. The map starts from the great circle through v0 and v1; that one, and any through nearly
/// opposite vertices, is known only to −cos : sin of their angle. The map reaches the one through v1 and v2 along the one from v0 to v2.
#[inline(always)]
fn slack<R: Real>(corners: &Corners<R>, side: &Side<R>, opposite: &Opposite<R>, planes: &Planes<R>) -> Vec3<R> {
    let (zero, one, [v0, v1, v2]) = (R::lit(0.0), R::lit(1.0), corners.v);
    let start = -corners.d01 / R::blend(side.sin.gt(zero), side.sin, one);
    let start = start.greater(one).lesser(R::lit(1e18));
    let far = start.greater(-corners.d02 * rsqrt(opposite.sin02_squared.greater(R::lit(1e-7))));
    let of =
        |n: Vec3<R>, a: Vec3<R>, b: Vec3<R>, known: R| (n.length() * known).greater(-a.dot(b)) * R::lit(SURFACE_SLACK);
    Vec3::new(of(planes.n01, v0, v1, start), of(planes.n12, v1, v2, far), of(planes.n02, v2, v0, start))
}

impl<R: Real> SphericalTriangle<R> {
    /// Prepares vertices scaled so that all lengths are below 4. Where a side is wide, the length of V₁×V₂ counts: `exact` returns it
    /// accurate relative to itself.
    #[inline(always)]
    pub(in crate::light) fn prepare(
        vertices: [Vec3<R>; 3],
        mut planes: Planes<R>,
        exact: impl FnOnce() -> Vec3<R>,
        scale: R,
    ) -> Self {
        let corners = Corners::new(vertices);
        let side = Side::new(&corners, planes.n01);
        // the frame at v1
        let pole = planes.n01 * side.inverse;
        let along = corners.apex.cross(pole);
        let mut opposite = Opposite::new(&corners, &side, &planes, along);
        let far = corners.inverse[2].gt(corners.inverse[1] * R::lit(FAR));
        opposite.x2 = R::where_any(far, opposite.x2, || along.dot(corners.v[2]) * corners.inverse[2]);
        // a side of more than 120° is rare: do the extra work only where there is one
        let wide = corners.d01.lesser(corners.d02).lesser(corners.d12).lt(R::lit(-0.5));
        (planes.n12, opposite) = R::where_any(wide, (planes.n12, opposite), || {
            let n12 = exact();
            (n12, opposite.widened(corners, side.inverse, [planes.n01, planes.n02, n12]))
        });
        let [i0, i1, i2] = corners.inverse;
        let g0 = planes.volume.abs() * i0 * i1 * i2;
        let (cot_alpha, angle) = cot_alpha(&corners, &planes);
        let some = corners.apart() & measurable(&corners, &side, &opposite, &planes) & angle;
        let half = Half::new(g0, opposite.total, some);
        let behind = planes.volume.lt(R::lit(0.0));
        let inwards = |n: Vec3<R>| Vec3::blend(behind, -n, n);
        let [l0, l1, l2] = corners.length;
        Self {
            side01: inwards(planes.n01),
            side12: inwards(planes.n12),
            side20: inwards(-planes.n02),
            slack: slack(&corners, &side, &opposite, &planes),
            normal: planes.normal,
            l1,
            farthest: l0.greater(l1).greater(l2),
            apex: corners.apex,
            along,
            across: inwards(pole),
            cot_alpha,
            stretch: side.stretch,
            tan_half: side.tan_half,
            half: half.half,
            turned: half.turned(&side, &opposite),
            sin_side: side.sin,
            inv_l0: i0,
            inv_l2: i2,
            cot_half: opposite.total * half.inv_g0,
            inv_half_sin: half.inv_sin,
            g2: side.g2,
            g2_over_g0: side.g2 * half.inv_g0,
            one_plus_d02: opposite.one_plus_d02,
            sin02_squared: opposite.sin02_squared,
            x2: opposite.x2,
            y2: opposite.y2,
            g1: opposite.total - side.g2,
            volume: planes.volume,
            solid_angle: half.solid_angle,
            unit: scale.pow2_scale(),
        }
    }
}
