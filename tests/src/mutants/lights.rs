//! Defects of lights.

use crate::properties::vectors_of;
use crate::techniques::Technique;
use etendue::spherical::SphericalRectangle;
use etendue::warp::Bilinear;
use etendue::{Disk, LightSample, Mask, Real, Rectangle, Vec2, Vec3, Warp};

/// 3: the square is warped by the cosines at the corners before a rectangle is sampled by its solid angle (Hart et al. 2020). The sample's
/// density has the warp's factor; the evaluated one, if `WRONG`, has not.
#[derive(Clone, Copy, Debug)]
pub struct CosineWarp<const WRONG: bool> {
    /// Corner, relative to the shading point.
    pub p: [f32; 3],
    /// Edge.
    pub u: [f32; 3],
    /// Edge, perpendicular to `u`.
    pub v: [f32; 3],
}
impl<const WRONG: bool> CosineWarp<WRONG> {
    fn parts<R: Real>(lanes: &[Self]) -> (Rectangle<R>, SphericalRectangle<R>, Bilinear<R>) {
        let of = |i: usize| lanes[i % lanes.len()];
        let (p, u, v) = (vectors_of(|i| of(i).p), vectors_of(|i| of(i).u), vectors_of(|i| of(i).v));
        // the normal of the receiver is +z
        let cos = |corner: Vec3<R>| corner.normalize().z.greater(R::lit(0.01));
        let corners = [cos(p), cos(p + u), cos(p + v), cos(p + u + v)];
        (Rectangle { p, u, v }, SphericalRectangle::new(p, u, v), Bilinear { corners })
    }
}
impl<const WRONG: bool> Technique for CosineWarp<WRONG> {
    fn draw<R: Real>(lanes: &[Self], u: Vec2<R>) -> LightSample<R> {
        let (light, _, warp) = Self::parts::<R>(lanes);
        let v = warp.sample(u);
        let zero = R::lit(0.0);
        let sample = light.by_solid_angle(Vec3::new(zero, zero, zero), v);
        LightSample { pdf: sample.pdf * warp.pdf(v), ..sample }
    }
    fn evaluate<R: Real>(lanes: &[Self], w: Vec3<R>) -> Option<R> {
        let (_, seen, warp) = Self::parts::<R>(lanes);
        let pdf = seen.pdf(w);
        Some(if WRONG { pdf } else { pdf * warp.pdf(seen.invert(w)) })
    }
    /// The inverse is known to some steps of a direction's rounding over the size.
    fn evaluated_to(&self, _: crate::oracle::V3) -> f64 {
        1e-4
    }
}

/// A disk by area, as the core has it.
pub struct SoundDisk;
impl SoundDisk {
    /// A sample from the origin.
    #[must_use]
    pub fn draw(disk: &Disk<f64>, u: Vec2<f64>) -> LightSample<f64> {
        disk.by_area(Vec3::new(0.0, 0.0, 0.0), u)
    }
}
/// 11: 1e−4 is added to what a density by area is divided by, lest it be 0.
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
