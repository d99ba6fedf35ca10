//! Every light and every warp in every language.

use etendue_shader::*;
use std::collections::HashMap;

fn everything() -> Selection {
    Selection {
        lights: vec!["all".into()],
        warps: vec!["all".into()],
        tools: vec!["all".into()],
        wanted: Wanted::default(),
    }
}

/// `naga` accepts the WGSL with all checks, and writes all other languages; each has every function, with its comment.
#[test]
fn all_languages_have_all_functions() {
    let module = everything().module();
    assert!(module.functions.len() > 200, "{} functions", module.functions.len());
    for language in Language::ALL {
        let bytes = language
            .write(&module, "Written by a test.")
            .unwrap_or_else(|error| panic!("{}: {error}", language.name()));
        println!("{:8} {:9} bytes", language.name(), bytes.len());
        if language == Language::SpirV {
            // the magic number, and a whole number of words
            assert!(bytes.starts_with(&0x0723_0203_u32.to_le_bytes()) && bytes.len().is_multiple_of(4));
            continue;
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
    }
}

/// What is not WGSL is an error with its place.
#[test]
fn broken_sources_are_found() {
    let module = Selection { lights: vec!["sun".into()], ..Selection::default() }.module();
    let text = print(&module, &Wgsl, "Written by a test.");
    Checked::new(&text).unwrap();
    for (from, to, why) in [
        ("fn etendue_lesser(a: f32, b: f32) -> f32 {", "fn etendue_lesser(a: f32, b: f32) -> u32 {", "type"),
        ("fn etendue_greater(", "fn etendue_other(", "etendue_greater"),
        ("    return bitcast<f32>(bits);", "    return bits;", "return"),
    ] {
        assert!(text.contains(from), "{from}");
        let error = Checked::new(&text.replacen(from, to, 1)).expect_err(from);
        assert!(error.contains(why), "{error}");
    }
}
