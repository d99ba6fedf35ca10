//! Keys of materials, by which equal ones are found.

use etendue_render::scene::{Material, Roughness};

/// A key for hashing materials: equal ones have equal words.
pub(super) fn words(material: Material) -> [u32; 13] {
    let of = |kind: u32, colors: [[f32; 3]; 3], Roughness { along, across, turn }: Roughness| {
        let [[a, b, c], [d, e, f], [g, h, i]] = colors.map(|color| color.map(f32::to_bits));
        [kind, a, b, c, d, e, f, g, h, i, along.to_bits(), across.to_bits(), turn.to_bits()]
    };
    let (black, none) = ([0.0; 3], Roughness::from(0.0));
    match material {
        Material::Diffuse(albedo) => of(0, [albedo, black, black], none),
        Material::Mirror(reflectance) => of(1, [reflectance, black, black], none),
        Material::Conductor { eta, k, roughness } => of(2, [eta, k, black], roughness),
        Material::Glossy { diffuse, specular, grazing, roughness, greatest } => {
            of(if greatest { 5 } else { 3 }, [diffuse, specular, grazing], roughness)
        }
        Material::Layered { diffuse, eta, roughness } => of(6, [diffuse, [eta; 3], black], roughness),
        Material::CoatedConductor { eta, k, roughness, coat, interface: Roughness { along, across, .. } } => {
            of(7, [eta, k, [coat, along, across]], roughness)
        }
        Material::Varying(index) => [4, index, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0],
    }
}
