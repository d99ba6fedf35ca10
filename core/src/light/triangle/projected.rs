//! Triangles by projected solid angle.

pub(in crate::light) mod found;
mod horizon;
pub(in crate::light) mod piece;
pub(in crate::light) mod sector;
pub(in crate::light) mod zenith;

use crate::lanewise::lanewise;
use crate::light::direction::{DirectionSample, to_unit};
use crate::light::seen::ProjectedShape;
use crate::math::{ratio, rsqrt};
use crate::real::{Blend, Mask, Real, unit_interval};
use crate::vector::double_word::{cross_dw, dot_dw, height_dw, sum_dw, unit_normal};
use crate::vector::{Vec2, Vec3};
use crate::warp::Warp;
use found::{FoundSector, after, edge};
use horizon::{Exact, clip};
use piece::{Corners, Piece, narrowest};
use sector::Sector;
use zenith::{Search, Side, drop_narrow, sectors, surrounds};

/// Heights below this, in units of the greatest coordinate, count as on the horizon.
pub(in crate::light) const LEAST_HEIGHT: f64 = 1e-30;
/// Angle by which the error of its direction may move a sample out of the triangle: 8 ulp of a component near 1.
const PROJECTED_SLACK: f64 = 8.0 / 16_777_216.0;

lanewise! {
    /// Directions from a point to a triangle above the horizon of a surface, by projected solid angle (pdf ∝ cosine to the
    /// normal): for diffuse surfaces where a ray costs more than a sample.
    ///
    /// [`Triangle::by_projected_solid_angle`](crate::Triangle::by_projected_solid_angle) says how.
    pub struct ProjectedTriangle {
        /// unit normal of the surface
        pub(in crate::light) normal: Vec3<R>,
        /// the part above the horizon, or the first of two
        pub(in crate::light) first: Piece<R>,
        /// the second part, beyond `diagonal`; empty if there is one
        pub(in crate::light) second: Piece<R>,
        /// unit normal of the plane between the parts, towards the second
        pub(in crate::light) diagonal: Vec3<R>,
        /// normal of the plane through the viewpoint, v0 and v1, pointing inwards; shorter where the plane is less well known
        pub(in crate::light) pole0: Vec3<R>,
        /// the same for v1 and v2
        pub(in crate::light) pole1: Vec3<R>,
        /// the same for v2 and v0
        pub(in crate::light) pole2: Vec3<R>,
        /// (v1−v0)×(v2−v0)
        pub(in crate::light) plane: Vec3<R>,
        /// V₀·plane
        pub(in crate::light) volume: R,
        /// unit of the lengths above, a power of two
        pub(in crate::light) unit: R,
        /// 1 if the triangle contains the zenith and has sectors about it, else 0
        pub(in crate::light) central: R,
        /// Ω⊥ in steradians
        pub(in crate::light) projected: R,
    }
}

/// A triangle, with its derived quantities as accurately as they are known.
pub(in crate::light) struct Given<R> {
    /// relative to the point, scaled so that all lengths are below 4
    pub(in crate::light) vertices: [Vec3<R>; 3],
    /// rounding errors of those that are rounded
    pub(in crate::light) rests: [Option<Vec3<R>>; 3],
    /// from each vertex to the next
    pub(in crate::light) edges: [Vec3<R>; 3],
    /// cross products of each vertex and the next, as unevaluated sums
    pub(in crate::light) products: [[Vec3<R>; 2]; 3],
    /// (v1−v0)×(v2−v0), as an unevaluated sum
    pub(in crate::light) plane: [Vec3<R>; 2],
}

/// a − b as an unevaluated sum.
#[inline(always)]
fn difference<R: Real>(a: Vec3<R>, b: Vec3<R>) -> [Vec3<R>; 2] {
    sum_dw([a, Vec3::default()], [-b, Vec3::default()])
}

/// The rounding error p + e − v of the vertex v ≈ p + e.
#[inline(always)]
pub(in crate::light) fn lack<R: Real>(v: Vec3<R>, p: Vec3<R>, e: [Vec3<R>; 2]) -> Vec3<R> {
    let [sum, rest] = sum_dw([p, Vec3::default()], e);
    (sum - v) + rest
}

/// n + a×b for an unevaluated sum n and a small a×b.
#[inline(always)]
pub(in crate::light) fn with_rest<R: Real>([n, rest]: [Vec3<R>; 2], a: Vec3<R>, b: Vec3<R>) -> [Vec3<R>; 2] {
    [n, rest + a.cross(b)]
}

/// The product of the normal and the cross product `n` of the ends of an edge, one of which is `v` with the rounding error `rest`.
///
/// Only the part of the normal across v counts. Overhead it is a small difference: formed first, it leaves as many digits as the normal
/// has.
#[inline(always)]
pub(in crate::light) fn area<R: Real>(normal: Vec3<R>, [v, rest]: [Vec3<R>; 2], n: [Vec3<R>; 2]) -> [R; 2] {
    let along = ratio(R::lit(1.0), v.length_squared()).lesser(R::lit(1e36)) * v.dot(normal);
    let across = |normal: R, v: R, rest: R| {
        let p = along * v;
        let (sum, error) = normal.two_sum(-p);
        sum.two_sum(error - along.mul_add(rest, R::two_prod_error(along, v, p)))
    };
    let ((x, ex), (y, ey), (z, ez)) =
        (across(normal.x, v.x, rest.x), across(normal.y, v.y, rest.y), across(normal.z, v.z, rest.z));
    let [sum, more] = height_dw(Vec3::new(x, y, z), n);
    [sum, more + Vec3::new(ex, ey, ez).dot(n[0])]
}

impl<R: Real> ProjectedTriangle<R> {
    /// Prepares for the vertices relative to the point and the edges from the first one to the others (in any unit of length), on a surface
    /// with this normal (of any length). The edges give the shape of a small and far triangle. In place: a prepared packet is kilobytes, and
    /// each copy of it counts. It must be empty before.
    #[inline]
    pub(in crate::light) fn prepare_edges(
        &mut self,
        [v0, v1, v2]: [Vec3<R>; 3],
        [e1, e2]: [Vec3<R>; 2],
        normal: Vec3<R>,
    ) {
        let ([v0, v1, v2, e1, e2], scale) = to_unit([v0, v1, v2, e1, e2]);
        let none = Vec3::default();
        self.prepare_sides(
            [v0, v1, v2],
            [lack(v1, v0, [e1, none]), lack(v2, v0, [e2, none])],
            [[e1, none], difference(e2, e1), [-e2, none]],
            [e1, e2],
            normal,
            scale,
        );
    }

    /// Prepares, in place, from vertices with the rounding errors of the second and third, all three edges (from each vertex to the next,
    /// as unevaluated sums), and the plane's normal as a cross product of two factors; all lengths below 4.
    #[inline(always)]
    pub(in crate::light) fn prepare_sides(
        &mut self,
        vertices: [Vec3<R>; 3],
        rests: [Vec3<R>; 2],
        edges: [[Vec3<R>; 2]; 3],
        factors: [Vec3<R>; 2],
        normal: Vec3<R>,
        scale: R,
    ) {
        let [v0, v1, _] = vertices;
        let [e0, e1, e2] = edges;
        let [n, rest] = cross_dw(v1, e1[0]);
        let products = [
            with_rest(cross_dw(v0, e0[0]), v0, e0[1]),
            [n, rest + (v1.cross(e1[1]) + rests[0].cross(e1[0]))],
            with_rest(cross_dw(v0, e2[0]), v0, e2[1]),
        ];
        let plane = cross_dw(factors[0], factors[1]);
        let rests = [None, Some(rests[0]), Some(rests[1])];
        let corners = Given { vertices, rests, edges: edges.map(|e| e[0]), products, plane };
        self.prepare(&corners, normal, scale);
    }

    #[inline]
    pub(in crate::light) fn prepare(&mut self, given: &Given<R>, normal: Vec3<R>, scale: R) {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let Given { vertices: v, rests, edges: e, products, plane } = *given;
        let [sum, more] = height_dw(v[0], plane);
        let volume = sum + rests[0].map_or(more, |rest| more + rest.dot(plane[0]));
        let plane = plane[0] + plane[1];
        let (normal, long, shrink) = unit_normal(normal);
        let heights: [[R; 2]; 3] = core::array::from_fn(|i| {
            let [z, more] = dot_dw(v[i], long);
            [z, rests[i].map_or(more, |rest| more + rest.dot(long))]
        });
        // below this the errors of products are subnormal, and the horizon would cut by rounding
        let heights = heights.map(|pair| {
            let some = (pair[0] + pair[1]).abs().gt(R::lit(LEAST_HEIGHT));
            pair.map(|x| x.keep(some))
        });
        // each edge from an end whose rounding error is exact: the last from the first vertex
        let volumes: [[R; 2]; 3] =
            core::array::from_fn(|i| area(long, [v[i % 2], rests[i % 2].unwrap_or_default()], products[i]));
        let rounded = |[x, rest]: [R; 2]| (x + rest) * shrink;
        let (z, areas) = (heights.map(rounded), volumes.map(rounded));
        let exact = Exact { edges: e, products, heights, volumes, shrink };
        let products = products.map(|[n, rest]| n + rest);
        let m_squared = products.map(Vec3::length_squared);
        let inverses = m_squared.map(|s| rsqrt(s).keep(s.gt(R::lit(1e-36))));
        let lengths: [R; 3] = core::array::from_fn(|i| m_squared[i] * inverses[i]);
        let poles: [Vec3<R>; 3] = core::array::from_fn(|i| products[i] * inverses[i]);
        let below = z.map(|z| z.lt(zero));
        let cut = below[0] | below[1] | below[2];
        let corners = Corners { vertices: v, poles, lengths, areas, heights: z, volume };
        let sides: [Side<R>; 3] = core::array::from_fn(|i| Side {
            a: v[i],
            b: v[(i + 1) % 3],
            product: products[i],
            area: areas[i],
            heights: [z[i], z[(i + 1) % 3]],
        });
        let turn = one.negate_where(volume.lt(zero));
        let central = surrounds(&areas, turn) & volume.abs().gt(zero);
        if !central.all() {
            let mut parts = (corners, Corners::default(), Vec3::default());
            R::take_any(cut, &mut parts, |parts| clip(&parts.0, &exact, normal), Blend::<R>::take);
            let (first, second, diagonal) = &parts;
            self.diagonal = *diagonal;
            let swept = |_: &Piece<R>| {
                let mut piece = Piece::default();
                piece.sweep(second, normal);
                piece
            };
            R::take_any(second.volume.abs().gt(zero), &mut self.second, swept, Blend::<R>::take);
            self.first.sweep(first, normal);
            // if the horizon leaves next to nothing of a piece, only u = 0 falls into it
            let least = narrowest::<R>() * (self.first.area + self.second.area);
            for piece in [&mut self.first, &mut self.second] {
                piece.area = piece.area.keep(piece.area.gt(least));
            }
        }
        let about_zenith = |_: &Self| {
            let mut pieces = sectors(&sides, 0, normal, turn);
            let whole = pieces[0].area + pieces[1].area;
            drop_narrow(&mut pieces, whole);
            pieces
        };
        R::take_any(central, self, about_zenith, |this, central, [first, second]| {
            this.first.take(central, first);
            this.second.take(central, second);
        });
        let side = |i: usize| {
            // the plane of nearly opposite vertices is known only to −cos : sin of their angle; shorten the pole by that much
            let length = lengths[i];
            poles[i] * ratio(length, length.greater(-v[i].dot(v[(i + 1) % 3]))).negate_where(volume.lt(zero))
        };
        self.normal = normal;
        (self.pole0, self.pole1, self.pole2) = (side(0), side(1), side(2));
        self.plane = plane;
        self.volume = volume;
        self.unit = scale.pow2_scale();
        self.central = one.keep(central);
        // from the triangle's plane nothing is visible, whatever the rounded areas are
        self.projected = (self.first.area + self.second.area).keep(volume.abs().gt(zero));
    }

    /// The sector that has the area `swept` before it and `left` after it, and the share of the sector before the azimuth,
    /// counted from its apex.
    #[inline(always)]
    pub(in crate::light) fn choose(&self, swept: R, left: R) -> (Sector<R>, R) {
        let first = self.first.choose(swept, left - self.second.area);
        let later = self.second.area.gt(R::lit(0.0)) & swept.ge(self.first.area);
        R::where_any(later, first, || self.second.choose(swept - self.first.area, left))
    }
    /// The sector for u₀, and the share of it before the azimuth, counted from its apex.
    #[inline(always)]
    fn sector_at(&self, x: R) -> (Sector<R>, R) {
        self.choose(x * self.projected, (R::lit(1.0) - x) * self.projected)
    }
    /// The distance to the plane along a direction; 0 where there is none.
    #[inline(always)]
    pub(in crate::light) fn distance(&self, w: Vec3<R>) -> R {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let along = w.dot(self.plane).abs();
        let some = along.gt(zero) & self.projected.gt(zero);
        // a point of the triangle is within 4 units; a distance that does not fit f32 becomes the largest finite number
        let distance = (self.volume.abs() / R::blend(some, along, one)).lesser(R::lit(4.0)) * self.unit;
        distance.lesser(R::lit(f64::from(f32::MAX))).keep(some)
    }
    /// Turns the poles inwards as for a triangle seen from the front (`front`) or from the back.
    #[inline(always)]
    pub(in crate::light) fn face(&mut self, front: R::Mask) {
        let turn = R::lit(1.0).negate_where(front ^ self.in_front());
        for pole in [&mut self.pole0, &mut self.pole1, &mut self.pole2] {
            *pole = *pole * turn;
        }
    }
    /// The sector in which a direction of the triangle is; areas are kept `edge` away from a jump of the map.
    #[inline(always)]
    pub(in crate::light) fn find(&self, w: Vec3<R>, edge: R) -> FoundSector<R> {
        let (found, areas) = (self.first.find(self.normal, w, edge), [self.first.area, self.second.area]);
        let found = R::where_any(self.second.area.gt(R::lit(0.0)), found, || {
            let later = after(areas, w.dot(self.diagonal).gt(R::lit(0.0)), edge);
            found.or(self.second.find(self.normal, w, edge), later, [areas[0], areas[1], edge])
        });
        R::where_any(self.central.gt(R::lit(0.0)), found, || self.search(Search::default(), w, edge).found)
    }
    /// Looks for the azimuth of a direction in the sectors about the zenith.
    #[inline(always)]
    pub(in crate::light) fn search(&self, search: Search<R>, w: Vec3<R>, edge: R) -> Search<R> {
        search.look(&self.first, self.normal, w, edge).look(&self.second, self.normal, w, edge)
    }
    /// Whether u₁ depends on how u₀ is rounded: see [`Sector::at_share`].
    #[inline(always)]
    pub(in crate::light) fn is_narrow(&self, whole: R) -> R::Mask {
        self.first.is_narrow(whole) | self.second.is_narrow(whole)
    }
}

/// Tells whether a direction is inside all sides, given the least sine over them; allows for the rounding of the direction
/// itself.
#[inline(always)]
pub(in crate::light) fn within<R: Real>(least: R) -> R::Mask {
    least.ge(R::lit(-PROJECTED_SLACK))
}
/// Tells whether a direction leads towards the plane with that normal, with the same allowance.
#[inline(always)]
pub(in crate::light) fn ahead<R: Real>(w: Vec3<R>, plane: Vec3<R>, front: R::Mask) -> R::Mask {
    w.dot(plane).negate_where(front).ge(-(plane.length() * R::lit(PROJECTED_SLACK)))
}

impl<R: Real> ProjectedShape<R> for ProjectedTriangle<R> {
    #[inline(always)]
    fn sample_direction(&self, u: Vec2<R>) -> DirectionSample<R> {
        let direction = self.sample(u);
        DirectionSample { direction, distance: self.distance(direction) }
    }
    #[inline(always)]
    fn projected_solid_angle(&self) -> R {
        self.projected
    }
    #[inline(always)]
    fn contains(&self, w: Vec3<R>) -> R::Mask {
        let least = w.dot(self.pole0).lesser(w.dot(self.pole1)).lesser(w.dot(self.pole2));
        within(least) & ahead(w, self.plane, self.in_front())
    }
    #[inline(always)]
    fn in_front(&self) -> R::Mask {
        self.volume.lt(R::lit(0.0))
    }
}

impl<R: Real> Warp<R> for ProjectedTriangle<R> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        let (sector, share) = self.sector_at(u.x);
        sector.direction(self.normal, sector.sweep(share), u.y)
    }
    /// The pdf per steradian; 0 for a direction that misses the triangle or lies below the horizon.
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        self.pdf_at_cosine(w.dot(self.normal)).keep(self.contains(w))
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let found = self.find(w, edge(self.projected)).place(self.normal, w);
        let x = unit_interval(ratio(found.x, self.projected));
        let [y] = R::where_any(self.is_narrow(self.projected), [found.y], || {
            let (sector, share) = self.sector_at(x);
            [sector.at_share(self.normal, share, w, self.projected, found.y)]
        });
        Vec2 { x, y }
    }
}
