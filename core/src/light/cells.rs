//! Cells of a picture, and the walk to one of them through a hierarchy of boxes.

use crate::discrete::locate;
use crate::real::{Mask, Real, Uint, unit_interval};
use crate::vector::Vec2;

/// Steps of `u` in the unit interval, and the greatest number of columns and of rows.
pub(super) const STEPS: f64 = 16_777_216.0;

/// All steps over this, divided by the least number above 0, are finite.
const UNIT: f64 = (1_u128 << 64) as f64;

/// The part of the unit square of surface coordinates that a light covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Region {
    /// All of it: [`Rectangle`](super::Rectangle), [`Parallelogram`](super::Parallelogram).
    Square,
    /// The half where u + v < 1: [`Triangle`](super::Triangle).
    Triangle,
    /// The inscribed disk: [`Disk`](super::Disk).
    Disk,
}

impl Region {
    /// Part of the texel in column `x` and row `y` of w × h that the light covers, in [0, 1], to 1/64; above 0 wherever it covers any.
    #[must_use]
    pub fn part(self, [x, y]: [usize; 2], [w, h]: [usize; 2]) -> f64 {
        let at = |i: usize, offset: f64, n: usize| (i as f64 + offset) / n as f64;
        // below 0 inside, and 0 on the rim
        let beyond = |s: f64, t: f64| match self {
            Self::Square => -1.0,
            Self::Triangle => s + t - 1.0,
            Self::Disk => (s - 0.5) * (s - 0.5) + (t - 0.5) * (t - 0.5) - 0.25,
        };
        // the corner or the point that is nearest to the middle of the region
        let nearest = |i: usize, n: usize| match self {
            Self::Disk => 0.5_f64.max(at(i, 0.0, n)).min(at(i, 1.0, n)),
            _ => at(i, 0.0, n),
        };
        if beyond(nearest(x, w), nearest(y, h)) >= 0.0 {
            return 0.0;
        }
        let offset = |k: usize| (k as f64 + 0.5) / 8.0;
        let points = (0..64).map(|k| {
            let beyond = beyond(at(x, offset(k % 8), w), at(y, offset(k / 8), h));
            if beyond < 0.0 {
                1.0
            } else if beyond == 0.0 {
                0.5
            } else {
                0.0
            }
        });
        points.sum::<f64>().max(1.0) / 64.0
    }
    /// Whether a point of the unit square is on the light.
    #[inline(always)]
    pub(super) fn contains<R: Real>(self, uv: Vec2<R>) -> R::Mask {
        let half = R::lit(0.5);
        match self {
            Self::Square => R::Mask::splat(true),
            Self::Triangle => (uv.x + uv.y).lt(R::lit(1.0)),
            Self::Disk => {
                let q = Vec2::new(uv.x - half, uv.y - half);
                q.dot(q).lt(R::lit(0.25))
            }
        }
    }
}

/// A box of cells, from `low` to `high`, as parts of the picture's sides.
#[derive(Clone, Copy)]
pub(super) struct Box2<R> {
    pub(super) low: Vec2<R>,
    pub(super) high: Vec2<R>,
}

/// A box that is cut into four, along one side: those past the last column or row are empty.
#[derive(Clone, Copy)]
pub(super) struct Slabs<R> {
    /// 0 where they are beside each other along u, 1 along v.
    pub(super) axis: usize,
    /// The edges between them, as parts of the picture's side.
    pub(super) along: [R; 5],
    /// From where to where they extend along the other axis.
    pub(super) across: [R; 2],
}

impl<R: Real> Slabs<R> {
    #[inline(always)]
    pub(super) fn slab(&self, k: usize) -> Box2<R> {
        let (along, across) = ([self.along[k], self.along[k + 1]], self.across);
        let [x, y] = if self.axis == 0 { [along, across] } else { [across, along] };
        Box2 { low: Vec2::new(x[0], y[0]), high: Vec2::new(x[1], y[1]) }
    }
    #[inline(always)]
    pub(super) fn each(&self) -> [Box2<R>; 4] {
        core::array::from_fn(|k| self.slab(k))
    }
}

/// How much of the measure, per unit of the picture's area, the slabs of a box have.
pub(super) trait Measure<R: Real> {
    /// Numbers ≥ 0 in proportion to it, for slabs that are not empty neither infinite nor NaN. A slab in which a sample can have a pdf has
    /// more than 0.
    ///
    /// Also, whether the parts of these slabs can differ by more than 1 %: where not, nothing more is asked.
    fn densities(&self, of: &Slabs<R>) -> ([R; 4], R::Mask);
}

/// A cell that was drawn.
#[derive(Clone, Copy)]
pub(super) struct Drawn<R: Real> {
    /// Column and row.
    pub(super) cell: Vec2<R>,
    /// The first step of the cell in u₀ and u₁.
    pub(super) start: Vec2<R>,
    /// Number of its steps.
    pub(super) steps: Vec2<R>,
}

impl<R: Real> Drawn<R> {
    /// Probability of the cell.
    #[inline(always)]
    pub(super) fn pmf(&self) -> R {
        let step = R::lit(1.0 / STEPS);
        (self.steps.x * step) * (self.steps.y * step)
    }
    /// The `u` for a position in the cell.
    #[inline(always)]
    pub(super) fn invert(&self, within: Vec2<R>) -> Vec2<R> {
        let step = R::lit(1.0 / STEPS);
        let at = |start: R, steps: R, within: R| {
            // the number below the next cell's first step
            let end = start + steps;
            within.mul_add(steps, start).lesser(end - end * step) * step
        };
        let Self { start, steps, .. } = self;
        Vec2::new(at(start.x, steps.x, within.x), at(start.y, steps.y, within.y))
    }
}

/// Where the cells of a picture are.
#[derive(Clone, Copy)]
pub(super) struct Grid {
    /// Columns and rows.
    pub(super) size: [u32; 2],
    /// Whether the radiance is bilinear in each cell.
    pub(super) is_interpolated: bool,
}

impl Grid {
    /// Columns and rows.
    #[inline(always)]
    fn counts<R: Real>(self) -> Vec2<R> {
        let [w, h] = self.size.map(|n| R::lit(f64::from(n)));
        Vec2::new(w, h)
    }
    /// One over the numbers of columns and rows that are whole, which [`edge`](Self::edge) needs.
    #[inline(always)]
    fn pitch<R: Real>(self) -> Vec2<R> {
        let (counts, one) = (self.counts(), R::lit(1.0));
        // with one cell more than texels, the first and the last one are halves
        let pitch = |count: R| if self.is_interpolated { one / (count - one) } else { one / count };
        Vec2::new(pitch(counts.x), pitch(counts.y))
    }
    /// Where columns, or rows, begin in the picture, in [0, 1].
    #[inline(always)]
    fn edge<R: Real>(self, at: R, pitch: R) -> R {
        if self.is_interpolated { ((at - R::lit(0.5)) * pitch).clamped(R::lit(0.0), R::lit(1.0)) } else { at * pitch }
    }
    /// A cell as a box.
    #[inline(always)]
    pub(super) fn cell<R: Real>(self, at: Vec2<R>) -> Box2<R> {
        let (pitch, one) = (self.pitch(), R::lit(1.0));
        let edges = |x: R, y: R| Vec2::new(self.edge(x, pitch.x), self.edge(y, pitch.y));
        Box2 { low: edges(at.x, at.y), high: edges(at.x + one, at.y + one) }
    }
    /// The cell at surface coordinates, and the position in it.
    #[inline(always)]
    pub(super) fn locate<R: Real>(self, uv: Vec2<R>) -> (Vec2<R>, Vec2<R>) {
        let (counts, pitch) = (self.counts(), self.pitch());
        let one = |x: R, n: R, pitch: R| {
            if !self.is_interpolated {
                let (i, within) = locate(unit_interval(x), n);
                return (R::from_uint(i), within);
            }
            let (half, one) = (R::lit(0.5), R::lit(1.0));
            let place = unit_interval(x).mul_add(n - one, half);
            let i = R::from_uint(place.to_uint()).lesser(n - one);
            let (start, end) = (self.edge(i, pitch), self.edge(i + one, pitch));
            (i, unit_interval((x - start) / (end - start)))
        };
        let ((x, s), (y, t)) = (one(uv.x, counts.x, pitch.x), one(uv.y, counts.y, pitch.y));
        (Vec2::new(x, y), Vec2::new(s, t))
    }
}

/// A level of a hierarchy of boxes, each of which is cut into four rows of four parts, or two rows of two.
pub(super) struct Level<R> {
    /// Columns of a box, which are as many as its rows.
    pub(super) length: R,
    /// Columns of a part.
    pub(super) side: R,
    /// Whether a box may have fewer parts than four beside each other, and above each other.
    pub(super) cut: [bool; 2],
}

/// A walk to a cell.
#[derive(Clone, Copy)]
pub(super) struct Walk<R: Real> {
    /// Columns of the box that the walk has reached.
    pub(super) columns: Span<R>,
    /// Its rows.
    pub(super) rows: Span<R>,
    /// Whether parts of it can differ in their measure.
    pub(super) differ: R::Mask,
}

impl<R: Real> Walk<R> {
    /// At the whole picture.
    #[inline(always)]
    pub(super) fn new() -> Self {
        let zero = R::lit(0.0);
        let whole = Span { start: zero, steps: R::lit(STEPS), cell: zero };
        Self { columns: whole, rows: whole, differ: R::Mask::splat(true) }
    }
    /// Goes to a part of the box: first to a row of parts, then to one of these. `shares` returns how much of the weight is before the
    /// edges between the rows, or, given the place of a row's entries among those of the box, between its parts.
    #[inline(always)]
    pub(super) fn descend(
        &mut self,
        grid: Grid,
        &Level { length, side, cut: [cut_x, cut_y] }: &Level<R>,
        shares: impl Fn(Option<R::Uint>) -> [R; 3],
        measure: &impl Measure<R>,
        before: impl Fn(usize, R, R) -> R::Mask,
    ) {
        let Self { columns, rows, differ } = self;
        let pair = |v: Vec2<R>| [v.x, v.y];
        let (counts, pitch) = (pair(grid.counts()), pair(grid.pitch()));
        let end_x = (columns.cell + length).lesser(counts[0]);
        let end_y = (rows.cell + length).lesser(counts[1]);
        let edge = |at: R, axis: usize| grid.edge(at, pitch[axis]);
        let slabs = |axis: usize, along: &[R; 5], across: [R; 2]| Slabs {
            axis,
            along: along.map(|at| edge(at, axis)),
            across: across.map(|at| edge(at, 1 - axis)),
        };

        let at = rows.edges(side, cut_y.then_some(end_y));
        let below = shares(None);
        let cuts = if differ.any() {
            let (densities, _) = measure.densities(&slabs(1, &at, [columns.cell, end_x]));
            rows.cuts(below, side, cut_y.then_some(&at), Some((densities, *differ)))
        } else {
            rows.cuts(below, side, cut_y.then_some(&at), None)
        };
        let [i, j, k] = [0, 1, 2].map(|k| before(1, rows.start + cuts[k], at[k + 1]));
        rows.go([i, j, k], cuts, &at);
        let row = [3, 6, 9, 12].map(R::Uint::splat);
        let row = R::blend_uint(i, row[0], R::blend_uint(j, row[1], R::blend_uint(k, row[2], row[3])));

        let at = columns.edges(side, cut_x.then_some(end_x));
        let below = shares(Some(row));
        let cuts = if differ.any() {
            let end = (rows.cell + side).lesser(end_y);
            let (densities, still) = measure.densities(&slabs(0, &at, [rows.cell, end]));
            let cuts = columns.cuts(below, side, cut_x.then_some(&at), Some((densities, *differ)));
            *differ = *differ & still;
            cuts
        } else {
            columns.cuts(below, side, cut_x.then_some(&at), None)
        };
        let [i, j, k] = [0, 1, 2].map(|k| before(0, columns.start + cuts[k], at[k + 1]));
        columns.go([i, j, k], cuts, &at);
    }
    /// The cell to which it has gone.
    #[inline(always)]
    pub(super) fn drawn(&self) -> Drawn<R> {
        let pair = |of: fn(&Span<R>) -> R| Vec2::new(of(&self.columns), of(&self.rows));
        Drawn { cell: pair(|span| span.cell), start: pair(|span| span.start), steps: pair(|span| span.steps) }
    }
}

/// Columns or rows, and their steps.
#[derive(Clone, Copy)]
pub(super) struct Span<R> {
    /// The first step in u₀ or u₁.
    pub(super) start: R,
    /// Number of steps.
    pub(super) steps: R,
    /// The first column or row.
    pub(super) cell: R,
}

impl<R: Real> Span<R> {
    /// Edges between four parts of so many columns or rows each, and their ends, none of which is after `end`.
    #[inline(always)]
    fn edges(&self, side: R, end: Option<R>) -> [R; 5] {
        let edge = |k: f64| {
            let edge = self.cell + side * R::lit(k);
            end.map_or(edge, |end| edge.lesser(end))
        };
        [self.cell, edge(1.0), edge(2.0), edge(3.0), edge(4.0)]
    }
    /// The steps before the second, the third and the fourth part, given the shares of what is before them, and, in some lanes, how much of
    /// the measure the parts have per area. The parts have so many columns or rows each, or lie between edges.
    ///
    /// A part with weight has one step for each of its columns or rows, and the rest is divided in proportion to the weights.
    #[inline(always)]
    fn cuts(&self, shares: [R; 3], side: R, edges: Option<&[R; 5]>, measured: Option<([R; 4], R::Mask)>) -> [R; 3] {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let all = self.steps;
        // no contents of a buffer lead past the last column or row, and they are in order
        let [mut a, mut b, mut c] = shares;
        let mut widths = [side; 4];
        if let Some(at) = edges {
            [a, b, c] = core::array::from_fn(|k| R::blend(at[k + 1].lt(at[4]), shares[k], one));
            widths = core::array::from_fn(|k| at[k + 1] - at[k]);
        }
        a = a.greater(zero);
        b = b.greater(a);
        c = c.greater(b);
        // a box that is never drawn has no steps
        let drawn = all.gt(zero);
        let mut lit = [a.gt(zero), b.gt(a), c.gt(b), one.gt(c)].map(|lit| lit & drawn);
        let (mut before, mut whole) = ([a, b, c], one);
        if let Some((densities, differ)) = measured {
            let weights = [a, b - a, c - b, one - c];
            let seen: [R; 4] = core::array::from_fn(|k| (weights[k] * densities[k]).keep(lit[k]));
            let first = seen[0] + seen[1];
            let second = first + seen[2];
            let sum = second + seen[3];
            // where the measure leaves nothing, the weight decides
            let some = differ & sum.gt(zero);
            lit = core::array::from_fn(|k| lit[k] & (!some | seen[k].gt(zero)));
            before = [R::blend(some, seen[0], a), R::blend(some, first, b), R::blend(some, second, c)];
            whole = R::blend(some, sum, one);
        }
        let widths: [R; 4] = core::array::from_fn(|k| widths[k].keep(lit[k]));
        let kept = [widths[0], widths[0] + widths[1], (widths[0] + widths[1]) + widths[2]];
        let rest = all - (kept[2] + widths[3]);
        // in a unit in which no quotient overflows: slabs without weight stay dark
        let (scale, unit) = if measured.is_some() { ((rest * R::lit(1.0 / UNIT)) / whole, UNIT) } else { (rest, 1.0) };
        core::array::from_fn(|k| {
            let part = (before[k] * scale * R::lit(unit)).round_ties_even().lesser(rest);
            // what reaches the whole leaves nothing
            kept[k] + R::blend(before[k].lt(whole), part, rest)
        })
    }
    /// Goes to the part that is before the first of the edges for which that is known, or to the last part.
    #[inline(always)]
    fn go(&mut self, [i, j, k]: [R::Mask; 3], cuts: [R; 3], at: &[R; 5]) {
        let choose = |a: R, b: R, c: R, d: R| R::blend(i, a, R::blend(j, b, R::blend(k, c, d)));
        let from = choose(R::lit(0.0), cuts[0], cuts[1], cuts[2]);
        self.steps = choose(cuts[0], cuts[1], cuts[2], self.steps) - from;
        self.start += from;
        self.cell = choose(at[0], at[1], at[2], at[3]);
    }
}
