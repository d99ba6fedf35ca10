//! Reads scene files: glTF 2.0 (feature `gltf`), and the part of the pbrt-v4 format that direct lighting needs (feature `pbrt`), in which
//! the built-in scenes are, too.
//!
//! Coordinates are transformed in f64 and rounded once to f32. Errors name the file, and the line or item. What changes
//! the image little, or only its noise, is a warning. Unsupported features are replaced, with one warning for each kind, which
//! [`Scene::stand_ins`] has, too, as those of parameters that may be misspelt.
//!
//! [`list`] says of everything that the formats can say what becomes of it; the pages `render/formats/pbrt.md` and `gltf.md` are made of it.

// what both formats share is more than either needs
#![cfg_attr(not(all(feature = "gltf", feature = "pbrt")), allow(dead_code, unused_variables))]

mod asked;
mod builder;
mod distribution;
mod files;
#[cfg(feature = "gltf")]
mod gltf;
pub mod image;
mod lamps;
pub mod list;
mod material_key;
mod material_table;
mod message;
mod nearest;
#[cfg(feature = "pbrt")]
mod pbrt;
mod radiance;
mod shape_attributes;
mod transform;
mod vertices;

pub use asked::{Asked, Contents};
use etendue_render::film::files::read_file;
use etendue_render::scene::{Environment, Message, Scene};
use files::{note, read_unpacked};
#[cfg(feature = "pbrt")]
pub use pbrt::{builtin, builtin_of_few_lights};
use std::path::Path;
use std::{fmt, io};

/// Why a scene could not be read.
#[derive(Debug)]
pub enum SceneError {
    /// A line is invalid or asks for an unsupported feature.
    At(Message),
    /// The scene file itself could not be read.
    Io {
        /// The path as given by the user, as text.
        path: String,
        /// The system's error.
        error: io::Error,
    },
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SceneError::At(message) => message.fmt(f),
            SceneError::Io { path, error } => {
                write!(f, "cannot read {path:?}: {error}")?;
                #[cfg(feature = "pbrt")]
                if error.kind() == io::ErrorKind::NotFound {
                    write!(f, "{}", pbrt::known_scenes(path))?;
                }
                Ok(())
            }
        }
    }
}

impl std::error::Error for SceneError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            SceneError::At(_) => None,
            SceneError::Io { error, .. } => Some(error),
        }
    }
}

impl From<Message> for SceneError {
    fn from(message: Message) -> Self {
        SceneError::At(message)
    }
}

/// Reads the built-in scene of this name, or else the file at this path: glTF if its name ends in `.gltf` or `.glb`, or else pbrt's format.
pub fn load(name_or_path: impl AsRef<Path>) -> Result<Scene, SceneError> {
    load_as(name_or_path, &Asked::default())
}

/// Like [`load`], with what is asked for.
pub fn load_as(name_or_path: impl AsRef<Path>, asked: &Asked) -> Result<Scene, SceneError> {
    let path = name_or_path.as_ref();
    let shown = path.display().to_string();
    #[cfg(feature = "pbrt")]
    let builtin = pbrt::read_builtin(path);
    #[cfg(not(feature = "pbrt"))]
    let builtin: Option<Result<Scene, Message>> = None;
    let (mut scene, is_gltf) = match builtin {
        Some(scene) => (only_camera(&shown, asked).and(scene)?, false),
        None => {
            let bytes = read_unpacked(path).map_err(|error| SceneError::Io { path: shown.clone(), error })?;
            let (mut scene, is_gltf) = decode(path, &bytes, &shown, asked)?;
            note(&mut scene.inputs, path, &bytes);
            (scene, is_gltf)
        }
    };
    if let Some(sky) = &asked.sky {
        light_by(&mut scene, is_gltf, sky)?;
    }
    Ok(scene)
}

/// What a file offers a choice of.
pub fn contents(path: impl AsRef<Path>, asked: &Asked) -> Result<Contents, SceneError> {
    let path = path.as_ref();
    #[cfg(feature = "gltf")]
    {
        let shown = path.display().to_string();
        let bytes = read_unpacked(path).map_err(|error| SceneError::Io { path: shown.clone(), error })?;
        if gltf::is_gltf(path, &bytes) {
            return Ok(gltf::contents(&bytes, &shown, asked)?);
        }
    }
    load_as(path, asked)?;
    Ok(Contents { scenes: Vec::new(), cameras: vec![String::new()] })
}

/// Fails if another camera or scene is asked for than the only one of a file.
fn only_camera(shown: &str, asked: &Asked) -> Result<(), Message> {
    let wrong = |what: &str| {
        let text = format!("files of pbrt have one {what}: {what} cannot be chosen");
        Err(Message { file: shown.to_owned(), line: 0, text })
    };
    match (&asked.camera, &asked.scene) {
        (None, None) => Ok(()),
        (Some(_), _) => wrong("camera"),
        (None, Some(_)) => wrong("scene"),
    }
}

/// Lights a scene by the image at a path.
fn light_by(scene: &mut Scene, is_gltf: bool, path: &Path) -> Result<(), Message> {
    let shown = path.display().to_string();
    let message = |text: String| Message { file: shown.clone(), line: 0, text };
    let bytes = read_file(path).map_err(|error| message(format!("cannot read: {error}")))?;
    let image = image::decode(path, &bytes).map_err(|error| message(error.what().to_owned()))?;
    let (sky, warning) = radiance::sky_of(&image, "the sky", [1.0; 3]).map_err(message)?;
    scene.warnings.extend(warning.map(message));
    if sky.is_some() {
        scene.warnings.retain(|warning| !warning.text.starts_with(builder::DARK));
    } else {
        scene.warnings.push(message("the sky is black".to_owned()));
    }
    let to_light = match is_gltf {
        true => [[-1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]],
        false => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    };
    scene.environment = sky.map(|sky| Environment { to_light, sky, portals: Vec::new(), sun: None });
    note(&mut scene.inputs, path, &bytes);
    Ok(())
}

/// The scene of a file's bytes, and whether it is a glTF file. Messages call it `shown`.
fn decode(path: &Path, bytes: &[u8], shown: &str, asked: &Asked) -> Result<(Scene, bool), Message> {
    #[cfg(feature = "gltf")]
    if gltf::is_gltf(path, bytes) {
        return Ok((gltf::read(bytes, shown, path.parent(), asked)?, true));
    }
    if let Some(format) = image::format_of(bytes) {
        let text = format!("this is a picture ({format}), and no scene: --environment FILE lights a scene by it");
        return Err(Message { file: shown.to_owned(), line: 0, text });
    }
    only_camera(shown, asked)?;
    #[cfg(feature = "pbrt")]
    return pbrt::read(path, bytes, shown).map(|scene| (scene, false)).map_err(|mut message| {
        if !shown.contains(".pbrt") && message.file == shown && message.text.starts_with("unknown directive") {
            message.text += "; a file whose name does not end in .gltf or .glb is read as one of pbrt";
        }
        message
    });
    #[cfg(not(feature = "pbrt"))]
    return Err(Message {
        file: shown.to_owned(),
        line: 0,
        text: "this program reads no files of this kind".to_owned(),
    });
}

/// Reads a scene from `text`. Messages call it `file`; file names in it are relative to `dir`.
///
/// Any text gives a scene or an error, with bounded recursion.
#[cfg(feature = "pbrt")]
pub fn parse(text: &str, file: &str, dir: &Path) -> Result<Scene, SceneError> {
    Ok(pbrt::parse(text, file, dir)?)
}

/// Reads a glTF scene from the bytes of a text or binary file that names no other files. Messages call it `file`.
///
/// Any bytes give a scene or an error, with bounded recursion.
#[cfg(feature = "gltf")]
pub fn parse_gltf(bytes: &[u8], file: &str) -> Result<Scene, SceneError> {
    Ok(gltf::read(bytes, file, None, &Asked::default())?)
}
