//! Choice of lights by what they can contribute to a point.

use super::{Choice, FEW, Gloss, LightBound, LightChoice, LightsError};
use crate::real::{Real, Uint, unit_interval};
use crate::vector::Vec3;

/// Chooses lights in proportion to what they can contribute to a point of a surface, for up to [`MOST`](Self::MOST) lights.
///
/// - Formula: weight = power · cosθ · cosθ' / d², where d is the distance to the light's centre, or its radius if that is more. cosθ, at
///   the surface, belongs to the direction within the bounding sphere that is nearest to the normal, so that no light that reaches over
///   the horizon is left out. cosθ' is the cosine at the centre of a flat light, and ¼ for a light that emits in all directions, whose
///   area is four times its cross section.
/// - Domain: finite bounds, points and unit normals; powers from 1e−20 to 1e20, in any unit; NaN, negative and infinite ones count as 0.
///   Multiplying all lengths by a power of two changes no bit.
/// - Bounds: a light that can contribute counts as at least 2⁻¹⁸ of the sum, so that some u on the grid of 2⁻²⁴ finds it. The weight is 0
///   only where the bounding sphere is below the horizon or the light faces away, as far as rounding can tell; lengths below 2⁻⁵⁰ of the
///   extent of the lights do not count, nor do subnormal ones.
/// - Degenerate: where no light can contribute, the pmf is 0.
/// - Precision: a light's frequency is within 2⁻²² of its probability.
/// - Source: after Shirley, Wang and Zimmerman, "Monte Carlo Techniques for Direct Lighting Calculations", ACM TOG 15(1), 1996, 3.1.
///
/// ```
/// use etendue::select::{LightBound, LightChoice, SpatialLights};
/// let lamp = |z, power| LightBound { center: [0.0, 0.0, z], radius: 0.1, power, ..LightBound::default() };
/// let lights = SpatialLights::new(&[lamp(1.0, 1.0), lamp(2.0, 4.0), lamp(-1.0, 1.0)])?;
/// let at = lights.at::<f32>([0.0, 0.0, 0.0].into(), [0.0, 0.0, 1.0].into());
/// assert_eq!([0, 1, 2].map(|light| at.pmf(light)), [0.5, 0.5, 0.0]);
/// # Ok::<(), etendue::select::LightsError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct SpatialLights {
    /// Lengths are scaled by `scale`, powers by a power of two.
    lights: [LightBound; FEW],
    count: usize,
    scale: f32,
}

/// Points farther away than this, relative to the extent of the lights, count as this far: the lights then differ by less than a rounding,
/// and no weight vanishes.
const FARTHEST: f64 = (1_u64 << 30) as f64;
/// The least radius relative to the extent of the lights, and the least power relative to the strongest.
const SMALL: f32 = 1.0 / (1_u64 << 50) as f32;
/// The variance of the points of a light along an axis, relative to its squared radius: between that of a ball and that of a square.
const VARIANCE: f64 = 1.0 / 6.0;
/// The greatest weight of a light on a glossy surface, so that the sum is finite.
const GREATEST: f64 = 1e35;
/// The least weight of a light that can contribute, if all weights are smaller.
const LEAST: f64 = 1.0 / (1_u128 << 100) as f64;

impl SpatialLights {
    /// The greatest number of lights.
    pub const MOST: usize = FEW;

    /// Prepares the lights.
    ///
    /// # Errors
    /// If there are more than [`MOST`](Self::MOST) lights.
    pub fn new(lights: &[LightBound]) -> Result<Self, LightsError> {
        if lights.len() > FEW {
            return Err(LightsError::TooMany);
        }
        let mut own = Self { lights: [LightBound::default(); FEW], count: lights.len(), scale: 1.0 };
        let (mut extent, mut strongest) = (0.0_f32, 0.0_f32);
        for light in lights {
            let [x, y, z] = light.center.map(Real::abs);
            extent = extent.greater(x.greater(y)).greater(z.greater(light.radius));
            if light.power < f32::INFINITY {
                strongest = strongest.greater(light.power);
            }
        }
        let [scale, brightness] = [extent, strongest].map(|x| if x > 0.0 { x.pow2_scale() } else { 1.0 });
        own.scale = scale;
        for (to, light) in own.lights.iter_mut().zip(lights) {
            let lit = light.power > 0.0 && light.power < f32::INFINITY;
            *to = LightBound {
                center: light.center.map(|x| x * scale),
                // a point at the centre of a light of no size still has it around it
                radius: (light.radius * scale).greater(SMALL),
                power: if lit { (light.power * brightness).greater(SMALL) } else { 0.0 },
                ..*light
            };
        }
        Ok(own)
    }
    /// Number of lights.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.count
    }
    /// Whether there is no light.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.count == 0
    }
    /// The choice for points `p` of surfaces with unit normals `n`, on the side of `n`.
    #[inline(always)]
    pub fn at<R: Real>(&self, p: Vec3<R>, n: Vec3<R>) -> LightsAt<R> {
        self.weigh(p, n, None)
    }
    /// The same for glossy surfaces, by what they reflect towards the viewer.
    #[inline]
    pub fn at_glossy<R: Real>(&self, p: Vec3<R>, n: Vec3<R>, gloss: &Gloss<R>) -> LightsAt<R> {
        self.weigh(p, n, Some(gloss))
    }
    #[inline(always)]
    fn weigh<R: Real>(&self, p: Vec3<R>, n: Vec3<R>, gloss: Option<&Gloss<R>>) -> LightsAt<R> {
        let lit = |x: f32| R::lit(f64::from(x));
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        // a point that is farther than this keeps its direction; at the origin, the quotient is infinite
        let p = p * (R::lit(FARTHEST) / p.max_abs()).lesser(lit(self.scale));
        let mut at = LightsAt { ends: [zero; FEW], count: self.count };
        let mut sum = zero;
        for (light, weight) in self.lights[..self.count].iter().zip(&mut at.ends) {
            let [x, y, z] = light.center.map(lit);
            let to = Vec3::new(x - p.x, y - p.y, z - p.z);
            let radius = lit(light.radius);
            let inverse = one / to.length_squared().greater(radius * radius).sqrt();
            let cos = ((to.dot(n) + radius) * inverse).greater(zero).lesser(one);
            let facing = if light.normal == [0.0; 3] {
                R::lit(0.25)
            } else {
                let [x, y, z] = light.normal.map(lit);
                let facing = -to.dot(Vec3::new(x, y, z)) * inverse;
                if light.two_sided { facing.abs() } else { facing.greater(zero) }
            };
            *weight = cos * facing * (lit(light.power) * inverse * inverse);
            if let Some(gloss) = gloss {
                let variance = radius * radius * R::lit(VARIANCE);
                let glossy = *weight * gloss.factor(to, Vec3::new(variance, variance, variance));
                // a light that can contribute does not vanish
                let glossy = glossy.clamped(R::lit(f64::from(f32::MIN_POSITIVE)), R::lit(GREATEST));
                *weight = glossy.keep(weight.gt(zero));
            }
            sum += *weight;
        }
        let least = (sum * R::lit(1.0 / 262_144.0)).greater(R::lit(LEAST));
        let mut sum = zero;
        for weight in &mut at.ends[..self.count] {
            sum += weight.greater(least).keep(weight.gt(zero));
            *weight = sum;
        }
        at
    }
}

/// The choice of [`SpatialLights`] at the shading point of each lane.
#[derive(Clone, Copy, Debug)]
pub struct LightsAt<R: Real> {
    /// Sums of the weights up to and including each light.
    ends: [R; FEW],
    count: usize,
}

impl<R: Real> LightsAt<R> {
    /// The choice by these weights, finite and at least 0, of at most [`SpatialLights::MOST`] lights or kinds of lights. Where all are 0, the pmf is 0.
    #[must_use]
    #[inline]
    pub fn by_weights(weights: &[R]) -> Self {
        let mut at = Self { ends: [R::lit(0.0); FEW], count: weights.len().min(FEW) };
        let mut sum = R::lit(0.0);
        for (end, weight) in at.ends.iter_mut().zip(weights) {
            sum += *weight;
            *end = sum;
        }
        at
    }
    /// The weight of each light, in a unit that is the same for all points.
    #[inline]
    pub fn weights(&self) -> impl Iterator<Item = R> {
        (0..self.count).map(|k| if k == 0 { self.ends[0] } else { self.ends[k] - self.ends[k - 1] })
    }
    /// The choice among some of the lights: those for which `keep` returns a mask, where it is true.
    #[must_use]
    #[inline]
    pub fn only(&self, keep: impl Fn(usize) -> R::Mask) -> Self {
        let mut only = *self;
        let mut sum = R::lit(0.0);
        for (k, weight) in self.weights().enumerate() {
            sum += weight.keep(keep(k));
            only.ends[k] = sum;
        }
        only
    }
    #[inline]
    fn sum(&self) -> R {
        if self.count == 0 { R::lit(0.0) } else { self.ends[self.count - 1] }
    }
}

impl<R: Real> LightChoice<R> for LightsAt<R> {
    #[inline(always)]
    fn choose(&self, u: R) -> Choice<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let sum = self.sum();
        let target = unit_interval(u) * sum;
        let (mut index, mut start, mut end) = (zero, zero, self.ends[0]);
        for k in 1..self.count {
            let passed = target.ge(self.ends[k - 1]);
            index += one.keep(passed);
            start = R::blend(passed, self.ends[k - 1], start);
            end = R::blend(passed, self.ends[k], end);
        }
        let width = end - start;
        let some = width.gt(zero);
        let pmf = (width / R::blend(some, sum, one)).keep(some);
        let left = (target - start) / R::blend(some, width, one);
        Choice { index: index.to_uint(), pmf, u: unit_interval(left) }
    }
    #[inline]
    fn pmf(&self, index: R::Uint) -> R {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let sum = self.sum();
        let weight = |lane: usize| {
            let k = index.lane(lane) as usize;
            if k >= self.count {
                return R::Scalar::lit(0.0);
            }
            let before = if k == 0 { R::Scalar::lit(0.0) } else { self.ends[k - 1].lane(lane) };
            self.ends[k].lane(lane) - before
        };
        R::from_fn(weight) / R::blend(sum.gt(zero), sum, one)
    }
    #[inline]
    fn pmf_of(&self, light: u32) -> R {
        let (zero, k) = (R::lit(0.0), light as usize);
        if k >= self.count {
            return zero;
        }
        let sum = self.sum();
        let before = if k == 0 { zero } else { self.ends[k - 1] };
        (self.ends[k] - before) / R::blend(sum.gt(zero), sum, R::lit(1.0))
    }
}
