//! Operations, and what they are on.

use etendue::Real;

/// A node of a graph.
pub type Id = u32;

/// What a node is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// A number of single precision.
    Real,
    /// A truth value.
    Truth,
    /// An unsigned number of 32 bits.
    Word,
    /// Two numbers.
    Pair,
    /// The variables of a loop.
    Loop,
}

/// A function of the core that sources call, where other operations are written out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Call {
    /// [`Real::sin_cos_turns`]: a pair.
    SinCosTurns,
    /// [`Real::sin_cos_quarters`]: a pair.
    SinCosQuarters,
    /// [`Real::acos`].
    Acos,
    /// [`Real::atan2`].
    Atan2,
    /// [`Real::atan_eighth`].
    AtanEighth,
    /// [`Real::cbrt`].
    Cbrt,
}

impl Call {
    /// Its outputs for constants; a single one is repeated.
    pub(super) fn evaluate(self, of: &[f32]) -> [f32; 2] {
        let pair = |(sin, cos)| [sin, cos];
        match self {
            Self::SinCosTurns => pair(of[0].sin_cos_turns()),
            Self::SinCosQuarters => pair(of[0].sin_cos_quarters()),
            Self::Acos => [Real::acos(of[0]); 2],
            Self::Atan2 => [Real::atan2(of[0], of[1]); 2],
            Self::AtanEighth => [of[0].atan_eighth(); 2],
            Self::Cbrt => [Real::cbrt(of[0]); 2],
        }
    }
    /// Its name in sources, after `etendue_shader_`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::SinCosTurns => "sin_cos_turns",
            Self::SinCosQuarters => "sin_cos_quarters",
            Self::Acos => "acos",
            // no digit at the end, after which translators put a mark
            Self::Atan2 => "angle",
            Self::AtanEighth => "atan_eighth",
            Self::Cbrt => "cbrt",
        }
    }
    /// Whether it returns two numbers.
    #[must_use]
    pub fn returns_pair(self) -> bool {
        matches!(self, Self::SinCosTurns | Self::SinCosQuarters)
    }
}

/// An operation. Its operands are in its [`Node`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Op {
    /// A constant number, by its bits.
    Real(u32),
    /// A constant truth value.
    Truth(bool),
    /// A constant word.
    Word(u32),
    /// A number that the routine is given: its index among them.
    Input(Kind, u32),
    /// `a + b`
    Add,
    /// `a - b`
    Sub,
    /// `a * b`
    Mul,
    /// `a / b`
    Div,
    /// `-a`
    Neg,
    /// `a * b + c`, rounded once
    MulAdd,
    /// See [`Real::sqrt`].
    Sqrt,
    /// See [`Real::abs`].
    Abs,
    /// See [`Real::round_ties_even`].
    Round,
    /// See [`Real::copysign`].
    CopySign,
    /// See [`Real::lesser`].
    Lesser,
    /// See [`Real::greater`].
    Greater,
    /// See [`Real::pow2_scale`].
    Pow2Scale,
    /// See [`Real::inverse_cbrt_estimate`].
    InverseCbrtEstimate,
    /// See [`Real::unit`].
    Unit,
    /// See [`Real::from_uint`].
    FromWord,
    /// See [`Real::to_uint`].
    ToWord,
    /// `a < b` of numbers
    Less,
    /// `a <= b` of numbers
    LessEqual,
    /// `a and b`
    And,
    /// `a or b`
    Or,
    /// `a != b` of truth values
    Xor,
    /// `not a`
    Not,
    /// `a ? b : c`
    Select,
    /// Sum modulo 2³².
    WordAdd,
    /// Difference modulo 2³².
    WordSub,
    /// Product modulo 2³².
    WordMul,
    /// `a & b` of words
    WordAnd,
    /// `a | b` of words
    WordOr,
    /// `a ^ b` of words
    WordXor,
    /// `a << n`
    WordShl(u32),
    /// `a >> n`
    WordShr(u32),
    /// See [`etendue::Uint::reverse_bits`].
    WordReverse,
    /// `a < b ? 0xffffffff : 0` of words
    WordLess,
    /// `a != 0` of a word
    WordAny,
    /// The word at an index in memory: see [`Number::load`](crate::Number::load).
    Load,
    /// The number with the bits of a word.
    FromBits,
    /// A call of a function.
    Call(Call),
    /// One number of a pair, 0 or 1.
    Part(u32),
    /// A variable of a loop, inside of it: the loop and the variable, by their indices.
    LoopVariable(Kind, u32, u32),
    /// A loop, by its index.
    Loop(u32),
    /// What a variable of a loop is after it, by its index.
    LoopResult(Kind, u32),
}

/// An operation with its operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Node {
    /// The operation.
    pub op: Op,
    operands: [Id; 3],
    count: u8,
}

impl Node {
    pub(super) fn new(op: Op, of: &[Id]) -> Self {
        let mut operands = [0; 3];
        operands[..of.len()].copy_from_slice(of);
        Self { op, operands, count: of.len() as u8 }
    }
    /// The operands, unless it is a loop.
    pub(super) fn operands(&self) -> &[Id] {
        &self.operands[..usize::from(self.count)]
    }
    /// True for constants.
    #[must_use]
    pub fn is_constant(&self) -> bool {
        matches!(self.op, Op::Real(_) | Op::Truth(_) | Op::Word(_))
    }
    /// True for what has a name or a value without being computed: constants, inputs, and variables of a loop inside of it.
    #[must_use]
    pub fn is_leaf(&self) -> bool {
        self.is_constant() || matches!(self.op, Op::Input(..) | Op::LoopVariable(..))
    }
}

/// A loop: its variables, and what computes the next value of each from those of all.
#[derive(Clone, Debug)]
pub struct Loop {
    /// How often it repeats at most.
    pub most: usize,
    /// The variables inside of the loop.
    pub variables: Vec<Id>,
    /// How many of them, at the end, are masks: it repeats while any is true.
    pub masks: usize,
    /// Their next values.
    pub next: Vec<Id>,
    /// The nodes that are computed anew each time.
    pub body: Vec<Id>,
    /// Their first values, and the nodes outside of the loop that the body uses.
    pub(super) operands: Vec<Id>,
}

impl Loop {
    /// The first values of the variables.
    #[must_use]
    pub fn first(&self) -> &[Id] {
        &self.operands[..self.variables.len()]
    }
    /// The nodes outside of the loop that its body uses.
    #[must_use]
    pub fn captured(&self) -> &[Id] {
        &self.operands[self.variables.len()..]
    }
}

/// A path that few calls need.
#[derive(Clone, Debug)]
pub struct Branch {
    /// Where it is taken.
    pub condition: Condition,
    /// The nodes that select what it computes, in their order.
    pub chosen: Vec<Id>,
}

/// That a truth value is so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Condition {
    /// The truth value.
    pub mask: Id,
    /// What it is.
    pub holds: bool,
}
