//! Light sampling in batches of any length, with the widest vector instructions that the processor has.
//!
//! [`etendue`] itself uses the instructions for which it was compiled, which by default are those of every x86-64 processor. With the feature
//! `dispatch` this crate compiles its routines for x86-64, x86-64-v3 (AVX2, fused multiply-add) and x86-64-v4 (AVX-512), and chooses when it
//! runs: this is for those who ship programs. With the feature `same-bits` all of them return the same bits as the core.
//!
//! ```
//! use etendue::{Parallelogram, Vec2, Vec3, sequence::OwenSobol};
//! use etendue_batch::{Batch, Counters, Samples};
//! let batch = Batch::new(); // asks the processor once; a pair of pointers to keep or to make again
//! let panel = Parallelogram::new([-1.0, 2.0, -1.0].into(), [2.0, 0.0, 0.0].into(), [0.0, 0.0, 2.0].into());
//! let sampler = panel.by_solid_angle(Vec3::new(0.0, 0.0, 0.0));
//!
//! let mut u = [[0.0; 100]; 2];
//! let [x, y] = &mut u;
//! batch.pairs(&OwenSobol::new(1), Counters::default(), Vec2::new(x, y));
//! let (mut height, mut weight) = ([0.0; 100], [0.0; 100]);
//! let wanted = Samples { direction: [&mut [], &mut height, &mut []], weight: &mut weight, ..Samples::default() };
//! batch.sample(&sampler, Vec2::new(&u[0], &u[1]), wanted);
//! // irradiance on a receiver that faces up
//! let irradiance = height.iter().zip(&weight).map(|(cos, weight)| cos * weight).sum::<f32>() / 100.0;
//! assert!(irradiance > 0.7 && irradiance < 0.9);
//! ```
//!
//! # Debug builds
//! A debug build of a host compiles the generic routines of the core without optimisation, where they take many times as long. `Lights` of the
//! core and these batches are compiled in their libraries, so that a host that calls them is as fast as its other code, if its `Cargo.toml` has
//! these lines (`benches/host/run` prints its times):
//!
//! ```toml
//! [profile.dev.package."*"]
//! opt-level = 3
//! ```
//!
//! # What `dispatch` costs
//! The build script runs cargo twice to compile this crate with other instructions: where a host is built, cargo must find the dependencies
//! once more, and building takes three times as long. Without the feature the script does nothing. Functions with `#[target_feature]` cannot
//! replace it yet: they give their instructions to routines of other crates only where all of these are inlined, and closures and functions of
//! the standard library in them are not: there, each operation is a call.
//!
//! # Costs
//! A call repeats the prepared light in all lanes first, so a batch of 1
//! takes as long as a whole packet and more: for one element there are [`Batch::sample_one`] and others, in single numbers.
//!
//! `benches/peers/single_calls.py` prints nanoseconds per call from C: of the textbook's formulas, of the C library, which calls this crate, and
//! of the C header of `etendue-shader`.
#![cfg_attr(not(test), no_std)]

#[doc(no_inline)]
pub use etendue::listed::warp::{ListedWarp as BatchWarp, WARPS};

mod columns;
mod functions;
mod kernel;
mod level;
mod map;
pub mod memory;
mod one;
mod packet;
mod sealed;
mod sequence;
mod table;
pub mod technique;

pub use columns::{
    ChoiceColumns, Choices, Counters, EvaluationColumns, Evaluations, OneSample, SampleColumns, Samples,
};
pub use functions::{
    MapFunction, ReflectionsFunction, SamplerFunctions, SequenceFunction, TechniqueFunctions, TreeFunctions,
    WarpFunctions,
};
pub use kernel::Views;
pub use level::{Batch, Level};
pub use map::{BatchMap, MOST_NUMBERS, MOST_RESULTS, PortalDirection, ReflectedSphere, SeenThroughPortals};
pub use packet::Packet;
pub use sequence::BatchSequence;
pub use table::FunctionTable;
pub use technique::{Prepared, TECHNIQUES, Technique};

use core::ffi::c_void;
use core::mem::MaybeUninit;
use core::ptr::from_ref;
use etendue::reflection::Reflection;
use etendue::{Vec2, Vec3};
use memory::TreeMemory;

impl Batch {
    /// Prepares a light for the point `p`, and for what else the technique takes: nothing, a unit normal, or a [`Reflection`].
    #[must_use]
    pub fn prepare<T: Technique>(&self, light: &T::Light<f32>, p: Vec3<f32>, with: T::With<f32>) -> T::Prepared {
        let mut out = MaybeUninit::<T::Prepared>::uninit();
        // SAFETY: the function writes a whole sampler
        unsafe {
            let functions = self.technique_to_prepare(T::INDEX);
            let functions = functions.expect("the light is not built: see the features of etendue-batch");
            (functions.prepare)(erased(light), row(&p), erased(&with), out.as_mut_ptr().cast());
            out.assume_init()
        }
    }
    /// Draws one direction from a prepared light, for `u` in [0, 1)².
    #[inline]
    #[must_use]
    pub fn sample_one<P: Prepared>(&self, sampler: &P, u: Vec2<f32>) -> OneSample {
        let mut out = OneSample::default();
        // SAFETY: the function reads two numbers, and writes its result
        unsafe { (self.one::<P>().one_sample)(erased(sampler), row(&u), &mut out) };
        out
    }
    /// The pdf of one unit direction, per steradian (lines: see [`etendue::Line`]); 0 where it misses the light.
    #[inline]
    #[must_use]
    pub fn pdf_one<P: Prepared>(&self, sampler: &P, w: Vec3<f32>) -> f32 {
        // SAFETY: the function reads three numbers
        unsafe { (self.one::<P>().one_pdf)(erased(sampler), row(&w)) }
    }
    /// The numbers in [0, 1)² that the sampler maps to one unit direction.
    #[inline]
    #[must_use]
    pub fn invert_one<P: Prepared>(&self, sampler: &P, w: Vec3<f32>) -> Vec2<f32> {
        let mut out = Vec2::default();
        // SAFETY: the function reads three numbers, and writes two
        unsafe { (self.one::<P>().one_invert)(erased(sampler), row(&w), (&raw mut out).cast()) };
        out
    }
    /// The nearest point of the light in one unit direction, with its pdf; 0 where the direction misses it.
    #[inline]
    #[must_use]
    pub fn hit_one<P: Prepared>(&self, sampler: &P, w: Vec3<f32>) -> OneSample {
        let mut out = OneSample::default();
        // SAFETY: the function reads three numbers, and writes its result
        unsafe { (self.one::<P>().one_hit)(erased(sampler), row(&w), &mut out) };
        out
    }
    /// Samples one prepared light, at the numbers `u` in [0, 1)².
    pub fn sample<P: Prepared>(&self, sampler: &P, u: Vec2<&[f32]>, out: Samples<'_>) {
        let n = u.x.len();
        check(n, [u.y.len()]);
        let out = out.columns(n);
        // SAFETY: all columns have n elements, and the outputs are borrowed mutably
        unsafe { (self.sampler::<P>().sample)(erased(sampler), n, u.map(<[f32]>::as_ptr), &out) };
    }
    /// Prepares a light of its own for each element, for the point `p` and what else the technique takes, and samples it.
    pub fn sample_each<T: Technique>(
        &self,
        lights: T::Light<&[f32]>,
        p: Vec3<&[f32]>,
        with: T::With<&[f32]>,
        u: Vec2<&[f32]>,
        out: Samples<'_>,
    ) {
        let count = u.x.len();
        check(count, [u.y.len()]);
        let out = out.columns(count);
        // SAFETY: all columns have `count` elements, and the outputs are borrowed mutably
        with_views::<T>(count, lights, p, with, |views| unsafe {
            (self.each::<T>().sample_each)(views, count, u.map(<[f32]>::as_ptr), &out);
        });
    }
    /// Prepares a light of its own for each element, as [`sample_each`](Self::sample_each) does, and evaluates it in the unit direction `w`.
    /// What is not wanted is not computed.
    pub fn evaluate_each<T: Technique>(
        &self,
        lights: T::Light<&[f32]>,
        p: Vec3<&[f32]>,
        with: T::With<&[f32]>,
        w: Vec3<&[f32]>,
        out: Evaluations<'_>,
    ) {
        let count = w.x.len();
        check(count, [w.y.len(), w.z.len()]);
        let out = out.columns(count);
        // SAFETY: all columns have `count` elements, and the outputs are borrowed mutably
        with_views::<T>(count, lights, p, with, |views| unsafe {
            (self.each::<T>().evaluate_each)(views, count, w.map(<[f32]>::as_ptr), &out);
        });
    }
    /// The pdf of unit directions, per steradian (lines: see [`etendue::Line`]).
    pub fn pdf<P: Prepared>(&self, sampler: &P, directions: Vec3<&[f32]>, out: &mut [f32]) {
        let n = out.len();
        check(n, [directions.x.len(), directions.y.len(), directions.z.len()]);
        // SAFETY: all columns have n elements, and the output is borrowed mutably
        unsafe { (self.sampler::<P>().pdf)(erased(sampler), n, directions.map(<[f32]>::as_ptr), out.as_mut_ptr()) };
    }
    /// The numbers in [0, 1)² that the sampler maps to unit directions.
    pub fn invert<P: Prepared>(&self, sampler: &P, directions: Vec3<&[f32]>, out: Vec2<&mut [f32]>) {
        let n = out.x.len();
        check(n, [out.y.len(), directions.x.len(), directions.y.len(), directions.z.len()]);
        let out = out.map(<[f32]>::as_mut_ptr);
        // SAFETY: all columns have n elements, and the outputs are borrowed mutably
        unsafe { (self.sampler::<P>().invert)(erased(sampler), n, directions.map(<[f32]>::as_ptr), out) };
    }
    /// The nearest points of the light in unit directions, with their pdf; 0 where a direction misses it.
    pub fn hit<P: Prepared>(&self, sampler: &P, directions: Vec3<&[f32]>, out: Samples<'_>) {
        let n = directions.x.len();
        check(n, [directions.y.len(), directions.z.len()]);
        let out = out.columns(n);
        // SAFETY: all columns have n elements, and the outputs are borrowed mutably
        unsafe { (self.sampler::<P>().hit)(erased(sampler), n, directions.map(<[f32]>::as_ptr), &out) };
    }

    /// Prepares a reflection for each roughness `alpha`, unit normal of a surface and unit vector towards the viewer. What it consists of
    /// goes to columns, `Reflection::<f32>::default().map(…)` of which those of `sample_each` of lights `by_reflection` are made, too; empty
    /// ones are not wanted.
    pub fn reflections(&self, alpha: &[f32], normal: Vec3<&[f32]>, view: Vec3<&[f32]>, out: Reflection<&mut [f32]>) {
        let n = alpha.len();
        check(n, [normal, view].iter().flat_map(|v| [v.x.len(), v.y.len(), v.z.len()]));
        let out = out.map(|column| columns::pointer(column, n));
        let [normal, view] = [normal, view].map(|v| v.map(<[f32]>::as_ptr));
        // SAFETY: all columns have n elements, and the outputs are borrowed mutably
        unsafe { self.reflections_function()(n, alpha.as_ptr(), normal, view, &out) };
    }

    /// Points of a warp, at the numbers `u` in [0, 1)²: as many columns as a point has coordinates are written.
    pub fn warp<W: BatchWarp>(&self, warp: &W, u: [&[f32]; 2], mut out: [&mut [f32]; 3]) {
        let n = u[0].len();
        check(n, u.iter().map(|column| column.len()));
        check(n, out.iter().take(W::ENTRY.coordinates).map(|column| column.len()));
        let columns = out.each_mut().map(|column| column.as_mut_ptr());
        // SAFETY: the columns that are read and written have n elements, and the outputs are borrowed mutably
        unsafe {
            (self.warp_functions(W::ENTRY.index).sample)(
                erased(warp),
                n,
                Vec2::new(u[0].as_ptr(), u[1].as_ptr()),
                &columns,
            )
        };
    }
    /// The pdf of a warp at points.
    pub fn warp_pdf<W: BatchWarp>(&self, warp: &W, points: [&[f32]; 3], out: &mut [f32]) {
        let n = out.len();
        check(n, points.iter().take(W::ENTRY.coordinates).map(|column| column.len()));
        // SAFETY: the columns that are read have n elements, and the output is borrowed mutably
        unsafe {
            (self.warp_functions(W::ENTRY.index).pdf)(erased(warp), n, &points.map(<[f32]>::as_ptr), out.as_mut_ptr())
        };
    }
    /// The numbers that a warp maps to points.
    pub fn warp_invert<W: BatchWarp>(&self, warp: &W, points: [&[f32]; 3], out: [&mut [f32]; 2]) {
        let n = out[0].len();
        check(n, out.iter().map(|column| column.len()));
        check(n, points.iter().take(W::ENTRY.coordinates).map(|column| column.len()));
        let [x, y] = out;
        // SAFETY: the columns that are read and written have n elements, and the outputs are borrowed mutably
        unsafe {
            let invert = self.warp_functions(W::ENTRY.index).invert;
            invert(erased(warp), n, &points.map(<[f32]>::as_ptr), Vec2::new(x.as_mut_ptr(), y.as_mut_ptr()));
        }
    }
    /// The point of a warp at one `u` in [0, 1)²; coordinates that a point does not have are 0.
    #[inline]
    #[must_use]
    pub fn warp_one<W: BatchWarp>(&self, warp: &W, u: Vec2<f32>) -> [f32; 3] {
        let mut out = [0.0; 3];
        // SAFETY: the function reads one or two numbers, and writes at most three
        unsafe { (self.warp_of_one(W::ENTRY.index).one_sample)(erased(warp), row(&u), out.as_mut_ptr()) };
        out
    }
    /// The pdf of a warp at one point.
    #[inline]
    #[must_use]
    pub fn warp_pdf_one<W: BatchWarp>(&self, warp: &W, point: &[f32; 3]) -> f32 {
        // SAFETY: the function reads at most three numbers
        unsafe { (self.warp_of_one(W::ENTRY.index).one_pdf)(erased(warp), point.as_ptr()) }
    }
    /// The numbers that a warp maps to one point.
    #[inline]
    #[must_use]
    pub fn warp_invert_one<W: BatchWarp>(&self, warp: &W, point: &[f32; 3]) -> Vec2<f32> {
        let mut out = Vec2::default();
        // SAFETY: the function reads at most three numbers, and writes one or two
        unsafe { (self.warp_of_one(W::ENTRY.index).one_invert)(erased(warp), point.as_ptr(), (&raw mut out).cast()) };
        out
    }
    /// The results of a map of columns of numbers: as many columns as it has numbers and results, and 1 where they hold, else 0.
    pub fn map<M: BatchMap>(&self, map: &M, numbers: &[&[f32]], out: &mut [&mut [f32]], holds: &mut [u8]) {
        assert!(numbers.len() == M::NUMBERS && out.len() <= M::RESULTS, "so many columns do not belong to the map");
        let n = numbers[0].len();
        check(n, numbers.iter().map(|column| column.len()));
        let inputs = core::array::from_fn(|k| numbers.get(k).map_or(core::ptr::null(), |column| column.as_ptr()));
        let mut outputs = [core::ptr::null_mut(); MOST_RESULTS];
        for (pointer, column) in outputs.iter_mut().zip(out) {
            *pointer = columns::pointer(column, n);
        }
        // SAFETY: the columns that are read and written have n elements, and the outputs are borrowed mutably
        unsafe { (self.map_function::<M>())(erased(map), n, &inputs, &outputs, columns::pointer(holds, n)) };
    }
    /// Pairs of a sequence: of the samples from `counters.sample` on, of one pixel and one dimension, or of those in the columns.
    pub fn pairs<S: BatchSequence>(&self, sequence: &S, counters: Counters, out: Vec2<&mut [f32]>) {
        let n = out.x.len();
        check(n, [out.y.len()]);
        assert!(counters.pixels.is_null() && counters.samples.is_null(), "columns of counters are for raw pointers");
        // SAFETY: both columns have n elements and are borrowed mutably
        unsafe { (self.sequence::<S>())(erased(sequence), n, &counters, out.map(<[f32]>::as_mut_ptr)) };
    }
    /// Chooses a light of a tree for each point `p` of a surface with the unit normal `n`.
    pub fn choose(&self, tree: &TreeMemory<'_>, p: Vec3<&[f32]>, n: Vec3<&[f32]>, u: &[f32], out: Choices<'_>) {
        let count = u.len();
        check(count, [p, n].iter().flat_map(|v| [v.x.len(), v.y.len(), v.z.len()]));
        let out = out.columns(count);
        let [p, n] = [p, n].map(|v| v.map(<[f32]>::as_ptr));
        // SAFETY: all columns have `count` elements, and the outputs are borrowed mutably
        unsafe { (self.tree().choose)(tree, count, p, n, u.as_ptr(), &out) };
    }
    /// The probability with which [`choose`](Self::choose) returns each of `lights`.
    pub fn pmf(&self, tree: &TreeMemory<'_>, p: Vec3<&[f32]>, n: Vec3<&[f32]>, lights: &[u32], out: &mut [f32]) {
        let count = out.len();
        check(count, [p, n].iter().flat_map(|v| [v.x.len(), v.y.len(), v.z.len()]));
        check(count, [lights.len()]);
        let [p, n] = [p, n].map(|v| v.map(<[f32]>::as_ptr));
        // SAFETY: all columns have `count` elements, and the output is borrowed mutably
        unsafe { (self.tree().pmf)(tree, count, p, n, lights.as_ptr(), out.as_mut_ptr()) };
    }
}

/// The numbers of a vector, which are in a row.
const fn row<V>(vector: &V) -> *const f32 {
    from_ref(vector).cast()
}

/// A pointer whose type the function knows.
const fn erased<T>(value: &T) -> *const c_void {
    from_ref(value).cast()
}

/// Calls `f` with lights, points and what they are prepared for by pointers.
#[track_caller]
fn with_views<T: Technique>(
    count: usize,
    lights: T::Light<&[f32]>,
    p: Vec3<&[f32]>,
    with: T::With<&[f32]>,
    f: impl FnOnce(&Views),
) {
    check(count, [p.x.len(), p.y.len(), p.z.len()]);
    let pointer = |column: &[f32]| {
        check(count, [column.len()]);
        column.as_ptr()
    };
    let (lights, with) = (T::map_light(lights, pointer), T::map_with(with, pointer));
    f(&Views { lights: erased(&lights), points: p.map(<[f32]>::as_ptr), with: erased(&with) });
}

/// Panics unless all columns are as long as the batch.
#[track_caller]
fn check(n: usize, lengths: impl IntoIterator<Item = usize>) {
    for length in lengths {
        assert!(length == n, "a column of {length} elements in a batch of {n}");
    }
}
