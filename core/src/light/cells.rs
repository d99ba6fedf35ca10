//! Cells of a picture, and the walk to one of them through a hierarchy of boxes.

use crate::discrete::locate;
use crate::real::{Mask, Real, unit_interval};
use crate::vector::Vec2;

/// Steps of `u` in the unit interval, and the greatest number of columns and of rows.
pub(super) const STEPS: f64 = 16_777_216.0;

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

/// A box of texels, from `low` to `high`, as parts of the picture's sides.
#[derive(Clone, Copy)]
pub(super) struct Box2<R> {
    pub(super) low: Vec2<R>,
    pub(super) high: Vec2<R>,
}

/// How much of the measure, per unit of the picture's area, the two halves of a box have.
pub(super) trait Halves<R: Real> {
    /// Two numbers ≥ 0 in proportion to it, neither of which is infinite or NaN. A half in which a sample can have a pdf has more than 0.
    ///
    /// Also, whether the halves of these halves can differ by more than 1 %: where not, nothing more is asked. `axis` is 0 where the halves
    /// are beside each other along u, 1 along v.
    fn densities(&self, axis: usize, low: &Box2<R>, high: &Box2<R>) -> ([R; 2], R::Mask);
}

/// A texel that was drawn.
#[derive(Clone, Copy)]
pub(super) struct Drawn<R: Real> {
    /// Column and row.
    pub(super) texel: Vec2<R>,
    /// The first step of the texel in u₀ and u₁.
    start: Vec2<R>,
    /// Number of its steps.
    steps: Vec2<R>,
}

impl<R: Real> Drawn<R> {
    /// Probability of the texel.
    #[inline(always)]
    pub(super) fn pmf(&self) -> R {
        let step = R::lit(1.0 / STEPS);
        (self.steps.x * step) * (self.steps.y * step)
    }
    /// The `u` for a position in the texel.
    #[inline(always)]
    pub(super) fn invert(&self, within: Vec2<R>) -> Vec2<R> {
        let step = R::lit(1.0 / STEPS);
        let at = |start: R, steps: R, within: R| {
            // the number below the next texel's first step
            let end = start + steps;
            within.mul_add(steps, start).lesser(end - end * step) * step
        };
        let Self { start, steps, .. } = self;
        Vec2::new(at(start.x, steps.x, within.x), at(start.y, steps.y, within.y))
    }
}

/// The cells of a picture in memory.
pub(super) trait Cells<R: Real>: Copy {
    /// Columns and rows.
    fn counts(&self) -> Vec2<R>;
    /// The part of the surface coordinates that its light covers.
    fn region(&self) -> Region;
    /// Whether the radiance is bilinear in each cell.
    fn is_interpolated(&self) -> bool;
    /// Radiance at the corners of a cell, in which it is bilinear; none where it is constant.
    fn corners(&self, cell: Vec2<R>) -> Option<[R; 4]>;
    /// Goes down to a cell: at each box, `lower` tells whether to its lower half.
    fn walk(&self, halves: &impl Halves<R>, lower: &impl Lower<R>) -> Drawn<R>;

    /// One over the numbers of columns and rows that are whole, which [`edge`](Self::edge) needs.
    #[inline(always)]
    fn pitch(&self) -> Vec2<R> {
        let (counts, one) = (self.counts(), R::lit(1.0));
        let pitch = |count: R| {
            if self.is_interpolated() {
                // with one cell more than texels, the first and the last one are halves
                one / (count - one)
            } else {
                one / count
            }
        };
        Vec2::new(pitch(counts.x), pitch(counts.y))
    }
    /// Where columns, or rows, begin in the picture, in [0, 1].
    #[inline(always)]
    fn edge(&self, at: R, pitch: R) -> R {
        if self.is_interpolated() { ((at - R::lit(0.5)) * pitch).clamped(R::lit(0.0), R::lit(1.0)) } else { at * pitch }
    }
    /// A cell as a box.
    #[inline(always)]
    fn cell(&self, at: Vec2<R>) -> Box2<R> {
        let (pitch, one) = (self.pitch(), R::lit(1.0));
        let edges = |x: R, y: R| Vec2::new(self.edge(x, pitch.x), self.edge(y, pitch.y));
        Box2 { low: edges(at.x, at.y), high: edges(at.x + one, at.y + one) }
    }
    /// The cell at surface coordinates, and the position in it.
    #[inline(always)]
    fn locate(&self, uv: Vec2<R>) -> (Vec2<R>, Vec2<R>) {
        let (counts, pitch) = (self.counts(), self.pitch());
        let one = |x: R, n: R, pitch: R| {
            if !self.is_interpolated() {
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
    /// The position in the texel that `u` draws, and the texel.
    #[inline(always)]
    fn draw(&self, u: Vec2<R>, halves: &impl Halves<R>) -> (Drawn<R>, Vec2<R>) {
        let (zero, steps) = (R::lit(0.0), R::lit(STEPS));
        let least = |x: R| x.clamped(zero, R::ONE_MINUS_EPSILON) * steps;
        let at = Vec2::new(least(u.x), least(u.y));
        let drawn = self.walk(halves, &ByStep([at.x, at.y]));
        // the differences are exact
        let within = |at: R, start: R, steps: R| unit_interval((at - start) / steps);
        let Drawn { start, steps, .. } = drawn;
        (drawn, Vec2::new(within(at.x, start.x, steps.x), within(at.y, start.y, steps.y)))
    }
    /// A texel, given its column and row, and how it is drawn.
    #[inline(always)]
    fn find(&self, texel: Vec2<R>, halves: &impl Halves<R>) -> Drawn<R> {
        self.walk(halves, &ByTexel([texel.x, texel.y]))
    }
}

/// The axis along which a box is halved: 0 along columns, 1 along rows.
pub(super) trait Axis<R: Real>: Copy {
    /// What belongs to it, of what belongs to both axes.
    fn of(self, pair: &[R; 2]) -> R;
    /// What belongs to the other one.
    fn across(self, pair: &[R; 2]) -> R;
    /// The sides of a box by columns and by rows, given those along the axis and across it.
    fn sides(self, along: [R; 2], across: [R; 2]) -> [[R; 2]; 2];
    /// Replaces what belongs to it.
    fn set(self, pair: &mut [R; 2], value: R);
    /// See [`Halves::densities`].
    fn densities(self, halves: &impl Halves<R>, low: &Box2<R>, high: &Box2<R>) -> ([R; 2], R::Mask);
}

/// The same in all lanes.
impl<R: Real> Axis<R> for usize {
    #[inline(always)]
    fn of(self, pair: &[R; 2]) -> R {
        if self == 0 { pair[0] } else { pair[1] }
    }
    #[inline(always)]
    fn across(self, pair: &[R; 2]) -> R {
        if self == 0 { pair[1] } else { pair[0] }
    }
    #[inline(always)]
    fn sides(self, along: [R; 2], across: [R; 2]) -> [[R; 2]; 2] {
        if self == 0 { [along, across] } else { [across, along] }
    }
    #[inline(always)]
    fn set(self, pair: &mut [R; 2], value: R) {
        pair[usize::from(self != 0)] = value;
    }
    #[inline(always)]
    fn densities(self, halves: &impl Halves<R>, low: &Box2<R>, high: &Box2<R>) -> ([R; 2], R::Mask) {
        halves.densities(self, low, high)
    }
}

/// To which half of a box a walk goes.
pub(super) trait Lower<R: Real> {
    /// Whether to the lower one, given the first step and the first column or row of the upper one.
    fn lower(&self, axis: impl Axis<R>, step: R, middle: R) -> R::Mask;
}
/// To the step of `u`.
struct ByStep<R>([R; 2]);
impl<R: Real> Lower<R> for ByStep<R> {
    #[inline(always)]
    fn lower(&self, axis: impl Axis<R>, step: R, _: R) -> R::Mask {
        axis.of(&self.0).lt(step)
    }
}
/// To the column and row.
struct ByTexel<R>([R; 2]);
impl<R: Real> Lower<R> for ByTexel<R> {
    #[inline(always)]
    fn lower(&self, axis: impl Axis<R>, _: R, middle: R) -> R::Mask {
        axis.of(&self.0).lt(middle)
    }
}

/// A box that is halved.
pub(super) struct Level<R, A> {
    pub(super) axis: A,
    /// Columns or rows of a half along the axis.
    pub(super) half: R,
    /// Columns or rows across it.
    pub(super) size: R,
    /// How much of the radiance is in the lower half.
    pub(super) share: R,
}

/// A walk to a cell.
pub(super) struct Walk<'a, R: Real, C> {
    cells: &'a C,
    counts: [R; 2],
    pitch: Vec2<R>,
    /// The first step of the box in u₀ and u₁, and the number of its steps.
    pub(super) start: [R; 2],
    pub(super) steps: [R; 2],
    /// Its first column and row.
    pub(super) texel: [R; 2],
    /// Whether parts of it can differ in their measure.
    pub(super) differ: R::Mask,
}

impl<'a, R: Real, C: Cells<R>> Walk<'a, R, C> {
    #[inline(always)]
    pub(super) fn of(cells: &'a C) -> Self {
        let (zero, differ) = ([R::lit(0.0); 2], R::Mask::splat(true));
        let (Vec2 { x, y }, pitch) = (cells.counts(), cells.pitch());
        Self { cells, counts: [x, y], pitch, start: zero, steps: [R::lit(STEPS); 2], texel: zero, differ }
    }
    /// Goes to a half of the box.
    #[inline(always)]
    pub(super) fn descend<A: Axis<R>>(&mut self, level: &Level<R, A>, halves: &impl Halves<R>, lower: &impl Lower<R>) {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let (cells, pitch, &Level { axis, half, size, share }) = (self.cells, self.pitch, level);
        let share = share.clamped(zero, one);
        let count = axis.of(&self.counts);
        let first = axis.of(&self.texel);
        let middle = first + half;
        let end = (middle + half).lesser(count);
        let [low, high] = {
            let from = axis.across(&self.texel);
            let to = (from + size).lesser(axis.across(&self.counts));
            let place = |x: R, y: R| Vec2::new(cells.edge(x, pitch.x), cells.edge(y, pitch.y));
            let boxed = |start: R, end: R| {
                let [[x0, x1], [y0, y1]] = axis.sides([start, end], [from, to]);
                Box2 { low: place(x0, y0), high: place(x1, y1) }
            };
            [boxed(first, middle), boxed(middle, end)]
        };
        let (mut a, mut b, mut ratio) = (share, one - share, share);
        if self.differ.any() {
            let (densities, still) = axis.densities(halves, &low, &high);
            let (c, d) = (a * densities[0], b * densities[1]);
            // where the measure leaves nothing, the radiance decides
            let some = self.differ & (c + d).gt(zero);
            (a, b, ratio) = (R::blend(some, c, a), R::blend(some, d, b), R::blend(some, c / (c + d), ratio));
            self.differ = self.differ & still;
        }
        let (all, start) = (axis.of(&self.steps), axis.of(&self.start));
        let cut = (all * ratio).round_ties_even().clamped(half, all - (end - middle));
        // a box that is never drawn has no steps
        let cut = cut.clamped(zero, all);
        let cut = R::blend(b.gt(zero), cut, all).keep(a.gt(zero));
        // no contents of a buffer lead past the last column or row
        let cut = R::blend(middle.lt(count), cut, all);
        let below = lower.lower(axis, start + cut, middle);
        axis.set(&mut self.steps, R::blend(below, cut, all - cut));
        axis.set(&mut self.start, R::blend(below, start, start + cut));
        axis.set(&mut self.texel, R::blend(below, first, middle));
    }
    /// The cell to which it has gone.
    #[inline(always)]
    pub(super) fn drawn(&self) -> Drawn<R> {
        let pair = |[x, y]: [R; 2]| Vec2::new(x, y);
        Drawn { texel: pair(self.texel), start: pair(self.start), steps: pair(self.steps) }
    }
}
