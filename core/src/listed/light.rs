//! Lights by techniques, as those see them who do something with all of the list.

use crate::lanewise::Lanewise;
use crate::light::{self, LightSampler};
use crate::real::Real;
use crate::reflection::Reflection;
use crate::vector::Vec3;
use core::fmt::Debug;

/// Lines of documentation.
pub type Lines = &'static [&'static str];

/// What the list says about a light by a technique.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Its place in the list.
    pub index: usize,
    /// The light, as the core calls its type.
    pub light: &'static str,
    /// What the light is.
    pub light_doc: Lines,
    /// The fields of the light.
    pub fields: &'static [Field],
    /// What hosts take of its techniques where none is named.
    pub default: &'static str,
    /// The name of both in words with `_` between.
    pub name: &'static str,
    /// The prepared light.
    pub sampler: &'static str,
    /// Whether no other technique has that.
    pub is_own: bool,
    /// The method that prepares it.
    pub by: &'static str,
    /// What it takes: the point, and something else or nothing.
    pub place: &'static [&'static str],
    /// What the technique is.
    pub doc: Lines,
    /// The method that returns what the technique is uniform over.
    pub measure: Option<&'static str>,
    /// Of how many numbers the light consists, and the prepared light.
    pub numbers: [usize; 2],
}
impl Entry {
    /// What it is prepared for beside the point.
    #[must_use]
    pub const fn with(&self) -> With {
        match self.place {
            [_, with] if with.len() == 1 => With::Normal,
            [_, _] => With::Reflection,
            _ => With::Nothing,
        }
    }
}

/// A field of a light.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// Its name.
    pub name: &'static str,
    /// The argument of hosts' constructors.
    pub argument: &'static str,
    /// Its kind: see the list.
    pub kind: &'static str,
    /// What it is.
    pub doc: Lines,
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
pub trait Technique: Copy + Debug + Sealed {
    /// What the list says about it.
    const ENTRY: Entry;
    /// The light over numbers, packets of numbers, or columns.
    type Light<X: Copy>: Copy;
    /// What it is prepared for beside the point.
    type With<X: Copy>: Copy;
    /// The light prepared for a point.
    type Sampler: ListedSampler;
    /// The light, of its numbers in the order of its fields.
    fn light<X: Copy>(numbers: &mut dyn FnMut() -> X) -> Self::Light<X>;
    /// What it is prepared for beside the point, of its numbers in order.
    fn with<X: Copy>(numbers: &mut dyn FnMut() -> X) -> Self::With<X>;
    /// The light with `f` applied to each of its numbers.
    fn map_light<X: Copy, Y: Copy>(light: Self::Light<X>, f: impl FnMut(X) -> Y) -> Self::Light<Y>;
    /// What it is prepared for, with `f` applied to each of its numbers.
    fn map_with<X: Copy, Y: Copy>(with: Self::With<X>, f: impl FnMut(X) -> Y) -> Self::With<Y>;
    /// Prepares for the point `p`.
    fn prepare<R: Real>(light: Self::Light<R>, p: Vec3<R>, with: Self::With<R>) -> Prepared<Self, R>;
    /// The same in single numbers.
    fn prepare_one(light: Self::Light<f32>, p: Vec3<f32>, with: Self::With<f32>) -> Self::Sampler;
    /// What the technique is uniform over, where it has that.
    fn measure<R: Real>(sampler: &Prepared<Self, R>) -> Option<R>;
}

/// A light by a technique, prepared over packets.
pub type Prepared<T, R> = <<T as Technique>::Sampler as ListedSampler>::Over<R>;

/// A light prepared for a point, in numbers of single precision.
pub trait ListedSampler: Copy + Lanewise<f32> + Sealed {
    /// The number of the technique of which it is.
    const INDEX: usize;
    /// The same over packets.
    type Over<R: Real>: LightSampler<R> + Copy + Debug;
    /// The same in every lane of a packet.
    fn over<R: Real<Scalar = f32>>(self) -> Self::Over<R>;
    /// The prepared light with `f` applied to each of its numbers.
    fn map_over<R: Real>(sampler: Self::Over<R>, f: &mut dyn FnMut(R) -> R) -> Self::Over<R>;
}

mod sealed {
    /// Hosts take memory as written by these types, without a look, so that no others may have the traits.
    pub trait Sealed {}
}
pub(crate) use sealed::Sealed;

/// Something to do with each technique.
pub trait TechniqueVisitor {
    /// Does it.
    fn visit<T: Technique>(&mut self);
}

fn vec3<X>(next: &mut dyn FnMut() -> X) -> Vec3<X> {
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
/// The type of what a technique is prepared for beside the point, how it is made of numbers, and how they change.
macro_rules! with {
    (type (p, n), $x:ident) => {
        Vec3<$x>
    };
    (type (p, reflection), $x:ident) => {
        Reflection<$x>
    };
    (type $place:tt, $x:ident) => {
        ()
    };
    (of (p, n), $next:ident) => {
        vec3($next)
    };
    (of (p, reflection), $next:ident) => {
        Reflection::<f32>::default().map(|_| $next())
    };
    (of $place:tt, $next:ident) => {{
        let _ = $next;
    }};
    (map (p, $kind:ident), $with:ident, $f:ident) => {
        $with.map($f)
    };
    (map $place:tt, $with:ident, $f:ident) => {{
        let _ = ($with, $f);
    }};
}
/// A light of the list.
trait Listed<X> {
    const DOC: Lines;
    const FIELDS: &'static [Field];
    const DEFAULT: &'static str;
    fn listed(next: &mut dyn FnMut() -> X) -> Self;
}
macro_rules! list {
    ($(
        $(#[doc = $light_doc:literal])* $light:ident $([$corners:literal])? = $light_c:ident, $columns_c:ident {
            $($(#[doc = $field_doc:literal])* $field:ident as $argument:ident: $kind:ident,)+
        } by $default:literal {
            $(
                $(#[doc = $doc:literal])* $technique:ident, $name:ident -> $sampler:ident $([$n:literal])? $(= $sampler_c:ident[$size:literal])?: $by:ident $place:tt $($measure:ident)?;
            )+
        }
    )+) => {
        enum Number {
            $($($technique,)+)+
        }
        /// How many techniques there are.
        pub const TECHNIQUES: usize = [$($(Number::$technique,)+)+].len();
        $(impl<X: Copy> Listed<X> for light::$light<X $(, $corners)?> {
            const DOC: Lines = &[$($light_doc),*];
            const FIELDS: &'static [Field] = &[$(Field {
                name: stringify!($field),
                argument: stringify!($argument),
                kind: stringify!($kind),
                doc: &[$($field_doc),*],
            }),+];
            const DEFAULT: &'static str = $default;
            fn listed(next: &mut dyn FnMut() -> X) -> Self {
                light::$light { $($field: field!(next, $kind)),+ }
            }
        })+
        /// The techniques.
        pub mod technique {
            $($(
                $(#[doc = $doc])*
                #[derive(Clone, Copy, Debug)]
                pub struct $technique;
            )+)+
        }
        $($(
            impl Sealed for technique::$technique {}
            impl Technique for technique::$technique {
                const ENTRY: Entry = Entry {
                    index: Number::$technique as usize,
                    light: stringify!($light),
                    light_doc: <Self::Light<f32> as Listed<f32>>::DOC,
                    fields: <Self::Light<f32> as Listed<f32>>::FIELDS,
                    default: <Self::Light<f32> as Listed<f32>>::DEFAULT,
                    name: stringify!($name),
                    sampler: stringify!($sampler),
                    is_own: !concat!($(stringify!($sampler_c))?).is_empty(),
                    by: stringify!($by),
                    place: list!(@place $place),
                    doc: &[$($doc),*],
                    measure: list!(@some $(stringify!($measure))?),
                    numbers: [size_of::<Self::Light<f32>>() / 4, size_of::<Self::Sampler>() / 4],
                };
                type Light<X: Copy> = light::$light<X $(, $n)?>;
                type With<X: Copy> = with!(type $place, X);
                type Sampler = light::$sampler<f32 $(, $n)?>;
                fn light<X: Copy>(next: &mut dyn FnMut() -> X) -> Self::Light<X> {
                    Listed::listed(next)
                }
                fn with<X: Copy>(next: &mut dyn FnMut() -> X) -> Self::With<X> {
                    with!(of $place, next)
                }
                #[inline(always)]
                fn map_light<X: Copy, Y: Copy>(light: Self::Light<X>, f: impl FnMut(X) -> Y) -> Self::Light<Y> {
                    light.map(f)
                }
                #[inline(always)]
                fn map_with<X: Copy, Y: Copy>(with: Self::With<X>, f: impl FnMut(X) -> Y) -> Self::With<Y> {
                    with!(map $place, with, f)
                }
                #[inline(always)]
                fn prepare<R: Real>(light: Self::Light<R>, p: Vec3<R>, with: Self::With<R>) -> Prepared<Self, R> {
                    let _ = (p, &with);
                    crate::prepared!(light, $by $place, p: p, n: with, reflection: &with)
                }
                #[inline(always)]
                fn prepare_one(light: Self::Light<f32>, p: Vec3<f32>, with: Self::With<f32>) -> Self::Sampler {
                    Self::prepare::<f32>(light, p, with)
                }
                fn measure<R: Real>(sampler: &Prepared<Self, R>) -> Option<R> {
                    let _ = sampler;
                    list!(@some $(sampler.$measure())?)
                }
            }
            list!(@own $technique, $sampler $([$n])? $(, $size)?);
        )+)+
        /// What the list says of all, in its order.
        pub const ENTRIES: [Entry; TECHNIQUES] = [$($(technique::$technique::ENTRY,)+)+];
        /// Calls the visitor for each light by each technique, in the order of the list.
        pub fn every_technique(visitor: &mut impl TechniqueVisitor) {
            $($(visitor.visit::<technique::$technique>();)+)+
        }
    };
    (@place ($($place:ident),*)) => {
        &[$(stringify!($place)),*]
    };
    (@some) => {
        None
    };
    (@some $some:expr) => {
        Some($some)
    };
    // the sampler of another technique
    (@own $technique:ident, $sampler:ident $([$n:literal])?) => {};
    (@own $technique:ident, $sampler:ident $([$n:literal])?, $size:literal) => {
        impl Sealed for light::$sampler<f32 $(, $n)?> {}
        impl ListedSampler for light::$sampler<f32 $(, $n)?> {
            const INDEX: usize = Number::$technique as usize;
            type Over<R: Real> = light::$sampler<R $(, $n)?>;
            #[inline(always)]
            fn over<R: Real<Scalar = f32>>(self) -> Self::Over<R> {
                Lanewise::splat(self)
            }
            fn map_over<R: Real>(sampler: Self::Over<R>, f: &mut dyn FnMut(R) -> R) -> Self::Over<R> {
                sampler.map(f)
            }
        }
    };
}
crate::techniques!(list! {});
