//! What proofs of visibility say is what the oracle finds, and what is wrong is found.

use etendue_judge::proofs::{Answer, Claim, Room, judge, own};
use etendue_oracle::V3;

#[test]
fn proofs_are_sound_and_errors_are_bounds() {
    let mut counts = [0; 4];
    let counting = std::cell::RefCell::new(&mut counts);
    let prover = |room: &Room, points: &[V3]| {
        let answer = own(room, points)?;
        let is_known = answer.irradiance.iter().any(Option::is_some);
        counting.borrow_mut()[match answer.claim {
            Claim::Lit => 0,
            Claim::Dark => 1,
            Claim::Open if is_known => 2,
            Claim::Open => 3,
        }] += 1;
        Some(answer)
    };
    let said = judge("etendue-visible", &prover, 3000, 1);
    assert!(said.is_right(), "{:?}", said.findings);
    println!("lit, dark, behind, open: {counts:?}");
    assert!(counts.iter().all(|&count| count > 60), "{counts:?}");
}

/// Claims that are too bold, and errors that are too small.
#[test]
fn what_is_wrong_is_found() {
    let with = |change: fn(&mut Answer)| {
        let prover = move |room: &Room, points: &[V3]| {
            let mut answer = own(room, points)?;
            change(&mut answer);
            Some(answer)
        };
        judge("wrong", &prover, 300, 1)
    };
    assert!(with(|_| ()).is_right());
    fn claimed(answer: &mut Answer, claim: Claim) {
        answer.claim = if answer.claim == Claim::Open { claim } else { answer.claim };
    }
    let wrong: [fn(&mut Answer); 3] = [
        |answer| claimed(answer, Claim::Dark),
        |answer| claimed(answer, Claim::Lit),
        |answer| answer.irradiance.iter_mut().flatten().for_each(|[value, _]| *value *= 0.999),
    ];
    assert!(wrong.into_iter().all(|change| !with(change).is_right()));
}
