//! Trees of lights that are bounds alone: what the bounds of a light mean to a tree, and memory that has a wrong size.

use etendue::select::{LightBound, LightChoice, LightTree, LightsError, Node8};
use etendue::{Real, Vec3, f32x8, u32x8};
use etendue_judge::generators::{NASTY, Random};
use etendue_judge::light_tree::{Grove, Regime, figures};
use etendue_oracle::tier::cases;

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
    assert_eq!((choice.index, choice.pmf), (LightTree::NO_LIGHT, 0.0));
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
        let choice = at.choose_by([random.word(), random.word()].map(|word| word as u32));
        assert!((0.0..=1.0).contains(&choice.pmf) && (0.0..1.0).contains(&choice.u), "{p:?} {n:?}: {choice:?}");
        for index in [0, 1, 2, 3, 299, 300, LightTree::NO_LIGHT, choice.index] {
            assert!((0.0..=1.0).contains(&at.pmf(index)));
        }
        let _ = [0, 1, 1000, u32::MAX].map(|node| at.shares(0, node));
    }
    // a surface without a normal has a choice, too
    let at = trees[0].at::<f32x8>([0.0_f32; 3].into(), [0.0; 3].into());
    assert!(at.choose_by([1, 2].map(u32x8::splat)).pmf.lane(3) > 0.0);
    assert_eq!(figures(&at.choose(f32x8::splat(0.3)), 0), figures(&at.choose(f32x8::splat(0.3)), 5));
}
