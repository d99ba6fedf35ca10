//! Warps of one dimension, over all 2²⁴ values of `u`.

use crate::sweep::{Extent, Figure, Found, SPARSE, on_all_processors};
use core::fmt::Write;
use etendue::f32x8;
use etendue::warp::{Linear, Tent, Warp1};

const STEPS: f64 = 16_777_216.0;
const LEAST: f64 = f32::MIN_POSITIVE as f64;

/// The law that a warp is meant to have, in double precision.
trait Law: Sync {
    /// The number below which the probability is `u`.
    fn quantile(&self, u: f64) -> f64;
    /// The probability below `x`.
    fn below(&self, x: f64) -> f64;
    /// The error of a sample, in the unit of the documentation.
    fn error(&self, x: f32, truth: f64) -> f64;
}

/// Relative; for subnormal samples, whose steps are coarser, that of half a step does not count.
fn relative(x: f32, truth: f64) -> f64 {
    let error = (f64::from(x) - truth).abs();
    let error = if truth.abs() < LEAST { (error - 2.0_f64.powi(-150)).max(0.0) } else { error };
    if error == 0.0 { 0.0 } else { error / truth.abs() }
}

impl Law for Linear<f32> {
    fn quantile(&self, u: f64) -> f64 {
        let [a, b] = [self.a, self.b].map(f64::from);
        if u == 0.0 { 0.0 } else { u * (a + b) / (a + (a * a * (1.0 - u) + b * b * u).sqrt()) }
    }
    fn below(&self, x: f64) -> f64 {
        let [a, b] = [self.a, self.b].map(f64::from);
        x * (2.0 * a + (b - a) * x) / (a + b)
    }
    fn error(&self, x: f32, truth: f64) -> f64 {
        (f64::from(x) - truth).abs()
    }
}

impl Law for Tent<f32> {
    fn quantile(&self, u: f64) -> f64 {
        f64::from(self.radius) * (2.0 * u - 1.0) / (1.0 + (2.0 * u.min(1.0 - u)).sqrt())
    }
    fn below(&self, x: f64) -> f64 {
        let rest = 1.0 - x.abs() / f64::from(self.radius);
        if x < 0.0 { 0.5 * rest * rest } else { 1.0 - 0.5 * rest * rest }
    }
    fn error(&self, x: f32, truth: f64) -> f64 {
        relative(x, truth)
    }
}

/// The figures of a warp, in the order of its checks.
const OF: [&str; 4] =
    ["error of x", "steps of u of the inverse", "steps of u of the Kolmogorov distance", "fall of x to the next u"];

/// Goes over the values of `u` for each of the parameters.
///
/// If no sample falls from one `u` to the next, the Kolmogorov distance of the law that equally likely `u` give from the law that is meant
/// is the greatest difference between the probability below a sample and the part of the samples before it, or up to it. Otherwise this
/// is an upper bound, since sorting the samples can only lower it.
fn check<W: Law + core::fmt::Debug, P: Warp1<f32x8> + Sync>(
    name: &str,
    extent: Extent,
    documentation: &str,
    warps: &[W],
    packet: impl Fn(&W) -> P + Sync,
    stated: [(f64, u64, u64); 4],
) -> String {
    let figures: [Figure; 4] = core::array::from_fn(|k| {
        let (documented, warp, u) = stated[k];
        Figure { of: OF[k], documented, worst: warp << 24 | u }
    });
    let eight = |index: u64, first: u64, found: &mut Found<4>| {
        let warp = &warps[index as usize];
        let wide = packet(warp);
        let u: [f32; 8] = core::array::from_fn(|k| ((first + k as u64) as f64 / STEPS) as f32);
        let next: [f32; 8] = core::array::from_fn(|k| ((first + k as u64 + 1) as f64 / STEPS) as f32);
        let x = wide.sample(f32x8::new(u));
        let (above, inverse) = (wide.sample(f32x8::new(next)).to_array(), wide.invert(x).to_array());
        let x = x.to_array();
        for k in 0..8 {
            let at = index << 24 | (first + k as u64);
            let (u, wide) = (f64::from(u[k]), f64::from(x[k]));
            found.error(3, if above[k] < x[k] { warp.error(above[k], wide) } else { 0.0 }, at);
            found.error(0, warp.error(x[k], warp.quantile(u)), at);
            found.error(1, (f64::from(inverse[k]) - u).abs() * STEPS, at);
            let below = warp.below(wide);
            found.error(2, (below - u).abs().max((below - u - 1.0 / STEPS).abs()) * STEPS, at);
        }
    };
    let count = warps.len() as u64;
    let found = if extent == Extent::All {
        on_all_processors(name, count << 8, |chunk, found| {
            (0..1 << 13).for_each(|i| eight(chunk >> 8, (chunk & 0xff) << 16 | i << 3, found));
        })
    } else {
        on_all_processors(name, count, |index, found| {
            for first in (0..1 << 21).step_by(SPARSE as usize).map(|i| i << 3).chain([(1 << 24) - 8]) {
                eight(index, first, found);
            }
            for figure in figures.iter().filter(|figure| figure.worst >> 24 == index) {
                eight(index, figure.worst & 0xff_fff8, found);
            }
        })
    };
    let show = |at: u64| format!("u = {:#08x}/2²⁴ of `{:?}`", at & 0xff_ffff, warps[(at >> 24) as usize]);
    let mut faults = found.against(name, &figures, extent, show);
    // the comment above the type, on one line
    let comment = documentation.split("lanewise! {").find(|part| part.contains(&format!("pub struct {name} {{")));
    let words = comment.unwrap_or("").split_whitespace().filter(|word| *word != "///");
    let comment = words.collect::<Vec<_>>().join(" ");
    for (k, figure) in figures.iter().enumerate() {
        let (short, long) = (figure.documented, format!("{:.1e}", figure.documented).replace('-', "−"));
        let worst = show(figure.worst);
        let stated = match k {
            0 => format!("greatest error {long} at {worst}"),
            1 => format!("inverse within {short} · 2⁻²⁴ at {worst}"),
            2 => format!("Kolmogorov distance {short} · 2⁻²⁴ at {worst}"),
            _ if short == 0.0 => "monotone".to_owned(),
            _ => format!("x falls by up to {long} from one u to the next at {worst}"),
        };
        if !comment.contains(&stated) {
            println!("    FAULT the documentation of {name} does not say “{stated}”");
            writeln!(faults, "the documentation of {name} does not say “{stated}”").expect("text");
        }
    }
    faults
}

const LINEAR: &str = include_str!("../../../core/src/warp/linear.rs");

fn all_warps(extent: Extent) {
    let linear = [
        (1.0, 1.0),
        (0.0, 1.0),
        (1.0, 0.0),
        (3.0, 1.0),
        (1.0, 3.0),
        (0.7, 0.700_001),
        (1e-6, 1.0),
        (1.0, 1e-6),
        (1e-30, 1.0),
        (1.0, 1e-30),
        (1e38, 3e38),
        (1e-45, 3e-45),
        (0.9, 0.013),
        (0.013, 0.9),
    ]
    .map(|(a, b)| Linear { a, b });
    let tent = [1.0, 0.7, 1.9, 1e-30, 1.01e-37, 3e38].map(|radius| Tent { radius });
    let mut faults = check(
        "Linear",
        extent,
        LINEAR,
        &linear,
        |w| Linear::splat(*w),
        [(1.8e-7, 10, 0xf6_361c), (5.0, 6, 0xa7_1523), (5.7, 6, 0xf7_ffe3), (1.2e-7, 10, 0xd9_c7e7)],
    );
    faults += &check(
        "Tent",
        extent,
        LINEAR,
        &tent,
        |w| Tent::splat(*w),
        [(1.7e-7, 4, 0x47_ddb0), (2.0, 3, 0x80_0b8a), (1.7, 2, 0xe3_609c), (0.0, 0, 0)],
    );
    for u in
        (0..1 << 24).step_by(if extent == Extent::All { 1 } else { SPARSE as usize }).map(|i| i as f32 / STEPS as f32)
    {
        let x = [Linear { a: 0.0, b: -1.0 }.sample(u) - u, Tent { radius: 1e-37 }.sample(u)];
        assert_eq!(x, [0.0; 2], "degenerate warps at {u}");
    }
    assert!(faults.is_empty(), "\n{faults}");
}

#[test]
fn part_of_the_u() {
    all_warps(Extent::Part);
}

#[test]
#[ignore = "takes a minute"]
fn every_u() {
    all_warps(Extent::All);
}
