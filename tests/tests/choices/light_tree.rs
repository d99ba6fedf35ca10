//! Trees of lights: exact sums, the pmf of choices, frequencies, and that no light is lost.

use etendue::select::Join;
use etendue_judge::choices::frequencies;
use etendue_judge::generators::{EDGES, Random};
use etendue_judge::light_tree::{Grove, Lamp, PointAndNormal, Reached, Regime, place};
use etendue_oracle::tier::cases;

const COUNTS: [usize; 9] = [1, 2, 7, 8, 9, 63, 64, 65, 1000];

fn words_of(random: &mut Random) -> [u32; 2] {
    let word = random.word();
    [word as u32, (word >> 32) as u32]
}

fn square(random: &mut Random) -> [f32; 2] {
    let mut coordinate = || {
        let word = random.word() as usize;
        if word.is_multiple_of(4) { EDGES[word / 4 % EDGES.len()] } else { random.unit() }
    };
    [coordinate(), coordinate()]
}

/// The law for some of the lights, and several times for one of them; returns how often a light contributed.
fn law(grove: &Grove, lamps: &[Lamp], (place, aim): (PointAndNormal, usize), random: &mut Random) -> u64 {
    let mut found = 0;
    for k in 0..12 {
        let light = if k < 3 { aim } else { random.word() as usize % lamps.len() };
        found += u64::from(grove.law(place, light, &lamps[light], square(random)));
    }
    found
}

#[test]
fn probabilities_sum_to_one_exactly_in_all_regimes() {
    for (seed, regime) in (0..).zip(Regime::ALL) {
        let mut random = Random::new(seed);
        let (mut dark, mut levels) = (0.0_f64, 0);
        for count in COUNTS {
            let lamps = regime.lamps(count, &mut random);
            let grove = Grove::of(&lamps);
            for _ in 0..4000 / (count + 10) + 4 {
                let (reached, none) = grove.exact(place(regime, &lamps, &mut random).0);
                dark = dark.max(if reached.is_empty() { 0.0 } else { none });
                levels = reached.iter().map(|reached| reached.levels).fold(levels, usize::max);
            }
        }
        println!("{regime:?}: {levels} levels; none has up to {dark:.4} where some light has more");
    }
}

#[test]
fn no_light_is_lost_in_any_regime() {
    for (seed, regime) in (0..).zip(Regime::ALL) {
        let mut random = Random::new(100 + seed);
        let mut pairs = 0;
        for count in COUNTS {
            let lamps = regime.lamps(count, &mut random);
            let grove = Grove::of(&lamps);
            for _ in 0..300 {
                let place = place(regime, &lamps, &mut random);
                pairs += law(&grove, &lamps, place, &mut random);
            }
        }
        println!("{regime:?}: {pairs} pairs");
        assert!(pairs > 500, "{regime:?}: {pairs} pairs");
    }
}

#[test]
#[ignore = "some seconds"]
fn a_hundred_thousand_lights() {
    for (seed, regime) in (0..).zip(Regime::ALL) {
        let mut random = Random::new(200 + seed);
        let lamps = regime.lamps(100_000, &mut random);
        let grove = Grove::of(&lamps);
        let mut pairs = 0;
        for _ in 0..4 {
            let _ = grove.exact(place(regime, &lamps, &mut random).0);
        }
        for _ in 0..300 {
            pairs += law(&grove, &lamps, place(regime, &lamps, &mut random), &mut random);
        }
        println!("{regime:?}: {pairs} pairs");
    }
}

/// The same pmf to the bit in packets of any width, with a place of its own in each lane.
#[test]
fn choices_have_their_pmf_in_every_lane() {
    for (seed, regime) in (0..).zip(Regime::ALL) {
        let mut random = Random::new(300 + seed);
        for count in [0, 1, 9, 65, 700] {
            let lamps = regime.lamps(count.max(1), &mut random);
            let grove = Grove::of(&lamps[..count]);
            for _ in 0..cases(25, 100) {
                let places = core::array::from_fn(|_| place(regime, &lamps, &mut random).0);
                let words = core::array::from_fn(|_| words_of(&mut random));
                grove.choices(&places, &words, &core::array::from_fn(|_| square(&mut random)[0]));
            }
        }
    }
}

/// Frequencies are the pmf; the number left is uniform and independent of the light.
#[test]
fn frequencies_are_the_pmf() {
    for (seed, regime) in (0..).zip([Regime::Room, Regime::TwoSided, Regime::SphereOutwards, Regime::Powers]) {
        let mut random = Random::new(400 + seed);
        let lamps = regime.lamps(150, &mut random);
        let grove = Grove::of(&lamps);
        for _ in 0..4 {
            let (place, _) = place(regime, &lamps, &mut random);
            let (reached, none) = grove.exact(place);
            let draws = cases(1 << 14, 1 << 18);
            let mut probabilities = vec![0.0; lamps.len() + 1];
            probabilities[lamps.len()] = none;
            for reached in &reached {
                probabilities[reached.light as usize] = reached.pmf;
            }
            let at = grove.at(place);
            let chosen: Vec<_> = (0..draws).map(|_| at.choose_by(words_of(&mut random))).collect();
            frequencies(&format!("{regime:?}"), &probabilities, &chosen);
        }
    }
}

/// A stratum of first words gives each light as many samples as its pmf says, but for its ends and those of the nodes above.
#[test]
fn strata_survive() {
    let mut sums = [0.0; 2];
    for (seed, count) in (0..).zip([5, 40, 300]) {
        let mut random = Random::new(500 + seed);
        let lamps = Regime::Room.lamps(count, &mut random);
        let grove = Grove::of(&lamps);
        for _ in 0..5 {
            let (place, _) = place(Regime::Room, &lamps, &mut random);
            let (reached, _) = grove.exact(place);
            let draws = 4096_u32;
            let errors = [true, false].map(|strata| {
                let mut counts = vec![0.0; lamps.len()];
                for i in 0..draws {
                    let [word, more] = words_of(&mut random);
                    let first = if strata { i << 20 | word >> 12 } else { word };
                    let choice = grove.at(place).choose_by([first, more]);
                    if let Some(count) = counts.get_mut(choice.index as usize) {
                        *count += 1.0;
                    }
                }
                let off = |r: &Reached| {
                    let off = counts[r.light as usize] - r.pmf * f64::from(draws);
                    assert!(!strata || f64::abs(off) <= 2.0 + 1e-9, "light {}: off by {off}", r.light);
                    off * off
                };
                reached.iter().map(off).sum::<f64>()
            });
            println!("{count}: squared errors {errors:.1?} of {} lights", reached.len());
            sums = [sums[0] + errors[0], sums[1] + errors[1]];
        }
    }
    assert!(sums[0] < 0.03 * sums[1], "squared errors {sums:?}");
}

#[test]
fn lengths_have_no_unit() {
    for (seed, regime) in (0..).zip(Regime::ALL) {
        if matches!(regime, Regime::Tiny | Regime::Huge | Regime::Malformed | Regime::Powers) {
            continue;
        }
        let mut random = Random::new(600 + seed);
        for count in [1, 9, 300] {
            let lamps = regime.lamps(count, &mut random);
            let grove = Grove::of(&lamps);
            // far points are as far as single precision allows
            let near = |place: &PointAndNormal| place.0.iter().all(|x| x.abs() < 1e15);
            let places: Vec<PointAndNormal> =
                (0..60).map(|_| place(regime, &lamps, &mut random).0).filter(near).collect();
            let words: Vec<_> = places.iter().map(|_| words_of(&mut random)).collect();
            for exponent in [-60, -21, -1, 1, 20, 60] {
                grove.scale(&places, &words, exponent);
            }
        }
    }
}

/// Two threads for each pair of tasks.
struct Threads;

impl Join for Threads {
    fn join(&self, a: impl FnOnce() + Send, b: impl FnOnce() + Send) {
        std::thread::scope(|scope| {
            scope.spawn(a);
            b();
        });
    }
}

fn same_shares(one: &Grove, other: &Grove, place: PointAndNormal) {
    let (one_at, other_at) = (one.at(place), other.at(place));
    for node in 0..=one.nodes.len() as u32 {
        assert_eq!(one_at.shares(0, node), other_at.shares(0, node), "node {node}");
    }
}

#[test]
fn threads_and_refitting_give_the_same_tree() {
    for (seed, regime) in (0..).zip(Regime::ALL) {
        let mut random = Random::new(700 + seed);
        for count in [1, 8, 9, 100, cases(9_000, 20_000)] {
            let lamps = regime.lamps(count, &mut random);
            let grove = Grove::of(&lamps);
            let threads = Grove::with(grove.bounds.clone(), &Threads);
            let refitted = grove.refitted(grove.bounds.clone());
            assert_eq!(grove.places, threads.places);
            for _ in 0..3 {
                let (place, _) = place(regime, &lamps, &mut random);
                same_shares(&grove, &threads, place);
                same_shares(&grove, &refitted, place);
            }
        }
    }
}

/// After lights have moved, turned and changed their power and kind, a tree that is refitted keeps every property.
#[test]
fn lights_that_move() {
    for (seed, regime) in (0..).zip(Regime::ALL) {
        let mut random = Random::new(800 + seed);
        for count in [1, 8, 9, 100, 1000] {
            let grove = Grove::of(&regime.lamps(count, &mut random));
            let shuffled = Regime::ALL[random.word() as usize % Regime::ALL.len()];
            let lamps = shuffled.lamps(count, &mut random);
            let moved = grove.refitted(lamps.iter().map(Lamp::bound).collect());
            for _ in 0..cases(5, 20) {
                let place = place(shuffled, &lamps, &mut random);
                let _ = moved.exact(place.0);
                law(&moved, &lamps, place, &mut random);
            }
        }
    }
}
