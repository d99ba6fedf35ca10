//! An image of the sky through portals: parallelograms in walls that nothing else of the sky passes.

mod map;
mod side;
mod table;

use super::distant::met;
use super::sample::LightSample;
use super::sampler::LightSampler;
use crate::real::{GREATEST, MOST_LANES, Mask, Real, unit_interval};
use crate::vector::{Vec2, Vec3};
use crate::warp::{Octahedral, Warp};
pub use map::{PortalError, PortalMap};
use side::Side;
pub use table::PortalTable;
use table::{Columns, FoundCell, STEPS, Search, Span, SpanPlace};

/// See [`PortalEnvironment::MOST`].
const MOST_PORTALS: usize = 8;

/// A parallelogram through which the sky is seen, from the side that its normal s × t points away from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Portal {
    corner: [f32; 3],
    lengths: [f64; 2],
    map: PortalMap,
}

impl Portal {
    /// Makes the portal with this corner and the edges `s` and `t` from there, in the coordinates of the scene.
    ///
    /// # Errors
    /// If the edges are parallel or a number is not finite.
    #[inline]
    pub fn new(corner: [f32; 3], s: [f32; 3], t: [f32; 3]) -> Result<Self, PortalError> {
        let map = PortalMap::new(s, t)?;
        let lengths = [s, t].map(|v| Vec3::<f64>::from(v.map(f64::from)).unit_and_length().1);
        corner.iter().all(|x| x.is_finite()).then_some(Self { corner, lengths, map }).ok_or(PortalError::Corner)
    }
    /// Its area.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.lengths[0] * self.lengths[1] * self.map.sin
    }
    /// Its first corner.
    #[must_use]
    pub const fn corner(&self) -> [f32; 3] {
        self.corner
    }
    /// Its edges `s` and `t` from there.
    #[must_use]
    pub fn edges(&self) -> [Vec3<f64>; 2] {
        [0, 1].map(|k| self.map.axes[k] * self.lengths[k])
    }
    /// Whether the portal shows the sky to a point: it is on the side that the normal points away from.
    #[inline(always)]
    pub fn faces<R: Real>(&self, p: Vec3<R>) -> R::Mask {
        self.sides(p).1
    }
    /// Mean of the cosines of the corners to a normal, each at least [`GRAZING`]; 0 if all of them are below the horizon.
    #[inline(always)]
    fn mean_cos<R: Real>(&self, p: Vec3<R>, normal: Vec3<R>) -> R {
        let [s, t] = self.edges().map(|edge| Vec3::lit([edge.x, edge.y, edge.z]));
        let first = Vec3::lit(self.corner.map(f64::from)) - p;
        let (mut sum, mut above) = (R::lit(0.0), R::Mask::splat(false));
        for corner in [first, first + s, first + t, first + s + t] {
            let cos = corner.unit_and_length().0.dot(normal);
            above = above | cos.gt(R::lit(-GRAZING));
            sum += cos.greater(R::lit(GRAZING));
        }
        (sum * R::lit(0.25)).keep(above)
    }
    /// The map in which its table shows the sky.
    #[must_use]
    pub fn map(&self) -> PortalMap {
        self.map
    }
    #[inline(always)]
    fn sides<R: Real>(&self, p: Vec3<R>) -> ([Side<R>; 2], R::Mask) {
        let [x, y, z] = self.map.local(Vec3::lit(self.corner.map(f64::from)) - p);
        let (across, some) = Side::new(x, R::lit(self.lengths[0]), z);
        let (up, more) = Side::new(y, R::lit(self.lengths[1]), z);
        ([across, up], some & more)
    }
}

#[inline(always)]
fn spans<R: Real>(table: &PortalTable<'_>, sides: &[Side<R>; 2], lane: usize) -> [Span; 2] {
    let [w, h] = table.size();
    [sides[0].span(lane, w), sides[1].span(lane, h)]
}

/// The part of an image of the sky that is seen through some portals, at most [`MOST`](Self::MOST); the rest of the sky is hidden by walls.
///
/// What the sky is like beyond the portals is in the tables of the portals: from each point exactly the part is sampled that the point sees,
/// by the weights of the texels. A direction through two portals counts once: the pdf is that with which either one draws it.
///
/// - Formula: a portal is a rectangle in its [`PortalMap`]. Among the columns of all portals one is drawn by its weight within the rectangle,
///   then a row of it, then a place uniform in the map; texels that the border cuts count with their part.
/// - Domain: u in [0, 1)²; any point.
/// - Density: probability of the cells over the solid angle that they cover there, per steradian, summed over portals; 0 where no portal is
///   seen, and from behind. Each column and row has at least 2⁻²⁴ of the numbers, so that the probabilities are those of the draw exactly.
/// - Degenerate: no portal seen, from within 1e−6 rad of its plane or from behind: pdf 0.
/// - Greatest error: direction 6e−7. A direction within 3e−7/sinφ beside a portal passes it, φ being the angle between its edges. Next to the
///   edge of a texel rounding decides whose pdf a sample has.
/// - Source: Bitterli, Novák and Jarosz 2015, and Crow 1984 for the table.
///
/// ```
/// use etendue::light::{Portal, PortalEnvironment, PortalMap, PortalTable};
/// use etendue::{LightSampler, Vec2};
/// // a portal of 1 by 2 in the plane x = 3, under a sky of the same radiance everywhere
/// let (corner, s, t) = ([3.0, -0.5, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 2.0]);
/// let map = PortalMap::new(s, t).unwrap();
/// let place = |i: usize| Vec2::new((i % 16) as f64 + 0.5, (i / 16) as f64 + 0.5) * (1.0 / 16.0);
/// let weights: Vec<f32> = (0..256).map(|i| map.direction(place(i)).1 as f32).collect();
/// let mut buffer = [0; PortalTable::buffer(16, 16)];
/// let table = PortalTable::build(&weights, 16, &mut buffer).unwrap();
/// let (portals, tables) = ([Portal::new(corner, s, t).unwrap()], [table]);
/// let sky = PortalEnvironment::new(&portals, &tables).unwrap();
/// let sampler = sky.by_radiance([0.0; 3].into());
/// let w = sampler.sample(Vec2::new(0.3_f32, 0.6)).direction;
/// let [y, z] = [w.y, w.z].map(|x| x / w.x * 3.0); // where it passes the plane of the portal
/// assert!((-0.5..0.5).contains(&y) && (0.0..2.0).contains(&z) && sampler.pdf(w) > 0.0);
/// assert_eq!(sampler.pdf([1.0, 0.0, 0.9].into()), 0.0); // above it
/// ```
#[derive(Clone, Copy, Debug)]
pub struct PortalEnvironment<'a> {
    portals: &'a [Portal],
    tables: &'a [PortalTable<'a>],
    /// The greatest unit of a table.
    unit: f64,
}

impl<'a> PortalEnvironment<'a> {
    /// The greatest number of portals.
    pub const MOST: usize = MOST_PORTALS;

    /// The sky through these portals, with the table of each. Portals with the same [`PortalMap`] may share one.
    ///
    /// # Errors
    /// If there are none or more than [`MOST`](Self::MOST), or not as many tables.
    #[inline]
    pub fn new(portals: &'a [Portal], tables: &'a [PortalTable<'a>]) -> Result<Self, PortalError> {
        if !(1..=MOST_PORTALS).contains(&portals.len()) {
            return Err(PortalError::Count);
        }
        if tables.len() != portals.len() {
            return Err(PortalError::Tables);
        }
        let unit = tables.iter().fold(0.0, |most: f64, table| most.max(table.unit));
        Ok(Self { portals, tables, unit })
    }
    /// Whether a ray from `p` in the unit direction `w` passes a portal towards the sky.
    #[inline(always)]
    pub fn sees<R: Real>(&self, p: Vec3<R>, w: Vec3<R>) -> R::Mask {
        self.portals.iter().fold(R::Mask::splat(false), |sees, portal| {
            let ([across, up], visible) = portal.sides(p);
            let [x, y, z] = portal.map.local(w);
            sees | visible & passes([&across, &up], [x, y, z], portal.map.slack())
        })
    }
    /// Directions from `p` in proportion to the weights.
    #[inline(always)]
    pub fn by_radiance<R: Real>(&self, p: Vec3<R>) -> PortalsByRadiance<'a, R> {
        self.prepared(p, |_| R::lit(1.0))
    }
    /// Directions from a point of a surface with this unit normal, in proportion to the weights within each portal, while a portal weighs
    /// less the more slanting the surface sees it.
    ///
    /// The weight of a portal is that of what is seen times the mean of max(cosθ, 10⁻³) over its corners, θ being measured from the
    /// normal. A portal whose corners all have cosθ < −10⁻³ is below the horizon: it has no sample, and the pdf 0. If all are, so has
    /// every direction.
    #[inline(always)]
    pub fn by_radiance_above<R: Real>(&self, p: Vec3<R>, normal: Vec3<R>) -> PortalsByRadiance<'a, R> {
        self.prepared(p, |portal| portal.mean_cos(p, normal))
    }
    /// Prepares for a point. The weight of each portal is multiplied by what it is worth; at 0, it is not seen.
    #[inline(always)]
    fn prepared<R: Real>(&self, p: Vec3<R>, worth: impl Fn(&Portal) -> R) -> PortalsByRadiance<'a, R> {
        let mut seen = [SeenPortal::default(); MOST_PORTALS];
        const { assert!(R::LANES <= MOST_LANES) };
        let mut cells = [0; MOST_LANES];
        let mut weights = [0.0; MOST_LANES];
        for ((portal, table), own) in self.portals.iter().zip(self.tables).zip(&mut seen) {
            let ((sides, visible), worth) = (portal.sides(p), worth(portal));
            let scale = table.unit / self.unit;
            let (mut seen, bits) = ([0.0; MOST_LANES], (visible & worth.gt(R::lit(0.0))).bits());
            for lane in (0..R::LANES).filter(|lane| bits >> lane & 1 == 1) {
                let [columns, rows] = spans(table, &sides, lane);
                let weight = table.columns(columns, rows).total * columns.part_of_one() * rows.part_of_one();
                seen[lane] = (weight * scale * worth.lane_f64(lane)).max(LEAST_WEIGHT);
                cells[lane] += columns.cells();
            }
            let weight = R::from_fn(|lane| R::Scalar::lit(seen[lane]));
            for (lane, sum) in weights[..R::LANES].iter_mut().enumerate() {
                *sum += weight.lane_f64(lane);
            }
            *own = SeenPortal { sides, weight };
        }
        PortalsByRadiance { portals: self.portals, tables: self.tables, seen, cells, weights }
    }
}

/// The least cosine that a corner of a portal counts with; so much below the horizon, rounding does not matter.
const GRAZING: f64 = 1e-3;
/// Weights are at least this: less has no reciprocal in single precision.
const LEAST_WEIGHT: f64 = 1e-37;

/// Whether a direction of these components passes a portal that is seen, to so many radians.
#[inline(always)]
fn passes<R: Real>([across, up]: [&Side<R>; 2], [x, y, z]: [R; 3], slack: R) -> R::Mask {
    across.has(x, z, slack) & up.has(y, z, slack) & z.gt(R::lit(0.0))
}

/// A portal as a point sees it.
#[derive(Clone, Copy, Debug, Default)]
struct SeenPortal<R> {
    sides: [Side<R>; 2],
    /// Weight of what is seen; 0 where the portal is not seen.
    weight: R,
}

/// A [`PortalEnvironment`] prepared for a point. Surface coordinates: those of [`Octahedral`], for the whole sphere.
///
/// A sample has the pdf that [`pdf`](LightSampler::pdf) tells for its direction; next to the edge of a texel that may be the neighbour's.
#[derive(Clone, Copy, Debug)]
pub struct PortalsByRadiance<'a, R: Real> {
    portals: &'a [Portal],
    tables: &'a [PortalTable<'a>],
    seen: [SeenPortal<R>; MOST_PORTALS],
    /// Number of columns that are seen in a lane, and their weight, over all portals.
    cells: [u32; MOST_LANES],
    weights: [f64; MOST_LANES],
}

/// A place in a portal: its number, column and row, and the position of each.
#[derive(Clone, Copy, Debug, Default)]
struct Drawn {
    portal: usize,
    found: [FoundCell; 2],
    place: [f64; 2],
}

impl<'a, R: Real> PortalsByRadiance<'a, R> {
    #[inline(always)]
    fn draw(&self, u: Vec2<R>) -> [Drawn; MOST_LANES] {
        let mut drawn = [Drawn::default(); MOST_LANES];
        let mut spans = [None; MOST_LANES];
        let mut columns = [const { None }; MOST_LANES];
        for lane in 0..R::LANES {
            if let Some((portal, rows, search)) = self.search(lane, u.x.lane_f64(lane)) {
                (drawn[lane].portal, spans[lane], columns[lane]) = (portal, Some(rows), Some(search));
            }
        }
        Search::all(&mut columns);
        let mut rows = [const { None }; MOST_LANES];
        for lane in 0..R::LANES {
            if let (Some(column), Some(span)) = (&columns[lane], spans[lane]) {
                let found = column.found();
                let sums = self.tables[drawn[lane].portal].rows(found.cell, span);
                rows[lane] = Some(SpanPlace::only(&span).search(sums, 1.0, u.y.lane_f64(lane)));
                (drawn[lane].found[0], drawn[lane].place[0]) = (found, found.place(u.x.lane_f64(lane)));
            }
        }
        Search::all(&mut rows);
        for lane in 0..R::LANES {
            if let Some(row) = &rows[lane] {
                let found = row.found();
                (drawn[lane].found[1], drawn[lane].place[1]) = (found, found.place(u.y.lane_f64(lane)));
            }
        }
        drawn
    }
    /// The portal to which `u` goes in a lane, its rows, and a search among its columns.
    #[inline(always)]
    fn search(&self, lane: usize, u: f64) -> Option<(usize, Span, Search<Columns<'a>>)> {
        let mut place = self.first(lane);
        for (portal, table) in self.tables.iter().enumerate() {
            let weight = self.seen[portal].weight.lane_f64(lane);
            if weight > 0.0 {
                let [columns, rows] = self.spans(lane, portal);
                let next = place.after(&columns, weight);
                if u * STEPS < next.begin() {
                    return Some((portal, rows, place.search(table.columns(columns, rows), weight, u)));
                }
                place = next;
            }
        }
        None
    }
    /// Column and row of a position in a portal that is seen in a lane.
    #[inline(always)]
    fn find(&self, lane: usize, portal: usize, at: [f64; 2]) -> [FoundCell; 2] {
        let mut place = self.first(lane);
        for k in 0..portal {
            let weight = self.seen[k].weight.lane_f64(lane);
            if weight > 0.0 {
                place = place.after(&self.spans(lane, k)[0], weight);
            }
        }
        let (table, [columns, rows]) = (&self.tables[portal], self.spans(lane, portal));
        let weight = self.seen[portal].weight.lane_f64(lane);
        let column = place.find(&table.columns(columns, rows), weight, columns.cell(at[0]));
        let row = SpanPlace::only(&rows).find(&table.rows(column.cell, rows), 1.0, rows.cell(at[1]));
        [column, row]
    }
    #[inline(always)]
    fn first(&self, lane: usize) -> SpanPlace {
        SpanPlace { cells: [self.cells[lane], 0], weights: [self.weights[lane], 0.0] }
    }
    #[inline(always)]
    fn spans(&self, lane: usize, portal: usize) -> [Span; 2] {
        spans(&self.tables[portal], &self.seen[portal].sides, lane)
    }
    /// The density of a direction. Where it is within the cell that has been drawn in a lane, that of the cell need not be found again.
    #[inline(always)]
    fn density(&self, w: Vec3<R>, drawn: Option<&[Drawn; MOST_LANES]>) -> R {
        let mut sum = R::lit(0.0);
        for k in 0..self.portals.len() {
            let ([x, y], area, passes) = self.positions(k, w);
            let bits = passes.bits();
            if bits == 0 {
                continue;
            }
            let density = R::from_fn(|lane| {
                if bits >> lane & 1 == 0 {
                    return R::Scalar::lit(0.0);
                }
                let at = [x, y].map(|x| x.lane_f64(lane));
                let known = drawn.map(|drawn| &drawn[lane]);
                let known =
                    known.filter(|drawn| drawn.portal == k && drawn.found[0].has(at[0]) && drawn.found[1].has(at[1]));
                let [column, row] = known.map_or_else(|| self.find(lane, k, at), |drawn| drawn.found);
                R::Scalar::lit(column.density() * row.density())
            });
            sum += (density * area).lesser(R::lit(GREATEST)).keep(passes);
        }
        sum.lesser(R::lit(GREATEST))
    }
    /// Where a direction passes a portal, the density there per unit of its area as seen, and whether it passes at all.
    #[inline(always)]
    fn positions(&self, k: usize, w: Vec3<R>) -> ([R; 2], R, R::Mask) {
        let (map, SeenPortal { sides: [across, up], weight }) = (&self.portals[k].map, &self.seen[k]);
        let [x, y, z] = map.local(w);
        let passes = weight.gt(R::lit(0.0)) & passes([across, up], [x, y, z], map.slack());
        // the area of the portal, in radians², per steradian
        let (a, b) = (x.mul_add(x, z * z), y.mul_add(y, z * z));
        let area = (z / a) / b / (across.size * up.size * R::lit(map.sin));
        ([across.position(x, z), up.position(y, z)], area, passes)
    }
}

impl<R: Real> LightSampler<R> for PortalsByRadiance<'_, R> {
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> LightSample<R> {
        let u = u.map(unit_interval);
        let drawn = self.draw(u);
        let mut direction = Vec3::lit([0.0; 3]);
        for (k, (portal, SeenPortal { sides, .. })) in self.portals.iter().zip(&self.seen).enumerate() {
            let bits = drawn[..R::LANES].iter().enumerate().filter(|(_, drawn)| drawn.portal == k);
            let here = R::Mask::from_bits(bits.fold(0, |bits, (lane, _)| bits | 1 << lane));
            if here.any() {
                let at = |i: usize| sides[i].at(R::from_fn(|lane| R::Scalar::lit(drawn[lane].place[i])));
                let (x, y) = (at(0), at(1));
                direction = Vec3::blend(here, portal.map.world([x[0] * y[1], y[0] * x[1], x[1] * y[1]]), direction);
            }
        }
        let w = direction.unit_and_length().0;
        met(w, self.density(w, Some(&drawn)), Octahedral.invert(w))
    }
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        self.density(w, None)
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let mut u = Vec2::lit([0.0; 2]);
        // of several portals, the first one
        for k in (0..self.portals.len()).rev() {
            let (at, _, passes) = self.positions(k, w);
            let mut pairs = [[0.0; 2]; MOST_LANES];
            for lane in (0..R::LANES).filter(|&lane| passes.lane(lane)) {
                let at = at.map(|x| x.lane_f64(lane));
                let [column, row] = self.find(lane, k, at);
                pairs[lane] = [column.invert(at[0]), row.invert(at[1])];
            }
            let pair = [0, 1].map(|i| R::from_fn(|lane| R::Scalar::lit(pairs[lane][i])));
            u = Vec2::blend(passes, Vec2::new(pair[0], pair[1]), u);
        }
        u.map(unit_interval)
    }
    #[inline(always)]
    fn hit(&self, w: Vec3<R>) -> LightSample<R> {
        met(w, self.pdf(w), Octahedral.invert(w))
    }
}
