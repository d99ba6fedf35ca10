//! Pictures on lights from words in memory.

use super::cells::{Cells, Drawn, Level, Measure, Region, Span, Walk};
use super::hierarchy::ENTRIES;
use super::pictured::PicturedLight;
use crate::memory::Memory;
use crate::real::{Real, State, Uint};
use crate::vector::Vec2;

/// A [`Picture`](super::Picture) as words in [memory](crate::memory): what samplers read where number types write sources.
///
/// Of single precision, samples and pdfs have the bits of the picture. On a processor the picture itself is the faster one.
///
/// - Domain: the picture's; the memory has the words of the buffer that [`build`](super::Picture::build) has filled.
/// - Degenerate: any other contents give samples with any pdf; a walk cuts at most 12 boxes.
///
/// ```
/// use etendue::light::{Picture, PictureWords, Region};
/// use etendue::{LightSampler, Rectangle, Vec2};
/// let mut buffer = [0.0; Picture::buffer(2, 2)];
/// let picture = Picture::build(&[1.0, 2.0, 0.0, 5.0], 2, Region::Square, &mut buffer).unwrap();
/// let screen = Rectangle::new([-1.0, 2.0, -1.0].into(), [2.0, 0.0, 0.0].into(), [0.0, 0.0, 2.0_f32].into());
/// let here = picture.on(screen).by_solid_angle([0.0; 3].into()).sample(Vec2::new(0.3, 0.6));
/// let words = PictureWords { memory: &buffer[..], shares: 0_u32, values: None, size: [2, 2], region: Region::Square };
/// let there = words.on(screen).by_solid_angle([0.0; 3].into()).sample(Vec2::new(0.3, 0.6));
/// assert_eq!((here.pdf, here.direction), (there.pdf, there.direction));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct PictureWords<M, U> {
    /// The memory.
    pub memory: M,
    /// Index of the first word of the buffer.
    pub shares: U,
    /// Index of the first of the values between which the picture is interpolated, row by row, if it is.
    pub values: Option<U>,
    /// Columns and rows of texels: between 1 and 2²⁴, or one less where they are interpolated.
    pub size: [U; 2],
    /// The part of the surface coordinates that the light covers: where the picture is interpolated, all.
    pub region: Region,
}

impl<M, U> PictureWords<M, U> {
    /// The picture on a light, which must cover the region.
    #[inline(always)]
    pub const fn on<L>(self, light: L) -> PicturedLight<Self, L>
    where
        M: Copy,
        U: Copy,
    {
        PicturedLight { picture: self, light }
    }
}

/// The most boxes from 2²⁴ columns and rows to one.
const MOST: usize = 12;

impl<R: Real, M: Memory<R>> Cells<R> for PictureWords<M, R::Uint> {
    #[inline(always)]
    fn counts(&self) -> Vec2<R> {
        let [w, h] = self.size.map(R::from_uint);
        if self.values.is_some() { Vec2::new(w + R::lit(1.0), h + R::lit(1.0)) } else { Vec2::new(w, h) }
    }
    #[inline(always)]
    fn region(&self) -> Region {
        self.region
    }
    #[inline(always)]
    fn is_interpolated(&self) -> bool {
        self.values.is_some()
    }
    #[inline(always)]
    fn corners(&self, cell: Vec2<R>) -> Option<[R; 4]> {
        let values = self.values?;
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let [width, height] = self.size;
        let value = |right: R, below: R| {
            let at = |i: R, next: R, n: R::Uint| ((i + next) - one).clamped(zero, R::from_uint(n) - one).to_uint();
            let row = at(cell.y, below, height).wrapping_mul(width);
            self.memory.number(values.wrapping_add(row).wrapping_add(at(cell.x, right, width)))
        };
        Some([value(zero, zero), value(one, zero), value(zero, one), value(one, one)])
    }
    #[inline]
    fn walk(&self, measure: &impl Measure<R>, before: impl Fn(usize, R, R) -> R::Mask) -> Drawn<R> {
        let (one, word) = (R::lit(1.0), R::Uint::splat);
        let counts: Vec2<R> = self.counts();
        // the least power of two that is not below the longer side
        let whole = {
            let longest = counts.x.greater(counts.y);
            let power = one / longest.pow2_scale();
            R::blend(power.lt(longest), power + power, power)
        };
        let step = |(numbers, [first, differ]): State<R, 7, 2>, [going]: [R::Mask; 1]| {
            let [x, start_x, steps_x, y, start_y, steps_y, length] = numbers;
            let mut walk = Walk {
                columns: Span { start: start_x, steps: steps_x, cell: x },
                rows: Span { start: start_y, steps: steps_y, cell: y },
                differ: R::has_bits(differ),
            };
            // boxes of 2 × 2 parts come where those of the hierarchy do: second, or last
            let is_odd = R::has_bits(length.to_uint() & word(0xAAAA_AAAA));
            let is_half = is_odd & (length.le(R::lit(2.0)) | R::has_bits(first));
            let side = length * R::blend(is_half, R::lit(0.5), R::lit(0.25));
            // boxes beside and above each other; quotients by powers of two are exact
            let [across, rows] = [counts.x, counts.y].map(|count| {
                let whole = (count / length).to_uint();
                let is_cut = R::from_uint(whole).lt(count / length);
                whole.wrapping_add(R::blend_uint(is_cut, word(1), word(0)))
            });
            let [column, row] = [x, y].map(|at| (at / length).to_uint());
            let here = row.wrapping_mul(across).wrapping_add(column).wrapping_add(first);
            let here = self.shares.wrapping_add(here.shl(ENTRIES.trailing_zeros()));
            let shares = |row: Option<R::Uint>| {
                let at = row.map_or(here, |row| here.wrapping_add(row));
                [0, 1, 2].map(|k| self.memory.number(at.wrapping_add(word(k))))
            };
            walk.descend(self, &Level { length, side, cut: [true; 2] }, shares, measure, &before);
            let Walk { columns, rows: lines, differ: still } = walk;
            let new = [columns.cell, columns.start, columns.steps, lines.cell, lines.start, lines.steps, side];
            let numbers = core::array::from_fn(|k| R::blend(going, new[k], numbers[k]));
            let next = first.wrapping_add(across.wrapping_mul(rows));
            let words = [R::blend_uint(going, next, first), R::blend_uint(still, word(1), word(0))];
            ((numbers, words), [going & side.gt(one)])
        };
        let Walk { columns: Span { start, steps, cell }, differ, .. } = Walk::<R>::new();
        let numbers = [cell, start, steps, cell, start, steps, whole];
        let words = [word(0), R::blend_uint(differ, word(1), word(0))];
        let ([x, start_x, steps_x, y, start_y, steps_y, _], _) =
            R::iterate_with_words(MOST, (numbers, words), [whole.gt(one)], step);
        let columns = Span { start: start_x, steps: steps_x, cell: x };
        let rows = Span { start: start_y, steps: steps_y, cell: y };
        Walk { columns, rows, differ }.drawn()
    }
}
