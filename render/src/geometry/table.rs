//! The table of all forms of shapes, and what hosts may ask of any of them.

use super::disk::Disk;
use super::ends::Segment;
use super::form::{Approach, Chart, Extent, Form, Hittable, Meeting};
use super::parallelogram::Parallelogram;
use super::points::Points;
use super::sphere::Sphere;
use super::spread::Spread;
use super::triangle::Triangle;
use crate::packet::{M8, V8, X8};
use crate::technique::Measure;
use etendue::light::Picture;
use etendue::{LightSample, Vec2, Vec3};
use etendue_visible::Occluder;

/// What is made of each line of the table. `$` stands for itself in the macro that this one defines.
macro_rules! forms {
    ($dollar:tt $($(#[$doc:meta])* $name:ident($form:ty),)*) => {
        /// The form of a shape.
        #[derive(Clone, Debug, PartialEq)]
        #[non_exhaustive]
        pub enum Geometry {
            $($(#[$doc])* $name($form),)*
        }

        /// The forms by their names alone, which number the kinds of lights that are shapes.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Kind {
            $($name,)*
        }

        /// A form, prepared for rays.
        #[derive(Clone, Copy, Debug)]
        pub(crate) enum AnyHittable {
            $($name(<$form as Form>::Hittable),)*
        }

        /// The kinds of all forms, as a set.
        pub(crate) const KINDS: u32 = $(1 << Kind::$name as u32)|*;

        /// An expression with the form of a geometry, whichever it has.
        macro_rules! of {
            ($dollar geometry:expr, |$dollar form:ident| $dollar value:expr) => {
                match $dollar geometry {
                    $(Geometry::$name($dollar form) => $dollar value,)*
                }
            };
        }

        impl Geometry {
            /// Its number among the kinds of lights.
            #[inline]
            pub(crate) fn kind(&self) -> u32 {
                match self {
                    $(Self::$name(_) => Kind::$name as u32,)*
                }
            }
            /// How a picture lies on it; `None` if it shows none, and emits the mean of a picture everywhere.
            pub fn chart(&self) -> Option<Chart> {
                match self {
                    $(Self::$name(_) => <$form>::CHART,)*
                }
            }
            /// Its greatest area as seen from far away, in squared scene units.
            pub fn silhouette(&self) -> f64 {
                match self {
                    $(Self::$name(form) => form.area() * <$form>::SILHOUETTE,)*
                }
            }
            /// As of [`Form::halves`], with the area in units of their product.
            pub(crate) fn halves(&self, direction: Vec3<f64>) -> ([Vec3<f64>; 2], f64) {
                match self {
                    $(Self::$name(form) => (form.halves(direction), <$form>::SHARE),)*
                }
            }
            /// As of [`Form::hittable`].
            pub(crate) fn hittable(&self) -> AnyHittable {
                match self {
                    $(Self::$name(form) => AnyHittable::$name(form.hittable()),)*
                }
            }
        }

        impl Hittable for AnyHittable {
            #[inline(always)]
            fn meet<const ANY: bool>(&self, rays: &Approach<'_>) -> Meeting {
                match self {
                    $(Self::$name(hittable) => hittable.meet::<ANY>(rays),)*
                }
            }
            fn reached_by(&self, segment: Segment) -> Segment {
                match self {
                    $(Self::$name(solid) => solid.reached_by(segment),)*
                }
            }
            fn fronts(&self, rays: [V8; 2], distance: X8) -> M8 {
                match self {
                    $(Self::$name(solid) => solid.fronts(rays, distance),)*
                }
            }
        }

        /// As of [`Form::extent`].
        pub(crate) fn extent(kind: u32, vectors: [Vec3<f64>; 3]) -> Option<Extent> {
            $(if kind == Kind::$name as u32 {
                return Some(<$form>::extent(vectors));
            })*
            None
        }

        /// As of [`Form::normals`].
        #[inline]
        pub(crate) fn normals(kind: u32, vectors: [V8; 3]) -> V8 {
            $(if kind == Kind::$name as u32 {
                return <$form>::normals(vectors);
            })*
            V8::default()
        }

        /// As of [`Form::sample`].
        #[inline]
        pub(crate) fn sample<D: From<LightSample<X8>>>(
            kind: u32,
            vectors: [V8; 3],
            measure: Measure,
            p: V8,
            normal: V8,
            u: Vec2<X8>,
        ) -> D {
            $(if kind == Kind::$name as u32 {
                return <$form>::sample(vectors, measure, p, normal, u);
            })*
            unreachable!("no shape")
        }
    };
}

forms! { $
    /// A whole sphere; its normal points outwards.
    Sphere(Sphere),
    /// The corners of a triangle; the normal is (v1 − v0) × (v2 − v0).
    Triangle(Triangle),
    /// A parallelogram; the normal is u × v.
    Parallelogram(Parallelogram),
    /// A disk.
    Disk(Disk),
}

impl Geometry {
    /// Area of the surface, in squared scene units.
    pub fn area(&self) -> f64 {
        of!(self, |form| form.area())
    }
    /// A point of a flat shape and its unit normal, in double precision; `None` for a sphere.
    pub fn plane(&self) -> Option<[Vec3<f64>; 2]> {
        of!(self, |form| form.plane())
    }
    /// The unit normal of a flat shape; 0 for a sphere.
    pub fn normal(&self) -> [f32; 3] {
        of!(self, |form| form.normal())
    }
    /// Least and greatest corner of the bounding box.
    pub fn bounds(&self) -> [[f32; 3]; 2] {
        of!(self, |form| form.bounds())
    }
    /// What closed forms take the shape for.
    pub fn outline(&self) -> Occluder<'static> {
        of!(self, |form| form.outline())
    }
    /// The middle of the shape.
    pub(crate) fn middle(&self) -> Vec3<f64> {
        of!(self, |form| form.middle())
    }
    /// The outward normals at points of the surface, of any length.
    #[cfg(feature = "analytic")]
    #[inline]
    pub(crate) fn outwards(&self, points: V8) -> V8 {
        of!(self, |form| form.outwards(points))
    }
    /// As of [`Form::outward_at`].
    #[inline(always)]
    pub(crate) fn outward_at(&self, rays: [V8; 2], distance: X8) -> V8 {
        of!(self, |form| form.outward_at(rays, distance))
    }
    /// As of [`Form::points`].
    #[inline]
    pub(crate) fn points(&self, rays: [V8; 2], distance: X8, reach: f32) -> Points {
        of!(self, |form| form.points(rays, distance, reach))
    }
    /// The vectors of a light of this form.
    #[inline]
    pub(crate) fn vectors(&self) -> [[f32; 3]; 3] {
        of!(self, |form| form.vectors())
    }
    /// As of [`Form::pdf`].
    #[inline]
    pub(crate) fn pdf(&self, spread: Option<Spread<f32>>, p: V8, w: V8) -> X8 {
        of!(self, |form| form.pdf(spread, p, w))
    }
    /// As of [`Form::coordinates`].
    #[inline]
    pub(crate) fn coordinates(&self, point: V8) -> Vec2<X8> {
        of!(self, |form| form.coordinates(point))
    }
    /// As of [`Form::sample_picture`].
    pub(crate) fn sample_picture(
        &self,
        picture: &Picture<'_>,
        axes: &[[f32; 3]; 3],
        measure: Measure,
        place: [V8; 2],
        u: Vec2<X8>,
    ) -> LightSample<X8> {
        of!(self, |form| form.sample_picture(picture, axes, measure, place, u))
    }
    /// As of [`Form::pdf_of_picture`].
    pub(crate) fn pdf_of_picture(&self, picture: &Picture<'_>, axes: &[[f32; 3]; 3], p: V8, w: V8) -> X8 {
        of!(self, |form| form.pdf_of_picture(picture, axes, p, w))
    }
}
