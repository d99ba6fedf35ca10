//! The camera of an image: a pinhole, a thin lens, or a lens in a barrel.

use crate::accel::{M8, V8, X8};
use crate::camera::Pinhole;
use crate::sampler::{FILM, LENS, Packet, Source};
use crate::scene;
use crate::vignetting::{Barrel, Pupil};
use etendue::warp::ConcentricDisk;
use etendue::{Real, Vec2, Warp};

/// A thin-lens camera for an image of a given size.
///
/// A ray leaves from a point ℓ of the lens, uniform over its disk, towards the point where the ray d from the lens's centre (whose
/// component along the axis is 1) meets the plane of focus at distance f. Its direction is that of d − ℓ/f.
#[derive(Clone, Copy, Debug)]
pub struct ThinLens {
    center: Pinhole,
    /// Radii to the right and upwards, in world space.
    radii: [[f32; 3]; 2],
    /// The same radii over the distance of the plane of focus.
    bends: [[f32; 3]; 2],
}

impl ThinLens {
    /// The lens camera for an image of `width` × `height` pixels.
    pub fn new(camera: &scene::CameraSettings, lens: &scene::Lens, width: u32, height: u32) -> Self {
        let along = |length: f64| [camera.right, camera.up].map(|axis| axis.map(|x| (x * length) as f32));
        Self {
            center: Pinhole::new(camera, width, height),
            radii: along(lens.radius * lens.unit),
            bends: along(lens.radius / lens.focus),
        }
    }
    /// Origin and unit direction of the rays through positions in pixels from the top left and the lens points of `u` in \[0, 1)².
    #[inline]
    pub fn ray(&self, x: X8, y: X8, u: Vec2<X8>) -> (V8, V8) {
        self.leave(x, y, ConcentricDisk.sample(u))
    }
    /// Like [`ThinLens::ray`], from points of the lens in units of its radius.
    #[inline]
    pub fn leave(&self, x: X8, y: X8, lens: Vec2<X8>) -> (V8, V8) {
        let at = |[right, up]: [[f32; 3]; 2]| V8::from(up).mul_add(lens.y, V8::from(right) * lens.x);
        let (origin, direction) = self.center.through(x, y);
        (origin + at(self.radii), (direction - at(self.bends)).normalize())
    }
}

/// Slopes of the rays through the lens's centre: their steps to the right and upwards per unit along the axis.
#[derive(Clone, Copy, Debug)]
pub struct Slopes {
    /// Slope at the top left corner, and its change for a pixel to the right and for one down.
    corner: [f64; 2],
    step: [f64; 2],
}

impl Slopes {
    /// The slopes for an image of `width` × `height` pixels.
    pub fn new(camera: &scene::CameraSettings, width: u32, height: u32) -> Self {
        let [across, down] = camera.tan_half(width, height);
        let step = [2.0 * across / f64::from(width), -2.0 * down / f64::from(height)];
        Self { corner: [-across, down], step }
    }
    /// Slopes at positions in pixels from the top left.
    #[inline]
    pub fn at(&self, x: X8, y: X8) -> Vec2<X8> {
        let slope = |k: usize, place: X8| X8::lit(self.step[k]).mul_add(place, X8::lit(self.corner[k]));
        Vec2::new(slope(0, x), slope(1, y))
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
    pub fn new(camera: &scene::CameraSettings, width: u32, height: u32) -> Self {
        match &camera.lens {
            None => Self::Pinhole(Pinhole::new(camera, width, height)),
            Some(lens) => Self::ThinLens(ThinLens::new(camera, lens, width, height)),
        }
    }
    /// Origins and unit directions of eight samples, and their random pairs for the light.
    #[inline(always)]
    pub fn rays(&self, source: &Source, packet: &Packet) -> (V8, V8, Vec2<X8>) {
        let [film, light] = source.film_and_light(packet);
        let (origin, direction) = self.through(source, packet, film);
        (origin, direction, light)
    }
    /// Origins and unit directions of eight samples at given positions in their pixels.
    #[inline(always)]
    pub fn through(&self, source: &Source, packet: &Packet, film: Vec2<X8>) -> (V8, V8) {
        let [x, y] = [X8::from_uint(packet.x) + film.x, X8::from_uint(packet.y) + film.y];
        match self {
            Self::Pinhole(pinhole) => pinhole.ray(x, y),
            Self::ThinLens(lens) | Self::Barrel(lens, _) => lens.ray(x, y, source.pair(packet, LENS)),
            Self::Pupil(pupil) => pupil.ray(x, y),
        }
    }
    /// The lanes whose rays pass the lens; `None` if all do. Blocked rays count as black samples.
    #[inline]
    pub fn open(&self, source: &Source, packet: &Packet) -> Option<M8> {
        let place = || {
            let film = source.pair(packet, FILM);
            [X8::from_uint(packet.x) + film.x, X8::from_uint(packet.y) + film.y]
        };
        match self {
            Self::Pinhole(_) | Self::ThinLens(_) => None,
            Self::Barrel(_, barrel) => {
                let [x, y] = place();
                Some(barrel.open(x, y, ConcentricDisk.sample(source.pair(packet, LENS))))
            }
            Self::Pupil(pupil) => {
                let [x, y] = place();
                Some(pupil.open(x, y))
            }
        }
    }
    /// Whether samples have a point on the lens.
    pub const fn has_lens(&self) -> bool {
        matches!(self, Self::ThinLens(_) | Self::Barrel(..))
    }
}
