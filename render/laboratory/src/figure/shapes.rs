//! Figures of one light seen from one point.

use super::sheet::Svg;
use super::studio::Finding;
use crate::chart::pictures::heat;
use crate::chart::plot::{Bar, Chart, Dot, Line, Scale, short};
use etendue::spherical::{ProjectedCap, SphericalCap};
use etendue::warp::Warp;
use etendue::{LightSample, LightSampler, Mask, Real, Triangle, Vec2, Vec3, f32x8};

/// The triangle of the scene `triangle-light`, and a point of the ground near its lower edge.
const CORNERS: [[f64; 3]; 3] = [[-2.0, 0.3, -1.5], [2.0, 0.3, -1.5], [0.0, 2.3, -0.5]];
const POINT: [f64; 3] = [0.8, 0.0, -0.9];

/// Mean and variance of cosθ/pdf over a fine grid of `u`.
fn moments(normal: [f32; 3], sample: impl Fn(Vec2<f32x8>) -> LightSample<f32x8>) -> (f64, f64) {
    const N: usize = 1024;
    let (mut sum, mut square) = (0.0, 0.0);
    let up: Vec3<f32x8> = normal.into();
    for i in 0..N {
        let x = f32x8::splat((i as f32 + 0.5) / N as f32);
        for j in (0..N).step_by(8) {
            let y = f32x8::new(std::array::from_fn(|k| ((j + k) as f32 + 0.5) / N as f32));
            let light = sample(Vec2::new(x, y));
            let cos = light.direction.dot(up);
            for k in (0..8).filter(|&k| light.emits.lane(k) && light.pdf.lane(k) > 0.0) {
                let value = f64::from(cos.lane(k)).max(0.0) / f64::from(light.pdf.lane(k));
                sum += value;
                square += value * value;
            }
        }
    }
    let n = (N * N) as f64;
    (sum / n, square / n - (sum / n).powi(2))
}

pub(super) fn area_factors() -> Finding {
    const WIDTH: usize = 240;
    const HEIGHT: usize = 134;
    let [a, b, c] = CORNERS.map(Vec3::<f64>::from);
    let p = Vec3::<f64>::from(POINT);
    let normal = (b - a).cross(c - a).normalize();
    // coordinates in the plane of the triangle: from a to b, and up to c
    let across = (b - a).normalize();
    let upwards = normal.cross(across);
    let (width, height) = ((b - a).length(), (c - a).dot(upwards));
    let apex = (c - a).dot(across);
    let mut factors: [Vec<Option<f64>>; 4] = Default::default();
    for i in 0..WIDTH * HEIGHT {
        let x = (i % WIDTH) as f64 + 0.5;
        let y = HEIGHT as f64 - (i / WIDTH) as f64 - 0.5;
        let (x, y) = (x / WIDTH as f64 * width, y / HEIGHT as f64 * height);
        let share = y / height;
        let inside = x >= share * apex && x <= width + share * (apex - width);
        let d = a + across * x + upwards * y - p;
        let r2 = d.dot(d);
        let (receiver, light) = (d.y / r2.sqrt(), -d.dot(normal) / r2.sqrt());
        let values = [receiver, light, 1.0 / r2, receiver * light / r2];
        for (list, value) in factors.iter_mut().zip(values) {
            list.push(inside.then_some(value));
        }
    }
    let names = ["cosθ at the receiver", "cosθ′ at the light", "1/r²", "cosθ cosθ′/r²"];
    let mut panels = Vec::new();
    let mut ratio = 0.0;
    for (name, values) in names.into_iter().zip(&factors) {
        let most = values.iter().flatten().copied().fold(0.0, f64::max);
        let least = values.iter().flatten().copied().fold(f64::INFINITY, f64::min);
        ratio = most / least;
        let pixels: Vec<_> = values.iter().map(|v| v.map_or([255; 3], |v| heat(v / most))).collect();
        let title = format!("{name}: {} to {}", short(least), short(most));
        panels.push(Svg::image(&title, [WIDTH as u32, HEIGHT as u32], &pixels, 330.0));
    }
    let single = |v: Vec3<f64>| -> Vec3<f32x8> { [v.x as f32, v.y as f32, v.z as f32].into() };
    let light = Triangle { v0: single(a), e1: single(b - a), e2: single(c - a) };
    let from = single(p);
    let up = [0.0, 1.0, 0.0];
    let (mean, by_area) = moments(up, |u| light.by_area(from).sample(u));
    let (same, by_solid_angle) = moments(up, |u| light.by_solid_angle(from).sample(u));
    let relative = |v: f64, m: f64| short(v / (m * m));
    let headline = vec![
        format!("greatest over least value of cosθ cosθ′/r² on the triangle: {}", short(ratio)),
        format!(
            "relative variance of one sample: {} by area, {} by solid angle (lower by a factor of {}), 0 by projected solid angle",
            relative(by_area, mean),
            relative(by_solid_angle, same),
            short(by_area / by_solid_angle)
        ),
    ];
    let mut panels = panels.into_iter();
    let mut two = || Svg::row(panels.by_ref().take(2).collect());
    let svg = Svg::column(vec![two(), two()]);
    let mut lines = vec![format!(
        "The light of triangle-light as seen from the ground at ({}, {}, {}). Black is 0, pale yellow the greatest value of each factor.",
        POINT[0], POINT[1], POINT[2]
    )];
    lines.extend(headline.iter().cloned());
    Finding { svg: svg.captioned(&lines), headline }
}

pub(super) fn cap_solid_angle_vs_projected() -> Finding {
    // half-angle 40° with its axis 65° from the normal, so that the horizon cuts it
    let (omega, sigma) = (65.0_f64.to_radians(), 40.0_f64.to_radians());
    let center = [omega.sin(), omega.cos(), 0.0];
    let vector = |v: [f64; 3]| Vec3::<f32x8>::from(v.map(|x| x as f32));
    let radius = f32x8::splat(sigma.sin() as f32);
    let cap = SphericalCap::new(vector(center), radius);
    let projected = ProjectedCap::new(vector(center), radius, vector([0.0, 1.0, 0.0]));
    let dots = |sample: &dyn Fn(Vec2<f32x8>) -> Vec3<f32x8>, above: bool| -> Vec<Dot> {
        const SIDE: usize = 24;
        let mut dots = Vec::new();
        for i in 0..SIDE {
            for j in (0..SIDE).step_by(8) {
                let y = f32x8::new(std::array::from_fn(|k| ((j + k) as f32 + 0.5) / SIDE as f32));
                let w = sample(Vec2::new(f32x8::splat((i as f32 + 0.5) / SIDE as f32), y));
                for k in (0..8).filter(|&k| (w.y.lane(k) > 0.0) == above) {
                    let (x, y) = (f64::from(w.x.lane(k)), f64::from(w.z.lane(k)));
                    dots.push(Dot { x: Bar::exact(x), y: Bar::exact(y), sure: true });
                }
            }
        }
        dots
    };
    let chart = |title: &str, sample: &dyn Fn(Vec2<f32x8>) -> Vec3<f32x8>| {
        let line = |name: &str, color: usize, dots: Vec<Dot>| Line {
            id: name.to_owned(),
            name: name.to_owned(),
            color,
            dash: 0,
            joined: false,
            shown: true,
            mark: 0.45,
            dots,
        };
        let rim = (0..=200).map(|i| f64::from(i) / 200.0 * std::f64::consts::TAU);
        let rim = rim.map(|t| Dot { x: Bar::exact(t.cos()), y: Bar::exact(t.sin()), sure: true }).collect();
        let horizon = Line { joined: true, mark: 0.0, ..line("horizon", 8, rim) };
        let below = dots(sample, false);
        let mut lines = vec![horizon, line("above the horizon", 0, dots(sample, true))];
        if !below.is_empty() {
            lines.push(line("below the horizon: no contribution", 1, below));
        }
        Chart {
            title: title.to_owned(),
            x_label: "direction, x".to_owned(),
            y_label: "direction, z".to_owned(),
            scales: [Scale::Linear, Scale::Linear],
            lines,
            guides: Vec::new(),
            equal: true,
        }
    };
    let by_solid_angle = chart("uniform by solid angle, seen from above", &|u| cap.sample(u));
    let by_projected = chart("uniform by projected solid angle, seen from above", &|u| projected.sample(u));
    let all = <f32x8 as Real>::Mask::splat(true);
    let sample = |direction: Vec3<f32x8>, pdf: f32x8| LightSample {
        direction,
        distance: f32x8::splat(1.0),
        pdf,
        emits: all,
        ..LightSample::miss(direction)
    };
    let up = [0.0, 1.0, 0.0];
    let (mean, spread) = moments(up, |u| sample(cap.sample(u), cap.uniform_pdf()));
    let (same, none) = moments(up, |u| {
        let w = projected.sample(u);
        sample(w, projected.pdf_at_cosine(w.y))
    });
    let headline = vec![
        format!("relative variance of one sample of the irradiance: {:.4} by solid angle", spread / (mean * mean)),
        format!("by projected solid angle {:.1e}, which is rounding error", (none / (same * same)).abs()),
        format!(
            "irradiance per radiance {mean:.6} and {same:.6}; {:.6} in closed form",
            f64::from(projected.projected_solid_angle().lane(0))
        ),
    ];
    let mut lines =
        vec!["A sphere of half-angle 40°, whose axis is 65° from the normal, so that the horizon cuts it.".to_owned()];
    lines.extend(headline.iter().cloned());
    let svg = Svg::row(vec![Svg::chart(&by_solid_angle.draw()), Svg::chart(&by_projected.draw())]);
    Finding { svg: svg.captioned(&lines), headline }
}
