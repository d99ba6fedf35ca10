//! What a host gets wrong at first, as the documentation of `LightSampler` says it.

use etendue::{LightSampler, Sphere, Triangle, Vec2, Vec3};
use etendue_judge::area_lights::{AreaLight, LightShape, Measure};
use etendue_judge::fixture::Fixture;
use etendue_judge::generators::Random;
use etendue_judge::packets::Coordinates;
use etendue_oracle::{length, narrow, sub, unit};

type V = Vec3<f32>;

fn v(x: f32, y: f32, z: f32) -> V {
    Vec3::new(x, y, z)
}
/// A lamp overhead, which emits downwards.
fn lamp() -> Triangle<f32> {
    Triangle::new(v(0.0, 1.0, 0.0), v(1.0, 1.0, 0.0), v(0.0, 1.0, 1.0))
}
const U: Vec2<f32> = Vec2 { x: 0.3, y: 0.6 };

#[test]
fn the_length_of_a_normal_multiplies_the_pdf() {
    let p = v(0.2, 0.0, 0.1);
    let n = v(0.0, 0.6, 0.8);
    let (one, two) = (lamp().by_projected_solid_angle(p, n), lamp().by_projected_solid_angle(p, n * 2.0));
    let (a, b) = (one.sample(U), two.sample(U));
    assert_eq!(a.direction, b.direction);
    assert_eq!((2.0 * a.pdf, 2.0 * one.pdf(a.direction)), (b.pdf, two.pdf(a.direction)));
    assert_eq!(one.projected_solid_angle(), two.projected_solid_angle());
}

#[test]
fn a_normal_that_points_away_leaves_nothing() {
    let (p, up, down) = (v(0.2, 0.0, 0.1), v(0.0, 1.0, 0.0), v(0.0, -1.0, 0.0));
    let none = lamp().by_projected_solid_angle(p, down);
    assert!(none.projected_solid_angle() == 0.0 && none.sample(U).weight() == 0.0);
    assert!(!none.hit(up).valid() && none.pdf(up) == 0.0);
    let bulb = Sphere::new(v(0.0, 0.3, 0.0), 0.5).by_projected_solid_angle(v(0.7, 0.0, 0.0), down);
    let s = bulb.sample(U);
    assert!(s.pdf > 0.0 && s.direction.y < 0.0);
}

/// All flat lights by all techniques: a square, or its half, or a disk, which emits downwards, seen from a point over whose normal `n` it is.
fn flat(p: [f32; 3], n: [f32; 3]) -> impl Iterator<Item = (AreaLight, Box<dyn LightSampler<f32>>)> {
    let is_flat = |kind: &&(LightShape, Measure)| !matches!(kind.0, Sphere | Patch | Line);
    use LightShape::{Disk, Line, Patch, Sphere};
    AreaLight::kinds().iter().filter(is_flat).map(move |&(shape, by)| {
        let (a, b) = ([0.5, 1.0, 0.25], if shape == Disk { [0.0, -1.0, 0.0] } else { [1.0, 0.0, 0.0] });
        let light = AreaLight { p, radius: 1.5, ..AreaLight::seen(shape, by, [a, b, [0.0, 0.0, 1.0]], n) };
        (light, AreaLight::prepare(&[light]))
    })
}

#[test]
fn a_light_seen_from_behind_has_a_pdf_but_no_weight() {
    for (light, sampler) in flat([0.7, 2.0, 0.35], [0.0, -1.0, 0.0]) {
        let s = sampler.sample(U);
        assert!(s.pdf > 0.0 && !s.emits && s.weight() == 0.0 && !s.valid(), "{light:?}: {s:?}");
        assert_eq!(s.two_sided().weight(), 1.0 / s.pdf);
        let hit = sampler.hit(s.direction);
        assert!(hit.pdf > 0.0 && !hit.emits, "{light:?}: {hit:?}");
    }
    for (light, sampler) in flat([0.7, 0.0, 0.35], [0.0, 1.0, 0.0]) {
        assert!(sampler.sample(U).valid(), "{light:?}");
    }
}

#[test]
fn from_a_point_on_the_light_all_is_finite_and_flat_lights_have_no_pdf() {
    let mut random = Random::new(6);
    let mut all: Vec<_> = [[0.75, 1.0, 0.5], [0.5, 1.0, 0.75], [0.5, 1.0, 0.25]]
        .into_iter()
        .flat_map(|p| flat(p, [0.0, 0.8, 0.6]).map(|(light, sampler)| (light, true, sampler)))
        .collect();
    let round = AreaLight::kinds().iter().filter(|kind| matches!(kind.0, LightShape::Sphere | LightShape::Patch));
    for (&(shape, by), _) in round.flat_map(|kind| (0..50).map(move |i| (kind, i))) {
        let way = random.direction().map(|x| x as f32);
        let n = if shape == LightShape::Patch { [1.1, 0.4, 1.0] } else { way };
        let light = AreaLight::seen(shape, by, [[0.5, 1.0, 0.25], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]], n);
        let st = [random.unit_f64(), random.unit_f64()];
        let p = if shape == LightShape::Patch {
            narrow(light.on_patch(st))
        } else {
            (V::from(light.a) + V::from(way) * 0.7).to_array()
        };
        let light = AreaLight { p, radius: 0.7, ..light };
        all.push((light, false, AreaLight::prepare(&[light])));
    }
    for (light, is_flat, sampler) in all {
        for _ in 0..50 {
            let s = sampler.sample(Vec2::new(random.unit(), random.unit()));
            let hit = sampler.hit(V::from(random.direction().map(|x| x as f32)));
            let numbers =
                [s.pdf, s.weight(), s.distance, hit.pdf, hit.weight(), hit.distance, sampler.pdf(s.direction)];
            assert!(numbers.iter().all(|x| x.is_finite() && *x >= 0.0), "{light:?}: {s:?}, {hit:?}");
            let u = sampler.invert(s.direction);
            assert!((0.0..1.0).contains(&u.x) && (0.0..1.0).contains(&u.y), "{light:?}: {u:?}");
            assert!(!is_flat || s.pdf == 0.0 && hit.pdf == 0.0, "{light:?}: {s:?}, {hit:?}");
        }
    }
}

/// A direction that is computed anew from the point of a sample has its pdf to rounding, and none only at the edge.
#[test]
fn directions_from_points_have_the_pdf_to_rounding() {
    let mut random = Random::new(7);
    let (mut other_bits, mut missed, mut checked) = (0, 0, 0);
    for _ in 0..20_000 {
        let p = V::from(random.direction().map(|x| (0.7 * x) as f32));
        let sampler = lamp().by_solid_angle(p);
        let (x, y) = (random.unit(), random.unit());
        let s = sampler.sample(Vec2::new(x, y));
        let point = s.direction.mul_add(s.distance, p);
        let w = V::from(unit(sub(point.at(0), p.at(0))).map(|x| x as f32));
        if s.pdf == 0.0 || s.direction.dot(s.normal).abs() < 0.1 {
            continue;
        }
        checked += 1;
        assert!(length(sub(w.at(0), s.direction.at(0))) < 2e-6, "{w:?} for {s:?}");
        let pdf = sampler.pdf(w);
        other_bits += u32::from(w != s.direction);
        missed += u32::from(pdf == 0.0);
        let inner = (0.01..0.99).contains(&x) && (0.01..0.99).contains(&y);
        assert!(pdf == s.pdf || pdf == 0.0 && !inner, "{pdf} for {s:?}");
        // of lights whose pdf changes with the direction, it changes by as little
        let by_area = lamp().by_area(p);
        let (evaluated, expected) = (by_area.pdf(w), by_area.pdf(s.direction));
        assert!(!inner || (evaluated / expected - 1.0).abs() < 1e-4, "{evaluated} for {expected}");
    }
    println!("{checked} samples: {other_bits} other directions, {missed} of which miss");
    assert!(checked > 10_000 && other_bits > checked / 10 && missed < checked / 1000);
}
