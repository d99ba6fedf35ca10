//! The functions of warps.
#![allow(clippy::needless_range_loop, reason = "several columns have the same index")]

use super::input::{Input, fraction, unit};
use super::memory::Memory;
use super::{COUNTS, Column, Output, all_finite, expected, same, total};
use etendue::warp::listed::ENTRIES;
use etendue_c::*;
use std::ptr::{null, null_mut};

/// Calls the functions of a warp.
pub(super) fn check(input: &mut Input<'_>, index: usize) {
    let (t, number) = (&ENTRIES[index], index as u32);
    let call = input.below(3);
    let n = COUNTS[input.below(COUNTS.len())];
    let null_at = input.below(16);
    let mut parameters: Vec<f32> = (0..t.numbers.max(1)).map(|_| input.number()).collect();
    let u: [Vec<f32>; 2] = input.columns(n, fraction);
    let x: [Vec<f32>; 3] = input.columns(n, |x| x);
    let is_finite = all_finite(&[&parameters, &u[0], &u[1], &x[0], &x[1], &x[2]]);
    let (u_memory, x_memory) = (Memory::of(input, &[&u[0], &u[1]]), Memory::of(input, &[&x[0], &x[1], &x[2]]));
    let mut memory = Memory::new(input, 3, n);
    // SAFETY of all calls: pointers are null or to as many numbers as the header demands
    unsafe {
        if t.name == "ggx_visible_normals" {
            let (roughness, wi) = ([parameters[0], parameters[1]], unit([parameters[2], parameters[3], parameters[4]]));
            let out = parameters.as_mut_ptr().cast();
            assert_eq!(
                etendue_ggx_visible_normals_prepare(roughness[0], roughness[1], wi.as_ptr(), out),
                EtendueStatus::Ok
            );
        }
        if t.name == "reflection" {
            let [n, view] = [1, 4].map(|k| unit([parameters[k], parameters[k + 1], parameters[k + 2]]));
            let out = parameters.as_mut_ptr().cast();
            assert_eq!(etendue_reflection_prepare(parameters[0], n.as_ptr(), view.as_ptr(), out), EtendueStatus::Ok);
        }
        let own = parameters.as_ptr();
        let (mut u_in, mut x_in): ([Column; 2], [Column; 3]) = (u_memory.inputs(), x_memory.inputs());
        let self_in = if null_at == 0 { null() } else { own };
        let self_null = null_at == 0 && t.numbers > 0;
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
                let status = etendue_warp_sample_batch(number, self_in.cast(), n, u_in.as_ptr(), outputs.as_ptr());
                assert_eq!(status, expected(n, missing(2)));
                if status == EtendueStatus::Ok { t.coordinates } else { 0 }
            }
            1 => {
                let status = etendue_warp_invert_batch(number, self_in.cast(), n, x_in.as_ptr(), outputs.as_ptr());
                assert_eq!(status, expected(n, missing(t.coordinates)));
                if status == EtendueStatus::Ok { 2 } else { 0 }
            }
            _ => {
                let status = etendue_warp_pdf_batch(number, self_in.cast(), n, x_in.as_ptr(), outputs[0]);
                assert_eq!(status, expected(n, missing(t.coordinates) || widths[0] == 0));
                usize::from(status == EtendueStatus::Ok)
            }
        };
        memory.only(&widths[..written]);
        for i in 0..if written > 0 { n } else { 0 } {
            let (u_i, x_i) = ([u[0][i], u[1][i]], [x[0][i], x[1][i], x[2][i]]);
            let mut one = [0.0; 3];
            match call {
                0 => {
                    let status = etendue_warp_sample(number, own.cast(), u_i.as_ptr(), one.as_mut_ptr());
                    // a single call refuses numbers that a batch maps to anything
                    let is_inside = u_i.iter().all(|u| (0.0..1.0).contains(u));
                    assert_eq!(status, if is_inside { EtendueStatus::Ok } else { EtendueStatus::Value });
                    if !is_inside {
                        continue;
                    }
                }
                1 => assert_eq!(
                    etendue_warp_invert(number, own.cast(), x_i.as_ptr(), one.as_mut_ptr()),
                    EtendueStatus::Ok
                ),
                _ => one[0] = etendue_warp_pdf(number, own.cast(), x_i.as_ptr()),
            }
            for k in 0..written {
                assert!(widths[k] == 0 || same(memory.get(k, i), one[k]), "column {k} of element {i}");
            }
            total(is_finite, one);
        }
    }
}
