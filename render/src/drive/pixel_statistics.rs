//! What the samples of a pixel tell of its variance.

use super::light_weights::APART;
use crate::choose::allocation::Allocated;
use crate::film::sums::{Adder, Moments, Sum};
use crate::film::{Accumulator, Pixel, channels};
use crate::packet::{V8, X8};
use etendue::estimate::Welford;
use etendue::{Mask, Real};

/// Statistics of a range of the samples of a pixel.
#[derive(Clone, Copy)]
pub(super) struct Statistics {
    /// Sum of each set.
    pub(super) sums: [[f64; 3]; 4],
    /// Sum of each set of what the camera sees directly: the radiance of lights and of the sky.
    pub(super) seen: [[f64; 3]; 4],
    /// Packets in each set.
    pub(super) packets: u32,
    /// Variance of the means of four samples each, summed over the channels, without what the camera sees directly; for samples that are
    /// allocated to at most `APART` lights, of what is known without samples of lights.
    pub(super) variance: f64,
    /// The part of the samples that cause the variance: 1 if all differ alike, 1/n if one of n does.
    pub(super) part: f32,
    /// The variance of what the camera sees directly, and its part.
    pub(super) outline: Outline,
    /// Number of lights to which the samples were allocated; 0 if they were not, or if there are more than `APART`.
    pub(super) lights: usize,
    /// Σ(xᵢ−xᵢ₊₁)² over pairs of successive samples of each light, per set.
    pub(super) spread: [f32; APART],
    /// Number of these pairs per set.
    pub(super) pairs: [u32; APART],
    /// Number of samples of each light per set.
    pub(super) taken: [u32; APART],
}

/// What the camera sees directly in a pixel: lights and the sky, whose outlines are most of its variance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Outline {
    /// Variance of the means of four samples each, summed over the channels; at least an eighth of what it would be if samples were independent,
    /// since two means are often alike by chance. (Four strata across an edge differ in one sample at most: a sixth to a quarter.)
    pub(super) variance: f64,
    /// The part of the samples that cause it.
    pub(super) part: f32,
}

impl Default for Outline {
    fn default() -> Self {
        Self { variance: 0.0, part: 1.0 }
    }
}

impl Outline {
    /// As [`Statistics::square`].
    pub(super) fn square(&self) -> f64 {
        16.0 * self.variance / f64::from(self.part).sqrt()
    }
}

impl Default for Statistics {
    fn default() -> Self {
        let (none, outline) = ([0; APART], Outline::default());
        let ([sums, seen], spread) = ([[[0.0; 3]; 4]; 2], [0.0; APART]);
        Self { sums, seen, packets: 0, variance: 0.0, part: 1.0, outline, lights: 0, spread, pairs: none, taken: none }
    }
}

impl Statistics {
    /// The pixel of these samples alone, in so many sets.
    pub(super) fn pixel(&self, sets: u32) -> Pixel {
        let set = |sum: &[f64; 3]| (8 * self.packets, Moments { sum: *sum, ..Moments::default() });
        let sets = if self.packets > 0 { sets as usize } else { 0 };
        Pixel::of_sets(self.sums.iter().take(sets).map(set), false)
    }
    /// Without what the camera sees directly, the squared difference of two successive samples, or what has the same effect, over the root of
    /// the [part](Self::part) that causes it:
    /// a set of n samples has a variance that is about proportional to this and to n^−1.5. (Where one sample of n has met something, the
    /// others tell it from nothing, and the variance is that of independent samples; where h of them have, only its outline is left to
    /// chance, and the variance is less by √h.)
    pub(super) fn square(&self) -> f64 {
        let samples = f64::from(8 * self.packets);
        let of_light = |k: usize| match (self.pairs[k], self.taken[k]) {
            (0, _) | (_, 0) => 0.0,
            (pairs, taken) => f64::from(self.spread[k]) / f64::from(pairs) * fall(f64::from(taken) / samples),
        };
        // a difference of two samples has 16 times the variance of the mean of four
        (16.0 * self.variance + (0..self.lights).map(of_light).sum::<f64>()) / f64::from(self.part).sqrt()
    }
}

/// The variance of the mean of four samples at the edge of something seen directly, relative to that of independent samples, at least.
const OUTLINE: f64 = 1.0 / 8.0;

/// n^−1.5
pub(super) fn fall(n: f64) -> f64 {
    (n * n.sqrt()).recip()
}

/// Accumulates [`Statistics`].
#[derive(Clone, Default)]
pub(super) struct StatisticsSum {
    /// Number of lights to which the samples are allocated; 0 if they are not.
    lights: usize,
    adder: Adder<Sum>,
    /// Sets that have begun, and packets of the last whose samples have seen nothing directly so far.
    sets: usize,
    blank: u32,
    part: Statistics,
    halves: Halves,
    seen_halves: Halves,
    /// Sum of squared deviations of what is seen directly from the mean of its four samples.
    within: f64,
    /// Sum of squared differences of successive samples of the same light.
    between: f64,
    /// The sum of reflected light for each light, times its squared share.
    spread: [f64; APART],
    /// Number of pairs in these sums, and of samples, of each light.
    pairs: [u32; APART],
    samples: [u32; APART],
}

/// The means of four samples each, and which of them cause their variance.
#[derive(Clone, Default)]
struct Halves {
    means: [Welford<f64>; 3],
    /// Sum, greatest and number of all squared differences.
    squares: [f64; 3],
}

impl Halves {
    fn push(&mut self, radiance: V8) {
        for half in halves(radiance) {
            let mut square = 0.0;
            for (spread, x) in self.means.iter_mut().zip(half) {
                let known = spread.count();
                // in the unit of a difference of two samples, and so that the squares sum up to those from the mean
                square += 16.0 * (x - spread.mean()).powi(2) * known / (known + 1.0);
                spread.push(x);
            }
            self.note(square);
        }
    }
    /// Notes a squared difference.
    fn note(&mut self, square: f64) {
        let [sum, greatest, count] = &mut self.squares;
        (*sum, *greatest, *count) = (*sum + square, greatest.max(square), *count + 1.0);
    }
    fn is_new(&self) -> bool {
        self.squares[2] == 0.0
    }
    /// 0 without any.
    fn variance(&self) -> f64 {
        if self.is_new() {
            return 0.0;
        }
        self.means.iter().map(|b| b.variance()).sum()
    }
    fn part(&self) -> f32 {
        let [sum, greatest, count] = self.squares;
        if greatest > 0.0 { (sum / (greatest * count)).clamp(1.0 / count, 1.0) as f32 } else { 1.0 }
    }
}

impl StatisticsSum {
    pub(super) fn new(lights: usize) -> Self {
        Self { lights, ..Self::default() }
    }
    /// Notes what eight samples see directly, which is nothing in most pixels.
    #[inline]
    fn look(&mut self, seen: V8) {
        if self.seen_halves.is_new() && !seen.max_abs().gt(X8::lit(0.0)).any() {
            self.blank += 1;
            return;
        }
        for _ in 0..std::mem::take(&mut self.blank) {
            self.seen_halves.push(V8::default());
        }
        self.seen_halves.push(seen);
        for (sum, lanes) in self.part.seen[self.sets - 1].iter_mut().zip(channels(seen)) {
            *sum += lanes.iter().copied().map(f64::from).sum::<f64>();
            for four in lanes.chunks(4) {
                let mean = four.iter().copied().map(f64::from).sum::<f64>() / 4.0;
                self.within += four.iter().map(|&x| (f64::from(x) - mean).powi(2)).sum::<f64>();
            }
        }
    }
}

impl Accumulator for StatisticsSum {
    type Output = Statistics;

    fn begin(&mut self, first: u32) {
        self.adder.begin(first);
        self.sets += 1;
    }
    fn push_packet(&mut self, radiance: V8, [seen, known]: [V8; 2], allocated: Option<&Allocated<'_>>) {
        self.adder.push_octet(&channels(radiance));
        self.look(seen);
        // the samples of a packet that is shared among lights differ by their lights: only what does not depend on them is compared
        self.halves.push(if allocated.is_some() { known } else { radiance - seen });
        let Some(allocated) = allocated else { return };
        let (light, share) = (allocated.light.to_array(), allocated.share.to_array());
        let reflected = radiance - (seen + known);
        let square = |v: V8, k: usize| {
            let [a, b] = [k, k + 1].map(|k| v.lane(k));
            [a.x - b.x, a.y - b.y, a.z - b.z].into_iter().map(|d| f64::from(d).powi(2)).sum::<f64>()
        };
        for k in [0, 2, 4, 6] {
            if light[k] != light[k + 1] {
                continue;
            }
            let square = square(reflected, k);
            self.between += square;
            let weighted = square * f64::from(share[k]).powi(2);
            self.halves.note(weighted);
            if let Some(spread) = self.spread.get_mut(light[k] as usize) {
                *spread += weighted;
                self.pairs[light[k] as usize] += 1;
            }
        }
        for light in light {
            if let Some(samples) = self.samples.get_mut(light as usize) {
                *samples += 1;
            }
        }
    }
    fn push(&mut self, _: [f32; 3]) {
        unreachable!("adaptive sets consist of whole packets")
    }
    fn finish(&mut self) -> Statistics {
        let mut part = self.part;
        let all = self.adder.sets();
        for (sum, (count, Sum(set))) in part.sums.iter_mut().zip(&*all) {
            (*sum, part.packets) = (*set, count / 8);
        }
        let sets = all.len().max(1) as u32;
        all.clear();
        (part.variance, part.part) = (self.halves.variance(), self.halves.part());
        // a mean of four independent samples has a quarter of the variance that three degrees of freedom each tell
        let least = OUTLINE * self.within / (12.0 * self.seen_halves.squares[2].max(1.0));
        part.outline = Outline { variance: self.seen_halves.variance().max(least), part: self.seen_halves.part() };
        if self.lights > APART && part.packets > 0 {
            // a difference of two samples has 16 times the variance of the mean of four
            part.variance += self.between / f64::from(16 * 4 * part.packets * sets);
        }
        if (1..=APART).contains(&self.lights) {
            part.lights = self.lights;
            part.spread = self.spread.map(|spread| (spread / f64::from(sets)) as f32);
            part.pairs = self.pairs.map(|pairs| pairs / sets);
            part.taken = self.samples.map(|samples| samples / sets);
        }
        let adder = std::mem::take(&mut self.adder);
        *self = Self { adder, ..Self::new(self.lights) };
        part
    }
}

/// The means of the first and the last four lanes.
fn halves(radiance: V8) -> [[f64; 3]; 2] {
    [0, 4].map(|first| {
        [radiance.x, radiance.y, radiance.z]
            .map(|channel| (first..first + 4).map(|k| f64::from(channel.lane(k))).sum::<f64>() / 4.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choose::allocation::Allocation;
    use crate::packet::X8;

    fn packet(of: impl Fn(usize) -> [f32; 3]) -> V8 {
        let lane = |channel: usize| X8::from_fn(|k| of(k)[channel]);
        V8::new(lane(0), lane(1), lane(2))
    }

    /// Without allocated samples, the variance is that of the means of four samples.
    #[test]
    fn variances_are_of_means_of_four() {
        let mut sum = StatisticsSum::new(0);
        let mut means: [Vec<f64>; 3] = Default::default();
        for set in 0..2 {
            sum.begin(0);
            for n in 0..2 {
                let sample = |k: usize| [k as f32, (k * k) as f32, (set * 2 + n) as f32 * 3.0 + k as f32 % 2.0];
                sum.push_packet(packet(sample), [packet(|_| [0.0; 3]); 2], None);
                for first in [0, 4] {
                    for (channel, means) in means.iter_mut().enumerate() {
                        means.push((first..first + 4).map(|k| f64::from(sample(k)[channel])).sum::<f64>() / 4.0);
                    }
                }
            }
        }
        let variance = |x: &Vec<f64>| {
            let mean = x.iter().sum::<f64>() / x.len() as f64;
            x.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (x.len() - 1) as f64
        };
        let expected: f64 = means.iter().map(variance).sum();
        let found = sum.finish();
        assert!((found.variance / expected - 1.0).abs() < 1e-14, "{} {expected}", found.variance);
        assert_eq!((found.packets, found.lights), (2, 0));
        assert_eq!(found.sums[1], [56.0, 280.0, 8.0 * (6.0 + 9.0) + 8.0]);
        // and the next pixel begins anew
        sum.begin(0);
        sum.push_packet(packet(|_| [1.0; 3]), [packet(|_| [0.0; 3]); 2], None);
        assert_eq!(sum.finish().variance, 0.0);
    }
    /// What is seen directly has a variance and sums of its own, and none in the rest: also if it is first seen in a later packet.
    #[test]
    fn outlines_are_told_apart() {
        let seen = |n: usize| packet(move |k| if n == 2 || n > 2 && k < 4 { [4.0, 2.0, 0.0] } else { [0.0; 3] });
        let rest = |n: usize| packet(move |k| [(k + n) as f32; 3]);
        let (mut sum, mut blank) = (StatisticsSum::new(0), StatisticsSum::new(0));
        [&mut sum, &mut blank].into_iter().for_each(|sum| sum.begin(0));
        for n in 0..4 {
            sum.push_packet(rest(n) + seen(n), [seen(n), V8::default()], None);
            blank.push_packet(rest(n), [V8::default(); 2], None);
        }
        let (found, blank) = (sum.finish(), blank.finish());
        assert_eq!((found.variance, found.part), (blank.variance, blank.part));
        assert_eq!(blank.outline, Outline::default());
        assert_eq!(found.seen[0], [12.0 * 4.0, 12.0 * 2.0, 0.0]);
        // of eight means of four samples, three are 4 and 2: 8/7 · 3/8 · 5/8 · (16 + 4)
        let expected = 8.0 / 7.0 * 15.0 / 64.0 * 20.0;
        assert!((found.outline.variance / expected - 1.0).abs() < 1e-14, "{}", found.outline.variance);
    }
    /// An edge that means of four samples do not tell, since three of each four see a light, has the variance of independent samples over eight.
    #[test]
    fn edges_are_told_where_means_are_alike() {
        let mut sum = StatisticsSum::new(0);
        sum.begin(0);
        let seen = packet(|k| [if k % 4 < 3 { 4.0 } else { 0.0 }, 0.0, 0.0]);
        sum.push_packet(seen, [seen, V8::default()], None);
        // 4 of samples, a quarter of that of independent means
        assert_eq!(sum.finish().outline.variance, 4.0 / 4.0 / 8.0);
        sum.begin(0);
        sum.push_packet(packet(|_| [4.0; 3]), [packet(|_| [4.0; 3]), V8::default()], None);
        assert_eq!(sum.finish().outline.variance, 0.0);
    }
    /// Allocated samples are compared in pairs of the same light, times its squared share, without what the camera sees.
    #[test]
    fn spreads_are_of_pairs_of_one_light() {
        // five samples of the first light and three of the second: pairs 0-1, 2-3 and 6-7
        let mut before = Allocation::NONE;
        let allocation = Allocation::new(&[5.0, 3.0], 8, &mut before);
        let counts = [before[0], before[1]];
        let allocated = allocation.samples(0);
        let light = allocated.light.to_array();
        let reflected = |k: usize| [(k * k) as f32, 2.0 * k as f32, 1.0];
        let seen = |k: usize| [if k < 4 { 3.0 } else { 5.0 }, 0.0, 0.0];
        let both = |k: usize| std::array::from_fn(|channel| reflected(k)[channel] + seen(k)[channel]);
        let mut expected = [[0.0; 2]; 2];
        for k in [0, 2, 4, 6].into_iter().filter(|&k| light[k] == light[k + 1]) {
            let [a, b] = [reflected(k), reflected(k + 1)];
            let square: f32 = (0..3).map(|channel| (a[channel] - b[channel]).powi(2)).sum();
            let own = &mut expected[light[k] as usize];
            *own = [own[0] + f64::from(square) * (f64::from(counts[light[k] as usize]) / 8.0).powi(2), own[1] + 1.0];
        }
        assert!(expected.iter().any(|own| own[1] > 0.0) && counts.iter().all(|&n| n > 0), "{light:?}");
        let mut sum = StatisticsSum::new(2);
        for _ in 0..2 {
            sum.begin(0);
            sum.push_packet(packet(both), [packet(|_| [0.0; 3]), packet(seen)], Some(&allocated));
        }
        let found = sum.finish();
        assert_eq!(found.lights, 2);
        for k in 0..2 {
            assert_eq!(f64::from(found.spread[k]), expected[k][0], "light {k}");
            assert_eq!([found.pairs[k], found.taken[k]], [expected[k][1] as u32, counts[k]], "light {k}");
        }
        // four means: 3, 5, 3, 5
        assert!((found.variance - 4.0 / 3.0).abs() < 1e-14, "{}", found.variance);
        // among more lights than are kept apart: the mean square of four pairs of each set, in the unit of the variance, and this
        let mut sum = StatisticsSum::new(APART + 1);
        for _ in 0..2 {
            sum.begin(0);
            sum.push_packet(packet(both), [packet(|_| [0.0; 3]), packet(seen)], Some(&allocated));
        }
        let squares: f64 = [0, 2, 4, 6]
            .into_iter()
            .filter(|&k| light[k] == light[k + 1])
            .map(|k| ((k + 1) * (k + 1) - k * k).pow(2) as f64 + 4.0)
            .sum();
        let found = sum.finish();
        assert_eq!(found.lights, 0);
        let all = squares / (4.0 * 16.0) + 4.0 / 3.0;
        assert!((found.variance / all - 1.0).abs() < 1e-14, "{} {all}", found.variance);
    }

    /// One sample of 64 that differs causes all of the variance, so that it falls as that of independent samples does.
    #[test]
    fn few_samples_cause_the_variance_of_rare_events() {
        for (hits, part) in [(1, 1.0 / 16.0), (4, 1.0 / 4.0), (16, 1.0)] {
            let mut sum = StatisticsSum::new(0);
            sum.begin(0);
            for n in 0..8 {
                let sample = |k: usize| {
                    let half = 2 * n + k / 4;
                    [if k.is_multiple_of(4) && (half * hits).is_multiple_of(16) { 1.0 } else { 0.0 }; 3]
                };
                sum.push_packet(packet(sample), [packet(|_| [0.0; 3]); 2], None);
            }
            let found = sum.finish();
            // of 16 means, all the same have no variance
            if hits == 16 {
                assert_eq!((found.part, found.square()), (1.0, 0.0));
            } else {
                assert!((0.5..=2.0).contains(&(f64::from(found.part) / part)), "{hits}: {}", found.part);
                let expected = 16.0 * found.variance / f64::from(found.part).sqrt();
                assert!((found.square() / expected - 1.0).abs() < 1e-12);
            }
        }
    }

    /// A light with a quarter of the samples has 8 times the variance of one with all of them: (1/4)^−1.5.
    #[test]
    fn squares_count_the_samples_of_each_light() {
        let (mut spread, mut pairs, mut taken) = ([0.0; APART], [0; APART], [0; APART]);
        spread[..3].copy_from_slice(&[6.0, 5.0, 7.0]);
        pairs[..3].copy_from_slice(&[3, 1, 0]);
        taken[..3].copy_from_slice(&[4, 11, 1]);
        let part = Statistics { packets: 2, variance: 0.25, lights: 3, spread, pairs, taken, ..Statistics::default() };
        let expected = 16.0 * 0.25 + 2.0 * 8.0 + 5.0 * (16.0 / 11.0_f64).powf(1.5);
        assert!((part.square() / expected - 1.0).abs() < 1e-12, "{}", part.square());
        assert_eq!(Statistics { packets: 2, variance: 0.5, ..Statistics::default() }.square(), 8.0);
    }
}
