//! The judge, judged: right samplers pass, planted faults are found in seconds, and nothing that a sampler does stops it.

use etendue_judge::area_lights::{AreaLight, Measure};
use etendue_judge::lights::measured::Figure;
use etendue_judge::lights::sampler::{Prepared, Sample, Sampler, Subject, own};
use etendue_judge::lights::scene::Axis;
use etendue_judge::lights::verdict::{Case, Effort, Judgement, judge};
use etendue_judge::textbook;
use etendue_oracle::{dot, length, sub, wide};

fn judged(subject: &Subject<'_>, seed: u64) -> Judgement {
    let judgement = judge(subject, Effort { quick: true, seed, page: false }, |_| ());
    let [right, all] = judgement.share();
    println!("{}: right at {right} of {all} places, {:.2} s", judgement.name, judgement.seconds);
    for finding in &judgement.findings {
        println!("  {}\n    {}", finding.said, finding.input.replace('\n', "\n    "));
    }
    assert!(judgement.seconds < 60.0);
    judgement
}
fn has(case: &Case, figure: Figure) -> bool {
    case.figures.iter().any(|m| m.figure == figure && m.is_finding())
}

/// A subject whose samplers are changed.
fn changed(
    right: Subject<'static>,
    change: impl Fn(&AreaLight, Box<dyn Sampler>) -> Prepared<'static> + 'static,
) -> Subject<'static> {
    let prepare = right.prepare;
    let prepare = Box::new(move |light: &AreaLight| match prepare(light) {
        Prepared::Ready(sampler) => change(light, sampler),
        other => other,
    });
    Subject { prepare, ..right }
}
fn technique(name: &str) -> Subject<'static> {
    own().into_iter().find(|s| s.name == format!("etendue {name}")).expect("the core has it")
}

/// A fault, planted into a sampler of the core.
#[derive(Clone, Copy)]
struct Fault {
    sample: fn(&AreaLight, [f32; 2], &dyn Sampler) -> Option<Sample>,
    pdf: fn(&AreaLight, [f32; 3], f32) -> f32,
}
const SOUND: Fault = Fault { sample: |_, u, right| right.sample(u), pdf: |_, _, pdf| pdf };
struct Faulty(AreaLight, Box<dyn Sampler>, Fault);
impl Sampler for Faulty {
    fn sample(&self, u: [f32; 2]) -> Option<Sample> {
        (self.2.sample)(&self.0, u, &*self.1)
    }
    fn pdf(&self, direction: [f32; 3]) -> f32 {
        (self.2.pdf)(&self.0, direction, self.1.pdf(direction))
    }
}
/// The judgement of a technique of the core with a fault, which has to be found by all these figures.
fn found(name: &str, fault: Fault, by: &[Figure]) -> Judgement {
    found_in(technique(name), fault, by)
}
fn found_in(subject: Subject<'static>, fault: Fault, by: &[Figure]) -> Judgement {
    let name = subject.name.clone();
    let subject = changed(subject, move |light, sampler| {
        Prepared::Ready(Box::new(Faulty(*light, sampler, fault)) as Box<dyn Sampler>)
    });
    let judgement = judged(&subject, 1);
    for figure in by {
        assert!(judgement.findings.iter().any(|f| f.figure == *figure), "{name}: {figure:?} does not find it");
    }
    judgement
}
/// Whether a fault is found by a figure at some places of an axis, and nothing is wrong at ordinary ones.
fn only_along(judgement: &Judgement, axis: Axis, figure: Figure) -> bool {
    let mut ordinary = judgement.cases.iter().filter(|c| c.axis == Axis::Ordinary);
    ordinary.all(|c| c.figures.iter().all(|m| !m.is_finding()))
        && judgement.cases.iter().any(|c| c.axis == axis && has(c, figure))
}

#[test]
fn one_percent_of_a_pdf_is_found() {
    let sample = |_: &AreaLight, u, right: &dyn Sampler| right.sample(u).map(|s| Sample { pdf: s.pdf * 1.01, ..s });
    let pdf = |_: &AreaLight, _, pdf| pdf * 1.01;
    // in a density that is known, and in one of which nothing is
    let unknown = || Subject { by: Measure::Other, ..technique("triangle by SolidAngle") };
    for (subject, figure) in [
        (&(|| technique("sphere by SolidAngle")) as &dyn Fn() -> Subject<'static>, Figure::Density),
        (&unknown, Figure::Integral),
    ] {
        found_in(subject(), Fault { sample, pdf }, &[figure, Figure::Bias]);
        found_in(subject(), Fault { pdf, ..SOUND }, &[Figure::TwoPdfs, Figure::MisBias]);
    }
}

#[test]
fn a_thousandth_of_a_direction_is_found() {
    // about the z axis
    fn turned(_: &AreaLight, u: [f32; 2], right: &dyn Sampler) -> Option<Sample> {
        let ((s, c), sample) = (1e-3_f32.sin_cos(), right.sample(u)?);
        let [x, y, z] = sample.direction;
        Some(Sample { direction: [c * x - s * y, s * x + c * y, z], ..sample })
    }
    // draws the same light; the pdf does not know
    fn crowded(_: &AreaLight, u: [f32; 2], right: &dyn Sampler) -> Option<Sample> {
        right.sample([u[0] - 2e-3 * (core::f32::consts::PI * u[0]).sin(), u[1]].map(|u| u.max(0.0)))
    }
    for name in ["sphere by SolidAngle", "rectangle by SolidAngle", "disk by Area"] {
        found(name, Fault { sample: turned, ..SOUND }, &[Figure::Outside]);
    }
    found("triangle by SolidAngle", Fault { sample: crowded, ..SOUND }, &[Figure::Placement]);
}

/// What a light is scaled by, if it is much.
fn scale(light: &AreaLight) -> f32 {
    let distance = length(sub(wide(light.a), wide(light.p))) as f32;
    if distance > 100.0 { distance } else { 1.0 }
}

#[test]
fn faults_that_authors_have_found_by_hand_are_found() {
    // the pdf, and it alone, knows a horizon, and the receiver's normal is flipped
    let horizon = Fault { pdf: |light, w, pdf| if dot(wide(light.n), wide(w)) > 0.0 { pdf } else { 0.0 }, ..SOUND };
    let judgement = found("rectangle by SolidAngle", horizon, &[Figure::TwoPdfs, Figure::MisBias]);
    assert!(only_along(&judgement, Axis::Flipped, Figure::TwoPdfs));
    // two thirds of a disk are drawn
    let two_thirds = Fault { sample: |_, u, right| right.sample([u[0] * 0.667, u[1]]), ..SOUND };
    found("disk by SolidAngle", two_thirds, &[Figure::Frequencies, Figure::Bias]);
    // the pdf by area ignores that a light is scaled
    let unscaled = Fault {
        sample: |light, u, right| right.sample(u).map(|s| Sample { pdf: s.pdf * scale(light), ..s }),
        pdf: |light, _, pdf| pdf * scale(light),
    };
    let judgement = found("triangle by Area", unscaled, &[Figure::Density, Figure::Bias]);
    assert!(only_along(&judgement, Axis::Unit, Figure::Density));
    // at a kilometre, a rectangle is dark
    let dark = Fault { sample: |light, u, right| right.sample(u).filter(|_| scale(light) == 1.0), ..SOUND };
    assert!(only_along(&found("rectangle by Area", dark, &[Figure::Dark]), Axis::Unit, Figure::Dark));
}

#[test]
fn nonsense_and_panics_are_findings() {
    let name = "triangle by SolidAngle";
    let nan: fn(&AreaLight, [f32; 2], &dyn Sampler) -> Option<Sample> =
        |_, u, right| right.sample(u).map(|s| Sample { pdf: if u[0] > 0.99 { f32::NAN } else { s.pdf }, ..s });
    found(name, Fault { sample: nan, ..SOUND }, &[Figure::Nonsense]);
    found(name, Fault { pdf: |_, _, _| -1.0, ..SOUND }, &[Figure::Nonsense]);
    found(name, Fault { sample: |_, _, _| panic!("a sampler panics"), ..SOUND }, &[Figure::Answer]);
    found(name, Fault { sample: |_, _, _| None, ..SOUND }, &[Figure::Dark]);
    // a tenth of the draws is lost, a pdf outlives them
    let lost = Fault { sample: |_, u, right| right.sample(u).filter(|_| u[0] > 0.1), ..SOUND };
    found(name, lost, &[Figure::Integral, Figure::Bias]);
}

#[test]
fn a_sampler_is_right_where_it_says_so() {
    // nothing is drawn from above, which one of them says
    let half = |says: bool| {
        changed(technique("triangle by SolidAngle"), move |light, sampler| match (light.n[2] > 0.0, says) {
            (true, true) => Prepared::OutsideOfDomain,
            (true, false) => Prepared::Nothing,
            _ => Prepared::Ready(sampler),
        })
    };
    let said = judged(&half(true), 1);
    assert!(said.is_right() && said.share()[1] < said.cases.len());
    assert!(judged(&half(false), 1).findings.iter().any(|f| f.figure == Figure::Dark));
}

/// A textbook's sampler, the axis and its value at which a figure finds it wrong, and the values at which it does not.
type Textbook = (&'static str, Axis, f64, Figure, &'static [f64]);
const TEXTBOOKS: [Textbook; 9] = [
    ("cone, 1-cos naive", Axis::Size, 1e-3, Figure::Density, &[0.01, 0.5, 0.99]),
    ("cone, 1-cos naive", Axis::Size, 1e-5, Figure::Nonsense, &[1e-3]),
    ("cone, series below 1.5°", Axis::Size, 100.0, Figure::Density, &[1e-5, 1e-3, 0.01, 0.5, 0.99]),
    ("Ureña 2013 as published", Axis::Size, 1e-3, Figure::MisBias, &[0.5, 5.0]),
    ("Ω by arc cosines of the cone", Axis::Elevation, 3e-3, Figure::Density, &[0.3]),
    ("closed form of the pdf", Axis::Size, 100.0, Figure::Nonsense, &[1e-5, 1e-3, 0.01, 0.5, 0.99]),
    // triangles, quadrilaterals and polygons
    ("Arvo, angle excess", Axis::Elevation, 3e-3, Figure::Bias, &[0.03, 0.3]),
    ("Van Oosterom, unit vectors", Axis::Aspect, 300.0, Figure::Outside, &[3.0]),
    ("Lambert by arc cosines", Axis::Size, 0.01, Figure::Bias, &[0.5, 5.0]),
];

#[test]
fn textbooks_are_found_wrong_where_they_are() {
    for subject in textbook::samplers() {
        let judgement = judged(&subject, 1);
        let rows = TEXTBOOKS.iter().filter(|row| subject.name == format!("textbook {}", row.0));
        assert!(rows.clone().count() > 0, "{} has no row", subject.name);
        for (name, axis, wrong, figure, right) in rows {
            let at = |value: f64| {
                let mut case = judgement.cases.iter().filter(|c| c.axis == *axis && c.value == value);
                has(case.next().expect("the quick tier tries it"), *figure)
            };
            assert!(at(*wrong), "{name}: {figure:?} does not find it at {axis:?} {wrong}");
            assert!(!right.iter().any(|value| at(*value)), "{name}: {figure:?} finds it at {axis:?} {right:?}");
        }
    }
    // the cone by a series is right as seen from outside
    let series = textbook::samplers().remove(1);
    let outside = changed(series, |light, sampler| {
        let is_inside = length(sub(wide(light.a), wide(light.p))) < f64::from(light.radius);
        if is_inside { Prepared::OutsideOfDomain } else { Prepared::Ready(sampler) }
    });
    assert!(judged(&outside, 1).is_right());
}
