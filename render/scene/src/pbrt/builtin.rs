//! The built-in scenes.

use crate::nearest::{did_you_mean, nearest};
use std::fs;
use std::path::{Path, PathBuf};

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

/// What to say where a file is missing: its name may be that of a picture to be written, of another file in its folder, or of a built-in
/// scene, misspelt.
pub(crate) fn known_scenes(name: &str) -> String {
    let path = Path::new(name);
    let extension = |path: &Path| path.extension().map(|text| text.to_string_lossy().to_lowercase());
    let is_of = |path: &Path, known: &[&str]| extension(path).is_some_and(|text| known.contains(&&*text));
    if is_of(path, &["png", "exr", "jpg", "jpeg", "hdr"]) {
        return format!("; -o writes an image: etendue render SCENE -o {}", path.with_extension("exr").display());
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let beside = fs::read_dir(folder.unwrap_or(Path::new("."))).into_iter().flatten().flatten();
    let scenes =
        beside.map(|entry| PathBuf::from(entry.file_name())).filter(|path| is_of(path, &["pbrt", "gltf", "glb"]));
    let scenes: Vec<String> = scenes.map(|path| path.display().to_string()).collect();
    let own = path.file_name().unwrap_or_default().to_string_lossy();
    let same = scenes.iter().find(|scene| Path::new(scene).file_stem() == path.file_name()).map(String::as_str);
    if let Some(near) = same.or_else(|| nearest(&own, scenes.iter().map(String::as_str))) {
        return format!("; did you mean {}?", path.with_file_name(near).display());
    }
    // "quads.pbrt" is an extension away
    let near = did_you_mean(name.strip_suffix(".pbrt").unwrap_or(name), DESCRIBED.map(|(name, _)| name));
    if near.is_empty() && extension(path).is_some() {
        return String::new();
    }
    let known = if near.is_empty() { "; built-in scenes" } else { " Built-in scenes" };
    format!("{near}{known}: {}", DESCRIBED.map(|(name, _)| name).join(", "))
}
