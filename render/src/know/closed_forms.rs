//! Closed forms of the visible part of a light, in single and in double precision, for packets of single precision.
//!
//! In single precision, two packets of points that see a light past the same occluders are computed at once: a packet of sixteen takes less
//! time than two of eight, with AVX2 and with AVX-512 (`cargo bench -p etendue-benches --bench summary -- visible` prints both), and the
//! successive packets of a tile mostly see the same.

use crate::packet::{M8, V8, X8, widen, widen_points};
use etendue::reflection::Reflection;
use etendue::{Real, Vec3, f32x16, f64x8};
use etendue_visible::{Occlusion, Precision, Solid};
use std::ops::Range;

/// A packet that asks for the visible part of a light.
pub(super) struct Ask {
    pub(super) packet: usize,
    /// Lanes that need it.
    pub(super) lanes: M8,
    /// Points and normals.
    pub(super) at: [V8; 2],
    /// Which of the solids may occlude the light.
    pub(super) behind: Range<usize>,
    pub(super) precision: Precision,
}

/// Computes closed forms, and holds the memory for it.
#[derive(Default)]
pub(super) struct ClosedForms {
    one: Box<Occlusion<X8>>,
    /// Both made when they are first needed.
    two: Option<Box<Occlusion<f32x16>>>,
    exact: Option<Box<Occlusion<f64x8>>>,
    waiting: Option<Ask>,
    /// [`RayCount::forms`](crate::bvh::RayCount::forms) since the last look.
    pub(super) count: u64,
}

fn joined(a: V8, b: V8) -> Vec3<f32x16> {
    let join = |a: X8, b: X8| {
        let (a, b) = (a.to_array(), b.to_array());
        f32x16::new(std::array::from_fn(|i| if i < 8 { a[i] } else { b[i - 8] }))
    };
    Vec3::new(join(a.x, b.x), join(a.y, b.y), join(a.z, b.z))
}

impl ClosedForms {
    /// What points with these normals see of a light past occluders, or reflect by a lobe: [`Occlusion::visible`] or
    /// [`Occlusion::reflected`] in the precision that the occluders need.
    pub(super) fn part(
        &mut self,
        at: [V8; 2],
        lobe: Option<&Reflection<X8>>,
        light: &Solid,
        (occluders, precision): (&[Solid], Precision),
    ) -> Option<X8> {
        if precision != Precision::Double {
            return part(&mut self.one, at, lobe, light, occluders);
        }
        let (exact, lobe) = (self.exact.get_or_insert_default(), lobe.map(|lobe| lobe.map(widen)));
        let part = part(exact, at.map(widen_points), lobe.as_ref(), light, occluders)?;
        Some(X8::from(part.to_array().map(|part| part as f32)))
    }
    /// The visible part for one more packet. `done` takes packets, sooner or later, with their parts, which may be unknown.
    pub(super) fn add(&mut self, ask: Ask, light: &Solid, solids: &[Solid], mut done: impl FnMut(&Ask, Option<X8>)) {
        if ask.precision == Precision::Double {
            done(&ask, self.alone(&ask, light, solids));
            return;
        }
        let Some(first) = self.waiting.take() else {
            self.waiting = Some(ask);
            return;
        };
        if first.behind != ask.behind {
            done(&first, self.alone(&first, light, solids));
            self.waiting = Some(ask);
            return;
        }
        let [point, normal] = [0, 1].map(|k| joined(first.at[k], ask.at[k]));
        let two = self.two.get_or_insert_default();
        let both = two.visible(point, normal, light, &solids[first.behind.clone()]);
        self.count += 2 * work(&first, two.terms());
        if let Some(both) = both {
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
        let part = self.part(ask.at, None, light, (&solids[ask.behind.clone()], ask.precision));
        self.count += match &self.exact {
            Some(exact) if ask.precision == Precision::Double => 2 * work(ask, exact.terms()),
            _ => work(ask, self.one.terms()),
        };
        part
    }
}

/// How long a packet of eight takes, in units of a light that nothing hides: a part that is hidden takes about as long as two.
fn work(ask: &Ask, terms: u32) -> u64 {
    1 + ask.behind.len() as u64 + 2 * u64::from(terms)
}

#[inline]
fn part<R: Real>(
    occlusion: &mut Occlusion<R>,
    [point, normal]: [Vec3<R>; 2],
    lobe: Option<&Reflection<R>>,
    light: &Solid,
    occluders: &[Solid],
) -> Option<R> {
    match lobe {
        Some(lobe) => occlusion.reflected(point, normal, lobe, light, occluders),
        None => occlusion.visible(point, normal, light, occluders),
    }
}
