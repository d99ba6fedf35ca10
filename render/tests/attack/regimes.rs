//! Random scenes by regime: each has one kind of difficulty, and a few have several.

mod bodies;
pub(crate) mod lights;
mod others;
mod people;
mod places;

use super::build::{has_area, has_speck};
use super::draft::{Draft, Form};
use crate::random::Random;

/// A kind of difficulty.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Regime {
    /// What it is called.
    pub(crate) name: &'static str,
    /// What its scenes are.
    pub(crate) about: &'static str,
    make: fn(&mut Random) -> Draft,
    /// Whether lights may appear so small that some images have a sample of them and others have not.
    has_specks: bool,
}

const fn regime(name: &'static str, about: &'static str, make: fn(&mut Random) -> Draft) -> Regime {
    Regime { name, about, make, has_specks: false }
}

/// All regimes.
pub(crate) const REGIMES: [Regime; 39] = [
    regime("thin", "closed sheets with thicknesses of 1e-5 to 1e-2 of their size", bodies::thin),
    regime("chamfered", "boxes with corners cut off at 1e-7 to 1e-1 of their size", bodies::chamfered),
    regime("open", "bodies that lack triangles", bodies::open),
    regime("inverted", "bodies with some or all triangles turned over", bodies::inverted),
    regime("nested", "boxes within boxes", bodies::nested),
    regime("touching", "boxes that stand on the floor, side by side and on each other", bodies::touching),
    regime("coplanar", "faces in the same plane, and faces twice", bodies::coplanar),
    regime("soup", "loose triangles that cross each other", bodies::soup),
    regime("balls", "spheres before spheres and flat lights", bodies::balls),
    regime("in-sphere", "floor and camera in a sphere, with lights in and outside of it", places::in_sphere),
    regime("in-box", "floor and camera in a box, with lights in and outside of it", places::in_box),
    regime("far-away", "10 to 1e3 from the origin", places::far_away),
    regime("vast-floor", "floors of 1e2 to 1e7 under scenes of size 1", places::vast_floor),
    regime("camera", "cameras in and on things", places::camera),
    regime("lens", "through a lens", places::lens),
    regime("mirrors", "plane mirrors and mirror balls", places::mirrors),
    regime("metals", "rough metals", places::metals),
    regime("tiny-light", "lights of 1e-5 to 1e-2 behind bodies and balls", lights::tiny),
    regime("far-light", "lights at 1e2 to 1e6 that appear as large as the sun", lights::far),
    regime("far-speck", "lights at 1e2 to 1e6 that appear under 1e-4 to 1e-2", lights::far_speck),
    regime("millimetres", "parallelograms of 1e-3 to 1e-1 with coordinates of 40 to 700", lights::millimetres),
    regime("sun-and-lamp", "a sun at 1e2 to 1e6 with a lamp beside the bodies", lights::sun_and_lamp),
    regime("lampshade", "screens close to far sphere lights", lights::lampshade),
    regime("flush", "lamps flush with a ceiling, or just below or above it", lights::flush),
    regime("copies", "scenes of the regimes above whose meshes are instances in the same places", others::copies),
    regime("instances", "instances that are turned, mirrored, stretched, and on the floor", others::instanced),
    regime("odd-units", "instances of objects with units of 1e-4 to 1e4, far from their origins", others::odd_units),
    regime("holes", "screens and bodies with holes and veils", others::holes),
    regime("punched", "scenes of the regimes above with holes in meshes", others::punched),
    regime("painted", "scenes of the regimes above with textures on meshes", others::painted),
    regime("smooth", "scenes of the regimes above with normals of smooth surfaces", others::smooth),
    regime("coats", "rough coats over diffuse surfaces, some of them textured or smooth", others::coated),
    regime("everything", "instances with holes, textures and normals of smooth surfaces", others::everything),
    regime("skies", "skies, suns and lamps over floors of 1 to 1e5", people::skies),
    regime("wild-normals", "vertex normals that fit no surface", people::wild),
    Regime { has_specks: true, ..regime("one-of-many", "up to 40 lights of which few matter", people::one_of_many) },
    Regime {
        has_specks: true,
        ..regime("rare", "what few samples meet has most of the light: specks, slivers, keyholes", lights::rare)
    },
    regime("films", "parts of wide and high films, and orthographic cameras", people::films),
    regime("walls", "walls up to 1e3 times as long as high, with a lamp behind them", bodies::walls),
];

/// The regime of this name.
pub(crate) fn named(name: &str) -> &'static Regime {
    REGIMES.iter().find(|regime| regime.name == name).unwrap_or_else(|| panic!("no regime is called {name:?}"))
}

impl Regime {
    /// The scene of a seed.
    pub(crate) fn draft(&self, seed: u64) -> Draft {
        let name = self.name.bytes().fold(0_u64, |h, b| h.wrapping_mul(131).wrapping_add(b.into()));
        for attempt in 0.. {
            let mut random = Random::new(seed.wrapping_mul(0x100).wrapping_add(attempt) ^ name << 40);
            let mut draft = (self.make)(&mut random);
            for part in &mut draft.parts {
                if let Form::Mesh(triangles) = &mut part.form {
                    triangles.retain(has_area);
                }
            }
            draft.parts.retain(|part| part.size() > 0);
            draft.name = format!("{} {seed}, {}", self.name, self.about);
            if attempt == 99 || self.has_specks || !has_speck(&draft) {
                return draft;
            }
        }
        unreachable!("the last attempt is taken")
    }
}
