//! Directions about an axis: all of them up to an angle, or those that are above a horizon.

use crate::fixture::Truth;
use crate::random::Random;
use crate::tolerances::{self, Tolerance};
use core::f64::consts::{FRAC_PI_2, PI, TAU};
use etendue::LightSampler;
use etendue_oracle::double_double::{dd, dot as dd_dot, length as dd_length};
use etendue_oracle::{V3, along, basis, cap, cross, dot, length, projected_cap, unit, wide};

/// By what directions are distributed.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Density {
    Uniform,
    /// The cosine to the axis.
    Cosine,
    /// The cosine to a normal, whose angle to the axis has this cosine, accurate relative to its own size.
    AboveHorizon(f64),
}

/// Where a map of the square has two derivatives.
pub type Smooth = fn([f64; 2]) -> bool;

/// The concentric map has a kink where |a| = |b|, and all its derivatives grow towards the centre.
#[must_use]
pub fn off_the_diagonals(u: [f64; 2]) -> bool {
    let (a, b) = ((2.0 * u[0] - 1.0).abs(), (2.0 * u[1] - 1.0).abs());
    (a - b).abs() > 0.01 && a.max(b) > 0.1
}

/// Directions about an axis.
#[derive(Clone, Copy, Debug)]
pub struct Round {
    /// Axis, perpendicular to it upwards, perpendicular to both, and the normal.
    axes: [V3; 4],
    /// Half-angle, in radians.
    pub sigma: f64,
    density: Density,
    /// What the density is divided by: the solid angle, or the projected one, in steradians.
    pub measure: f64,
    /// What a margin is multiplied by, to be beyond the slack that a pdf allows.
    margin: f64,
    /// Whether it is the whole of a hemisphere, seen from inside of a sphere.
    is_inside: bool,
    tolerance: Tolerance,
    /// Error of the inverse besides the point's own rounding, in units of rounding and in steps of `u`.
    inverse: f64,
    is_periodic: bool,
    smooth: Smooth,
}

impl Round {
    fn new(axes: [V3; 4], sigma: f64, density: Density, measure: f64) -> Self {
        Self {
            axes,
            sigma,
            density,
            measure,
            margin: 1.0,
            is_inside: false,
            tolerance: tolerances::CONE,
            inverse: 2.0,
            is_periodic: true,
            smooth: |_| true,
        }
    }
    /// By another map.
    #[must_use]
    pub fn by(self, tolerance: Tolerance, is_periodic: bool, smooth: Smooth) -> Self {
        Self { tolerance, is_periodic, smooth, ..self }
    }
    /// Uniform about +z, up to an angle with 1 − cosσ = h.
    #[must_use]
    pub fn cone(sigma: f64, h: f64) -> Self {
        let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        // beyond a hemisphere the angle comes from z, whose rounding is multiplied by 1/sin
        let margin = if sigma > FRAC_PI_2 { 1.0 / sigma.sin() } else { 1.0 };
        Self { margin, ..Self::new([z, x, y, z], sigma, Density::Uniform, TAU * h) }
    }
    /// The upper hemisphere by its cosine.
    #[must_use]
    pub fn cosine() -> Self {
        Self { density: Density::Cosine, measure: PI, ..Self::cone(FRAC_PI_2, 1.0) }
    }
    /// A sphere by solid angle; beyond it there are the slack that the pdf allows, and the rounding of the frame.
    #[must_use]
    pub fn sphere(center: [f32; 3], radius: f32) -> Self {
        let (h, sigma) = cap(wide(center), f64::from(radius));
        let axis = unit(wide(center));
        let (s, t) = basis(axis);
        // from inside the sphere, u₀ is half of 1−cosθ
        let inverse = 3.0;
        let this = Self::new([axis, s, t, axis], sigma, Density::Uniform, TAU * h);
        Self { margin: 1.25, inverse, ..this }.by(tolerances::CAP, true, |_| true)
    }
    /// A sphere by projected solid angle.
    #[must_use]
    pub fn above(center: [f32; 3], radius: f32, normal: [f32; 3]) -> Self {
        let (c, n) = (wide(center), wide(normal));
        let (_, sigma) = cap(c, f64::from(radius));
        let is_inside = sigma > 3.0;
        let [exact_c, exact_n] = [c, n].map(dd);
        let cos = (dd_dot(exact_c, exact_n) / (dd_length(exact_c) * dd_length(exact_n))).to_f64();
        let measure = projected_cap(c, f64::from(radius), n);
        let across = cross(n, unit(c));
        let across = if length(across) > 1e-12 { unit(across) } else { basis(n).1 };
        let (sigma, cos, axis) = if is_inside { (FRAC_PI_2, 1.0, unit(n)) } else { (sigma, cos, unit(c)) };
        let axes = [axis, unit(cross(axis, across)), across, n];
        let this =
            Self { is_inside, is_periodic: false, ..Self::new(axes, sigma, Density::AboveHorizon(cos), measure) };
        let all = tolerances::PROJECTED_CAP;
        let alike = if cos < 0.0 { this.sin_omega().powi(-2) } else { 1.0 };
        let tolerance = Tolerance { point: all.point * alike, round_trip: all.round_trip * alike, ..all };
        Self { tolerance, ..this }
    }
    /// Cosine between the axis and the horizon's normal; 1 without a horizon.
    fn cos_omega(&self) -> f64 {
        if let Density::AboveHorizon(cos) = self.density { cos } else { 1.0 }
    }
    /// Sine of that angle.
    fn sin_omega(&self) -> f64 {
        let cos = self.cos_omega();
        ((1.0 - cos) * (1.0 + cos)).max(0.0).sqrt()
    }
    /// Angle from the axis of the first ring that reaches above the horizon.
    fn first(&self) -> f64 {
        (-self.cos_omega()).max(0.0).asin()
    }
    fn half_ring(&self, theta: f64) -> f64 {
        let Density::AboveHorizon(cos) = self.density else { return PI };
        let horizon = cos.abs().asin();
        if theta <= horizon {
            return if cos > 0.0 { PI } else { 0.0 };
        }
        ((theta - horizon).sin() * (theta + horizon).sin()).max(0.0).sqrt().atan2(-cos * theta.cos())
    }
    fn at(&self, theta: f64, phi: f64) -> V3 {
        let [axis, up, across, _] = self.axes;
        along(along(axis.map(|x| x * theta.cos()), up, theta.sin() * phi.cos()), across, theta.sin() * phi.sin())
    }
    fn is_cut(&self) -> bool {
        matches!(self.density, Density::AboveHorizon(cos) if cos < self.sigma.sin())
    }
}

impl Truth for Round {
    fn tolerance(&self) -> Tolerance {
        self.tolerance
    }
    fn inverse_units(&self, _: [f64; 2]) -> f64 {
        self.inverse
    }
    fn inverse_steps(&self) -> f64 {
        self.inverse
    }
    fn whole(&self) -> f64 {
        length(self.axes[3])
    }
    fn is_periodic(&self) -> bool {
        self.is_periodic
    }
    fn smooth(&self, _: &dyn LightSampler<f64>, u: [f64; 2]) -> bool {
        let Density::AboveHorizon(c) = self.density else { return (self.smooth)(u) };
        let (s, sin) = (self.sigma.sin(), self.sin_omega());
        if c >= s {
            return off_the_diagonals(u);
        }
        if c < 0.0 {
            return (u[0] - 0.5).abs() > 0.01;
        }
        // where the slices change from the circle to the ellipse
        let theta = (((s - c) * (s + c)).sqrt() / sin).asin();
        (u[0] - (theta - theta.sin() * theta.cos()) / self.measure).abs() > 0.01
    }
    fn pdf(&self, w: V3) -> f64 {
        if self.density == Density::Uniform { 1.0 / self.measure } else { dot(w, self.axes[3]).max(0.0) / self.measure }
    }
    fn chart(&self, s: f64, t: f64) -> (V3, f64) {
        let (first, last) = (self.first(), self.sigma);
        let theta = first + s * (last - first);
        let half = self.half_ring(theta);
        (self.at(theta, half * (2.0 * t - 1.0)), theta.sin() * (last - first) * 2.0 * half)
    }
    fn locate(&self, w: V3) -> [f64; 2] {
        let [x, y, z] = [1, 2, 0].map(|i| dot(w, self.axes[i]));
        let theta = x.hypot(y).atan2(z);
        let half = self.half_ring(theta).max(1e-300);
        let s = (theta - self.first()) / (self.sigma - self.first());
        [s.clamp(0.0, 1.0), (0.5 + 0.5 * y.atan2(x) / half).clamp(0.0, 1.0)]
    }
    fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
        if self.is_inside || self.is_cut() && random.word().is_multiple_of(2) {
            // a direction on the horizon, moved straight down
            let n = self.axes[3];
            let w = self.at(self.sigma, self.half_ring(self.sigma) * random.range(-1.0, 1.0));
            let flat = unit(along(w, n, -dot(w, n)));
            return Some(unit(along(flat, n, -margin)));
        }
        let theta = self.sigma + self.margin * margin;
        (theta < PI - 1e-2).then(|| self.at(theta, self.half_ring(theta) * random.range(-1.0, 1.0)))
    }
    fn extent(&self) -> [f64; 2] {
        if let Density::AboveHorizon(_) = self.density {
            return [2.0 * self.sigma.sin(), self.sigma - self.first()];
        }
        [(2.0 * self.sigma).min(2.0); 2]
    }
    /// Without a horizon, that of a cone about +z.
    fn granularity(&self) -> f64 {
        let is_upright = self.axes[0] == [0.0, 0.0, 1.0] && !matches!(self.density, Density::AboveHorizon(_));
        if is_upright { self.sigma.min(1.0) } else { 1.0 }
    }
    /// Condition of a thin lune: the distance from its tangent plane to the horizon is uncertain by a unit of the radius.
    fn condition(&self) -> f64 {
        let (s, c) = (self.sigma.sin(), self.cos_omega());
        if c < 0.0 { 1.0 + 3.0 * c.abs() / (s + c) } else { 1.0 }
    }
    fn gradient(&self) -> f64 {
        if let Density::AboveHorizon(_) = self.density { 1.0 / self.measure } else { 0.0 }
    }
    fn quadrature(&self) -> f64 {
        if self.is_cut() { 1e-7 } else { 1e-9 }
    }
}
