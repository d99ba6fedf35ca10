//! Curved lights with pictures.

use super::cells::{Box2, Measure, Slabs};
use super::direction::DirectionSample;
use super::patch::{BilinearPatch, PlacedPatch};
use super::pictured::{PicturedLight, PicturedSampler, Texel, TexelSurface};
use super::sample::{LightSample, direction_to, solid_angle_pdf};
use super::sphere::{Sphere, area::PlacedSphere};
use super::surface::{AreaSurface, SurfaceHit, SurfacePoint};
use crate::math::{quotient, ratio};
use crate::real::{Mask, Real};
use crate::vector::{Vec2, Vec3};
use crate::warp::{Bilinear, UniformSphere, Warp};
use core::f64::consts::PI;

impl<P: Copy, R: Real> PicturedLight<P, Sphere<R>> {
    /// By radiance times the area that is visible from the point `p`, over the squared distance; in a texel, by area. What faces away is not
    /// drawn, but for parts of the texels at the rim. The pdf is the pmf of the texel, over its area, times distance²/|cosθ'|, per steradian.
    ///
    /// Columns are heights from −1 to 1, and rows azimuths, as [`UniformSphere`] maps them. From inside, texels are drawn by radiance alone.
    #[inline(always)]
    pub fn by_visible_area(&self, p: Vec3<R>) -> PicturedSampler<P, Curved<PlacedSphere<R>>> {
        let Sphere { center, radius } = self.light;
        PicturedSampler { picture: self.picture, surface: Curved(PlacedSphere::new(center - p, radius)) }
    }
}

impl<P: Copy, R: Real> PicturedLight<P, BilinearPatch<R>> {
    /// By radiance times the area that is visible from the point `p`, over the squared distance; in a texel, uniform in (s, t). The pdf is the
    /// pmf of the texel, over |∂s×∂t| and the number of texels, times distance²/|cosθ'|, per steradian.
    #[inline(always)]
    pub fn by_visible_area(&self, p: Vec3<R>) -> PicturedSampler<P, Curved<PlacedPatch<R>>> {
        PicturedSampler { picture: self.picture, surface: Curved(self.light.placed(p)) }
    }
}

/// A curved light, relative to the shading point.
#[derive(Clone, Copy, Debug)]
pub struct Curved<S>(S);

/// A surface with its points by surface coordinates.
trait Coordinates<R: Real>: AreaSurface<R> {
    /// The point, with the area per unit of surface coordinates as `inverse_pdf`.
    fn point(&self, uv: Vec2<R>) -> SurfacePoint<R>;
    /// That area alone.
    fn stretch(&self, uv: Vec2<R>) -> R;
    /// How much of a box is visible, over the squared distance, in any unit; and whether that is alike all over it.
    fn visible(&self, of: &Box2<R>) -> (R, R::Mask);
}

/// Boxes whose parts differ by less are alike.
const ALIKE: f64 = 1.0 / 128.0;

/// The middle of a box, and its sides.
#[inline(always)]
fn middle<R: Real>(of: &Box2<R>) -> (Vec2<R>, Vec2<R>) {
    let (low, high) = (of.low, of.high);
    let half = R::lit(0.5);
    (Vec2::new((low.x + high.x) * half, (low.y + high.y) * half), Vec2::new(high.x - low.x, high.y - low.y))
}

impl<R: Real> Coordinates<R> for PlacedSphere<R> {
    #[inline(always)]
    fn point(&self, uv: Vec2<R>) -> SurfacePoint<R> {
        self.draw(uv)
    }
    #[inline(always)]
    fn stretch(&self, _: Vec2<R>) -> R {
        self.area()
    }
    #[inline(always)]
    fn visible(&self, of: &Box2<R>) -> (R, R::Mask) {
        let one = R::lit(1.0);
        let (middle, size) = middle(of);
        let normal: Vec3<R> = UniformSphere.sample(middle);
        // half the angles that the box spans, from its middle: heights are 1 − 2u
        let polar = |u: R| (one - (u + u)).acos();
        let (low, at, high) = (polar(of.low.x), polar(middle.x), polar(of.high.x));
        let angle = (at - low).abs().greater((high - at).abs()) + size.y * R::lit(PI);
        // in units of the radius
        let to = Vec3 {
            x: ratio(self.center.x, self.radius),
            y: ratio(self.center.y, self.radius),
            z: ratio(self.center.z, self.radius),
        };
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

impl<R: Real> Coordinates<R> for PlacedPatch<R> {
    #[inline(always)]
    fn point(&self, st: Vec2<R>) -> SurfacePoint<R> {
        self.at_coordinates(st)
    }
    #[inline(always)]
    fn stretch(&self, st: Vec2<R>) -> R {
        self.stretch_at(st)
    }
    #[inline(always)]
    fn visible(&self, of: &Box2<R>) -> (R, R::Mask) {
        let (zero, quarter) = (R::lit(0.0), R::lit(0.25));
        let (middle, size) = middle(of);
        let Box2 { low, high } = of;
        // the area per unit of surface coordinates, times the cosine and the distance, is bilinear: it is greatest and least at corners
        let corners = [(low.x, low.y), (high.x, low.y), (low.x, high.y), (high.x, high.y)];
        let rises = corners.map(|(s, t)| self.rise(s, t));
        let least = rises[1..].iter().fold(rises[0], |least, x| x.lesser(least));
        let most = rises[1..].iter().fold(rises[0], |most, x| x.greater(most));
        let mean = rises.iter().fold(zero, |sum, x| sum + *x) * quarter;
        let across = least.lt(zero) & most.gt(zero);
        let both = least.mul_add(least, most * most) / R::blend(across, most - least, R::lit(1.0));
        // from both sides, and a little more than rounding leaves
        let seen = R::blend(across, both * R::lit(0.5), mean.abs()) + R::lit(1e-7);
        let (offset, sides) = self.middle(middle, size);
        let squared = sides.mul_add(R::lit(1.0 / 12.0), offset.length_squared()).greater(R::lit(1e-20));
        let alike = (mean.abs() * R::lit(ALIKE)).gt(most - least) & (squared * R::lit(ALIKE * ALIKE)).gt(sides);
        (seen / squared / squared.sqrt(), alike)
    }
}

impl<R: Real, S: Coordinates<R>> Measure<R> for Curved<S> {
    #[inline(always)]
    fn densities(&self, of: &Slabs<R>) -> ([R; 4], R::Mask) {
        let visible = of.each().map(|slab| self.0.visible(&slab));
        let alike = visible.iter().fold(R::Mask::splat(true), |all, (_, alike)| all & *alike);
        (visible.map(|(density, _)| density), !alike)
    }
}

impl<R: Real, S: Coordinates<R>> TexelSurface<R> for Curved<S> {
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
        let point = self.0.point(uv);
        let DirectionSample { direction, distance } = direction_to(point.position);
        let cos = direction.dot(point.normal);
        let pdf = solid_angle_pdf(distance, cos.abs() * (point.inverse_pdf * texel.size.x * texel.size.y)) * varied;
        let (emits, delta) = (cos.lt(R::lit(0.0)), R::Mask::splat(false));
        LightSample { direction, distance, pdf, normal: point.normal, uv, emits, delta }
    }
    #[inline(always)]
    fn pdf(&self, texel: &Texel<R>, w: Vec3<R>, at: &SurfaceHit<R>, within: Vec2<R>) -> R {
        let area = self.0.stretch(at.uv) * texel.size.x * texel.size.y;
        let varied = texel.corners.map_or(R::lit(1.0), |corners| Bilinear { corners }.pdf(within));
        solid_angle_pdf(at.distance, w.dot(at.normal).abs() * area) * varied
    }
    #[inline(always)]
    fn invert(&self, texel: &Texel<R>, _: Vec3<R>, within: Vec2<R>) -> Vec2<R> {
        texel.corners.map_or(within, |corners| Bilinear { corners }.invert(within))
    }
}
