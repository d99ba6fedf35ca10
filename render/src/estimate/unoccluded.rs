//! Shadow rays of a group, and what they bring.

use crate::bvh::{Bvh, GROUP, PrimitiveIds, Tracer};
use crate::packet::{M8, V8, X8, keep};
use etendue::{Mask, Real};

/// What shadow rays of a group bring, if nothing occludes them.
pub(super) struct Unoccluded {
    /// The reflected radiance, in these lanes.
    pub(super) found: [V8; GROUP],
    pub(super) lanes: [M8; GROUP],
    /// Where the rays end, …
    limit: [X8; GROUP],
    /// … and the shapes there, which do not occlude themselves.
    target: [PrimitiveIds; GROUP],
}

impl Unoccluded {
    /// No rays; without a target, they end nowhere.
    pub(super) fn new() -> Self {
        Self {
            found: [V8::default(); GROUP],
            lanes: [M8::splat(false); GROUP],
            limit: [X8::lit(f64::INFINITY); GROUP],
            target: [PrimitiveIds::none(); GROUP],
        }
    }
    /// The rays of a packet end at these shapes, at this distance.
    #[inline(always)]
    pub(super) fn end_at(&mut self, packet: usize, distance: X8, shapes: PrimitiveIds) {
        self.limit[packet] = distance;
        self.target[packet] = shapes;
    }
    /// Traces the shadow rays of the first packets, and adds what arrives along those that are not occluded.
    #[inline(always)]
    pub(super) fn add(&mut self, count: usize, bvh: &Bvh, tracer: &mut Tracer, reflected: &mut [V8; GROUP]) {
        let Tracer { shadow, scratch, .. } = tracer;
        let Self { found, lanes, limit, target } = self;
        bvh.occluded(&shadow[..count], &mut lanes[..count], &limit[..count], &target[..count], scratch);
        for p in 0..count {
            reflected[p] += keep(found[p], lanes[p]);
        }
    }
}
