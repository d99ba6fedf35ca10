//! Point lights whose intensity differs by direction: a record has the position, the axis of the narrowest cone that holds the light, its index among those,
//! and in the last place the cosine of that cone.

use super::chosen::Chosen;
use super::record::{DIRECTED, LightRecord};
use super::spot::cosine_below;
use crate::packet::{M8, V8, X8, each_group};
use crate::scene::Cone;
use crate::scene::intensity::Intensity;
use etendue::{LightSample, LightSampler, PointLight, Real, SpotLight, Vec2, Vec3};
use std::f64::consts::PI;
use std::sync::Arc;

/// What a light emits, and how it is turned.
#[derive(Clone, Debug)]
pub(super) struct DirectedLight {
    /// Rows of the matrix from the world to the light.
    rows: [[f32; 3]; 3],
    intensity: Arc<Intensity>,
    /// The cone of a spot light.
    cone: Option<SpotLight<f32>>,
}

impl DirectedLight {
    /// A light of this intensity, turned by the rows of a matrix.
    pub(super) fn new(position: [f32; 3], rows: [[f32; 3]; 3], intensity: &Arc<Intensity>, cone: Option<Cone>) -> Self {
        let cone = cone.map(|Cone { axis, one_minus_cos_inner, one_minus_cos_outer, .. }| SpotLight {
            position: position.into(),
            axis: axis.into(),
            one_minus_cos_inner,
            one_minus_cos_outer,
        });
        Self { rows, intensity: Arc::clone(intensity), cone }
    }
    /// The light with this greatest intensity; it is the one of this index among those of a scene.
    pub(super) fn record(&self, position: [f32; 3], radiance: [f32; 3], cone: Option<Cone>, index: u32) -> LightRecord {
        // the narrower of two cones
        let own = (self.rows[2], self.intensity.cos_cone());
        let (first, cos) = match cone {
            Some(Cone { axis, one_minus_cos_outer: outer, .. }) if cosine_below(outer) >= own.1 => {
                (axis, cosine_below(outer))
            }
            _ => own,
        };
        let second = [f32::from_bits(index), 0.0, cos];
        let flux = cone.map_or_else(|| self.intensity.flux(), |cone| cone.flux);
        let power = (0..3).map(|k| f64::from(radiance[k]) * flux).sum::<f64>() / PI;
        LightRecord { first, second, ..LightRecord::bare(DIRECTED, position, radiance, power) }
    }
}

/// Samples directed lights from the points `p` in the lanes that have some, and what their intensities there are, relative to the greatest. Not inlined,
/// since it would burden scenes without such lights.
#[inline(never)]
pub(super) fn sample(lights: &[DirectedLight], chosen: &Chosen, p: V8, here: M8) -> (LightSample<X8>, X8) {
    let index = chosen.second.x.to_bits();
    let mut found = X8::default();
    let sample = PointLight::new(chosen.place).by_delta(p).sample(Vec2::default());
    let w = -sample.direction;
    each_group(index, here, |light, same| {
        let DirectedLight { rows, intensity, cone } = &lights[light as usize];
        let [x, y, z] = rows.map(|row| V8::from(row).dot(w));
        let mut own = intensity.at(Vec3::new(x, y, z));
        if let Some(cone) = cone {
            own *= SpotLight::splat(*cone).falloff(w);
        }
        found = Real::blend(same, own, found);
    });
    let some = found.gt(X8::lit(0.0));
    (LightSample { pdf: sample.pdf.keep(some), emits: sample.emits & some, ..sample }, found)
}
