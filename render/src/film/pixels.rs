//! Accumulates the mean and variance of pixels into an image.

use super::sums::{Adder, Moments, Sample};
use crate::choose::allocation::Allocated;
use crate::packet::V8;

/// The finished estimate of one pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pixel {
    /// Mean value per channel, by default radiance.
    pub mean: [f32; 3],
    /// Variance of the mean; infinite if it cannot be estimated.
    pub variance: [f32; 3],
    /// Number of samples.
    pub samples: u32,
    /// What samples tell that are no part of the mean.
    pub second: Second,
}

/// The second set of a pixel, which only some pixels have: as many samples again, which are no part of the image, but judge it, and any image
/// made of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Second {
    /// Mean of its samples, in the unit of [`Pixel::mean`]. Whatever the mean of the pixel, its expectation is the light.
    pub mean: [f32; 3],
    /// The inverse of the chance with which the pixel was chosen to have one; 0 if it has none.
    pub weight: f32,
}

impl Second {
    /// What is known of the mean of images if one is added to others, with this share: a sum over the pixels by their weights has the same
    /// expectation as of each image.
    pub fn add(&mut self, other: &Self, share: f64) {
        let [own, added] = [f64::from(self.weight) * (1.0 - share), f64::from(other.weight) * share];
        let weight = own + added;
        if added > 0.0 {
            let both = |k: usize| own * f64::from(self.mean[k]) + added * f64::from(other.mean[k]);
            self.mean = std::array::from_fn(|k| (both(k) / weight) as f32);
        }
        self.weight = weight as f32;
    }
}

/// A rendered image.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Pixels row by row from the top left.
    pub pixels: Vec<Pixel>,
}

impl Film {
    /// The image with all values multiplied by `factor`.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let times = |x: f32, factor: f64| (f64::from(x) * factor) as f32;
        let scaled = |p: &Pixel| Pixel {
            mean: p.mean.map(|x| times(x, factor)),
            variance: p.variance.map(|x| times(x, factor * factor)),
            samples: p.samples,
            second: Second { mean: p.second.mean.map(|x| times(x, factor)), ..p.second },
        };
        Self { pixels: self.pixels.iter().map(scaled).collect(), ..*self }
    }
    /// Mean over all pixels.
    pub fn mean(&self) -> [f64; 3] {
        let sum = |k: usize| self.pixels.iter().map(|p| f64::from(p.mean[k])).sum::<f64>();
        std::array::from_fn(|k| sum(k) / self.pixels.len() as f64)
    }
}

/// Accumulates the samples of one pixel after another.
pub trait Accumulator {
    /// What is known of a pixel in the end.
    type Output: Clone + Default + Send;
    /// Begins successive samples of the next set, with this one.
    fn begin(&mut self, first: u32);
    /// Adds eight samples, of which the first has an index that is a multiple of eight, with the parts of their radiance that the camera
    /// sees directly, and that are known without samples of lights; and the lights to which they were allocated, if they were.
    fn push_packet(&mut self, radiance: V8, parts: [V8; 2], allocated: Option<&Allocated<'_>>);
    /// Adds one sample.
    fn push(&mut self, radiance: [f32; 3]);
    /// Returns the pixel, and starts the next one.
    fn finish(&mut self) -> Self::Output;
}

impl Pixel {
    /// The pixel of these sets of samples: the number of each, and its sums. Each sample of `independent` ones is its own set for the
    /// variance.
    ///
    /// Mean: Σᵢsᵢ / N over the sums sᵢ of S sets of nᵢ samples, N in all. Variance of the mean, if that of a set is proportional to 1/nᵢ:
    /// Σᵢ (nᵢ/N) (sᵢ/nᵢ − mean)² / (S − 1), or Σ(x − mean)² / (N (N − 1)) of independent samples.
    #[must_use]
    pub fn of_sets(sets: impl Iterator<Item = (u32, Moments)> + Clone, independent: bool) -> Self {
        let samples: u32 = sets.clone().map(|(count, _)| count).sum();
        let n = f64::from(samples.max(1));
        let (mut sum, mut squares, mut others) = ([0.0; 3], [0.0; 3], -1.0);
        for (_, set) in sets.clone() {
            for k in 0..3 {
                sum[k] += set.sum[k];
                squares[k] += set.squares[k];
            }
        }
        let share = n.recip();
        let mean = sum.map(|sum| sum * share);
        if independent {
            others = n - 1.0;
        } else {
            for (count, set) in sets {
                let (count, share) = (f64::from(count), f64::from(count).recip());
                others += 1.0;
                for k in 0..3 {
                    let difference = set.sum[k] * share - mean[k];
                    squares[k] += count * (difference * difference);
                }
            }
        }
        let scale = (n * others).recip();
        // nothing is known of the error of a single set
        let variance = |squares: f64| if others > 0.0 { (squares * scale) as f32 } else { f32::INFINITY };
        let mean = mean.map(|x| x as f32);
        Self { mean, variance: squares.map(variance), samples, second: Second::default() }
    }
}

/// Accumulates the samples of pixels.
#[derive(Clone, Debug, Default)]
pub struct PixelSum<V>(Adder<V>);

impl<V: Sample> Accumulator for PixelSum<V> {
    type Output = Pixel;

    #[inline]
    fn begin(&mut self, first: u32) {
        self.0.begin(first);
    }
    #[inline]
    fn push_packet(&mut self, radiance: V8, _: [V8; 2], _: Option<&Allocated<'_>>) {
        self.0.push_octet(&channels(radiance));
    }
    #[inline]
    fn push(&mut self, radiance: [f32; 3]) {
        self.0.push(radiance);
    }
    fn finish(&mut self) -> Pixel {
        let sets = self.0.sets();
        let pixel = Pixel::of_sets(sets.iter().map(|(count, value)| (*count, value.moments())), V::INDEPENDENT);
        sets.clear();
        pixel
    }
}

/// The lanes of each channel.
#[inline(always)]
pub fn channels(radiance: V8) -> [[f32; 8]; 3] {
    [radiance.x, radiance.y, radiance.z].map(|x| x.to_array())
}
