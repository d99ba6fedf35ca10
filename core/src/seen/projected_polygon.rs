mod piece;
mod sector;

use super::projected_cap::{exact_dot, ratio};
use super::triangle::{SLACK, plane};
use super::{Sighting, lanewise};
use crate::math::rsqrt;
use crate::real::{Mask, Real};
use crate::vector::{Vec2, Vec3};
use crate::warp::{Warp, unit_interval};
use piece::{Corners, Piece};
use sector::Sector;

lanewise! {
    /// The directions from a point to a triangle above the horizon of a surface normal, by projected solid angle: with density
    /// proportional to the cosine to the normal.
    ///
    /// What the horizon leaves is a triangle, or two. Each is swept by azimuth about the normal, between its first and last vertex: up to
    /// the azimuth of the middle one from the first, and from there on to the last (about the zenith, from each vertex to the next), so
    /// that in every sector two edges meet in a vertex, an outer (lower) one and an inner one. u₀ is the share of the area on the unit
    /// disk that is swept, u₁ goes from the inner edge to the outer, uniform in the squared radius.
    ///
    /// - Formula: at the angle θ from that vertex along the outer edge, let z = ζ cosθ + τ sinθ be the height, D = sinδ sinθ the distance
    ///   from the inner edge's plane (δ: between the edges), c and k the cosines of both planes to the horizon, and y = D(2kz + D). Squared
    ///   radii are as k² : k² + y; the area is ½c ∫ y/(k² + y) dθ = ½(cθ − k atan2(c sinθ, k cosθ + ζ sinδ sinθ)). Its difference of
    ///   arcs is formed from c − k and the angle between their ends; up to tangents x, v of 0.7 as
    ///   ½c (x²/B)(Zθ/x + x(G − Zx)(c/k + B)/B² · ∫₀¹ t²/((1+x²t²)(1+v²t²)) dt), Z = ζ sinδ/k, G = c/k − 1, B = 1 + Zx, which is good to
    ///   parts of itself at any size. Newton's method inverts it in x², or in θ in a bracket, until a step is below 3e−4 of the angle. The
    ///   direction is the point of the outer edge and a displacement. Ω⊥ is the sum of the areas.
    /// - Domain: u in [0, 1)²; any triangle, from any side, in any position to the horizon; a normal of any length.
    /// - Density: cosθ/Ω⊥ per steradian inside (and within 8 ulp of the direction beyond) and above the horizon, 0 elsewhere.
    /// - Degenerate: the point in the plane (also inside the triangle), zero area, lengths whose sums overflow, or nothing above the
    ///   horizon: Ω⊥ = 0 and pdf 0; `sample` gives some vector, of unit length or 0.
    /// - Greatest error: Ω⊥ 4e−7 relative, times 1/sin of the elevation of the nearest vertex over the triangle's plane and 1/cos of the
    ///   triangle to the normal. Direction 6e−7, besides 8 steps of 2⁻²⁴ in u. Distance as `SphericalTriangle`. The inverse is that of a
    ///   direction 1.4e−6 away, times how much longer than wide the triangle is seen. In a corner a sweep begins like √u₀ (on the
    ///   horizon ∛u₀): within 2⁻²⁴ of the whole its inverse is the nearest `u` below 1, and if the horizon has cut the triangle in
    ///   two, u₀ near the join belongs to one or the other.
    /// - Source: Peters 2021, "BRDF Importance Sampling for Polygonal Lights", section 4, for the sectors of the disk; Lambert for the
    ///   areas. Sectors from vertices, not between sorted azimuths: where both edges meet every quantity is a length or a volume of the
    ///   triangle and is small as the triangle is, and the zenith may lie on an edge. The forms without cancellation are derived here.
    ///
    /// ```
    /// use etendue::seen::ProjectedTriangle;
    /// use etendue::{Vec2, Vec3, Warp};
    /// // an eighth of the sphere, of which the horizon leaves all: seen on the floor it covers a quarter of the unit disk
    /// let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0_f32]].map(|[x, y, z]| Vec3::new(x, y, z));
    /// let seen = ProjectedTriangle::new(x, y, z, z);
    /// assert!((seen.projected_solid_angle() - std::f32::consts::FRAC_PI_4).abs() < 1e-6);
    /// let w = seen.sample(Vec2::new(0.3, 0.9));
    /// assert!((seen.pdf(w) - w.z / std::f32::consts::FRAC_PI_4).abs() < 1e-6);
    /// ```
    ProjectedTriangle {
        normal: Vec3<R>,
        first: Piece<R>,
        /// what else the horizon has left, beyond `diagonal`
        second: Piece<R>,
        diagonal: Vec3<R>,
        /// inwards, as long as they are well known
        pole0: Vec3<R>,
        pole1: Vec3<R>,
        pole2: Vec3<R>,
        /// (v1−v0)×(v2−v0), and V₀· that
        plane: Vec3<R>,
        volume: R,
        unit: R,
        projected: R,
    }
}

/// A normal of any length to length 1; z for none.
#[inline(always)]
fn unit_normal<R: Real>(normal: Vec3<R>) -> (Vec3<R>, Vec3<R>, R) {
    let (zero, one) = (R::lit(0.0), R::lit(1.0));
    let scaled = normal * normal.max_abs().exponent_reciprocal();
    let squared = scaled.length_squared();
    let flat = squared.le(zero);
    let scaled = Vec3::new(scaled.x, scaled.y, R::select(flat, one, scaled.z));
    let shrink = rsqrt(R::select(flat, one, squared));
    (scaled * shrink, scaled, shrink)
}

impl<R: Real> ProjectedTriangle<R> {
    /// For a triangle with vertices `v0`, `v1`, `v2` relative to the point, on a surface with the normal `normal`.
    #[inline(always)]
    pub fn new(v0: Vec3<R>, v1: Vec3<R>, v2: Vec3<R>, normal: Vec3<R>) -> Self {
        Self::with_sides([v0, v1, v2], [v1 - v0, v2 - v1, v0 - v2], [v1 - v0, v2 - v0], normal)
    }

    /// As `new`, with the edges `e1` = v1−v0 and `e2` = v2−v0 where they are known better than the difference of vertices that
    /// were moved to the point: for a small and far triangle they hold its shape.
    #[inline(always)]
    pub fn with_edges(v0: Vec3<R>, v1: Vec3<R>, v2: Vec3<R>, e1: Vec3<R>, e2: Vec3<R>, normal: Vec3<R>) -> Self {
        Self::with_sides([v0, v1, v2], [e1, e2 - e1, -e2], [e1, e2], normal)
    }

    /// With all three edges, from each vertex to the next, and the plane's normal as a product.
    #[inline]
    fn with_sides(vertices: [Vec3<R>; 3], edges: [Vec3<R>; 3], factors: [Vec3<R>; 2], normal: Vec3<R>) -> Self {
        let zero = R::lit(0.0);
        let reach = |all: &[Vec3<R>]| all.iter().fold(zero, |most, v| most.max(v.max_abs()));
        let reach = reach(&vertices).max(reach(&edges));
        // sums that overflowed: a triangle of no extent
        let finite = reach.lt(R::lit(f64::INFINITY));
        let scale = reach.exponent_reciprocal();
        let scaled = |v: Vec3<R>| Vec3::new(v.x.keep(finite), v.y.keep(finite), v.z.keep(finite)) * scale;
        let (v, e, [f1, f2]) = (vertices.map(scaled), edges.map(scaled), factors.map(scaled));
        let plane = f1.cross(f2);
        let squared = v.map(Vec3::length_squared);
        // the same at each vertex; at the nearest it cancels least
        let nearest = Vec3::select(squared[1].lt(squared[0]), v[1], v[0]);
        let nearest = Vec3::select(squared[2].lt(squared[0].min(squared[1])), v[2], nearest);
        let volume = nearest.dot(plane);
        let (normal, long, shrink) = unit_normal(normal);
        // heights from the first vertex where the edge is the shorter: a sum has lost what the edge still knows
        let over = |v: Vec3<R>| exact_dot(v, long) * shrink;
        let first = over(v[0]);
        let beside =
            |v: Vec3<R>, e: Vec3<R>| R::select(e.length_squared().lt(v.length_squared()), first + over(e), over(v));
        let z = [first, beside(v[1], e[0]), beside(v[2], -e[2])];

        let m: [Vec3<R>; 3] = core::array::from_fn(|i| self::plane(v[i], v[(i + 1) % 3], e[i]));
        let m_squared = m.map(Vec3::length_squared);
        let inverse = m_squared.map(|s| rsqrt(s).keep(s.gt(R::lit(1e-36))));
        let poles = core::array::from_fn(|i| m[i] * inverse[i]);
        let below = z.map(|z| z.lt(zero));
        let cut = below[0] | below[1] | below[2];
        let mut corners = Corners { vertices: v, edges: e, poles, heights: z, volume };
        let (mut second, mut diagonal) = (Piece::default(), Vec3::default());
        if cut.any() {
            let rest;
            (corners, rest, diagonal) = clip(&corners, normal);
            if rest.volume.abs().gt(zero).any() {
                second = Piece::new(&rest, normal);
            }
        }
        let first = Piece::new(&corners, normal);

        let side = |i: usize| {
            // the plane of vertices that lie nearly opposite is known no better than −cos : sin of their angle: by so much shorter
            let length = m_squared[i] * inverse[i];
            poles[i] * ratio(length, length.max(-v[i].dot(v[(i + 1) % 3]))).negate_where(volume.lt(zero))
        };
        Self {
            normal,
            first,
            second,
            diagonal,
            pole0: side(0),
            pole1: side(1),
            pole2: side(2),
            plane,
            volume,
            unit: scale.exponent_reciprocal(),
            projected: first.area + second.area,
        }
    }

    /// Projected solid angle in [0, π]: irradiance per unit of radiance.
    #[inline(always)]
    pub fn projected_solid_angle(&self) -> R {
        self.projected
    }
    /// The density of a direction that is known to hit the triangle, at a cosine to the normal: cosθ/Ω⊥.
    #[inline(always)]
    pub fn density(&self, cos: R) -> R {
        cos.max(R::lit(0.0)) * super::uniform_density(self.projected)
    }
    /// True where the point is on the side to which the normal (v1−v0)×(v2−v0) points.
    #[inline(always)]
    pub fn in_front(&self) -> R::Mask {
        self.volume.lt(R::lit(0.0))
    }

    /// The sector for `u`, and the share of it that is before the azimuth.
    #[inline(always)]
    fn choose(&self, swept: R) -> (Sector<R>, R) {
        let (mut sector, mut share) = self.first.choose(swept);
        let some = self.second.area.gt(R::lit(0.0));
        if some.any() {
            let later = some & swept.ge(self.first.area);
            let (other, rest) = self.second.choose(swept - self.first.area);
            sector = Sector::select(later, &other, &sector);
            share = R::select(later, rest, share);
        }
        (sector, share)
    }
    /// The distance to the plane along a direction, and whether there is one.
    #[inline(always)]
    fn distance(&self, w: Vec3<R>) -> R {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let along = w.dot(self.plane).abs();
        let some = along.gt(zero) & self.projected.gt(zero);
        // a point of the triangle is within 4 units; what does not fit f32 ends at its largest number
        let distance = (self.volume.abs() / R::select(some, along, one)).min(R::lit(4.0)) * self.unit;
        distance.min(R::lit(f64::from(f32::MAX))).keep(some)
    }
    /// The direction for `u` and the distance to the triangle along it.
    #[inline(always)]
    pub fn sight(&self, u: Vec2<R>) -> Sighting<R> {
        let direction = self.sample(u);
        Sighting { direction, distance: self.distance(direction) }
    }
    /// Is the direction inside, give or take the rounding of the direction itself?
    #[inline(always)]
    fn contains(&self, w: Vec3<R>) -> R::Mask {
        let least = w.dot(self.pole0).min(w.dot(self.pole1)).min(w.dot(self.pole2));
        let ahead = w.dot(self.plane).negate_where(self.in_front());
        least.ge(R::lit(-SLACK)) & ahead.ge(-(self.plane.length() * R::lit(SLACK)))
    }
    /// The area before a direction of the triangle, and `u` across.
    #[inline(always)]
    fn locate(&self, w: Vec3<R>) -> Vec2<R> {
        let zero = R::lit(0.0);
        let mut found = self.first.locate(self.normal, w);
        let some = self.second.area.gt(zero);
        if some.any() {
            let later = some & (w.dot(self.diagonal).gt(zero) | self.first.area.le(zero));
            let other = self.second.locate(self.normal, w);
            found.x = R::select(later, self.first.area + other.x, found.x);
            found.y = R::select(later, other.y, found.y);
        }
        found
    }
}

/// What the horizon leaves of a triangle: one or two, and the plane between them, towards the second.
#[inline(never)]
fn clip<R: Real>(corners: &Corners<R>, normal: Vec3<R>) -> (Corners<R>, Corners<R>, Vec3<R>) {
    let (zero, one) = (R::lit(0.0), R::lit(1.0));
    let Corners { vertices: v, edges: e, poles, heights: z, volume } = *corners;
    let below = z.map(|z| z.lt(zero));
    // turned so that the first vertex is above and the last below
    let (by1, by2) = (!below[1] & below[0], !below[2] & below[1]);
    let next = |i: usize, k: usize| (i + k) % 3;
    let pick = |x: [R; 3], i: usize| R::select(by1, x[next(i, 1)], R::select(by2, x[next(i, 2)], x[i]));
    let turned = |x: [Vec3<R>; 3], i: usize| Vec3::select(by1, x[next(i, 1)], Vec3::select(by2, x[next(i, 2)], x[i]));
    let [v0, v1, v2]: [Vec3<R>; 3] = core::array::from_fn(|i| turned(v, i));
    let [e0, e1, e2]: [Vec3<R>; 3] = core::array::from_fn(|i| turned(e, i));
    let [p0, p1, p2]: [Vec3<R>; 3] = core::array::from_fn(|i| turned(poles, i));
    let [z0, z1, z2]: [R; 3] = core::array::from_fn(|i| pick(z, i));
    let whole = !(below[0] | below[1] | below[2]);
    let none = below[0] & below[1] & below[2];
    // where an edge from above meets the horizon
    let part = |a: R, b: R| ratio(a.max(zero), a.max(zero) - b.min(zero));
    let (t0, t1, t2) = (part(z0, z1), part(z1, z2), part(z0, z2));
    let (r1, r2) = (part(-z2, -z1), part(-z2, -z0));
    let quad = z1.ge(zero);
    // where that is near the point, the sum cancels: there it is on the line in which the plane of the edge meets the horizon
    let meet = |v: Vec3<R>, e: Vec3<R>, t: R, pole: Vec3<R>| {
        let sum = e.mul_add(t, v);
        let line = pole.cross(normal);
        let squared = line.length_squared();
        let better = (squared * v.length_squared()).gt(sum.length_squared());
        Vec3::select(better, line * ratio(sum.dot(line), squared), sum)
    };
    let (h0, h1, h2) = (meet(v0, e0, t0, p0), meet(v1, e1, t1, p1), meet(v0, -e2, t2, p2));
    let across = e0 + e1 * t1;
    let choose = |of_quad: Vec3<R>, of_triangle: Vec3<R>, all: Vec3<R>| {
        Vec3::select(whole, all, Vec3::select(quad, of_quad, of_triangle))
    };
    let last = e2 * t2;
    let diagonal = plane(v0, h1, across);
    let squared = diagonal.length_squared();
    let diagonal = diagonal * rsqrt(squared).keep(squared.gt(R::lit(1e-36)));
    let turn = one.negate_where(volume.lt(zero));
    let horizon = normal * turn;
    let first = Corners {
        vertices: [v0, choose(v1, h0, v1), choose(h1, h2, v2)],
        edges: [choose(e0, e0 * t0, e0), choose(e1 * t1, -(last + e0 * t0), e1), choose(-across, last, e2)],
        poles: [p0, choose(p1, horizon, p1), choose(-diagonal, p2, p2)],
        heights: [z0, R::select(quad, z1, zero), z2.keep(whole)],
        volume: R::select(whole, volume, (volume * R::select(quad, t1, t0 * t2)).keep(!none)),
    };
    let second = Corners {
        vertices: [v0, h1, h2],
        edges: [across, e1 * r1 + e2 * r2, last],
        poles: [diagonal, horizon, p2],
        heights: [z0, zero, zero],
        volume: (volume * r1 * t2).keep(quad & !whole & !none),
    };
    (first, second, diagonal * turn)
}

impl<R: Real> Warp<R> for ProjectedTriangle<R> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        let (sector, share) = self.choose(u.x * self.projected);
        sector.direction(self.normal, sector.sweep(share), u.y)
    }
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        self.density(w.dot(self.normal)).keep(self.contains(w))
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let found = self.locate(w);
        Vec2 { x: unit_interval(ratio(found.x, self.projected)), y: found.y }
    }
}

/// The directions from a point to a convex polygon of N corners, 3 ≤ N ≤ 8, above the horizon of a surface normal, by projected solid
/// angle: with density proportional to the cosine to the normal.
///
/// A fan of N − 2 [`ProjectedTriangle`]s about the first corner, in turn for u₀: each is clipped to the horizon by itself, and there is no
/// sorting by azimuth, whose order is noise where azimuths are near.
///
/// - Formula: Ω⊥ = ΣΩ⊥ᵢ; the triangle i for which Ω⊥₁ + … + Ω⊥ᵢ first exceeds u₀Ω⊥, at the rest of u₀Ω⊥ over Ω⊥ᵢ.
/// - Domain: u in [0, 1)²; corners in order, either way round, no farther from one plane than their rounding.
/// - Density: cosθ/Ω⊥ per steradian inside and above the horizon, 0 elsewhere.
/// - Degenerate: corners that coincide or lie in line are allowed; otherwise, error and source: as the triangle. From one triangle to the
///   next the map jumps: within the rounding of the areas before, a `u₀` may belong to one or the other.
#[derive(Clone, Copy, Debug)]
pub struct ProjectedPolygon<R, const N: usize> {
    /// The last two are empty.
    fan: [ProjectedTriangle<R>; N],
    projected: R,
}

impl<R: Real, const N: usize> Default for ProjectedPolygon<R, N> {
    fn default() -> Self {
        Self { fan: [ProjectedTriangle::default(); N], projected: R::lit(0.0) }
    }
}

impl<R: Real> ProjectedPolygon<R, 4> {
    /// For a parallelogram with the corner `p` relative to the point, and the edges `u` and `v`, on a surface with the normal
    /// `normal`. Its shape is that of the edges, however small and far it is.
    #[inline(always)]
    pub fn parallelogram(p: Vec3<R>, u: Vec3<R>, v: Vec3<R>, normal: Vec3<R>) -> Self {
        let (a, b) = (p + u, p + v);
        let (both, c) = (u + v, a + v);
        let mut fan = [ProjectedTriangle::default(); 4];
        fan[0] = ProjectedTriangle::with_sides([p, a, c], [u, v, -both], [u, v], normal);
        fan[1] = ProjectedTriangle::with_sides([p, c, b], [both, -u, -v], [u, v], normal);
        Self { projected: fan[0].projected + fan[1].projected, fan }
    }
}

impl<R: Real, const N: usize> ProjectedPolygon<R, N> {
    const TRIANGLES: usize = {
        assert!(N >= 3 && N <= 8, "a polygon has 3 to 8 corners");
        N - 2
    };
    /// For corners relative to the point, on a surface with the normal `normal`.
    #[inline(always)]
    pub fn new(corners: [Vec3<R>; N], normal: Vec3<R>) -> Self {
        let mut fan = [ProjectedTriangle::default(); N];
        let mut projected = R::lit(0.0);
        for i in 0..Self::TRIANGLES {
            fan[i] = ProjectedTriangle::new(corners[0], corners[i + 1], corners[i + 2], normal);
            projected += fan[i].projected;
        }
        Self { fan, projected }
    }
    /// Prepared for one point: the same in every lane.
    #[inline(always)]
    pub fn splat(s: ProjectedPolygon<R::Scalar, N>) -> Self {
        Self { fan: s.fan.map(ProjectedTriangle::splat), projected: R::splat(s.projected) }
    }
    /// Projected solid angle in [0, π]: irradiance per unit of radiance.
    #[inline(always)]
    pub fn projected_solid_angle(&self) -> R {
        self.projected
    }
    /// The density of a direction that is known to hit the polygon, at a cosine to the normal: cosθ/Ω⊥.
    #[inline(always)]
    pub fn density(&self, cos: R) -> R {
        cos.max(R::lit(0.0)) * super::uniform_density(self.projected)
    }
    /// True where the point is on the side from which the corners run counterclockwise.
    #[inline(always)]
    pub fn in_front(&self) -> R::Mask {
        let mut front = R::Mask::splat(false);
        for triangle in &self.fan[..Self::TRIANGLES] {
            front = front | triangle.in_front();
        }
        front
    }
    /// The direction for `u` and the distance to the polygon along it.
    #[inline(always)]
    pub fn sight(&self, u: Vec2<R>) -> Sighting<R> {
        let (direction, distance) = self.draw(u, true);
        Sighting { direction, distance }
    }
    #[inline]
    fn draw(&self, u: Vec2<R>, far: bool) -> (Vec3<R>, R) {
        let zero = R::lit(0.0);
        let swept = u.x * self.projected;
        let (mut sector, mut share) = self.fan[0].choose(swept);
        let mut chosen = R::lit(0.0);
        let mut sum = self.fan[0].projected;
        for (i, triangle) in self.fan[..Self::TRIANGLES].iter().enumerate().skip(1) {
            let some = triangle.projected.gt(zero);
            if some.any() {
                let later = swept.ge(sum) & some | (sum.le(zero) & some);
                let (other, rest) = triangle.choose(swept - sum);
                sector = Sector::select(later, &other, &sector);
                share = R::select(later, rest, share);
                chosen = R::select(later, R::lit(i as f64), chosen);
            }
            sum += triangle.projected;
        }
        let w = sector.direction(self.fan[0].normal, sector.sweep(share), u.y);
        let mut distance = zero;
        if far {
            for (i, triangle) in self.fan[..Self::TRIANGLES].iter().enumerate() {
                let here = chosen.ge(R::lit(i as f64 - 0.5)) & chosen.lt(R::lit(i as f64 + 0.5));
                distance = R::select(here, triangle.distance(w), distance);
            }
        }
        (w, distance)
    }
}

impl<R: Real, const N: usize> Warp<R> for ProjectedPolygon<R, N> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        self.draw(u, false).0
    }
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        let mut inside = R::Mask::splat(false);
        for triangle in &self.fan[..Self::TRIANGLES] {
            inside = inside | (triangle.contains(w) & !triangle.volume.abs().le(R::lit(0.0)));
        }
        self.density(w.dot(self.fan[0].normal)).keep(inside)
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let zero = R::lit(0.0);
        let mut found = self.fan[0].locate(w);
        let mut sum = self.fan[0].projected;
        for triangle in &self.fan[1..Self::TRIANGLES] {
            let some = triangle.projected.gt(zero);
            // on the far side of the edge with which the triangle begins
            let later = some & (w.dot(triangle.pole0).ge(zero) | sum.le(zero));
            let other = triangle.locate(w);
            found.x = R::select(later, sum + other.x, found.x);
            found.y = R::select(later, other.y, found.y);
            sum += triangle.projected;
        }
        Vec2 { x: unit_interval(ratio(found.x, self.projected)), y: found.y }
    }
}
