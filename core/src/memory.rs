//! Memory that a routine reads in each lane at an index of its own.

use crate::real::{Real, State, Uint};

/// A sequence of 32-bit words, each of which may be a number of single precision by its bits.
///
/// Slices are memory. The trait is open, so that number types that write sources read what a device has in a buffer.
///
/// ```
/// use etendue::{f32x4, memory::Memory, u32x4};
/// let table = [2.0_f32, 3.0, 5.0, 7.0];
/// let numbers: f32x4 = (&table[..]).number(u32x4::from([3, 0, 0, 1]));
/// assert_eq!(numbers.to_array(), [7.0, 2.0, 2.0, 3.0]);
/// let past: f32 = (&table[..]).number(4);
/// assert_eq!(past, 0.0);
/// ```
pub trait Memory<R: Real>: Copy {
    /// The word at an index in each lane. Past the end it is any word, which for slices is 0.
    fn word(&self, index: R::Uint) -> R::Uint;
    /// The number at an index in each lane. Past the end it is any number, which for slices is 0.
    fn number(&self, index: R::Uint) -> R;
    /// How many of `count` ascending numbers, the first of which is at this index, are not above `x`; the last one is not asked.
    #[inline(always)]
    fn count_up_to(&self, first: R::Uint, count: R::Uint, x: R) -> R::Uint {
        let one = R::Uint::splat(1);
        let before = first.wrapping_sub(one);
        let step = |([], [low, count]): State<R, 0, 2>, [going]: [R::Mask; 1]| {
            let half = Uint::shr(count, 1);
            let middle = Uint::wrapping_add(low, half);
            let is_up_to = self.number(before.wrapping_add(middle)).le(x);
            let left = R::blend_uint(going, count.wrapping_sub(half), count);
            (([], [R::blend_uint(going & is_up_to, middle, low), left]), [going & R::has_bits(one.lt(left))])
        };
        let going = [R::has_bits(one.lt(count))];
        let ([], [index, _]) = R::iterate_with_words(32, ([], [R::Uint::splat(0), count]), going, step);
        index
    }
    /// The number before the one at `index` after the first, which is 0 for the first, and that one.
    #[inline(always)]
    fn pair(&self, first: R::Uint, index: R::Uint) -> (R, R) {
        two_numbers(self, first, index)
    }
}

/// See [`Memory::pair`].
#[inline(always)]
fn two_numbers<R: Real>(memory: &impl Memory<R>, first: R::Uint, index: R::Uint) -> (R, R) {
    let at = first.wrapping_add(index);
    (memory.number(at.wrapping_sub(R::Uint::splat(1))).keep(R::has_bits(index)), memory.number(at))
}

impl<R: Real> Memory<R> for &[f32] {
    #[inline(always)]
    fn word(&self, index: R::Uint) -> R::Uint {
        R::Uint::from_fn(|lane| self.get(index.lane(lane) as usize).map_or(0, |number| number.to_bits()))
    }
    #[inline(always)]
    fn number(&self, index: R::Uint) -> R {
        R::from_fn(|lane| {
            let number = self.get(index.lane(lane) as usize).copied().unwrap_or(0.0);
            R::Scalar::lit(f64::from(number))
        })
    }
    #[inline(always)]
    fn count_up_to(&self, first: R::Uint, count: R::Uint, x: R) -> R::Uint {
        R::Uint::from_fn(|lane| {
            let (first, others, x) = (first.lane(lane) as usize, count.lane(lane).wrapping_sub(1), x.lane_f64(lane));
            let numbers = self.get(first..first.wrapping_add(others as usize)).unwrap_or_default();
            numbers.partition_point(|&number| f64::from(number) <= x) as u32
        })
    }
    #[inline(always)]
    fn pair(&self, first: R::Uint, index: R::Uint) -> (R, R) {
        if R::LANES > 1 {
            return two_numbers(self, first, index);
        }
        // one test of the length serves both
        let (first, index) = (first.lane(0) as usize, index.lane(0) as usize);
        let at = first.wrapping_add(index);
        let [before, number] = match self.get(at) {
            Some(&number) => [if index > 0 { self[at - 1] } else { 0.0 }, number],
            None => [0.0; 2],
        };
        (R::lit(f64::from(before)), R::lit(f64::from(number)))
    }
}

impl<R: Real> Memory<R> for &[u32] {
    #[inline(always)]
    fn word(&self, index: R::Uint) -> R::Uint {
        R::Uint::from_fn(|lane| self.get(index.lane(lane) as usize).copied().unwrap_or(0))
    }
    #[inline(always)]
    fn number(&self, index: R::Uint) -> R {
        R::from_fn(|lane| {
            let bits = self.get(index.lane(lane) as usize).copied().unwrap_or(0);
            R::Scalar::lit(f64::from(f32::from_bits(bits)))
        })
    }
}
