//! The oracles against each other: closed forms, quadrature, special values.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};
use etendue_judge::generators::Random;
use etendue_oracle::curves::{Arc, Ellipse};
use etendue_oracle::flat::Fan;
use etendue_oracle::*;

#[test]
fn octant_and_facing_disk() {
    let octant = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(dd);
    assert!((triangle_solid_angle(octant) - FRAC_PI_2).abs() < 1e-15);
    // the projected solid angle of a facing disk on the axis is that of its cone
    let (r, h) = (0.7, 1.3_f64);
    let sigma = (r / h).atan();
    assert!((PI * facing_disk(r, h, 0.0) - projected_cap([0.0, 0.0, 1.0], sigma.sin(), [0.0, 0.0, 1.0])).abs() < 1e-15);
}

#[test]
fn polygon_with_many_sides_is_a_disk() {
    let (r, h, a) = (0.8, 1.1, 0.9);
    let corner = |i: usize| {
        let phi = TAU * i as f64 / 4096.0;
        [a + r * phi.cos(), r * phi.sin(), h]
    };
    let polygon: Vec<_> = (0..4096).map(corner).collect();
    let facing = projected_polygon(&polygon, [0.0, 0.0, 1.0]) / PI;
    assert!((facing - facing_disk(r, h, a)).abs() < 1e-6, "{facing}");
    let perpendicular = projected_polygon(&polygon, [1.0, 0.0, 0.0]) / PI;
    assert!((perpendicular - perpendicular_disk(r, h, a)).abs() < 1e-6, "{perpendicular}");
}

#[test]
fn projected_disk_has_its_form_factor() {
    for (r, h, a) in [(2.0, 0.3, 2.5), (0.5, 1.0, 0.0), (0.5, 1.0, 0.7), (1e-3, 1.0, 3.0), (30.0, 1.0, 31.0)] {
        let of = |n: V3| curves::projected_disk([a, 0.0, h], [0.0, 0.0, -1.0], r, n) / PI;
        let close =
            |found: f64, truth: f64| assert!((found / truth - 1.0).abs() < 1e-7, "{r} {h} {a}: {found}, {truth}");
        close(of([0.0, 0.0, 1.0]), facing_disk(r, h, a));
        if r <= a {
            close(of([1.0, 0.0, 0.0]), perpendicular_disk(r, h, a));
        }
    }
}

#[test]
fn clipped_polygon_is_its_integral() {
    let mut random = Random::new(5);
    for _ in 0..20 {
        let (p, u, v) = (random.direction(), random.direction(), random.direction());
        let p = p.map(|x| 2.0 * x);
        let n = random.direction();
        let corners = [p, along(p, u, 1.0), along(along(p, u, 1.0), v, 1.0), along(p, v, 1.0)];
        let normal = cross(u, v);
        let mut f = |s: f64, t: f64| {
            let x = along(along(p, u, s), v, t);
            let d = length(x);
            dot(x, n).max(0.0) * dot(x, normal).abs() / d.powi(4)
        };
        let integral = integrate(&mut f, [0.0; 2], [1.0; 2], 1e-7);
        let closed = projected_polygon(&corners, n);
        assert!((integral - closed).abs() < 1e-5 * (1.0 + closed), "{integral} {closed}");
    }
}

#[test]
fn tiny_solid_angles() {
    // a facing right triangle at distance 1: its solid angle tends to its area
    let v = [0.0, 0.0, 1.0];
    for size in [1e-3, 1e-6, 1e-9] {
        let omega = triangle_solid_angle([dd(v), exact_sum(v, &[[size, 0.0, 0.0]]), exact_sum(v, &[[0.0, size, 0.0]])]);
        assert!((omega / (0.5 * size * size) - 1.0).abs() < size * size + 1e-13, "{size}: {omega}");
        let (h, _) = cap([0.0, 0.6, 0.8], size);
        assert!((h / (0.5 * size * size) - 1.0).abs() < size * size + 1e-12);
    }
}

/// The projected solid angle of a cap, integrated over rings about its axis; from the half-angle σ and the cosine between axis and normal.
fn projected_cap_by_rings(sigma: f64, cos: f64) -> f64 {
    let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
    if cos >= sigma.sin() {
        return PI * sigma.sin().powi(2) * cos;
    }
    if -cos >= sigma.sin() {
        return 0.0;
    }
    // the first ring that touches the horizon; beyond it, the part of a ring above the horizon grows as a square root
    let first = cos.abs().asin();
    let inner = if cos > 0.0 { PI * first.sin().powi(2) * cos } else { 0.0 };
    let panels = 8;
    let nodes = gauss_legendre::<16>();
    let mut sum = 0.0;
    for panel in 0..panels {
        for (x, weight) in nodes {
            let v = (f64::from(panel) + x) / f64::from(panels);
            let theta = first + (sigma - first) * v * v;
            let measure = theta.sin() * (sigma - first) * 2.0 * v / f64::from(panels);
            // a point of the ring is above the horizon where cosω cosθ + sinω sinθ cosφ ≥ 0
            let (a, b) = (cos * theta.cos(), sin * theta.sin());
            let root = ((theta - first).sin() * (theta + first).sin()).max(0.0).sqrt();
            let phi = root.atan2(-a);
            sum += weight * measure * 2.0 * (phi * a + b * phi.sin());
        }
    }
    inner + sum
}

/// The solid angle of a disk from the sines and cosines of its half-angles, integrated over arcs across the major axis.
fn disk_by_arcs(sines: [f64; 2], cosines: [f64; 2]) -> f64 {
    let (mut sum, mut last, nodes) = (0.0, FRAC_PI_2, gauss_legendre::<16>());
    for panel in 0..60 {
        let next = if panel == 59 { 0.0 } else { last * 0.6 };
        for (x, weight) in nodes {
            let angle = next + (last - next) * x;
            let d = (cosines[1] * angle.cos()).hypot(cosines[0] * angle.sin());
            sum += 4.0 * weight * (last - next) * (sines[0] * angle.sin()).atan2(d) * sines[1] * angle.sin();
        }
        last = next;
    }
    sum
}

#[test]
fn oblique_disks() {
    let mut random = Random::new(9);
    for i in 0..200 {
        let (center, normal, radius) = (random.direction(), random.direction(), 10.0_f64.powi(i % 12 - 6));
        let disk = Ellipse::new(center, normal, radius, |axis| basis(axis).0);
        close(disk.solid_angle(), disk_by_arcs(disk.sines, disk.cosines), 1e-12, &format!("disk of radius {radius:e}"));
    }
}

fn close(a: f64, b: f64, tolerance: f64, what: &str) {
    assert!((a / b - 1.0).abs() <= tolerance, "{what}: {a:e}, expected {b:e}, off by {:.1e}", a / b - 1.0);
}

#[test]
fn triangles_and_their_fans() {
    let octant = Fan::new(dd([1.0, 0.0, 0.0]), dd([-1.0, 1.0, 0.0]), dd([-1.0, 0.0, 1.0]));
    close(octant.solid_angle(), FRAC_PI_2, 1e-15, "octant");
    // facing and small: the area; edge-on: times the sine
    for (size, sine) in [(1e-3, 1.0), (1e-9, 1.0), (1e-6, 1e-7), (1e-9, 1e-7)] {
        let level = f64::sqrt((1.0 - sine) * (1.0 + sine));
        let fan = Fan::new(dd([level, 0.0, sine]), dd([size, 0.0, 0.0]), dd([0.0, size, 0.0]));
        close(fan.solid_angle(), 0.5 * size * size * sine, 3.0 * size + 1e-13, "small triangle");
    }
    // the mapped point cuts off u₀ of the area
    let mut random = Random::new(1);
    for i in 0..200 {
        let (v, a, b) = (random.direction(), random.direction(), random.direction());
        let (size, thin) = (10.0_f64.powi(-(i % 9)), 10.0_f64.powi(-(i % 5)));
        let fan = Fan::new(dd(v), dd(a.map(|x| x * size)), dd(b.map(|x| x * size * thin)));
        if fan.solid_angle() > 1e-25 {
            let u0 = random.unit_f64();
            close(fan.area_swept(u0), u0 * fan.solid_angle(), 1e-9, "area swept");
        }
    }
}

#[test]
fn caps_and_lunes() {
    for sigma in [1e-9_f64, 1e-4, 0.3, 1.2, 1.570] {
        let expected = 2.0 * (0.5 * sigma).sin().powi(2);
        close(cap([0.0, 0.0, 1.0], sigma.sin()).0, expected, 1e-9 + 1e-15 / sigma.cos().powi(2), "cap");
        for y in [-0.999_999_9, -0.99, -0.5, 0.0, 0.7, 0.999, 1.0, 3.0] {
            let height = f64::from((y * sigma.sin()) as f32);
            if height >= 1.0 {
                continue;
            }
            // (3, 4, 0)/5 times a power of two is a normal whose length is 1 to 106 bits
            let level = ((1.0 - height) * (1.0 + height)).sqrt();
            let closed = projected_cap([level, 0.0, height], sigma.sin(), [0.0, 0.0, 1.0]);
            // the centre is rounded to 1e−16 relative to the distance to the tangent plane
            let room = 1e-9 + 1e-15 / (sigma.sin() - height.abs()).abs();
            let rings = projected_cap_by_rings(sigma, height);
            if rings > 0.0 && room < 1e-3 {
                close(closed, rings, 3.0 * room, &format!("projected cap of {sigma:e} at {y}"));
            }
        }
    }
}

#[test]
fn polygons_on_the_disk() {
    // an eighth of the sphere, projected to the floor, is a quarter of the unit disk
    let octant = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(dd);
    close(lambert(&octant, dd([0.0, 0.0, 1.0])), FRAC_PI_4, 1e-15, "octant");
    // half of a facing square, cut off by the horizon
    let square = [[1.0, 1.0, 1.0], [-1.0, 1.0, 1.0], [-1.0, -1.0, 1.0], [1.0, -1.0, 1.0]].map(dd);
    let up = dd([1.0, 0.0, 0.0]);
    let above = above_horizon(&square, up);
    // a perpendicular receiver: ½(atan(1/z) − z/√(1+z²) atan(1/√(1+z²))), z = 1, twice for both halves
    let root = 2.0_f64.sqrt();
    close(lambert(&above, up), FRAC_PI_4 - (1.0 / root) * (1.0 / root).atan(), 1e-14, "half a square");
    // tiny: area times cosine
    for size in [1e-3, 1e-9] {
        let corner = |x: f64, y: f64| dd([x * size, y * size, 1.0]);
        let tiny = [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
        close(lambert(&tiny, dd([0.6, 0.0, 0.8])), 0.8 * size * size, 3.0 * size + 1e-12, "tiny square");
    }
}

#[test]
fn disks_and_lines() {
    for k in [1e-6, 0.3, 1.0, 40.0, 1e5_f64] {
        let disk = Ellipse::new([0.0, 0.0, 1.0], [0.0, 0.0, -3.0], k, |axis| basis(axis).0);
        let c = 1.0 / k.hypot(1.0);
        close(disk.solid_angle(), TAU * k * k * c * c / (1.0 + c), 1e-13, "facing disk");
    }
    let line = |a: V3, e: V3, n: V3| Arc::new(dd(a), dd(e), Some(dd(n)));
    // through the zenith at height 1: ∫cos²x dx from −π/4 to π/4
    let arc = line([-1.0, 0.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
    close(arc.angle, FRAC_PI_2, 1e-15, "angle");
    close(arc.whole, FRAC_PI_4 + 0.5, 1e-14, "irradiance");
    close(arc.angle_of(0.5), FRAC_PI_4, 1e-14, "half of it");
    // rising vertically from far below the horizon to above it: ∫ sinx cosx dx from 0 to π/4
    let arc = line([1.0, 0.0, -5.0], [0.0, 0.0, 6.0], [0.0, 0.0, 1.0]);
    close(arc.whole, 0.25, 1e-14, "upright");
}
