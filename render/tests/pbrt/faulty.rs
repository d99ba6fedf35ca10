//! Errors and warnings name the line and the wrong value, and no input panics.

use crate::damaged::damaged;
use crate::kit::{Folder, faults};
use crate::pbrt::text::{TRIANGLE, error, read, warnings, world};
use etendue_render::scene::Material;
use etendue_scene::{SceneError, load, parse};
use std::path::Path;

/// Each text of a table gives the error of the line and with the words that follow it.
fn errors_are_those_of(table: &'static str, around: impl Fn(&str) -> String) {
    for (text, said) in faults(table) {
        let (message, (line, part)) = (error(&around(text)), said.split_once(": ").unwrap());
        assert!(
            message.starts_with(&format!("a.pbrt:{line}: ")) && message.contains(part),
            "{message}\n{text}\n{said}"
        );
    }
}

/// Texts that follow a valid first line.
#[test]
fn errors_name_line_and_value() {
    errors_are_those_of(include_str!("faults.txt"), world);
    assert!(error(&world("# comment\r\nFlim")).starts_with("a.pbrt:3: unknown directive Flim"));
}

#[test]
fn errors_before_the_world() {
    errors_are_those_of(include_str!("faults_before_the_world.txt"), str::to_owned);
    assert!(matches!(load("no-such-scene"), Err(SceneError::Io { .. })));
    for (name, near) in [("qads", "quads"), ("Quads", "quads"), ("skyy.pbrt", "sky"), ("cornellbox", "cornell-box")] {
        let message = load(name).unwrap_err().to_string();
        assert!(message.contains(&format!("; did you mean {near}? Built-in scenes: ")), "{message}");
    }
    for name in ["ab", "", "no-such-scene"] {
        assert!(!load(name).unwrap_err().to_string().contains("did you mean"), "{name}");
    }
    assert!(load("no-such-scene").unwrap_err().to_string().contains("built-in scenes: studio, sphere-light, "));
    assert!(load(".").unwrap_err().to_string().contains("not a regular file"));
}

#[test]
fn warnings_name_line_and_parameter() {
    let scene = read(
        "Option \"disablepixeljitter\" true\nColorSpace \"aces2065-1\" ColorSpace \"srgb\"\nAccelerator \"bvh\"\n\
         Film \"rgb\" \"float iso\" 100\nSampler \"halton\" \"integer seed\" 1\nPixelFilter \"gaussian\" PixelFilter \"box\"\n\
         Integrator \"path\" Integrator \"volpath\" \"integer maxdepth\" 1\nCamera \"perspective\" \"float shutteropen\" 1\nWorldBegin\n\
         Material \"diffuse\" \"rgb reflectance\" [2 0 0] \"float roughness\" 1\n\
         Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"point2 uv\" [0 0 1 0 0 1] \"normal N\" [0 0 1 0 0 1 0 0 1]\n\
         Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"point2 uv\" [0 0 1 0 0 1]\n\
         AreaLightSource \"diffuse\" \"rgb L\" [0 0 0]\nShape \"sphere\"",
    );
    let expected = [
        "a.pbrt:1: Option \"disablepixeljitter\" ignored",
        "a.pbrt:2: ColorSpace \"aces2065-1\" ignored",
        "a.pbrt:3: Accelerator \"bvh\": ignored",
        "a.pbrt:5: Sampler \"halton\": only its number of samples is used; the nearest here is --sampler sobol",
        "a.pbrt:5: Sampler \"halton\": \"seed\": ignored",
        "a.pbrt:6: PixelFilter \"gaussian\": ignored",
        "a.pbrt:7: Integrator \"path\": only direct light",
        "a.pbrt:10: Material \"diffuse\": \"reflectance\": 2 is greater than 1",
        "a.pbrt:10: Material \"diffuse\": \"roughness\": ignored",
        "a.pbrt:13: AreaLightSource \"diffuse\": emits nothing",
        "a.pbrt:14: nothing emits light",
    ];
    let found = warnings(&scene);
    assert_eq!(found.len(), expected.len(), "{found:#?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!(found.starts_with(expected), "{found}\n{expected}");
    }
    assert!(scene.shapes[0].emission.is_none());
}

/// What may be misspelt is a warning, and what `--strict` refuses; what is only unknown is no more than a warning.
#[test]
fn misspelt_parameters_name_the_one_that_may_be_meant() {
    let text = "Sampler \"zsobl\"\nCamera \"perspective\" \"float fvo\" 30 \"float weight\" 2\nWorldBegin\n\
                AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\nShape \"sphere\" \"float raduis\" 2 \"float radius\" 3";
    let scene = read(text);
    let expected = [
        "a.pbrt:1: Sampler \"zsobl\": unknown: only its number of samples is used; did you mean zsobol?",
        "a.pbrt:2: Camera \"perspective\": \"fvo\": ignored; did you mean \"fov\"?",
        "a.pbrt:2: Camera \"perspective\": \"weight\": ignored",
        "a.pbrt:5: Shape \"sphere\": \"raduis\": ignored; did you mean \"radius\"?",
    ];
    assert_eq!(warnings(&scene), expected);
    let refused: Vec<String> = scene.stand_ins.iter().map(ToString::to_string).collect();
    assert_eq!(refused, [expected[0], expected[1], expected[3]]);
}

/// Names that nobody defines end no scene, as in pbrt: a default stands for them, and `--strict` refuses them.
#[test]
fn undefined_names_are_warned_of() {
    let named = "MakeNamedMaterial \"brick\" \"string type\" \"diffuse\" \"rgb reflectance\" [.1 .1 .1]";
    for (text, wanted) in [
        ("CoordSysTransform \"x\"", "undefined CoordinateSystem \"x\": the transform stays as it is, as in pbrt"),
        ("CoordSysTransform \"wrold\"", "as in pbrt; did you mean world?"),
        ("NamedMaterial \"x\"", "no MakeNamedMaterial defines \"x\": a diffuse surface of albedo 0.5 stands for it"),
        ("NamedMaterial \"brik\"", "stands for it; did you mean brick?"),
        ("ObjectInstance \"a\"", "no ObjectBegin \"a\" precedes this: nothing is added"),
        (
            "Shape \"sphere\" \"texture alpha\" \"a\"",
            "\"alpha\": no float Texture \"a\" precedes this: its default stands",
        ),
        (
            "Material \"diffuse\" \"texture reflectance\" \"t\"",
            "\"reflectance\": no spectrum Texture \"t\" precedes this",
        ),
        ("Texture \"a\" \"float\" \"scale\" \"texture tex\" \"b\"", "\"tex\": no float Texture \"b\" precedes this"),
    ] {
        let scene = read(&world(&format!("{named}\n{text}\n{TRIANGLE}")));
        let [stand_in] = &scene.stand_ins[..] else { panic!("{text}: {:?}", scene.stand_ins) };
        assert!(stand_in.line == 3 && stand_in.text.contains(wanted), "{stand_in}, not {wanted}");
        let material = scene.materials[*scene.triangle_materials.last().unwrap() as usize];
        assert_eq!(material, Material::Diffuse([0.5; 3]), "{text}");
    }
}

/// What is no scene, and what is no picture, is called what it is.
#[test]
fn files_of_other_kinds_are_called_what_they_are() {
    let dir = Folder::new();
    let png = dir.write("room.png", etendue_render::film::image::encode_png([1, 1], &[[1, 2, 3]]).unwrap());
    let text = etendue_scene::load(&png).unwrap_err().to_string();
    assert!(
        text.ends_with("room.png: this is a picture (PNG), and no scene: --environment FILE lights a scene by it"),
        "{text}"
    );
    for (bytes, wanted) in [
        (&b"version https://git-lfs.github.com/spec/v1\noid sha256:0"[..], "the file is a pointer of git"),
        (b"\xabKTX 20\xbb\r\n", "a KTX2 file"),
        (b"RIFF\0\0\0\0WEBPVP8 ", "a WebP file"),
        (b"<html>", "text, such as a page of the web"),
        (b"", "the file is empty"),
    ] {
        dir.write("sky.exr", bytes);
        let text = world("LightSource \"infinite\" \"string filename\" \"sky.exr\"");
        let text = parse(&text, "a.pbrt", dir.root()).unwrap_err().to_string();
        assert!(text.contains("sky.exr: not a picture: ") && text.contains(wanted), "{text}");
    }
}

#[test]
fn nesting_is_bounded() {
    let deep = "AttributeBegin\n".repeat(2000);
    assert!(error(&world(&deep)).starts_with("a.pbrt:1026: AttributeBegin is nested more than 1024 deep"));
}

#[test]
fn includes_are_relative_bounded_and_name_their_own_lines() {
    let dir = Folder::new();
    dir.write("sub/shape.pbrt", format!("\u{feff}\n{TRIANGLE}"));
    dir.write("sub/both.pbrt", "Include \"shape.pbrt\"\nInclude \"shape.pbrt\"");
    dir.write("sub/faulty.pbrt", "\n\nShape \"cube\"");
    dir.write("sub/self.pbrt", "Include \"self.pbrt\"");
    dir.write("sub/b.pbrt", "\nInclude \"c.pbrt\"");
    dir.write("sub/c.pbrt", "Include \"./b.pbrt\"");
    dir.write("sub/main.pbrt", "Include \"sub/shape.pbrt\""); // relative to the main file
    dir.write("bytes.pbrt", b"\n\xff\n");
    dir.write("mark.pbrt", "\n \u{feff}Shape");
    dir.write("wide.pbrt", b"\xff\xfeS\0h\0");
    dir.write("bare.pbrt", b"S\0h\0a\0p\0");
    let read = |text: &str| parse(&world(text), "a.pbrt", dir.root());
    assert_eq!(read("Include \"sub/both.pbrt\"").unwrap().triangles.len(), 2);
    assert_eq!(read("Include \"sub/main.pbrt\"").unwrap().triangles.len(), 1);
    let message = |text: &str| read(text).unwrap_err().to_string();
    // a chain of files that exceeds the depth limit, and one file included too often
    for i in 0..40 {
        dir.write(&format!("{i}.pbrt"), format!("Include \"{}.pbrt\"", i + 1));
    }
    dir.write("empty.pbrt", "");
    assert!(message(&"Include \"empty.pbrt\"\n".repeat(4097)).starts_with("a.pbrt:4098: "));
    for (name, wanted) in [
        ("sub/faulty", "faulty.pbrt:3: Shape \"cube\": shape not supported, only sphere, "),
        ("sub/self", "self.pbrt\": the file includes itself: "),
        ("sub/b", "b.pbrt\": the file includes itself: "),
        ("sub/b", "c.pbrt:1 includes \""),
        ("bytes", "bytes.pbrt:2: the byte 0xff is not UTF-8"),
        // a byte order mark in the middle, as in files that were joined, and those of UTF-16
        ("mark", "mark.pbrt:2: unknown directive \\u{feff}Shape"),
        ("wide", "wide.pbrt:1: the file begins with the byte order mark of UTF-16: save it as UTF-8"),
        ("bare", "as UTF-16 does: save it as UTF-8"),
        ("0", "more than 32 files deep"),
    ] {
        let found = message(&format!("Include \"{name}.pbrt\""));
        assert!(found.contains(wanted), "{found}\n{wanted}");
    }
    assert!(message("Include \"sub\"").contains("not a regular file"));
}

/// Every beginning of a scene, and many scenes with a few bytes changed, give a scene or an error.
#[test]
fn no_text_panics() {
    let text = include_str!("../../scenes/quads.pbrt");
    let pieces =
        ["\"", "[", "]", "-", "1e308", "nan", "é", "\0", "#", "\\", "Include ", "AttributeBegin ", "\"float x\" "];
    let (mut sound, mut faulty) = (0, 0);
    damaged(text.as_bytes(), &pieces, 4000, |bytes| {
        match parse(&String::from_utf8_lossy(bytes), "a.pbrt", Path::new("no such directory")) {
            Ok(scene) => {
                sound += 1;
                assert!(scene.triangles.iter().flatten().flatten().all(|x| x.is_finite()));
            }
            Err(_) => faulty += 1,
        }
    });
    assert!(sound > 100 && faulty > 1000, "{sound} {faulty}");
}
