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
pub(super) struct Functions {
    /// The light's struct.
    name: &'static str,
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
    sample_each: unsafe fn(&Views, usize, *const Column, *const EtendueSampleColumns) -> EtendueStatus,
    hit_each: unsafe fn(&Views, usize, *const Column, *const EtendueSampleColumns) -> EtendueStatus,
    pdf_each: unsafe fn(&Views, usize, *const Column, Output) -> EtendueStatus,
    invert_each: unsafe fn(&Views, usize, *const Column, *const Output) -> EtendueStatus,
}

/// Columns of lights, shading points and normals.
struct Views {
    lights: *const Column,
    p: *const Column,
    n: *const Column,
}

impl Views {
    /// Reflections of surfaces with these normals, if all are there, in memory that lives as long as what is returned.
    fn reflections(&self, n: usize) -> Option<(Vec<f32>, EtendueReflectionColumns)> {
        let mut numbers = vec![0.0; 16 * n];
        let mut columns = numbers.chunks_mut(n.max(1)).map(<[f32]>::as_mut_ptr);
        let mut next = || columns.next().unwrap_or(null_mut());
        let out = EtendueReflectionColumns { data: [(); 14].map(|()| next()), albedo: next(), schlick: next() };
        let alphas = vec![ALPHA; n];
        // SAFETY: the columns have n elements or are null
        let status = unsafe { etendue_reflection_prepare_batch(n, alphas.as_ptr(), self.n, self.n, &out) };
        (status == EtendueStatus::Ok).then_some((numbers, out))
    }
}

/// The roughness of all surfaces, which are seen along their normals.
const ALPHA: f32 = 0.3;

/// The reflection of a surface with this normal, if that is there.
unsafe fn reflection(normal: Column) -> Option<EtendueReflection> {
    let mut out = EtendueReflection { data: [0.0; 14], albedo: 0.0, schlick: 0.0 };
    // SAFETY: the caller's
    let status = unsafe { etendue_reflection_prepare(ALPHA, normal, normal, &mut out) };
    (status == EtendueStatus::Ok).then_some(out)
}

/// Calls a function with a normal or a reflection, if the technique needs one.
macro_rules! call {
    (needs_normal (p, n)) => {
        true
    };
    (needs_normal (p, reflection)) => {
        true
    };
    (needs_normal $place:tt) => {
        false
    };
    ((p, n) $module:ident::$function:ident($($before:expr),*; $normal:expr; $($after:expr),*)) => {
        $module::$function($($before,)* $normal, $($after),*)
    };
    ((p, reflection) $module:ident::$function:ident($($before:expr),*; $normal:expr; $($after:expr),*)) => {
        $module::$function($($before,)* reflection($normal).as_ref().map_or(null(), std::ptr::from_ref), $($after),*)
    };
    ($place:tt $module:ident::$function:ident($($before:expr),*; $normal:expr; $($after:expr),*)) => {{
        let _ = $normal;
        $module::$function($($before,)* $($after),*)
    }};
}
/// Calls a function with a light, a point, and a normal or a reflection of its own for each element.
macro_rules! each {
    ((p, reflection) $views:ident, $n:ident, $module:ident::$function:ident($($after:expr),*)) => {{
        let reflections = $views.reflections($n);
        let columns = reflections.as_ref().map_or(null(), |(_, columns)| std::ptr::from_ref(columns));
        $module::$function($views.lights.cast(), $n, $views.p, columns, $($after),*)
    }};
    ($place:tt $views:ident, $n:ident, $module:ident::$function:ident($($after:expr),*)) => {
        call!($place $module::$function($views.lights.cast(), $n, $views.p; $views.n; $($after),*))
    };
}
/// The functions of a technique.
macro_rules! functions {
    ($light:ident, $size:literal, $name:ident, $place:tt) => {
        // SAFETY of all: the caller's pointers are those that the functions demand
        Functions {
            name: stringify!($light),
            light: size_of::<$light>() / 4,
            sampler: $size,
            on_surface: call!(needs_normal $place),
            prepare: |light, p, n, out| unsafe { call!($place $name::prepare(light.cast(), p; n; out.cast())) },
            sample: |s, u, out| unsafe { $name::sample(s.cast(), u, out) },
            pdf: |s, w| unsafe { $name::pdf(s.cast(), w) },
            invert: |s, w, u| unsafe { $name::invert(s.cast(), w, u) },
            hit: |s, w, out| unsafe { $name::hit(s.cast(), w, out) },
            once: |light, p, n, u, out| unsafe { call!($place $name::sample_once(light.cast(), p; n; u, out)) },
            sample_batch: |s, n, u, out| unsafe { $name::sample_batch(s.cast(), n, u, out) },
            pdf_batch: |s, n, w, out| unsafe { $name::pdf_batch(s.cast(), n, w, out) },
            invert_batch: |s, n, w, u| unsafe { $name::invert_batch(s.cast(), n, w, u) },
            hit_batch: |s, n, w, out| unsafe { $name::hit_batch(s.cast(), n, w, out) },
            sample_each: |v, n, u, out| unsafe { each!($place v, n, $name::sample_each(u, out)) },
            hit_each: |v, n, w, out| unsafe { each!($place v, n, $name::hit_each(w, out)) },
            pdf_each: |v, n, w, out| unsafe { each!($place v, n, $name::pdf_each(w, out)) },
            invert_each: |v, n, w, u| unsafe { each!($place v, n, $name::invert_each(w, u)) },
        }
    };
}
macro_rules! techniques {
    ($(
        $(#[$light_doc:meta])* $core:ident $([$corners:literal])? = $light:ident, $columns:ident {
            $($(#[$field_doc:meta])* $field:ident as $argument:ident: $kind:ident,)+
        } $(reflected {
            $(#[$lobe_doc:meta])* $lobe:ident $([$lobe_n:literal])? $(= $lobe_c:ident, $lobe_name:ident[$lobe_size:literal])?;
        })? by $default:literal {
            $(
                $(#[$doc:meta])* $core_sampler:ident $([$n:literal])?
                    $(= $sampler:ident, $name:ident[$size:literal])?: $by:ident $place:tt $($measure:ident)?;
            )+
        }
    )+) => {
        pub(super) const TECHNIQUES: &[Functions] = &[$(
            $($(functions!($light, $size, $name, $place),)?)+
            $($(functions!($light, $lobe_size, $lobe_name, (p, reflection)),)?)?
        )+];
        /// The kinds of the fields of each light.
        const KINDS: &[(&str, &[&str])] = &[$((stringify!($light), &[$(stringify!($kind)),+]),)+];
    };
}
etendue::techniques!(techniques! {});

/// Where the numbers of a light have a unit vector, if they do.
fn unit_at(light: &str) -> Option<usize> {
    let (_, kinds) = KINDS.iter().find(|(name, _)| *name == light)?;
    let at = kinds.iter().position(|kind| *kind == "direction")?;
    Some(kinds[..at].iter().map(|kind| if *kind == "number" { 1 } else { 3 }).sum())
}

/// Calls the functions of a technique.
pub(super) fn check(input: &mut Input<'_>, index: usize) {
    let t = &TECHNIQUES[index];
    let call = input.below(6);
    let n = COUNTS[input.below(COUNTS.len())];
    // the pointer that is null, if any
    let null_at = input.below(64);
    let absent = u16::from(input.byte()) << 8 | u16::from(input.byte());
    let mut light: Vec<f32> = (0..t.light).map(|_| input.number()).collect();
    let unit_at = unit_at(t.name);
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
                let mut is_null = false;
                match null_at {
                    3..6 => (p_in[null_at - 3], is_null) = (null(), true),
                    6..9 => (n_in[null_at - 6], is_null) = (null(), t.on_surface),
                    9..33 => (light_in[null_at - 9], is_null) = (null(), null_at - 9 < t.light),
                    _ => (),
                }
                let views = Views { lights: light_in.as_ptr(), p: p_in.as_ptr(), n: n_in.as_ptr() };
                let [u_null, w_null] = [1..3, 1..4].map(|own| is_null || own.contains(&null_at));
                let function = input.below(4);
                let (is_null, status, written) = match function {
                    0 => (u_null, (t.sample_each)(&views, n, u_in.as_ptr(), &columns), FIELDS),
                    1 => (w_null, (t.hit_each)(&views, n, w_in.as_ptr(), &columns), FIELDS),
                    2 => (w_null, (t.invert_each)(&views, n, w_in.as_ptr(), outputs.as_ptr()), 2),
                    _ => (w_null || widths[0] == 0, (t.pdf_each)(&views, n, w_in.as_ptr(), outputs[0]), 1),
                };
                assert_eq!(status, expected(n, is_null));
                memory.only(if status == EtendueStatus::Ok { &widths[..written] } else { &[] });
                for i in 0..if is_null { 0 } else { n } {
                    let light: [f32; LIGHT] = std::array::from_fn(|k| lights[k][i]);
                    let [p, normal] = [&points, &normals].map(|c| [c[0][i], c[1][i], c[2][i]]);
                    let (u, w) = ([u[0][i], u[1][i]], [w[0][i], w[1][i], w[2][i]]);
                    let mut sampler = [0.0; SAMPLER];
                    (t.prepare)(light.as_ptr(), p.as_ptr(), normal.as_ptr(), sampler.as_mut_ptr());
                    let mut few = [0.0; 2];
                    match function {
                        0 => (t.once)(light.as_ptr(), p.as_ptr(), normal.as_ptr(), u.as_ptr(), &mut one),
                        1 => (t.hit)(sampler.as_ptr(), w.as_ptr(), &mut one),
                        2 => (t.invert)(sampler.as_ptr(), w.as_ptr(), few.as_mut_ptr()),
                        _ => {
                            few[0] = (t.pdf)(sampler.as_ptr(), w.as_ptr());
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
