//! Lights that emit other than evenly: profiles and spreads.

use etendue::{Parallelogram, SpotLight, Vec3, f32x8};
use etendue_judge::fuzz_bodies::Input;
use etendue_judge::packets::vectors_of;
use etendue_render::geometry::spread::Spread;
use etendue_render::packet::V8;
use etendue_render::scene::intensity::{Intensity, Profile, ProfileError};
use etendue_render::scene::light_profile::LuminousOpening;

/// One of two kinds of light, of any numbers.
pub fn emitters(bytes: &[u8]) {
    let input = &mut Input::new(bytes);
    match input.below(2) {
        0 => profile(input),
        _ => spread(input),
    }
}

/// Angles that are often valid.
fn angles(input: &mut Input<'_>, low: f32, high: f32) -> Vec<f32> {
    let mut angles: Vec<f32> = (0..input.below(6)).map(|_| low + (high - low) * input.unit()).collect();
    angles.extend([low, high]);
    angles.sort_by(f32::total_cmp);
    angles.dedup();
    match input.below(8) {
        0 => angles.reverse(),
        1 => angles.truncate(1),
        2 => angles[0] = input.number(),
        3 => angles[0] = f32::NAN,
        _ => {}
    }
    angles
}

/// Flat lights and spot lights with a profile: no factor and no power is infinite or below 0.
fn lamps(input: &mut Input<'_>, intensity: &Intensity) {
    let (axis, any) = (input.direction(), input.direction());
    // sums over many directions
    if input.below(64) != 0 {
        return;
    }
    let spot = SpotLight {
        position: Vec3::default(),
        axis: axis.into(),
        one_minus_cos_inner: 2.0 * input.unit(),
        one_minus_cos_outer: 2.0 * input.unit(),
    };
    let flux = intensity.flux_of_spot(&spot);
    assert!(flux >= 0.0 && flux.is_finite(), "{flux} by {spot:?}");
    let Some(opening) = LuminousOpening::new(axis.map(f64::from), input.below(2) == 1, intensity) else { return };
    let w: V8 = vectors_of(|_| any);
    let factor = opening.factor(w.dot(vectors_of(|_| axis)), intensity.at(w)).as_array()[4];
    assert!(
        opening.gain > 0.0 && factor >= 0.0 && factor.is_finite(),
        "{factor} by {opening:?} along {any:?} from {axis:?}"
    );
}

/// Tables that are no profile are refused; others have finite values between those of the table.
fn profile(input: &mut Input<'_>) {
    let [low, high] = [[0.0, 180.0], [0.0, 90.0], [90.0, 180.0], [30.0, 31.0]][input.below(4) as usize];
    let polar = angles(input, low, high);
    let [low, high] = [[0.0, 360.0], [-90.0, 90.0], [-270.0, 90.0]][input.below(3) as usize];
    let azimuth = angles(input, low, high);
    let mut values: Vec<f32> = (0..polar.len() * azimuth.len()).map(|_| input.weight()).collect();
    if input.below(6) == 0 {
        values[0] = -input.number();
    }
    let ascend = |angles: &[f32]| angles.iter().zip(&angles[1..]).all(|(a, b)| a < b);
    let [first, last] = [azimuth[0], azimuth[azimuth.len() - 1]];
    let is_turn = first > -360.0 && first <= 0.0 && last - first <= 360.0;
    let error = if polar.len() < 2 {
        Some(ProfileError::Length)
    } else if !(polar.iter().all(|x| (0.0..=180.0).contains(x)) && ascend(&polar) && ascend(&azimuth) && is_turn) {
        Some(ProfileError::Angle)
    } else if values.iter().any(|x| !(0.0..=1e37).contains(x)) {
        Some(ProfileError::Value)
    } else {
        None
    };
    let built = Profile::new(polar.clone(), azimuth.clone(), values.clone());
    assert_eq!(built.as_ref().err().copied(), error, "{polar:?} {azimuth:?} {values:?}");
    let Ok(profile) = built else { return };
    let greatest = values.iter().fold(0.0_f32, |most, &x| most.max(x));
    let power = profile.power();
    assert!((0.0..=f64::from(greatest) * 12.6).contains(&power), "{power} of {greatest}");
    for _ in 0..4 {
        let any = [(); 8].map(|()| [input.direction(), input.vector(&[])][input.below(2) as usize]);
        for (value, any) in profile.intensity(vectors_of(|lane| any[lane])).to_array().into_iter().zip(any) {
            assert!((0.0..=greatest * 1.000_001).contains(&value), "{value} of {greatest} at {any:?}");
            let alone = profile.intensity(vectors_of(|_| any)).to_array();
            assert_eq!(alone.map(f32::to_bits), [value.to_bits(); 8]);
        }
    }
    lamps(input, &Intensity::Angles(profile));
}

/// Parallelograms, points and spreads of any numbers: the part that is visible is in every lane the same and no larger than the light, and finite
/// unless a sum of coordinates is not.
fn spread(input: &mut Input<'_>) {
    let spread = Spread::<f32>::new(3.2 * f64::from(input.unit()));
    let p = input.vector(&[]);
    let a = input.vector(&[p]);
    let b = input.vector(&[a, p]);
    let c = input.vector(&[a, b]);
    let one = |v: [f32; 3]| -> Vec3<f32> { vectors_of(|_| v) };
    let eight = |v: [f32; 3]| -> Vec3<f32x8> { vectors_of(|_| v) };
    let factor = spread.attenuation(one(input.direction()), one(input.direction()));
    assert!(factor >= 0.0 && factor.is_finite(), "{factor}");
    let light = Parallelogram::new(one(a), one(b), one(c));
    let part = spread.visible_part(&light, one(p));
    assert!(part.edge_s.max_abs() <= light.edge_s.max_abs() && part.edge_t.max_abs() <= light.edge_t.max_abs());
    let parts = spread.splat().visible_part(&Parallelogram::new(eight(a), eight(b), eight(c)), eight(p));
    for (one, eight) in [(part.corner, parts.corner), (part.edge_s, parts.edge_s), (part.edge_t, parts.edge_t)] {
        let lane = [eight.x, eight.y, eight.z].map(|x| x.to_array()[3].to_bits());
        assert_eq!(one.to_array().map(f32::to_bits), lane, "{one:?}");
        let is_small = [p, a, b, c].concat().iter().all(|x| x.abs() < 1e37);
        assert!(!is_small || one.max_abs().is_finite(), "{one:?}");
    }
}
