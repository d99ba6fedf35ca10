//! The figures of a sampler at a place, each with its limit.

use super::definition::{Chart, Definition, SIDE, middles};
use super::grid;
use super::measured::{Figure, Measured};
use super::observe::{Answers, Inverse, Questions, SETS, SLOPES, STEP, direction};
use super::sampler::{Lacks, Sample};
use crate::area_lights::Measure;
use crate::stats;
use etendue_oracle::{V3, cross, dot, length, sub, wide};

/// Least relative error that is a finding.
pub const ERROR: f64 = 1e-3;
/// Rounding of a direction in single precision that every sampler may have, in radians: four units in the last place.
const ROUNDED: f64 = 4.0 / 16_777_216.0;
/// Standard errors, from 15 degrees of freedom, that a mean may be off by: a right sampler is once in 2·10⁷ times. A judgement has some
/// thousand means.
const DEVIATIONS: f64 = 10.0;
/// The least p-value.
const SIGNIFICANCE: f64 = 1e-7;
/// Least width of a light, in radians, whose samples are binned.
const RESOLVED: f64 = 2e-4;
/// Greatest angle, in radians, over which a light is resolved up to its edge: beyond, densities by area are ten times as great there as in the
/// middle, and more in a layer that is thinner than a cell.
const WIDE: f64 = 2.2;
/// Greatest estimate, over the mean one, up to which the spread of a mean is believed.
const TAIL: f64 = 30.0;

/// A place, what was asked there and what was answered.
pub struct Trial<'a> {
    /// The light as it is seen.
    pub seen: &'a Definition,
    /// What the sampler claims to be uniform by.
    pub by: Measure,
    /// What it declares that it does not have.
    pub lacks: Lacks,
    /// What was asked.
    pub questions: &'a Questions,
    /// What was answered.
    pub answers: &'a Answers,
}

/// The mean of the sets' means, and the standard error of that.
fn mean(sets: &[f64]) -> (f64, f64) {
    let (mean, variance) = stats::mean_variance(sets);
    (mean, (variance / sets.len() as f64).sqrt())
}
impl Trial<'_> {
    /// All figures that can be measured.
    #[must_use]
    pub fn figures(&self) -> Vec<Measured> {
        let mut all = vec![self.nonsense()];
        if all[0].is_finding() {
            return all;
        }
        let drawn = self.answers.samples.iter().flatten().count();
        let expects = self.by != Measure::ProjectedSolidAngle || self.seen.irradiance(self.seen.normal()) > 0.0;
        let is_dark = drawn == 0 && expects && self.seen.solid_angle > 0.0;
        // a sampler with an eye for the horizon may draw nothing below it
        let below = self.by == Measure::Other && self.seen.irradiance(self.seen.normal()) == 0.0;
        let value = f64::from(u8::from(is_dark && !below));
        all.push(Measured { value, ..Measured::right(Figure::Dark, 0.5) });
        if drawn == 0 {
            return all;
        }
        self.single(&mut all);
        all.extend(self.hits());
        all.extend(self.inverses());
        if self.seen.size[1] > RESOLVED + 1e3 * self.seen.rounding {
            let densities = self.densities();
            // without a pdf and a measure, nothing is known of the distribution
            if !densities.is_empty() {
                self.distribution(&densities, &mut all);
                self.estimates(&densities, &mut all);
            }
        }
        all
    }

    fn nonsense(&self) -> Measured {
        let (answers, mut wrong) = (self.answers, Measured::right(Figure::Nonsense, 0.5));
        let mut take = |is_wrong: bool, said: &dyn Fn() -> String| {
            if is_wrong {
                wrong.at = if wrong.value == 0.0 { said() } else { core::mem::take(&mut wrong.at) };
                wrong.value += 1.0;
            }
        };
        for (u, s) in self.questions.us.iter().zip(&answers.samples) {
            let Some(s) = s else { continue };
            let off = (length(wide(s.direction)) - 1.0).abs();
            let is_right = off <= 1e-3 && s.pdf.is_finite() && s.pdf >= 0.0;
            take(!is_right, &|| format!("u = {u:?}: direction {:?}, pdf {:e}", s.direction, s.pdf));
        }
        let all = [(&self.questions.directions, &answers.pdfs), (&self.questions.outside, &answers.outside)];
        for (w, pdf) in all.into_iter().flat_map(|(directions, pdfs)| directions.iter().zip(pdfs)) {
            take(!(pdf.is_finite() && *pdf >= 0.0), &|| format!("direction {w:?}: pdf {pdf:e}"));
        }
        for (s, pdf) in answers.samples.iter().zip(&answers.evaluated) {
            let w = s.map(|s| s.direction);
            take(!(pdf.is_finite() && *pdf >= 0.0), &|| format!("direction {w:?}: pdf {pdf:e}"));
        }
        for Inverse { of, u, .. } in &answers.inverses {
            let w = answers.samples[*of].map(|s| s.direction);
            take(!u.iter().all(|u| u.is_finite()), &|| format!("direction {w:?}: inverse {u:?}"));
        }
        take(answers.hits.iter().any(|h| !h.1.is_finite()), &|| "a distance is no number".into());
        wrong
    }

    /// How far a direction may be off, in radians.
    fn turned(&self) -> f64 {
        ROUNDED + 4.0 * self.seen.rounding
    }
    /// Whether a direction is so far inside of the light that rounding does not lead out of it.
    fn is_inside(&self, w: V3) -> bool {
        self.seen.from_edge(w) < -(4.0 * self.turned() + self.seen.blur(w))
    }

    /// Figures of single samples.
    fn single(&self, all: &mut Vec<Measured>) {
        let mut outside = Measured::right(Figure::Outside, 2e-4);
        let [mut density, mut two] = [Figure::Density, Figure::TwoPdfs].map(|figure| Measured::right(figure, ERROR));
        let turned = self.turned();
        for (i, s) in self.answers.samples[..self.questions.single()].iter().enumerate() {
            let Some(s) = s.filter(|s| !s.is_hidden) else { continue };
            let (u, w) = (self.questions.us[i], direction(s.direction));
            let said = |what: String| format!("u = {u:?}: direction {:?}, pdf {:e}: {what}", s.direction, s.pdf);
            let beyond = self.seen.beyond(w);
            outside.take((beyond - turned).max(0.0) / self.seen.size[1], || {
                said(format!("{beyond:.3e} rad outside of the light"))
            });
            let slack = self.seen.steepness(self.by, w) * turned;
            if let Some(truth) = self.seen.density(self.by, w)
                && slack < 0.1
                && truth < 1e30
            {
                let off = ((f64::from(s.pdf) / truth - 1.0).abs() - slack).max(0.0);
                density.take(off, || said(format!("by definition {truth:e}")));
            }
            if let Some(&evaluated) = self.answers.evaluated.get(i)
                && slack < 0.1
                && s.pdf > 0.0
                && self.is_inside(w)
            {
                let off = ((f64::from(evaluated) / f64::from(s.pdf) - 1.0).abs() - slack).max(0.0);
                two.take(off, || said(format!("evaluated {evaluated:e}")));
            }
        }
        let stray = self.answers.outside.iter().zip(&self.questions.outside).filter(|p| *p.0 > 0.0);
        let at = stray.clone().next().map(|(pdf, w)| format!("direction {w:?}: pdf {pdf:e}")).unwrap_or_default();
        let part = stray.count() as f64 / self.answers.outside.len().max(1) as f64;
        all.extend([outside, density, two, Measured { figure: Figure::Stray, value: part, limit: 0.0, at }]);
    }
    fn hits(&self) -> Option<Measured> {
        let mut worst = Measured::right(Figure::Hit, ERROR);
        for &(i, distance) in &self.answers.hits {
            let s = self.answers.samples[i]?;
            let w = direction(s.direction);
            let Some(met) = self.seen.met(w).filter(|met| met.cosine > 0.05 && self.is_inside(w)) else { continue };
            let off = (f64::from(distance) / met.distance - 1.0).abs();
            let slack = 4.0 * self.turned() / met.cosine * self.seen.farthest / met.distance;
            worst.take((off - slack).max(0.0), || {
                format!("direction {:?}: distance {distance:e}, by definition {:e}", s.direction, met.distance)
            });
        }
        (!self.answers.hits.is_empty()).then_some(worst)
    }
    fn inverses(&self) -> Option<Measured> {
        let mut worst = Measured::right(Figure::Inverse, ERROR);
        for Inverse { of, u, again: [again, near @ ..] } in &self.answers.inverses {
            let (Some(s), Some(again)) = (self.answers.samples[*of], again) else { continue };
            let apart = |a: &Sample, b: &Sample| length(sub(direction(a.direction), direction(b.direction)));
            // what the rounding of the inverse itself does
            let rounded = near.iter().flatten().map(|n| apart(n, again)).fold(0.0, f64::max);
            // rounding turns the sides of the light as well, and moves what is between them by a part of its width. The lines of a map may
            // be nearly parallel to a narrow light, so that this is the same part of its length
            let slack = 4.0 * self.turned() * self.seen.size[0] / self.seen.size[1] + rounded;
            let off = (apart(&s, again) - slack).max(0.0) / self.seen.size[0];
            let beyond = u.iter().map(|u| f64::from((-u).max(u - 1.0).max(0.0))).fold(0.0, f64::max);
            worst.take(off.max(beyond), || {
                let (from, to) = (s.direction, again.direction);
                format!("u = {:?}: direction {from:?} inverts to {u:?}, which draws {to:?}", self.questions.us[*of])
            });
        }
        (!self.answers.inverses.is_empty()).then_some(worst)
    }

    /// The pdf of each direction: what was answered, or, of a sampler that evaluates none, what its measure says.
    fn densities(&self) -> Vec<f64> {
        if !self.lacks.pdf {
            return self.answers.pdfs.iter().map(|pdf| f64::from(*pdf)).collect();
        }
        let of = |w: &[f32; 3]| self.seen.density(self.by, direction(*w));
        self.questions.directions.iter().map(of).collect::<Option<_>>().unwrap_or_default()
    }
    /// Density of the samples in the chart's square, by the pdf.
    fn claimed(&self, densities: &[f64]) -> Vec<f64> {
        let directions = self.questions.directions.iter().zip(densities).take(SIDE * SIDE);
        let of = |(w, pdf): (&[f32; 3], &f64)| pdf * self.seen.steradians(self.questions.chart, direction(*w));
        directions.map(of).collect()
    }
    /// Where the chart's square goes over from one map to another one.
    fn seam(&self) -> Option<f64> {
        self.seen.seam().filter(|_| self.questions.chart == Chart::SolidAngle)
    }
    fn drawn(&self, i: usize) -> Option<Sample> {
        self.answers.samples[i].filter(|s| !s.is_hidden)
    }
    /// ∫ pdf, frequencies and places of the samples, and the map's derivative.
    fn distribution(&self, densities: &[f64], all: &mut Vec<Measured>) {
        let claimed = self.claimed(densities);
        let (integral, error) = grid::mean(&claimed, self.seam());
        // the grid resolves neither the edge that a horizon cuts nor peaks that are not known
        if self.by == Measure::ProjectedSolidAngle && claimed.iter().any(|q| *q < 0.1)
            || self.by == Measure::Other && self.seen.size[0] > WIDE
        {
            return;
        }
        let n = (self.questions.strata * self.questions.strata) as f64;
        let parts: Vec<f64> =
            (0..SETS).map(|k| self.questions.set(k).filter_map(|i| self.drawn(i)).count() as f64 / n).collect();
        let (part, spread) = mean(&parts);
        let limit = ERROR.max(error).max(DEVIATIONS * spread);
        let value = (integral - part).abs();
        if !self.lacks.pdf {
            all.push(Measured { figure: Figure::Integral, value, limit, at: format!("∫ pdf = {integral:.6}") });
        }
        // a density that the grid does not resolve has no expectations
        if error > 0.01 || part == 0.0 || integral == 0.0 {
            return;
        }
        const CELLS: usize = 8;
        let (mut observed, mut expected) = ([0_u64; CELLS * CELLS], [0.0; CELLS * CELLS]);
        let functions = |[a, b]: [f64; 2]| [a - 0.5, b - 0.5, (a - 0.5).abs() - 0.25, (b - 0.5).abs() - 0.25];
        let mut sums = [[0.0; 4]; SETS];
        let mut count = 0.0;
        for (k, sums) in sums.iter_mut().enumerate() {
            for s in self.questions.set(k).filter_map(|i| self.drawn(i)) {
                let place = self.seen.place(self.questions.chart, direction(s.direction));
                let [a, b] = place.map(|x| ((x * CELLS as f64) as usize).min(CELLS - 1));
                observed[a + b * CELLS] += 1;
                count += 1.0;
                for (sum, f) in sums.iter_mut().zip(functions(place)) {
                    *sum += f / n;
                }
            }
        }
        for (q, [x, y]) in claimed.iter().zip(middles()) {
            let cell = (x * CELLS as f64) as usize + (y * CELLS as f64) as usize * CELLS;
            expected[cell] += q * count / (integral * (SIDE * SIDE) as f64);
        }
        let p = stats::chi_square(&observed, &expected).max(1e-300);
        let value = p.log10() / SIGNIFICANCE.log10();
        all.push(Measured { figure: Figure::Frequencies, value, limit: 1.0, at: format!("p = {p:.1e}") });
        let mut worst = Measured::right(Figure::Placement, 1.0);
        for f in 0..4 {
            let values: Vec<f64> = claimed.iter().zip(middles()).map(|(q, u)| q * functions(u)[f]).collect();
            let (truth, error) = grid::mean(&values, self.seam());
            let (seen, spread) = mean(&sums.map(|sum| sum[f]));
            let limit = (2e-4 + self.turned() / self.seen.size[1]).max(DEVIATIONS * spread).max(error);
            worst.take_mean((seen - truth).abs(), limit, String::new);
        }
        all.push(worst);
        let is_resolved = (1e-3..2.0).contains(&self.seen.size[0]) && self.seen.size[1] > 0.05 * self.seen.size[0];
        if is_resolved && !self.lacks.map {
            all.extend(self.slopes());
        }
    }
    fn slopes(&self) -> Option<Measured> {
        let first = self.questions.set(SETS).start;
        let mut off: Vec<f64> = (0..SLOPES)
            .filter_map(|i| {
                let at = |k: usize| self.drawn(first + 5 * i + k);
                let [left, right, down, up] = [at(0)?, at(1)?, at(2)?, at(3)?].map(|s| wide(s.direction));
                let area = length(cross(sub(right, left), sub(up, down))) / (4.0 * STEP * STEP);
                Some((area * f64::from(at(4)?.pdf) - 1.0).abs())
            })
            .collect();
        if off.len() < SLOPES / 2 {
            return None;
        }
        off.sort_by(f64::total_cmp);
        Some(Measured { value: off[off.len() / 2], ..Measured::right(Figure::Jacobian, 0.05) })
    }

    /// Irradiance, and solid angle where the receiver's normal does not matter, by the sampler alone and with another one.
    fn estimates(&self, densities: &[f64], all: &mut Vec<Measured>) {
        let normal = self.seen.normal();
        let mut worst = [Figure::Bias, Figure::MisBias].map(|figure| Measured::right(figure, ERROR));
        let cosine = |w: V3| dot(w, normal).max(0.0);
        self.estimate(densities, &cosine, (self.seen.irradiance(normal), "irradiance"), &mut worst);
        if matches!(self.by, Measure::SolidAngle | Measure::Area) {
            self.estimate(densities, &|_| 1.0, (self.seen.solid_angle, "solid angle"), &mut worst);
        }
        all.extend(worst);
    }
    fn estimate(
        &self,
        densities: &[f64],
        f: &dyn Fn(V3) -> f64,
        (truth, what): (f64, &str),
        worst: &mut [Measured; 2],
    ) {
        if truth <= 1e-9 * self.seen.solid_angle {
            return;
        }
        let n = (self.questions.strata * self.questions.strata) as f64;
        let partner = 1.0 / self.seen.solid_angle;
        let sets = |weight: &dyn Fn(f64) -> f64| -> Vec<f64> {
            let of = |s: Sample| f(direction(s.direction)) * weight(f64::from(s.pdf));
            (0..SETS).map(|k| self.questions.set(k).filter_map(|i| self.drawn(i)).map(of).sum::<f64>() / n).collect()
        };
        let [alone, with_partner] = worst;
        let said = |of: f64| format!("{what} {of:e}, by definition {truth:e}");
        let first = self.questions.partner();
        let directions = self.questions.directions[first..].iter().zip(&densities[first..]);
        let directions: Vec<_> = directions.map(|(w, pdf)| (f(direction(*w)), *pdf)).collect();
        // rare estimates that are many times the mean tell nothing in few samples, nor what hardly a direction of the grid meets
        let greatest = directions.iter().map(|(f, pdf)| if *f > 0.0 { f / pdf } else { 0.0 }).fold(0.0, f64::max);
        let lit = directions.iter().filter(|d| d.0 > 0.0).count();
        if lit >= 4 && greatest < TAIL * truth {
            let (of, spread) = mean(&sets(&|pdf| if pdf > 0.0 { 1.0 / pdf } else { 0.0 }));
            alone.take_mean((of / truth - 1.0).abs(), ERROR.max(DEVIATIONS * spread / truth), || said(of));
        }
        // a corner above the horizon is smaller than what the grid resolves
        if lit < SIDE * SIDE / 4 {
            return;
        }
        // the partner's part of the truth, by its share in each direction: the grid's own error of f cancels, but for how shares vary
        let (own, spread) = mean(&sets(&|pdf| if pdf > 0.0 { 1.0 / (pdf + partner) } else { 0.0 }));
        let weighted = directions.iter().zip(self.seen.weights());
        let shares = weighted.map(|((f, pdf), weight)| (f * weight, partner / (pdf + partner)));
        let sum = shares.clone().map(|of| of.0).sum::<f64>();
        let share = shares.clone().map(|(f, share)| f * share).sum::<f64>() / sum;
        let varied: Vec<f64> = shares.map(|(f, of)| f * (of - share)).collect();
        let error = grid::mean(&varied, self.seen.seam()).1 / partner / truth;
        // half of a cell's width along both ends of the square
        let layer = if self.seen.size[0] > WIDE { 1.0 / SIDE as f64 } else { 0.0 };
        let limit = ERROR.max(DEVIATIONS * spread / truth).max(error).max(layer);
        with_partner.take_mean((own / truth + share - 1.0).abs(), limit, || said(own + share * truth));
    }
}
