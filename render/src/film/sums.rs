//! Sums of samples in a fixed order.
//!
//! Floating-point addition is not associative, so a sum depends on its order. Here the order is a binary tree over the indices of the
//! samples of a set: a [`Block`] of 2ᵏ samples begins at a multiple of 2ᵏ, and its sum is that of its two halves. What remains of a set
//! whose number of samples is no power of two is added from the end.
//!
//! Within eight aligned samples, which the renderer takes at once, sums are rounded to f32; all others are f64.

/// Samples that the renderer takes at once: their sums are f32.
const OCTET: u32 = 8;

/// Successive samples of a set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Block {
    /// Index of the first sample in its set.
    pub first: u32,
    /// Number of samples, greater than 0.
    pub count: u32,
}

impl Block {
    /// Whether sums of both together are rounded to f32.
    fn is_within_octet(self, right: Self) -> bool {
        self.first / OCTET == (right.first + right.count - 1) / OCTET
    }
}

/// What is known of a block of samples of one pixel.
pub trait Sample: Copy + Default + Send {
    /// Whether the samples are independent, so that their squared deviations measure the error.
    const INDEPENDENT: bool;
    /// Adds what is known of the samples that follow. `left` and `right` are the two blocks.
    fn join(&mut self, left: Block, other: Self, right: Block);
    /// That of a single sample.
    fn one(x: [f32; 3]) -> Self;
    /// That of an aligned block of 1, 2, 4 or 8 samples.
    fn few(samples: &[[f32; 3]]) -> Self {
        let [left, right] = match samples {
            [sample] => return Self::one(*sample),
            _ => [&samples[..samples.len() / 2], &samples[samples.len() / 2..]],
        };
        let block = |first, samples: &[[f32; 3]]| Block { first, count: samples.len() as u32 };
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

    #[inline]
    fn join(&mut self, left: Block, other: Self, right: Block) {
        for k in 0..3 {
            self.0[k] = add(self.0[k], other.0[k], [left, right]);
        }
    }
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

    #[inline]
    fn join(&mut self, left: Block, other: Self, right: Block) {
        let counts = [left, right].map(|block| f64::from(block.count));
        for k in 0..3 {
            self.squares[k] = self.squares[k] + other.squares[k] + between(self.sum[k], other.sum[k], counts);
            self.sum[k] = add(self.sum[k], other.sum[k], [left, right]);
        }
    }
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

/// Adds up the samples of a pixel, set after set, each in order.
#[derive(Clone, Debug)]
pub struct Adder<V> {
    /// The number of samples of each set so far, and their sum.
    sets: Vec<(u32, V)>,
    /// The first sample of the set that is being added up, and the one after its last that is in `stack`.
    start: u32,
    next: u32,
    /// What is known of the largest blocks of the tree within `start..next`, in order.
    stack: Vec<(Block, V)>,
    /// Samples since the last multiple of eight.
    waiting: [[f32; 3]; OCTET as usize],
    /// Their number.
    waits: usize,
}

impl<V> Default for Adder<V> {
    fn default() -> Self {
        Self { sets: Vec::new(), start: 0, next: 0, stack: Vec::new(), waiting: Default::default(), waits: 0 }
    }
}

impl<V: Sample> Adder<V> {
    /// Begins a set: the next sample that is pushed is its sample `first`.
    #[inline]
    pub fn begin(&mut self, first: u32) {
        self.end();
        (self.start, self.next) = (first, first);
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
        let mut block = Block { first: self.next, count };
        self.next += count;
        // as long as the block is the right half of one that begins within the set
        while self.next.is_multiple_of(2 * block.count)
            && self.next - self.start >= 2 * block.count
            && let Some((left, mut sum)) = self.stack.pop()
        {
            sum.join(left, value, block);
            value = sum;
            block = Block { first: left.first, count: 2 * block.count };
        }
        self.stack.push((block, value));
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
                        self.stack.push((Block { first: self.next, count }, value));
                        self.next += count;
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
    /// Ends the set: joins its blocks, the last two first.
    #[inline]
    fn end(&mut self) {
        self.flush();
        let Some((mut last, mut value)) = self.stack.pop() else { return };
        while let Some((block, mut sum)) = self.stack.pop() {
            sum.join(block, value, last);
            value = sum;
            last = Block { first: block.first, count: block.count + last.count };
        }
        self.sets.push((last.count, value));
    }
    /// The number of samples and the sum of each set, which are to be cleared before the next pixel.
    #[inline]
    pub fn sets(&mut self) -> &mut Vec<(u32, V)> {
        self.end();
        &mut self.sets
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sum of a block of the tree.
    fn sum_of<V: Sample>(samples: &[[f32; 3]], Block { first, count }: Block) -> V {
        if count == 1 {
            return V::one(samples[first as usize]);
        }
        let [left, right] = [first, first + count / 2].map(|first| Block { first, count: count / 2 });
        let mut sum: V = sum_of(samples, left);
        sum.join(left, sum_of(samples, right), right);
        sum
    }

    /// The sum of samples `first` to `end` of a set: of the largest blocks, added from the end.
    fn tree<V: Sample>(samples: &[[f32; 3]], first: u32, end: u32) -> V {
        let aligned = if first == 0 { u32::MAX } else { 1 << first.trailing_zeros() };
        let block = Block { first, count: 1 << (end - first).min(aligned).ilog2() };
        let mut sum: V = sum_of(samples, block);
        let next = first + block.count;
        if next < end {
            sum.join(block, tree(samples, next, end), Block { first: next, count: end - next });
        }
        sum
    }

    /// However samples arrive, singly or by eight, their sums are those of the tree, and as exact as sums of f32 in octets can be.
    #[test]
    fn sums_are_those_of_a_tree() {
        let samples: Vec<[f32; 3]> = (0..4097_u32)
            .map(|i| [1, 2, 3].map(|k| ((i * k * 7919 + 13 * k) % 1009) as f32 * ((i % 23) as f32 - 12.0).exp2()))
            .collect();
        for (first, end) in
            [(0, 1), (0, 2), (0, 3), (0, 7), (0, 8), (3, 9), (0, 31), (8, 64), (16, 100), (5, 1000), (0, 4097)]
        {
            let (mut sums, mut moments) = (Adder::<Sum>::default(), Adder::<Moments>::default());
            sums.begin(first);
            moments.begin(first);
            let mut i = first;
            while i < end {
                if i % 16 == 8 && i + 8 <= end {
                    let octet = [0, 1, 2].map(|k| std::array::from_fn(|lane| samples[i as usize + lane][k]));
                    sums.push_octet(&octet);
                    moments.push_octet(&octet);
                    i += 8;
                } else {
                    sums.push(samples[i as usize]);
                    moments.push(samples[i as usize]);
                    i += 1;
                }
            }
            let n = end - first;
            let expected: Moments = tree(&samples, first, end);
            assert_eq!(*sums.sets(), [(n, tree(&samples, first, end))]);
            assert_eq!(*moments.sets(), [(n, expected)]);
            for k in 0..3 {
                let values = || samples[first as usize..end as usize].iter().map(|x| f64::from(x[k]));
                let (sum, mean) = (values().sum::<f64>(), values().sum::<f64>() / f64::from(n));
                let squares = values().map(|x| (x - mean).powi(2)).sum::<f64>();
                // three roundings to f32 of positive numbers
                assert!((expected.sum[k] - sum).abs() <= 3.0 * sum * 2.0_f64.powi(-24), "{n}: {expected:?} {sum}");
                assert!((expected.squares[k] - squares).abs() <= 1e-6 * (squares + mean * mean), "{n}: {squares}");
            }
        }
    }
}
