//! Accumulates the mean and variance of pixels into an image.

use crate::packet::{V8, X8};
use etendue::{Real, estimate::Welford, select::Allocated};

/// The finished estimate of one pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pixel {
    /// Mean value per channel, by default radiance.
    pub mean: [f32; 3],
    /// Variance of the mean; infinite if it cannot be estimated.
    pub variance: [f32; 3],
    /// Number of samples.
    pub samples: u32,
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
        };
        Self { pixels: self.pixels.iter().map(scaled).collect(), ..*self }
    }
    /// Mean over all pixels.
    pub fn mean(&self) -> [f64; 3] {
        let sum = |k: usize| self.pixels.iter().map(|p| f64::from(p.mean[k])).sum::<f64>();
        std::array::from_fn(|k| sum(k) / self.pixels.len() as f64)
    }
}

/// Packets accumulated in f32 before they are merged into f64, which bounds the rounding error.
const BLOCK: u32 = 64;

/// Accumulates the samples of one pixel.
///
/// Replicates are independent of one another. If each sample is its own replicate, the variance comes from the samples, otherwise
/// from the means of the replicates.
#[derive(Clone, Copy, Debug, Default)]
pub struct PixelSum {
    lanes: [Welford<X8>; 3],
    packets: u32,
    samples: [Welford<f64>; 3],
    replicates: [Welford<f64>; 3],
    /// Number of samples in all replicates.
    taken: u32,
}

/// Accumulates the samples of one pixel after another.
pub trait Accumulator {
    /// What is known of a pixel in the end.
    type Output: Clone + Copy + Default + Send;
    /// Adds eight samples of one set, with the part of their radiance that the camera sees directly, and the lights to which they were
    /// allocated, if they were.
    fn push_packet(&mut self, radiance: V8, seen: V8, allocated: Option<&Allocated<'_, X8>>);
    /// Adds one sample.
    fn push(&mut self, radiance: [f32; 3]);
    /// Ends a set of samples that are not independent.
    fn end_set(&mut self);
    /// Returns the pixel, and starts the next one.
    fn finish(&mut self) -> Self::Output;
}

impl Accumulator for PixelSum {
    type Output = Pixel;

    #[inline]
    fn push_packet(&mut self, radiance: V8, _: V8, _: Option<&Allocated<'_, X8>>) {
        self.packets += 1;
        self.taken += 8;
        for (lane, x) in self.lanes.iter_mut().zip([radiance.x, radiance.y, radiance.z]) {
            lane.push(x);
        }
        if self.packets == BLOCK {
            self.flush();
        }
    }
    #[inline]
    fn push(&mut self, radiance: [f32; 3]) {
        self.taken += 1;
        for (sum, x) in self.samples.iter_mut().zip(radiance) {
            sum.push(f64::from(x));
        }
    }
    fn end_set(&mut self) {
        self.flush();
        for (sum, samples) in self.replicates.iter_mut().zip(&self.samples) {
            sum.push(samples.mean());
        }
        self.samples = Default::default();
    }
    fn finish(&mut self) -> Pixel {
        self.flush();
        let sums = if self.replicates[0].count() > 0.0 { self.replicates } else { self.samples };
        let pixel = Pixel {
            mean: sums.map(|s| s.mean() as f32),
            variance: sums.map(|s| (s.variance() / s.count()) as f32),
            samples: self.taken,
        };
        *self = Self::default();
        pixel
    }
}

impl PixelSum {
    fn flush(&mut self) {
        let n = f64::from(self.packets);
        if n == 0.0 {
            return;
        }
        for lane in 0..8 {
            for (sum, packet) in self.samples.iter_mut().zip(&self.lanes) {
                let [mean, m2] = [packet.mean(), packet.m2()].map(|x| f64::from(x.lane(lane)));
                *sum = sum.merge(Welford::from_moments(n, mean, m2));
            }
        }
        self.lanes = Default::default();
        self.packets = 0;
    }
    /// Returns the mean and sample count of an unfinished replicate, and resets the sum.
    pub fn take(&mut self) -> ([f64; 3], u32) {
        self.flush();
        let taken = (self.samples.map(|s| s.mean()), self.taken);
        *self = Self::default();
        taken
    }
}
