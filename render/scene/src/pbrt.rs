//! Reads scene files in the format of pbrt, and the built-in scenes, which are in it.

mod area_lights;
mod blocks;
mod builtin;
mod daylight;
mod directed;
mod film_and_camera;
mod generated;
mod given;
mod ies;
mod includes;
mod inputs;
mod lexer;
mod lights;
mod material_parameters;
mod mixtures;
mod named_materials;
mod params;
mod patches;
mod ply;
mod portal_sides;
mod portals;
mod profiles;
mod reader;
mod shape_state;
mod shapes;
mod sources;
mod spectrum;
mod subdivision;
mod textures;
mod transform_directives;

use crate::message::utf8;
pub(crate) use builtin::known_scenes;
pub use builtin::{builtin, builtin_of_few_lights};
use etendue_render::scene::{Message, Scene};
use reader::Origin;
use std::path::Path;
use std::sync::Arc;

/// Reads the built-in scene of this name, if there is one.
pub(super) fn read_builtin(name: &Path) -> Option<Result<Scene, Message>> {
    let (name, text) = builtin::text_of(name)?;
    Some(reader::read(text, &format!("{name}.pbrt"), Path::new("."), Origin::Builtin))
}

/// Reads the bytes of the file at a path, which messages call `shown`.
pub(super) fn read(path: &Path, bytes: &[u8], shown: &str) -> Result<Scene, Message> {
    let folder = path.parent().unwrap_or(Path::new(""));
    reader::read(utf8(bytes, &Arc::from(shown))?, shown, folder, Origin::File(path))
}

/// Reads a text, which messages call `file`; file names in it are relative to `dir`.
pub(super) fn parse(text: &str, file: &str, dir: &Path) -> Result<Scene, Message> {
    reader::read(text, file, dir, Origin::Text)
}
