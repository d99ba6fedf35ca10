//! The functions of warps.
#![allow(clippy::needless_range_loop, reason = "several columns have the same index")]

use super::input::{Input, fraction, unit};
use super::memory::Memory;
use super::{COUNTS, Column, Output, all_finite, expected, same, total};
use etendue_c::*;
use std::ptr::{null, null_mut};

/// The functions of a warp, with its parameters as numbers in a row, if it has any.
pub(super) struct Warp {
    parameters: usize,
    numbers: usize,
    coordinates: usize,
    sample: unsafe fn(Column, Column, Output) -> EtendueStatus,
    pdf: unsafe fn(Column, Column) -> f32,
    invert: unsafe fn(Column, Column, Output) -> EtendueStatus,
    sample_batch: unsafe fn(Column, usize, *const Column, *const Output) -> EtendueStatus,
    pdf_batch: unsafe fn(Column, usize, *const Column, Output) -> EtendueStatus,
    invert_batch: unsafe fn(Column, usize, *const Column, *const Output) -> EtendueStatus,
}

macro_rules! warps {
    ($(($($type:ident)?) $numbers:literal $coordinates:literal $sample:ident $pdf:ident $invert:ident
       $sample_batch:ident $pdf_batch:ident $invert_batch:ident;)+) => {
        pub(super) const WARPS: &[Warp] = &[$(
            // SAFETY of all: the caller's pointers are those that the functions demand
            Warp {
                parameters: 0 $(+ size_of::<$type>() / 4)?,
                numbers: $numbers,
                coordinates: $coordinates,
                sample: |_warp, u, out| unsafe { $sample($(_warp.cast::<$type>(),)? u, out) },
                pdf: |_warp, x| unsafe { $pdf($(_warp.cast::<$type>(),)? x) },
                invert: |_warp, x, out| unsafe { $invert($(_warp.cast::<$type>(),)? x, out) },
                sample_batch: |_warp, n, u, out| unsafe { $sample_batch($(_warp.cast::<$type>(),)? n, u, out) },
                pdf_batch: |_warp, n, x, out| unsafe { $pdf_batch($(_warp.cast::<$type>(),)? n, x, out) },
                invert_batch: |_warp, n, x, out| unsafe { $invert_batch($(_warp.cast::<$type>(),)? n, x, out) },
            },
        )+];
    };
}
#[rustfmt::skip]
warps! {
    () 2 2 etendue_concentric_disk_sample etendue_concentric_disk_pdf etendue_concentric_disk_invert etendue_concentric_disk_sample_batch etendue_concentric_disk_pdf_batch etendue_concentric_disk_invert_batch;
    () 2 2 etendue_polar_disk_sample etendue_polar_disk_pdf etendue_polar_disk_invert etendue_polar_disk_sample_batch etendue_polar_disk_pdf_batch etendue_polar_disk_invert_batch;
    () 2 3 etendue_uniform_hemisphere_sample etendue_uniform_hemisphere_pdf etendue_uniform_hemisphere_invert etendue_uniform_hemisphere_sample_batch etendue_uniform_hemisphere_pdf_batch etendue_uniform_hemisphere_invert_batch;
    () 2 3 etendue_uniform_sphere_sample etendue_uniform_sphere_pdf etendue_uniform_sphere_invert etendue_uniform_sphere_sample_batch etendue_uniform_sphere_pdf_batch etendue_uniform_sphere_invert_batch;
    () 2 3 etendue_cosine_hemisphere_sample etendue_cosine_hemisphere_pdf etendue_cosine_hemisphere_invert etendue_cosine_hemisphere_sample_batch etendue_cosine_hemisphere_pdf_batch etendue_cosine_hemisphere_invert_batch;
    () 2 3 etendue_octahedral_sample etendue_octahedral_pdf etendue_octahedral_invert etendue_octahedral_sample_batch etendue_octahedral_pdf_batch etendue_octahedral_invert_batch;
    () 2 2 etendue_area_triangle_sample etendue_area_triangle_pdf etendue_area_triangle_invert etendue_area_triangle_sample_batch etendue_area_triangle_pdf_batch etendue_area_triangle_invert_batch;
    () 2 2 etendue_low_distortion_triangle_sample etendue_low_distortion_triangle_pdf etendue_low_distortion_triangle_invert etendue_low_distortion_triangle_sample_batch etendue_low_distortion_triangle_pdf_batch etendue_low_distortion_triangle_invert_batch;
    (EtendueCone) 2 3 etendue_cone_sample etendue_cone_pdf etendue_cone_invert etendue_cone_sample_batch etendue_cone_pdf_batch etendue_cone_invert_batch;
    (EtendueBilinear) 2 2 etendue_bilinear_sample etendue_bilinear_pdf etendue_bilinear_invert etendue_bilinear_sample_batch etendue_bilinear_pdf_batch etendue_bilinear_invert_batch;
    (EtendueGgxVisibleNormals) 2 3 etendue_ggx_visible_normals_sample etendue_ggx_visible_normals_pdf etendue_ggx_visible_normals_invert etendue_ggx_visible_normals_sample_batch etendue_ggx_visible_normals_pdf_batch etendue_ggx_visible_normals_invert_batch;
    (EtendueDiskSurface) 2 3 etendue_disk_surface_sample etendue_disk_surface_pdf etendue_disk_surface_invert etendue_disk_surface_sample_batch etendue_disk_surface_pdf_batch etendue_disk_surface_invert_batch;
    (EtendueCylinderSide) 2 3 etendue_cylinder_side_sample etendue_cylinder_side_pdf etendue_cylinder_side_invert etendue_cylinder_side_sample_batch etendue_cylinder_side_pdf_batch etendue_cylinder_side_invert_batch;
    (EtendueSphereSurface) 2 3 etendue_sphere_surface_sample etendue_sphere_surface_pdf etendue_sphere_surface_invert etendue_sphere_surface_sample_batch etendue_sphere_surface_pdf_batch etendue_sphere_surface_invert_batch;
    (EtenduePatchSurface) 2 3 etendue_patch_surface_sample etendue_patch_surface_pdf etendue_patch_surface_invert etendue_patch_surface_sample_batch etendue_patch_surface_pdf_batch etendue_patch_surface_invert_batch;
    (EtendueLinear) 1 1 etendue_linear_sample etendue_linear_pdf etendue_linear_invert etendue_linear_sample_batch etendue_linear_pdf_batch etendue_linear_invert_batch;
    (EtendueTent) 1 1 etendue_tent_sample etendue_tent_pdf etendue_tent_invert etendue_tent_sample_batch etendue_tent_pdf_batch etendue_tent_invert_batch;
}

/// The warp with a unit vector, a disk.
const DISK: usize = 11;
/// The warp whose parameters a function prepares.
const GGX: usize = 10;

/// Calls the functions of a warp.
pub(super) fn check(input: &mut Input<'_>, index: usize) {
    let t = &WARPS[index];
    let call = input.below(3);
    let n = COUNTS[input.below(COUNTS.len())];
    let null_at = input.below(16);
    let mut parameters: Vec<f32> = (0..t.parameters.max(1)).map(|_| input.number()).collect();
    if index == DISK {
        let normal = unit([parameters[3], parameters[4], parameters[5]]);
        parameters[3..6].copy_from_slice(&normal);
    }
    let u: [Vec<f32>; 2] = input.columns(n, fraction);
    let x: [Vec<f32>; 3] = input.columns(n, |x| x);
    let is_finite = all_finite(&[&parameters, &u[0], &u[1], &x[0], &x[1], &x[2]]);
    let (u_memory, x_memory) = (Memory::of(input, &[&u[0], &u[1]]), Memory::of(input, &[&x[0], &x[1], &x[2]]));
    let mut memory = Memory::new(input, 3, n);
    // SAFETY of all calls: pointers are null or to as many numbers as the header demands
    unsafe {
        if index == GGX {
            let (roughness, wi) = ([parameters[0], parameters[1]], unit([parameters[2], parameters[3], parameters[4]]));
            let out = parameters.as_mut_ptr().cast();
            assert_eq!(
                etendue_ggx_visible_normals_prepare(roughness[0], roughness[1], wi.as_ptr(), out),
                EtendueStatus::Ok
            );
        }
        let own = parameters.as_ptr();
        let (mut u_in, mut x_in): ([Column; 2], [Column; 3]) = (u_memory.inputs(), x_memory.inputs());
        let self_in = if null_at == 0 { null() } else { own };
        let self_null = null_at == 0 && t.parameters > 0;
        if (1..3).contains(&null_at) {
            u_in[null_at - 1] = null();
        }
        if (1..4).contains(&null_at) {
            x_in[null_at - 1] = null();
        }
        let missing = |most: usize| self_null || (1..=most).contains(&null_at);
        let mut outputs: [Output; 3] = memory.outputs();
        let mut widths = [4; 3];
        if null_at > 12 {
            (outputs[null_at - 13], widths[null_at - 13]) = (null_mut(), 0);
        }
        let written = match call {
            0 => {
                let status = (t.sample_batch)(self_in, n, u_in.as_ptr(), outputs.as_ptr());
                assert_eq!(status, expected(n, missing(t.numbers)));
                if status == EtendueStatus::Ok { t.coordinates } else { 0 }
            }
            1 => {
                let status = (t.invert_batch)(self_in, n, x_in.as_ptr(), outputs.as_ptr());
                assert_eq!(status, expected(n, missing(t.coordinates)));
                if status == EtendueStatus::Ok { t.numbers } else { 0 }
            }
            _ => {
                let status = (t.pdf_batch)(self_in, n, x_in.as_ptr(), outputs[0]);
                assert_eq!(status, expected(n, missing(t.coordinates) || widths[0] == 0));
                usize::from(status == EtendueStatus::Ok)
            }
        };
        memory.only(&widths[..written]);
        for i in 0..if written > 0 { n } else { 0 } {
            let (u_i, x_i) = ([u[0][i], u[1][i]], [x[0][i], x[1][i], x[2][i]]);
            let mut one = [0.0; 3];
            match call {
                0 => assert_eq!((t.sample)(own, u_i.as_ptr(), one.as_mut_ptr()), EtendueStatus::Ok),
                1 => assert_eq!((t.invert)(own, x_i.as_ptr(), one.as_mut_ptr()), EtendueStatus::Ok),
                _ => one[0] = (t.pdf)(own, x_i.as_ptr()),
            }
            for k in 0..written {
                assert!(widths[k] == 0 || same(memory.get(k, i), one[k]), "column {k} of element {i}");
            }
            total(is_finite, one);
        }
    }
}
