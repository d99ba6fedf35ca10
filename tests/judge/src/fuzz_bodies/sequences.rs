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

/// Which of `cells` equal parts of [0, 1) contains `u`.
fn cell(u: f32, cells: u32) -> usize {
    // exact if `cells` is a power of two; otherwise rounding to the grid of 2⁻²⁴ may carry a point over an edge
    (f64::from(u) * f64::from(cells)) as usize
}
/// Which cell contains `u`; none if it is on an edge, onto which a point may have been rounded from below.
fn inside(u: Vec2<f32>, columns: u32, rows: u32) -> Option<usize> {
    let on_an_edge = |u: f32, cells: u32| (f64::from(u) * f64::from(cells)).fract() == 0.0;
    let some = !on_an_edge(u.x, columns) && !on_an_edge(u.y, rows);
    some.then(|| cell(u.x, columns) + cell(u.y, rows) * columns as usize)
}
/// Asserts that `count` samples fall one into each of `count` cells; the few on edges are ignored.
fn once(cells: impl Iterator<Item = Option<usize>>, count: usize, what: impl core::fmt::Debug) {
    let (mut taken, mut samples) = (vec![false; count], 0);
    for cell in cells {
        samples += 1;
        if let Some(cell) = cell {
            assert!(!taken[cell], "cell {cell} of {count} twice: {what:?}");
            taken[cell] = true;
        }
    }
    assert_eq!(samples, count);
}

/// Each replicate has one sample in every stratum and each box of a net the same number, from any start.
pub(super) fn strata(input: &mut Input<'_>) {
    let (seed, kind) = (input.seed(), input.below(4));
    let [pixel, start] = counters(input);
    let draw = |sequence: &Stratified, sample, dimension| -> Vec2<f32> { sequence.pair(pixel, sample, dimension) };
    match kind {
        0 => {
            // a power of two, so that no point is rounded over an edge
            let strata = Stratified::new(seed, 1 << input.below(9));
            let ([columns, rows], count) = (strata.grid(), strata.count());
            let first = start % (1 << 31) / count * count;
            let dimension = input.word();
            let of = |u| inside(u, columns, rows);
            once((0..count).map(|i| of(draw(&strata, first + i, dimension))), count as usize, (strata, pixel, first));
        }
        1 => {
            // one sample in each interval of a coordinate, and equal numbers in the boxes of one pair
            let (owen, bits) = (OwenSobol::new(seed), u32::from(1 + input.below(8)));
            let (count, dimension) = (1_u32 << bits, input.word());
            let first = start >> bits << bits;
            let all: Vec<Vec2<f32>> = (0..count).map(|i| owen.pair(pixel, first + i, dimension)).collect();
            let across = u32::from(input.below(9)).min(bits);
            let of = |u: &Vec2<f32>| cell(u.x, 1 << across) << (bits - across) | cell(u.y, 1 << (bits - across));
            once(all.iter().map(|u| Some(of(u))), count as usize, (owen, pixel, first, across));
        }
        _ => net(input, seed, pixel, start),
    }
}

/// Boxes of the joint sequence's net in up to six dimensions: 2ᵗ points in each box of volume 2ᵗ⁻ᵐ.
fn net(input: &mut Input<'_>, seed: u64, pixel: u32, start: u32) {
    const T: [u32; 6] = [0, 0, 1, 3, 5, 8];
    let dimensions = 1 + u32::from(input.below(6));
    let t = T[dimensions as usize - 1];
    let m = t + u32::from(input.below(4));
    let mut sides = [0_u32; 6];
    for _ in t..m {
        sides[usize::from(input.below(dimensions as u8))] += 1;
    }
    let (sobol, first) = (JointSobol::new(seed), start >> m << m);
    let mut boxes = vec![0_u32; 1 << (m - t)];
    for i in 0..1 << m {
        let mut place = 0;
        for pair in 0..dimensions.div_ceil(2) {
            let u: Vec2<f32> = sobol.pair(pixel, first + i, pair);
            for (x, side) in [u.x, u.y].into_iter().zip(&sides[2 * pair as usize..]) {
                place = place << side | cell(x, 1 << side);
            }
        }
        boxes[place] += 1;
    }
    let even = boxes.iter().all(|n| *n == 1 << t);
    assert!(even, "boxes {:?} of 2^-{}: {boxes:?}: seed {seed}, pixel {pixel}, from {first}", &sides[..], m - t);
}
