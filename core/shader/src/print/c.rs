//! One dialect of C that C99, C++, CUDA, HIP and OpenCL C all read.

use super::dialect::{Dialect, Expression, Level, decimal};
use crate::graph::Op;
use crate::module::Leaf;

/// C99, C++, CUDA, HIP and OpenCL C.
#[derive(Clone, Copy, Debug)]
pub struct C;

/// What the functions stand on: the same bits as those of the core, unless the compiler contracts or reorders operations.
const PRELUDE: &str = include_str!("prelude.h");

impl Dialect for C {
    fn begin(&self, how: &str) -> String {
        format!(
            "// Light sampling for renderers, in one dialect of C99, C++, CUDA, HIP and OpenCL C. MIT or Apache-2.0.\n// {how}\n{PRELUDE}\n"
        )
    }
    fn end(&self) -> String {
        "#endif\n".into()
    }
    fn memory(&self) -> &'static str {
        include_str!("memory.h")
    }
    fn memory_parameter(&self) -> Option<(&'static str, &'static str)> {
        Some(("EtendueShaderMemory", "memory"))
    }
    fn leaf(&self, leaf: Leaf) -> &'static str {
        match leaf {
            Leaf::Real => "float",
            Leaf::Truth => "bool",
            Leaf::Word => "etendue_shader_word",
            Leaf::Vec2 => "EtendueShaderVec2",
            Leaf::Vec3 => "EtendueShaderVec3",
        }
    }
    fn real(&self, value: f32) -> Expression {
        let text = if value.is_infinite() { "INFINITY".into() } else { format!("{}f", decimal(value.abs())) };
        if value.is_sign_negative() { Expression::prefix("-", &Expression::atom(text)) } else { Expression::atom(text) }
    }
    fn word(&self, value: u32) -> String {
        format!("{value}u")
    }
    fn and(&self) -> &'static str {
        "&&"
    }
    fn or(&self) -> &'static str {
        "||"
    }
    fn function(&self, op: Op) -> &'static str {
        match op {
            Op::MulAdd => "fmaf",
            Op::Sqrt => "sqrtf",
            Op::Abs => "fabsf",
            Op::Round => "rintf",
            Op::CopySign => "etendue_shader_copysign",
            Op::Lesser => "etendue_shader_lesser",
            Op::Greater => "etendue_shader_greater",
            Op::Pow2Scale => "etendue_shader_pow2_scale",
            Op::InverseCbrtEstimate => "etendue_shader_inverse_cbrt_estimate",
            Op::Unit => "etendue_shader_unit",
            Op::FromWord => "etendue_shader_from_word",
            Op::ToWord => "etendue_shader_to_word",
            Op::WordReverse => "etendue_shader_reverse_bits",
            Op::WordLess => "etendue_shader_word_less",
            Op::FromBits => "etendue_shader_from_bits",
            _ => panic!("{op:?} is an operator and not a function"),
        }
    }
    fn select(&self, mask: &Expression, yes: &Expression, no: &Expression) -> Expression {
        let [mask, yes, no] = [mask, yes, no].map(|of| of.at(Level::Sum));
        Expression { text: format!("{mask} ? {yes} : {no}"), level: Level::Loose }
    }
    fn open_struct(&self, _: &str) -> String {
        "typedef struct {\n".into()
    }
    fn field(&self, of: &str, name: &str) -> String {
        format!("    {of} {name};\n")
    }
    fn close_struct(&self, name: &str) -> String {
        format!("}} {name};\n")
    }
    fn open_function(&self, result: &str, name: &str, parameters: &str) -> String {
        let parameters = if parameters.is_empty() { "void" } else { parameters };
        format!("ETENDUE_FUNCTION {result} {name}({parameters}) {{\n")
    }
    fn parameter(&self, of: &str, name: &str) -> String {
        format!("{of} {name}")
    }
    fn constant(&self, of: Leaf, name: &str, value: &str) -> String {
        format!("const {} {name} = {value};", self.leaf(of))
    }
    fn mutable(&self, of: Leaf, name: &str, value: &str) -> String {
        format!("{} {name} = {value};", self.leaf(of))
    }
    fn open_loop(&self, counter: &str, most: usize, condition: &str) -> String {
        format!("for (int {counter} = 0; {counter} < {most}{condition}; ++{counter}) {{")
    }
    fn unused(&self, name: &str) -> Option<String> {
        Some(format!("(void){name};"))
    }
    fn result(&self, of: &str) -> String {
        format!("{of} result;")
    }
}
