//! The theorems hold, and a planted defect makes a proof fail.

use etendue_oracle::tier::cases;
use etendue_proof::defect::{Defect, plant};
use etendue_proof::search::{Theorem, prove, try_points};
use etendue_proof::{lemmas, theorems};

/// Whether a theorem is proved, with a defect or without; else why not.
fn refusal(theorem: &dyn Theorem, defect: Defect) -> Option<String> {
    plant(defect);
    let (difference, at) = try_points(theorem, 20_000);
    let proof = (difference < 1e-9).then(|| prove(theorem, 100_000));
    plant(Defect::None);
    let Some(proof) = proof else {
        return Some(format!("differs from its definition by {difference:e} at {at:?}"));
    };
    proof.failed.map(|(part, bounds)| format!("not proved: {bounds:?} on {part:?}"))
}
fn theorem(name: &str) -> Box<dyn Theorem> {
    theorems::all(false).into_iter().find(|t| t.statement().name == name).unwrap_or_else(|| panic!("no theorem {name}"))
}
const QUICK: [&str; 4] = ["ConcentricDisk", "CosineHemisphere", "AreaTriangle", "Cone"];

/// `cargo run --release -p etendue-proof` also proves the others, and the lemmas.
#[test]
fn the_quick_ones_hold() {
    for name in QUICK.into_iter().step_by(cases(3, 1)) {
        let theorem = theorem(name);
        assert_eq!(refusal(&*theorem, Defect::None), None, "{name}");
        assert!(theorem.trial().is_none_or(|trial| trial.run().is_some()), "{name}");
    }
}

/// All theorems over the whole of their boxes, and all lemmas for all arguments.
#[test]
#[ignore = "takes half an hour"]
fn all_hold() {
    for lemma in lemmas::all() {
        assert!(lemma.check(true).holds, "{}", lemma.statement);
    }
    for theorem in theorems::all(true) {
        let proof = prove(&*theorem, 30_000_000);
        assert!(proof.failed.is_none(), "{:?}: {:?}", theorem.statement(), proof.failed);
    }
}

/// A constant that is off in its last digit but one in single precision.
#[test]
fn a_wrong_digit_is_refused() {
    use core::f64::consts::{FRAC_1_PI, PI};
    let all = [
        ("ConcentricDisk", FRAC_1_PI),
        ("ConcentricDisk", 0.5),
        ("CosineHemisphere", FRAC_1_PI),
        ("CosineHemisphere", 2.0),
        ("AreaTriangle", 2.0),
        ("Cone", 0.5 / PI),
        ("Cone", 2.0),
        ("SphericalCap", 0.5 / PI),
        ("Triangle::by_solid_angle", 0.25 / PI),
    ];
    for (name, value) in all.into_iter().step_by(cases(6, 1)) {
        for off in [1e-6, -1e-6] {
            let refused = refusal(&*theorem(name), Defect::Constant { value, off });
            println!("{name} with {value} off by {off:e}: {refused:?}");
            assert!(refused.is_some(), "{name} with {value} off by {off:e}");
        }
    }
}

/// The n-th clamp of a run is missing. What a routine clamps for other reasons than the domain of the theorem does not count.
#[test]
fn a_missing_clamp_is_refused() {
    for (name, n) in [("CosineHemisphere", 1), ("CosineHemisphere", 2), ("CosineHemisphere", 3), ("Cone", 2)] {
        let refused = refusal(&*theorem(name), Defect::NoClamp(n));
        println!("{name} without clamp {n}: {refused:?}");
        assert!(refused.is_some(), "{name} without clamp {n}");
    }
}

#[test]
fn rounding_inwards_is_refused() {
    for name in QUICK {
        for defect in [Defect::Inwards, Defect::HalfRounding] {
            let refused = refusal(&*theorem(name), defect);
            println!("{name} with {defect:?}: {refused:?}");
            assert!(refused.is_some(), "{name} with {defect:?}");
        }
    }
}
