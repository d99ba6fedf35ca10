//! What a scene file describes.

use super::area::PlaceInImage;
use super::environment::Environment;
use super::inputs::Input;
use super::intensity::Intensity;
use super::light_picture::LightPicture;
use super::light_profile::LightProfile;
use super::lights::{DeltaLight, Emission};
use super::materials::{Material, Varying};
use super::message::Message;
use super::texture::Mask;
use crate::geometry::{Geometry, Instance};
use std::ops::Range;
use std::sync::Arc;
use xxhash_rust::xxh3::Xxh3;

/// Everything that an image shows, in world space.
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
    /// Corners of the triangles that do not emit. The normal is (v1 − v0) × (v2 − v0); no area is zero. Those of objects follow the others.
    pub triangles: Vec<[[f32; 3]; 3]>,
    /// The triangles of each object, in the object's space; they follow each other, to the end.
    pub objects: Vec<Range<usize>>,
    /// Where objects are.
    pub instances: Vec<Instance>,
    /// One index into `materials` per triangle.
    pub triangle_materials: Vec<u32>,
    /// Materials that vary over their surfaces.
    pub varying: Vec<Varying>,
    /// The materials that have holes, in ascending order, and their masks.
    pub masks: Vec<(u32, Mask)>,
    /// The materials whose backs rays from the camera pass, in ascending order.
    pub single_sided: Vec<u32>,
    /// Normals and texture coordinates of triangles that have them.
    pub details: Arc<Details>,
    /// All shapes that emit, and those that do not but are no triangles. What renders the scene shares them.
    pub shapes: Arc<[Shape]>,
    /// The pictures that shapes emit. What renders the scene shares them.
    pub pictures: Arc<[LightPicture]>,
    /// How shapes with profiles distribute what they emit. What renders the scene shares them.
    pub profiles: Arc<[LightProfile]>,
    /// Point, spot and distant lights.
    pub delta_lights: Vec<DeltaLight>,
    /// Relative intensities of those that differ by direction.
    pub intensities: Vec<Arc<Intensity>>,
    /// Light from infinitely far away, if there is any.
    pub environment: Option<Environment>,
    /// Warnings about ignored parts of the file, in the order of the file.
    pub warnings: Vec<Message>,
    /// Those of the warnings that say that something stands for something else, which direct light on opaque surfaces cannot show.
    pub stand_ins: Vec<Message>,
    /// The files that were read: the scene file itself, included files, meshes and images.
    pub inputs: Vec<Input>,
}

impl Scene {
    /// Hash of the files of the scene as they were read, in hexadecimal digits; of its name if it is built in.
    #[must_use]
    pub fn digest(&self) -> String {
        let mut hash = Xxh3::new();
        hash.update(self.name.as_bytes());
        self.inputs.iter().for_each(|input| hash.update(&input.hash.to_le_bytes()));
        format!("{:032x}", hash.digest128())
    }
}

impl Scene {
    /// A scene without surfaces and lights, seen by a camera in an image of this width and height in pixels.
    #[must_use]
    pub fn new(camera: CameraSettings, [width, height]: [u32; 2]) -> Self {
        Self {
            name: String::new(),
            camera,
            film: FilmSettings { width, height, diagonal: 35.0, filename: None, place: None, exposure: 1.0 },
            pixel_samples: 16,
            materials: Vec::new(),
            triangles: Vec::new(),
            objects: Vec::new(),
            instances: Vec::new(),
            triangle_materials: Vec::new(),
            varying: Vec::new(),
            masks: Vec::new(),
            single_sided: Vec::new(),
            details: Arc::default(),
            shapes: Arc::default(),
            pictures: Arc::default(),
            profiles: Arc::default(),
            delta_lights: Vec::new(),
            intensities: Vec::new(),
            environment: None,
            warnings: Vec::new(),
            stand_ins: Vec::new(),
            inputs: Vec::new(),
        }
    }
}

/// Normals and texture coordinates of the triangles that have them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Details {
    /// For each triangle an index into `corners`, or [`Details::NONE`]; empty if no triangle has any.
    pub of_triangles: Vec<u32>,
    /// Normals and texture coordinates.
    pub corners: Vec<Corners>,
    /// Colours at the corners, linear RGB from 0 to 1, by which the albedo of varying materials is multiplied; in the order of `corners`, and
    /// white where there are fewer.
    pub colors: Vec<[[f32; 3]; 3]>,
}

impl Details {
    /// The index of no corners.
    pub const NONE: u32 = u32::MAX;

    /// What is known at the corners of a triangle, if anything is.
    #[inline]
    pub fn of(&self, triangle: u32) -> Option<&Corners> {
        self.corners.get(*self.of_triangles.get(triangle as usize)? as usize)
    }
    /// The colours at the corners of a triangle.
    #[inline]
    pub fn colors_of(&self, triangle: u32) -> [[f32; 3]; 3] {
        let index = self.of_triangles.get(triangle as usize);
        index.and_then(|index| self.colors.get(*index as usize)).copied().unwrap_or([[1.0; 3]; 3])
    }
}

/// What is known at the corners of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corners {
    /// Unit normals of the smooth surface that the triangle stands for, on either side; 0 for a flat one.
    pub normals: [[f32; 3]; 3],
    /// Texture coordinates.
    pub uvs: [[f32; 2]; 3],
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
    /// Where the image is in the whole one, if it is only a part.
    pub place: Option<PlaceInImage>,
    /// What the picture for viewing is multiplied by, as a film of more speed or a longer exposure is brighter: 1 by default. Images of radiance are not.
    pub exposure: f64,
}

/// A camera: a pinhole, a thin lens, or parallel rays.
///
/// With `[left, right, lower, upper] = edges(width, height)`, the image position (x, y) in \[0,1\]², from the top left, stands for
/// s = (left + x (right − left)) `right` + (upper + y (lower − upper)) `up`. A perspective camera's ray leaves from `origin` in the direction
/// `forward` + s, that of an orthographic one from `origin` + s in the direction `forward`. The three axes are orthonormal if the camera
/// transform is a similarity; `forward` always has length 1.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraSettings {
    /// The pinhole, the centre of the lens, or where the parallel ray along the axis begins.
    pub origin: [f64; 3],
    /// Towards the middle of the image.
    pub forward: [f64; 3],
    /// Towards the right edge of the image.
    pub right: [f64; 3],
    /// Towards the upper edge of the image.
    pub up: [f64; 3],
    /// Whether the rays are parallel; without a lens.
    pub is_orthographic: bool,
    /// What the image shows.
    pub screen: Screen,
    /// The lens, unless its radius is 0.
    pub lens: Option<Lens>,
}

/// What an image shows, along the axes `right` and `up`: of a perspective camera at distance 1, of an orthographic one in units of world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Screen {
    /// Half of its shorter side. The camera's axis is in the middle, and pixels are square.
    Half(f64),
    /// Its left, right, lower and upper edges, whatever the shape of the image.
    Edges([f64; 4]),
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
    /// The left, right, lower and upper edges of an image of this size (both sides at least 1), as in [`Screen`].
    pub fn edges(&self, width: u32, height: u32) -> [f64; 4] {
        match self.screen {
            Screen::Half(half) => {
                let aspect = f64::from(width) / f64::from(height);
                let [x, y] = if aspect >= 1.0 { [half * aspect, half] } else { [half, half / aspect] };
                [-x, x, -y, y]
            }
            Screen::Edges(edges) => edges,
        }
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

impl Shape {
    /// Whether it is a sphere that emits evenly.
    pub fn is_even_sphere(&self) -> bool {
        let is_even =
            |emission: &Emission| emission.picture.is_none() && emission.profile.is_none() && emission.spread.is_none();
        matches!(self.geometry, Geometry::Sphere(_)) && self.emission.as_ref().is_some_and(is_even)
    }
}
