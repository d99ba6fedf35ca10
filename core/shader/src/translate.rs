//! From WGSL to the other shading languages, by `naga`, which also checks the types and the control flow.

use naga::back::{glsl, hlsl, msl, spv};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Module, ResourceBinding, ShaderStage};

/// A language into which WGSL is translated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// GLSL 4.50, for OpenGL and Vulkan.
    Glsl,
    /// GLSL ES 3.00, for WebGL 2; of modules that read memory GLSL ES 3.10, since the other has none.
    GlslEs,
    /// HLSL, shader model 5.1 and later.
    Hlsl,
    /// The Metal shading language, 2.1 and later.
    Msl,
    /// SPIR-V 1.3, in binary words, with the names of functions, and `NoContraction` on all sums and products.
    SpirV,
}

/// Whether the translator adds a counter to loops that may not end: all of them end by themselves.
const BOUNDS_LOOPS: bool = false;

/// SPIR-V in which each sum, product and quotient of numbers says that it must not be combined with others, nor be reordered: the translator
/// does not write that.
fn without_contraction(words: &[u32]) -> Vec<u32> {
    const HEADER: usize = 5;
    // what comes before the types: names and decorations among others
    let is_before_types = |opcode: u32| matches!(opcode, 3..=7 | 10 | 11 | 14..=17 | 71 | 72 | 330);
    // calls of the library of GLSL, negations, sums, differences, products, and quotients
    let is_arithmetic = |opcode: u32| matches!(opcode, 12 | 127 | 129 | 131 | 133 | 136);
    let (decorate, no_contraction) = (71, 42);
    let (mut types, mut decorations, mut at) = (None, Vec::new(), HEADER);
    while at < words.len() {
        let (opcode, length) = (words[at] & 0xffff, (words[at] >> 16) as usize);
        if !is_before_types(opcode) {
            types.get_or_insert(at);
        }
        if is_arithmetic(opcode) {
            decorations.extend([3 << 16 | decorate, words[at + 2], no_contraction]);
        }
        at += length;
    }
    let (before, after) = words.split_at(types.unwrap_or(words.len()));
    [before, &decorations, after].concat()
}

/// A module of WGSL that has been checked.
#[derive(Debug)]
pub struct Checked<'a> {
    wgsl: &'a str,
    module: Module,
    info: ModuleInfo,
}

impl<'a> Checked<'a> {
    /// Reads WGSL and checks it.
    ///
    /// # Errors
    /// If it is not valid: what is wrong, with the line.
    pub fn new(wgsl: &'a str) -> Result<Self, String> {
        let module = naga::front::wgsl::parse_str(wgsl).map_err(|error| error.emit_to_string(wgsl))?;
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
        let info = validator.validate(&module).map_err(|error| error.emit_to_string(wgsl))?;
        Ok(Self { wgsl, module, info })
    }
    /// The module in another language.
    ///
    /// # Errors
    /// If the module needs what the language does not have: what that is.
    pub fn translate(&self, target: Target) -> Result<Vec<u8>, String> {
        match target {
            Target::Glsl => self.glsl(glsl::Version::Desktop(450)),
            Target::GlslEs if self.has_memory() => self.glsl(glsl::Version::Embedded { version: 310, is_webgl: false }),
            Target::GlslEs => self.glsl(glsl::Version::Embedded { version: 300, is_webgl: true }),
            Target::Hlsl => self.hlsl(),
            Target::Msl => {
                let (lang_version, force_loop_bounding) = ((2, 1), BOUNDS_LOOPS);
                let options = msl::Options { lang_version, force_loop_bounding, ..msl::Options::default() };
                let text = msl::write_string(&self.module, &self.info, &options, &msl::PipelineOptions::default());
                Ok(text.map_err(|error| error.to_string())?.0.into_bytes())
            }
            Target::SpirV => {
                // the names of functions are all that tells which is which, as a library has no entry points
                let flags = spv::WriterFlags::DEBUG;
                let (lang_version, force_loop_bounding) = ((1, 3), BOUNDS_LOOPS);
                let options = spv::Options { lang_version, flags, force_loop_bounding, ..spv::Options::default() };
                let words = spv::write_vec(&self.module, &self.info, &options, None);
                let words = without_contraction(&words.map_err(|error| error.to_string())?);
                Ok(words.iter().flat_map(|word| word.to_le_bytes()).collect())
            }
        }
    }
    /// Whether it reads memory.
    #[must_use]
    pub fn has_memory(&self) -> bool {
        !self.module.global_variables.is_empty()
    }
    fn hlsl(&self) -> Result<Vec<u8>, String> {
        let options = hlsl::Options { force_loop_bounding: BOUNDS_LOOPS, ..hlsl::Options::default() };
        let pipeline = hlsl::PipelineOptions::default();
        let mut text = String::new();
        let mut writer = hlsl::Writer::new(&mut text, &options, &pipeline);
        writer.write(&self.module, &self.info, None).map_err(|error| error.to_string())?;
        Ok(text.into_bytes())
    }
    /// GLSL is translated for an entry point alone: one that does nothing but read memory, if others do. It is then left out with the line of
    /// the version, so that the text can stand in any shader.
    fn glsl(&self, version: glsl::Version) -> Result<Vec<u8>, String> {
        let read = if self.has_memory() { "_ = etendue_shader_load(0u);" } else { "" };
        let wgsl = format!("{}@fragment fn main() {{{read}}}\n", self.wgsl);
        let Checked { module, info, .. } = &Checked::new(&wgsl)?;
        let place = ResourceBinding { group: 0, binding: 0 };
        let options = glsl::Options { version, binding_map: [(place, 0)].into(), ..glsl::Options::default() };
        let entry_point = "main".into();
        let pipeline = glsl::PipelineOptions { shader_stage: ShaderStage::Fragment, entry_point, multiview: None };
        let mut text = String::new();
        let bounds = naga::proc::BoundsCheckPolicies::default();
        let writer = glsl::Writer::new(&mut text, module, info, &options, &pipeline, bounds);
        writer.and_then(|mut writer| writer.write()).map_err(|error| error.to_string())?;
        let functions = text.rsplit_once("void main() {");
        let functions = functions.and_then(|(text, _)| text.strip_prefix("#version")?.split_once('\n'));
        let (_, functions) = functions.ok_or("the translator puts the version and the entry point elsewhere")?;
        // the name that it has in the other languages
        Ok(functions.trim().replace("_group_0_binding_0_fs", "etendue_shader_memory").into_bytes())
    }
}
