//! The record of a routine: a graph of operations, each of which is there once.

mod node;

pub use node::{Branch, Call, Condition, Id, Kind, Loop, Node, Op};

use etendue::{Real, Uint};
use std::collections::{BTreeSet, HashMap, HashSet};

/// Operations in an order in which each follows its operands, and the branches of the routine.
#[derive(Clone, Debug)]
pub struct Graph {
    nodes: Vec<Node>,
    kinds: Vec<Kind>,
    places: HashMap<Node, Id>,
    branches: Vec<Branch>,
    loops: Vec<Loop>,
    /// How many loops have begun.
    begun: u32,
    /// The first node that may be in the body of each loop that is being recorded, outer ones first.
    open: Vec<usize>,
}

/// The node of the constant 0 of every graph.
pub(crate) const ZERO: Id = 0;
/// The node of the constant 1 − 2⁻²⁴ of every graph.
pub(crate) const ONE_MINUS_EPSILON: Id = 1;

impl Default for Graph {
    fn default() -> Self {
        let mut this = Self {
            nodes: Vec::new(),
            kinds: Vec::new(),
            places: HashMap::new(),
            branches: Vec::new(),
            loops: Vec::new(),
            begun: 0,
            open: Vec::new(),
        };
        assert_eq!([0.0, f32::ONE_MINUS_EPSILON].map(|x| this.real(x)), [ZERO, ONE_MINUS_EPSILON]);
        this
    }
}

impl Graph {
    /// All nodes.
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }
    /// A node.
    #[must_use]
    pub fn node(&self, id: Id) -> Node {
        self.nodes[id as usize]
    }
    /// The nodes that a node is computed from.
    #[must_use]
    pub fn operands(&self, id: Id) -> &[Id] {
        let node = &self.nodes[id as usize];
        match node.op {
            Op::Loop(index) => &self.loops[index as usize].operands,
            _ => node.operands(),
        }
    }
    /// The loop that a node is, if it is one.
    #[must_use]
    pub fn as_loop(&self, id: Id) -> Option<&Loop> {
        if let Op::Loop(index) = self.node(id).op { Some(&self.loops[index as usize]) } else { None }
    }
    /// Begins to record a loop, and returns its variables.
    pub fn begin_loop(&mut self, kinds: impl IntoIterator<Item = Kind>) -> Vec<Id> {
        self.open.push(self.nodes.len());
        let index = self.begun;
        self.begun += 1;
        let kinds = (0..).zip(kinds);
        kinds.map(|(k, kind)| self.place(Node::new(Op::LoopVariable(kind, index, k), &[]), kind)).collect()
    }
    /// Ends the loop that was begun last, which repeats at most `most` times while any of its masks is true. Returns what its variables are after
    /// it, given their first and next values.
    ///
    /// # Panics
    /// Outside of a loop.
    pub fn end_loop(&mut self, most: usize, variables: Vec<Id>, masks: usize, first: &[Id], next: Vec<Id>) -> Vec<Id> {
        let begin = self.open.pop().expect("a loop ends that has begun");
        let mut varies: HashSet<Id> = variables.iter().copied().collect();
        for id in begin as Id..self.nodes.len() as Id {
            if self.operands(id).iter().any(|operand| varies.contains(operand)) {
                varies.insert(id);
            }
        }
        let (mut body, mut captured, mut open) = (BTreeSet::new(), BTreeSet::new(), next.clone());
        while let Some(id) = open.pop() {
            let node = self.node(id);
            if !varies.contains(&id) {
                if !node.is_constant() {
                    captured.insert(id);
                }
            } else if !node.is_leaf() && body.insert(id) {
                open.extend(self.operands(id));
            }
        }
        let operands = first.iter().copied().chain(captured).collect();
        let kinds: Vec<Kind> = variables.iter().map(|&id| self.kind(id)).collect();
        self.loops.push(Loop { most, variables, masks, next, body: body.into_iter().collect(), operands });
        let node = self.place(Node::new(Op::Loop(self.loops.len() as u32 - 1), &[]), Kind::Loop);
        let results = kinds.into_iter().enumerate();
        results.map(|(k, kind)| self.place(Node::new(Op::LoopResult(kind, k as u32), &[node]), kind)).collect()
    }
    /// What a node is.
    #[must_use]
    pub fn kind(&self, id: Id) -> Kind {
        self.kinds[id as usize]
    }
    /// The branches of the routine.
    #[must_use]
    pub fn branches(&self) -> &[Branch] {
        &self.branches
    }
    /// The number, if it is constant.
    #[must_use]
    pub fn constant(&self, id: Id) -> Option<f32> {
        if let Op::Real(bits) = self.node(id).op { Some(f32::from_bits(bits)) } else { None }
    }
    /// The truth value, if it is constant.
    #[must_use]
    pub fn truth(&self, id: Id) -> Option<bool> {
        if let Op::Truth(value) = self.node(id).op { Some(value) } else { None }
    }
    /// The word, if it is constant.
    #[must_use]
    pub fn word(&self, id: Id) -> Option<u32> {
        if let Op::Word(value) = self.node(id).op { Some(value) } else { None }
    }
    /// Adds a constant number.
    pub fn real(&mut self, value: f32) -> Id {
        self.place(Node::new(Op::Real(value.to_bits()), &[]), Kind::Real)
    }
    /// Adds an input, by its index among those of the routine.
    pub fn input(&mut self, kind: Kind, index: u32) -> Id {
        self.place(Node::new(Op::Input(kind, index), &[]), kind)
    }
    /// Notes that what was selected by a mask since the graph had `from` nodes is the result of a branch.
    pub fn branch(&mut self, mask: Id, from: usize) {
        let node = self.node(mask);
        let condition = match node.op {
            Op::Not => Condition { mask: node.operands()[0], holds: false },
            _ => Condition { mask, holds: true },
        };
        let selects = |node: &Node| node.op == Op::Select && node.operands()[0] == condition.mask;
        let chosen = (from..self.nodes.len()).filter(|&id| selects(&self.nodes[id])).map(|id| id as Id).collect();
        self.branches.push(Branch { condition, chosen });
    }
    fn place(&mut self, node: Node, kind: Kind) -> Id {
        if let Some(&id) = self.places.get(&node) {
            return id;
        }
        let id = self.nodes.len() as Id;
        self.nodes.push(node);
        self.kinds.push(kind);
        self.places.insert(node, id);
        id
    }
    /// Adds an operation, or finds what has the same bits: the same operation, an operand, a constant. (The sign and payload of a NaN do not
    /// count.)
    pub fn add(&mut self, op: Op, of: &[Id]) -> Id {
        if let Some(same) = self.folded(op, of).or_else(|| self.simpler(op, of)) {
            return same;
        }
        let mut operands = [0; 3];
        operands[..of.len()].copy_from_slice(of);
        if matches!(
            op,
            Op::Add
                | Op::Mul
                | Op::MulAdd
                | Op::And
                | Op::Or
                | Op::Xor
                | Op::WordAdd
                | Op::WordMul
                | Op::WordAnd
                | Op::WordOr
                | Op::WordXor
        ) && operands[0] > operands[1]
        {
            operands.swap(0, 1);
        }
        let kind = match op {
            Op::Less | Op::LessEqual | Op::And | Op::Or | Op::Xor | Op::Not | Op::WordAny => Kind::Truth,
            Op::ToWord | Op::WordAdd | Op::WordSub | Op::WordMul | Op::WordAnd | Op::WordOr | Op::WordXor => Kind::Word,
            Op::WordShl(_) | Op::WordShr(_) | Op::WordReverse | Op::WordLess => Kind::Word,
            Op::Load => Kind::Word,
            Op::Select => self.kind(operands[1]),
            Op::Call(call) if call.returns_pair() => Kind::Pair,
            _ => Kind::Real,
        };
        self.place(Node::new(op, &operands[..of.len()]), kind)
    }
    /// What an operation on constants is.
    fn folded(&mut self, op: Op, of: &[Id]) -> Option<Id> {
        let reals: Option<Vec<f32>> = of.iter().map(|&id| self.constant(id)).collect();
        if let Some(x) = reals {
            let of = |k: usize| x[k];
            let value = match op {
                Op::Add => of(0) + of(1),
                Op::Sub => of(0) - of(1),
                Op::Mul => of(0) * of(1),
                Op::Div => of(0) / of(1),
                Op::Neg => -of(0),
                Op::MulAdd => Real::mul_add(of(0), of(1), of(2)),
                Op::Sqrt => Real::sqrt(of(0)),
                Op::Abs => Real::abs(of(0)),
                Op::Round => Real::round_ties_even(of(0)),
                Op::CopySign => Real::copysign(of(0), of(1)),
                Op::Lesser => Real::lesser(of(0), of(1)),
                Op::Greater => Real::greater(of(0), of(1)),
                Op::Pow2Scale => of(0).pow2_scale(),
                Op::InverseCbrtEstimate => of(0).inverse_cbrt_estimate(),
                Op::Call(call) if !call.returns_pair() => call.evaluate(&x)[0],
                Op::ToWord => return Some(self.add_word(of(0).to_uint())),
                Op::Less => return Some(self.add_truth(of(0) < of(1))),
                Op::LessEqual => return Some(self.add_truth(of(0) <= of(1))),
                _ => return None,
            };
            // what languages make of constants that are no numbers, they do not tell
            return (!value.is_nan()).then(|| self.real(value));
        }
        if let Op::Part(k) = op {
            let pair = self.node(of[0]);
            let Op::Call(call) = pair.op else { panic!("only functions return pairs") };
            let argument = self.constant(pair.operands()[0])?;
            return Some(self.real(call.evaluate(&[argument])[k as usize]));
        }
        let words: Option<Vec<u32>> = of.iter().map(|&id| self.word(id)).collect();
        let x = words?;
        let value = match op {
            Op::Unit => return Some(self.real(<f32 as Real>::unit(x[0]))),
            Op::FromWord => return Some(self.real(<f32 as Real>::from_uint(x[0]))),
            Op::WordAny => return Some(self.add_truth(x[0] != 0)),
            Op::FromBits if f32::from_bits(x[0]).is_nan() => return None,
            Op::FromBits => return Some(self.real(f32::from_bits(x[0]))),
            Op::WordAdd => x[0].wrapping_add(x[1]),
            Op::WordSub => x[0].wrapping_sub(x[1]),
            Op::WordMul => x[0].wrapping_mul(x[1]),
            Op::WordAnd => x[0] & x[1],
            Op::WordOr => x[0] | x[1],
            Op::WordXor => x[0] ^ x[1],
            Op::WordShl(bits) => x[0] << bits,
            Op::WordShr(bits) => x[0] >> bits,
            Op::WordReverse => x[0].reverse_bits(),
            Op::WordLess => Uint::lt(x[0], x[1]),
            _ => return None,
        };
        Some(self.add_word(value))
    }
    /// Adds a constant truth value.
    pub fn add_truth(&mut self, value: bool) -> Id {
        self.place(Node::new(Op::Truth(value), &[]), Kind::Truth)
    }
    /// Adds a constant word.
    pub fn add_word(&mut self, value: u32) -> Id {
        self.place(Node::new(Op::Word(value), &[]), Kind::Word)
    }
    /// What a value is where the mask selects it, as far as it depends on that: it may select by the same mask again, or divide by such a
    /// number, which then guards against 0 only where the quotient does not count.
    fn arm(&mut self, mask: Id, value: Id, k: usize) -> Option<Id> {
        let selected = |this: &Self, id: Id| {
            let node = this.node(id);
            (node.op == Op::Select && node.operands()[0] == mask).then(|| node.operands()[k])
        };
        let node = self.node(value);
        match node.op {
            Op::Div => {
                let divisor = selected(self, node.operands()[1])?;
                Some(self.add(Op::Div, &[node.operands()[0], divisor]))
            }
            _ => selected(self, value),
        }
    }
    /// What has the same bits for every number.
    fn simpler(&mut self, op: Op, of: &[Id]) -> Option<Id> {
        let is = |this: &Self, id: Id, value: f32| this.constant(id).is_some_and(|x| x.to_bits() == value.to_bits());
        let negated = |this: &Self, id: Id| {
            let node = this.node(id);
            (node.op == Op::Neg).then(|| node.operands()[0])
        };
        let a = of[0];
        let b = of.get(1).copied().unwrap_or(ZERO);
        match op {
            Op::Add => match () {
                () if is(self, b, -0.0) => Some(a),
                () if is(self, a, -0.0) => Some(b),
                () => match (negated(self, a), negated(self, b)) {
                    (_, Some(b)) => Some(self.add(Op::Sub, &[a, b])),
                    (Some(a), None) => Some(self.add(Op::Sub, &[b, a])),
                    (None, None) => None,
                },
            },
            Op::Sub if is(self, b, 0.0) => Some(a),
            Op::Sub => negated(self, b).map(|b| self.add(Op::Add, &[a, b])),
            Op::Mul if is(self, a, 1.0) => Some(b),
            Op::Mul | Op::Div if is(self, b, 1.0) => Some(a),
            Op::Mul if is(self, a, -1.0) => Some(self.add(Op::Neg, &[b])),
            Op::Mul if is(self, b, -1.0) => Some(self.add(Op::Neg, &[a])),
            Op::MulAdd if is(self, a, 1.0) => Some(self.add(Op::Add, &[b, of[2]])),
            Op::MulAdd if is(self, b, 1.0) => Some(self.add(Op::Add, &[a, of[2]])),
            Op::MulAdd if is(self, of[2], -0.0) => Some(self.add(Op::Mul, &[a, b])),
            Op::Neg => negated(self, a),
            Op::Abs => negated(self, a).map(|a| self.add(Op::Abs, &[a])),
            Op::And | Op::Or | Op::Xor => {
                for (known, other) in [(a, b), (b, a)] {
                    match (op, self.truth(known)) {
                        (Op::And, Some(true)) | (Op::Or | Op::Xor, Some(false)) => return Some(other),
                        (Op::And, Some(false)) | (Op::Or, Some(true)) => return Some(known),
                        (Op::Xor, Some(true)) => return Some(self.add(Op::Not, &[other])),
                        _ => {}
                    }
                }
                match op {
                    Op::Xor if a == b => Some(self.add_truth(false)),
                    _ => (a == b).then_some(a),
                }
            }
            Op::WordShl(0) | Op::WordShr(0) => Some(a),
            Op::WordAdd | Op::WordOr | Op::WordXor if self.word(a) == Some(0) => Some(b),
            Op::WordAdd | Op::WordSub | Op::WordOr | Op::WordXor if self.word(b) == Some(0) => Some(a),
            Op::WordMul if self.word(a) == Some(1) => Some(b),
            Op::WordMul if self.word(b) == Some(1) => Some(a),
            Op::Not => match self.truth(a) {
                Some(value) => Some(self.add_truth(!value)),
                None => (self.node(a).op == Op::Not).then(|| self.node(a).operands()[0]),
            },
            Op::Select => {
                let c = of[2];
                match self.truth(a) {
                    Some(true) => Some(b),
                    Some(false) => Some(c),
                    None if b == c => Some(b),
                    None if self.node(a).op == Op::Not => {
                        let mask = self.node(a).operands()[0];
                        Some(self.add(Op::Select, &[mask, c, b]))
                    }
                    None => match (self.arm(a, b, 1), self.arm(a, c, 2)) {
                        (None, None) => None,
                        (yes, no) => Some(self.add(Op::Select, &[a, yes.unwrap_or(b), no.unwrap_or(c)])),
                    },
                }
            }
            _ => None,
        }
    }
}
