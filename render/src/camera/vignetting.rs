//! Vignetting: a lens in a barrel, and how it looks from a point of the film.

use super::thin_lens::{Slopes, ThinLens};
use crate::packet::{M8, V8, X8};
use crate::scene;
use etendue::{Real, Vec2};

/// A tube in front of the lens, whose front rim blocks some of the rays through the lens.
///
/// The model has two circular stops on the axis: the thin lens, of radius r, and the front rim, of radius R at distance b in front of
/// it. The ray from rℓ, with ℓ in the unit disk, towards the plane of focus at f meets the plane of the front rim at
/// r(1 − b/f)ℓ + bt, where t is the slope of the ray through the centre. From a point of the film, the front rim therefore appears as
/// a circle of radius R/|r(1 − b/f)| about −bt/(r(1 − b/f)), in units of the lens's radius. The open part of the lens is the
/// intersection of two disks, shaped like a cat's eye near the corners of the image.
#[derive(Clone, Copy, Debug)]
pub struct Barrel {
    /// r(1 − b/f)/R.
    lens: f64,
    /// b/R.
    slope: f64,
    slopes: Slopes,
}

impl Barrel {
    /// A barrel of length b ≥ 0 and front radius R > 0, in camera space, for an image of `width` × `height` pixels.
    pub fn new(
        camera: &scene::CameraSettings,
        lens: &scene::Lens,
        [length, radius]: [f64; 2],
        width: u32,
        height: u32,
    ) -> Self {
        Self {
            lens: lens.radius * (1.0 - length / lens.focus) / radius,
            slope: length / radius,
            slopes: Slopes::new(camera, width, height),
        }
    }
    /// The same barrel, for positions that are counted from this pixel.
    #[must_use]
    pub fn counted_from(&self, pixel: [u32; 2]) -> Self {
        Self { slopes: self.slopes.counted_from(pixel), ..*self }
    }
    /// Lanes that the front rim does not block, for positions in pixels and lens points in units of the lens's radius.
    #[inline]
    pub fn open(&self, x: X8, y: X8, lens: Vec2<X8>) -> M8 {
        let rim = lens * X8::lit(self.lens) + self.slopes.at(x, y) * X8::lit(self.slope);
        rim.length_squared().le(X8::lit(1.0))
    }
    /// Fraction of the lens's area that is open as seen from a position in pixels.
    pub fn open_part(&self, x: f64, y: f64) -> f64 {
        let slope = self.slopes.at(X8::lit(x), X8::lit(y)).lane(0);
        let off = self.slope * libm::hypot(f64::from(slope.x), f64::from(slope.y));
        let lens = self.lens.abs();
        // both disks in units of the front rim
        common_area(lens, 1.0, off) / (std::f64::consts::PI * lens * lens)
    }
}

/// Area of the intersection of two disks of radii `a` and `b` whose centres are `d` apart: two circular segments.
fn common_area(a: f64, b: f64, d: f64) -> f64 {
    if d >= a + b {
        return 0.0;
    }
    if d <= (a - b).abs() {
        return std::f64::consts::PI * a.min(b).powi(2);
    }
    // distances of the common chord from the centres, in radii
    let [u, v] = [(d * d + a * a - b * b) / (2.0 * d * a), (d * d + b * b - a * a) / (2.0 * d * b)];
    let segment = |r: f64, c: f64| r * r * (libm::acos(c.clamp(-1.0, 1.0)) - c * (1.0 - c * c).max(0.0).sqrt());
    segment(a, u) + segment(b, v)
}

/// The lens as seen from one point of the film. Each point of the picture is a point of the lens and shows the radiance that
/// arrives from there. Right and up are as in the image; everything outside the lens is black.
#[derive(Clone, Copy, Debug)]
pub struct Pupil {
    lens: ThinLens,
    barrel: Option<Barrel>,
    /// Position on the film, in pixels of the image.
    film: [f64; 2],
    /// Lens coordinates at the top left corner of the picture, and their change per pixel, in units of the lens's radius.
    corner: [f64; 2],
    step: f64,
}

impl Pupil {
    /// The view from `film`, a position in pixels of the camera's image. The picture has `side`² pixels and shows a square of half
    /// side `extent`, in units of the lens's radius.
    pub fn new(lens: ThinLens, barrel: Option<Barrel>, film: [f64; 2], side: u32, extent: f64) -> Self {
        Self { lens, barrel, film, corner: [-extent, extent], step: 2.0 * extent / f64::from(side) }
    }
    /// The same view, for positions in the picture that are counted from this pixel.
    #[must_use]
    pub fn counted_from(&self, [x, y]: [u32; 2]) -> Self {
        let [left, upper] = self.corner;
        Self { corner: [left + self.step * f64::from(x), upper - self.step * f64::from(y)], ..*self }
    }
    #[inline]
    fn point(&self, x: X8, y: X8) -> Vec2<X8> {
        let ([left, upper], step) = (self.corner.map(X8::lit), X8::lit(self.step));
        Vec2::new(step.mul_add(x, left), upper - step * y)
    }
    /// Origins and unit directions for positions in the picture.
    #[inline]
    pub fn ray(&self, x: X8, y: X8) -> (V8, V8) {
        let [film_x, film_y] = self.film.map(X8::lit);
        self.lens.ray(film_x, film_y, self.point(x, y))
    }
    /// Lanes whose positions are on the lens and not blocked.
    #[inline]
    pub fn open(&self, x: X8, y: X8) -> M8 {
        let point = self.point(x, y);
        let lens = point.length_squared().le(X8::lit(1.0));
        let [film_x, film_y] = self.film.map(X8::lit);
        self.barrel.map_or(lens, |barrel| lens & barrel.open(film_x, film_y, point))
    }
}
