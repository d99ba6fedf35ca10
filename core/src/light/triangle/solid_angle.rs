//! Triangles by solid angle.

mod inverse;
mod prepare;

use crate::lanewise::lanewise;
use crate::light::direction::{DirectionSample, to_unit};
use crate::light::seen::SphericalShape;
use crate::light::surface::SURFACE_SLACK;
use crate::math::rsqrt;
use crate::real::{Mask, Real, blended, unit_interval};
use crate::vector::double_word::{cross_dw, height_over, sum_dw};
use crate::vector::{Vec2, Vec3};
use crate::warp::Warp;

/// Bound of what rounding takes from the distance to the third plane that follows from the others, in units of their normals.
const SURELY: f64 = 32.0 / 16_777_216.0;
/// What turns half of an angle in radians into turns.
const INV_FOUR_PI: f64 = 0.25 / core::f64::consts::PI;

lanewise! {
    /// Directions from a point to a triangle, uniform in solid angle: for every triangle; far ones are cheaper by area.
    ///
    /// [`Triangle::by_solid_angle`](crate::Triangle::by_solid_angle) says how.
    pub struct SphericalTriangle {
        /// normal of the plane through the viewpoint, v0 and v1, pointing inwards
        side01: Vec3<R>,
        /// the same for v1 and v2
        side12: Vec3<R>,
        /// the same for v2 and v0
        side20: Vec3<R>,
        /// tolerances of these planes: w is inside one if w·side ≥ −slack
        slack: Vec3<R>,
        /// E₁×E₂
        normal: Vec3<R>,
        /// l₁, in units of `unit`
        l1: R,
        /// max(l₀, l₁, l₂), an upper bound of every distance
        farthest: R,
        /// V₁/l₁
        apex: Vec3<R>,
        /// unit tangent at v1 towards v0
        along: Vec3<R>,
        /// unit tangent at v1 perpendicular to `along`, towards v2
        across: Vec3<R>,
        /// cotα, α the angle at v0
        cot_alpha: R,
        /// 2/sin c, c the side v0 v1
        stretch: R,
        /// k = tan(c/2)
        tan_half: R,
        /// (sinH, cosH), H = Ω/2
        half: Vec2<R>,
        /// (sin(α−H), cos(α−H))/sinα
        turned: Vec2<R>,
        /// sin c
        sin_side: R,
        /// 1/l₀
        inv_l0: R,
        /// 1/l₂
        inv_l2: R,
        /// T/G₀ = (G₁+G₂)/G₀ = cotH, with G₁ = d₀₂+d₁₂
        cot_half: R,
        /// 1/sinH
        inv_half_sin: R,
        /// G₂ = 1+d₀₁
        g2: R,
        /// G₂/G₀
        g2_over_g0: R,
        /// 1+d₀₂
        one_plus_d02: R,
        /// 1−d₀₂², the squared sine of the side v0 v2
        sin02_squared: R,
        /// V₂/l₂ along `along`
        x2: R,
        /// V₂/l₂ along `across`
        y2: R,
        /// G₁ = T − G₂
        g1: R,
        /// V₀·(E₁×E₂): negative where the point is on the side to which E₁×E₂ points
        volume: R,
        /// Ω in steradians
        solid_angle: R,
        /// unit of the lengths above, a power of two
        unit: R,
    }
}

/// Quantities that callers know more accurately than the rounded vertices give them.
#[derive(Clone, Copy)]
pub(in crate::light) struct Planes<R> {
    /// V₀×V₁
    pub(in crate::light) n01: Vec3<R>,
    /// V₀×V₂
    pub(in crate::light) n02: Vec3<R>,
    /// V₁×V₂
    pub(in crate::light) n12: Vec3<R>,
    /// E₁×E₂
    pub(in crate::light) normal: Vec3<R>,
    /// V·(E₁×E₂), the same for every vertex V
    pub(in crate::light) volume: R,
    /// v2−v1
    pub(in crate::light) edge: Vec3<R>,
}

impl<R: Real> SphericalTriangle<R> {
    /// Prepares for the vertices relative to the point and the edges `e1` = v1−v0 and `e2` = v2−v0, in any unit of length. The edges give the
    /// shape of a small and far triangle, and the planes through the point are those of `v0` and the edges.
    #[inline(always)]
    pub fn with_edges(v0: Vec3<R>, v1: Vec3<R>, v2: Vec3<R>, e1: Vec3<R>, e2: Vec3<R>) -> Self {
        let ([v0, v1, v2, e1, e2], scale) = to_unit([v0, v1, v2, e1, e2]);
        let normal = e1.cross(e2);
        let (volume, edge) = (height_over(v0, [e1, e2], normal), e2 - e1);
        // from the nearer vertex, the rounding of the edge moves neither by more than its own
        let nearer = Vec3::blend(v1.length_squared().lt(v2.length_squared()), v1, v2);
        let (n01, n02, n12) = (v0.cross(e1), v0.cross(e2), nearer.cross(edge));
        // v1×v2 = (v0+e1)×(v0+e2)
        let exact = || {
            let [n12, rest] = sum_dw(cross_dw(e1, e2), sum_dw(cross_dw(v0, e2), cross_dw(e1, v0)));
            n12 + rest
        };
        Self::prepare([v0, v1, v2], Planes { n01, n02, n12, normal, volume, edge }, exact, scale)
    }

    /// Without a solid angle where not `some`.
    #[inline(always)]
    pub(in crate::light) fn keep(self, some: R::Mask) -> Self {
        Self { solid_angle: self.solid_angle.keep(some), ..self }
    }

    /// Direction, distance and barycentric coordinates, where 1−u₀ is known more accurately than the difference gives it.
    #[inline(always)]
    pub(in crate::light) fn sample_point_from(&self, u: Vec2<R>, rest: R) -> (DirectionSample<R>, [R; 3]) {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let arc = self.arc(u.x, rest);
        let (direction, z, sin_over) = self.along_arc(&arc, u.y);
        let [w0, w2] = self.weights(arc.swept);
        let inv_p = w0.mul_add(self.inv_l0, w2 * self.inv_l2);
        // direction = kV₁/l₁ + tP/|P| with t = sin/sin∠(V₁,P), k = z − t cos; so l₁/distance = k + tl₁/|P|, also at grazing;
        // sin∠(V₁,P) = 2√M/(1+M)
        let t = sin_over * R::lit(0.5) * (one + arc.m);
        let behind = arc.m.gt(one);
        let cos_abs = (one - arc.m).abs() / (one + arc.m);
        // k = (z² − t²c²)/(z + tc) = (1−u₁)(z+c)/((1+c)(z+tc))
        let denominator = (one + cos_abs) * t.mul_add(cos_abs, z);
        let k = (one - u.y) * (z + cos_abs) / R::blend(denominator.gt(zero), denominator, one);
        let reciprocal = t.mul_add(inv_p * self.l1, k);
        // where P lies behind v1 the sum cancels, but then the triangle is large, and its plane will do
        let numerator = R::blend(behind, self.volume.abs(), self.l1);
        let denominator = R::blend(behind, direction.dot(self.normal).abs(), reciprocal);
        let some = denominator.gt(zero) & self.solid_angle.gt(zero);
        // a distance that does not fit f32 becomes the largest finite number
        let distance = (numerator / R::blend(some, denominator, one)).lesser(self.farthest).keep(some);
        // the point is the sum of the vertices with these weights
        let part = |weight: R| (weight * distance).lesser(one);
        let (b0, b2) = (part(t * w0 * self.inv_l0), part(t * w2 * self.inv_l2));
        let b1 = R::blend(behind, (one - b0 - b2).greater(zero), part(k / self.l1.greater(R::lit(1e-37))));
        let distance = (distance * self.unit).lesser(R::lit(f64::from(f32::MAX)));
        (DirectionSample { direction, distance }, [b0, b1, b2])
    }

    /// As `sample`, where 1−u₀ is known more accurately than the difference gives it.
    #[inline(always)]
    pub(in crate::light) fn sample_from(&self, u: Vec2<R>, rest: R) -> Vec3<R> {
        self.along_arc(&self.arc(u.x, rest), u.y).0
    }

    /// Tells whether a direction hits the triangle; allows for the rounding of the direction itself.
    #[inline(always)]
    pub fn contains(&self, w: Vec3<R>) -> R::Mask {
        let mut inside = self.surely_contains(w);
        // most directions are not beside an edge: prepare its plane exactly, and its tolerance, only where one is
        if !inside.all() {
            let exactly = self.within_v1_v2(w) & self.within_v2_v0(w) & self.within_v0_v1(w) & self.ahead(w);
            inside = inside | exactly;
        }
        inside
    }
    /// True only for directions that the triangle contains whatever its tolerances are, since V₁×V₂ = E₁×E₂ + V₀×V₂ − V₀×V₁.
    #[inline(always)]
    fn surely_contains(&self, w: Vec3<R>) -> R::Mask {
        let zero = R::lit(0.0);
        let (start, end) = (w.dot(self.side01), w.dot(self.side20));
        let ahead = w.dot(self.normal).negate_where(self.in_front());
        let size = self.side01.max_abs() + self.side20.max_abs() + self.normal.max_abs();
        let far = ahead - end - start;
        start.ge(zero) & end.ge(zero) & ahead.ge(zero) & far.gt(size * R::lit(SURELY))
    }
    #[inline(always)]
    pub(in crate::light) fn within_v1_v2(&self, w: Vec3<R>) -> R::Mask {
        w.dot(self.side12).ge(-self.slack.y)
    }
    #[inline(always)]
    pub(in crate::light) fn within_v2_v0(&self, w: Vec3<R>) -> R::Mask {
        w.dot(self.side20).ge(-self.slack.z)
    }
    #[inline(always)]
    pub(in crate::light) fn within_v0_v1(&self, w: Vec3<R>) -> R::Mask {
        w.dot(self.side01).ge(-self.slack.x)
    }
    /// Tells whether the direction leads towards the triangle's plane.
    #[inline(always)]
    pub(in crate::light) fn ahead(&self, w: Vec3<R>) -> R::Mask {
        let slack = self.normal.length() * R::lit(SURFACE_SLACK);
        w.dot(self.normal).negate_where(self.in_front()).ge(-slack)
    }
    /// Tells whether v2 and the direction lie on opposite sides of the plane through the viewpoint, v0 and v1.
    #[inline(always)]
    pub(in crate::light) fn beyond_v0_v1(&self, w: Vec3<R>) -> R::Mask {
        w.dot(self.across).lt(R::lit(0.0))
    }
}

/// The arc from `v1` to the point P of the far edge.
#[derive(Clone, Copy)]
struct Arc<R> {
    /// X, the stereographic projection of P from opposite `v1`, towards v0: tan(θ/2) cosφ
    x: R,
    /// Y, the same perpendicular to it: tan(θ/2) sinφ
    y: R,
    /// M = X² + Y² = tan²(θ/2)
    m: R,
    /// sinη, and r = sin(H−η)/sinH
    swept: [R; 2],
}
blended!(Arc { x, y, m, swept });

impl<R: Real> SphericalTriangle<R> {
    /// The arc that cuts off the share `u` of the area and leaves `rest` = 1−u.
    #[inline(always)]
    fn arc(&self, u: R, rest: R) -> Arc<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        // from the nearer end: near the other, α−η and H−η are small differences
        let far = u.gt(R::lit(0.5));
        let part = R::blend(far, rest, u);
        let (sin, cos) = (part * self.solid_angle * R::lit(INV_FOUR_PI)).sin_cos_turns();
        let s = R::blend(far, self.half.x * cos - self.half.y * sin, sin);
        // cos(α−η) and sin(α−η), over sinα
        let from_sin = R::blend(far, self.turned.x, one);
        let from_cos = R::blend(far, self.turned.y, -self.cot_alpha);
        let turn_sin = from_sin.mul_add(cos, from_cos * sin);
        let turn_cos = from_cos.mul_add(cos, -(from_sin * sin)).negate_where(!far);
        let stretched = s * self.stretch;
        // P opposite v1 would be at infinity; keep its square finite
        let most = R::lit(1e15);
        let x = (-stretched).mul_add(turn_cos, self.tan_half).clamped(-most, most);
        let y = (stretched * turn_sin).clamped(zero, most);
        let left = R::blend(far, sin * self.inv_half_sin, (-sin).mul_add(self.cot_half, cos));
        let arc = Arc { x, y, m: x.mul_add(x, y * y), swept: [s, left] };
        // a side of more than 120° is rare: do the extra work only where there is one
        let long = self.g2.lt(R::lit(0.5));
        R::where_any(long, arc, || self.opposite_arc(arc))
    }

    /// Where v0 lies nearly opposite v1, the angle no longer determines the arc: takes it from P itself where that is better
    /// conditioned.
    #[inline]
    fn opposite_arc(&self, arc: Arc<R>) -> Arc<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let [w0, w2] = self.weights(arc.swept);
        // 1 + P·V₁/l₁ with V₁/l₁ = −V₀/l₀ + S, where S·V₀/l₀ = G₂ and S·V₂/l₂ = G₁ are small; 1 − P·V₀/l₀ comes from the sine
        let along = w2.mul_add(self.one_plus_d02 - one, w0);
        let apart = R::blend(along.gt(zero), w2 * w2 * self.sin02_squared / (one + along.greater(zero)), one - along);
        let sum = w0.mul_add(self.g2, apart + w2 * self.g1.abs());
        let plus = w0.mul_add(self.g2, apart + w2 * self.g1);
        let inverse = one / plus.greater(R::lit(1e-30));
        let (first, second) = (w0 * self.sin_side * inverse, w2 * self.x2 * inverse);
        // either X is a sum: of these two terms, or of tan(c/2) and the rest; take the one with less cancellation. The weights
        // of P sum to at least 1, unless v0 is opposite v1 to the last bit, which loses them
        let better = plus.gt(sum * R::lit(0.125))
            & (w0 + w2).gt(R::lit(0.5))
            & (first + second.abs()).lt(self.tan_half.greater(arc.x.abs()));
        let most = R::lit(1e15);
        let x = R::blend(better, (first + second).clamped(-most, most), arc.x);
        let y = R::blend(better, (w2 * self.y2 * inverse).lesser(most), arc.y);
        Arc { x, y, m: x.mul_add(x, y * y), swept: arc.swept }
    }

    /// The weights w₀ and w₂ of P = w₀V₀/l₀ + w₂V₂/l₂.
    #[inline(always)]
    fn weights(&self, [s, left]: [R; 2]) -> [R; 2] {
        let (zero, two) = (R::lit(0.0), R::lit(2.0));
        // r = a − b = cosη − sinη (G₁+G₂)/G₀ = sin(H−η)/sinH
        let b = s * self.g2_over_g0;
        let a = left + b;
        let w0 = (left * (a + b)).greater(zero);
        // b d₀₂ + a, w₂ − w₀ and |P|²: small differences where v0 and v2 are nearly opposite
        let w2 = (two * b * b.mul_add(self.one_plus_d02, left)).greater(zero);
        let more = two * b * b * self.one_plus_d02 - left * left;
        let squared = more.mul_add(more, two * self.one_plus_d02 * w0 * w2);
        let inverse = rsqrt(squared.greater(R::lit(1e-30)));
        [w0 * inverse, w2 * inverse]
    }

    /// The direction at `u` along the arc, the cosine z of its angle to v1, and the sine of that angle over √M.
    #[inline]
    fn along_arc(&self, arc: &Arc<R>, u: R) -> (Vec3<R>, R, R) {
        let (zero, one, two) = (R::lit(0.0), R::lit(1.0), R::lit(2.0));
        // 1−z = 2uM/(1+M), and the sine over √M
        let over = u * (two / (one + arc.m));
        let z = (-over).mul_add(arc.m, one);
        // 1+z = 2(1 + (1−u)M)/(1+M): near the antipode of v1, z no longer determines the sine
        let plus = (one - u).mul_add(arc.m, one) * (two / (one + arc.m));
        let sin_over = (over * plus).greater(zero).sqrt();
        let tangent = self.along.mul_add(arc.x, self.across * arc.y);
        let direction = self.apex.mul_add(z, tangent * sin_over);
        // a unit vector up to rounding: one Newton step for 1/√
        let unit = direction * direction.length_squared().mul_add(R::lit(-0.5), R::lit(1.5));
        (unit, z, sin_over)
    }
}

impl<R: Real> SphericalShape<R> for SphericalTriangle<R> {
    #[inline(always)]
    fn sample_point(&self, u: Vec2<R>) -> (DirectionSample<R>, Option<Vec2<R>>) {
        let (sample, [_, b1, b2]) = self.sample_point_from(u, R::lit(1.0) - u.x);
        (sample, Some(Vec2::new(b1, b2)))
    }
    #[inline(always)]
    fn solid_angle(&self) -> R {
        self.solid_angle
    }
    #[inline(always)]
    fn in_front(&self) -> R::Mask {
        self.volume.lt(R::lit(0.0))
    }
}

impl<R: Real> Warp<R> for SphericalTriangle<R> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        self.sample_from(u, R::lit(1.0) - u.x)
    }
    /// The pdf per steradian; 0 for a direction that misses the triangle.
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        self.uniform_pdf().keep(self.contains(w))
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let (u, moved) = self.locate(w);
        let whole = self.solid_angle;
        let steep = self.steep(whole);
        R::where_any(steep, u, || {
            let one = R::lit(1.0);
            let off = self.area_beyond(u.x, one - u.x, w, whole) / whole.greater(R::lit(1e-37));
            let x = unit_interval(u.x + off);
            Vec2 { x, y: self.share_of_arc(x, one - x, moved) }
        })
    }
}
