//! What a file offers a choice of, and what is asked of it.

use std::path::PathBuf;

/// What is asked of a scene file.
#[derive(Clone, Debug, Default)]
pub struct Asked {
    /// An image as the light from infinitely far away, instead of what the scene has.
    ///
    /// A square image maps to directions by pbrt-v4's equal-area map, any other by longitude and latitude. In a glTF file +y is up, and the
    /// middle of the image is at +x, as Khronos's sample viewer has it; elsewhere the image is where `LightSource "infinite"` without a
    /// transform puts it, with +z up.
    pub sky: Option<PathBuf>,
    /// The camera of this name or number, from 0 on, of a glTF file with several; the first one if it is not given.
    pub camera: Option<String>,
    /// The scene of this name or number, from 0 on, of a glTF file with several; its default if it is not given.
    pub scene: Option<String>,
}

/// What a scene file offers a choice of.
#[derive(Clone, Debug, Default)]
pub struct Contents {
    /// The names of its scenes, empty where they have none. Files of pbrt have no scenes.
    pub scenes: Vec<String>,
    /// The names of the cameras of the scene that was asked for, empty where they have none.
    pub cameras: Vec<String>,
}
