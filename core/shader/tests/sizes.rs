//! How large the functions are: operations, and instructions of C and of the scalar Rust routine for the same processor.
//!
//! `cargo test --release -p etendue-shader --test sizes -- --ignored --nocapture` prints the table. It needs a C compiler and objdump, on
//! x86-64.

use etendue::{LightSample, LightSampler, Vec2, Vec3};
use etendue_shader::*;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The functions of a binary: by their first address, their name, how many instructions they have, and where they call.
struct Disassembly(BTreeMap<u64, (String, usize, BTreeSet<u64>)>);

impl Disassembly {
    fn of(binary: &Path) -> Self {
        let output = Command::new("objdump").args(["-d", "--no-show-raw-insn"]).arg(binary).output().expect("objdump");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let mut all: BTreeMap<u64, (String, usize, BTreeSet<u64>)> = BTreeMap::new();
        for line in String::from_utf8_lossy(&output.stdout).lines() {
            if let Some((address, name)) = line.strip_suffix(">:").and_then(|line| line.split_once(" <")) {
                let address = u64::from_str_radix(address, 16).unwrap();
                all.insert(address, (name.to_owned(), 0, BTreeSet::new()));
            } else if let (Some((_, instruction)), Some(mut last)) = (line.split_once(":\t"), all.last_entry()) {
                // what aligns the next function does nothing
                if instruction.starts_with("nop")
                    || instruction.starts_with("int3")
                    || instruction.starts_with("xchg   %ax,%ax")
                    || instruction.contains("nopw")
                {
                    continue;
                }
                last.get_mut().1 += 1;
                let mut words = instruction.split_whitespace();
                if let (Some("call" | "jmp"), Some(target)) = (words.next(), words.next()) {
                    last.get_mut().2.extend(u64::from_str_radix(target, 16));
                }
            }
        }
        Self(all)
    }
    fn find(&self, name: &str) -> u64 {
        let found = self.0.iter().find(|(_, (symbol, ..))| symbol == name);
        *found.unwrap_or_else(|| panic!("there is no {name}")).0
    }
    /// The instructions of a function and of all that it calls, each counted once; those that end the program do not count.
    fn instructions(&self, address: u64) -> usize {
        let (mut seen, mut open, mut sum) = (BTreeSet::new(), vec![address], 0);
        while let Some(address) = open.pop() {
            let Some((name, count, calls)) = self.0.get(&address) else { continue };
            if seen.insert(address) && !name.contains("panic") {
                sum += count;
                open.extend(calls);
            }
        }
        sum
    }
}

/// Tells where this program is in memory.
#[unsafe(no_mangle)]
#[inline(never)]
extern "C" fn etendue_shader_size_anchor() {
    std::hint::black_box(());
}

/// A sample with its weight.
struct Sample {
    _sample: LightSample<f32>,
    _weight: f32,
}
impl Sample {
    #[inline(always)]
    fn new(sample: LightSample<f32>) -> Self {
        Self { _weight: sample.weight(), _sample: sample }
    }
}

#[inline(never)]
fn prepare<T: Technique>(light: &T::Light<f32>, p: &Vec3<f32>, with: &T::With<f32>) -> T::Sampler<f32> {
    T::prepare(light, *p, *with)
}
#[inline(never)]
fn sample<T: Technique>(sampler: &T::Sampler<f32>, u: &Vec2<f32>) -> Sample {
    Sample::new(sampler.sample(*u))
}
#[inline(never)]
fn hit<T: Technique>(sampler: &T::Sampler<f32>, w: &Vec3<f32>) -> Sample {
    Sample::new(sampler.hit(*w))
}
#[inline(never)]
fn pdf<T: Technique>(sampler: &T::Sampler<f32>, w: &Vec3<f32>) -> f32 {
    sampler.pdf(*w)
}
#[inline(never)]
fn invert<T: Technique>(sampler: &T::Sampler<f32>, w: &Vec3<f32>) -> Vec2<f32> {
    sampler.invert(*w)
}

/// A function, its operations, and its instructions in Rust and in C.
type SizeRow = (String, usize, usize, usize);

struct Sizes {
    own: Disassembly,
    base: u64,
    rows: Vec<SizeRow>,
}

impl TechniqueVisitor for Sizes {
    fn visit<T: Technique>(&mut self) {
        let name = technique_name::<T>();
        let wanted = Wanted { parts: [Part::Sample, Part::Pdf, Part::Hit, Part::Invert].into(), ..Wanted::default() };
        let mut module = Module::default();
        add_technique::<T>(&mut module, &wanted);
        add_calls(&mut module);

        let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("sizes");
        fs::create_dir_all(&folder).unwrap();
        let [source, object] = ["c", "so"].map(|ending| folder.join(format!("{name}.{ending}")));
        let text = print(&module, &C, "Written by a test.");
        fs::write(&source, text.replace("#define ETENDUE_FUNCTION static inline\n", "#define ETENDUE_FUNCTION\n"))
            .unwrap();
        // hidden functions call each other directly
        let flags =
            ["-std=c99", "-O2", "-march=x86-64-v3", "-ffp-contract=off", "-fvisibility=hidden", "-fPIC", "-shared"];
        let output = Command::new("cc").args(flags).arg("-o").arg(&object).arg(&source).arg("-lm").output();
        let output = output.expect("a C compiler");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let c = Disassembly::of(&object);

        let rust = [
            ("prepare", prepare::<T> as *const () as u64),
            ("sample", sample::<T> as *const () as u64),
            ("pdf", pdf::<T> as *const () as u64),
            ("hit", hit::<T> as *const () as u64),
            ("invert", invert::<T> as *const () as u64),
        ];
        for (part, address) in rust {
            let function = format!("{name}_{part}");
            let Some(found) = module.functions.iter().find(|known| known.name == function) else { continue };
            let instructions = self.own.instructions(address.wrapping_sub(self.base));
            assert!(instructions > 0, "{function} is not in this program");
            let in_c = c.instructions(c.find(&function_name(&function)));
            self.rows.push((function, found.operations(), instructions, in_c));
        }
    }
}

#[test]
#[ignore = "prints a table; needs objdump and a release build"]
fn sizes() {
    let own = Disassembly::of(&std::env::current_exe().unwrap());
    let base = (etendue_shader_size_anchor as *const () as u64).wrapping_sub(own.find("etendue_shader_size_anchor"));
    let mut sizes = Sizes { own, base, rows: Vec::new() };
    every_technique(&mut sizes);
    println!("| function | operations | instructions, Rust | instructions, C | operations/Rust | C/Rust |");
    println!("|---|---|---|---|---|---|");
    let ratio = |count: usize, rust: usize| count as f64 / rust as f64;
    for (name, operations, rust, c) in &sizes.rows {
        let (operations_ratio, c_ratio) = (ratio(*operations, *rust), ratio(*c, *rust));
        println!("| `{name}` | {operations} | {rust} | {c} | {operations_ratio:.2} | {c_ratio:.2} |");
    }
    let larger = |count: fn(&SizeRow) -> usize| sizes.rows.iter().filter(|row| ratio(count(row), row.2) > 1.3).count();
    println!(
        "{} functions; more than 1.3 times the instructions of Rust: {} by operations, {} by instructions of C",
        sizes.rows.len(),
        larger(|row| row.1),
        larger(|row| row.3)
    );
    assert!(sizes.rows.len() > 100);
}
