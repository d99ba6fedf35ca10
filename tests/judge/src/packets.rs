//! Packets of numbers, points and vectors, lane by lane.

use etendue::{Real, Vec2, Vec3};
use etendue_oracle::V3;

/// Points of the plane or of space, one in each lane.
pub trait Coordinates<R: Real>: Copy {
    /// Lane `i`, exactly; z = 0 on the plane.
    fn at(self, i: usize) -> V3;
    /// A packet whose lane `i` is `points[i % points.len()]`, rounded.
    fn gather(points: &[V3]) -> Self;
    /// The same in space; z = 0 on the plane.
    fn in_space(self) -> Vec3<R>;
    /// The inverse of [`in_space`](Self::in_space).
    fn from_space(point: Vec3<R>) -> Self;
}
/// A packet whose lane `i` is `f(i)`, rounded.
pub fn lanes_of<R: Real>(f: impl Fn(usize) -> f64) -> R {
    R::from_fn(|i| R::Scalar::lit(f(i)))
}
/// Eight cases for sixteen lanes: the upper half has them in reverse, so that lanes eight apart differ.
#[must_use]
pub fn twice<T: Copy>(eight: &[T; 8]) -> [T; 16] {
    core::array::from_fn(|i| eight[if i < 8 { i } else { 15 - i }])
}
/// A packet of vectors whose lane `i` is `f(i)`.
pub fn vectors_of<R: Real>(f: impl Fn(usize) -> [f32; 3]) -> Vec3<R> {
    let axis = |k: usize| lanes_of(|i| f64::from(f(i)[k]));
    Vec3::new(axis(0), axis(1), axis(2))
}
/// A packet of points of the unit square whose lane `i` is `us[i % us.len()]`.
#[must_use]
pub fn squares_of<R: Real>(us: &[[f32; 2]]) -> Vec2<R> {
    Coordinates::gather(&us.iter().map(|u| [f64::from(u[0]), f64::from(u[1]), 0.0]).collect::<Vec<_>>())
}
impl<R: Real> Coordinates<R> for Vec2<R> {
    fn at(self, i: usize) -> V3 {
        [self.x.lane_f64(i), self.y.lane_f64(i), 0.0]
    }
    fn gather(p: &[V3]) -> Self {
        let axis = |k: usize| lanes_of(|i| p[i % p.len()][k]);
        Self::new(axis(0), axis(1))
    }
    fn in_space(self) -> Vec3<R> {
        Vec3::new(self.x, self.y, R::lit(0.0))
    }
    fn from_space(point: Vec3<R>) -> Self {
        Self::new(point.x, point.y)
    }
}
impl<R: Real> Coordinates<R> for Vec3<R> {
    fn at(self, i: usize) -> V3 {
        [self.x.lane_f64(i), self.y.lane_f64(i), self.z.lane_f64(i)]
    }
    fn gather(p: &[V3]) -> Self {
        let axis = |k: usize| lanes_of(|i| p[i % p.len()][k]);
        Self::new(axis(0), axis(1), axis(2))
    }
    fn in_space(self) -> Vec3<R> {
        self
    }
    fn from_space(point: Vec3<R>) -> Self {
        point
    }
}
