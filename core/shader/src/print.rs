//! Modules as text.

mod ascii;
mod c;
mod dialect;
mod wgsl;

pub use c::C;
pub use dialect::Dialect;
pub use wgsl::Wgsl;

use crate::graph::{Condition, Id, Kind, Loop, Op};
use crate::module::{Access, Function, Leaf, Module, Type};
use crate::names::pascal;
use crate::plan::{Plan, Step, plan};
pub(crate) use ascii::comment;
use core::fmt::Write;
use dialect::{Expression, Level};
use std::collections::BTreeSet;

/// The name of a struct.
#[must_use]
pub fn struct_name(name: &str) -> String {
    format!("EtendueShader{}", pascal(name))
}
/// The name of a function.
#[must_use]
pub fn function_name(name: &str) -> String {
    format!("etendue_shader_{name}")
}

/// A module in a language. `how` is a sentence about how the file was made.
pub fn print(module: &Module, language: &impl Dialect, how: &str) -> String {
    let mut text = language.begin(how);
    if module.reads_memory() {
        text.truncate(text.trim_end().len());
        text += "\n";
        text += language.memory();
        text += "\n";
    }
    for of in &module.structs {
        text += &comment(&of.doc, "");
        text += &language.open_struct(&struct_name(&of.name));
        for field in &of.fields {
            text += &comment(&field.doc, "    ");
            text += &language.field(language.leaf(field.leaf), &field.name);
        }
        text += &language.close_struct(&struct_name(&of.name));
        text += "\n";
    }
    for function in &module.functions {
        text += &comment(&function.doc, "");
        text += &Printer::new(module, function, language).function();
        text += "\n";
    }
    text + &language.end()
}

struct Printer<'a, D> {
    module: &'a Module,
    function: &'a Function,
    language: &'a D,
    plan: Plan,
    /// The numbers of variables, in the order of their declarations.
    names: Vec<Option<u32>>,
    declared: u32,
    /// How many loops are around a statement.
    depth: usize,
}

impl<'a, D: Dialect> Printer<'a, D> {
    fn new(module: &'a Module, function: &'a Function, language: &'a D) -> Self {
        let names = vec![None; function.graph.nodes().len()];
        Self { module, function, language, plan: plan(function), names, declared: 0, depth: 0 }
    }
    fn type_name(&self, of: Type) -> String {
        match of {
            Type::Leaf(leaf) => self.language.leaf(leaf).to_owned(),
            Type::Struct(index) => struct_name(&self.module.structs[index].name),
        }
    }
    fn leaf_of(&self, id: Id) -> Leaf {
        match self.function.graph.kind(id) {
            Kind::Real => Leaf::Real,
            Kind::Truth => Leaf::Truth,
            Kind::Word => Leaf::Word,
            Kind::Pair => Leaf::Vec2,
            Kind::Loop => panic!("a loop is no value"),
        }
    }
    fn name(&self, id: Id) -> String {
        let letter = match self.function.graph.kind(id) {
            Kind::Real => 'x',
            Kind::Truth => 'b',
            Kind::Word => 'k',
            Kind::Pair => 'v',
            Kind::Loop => panic!("a loop has no name"),
        };
        let number = self.names[id as usize].unwrap_or_else(|| {
            panic!("{}: node {id} is used before it is declared", self.function.name);
        });
        format!("{letter}{number}")
    }
    fn declare(&mut self, id: Id) -> String {
        self.declared += 1;
        self.names[id as usize] = Some(self.declared);
        self.name(id)
    }
    fn input(&self, index: u32) -> String {
        let Access { parameter, field, axis } = self.function.inputs[index as usize];
        let parameter = &self.function.parameters[parameter];
        let mut text = parameter.name.clone();
        if let (Type::Struct(of), Some(field)) = (parameter.of, field) {
            text += ".";
            text += &self.module.structs[of].fields[field].name;
        }
        if let Some(axis) = axis {
            text += [".x", ".y", ".z"][axis];
        }
        text
    }
    /// A variable, a constant or an expression.
    fn value(&self, id: Id) -> Expression {
        let node = self.function.graph.node(id);
        match node.op {
            _ if self.plan.variables[id as usize] => Expression::atom(self.name(id)),
            Op::Input(_, index) => Expression::atom(self.input(index)),
            Op::LoopVariable(..) => Expression::atom(self.name(id)),
            Op::Real(bits) => self.language.real(f32::from_bits(bits)),
            Op::Truth(value) => Expression::atom(value.to_string()),
            Op::Word(value) => Expression::atom(self.language.word(value)),
            _ => self.expression(id),
        }
    }
    /// What a variable of a loop is after it.
    fn result(&self, id: Id) -> Expression {
        let Op::LoopResult(_, k) = self.function.graph.node(id).op else { panic!("no result of a loop") };
        let of = self.function.graph.as_loop(self.function.graph.operands(id)[0]);
        Expression::atom(self.name(of.expect("a result is of a loop").variables[k as usize]))
    }
    fn expression(&self, id: Id) -> Expression {
        let graph = &self.function.graph;
        if let Op::LoopResult(..) = graph.node(id).op {
            return self.result(id);
        }
        let all: Vec<Expression> = graph.operands(id).iter().map(|&id| self.value(id)).collect();
        let call = |name: &str| {
            let all: Vec<&str> = all.iter().map(|operand| operand.text.as_str()).collect();
            Expression::atom(format!("{name}({})", all.join(", ")))
        };
        let memory = || self.language.memory_parameter().map(|(_, name)| format!("{name}, ")).unwrap_or_default();
        let binary = |token: &str, level: Level| Expression::binary(&all[0], token, &all[1], level);
        // of truth values, parentheses tell more than precedence
        let apart = |token: &str| Expression::apart(&all[0], token, &all[1]);
        let bits = |token: &str, other: &Expression| Expression::bits(&all[0], token, other);
        match graph.node(id).op {
            Op::Add | Op::WordAdd => binary("+", Level::Sum),
            Op::Sub | Op::WordSub => binary("-", Level::Sum),
            Op::Mul | Op::WordMul => binary("*", Level::Product),
            Op::Div => self.language.quotient().map_or_else(|| binary("/", Level::Product), call),
            Op::Neg => Expression::prefix("-", &all[0]),
            Op::Not => Expression::prefix("!", &all[0]),
            Op::Less => apart("<"),
            Op::LessEqual => apart("<="),
            Op::And => Expression::chain(&all[0], self.language.and(), &all[1], Level::And),
            Op::Or => Expression::chain(&all[0], self.language.or(), &all[1], Level::Or),
            Op::Xor => apart("!="),
            Op::WordAnd => bits("&", &all[1]),
            Op::WordOr => bits("|", &all[1]),
            Op::WordXor => bits("^", &all[1]),
            Op::WordShl(count) => bits("<<", &Expression::atom(self.language.word(count))),
            Op::WordShr(count) => bits(">>", &Expression::atom(self.language.word(count))),
            Op::Load => Expression::atom(format!("etendue_shader_load({}{})", memory(), all[0].text)),
            Op::WordAny => Expression::apart(&all[0], "!=", &Expression::atom(self.language.word(0))),
            Op::Select => self.language.select(&all[0], &all[1], &all[2]),
            Op::Part(k) => Expression::atom(format!("{}{}", all[0].text, [".x", ".y"][k as usize])),
            Op::Call(called) => call(&function_name(called.name())),
            op => call(self.language.function(op)),
        }
    }
    fn condition(&self, Condition { mask, holds }: Condition) -> String {
        let value = self.value(mask);
        if holds { value.text } else { Expression::prefix("!", &value).text }
    }
    /// The text of a statement that is no branch and no loop; those of loops are several lines.
    fn statement(&mut self, step: &Step) -> Vec<String> {
        match *step {
            Step::Default(id, other) => vec![self.mutable(id, other)],
            Step::Choose(id, value) => vec![format!("{} = {};", self.name(id), self.value(value).text)],
            Step::Let(id) => match self.function.graph.as_loop(id) {
                Some(of) => self.varying(of).map(|k| self.mutable(of.variables[k], of.first()[k])).collect(),
                None => {
                    let value = self.expression(id).text;
                    let name = self.declare(id);
                    vec![self.language.constant(self.leaf_of(id), &name, &value)]
                }
            },
            Step::If(..) | Step::Loop(..) => panic!("{step:?} has statements"),
        }
    }
    /// A variable that begins with the value of another node.
    fn mutable(&mut self, id: Id, first: Id) -> String {
        let value = self.value(first).text;
        let name = self.declare(id);
        self.language.mutable(self.leaf_of(id), &name, &value)
    }
    /// The variables of a loop, without a mask that always holds.
    fn varying(&self, of: &Loop) -> impl Iterator<Item = usize> + use<D> {
        let holds = |id: Id| self.function.graph.truth(id) == Some(true);
        let count = of.variables.len();
        let always = of.masks == 1 && holds(of.first()[count - 1]) && holds(of.next[count - 1]);
        0..count - usize::from(always)
    }
    /// The next values of the variables of a loop.
    fn next(&mut self, of: &Loop) -> Vec<String> {
        let (mut copies, mut lines) = (Vec::new(), Vec::new());
        let varying: Vec<usize> = self.varying(of).collect();
        let pairs = varying.into_iter().map(|k| (of.variables[k], of.next[k]));
        for (variable, next) in pairs.filter(|(variable, next)| variable != next) {
            let mut value = self.value(next).text;
            // one that gets its own next value before is copied
            if of.variables.contains(&next) {
                self.declared += 1;
                let copy = format!("{value}_{}", self.declared);
                copies.push(self.language.constant(self.leaf_of(next), &copy, &value));
                value = copy;
            }
            lines.push(format!("{} = {value};", self.name(variable)));
        }
        [copies, lines].concat()
    }
    fn steps(&mut self, steps: &[Step], indent: usize, text: &mut String) {
        let margin = "    ".repeat(indent);
        let put = |text: &mut String, line: &str| {
            let _ = writeln!(text, "{margin}{line}");
        };
        for step in steps {
            match *step {
                Step::If(condition, ref inner) => {
                    put(text, &format!("if ({}) {{", self.condition(condition)));
                    self.steps(inner, indent + 1, text);
                    put(text, "}");
                }
                Step::Loop(id, ref inner) => {
                    let graph = &self.function.graph;
                    let of = graph.as_loop(id).expect("a loop is one");
                    let masks =
                        self.varying(of).skip(of.variables.len() - of.masks).map(|k| self.name(of.variables[k]));
                    let condition = masks.collect::<Vec<_>>().join(&format!(" {} ", self.language.or()));
                    let condition = match of.masks {
                        _ if condition.is_empty() => condition,
                        1 => format!(" && {condition}"),
                        _ => format!(" && ({condition})"),
                    };
                    let counter = ["i", "j", "k"][self.depth.min(2)];
                    put(text, &self.language.open_loop(counter, of.most, &condition));
                    self.depth += 1;
                    self.steps(inner, indent + 1, text);
                    self.depth -= 1;
                    for line in self.next(of) {
                        put(text, &format!("    {line}"));
                    }
                    put(text, "}");
                }
                _ => self.statement(step).iter().for_each(|line| put(text, line)),
            }
        }
    }
    fn function(mut self) -> String {
        let parameters = self.function.parameters.iter();
        let parameters = parameters.map(|of| self.language.parameter(&self.type_name(of.of), &of.name));
        let memory = self.language.memory_parameter().filter(|_| self.function.reads_memory());
        let memory = memory.map(|(of, name)| self.language.parameter(of, name));
        let parameters: Vec<_> = memory.into_iter().chain(parameters).collect();
        let result = self.type_name(self.function.result);
        let name = function_name(&self.function.name);
        let mut text = self.language.open_function(&result, &name, &parameters.join(", "));
        let used: BTreeSet<usize> =
            self.function.used_inputs().into_iter().map(|k| self.function.inputs[k as usize].parameter).collect();
        let parameters = self.function.parameters.iter().enumerate();
        for (_, parameter) in parameters.filter(|(k, _)| !used.contains(k)) {
            if let Some(line) = self.language.unused(&parameter.name) {
                let _ = writeln!(text, "    {line}");
            }
        }
        let steps = core::mem::take(&mut self.plan.steps);
        self.steps(&steps, 1, &mut text);
        let values: Vec<String> = self.function.outputs.iter().map(|&id| self.value(id).text).collect();
        if let Type::Leaf(Leaf::Real | Leaf::Truth | Leaf::Word) = self.function.result {
            let _ = writeln!(text, "    return {};", values[0]);
        } else {
            let _ = writeln!(text, "    {}", self.language.result(&result));
            for ((field, axis), value) in self.module.parts(self.function.result).into_iter().zip(values) {
                let mut place = "result".to_owned();
                if let (Type::Struct(of), Some(field)) = (self.function.result, field) {
                    place += ".";
                    place += &self.module.structs[of].fields[field].name;
                }
                place += axis.map_or("", |axis| [".x", ".y", ".z"][axis]);
                let _ = writeln!(text, "    {place} = {value};");
            }
            text += "    return result;\n";
        }
        text + "}\n"
    }
}
