//! Sequences.

use super::Input;
use crate::generators::AlongCurve;
use etendue::sequence::{Independent, JointSobol, OwenSobol, Sequence, Stratified, ZOrder};
use etendue::{Real, Uint, Vec2, f32x8, f32x16};

/// Every sequence at any index: points are in [0, 1)², and the same in packets and when evaluated again.
pub(super) fn sequence(input: &mut Input<'_>) {
    fn check(sequence: &(impl Sequence + core::fmt::Debug), pixel: u32, sample: u32, dimension: u32) {
        packet::<f32x8>(sequence, pixel, sample, dimension);
        packet::<f32x16>(sequence, pixel, sample, dimension);
    }
    fn packet<R: Real<Scalar = f32>>(
        sequence: &(impl Sequence + core::fmt::Debug),
        pixel: u32,
        sample: u32,
        dimension: u32,
    ) {
        let pixels = R::Uint::from_fn(|k| pixel.wrapping_add(k as u32));
        let samples = R::Uint::from_fn(|k| sample.wrapping_add(7 * k as u32));
        let packet: Vec2<R> = sequence.pair(pixels, samples, dimension);
        for k in 0..R::LANES {
            let one: Vec2<f32> = sequence.pair(pixels.lane(k), samples.lane(k), dimension);
            assert_eq!(packet.lane(k), one, "{sequence:?} lane {k}: pixel {pixel}, sample {sample}, {dimension}");
            let inside = (0.0..1.0).contains(&one.x) && (0.0..1.0).contains(&one.y);
            assert!(inside, "{sequence:?}: {one:?}: pixel {pixel}, sample {sample}, {dimension}");
            // f64 does not round the point
            let wide: Vec2<f64> = sequence.pair(pixels.lane(k), samples.lane(k), dimension);
            let off = (wide.x - f64::from(one.x)).abs().max((wide.y - f64::from(one.y)).abs());
            assert!(off < 2.4e-7, "{sequence:?}: {one:?}, {wide:?}: pixel {pixel}, sample {sample}, {dimension}");
        }
    }
    let (seed, kind) = (input.seed(), input.below(5));
    let [pixel, sample, dimension, count] = counters(input);
    match kind {
        0 => check(&Independent::new(seed), pixel, sample, dimension),
        1 => check(&Stratified::new(seed, count), pixel, sample, dimension),
        2 => check(&OwenSobol::new(seed), pixel, sample, dimension),
        3 => check(&AlongCurve(ZOrder::new(seed, count)), pixel, sample, dimension),
        _ => check(&JointSobol::new(seed), pixel, sample, dimension % 8),
    }
}
/// Counters: small ones, powers of two, the largest ones, and any.
fn counters<const N: usize>(input: &mut Input<'_>) -> [u32; N] {
    [(); N].map(|()| {
        let word = input.word();
        [word, word % 1024, u32::MAX - word % 16, 1_u32 << (word % 32)][input.below(4) as usize]
    })
}
