//! The camera of an image: a pinhole, a thin lens, or a lens in a barrel.

mod pinhole;
mod thin_lens;
mod vignetting;

pub use pinhole::Pinhole;
pub use thin_lens::{Slopes, ThinLens};
pub use vignetting::{Barrel, Pupil};

use crate::packet::{M8, V8, X8};
use crate::scene::CameraSettings;
use etendue::warp::ConcentricDisk;
use etendue::{Real, Vec2, Vec3, Warp, u32x8};

/// Where eight rays pass the film and the lens. It is drawn once for each sample, and the camera and the sensor both read it.
#[derive(Clone, Copy, Debug)]
pub struct CameraSample {
    /// Positions in pixels, from the top left of the image.
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
    /// Rays leave from all points of a lens.
    ThinLens(ThinLens),
    /// Rays leave from the points of a lens that a barrel does not block.
    Barrel(ThinLens, Barrel),
    /// Each pixel is a point of the lens, as seen from one point of the film.
    Pupil(Pupil),
}

impl Camera {
    /// A scene's camera, for an image of `width` × `height` pixels.
    pub fn new(camera: &CameraSettings, width: u32, height: u32) -> Self {
        match &camera.lens {
            None => Self::Pinhole(Pinhole::new(camera, width, height)),
            Some(lens) => Self::ThinLens(ThinLens::new(camera, lens, width, height)),
        }
    }
    /// Origins and unit directions of eight rays.
    #[inline(always)]
    pub fn rays(&self, CameraSample { film, lens }: &CameraSample) -> (V8, V8) {
        match self {
            Self::Pinhole(pinhole) => pinhole.ray(film.x, film.y),
            Self::ThinLens(thin) | Self::Barrel(thin, _) => thin.ray(film.x, film.y, *lens),
            Self::Pupil(pupil) => pupil.ray(film.x, film.y),
        }
    }
    /// The lanes whose rays pass the lens; `None` if all do. Blocked rays count as black samples.
    #[inline]
    pub fn open(&self, CameraSample { film, lens }: &CameraSample) -> Option<M8> {
        match self {
            Self::Pinhole(_) | Self::ThinLens(_) => None,
            Self::Barrel(_, barrel) => Some(barrel.open(film.x, film.y, *lens)),
            Self::Pupil(pupil) => Some(pupil.open(film.x, film.y)),
        }
    }
    /// Where the ray through the middle of the image begins, and the solid angle of the pixel there.
    pub fn middle(&self, width: u32, height: u32) -> (Vec3<f64>, f64) {
        let middle = |side: u32, more: [f32; 3]| X8::from(std::array::from_fn(|k| side as f32 / 2.0 + more[k.min(2)]));
        let film = Vec2::new(middle(width, [0.0, 1.0, 0.0]), middle(height, [0.0, 0.0, 1.0]));
        let (origin, direction) = self.rays(&CameraSample { film, lens: Vec2::default() });
        let [middle, across, down] = [0, 1, 2].map(|lane| direction.lane(lane).map(f64::from));
        (origin.lane(0).map(f64::from), (across - middle).cross(down - middle).length())
    }
    /// The position in pixels from the top left at which the film shows what is at `v` from where the ray through the middle begins, if it
    /// is in focus; `None` if it is behind the camera, or if the image is not of the scene.
    pub fn film_of(&self, v: Vec3<f64>) -> Option<[f64; 2]> {
        match self {
            Self::Pinhole(pinhole) => pinhole.film_of(v),
            Self::ThinLens(thin) | Self::Barrel(thin, _) => thin.film_of(v),
            Self::Pupil(_) => None,
        }
    }
    /// Whether samples have a point on the lens.
    pub const fn has_lens(&self) -> bool {
        matches!(self, Self::ThinLens(_) | Self::Barrel(..))
    }
}
