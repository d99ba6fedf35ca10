//! Programs for other devices: a folder with the source of each in CUDA and in WGSL, what it is given, and what Rust returns.
//!
//! `CASES=folder cargo test -p etendue-shader --test c99` writes them instead of compiling C, with `LONG=1` all of them. `folder/run` then
//! needs nvcc and a GPU, and nothing of this library; `etendue-shader-device folder` runs WGSL.

use crate::program::Driver;
use core::fmt::Write;
use etendue_shader::*;
use std::fs;
use std::path::Path;

const FILES: [(&str, &str); 3] = [
    ("run", include_str!("cuda/run")),
    ("case.h", include_str!("cuda/case.h")),
    ("main.cu", include_str!("cuda/main.cu")),
];

impl Driver<'_> {
    pub(crate) fn write_case(&self, folder: &Path, name: &str, inputs: &[Vec<f32>], right: &[Vec<f32>]) {
        let write = |file: &str, bytes: &[u8]| {
            let path = folder.join(file);
            fs::write(&path, bytes).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        };
        fs::create_dir_all(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        FILES.iter().for_each(|(file, text)| write(file, text.as_bytes()));
        write(&format!("{name}.cu"), self.cuda(name).as_bytes());
        let [wgsl, exact] = [false, true].map(|exact| self.wgsl_kernel(Wgsl { exact }));
        write(&format!("{name}.wgsl"), wgsl.as_bytes());
        for (ending, wgsl) in [("spv", &wgsl), ("exact.spv", &exact)] {
            let spirv = Checked::new(wgsl).and_then(|checked| checked.translate(Target::SpirV));
            write(&format!("{name}.{ending}"), &spirv.unwrap_or_else(|error| panic!("{name}: {error}")));
        }
        let operations: usize = self.module.functions.iter().map(Function::operations).sum();
        write(&format!("{name}.txt"), format!("{operations}\n{}\n", self.outputs.join("\n")).as_bytes());
        let counts = [inputs.len(), self.inputs, self.outputs.len(), self.memory.len()].map(|count| count as u32);
        let numbers = inputs.iter().chain(right).flatten().map(|x| x.to_bits());
        let words = counts.into_iter().chain(self.memory.iter().copied()).chain(numbers);
        write(&format!("{name}.bin"), &words.flat_map(u32::to_le_bytes).collect::<Vec<_>>());
    }
    /// A kernel that runs the program for each of many inputs, and another one that is there to be timed.
    fn cuda(&self, name: &str) -> String {
        let mut text = format!("#include \"case.h\"\n{}", print(self.module, &C, "Made by a test."));
        let memory = if self.module.reads_memory() {
            "    const EtendueShaderMemory memory = {of.words, of.word_count};\n    (void)memory;\n"
        } else {
            ""
        };
        let _ = writeln!(
            text,
            "static __global__ void run(Arguments of) {{\n    const size_t k = thread_index();\n    if (k >= of.count) return;\n    const \
             float *const in = of.inputs + k * {};\n    float *const out = of.outputs + k * {};\n{memory}    {{\n{}    }}\n}}",
            self.inputs,
            self.outputs.len(),
            self.c()
        );
        let timed = self.timed_c().map(|[before, call]| {
            let _ = writeln!(
                text,
                "static __global__ void timed(Arguments of) {{\n    const size_t thread = thread_index();\n    const float *const in = \
                 of.inputs + thread / 32 % of.count * {};\n{before}    float sum = 0.0f;\n    for (unsigned k = 0; k < of.rounds; ++k) {{\n    \
                 u.x = random_number(thread, k, 3242174889u);\n    u.y = random_number(thread, k, 2447445413u);\n{call}    }}\n    \
                 of.outputs[thread] = sum;\n}}",
                self.inputs
            );
            "timed"
        });
        let _ = writeln!(text, "static const bool known = add_case(\"{name}\", run, {});", timed.unwrap_or("0"));
        text
    }
    /// An entry point that runs the program for each of many inputs.
    fn wgsl_kernel(&self, language: Wgsl) -> String {
        let (source, program) = (print(self.module, &language, "Made by a test."), self.wgsl());
        let (takes, gives, entry) = (self.inputs, self.outputs.len(), include_str!("devices/entry.wgsl"));
        format!("{source}const takes = {takes}u;\nconst gives = {gives}u;\n{program}{entry}")
    }
}
