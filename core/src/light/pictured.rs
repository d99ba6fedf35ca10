//! Lights with pictures, prepared for a shading point.

use super::cells::{Box2, Drawn, Measure};
use super::picture::Picture;
use super::sample::{LightSample, TexelSample};
use super::sampler::LightSampler;
use super::surface::SurfaceHit;
use crate::real::{GREATEST, Real};
use crate::vector::{Vec2, Vec3};

/// A light with a picture: [`Picture::on`] makes it.
#[derive(Clone, Copy, Debug)]
pub struct PicturedLight<'a, L> {
    /// The picture.
    pub picture: Picture<'a>,
    /// The light that it is on.
    pub light: L,
}

impl<'a> Picture<'a> {
    /// The picture on a light, which must cover the [`Region`](super::Region) for which the picture was built.
    #[inline(always)]
    pub const fn on<L>(self, light: L) -> PicturedLight<'a, L> {
        PicturedLight { picture: self, light }
    }
}

/// A texel, as a part of the unit square of surface coordinates.
#[derive(Clone, Copy)]
pub(super) struct Texel<R> {
    /// Its first corner.
    pub(super) low: Vec2<R>,
    /// Its sides.
    pub(super) size: Vec2<R>,
    /// Radiance at its corners, between which it is bilinear, unless it is constant.
    pub(super) corners: Option<[R; 4]>,
}

impl<R: Real> Texel<R> {
    /// Surface coordinates of a position in the texel.
    #[inline(always)]
    pub(super) fn place(&self, within: Vec2<R>) -> Vec2<R> {
        let at = |low: R, size: R, x: R| x.mul_add(size, low).clamped(R::lit(0.0), R::ONE_MINUS_EPSILON);
        Vec2::new(at(self.low.x, self.size.x, within.x), at(self.low.y, self.size.y, within.y))
    }
}

/// A surface whose texels can be sampled, relative to the shading point.
pub(super) trait TexelSurface<R: Real>: Measure<R> {
    /// True where a direction determines the pdf, so that a sample reports that of its direction.
    const FLAT: bool;
    /// The nearest point in the unit direction `w`.
    fn at(&self, w: Vec3<R>) -> SurfaceHit<R>;
    /// Whether the unit direction `w` hits the surface.
    fn contains(&self, w: Vec3<R>) -> R::Mask;
    /// A point of the texel for `u` in [0, 1)², with the pdf that it has among those of the texel.
    fn draw(&self, texel: &Texel<R>, u: Vec2<R>) -> LightSample<R>;
    /// The pdf per steradian of a direction that hits the texel in `at`, among those of the texel.
    fn pdf(&self, texel: &Texel<R>, w: Vec3<R>, at: &SurfaceHit<R>, within: Vec2<R>) -> R;
    /// The `u` that [`draw`](Self::draw) maps to a direction, which hits the texel in this position.
    fn invert(&self, texel: &Texel<R>, w: Vec3<R>, within: Vec2<R>) -> Vec2<R>;
}

/// A light with a picture, prepared for a shading point.
///
/// - Domain: any light, point and picture; `u` in [0, 1)².
/// - Density: probability of the texel over its measure. A texel that the rim of a [`Triangle`](super::Triangle) or a [`Disk`](super::Disk) cuts is sampled as a whole:
///   beyond the rim, a sample has pdf 0.
/// - Degenerate: as of the light without a picture, the pdf is 0.
/// - Greatest error: the pmf is what is drawn, exactly. Texels are placed to 2⁻²³ of the light's extent, by which they may overlap or leave
///   gaps.
///
/// `sample` reports the pdf of the texel in which its direction lies, which may be the neighbour of the drawn one where the direction is next
/// to an edge, and any where a texel is less than 10⁻⁶ in size as seen from the point. [`draw`](Self::draw) returns the texel that was drawn,
/// with its pdf: an estimator takes that one, and costs half.
///
/// ```
/// use etendue::light::{Picture, Region};
/// use etendue::{LightSampler, Rectangle, Vec2};
/// // dark but for the quarter next to the last corner
/// let mut buffer = [0.0; Picture::buffer(2, 2)];
/// let picture = Picture::build(&[0.0, 0.0, 0.0, 5.0], 2, Region::Square, &mut buffer).unwrap();
/// let screen = Rectangle::new([-1.0, 2.0, -1.0].into(), [2.0, 0.0, 0.0].into(), [0.0, 0.0, 2.0_f32].into());
/// let sampler = picture.on(screen).by_solid_angle([0.0; 3].into());
/// let s = sampler.draw(Vec2::new(0.3, 0.6));
/// assert_eq!((s.x, s.y), (1, 1));
/// assert!(s.light.uv.x > 0.5 && s.light.uv.y > 0.5 && s.light.pdf > 0.0);
/// assert_eq!(sampler.pdf(etendue::Vec3::new(-0.1, 0.99, 0.1).normalize()), 0.0);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct PicturedSampler<'a, S> {
    pub(super) picture: Picture<'a>,
    pub(super) surface: S,
}

/// The texel of a picture at a cell.
#[inline(always)]
fn texel<R: Real>(picture: &Picture<'_>, at: Vec2<R>) -> Texel<R> {
    let Box2 { low, high } = picture.grid().cell(at);
    Texel { low, size: high - low, corners: picture.corners(at) }
}

#[inline(always)]
fn density<R: Real>(drawn: &Drawn<R>, pdf: R) -> R {
    (drawn.pmf() * pdf).lesser(R::lit(GREATEST))
}

#[inline]
fn pdf_at<R: Real>(picture: &Picture<'_>, surface: &impl TexelSurface<R>, w: Vec3<R>, at: &SurfaceHit<R>) -> R {
    let (cell, within) = picture.grid().locate(at.uv);
    let drawn = picture.find(cell, surface);
    let hit = surface.contains(w) & picture.region().contains(at.uv);
    density(&drawn, surface.pdf(&texel(picture, cell), w, at, within)).keep(hit)
}

impl<S> PicturedSampler<'_, S> {
    /// A direction in proportion to radiance and measure, with its texel.
    #[allow(private_bounds, reason = "the surfaces are those of this library")]
    #[inline]
    pub fn draw<R: Real>(&self, u: Vec2<R>) -> TexelSample<R>
    where
        S: TexelSurface<R>,
    {
        let (drawn, within) = self.picture.draw(u, &self.surface);
        let light = self.surface.draw(&texel(&self.picture, drawn.cell), within);
        let pdf = density(&drawn, light.pdf).keep(self.picture.region().contains(light.uv));
        TexelSample { light: LightSample { pdf, ..light }, x: drawn.cell.x.to_uint(), y: drawn.cell.y.to_uint() }
    }
}

impl<R: Real, S: TexelSurface<R>> LightSampler<R> for PicturedSampler<'_, S> {
    #[inline]
    fn sample(&self, u: Vec2<R>) -> LightSample<R> {
        let drawn = self.draw(u).light;
        if !S::FLAT {
            return drawn;
        }
        let hit = self.hit(drawn.direction);
        LightSample { pdf: hit.pdf.keep(drawn.pdf.gt(R::lit(0.0))), ..hit }
    }
    #[inline]
    fn pdf(&self, w: Vec3<R>) -> R {
        pdf_at(&self.picture, &self.surface, w, &self.surface.at(w))
    }
    #[inline]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let (cell, within) = self.picture.grid().locate(self.surface.at(w).uv);
        let drawn = self.picture.find(cell, &self.surface);
        drawn.invert(self.surface.invert(&texel(&self.picture, cell), w, within))
    }
    #[inline]
    fn hit(&self, w: Vec3<R>) -> LightSample<R> {
        let at = self.surface.at(w);
        let pdf = pdf_at(&self.picture, &self.surface, w, &at);
        let some = pdf.gt(R::lit(0.0));
        LightSample {
            distance: at.distance.keep(some),
            pdf,
            normal: at.normal,
            uv: at.uv,
            emits: w.dot(at.normal).lt(R::lit(0.0)) & some,
            ..LightSample::miss(w)
        }
    }
}
