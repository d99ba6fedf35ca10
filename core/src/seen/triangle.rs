use super::{Sighting, lanewise};
use crate::math::rsqrt;
use crate::real::{Mask, Real};
use crate::vector::{Vec2, Vec3};
use crate::warp::{Warp, unit_interval};

/// Angle by which a sample may leave a triangle through the error of its direction: 12 ulp of a component near 1.
const BEYOND: f64 = 12.0 / 16_777_216.0;
/// The same of one that is drawn by projected solid angle.
pub(super) const SLACK: f64 = 8.0 / 16_777_216.0;
const INV_TWO_PI: f64 = 0.5 / core::f64::consts::PI;

lanewise! {
    /// The directions from a point to a triangle, uniform by solid angle.
    ///
    /// The map is Arvo's: u₀ sweeps the great circle through the vertex `v1` from `v0` to `v2` so that the swept area is u₀Ω, and u₁
    /// moves away from `v1` uniformly in 1−cos. Small differences come from the edges and never from unit vectors, so that a
    /// triangle of 1e−9 of its distance is sampled as well as a large one; directions come from unit vectors and never from
    /// points of the plane, so that the plane may be as near as it likes.
    ///
    /// - Formula: with V from the point, E₁ = v1−v0, E₂ = v2−v0, lengths l and cosines d between the V:
    ///   tan(Ω/2) = |V₀·(E₁×E₂)| / (l₀l₁l₂ + (V₀·V₁)l₂ + (V₀·V₂)l₁ + (V₁·V₂)l₀).
    ///   With c the side v0 v1, α the angle at v0, η = u₀Ω/2 and k = tan(c/2), the point P of the far edge lies, in stereographic projection
    ///   from opposite v1, at X = k − σ cos(α−η)/sinα, Y = σ sin(α−η)/sinα, σ = 2 sinη/sin c. With M = X² + Y² = tan²(∠(V₁,P)/2)
    ///   and g = 2u₁/(1+M) the direction is zV₁/l₁ + √(g(1+z)) (X, Y), z = 1 − gM, with X along the tangent towards v0. Where c is
    ///   long, M comes from P = ((a−b)(a+b) V₀/l₀ + 2b(a+bd₀₂) V₂/l₂)/|·|, a = cosη − (d₀₂+d₁₂) sinη/G₀, b = (1+d₀₁) sinη/G₀,
    ///   G₀ = |V₀·(E₁×E₂)|/(l₀l₁l₂), if that is the better conditioned; so does the distance.
    /// - Domain: u in [0, 1)²; any triangle, from any side.
    /// - Density: 1/Ω per steradian inside (and within 12 ulp of the direction beyond), 0 outside.
    /// - Degenerate: the point in the plane (also inside the triangle), zero area, or lengths whose sums overflow: Ω = 0 and pdf 0.
    /// - Greatest error: direction 5.4e−7, at any size, elevation and aspect; more by 1/sin of the angle between two vertices that lie
    ///   nearly opposite (the point is near an edge), and near the far edge by a few steps of u where Ω > π. Ω 1.2e−7, more by 1/sin
    ///   of the elevation of the nearest vertex. Distance 5.4e−7 of itself over |cos| at the plane, and of the farthest vertex.
    ///   The inverse is that of a direction 6e−7 away, times how much longer than wide the triangle is seen.
    /// - Source: Arvo 1995, "Stratified Sampling of Spherical Triangles"; Van Oosterom and Strackee 1983 for Ω; Peters 2021,
    ///   "BRDF Importance Sampling for Polygonal Lights", section 3, for the form without inverse trigonometry; here on edges.
    SphericalTriangle {
        v0: Vec3<R>,
        v1: Vec3<R>,
        v2: Vec3<R>,
        e1: Vec3<R>,
        e2: Vec3<R>,
        normal: Vec3<R>,
        l1: R,
        /// distance of the farthest vertex: that of no point is more
        farthest: R,
        /// unit vector to `v1`, and tangents there: towards `v0`, and across towards `v2`
        apex: Vec3<R>,
        along: Vec3<R>,
        across: Vec3<R>,
        /// cotangent of the angle at `v0`; 2/sin(side v0 v1); tangent of half that side
        cot_alpha: R,
        stretch: R,
        tan_half: R,
        /// sine of the side v0 v1
        sin_side: R,
        inv_l0: R,
        inv_l2: R,
        /// G₁/G₀; G₂; G₂/G₀
        g1: R,
        g2: R,
        g2_over: R,
        d02: R,
        d12: R,
        /// V₀·(E₁×E₂), signed: negative where the point is on the side of the normal (v1−v0)×(v2−v0)
        volume: R,
        solid_angle: R,
        unit: R,
    }
}

/// a×b = a×(b−a), from the shorter of the two: each is good to parts in 2²⁴ of itself.
#[inline(always)]
pub(super) fn plane<R: Real>(a: Vec3<R>, b: Vec3<R>, edge: Vec3<R>) -> Vec3<R> {
    a.cross(Vec3::select(edge.length_squared().lt(b.length_squared()), edge, b))
}

/// The arc from `v1` to the point P of the far edge.
struct Arc<R> {
    /// P in stereographic projection from opposite `v1`: tan(θ/2) times the cosine and the sine of the angle turned by
    x: R,
    y: R,
    /// tan²(θ/2)
    m: R,
    /// sine and cosine of the half of the area swept
    swept: [R; 2],
}

impl<R: Real> SphericalTriangle<R> {
    /// For a triangle with vertices `v0`, `v1`, `v2` relative to the point.
    #[inline(always)]
    pub fn new(v0: Vec3<R>, v1: Vec3<R>, v2: Vec3<R>) -> Self {
        let scale = v0.max_abs().max(v1.max_abs()).max(v2.max_abs()).exponent_reciprocal();
        let (v0, v1, v2) = (v0 * scale, v1 * scale, v2 * scale);
        let (e1, e2) = (v1 - v0, v2 - v0);
        Self::prepare([v0, v1, v2], [e1, e2, e1.cross(e2)], scale)
    }

    /// As `new`, with the edges `e1` = v1−v0 and `e2` = v2−v0 where they are known better than the difference of vertices that
    /// were moved to the point: for a small and far triangle they hold its shape.
    #[inline(always)]
    pub fn with_edges(v0: Vec3<R>, v1: Vec3<R>, v2: Vec3<R>, e1: Vec3<R>, e2: Vec3<R>) -> Self {
        Self::with_normal([v0, v1, v2], [e1, e2], [e1, e2])
    }

    /// As `with_edges`, with the normal as the product of two vectors, for edges that are themselves rounded sums.
    #[inline(always)]
    pub(super) fn with_normal(vertices: [Vec3<R>; 3], edges: [Vec3<R>; 2], factors: [Vec3<R>; 2]) -> Self {
        let reach = |all: &[Vec3<R>]| all.iter().fold(R::lit(0.0), |most, v| most.max(v.max_abs()));
        let reach = reach(&vertices).max(reach(&edges));
        // sums that overflowed: a triangle of no extent
        let finite = reach.lt(R::lit(f64::INFINITY));
        let scale = reach.exponent_reciprocal();
        let scaled = |v: Vec3<R>| Vec3::new(v.x.keep(finite), v.y.keep(finite), v.z.keep(finite)) * scale;
        let [e1, e2] = edges.map(scaled);
        let [f1, f2] = factors.map(scaled);
        Self::prepare(vertices.map(scaled), [e1, e2, f1.cross(f2)], scale)
    }

    /// With all lengths below 4.
    #[inline(always)]
    fn prepare([v0, v1, v2]: [Vec3<R>; 3], [e1, e2, normal]: [Vec3<R>; 3], scale: R) -> Self {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let squared = [v0, v1, v2].map(Vec3::length_squared);
        let [i0, i1, i2] = squared.map(|s| rsqrt(s).keep(s.gt(R::lit(1e-36))));
        let (d01, d02) = (v0.dot(v1) * i0 * i1, v0.dot(v2) * i0 * i2);
        // the same at each vertex; at the nearest it cancels least
        let (n01, n02) = (plane(v0, v1, e1), plane(v0, v2, e2));
        let inverse = |n: Vec3<R>| {
            let squared = n.length_squared();
            rsqrt(squared).keep(squared.gt(R::lit(1e-37)))
        };
        let i01 = inverse(n01);
        let (l0, l1) = (squared[0] * i0, squared[1] * i1);
        let sin_side = n01.length_squared() * i01 * i0 * i1;
        let inv_sin_side = i01 * l0 * l1;
        // 1−d₀₁ and 1+d₀₁, the small one from the sine
        let small = sin_side * sin_side / (one + d01.abs());
        let obtuse = d01.lt(zero);
        let (minus, g2) = (R::select(obtuse, one - d01, small), R::select(obtuse, small, one + d01));
        let nearest = Vec3::select(squared[1].lt(squared[0]), v1, v0);
        let nearest = Vec3::select(squared[2].lt(squared[0].min(squared[1])), v2, nearest);
        let volume = nearest.dot(normal);
        let g0 = volume.abs() * i0 * i1 * i2;
        // (V₀/l₀ + V₁/l₁)·V₂/l₂, so that opposite unit vectors cancel first
        let apex = v1 * i1;
        let g1 = (v0 * i0 + apex).dot(v2) * i2;
        let towards = volume.lt(zero);
        let pole = n01 * i01;
        let across = Vec3::select(towards, -pole, pole);
        // sinα : cosα = |volume| l₀ : n₀₁·n₀₂
        let opposite = volume.abs() * l0;
        let angle = opposite.gt(R::lit(1e-37));
        let cot_alpha = (n01.dot(n02) / R::select(angle, opposite, one)).keep(angle);
        // at a vertex all of them are 0, and so is the angle
        let somewhere = i0.gt(zero) & i1.gt(zero) & i2.gt(zero) & g0.gt(zero);
        let solid_angle = (R::lit(2.0) * g0.atan2(g1 + g2)).keep(somewhere);
        let inv_g0 = one / R::select(g0.gt(R::lit(1e-37)), g0, one);
        Self {
            v0,
            v1,
            v2,
            e1,
            e2,
            normal,
            l1,
            farthest: l0.max(l1).max(squared[2] * i2),
            apex,
            along: apex.cross(pole),
            across,
            cot_alpha,
            stretch: R::lit(2.0) * inv_sin_side,
            tan_half: minus * inv_sin_side,
            sin_side,
            inv_l0: i0,
            inv_l2: i2,
            g1: g1 * inv_g0,
            g2,
            g2_over: g2 * inv_g0,
            d02,
            d12: apex.dot(v2) * i2,
            volume,
            solid_angle,
            unit: scale.exponent_reciprocal(),
        }
    }

    /// `yes` where the mask is true, `no` elsewhere.
    #[inline(always)]
    pub(crate) fn select(mask: R::Mask, yes: &Self, no: &Self) -> Self {
        let real = |a, b| R::select(mask, a, b);
        let vector = |a, b| Vec3::select(mask, a, b);
        Self {
            v0: vector(yes.v0, no.v0),
            v1: vector(yes.v1, no.v1),
            v2: vector(yes.v2, no.v2),
            e1: vector(yes.e1, no.e1),
            e2: vector(yes.e2, no.e2),
            normal: vector(yes.normal, no.normal),
            l1: real(yes.l1, no.l1),
            farthest: real(yes.farthest, no.farthest),
            apex: vector(yes.apex, no.apex),
            along: vector(yes.along, no.along),
            across: vector(yes.across, no.across),
            cot_alpha: real(yes.cot_alpha, no.cot_alpha),
            stretch: real(yes.stretch, no.stretch),
            tan_half: real(yes.tan_half, no.tan_half),
            sin_side: real(yes.sin_side, no.sin_side),
            inv_l0: real(yes.inv_l0, no.inv_l0),
            inv_l2: real(yes.inv_l2, no.inv_l2),
            g1: real(yes.g1, no.g1),
            g2: real(yes.g2, no.g2),
            g2_over: real(yes.g2_over, no.g2_over),
            d02: real(yes.d02, no.d02),
            d12: real(yes.d12, no.d12),
            volume: real(yes.volume, no.volume),
            solid_angle: real(yes.solid_angle, no.solid_angle),
            unit: real(yes.unit, no.unit),
        }
    }

    /// Solid angle in steradians, in [0, 2π].
    #[inline(always)]
    pub fn solid_angle(&self) -> R {
        self.solid_angle
    }

    /// The density of every direction that hits the triangle, 1/Ω; 0 where Ω is 0.
    #[inline(always)]
    pub fn density(&self) -> R {
        super::uniform_density(self.solid_angle)
    }

    /// True where the point is on the side to which the normal (v1−v0)×(v2−v0) points.
    #[inline(always)]
    pub fn in_front(&self) -> R::Mask {
        self.volume.lt(R::lit(0.0))
    }

    /// The arc that cuts `u` of the area off.
    #[inline(always)]
    fn arc(&self, u: R) -> Arc<R> {
        let zero = R::lit(0.0);
        let (s, c) = (u * self.solid_angle * R::lit(0.5 * INV_TWO_PI)).sin_cos_turns();
        // cos(α−η) and sin(α−η), over sinα
        let turn_cos = self.cot_alpha.mul_add(c, s);
        let turn_sin = (-self.cot_alpha).mul_add(s, c);
        let stretched = s * self.stretch;
        // P opposite v1 would be at infinity; its square must fit
        let most = R::lit(1e15);
        let x = (-stretched).mul_add(turn_cos, self.tan_half).clamp(-most, most);
        let y = (stretched * turn_sin).clamp(zero, most);
        let arc = Arc { x, y, m: x.mul_add(x, y * y), swept: [s, c] };
        // a side of more than 120° is rare: the work is done where there is one
        let long = self.g2.lt(R::lit(0.5));
        if long.any() { self.opposite_arc(arc, long) } else { arc }
    }

    /// Where v0 lies nearly opposite v1 the arc's length follows from its angle no more: then from P itself, where that is better.
    #[inline]
    fn opposite_arc(&self, arc: Arc<R>, long: R::Mask) -> Arc<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let [w0, w2] = self.weights(arc.swept);
        let cos = w0.mul_add(self.g2 - one, w2 * self.d12).clamp(-one, one);
        // errors of θ: ε/sinθ from P, ε sinθ/(sinα sin(side)) from the angle
        let better = long & ((one - cos) * (one + cos)).gt(self.alpha().0 * self.sin_side) & arc.m.gt(zero);
        let m = R::select(better, (one - cos) / R::select(better, one + cos, one), arc.m);
        let scale = R::select(better, (m / R::select(better, arc.m, one)).sqrt(), one);
        Arc { x: arc.x * scale, y: arc.y * scale, m, swept: arc.swept }
    }

    /// P as a sum of the unit vectors to v0 and v2.
    #[inline(always)]
    fn weights(&self, [s, c]: [R; 2]) -> [R; 2] {
        let (zero, two) = (R::lit(0.0), R::lit(2.0));
        let a = (-s).mul_add(self.g1, c);
        let b = s * self.g2_over;
        let w0 = ((a - b) * (a + b)).max(zero);
        let w2 = (two * b * b.mul_add(self.d02, a)).max(zero);
        let squared = w0.mul_add(w0, w2 * w2) + two * self.d02 * w0 * w2;
        let inverse = rsqrt(squared.max(R::lit(1e-30)));
        [w0 * inverse, w2 * inverse]
    }

    /// Sine and cosine of the angle at v0.
    #[inline(always)]
    fn alpha(&self) -> (R, R) {
        // past 1e18 the cotangent's square would not fit, and the sine is 0 to all intents
        let cot = self.cot_alpha.clamp(R::lit(-1e18), R::lit(1e18));
        let sin = rsqrt(cot.mul_add(cot, R::lit(1.0)));
        (sin, cot * sin)
    }

    /// The side from v1 to the far edge under the angle whose cosine and sine, in a unit of the given square, are `x` and `y`:
    /// its sine over that unit, 1−|cos| and cos, by cotθ = (cosφ cos(side) + sinφ cotα)/sin(side).
    #[inline(always)]
    fn side(&self, x: R, y: R, unit_squared: R) -> (R, R, R) {
        let one = R::lit(1.0);
        let (sin_alpha, cos_alpha) = self.alpha();
        let opposite = sin_alpha * self.sin_side;
        let adjacent = (self.g2 - one).mul_add(x * sin_alpha, y * cos_alpha);
        let squared = (opposite * opposite).mul_add(unit_squared, adjacent * adjacent);
        let inverse = rsqrt(squared).keep(squared.gt(R::lit(1e-36)));
        let (sin, cos) = (opposite * inverse, adjacent * inverse);
        (sin, sin * sin * unit_squared / (one + cos.abs()), cos)
    }

    /// The direction at `u` of the arc, and the cosine and the sine of its angle to v1.
    #[inline]
    fn along_arc(&self, arc: &Arc<R>, u: R) -> (Vec3<R>, R, R) {
        let (zero, one, two) = (R::lit(0.0), R::lit(1.0), R::lit(2.0));
        // 1−cosθ = 2M/(1+M), and the sine of the angle over √M
        let over = u * (two / (one + arc.m));
        let z = (-over).mul_add(arc.m, one);
        let sin_over = (over * (one + z)).max(zero).sqrt();
        let tangent = self.along.mul_add(arc.x, self.across * arc.y);
        let direction = self.apex.mul_add(z, tangent * sin_over);
        // a unit vector but for rounding: one step of Newton's to 1/√
        let unit = direction * direction.length_squared().mul_add(R::lit(-0.5), R::lit(1.5));
        (unit, z, sin_over)
    }

    /// The direction for `u` and the distance to the triangle along it.
    #[inline(always)]
    pub fn sight(&self, u: Vec2<R>) -> Sighting<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let arc = self.arc(u.x);
        let (direction, z, sin_over) = self.along_arc(&arc, u.y);
        let [w0, w2] = self.weights(arc.swept);
        let inv_p = w0.mul_add(self.inv_l0, w2 * self.inv_l2);
        // direction = kV₁/l₁ + tP/|P| with t = sin/sin∠(V₁,P), k = z − t cos; so l₁/distance = k + tl₁/|P|, also at grazing
        // sin∠(V₁,P) = 2√M/(1+M)
        let t = sin_over * R::lit(0.5) * (one + arc.m);
        let behind = arc.m.gt(one);
        let cos_abs = (one - arc.m).abs() / (one + arc.m);
        // k = (z² − t²c²)/(z + tc) = (1−u₁)(z+c)/((1+c)(z+tc))
        let denominator = (one + cos_abs) * t.mul_add(cos_abs, z);
        let k = (one - u.y) * (z + cos_abs) / R::select(denominator.gt(zero), denominator, one);
        let reciprocal = t.mul_add(inv_p * self.l1, k);
        // where P lies behind v1 that cancels; but then the triangle is large, and the plane will do
        let numerator = R::select(behind, self.volume.abs(), self.l1);
        let denominator = R::select(behind, direction.dot(self.normal).abs(), reciprocal);
        let some = denominator.gt(zero) & self.solid_angle.gt(zero);
        // what does not fit f32 ends at its largest number
        let distance = (numerator / R::select(some, denominator, one)).min(self.farthest);
        let distance = (distance * self.unit).min(R::lit(f64::from(f32::MAX)));
        Sighting { direction, distance: distance.keep(some) }
    }

    /// Is the direction inside, give or take the rounding of the direction itself?
    #[inline(always)]
    pub fn contains(&self, w: Vec3<R>) -> R::Mask {
        self.within_v1_v2(w) & self.within_v2_v0(w) & self.within_v0_v1(w) & self.ahead(w)
    }
    /// On the inner side of the plane through the viewpoint and two vertices, to 12 ulp of the direction; where these vertices, or others
    /// from which the map goes to them, lie nearly opposite, it is known no better than −cos : sin of their angle.
    #[inline(always)]
    fn within(&self, w: Vec3<R>, a: Vec3<R>, b: Vec3<R>, edge: Vec3<R>, known: R) -> R::Mask {
        let n = plane(a, b, edge);
        let slack = (n.length() * known).max(-a.dot(b)) * R::lit(BEYOND);
        w.dot(n).negate_where(self.in_front()).ge(-slack)
    }
    /// 1, or more where v0 and v1, from which the map starts, lie nearly opposite.
    #[inline(always)]
    fn start(&self) -> R {
        let some = self.sin_side.gt(R::lit(0.0));
        ((R::lit(1.0) - self.g2) / R::select(some, self.sin_side, R::lit(1.0))).max(R::lit(1.0))
    }
    #[inline(always)]
    pub(super) fn within_v1_v2(&self, w: Vec3<R>) -> R::Mask {
        // the map comes to this side along the one from v0 to v2
        let sin_squared = (-self.d02).mul_add(self.d02, R::lit(1.0)).max(R::lit(1e-7));
        let known = self.start().max(-self.d02 * rsqrt(sin_squared));
        self.within(w, self.v1, self.v2, self.e2 - self.e1, known)
    }
    #[inline(always)]
    pub(super) fn within_v2_v0(&self, w: Vec3<R>) -> R::Mask {
        self.within(w, self.v2, self.v0, -self.e2, self.start())
    }
    #[inline(always)]
    pub(super) fn within_v0_v1(&self, w: Vec3<R>) -> R::Mask {
        self.within(w, self.v0, self.v1, self.e1, self.start())
    }
    /// Towards the plane of the triangle.
    #[inline(always)]
    pub(super) fn ahead(&self, w: Vec3<R>) -> R::Mask {
        let slack = self.normal.length() * R::lit(BEYOND);
        w.dot(self.normal).negate_where(self.in_front()).ge(-slack)
    }
    /// On the far side of the plane through the viewpoint, v0 and v1 from v2.
    #[inline(always)]
    pub(super) fn beyond_v0_v1(&self, w: Vec3<R>) -> R::Mask {
        w.dot(self.across).lt(R::lit(0.0))
    }
}

impl<R: Real> Warp<R> for SphericalTriangle<R> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        self.along_arc(&self.arc(u.x), u.y).0
    }
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        self.density().keep(self.contains(w))
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let (zero, one, two) = (R::lit(0.0), R::lit(1.0), R::lit(2.0));
        let (x, y) = (w.dot(self.along), w.dot(self.across).max(zero));
        let squared = x.mul_add(x, y * y);
        let inverse = rsqrt(squared).keep(squared.gt(R::lit(1e-36)));
        let (x, y) = (x * inverse, y * inverse);
        let (sin, small, cos) = self.side(x, y, one);
        let acute = cos.gt(zero);
        let (minus, plus) = (R::select(acute, small, two - small), R::select(acute, two - small, small));
        // tan(swept/2) from two sides and the angle between them
        let both = self.sin_side * sin;
        let swept = two * (both * y).atan2(self.g2.mul_add(plus, both * x));
        let moved = (w - self.apex).length_squared() * R::lit(0.5);
        Vec2 {
            x: unit_interval(swept / self.solid_angle.max(R::lit(1e-37))),
            y: unit_interval(moved / minus.max(R::lit(1e-37))),
        }
    }
}
