//! Tries a sampler at all places, and says where it is wrong.

use super::definition::Definition;
use super::figures::Trial;
use super::measured::{Figure, Measured};
use super::observe::{Questions, ask};
use super::sampler::{Prepared, Subject, measure_name, shape_name};
use super::scene::{Axis, JudgedPlace, place, places};
use crate::area_lights::{AreaLight, LightShape};
use crate::random::Random;
use crate::suite::quietly;
use serde::{Deserialize, Serialize};
use std::hint::black_box;
use std::time::Instant;

/// A place and what was found there.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Case {
    /// What is not ordinary there.
    pub axis: Axis,
    /// Its value.
    pub value: f64,
    /// What was measured; nothing if the sampler does not claim to be right there.
    pub figures: Vec<Measured>,
}

/// Something that is wrong.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Finding {
    /// What.
    pub figure: Figure,
    /// Its greatest value.
    pub value: f64,
    /// A sentence that says what is wrong, and where.
    pub said: String,
    /// The smallest input that shows it, as text.
    pub input: String,
}

/// What is said about a sampler.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Judgement {
    /// The sampler's name.
    pub name: String,
    /// The shape that it samples.
    pub shape: String,
    /// What it claims to be uniform by.
    pub measure: String,
    /// Where it claims to be right; empty if everywhere.
    pub domain: String,
    /// All places.
    pub cases: Vec<Case>,
    /// What is wrong.
    pub findings: Vec<Finding>,
    /// Nanoseconds to prepare a light and draw a sample; 0 if it was not measured.
    pub nanoseconds: f64,
    /// Seconds that the judgement took.
    pub seconds: f64,
    /// Greatest error of single samples over sizes and a second axis; none if there was no time for it.
    pub map: Option<Map>,
}

/// Errors over two axes.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Map {
    /// The axis to the right, and its values.
    pub across: (Axis, Vec<f64>),
    /// The axis upwards, and its values.
    pub up: (Axis, Vec<f64>),
    /// Errors row by row, from the bottom; negative where the sampler does not claim to be right.
    pub errors: Vec<f64>,
}

impl Judgement {
    /// Without times and a map.
    #[must_use]
    pub fn new(name: &str, shape: &str, measure: &str, cases: Vec<Case>, findings: Vec<Finding>) -> Self {
        let [name, shape, measure] = [name, shape, measure].map(String::from);
        Self { name, shape, measure, domain: String::new(), cases, findings, nanoseconds: 0.0, seconds: 0.0, map: None }
    }
    /// Nothing is wrong.
    #[must_use]
    pub fn is_right(&self) -> bool {
        self.findings.is_empty()
    }
    /// Greatest relative error of a pdf or of irradiance over all places, and of whatever else is wrong; 1 for what has no size, such as
    /// nonsense.
    #[must_use]
    pub fn worst(&self) -> f64 {
        let all = self.cases.iter().flat_map(|c| &c.figures);
        all.map(|m| match m.figure {
            Figure::Density | Figure::TwoPdfs => m.value,
            Figure::Nonsense | Figure::Dark | Figure::Answer | Figure::Frequencies | Figure::Stray
                if m.is_finding() =>
            {
                1.0
            }
            _ if m.is_finding() => m.value,
            _ => 0.0,
        })
        .fold(0.0, |worst, value| if value.is_nan() { 1.0 } else { f64::max(worst, value) })
    }
    /// Numbers of places at which it is right, and at which it claims to be.
    #[must_use]
    pub fn share(&self) -> [usize; 2] {
        let tried: Vec<_> = self.cases.iter().filter(|c| !c.figures.is_empty()).collect();
        [tried.iter().filter(|c| c.figures.iter().all(|m| !m.is_finding())).count(), tried.len()]
    }
}

/// How much to do.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
pub struct Effort {
    /// Half of the places, and a quarter of the samples.
    pub quick: bool,
    /// Decides the positions and the random numbers.
    pub seed: u64,
    /// Whether to measure time and to draw maps.
    pub page: bool,
}

/// Judges a sampler; `before` hears of each place before the sampler does.
#[must_use]
pub fn judge(subject: &Subject<'_>, effort: Effort, mut before: impl FnMut(&str)) -> Judgement {
    let start = Instant::now();
    let mut cases = Vec::new();
    let mut lights = Vec::new();
    for JudgedPlace { axis, value, light } in places(subject.shape, subject.by, effort.quick, effort.seed) {
        before(&text(&light));
        cases.push(Case { axis, value, figures: figures(subject, &light, effort) });
        lights.push(light);
    }
    let findings = findings(&cases, |figure, at| {
        // a smaller input
        let mut smaller = |light: &AreaLight| {
            before(&text(light));
            figures(subject, light, effort).into_iter().find(|m| m.figure == figure && m.is_finding())
        };
        let (light, measured) = super::shrink::smallest(lights[at], &mut smaller);
        let measured = measured.or_else(|| cases[at].figures.iter().find(|m| m.figure == figure).cloned());
        format!("{}\n{}", text(&light), measured.map_or(String::new(), |m| m.at))
    });
    let (shape, measure) = (shape_name(subject.shape), measure_name(subject.by));
    Judgement {
        domain: subject.domain.clone(),
        nanoseconds: if effort.page { nanoseconds(subject) } else { 0.0 },
        map: effort.page.then(|| map(subject, effort.seed, &mut before)),
        seconds: start.elapsed().as_secs_f64(),
        ..Judgement::new(&subject.name, shape, measure, cases, findings)
    }
}

/// All figures at a place; a panic is one. None where the sampler does not claim to be right.
#[must_use]
pub fn figures(subject: &Subject<'_>, light: &AreaLight, effort: Effort) -> Vec<Measured> {
    let Some(seen) = Definition::new(light) else { return Vec::new() };
    let questions = Questions::new(&seen, subject.by, effort.quick, effort.seed);
    let answers = quietly(|| match (subject.prepare)(light) {
        Prepared::OutsideOfDomain => None,
        Prepared::Nothing => Some(super::observe::Answers {
            samples: vec![None; questions.us.len()],
            pdfs: if subject.lacks.pdf { Vec::new() } else { vec![0.0; questions.directions.len()] },
            ..Default::default()
        }),
        Prepared::Ready(sampler) => Some(ask(&*sampler, &questions, subject.lacks)),
    });
    match answers {
        Err(message) => vec![Measured::unanswered(&message)],
        Ok(None) => Vec::new(),
        Ok(Some(answers)) => {
            let Subject { by, lacks, .. } = *subject;
            Trial { seen: &seen, by, lacks, questions: &questions, answers: &answers }.figures()
        }
    }
}

/// Figures that follow from another one, which is the one to tell of.
const FOLLOWS: [(Figure, Figure); 9] = [
    (Figure::TwoPdfs, Figure::Density),
    (Figure::Integral, Figure::Density),
    (Figure::Integral, Figure::TwoPdfs),
    (Figure::Frequencies, Figure::Density),
    (Figure::Jacobian, Figure::Density),
    (Figure::Jacobian, Figure::Frequencies),
    (Figure::Placement, Figure::Frequencies),
    (Figure::Placement, Figure::Density),
    (Figure::Stray, Figure::Outside),
];

/// One finding for each figure that does not follow from another one, the gravest first.
pub fn findings(cases: &[Case], mut input: impl FnMut(Figure, usize) -> String) -> Vec<Finding> {
    let mut found: Vec<Figure> = Vec::new();
    for m in cases.iter().flat_map(|c| &c.figures).filter(|m| m.is_finding()) {
        if !found.contains(&m.figure) {
            found.push(m.figure);
        }
    }
    let mut all = Vec::new();
    for &figure in &found {
        let failed = |c: &Case| c.figures.iter().any(|m| m.figure == figure && m.is_finding());
        if FOLLOWS.iter().any(|(this, other)| {
            *this == figure
                && found.contains(other)
                && cases.iter().all(|c| !failed(c) || c.figures.iter().any(|m| m.figure == *other && m.is_finding()))
        }) {
            continue;
        }
        let value = |c: &Case| {
            let values = c.figures.iter().filter(|m| m.figure == figure && m.is_finding());
            values.map(|m| if m.value.is_nan() { f64::INFINITY } else { m.value }).fold(0.0, f64::max)
        };
        let greatest = cases.iter().map(value).fold(0.0, f64::max);
        let places = regions(cases, failed);
        let first = cases.iter().position(failed).unwrap_or(0);
        // an ordinary place is the simplest to show
        let said = format!("{} {}", figure.said(greatest), places.join(", "));
        all.push(Finding { figure, value: greatest, said, input: input(figure, first) });
    }
    all.sort_by_key(|finding| finding.figure);
    all
}

/// Where cases fail, in words.
fn regions(cases: &[Case], failed: impl Fn(&Case) -> bool) -> Vec<String> {
    let tried = |axis: Axis| cases.iter().filter(move |c| c.axis == axis && !c.figures.is_empty());
    let count = cases.iter().filter(|c| failed(c)).count();
    let all = cases.iter().filter(|c| !c.figures.is_empty()).count();
    if count == all || tried(Axis::Ordinary).count() > 0 && tried(Axis::Ordinary).all(&failed) {
        return vec![if count == all { "everywhere".into() } else { "at ordinary places".into() }];
    }
    let mut axes: Vec<Axis> = cases.iter().map(|c| c.axis).collect();
    axes.dedup();
    let of = |axis: Axis| -> Option<String> {
        let values: Vec<(f64, bool)> = tried(axis).map(|c| (c.value, failed(c))).collect();
        let wrong: Vec<f64> = values.iter().filter(|v| v.1).map(|v| v.0).collect();
        let (&low, &high) = (wrong.first()?, wrong.last()?);
        if wrong.len() == values.len() || axis == Axis::Ordinary {
            return Some(match axis {
                Axis::Ordinary => format!("at {} of {} ordinary places", wrong.len(), values.len()),
                Axis::Flipped => axis.said([None; 2]),
                _ => format!("at any {}", axis.name()),
            });
        }
        // no bound where the axis ends
        let (lowest, highest) = (values[0].1, values[values.len() - 1].1);
        Some(axis.said([(!lowest || highest).then_some(low), (!highest || lowest).then_some(high)]))
    };
    axes.into_iter().filter_map(of).collect()
}

/// A light, a point and a normal as text.
#[must_use]
pub fn text(light: &AreaLight) -> String {
    let AreaLight { shape, p, a, b, c, n, radius, .. } = *light;
    let plus = |e: [f32; 3]| -> [f32; 3] { core::array::from_fn(|k| a[k] + e[k]) };
    let lamp = match shape {
        LightShape::Sphere => format!("centre {a:?}, radius {radius:?}"),
        LightShape::Triangle => format!("corners {a:?}, {:?}, {:?}", plus(b), plus(c)),
        LightShape::Disk => format!("centre {a:?}, normal {b:?}, radius {radius:?}"),
        _ => format!("corner {a:?}, edges {b:?}, {c:?}"),
    };
    format!("{}: {lamp}\npoint {p:?}, normal {n:?}", shape_name(shape))
}
/// The numbers of a light as the header orders them: those of the core, but for the corners of triangles.
#[must_use]
pub fn numbers(light: &AreaLight) -> Vec<f32> {
    let AreaLight { shape, a, b, c, .. } = *light;
    let plus = |e: [f32; 3]| -> [f32; 3] { core::array::from_fn(|k| a[k] + e[k]) };
    if shape == LightShape::Triangle { [a, plus(b), plus(c)].concat() } else { light.numbers() }
}

/// Nanoseconds to prepare a light and draw a sample, at an ordinary place.
fn nanoseconds(subject: &Subject<'_>) -> f64 {
    let light = place(subject.shape, subject.by, &[], &mut Random::new(7));
    let us = crate::generators::square(128, 3);
    let mut times = Vec::new();
    for _ in 0..15 {
        let start = Instant::now();
        let ran = quietly(|| {
            for u in &us {
                if let Prepared::Ready(sampler) = (subject.prepare)(black_box(&light)) {
                    black_box(sampler.sample(*u));
                }
            }
        });
        if ran.is_err() {
            return 0.0;
        }
        times.push(start.elapsed().as_secs_f64() * 1e9 / us.len() as f64);
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// The greatest error of single samples over sizes, and elevations or the horizon.
fn map(subject: &Subject<'_>, seed: u64, before: &mut impl FnMut(&str)) -> Map {
    let second = if subject.shape == LightShape::Sphere { Axis::Horizon } else { Axis::Elevation };
    let axes = [Axis::Size, second].map(|axis| (axis, axis.values(subject.shape, false)));
    let mut random = Random::new(seed);
    let mut errors = Vec::new();
    for &up in &axes[1].1 {
        for &across in &axes[0].1 {
            let light = place(subject.shape, subject.by, &[(axes[0].0, across), (axes[1].0, up)], &mut random);
            before(&text(&light));
            let all = figures(subject, &light, Effort { quick: true, seed, page: false });
            let of = |m: &Measured| match m.figure {
                Figure::Density | Figure::TwoPdfs | Figure::Outside => m.value,
                _ if m.is_finding() => 1.0,
                _ => 0.0,
            };
            errors.push(if all.is_empty() { -1.0 } else { all.iter().map(of).fold(0.0, f64::max) });
        }
    }
    let [across, up] = axes;
    Map { across, up, errors }
}
