//! Bilinear patches: what a ray meets is what was sampled, of flat ones along the axes, too, where one of two roots does not exist.

use etendue::{BilinearPatch, LightSampler, Vec2};
use etendue_judge::generators::Random;
use etendue_oracle::{V3, along, cross, dot, narrow, sub, wide};

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

/// Rays beside the outline of a twisted patch have no real root, and miss it; so do those beside a flat one, and beside one with an edge of length 0.
#[test]
fn rays_hit_a_patch_where_it_is() {
    let mut random = Random::new(3);
    let mut patches: Vec<Corners> = flat().into_iter().map(|(_, patch)| patch).collect();
    for round in 0..1500 {
        let mut unit = || random.direction().map(|x| x as f32);
        let [p, u, mut v, d] = [unit(), unit(), unit(), unit()];
        let twist = [0.0, 0.1, 0.5, 1.0, 3.0][round % 5];
        if round % 7 == 0 {
            v = [0.0; 3];
        }
        patches.push([p.map(|x| 0.7 * x), u, v, core::array::from_fn(|k| u[k] + v[k] + twist * d[k])]);
    }
    let mut count = [0; 2];
    for patch in patches {
        let sampler = sampler(patch);
        for _ in 0..400 {
            let ray = narrow(random.direction());
            let (truth, margin) = nearest(patch, wide(ray));
            if margin < 1e-3 {
                continue;
            }
            let hit = sampler.hit(ray.into());
            let cos = f64::from(hit.direction.dot(hit.normal).abs());
            count[usize::from(truth.is_some())] += 1;
            // a ray in the plane of a flat patch is known to neither side of it
            let right = truth.map_or(hit.pdf == 0.0 || cos < 1e-3, |distance| {
                hit.pdf > 0.0 && (f64::from(hit.distance) / distance - 1.0).abs() < 1e-4 / cos
            });
            assert!(right, "{truth:?} is {hit:?}: {patch:?}");
        }
    }
    let [misses, hits] = count;
    println!("{hits} hits, {misses} misses");
    assert!(hits > 30_000 && misses > 200_000, "{hits} hits, {misses} misses");
}
