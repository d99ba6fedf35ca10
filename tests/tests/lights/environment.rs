//! Environment images against brute-force tables: pdf, texels, inverses, the map.

use crate::lights::stretch;
use core::f64::consts::{PI, TAU};
use etendue::light::{EnvironmentMap, ImageEnvironment, Rotated};
use etendue::{Frame, LightSampler, Vec2, Vec3, Warp};
use etendue_judge::generators::Random;
use etendue_judge::packets::{Coordinates, squares_of};
use etendue_judge::tolerances::ULP;
use etendue_oracle::tier::cases;
use etendue_oracle::{V3, length, sub};

use EnvironmentMap::{EqualArea, Equirectangular};
const MAPS: [EnvironmentMap; 2] = [EqualArea, Equirectangular];

struct Image {
    name: &'static str,
    weights: Vec<f32>,
    width: usize,
    height: usize,
}

fn images(map: EnvironmentMap) -> Vec<Image> {
    let sizes: &[[usize; 2]] = match map {
        EqualArea => &[[1, 1], [2, 2], [7, 7], [64, 64]],
        // with odd heights, the horizon passes through a row
        Equirectangular => &[[1, 1], [2, 1], [4, 2], [6, 3], [13, 7], [128, 64], [16, 301]],
    };
    let mut random = Random::new(11);
    let mut all = Vec::new();
    for &[width, height] in sizes {
        let mut push = |name, f: &mut dyn FnMut(usize, &mut Random) -> f64| {
            let weights: Vec<_> = (0..width * height).map(|i| f(i, &mut random) as f32).collect();
            if weights.iter().any(|w| *w > 0.0) {
                all.push(Image { name, weights, width, height });
            }
        };
        push("flat", &mut |_, _| 1.0);
        push("ordinary", &mut |_, r| r.range(0.1, 1.0));
        push("half of it black", &mut |_, r| (r.unit_f64() - 0.5).max(0.0));
        push("six decades", &mut |_, r| r.magnitude(1e-3, 1e3));
        push("a sun", &mut |i, _| if i == width * height / 3 { 1e6 } else { 1.0 });
        push("one texel", &mut |i, _| if i == width * height / 2 { 7.0 } else { 0.0 });
    }
    all
}

impl Image {
    fn solid_angle(&self, map: EnvironmentMap, y: usize) -> f64 {
        let (w, h) = (self.width as f64, self.height as f64);
        match map {
            EqualArea => 4.0 * PI / (w * h),
            Equirectangular => TAU / w * ((PI * y as f64 / h).cos() - (PI * (y + 1) as f64 / h).cos()),
        }
    }
    /// Column and row of a direction, as real numbers, by the definition of the map.
    fn place(&self, map: EnvironmentMap, d: V3) -> [f64; 2] {
        let (w, h) = (self.width as f64, self.height as f64);
        match map {
            Equirectangular => [(d[1].atan2(d[0]) / TAU).rem_euclid(1.0) * w, d[0].hypot(d[1]).atan2(d[2]) / PI * h],
            EqualArea => {
                // upper half: the disk of radius √(1−|z|), mapped to a diamond; lower half: folded outwards over its sides
                let r = ((d[0] * d[0] + d[1] * d[1]) / (1.0 + d[2].abs())).sqrt();
                let b = r * d[1].abs().atan2(d[0].abs()) / (PI / 2.0);
                let (a, b) = if d[2] < 0.0 { (1.0 - b, 1.0 - (r - b)) } else { (r - b, b) };
                [(a.copysign(d[0]) + 1.0) / 2.0 * w, (b.copysign(d[1]) + 1.0) / 2.0 * h]
            }
        }
    }
    /// The correct pdfs of a direction: that of its texel, and those of the texels within its rounding.
    fn densities(&self, map: EnvironmentMap, d: V3, rounding: f64) -> Vec<f64> {
        let total: f64 =
            (0..self.weights.len()).map(|i| f64::from(self.weights[i]) * self.solid_angle(map, i / self.width)).sum();
        let (w, h) = (self.width as f64, self.height as f64);
        let [x, y] = self.place(map, d);
        // near a pole the same rounding turns the azimuth further
        let across = d[0].hypot(d[1]).max(1e-300);
        let (slack_x, slack_y) = match map {
            EqualArea => (rounding * w, rounding * h),
            Equirectangular => (rounding * w / across, rounding * h),
        };
        let range = |x: f64, slack: f64, n: usize| {
            let low = (x - slack).floor().max(0.0) as usize;
            let high = ((x + slack).floor().max(0.0) as usize).min(n - 1);
            low.min(n - 1)..=high
        };
        let mut columns: Vec<_> = range(x, slack_x, self.width).collect();
        if x < slack_x || x > w - slack_x {
            columns.extend([0, self.width - 1]);
        }
        let mut found = Vec::new();
        for row in range(y, slack_y, self.height) {
            for &column in &columns {
                found.push(f64::from(self.weights[row * self.width + column]) / total);
            }
        }
        found
    }
}

fn near(pdf: f64, truths: &[f64], texels: usize) -> bool {
    // the pmf of rows and columns is a multiple of 2⁻²⁴, and a texel with a weight has at least one step
    truths.iter().any(|t| (pdf - t).abs() <= 2e-6 * t + (texels as f64).max(8.0) * ULP)
}

/// pdf, texel and inverse are right at any direction, also at poles and seams, and at samples.
#[test]
fn pdf_matches_the_table() {
    let mut random = Random::new(1);
    for map in MAPS {
        for image in images(map) {
            let mut buffer = vec![0.0; ImageEnvironment::buffer(image.width, image.height)];
            let sky = ImageEnvironment::build(&image.weights, image.width, map, &mut buffer).unwrap();
            let texels = image.width * image.height;
            let name = format!("{map:?} {}x{} {}", image.width, image.height, image.name);
            for y in 0..image.height {
                let stated = map.texel_solid_angle(image.width, image.height, y);
                assert!((stated - image.solid_angle(map, y)).abs() < 1e-13, "{name}: {stated} in row {y}");
            }
            let mut at = |i: usize| -> V3 {
                match i {
                    0 => [0.0, 0.0, 1.0],
                    1 => [0.0, 0.0, -1.0],
                    2 => [1.0, 0.0, 0.0],
                    3 => [1.0, -0.0, 0.0],
                    4 => [0.0, -1.0, -0.0],
                    5 => [1e-6, -1e-7, -1.0],
                    6 => [-1e-20, 1e-30, 1.0],
                    _ => random.direction().map(|x| f64::from(x as f32)),
                }
            };
            for i in 0..300 {
                let d = at(i);
                let w: Vec3<f32> = Coordinates::gather(&[d]);
                let truths = image.densities(map, d, 5e-7);
                let pdf = f64::from(sky.pdf(w));
                assert!(near(pdf, &truths, texels), "{name}: {pdf} at {d:?}, expected one of {truths:?}");
                let double = Vec3::<f64>::new(d[0], d[1], d[2]);
                let (truths, pdf) = (image.densities(map, d, 1e-14), sky.pdf(double));
                assert!(near(pdf, &truths, texels), "{name}: {pdf} at {d:?}, expected one of {truths:?}");
                // where there is light, the inverse maps back to the direction
                if pdf > 1e-3 {
                    let back = sky.sample(sky.invert(w)).at(0);
                    let off = length(sub(back, d));
                    // the inverse is about a multiple of 2⁻²⁴, and few of these fall into a dark texel
                    let (w, h) = (image.width as f64, image.height as f64);
                    let steps = 2.0 * ULP * (TAU / (pdf * image.solid_angle(map, 0)).min(1.0)).max(w.max(h));
                    // near a pole, a step of the cosine is its square root in the angle
                    let angle = if d[0].hypot(d[1]) < 1e-2 { (2.0 * steps).sqrt() } else { 0.0 };
                    assert!(off < 1e-6 + 8.0 * steps + angle, "{name}: {d:?} maps back to {back:?}, off by {off:e}");
                }
            }
            let mut smooth = 0;
            for i in 0..1000 {
                let u = if i == 0 { [0.0; 2] } else { [random.unit(), random.unit()] };
                let (s, double) = (sky.draw(squares_of::<f32>(&[u])), sky.draw(squares_of::<f64>(&[u])));
                let d = s.light.direction.at(0);
                assert!((length(d) - 1.0).abs() < 4e-7 && s.light.emits && !s.light.delta && s.light.distance > 1e38);
                let weight = image.weights[s.y as usize * image.width + s.x as usize];
                assert!(weight > 0.0 && s.light.pdf > 0.0, "{name}: a black texel at {u:?}");
                let truths = image.densities(map, d, 5e-7);
                assert!(near(s.light.pdf.into(), &truths, texels), "{name}: {s:?}, expected one of {truths:?}");
                // single precision against double, at the same texel: within the documented bounds, besides half a step of u
                assert_eq!((s.x, s.y), (double.x, double.y));
                let exact = double.light.direction.at(0);
                let moved = [-0.5 * ULP, 0.5 * ULP].map(|by| {
                    let near = sky.draw(Vec2::new(f64::from(u[0]), (f64::from(u[1]) + by).max(0.0)));
                    if near.y == double.y { length(sub(near.light.direction.at(0), exact)) } else { 0.0 }
                });
                let off = length(sub(d, exact)) - moved[0].max(moved[1]);
                let density = (f64::from(s.light.pdf) / double.light.pdf - 1.0).abs();
                assert!(off < 6e-7 && density < 5e-7, "{name} at {u:?}: {off:e}, {density:e}: {s:?} {double:?}");
                // the sample's pdf is the evaluated one, except at the edge of a texel
                let texel = sky.texel(s.light.direction);
                if (texel.x, texel.y) == (s.x, s.y) {
                    assert_eq!(sky.pdf(s.light.direction), s.light.pdf);
                    let again = sky.invert(s.light.direction).at(0);
                    let [x, y] = [0, 1].map(|k| (again[k] - f64::from(u[k])).abs());
                    let (w, h) = (image.width as f64, image.height as f64);
                    let across = if map == EqualArea { 1.0 } else { d[0].hypot(d[1]) };
                    assert!(
                        x * across < 4e-7 * w.max(2.0) && y * across < 4e-7 * h.max(2.0),
                        "{name}: {again:?}, expected {u:?}"
                    );
                } else {
                    assert!(truths.len() > 1, "{name}: {texel:?}, expected that of {s:?}");
                }
                let draw = |u: Vec2<f64>| {
                    let s = sky.draw(u);
                    (s.light.direction.at(0), s.light.pdf, [s.x, s.y])
                };
                // next to a pole the map is a root
                if let Some(stretch) = stretch(draw, u.map(f64::from)).filter(|_| d[0].hypot(d[1]) > 0.05) {
                    smooth += 1;
                    assert!(
                        (stretch - 1.0).abs() < 1e-3,
                        "{name}: the map stretches {stretch} times the density at {u:?}"
                    );
                }
            }
            assert!(smooth > 500, "{name}: {smooth}");
        }
    }
}

/// A texel at the pole of a very large image: no division by the sine.
#[test]
fn poles_of_large_images() {
    let (width, height) = (4, 1 << 16);
    for row in [0, 1, height / 2, height - 2, height - 1] {
        let mut weights = vec![0.0; width * height];
        weights[row * width + 1] = 1.0;
        let mut buffer = vec![0.0; ImageEnvironment::buffer(width, height)];
        let sky = ImageEnvironment::build(&weights, width, Equirectangular, &mut buffer).unwrap();
        let image = Image { name: "", weights, width, height };
        let truth = 1.0 / image.solid_angle(Equirectangular, row);
        for u in [[0.1_f32, 0.2], [0.9, 0.01], [0.5, 0.99]] {
            let s = sky.draw(Vec2::new(u[0], u[1]));
            // the oracle's difference of cosines cancels too: 1e−16 of 1e−10
            assert!((f64::from(s.light.pdf) / truth - 1.0).abs() < 2e-6, "{row}: {}, expected {truth}", s.light.pdf);
            let d = s.light.direction.at(0);
            let rows = d[0].hypot(d[1]).atan2(d[2]) / PI * height as f64;
            let inside = if row + 2 < height && row > 1 { 1e-2 } else { 1e-4 };
            assert!(rows > row as f64 - inside && rows < (row + 1) as f64 + inside, "{row}: {rows}");
            assert!(d[0] <= 1e-7 && d[1] >= -1e-7, "not in the second quadrant: {d:?}");
        }
    }
}

/// In axes of its own a sky is the same image: its pdfs, texels and inverses are those of the direction in these axes.
#[test]
fn a_sky_may_have_axes_of_its_own() {
    let mut random = Random::new(11);
    let weights: Vec<f32> = (0..32).map(|_| random.unit()).collect();
    let mut buffer = [0.0; ImageEnvironment::buffer(8, 4)];
    let image = ImageEnvironment::build(&weights, 8, Equirectangular, &mut buffer).unwrap().by_radiance();
    for _ in 0..cases(2_000, 40_000) {
        let [x, y] = [random.direction(), random.direction()].map(|v| Vec3::from(v.map(|x| x as f32)));
        let (n, s) = (x.normalize(), x.cross(y).normalize());
        let frame = Frame { s, t: n.cross(s), n };
        let sky = Rotated { sampler: image, frame };
        let u = Vec2::new(random.unit(), random.unit());
        let (plain, turned) = (image.sample(u), sky.sample(u));
        assert!((turned.direction - frame.to_world(plain.direction)).length() < 1e-6, "{plain:?} {turned:?}");
        assert!(turned.pdf == sky.pdf(turned.direction) && turned.direction.dot(turned.normal) < -0.999);
        let hit = image.hit(frame.to_local(turned.direction));
        assert_eq!((turned.pdf, turned.uv, turned.distance), (hit.pdf, hit.uv, hit.distance));
        assert_eq!(sky.invert(turned.direction), image.invert(frame.to_local(turned.direction)));
    }
}
