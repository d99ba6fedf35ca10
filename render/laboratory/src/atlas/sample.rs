//! Samples, and the list that receives them.

/// The result of a technique for one `u`.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Unit direction.
    pub direction: [f32; 3],
    /// The pdf evaluated for the direction, per steradian, or per radian for a segment.
    pub pdf: f32,
    /// The pdf by which an irradiance estimator divides the cosine; for a line, per sinγ ds/r² (γ from the line, s along it).
    pub weight: f32,
    /// Inverse of the direction, if the technique has one.
    pub inverse: Option<[f32; 2]>,
    /// Whether the sample was drawn by area.
    pub by_area: bool,
    /// Whether the sample is on the emitting side.
    pub emits: bool,
}
impl Sample {
    /// A sample by solid angle.
    #[must_use]
    pub fn new(direction: [f32; 3], pdf: f32, inverse: Option<[f32; 2]>) -> Self {
        Self { direction, pdf, weight: pdf, inverse, by_area: false, emits: true }
    }
    /// Whether all values are finite.
    #[must_use]
    pub fn finite(&self) -> bool {
        let inverse = self.inverse.unwrap_or_default();
        self.direction.iter().chain(&inverse).chain(&[self.pdf]).all(|x| x.is_finite())
    }
}

/// The samples to draw and the list that receives them.
#[derive(Debug)]
pub struct Draw<'a> {
    /// Points of the unit square.
    pub us: &'a [[f32; 2]],
    /// Whether to invert each sample, too.
    pub invert: bool,
    /// Receives the samples.
    pub out: &'a mut Vec<Sample>,
}
impl Draw<'_> {
    /// Draws one sample for each point.
    pub(super) fn each(&mut self, f: impl Fn([f32; 2], bool) -> Sample) {
        self.out.extend(self.us.iter().map(|&u| f(u, self.invert)));
    }
}
