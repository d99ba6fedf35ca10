//! The program: what it writes, and what it says about arguments that it cannot use.

use etendue_shader::Language;
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

fn program(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_etendue-shader")).args(arguments).output().unwrap()
}
fn message(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    assert!(output.stdout.is_empty(), "{output:?}");
    String::from_utf8(output.stderr.clone()).unwrap()
}

#[test]
fn unknown_names_are_errors_with_the_list() {
    let text = message(&program(&["--language", "basic", "--lights", "sphere"]));
    assert!(
        text.contains("'basic'") && text.contains("c, cuda, hip, opencl, wgsl, glsl, glsl-es, hlsl, msl, spirv"),
        "{text}"
    );
    let text = message(&program(&["--language", "c", "--lights", "sphere,cube"]));
    assert!(text.contains("'cube'") && text.contains("triangle_by_solid_angle") && text.contains("sun"), "{text}");
    let text = message(&program(&["--language", "c", "--warps", "cone,cylinder"]));
    assert!(text.contains("'cylinder'") && text.contains("ggx_visible_normals"), "{text}");
    let text = message(&program(&["--language", "c", "--tables", "forest"]));
    assert!(text.contains("'forest'") && text.contains("reflection"), "{text}");
    let text = message(&program(&["--language", "c", "--lights", "sun", "--functions", "draw"]));
    assert!(text.contains("'draw'") && text.contains("sample, pdf, hit, invert, measure"), "{text}");
    let text = message(&program(&["--language", "c", "--lights", "sun", "--fields", "color"]));
    assert!(text.contains("'color'") && text.contains("direction, distance, pdf"), "{text}");
    let text = message(&program(&["--language", "c"]));
    assert!(["--lights", "--warps", "--tools", "--tables"].iter().all(|option| text.contains(option)), "{text}");
}

#[test]
fn a_file_that_cannot_be_written_is_an_error() {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("no such folder").join("etendue.h");
    let text = message(&program(&["--language", "c", "--lights", "sun", "-o", path.to_str().unwrap()]));
    assert!(text.contains("no such folder"), "{text}");
}

/// Just what is asked for is written, to the file or to standard output.
#[test]
fn what_is_asked_for_is_written() {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("asked.h");
    let arguments =
        ["--language", "cuda", "--lights", "sphere_by_area,sun", "--functions", "sample", "--fields", "direction,pdf"];
    let output = program(&[&arguments[..], &["-o", path.to_str().unwrap()]].concat());
    assert!(output.status.success() && output.stdout.is_empty(), "{output:?}");
    let text = fs::read_to_string(path).unwrap();
    assert_eq!(text.as_bytes(), program(&arguments).stdout);
    for (name, there) in [
        ("etendue_shader_sphere_by_area_prepare(", true),
        ("etendue_shader_sphere_by_area_sample(", true),
        ("etendue_shader_sun_by_solid_angle_sample(", true),
        ("etendue_shader_sphere_by_area_pdf(", false),
        ("etendue_shader_sphere_by_solid_angle_sample(", false),
        ("etendue_shader_triangle", false),
        ("EtendueShaderVec3 direction;", true),
        ("EtendueShaderVec3 normal;", false),
        ("etendue_shader_sin_cos_turns(", true),
        ("etendue_shader_angle(", false),
    ] {
        assert_eq!(text.contains(name), there, "{name}");
    }
}

/// `--exact` writes out what shading languages do not promise to round correctly, in all of them, and is refused where that is promised.
#[test]
fn operations_are_written_out_where_they_may_be_inexact() {
    let arguments = |language| ["--language", language, "--warps", "cosine_hemisphere,patch_surface", "--exact"];
    for language in Language::ALL {
        let output = program(&arguments(language.name()));
        if language.is_exact() {
            let text = message(&output);
            assert!(text.contains("--exact") && text.contains(language.name()), "{text}");
            continue;
        }
        assert!(output.status.success(), "{output:?}");
        let text = String::from_utf8_lossy(&output.stdout);
        for name in ["etendue_shader_exact_fma", "etendue_shader_exact_quotient", "etendue_shader_exact_sqrt"] {
            assert!(text.contains(name), "{}: no {name}", language.name());
        }
    }
    let [with, without] = [&arguments("wgsl")[..], &arguments("wgsl")[..4]].map(|of| program(of).stdout);
    let [with, without] = [with, without].map(|bytes| String::from_utf8(bytes).unwrap());
    assert!(without.contains(" / ") && without.contains("fma(") && without.contains("sqrt("));
    // the functions of the prelude are the only ones that divide
    let (_, body) = with.split_once("struct EtendueShaderPatchSurface").unwrap();
    assert!(!body.contains(" / ") && !body.contains(" fma(") && !body.contains(" sqrt("), "{body}");
}

/// The command of the README writes a file in every language.
#[test]
fn the_command_of_the_readme_writes_every_language() {
    let command = include_str!("../README.md").lines().find_map(|line| line.strip_prefix("etendue-shader "));
    let arguments: Vec<&str> = command.expect("the README has a command").split(' ').collect();
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("readme");
    for language in Language::ALL {
        let given = arguments.iter().map(|&argument| match argument {
            "wgsl" => language.name(),
            "etendue.wgsl" => path.to_str().unwrap(),
            other => other,
        });
        let output = program(&given.collect::<Vec<_>>());
        assert!(output.status.success(), "{}: {output:?}", language.name());
        let bytes = fs::read(&path).unwrap();
        let has = |name: &str| bytes.windows(name.len()).any(|part| part == name.as_bytes());
        for name in ["triangle_by_solid_angle_sample", "cosine_hemisphere_pdf", "balance_weights"] {
            assert!(has(&format!("etendue_shader_{name}")), "{}: no {name}", language.name());
        }
    }
}
