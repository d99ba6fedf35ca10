//! Surfaces in space, by area.

use crate::domain::Random;
use crate::laws::{Subject, lanes_of, vectors_of};
use crate::oracle::{V3, along, basis, cross, dot, length, sub, unit, wide};
use crate::tolerances::{self, Tolerance};
use core::f64::consts::{PI, TAU};
use core::fmt::Debug;
use etendue::{Real, Vec3, warp};

fn turns(y: f64, x: f64) -> f64 {
    (y.atan2(x) / TAU).rem_euclid(1.0)
}

macro_rules! surface {
    ($name:ident { $($field:ident: $kind:ty),+ }) => {
        #[doc = concat!("`warp::", stringify!($name), "`.")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name {
            $(#[doc = concat!("`", stringify!($field), "`.")] pub $field: $kind,)+
        }
    };
}
surface!(DiskSurface { center: [f32; 3], normal: [f32; 3], radius: f32 });
surface!(CylinderSide { p: [f32; 3], axis: [f32; 3], radius: f32 });
surface!(SphereSurface { center: [f32; 3], radius: f32 });
surface!(PatchSurface { p: [f32; 3], u: [f32; 3], v: [f32; 3], w: [f32; 3] });

impl Subject for DiskSurface {
    type Warp<R: Real> = warp::DiskSurface<R>;
    type Point<R: Real> = Vec3<R>;
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
        let of = |i: usize| lanes[i % lanes.len()];
        warp::DiskSurface {
            center: vectors_of(|i| of(i).center),
            normal: vectors_of(|i| of(i).normal),
            radius: lanes_of(|i| of(i).radius.into()),
        }
    }
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
        warp::DiskSurface::splat(warp)
    }
    fn tolerance(&self) -> Tolerance {
        tolerances::SURFACE
    }
    fn density(&self, _: V3) -> f64 {
        1.0 / (PI * f64::from(self.radius).powi(2))
    }
    fn chart(&self, s: f64, t: f64) -> (V3, f64) {
        let ((a, b), r) = (basis(unit(wide(self.normal))), f64::from(self.radius));
        let offset = along(a.map(|x| x * r * s * (TAU * t).cos()), b, r * s * (TAU * t).sin());
        (along(wide(self.center), offset, 1.0), TAU * r * r * s)
    }
    fn locate(&self, point: V3) -> [f64; 2] {
        let ((a, b), offset) = (basis(unit(wide(self.normal))), sub(point, wide(self.center)));
        [(length(offset) / f64::from(self.radius)).min(1.0), turns(dot(offset, b), dot(offset, a))]
    }
    fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
        Some(self.chart(1.0 + 2.0 * margin * self.granularity() / f64::from(self.radius), random.unit_f64()).0)
    }
    fn extent(&self) -> [f64; 2] {
        [2.0 * f64::from(self.radius); 2]
    }
    fn radius(&self) -> f64 {
        length(wide(self.center)) + f64::from(self.radius).abs()
    }
    fn granularity(&self) -> f64 {
        length(wide(self.center)) + f64::from(self.radius)
    }
    fn distance(&self, a: V3, b: V3) -> f64 {
        length(sub(a, b))
    }
    fn smooth(&self, u: [f64; 2]) -> bool {
        let (a, b) = ((2.0 * u[0] - 1.0).abs(), (2.0 * u[1] - 1.0).abs());
        (a - b).abs() > 0.01 && a.max(b) > 0.1
    }
}

impl Subject for CylinderSide {
    type Warp<R: Real> = warp::CylinderSide<R>;
    type Point<R: Real> = Vec3<R>;
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
        let of = |i: usize| lanes[i % lanes.len()];
        warp::CylinderSide {
            p: vectors_of(|i| of(i).p),
            axis: vectors_of(|i| of(i).axis),
            radius: lanes_of(|i| of(i).radius.into()),
        }
    }
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
        warp::CylinderSide::splat(warp)
    }
    fn tolerance(&self) -> Tolerance {
        tolerances::SURFACE
    }
    fn density(&self, _: V3) -> f64 {
        1.0 / (TAU * f64::from(self.radius) * length(wide(self.axis)))
    }
    fn chart(&self, s: f64, t: f64) -> (V3, f64) {
        let axis = wide(self.axis);
        let ((a, b), r) = (basis(unit(axis)), f64::from(self.radius));
        let offset = along(a.map(|x| x * r * (TAU * t).cos()), b, r * (TAU * t).sin());
        (along(along(wide(self.p), axis, s), offset, 1.0), TAU * r * length(axis))
    }
    fn locate(&self, point: V3) -> [f64; 2] {
        let axis = wide(self.axis);
        let ((a, b), offset) = (basis(unit(axis)), sub(point, wide(self.p)));
        [(dot(offset, axis) / dot(axis, axis)).clamp(0.0, 1.0), turns(dot(offset, b), dot(offset, a))]
    }
    fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
        let beyond = 2.0 * margin * self.granularity() / length(wide(self.axis));
        Some(self.chart(if random.word().is_multiple_of(2) { -beyond } else { 1.0 + beyond }, random.unit_f64()).0)
    }
    fn extent(&self) -> [f64; 2] {
        let (a, b) = (length(wide(self.axis)), 2.0 * f64::from(self.radius));
        [a.max(b), a.min(b)]
    }
    fn radius(&self) -> f64 {
        length(wide(self.p)) + f64::from(self.radius).abs() + length(wide(self.axis))
    }
    fn granularity(&self) -> f64 {
        self.radius()
    }
    fn distance(&self, a: V3, b: V3) -> f64 {
        length(sub(a, b))
    }
    const PERIODIC: bool = true;
}

impl Subject for SphereSurface {
    type Warp<R: Real> = warp::SphereSurface<R>;
    type Point<R: Real> = Vec3<R>;
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
        let of = |i: usize| lanes[i % lanes.len()];
        warp::SphereSurface { center: vectors_of(|i| of(i).center), radius: lanes_of(|i| of(i).radius.into()) }
    }
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
        warp::SphereSurface::splat(warp)
    }
    fn tolerance(&self) -> Tolerance {
        tolerances::SURFACE
    }
    fn density(&self, _: V3) -> f64 {
        1.0 / (4.0 * PI * f64::from(self.radius).powi(2))
    }
    fn chart(&self, s: f64, t: f64) -> (V3, f64) {
        let (theta, r) = (PI * s, f64::from(self.radius));
        let w = [theta.sin() * (TAU * t).cos(), theta.sin() * (TAU * t).sin(), theta.cos()];
        (along(wide(self.center), w, r), 2.0 * PI * PI * theta.sin() * r * r)
    }
    fn locate(&self, point: V3) -> [f64; 2] {
        let w = sub(point, wide(self.center));
        [w[0].hypot(w[1]).atan2(w[2]) / PI, turns(w[1], w[0])]
    }
    fn extent(&self) -> [f64; 2] {
        [2.0 * f64::from(self.radius); 2]
    }
    fn radius(&self) -> f64 {
        length(wide(self.center)) + f64::from(self.radius).abs()
    }
    fn granularity(&self) -> f64 {
        self.radius()
    }
    fn distance(&self, a: V3, b: V3) -> f64 {
        length(sub(a, b))
    }
    const PERIODIC: bool = true;
}

impl PatchSurface {
    fn sides(&self, s: f64, t: f64) -> [V3; 2] {
        let [u, v, w] = [self.u, self.v, self.w].map(wide);
        let d = sub(sub(w, u), v);
        [along(u, d, t), along(v, d, s)]
    }
    fn area(&self, s: f64, t: f64) -> f64 {
        let [by_s, by_t] = self.sides(s, t);
        length(cross(by_s, by_t))
    }
    fn density_at(&self, s: f64, t: f64) -> f64 {
        let [a, b, c, d] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|[s, t]| self.area(s, t));
        let weight = (1.0 - t) * ((1.0 - s) * a + s * b) + t * ((1.0 - s) * c + s * d);
        weight / (0.25 * (a + b + c + d)) / self.area(s, t)
    }
}
impl Subject for PatchSurface {
    type Warp<R: Real> = warp::PatchSurface<R>;
    type Point<R: Real> = Vec3<R>;
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
        let of = |i: usize| lanes[i % lanes.len()];
        warp::PatchSurface {
            p: vectors_of(|i| of(i).p),
            u: vectors_of(|i| of(i).u),
            v: vectors_of(|i| of(i).v),
            w: vectors_of(|i| of(i).w),
        }
    }
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
        warp::PatchSurface::splat(warp)
    }
    fn tolerance(&self) -> Tolerance {
        tolerances::PATCH
    }
    fn density(&self, point: V3) -> f64 {
        let [s, t] = self.locate(point);
        self.density_at(s, t)
    }
    fn chart(&self, s: f64, t: f64) -> (V3, f64) {
        let [by_s, _] = self.sides(s, t);
        (along(along(wide(self.p), by_s, s), wide(self.v), t), self.area(s, t))
    }
    // Newton's method from the nearest of a grid
    fn locate(&self, point: V3) -> [f64; 2] {
        let off = |[s, t]: [f64; 2]| length(sub(point, self.chart(s, t).0));
        let grid = (0..9).map(|i| [f64::from(i % 3) / 2.0, f64::from(i / 3) / 2.0]);
        let mut st = grid.min_by(|a, b| off(*a).total_cmp(&off(*b))).unwrap_or([0.5; 2]);
        for _ in 0..8 {
            let ([by_s, by_t], left) = (self.sides(st[0], st[1]), sub(point, self.chart(st[0], st[1]).0));
            let n = cross(by_s, by_t);
            let square = dot(n, n);
            st[0] = (st[0] + dot(cross(left, by_t), n) / square).clamp(-0.1, 1.1);
            st[1] = (st[1] + dot(cross(by_s, left), n) / square).clamp(-0.1, 1.1);
        }
        st.map(|x| x.clamp(0.0, 1.0))
    }
    fn outside(&self, margin: f64, random: &mut Random) -> Option<V3> {
        // where the grid of the point's coordinates is a margin of the side's length
        let place = random.unit_f64();
        let beyond = |side: V3| 2.0 * margin * self.granularity() / length(side);
        let [near, far] = [self.sides(0.0, place)[0], self.sides(place, 1.0)[1]].map(beyond);
        Some(if random.word().is_multiple_of(2) { self.chart(-near, place).0 } else { self.chart(place, 1.0 + far).0 })
    }
    fn extent(&self) -> [f64; 2] {
        let lengths = [[0.0, 0.0], [1.0, 1.0]].map(|[s, t]| self.sides(s, t).map(length));
        let all = [lengths[0][0], lengths[0][1], lengths[1][0], lengths[1][1]];
        [all.iter().copied().fold(0.0, f64::max), all.iter().copied().fold(f64::MAX, f64::min)]
    }
    fn radius(&self) -> f64 {
        length(wide(self.p)) + [self.u, self.v, self.w].map(|e| length(wide(e))).into_iter().fold(0.0, f64::max)
    }
    fn granularity(&self) -> f64 {
        self.radius()
    }
    fn distance(&self, a: V3, b: V3) -> f64 {
        length(sub(a, b))
    }
    // the sides are sums of edges, rounded as the longest one is
    fn condition(&self) -> f64 {
        let [long, short] = self.extent();
        long / short
    }
    fn quadrature(&self) -> f64 {
        1e-8
    }
    // the density is that at the point: where it moves, so does that
    fn gradient(&self) -> f64 {
        let at = |s: f64, t: f64| self.density_at(s, t);
        let steps = (0..64).map(|i| [f64::from(i % 8) / 8.0, f64::from(i / 8) / 8.0]);
        let steepest = steps
            .map(|[s, t]| {
                let [by_s, by_t] = self.sides(s, t).map(length);
                ((at(s + 0.125, t) - at(s, t)).abs() / by_s).max((at(s, t + 0.125) - at(s, t)).abs() / by_t) * 8.0
            })
            .fold(0.0, f64::max);
        steepest * self.granularity()
    }
}
