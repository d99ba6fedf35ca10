//! Estimators against closed forms: the mean of cosθ/pdf over a fine grid of `u` is the light's projected solid angle.

use core::f64::consts::PI;
use etendue::{LightSampler, Mask, Parallelogram, Real, Sphere, Triangle, Vec2, Vec3, f32x8};
use etendue_judge::generators::Random;
use etendue_judge::packets::Coordinates;
use etendue_judge::tolerances::{GRID, GRID_AREA};
use etendue_oracle::tier::cases;
use etendue_oracle::{V3, along, cross, dot, length, projected_cap, projected_polygon, sub, unit, wide};

/// Mean over the midpoints of a 1024 × 1024 grid: accurate to 1/12n² where the integrand is smooth, to n^(−3/2) across kinks.
fn mean(n: V3, sampler: &dyn LightSampler<f32x8>) -> f64 {
    const N: usize = 1024;
    let mut sum = 0.0;
    for i in 0..N {
        let x = f32x8::splat((i as f32 + 0.5) / N as f32);
        for j in (0..N).step_by(8) {
            let y = f32x8::from_fn(|k| ((j + k) as f32 + 0.5) / N as f32);
            let light = sampler.sample(Vec2::new(x, y));
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
        close(&name("by solid angle"), mean(n, &light.by_solid_angle(packet(p))), truth, scale, GRID);
        // the grid must resolve the visible part, and the peak of 1/d² on a sphere that nearly touches the point
        if (0.01..0.95).contains(&ratio) {
            close(&name("by area"), mean(n, &light.by_area(packet(p))), truth, scale, GRID_AREA);
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
        close(&name("triangle by area"), mean(n, &light.by_area(origin)), truth, scale, GRID_AREA);
        close(&name("triangle by solid angle"), mean(n, &light.by_solid_angle(origin)), truth, scale, GRID);

        let corners = [a, along(a, b, 1.0), along(along(a, b, 1.0), c, 1.0), along(a, c, 1.0)];
        let light = Parallelogram { corner: packet(p), edge_s: packet(u), edge_t: packet(v) };
        let truth = projected_polygon(&corners, n);
        close(&name("parallelogram by area"), mean(n, &light.by_area(origin)), truth, scale, GRID_AREA);
        close(&name("parallelogram by solid angle"), mean(n, &light.by_solid_angle(origin)), truth, scale, GRID);

        // nothing is emitted backwards
        let back = Triangle { v0: packet(p), e1: packet(v), e2: packet(u) };
        assert_eq!(mean(n, &back.by_solid_angle(origin)) + mean(n, &back.by_area(origin)), 0.0);
    }
}
