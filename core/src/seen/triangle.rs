use super::{Sighting, lanewise};
use crate::math::rsqrt;
use crate::real::{Mask, Real};
use crate::vector::{Vec2, Vec3};
use crate::warp::{Warp, unit_interval};

/// Angle by which a sample may leave the triangle through the error of its direction: 8 ulp of a component near 1.
const SLACK: f64 = 8.0 / 16_777_216.0;
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
    ///   G₀ = |V₀·(E₁×E₂)|/(l₀l₁l₂), G₁ = d₀₂+d₁₂, G₂ = 1+d₀₁, η = u₀Ω/2, a = G₀cosη − G₁sinη, b = G₂sinη;
    ///   the point P = V₀ + τE₂ of the far edge has τ : 1−τ = 2b(a+bd₀₂)/l₂ : (a−b)(a+b)/l₀. With α the angle at v0, the angle swept at
    ///   v1 has tanφ = σ sin(α−η) / (sinα − σ cos(α−η)), σ = 2 sinη/(1−d₀₁); with δ = 1−cos∠(V₁,P) and z = 1−u₁δ the
    ///   direction is zV₁/l₁ + √(u₁δ(1+z)) T, T the tangent at v1 that is turned by φ from v0 towards v2.
    /// - Domain: u in [0, 1)²; any triangle, from any side.
    /// - Density: 1/Ω per steradian inside (and within 8 ulp of the direction beyond), 0 outside.
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
        /// unit vector to `v1`, and tangents there: towards `v0`, and across towards `v2`
        apex: Vec3<R>,
        along: Vec3<R>,
        across: Vec3<R>,
        /// sine and cosine of the angle at `v0`; 2/(1−d₀₁)
        sin_alpha: R,
        cos_alpha: R,
        stretch: R,
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
fn plane<R: Real>(a: Vec3<R>, b: Vec3<R>, edge: Vec3<R>) -> Vec3<R> {
    a.cross(Vec3::select(edge.length_squared().lt(b.length_squared()), edge, b))
}

/// The arc from `v1` to the point P of the far edge.
struct Arc<R> {
    /// cosine and sine of the angle turned by at `v1`, in any unit, and the reciprocal of that unit
    turned: [R; 2],
    inverse: R,
    /// of the whole arc: sine, 1−|cos|, and cos
    sin: R,
    small: R,
    cos: R,
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
        let (i01, i02) = (inverse(n01), inverse(n02));
        let sin_side = n01.length_squared() * i01 * i0 * i1;
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
            l1: squared[1] * i1,
            apex,
            along: apex.cross(pole),
            across,
            sin_alpha: volume.abs() * (squared[0] * i0) * i01 * i02,
            cos_alpha: n01.dot(n02) * i01 * i02,
            // a side of 1e−18 and less has no finite reciprocal
            stretch: R::lit(2.0) / R::select(minus.gt(R::lit(1e-37)), minus, one),
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
            unit: one / scale,
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
            apex: vector(yes.apex, no.apex),
            along: vector(yes.along, no.along),
            across: vector(yes.across, no.across),
            sin_alpha: real(yes.sin_alpha, no.sin_alpha),
            cos_alpha: real(yes.cos_alpha, no.cos_alpha),
            stretch: real(yes.stretch, no.stretch),
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
        let some = self.solid_angle.gt(R::lit(1e-37));
        (R::lit(1.0) / R::select(some, self.solid_angle, R::lit(1.0))).keep(some)
    }

    /// True where the point is on the side to which the normal (v1−v0)×(v2−v0) points.
    #[inline(always)]
    pub fn in_front(&self) -> R::Mask {
        self.volume.lt(R::lit(0.0))
    }

    /// The arc that cuts `u` of the area off.
    #[inline(always)]
    fn arc(&self, u: R) -> Arc<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let (s, c) = (u * self.solid_angle * R::lit(0.5 * INV_TWO_PI)).sin_cos_turns();
        // sine and cosine of α − η
        let (x, y) = (self.sin_alpha.mul_add(c, -(self.cos_alpha * s)), self.cos_alpha.mul_add(c, self.sin_alpha * s));
        // past this the angle is 180° − α and nothing else; its square must fit
        let stretched = (s * self.stretch).min(R::lit(1e17));
        let (x, y) = ((-stretched).mul_add(y, self.sin_alpha), stretched * x);
        let squared = x.mul_add(x, y * y);
        let inverse = rsqrt(squared).keep(squared.gt(R::lit(1e-36)));
        let (sin_over, small, cos) = self.side(x, y, squared);
        let cos = R::select(cos.gt(zero), one - small, small - one);
        let sin = sin_over * (squared * inverse);
        let arc = Arc { turned: [x, y], inverse, sin, small, cos, swept: [s, c] };
        // a side of more than 120° is rare: the work is done where there is one
        let long = self.g2.lt(R::lit(0.5));
        if long.any() { self.opposite_arc(arc, long) } else { arc }
    }

    /// Where v0 lies nearly opposite v1 the side θ follows from its angle no more: then from P itself, where that is better.
    #[inline(always)]
    fn opposite_arc(&self, arc: Arc<R>, long: R::Mask) -> Arc<R> {
        let one = R::lit(1.0);
        let [w0, w2] = self.weights(arc.swept);
        let cos = w0.mul_add(self.g2 - one, w2 * self.d12).clamp(-one, one);
        let squared = (one - cos) * (one + cos);
        // errors of θ: ε/sinθ from P, ε sinθ/(sinα sin(side)) from the angle
        let better = long & squared.gt(self.sin_alpha * self.sin_side);
        Arc {
            sin: R::select(better, squared.sqrt(), arc.sin),
            small: R::select(better, one - cos.abs(), arc.small),
            cos: R::select(better, cos, arc.cos),
            ..arc
        }
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

    /// The side from v1 to the far edge under the angle whose cosine and sine, in a unit of the given square, are `x` and `y`:
    /// its sine over that unit, 1−|cos| and cos, by cotθ = (cosφ cos(side) + sinφ cotα)/sin(side).
    #[inline(always)]
    fn side(&self, x: R, y: R, unit_squared: R) -> (R, R, R) {
        let one = R::lit(1.0);
        let opposite = self.sin_alpha * self.sin_side;
        let adjacent = (self.g2 - one).mul_add(x * self.sin_alpha, y * self.cos_alpha);
        let squared = (opposite * opposite).mul_add(unit_squared, adjacent * adjacent);
        let inverse = rsqrt(squared).keep(squared.gt(R::lit(1e-36)));
        let (sin, cos) = (opposite * inverse, adjacent * inverse);
        (sin, sin * sin * unit_squared / (one + cos.abs()), cos)
    }

    /// The direction at `u` of the arc, and the cosine and the sine of its angle to v1.
    #[inline(always)]
    fn along_arc(&self, arc: &Arc<R>, u: R) -> (Vec3<R>, R, R) {
        let (zero, one, two) = (R::lit(0.0), R::lit(1.0), R::lit(2.0));
        let moved = u * R::select(arc.cos.gt(zero), arc.small, two - arc.small);
        let z = one - moved;
        let sin = (moved * (one + z)).max(zero).sqrt();
        let [x, y] = arc.turned.map(|t| t * (arc.inverse * sin));
        (self.apex.mul_add(z, self.along.mul_add(x, self.across * y)), z, sin)
    }

    /// The direction for `u` and the distance to the triangle along it.
    #[inline(always)]
    pub fn sight(&self, u: Vec2<R>) -> Sighting<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let arc = self.arc(u.x);
        let (direction, z, sin) = self.along_arc(&arc, u.y);
        let direction = direction.normalize();
        let [w0, w2] = self.weights(arc.swept);
        let inv_p = w0.mul_add(self.inv_l0, w2 * self.inv_l2);
        // direction = kV₁/l₁ + tP/|P| with t = sin/sin∠(V₁,P), k = z − t cos; so l₁/distance = k + tl₁/|P|, also at grazing
        let t = sin / R::select(arc.sin.gt(zero), arc.sin, one);
        let cos_abs = one - arc.small;
        // k = (z² − t²c²)/(z + tc) = (1−u₁)(z+c)/((1+c)(z+tc))
        let denominator = (one + cos_abs) * t.mul_add(cos_abs, z);
        let k = (one - u.y) * (z + cos_abs) / R::select(denominator.gt(zero), denominator, one);
        let reciprocal = t.mul_add(inv_p * self.l1, k);
        // where P lies behind v1 that cancels; but then the triangle is large, and the plane will do
        let behind = arc.cos.lt(zero);
        let numerator = R::select(behind, self.volume.abs(), self.l1);
        let denominator = R::select(behind, direction.dot(self.normal).abs(), reciprocal);
        let some = denominator.gt(zero) & self.solid_angle.gt(zero);
        // a point of the triangle is within 4 units; what does not fit f32 ends at its largest number
        let distance = (numerator / R::select(some, denominator, one)).min(R::lit(4.0));
        let distance = (distance * self.unit).min(R::lit(f64::from(f32::MAX)));
        Sighting { direction, distance: distance.keep(some) }
    }

    /// Is the direction inside, give or take the rounding of the direction itself?
    #[inline(always)]
    pub fn contains(&self, w: Vec3<R>) -> R::Mask {
        self.within_v1_v2(w) & self.within_v2_v0(w) & self.within_v0_v1(w) & self.ahead(w)
    }
    /// On the inner side of the plane through the viewpoint and two vertices, to 8 ulp of the direction; where these vertices, or v0
    /// and v1 from which the map starts, lie nearly opposite, their plane is known no better than −cos : sin of their angle.
    #[inline(always)]
    fn within(&self, w: Vec3<R>, a: Vec3<R>, b: Vec3<R>, edge: Vec3<R>) -> R::Mask {
        let n = plane(a, b, edge);
        let some = self.sin_side.gt(R::lit(0.0));
        let start = (R::lit(1.0) - self.g2) / R::select(some, self.sin_side, R::lit(1.0));
        let slack = (n.length() * start.max(R::lit(1.0))).max(-a.dot(b)) * R::lit(SLACK);
        w.dot(n).negate_where(self.in_front()).ge(-slack)
    }
    #[inline(always)]
    pub(super) fn within_v1_v2(&self, w: Vec3<R>) -> R::Mask {
        self.within(w, self.v1, self.v2, self.e2 - self.e1)
    }
    #[inline(always)]
    pub(super) fn within_v2_v0(&self, w: Vec3<R>) -> R::Mask {
        self.within(w, self.v2, self.v0, -self.e2)
    }
    #[inline(always)]
    pub(super) fn within_v0_v1(&self, w: Vec3<R>) -> R::Mask {
        self.within(w, self.v0, self.v1, self.e1)
    }
    /// Towards the plane of the triangle.
    #[inline(always)]
    pub(super) fn ahead(&self, w: Vec3<R>) -> R::Mask {
        let slack = self.normal.length() * R::lit(SLACK);
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
