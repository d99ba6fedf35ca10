//! The functions of every level, in tables of the same form.

use crate::functions::{
    MapFunction, ReflectionsFunction, SequenceFunction, TechniqueFunctions, TreeFunctions, WarpFunctions,
};
use crate::kernel;
use crate::map::{MAPS, PortalDirection, ReflectedSphere, SeenThroughPortals};
use crate::packet::{IS_LONG, Lanes, Packet};
use crate::sequence::SEQUENCES;
use crate::technique::{self, TECHNIQUES};
use etendue::listed::warp::WARPS;
use etendue::reflection::Reflection;
use etendue::sequence::{Independent, JointSobol, OwenSobol, Stratified};
use etendue::warp::*;

/// The functions of one level of instructions, over packets of one width.
#[repr(C)]
pub struct FunctionTable {
    /// By the numbers of techniques; none of those of lights that are not built.
    pub(crate) techniques: [Option<&'static TechniqueFunctions>; TECHNIQUES],
    pub(crate) warps: [WarpFunctions; WARPS],
    pub(crate) maps: [MapFunction; MAPS],
    pub(crate) sequences: [SequenceFunction; SEQUENCES],
    pub(crate) tree: TreeFunctions,
    pub(crate) reflections: ReflectionsFunction,
}

/// Whether a light is built.
const fn is_built(light: &str) -> bool {
    match light.as_bytes() {
        b"Sphere" => cfg!(feature = "sphere"),
        b"Triangle" => cfg!(feature = "triangle"),
        b"Parallelogram" => cfg!(feature = "parallelogram"),
        b"Rectangle" => cfg!(feature = "rectangle"),
        b"Disk" => cfg!(feature = "disk"),
        b"Polygon" => cfg!(feature = "polygon"),
        b"BilinearPatch" => cfg!(feature = "patch"),
        b"Line" => cfg!(feature = "line"),
        b"Picture" => cfg!(feature = "picture"),
        b"Portals" => cfg!(feature = "portals"),
        b"Image" => cfg!(feature = "image"),
        // lights at infinity, and without extent
        _ => cfg!(feature = "sun"),
    }
}
/// The functions of a technique, if its light is built. A light whose sampler another technique has is prepared by that one, with the same
/// numbers.
macro_rules! entry {
    ($light:ident, $technique:ty $(, $size:literal)?) => {
        if is_built(stringify!($light)) { Some(const { &TechniqueFunctions::of::<$technique, R>() }) } else { None }
    };
    ($light:ident, $technique:ident, $sampler:ident, $place:tt, $size:literal) => {
        entry!($light, technique::$technique)
    };
    ($light:ident, $technique:ident, $sampler:ident, $place:tt) => {
        entry!($light, technique::$sampler)
    };
}
macro_rules! techniques {
    ($(
        $(#[$light_doc:meta])* $light:ident $([$corners:literal])? = $light_c:ident, $columns_c:ident { $($fields:tt)* } by $default:literal {
            $(
                $(#[$doc:meta])* $technique:ident, $name:ident -> $sampler:ident $([$n:literal])? $(= $sampler_c:ident[$size:literal])?: $by:ident $place:tt $($measure:ident)?;
            )+
        }
    )+) => {
        const fn techniques<R: Packet>() -> [Option<&'static TechniqueFunctions>; TECHNIQUES] {
            [
                $($(entry!($light, $technique, $sampler, $place $(, $size)?),)+)+
                entry!(Picture, technique::PictureByArea<'static>),
                entry!(Picture, technique::PictureBySolidAngle<'static>),
                entry!(Picture, technique::PictureByProjectedSolidAngle<'static>),
                entry!(Picture, technique::PictureOnSphereByVisibleArea<'static>),
                entry!(Portals, technique::PortalsByRadiance<'static>),
                entry!(Image, technique::ImageByRadiance<'static>),
            ]
        }
    };
}
etendue::techniques!(techniques! {});

macro_rules! warps {
    ($($(#[$doc:meta])* $warp:ident $([$r:tt] = $struct:ident)?, $name:ident: $coordinates:literal;)+) => {
        const fn warps<R: Packet>() -> [WarpFunctions; WARPS] {
            [$(WarpFunctions::of::<warps!(@ $warp $([$r])?), R>()),+]
        }
    };
    (@ $warp:ident) => { $warp };
    (@ $warp:ident [R]) => { $warp<f32> };
}
etendue::warps!(warps! {});

impl FunctionTable {
    /// The functions over packets `R`, with the instructions of this compilation. Each is at the number of its type.
    const fn of<R: Packet>() -> Self {
        Self {
            techniques: techniques::<R>(),
            warps: warps::<R>(),
            maps: [
                kernel::map::<ReflectedSphere, R>,
                kernel::map::<PortalDirection, R>,
                kernel::map::<SeenThroughPortals<'static>, R>,
            ],
            sequences: [
                kernel::pairs::<Independent, R>,
                kernel::pairs::<OwenSobol, R>,
                kernel::pairs::<JointSobol, R>,
                kernel::pairs::<Stratified, R>,
            ],
            tree: TreeFunctions::of::<R>(),
            reflections: kernel::reflections::<R>,
        }
    }
}

/// The functions of this compilation.
#[cfg_attr(feature = "level-v3", unsafe(export_name = "etendue_batch_v3"))]
#[cfg_attr(feature = "level-v4", unsafe(export_name = "etendue_batch_v4"))]
pub(crate) static TABLE: FunctionTable =
    if IS_LONG { FunctionTable::of::<f32>() } else { FunctionTable::of::<Lanes>() };
