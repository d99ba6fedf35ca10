//! What a warp under test is, and what is known about it independently.

use crate::generators::Random;
use crate::packets::Coordinates;
use crate::tolerances::Tolerance;
use core::fmt::Debug;
use etendue::light::shapes::DirectionSample;
use etendue::{Real, Vec2, Warp};
use etendue_oracle::{V3, length, sub};

/// A warp with its parameters (held in f32, hence exact at every precision).
pub trait Fixture: Copy + Debug {
    /// The warp at each precision and width.
    type Warp<R: Real>: Warp<R, Point = Self::Point<R>>;
    /// The points that it samples.
    type Point<R: Real>: Coordinates<R>;
    /// What is known about its points and their density.
    type Truth: Truth;
    /// What is known about its points and their density.
    fn truth(&self) -> Self::Truth;
    /// The warp whose lane `i` is prepared from `lanes[i % lanes.len()]`.
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R>;
    /// The scalar warp in every lane.
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R>;
    /// Whether the two fit into one packet.
    fn kin(&self, _other: &Self) -> bool {
        true
    }
    /// The errors that are tolerated.
    fn tolerance(&self) -> Tolerance;
    /// All lengths multiplied by a power of two; the same if there are none.
    #[must_use]
    fn scaled(&self, _factor: f32) -> Self {
        *self
    }
    /// Error of the inverse besides the point's own rounding, in units of rounding.
    fn inverse_units(&self, _u: [f64; 2]) -> f64 {
        2.0
    }
    /// Error of the inverse besides the point's own rounding, in steps of `u`.
    fn inverse_steps(&self) -> f64 {
        2.0
    }
    /// Whether the map jumps within `step` of `u` in the first coordinate: rounding decides on which side of the jump a point falls.
    fn torn(&self, _u: [f64; 2], _step: f64) -> bool {
        false
    }
    /// Whether the second coordinate is an azimuth.
    const PERIODIC: bool = false;
    /// Whether the map has two derivatives near `u`.
    fn smooth(&self, _u: [f64; 2]) -> bool {
        true
    }
    /// Direction and distance, for shapes seen from a point.
    fn sample_direction<R: Real>(_warp: &Self::Warp<R>, _u: Vec2<R>) -> Option<DirectionSample<R>> {
        None
    }
}

/// What is known about points and their density, from the definition of a shape and not from the code of a warp.
pub trait Truth: Copy {
    /// The pdf at a point of the shape.
    fn pdf(&self, point: V3) -> f64;
    /// An independent parameterisation of the shape by the unit square: the point, and the measure per unit of the square.
    fn chart(&self, s: f64, t: f64) -> (V3, f64);
    /// The inverse of [`Self::chart`].
    fn locate(&self, point: V3) -> [f64; 2];
    /// A point outside the shape, at the distance `margin` from its boundary.
    fn outside(&self, _margin: f64, _random: &mut Random) -> Option<V3> {
        None
    }
    /// Greatest and least diameter of the shape, as distances between points.
    fn extent(&self) -> [f64; 2];
    /// Greatest distance of a point of the shape from the origin.
    fn radius(&self) -> f64 {
        1.0
    }
    /// The point in coordinates that are all rounded alike; a shape that overrides this overrides `distance` too.
    fn metric(&self, point: V3) -> V3 {
        point
    }
    /// Absolute change of the pdf per unit of rounding, for a pdf that tends to 0 by cancellation.
    fn pdf_slack(&self, _point: V3) -> f64 {
        0.0
    }
    /// Whether some `u` of the grid maps to somewhere near the point: not in tails of probability below 2⁻²⁴.
    fn reachable(&self, _point: V3) -> bool {
        true
    }
    /// Coordinates of a point are rounded in units of `ULP` × this: 1 in general, the extent for a shape on the z axis.
    fn granularity(&self) -> f64 {
        1.0
    }
    /// Distance between two points; for a shape on the z axis, only its component across the axis.
    fn distance(&self, a: V3, b: V3) -> f64 {
        let d = sub(a, b);
        if self.granularity() < 1.0 { d[0].hypot(d[1]) } else { length(d) }
    }
    /// A distance is rounded relative to itself and to this length.
    fn reach(&self) -> f64 {
        0.0
    }
    /// Distance of the farthest vertex of a flat shape; 0 for others.
    fn farthest(&self) -> f64 {
        0.0
    }
    /// Relative change of the distance per radian that the direction turns.
    fn slant(&self, _w: V3) -> f64 {
        1.0
    }
    /// Condition number: relative change of the pdf per relative change of a parameter.
    fn condition(&self) -> f64 {
        1.0
    }
    /// Change of the pdf per unit of distance that the point moves.
    fn gradient(&self) -> f64 {
        0.0
    }
    /// Tolerance of the integral over each cell, relative to the whole: coarser where the parameterisation has a kink.
    fn quadrature(&self) -> f64 {
        1e-9
    }
}
