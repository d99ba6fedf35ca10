//! Lights in view that are smaller than a pixel, which few samples meet.

use crate::bvh::{PrimitiveId, PrimitiveIds, Scratch};
use crate::camera::{Camera, PreparedScene};
use crate::film::claim::Specks;
use crate::geometry::across;
use crate::packet::{M8, V8, X8};
use etendue::{Mask, Real, Vec3};
use rayon::prelude::*;
use std::f64::consts::PI;

/// At most so many lights are looked at, evenly among all.
const MOST: usize = 1 << 12;

/// Places on a light in units of its two half edges or radii, in no order.
const PLACES: [[f64; 2]; 8] =
    [[0.0, 0.0], [0.6, 0.1], [-0.5, 0.3], [0.2, -0.6], [-0.1, 0.7], [0.5, 0.5], [-0.4, -0.4], [-0.7, -0.1]];

/// What emits towards the camera, as a flat shape.
struct Speck {
    middle: Vec3<f64>,
    /// Half edges, or radii.
    halves: [Vec3<f64>; 2],
    /// Its area in units of the product of the half edges.
    area: f64,
    /// Σ of the squared radiances of the channels.
    squared: f64,
    /// Its shape, if it has one.
    primitive: PrimitiveId,
}

/// The specks that the camera sees directly in an image of this size, of a scene whose radiance the sensor multiplies by `exposure`. What
/// mirrors show is not looked for.
pub(super) fn specks(scene: &PreparedScene, camera: &Camera, size: [u32; 2], exposure: f64) -> Specks {
    let look = |speck: Option<Speck>| look(scene, camera, size, &speck?, exposure);
    let emission = |index: u32| scene.surfaces.shapes()[index as usize].emission;
    let is_seen = |index: &u32| !emission(*index).is_some_and(|emission| emission.is_unseen);
    let shapes: Vec<u32> = scene.surfaces.light_shapes().filter(is_seen).collect();
    let apart = shapes.len().div_ceil(MOST).max(1);
    let looked_at: Vec<u32> = shapes.iter().copied().step_by(apart).collect();
    // in order, whatever the threads
    let found: Vec<Option<Specks>> = looked_at.par_iter().map(|index| look(of_shape(scene, camera, *index))).collect();
    let weight = shapes.len() as f64 / looked_at.len().max(1) as f64;
    let of_sun = look(of_sun(scene, camera, size)).unwrap_or_default();
    found.into_iter().flatten().fold(of_sun, |all, speck| all.and(&speck, weight))
}

fn squared(radiance: [f32; 3]) -> f64 {
    radiance.iter().map(|&x| f64::from(x).powi(2)).sum()
}

/// The sun, as a disk at the distance 1.
fn of_sun(scene: &PreparedScene, camera: &Camera, size: [u32; 2]) -> Option<Speck> {
    let (direction, radius, radiance) = scene.sky.as_ref()?.sun()?;
    let direction = Vec3::<f64>::from(direction.map(f64::from));
    let middle = camera.middle(size[0], size[1]).0 + direction;
    let halves = across(direction, radius);
    Some(Speck { middle, halves, area: PI, squared: squared(radiance), primitive: PrimitiveId::NONE })
}

/// The light of a shape; `None` if it does not emit towards the camera.
fn of_shape(scene: &PreparedScene, camera: &Camera, index: u32) -> Option<Speck> {
    let shape = &scene.surfaces.shapes()[index as usize];
    let emission = shape.emission?;
    let middle = shape.geometry.middle();
    let to = middle - camera.view_of(middle)?.1;
    let (halves, area) = shape.geometry.halves(to);
    // a curved light emits to all sides
    let faces = to.dot(Vec3::from(shape.geometry.normal().map(f64::from))) < 0.0;
    let emits = emission.two_sided || shape.geometry.plane().is_none() || faces;
    let squared = squared(emission.radiance);
    (emits && squared > 0.0).then_some(Speck { middle, halves, area, squared, primitive: PrimitiveId::of_shape(index) })
}

/// How a speck is in the image; `None` if it is not in view, or not smaller than a pixel.
fn look(scene: &PreparedScene, camera: &Camera, size: [u32; 2], speck: &Speck, exposure: f64) -> Option<Specks> {
    let Speck { middle, halves: [u, v], .. } = *speck;
    let (at, origin) = camera.view_of(middle)?;
    if !(0..2).all(|k| (0.0..f64::from(size[k])).contains(&at[k])) {
        return None;
    }
    let edge = |half: Vec3<f64>| camera.view_of(middle + half).map(|(to, _)| [to[0] - at[0], to[1] - at[1]]);
    let (s, t) = (edge(u)?, edge(v)?);
    let area = speck.area * (s[0] * t[1] - s[1] * t[0]).abs();
    if !(area > 0.0 && area < 1.0) {
        return None;
    }
    // the part that nothing hides
    let to = PLACES.map(|[a, b]| middle + u * (0.7 * a) + v * (0.7 * b) - origin);
    let lanes = |of: fn(&Vec3<f64>) -> f64| X8::from_fn(|lane| of(&to[lane]) as f32);
    let to = V8::new(lanes(|v| v.x), lanes(|v| v.y), lanes(|v| v.z));
    let limit = if speck.primitive == PrimitiveId::NONE { X8::lit(f64::INFINITY) } else { to.length() };
    let rays = scene.surfaces.bvh.rays(V8::lit([origin.x, origin.y, origin.z]), to.normalize());
    let (mut visible, target) = ([M8::splat(true)], [PrimitiveIds::splat(speck.primitive)]);
    scene.surfaces.bvh.occluded(&[rays], &mut visible, &[limit], &target, &mut Scratch::default());
    let part = f64::from(visible[0].bits().count_ones()) / 8.0;
    (part > 0.0).then(|| Specks::new(area * part, speck.squared * exposure * exposure))
}
