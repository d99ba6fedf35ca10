//! The C interface, called with any counts, addresses, null pointers and numbers.

mod choice;
mod input;
mod memory;
mod technique;
mod warp;

use etendue::listed::light::TECHNIQUES;
use etendue::listed::warp::WARPS;
use etendue_c::*;
use input::Input;

/// Numbers of the largest light and of the largest sampler.
const LIGHT: usize = 24;
const SAMPLER: usize = 1200;
/// Columns of a sample: eleven of numbers and one of bytes.
const FIELDS: usize = 12;
const COUNTS: [usize; 7] = [0, 1, 7, 15, 16, 17, 100];
/// Bytes between columns, and what they hold.
const GAP: usize = 16;
const CANARY: u8 = 0xA5;

type Column = *const f32;
type Output = *mut f32;

/// Equal bits, or both NaN, whose bits depend on the order of operands.
fn same(a: f32, b: f32) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}
fn fields(s: &EtendueLightSample) -> [f32; FIELDS] {
    let ([a, b, c], [d, e, f], [g, h]) = (s.direction, s.normal, s.uv);
    [a, b, c, s.distance, s.pdf, s.weight, d, e, f, g, h, s.emits.into()]
}
fn sample_columns(c: [Output; FIELDS]) -> EtendueSampleColumns {
    EtendueSampleColumns {
        direction: [c[0], c[1], c[2]],
        distance: c[3],
        pdf: c[4],
        weight: c[5],
        normal: [c[6], c[7], c[8]],
        uv: [c[9], c[10]],
        emits: c[11].cast(),
    }
}
fn all_finite(columns: &[&[f32]]) -> bool {
    columns.iter().all(|column| column.iter().all(|x| x.is_finite()))
}
/// Any call of the C interface returns the documented status, writes what it should and nothing else, gives finite results for finite
/// numbers, and a batch gives the bits of its elements.
pub fn c_interface(bytes: &[u8]) {
    let mut input = Input { bytes: bytes.iter(), any: false, state: 0 };
    input.any = input.below(2) == 1;
    match input.below(TECHNIQUES + WARPS + 2) {
        k if k < TECHNIQUES => technique::check(&mut input, k),
        k if k < TECHNIQUES + WARPS => warp::check(&mut input, k - TECHNIQUES),
        k if k == TECHNIQUES + WARPS => choice::sequence(&mut input),
        _ => choice::tree(&mut input),
    }
}
