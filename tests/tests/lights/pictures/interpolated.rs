//! Pictures that are interpolated between the centres of their texels.

use crate::lights::pictures::lights::{Ball, By, LIGHTS, POINTS, normal, vector};
use etendue::Vec2;
use etendue::light::{Picture, Region};
use etendue_judge::generators::Random;
use etendue_judge::packets::Coordinates;
use etendue_oracle::tier::cases;
use etendue_oracle::{V3, dot};

/// What interpolation makes of values at the centres of texels, continued by the outermost ones.
fn interpolation(values: &[f32], [w, h]: [usize; 2], [u, v]: [f64; 2]) -> f64 {
    let (x, y) = (u * w as f64 - 0.5, v * h as f64 - 0.5);
    let (i, j, s, t) = (x.floor(), y.floor(), x - x.floor(), y - y.floor());
    let at = |i: f64, j: f64| {
        let [i, j] = [(i, w), (j, h)].map(|(i, n)| i.clamp(0.0, n as f64 - 1.0) as usize);
        f64::from(values[j * w + i])
    };
    let row = |j: f64| at(i, j) * (1.0 - s) + at(i + 1.0, j) * s;
    row(j) * (1.0 - t) + row(j + 1.0) * t
}

/// The means are those of the interpolation, by quadrature.
#[test]
fn means_of_interpolated_texels() {
    let mut random = Random::new(8);
    let (w, h) = (5, 4);
    let values: Vec<f32> = (0..w * h).map(|_| random.unit()).collect();
    for (x, y) in (0..w * h).map(|i| (i % w, i / w)) {
        let n = 100;
        let point = |k: usize| [k % n, k / n].map(|i| (i as f64 + 0.5) / n as f64);
        let uv = |[s, t]: [f64; 2]| [(x as f64 + s) / w as f64, (y as f64 + t) / h as f64];
        let sum: f64 = (0..n * n).map(|k| interpolation(&values, [w, h], uv(point(k)))).sum();
        let mean = f64::from(Picture::mean_of_bilinear(&values, w, [x, y]));
        assert!((mean - sum / (n * n) as f64).abs() < 1e-4, "{x}, {y}: {mean}");
    }
}

/// Interpolated pictures: samples are worth ∫L dω, those from afar all the same, and lead back to their `u`.
#[test]
fn interpolated_pictures() {
    let mut random = Random::new(9);
    for light in LIGHTS.into_iter().filter(|light| light.region() == Region::Square) {
        for [width, height] in [[1, 1], [2, 5], [16, 9]].into_iter().skip(cases(1, 0)) {
            // some texels are dark, and some very bright
            let values: Vec<f32> = (0..width * height)
                .map(|i| if i % 4 == 3 { 0.0 } else { 0.01 + random.unit().powi(6) * 50.0 })
                .collect();
            let mut buffer = vec![0.0; Picture::buffer(width + 1, height + 1)];
            Picture::interpolated(&values, width, &mut buffer).unwrap();
            let picture = Picture::interpolated_from_buffer(&values, width, &buffer).unwrap();
            assert_eq!(picture.size(), [width + 1, height + 1]);
            for p in POINTS.into_iter().step_by(cases(2, 1)) {
                for &by in light.measures() {
                    let name = format!("{light:?} {by:?} {width} × {height} from {p:?}");
                    let n = normal(p);
                    let cosine = |w: V3| if by == By::Projected { dot(w, n).max(0.0) } else { 1.0 };
                    let sampler = light.with::<f64>(picture, by, vector(p), vector(n));
                    let (mut sum, mut squared, mut count) = (0.0, 0.0, 0.0);
                    for i in 0..4096 {
                        let u = [0.754_877_666_2, 0.569_840_290_9].map(|step| (f64::from(i + 1) * step).fract());
                        let s = (sampler.draw)(Vec2::new(u[0], u[1])).light;
                        let seen = if light == Ball { s } else { s.two_sided() };
                        let radiance = interpolation(&values, [width, height], [s.uv.x, s.uv.y]);
                        let worth = radiance * seen.weight() * cosine(s.direction.at(0));
                        (sum, squared, count) = (sum + worth, squared + worth * worth, count + 1.0);
                        if s.pdf == 0.0 || light == Ball && !s.emits {
                            continue;
                        }
                        let back = sampler.light.hit(s.direction);
                        let cell = [back.uv.x * width as f64 - 0.5, back.uv.y * height as f64 - 0.5];
                        if cell.iter().any(|x| (x - x.round()).abs() < 1e-7) {
                            continue;
                        }
                        assert!((back.pdf / s.pdf - 1.0).abs() < 1e-5, "{name}: {back:?}, expected {s:?}");
                        let again = sampler.light.invert(s.direction).at(0);
                        let off = (again[0] - u[0]).abs().max((again[1] - u[1]).abs());
                        assert!(off < 2e-6, "{name}: {again:?}, expected {u:?}");
                    }
                    let (mean, m) = (sum / count, cases(256, 720));
                    let spread = (squared / count / (mean * mean) - 1.0).max(0.0).sqrt();
                    let mut truth = 0.0;
                    for k in 0..m * m {
                        let uv = [k % m, k / m].map(|i| (i as f64 + 0.5) / m as f64);
                        if let Some((w, steradians)) = light.seen(p, uv) {
                            truth += interpolation(&values, [width, height], uv) * steradians * cosine(w);
                        }
                    }
                    truth /= (m * m) as f64;
                    if truth < 1e-4 {
                        assert!(mean < 1.1e-4, "{name}: {mean}, expected {truth}");
                        continue;
                    }
                    let bound = 4.0 * spread / count.sqrt() + 2e-3;
                    assert!((mean / truth - 1.0).abs() < bound, "{name}: {mean}, expected {truth}, spread {spread}");
                    let far = p == POINTS[2] && by == By::SolidAngle;
                    assert!(!far || spread < 0.02, "{name}: samples from afar spread by {spread}");
                }
            }
        }
    }
}
