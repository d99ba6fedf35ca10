//! The number type that records what a routine computes.
//!
//! A routine runs once, and all its paths are recorded: a mask that is not constant counts as neither all true nor all false, as in a packet
//! whose lanes differ; a skip of what all lanes do without, by `all`, is left out. What a routine asks of one lane (a number to compare in an `if`, the bits of a mask, a lane as f64) is known for
//! constants alone; to ask it of anything else panics.

use crate::graph::{Call, Graph, Id, Kind, ONE_MINUS_EPSILON, Op, ZERO};
use core::cmp::Ordering;
use core::fmt;
use core::ops::{Add, AddAssign, BitAnd, BitOr, BitXor, Div, Mul, MulAssign, Neg, Not, Sub, SubAssign};
use etendue::real::Blend;
use etendue::{Mask, Real, Uint};
use std::cell::RefCell;

thread_local! {
    static GRAPH: RefCell<Graph> = RefCell::new(Graph::default());
}

fn with<T>(f: impl FnOnce(&mut Graph) -> T) -> T {
    GRAPH.with_borrow_mut(f)
}
fn add(op: Op, of: &[Id]) -> Id {
    with(|graph| graph.add(op, of))
}

/// Runs a routine on recorded numbers, and returns its result with the graph. One routine of a thread at a time.
pub fn record<T>(routine: impl FnOnce() -> T) -> (T, Graph) {
    with(|graph| *graph = Graph::default());
    let result = routine();
    (result, with(std::mem::take))
}

/// A number that is recorded; the functions of [`Call`] are called.
#[derive(Clone, Copy, Default, PartialEq)]
pub struct Number(Id);
/// The same, but these functions are written out: for their own bodies.
#[derive(Clone, Copy, Default, PartialEq)]
pub struct Inner(Id);
/// A truth value that is recorded.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Truth(Id);
/// A word that is recorded.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Word(Id);

macro_rules! recorded {
    ($($name:ident)+) => {$(
        impl $name {
            /// The node.
            #[must_use]
            pub fn id(self) -> Id {
                self.0
            }
        }
        /// The node, so that the `Debug` of a struct tells which of its fields is which.
        impl fmt::Debug for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "#{}", self.0)
            }
        }
    )+};
}
recorded!(Number Inner Truth Word);

macro_rules! binary {
    ($name:ident: $($trait:ident $method:ident $op:ident)+) => {$(
        impl $trait for $name {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Self(add(Op::$op, &[self.0, other.0]))
            }
        }
    )+};
}
binary!(Truth: BitAnd bitand And BitOr bitor Or BitXor bitxor Xor);
binary!(Word: BitAnd bitand WordAnd BitOr bitor WordOr BitXor bitxor WordXor);

/// Methods that are one operation each: what they take and return, and which.
macro_rules! operations {
    ($($method:ident($($other:ident: $of:ty),*) -> $result:ident = $op:ident;)+) => {$(
        fn $method(self $(, $other: $of)*) -> $result {
            $result(add(Op::$op, &[self.0 $(, $other.0)*]))
        }
    )+};
}

impl Not for Truth {
    type Output = Self;
    fn not(self) -> Self {
        Self(add(Op::Not, &[self.0]))
    }
}

impl Mask for Truth {
    fn splat(value: bool) -> Self {
        Self(with(|graph| graph.add_truth(value)))
    }
    fn from_bits(bits: u32) -> Self {
        Self::splat(bits & 1 == 1)
    }
    fn bits(self) -> u32 {
        let known = with(|graph| graph.truth(self.0));
        u32::from(known.expect("a routine asks for the bits of a mask that is not constant: it cannot be recorded"))
    }
    fn any(self) -> bool {
        let known = with(|graph| graph.truth(self.0));
        known.expect(
            "a routine branches by `any` on a mask that is not constant, and not by `where_any`: it cannot be recorded",
        )
    }
    fn all(self) -> bool {
        with(|graph| graph.truth(self.0)).unwrap_or(false)
    }
}

impl Uint for Word {
    const LANES: usize = 1;
    fn splat(value: u32) -> Self {
        Self(with(|graph| graph.add_word(value)))
    }
    fn from_fn(mut f: impl FnMut(usize) -> u32) -> Self {
        Self::splat(f(0))
    }
    fn lane(self, i: usize) -> u32 {
        let known = with(|graph| graph.word([self.0][i]));
        known.expect("a routine asks for a lane of a counter that is not constant: it cannot be recorded")
    }
    operations! {
        wrapping_add(other: Self) -> Self = WordAdd;
        wrapping_sub(other: Self) -> Self = WordSub;
        wrapping_mul(other: Self) -> Self = WordMul;
        reverse_bits() -> Self = WordReverse;
        lt(other: Self) -> Self = WordLess;
    }
    fn shl(self, bits: u32) -> Self {
        Self(add(Op::WordShl(bits), &[self.0]))
    }
    fn shr(self, bits: u32) -> Self {
        Self(add(Op::WordShr(bits), &[self.0]))
    }
    fn any(self) -> bool {
        Truth(add(Op::WordAny, &[self.0])).any()
    }
}

impl Number {
    /// The number at an index in the memory of a source: one sequence of words with all tables. A parameter of a routine is the word at which
    /// its table begins.
    #[must_use]
    pub fn load(index: Word) -> Self {
        Self(add(Op::FromBits, &[add(Op::Load, &[index.0])]))
    }
}
impl Word {
    /// A word that a routine is given.
    #[must_use]
    pub fn input(index: u32) -> Self {
        Self(with(|graph| graph.input(Kind::Word, index)))
    }
}
impl Truth {
    /// A truth value that a routine is given.
    #[must_use]
    pub fn input(index: u32) -> Self {
        Self(with(|graph| graph.input(Kind::Truth, index)))
    }
}

/// Lets a closure choose what a branch has computed.
fn branch<T>(mask: Truth, choose: impl FnOnce() -> T) -> T {
    let from = with(|graph| graph.nodes().len());
    let chosen = choose();
    with(|graph| graph.branch(mask.0, from));
    chosen
}

macro_rules! real {
    ($name:ident { $($functions:tt)* }) => {
        binary!($name: Add add Add Sub sub Sub Mul mul Mul Div div Div);
        impl Neg for $name {
            type Output = Self;
            fn neg(self) -> Self {
                Self(add(Op::Neg, &[self.0]))
            }
        }
        impl AddAssign for $name {
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }
        impl SubAssign for $name {
            fn sub_assign(&mut self, other: Self) {
                *self = *self - other;
            }
        }
        impl MulAssign for $name {
            fn mul_assign(&mut self, other: Self) {
                *self = *self * other;
            }
        }
        impl PartialOrd for $name {
            fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
                self.known("compares two numbers").partial_cmp(&other.known("compares two numbers"))
            }
        }
        impl $name {
            /// A number that a routine is given.
            #[must_use]
            pub fn input(index: u32) -> Self {
                Self(with(|graph| graph.input(Kind::Real, index)))
            }
            fn known(self, asked: &str) -> f32 {
                let known = with(|graph| graph.constant(self.0));
                known.unwrap_or_else(|| panic!("a routine {asked} in one lane that is not constant: it cannot be recorded"))
            }
        }
        impl Real for $name {
            type Scalar = Self;
            type Mask = Truth;
            type Uint = Word;
            const LANES: usize = 1;
            const DOUBLE: bool = false;
            const ZERO: Self = Self(ZERO);
            const ONE_MINUS_EPSILON: Self = Self(ONE_MINUS_EPSILON);
            fn splat(value: Self) -> Self {
                value
            }
            fn lit(value: f64) -> Self {
                Self(with(|graph| graph.real(value as f32)))
            }
            fn from_fn(mut f: impl FnMut(usize) -> Self) -> Self {
                f(0)
            }
            fn lane(self, i: usize) -> Self {
                [self][i]
            }
            fn lane_f64(self, i: usize) -> f64 {
                f64::from([self][i].known("takes a number"))
            }
            operations! {
                lt(other: Self) -> Truth = Less;
                le(other: Self) -> Truth = LessEqual;
                lesser(other: Self) -> Self = Lesser;
                greater(other: Self) -> Self = Greater;
                abs() -> Self = Abs;
                copysign(sign: Self) -> Self = CopySign;
                sqrt() -> Self = Sqrt;
                round_ties_even() -> Self = Round;
                mul_add(a: Self, b: Self) -> Self = MulAdd;
                pow2_scale() -> Self = Pow2Scale;
                to_uint() -> Word = ToWord;
                inverse_cbrt_estimate() -> Self = InverseCbrtEstimate;
            }
            fn blend(mask: Truth, yes: Self, no: Self) -> Self {
                Self(add(Op::Select, &[mask.0, yes.0, no.0]))
            }
            fn blend_uint(mask: Truth, yes: Word, no: Word) -> Word {
                Word(add(Op::Select, &[mask.0, yes.0, no.0]))
            }
            fn keep(self, mask: Truth) -> Self {
                Self(add(Op::Select, &[mask.0, self.0, ZERO]))
            }
            fn negate_where(self, mask: Truth) -> Self {
                Self(add(Op::Select, &[mask.0, (-self).0, self.0]))
            }
            fn unit(bits: Word) -> Self {
                Self(add(Op::Unit, &[bits.0]))
            }
            fn from_uint(value: Word) -> Self {
                Self(add(Op::FromWord, &[value.0]))
            }
            fn has_bits(value: Word) -> Truth {
                Truth(add(Op::WordAny, &[value.0]))
            }
            fn where_any<T: Blend<Self>>(mask: Truth, none: T, some: impl FnOnce() -> T) -> T {
                if with(|graph| graph.truth(mask.0)) == Some(false) { return none; }
                let some = some();
                branch(mask, || T::blended(mask, some, none))
            }
            fn take_any<T, S>(
                mask: Truth,
                what: &mut T,
                some: impl FnOnce(&T) -> S,
                take: impl FnOnce(&mut T, Truth, &S),
            ) {
                if with(|graph| graph.truth(mask.0)) != Some(false) {
                    let some = some(what);
                    branch(mask, || take(what, mask, &some));
                }
            }
            fn iterate<const N: usize, const M: usize>(
                most: usize,
                numbers: [Self; N],
                going: [Truth; M],
                mut step: impl FnMut([Self; N], [Truth; M]) -> ([Self; N], [Truth; M]),
            ) -> [Self; N] {
                let kinds = core::iter::repeat_n(Kind::Real, N).chain(core::iter::repeat_n(Kind::Truth, M));
                let variables = with(|graph| graph.begin_loop(kinds));
                let state = |ids: &[Id]| -> [Self; N] { core::array::from_fn(|k| Self(ids[k])) };
                // one mask is true wherever the loop goes on
                let inside = |k: usize| if M == 1 { Truth::splat(true) } else { Truth(variables[N + k]) };
                let ids = |numbers: [Self; N], masks: [Truth; M]| -> Vec<Id> {
                    numbers.map(Self::id).into_iter().chain(masks.map(Truth::id)).collect()
                };
                let first = ids(numbers, going);
                let (next, next_going) = step(state(&variables), core::array::from_fn(inside));
                let next = ids(next, next_going);
                state(&with(|graph| graph.end_loop(most, variables, M, &first, next)))
            }
            $($functions)*
        }
    };
}
real!(Inner {});
real!(Number {
    fn sin_cos_turns(self) -> (Self, Self) {
        let pair = add(Op::Call(Call::SinCosTurns), &[self.0]);
        (Self(add(Op::Part(0), &[pair])), Self(add(Op::Part(1), &[pair])))
    }
    fn sin_cos_quarters(self) -> (Self, Self) {
        let pair = add(Op::Call(Call::SinCosQuarters), &[self.0]);
        (Self(add(Op::Part(0), &[pair])), Self(add(Op::Part(1), &[pair])))
    }
    fn acos(self) -> Self {
        Self(add(Op::Call(Call::Acos), &[self.0]))
    }
    fn atan2(self, other: Self) -> Self {
        Self(add(Op::Call(Call::Atan2), &[self.0, other.0]))
    }
    fn atan_eighth(self) -> Self {
        Self(add(Op::Call(Call::AtanEighth), &[self.0]))
    }
    fn cbrt(self) -> Self {
        Self(add(Op::Call(Call::Cbrt), &[self.0]))
    }
});
