//! The loops over a batch: one body for every level of instructions and every kind of light.
//!
//! Columns are raw pointers, since callers in other languages pass them so, since an output may be null, and since an output may be
//! the same memory as an input.

use crate::columns::{numbers, store};
use crate::map::{BatchMap, MOST_NUMBERS, MOST_RESULTS};
use crate::one::{self, OneSample};
use crate::technique::{BatchSampler, BatchTechnique};
use crate::warp::BatchWarp;
use crate::{ChoiceColumns, Counters, EvaluationColumns, SampleColumns};
use core::mem::MaybeUninit;
use core::ptr::{copy_nonoverlapping, null_mut};
use etendue::reflection::Reflection;
use etendue::select::{LightChoice, LightTree};
use etendue::sequence::Sequence;
use etendue::{LightSample, LightSampler, Mask, Real, Uint, Vec2, Vec3};

/// A packet that consists of its lanes, in order.
///
/// # Safety
/// `Self` is `LANES` numbers in a row, and nothing else.
pub(crate) unsafe trait Packet: Real<Scalar = f32> {}
// SAFETY: a number is one lane
unsafe impl Packet for f32 {}
// SAFETY: `wide` has `as_array` for it
unsafe impl Packet for etendue::f32x4 {}
// SAFETY: as above
unsafe impl Packet for etendue::f32x8 {}
// SAFETY: as above
unsafe impl Packet for etendue::f32x16 {}

/// The elements of a batch that one packet holds: `count` of them from `at` on.
#[derive(Clone, Copy)]
struct Place {
    at: usize,
    count: usize,
}

impl Place {
    /// The element of a lane. Lanes past the end repeat the first one, so that they are as harmless as that.
    #[inline(always)]
    fn element(self, lane: usize) -> usize {
        self.at + if lane < self.count { lane } else { 0 }
    }
    #[inline(always)]
    unsafe fn load<R: Packet>(self, column: *const f32) -> R {
        if self.count == R::LANES {
            let mut packet = MaybeUninit::<R>::uninit();
            // SAFETY: the caller's column has an element for every lane, and a packet consists of its lanes
            unsafe {
                // as bytes, since columns have any alignment
                copy_nonoverlapping(column.add(self.at).cast::<u8>(), packet.as_mut_ptr().cast::<u8>(), 4 * R::LANES);
                packet.assume_init()
            }
        } else if self.count == 1 {
            // SAFETY: the caller's column has this element
            R::splat(unsafe { column.add(self.at).read_unaligned() })
        } else {
            // SAFETY: the caller's
            unsafe { self.load_some(column) }
        }
    }
    /// The last packet, in a function of its own: the loops have many columns.
    #[cold]
    #[inline(never)]
    unsafe fn load_some<R: Packet>(self, column: *const f32) -> R {
        // SAFETY: the caller's column has an element for every lane below `count`
        R::from_fn(|lane| unsafe { column.add(self.element(lane)).read_unaligned() })
    }
    #[inline(always)]
    unsafe fn load_uint<U: Uint>(self, column: *const u32) -> U {
        // SAFETY: the caller's column has an element for every lane
        U::from_fn(|lane| unsafe { column.add(self.element(lane)).read_unaligned() })
    }
    /// Writes a column, unless it is null.
    #[inline(always)]
    unsafe fn store<R: Packet>(self, column: *mut f32, value: R) {
        if column.is_null() {
            return;
        }
        if self.count == R::LANES {
            // SAFETY: the caller's column has an element for every lane, and a packet consists of its lanes
            unsafe {
                let bytes = (&raw const value).cast::<u8>();
                copy_nonoverlapping(bytes, column.add(self.at).cast::<u8>(), 4 * R::LANES);
            }
        } else if self.count == 1 {
            // SAFETY: the caller's column has this element
            unsafe { column.add(self.at).write_unaligned(value.lane(0)) };
        } else {
            // SAFETY: the caller's
            unsafe { self.store_some(column, value) };
        }
    }
    #[cold]
    #[inline(never)]
    unsafe fn store_some<R: Packet>(self, column: *mut f32, value: R) {
        for lane in 0..self.count {
            // SAFETY: the caller's column has an element for every lane below `count`
            unsafe { column.add(self.at + lane).write_unaligned(value.lane(lane)) };
        }
    }
    #[inline(always)]
    unsafe fn store3<R: Packet>(self, columns: [*mut f32; 3], value: Vec3<R>) {
        let [x, y, z] = columns;
        // SAFETY: the caller's
        unsafe {
            self.store(x, value.x);
            self.store(y, value.y);
            self.store(z, value.z);
        }
    }
    #[inline(always)]
    unsafe fn store_sample<R: Packet>(self, out: &SampleColumns, s: &LightSample<R>) {
        // SAFETY: the caller's
        unsafe {
            self.store3(out.direction, s.direction);
            self.store(out.distance, s.distance);
            self.store(out.pdf, s.pdf);
            self.store(out.weight, s.weight());
            // in one branch, so that the compiler moves there what only the surface needs
            if out.needs_surface() {
                self.store3(out.normal, s.normal);
                self.store(out.uv[0], s.uv.x);
                self.store(out.uv[1], s.uv.y);
            }
        }
        // SAFETY: the caller's
        unsafe { self.store_mask(out.emits, s.emits) };
    }
    /// Writes a column of truths, unless it is null.
    #[inline(always)]
    unsafe fn store_mask<M: Mask>(self, column: *mut u8, mask: M) {
        if column.is_null() {
            return;
        }
        let bits = mask.bits();
        for lane in 0..self.count {
            // SAFETY: the caller's column has an element for every lane below `count`
            unsafe { column.add(self.at + lane).write((bits >> lane & 1) as u8) };
        }
    }
}

/// Calls `f` for each packet of a batch of `n`.
#[inline(always)]
fn packets(n: usize, lanes: usize, mut f: impl FnMut(Place)) {
    let mut at = 0;
    while at < n {
        let count = (n - at).min(lanes);
        f(Place { at, count });
        at += count;
    }
}

/// Samples of one prepared light.
pub(crate) unsafe extern "C" fn sample<T: BatchSampler, R: Packet>(
    sampler: &T,
    n: usize,
    u: Vec2<*const f32>,
    out: &SampleColumns,
) {
    if R::LANES == 1 {
        for i in 0..n {
            let mut s = OneSample::default();
            // SAFETY: the caller's columns have `n` elements
            unsafe {
                one::sample(sampler, numbers([u.x, u.y], i).as_ptr(), &mut s);
                out.store(i, &s);
            }
        }
        return;
    }
    let sampler = sampler.splat::<R>();
    // SAFETY: the caller's columns have `n` elements
    packets(n, R::LANES, |place| unsafe {
        place.store_sample(out, &sampler.sample(u.map(|column| place.load(column))));
    });
}

/// Lights of their own for each element, as seen from points of surfaces with normals of their own.
#[repr(C)]
pub struct Views<T: BatchTechnique> {
    /// The lights.
    pub lights: T::Light<*const f32>,
    /// The shading points.
    pub points: Vec3<*const f32>,
    /// The unit normals there; techniques that need none do not read them.
    pub normals: Vec3<*const f32>,
}

impl<T: BatchTechnique> Views<T> {
    /// The lights of a packet, prepared.
    #[inline(always)]
    unsafe fn prepare<R: Packet>(&self, place: Place) -> T::Of<R> {
        // SAFETY: the caller's columns have an element for every lane
        unsafe {
            let load = |column| place.load::<R>(column);
            let normal = if T::ON_SURFACE { self.normals.map(load) } else { Vec3::splat(Vec3::default()) };
            T::prepare(T::map(self.lights, load), self.points.map(load), normal)
        }
    }
    /// The light of one element, prepared by the function of one light, whose code is there already.
    unsafe fn one(&self, i: usize) -> T {
        let mut sampler = MaybeUninit::<T>::uninit();
        // SAFETY: the caller's columns have this element
        unsafe {
            let number = |column: *const f32| column.add(i).read_unaligned();
            let normal = if T::ON_SURFACE { self.normals.map(number) } else { Vec3::default() };
            one::prepare::<T>(&T::map(self.lights, number), self.points.map(number), normal, sampler.as_mut_ptr());
            sampler.assume_init()
        }
    }
}

/// Samples of a light of its own for each element, prepared for a point of its own.
pub(crate) unsafe extern "C" fn sample_each<T: BatchTechnique, R: Packet>(
    views: &Views<T>,
    n: usize,
    u: Vec2<*const f32>,
    out: &SampleColumns,
) {
    if R::LANES == 1 {
        for i in 0..n {
            // SAFETY: the caller's columns have `n` elements
            unsafe { sample::<T, f32>(&views.one(i), 1, u.map(|column| column.add(i)), &out.from(i)) };
        }
        return;
    }
    // SAFETY: the caller's columns have `n` elements
    packets(n, R::LANES, |place| unsafe {
        place.store_sample(out, &views.prepare::<R>(place).sample(u.map(|column| place.load(column))));
    });
}

/// The pdf, the random numbers and the hit of a direction of its own for each element; null columns are not wanted.
pub(crate) unsafe extern "C" fn evaluate_each<T: BatchTechnique, R: Packet>(
    views: &Views<T>,
    n: usize,
    directions: Vec3<*const f32>,
    out: &EvaluationColumns,
) {
    let EvaluationColumns { pdf: pdfs, u, hit: hits } = out;
    let (wants_u, wants_hit) = (!u.iter().all(|column| column.is_null()), hits.any());
    if R::LANES == 1 {
        for i in 0..n {
            // SAFETY: the caller's columns have `n` elements
            unsafe {
                let (sampler, out) = (views.one(i), out.from(i));
                let w = directions.map(|column| column.add(i));
                if !out.pdf.is_null() {
                    pdf::<T, f32>(&sampler, 1, w, out.pdf);
                }
                if wants_u {
                    invert::<T, f32>(&sampler, 1, w, Vec2::new(out.u[0], out.u[1]));
                }
                if wants_hit {
                    hit::<T, f32>(&sampler, 1, w, &out.hit);
                }
            }
        }
        return;
    }
    // SAFETY: the caller's columns have `n` elements
    packets(n, R::LANES, |place| unsafe {
        let sampler = views.prepare::<R>(place);
        let w = directions.map(|column| place.load(column));
        // what is not wanted is not computed
        if !pdfs.is_null() {
            place.store(*pdfs, sampler.pdf(w));
        }
        if wants_u {
            let found = sampler.invert(w);
            place.store(u[0], found.x);
            place.store(u[1], found.y);
        }
        if wants_hit {
            place.store_sample(hits, &sampler.hit(w));
        }
    });
}

/// The pdf of directions.
pub(crate) unsafe extern "C" fn pdf<T: BatchSampler, R: Packet>(
    sampler: &T,
    n: usize,
    directions: Vec3<*const f32>,
    out: *mut f32,
) {
    let Vec3 { x, y, z } = directions;
    if R::LANES == 1 {
        for i in 0..n {
            // SAFETY: the caller's columns have `n` elements
            unsafe { store(out, i, one::pdf(sampler, numbers([x, y, z], i).as_ptr())) };
        }
        return;
    }
    let sampler = sampler.splat::<R>();
    // SAFETY: the caller's columns have `n` elements
    packets(n, R::LANES, |place| unsafe {
        place.store(out, sampler.pdf(directions.map(|column| place.load(column))));
    });
}

/// The random numbers that the sampler maps to directions.
pub(crate) unsafe extern "C" fn invert<T: BatchSampler, R: Packet>(
    sampler: &T,
    n: usize,
    directions: Vec3<*const f32>,
    out: Vec2<*mut f32>,
) {
    let Vec3 { x, y, z } = directions;
    if R::LANES == 1 {
        for i in 0..n {
            let mut u = [0.0; 2];
            // SAFETY: the caller's columns have `n` elements
            unsafe {
                one::invert(sampler, numbers([x, y, z], i).as_ptr(), u.as_mut_ptr());
                store(out.x, i, u[0]);
                store(out.y, i, u[1]);
            }
        }
        return;
    }
    let sampler = sampler.splat::<R>();
    // SAFETY: the caller's columns have `n` elements
    packets(n, R::LANES, |place| unsafe {
        let u = sampler.invert(directions.map(|column| place.load(column)));
        place.store(out.x, u.x);
        place.store(out.y, u.y);
    });
}

/// Where directions hit the light.
pub(crate) unsafe extern "C" fn hit<T: BatchSampler, R: Packet>(
    sampler: &T,
    n: usize,
    directions: Vec3<*const f32>,
    out: &SampleColumns,
) {
    let Vec3 { x, y, z } = directions;
    if R::LANES == 1 {
        for i in 0..n {
            let mut s = OneSample::default();
            // SAFETY: the caller's columns have `n` elements
            unsafe {
                one::hit(sampler, numbers([x, y, z], i).as_ptr(), &mut s);
                out.store(i, &s);
            }
        }
        return;
    }
    let sampler = sampler.splat::<R>();
    // SAFETY: the caller's columns have `n` elements
    packets(n, R::LANES, |place| unsafe {
        place.store_sample(out, &sampler.hit(directions.map(|column| place.load(column))));
    });
}

/// Points of a warp.
pub(crate) unsafe extern "C" fn warp_sample<W: BatchWarp, R: Packet>(
    warp: &W,
    n: usize,
    u: Vec2<*const f32>,
    out: &[*mut f32; 3],
) {
    let warp = warp.splat::<R>();
    // SAFETY: the caller's columns have `n` elements
    packets(n, R::LANES, |place| unsafe {
        let x = place.load(u.x);
        let y = if W::NUMBERS == 2 { place.load(u.y) } else { x };
        let point = W::sample(&warp, Vec2::new(x, y));
        for (&column, value) in out.iter().zip(point).take(W::COORDINATES) {
            place.store(column, value);
        }
    });
}

#[inline(always)]
unsafe fn load_point<W: BatchWarp, R: Packet>(place: Place, points: &[*const f32; 3]) -> [R; 3] {
    // SAFETY: the caller's columns are as many as the point has coordinates
    core::array::from_fn(|k| if k < W::COORDINATES { unsafe { place.load(points[k]) } } else { R::lit(0.0) })
}

/// The pdf of a warp at points.
pub(crate) unsafe extern "C" fn warp_pdf<W: BatchWarp, R: Packet>(
    warp: &W,
    n: usize,
    points: &[*const f32; 3],
    out: *mut f32,
) {
    let warp = warp.splat::<R>();
    // SAFETY: the caller's columns have `n` elements
    packets(n, R::LANES, |place| unsafe { place.store(out, W::pdf(&warp, load_point::<W, R>(place, points))) });
}

/// The random numbers that a warp maps to points.
pub(crate) unsafe extern "C" fn warp_invert<W: BatchWarp, R: Packet>(
    warp: &W,
    n: usize,
    points: &[*const f32; 3],
    out: Vec2<*mut f32>,
) {
    let warp = warp.splat::<R>();
    // SAFETY: the caller's columns have `n` elements
    packets(n, R::LANES, |place| unsafe {
        let u = W::invert(&warp, load_point::<W, R>(place, points));
        place.store(out.x, u.x);
        if W::NUMBERS == 2 {
            place.store(out.y, u.y);
        }
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
    map: &M,
    n: usize,
    numbers: &[*const f32; MOST_NUMBERS],
    out: &[*mut f32; MOST_RESULTS],
    holds: *mut u8,
) {
    // SAFETY: the caller's columns have `n` elements
    packets(n, R::LANES, |place| unsafe {
        let x = core::array::from_fn(|k| if k < M::NUMBERS { place.load(numbers[k]) } else { R::lit(0.0) });
        let (results, mask) = map.map::<R>(x);
        for (&column, result) in out.iter().zip(results).take(M::RESULTS) {
            place.store(column, result);
        }
        place.store_mask(holds, mask);
    });
}

/// Pairs of a sequence.
pub(crate) unsafe extern "C" fn pairs<S: Sequence, R: Packet>(
    sequence: &S,
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
        let u = sequence.pair::<R>(pixel, sample, counters.dimension);
        place.store(out.x, u.x);
        place.store(out.y, u.y);
    });
}

/// Lights of a tree, chosen for points.
pub(crate) unsafe extern "C" fn choose<R: Packet>(
    tree: &LightTree<'_>,
    n: usize,
    points: Vec3<*const f32>,
    normals: Vec3<*const f32>,
    u: *const f32,
    out: &ChoiceColumns,
) {
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
    tree: &LightTree<'_>,
    n: usize,
    points: Vec3<*const f32>,
    normals: Vec3<*const f32>,
    lights: *const u32,
    out: *mut f32,
) {
    // SAFETY: the caller's columns have `n` elements
    packets(n, R::LANES, |place| unsafe {
        let [p, normal] = [points, normals].map(|v| v.map(|column| place.load::<R>(column)));
        place.store(out, tree.at(p, normal).pmf(place.load_uint(lights)));
    });
}
