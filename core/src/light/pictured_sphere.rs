//! Spheres with pictures.

use super::cells::{Box2, Measure, Slabs};
use super::direction::DirectionSample;
use super::pictured::{PicturedLight, PicturedSampler, Texel, TexelSurface};
use super::sample::{LightSample, direction_to, solid_angle_pdf};
use super::sphere::{Sphere, area::PlacedSphere};
use super::surface::{AreaSurface, Surface, SurfaceHit};
use crate::math::{quotient, ratio};
use crate::real::{Mask, Real};
use crate::vector::{Vec2, Vec3};
use crate::warp::{Bilinear, UniformSphere, Warp};
use core::f64::consts::PI;

impl<'a, R: Real> PicturedLight<'a, Sphere<R>> {
    /// By radiance times the area that is visible from the point `p`, over the squared distance; in a texel, by area. What faces away is not
    /// drawn, but for parts of the texels at the rim. The pdf is the pmf of the texel, over its area, times distance²/|cosθ'|, per steradian.
    ///
    /// Columns are heights from −1 to 1, and rows azimuths, as [`UniformSphere`] maps them. From inside, texels are drawn by radiance alone.
    #[inline(always)]
    pub fn by_visible_area(&self, p: Vec3<R>) -> PicturedSampler<'a, VisibleSphere<R>> {
        let Sphere { center, radius } = self.light;
        PicturedSampler { picture: self.picture, surface: VisibleSphere(PlacedSphere::new(center - p, radius)) }
    }
}

/// A sphere relative to the shading point, whose texels are drawn by visible area.
#[derive(Clone, Copy, Debug)]
pub struct VisibleSphere<R>(PlacedSphere<R>);

/// Boxes whose parts differ by less are alike.
const ALIKE: f64 = 1.0 / 128.0;

/// The middle of a box, and its sides.
#[inline(always)]
fn middle<R: Real>(of: &Box2<R>) -> (Vec2<R>, Vec2<R>) {
    let (low, high) = (of.low, of.high);
    let half = R::lit(0.5);
    (Vec2::new((low.x + high.x) * half, (low.y + high.y) * half), Vec2::new(high.x - low.x, high.y - low.y))
}

impl<R: Real> VisibleSphere<R> {
    /// How much of a box is visible, over the squared distance, in any unit; and whether that is alike all over it.
    #[inline(always)]
    fn visible(&self, of: &Box2<R>) -> (R, R::Mask) {
        let (PlacedSphere { center, radius }, one) = (self.0, R::lit(1.0));
        let (middle, size) = middle(of);
        let normal: Vec3<R> = UniformSphere.sample(middle);
        // half the angles that the box spans, from its middle: heights are 1 − 2u
        let polar = |u: R| (one - (u + u)).acos();
        let (low, at, high) = (polar(of.low.x), polar(middle.x), polar(of.high.x));
        let angle = (at - low).abs().greater((high - at).abs()) + size.y * R::lit(PI);
        // in units of the radius
        let to = Vec3 { x: ratio(center.x, radius), y: ratio(center.y, radius), z: ratio(center.z, radius) };
        let most = R::lit(1e15);
        let to = to.map(|x| x.clamped(-most, most)) + normal;
        let squared = to.length_squared();
        let distance = squared.sqrt();
        let cos = quotient(-to.dot(normal), distance);
        // a bound of how the cosine differs from that of the middle
        let spread = angle.mul_add(R::lit(1.6) / distance.greater(R::lit(1e-6)), angle).lesser(R::lit(2.0));
        let top = (cos + spread).greater(R::lit(0.0));
        let mean = R::blend(cos.lt(spread), top * top / (spread * R::lit(4.0)), cos);
        let alike = (cos * R::lit(ALIKE)).gt(spread);
        let reach = angle.lesser(one).mul_add(angle.lesser(one) * R::lit(0.5), squared);
        (mean / reach.greater(R::lit(1e-30)), alike)
    }
}

impl<R: Real> Measure<R> for VisibleSphere<R> {
    #[inline(always)]
    fn densities(&self, of: &Slabs<R>) -> ([R; 4], R::Mask) {
        let visible = of.each().map(|slab| self.visible(&slab));
        let alike = visible.iter().fold(R::Mask::splat(true), |all, (_, alike)| all & *alike);
        (visible.map(|(density, _)| density), !alike)
    }
}

impl<R: Real> TexelSurface<R> for VisibleSphere<R> {
    const FLAT: bool = false;
    #[inline(always)]
    fn at(&self, w: Vec3<R>) -> SurfaceHit<R> {
        self.0.at(w)
    }
    #[inline(always)]
    fn contains(&self, w: Vec3<R>) -> R::Mask {
        self.0.contains(w)
    }
    #[inline(always)]
    fn draw(&self, texel: &Texel<R>, u: Vec2<R>) -> LightSample<R> {
        let (within, varied) = match texel.corners {
            None => (u, R::lit(1.0)),
            Some(corners) => {
                let within = Bilinear { corners }.sample(u);
                (within, Bilinear { corners }.pdf(within))
            }
        };
        let uv = texel.place(within);
        let point = self.0.draw(uv);
        let DirectionSample { direction, distance } = direction_to(point.position);
        let cos = direction.dot(point.normal);
        let pdf = solid_angle_pdf(distance, cos.abs() * (point.inverse_pdf * texel.size.x * texel.size.y)) * varied;
        let (emits, delta) = (cos.lt(R::lit(0.0)), R::Mask::splat(false));
        LightSample { direction, distance, pdf, normal: point.normal, uv, emits, delta }
    }
    #[inline(always)]
    fn pdf(&self, texel: &Texel<R>, w: Vec3<R>, at: &SurfaceHit<R>, within: Vec2<R>) -> R {
        let area = self.0.area() * texel.size.x * texel.size.y;
        let varied = texel.corners.map_or(R::lit(1.0), |corners| Bilinear { corners }.pdf(within));
        solid_angle_pdf(at.distance, w.dot(at.normal).abs() * area) * varied
    }
    #[inline(always)]
    fn invert(&self, texel: &Texel<R>, _: Vec3<R>, within: Vec2<R>) -> Vec2<R> {
        texel.corners.map_or(within, |corners| Bilinear { corners }.invert(within))
    }
}
