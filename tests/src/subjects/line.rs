//! Warps of the line, each beside a coordinate that passes through: so that the laws of the square hold for them too.

use crate::domain::Random;
use crate::laws::{Subject, lanes_of};
use crate::oracle::V3;
use crate::tolerances::{self, Tolerance};
use core::f64::consts::TAU;
use core::fmt::Debug;
use etendue::{Real, Vec2, Warp, Warp1, warp};

/// (`warp.sample(u.x)`, `u.y`).
#[derive(Clone, Copy, Debug)]
pub struct Strip<W>(pub W);
impl<R: Real, W: Warp1<R>> Warp<R> for Strip<W> {
    type Point = Vec2<R>;
    fn sample(&self, u: Vec2<R>) -> Vec2<R> {
        Vec2::new(self.0.sample(u.x), u.y)
    }
    fn pdf(&self, p: Vec2<R>) -> R {
        self.0.pdf(p.x)
    }
    fn invert(&self, p: Vec2<R>) -> Vec2<R> {
        Vec2::new(self.0.invert(p.x), p.y.clamp(R::lit(0.0), R::below_one()))
    }
}

/// What is known of a warp of the line.
trait Line: Copy + Debug {
    type Warp<R: Real>: Warp1<R>;
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R>;
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R>;
    fn tolerance(&self) -> Tolerance;
    fn scaled(&self, _factor: f32) -> Self {
        *self
    }
    fn density(&self, x: f64) -> f64;
    /// Where all but 1e−16 of it lies.
    fn range(&self) -> [f64; 2];
    /// Is the density 0 next to the range?
    fn bounded(&self) -> bool;
    /// Greatest magnitude of a sample.
    fn radius(&self) -> f64;
    /// Values to which a point is rounded: its size.
    fn size(&self) -> f64;
    /// Is it no further than the samples?
    fn reachable(&self, _x: f64) -> bool {
        true
    }
    fn smooth(&self, _u: f64) -> bool {
        true
    }
}

macro_rules! line {
    ($name:ident) => {
        impl Subject for $name {
            type Warp<R: Real> = Strip<warp::$name<R>>;
            type Point<R: Real> = Vec2<R>;
            fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
                Strip(Line::prepare(lanes))
            }
            fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
                Strip(<Self as Line>::splat(warp.0))
            }
            fn tolerance(&self) -> Tolerance {
                Line::tolerance(self)
            }
            fn density(&self, p: V3) -> f64 {
                Line::density(self, p[0])
            }
            fn chart(&self, s: f64, t: f64) -> (V3, f64) {
                let [low, high] = self.range();
                ([low + (high - low) * s, t, 0.0], high - low)
            }
            fn locate(&self, p: V3) -> [f64; 2] {
                let [low, high] = self.range();
                [((p[0] - low) / (high - low)).clamp(0.0, 1.0), p[1]]
            }
            fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
                let [low, high] = self.range();
                let beyond = margin * self.size();
                let below = random.word() % 2 == 0;
                self.bounded().then(|| [if below { low - beyond } else { high + beyond }, random.unit_f64(), 0.0])
            }
            fn extent(&self) -> [f64; 2] {
                let [low, high] = self.range();
                [(high - low).max(1.0), (high - low).min(1.0)]
            }
            fn radius(&self) -> f64 {
                Line::radius(self).hypot(1.0)
            }
            fn reachable(&self, p: V3) -> bool {
                Line::reachable(self, p[0])
            }
            fn scaled(&self, factor: f32) -> Self {
                Line::scaled(self, factor)
            }
            fn granularity(&self) -> f64 {
                self.size()
            }
            // along the line alone: the other coordinate is exact
            fn distance(&self, a: V3, b: V3) -> f64 {
                (a[0] - b[0]).abs()
            }
            fn smooth(&self, u: [f64; 2]) -> bool {
                Line::smooth(self, u[0])
            }
        }
    };
}

/// `warp::Linear`.
#[derive(Clone, Copy, Debug)]
pub struct Linear {
    /// Density at 0.
    pub a: f32,
    /// Density at 1.
    pub b: f32,
}
impl Line for Linear {
    type Warp<R: Real> = warp::Linear<R>;
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
        let of = |i: usize| lanes[i % lanes.len()];
        warp::Linear { a: lanes_of(|i| of(i).a.into()), b: lanes_of(|i| of(i).b.into()) }
    }
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
        warp::Linear::splat(warp)
    }
    fn tolerance(&self) -> Tolerance {
        tolerances::LINEAR
    }
    fn scaled(&self, factor: f32) -> Self {
        Self { a: self.a * factor, b: self.b * factor }
    }
    fn density(&self, x: f64) -> f64 {
        let (a, b) = (f64::from(self.a), f64::from(self.b));
        2.0 * (a * (1.0 - x) + b * x) / (a + b)
    }
    fn range(&self) -> [f64; 2] {
        [0.0, 1.0]
    }
    fn bounded(&self) -> bool {
        true
    }
    fn radius(&self) -> f64 {
        1.0
    }
    fn size(&self) -> f64 {
        1.0
    }
}
line!(Linear);

/// `warp::Tent`.
#[derive(Clone, Copy, Debug)]
pub struct Tent {
    /// Half-width.
    pub radius: f32,
}
impl Line for Tent {
    type Warp<R: Real> = warp::Tent<R>;
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
        warp::Tent { radius: lanes_of(|i| lanes[i % lanes.len()].radius.into()) }
    }
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
        warp::Tent::splat(warp)
    }
    fn tolerance(&self) -> Tolerance {
        tolerances::TENT
    }
    fn density(&self, x: f64) -> f64 {
        let r = f64::from(self.radius);
        (r - x.abs()).max(0.0) / (r * r)
    }
    fn range(&self) -> [f64; 2] {
        [-f64::from(self.radius), self.radius.into()]
    }
    fn bounded(&self) -> bool {
        true
    }
    fn radius(&self) -> f64 {
        self.radius.max(0.0).into()
    }
    fn size(&self) -> f64 {
        self.radius.into()
    }
    fn smooth(&self, u: f64) -> bool {
        (u - 0.5).abs() > 0.01
    }
}
line!(Tent);

/// `warp::Exponential`.
#[derive(Clone, Copy, Debug)]
pub struct Exponential {
    /// λ.
    pub rate: f32,
}
impl Line for Exponential {
    type Warp<R: Real> = warp::Exponential<R>;
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
        warp::Exponential { rate: lanes_of(|i| lanes[i % lanes.len()].rate.into()) }
    }
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
        warp::Exponential::splat(warp)
    }
    fn tolerance(&self) -> Tolerance {
        tolerances::EXPONENTIAL
    }
    fn density(&self, x: f64) -> f64 {
        let rate = f64::from(self.rate);
        rate * (-rate * x).exp()
    }
    fn range(&self) -> [f64; 2] {
        [0.0, 40.0 / f64::from(self.rate)]
    }
    fn bounded(&self) -> bool {
        false
    }
    fn radius(&self) -> f64 {
        16.7 / f64::from(self.rate).max(1e-37)
    }
    fn reachable(&self, x: f64) -> bool {
        f64::from(self.rate) * x < 16.6
    }
    fn size(&self) -> f64 {
        1.0 / f64::from(self.rate)
    }
}
line!(Exponential);

/// `warp::Normal`.
#[derive(Clone, Copy, Debug)]
pub struct Normal {
    /// μ.
    pub mean: f32,
    /// σ.
    pub sigma: f32,
}
impl Line for Normal {
    type Warp<R: Real> = warp::Normal<R>;
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
        let of = |i: usize| lanes[i % lanes.len()];
        warp::Normal { mean: lanes_of(|i| of(i).mean.into()), sigma: lanes_of(|i| of(i).sigma.into()) }
    }
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
        warp::Normal::splat(warp)
    }
    fn tolerance(&self) -> Tolerance {
        tolerances::NORMAL
    }
    fn density(&self, x: f64) -> f64 {
        let sigma = f64::from(self.sigma);
        let z = (x - f64::from(self.mean)) / sigma;
        (-0.5 * z * z).exp() / (sigma * TAU.sqrt())
    }
    fn range(&self) -> [f64; 2] {
        [-8.5, 8.5].map(|z| f64::from(self.mean) + f64::from(self.sigma) * z)
    }
    fn bounded(&self) -> bool {
        false
    }
    fn radius(&self) -> f64 {
        f64::from(self.mean.abs()) + 5.5 * f64::from(self.sigma.max(0.0))
    }
    fn reachable(&self, x: f64) -> bool {
        (x - f64::from(self.mean)).abs() < 5.29 * f64::from(self.sigma)
    }
    fn size(&self) -> f64 {
        f64::from(self.mean.abs()) + f64::from(self.sigma)
    }
}
line!(Normal);

/// `warp::Bilinear`.
#[derive(Clone, Copy, Debug)]
pub struct Bilinear {
    /// Densities at the corners.
    pub corners: [f32; 4],
}
impl Subject for Bilinear {
    type Warp<R: Real> = warp::Bilinear<R>;
    type Point<R: Real> = Vec2<R>;
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
        warp::Bilinear { corners: core::array::from_fn(|k| lanes_of(|i| lanes[i % lanes.len()].corners[k].into())) }
    }
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
        warp::Bilinear::splat(warp)
    }
    fn tolerance(&self) -> Tolerance {
        tolerances::BILINEAR
    }
    fn scaled(&self, factor: f32) -> Self {
        Self { corners: self.corners.map(|w| w * factor) }
    }
    fn density(&self, p: V3) -> f64 {
        let [a, b, c, d] = self.corners.map(f64::from);
        let ([x, y, _], [s, t]) = (p, [1.0 - p[0], 1.0 - p[1]]);
        4.0 * (a * s * t + b * x * t + c * s * y + d * x * y) / (a + b + c + d)
    }
    fn chart(&self, s: f64, t: f64) -> (V3, f64) {
        ([s, t, 0.0], 1.0)
    }
    fn locate(&self, p: V3) -> [f64; 2] {
        [p[0], p[1]]
    }
    fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
        let t = random.unit_f64();
        Some(match random.word() % 4 {
            0 => [-margin, t, 0.0],
            1 => [t, -margin, 0.0],
            2 => [1.0 + margin, t, 0.0],
            _ => [t, 1.0 + margin, 0.0],
        })
    }
    fn extent(&self) -> [f64; 2] {
        [1.0; 2]
    }
    fn radius(&self) -> f64 {
        core::f64::consts::SQRT_2
    }
}
