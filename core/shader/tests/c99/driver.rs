//! Programs in C, compiled and run, and the comparison of what they return.

use crate::program::Driver;
use etendue_oracle::tier::cases;
use etendue_shader::*;
use std::fs;
use std::io::Write as _;
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// How many arguments each routine gets.
pub(crate) fn slots() -> usize {
    cases(160, 1600)
}

/// What floating-point numbers have to offer against routines.
pub(crate) const HOSTILE: [f32; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    1e-45,
    -1e-45,
    1e-40,
    f32::MIN_POSITIVE,
    -f32::MIN_POSITIVE,
    1e-30,
    1e30,
    f32::MAX,
    -f32::MAX,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
];

/// A folder of its own for each test.
pub(crate) fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).unwrap();
    folder
}

impl Driver<'_> {
    /// Asserts that this program returns the numbers of Rust in C, and in OpenCL C where a device is; or, with `CASES`, writes it for other
    /// machines.
    pub(crate) fn same_bits(&self, name: &str, flags: &[&str], inputs: &[Vec<f32>], right: &[Vec<f32>]) {
        if let Some(folder) = std::env::var_os("CASES") {
            return self.write_case(folder.as_ref(), name, inputs, right);
        }
        compare(name, inputs, right, &self.run(name, flags, inputs));
        if let Some(found) = self.run_opencl(name, inputs) {
            compare(&format!("{name} in OpenCL"), inputs, right, &found);
        }
    }
    /// Compiles the source in C with a program that maps the numbers of its input to those of its output, and runs it.
    pub(crate) fn run(&self, name: &str, flags: &[&str], inputs: &[Vec<f32>]) -> Vec<Vec<f32>> {
        let mut compile = Command::new(std::env::var("CC").unwrap_or_else(|_| "cc".into()));
        compile.args(["-std=c99", "-Wall", "-Wextra", "-Werror"]).args(flags);
        let mut source = print(self.module, &C, "Made by a test.");
        if self.module.reads_memory() {
            source += &self.words("etendue_shader_word");
            source += "static const EtendueShaderMemory memory = {words, sizeof words / 4};\n";
        }
        self.run_source(name, "c", &source, &self.c(), compile, inputs)
    }
    /// The same of the source in the Metal shading language, which is C++ with another standard library.
    pub(crate) fn run_metal(&self, name: &str, inputs: &[Vec<f32>]) -> Vec<Vec<f32>> {
        let text = String::from_utf8(Language::Msl.write(self.module, "Made by a test.").unwrap()).unwrap();
        let includes = "#include <metal_stdlib>\n#include <simd/simd.h>\n";
        assert!(text.contains(includes), "{name}: other includes");
        let mut compile = Command::new(std::env::var("CXX").unwrap_or_else(|_| "c++".into()));
        compile.args(["-std=c++14", "-O1"]);
        let mut source = with_single_constants(&text.replace(includes, include_str!("metal.hpp")));
        let mut calls = self.c();
        if self.module.reads_memory() {
            // an array of unknown length is one of length 1 there, and the last two parameters are what functions get in C at first
            let of_words = |line: &str| line.starts_with("typedef uint type_") && line.ends_with("[1];");
            let longer = |line: &str| line.replace("[1];", &format!("[{}];", self.memory.len()));
            source = lines(&source, of_words, longer);
            source += &self.words("metal::uint");
            source += "static const _mslBufferSizes sizes = {sizeof words};\n";
            let last = |line: &str| line.replace("(memory, ", "(").replace(");", ", words, sizes);");
            calls = lines(&calls, |line| line.contains("(memory, "), last);
        }
        self.run_source(name, "cpp", &source, &calls, compile, inputs)
    }
    /// The memory as an array.
    fn words(&self, word: &str) -> String {
        let words: Vec<String> = self.memory.iter().map(|word| format!("{word}u")).collect();
        format!("static const {word} words[] = {{{}}};\n", words.join(", "))
    }
    fn run_source(
        &self,
        name: &str,
        ending: &str,
        source: &str,
        calls: &str,
        mut compile: Command,
        inputs: &[Vec<f32>],
    ) -> Vec<Vec<f32>> {
        let folder = folder(name);
        fs::write(folder.join("etendue.h"), source).unwrap();
        let program = format!(
            "#include \"etendue.h\"\n#include <stdio.h>\nstatic void run(const float *in, float *out) {{\n{}}}\nint main(void) {{\n    \
             static float in[{}], out[{}];\n    while (fread(in, sizeof in, 1, stdin) == 1) {{\n        run(in, out);\n        \
             fwrite(out, sizeof out, 1, stdout);\n    }}\n    return 0;\n}}\n",
            calls,
            self.inputs,
            self.outputs.len()
        );
        let [source, binary] = [&format!("main.{ending}"), "main"].map(|file| folder.join(file));
        fs::write(&source, program).unwrap();
        compile.args(["-ffp-contract=off", "-o"]).arg(&binary).arg(&source).arg("-lm");
        let compiled = compile.output().expect("a compiler of C and C++");
        assert!(compiled.status.success(), "{name}: {}", String::from_utf8_lossy(&compiled.stderr));
        assert!(inputs.iter().all(|input| input.len() == self.inputs), "{name}: {} inputs", self.inputs);
        numbers_of(name, Command::new(&binary), inputs, self.outputs.len())
    }
}

/// What a program writes that reads these numbers: so many for each input.
pub(crate) fn numbers_of(name: &str, mut program: Command, inputs: &[Vec<f32>], outputs: usize) -> Vec<Vec<f32>> {
    let mut child = program.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let bytes: Vec<u8> = inputs.iter().flatten().flat_map(|x| x.to_ne_bytes()).collect();
    let mut stdin = child.stdin.take().unwrap();
    // a program that fails before it has read all says why
    let writer = std::thread::spawn(move || stdin.write_all(&bytes));
    let output = child.wait_with_output().unwrap();
    let written = writer.join().unwrap();
    assert!(output.status.success(), "{name}: {}\n{}", output.status, String::from_utf8_lossy(&output.stderr));
    written.unwrap();
    let numbers: Vec<f32> =
        output.stdout.chunks_exact(4).map(|word| f32::from_ne_bytes(word.try_into().unwrap())).collect();
    numbers.chunks_exact(outputs).map(<[f32]>::to_vec).collect()
}

/// Text with each line replaced for which `is` holds.
fn lines(text: &str, is: impl Fn(&str) -> bool, by: impl Fn(&str) -> String) -> String {
    text.lines().map(|line| if is(line) { by(line) } else { line.to_owned() } + "\n").collect()
}

/// Text of Metal with `f` after each constant: what is a number of single precision there is one of double precision in C++.
fn with_single_constants(text: &str) -> String {
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
    let (mut all, mut rest) = (String::new(), text);
    while let Some(begin) = rest.find(is_word) {
        let (before, word) = rest.split_at(begin);
        let mut end = word.find(|c| !is_word(c)).unwrap_or(word.len());
        let is_number = word.starts_with(|c: char| c.is_ascii_digit()) && !word.starts_with("0x");
        if is_number && word[..end].ends_with('e') {
            // the exponent is negative
            end += 1 + word[end + 1..].find(|c| !is_word(c)).unwrap_or(word.len() - end - 1);
        }
        all += before;
        all += &word[..end];
        if is_number && word[..end].contains(['.', 'e']) && !word[..end].ends_with('f') {
            all.push('f');
        }
        rest = &word[end..];
    }
    all + rest
}

/// Compares all bits; those of NaN say nothing, so that all are one.
pub(crate) fn compare(name: &str, inputs: &[Vec<f32>], right: &[Vec<f32>], found: &[Vec<f32>]) {
    let bits = |x: f32| if x.is_nan() { f32::NAN.to_bits() } else { x.to_bits() };
    assert_eq!(right.len(), found.len(), "{name}");
    for ((input, right), found) in inputs.iter().zip(right).zip(found) {
        assert_eq!(right.len(), found.len(), "{name}");
        for (k, (x, y)) in right.iter().zip(found).enumerate() {
            assert!(
                bits(*x) == bits(*y),
                "{name}: output {k} is {y:e} in the source and {x:e} in Rust, for {input:?}\n{right:?}\n{found:?}"
            );
        }
    }
    println!("{name:50} {:3} numbers, {} times: the same bits", right[0].len(), right.len());
}
