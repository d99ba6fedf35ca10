use super::{LightSample, direction_to, flat_by_area, solid_angle_pdf};
use crate::lanewise::lanewise;
use crate::real::{Mask, Real};
use crate::spherical::{DirectionSample, SphericalDisk};
use crate::vector::{Frame, Vec2, Vec3};
use crate::warp::{ConcentricDisk, Warp};

lanewise! {
    /// A disk that emits on the side of its normal.
    pub struct Disk {
        /// Centre.
        pub center: Vec3<R>,
        /// Unit normal.
        pub normal: Vec3<R>,
        /// Radius.
        pub radius: R,
    }
}

impl<R: Real> Disk<R> {
    /// Uniform over the surface, [`ConcentricDisk`].
    ///
    /// - Formula: x = c + R(q₀s + q₁t), q uniform on the unit disk, s and t perpendicular to the normal.
    /// - Domain: u in [0, 1)²; any unit normal, radius > 0.
    /// - Density: distance²/(|cosθ'| πR²) per steradian.
    /// - Degenerate: a radius of 0, a point in the plane: pdf 0.
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>, u: Vec2<R>) -> LightSample<R> {
        let q: Vec2<R> = ConcentricDisk.sample(u);
        let frame = Frame::new(self.normal);
        let offset = frame.s * (q.x * self.radius) + frame.t * (q.y * self.radius);
        let area = self.radius * self.radius * R::lit(core::f64::consts::PI);
        flat_by_area((self.center - p) + offset, self.normal * area)
    }
    /// Uniform over the solid angle, [`SphericalDisk`]: every sample that the plane of the surface does not hide is worth its cosine.
    #[inline(always)]
    pub fn by_solid_angle(&self, p: Vec3<R>, u: Vec2<R>) -> LightSample<R> {
        let seen = SphericalDisk::new(self.center - p, self.normal, self.radius);
        let DirectionSample { direction, distance } = seen.sample_direction(u);
        LightSample {
            direction,
            distance,
            pdf: seen.uniform_pdf(),
            emits: seen.in_front(),
            delta: R::Mask::splat(false),
        }
    }
}

lanewise! {
    /// The side of a cylinder, without its ends, that emits outwards.
    pub struct Cylinder {
        /// Centre of one end.
        pub p: Vec3<R>,
        /// From there to the centre of the other end.
        pub axis: Vec3<R>,
        /// Radius.
        pub radius: R,
    }
}

impl<R: Real> Cylinder<R> {
    /// Uniform over the surface: half of it and more faces away.
    ///
    /// - Formula: x = p + u₀·axis + R(s cosφ + t sinφ), φ = 2πu₁, s and t perpendicular to the axis.
    /// - Domain: u in [0, 1)²; any axis that is not 0, radius > 0.
    /// - Density: distance²/(|cosθ'| 2πR·|axis|) per steradian.
    /// - Degenerate: a radius or axis of 0: pdf 0.
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>, u: Vec2<R>) -> LightSample<R> {
        let DirectionSample { direction: along, distance: length } = direction_to(self.axis);
        let frame = Frame::new(along);
        let (sin, cos) = u.y.sin_cos_turns();
        let normal = frame.s * cos + frame.t * sin;
        let point = self.axis.mul_add(u.x, self.p - p) + normal * self.radius;
        let DirectionSample { direction, distance } = direction_to(point);
        let cos = direction.dot(normal);
        let area = self.radius * length * R::lit(2.0 * core::f64::consts::PI);
        let pdf = solid_angle_pdf(distance, cos.abs() * area);
        LightSample { direction, distance, pdf, emits: cos.lt(R::lit(0.0)), delta: R::Mask::splat(false) }
    }
}
