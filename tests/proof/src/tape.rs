//! The record of one run of a routine: its operations, their derivatives and rounding errors, and the branches that it took.
//!
//! Each operation is a node with a variable δ for its rounding error. A result is a smooth function F of all these variables on the
//! path that the run took: F(0) is the routine in exact arithmetic, and F(δ) what the routine computes. By the mean value theorem
//! F(δ) − F(0) = Σ δₖ ∂F/∂δₖ at a point between, and [`error`] bounds each derivative from the intervals of all values in
//! between, in one pass backwards. An error that is added and subtracted again so cancels, as it does in double-word arithmetic.

use crate::interval::Interval;
use std::cell::RefCell;

/// An operation: its operands with the derivatives by them, and its rounding error.
#[derive(Clone, Copy)]
struct Node {
    operands: [(u32, Interval); 3],
    /// Bound of |δ|.
    noise: f64,
    /// The node whose −δ this is, if any.
    minus_noise_of: u32,
    /// For a cosine that follows its sine: what else is known of both errors.
    wave: Option<Wave>,
}

/// A sine and a cosine, and their errors as a vector: the components along the true (cos, sin) and across.
#[derive(Clone, Copy)]
pub(crate) struct Wave {
    pub(crate) sin: Interval,
    pub(crate) cos: Interval,
    pub(crate) along: f64,
    pub(crate) across: f64,
}

/// The node of everything that depends on no rounding error.
pub(crate) const EXACT: u32 = 0;
const NO_NODE: u32 = u32::MAX;

impl Node {
    const NONE: Self =
        Self { operands: [(EXACT, Interval::point(0.0)); 3], noise: 0.0, minus_noise_of: NO_NODE, wave: None };
}

/// A comparison that intervals do not decide.
#[derive(Clone, Copy, PartialEq)]
struct Comparison {
    names: [u32; 2],
    left: Interval,
    right: Interval,
    strict: bool,
}

/// A side of a comparison.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    pub(crate) name: u32,
    pub(crate) node: u32,
    pub(crate) computed: Interval,
    pub(crate) exact: f64,
}

/// A comparison `left <= right` that a run took as true, although its intervals do not decide it.
#[derive(Clone, Copy, Debug)]
pub struct Assumed {
    left: Side,
    right: Side,
}
impl Assumed {
    /// A bound of the error of right − left: it holds if it does by as much in exact arithmetic.
    #[must_use]
    pub fn error(&self) -> f64 {
        error_of_sum(&[(self.right.node, 1.0), (self.left.node, -1.0)])
    }
    /// right − left in exact arithmetic, if all parameters are points.
    #[must_use]
    pub fn exact_margin(&self) -> f64 {
        self.right.exact - self.left.exact
    }
}

#[derive(Default)]
struct Tape {
    nodes: Vec<Node>,
    /// Derivatives of a result by each node, and by its δ where that is also used for itself.
    by_value: Vec<Interval>,
    by_noise: Vec<Interval>,
    /// Undecided comparisons in their order.
    comparisons: Vec<Comparison>,
    /// What this run assumes about them.
    assumptions: Vec<bool>,
    /// Whether comparisons are taken as true for now, and those that were.
    lenient: bool,
    lenience: Vec<Assumed>,
}

thread_local! {
    static TAPE: RefCell<Tape> = RefCell::new(Tape::default());
}

/// Adds a node, unless nothing before it has an error and it has none itself.
pub(crate) fn push(operands: &[(u32, Interval)], noise: f64) -> u32 {
    if noise == 0.0 && operands.iter().all(|o| o.0 == EXACT) {
        return EXACT;
    }
    let mut node = Node { noise, ..Node::NONE };
    node.operands[..operands.len()].copy_from_slice(operands);
    TAPE.with_borrow_mut(|tape| tape.push(node))
}
/// Adds a sine and a cosine, each with its argument, derivative and error.
pub(crate) fn push_wave(sin: ((u32, Interval), f64), cos: ((u32, Interval), f64), wave: Wave) -> [u32; 2] {
    let node = |(operand, noise): ((u32, Interval), f64)| {
        let mut node = Node { noise, ..Node::NONE };
        node.operands[0] = operand;
        node
    };
    TAPE.with_borrow_mut(|tape| [tape.push(node(sin)), tape.push(Node { wave: Some(wave), ..node(cos) })])
}
/// Adds −δ of another node, with an error of its own.
pub(crate) fn push_minus_noise(of: u32, noise: f64) -> u32 {
    if of == EXACT && noise == 0.0 {
        return EXACT;
    }
    TAPE.with_borrow_mut(|tape| tape.push(Node { noise, minus_noise_of: of, ..Node::NONE }))
}
/// The bound of a node's own rounding error.
pub(crate) fn noise(of: u32) -> f64 {
    TAPE.with_borrow(|tape| tape.nodes.get(of as usize).map_or(0.0, |node| node.noise))
}
impl Tape {
    fn push(&mut self, node: Node) -> u32 {
        if self.nodes.is_empty() {
            self.nodes.push(Node::NONE);
        }
        self.nodes.push(node);
        (self.nodes.len() - 1) as u32
    }
}

/// What is true of `left < right` (or ≤, unless `strict`): what the intervals say, or what this path assumes.
pub(crate) fn decide([a, b]: [Side; 2], strict: bool) -> bool {
    let (left, right) = (a.computed, b.computed);
    let (surely, never) =
        if strict { (left.hi < right.lo, left.lo >= right.hi) } else { (left.hi <= right.lo, left.lo > right.hi) };
    if surely || never {
        return surely;
    }
    TAPE.with_borrow_mut(|tape| {
        if tape.lenient {
            tape.lenience.push(Assumed { left: a, right: b });
            return true;
        }
        let this = Comparison { names: [a.name, b.name], left, right, strict };
        let place = tape.comparisons.iter().position(|c| *c == this).unwrap_or_else(|| {
            tape.comparisons.push(this);
            tape.comparisons.len() - 1
        });
        if place >= tape.assumptions.len() {
            tape.assumptions.resize(place + 1, true);
        }
        tape.assumptions[place]
    })
}

/// Runs `routine` along every path that the intervals allow, and calls `judge` after each. Stops and returns false if `judge` does, or if
/// there are more than `most` paths.
pub fn all_paths<T>(most: usize, mut routine: impl FnMut() -> T, mut judge: impl FnMut(T) -> bool) -> bool {
    let mut assumptions = Vec::new();
    for _ in 0..most {
        TAPE.with_borrow_mut(|tape| {
            tape.nodes.clear();
            tape.comparisons.clear();
            tape.lenience.clear();
            tape.assumptions = assumptions.clone();
        });
        let result = routine();
        if !judge(result) {
            return false;
        }
        let (used, taken) = TAPE.with_borrow(|tape| (tape.comparisons.len(), tape.assumptions.clone()));
        assumptions = taken;
        assumptions.truncate(used);
        // the next path: the last comparison that was assumed true becomes false
        while assumptions.last() == Some(&false) {
            assumptions.pop();
        }
        match assumptions.last_mut() {
            Some(last) => *last = false,
            None => return true,
        }
    }
    false
}

/// Runs `routine` with every undecided comparison `a < b` or `a <= b` taken as true, and returns its result with these comparisons.
pub fn assume<T>(routine: impl FnOnce() -> T) -> (T, Vec<Assumed>) {
    TAPE.with_borrow_mut(|tape| tape.lenient = true);
    let result = routine();
    TAPE.with_borrow_mut(|tape| {
        tape.lenient = false;
        (result, core::mem::take(&mut tape.lenience))
    })
}

/// A bound of |computed − exact| for a node: Σ |∂F/∂δₖ| |δₖ|. Infinite if there is none.
#[must_use]
pub fn error(of: u32) -> f64 {
    error_of_sum(&[(of, 1.0)])
}
/// The same for a sum of nodes, each with a factor.
fn error_of_sum(terms: &[(u32, f64)]) -> f64 {
    let none = Interval::point(0.0);
    TAPE.with_borrow_mut(|tape| {
        let Tape { nodes, by_value, by_noise, .. } = tape;
        for adjoints in [&mut *by_value, &mut *by_noise] {
            adjoints.clear();
            adjoints.resize(nodes.len(), none);
        }
        let mut last = 0;
        for &(of, factor) in terms {
            if of != EXACT {
                by_value[of as usize] = by_value[of as usize] + Interval::point(factor);
                last = last.max(of as usize);
            }
        }
        let (mut total, mut sine_is_done) = (0.0_f64, false);
        for k in (1..=last).rev() {
            let (node, value, noise) = (&nodes[k], by_value[k], by_noise[k]);
            if let Some(wave) = node.wave {
                // no node is between sine and cosine, so that both derivatives are complete
                let [of_sin, of_cos] = [by_value[k - 1], value];
                let apart = of_sin.greatest() * nodes[k - 1].noise + of_cos.greatest() * node.noise;
                let along = (of_sin * wave.sin + of_cos * wave.cos).greatest() * wave.along;
                let across = (of_sin * wave.cos - of_cos * wave.sin).greatest() * wave.across;
                total = (total + apart.min(along + across) * (1.0 + 4.0 * f64::EPSILON)).next_up();
                sine_is_done = true;
            } else if sine_is_done {
                sine_is_done = false;
            } else if node.noise > 0.0 {
                total = (total + ((value + noise).greatest() * node.noise).next_up()).next_up();
            }
            if node.minus_noise_of != NO_NODE {
                let of = node.minus_noise_of as usize;
                by_noise[of] = by_noise[of] - value;
            }
            for &(operand, derivative) in &node.operands {
                if operand != EXACT {
                    by_value[operand as usize] = by_value[operand as usize] + value * derivative;
                }
            }
        }
        if total.is_nan() { f64::INFINITY } else { total }
    })
}
