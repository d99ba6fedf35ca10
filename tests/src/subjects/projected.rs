//! Shapes by projected solid angle.

use crate::domain::Random;
use crate::double_double::{Dd, dot as dd_dot};
use crate::laws::{Subject, lanes_of, vectors_of};
use crate::oracle::{self, V3, along, cross, dot, exact_sum, unit, wide};
use crate::tolerances::{self, Tolerance};
use core::f64::consts::{FRAC_PI_2, PI};
use core::fmt::{self, Debug, Formatter};
use etendue::seen::{self, Sighting};
use etendue::{Real, Vec2, Vec3};

/// `seen::ProjectedCap`.
#[derive(Clone, Copy)]
pub struct ProjectedCap {
    center: [f32; 3],
    radius: f32,
    normal: [f32; 3],
    truth: Truth,
}
#[derive(Clone, Copy, Debug)]
struct Truth {
    sigma: f64,
    /// Between normal and axis: the cosine, good to all digits of itself.
    cos_omega: f64,
    projected: f64,
    /// Axis, upwards, across; and the normal.
    axes: [V3; 4],
    inside: bool,
}
impl Debug for ProjectedCap {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "ProjectedCap::new({:?}, {:?}, {:?})", self.center, self.radius, self.normal)
    }
}
impl ProjectedCap {
    /// Centre, relative to the viewpoint, radius, and normal.
    #[must_use]
    pub fn new(center: [f32; 3], radius: f32, normal: [f32; 3]) -> Self {
        let (c, n) = (wide(center), wide(normal));
        let (_, sigma) = oracle::cap(c, f64::from(radius));
        let inside = sigma > 3.0;
        let [exact_c, exact_n] = [c, n].map(|v| exact_sum(v, &[]));
        let length = |v: [Dd; 3]| dd_dot(v, v).sqrt();
        let cos = (dd_dot(exact_c, exact_n) / (length(exact_c) * length(exact_n))).to_f64();
        let n = unit(n);
        let across = cross(n, unit(c));
        let across = if oracle::length(across) > 1e-12 { unit(across) } else { oracle::basis(n).1 };
        let (sigma, cos, axis) = if inside { (FRAC_PI_2, 1.0, n) } else { (sigma, cos, unit(c)) };
        let truth = Truth {
            sigma,
            cos_omega: cos,
            projected: oracle::projected_cap_by_rings(sigma, cos),
            axes: [axis, unit(cross(axis, across)), across, n],
            inside,
        };
        Self { center, radius, normal, truth }
    }
    /// Projected solid angle, for comparison.
    #[must_use]
    pub fn projected_solid_angle(&self) -> f64 {
        self.truth.projected
    }
    fn sin_omega(&self) -> f64 {
        let cos = self.truth.cos_omega;
        ((1.0 - cos) * (1.0 + cos)).max(0.0).sqrt()
    }
    /// Least ring about the axis that is above the horizon, and what part of a ring is.
    fn first(&self) -> f64 {
        (-self.truth.cos_omega).max(0.0).asin()
    }
    fn half_ring(&self, theta: f64) -> f64 {
        let horizon = self.truth.cos_omega.abs().asin();
        let (cos, a) = (self.truth.cos_omega, self.truth.cos_omega * theta.cos());
        if theta <= horizon {
            return if cos > 0.0 { PI } else { 0.0 };
        }
        ((theta - horizon).sin() * (theta + horizon).sin()).max(0.0).sqrt().atan2(-a)
    }
    fn at(&self, theta: f64, phi: f64) -> V3 {
        let [axis, up, across, _] = self.truth.axes;
        along(along(axis.map(|x| x * theta.cos()), up, theta.sin() * phi.cos()), across, theta.sin() * phi.sin())
    }
    fn cut(&self) -> bool {
        self.truth.cos_omega < self.truth.sigma.sin()
    }
}
impl Subject for ProjectedCap {
    type Warp<R: Real> = seen::ProjectedCap<R>;
    type Point<R: Real> = Vec3<R>;
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
        let of = |i: usize| lanes[i % lanes.len()];
        seen::ProjectedCap::new(
            vectors_of(|i| of(i).center),
            lanes_of(|i| f64::from(of(i).radius)),
            vectors_of(|i| of(i).normal),
        )
    }
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
        seen::ProjectedCap::splat(warp)
    }
    fn tolerance(&self) -> Tolerance {
        let all = tolerances::PROJECTED_CAP;
        let alike = if self.truth.cos_omega < 0.0 { self.sin_omega().powi(-2) } else { 1.0 };
        Tolerance { point: all.point * alike, round_trip: all.round_trip * alike, ..all }
    }
    fn scaled(&self, factor: f32) -> Self {
        Self { center: self.center.map(|x| x * factor), radius: self.radius * factor, ..*self }
    }
    fn density(&self, w: V3) -> f64 {
        dot(w, self.truth.axes[3]).max(0.0) / self.truth.projected
    }
    fn chart(&self, s: f64, t: f64) -> (V3, f64) {
        let (first, last) = (self.first(), self.truth.sigma);
        let theta = first + s * (last - first);
        let half = self.half_ring(theta);
        (self.at(theta, half * (2.0 * t - 1.0)), theta.sin() * (last - first) * 2.0 * half)
    }
    fn locate(&self, w: V3) -> [f64; 2] {
        let [x, y, z] = [1, 2, 0].map(|i| dot(w, self.truth.axes[i]));
        let theta = x.hypot(y).atan2(z);
        let half = self.half_ring(theta).max(1e-300);
        let s = (theta - self.first()) / (self.truth.sigma - self.first());
        [s.clamp(0.0, 1.0), (0.5 + 0.5 * y.atan2(x) / half).clamp(0.0, 1.0)]
    }
    fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
        if self.truth.inside || self.cut() && random.word().is_multiple_of(2) {
            // straight down from the horizon
            let n = self.truth.axes[3];
            let theta = self.truth.sigma;
            let w = self.at(theta, self.half_ring(theta) * random.range(-1.0, 1.0));
            let flat = unit(along(w, n, -dot(w, n)));
            return Some(unit(along(flat, n, -margin)));
        }
        let theta = self.truth.sigma + margin;
        Some(self.at(theta, self.half_ring(theta) * random.range(-1.0, 1.0)))
    }
    fn extent(&self) -> [f64; 2] {
        [2.0 * self.truth.sigma.sin(), self.truth.sigma - self.first()]
    }
    /// Of a thin lune: the distance from the tangent plane to the horizon is known to a unit of the radius.
    fn condition(&self) -> f64 {
        let (s, c) = (self.truth.sigma.sin(), self.truth.cos_omega);
        if c < 0.0 { 1.0 + 3.0 * c.abs() / (s + c) } else { 1.0 }
    }
    fn gradient(&self) -> f64 {
        1.0 / self.truth.projected
    }
    fn quadrature(&self) -> f64 {
        if self.cut() { 1e-7 } else { 1e-9 }
    }
    fn smooth(&self, u: [f64; 2]) -> bool {
        let (s, c, sin) = (self.truth.sigma.sin(), self.truth.cos_omega, self.sin_omega());
        if c >= s {
            let (a, b) = ((2.0 * u[0] - 1.0).abs(), (2.0 * u[1] - 1.0).abs());
            return (a - b).abs() > 0.01 && a.max(b) > 0.1;
        }
        if c < 0.0 {
            return (u[0] - 0.5).abs() > 0.01;
        }
        // where the slices pass from the circle to the ellipse
        let theta = (((s - c) * (s + c)).sqrt() / sin).asin();
        (u[0] - (theta - theta.sin() * theta.cos()) / self.truth.projected).abs() > 0.01
    }
    fn sight<R: Real>(warp: &Self::Warp<R>, u: Vec2<R>) -> Option<Sighting<R>> {
        Some(warp.sight(u))
    }
}
