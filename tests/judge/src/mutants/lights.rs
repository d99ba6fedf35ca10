//! Defects of lights.

use crate::packets::vectors_of;
use crate::techniques::LightFixture;
use etendue::light::shapes::SphericalRectangle;
use etendue::warp::Bilinear;
use etendue::{Disk, LightSample, LightSampler, Mask, Real, Rectangle, Vec2, Vec3, Warp};

/// 3: the square is warped by the cosines at the corners before a rectangle is sampled by solid angle (Hart et al. 2020). The pdf of a
/// sample includes the warp's factor; if `WRONG`, the evaluated pdf does not.
#[derive(Clone, Copy, Debug)]
pub struct CosineWarp<const WRONG: bool> {
    /// Corner, relative to the shading point.
    pub p: [f32; 3],
    /// First edge.
    pub u: [f32; 3],
    /// Second edge, perpendicular to `u`.
    pub v: [f32; 3],
}
impl<const WRONG: bool> CosineWarp<WRONG> {
    fn parts<R: Real>(lanes: &[Self]) -> (Rectangle<R>, SphericalRectangle<R>, Bilinear<R>) {
        let of = |i: usize| lanes[i % lanes.len()];
        let (p, u, v) = (vectors_of(|i| of(i).p), vectors_of(|i| of(i).u), vectors_of(|i| of(i).v));
        // the receiver's normal is +z
        let cos = |corner: Vec3<R>| corner.normalize().z.greater(R::lit(0.01));
        let corners = [cos(p), cos(p + u), cos(p + v), cos(p + u + v)];
        (Rectangle { corner: p, edge_s: u, edge_t: v }, SphericalRectangle::new(p, u, v), Bilinear { corners })
    }
}
impl<const WRONG: bool> LightFixture for CosineWarp<WRONG> {
    fn prepare<R: Real>(lanes: &[Self]) -> Box<dyn LightSampler<R>> {
        let (light, seen, warp) = Self::parts::<R>(lanes);
        Box::new(Warped::<R, WRONG> { light, seen, warp })
    }
    /// The inverse is accurate to a few roundings of a direction, divided by the size of the rectangle.
    fn evaluated_to(&self, _: &LightSample<f32>) -> Option<f64> {
        Some(1e-4)
    }
}
struct Warped<R, const WRONG: bool> {
    light: Rectangle<R>,
    seen: SphericalRectangle<R>,
    warp: Bilinear<R>,
}
impl<R: Real, const WRONG: bool> LightSampler<R> for Warped<R, WRONG> {
    fn sample(&self, u: Vec2<R>) -> LightSample<R> {
        let v = self.warp.sample(u);
        let sample = self.light.by_solid_angle(Vec3::lit([0.0; 3])).sample(v);
        LightSample { pdf: sample.pdf * self.warp.pdf(v), ..sample }
    }
    fn pdf(&self, w: Vec3<R>) -> R {
        let pdf = self.seen.pdf(w);
        if WRONG { pdf } else { pdf * self.warp.pdf(self.seen.invert(w)) }
    }
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        self.warp.invert(self.seen.invert(w))
    }
    fn hit(&self, w: Vec3<R>) -> LightSample<R> {
        LightSample { pdf: self.pdf(w), ..self.light.by_solid_angle(Vec3::lit([0.0; 3])).hit(w) }
    }
}

/// A disk by area, as in the core.
pub struct SoundDisk;
impl SoundDisk {
    /// A sample from the origin.
    #[must_use]
    pub fn draw(disk: &Disk<f64>, u: Vec2<f64>) -> LightSample<f64> {
        disk.by_area(Vec3::new(0.0, 0.0, 0.0)).sample(u)
    }
}
/// 11: 1e−4 is added to the divisor of a pdf by area, to keep it from being 0.
pub struct PaddedDisk;
impl PaddedDisk {
    /// A sample from the origin.
    #[must_use]
    pub fn draw(disk: &Disk<f64>, u: Vec2<f64>) -> LightSample<f64> {
        let right = SoundDisk::draw(disk, u);
        let squared = right.distance * right.distance;
        let pdf = if right.pdf > 0.0 { squared / (squared / right.pdf + 1e-4) } else { 0.0 };
        LightSample { pdf, delta: <bool as Mask>::splat(false), ..right }
    }
}
