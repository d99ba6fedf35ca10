//! Metals below rough coats.

use etendue_render::scene::{Material, Roughness};

/// What a metal looks like through a coat, approximately: directions in the coat are nearer to the normal, so that its slopes count η times
/// outside, and those of the coat bend light twice by η − 1.
pub(super) fn through_coat(metal: Material, coat: f32, above: f32) -> Material {
    let Material::Conductor { eta, k, roughness } = metal else { return metal };
    let bent = above * above * (coat - 1.0) * (coat - 1.0) * 0.5;
    let outside = |alpha: f32| (coat * coat).mul_add(alpha * alpha, bent).sqrt().clamp(0.0, 1.0);
    let (low, high) = (((coat - 1.0) / (coat + 1.0)).powi(2), |x: f32, k: f32| {
        let (x, k) = (x / coat, k / coat);
        ((x - 1.0).powi(2) + k * k) / ((x + 1.0).powi(2) + k * k)
    });
    let both = |i: usize| {
        let metal = high(eta[i], k[i]);
        low + (1.0 - low) * (1.0 - low) * metal / (1.0 - low * metal)
    };
    let [along, across] = [roughness.along, roughness.across].map(outside);
    Material::Glossy {
        diffuse: [0.0; 3],
        specular: [both(0), both(1), both(2)],
        grazing: [1.0; 3],
        roughness: Roughness { along: along.max(Roughness::LEAST), across: across.max(Roughness::LEAST), turn: 0.0 },
        greatest: false,
    }
}
