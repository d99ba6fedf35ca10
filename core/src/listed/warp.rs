//! Warps, as those see them who do something with all of the list.

use crate::lanewise::Lanewise;
use crate::listed::light::{Lines, Sealed};
use crate::real::Real;
use crate::reflection::Reflection;
use crate::vector::{Vec2, Vec3};
use crate::warp::*;
use core::fmt::Debug;

/// What the list says about a warp.
#[derive(Clone, Copy, Debug)]
pub struct WarpEntry {
    /// Its place in the list.
    pub index: usize,
    /// Its type.
    pub warp: &'static str,
    /// Its name in words with `_` between.
    pub name: &'static str,
    /// What it is.
    pub doc: Lines,
    /// How many coordinates a point has.
    pub coordinates: usize,
    /// Of how many numbers it consists.
    pub numbers: usize,
}

/// A warp in numbers of single precision.
pub trait ListedWarp: Copy + Debug + Sealed {
    /// What the list says about it.
    const ENTRY: WarpEntry;
    /// The warp over packets.
    type Of<R: Real>: Warp<R, Point: Coordinates<R>> + Copy + Debug;
    /// The warp in every lane of a packet.
    fn over<R: Real<Scalar = f32>>(self) -> Self::Of<R>;
    /// The warp of its parameters in the order of its fields, or of what it is prepared from where these are private.
    fn warp<R: Real>(numbers: &mut dyn FnMut() -> R) -> Self::Of<R>;
    /// The warp with `f` applied to each of its numbers.
    fn map<R: Real>(warp: Self::Of<R>, f: &mut dyn FnMut(R) -> R) -> Self::Of<R>;
}

/// A point as three coordinates, of which that of the plane has two.
pub trait Coordinates<R> {
    /// The coordinates; what is beyond is 0.
    fn coordinates(self) -> [R; 3];
    /// The point of these.
    fn from_coordinates(coordinates: [R; 3]) -> Self;
}
impl<R: Real> Coordinates<R> for Vec2<R> {
    #[inline(always)]
    fn coordinates(self) -> [R; 3] {
        [self.x, self.y, R::lit(0.0)]
    }
    #[inline(always)]
    fn from_coordinates([x, y, _]: [R; 3]) -> Self {
        Self::new(x, y)
    }
}
impl<R: Real> Coordinates<R> for Vec3<R> {
    #[inline(always)]
    fn coordinates(self) -> [R; 3] {
        self.to_array()
    }
    #[inline(always)]
    fn from_coordinates([x, y, z]: [R; 3]) -> Self {
        Self::new(x, y, z)
    }
}

/// Something to do with each warp.
pub trait WarpVisitor {
    /// Does it.
    fn visit<W: ListedWarp>(&mut self);
}

macro_rules! list {
    ($($(#[doc = $doc:literal])* $name:ident $([$packets:tt] = $struct:ident)?, $module:ident: $coordinates:literal;)+) => {
        enum Number {
            $($name,)+
        }
        /// How many warps there are.
        pub const WARPS: usize = [$(Number::$name),+].len();
        $(impl Sealed for list!(@type $name $([$packets])?; f32) {}
        impl ListedWarp for list!(@type $name $([$packets])?; f32) {
            const ENTRY: WarpEntry = WarpEntry {
                index: Number::$name as usize,
                warp: stringify!($name),
                name: stringify!($module),
                doc: &[$($doc),*],
                coordinates: $coordinates,
                numbers: size_of::<Self>() / 4,
            };
            list!(@over $name $([$packets])?);
        })+
        /// What the list says of all, in its order.
        pub const ENTRIES: [WarpEntry; WARPS] = [$(<list!(@type $name $([$packets])?; f32)>::ENTRY),+];
        /// Calls the visitor for each warp, in the order of the list.
        pub fn every_warp(visitor: &mut impl WarpVisitor) {
            $(visitor.visit::<list!(@type $name $([$packets])?; f32)>();)+
        }
    };
    (@type $name:ident; $r:ident) => {
        $name
    };
    (@type $name:ident [R]; $r:ident) => {
        $name<$r>
    };
    (@over $name:ident) => {
        type Of<R: Real> = $name;
        #[inline(always)]
        fn over<R: Real<Scalar = f32>>(self) -> Self {
            self
        }
        fn warp<R: Real>(_: &mut dyn FnMut() -> R) -> Self {
            $name
        }
        fn map<R: Real>(warp: Self, _: &mut dyn FnMut(R) -> R) -> Self {
            warp
        }
    };
    (@over $name:ident [R]) => {
        type Of<R: Real> = $name<R>;
        #[inline(always)]
        fn over<R: Real<Scalar = f32>>(self) -> $name<R> {
            Lanewise::splat(self)
        }
        fn warp<R: Real>(next: &mut dyn FnMut() -> R) -> $name<R> {
            list!(@of $name, next)
        }
        fn map<R: Real>(warp: $name<R>, f: &mut dyn FnMut(R) -> R) -> $name<R> {
            warp.map(f)
        }
    };
    (@of GgxVisibleNormals, $next:ident) => {{
        let [alpha_x, alpha_y, x, y, z] = [(); 5].map(|()| $next());
        GgxVisibleNormals::new(alpha_x, alpha_y, Vec3::new(x, y, z))
    }};
    (@of $name:ident, $next:ident) => {
        $name::<f32>::default().map(|_| $next())
    };
}
crate::warps!(list! {});
