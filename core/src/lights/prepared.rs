//! Lights of a set prepared for a receiver, and the points of their samples.

use super::emitter::Shape;
use super::receiver::Side;
use crate::light::{
    AffineSampler, ByRadiance, ConstantEnvironment, DirectionSample, DirectionalLightByDelta, DiskBySolidAngle,
    EnvironmentByProjectedSolidAngle, EnvironmentBySolidAngle, FAR, LightSample, LightSampler, LineByAngle,
    ParallelogramBySolidAngle, PatchByArea, PointLightByDelta, PolygonBySolidAngle, RectangleBySolidAngle, Rotated,
    SeenShape, SphereBySolidAngle, SphericalShape, SpotLightByDelta, SunBySolidAngle, TriangleBySolidAngle,
};
use crate::owned::OwnedEnvironment;
use crate::real::{Mask, Real};
use crate::vector::{Vec2, Vec3};
use crate::warp::Warp;

/// What is seen of a shape.
type SeenOf<S> = <S as SeenShape>::Shape;

/// A sampler of a light at the receiver. Of shapes that are sampled by solid angle it is what is seen of them: a set knows their normals.
#[derive(Clone, Copy, Debug)]
pub(super) enum Prepared<R: Real<Scalar = R>> {
    Sphere(SeenOf<SphereBySolidAngle<R>>),
    Triangle(SeenOf<TriangleBySolidAngle<R>>),
    Parallelogram(SeenOf<ParallelogramBySolidAngle<R>>),
    Rectangle(SeenOf<RectangleBySolidAngle<R>>),
    Disk(SeenOf<DiskBySolidAngle<R>>),
    Polygon(SeenOf<PolygonBySolidAngle<R, 8>>),
    Patch(PatchByArea<R>),
    Line(LineByAngle<R>),
    Ellipsoid(AffineSampler<SphereBySolidAngle<R>, R>),
    Ellipse(AffineSampler<DiskBySolidAngle<R>, R>),
    Point(PointLightByDelta<R>),
    Spot(SpotLightByDelta<R>),
    Directional(DirectionalLightByDelta<R>),
    Sun(SunBySolidAngle<R>),
    Sky(EnvironmentBySolidAngle),
    SkyAbove(EnvironmentByProjectedSolidAngle<R>),
}

/// An expression for what is seen of a shape, or for a sampler.
macro_rules! each {
    ($prepared:expr, $seen:ident => $of_seen:expr, $light:ident => $of_light:expr) => {
        match $prepared {
            Self::Sphere($seen) => $of_seen,
            Self::Triangle($seen) => $of_seen,
            Self::Parallelogram($seen) => $of_seen,
            Self::Rectangle($seen) => $of_seen,
            Self::Disk($seen) => $of_seen,
            Self::Polygon($seen) => $of_seen,
            Self::Patch($light) => $of_light,
            Self::Line($light) => $of_light,
            Self::Ellipsoid($light) => $of_light,
            Self::Ellipse($light) => $of_light,
            Self::Point($light) => $of_light,
            Self::Spot($light) => $of_light,
            Self::Directional($light) => $of_light,
            Self::Sun($light) => $of_light,
            Self::Sky($light) => $of_light,
            Self::SkyAbove($light) => $of_light,
        }
    };
}

impl<R: Real<Scalar = R>> Prepared<R> {
    /// Prepares a shape in the place of what was here, so that kilobytes are not moved.
    pub(super) fn prepare(&mut self, shape: &Shape<R>, p: Vec3<R>, side: Side<R>) {
        match shape {
            Shape::Sphere(light) => *self = Self::Sphere(light.by_solid_angle(p).seen()),
            Shape::Triangle(light) => *self = Self::Triangle(light.by_solid_angle(p).seen()),
            Shape::Parallelogram(light) => *self = Self::Parallelogram(light.by_solid_angle(p).seen()),
            Shape::Rectangle(light) => *self = Self::Rectangle(light.by_solid_angle(p).seen()),
            Shape::Disk(light) => *self = Self::Disk(light.by_solid_angle(p).seen()),
            Shape::Polygon(light) => *self = Self::Polygon(light.by_solid_angle(p).seen()),
            Shape::Patch(light) => *self = Self::Patch(light.by_area(p)),
            Shape::Line(light) => *self = Self::Line(light.by_angle(p)),
            Shape::Ellipsoid(light) => *self = Self::Ellipsoid(light.by_solid_angle(p)),
            Shape::Ellipse(light) => *self = Self::Ellipse(light.by_solid_angle(p)),
            Shape::Point(light) => *self = Self::Point(light.by_delta(p)),
            Shape::Spot(light) => *self = Self::Spot(light.by_delta(p)),
            Shape::Directional(light) => *self = Self::Directional(light.by_delta()),
            Shape::Sun(light) => *self = Self::Sun(light.by_solid_angle()),
            // its tables are looked up without preparation
            Shape::Image(_) => *self = Self::Sky(EnvironmentBySolidAngle),
            Shape::Sky => match side {
                Side::Surface(normal) => {
                    // of any length, so that no number overflows
                    let normal = normal.unit_and_length().0;
                    *self = Self::SkyAbove(ConstantEnvironment.by_projected_solid_angle(normal));
                }
                Side::Both | Side::None => *self = Self::Sky(EnvironmentBySolidAngle),
            },
        }
    }
    /// Draws a sample of this shape, for which it was prepared. The normal of a shape that is seen is the set's to find.
    #[inline(always)]
    pub(super) fn sample(&self, shape: &Shape<R>, u: Vec2<R>) -> Drawn<R> {
        if let Shape::Image(image) = shape {
            let s = sky(image).sample(u);
            let is_number = ((u.x + u.y) * R::lit(0.0)).ge(R::lit(0.0));
            return Drawn { pdf: s.pdf.keep(is_number), ..Drawn::from(s) };
        }
        each!(self,
            seen => {
                let (DirectionSample { direction, distance }, _) = seen.sample_point(u);
                let is_number = ((u.x + u.y) * R::lit(0.0)).ge(R::lit(0.0));
                let pdf = seen.uniform_pdf().keep(is_number);
                Drawn { direction, distance, pdf, normal: Vec3::ZERO, emits: seen.in_front().any(), delta: false }
            },
            light => {
                Drawn::from(light.sample(u))
            }
        )
    }
    /// The pdf of a unit direction.
    #[inline(always)]
    pub(super) fn pdf(&self, shape: &Shape<R>, w: Vec3<R>) -> R {
        if let Shape::Image(image) = shape {
            return sky(image).pdf(w);
        }
        each!(self, seen => seen.pdf(w), light => light.pdf(w))
    }
}

/// What is needed of a [`LightSample`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Drawn<R> {
    pub(super) direction: Vec3<R>,
    pub(super) distance: R,
    pub(super) pdf: R,
    pub(super) normal: Vec3<R>,
    pub(super) emits: bool,
    pub(super) delta: bool,
}

impl<R: Real<Scalar = R>> From<LightSample<R>> for Drawn<R> {
    #[inline(always)]
    fn from(sample: LightSample<R>) -> Self {
        let LightSample { direction, distance, pdf, normal, emits, delta, .. } = sample;
        Self { direction, distance, pdf, normal, emits: emits.any(), delta: delta.any() }
    }
}

/// The sampler of an image of the sky.
pub(super) fn sky<R: Real>(image: &Rotated<OwnedEnvironment, R>) -> Rotated<ByRadiance<'_>, R> {
    Rotated { sampler: image.sampler.get().by_radiance(), frame: image.frame }
}

/// The point of a sample, and how far it is at most from the light.
pub(super) fn point<R: Real<Scalar = R>>(shape: &Shape<R>, p: Vec3<R>, sample: &Drawn<R>) -> (Vec3<R>, R) {
    let unit = R::lit(if R::DOUBLE { 1.0 / 9_007_199_254_740_992.0 } else { 1.0 / 16_777_216.0 });
    let far = R::lit(FAR);
    let along = sample.direction.mul_add(sample.distance, p);
    // the foot of the perpendicular on the plane through a point
    let flat = |on: Vec3<R>| {
        let offset = along - on;
        let foot = along - sample.normal * offset.dot(sample.normal);
        (foot, (foot.max_abs() + offset.max_abs()) * (unit * R::lit(16.0)))
    };
    let (point, bound) = match shape {
        Shape::Triangle(light) => flat(light.v0),
        Shape::Parallelogram(light) => flat(light.corner),
        Shape::Rectangle(light) => flat(light.corner),
        Shape::Disk(light) => flat(light.center),
        Shape::Polygon(light) => {
            let (foot, bound) = flat(light.corners[0]);
            // rounded corners lie in no plane
            let reach = light.corners.iter().fold(R::lit(0.0), |most, corner| most.greater(corner.max_abs()));
            (foot, bound + reach * (unit * R::lit(16.0)))
        }
        Shape::Ellipse(light) => {
            let (foot, bound) = flat(light.image(light.shape.center));
            (foot, bound + reach(&light.axes) * light.shape.center.max_abs() * (unit * R::lit(16.0)))
        }
        Shape::Sphere(light) => {
            let point = sample.normal.mul_add(light.radius, light.center);
            (point, (point.max_abs() + light.radius) * (unit * R::lit(16.0)))
        }
        Shape::Ellipsoid(light) => {
            let [x, y, z] = light.axes;
            let n = sample.normal;
            let local = Vec3::new(x.dot(n), y.dot(n), z.dot(n)).unit_and_length().0;
            let local = local.mul_add(light.shape.radius, light.shape.center);
            let point = light.image(local);
            let size = reach(&light.axes) * (light.shape.center.max_abs() + light.shape.radius);
            (point, (point.max_abs() + size) * (unit * R::lit(32.0)))
        }
        Shape::Patch(_) | Shape::Line(_) => {
            (along, (along.max_abs() + p.max_abs() + sample.distance) * (unit * R::lit(32.0)))
        }
        Shape::Point(light) => (light.position, R::lit(0.0)),
        Shape::Spot(light) => (light.position, R::lit(0.0)),
        Shape::Directional(_) | Shape::Sun(_) | Shape::Sky | Shape::Image(_) => (sample.direction * far, R::lit(0.0)),
    };
    // coordinates may overflow
    (point.map(|x| x.clamped(-far, far)), bound.clamped(R::lit(0.0), far))
}

/// The sum of the greatest coordinates of the axes.
fn reach<R: Real>([x, y, z]: &[Vec3<R>; 3]) -> R {
    x.max_abs() + y.max_abs() + z.max_abs()
}
