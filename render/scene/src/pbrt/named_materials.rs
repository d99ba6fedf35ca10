//! The materials that a scene names. A name may precede its definition, as in pbrt.

use super::material_parameters::Finish;
use super::mixtures::{Mixture, greatest};
use crate::builder::Builder;
use crate::message::{Place, shortened};
use crate::nearest::did_you_mean;
use etendue_render::scene::{Material, Message};
use std::collections::HashMap;

/// A material that is named before it is defined.
#[derive(Debug)]
struct Awaited {
    name: String,
    place: Place,
    /// What stands for it, if a shape uses it.
    promise: Option<Material>,
}

/// The materials that were named and defined so far.
#[derive(Debug, Default)]
pub(super) struct NamedMaterials {
    defined: HashMap<String, Finish>,
    awaited: Vec<Awaited>,
}

impl NamedMaterials {
    /// Defines a material.
    pub(super) fn define(&mut self, name: String, finish: Finish) {
        self.defined.insert(name, finish);
    }
    /// A material that is defined.
    pub(super) fn get(&self, name: &str) -> Option<Finish> {
        self.defined.get(name).copied()
    }
    /// The material of a name, which may be defined later. `place` is the line that names it.
    pub(super) fn named(&mut self, name: String, place: Place) -> Finish {
        self.get(&name).unwrap_or_else(|| {
            self.awaited.push(Awaited { name, place, promise: None });
            Finish::Awaited(self.awaited.len() - 1)
        })
    }
    /// The material of a shape; `None` if rays pass it.
    pub(super) fn of_shape(&mut self, finish: Finish, out: &mut Builder) -> Option<Material> {
        match finish {
            Finish::Of(material) => Some(material),
            // a mixture comes as its parts
            Finish::Invisible | Finish::Mix(_) => None,
            Finish::Awaited(index) => match self.get(&self.awaited[index].name) {
                Some(finish) => self.of_shape(finish, out),
                None => Some(*self.awaited[index].promise.get_or_insert_with(|| out.materials.promise())),
            },
        }
    }
    /// Gives shapes the materials that were defined after them.
    pub(super) fn keep_promises(&self, mixtures: &[Mixture], out: &mut Builder) -> Result<(), Message> {
        for Awaited { name, place, promise } in &self.awaited {
            let Some(promise) = promise else { continue };
            let shown = shortened(name);
            match self.get(name) {
                Some(finish @ (Finish::Of(_) | Finish::Mix(_))) => {
                    if let Finish::Of(material) = greatest(finish, mixtures) {
                        out.materials.keep(*promise, material);
                    }
                }
                Some(_) => return Err(place.message(format!("{shown:?} is no surface: define it before its shapes"))),
                None => {
                    let near = did_you_mean(name, self.defined.keys().map(String::as_str));
                    let why = "a diffuse surface of albedo 0.5 stands for it";
                    out.notes.misspelt(place.message(format!("no MakeNamedMaterial defines {shown:?}: {why}{near}")));
                    out.materials.keep(*promise, Material::Diffuse([0.5; 3]));
                }
            }
        }
        Ok(())
    }
}
