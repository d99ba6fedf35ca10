//! The certificates of a tile of the image, made when a sample first needs them.
//!
//! They are made for what the whole tile sees of a primitive, and, where that does not decide, for what a square of 4 × 4 pixels sees of it.
//! (Certificates for single pixels save less time than they take.) A surface seen through a lens, in a mirror or by parallel rays is certified
//! as a whole. (Squares seen in mirrors would gain little: of the variance of `mirror-room`, the places in the pixels alone cause 97 %.)

use super::certifiable::Certifiable;
use super::certifier::{Certifier, patch};
use super::picture_irradiance::PictureIrradiance;
use crate::bvh::PrimitiveId;
use crate::camera::{Camera, Pinhole, PointIdentity, PreparedScene};
use crate::packet::{M8, V8, X8, first_lane};
use crate::scene::area::TILE;
use crate::settings::Settings;
use crate::surfaces::{Surface, Surfaces};
use etendue::{Mask, Real, Vec3};
use etendue_visible::{Patch, Precision, Proof, Solid, Viewer};
use std::collections::HashMap;
use std::ops::Range;

/// Sides of the squares of pixels that have certificates of their own. Each square lies within one of the side before.
const SIDES: [u32; 2] = [TILE, 4];
/// Greatest number of occluders for which the visible part of a light is computed.
const CLIPPED: usize = 8;
/// At most so many surfaces are remembered that are certified as a whole.
const MOST_WHOLE: usize = 1 << 16;
/// A certificate of a light is asked for where so many samples or more see the primitive, if it faces the camera. A certificate takes as
/// long as some tens of samples, and most are in vain: with 40, `etendue render terrain --technique analytic --spp 64 --size 256x256
/// --threads 1` takes 1.6 times as long as by `solid-angle`, and with 160 1.1 times.
const SAMPLES_PER_CERTIFICATE: f64 = 160.0;

/// A light with an area.
pub(super) struct AreaLight<'a> {
    pub(super) form: Solid,
    /// Radiance; its mean, if it varies.
    pub(super) radiance: [f32; 3],
    /// How its integral is known.
    pub(super) closed: Closed<'a>,
}

/// The closed form of a light's integral.
#[derive(Clone, Copy)]
pub(super) enum Closed<'a> {
    /// The radiance is constant.
    Constant,
    /// The light shows a picture. Behind occluders, the part of it that is visible is computed as if the radiance was constant, and samples
    /// correct that.
    Picture(&'a PictureIrradiance),
    /// The radiance varies by point or direction, the shape is only within the form, or another light hides part of it in the same primitive: no
    /// closed form has its integral. The light is sampled unless it is dark.
    No,
}

/// What is known of a light, as seen from a part of a surface. What it contributes is computed in a precision that suffices there.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Known {
    Lit(Precision),
    Dark,
    /// Only these of the [`solids`](Certificates::solids) can occlude it.
    Behind(Range<usize>, Precision),
    /// It is sampled, unless a smaller patch decides.
    Open,
    /// It is sampled: smaller patches are not worth asking for.
    Never,
}

impl Known {
    /// Whether the light must be sampled.
    pub(super) const fn is_open(&self) -> bool {
        matches!(self, Self::Open | Self::Never)
    }
}

/// The certificates of all lights for the part of a surface that a square of pixels sees.
#[derive(Debug)]
struct Entry {
    primitive: PrimitiveId,
    /// Index of the certificate of the first light; the others follow.
    first: usize,
}

/// The certificates of all lights for the surfaces that a tile sees.
pub(super) struct Certificates<'a> {
    surfaces: &'a Surfaces,
    pub(super) lights: Vec<AreaLight<'a>>,
    pub(super) certifier: Certifier<'a>,
    /// The camera, if it is a pinhole.
    pub(super) pinhole: Option<Pinhole>,
    /// The first pixel of the tile.
    origin: [u32; 2],
    /// The certificates in each square of each level, row by row, and those of whole surfaces seen from their front or back.
    squares: [Vec<Vec<Entry>>; SIDES.len()],
    whole: HashMap<(PrimitiveId, bool), usize>,
    /// What is known of each light at the places that have certificates. The first of them stands for places where none are worth asking for.
    pub(super) known: Vec<Known>,
    /// What may occlude lights.
    pub(super) solids: Vec<Solid>,
    /// Certificates are asked for on primitives with at least this area, and this more per squared distance from the camera.
    least: [f64; 2],
    /// The position of the camera.
    eye: Vec3<f64>,
    /// What was found for the primitive that was looked at last.
    worth: (PrimitiveId, bool),
}

/// Whether the visible part of a light is worth computing. More occluders take longer than the samples that they save: with 16, `defocus`
/// takes twice as long as with 8, for 0.99 times the error, and `cornell-box` and `mirror-room` gain nothing. Two spheres that overlap
/// have no closed form.
fn is_clipped(light: &Solid, occluders: &[Solid]) -> bool {
    occluders.len() <= CLIPPED && !(light.is_sphere() && occluders.iter().any(Solid::is_sphere))
}

impl<'a> Certificates<'a> {
    /// For a scene as a camera sees it. [`begin`](Self::begin) prepares for a tile.
    pub(super) fn new(
        scene: &'a PreparedScene,
        certifiable: &'a Certifiable,
        camera: &Camera,
        settings: &Settings,
    ) -> Self {
        let surfaces = &scene.surfaces;
        let count = surfaces.light_shapes().count();
        let pixels = SAMPLES_PER_CERTIFICATE * count as f64 / f64::from(settings.spp);
        let (eye, pixel) = camera.middle(settings.width, settings.height);
        let light = |(light, index): (usize, u32)| {
            let shape = &surfaces.shapes()[index as usize];
            let emission = shape.emission?;
            let outline = shape.geometry.outline();
            let is_hidden = certifiable.hidden.get(light).is_some_and(|&hidden| hidden);
            let closed = match certifiable.irradiances.get(light).and_then(Option::as_ref) {
                _ if is_hidden => Closed::No,
                Some(irradiance) => Closed::Picture(irradiance),
                None if emission.is_even() && outline.is_exact() => Closed::Constant,
                None => Closed::No,
            };
            Some(AreaLight { form: outline.solid(), radiance: emission.radiance, closed })
        };
        Self {
            surfaces,
            lights: surfaces.light_shapes().enumerate().filter_map(light).collect(),
            certifier: Certifier::new(surfaces, &certifiable.bodies, surfaces.light_shapes()),
            pinhole: if let Camera::Pinhole(pinhole) = camera { Some(*pinhole) } else { None },
            origin: [0; 2],
            squares: SIDES.map(|side| (0..(TILE / side).pow(2)).map(|_| Vec::new()).collect()),
            whole: HashMap::new(),
            known: Vec::new(),
            solids: Vec::new(),
            least: pixel.map(|area| pixels * area),
            eye,
            worth: (PrimitiveId::NONE, false),
        }
    }

    /// Prepares for the samples of a tile.
    pub(super) fn begin(&mut self, origin: [u32; 2]) {
        self.origin = origin;
        // surfaces that are certified as a whole stay so
        if self.pinhole.is_none() && (1..MOST_WHOLE).contains(&self.whole.len()) {
            return;
        }
        self.squares.iter_mut().flatten().for_each(Vec::clear);
        self.whole.clear();
        self.known.clear();
        self.known.extend(self.lights.iter().map(|_| Known::Never));
        self.solids.clear();
    }

    /// Whether certificates are worth asking for on a primitive: whether it is so near and so large that, seen from the front, the camera
    /// would take enough samples of it.
    pub(super) fn is_worth(&mut self, primitive: PrimitiveId) -> bool {
        if self.worth.0 != primitive {
            let wide = |p: [f32; 3]| Vec3::from(p.map(f64::from));
            let (area, center) = if let Some(shape) = primitive.shape() {
                let geometry = &self.surfaces.shapes()[shape].geometry;
                let [low, high] = geometry.bounds();
                (geometry.silhouette(), (wide(low) + wide(high)) * 0.5)
            } else {
                let c = self.surfaces.bvh.corners(primitive);
                let [a, b, c] = [0, 3, 6].map(|k| wide([c[k], c[k + 1], c[k + 2]]));
                (0.5 * (b - a).cross(c - a).length(), (a + b + c) * (1.0 / 3.0))
            };
            let [least, more] = self.least;
            self.worth = (primitive, area >= least + more * (center - self.eye).length_squared());
        }
        self.worth.1
    }

    /// Index of the square of a level that contains a pixel.
    pub(super) fn square(&self, pixel: [u32; 2], level: usize) -> u32 {
        let side = SIDES[level];
        let [column, row] = [0, 1].map(|k| (pixel[k] - self.origin[k]) / side);
        row * (TILE / side) + column
    }

    /// Index of the certificates for the surface of the first of these lanes, and the lanes that have them. Where nothing is worth asking
    /// for, it is 0.
    pub(super) fn find(&mut self, surface: &Surface, places: &PointIdentity, lanes: M8) -> (usize, M8) {
        let lane = first_lane(lanes);
        let primitive = places.primitives.lane(lane);
        let here = lanes & places.primitives.are(primitive);
        if !self.is_worth(primitive) {
            return (0, here);
        }
        if let Some(pinhole) = self.pinhole.filter(|_| places.direct.lane(lane)) {
            let (pixel, level) = places.pixel.map_or((self.origin, 0), |pixel| (pixel, SIDES.len() - 1));
            return (self.seen(&pinhole, primitive, pixel, level), here & places.direct);
        }
        let here = if self.pinhole.is_some() { here & !places.direct } else { here };
        let outwards = if let Some(shape) = primitive.shape() {
            self.surfaces.shapes()[shape].geometry.outwards(surface.point)
        } else {
            let c = self.surfaces.bvh.corners(primitive);
            let corner = |k: usize| Vec3::<f32>::new(c[k], c[k + 1], c[k + 2]);
            V8::splat((corner(3) - corner(0)).cross(corner(6) - corner(0)))
        };
        let in_front = surface.normal.dot(outwards).gt(X8::lit(0.0));
        let front = in_front.lane(lane);
        (self.all(primitive, front), here & if front { in_front } else { !in_front })
    }

    /// Index of the certificates for what the square of a level that contains the pixel sees of a primitive.
    pub(super) fn seen(&mut self, pinhole: &Pinhole, primitive: PrimitiveId, pixel: [u32; 2], level: usize) -> usize {
        let side = SIDES[level];
        let [column, row] = [0, 1].map(|k| (pixel[k] - self.origin[k]) / side);
        let square = self.square(pixel, level) as usize;
        if let Some(entry) = self.squares[level][square].iter().find(|entry| entry.primitive == primitive) {
            return entry.first;
        }
        let larger = (level > 0).then(|| self.seen(pinhole, primitive, pixel, level - 1));
        let count = self.lights.len();
        let decided = |known: &Known| matches!(known, Known::Lit(_) | Known::Dark | Known::Never);
        let open = match larger {
            Some(larger) => !self.known[larger..larger + count].iter().all(decided),
            None => true,
        };
        let first = if open {
            let [x, y] = [column, row].map(|k| k * side);
            let [x, y] = [self.origin[0] + x, self.origin[1] + y].map(f64::from);
            let pyramid = pinhole.pyramid([x, y, x + f64::from(side), y + f64::from(side)]);
            let patch = patch(self.surfaces, primitive, Viewer::Pixels(&pyramid));
            self.certify(primitive, patch.as_ref(), larger)
        } else {
            larger.unwrap_or(0)
        };
        self.squares[level][square].push(Entry { primitive, first });
        first
    }

    /// Index of the certificates for one side of a whole primitive.
    fn all(&mut self, primitive: PrimitiveId, front: bool) -> usize {
        if let Some(&first) = self.whole.get(&(primitive, front)) {
            return first;
        }
        let viewer = if front { Viewer::Front } else { Viewer::Back };
        let patch = patch(self.surfaces, primitive, viewer);
        let first = self.certify(primitive, patch.as_ref(), None);
        self.whole.insert((primitive, front), first);
        first
    }

    /// Appends the certificates of all lights for a patch, and returns the index of the first. What a larger patch has decided, by its
    /// certificates from `larger`, stays.
    fn certify(&mut self, primitive: PrimitiveId, patch: Option<&Patch>, larger: Option<usize>) -> usize {
        let Self { lights, certifier, known, solids, .. } = self;
        let first = known.len();
        for light in 0..lights.len() {
            let before = larger.map_or(Known::Open, |larger| known[larger + light].clone());
            let (proof, precision) = match patch {
                Some(patch) if !matches!(before, Known::Lit(_) | Known::Dark | Known::Never) => {
                    certifier.certify(primitive, patch, light)
                }
                _ => {
                    known.push(before);
                    continue;
                }
            };
            let is_open = matches!(lights[light].closed, Closed::No);
            known.push(match proof {
                Proof::Dark => Known::Dark,
                Proof::Open => before,
                // a smaller patch is not darker
                Proof::Lit if is_open => Known::Never,
                _ if is_open || precision == Precision::Neither => Known::Open,
                Proof::Lit => Known::Lit(precision),
                Proof::Behind(found) if !is_clipped(&lights[light].form, found) => Known::Open,
                Proof::Behind(found) => {
                    let first = solids.len();
                    solids.extend_from_slice(found);
                    Known::Behind(first..solids.len(), precision)
                }
            });
        }
        first
    }
}
