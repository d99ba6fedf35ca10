//! Flat lights with pictures.

use crate::driver::{HOSTILE, slots};
use crate::lights::{sample, vec3};
use crate::program::Driver;
use crate::tables::{Memory, module};
use etendue::light::{Picture, Region, TexelSample};
use etendue::{Disk, LightSample, LightSampler, Parallelogram, Triangle, Vec2, Vec3};
use etendue_judge::area_lights::{AreaLight, LightShape};
use etendue_judge::generators::{Random, nasty, unit_or_edge};
use etendue_oracle::tier::{cases, is_long};
use etendue_shader::*;

/// A picture in the memory of Rust, and where it is in that of a source.
struct Image {
    size: [usize; 2],
    buffer: Vec<f32>,
    /// The values between which it is interpolated, if it is.
    values: Option<Vec<f32>>,
    words: Vec<u32>,
}

impl Image {
    /// A picture with dark texels and a few that are much brighter than the others.
    fn new(size: [usize; 2], region: Region, interpolated: bool, random: &mut Random, memory: &mut Memory) -> Self {
        let [w, h] = size;
        let texel = |random: &mut Random| match random.word() % 4 {
            0 => 0.0,
            1 => random.magnitude(1e-3, 1e3) as f32,
            _ => random.unit(),
        };
        let mut weights: Vec<f32> = (0..w * h).map(|_| texel(random)).collect();
        weights[0] = 1.0;
        let bits = |of: &[f32]| of.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        let counts = [w as u32, h as u32];
        if interpolated {
            let mut buffer = vec![0.0; Picture::buffer(w + 1, h + 1)];
            Picture::interpolated(&weights, w, &mut buffer).unwrap();
            let words = [memory.add(bits(&buffer)), memory.add(bits(&weights))];
            return Self { size, buffer, values: Some(weights), words: [words, counts].concat() };
        }
        let mut buffer = vec![0.0; Picture::buffer(w, h)];
        Picture::build(&weights, w, region, &mut buffer).unwrap();
        let words = [&[memory.add(bits(&buffer))][..], &counts].concat();
        Self { size, buffer, values: None, words }
    }
    fn picture(&self, region: Region) -> Picture<'_> {
        let picture = match &self.values {
            Some(values) => Picture::interpolated_from_buffer(values, self.size[0], &self.buffer),
            None => Picture::from_buffer(&self.buffer, self.size, region),
        };
        picture.unwrap()
    }
}

/// What the functions return for one light.
struct Right<'a> {
    wanted: &'a Wanted,
    u: Vec2<f32>,
    w: Vec3<f32>,
}
impl Right<'_> {
    fn of(&self, draw: impl Fn(Vec2<f32>) -> TexelSample<f32>, sampler: &impl LightSampler<f32>) -> Vec<f32> {
        let mut all = Vec::new();
        let TexelSample { light, x, y } = draw(self.u);
        let add = |s: &LightSample<f32>, all: &mut Vec<f32>| sample(s, self.wanted, all);
        add(&light, &mut all);
        all.extend([0.0, x as f32, 0.0, y as f32]);
        add(&sampler.sample(self.u), &mut all);
        for w in [light.direction, self.w] {
            let u = sampler.invert(w);
            all.extend([sampler.pdf(w), u.x, u.y]);
            add(&sampler.hit(w), &mut all);
        }
        all
    }
}

macro_rules! right {
    ($right:ident, $on:expr, $by:expr, $p:expr, $n:expr) => {{
        let on = $on;
        match $by {
            "area" => $right.of(|u| on.by_area($p).draw(u), &on.by_area($p)),
            "solid_angle" => $right.of(|u| on.by_solid_angle($p).draw(u), &on.by_solid_angle($p)),
            _ => $right.of(|u| on.by_projected_solid_angle($p, $n).draw(u), &on.by_projected_solid_angle($p, $n)),
        }
    }};
}

/// Compares a kind of light with pictures of many sizes.
fn kind(name: &str, seed: u64) {
    let (picture, rest) = name.split_once('_').unwrap();
    let (light, by) = rest.split_once("_by_").unwrap();
    let (shape, region) = match light {
        "triangle" => (LightShape::Triangle, Region::Triangle),
        "disk" => (LightShape::Disk, Region::Disk),
        _ => (LightShape::Parallelogram, Region::Square),
    };
    let shape = AreaLight::KINDS.iter().position(|known| known.0 == shape).unwrap();
    let (mut random, mut memory, wanted) = (Random::new(4300 + seed), Memory::default(), Wanted::default());
    let sizes = [[1, 1], [2, 1], [1, 3], [5, 7], [8, 8], [16, 3], [33, 20], [100, 64]];
    let interpolated = picture == "interpolated";
    let images = sizes.map(|size| Image::new(size, region, interpolated, &mut random, &mut memory));

    let (mut inputs, mut right, mut seen) = (Vec::new(), Vec::new(), 0);
    for slot in 0..2 * slots() {
        let image = &images[slot % images.len()];
        let mut of = AreaLight::any(shape, slot as u32 / 3, &mut random);
        if slot % 9 == 7 {
            match random.word() % 3 {
                0 => of.a = nasty(&mut random),
                1 => of.p = of.a,
                _ => of.c = nasty(&mut random),
            }
        }
        let mut numbers = of.numbers();
        if slot % 7 == 1 {
            let place = random.below(numbers.len());
            numbers[place] = HOSTILE[random.below(HOSTILE.len())];
        }
        let [u, v] = [(); 2].map(|()| (unit_or_edge(&mut random) as f32).min(1.0 - 1.0 / 16_777_216.0));
        let w = random.direction().map(|x| x as f32);
        let (x, p, n) = (&numbers[..], Vec3::from(of.p), Vec3::from(of.n));
        let all = Right { wanted: &wanted, u: Vec2::new(u, v), w: Vec3::from(w) };
        let picture = image.picture(region);
        let one = match light {
            "triangle" => {
                right!(all, picture.on(Triangle { v0: vec3(x), e1: vec3(&x[3..]), e2: vec3(&x[6..]) }), by, p, n)
            }
            "disk" => right!(all, picture.on(Disk { center: vec3(x), normal: vec3(&x[3..]), radius: x[6] }), by, p, n),
            _ => {
                let on = Parallelogram { corner: vec3(x), edge_s: vec3(&x[3..]), edge_t: vec3(&x[6..]) };
                right!(all, picture.on(on), by, p, n)
            }
        };
        // the pdf is the second field of one number
        seen += usize::from(one[4] > 0.0);
        right.push(one);
        let words: Vec<f32> = image.words.iter().copied().map(f32::from_bits).collect();
        inputs.push([&words[..], x, &of.p, &of.n, &[u, v], &w].concat());
    }
    assert!(seen > inputs.len() / 4, "{name}: {seen} of {} samples", inputs.len());

    let module = module(name);
    let mut driver = Driver::new(&module);
    driver.memory = memory.0;
    let draw = driver.function(&format!("{name}_draw")).unwrap();
    driver.take(draw.parameters[0].of, "picture");
    driver.take(draw.parameters[1].of, "light");
    for (parameter, leaf) in [("p", Leaf::Vec3), ("n", Leaf::Vec3), ("u", Leaf::Vec2), ("w", Leaf::Vec3)] {
        driver.take(Type::Leaf(leaf), parameter);
    }
    let arguments = |last| {
        let at: &[&str] = if by == "projected_solid_angle" { &["p", "n"] } else { &["p"] };
        [&["picture", "light"], at, &[last]].concat()
    };
    driver.output(&format!("{name}_draw"), &arguments("u"), "drawn");
    driver.output(&format!("{name}_sample"), &arguments("u"), "sampled");
    for (k, w) in ["drawn.direction", "w"].into_iter().enumerate() {
        for part in ["pdf", "invert", "hit"] {
            driver.output(&format!("{name}_{part}"), &arguments(w), &format!("{part}_{k}"));
        }
    }
    driver.same_bits(&format!("table_{name}"), cases(&["-O0"], &["-O1"]), &inputs, &right);
}

/// With few cases, those by projected solid angle are left out: their C takes seconds to compile.
#[test]
fn pictures_have_the_same_bits() {
    let names = tables().into_iter().filter(|name| name.starts_with("pictured") || name.starts_with("interpolated"));
    let mut count = 0;
    for (seed, name) in (0..).zip(names) {
        if is_long() || !name.contains("projected") {
            kind(&name, seed);
            count += 1;
        }
    }
    assert_eq!(count, cases(8, 12));
}
