//! Lines, and lights without a surface: means against closed forms, and points on the line.

use core::f64::consts::PI;
use etendue::{
    ConstantEnvironment, DirectionalLight, LightSample, LightSampler, Line, PointLight, SpotLight, Sun, Vec2, Vec3,
};
use etendue_judge::generators::Random;
use etendue_judge::packets::Coordinates;
use etendue_oracle::{V3, along, basis, cross, dot, gauss_legendre, length, narrow, sub, unit};

/// Irradiance of one sample, where the radiance is 1 on the emitting side.
fn irradiance(s: &LightSample<f64>, n: V3) -> f64 {
    let cos = dot(s.direction.at(0), n).max(0.0);
    if s.pdf > 0.0 && s.emits { cos / s.pdf } else { 0.0 }
}
/// Mean irradiance of samples from an n × n grid of `u`.
fn flux(n: usize, sampler: &dyn LightSampler<f64>, normal: V3) -> f64 {
    let at = |i: usize| (i as f64 + 0.5) / n as f64;
    let of = |i: usize| irradiance(&sampler.sample(Vec2::new(at(i % n), at(i / n))), normal);
    (0..n * n).map(of).sum::<f64>() / (n * n) as f64
}
fn origin() -> Vec3<f64> {
    Vec3::new(0.0, 0.0, 0.0)
}

/// Irradiance of a line of unit radiance and width: by Gauss and Legendre along it, clipped to the horizon.
fn line_irradiance(a: V3, edge: V3, n: V3) -> f64 {
    let (low, high) = (dot(a, n), dot(a, n) + dot(edge, n));
    let crossing = (low / (low - high)).clamp(0.0, 1.0);
    let (first, last) = (if low < 0.0 { crossing } else { 0.0 }, if high < 0.0 { crossing } else { 1.0 });
    let panels = 200;
    let mut sum = 0.0;
    for panel in 0..panels {
        for (x, weight) in gauss_legendre::<8>() {
            let t = first + (last - first) * (f64::from(panel) + x) / f64::from(panels);
            let point = along(a, edge, t);
            let r = length(point);
            sum += weight * length(cross(point, edge)) * dot(point, n).max(0.0) / (r * r * r * r);
        }
    }
    if low < 0.0 && high < 0.0 { 0.0 } else { sum * (last - first) / f64::from(panels) }
}

#[test]
fn lines_have_their_irradiance() {
    let mut random = Random::new(6);
    for i in 0..30 {
        let size = [1.0, 0.01, 20.0][i % 3];
        let (p, e, n) = (random.direction(), random.direction().map(|x| x * size), random.direction());
        let (line, truth) = (Line { start: p.into(), edge: e.into() }, line_irradiance(p, e, n));
        let total = line_irradiance(p, e, unit(p)) + truth;
        let sample = |sampler: &dyn LightSampler<f64>, u: f64| {
            let s = sampler.sample(Vec2::new(u, 0.0));
            let w = s.direction.at(0);
            let off = length(cross(sub(w.map(|w| w * s.distance), p), unit(e)));
            let sine = length(cross(w, unit(e)));
            assert!(s.pdf == 0.0 || off < 1e-11 * s.distance / sine, "{i}: off the line by {off}");
            s
        };
        let (by_length, by_angle) = (line.by_length(origin()), line.by_angle(origin()));
        for (sampler, slack) in [(&by_length as &dyn LightSampler<f64>, 1e-4), (&by_angle, 1e-6)] {
            let steps = 20_000;
            let values = (0..steps).map(|k| irradiance(&sample(sampler, (f64::from(k) + 0.5) / f64::from(steps)), n));
            let mean = values.sum::<f64>() / f64::from(steps);
            assert!((mean - truth).abs() < slack * total, "{i}: {mean} for {truth}, {slack}");
        }
        let projected = line.by_projected_solid_angle(origin(), n.into());
        for k in 0..100 {
            let u = (f64::from(k) + random.unit_f64()) / 100.0;
            let s = sample(&projected, u);
            // at the ends of the range the cosine is a small difference
            let slack = 1e-12 / dot(s.direction.at(0), n).abs().max(1e-9);
            let e = irradiance(&s, n);
            assert!((e - truth).abs() <= (1e-9 + slack) * truth, "projected {i}: {e} for {truth} at {u}");
        }
    }
}

#[test]
fn sun_and_sky() {
    let h = 0.1;
    let sun = Sun { direction: [0.6, 0.0, 0.8].into(), one_minus_cos: h };
    let e = flux(300, &sun.by_solid_angle(), [0.0, 0.0, 1.0]);
    // π sin²σ cosω
    let truth = PI * h * (2.0 - h) * 0.8;
    assert!((e / truth - 1.0).abs() < 1e-9, "{e} for {truth}");
    for i in 0..100 {
        let u = Vec2::new(f64::from(i) / 100.0, 0.3);
        let s = sun.by_solid_angle().sample(u);
        let again = sun.by_solid_angle().invert(s.direction);
        assert!((again.x - u.x).abs() < 1e-13 && (again.y - u.y).abs() < 1e-13 || i == 0);
        assert_eq!(sun.by_solid_angle().pdf(s.direction), s.pdf);
        assert_eq!(sun.by_solid_angle().pdf(-s.direction), 0.0);
    }
    let n = unit([0.3, -0.5, 0.2]);
    let uniform = flux(400, &ConstantEnvironment.by_solid_angle(), n);
    assert!((uniform / PI - 1.0).abs() < 1e-4, "{uniform}");
    // the first would lie on the horizon
    for i in 1..1000 {
        let u = Vec2::new((f64::from(i) * 0.618_033_988_7).fract(), (f64::from(i) * 0.754_877_666_2).fract());
        let e = irradiance(&ConstantEnvironment.by_projected_solid_angle(n.into()).sample(u), n);
        assert!((e / PI - 1.0).abs() < 1e-12, "{e}");
    }
}

#[test]
fn delta_lights() {
    let point = PointLight { position: [0.0, 3.0, 4.0].into() };
    let s = point.by_delta(origin()).sample(Vec2::default());
    assert!(s.delta && s.emits && s.distance == 5.0 && (s.pdf - 25.0).abs() < 1e-13);
    assert_eq!(point.by_delta(point.position).sample(Vec2::default()).pdf, 0.0);
    let (one_minus_cos_inner, one_minus_cos_outer) = (0.1, 0.3);
    let axis = [0.0, -0.6, -0.8];
    let spot = SpotLight { position: point.position, axis: axis.into(), one_minus_cos_inner, one_minus_cos_outer };
    assert!((spot.by_delta(origin()).sample(Vec2::default()).pdf - 25.0).abs() < 1e-12);
    let (side, _) = basis(axis);
    let at = |cos: f64| {
        let w: V3 = core::array::from_fn(|k| axis[k] * cos + side[k] * (1.0 - cos * cos).sqrt());
        spot.by_delta(core::array::from_fn::<_, 3, _>(|k| [0.0, 3.0, 4.0][k] + 2.0 * w[k]).into())
            .sample(Vec2::default())
    };
    assert!((at(0.95).pdf - 4.0).abs() < 1e-12 && (at(0.8).pdf - 8.0).abs() < 1e-9);
    assert!(at(0.69).pdf == 0.0 && !at(0.69).emits && !at(-0.95).emits);
    let s = DirectionalLight { direction: Vec3::<f64>::new(0.0, 0.0, 1.0) }.by_delta().sample(Vec2::default());
    assert!(s.delta && s.emits && s.pdf == 1.0 && s.distance.is_finite());
}

/// Cones of any angle end where they should, to the rounding of a direction: 1e−7 rad beside the angle of the narrowest.
#[test]
fn narrow_cones_are_as_narrow_as_they_are() {
    let mut random = Random::new(31);
    for degrees in [1e-3_f64, 1e-2, 0.1, 0.5, 5.0, 60.0, 150.0] {
        let outer = degrees.to_radians();
        for _ in 0..200 {
            let axis = random.direction();
            let (side, _) = basis(axis);
            let position: [f32; 3] = narrow(random.direction());
            let one_minus_cos = |angle: f64| (2.0 * (0.5 * angle).sin().powi(2)) as f32;
            for inner in [0.0, 0.5, 1.0] {
                let spot = SpotLight {
                    position: position.into(),
                    axis: narrow(axis).into(),
                    one_minus_cos_inner: one_minus_cos(inner * outer),
                    one_minus_cos_outer: one_minus_cos(outer),
                };
                let falloff = |angle: f64| {
                    let w = along(axis.map(|x| x * angle.cos()), side, angle.sin());
                    f64::from(spot.falloff(narrow(w).into()))
                };
                let rounding = 2e-7 / outer + 1e-6;
                assert!(falloff(outer * (1.0 + rounding)) == 0.0, "{degrees}");
                assert!(falloff(inner * outer * (1.0 - rounding)) == 1.0 || inner == 0.0, "{degrees}");
                let at = random.range(0.0, 1.0);
                let t = |inner: f64| {
                    let cosine = |part: f64| 2.0 * (0.5 * part * outer).sin().powi(2);
                    ((cosine(1.0) - cosine(at)) / (cosine(1.0) - cosine(inner))).clamp(0.0, 1.0)
                };
                let truth = t(inner) * t(inner) * (3.0 - 2.0 * t(inner));
                let found = falloff(at * outer);
                assert!(inner == 1.0 || (found - truth).abs() < 12.0 * rounding, "{degrees}: {found} for {truth}");
            }
        }
    }
}
