//! Point lights whose intensity differs by direction.

use crate::intensity::Intensity;
use crate::packet::{M8, V8, X8, each_group};
use crate::scene::{Cone, DeltaLight, Scene};
use etendue::{LightSample, LightSampler, PointLight, Real, SpotLight, Vec2, Vec3, u32x8};
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

/// Those of a scene, in the order of its delta lights.
pub(super) fn directed_lights(scene: &Scene) -> Vec<DirectedLight> {
    let light = |light: &DeltaLight| match *light {
        DeltaLight::Directed { position, to_light: rows, table, cone, .. } => {
            let cone = cone.map(|Cone { axis, one_minus_cos_inner, one_minus_cos_outer, .. }| SpotLight {
                position: position.into(),
                axis: axis.into(),
                one_minus_cos_inner,
                one_minus_cos_outer,
            });
            Some(DirectedLight { rows, intensity: Arc::clone(&scene.intensities[table as usize]), cone })
        }
        _ => None,
    };
    scene.delta_lights.iter().filter_map(light).collect()
}

/// Samples lights at these places from the points `p` in some lanes, and returns their relative intensities there, too. Not inlined, since
/// it would burden scenes without such lights.
#[inline(never)]
pub(super) fn sample(lights: &[DirectedLight], index: u32x8, place: V8, p: V8, here: M8) -> (LightSample<X8>, V8) {
    let mut found = V8::default();
    let look_up = |w: V8| {
        each_group(index, here, |light, same| {
            let DirectedLight { rows, intensity, cone } = &lights[light as usize];
            let [x, y, z] = rows.map(|row| V8::from(row).dot(w));
            let mut own = intensity.at(Vec3::new(x, y, z));
            if let Some(cone) = cone {
                own = own * SpotLight::splat(*cone).falloff(w);
            }
            found = V8::blend(same, own, found);
        });
        let some = (found.x + found.y + found.z).gt(X8::lit(0.0));
        X8::lit(1.0).keep(some)
    };
    let sample = PointLight::new(place).by_profile(p, look_up).sample(Vec2::default());
    (sample, found)
}
