//! The functions of warps.

use super::input::{Input, fraction, unit};
use super::memory::Memory;
use super::{COUNTS, Column, Output, all_finite};
use etendue::listed::warp::ENTRIES;
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
    let (u_memory, x_memory) = (Memory::of(input, &u), Memory::of(input, &x));
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
        let (outputs, u_in, x_in) = (outputs.as_ptr(), u_in.as_ptr(), x_in.as_ptr());
        let (status, is_null, written) = match call {
            0 => (etendue_warp_sample_batch(number, self_in.cast(), n, u_in, outputs), missing(2), t.coordinates),
            1 => (etendue_warp_invert_batch(number, self_in.cast(), n, x_in, outputs), missing(t.coordinates), 2),
            _ => {
                let status = etendue_warp_pdf_batch(number, self_in.cast(), n, x_in, *outputs);
                (status, missing(t.coordinates) || widths[0] == 0, 1)
            }
        };
        memory.has(status, is_null, &widths[..written], is_finite, |i| {
            let (u, x) = (u.each_ref().map(|u| u[i]), x.each_ref().map(|x| x[i]));
            let mut one = [0.0; 3];
            let status = match call {
                0 => etendue_warp_sample(number, own.cast(), u.as_ptr(), one.as_mut_ptr()),
                1 => etendue_warp_invert(number, own.cast(), x.as_ptr(), one.as_mut_ptr()),
                _ => {
                    one[0] = etendue_warp_pdf(number, own.cast(), x.as_ptr());
                    EtendueStatus::Ok
                }
            };
            // a single call refuses numbers that a batch maps to anything
            let is_refused = call == 0 && !u.iter().all(|u| (0.0..1.0).contains(u));
            assert_eq!(status, if is_refused { EtendueStatus::Value } else { EtendueStatus::Ok });
            (!is_refused).then(|| one.to_vec())
        });
    }
}
