//! What languages differ in.

use crate::graph::Op;
use crate::module::Leaf;

/// How strongly the parts of an expression hold together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Needs parentheses inside of everything else.
    Loose,
    /// `a && b && c`, inside of itself without parentheses.
    And,
    /// `a || b || c`, inside of itself without parentheses.
    Or,
    /// Sums and differences.
    Sum,
    /// Products and quotients.
    Product,
    /// `-a` and `!a`.
    Prefix,
    /// Names, positive constants and calls.
    Atom,
}

/// Text of an expression.
#[derive(Clone, Debug)]
pub struct Expression {
    /// The text.
    pub text: String,
    /// How it holds together.
    pub level: Level,
}

impl Expression {
    pub(super) fn atom(text: String) -> Self {
        Self { text, level: Level::Atom }
    }
    /// The text, in parentheses unless it holds together at least so strongly.
    pub(super) fn at(&self, level: Level) -> String {
        if self.level >= level { self.text.clone() } else { format!("({})", self.text) }
    }
    pub(super) fn prefix(token: &str, of: &Self) -> Self {
        Self { text: format!("{token}{}", of.at(Level::Atom)), level: Level::Prefix }
    }
    /// Sums and products: from left to right, as rounding is not associative.
    pub(super) fn binary(a: &Self, token: &str, b: &Self, level: Level) -> Self {
        let next = if level == Level::Sum { Level::Product } else { Level::Prefix };
        Self { text: format!("{} {token} {}", a.at(level), b.at(next)), level }
    }
    /// What has parentheses around everything.
    pub(super) fn apart(a: &Self, token: &str, b: &Self) -> Self {
        Self { text: format!("{} {token} {}", a.at(Level::Sum), b.at(Level::Sum)), level: Level::Loose }
    }
    /// Bits and shifts, whose operands WGSL wants in parentheses.
    pub(super) fn bits(a: &Self, token: &str, b: &Self) -> Self {
        Self { text: format!("{} {token} {}", a.at(Level::Prefix), b.at(Level::Prefix)), level: Level::Loose }
    }
    /// `a && b` or `a || b`.
    pub(super) fn chain(a: &Self, token: &str, b: &Self, level: Level) -> Self {
        let side = |of: &Self| if of.level == level { of.text.clone() } else { of.at(Level::Prefix) };
        Self { text: format!("{} {token} {}", side(a), side(b)), level }
    }
}

/// A language.
pub trait Dialect {
    /// The beginning of a file, with what `how` says about its origin, and the functions that stand for operations.
    fn begin(&self, how: &str) -> String;
    /// The end of a file.
    fn end(&self) -> String;
    /// What functions read words of memory by.
    fn memory(&self) -> &'static str;
    /// The type and the name of the parameter through which functions get the memory, unless it is the same for all.
    fn memory_parameter(&self) -> Option<(&'static str, &'static str)>;
    /// The name of a type.
    fn leaf(&self, leaf: Leaf) -> &'static str;
    /// A constant, exactly.
    fn real(&self, value: f32) -> Expression;
    /// A constant.
    fn word(&self, value: u32) -> String;
    /// Conjunction of truth values.
    fn and(&self) -> &'static str;
    /// Disjunction of truth values.
    fn or(&self) -> &'static str;
    /// The function that does an operation.
    fn function(&self, op: Op) -> &'static str;
    /// The function that divides, unless the operator does.
    fn quotient(&self) -> Option<&'static str> {
        None
    }
    /// `mask ? yes : no`
    fn select(&self, mask: &Expression, yes: &Expression, no: &Expression) -> Expression;
    /// The first line of a struct.
    fn open_struct(&self, name: &str) -> String;
    /// A field of it.
    fn field(&self, of: &str, name: &str) -> String;
    /// Its last line.
    fn close_struct(&self, name: &str) -> String;
    /// The first line of a function.
    fn open_function(&self, result: &str, name: &str, parameters: &str) -> String;
    /// A parameter of it.
    fn parameter(&self, of: &str, name: &str) -> String;
    /// A variable that keeps its value.
    fn constant(&self, of: Leaf, name: &str, value: &str) -> String;
    /// A variable with a first value.
    fn mutable(&self, of: Leaf, name: &str, value: &str) -> String;
    /// The first line of a loop that repeats at most so many times, which `counter` counts; a condition, if there is one, begins with `&&`.
    fn open_loop(&self, counter: &str, most: usize, condition: &str) -> String;
    /// What tells a compiler that a parameter is not used, if it needs that.
    fn unused(&self, name: &str) -> Option<String>;
    /// The variable `result`.
    fn result(&self, of: &str) -> String;
}

/// The shortest decimal number that every compiler reads as this one, whether it rounds once or first to double precision.
pub(super) fn decimal(value: f32) -> String {
    let reads = |text: &str| {
        let (once, twice) = (text.parse::<f32>(), text.parse::<f64>());
        once.is_ok_and(|x| x.to_bits() == value.to_bits())
            && twice.is_ok_and(|x| (x as f32).to_bits() == value.to_bits())
    };
    let short = format!("{value:?}");
    if reads(&short) {
        return short;
    }
    // in double precision the number is exact
    let long = format!("{:?}", f64::from(value));
    assert!(reads(&long), "{value:e} has no decimal number");
    long
}
