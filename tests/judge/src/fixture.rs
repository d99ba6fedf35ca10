//! What a sampler under test is, and what is known about it independently.

use crate::packets::Coordinates;
use crate::random::Random;
use crate::tolerances::Tolerance;
use core::fmt::{self, Debug, Formatter};
use etendue::{LightSample, LightSampler, Mask, Real, Vec2, Vec3, Warp, f32x8};
use etendue_oracle::{V3, length, sub};
use std::cell::LazyCell;

/// A sampler with its parameters (held in f32, hence exact at every precision).
pub trait Fixture: Copy + Debug + 'static {
    /// The sampler whose lane `i` is prepared from `lanes[i % lanes.len()]`.
    fn prepare<R: Real>(lanes: &[Self]) -> Box<dyn LightSampler<R>>;
    /// It is prepared in scalars, and is then in every lane.
    fn splat<R: Real>(&self) -> Box<dyn LightSampler<R>>;
    /// What is known about its points and their density.
    fn truth(&self) -> Box<dyn Truth>;
    /// The least and the greatest length of a point that has a pdf.
    fn lengths(&self) -> [f64; 2];
    /// All lengths multiplied by a power of two; the same if there are none.
    #[must_use]
    fn scaled(&self, _factor: f32) -> Self {
        *self
    }
    /// What the pdf is multiplied by then.
    fn pdf_scaled(&self, _factor: f32) -> f32 {
        1.0
    }
}

/// A warp as a sampler: its points are directions at the distance 0.
#[derive(Clone, Copy, Debug)]
pub struct Mapped<W>(pub W);
impl<R: Real, W: Warp<R>> LightSampler<R> for Mapped<W>
where
    W::Point: Coordinates<R>,
{
    fn sample(&self, u: Vec2<R>) -> LightSample<R> {
        let point = self.0.sample(u);
        let pdf = self.0.pdf(point);
        LightSample { pdf, emits: R::Mask::splat(true), ..LightSample::miss(point.in_space()) }
    }
    fn pdf(&self, point: Vec3<R>) -> R {
        self.0.pdf(Coordinates::from_space(point))
    }
    fn invert(&self, point: Vec3<R>) -> Vec2<R> {
        self.0.invert(Coordinates::from_space(point))
    }
    fn hit(&self, point: Vec3<R>) -> LightSample<R> {
        LightSample::miss(point)
    }
}

/// How the fixture of a warp is prepared, of numbers and vectors that are functions of it.
macro_rules! prepared {
    (|$number:ident, $vector:ident| $warp:expr $(, $wrapped:ident)?) => {
        fn prepare<R: Real>(lanes: &[Self]) -> Box<dyn LightSampler<R>> {
            let of = |i: usize| &lanes[i % lanes.len()];
            let $number = |f: &dyn Fn(&Self) -> f32| -> R { $crate::packets::lanes_of(|i| f(of(i)).into()) };
            let $vector = |f: &dyn Fn(&Self) -> [f32; 3]| -> Vec3<R> { $crate::packets::vectors_of(|i| f(of(i))) };
            let _ = (&$number, &$vector);
            Box::new($crate::fixture::Mapped($($wrapped)?($warp)))
        }
        fn splat<R: Real>(&self) -> Box<dyn LightSampler<R>> {
            let $number = |f: &dyn Fn(&Self) -> f32| R::Scalar::lit(f(self).into());
            let $vector = |f: &dyn Fn(&Self) -> [f32; 3]| Vec3::<R::Scalar>::lit(f(self).map(f64::from));
            let _ = (&$number, &$vector);
            Box::new($crate::fixture::Mapped($($wrapped)?(etendue::Lanewise::splat::<R>($warp))))
        }
    };
}
pub(crate) use prepared;

/// How a fixture is prepared with its lengths multiplied, and what its pdf is multiplied by then.
type Scaled = dyn Fn(f32) -> (Box<dyn LightSampler<f32>>, f32);
/// What is known about a fixture.
type Known = dyn FnOnce() -> Box<dyn Truth>;

/// A fixture that is prepared, and what is known of it: the properties are compiled once, whatever the fixture is.
pub struct Subject {
    fixture: Box<dyn Debug>,
    /// The least and the greatest length of a point that has a pdf.
    pub lengths: [f64; 2],
    /// In single precision.
    pub single: Box<dyn LightSampler<f32>>,
    /// In double precision.
    pub double: Box<dyn LightSampler<f64>>,
    /// In packets of eight.
    pub eight: Box<dyn Fn() -> Box<dyn LightSampler<f32x8>>>,
    /// With all lengths multiplied.
    pub scaled: Box<Scaled>,
    /// What is known about its points and their density.
    pub truth: LazyCell<Box<dyn Truth>, Box<Known>>,
}
impl Subject {
    /// Prepares a fixture.
    #[must_use]
    pub fn new<S: Fixture>(fixture: &S) -> Self {
        let s = *fixture;
        Self {
            fixture: Box::new(s),
            lengths: s.lengths(),
            single: S::prepare(&[s]),
            double: S::prepare(&[s]),
            eight: Box::new(move || S::prepare(&[s])),
            scaled: Box::new(move |factor| (S::prepare(&[s.scaled(factor)]), s.pdf_scaled(factor))),
            truth: LazyCell::new(Box::new(move || s.truth())),
        }
    }
}
impl Debug for Subject {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.fixture.fmt(f)
    }
}

/// What is known about points and their density, from the definition of a shape and not from the code of a sampler, and which errors the code
/// may have.
pub trait Truth {
    /// The errors that are tolerated.
    fn tolerance(&self) -> Tolerance;
    /// Whether there is anything to draw from: a horizon may leave nothing.
    fn is_seen(&self) -> bool {
        true
    }
    /// ∫ pdf: the length of a receiver's normal, which is rounded.
    fn whole(&self) -> f64 {
        1.0
    }
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
    /// Error of the inverse besides the point's own rounding, in units of rounding.
    fn inverse_units(&self, _u: [f64; 2]) -> f64 {
        2.0
    }
    /// Error of the inverse besides the point's own rounding, in steps of `u`.
    fn inverse_steps(&self) -> f64 {
        2.0
    }
    /// Whether the second coordinate of the square is an azimuth.
    fn is_periodic(&self) -> bool {
        false
    }
    /// Whether the map has two derivatives near `u`.
    fn smooth(&self, _map: &dyn LightSampler<f64>, _u: [f64; 2]) -> bool {
        true
    }
    /// Whether the map jumps within `step` of `u` in the first coordinate: rounding decides on which side of the jump a point falls.
    fn torn(&self, _map: &dyn LightSampler<f64>, _u: [f64; 2], _step: f64) -> bool {
        false
    }
}

/// The point of a map in double precision.
#[must_use]
pub fn sample_at(map: &dyn LightSampler<f64>, u: [f64; 2]) -> V3 {
    map.sample(Vec2::new(u[0], u[1])).direction.at(0)
}
