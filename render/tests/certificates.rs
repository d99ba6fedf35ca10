//! Compares what certificates allow to compute with the light that all primitives leave, in double precision: random patches and lights in
//! difficult scenes.

mod brute_force;
mod meshes;

use brute_force::regimes::REGIMES;
use brute_force::values;
use etendue::{Mask, f32x8};
use etendue_oracle::tier::cases;
use etendue_render::bvh::{Bvh, Hits, NOTHING, Scratch, ShapeSet};
use etendue_render::camera::Pinhole;
use etendue_render::certify::{Bodies, Certificate, Certifier, Patch, Pyramid, Viewer};
use etendue_render::packet::M8;
use etendue_render::surfaces::Surfaces;
use meshes::{Triangle, cube, sheet};

/// Patches and lights of each regime whose values are compared, and how many times as many are of chamfered boxes: a plane through rounded
/// ends of an edge is wrong in one of ten thousand.
const SHAFTS: u64 = 4_000;
const CHAMFERED: u64 = 10;

/// Compares values in all regimes, and prints a table.
fn soundness(shafts: u64, chamfered: u64) {
    let mut broken = Vec::new();
    let only = std::env::var("REGIME");
    let is_regime = |only: &String| REGIMES.iter().any(|(name, _)| name == only);
    assert!(only.as_ref().ok().is_none_or(is_regime), "REGIME={only:?} is none of the regimes");
    for (k, (name, made)) in (0_u32..).zip(REGIMES) {
        if only.as_ref().is_ok_and(|only| only != name) {
            continue;
        }
        let shafts = if name == "chamfered boxes" { chamfered * shafts } else { shafts };
        // eight regimes have numbers of their own; the ninth makes other scenes of those of the first
        let halves = [0, 1].map(|half| k.wrapping_mul(0x2000_0000) + half * 0x1000_0000 + 1);
        let parts = std::thread::scope(|scope| {
            let run = |first| scope.spawn(move || values::campaign(name, made, shafts / 2, first));
            halves.map(run).map(|part| part.join().unwrap())
        });
        let mut all = values::Values::default();
        parts.into_iter().for_each(|part| all.add(part));
        println!("{name}: {all}");
        if all.worst > 1.0 || all.worst.is_nan() {
            println!("{name}: {}", all.place);
            broken.push((name, all.worst, all.place));
        }
        assert!(all.fit.off < 1.0 && all.fit.height > 1.0, "{name}: a point is outside of its patch: {:?}", all.fit);
    }
    assert!(broken.is_empty(), "{broken:#?}");
}

/// The first scene from each of these numbers has a view for which a closed form in single precision is wrong: because it sees an edge of the
/// light, of a flat blocker or of a body under nearly 180°, or because the horizon cuts the light between the points of a sphere that
/// `Precision::of` asks.
#[test]
fn values_that_were_wrong_agree_with_the_truth() {
    let pinned = [
        ("thin sheets", 295_608_900),
        ("thin sheets", 7_632_983),
        ("long walls", 41_530_617),
        ("touching spheres", 1_932_016_667),
    ];
    for (name, first) in pinned {
        let (_, made) = REGIMES.into_iter().find(|(regime, _)| *regime == name).unwrap();
        let values = values::campaign(name, made, 1, first);
        assert!(values.worst <= 1.0, "{} times the allowed error: {}", values.worst, values.place);
    }
}

#[test]
fn values_agree_with_the_truth() {
    soundness(cases(SHAFTS / 8, SHAFTS), CHAMFERED);
}

#[test]
#[ignore = "ten million patches and lights: half an hour"]
fn values_agree_with_the_truth_at_length() {
    soundness(1_250_000, 1);
}

/// Median times of the search for bodies in the largest meshes that are searched: a sheet, and boxes side by side.
fn time_per_search() {
    let boxes = |k: usize| cube(1).into_iter().map(move |t| t.map(|[x, y, z]| [x + 4.0 * k as f32, y, z]));
    let boxes: Vec<Triangle> = (0..65_536 / 12).flat_map(boxes).collect();
    for (name, triangles) in [("sheet", sheet(181, |x, z| 0.25 * x * z)), ("boxes", boxes)] {
        let bvh = Bvh::new(&triangles, ShapeSet::new(std::iter::empty()).unwrap()).unwrap();
        let search = |_| {
            let start = std::time::Instant::now();
            (Bodies::new(&bvh).len(), start.elapsed().as_secs_f64() * 1e3)
        };
        let mut times = [0; 9].map(search);
        times.sort_by(|a, b| a.1.total_cmp(&b.1));
        let (found, milliseconds) = times[4];
        println!("{name}: {found} bodies among {} triangles, {milliseconds:.1} ms", triangles.len());
    }
}

/// Median times of certificates, by outcome, and of the search for bodies.
#[test]
#[ignore = "measures time"]
fn time_per_certificate() {
    time_per_search();
    for name in ["quads", "terrain"] {
        let scene = etendue_scene::load(name).unwrap();
        let surfaces = Surfaces::new(&scene).unwrap();
        let bodies = Bodies::new(&surfaces.bvh);
        let mut certifier = Certifier::new(&surfaces, &bodies, surfaces.light_shapes());
        let lights = surfaces.light_shapes().count();
        for (size, wideness) in [(256_u32, 1_u32), (1024, 16)] {
            let pinhole = Pinhole::new(&scene.camera, size, size);
            let (mut places, mut scratch) = (Vec::new(), Scratch::default());
            for y in (0..size).step_by(wideness as usize) {
                for x in (0..size).step_by(wideness as usize) {
                    let middle = [x, y].map(|x| f32x8::splat(x as f32 + 0.5 * wideness as f32));
                    let (origin, direction) = pinhole.ray(middle[0], middle[1]);
                    let mut hits = [Hits::none(f32x8::splat(f32::INFINITY))];
                    let ray = surfaces.bvh.rays(origin, direction);
                    surfaces.bvh.closest(&[ray], &[M8::splat(true)], &mut hits, &mut scratch);
                    let place = hits[0].place.to_array()[0];
                    if place != NOTHING {
                        let area = [x, y, x + wideness, y + wideness].map(f64::from);
                        places.push((place, Pyramid::new(&pinhole, area)));
                    }
                }
            }
            let start = std::time::Instant::now();
            let patch = |(place, pyramid): &(u32, Pyramid)| Patch::of(&surfaces, *place, Viewer::Pixels(pyramid));
            let patches: Vec<Patch> = places.iter().filter_map(patch).collect();
            let nanoseconds = start.elapsed().as_secs_f64() * 1e9 / places.len() as f64;
            println!(
                "{name} at {size}, {wideness}: {} patches of {}, {nanoseconds:.0} ns each",
                patches.len(),
                places.len()
            );
            let mut outcomes = [const { Vec::new() }; 4];
            for light in 0..lights {
                for patch in &patches {
                    let start = std::time::Instant::now();
                    let outcome = match certifier.certify(patch, light) {
                        Certificate::Lit(_) => 0,
                        Certificate::Dark => 1,
                        Certificate::Blockers(..) => 2,
                        Certificate::Unknown => 3,
                    };
                    outcomes[outcome].push(start.elapsed().as_secs_f64() * 1e6);
                }
            }
            for (outcome, mut times) in ["lit", "dark", "blockers", "unknown"].iter().zip(outcomes) {
                times.sort_by(f64::total_cmp);
                let at = |share: f64| times.get((times.len() as f64 * share) as usize).unwrap_or(&0.0);
                println!("    {outcome:8} {:7}, {:.2} µs, 90 % below {:.2} µs", times.len(), at(0.5), at(0.9));
            }
        }
    }
}
