use super::{ConcentricDisk, UniformSphere, Warp, unit_interval};
use crate::math::{atan2_turns, rsqrt};
use crate::real::Real;
use crate::seen::lanewise;
use crate::vector::{Frame, Vec2, Vec3};

/// 1/area, where that is finite.
#[inline(always)]
fn reciprocal<R: Real>(area: R) -> R {
    let some = area.gt(R::lit(1e-37));
    (R::lit(1.0) / R::select(some, area, R::lit(1.0))).keep(some & area.lt(R::lit(1e37)))
}
/// Unit vector and length at any scale.
#[inline(always)]
fn unit_and_length<R: Real>(v: Vec3<R>) -> (Vec3<R>, R) {
    let scale = v.max_abs().exponent_reciprocal();
    let v = v * scale;
    let squared = v.length_squared();
    let inverse = rsqrt(squared).keep(squared.gt(R::lit(0.0)));
    (v * inverse, squared * inverse / scale)
}

lanewise! {
    /// Points of a disk in space, uniform by area: [`ConcentricDisk`] in the [`Frame`] of its normal.
    ///
    /// - Formula: c + R(q₀s + q₁t), q uniform on the unit disk.
    /// - Domain: u in [0, 1)²; any centre, unit normal, radius > 0.
    /// - Density: 1/(πR²) per unit area of the disk, 0 beyond its rim. A point off its plane stands for the one below it. Seen from a
    ///   point at the distance d under the cosine cosθ' to the normal it is d²/|cosθ'| times that per steradian: [`per_steradian`].
    /// - Degenerate: πR² beyond 1e−37 … 1e37: pdf 0.
    /// - Greatest error: 2 ulp of the radius and half one of the coordinates; `invert` as much.
    /// - Source: as [`ConcentricDisk`].
    DiskSurface {
        /// Centre.
        pub center: Vec3<R>,
        /// Unit normal.
        pub normal: Vec3<R>,
        /// Radius.
        pub radius: R,
    }
}
impl<R: Real> DiskSurface<R> {
    #[inline(always)]
    fn local(&self, point: Vec3<R>) -> Vec2<R> {
        let offset = point - self.center;
        let frame = Frame::new(self.normal);
        let some = self.radius.gt(R::lit(0.0));
        let inverse = R::lit(1.0) / R::select(some, self.radius, R::lit(1.0));
        // no further than its square is finite
        let most = R::lit(1e15);
        let part = |x: R| (x * inverse).clamp(-most, most);
        Vec2 { x: part(offset.dot(frame.s)), y: part(offset.dot(frame.t)) }
    }
}
impl<R: Real> Warp<R> for DiskSurface<R> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        let q: Vec2<R> = ConcentricDisk.sample(u);
        let frame = Frame::new(self.normal);
        frame.s.mul_add(q.x * self.radius, frame.t.mul_add(q.y * self.radius, self.center))
    }
    #[inline(always)]
    fn pdf(&self, point: Vec3<R>) -> R {
        let q = self.local(point);
        // coordinates are rounded: as much of the radius
        let slack = R::lit(SLACK) * (self.center.max_abs() + self.radius);
        let most = self.radius.max(R::lit(0.0)) + slack;
        reciprocal(self.radius * self.radius * R::lit(core::f64::consts::PI)).keep((q.length() * self.radius).le(most))
    }
    #[inline(always)]
    fn invert(&self, point: Vec3<R>) -> Vec2<R> {
        let q = self.local(point);
        let inside = R::lit(1.0) / q.length().max(R::lit(1.0));
        ConcentricDisk.invert(q * inside)
    }
}

lanewise! {
    /// Points of the side of a cylinder, without its ends, uniform by area.
    ///
    /// - Formula: p + u₀·axis + R(s cosφ + t sinφ), φ = 2πu₁, s and t perpendicular to the axis.
    /// - Domain: u in [0, 1)²; any axis that is not 0, radius > 0.
    /// - Density: 1/(2πR·|axis|) per unit area between the ends, 0 beyond. A point off the side stands for that of its azimuth. Per
    ///   steradian: [`per_steradian`], with the normal s cosφ + t sinφ.
    /// - Degenerate: an area beyond 1e−37 … 1e37: pdf 0.
    /// - Greatest error: 3 ulp of the radius, one of the length, and half one of the coordinates; `invert` as much.
    /// - Source: cylindrical coordinates.
    CylinderSide {
        /// Centre of one end.
        pub p: Vec3<R>,
        /// From there to the centre of the other end.
        pub axis: Vec3<R>,
        /// Radius.
        pub radius: R,
    }
}
impl<R: Real> CylinderSide<R> {
    /// The unit normal, outwards, at the point for `u`.
    #[inline(always)]
    pub fn normal(&self, u: Vec2<R>) -> Vec3<R> {
        let frame = Frame::new(unit_and_length(self.axis).0);
        let (sin, cos) = u.y.sin_cos_turns();
        frame.s.mul_add(cos, frame.t * sin)
    }
}
impl<R: Real> Warp<R> for CylinderSide<R> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        self.normal(u).mul_add(self.radius, self.axis.mul_add(u.x, self.p))
    }
    #[inline(always)]
    fn pdf(&self, point: Vec3<R>) -> R {
        let (along, length) = unit_and_length(self.axis);
        let height = (point - self.p).dot(along);
        let slack = R::lit(SLACK) * (self.p.max_abs() + self.radius + length);
        let inside = height.ge(-slack) & height.le(length + slack);
        reciprocal(self.radius * length * R::lit(2.0 * core::f64::consts::PI)).keep(inside)
    }
    #[inline(always)]
    fn invert(&self, point: Vec3<R>) -> Vec2<R> {
        let (along, length) = unit_and_length(self.axis);
        let (frame, offset) = (Frame::new(along), point - self.p);
        let some = length.gt(R::lit(0.0));
        let height = offset.dot(along) / R::select(some, length, R::lit(1.0));
        Vec2 { x: unit_interval(height.keep(some)), y: atan2_turns(offset.dot(frame.t), offset.dot(frame.s)) }
    }
}

lanewise! {
    /// Points of a sphere, uniform by area: its centre and R times a direction of [`UniformSphere`].
    ///
    /// - Domain: u in [0, 1)²; any centre, radius > 0.
    /// - Density: 1/(4πR²) per unit area. A point off the sphere stands for that on its radius. Per steradian: [`per_steradian`], with
    ///   the normal (x−c)/R.
    /// - Degenerate: 4πR² beyond 1e−37 … 1e37: pdf 0.
    /// - Greatest error: 3 ulp of the radius and half one of the coordinates; `invert` as much.
    /// - Source: as [`UniformSphere`].
    SphereSurface {
        /// Centre.
        pub center: Vec3<R>,
        /// Radius.
        pub radius: R,
    }
}
impl<R: Real> Warp<R> for SphereSurface<R> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        let normal: Vec3<R> = UniformSphere.sample(u);
        normal.mul_add(self.radius, self.center)
    }
    #[inline(always)]
    fn pdf(&self, _: Vec3<R>) -> R {
        reciprocal(self.radius * self.radius * R::lit(4.0 * core::f64::consts::PI))
    }
    #[inline(always)]
    fn invert(&self, point: Vec3<R>) -> Vec2<R> {
        UniformSphere.invert(unit_and_length(point - self.center).0)
    }
}

/// What coordinates may be off by, as a part of the greatest: 4 ulp.
const SLACK: f64 = 4.0 / 16_777_216.0;

/// A density per unit area as one per steradian, seen from the origin: `pdf` · |x|²/|cosθ'|, for the point x relative to the viewpoint and
/// the unit normal there; 0 edge-on, or where it is not finite.
#[inline(always)]
pub fn per_steradian<R: Real>(pdf: R, point: Vec3<R>, normal: Vec3<R>) -> R {
    let (direction, distance) = unit_and_length(point);
    let cos = direction.dot(normal).abs();
    let some = cos.gt(R::lit(0.0));
    let density = pdf * distance * (distance / R::select(some, cos, R::lit(1.0)));
    density.keep(some & density.lt(R::lit(1e37)))
}
