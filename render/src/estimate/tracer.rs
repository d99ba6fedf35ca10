//! The rays of a group, and the memory to trace them.

use super::points::keep;
use crate::bvh::{Bvh, GROUP, NOTHING, Rays, Scratch};
use crate::packet::{M8, V8, X8};
use etendue::{Mask, Real, u32x8};
use etendue_visible::SPARED;
use std::ops::AddAssign;

/// Numbers of rays traced for an image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCount {
    /// Rays from the camera.
    pub camera: u64,
    /// Rays reflected by mirrors.
    pub mirror: u64,
    /// Rays towards a light, or over the hemisphere to find one.
    pub shadow: u64,
    /// Rays through the corners of pixels, which find the lights that matter there.
    pub corner: u64,
}

impl AddAssign for RayCount {
    fn add_assign(&mut self, other: Self) {
        self.camera += other.camera;
        self.mirror += other.mirror;
        self.shadow += other.shadow;
        self.corner += other.corner;
    }
}

/// The rays of a group of packets, and the memory to trace them.
#[derive(Default)]
pub(crate) struct Tracer {
    /// Camera rays, then those that mirrors reflect.
    pub(crate) camera: Box<[Rays; GROUP]>,
    /// Rays from the shading points.
    pub(crate) shadow: Box<[Rays; GROUP]>,
    pub(crate) scratch: Scratch,
    /// Rays traced so far.
    pub(crate) count: RayCount,
}

/// What shadow rays of a group bring, if nothing occludes them.
pub(super) struct Unoccluded {
    /// The reflected radiance, in these lanes.
    pub(super) found: [V8; GROUP],
    pub(super) lanes: [M8; GROUP],
    /// Where the rays end, …
    limit: [X8; GROUP],
    /// … and the shapes there, which do not occlude themselves.
    target: [u32x8; GROUP],
}

impl Unoccluded {
    /// No rays; without a target, they end nowhere.
    pub(super) fn new() -> Self {
        Self {
            found: [V8::default(); GROUP],
            lanes: [M8::splat(false); GROUP],
            limit: [X8::lit(f64::INFINITY); GROUP],
            target: [u32x8::splat(NOTHING); GROUP],
        }
    }
    /// The rays of a packet end at these shapes, at this distance. They stop a little short, so that surfaces touching a light do not
    /// occlude it.
    #[inline(always)]
    pub(super) fn end_at(&mut self, packet: usize, distance: X8, shapes: u32x8) {
        self.limit[packet] = distance * X8::lit(1.0 - SPARED);
        self.target[packet] = shapes;
    }
    /// Traces the shadow rays of the first packets, and adds what arrives along those that are not occluded.
    #[inline(always)]
    pub(super) fn add(mut self, count: usize, bvh: &Bvh, tracer: &mut Tracer, reflected: &mut [V8; GROUP]) {
        let Tracer { shadow, scratch, .. } = tracer;
        let Self { found, lanes, limit, target } = &mut self;
        bvh.occluded(&shadow[..count], &mut lanes[..count], &limit[..count], &target[..count], scratch);
        for p in 0..count {
            reflected[p] += keep(found[p], lanes[p]);
        }
    }
}
