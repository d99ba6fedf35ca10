//! Weights that combine techniques (multiple importance sampling).

use crate::light::LightSample;
use crate::real::Real;

/// Multiple importance sampling: weights by which the samples of several techniques share one integral.
///
/// Call [`light_weight`](Self::light_weight) for a sample of a light and [`bsdf_weight`](Self::bsdf_weight) for a ray that hits one, or
/// [`weights`](Self::weights) for any techniques. Where every pdf is 0, so is every weight.
///
/// - Formula: with dᵢ = nᵢpᵢ for technique i with nᵢ samples and the pdf pᵢ at the point, the weights are wᵢ = dᵢ^β/Σdⱼ^β; the
///   estimator is the sum of w·f/(n·p) over the techniques.
/// - Domain: dᵢ in [0, ∞]; a negative number or NaN counts as 0. All are divided by the largest before they are raised to the power, so
///   that none overflows, and a common factor changes nothing.
/// - Delta distributions: a technique that alone can sample the point (a point light, a mirror) has d = ∞, see
///   [`technique_pdf`](Self::technique_pdf); its weight is 1 and that of the others 0. Several such techniques share equally.
/// - Degenerate: if all dᵢ are 0, so are the weights.
/// - Greatest error: weights sum to 1 within 2⁻²³ for two techniques.
/// - Source: Veach 1997, *Robust Monte Carlo Methods for Light Transport Simulation*, 9.2.
///
/// | heuristic | when |
/// |---|---|
/// | [`Balance`](Heuristic::Balance) | never far from the best; the choice for sums over many similar techniques |
/// | [`POWER`](Heuristic::POWER) | where one technique is nearly perfect: a small light, a glossy surface |
/// | [`Power(β)`](Heuristic::Power) | between it and the maximum |
/// | [`Maximum`](Heuristic::Maximum) | discontinuous weights; for comparison |
///
/// ```
/// use etendue::estimate::Heuristic;
/// let [light, surface] = Heuristic::POWER.weights([3.0_f32, 1.0]);
/// assert!((light - 0.9).abs() < 1e-6 && (surface - 0.1).abs() < 1e-6);
/// // squares of these would overflow
/// assert_eq!(Heuristic::POWER.weights([3e30_f32, 3e30]), [0.5, 0.5]);
/// // a point light: a delta
/// assert_eq!(Heuristic::POWER.weights([Heuristic::technique_pdf(1.0_f32, 1.0, true), 7.0]), [1.0, 0.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Heuristic {
    /// β = 1.
    Balance,
    /// Any β; with 0, all techniques whose pdf is not 0 have the same weight.
    Power(u32),
    /// β → ∞: the technique with the largest d has weight 1, the first of several equal ones.
    Maximum,
}

impl Heuristic {
    /// The power heuristic with β = 2, Veach's choice.
    pub const POWER: Self = Self::Power(2);

    /// Returns what [`weights`](Self::weights) takes for a technique that draws this number of samples with this pdf: the product of both, but
    /// at most the largest number of single precision, or ∞ where `delta` holds.
    #[inline]
    pub fn technique_pdf<R: Real>(samples: R, pdf: R, delta: R::Mask) -> R {
        let product = (samples * pdf).clamped(R::lit(0.0), R::lit(f64::from(f32::MAX)));
        R::blend(delta, R::lit(f64::INFINITY), product)
    }
    /// The weight of each technique, given its d = n·p at the point.
    #[inline]
    pub fn weights<R: Real, const N: usize>(self, densities: [R; N]) -> [R; N] {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let densities = densities.map(|d| d.greater(zero));
        let largest = densities.into_iter().fold(zero, R::greater);
        let some = largest.gt(zero);
        let Self::Power(exponent) = (if self == Self::Balance { Self::Power(1) } else { self }) else {
            let mut free = some;
            return densities.map(|d| {
                let chosen = free & d.ge(largest);
                free = free & !chosen;
                one.keep(chosen)
            });
        };
        // ∞/∞ is 1 here, and 0/0 is 0
        let divisor = R::blend(some, largest, one);
        let shares = densities.map(|d| {
            let ratio = R::blend(d.ge(largest), one, d / divisor).keep(some & d.gt(zero));
            match exponent {
                0 => one.keep(ratio.gt(zero)),
                _ => (1..exponent).fold(ratio, |power, _| power * ratio),
            }
        });
        // at least 1 where there is any
        let sum = shares.into_iter().fold(zero, |sum, share| sum + share);
        shares.map(|share| share / R::blend(some, sum, one))
    }

    /// The weight of a light sample over its pdf, where the surface draws the same direction with pdf `bsdf_pdf`: the estimator of this
    /// technique is `f · L · cosθ · light_weight`. One sample of each technique; 0 where the sample is not
    /// [`valid`](LightSample::valid); 1/pdf for delta lights. Both pdfs per steradian.
    #[inline]
    pub fn light_weight<R: Real>(self, light: &LightSample<R>, bsdf_pdf: R) -> R {
        let one = R::lit(1.0);
        self.weights([Self::technique_pdf(one, light.pdf, light.delta), bsdf_pdf])[0] * light.weight()
    }
    /// The weight over its pdf of a direction that the surface drew with pdf `bsdf_pdf`, where it hits the light at `hit`: the estimator of
    /// this technique is `f · L · cosθ · bsdf_weight`. One sample of each technique; 0 where the light is missed or does not emit that
    /// way. A `bsdf_pdf` of ∞ (a mirror) has weight 1 and counts as 1.
    #[inline]
    pub fn bsdf_weight<R: Real>(self, bsdf_pdf: R, hit: &LightSample<R>) -> R {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let drawn = bsdf_pdf.gt(R::lit(1e-37)) & hit.emits & hit.pdf.gt(zero);
        let mirror = bsdf_pdf.ge(R::lit(f64::INFINITY));
        let divisor = R::blend(drawn & !mirror, bsdf_pdf, one);
        (self.weights([bsdf_pdf, hit.pdf])[0] / divisor).keep(drawn)
    }
}
