//! Sequences of random numbers and of points.

mod joint;
mod random;
mod sobol;

use etendue::sequence::{Independent, JointSobol, OwenSobol, Sequence, Stratified, ZOrder};
use etendue::{Uint, Vec2, f32x8};
use etendue_judge::generators::AlongCurve;

#[test]
fn packets_are_scalars() {
    fn check(name: &str, sequence: &impl Sequence) {
        for start in [0, 1, 65_535, 1 << 24, 0x7fff_fff0, u32::MAX - 8] {
            for dimension in [0, 1, 2, 3, 5, u32::MAX] {
                let pixels = |k: usize| start.wrapping_add(k as u32 * 977);
                let samples = |k: usize| (start / 2).wrapping_add(k as u32 * 3);
                let eight: Vec2<f32x8> = sequence.pair(Uint::from_fn(pixels), Uint::from_fn(samples), dimension);
                for k in 0..8 {
                    let one: Vec2<f32> = sequence.pair(pixels(k), samples(k), dimension);
                    assert!((0.0..1.0).contains(&one.x) && (0.0..1.0).contains(&one.y), "{name}: {one:?}");
                    assert_eq!(eight.lane(k), one, "{name}, lane {k}");
                    let wide: Vec2<f64> = sequence.pair(pixels(k), samples(k), dimension);
                    // f64 does not round the point
                    let off = (wide.x - f64::from(one.x)).abs().max((wide.y - f64::from(one.y)).abs());
                    assert!(off < 2.4e-7, "{name}: {one:?} {wide:?}");
                }
            }
        }
    }
    check("independent", &Independent::new(3));
    check("owen sobol", &OwenSobol::new(3));
    check("joint sobol", &JointSobol::new(3));
    for count in [0, 1, 2, 7, 64, 100, 4096, u32::MAX] {
        check("jitter", &Stratified::new(3, count));
        check("z-order", &AlongCurve(ZOrder::new(3, count)));
    }
}
