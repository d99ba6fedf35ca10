//! Logarithmic axes.

use super::text::short;
use crate::chart::stats::Estimate;

/// A logarithmic scale of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// With ticks at powers of ten.
    Log,
    /// With ticks at powers of two.
    Binary,
}

/// A value with its interval.
#[derive(Clone, Copy, Debug)]
pub struct Bar {
    /// The value.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
}

impl Bar {
    /// A value without an interval.
    #[must_use]
    pub const fn exact(value: f64) -> Self {
        Self { value, low: value, high: value }
    }
}

impl From<Estimate> for Bar {
    fn from(e: Estimate) -> Self {
        Self { value: e.value, low: e.low(), high: e.high() }
    }
}

/// Formats a power of ten with a superscript exponent.
fn power_of_ten(exponent: i32) -> String {
    let digit = |c: char| match c {
        '-' => '⁻',
        c => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][c as usize & 15],
    };
    match exponent {
        0 => "1".to_owned(),
        1 => "10".to_owned(),
        _ => format!("10{}", exponent.to_string().chars().map(digit).collect::<String>()),
    }
}

/// An axis with any scale.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    pub(super) scale: Scale,
    pub(super) low: f64,
    pub(super) high: f64,
    pub(super) bold: Vec<f64>,
    pub(super) light: Vec<f64>,
}

impl Axis {
    /// An axis that contains all values, with a margin.
    pub(super) fn new(scale: Scale, values: impl Iterator<Item = f64>) -> Self {
        let usable = |x: &f64| x.is_finite() && *x > 0.0;
        let (low, high) =
            values.filter(usable).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        let (low, high) = if low > high { (0.5, 2.0) } else { (low, high) };
        let margin = (high / low).powf(0.04).max(1.3);
        let (low, high) = (low / margin, high * margin);
        let base: f64 = if scale == Scale::Log { 10.0 } else { 2.0 };
        let (first, last) = (low.log(base).ceil() as i32, high.log(base).floor() as i32);
        let every = ((last - first) / 7 + 1).max(1) as usize;
        let mut bold: Vec<f64> = (first..=last).step_by(every).map(|e| base.powi(e)).collect();
        let mut light: Vec<f64> = (first..=last).map(|e| base.powi(e)).collect();
        if scale == Scale::Log && last - first < 9 {
            let steps = (first - 1..=last).flat_map(|e| (2..10).map(move |k| f64::from(k) * 10_f64.powi(e)));
            light.extend(steps.filter(|x| (low..=high).contains(x)));
        }
        if scale == Scale::Log && bold.len() < 2 {
            // fewer than two powers of ten in view: also ticks at 2 and 5 times each
            let more = (first - 1..=last).flat_map(|e| [2.0, 5.0].map(|k| k * 10_f64.powi(e)));
            bold.extend(more.filter(|x| (low..=high).contains(x)));
            bold.sort_by(f64::total_cmp);
        }
        Self { scale, low, high, bold, light }
    }
    pub(super) fn label(&self, x: f64) -> String {
        let exponent = x.log10().round();
        let whole = (x.log10() - exponent).abs() < 1e-9;
        match self.scale {
            Scale::Log if whole && !(-2.5..3.5).contains(&exponent) => power_of_ten(exponent as i32),
            _ => short(x),
        }
    }
    /// Where a value is between two places; beyond the axis, as an interval that includes 0, it is at its edge.
    pub(super) fn place(&self, x: f64, [from, to]: [f64; 2]) -> f64 {
        let inside = if x.is_nan() { self.low } else { x.clamp(self.low, self.high) };
        from + (to - from) * (inside / self.low).ln() / (self.high / self.low).ln()
    }
}
