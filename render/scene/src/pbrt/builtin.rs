//! The built-in scenes.

use crate::nearest::did_you_mean;
use std::path::Path;

macro_rules! scenes {
    ($count:literal: $($name:literal $about:literal)*) => {
        /// Name and description of each scene.
        const DESCRIBED: [(&str, &str); $count] = [$(($name, $about)),*];
        /// Name and text of each scene.
        const BUILTIN: [(&str, &str); $count] =
            [$(($name, include_str!(concat!("../../../scenes/", $name, ".pbrt")))),*];
    };
}

scenes! { 15:
    "studio" "seven coloured blocks under three lamps and a panel: the first picture of the README"
    "sphere-light" "two boxes under a sphere light outside the view"
    "triangle-light" "a box in front of a large, visible triangle light"
    "quads" "three boxes under five quadrilateral lights of very different sizes and powers"
    "terrain" "a million triangles, a height field and 25 bumpy spheres, under one square light"
    "cornell-box" "the Cornell box from its published data"
    "mirror-room" "a room between two mirrors, with a mirror and a gold sphere"
    "plates" "four metal plates, smooth to rough, under four sphere lights, small to large"
    "delta-lights" "boxes and a ball under a point, a spot and a distant light"
    "sky" "a diffuse, a mirror and a rough metal ball under an image of a sky"
    "defocus" "a row of spheres seen through a lens focused on the third"
    "chandelier" "a chandelier of 1,000 lights, bulbs and plates of glass, in a room"
    "city" "a city at night with 109,655 lights: windows, street lamps and cars"
    "wet-city" "the city after rain: its streets reflect 109,655 lights"
    "knot" "a knot of neon tube, a mesh of 1,000,000 triangles that emit, above a floor"
}

/// How many of them, the last ones, have many lights.
const MANY_LIGHTS: usize = 4;

/// Images that these scenes refer to.
pub(super) const BUILTIN_IMAGES: [(&str, &[u8]); 1] = [("sky.exr", include_bytes!("../../../scenes/sky.exr"))];

/// Name and description of each built-in scene.
pub fn builtin() -> &'static [(&'static str, &'static str)] {
    &DESCRIBED
}

/// The built-in scenes of at most [`FEW`](etendue_render::choose::allocation::FEW) lights. What renders every scene many times keeps to these, so that it does
/// not take many times longer.
pub fn builtin_of_few_lights() -> &'static [(&'static str, &'static str)] {
    DESCRIBED.split_at(DESCRIBED.len() - MANY_LIGHTS).0
}

/// Name and text of the built-in scene of this name.
pub(super) fn text_of(name: &Path) -> Option<(&'static str, &'static str)> {
    BUILTIN.into_iter().find(|(known, _)| name.as_os_str() == *known)
}

/// What to say where a file is missing, whose name may be that of a built-in scene, misspelt.
pub(crate) fn known_scenes(name: &str) -> String {
    // "quads.pbrt" is an extension away
    let near = did_you_mean(name.strip_suffix(".pbrt").unwrap_or(name), DESCRIBED.map(|(name, _)| name));
    let known = if near.is_empty() { "; built-in scenes" } else { " Built-in scenes" };
    format!("{near}{known}: {}", DESCRIBED.map(|(name, _)| name).join(", "))
}
