//! Pictures on lights from words in memory.

use super::cells::{Axis, Box2, Cells, Drawn, Halves, Level, Lower, Region, Walk};
use super::pictured::PicturedLight;
use crate::memory::Memory;
use crate::real::{Real, State, Uint};
use crate::vector::Vec2;

/// A [`Picture`](super::Picture) as words in [memory](crate::memory): what samplers read where number types write sources.
///
/// Of single precision, samples and pdfs have the bits of the picture. On a processor the picture itself is the faster one.
///
/// - Domain: the picture's; the memory has the words of the buffer that [`build`](super::Picture::build) has filled.
/// - Degenerate: any other contents give samples with any pdf; a walk halves at most 48 boxes.
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

/// The axis of each lane: rows where the mask is true.
#[derive(Clone, Copy)]
struct PerLane<B>(B);

impl<R: Real> Axis<R> for PerLane<R::Mask> {
    #[inline(always)]
    fn of(self, &[x, y]: &[R; 2]) -> R {
        R::blend(self.0, y, x)
    }
    #[inline(always)]
    fn across(self, &[x, y]: &[R; 2]) -> R {
        R::blend(self.0, x, y)
    }
    #[inline(always)]
    fn sides(self, along: [R; 2], across: [R; 2]) -> [[R; 2]; 2] {
        let both = |a: [R; 2], b: [R; 2]| [R::blend(self.0, b[0], a[0]), R::blend(self.0, b[1], a[1])];
        [both(along, across), both(across, along)]
    }
    #[inline(always)]
    fn set(self, pair: &mut [R; 2], value: R) {
        *pair = [R::blend(self.0, pair[0], value), R::blend(self.0, value, pair[1])];
    }
    #[inline(always)]
    fn densities(self, halves: &impl Halves<R>, low: &Box2<R>, high: &Box2<R>) -> ([R; 2], R::Mask) {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let along = |axis: usize| {
            let ([a, b], differ) = halves.densities(axis, low, high);
            [a, b, one.keep(differ)]
        };
        let columns = R::where_any(!self.0, [zero; 3], || along(0));
        let rows = R::where_any(self.0, [zero; 3], || along(1));
        let [a, b, differ] = core::array::from_fn(|k| R::blend(self.0, rows[k], columns[k]));
        ([a, b], differ.gt(zero))
    }
}

/// The most halvings from 2²⁴ columns and rows to one.
const MOST: usize = 48;

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
    fn walk(&self, halves: &impl Halves<R>, lower: &impl Lower<R>) -> Drawn<R> {
        let (zero, half, one, word) = (R::lit(0.0), R::lit(0.5), R::lit(1.0), R::Uint::splat);
        let counts: Vec2<R> = Cells::counts(self);
        // the least power of two that is not below a number
        let above = |n: R| {
            let power = one / n.pow2_scale();
            R::blend(power.lt(n), power + power, power)
        };
        let (columns, rows) = (above(counts.x), above(counts.y));
        let step = |(numbers, [offset, differ]): State<R, 8, 2>, [going]: [R::Mask; 1]| {
            let [x0, y0, start_x, start_y, steps_x, steps_y, width, height] = numbers;
            let mut walk = Walk::<R, Self>::of(self);
            (walk.texel, walk.start, walk.steps) = ([x0, y0], [start_x, start_y], [steps_x, steps_y]);
            walk.differ = R::has_bits(differ);
            let axis = PerLane(height.gt(width));
            // boxes beside each other in memory, and in the picture; quotients by powers of two are exact
            let stride = (columns / width).to_uint();
            let index = (y0 / height).to_uint().wrapping_mul(stride).wrapping_add((x0 / width).to_uint());
            let share = self.memory.number(self.shares.wrapping_add(offset).wrapping_add(index));
            let sizes = [width, height];
            let level = Level { axis, half: axis.of(&sizes) * half, size: axis.across(&sizes), share };
            walk.descend(&level, halves, lower);
            let whole = (counts.y / height).to_uint();
            let some = R::blend_uint(R::from_uint(whole).lt(counts.y / height), word(1), word(0));
            let next = offset.wrapping_add(whole.wrapping_add(some).wrapping_mul(stride));
            let mut halved = sizes;
            axis.set(&mut halved, level.half);
            let Walk { texel, start, steps, .. } = walk;
            let new = [texel[0], texel[1], start[0], start[1], steps[0], steps[1], halved[0], halved[1]];
            let numbers = core::array::from_fn(|k| R::blend(going, new[k], numbers[k]));
            let words = [R::blend_uint(going, next, offset), R::blend_uint(walk.differ, word(1), word(0))];
            ((numbers, words), [going & (halved[0].gt(one) | halved[1].gt(one))])
        };
        let Walk { steps, .. } = Walk::<R, Self>::of(self);
        let first = [zero, zero, zero, zero, steps[0], steps[1], columns, rows];
        let going = columns.gt(one) | rows.gt(one);
        let ([x, y, start_x, start_y, steps_x, steps_y, ..], _) =
            R::iterate_with_words(MOST, (first, [word(0), word(1)]), [going], step);
        let mut walk = Walk::<R, Self>::of(self);
        (walk.texel, walk.start, walk.steps) = ([x, y], [start_x, start_y], [steps_x, steps_y]);
        walk.drawn()
    }
}
