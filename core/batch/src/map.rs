//! Functions of a few numbers that are no densities: what lights look up, over any kind of number.

use crate::kernel::Packet;
use crate::sealed::Sealed;
use crate::table::{MapFunctions, Table};
use etendue::light::{PortalEnvironment, PortalMap, Spread};
use etendue::reflection::Reflection;
use etendue::{Mask, Real, Vec2, Vec3};

/// The most numbers that a map takes.
pub const MOST_NUMBERS: usize = 6;
/// The most numbers that a map returns.
pub const MOST_RESULTS: usize = 4;

/// A function of a few numbers, with what it depends on in single or double precision.
pub trait BatchMap: Copy + Sealed {
    /// How many numbers it takes; those beyond are 0.
    const NUMBERS: usize;
    /// How many numbers it returns; those beyond are 0.
    const RESULTS: usize;
    /// Its results for numbers, and whether they hold.
    fn map<R: Real<Scalar = f32>>(&self, x: [R; MOST_NUMBERS]) -> ([R; MOST_RESULTS], R::Mask);
    /// The function over columns.
    fn map_functions(table: &'static Table) -> MapFunctions<Self>;
}

/// [`Reflection::sphere`].
#[derive(Clone, Copy, Debug)]
pub struct ReflectedSphere(pub Reflection<f32>);
/// [`PortalEnvironment::sees`].
#[derive(Clone, Copy, Debug)]
pub struct SeenThroughPortals<'a>(pub PortalEnvironment<'a>);

macro_rules! maps {
    ($(
        $(#[$doc:meta])* $field:ident: $name:ident $(<$lifetime:lifetime>)? $([$number:ty])?, $numbers:literal -> $results:literal,
        |$this:ident, $x:pat_param| $map:expr;
    )+) => {
        $(impl$(<$lifetime>)? Sealed for $name $(<$lifetime>)? $(<$number>)? {}
        impl$(<$lifetime>)? BatchMap for $name $(<$lifetime>)? $(<$number>)? {
            const NUMBERS: usize = $numbers;
            const RESULTS: usize = $results;
            #[inline(always)]
            fn map<R: Real<Scalar = f32>>(&self, $x: [R; MOST_NUMBERS]) -> ([R; MOST_RESULTS], R::Mask) {
                let $this = self;
                $map
            }
            #[inline]
            fn map_functions(table: &'static Table) -> MapFunctions<Self> {
                maps!(@ table.maps.$field, $name $(<$lifetime>)?)
            }
        })+
        /// The functions of one level of instructions.
        #[repr(C)]
        pub(crate) struct MapTable {
            $($field: maps!(# $name $(<$lifetime>)? $([$number])?),)+
        }
        impl MapTable {
            pub(crate) const fn of<R: Packet>() -> Self {
                Self { $($field: MapFunctions::of::<R>(),)+ }
            }
        }
    };
    (@ $functions:expr, $name:ident) => { $functions };
    (@ $functions:expr, $name:ident <$lifetime:lifetime>) => {
        // SAFETY: the types differ in how long the memory that they look into lives, and the functions keep nothing of it
        unsafe { core::mem::transmute::<MapFunctions<$name<'static>>, MapFunctions<Self>>($functions) }
    };
    (# $name:ident <$lifetime:lifetime>) => { MapFunctions<$name<'static>> };
    (# $name:ident [$number:ty]) => { MapFunctions<$name<$number>> };
    (# $name:ident) => { MapFunctions<$name> };
}

/// One result, which always holds.
#[inline(always)]
fn one<R: Real>(x: R) -> ([R; MOST_RESULTS], R::Mask) {
    let zero = R::lit(0.0);
    ([x, zero, zero, zero], R::Mask::splat(true))
}

maps! {
    spread: Spread[f32], 6 -> 1, |spread, [x, y, z, nx, ny, nz]|
        one(Spread::<R>::splat(*spread).attenuation(Vec3::new(x, y, z), Vec3::new(nx, ny, nz)));
    sphere: ReflectedSphere, 4 -> 1, |sphere, [x, y, z, radius, ..]| one(Reflection::<R>::splat(sphere.0).sphere(Vec3::new(x, y, z), radius));
    portal_map: PortalMap, 2 -> 4, |map, [u, v, ..]| {
        let (w, solid_angle) = PortalMap::direction(map, Vec2::new(u, v));
        ([w.x, w.y, w.z, solid_angle], R::Mask::splat(true))
    };
    seen: SeenThroughPortals<'a>, 6 -> 0, |portals, [px, py, pz, x, y, z]|
        ([R::lit(0.0); MOST_RESULTS], portals.0.sees(Vec3::new(px, py, pz), Vec3::new(x, y, z)));
}
