//! The functions of lights.
#![allow(clippy::needless_range_loop, reason = "several columns have the same index")]

use super::input::{Input, fraction, unit, units};
use super::memory::Memory;
use super::{
    COUNTS, Column, FIELDS, LIGHT, Output, SAMPLER, all_finite, expected, fields, same, sample_columns, total,
};
use etendue::light::listed::{ENTRIES, Entry, With};
use etendue_c::*;
use std::ffi::c_void;
use std::ptr::{from_ref, null, null_mut};

/// The roughness of all surfaces, which are seen along their normals.
const ALPHA: f32 = 0.3;

/// What a light is prepared for where the surface has this normal, in memory that lives as long as what is returned; none without a normal.
struct Prepared {
    reflection: EtendueReflection,
    normal: Column,
    needs: With,
}

impl Prepared {
    unsafe fn new(needs: With, normal: Column) -> Option<Self> {
        let mut reflection = EtendueReflection { data: [0.0; 14], albedo: 0.0, schlick: 0.0 };
        if normal.is_null() {
            return None;
        }
        // SAFETY: the caller's
        unsafe {
            assert_eq!(etendue_reflection_prepare(ALPHA, normal, normal, &mut reflection), EtendueStatus::Ok);
        }
        Some(Self { reflection, normal, needs })
    }
    fn pointer(&self) -> *const c_void {
        match self.needs {
            With::Nothing => null(),
            With::Normal => self.normal.cast(),
            With::Reflection => from_ref(&self.reflection).cast(),
        }
    }
}

/// The same in columns, for normals in columns, any of which may be missing.
struct Withs {
    /// The numbers of all columns.
    _numbers: Vec<f32>,
    pointers: Vec<Column>,
}

impl Withs {
    unsafe fn new(needs: With, n: usize, normals: &[Column; 3]) -> Self {
        let missing = normals.iter().any(|column| column.is_null());
        let mut numbers = vec![0.0; 16 * n.max(1)];
        let mut columns = numbers.chunks_mut(n.max(1)).map(<[f32]>::as_mut_ptr).collect::<Vec<_>>();
        match needs {
            With::Nothing => columns.clear(),
            With::Normal => columns = normals.iter().map(|column| column.cast_mut()).collect(),
            With::Reflection => {
                let mut next = columns.iter().copied();
                let mut next = || next.next().unwrap_or(null_mut());
                let out = EtendueReflectionColumns { data: [(); 14].map(|()| next()), albedo: next(), schlick: next() };
                let alphas = vec![ALPHA; n];
                // SAFETY: the columns have n elements or are null
                unsafe {
                    etendue_reflection_prepare_batch(n, alphas.as_ptr(), normals.as_ptr(), normals.as_ptr(), &out)
                };
            }
        }
        if missing && !columns.is_empty() {
            columns[0] = null_mut();
        }
        Self { _numbers: numbers, pointers: columns.into_iter().map(<*mut f32>::cast_const).collect() }
    }
    fn pointer(&self) -> *const c_void {
        if self.pointers.is_empty() { null() } else { self.pointers.as_ptr().cast() }
    }
}

/// Where the numbers of a light have a unit vector, if they do.
fn unit_at(entry: &Entry) -> Option<usize> {
    let at = entry.fields.iter().position(|field| field.kind == "direction")?;
    Some(entry.fields[..at].iter().map(|field| if field.kind == "number" { 1 } else { 3 }).sum())
}

/// Calls the functions of a technique.
pub(super) fn check(input: &mut Input<'_>, index: usize) {
    let (t, number) = (&ENTRIES[index], index as u32);
    let ([light_numbers, sampler_numbers], needs) = (t.numbers, t.with());
    assert!(light_numbers <= LIGHT && sampler_numbers <= SAMPLER, "{} needs more room", t.name);
    let call = input.below(6);
    let n = COUNTS[input.below(COUNTS.len())];
    // the pointer that is null, if any
    let null_at = input.below(64);
    let absent = u16::from(input.byte()) << 8 | u16::from(input.byte());
    let mut light: Vec<f32> = (0..light_numbers).map(|_| input.number()).collect();
    let unit_at = unit_at(t);
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
        let with = Prepared::new(needs, normal.as_ptr()).expect("the normal is there");
        let with = with.pointer();
        let prepare =
            |light: Column, p: Column, with, out: Output| etendue_prepare(number, light.cast(), p, with, out.cast());
        assert_eq!(prepare(null(), p.as_ptr(), with, out), EtendueStatus::NullPointer);
        assert_eq!(prepare(light.as_ptr(), null(), with, out), EtendueStatus::NullPointer);
        let without = if needs == With::Nothing { EtendueStatus::Ok } else { EtendueStatus::NullPointer };
        if without != EtendueStatus::Ok {
            assert_eq!(prepare(light.as_ptr(), p.as_ptr(), null(), out), without);
        }
        let unknown = u32::MAX - index as u32;
        assert_eq!(etendue_prepare(unknown, light.as_ptr().cast(), p.as_ptr(), with, out.cast()), EtendueStatus::Value);
        assert!(sampler.iter().all(|x| x.to_bits() == 0xA5A5_A5A5));
        let out = sampler.as_mut_ptr();
        assert_eq!(prepare(light.as_ptr(), p.as_ptr(), with, out), EtendueStatus::Ok);
        assert!(sampler[sampler_numbers..].iter().all(|x| x.to_bits() == 0xA5A5_A5A5));
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
        let is_inside = |i: usize| u.iter().all(|column| (0.0..1.0).contains(&column[i]));
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
                    (u_null, etendue_sample_batch(number, self_in.cast(), n, u_in.as_ptr(), &columns))
                } else {
                    (w_null, etendue_hit_batch(number, self_in.cast(), n, w_in.as_ptr(), &columns))
                };
                assert_eq!(status, expected(n, is_null));
                memory.only(if status == EtendueStatus::Ok { &widths } else { &[] });
                for i in 0..if is_null { 0 } else { n } {
                    let status = if call == 0 {
                        etendue_sample(number, sampler.cast(), [u[0][i], u[1][i]].as_ptr(), &mut one)
                    } else {
                        etendue_hit(number, sampler.cast(), [w[0][i], w[1][i], w[2][i]].as_ptr(), &mut one)
                    };
                    // a single call refuses numbers that a batch maps to anything
                    let is_refused = call == 0 && !is_inside(i);
                    assert_eq!(status, if is_refused { EtendueStatus::Value } else { EtendueStatus::Ok });
                    if is_refused {
                        continue;
                    }
                    check(&memory, i, &one);
                    total(is_finite, fields(&one));
                }
            }
            2 => {
                let out = memory.outputs::<1>()[0];
                let status = etendue_pdf_batch(number, self_in.cast(), n, w_in.as_ptr(), out);
                assert_eq!(status, expected(n, w_null));
                memory.only(if w_null { &[] } else { &[4] });
                for i in 0..if w_null { 0 } else { n } {
                    let pdf = etendue_pdf(number, sampler.cast(), [w[0][i], w[1][i], w[2][i]].as_ptr());
                    assert!(same(memory.get(0, i), pdf));
                    total(is_finite, [pdf]);
                }
            }
            3 => {
                let status = etendue_invert_batch(number, self_in.cast(), n, w_in.as_ptr(), outputs.as_ptr());
                assert_eq!(status, expected(n, w_null));
                memory.only(if w_null { &[] } else { &widths[..2] });
                for i in 0..if w_null { 0 } else { n } {
                    let mut back = [0.0; 2];
                    assert_eq!(
                        etendue_invert(number, sampler.cast(), [w[0][i], w[1][i], w[2][i]].as_ptr(), back.as_mut_ptr()),
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
                    etendue_sample_batch(
                        number,
                        sampler.cast(),
                        n,
                        [a.cast_const(), b.cast_const()].as_ptr(),
                        &columns
                    ),
                    EtendueStatus::Ok
                );
                let w_in = [c.cast_const(), d.cast_const(), e.cast_const()];
                assert_eq!(
                    etendue_invert_batch(number, sampler.cast(), n, w_in.as_ptr(), [e, c].as_ptr()),
                    EtendueStatus::Ok
                );
                for i in (0..n).filter(|&i| is_inside(i)) {
                    let mut back = [0.0; 2];
                    etendue_sample(number, sampler.cast(), [u[0][i], u[1][i]].as_ptr(), &mut one);
                    etendue_invert(number, sampler.cast(), [w[0][i], w[1][i], w[2][i]].as_ptr(), back.as_mut_ptr());
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
                let mut is_null = false;
                match null_at {
                    3..6 => (p_in[null_at - 3], is_null) = (null(), true),
                    6..9 => (n_in[null_at - 6], is_null) = (null(), needs != With::Nothing),
                    9..33 => (light_in[null_at - 9], is_null) = (null(), null_at - 9 < light_numbers),
                    _ => (),
                }
                let withs = Withs::new(needs, n, &n_in);
                let (lights_in, p_in, withs) = (light_in.as_ptr().cast(), p_in.as_ptr(), withs.pointer());
                let [u_null, w_null] = [1..3, 1..4].map(|own| is_null || own.contains(&null_at));
                let function = input.below(4);
                let (is_null, status, written) = match function {
                    0 => (
                        u_null,
                        etendue_sample_each(number, lights_in, n, p_in, withs, u_in.as_ptr(), &columns),
                        FIELDS,
                    ),
                    1 => (w_null, etendue_hit_each(number, lights_in, n, p_in, withs, w_in.as_ptr(), &columns), FIELDS),
                    2 => (
                        w_null,
                        etendue_invert_each(number, lights_in, n, p_in, withs, w_in.as_ptr(), outputs.as_ptr()),
                        2,
                    ),
                    _ => (
                        w_null || widths[0] == 0,
                        etendue_pdf_each(number, lights_in, n, p_in, withs, w_in.as_ptr(), outputs[0]),
                        1,
                    ),
                };
                assert_eq!(status, expected(n, is_null));
                memory.only(if status == EtendueStatus::Ok { &widths[..written] } else { &[] });
                for i in (0..if is_null { 0 } else { n }).filter(|&i| function > 0 || is_inside(i)) {
                    let light: [f32; LIGHT] = std::array::from_fn(|k| lights[k][i]);
                    let [p, normal] = [&points, &normals].map(|c| [c[0][i], c[1][i], c[2][i]]);
                    let (u, w) = ([u[0][i], u[1][i]], [w[0][i], w[1][i], w[2][i]]);
                    let mut sampler = [0.0; SAMPLER];
                    let own = Prepared::new(needs, normal.as_ptr()).expect("the normal is there");
                    let own = own.pointer();
                    prepare(light.as_ptr(), p.as_ptr(), own, sampler.as_mut_ptr());
                    let mut few = [0.0; 2];
                    match function {
                        0 => etendue_sample(number, sampler.as_ptr().cast(), u.as_ptr(), &mut one),
                        1 => etendue_hit(number, sampler.as_ptr().cast(), w.as_ptr(), &mut one),
                        2 => etendue_invert(number, sampler.as_ptr().cast(), w.as_ptr(), few.as_mut_ptr()),
                        _ => {
                            few[0] = etendue_pdf(number, sampler.as_ptr().cast(), w.as_ptr());
                            EtendueStatus::Ok
                        }
                    };
                    if function < 2 {
                        check(&memory, i, &one);
                        total(is_finite, fields(&one));
                    } else {
                        for (k, x) in few.into_iter().enumerate().take(written) {
                            assert!(widths[k] == 0 || same(memory.get(k, i), x));
                        }
                        total(is_finite, few);
                    }
                }
            }
        }
    }
}
