//! Lights with pictures: pmf, pdf, inverses, frequencies, lanes, against sums over texels in double precision.

use core::f64::consts::{PI, TAU};
use etendue::discrete::TableError;
use etendue::light::{Picture, PictureSample, Region, mean_of_bilinear};
use etendue::{
    BilinearPatch, Disk, LightSample, LightSampler, Mask, Parallelogram, Real, Rectangle, Sphere, Triangle, Uint, Vec2,
    Vec3, f32x4, f32x8, f32x16,
};
use etendue_oracle::tier::cases;
use etendue_oracle::{V3, cross, dot, length, sub, unit};
use etendue_properties::generators::{self, Random};
use etendue_properties::properties::{Coordinates, squares_of, twice, vectors_of};
use etendue_properties::stats;
use etendue_properties::tolerances::SIGNIFICANCE;

/// A light, as the corners and axes that define it.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Light {
    Rectangle,
    Parallelogram,
    Triangle,
    Disk,
    Sphere,
    Patch,
}
use Light::{Patch, Sphere as Ball};
const LIGHTS: [Light; 6] =
    [Light::Rectangle, Light::Parallelogram, Light::Triangle, Light::Disk, Light::Sphere, Light::Patch];
const CORNER: V3 = [-1.0, -0.5, 2.0];
const EDGE_S: V3 = [0.0, 1.5, 0.0];
const EDGE_T: V3 = [2.0, 0.0, 0.25];
const SHEAR: V3 = [0.5, 1.0, 0.0];
const DIAGONAL: V3 = [2.25, 1.25, 0.75];
const CENTER: V3 = [0.25, 0.5, 2.0];
const RADIUS: f64 = 0.75;

/// What texels are drawn by, besides radiance.
#[derive(Clone, Copy, Debug, PartialEq)]
enum By {
    Area,
    SolidAngle,
    Projected,
    Visible,
}

impl Light {
    fn measures(self) -> &'static [By] {
        if matches!(self, Ball | Patch) { &[By::Visible] } else { &[By::Area, By::SolidAngle, By::Projected] }
    }
    fn region(self) -> Region {
        match self {
            Self::Triangle => Region::Triangle,
            Self::Disk => Region::Disk,
            _ => Region::Square,
        }
    }
    /// The point at surface coordinates, and the normal times the area per unit of them; none where the light is not.
    fn point(self, [s, t]: [f64; 2]) -> Option<(V3, V3)> {
        let plane = |s: f64, t: f64, u: V3, v: V3| -> V3 { core::array::from_fn(|k| CORNER[k] + s * u[k] + t * v[k]) };
        Some(match self {
            Self::Rectangle => (plane(s, t, EDGE_S, EDGE_T), cross(EDGE_S, EDGE_T)),
            Self::Parallelogram => (plane(s, t, EDGE_S, SHEAR), cross(EDGE_S, SHEAR)),
            Self::Triangle if s + t >= 1.0 => return None,
            Self::Triangle => (plane(s, t, EDGE_S, SHEAR), cross(EDGE_S, SHEAR)),
            Self::Disk => {
                let (x, y) = (2.0 * s - 1.0, 2.0 * t - 1.0);
                if x * x + y * y >= 1.0 {
                    return None;
                }
                // the frame of the normal −z
                ([CENTER[0] + RADIUS * x, CENTER[1] - RADIUS * y, CENTER[2]], [0.0, 0.0, -4.0 * RADIUS * RADIUS])
            }
            Ball => {
                let z = 1.0 - 2.0 * s;
                let (sin, cos) = (TAU * t).sin_cos();
                let r = (1.0 - z * z).max(0.0).sqrt();
                let n = [r * cos, r * sin, z];
                (core::array::from_fn(|k| CENTER[k] + RADIUS * n[k]), n.map(|x| x * 4.0 * PI * RADIUS * RADIUS))
            }
            Patch => {
                let twist: V3 = core::array::from_fn(|k| DIAGONAL[k] - EDGE_S[k] - EDGE_T[k]);
                let along_s: V3 = core::array::from_fn(|k| EDGE_S[k] + t * twist[k]);
                let along_t: V3 = core::array::from_fn(|k| EDGE_T[k] + s * twist[k]);
                let p = core::array::from_fn(|k| CORNER[k] + s * EDGE_S[k] + t * along_t[k]);
                (p, cross(along_s, along_t))
            }
        })
    }
    /// Direction from `p` to a point, and steradians per unit of surface coordinates, if the side that emits is seen or the light is flat.
    fn seen(self, p: V3, uv: [f64; 2]) -> Option<(V3, f64)> {
        let (point, normal) = self.point(uv)?;
        let to = sub(point, p);
        let d = length(to);
        let cos = -dot(to, normal) / d;
        let cos = if self == Ball { cos } else { cos.abs() };
        (cos > 0.0).then(|| (to.map(|x| x / d), cos / (d * d)))
    }
    /// Its sampler by a measure, and the method that returns the texel, too.
    fn with<'a, R: Real>(self, picture: Picture<'a>, by: By, p: Vec3<R>, n: Vec3<R>) -> Sampler<'a, R> {
        let v = |x: V3| Vec3::<R>::lit(x);
        let (corner, edge_s) = (v(CORNER), v(EDGE_S));
        macro_rules! sampler {
            ($sampler:expr) => {{
                let sampler = $sampler;
                Sampler { light: Box::new(sampler), draw: Box::new(move |u| sampler.draw(u)) }
            }};
        }
        macro_rules! flat {
            ($light:expr) => {{
                let pictured = picture.on($light);
                match by {
                    By::Area => sampler!(pictured.by_area(p)),
                    By::SolidAngle => sampler!(pictured.by_solid_angle(p)),
                    _ => sampler!(pictured.by_projected_solid_angle(p, n)),
                }
            }};
        }
        match self {
            Self::Rectangle => flat!(Rectangle { corner, edge_s, edge_t: v(EDGE_T) }),
            Self::Parallelogram => flat!(Parallelogram { corner, edge_s, edge_t: v(SHEAR) }),
            Self::Triangle => flat!(Triangle { v0: corner, e1: edge_s, e2: v(SHEAR) }),
            Self::Disk => flat!(Disk { center: v(CENTER), normal: v([0.0, 0.0, -1.0]), radius: R::lit(RADIUS) }),
            Ball => sampler!(picture.on(Sphere { center: v(CENTER), radius: R::lit(RADIUS) }).by_visible_area(p)),
            Patch => {
                let patch = BilinearPatch { corner, edge_s, edge_t: v(EDGE_T), diagonal: v(DIAGONAL) };
                sampler!(picture.on(patch).by_visible_area(p))
            }
        }
    }
}

struct Sampler<'a, R: Real> {
    light: Box<dyn LightSampler<R> + 'a>,
    draw: Box<dyn Fn(Vec2<R>) -> PictureSample<R> + 'a>,
}

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

/// Points from which lights are seen: afar, near, touching, from the plane of the flat ones, from behind.
const POINTS: [V3; 6] = [
    [0.0, 0.0, 0.0],
    [0.5, 0.25, 1.875],
    [40.0, -30.0, -50.0],
    [-0.25, 0.25, 2.0625],
    [3.0, 0.5, 1.5],
    [0.0, 0.5, 4.0],
];

fn normal(p: V3) -> V3 {
    // so that the horizon passes through some of them
    unit(sub([0.3, 0.4, 2.2], p).map(|x| x + 0.05)).map(|x| f64::from(x as f32))
}

fn vector<R: Real>(p: V3) -> Vec3<R> {
    Vec3::lit(p)
}

/// The pdf integrates to 1 over the light, and samples match it, texel by texel.
#[test]
fn samples_follow_the_pdf() {
    let mut random = Random::new(5);
    for light in LIGHTS {
        for image in images().iter().filter(|image| image.name != "sparks").step_by(cases(3, 1)) {
            let mut buffer = image.buffer();
            let picture = image.build(light, &mut buffer);
            for p in POINTS.into_iter().step_by(cases(2, 1)) {
                for &by in light.measures() {
                    let name = format!("{light:?} {by:?} {:?} {} from {p:?}", image.size, image.name);
                    let sampler = light.with::<f64>(picture, by, vector(p), vector(normal(p)));
                    // a grid over each texel: exact by solid angle and by projected solid angle for texels that are whole
                    let varies = by == By::Area || by == By::Visible;
                    let n = (128 / image.size[0].max(image.size[1])).max(if varies { 20 } else { 6 });
                    // a patch may hide a part of itself
                    let (mut expected, mut hidden) = (vec![0.0; image.weights.len()], false);
                    for [x, y] in image.texels() {
                        for k in 0..n * n {
                            let at = [k % n, k / n].map(|i| (i as f64 + 0.5) / n as f64);
                            let uv = image.place(x, y, at);
                            if let Some((w, steradians)) = light.seen(p, uv) {
                                let hit = sampler.light.hit(vector(w));
                                hidden |= light == Patch && (hit.uv.x - uv[0]).abs() > 1e-6;
                                expected[y * image.size[0] + x] += hit.pdf * steradians / (n * n) as f64;
                            }
                        }
                        expected[y * image.size[0] + x] /= image.weights.len() as f64;
                    }
                    let sum: f64 = expected.iter().sum();
                    let mut observed = vec![0_u64; image.weights.len() + 1];
                    let count = 4000;
                    for _ in 0..count {
                        let s = (sampler.draw)(Vec2::new(random.unit().into(), random.unit().into()));
                        let visible = s.light.pdf > 0.0 && (light != Ball || s.light.emits);
                        let slot =
                            if visible { (s.y as usize) * image.size[0] + s.x as usize } else { image.weights.len() };
                        observed[slot] += 1;
                    }
                    // texels that the horizon cuts are not known well enough
                    let cut = |uv| light.point(uv).is_none_or(|(point, _)| dot(sub(point, p), normal(p)) < 0.0);
                    let cut = by == By::Projected && [[0.0; 2], [1.0, 0.0], [0.0, 1.0], [1.0; 2]].into_iter().any(cut);
                    // beyond the rim, behind, and below the horizon there is no sample
                    let missed = observed[image.weights.len()] as f64 / f64::from(count);
                    let whole = light.region() == Region::Square && light != Ball && by != By::Projected;
                    let nothing = sum < 1e-6;
                    let near = 0.05 + if by == By::Area || light == Patch || light == Ball { 0.1 } else { 0.0 };
                    assert!(
                        nothing || cut || (sum + missed - 1.0).abs() < near,
                        "{name}: ∫pdf = {sum}, {missed} of samples without"
                    );
                    assert!(!whole || nothing || missed == 0.0, "{name}: {missed} of samples have no pdf");
                    // the quadrature's error at the horizon counts above, not below
                    let several = !cut && !hidden && expected.iter().filter(|&&e| e > 0.01).count() > 1;
                    if (sum + missed - 1.0).abs() < 0.01 && sum > 0.1 && several {
                        let drawn: u64 = observed[..image.weights.len()].iter().sum();
                        let expected: Vec<_> = expected.iter().map(|e| (e / sum).max(1e-9) * drawn as f64).collect();
                        observed.truncate(image.weights.len());
                        let p = stats::chi_square(&observed, &expected);
                        assert!(p > SIGNIFICANCE, "{name}: {p}");
                    }
                }
            }
        }
    }
}

/// The mean of radiance over pdf is ∫L dω (∫L cosθ dω by projected solid angle), and in whole texels hardly varies.
#[test]
fn samples_are_worth_the_light() {
    let count = 9216;
    for light in LIGHTS {
        for image in images().iter().filter(|image| ["flat", "half of it black"].contains(&image.name)) {
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
                    let n = cases(600, 1600) / image.size[0].max(image.size[1]);
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

/// A sample's direction has the pdf that is reported and leads back to its `u`, and double precision agrees with single.
#[test]
fn closed() {
    let mut random = Random::new(6);
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
                        // the nearest point of a patch may be another one
                        if light == Patch && (back.distance / s.light.distance - 1.0).abs() > 1e-9 {
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
                    }
                }
            }
        }
    }
}

/// No texel with radiance is lost, however little it has: its directions have a pdf.
#[test]
fn all_texels_have_a_chance() {
    for light in LIGHTS {
        for image in images() {
            let mut buffer = image.buffer();
            let picture = image.build(light, &mut buffer);
            for p in POINTS {
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
                            if lit && visible && inside && (light != Patch || here) {
                                assert!(hit.pdf > 0.0, "{name}: lost, {hit:?}");
                            }
                        }
                    }
                }
            }
        }
    }
}

fn bits<R: Real>(sampler: &Sampler<'_, R>, u: Vec2<R>, w: Vec3<R>, i: usize) -> [u64; 14] {
    let s = (sampler.draw)(u);
    let (hit, back) = (sampler.light.hit(w), sampler.light.invert(w).at(i));
    let LightSample { direction, distance, pdf, uv, emits, .. } = s.light;
    let [x, y, z] = direction.at(i);
    let [s_at, t_at, _] = uv.at(i);
    let float = [x, y, z, distance.lane_f64(i), pdf.lane_f64(i), s_at, t_at, hit.pdf.lane_f64(i), back[0], back[1]];
    let whole = [s.x.lane(i), s.y.lane(i), emits.lane(i).into(), hit.emits.lane(i).into()].map(u64::from);
    core::array::from_fn(|k| if k < 10 { float[k].to_bits() } else { whole[k - 10] })
}

/// Any point, direction and contents of a buffer give finite results and an inverse in the square, with the same bits at every width.
#[test]
fn any_bits_in_every_lane() {
    let mut random = Random::new(7);
    for light in LIGHTS {
        for (round, image) in images().iter().enumerate() {
            let mut buffer = image.buffer();
            image.build(light, &mut buffer);
            if round % 4 == 3 {
                buffer.iter_mut().for_each(|share| *share = random.any_f32());
            }
            let picture = Picture::from_buffer(&buffer, image.size, light.region()).unwrap();
            assert_eq!((picture.size(), picture.region()), (image.size, light.region()));
            for (k, &by) in light.measures().iter().enumerate() {
                let hostile = (round + k) % 2 == 0;
                let near = |r: &mut Random| r.direction().map(|x| (2.0 * x) as f32);
                let any = |r: &mut Random| if hostile { generators::nasty(r) } else { near(r) };
                let p: [[f32; 3]; 8] = core::array::from_fn(|_| any(&mut random));
                let n: [[f32; 3]; 8] = core::array::from_fn(|_| random.direction().map(|x| x as f32));
                let w: [[f32; 3]; 8] = core::array::from_fn(|_| any(&mut random));
                let u: [[f32; 2]; 8] = core::array::from_fn(|_| [random.unit(), random.unit()]);
                let (p16, n16, w16) = (twice(&p), twice(&n), twice(&w));
                let eight = light.with::<f32x8>(picture, by, vectors_of(|i| p[i]), vectors_of(|i| n[i]));
                let sixteen = light.with::<f32x16>(picture, by, vectors_of(|i| p16[i]), vectors_of(|i| n16[i]));
                for i in 0..8 {
                    let name = format!("{light:?} {by:?} {:?} from {:?} along {:?}", image.size, p[i], w[i]);
                    let alone = light.with::<f32>(picture, by, vectors_of(|_| p[i]), vectors_of(|_| n[i]));
                    let one = bits(&alone, squares_of(&u[i..=i]), vectors_of(|_| w[i]), 0);
                    assert_eq!(one, bits(&eight, squares_of(&u), vectors_of(|i| w[i]), i), "{name}");
                    for lane in [i, 15 - i] {
                        let same = bits(&sixteen, squares_of(&twice(&u)), vectors_of(|i| w16[i]), lane);
                        assert_eq!(one, same, "{name}");
                    }
                    let first = i / 4 * 4;
                    let (p4, n4) = (vectors_of(|k| p[first + k]), vectors_of(|k| n[first + k]));
                    let four = light.with::<f32x4>(picture, by, p4, n4);
                    let same = bits(&four, squares_of(&u[first..first + 4]), vectors_of(|k| w[first + k]), i % 4);
                    assert_eq!(one, same, "{name}");
                    let float = |k: usize| f64::from_bits(one[k]);
                    assert!((0..10).all(|k| float(k).is_finite()), "{name}: {one:?}");
                    assert!(float(4) >= 0.0 && float(7) >= 0.0, "{name}: {one:?}");
                    assert!([5, 6, 8, 9].iter().all(|&k| (0.0..=1.0).contains(&float(k))), "{name}: {one:?}");
                    assert!([8, 9].iter().all(|&k| float(k) < 1.0), "{name}: {one:?}");
                    assert!(one[10] < image.size[0] as u64 && one[11] < image.size[1] as u64, "{name}: {one:?}");
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

#[test]
fn faulty_pictures() {
    let mut buffer = [0.0; Picture::buffer(2, 2)];
    let mut build = |weights: &[f32], width, region| Picture::build(weights, width, region, &mut buffer).err();
    use TableError::{Empty, Length, Weight};
    assert_eq!(build(&[0.0; 4], 2, Region::Square), Some(Empty));
    assert_eq!(build(&[1.0; 4], 0, Region::Square), Some(Length));
    assert_eq!(build(&[1.0; 4], 3, Region::Square), Some(Length));
    assert_eq!(build(&[1.0; 16], 4, Region::Square), Some(Length));
    assert_eq!(build(&[], 2, Region::Square), Some(Length));
    for wrong in [f32::NAN, f32::INFINITY, -1.0] {
        assert_eq!(build(&[1.0, wrong, 1.0, 1.0], 2, Region::Square), Some(Weight));
    }
    // all of it is beyond the diagonal
    let mut corner = [0.0; 16];
    corner[15] = 1.0;
    let mut buffer = [0.0; Picture::buffer(4, 4)];
    assert_eq!(Picture::build(&corner, 4, Region::Triangle, &mut buffer).err(), Some(Empty));
    assert!(Picture::build(&corner, 4, Region::Square, &mut buffer).is_ok());
    assert!(Picture::from_buffer(&buffer, [4, 4], Region::Square).is_ok());
    for size in [[4, 5], [0, 4], [1 << 25, 1]] {
        assert_eq!(Picture::from_buffer(&buffer, size, Region::Square).err(), Some(Length));
    }
    for [w, h] in [[1, 1], [1, 1000], [17, 5], [1024, 1024], [1025, 3]] {
        let length = Picture::buffer(w, h);
        assert!(length + 1 >= w * h && length < 4 * w * h + 64, "{w} × {h}: {length}");
    }
}

/// The means are those of the interpolation, by quadrature.
#[test]
fn means_of_interpolated_texels() {
    let mut random = Random::new(8);
    let (w, h) = (5, 4);
    let values: Vec<f32> = (0..w * h).map(|_| random.unit()).collect();
    let at = |x: i64, y: i64| f64::from(values[y.clamp(0, 3) as usize * w + x.clamp(0, 4) as usize]);
    let interpolated = |x: f64, y: f64| {
        let (x, y) = (x - 0.5, y - 0.5);
        let (i, j, s, t) = (x.floor() as i64, y.floor() as i64, x - x.floor(), y - y.floor());
        let row = |j| at(i, j) * (1.0 - s) + at(i + 1, j) * s;
        row(j) * (1.0 - t) + row(j + 1) * t
    };
    for (x, y) in (0..w * h).map(|i| (i % w, i / w)) {
        let n = 100;
        let point = |k: usize| [k % n, k / n].map(|i| (i as f64 + 0.5) / n as f64);
        let sum: f64 = (0..n * n).map(point).map(|[s, t]| interpolated(x as f64 + s, y as f64 + t)).sum();
        let mean = f64::from(mean_of_bilinear(&values, w, [x, y]));
        assert!((mean - sum / (n * n) as f64).abs() < 1e-4, "{x}, {y}: {mean}");
    }
}

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

/// Interpolated pictures: samples are worth ∫L dω, those from afar all the same, and lead back to their `u`.
#[test]
fn interpolated_pictures() {
    let mut random = Random::new(9);
    for light in LIGHTS.into_iter().filter(|light| light.region() == Region::Square) {
        for [width, height] in [[1, 1], [2, 5], [16, 9]] {
            // some texels are dark, and some very bright
            let values: Vec<f32> = (0..width * height)
                .map(|i| if i % 4 == 3 { 0.0 } else { 0.01 + random.unit().powi(6) * 50.0 })
                .collect();
            let mut buffer = vec![0.0; Picture::buffer(width + 1, height + 1)];
            Picture::interpolated(&values, width, &mut buffer).unwrap();
            let picture = Picture::interpolated_from_buffer(&values, width, &buffer).unwrap();
            assert_eq!(picture.size(), [width + 1, height + 1]);
            for p in POINTS {
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
                        if light == Patch && (back.distance / s.distance - 1.0).abs() > 1e-9 {
                            continue;
                        }
                        let cell = [back.uv.x * width as f64 - 0.5, back.uv.y * height as f64 - 0.5];
                        if cell.iter().any(|x| (x - x.round()).abs() < 1e-7) {
                            continue;
                        }
                        assert!((back.pdf / s.pdf - 1.0).abs() < 1e-5, "{name}: {back:?}, expected {s:?}");
                        let again = sampler.light.invert(s.direction).at(0);
                        let off = (again[0] - u[0]).abs().max((again[1] - u[1]).abs());
                        assert!(off < 2e-6, "{name}: {again:?}, expected {u:?}");
                    }
                    let (mean, m) = (sum / count, cases(600, 2400));
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
