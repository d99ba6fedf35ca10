//! Disks.

pub(super) mod area;
pub(super) mod solid_angle;

use super::bound::{LightBound, narrow, wide};
use super::sampler::{ByArea, BySolidAngle};
use crate::lanewise::lanewise;
use crate::real::Real;
use crate::vector::Vec3;
use area::PlacedDisk;
use core::f64::consts::PI;
use solid_angle::SphericalDisk;

lanewise! {
    /// A disk light that emits from the side of its normal.
    ///
    /// Take [`by_solid_angle`](Self::by_solid_angle) unless the disk is small for its distance, where [`by_area`](Self::by_area) is
    /// cheaper and as good. A radius ≤ 0, or a point in the plane of the disk, gives pdf 0. Surface coordinates: (1 + q)/2 for the
    /// position q on the unit disk, along the axes of the [`Frame`](crate::Frame) of the normal.
    pub struct Disk {
        /// Centre, in the coordinates of the scene.
        pub center: Vec3<R>,
        /// Unit normal.
        pub normal: Vec3<R>,
        /// Radius, in the unit of the coordinates.
        pub radius: R,
    }
}

impl<R: Real> Disk<R> {
    /// The disk with this centre, unit normal and radius.
    #[inline(always)]
    pub fn new(center: Vec3<R>, normal: Vec3<R>, radius: R) -> Self {
        Self { center, normal, radius }
    }
    #[inline(always)]
    fn placed(&self, p: Vec3<R>) -> PlacedDisk<R> {
        PlacedDisk::new(self.center - p, self.normal, self.radius)
    }
    /// Uniform over the surface, seen from the point `p`: [`ConcentricDisk`](crate::warp::ConcentricDisk).
    ///
    /// - Formula: x = c + R(q₀s + q₁t), q uniform on the unit disk, s and t perpendicular to the normal.
    /// - Domain: u in [0, 1)²; any unit normal, radius > 0.
    /// - pdf: distance²/(|cosθ'| πR²) per steradian; the tests allow a relative error of (48 + 36/|cosθ'|)·2⁻²⁴.
    /// - Degenerate: a radius of 0, a point in the plane: pdf 0.
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>) -> DiskByArea<R> {
        ByArea { surface: self.placed(p) }
    }
    /// Uniform over the solid angle Ω at the point `p`: pdf 1/Ω per steradian.
    ///
    /// Along the axis of its cone, the boundary projects to an ellipse with the semi-axes sinβ and sinα, at the height D over
    /// the plane of the viewpoint. In terms of its eccentric angle χ from the major axis, dΩ = sinα sinβ dχ/(1+D), which varies
    /// by less than a factor of 2 for every disk. u₀ takes χ through the four quadrants; u₁ goes from the axis outwards,
    /// uniformly in 1−cosθ.
    ///
    /// - Formula: z is the height of the point over the disk's plane, T = d²−R² for the distance d of the centre (both in twice
    ///   the working precision), H = √(T²+4R²z²); cos 2α = T/H, sin 2α = 2Rz/H, tan²β = R²/(H cos²α), axis c − sin²β (c − z n).
    ///   D² = cos²β cos²χ + cos²α sin²χ; with t = tan(χ/2), ∫dχ/(1+D) = ∫ 2 dt/(1+t²+√(cos²β(1−t²)² + 4cos²α t²)), by
    ///   Gauss–Legendre quadrature in t^¼, four panels of 5 nodes (relative error 1e−8 for every disk; in double precision 20
    ///   nodes, 4e−14). Two steps of Newton's method (four in double precision) invert the integral within its panel. 1−cosθ =
    ///   u₁(1−D).
    /// - Domain: u in [0, 1)²; any disk, from either side, with a normal of any length.
    /// - Density: the pdf is 1/Ω per steradian inside (and within 6 to 9 ulp beyond, 17 at the ends of the major axis), 0
    ///   outside. Ω = 4 sinα sinβ ∫₀¹.
    /// - Degenerate input: the point in the disk's plane (on the disk and its rim too), a radius ≤ 0, or Ω < 1e−37 gives pdf 0.
    /// - Greatest error: Ω 4.5e−7 relative; direction 1.8e−7, besides 4 steps of 2⁻²⁴ in u; distance 2e−7 relative, over the
    ///   cosine to the disk's normal.
    /// - Source: Guillén, Ureña, King, Fajardo, Georgiev, López-Moreno and Jarabo, "Area-Preserving Parameterizations for
    ///   Spherical Ellipses", CGF 36(4), 2017, for the polar map; the integral by the eccentric angle and its inverse are
    ///   derived here.
    #[inline(always)]
    pub fn by_solid_angle(&self, p: Vec3<R>) -> DiskBySolidAngle<R> {
        let shape = SphericalDisk::new(self.center - p, self.normal, self.radius);
        BySolidAngle { surface: self.placed(p), shape }
    }
}

impl<R: Real<Scalar = R>> Disk<R> {
    /// What it can contribute with this radiance. One that is not positive gives the power 0.
    #[must_use]
    pub fn bound(&self, radiance: R) -> LightBound {
        let radius = self.radius.lane_f64(0).greater(0.0);
        let flux = PI * PI * radius * radius * radiance.lane_f64(0);
        let normal = narrow(wide(self.normal).unit_and_length().0);
        LightBound { normal, ..LightBound::about(wide(self.center), radius, flux) }
    }
}

/// A [`Disk`] sampled by area from a point.
pub type DiskByArea<R> = ByArea<PlacedDisk<R>>;
/// A [`Disk`] sampled by solid angle from a point.
pub type DiskBySolidAngle<R> = BySolidAngle<PlacedDisk<R>, SphericalDisk<R>>;
