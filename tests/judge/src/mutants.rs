//! Mutants: well-known defects of renderers, reintroduced on purpose. The properties must detect every one.
//!
//! A [`Defect`] replaces one part of a correct warp. [`Planted`] is then a fixture like any other and goes through the same properties in
//! the same regimes. [`Sound`] replaces nothing, which shows that the wrapper itself breaks no property.

mod lights;
mod warps;

pub use lights::{CosineWarp, PaddedDisk, SoundDisk};
pub use warps::{
    AreaBetweenThresholds, ConeOverflow, DroppedGrazing, ExcessInSample, FlatCentre, NonZeroOffTheCone,
    SelfClampingBarycentrics, UnguardedCap, UnitsInTheSwitch,
};

use crate::fixture::Fixture;
use crate::tolerances::Tolerance;
use core::fmt::Debug;
use core::marker::PhantomData;
use etendue::light::shapes::DirectionSample;
use etendue::{Real, Vec2, Warp};

/// The parameters of a fixture, lane by lane; unused entries are 0.
pub type Data<R> = [R; 9];

/// A defect: replaces part of a correct warp.
pub trait Defect: Copy + Debug {
    /// The correct fixture.
    type Of: Fixture;
    /// The numbers that the defective part needs.
    fn data<R: Real>(_lanes: &[Self::Of]) -> Data<R> {
        [R::lit(0.0); 9]
    }
    /// Replaces `sample`.
    fn sample<R: Real>(right: &RightWarp<Self, R>, _data: &Data<R>, u: Vec2<R>) -> RightPoint<Self, R> {
        right.sample(u)
    }
    /// Replaces `pdf`.
    fn pdf<R: Real>(right: &RightWarp<Self, R>, _data: &Data<R>, point: RightPoint<Self, R>) -> R {
        right.pdf(point)
    }
    /// Replaces `sample_direction`.
    fn sample_direction<R: Real>(
        right: &RightWarp<Self, R>,
        _data: &Data<R>,
        u: Vec2<R>,
    ) -> Option<DirectionSample<R>> {
        Self::Of::sample_direction(right, u)
    }
}
type RightWarp<D, R> = <<D as Defect>::Of as Fixture>::Warp<R>;
type RightPoint<D, R> = <<D as Defect>::Of as Fixture>::Point<R>;

/// No defect.
#[derive(Clone, Copy, Debug)]
pub struct Sound<S>(PhantomData<S>);
impl<S: Fixture> Defect for Sound<S> {
    type Of = S;
}

/// A warp with a defect.
pub struct Wrong<D: Defect, R: Real> {
    right: RightWarp<D, R>,
    data: Data<R>,
}
impl<D: Defect, R: Real> Warp<R> for Wrong<D, R> {
    type Point = RightPoint<D, R>;
    fn sample(&self, u: Vec2<R>) -> Self::Point {
        D::sample(&self.right, &self.data, u)
    }
    fn pdf(&self, point: Self::Point) -> R {
        D::pdf(&self.right, &self.data, point)
    }
    fn invert(&self, point: Self::Point) -> Vec2<R> {
        self.right.invert(point)
    }
}

/// A fixture with a defect, judged by what is known about the correct one.
#[derive(Clone, Copy, Debug)]
pub struct Planted<D: Defect>(pub D::Of);

/// The same cases, with the defect.
pub fn plant<D: Defect>(cases: &[(&'static str, D::Of)]) -> Vec<(&'static str, Planted<D>)> {
    cases.iter().map(|&(name, subject)| (name, Planted(subject))).collect()
}

impl<D: Defect> Fixture for Planted<D> {
    type Warp<R: Real> = Wrong<D, R>;
    type Point<R: Real> = RightPoint<D, R>;
    const PERIODIC: bool = D::Of::PERIODIC;
    type Truth = <D::Of as Fixture>::Truth;
    fn truth(&self) -> Self::Truth {
        self.0.truth()
    }
    fn prepare<R: Real>(lanes: &[Self]) -> Self::Warp<R> {
        let lanes: Vec<_> = lanes.iter().map(|s| s.0).collect();
        Wrong { right: D::Of::prepare(&lanes), data: D::data(&lanes) }
    }
    fn splat<R: Real>(warp: Self::Warp<R::Scalar>) -> Self::Warp<R> {
        Wrong { right: D::Of::splat(warp.right), data: warp.data.map(R::splat) }
    }
    fn sample_direction<R: Real>(warp: &Self::Warp<R>, u: Vec2<R>) -> Option<DirectionSample<R>> {
        D::sample_direction(&warp.right, &warp.data, u)
    }
    fn scaled(&self, factor: f32) -> Self {
        Self(self.0.scaled(factor))
    }
    fn kin(&self, other: &Self) -> bool {
        self.0.kin(&other.0)
    }
    fn tolerance(&self) -> Tolerance {
        self.0.tolerance()
    }
    fn inverse_units(&self, u: [f64; 2]) -> f64 {
        self.0.inverse_units(u)
    }
    fn inverse_steps(&self) -> f64 {
        self.0.inverse_steps()
    }
    fn torn(&self, u: [f64; 2], step: f64) -> bool {
        self.0.torn(u, step)
    }
    fn smooth(&self, u: [f64; 2]) -> bool {
        self.0.smooth(u)
    }
}
