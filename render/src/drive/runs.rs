//! The samples of a tile, in packets of eight.

use crate::packet::M8;
use crate::sampler::Packet;
use crate::scene::area::{Area, TILE};
use etendue::{Mask, u32x8};
use std::ops::Range;

/// The pixels of an area [x0, y0, x1, y1) along a Z-order curve, so that successive pixels are close in the image.
pub(super) fn z_order([x0, y0, x1, y1]: Area) -> Vec<[u32; 2]> {
    let even = |i: u32| (0..4).fold(0, |n, bit| n | (i >> (2 * bit) & 1) << bit);
    let all = (0..TILE * TILE).map(|i| [x0 + even(i), y0 + even(i >> 1)]);
    all.filter(|&[x, y]| x < x1 && y < y1).collect()
}

/// Successive samples of one set of a pixel.
#[derive(Clone, Copy)]
pub(super) struct Run {
    pub(super) pixel: [u32; 2],
    pub(super) set: u32,
    /// The next sample, and the end, counted within the set.
    pub(super) next: u32,
    pub(super) end: u32,
    /// Whether no sample of the set has been taken.
    pub(super) is_new: bool,
    /// Whether no set of the pixel follows.
    pub(super) last_set: bool,
}

/// Lanes of a packet that belong to one run.
pub(super) struct TilePiece {
    pub(super) packet: usize,
    pub(super) lanes: Range<usize>,
    /// The run from the first of these lanes on.
    pub(super) run: Run,
}

/// The next eight samples of successive runs.
#[inline]
pub(super) fn next_packet(
    run: &mut Option<Run>,
    runs: &mut impl Iterator<Item = Run>,
    set_size: u32,
    packet: usize,
    pieces: &mut Vec<TilePiece>,
) -> Packet {
    let lanes = u32x8::new([0, 1, 2, 3, 4, 5, 6, 7]);
    let first = run.unwrap_or_else(|| unreachable!("there is a run"));
    if first.end - first.next >= 8 {
        let next = first.next + 8;
        pieces.push(TilePiece { packet, lanes: 0..8, run: first });
        *run = if next == first.end { runs.next() } else { Some(Run { next, is_new: false, ..first }) };
        let [x, y] = first.pixel.map(u32x8::splat);
        let sample = u32x8::splat(first.set * set_size + first.next) + lanes;
        return Packet { x, y, sample, set: u32x8::splat(first.set), active: M8::splat(true) };
    }
    let (mut x, mut y, mut sample, mut set) = ([0; 8], [0; 8], [0; 8], [0; 8]);
    let mut filled = 0;
    while filled < 8
        && let Some(current) = *run
    {
        let taken = (current.end - current.next).min(8 - filled);
        let range = filled as usize..(filled + taken) as usize;
        for lane in range.clone() {
            [x[lane], y[lane]] = current.pixel;
            sample[lane] = current.set * set_size + current.next + lane as u32 - filled;
            set[lane] = current.set;
        }
        filled += taken;
        let next = current.next + taken;
        pieces.push(TilePiece { packet, lanes: range, run: current });
        *run = if next == current.end { runs.next() } else { Some(Run { next, is_new: false, ..current }) };
    }
    // the last packet of a tile repeats its last sample
    for lane in filled as usize..8 {
        let last = filled as usize - 1;
        (x[lane], y[lane], sample[lane], set[lane]) = (x[last], y[last], sample[last], set[last]);
    }
    Packet {
        x: u32x8::new(x),
        y: u32x8::new(y),
        sample: u32x8::new(sample),
        set: u32x8::new(set),
        active: M8::from_bits((1 << filled) - 1),
    }
}
