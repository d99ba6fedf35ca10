//! The functions of one element, in single numbers: a packet of which one lane is wanted takes as long as all of its lanes.
//!
//! What they are given has no type, so that those of all techniques are in one table.

use crate::columns::OneSample;
use crate::packet::IS_LONG;
use crate::technique::{Prepared, Technique};
use core::ffi::c_void;
use core::mem::MaybeUninit;
use etendue::listed::warp::{Coordinates, ListedWarp as BatchWarp};
use etendue::{LightSampler, Vec2, Warp};

/// True in the compilation whose functions of one element and preparations nobody asks for: they do nothing there. x86-64-v4 would compile
/// them to the instructions of x86-64-v3 again.
const IS_V4: bool = cfg!(feature = "level-v4");
/// True where nobody asks for the functions of one element: they do nothing there.
const IS_ABSENT: bool = IS_V4 || !cfg!(feature = "one") && !IS_LONG;

/// What a pointer without a type is to.
#[inline(always)]
pub(crate) unsafe fn typed<'a, T>(pointer: *const c_void) -> &'a T {
    // SAFETY: the caller's
    unsafe { &*pointer.cast() }
}
/// A struct of numbers, read one by one: a processor waits some 100 cycles for a pair of which the host has just written each number alone, and
/// without `volatile` the compiler reads pairs. What holds pointers is read as it is.
#[inline(always)]
unsafe fn figures<T: Copy>(from: *const T) -> T {
    if align_of::<T>() != align_of::<f32>() {
        // SAFETY: the caller's
        return unsafe { from.read() };
    }
    let (from, mut to) = (from.cast::<u32>(), MaybeUninit::<T>::uninit());
    for i in 0..size_of::<T>() / size_of::<f32>() {
        // SAFETY: the struct consists of numbers, of which each is written
        unsafe { to.as_mut_ptr().cast::<u32>().add(i).write(from.add(i).read_volatile()) };
    }
    // SAFETY: as above
    unsafe { to.assume_init() }
}
unsafe fn write<const N: usize>(to: *mut f32, numbers: [f32; N], count: usize) {
    for (i, number) in numbers.into_iter().enumerate().take(count) {
        // SAFETY: the caller's memory has room for them
        unsafe { to.add(i).write_unaligned(number) };
    }
}

/// One sample of a prepared light.
pub(crate) unsafe extern "C" fn one_sample<P: Prepared>(sampler: *const c_void, u: *const f32, out: *mut OneSample) {
    if !IS_ABSENT {
        // SAFETY: the caller's
        unsafe { typed::<P>(sampler).over::<f32, _>(|s| out.write(OneSample::new(&s.sample(figures(u.cast()))))) };
    }
}
/// The pdf of one direction.
pub(crate) unsafe extern "C" fn one_pdf<P: Prepared>(sampler: *const c_void, w: *const f32) -> f32 {
    // SAFETY: the caller's
    if IS_ABSENT { 0.0 } else { unsafe { typed::<P>(sampler).over::<f32, _>(|s| s.pdf(figures(w.cast()))) } }
}
/// The random numbers of one direction.
pub(crate) unsafe extern "C" fn one_invert<P: Prepared>(sampler: *const c_void, w: *const f32, out: *mut f32) {
    if !IS_ABSENT {
        // SAFETY: the caller's
        unsafe {
            let u = typed::<P>(sampler).over::<f32, _>(|s| s.invert(figures(w.cast())));
            write(out, [u.x, u.y], 2);
        }
    }
}
/// Where one direction hits the light.
pub(crate) unsafe extern "C" fn one_hit<P: Prepared>(sampler: *const c_void, w: *const f32, out: *mut OneSample) {
    if !IS_ABSENT {
        // SAFETY: the caller's
        unsafe { typed::<P>(sampler).over::<f32, _>(|s| out.write(OneSample::new(&s.hit(figures(w.cast()))))) };
    }
}

/// Prepares one light for a point and what else the technique takes.
pub(crate) unsafe extern "C" fn prepare<T: Technique>(
    light: *const c_void,
    p: *const f32,
    with: *const c_void,
    out: *mut c_void,
) {
    if !IS_V4 {
        // SAFETY: the caller's memory has room for it
        unsafe {
            let (light, with) = (*typed::<T::Light<f32>>(light), figures(with.cast::<T::With<f32>>()));
            out.cast::<T::Prepared>().write(T::prepare(light, figures(p.cast()), with));
        }
    }
}
/// One point of a warp.
pub(crate) unsafe extern "C" fn one_warp_sample<W: BatchWarp>(warp: *const c_void, u: *const f32, out: *mut f32) {
    if !IS_V4 {
        // SAFETY: the caller's
        unsafe {
            let [x, y] = figures(u.cast());
            write(
                out,
                figures(warp.cast::<W>()).over::<f32>().sample(Vec2::new(x, y)).coordinates(),
                W::ENTRY.coordinates,
            );
        }
    }
}
/// A point of a warp, of its coordinates in a row.
unsafe fn point<W: BatchWarp>(numbers: *const f32) -> <W::Of<f32> as Warp<f32>>::Point {
    // SAFETY: the caller's memory has as many numbers as a point has coordinates
    let number = |k| if k < W::ENTRY.coordinates { unsafe { numbers.add(k).read_unaligned() } } else { 0.0 };
    Coordinates::from_coordinates([0, 1, 2].map(number))
}
/// The pdf of a warp at one point.
pub(crate) unsafe extern "C" fn one_warp_pdf<W: BatchWarp>(warp: *const c_void, at: *const f32) -> f32 {
    // SAFETY: the caller's
    if IS_V4 { 0.0 } else { unsafe { figures(warp.cast::<W>()).over::<f32>().pdf(point::<W>(at)) } }
}
/// The random numbers that a warp maps to one point.
pub(crate) unsafe extern "C" fn one_warp_invert<W: BatchWarp>(warp: *const c_void, at: *const f32, out: *mut f32) {
    if !IS_V4 {
        // SAFETY: the caller's
        unsafe {
            let u = figures(warp.cast::<W>()).over::<f32>().invert(point::<W>(at));
            write(out, [u.x, u.y], 2);
        }
    }
}
