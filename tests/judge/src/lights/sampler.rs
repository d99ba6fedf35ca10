//! What a sampler is: two functions of its own, and what it claims.

use crate::area_lights::{AreaLight, LightShape, Measure};
use crate::fixture::Fixture;
use etendue::lights::{Emitter, Lights, LightsAt, Receiver, Side};
use etendue::{Disk, LightSampler, Parallelogram, Rectangle, Sphere, Triangle, Vec2, Vec3};
use etendue_oracle::{length, sub, wide};

/// One sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Unit vector from the point towards the light.
    pub direction: [f32; 3],
    /// Density per steradian.
    pub pdf: f32,
    /// Whether the light itself hides what was drawn, so that the estimate is 0.
    pub is_hidden: bool,
}

/// A light prepared for a point.
pub trait Sampler {
    /// Draws for `u` in [0, 1)²; `None` is a draw whose estimate is 0.
    fn sample(&self, u: [f32; 2]) -> Option<Sample>;
    /// The density per steradian with which a unit direction is drawn.
    fn pdf(&self, direction: [f32; 3]) -> f32;
    /// The `u` that draws a direction, if the sampler can tell.
    fn invert(&self, _direction: [f32; 3]) -> Option<[f32; 2]> {
        None
    }
    /// The distance of the light in a direction, if the sampler can tell; 0 where it is not.
    fn hit(&self, _direction: [f32; 3]) -> Option<f32> {
        None
    }
}

/// What a sampler declares that it does not have, so that it is judged by what is left.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lacks {
    /// It has no map from the square: numbers are only what its generator starts from, as where it draws by rejection.
    pub map: bool,
    /// It evaluates no density of a direction. That of a sample is judged all the same.
    pub pdf: bool,
}

/// What preparing a light for a point gives.
pub enum Prepared<'a> {
    /// The sampler does not claim to be right there.
    OutsideOfDomain,
    /// Nothing can be sampled.
    Nothing,
    /// It can be sampled.
    Ready(Box<dyn Sampler + 'a>),
}

/// A sampler that is judged.
pub struct Subject<'a> {
    /// Its name.
    pub name: String,
    /// The lights that it samples.
    pub shape: LightShape,
    /// What it claims to be uniform by.
    pub by: Measure,
    /// What it declares that it does not have.
    pub lacks: Lacks,
    /// In words, where it claims to be right; empty if everywhere.
    pub domain: String,
    /// Prepares a light for its point.
    pub prepare: Box<dyn Fn(&AreaLight) -> Prepared<'a> + 'a>,
}

/// The shapes whose samplers are judged.
pub const SHAPES: [(LightShape, &str); 5] = [
    (LightShape::Sphere, "sphere"),
    (LightShape::Triangle, "triangle"),
    (LightShape::Rectangle, "rectangle"),
    (LightShape::Parallelogram, "parallelogram"),
    (LightShape::Disk, "disk"),
];
/// The measures that say what a density has to be.
pub const MEASURES: [(Measure, &str); 4] = [
    (Measure::SolidAngle, "solid angle"),
    (Measure::ProjectedSolidAngle, "projected solid angle"),
    (Measure::Area, "area"),
    (Measure::Other, "other"),
];

/// The name of a measure.
#[must_use]
pub fn measure_name(by: Measure) -> &'static str {
    MEASURES.iter().find(|m| m.0 == by).map_or("other", |m| m.1)
}
/// The name of a shape.
#[must_use]
pub fn shape_name(shape: LightShape) -> &'static str {
    let polygon = [(LightShape::Polygon, "polygon")];
    SHAPES.iter().chain(&polygon).find(|s| s.0 == shape).map_or("other", |s| s.1)
}
/// The measure of a name.
///
/// # Errors
/// Fails if no measure has it.
pub fn measure_of(name: &str) -> Result<Measure, String> {
    named("measure", &MEASURES, name)
}
/// The shape of a name.
///
/// # Errors
/// Fails if no shape has it.
pub fn shape_of(name: &str) -> Result<LightShape, String> {
    named("shape", &SHAPES, name)
}
fn named<T: Copy>(what: &str, all: &[(T, &str)], name: &str) -> Result<T, String> {
    let found = all.iter().find(|a| a.1 == name).map(|a| a.0);
    found.ok_or_else(|| {
        let names: Vec<_> = all.iter().map(|a| a.1).collect();
        format!("{what} '{name}' is none of {}", names.join(", "))
    })
}

/// A technique of the core.
struct Own {
    light: Box<dyn LightSampler<f32>>,
    /// Spheres emit outwards, and are judged from inside too.
    is_inside: bool,
}

fn vector(v: [f32; 3]) -> Vec3<f32> {
    Vec3::new(v[0], v[1], v[2])
}
fn is_inside(light: &AreaLight) -> bool {
    light.shape == LightShape::Sphere && length(sub(wide(light.a), wide(light.p))) < f64::from(light.radius)
}
impl Sampler for Own {
    fn sample(&self, u: [f32; 2]) -> Option<Sample> {
        let s = self.light.sample(Vec2::new(u[0], u[1]));
        let direction = [s.direction.x, s.direction.y, s.direction.z];
        // NaN is a sample
        (s.pdf != 0.0).then_some(Sample { direction, pdf: s.pdf, is_hidden: !s.emits && !self.is_inside })
    }
    fn pdf(&self, direction: [f32; 3]) -> f32 {
        self.light.pdf(vector(direction))
    }
    fn invert(&self, direction: [f32; 3]) -> Option<[f32; 2]> {
        let u = self.light.invert(vector(direction));
        Some([u.x, u.y])
    }
    fn hit(&self, direction: [f32; 3]) -> Option<f32> {
        Some(self.light.hit(vector(direction)).distance)
    }
}

/// A technique of the core.
#[must_use]
pub fn technique(shape: LightShape, by: Measure) -> Subject<'static> {
    let known = MEASURES.iter().any(|m| m.0 == by);
    Subject {
        name: format!("etendue {} by {by:?}", shape_name(shape)),
        shape,
        by: if known { by } else { Measure::Other },
        lacks: Lacks::default(),
        domain: String::new(),
        prepare: Box::new(move |light| {
            let light = AreaLight { by, ..*light };
            Prepared::Ready(Box::new(Own { is_inside: is_inside(&light), light: AreaLight::prepare::<f32>(&[light]) }))
        }),
    }
}

/// The core's own techniques of these shapes, from its one list, and its sets of one light.
#[must_use]
pub fn own() -> Vec<Subject<'static>> {
    let is_judged = |shape| shape == LightShape::Polygon || SHAPES.iter().any(|s| s.0 == shape);
    let kinds = AreaLight::kinds().iter().filter(|kind| is_judged(kind.0));
    kinds.map(|&(shape, by)| technique(shape, by)).chain(SHAPES.iter().map(|s| set(s.0))).collect()
}

/// A set of one light, and where it is seen from.
struct OfSet {
    lights: Lights<f32>,
    point: Vec3<f32>,
    is_inside: bool,
}
impl OfSet {
    fn at(&self) -> LightsAt<'_, f32> {
        self.lights.at(Receiver { point: self.point, side: Side::None, on: None })
    }
}
impl Sampler for OfSet {
    fn sample(&self, u: [f32; 2]) -> Option<Sample> {
        let s = self.at().sample([0.5, u[0], u[1]]);
        let direction = [s.direction.x, s.direction.y, s.direction.z];
        (s.pdf != 0.0).then_some(Sample { direction, pdf: s.pdf, is_hidden: s.factor == 0.0 && !self.is_inside })
    }
    fn pdf(&self, direction: [f32; 3]) -> f32 {
        self.at().pdf(0, vector(direction))
    }
}

/// A set of one light of a shape.
#[must_use]
pub fn set(shape: LightShape) -> Subject<'static> {
    macro_rules! of {
        ($light:expr, $point:expr) => {{
            let light = $light;
            (light.into(), light.on_surface($point))
        }};
    }
    Subject {
        name: format!("etendue set of one {}", shape_name(shape)),
        shape,
        by: Measure::SolidAngle,
        lacks: Lacks::default(),
        domain: "the point is not on the light, to within its rounding".into(),
        prepare: Box::new(move |light| {
            let AreaLight { a, b, c, radius, p, .. } = *light;
            let [a, b, c, point] = [a, b, c, p].map(vector);
            let (emitter, is_on): (Emitter<f32>, bool) = match shape {
                LightShape::Sphere => of!(Sphere::new(a, radius), point),
                LightShape::Triangle => of!(Triangle::new(a, a + b, a + c), point),
                LightShape::Rectangle => of!(Rectangle::new(a, b, c), point),
                LightShape::Disk => of!(Disk::new(a, b, radius), point),
                _ => of!(Parallelogram::new(a, b, c), point),
            };
            match Lights::new([(emitter, 1.0)]) {
                Ok(_) if is_on => Prepared::OutsideOfDomain,
                Ok(lights) => Prepared::Ready(Box::new(OfSet { lights, point, is_inside: is_inside(light) })),
                Err(_) => Prepared::Nothing,
            }
        }),
    }
}
