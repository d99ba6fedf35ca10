//! Lights of a set prepared for a receiver, and the points of their samples.

use super::emitter::Shape;
use super::receiver::Side;
use crate::light::{
    AffineSampler, ConstantEnvironment, DirectionalLightByDelta, DiskBySolidAngle, EnvironmentByProjectedSolidAngle,
    EnvironmentBySolidAngle, FAR, LightSample, LightSampler, LineByAngle, ParallelogramBySolidAngle, PatchByArea,
    PointLightByDelta, PolygonBySolidAngle, RectangleBySolidAngle, SphereBySolidAngle, SpotLightByDelta,
    SunBySolidAngle, TriangleBySolidAngle,
};
use crate::real::{Mask, Real};
use crate::vector::{Vec2, Vec3};
use alloc::boxed::Box;

/// A sampler of a light at the receiver.
#[derive(Clone, Debug)]
pub(super) enum Prepared<R: Real<Scalar = R>> {
    Sphere(SphereBySolidAngle<R>),
    Triangle(TriangleBySolidAngle<R>),
    Parallelogram(ParallelogramBySolidAngle<R>),
    Rectangle(RectangleBySolidAngle<R>),
    Disk(DiskBySolidAngle<R>),
    /// Kilobytes, which are not to be copied with the others.
    Polygon(Box<PolygonBySolidAngle<R, 8>>),
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

/// An expression for the sampler of any kind.
macro_rules! each {
    ($prepared:expr, $light:ident => $value:expr) => {
        match $prepared {
            Self::Sphere($light) => $value,
            Self::Triangle($light) => $value,
            Self::Parallelogram($light) => $value,
            Self::Rectangle($light) => $value,
            Self::Disk($light) => $value,
            Self::Polygon($light) => $value,
            Self::Patch($light) => $value,
            Self::Line($light) => $value,
            Self::Ellipsoid($light) => $value,
            Self::Ellipse($light) => $value,
            Self::Point($light) => $value,
            Self::Spot($light) => $value,
            Self::Directional($light) => $value,
            Self::Sun($light) => $value,
            Self::Sky($light) => $value,
            Self::SkyAbove($light) => $value,
        }
    };
}

impl<R: Real<Scalar = R>> Prepared<R> {
    pub(super) fn new(shape: &Shape<R>, p: Vec3<R>, side: Side<R>) -> Self {
        match shape {
            Shape::Sphere(light) => Self::Sphere(light.by_solid_angle(p)),
            Shape::Triangle(light) => Self::Triangle(light.by_solid_angle(p)),
            Shape::Parallelogram(light) => Self::Parallelogram(light.by_solid_angle(p)),
            Shape::Rectangle(light) => Self::Rectangle(light.by_solid_angle(p)),
            Shape::Disk(light) => Self::Disk(light.by_solid_angle(p)),
            Shape::Polygon(light) => Self::Polygon(Box::new(light.by_solid_angle(p))),
            Shape::Patch(light) => Self::Patch(light.by_area(p)),
            Shape::Line(light) => Self::Line(light.by_angle(p)),
            Shape::Ellipsoid(light) => Self::Ellipsoid(light.by_solid_angle(p)),
            Shape::Ellipse(light) => Self::Ellipse(light.by_solid_angle(p)),
            Shape::Point(light) => Self::Point(light.by_delta(p)),
            Shape::Spot(light) => Self::Spot(light.by_delta(p)),
            Shape::Directional(light) => Self::Directional(light.by_delta()),
            Shape::Sun(light) => Self::Sun(light.by_solid_angle()),
            Shape::Sky => match side {
                Side::Surface(normal) => {
                    // of any length, so that no number overflows
                    Self::SkyAbove(ConstantEnvironment.by_projected_solid_angle(normal.unit_and_length().0))
                }
                Side::Both | Side::None => Self::Sky(EnvironmentBySolidAngle),
            },
        }
    }
    /// Draws a sample, but for its surface coordinates.
    #[inline(always)]
    pub(super) fn sample(&self, u: Vec2<R>) -> Drawn<R> {
        each!(self, light => {
            let LightSample { direction, distance, pdf, normal, emits, delta, .. } = light.sample(u);
            Drawn { direction, distance, pdf, normal, emits: emits.any(), delta: delta.any() }
        })
    }
    /// The pdf of a unit direction.
    #[inline(always)]
    pub(super) fn pdf(&self, w: Vec3<R>) -> R {
        each!(self, light => light.pdf(w))
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
        Shape::Directional(_) | Shape::Sun(_) | Shape::Sky => (sample.direction * far, R::lit(0.0)),
    };
    // coordinates may overflow
    (point.map(|x| x.clamped(-far, far)), bound.lesser(far))
}

/// The sum of the greatest coordinates of the axes.
fn reach<R: Real>([x, y, z]: &[Vec3<R>; 3]) -> R {
    x.max_abs() + y.max_abs() + z.max_abs()
}
