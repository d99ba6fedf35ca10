//! One element at a time, in single numbers: a packet of which one lane is wanted takes as long as all of its lanes.
//!
//! The functions are compiled for the levels of single numbers: x86-64-v4 would compile them to the instructions of x86-64-v3 again.

use crate::table::Lanes;
use crate::technique::{BatchSampler, BatchTechnique};
use crate::warp::BatchWarp;
use core::mem::MaybeUninit;
use etendue::{LightSample, LightSampler, Real, Vec2, Vec3};

/// One sample of a light, or the point of a light that a direction hits, in single numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct OneSample {
    /// Unit direction from the shading point to the light.
    pub direction: Vec3<f32>,
    /// Distance to the light along it, in the unit of the coordinates.
    pub distance: f32,
    /// Probability density of the direction, per steradian (lines: see [`etendue::Line`]); 0 where there is no sample.
    pub pdf: f32,
    /// 1/pdf where there is a sample and the light emits towards the shading point, 0 elsewhere.
    pub weight: f32,
    /// Unit normal of the light at the sampled point. Not meaningful where the pdf is 0.
    pub normal: Vec3<f32>,
    /// Surface coordinates of the sampled point in [0, 1]². Not meaningful where the pdf is 0.
    pub uv: Vec2<f32>,
    /// 1 where the shading point is on the side of the light that emits, else 0.
    pub emits: u8,
}

impl OneSample {
    #[inline(always)]
    fn new(s: &LightSample<f32>) -> Self {
        let LightSample { direction, distance, pdf, normal, uv, emits, .. } = *s;
        Self { direction, distance, pdf, weight: s.weight(), normal, uv, emits: u8::from(emits) }
    }
}

/// The functions of a prepared light for one element: pointers are to numbers in a row that they read, and to what they write.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct OneFunctions<T: BatchSampler> {
    /// See [`Batch::sample_one`](crate::Batch::sample_one).
    pub sample: unsafe extern "C" fn(&T, *const f32, *mut OneSample),
    /// See [`Batch::pdf_one`](crate::Batch::pdf_one).
    pub pdf: unsafe extern "C" fn(&T, *const f32) -> f32,
    /// See [`Batch::invert_one`](crate::Batch::invert_one).
    pub invert: unsafe extern "C" fn(&T, *const f32, *mut f32),
    /// See [`Batch::hit_one`](crate::Batch::hit_one).
    pub hit: unsafe extern "C" fn(&T, *const f32, *mut OneSample),
}

/// The functions of a light's technique for one element, which prepare the light for a point of a surface with a normal. Techniques that need
/// no normal do not read it.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct OnceFunctions<T: BatchTechnique> {
    /// See [`Batch::prepare`](crate::Batch::prepare).
    pub prepare: unsafe extern "C" fn(&T::Light<f32>, Vec3<f32>, Vec3<f32>, *mut T),
    /// See [`Batch::sample_once`](crate::Batch::sample_once).
    pub sample: unsafe extern "C" fn(&T::Light<f32>, *const f32, *const f32, *const f32, *mut OneSample),
    /// See [`Batch::pdf_once`](crate::Batch::pdf_once).
    pub pdf: unsafe extern "C" fn(&T::Light<f32>, *const f32, *const f32, *const f32) -> f32,
    /// See [`Batch::pdf_of_hit_once`](crate::Batch::pdf_of_hit_once).
    pub pdf_of_hit: unsafe extern "C" fn(&T::Light<f32>, *const f32, *const f32, *const f32) -> f32,
}

/// The functions of a warp for one element. They read and write as many numbers in a row as the warp has numbers and coordinates.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct OneWarpFunctions<W: BatchWarp> {
    /// See [`Batch::warp_one`](crate::Batch::warp_one).
    pub sample: unsafe extern "C" fn(&W, *const f32, *mut f32),
    /// See [`Batch::warp_pdf_one`](crate::Batch::warp_pdf_one).
    pub pdf: unsafe extern "C" fn(&W, *const f32) -> f32,
    /// See [`Batch::warp_invert_one`](crate::Batch::warp_invert_one).
    pub invert: unsafe extern "C" fn(&W, *const f32, *mut f32),
}

/// True in a compilation whose functions of one element nobody asks for: they do nothing there.
const IS_ABSENT: bool = cfg!(feature = "level-v4");
/// True where a multiply-add is so long in code and time that whatever is there already is called.
const IS_LONG: bool = <Lanes as Real>::LANES == 1;

impl<T: BatchSampler> OneFunctions<T> {
    pub(crate) const fn of_this_build() -> Self {
        Self { sample, pdf, invert, hit }
    }
}
impl<T: BatchTechnique> OnceFunctions<T> {
    pub(crate) const fn of_this_build() -> Self {
        Self { prepare, sample: sample_once::<T>, pdf: pdf_once::<T>, pdf_of_hit: pdf_of_hit_once::<T> }
    }
}
impl<W: BatchWarp> OneWarpFunctions<W> {
    pub(crate) const fn of_this_build() -> Self {
        Self { sample: warp_sample, pdf: warp_pdf, invert: warp_invert }
    }
}

/// A struct of numbers, read one by one: a processor waits some 100 cycles for a pair of which the host has just written each number alone, and
/// without `volatile` the compiler reads pairs. What holds pointers is read as it is.
#[inline(always)]
unsafe fn numbers<T: Copy>(from: &T) -> T {
    if align_of::<T>() != align_of::<f32>() {
        return *from;
    }
    let (from, mut to) = (core::ptr::from_ref(from).cast::<u32>(), MaybeUninit::<T>::uninit());
    for i in 0..size_of::<T>() / size_of::<f32>() {
        // SAFETY: the struct consists of numbers, of which each is written
        unsafe { to.as_mut_ptr().cast::<u32>().add(i).write(from.add(i).read_volatile()) };
    }
    // SAFETY: as above
    unsafe { to.assume_init() }
}
unsafe fn two(x: *const f32) -> Vec2<f32> {
    // SAFETY: the caller's memory has them
    unsafe { numbers(&*x.cast::<Vec2<f32>>()) }
}
unsafe fn three(x: *const f32) -> Vec3<f32> {
    // SAFETY: the caller's memory has them
    unsafe { numbers(&*x.cast::<Vec3<f32>>()) }
}
unsafe fn write<const N: usize>(to: *mut f32, numbers: [f32; N], count: usize) {
    for (i, number) in numbers.into_iter().enumerate().take(count) {
        // SAFETY: the caller's memory has room for them
        unsafe { to.add(i).write_unaligned(number) };
    }
}

pub(crate) unsafe extern "C" fn sample<T: BatchSampler>(sampler: &T, u: *const f32, out: *mut OneSample) {
    if !IS_ABSENT {
        // SAFETY: the caller's
        unsafe { out.write(OneSample::new(&sampler.splat::<f32>().sample(two(u)))) };
    }
}
pub(crate) unsafe extern "C" fn pdf<T: BatchSampler>(sampler: &T, w: *const f32) -> f32 {
    // SAFETY: the caller's
    if IS_ABSENT { 0.0 } else { unsafe { sampler.splat::<f32>().pdf(three(w)) } }
}
pub(crate) unsafe extern "C" fn invert<T: BatchSampler>(sampler: &T, w: *const f32, out: *mut f32) {
    if !IS_ABSENT {
        // SAFETY: the caller's
        unsafe {
            let u = sampler.splat::<f32>().invert(three(w));
            write(out, [u.x, u.y], 2);
        }
    }
}
pub(crate) unsafe extern "C" fn hit<T: BatchSampler>(sampler: &T, w: *const f32, out: *mut OneSample) {
    if !IS_ABSENT {
        // SAFETY: the caller's
        unsafe { out.write(OneSample::new(&sampler.splat::<f32>().hit(three(w)))) };
    }
}

pub(crate) unsafe extern "C" fn prepare<T: BatchTechnique>(
    light: &T::Light<f32>,
    p: Vec3<f32>,
    n: Vec3<f32>,
    out: *mut T,
) {
    if !IS_ABSENT {
        // SAFETY: the caller's memory has room for it
        unsafe { out.write(T::prepared(*light, p, n)) };
    }
}
unsafe fn prepared<T: BatchTechnique>(light: &T::Light<f32>, p: *const f32, n: *const f32) -> T {
    let mut sampler = MaybeUninit::uninit();
    // SAFETY: the caller's; the function writes a sampler
    unsafe {
        prepare(light, three(p), if T::ON_SURFACE { three(n) } else { Vec3::default() }, sampler.as_mut_ptr());
        sampler.assume_init()
    }
}
/// Prepares what the result needs, since all of it is in one function.
#[inline(always)]
unsafe fn place<T: BatchTechnique>(light: &T::Light<f32>, p: *const f32, n: *const f32) -> T::Of<f32> {
    // SAFETY: the caller's
    unsafe { T::prepare::<f32>(numbers(light), three(p), if T::ON_SURFACE { three(n) } else { Vec3::default() }) }
}
unsafe extern "C" fn sample_once<T: BatchTechnique>(
    light: &T::Light<f32>,
    p: *const f32,
    n: *const f32,
    u: *const f32,
    out: *mut OneSample,
) {
    if IS_LONG {
        // SAFETY: the caller's
        unsafe { sample(&prepared::<T>(light, p, n), u, out) };
    } else if !IS_ABSENT {
        // SAFETY: the caller's
        unsafe { out.write(OneSample::new(&place::<T>(light, p, n).sample(two(u)))) };
    }
}
unsafe extern "C" fn pdf_once<T: BatchTechnique>(
    light: &T::Light<f32>,
    p: *const f32,
    n: *const f32,
    w: *const f32,
) -> f32 {
    if IS_LONG {
        // SAFETY: the caller's
        unsafe { pdf(&prepared::<T>(light, p, n), w) }
    } else if IS_ABSENT {
        0.0
    } else {
        // SAFETY: the caller's
        unsafe { place::<T>(light, p, n).pdf(three(w)) }
    }
}
unsafe extern "C" fn pdf_of_hit_once<T: BatchTechnique>(
    light: &T::Light<f32>,
    p: *const f32,
    n: *const f32,
    w: *const f32,
) -> f32 {
    if IS_LONG {
        // SAFETY: the caller's
        unsafe { prepared::<T>(light, p, n).splat::<f32>().pdf_of_hit(three(w)) }
    } else if IS_ABSENT {
        0.0
    } else {
        // SAFETY: the caller's
        unsafe { place::<T>(light, p, n).pdf_of_hit(three(w)) }
    }
}

/// The point of a warp at numbers in a row.
unsafe fn point<W: BatchWarp>(numbers: *const f32) -> [f32; 3] {
    // SAFETY: the caller's memory has as many numbers as a point has coordinates
    core::array::from_fn(|k| if k < W::COORDINATES { unsafe { numbers.add(k).read_unaligned() } } else { 0.0 })
}
unsafe extern "C" fn warp_sample<W: BatchWarp>(warp: &W, u: *const f32, out: *mut f32) {
    if !IS_ABSENT {
        // SAFETY: the caller's
        unsafe {
            let x = u.read_unaligned();
            let y = if W::NUMBERS == 2 { u.add(1).read_unaligned() } else { x };
            write(out, W::sample(&numbers(warp).splat::<f32>(), Vec2::new(x, y)), W::COORDINATES);
        }
    }
}
unsafe extern "C" fn warp_pdf<W: BatchWarp>(warp: &W, at: *const f32) -> f32 {
    // SAFETY: the caller's
    if IS_ABSENT { 0.0 } else { unsafe { W::pdf(&numbers(warp).splat::<f32>(), point::<W>(at)) } }
}
unsafe extern "C" fn warp_invert<W: BatchWarp>(warp: &W, at: *const f32, out: *mut f32) {
    if !IS_ABSENT {
        // SAFETY: the caller's
        unsafe {
            let u = W::invert(&numbers(warp).splat::<f32>(), point::<W>(at));
            write(out, [u.x, u.y], W::NUMBERS);
        }
    }
}
