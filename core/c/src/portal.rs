//! The sky through portals.

use crate::sampler::*;
use crate::{EtendueStatus, columns, each, each_mut, outputs, refuse_null};
use core::ptr::null_mut;
use core::slice::{from_raw_parts, from_raw_parts_mut};
use etendue::Vec3;
use etendue::light::{MOST_PORTALS, Portal, PortalEnvironment, PortalMap, PortalTable};
use etendue_batch::{Batch, BatchTechnique, PortalsByRadiance, SeenThroughPortals};

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

impl EtenduePortalTable {
    unsafe fn table(&self) -> Result<PortalTable<'static>, EtendueStatus> {
        let length = etendue_portal_table(self.width, self.height);
        if self.sums.is_null() {
            return Err(EtendueStatus::NullPointer);
        }
        if length == 0 {
            return Err(EtendueStatus::Count);
        }
        // SAFETY: `etendue_portal_table_build` wrote it
        let sums = unsafe { from_raw_parts(self.sums, length) };
        PortalTable::from_buffer(sums, self.width).map_err(|_| EtendueStatus::Count)
    }
}

impl EtenduePortalEnvironment {
    /// Calls `f` with the core's environment, unless the struct is not valid.
    unsafe fn with(&self, f: impl FnOnce(PortalEnvironment<'static>)) -> EtendueStatus {
        let Self { portals, tables, count } = *self;
        refuse_null!(portals, tables);
        if !(1..=MOST_PORTALS).contains(&count) {
            return EtendueStatus::Count;
        }
        let mut known = [None; MOST_PORTALS];
        // SAFETY: the pointers are not null, and point to what the header says
        unsafe {
            for (i, known) in known.iter_mut().take(count).enumerate() {
                let EtenduePortal { corner, edge_s, edge_t } = portals.add(i).read();
                let Some(portal) = Portal::new(corner, edge_s, edge_t) else { return EtendueStatus::Value };
                match (*tables.add(i)).table() {
                    Ok(table) => *known = Some((portal, table)),
                    Err(status) => return status,
                }
            }
            let Some(first) = known[0] else { return EtendueStatus::Count };
            let known = known.map(|own| own.unwrap_or(first));
            let (portals, tables) = (known.map(|own| own.0), known.map(|own| own.1));
            // the arrays live as long as `f` runs, which keeps nothing of them
            let (portals, tables) = (from_raw_parts(portals.as_ptr(), count), from_raw_parts(tables.as_ptr(), count));
            match PortalEnvironment::new(portals, tables) {
                Ok(environment) => f(environment),
                Err(_) => return EtendueStatus::Count,
            }
        }
        EtendueStatus::Ok
    }
}

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
    // SAFETY: the pointers are not null, and point to what the header says; every word of the table is written before it is read
    unsafe {
        let weights = from_raw_parts(weights, width * height);
        // before the table is written
        if weights.iter().any(|&w| !(0.0..f32::INFINITY).contains(&w)) || weights.iter().all(|&w| w == 0.0) {
            return EtendueStatus::Value;
        }
        sums.write_bytes(0, length);
        if PortalTable::build(weights, width, from_raw_parts_mut(sums, length)).is_err() {
            return EtendueStatus::Value;
        }
        table.write(EtenduePortalTable { sums, width, height });
    }
    EtendueStatus::Ok
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
    unsafe { directions(portal, 1, each(uv), each_mut(w), solid_angle) }
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
    if n == 0 {
        return EtendueStatus::Ok;
    }
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
        let Some(map) = PortalMap::new(edge_s, edge_t) else { return EtendueStatus::Value };
        let numbers = [u, v, u, u, u, u];
        (Batch::new().map_functions().map)(&map, n, &numbers, &[x, y, z, solid_angle], null_mut());
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
    if n == 0 {
        return EtendueStatus::Ok;
    }
    refuse_null!(environment, out);
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        let (Some([px, py, pz]), Some([x, y, z])) = (columns(p), columns(w)) else { return EtendueStatus::NullPointer };
        let numbers = [px, py, pz, x, y, z];
        (*environment).with(|environment| {
            let map = SeenThroughPortals(environment);
            (Batch::new().map_functions().map)(&map, n, &numbers, &[null_mut(); 4], out);
        })
    }
}

/// The sky through portals as a point sees it: from each point exactly the part is sampled that it sees, by the weights of the texels.
///
/// The pdf is the probability of the cells over the solid angle that they cover there, per steradian, summed over portals; 0 where no portal
/// is seen, and from behind. `uv` of a sample are the numbers that etendue_octahedral_sample maps to the direction.
///
/// It has no data of its own beside the environment and the point: each call prepares for the point, which takes as long as some samples, so
/// that batches are faster. The fields are set by `prepare`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtenduePortalsByRadiance {
    /// The sky and its portals.
    pub environment: EtenduePortalEnvironment,
    /// The shading point.
    pub p: [f32; 3],
}

impl Sampler for EtenduePortalsByRadiance {
    type Core = PortalsByRadiance<'static>;
    #[inline(always)]
    unsafe fn with(this: *const Self, f: impl FnOnce(&PortalsByRadiance<'static>)) -> EtendueStatus {
        refuse_null!(this);
        // SAFETY: the caller's
        unsafe {
            let Self { environment, p } = this.read();
            environment.with(|environment| {
                f(&PortalsByRadiance::prepared(environment, vec3(p), Vec3::new(0.0, 0.0, 0.0)));
            })
        }
    }
}
impl Technique for EtenduePortalsByRadiance {
    type Light = EtenduePortalEnvironment;
    type Columns = EtenduePortalEnvironment;
    #[inline(always)]
    unsafe fn prepare(
        environment: *const EtenduePortalEnvironment,
        p: Vec3<f32>,
        _: Vec3<f32>,
        out: *mut Self,
    ) -> EtendueStatus {
        // SAFETY: the caller's
        unsafe {
            let environment = environment.read();
            let status = environment.with(|_| ());
            if status == EtendueStatus::Ok {
                out.write(Self { environment, p: [p.x, p.y, p.z] });
            }
            status
        }
    }
    #[inline(always)]
    unsafe fn with_light(
        environment: *const EtenduePortalEnvironment,
        f: impl FnOnce(&PortalEnvironment<'static>),
    ) -> EtendueStatus {
        // SAFETY: the caller's
        unsafe { environment.read().with(|environment| f(&environment)) }
    }
    #[inline(always)]
    unsafe fn with_lights(
        environment: *const EtenduePortalEnvironment,
        f: impl FnOnce(PortalEnvironment<'static>),
    ) -> EtendueStatus {
        // SAFETY: the caller's
        unsafe { (*environment).with(f) }
    }
}

/// The functions of [`EtenduePortalsByRadiance`]: their names in C begin with `etendue_portals_by_radiance_`.
pub mod portals_by_radiance {
    use super::*;

    technique_functions!(
        EtenduePortalsByRadiance,
        EtenduePortalEnvironment,
        EtenduePortalEnvironment,
        portals_by_radiance,
        ()
    );
}
