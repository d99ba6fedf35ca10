//! Programs in C that map numbers to numbers, and the comparison of what they return.

use core::fmt::Write;
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

/// A C function in the making that takes numbers and returns numbers.
pub(crate) struct Driver<'a> {
    module: &'a Module,
    pub(crate) text: String,
    pub(crate) inputs: usize,
    outputs: usize,
    /// The words that functions read.
    pub(crate) memory: Vec<u32>,
}

impl<'a> Driver<'a> {
    pub(crate) fn new(module: &'a Module) -> Self {
        Self { module, text: String::new(), inputs: 0, outputs: 0, memory: Vec::new() }
    }
    fn type_name(&self, of: Type) -> String {
        match of {
            Type::Leaf(leaf) => C.leaf(leaf).to_owned(),
            Type::Struct(index) => struct_name(&self.module.structs[index].name),
        }
    }
    /// The numbers of a variable.
    fn places(&self, of: Type, name: &str) -> Vec<String> {
        let place = |(field, axis): (Option<usize>, Option<usize>)| {
            let mut place = name.to_owned();
            if let (Type::Struct(of), Some(field)) = (of, field) {
                place = format!("{place}.{}", self.module.structs[of].fields[field].name);
            }
            axis.map_or(place.clone(), |axis| format!("{place}.{}", ["x", "y", "z"][axis]))
        };
        self.module.parts(of).into_iter().map(place).collect()
    }
    /// What each of them is.
    fn leaves(&self, of: Type) -> Vec<Leaf> {
        let leaf = |(field, _): (Option<usize>, Option<usize>)| match (of, field) {
            (Type::Struct(of), Some(field)) => self.module.structs[of].fields[field].leaf,
            (Type::Leaf(leaf), _) => leaf,
            (Type::Struct(_), None) => panic!("a struct has fields"),
        };
        self.module.parts(of).into_iter().map(leaf).collect()
    }
    /// A variable from the next inputs.
    pub(crate) fn take(&mut self, of: Type, name: &str) {
        let _ = writeln!(self.text, "    {} {name};", self.type_name(of));
        for (place, leaf) in self.places(of, name).into_iter().zip(self.leaves(of)) {
            let number = format!("in[{}]", self.inputs);
            let value = match leaf {
                Leaf::Word => format!("etendue_bits({number})"),
                Leaf::Truth => format!("{number} > 0.5f"),
                _ => number,
            };
            let _ = writeln!(self.text, "    {place} = {value};");
            self.inputs += 1;
        }
    }
    pub(crate) fn function(&self, name: &str) -> Option<&'a Function> {
        self.module.functions.iter().find(|function| function.name == name)
    }
    /// Calls a function with these arguments, of which the first is left out where it takes nothing prepared, and puts all that it returns
    /// into a variable.
    pub(crate) fn call(&mut self, name: &str, arguments: &[&str], result: &str) {
        let function = self.function(name).unwrap_or_else(|| panic!("there is no {name}"));
        let arguments = &arguments[arguments.len() - function.parameters.len()..];
        let arguments: Vec<&str> =
            function.reads_memory().then_some("memory").into_iter().chain(arguments.iter().copied()).collect();
        let of = self.type_name(function.result);
        let _ = writeln!(self.text, "    {of} {result} = {}({});", function_name(name), arguments.join(", "));
    }
    /// The same, and returns it.
    pub(crate) fn output(&mut self, name: &str, arguments: &[&str], result: &str) {
        self.call(name, arguments, result);
        let function = self.function(name).unwrap();
        for (place, leaf) in self.places(function.result, result).into_iter().zip(self.leaves(function.result)) {
            let numbers = match leaf {
                // halves of words are numbers
                Leaf::Word => vec![format!("({place} >> 16)"), format!("({place} & 0xffffu)")],
                _ => vec![place],
            };
            for number in numbers {
                let _ = writeln!(self.text, "    out[{}] = (float){number};", self.outputs);
                self.outputs += 1;
            }
        }
    }
    /// Compiles the source in C with a program that maps the numbers of its input to those of its output, and runs it.
    pub(crate) fn run(&self, name: &str, flags: &[&str], inputs: &[Vec<f32>]) -> Vec<Vec<f32>> {
        let mut compile = Command::new(std::env::var("CC").unwrap_or_else(|_| "cc".into()));
        compile.args(["-std=c99", "-Wall", "-Wextra", "-Werror"]).args(flags);
        let mut source = print(self.module, &C, "Made by a test.");
        if self.module.reads_memory() {
            source += &self.words("etendue_word");
            source += "static const EtendueMemory memory = {words, sizeof words / 4};\n";
        }
        self.run_source(name, "c", &source, &self.text, compile, inputs)
    }
    /// The same of the source in the Metal shading language, which is C++ with another standard library.
    pub(crate) fn run_metal(&self, name: &str, inputs: &[Vec<f32>]) -> Vec<Vec<f32>> {
        let text = String::from_utf8(Language::Msl.write(self.module, "Made by a test.").unwrap()).unwrap();
        let includes = "#include <metal_stdlib>\n#include <simd/simd.h>\n";
        assert!(text.contains(includes), "{name}: other includes");
        let mut compile = Command::new(std::env::var("CXX").unwrap_or_else(|_| "c++".into()));
        compile.args(["-std=c++14", "-O1"]);
        let mut source = with_single_constants(&text.replace(includes, include_str!("metal.hpp")));
        let mut calls = self.text.clone();
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
            calls, self.inputs, self.outputs
        );
        let [source, binary] = [&format!("main.{ending}"), "main"].map(|file| folder.join(file));
        fs::write(&source, program).unwrap();
        compile.args(["-ffp-contract=off", "-o"]).arg(&binary).arg(&source).arg("-lm");
        let compiled = compile.output().expect("a compiler of C and C++");
        assert!(compiled.status.success(), "{name}: {}", String::from_utf8_lossy(&compiled.stderr));
        let mut child = Command::new(&binary).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
        let bytes: Vec<u8> = inputs.iter().flatten().flat_map(|x| x.to_ne_bytes()).collect();
        assert!(inputs.iter().all(|input| input.len() == self.inputs), "{name}: {} inputs", self.inputs);
        let mut stdin = child.stdin.take().unwrap();
        let writer = std::thread::spawn(move || stdin.write_all(&bytes).unwrap());
        let output = child.wait_with_output().unwrap();
        writer.join().unwrap();
        assert!(output.status.success(), "{name}: {}", output.status);
        let numbers: Vec<f32> =
            output.stdout.chunks_exact(4).map(|word| f32::from_ne_bytes(word.try_into().unwrap())).collect();
        numbers.chunks_exact(self.outputs).map(<[f32]>::to_vec).collect()
    }
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
