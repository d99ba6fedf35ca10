//! What a source consists of, before it is printed in a language.

use crate::graph::{Call, Graph, Id, Op};
use std::collections::BTreeSet;

/// A type that is no struct of the module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Leaf {
    /// A number.
    Real,
    /// A truth value.
    Truth,
    /// A word.
    Word,
    /// Two numbers.
    Vec2,
    /// Three numbers.
    Vec3,
}

impl Leaf {
    /// The type of this many numbers.
    ///
    /// # Panics
    /// Unless these are 1, 2 or 3.
    #[must_use]
    pub fn of_numbers(count: usize) -> Self {
        match count {
            1 => Self::Real,
            2 => Self::Vec2,
            3 => Self::Vec3,
            _ => panic!("there are no vectors of {count} numbers"),
        }
    }
    /// How many values it has.
    #[must_use]
    pub fn parts(self) -> usize {
        match self {
            Self::Vec2 => 2,
            Self::Vec3 => 3,
            _ => 1,
        }
    }
}

/// A field of a struct.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Its name in all languages.
    pub name: String,
    /// Its type.
    pub leaf: Leaf,
    /// What it is, if that is documented.
    pub doc: String,
}

/// A struct.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Struct {
    /// Its name in words with `_` between.
    pub name: String,
    /// What it is.
    pub doc: String,
    /// Its fields.
    pub fields: Vec<Field>,
}

/// A type of a parameter or a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type {
    /// A number or a vector.
    Leaf(Leaf),
    /// A struct of the module, by its index.
    Struct(usize),
}

/// A parameter of a function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its type.
    pub of: Type,
}

/// Where a function finds an input of its graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Access {
    /// The parameter.
    pub parameter: usize,
    /// Its field, if it is a struct.
    pub field: Option<usize>,
    /// The coordinate, if that is a vector.
    pub axis: Option<usize>,
}

/// A function.
#[derive(Clone, Debug)]
pub struct Function {
    /// Its name in words with `_` between.
    pub name: String,
    /// What it does.
    pub doc: String,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
    /// Where the inputs of the graph are.
    pub inputs: Vec<Access>,
    /// What it returns.
    pub result: Type,
    /// The nodes of the values of the result, in the order of its fields.
    pub outputs: Vec<Id>,
    /// What it computes.
    pub graph: Graph,
}

impl Function {
    /// For each node, whether an output depends on it.
    #[must_use]
    pub fn live(&self) -> Vec<bool> {
        let mut live = vec![false; self.graph.nodes().len()];
        let mut open = self.outputs.clone();
        while let Some(id) = open.pop() {
            if !core::mem::replace(&mut live[id as usize], true) {
                open.extend(self.graph.operands(id));
                open.extend(self.graph.as_loop(id).into_iter().flat_map(|of| &of.body));
            }
        }
        live
    }
    /// The inputs that an output depends on.
    #[must_use]
    pub fn used_inputs(&self) -> BTreeSet<u32> {
        let live = self.live();
        let used = self.graph.nodes().iter().zip(live).filter(|(_, live)| *live);
        used.filter_map(|(node, _)| if let Op::Input(_, index) = node.op { Some(index) } else { None }).collect()
    }
    /// Whether an output depends on words of memory.
    #[must_use]
    pub fn reads_memory(&self) -> bool {
        self.graph.nodes().iter().zip(self.live()).any(|(node, live)| live && node.op == Op::Load)
    }
    /// How many operations an output depends on.
    #[must_use]
    pub fn operations(&self) -> usize {
        self.graph.nodes().iter().zip(self.live()).filter(|(node, live)| *live && !node.is_leaf()).count()
    }
}

/// Structs and functions.
#[derive(Clone, Debug, Default)]
pub struct Module {
    /// The structs.
    pub structs: Vec<Struct>,
    /// The functions, each after those that it calls.
    pub functions: Vec<Function>,
    /// Whether fused multiply-adds, quotients and square roots are written out where a language does not promise to round them correctly.
    pub exact: bool,
}

impl Module {
    /// Adds a struct, unless it is there, and returns its index.
    ///
    /// # Panics
    /// If another struct has its name.
    pub fn add_struct(&mut self, new: Struct) -> usize {
        if let Some(known) = self.structs.iter().position(|known| known.name == new.name) {
            assert_eq!(self.structs[known], new, "two structs of one name");
            return known;
        }
        self.structs.push(new);
        self.structs.len() - 1
    }
    /// The values of a type, each with its field and its coordinate.
    #[must_use]
    pub fn parts(&self, of: Type) -> Vec<(Option<usize>, Option<usize>)> {
        let axes = |leaf: Leaf, field: Option<usize>| {
            let vector = leaf.parts() > 1;
            (0..leaf.parts()).map(move |axis| (field, vector.then_some(axis)))
        };
        match of {
            Type::Leaf(leaf) => axes(leaf, None).collect(),
            Type::Struct(index) => {
                let fields = self.structs[index].fields.iter().enumerate();
                fields.flat_map(|(k, field)| axes(field.leaf, Some(k))).collect()
            }
        }
    }
    /// Whether a function reads memory.
    #[must_use]
    pub fn reads_memory(&self) -> bool {
        self.functions.iter().any(Function::reads_memory)
    }
    /// The functions of the core that the functions call.
    #[must_use]
    pub fn calls(&self) -> BTreeSet<Call> {
        let mut all = BTreeSet::new();
        for function in &self.functions {
            let live = function.live();
            let nodes = function.graph.nodes().iter().zip(live).filter(|(_, live)| *live);
            all.extend(nodes.filter_map(|(node, _)| if let Op::Call(call) = node.op { Some(call) } else { None }));
        }
        all
    }
}
