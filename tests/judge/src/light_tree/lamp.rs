//! Lights that a tree chooses among: how they are sampled, and the bound that a renderer states of them.

use crate::area_lights::{AreaLight, LightShape, Measure};
use crate::packets::squares_of;
use crate::techniques::LightFixture;
#[cfg(feature = "checks")]
use etendue::light::Spread;
use etendue::select::LightBound;
use etendue::{LightSample, LightSampler, PointLight, SpotLight, Vec3};
use etendue_oracle::{V3, along, cross, length, narrow, sub, unit, wide};

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

const ZERO: V3 = [0.0; 3];

impl Lamp {
    /// What the renderer tells the tree about it.
    #[must_use]
    pub fn bound(&self) -> LightBound {
        let [a, b, c] = [self.a, self.b, self.c].map(wide);
        let r = f64::from(self.radius).abs();
        let (center, radius, normal) = match self.kind {
            LampKind::Area(LightShape::Sphere) => (a, r, ZERO),
            LampKind::Area(LightShape::Triangle) => {
                let center = along(along(a, b, 1.0 / 3.0), c, 1.0 / 3.0);
                let far = [a, along(a, b, 1.0), along(a, c, 1.0)].map(|corner| length(sub(corner, center)));
                (center, far.into_iter().fold(0.0, f64::max), cross(b, c))
            }
            LampKind::Area(LightShape::Disk) => (a, r, b),
            LampKind::Area(LightShape::Line) => (along(a, b, 0.5), 0.5 * length(b), ZERO),
            LampKind::Area(_) => {
                let diagonals = [1.0, -1.0].map(|sign| length(along(b, c, sign)));
                (along(along(a, b, 0.5), c, 0.5), 0.5 * diagonals[0].max(diagonals[1]), cross(b, c))
            }
            LampKind::Point => (a, 0.0, ZERO),
            LampKind::Spot => (a, 0.0, b),
        };
        LightBound {
            center: narrow(center),
            radius: (radius * (1.0 + 1e-6)) as f32,
            normal: narrow(unit(normal)),
            cos_cone: match self.kind {
                LampKind::Spot => self.c[1],
                // less a rounding
                _ if self.spread > 0.0 => (libm::cos(0.5 * f64::from(self.spread)) * (1.0 - 1e-5)) as f32,
                _ => 0.0,
            },
            two_sided: self.two_sided && length(normal) > 0.0,
            power: self.power,
        }
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
