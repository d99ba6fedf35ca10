//! The functions of lights.
#![allow(clippy::needless_range_loop, reason = "several columns have the same index")]

use super::input::{Input, fraction, unit, units};
use super::memory::Memory;
use super::{
    COUNTS, Column, FIELDS, LIGHT, Output, SAMPLER, all_finite, expected, fields, same, sample_columns, total,
};
use etendue_c::*;
use std::ptr::{null, null_mut};

/// The functions of a technique, with every struct as numbers or pointers in a row.
pub(super) struct Technique {
    light: usize,
    sampler: usize,
    on_surface: bool,
    prepare: unsafe fn(Column, Column, Column, Output) -> EtendueStatus,
    sample: unsafe fn(Column, Column, *mut EtendueLightSample) -> EtendueStatus,
    pdf: unsafe fn(Column, Column) -> f32,
    invert: unsafe fn(Column, Column, Output) -> EtendueStatus,
    hit: unsafe fn(Column, Column, *mut EtendueLightSample) -> EtendueStatus,
    once: unsafe fn(Column, Column, Column, Column, *mut EtendueLightSample) -> EtendueStatus,
    sample_batch: unsafe fn(Column, usize, *const Column, *const EtendueSampleColumns) -> EtendueStatus,
    pdf_batch: unsafe fn(Column, usize, *const Column, Output) -> EtendueStatus,
    invert_batch: unsafe fn(Column, usize, *const Column, *const Output) -> EtendueStatus,
    hit_batch: unsafe fn(Column, usize, *const Column, *const EtendueSampleColumns) -> EtendueStatus,
    each: unsafe fn(
        *const Column,
        usize,
        *const Column,
        *const Column,
        *const Column,
        *const EtendueSampleColumns,
    ) -> EtendueStatus,
}

macro_rules! techniques {
    ($($sampler:ident $light:ident $place:ident $prepare:ident $sample:ident $pdf:ident $invert:ident $hit:ident $once:ident
       $sample_batch:ident $pdf_batch:ident $invert_batch:ident $hit_batch:ident $each:ident;)+) => {
        pub(super) const TECHNIQUES: &[Technique] = &[$(
            // SAFETY of all: the caller's pointers are those that the functions demand
            Technique {
                light: size_of::<$light>() / 4,
                sampler: size_of::<$sampler>() / 4,
                on_surface: techniques!(@ $place, false, true),
                prepare: |light, p, n, out| unsafe {
                    let _ = n;
                    techniques!(@ $place, $prepare(light.cast(), p, out.cast()), $prepare(light.cast(), p, n, out.cast()))
                },
                sample: |s, u, out| unsafe { $sample(s.cast(), u, out) },
                pdf: |s, w| unsafe { $pdf(s.cast(), w) },
                invert: |s, w, u| unsafe { $invert(s.cast(), w, u) },
                hit: |s, w, out| unsafe { $hit(s.cast(), w, out) },
                once: |light, p, n, u, out| unsafe {
                    let _ = n;
                    techniques!(@ $place, $once(light.cast(), p, u, out), $once(light.cast(), p, n, u, out))
                },
                sample_batch: |s, n, u, out| unsafe { $sample_batch(s.cast(), n, u, out) },
                pdf_batch: |s, n, w, out| unsafe { $pdf_batch(s.cast(), n, w, out) },
                invert_batch: |s, n, w, u| unsafe { $invert_batch(s.cast(), n, w, u) },
                hit_batch: |s, n, w, out| unsafe { $hit_batch(s.cast(), n, w, out) },
                each: |lights, n, p, normals, u, out| unsafe {
                    let _ = normals;
                    techniques!(@ $place, $each(lights.cast(), n, p, u, out), $each(lights.cast(), n, p, normals, u, out))
                },
            },
        )+];
    };
    (@ anywhere, $anywhere:expr, $on_surface:expr) => { $anywhere };
    (@ on_surface, $anywhere:expr, $on_surface:expr) => { $on_surface };
}
#[rustfmt::skip]
techniques! {
    EtendueSphereByArea EtendueSphere anywhere etendue_sphere_by_area_prepare etendue_sphere_by_area_sample etendue_sphere_by_area_pdf etendue_sphere_by_area_invert etendue_sphere_by_area_hit etendue_sphere_by_area_sample_once etendue_sphere_by_area_sample_batch etendue_sphere_by_area_pdf_batch etendue_sphere_by_area_invert_batch etendue_sphere_by_area_hit_batch etendue_sphere_by_area_sample_each;
    EtendueSphereBySolidAngle EtendueSphere anywhere etendue_sphere_by_solid_angle_prepare etendue_sphere_by_solid_angle_sample etendue_sphere_by_solid_angle_pdf etendue_sphere_by_solid_angle_invert etendue_sphere_by_solid_angle_hit etendue_sphere_by_solid_angle_sample_once etendue_sphere_by_solid_angle_sample_batch etendue_sphere_by_solid_angle_pdf_batch etendue_sphere_by_solid_angle_invert_batch etendue_sphere_by_solid_angle_hit_batch etendue_sphere_by_solid_angle_sample_each;
    EtendueSphereByProjectedSolidAngle EtendueSphere on_surface etendue_sphere_by_projected_solid_angle_prepare etendue_sphere_by_projected_solid_angle_sample etendue_sphere_by_projected_solid_angle_pdf etendue_sphere_by_projected_solid_angle_invert etendue_sphere_by_projected_solid_angle_hit etendue_sphere_by_projected_solid_angle_sample_once etendue_sphere_by_projected_solid_angle_sample_batch etendue_sphere_by_projected_solid_angle_pdf_batch etendue_sphere_by_projected_solid_angle_invert_batch etendue_sphere_by_projected_solid_angle_hit_batch etendue_sphere_by_projected_solid_angle_sample_each;
    EtendueTriangleByArea EtendueTriangle anywhere etendue_triangle_by_area_prepare etendue_triangle_by_area_sample etendue_triangle_by_area_pdf etendue_triangle_by_area_invert etendue_triangle_by_area_hit etendue_triangle_by_area_sample_once etendue_triangle_by_area_sample_batch etendue_triangle_by_area_pdf_batch etendue_triangle_by_area_invert_batch etendue_triangle_by_area_hit_batch etendue_triangle_by_area_sample_each;
    EtendueTriangleBySolidAngle EtendueTriangle anywhere etendue_triangle_by_solid_angle_prepare etendue_triangle_by_solid_angle_sample etendue_triangle_by_solid_angle_pdf etendue_triangle_by_solid_angle_invert etendue_triangle_by_solid_angle_hit etendue_triangle_by_solid_angle_sample_once etendue_triangle_by_solid_angle_sample_batch etendue_triangle_by_solid_angle_pdf_batch etendue_triangle_by_solid_angle_invert_batch etendue_triangle_by_solid_angle_hit_batch etendue_triangle_by_solid_angle_sample_each;
    EtendueTriangleByProjectedSolidAngle EtendueTriangle on_surface etendue_triangle_by_projected_solid_angle_prepare etendue_triangle_by_projected_solid_angle_sample etendue_triangle_by_projected_solid_angle_pdf etendue_triangle_by_projected_solid_angle_invert etendue_triangle_by_projected_solid_angle_hit etendue_triangle_by_projected_solid_angle_sample_once etendue_triangle_by_projected_solid_angle_sample_batch etendue_triangle_by_projected_solid_angle_pdf_batch etendue_triangle_by_projected_solid_angle_invert_batch etendue_triangle_by_projected_solid_angle_hit_batch etendue_triangle_by_projected_solid_angle_sample_each;
    EtendueTriangleByCosineWarp EtendueTriangle on_surface etendue_triangle_by_cosine_warp_prepare etendue_triangle_by_cosine_warp_sample etendue_triangle_by_cosine_warp_pdf etendue_triangle_by_cosine_warp_invert etendue_triangle_by_cosine_warp_hit etendue_triangle_by_cosine_warp_sample_once etendue_triangle_by_cosine_warp_sample_batch etendue_triangle_by_cosine_warp_pdf_batch etendue_triangle_by_cosine_warp_invert_batch etendue_triangle_by_cosine_warp_hit_batch etendue_triangle_by_cosine_warp_sample_each;
    EtendueParallelogramByArea EtendueParallelogram anywhere etendue_parallelogram_by_area_prepare etendue_parallelogram_by_area_sample etendue_parallelogram_by_area_pdf etendue_parallelogram_by_area_invert etendue_parallelogram_by_area_hit etendue_parallelogram_by_area_sample_once etendue_parallelogram_by_area_sample_batch etendue_parallelogram_by_area_pdf_batch etendue_parallelogram_by_area_invert_batch etendue_parallelogram_by_area_hit_batch etendue_parallelogram_by_area_sample_each;
    EtendueParallelogramBySolidAngle EtendueParallelogram anywhere etendue_parallelogram_by_solid_angle_prepare etendue_parallelogram_by_solid_angle_sample etendue_parallelogram_by_solid_angle_pdf etendue_parallelogram_by_solid_angle_invert etendue_parallelogram_by_solid_angle_hit etendue_parallelogram_by_solid_angle_sample_once etendue_parallelogram_by_solid_angle_sample_batch etendue_parallelogram_by_solid_angle_pdf_batch etendue_parallelogram_by_solid_angle_invert_batch etendue_parallelogram_by_solid_angle_hit_batch etendue_parallelogram_by_solid_angle_sample_each;
    EtendueParallelogramByProjectedSolidAngle EtendueParallelogram on_surface etendue_parallelogram_by_projected_solid_angle_prepare etendue_parallelogram_by_projected_solid_angle_sample etendue_parallelogram_by_projected_solid_angle_pdf etendue_parallelogram_by_projected_solid_angle_invert etendue_parallelogram_by_projected_solid_angle_hit etendue_parallelogram_by_projected_solid_angle_sample_once etendue_parallelogram_by_projected_solid_angle_sample_batch etendue_parallelogram_by_projected_solid_angle_pdf_batch etendue_parallelogram_by_projected_solid_angle_invert_batch etendue_parallelogram_by_projected_solid_angle_hit_batch etendue_parallelogram_by_projected_solid_angle_sample_each;
    EtendueRectangleBySolidAngle EtendueRectangle anywhere etendue_rectangle_by_solid_angle_prepare etendue_rectangle_by_solid_angle_sample etendue_rectangle_by_solid_angle_pdf etendue_rectangle_by_solid_angle_invert etendue_rectangle_by_solid_angle_hit etendue_rectangle_by_solid_angle_sample_once etendue_rectangle_by_solid_angle_sample_batch etendue_rectangle_by_solid_angle_pdf_batch etendue_rectangle_by_solid_angle_invert_batch etendue_rectangle_by_solid_angle_hit_batch etendue_rectangle_by_solid_angle_sample_each;
    EtendueRectangleByCosineWarp EtendueRectangle on_surface etendue_rectangle_by_cosine_warp_prepare etendue_rectangle_by_cosine_warp_sample etendue_rectangle_by_cosine_warp_pdf etendue_rectangle_by_cosine_warp_invert etendue_rectangle_by_cosine_warp_hit etendue_rectangle_by_cosine_warp_sample_once etendue_rectangle_by_cosine_warp_sample_batch etendue_rectangle_by_cosine_warp_pdf_batch etendue_rectangle_by_cosine_warp_invert_batch etendue_rectangle_by_cosine_warp_hit_batch etendue_rectangle_by_cosine_warp_sample_each;
    EtendueDiskByArea EtendueDisk anywhere etendue_disk_by_area_prepare etendue_disk_by_area_sample etendue_disk_by_area_pdf etendue_disk_by_area_invert etendue_disk_by_area_hit etendue_disk_by_area_sample_once etendue_disk_by_area_sample_batch etendue_disk_by_area_pdf_batch etendue_disk_by_area_invert_batch etendue_disk_by_area_hit_batch etendue_disk_by_area_sample_each;
    EtendueDiskBySolidAngle EtendueDisk anywhere etendue_disk_by_solid_angle_prepare etendue_disk_by_solid_angle_sample etendue_disk_by_solid_angle_pdf etendue_disk_by_solid_angle_invert etendue_disk_by_solid_angle_hit etendue_disk_by_solid_angle_sample_once etendue_disk_by_solid_angle_sample_batch etendue_disk_by_solid_angle_pdf_batch etendue_disk_by_solid_angle_invert_batch etendue_disk_by_solid_angle_hit_batch etendue_disk_by_solid_angle_sample_each;
    EtendueCylinderByArea EtendueCylinder anywhere etendue_cylinder_by_area_prepare etendue_cylinder_by_area_sample etendue_cylinder_by_area_pdf etendue_cylinder_by_area_invert etendue_cylinder_by_area_hit etendue_cylinder_by_area_sample_once etendue_cylinder_by_area_sample_batch etendue_cylinder_by_area_pdf_batch etendue_cylinder_by_area_invert_batch etendue_cylinder_by_area_hit_batch etendue_cylinder_by_area_sample_each;
    EtenduePatchByArea EtendueBilinearPatch anywhere etendue_patch_by_area_prepare etendue_patch_by_area_sample etendue_patch_by_area_pdf etendue_patch_by_area_invert etendue_patch_by_area_hit etendue_patch_by_area_sample_once etendue_patch_by_area_sample_batch etendue_patch_by_area_pdf_batch etendue_patch_by_area_invert_batch etendue_patch_by_area_hit_batch etendue_patch_by_area_sample_each;
    EtenduePolygonByArea EtenduePolygon anywhere etendue_polygon_by_area_prepare etendue_polygon_by_area_sample etendue_polygon_by_area_pdf etendue_polygon_by_area_invert etendue_polygon_by_area_hit etendue_polygon_by_area_sample_once etendue_polygon_by_area_sample_batch etendue_polygon_by_area_pdf_batch etendue_polygon_by_area_invert_batch etendue_polygon_by_area_hit_batch etendue_polygon_by_area_sample_each;
    EtenduePolygonBySolidAngle EtenduePolygon anywhere etendue_polygon_by_solid_angle_prepare etendue_polygon_by_solid_angle_sample etendue_polygon_by_solid_angle_pdf etendue_polygon_by_solid_angle_invert etendue_polygon_by_solid_angle_hit etendue_polygon_by_solid_angle_sample_once etendue_polygon_by_solid_angle_sample_batch etendue_polygon_by_solid_angle_pdf_batch etendue_polygon_by_solid_angle_invert_batch etendue_polygon_by_solid_angle_hit_batch etendue_polygon_by_solid_angle_sample_each;
    EtenduePolygonByProjectedSolidAngle EtenduePolygon on_surface etendue_polygon_by_projected_solid_angle_prepare etendue_polygon_by_projected_solid_angle_sample etendue_polygon_by_projected_solid_angle_pdf etendue_polygon_by_projected_solid_angle_invert etendue_polygon_by_projected_solid_angle_hit etendue_polygon_by_projected_solid_angle_sample_once etendue_polygon_by_projected_solid_angle_sample_batch etendue_polygon_by_projected_solid_angle_pdf_batch etendue_polygon_by_projected_solid_angle_invert_batch etendue_polygon_by_projected_solid_angle_hit_batch etendue_polygon_by_projected_solid_angle_sample_each;
    EtendueLineByLength EtendueLine anywhere etendue_line_by_length_prepare etendue_line_by_length_sample etendue_line_by_length_pdf etendue_line_by_length_invert etendue_line_by_length_hit etendue_line_by_length_sample_once etendue_line_by_length_sample_batch etendue_line_by_length_pdf_batch etendue_line_by_length_invert_batch etendue_line_by_length_hit_batch etendue_line_by_length_sample_each;
    EtendueLineByAngle EtendueLine anywhere etendue_line_by_angle_prepare etendue_line_by_angle_sample etendue_line_by_angle_pdf etendue_line_by_angle_invert etendue_line_by_angle_hit etendue_line_by_angle_sample_once etendue_line_by_angle_sample_batch etendue_line_by_angle_pdf_batch etendue_line_by_angle_invert_batch etendue_line_by_angle_hit_batch etendue_line_by_angle_sample_each;
    EtendueLineByProjectedSolidAngle EtendueLine on_surface etendue_line_by_projected_solid_angle_prepare etendue_line_by_projected_solid_angle_sample etendue_line_by_projected_solid_angle_pdf etendue_line_by_projected_solid_angle_invert etendue_line_by_projected_solid_angle_hit etendue_line_by_projected_solid_angle_sample_once etendue_line_by_projected_solid_angle_sample_batch etendue_line_by_projected_solid_angle_pdf_batch etendue_line_by_projected_solid_angle_invert_batch etendue_line_by_projected_solid_angle_hit_batch etendue_line_by_projected_solid_angle_sample_each;
    EtendueSunBySolidAngle EtendueSun anywhere etendue_sun_by_solid_angle_prepare etendue_sun_by_solid_angle_sample etendue_sun_by_solid_angle_pdf etendue_sun_by_solid_angle_invert etendue_sun_by_solid_angle_hit etendue_sun_by_solid_angle_sample_once etendue_sun_by_solid_angle_sample_batch etendue_sun_by_solid_angle_pdf_batch etendue_sun_by_solid_angle_invert_batch etendue_sun_by_solid_angle_hit_batch etendue_sun_by_solid_angle_sample_each;
}

/// Techniques whose lights have a unit vector, and where in their numbers it is: disks and suns.
const UNITS: [(usize, usize); 3] = [(12, 3), (13, 3), (22, 0)];
/// Calls the functions of a technique.
pub(super) fn check(input: &mut Input<'_>, index: usize) {
    let t = &TECHNIQUES[index];
    let call = input.below(6);
    let n = COUNTS[input.below(COUNTS.len())];
    // the pointer that is null, if any
    let null_at = input.below(64);
    let absent = u16::from(input.byte()) << 8 | u16::from(input.byte());
    let mut light: Vec<f32> = (0..t.light).map(|_| input.number()).collect();
    let unit_at = UNITS.iter().find(|(of, _)| *of == index).map(|(_, at)| *at);
    if let Some(at) = unit_at {
        let vector = unit([light[at], light[at + 1], light[at + 2]]);
        light[at..at + 3].copy_from_slice(&vector);
    }
    let (p, normal) = ([(); 3].map(|()| input.number()), unit([(); 3].map(|()| input.number())));
    let u: [Vec<f32>; 2] = input.columns(n, fraction);
    let w: [Vec<f32>; 3] = units(input.columns(n, |x| x));
    let mut is_finite = all_finite(&[&light, &p, &normal, &u[0], &u[1], &w[0], &w[1], &w[2]]);
    let mut sampler = [f32::from_bits(0xA5A5_A5A5); SAMPLER];
    // SAFETY of all calls: pointers are null or to as many numbers as the header demands
    unsafe {
        let out = sampler.as_mut_ptr();
        assert_eq!((t.prepare)(null(), p.as_ptr(), normal.as_ptr(), out), EtendueStatus::NullPointer);
        assert_eq!((t.prepare)(light.as_ptr(), null(), normal.as_ptr(), out), EtendueStatus::NullPointer);
        assert!(sampler.iter().all(|x| x.to_bits() == 0xA5A5_A5A5));
        let out = sampler.as_mut_ptr();
        assert_eq!((t.prepare)(light.as_ptr(), p.as_ptr(), normal.as_ptr(), out), EtendueStatus::Ok);
        assert!(sampler[t.sampler..].iter().all(|x| x.to_bits() == 0xA5A5_A5A5));
        let (sampler, mut memory) = (sampler.as_ptr(), Memory::new(input, FIELDS, n));
        let (u_memory, w_memory) = (Memory::of(input, &[&u[0], &u[1]]), Memory::of(input, &[&w[0], &w[1], &w[2]]));
        let (mut u_in, mut w_in): ([Column; 2], [Column; 3]) = (u_memory.inputs(), w_memory.inputs());
        let self_in = if null_at == 0 { null() } else { sampler };
        if (1..3).contains(&null_at) {
            u_in[null_at - 1] = null();
        }
        if (1..4).contains(&null_at) {
            w_in[null_at - 1] = null();
        }
        let (u_null, w_null) = (null_at < 3, null_at < 4);
        let mut outputs: [Output; FIELDS] = memory.outputs();
        let mut widths = [4; FIELDS];
        widths[11] = 1;
        for (k, output) in outputs.iter_mut().enumerate() {
            if absent >> k & 1 == 1 {
                (*output, widths[k]) = (null_mut(), 0);
            }
        }
        let columns = sample_columns(outputs);
        let check = |memory: &Memory, i: usize, one: &EtendueLightSample| {
            for (k, field) in fields(one).into_iter().enumerate() {
                assert!(
                    widths[k] == 0 || same(memory.get(k, i), field),
                    "column {k} of element {i}: {} is not {field}",
                    memory.get(k, i)
                );
            }
            assert!(
                widths[11] == 0 || memory.bytes[memory.starts[11] + i] == one.emits,
                "the last column of element {i}"
            );
        };
        let mut one = EtendueLightSample::default();
        match call {
            0 | 1 => {
                let (is_null, status) = if call == 0 {
                    (u_null, (t.sample_batch)(self_in, n, u_in.as_ptr(), &columns))
                } else {
                    (w_null, (t.hit_batch)(self_in, n, w_in.as_ptr(), &columns))
                };
                assert_eq!(status, expected(n, is_null));
                memory.only(if status == EtendueStatus::Ok { &widths } else { &[] });
                for i in 0..if is_null { 0 } else { n } {
                    let status = if call == 0 {
                        (t.sample)(sampler, [u[0][i], u[1][i]].as_ptr(), &mut one)
                    } else {
                        (t.hit)(sampler, [w[0][i], w[1][i], w[2][i]].as_ptr(), &mut one)
                    };
                    assert_eq!(status, EtendueStatus::Ok);
                    check(&memory, i, &one);
                    total(is_finite, fields(&one));
                    if call == 0 {
                        let mut once = EtendueLightSample::default();
                        let u = [u[0][i], u[1][i]];
                        (t.once)(light.as_ptr(), p.as_ptr(), normal.as_ptr(), u.as_ptr(), &mut once);
                        assert!(
                            fields(&one).into_iter().zip(fields(&once)).all(|(a, b)| same(a, b))
                                && one.emits == once.emits
                        );
                    }
                }
            }
            2 => {
                let out = memory.outputs::<1>()[0];
                let status = (t.pdf_batch)(self_in, n, w_in.as_ptr(), out);
                assert_eq!(status, expected(n, w_null));
                memory.only(if w_null { &[] } else { &[4] });
                for i in 0..if w_null { 0 } else { n } {
                    let pdf = (t.pdf)(sampler, [w[0][i], w[1][i], w[2][i]].as_ptr());
                    assert!(same(memory.get(0, i), pdf));
                    total(is_finite, [pdf]);
                }
            }
            3 => {
                let status = (t.invert_batch)(self_in, n, w_in.as_ptr(), outputs.as_ptr());
                assert_eq!(status, expected(n, w_null));
                memory.only(if w_null { &[] } else { &widths[..2] });
                for i in 0..if w_null { 0 } else { n } {
                    let mut back = [0.0; 2];
                    assert_eq!(
                        (t.invert)(sampler, [w[0][i], w[1][i], w[2][i]].as_ptr(), back.as_mut_ptr()),
                        EtendueStatus::Ok
                    );
                    for k in 0..2 {
                        assert!(widths[k] == 0 || same(memory.get(k, i), back[k]));
                    }
                    total(is_finite, back);
                    assert!(!is_finite || back.iter().all(|x| (0.0..1.0).contains(x)), "{back:?} is not in [0, 1)^2");
                }
            }
            4 => {
                // results over inputs
                let both = Memory::of(input, &[&u[0], &u[1], &w[0], &w[1], &w[2]]);
                let mut over = both;
                let [a, b, c, d, e]: [Output; 5] = over.outputs();
                let mut fields = [null_mut(); FIELDS];
                (fields[1], fields[5]) = (a, b);
                let columns = sample_columns(fields);
                assert_eq!(
                    (t.sample_batch)(sampler, n, [a.cast_const(), b.cast_const()].as_ptr(), &columns),
                    EtendueStatus::Ok
                );
                let w_in = [c.cast_const(), d.cast_const(), e.cast_const()];
                assert_eq!((t.invert_batch)(sampler, n, w_in.as_ptr(), [e, c].as_ptr()), EtendueStatus::Ok);
                for i in 0..n {
                    let mut back = [0.0; 2];
                    (t.sample)(sampler, [u[0][i], u[1][i]].as_ptr(), &mut one);
                    (t.invert)(sampler, [w[0][i], w[1][i], w[2][i]].as_ptr(), back.as_mut_ptr());
                    let results = [over.get(0, i), over.get(1, i), over.get(4, i), over.get(2, i)];
                    for (a, b) in results.into_iter().zip([one.direction[1], one.weight, back[0], back[1]]) {
                        assert!(same(a, b));
                    }
                }
            }
            _ => {
                let mut lights: [Vec<f32>; LIGHT] = input.columns(n, |x| x);
                if let Some(at) = unit_at {
                    let vectors = units([0, 1, 2].map(|k| lights[at + k].clone()));
                    lights[at..at + 3].clone_from_slice(&vectors);
                }
                let (points, normals): ([Vec<f32>; 3], _) = (input.columns(n, |x| x), units(input.columns(n, |x| x)));
                for column in lights.iter().chain(&points).chain(&normals) {
                    is_finite &= all_finite(&[column]);
                }
                let [light_memory, p_memory, n_memory] = [&lights[..], &points, &normals]
                    .map(|columns| Memory::of(input, &columns.iter().map(|c| &c[..]).collect::<Vec<_>>()));
                let mut light_in: [Column; LIGHT] = light_memory.inputs();
                let (mut p_in, mut n_in): ([Column; 3], [Column; 3]) = (p_memory.inputs(), n_memory.inputs());
                let mut is_null = (1..3).contains(&null_at);
                match null_at {
                    3..6 => (p_in[null_at - 3], is_null) = (null(), true),
                    6..9 => (n_in[null_at - 6], is_null) = (null(), t.on_surface),
                    9..33 => (light_in[null_at - 9], is_null) = (null(), null_at - 9 < t.light),
                    _ => (),
                }
                let status = (t.each)(light_in.as_ptr(), n, p_in.as_ptr(), n_in.as_ptr(), u_in.as_ptr(), &columns);
                assert_eq!(status, expected(n, is_null));
                memory.only(if status == EtendueStatus::Ok { &widths } else { &[] });
                for i in 0..if is_null { 0 } else { n } {
                    let light: [f32; LIGHT] = std::array::from_fn(|k| lights[k][i]);
                    let [p, normal] = [&points, &normals].map(|c| [c[0][i], c[1][i], c[2][i]]);
                    let u = [u[0][i], u[1][i]];
                    (t.once)(light.as_ptr(), p.as_ptr(), normal.as_ptr(), u.as_ptr(), &mut one);
                    check(&memory, i, &one);
                    total(is_finite, fields(&one));
                }
            }
        }
    }
}
