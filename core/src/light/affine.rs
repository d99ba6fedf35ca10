//! Lights under affine maps.

use super::direction::to_unit;
use super::disk::{Disk, DiskBySolidAngle};
use super::sample::LightSample;
use super::sampler::LightSampler;
use super::sphere::{Sphere, SphereBySolidAngle};
use crate::lanewise::lanewise;
use crate::math::quotient;
use crate::real::Real;
use crate::vector::{Vec2, Vec3};

/// A light shape under an affine map: an ellipsoid is the image of a [`Sphere`], an elliptical disk that of a [`Disk`]. The map takes x, in the
/// coordinates of the shape, to origin + x₀a₀ + x₁a₁ + x₂a₂.
///
/// [`by_solid_angle`](Self::by_solid_angle) samples what the shape samples from the point that is mapped to the shading point.
///
/// - Formula: the unit direction ω of the shape becomes Mω/|Mω|, and pdf = pdf(ω) |Mω|³/|det M| per steradian: uniform by solid angle only
///   where M keeps angles.
/// - Domain: any shape and map, from any side; for other shapes, map their vertices.
/// - Density: that of a sample has the bits of the one of its direction. A direction within the rounding of the edge, times the ratio κ of
///   the greatest to the least stretch of M, may be lost: its pdf is then 0 in both.
/// - Degenerate: a map without volume, or whose determinant is not within 1e±37 in the unit of its greatest coordinate, gives pdf 0.
/// - Greatest error: direction 2⁻²¹κ, pdf 2⁻²⁰κ³ relative, besides those of the shape.
///
/// ```
/// use etendue::{LightSampler, Sphere, Vec2, Vec3, light::Affine};
/// let ball = Sphere::new(Vec3::ZERO, 1.0_f32);
/// let axes = [[2.0, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 1.0]].map(Vec3::lit);
/// let lamp = Affine::new(ball, axes, Vec3::lit([0.0, 3.0, 0.0])).by_solid_angle(Vec3::ZERO);
/// let s = lamp.sample(Vec2::lit([0.0, 0.3])); // the middle of what is seen
/// assert!((s.distance - 2.5).abs() < 1e-5 && s.pdf == lamp.pdf(s.direction));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine<S, R> {
    /// The shape in its own coordinates.
    pub shape: S,
    /// a₀, a₁ and a₂: the images of its axes.
    pub axes: [Vec3<R>; 3],
    /// The image of its origin, in the coordinates of the scene.
    pub origin: Vec3<R>,
}

lanewise! {
    /// A map without its translation, in units in which no coordinate exceeds 2.
    struct Axes {
        x: Vec3<R>,
        y: Vec3<R>,
        z: Vec3<R>,
        /// Rows of the inverse.
        inverse_x: Vec3<R>,
        inverse_y: Vec3<R>,
        inverse_z: Vec3<R>,
        /// 1/|det|; 0 where there is no inverse.
        inverse_volume: R,
        /// That unit.
        unit: R,
    }
}

impl<R: Real> Axes<R> {
    #[inline(always)]
    fn new(axes: [Vec3<R>; 3]) -> Self {
        let ([x, y, z], scale) = to_unit(axes);
        let volume = x.dot(y.cross(z));
        let inverse = quotient(R::lit(1.0), volume);
        Self {
            x,
            y,
            z,
            inverse_x: y.cross(z) * inverse,
            inverse_y: z.cross(x) * inverse,
            inverse_z: x.cross(y) * inverse,
            inverse_volume: inverse.abs(),
            unit: R::lit(1.0) / scale,
        }
    }
    #[inline(always)]
    fn image(&self, v: Vec3<R>) -> Vec3<R> {
        self.x.mul_add(v.x, self.y.mul_add(v.y, self.z * v.z))
    }
    #[inline(always)]
    fn origin_of(&self, w: Vec3<R>) -> Vec3<R> {
        Vec3::new(w.dot(self.inverse_x), w.dot(self.inverse_y), w.dot(self.inverse_z))
    }
    /// The image of a unit normal, not normalised.
    #[inline(always)]
    fn normal(&self, n: Vec3<R>) -> Vec3<R> {
        self.inverse_x.mul_add(n.x, self.inverse_y.mul_add(n.y, self.inverse_z * n.z))
    }
}

impl<S, R: Real> Affine<S, R> {
    /// The shape under the map to `axes` and `origin`.
    #[inline(always)]
    pub fn new(shape: S, axes: [Vec3<R>; 3], origin: Vec3<R>) -> Self {
        Self { shape, axes, origin }
    }
    /// The image of a point of the shape.
    #[inline(always)]
    pub fn image(&self, point: Vec3<R>) -> Vec3<R> {
        let [x, y, z] = self.axes;
        x.mul_add(point.x, y.mul_add(point.y, z.mul_add(point.z, self.origin)))
    }
    /// The prepared map, and the shading point in the shape's coordinates.
    #[inline(always)]
    fn placed(&self, p: Vec3<R>) -> (Axes<R>, Vec3<R>) {
        let axes = Axes::new(self.axes);
        let at = axes.origin_of((p - self.origin) * (R::lit(1.0) / axes.unit));
        (axes, at)
    }
}

macro_rules! affine {
    ($($shape:ident -> $sampler:ident)+) => {$(
        impl<R: Real> Affine<$shape<R>, R> {
            /// As the shape by solid angle, under the map, prepared for the shading point `p`.
            #[inline(always)]
            pub fn by_solid_angle(&self, p: Vec3<R>) -> AffineSampler<$sampler<R>, R> {
                let (axes, p) = self.placed(p);
                AffineSampler { axes, sampler: self.shape.by_solid_angle(p) }
            }
            /// Whether the point `p` is on the light, or in its plane, to within the rounding of its own computation: 16 units of the last
            /// place of the greatest coordinate, by what the map makes of them.
            #[inline(always)]
            pub fn on_surface(&self, p: Vec3<R>) -> R::Mask {
                let (axes, local) = self.placed(p);
                let rows = axes.inverse_x.max_abs() + axes.inverse_y.max_abs() + axes.inverse_z.max_abs();
                self.shape.near(local, (p.max_abs() + self.origin.max_abs()) * (rows / axes.unit))
            }
        }
    )+};
}
affine! {
    Sphere -> SphereBySolidAngle
    Disk -> DiskBySolidAngle
}

/// An [`Affine`] light prepared for a shading point.
#[derive(Clone, Copy, Debug)]
pub struct AffineSampler<S, R> {
    axes: Axes<R>,
    sampler: S,
}

impl<R: Real, S: LightSampler<R>> AffineSampler<S, R> {
    /// The direction in the shape's coordinates, its stretch by the map, and what the pdf there is to be multiplied by.
    #[inline(always)]
    fn local(&self, w: Vec3<R>) -> (Vec3<R>, R, R) {
        let (local, shrink) = self.axes.origin_of(w).unit_and_length();
        let stretch = quotient(R::lit(1.0), shrink);
        (local, stretch, (stretch * stretch) * (stretch * self.axes.inverse_volume))
    }
    /// A sample of the shape, in the scene.
    #[inline(always)]
    fn moved(&self, w: Vec3<R>, local: LightSample<R>, stretch: R, pdf: R) -> LightSample<R> {
        let distance = (local.distance * stretch * self.axes.unit).lesser(R::lit(f64::from(f32::MAX)));
        let some = pdf.gt(R::lit(0.0)) & pdf.lt(R::lit(1e37));
        let normal = self.axes.normal(local.normal).unit_and_length().0;
        LightSample { direction: w, distance, pdf: pdf.keep(some), normal, emits: local.emits & some, ..local }
    }
}

impl<R: Real, S: LightSampler<R>> LightSampler<R> for AffineSampler<S, R> {
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> LightSample<R> {
        let local = self.sampler.sample(u);
        let (w, stretch) = self.axes.image(local.direction).unit_and_length();
        // a point whose coordinates overflow has no direction
        let w = w.keep(w.is_within(R::lit(2.0)));
        let pdf = self.pdf(w).keep(local.pdf.gt(R::lit(0.0)));
        self.moved(w, local, stretch, pdf)
    }
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        let (local, _, factor) = self.local(w);
        let pdf = self.sampler.pdf(local) * factor;
        pdf.keep(pdf.lt(R::lit(1e37)))
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        self.sampler.invert(self.local(w).0)
    }
    #[inline(always)]
    fn hit(&self, w: Vec3<R>) -> LightSample<R> {
        let (local, stretch, _) = self.local(w);
        self.moved(w, self.sampler.hit(local), stretch, self.pdf(w))
    }
}
