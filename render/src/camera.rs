//! The camera of an image: a pinhole, a thin lens, or parallel rays.

mod group;
mod linear;
mod orbit;
mod orthographic;
mod paths;
mod pinhole;
mod points;
mod prepared;
mod thin_lens;

pub(crate) use group::{Group, Numbers};
pub use orbit::Orbit;
pub use orthographic::Orthographic;
pub(crate) use paths::Paths;
pub use pinhole::Pinhole;
#[cfg(feature = "analytic")]
pub(crate) use points::PointIdentity;
pub(crate) use points::Points;
pub(crate) use prepared::PreparedScene;
pub use thin_lens::{Slopes, ThinLens};

use crate::packet::{V8, X8};
use crate::scene::CameraSettings;
use etendue::warp::ConcentricDisk;
use etendue::{Real, Vec2, Vec3, Warp, u32x8};

/// Positions are counted from the first pixel of a square of so many pixels. Single precision then rounds them by at most 2⁻¹³ of a pixel,
/// however wide the image is.
const COUNTED: u32 = 4096;

/// The first pixel of the square in which the positions of a tile are counted.
pub fn counted_from(tile: [u32; 2]) -> [u32; 2] {
    tile.map(|at| at / COUNTED * COUNTED)
}

/// Where eight rays pass the film and the lens. It is drawn once for each sample, and the camera and the sensor both read it.
#[derive(Clone, Copy, Debug)]
pub struct CameraSample {
    /// Positions in pixels, from the top left of the image or of the [pixel](Camera::counted_from) from which they are counted.
    pub film: Vec2<X8>,
    /// Points of the lens, in units of its radius; the centre for a pinhole.
    pub lens: Vec2<X8>,
}

impl CameraSample {
    /// Samples at columns `x` and rows `y` with random pairs for the position in the pixel and, if the camera has a lens, on the lens.
    #[inline(always)]
    pub fn new(x: u32x8, y: u32x8, film: Vec2<X8>, lens: Option<Vec2<X8>>) -> Self {
        Self {
            film: Vec2::new(X8::from_uint(x) + film.x, X8::from_uint(y) + film.y),
            lens: lens.map_or(Vec2::default(), |u| ConcentricDisk.sample(u)),
        }
    }
}

/// The model that generates camera rays.
#[derive(Clone, Copy, Debug)]
pub enum Camera {
    /// All rays leave from one point.
    Pinhole(Pinhole),
    /// All rays are parallel.
    Orthographic(Orthographic),
    /// Rays leave from all points of a lens.
    ThinLens(ThinLens),
}

impl Camera {
    /// A scene's camera, for an image of `width` × `height` pixels.
    pub fn new(camera: &CameraSettings, width: u32, height: u32) -> Self {
        match &camera.lens {
            None if camera.is_orthographic => Self::Orthographic(Orthographic::new(camera, width, height)),
            None => Self::Pinhole(Pinhole::new(camera, width, height)),
            Some(lens) => Self::ThinLens(ThinLens::new(camera, lens, width, height)),
        }
    }
    /// The same camera, for positions that are counted from this pixel.
    #[must_use]
    pub fn counted_from(&self, pixel: [u32; 2]) -> Self {
        match self {
            Self::Pinhole(pinhole) => Self::Pinhole(pinhole.counted_from(pixel)),
            Self::Orthographic(parallel) => Self::Orthographic(parallel.counted_from(pixel)),
            Self::ThinLens(thin) => Self::ThinLens(thin.counted_from(pixel)),
        }
    }
    /// Origins and unit directions of eight rays.
    #[inline(always)]
    pub fn rays(&self, CameraSample { film, lens }: &CameraSample) -> (V8, V8) {
        match self {
            Self::Pinhole(pinhole) => pinhole.ray(film.x, film.y),
            Self::Orthographic(parallel) => parallel.ray(film.x, film.y),
            Self::ThinLens(thin) => thin.ray(film.x, film.y, *lens),
        }
    }
    /// Where the ray through the middle of the image begins, and the area of a pixel there: at the camera, and what it becomes more per squared
    /// distance.
    pub fn middle(&self, width: u32, height: u32) -> (Vec3<f64>, [f64; 2]) {
        let middle = |side: u32, more: [f32; 3]| X8::from(std::array::from_fn(|k| side as f32 / 2.0 + more[k.min(2)]));
        let film = Vec2::new(middle(width, [0.0, 1.0, 0.0]), middle(height, [0.0, 0.0, 1.0]));
        let (origin, direction) = self.rays(&CameraSample { film, lens: Vec2::default() });
        let area = |v: V8| {
            let [middle, across, down] = [0, 1, 2].map(|lane| v.lane(lane).map(f64::from));
            (across - middle).cross(down - middle).length()
        };
        (origin.lane(0).map(f64::from), [area(origin), area(direction)])
    }
    /// Where the film shows a point that is in focus, in pixels from the top left, and where the ray to it begins; `None` if it is behind the
    /// camera.
    pub fn view_of(&self, p: Vec3<f64>) -> Option<([f64; 2], Vec3<f64>)> {
        match self {
            Self::Pinhole(pinhole) => pinhole.view_of(p),
            Self::Orthographic(parallel) => parallel.view_of(p),
            Self::ThinLens(thin) => thin.view_of(p),
        }
    }
    /// Whether samples have a point on the lens.
    pub const fn has_lens(&self) -> bool {
        matches!(self, Self::ThinLens(_))
    }
}
