//! Random numbers of the `rand` ecosystem: any generator of `rand_core` draws pairs, warps and lights.

use crate::light::{LightSample, LightSampler};
use crate::real::{Real, Uint};
use crate::vector::Vec2;
use crate::warp::Warp;
use rand_core::Rng;

/// What every generator of `rand_core` (and so of `rand`) can draw here, a point or a packet of points at a time.
///
/// ```
/// use etendue::{Real, Sphere, random::DrawExt, warp::CosineHemisphere, Vec3, f32x8};
/// # use rand_core::SeedableRng;
/// let mut rng = etendue::sequence::CounterRng::seed_from_u64(1); // or any of `rand`'s
/// let w: Vec3<f32> = rng.draw(&CosineHemisphere);
/// let bulb = Sphere::new(Vec3::lit([0.0, 3.0, 0.0]), f32x8::splat(0.5));
/// let light = rng.draw_light(&bulb.by_solid_angle(Vec3::lit([0.0; 3])));
/// assert!(w.z >= 0.0 && light.weight().lane(7) > 0.0);
/// ```
pub trait DrawExt: Rng {
    /// A pair of independent numbers in [0, 1 − 2⁻²⁴], of 24 bits each: two words per lane.
    #[inline]
    fn pair<R: Real>(&mut self) -> Vec2<R> {
        let mut unit = || R::unit(R::Uint::from_fn(|_| self.next_u32()));
        let x = unit();
        Vec2::new(x, unit())
    }
    /// A point of a warp, with the density of the warp.
    #[inline]
    fn draw<R: Real, W: Warp<R>>(&mut self, warp: &W) -> W::Point {
        warp.sample(self.pair())
    }
    /// A sample of a light.
    #[inline]
    fn draw_light<R: Real>(&mut self, light: &impl LightSampler<R>) -> LightSample<R> {
        light.sample(self.pair())
    }
}

impl<G: Rng + ?Sized> DrawExt for G {}
