//! The rays of a group, and the memory to trace them.

use super::node::Stack;
use super::rays::{GROUP, Rays};
use super::{frustum, instances, stream};
use std::ops::AddAssign;

/// Scratch memory for traversals, to be reused.
#[derive(Debug, Default)]
pub struct Scratch {
    pub(super) frustum: Stack<frustum::Pending>,
    pub(super) stream: stream::Scratch,
    pub(super) instances: Vec<instances::Visit>,
}

/// Numbers of rays traced for an image, and of what else takes time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCount {
    /// Rays from the camera.
    pub camera: u64,
    /// Further rays from the camera that only see what it sees directly, the lights and the sky.
    pub look: u64,
    /// Rays reflected by mirrors.
    pub mirror: u64,
    /// Rays towards a light, or over the hemisphere to find one.
    pub shadow: u64,
    /// Rays through the corners of pixels, which find the lights that matter there.
    pub corner: u64,
    /// Proofs that were asked for of what hides a light: no rays, but part of what an image costs.
    pub proofs: u64,
    /// Nodes of the tree and primitives that these proofs met.
    pub met: u64,
    /// Closed forms of diffuse light that were computed for eight points at a time: one for each light and for each solid that may hide it, and two for each
    /// part of the light that some of these solids hide together; in double precision twice as many.
    pub forms: u64,
}

impl AddAssign for RayCount {
    fn add_assign(&mut self, other: Self) {
        self.camera += other.camera;
        self.look += other.look;
        self.mirror += other.mirror;
        self.shadow += other.shadow;
        self.corner += other.corner;
        self.proofs += other.proofs;
        self.met += other.met;
        self.forms += other.forms;
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
