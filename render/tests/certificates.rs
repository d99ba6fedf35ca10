//! Compares what certificates allow to compute with the light that all primitives leave, in double precision: random patches and lights in
//! scenes that are difficult for closed forms. `occlusion` tests these alone, and the laboratory images of scenes with difficult bodies.

use crate::brute_force::regimes::REGIMES;
use crate::brute_force::values;
use etendue_oracle::tier::cases;

/// Patches and lights of each regime whose values are compared, and how many times as many are of chamfered boxes: a plane through rounded
/// ends of an edge is wrong in one of ten thousand.
const SHAFTS: u64 = 4_000;
const CHAMFERED: u64 = 10;

/// Compares values in all regimes, and prints a table.
fn soundness(shafts: u64, chamfered: u64) {
    let mut broken = Vec::new();
    let only = std::env::var("REGIME");
    let is_regime = |only: &String| REGIMES.iter().any(|(name, _)| name == only);
    assert!(only.as_ref().ok().is_none_or(is_regime), "REGIME={only:?} is none of the regimes");
    for (k, (name, made)) in (0_u32..).zip(REGIMES) {
        if only.as_ref().is_ok_and(|only| only != name) {
            continue;
        }
        let shafts = if name == "chamfered boxes" { chamfered * shafts } else { shafts };
        // regimes have numbers of their own
        let halves = [0, 1].map(|half| k.wrapping_mul(0x2000_0000) + half * 0x1000_0000 + 1);
        let parts = std::thread::scope(|scope| {
            let run = |first| scope.spawn(move || values::campaign(name, made, shafts / 2, first));
            halves.map(run).map(|part| part.join().unwrap())
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

/// The first scene from each of these numbers has a view for which a closed form in single precision is wrong: because it sees an edge of the
/// light, of a flat blocker or of a body under nearly 180°, or because the horizon cuts the light between the points of a sphere that
/// `Precision::of` asks.
#[test]
fn values_that_were_wrong_agree_with_the_truth() {
    let pinned = [
        ("thin sheets", 295_608_900),
        ("thin sheets", 7_632_983),
        ("long walls", 41_530_617),
        ("touching spheres", 1_932_016_667),
    ];
    for (name, first) in pinned {
        let (_, made) = REGIMES.into_iter().find(|(regime, _)| *regime == name).unwrap();
        let values = values::campaign(name, made, 1, first);
        assert!(values.worst <= 1.0, "{} times the allowed error: {}", values.worst, values.place);
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
