//! The choice of lamps at points without a normal.

use etendue::lights::{Mixture, Source};
use etendue::select::LightBound;
use etendue::{LightSampler, Sphere, Triangle, Vec2, Vec3};
use etendue_judge::generators::Random;

type V = Vec3<f32>;

/// In fog, where there is no normal, a thousand lamps are chosen nearly by the light that arrives from each: the relative variance of the choice
/// alone, Σc²/pmf over (Σc)², less 1, for solid angles c.
#[test]
fn lamps_in_fog_are_chosen_by_what_arrives() {
    let mut random = Random::new(12);
    let mut vector = |size: f32| V::new(random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5) * size;
    let points: Vec<V> = (0..50).map(|_| vector(36.0)).collect();
    let all: Vec<_> = (0..1000).map(|_| [vector(40.0), vector(1.0), vector(1.0)]).collect();
    let sphere = |i: usize| Sphere::new(all[i][0], 0.05 + 0.3 * (all[i][1].x + 0.5));
    let triangle = |i: usize| Triangle { v0: all[i][0], e1: all[i][1], e2: all[i][2] };
    let variance = |bounds: Vec<LightBound>, seen: &dyn Fn(usize, V) -> f64| {
        let count = bounds.len();
        let mixture = Mixture::new(bounds, (0..count).map(|_| Source::Lamp), &()).unwrap();
        let of = |&p: &V| {
            let at = mixture.at(p, V::ZERO, None, || 0.0);
            let parts = (0..count).map(|i| (seen(i, p), f64::from(at.pmf(i as u32))));
            let [sum, squares] = parts.fold([0.0; 2], |[sum, squares], (c, pmf)| {
                assert!(c == 0.0 || pmf > 0.0);
                [sum + c, squares + if c > 0.0 { c * c / pmf } else { 0.0 }]
            });
            squares / (sum * sum) - 1.0
        };
        points.iter().map(of).sum::<f64>() / 50.0
    };
    let spheres = variance((0..1000).map(|i| sphere(i).bound(1.0)).collect(), &|i, p| {
        let at = sphere(i).by_solid_angle(p);
        f64::from(at.solid_angle())
    });
    let triangles = variance((0..1000).map(|i| triangle(i).bound(1.0)).collect(), &|i, p| {
        let at = triangle(i).by_solid_angle(p);
        if at.sample(Vec2::lit([0.5, 0.5])).valid() { f64::from(at.solid_angle()) } else { 0.0 }
    });
    println!("relative variance of the choice in fog: {spheres:.3} for 1,000 spheres, {triangles:.3} for triangles");
    assert!(spheres < 0.25 && triangles < 0.42, "{spheres} {triangles}");
}
