use super::{Bilinear, ConcentricDisk, UniformSphere, Warp};
use crate::lanewise::lanewise;
use crate::math::atan2_turns;
use crate::real::{Real, unit_interval};
use crate::vector::{Frame, Vec2, Vec3};

/// 1/area, or 0 where that is not finite.
#[inline(always)]
fn reciprocal<R: Real>(area: R) -> R {
    let some = area.gt(R::lit(1e-37));
    (R::lit(1.0) / R::blend(some, area, R::lit(1.0))).keep(some & area.lt(R::lit(1e37)))
}
/// Clamps each component to the range of f32, for a point that does not fit it.
#[inline(always)]
fn finite<R: Real>(point: Vec3<R>) -> Vec3<R> {
    let most = R::lit(f64::from(f32::MAX));
    let within = |x: R| x.clamped(-most, most);
    Vec3::new(within(point.x), within(point.y), within(point.z))
}

lanewise! {
    /// Points of a disk in space, uniform in area: [`ConcentricDisk`] in the [`Frame`] of its normal. Take it for far, small or
    /// textured disks, and [`SphericalDisk`](crate::spherical::SphericalDisk) for others.
    ///
    /// Set the fields, then call `sample`, `pdf` or `invert`. An area that is 0 or not representable gives pdf 0.
    ///
    /// - Formula: c + R(q₀s + q₁t), q uniform on the unit disk.
    /// - Domain: u in [0, 1)²; any centre, unit normal, radius > 0.
    /// - Density: the pdf is 1/(πR²) per unit area of the disk, 0 beyond its rim. A point off the plane counts as its
    ///   projection onto it. From a point at the distance d, whose direction makes the cosine cosθ' with the normal, the pdf
    ///   per steradian is d²/|cosθ'| times that: see [`per_steradian`].
    /// - Degenerate input: πR² outside 1e−37 … 1e37 gives pdf 0.
    /// - Greatest error: 2 ulp of the radius and half an ulp of the coordinates; the same for `invert`.
    /// - Source: as for [`ConcentricDisk`].
    pub struct DiskSurface {
        /// Centre, in any unit of length.
        pub center: Vec3<R>,
        /// Unit normal of the disk's plane.
        pub normal: Vec3<R>,
        /// Radius R > 0, in the unit of `center`.
        pub radius: R,
    }
}
impl<R: Real> DiskSurface<R> {
    #[inline(always)]
    fn local(&self, point: Vec3<R>) -> Vec2<R> {
        let offset = point - self.center;
        let frame = Frame::new(self.normal);
        let some = self.radius.gt(R::lit(0.0));
        let inverse = R::lit(1.0) / R::blend(some, self.radius, R::lit(1.0));
        // clamped so that its square is finite
        let most = R::lit(1e15);
        let part = |x: R| (x * inverse).clamped(-most, most);
        Vec2 { x: part(offset.dot(frame.s)), y: part(offset.dot(frame.t)) }
    }
}
impl<R: Real> Warp<R> for DiskSurface<R> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        let q: Vec2<R> = ConcentricDisk.sample(u);
        let frame = Frame::new(self.normal);
        finite(frame.s.mul_add(q.x * self.radius, frame.t.mul_add(q.y * self.radius, self.center)))
    }
    /// The pdf per unit area of the disk.
    #[inline(always)]
    fn pdf(&self, point: Vec3<R>) -> R {
        let q = self.local(point);
        // coordinates are rounded, so allow for that
        let slack = R::lit(SLACK) * (self.center.max_abs() + self.radius);
        let most = self.radius.greater(R::lit(0.0)) + slack;
        reciprocal(self.radius * self.radius * R::lit(core::f64::consts::PI)).keep((q.length() * self.radius).le(most))
    }
    #[inline(always)]
    fn invert(&self, point: Vec3<R>) -> Vec2<R> {
        let q = self.local(point);
        let inside = R::lit(1.0) / q.length().greater(R::lit(1.0));
        ConcentricDisk.invert(q * inside)
    }
}

lanewise! {
    /// Points of the side of a cylinder, without its ends, uniform in area: for tubes.
    ///
    /// Set the fields, then call `sample`, `pdf` or `invert`; [`normal`](Self::normal) gives the normal there. An area that is
    /// 0 or not representable gives pdf 0.
    ///
    /// - Formula: p + u₀·axis + R(s cosφ + t sinφ), φ = 2πu₁, s and t perpendicular to the axis.
    /// - Domain: u in [0, 1)²; any nonzero axis, radius > 0.
    /// - Density: the pdf is 1/(2πR·|axis|) per unit area between the ends, 0 beyond. A point off the side counts as the point
    ///   of the side at its height and azimuth. [`per_steradian`] converts, with the normal s cosφ + t sinφ.
    /// - Degenerate input: an area outside 1e−37 … 1e37 gives pdf 0.
    /// - Greatest error: 3 ulp of the radius, one of the length, and half an ulp of the coordinates; the same for `invert`.
    /// - Source: cylindrical coordinates.
    pub struct CylinderSide {
        /// Centre of one end, in any unit of length.
        pub p: Vec3<R>,
        /// Vector from `p` to the centre of the other end; not 0.
        pub axis: Vec3<R>,
        /// Radius R > 0, in the unit of `p`.
        pub radius: R,
    }
}
impl<R: Real> CylinderSide<R> {
    /// The outward unit normal at the point for `u`.
    #[inline(always)]
    pub fn normal(&self, u: Vec2<R>) -> Vec3<R> {
        let frame = Frame::new(self.axis.unit_and_length().0);
        let (sin, cos) = u.y.sin_cos_turns();
        frame.s.mul_add(cos, frame.t * sin)
    }
}
impl<R: Real> Warp<R> for CylinderSide<R> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        finite(self.normal(u).mul_add(self.radius, self.axis.mul_add(u.x, self.p)))
    }
    /// The pdf per unit area of the side.
    #[inline(always)]
    fn pdf(&self, point: Vec3<R>) -> R {
        let (along, length) = self.axis.unit_and_length();
        let height = (point - self.p).dot(along);
        let slack = R::lit(SLACK) * (self.p.max_abs() + self.radius + length);
        let inside = height.ge(-slack) & height.le(length + slack);
        reciprocal(self.radius * length * R::lit(2.0 * core::f64::consts::PI)).keep(inside)
    }
    #[inline(always)]
    fn invert(&self, point: Vec3<R>) -> Vec2<R> {
        let (along, length) = self.axis.unit_and_length();
        let (frame, offset) = (Frame::new(along), point - self.p);
        let some = length.gt(R::lit(0.0));
        let height = offset.dot(along) / R::blend(some, length, R::lit(1.0));
        Vec2 { x: unit_interval(height.keep(some)), y: atan2_turns(offset.dot(frame.t), offset.dot(frame.s)) }
    }
}

lanewise! {
    /// Points of a sphere, uniform in area: its centre plus R times a direction of [`UniformSphere`]. Take it from inside; from
    /// outside, half the points face away.
    ///
    /// Set the fields, then call `sample`, `pdf` or `invert`. An area that is 0 or not representable gives pdf 0.
    ///
    /// - Formula: c + Rw, w uniform over the directions.
    /// - Domain: u in [0, 1)²; any centre, radius > 0.
    /// - Density: the pdf is 1/(4πR²) per unit area. A point off the sphere counts as the point of the sphere on the same
    ///   radius. [`per_steradian`] converts, with the normal (x−c)/R.
    /// - Degenerate input: 4πR² outside 1e−37 … 1e37 gives pdf 0.
    /// - Greatest error: 3 ulp of the radius and half an ulp of the coordinates; the same for `invert`.
    /// - Source: as for [`UniformSphere`].
    pub struct SphereSurface {
        /// Centre, in any unit of length.
        pub center: Vec3<R>,
        /// Radius R > 0, in the unit of `center`.
        pub radius: R,
    }
}
impl<R: Real> Warp<R> for SphereSurface<R> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        let normal: Vec3<R> = UniformSphere.sample(u);
        finite(normal.mul_add(self.radius, self.center))
    }
    /// The pdf per unit area of the sphere.
    #[inline(always)]
    fn pdf(&self, _: Vec3<R>) -> R {
        reciprocal(self.radius * self.radius * R::lit(4.0 * core::f64::consts::PI))
    }
    #[inline(always)]
    fn invert(&self, point: Vec3<R>) -> Vec2<R> {
        UniformSphere.invert((point - self.center).unit_and_length().0)
    }
}

/// Rounding of coordinates, relative to the largest: 4 ulp.
const SLACK: f64 = 4.0 / 16_777_216.0;

/// Converts a pdf per unit area to one per steradian: `pdf` · |x|²/|cosθ'|.
///
/// `point` is x relative to the viewpoint, and θ' is the angle between x and the unit normal `normal` there. Returns 0 edge-on,
/// or where the result is not finite.
#[inline(always)]
pub fn per_steradian<R: Real>(pdf: R, point: Vec3<R>, normal: Vec3<R>) -> R {
    let (direction, distance) = point.unit_and_length();
    let cos = direction.dot(normal).abs();
    let some = cos.gt(R::lit(0.0));
    let density = pdf * distance * (distance / R::blend(some, cos, R::lit(1.0)));
    density.keep(some & density.lt(R::lit(1e37)))
}

lanewise! {
    /// Points of a bilinear patch p + su + tv + st(w − u − v), s and t in [0, 1], nearly uniform in area: for twisted quads.
    ///
    /// Set the four corners, then call `sample`, `pdf` or `invert`. A patch without area gives pdf 0.
    ///
    /// - Formula: (s, t) from the [`Bilinear`] distribution whose corner values are the patch's area per unit of s and t there,
    ///   |∂s×∂t|.
    /// - Domain: u in [0, 1)²; corners p, p+u, p+v, p+w, planar or not, of a patch that does not fold back on itself: along its
    ///   middle normal, it projects to a convex quadrilateral.
    /// - Density: the pdf per unit area is that of (s, t) over the exact |∂s×∂t| (not over its bilinear approximation); 0
    ///   beyond the edges. It is constant on a parallelogram. A point off the patch counts as one near it. [`per_steradian`]
    ///   converts, with [`normal`](Self::normal).
    /// - Degenerate input: no area, or |∂s×∂t| outside 1e−37 … 1e37, gives pdf 0.
    /// - Greatest error: 6 steps of 2⁻²⁴ in (s, t) and half an ulp of the coordinates; the pdf 5e−7 relative, times the ratio
    ///   of the longest side to the shortest. `invert` solves a quadratic equation for s and takes two Gauss–Newton steps, with
    ///   the same error.
    /// - Source: Pharr, Jakob and Humphreys, PBR 4th ed., 6.6.
    pub struct PatchSurface {
        /// Corner s = t = 0, in any unit of length.
        pub p: Vec3<R>,
        /// Vector from `p` to the corner s = 1, t = 0, in the unit of `p`.
        pub u: Vec3<R>,
        /// Vector from `p` to the corner s = 0, t = 1, in the unit of `p`.
        pub v: Vec3<R>,
        /// Vector from `p` to the opposite corner s = t = 1, in the unit of `p`.
        pub w: Vec3<R>,
    }
}
impl<R: Real> PatchSurface<R> {
    #[inline(always)]
    fn twist(&self) -> Vec3<R> {
        (self.w - self.u) - self.v
    }
    /// The normal ∂s×∂t at (s, t), not normalised.
    #[inline(always)]
    pub fn normal(&self, st: Vec2<R>) -> Vec3<R> {
        let d = self.twist();
        d.mul_add(st.y, self.u).cross(d.mul_add(st.x, self.v))
    }
    /// The point at (s, t), relative to p.
    #[inline(always)]
    pub fn offset(&self, st: Vec2<R>) -> Vec3<R> {
        self.twist().mul_add(st.y, self.u).mul_add(st.x, self.v * st.y)
    }
    /// The distribution of (s, t).
    #[inline(always)]
    pub fn parameters(&self) -> Bilinear<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let unit = self.in_units().0;
        let at = |s: R, t: R| unit.normal(Vec2::new(s, t)).length();
        Bilinear { corners: [at(zero, zero), at(one, zero), at(zero, one), at(one, one)] }
    }
    /// The patch with edges near 1 and p at the origin; the reciprocal of its unit of length; and whether it is finite.
    #[inline(always)]
    fn in_units(&self) -> (Self, R, R::Mask) {
        let reach = self.u.max_abs().greater(self.v.max_abs()).greater(self.w.max_abs());
        let (scale, finite) = (reach.pow2_scale(), reach.lt(R::lit(1e37)));
        let scaled = |e: Vec3<R>| Vec3::new(e.x.keep(finite), e.y.keep(finite), e.z.keep(finite)) * scale;
        let unit = Self { p: Vec3::default(), u: scaled(self.u), v: scaled(self.v), w: scaled(self.w) };
        (unit, scale, finite)
    }
    /// The (s, t) of a point; may lie outside [0, 1]².
    #[inline(always)]
    pub fn locate(&self, point: Vec3<R>) -> Vec2<R> {
        let (zero, one, half, most) = (R::lit(0.0), R::lit(1.0), R::lit(0.5), R::lit(4.0));
        let (unit, scale, _) = self.in_units();
        let far = R::lit(64.0);
        let q = (point - self.p) * scale;
        let q = Vec3::new(q.x.clamped(-far, far), q.y.clamped(-far, far), q.z.clamped(-far, far));
        let d = unit.twist();
        // (q − su)×(v + sd) = 0, projected along the middle normal
        let n = unit.normal(Vec2::new(half, half));
        let (a, b, c) = (-n.dot(unit.u.cross(d)), n.dot(q.cross(d) - unit.u.cross(unit.v)), n.dot(q.cross(unit.v)));
        let root = (b * b - R::lit(4.0) * a * c).greater(zero).sqrt();
        let sum = b + root.copysign(b);
        let quotient = |x: R, y: R| {
            let some = y.abs().gt(R::lit(1e-30));
            (x / R::blend(some, y, one)).keep(some).clamped(-most, most)
        };
        let (first, second) = (quotient(R::lit(-2.0) * c, sum), quotient(-half * sum, a));
        let nearer = (second - half).abs().lt((first - half).abs()) & a.abs().gt(R::lit(1e-6) * b.abs());
        let s = R::blend(nearer, second, first);
        let line = d.mul_add(s, unit.v);
        let t = quotient((q - unit.u * s).dot(line), line.length_squared());
        let mut st = Vec2::new(s, t);
        for _ in 0..2 {
            let (by_s, by_t) = (d.mul_add(st.y, unit.u), d.mul_add(st.x, unit.v));
            let (left, normal) = (q - unit.offset(st), by_s.cross(by_t));
            let square = normal.length_squared();
            let step = |x: Vec3<R>| quotient(x.dot(normal), square).clamped(-half, half);
            st = Vec2 { x: st.x + step(left.cross(by_t)), y: st.y + step(by_s.cross(left)) };
        }
        st
    }
    /// The pdf per unit area at (s, t).
    #[inline(always)]
    pub fn pdf_at(&self, st: Vec2<R>) -> R {
        let area = self.normal(st).length();
        self.parameters().pdf(st) * reciprocal(area)
    }
}
impl<R: Real> Warp<R> for PatchSurface<R> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        let (unit, scale, _) = self.in_units();
        finite(self.p + unit.offset(self.parameters().sample(u)) * scale.pow2_scale())
    }
    /// The pdf per unit area of the patch.
    #[inline(always)]
    fn pdf(&self, point: Vec3<R>) -> R {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let st = self.locate(point);
        let (unit, scale, finite) = self.in_units();
        let d = unit.twist();
        // coordinates are rounded, so allow for that, relative to the sides
        let slack = R::lit(SLACK) * (self.p.max_abs() * scale + R::lit(2.0));
        let beyond = |x: R, side: Vec3<R>| (x - x.clamped(zero, one)).abs() * side.length();
        let inside = beyond(st.x, d.mul_add(st.y, unit.u)).le(slack) & beyond(st.y, d.mul_add(st.x, unit.v)).le(slack);
        let st = Vec2 { x: st.x.clamped(zero, R::ONE_MINUS_EPSILON), y: st.y.clamped(zero, R::ONE_MINUS_EPSILON) };
        self.pdf_at(st).keep(inside & finite)
    }
    #[inline(always)]
    fn invert(&self, point: Vec3<R>) -> Vec2<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let st = self.locate(point);
        self.parameters().invert(Vec2 { x: st.x.clamped(zero, one), y: st.y.clamped(zero, one) })
    }
}
