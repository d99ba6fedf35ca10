use super::{Sighting, lanewise};
use crate::math::rsqrt;
use crate::real::Real;
use crate::vector::{Vec2, Vec3};
use crate::warp::{Warp, unit_interval};

/// Angle by which a sample may leave the triangle through the rounding of its direction: 4 ulp of a component near 1.
const SLACK: f64 = 4.0 / 16_777_216.0;
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
    ///   G₀ = |V₀·(E₁×E₂)|/(l₀l₁l₂), G₁ = d₀₂+d₁₂, G₂ = 1+d₀₁, η = u₀Ω/2, α = G₀cosη − G₁sinη, β = G₂sinη;
    ///   the point P = V₀ + τE₂ of the far edge has τ : 1−τ = 2β(α+βd₀₂)/l₂ : (α−β)(α+β)/l₀; with c = cos∠(V₁,P), δ = 1−c,
    ///   z = 1−u₁δ and t = √(u₁(1+z)/(2−δ)), the direction is kV₁/l₁ + tP/|P|, k = z − tc, at the distance l₁|P|/(k|P| + tl₁).
    /// - Domain: u in [0, 1)²; any triangle, from any side.
    /// - Density: 1/Ω per steradian inside (and within 4 ulp of the direction beyond), 0 outside.
    /// - Degenerate: the point in the plane (also inside the triangle), zero area, or lengths whose sums overflow: Ω = 0 and pdf 0.
    /// - Greatest error: see `tests/src/tolerances.rs`.
    /// - Source: Arvo 1995, "Stratified Sampling of Spherical Triangles"; Van Oosterom and Strackee 1983 for Ω; Peters 2021,
    ///   "BRDF Importance Sampling for Polygonal Lights", section 3, for the form without inverse trigonometry; here on edges.
    SphericalTriangle {
        v0: Vec3<R>,
        v1: Vec3<R>,
        v2: Vec3<R>,
        e1: Vec3<R>,
        e2: Vec3<R>,
        l1: R,
        /// unit vector to `v1`
        apex: Vec3<R>,
        inv_l0: R,
        inv_l2: R,
        g0: R,
        g1: R,
        g2: R,
        d02: R,
        /// V₀·(E₁×E₂), signed: negative where the point is on the side of the normal (v1−v0)×(v2−v0)
        volume: R,
        solid_angle: R,
        unit: R,
    }
}

/// The point P of the far edge, and the angle between it and the apex.
struct Arc<R> {
    p: Vec3<R>,
    inv_p: R,
    /// 1−c, 1+c and c, none of them by cancellation
    minus: R,
    plus: R,
    cos: R,
}

impl<R: Real> SphericalTriangle<R> {
    /// For a triangle with vertices `v0`, `v1`, `v2` relative to the point.
    #[inline]
    pub fn new(v0: Vec3<R>, v1: Vec3<R>, v2: Vec3<R>) -> Self {
        let scale = v0.max_abs().max(v1.max_abs()).max(v2.max_abs()).exponent_reciprocal();
        let (v0, v1, v2) = (v0 * scale, v1 * scale, v2 * scale);
        Self::prepare(v0, v1, v2, v1 - v0, v2 - v0, scale)
    }

    /// As `new`, with the edges `e1` = v1−v0 and `e2` = v2−v0 where they are known better than the difference of vertices that
    /// were moved to the point: for a small and far triangle they hold its shape.
    #[inline]
    pub fn with_edges(v0: Vec3<R>, v1: Vec3<R>, v2: Vec3<R>, e1: Vec3<R>, e2: Vec3<R>) -> Self {
        let reach = v0.max_abs().max(v1.max_abs()).max(v2.max_abs()).max(e1.max_abs()).max(e2.max_abs());
        // sums that overflowed: a triangle of no extent
        let finite = reach.lt(R::lit(f64::INFINITY));
        let scale = reach.exponent_reciprocal();
        let scaled = |v: Vec3<R>| Vec3::new(v.x.keep(finite), v.y.keep(finite), v.z.keep(finite)) * scale;
        Self::prepare(scaled(v0), scaled(v1), scaled(v2), scaled(e1), scaled(e2), scale)
    }

    /// With all lengths below 4.
    #[inline]
    fn prepare(v0: Vec3<R>, v1: Vec3<R>, v2: Vec3<R>, e1: Vec3<R>, e2: Vec3<R>, scale: R) -> Self {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let squared = [v0, v1, v2].map(Vec3::length_squared);
        let [i0, i1, i2] = squared.map(|s| rsqrt(s).keep(s.gt(R::lit(1e-36))));
        let (d01, d02, d12) = (v0.dot(v1) * i0 * i1, v0.dot(v2) * i0 * i2, v1.dot(v2) * i1 * i2);
        // the same at each vertex; at the nearest it cancels least
        let nearest = Vec3::select(squared[1].lt(squared[0]), v1, v0);
        let nearest = Vec3::select(squared[2].lt(squared[0].min(squared[1])), v2, nearest);
        let volume = nearest.dot(e1.cross(e2));
        let g0 = volume.abs() * i0 * i1 * i2;
        let (g1, g2) = (d02 + d12, one + d01);
        // at a vertex all of them are 0, and so is the angle
        let somewhere = i0.gt(zero) & i1.gt(zero) & i2.gt(zero) & g0.gt(zero);
        let solid_angle = (R::lit(2.0) * g0.atan2(g1 + g2)).keep(somewhere);
        Self {
            v0,
            v1,
            v2,
            e1,
            e2,
            l1: squared[1] * i1,
            apex: v1 * i1,
            inv_l0: i0,
            inv_l2: i2,
            g0,
            g1,
            g2,
            d02,
            volume,
            solid_angle,
            unit: one / scale,
        }
    }

    /// `yes` where the mask is true, `no` elsewhere.
    #[inline]
    pub(crate) fn select(mask: R::Mask, yes: &Self, no: &Self) -> Self {
        let real = |a, b| R::select(mask, a, b);
        let vector = |a, b| Vec3::select(mask, a, b);
        Self {
            v0: vector(yes.v0, no.v0),
            v1: vector(yes.v1, no.v1),
            v2: vector(yes.v2, no.v2),
            e1: vector(yes.e1, no.e1),
            e2: vector(yes.e2, no.e2),
            l1: real(yes.l1, no.l1),
            apex: vector(yes.apex, no.apex),
            inv_l0: real(yes.inv_l0, no.inv_l0),
            inv_l2: real(yes.inv_l2, no.inv_l2),
            g0: real(yes.g0, no.g0),
            g1: real(yes.g1, no.g1),
            g2: real(yes.g2, no.g2),
            d02: real(yes.d02, no.d02),
            volume: real(yes.volume, no.volume),
            solid_angle: real(yes.solid_angle, no.solid_angle),
            unit: real(yes.unit, no.unit),
        }
    }

    /// Solid angle in steradians, in [0, 2π].
    #[inline]
    pub fn solid_angle(&self) -> R {
        self.solid_angle
    }

    /// The density of every direction that hits the triangle, 1/Ω; 0 where Ω is 0.
    #[inline]
    pub fn density(&self) -> R {
        let some = self.solid_angle.gt(R::lit(1e-37));
        (R::lit(1.0) / R::select(some, self.solid_angle, R::lit(1.0))).keep(some)
    }

    /// True where the point is on the side to which the normal (v1−v0)×(v2−v0) points.
    #[inline]
    pub fn in_front(&self) -> R::Mask {
        self.volume.lt(R::lit(0.0))
    }

    /// P at τ of the far edge.
    #[inline]
    fn arc(&self, tau: R) -> Arc<R> {
        let (zero, one, two) = (R::lit(0.0), R::lit(1.0), R::lit(2.0));
        let p = self.v0.mul_add(one - tau, self.v2 * tau);
        let p_squared = p.length_squared();
        let inv_p = rsqrt(p_squared.max(R::lit(1e-36)));
        // sin²∠(V₁,P) from P−V₁, or from P where that is the shorter: both err by parts in 2²⁴ of themselves
        let edge = self.e2 * tau - self.e1;
        let arm = Vec3::select(edge.length_squared().lt(p_squared), edge, p);
        let sin_squared = (self.apex.cross(arm) * inv_p).length_squared();
        let cos = self.apex.dot(p) * inv_p;
        // 1 − |c|
        let small = sin_squared / (one + cos.abs());
        let acute = cos.gt(zero);
        let large = two - small;
        Arc {
            p,
            inv_p,
            minus: R::select(acute, small, large),
            plus: R::select(acute, large, small),
            cos: (one - small).negate_where(!acute),
        }
    }

    /// For `u`: the weights of the unit vectors to `v1` and to P whose sum is the direction; and P.
    #[inline]
    fn weights(&self, u: Vec2<R>) -> (R, R, Arc<R>) {
        let (zero, one, two) = (R::lit(0.0), R::lit(1.0), R::lit(2.0));
        let (s, c) = (u.x * self.solid_angle * R::lit(0.5 * INV_TWO_PI)).sin_cos_turns();
        let alpha = self.g0.mul_add(c, -(self.g1 * s));
        let beta = self.g2 * s;
        let w_a = ((alpha - beta) * (alpha + beta) * self.inv_l0).max(zero);
        let w_c = (two * beta * beta.mul_add(self.d02, alpha) * self.inv_l2).max(zero);
        let sum = w_a + w_c;
        let arc = self.arc(w_c / R::select(sum.gt(zero), sum, one));

        let z = (-u.y).mul_add(arc.minus, one);
        let t = (u.y * (one + z) / arc.plus.max(R::lit(1e-30))).max(zero).sqrt();
        let tc = t * arc.cos;
        // k = z − tc; where both have one sign that is (z² − t²c²)/(z + tc) = (1−u₁)(z+c)/((1+c)(z+tc))
        let mixed = (z * arc.cos).le(zero);
        let numerator = R::select(mixed, z - tc, (one - u.y) * (z + arc.cos));
        let denominator = R::select(mixed, one, arc.plus * (z + tc));
        let some = denominator.abs().gt(R::lit(1e-30));
        let k = (numerator / R::select(some, denominator, one)).max(zero);
        (k, t, arc)
    }

    /// The direction for `u` and the distance to the triangle along it.
    #[inline]
    pub fn sight(&self, u: Vec2<R>) -> Sighting<R> {
        let (k, t, arc) = self.weights(u);
        let direction = self.apex.mul_add(k, arc.p * (t * arc.inv_p)).normalize();
        // l₁/distance = k + tl₁/|P|
        let reciprocal = t.mul_add(arc.inv_p * self.l1, k);
        let some = reciprocal.gt(R::lit(0.0));
        Sighting { direction, distance: (self.l1 / R::select(some, reciprocal, R::lit(1.0)) * self.unit).keep(some) }
    }

    /// Is the direction inside, give or take the rounding of the direction itself?
    #[inline]
    pub fn contains(&self, w: Vec3<R>) -> R::Mask {
        let [n0, n1, n2] = self.sides();
        let normal = self.e1.cross(self.e2);
        // the great circle through two vertices that are nearly opposite is known no better than −cos : sin of their angle
        let within = |n: Vec3<R>, opposite: R| {
            let slack = n.length().max(opposite) * R::lit(SLACK);
            w.dot(n).negate_where(self.in_front()).ge(-slack)
        };
        within(n0, -self.v1.dot(self.v2))
            & within(n1, -self.v2.dot(self.v0))
            & within(n2, -self.v0.dot(self.v1))
            & within(normal, R::lit(0.0))
    }

    /// Normals of the planes through the viewpoint and the edges opposite v0, v1, v2; a direction's barycentrics are
    /// proportional to its products with them.
    #[inline]
    fn sides(&self) -> [Vec3<R>; 3] {
        [self.v1.cross(self.e2 - self.e1), self.e2.cross(self.v0), self.v0.cross(self.e1)]
    }
}

impl<R: Real> Warp<R> for SphericalTriangle<R> {
    type Point = Vec3<R>;
    #[inline]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        let (k, t, arc) = self.weights(u);
        self.apex.mul_add(k, arc.p * (t * arc.inv_p)).normalize()
    }
    #[inline]
    fn pdf(&self, w: Vec3<R>) -> R {
        self.density().keep(self.contains(w))
    }
    #[inline]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let (zero, one, two) = (R::lit(0.0), R::lit(1.0), R::lit(2.0));
        let [n0, _, n2] = self.sides();
        let b0 = w.dot(n0).negate_where(self.in_front()).max(zero);
        let b2 = w.dot(n2).negate_where(self.in_front()).max(zero);
        let sum = b0 + b2;
        let tau = b2 / R::select(sum.gt(zero), sum, one);
        // the triangle v0, v1, P has the same form of solid angle, with the edge τE₂
        let Arc { p, inv_p, minus, cos, .. } = self.arc(tau);
        let inv_l1 = one / self.l1.max(R::lit(1e-18));
        let d0p = self.v0.dot(p) * self.inv_l0 * inv_p;
        let swept_g0 = tau * self.volume.abs() * self.inv_l0 * inv_l1 * inv_p;
        let swept = two * swept_g0.atan2(self.g2 + d0p + cos);
        let moved = (w - self.apex).length_squared() * R::lit(0.5);
        Vec2 {
            x: unit_interval(swept / self.solid_angle.max(R::lit(1e-37))),
            y: unit_interval(moved / minus.max(R::lit(1e-37))),
        }
    }
}
