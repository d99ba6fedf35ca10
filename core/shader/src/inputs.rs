//! Functions of parameters that are recorded as they are asked for.

use crate::graph::Id;
use crate::module::{Function, Leaf, Module, Parameter, Type};
use crate::number::{Number, Truth, Word, record};
use crate::record::inputs_of;
use etendue::{Vec2, Vec3};

/// The parameters of a function, as inputs in their order.
#[derive(Default)]
pub(crate) struct Inputs {
    parameters: Vec<Parameter>,
    /// How many inputs there are.
    count: u32,
}

impl Inputs {
    fn add(&mut self, name: &str, leaf: Leaf) -> u32 {
        self.parameters.push(Parameter { name: name.into(), of: Type::Leaf(leaf) });
        self.next(leaf.parts())
    }
    fn next(&mut self, count: usize) -> u32 {
        self.count += count as u32;
        self.count - count as u32
    }
    /// Adds a parameter that is a struct of numbers, and returns these.
    pub(crate) fn numbers(&mut self, module: &Module, name: &str, of: usize) -> Vec<Number> {
        let leaves = module.structs[of].fields.iter().map(|field| field.leaf.parts());
        let count: usize = leaves.sum();
        self.parameters.push(Parameter { name: name.into(), of: Type::Struct(of) });
        (0..count).map(|_| Number::input(self.next(1))).collect()
    }
    pub(crate) fn real(&mut self, name: &str) -> Number {
        Number::input(self.add(name, Leaf::Real))
    }
    pub(crate) fn truth(&mut self, name: &str) -> Truth {
        Truth::input(self.add(name, Leaf::Truth))
    }
    pub(crate) fn word(&mut self, name: &str) -> Word {
        Word::input(self.add(name, Leaf::Word))
    }
    pub(crate) fn vec3(&mut self, name: &str) -> Vec3<Number> {
        let first = self.add(name, Leaf::Vec3);
        Vec3::new(Number::input(first), Number::input(first + 1), Number::input(first + 2))
    }
}

pub(crate) fn pair(of: Vec2<Number>) -> Vec<Id> {
    vec![of.x.id(), of.y.id()]
}

/// Adds a function, given its name and what records it: that takes its parameters, and returns what it does, the type of the result, and its
/// values.
pub(crate) fn add_function(
    module: &mut Module,
    name: &str,
    body: impl FnOnce(&Module, &mut Inputs) -> (String, Type, Vec<Id>),
) {
    let ((parameters, (doc, result, outputs)), graph) = record(|| {
        let mut inputs = Inputs::default();
        let body = body(module, &mut inputs);
        (inputs.parameters, body)
    });
    let inputs = inputs_of(module, &parameters);
    module.functions.push(Function { name: name.into(), doc, inputs, parameters, result, outputs, graph });
}
