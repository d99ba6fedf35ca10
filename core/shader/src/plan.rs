//! The order of a function's statements, and which of them are in a branch.
//!
//! A recorded routine computes both sides of each branch and selects one. Where the routine itself tests a mask, to leave out a path that
//! few calls need, its graph notes this condition. Whatever is used only where the condition holds then goes into an `if`: a statement
//! needs the conditions that all its uses have in common. So a branch of the core is a branch in every language, without another word
//! about it in the core.

use crate::graph::{Condition, Id, Kind, Op};
use crate::module::Function;
use std::collections::{BTreeSet, HashMap};

/// A statement.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// A new variable with the value of a node.
    Let(Id),
    /// A new variable for the value of a node that a branch below computes; 0 without it.
    Declare(Id),
    /// A declared variable gets the value of a node.
    Assign(Id),
    /// A new variable for a node that selects: at first what it is without the branch below, the value of a node or `false`.
    Default(Id, Option<Id>),
    /// The variable of a [`Step::Default`] gets the value of another node, which the branch computes.
    Choose(Id, Id),
    /// A branch.
    If(Condition, Vec<Step>),
    /// A loop, after its variables got their first values.
    Loop(Id, Vec<Step>),
}

impl Step {
    /// Whether a variable gets a value in it.
    fn sets(&self, id: Id) -> bool {
        match self {
            Self::Let(of) | Self::Declare(of) | Self::Assign(of) | Self::Default(of, _) | Self::Choose(of, _) => {
                *of == id
            }
            Self::If(_, inner) | Self::Loop(_, inner) => inner.iter().any(|step| step.sets(id)),
        }
    }
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

type Conditions = Vec<Condition>;

/// Plans the statements of a function outside of its loops, or of the body of one loop.
struct Planner<'a> {
    function: &'a Function,
    /// The nodes that are planned here.
    here: Vec<bool>,
    /// What other statements need of them.
    outputs: &'a [Id],
    /// Nodes outside of a loop that its body may name.
    captured: &'a [Id],
    /// The conditions under which each node is needed, outer ones first.
    needs: Vec<Conditions>,
    variables: Vec<bool>,
    /// The nodes that each node is an operand of.
    users: Vec<Vec<Id>>,
    /// The nodes that must be variables, because they are named otherwise than as operands.
    forced: Vec<bool>,
}

impl<'a> Planner<'a> {
    fn new(function: &'a Function, here: Vec<bool>, outputs: &'a [Id], captured: &'a [Id]) -> Self {
        let count = here.len();
        let (needs, variables) = (vec![Vec::new(); count], vec![false; count]);
        let (users, forced) = (vec![Vec::new(); count], vec![false; count]);
        let mut this = Self { function, here, outputs, captured, needs, variables, users, forced };
        this.find_needs();
        this.find_variables();
        this
    }
    /// The nodes that are planned here and must be computed first.
    fn operands(&self, id: Id) -> impl Iterator<Item = Id> {
        self.function.graph.operands(id).iter().copied().filter(|&operand| self.here[operand as usize])
    }
    fn all(&self) -> impl DoubleEndedIterator<Item = Id> {
        (0..self.here.len() as Id).filter(|&id| self.here[id as usize])
    }
    /// The tested conditions that hold if a mask is so.
    fn implied(&self, mask: Id, holds: bool, all: &mut Conditions) {
        let graph = &self.function.graph;
        let condition = graph.condition(mask, holds);
        let node = graph.node(condition.mask);
        let known = self.here[condition.mask as usize] || node.is_leaf() || self.captured.contains(&condition.mask);
        if known && graph.tested().contains(&condition) && !all.contains(&condition) {
            all.push(condition);
        }
        if node.op == (if condition.holds { Op::And } else { Op::Or }) {
            graph.operands(condition.mask).iter().for_each(|&operand| self.implied(operand, condition.holds, all));
        }
    }
    fn find_needs(&mut self) {
        let graph = &self.function.graph;
        let mut needs: Vec<Option<Conditions>> = vec![None; graph.nodes().len()];
        for &id in self.outputs {
            needs[id as usize] = Some(Vec::new());
        }
        for id in self.all().rev() {
            let Some(need) = needs[id as usize].clone() else {
                assert!(graph.node(id).is_leaf(), "only constants are of no use outside of loops");
                continue;
            };
            let (op, operands) = (graph.node(id).op, graph.operands(id));
            for (k, &operand) in operands.iter().enumerate().filter(|(_, operand)| self.here[**operand as usize]) {
                let mut under = need.clone();
                match (op, k) {
                    (Op::Select, 1 | 2) => self.implied(operands[0], k == 1, &mut under),
                    // the second operand does not matter where the first one decides
                    (Op::And | Op::Or, 1) => self.implied(operands[0], op == Op::And, &mut under),
                    _ => {}
                }
                match &mut needs[operand as usize] {
                    Some(known) => known.retain(|condition| under.contains(condition)),
                    none => *none = Some(under),
                }
            }
        }
        self.needs = needs.into_iter().map(Option::unwrap_or_default).collect();
        let depths: Vec<usize> = self.needs.iter().map(Vec::len).collect();
        for need in &mut self.needs {
            // a condition is known before those that need it
            need.sort_by_key(|condition| (depths[condition.mask as usize], *condition));
        }
    }
    /// What is used more than once is a variable, and what would make an expression too long.
    fn find_variables(&mut self) {
        let graph = &self.function.graph;
        let mut users: Vec<Vec<Id>> = vec![Vec::new(); graph.nodes().len()];
        let mut forced = vec![false; graph.nodes().len()];
        for id in self.all() {
            self.operands(id).for_each(|operand| users[operand as usize].push(id));
            self.needs[id as usize].iter().for_each(|condition| forced[condition.mask as usize] = true);
            let captured = graph.as_loop(id).into_iter().flat_map(|of| of.captured());
            captured.for_each(|&used| forced[used as usize] = true);
        }
        self.outputs.iter().for_each(|&id| forced[id as usize] = true);
        let mut sizes = vec![0; graph.nodes().len()];
        for id in 0..self.here.len() {
            let op = graph.node(id as Id).op;
            if !self.here[id] || graph.node(id as Id).is_leaf() {
                continue;
            }
            let inside = self.operands(id as Id).filter(|&operand| !self.variables[operand as usize]);
            sizes[id] = 1 + inside.map(|operand| sizes[operand as usize]).sum::<usize>();
            let small =
                sizes[id] == 1 && matches!(op, Op::Neg | Op::Not) || matches!(op, Op::Part(_) | Op::LoopResult(..));
            let once = users[id].len() == 1 && self.needs[users[id][0] as usize] == self.needs[id];
            let several = matches!(graph.kind(id as Id), Kind::Pair | Kind::Loop);
            self.variables[id] = several || forced[id] || !small && (!once || sizes[id] > LONGEST);
        }
        (self.users, self.forced) = (users, forced);
    }
    /// The variables that an expression uses.
    fn uses(&self, id: Id) -> Vec<Id> {
        let (mut all, mut open) = (Vec::new(), self.operands(id).collect::<Vec<_>>());
        while let Some(operand) = open.pop() {
            if self.variables[operand as usize] {
                all.push(operand);
            } else {
                open.extend(self.operands(operand));
            }
        }
        all
    }
}

/// Statements in the order in which they are made, each in a branch or outside of all.
struct Block {
    parent: usize,
    condition: Option<Condition>,
    items: Vec<Item>,
}
#[derive(Clone, Copy)]
enum Item {
    Variable(Id),
    Block(usize),
}

/// The statements that are in branches of the same conditions.
#[derive(Default)]
struct Region {
    children: Vec<(Condition, usize)>,
    parent: usize,
    ready: BTreeSet<Id>,
    /// How many are ready here and in the regions inside.
    count: usize,
}

struct Scheduler<'a> {
    planner: &'a Planner<'a>,
    regions: Vec<Region>,
    region_of: HashMap<Id, usize>,
    /// How many variables each one waits for.
    waits: HashMap<Id, usize>,
    waiting: HashMap<Id, Vec<Id>>,
    blocks: Vec<Block>,
    block_of: HashMap<Id, usize>,
    /// The statements of loops.
    bodies: HashMap<Id, Vec<Step>>,
}

impl<'a> Scheduler<'a> {
    fn new(planner: &'a Planner<'a>, bodies: HashMap<Id, Vec<Step>>) -> Self {
        let root = Block { parent: 0, condition: None, items: Vec::new() };
        let mut this = Self {
            planner,
            regions: vec![Region::default()],
            region_of: HashMap::new(),
            waits: HashMap::new(),
            waiting: HashMap::new(),
            blocks: vec![root],
            block_of: HashMap::new(),
            bodies,
        };
        for id in planner.all().filter(|&id| planner.variables[id as usize]) {
            let need = &planner.needs[id as usize];
            let region = this.region(need);
            this.region_of.insert(id, region);
            let masks = need.iter().map(|condition| condition.mask);
            let before: BTreeSet<Id> =
                planner.uses(id).into_iter().chain(masks).filter(|&on| planner.variables[on as usize]).collect();
            this.waits.insert(id, before.len());
            before.iter().for_each(|&on| this.waiting.entry(on).or_default().push(id));
            if before.is_empty() {
                this.is_ready(id);
            }
        }
        this.run(0, 0);
        assert_eq!(this.block_of.len(), this.waits.len(), "{}: statements wait for each other", planner.function.name);
        this
    }
    fn region(&mut self, path: &[Condition]) -> usize {
        path.iter().fold(0, |at, condition| {
            if let Some(&(_, child)) = self.regions[at].children.iter().find(|(known, _)| known == condition) {
                return child;
            }
            self.regions.push(Region { parent: at, ..Region::default() });
            let child = self.regions.len() - 1;
            self.regions[at].children.push((*condition, child));
            child
        })
    }
    fn is_ready(&mut self, id: Id) {
        let region = self.region_of[&id];
        self.regions[region].ready.insert(id);
        self.count(region, 1);
    }
    fn count(&mut self, mut region: usize, by: isize) {
        loop {
            self.regions[region].count = self.regions[region].count.wrapping_add_signed(by);
            if region == 0 {
                return;
            }
            region = self.regions[region].parent;
        }
    }
    fn first_ready(&self, region: usize) -> Option<Id> {
        let Region { ready, children, .. } = &self.regions[region];
        let inside = children.iter().filter(|(_, child)| self.regions[*child].count > 0);
        inside.filter_map(|&(_, child)| self.first_ready(child)).chain(ready.first().copied()).min()
    }
    /// Makes all statements that are ready: a branch begins when there is nothing to do outside of it.
    fn run(&mut self, region: usize, block: usize) {
        loop {
            if let Some(id) = self.regions[region].ready.pop_first() {
                self.count(region, -1);
                self.blocks[block].items.push(Item::Variable(id));
                self.block_of.insert(id, block);
                for next in self.waiting.remove(&id).unwrap_or_default() {
                    let waits = self.waits.get_mut(&next).expect("all that wait are variables");
                    *waits -= 1;
                    if *waits == 0 {
                        self.is_ready(next);
                    }
                }
                continue;
            }
            let children = self.regions[region].children.iter().filter(|(_, child)| self.regions[*child].count > 0);
            let Some(&(condition, child)) = children.min_by_key(|(_, child)| self.first_ready(*child)) else { return };
            self.blocks.push(Block { parent: block, condition: Some(condition), items: Vec::new() });
            let inner = self.blocks.len() - 1;
            self.blocks[block].items.push(Item::Block(inner));
            self.run(child, inner);
        }
    }
    fn depth(&self, mut block: usize) -> usize {
        let mut depth = 0;
        while block != 0 {
            block = self.blocks[block].parent;
            depth += 1;
        }
        depth
    }
    /// The innermost block around both.
    fn around(&self, mut a: usize, mut b: usize) -> usize {
        while a != b {
            if self.depth(a) >= self.depth(b) {
                a = self.blocks[a].parent;
            } else {
                b = self.blocks[b].parent;
            }
        }
        a
    }
    fn steps(&self) -> Vec<Step> {
        // where each variable is declared: around all its uses
        let mut homes = self.block_of.clone();
        let widen = |id: Id, block: usize, homes: &mut HashMap<Id, usize>| {
            if let Some(&home) = homes.get(&id) {
                homes.insert(id, self.around(home, block));
            }
        };
        for (&id, &block) in &self.block_of {
            self.planner.uses(id).into_iter().for_each(|used| widen(used, block, &mut homes));
        }
        for block in &self.blocks[1..] {
            let condition = block.condition.expect("only the first block has no condition");
            widen(condition.mask, block.parent, &mut homes);
        }
        self.planner.outputs.iter().for_each(|&id| widen(id, 0, &mut homes));
        // those that are declared before a branch
        let mut before: HashMap<usize, BTreeSet<Id>> = HashMap::new();
        for (&id, &home) in &homes {
            let mut block = self.block_of[&id];
            if block == home {
                continue;
            }
            while self.blocks[block].parent != home {
                block = self.blocks[block].parent;
            }
            before.entry(block).or_default().insert(id);
        }
        self.block_steps(0, &homes, &before)
    }
    fn block_steps(
        &self,
        block: usize,
        homes: &HashMap<Id, usize>,
        before: &HashMap<usize, BTreeSet<Id>>,
    ) -> Vec<Step> {
        let mut steps = Vec::new();
        for item in &self.blocks[block].items {
            match *item {
                Item::Variable(id) => {
                    let here = homes[&id] == block;
                    steps.push(if here { Step::Let(id) } else { Step::Assign(id) });
                    steps.extend(self.bodies.get(&id).map(|body| Step::Loop(id, body.clone())));
                }
                Item::Block(inner) => {
                    steps.extend(before.get(&inner).into_iter().flatten().map(|&id| Step::Declare(id)));
                    let condition = self.blocks[inner].condition.expect("only the first block has no condition");
                    steps.push(Step::If(condition, self.block_steps(inner, homes, before)));
                }
            }
        }
        self.merge(&mut steps);
        steps
    }
    /// A variable that a branch computes and that is selected after it where the branch was taken, and used nowhere else, becomes the result
    /// of the selection, which has the other value before the branch.
    fn merge(&self, steps: &mut Vec<Step>) {
        let graph = &self.planner.function.graph;
        let mut at = 0;
        while at < steps.len() {
            at += 1;
            let Step::Declare(value) = steps[at - 1] else { continue };
            let ([user], false) = (&self.planner.users[value as usize][..], self.planner.forced[value as usize]) else {
                continue;
            };
            let user = *user;
            let Some(end) = steps.iter().position(|step| *step == Step::Let(user)) else { continue };
            let is_branch = |step: &Step| matches!(step, Step::If(_, inner) if inner.contains(&Step::Assign(value)));
            let Some(branch) = steps[at..end].iter().position(is_branch).map(|k| at + k) else { continue };
            let Step::If(condition, inner) = &mut steps[branch] else { panic!("it is a branch") };
            let operands = graph.operands(user);
            let holds = |value: bool| graph.condition(operands[0], value) == *condition;
            let other = match graph.node(user).op {
                Op::Select if holds(true) && operands[1] == value => Some(operands[2]),
                Op::Select if holds(false) && operands[2] == value => Some(operands[1]),
                Op::And if holds(true) && operands[1] == value => None,
                _ => continue,
            };
            let place = inner.iter().position(|step| *step == Step::Assign(value)).expect("the branch has it");
            // the other value must be known before the branch
            let mut used = match other {
                Some(id) if self.planner.variables[id as usize] => vec![id],
                Some(id) => self.planner.uses(id),
                None => Vec::new(),
            };
            used.retain(|id| self.planner.here[*id as usize]);
            if used.iter().any(|&id| steps[at..end].iter().any(|step| step.sets(id))) {
                continue;
            }
            if let Step::If(_, inner) = &mut steps[branch] {
                inner[place] = Step::Choose(user, value);
            }
            steps[at - 1] = Step::Default(user, other);
            steps.remove(end);
        }
    }
}

/// Plans the statements for some nodes, and notes which nodes are variables.
fn steps(function: &Function, here: Vec<bool>, outputs: &[Id], captured: &[Id], variables: &mut [bool]) -> Vec<Step> {
    let mut bodies = HashMap::new();
    for id in (0..here.len()).filter(|&id| here[id]) {
        if let Some(of) = function.graph.as_loop(id as Id) {
            let mut body = vec![false; here.len()];
            of.body.iter().for_each(|&id| body[id as usize] = true);
            bodies.insert(id as Id, steps(function, body, &of.next, of.captured(), variables));
        }
    }
    let planner = Planner::new(function, here, outputs, captured);
    let steps = Scheduler::new(&planner, bodies).steps();
    variables.iter_mut().zip(&planner.variables).for_each(|(all, here)| *all |= here);
    steps
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
    let steps = steps(function, here, &function.outputs, &[], &mut variables);
    Plan { steps, variables }
}
