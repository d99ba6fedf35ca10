//! Sequences of numbers: they are uniform, and the nets and the strata that they claim to be.

mod nets;
mod sobol;
mod stratified;
mod uniform;

use etendue::Vec2;
use etendue::sequence::Sequence;

/// A pair of a sequence.
fn point(sequence: &impl Sequence, pixel: u32, sample: u32, dimension: u32) -> [f64; 2] {
    let u: Vec2<f32> = sequence.pair(pixel, sample, dimension);
    assert!((0.0..1.0).contains(&u.x) && (0.0..1.0).contains(&u.y), "{u:?}");
    [u.x, u.y].map(f64::from)
}
/// Two pairs as one point.
fn both([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 4] {
    [a, b, c, d]
}
/// The first four pairs of a sample as one point.
fn joint(sequence: &impl Sequence, pixel: u32, sample: u32) -> [f64; 8] {
    let pairs = [0, 1, 2, 3].map(|dimension| point(sequence, pixel, sample, dimension));
    core::array::from_fn(|k| pairs[k / 2][k % 2])
}
