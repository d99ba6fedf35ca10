//! Materials as numbers.

use crate::scene::{Material, Roughness};
use crate::surfaces::coat::Coat;

/// The numbers of a material, so that one transposition gathers eight lanes: roughness α along, η (3), k (3), roughness α across. A
/// mirror has its reflectance in place of η, and k = 0; a coat its reflectances at normal and at grazing incidence. The three low bits of the
/// last number are the kind, and those of the first are 0, so that a roughness that is the same in all directions stays so. The second half
/// is the polynomial of what a layered coat lets through; of a coated metal, whose roughness here is about what it looks like from outside, it is
/// the η of the coat, and the roughness of coat and metal along and across.
pub type MaterialRecord = [[f32; 8]; 2];

// kind 0 is diffuse
pub(super) const MIRROR: u32 = 1;
pub(super) const SMOOTH_METAL: u32 = 2;
pub(super) const ROUGH_METAL: u32 = 3;
pub(super) const COAT: u32 = 4;
/// A coat that dims by the greatest channel of its reflectance.
pub(super) const DIMMING_COAT: u32 = 5;
pub(super) const LAYERED: u32 = 6;
pub(super) const COATED_METAL: u32 = 7;
pub(super) const KIND: u32 = 7;

/// The record of a diffuse surface, with an arbitrary valid roughness.
pub const PLAIN: MaterialRecord = [[1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0], [0.0; 8]];

/// The record of a material; of a varying one it is that of a diffuse surface, since its own depends on the place.
pub fn record(material: &Material) -> MaterialRecord {
    let of = |kind, Roughness { along, across, .. }, [a, b, c]: [f32; 3], [x, y, z]: [f32; 3]| {
        let [along, across] = [along, across].map(|alpha| alpha.to_bits() & !KIND);
        [[f32::from_bits(along), a, b, c, x, y, z, f32::from_bits(across | kind)], [0.0; 8]]
    };
    let smooth = Roughness::from(1.0);
    match *material {
        Material::Diffuse(_) | Material::Varying(_) => PLAIN,
        Material::Glossy { specular, grazing, roughness, greatest, .. } => {
            of(if greatest { DIMMING_COAT } else { COAT }, roughness, specular, grazing)
        }
        Material::Layered { eta, roughness, .. } => {
            let [numbers, _] = of(LAYERED, roughness, [eta; 3], [0.0; 3]);
            [numbers, layer(eta, roughness).through.map(|x| x as f32)]
        }
        Material::CoatedConductor { eta, k, roughness: below, coat, interface: above } => {
            let [eta, k] = [eta, k].map(|of| of.map(|x| x / coat));
            // directions in the coat are nearer to the normal, so that its slopes count η times outside; those of the interface bend light
            // twice by η − 1
            let outside = |above: f32, below: f32| {
                let bent = above * (coat - 1.0);
                (coat * coat).mul_add(below * below, 0.5 * bent * bent).sqrt().clamp(Roughness::LEAST, 1.0)
            };
            let along = outside(above.along, below.along);
            let seen = Roughness { along, across: outside(above.across, below.across), ..below };
            let [numbers, _] = of(COATED_METAL, seen, eta, k);
            [numbers, [coat, above.along, above.across, below.along, below.across, 0.0, 0.0, 0.0]]
        }
        Material::Mirror(reflectance) => of(MIRROR, smooth, reflectance, [0.0; 3]),
        Material::Conductor { eta, k, .. } if material.is_mirror() => of(SMOOTH_METAL, smooth, eta, k),
        Material::Conductor { eta, k, roughness } => of(ROUGH_METAL, roughness, eta, k),
    }
}

/// The coat of a layered material; that of the least roughness is smooth.
fn layer(eta: f32, roughness: Roughness) -> Coat {
    // of both directions, what a surface spreads is that of the mean of their squares, nearly
    let alpha = (0.5 * (roughness.along * roughness.along + roughness.across * roughness.across)).sqrt();
    Coat::new(if alpha > Roughness::LEAST { alpha.into() } else { 0.0 }, eta.into())
}

/// The albedo of a material's diffuse part, with what the coat of a layered one sends back to it; white for metals and mirrors that are not
/// black.
pub fn albedo(material: &Material) -> [f32; 3] {
    match *material {
        Material::Layered { diffuse, eta, roughness } => {
            let inside = layer(eta, roughness).inside;
            diffuse.map(|x| (f64::from(x) / (1.0 - f64::from(x) * inside).max(1e-6)) as f32)
        }
        Material::Diffuse(albedo) | Material::Glossy { diffuse: albedo, .. } => albedo,
        _ if material.is_black() => [0.0; 3],
        Material::Mirror(_) | Material::CoatedConductor { .. } | Material::Conductor { .. } | Material::Varying(_) => {
            [1.0; 3]
        }
    }
}
