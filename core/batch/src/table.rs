//! The functions of every level, in tables of the same form.

use crate::kernel::{Packet, Views};
use crate::map::{BatchMap, MOST_NUMBERS, MOST_RESULTS, MapTable};
use crate::one::{OnceFunctions, OneFunctions, OneWarpFunctions};
use crate::placed::PlacedTable;
use crate::technique::{BatchSampler, BatchTechnique};
use crate::warp::BatchWarp;
use crate::{ChoiceColumns, Counters, EvaluationColumns, SampleColumns, kernel};
use etendue::light::*;
use etendue::reflection::Reflection;
use etendue::select::LightTree;
use etendue::sequence::*;
use etendue::warp::*;
use etendue::{Vec2, Vec3};

type Column = *const f32;

/// The functions of a prepared light, by raw pointers to columns.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct SamplerFunctions<T: BatchSampler> {
    /// See [`Batch::sample`](crate::Batch::sample).
    pub sample: unsafe extern "C" fn(&T, usize, Vec2<Column>, &SampleColumns),
    /// See [`Batch::pdf`](crate::Batch::pdf).
    pub pdf: unsafe extern "C" fn(&T, usize, Vec3<Column>, *mut f32),
    /// See [`Batch::invert`](crate::Batch::invert).
    pub invert: unsafe extern "C" fn(&T, usize, Vec3<Column>, Vec2<*mut f32>),
    /// See [`Batch::hit`](crate::Batch::hit).
    pub hit: unsafe extern "C" fn(&T, usize, Vec3<Column>, &SampleColumns),
    /// Those of one element.
    pub one: OneFunctions<T>,
}
impl<T: BatchSampler> SamplerFunctions<T> {
    const fn of<R: Packet>() -> Self {
        Self {
            sample: kernel::sample::<T, R>,
            pdf: kernel::pdf::<T, R>,
            invert: kernel::invert::<T, R>,
            hit: kernel::hit::<T, R>,
            one: OneFunctions::of_this_build(),
        }
    }
}

/// The functions of a light's technique, by raw pointers to columns.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct LightFunctions<T: BatchTechnique> {
    /// Those of one element.
    pub once: OnceFunctions<T>,
    /// See [`Batch::sample_each`](crate::Batch::sample_each).
    pub sample_each: unsafe extern "C" fn(&Views<T>, usize, Vec2<Column>, &SampleColumns),
    /// See [`Batch::evaluate_each`](crate::Batch::evaluate_each).
    pub evaluate_each: unsafe extern "C" fn(&Views<T>, usize, Vec3<Column>, &EvaluationColumns),
    /// What is done with the prepared light.
    pub sampler: SamplerFunctions<T>,
}
impl<T: BatchTechnique> LightFunctions<T> {
    pub(crate) const fn of<R: Packet>() -> Self {
        Self {
            once: OnceFunctions::of_this_build(),
            sample_each: kernel::sample_each::<T, R>,
            evaluate_each: kernel::evaluate_each::<T, R>,
            sampler: SamplerFunctions::of::<R>(),
        }
    }
}

/// The functions of a warp, by raw pointers to columns.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct WarpFunctions<W: BatchWarp> {
    /// See [`Batch::warp`](crate::Batch::warp).
    pub sample: unsafe extern "C" fn(&W, usize, Vec2<Column>, &[*mut f32; 3]),
    /// See [`Batch::warp_pdf`](crate::Batch::warp_pdf).
    pub pdf: unsafe extern "C" fn(&W, usize, &[Column; 3], *mut f32),
    /// See [`Batch::warp_invert`](crate::Batch::warp_invert).
    pub invert: unsafe extern "C" fn(&W, usize, &[Column; 3], Vec2<*mut f32>),
    /// Those of one element.
    pub one: OneWarpFunctions<W>,
}
impl<W: BatchWarp> WarpFunctions<W> {
    const fn of<R: Packet>() -> Self {
        Self {
            sample: kernel::warp_sample::<W, R>,
            pdf: kernel::warp_pdf::<W, R>,
            invert: kernel::warp_invert::<W, R>,
            one: OneWarpFunctions::of_this_build(),
        }
    }
}

/// See [`Batch::reflections`](crate::Batch::reflections), by raw pointers: roughnesses, normals, views, and where the reflections go.
pub type ReflectionsFunction = unsafe extern "C" fn(usize, Column, Vec3<Column>, Vec3<Column>, &Reflection<*mut f32>);

/// The function of a map, by raw pointers to columns.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct MapFunctions<M: BatchMap> {
    /// See [`Batch::map`](crate::Batch::map): as many columns as the map has numbers and results, and whether they hold.
    pub map: unsafe extern "C" fn(&M, usize, &[Column; MOST_NUMBERS], &[*mut f32; MOST_RESULTS], *mut u8),
}
impl<M: BatchMap> MapFunctions<M> {
    pub(crate) const fn of<R: Packet>() -> Self {
        Self { map: kernel::map::<M, R> }
    }
}

/// The function of a sequence.
#[repr(C)]
pub struct SequenceFunctions<S: Sequence> {
    /// See [`Batch::pairs`](crate::Batch::pairs).
    pub pairs: unsafe extern "C" fn(&S, usize, &Counters, Vec2<*mut f32>),
}
impl<S: Sequence> SequenceFunctions<S> {
    const fn of<R: Packet>() -> Self {
        Self { pairs: kernel::pairs::<S, R> }
    }
}

/// The functions of a tree of lights.
#[repr(C)]
pub struct TreeFunctions {
    /// See [`Batch::choose`](crate::Batch::choose).
    pub choose: unsafe extern "C" fn(&LightTree<'_>, usize, Vec3<Column>, Vec3<Column>, Column, &ChoiceColumns),
    /// See [`Batch::pmf`](crate::Batch::pmf).
    pub pmf: unsafe extern "C" fn(&LightTree<'_>, usize, Vec3<Column>, Vec3<Column>, *const u32, *mut f32),
}
impl TreeFunctions {
    const fn of<R: Packet>() -> Self {
        Self { choose: kernel::choose::<R>, pmf: kernel::pmf::<R> }
    }
}

/// A type whose functions are in a [`Table`].
///
/// # Safety
/// The functions must be those of the type: [`Batch`](crate::Batch) calls them with columns as long as the batch, and relies on them to
/// read and write no more.
pub unsafe trait InTable: 'static {
    /// The functions of the type.
    type Functions: 'static;
    /// Finds them.
    fn functions(table: &'static Table) -> &'static Self::Functions;
}

macro_rules! table {
    // adds the functions of all techniques
    ($({ $($row:tt)+ })+ $(
        $(#[$light_doc:meta])* $light:ident $([$corners:literal])? = $light_c:ident, $columns_c:ident { $($fields:tt)* } $(reflected {
            $(#[$lobe_doc:meta])* $lobe:ident $([$lobe_n:literal])? $(= $lobe_c:ident, $lobe_name:ident[$lobe_size:literal])?;
        })? by $default:literal {
            $($(#[$doc:meta])* $sampler:ident $([$n:literal])? $(= $sampler_c:ident, $name:ident[$size:literal])?: $by:ident $place:tt $($measure:ident)?;)+
        }
    )+) => {
        table! { @ $($([$lobe<f32 $(, $lobe_n)?> $(, $lobe_name)?])? $([$sampler<f32 $(, $n)?> $(, $name)?])+)+ $({ $($row)+ })+ }
    };
    (@ $([$sampler:ty $(, $name:ident)?])+ $({ $($row:tt)+ })+) => {
        table! { $($($name: LightFunctions<$sampler>,)?)+ $($($row)+,)+ }
    };
    ($($field:ident: $functions:ident<$type:ty>,)+) => {
        /// The functions of one level of instructions, over packets of one width.
        #[repr(C)]
        pub struct Table {
            $($field: $functions<$type>,)+
            pub(crate) tree: TreeFunctions,
            pub(crate) image: SamplerFunctions<ByRadiance<'static>>,
            pub(crate) placed: PlacedTable,
            pub(crate) maps: MapTable,
            pub(crate) reflections: ReflectionsFunction,
        }
        impl Table {
            /// The functions over packets `R`, with the instructions of this compilation.
            const fn of<R: Packet>() -> Self {
                Self {
                    $($field: $functions::of::<R>(),)+
                    tree: TreeFunctions::of::<R>(),
                    image: SamplerFunctions::of::<R>(),
                    placed: PlacedTable::of::<R>(),
                    maps: MapTable::of::<R>(),
                    reflections: kernel::reflections::<R>,
                }
            }
        }
        // SAFETY: the field holds the functions of this type
        $(unsafe impl InTable for $type {
            type Functions = $functions<$type>;
            #[inline]
            fn functions(table: &'static Table) -> &'static Self::Functions {
                &table.$field
            }
        })+
    };
}
macro_rules! with_warps {
    ($($(#[$doc:meta])* $warp:ident $([$r:tt] = $struct:ident)?, $name:ident: $numbers:tt -> $coordinates:literal;)+) => {
        with_warps!(@ $([$warp $([$r])?] $name)+);
    };
    (@ $([$($warp:tt)+] $name:ident)+) => {
        etendue::techniques!(table! {
            $({ $name: WarpFunctions<with_warps!(# $($warp)+)> })+
            { independent: SequenceFunctions<Independent> }
            { owen_sobol: SequenceFunctions<OwenSobol> }
            { joint_sobol: SequenceFunctions<JointSobol> }
            { stratified: SequenceFunctions<Stratified> }
        });
    };
    (# $warp:ident) => { $warp };
    (# $warp:ident [R]) => { $warp<f32> };
}
etendue::warps!(with_warps! {});

/// The functions of this compilation.
#[cfg_attr(feature = "level-v3", unsafe(export_name = "etendue_batch_v3"))]
#[cfg_attr(feature = "level-v4", unsafe(export_name = "etendue_batch_v4"))]
pub(crate) static TABLE: Table = Table::of::<Lanes>();

/// The packet of this compilation. Without fused multiply-add, a packet of eight gains little, as its multiply-add takes many instructions.
#[cfg(feature = "level-v4")]
pub(crate) type Lanes = etendue::f32x16;
#[cfg(all(not(feature = "level-v4"), any(target_feature = "fma", target_arch = "aarch64")))]
pub(crate) type Lanes = etendue::f32x8;
/// On WebAssembly, whose multiply-add is software, too, one register of four lanes takes two thirds of the time of single numbers.
#[cfg(all(not(feature = "level-v4"), target_feature = "simd128"))]
pub(crate) type Lanes = etendue::f32x4;
#[cfg(all(
    not(feature = "level-v4"),
    not(any(target_feature = "fma", target_arch = "aarch64", target_feature = "simd128"))
))]
pub(crate) type Lanes = f32;
