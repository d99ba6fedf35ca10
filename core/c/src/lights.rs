//! Sets of lights of any kind, on the heap.

use crate::environment::{EtendueImageEnvironment, owned};
use crate::memory::{refuse_null, refuse_outside};
use crate::status::EtendueStatus;
use alloc::boxed::Box;
use alloc::vec::Vec;
use core::ffi::c_void;
use core::mem::{align_of, needs_drop, size_of};
use core::slice::from_raw_parts;
use etendue::light::{self, ConstantEnvironment};
use etendue::lights::{Emitter, Lights, LightsAt, LightsSample, Receiver, Side, Which};

/// Returns [`EtendueStatus::Value`] from a library without sets.
macro_rules! refuse_absent {
    () => {
        if !cfg!(feature = "lights") {
            return EtendueStatus::Value;
        }
    };
}
/// The kinds of lights in the order of the core's list, and those without technique.
macro_rules! kinds {
    ($(
        $(#[$doc:meta])* $light:ident $([$corners:literal])? = $light_c:ident, $columns:ident { $($fields:tt)* } by $default:literal { $($techniques:tt)+ }
    )+) => {
        /// The kind of a light of a set: the name of its struct without Etendue.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(C)]
        pub enum EtendueLightKind {
            $($(#[$doc])* $light,)+
            /// A sky of the same radiance in all directions, which has no struct.
            ConstantEnvironment,
            /// A sky as an image tells it; the set copies its table.
            ImageEnvironment,
        }
        /// So many lights of a kind in a row, as one.
        unsafe fn group(kind: u32, lights: *const c_void, count: usize) -> Option<Emitter<f32>> {
            $(if kind == EtendueLightKind::$light as u32 {
                // both structs have the same fields
                let lights = lights.cast::<light::$light<f32 $(, $corners)?>>();
                // SAFETY: the caller's pointer is to so many of them
                return Some(Emitter::group((0..count).map(|i| unsafe { lights.add(i).read() })));
            })+
            if kind == EtendueLightKind::ConstantEnvironment as u32 {
                return (count == 1).then(|| ConstantEnvironment.into());
            }
            let is_image = kind == EtendueLightKind::ImageEnvironment as u32 && count == 1;
            // SAFETY: the caller's pointer is to one
            if is_image { unsafe { owned(&*lights.cast::<EtendueImageEnvironment>()) }.map(Emitter::from) } else { None }
        }
    };
}
etendue::techniques!(kinds! {});

/// A light of a set.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueEmitter {
    /// The struct of its kind, or so many of them in a row as it has parts; NULL for a sky without a struct, and for no parts.
    pub light: *const c_void,
    /// Number of its parts: 1, or for one light of several, such as the triangles of a mesh, how many there are.
    pub parts: usize,
    /// One of EtendueLightKind.
    pub kind: u32,
    /// 1 if it emits from both sides (a sphere, inwards too), 0 if from that of its normal.
    pub two_sided: u32,
    /// A vector to the side from which a flat light emits, whatever the order of its vertices is; 0 for that of its own normal.
    pub facing: [f32; 3],
    /// Its radiance in any unit that all share; of point and spot lights their intensity, of directional lights the irradiance on a surface that faces
    /// them, of lines the radiance times the width, of images the mean over all directions. One that is not positive makes the light dark.
    pub radiance: f32,
}

/// A light of a set, or a part of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(C)]
pub struct EtendueWhich {
    /// The index of the light among those that the set was given.
    pub light: u32,
    /// The index of the part in it; 0 of lights of one part.
    pub part: u32,
}

/// From which sides a receiver gathers light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub enum EtendueSide {
    /// From above a surface, on the side of its normal.
    Surface = 0,
    /// From both sides of a surface, such as a leaf or glass.
    Both = 1,
    /// From all around: a point of fog, or of hair.
    None = 2,
}

/// What is lit.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueReceiver {
    /// The point, in the coordinates of the scene.
    pub p: [f32; 3],
    /// The unit normal of the surface there, if it gathers light from one side.
    pub n: [f32; 3],
    /// One of EtendueSide.
    pub side: u32,
    /// The light, or its part, on which the point is, which is passed over: `which` of the sample or hit that it came from. NULL if on none. Lights on whose
    /// surface the point is, to within the rounding of its own computation, are passed over anyway.
    pub on: *const EtendueWhich,
}

/// A sample of a set of lights.
///
/// The estimator of reflected radiance is f L cos(theta) weight, with the radiance L of the light `which`, once a shadow ray along `direction` has got
/// as far as `reach`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueLightsSample {
    /// The light.
    pub which: EtendueWhich,
    /// Unit direction from the receiver to it.
    pub direction: [f32; 3],
    /// Distance along it, in the unit of the coordinates; FLT_MAX of lights at infinity.
    pub distance: f32,
    /// The point of the light.
    pub point: [f32; 3],
    /// How far that point is at most from the surface of the light, or from the plane of a flat one, through rounding.
    pub bound: f32,
    /// Unit normal there, on the side that emits; of lights without a surface, the direction back.
    pub normal: [f32; 3],
    /// Probability of the light times the density of the direction, per steradian; of point, spot and directional lights the probability alone;
    /// 0 where there is no sample.
    pub pdf: f32,
    /// The probability of the light, which is a factor of `pdf`.
    pub pmf: f32,
    /// What the radiance is to be multiplied by: 1, of a point light 1/distance², of a spot light that times its falloff; 0 where the light does not
    /// emit towards the receiver.
    pub factor: f32,
    /// factor/pdf; 0 where there is no sample. Always finite.
    pub weight: f32,
    /// How far a shadow ray along `direction` must get: the distance, less what rounding may take from it.
    pub reach: f32,
    /// 1 where no other technique can hit the light, so that its weight in multiple importance sampling is 1, else 0.
    pub delta: u8,
}

/// A set of lights on the heap. Any number of threads may use it.
#[derive(Debug)]
pub struct EtendueLights(Lights<f32>);

/// A set prepared for a receiver: memory of the caller, whose inside does not concern it, for one thread. It remembers the light that was sampled last, so that
/// its pdf needs no second preparation.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueLightsAt {
    data: [u64; 269],
}
const _: () = assert!(
    size_of::<LightsAt<'_, f32>>() <= size_of::<EtendueLightsAt>()
        && align_of::<LightsAt<'_, f32>>() <= align_of::<EtendueLightsAt>()
        && !needs_drop::<LightsAt<'_, f32>>()
);

/// Makes a set of lights on the heap, of copies of `emitters`, and writes where it is. [`etendue_lights_free`] frees it.
///
/// Returns ETENDUE_STATUS_VALUE for a `kind` or a `two_sided` that is none, for a sky of other than one part, for an image that cannot be looked into, and if
/// this library was built without sets; ETENDUE_STATUS_COUNT for more than 2^27 parts. The program ends where there is no memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_lights_create(
    count: usize,
    emitters: *const EtendueEmitter,
    lights: *mut *mut EtendueLights,
) -> EtendueStatus {
    refuse_absent!();
    refuse_null!(lights);
    if count > 0 {
        refuse_null!(emitters);
    }
    let mut given = Vec::new();
    // SAFETY: the pointers are not null, and point to what the header says
    unsafe {
        for emitter in if count == 0 { &[] } else { from_raw_parts(emitters, count) } {
            let EtendueEmitter { light, parts, kind, two_sided, facing, radiance } = *emitter;
            if light.is_null() && parts > 0 && kind != EtendueLightKind::ConstantEnvironment as u32 {
                return EtendueStatus::NullPointer;
            }
            // before anything is copied
            if parts > etendue::select::LightTree::MOST {
                return EtendueStatus::Count;
            }
            let Some(group) = group(kind, light, parts).filter(|_| two_sided < 2) else { return EtendueStatus::Value };
            let group = if facing == [0.0; 3] { group } else { group.facing(facing.into()) };
            given.push((if two_sided == 1 { group.two_sided() } else { group }, radiance));
        }
        let Ok(set) = Lights::new(given) else { return EtendueStatus::Count };
        lights.write(Box::into_raw(Box::new(EtendueLights(set))));
    }
    EtendueStatus::Ok
}
/// Frees a set; NULL is none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_lights_free(lights: *mut EtendueLights) {
    if cfg!(feature = "lights") && !lights.is_null() {
        // SAFETY: it is from `etendue_lights_create`, and the caller uses it no more
        drop(unsafe { Box::from_raw(lights) });
    }
}
/// Prepares a set for a receiver; the set must live as long as `at` is used. Returns ETENDUE_STATUS_VALUE for a `side` that is none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_lights_at(
    lights: *const EtendueLights,
    receiver: *const EtendueReceiver,
    at: *mut EtendueLightsAt,
) -> EtendueStatus {
    refuse_absent!();
    refuse_null!(lights, receiver, at);
    // SAFETY: the pointers are not null, and point to what the header says; `at` has room for what needs no drop
    unsafe {
        let EtendueReceiver { p, n, side, on } = *receiver;
        let side = match side {
            0 => Side::Surface(n.into()),
            1 => Side::Both,
            2 => Side::None,
            _ => return EtendueStatus::Value,
        };
        let on = on.as_ref().map(|&EtendueWhich { light, part }| Which { light, part });
        at.cast::<LightsAt<'_, f32>>().write((*lights).0.at(Receiver { point: p.into(), side, on }));
    }
    EtendueStatus::Ok
}
/// Chooses a light and samples it by three numbers: the first one chooses the light, the others a direction to it. Returns ETENDUE_STATUS_VALUE for a number
/// that is not in [0, 1).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_lights_sample(
    at: *mut EtendueLightsAt,
    u: *const f32,
    out: *mut EtendueLightsSample,
) -> EtendueStatus {
    refuse_absent!();
    refuse_null!(at, u, out);
    refuse_outside!(u, 3);
    // SAFETY: the pointers are not null, and `etendue_lights_at` wrote `at`, for one thread
    unsafe {
        let sample = (*at.cast::<LightsAt<'_, f32>>()).sample(u.cast::<[f32; 3]>().read());
        let LightsSample { which, direction, distance, point, bound, normal, pdf, pmf, factor, delta } = sample;
        out.write(EtendueLightsSample {
            which: EtendueWhich { light: which.light, part: which.part },
            direction: direction.to_array(),
            distance,
            point: point.to_array(),
            bound,
            normal: normal.to_array(),
            pdf,
            pmf,
            factor,
            weight: sample.weight(),
            reach: sample.reach(),
            delta: delta.into(),
        });
    }
    EtendueStatus::Ok
}
/// The pdf with which [`etendue_lights_sample`] draws a unit direction `w` as one of the light `which`: 0 where the light is not there, where no other technique
/// can hit it, of the light that the receiver is on, and where the function cannot work.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn etendue_lights_pdf(at: *mut EtendueLightsAt, which: EtendueWhich, w: *const f32) -> f32 {
    if !cfg!(feature = "lights") || at.is_null() || w.is_null() {
        return 0.0;
    }
    let EtendueWhich { light, part } = which;
    // SAFETY: the pointers are not null, and `etendue_lights_at` wrote `at`, for one thread
    unsafe { (*at.cast::<LightsAt<'_, f32>>()).pdf(Which { light, part }, w.cast::<[f32; 3]>().read().into()) }
}

/// The memory of the C library, in a build without std.
#[cfg(panic = "abort")]
mod heap {
    use core::alloc::{GlobalAlloc, Layout};
    use core::ffi::c_void;

    unsafe extern "C" {
        fn malloc(size: usize) -> *mut c_void;
        fn realloc(memory: *mut c_void, size: usize) -> *mut c_void;
        fn free(memory: *mut c_void);
        fn abort() -> !;
    }
    /// What is there; without it the program ends.
    fn some(memory: *mut c_void) -> *mut u8 {
        if memory.is_null() {
            // SAFETY: it may be called at any time
            unsafe { abort() }
        }
        memory.cast()
    }

    struct Heap;
    // SAFETY: malloc's memory is aligned for two words, and nothing in a set has a greater alignment: else the program ends
    unsafe impl GlobalAlloc for Heap {
        unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
            let is_aligned = layout.align() <= 2 * size_of::<usize>();
            // SAFETY: the caller's layout has a size
            some(if is_aligned { unsafe { malloc(layout.size()) } } else { core::ptr::null_mut() })
        }
        unsafe fn dealloc(&self, memory: *mut u8, _: Layout) {
            // SAFETY: it is malloc's
            unsafe { free(memory.cast()) }
        }
        unsafe fn realloc(&self, memory: *mut u8, _: Layout, size: usize) -> *mut u8 {
            // SAFETY: it is malloc's, and the caller's size is not 0
            some(unsafe { realloc(memory.cast(), size) })
        }
    }
    #[global_allocator]
    static HEAP: Heap = Heap;
}
