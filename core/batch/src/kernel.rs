//! Loops over packets: one body for every level of instructions and every kind of light. What they are given has no type, so that those of all
//! techniques are in one table.

use crate::columns::{ChoiceColumns, Counters, EvaluationColumns, OneSample, SampleColumns, numbers, store};
use crate::map::{BatchMap, MOST_NUMBERS, MOST_RESULTS};
use crate::memory::TreeMemory;
use crate::one::{one_hit, one_invert, one_pdf, one_sample, prepare, typed};
use crate::packet::{Packet, PacketSpan, packets};
use crate::technique::{Prepared, Technique};
use core::ffi::c_void;
use core::mem::MaybeUninit;
use core::ptr::{from_ref, null_mut};
use etendue::listed::warp::{Coordinates, ListedWarp as BatchWarp};
use etendue::reflection::Reflection;
use etendue::select::LightChoice;
use etendue::sequence::Sequence;
use etendue::{LightSampler, Uint, Vec2, Vec3, Warp};

/// Prepared lights of more bytes are used by functions that several loops share, where a call takes little beside what it does.
const LARGE: usize = 256;

/// A function of a prepared light for columns, and a step of its loop over packets, which is in a function of its own where the prepared light is
/// large. Of packets of one lane, `$alone` calls the function of one element, whose code is there already.
macro_rules! prepared {
    (
        $(#[$doc:meta])* $name:ident, $step:ident, $apart:ident($input:ident: $of_input:ty, $out:ident: $of_out:ty)
        |$sampler:ident, $place:ident| $body:expr, |$one:ident, $i:ident| $alone:expr
    ) => {
        #[inline(always)]
        unsafe fn $step<'a, P: Prepared, R: Packet>(
            sampler: &P::Of<'a, R>,
            place: PacketSpan,
            input: $of_input,
            out: $of_out,
        ) {
            #[inline(never)]
            unsafe fn $apart<S: LightSampler<R>, R: Packet>(
                $sampler: &S,
                $place: PacketSpan,
                $input: $of_input,
                $out: $of_out,
            ) {
                // SAFETY: the caller's columns have an element for every lane
                unsafe { $body }
            }
            if const { size_of::<P>() > LARGE } {
                // SAFETY: the caller's
                unsafe { $apart::<P::Of<'a, R>, R>(sampler, place, input, out) };
            } else {
                let ($sampler, $place, $input, $out) = (sampler, place, input, out);
                // SAFETY: the caller's columns have an element for every lane
                unsafe { $body }
            }
        }
        $(#[$doc])*
        pub(crate) unsafe extern "C" fn $name<P: Prepared, R: Packet>(
            $one: *const c_void,
            n: usize,
            $input: $of_input,
            $out: $of_out,
        ) {
            // SAFETY: the caller's columns have `n` elements
            unsafe {
                if const { R::LANES == 1 } {
                    (0..n).for_each(|$i| $alone);
                } else {
                    typed::<P>($one).over::<R, _>(|s| {
                        packets(n, R::LANES, |place| $step::<P, R>(s, place, $input, $out));
                    });
                }
            }
        }
    };
}
prepared! {
    /// Samples of one prepared light.
    sample, sample_step, sample_apart(u: Vec2<*const f32>, out: &SampleColumns)
    |s, place| out.store_packet(place, &s.sample(u.map(|column| place.load(column)))),
    |sampler, i| {
        let mut s = OneSample::default();
        one_sample::<P>(sampler, numbers([u.x, u.y], i).as_ptr(), &mut s);
        out.store(i, &s);
    }
}
prepared! {
    /// Where directions hit the light.
    hit, hit_step, hit_apart(w: Vec3<*const f32>, out: &SampleColumns)
    |s, place| out.store_packet(place, &s.hit(w.map(|column| place.load(column)))),
    |sampler, i| {
        let mut s = OneSample::default();
        one_hit::<P>(sampler, numbers([w.x, w.y, w.z], i).as_ptr(), &mut s);
        out.store(i, &s);
    }
}
prepared! {
    /// The pdf of directions.
    pdf, pdf_step, pdf_apart(w: Vec3<*const f32>, out: *mut f32)
    |s, place| place.store(out, s.pdf(w.map(|column| place.load(column)))),
    |sampler, i| store(out, i, one_pdf::<P>(sampler, numbers([w.x, w.y, w.z], i).as_ptr()))
}
prepared! {
    /// The random numbers that the sampler maps to directions.
    invert, invert_step, invert_apart(w: Vec3<*const f32>, out: Vec2<*mut f32>)
    |s, place| {
        let u = s.invert(w.map(|column| place.load(column)));
        place.store(out.x, u.x);
        place.store(out.y, u.y);
    },
    |sampler, i| {
        let mut u = [0.0; 2];
        one_invert::<P>(sampler, numbers([w.x, w.y, w.z], i).as_ptr(), u.as_mut_ptr());
        store(out.x, i, u[0]);
        store(out.y, i, u[1]);
    }
}

/// Lights of their own for each element, as seen from points of their own.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Views {
    /// The light of a technique over columns.
    pub lights: *const c_void,
    /// The shading points.
    pub points: Vec3<*const f32>,
    /// What the technique is prepared for beside the points, over columns; null if that is nothing.
    pub with: *const c_void,
}

impl Views {
    /// Calls `f` with the lights of a packet, prepared.
    #[inline(always)]
    unsafe fn packet<T: Technique, R: Packet>(
        &self,
        place: PacketSpan,
        f: impl FnOnce(&<T::Prepared as Prepared>::Of<'_, R>),
    ) {
        // SAFETY: the caller's columns have an element for every lane
        unsafe {
            let load = |column| place.load::<R>(column);
            let light = T::map_light(*typed::<T::Light<*const f32>>(self.lights), load);
            let with = T::map_with(self.with.cast::<T::With<*const f32>>().read(), load);
            T::prepared::<R, ()>(light, self.points.map(load), with, f);
        }
    }
    /// The light of one element, prepared by the function of one light, whose code is there already.
    unsafe fn one<T: Technique>(&self, i: usize) -> T::Prepared {
        let mut sampler = MaybeUninit::<T::Prepared>::uninit();
        // SAFETY: the caller's columns have this element
        unsafe {
            let number = |column: *const f32| column.add(i).read_unaligned();
            let light = T::map_light(*typed::<T::Light<*const f32>>(self.lights), number);
            let with = T::map_with(self.with.cast::<T::With<*const f32>>().read(), number);
            let p = self.points.map(number);
            let [light, with] = [from_ref(&light).cast(), from_ref(&with).cast()];
            prepare::<T>(light, from_ref(&p).cast(), with, sampler.as_mut_ptr().cast());
            sampler.assume_init()
        }
    }
}

/// Samples of a light of its own for each element, prepared for a point of its own.
pub(crate) unsafe extern "C" fn sample_each<T: Technique, R: Packet>(
    views: &Views,
    n: usize,
    u: Vec2<*const f32>,
    out: &SampleColumns,
) {
    if !cfg!(feature = "each") {
        return;
    }
    if const { R::LANES == 1 } {
        for i in 0..n {
            // SAFETY: the caller's columns have `n` elements
            unsafe {
                let sampler = views.one::<T>(i);
                let u = u.map(|column| column.add(i));
                sample::<T::Prepared, f32>(from_ref(&sampler).cast(), 1, u, &out.from(i));
            }
        }
        return;
    }
    // SAFETY: the caller's columns have `n` elements
    packets(n, R::LANES, |place| unsafe {
        views.packet::<T, R>(place, |s| sample_step::<T::Prepared, R>(s, place, u, out));
    });
}

/// The pdf, the random numbers and the hit of a direction of its own for each element; null columns are not wanted.
pub(crate) unsafe extern "C" fn evaluate_each<T: Technique, R: Packet>(
    views: &Views,
    n: usize,
    w: Vec3<*const f32>,
    out: &EvaluationColumns,
) {
    if !cfg!(feature = "each") {
        return;
    }
    let (wants_u, wants_hit) = (!out.u.iter().all(|column| column.is_null()), out.hit.any());
    if const { R::LANES == 1 } {
        for i in 0..n {
            // SAFETY: the caller's columns have `n` elements
            unsafe {
                let (sampler, out) = (views.one::<T>(i), out.from(i));
                let (sampler, w) = (from_ref(&sampler).cast(), w.map(|column| column.add(i)));
                if !out.pdf.is_null() {
                    pdf::<T::Prepared, f32>(sampler, 1, w, out.pdf);
                }
                if wants_u {
                    invert::<T::Prepared, f32>(sampler, 1, w, Vec2::new(out.u[0], out.u[1]));
                }
                if wants_hit {
                    hit::<T::Prepared, f32>(sampler, 1, w, &out.hit);
                }
            }
        }
        return;
    }
    // SAFETY: the caller's columns have `n` elements
    packets(n, R::LANES, |place| unsafe {
        views.packet::<T, R>(place, |s| {
            // what is not wanted is not computed
            if !out.pdf.is_null() {
                pdf_step::<T::Prepared, R>(s, place, w, out.pdf);
            }
            if wants_u {
                invert_step::<T::Prepared, R>(s, place, w, Vec2::new(out.u[0], out.u[1]));
            }
            if wants_hit {
                hit_step::<T::Prepared, R>(s, place, w, &out.hit);
            }
        });
    });
}

/// Points of a warp.
pub(crate) unsafe extern "C" fn warp_sample<W: BatchWarp, R: Packet>(
    warp: *const c_void,
    n: usize,
    u: Vec2<*const f32>,
    out: &[*mut f32; 3],
) {
    // SAFETY: the caller's
    let warp = unsafe { typed::<W>(warp) }.over::<R>();
    // SAFETY: the caller's columns have `n` elements
    packets(n, R::LANES, |place| unsafe {
        let point = warp.sample(Vec2::new(place.load(u.x), place.load(u.y)));
        for (&column, value) in out.iter().zip(point.coordinates()).take(W::ENTRY.coordinates) {
            place.store(column, value);
        }
    });
}

#[inline(always)]
unsafe fn load_point<W: BatchWarp, R: Packet>(
    place: PacketSpan,
    points: &[*const f32; 3],
) -> <W::Of<R> as Warp<R>>::Point {
    // SAFETY: the caller's columns are as many as the point has coordinates
    let load = |k| if k < W::ENTRY.coordinates { unsafe { place.load(points[k]) } } else { R::lit(0.0) };
    Coordinates::from_coordinates([0, 1, 2].map(load))
}

/// The pdf of a warp at points.
pub(crate) unsafe extern "C" fn warp_pdf<W: BatchWarp, R: Packet>(
    warp: *const c_void,
    n: usize,
    points: &[*const f32; 3],
    out: *mut f32,
) {
    // SAFETY: the caller's
    let warp = unsafe { typed::<W>(warp) }.over::<R>();
    // SAFETY: the caller's columns have `n` elements
    packets(n, R::LANES, |place| unsafe { place.store(out, warp.pdf(load_point::<W, R>(place, points))) });
}

/// The random numbers that a warp maps to points.
pub(crate) unsafe extern "C" fn warp_invert<W: BatchWarp, R: Packet>(
    warp: *const c_void,
    n: usize,
    points: &[*const f32; 3],
    out: Vec2<*mut f32>,
) {
    // SAFETY: the caller's
    let warp = unsafe { typed::<W>(warp) }.over::<R>();
    // SAFETY: the caller's columns have `n` elements
    packets(n, R::LANES, |place| unsafe {
        let u = warp.invert(load_point::<W, R>(place, points));
        place.store(out.x, u.x);
        place.store(out.y, u.y);
    });
}

/// Reflections of surfaces of their own; null columns of their numbers are not wanted.
pub(crate) unsafe extern "C" fn reflections<R: Packet>(
    n: usize,
    alphas: *const f32,
    normals: Vec3<*const f32>,
    views: Vec3<*const f32>,
    out: &Reflection<*mut f32>,
) {
    let mut columns = [null_mut(); size_of::<Reflection<f32>>() / size_of::<f32>()];
    let mut to = columns.iter_mut();
    out.map(|column| to.next().map(|to| *to = column));
    // SAFETY: the caller's columns have `n` elements
    packets(n, R::LANES, |place| unsafe {
        let load = |column| place.load::<R>(column);
        let reflection = Reflection::new(load(alphas), normals.map(load), views.map(load));
        let mut columns = columns.iter();
        reflection.map(|number| columns.next().map(|&column| place.store(column, number)));
    });
}

/// The results of a map, and where they hold.
pub(crate) unsafe extern "C" fn map<M: BatchMap, R: Packet>(
    map: *const c_void,
    n: usize,
    numbers: &[*const f32; MOST_NUMBERS],
    out: &[*mut f32; MOST_RESULTS],
    holds: *mut u8,
) {
    // SAFETY: the caller's
    unsafe { typed::<M>(map) }.with(|view| {
        // SAFETY: the caller's columns have `n` elements
        packets(n, R::LANES, |place| unsafe {
            let x = core::array::from_fn(|k| if k < M::NUMBERS { place.load(numbers[k]) } else { R::lit(0.0) });
            let (results, mask) = M::map::<R>(view, x);
            for (&column, result) in out.iter().zip(results).take(M::RESULTS) {
                place.store(column, result);
            }
            place.store_mask(holds, mask);
        });
    });
}

/// Pairs of a sequence.
pub(crate) unsafe extern "C" fn pairs<S: Sequence, R: Packet>(
    sequence: *const c_void,
    n: usize,
    counters: &Counters,
    out: Vec2<*mut f32>,
) {
    // SAFETY: the caller's columns have `n` elements
    packets(n, R::LANES, |place| unsafe {
        let pixel =
            if counters.pixels.is_null() { R::Uint::splat(counters.pixel) } else { place.load_uint(counters.pixels) };
        let sample = if counters.samples.is_null() {
            R::Uint::from_fn(|lane| counters.sample.wrapping_add(place.element(lane) as u32))
        } else {
            place.load_uint(counters.samples)
        };
        let u = typed::<S>(sequence).pair::<R>(pixel, sample, counters.dimension);
        place.store(out.x, u.x);
        place.store(out.y, u.y);
    });
}

/// Lights of a tree, chosen for points.
pub(crate) unsafe extern "C" fn choose<R: Packet>(
    tree: &TreeMemory<'_>,
    n: usize,
    points: Vec3<*const f32>,
    normals: Vec3<*const f32>,
    u: *const f32,
    out: &ChoiceColumns,
) {
    let Some(tree) = tree.view() else { return };
    // SAFETY: the caller's columns have `n` elements
    packets(n, R::LANES, |place| unsafe {
        let [p, normal] = [points, normals].map(|v| v.map(|column| place.load::<R>(column)));
        let choice = tree.at(p, normal).choose(place.load(u));
        place.store(out.pmf, choice.pmf);
        place.store(out.u, choice.u);
        if !out.light.is_null() {
            for lane in 0..place.count {
                out.light.add(place.at + lane).write_unaligned(choice.index.lane(lane));
            }
        }
    });
}

/// The probabilities with which a tree chooses lights for points.
pub(crate) unsafe extern "C" fn pmf<R: Packet>(
    tree: &TreeMemory<'_>,
    n: usize,
    points: Vec3<*const f32>,
    normals: Vec3<*const f32>,
    lights: *const u32,
    out: *mut f32,
) {
    let Some(tree) = tree.view() else { return };
    // SAFETY: the caller's columns have `n` elements
    packets(n, R::LANES, |place| unsafe {
        let [p, normal] = [points, normals].map(|v| v.map(|column| place.load::<R>(column)));
        place.store(out, tree.at(p, normal).pmf(place.load_uint(lights)));
    });
}
