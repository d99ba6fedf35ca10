//! Direct light of a triangle and a sphere by multiple importance sampling: one body for every light, measure and vector width.
//!
//! `cargo run --release -p etendue --example mis`

use etendue::estimate::{Heuristic, Welford};
use etendue::sequence::{OwenSobol, Sequence};
use etendue::warp::CosineHemisphere;
use etendue::{Frame, LightSampler, Real, Sphere, Triangle, Uint, Vec2, Vec3, Warp, f32x8};

/// Radiance reflected by a white diffuse surface with the normal `n`, by one sample of the light and one of the surface.
fn reflected<R: Real>(light: &impl LightSampler<R>, n: Vec3<R>, u: [Vec2<R>; 2]) -> R {
    let bsdf = |w: Vec3<R>| w.dot(n).greater(R::lit(0.0)) * R::lit(std::f64::consts::FRAC_1_PI); // times the cosine, and its own pdf
    let s = light.sample(u[0]); // a renderer traces a shadow ray here, along s.direction up to s.distance
    let by_light = bsdf(s.direction) * Heuristic::POWER.light_weight(&s, bsdf(s.direction));
    let w = Frame::new(n).to_world(CosineHemisphere.sample(u[1])); // and one along w up to the distance of the hit
    by_light + bsdf(w) * Heuristic::POWER.bsdf_weight(bsdf(w), &light.hit(w))
}

fn mean<R: Real>(light: &impl LightSampler<R>, n: Vec3<R>, samples: u32) -> f64 {
    let (sobol, mut sum) = (OwenSobol::new(1), Welford::default());
    for k in 0..samples / R::LANES as u32 {
        let index = R::Uint::from_fn(|lane| k * R::LANES as u32 + lane as u32);
        let u = [0, 1].map(|dimension| sobol.pair(R::Uint::splat(0), index, dimension));
        sum.push(reflected(light, n, u));
    }
    (0..R::LANES).map(|lane| sum.mean().lane_f64(lane)).sum::<f64>() / R::LANES as f64
}

fn both<R: Real>() -> [f64; 2] {
    let (p, n) = (Vec3::<R>::lit([0.2, 0.0, 0.1]), Vec3::lit([0.0, 1.0, 0.0]));
    let triangle = Triangle::new(Vec3::lit([0.0, 1.0, 0.0]), Vec3::lit([1.0, 1.0, 0.0]), Vec3::lit([0.0, 1.0, 1.0]));
    let sphere = Sphere::new(Vec3::lit([-1.0, 1.5, 0.0]), R::lit(0.5));
    [mean(&triangle.by_solid_angle(p), n, 1 << 14), mean(&sphere.by_projected_solid_angle(p, n), n, 1 << 14)]
}

fn main() {
    println!("triangle, sphere: f32 {:.6?}, f32x8 {:.6?}", both::<f32>(), both::<f32x8>());
}
