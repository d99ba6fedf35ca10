//! The irradiance from pictures against quadratures that know only the look-up of the picture.

use etendue::{Mask, Real, Vec3};
use etendue_render::geometry::{Geometry, Parallelogram};
use etendue_render::know::PictureIrradiance;
use etendue_render::packet::{M8, V8};
use etendue_render::scene::light_picture::{LightPicture, WORLD};
use etendue_render::scene::texture::{Colors, Mapping, Picture, Texels, Wrap};
use std::f64::consts::PI;
use std::sync::Arc;

const ORDER: usize = PictureIrradiance::ORDER;

/// The zeros of a Chebyshev polynomial, and the Lagrange polynomials of these at a position.
fn places() -> [f64; ORDER] {
    std::array::from_fn(|i| -libm::cos((2 * i + 1) as f64 * PI / (2 * ORDER) as f64))
}
fn lagrange(at: f64) -> [f64; ORDER] {
    let places = places();
    let factor = |i: usize, j: usize| (at - places[j]) / (places[i] - places[j]);
    std::array::from_fn(|i| (0..ORDER).filter(|&j| j != i).map(|j| factor(i, j)).product())
}

/// The kernel's error, relative to that of a receiver that faces the point of the light, is greatest for thin lights, in line with them.
#[test]
fn far_boxes_are_interpolated_to_the_stated_error() {
    let places = places();
    let at = |i: usize| i as f64 / 8.0 - 1.0;
    let values: Vec<[f64; ORDER]> = (0..17).map(|i| lagrange(at(i))).collect();
    let mut worst = 0.0_f64;
    for (thin, skew) in [0.01, 0.1, 0.3, 0.5, 0.7, 0.85, 1.0].into_iter().flat_map(|a| [0.0, 0.6, -0.9].map(|b| (a, b)))
    {
        let (s, t) = (Vec3::new(1.0, 0.0, 0.0), Vec3::new(skew * thin, thin * f64::sqrt(1.0 - skew * skew), 0.0));
        let half = (s + t).length().max((s - t).length());
        for (turn, up) in (0..13).flat_map(|i| [0.0, 0.1, 0.3, 0.6, 1.0].map(|up| (PI * i as f64 / 12.0, up))) {
            let flat = f64::sqrt(1.0 - up * up);
            let center = Vec3::new(flat * turn.cos(), flat * turn.sin(), up) * (PictureIrradiance::FAR * half);
            let point = |x: f64, y: f64| center + s * x + t * y;
            let kernel = |v: Vec3<f64>| v * (1.0 / v.length_squared().powi(2));
            for (x, y) in (0..17).flat_map(|i| (0..17).map(move |j| (i, j))) {
                let exact = point(at(x), at(y));
                let mut sum = Vec3::default();
                for (i, j) in (0..ORDER).flat_map(|i| (0..ORDER).map(move |j| (i, j))) {
                    sum += kernel(point(places[i], places[j])) * (values[x][i] * values[y][j]);
                }
                worst = worst.max((sum - kernel(exact)).length() * exact.length().powi(3));
            }
        }
    }
    println!("greatest error {worst:.1e}");
    assert!((1e-6..6e-6).contains(&worst), "{worst}");
}

fn picture(width: usize, height: usize, bilinear: bool, mapping: Mapping) -> LightPicture {
    let color = |i: usize| {
        [((i * 7919) % 101) as f32, ((i * 104_729) % 37) as f32, if i.is_multiple_of(11) { 500.0 } else { 0.0 }]
    };
    let colors = Colors::Float((0..width * height).map(color).collect());
    let texels = Arc::new(Texels { width, height, colors, alpha: None });
    let picture = Picture { texels, mapping, wrap: [Wrap::Clamp; 2], bilinear };
    LightPicture { picture, factor: [1.0, 0.5, 0.25], axes: WORLD }
}

/// By a rule of Gauss with 3 × 3 points in cells of at most half a texel, in double precision: it knows only the picture's look-up.
fn quadrature(shown: &LightPicture, [p, u, v]: [[f32; 3]; 3], at: [f64; 3], n: [f64; 3]) -> [f64; 3] {
    let wide = |v: [f32; 3]| Vec3::<f64>::from(v.map(f64::from));
    let (p, u, v, at, n) = (wide(p), wide(u), wide(v), Vec3::from(at), Vec3::from(n));
    let Texels { width, height, .. } = *shown.picture.texels;
    let [w, h] = [width, height].map(|n| 2 * n * 48_usize.div_ceil(n));
    let rule = [(-0.6_f64.sqrt(), 5.0 / 18.0), (0.0, 8.0 / 18.0), (0.6_f64.sqrt(), 5.0 / 18.0)];
    let mut sum = [0.0; 3];
    for (i, j) in (0..w).flat_map(|i| (0..h).map(move |j| (i, j))) {
        for ((x, a), (y, b)) in rule.into_iter().flat_map(|x| rule.map(|y| (x, y))) {
            let (s, t) = ((i as f64 + 0.5 + 0.5 * x) / w as f64, (j as f64 + 0.5 + 0.5 * y) / h as f64);
            let to = p + u * s + v * t - at;
            let kernel = to.dot(n) * to.dot(u.cross(v)).abs() / to.length_squared().powi(2);
            let color = shown.picture.at([s as f32, t as f32]);
            for k in 0..3 {
                sum[k] += a * b * kernel * f64::from(color[k] * shown.factor[k]) / (w * h) as f64;
            }
        }
    }
    sum
}

#[test]
fn irradiance_is_that_of_a_quadrature() {
    let flip = Mapping([[-1.0, 0.0, 1.0], [0.0, 1.0, 0.0]]);
    let shapes = [
        [[-1.0, 2.0, 0.5], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
        [[1e3, 2e3, 500.0], [0.0, 900.0, 0.0], [100.0, 0.0, 2e3]],
        [[-1e-3, 2e-3, 5e-4], [2e-3, 1e-3, 0.0], [0.0, 0.0, 1e-4]],
    ];
    let mut checked = 0;
    for (size, bilinear, mapping) in [
        ([1, 1], true, Mapping::IDENTITY),
        ([37, 20], true, flip),
        ([64, 64], false, Mapping::IDENTITY),
        ([3, 130], true, Mapping::IDENTITY),
    ] {
        let shown = picture(size[0], size[1], bilinear, mapping);
        for shape @ [p, u, v] in shapes {
            let geometry = Geometry::Parallelogram(Parallelogram { p, u, v });
            let irradiance = PictureIrradiance::new(&shown, &geometry).expect("a whole picture");
            let size = (Vec3::<f32>::from(u) + Vec3::from(v)).length();
            let middle: [f32; 3] = std::array::from_fn(|k| p[k] + 0.5 * (u[k] + v[k]));
            for (k, away) in [0.4, 0.7, 1.1, 1.8, 3.0, 5.0, 20.0, 1e3].into_iter().enumerate() {
                let turn = 2.4 * k as f32;
                let toward = [turn.cos() * 0.8, turn.sin() * 0.8, 0.6];
                let at: [f32; 3] = std::array::from_fn(|i| middle[i] + toward[i] * away * size);
                let lift = [0.1, -0.2, 0.15];
                let n = Vec3::<f32>::from(std::array::from_fn::<f32, 3, _>(|i| lift[i] - toward[i])).normalize();
                let (sum, known) = irradiance.at(at.into(), V8::splat(n), M8::splat(true));
                let want = quadrature(&shown, shape, at.map(f64::from), [n.x, n.y, n.z].map(f64::from));
                if known.all() {
                    checked += 1;
                    for (got, want) in [sum.x, sum.y, sum.z].map(|x| f64::from(x.lane(3))).into_iter().zip(want) {
                        assert!((got - want).abs() <= 3e-5 * want.abs(), "{size} {shape:?} {away}: {got} {want}");
                    }
                }
            }
        }
    }
    println!("{checked} of 96 points are known");
    assert!(checked >= 84, "{checked}");
}

#[test]
fn what_is_below_the_horizon_is_dark_and_what_crosses_it_is_unknown() {
    let shown = picture(32, 32, true, Mapping::IDENTITY);
    let geometry =
        Geometry::Parallelogram(Parallelogram { p: [-1.0, 2.0, -1.0], u: [2.0, 0.0, 0.0], v: [0.0, 0.0, 2.0] });
    let irradiance = PictureIrradiance::new(&shown, &geometry).expect("a whole picture");
    let at = |p: [f32; 3], n: [f32; 3]| {
        let (sum, known) = irradiance.at(p.into(), n.into(), M8::splat(true));
        (sum.x.lane(0), known.all())
    };
    assert_eq!(at([0.0, 0.0, 0.0], [0.0, -1.0, 0.0]), (0.0, true));
    assert_eq!(at([0.0, 1.99, 0.0], [0.0, -1.0, 0.0]), (0.0, true));
    assert!(at([0.0, 0.0, 0.0], [0.0, 1.0, 0.0]).0 > 1.0);
    assert!(!at([0.0, 0.0, 0.0], [0.6, 0.0, 0.8]).1);
    assert!(!at([0.0, 1.99, 0.0], [0.0, 1.0, 0.0]).1);
    for odd in [f32::MAX, -f32::MAX, f32::NAN, f32::INFINITY, 1e-40] {
        for p in [[odd; 3], [0.0, odd, 0.0], [0.5, 2.0, odd]] {
            let (sum, is_known) = at(p, [0.6, 0.8, 0.0]);
            assert!(sum.is_finite(), "{p:?}: {sum}, {is_known}");
        }
    }
}
