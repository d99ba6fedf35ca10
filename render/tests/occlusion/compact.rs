//! Flat lights that are compact as [`COMPACT`] says, whole and behind a triangle: errors relative to the square of their size.

use super::truth::{Truth, exact};
use etendue::{Vec3, f32x8};
use etendue_judge::generators::Random;
use etendue_judge::occlusion::Scene;
use etendue_oracle::{Greatest, V3, along, dot, length, narrow, sub, unit, wide};
use etendue_visible::Solid;
use etendue_visible::measure::COMPACT;

/// What the documentation of `Occlusion::visible` states, in units of (half of the perimeter / distance)².
const BOUND: f64 = 1e-7;

/// A parallelogram with edges of these lengths at a distance of about 1, seen from eight points, behind one triangle or none.
fn scene(random: &mut Random, [long, short]: [f64; 2], hidden: bool) -> Scene {
    let (direction, normal) = (random.direction(), random.direction());
    let edges = [long, short].map(|size| random.direction().map(|x| x * size));
    let point = |random: &mut Random, size: f64| along([0.0; 3], random.direction(), random.range(0.0, size));
    let points = core::array::from_fn(|_| narrow(point(random, 0.3 * long)));
    let vector = |v| exact(Vec3::from(narrow(v)));
    let light = Solid::Parallelogram { corner: vector(direction), edges: edges.map(vector) };
    // half of the way to the middle of the light
    let middle = along(along(direction, edges[0], 0.5), edges[1], 0.5).map(|x| 0.5 * x);
    let around = [(); 4].map(|()| vector(along(middle, random.direction(), long * random.range(0.1, 0.6))));
    let occluder = Solid::Polygon { corners: around, count: 3, deviation: 0.0 };
    let above = if dot(direction, normal) < 0.0 { normal.map(|x| -x) } else { normal };
    Scene {
        light,
        occluders: if hidden { vec![occluder] } else { Vec::new() },
        points,
        normals: [narrow(unit(above)); 8],
    }
}

/// (Half of the perimeter / distance)² from a point, if the light is compact there.
fn square(scene: &Scene, lane: usize) -> Option<f64> {
    let Solid::Parallelogram { corner, edges: [u, v] } = scene.light else { return None };
    let [corner, u, v] = [corner, u, v].map(V3::from);
    let p = wide(scene.points[lane]);
    let distance = length(sub(along(along(corner, u, 0.5), v, 0.5), p));
    let reach = length(along(u, v, 1.0)).max(length(sub(u, v))) / 2.0;
    let size = length(u) + length(v);
    (reach * reach < 0.99 * COMPACT * distance * distance).then(|| (size / distance).powi(2))
}

#[test]
fn errors_of_compact_lights() {
    let mut random = Random::new(1);
    for hidden in [false, true] {
        for aspect in [1.0, 0.1, 1e-3] {
            for size in [0.003, 0.03, 0.1, 0.3, 0.6] {
                let (mut worst, mut cut, mut points) = (Greatest::NONE, 0, 0);
                for i in 0..400 {
                    let scene = scene(&mut random, [size, size * aspect], hidden);
                    let found = scene.found::<f32x8>(0).unwrap();
                    for lane in 0..8 {
                        let (Some(square), Some([truth, _])) = (square(&scene, lane), scene.truth(lane)) else {
                            continue;
                        };
                        points += 1;
                        cut += u32::from(truth.left > 0.0 && truth.left < truth.all);
                        worst.take((f64::from(found.as_array()[lane]) - truth.left).abs() / square, i);
                    }
                }
                println!(
                    "behind {}, 1 : {aspect}, size {size}: {points} points, {cut} partly hidden, greatest error {:.1e} of the square",
                    u8::from(hidden),
                    worst.error()
                );
                assert!(points > 1000 && (cut > 100) == hidden, "{points} {cut}");
                assert!(worst.error() < BOUND, "{aspect} {size}: {worst:?}");
            }
        }
    }
}
