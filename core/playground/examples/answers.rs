//! What the core itself answers where the playground shows something: its tests compare the two bit by bit.
//!
//! Reads one JSON object a line, as `playground.answer()` in the page's console returns it, and writes one with the same fields, computed from
//! the light, the point, the normal, the cursor's direction and the true irradiance in it. Adds the irradiance by an independent oracle in
//! `oracle` where there is one.

use etendue::light::LightSample;
use etendue::listed::light::{Technique, TechniqueVisitor, With, every_technique};
use etendue::sequence::{OwenSobol, Sequence};
use etendue::{LightSampler, Vec2, Vec3};
use etendue_oracle::{projected_cap, projected_polygon};
use serde_json::{Value, json};
use std::io::{BufRead, Write};

/// The samples of a page, and its seed.
const COUNT: usize = 4096;
const SEED: u64 = 1;

/// Bits of single precision as numbers.
fn numbers(value: &Value) -> Vec<f32> {
    let word =
        |x: &Value| f32::from_bits(u32::try_from(x.as_u64().expect("bits are whole numbers")).expect("of 32 bits"));
    value.as_array().expect("bits are in arrays").iter().map(word).collect()
}
fn vector(x: &[f32]) -> Vec3<f32> {
    Vec3::new(x[0], x[1], x[2])
}
fn double(value: &Value) -> f64 {
    f64::from_bits(
        u64::from_str_radix(value.as_str().unwrap_or_default(), 16).expect("doubles are 16 hexadecimal digits"),
    )
}
fn hex(x: f64) -> Value {
    json!(format!("{:016x}", x.to_bits()))
}

/// Where the page looks from.
struct View {
    numbers: Vec<f32>,
    p: Vec3<f32>,
    n: Vec3<f32>,
    truth: f64,
    probe: Option<Vec3<f32>>,
}

/// The root mean square of the relative errors of the means of blocks of m values.
fn error(values: &[f64], m: usize, truth: f64) -> f64 {
    let square = |block: &[f64]| {
        let relative = block.iter().fold(0.0, |sum, x| sum + x) / m as f64 / truth - 1.0;
        relative * relative
    };
    (values.chunks(m).fold(0.0, |sum, block| sum + square(block)) / (values.len() / m) as f64).sqrt()
}

/// What the page shows of one technique.
fn technique(by: &str, sampler: &impl LightSampler<f32>, view: &View) -> Value {
    let samples: Vec<LightSample<f32>> =
        (0..COUNT as u32).map(|i| sampler.sample(OwenSobol::new(SEED).pair(0, i, 0))).collect();
    let column = |f: fn(&LightSample<f32>) -> f32| samples.iter().map(f).collect::<Vec<_>>();
    let columns = [
        column(|s| s.direction.x),
        column(|s| s.direction.y),
        column(|s| s.direction.z),
        column(|s| s.distance),
        column(|s| s.pdf),
        column(|s| s.weight()),
        column(|s| s.normal.x),
        column(|s| s.normal.y),
        column(|s| s.normal.z),
        column(|s| s.uv.x),
        column(|s| s.uv.y),
    ];
    let hash = columns.iter().flatten().fold(0x811c_9dc5_u32, |h, x| (h ^ x.to_bits()).wrapping_mul(0x0100_0193));
    let [x, y, z] = [view.n.x, view.n.y, view.n.z].map(f64::from);
    let value = |s: &LightSample<f32>| {
        let d = s.direction;
        let cos = f64::from(d.x) * x + f64::from(d.y) * y + f64::from(d.z) * z;
        if cos <= 0.0 { 0.0 } else { cos * f64::from(s.weight()) }
    };
    let values: Vec<f64> = samples.iter().map(value).collect();
    let bits = |v: &[f32]| v.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    let first = samples[0].direction;
    let probe = view.probe.map(|w| {
        let Vec2 { x, y } = sampler.invert(w);
        json!({ "pdf": sampler.pdf(w).to_bits(), "u": bits(&[x, y]) })
    });
    let errors = [1, 16, 1024].map(|m| hex(error(&values, m, view.truth)));
    json!({
        "by": by, "samples": hash, "first": bits(&[first.x, first.y, first.z]), "probe": probe, "errors": errors,
        "estimate": hex(values.iter().fold(0.0, |sum, x| sum + x) / COUNT as f64),
    })
}

/// What the page shows of the techniques of a light: those that take a point and at most a normal.
struct Techniques<'a>(&'a str, &'a View, Vec<Value>);
impl TechniqueVisitor for Techniques<'_> {
    fn visit<T: Technique>(&mut self) {
        let (entry, view) = (T::ENTRY, self.1);
        if entry.light == self.0 && entry.with() != With::Reflection {
            let (mut numbers, mut normal) = (view.numbers.iter().copied(), view.n.to_array().into_iter());
            let light = T::light(&mut || numbers.next().expect("a number"));
            let with = T::with(&mut || normal.next().expect("a coordinate"));
            self.2.push(technique(entry.by, &T::prepare(light, view.p, with), view));
        }
    }
}
fn techniques(light: &str, view: &View) -> Value {
    let mut all = Techniques(light, view, Vec::new());
    every_technique(&mut all);
    if all.2.is_empty() { json!(null) } else { json!(all.2) }
}

/// The irradiance by an oracle that shares no code with the page, for lights that it knows.
fn oracle(light: &str, view: &View) -> Option<f64> {
    let wide = |v: Vec3<f32>| [v.x, v.y, v.z].map(f64::from);
    let point = |i: usize| wide(vector(&view.numbers[3 * i..]));
    let (p, n) = (wide(view.p), wide(view.n));
    let sub = |a: [f64; 3], b: [f64; 3]| -> [f64; 3] { std::array::from_fn(|k| a[k] - b[k]) };
    let add = |a: [f64; 3], b: [f64; 3]| -> [f64; 3] { std::array::from_fn(|k| a[k] + b[k]) };
    // the normal counts with its length, as in the values of samples
    let size = etendue_oracle::length(n);
    let corners = match light {
        "Sphere" => return Some(size * projected_cap(sub(point(0), p), f64::from(view.numbers[3]), n)),
        "Triangle" => vec![point(0), add(point(0), point(1)), add(point(0), point(2))],
        "Parallelogram" | "Rectangle" => {
            let (a, s, t) = (point(0), point(1), point(2));
            vec![a, add(a, s), add(add(a, s), t), add(a, t)]
        }
        "Polygon" => (0..8).map(point).collect(),
        _ => return None,
    };
    let corners: Vec<_> = corners.into_iter().map(|c| sub(c, p)).collect();
    Some(size * projected_polygon(&corners, n))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for line in std::io::stdin().lock().lines() {
        let mut shown: Value = serde_json::from_str(&line?)?;
        let light = shown["light"].as_str().ok_or("no light")?.to_owned();
        let view = View {
            numbers: numbers(&shown["numbers"]),
            p: vector(&numbers(&shown["p"])),
            n: vector(&numbers(&shown["n"])),
            truth: double(&shown["truth"]),
            probe: shown["probe"].is_array().then(|| vector(&numbers(&shown["probe"]))),
        };
        shown["techniques"] = techniques(&light, &view);
        shown["oracle"] = json!(oracle(&light, &view));
        writeln!(std::io::stdout(), "{shown}")?;
    }
    Ok(())
}
