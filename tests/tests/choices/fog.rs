//! The choice of lamps at points without a normal.

use etendue::lights::{Mixture, Source};
use etendue::select::LightBound;
use etendue::sequence::{Independent, Sequence};
use etendue::{LightSampler, Sphere, Triangle, Vec2, Vec3};

type V = Vec3<f32>;

fn numbers(seed: u64, i: u32) -> [f32; 3] {
    let pair = |dimension| -> Vec2<f32> { Independent::new(seed).pair(0, i, dimension) };
    let (a, b) = (pair(0), pair(1));
    [a.x, a.y, b.x]
}

/// In fog, where there is no normal, a thousand lamps are chosen nearly by the light that arrives from each: the relative variance of the choice
/// alone, Σc²/pmf over (Σc)², less 1, for solid angles c.
#[test]
fn lamps_in_fog_are_chosen_by_what_arrives() {
    let place = |i: u32| -> V {
        let [x, y, z] = numbers(12, i);
        V::new(-20.0, -20.0, -20.0) + V::new(x, y, z) * 40.0
    };
    let sphere = |i: u32| Sphere::new(place(i), 0.05 + 0.3 * numbers(13, i)[0]);
    let triangle = |i: u32| {
        let [e, f] = [14, 15].map(|seed| {
            let [x, y, z] = numbers(seed, i);
            V::new(x - 0.5, y - 0.5, z - 0.5)
        });
        Triangle { v0: place(i), e1: e, e2: f }
    };
    let variance = |bounds: Vec<LightBound>, seen: &dyn Fn(usize, V) -> f64| {
        let count = bounds.len();
        let mixture = Mixture::new(bounds, (0..count).map(|_| Source::Lamp), &()).unwrap();
        let of = |point: u32| {
            let p = place(10_000 + point) * 0.9;
            let at = mixture.at(p, V::ZERO, None, || 0.0);
            let parts = (0..count).map(|i| (seen(i, p), f64::from(at.pmf(i as u32))));
            let [sum, squares] = parts.fold([0.0; 2], |[sum, squares], (c, pmf)| {
                assert!(c == 0.0 || pmf > 0.0);
                [sum + c, squares + if c > 0.0 { c * c / pmf } else { 0.0 }]
            });
            squares / (sum * sum) - 1.0
        };
        (0..50).map(of).sum::<f64>() / 50.0
    };
    let spheres = variance((0..1000).map(|i| sphere(i).bound(1.0)).collect(), &|i, p| {
        let at = sphere(i as u32).by_solid_angle(p);
        f64::from(at.solid_angle())
    });
    let triangles = variance((0..1000).map(|i| triangle(i).bound(1.0)).collect(), &|i, p| {
        let at = triangle(i as u32).by_solid_angle(p);
        if at.sample(Vec2::lit([0.5, 0.5])).valid() { f64::from(at.solid_angle()) } else { 0.0 }
    });
    println!("relative variance of the choice in fog: {spheres:.3} for 1,000 spheres, {triangles:.3} for triangles");
    assert!(spheres < 0.25 && triangles < 0.42, "{spheres} {triangles}");
}
