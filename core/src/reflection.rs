//! The light that rough surfaces reflect, as a cosine after a linear map.
//!
//! A diffuse surface weights light by cosθ, which has closed forms and samplers for flat lights and spheres. A linear map of the directions
//! carries both over to the lobe of a rough surface: [`Reflection`] is the map, fitted to GGX. What a light of radiance L adds to the
//! reflected radiance is about F · albedo · L · Ω⊥/π, with the projected solid angle Ω⊥ of the light after the map
//! ([`Reflection::sphere`], `projected_solid_angle` of samplers `by_reflection`); and a sample of the mapped light varies
//! little beside visibility (`by_reflection` of flat lights and spheres). Both are exact for the fit, but for samples of spheres, so that the
//! difference between GGX and the fit can be sampled besides.
//!
//! How near the fit is depends on the view. It was compared with quadratures for square lights of 1° to 64°
//! and α from 0.01 to 0.8. For views with a cosine from 0.95, 0.7, 0.3 and 0.1, the closed form is off by up to 0.04, 0.13, 0.3 and 0.81 of
//! what is reflected of a light in the mirror direction, and by up to 0.009, 0.031, 0.065 and 0.11 of what would be of white surroundings,
//! wherever the light is. So it may be quite wrong about the faint light of lamps far from the lobe, at worst on the horizon. The standard
//! deviation of a sample by `by_reflection`, relative to its mean, is up to 0.1, 0.13, 0.45 and 0.93, and on the horizon up to 1.1; for
//! small lights there, samples by projected solid angle vary less.
//!
//! ```
//! use etendue::{LightSampler, Parallelogram, Vec2, Vec3, reflection::Reflection};
//! // a panel that a floor of roughness 0.2 reflects to a viewer at 45°
//! let panel = Parallelogram::new([-2.0, 1.0, -1.0].into(), [0.0, 2.0, 0.0].into(), [0.0, 0.0, 2.0_f32].into());
//! let (p, up) = (Vec3::default(), Vec3::new(0.0, 1.0, 0.0));
//! let floor = Reflection::new(0.2_f32, up, Vec3::new(0.5_f32.sqrt(), 0.5_f32.sqrt(), 0.0));
//! let sampler = panel.by_reflection(p, &floor);
//! let seen = floor.albedo() * sampler.projected_solid_angle() / std::f32::consts::PI;
//! assert!(seen > 0.4 && seen < 1.0);
//! assert!(sampler.sample(Vec2::new(0.3, 0.6)).valid());
//! ```

mod table;

use crate::lanewise::lanewise;
use crate::real::{Real, Uint};
use crate::vector::{Frame, Vec2, Vec3};
use crate::warp::{CosineHemisphere, Warp};
use core::f64::consts::FRAC_1_PI;
use table::{SIDE, TABLE};

/// Heights of a view below this, as a cosine, count as this.
const LEAST_COSINE: f64 = 1e-6;

lanewise! {
    /// The lobe of a GGX surface of the same roughness in all directions, seen from one direction: a cosine after a linear map.
    ///
    /// Call `Reflection::new(alpha, normal, view)` with unit vectors, then `sample` a direction in the space of the vectors, or give the
    /// reflection to `by_reflection` of a light.
    ///
    /// ```
    /// use etendue::{Vec2, Vec3, Warp, reflection::Reflection};
    /// let floor = Reflection::new(0.1_f32, Vec3::new(0.0, 0.0, 1.0), Vec3::new(0.6, 0.0, 0.8));
    /// let w = floor.sample(Vec2::new(0.1, 0.2));
    /// // near the mirror direction, above the surface
    /// assert!(w.z > 0.0 && w.dot(Vec3::new(-0.6, 0.0, 0.8)) > 0.9);
    /// ```
    ///
    /// - Formula: in the frame of the surface, with the view in the half plane x > 0, y = 0, the map is (x, y, z) → w′ = (a(x + bz), cy, z).
    ///   It keeps heights, so that the horizon stays the horizon and all of the lobe is above it. A table of 16 × 16 cells, by √α and √cosθ of
    ///   the view, holds a, b and c, the albedo and the mean Fresnel weight, and is interpolated bilinearly.
    /// - Domain: α from 3e−4 to 1 (others count as the nearest of these, NaN as the least), u in [0, 1)².
    /// - Density: the pdf is acz/(π|w′|⁴) per steradian, which integrates to 1 over the hemisphere; 0 below the horizon.
    /// - Fit: a, b and c have the least ∫(f − g)²/g, where f is GGX with correlated masking, divided by its albedo, and g the pdf. Its root, the
    ///   standard deviation of f/g, is 0.04 to 0.2 where the view has a cosine over 0.8, up to 0.6 at cosines of 0.2, and more at grazing
    ///   views of smooth surfaces, up to 9. As f/g stays finite, estimates by samples stay unbiased. The test
    ///   `no_transform_nearby_fits_better` prints it.
    /// - Degenerate input: a view below the horizon counts as one on the horizon, and has albedo 0.
    /// - Greatest error: the inverse is within 8 steps of 2⁻²⁴ of u, or that of a direction 2e−6 away times what the inverse of the map
    ///   stretches there, which is much for grazing views alone.
    /// - Source: Heitz, Dupuy, Hill and Neubelt, "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines", ACM TOG 35(4), 2016,
    ///   sections 3 and 4, with a map that keeps heights; for GGX, Heitz 2014, equations 72 and 99.
    pub struct Reflection {
        /// Tangents in and across the plane of incidence, and the normal.
        frame: Frame<R>,
        a: R,
        b: R,
        c: R,
        inverse_a: R,
        inverse_c: R,
        albedo: R,
        schlick: R,
    }
}

/// The numbers of the fit, row by row, as [`Reflection::with_table`] reads them.
#[doc(hidden)]
#[inline]
#[must_use]
pub fn table() -> &'static [f32] {
    TABLE.as_flattened().as_flattened()
}

/// The five numbers at these places, each in [0, 1], of a table of which `number` reads one.
#[inline(always)]
fn look_up<R: Real>(number: impl Fn(R::Uint) -> R, row: R, column: R) -> [R; 5] {
    let place = |x: R| {
        let at = x.clamped(R::lit(0.0), R::lit(1.0)) * R::lit((SIDE - 1) as f64);
        let index = at.lesser(R::lit(SIDE as f64 - 1.5)).to_uint();
        (index, at - R::from_uint(index))
    };
    let ((i, y), (j, x)) = (place(row), place(column));
    let cell = i.wrapping_mul(R::Uint::splat(SIDE as u32)).wrapping_add(j);
    let corner = cell.wrapping_mul(R::Uint::splat(5));
    core::array::from_fn(|k| {
        let at = |down: usize, right: usize| {
            let place = (down * SIDE + right) * 5 + k;
            number(corner.wrapping_add(R::Uint::splat(place as u32)))
        };
        let mix = |from: R, to: R, part: R| (to - from).mul_add(part, from);
        mix(mix(at(0, 0), at(0, 1), x), mix(at(1, 0), at(1, 1), x), y)
    })
}

impl<R: Real> Reflection<R> {
    /// Prepares for the roughness α, the unit normal of a surface, and the unit vector towards the viewer.
    #[inline(always)]
    pub fn new(alpha: R, normal: Vec3<R>, view: Vec3<R>) -> Self {
        let number = |index: R::Uint| {
            R::from_fn(|lane| {
                let number = table().get(index.lane(lane) as usize).copied().unwrap_or(0.0);
                R::Scalar::lit(f64::from(number))
            })
        };
        Self::with_table(number, alpha, normal, view)
    }
    /// As [`new`](Self::new), where `number` reads one of the numbers of [`table`] by its index.
    #[doc(hidden)]
    #[inline(always)]
    pub fn with_table(number: impl Fn(R::Uint) -> R, alpha: R, normal: Vec3<R>, view: Vec3<R>) -> Self {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let cos = view.dot(normal);
        let along = normal.mul_add(-cos, view);
        let sine = along.length();
        let any = Frame::new(normal);
        let some = sine.gt(R::lit(1e-6));
        let s = Vec3::blend(some, along * (one / R::blend(some, sine, one)), any.s);
        let frame = Frame { s, t: normal.cross(s), n: normal };
        let above = cos.gt(zero);
        let cos = cos.lesser(one).greater(R::lit(LEAST_COSINE));
        let least = 0.25 / (SIDE - 1) as f64;
        let alpha = alpha.clamped(R::lit(least * least), one);
        let [fourth_root, slope, across, albedo, schlick] = look_up(number, alpha.sqrt(), cos.sqrt());
        let (square, double) = (fourth_root * fourth_root, alpha + alpha);
        let (a, c) = (square * square / double, across / double);
        Self {
            frame,
            a,
            b: slope * (sine / cos),
            c,
            inverse_a: one / a,
            inverse_c: one / c,
            albedo: albedo.lesser(one).keep(above),
            schlick,
        }
    }
    /// The part of light from all directions alike that the surface reflects with a Fresnel factor of 1, in [0, 1]: ∫ f cosθ. What is missing
    /// to 1 would be reflected again by the microsurface. To 0.004, except for views within 6° of the horizon.
    #[inline(always)]
    pub fn albedo(&self) -> R {
        self.albedo
    }
    /// The mean of Schlick's weight (1 − v·m)⁵ over the lobe, in [0, 1]: with the reflectance F₀ at normal incidence, the surface reflects
    /// about albedo · (F₀ + (1 − F₀) · this) of light from all directions alike.
    #[inline(always)]
    pub fn schlick(&self) -> R {
        self.schlick
    }
    /// The rows of the matrix of [`to_cosine`](Self::to_cosine).
    #[inline(always)]
    pub(crate) fn rows(&self) -> [Vec3<R>; 3] {
        let Frame { s, t, n } = self.frame;
        [n.mul_add(self.b, s) * self.a, t * self.c, n]
    }
    /// The normal of the surface.
    #[inline(always)]
    pub(crate) fn normal(&self) -> Vec3<R> {
        self.frame.n
    }
    /// The determinant of the map.
    #[inline(always)]
    pub(crate) fn determinant(&self) -> R {
        self.a * self.c
    }
    /// The linear map, from the space of the vectors given to the one where the lobe is a cosine about z. Lengths change.
    #[inline(always)]
    pub fn to_cosine(&self, v: Vec3<R>) -> Vec3<R> {
        let Vec3 { x, y, z } = self.frame.to_local(v);
        Vec3::new(self.a * self.b.mul_add(z, x), self.c * y, z)
    }
    /// The inverse of [`to_cosine`](Self::to_cosine).
    #[inline(always)]
    pub fn from_cosine(&self, v: Vec3<R>) -> Vec3<R> {
        let x = v.x.mul_add(self.inverse_a, -(self.b * v.z));
        self.frame.to_world(Vec3::new(x, v.y * self.inverse_c, v.z))
    }
}

impl<R: Real> Warp<R> for Reflection<R> {
    type Point = Vec3<R>;
    /// A unit vector above the horizon, in the space of the vectors given.
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        self.from_cosine(CosineHemisphere.sample(u)).unit_and_length().0
    }
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        let Vec3 { x, y, z } = self.to_cosine(w);
        let square = x.mul_add(x, y.mul_add(y, z * z));
        let some = square.gt(R::lit(1e-18));
        let inverse = R::lit(1.0) / R::blend(some, square, R::lit(1.0));
        let pdf = z * (self.a * self.c) * (inverse * inverse) * R::lit(FRAC_1_PI);
        // below the horizon it is negative, and NaN if the vector is too long to be a direction
        pdf.keep(some).greater(R::lit(0.0))
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        CosineHemisphere.invert(self.to_cosine(w).unit_and_length().0)
    }
}
