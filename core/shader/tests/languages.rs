//! Every light and every warp in every language.

use etendue_oracle::tier::{cases, is_long};
use etendue_shader::*;
use std::collections::{HashMap, HashSet};

fn everything() -> Selection {
    Selection {
        lights: vec!["all".into()],
        warps: vec!["all".into()],
        tools: vec!["all".into()],
        tables: vec!["all".into()],
        wanted: Wanted::default(),
        exact: false,
    }
}

/// Everything; with few cases, every third of the lights by their techniques, without those that are several triangles written out, which
/// take translators longest.
fn translated() -> Selection {
    let techniques = lights().into_iter().flat_map(|(_, techniques)| techniques);
    let is_large = |name: &str| {
        let several = ["rectangle", "parallelogram"].iter().any(|light| name.starts_with(light));
        name.starts_with("polygon") || several && name.ends_with("projected_solid_angle")
    };
    let (long, mut kind) = (is_long(), 0);
    let is_here = |name: &String| {
        kind += 1;
        long || kind % 3 == 1 && !is_large(name)
    };
    Selection { lights: techniques.filter(is_here).collect(), ..everything() }
}

/// `naga` accepts the WGSL with all checks, and writes all other languages; each has every function, with its comment.
#[test]
fn all_languages_have_all_functions() {
    let module = translated().module();
    assert!(module.functions.len() > cases(90, 200), "{} functions", module.functions.len());
    let check = |language: Language| {
        let bytes = language
            .write(&module, "Written by a test.")
            .unwrap_or_else(|error| panic!("{}: {error}", language.name()));
        println!("{:8} {:9} bytes", language.name(), bytes.len());
        if language == Language::SpirV {
            // the magic number, and a whole number of words
            assert!(bytes.starts_with(&0x0723_0203_u32.to_le_bytes()) && bytes.len().is_multiple_of(4));
            let text = String::from_utf8_lossy(&bytes);
            let named = module.functions.iter().filter(|function| text.contains(&function_name(&function.name)));
            assert_eq!(named.count(), module.functions.len());
            // decorations of sums and products, which drivers would combine otherwise
            let words: Vec<u32> = bytes.as_chunks().0.iter().map(|word| u32::from_le_bytes(*word)).collect();
            let (decorate, no_contraction) = (3 << 16 | 71, 42);
            let decorated = words.windows(3).filter(|of| of[0] == decorate && of[2] == no_contraction).count();
            let operations: usize = module.functions.iter().map(Function::operations).sum();
            assert!(2 * decorated > operations, "{decorated} of {operations} operations");
            return;
        }
        let text = String::from_utf8(bytes).unwrap();
        assert!(text.is_ascii(), "{}", language.name());
        let lines: Vec<&str> = text.lines().collect();
        // the lines that begin functions, by their names
        let begins = lines.iter().enumerate().filter(|(_, line)| !line.starts_with([' ', '}', '/']));
        let begins = begins.filter_map(|(at, line)| Some((line.split_once('(')?.0.rsplit(' ').next()?, at)));
        let begins: HashMap<&str, usize> = begins.collect();
        for function in &module.functions {
            let name = function_name(&function.name);
            let first = begins.get(&*name).unwrap_or_else(|| panic!("{}: no {name}", language.name()));
            assert!(lines[first - 1].starts_with("// "), "{}: {name} has no comment", language.name());
        }
        assert!(!text.contains("void main"), "{}", language.name());
    };
    // translators take long, one thread each
    std::thread::scope(|scope| {
        for half in Language::ALL.chunks(Language::ALL.len().div_ceil(2)) {
            scope.spawn(|| half.iter().copied().for_each(check));
        }
    });
}

/// A host may include these functions and the library's header in one program: names and types of one are not those of the other.
#[test]
fn no_name_in_c_is_one_of_the_library() {
    let include = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../c/include");
    let read = |name| std::fs::read_to_string(include.join(name)).unwrap();
    let library = ["etendue.h", "etendue_typed.h", "etendue.hpp"].map(read).concat();
    let text = String::from_utf8(Language::C.write(&translated().module(), "Written by a test.").unwrap()).unwrap();
    let names = |text: &str| -> HashSet<String> {
        let words = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        words.filter(|word| word.to_ascii_lowercase().starts_with("etendue")).map(str::to_owned).collect()
    };
    let (theirs, ours) = (names(&library), names(&text));
    assert!(theirs.contains("EtendueLightSample") && ours.contains("EtendueShaderLightSample"));
    // the name of the library in a sentence
    assert_eq!(theirs.intersection(&ours).filter(|name| *name != "etendue").collect::<Vec<_>>(), Vec::<&String>::new());
}

/// Sources without tables have no buffer, and those with tables are of a version that has buffers.
#[test]
fn tables_are_in_a_buffer() {
    let write = |language: Language, selection: &Selection| {
        String::from_utf8(language.write(&selection.module(), "Written by a test.").unwrap()).unwrap()
    };
    let without = Selection { tools: vec!["balance_weights".into()], ..Selection::default() };
    let with = Selection { tables: vec!["reflection".into()], ..without.clone() };
    for (language, buffer, version) in [
        (Language::C, "etendue_shader_load(EtendueShaderMemory memory, etendue_shader_word k)", "C99"),
        (Language::Wgsl, "@group(0) @binding(0) var<storage, read> etendue_shader_memory: array<u32>;", "in WGSL"),
        (Language::Glsl, "layout(std430, binding = 0) readonly buffer", "GLSL 4.50"),
        (Language::GlslEs, "layout(std430, binding = 0) readonly buffer", "GLSL ES 3.10"),
        (Language::Hlsl, "ByteAddressBuffer etendue_shader_memory : register(t0);", "in HLSL"),
        (Language::Msl, "device type_", "last parameters"),
    ] {
        let (without, with) = (write(language, &without), write(language, &with));
        assert!(!without.contains(buffer), "{}", language.name());
        let preface = with.lines().take(9).collect::<Vec<_>>().join(" ");
        assert!(with.contains(buffer) && preface.contains(version), "{}: {preface}", language.name());
        assert!(!with.contains("_group_0_binding_0"), "{}", language.name());
    }
    assert!(write(Language::GlslEs, &without).contains("GLSL ES 3.00"));
}

/// Bits and shifts have operands in parentheses: the grammar of WGSL mixes them with no other operators, which `naga` does not check.
#[test]
fn operands_of_bits_have_parentheses_in_wgsl() {
    let selection = Selection { tables: vec!["reflection".into()], tools: vec!["all".into()], ..Selection::default() };
    let module = selection.module();
    let text = print(&module, &Wgsl::default(), "Written by a test.");
    let (mut bits, mut shifts) = (0, 0);
    for line in text.lines().filter(|line| !line.trim_start().starts_with("//")) {
        // the operators at each depth of parentheses
        let mut open: Vec<Vec<&str>> = vec![Vec::new()];
        for word in line.split_inclusive(['(', ')', ' ', ',']) {
            let (token, end) = word.split_at(word.len() - usize::from(word.ends_with(['(', ')', ' ', ','])));
            let all = open.last_mut().unwrap();
            if matches!(token, "+" | "-" | "*" | "/" | "^" | "<<" | ">>" | "&" | "|") {
                all.push(token);
            }
            let bitwise = all.iter().filter(|token| matches!(**token, "^" | "<<" | ">>" | "&" | "|")).count();
            let chain = all.windows(2).all(|pair| pair[0] == pair[1]) && !all.iter().any(|token| token.len() == 2);
            assert!(bitwise == 0 || all.len() == 1 || chain, "{line}");
            match end {
                "(" => open.push(Vec::new()),
                ")" => drop(open.pop()),
                "," => all.clear(),
                _ => {}
            }
        }
        bits += line.matches(" ^ ").count();
        shifts += line.matches(" >> ").count();
    }
    assert!(bits > 20 && shifts > 20, "{bits} and {shifts}");
}

/// What is not WGSL is an error with its place.
#[test]
fn broken_sources_are_found() {
    let module = Selection { lights: vec!["sun".into()], ..Selection::default() }.module();
    let text = print(&module, &Wgsl::default(), "Written by a test.");
    Checked::new(&text).unwrap();
    for (from, to, why) in [
        (
            "fn etendue_shader_lesser(a: f32, b: f32) -> f32 {",
            "fn etendue_shader_lesser(a: f32, b: f32) -> u32 {",
            "type",
        ),
        ("fn etendue_shader_greater(", "fn etendue_shader_other(", "etendue_shader_greater"),
        ("    return bitcast<f32>(bits);", "    return bits;", "return"),
    ] {
        assert!(text.contains(from), "{from}");
        let error = Checked::new(&text.replacen(from, to, 1)).expect_err(from);
        assert!(error.contains(why), "{error}");
    }
}
