//! The sky through portals.

use crate::memory::{build_table, columns, each, outputs, refuse_null, skip_empty};
use crate::status::EtendueStatus;
use core::mem::size_of;
use core::ptr::{from_ref, null_mut};
use core::slice::from_raw_parts;
use etendue::light::{Portal, PortalEnvironment, PortalTable};
use etendue_batch::memory::{PortalMemory, PortalShape, PortalSums};
use etendue_batch::{Batch, PortalDirection, SeenThroughPortals};

/// A parallelogram through which the sky is seen, from the side that its normal s x t points away from.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtenduePortal {
    /// Corner, in the coordinates of the scene.
    pub corner: [f32; 3],
    /// Edge along s.
    pub edge_s: [f32; 3],
    /// Edge along t, not parallel to the other one.
    pub edge_t: [f32; 3],
}

/// The sky in the coordinates of a portal, as a table of sums in memory of the caller. Portals with parallel edges may share one.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtenduePortalTable {
    /// The table that [`etendue_portal_table_build`] wrote.
    pub sums: *const u64,
    /// Number of columns of the image.
    pub width: usize,
    /// Number of its rows.
    pub height: usize,
}

/// The part of an image of the sky that is seen through portals; the rest of the sky is hidden by walls.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtenduePortalEnvironment {
    /// The portals, at most 8.
    pub portals: *const EtenduePortal,
    /// The table of each portal.
    pub tables: *const EtenduePortalTable,
    /// Number of portals.
    pub count: usize,
}

impl EtenduePortalEnvironment {
    /// Whether the library can look into it.
    pub(crate) fn status(&self) -> EtendueStatus {
        let Self { portals, tables, count } = *self;
        refuse_null!(portals, tables);
        if !(1..=PortalEnvironment::MOST).contains(&count) {
            return EtendueStatus::Count;
        }
        // SAFETY: the pointers are not null, and point to what the header says
        for (portal, table) in unsafe { from_raw_parts(portals, count).iter().zip(from_raw_parts(tables, count)) } {
            refuse_null!(table.sums);
            if Portal::new(portal.corner, portal.edge_s, portal.edge_t).is_err() {
                return EtendueStatus::Value;
            }
            if etendue_portal_table(table.width, table.height) == 0 {
                return EtendueStatus::Count;
            }
        }
        EtendueStatus::Ok
    }
}
const _: () = {
    assert!(size_of::<EtenduePortal>() == size_of::<PortalShape>());
    assert!(size_of::<EtenduePortalTable>() == size_of::<PortalSums<'_>>());
    assert!(size_of::<EtenduePortalEnvironment>() == size_of::<PortalMemory<'_>>());
};

/// Number of 64-bit words in the table of an image in the coordinates of a portal; 0 for one without columns or rows, or with more than 4096
/// of them.
#[unsafe(no_mangle)]
pub extern "C" fn etendue_portal_table(width: usize, height: usize) -> usize {
    let sizes = 1..=4096;
    if sizes.contains(&width) && sizes.contains(&height) { PortalTable::buffer(width, height) } else { 0 }
}

/// Builds the table of an image in the coordinates of a portal, from a weight for each texel, row by row: the light that comes through it, so
/// radiance times solid angle. [`etendue_portal_direction`] gives the direction of a texel, and its solid angle.
///
/// `weights` has width x height elements, `sums` has [`etendue_portal_table`]; it must live as long as `table` is used, `weights` need not.
/// Returns ETENDUE_STATUS_COUNT for a size that is not allowed, and ETENDUE_STATUS_VALUE if a weight is negative, infinite or NaN, and if all
/// weights are 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_portal_table_build(
    weights: *const f32,
    width: usize,
    height: usize,
    sums: *mut u64,
    table: *mut EtenduePortalTable,
) -> EtendueStatus {
    refuse_null!(weights, sums, table);
    let length = etendue_portal_table(width, height);
    if length == 0 {
        return EtendueStatus::Count;
    }
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let status = build_table(weights, width * height, sums, length, |weights, sums| {
            PortalTable::build(weights, width, sums).is_ok()
        });
        if status == EtendueStatus::Ok {
            table.write(EtenduePortalTable { sums, width, height });
        }
        status
    }
}

/// The unit direction `w` at a position in the image of a portal, and the solid angle there per unit of the image's area, in steradians.
///
/// A direction x s + y t + z n, by the unit edges s and t and the normal n, has the position (atan(x/z)/pi + 1/2, atan(y/z)/pi + 1/2) in
/// [0, 1]^2. Only the directions of the edges count. `solid_angle` may be NULL. Returns ETENDUE_STATUS_VALUE if the edges are parallel or not
/// finite.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_portal_direction(
    portal: *const EtenduePortal,
    uv: *const f32,
    w: *mut f32,
    solid_angle: *mut f32,
) -> EtendueStatus {
    refuse_null!(uv, w);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe { directions(portal, 1, each(uv), each(w).map(<*const f32>::cast_mut), solid_angle) }
}

/// The unit direction and the solid angle at each position in the image of a portal: two columns in, three and one out.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_portal_direction_batch(
    portal: *const EtenduePortal,
    n: usize,
    uv: *const *const f32,
    w: *const *mut f32,
    solid_angle: *mut f32,
) -> EtendueStatus {
    skip_empty!(n);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let (Some(uv), Some(w)) = (columns(uv), outputs(w)) else { return EtendueStatus::NullPointer };
        directions(portal, n, uv, w, solid_angle)
    }
}

unsafe fn directions(
    portal: *const EtenduePortal,
    n: usize,
    [u, v]: [*const f32; 2],
    [x, y, z]: [*mut f32; 3],
    solid_angle: *mut f32,
) -> EtendueStatus {
    refuse_null!(portal);
    // SAFETY: the caller's
    unsafe {
        let EtenduePortal { edge_s, edge_t, .. } = portal.read();
        let Some(map) = PortalDirection::new(edge_s, edge_t) else { return EtendueStatus::Value };
        let (function, numbers) = (Batch::new().map_function::<PortalDirection>(), [u, v, u, u, u, u]);
        function(from_ref(&map).cast(), n, &numbers, &[x, y, z, solid_angle], null_mut());
    }
    EtendueStatus::Ok
}

/// Whether a ray from each point in each unit direction passes a portal towards the sky: 1 or 0. Three columns each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_portal_environment_sees_batch(
    environment: *const EtenduePortalEnvironment,
    n: usize,
    p: *const *const f32,
    w: *const *const f32,
    out: *mut u8,
) -> EtendueStatus {
    skip_empty!(n);
    refuse_null!(environment, out);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let (Some([px, py, pz]), Some([x, y, z])) = (columns(p), columns(w)) else { return EtendueStatus::NullPointer };
        let status = (*environment).status();
        if status == EtendueStatus::Ok {
            let function = Batch::new().map_function::<SeenThroughPortals<'_>>();
            function(environment.cast(), n, &[px, py, pz, x, y, z], &[null_mut(); 4], out);
        }
        status
    }
}

/// What the technique of this name prepares. It has no data of its own beside the environment and the point: each call prepares for the point,
/// which takes as long as some samples, so that batches are faster.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtenduePortalsByRadiance {
    /// The sky and its portals.
    pub environment: EtenduePortalEnvironment,
    /// The shading point.
    pub p: [f32; 3],
}
