//! Sequences, and the choice of lights.

use super::input::{Input, fraction, unit, units};
use super::memory::Memory;
use super::{COUNTS, Column, Output};
use etendue_c::*;
use std::ptr::{null, null_mut};

/// Calls the functions of sequences.
pub(super) fn sequence(input: &mut Input<'_>) {
    let kind = input.below(4);
    let n = COUNTS[input.below(COUNTS.len())];
    let null_at = input.below(8);
    let (seed, count) = (u64::from(input.word()), input.word());
    let counters = EtendueCounters {
        pixel: input.word(),
        sample: input.word(),
        dimension: input.word(),
        pixels: null(),
        samples: null(),
    };
    let words: [Vec<f32>; 2] = input.columns(n, |x| x);
    let words_memory = Memory::of(input, &words);
    let [pixels, samples]: [Column; 2] = words_memory.inputs();
    let has = [input.below(2) == 1, input.below(2) == 1];
    let given = EtendueCounters {
        pixels: if has[0] { pixels.cast() } else { null() },
        samples: if has[1] { samples.cast() } else { null() },
        ..counters
    };
    let mut memory = Memory::new(input, 2, n);
    // SAFETY: pointers are null or to as many numbers as the header demands
    let pairs = |counters: *const EtendueCounters, n: usize, u: *const Output| unsafe {
        match kind {
            0 => etendue_independent_pairs(seed, counters, n, u),
            1 => etendue_owen_sobol_pairs(seed, counters, n, u),
            2 => etendue_joint_sobol_pairs(seed, counters, n, u),
            _ => etendue_stratified_pairs(seed, count, counters, n, u),
        }
    };
    let mut outputs: [Output; 2] = memory.outputs();
    let mut widths = [4; 2];
    if (2..4).contains(&null_at) {
        (outputs[null_at - 2], widths[null_at - 2]) = (null_mut(), 0);
    }
    let status = match null_at {
        0 => pairs(null(), n, outputs.as_ptr()),
        1 => pairs(&given, n, null()),
        _ => pairs(&given, n, outputs.as_ptr()),
    };
    memory.has(status, null_at < 2, &widths, true, |i| {
        let one = EtendueCounters {
            pixel: if has[0] { words[0][i].to_bits() } else { counters.pixel },
            sample: if has[1] { words[1][i].to_bits() } else { counters.sample.wrapping_add(i as u32) },
            ..counters
        };
        let mut u = [0.0_f32; 2];
        let [x, y] = &mut u;
        assert_eq!(pairs(&one, 1, [&raw mut *x, &raw mut *y].as_ptr()), EtendueStatus::Ok);
        assert!(u.iter().all(|u| (0.0..1.0).contains(u)), "{u:?}");
        Some(u.to_vec())
    });
}

/// Calls the functions of the light tree.
pub(super) fn tree(input: &mut Input<'_>) {
    let light_count = input.below(40);
    let n = COUNTS[input.below(COUNTS.len())];
    let null_at = input.below(24);
    let mut lights: Vec<EtendueLightBound> = (0..light_count)
        .map(|_| EtendueLightBound {
            center: [(); 3].map(|()| input.number()),
            radius: input.number(),
            normal: if input.below(2) == 0 { [0.0; 3] } else { unit([(); 3].map(|()| input.number())) },
            cos_cone: 0.0,
            two_sided: u8::from(input.below(4) == 0),
            power: input.number(),
        })
        .collect();
    // SAFETY: a node is 90 words
    let canary: EtendueLightTreeNode = unsafe { std::mem::transmute([0xA5A5_A5A5_u32; 90]) };
    let node_count = etendue_light_tree_nodes(light_count);
    let (mut nodes, mut places) = (vec![canary; node_count + 1], vec![0xA5A5_A5A5_u32; light_count + 1]);
    let mut tree = EtendueLightTree { nodes: null(), node_count: 0, places: null(), light_count: 0 };
    let (p, normals): ([Vec<f32>; 3], _) = (input.columns(n, |x| x), units(input.columns(n, |x| x)));
    let [u]: [Vec<f32>; 1] = input.columns(n, fraction);
    // SAFETY of all calls: pointers are null or to as many numbers as the header demands
    unsafe {
        if light_count > 0 && input.below(8) == 0 {
            lights[light_count - 1].two_sided = 2 + input.byte() % 254;
            let status = etendue_light_tree_build(
                lights.as_ptr(),
                light_count,
                nodes.as_mut_ptr(),
                places.as_mut_ptr(),
                &mut tree,
            );
            assert_eq!(status, EtendueStatus::Value);
            assert!(tree.nodes.is_null() && places.iter().all(|x| *x == 0xA5A5_A5A5));
            lights[light_count - 1].two_sided = 0;
        }
        let status =
            etendue_light_tree_build(lights.as_ptr(), light_count, nodes.as_mut_ptr(), places.as_mut_ptr(), &mut tree);
        assert_eq!(status, EtendueStatus::Ok);
        assert_eq!(places[light_count], 0xA5A5_A5A5);
        let last: [u32; 90] = std::mem::transmute(nodes[node_count]);
        assert_eq!(last, [0xA5A5_A5A5; 90]);

        let given = [&p[..], &normals, &[u]].concat();
        let memory_in = Memory::of(input, &given);
        let mut columns: [Column; 7] = memory_in.inputs();
        let is_null = null_at < 7;
        if is_null {
            columns[null_at] = null();
        }
        let mut memory = Memory::new(input, 4, n);
        let mut outputs: [Output; 4] = memory.outputs();
        let chosen = outputs[0];
        let mut widths = [4; 3];
        if (7..10).contains(&null_at) {
            (outputs[null_at - 7], widths[null_at - 7]) = (null_mut(), 0);
        }
        let out = EtendueChoiceColumns { light: outputs[0].cast(), pmf: outputs[1], u: outputs[2] };
        let (p_in, n_in) = (columns.as_ptr(), columns[3..].as_ptr());
        let status = etendue_light_tree_choose_batch(&tree, n, p_in, n_in, columns[6], &out);
        let alone = |i: usize| {
            let (mut light, mut pmf, mut rest, mut again) = (0_u32, 0.0_f32, 0.0_f32, 0.0_f32);
            let one = EtendueChoiceColumns { light: &mut light, pmf: &mut pmf, u: &mut rest };
            let at: [Column; 7] = std::array::from_fn(|k| given[k][i..].as_ptr());
            let (p_in, n_in) = (at.as_ptr(), at[3..].as_ptr());
            assert_eq!(etendue_light_tree_choose_batch(&tree, 1, p_in, n_in, at[6], &one), EtendueStatus::Ok);
            assert_eq!(etendue_light_tree_pmf_batch(&tree, 1, p_in, n_in, &light, &mut again), EtendueStatus::Ok);
            assert!(
                pmf.to_bits() == again.to_bits() && (0.0..=1.0).contains(&pmf),
                "chosen with {pmf}, which is {again}"
            );
            assert!(if light == u32::MAX {
                pmf == 0.0
            } else {
                (light as usize) < light_count && lights[light as usize].power > 0.0
            });
            Some(vec![f32::from_bits(light), pmf, rest])
        };
        memory.has(status, is_null, &widths, false, alone);
        if !is_null {
            // without the column of lights, its canaries are indices of no light
            assert_eq!(
                etendue_light_tree_pmf_batch(&tree, n, p_in, n_in, chosen.cast(), outputs[3]),
                EtendueStatus::Ok
            );
            for i in 0..n {
                let pmf = if widths[0] == 0 { Some(0.0) } else { alone(i).map(|choice| choice[1]) };
                assert_eq!(Some(memory.get(3, i)), pmf);
            }
        }
    }
}
