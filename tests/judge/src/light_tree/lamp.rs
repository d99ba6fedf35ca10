//! Lights that a tree chooses among: how they are sampled, and the bound that a renderer states of them.

use crate::area_lights::{AreaLight, LightShape, Measure};
use crate::fixture::Fixture;
use crate::packets::squares_of;
use etendue::select::LightBound;
use etendue::{LightSample, Vec3};
use etendue_oracle::{V3, along, cross, length, narrow, sub, unit, wide};

/// A light.
#[derive(Clone, Copy, Debug)]
pub struct Lamp {
    /// What it is.
    pub shape: LightShape,
    /// Corner, centre or position.
    pub a: [f32; 3],
    /// Edge, normal or axis.
    pub b: [f32; 3],
    /// Edge; the cosines of the inner and the outer angle of a spot light.
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
        let (center, radius, normal) = match self.shape {
            LightShape::Sphere => (a, r, ZERO),
            LightShape::Triangle => {
                let center = along(along(a, b, 1.0 / 3.0), c, 1.0 / 3.0);
                let far = [a, along(a, b, 1.0), along(a, c, 1.0)].map(|corner| length(sub(corner, center)));
                (center, far.into_iter().fold(0.0, f64::max), cross(b, c))
            }
            LightShape::Disk => (a, r, b),
            LightShape::Line => (along(a, b, 0.5), 0.5 * length(b), ZERO),
            LightShape::PointLight => (a, 0.0, ZERO),
            LightShape::SpotLight => (a, 0.0, b),
            _ => {
                let diagonals = [1.0, -1.0].map(|sign| length(along(b, c, sign)));
                (along(along(a, b, 0.5), c, 0.5), 0.5 * diagonals[0].max(diagonals[1]), cross(b, c))
            }
        };
        LightBound {
            center: narrow(center),
            radius: (radius * (1.0 + 1e-6)) as f32,
            normal: narrow(unit(normal)),
            cos_cone: match self.shape {
                LightShape::SpotLight => self.c[1],
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
            let cos_light = f64::from(sample.direction.dot(sample.normal)).abs();
            let lit = self.spread <= 0.0 || cos_light > libm::cos(0.5 * f64::from(self.spread));
            sample.pdf > 0.0 && cos > 0.0 && lit && (sample.emits || self.two_sided && !sample.delta)
        };
        let light = AreaLight {
            p,
            radius: self.radius,
            ..AreaLight::seen(self.shape, Measure::Delta, [self.a, self.b, self.c], n)
        };
        let [c, radius] = [self.c[0], self.c[1]].map(|cos| 1.0 - cos);
        let lights = match self.shape {
            LightShape::PointLight => vec![light],
            LightShape::SpotLight => vec![AreaLight { c: [c, 0.0, 0.0], radius, ..light }],
            shape => {
                let measures = [Measure::Area, Measure::SolidAngle, Measure::ProjectedSolidAngle];
                let able = measures.into_iter().filter(|&by| AreaLight::kinds().contains(&(shape, by)));
                able.map(|by| AreaLight { by, ..light }).collect()
            }
        };
        lights.into_iter().map(|light| AreaLight::prepare::<f32>(&[light]).sample(squares_of(&[u]))).find(shines)
    }

    /// The same with all lengths multiplied.
    #[must_use]
    pub fn scaled(&self, factor: f32) -> Self {
        let times = |v: [f32; 3]| v.map(|x| x * factor);
        let (b, c) = match self.shape {
            LightShape::SpotLight => (self.b, self.c),
            LightShape::Disk => (self.b, times(self.c)),
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
