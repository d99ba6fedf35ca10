//! Disks.

use crate::domain::Random;
use crate::double_double::{Dd, dot as dd_dot};
use crate::laws::{Subject, lanes_of, vectors_of};
use crate::oracle::{V3, along, basis, cross, dot, exact_sum, gauss_legendre, length, sub, unit, wide};
use crate::tolerances::{self, Tolerance};
use core::f64::consts::{FRAC_PI_2, TAU};
use core::fmt::{self, Debug, Formatter};
use etendue::seen::{Sighting, SphericalDisk};
use etendue::{Real, Vec2, Vec3};

/// `seen::SphericalDisk`.
#[derive(Clone, Copy)]
pub struct Disk {
    center: [f32; 3],
    normal: [f32; 3],
    radius: f32,
    /// Perpendicular, and across; towards the plane; and the height over it.
    axes: [V3; 3],
    height: f64,
    /// Sines of the half-angles, and cosines.
    sines: [f64; 2],
    cosines: [f64; 2],
    solid_angle: f64,
}
impl Debug for Disk {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "Disk::new({:?}, {:?}, {:?})", self.center, self.normal, self.radius)
    }
}
impl Disk {
    /// Centre, relative to the viewpoint, normal and radius.
    #[must_use]
    pub fn new(center: [f32; 3], normal: [f32; 3], radius: f32) -> Self {
        let (c, n, r) = (wide(center), wide(normal), f64::from(radius));
        let [exact_c, exact_n] = [c, n].map(|v| exact_sum(v, &[]));
        let signed = (dd_dot(exact_c, exact_n) / dd_dot(exact_n, exact_n).sqrt()).to_f64();
        let (z, n) = (signed.abs(), unit(n).map(|x| x.copysign(x * signed)));
        let power = (dd_dot(exact_c, exact_c) - Dd::from(r) * Dd::from(r)).to_f64();
        // the rays to the nearest and the farthest point of the rim, 2α apart
        let alpha = 0.5 * (2.0 * r * z).atan2(power);
        let h = power.hypot(2.0 * r * z);
        let beta = r.atan2(h.sqrt() * alpha.cos());
        let (sines, cosines) = ([alpha.sin(), beta.sin()], [alpha.cos(), beta.cos()]);
        let (s, t) = basis(n);
        let mut this = Self { center, normal, radius, axes: [s, t, n], height: z, sines, cosines, solid_angle: 0.0 };
        // slices across the major axis, each an arc about it
        let (mut last, nodes) = (FRAC_PI_2, gauss_legendre::<16>());
        for panel in 0..60 {
            let next = if panel == 59 { 0.0 } else { last * 0.6 };
            for (x, weight) in nodes {
                let angle = next + (last - next) * x;
                let d = (cosines[1] * angle.cos()).hypot(cosines[0] * angle.sin());
                let arc = (sines[0] * angle.sin()).atan2(d);
                this.solid_angle += 4.0 * weight * (last - next) * arc * sines[1] * angle.sin();
            }
            last = next;
        }
        this
    }
    fn point(&self, s: f64, t: f64) -> V3 {
        let ([a, b, _], r) = (self.axes, f64::from(self.radius) * s);
        along(along(wide(self.center), a, r * (TAU * t).cos()), b, r * (TAU * t).sin())
    }
}
impl Subject for Disk {
    type Warp<R: Real> = SphericalDisk<R>;
    type Point<R: Real> = Vec3<R>;
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
        let of = |i: usize| lanes[i % lanes.len()];
        SphericalDisk::new(
            vectors_of(|i| of(i).center),
            vectors_of(|i| of(i).normal),
            lanes_of(|i| f64::from(of(i).radius)),
        )
    }
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
        SphericalDisk::splat(warp)
    }
    fn tolerance(&self) -> Tolerance {
        tolerances::SPHERICAL_DISK
    }
    fn scaled(&self, factor: f32) -> Self {
        Self { center: self.center.map(|x| x * factor), radius: self.radius * factor, ..*self }
    }
    fn density(&self, _: V3) -> f64 {
        1.0 / self.solid_angle
    }
    fn chart(&self, s: f64, t: f64) -> (V3, f64) {
        let (point, r) = (self.point(s, t), f64::from(self.radius));
        let d = length(point);
        (point.map(|x| x / d), r * s * r * TAU * self.height / (d * d * d))
    }
    fn locate(&self, w: V3) -> [f64; 2] {
        let [a, b, n] = self.axes;
        let inner = sub(w.map(|x| x * self.height / dot(w, n)), wide(self.center));
        let (x, y) = (dot(inner, a), dot(inner, b));
        [(x.hypot(y) / f64::from(self.radius)).min(1.0), (y.atan2(x) / TAU).rem_euclid(1.0)]
    }
    fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
        let t = random.unit_f64();
        let point = self.point(1.0, t);
        let outwards = sub(point, wide(self.center));
        // from the cone's side, at right angles
        let n = unit(cross(point, cross(self.axes[2], outwards)));
        let sign = if dot(n, outwards) < 0.0 { -1.0 } else { 1.0 };
        // at the ends of the major axis a direction is put back across before it is judged
        Some(unit(along(unit(point), n, sign * 1.25 * margin)))
    }
    fn extent(&self) -> [f64; 2] {
        [2.0 * self.sines[1], 2.0 * self.sines[0]]
    }
    fn reach(&self) -> f64 {
        length(wide(self.center)) + f64::from(self.radius)
    }
    fn slant(&self, w: V3) -> f64 {
        1.0 / dot(w, self.axes[2]).abs()
    }
    /// Near the middle of a thin disk its rounding counts by the square.
    fn inverse_units(&self, _: [f64; 2]) -> f64 {
        2.0 + (3.0 * tolerances::ULP / self.sines[0]).powi(2) / tolerances::ULP
    }
    const PERIODIC: bool = true;
    /// Near the rim the major axis is a kink.
    fn smooth(&self, u: [f64; 2]) -> bool {
        self.cosines[1] > 0.1 * self.cosines[0] || (u[0] * 2.0 - (u[0] * 2.0).round()).abs() > 0.1
    }
    fn sight<R: Real>(warp: &Self::Warp<R>, u: Vec2<R>) -> Option<Sighting<R>> {
        Some(warp.sight(u))
    }
}
