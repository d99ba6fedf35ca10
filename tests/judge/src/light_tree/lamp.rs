//! Lights that a tree chooses among: how they are sampled, and the bound that a renderer states of them.

use crate::properties::squares_of;
use crate::techniques::{AreaLight, LightFixture, LightShape, Measure};
use etendue::light::Spread;
use etendue::select::LightBound;
use etendue::{Disk, LightSample, LightSampler, Line, Parallelogram, PointLight, Sphere, SpotLight, Triangle, Vec3};
use etendue_oracle::{V3, along, narrow, wide};

/// What kind of light it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LampKind {
    /// A shape with an area, or a line.
    Area(LightShape),
    /// A point light at `a`.
    Point,
    /// A spot light at `a` along `b`, with the cosines of its inner and outer angle in `c`.
    Spot,
}

/// A light.
#[derive(Clone, Copy, Debug)]
pub struct Lamp {
    /// What it is.
    pub kind: LampKind,
    /// Corner, centre or position.
    pub a: [f32; 3],
    /// Edge, normal or axis.
    pub b: [f32; 3],
    /// Edge.
    pub c: [f32; 3],
    /// Radius.
    pub radius: f32,
    /// Whether both sides emit.
    pub two_sided: bool,
    /// The full angle within which a flat light emits, in radians; 0 if that is all of a hemisphere.
    pub spread: f32,
    /// Its power.
    pub power: f32,
}

impl Lamp {
    /// What the renderer tells the tree about it.
    #[must_use]
    pub fn bound(&self) -> LightBound {
        let [a, b, c] = [self.a, self.b, self.c].map(Vec3::from);
        let bound = match self.kind {
            LampKind::Area(LightShape::Sphere) => Sphere::new(a, self.radius.abs()).bound(1.0),
            LampKind::Area(LightShape::Triangle) => Triangle { v0: a, e1: b, e2: c }.bound(1.0),
            LampKind::Area(LightShape::Disk) => Disk::new(a, b, self.radius.abs()).bound(1.0),
            LampKind::Area(LightShape::Line) => Line::new(a, b).bound(1.0),
            LampKind::Area(_) => Parallelogram::new(a, b, c).bound(1.0),
            LampKind::Point => PointLight::new(a).bound(1.0),
            LampKind::Spot => {
                let spot = SpotLight::new(a, b, [self.c[0], self.c[1]].map(|cos| 1.0 - cos));
                // narrower than the library tells a tree
                LightBound { cos_cone: self.c[1], ..spot.bound(1.0) }
            }
        };
        let bound = if self.spread > 0.0 { bound.within(&Spread::new(self.spread.into())) } else { bound };
        let two_sided = self.two_sided && bound.normal != [0.0; 3] && self.kind != LampKind::Spot;
        LightBound { two_sided, power: self.power, ..bound }
    }

    #[cfg(feature = "checks")]
    /// The first of its samples by any technique that contributes to a surface at `p` with the normal `n`.
    #[must_use]
    pub fn contribution(&self, p: [f32; 3], n: [f32; 3], u: [f32; 2]) -> Option<LightSample<f32>> {
        let shines = |sample: &LightSample<f32>| {
            let cos = Vec3::from(n).dot(sample.direction);
            let spread = Spread::<f32>::new(self.spread.into());
            let lit = self.spread <= 0.0 || spread.attenuation(sample.direction, sample.normal) > 0.0;
            sample.pdf > 0.0 && cos > 0.0 && lit && (sample.emits || self.two_sided && !sample.delta)
        };
        let position = self.a.into();
        match self.kind {
            LampKind::Point => Some(PointLight { position }.by_delta(p.into()).sample(squares_of(&[u]))).filter(shines),
            LampKind::Spot => {
                let [one_minus_cos_inner, one_minus_cos_outer] = [self.c[0], self.c[1]].map(|cos| 1.0 - cos);
                let light = SpotLight { position, axis: self.b.into(), one_minus_cos_inner, one_minus_cos_outer };
                Some(light.by_delta(p.into()).sample(squares_of(&[u]))).filter(shines)
            }
            LampKind::Area(shape) => {
                let Self { a, b, c, radius, .. } = *self;
                let measures = [Measure::Area, Measure::SolidAngle, Measure::ProjectedSolidAngle];
                let able = measures.into_iter().filter(|&by| AreaLight::KINDS.contains(&(shape, by)));
                let sample = |by| {
                    let light = AreaLight { shape, by, p, a, b, c, n, radius };
                    AreaLight::prepare::<f32>(&[light]).sample(squares_of(&[u]))
                };
                able.map(sample).find(shines)
            }
        }
    }

    /// The same with all lengths multiplied.
    #[must_use]
    pub fn scaled(&self, factor: f32) -> Self {
        let times = |v: [f32; 3]| v.map(|x| x * factor);
        let (b, c) = match self.kind {
            LampKind::Spot => (self.b, self.c),
            LampKind::Area(LightShape::Disk) => (self.b, times(self.c)),
            _ => (times(self.b), times(self.c)),
        };
        Self { a: times(self.a), b, c, radius: self.radius * factor, ..*self }
    }
    /// The same, moved.
    #[must_use]
    pub fn moved(&self, by: V3) -> Self {
        Self { a: narrow(along(wide(self.a), by, 1.0)), ..*self }
    }
}
