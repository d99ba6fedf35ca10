//! Every light by every technique, and every warp: what the lists of the core have, in a form that one generic function can go through.

use core::fmt::Debug;
use etendue::light::*;
use etendue::reflection::Reflection;
use etendue::warp::*;
use etendue::{Lanewise, LightSampler, Real, Vec2, Vec3};

/// What the list says about a light by a technique.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// The light, as the core calls its type.
    pub light: &'static str,
    /// What the light is.
    pub light_doc: &'static [&'static str],
    /// The name of each field of the light, and what it is.
    pub fields: &'static [(&'static str, &'static [&'static str])],
    /// The method that prepares it.
    pub by: &'static str,
    /// What the technique is.
    pub doc: &'static [&'static str],
    /// Whether the preparation takes the shading point.
    pub at_point: bool,
    /// What else it takes.
    pub with: With,
    /// The method that returns what the technique is uniform over.
    pub measure: Option<&'static str>,
}

/// What a light is prepared for beside the shading point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum With {
    /// Nothing.
    Nothing,
    /// The unit normal of the surface there.
    Normal,
    /// What the surface reflects.
    Reflection,
}

/// A light by a technique.
pub trait Technique {
    /// The light.
    type Light<R: Real>: Copy + Debug;
    /// What it is prepared for beside the point.
    type With<R: Real>: Copy + Debug;
    /// The light prepared for a point.
    type Sampler<R: Real>: LightSampler<R> + Copy + Debug;
    /// What the list says about it.
    const ENTRY: Entry;
    /// The light with its numbers in the order of its fields.
    fn light<R: Real>(numbers: &mut dyn FnMut() -> R) -> Self::Light<R>;
    /// What it is prepared for beside the point, of its numbers in order.
    fn with<R: Real>(numbers: &mut dyn FnMut() -> R) -> Self::With<R>;
    /// Prepares for the point `p`.
    fn prepare<R: Real>(light: &Self::Light<R>, p: Vec3<R>, with: Self::With<R>) -> Self::Sampler<R>;
    /// The prepared light with `f` applied to each of its numbers.
    fn map<R: Real>(sampler: Self::Sampler<R>, f: &mut dyn FnMut(R) -> R) -> Self::Sampler<R>;
    /// What the technique is uniform over, where it has that.
    fn measure<R: Real>(sampler: &Self::Sampler<R>) -> Option<R>;
}

/// Something to do with each technique.
pub trait TechniqueVisitor {
    /// Does it.
    fn visit<T: Technique>(&mut self);
}

/// A light of the list.
trait Listed<R> {
    const DOC: &'static [&'static str];
    const FIELDS: &'static [(&'static str, &'static [&'static str])];
    fn listed(next: &mut dyn FnMut() -> R) -> Self;
}

fn vec3<R: Real>(next: &mut dyn FnMut() -> R) -> Vec3<R> {
    let (x, y, z) = (next(), next(), next());
    Vec3::new(x, y, z)
}
macro_rules! field {
    ($next:ident, number) => {
        $next()
    };
    ($next:ident, corners) => {
        core::array::from_fn(|_| vec3($next))
    };
    ($next:ident, $kind:ident) => {
        vec3($next)
    };
}
/// Whether the preparation takes the point, what else it takes, the type of that, how it is made of numbers, and how it is passed.
macro_rules! takes {
    (point ()) => {
        false
    };
    (point $place:tt) => {
        true
    };
    (with (p, n)) => {
        With::Normal
    };
    (with (p, reflection)) => {
        With::Reflection
    };
    (with $place:tt) => {
        With::Nothing
    };
    (type (p, n) $r:ident) => {
        Vec3<$r>
    };
    (type (p, reflection) $r:ident) => {
        Reflection<$r>
    };
    (type $place:tt $r:ident) => {
        ()
    };
    (of (p, n) $r:ident, $next:ident) => {
        vec3($next)
    };
    (of (p, reflection) $r:ident, $next:ident) => {
        Reflection::<$r>::default().map(|_| $next())
    };
    (of $place:tt $r:ident, $next:ident) => {{
        let _ = $next;
    }};
}
macro_rules! measure {
    ($sampler:ident) => {{
        let _ = $sampler;
        None
    }};
    ($sampler:ident, $measure:ident) => {
        Some($sampler.$measure())
    };
}
macro_rules! measure_name {
    () => {
        None
    };
    ($measure:ident) => {
        Some(stringify!($measure))
    };
}

macro_rules! techniques {
    ($(
        $(#[doc = $light_doc:literal])* $light:ident $([$corners:literal])? = $light_c:ident, $columns_c:ident {
            $($(#[doc = $field_doc:literal])* $field:ident as $argument:ident: $kind:ident,)+
        } by $default:literal {
            $(
                $(#[doc = $doc:literal])* $technique:ident, $name:ident -> $sampler:ident $([$n:literal])? $(= $sampler_c:ident[$size:literal])?: $by:ident $place:tt $($measure:ident)?;
            )+
        }
    )+) => {
        $(impl<R: Real> Listed<R> for $light<R $(, $corners)?> {
            const DOC: &'static [&'static str] = &[$($light_doc),*];
            const FIELDS: &'static [(&'static str, &'static [&'static str])] =
                &[$((stringify!($field), &[$($field_doc),*])),+];
            fn listed(next: &mut dyn FnMut() -> R) -> Self {
                $light { $($field: field!(next, $kind)),+ }
            }
        })+
        /// Calls the visitor for each light by each technique, in the order of the list.
        pub fn every_technique(visitor: &mut impl TechniqueVisitor) {
            $($({
                struct ListedTechnique;
                impl Technique for ListedTechnique {
                    type Light<R: Real> = $light<R $(, $n)?>;
                    type With<R: Real> = takes!(type $place R);
                    type Sampler<R: Real> = $sampler<R $(, $n)?>;
                    const ENTRY: Entry = Entry {
                        light: stringify!($light),
                        light_doc: <$light<f32 $(, $n)?> as Listed<f32>>::DOC,
                        fields: <$light<f32 $(, $n)?> as Listed<f32>>::FIELDS,
                        by: stringify!($by),
                        doc: &[$($doc),*],
                        at_point: takes!(point $place),
                        with: takes!(with $place),
                        measure: measure_name!($($measure)?),
                    };
                    fn light<R: Real>(next: &mut dyn FnMut() -> R) -> Self::Light<R> {
                        Listed::listed(next)
                    }
                    fn with<R: Real>(next: &mut dyn FnMut() -> R) -> Self::With<R> {
                        takes!(of $place R, next)
                    }
                    fn prepare<R: Real>(light: &Self::Light<R>, p: Vec3<R>, with: Self::With<R>) -> Self::Sampler<R> {
                        let _ = (p, &with);
                        etendue::prepared!(light, $by $place, p: p, n: with, reflection: &with)
                    }
                    fn map<R: Real>(sampler: Self::Sampler<R>, f: &mut dyn FnMut(R) -> R) -> Self::Sampler<R> {
                        sampler.map(f)
                    }
                    fn measure<R: Real>(sampler: &Self::Sampler<R>) -> Option<R> {
                        measure!(sampler $(, $measure)?)
                    }
                }
                visitor.visit::<ListedTechnique>();
            })+)+
        }
    };
}
etendue::techniques!(techniques! {});

/// What the list says about a warp.
#[derive(Clone, Copy, Debug)]
pub struct WarpEntry {
    /// Its name in words with `_` between.
    pub name: &'static str,
    /// What it is.
    pub doc: &'static [&'static str],
    /// How many coordinates a point has.
    pub coordinates: usize,
    /// Whether its struct has all of its numbers, as lights are prepared for it.
    pub whole: bool,
    /// Names of the numbers that it is prepared from, if it has to be.
    pub prepared_from: &'static [(&'static str, usize)],
}

/// A warp.
pub trait WarpTechnique {
    /// The warp with its parameters.
    type Of<R: Real>: Copy + Debug;
    /// What the list says about it.
    const ENTRY: WarpEntry;
    /// The warp of these numbers: its parameters, or what it is prepared from.
    fn warp<R: Real>(numbers: &mut dyn FnMut() -> R) -> Self::Of<R>;
    /// The warp with `f` applied to each of its numbers.
    fn map<R: Real>(warp: Self::Of<R>, f: &mut dyn FnMut(R) -> R) -> Self::Of<R>;
    /// Maps random numbers to a point.
    fn sample<R: Real>(warp: &Self::Of<R>, u: Vec2<R>) -> Vec<R>;
    /// The pdf of a point.
    fn pdf<R: Real>(warp: &Self::Of<R>, point: &[R]) -> R;
    /// The random numbers that map to a point.
    fn invert<R: Real>(warp: &Self::Of<R>, point: &[R]) -> Vec2<R>;
}

/// Something to do with each warp.
pub trait WarpVisitor {
    /// Does it.
    fn visit<W: WarpTechnique>(&mut self);
}

trait Point<R: Real> {
    fn coordinates(self) -> Vec<R>;
    fn from_coordinates(coordinates: &[R]) -> Self;
}
impl<R: Real> Point<R> for Vec2<R> {
    fn coordinates(self) -> Vec<R> {
        vec![self.x, self.y]
    }
    fn from_coordinates(of: &[R]) -> Self {
        Self::new(of[0], of[1])
    }
}
impl<R: Real> Point<R> for Vec3<R> {
    fn coordinates(self) -> Vec<R> {
        vec![self.x, self.y, self.z]
    }
    fn from_coordinates(of: &[R]) -> Self {
        Self::new(of[0], of[1], of[2])
    }
}

/// How a warp is made of numbers: in the order of its fields, unless its fields are private.
macro_rules! made {
    ($next:ident, GgxVisibleNormals) => {{
        let (alpha_x, alpha_y) = ($next(), $next());
        GgxVisibleNormals::new(alpha_x, alpha_y, vec3($next))
    }};
    ($next:ident, $warp:ident) => {
        $warp::<R>::default().map(|_| $next())
    };
}
macro_rules! whole {
    (Reflection) => {
        true
    };
    ($warp:ident) => {
        false
    };
}
macro_rules! made_of {
    (GgxVisibleNormals) => {
        &[("alpha_x", 1), ("alpha_y", 1), ("wi", 3)]
    };
    ($warp:ident) => {
        &[]
    };
}
macro_rules! warps {
    ($($(#[doc = $doc:literal])* $name:ident $([$packets:tt] = $struct:ident)?, $module:ident: $coordinates:literal;)+) => {
        /// Calls the visitor for each warp, in the order of the list.
        pub fn every_warp(visitor: &mut impl WarpVisitor) {
            $({
                struct ListedWarp;
                impl WarpTechnique for ListedWarp {
                    const ENTRY: WarpEntry = WarpEntry {
                        name: stringify!($module),
                        doc: &[$($doc),*],
                        coordinates: $coordinates,
                        whole: whole!($name),
                        prepared_from: made_of!($name),
                    };
                    warps!(@type $name $([$packets])?);
                    fn sample<R: Real>(warp: &Self::Of<R>, u: Vec2<R>) -> Vec<R> {
                        Point::coordinates(Warp::sample(warp, u))
                    }
                    fn pdf<R: Real>(warp: &Self::Of<R>, point: &[R]) -> R {
                        Warp::pdf(warp, Point::from_coordinates(point))
                    }
                    fn invert<R: Real>(warp: &Self::Of<R>, point: &[R]) -> Vec2<R> {
                        Warp::invert(warp, Point::from_coordinates(point))
                    }
                }
                visitor.visit::<ListedWarp>();
            })+
        }
    };
    (@type $name:ident) => {
        type Of<R: Real> = $name;
        fn warp<R: Real>(_: &mut dyn FnMut() -> R) -> $name {
            $name
        }
        fn map<R: Real>(warp: $name, _: &mut dyn FnMut(R) -> R) -> $name {
            warp
        }
    };
    (@type $name:ident [$packets:tt]) => {
        type Of<R: Real> = $name<R>;
        fn warp<R: Real>(next: &mut dyn FnMut() -> R) -> $name<R> {
            made!(next, $name)
        }
        fn map<R: Real>(warp: $name<R>, f: &mut dyn FnMut(R) -> R) -> $name<R> {
            warp.map(f)
        }
    };
}
etendue::warps!(warps! {});
