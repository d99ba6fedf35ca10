//! Lights prepared for a shading point.

use super::direction::DirectionSample;
use super::sample::{LightSample, direction_to, solid_angle_pdf};
use super::seen::{ProjectedShape, SphericalShape};
use super::surface::{AreaSurface, Surface, SurfaceHit};
use crate::lanewise::Lanewise;
use crate::math::quotient;
use crate::real::{Mask, Real};
use crate::reflection::Reflection;
use crate::vector::{Vec2, Vec3};
use crate::warp::Warp;
use core::f64::consts::PI;

/// A light prepared for one shading point and one technique: what an integrator needs, whatever the light and the measure are.
///
/// [`sample`](Self::sample) draws a direction, [`pdf`](Self::pdf) evaluates the same density for a direction that another technique drew,
/// [`hit`](Self::hit) also finds the point of the light there, and [`invert`](Self::invert) recovers the random numbers. Prepare once,
/// then call as often as needed: what depends on the light and the point alone is computed by the `by_…` method that returned the sampler.
///
/// `sample(u).pdf` and `pdf(sample(u).direction)` are the same bits. The exceptions are curved lights (sphere, bilinear patch)
/// *by area* and lines: a rounded direction determines their pdf only as well as it determines the point, so a sample
/// reports the pdf of the point that was drawn.
///
/// Degenerate input (a light without extent, a shading point exactly in the plane of a flat light) gives pdf 0, never NaN, infinity or a panic. So does
/// NaN in a light, in the shading point or in its normal, except in the direction of a directional light, on which its pdf does not depend.
///
/// # What a host gets wrong at first
/// - The normal `n` of a shading point must have length 1: by projected solid angle the pdf is multiplied by its length, so that it no
///   longer integrates to 1.
/// - `n` must be on the side from which light is gathered. With the opposite one, samples by projected solid angle are below the surface,
///   or there are none: a surface of two sides takes the normal on the viewer's side.
/// - The normal of a light, whose direction its corners' order or its edges' cross product gives, is on the side that emits. From behind,
///   `pdf` is positive, but `emits` is false and `weight()` is 0; [`LightSample::two_sided`] is for lights that emit from both sides.
/// - A light must not light itself. From a point of its own plane a flat light has pdf 0, but a point that was *computed* on the light is,
///   through rounding, in front of it, behind it or in the plane; from before it, a sample may be 10⁻³⁰ away. On a curved light, rounding
///   decides whether the point is inside. All results are finite, and right for the point as it is. So a host passes over the light
///   that the point is on: where it knows which that is, or where `light.on_surface(p)`, which is true of all computed points.
///   The sets of the module `lights` do it for the host.
/// - Directions must have length 1, and should be those that were sampled. A direction that is computed anew from the point of a sample has
///   other last bits: its pdf is that of a direction some 10⁻⁷ away, and is 0 where that one misses the light beside an edge. For the
///   weights of a sample, use its own `direction` and `pdf`.
///
/// ```
/// use etendue::{Frame, LightSampler, Real, Vec2, Vec3, Warp, estimate::Heuristic, warp::CosineHemisphere};
/// /// Radiance that a white diffuse surface with normal `n` reflects of a light with radiance 1, by one sample of either technique.
/// fn reflected<R: Real>(light: &impl LightSampler<R>, n: Vec3<R>, u: Vec2<R>, v: Vec2<R>) -> R {
///     let cosine_pdf = |w: Vec3<R>| w.dot(n).greater(R::lit(0.0)) * R::lit(std::f64::consts::FRAC_1_PI);
///     let s = light.sample(u); // here a renderer traces a shadow ray along s.direction up to s.distance
///     let by_light = cosine_pdf(s.direction) * Heuristic::POWER.light_weight(&s, cosine_pdf(s.direction));
///     let w = Frame::new(n).to_world(CosineHemisphere.sample(v));
///     let by_surface = cosine_pdf(w) * Heuristic::POWER.bsdf_weight(cosine_pdf(w), &light.hit(w));
///     by_light + by_surface
/// }
/// let triangle = etendue::Triangle::new([0.0, 1.0, 0.0].into(), [1.0, 1.0, 0.0].into(), [0.0, 1.0, 1.0_f32].into());
/// let (p, n) = ([0.2, 0.0, 0.1].into(), [0.0, 1.0, 0.0].into());
/// let u = Vec2::new(0.3, 0.7);
/// assert!(reflected(&triangle.by_solid_angle(p), n, u, u) > 0.0);
/// assert!(reflected(&triangle.by_projected_solid_angle(p, n), n, u, u) > 0.0);
/// ```
pub trait LightSampler<R: Real> {
    /// Draws a direction to the light for `u` in [0, 1)². Lights of one dimension use `u.x`, delta lights neither number. A sample from NaN
    /// has the pdf 0.
    fn sample(&self, u: Vec2<R>) -> LightSample<R>;
    /// Probability density, in the measure of [`LightSample::pdf`], with which [`sample`](Self::sample) draws the unit direction `w`; 0
    /// where it misses the light.
    fn pdf(&self, w: Vec3<R>) -> R;
    /// The same for a unit direction `w` that is known to hit the light, as where a ray of the host has hit it: the light is not intersected
    /// again. Where `w` misses, the result is finite, and of no meaning.
    #[inline(always)]
    fn pdf_of_hit(&self, w: Vec3<R>) -> R {
        self.pdf(w)
    }
    /// The `u` in [0, 1)² that [`sample`](Self::sample) maps to the unit direction `w`; any value in [0, 1)² where `w` misses the light.
    fn invert(&self, w: Vec3<R>) -> Vec2<R>;
    /// The nearest point of the light in the unit direction `w`, with the pdf of that direction; [`LightSample::miss`] where there is none.
    /// Delta lights and lines cannot be hit.
    fn hit(&self, w: Vec3<R>) -> LightSample<R>;
}

/// A light sampled uniformly by its surface area.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct ByArea<S> {
    pub(super) surface: S,
}

impl<S> ByArea<S> {
    /// The surface relative to the point.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn surface(&self) -> &S {
        &self.surface
    }
    /// Surface area, in the square of the unit of the coordinates.
    #[inline(always)]
    pub fn area<R: Real>(&self) -> R
    where
        S: AreaSurface<R>,
    {
        self.surface.area()
    }
}

impl<R: Real, S: AreaSurface<R>> LightSampler<R> for ByArea<S> {
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> LightSample<R> {
        let point = self.surface.draw(u);
        let DirectionSample { direction, distance } = direction_to(point.position);
        let cos = direction.dot(point.normal);
        // of a flat light the direction determines the distance, however small and far it is
        let reach = if S::FLAT { self.surface.at(direction).distance } else { distance };
        let pdf = solid_angle_pdf(reach, cos.abs() * point.inverse_pdf);
        let (emits, delta) = (cos.lt(R::lit(0.0)), R::Mask::splat(false));
        LightSample { direction, distance, pdf, normal: point.normal, uv: point.uv, emits, delta }.drawn_from(u)
    }
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        self.pdf_of_hit(w).keep(self.surface.contains(w))
    }
    #[inline(always)]
    fn pdf_of_hit(&self, w: Vec3<R>) -> R {
        let at = self.surface.at(w);
        solid_angle_pdf(at.distance, w.dot(at.normal).abs() * self.surface.inverse_pdf(at.uv))
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        self.surface.invert(w)
    }
    #[inline(always)]
    fn hit(&self, w: Vec3<R>) -> LightSample<R> {
        found(w, self.pdf(w), &self.surface, None)
    }
}

/// A sample of a surface in a direction.
#[inline(always)]
pub(super) fn drawn<R: Real>(direction: Vec3<R>, pdf: R, at: SurfaceHit<R>, emits: R::Mask) -> LightSample<R> {
    let SurfaceHit { distance, normal, uv } = at;
    LightSample { direction, distance, pdf, normal, uv, emits, delta: R::Mask::splat(false) }
}

/// The point of a surface that a shape has drawn.
#[inline(always)]
fn point_of<R: Real>(
    surface: &impl Surface<R>,
    (DirectionSample { direction, distance }, uv): (DirectionSample<R>, Option<Vec2<R>>),
) -> (Vec3<R>, SurfaceHit<R>) {
    let at = surface.at_distance(direction, distance);
    (direction, SurfaceHit { uv: uv.unwrap_or(at.uv), ..at })
}

/// A pdf, or 0 where it is not finite, since a normal may be of any length.
#[inline(always)]
fn finite<R: Real>(pdf: R) -> R {
    pdf.keep(pdf.lt(R::lit(f64::INFINITY)))
}

/// A hit where the pdf is positive, a miss elsewhere.
#[inline(always)]
pub(super) fn found<R: Real>(w: Vec3<R>, pdf: R, surface: &impl Surface<R>, front: Option<R::Mask>) -> LightSample<R> {
    let some = pdf.gt(R::lit(0.0));
    let at = surface.at(w);
    let front = front.unwrap_or_else(|| w.dot(at.normal).lt(R::lit(0.0)));
    LightSample {
        distance: at.distance.keep(some),
        pdf,
        normal: at.normal,
        uv: at.uv,
        emits: front & some,
        ..LightSample::miss(w)
    }
}

/// A light sampled uniformly by the solid angle it subtends at the shading point.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct BySolidAngle<S, W> {
    pub(super) surface: S,
    pub(super) shape: W,
}

impl<S, W> BySolidAngle<S, W> {
    /// Solid angle of the light in steradians, in [0, 4π].
    #[inline(always)]
    pub fn solid_angle<R: Real>(&self) -> R
    where
        W: SphericalShape<R>,
    {
        self.shape.solid_angle()
    }
}

/// What a sampler by solid angle knows beside the surface.
pub trait SeenShape {
    /// The shape as it is seen from the point.
    type Shape;
    /// That shape alone: what the surface needs is then not prepared.
    fn seen(self) -> Self::Shape;
}
impl<S, W> SeenShape for BySolidAngle<S, W> {
    type Shape = W;
    #[inline(always)]
    fn seen(self) -> W {
        self.shape
    }
}

impl<R: Real, S: Surface<R>, W: SphericalShape<R>> LightSampler<R> for BySolidAngle<S, W> {
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> LightSample<R> {
        let (direction, at) = point_of(&self.surface, self.shape.sample_point(u));
        drawn(direction, self.shape.uniform_pdf(), at, self.shape.in_front()).drawn_from(u)
    }
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        self.shape.pdf(w)
    }
    #[inline(always)]
    fn pdf_of_hit(&self, _: Vec3<R>) -> R {
        self.shape.uniform_pdf()
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        self.shape.invert(w)
    }
    #[inline(always)]
    fn hit(&self, w: Vec3<R>) -> LightSample<R> {
        found(w, self.pdf(w), &self.surface, Some(self.shape.in_front()))
    }
}

/// A light sampled uniformly by the projected solid angle above the horizon of a surface: with a pdf proportional to cosθ.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct ByProjectedSolidAngle<R, S, W> {
    pub(super) normal: Vec3<R>,
    pub(super) surface: S,
    pub(super) shape: W,
}

impl<R: Real, S, W: ProjectedShape<R>> ByProjectedSolidAngle<R, S, W> {
    /// Projected solid angle of the light above the horizon, in [0, π]: the irradiance per unit of radiance.
    #[inline(always)]
    pub fn projected_solid_angle(&self) -> R {
        self.shape.projected_solid_angle()
    }
    /// The pdf of a direction that hits the light.
    #[inline(always)]
    fn density(&self, w: Vec3<R>) -> R {
        finite(self.shape.pdf_at_cosine(w.dot(self.normal)))
    }
}

impl<R: Real, S: Surface<R>, W: ProjectedShape<R>> LightSampler<R> for ByProjectedSolidAngle<R, S, W> {
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> LightSample<R> {
        let (direction, at) = point_of(&self.surface, (self.shape.sample_direction(u), None));
        drawn(direction, self.density(direction), at, self.shape.in_front()).drawn_from(u)
    }
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        self.pdf_of_hit(w).keep(self.shape.contains(w))
    }
    #[inline(always)]
    fn pdf_of_hit(&self, w: Vec3<R>) -> R {
        self.density(w)
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        self.shape.invert(w)
    }
    #[inline(always)]
    fn hit(&self, w: Vec3<R>) -> LightSample<R> {
        found(w, self.pdf(w), &self.surface, Some(self.shape.in_front()))
    }
}

/// A light sampled in proportion to the lobe of a rough surface, above its horizon.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct ByReflection<R, S, W> {
    pub(super) reflection: Reflection<R>,
    pub(super) surface: S,
    /// The light after the map of the reflection.
    pub(super) shape: W,
}

impl<R: Real, S, W: ProjectedShape<R>> ByReflection<R, S, W> {
    /// Projected solid angle of the light above the horizon after the map of the reflection, in [0, π]: π times the part of the lobe that the
    /// light covers.
    #[inline(always)]
    pub fn projected_solid_angle(&self) -> R {
        self.shape.projected_solid_angle()
    }
}

impl<R: Real, S: AreaSurface<R>, W: ProjectedShape<R>> LightSampler<R> for ByReflection<R, S, W> {
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> LightSample<R> {
        let direction = self.reflection.from_cosine(self.shape.sample(u)).unit_and_length().0;
        drawn(direction, self.pdf(direction), self.surface.at(direction), self.shape.in_front()).drawn_from(u)
    }
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        self.pdf_of_hit(w).keep(self.surface.contains(w))
    }
    #[inline(always)]
    fn pdf_of_hit(&self, w: Vec3<R>) -> R {
        // both factors may be large
        let pdf = self.reflection.pdf(w) * quotient(R::lit(PI), self.shape.projected_solid_angle());
        pdf.lesser(R::lit(1e37))
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        self.shape.invert(self.reflection.to_cosine(w).unit_and_length().0)
    }
    #[inline(always)]
    fn hit(&self, w: Vec3<R>) -> LightSample<R> {
        found(w, self.pdf(w), &self.surface, Some(self.shape.in_front()))
    }
}

/// Prepared in scalars and splat, a sampler draws packets of samples for one point.
macro_rules! lanewise_samplers {
    ($($name:ident<$($number:ident,)? ($($part:ident),+)> => $with:ty { $($field:ident),+ })+) => {$(
        impl<R, $($part: Lanewise<R>),+> Lanewise<R> for $name<$($number,)? $($part),+> {
            type With<T> = $with;
            #[inline(always)]
            fn map<T>(self, mut f: impl FnMut(R) -> T) -> Self::With<T> {
                $name { $($field: self.$field.map(&mut f)),+ }
            }
        }
    )+};
}
lanewise_samplers! {
    ByArea<(S)> => ByArea<S::With<T>> { surface }
    BySolidAngle<(S, W)> => BySolidAngle<S::With<T>, W::With<T>> { surface, shape }
    ByProjectedSolidAngle<R, (S, W)> => ByProjectedSolidAngle<T, S::With<T>, W::With<T>> { normal, surface, shape }
    ByReflection<R, (S, W)> => ByReflection<T, S::With<T>, W::With<T>> { reflection, surface, shape }
}
