//! Lights with pictures: pmf, pdf, inverses, against sums over texels in double precision.

mod interpolated;
mod lights;

use crate::lights::stretch;
use core::f64::consts::PI;
use etendue::Vec2;
use etendue::light::{Picture, Region};
use etendue_judge::generators::{self, Random};
use etendue_judge::packets::Coordinates;
use etendue_oracle::tier::cases;
use etendue_oracle::{V3, dot, narrow};
use lights::{Ball, By, LIGHTS, Light, POINTS, normal, vector};

struct Image {
    name: &'static str,
    weights: Vec<f32>,
    size: [usize; 2],
}

fn images() -> Vec<Image> {
    let mut random = Random::new(21);
    let mut all = Vec::new();
    for size @ [width, height] in [[1, 1], [2, 1], [1, 3], [5, 7], [16, 16], [33, 8]] {
        let mut push = |name, f: &mut dyn FnMut(usize, &mut Random) -> f64| {
            let weights: Vec<_> = (0..width * height).map(|i| f(i, &mut random) as f32).collect();
            all.push(Image { name, weights, size });
        };
        push("flat", &mut |_, _| 1.0);
        push("half of it black", &mut |i, r| if i == 0 { 1.0 } else { (r.unit_f64() - 0.5).max(0.0) });
        push("six decades", &mut |_, r| r.magnitude(1e-3, 1e3));
        push("one texel", &mut |i, _| if i == width * height / 2 { 7.0 } else { 0.0 });
        push("sparks", &mut |i, _| if i % 3 == 0 { 1e30 } else { 1e-30 });
    }
    all
}

impl Image {
    fn buffer(&self) -> Vec<f32> {
        vec![0.0; Picture::buffer(self.size[0], self.size[1])]
    }
    fn build<'a>(&self, light: Light, buffer: &'a mut [f32]) -> Picture<'a> {
        Picture::build(&self.weights, self.size[0], light.region(), buffer).unwrap()
    }
    fn weight(&self, x: u32, y: u32) -> f64 {
        self.weights[y as usize * self.size[0] + x as usize].into()
    }
    /// Surface coordinates of a position in a texel.
    fn place(&self, x: usize, y: usize, [s, t]: [f64; 2]) -> [f64; 2] {
        [(x as f64 + s) / self.size[0] as f64, (y as f64 + t) / self.size[1] as f64]
    }
    fn texels(&self) -> impl Iterator<Item = [usize; 2]> + use<'_> {
        (0..self.weights.len()).map(|i| [i % self.size[0], i / self.size[0]])
    }
}

/// The mean of radiance over pdf is ∫L dω (∫L cosθ dω by projected solid angle), and in whole texels hardly varies.
#[test]
fn samples_are_worth_the_light() {
    let count = 9216;
    for light in LIGHTS {
        let whole = |image: &&Image| ["flat", "half of it black"].contains(&image.name);
        for image in images().iter().filter(whole).step_by(cases(5, 1)) {
            let mut buffer = image.buffer();
            let picture = image.build(light, &mut buffer);
            for p in POINTS.into_iter().step_by(cases(2, 1)) {
                for &by in light.measures() {
                    let name = format!("{light:?} {by:?} {:?} {} from {p:?}", image.size, image.name);
                    let n = normal(p);
                    let cosine = |w: V3| if by == By::Projected { dot(w, n).max(0.0) } else { 1.0 };
                    let sampler = light.with::<f32>(picture, by, vector(p), vector(n));
                    let (mut sum, mut squared) = (0.0, 0.0);
                    for i in 0..count {
                        // a lattice of irrational steps, which no grid of texels meets
                        let u = [0.754_877_666_2, 0.569_840_290_9].map(|step| (f64::from(i) * step).fract() as f32);
                        let s = (sampler.draw)(Vec2::new(u[0], u[1]));
                        assert!(image.weight(s.x, s.y) > 0.0, "{name}: a dark texel at {u:?}");
                        let seen = if light == Ball { s.light } else { s.light.two_sided() };
                        let worth = image.weight(s.x, s.y) * f64::from(seen.weight()) * cosine(s.light.direction.at(0));
                        sum += worth;
                        squared += worth * worth;
                    }
                    let count = f64::from(count);
                    let mean = sum / count;
                    let spread = (squared / count / (mean * mean) - 1.0).max(0.0).sqrt();
                    // fine enough for the nearest point, an eighth above its light
                    let n = cases(400, 1000) / image.size[0].max(image.size[1]);
                    let mut truth = 0.0;
                    for [x, y] in image.texels() {
                        let mut texel = 0.0;
                        for k in 0..n * n {
                            let at = [k % n, k / n].map(|i| (i as f64 + 0.5) / n as f64);
                            if let Some((w, steradians)) = light.seen(p, image.place(x, y, at)) {
                                texel += steradians * cosine(w);
                            }
                        }
                        truth += texel / (n * n) as f64 * image.weight(x as u32, y as u32) / image.weights.len() as f64;
                    }
                    if truth < 1e-5 {
                        assert!(mean < 1.1e-5, "{name}: {mean}, expected {truth}");
                        continue;
                    }
                    let error = (mean / truth - 1.0).abs();
                    // strata leave less than independent samples
                    let bound = 4.0 * spread / count.sqrt() + cases(1e-3, 5e-4);
                    assert!(error < bound, "{name}: {mean}, expected {truth}, spread {spread}");
                    let exact = by == By::SolidAngle || by == By::Projected;
                    if exact && image.name == "flat" && light.region() == Region::Square {
                        // where next to nothing of it is above the horizon, distance and height vary together
                        let most = if truth < 1e-2 { 0.15 } else { 0.015 };
                        assert!(spread < most, "{name}: samples of a plain light spread by {spread}");
                    }
                }
            }
        }
    }
}

/// A sample's direction has the pdf that is reported, which is that of the map, and leads back to its `u`.
#[test]
fn closed() {
    let (mut random, mut smooth) = (Random::new(6), 0);
    for light in LIGHTS {
        for image in images() {
            let mut buffer = image.buffer();
            let picture = image.build(light, &mut buffer);
            for p in POINTS {
                for &by in light.measures() {
                    let name = format!("{light:?} {by:?} {:?} {} from {p:?}", image.size, image.name);
                    let n = normal(p);
                    let sampler = light.with::<f64>(picture, by, vector(p), vector(n));
                    for _ in 0..20 {
                        let u = [random.unit(), random.unit()].map(f64::from);
                        let s = (sampler.draw)(Vec2::new(u[0], u[1]));
                        let back = sampler.light.hit(s.light.direction);
                        if s.light.pdf == 0.0 || light == Ball && !s.light.emits {
                            continue;
                        }
                        let [x, y] = [back.uv.x * image.size[0] as f64, back.uv.y * image.size[1] as f64];
                        let beside = |x: f64| (x - x.round()).abs() < 1e-9;
                        if beside(x) || beside(y) {
                            continue;
                        }
                        assert!((back.pdf / s.light.pdf - 1.0).abs() < 1e-7, "{name}: {back:?}, expected {s:?}");
                        assert_eq!((x as u32, y as u32), (s.x, s.y), "{name}");
                        assert!(
                            (back.uv.x - s.light.uv.x).abs().max((back.uv.y - s.light.uv.y).abs()) < 1e-9,
                            "{name}"
                        );
                        let again = sampler.light.invert(s.light.direction).at(0);
                        let off = (again[0] - u[0]).abs().max((again[1] - u[1]).abs());
                        assert!(off < 1e-6, "{name}: {again:?}, expected {u:?}");
                        let draw = |u: Vec2<f64>| {
                            let s = (sampler.draw)(u);
                            (s.light.direction.at(0), s.light.pdf, [s.x, s.y])
                        };
                        if let Some(stretch) = stretch(draw, u) {
                            smooth += 1;
                            let off = (stretch - 1.0).abs();
                            assert!(off < 1e-3, "{name}: the map stretches {stretch} times the density at {u:?}");
                        }
                    }
                }
            }
        }
    }
    println!("{smooth} samples where the map is smooth");
    assert!(smooth > 10_000, "{smooth}");
}

/// No texel with radiance is lost, however little it has: its directions have a pdf.
#[test]
fn all_texels_have_a_chance() {
    for light in LIGHTS {
        for image in images() {
            let mut buffer = image.buffer();
            let picture = image.build(light, &mut buffer);
            for p in POINTS.into_iter().step_by(cases(2, 1)) {
                for &by in light.measures() {
                    let n = normal(p);
                    let sampler = light.with::<f32>(picture, by, vector(p), vector(n));
                    for [x, y] in image.texels() {
                        for at in [[0.5; 2], [0.01, 0.02], [0.97, 0.06], [0.04, 0.98]] {
                            let Some((w, steradians)) = light.seen(p, image.place(x, y, at)) else { continue };
                            let hit = sampler.light.hit(vector(w));
                            let texel = [hit.uv.x * image.size[0] as f32, hit.uv.y * image.size[1] as f32];
                            let here = texel[0] as usize == x && texel[1] as usize == y;
                            let visible = steradians > 1e-6 && (by != By::Projected || dot(w, n) > 1e-5);
                            let lit = image.weight(x as u32, y as u32) > 0.0;
                            let inside = light.point(image.place(x, y, at.map(|x| x + 1e-4))).is_some();
                            let name =
                                format!("{light:?} {by:?} {:?} {} from {p:?} at {x}, {y}", image.size, image.name);
                            if hit.pdf > 0.0 && here {
                                assert!(lit, "{name}: a dark texel has the pdf {}", hit.pdf);
                            }
                            if lit && visible && inside {
                                assert!(hit.pdf > 0.0, "{name}: lost, {hit:?}");
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Any point, direction and contents of a buffer, of a picture of texels or an interpolated one, give finite results and an inverse in the
/// square.
#[test]
fn any_bits() {
    let mut random = Random::new(7);
    for light in LIGHTS {
        for (round, image) in images().iter().enumerate() {
            let mut buffer = image.buffer();
            image.build(light, &mut buffer);
            if round % 4 == 3 {
                buffer.iter_mut().for_each(|share| *share = random.any_f32());
            }
            let mut picture = Picture::from_buffer(&buffer, image.size, light.region()).unwrap();
            assert_eq!((picture.size(), picture.region()), (image.size, light.region()));
            let [w, h] = image.size;
            let mut cells = vec![0.0; Picture::buffer(w + 1, h + 1)];
            if light.region() == Region::Square && round % 2 == 1 {
                picture = Picture::interpolated(&image.weights, w, &mut cells).unwrap();
                if round % 4 == 3 {
                    cells.iter_mut().for_each(|share| *share = random.any_f32());
                    picture = Picture::interpolated_from_buffer(&image.weights, w, &cells).unwrap();
                }
            }
            for (k, &by) in light.measures().iter().enumerate() {
                let hostile = (round + k) % 2 == 0;
                let near = |r: &mut Random| r.direction().map(|x| (2.0 * x) as f32);
                let any = |r: &mut Random| if hostile { generators::nasty(r) } else { near(r) };
                for _ in 0..8 {
                    let (p, n, w) = (any(&mut random), random.direction(), any(&mut random));
                    let (u, name) =
                        ([random.unit(), random.unit()], || format!("{light:?} {by:?} from {p:?} along {w:?}"));
                    let sampler = light.with::<f32>(picture, by, p.into(), narrow(n).into());
                    let (s, hit) = ((sampler.draw)(u.into()), sampler.light.hit(w.into()));
                    let [back, [x, y, z]] = [sampler.light.invert(w.into()).at(0), s.light.direction.at(0)];
                    let at = s.light.uv.at(0);
                    let numbers = [s.light.distance, s.light.pdf, hit.pdf].map(f64::from);
                    let finite = [x, y, z].iter().chain(&numbers).all(|x| x.is_finite());
                    assert!(finite && numbers.iter().all(|&x| x >= 0.0), "{}: {s:?} {hit:?}", name());
                    assert!(at.iter().all(|x| (0.0..=1.0).contains(x)), "{}: {s:?}", name());
                    assert!(back.iter().all(|x| (0.0..1.0).contains(x)), "{}: {back:?}", name());
                    let size = picture.size().map(|n| n as u32);
                    assert!(s.x < size[0] && s.y < size[1], "{}: {s:?}", name());
                }
            }
        }
    }
}

/// The parts of texels add up to the region, and each texel that it touches has some.
#[test]
fn parts_of_regions() {
    for (region, area) in [(Region::Square, 1.0), (Region::Triangle, 0.5), (Region::Disk, PI / 4.0)] {
        for [w, h] in [[1, 1], [3, 2], [16, 16], [40, 7]] {
            let parts = (0..w * h).map(|i| region.part([i % w, i / w], [w, h]));
            let sum = parts.clone().sum::<f64>() / (w * h) as f64;
            assert!((sum - area).abs() < 0.03, "{region:?} {w} × {h}: {sum}");
            assert!(parts.clone().all(|part| (0.0..=1.0).contains(&part)));
            for (i, part) in parts.enumerate() {
                let (x, y) = ((i % w) as f64, (i / w) as f64);
                let inside = (0..=1000).any(|k| {
                    let (s, t) = ((x + f64::from(k % 31) / 30.0) / w as f64, (y + f64::from(k / 31) / 33.0) / h as f64);
                    match region {
                        Region::Square => true,
                        Region::Triangle => s + t < 1.0,
                        Region::Disk => (2.0 * s - 1.0).hypot(2.0 * t - 1.0) < 1.0,
                    }
                });
                assert!(part > 0.0 || !inside, "{region:?} {w} × {h}: texel {i} is touched");
            }
        }
    }
}
