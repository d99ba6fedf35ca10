//! Direct light of eight lights on a white diffuse surface, by multiple importance sampling: one body for every light, technique and vector
//! width. Nothing is in the way, so that each has a closed form; the program prints the errors, and fails if one is too large.
//!
//! `cargo run --release --example eight_lights`

#![allow(clippy::disallowed_methods, reason = "bits of a closed form may differ between platforms")]

use etendue::estimate::{Heuristic, Welford};
use etendue::sequence::{OwenSobol, Sequence};
use etendue::warp::CosineHemisphere;
use etendue::{
    BilinearPatch, Disk, Frame, LightSampler, Parallelogram, Polygon, Real, Rectangle, Sphere, Sun, Triangle, Uint,
    Vec2, Vec3, Warp, f32x8,
};
use std::f64::consts::{FRAC_1_PI, PI};
use std::process::ExitCode;

// The shading point and its unit normal.
const P: [f64; 3] = [0.2, 0.0, 0.1];
const N: [f64; 3] = [0.0, 0.8, 0.6];
// The lights, whose normals are towards the point. Of the patch, the third number is the opposite corner: it is flat, and no parallelogram.
const SPHERE: ([f64; 3], f64) = ([-1.0, 1.5, 0.5], 0.5);
const TRIANGLE: [[f64; 3]; 3] = [[0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]];
const PARALLELOGRAM: [[f64; 3]; 3] = [[-1.0, 2.0, 0.0], [1.0, 0.2, 0.0], [0.1, 0.1, 1.0]];
const RECTANGLE: [[f64; 3]; 3] = [[-0.5, 1.5, 0.2], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
const CORNERS: [[f64; 3]; 5] = [[0.0, 2.0, 0.0], [1.0, 2.0, 0.0], [1.5, 2.0, 1.0], [1.0, 2.0, 2.0], [0.0, 2.0, 2.0]];
const PATCH: [[f64; 3]; 4] = [[-0.5, 2.0, 0.3], [1.0, 0.0, 0.0], [1.5, 0.0, 1.25], [0.0, 0.0, 1.0]];
// A disk parallel to the surface: its height, its distance from the normal, which is along x, and its radius.
const DISK: (f64, f64, f64) = (1.5, 0.5, 0.7);
const SUN: ([f64; 3], f64) = ([0.0, 0.6, 0.8], 0.02);

/// Samples of each light and of the surface.
const SAMPLES: u32 = 1 << 16;
/// The greatest relative error that is right for so many samples.
const MOST: f64 = 1e-3;

fn add(a: [f64; 3], b: [f64; 3], scale: f64) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] + scale * b[k])
}
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
/// The irradiance at the point from a polygon with these corners and a radiance of 1: Lambert 1760.
fn lambert(corners: &[[f64; 3]]) -> f64 {
    let r: Vec<_> = corners.iter().map(|&corner| add(corner, P, -1.0)).collect();
    let edge = |(i, &a): (usize, &[f64; 3])| {
        let b = r[(i + 1) % r.len()];
        let (normal, cos) = (cross(a, b), dot(a, b));
        let sin = dot(normal, normal).sqrt();
        sin.atan2(cos) * dot(normal, N) / sin
    };
    r.iter().enumerate().map(edge).sum::<f64>().abs() / 2.0
}
/// The corners of a parallelogram.
fn parallelogram([corner, s, t]: [[f64; 3]; 3]) -> [[f64; 3]; 4] {
    [corner, add(corner, s, 1.0), add(add(corner, s, 1.0), t, 1.0), add(corner, t, 1.0)]
}
fn exact() -> [f64; 8] {
    let sphere = add(SPHERE.0, P, -1.0);
    let square = dot(sphere, sphere);
    let (h, a, r) = DISK;
    let sum = h * h + a * a + r * r;
    let [corner, s, diagonal, t] = PATCH;
    [
        PI * SPHERE.1 * SPHERE.1 / square * dot(sphere, N) / square.sqrt(),
        lambert(&TRIANGLE),
        lambert(&parallelogram(PARALLELOGRAM)),
        lambert(&parallelogram(RECTANGLE)),
        PI / 2.0 * (1.0 - (sum - 2.0 * r * r) / (sum * sum - 4.0 * r * r * a * a).sqrt()),
        lambert(&CORNERS),
        lambert(&[corner, add(corner, s, 1.0), add(corner, diagonal, 1.0), add(corner, t, 1.0)]),
        PI * SUN.1 * (2.0 - SUN.1) * dot(SUN.0, N),
    ]
}

/// Radiance reflected by a white diffuse surface with the normal `n`, by one sample of the light and one of the surface.
fn reflected<R: Real>(light: &impl LightSampler<R>, n: Vec3<R>, u: [Vec2<R>; 2]) -> R {
    let bsdf = |w: Vec3<R>| w.dot(n).greater(R::lit(0.0)) * R::lit(FRAC_1_PI); // times the cosine, and its own pdf
    let s = light.sample(u[0]); // a renderer traces a shadow ray here, along s.direction up to s.distance
    let by_light = bsdf(s.direction) * Heuristic::POWER.light_weight(&s, bsdf(s.direction));
    let w = Frame::new(n).to_world(CosineHemisphere.sample(u[1])); // and one along w up to the distance of the hit
    by_light + bsdf(w) * Heuristic::POWER.bsdf_weight(bsdf(w), &light.hit(w))
}
/// The irradiance from a light, over all lanes.
fn irradiance<R: Real>(light: &impl LightSampler<R>) -> f64 {
    let (sobol, mut sum) = (OwenSobol::new(1), Welford::default());
    for k in 0..SAMPLES / R::LANES as u32 {
        let index = R::Uint::from_fn(|lane| k * R::LANES as u32 + lane as u32);
        let u = [0, 1].map(|dimension| sobol.pair(R::Uint::splat(0), index, dimension));
        sum.push(reflected(light, Vec3::lit(N), u));
    }
    (0..R::LANES).map(|lane| sum.mean().lane_f64(lane)).sum::<f64>() / R::LANES as f64 * PI
}
/// The irradiance from each light, by numbers or packets of numbers `R`.
fn estimates<R: Real>() -> [f64; 8] {
    let (p, n, v) = (Vec3::<R>::lit(P), Vec3::lit(N), Vec3::<R>::lit);
    let (h, a, r) = DISK;
    let center = add(add(P, N, h), [1.0, 0.0, 0.0], a);
    let [corner, s, diagonal, t] = PATCH.map(v);
    [
        irradiance(&Sphere::new(v(SPHERE.0), R::lit(SPHERE.1)).by_projected_solid_angle(p, n)),
        irradiance(&Triangle::new(v(TRIANGLE[0]), v(TRIANGLE[1]), v(TRIANGLE[2])).by_projected_solid_angle(p, n)),
        irradiance(
            &Parallelogram::new(v(PARALLELOGRAM[0]), v(PARALLELOGRAM[1]), v(PARALLELOGRAM[2])).by_solid_angle(p),
        ),
        irradiance(&Rectangle::new(v(RECTANGLE[0]), v(RECTANGLE[1]), v(RECTANGLE[2])).by_solid_angle(p)),
        irradiance(&Disk::new(v(center), -n, R::lit(r)).by_solid_angle(p)),
        irradiance(&Polygon::new(CORNERS.map(v)).by_solid_angle(p)),
        irradiance(&BilinearPatch::new(corner, s, t, diagonal).by_area(p)),
        irradiance(&Sun::new(v(SUN.0), R::lit(SUN.1)).by_solid_angle()),
    ]
}

fn main() -> ExitCode {
    let names = ["sphere", "triangle", "parallelogram", "rectangle", "disk", "polygon", "patch", "sun"];
    let (exact, scalar, packets) = (exact(), estimates::<f32>(), estimates::<f32x8>());
    let (mut worst, mut right) = (0.0_f64, true);
    println!("{:14} {:>10} {:>12} {:>12}", "light", "irradiance", "error, f32", "f32x8");
    for (k, name) in names.iter().enumerate() {
        let [one, eight] = [scalar, packets].map(|found| (found[k] / exact[k] - 1.0).abs());
        println!("{name:14} {:10.6} {one:12.1e} {eight:12.1e}", exact[k]);
        worst = worst.max(one).max(eight);
        // which a number that is none is not
        right &= one < MOST && eight < MOST;
    }
    println!("the largest error is {worst:.1e}, and {MOST:e} is allowed");
    if right { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
