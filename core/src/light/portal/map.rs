//! The directions in front of a portal as a map, and what may be wrong with a portal.

use crate::real::{GREATEST, Real};
use crate::vector::{Vec2, Vec3};
use core::f64::consts::PI;
use core::fmt::{self, Display, Formatter};

/// Why there is no such portal, or no sky through portals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PortalError {
    /// The edges are parallel, or not finite.
    Edges,
    /// The corner is not finite.
    Corner,
    /// There are no portals, or more than [`MOST`](super::PortalEnvironment::MOST).
    Count,
    /// There are not as many tables as portals.
    Tables,
}
impl Display for PortalError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Edges => "the edges are parallel or not finite",
            Self::Corner => "the corner is not finite",
            Self::Count => "there are no portals or more than 8",
            Self::Tables => "there are not as many tables as portals",
        })
    }
}
impl core::error::Error for PortalError {}

/// The directions in front of a portal, as a rectangle in which its edges are parallel to the axes from wherever they are seen.
///
/// A direction w = x s + y t + z n, by the unit edges s and t and the normal n = s × t/|s × t|, has the coordinates
/// (atan(x/z)/π + ½, atan(y/z)/π + ½) in [0, 1]². Parallel portals with parallel edges have the same map.
///
/// Source: Bitterli, Novák and Jarosz, "Portal-Masked Environment Map Sampling", EGSR 2015, for rectangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PortalMap {
    /// Unit edges and normal.
    pub(super) axes: [Vec3<f64>; 3],
    /// What x, y and z are inner products with.
    duals: [Vec3<f64>; 3],
    /// Sine of the angle between the edges.
    pub(super) sin: f64,
}

impl PortalMap {
    /// Prepares the map of portals with these edges, of any length. The sky is on the side that `s` × `t` points to.
    ///
    /// # Errors
    /// If the edges are parallel or not finite.
    #[inline]
    pub fn new(s: [f32; 3], t: [f32; 3]) -> Result<Self, PortalError> {
        let wide = |v: [f32; 3]| Vec3::<f64>::from(v.map(f64::from)).unit_and_length();
        let ((x, a), (y, b)) = (wide(s), wide(t));
        let (z, sin) = x.cross(y).unit_and_length();
        let is_some = a > 0.0 && b > 0.0 && sin > 0.0 && a.is_finite() && b.is_finite();
        let inverse = 1.0 / sin;
        let map = || Self { axes: [x, y, z], duals: [y.cross(z) * inverse, z.cross(x) * inverse, z], sin };
        is_some.then(map).ok_or(PortalError::Edges)
    }
    /// Returns the unit direction of a point of the map, and the solid angle per unit of the map's area there, in steradians.
    ///
    /// The domain is [0, 1]². Near the edges of the map the solid angle goes to 0.
    #[must_use]
    pub fn direction<R: Real>(&self, place: Vec2<R>) -> (Vec3<R>, R) {
        let half = R::lit(0.5);
        let angle = |x: R| ((x - half) * half).sin_cos_turns();
        let ((sx, cx), (sy, cy)) = (angle(place.x), angle(place.y));
        let w = self.world([sx * cy, sy * cx, cx * cy]);
        let (w, length) = w.unit_and_length();
        let some = length.gt(R::lit(0.0));
        let length = R::blend(some, length, R::lit(1.0));
        let scale = R::lit(PI * PI * self.sin);
        let solid_angle = (scale * (cx / length) * (cy / length) / length).keep(some);
        (w, solid_angle.clamped(R::lit(0.0), R::lit(GREATEST)))
    }
    #[inline(always)]
    pub(super) fn world<R: Real>(self, [x, y, z]: [R; 3]) -> Vec3<R> {
        let [s, t, n] = self.axes.map(|v| Vec3::lit([v.x, v.y, v.z]));
        s.mul_add(x, t.mul_add(y, n * z))
    }
    /// How far beside a portal a direction still passes it, in radians: what the direction itself is rounded by. Oblique axes stretch a
    /// small step by the inverse of the sine.
    #[inline(always)]
    pub(super) fn slack<R: Real>(&self) -> R {
        R::lit(if R::DOUBLE { 1e-15 } else { 3e-7 } / self.sin)
    }
    #[inline(always)]
    pub(super) fn local<R: Real>(self, v: Vec3<R>) -> [R; 3] {
        self.duals.map(|dual| v.dot(Vec3::lit([dual.x, dual.y, dual.z])))
    }
}
