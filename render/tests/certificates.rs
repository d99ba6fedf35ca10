//! Compares what certificates allow to compute with the light that all primitives leave, in double precision: random patches and lights in
//! scenes that are difficult for closed forms. `occlusion` tests these alone, and `attack` images of scenes.

mod pinned;
mod truth;
mod values;
mod views;

use crate::attack::regimes::named;
use etendue_oracle::tier::cases;
use pinned::PINNED;

/// The regimes in which closed forms may lose digits.
const REGIMES: [&str; 16] = [
    "thin",
    "chamfered",
    "open",
    "nested",
    "touching",
    "soup",
    "balls",
    "in-sphere",
    "in-box",
    "tiny-light",
    "far-light",
    "far-speck",
    "millimetres",
    "lampshade",
    "flush",
    "walls",
];

/// Patches and lights of each regime whose values are compared, and how many times as many are of chamfered boxes: a plane through rounded
/// ends of an edge is wrong in one of ten thousand.
const SHAFTS: u64 = 4_000;
const CHAMFERED: u64 = 10;

/// Compares values in all regimes, and prints a table.
fn soundness(shafts: u64, chamfered: u64) {
    let mut broken = Vec::new();
    let only = std::env::var("REGIME");
    let is_regime = |only: &String| REGIMES.contains(&only.as_str());
    assert!(only.as_ref().ok().is_none_or(is_regime), "REGIME={only:?} is none of the regimes");
    for name in REGIMES {
        if only.as_ref().is_ok_and(|only| only != name) {
            continue;
        }
        let shafts = if name == "chamfered" { chamfered * shafts } else { shafts };
        let parts = std::thread::scope(|scope| {
            let run = |half: usize| {
                scope.spawn(move || values::campaign(named(name), shafts / 2, (0..).skip(half).step_by(2)))
            };
            [0, 1].map(run).map(|part| part.join().unwrap())
        });
        let mut all = values::Values::default();
        parts.into_iter().for_each(|part| all.add(part));
        println!("{name}: {all}");
        if all.worst > 1.0 || all.worst.is_nan() {
            println!("{name}: {}", all.place);
            broken.push((name, all.worst, all.place));
        }
        assert!(all.fit.off < 1.0 && all.fit.height > 1.0, "{name}: a point is outside of its patch: {:?}", all.fit);
    }
    assert!(broken.is_empty(), "{broken:#?}");
}

/// Among random views, those of [`PINNED`] are one in many millions.
#[test]
fn values_that_were_wrong_agree_with_the_truth() {
    for pinned in PINNED {
        let values = values::pinned(&pinned);
        assert!(values.shafts > 0 && values.worst <= 1.0, "{} times the allowed error: {}", values.worst, values.place);
    }
}

#[test]
fn values_agree_with_the_truth() {
    soundness(cases(SHAFTS / 8, SHAFTS), CHAMFERED);
}

#[test]
#[ignore = "ten million patches and lights: half an hour"]
fn values_agree_with_the_truth_at_length() {
    soundness(1_250_000, 1);
}
