//! Trees of lights: exact sums, the pmf of choices, frequencies, and that no light is lost.

use etendue::select::{Choice, Join, LightBound, LightChoice, LightTree, LightsError, NO_LIGHT, Node8, TreeWords};
use etendue::{Real, Uint, Vec3, f32x8, u32x8};
use etendue_judge::generators::{EDGES, NASTY, Random};
use etendue_judge::light_tree::{Grove, Lamp, Place, Reached, Regime, figures, place};
use etendue_judge::stats;
use etendue_judge::tolerances::SIGNIFICANCE;
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
fn law(grove: &Grove, lamps: &[Lamp], (place, aim): (Place, usize), random: &mut Random) -> u64 {
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

/// From words in memory, at every width, choices and pmfs have the bits of the tree.
#[test]
fn words_have_the_bits_of_the_tree() {
    let of = |choice: Choice<f32>| (choice.index, choice.pmf.to_bits(), choice.u.to_bits());
    for (seed, regime) in (0..).zip(Regime::ALL) {
        let mut random = Random::new(700 + seed);
        let (mut chosen, mut levels) = (0, 0);
        for count in COUNTS {
            let lamps = regime.lamps(count, &mut random);
            let bounds: Vec<LightBound> = lamps.iter().map(Lamp::bound).collect();
            let (mut nodes, mut places) = (vec![Node8::default(); LightTree::nodes_for(count)], vec![0; count]);
            LightTree::build(&bounds, &mut nodes, &mut places).unwrap();
            let tree = LightTree::from_buffers(&nodes, &places);
            // nodes in the middle of other words
            let before = random.below(9);
            let mut words = vec![0; before];
            words.extend(nodes.iter().flat_map(Node8::words));
            let places_at = words.len() as u32;
            words.extend(&places);
            let in_words =
                TreeWords { memory: &words[..], nodes: before as u32, places: places_at, count: count as u32 };
            let all = u32x8::splat;
            let wide = TreeWords {
                memory: &words[..],
                nodes: all(before as u32),
                places: all(places_at),
                count: all(count as u32),
            };
            for _ in 0..cases(12, 200) {
                let (at, aim) = place(regime, &lamps, &mut random);
                let [p, n] = [at.0, at.1].map(Vec3::<f32>::from);
                let (one, other) = (tree.at(p, n), in_words.at(p, n));
                let eight = wide.at(Vec3::<f32x8>::splat(p), Vec3::splat(n));
                let bits: [[u32; 2]; 8] = core::array::from_fn(|_| words_of(&mut random));
                let choices = eight.choose_by([0, 1].map(|k| u32x8::from(bits.map(|bits| bits[k]))));
                for (lane, bits) in bits.into_iter().enumerate() {
                    let choice = one.choose_by(bits);
                    assert_eq!(of(choice), of(other.choose_by(bits)), "{regime:?}, {count} lights");
                    assert_eq!(
                        of(choice),
                        (choices.index.lane(lane), choices.pmf.lane(lane).to_bits(), choices.u.lane(lane).to_bits())
                    );
                    let light = if choice.index == NO_LIGHT { aim as u32 } else { choice.index };
                    assert_eq!(one.pmf(light).to_bits(), other.pmf(light).to_bits(), "{regime:?}, {count} lights");
                    chosen += u32::from(choice.index != NO_LIGHT);
                    levels = levels.max(if choice.pmf > 0.0 { -choice.pmf.log2() as u32 } else { 0 });
                }
                let u = random.unit();
                assert_eq!(of(one.choose(u)), of(other.choose(u)));
                let lights = u32x8::from(core::array::from_fn(|lane| (lane as u32).wrapping_mul(0x1000_0081)));
                let pmfs = eight.pmf(lights);
                for lane in 0..8 {
                    assert_eq!(one.pmf(lights.lane(lane)).to_bits(), pmfs.lane(lane).to_bits());
                }
            }
        }
        println!("{regime:?}: {chosen} lights were chosen, the rarest once in 2^{levels}");
        assert!(chosen > 100);
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

/// The sum of the weights of two weak lights, far away and near the horizon, is a normal number whose reciprocal overflows if it is
/// multiplied by the units of a node.
#[test]
fn weak_lights_far_away() {
    let on_axis = |x: f32, power, normal| LightBound { normal, ..light([x, 0.0, 0.0], 0.0, power) };
    let weak = (-40.0_f32).exp2();
    let lights = vec![on_axis(1.0, 1.0, [-1.0, 0.0, 0.0]), on_axis(0.0, weak, [0.0; 3]), on_axis(0.5, weak, [0.0; 3])];
    let grove = Grove::new(lights);
    for tilt in [5e-5, 1e-6, 0.0, -1e-6, -1e-5] {
        for exponent in 20..40 {
            let (reached, none) = grove.exact(([f32::exp2(exponent as f32), 0.0, 0.0], [tilt, 0.0, 1.0]));
            assert_eq!((reached.len(), none), (2, 0.0), "2^{exponent}, {tilt:e}");
        }
    }
}

#[test]
#[ignore = "a million points of surfaces"]
fn a_million_points() {
    let mut random = Random::new(7);
    let (mut pairs, mut points) = (0, 0);
    for round in 0..1_000_000_u64 / 40 {
        let regime = Regime::ALL[round as usize % Regime::ALL.len()];
        let count = 1 + (random.word() % [8, 64, 300][round as usize % 3]) as usize;
        let lamps = regime.lamps(count, &mut random);
        let grove = Grove::of(&lamps);
        for _ in 0..40 {
            let place = place(regime, &lamps, &mut random);
            let _ = grove.exact(place.0);
            pairs += law(&grove, &lamps, place, &mut random);
            points += 1;
        }
    }
    println!("{points} points, {pairs} pairs of a point and a light that contributes");
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
            for _ in 0..100 {
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
            let mut expected = vec![0.0; lamps.len() + 1];
            expected[lamps.len()] = none * f64::from(draws);
            for reached in &reached {
                expected[reached.light as usize] = reached.pmf * f64::from(draws);
            }
            let (mut counts, mut left) = (vec![0; lamps.len() + 1], vec![0; 64]);
            let mut pairs = Vec::new();
            let at = grove.at(place);
            for _ in 0..draws {
                let choice = at.choose_by(words_of(&mut random));
                counts[(choice.index as usize).min(lamps.len())] += 1;
                if choice.index != NO_LIGHT {
                    left[(choice.u * 64.0) as usize] += 1;
                    pairs.push((f64::from(choice.index), f64::from(choice.u)));
                }
            }
            let p = stats::chi_square(&counts, &expected);
            assert!(p > SIGNIFICANCE, "{regime:?}: frequencies, p = {p}");
            if reached.is_empty() {
                continue;
            }
            let p = stats::uniform(&left);
            assert!(p > SIGNIFICANCE, "{regime:?}: number left, p = {p}");
            if reached.len() > 1 {
                let p = stats::two_sided(stats::correlation(&pairs) * (pairs.len() as f64).sqrt());
                assert!(p > SIGNIFICANCE, "{regime:?}: correlation, p = {p}");
            }
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
            let near = |place: &Place| place.0.iter().all(|x| x.abs() < 1e15);
            let places: Vec<Place> = (0..60).map(|_| place(regime, &lamps, &mut random).0).filter(near).collect();
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

fn same_shares(one: &Grove, other: &Grove, place: Place) {
    let (one_at, other_at) = (one.at(place), other.at(place));
    for node in 0..=one.nodes.len() as u32 {
        assert_eq!(one_at.shares(0, node), other_at.shares(0, node), "node {node}");
    }
}

#[test]
fn threads_and_refitting_give_the_same_tree() {
    for (seed, regime) in (0..).zip(Regime::ALL) {
        let mut random = Random::new(700 + seed);
        for count in [1, 8, 9, 100, 20_000] {
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
            for _ in 0..20 {
                let place = place(shuffled, &lamps, &mut random);
                let _ = moved.exact(place.0);
                law(&moved, &lamps, place, &mut random);
            }
        }
    }
}

fn light(center: [f32; 3], radius: f32, power: f32) -> LightBound {
    LightBound { center, radius, power, ..LightBound::default() }
}

/// The irradiance of lights that are far away for their extent is that of points with their power, in any unit. It is 0 only where no light has a pmf: below
/// the horizon of the surface and behind flat lights; every width has the same bits.
#[test]
fn irradiance_is_that_of_all_lights_together() {
    let mut random = Random::new(811);
    let (mut least, mut greatest, mut dark) = (1.0_f64, 1.0_f64, 0);
    for case in 0..cases(2000, 40_000) {
        let count = 1 + random.below(20);
        let unit = 2.0_f32.powi(random.below(60) as i32 - 30);
        let units = random.magnitude(1e-12, 1e12) as f32;
        let p = random.direction().map(|x| x * random.magnitude(25.0, 1e4));
        let (n, flat) = (random.direction(), random.below(2) == 0);
        let bounds: Vec<LightBound> = (0..count)
            .map(|_| {
                let center = [0, 1, 2].map(|_| random.range(-1.0, 1.0) as f32 * unit);
                let normal = if flat { random.direction().map(|x| x as f32) } else { [0.0; 3] };
                LightBound { normal, ..light(center, 0.01 * unit, units * random.unit()) }
            })
            .filter(|light| light.power > 0.0)
            .collect();
        let count = bounds.len();
        let (mut nodes, mut places) = (vec![Node8::default(); LightTree::nodes_for(count)], vec![0; count]);
        let tree = LightTree::build(&bounds, &mut nodes, &mut places).unwrap();
        let at = tree.at::<f32>(Vec3::from(p.map(|x| x as f32 * unit)), Vec3::from(n.map(|x| x as f32)));
        let strongest = bounds.iter().fold(0.0, |most: f32, light| most.max(light.power));
        let found = at.irradiance(strongest);
        let wide = tree
            .at::<f32x8>(Vec3::lit(p.map(|x| f64::from(x as f32 * unit))), Vec3::lit(n.map(|x| f64::from(x as f32))));
        assert_eq!(wide.irradiance(strongest), f32x8::splat(found), "case {case}");
        let reached = (0..count as u32).any(|light| at.pmf(light) > 0.0);
        assert!(found > 0.0 || !reached, "case {case}");
        dark += u32::from(found == 0.0);
        let (mut sum, mut grazing) = (0.0, false);
        for light in &bounds {
            let v: [f64; 3] = std::array::from_fn(|k| f64::from(light.center[k] / unit) - p[k]);
            let d = v.iter().map(|x| x * x).sum::<f64>().sqrt();
            let cos = |n: [f64; 3], sign: f64| (0..3).map(|k| sign * v[k] * n[k] / d).sum::<f64>();
            let (here, there) = (cos(n, 1.0), if flat { cos(light.normal.map(f64::from), -1.0) } else { 0.25 });
            grazing |= here.abs() < 0.3 || flat && (count > 1 || there.abs() < 0.3);
            sum += f64::from(light.power) / std::f64::consts::PI * here.max(0.0) * there.max(0.0)
                / (d * f64::from(unit)).powi(2);
        }
        if !grazing {
            let ratio = if sum > 0.0 { f64::from(found) / sum } else { 1.0 + f64::from(found) };
            (least, greatest) = (least.min(ratio), greatest.max(ratio));
        }
    }
    // the part of the bound in the weights is a 32nd, of cosines of which that at the lights may be ¼
    println!("{least:.4} to {greatest:.4} times the irradiance, and {dark} times 0");
    assert!(least > 0.98 && greatest < 1.17 && dark > 100, "{least}, {greatest}, {dark}");
}

/// A light whose place, size or power is not finite is never chosen, and the others share as without it.
#[test]
fn malformed_lights_are_never_chosen() {
    let good = [light([1.0, 0.0, 2.0], 0.1, 1.0), light([-1.0, 0.5, 2.0], 0.2, 3.0)];
    let place = ([0.0; 3], [0.0, 0.0, 1.0]);
    let alone = Grove::new(good.to_vec());
    for odd in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for malformed in [
            light([odd, 0.0, 2.0], 0.1, 1.0),
            light([0.0, 0.0, odd], 0.1, 1.0),
            light([0.0, 0.0, 2.0], odd, 1.0),
            light([0.0, 0.0, 2.0], 0.1, odd),
        ] {
            let grove = Grove::new(vec![good[0], malformed, good[1]]);
            assert_eq!(grove.pmf(place, 1), 0.0, "{malformed:?}");
            for (light, own) in [(0, 0), (2, 1)] {
                // a share is a multiple of 2⁻¹⁶, and the last light receives what the others leave
                let off = grove.pmf(place, light) - alone.pmf(place, own);
                assert!(off.abs() <= 2.0 / 65_536.0, "{malformed:?}: light {light} is off by {off}");
            }
        }
    }
}

/// On the axis of a spot light, nearly all samples are its own as soon as its cone is narrow, even if its cosine is 1.
#[test]
fn narrow_spots_take_the_place_they_light() {
    for cos_cone in [0.999, 0.999_999_94, 1.0] {
        let spot = LightBound { normal: [0.0, 0.0, -1.0], cos_cone, ..light([0.0, 0.0, 2.0], 0.0, 1.0) };
        let grove = Grove::new(vec![spot, light([0.5, 0.0, 2.0], 0.0, 1.0)]);
        let pmf = [0, 1].map(|light| grove.pmf(([0.0; 3], [0.0, 0.0, 1.0]), light));
        assert!(pmf[0] > 0.99 && pmf[1] > 0.0 && pmf[0] + pmf[1] == 1.0, "{cos_cone}: {pmf:?}");
    }
}

/// A disk is bounded as a disk, not as its sphere: one below the horizon, ten times as wide as it is deep, is never chosen, in any plane.
#[test]
fn disks_are_bounded_as_disks() {
    for axis in 0..3 {
        let along = |x: f32, y: f32| {
            let mut v = [y; 3];
            v[axis] = x;
            v
        };
        let normal = along(1.0, 0.0);
        let disk = |height: f32| LightBound { normal, ..light(along(height, 1.0), 1.0, 1.0) };
        for (height, is_chosen) in [(-0.1, false), (0.1, true)] {
            let below = LightBound { two_sided: true, ..disk(height) };
            let above = LightBound { normal: along(-1.0, 0.0), ..light(along(2.0, 0.0), 0.1, 1.0) };
            let grove = Grove::new(vec![below, above]);
            let pmf = [0, 1].map(|light| grove.pmf(([0.0; 3], normal), light));
            assert!((pmf[0] > 0.0) == is_chosen && pmf[1] > 0.0, "{axis} {height}: {pmf:?}");
        }
    }
}

#[test]
fn memory_of_the_wrong_size_is_refused() {
    let lights: Vec<_> = (0..100).map(|i| light([i as f32, 0.0, 1.0], 0.1, 1.0)).collect();
    let build = |lights: &[LightBound], nodes: usize, places: usize| {
        LightTree::build(lights, &mut vec![Node8::default(); nodes], &mut vec![0; places]).map(|tree| tree.len())
    };
    let enough = LightTree::nodes_for(100);
    assert_eq!(build(&lights, enough, 100), Ok(100));
    assert_eq!(build(&lights, enough + 5, 100), Ok(100));
    for (nodes, places) in [(enough - 1, 100), (0, 100), (enough, 99), (enough, 101)] {
        assert_eq!(build(&lights, nodes, places), Err(LightsError::Length), "{nodes} {places}");
    }
    assert_eq!(LightTree::MOST, 1 << 27);
    assert_eq!(build(&[], LightTree::nodes_for(0), 0), Ok(0));
    let Grove { mut nodes, places, .. } = Grove::new(lights.clone());
    assert_eq!(LightTree::refit(&lights[1..], &mut nodes, &places), Err(LightsError::Length));
    assert_eq!(LightTree::refit(&lights, &mut nodes[1..], &places), Err(LightsError::Length));
    assert_eq!(LightTree::refit(&lights[1..], &mut nodes, &places[1..]), Err(LightsError::Length));
    let more: Vec<_> = lights.iter().chain(&lights[..1]).copied().collect();
    assert_eq!(LightTree::refit(&more, &mut nodes, &places), Err(LightsError::Length));
    // in memory of a larger tree, whose nodes beyond those of the smaller one name lights past its end
    let (few, mut places) = (&lights[..9], vec![0; 9]);
    LightTree::build(few, &mut nodes, &mut places).unwrap();
    assert_eq!(LightTree::refit(few, &mut nodes, &places), Ok(()));
    let none = Grove::new(Vec::new());
    assert!(none.tree().is_empty());
    let choice = none.at(([0.0; 3], [0.0, 0.0, 1.0])).choose_by([1 << 31, 0]);
    assert_eq!((choice.index, choice.pmf), (NO_LIGHT, 0.0));
    // any number of lights fits, however they are placed
    let mut random = Random::new(9);
    for count in (0..300).chain([511, 512, 513, 4095, 4096, 4097, 5000]) {
        let regime = Regime::ALL[count % Regime::ALL.len()];
        let _ = Grove::of(&regime.lamps(count, &mut random));
    }
}

/// Buffers that do not belong together, and any points and normals, give wrong choices, but no panic.
#[test]
fn malformed_use_does_not_panic() {
    let mut random = Random::new(10);
    let lamps = Regime::Room.lamps(300, &mut random);
    let Grove { nodes, places, .. } = Grove::of(&lamps);
    let trees = [
        LightTree::from_buffers(&nodes, &places),
        LightTree::from_buffers(&nodes[..1], &places),
        LightTree::from_buffers(&nodes[5..], &places),
        LightTree::from_buffers(&nodes, &[7, 9, u32::MAX, 1 << 31]),
        LightTree::from_buffers(&nodes, &[]),
        LightTree::from_buffers(&[], &places),
    ];
    let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    for i in 0..20_000 {
        let mut number = || {
            let word = random.word() as usize;
            if word.is_multiple_of(8) { odd[word / 8 % 3] } else { NASTY[word / 8 % NASTY.len()] }
        };
        let [p, n] = [[number(), number(), number()], [number(), number(), number()]];
        let at = trees[i % trees.len()].at::<f32>(p.into(), n.into());
        let choice = at.choose_by(words_of(&mut random));
        assert!((0.0..=1.0).contains(&choice.pmf) && (0.0..1.0).contains(&choice.u), "{p:?} {n:?}: {choice:?}");
        for index in [0, 1, 2, 3, 299, 300, NO_LIGHT, choice.index] {
            assert!((0.0..=1.0).contains(&at.pmf(index)));
        }
        let _ = [0, 1, 1000, u32::MAX].map(|node| at.shares(0, node));
    }
    // a surface without a normal has a choice, too
    let at = trees[0].at::<f32x8>([0.0_f32; 3].into(), [0.0; 3].into());
    assert!(at.choose_by([1, 2].map(u32x8::splat)).pmf.lane(3) > 0.0);
    assert_eq!(figures(&at.choose(f32x8::splat(0.3)), 0), figures(&at.choose(f32x8::splat(0.3)), 5));
}
