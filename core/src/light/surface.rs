//! The surfaces of lights relative to the shading point, which is the origin of all coordinates here.

use crate::lanewise::lanewise;
use crate::math::quotient;
use crate::real::{Mask, Real, unit_interval};
use crate::spherical::{height_over, to_unit};
use crate::vector::{Vec2, Vec3};
use crate::warp::{AreaTriangle, Warp};

/// Angle in radians by which a direction may leave a shape through rounding: 12 ulp of a component near 1.
pub(super) const SURFACE_SLACK: f64 = 12.0 / 16_777_216.0;

/// Where a direction meets a surface.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceHit<R> {
    /// Distance from the shading point.
    pub distance: R,
    /// Unit normal on the side that emits.
    pub normal: Vec3<R>,
    /// Surface coordinates in [0, 1]².
    pub uv: Vec2<R>,
}

/// A point drawn on a surface.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint<R> {
    /// The point relative to the shading point.
    pub position: Vec3<R>,
    /// Unit normal on the side that emits.
    pub normal: Vec3<R>,
    /// Surface coordinates in [0, 1]².
    pub uv: Vec2<R>,
    /// 1/pdf per unit area there; 0 where there is no sample.
    pub inverse_pdf: R,
}

/// The surface of a light, placed relative to a shading point.
pub trait Surface<R: Real>: Copy {
    /// The nearest point in the unit direction `w`. Only meaningful where `w` hits the surface; finite everywhere.
    fn at(&self, w: Vec3<R>) -> SurfaceHit<R>;
    /// The same where the distance of the point is known.
    #[inline(always)]
    fn at_distance(&self, w: Vec3<R>, distance: R) -> SurfaceHit<R> {
        SurfaceHit { distance, ..self.at(w) }
    }
    /// True where the shape that is sampled is a part of the surface, and so has surface coordinates of its own.
    #[inline(always)]
    fn is_of_part(&self) -> R::Mask {
        R::Mask::splat(false)
    }
}

/// A surface that can be sampled by area.
pub trait AreaSurface<R: Real>: Surface<R> {
    /// True where the normal is constant, so that a direction determines the density as well as the point does.
    const FLAT: bool;
    /// A point for `u` in [0, 1)².
    fn draw(&self, u: Vec2<R>) -> SurfacePoint<R>;
    /// 1/pdf per unit area at surface coordinates.
    fn inverse_pdf(&self, uv: Vec2<R>) -> R;
    /// True where the unit direction `w` hits the surface, to within the rounding of the direction.
    fn contains(&self, w: Vec3<R>) -> R::Mask;
    /// The `u` that [`draw`](Self::draw) maps to the nearest point in the direction `w`.
    fn invert(&self, w: Vec3<R>) -> Vec2<R>;
    /// Surface area.
    fn area(&self) -> R;
}

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
    fn parallelogram_area(&self) -> R {
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
    fn contains(&self, w: Vec3<R>, all: bool) -> R::Mask {
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

macro_rules! affine {
    ($(#[$doc:meta])* $name:ident $(of $part:ident)?, $share:literal, $all:literal, $sample:expr, $invert:expr) => {
        lanewise! {
            $(#[$doc])*
            pub struct $name {
                origin: Vec3<R>,
                first: Vec3<R>,
                second: Vec3<R>,
                plane: AffinePlane<R>,
                $(
                    /// 1 where a part of the surface is sampled, else 0.
                    $part: R,
                )?
            }
        }
        impl<R: Real> $name<R> {
            #[inline(always)]
            pub(super) fn new(origin: Vec3<R>, first: Vec3<R>, second: Vec3<R>) -> Self {
                Self { origin, first, second, plane: AffinePlane::new(origin, first, second), $($part: R::lit(0.0))? }
            }
        }
        impl<R: Real> Surface<R> for $name<R> {
            #[inline(always)]
            fn at(&self, w: Vec3<R>) -> SurfaceHit<R> {
                self.plane.at(w)
            }
            $(#[inline(always)]
            fn is_of_part(&self) -> R::Mask {
                self.$part.gt(R::lit(0.0))
            })?
        }
        impl<R: Real> AreaSurface<R> for $name<R> {
            const FLAT: bool = true;
            #[inline(always)]
            fn draw(&self, u: Vec2<R>) -> SurfacePoint<R> {
                let sample: fn(Vec2<R>) -> Vec2<R> = $sample;
                let uv = sample(u);
                let position = self.first.mul_add(uv.x, self.second.mul_add(uv.y, self.origin));
                SurfacePoint { position, normal: self.plane.normal, uv, inverse_pdf: self.area() }
            }
            #[inline(always)]
            fn inverse_pdf(&self, _: Vec2<R>) -> R {
                self.area()
            }
            #[inline(always)]
            fn contains(&self, w: Vec3<R>) -> R::Mask {
                self.plane.contains(w, $all)
            }
            #[inline(always)]
            fn invert(&self, w: Vec3<R>) -> Vec2<R> {
                let invert: fn(Vec2<R>) -> Vec2<R> = $invert;
                let Vec2 { x, y } = self.plane.coordinates(w);
                let (zero, one) = (R::lit(0.0), R::lit(1.0));
                invert(Vec2::new(x.clamped(zero, one), y.clamped(zero, one)))
            }
            #[inline(always)]
            fn area(&self) -> R {
                self.plane.parallelogram_area() * R::lit($share)
            }
        }
    };
}
affine!(
    /// A triangle relative to the shading point. Its surface coordinates are the barycentric coordinates of the second and the third
    /// vertex.
    PlacedTriangle, 0.5, false, |u| AreaTriangle.sample(u), |b| AreaTriangle.invert(b)
);
affine!(
    /// A parallelogram relative to the shading point. Its surface coordinates are the parts of both edges.
    PlacedParallelogram of part, 1.0, true, |u| u, |st| Vec2::new(unit_interval(st.x), unit_interval(st.y))
);

impl<R: Real> PlacedParallelogram<R> {
    /// The same surface, of which a part is sampled.
    #[inline(always)]
    pub(super) fn of_part(self) -> Self {
        Self { part: R::lit(1.0), ..self }
    }
}
