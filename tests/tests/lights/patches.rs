//! Bilinear patches: what a ray meets is what was sampled, of flat ones along the axes, too, where one of two roots does not exist.

use etendue::{BilinearPatch, LightSampler, Vec2};
use etendue_judge::generators::Random;
use etendue_oracle::tier::cases;
use etendue_oracle::{V3, along, cross, dot, length, narrow, sub, unit, wide};

/// Corner, and from there both edges and the opposite corner.
type Corners = [[f32; 3]; 4];

fn sampler(patch: Corners) -> etendue::light::PatchByArea<f32> {
    let [p, u, v, w] = patch.map(Into::into);
    BilinearPatch::<f32>::new(p, u, v, w).by_area([0.0; 3].into())
}

/// Flat patches in planes along the axes, by name: of most of them the cross product of one edge and the twist is exactly 0.
fn flat() -> Vec<(&'static str, Corners)> {
    // in its plane: the edges, and how often the twist contains each of them
    let shapes: [(&str, [[f32; 2]; 3]); 8] = [
        ("square", [[2.0, 0.0], [0.0, 2.0], [0.0, 0.0]]),
        ("rectangle", [[2.0, 0.0], [0.0, 0.5], [0.0, 0.0]]),
        ("parallelogram", [[2.0, 0.0], [0.5, 1.0], [0.0, 0.0]]),
        ("trapezoid that widens along t", [[1.5, 0.0], [-0.25, 2.0], [0.5, 0.0]]),
        ("trapezoid that narrows along t", [[2.0, 0.0], [0.5, 1.5], [-0.5, 0.0]]),
        ("trapezoid that widens along s", [[2.0, 0.0], [0.0, 1.0], [0.0, 0.75]]),
        ("trapezoid that narrows along s", [[2.0, -0.25], [0.0, 1.5], [0.0, -0.75]]),
        ("quadrilateral", [[2.0, 0.0], [0.0, 1.5], [0.25, -0.5]]),
    ];
    let mut all = Vec::new();
    for (name, [u, v, [a, b]]) in shapes {
        for axis in 0..3 {
            for height in [1.0, -0.25, 3.0] {
                for (x, y) in [(-1.0, -1.0), (0.5, -0.75), (-3.0, 1.0)] {
                    let place = |[x, y]: [f32; 2], z: f32| {
                        let mut v = [0.0; 3];
                        (v[axis], v[(axis + 1) % 3], v[(axis + 2) % 3]) = (z, x, y);
                        v
                    };
                    let w = core::array::from_fn(|k| u[k] + v[k] + a * u[k] + b * v[k]);
                    let patch = [place([x, y], height), place(u, 0.0), place(v, 0.0), place(w, 0.0)];
                    let [p, u, v, w] = patch;
                    all.push((name, patch));
                    // the other way round
                    all.push((name, [p, v, u, w]));
                }
            }
        }
    }
    all
}

/// The point at (s, t).
fn at(patch: Corners, s: f64, t: f64) -> V3 {
    let [p, u, v, w] = patch.map(wide);
    along(along(along(p, u, s), v, t), sub(sub(w, u), v), s * t)
}

#[test]
fn a_ray_to_a_sample_of_a_flat_patch_hits_that_sample() {
    let mut random = Random::new(1);
    for (name, patch) in flat() {
        let sampler = sampler(patch);
        for _ in 0..200 {
            let u = Vec2::new(random.unit(), random.unit());
            let s = sampler.sample(u);
            let hit = sampler.hit(s.direction);
            let said = || format!("{name} {patch:?} at {u:?}: {hit:?} for {s:?}");
            let off = |a: f32, b: f32| f64::from(a / b - 1.0).abs();
            // what a rounded direction does to the point grows as the cosine falls
            let cos = f64::from(s.direction.dot(s.normal).abs());
            assert!(s.pdf > 0.0 && off(hit.distance, s.distance) < 4e-6 / cos, "{}", said());
            assert!(off(hit.pdf, s.pdf) < 2e-5 / cos && hit.emits == s.emits, "{}", said());
            let uv = (hit.uv.x - s.uv.x).abs().max((hit.uv.y - s.uv.y).abs());
            assert!(f64::from(uv) < 2e-5 / cos && hit.normal.dot(s.normal) > 0.99999, "{}", said());
            assert_eq!(hit.pdf, sampler.pdf(s.direction), "{}", said());
            let again = sampler.invert(s.direction);
            assert!(f64::from((again.x - u.x).abs().max((again.y - u.y).abs())) < 4e-5 / cos, "{again:?}: {}", said());
        }
    }
}

/// By the midpoint rule over a part of the plane that is larger than the patch: what is beside it counts, too.
#[test]
fn pdf_of_a_flat_patch_integrates_to_1() {
    const N: usize = 150;
    let mut worst = 0.0_f64;
    for (name, patch) in flat().into_iter().step_by(cases(3, 1)) {
        let sampler = sampler(patch);
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|[s, t]| at(patch, s, t));
        let normal = unit(cross(wide(patch[1]), wide(patch[2])));
        let axis = (0..3).find(|&k| normal[k].abs() > 0.5).unwrap();
        let [a, b] = [(axis + 1) % 3, (axis + 2) % 3];
        let range = |k: usize| {
            let [low, high] = [f64::min, f64::max].map(|of| corners.iter().map(|c| c[k]).reduce(of).unwrap());
            (low - 0.2 * (high - low), 1.4 * (high - low) / N as f64)
        };
        let ((low_a, step_a), (low_b, step_b)) = (range(a), range(b));
        let mut sum = 0.0;
        for i in 0..N {
            for j in 0..N {
                let mut point = corners[0];
                (point[a], point[b]) = (low_a + step_a * (i as f64 + 0.5), low_b + step_b * (j as f64 + 0.5));
                let (d, w) = (length(point), unit(point));
                let pdf = sampler.pdf(narrow(w).into());
                sum += f64::from(pdf) * w[axis].abs() / (d * d) * step_a * step_b;
            }
        }
        worst = worst.max((sum - 1.0).abs());
        // a row of points more or less along each edge
        assert!((sum - 1.0).abs() < 0.025, "{name} {patch:?}: {sum}");
    }
    println!("off by up to {worst:.1e}");
}

/// The nearest point in a direction, by the quadratic equation in s; and how near to another answer that is.
fn nearest(patch: Corners, ray: V3) -> (Option<f64>, f64) {
    let [p, u, v, w] = patch.map(wide);
    let twist = sub(sub(w, u), v);
    let a = dot(ray, cross(u, twist));
    let b = dot(ray, cross(p, twist)) + dot(ray, cross(u, v));
    let c = dot(ray, cross(p, v));
    let discriminant = b * b - 4.0 * a * c;
    let mut margin = (discriminant / (b * b + (a * c).abs())).abs();
    if discriminant < 0.0 {
        return (None, margin);
    }
    let sum = -0.5 * (b + discriminant.sqrt().copysign(b));
    let mut best = None;
    for (above, below) in [(c, sum), (sum, a)] {
        if below == 0.0 {
            continue;
        }
        let s = above / below;
        let (start, line) = (along(p, u, s), along(v, twist, s));
        let across = cross(ray, line);
        let t = -dot(cross(ray, start), across) / dot(across, across);
        let distance = dot(ray, along(start, line, t));
        margin = [s, t].iter().fold(margin, |margin, x| margin.min(x.abs()).min((1.0 - x).abs()));
        let found = (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) && distance > 0.0;
        if found && best.is_none_or(|best| distance < best) {
            best = Some(distance);
        }
    }
    (best, margin)
}

/// Rays beside the outline of a twisted patch have no real root, and miss it; so do those beside a patch with an edge of length 0.
#[test]
fn rays_hit_a_patch_where_it_is() {
    let mut random = Random::new(3);
    let (mut hits, mut misses) = (0, 0);
    for round in 0..1500 {
        let mut unit = || random.direction().map(|x| x as f32);
        let [p, u, mut v, d] = [unit(), unit(), unit(), unit()];
        let twist = [0.0, 0.1, 0.5, 1.0, 3.0][round % 5];
        if round % 7 == 0 {
            v = [0.0; 3];
        }
        let w = core::array::from_fn(|k| u[k] + v[k] + twist * d[k]);
        let patch = [p.map(|x| 0.7 * x), u, v, w];
        let sampler = sampler(patch);
        for _ in 0..400 {
            let ray = narrow(random.direction());
            let (truth, margin) = nearest(patch, wide(ray));
            if margin < 1e-3 {
                continue;
            }
            let hit = sampler.hit(ray.into());
            let cos = f64::from(hit.direction.dot(hit.normal).abs());
            match truth {
                Some(distance) => {
                    hits += 1;
                    let off = (f64::from(hit.distance) / distance - 1.0).abs();
                    assert!(hit.pdf > 0.0 && off < 1e-4 / cos, "{distance} is {hit:?}: {patch:?}");
                }
                None => {
                    misses += 1;
                    // a ray in the plane of a flat patch is known to neither side of it
                    assert!(hit.pdf == 0.0 || cos < 1e-3, "a miss is {hit:?}: {patch:?}");
                }
            }
        }
    }
    println!("{hits} hits, {misses} misses");
    assert!(hits > 20_000 && misses > 200_000, "{hits} hits, {misses} misses");
}
