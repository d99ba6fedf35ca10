//! Random scenes by all techniques and by the oracle.

use etendue_laboratory::attack::draft::{Draft, Form};
use etendue_laboratory::attack::regimes::{REGIMES, named};
use etendue_laboratory::attack::shrink::shrink;
use etendue_laboratory::attack::{claims, defects, judge, report};
use etendue_oracle::tier::cases;
use etendue_render::scene::Geometry;

fn attack(count: u64) {
    let mut failures = Vec::new();
    for regime in &REGIMES {
        let tally = report::run(regime, 0..count, cases([16, 32], report::QUICK));
        println!("{tally}");
        failures.extend(tally.failures);
    }
    let list: Vec<String> = failures.iter().map(ToString::to_string).collect();
    assert!(list.is_empty(), "{}", list.join("\n"));
}

#[test]
fn techniques_agree_with_the_oracle() {
    attack(cases(1, 5));
}

/// Scenes of which samples show nothing of what they miss: a light of which too little is above the horizon, a lit corner that the
/// oracle does not meet at first, and lights that cut each other, within the end of shadow rays that is spared.
#[test]
fn judges_know_what_samples_miss() {
    for (regime, seed) in [("open", 224), ("in-box", 598), ("soup", 299)].into_iter().take(cases(1, 3)) {
        let tally = report::run(named(regime).unwrap(), seed..seed + 1, report::QUICK);
        assert!(tally.failures.is_empty(), "{:?}", tally.failures);
    }
}

#[test]
#[ignore = "20,000 scenes: half an hour on one core"]
fn techniques_agree_with_the_oracle_on_20000_scenes() {
    attack(834);
}

/// The errors of images over those that they claim.
fn claims_hold(seeds: u64, side: u32, least: f64) {
    let mut all = claims::Tally::default();
    for regime in &REGIMES {
        let tally = claims::run(regime, 0..seeds, [side, 64]).unwrap();
        println!("{:13} {tally}", regime.name);
        all = all.and(tally);
    }
    println!("{all}");
    let share = claims::honest(&all.runs);
    assert!(all.runs.len() > 2 * REGIMES.len() * seeds as usize && share >= least, "{share}");
    // a claim of half the error, or of twice as much, would not pass
    for factor in [0.5, 2.0] {
        let wrong: Vec<_> = all.runs.iter().map(|run| claims::Run { ratio: run.ratio * factor, ..*run }).collect();
        assert!(claims::honest(&wrong) < 0.5, "{factor}");
    }
}

#[test]
fn images_tell_their_error() {
    // in smaller images, closed forms leave too few pixels with noise
    claims_hold(1, 16, 0.8);
}

#[test]
#[ignore = "240 scenes: ten minutes on two cores"]
fn images_of_240_scenes_tell_their_error() {
    claims_hold(10, 32, claims::SHARE);
}

/// The scenes on which the renderer was wrong once, in smaller images than usual.
#[test]
fn scenes_that_were_wrong_agree_with_the_oracle() {
    let effort = judge::Effort { side: cases(48, 96), block: cases(6, 12), spp: 16, ..defects::EFFORT };
    for case in defects::all() {
        let table = defects::compare(&case, &effort).unwrap();
        println!("{table}");
        assert!(table.agrees(), "{table}");
    }
}

/// The text of a scene has its numbers in f32, exactly.
#[test]
fn text_is_exact() {
    let round = |v: [f64; 3]| v.map(|x| x as f32);
    for (regime, seed) in REGIMES.iter().flat_map(|regime| (0..20).map(move |seed| (regime, seed))) {
        let draft = regime.draft(seed);
        assert_eq!(draft, regime.draft(seed));
        let scene = judge::read(&draft).unwrap();
        let (mut meshes, mut shapes) = (scene.triangles.iter(), scene.shapes.iter());
        for part in &draft.parts {
            match &part.form {
                Form::Mesh(triangles) if part.glow.is_none() => {
                    assert!(triangles.iter().all(|t| meshes.next() == Some(&t.map(round))), "{draft}");
                }
                Form::Mesh(triangles) => {
                    let expected = |t: &[[f64; 3]; 3]| Geometry::Triangle(t.map(round));
                    assert!(triangles.iter().all(|t| shapes.next().unwrap().geometry == expected(t)), "{draft}");
                }
                Form::Sphere(center, radius) => {
                    let expected = Geometry::Sphere { center: round(*center), radius: *radius as f32 };
                    assert_eq!(shapes.next().unwrap().geometry, expected, "{draft}");
                }
                Form::Parallelogram(p, u, v) => {
                    let [p, u, v] = [*p, *u, *v].map(round);
                    assert_eq!(shapes.next().unwrap().geometry, Geometry::Parallelogram { p, u, v }, "{draft}");
                }
            }
        }
        assert!(meshes.next().is_none() && shapes.next().is_none());
    }
}

/// Only what a failure needs is left.
#[test]
fn counterexamples_shrink() {
    let draft = named("touching").unwrap().draft(3);
    let count = |draft: &Draft| draft.parts.iter().filter(|part| matches!(part.form, Form::Mesh(_))).count();
    let least = shrink(&draft, |draft| count(draft) >= 2);
    println!("{} → {} primitives", draft.size(), least.size());
    assert!(draft.size() > 20 && least.size() == 2);
}
