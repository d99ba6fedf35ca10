//! What a host gets wrong at first, as the documentation of `LightSampler` says it.

use etendue::{Disk, LightSampler, Parallelogram, Polygon, Rectangle, Sphere, Triangle, Vec2, Vec3};
use etendue_judge::generators::Random;
use etendue_judge::packets::Coordinates;
use etendue_oracle::{length, sub, unit};

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

#[test]
fn a_light_seen_from_behind_has_a_pdf_but_no_weight() {
    let above = v(0.2, 2.0, 0.1);
    let turned = Triangle::new(v(0.0, 1.0, 0.0), v(0.0, 1.0, 1.0), v(1.0, 1.0, 0.0));
    let (corner, edges) = (v(0.0, 1.0, 0.0), [v(1.0, 0.0, 0.0), v(0.0, 0.0, 1.0)]);
    let panel = Parallelogram::new(corner, edges[0], edges[1]);
    let square = Rectangle::new(corner, edges[0], edges[1]);
    let polygon = Polygon::new([corner, corner + edges[0], corner + edges[0] + edges[1], corner + edges[1]]);
    let disk = Disk::new(corner, v(0.0, -1.0, 0.0), 0.5);
    let n = v(0.0, -1.0, 0.0);
    let behind: [Box<dyn LightSampler<f32>>; 12] = [
        Box::new(lamp().by_area(above)),
        Box::new(lamp().by_solid_angle(above)),
        Box::new(turned.by_area(v(0.2, 0.0, 0.1))),
        Box::new(turned.by_solid_angle(v(0.2, 0.0, 0.1))),
        Box::new(panel.by_area(above)),
        Box::new(square.by_solid_angle(above)),
        Box::new(panel.by_projected_solid_angle(above, n)),
        Box::new(polygon.by_area(above)),
        Box::new(polygon.by_solid_angle(above)),
        Box::new(polygon.by_projected_solid_angle(above, n)),
        Box::new(disk.by_area(above)),
        Box::new(disk.by_solid_angle(above)),
    ];
    for light in behind {
        let s = light.sample(U);
        assert!(s.pdf > 0.0 && !s.emits && s.weight() == 0.0 && !s.valid(), "{s:?}");
        assert_eq!(s.two_sided().weight(), 1.0 / s.pdf);
        let hit = light.hit(s.direction);
        assert!(hit.pdf > 0.0 && !hit.emits, "{hit:?}");
    }
}

/// All samplers of a light with a point on it, by name.
fn on_emitters() -> Vec<(&'static str, bool, Box<dyn LightSampler<f32>>)> {
    let n = v(0.0, 0.8, 0.6);
    let mut all: Vec<(&'static str, bool, Box<dyn LightSampler<f32>>)> = Vec::new();
    let (o, a, b) = (v(0.5, 1.0, 0.25), v(1.0, 0.0, 0.0), v(0.0, 0.0, 1.0));
    for (s, t) in [(0.25, 0.25), (0.0, 0.5), (0.0, 0.0)] {
        let p = o + a * s + b * t;
        all.push(("triangle by area", true, Box::new(Triangle { v0: o, e1: a, e2: b }.by_area(p))));
        all.push(("triangle by solid angle", true, Box::new(Triangle { v0: o, e1: a, e2: b }.by_solid_angle(p))));
        all.push(("triangle", true, Box::new(Triangle { v0: o, e1: a, e2: b }.by_projected_solid_angle(p, n))));
        all.push(("parallelogram by area", true, Box::new(Parallelogram::new(o, a, b).by_area(p))));
        all.push(("parallelogram by solid angle", true, Box::new(Parallelogram::new(o, a, b).by_solid_angle(p))));
        all.push(("parallelogram", true, Box::new(Parallelogram::new(o, a, b).by_projected_solid_angle(p, n))));
        all.push(("rectangle by solid angle", true, Box::new(Rectangle::new(o, a, b).by_solid_angle(p))));
        let corners = [o, o + a, o + a + b, o + b];
        all.push(("polygon by area", true, Box::new(Polygon::new(corners).by_area(p))));
        all.push(("polygon by solid angle", true, Box::new(Polygon::new(corners).by_solid_angle(p))));
        all.push(("polygon", true, Box::new(Polygon::new(corners).by_projected_solid_angle(p, n))));
        let disk = Disk::new(o, v(0.0, -1.0, 0.0), 1.5);
        all.push(("disk by area", true, Box::new(disk.by_area(p))));
        all.push(("disk by solid angle", true, Box::new(disk.by_solid_angle(p))));
    }
    let mut random = Random::new(5);
    for _ in 0..50 {
        let way = V::from(random.direction().map(|x| x as f32));
        let p = o + way * 0.7;
        all.push(("sphere by area", false, Box::new(Sphere::new(o, 0.7).by_area(p))));
        all.push(("sphere by solid angle", false, Box::new(Sphere::new(o, 0.7).by_solid_angle(p))));
        all.push(("sphere", false, Box::new(Sphere::new(o, 0.7).by_projected_solid_angle(p, way))));
        let patch = etendue::BilinearPatch::new(o, a, b, a + b + v(0.1, 0.4, 0.0));
        let on = patch.by_area(V::default()).sample(Vec2::new(random.unit(), random.unit()));
        all.push(("patch", false, Box::new(patch.by_area(on.direction * on.distance))));
    }
    all
}

#[test]
fn from_a_point_on_the_light_all_is_finite_and_flat_lights_have_no_pdf() {
    let mut random = Random::new(6);
    for (name, flat, sampler) in on_emitters() {
        for _ in 0..50 {
            let s = sampler.sample(Vec2::new(random.unit(), random.unit()));
            let w = V::from(random.direction().map(|x| x as f32));
            let hit = sampler.hit(w);
            let numbers =
                [s.pdf, s.weight(), s.distance, hit.pdf, hit.weight(), hit.distance, sampler.pdf(s.direction)];
            assert!(numbers.iter().all(|x| x.is_finite() && *x >= 0.0), "{name}: {s:?}, {hit:?}");
            let u = sampler.invert(s.direction);
            assert!((0.0..1.0).contains(&u.x) && (0.0..1.0).contains(&u.y), "{name}: {u:?}");
            assert!(!flat || s.pdf == 0.0 && hit.pdf == 0.0, "{name}: {s:?}, {hit:?}");
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
