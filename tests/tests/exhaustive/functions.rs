//! Functions of one argument, over all 2³² floats.

use crate::sweep::{Extent, Figure, SPARSE, SweepErrors, on_all_processors};
use core::f64::consts::{FRAC_PI_2, PI};
use etendue::math::{one_minus_cos, rsqrt};
use etendue::real::SAME_BITS;
use etendue::{Real, f32x8, u32x8};

/// The table of errors, for comparison.
const DOCUMENTATION: &str = include_str!("../../../core/src/math.rs");

const LEAST: f64 = f32::MIN_POSITIVE as f64;

fn show(bits: u64) -> String {
    format!("{bits:#010x} = {:e}", f32::from_bits(bits as u32))
}

/// A reference in double precision, and the domain in which it is called.
struct Truth<F, D> {
    of: F,
    domain: D,
}

/// As many consecutive floats as share the calls of a reference.
const BLOCK: u32 = 64;

impl<const T: usize, F: Fn(f64) -> [f64; T], D: Fn(f32) -> bool> Truth<F, D> {
    /// The reference at one float.
    fn at(&self, x: f32) -> [f64; T] {
        if (self.domain)(x) { (self.of)(f64::from(x)) } else { [f64::NAN; T] }
    }
    /// The reference at [`BLOCK`] floats. They are equally spaced and so near to each other that the parabola through three values is as
    /// good as the reference. Two further values check it to 1e−12; where it fails, each float has a call of its own. Their odd distances see
    /// periods that the even ones of the other three do not.
    fn block(&self, first: u32) -> [[f64; T]; BLOCK as usize] {
        let float = |i: u32| f32::from_bits(first + i);
        let (near, far) = (float(0), float(BLOCK - 1));
        if !(self.domain)(near) && !(self.domain)(far) {
            return [[f64::NAN; T]; BLOCK as usize];
        }
        if (self.domain)(near) && (self.domain)(far) {
            let (start, step) = (f64::from(near), f64::from(float(1)) - f64::from(near));
            let [a, p, b, q, c] = [0.0, 15.0, 32.0, 49.0, 64.0].map(|i| (self.of)(start + i * step));
            let slopes: [[f64; 2]; T] =
                core::array::from_fn(|k| [(b[k] - a[k]) / 32.0, ((c[k] - b[k]) - (b[k] - a[k])) / 2048.0]);
            let at = |k: usize, i: f64| a[k] + i * (slopes[k][0] + (i - 32.0) * slopes[k][1]);
            let close = |x: f64, truth: f64| (x - truth).abs() <= 1e-12 * truth.abs();
            if (0..T).all(|k| close(at(k, 15.0), p[k]) && close(at(k, 49.0), q[k])) {
                return core::array::from_fn(|i| core::array::from_fn(|k| at(k, i as f64)));
            }
        }
        core::array::from_fn(|i| self.at(float(i as u32)))
    }
}

/// Goes over floats, and compares the greatest errors with those of the table in the documentation.
///
/// `call` is the function, and `judge` takes a float, the results, and the reference, which is NaN outside of its domain.
fn check<const N: usize, const T: usize, const M: usize>(
    faults: &mut String,
    extent: Extent,
    name: &str,
    figures: [Figure; M],
    call: impl Fn(f32x8) -> [f32x8; N] + Sync,
    truth: Truth<impl Fn(f64) -> [f64; T] + Sync, impl Fn(f32) -> bool + Sync>,
    judge: impl Fn(f32, [f32; N], [f64; T], u64, &mut SweepErrors<M>) + Sync,
) {
    let packet = |bits: [u32; 8], truths: &[[f64; T]], found: &mut SweepErrors<M>| {
        let y = call(f32x8::new(bits.map(f32::from_bits))).map(f32x8::to_array);
        for k in 0..8 {
            let y = core::array::from_fn(|i| y[i][k]);
            judge(f32::from_bits(bits[k]), y, truths[k], u64::from(bits[k]), found);
        }
    };
    let found = if extent == Extent::All {
        on_all_processors(name, 1 << 12, |chunk, found| {
            for first in (0..1 << 20).step_by(BLOCK as usize).map(|i| (chunk << 20) as u32 + i) {
                let truths = truth.block(first);
                for i in (0..BLOCK).step_by(8) {
                    packet(core::array::from_fn(|k| first + i + k as u32), &truths[i as usize..], found);
                }
            }
        })
    } else {
        // the edges of all binades: the first numbers, the middle ones, and the last
        let edges = (0..512_u32).flat_map(|binade| {
            [0, 1, 2, 3, 0x3f_ffff, 0x40_0000, 0x7f_fffe, 0x7f_ffff].map(|fraction| binade << 23 | fraction)
        });
        let worst = figures.iter().map(|figure| figure.worst as u32);
        let sparse = (0..1_u64 << 32).step_by(SPARSE as usize).map(|i| i as u32);
        let all: Vec<u32> = edges.chain(worst).chain(sparse).collect();
        let parts: Vec<&[u32]> = all.chunks(1 << 13).collect();
        on_all_processors(name, parts.len() as u64, |part, found| {
            for eight in parts[part as usize].chunks(8) {
                let bits = core::array::from_fn(|k| eight[k % eight.len()]);
                packet(bits, &bits.map(|bits| truth.at(f32::from_bits(bits))), found);
            }
        })
    };
    faults.push_str(&found.against(name, &figures, extent, show));
    for figure in figures {
        let stated = [
            format!("`{name}`"),
            format!("{:.1e} {}", figure.documented, figure.of).replace('-', "−"),
            format!("`{:#010x}`", figure.worst),
        ];
        let is_row = |line: &str| line.starts_with("//! |") && stated.iter().all(|text| line.contains(text));
        if !DOCUMENTATION.lines().any(is_row) {
            let text = format!("core/src/math.rs has no row with {}\n", stated.join(", "));
            print!("    FAULT {text}");
            faults.push_str(&text);
        }
    }
}

fn relative(y: f32, truth: f64) -> f64 {
    (f64::from(y) / truth - 1.0).abs()
}

fn figure(of: &'static str, documented: f64, worst: u64) -> Figure {
    Figure { of, documented, worst }
}
impl Figure {
    /// Another figure in builds that round a product and a sum twice.
    fn or_twice_rounded(self, documented: f64, worst: u64) -> Self {
        if SAME_BITS { self } else { Self { documented, worst, ..self } }
    }
}

fn sines_and_arcs(all: &mut String, extent: Extent) {
    let turns = |u: f64| {
        // exact, as sine and cosine have the period 1
        let (sin, cos) = (2.0 * PI * (u - u.round_ties_even())).sin_cos();
        [sin, cos]
    };
    let domain = |u: f32| u.abs() < 2.0_f32.powi(126);
    let call = |u| <[f32x8; 2]>::from(Real::sin_cos_turns(u));
    let figures = [figure("absolute", 8.5e-8, 0x3df7_4f0d).or_twice_rounded(8.8e-8, 0x3df3_a1c3)];
    let truth = Truth { of: turns, domain };
    check(all, extent, "Real::sin_cos_turns", figures, call, truth, |u, [s, c], [sin, cos], at, found| {
        if domain(u) {
            found.error(0, (f64::from(s) - sin).abs().max((f64::from(c) - cos).abs()), at);
        } else {
            found.outside("NaN from 2¹²⁶ on", s.is_nan() && c.is_nan(), at);
        }
    });

    let figures = [
        figure("relative", 2.3e-7, 0x3eff_7323).or_twice_rounded(2.2e-7, 0x3efe_73a3),
        figure("absolute", 4.4e-7, 0xbef6_946b).or_twice_rounded(4.4e-7, 0xbef0_166b),
    ];
    let domain = |x: f32| x.abs() < 1.0 || x == -1.0;
    let truth = Truth { of: |x: f64| [x.acos()], domain };
    let call = |x| [Real::acos(x)];
    check(all, extent, "Real::acos", figures, call, truth, |x, [y], [truth], at, found| {
        if domain(x) {
            found.error(0, relative(y, truth), at);
            found.error(1, (f64::from(y) - truth).abs(), at);
        } else {
            let expected = if x < 0.0 { core::f32::consts::PI } else { 0.0 };
            found.outside("π below −1, and 0 from 1 on and of NaN", y == expected, at);
        }
    });

    // the angles of (1, v), (v, 1), (−1, v) and (v, −1): every quotient that the polynomial can have, in four octants; the other four
    // differ by the sign of y, which is copied
    let one = f32x8::splat(1.0);
    let call = |v: f32x8| [Real::atan2(v, one), Real::atan2(one, v), Real::atan2(v, -one), Real::atan2(one, -v)];
    let figures = [figure("relative", 2.1e-7, 0x3edd_381b).or_twice_rounded(2.1e-7, 0x3edb_1e7f)];
    let domain = |v: f32| (0.0..=1.0).contains(&v) && v.is_sign_positive();
    let truth = Truth { of: |v: f64| [v.atan()], domain };
    check(all, extent, "Real::atan2", figures, call, truth, |v, y, [angle], at, found| {
        if !domain(v) {
            return;
        }
        for (y, truth) in y.into_iter().zip([angle, FRAC_PI_2 - angle, PI - angle, FRAC_PI_2 + angle]) {
            if truth >= LEAST {
                found.error(0, relative(y, truth), at);
            } else {
                found.demand("v for a subnormal v", y == v, at);
            }
        }
    });
}

fn roots(all: &mut String, extent: Extent) {
    let normal = |x: f32| (f32::MIN_POSITIVE..f32::INFINITY).contains(&x);
    let figures = [
        figure("relative", 7.9e-8, 0x0e01_7605).or_twice_rounded(8.3e-8, 0x0e10_e0a4),
        figure("relative, below 2⁻¹⁰⁰", 1.1e-7, 0x00c4_dc07),
    ];
    let truth = Truth { of: |x: f64| [x.cbrt()], domain: normal };
    let call = |x| [Real::cbrt(x)];
    check(all, extent, "Real::cbrt", figures, call, truth, |x, [y], [truth], at, found| {
        if normal(x) {
            found.error(usize::from(x < 2.0_f32.powi(-100)), relative(y, truth), at);
        } else if x == f32::INFINITY {
            found.outside("NaN of infinity", y.is_nan(), at);
        } else {
            found.outside("0 of subnormal and negative numbers and of NaN", y == 0.0, at);
        }
    });

    let figures = [figure("relative", 3.5e-2, 0x20b9_a7df)];
    let truth = Truth { of: |x: f64| [x.cbrt()], domain: normal };
    let call = |x| [Real::inverse_cbrt_estimate(x)];
    check(all, extent, "Real::inverse_cbrt_estimate", figures, call, truth, |x, [y], [root], at, found| {
        if normal(x) {
            found.error(0, (f64::from(y) * root - 1.0).abs(), at);
        } else {
            found.unspecified();
        }
    });

    let figures = [figure("relative", 9e-8, 0x017f_ffff)];
    let domain = |x: f32| x > 0.0 && x < f32::INFINITY;
    let truth = Truth { of: |x: f64| [x.sqrt()], domain };
    let call = |x| [rsqrt(x)];
    check(all, extent, "rsqrt", figures, call, truth, |x, [y], [root], at, found| {
        if domain(x) {
            found.error(0, (f64::from(y) * root - 1.0).abs(), at);
        } else if x == 0.0 || x == f32::INFINITY {
            found.outside("the reciprocal of 0 and of infinity", y == 1.0 / x, at);
        } else {
            found.outside("NaN of negative numbers and of NaN", y.is_nan(), at);
        }
    });

    let figures = [figure("relative", 1.2e-7, 0x3e70_8b42)];
    let domain = |s: f32| (0.0..=1.0).contains(&s);
    let truth = Truth { of: |s: f64| [s / (1.0 + (1.0 - s).sqrt())], domain };
    let call = |s| [one_minus_cos(s)];
    check(all, extent, "one_minus_cos", figures, call, truth, |s, [y], [truth], at, found| {
        if s.is_nan() || s == f32::NEG_INFINITY {
            found.outside("NaN of NaN and of −∞", y.is_nan(), at);
        } else if s > 1.0 {
            found.outside("the argument itself above 1", y == s, at);
        } else if s < 0.0 {
            found.outside("finite for negative numbers", y.is_finite(), at);
        } else if truth >= LEAST {
            found.error(0, relative(y, truth), at);
        } else {
            found.demand("within half a step of 2⁻¹⁴⁹", (f64::from(y) - truth).abs() <= 2.0_f64.powi(-150), at);
        }
    });
}

/// A function that is exact or rounded once: each result is compared with the definition, if there is one for the argument.
fn exact(
    faults: &mut String,
    extent: Extent,
    name: &str,
    call: impl Fn(f32x8) -> f32x8 + Sync,
    is: impl Fn(f32, f32) -> Option<bool> + Sync,
) {
    let truth = Truth { of: |_| [], domain: |_: f32| false };
    check::<1, 0, 0>(
        faults,
        extent,
        name,
        [],
        |x| [call(x)],
        truth,
        |x, [y], [], at, found| match is(x, y) {
            Some(holds) => found.demand("the definition", holds, at),
            None => found.unspecified(),
        },
    );
}

fn operations(all: &mut String, extent: Extent) {
    exact(all, extent, "Real::sqrt", Real::sqrt, |x, y| {
        if !(x > 0.0 && x < f32::INFINITY) {
            // ±0 and infinity are their own roots
            return Some(if x == 0.0 || x == f32::INFINITY { y.to_bits() == x.to_bits() } else { y.is_nan() });
        }
        // the numbers halfway to the neighbours have 25 bits, so their squares are exact in double precision
        let [below, above] = [-1, 1].map(|step: i32| {
            let neighbour = f32::from_bits(y.to_bits().wrapping_add_signed(step));
            let middle = 0.5 * (f64::from(y) + f64::from(neighbour));
            middle * middle
        });
        Some(y > 0.0 && below < f64::from(x) && f64::from(x) < above)
    });
    exact(all, extent, "Real::round_ties_even", Real::round_ties_even, |x, y| {
        Some(if x.is_nan() { y.is_nan() } else { y.to_bits() == x.round_ties_even().to_bits() })
    });
    exact(all, extent, "Real::pow2_scale", Real::pow2_scale, |x, y| {
        let power = y > 0.0 && f64::from(y).to_bits() << 12 == 0 && (1.0 / y).is_finite();
        let scale = if x.is_normal() {
            (1.0..2.0).contains(&(f64::from(x.abs()) * f64::from(y)))
        } else {
            y == 2.0_f32.powi(if x.is_finite() { 127 } else { -127 })
        };
        Some(power && scale)
    });
    exact(
        all,
        extent,
        "Real::to_uint",
        |x| Real::from_uint(Real::to_uint(x)),
        |x, y| (0.0..=16_777_216.0).contains(&x).then(|| f64::from(y) == f64::from(x).floor()),
    );
    exact(
        all,
        extent,
        "Real::unit",
        |x| Real::unit(u32x8::new(x.to_array().map(f32::to_bits))),
        |x, y| Some(f64::from(y) == f64::from(x.to_bits() >> 8) / 16_777_216.0),
    );
}

fn run(functions: impl Fn(&mut String, Extent), extent: Extent) {
    let mut faults = String::new();
    functions(&mut faults, extent);
    assert!(faults.is_empty(), "\n{faults}");
}

macro_rules! tests {
    ($($group:ident),+) => {
        mod part_of_the_floats {
            $(#[test]
            fn $group() {
                super::run(super::$group, super::Extent::Part);
            })+
        }
        mod every_float {
            $(#[test]
            #[ignore = "takes one to five minutes"]
            fn $group() {
                super::run(super::$group, super::Extent::All);
            })+
        }
    };
}
tests!(sines_and_arcs, roots, operations);
