//! The functions of lights.

use super::input::{Input, fraction, unit, units};
use super::memory::Memory;
use super::{COUNTS, Column, FIELDS, LIGHT, Output, SAMPLER, all_finite, fields, same, sample_columns};
use etendue::listed::light::{ENTRIES, Entry, With};
use etendue_c::*;
use std::ffi::c_void;
use std::ptr::{from_ref, null, null_mut};

/// The roughness of all surfaces, which are seen along their normals.
const ALPHA: f32 = 0.3;

/// What a light is prepared for where the surface has this normal, in memory that lives as long as what is returned.
struct Prepared {
    reflection: EtendueReflection,
    normal: Column,
    needs: With,
}

impl Prepared {
    unsafe fn new(needs: With, normal: Column) -> Self {
        let mut reflection = EtendueReflection { data: [0.0; 14], albedo: 0.0, schlick: 0.0 };
        // SAFETY: the caller's
        let status = unsafe { etendue_reflection_prepare(ALPHA, normal, normal, &mut reflection) };
        assert_eq!(status, EtendueStatus::Ok);
        Self { reflection, normal, needs }
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

/// What a technique does for a point.
#[derive(Clone, Copy, PartialEq)]
enum Function {
    Sample,
    Hit,
    Pdf,
    Invert,
}
use Function::{Hit, Invert, Pdf, Sample};

/// The functions of a technique, and what they are called with.
struct Calls {
    number: u32,
    u: [Vec<f32>; 2],
    w: [Vec<f32>; 3],
    /// Whether all numbers are finite.
    is_finite: bool,
}

impl Calls {
    fn is_inside(&self, i: usize) -> bool {
        self.u.iter().all(|column| (0.0..1.0).contains(&column[i]))
    }
    /// What an element gives alone; none if it is refused, as a sample is for numbers that a batch maps to anything.
    unsafe fn alone(&self, function: Function, sampler: Column, i: usize) -> Option<Vec<f32>> {
        let (number, sampler, mut one) = (self.number, sampler.cast(), EtendueLightSample::default());
        let (u, w) = (self.u.each_ref().map(|u| u[i]), self.w.each_ref().map(|w| w[i]));
        let mut back = [0.0; 2];
        // SAFETY: the caller's
        let (status, results) = unsafe {
            match function {
                Sample => (etendue_sample(number, sampler, u.as_ptr(), &mut one), fields(&one).to_vec()),
                Hit => (etendue_hit(number, sampler, w.as_ptr(), &mut one), fields(&one).to_vec()),
                Invert => (etendue_invert(number, sampler, w.as_ptr(), back.as_mut_ptr()), back.to_vec()),
                Pdf => (EtendueStatus::Ok, vec![etendue_pdf(number, sampler, w.as_ptr())]),
            }
        };
        let is_refused = function == Sample && !self.is_inside(i);
        assert_eq!(status, if is_refused { EtendueStatus::Value } else { EtendueStatus::Ok });
        let is_closed = function != Invert || !self.is_finite || results.iter().all(|x| (0.0..1.0).contains(x));
        assert!(is_closed, "{results:?} is not in [0, 1)^2");
        (!is_refused).then_some(results)
    }
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
    let (u, w) = (input.columns(n, fraction), units(input.columns(n, |x| x)));
    let is_finite = all_finite(&[&light, &p, &normal, &u[0], &u[1], &w[0], &w[1], &w[2]]);
    let mut calls = Calls { number, u, w, is_finite };
    let mut sampler = [f32::from_bits(0xA5A5_A5A5); SAMPLER];
    // SAFETY of all calls: pointers are null or to as many numbers as the header demands
    unsafe {
        let out = sampler.as_mut_ptr();
        let with = Prepared::new(needs, normal.as_ptr());
        let with = with.pointer();
        let prepare =
            |light: Column, p: Column, with, out: Output| etendue_prepare(number, light.cast(), p, with, out.cast());
        assert_eq!(prepare(null(), p.as_ptr(), with, out), EtendueStatus::NullPointer);
        assert_eq!(prepare(light.as_ptr(), null(), with, out), EtendueStatus::NullPointer);
        if needs != With::Nothing {
            assert_eq!(prepare(light.as_ptr(), p.as_ptr(), null(), out), EtendueStatus::NullPointer);
        }
        let unknown = u32::MAX - index as u32;
        assert_eq!(etendue_prepare(unknown, light.as_ptr().cast(), p.as_ptr(), with, out.cast()), EtendueStatus::Value);
        assert!(sampler.iter().all(|x| x.to_bits() == 0xA5A5_A5A5));
        let out = sampler.as_mut_ptr();
        assert_eq!(prepare(light.as_ptr(), p.as_ptr(), with, out), EtendueStatus::Ok);
        assert!(sampler[sampler_numbers..].iter().all(|x| x.to_bits() == 0xA5A5_A5A5));
        let (sampler, mut memory) = (sampler.as_ptr(), Memory::new(input, FIELDS, n));
        let (u_memory, w_memory) = (Memory::of(input, &calls.u), Memory::of(input, &calls.w));
        let (mut u_in, mut w_in): ([Column; 2], [Column; 3]) = (u_memory.inputs(), w_memory.inputs());
        let self_in = if null_at == 0 { null() } else { sampler };
        if (1..3).contains(&null_at) {
            u_in[null_at - 1] = null();
        }
        if (1..4).contains(&null_at) {
            w_in[null_at - 1] = null();
        }
        let mut outputs: [Output; FIELDS] = memory.outputs();
        let mut widths = [4; FIELDS];
        widths[11] = 1;
        for (k, output) in outputs.iter_mut().enumerate() {
            if absent >> k & 1 == 1 {
                (*output, widths[k]) = (null_mut(), 0);
            }
        }
        let columns = sample_columns(outputs);
        let (u_in, w_in) = (u_in.as_ptr(), w_in.as_ptr());
        // whether a pointer is missing that has to be there, and the columns that are written
        let wants = |function: Function, others: bool| match function {
            Sample => (others || (1..3).contains(&null_at), FIELDS),
            Hit => (others || (1..4).contains(&null_at), FIELDS),
            Invert => (others || (1..4).contains(&null_at), 2),
            Pdf => (others || (1..4).contains(&null_at) || widths[0] == 0, 1),
        };
        if call < 4 {
            let function = [Sample, Hit, Pdf, Invert][call];
            let status = match function {
                Sample => etendue_sample_batch(number, self_in.cast(), n, u_in, &columns),
                Hit => etendue_hit_batch(number, self_in.cast(), n, w_in, &columns),
                Pdf => etendue_pdf_batch(number, self_in.cast(), n, w_in, outputs[0]),
                Invert => etendue_invert_batch(number, self_in.cast(), n, w_in, outputs.as_ptr()),
            };
            let (is_null, written) = wants(function, null_at == 0);
            let alone = |i: usize| calls.alone(function, sampler, i);
            memory.has(status, is_null, &widths[..written], is_finite, alone);
        } else if call == 4 {
            over_inputs(&calls, sampler, Memory::of(input, &[&calls.u[..], &calls.w].concat()), n);
        } else {
            let mut lights: [Vec<f32>; LIGHT] = input.columns(n, |x| x);
            if let Some(at) = unit_at {
                let vectors = units([0, 1, 2].map(|k| lights[at + k].clone()));
                lights[at..at + 3].clone_from_slice(&vectors);
            }
            let (points, normals): ([Vec<f32>; 3], _) = (input.columns(n, |x| x), units(input.columns(n, |x| x)));
            calls.is_finite &= lights.iter().chain(&points).chain(&normals).all(|column| all_finite(&[column]));
            let [light_memory, p_memory, n_memory] =
                [&lights[..], &points, &normals].map(|columns| Memory::of(input, columns));
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
            let function = [Sample, Hit, Invert, Pdf][input.below(4)];
            let status = match function {
                Sample => etendue_sample_each(number, lights_in, n, p_in, withs, u_in, &columns),
                Hit => etendue_hit_each(number, lights_in, n, p_in, withs, w_in, &columns),
                Invert => etendue_invert_each(number, lights_in, n, p_in, withs, w_in, outputs.as_ptr()),
                Pdf => etendue_pdf_each(number, lights_in, n, p_in, withs, w_in, outputs[0]),
            };
            let (is_null, written) = wants(function, is_null);
            memory.has(status, is_null, &widths[..written], calls.is_finite, |i| {
                let light: [f32; LIGHT] = std::array::from_fn(|k| lights[k][i]);
                let [p, normal] = [&points, &normals].map(|c| [c[0][i], c[1][i], c[2][i]]);
                let mut sampler = [0.0; SAMPLER];
                let own = Prepared::new(needs, normal.as_ptr());
                prepare(light.as_ptr(), p.as_ptr(), own.pointer(), sampler.as_mut_ptr());
                calls.alone(function, sampler.as_ptr(), i)
            });
        }
    }
}

/// Results over inputs: some of the sample's over u, the inverse over the last and the first coordinate of w.
unsafe fn over_inputs(calls: &Calls, sampler: Column, mut both: Memory, n: usize) {
    let [a, b, c, d, e]: [Output; 5] = both.outputs();
    let mut fields = [null_mut(); FIELDS];
    (fields[1], fields[5]) = (a, b);
    let (u_in, w_in) = ([a, b].map(<*mut f32>::cast_const), [c, d, e].map(<*mut f32>::cast_const));
    let (number, own, columns) = (calls.number, sampler.cast(), sample_columns(fields));
    // SAFETY: the caller's
    unsafe {
        assert_eq!(etendue_sample_batch(number, own, n, u_in.as_ptr(), &columns), EtendueStatus::Ok);
        assert_eq!(etendue_invert_batch(number, own, n, w_in.as_ptr(), [e, c].as_ptr()), EtendueStatus::Ok);
        for i in 0..n {
            let Some(one) = calls.alone(Sample, sampler, i) else { continue };
            let back = calls.alone(Invert, sampler, i).expect("no direction is refused");
            let results = [both.get(0, i), both.get(1, i), both.get(4, i), both.get(2, i)];
            assert!(results.into_iter().zip([one[1], one[5], back[0], back[1]]).all(|(a, b)| same(a, b)));
        }
    }
}
