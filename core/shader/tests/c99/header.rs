//! A header with the most common lights.

use crate::driver::folder;
use etendue_shader::{Language, Selection};
use std::fs;
use std::process::Command;

/// A header in C is C++, too, and its example in the documentation is right.
#[test]
fn a_header_serves_cpp() {
    let lines = include_str!("../../src/lib.rs").lines().skip_while(|line| *line != "//! ```c").skip(1);
    let example: Vec<_> =
        lines.take_while(|line| *line != "//! ```").map(|line| line.trim_start_matches("//! ")).collect();
    assert!(example.len() > 4, "{example:?}");
    let folder = folder("cpp");
    let lights = ["sphere", "triangle", "rectangle"].map(|light| format!("{light}_by_solid_angle")).to_vec();
    let selection = Selection { lights, tools: vec!["all".into()], ..Selection::default() };
    let header = Language::C.write(&selection.module(), "Written by a test.").unwrap();
    fs::write(folder.join("etendue.h"), header).unwrap();
    let text = format!(
        "#include \"etendue.h\"\nint main(void) {{\n{}\nreturn irradiance > 0.0f && irradiance < 1.0f ? 0 : 1;\n}}\n",
        example.join("\n")
    );
    for (compiler, standard, ending) in [("cc", "-std=c99", "c"), ("c++", "-std=c++11", "cpp")] {
        let [source, binary] = [format!("example.{ending}"), format!("example_{ending}")].map(|file| folder.join(file));
        fs::write(&source, &text).unwrap();
        let mut compile = Command::new(compiler);
        compile.args([standard, "-Wall", "-Wextra", "-Werror", "-O1", "-ffp-contract=off", "-o"]).arg(&binary);
        let compiled = compile.arg(&source).arg("-lm").output().expect("a C and a C++ compiler");
        assert!(compiled.status.success(), "{compiler}: {}", String::from_utf8_lossy(&compiled.stderr));
        assert!(Command::new(&binary).status().unwrap().success(), "{compiler}");
    }
}
