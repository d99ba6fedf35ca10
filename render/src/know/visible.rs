//! Visible parts of a light in single precision: of two packets of points at once, where both have the same occluders.
//!
//! A packet of sixteen takes less time than two of eight, with AVX2 and with AVX-512 (`cargo bench -p etendue-benches --bench summary --
//! visible` prints both), and the successive packets of a tile mostly see the same.

use crate::packet::{M8, V8, X8};
use etendue::{Vec3, f32x16};
use etendue_visible::{Occlusion, Solid};
use std::ops::Range;

/// A packet that waits for the visible part of a light.
pub(super) struct Ask {
    pub(super) packet: usize,
    /// Lanes that need it.
    pub(super) lanes: M8,
    pub(super) point: V8,
    pub(super) normal: V8,
    /// Which of the solids may occlude the light.
    pub(super) behind: Range<usize>,
}

/// Computes the visible parts of a light, and holds the memory for it.
#[derive(Default)]
pub(super) struct Visible {
    pub(super) one: Box<Occlusion<X8>>,
    /// Made when it is first needed.
    two: Option<Box<Occlusion<f32x16>>>,
    waiting: Option<Ask>,
}

fn joined(a: V8, b: V8) -> Vec3<f32x16> {
    let join = |a: X8, b: X8| {
        let (a, b) = (a.to_array(), b.to_array());
        f32x16::new(std::array::from_fn(|i| if i < 8 { a[i] } else { b[i - 8] }))
    };
    Vec3::new(join(a.x, b.x), join(a.y, b.y), join(a.z, b.z))
}

impl Visible {
    /// The visible part for one more packet. `done` takes packets, sooner or later, with their parts, which may be unknown.
    pub(super) fn add(&mut self, ask: Ask, light: &Solid, solids: &[Solid], mut done: impl FnMut(&Ask, Option<X8>)) {
        let Some(first) = self.waiting.take() else {
            self.waiting = Some(ask);
            return;
        };
        if first.behind != ask.behind {
            done(&first, self.alone(&first, light, solids));
            self.waiting = Some(ask);
            return;
        }
        let occluders = &solids[first.behind.clone()];
        let (point, normal) = (joined(first.point, ask.point), joined(first.normal, ask.normal));
        if let Some(both) = self.two.get_or_insert_default().visible(point, normal, light, occluders) {
            let both = both.to_array();
            let half = |from: usize| X8::new(std::array::from_fn(|lane| both[from + lane]));
            done(&first, Some(half(0)));
            done(&ask, Some(half(8)));
        } else {
            // what is too much for both together may not be for each
            done(&first, self.alone(&first, light, solids));
            done(&ask, self.alone(&ask, light, solids));
        }
    }
    /// The visible part for the packet that waits, if one does.
    pub(super) fn finish(&mut self, light: &Solid, solids: &[Solid], mut done: impl FnMut(&Ask, Option<X8>)) {
        if let Some(ask) = self.waiting.take() {
            done(&ask, self.alone(&ask, light, solids));
        }
    }
    fn alone(&mut self, ask: &Ask, light: &Solid, solids: &[Solid]) -> Option<X8> {
        self.one.visible(ask.point, ask.normal, light, &solids[ask.behind.clone()])
    }
}
