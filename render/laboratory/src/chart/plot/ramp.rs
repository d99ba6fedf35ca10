//! Colours of numbers.

/// The colour of a number: interpolated between stops, whose numbers ascend.
#[must_use]
pub fn ramp(stops: &[(f64, [u8; 3])], x: f64) -> [u8; 3] {
    let x = x.clamp(stops[0].0, stops[stops.len() - 1].0);
    let above = stops.iter().position(|s| s.0 > x).unwrap_or(stops.len() - 1).max(1);
    let ((a, from), (b, to)) = (stops[above - 1], stops[above]);
    let t = ((x - a) / (b - a)).clamp(0.0, 1.0);
    [0, 1, 2].map(|k| (f64::from(from[k]) + t * (f64::from(to[k]) - f64::from(from[k]))).round() as u8)
}
