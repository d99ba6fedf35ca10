//! The cost of a scene as it grows: hills of 10² to 10⁷ triangles under one light, and hills of 20,000 triangles under 1 to 10⁵ lights.
//!
//! `cargo bench -p etendue-benches --bench scaling -- [MOST]` omits scenes of more than MOST triangles. "build" is all the preparation for
//! rendering, on as many threads as there are processors; "peak" is the peak memory of the process from making the scene to the image. The
//! image has 256 × 256 pixels of 16 samples, by solid angle, rendered on one thread. "5 %" is the number of samples, in millions, of which
//! the preparation on one thread takes 5 % of the time: a task of `etendue plan` should have no fewer.

use etendue_benches::memory::{peak, start_peak};
use etendue_render::sampler::Sampler;
use etendue_render::scene::{Emission, Geometry, Parallelogram, Scene, Shape};
use etendue_render::technique::Technique;
use etendue_render::{Settings, World};
use std::path::Path;
use std::time::Instant;

/// A camera above the ground and a light of 2 × 2. The first material is the ground's.
const EMPTY: &str = r#"
Scale -1 1 1
LookAt 0 6 7.5   0 0 -0.2   0 1 0
Camera "perspective" "float fov" 40
WorldBegin
Material "diffuse" "rgb reflectance" [ 0.5 0.5 0.5 ]
Shape "sphere" "float radius" 0.01
Material "diffuse" "rgb reflectance" [ 0 0 0 ]
AreaLightSource "diffuse" "rgb L" [ 12 12 12 ]
Shape "bilinearmesh" "point3 P" [ 1 5 -2   3 5 -2   1 5 0   3 5 0 ]
"#;

fn empty() -> Scene {
    let mut scene = etendue_scene::parse(EMPTY, "empty.pbrt", Path::new(".")).expect("a scene");
    // the sphere only defines its material
    scene.shapes = scene.shapes[1..].into();
    scene
}

/// A height field over [−12, 12]² with about `count` triangles.
fn hills(scene: &mut Scene, count: usize) {
    let n = ((count as f64 / 2.0).sqrt().round() as usize).max(1);
    let at = |i: usize, j: usize| {
        let [x, z] = [i, j].map(|k| -12.0 + 24.0 * k as f64 / n as f64);
        let y = 0.25 * (1.7 * x).sin() * (1.3 * z).cos() + 0.1 * (5.3 * x + 1.1).sin() * (4.7 * z + 0.3).sin();
        [x as f32, y as f32, z as f32]
    };
    scene.triangles = Vec::with_capacity(2 * n * n + 1);
    for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
        let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)];
        scene.triangles.extend([[a, b, c], [d, c, b]]);
    }
    scene.triangle_materials = vec![0; scene.triangles.len()];
}

/// `count` small panels on a lattice 5 above the ground, with the same total power as the one light.
fn panels(scene: &mut Scene, count: usize) {
    let model = scene.shapes[0].clone();
    let n = (count as f64).sqrt().ceil() as usize;
    let (pitch, side) = (8.0 / n as f32, 4.0 / n as f32);
    let emission = model
        .emission
        .map(|e| Emission { radiance: e.radiance.map(|x| x / (4.0 * (count as f32) / (n * n) as f32)), ..e });
    scene.shapes = (0..count)
        .map(|k| Shape {
            geometry: Geometry::Parallelogram(Parallelogram {
                p: [-4.0 + pitch * (k / n) as f32, 5.0, -4.0 + pitch * (k % n) as f32],
                u: [side, 0.0, 0.0],
                v: [0.0, 0.0, side],
            }),
            emission,
            ..model.clone()
        })
        .collect();
}

fn row(make: impl Fn() -> Scene) {
    start_peak();
    let mut scene = make();
    let (triangles, lights) = (scene.triangles.len(), scene.shapes.len());
    let start = Instant::now();
    let world = World::from_scene(&mut scene).expect("few enough primitives");
    let build = start.elapsed().as_secs_f64();
    let settings = Settings {
        width: 256,
        height: 256,
        spp: 16,
        technique: Technique::SolidAngle,
        depth: 0,
        sampler: Sampler::Independent,
        seed: 1,
        ..Settings::DEFAULT
    };
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let start = Instant::now();
    let _ = one.install(|| world.render(&settings, &|_| ()));
    let speed = 256.0 * 256.0 * 16.0 / start.elapsed().as_secs_f64() / 1e6;
    let (bytes, peak) = (world.bytes() as f64 / triangles as f64, peak());
    drop(world);
    let mut scene = make();
    let start = Instant::now();
    let _ = one.install(|| World::from_scene(&mut scene).expect("few enough primitives"));
    let least = 19.0 * speed * start.elapsed().as_secs_f64();
    println!("| {triangles} | {lights} | {build:.4} | {bytes:.1} | {peak:.0} | {speed:.2} | {least:.2} |");
}

fn main() {
    let most = std::env::args().skip(1).find_map(|a| a.parse().ok()).unwrap_or(10_000_000);
    println!(
        "| triangles | lights | build, s | bytes of tree and triangles, each | peak, MB | M samples/s | 5 %, M samples |"
    );
    println!("|---|---|---|---|---|---|---|");
    for lights in [1, 10, 100, 1_000, 10_000, 100_000] {
        row(|| {
            let mut scene = empty();
            hills(&mut scene, 20_000);
            panels(&mut scene, lights);
            scene
        });
    }
    let sizes = (2..8).map(|k| 10_usize.pow(k)).filter(|&n| n <= most);
    for triangles in sizes {
        row(|| {
            let mut scene = empty();
            hills(&mut scene, triangles);
            scene
        });
    }
}
