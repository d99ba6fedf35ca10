//! Warps without parameters.

use super::{
    INSIDE, STEPS, at_least, direction, length, limit, margins, outputs, over_margin, pair, point, relative,
    unit_square,
};
use crate::interval::Interval;
use crate::search::{Range, Statement, Theorem, Trial};
use crate::tape;
use crate::traced::Traced;
use core::f64::consts::{FRAC_1_PI, PI};
use etendue::warp::{AreaTriangle, ConcentricDisk, CosineHemisphere, Warp};
use etendue::{Mask, Real, f32x8};

/// So many values next to an end are tried one by one.
const TRIED: u32 = 4;
/// The pdf of a disk is positive up to x² + y² = 1 + 4e−7, rounded.
const RIM: f64 = 3.9e-7;
fn at_most(u: Traced, step: u32) -> bool {
    u.computed().hi <= f64::from(step) / f64::from(STEPS)
}
/// The concentric map, by angles.
fn concentric([u, v]: [f64; 2]) -> [f64; 2] {
    let (a, b) = (2.0 * u - 1.0, 2.0 * v - 1.0);
    if a == 0.0 && b == 0.0 {
        return [0.0, 0.0];
    }
    let (r, angle) = if a.abs() > b.abs() { (a, PI / 4.0 * (b / a)) } else { (b, PI / 2.0 - PI / 4.0 * (a / b)) };
    [r * angle.cos(), r * angle.sin()]
}

pub(super) struct Disk;
impl Disk {
    fn outputs<R: Real>(&self, x: &[R]) -> Vec<R> {
        point(ConcentricDisk.sample(pair(x)))
    }
}
impl Theorem for Disk {
    outputs!();
    fn statement(&self) -> Statement {
        Statement {
            name: "ConcentricDisk",
            domain: "all 2⁴⁸ pairs u".to_owned(),
            ranges: unit_square(),
            limits: vec![
                limit("error of the point, in radii", 2.2e-7),
                limit("relative error of the pdf", 6e-8),
                INSIDE,
            ],
        }
    }
    fn bounds(&self, x: &[Traced]) -> Vec<f64> {
        let p = ConcentricDisk.sample(pair(x));
        let (pdf, assumed) = tape::assume(|| ConcentricDisk.pdf(p));
        // in exact arithmetic, x² + y² = r²
        let r = |u: Traced| (u.computed() * Interval::point(2.0) - Interval::point(1.0)).greatest();
        let inside = over_margin(&assumed, RIM + (1.0 - r(x[0]).max(r(x[1])).powi(2)));
        let tried = x.iter().any(|u| at_most(*u, TRIED - 1) || at_least(*u, STEPS - TRIED));
        vec![length(&[p.x, p.y]), relative(pdf), if tried { 0.0 } else { inside }]
    }
    fn trial(&self) -> Option<Trial> {
        let (all, first, last) = ((0, STEPS - 1), (0, TRIED - 1), (STEPS - TRIED, STEPS - 1));
        Some(Trial {
            what: "the pdf of samples at the rim is positive",
            ranges: vec![[first, all], [last, all], [all, first], [all, last]],
            holds: |u| ConcentricDisk.pdf(ConcentricDisk.sample(u)).gt(f32x8::splat(0.0)).all(),
        })
    }
    fn definition(&self, x: &[Traced], values: &[f64]) -> Vec<[f64; 3]> {
        let p = ConcentricDisk.sample(pair(x));
        let truth = concentric([values[0], values[1]]);
        let (pdf, assumed) = tape::assume(|| ConcentricDisk.pdf(p));
        vec![[p.x.exact(), truth[0], 1.0], [p.y.exact(), truth[1], 1.0], [pdf.exact(), FRAC_1_PI, 1.0]]
            .into_iter()
            .chain(margins(&assumed, RIM))
            .collect()
    }
}

pub(super) struct Hemisphere;
impl Hemisphere {
    fn outputs<R: Real>(&self, x: &[R]) -> Vec<R> {
        direction(CosineHemisphere.sample(pair(x)))
    }
}
impl Theorem for Hemisphere {
    outputs!();
    fn statement(&self) -> Statement {
        Statement {
            name: "CosineHemisphere",
            domain: "all pairs u but those on the edges u₀ = 0 and u₁ = 0, which are directions along the horizon"
                .to_owned(),
            ranges: vec![Range::Steps(1, (1 << 24) - 1); 2],
            limits: vec![
                limit("error of the direction, in radians", 2.4e-7),
                limit("relative error of the pdf", 2.7e-7),
            ],
        }
    }
    fn bounds(&self, x: &[Traced]) -> Vec<f64> {
        let w = CosineHemisphere.sample(pair(x));
        vec![length(&[w.x, w.y, w.z]), relative(CosineHemisphere.pdf(w))]
    }
    fn definition(&self, x: &[Traced], values: &[f64]) -> Vec<[f64; 3]> {
        let w = CosineHemisphere.sample(pair(x));
        let [a, b] = concentric([values[0], values[1]]);
        // cosθ = √(1 − r²), r the greater of |2u₀ − 1| and |2u₁ − 1|
        let r = values[..2].iter().map(|u| (2.0 * u - 1.0).abs()).fold(0.0, f64::max);
        let z = ((1.0 - r) * (1.0 + r)).sqrt();
        let pdf = CosineHemisphere.pdf(w);
        vec![[w.x.exact(), a, 1.0], [w.y.exact(), b, 1.0], [w.z.exact(), z, z], [pdf.exact(), z * FRAC_1_PI, z]]
    }
}

pub(super) struct Barycentrics;
impl Barycentrics {
    fn outputs<R: Real>(&self, x: &[R]) -> Vec<R> {
        point(AreaTriangle.sample(pair(x)))
    }
}
impl Theorem for Barycentrics {
    outputs!();
    fn statement(&self) -> Statement {
        Statement {
            name: "AreaTriangle",
            domain: "all 2⁴⁸ pairs u".to_owned(),
            ranges: unit_square(),
            limits: vec![
                limit("error of the barycentric coordinates", 1.3e-7),
                limit("relative error of the pdf", 1e-300),
                INSIDE,
            ],
        }
    }
    fn bounds(&self, x: &[Traced]) -> Vec<f64> {
        let b = AreaTriangle.sample(pair(x));
        let (pdf, assumed) = tape::assume(|| AreaTriangle.pdf(b));
        // the sum of both is √u₀
        let margin = 1.0 - x[0].computed().hi.sqrt().next_up();
        let tried = at_least(x[0], STEPS - TRIED);
        vec![length(&[b.x, b.y]), relative(pdf), if tried { 0.0 } else { over_margin(&assumed, margin) }]
    }
    fn trial(&self) -> Option<Trial> {
        Some(Trial {
            what: "the pdf of samples next to the edge opposite the first vertex is positive",
            ranges: vec![[(STEPS - TRIED, STEPS - 1), (0, STEPS - 1)]],
            holds: |u| AreaTriangle.pdf(AreaTriangle.sample(u)).gt(f32x8::splat(0.0)).all(),
        })
    }
    fn definition(&self, x: &[Traced], values: &[f64]) -> Vec<[f64; 3]> {
        let b = AreaTriangle.sample(pair(x));
        let root = values[0].sqrt();
        let pdf = tape::assume(|| AreaTriangle.pdf(b)).0;
        vec![
            [pdf.exact(), 2.0, 1.0],
            [b.x.exact(), root * (1.0 - values[1]), 1.0],
            [b.y.exact(), root * values[1], 1.0],
        ]
    }
}
