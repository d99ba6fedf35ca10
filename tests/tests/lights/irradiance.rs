//! Estimators against closed forms: the mean of cosθ/pdf over a fine grid of `u` is the light's projected solid angle.

use core::f64::consts::PI;
use etendue::estimate::Welford;
use etendue::{LightSample, LightSampler, Mask, Parallelogram, Real, Sphere, Triangle, Vec2, Vec3, f32x8};
use etendue_judge::generators::Random;
use etendue_judge::properties::Coordinates;
use etendue_judge::stats;
use etendue_judge::tolerances::{GRID, GRID_AREA, ULP};
use etendue_oracle::tier::cases;
use etendue_oracle::{V3, along, cross, dot, length, projected_cap, projected_polygon, sub, unit, wide};

/// Mean over the midpoints of a 1024 × 1024 grid: accurate to 1/12n² where the integrand is smooth, to n^(−3/2) across kinks.
fn mean(n: V3, sample: impl Fn(Vec2<f32x8>) -> LightSample<f32x8>) -> f64 {
    const N: usize = 1024;
    let mut sum = 0.0;
    for i in 0..N {
        let x = f32x8::splat((i as f32 + 0.5) / N as f32);
        for j in (0..N).step_by(8) {
            let y = f32x8::from_fn(|k| ((j + k) as f32 + 0.5) / N as f32);
            let light = sample(Vec2::new(x, y));
            for k in 0..8 {
                let (pdf, cos) = (light.pdf.lane_f64(k), dot(light.direction.at(k), n));
                if light.emits.lane(k) && pdf > 0.0 {
                    sum += cos.max(0.0) / pdf;
                }
            }
        }
    }
    sum / (N * N) as f64
}
fn packet(v: [f32; 3]) -> Vec3<f32x8> {
    v.into()
}
fn close(name: &str, value: f64, truth: f64, scale: f64, tolerance: f64) {
    println!("{name:40} {truth:.6e} off by {:.1e}", (value - truth) / scale);
    assert!((value - truth).abs() <= tolerance * scale, "{name}: {value}, expected {truth}");
}

#[test]
fn spheres() {
    let p = [0.3_f32, -0.2, 0.1];
    for (ratio, omega) in [
        (0.3, 0.0),
        (0.3, 0.9),
        (0.01, 1.2),
        (1e-4, 0.5),
        (0.9, 0.3),
        (0.999, 0.2),
        // cut by the horizon, with the axis above, on and below it; then wholly below
        (0.5, 1.3),
        (0.5, PI / 2.0),
        (0.7, 1.9),
        (0.3, 2.5),
    ] {
        let offset = [2.0_f32, 1.0, -1.5];
        let center: [f32; 3] = core::array::from_fn(|i| p[i] + offset[i]);
        let axis = sub(wide(center), wide(p));
        let radius = (ratio * length(axis)) as f32;
        let sigma = (f64::from(radius) / length(axis)).asin();
        let (s, _) = etendue_oracle::basis(unit(axis));
        let n = along(unit(axis).map(|x| x * f64::cos(omega)), s, f64::sin(omega));
        let truth = projected_cap(axis, f64::from(radius), n);
        // errors are relative to the unclipped projected solid angle, so that a sliver above the horizon may err as much as a whole sphere
        let scale = PI * sigma.sin().powi(2);
        let light = Sphere { center: packet(center), radius: f32x8::splat(radius) };
        let name = |by: &str| format!("sphere {by} {ratio} {omega:.2}");
        close(&name("by solid angle"), mean(n, |u| light.by_solid_angle(packet(p)).sample(u)), truth, scale, GRID);
        // the grid must resolve the visible part, and the peak of 1/d² on a sphere that nearly touches the point
        if (0.01..0.95).contains(&ratio) {
            close(&name("by area"), mean(n, |u| light.by_area(packet(p)).sample(u)), truth, scale, GRID_AREA);
        }
    }
}

#[test]
fn flat_lights() {
    let mut random = Random::new(3);
    for i in (0..12).step_by(cases(5, 1)) {
        let size = [1.0, 0.1, 3.0, 1e-3][i % 4];
        let direction = random.direction();
        let p: [f32; 3] = core::array::from_fn(|k| (direction[k] * 2.0) as f32);
        let (u, v) = (random.direction(), random.direction());
        let (u, v) = (u.map(|x| (x * size) as f32), v.map(|x| (x * size) as f32));
        // any normal, or one tilted from the direction to the light, so that the horizon cuts some lights
        let n = if i % 3 == 0 { random.direction() } else { unit(along(direction, random.direction(), 0.8)) };
        let (a, b, c) = (wide(p), wide(u), wide(v));
        let emits = dot(cross(b, c), a) < 0.0;
        let (u, v, b, c) = if emits { (u, v, b, c) } else { (v, u, c, b) };
        let scale = dot(cross(b, c), unit(a)).abs() / dot(a, a);
        let origin = packet([0.0; 3]);

        let corners = [a, along(a, b, 1.0), along(a, c, 1.0)];
        let light = Triangle { v0: packet(p), e1: packet(u), e2: packet(v) };
        let truth = projected_polygon(&corners, n);
        let name = |shape: &str| format!("{shape} {i} of size {size}");
        close(&name("triangle by area"), mean(n, |u| light.by_area(origin).sample(u)), truth, scale, GRID_AREA);
        close(
            &name("triangle by solid angle"),
            mean(n, |u| light.by_solid_angle(origin).sample(u)),
            truth,
            scale,
            GRID,
        );

        let corners = [a, along(a, b, 1.0), along(along(a, b, 1.0), c, 1.0), along(a, c, 1.0)];
        let light = Parallelogram { corner: packet(p), edge_s: packet(u), edge_t: packet(v) };
        let truth = projected_polygon(&corners, n);
        close(&name("parallelogram by area"), mean(n, |u| light.by_area(origin).sample(u)), truth, scale, GRID_AREA);
        close(
            &name("parallelogram by solid angle"),
            mean(n, |u| light.by_solid_angle(origin).sample(u)),
            truth,
            scale,
            GRID,
        );

        // nothing is emitted backwards
        let back = Triangle { v0: packet(p), e1: packet(v), e2: packet(u) };
        assert_eq!(
            mean(n, |u| back.by_solid_angle(origin).sample(u)) + mean(n, |u| back.by_area(origin).sample(u)),
            0.0
        );
    }
}

/// A sample lies on its shape, and the pdf by area is 1/area, converted to solid angle.
#[test]
fn samples_lie_on_their_shapes() {
    let mut random = Random::new(4);
    for _ in 0..20_000 {
        let mut vector = |size: f64| random.direction().map(|x| (x * size) as f32);
        let (p, v0, e1, e2) = (vector(1.0), vector(3.0), vector(1.0), vector(0.5));
        let u = Vec2::new(random.unit(), random.unit());
        let (a, b, c) = (sub(wide(v0), wide(p)), wide(e1), wide(e2));
        let normal = cross(b, c);
        let of = |v: [f32; 3]| Vec3::<f32>::from(v);
        let check = |light: LightSample<f32>, area: Option<f64>, inside: &dyn Fn(f64, f64) -> bool| {
            let w = light.direction.at(0);
            let point = w.map(|x| x * f64::from(light.distance));
            let slant = dot(w, unit(normal));
            // rounding the coordinates, at most 5, moves the point off the plane; rounding the direction moves it along, far if edge-on
            let off = dot(sub(point, a), unit(normal));
            assert!(off.abs() <= 12.0 * 5.0 * ULP, "off the plane by {off:e}");
            if slant.abs() > 0.05 {
                let inner = sub(point, a);
                let nn = dot(normal, normal);
                let (s, t) = (dot(cross(inner, c), normal) / nn, dot(cross(b, inner), normal) / nn);
                assert!(inside(s, t), "outside: {s} {t}");
                if let Some(area) = area {
                    let d = length(point);
                    let pdf = d * d / (area * slant.abs());
                    // the rounding of a direction over the slant, of which the pdf is a third power, and a dozen more roundings
                    let relative = (f64::from(light.pdf) / pdf - 1.0).abs();
                    assert!(relative <= (12.0 + 24.0 / slant.abs()) * ULP, "area measure off by {relative:e}");
                }
            }
            assert_eq!(light.emits, slant < 0.0, "emits on the wrong side");
        };
        let sine = length(normal) / (length(b) * length(c));
        if sine < 0.05 {
            continue;
        }
        let e = 1e-4;
        let in_triangle = |s: f64, t: f64| s >= -e && t >= -e && s + t <= 1.0 + e;
        let in_square = |s: f64, t: f64| s >= -e && t >= -e && s <= 1.0 + e && t <= 1.0 + e;
        let grazing = (dot(unit(a), unit(normal))).abs() < 1e-3;
        if grazing {
            continue;
        }
        let triangle = Triangle { v0: of(v0), e1: of(e1), e2: of(e2) };
        check(triangle.by_area(of(p)).sample(u), Some(0.5 * length(normal)), &in_triangle);
        check(triangle.by_solid_angle(of(p)).sample(u), None, &in_triangle);
        let panel = Parallelogram { corner: of(v0), edge_s: of(e1), edge_t: of(e2) };
        check(panel.by_area(of(p)).sample(u), Some(length(normal)), &in_square);
        check(panel.by_solid_angle(of(p)).sample(u), None, &in_square);

        let sphere = Sphere { center: of(v0), radius: 0.7_f32 };
        for light in [sphere.by_area(of(p)).sample(u), sphere.by_solid_angle(of(p)).sample(u)] {
            let point = light.direction.at(0).map(|x| x * f64::from(light.distance));
            let off = length(sub(point, a)) / f64::from(sphere.radius) - 1.0;
            // at the limb, the rounding of a direction moves a point 4 units away straight off the surface
            assert!(off.abs() <= 32.0 * ULP, "off the sphere by {off:e}");
        }
    }
}

#[test]
fn welford() {
    let mut random = Random::new(8);
    let samples: Vec<f64> = (0..10_000).map(|_| 1e4 + random.unit_f64()).collect();
    let (mean, variance) = stats::mean_variance(&samples);
    let run = |x: &[f64]| {
        let mut w = Welford::<f64>::default();
        x.iter().for_each(|&x| w.push(x));
        w
    };
    let all = run(&samples);
    // the offset of the samples is 1e4 times their spread; its rounding, 1e4 × 2⁻⁵², accumulates over √n pushes
    let close = |w: Welford<f64>, what: &str| {
        assert!((w.mean() / mean - 1.0).abs() < 1e-14, "{what}: mean {}", w.mean());
        assert!((w.variance() / variance - 1.0).abs() < 1e-10, "{what}: variance {}", w.variance());
    };
    close(all, "in one");
    for cut in [0, 1, 137, 5_000, 9_999, 10_000] {
        let (a, b) = samples.split_at(cut);
        close(run(a).merge(run(b)), "merged");
    }
    assert!(Welford::<f32>::default().variance().is_infinite());
}
