//! The functions of one technique, one warp, and so on, by raw pointers. What they are given has the type of the technique, which is not told:
//! a table holds those of all.

use crate::columns::{ChoiceColumns, Counters, EvaluationColumns, OneSample, SampleColumns};
use crate::kernel::{self, Views};
use crate::map::{MOST_NUMBERS, MOST_RESULTS};
use crate::memory::TreeMemory;
use crate::one;
use crate::packet::Packet;
use crate::technique::{Prepared, Technique};
use core::ffi::c_void;
use etendue::listed::warp::ListedWarp as BatchWarp;
use etendue::reflection::Reflection;
use etendue::{Vec2, Vec3};

type Column = *const f32;

/// The functions of a prepared light. The first argument is to [`Prepared`], columns are of as many elements as the batch has, and pointers
/// to numbers are to as many in a row as they have.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct SamplerFunctions {
    /// See [`Batch::sample_one`](crate::Batch::sample_one).
    pub one_sample: unsafe extern "C" fn(*const c_void, *const f32, *mut OneSample),
    /// See [`Batch::pdf_one`](crate::Batch::pdf_one).
    pub one_pdf: unsafe extern "C" fn(*const c_void, *const f32) -> f32,
    /// See [`Batch::invert_one`](crate::Batch::invert_one).
    pub one_invert: unsafe extern "C" fn(*const c_void, *const f32, *mut f32),
    /// See [`Batch::hit_one`](crate::Batch::hit_one).
    pub one_hit: unsafe extern "C" fn(*const c_void, *const f32, *mut OneSample),
    /// See [`Batch::sample`](crate::Batch::sample).
    pub sample: unsafe extern "C" fn(*const c_void, usize, Vec2<Column>, &SampleColumns),
    /// See [`Batch::pdf`](crate::Batch::pdf).
    pub pdf: unsafe extern "C" fn(*const c_void, usize, Vec3<Column>, *mut f32),
    /// See [`Batch::invert`](crate::Batch::invert).
    pub invert: unsafe extern "C" fn(*const c_void, usize, Vec3<Column>, Vec2<*mut f32>),
    /// See [`Batch::hit`](crate::Batch::hit).
    pub hit: unsafe extern "C" fn(*const c_void, usize, Vec3<Column>, &SampleColumns),
}
impl SamplerFunctions {
    const fn of<P: Prepared, R: Packet>() -> Self {
        Self {
            one_sample: one::one_sample::<P>,
            one_pdf: one::one_pdf::<P>,
            one_invert: one::one_invert::<P>,
            one_hit: one::one_hit::<P>,
            sample: kernel::sample::<P, R>,
            pdf: kernel::pdf::<P, R>,
            invert: kernel::invert::<P, R>,
            hit: kernel::hit::<P, R>,
        }
    }
}

/// The functions of a technique. Lights, what they are prepared for beside the point, and prepared lights are those of [`Technique`] over
/// numbers; in [`Views`], over columns.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct TechniqueFunctions {
    /// See [`Batch::prepare`](crate::Batch::prepare): a light, the point, what else it is prepared for, and room for the prepared light.
    pub prepare: unsafe extern "C" fn(*const c_void, *const f32, *const c_void, *mut c_void),
    /// See [`Batch::sample_each`](crate::Batch::sample_each).
    pub sample_each: unsafe extern "C" fn(&Views, usize, Vec2<Column>, &SampleColumns),
    /// See [`Batch::evaluate_each`](crate::Batch::evaluate_each).
    pub evaluate_each: unsafe extern "C" fn(&Views, usize, Vec3<Column>, &EvaluationColumns),
    /// Those of the prepared light.
    pub sampler: SamplerFunctions,
}
impl TechniqueFunctions {
    pub(crate) const fn of<T: Technique, R: Packet>() -> Self {
        Self {
            prepare: one::prepare::<T>,
            sample_each: kernel::sample_each::<T, R>,
            evaluate_each: kernel::evaluate_each::<T, R>,
            sampler: SamplerFunctions::of::<T::Prepared, R>(),
        }
    }
}

/// The functions of a warp, which is the first argument.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct WarpFunctions {
    /// See [`Batch::warp_one`](crate::Batch::warp_one).
    pub one_sample: unsafe extern "C" fn(*const c_void, *const f32, *mut f32),
    /// See [`Batch::warp_pdf_one`](crate::Batch::warp_pdf_one).
    pub one_pdf: unsafe extern "C" fn(*const c_void, *const f32) -> f32,
    /// See [`Batch::warp_invert_one`](crate::Batch::warp_invert_one).
    pub one_invert: unsafe extern "C" fn(*const c_void, *const f32, *mut f32),
    /// See [`Batch::warp`](crate::Batch::warp).
    pub sample: unsafe extern "C" fn(*const c_void, usize, Vec2<Column>, &[*mut f32; 3]),
    /// See [`Batch::warp_pdf`](crate::Batch::warp_pdf).
    pub pdf: unsafe extern "C" fn(*const c_void, usize, &[Column; 3], *mut f32),
    /// See [`Batch::warp_invert`](crate::Batch::warp_invert).
    pub invert: unsafe extern "C" fn(*const c_void, usize, &[Column; 3], Vec2<*mut f32>),
    /// How many coordinates a point has.
    pub coordinates: usize,
}
impl WarpFunctions {
    pub(crate) const fn of<W: BatchWarp, R: Packet>() -> Self {
        Self {
            one_sample: one::one_warp_sample::<W>,
            one_pdf: one::one_warp_pdf::<W>,
            one_invert: one::one_warp_invert::<W>,
            sample: kernel::warp_sample::<W, R>,
            pdf: kernel::warp_pdf::<W, R>,
            invert: kernel::warp_invert::<W, R>,
            coordinates: W::ENTRY.coordinates,
        }
    }
}

/// See [`Batch::map`](crate::Batch::map): the map, and as many columns as it has numbers and results, and whether they hold.
pub type MapFunction =
    unsafe extern "C" fn(*const c_void, usize, &[Column; MOST_NUMBERS], &[*mut f32; MOST_RESULTS], *mut u8);

/// See [`Batch::pairs`](crate::Batch::pairs): the sequence, and two columns.
pub type SequenceFunction = unsafe extern "C" fn(*const c_void, usize, &Counters, Vec2<*mut f32>);

/// See [`Batch::reflections`](crate::Batch::reflections): roughnesses, normals, views, and where the reflections go.
pub type ReflectionsFunction = unsafe extern "C" fn(usize, Column, Vec3<Column>, Vec3<Column>, &Reflection<*mut f32>);

/// The functions of a tree of lights.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct TreeFunctions {
    /// See [`Batch::choose`](crate::Batch::choose).
    pub choose: unsafe extern "C" fn(&TreeMemory<'_>, usize, Vec3<Column>, Vec3<Column>, Column, &ChoiceColumns),
    /// See [`Batch::pmf`](crate::Batch::pmf).
    pub pmf: unsafe extern "C" fn(&TreeMemory<'_>, usize, Vec3<Column>, Vec3<Column>, *const u32, *mut f32),
}
impl TreeFunctions {
    pub(crate) const fn of<R: Packet>() -> Self {
        Self { choose: kernel::choose::<R>, pmf: kernel::pmf::<R> }
    }
}
