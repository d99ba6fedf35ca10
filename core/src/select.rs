//! Chooses which light to sample: an index, its probability, and what is left of the random number.
//!
//! | choice | pmf | cost | when |
//! |---|---|---|---|
//! | [`UniformLights`] | 1/n | least | few, similar lights |
//! | [`PowerLights`] | power/Σpower | a binary search per lane | lights of different power at similar distances |
//! | [`SpatialLights`] | power/distance², per shading point | two passes over all lights | up to some tens of lights, near and far |
//!
//! The estimator divides by the `pmf` of the choice times the pdf of the sample on the light. Each type also has a method `pmf`, which
//! returns the same bits, for multiple importance sampling: a light that another technique hits has a probability too. Every light of
//! positive power has a positive pmf, and no other light has.

use crate::discrete::TableError;
use crate::estimate::Reservoir;
use crate::real::{Real, Uint, unit_interval};
use crate::vector::Vec3;

/// A light that was chosen, per lane.
#[derive(Clone, Copy, Debug)]
pub struct Choice<R: Real> {
    /// Index of the light.
    pub index: R::Uint,
    /// Probability with which it was chosen; 0 in lanes without a light.
    pub pmf: R,
    /// What is left of the random number: uniform in [0, 1), independent of the index.
    pub u: R,
}

/// Chooses each light with the same probability.
///
/// - Formula: index = ⌊u·count⌋, pmf 1/count.
/// - Domain: up to 2²² lights.
/// - Degenerate: without lights the pmf is 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UniformLights {
    /// Number of lights.
    pub count: u32,
}

impl UniformLights {
    /// Chooses by `u` in [0, 1).
    #[inline]
    pub fn choose<R: Real>(&self, u: R) -> Choice<R> {
        let place = u * R::lit(f64::from(self.count));
        let index = place.to_uint();
        let last = R::Uint::splat(self.count.saturating_sub(1));
        // the product may have been rounded up to the count: all ones are −1
        let index = index.wrapping_add(last.lt(index));
        Choice { index, pmf: self.pmf(index), u: unit_interval(place - R::from_uint(index)) }
    }
    /// Probability of a light; 0 for an index past the last light.
    #[inline]
    pub fn pmf<R: Real>(&self, index: R::Uint) -> R {
        R::from_fn(|i| R::Scalar::lit(if index.lane(i) < self.count { 1.0 / f64::from(self.count) } else { 0.0 }))
    }
}

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
/// use etendue::select::PowerLights;
/// let mut sums = [0.0; 3];
/// let lights = PowerLights::new(&[1.0, 0.0, 3.0], &mut sums)?;
/// let choice = lights.choose(0.625_f32);
/// assert_eq!((choice.index, choice.pmf, choice.u), (2, 0.75, 0.5));
/// assert_eq!(lights.pmf::<f32>(1), 0.0);
/// # Ok::<(), etendue::discrete::TableError>(())
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
    /// [`TableError::Length`] if the lengths differ or there are more than [`MOST`](Self::MOST) lights.
    pub fn new(powers: &[f32], sums: &'a mut [f32]) -> Result<Self, TableError> {
        if powers.len() != sums.len() || powers.len() > Self::MOST {
            return Err(TableError::Length);
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
    /// Chooses by `u` in [0, 1).
    #[inline]
    pub fn choose<R: Real>(&self, u: R) -> Choice<R> {
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
    /// Probability of a light; 0 for an index past the last light.
    #[inline]
    pub fn pmf<R: Real>(&self, index: R::Uint) -> R {
        let total = self.sums.last().copied().map_or(0.0, f64::from);
        R::from_fn(|i| R::Scalar::lit(if total > 0.0 { self.interval(index.lane(i))[1] / total } else { 0.0 }))
    }
    /// Sum before a light, and its share: exact differences.
    fn interval(&self, index: u32) -> [f64; 2] {
        let at = |i: usize| self.sums.get(i).copied().map_or(0.0, f64::from);
        let index = index as usize;
        let before = if index == 0 { 0.0 } else { at(index - 1) };
        [before, if index < self.sums.len() { at(index) - before } else { 0.0 }]
    }
}

/// Bounding sphere and power of a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightBound {
    /// Centre of a sphere around the light, in the coordinates of the scene.
    pub center: [f32; 3],
    /// Radius of that sphere, not negative.
    pub radius: f32,
    /// Power, or any number in proportion to what the light can contribute at a given distance.
    pub power: f32,
}

/// Chooses lights in proportion to an estimate of their irradiance at the shading point: power over the squared distance to the centre,
/// or over the squared radius if that is more.
///
/// - Formula: weight = power·(least/d)², d = max(|centre − p|, radius), where `least` is the smallest d of all lights; a
///   [`Reservoir`] over the weights.
/// - Domain: any finite bounds and points; powers as for [`PowerLights`], from 1e−20 to 1e20. (least/d)² counts as at least 2⁻¹⁸, so a
///   far light is never dropped. Scaling all lengths by a power of two changes nothing.
/// - Degenerate: without a light of positive power the pmf is 0.
/// - Precision: a light's frequency is within 2⁻²³ of its probability for each light of the list.
/// - Lanes are shading points, or samples of one; each lane visits every light.
/// - Source: the weight is that of Shirley, Wang and Zimmerman, "Monte Carlo Techniques for Direct Lighting Calculations", ACM TOG
///   15(1), 1996, for few lights.
///
/// ```
/// use etendue::select::{LightBound, SpatialLights};
/// let near = LightBound { center: [0.0, 0.0, 1.0], radius: 0.1, power: 1.0 };
/// let far = LightBound { center: [0.0, 0.0, -2.0], radius: 0.1, power: 4.0 };
/// let both = [near, far];
/// let choice = SpatialLights { lights: &both }.choose([0.0, 0.0, 0.0].into(), 0.25_f32);
/// assert_eq!(choice.pmf, 0.5);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct SpatialLights<'a> {
    /// The lights, in the order of their indices.
    pub lights: &'a [LightBound],
}

impl SpatialLights<'_> {
    /// Half the distance to the light, at least half its radius. Components are scaled by a power of two before they are squared.
    #[inline]
    fn distance<R: Real>(light: &LightBound, p: Vec3<R>) -> R {
        let lit = |x: f32| R::lit(f64::from(x));
        let half = R::lit(0.5);
        let [x, y, z] = light.center.map(lit);
        // halves do not overflow
        let offset = Vec3::new(x * half - p.x * half, y * half - p.y * half, z * half - p.z * half);
        let scale = offset.max_abs().pow2_scale();
        let length = (offset * scale).length_squared().sqrt() / scale;
        length.greater(lit(light.radius) * half).lesser(lit(f32::MAX))
    }
    /// Smallest distance to a light of positive power.
    #[inline]
    fn least<R: Real>(&self, p: Vec3<R>) -> R {
        let lit = |light: &&LightBound| light.power > 0.0;
        self.lights
            .iter()
            .filter(lit)
            .fold(R::lit(f64::from(f32::MAX)), |least, light| least.lesser(Self::distance(light, p)))
    }
    #[inline]
    fn weight<R: Real>(light: &LightBound, least: R, p: Vec3<R>) -> R {
        let distance = Self::distance(light, p);
        let positive = distance.gt(R::lit(0.0));
        // at the centre of a point light: the least distance is 0, and the ratio 1
        let one = R::lit(1.0);
        // only a light of no power is nearer than the least
        let ratio = R::blend(positive, least / R::blend(positive, distance, one), one).lesser(one);
        let power = if light.power > 0.0 && light.power < f32::INFINITY { light.power } else { 0.0 };
        R::lit(f64::from(power)) * (ratio * ratio).greater(R::lit(1.0 / 262_144.0))
    }
    /// Chooses for each shading point by `u` in [0, 1).
    #[inline]
    pub fn choose<R: Real>(&self, p: Vec3<R>, u: R) -> Choice<R> {
        let least = self.least(p);
        let mut reservoir = Reservoir::<R>::default();
        let mut u = u;
        for (index, light) in self.lights.iter().enumerate() {
            u = reservoir.push(R::Uint::splat(index as u32), Self::weight(light, least, p), u);
        }
        Choice { index: reservoir.held, pmf: reservoir.pmf(), u }
    }
    /// Probability with which `choose` returns the light from `p`; 0 for an index past the last light.
    #[inline]
    pub fn pmf<R: Real>(&self, p: Vec3<R>, index: R::Uint) -> R {
        let least = self.least(p);
        let mut reservoir = Reservoir::<R>::default();
        let mut own = R::lit(0.0);
        for (i, light) in self.lights.iter().enumerate() {
            let weight = Self::weight(light, least, p);
            // only the sum matters
            reservoir.push(R::Uint::splat(0), weight, R::lit(0.0));
            let here = R::from_fn(|lane| R::Scalar::lit(f64::from(u8::from(index.lane(lane) == i as u32))));
            own += weight * here;
        }
        let some = reservoir.sum.gt(R::lit(0.0));
        own / R::blend(some, reservoir.sum, R::lit(1.0))
    }
}
