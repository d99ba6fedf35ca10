//! The order of a function's statements, and which of them are in a branch.
//!
//! A recorded routine computes both sides of each branch, and selects one. Where it says by `where_any` that few calls need a path, its graph
//! notes what is selected then. What nothing else uses goes into an `if`: so a branch of the core is a branch in every language.

use crate::graph::{Condition, Id, Kind, Op};
use crate::module::Function;
use std::collections::{BTreeMap, HashMap};

/// A statement.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// A new variable with the value of a node.
    Let(Id),
    /// A new variable for a node that selects: at first what it is without the branch below, the value of another node.
    Default(Id, Id),
    /// The variable of a [`Step::Default`] gets the value of another node, which the branch computes.
    Choose(Id, Id),
    /// A branch.
    If(Condition, Vec<Step>),
    /// A loop, after its variables got their first values.
    Loop(Id, Vec<Step>),
}

/// A function as statements.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The statements.
    pub steps: Vec<Step>,
    /// Whether each node is a variable. A node that is none is part of an expression.
    pub variables: Vec<bool>,
}

/// How many operations an expression may have.
const LONGEST: usize = 6;

/// A branch, or what is outside of all.
struct Block {
    parent: usize,
    depth: usize,
    condition: Option<Condition>,
    /// The nodes that select what it computes.
    chosen: Vec<Id>,
}

/// Plans the statements of a function outside of its loops, or of the body of one loop.
struct Planner<'a> {
    function: &'a Function,
    /// The nodes that are planned here.
    here: Vec<bool>,
    blocks: Vec<Block>,
    /// The block in which each node is computed: the innermost one around all its uses.
    homes: Vec<Option<usize>>,
    /// The block whose value a node selects.
    chooses: HashMap<Id, usize>,
    variables: Vec<bool>,
    /// The statements of loops.
    bodies: HashMap<Id, Vec<Step>>,
}

impl<'a> Planner<'a> {
    fn new(function: &'a Function, here: Vec<bool>, outputs: &[Id], bodies: HashMap<Id, Vec<Step>>) -> Self {
        let count = here.len();
        let blocks = vec![Block { parent: 0, depth: 0, condition: None, chosen: Vec::new() }];
        let (homes, variables) = (vec![None; count], vec![false; count]);
        let mut this = Self { function, here, blocks, homes, chooses: HashMap::new(), variables, bodies };
        this.find_homes(outputs);
        this.find_variables(outputs);
        this
    }
    /// The innermost block around both.
    fn around(&self, mut a: usize, mut b: usize) -> usize {
        while a != b {
            let inner = if self.blocks[a].depth >= self.blocks[b].depth { &mut a } else { &mut b };
            *inner = self.blocks[*inner].parent;
        }
        a
    }
    /// The nodes that are planned here and must be computed first, each with the block that uses it.
    fn uses(&self, id: Id) -> Vec<(Id, Option<usize>)> {
        let inner = self.chooses.get(&id).map(|&block| (self.chosen(id).0, block));
        let block = |k: usize| inner.filter(|(of, _)| *of == k).map(|(_, block)| block).or(self.homes[id as usize]);
        let operands = self.function.graph.operands(id).iter().enumerate();
        operands.filter(|(_, of)| self.here[**of as usize]).map(|(k, &of)| (of, block(k))).collect()
    }
    /// Which operand of a node that selects is what its branch computes, and which is the other one.
    fn chosen(&self, id: Id) -> (usize, usize) {
        let holds = self.blocks[self.chooses[&id]].condition.is_some_and(|condition| condition.holds);
        if holds { (1, 2) } else { (2, 1) }
    }
    fn find_homes(&mut self, outputs: &[Id]) {
        let graph = &self.function.graph;
        outputs.iter().for_each(|&id| self.homes[id as usize] = Some(0));
        let branches = graph.branches().iter().flat_map(|branch| branch.chosen.iter().map(move |&id| (id, branch)));
        let branches: HashMap<Id, _> = branches.collect();
        for id in (0..self.here.len() as Id).rev().filter(|&id| self.here[id as usize]) {
            let Some(home) = self.homes[id as usize] else { continue };
            if let (Some(branch), false) = (branches.get(&id), self.chooses.contains_key(&id)) {
                // the last of those that it chooses, so that all their uses are known
                let used = branch.chosen.iter().copied().filter(|&of| self.here[of as usize]);
                let chosen: Vec<Id> = used.filter(|&of| self.homes[of as usize].is_some()).collect();
                let homes = chosen.iter().filter_map(|&of| self.homes[of as usize]);
                let parent = homes.fold(home, |all, of| self.around(all, of));
                for &of in &chosen {
                    self.homes[of as usize] = Some(parent);
                    self.chooses.insert(of, self.blocks.len());
                }
                let depth = self.blocks[parent].depth + 1;
                self.blocks.push(Block { parent, depth, condition: Some(branch.condition), chosen });
            }
            for (operand, block) in self.uses(id) {
                let known = self.homes[operand as usize];
                self.homes[operand as usize] = known.zip(block).map(|(a, b)| self.around(a, b)).or(block);
            }
        }
    }
    /// What is used more than once is a variable, and what would make an expression too long.
    fn find_variables(&mut self, outputs: &[Id]) {
        let graph = &self.function.graph;
        let (mut users, mut forced) = (vec![Vec::new(); self.here.len()], vec![false; self.here.len()]);
        outputs.iter().for_each(|&id| forced[id as usize] = true);
        for id in (0..self.here.len() as Id).filter(|&id| self.here[id as usize]) {
            self.uses(id).iter().for_each(|&(of, _)| users[of as usize].push(id));
            let captured = graph.as_loop(id).into_iter().flat_map(|of| of.captured());
            captured.for_each(|&used| forced[used as usize] = true);
        }
        for condition in self.blocks.iter().filter_map(|block| block.condition) {
            forced[condition.mask as usize] = true;
        }
        let mut sizes = vec![0; self.here.len()];
        for id in 0..self.here.len() {
            let op = graph.node(id as Id).op;
            if !self.here[id] || graph.node(id as Id).is_leaf() {
                continue;
            }
            let uses = self.uses(id as Id);
            let inside = uses.iter().filter(|(of, _)| !self.variables[*of as usize]);
            sizes[id] = 1 + inside.map(|(of, _)| sizes[*of as usize]).sum::<usize>();
            let small =
                sizes[id] == 1 && matches!(op, Op::Neg | Op::Not) || matches!(op, Op::Part(_) | Op::LoopResult(..));
            let assigned =
                |user: Id| self.chooses.contains_key(&user) && graph.operands(user)[self.chosen(user).0] == id as Id;
            let inline = match users[id][..] {
                [user] => sizes[id] <= LONGEST || assigned(user),
                _ => false,
            };
            let several = matches!(graph.kind(id as Id), Kind::Pair | Kind::Loop);
            let chooses = self.chooses.contains_key(&(id as Id));
            self.variables[id] = several || chooses || forced[id] || !small && !inline;
        }
    }
    /// The statements of a block. Each node follows its operands by its number; a branch stands where the last node is that it chooses.
    fn steps(&self, block: usize) -> Vec<Step> {
        let variables = (0..self.here.len()).filter(|&id| self.here[id] && self.variables[id]);
        let own = variables.filter(|&id| self.homes[id] == Some(block) && !self.chooses.contains_key(&(id as Id)));
        let mut items: BTreeMap<Id, Vec<Step>> = BTreeMap::new();
        for id in own.map(|id| id as Id) {
            let body = self.bodies.get(&id).map(|body| Step::Loop(id, body.clone()));
            items.insert(id, [Some(Step::Let(id)), body].into_iter().flatten().collect());
        }
        for (inner, Block { condition, chosen, .. }) in self.blocks.iter().enumerate().skip(1) {
            let (Some(condition), Some(&last)) = (*condition, chosen.last()) else { continue };
            if self.blocks[inner].parent == block {
                let operand = |id: Id, k: usize| self.function.graph.operands(id)[k];
                let mut steps = self.steps(inner);
                steps.extend(chosen.iter().map(|&id| Step::Choose(id, operand(id, self.chosen(id).0))));
                let defaults = chosen.iter().map(|&id| Step::Default(id, operand(id, self.chosen(id).1)));
                items.insert(last, defaults.chain([Step::If(condition, steps)]).collect());
            }
        }
        items.into_values().flatten().collect()
    }
}

/// Plans the statements for some nodes, and notes which nodes are variables.
fn steps(function: &Function, here: Vec<bool>, outputs: &[Id], variables: &mut [bool]) -> Vec<Step> {
    let mut bodies = HashMap::new();
    for id in (0..here.len()).filter(|&id| here[id]) {
        if let Some(of) = function.graph.as_loop(id as Id) {
            let mut body = vec![false; here.len()];
            of.body.iter().for_each(|&id| body[id as usize] = true);
            bodies.insert(id as Id, steps(function, body, &of.next, variables));
        }
    }
    let planner = Planner::new(function, here, outputs, bodies);
    variables.iter_mut().zip(&planner.variables).for_each(|(all, here)| *all |= here);
    planner.steps(0)
}

/// Plans a function.
#[must_use]
pub fn plan(function: &Function) -> Plan {
    let mut here = function.live();
    let mut variables = vec![false; here.len()];
    for id in 0..here.len() {
        if let (true, Some(of)) = (here[id], function.graph.as_loop(id as Id)) {
            of.body.iter().for_each(|&id| here[id as usize] = false);
        }
        // a variable of a loop is of no concern outside
        here[id] &= !matches!(function.graph.node(id as Id).op, Op::LoopVariable(..));
    }
    let steps = steps(function, here, &function.outputs, &mut variables);
    Plan { steps, variables }
}
