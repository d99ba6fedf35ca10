//! The light that rough surfaces reflect.

use super::Input;
use core::f32::consts::PI;
use etendue::light::Polygon;
use etendue::reflection::Reflection;
use etendue::{LightSampler, Parallelogram, Sphere, Triangle, Vec2, Vec3, Warp, f32x8};

fn in_square(u: Vec2<f32>) -> bool {
    (0.0..1.0).contains(&u.x) && (0.0..1.0).contains(&u.y)
}

/// Whatever the light, results are finite, and a sample has the pdf of its direction.
fn closed(sampler: &impl LightSampler<f32>, u: Vec2<f32>, w: Vec3<f32>) {
    let drawn = sampler.sample(u);
    assert!(drawn.pdf.is_finite() && drawn.pdf >= 0.0, "pdf {}", drawn.pdf);
    assert_eq!(drawn.pdf, sampler.pdf(drawn.direction));
    assert!(!drawn.valid() || (drawn.direction.length() - 1.0).abs() < 1e-5, "{:?}", drawn.direction);
    for w in [w, drawn.direction] {
        let hit = sampler.hit(w);
        assert!(hit.pdf.is_finite() && hit.pdf >= 0.0 && hit.distance >= 0.0, "{hit:?}");
        assert!(in_square(sampler.invert(w)));
    }
}

/// Surfaces of any roughness, seen from anywhere, and lights of any size and place.
pub(super) fn reflection(input: &mut Input<'_>) {
    let alpha = if input.below(2) == 0 { input.number() } else { input.unit() };
    let normal = Vec3::from(input.direction());
    let view = if input.below(8) == 0 { Vec3::from(input.vector(&[])) } else { Vec3::from(input.direction()) };
    let lobe = Reflection::new(alpha, normal, view);
    assert!((0.0..=1.0).contains(&lobe.albedo()) && (0.0..=1.0).contains(&lobe.schlick()), "{lobe:?}");
    let u = Vec2::new(input.square()[0], input.square()[1]);
    let w = Vec3::from(input.direction());
    for w in [w, lobe.sample(u), normal, -normal] {
        let pdf = lobe.pdf(w);
        assert!(pdf.is_finite() && pdf >= 0.0, "pdf {pdf} in {w:?}");
        assert!(in_square(lobe.invert(w)));
    }
    let p = Vec3::from(input.vector(&[]));
    let [a, b, c] = [(); 3].map(|()| Vec3::from(input.vector(&[])));
    let radius = input.number();
    let ball = lobe.sphere(a - p, radius);
    assert!((0.0..=PI).contains(&ball), "{ball}");
    // the bits of a packet are those of its lanes
    assert_eq!(Reflection::<f32x8>::splat(lobe).sphere(Vec3::splat(a - p), f32x8::splat(radius)).as_array()[3], ball);
    let parallelogram = Parallelogram::new(a, b, c).by_reflection(p, &lobe);
    closed(&parallelogram, u, w);
    closed(&Triangle { v0: a, e1: b, e2: c }.by_reflection(p, &lobe), u, w);
    closed(&Polygon::new([a, b, c, a + c]).by_reflection(p, &lobe), u, w);
    closed(&Sphere::new(a, radius).by_reflection(p, &lobe), u, w);
}
