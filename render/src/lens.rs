//! The eye of an image: a pinhole, or a thin lens with its film.

use crate::accel::{V8, X8};
use crate::camera::Pinhole;
use crate::sampler::{LENS, Packet, Source};
use crate::scene;
use etendue::warp::ConcentricDisk;
use etendue::{Real, Vec2, Warp};

/// A thin lens, ready for an image of a given size.
///
/// A ray leaves from a point ℓ of the lens, uniform over its disk, towards the point in which the pinhole's ray d from the centre
/// (of length 1 along the axis) meets the plane of focus at distance f: its direction is that of d − ℓ/f.
#[derive(Clone, Copy, Debug)]
pub struct ThinLens {
    center: Pinhole,
    /// Radii to the right and upwards.
    radii: [[f32; 3]; 2],
    /// The same over the distance of the plane of focus.
    bends: [[f32; 3]; 2],
}

impl ThinLens {
    fn new(camera: &scene::Camera, lens: &scene::Lens, width: u32, height: u32) -> Self {
        let along = |length: f64| [camera.right, camera.up].map(|axis| axis.map(|x| (x * length) as f32));
        Self {
            center: Pinhole::new(camera, width, height),
            radii: along(lens.radius * lens.unit),
            bends: along(lens.radius / lens.focus),
        }
    }
    /// Origin and unit direction through a position in pixels from the top left, and the point of the lens for `u` in \[0, 1)².
    #[inline]
    pub fn ray(&self, x: X8, y: X8, u: Vec2<X8>) -> (V8, V8) {
        let lens = ConcentricDisk.sample(u);
        let at = |[right, up]: [[f32; 3]; 2]| V8::from(up).mul_add(lens.y, V8::from(right) * lens.x);
        let (origin, direction) = self.center.through(x, y);
        (origin + at(self.radii), (direction - at(self.bends)).normalize())
    }
}

/// What rays leave the camera.
#[derive(Clone, Copy, Debug)]
pub enum Eye {
    /// All from one point.
    Pinhole(Pinhole),
    /// From the points of a lens.
    ThinLens(ThinLens),
}

impl Eye {
    /// Of a scene's camera, for an image of `width` × `height` pixels.
    pub fn new(camera: &scene::Camera, width: u32, height: u32) -> Self {
        match &camera.lens {
            None => Self::Pinhole(Pinhole::new(camera, width, height)),
            Some(lens) => Self::ThinLens(ThinLens::new(camera, lens, width, height)),
        }
    }
    /// Origins and unit directions of eight samples, and their pairs for the light.
    #[inline(always)]
    pub fn rays(&self, source: &Source, packet: &Packet) -> (V8, V8, Vec2<X8>) {
        let [film, light] = source.film_and_light(packet);
        let (origin, direction) = self.through(source, packet, film);
        (origin, direction, light)
    }
    /// Origins and unit directions of eight samples, at positions in their pixels that are given.
    #[inline(always)]
    pub fn through(&self, source: &Source, packet: &Packet, film: Vec2<X8>) -> (V8, V8) {
        let [x, y] = [X8::from_uint(packet.x) + film.x, X8::from_uint(packet.y) + film.y];
        match self {
            Self::Pinhole(pinhole) => pinhole.ray(x, y),
            Self::ThinLens(lens) => lens.ray(x, y, source.pair(packet, LENS)),
        }
    }
}
