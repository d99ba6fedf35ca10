//! Disks, hemispheres, cones and spheres.

use crate::domain::Random;
use crate::laws::{Coordinates, Subject, lanes_of, vectors_of};
use crate::oracle::{self, V3, along, basis, dot, length, unit, wide};
use crate::tolerances::{self, Tolerance};
use core::f64::consts::{FRAC_1_PI, FRAC_PI_2, PI, TAU};
use etendue::seen::{Sighting, SphereCap};
use etendue::{Real, Vec2, Vec3, warp};

/// Point and measure at polar angle θ and azimuth φ of a frame.
fn polar(axes: (V3, V3, V3), theta: f64, phi: f64) -> V3 {
    let (s, t, n) = axes;
    let (sin, cos) = theta.sin_cos();
    along(along(n.map(|x| x * cos), s, sin * phi.cos()), t, sin * phi.sin())
}
fn turns(y: f64, x: f64) -> f64 {
    (y.atan2(x) / TAU).rem_euclid(1.0)
}
const UPRIGHT: (V3, V3, V3) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);

macro_rules! disk {
    ($name:ident, $periodic:literal, $smooth:expr) => {
        #[doc = concat!("`warp::", stringify!($name), "`.")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;
        impl Subject for $name {
            type Warp<R: Real> = warp::$name;
            type Point<R: Real> = Vec2<R>;
            fn prepare<R: Real>(_: &[Self]) -> Self::Warp<R> {
                warp::$name
            }
            fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
                warp
            }
            fn tolerance(&self) -> Tolerance {
                tolerances::DISK
            }
            fn density(&self, _: V3) -> f64 {
                FRAC_1_PI
            }
            fn chart(&self, s: f64, t: f64) -> (V3, f64) {
                ([s * (TAU * t).cos(), s * (TAU * t).sin(), 0.0], TAU * s)
            }
            fn locate(&self, p: V3) -> [f64; 2] {
                [length(p).min(1.0), turns(p[1], p[0])]
            }
            fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
                let (s, c) = random.range(0.0, TAU).sin_cos();
                Some([c * (1.0 + margin), s * (1.0 + margin), 0.0])
            }
            fn extent(&self) -> [f64; 2] {
                [2.0; 2]
            }
            const PERIODIC: bool = $periodic;
            fn smooth(&self, u: [f64; 2]) -> bool {
                let smooth: fn([f64; 2]) -> bool = $smooth;
                smooth(u)
            }
        }
    };
}
/// The concentric map has a kink where |a| = |b|, and all its derivatives grow towards the centre.
fn off_the_diagonals(u: [f64; 2]) -> bool {
    let (a, b) = ((2.0 * u[0] - 1.0).abs(), (2.0 * u[1] - 1.0).abs());
    (a - b).abs() > 0.01 && a.max(b) > 0.1
}
disk!(ConcentricDisk, false, off_the_diagonals);
disk!(PolarDisk, true, |_| true);

/// `warp::CosineHemisphere`.
#[derive(Clone, Copy, Debug)]
pub struct CosineHemisphere;
impl Subject for CosineHemisphere {
    type Warp<R: Real> = warp::CosineHemisphere;
    type Point<R: Real> = Vec3<R>;
    fn prepare<R: Real>(_: &[Self]) -> Self::Warp<R> {
        warp::CosineHemisphere
    }
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
        warp
    }
    fn tolerance(&self) -> Tolerance {
        tolerances::COSINE
    }
    fn density(&self, w: V3) -> f64 {
        w[2].max(0.0) * FRAC_1_PI
    }
    fn chart(&self, s: f64, t: f64) -> (V3, f64) {
        let theta = s * FRAC_PI_2;
        (polar(UPRIGHT, theta, TAU * t), theta.sin() * FRAC_PI_2 * TAU)
    }
    fn locate(&self, w: V3) -> [f64; 2] {
        [w[0].hypot(w[1]).atan2(w[2]) / FRAC_PI_2, turns(w[1], w[0])]
    }
    fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
        Some(polar(UPRIGHT, FRAC_PI_2 + margin, random.range(0.0, TAU)))
    }
    fn extent(&self) -> [f64; 2] {
        [2.0; 2]
    }
    fn smooth(&self, u: [f64; 2]) -> bool {
        off_the_diagonals(u)
    }
}

macro_rules! whole {
    ($name:ident, $sigma:expr) => {
        #[doc = concat!("`warp::", stringify!($name), "`.")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;
        impl Subject for $name {
            type Warp<R: Real> = warp::$name;
            type Point<R: Real> = Vec3<R>;
            fn prepare<R: Real>(_: &[Self]) -> Self::Warp<R> {
                warp::$name
            }
            fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
                warp
            }
            fn tolerance(&self) -> Tolerance {
                tolerances::CONE
            }
            fn density(&self, _: V3) -> f64 {
                1.0 / (TAU * (1.0 - $sigma.cos()))
            }
            fn chart(&self, s: f64, t: f64) -> (V3, f64) {
                let theta = s * $sigma;
                (polar(UPRIGHT, theta, TAU * t), theta.sin() * $sigma * TAU)
            }
            fn locate(&self, w: V3) -> [f64; 2] {
                [w[0].hypot(w[1]).atan2(w[2]) / $sigma, turns(w[1], w[0])]
            }
            fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
                ($sigma + margin < PI).then(|| polar(UPRIGHT, $sigma + margin, random.range(0.0, TAU)))
            }
            fn extent(&self) -> [f64; 2] {
                [2.0; 2]
            }
            const PERIODIC: bool = true;
        }
    };
}
whole!(UniformHemisphere, FRAC_PI_2);
whole!(UniformSphere, PI);

/// `warp::Octahedral`.
#[derive(Clone, Copy, Debug)]
pub struct Octahedral;
impl Subject for Octahedral {
    type Warp<R: Real> = warp::Octahedral;
    type Point<R: Real> = Vec3<R>;
    fn prepare<R: Real>(_: &[Self]) -> Self::Warp<R> {
        warp::Octahedral
    }
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
        warp
    }
    fn tolerance(&self) -> Tolerance {
        tolerances::OCTAHEDRAL
    }
    fn density(&self, _: V3) -> f64 {
        0.25 * FRAC_1_PI
    }
    fn chart(&self, s: f64, t: f64) -> (V3, f64) {
        let theta = s * PI;
        (polar(UPRIGHT, theta, TAU * t), theta.sin() * PI * TAU)
    }
    fn locate(&self, w: V3) -> [f64; 2] {
        [w[0].hypot(w[1]).atan2(w[2]) / PI, turns(w[1], w[0])]
    }
    fn extent(&self) -> [f64; 2] {
        [2.0; 2]
    }
    /// Kinks above the axes and at the horizon; all derivatives grow towards the poles.
    fn smooth(&self, u: [f64; 2]) -> bool {
        let (a, b) = ((2.0 * u[0] - 1.0).abs(), (2.0 * u[1] - 1.0).abs());
        a.min(b) > 0.01 && (a + b - 1.0).abs() > 0.01 && (a + b).min(2.0 - a - b) > 0.1
    }
}

/// `warp::Cone`.
#[derive(Clone, Copy, Debug)]
pub struct Cone {
    /// h = 1 − cosσ.
    pub one_minus_cos: f32,
}
impl Cone {
    fn sigma(&self) -> f64 {
        2.0 * (f64::from(self.one_minus_cos) / 2.0).clamp(0.0, 1.0).sqrt().asin()
    }
}
impl Subject for Cone {
    type Warp<R: Real> = warp::Cone<R>;
    type Point<R: Real> = Vec3<R>;
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
        warp::Cone { one_minus_cos: lanes_of(|i| f64::from(lanes[i % lanes.len()].one_minus_cos)) }
    }
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
        warp::Cone::splat(warp)
    }
    fn tolerance(&self) -> Tolerance {
        tolerances::CONE
    }
    fn density(&self, _: V3) -> f64 {
        1.0 / (TAU * f64::from(self.one_minus_cos))
    }
    fn chart(&self, s: f64, t: f64) -> (V3, f64) {
        let sigma = self.sigma();
        (polar(UPRIGHT, s * sigma, TAU * t), (s * sigma).sin() * sigma * TAU)
    }
    fn locate(&self, w: V3) -> [f64; 2] {
        [w[0].hypot(w[1]).atan2(w[2]) / self.sigma(), turns(w[1], w[0])]
    }
    fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
        // the angle of a direction is known no better than 1/sin of it where z tells it, behind
        let theta = self.sigma() + if self.sigma() > FRAC_PI_2 { margin / self.sigma().sin() } else { margin };
        (theta < PI - 1e-2).then(|| polar(UPRIGHT, theta, random.range(0.0, TAU)))
    }
    fn extent(&self) -> [f64; 2] {
        [(2.0 * self.sigma()).min(2.0); 2]
    }
    fn granularity(&self) -> f64 {
        self.sigma().min(1.0)
    }
    const PERIODIC: bool = true;
}

/// `seen::SphereCap`.
#[derive(Clone, Copy, Debug)]
pub struct Cap {
    pub(crate) center: [f32; 3],
    pub(crate) radius: f32,
    /// 1 − cosσ and σ.
    truth: (f64, f64),
}
impl Cap {
    /// Centre, relative to the viewpoint, and radius.
    #[must_use]
    pub fn new(center: [f32; 3], radius: f32) -> Self {
        Self { center, radius, truth: oracle::cap(wide(center), f64::from(radius)) }
    }
    fn axes(&self) -> (V3, V3, V3) {
        let n = unit(wide(self.center));
        let (s, t) = basis(n);
        (s, t, n)
    }
}
impl Subject for Cap {
    type Warp<R: Real> = SphereCap<R>;
    type Point<R: Real> = Vec3<R>;
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
        let of = |i: usize| lanes[i % lanes.len()];
        SphereCap::new(vectors_of(|i| of(i).center), lanes_of(|i| f64::from(of(i).radius)))
    }
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
        SphereCap::splat(warp)
    }
    /// From inside u₀ is half of 1−cosθ.
    fn inverse_units(&self, _: [f64; 2]) -> f64 {
        3.0
    }
    fn inverse_steps(&self) -> f64 {
        3.0
    }
    fn tolerance(&self) -> Tolerance {
        tolerances::CAP
    }
    fn scaled(&self, factor: f32) -> Self {
        Self { center: self.center.map(|x| x * factor), radius: self.radius * factor, ..*self }
    }
    fn density(&self, _: V3) -> f64 {
        1.0 / (TAU * self.truth.0)
    }
    fn chart(&self, s: f64, t: f64) -> (V3, f64) {
        let sigma = self.truth.1;
        (polar(self.axes(), s * sigma, TAU * t), (s * sigma).sin() * sigma * TAU)
    }
    fn locate(&self, w: V3) -> [f64; 2] {
        let (s, t, n) = self.axes();
        let (x, y, z) = (dot(w, s), dot(w, t), dot(w, n));
        [x.hypot(y).atan2(z) / self.truth.1, turns(y, x)]
    }
    fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
        // besides its slack, what the frame has rounded
        let theta = self.truth.1 + 1.25 * margin;
        (theta < PI - 1e-2).then(|| polar(self.axes(), theta, random.range(0.0, TAU)))
    }
    fn extent(&self) -> [f64; 2] {
        [(2.0 * self.truth.1).min(2.0); 2]
    }
    fn granularity(&self) -> f64 {
        if self.center[0] == 0.0 && self.center[1] == 0.0 && self.center[2] > 0.0 { self.truth.1.min(1.0) } else { 1.0 }
    }
    const PERIODIC: bool = true;
    fn sight<R: Real>(warp: &Self::Warp<R>, u: Vec2<R>) -> Option<Sighting<R>> {
        Some(warp.sight(u))
    }
}

/// **Seen**: the point that `sight` reports lies on the sphere, and from outside on its near side: no farther than the tangent,
/// √(d²−R²). Both roots lie on the sphere; only this tells them apart.
pub fn nearest_hit(cap: &Cap, u: [f32; 2]) {
    let sighting = Cap::prepare::<f64>(&[*cap]).sight(Coordinates::gather(&[[f64::from(u[0]), f64::from(u[1]), 0.0]]));
    let (center, radius) = (wide(cap.center), f64::from(cap.radius));
    let d = length(center);
    let point = sighting.direction.at(0).map(|x| x * sighting.distance);
    let off = length(oracle::sub(point, center)) - radius;
    // a dozen roundings of coordinates as large as d + R
    let allowed = 12.0 * tolerances::ULP_F64 * (d + radius);
    assert!(off.abs() <= allowed, "off the sphere by {off:e}, allowed {allowed:e}: {cap:?} at {u:?}");
    if d > radius {
        let tangent = ((d - radius) * (d + radius)).sqrt();
        // next to the limb the two roots meet: they differ by the root of a rounding
        let allowed = tangent + 1e-7 * radius;
        assert!(sighting.distance <= allowed, "far side: {} beyond {tangent}: {cap:?} at {u:?}", sighting.distance);
    }
}
