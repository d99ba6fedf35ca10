//! Reads scene files: the part of the pbrt-v4 format that direct lighting needs.
//!
//! An unsupported feature is an error that names file and line; a feature that changes the image little, or only its noise, is a
//! warning. Coordinates are transformed in f64 and rounded once to f32.

mod lexer;
mod lights;
mod materials;
mod params;
mod ply;
mod reader;
mod shapes;
mod terrain;
#[cfg(test)]
mod tests;
mod transform;

use crate::files::read_file;
pub use crate::geometry::Geometry;
pub use lights::{DeltaLight, Environment, SkyRadiance};
pub use materials::Material;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::{fmt, io};

/// The contents of a scene file, in world space.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The name of a built-in scene, or the file's name without its extension.
    pub name: String,
    /// The camera; a scene has exactly one.
    pub camera: CameraSettings,
    /// Image size and file name.
    pub film: FilmSettings,
    /// Samples per pixel; 16 by default.
    pub pixel_samples: u32,
    /// Materials without duplicates.
    pub materials: Vec<Material>,
    /// Corners of the triangles that do not emit. The normal is (v1 − v0) × (v2 − v0); no area is zero.
    pub triangles: Vec<[[f32; 3]; 3]>,
    /// One index into `materials` per triangle.
    pub triangle_materials: Vec<u32>,
    /// All spheres, and the triangles and parallelograms that emit.
    pub shapes: Vec<Shape>,
    /// Point, spot and distant lights.
    pub delta_lights: Vec<DeltaLight>,
    /// Light from infinitely far away, if there is any.
    pub environment: Option<Environment>,
    /// Warnings about ignored parts of the file, in the order of the file.
    pub warnings: Vec<Message>,
    /// The files that were read: the scene file itself if [`load`] read it, included files, meshes and images.
    pub inputs: Vec<PathBuf>,
}

/// The image to be written.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmSettings {
    /// Pixels across, 1 to 65,536.
    pub width: u32,
    /// Pixels down, 1 to 65,536; at most 2²⁸ pixels in all.
    pub height: u32,
    /// Diagonal of the film in millimetres, greater than 0; 35 by default.
    pub diagonal: f64,
    /// Name of the image file to write.
    pub filename: Option<String>,
}

/// A perspective camera: a pinhole or a thin lens.
///
/// With `t = tan_half(width, height)`, the ray through image position (x, y) in \[0,1\]², from the top left, has direction
/// `forward + (2x−1) t[0] right + (1−2y) t[1] up`. The three axes are orthonormal if the camera transform is a similarity;
/// `forward` always has length 1.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraSettings {
    /// The pinhole, or the centre of the lens.
    pub origin: [f64; 3],
    /// Towards the middle of the image.
    pub forward: [f64; 3],
    /// Towards the right edge of the image.
    pub right: [f64; 3],
    /// Towards the upper edge of the image.
    pub up: [f64; 3],
    /// Full angle across the shorter side of the image in degrees, in (0, 180).
    pub fov: f64,
    /// The lens, unless its radius is 0.
    pub lens: Option<Lens>,
}

/// A thin lens perpendicular to the camera's axis. It images each point of the film to the point of the plane of focus on the line
/// through its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Radius in camera space, greater than 0.
    pub radius: f64,
    /// Distance of the plane of focus in camera space, greater than 0.
    pub focus: f64,
    /// Length of a unit of camera space in world space.
    pub unit: f64,
}

impl CameraSettings {
    /// Tangents of half the horizontal and vertical angle of view, for an image of this size (both sides at least 1).
    pub fn tan_half(&self, width: u32, height: u32) -> [f64; 2] {
        let shorter = (self.fov.to_radians() / 2.0).tan();
        let aspect = f64::from(width) / f64::from(height);
        if aspect >= 1.0 { [shorter * aspect, shorter] } else { [shorter, shorter / aspect] }
    }
}

/// A shape that is intersected as such, not as triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Form and position in world space.
    pub geometry: Geometry,
    /// Index into [`Scene::materials`].
    pub material: u32,
    /// Emitted light; `None` if the shape is no light.
    pub emission: Option<Emission>,
}

/// Constant emission of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emission {
    /// Radiance, linear RGB; at least one channel is greater than 0.
    pub radiance: [f32; 3],
    /// Whether both sides emit, or only the side of the normal.
    pub two_sided: bool,
}

/// An error or warning about a line of a scene file, shown as `file:line: text`.
#[derive(Clone, Debug, PartialEq)]
pub struct Message {
    /// The file as the user named it, or as its parent included it.
    pub file: String,
    /// The line number, from 1.
    pub line: u32,
    /// What is wrong with the line.
    pub text: String,
}

impl fmt::Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.file, self.line, self.text)
    }
}

/// Why a scene could not be read.
#[derive(Debug)]
pub enum SceneError {
    /// A line is invalid or asks for an unsupported feature.
    At(Message),
    /// The scene file itself could not be read.
    Io {
        /// The path as given by the user.
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
                if error.kind() == io::ErrorKind::NotFound {
                    if let Some(near) = nearest(path) {
                        write!(f, "; did you mean {near}?")?;
                    }
                    let names = BUILTIN.map(|(name, ..)| name).join(", ");
                    write!(f, "; built-in scenes: {names}")?;
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

/// A line of a file, cheap to clone.
#[derive(Clone, Debug)]
struct Place {
    file: Arc<str>,
    line: u32,
}

impl Place {
    fn message(&self, text: impl Into<String>) -> Message {
        Message { file: self.file.to_string(), line: self.line, text: text.into() }
    }
}

const DESCRIBED: [(&str, &str); 10] = [
    ("sphere-light", "two boxes under a sphere light outside the view"),
    ("triangle-light", "a box in front of a large, visible triangle light"),
    ("quads", "three boxes under five quadrilateral lights of very different sizes and powers"),
    ("terrain", "a million triangles, a height field and 25 bumpy spheres, under one square light"),
    ("cornell-box", "the Cornell box from its published data"),
    ("mirror-room", "a room between two mirrors, with a mirror and a gold sphere"),
    ("plates", "four metal plates, smooth to rough, under four sphere lights, small to large"),
    ("delta-lights", "boxes and a ball under a point, a spot and a distant light"),
    ("sky", "a diffuse, a mirror and a rough metal ball under an image of a sky"),
    ("defocus", "a row of spheres seen through a lens focused on the third"),
];

const BUILTIN: [(&str, &str); 10] = [
    (DESCRIBED[0].0, include_str!("../scenes/sphere-light.pbrt")),
    (DESCRIBED[1].0, include_str!("../scenes/triangle-light.pbrt")),
    (DESCRIBED[2].0, include_str!("../scenes/quads.pbrt")),
    (DESCRIBED[3].0, include_str!("../scenes/terrain.pbrt")),
    (DESCRIBED[4].0, include_str!("../scenes/cornell-box.pbrt")),
    (DESCRIBED[5].0, include_str!("../scenes/mirror-room.pbrt")),
    (DESCRIBED[6].0, include_str!("../scenes/plates.pbrt")),
    (DESCRIBED[7].0, include_str!("../scenes/delta-lights.pbrt")),
    (DESCRIBED[8].0, include_str!("../scenes/sky.pbrt")),
    (DESCRIBED[9].0, include_str!("../scenes/defocus.pbrt")),
];

/// Images that built-in scenes refer to.
const BUILTIN_IMAGES: [(&str, &[u8]); 1] = [("sky.exr", include_bytes!("../scenes/sky.exr"))];

/// Name and description of each built-in scene.
pub fn builtin() -> &'static [(&'static str, &'static str)] {
    &DESCRIBED
}

/// Reads the built-in scene of this name, or else the file at this path.
pub fn load(name_or_path: &str) -> Result<Scene, SceneError> {
    if let Some((name, text)) = BUILTIN.iter().find(|(name, _)| *name == name_or_path) {
        return Ok(reader::read(text, &format!("{name}.pbrt"), Path::new("."), true)?);
    }
    let path = Path::new(name_or_path);
    let failed = |error| SceneError::Io { path: name_or_path.to_string(), error };
    let bytes = read_file(path).map_err(failed)?;
    let text = utf8(&bytes, &Arc::from(name_or_path))?;
    let mut scene = parse(text, name_or_path, path.parent().unwrap_or(Path::new("")))?;
    scene.inputs.push(path.to_owned());
    Ok(scene)
}

/// The built-in scene whose name is the fewest letters away from `name`, if it is at most two letters or, as in "quads.pbrt", an
/// extension away.
fn nearest(name: &str) -> Option<&'static str> {
    let name = name.strip_suffix(".pbrt").unwrap_or(name).to_lowercase();
    let near = DESCRIBED.iter().map(|(builtin, _)| (edits(&name, builtin), *builtin)).min()?;
    // two edits turn any name of two letters into another
    (near.0 <= 2 && near.0 < near.1.len().min(name.len())).then_some(near.1)
}

/// The least number of letters to insert, delete or replace that turns `a` into `b` (Levenshtein 1966).
fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = i;
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(x != *y);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

/// Reads a scene from `text`. Messages call it `file`; file names in it are relative to `dir`.
///
/// Any text gives a scene or an error, with bounded recursion.
pub fn parse(text: &str, file: &str, dir: &Path) -> Result<Scene, SceneError> {
    Ok(reader::read(text, file, dir, false)?)
}

/// A colour rounded to f32; `None` if a channel overflows.
fn rounded(rgb: [f64; 3]) -> Option<[f32; 3]> {
    let rgb = rgb.map(|x| x as f32);
    rgb.iter().all(|x| x.is_finite()).then_some(rgb)
}

fn utf8<'a>(bytes: &'a [u8], file: &Arc<str>) -> Result<&'a str, Message> {
    std::str::from_utf8(bytes).map_err(|error| {
        let valid = &bytes[..error.valid_up_to()];
        let line = 1 + valid.iter().filter(|&&b| b == b'\n').count() as u32;
        let byte = bytes[error.valid_up_to()];
        Place { file: file.clone(), line }.message(format!("the byte 0x{byte:02x} is not UTF-8"))
    })
}
