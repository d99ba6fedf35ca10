//! Functions of a few numbers that are no densities: what lights look up, over any kind of number.

use crate::memory::PortalMemory;
use crate::sealed::Sealed;
use etendue::light::{PortalEnvironment, PortalMap};
use etendue::reflection::Reflection;
use etendue::{Lanewise, Mask, Real, Vec2, Vec3};

/// The most numbers that a map takes.
pub const MOST_NUMBERS: usize = 6;
/// The most numbers that a map returns.
pub const MOST_RESULTS: usize = 4;
/// How many maps there are.
pub(crate) const MAPS: usize = 3;

/// A function of a few numbers, with what it depends on in numbers or in memory.
pub trait BatchMap: Copy + Sealed {
    /// Its number.
    const INDEX: usize;
    /// How many numbers it takes; those beyond are 0.
    const NUMBERS: usize;
    /// How many numbers it returns; those beyond are 0.
    const RESULTS: usize;
    /// What it depends on, as the core has it.
    type View<'a>;
    /// Calls `f` with what it depends on.
    fn with<T>(&self, f: impl FnOnce(&Self::View<'_>) -> T) -> T;
    /// Its results for numbers, and whether they hold.
    fn map<R: Real<Scalar = f32>>(view: &Self::View<'_>, x: [R; MOST_NUMBERS]) -> ([R; MOST_RESULTS], R::Mask);
}

/// One result, which always holds.
#[inline(always)]
fn one<R: Real>(x: R) -> ([R; MOST_RESULTS], R::Mask) {
    let zero = R::lit(0.0);
    ([x, zero, zero, zero], R::Mask::splat(true))
}

/// [`Reflection::sphere`] of a centre and a radius.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct ReflectedSphere(pub Reflection<f32>);
impl Sealed for ReflectedSphere {}
impl BatchMap for ReflectedSphere {
    const INDEX: usize = 0;
    const NUMBERS: usize = 4;
    const RESULTS: usize = 1;
    type View<'a> = Reflection<f32>;
    #[inline(always)]
    fn with<T>(&self, f: impl FnOnce(&Reflection<f32>) -> T) -> T {
        f(&self.0)
    }
    #[inline(always)]
    fn map<R: Real<Scalar = f32>>(
        reflection: &Reflection<f32>,
        [x, y, z, radius, ..]: [R; MOST_NUMBERS],
    ) -> ([R; MOST_RESULTS], R::Mask) {
        one(Lanewise::splat::<R>(*reflection).sphere(Vec3::new(x, y, z), radius))
    }
}

/// [`PortalMap::direction`] of a position in the image of a portal with these edges, which are not parallel.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct PortalDirection {
    edge_s: [f32; 3],
    edge_t: [f32; 3],
}
impl PortalDirection {
    /// None if the edges are parallel or not finite.
    #[must_use]
    pub fn new(edge_s: [f32; 3], edge_t: [f32; 3]) -> Option<Self> {
        PortalMap::new(edge_s, edge_t).ok().map(|_| Self { edge_s, edge_t })
    }
}
impl Sealed for PortalDirection {}
impl BatchMap for PortalDirection {
    const INDEX: usize = 1;
    const NUMBERS: usize = 2;
    const RESULTS: usize = 4;
    type View<'a> = PortalMap;
    #[inline(always)]
    fn with<T>(&self, f: impl FnOnce(&PortalMap) -> T) -> T {
        f(&PortalMap::new(self.edge_s, self.edge_t).expect("the edges are not parallel"))
    }
    #[inline(always)]
    fn map<R: Real<Scalar = f32>>(map: &PortalMap, [u, v, ..]: [R; MOST_NUMBERS]) -> ([R; MOST_RESULTS], R::Mask) {
        let (w, solid_angle) = map.direction(Vec2::new(u, v));
        ([w.x, w.y, w.z, solid_angle], R::Mask::splat(true))
    }
}

/// [`PortalEnvironment::sees`] of a point and a direction.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct SeenThroughPortals<'m>(pub PortalMemory<'m>);
impl Sealed for SeenThroughPortals<'_> {}
impl BatchMap for SeenThroughPortals<'_> {
    const INDEX: usize = 2;
    const NUMBERS: usize = 6;
    const RESULTS: usize = 0;
    type View<'a> = PortalEnvironment<'a>;
    #[inline(always)]
    fn with<T>(&self, f: impl FnOnce(&PortalEnvironment<'_>) -> T) -> T {
        self.0.with(|sky| f(&sky)).expect("the memory is that of portals")
    }
    #[inline(always)]
    fn map<R: Real<Scalar = f32>>(
        sky: &PortalEnvironment<'_>,
        [px, py, pz, x, y, z]: [R; MOST_NUMBERS],
    ) -> ([R; MOST_RESULTS], R::Mask) {
        ([R::lit(0.0); MOST_RESULTS], sky.sees(Vec3::new(px, py, pz), Vec3::new(x, y, z)))
    }
}
