//! Triangles.

pub(super) mod area;
pub(super) mod projected;
pub(super) mod solid_angle;

use super::bound::{LightBound, wide};
use super::sampler::{ByArea, ByProjectedSolidAngle, ByReflection, BySolidAngle};
use crate::lanewise::lanewise;
use crate::real::Real;
use crate::reflection::Reflection;
use crate::vector::Vec3;
use area::PlacedTriangle;
use projected::ProjectedTriangle;
use solid_angle::SphericalTriangle;

lanewise! {
    /// A triangle light that emits from the side of (v1−v0)×(v2−v0).
    ///
    /// Take [`by_solid_angle`](Self::by_solid_angle) unless the light is small for its distance, where [`by_area`](Self::by_area) is
    /// cheaper and as good; [`by_projected_solid_angle`](Self::by_projected_solid_angle) has no variance on an unoccluded diffuse
    /// surface. A point in the plane of the triangle, or a triangle without area, gives pdf 0.
    ///
    /// ```
    /// use etendue::{LightSampler, Triangle, Vec2, Vec3};
    /// let [a, b, c] = [[0.0, 2.0, 0.0], [1.0, 2.0, 0.0], [0.0, 2.0, 1.0]].map(Vec3::<f32>::lit);
    /// let light = Triangle::new(a, b, c);
    /// let sampler = light.by_solid_angle(Vec3::lit([0.0; 3])); // prepare once, for one shading point
    /// let s = sampler.sample(Vec2::new(0.3, 0.6));
    /// assert!(s.valid() && s.weight() == 1.0 / s.pdf);
    /// assert_eq!(sampler.pdf(s.direction), s.pdf);
    /// ```
    ///
    /// Surface coordinates (u, v): the barycentric coordinates of `v1` and `v2`, so that vertex normals interpolate as
    /// (1−u−v)·n0 + u·n1 + v·n2.
    pub struct Triangle {
        /// First vertex v0, in the coordinates of the scene.
        pub v0: Vec3<R>,
        /// Edge v1 − v0.
        pub e1: Vec3<R>,
        /// Edge v2 − v0.
        pub e2: Vec3<R>,
    }
}

impl<R: Real> Triangle<R> {
    /// The triangle with these vertices. It emits from the side on which they run counterclockwise.
    #[inline(always)]
    pub fn new(v0: Vec3<R>, v1: Vec3<R>, v2: Vec3<R>) -> Self {
        Self { v0, e1: v1 - v0, e2: v2 - v0 }
    }
    #[inline(always)]
    fn placed(&self, p: Vec3<R>) -> PlacedTriangle<R> {
        PlacedTriangle::new(self.v0 - p, self.e1, self.e2)
    }
    #[inline(always)]
    fn spherical(&self, p: Vec3<R>) -> SphericalTriangle<R> {
        let v0 = self.v0 - p;
        SphericalTriangle::with_edges(v0, v0 + self.e1, v0 + self.e2, self.e1, self.e2)
    }
    /// Uniform over the surface, seen from the point `p`: [`AreaTriangle`](crate::warp::AreaTriangle).
    ///
    /// - pdf: distance²/(|cosθ'| A) per steradian, with A the area and θ' the angle at the light.
    /// - Greatest error of the pdf that the tests allow: (48 + 24/sinα + (36 + 24/sinα)/|cosθ'|)·2⁻²⁴ relative, with α the angle
    ///   between the edges.
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>) -> TriangleByArea<R> {
        ByArea { surface: self.placed(p) }
    }
    /// Uniform over the solid angle Ω at the point `p`: pdf 1/Ω per steradian.
    ///
    /// The map is Arvo's: u₀ sweeps the great circle through the vertex `v1` from `v0` to `v2` so that the swept area is u₀Ω,
    /// and u₁ moves away from `v1` uniformly in 1−cos. Small differences come from the edges, never from unit vectors, so a
    /// triangle of 1e−9 of its distance is sampled as well as a large one. Directions come from unit vectors, never from points
    /// of the plane, and the height over the plane is formed in twice the working precision where its terms cancel, so the point
    /// may be arbitrarily near the plane.
    ///
    /// - Formula: with V from the point, E₁ = v1−v0, E₂ = v2−v0, lengths l, cosines d and sums s = Vᵢ/lᵢ + Vⱼ/lⱼ between the V:
    ///   tan(Ω/2) = G₀/T, G₀ = |V₀·(E₁×E₂)|/(l₀l₁l₂), T = 1 + d₀₁ + d₀₂ + d₁₂ = sᵢₖ·sⱼₖ for any vertex k (Van Oosterom and
    ///   Strackee). Where an angle exceeds 120°, T is that product at the vertex to which the others are least opposite, and a
    ///   sum of nearly opposite unit vectors follows from the foot h of the perpendicular on their edge: h(1/lᵢ + 1/lⱼ), and
    ///   along the edge h²(1/lᵢ(lᵢ+|a|) − 1/lⱼ(lⱼ+|b|)). With c the side v0 v1, α the angle at v0, η = u₀Ω/2 and k = tan(c/2),
    ///   the point P of the far edge lies, in stereographic projection from opposite v1, at X = k − σ cos(α−η)/sinα, Y = σ
    ///   sin(α−η)/sinα, σ = 2 sinη/sin c; α−η and η count from the nearer end. With M = X² + Y² = tan²(∠(V₁,P)/2) and g =
    ///   2u₁/(1+M) the direction is zV₁/l₁ + √(g(1+z)) (X, Y), z = 1 − gM, with X along the tangent towards v0. P = (r(r+2b)
    ///   V₀/l₀ + 2b(r + b(1+d₀₂)) V₂/l₂)/|·|, r = sin(Ω/2−η)/sin(Ω/2), b = (1+d₀₁) sinη/G₀; the distance follows from P, and so
    ///   do X and Y where c is long and P is the better conditioned.
    /// - Domain: u in [0, 1)²; any triangle, from either side.
    /// - Density: the pdf is 1/Ω per steradian inside (and within 12 ulp beyond), 0 outside.
    /// - Degenerate input: the point in the plane (also inside the triangle), zero area, or lengths whose sums overflow: Ω = 0
    ///   and pdf 0. So too where the cross product of the vectors to two vertices is shorter than 3e−19 times the square of the
    ///   greatest coordinate, because its square underflows in f32: of a sliver so narrow, or beside an edge; and where the sine of
    ///   the angle at v0, times the lengths that it comes with, underflows: of vertices at very different distances.
    /// - Greatest error over size, elevation, aspect ratio and distance, for edges taken as given: Ω 5e−7 relative,
    ///   except 7e−5 beside the middle of an edge that is a million times longer than the triangle is wide and than the point
    ///   is far; direction 5.4e−7 (1.4e−5 of the angular size where that nears π); distance 5.4e−7 of itself over |cos| at the
    ///   plane, and 5.4e−7 of the farthest vertex's. The inverse is that of a direction 6e−7 away, times the triangle's
    ///   apparent aspect ratio. From less than 1e−3 of its size above the plane of a triangle that surrounds the point, most of
    ///   u₀ lies within the rounding of a direction near the ends of the sweep: there u₁ follows from the rounded u₀, so that
    ///   both lead back to the direction, and may itself be another one.
    /// - Source: Arvo 1995, "Stratified Sampling of Spherical Triangles"; Van Oosterom and Strackee 1983 for Ω; Peters 2021,
    ///   "BRDF Importance Sampling for Polygonal Lights", section 3, for the form without inverse trigonometry, here expressed
    ///   in edges.
    #[doc(alias = "Arvo")]
    #[doc(alias = "SampleSphericalTriangle")]
    #[inline(always)]
    pub fn by_solid_angle(&self, p: Vec3<R>) -> TriangleBySolidAngle<R> {
        BySolidAngle { surface: self.placed(p), shape: self.spherical(p) }
    }
    /// Uniform over the projected solid angle Ω⊥ above the horizon of the unit normal `n` at the point `p`: pdf
    /// cosθ/Ω⊥ per steradian, 0 where nothing of the triangle is above the horizon. On an unoccluded diffuse surface every sample has the
    /// same value.
    ///
    /// The horizon leaves one triangle or two. Each is swept by azimuth about the normal, between its first and last vertex: up
    /// to the azimuth of the middle vertex from the first, and from there on to the last. So in every sector two edges meet in a
    /// vertex, an outer (lower) one and an inner one. A triangle that contains the zenith is swept all around from its first
    /// vertex instead, by the sectors between each edge, or the horizon below which it lies, and the zenith. u₀ is the share of
    /// the projected area that is swept; u₁ goes from the inner edge to the outer, uniform in the squared radius.
    ///
    /// - Formula: at the angle θ from that vertex along the outer edge, let z = ζ cosθ + τ sinθ be the height, D = sinδ sinθ
    ///   the distance from the inner edge's plane (δ is the angle between the edges), c and k the cosines of the outer and the
    ///   inner plane to the horizon, and y = D(2kz + D). Squared radii are as k² : k² + y; the area is ½c ∫ y/(k² + y) dθ =
    ///   ½(cθ − k atan2(c sinθ, k cosθ + ζ sinδ sinθ)). That difference of arcs is formed from c − k and the angle between
    ///   their ends; up to tangents x, v of 0.7 as ½c (x²/B)(Zθ/x + x(G − Zx)(c/k + B)/B² · ∫₀¹ t²/((1+x²t²)(1+v²t²)) dt), Z =
    ///   ζ sinδ/k, G = c/k − 1, B = 1 + Zx, which is accurate relative to its own size at any size. Newton's method inverts it
    ///   in x², or in θ in a bracket, until a step is below 3e−4 of the angle. The direction is the point of the outer edge
    ///   plus a displacement. Ω⊥ is the sum of the areas.
    /// - Domain: u in [0, 1)²; any triangle, from either side, in any position to the horizon; a normal of any length.
    /// - Density: the pdf is cosθ/Ω⊥ per steradian inside (and within 8 ulp beyond) and above the horizon, 0 elsewhere.
    /// - Degenerate input: the point in the plane (also inside the triangle), zero area, lengths whose sums overflow, or
    ///   nothing above the horizon: Ω⊥ = 0 and pdf 0; `sample` returns some vector, of unit length or 0.
    /// - Greatest error: Ω⊥ 4e−7 relative, and at most 1e−5 everywhere, slivers and points next to the triangle's plane
    ///   included, since products and heights that are small differences are formed in twice the working precision. It grows in
    ///   one case: overhead, by at most 5e−16 over the triangle's size and over the sine of the elevation above its plane (which
    ///   matters for sizes below 1e−6). Direction 6e−7, besides 8 steps of 2⁻²⁴ in u; next to the plane of a triangle that
    ///   surrounds the point, a step counts 1/sin of the elevation, since the areas of the sectors then differ by that much.
    ///   Distance as for [`Triangle::by_solid_angle`](crate::Triangle::by_solid_angle). The inverse is that of a direction 1.4e−6 away, times the triangle's apparent
    ///   aspect ratio, besides as many steps; for a point that the triangle surrounds, nearer to the plane than 1e−3 of its
    ///   size, u₁ may be that of a neighbouring azimuth. In a corner, a sweep begins like √u₀ (on the horizon ∛u₀), so the share
    ///   counts from the nearer end. Within 2⁻²⁴ of the whole the inverse is the nearest `u` below 1. If the horizon cuts the
    ///   triangle in two, a u₀ near the join belongs to one or the other; about the zenith, the azimuth at which the sweep
    ///   begins may have 0 or 1 as its inverse.
    /// - Source: Peters 2021, "BRDF Importance Sampling for Polygonal Lights", section 4, for the sectors of the disk; Lambert
    ///   for the areas. Unlike there, sectors start at vertices, not at sorted azimuths: where both edges meet, every quantity
    ///   is a length or a volume of the triangle and as small as the triangle, and the zenith may lie on an edge. The forms
    ///   without cancellation are derived here.
    #[doc(alias = "Peters")]
    #[inline(always)]
    pub fn by_projected_solid_angle(&self, p: Vec3<R>, n: Vec3<R>) -> TriangleByProjectedSolidAngle<R> {
        let v0 = self.v0 - p;
        let shape = ProjectedTriangle::default();
        let mut sampler = ByProjectedSolidAngle { normal: n, surface: self.placed(p), shape };
        sampler.shape.prepare_edges([v0, v0 + self.e1, v0 + self.e2], [self.e1, self.e2], n);
        sampler
    }
    /// In proportion to the lobe of a rough surface at the point `p`: pdf π times that of the [`Reflection`], over the projected solid angle
    /// after its map, per steradian; 0 where nothing of the triangle is above the horizon.
    #[inline(always)]
    pub fn by_reflection(&self, p: Vec3<R>, reflection: &Reflection<R>) -> TriangleByReflection<R> {
        let [v0, e1, e2] = [self.v0 - p, self.e1, self.e2].map(|v| reflection.to_cosine(v));
        let shape = ProjectedTriangle::default();
        let mut sampler = ByReflection { reflection: *reflection, surface: self.placed(p), shape };
        sampler.shape.prepare_edges([v0, v0 + e1, v0 + e2], [e1, e2], Vec3::lit([0.0, 0.0, 1.0]));
        sampler
    }
}

impl<R: Real<Scalar = R>> Triangle<R> {
    /// What it can contribute with this radiance. One that is not positive gives the power 0.
    #[must_use]
    pub fn bound(&self, radiance: R) -> LightBound {
        LightBound::flat(wide(self.v0), &[Vec3::default(), wide(self.e1), wide(self.e2)], radiance.lane_f64(0))
    }
}

/// A [`Triangle`] sampled by area from a point.
pub type TriangleByArea<R> = ByArea<PlacedTriangle<R>>;
/// A [`Triangle`] sampled by solid angle from a point.
pub type TriangleBySolidAngle<R> = BySolidAngle<PlacedTriangle<R>, SphericalTriangle<R>>;
/// A [`Triangle`] sampled by projected solid angle from a point on a surface.
pub type TriangleByProjectedSolidAngle<R> = ByProjectedSolidAngle<R, PlacedTriangle<R>, ProjectedTriangle<R>>;
/// A [`Triangle`] sampled by the lobe of a rough surface.
pub type TriangleByReflection<R> = ByReflection<R, PlacedTriangle<R>, ProjectedTriangle<R>>;
