//! Chooses which light to sample: an index, its probability, and what is left of the random number.
//!
//! | choice | pmf | cost | when |
//! |---|---|---|---|
//! | [`UniformLights`] | 1/n | least | few, similar lights |
//! | [`PiecewiseConstant1d`] | power/Σpower | a binary search per lane | lights of different power at similar distances |
//! | [`SpatialLights`] | power · cosθ cosθ'/d² at the centre, per shading point | one pass over all lights | 2 to 32 lights, near and far, with an area |
//! | [`LightTree`] | by the expected cosines and distances of sets of lights, per shading point | 0.1 µs a lane for 10³ lights, 0.2 for 10⁵ | more than 32 lights, of all kinds |
//!
//! With the feature `alloc`, the module `lights` chooses among lights of all kinds, suns and skies included, and samples them.
//!
//! `at_glossy` of [`SpatialLights`] and of [`LightTree`] chooses in view of a [`Gloss`]: of what a rough surface reflects towards the viewer.
//! Above a metal floor of roughness α = 0.1, seen at 60° from its normal, that divides the variance of a choice among 4,096 lamps by 15
//! (`cargo test -p etendue-tests gloss -- --nocapture`).
//!
//! [`SpatialLights`] and [`LightTree`] take a [`LightBound`] of each light, which the method `bound` of lights that have a place returns.
//!
//! All of them implement [`LightChoice`]. The estimator divides by the `pmf` of the choice times the pdf of the sample on the light. The
//! method [`pmf`](LightChoice::pmf) returns the same bits, for multiple importance sampling: a light that another technique hits has a
//! probability too. Every light that can contribute has a positive pmf.

mod gloss;
mod spatial;
mod tree;

pub use crate::light::bound::LightBound;
pub use gloss::Gloss;
pub use spatial::{LightsAt, SpatialLights};
#[doc(hidden)]
pub use tree::TreeChild;
pub use tree::{Join, LightTree, Node8, TreeAt};

use crate::discrete::PiecewiseConstant1d;
use crate::real::{Real, Uint, unit_interval};
use core::fmt::{self, Display, Formatter};

/// See [`SpatialLights::MOST`].
const FEW: usize = 32;

/// Why a choice of lights cannot be prepared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LightsError {
    /// There are more lights than the choice takes.
    TooMany,
    /// The memory is not that of so many lights.
    Length,
}
impl Display for LightsError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::TooMany => "there are more lights than the choice takes",
            Self::Length => "the memory is not that of so many lights",
        })
    }
}
impl core::error::Error for LightsError {}

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

/// Chooses one light in each lane.
pub trait LightChoice<R: Real> {
    /// Chooses by `u` in [0, 1).
    fn choose(&self, u: R) -> Choice<R>;
    /// Probability with which [`choose`](Self::choose) returns a light; 0 for an index past the last light.
    fn pmf(&self, index: R::Uint) -> R;
    /// [`pmf`](Self::pmf) of one light in every lane.
    #[inline]
    fn pmf_of(&self, light: u32) -> R {
        self.pmf(R::Uint::splat(light))
    }
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

impl<R: Real> LightChoice<R> for UniformLights {
    #[inline]
    fn choose(&self, u: R) -> Choice<R> {
        let place = u * R::lit(f64::from(self.count));
        let index = place.to_uint();
        let last = R::Uint::splat(self.count.saturating_sub(1));
        // the product may have been rounded up to the count: all ones are −1
        let index = index.wrapping_add(last.lt(index));
        Choice { index, pmf: self.pmf(index), u: unit_interval(place - R::from_uint(index)) }
    }
    #[inline]
    fn pmf(&self, index: R::Uint) -> R {
        R::from_fn(|i| R::Scalar::lit(if index.lane(i) < self.count { 1.0 / f64::from(self.count) } else { 0.0 }))
    }
}

/// Chooses lights in proportion to their power, which the table was built from.
impl<R: Real> LightChoice<R> for PiecewiseConstant1d<'_> {
    #[inline]
    fn choose(&self, u: R) -> Choice<R> {
        let cell = self.cell(u);
        Choice { index: cell.index, pmf: cell.pmf, u: cell.offset }
    }
    #[inline]
    fn pmf(&self, index: R::Uint) -> R {
        self.pmf(index)
    }
}
