//! All properties over all regimes: the tests of the warps run this.

use crate::fixture::{Fixture, Subject};
use crate::generators::{self, Case, Random};
use crate::properties;
use etendue_oracle::Greatest;
use etendue_oracle::tier;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::sync::Once;

/// The result of one property in one regime.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The property.
    pub property: &'static str,
    /// The regime, from [`generators`].
    pub regime: &'static str,
    /// Number of cases in which there was something to check.
    pub checked: usize,
    /// Greatest figure that the property returned, and the index of its case.
    pub figure: Greatest<usize>,
    /// Number of cases in which the property was broken.
    pub broken: usize,
    /// Message of the first of them.
    pub first: String,
}

thread_local! {
    static IS_QUIET: Cell<bool> = const { Cell::new(false) };
}

/// Runs something that may panic, which prints nothing.
///
/// # Errors
/// The message of the panic.
pub fn quietly<T>(run: impl FnOnce() -> T) -> Result<T, String> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let printed = take_hook();
        set_hook(Box::new(move |panic| {
            if !IS_QUIET.get() {
                printed(panic);
            }
        }));
    });
    let before = IS_QUIET.replace(true);
    let result = catch_unwind(AssertUnwindSafe(run));
    IS_QUIET.set(before);
    result.map_err(|panic| {
        let text = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
        text.unwrap_or("panic inside").to_owned()
    })
}

/// Runs one property over the cases, of which only the regimes are known; it returns `None` where there is nothing to check.
fn each(property: &'static str, names: &[&'static str], run: &dyn Fn(usize) -> Option<f64>) -> Vec<Outcome> {
    let mut all: Vec<Outcome> = Vec::new();
    for (i, &regime) in names.iter().enumerate() {
        let at = all.iter().position(|outcome| outcome.regime == regime).unwrap_or_else(|| {
            let first = String::new();
            all.push(Outcome { property, regime, checked: 0, figure: Greatest::NONE, broken: 0, first });
            all.len() - 1
        });
        let outcome = &mut all[at];
        let result = quietly(|| run(i));
        outcome.checked += usize::from(!matches!(result, Ok(None)));
        match result {
            Ok(figure) => figure.into_iter().for_each(|figure| outcome.figure.take(figure, i)),
            Err(message) => {
                if outcome.broken == 0 {
                    outcome.first = message;
                }
                outcome.broken += 1;
            }
        }
    }
    all
}

fn prepared<S: Fixture>(cases: &[Case<S>]) -> (Vec<&'static str>, Vec<Subject>) {
    cases.iter().map(|(name, s)| (*name, Subject::new(s))).unzip()
}

/// **Within reach**, alone: also for shapes that are too ill-conditioned for the other properties.
pub fn within_reach<S: Fixture>(cases: &[Case<S>]) -> Vec<Outcome> {
    let square = generators::square(20, 2);
    let (names, subjects) = prepared(cases);
    let reach = |i: usize| square.iter().map(|&u| properties::within_reach(&subjects[i], u)).collect::<Greatest>();
    each("reach", &names, &|i| Some(reach(i).error()))
}

/// All properties over the cases, at the edges of the square and at `random` further points; in the quick tier, at every second of them.
pub fn all<S: Fixture>(cases: &[Case<S>], random: usize) -> Vec<Outcome> {
    let square: Vec<_> = generators::square(random, 1).into_iter().step_by(tier::cases(2, 1)).collect();
    let (names, subjects) = prepared(cases);
    let is_scaled: Vec<bool> = cases.iter().map(|(_, s)| format!("{s:?}") != format!("{:?}", s.scaled(2.0))).collect();
    let mut all = of_subjects(&names, &subjects, &is_scaled, &square);
    all.extend(each("lanes", &names, &|i| {
        // each lane has another regime, and its own u
        let lanes = core::array::from_fn(|k| cases[(i + k * 3) % cases.len()].1);
        for start in (0..square.len() - 8).step_by(5) {
            properties::lanes(&lanes, &core::array::from_fn(|k| square[start + k]));
        }
        Some(0.0)
    }));
    all
}
/// The properties of one subject at a time, which are compiled once for all of them.
fn of_subjects(names: &[&'static str], subjects: &[Subject], is_scaled: &[bool], square: &[[f32; 2]]) -> Vec<Outcome> {
    type Pointwise = fn(&Subject, [f32; 2], &mut Random) -> Option<f64>;
    let pointwise: [(&'static str, Pointwise); 8] = [
        ("total", |s, u, _| {
            properties::total(s, u);
            Some(0.0)
        }),
        ("accurate", |s, u, _| Some(properties::accurate(s, u))),
        ("closed", |s, u, _| Some(properties::closed(s, u))),
        ("density", |s, u, r| {
            // the edges of the chart are included: that is where a density falls to 0
            Some(properties::pdf(s, u, [(); 2].map(|()| generators::unit_or_edge(r))))
        }),
        ("onto", |s, _, r| Some(properties::onto(s, [r.unit_f64(), r.unit_f64()]))),
        ("jacobian", |s, _, r| properties::jacobian(s, [r.unit_f64(), r.unit_f64()])),
        ("outside", |s, _, r| properties::outside(s, r).then_some(0.0)),
        ("scale", |s, u, _| {
            properties::scale(s, u);
            Some(0.0)
        }),
    ];
    let at = |(property, run): (&'static str, Pointwise)| {
        each(property, names, &|i| {
            let mut random = Random::new(i as u64);
            let is_told = property != "scale" || is_scaled[i];
            let square = square.iter().filter(|_| is_told);
            let checked: Vec<f64> = square.filter_map(|&u| run(&subjects[i], u, &mut random)).collect();
            (!checked.is_empty()).then(|| checked.into_iter().collect::<Greatest>().error())
        })
    };
    let mut all: Vec<_> = pointwise.into_iter().flat_map(at).collect();
    all.extend(each("integral", names, &|i| Some(properties::integral(&subjects[i]))));
    all.extend(each("chi-square", names, &|i| Some(properties::chi_square(&subjects[i], i as u64))));
    all
}
