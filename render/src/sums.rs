//! Sums of samples that do not depend on how the samples are split.
//!
//! Floating-point addition is not associative, so a sum depends on its order. Here the order is a binary tree over the indices of the
//! samples of a set: a [`Block`] of 2ᵏ samples begins at a multiple of 2ᵏ, and its sum is that of its two halves. Whoever adds up the
//! samples of any range keeps the sums of the largest blocks within it; whoever puts ranges together joins the halves of larger
//! blocks. In the end the sums are the same, bit for bit, as if all samples had been added in one place.
//!
//! Within eight aligned samples, which the renderer takes at once, sums are rounded to f32; all others are f64.

use std::ops::Range;

/// Samples that the renderer takes at once: their sums are f32.
const OCTET: u32 = 8;

/// Successive samples of a set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Block {
    /// Index of the set in its pixel.
    pub set: u32,
    /// Index of the first sample in its set.
    pub first: u32,
    /// Number of samples, greater than 0.
    pub count: u32,
}

impl Block {
    /// Whether the two blocks are the halves of a block of the tree.
    fn completes(self, right: Self) -> bool {
        let n = self.count;
        n.is_power_of_two()
            && right.count == n
            && self.set == right.set
            && self.first.is_multiple_of(2 * n)
            && right.first == self.first + n
    }
    /// Whether sums of both together are rounded to f32.
    fn is_within_octet(self, right: Self) -> bool {
        self.first / OCTET == (right.first + right.count - 1) / OCTET
    }
}

/// The largest blocks of the tree within a range of the samples of a pixel, in order. The samples are counted through all sets of `span`
/// samples each; a span of 0 stands for a single set.
pub fn blocks(range: Range<u32>, span: u32) -> impl Iterator<Item = Block> {
    let mut next = range.start;
    std::iter::from_fn(move || {
        if next >= range.end {
            return None;
        }
        let set = next.checked_div(span).unwrap_or(0);
        let first = next - set * span;
        let left = if span == 0 { range.end - next } else { (range.end - next).min(span - first) };
        // the greatest power of two that divides the index and is not too long
        let aligned = if first == 0 { u32::MAX } else { 1 << first.trailing_zeros() };
        let count = 1 << left.min(aligned).ilog2();
        next += count;
        Some(Block { set, first, count })
    })
}

/// What is known of a block, and can be computed from what is known of its halves.
pub trait Join {
    /// Adds what is known of the samples that follow. `left` and `right` are the two blocks.
    fn join(&mut self, left: Block, other: Self, right: Block);
}

/// What is known of a block of samples of one pixel.
pub trait Sample: Join + Copy + Default + PartialEq + Send {
    /// Whether the samples are independent, so that their squared deviations measure the error.
    const INDEPENDENT: bool;
    /// That of a single sample.
    fn one(x: [f32; 3]) -> Self;
    /// That of an aligned block of 1, 2, 4 or 8 samples.
    fn few(samples: &[[f32; 3]]) -> Self {
        let [left, right] = match samples {
            [sample] => return Self::one(*sample),
            _ => [&samples[..samples.len() / 2], &samples[samples.len() / 2..]],
        };
        let block = |first, samples: &[[f32; 3]]| Block { set: 0, first, count: samples.len() as u32 };
        let mut few = Self::few(left);
        few.join(block(0, left), Self::few(right), block(left.len() as u32, right));
        few
    }
    /// That of eight samples, channel by channel.
    fn octet(channels: &[[f32; 8]; 3]) -> Self;
    /// The sum, and the sum of squared deviations if it is computed, else zeros.
    fn moments(&self) -> Moments;
}

/// Sum of the samples of a block, per channel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sum(pub [f64; 3]);

/// Sum and sum of squared deviations of the samples of a block, per channel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    /// Σx.
    pub sum: [f64; 3],
    /// Σ(x − mean)².
    pub squares: [f64; 3],
}

/// Sums of successive pairs.
#[inline(always)]
fn pairs<const N: usize>(x: impl Fn(usize) -> f32) -> [f32; N] {
    std::array::from_fn(|i| x(2 * i) + x(2 * i + 1))
}

impl Sample for Sum {
    const INDEPENDENT: bool = false;

    fn one(x: [f32; 3]) -> Self {
        Self(x.map(f64::from))
    }
    #[inline]
    fn few(x: &[[f32; 3]]) -> Self {
        let add = |a: [f32; 3], b: [f32; 3]| [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
        let four = |x: [[f32; 3]; 4]| add(add(x[0], x[1]), add(x[2], x[3]));
        Self::one(match *x {
            [a] => a,
            [a, b] => add(a, b),
            [a, b, c, d] => four([a, b, c, d]),
            [a, b, c, d, e, f, g, h] => add(four([a, b, c, d]), four([e, f, g, h])),
            _ => unreachable!("blocks have a power of two of samples"),
        })
    }
    #[inline]
    fn octet(channels: &[[f32; 8]; 3]) -> Self {
        Self(channels.map(|x| {
            let two: [f32; 4] = pairs(|i| x[i]);
            let four: [f32; 2] = pairs(|i| two[i]);
            f64::from(four[0] + four[1])
        }))
    }
    fn moments(&self) -> Moments {
        Moments { sum: self.0, squares: [0.0; 3] }
    }
}

impl Sample for Moments {
    const INDEPENDENT: bool = true;

    fn one(x: [f32; 3]) -> Self {
        Self { sum: x.map(f64::from), squares: [0.0; 3] }
    }
    #[inline]
    fn octet(channels: &[[f32; 8]; 3]) -> Self {
        let squares = channels.map(|x| {
            let two: [f32; 4] = pairs(|i| x[i]);
            let four: [f32; 2] = pairs(|i| two[i]);
            let apart = |a: f32, b: f32, n: f64| between(a.into(), b.into(), [n; 2]);
            let ones: [f64; 4] = std::array::from_fn(|i| apart(x[2 * i], x[2 * i + 1], 1.0));
            let twos: [f64; 2] =
                std::array::from_fn(|i| ones[2 * i] + ones[2 * i + 1] + apart(two[2 * i], two[2 * i + 1], 2.0));
            twos[0] + twos[1] + apart(four[0], four[1], 4.0)
        });
        Self { sum: Sum::octet(channels).0, squares }
    }
    fn moments(&self) -> Moments {
        *self
    }
}

/// The squared deviations that two sets of samples have together beyond those within each (Chan, Golub and LeVeque 1983). For two equal
/// powers of two, the factors of the sums are exact.
#[inline]
fn between(left: f64, right: f64, counts: [f64; 2]) -> f64 {
    let [n, m] = counts;
    let difference = left * n.recip() - right * m.recip();
    difference * difference * (n * m / (n + m))
}

/// The sum of two blocks.
#[inline]
fn add(left: f64, right: f64, blocks: [Block; 2]) -> f64 {
    let sum = left + right;
    if blocks[0].is_within_octet(blocks[1]) { f64::from(sum as f32) } else { sum }
}

impl Join for Sum {
    #[inline]
    fn join(&mut self, left: Block, other: Self, right: Block) {
        for k in 0..3 {
            self.0[k] = add(self.0[k], other.0[k], [left, right]);
        }
    }
}

impl Join for Moments {
    #[inline]
    fn join(&mut self, left: Block, other: Self, right: Block) {
        let counts = [left, right].map(|block| f64::from(block.count));
        for k in 0..3 {
            self.squares[k] = self.squares[k] + other.squares[k] + between(self.sum[k], other.sum[k], counts);
            self.sum[k] = add(self.sum[k], other.sum[k], [left, right]);
        }
    }
}

/// Sums of a block of samples of each of many pixels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Planes {
    /// Σx of each pixel.
    pub sums: Vec<[f64; 3]>,
    /// Σ(x − mean)² of each pixel; empty unless samples are independent.
    pub squares: Vec<[f64; 3]>,
}

impl Join for Planes {
    fn join(&mut self, left: Block, other: Self, right: Block) {
        if self.squares.is_empty() {
            for (sum, other) in self.sums.iter_mut().zip(other.sums) {
                let mut own = Sum(*sum);
                own.join(left, Sum(other), right);
                *sum = own.0;
            }
            return;
        }
        let others = other.sums.into_iter().zip(other.squares).map(|(sum, squares)| Moments { sum, squares });
        for ((sum, squares), other) in self.sums.iter_mut().zip(&mut self.squares).zip(others) {
            let mut own = Moments { sum: *sum, squares: *squares };
            own.join(left, other, right);
            (*sum, *squares) = (own.sum, own.squares);
        }
    }
}

/// What is known of the samples of a pixel, or of many pixels alike: the largest blocks of the tree, in order.
#[derive(Clone, Debug, PartialEq)]
pub struct Sums<V> {
    blocks: Vec<(Block, V)>,
}

impl<V> Default for Sums<V> {
    fn default() -> Self {
        Self { blocks: Vec::new() }
    }
}

impl<V: Join> Sums<V> {
    /// Adds a block of the tree that has no sample in common with the others.
    #[inline]
    pub fn insert(&mut self, block: Block, value: V) {
        let mut at = self.blocks.len();
        // samples mostly arrive in order
        if self.blocks.last().is_some_and(|(last, _)| *last > block) {
            at = self.blocks.partition_point(|(other, _)| *other < block);
        }
        self.blocks.insert(at, (block, value));
        loop {
            let pair = |at: usize| Some((self.blocks.get(at)?.0, self.blocks.get(at + 1)?.0));
            if at > 0 && pair(at - 1).is_some_and(|(left, right)| left.completes(right)) {
                at -= 1;
            } else if pair(at).is_none_or(|(left, right)| !left.completes(right)) {
                return;
            }
            self.join(at);
        }
    }
    /// Joins a block and the one after it.
    #[inline]
    fn join(&mut self, at: usize) {
        let (right, other) = self.blocks.remove(at + 1);
        let (left, value) = &mut self.blocks[at];
        value.join(*left, other, right);
        left.count += right.count;
    }
    /// The blocks and what is known of them, in order.
    pub fn blocks(&self) -> &[(Block, V)] {
        &self.blocks
    }
    /// The same, as a list.
    pub fn into_blocks(self) -> Vec<(Block, V)> {
        self.blocks
    }
    /// Number of samples.
    pub fn count(&self) -> u32 {
        self.blocks.iter().map(|(block, _)| block.count).sum()
    }
    /// Joins all blocks of each set, the last two first, as the tree of a set does whose number of samples is no power of two. The count of
    /// a block in the result is the number of samples that are there, even if others between them are missing.
    pub fn finish(&mut self) -> &[(Block, V)] {
        let mut at = self.blocks.len();
        while at > 1 {
            at -= 1;
            if self.blocks[at - 1].0.set == self.blocks[at].0.set {
                self.join(at - 1);
            }
        }
        &self.blocks
    }
    /// Forgets all blocks.
    pub fn clear(&mut self) {
        self.blocks.clear();
    }
}

/// Adds up samples of a pixel that arrive in order, range after range.
#[derive(Clone, Debug)]
pub struct Adder<V> {
    sums: Sums<V>,
    /// The range so far: its set, its first sample, and the sample after its last that is in `stack`.
    set: u32,
    start: u32,
    next: u32,
    /// What is known of `blocks(start..next, 0)`.
    stack: Vec<V>,
    /// Samples since the last multiple of eight.
    waiting: [[f32; 3]; OCTET as usize],
    /// Their number.
    waits: usize,
}

impl<V> Default for Adder<V> {
    fn default() -> Self {
        let waiting = Default::default();
        Self { sums: Sums::default(), set: 0, start: 0, next: 0, stack: Vec::new(), waiting, waits: 0 }
    }
}

impl<V: Sample> Adder<V> {
    /// Begins a range: the next sample that is pushed is sample `first` of this set.
    #[inline]
    pub fn begin(&mut self, set: u32, first: u32) {
        self.end();
        (self.set, self.start, self.next) = (set, first, first);
    }
    /// Adds one sample.
    #[inline]
    pub fn push(&mut self, x: [f32; 3]) {
        self.waiting[self.waits] = x;
        self.waits += 1;
        if (self.next + self.waits as u32).is_multiple_of(OCTET) {
            self.flush();
        }
    }
    /// Adds eight samples, of which the first has an index that is a multiple of eight.
    #[inline]
    pub fn push_octet(&mut self, channels: &[[f32; 8]; 3]) {
        debug_assert!(self.waits == 0 && self.next.is_multiple_of(OCTET));
        self.add(OCTET, V::octet(channels));
    }
    /// Adds a block of 1 or 8 samples.
    #[inline]
    fn add(&mut self, count: u32, mut value: V) {
        self.next += count;
        let mut n = count;
        // as long as the block is the right half of one that begins within the range
        while self.next.is_multiple_of(2 * n) && self.next - self.start >= 2 * n {
            let [left, right] = [2 * n, n].map(|back| Block { set: self.set, first: self.next - back, count: n });
            let mut sum = self.stack.pop().unwrap_or_default();
            sum.join(left, value, right);
            value = sum;
            n *= 2;
        }
        self.stack.push(value);
    }
    fn flush(&mut self) {
        if self.next.is_multiple_of(OCTET) {
            // no block that ends within an octet is the right half of one that begins before it
            let mut at = 0;
            for count in [OCTET, 4, 2, 1] {
                if self.waits as u32 & count != 0 {
                    let value = V::few(&self.waiting[at..at + count as usize]);
                    at += count as usize;
                    if count == OCTET {
                        self.add(OCTET, value);
                    } else {
                        self.next += count;
                        self.stack.push(value);
                    }
                }
            }
        } else {
            for i in 0..self.waits {
                self.add(1, V::one(self.waiting[i]));
            }
        }
        self.waits = 0;
    }
    /// Ends the range.
    #[inline]
    fn end(&mut self) {
        self.flush();
        if let [value] = self.stack[..] {
            // by far the most frequent case
            self.sums.insert(Block { set: self.set, first: self.start, count: self.next - self.start }, value);
            self.stack.clear();
            return;
        }
        let blocks = blocks(self.start..self.next, 0);
        for (block, value) in blocks.zip(self.stack.drain(..)) {
            self.sums.insert(Block { set: self.set, ..block }, value);
        }
    }
    /// The sums of all ranges, which are to be taken or cleared before the next pixel.
    #[inline]
    pub fn sums(&mut self) -> &mut Sums<V> {
        self.end();
        &mut self.sums
    }
}
