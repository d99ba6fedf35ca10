//! Lights in view that are smaller than a pixel, which few samples meet.

use super::prepared::PreparedScene;
use crate::bvh::{NOTHING, Scratch};
use crate::camera::Camera;
use crate::claim::Specks;
use crate::geometry::Geometry;
use crate::packet::{M8, V8, X8};
use etendue::occlusion::SPARED;
use etendue::{Mask, Real, Vec3, u32x8};
use rayon::prelude::*;
use std::f64::consts::PI;

/// At most so many lights are looked at, evenly among all.
const MOST: usize = 1 << 12;

/// Places on a light in units of its two half edges or radii, in no order.
const PLACES: [[f64; 2]; 8] =
    [[0.0, 0.0], [0.6, 0.1], [-0.5, 0.3], [0.2, -0.6], [-0.1, 0.7], [0.5, 0.5], [-0.4, -0.4], [-0.7, -0.1]];

/// What emits towards the camera, as a flat shape.
struct Speck {
    /// Its middle, as seen from the camera.
    middle: Vec3<f64>,
    /// Half edges, or radii.
    halves: [Vec3<f64>; 2],
    /// Its area in units of the product of the half edges.
    area: f64,
    /// Σ of the squared radiances of the channels.
    squared: f64,
    /// Index of its shape, or [`NOTHING`].
    shape: u32,
}

/// The specks that the camera sees directly in an image of this size, of a scene whose radiance the sensor multiplies by `exposure`. What
/// mirrors show is not looked for.
pub(super) fn specks(scene: &PreparedScene, camera: &Camera, size: [u32; 2], exposure: f64) -> Specks {
    let eye = camera.middle(size[0], size[1]).0;
    let shapes: Vec<u32> = scene.surfaces.light_shapes().collect();
    let apart = shapes.len().div_ceil(MOST).max(1);
    let looked_at: Vec<u32> = shapes.iter().copied().step_by(apart).collect();
    let of_shape = |index: &u32| {
        let speck = speck(scene, *index, eye)?;
        look(scene, camera, size, eye, &speck, exposure)
    };
    // in order, whatever the threads
    let found: Vec<Option<Specks>> = looked_at.par_iter().map(of_shape).collect();
    let weight = shapes.len() as f64 / looked_at.len().max(1) as f64;
    let of_sun = scene.sky.as_ref().and_then(|sky| sky.sun()).and_then(|(direction, radius, radiance)| {
        let middle = Vec3::<f64>::from(direction.map(f64::from));
        let halves = across(middle).map(|v| v * radius);
        let speck = Speck { middle, halves, area: PI, squared: squared(radiance), shape: NOTHING };
        look(scene, camera, size, eye, &speck, exposure)
    });
    found.into_iter().flatten().fold(of_sun.unwrap_or_default(), |all, speck| all.and(&speck, weight))
}

fn squared(radiance: [f32; 3]) -> f64 {
    radiance.iter().map(|&x| f64::from(x).powi(2)).sum()
}

/// Two unit vectors across a vector.
fn across(v: Vec3<f64>) -> [Vec3<f64>; 2] {
    let frame = etendue::Frame::new(v.normalize());
    [frame.s, frame.t]
}

/// The light of a shape, as seen from here; `None` if it does not emit this way.
fn speck(scene: &PreparedScene, index: u32, eye: Vec3<f64>) -> Option<Speck> {
    let shape = &scene.surfaces.shapes()[index as usize];
    let emission = shape.emission?;
    let wide = |v: [f32; 3]| Vec3::<f64>::from(v.map(f64::from));
    let (middle, halves, area) = match shape.geometry {
        Geometry::Sphere { center, radius } => {
            let middle = wide(center) - eye;
            (middle, across(middle).map(|v| v * f64::from(radius)), PI)
        }
        Geometry::Triangle([a, b, c]) => {
            let (a, b, c) = (wide(a), wide(b), wide(c));
            ((a + b + c) * (1.0 / 3.0) - eye, [(b - a) * 0.5, (c - a) * 0.5], 2.0)
        }
        Geometry::Parallelogram { p, u, v } => {
            let (u, v) = (wide(u) * 0.5, wide(v) * 0.5);
            (wide(p) + u + v - eye, [u, v], 4.0)
        }
    };
    let emits = match shape.geometry {
        Geometry::Sphere { .. } => true,
        ref flat => emission.two_sided || middle.dot(wide(flat.normal())) < 0.0,
    };
    let squared = squared(emission.radiance);
    (emits && squared > 0.0).then_some(Speck { middle, halves, area, squared, shape: index })
}

/// How a speck is in the image; `None` if it is not in view, or not smaller than a pixel.
fn look(
    scene: &PreparedScene,
    camera: &Camera,
    size: [u32; 2],
    eye: Vec3<f64>,
    speck: &Speck,
    exposure: f64,
) -> Option<Specks> {
    let Speck { middle, halves, .. } = *speck;
    let at = camera.film_of(middle)?;
    if !(0..2).all(|k| (0.0..f64::from(size[k])).contains(&at[k])) {
        return None;
    }
    let [s, t] = halves.map(|half| camera.film_of(middle + half).map(|to| [to[0] - at[0], to[1] - at[1]]));
    let (s, t) = (s?, t?);
    let area = speck.area * (s[0] * t[1] - s[1] * t[0]).abs();
    if !(area > 0.0 && area < 1.0) {
        return None;
    }
    // the part that nothing hides
    let to = |lane: usize| middle + halves[0] * (0.7 * PLACES[lane][0]) + halves[1] * (0.7 * PLACES[lane][1]);
    let lanes = |k: usize| X8::from_fn(|lane| [to(lane).x, to(lane).y, to(lane).z][k] as f32);
    let v = V8::new(lanes(0), lanes(1), lanes(2));
    let (direction, distance) = (v.normalize(), v.length());
    let limit = match speck.shape {
        NOTHING => X8::lit(f64::INFINITY),
        // a sphere is nearer than its middle, but does not hide itself
        _ => distance * X8::lit(1.0 - SPARED),
    };
    let rays = scene.surfaces.bvh.rays(V8::lit([eye.x, eye.y, eye.z]), direction);
    let mut visible = [M8::splat(true)];
    let target = [u32x8::splat(speck.shape)];
    scene.surfaces.bvh.occluded(&[rays], &mut visible, &[limit], &target, &mut Scratch::default());
    let part = f64::from(visible[0].bits().count_ones()) / 8.0;
    (part > 0.0).then(|| Specks::new(area * part, speck.squared * exposure * exposure))
}
