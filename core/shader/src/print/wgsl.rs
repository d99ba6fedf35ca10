//! WGSL.

use super::dialect::{Dialect, Expression, decimal};
use crate::graph::Op;
use crate::module::Leaf;

/// WGSL.
#[derive(Clone, Copy, Debug, Default)]
pub struct Wgsl {
    /// Whether fused multiply-adds, quotients and square roots are written out, as the language does not promise to round them correctly.
    pub exact: bool,
}

const PRELUDE: &str = include_str!("prelude.wgsl");

impl Dialect for Wgsl {
    fn begin(&self, how: &str) -> String {
        let exact = if self.exact { include_str!("exact.wgsl") } else { "" };
        format!("// Light sampling for renderers, in WGSL. MIT or Apache-2.0.\n// {how}\n{PRELUDE}{exact}\n")
    }
    fn end(&self) -> String {
        String::new()
    }
    fn memory(&self) -> &'static str {
        include_str!("memory.wgsl")
    }
    fn memory_parameter(&self) -> Option<(&'static str, &'static str)> {
        None
    }
    fn leaf(&self, leaf: Leaf) -> &'static str {
        match leaf {
            Leaf::Real => "f32",
            Leaf::Truth => "bool",
            Leaf::Word => "u32",
            Leaf::Vec2 => "vec2<f32>",
            Leaf::Vec3 => "vec3<f32>",
        }
    }
    fn real(&self, value: f32) -> Expression {
        // an infinite constant would be an error
        let infinite = || "etendue_shader_from_bits(0x7f800000u)".into();
        let text = if value.is_infinite() { infinite() } else { format!("{}f", decimal(value.abs())) };
        if value.is_sign_negative() { Expression::prefix("-", &Expression::atom(text)) } else { Expression::atom(text) }
    }
    fn word(&self, value: u32) -> String {
        format!("{value}u")
    }
    // the others are branches
    fn and(&self) -> &'static str {
        "&"
    }
    fn or(&self) -> &'static str {
        "|"
    }
    fn function(&self, op: Op) -> &'static str {
        match op {
            Op::MulAdd if self.exact => "etendue_shader_exact_fma",
            Op::MulAdd => "fma",
            Op::Sqrt if self.exact => "etendue_shader_exact_sqrt",
            Op::Sqrt => "sqrt",
            Op::Abs => "abs",
            Op::Round => "round",
            Op::CopySign => "etendue_shader_copysign",
            Op::Lesser => "etendue_shader_lesser",
            Op::Greater => "etendue_shader_greater",
            Op::Pow2Scale => "etendue_shader_pow2_scale",
            Op::InverseCbrtEstimate => "etendue_shader_inverse_cbrt_estimate",
            Op::Unit => "etendue_shader_unit",
            Op::FromWord => "etendue_shader_from_word",
            Op::ToWord => "etendue_shader_to_word",
            Op::WordReverse => "reverseBits",
            Op::WordLess => "etendue_shader_word_less",
            Op::FromBits => "etendue_shader_from_bits",
            _ => panic!("{op:?} is an operator and not a function"),
        }
    }
    fn quotient(&self) -> Option<&'static str> {
        self.exact.then_some("etendue_shader_exact_quotient")
    }
    fn select(&self, mask: &Expression, yes: &Expression, no: &Expression) -> Expression {
        Expression::atom(format!("select({}, {}, {})", no.text, yes.text, mask.text))
    }
    fn open_struct(&self, name: &str) -> String {
        format!("struct {name} {{\n")
    }
    fn field(&self, of: &str, name: &str) -> String {
        format!("    {name}: {of},\n")
    }
    fn close_struct(&self, _: &str) -> String {
        "}\n".into()
    }
    fn open_function(&self, result: &str, name: &str, parameters: &str) -> String {
        format!("fn {name}({parameters}) -> {result} {{\n")
    }
    fn parameter(&self, of: &str, name: &str) -> String {
        format!("{name}: {of}")
    }
    fn constant(&self, _: Leaf, name: &str, value: &str) -> String {
        format!("let {name} = {value};")
    }
    fn mutable(&self, _: Leaf, name: &str, value: &str) -> String {
        format!("var {name} = {value};")
    }
    fn open_loop(&self, counter: &str, most: usize, condition: &str) -> String {
        format!("for (var {counter} = 0; {counter} < {most}{condition}; {counter}++) {{")
    }
    fn unused(&self, _: &str) -> Option<String> {
        None
    }
    fn result(&self, of: &str) -> String {
        format!("var result: {of};")
    }
}
