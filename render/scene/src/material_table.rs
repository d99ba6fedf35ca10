//! The materials of a scene, each once.

use crate::material_key::words;
use etendue_render::scene::texture::{Mask, Texture};
use etendue_render::scene::{Material, NormalMap, Varying};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::Arc;

/// Materials, which objects and scenes share.
#[derive(Debug, Default)]
pub(super) struct MaterialTable {
    pub(super) all: Vec<Material>,
    pub(super) varying: Vec<Varying>,
    /// By [`words`], and whether they are seen from both sides.
    index: HashMap<([u32; 13], bool), u32>,
    /// Materials with holes: for each the index of the one without, and the mask.
    pub(super) masks: BTreeMap<u32, (u32, Mask)>,
    /// Materials that are seen from the front alone.
    pub(super) single_sided: BTreeSet<u32>,
}

impl MaterialTable {
    /// The index of the material, which is added if it is new.
    pub(super) fn material(&mut self, material: Material) -> u32 {
        self.material_of_sides(material, true)
    }

    /// The index of a material that is seen from both sides, or from the front alone.
    pub(super) fn material_of_sides(&mut self, material: Material, two_sided: bool) -> u32 {
        *self.index.entry((words(material), two_sided)).or_insert_with(|| {
            self.all.push(material);
            let index = (self.all.len() - 1) as u32;
            if !two_sided {
                self.single_sided.insert(index);
            }
            index
        })
    }

    /// A material that varies, or a constant one if its textures do not vary.
    pub(super) fn vary(&mut self, varying: Varying) -> Material {
        varying.constant().unwrap_or_else(|| self.varied(varying))
    }

    /// A material that varies, even if its textures do not.
    pub(super) fn varied(&mut self, varying: Varying) -> Material {
        self.varying.push(varying);
        Material::Varying((self.varying.len() - 1) as u32)
    }

    /// A material whose normals vary.
    pub(super) fn relief(&mut self, material: Material, normals: NormalMap) -> Material {
        let under = match material {
            Material::Varying(index) => self.varying[index as usize].clone(),
            other => Varying::Constant(other),
        };
        self.varied(Varying::Relief(Arc::new((under, normals))))
    }

    /// A material, or the mean of one that varies.
    pub(super) fn mean(&self, material: Material) -> Material {
        match material {
            Material::Varying(index) => self.varying[index as usize].mean(),
            other => other,
        }
    }

    /// The index of a material with holes, by that of the one without.
    pub(super) fn masked(&mut self, whole: u32, mask: Mask) -> u32 {
        let known = self.masks.iter().rev().find(|(_, (other, known))| *other == whole && *known == mask);
        known.map(|(index, _)| *index).unwrap_or_else(|| {
            let index = self.all.len() as u32;
            self.all.push(self.all[whole as usize]);
            if self.single_sided.contains(&whole) {
                self.single_sided.insert(index);
            }
            self.masks.insert(index, (whole, mask));
            index
        })
    }

    /// A material that stands for one that is not known yet.
    pub(super) fn promise(&mut self) -> Material {
        self.varied(Varying::Diffuse(Texture::number(0.5)))
    }

    /// Puts a material where a promise stands for it.
    pub(super) fn keep(&mut self, promise: Material, material: Material) {
        self.all.iter_mut().filter(|other| **other == promise).for_each(|other| *other = material);
    }

    /// Whether texture coordinates matter for a material.
    pub(super) fn varies(&self, material: u32) -> bool {
        let of = &self.all[material as usize];
        matches!(of, Material::Varying(_))
            || of.roughness().is_some_and(|roughness| !roughness.is_isotropic())
            || self.masks.contains_key(&material)
    }
}
