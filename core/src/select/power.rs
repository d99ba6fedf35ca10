//! Choice of lights by their power.

use super::{Choice, LightChoice, LightsError};
use crate::real::{Real, Uint, unit_interval};

/// Chooses lights in proportion to their power, by a table of sums in the caller's buffer.
///
/// - Formula: the first index whose sum exceeds u·Σ; pmf = (its sum − the one before)/Σ. That is exactly what the search does, so the
///   rounding of the sums causes no bias.
/// - Domain: powers in [0, 3e38], in any unit; NaN, negative and infinite ones count as 0. A positive power counts as at least
///   2⁻¹⁸ of the total, so that some u on the grid of 2⁻²⁴ finds each light.
/// - Bounds: up to 2¹⁴ lights. A light's frequency is within 2⁻²⁴ of its probability.
/// - Degenerate: if no light has power, the pmf is 0.
///
/// ```
/// use etendue::select::{LightChoice, PowerLights};
/// let mut sums = [0.0; 3];
/// let lights = PowerLights::new(&[1.0, 0.0, 3.0], &mut sums)?;
/// let choice = lights.choose(0.625_f32);
/// assert_eq!((choice.index, choice.pmf, choice.u), (2, 0.75, 0.5));
/// assert_eq!(LightChoice::<f32>::pmf(&lights, 1), 0.0);
/// # Ok::<(), etendue::select::LightsError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct PowerLights<'a> {
    sums: &'a [f32],
}

impl<'a> PowerLights<'a> {
    /// The greatest number of lights: with more, the least pmf would exceed a fair share.
    pub const MOST: usize = 1 << 14;

    /// Fills `sums`, which needs one entry per light.
    ///
    /// # Errors
    /// If the lengths differ, or there are more than [`MOST`](Self::MOST) lights.
    pub fn new(powers: &[f32], sums: &'a mut [f32]) -> Result<Self, LightsError> {
        if powers.len() > Self::MOST {
            return Err(LightsError::TooMany);
        }
        if powers.len() != sums.len() {
            return Err(LightsError::Length);
        }
        let clean = |power: f32| if power > 0.0 && power < f32::INFINITY { f64::from(power) } else { 0.0 };
        let total: f64 = powers.iter().map(|&power| clean(power)).sum();
        let mut sum = 0.0;
        for (to, &power) in sums.iter_mut().zip(powers) {
            let share = if power > 0.0 && total > 0.0 { clean(power) / total } else { 0.0 };
            sum += if clean(power) > 0.0 { share.greater(1.0 / 262_144.0) } else { 0.0 };
            *to = sum as f32;
        }
        Ok(Self { sums })
    }
    /// The table that [`new`](Self::new) has filled. Other contents are not validated; they never cause a panic.
    #[must_use]
    pub const fn from_buffer(sums: &'a [f32]) -> Self {
        Self { sums }
    }
    /// Sum before a light, and its share: exact differences.
    fn interval(&self, index: u32) -> [f64; 2] {
        let at = |i: usize| self.sums.get(i).copied().map_or(0.0, f64::from);
        let index = index as usize;
        let before = if index == 0 { 0.0 } else { at(index - 1) };
        [before, if index < self.sums.len() { at(index) - before } else { 0.0 }]
    }
}

impl<R: Real> LightChoice<R> for PowerLights<'_> {
    #[inline]
    fn choose(&self, u: R) -> Choice<R> {
        let total = self.sums.last().copied().map_or(0.0, f64::from);
        let u = unit_interval(u);
        let find = |i| {
            let place = u.lane_f64(i) * total;
            let index = self.sums.partition_point(|&sum| f64::from(sum) <= place);
            (index.min(self.sums.len().saturating_sub(1)) as u32, place)
        };
        let index = R::Uint::from_fn(|i| find(i).0);
        let left = R::from_fn(|i| {
            let (index, place) = find(i);
            let [before, width] = self.interval(index);
            R::Scalar::lit(if width > 0.0 { (place - before) / width } else { 0.0 })
        });
        Choice { index, pmf: self.pmf(index), u: unit_interval(left) }
    }
    #[inline]
    fn pmf(&self, index: R::Uint) -> R {
        let total = self.sums.last().copied().map_or(0.0, f64::from);
        R::from_fn(|i| R::Scalar::lit(if total > 0.0 { self.interval(index.lane(i))[1] / total } else { 0.0 }))
    }
}
