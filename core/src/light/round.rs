//! Spheres, disks and cylinders.

use super::cylinder::PlacedCylinder;
use super::sampler::{ByArea, ByProjectedSolidAngle, BySolidAngle};
use super::surface::{PlacedDisk, PlacedSphere};
use crate::lanewise::lanewise;
use crate::real::Real;
use crate::spherical::{ProjectedCap, SphericalCap, SphericalDisk};
use crate::vector::Vec3;

lanewise! {
    /// A sphere light that emits outwards.
    ///
    /// Take [`by_solid_angle`](Self::by_solid_angle), or [`by_projected_solid_angle`](Self::by_projected_solid_angle) on diffuse
    /// surfaces; [`by_area`](Self::by_area) wastes more than half of its samples. A radius ≤ 0 gives pdf 0; from inside every direction
    /// hits the sphere and `emits` is false.
    ///
    /// ```
    /// use etendue::{LightSampler, Sphere, Vec2};
    /// let bulb = Sphere::new([0.0, 3.0, 0.0].into(), 0.5_f32).by_solid_angle([0.0; 3].into());
    /// let s = bulb.sample(Vec2::new(0.3, 0.6));
    /// assert!(s.valid() && s.distance >= 2.5 && bulb.hit(s.direction).valid());
    /// ```
    ///
    /// Surface coordinates: those that [`UniformSphere`](crate::warp::UniformSphere) maps to the normal.
    pub struct Sphere {
        /// Centre, in the coordinates of the scene.
        pub center: Vec3<R>,
        /// Radius, in the unit of the coordinates.
        pub radius: R,
    }
}

impl<R: Real> Sphere<R> {
    /// The sphere with this centre and radius.
    #[inline(always)]
    pub fn new(center: Vec3<R>, radius: R) -> Self {
        Self { center, radius }
    }
    #[inline(always)]
    fn placed(&self, p: Vec3<R>) -> PlacedSphere<R> {
        PlacedSphere::new(self.center - p, self.radius)
    }
    /// Uniform over the surface: (1 + R/d)/2 of the samples, at the distance d, face away and have `emits` false.
    ///
    /// - pdf of a sample: distance²/(|cosθ'| 4πR²) per steradian, of the point that was drawn.
    /// - pdf of a direction: that of the nearest point in it, which a rounded direction determines only as well as it
    ///   determines the point.
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>) -> SphereByArea<R> {
        ByArea { origin: p, surface: self.placed(p) }
    }
    /// Uniform over the cone of directions Ω at the point `p`, [`SphericalCap`]: every sample hits the near side; pdf 1/Ω per steradian.
    #[inline(always)]
    pub fn by_solid_angle(&self, p: Vec3<R>) -> SphereBySolidAngle<R> {
        let shape = SphericalCap::new(self.center - p, self.radius);
        BySolidAngle { origin: p, surface: self.placed(p), shape }
    }
    /// Uniform over the projected solid angle Ω⊥ above the horizon of the unit normal `n` at the point `p`, [`ProjectedCap`]: pdf cosθ/Ω⊥
    /// per steradian, 0 where nothing of the sphere is above the horizon. On an unoccluded diffuse surface every sample has the same
    /// value.
    #[inline(always)]
    pub fn by_projected_solid_angle(&self, p: Vec3<R>, n: Vec3<R>) -> SphereByProjectedSolidAngle<R> {
        let shape = ProjectedCap::new(self.center - p, self.radius, n);
        ByProjectedSolidAngle { origin: p, normal: n, surface: self.placed(p), shape }
    }
}

/// A [`Sphere`] sampled by area from a point.
pub type SphereByArea<R> = ByArea<R, PlacedSphere<R>>;
/// A [`Sphere`] sampled by solid angle from a point.
pub type SphereBySolidAngle<R> = BySolidAngle<R, PlacedSphere<R>, SphericalCap<R>>;
/// A [`Sphere`] sampled by projected solid angle from a point on a surface.
pub type SphereByProjectedSolidAngle<R> = ByProjectedSolidAngle<R, PlacedSphere<R>, ProjectedCap<R>>;

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
        ByArea { origin: p, surface: self.placed(p) }
    }
    /// Uniform over the solid angle Ω at the point `p`, [`SphericalDisk`]: pdf 1/Ω per steradian.
    #[inline(always)]
    pub fn by_solid_angle(&self, p: Vec3<R>) -> DiskBySolidAngle<R> {
        let shape = SphericalDisk::new(self.center - p, self.normal, self.radius);
        BySolidAngle { origin: p, surface: self.placed(p), shape }
    }
}

/// A [`Disk`] sampled by area from a point.
pub type DiskByArea<R> = ByArea<R, PlacedDisk<R>>;
/// A [`Disk`] sampled by solid angle from a point.
pub type DiskBySolidAngle<R> = BySolidAngle<R, PlacedDisk<R>, SphericalDisk<R>>;

lanewise! {
    /// The side of a cylinder, without its ends, that emits outwards.
    ///
    /// It is sampled by area only, and more than half of it faces away: for thin tubes take a [`Line`](super::Line). A radius ≤ 0 or an
    /// axis of length 0 gives pdf 0. Surface coordinates: height along the axis, and azimuth in turns.
    pub struct Cylinder {
        /// Centre of one end, in the coordinates of the scene.
        pub p: Vec3<R>,
        /// From there to the centre of the other end.
        pub axis: Vec3<R>,
        /// Radius, in the unit of the coordinates.
        pub radius: R,
    }
}

impl<R: Real> Cylinder<R> {
    /// The cylinder from the end at `p` along `axis`.
    #[inline(always)]
    pub fn new(p: Vec3<R>, axis: Vec3<R>, radius: R) -> Self {
        Self { p, axis, radius }
    }
    /// Uniform over the surface, seen from the point `p`.
    ///
    /// - Formula: x = p + u₀·axis + R(s cosφ + t sinφ), φ = 2πu₁, s and t perpendicular to the axis.
    /// - Domain: u in [0, 1)²; any axis that is not 0, radius > 0.
    /// - pdf of a sample: distance²/(|cosθ'| 2πR·|axis|) per steradian, of the point that was drawn; of a direction: that of the nearest
    ///   point in it, which a rounded direction determines only as well as it
    ///   determines the point.
    /// - Degenerate: a radius or axis of 0: pdf 0.
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>) -> CylinderByArea<R> {
        ByArea { origin: p, surface: PlacedCylinder::new(self.p - p, self.axis, self.radius) }
    }
}

/// A [`Cylinder`] sampled by area from a point.
pub type CylinderByArea<R> = ByArea<R, PlacedCylinder<R>>;
