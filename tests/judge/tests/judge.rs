//! The judge, judged: right samplers pass, planted faults are found in seconds, and nothing that a sampler does stops it.

use etendue_judge::lights::figures::Figure;
use etendue_judge::lights::sampler::{Prepared, Sample, Sampler, Subject, own};
use etendue_judge::lights::verdict::{Effort, Judgement, judge};
use etendue_judge::techniques::AreaLight;
use etendue_oracle::tier::cases;
use std::time::Instant;

const QUICK: Effort = Effort { quick: true, seed: 1, page: false };

fn told(judgement: &Judgement) {
    let [right, all] = judgement.share();
    println!("{}: right at {right} of {all} places, {:.2} s", judgement.name, judgement.seconds);
    for finding in &judgement.findings {
        println!("  {}\n    {}", finding.said, finding.input.replace('\n', "\n    "));
    }
}

/// What is known of the core's own techniques: the horizon through the centre of a sphere may turn up directions that are shorter than 1 by
/// 0.3 %, with a pdf of 1e−5.
const KNOWN: [(&str, Figure); 1] = [("etendue sphere by ProjectedSolidAngle", Figure::Nonsense)];

#[test]
fn techniques_of_the_core_are_right() {
    let start = Instant::now();
    let mut wrong = Vec::new();
    for subject in own() {
        for seed in 0..cases(1, 8) {
            let judgement = judge(&subject, Effort { seed, ..QUICK }, |_| ());
            told(&judgement);
            let is_new = |f: &Figure| !KNOWN.contains(&(&*subject.name, *f));
            wrong.extend(judgement.findings.iter().map(|f| f.figure).filter(is_new));
        }
    }
    println!("{:.1} s", start.elapsed().as_secs_f64());
    assert_eq!(wrong, []);
}

/// A fault, planted into a sampler of the core.
#[derive(Clone, Copy)]
struct Fault {
    sample: fn([f32; 2], Sample) -> Option<Sample>,
    pdf: fn(f32) -> f32,
}
struct Faulty(Box<dyn Sampler>, Fault);
impl Sampler for Faulty {
    fn sample(&self, u: [f32; 2]) -> Option<Sample> {
        self.0.sample(u).and_then(|s| (self.1.sample)(u, s))
    }
    fn pdf(&self, direction: [f32; 3]) -> f32 {
        (self.1.pdf)(self.0.pdf(direction))
    }
}
const SOUND: Fault = Fault { sample: |_, s| Some(s), pdf: |pdf| pdf };

fn judged(name: &str, fault: Fault) -> Judgement {
    let right = own().into_iter().find(|s| s.name == name).expect("the core has it");
    let (by, shape, prepare) = (right.by, right.shape, right.prepare);
    let prepare = Box::new(move |light: &AreaLight| match prepare(light) {
        Prepared::Ready(sampler) => Prepared::Ready(Box::new(Faulty(sampler, fault)) as Box<dyn Sampler>),
        other => other,
    });
    let subject = Subject { name: format!("{name}, with a fault"), shape, by, domain: String::new(), prepare };
    let judgement = judge(&subject, QUICK, |_| ());
    told(&judgement);
    assert!(judgement.seconds < 60.0, "{:.0} s", judgement.seconds);
    judgement
}
fn found(name: &str, fault: Fault, figures: &[Figure]) {
    let judgement = judged(name, fault);
    let found: Vec<_> = judgement.findings.iter().map(|f| f.figure).collect();
    assert!(figures.iter().any(|f| found.contains(f)), "{name}: {found:?} has none of {figures:?}");
}

fn turned(w: [f32; 3], by: f32) -> [f32; 3] {
    // about the z axis
    let (s, c) = by.sin_cos();
    [c * w[0] - s * w[1], s * w[0] + c * w[1], w[2]]
}

#[test]
fn one_percent_of_a_pdf_is_found() {
    let (more, less) = (|_, s: Sample| Some(Sample { pdf: s.pdf * 1.01, ..s }), |pdf| pdf * 1.01);
    // in a density that is known, and in one of which nothing is
    for name in ["etendue sphere by SolidAngle", "etendue triangle by Area", "etendue triangle by CosineWarp"] {
        judged(name, SOUND).is_right().then_some(()).expect("it is right without a fault");
        found(name, Fault { sample: more, ..SOUND }, &[Figure::Density, Figure::TwoPdfs]);
        found(name, Fault { pdf: less, ..SOUND }, &[Figure::TwoPdfs]);
        found(name, Fault { sample: more, pdf: less }, &[Figure::Density, Figure::Integral]);
    }
}

#[test]
fn a_thousandth_of_a_direction_is_found() {
    let turn = |_, s: Sample| Some(Sample { direction: turned(s.direction, 1e-3), ..s });
    for name in ["etendue sphere by SolidAngle", "etendue rectangle by SolidAngle", "etendue disk by Area"] {
        found(name, Fault { sample: turn, ..SOUND }, &[Figure::Outside]);
    }
}

#[test]
fn samples_that_crowd_by_a_thousandth_are_found() {
    // u₀ − ε sin(2πu₀) draws the same light; the pdf does not know
    struct Crowded(Box<dyn Sampler>);
    impl Sampler for Crowded {
        fn sample(&self, u: [f32; 2]) -> Option<Sample> {
            self.0.sample([u[0] - 2e-3 * (core::f32::consts::PI * u[0]).sin(), u[1]].map(|u| u.max(0.0)))
        }
        fn pdf(&self, direction: [f32; 3]) -> f32 {
            self.0.pdf(direction)
        }
    }
    let right = own().into_iter().find(|s| s.name == "etendue triangle by SolidAngle").expect("the core has it");
    let prepare = right.prepare;
    let prepare = Box::new(move |light: &AreaLight| match prepare(light) {
        Prepared::Ready(sampler) => Prepared::Ready(Box::new(Crowded(sampler)) as Box<dyn Sampler>),
        other => other,
    });
    let judgement = judge(&Subject { name: "crowded".into(), prepare, ..right }, QUICK, |_| ());
    told(&judgement);
    assert!(judgement.findings.iter().any(|f| f.figure == Figure::Placement));
}

#[test]
fn nonsense_and_panics_are_findings() {
    let name = "etendue triangle by SolidAngle";
    let nan = |u: [f32; 2], s: Sample| Some(Sample { pdf: if u[0] > 0.99 { f32::NAN } else { s.pdf }, ..s });
    found(name, Fault { sample: nan, ..SOUND }, &[Figure::Nonsense]);
    found(name, Fault { pdf: |_| -1.0, ..SOUND }, &[Figure::Nonsense]);
    found(name, Fault { sample: |_, _| panic!("a sampler panics"), ..SOUND }, &[Figure::Answer]);
    found(name, Fault { sample: |_, _| None, ..SOUND }, &[Figure::Dark]);
    // a tenth of the draws is lost, a pdf outlives them
    let lost = |u: [f32; 2], s: Sample| (u[0] > 0.1).then_some(s);
    found(name, Fault { sample: lost, ..SOUND }, &[Figure::Integral, Figure::Bias]);
}

#[test]
fn a_sampler_is_right_where_it_says_so() {
    let right = own().into_iter().find(|s| s.name == "etendue triangle by SolidAngle").expect("the core has it");
    let prepare = right.prepare;
    // wrong from above, which it says
    let half = |says: bool, prepare: Box<dyn Fn(&AreaLight) -> Prepared<'static>>| {
        Box::new(move |light: &AreaLight| match prepare(light) {
            Prepared::Ready(_) if light.n[2] > 0.0 && says => Prepared::OutsideOfDomain,
            Prepared::Ready(_) if light.n[2] > 0.0 => Prepared::Nothing,
            other => other,
        }) as Box<dyn Fn(&AreaLight) -> Prepared<'static>>
    };
    let of = |prepare| Subject { name: "half".into(), prepare, domain: "n.z <= 0".into(), ..own().remove(4) };
    let said = judge(&of(half(true, prepare)), QUICK, |_| ());
    assert!(said.is_right() && said.share()[1] < said.cases.len(), "{:?}", said.findings);
    let right = own().into_iter().find(|s| s.name == "etendue triangle by SolidAngle").expect("the core has it");
    let unsaid = judge(&of(half(false, right.prepare)), QUICK, |_| ());
    assert!(unsaid.findings.iter().any(|f| f.figure == Figure::Dark), "{:?}", unsaid.findings);
}

#[test]
fn textbooks_are_found_wrong() {
    for subject in etendue_judge::textbook::samplers() {
        let judgement = judge(&subject, QUICK, |_| ());
        told(&judgement);
        let naive = ["naive", "angle excess", "Ureña"].iter().any(|name| subject.name.contains(name));
        assert!(!judgement.is_right() || !naive, "{} is right", subject.name);
    }
}
