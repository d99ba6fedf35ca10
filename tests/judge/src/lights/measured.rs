//! The list of figures, and a figure at a place with its limit.

use serde::{Deserialize, Serialize};

/// What is measured. Values are relative errors, unless said. The gravest come first: what is no answer, what makes an image wrong, what makes it
/// wrong together with other techniques, and what only some uses notice.
#[derive(Deserialize, Serialize, Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Figure {
    /// The sampler did not answer: it panicked, crashed or did not end.
    Answer,
    /// Number of answers that are no numbers, negative densities or no unit vectors.
    Nonsense,
    /// Part of the draws without a sample, where all of them are.
    Dark,
    /// Bias of the irradiance.
    Bias,
    /// Angle by which a direction is outside of the light, over the light's width.
    Outside,
    /// Error of a sample's pdf.
    Density,
    /// Bias of the irradiance with multiple importance sampling.
    MisBias,
    /// Difference between the pdf of a sample and that of its direction.
    TwoPdfs,
    /// ∫ pdf less the part of the draws that are samples.
    Integral,
    /// χ² of the samples over cells against their pdf: 1 less the p-value's logarithm over that of the least allowed one.
    Frequencies,
    /// Error of the mean place of the samples, over the light's width.
    Placement,
    /// Part of the directions outside of the light with a positive pdf.
    Stray,
    /// Error of the distance of the light.
    Hit,
    /// Angle between a sample and the sample of its inverse, over the light's size; or how far the inverse is beyond the unit square, if that
    /// is more.
    Inverse,
    /// Error of the area that the map gives to a part of the square.
    Jacobian,
}
impl Figure {
    /// What a finding says, before where it is.
    #[must_use]
    pub fn said(self, value: f64) -> String {
        let part = if value < 1e-3 { format!("{:.2} %", value * 100.0) } else { format!("{:.1} %", value * 100.0) };
        let part = if value > 10.0 { format!("a factor of {value:.0}") } else { part };
        match self {
            Self::Nonsense => format!("{value} answers are no numbers, negative, or no unit vectors"),
            Self::Dark => "no light is drawn although some is seen".into(),
            Self::Outside => format!("directions miss the light by up to {part} of its width"),
            Self::Density => format!("the pdf of samples is wrong by up to {part}"),
            Self::TwoPdfs => format!("the pdf of a sample and of its direction differ by up to {part}"),
            Self::Stray => "the pdf is not 0 outside of the light".into(),
            Self::Integral => format!("the pdf does not integrate to 1: it is off by {part}"),
            Self::Frequencies => "samples are not distributed as their pdf says".into(),
            Self::Placement => format!("samples are shifted by {part} of the light's width"),
            Self::Jacobian => format!("parts of the square map to areas that are wrong by {part}"),
            Self::Inverse => format!("the inverse is off by up to {part} of the light's size, or of the square"),
            Self::Hit => format!("the distance is wrong by up to {part}"),
            Self::Bias => format!("irradiance is biased by {part}"),
            Self::MisBias => format!("irradiance is biased by {part} under MIS"),
            Self::Answer => "the sampler does not answer".into(),
        }
    }
}

/// A figure at a place.
#[derive(Deserialize, Serialize, Clone, Debug)]
pub struct Measured {
    /// What was measured.
    pub figure: Figure,
    /// The value, for the worst sample where there is one.
    pub value: f64,
    /// What is allowed.
    pub limit: f64,
    /// The worst sample, in words; empty for means.
    pub at: String,
}
impl Measured {
    /// Nothing is off.
    #[must_use]
    pub fn right(figure: Figure, limit: f64) -> Self {
        Self { figure, value: 0.0, limit, at: String::new() }
    }
    /// The sampler did not answer, in these words.
    #[must_use]
    pub fn unanswered(how: &str) -> Self {
        Self { figure: Figure::Answer, value: 1.0, limit: 0.5, at: how.into() }
    }
    /// Takes a value that is worse, and what is said about it.
    pub(super) fn take(&mut self, value: f64, said: impl FnOnce() -> String) {
        if !(value <= self.value) {
            self.value = value;
            self.at = said();
        }
    }
    /// Takes a value with a limit of its own, which is worse in terms of that.
    pub(super) fn take_mean(&mut self, value: f64, limit: f64, said: impl FnOnce() -> String) {
        if !(value / limit <= self.value / self.limit) {
            (self.value, self.limit, self.at) = (value, limit, said());
        }
    }
    /// Whether it is more than is allowed.
    #[must_use]
    pub fn is_finding(&self) -> bool {
        !(self.value <= self.limit)
    }
}
