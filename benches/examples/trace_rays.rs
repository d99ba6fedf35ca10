//! Traces the triangles of a scene: camera rays, and shadow rays from what they hit to a point above. Prints millions of rays per second
//! of the processor's time, and writes triangles and rays for `benches/peers/rays_beside_embree.py`, which traces the same by Embree.
//!
//! ```text
//! cargo run --release -p etendue-benches --example trace_rays -- SCENE FOLDER
//! ```

use etendue::{Mask, Real, Vec2, u32x8};
use etendue_laboratory::processor_time::processor_seconds;
use etendue_render::bvh::{Bvh, GROUP, Hits, PrimitiveIds, Rays, Scratch, ShapeSet};
use etendue_render::camera::{Camera, CameraSample};
use etendue_render::packet::{M8, V8, X8};
use etendue_render::sampler::{FILM, NumberSource, Packet};
use etendue_render::{Sampler, scene};
use std::error::Error;
use std::path::Path;

/// Pixels across and down, each with a packet of eight samples.
const SIDE: u32 = 128;
/// Times that all rays are traced: the fastest counts.
const TIMES: usize = 30;

type Group = [Rays; GROUP];

/// Rays per second, in millions.
fn rate(groups: &[Group], mut trace: impl FnMut(&Group)) -> f64 {
    let time = |_| {
        let start = processor_seconds();
        groups.iter().for_each(&mut trace);
        processor_seconds().zip(start).map_or(f64::NAN, |(end, start)| end - start)
    };
    let fastest = (0..TIMES).map(time).fold(f64::INFINITY, f64::min);
    (8 * GROUP * groups.len()) as f64 / fastest / 1e6
}

/// The pixels of the image along a Z-order curve.
fn pixel(index: u32) -> [u32; 2] {
    let even = |i: u32| (0..16).fold(0, |n, bit| n | (i >> (2 * bit) & 1) << bit);
    [even(index), even(index >> 1)]
}

fn camera_rays(bvh: &Bvh, settings: &scene::CameraSettings) -> Vec<Group> {
    let camera = Camera::new(settings, SIDE, SIDE);
    let source = NumberSource::new(Sampler::Sobol, 1, [8, 1], SIDE, false);
    let ray = |index: u32| {
        let [x, y] = pixel(index).map(u32x8::splat);
        let sample = u32x8::new([0, 1, 2, 3, 4, 5, 6, 7]);
        let packet = Packet { x, y, sample, set: u32x8::splat(0), active: M8::splat(true) };
        let (origin, direction) =
            camera.rays(&CameraSample::new(x, y, source.pair(&packet, FILM), Some(Vec2::default())));
        bvh.rays(origin, direction)
    };
    (0..SIDE * SIDE / GROUP as u32).map(|group| std::array::from_fn(|p| ray(group * GROUP as u32 + p as u32))).collect()
}

/// A point above the middle of the box around the triangles, half of its diagonal up.
fn above(triangles: &[[[f32; 3]; 3]], up: [f64; 3]) -> [f32; 3] {
    let corners = || triangles.iter().flatten();
    let ends = [0, 1, 2].map(|k| {
        let of = |[low, high]: [f32; 2], corner: &[f32; 3]| [low.min(corner[k]), high.max(corner[k])];
        corners().fold([f32::INFINITY, f32::NEG_INFINITY], of)
    });
    let diagonal = ends.map(|[low, high]| (high - low).powi(2)).iter().sum::<f32>().sqrt();
    std::array::from_fn(|k| 0.5 * (ends[k][0] + ends[k][1] + diagonal * up[k] as f32))
}

/// All coordinates of origins, then of directions, then `more`.
fn write(path: &Path, groups: &[Group], more: &[X8]) -> std::io::Result<()> {
    let rays = || groups.iter().flatten();
    let columns: [fn(&Rays) -> X8; 6] =
        [|r| r.origin.x, |r| r.origin.y, |r| r.origin.z, |r| r.direction.x, |r| r.direction.y, |r| r.direction.z];
    let all = columns.iter().flat_map(|of| rays().map(of)).chain(more.iter().copied());
    std::fs::write(path, all.flat_map(|x| x.to_array()).flat_map(f32::to_le_bytes).collect::<Vec<u8>>())
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [name, folder] = &arguments[..] else { return Err("usage: trace_rays SCENE FOLDER".into()) };
    let scene = etendue_scene::load(name)?;
    let triangles = scene.triangles.clone();
    let bvh = Bvh::new(&triangles, ShapeSet::new(std::iter::empty())?)?;
    let (all, none) = ([M8::splat(true); GROUP], [PrimitiveIds::none(); GROUP]);
    let mut scratch = Scratch::default();
    let camera = camera_rays(&bvh, &scene.camera);
    let closest = |group: &Group, scratch: &mut Scratch| {
        let mut hits = [Hits::none(X8::splat(f32::INFINITY)); GROUP];
        bvh.closest(group, &all, &mut hits, scratch);
        hits
    };
    let mut found = 0;
    let first =
        rate(&camera, |group| found += closest(group, &mut scratch).iter().filter(|hits| hits.any().any()).count());
    let (mut shadow, mut limits) = (Vec::new(), Vec::new());
    let to = V8::from(above(&triangles, scene.camera.up));
    for group in &camera {
        let hits = closest(group, &mut scratch);
        shadow.push(std::array::from_fn(|p| {
            let (rays, hits) = (&group[p], &hits[p]);
            let distance = hits.distance.keep(hits.any());
            let from = rays.direction.mul_add(distance * X8::splat(0.9999), rays.origin);
            limits.push((to - from).length());
            bvh.rays(from, (to - from).normalize())
        }));
    }
    let mut index = 0;
    let second = rate(&shadow, |group| {
        let (mut active, at) = (all, index % limits.len());
        bvh.occluded(group, &mut active, &limits[at..at + GROUP], &none, &mut scratch);
        found += active.iter().filter(|lanes| lanes.any()).count();
        index += GROUP;
    });
    assert!(found > 0);
    println!("{name} {} {first:.2} {second:.2}", triangles.len());
    let folder = Path::new(folder);
    let corners = triangles.iter().flatten().flatten().flat_map(|x| x.to_le_bytes());
    std::fs::write(folder.join("triangles.f32"), corners.collect::<Vec<u8>>())?;
    write(&folder.join("camera.f32"), &camera, &[])?;
    write(&folder.join("shadow.f32"), &shadow, &limits)?;
    Ok(())
}
