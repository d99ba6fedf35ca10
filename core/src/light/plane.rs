//! The planes of flat lights, with affine coordinates.

use super::surface::{SURFACE_SLACK, SurfaceHit};
use crate::lanewise::lanewise;
use crate::light::direction::to_unit;
use crate::math::quotient;
use crate::real::Real;
use crate::vector::double_word::height_over;
use crate::vector::{Vec2, Vec3};

lanewise! {
    /// The plane of a flat light with its affine coordinates: origin + x·first + y·second.
    ///
    /// Lengths are in units of `unit`, so that no product under- or overflows.
    pub(crate) struct AffinePlane {
        pub(super) origin: Vec3<R>,
        pub(super) first: Vec3<R>,
        pub(super) second: Vec3<R>,
        /// first × second, its unit vector and its length.
        pub(super) cross: Vec3<R>,
        pub(super) normal: Vec3<R>,
        pub(super) length: R,
        /// Distance of the shading point to the plane, negative on the side of the normal.
        pub(super) height: R,
        /// Normals of the planes through the shading point and the edges: origin × first and origin × second.
        pub(super) along_first: Vec3<R>,
        pub(super) along_second: Vec3<R>,
        pub(super) unit: R,
    }
}

impl<R: Real> AffinePlane<R> {
    #[inline(always)]
    pub(super) fn new(origin: Vec3<R>, first: Vec3<R>, second: Vec3<R>) -> Self {
        // each edge in a unit of its own, however different their lengths are
        let in_own_unit = |edge: Vec3<R>| {
            let reach = edge.max_abs();
            let unit = reach.pow2_scale();
            (edge.keep(reach.lt(R::lit(f64::INFINITY))) * unit, unit)
        };
        let ((a, unit_a), (b, unit_b)) = (in_own_unit(first), in_own_unit(second));
        let cross = a.cross(b);
        let (normal, sine) = cross.unit_and_length();
        let ([origin, first, second], scale) = to_unit([origin, first, second]);
        let height = quotient(height_over(origin, [a, b], cross), sine);
        let length = sine * (scale / unit_a) * (scale / unit_b);
        let cross = normal * length;
        Self {
            origin,
            first,
            second,
            cross,
            normal,
            length,
            height,
            along_first: origin.cross(first),
            along_second: origin.cross(second),
            unit: R::lit(1.0) / scale,
        }
    }
    /// Area of the parallelogram of both edges.
    #[inline(always)]
    pub(super) fn parallelogram_area(&self) -> R {
        (self.length * self.unit) * self.unit
    }
    #[inline(always)]
    fn distance(&self, w: Vec3<R>) -> R {
        let distance = quotient(self.height, w.dot(self.normal)).greater(R::lit(0.0)) * self.unit;
        distance.lesser(R::lit(f64::from(f32::MAX)))
    }
    /// Affine coordinates of the point in the direction `w`.
    #[inline(always)]
    pub(super) fn coordinates(&self, w: Vec3<R>) -> Vec2<R> {
        let along = w.dot(self.cross);
        Vec2::new(quotient(-w.dot(self.along_second), along), quotient(w.dot(self.along_first), along))
    }
    #[inline(always)]
    pub(super) fn at(&self, w: Vec3<R>) -> SurfaceHit<R> {
        let uv = self.coordinates(w);
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let uv = Vec2::new(uv.x.clamped(zero, one), uv.y.clamped(zero, one));
        SurfaceHit { distance: self.distance(w), normal: self.normal, uv }
    }
    /// The sign that turns w·(a × b) positive for directions inside the edge from a to b, counterclockwise about the normal.
    #[inline(always)]
    pub(super) fn inwards(&self, side: R) -> R {
        side.negate_where(self.height.lt(R::lit(0.0)))
    }
    /// True where `w` points towards the plane.
    #[inline(always)]
    pub(super) fn ahead(&self, w: Vec3<R>) -> R::Mask {
        let slack = R::lit(SURFACE_SLACK);
        self.inwards(w.dot(self.normal)).ge(-slack) & self.height.abs().gt(R::lit(0.0))
    }
    /// True where `w` is inside an edge between the points a and b, given the plane a × b and the size of what it is a sum of.
    #[inline(always)]
    pub(super) fn inside(&self, w: Vec3<R>, plane: Vec3<R>, size: R, [a, b]: [Vec3<R>; 2]) -> R::Mask {
        // the plane of points that are nearly opposite as seen from here is known only to −cos : sin of the angle between them
        let slack = size.greater(-a.dot(b)) * R::lit(SURFACE_SLACK);
        self.inwards(w.dot(plane)).ge(-slack)
    }
    /// True where `w` hits the triangle or, with `all`, the parallelogram.
    #[inline(always)]
    pub(super) fn contains(&self, w: Vec3<R>, all: bool) -> R::Mask {
        let (o, a, b) = (self.origin, self.along_first, self.along_second);
        let (corner, other) = (o + self.first, o + self.second);
        let size = |m: Vec3<R>| m.length();
        let near = self.inside(w, a, size(a), [o, corner]) & self.inside(w, -b, size(b), [o, other]) & self.ahead(w);
        if all {
            let opposite = corner + self.second;
            near & self.inside(w, self.cross + b, size(b) + self.length, [corner, opposite])
                & self.inside(w, self.cross - a, size(a) + self.length, [other, opposite])
        } else {
            let diagonal = o.cross(self.second - self.first);
            near & self.inside(w, diagonal + self.cross, size(diagonal) + self.length, [corner, other])
        }
    }
}
