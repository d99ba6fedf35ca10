//! Daylight.

use etendue::{Real, Vec3, f32x8};
use etendue_judge::fuzz_bodies::Input;
use etendue_judge::packets::vectors_of;
use etendue_render::lights::sky::GeneralSky;

/// Skies of any type and sun, in any direction.
pub fn daylight(bytes: &[u8]) {
    let input = &mut Input::new(bytes);
    let kind = u32::from(input.below(17));
    let sun = input.vector(&[]).map(f64::from);
    let sky = GeneralSky::new(kind, sun);
    assert_eq!(sky.is_some(), (1..=15).contains(&kind) && sun != [0.0; 3], "{kind} {sun:?}");
    if let Some(sky) = sky {
        let zenith = sky.luminance(Vec3::new(0.0_f32, 0.0, 1.0));
        assert!((zenith - 1.0).abs() < 1e-6, "{kind} {sun:?}: {zenith}");
        for _ in 0..4 {
            let w = input.direction();
            let luminance = sky.luminance(vectors_of::<f32>(|_| w));
            assert!((0.0..1e4).contains(&luminance), "{kind} {sun:?} {w:?}: {luminance}");
            assert_eq!(luminance > 0.0, w[2] >= 0.0, "{kind} {sun:?} {w:?}: {luminance}");
            assert_eq!(sky.luminance::<f32x8>(vectors_of(|_| w)).lane(2).to_bits(), luminance.to_bits());
            let any = input.vector(&[w]);
            assert!(sky.luminance(vectors_of::<f32>(|_| any)).is_finite(), "{kind} {sun:?} {any:?}");
        }
    }
}
