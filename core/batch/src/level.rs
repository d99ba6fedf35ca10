//! The routines for one kind of processor, which is asked when the program runs.

use crate::functions::{
    MapFunction, ReflectionsFunction, SamplerFunctions, SequenceFunction, TechniqueFunctions, TreeFunctions,
    WarpFunctions,
};
use crate::map::BatchMap;
use crate::sequence::BatchSequence;
use crate::table::{self, FunctionTable};
use crate::technique::{Prepared, Technique};

/// The instructions that a [`Batch`] uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Those of the build: eight lanes, four on WebAssembly, and one where the same bits are asked for of a processor without fused
    /// multiply-add.
    Build,
    /// x86-64-v3: eight lanes with AVX2 and fused multiply-add.
    V3,
    /// x86-64-v4: sixteen lanes with AVX-512.
    V4,
}

/// The routines for one kind of processor.
///
/// All slices of one call must be of one length, the length of the batch, or the call panics. Empty slices stand for results that are
/// not wanted.
#[derive(Clone, Copy)]
pub struct Batch {
    level: Level,
    table: &'static FunctionTable,
    /// Where the functions of one element are.
    one: &'static FunctionTable,
}

impl core::fmt::Debug for Batch {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_tuple("Batch").field(&self.level).finish()
    }
}

impl Default for Batch {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(levels)]
// those with which the build script compiles the levels
cpufeatures::new!(v3_instructions, "avx2", "fma", "bmi1", "bmi2", "popcnt");
#[cfg(levels)]
cpufeatures::new!(v4_instructions, "avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl");
#[cfg(levels)]
// the build script compiles these tables from this crate
unsafe extern "C" {
    // SAFETY: the tables do not change
    safe static etendue_batch_v3: FunctionTable;
    safe static etendue_batch_v4: FunctionTable;
}

impl Batch {
    /// The routines with the widest instructions of this processor. The processor is asked once, and its answer kept.
    #[inline]
    #[must_use]
    pub fn new() -> Self {
        Self::at(Level::V4).or_else(|| Self::at(Level::V3)).unwrap_or(Self {
            level: Level::Build,
            table: &table::TABLE,
            one: &table::TABLE,
        })
    }
    /// The routines with certain instructions, or `None` if the processor lacks them or they were not compiled.
    #[inline]
    #[must_use]
    pub fn at(level: Level) -> Option<Self> {
        match level {
            Level::Build => Some(Self { level, table: &table::TABLE, one: &table::TABLE }),
            #[cfg(levels)]
            Level::V3 => {
                let table = &etendue_batch_v3;
                v3_instructions::get().then_some(Self { level, table, one: table })
            }
            #[cfg(levels)]
            Level::V4 => {
                let (table, one) = (&etendue_batch_v4, &etendue_batch_v3);
                (v3_instructions::get() && v4_instructions::get()).then_some(Self { level, table, one })
            }
            #[allow(unreachable_patterns)]
            _ => None,
        }
    }
    /// The instructions that it uses.
    #[must_use]
    pub const fn level(&self) -> Level {
        self.level
    }
    /// The functions of the technique with this number, by raw pointers; none if there is no such technique, or its light is not built. Each
    /// reads and writes as many elements of every column that is not null as the batch has.
    #[inline]
    #[must_use]
    pub fn technique(&self, number: usize) -> Option<&'static TechniqueFunctions> {
        *self.table.techniques.get(number)?
    }
    /// The same, of which those that prepare a light are those of single numbers.
    #[inline]
    #[must_use]
    pub fn technique_to_prepare(&self, number: usize) -> Option<&'static TechniqueFunctions> {
        *self.one.techniques.get(number)?
    }
    /// The same, of which those of one element are those of single numbers; none without the feature `one`.
    #[inline]
    #[must_use]
    pub fn technique_of_one(&self, number: usize) -> Option<&'static TechniqueFunctions> {
        self.technique_to_prepare(number).filter(|_| cfg!(feature = "one"))
    }
    /// The same, of which those with a light for each element are meant; none without the feature `each`.
    #[inline]
    #[must_use]
    pub fn technique_of_each(&self, number: usize) -> Option<&'static TechniqueFunctions> {
        self.technique(number).filter(|_| cfg!(feature = "each"))
    }
    #[track_caller]
    pub(crate) fn each<T: Technique>(&self) -> &'static TechniqueFunctions {
        self.technique_of_each(T::INDEX).expect("the light is not built: see the features of etendue-batch")
    }
    #[track_caller]
    pub(crate) fn sampler<P: Prepared>(&self) -> &'static SamplerFunctions {
        &self.technique(P::INDEX).expect("the light is not built: see the features of etendue-batch").sampler
    }
    #[track_caller]
    pub(crate) fn one<P: Prepared>(&self) -> &'static SamplerFunctions {
        &self.technique_of_one(P::INDEX).expect("the light is not built: see the features of etendue-batch").sampler
    }
    /// The functions of the warp with this number, by raw pointers. There must be one.
    #[inline]
    #[must_use]
    pub fn warp_functions(&self, number: usize) -> &'static WarpFunctions {
        &self.table.warps[number]
    }
    /// The same, of which those of one element are those of single numbers.
    #[inline]
    #[must_use]
    pub fn warp_of_one(&self, number: usize) -> &'static WarpFunctions {
        &self.one.warps[number]
    }
    /// The function of a map, by raw pointers.
    #[inline]
    #[must_use]
    pub const fn map_function<M: BatchMap>(&self) -> MapFunction {
        self.table.maps[M::INDEX]
    }
    /// The function of a sequence, by raw pointers.
    #[inline]
    #[must_use]
    pub const fn sequence<S: BatchSequence>(&self) -> SequenceFunction {
        self.table.sequences[S::INDEX]
    }
    /// The function that prepares reflections, by raw pointers.
    #[inline]
    #[must_use]
    pub const fn reflections_function(&self) -> ReflectionsFunction {
        self.table.reflections
    }
    /// The functions of trees, by raw pointers.
    #[inline]
    #[must_use]
    pub const fn tree(&self) -> &'static TreeFunctions {
        &self.table.tree
    }
}
