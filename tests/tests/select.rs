//! Choice of lights: frequencies against probabilities, sums, limits.

use etendue::discrete::TableError;
use etendue::select::{Choice, LightBound, PowerLights, SpatialLights, UniformLights};
use etendue::sequence::{Independent, Sequence};
use etendue::{Real, Uint, Vec2, Vec3, f32x4, f32x8, u32x8};
use etendue_properties::stats;
use etendue_properties::tolerances::SIGNIFICANCE;

/// Frequencies are the pmf, the pmf sums to 1, the number left is uniform, and widths agree.
fn check(
    name: &str,
    count: usize,
    choose: impl Fn(f32) -> Choice<f32>,
    packet: impl Fn(f32x8) -> Choice<f32x8>,
    pmf: impl Fn(u32) -> f32,
) {
    let draws = 1 << 19;
    let probabilities: Vec<f64> = (0..count as u32).map(|k| f64::from(pmf(k))).collect();
    let sum: f64 = probabilities.iter().sum();
    assert!((sum - 1.0).abs() < 1e-6, "{name}: Σpmf = {sum}");
    assert_eq!([pmf(count as u32), pmf(u32::MAX)], [0.0; 2], "{name}");
    let mut counts = vec![0_u64; count];
    let mut left = vec![0_u64; 64];
    let mut pairs = Vec::new();
    for i in (0..draws).step_by(8) {
        let u: Vec2<f32x8> = Independent::new(3).pair(u32x8::splat(0), u32x8::from_fn(|k| i + k as u32), 0);
        let eight = packet(u.x);
        for k in 0..8 {
            let one = choose(u.x.lane(k));
            assert_eq!((eight.index.lane(k), eight.pmf.lane(k), eight.u.lane(k)), (one.index, one.pmf, one.u));
            assert_eq!(one.pmf, pmf(one.index), "{name}: light {}", one.index);
            assert!((0.0..1.0).contains(&one.u));
            counts[one.index as usize] += 1;
            // of a light that few numbers choose, the number left has few values
            if one.pmf > 5e-4 {
                left[(one.u * 64.0) as usize] += 1;
                pairs.push((f64::from(one.index), f64::from(one.u)));
            }
        }
    }
    let expected: Vec<f64> = probabilities.iter().map(|p| p * f64::from(draws)).collect();
    let p = stats::chi_square(&counts, &expected);
    assert!(p > SIGNIFICANCE, "{name}: frequencies, p = {p}");
    assert!(stats::uniform(&left) > SIGNIFICANCE, "{name}: number left, p = {}", stats::uniform(&left));
    if count > 1 {
        let z = stats::correlation(&pairs) * (pairs.len() as f64).sqrt();
        assert!(stats::two_sided(z) > SIGNIFICANCE, "{name}: {z}");
    }
}

#[test]
fn uniform() {
    for count in [1, 2, 3, 10, 1000] {
        let lights = UniformLights { count };
        check("uniform", count as usize, |u| lights.choose(u), |u| lights.choose(u), |k| lights.pmf(k));
    }
    for count in [1, 3, 4_000_000, 1 << 22] {
        let last = UniformLights { count }.choose(f32::ONE_MINUS_EPSILON);
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
        let mut sums = vec![0.0; powers.len()];
        let lights = PowerLights::new(powers, &mut sums).unwrap();
        check("power", powers.len(), |u| lights.choose(u), |u| lights.choose(u), |k| lights.pmf(k));
        for (k, power) in powers.iter().enumerate() {
            let pmf = lights.pmf::<f32>(k as u32);
            assert_eq!(*power > 0.0, pmf > 0.0, "{powers:?}");
        }
        for u in [0.0, f32::ONE_MINUS_EPSILON, 1.0] {
            let choice = lights.choose(u);
            assert!(powers[choice.index as usize] > 0.0 && choice.pmf > 0.0);
        }
    }
    // in proportion, where nothing is lifted
    let mut sums = [0.0; 3];
    let lights = PowerLights::new(&[3.0, 1.0, 4.0], &mut sums).unwrap();
    assert_eq!([0, 1, 2].map(|k| lights.pmf::<f32>(k)), [0.375, 0.125, 0.5]);
    for powers in [&[][..], &[0.0, 0.0], &[f32::NAN, -1.0]] {
        let mut sums = vec![7.0; powers.len()];
        let choice = PowerLights::new(powers, &mut sums).unwrap().choose(0.3_f32);
        assert_eq!((choice.pmf, choice.u), (0.0, 0.0));
    }
    // a table that does not fit the lights is refused, not cut
    let mut sums = vec![0.0; PowerLights::MOST + 1];
    let powers = vec![1.0; sums.len()];
    assert_eq!(PowerLights::new(&powers, &mut sums).err(), Some(TableError::Length));
    assert_eq!(PowerLights::new(&powers[..3], &mut sums[..2]).err(), Some(TableError::Length));
    assert_eq!(PowerLights::new(&powers[..2], &mut sums[..3]).err(), Some(TableError::Length));
}

/// Each of 2¹⁴ lights, one of them 10³⁰ times as strong as the others, is found by some u of the grid, in its due share.
#[test]
fn weak_lights_are_found() {
    let mut powers = vec![1e-20_f32; 1 << 14];
    powers[5000] = 1e10;
    let mut sums = vec![0.0; powers.len()];
    let lights = PowerLights::new(&powers, &mut sums).unwrap();
    let mut counts = vec![0_u32; powers.len()];
    for i in (0..1 << 24).step_by(8) {
        let u = f32x8::from_fn(|k| (i + k) as f32 / 16_777_216.0);
        let index = lights.choose(u).index;
        for k in 0..8 {
            counts[index.lane(k) as usize] += 1;
        }
    }
    for (k, &count) in counts.iter().enumerate() {
        let off = f64::from(count) - f64::from(lights.pmf::<f32>(k as u32)) * 16_777_216.0;
        assert!(count > 0 && off.abs() <= 2.0, "light {k}: {count}, off by {off}");
    }
}

fn bounds() -> Vec<LightBound> {
    let light = |x: f32, y: f32, z: f32, radius: f32, power: f32| LightBound { center: [x, y, z], radius, power };
    vec![
        light(0.0, 0.0, 2.0, 0.5, 1.0),
        light(3.0, 0.0, 0.0, 0.0, 4.0),
        light(0.0, 1.0, 0.0, 0.1, 0.0),
        light(-1.0, -2.0, 5.0, 2.0, 30.0),
        light(1e4, 0.0, 0.0, 1.0, 0.5),
    ]
}

#[test]
fn spatial() {
    let list = bounds();
    let lights = SpatialLights { lights: &list };
    for p in [[0.0, 0.0, 0.0], [0.0, 0.0, 2.0], [3.0, 0.0, 0.0], [1e4, 0.5, 0.0], [-1e6, 0.0, 0.0]] {
        let (one, eight) = (Vec3::from(p), Vec3::<f32x8>::from(p));
        check("spatial", list.len(), |u| lights.choose(one, u), |u| lights.choose(eight, u), |k| lights.pmf(one, k));
        for (k, light) in list.iter().enumerate() {
            assert_eq!(light.power > 0.0, lights.pmf(one, k as u32) > 0.0_f32);
        }
    }
    // the formula, where nothing is lifted: 1/4, 4/9, 30/30 and 0.5/10⁸, which is
    let pmf = [0, 1, 3].map(|k| f64::from(lights.pmf::<f32>([0.0, 0.0, 0.0].into(), k)));
    for (pmf, weight) in pmf.iter().zip([0.25, 4.0 / 9.0, 1.0]) {
        assert!((pmf / pmf_sum(&pmf_all(&lights)) - weight / (0.25 + 4.0 / 9.0 + 1.0)).abs() < 1e-4, "{pmf}");
    }
    // the distance is no less than the radius
    let inside = lights.pmf::<f32>([-1.0, -2.0, 5.0].into(), 3);
    let surface = lights.pmf::<f32>([-1.0, -2.0, 5.0 + 1e-3].into(), 3);
    assert!((inside - surface).abs() < 1e-2 && inside > 0.8, "{inside} {surface}");
    for none in [&[][..], &list[2..3]] {
        let choice = SpatialLights { lights: none }.choose([0.0, 1.0, 0.0].into(), 0.3_f32);
        assert_eq!(choice.pmf, 0.0);
    }
}

fn pmf_all(lights: &SpatialLights) -> Vec<f64> {
    (0..lights.lights.len() as u32).map(|k| f64::from(lights.pmf::<f32>([0.0, 0.0, 0.0].into(), k))).collect()
}
fn pmf_sum(all: &[f64]) -> f64 {
    all.iter().sum()
}

#[test]
fn spatial_choice_knows_no_unit() {
    let list = bounds();
    let p = [0.7_f32, -0.3, 0.2];
    for exponent in [-60, -20, 20, 60] {
        let scale = 2.0_f32.powi(exponent);
        let scaled: Vec<_> = list
            .iter()
            .map(|l| LightBound { center: l.center.map(|c| c * scale), radius: l.radius * scale, power: l.power })
            .collect();
        for k in 0..64 {
            let u = (k as f32 + 0.5) / 64.0;
            let one: Choice<f32> = SpatialLights { lights: &list }.choose(p.into(), u);
            let other: Choice<f32> = SpatialLights { lights: &scaled }.choose(p.map(|x| x * scale).into(), u);
            assert_eq!((one.index, one.pmf, one.u), (other.index, other.pmf, other.u), "2^{exponent}");
        }
    }
    // limits of single precision: no NaN, no infinity, probabilities positive
    for far in [f32::MAX, 1e-45, 1e30] {
        let ends = [far, -far].map(|x| LightBound { center: [x, x, x], radius: 0.0, power: 1.0 });
        for p in [[0.0; 3], [far; 3], [1.0; 3]] {
            let choice: Choice<f32x4> = SpatialLights { lights: &ends }.choose(p.into(), f32x4::splat(0.7));
            assert!(choice.pmf.lane(2) > 0.0 && choice.pmf.lane(2) <= 1.0, "{far} {p:?} {choice:?}");
        }
    }
}

/// A light of no power may be the nearest one, also at no distance at all.
#[test]
fn a_dark_light_is_no_nearest() {
    let dark = LightBound { center: [0.0, 0.0, 0.0], radius: 0.0, power: 0.0 };
    let lit = LightBound { center: [0.0, 0.0, 1e30], radius: 0.1, power: 1.0 };
    let lights = [dark, lit];
    for p in [[0.0_f32, 0.0, 0.0], [0.0, 0.0, 1e-30]] {
        let table = SpatialLights { lights: &lights };
        let choice = table.choose(p.into(), 0.5_f32);
        assert_eq!((choice.index, choice.pmf), (1, 1.0));
        assert_eq!([0, 1].map(|i| table.pmf::<f32>(p.into(), i)), [0.0, 1.0]);
    }
}
