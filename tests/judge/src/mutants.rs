//! Mutants: well-known defects of renderers, reintroduced on purpose. The properties must detect every one.
//!
//! A [`Defect`] replaces one part of a correct sampler. [`Planted`] is then a fixture like any other and goes through the same properties in
//! the same regimes. [`Sound`] replaces nothing, which shows that the wrapper itself breaks no property.

mod samplers;

pub use samplers::{
    AreaBetweenThresholds, ConeOverflow, CosineWarp, DroppedGrazing, ExcessInSample, FlatCentre, NonZeroOffTheCone,
    PaddedDisk, SelfClampingBarycentrics, UnguardedCap, UnitsInTheSwitch,
};

use crate::fixture::{Fixture, Truth};
use core::fmt::Debug;
use core::marker::PhantomData;
use etendue::{LightSample, LightSampler, Real, Vec2, Vec3};

/// A defect: replaces part of a correct sampler, whose fixtures it gets lane by lane.
pub trait Defect: Copy + Debug + 'static {
    /// The correct fixture.
    type Of: Fixture;
    /// Replaces `sample`.
    fn sample<R: Real>(right: &dyn LightSampler<R>, _lanes: &[Self::Of], u: Vec2<R>) -> LightSample<R> {
        right.sample(u)
    }
    /// Replaces `pdf`.
    fn pdf<R: Real>(right: &dyn LightSampler<R>, _lanes: &[Self::Of], w: Vec3<R>) -> R {
        right.pdf(w)
    }
}

/// No defect.
#[derive(Clone, Copy, Debug)]
pub struct Sound<S>(PhantomData<S>);
impl<S: Fixture> Defect for Sound<S> {
    type Of = S;
}

/// A sampler with a defect.
struct Wrong<D: Defect, R: Real> {
    right: Box<dyn LightSampler<R>>,
    lanes: Vec<D::Of>,
}
impl<D: Defect, R: Real> LightSampler<R> for Wrong<D, R> {
    fn sample(&self, u: Vec2<R>) -> LightSample<R> {
        D::sample(&*self.right, &self.lanes, u)
    }
    fn pdf(&self, w: Vec3<R>) -> R {
        D::pdf(&*self.right, &self.lanes, w)
    }
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        self.right.invert(w)
    }
    fn hit(&self, w: Vec3<R>) -> LightSample<R> {
        LightSample { pdf: self.pdf(w), ..self.right.hit(w) }
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
    fn prepare<R: Real>(lanes: &[Self]) -> Box<dyn LightSampler<R>> {
        let lanes: Vec<_> = lanes.iter().map(|s| s.0).collect();
        Box::new(Wrong::<D, R> { right: D::Of::prepare(&lanes), lanes })
    }
    fn splat<R: Real>(&self) -> Box<dyn LightSampler<R>> {
        Box::new(Wrong::<D, R> { right: self.0.splat(), lanes: vec![self.0] })
    }
    fn truth(&self) -> Box<dyn Truth> {
        self.0.truth()
    }
    fn lengths(&self) -> [f64; 2] {
        self.0.lengths()
    }
    fn scaled(&self, factor: f32) -> Self {
        Self(self.0.scaled(factor))
    }
    fn pdf_scaled(&self, factor: f32) -> f32 {
        self.0.pdf_scaled(factor)
    }
}
