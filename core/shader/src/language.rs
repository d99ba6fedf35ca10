//! The languages, by their names on the command line.

use crate::module::Module;
use crate::print::{C, Wgsl, comment, function_name, print};
use crate::translate::{Checked, Target};
use std::collections::HashMap;

/// A language in which sources are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// C99 and C++.
    C,
    /// CUDA.
    Cuda,
    /// HIP.
    Hip,
    /// OpenCL C.
    OpenCl,
    /// WGSL.
    Wgsl,
    /// GLSL 4.50.
    Glsl,
    /// GLSL ES 3.00, or 3.10 where functions read memory.
    GlslEs,
    /// HLSL.
    Hlsl,
    /// The Metal shading language.
    Msl,
    /// SPIR-V, in little-endian words.
    SpirV,
}

impl Language {
    /// All languages.
    pub const ALL: [Self; 10] = [
        Self::C,
        Self::Cuda,
        Self::Hip,
        Self::OpenCl,
        Self::Wgsl,
        Self::Glsl,
        Self::GlslEs,
        Self::Hlsl,
        Self::Msl,
        Self::SpirV,
    ];
    /// Whether the language promises to round fused multiply-adds, quotients and square roots correctly.
    #[must_use]
    pub fn is_exact(self) -> bool {
        matches!(self, Self::C | Self::Cuda | Self::Hip | Self::OpenCl)
    }
    /// Its name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::C => "c",
            Self::Cuda => "cuda",
            Self::Hip => "hip",
            Self::OpenCl => "opencl",
            Self::Wgsl => "wgsl",
            Self::Glsl => "glsl",
            Self::GlslEs => "glsl-es",
            Self::Hlsl => "hlsl",
            Self::Msl => "msl",
            Self::SpirV => "spirv",
        }
    }
    /// The module in this language. `how` is a sentence about how the file was made.
    ///
    /// # Errors
    /// If the module needs what the language does not have: what that is, in the words of the translator.
    pub fn write(self, module: &Module, how: &str) -> Result<Vec<u8>, String> {
        let wgsl = Wgsl { exact: module.exact };
        let target = match self {
            // one dialect
            Self::C | Self::Cuda | Self::Hip | Self::OpenCl => return Ok(print(module, &C, how).into_bytes()),
            Self::Wgsl => {
                let text = print(module, &wgsl, how);
                Checked::new(&text)?;
                return Ok(text.into_bytes());
            }
            Self::Glsl => Target::Glsl,
            Self::GlslEs => Target::GlslEs,
            Self::Hlsl => Target::Hlsl,
            Self::Msl => Target::Msl,
            Self::SpirV => Target::SpirV,
        };
        let bytes = Checked::new(&print(module, &wgsl, how))?.translate(target)?;
        if self == Self::SpirV {
            return Ok(bytes);
        }
        let text = String::from_utf8(bytes).map_err(|error| error.to_string())?;
        Ok((self.preface(how, module.reads_memory()) + &commented(module, &text)).into_bytes())
    }
    fn preface(self, how: &str, reads_memory: bool) -> String {
        let name = match self {
            Self::Glsl => "GLSL 4.50",
            Self::GlslEs if reads_memory => "GLSL ES 3.10, for float and int of high precision",
            Self::GlslEs => "GLSL ES 3.00, for float and int of high precision",
            Self::Hlsl => "HLSL",
            _ => "the Metal shading language",
        };
        let fused = match self {
            // the translator writes a product and a sum
            Self::GlslEs => " This language has no fused multiply-add: double-word arithmetic keeps fewer digits.",
            Self::Hlsl => {
                " The language does not promise that `mad` rounds once: where it rounds twice, double-word arithmetic keeps fewer digits."
            }
            _ => " Turn fast math off: it would reorder operations.",
        };
        let memory = match self {
            _ if !reads_memory => "",
            Self::Msl => {
                " All tables are in one buffer of words, one after another, some of which are numbers by their bits: functions that read it \
                 take it and its size in bytes as their last parameters, and one parameter is the word at which a table begins."
            }
            _ => {
                " All tables are in one buffer of words, one after another, some of which are numbers by their bits: etendue_shader_memory, with the \
                 binding 0, which a host may change. A parameter of each function is the word at which a table begins."
            }
        };
        let text = format!(
            "Results have the bits of the Rust library `etendue` as far as the device rounds each operation correctly, and \
             keeps subnormal numbers, infinities and NaN.{fused}{memory}"
        );
        format!(
            "// Light sampling for renderers, in {name}. MIT or Apache-2.0.\n// {how}\n//\n{}\n",
            comment(&text, "")
        )
    }
}

/// The name of the function that a line begins, if it does.
fn defined(line: &str) -> Option<&str> {
    if line.starts_with([' ', '}']) { None } else { line.split_once('(')?.0.rsplit(' ').next() }
}

/// The text of the translator, which drops comments, with those of the functions.
fn commented(module: &Module, text: &str) -> String {
    let docs: HashMap<String, &str> =
        module.functions.iter().map(|function| (function_name(&function.name), &*function.doc)).collect();
    let mut all = String::new();
    for line in text.lines() {
        if let Some(doc) = defined(line).and_then(|name| docs.get(name)) {
            all += &comment(doc, "");
        }
        all += line;
        all.push('\n');
    }
    all
}
