//! Choice of lights: frequencies against probabilities, sums, limits.

use etendue::discrete::PiecewiseConstant1d;
use etendue::select::{Choice, LightBound, LightChoice, LightsError, SpatialLights, UniformLights};
use etendue::sequence::{Independent, Sequence};
use etendue::{Mask, Real, Uint, Vec2, f32x4, f32x8, u32x8};
use etendue_judge::choices::frequencies;
use etendue_oracle::{dot, length, sub};

/// Frequencies are the pmf, the pmf sums to 1, the number left is uniform, and widths agree.
fn check(
    name: &str,
    count: usize,
    choose: impl Fn(f32) -> Choice<f32>,
    packet: impl Fn(f32x8) -> Choice<f32x8>,
    pmf: impl Fn(u32) -> f32,
) {
    let draws = 1 << 19;
    let probabilities: Vec<f64> = (0..=count as u32).map(|k| f64::from(pmf(k))).collect();
    let sum: f64 = probabilities.iter().sum();
    assert!((sum - 1.0).abs() < 1e-6, "{name}: Σpmf = {sum}");
    assert_eq!([pmf(count as u32), pmf(u32::MAX)], [0.0; 2], "{name}");
    let mut chosen = Vec::new();
    for i in (0..draws).step_by(8) {
        let u: Vec2<f32x8> = Independent::new(3).pair(u32x8::splat(0), u32x8::from_fn(|k| i + k as u32), 0);
        let eight = packet(u.x);
        for k in 0..8 {
            let one = choose(u.x.lane(k));
            assert_eq!((eight.index.lane(k), eight.pmf.lane(k), eight.u.lane(k)), (one.index, one.pmf, one.u));
            assert_eq!(one.pmf, pmf(one.index), "{name}: light {}", one.index);
            assert!((0.0..1.0).contains(&one.u));
            chosen.push(one);
        }
    }
    frequencies(name, &probabilities, &chosen);
}

#[test]
fn uniform() {
    for count in [1, 2, 3, 10, 1000] {
        let lights = UniformLights { count };
        check("uniform", count as usize, |u| lights.choose(u), |u| lights.choose(u), |k| lights.pmf(k));
    }
    for count in [1, 3, 4_000_000, 1 << 22] {
        let last: Choice<f32> = UniformLights { count }.choose(f32::ONE_MINUS_EPSILON);
        assert_eq!(last.index, count - 1);
    }
    assert_eq!(UniformLights { count: 0 }.choose(0.5_f32).pmf, 0.0);
}

#[test]
fn power() {
    let many: Vec<f32> = (0..300).map(|k| ((k * 37 % 101) as f32).powi(3)).collect();
    for powers in
        [&[1.0][..], &[0.0, 2.0, 0.0, 1.0, 0.0], &[1e-30, 1.0, 1e30, 0.0], &[3e38, 3e38], &[1e-42, 2e-42], &many]
    {
        let mut cdf = vec![0.0; powers.len()];
        let lights = PiecewiseConstant1d::build(powers, &mut cdf).unwrap();
        check("power", powers.len(), |u| lights.choose(u), |u| lights.choose(u), |k| lights.pmf(k));
        for (k, power) in powers.iter().enumerate() {
            let pmf: f32 = lights.pmf(k as u32);
            assert_eq!(*power > 0.0, pmf > 0.0, "{powers:?}");
        }
    }
    // in proportion, where nothing is lifted
    let mut cdf = [0.0; 3];
    let lights = PiecewiseConstant1d::build(&[3.0, 1.0, 4.0], &mut cdf).unwrap();
    let shares: [f32; 3] = [0, 1, 2].map(|k| LightChoice::<f32>::pmf(&lights, k));
    assert_eq!(shares, [0.375, 0.125, 0.5]);
}

fn light(center: [f32; 3], radius: f32, power: f32) -> LightBound {
    LightBound { center, radius, power, ..LightBound::default() }
}

/// Spheres, a light without power, and a flat one that faces down.
fn bounds() -> Vec<LightBound> {
    vec![
        light([0.0, 0.0, 2.0], 0.5, 1.0),
        light([3.0, 0.0, 0.0], 0.0, 4.0),
        light([0.0, 1.0, 0.0], 0.1, 0.0),
        light([-1.0, -2.0, 5.0], 2.0, 30.0),
        light([1e4, 0.0, 0.0], 1.0, 0.5),
        LightBound { normal: [0.0, 0.0, -1.0], ..light([1.0, 1.0, 3.0], 0.2, 2.0) },
    ]
}

/// The weights by the formula, in f64, with the least share of lights that can contribute.
fn weights(lights: &[LightBound], p: [f32; 3], n: [f32; 3]) -> Vec<f64> {
    let wide = |v: [f32; 3]| v.map(f64::from);
    let weight = |light: &LightBound| {
        let to = sub(wide(light.center), wide(p));
        let d = length(to).max(f64::from(light.radius));
        let cos = ((dot(to, wide(n)) + f64::from(light.radius)) / d).clamp(0.0, 1.0);
        let facing = -dot(to, wide(light.normal)) / d;
        let facing = if light.normal == [0.0; 3] {
            0.25
        } else if light.two_sided {
            facing.abs()
        } else {
            facing.max(0.0)
        };
        cos * facing * f64::from(light.power) / (d * d)
    };
    let all: Vec<f64> = lights.iter().map(weight).collect();
    let least = all.iter().sum::<f64>() / 262_144.0;
    all.into_iter().map(|w| if w > 0.0 { w.max(least) } else { 0.0 }).collect()
}

#[test]
fn spatial() {
    let list = bounds();
    let lights = SpatialLights::new(&list).unwrap();
    let (up, tilted) = ([0.0, 0.0, 1.0], [0.6, 0.0, 0.8]);
    for p in [[0.0, 0.0, 0.5], [0.0, 0.0, 2.0], [2.5, 0.0, -0.3], [1e4, 0.5, -0.5], [-1e6, 0.0, -1e3], [1.0, 1.0, 3.5]]
    {
        for n in [up, tilted] {
            let (one, eight) = (lights.at::<f32>(p.into(), n.into()), lights.at::<f32x8>(p.into(), n.into()));
            check("spatial", list.len(), |u| one.choose(u), |u| eight.choose(u), |k| one.pmf(k));
            let expected = weights(&list, p, n);
            let sum: f64 = expected.iter().sum();
            for (k, weight) in expected.iter().enumerate() {
                let pmf = f64::from(LightChoice::<f32>::pmf(&one, k as u32));
                assert_eq!(pmf > 0.0, *weight > 0.0, "light {k} from {p:?} over {n:?}");
                assert!((pmf - weight / sum).abs() < 1e-6, "light {k} from {p:?} over {n:?}: {pmf}, {}", weight / sum);
            }
        }
    }
    // a light that reaches over the horizon is found, one below it is not; a flat light is found on its bright side only
    let pmf = |p: [f32; 3], n: [f32; 3]| {
        let at = lights.at::<f32>(p.into(), n.into());
        std::array::from_fn::<f32, 6, _>(|k| at.pmf(k as u32))
    };
    let low = pmf([0.0, 0.0, 2.4], up);
    assert!(low[0] > 0.0 && low[1] == 0.0 && low[2] == 0.0 && low[5] > 0.0, "{low:?}");
    assert_eq!(pmf([1.0, 1.0, 3.1], [0.0, 0.0, -1.0])[5], 0.0);
    assert_eq!(pmf([1.0, 1.0, 3.1], up)[0], 0.0);
    for none in [&[][..], &list[2..3]] {
        let at = SpatialLights::new(none).unwrap().at([0.0, 1.0, 0.0].into(), up.into());
        assert_eq!(at.choose(0.3_f32).pmf, 0.0);
    }
    let many = vec![list[0]; SpatialLights::MOST + 1];
    assert_eq!(SpatialLights::new(&many).err(), Some(LightsError::TooMany));
    assert_eq!(SpatialLights::new(&many[1..]).unwrap().len(), SpatialLights::MOST);
}

/// Among some of the lights, the others are never chosen and have no pmf, and the pmf of those is in the same proportion as among all.
#[test]
fn spatial_among_some() {
    let list = bounds();
    let lights = SpatialLights::new(&list).unwrap();
    let n = [0.6, 0.0, 0.8];
    for p in [[0.0, 0.0, 0.5], [2.5, 0.0, -0.3], [1e4, 0.5, -0.5], [1.0, 1.0, 3.5]] {
        let (one, eight) = (lights.at::<f32>(p.into(), n.into()), lights.at::<f32x8>(p.into(), n.into()));
        for kept in 0_u32..1 << list.len() {
            let is_kept = |k: u32| kept >> k & 1 == 1;
            let only = one.only(|k| is_kept(k as u32));
            let all: f32 = (0..6).filter(|k| is_kept(*k)).map(|k| one.pmf(k)).sum();
            for k in 0..6 {
                let (pmf, whole): (f32, f32) = (only.pmf(k), one.pmf(k));
                assert_eq!(pmf > 0.0, is_kept(k) && whole > 0.0, "light {k} of {kept:b} from {p:?}");
                assert!((pmf * all - whole).abs() < 1e-6 || !is_kept(k), "light {k} of {kept:b} from {p:?}: {pmf}");
            }
            if all > 0.0 {
                // the rounding of frequencies grows as the share of those that are kept falls
                let packet = eight.only(|k| <f32x8 as Real>::Mask::splat(is_kept(k as u32)));
                if all > 0.01 && kept.count_ones() > 3 && kept % 5 == 3 {
                    check("some", list.len(), |u| only.choose(u), |u| packet.choose(u), |k| only.pmf(k));
                }
            } else {
                let choice = only.choose(0.3);
                assert_eq!((choice.pmf, (0..6).map(|k| only.pmf(k)).sum::<f32>()), (0.0, 0.0), "{kept:b} from {p:?}");
            }
            for i in 0..256 {
                let choice = only.choose(i as f32 / 256.0);
                assert_eq!(choice.pmf, only.pmf(choice.index), "{kept:b} from {p:?}");
                assert!(choice.pmf == 0.0 || is_kept(choice.index), "light {} of {kept:b} from {p:?}", choice.index);
            }
        }
        // each lane has a mask of its own, as if it were alone
        let kept = |lane: usize, k: usize| (lane * 7 + 5) >> k & 1 == 1;
        let mask =
            |k: usize| <f32x8 as Real>::Mask::from_bits((0..8).map(|lane| u32::from(kept(lane, k)) << lane).sum());
        let packet = eight.only(mask);
        for i in 0..64 {
            let u = (i as f32 + 0.5) / 64.0;
            let choice = packet.choose(f32x8::splat(u));
            for lane in 0..8 {
                let own: Choice<f32> = one.only(|k| kept(lane, k)).choose(u);
                let same = (choice.index.lane(lane), choice.pmf.lane(lane), choice.u.lane(lane));
                assert_eq!(same, (own.index, own.pmf, own.u), "lane {lane}");
            }
        }
    }
}

/// A light of 10⁻⁹ of the weight is found by some u of the grid, in its due share.
#[test]
fn weak_lights_nearby_are_found() {
    let list = [light([0.0, 0.0, 1.0], 0.1, 1.0), light([0.0, 1.0, 1.0], 0.1, 1e-9), light([1.0, 0.0, 1.0], 0.1, 1e-9)];
    let at = SpatialLights::new(&list).unwrap().at::<f32x8>([0.0; 3].into(), [0.0, 0.0, 1.0].into());
    let mut counts = [0_u32; 3];
    for i in (0..1 << 24).step_by(8) {
        let index = at.choose(f32x8::from_fn(|k| (i + k) as f32 / 16_777_216.0)).index;
        (0..8).for_each(|k| counts[index.lane(k) as usize] += 1);
    }
    for (k, &count) in counts.iter().enumerate() {
        let off = f64::from(count) - f64::from(at.pmf(u32x8::splat(k as u32)).lane(0)) * 16_777_216.0;
        assert!(count > 0 && off.abs() <= 4.0, "light {k}: {count}, off by {off}");
    }
}

#[test]
fn spatial_choice_knows_no_unit() {
    let list = bounds();
    let (p, n) = ([0.7_f32, -0.3, 0.2], [0.0_f32, 0.6, 0.8]);
    for exponent in [-60, -20, 20, 60] {
        let scale = 2.0_f32.powi(exponent);
        let scaled: Vec<_> = list
            .iter()
            .map(|l| LightBound { center: l.center.map(|c| c * scale), radius: l.radius * scale, ..*l })
            .collect();
        let (one, other) = (SpatialLights::new(&list).unwrap(), SpatialLights::new(&scaled).unwrap());
        for k in 0..64 {
            let u = (k as f32 + 0.5) / 64.0;
            let one: Choice<f32> = one.at(p.into(), n.into()).choose(u);
            let other: Choice<f32> = other.at(p.map(|x| x * scale).into(), n.into()).choose(u);
            assert_eq!((one.index, one.pmf, one.u), (other.index, other.pmf, other.u), "2^{exponent}");
        }
    }
    // limits of single precision: no NaN, no infinity, and a pmf for the light that is above the horizon
    for far in [f32::MAX, 1e-45, 1e30] {
        let ends = [far, -far].map(|x| light([x, x, x], 0.0, 1.0));
        for p in [[0.0; 3], [-far; 3], [0.5 * far; 3]] {
            let at = SpatialLights::new(&ends).unwrap().at::<f32x4>(p.into(), [0.0, 0.0, 1.0].into());
            let choice = at.choose(f32x4::splat(0.7));
            assert!(choice.pmf.lane(2) > 0.0 && choice.pmf.lane(2) <= 1.0, "{far} {p:?} {choice:?}");
        }
    }
}
