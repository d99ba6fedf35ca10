//! Trees of lights.

use crate::memory::{columns, refuse_null, skip_empty, vec3};
use crate::status::EtendueStatus;
use core::mem::{align_of, offset_of, size_of};
use core::slice::{from_raw_parts, from_raw_parts_mut};
use etendue::select::{LightBound, LightTree, Node8};
use etendue_batch::memory::TreeMemory;
use etendue_batch::{Batch, ChoiceColumns};

/// A bound of what a light of finite extent can contribute.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueLightBound {
    /// Centre of a sphere around the light, in the coordinates of the scene. A flat light is centred on it.
    pub center: [f32; 3],
    /// Radius of that sphere, not negative; 0 for a point or spot light.
    pub radius: f32,
    /// Unit normal of a flat light, or axis of a spot light; 0 for a light that emits in all directions.
    pub normal: [f32; 3],
    /// Cosine of the angle to `normal` from which on a spot light is dark; 0 for other lights.
    pub cos_cone: f32,
    /// 1 if a flat light emits from both sides, else 0.
    pub two_sided: u8,
    /// Power of one side of a flat light, or of all of another light, in any unit.
    pub power: f32,
}
const _: () = assert!(
    size_of::<LightBound>() == size_of::<EtendueLightBound>()
        && offset_of!(LightBound, two_sided) == offset_of!(EtendueLightBound, two_sided)
        && offset_of!(LightBound, power) == offset_of!(EtendueLightBound, power)
);

/// A node of a tree, whose inside does not concern callers.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueLightTreeNode {
    data: [u32; 90],
}
const _: () = assert!(
    size_of::<Node8>() == size_of::<EtendueLightTreeNode>()
        && align_of::<Node8>() <= align_of::<EtendueLightTreeNode>()
);

/// A tree of lights, in memory of the caller: it chooses a light for a shading point, with a probability that is positive wherever the
/// light can contribute.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueLightTree {
    /// The nodes that [`etendue_light_tree_build`] wrote.
    pub nodes: *const EtendueLightTreeNode,
    /// Number of nodes.
    pub node_count: usize,
    /// The place of each light, that [`etendue_light_tree_build`] wrote.
    pub places: *const u32,
    /// Number of lights.
    pub light_count: usize,
}

const _: () = assert!(size_of::<EtendueLightTree>() == size_of::<TreeMemory<'_>>());

impl EtendueLightTree {
    fn is_built(&self) -> bool {
        !self.nodes.is_null() && !self.places.is_null()
    }
}

/// Columns of chosen lights, each NULL or of as many elements as the batch has.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueChoiceColumns {
    /// Index of the light; UINT32_MAX where none was chosen, since a part of the tree was reached none of whose lights can contribute.
    pub light: *mut u32,
    /// Probability with which it was chosen; 0 where none was.
    pub pmf: *mut f32,
    /// What is left of the random number: uniform in [0, 1), independent of the light.
    pub u: *mut f32,
}

/// Number of nodes that a tree of `light_count` lights needs.
#[unsafe(no_mangle)]
pub extern "C" fn etendue_light_tree_nodes(light_count: usize) -> usize {
    LightTree::nodes_for(light_count)
}

/// Builds a tree.
///
/// `nodes` has [`etendue_light_tree_nodes`] elements, `places` has `light_count`; both must live as long as `tree` is used. A light whose
/// power is not positive and finite is never chosen. Returns ETENDUE_STATUS_COUNT for more than 2^27 lights,
/// and ETENDUE_STATUS_VALUE if a `two_sided` is neither 0 nor 1.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_light_tree_build(
    lights: *const EtendueLightBound,
    light_count: usize,
    nodes: *mut EtendueLightTreeNode,
    places: *mut u32,
    tree: *mut EtendueLightTree,
) -> EtendueStatus {
    refuse_null!(lights, nodes, places, tree);
    if light_count > LightTree::MOST {
        return EtendueStatus::Count;
    }
    let node_count = LightTree::nodes_for(light_count);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        if from_raw_parts(lights, light_count).iter().any(|light| light.two_sided > 1) {
            return EtendueStatus::Value;
        }
        for i in 0..node_count {
            nodes.cast::<Node8>().add(i).write(Node8::default());
        }
        places.write_bytes(0, light_count);
        // both structs have the same fields, and all values of `two_sided` are 0 or 1
        let lights = from_raw_parts(lights.cast::<LightBound>(), light_count);
        let slots = from_raw_parts_mut(nodes.cast::<Node8>(), node_count);
        if LightTree::build(lights, slots, from_raw_parts_mut(places, light_count)).is_err() {
            return EtendueStatus::Count;
        }
        tree.write(EtendueLightTree { nodes, node_count, places, light_count });
    }
    EtendueStatus::Ok
}

/// Chooses a light for each shading point, in columns. `n` are the unit normals there, `u` one column of random numbers in [0, 1).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_light_tree_choose_batch(
    tree: *const EtendueLightTree,
    n: usize,
    p: *const *const f32,
    normals: *const *const f32,
    u: *const f32,
    out: *const EtendueChoiceColumns,
) -> EtendueStatus {
    skip_empty!(n);
    refuse_null!(tree, u, out);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let (Some(p), Some(normals), true) = (columns(p), columns(normals), (*tree).is_built()) else {
            return EtendueStatus::NullPointer;
        };
        let tree = &*tree.cast::<TreeMemory<'_>>();
        let EtendueChoiceColumns { light, pmf, u: rest } = *out;
        let out = ChoiceColumns { light, pmf, u: rest };
        (Batch::new().tree().choose)(tree, n, vec3(p), vec3(normals), u, &out);
    }
    EtendueStatus::Ok
}

/// The probability with which each of `lights` is chosen for each shading point, in columns: for multiple importance sampling.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_light_tree_pmf_batch(
    tree: *const EtendueLightTree,
    n: usize,
    p: *const *const f32,
    normals: *const *const f32,
    lights: *const u32,
    out: *mut f32,
) -> EtendueStatus {
    skip_empty!(n);
    refuse_null!(tree, lights, out);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let (Some(p), Some(normals), true) = (columns(p), columns(normals), (*tree).is_built()) else {
            return EtendueStatus::NullPointer;
        };
        let tree = &*tree.cast::<TreeMemory<'_>>();
        (Batch::new().tree().pmf)(tree, n, vec3(p), vec3(normals), lights, out);
    }
    EtendueStatus::Ok
}
