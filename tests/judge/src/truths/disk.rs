//! Disks.

use crate::fixture::Truth;
use crate::random::Random;
use crate::tolerances::{self, Tolerance};
use core::f64::consts::TAU;
use etendue::LightSampler;
use etendue_oracle::curves::Ellipse;
use etendue_oracle::double_double::{dd, dot as dd_dot};
use etendue_oracle::{V3, along, basis, cross, dot, length, sub, unit, wide};

/// A disk by solid angle.
#[derive(Clone, Debug)]
pub struct Disk {
    center: V3,
    radius: f64,
    /// Two axes in the disk's plane, and the direction towards the plane.
    axes: [V3; 3],
    height: f64,
    cone: Ellipse,
}
impl Disk {
    /// From the centre relative to the viewpoint, the normal and the radius.
    #[must_use]
    pub fn new(center: [f32; 3], normal: [f32; 3], radius: f32) -> Self {
        let (c, n, r) = (wide(center), wide(normal), f64::from(radius));
        let [exact_c, exact_n] = [c, n].map(dd);
        let signed = (dd_dot(exact_c, exact_n) / dd_dot(exact_n, exact_n).sqrt()).to_f64();
        let towards = unit(n).map(|x| x.copysign(x * signed));
        let (s, t) = basis(towards);
        let cone = Ellipse::new(c, n, r, |axis| basis(axis).0);
        Self { center: c, radius: r, axes: [s, t, towards], height: signed.abs(), cone }
    }
    fn point(&self, s: f64, t: f64) -> V3 {
        let ([a, b, _], r) = (self.axes, self.radius * s);
        along(along(self.center, a, r * (TAU * t).cos()), b, r * (TAU * t).sin())
    }
}
impl Truth for Disk {
    fn tolerance(&self) -> Tolerance {
        tolerances::SPHERICAL_DISK
    }
    /// Near the middle of a thin disk, rounding counts squared.
    fn inverse_units(&self, _: [f64; 2]) -> f64 {
        2.0 + (3.0 * tolerances::ULP / self.cone.sines[0]).powi(2) / tolerances::ULP
    }
    fn is_periodic(&self) -> bool {
        true
    }
    /// The map has a kink at the major axis of a disk seen from near its rim.
    fn smooth(&self, _: &dyn LightSampler<f64>, u: [f64; 2]) -> bool {
        let [alpha, beta] = self.cone.cosines;
        beta > 0.1 * alpha || (u[0] * 2.0 - (u[0] * 2.0).round()).abs() > 0.1
    }
    fn pdf(&self, _: V3) -> f64 {
        1.0 / self.cone.solid_angle()
    }
    fn chart(&self, s: f64, t: f64) -> (V3, f64) {
        let (point, r) = (self.point(s, t), self.radius);
        let d = length(point);
        (point.map(|x| x / d), r * s * r * TAU * self.height / (d * d * d))
    }
    fn locate(&self, w: V3) -> [f64; 2] {
        let [a, b, n] = self.axes;
        let inner = sub(w.map(|x| x * self.height / dot(w, n)), self.center);
        let (x, y) = (dot(inner, a), dot(inner, b));
        [(x.hypot(y) / self.radius).min(1.0), (y.atan2(x) / TAU).rem_euclid(1.0)]
    }
    fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
        let t = random.unit_f64();
        let point = self.point(1.0, t);
        let outwards = sub(point, self.center);
        // perpendicular to the side of the cone
        let n = unit(cross(point, cross(self.axes[2], outwards)));
        let sign = if dot(n, outwards) < 0.0 { -1.0 } else { 1.0 };
        // at the ends of the major axis, the pdf first moves a direction back across the disk
        Some(unit(along(unit(point), n, sign * 1.25 * margin)))
    }
    fn extent(&self) -> [f64; 2] {
        [2.0 * self.cone.sines[1], 2.0 * self.cone.sines[0]]
    }
    fn reach(&self) -> f64 {
        length(self.center) + self.radius
    }
    fn slant(&self, w: V3) -> f64 {
        1.0 / dot(w, self.axes[2]).abs()
    }
}
