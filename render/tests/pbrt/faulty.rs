//! Errors and warnings name the line and the wrong value, and no input panics.

use crate::damaged::damaged;
use crate::kit::Folder;
use crate::pbrt::text::{TRIANGLE, error, read, warnings, world};
use etendue_render::scene::Material;
use etendue_scene::{SceneError, load, parse};
use std::path::Path;

/// Texts that follow a valid first line, the line of their fault, and a part of the message.
const FAULTS: &[(&str, u32, &str)] = &[
    // words and tokens
    ("Flim \"rgb\"", 2, "unknown directive Flim; did you mean Film?"),
    ("Atributebegin", 2, "unknown directive Atributebegin; did you mean AttributeBegin?"),
    ("# comment\r\nFlim", 3, "unknown directive Flim"),
    ("#\u{e9}\nAttributeBegin\u{e9}", 3, "unknown directive AttributeBegin\u{e9}"),
    ("\n\"Shape\"", 3, "expected a directive, found \"Shape\""),
    ("Shape \"sphere", 2, "the string \"sphere\" is not closed"),
    ("Shape \"sph\\qere\"", 2, "unknown escape \\q"),
    ("Shape sphere", 2, "expected a type in quotes, found sphere"),
    ("Shape", 2, "the file ends where a type is expected"),
    ("Translate 1 2", 2, "the file ends where Translate is expected"),
    ("Translate 1\n2 x3", 3, "expected a number, found x3"),
    ("Translate 1 2 nan", 2, "the number nan is not finite"),
    ("Translate 1 2 1e999", 2, "the number 1e999 is not finite"),
    ("Translate [1 2 3]", 2, "expected a number, found ["),
    // parameters
    ("Shape \"sphere\" \"radius\" 1", 2, "expected a parameter's type and name, found \"radius\""),
    ("Shape \"sphere\" \"real radius\" 1", 2, "unknown type \"real\""),
    ("Shape \"sphere\"\n\"integer radius\" 1", 3, "\"radius\": type integer is not supported, only float"),
    ("Shape \"sphere\" \"float radius\" [1\n2z]", 3, "\"radius\": expected a number, found 2z"),
    ("Shape \"sphere\" \"float radius\" [1 2]", 2, "expected one value, found 2"),
    ("Shape \"sphere\" \"float radius\" []", 2, "expected one value, found none"),
    ("Shape \"sphere\" \"float radius\" [1", 2, "the file ends where the ] of \"radius\""),
    ("Shape \"sphere\" \"float radius\" 1 2", 2, "unknown directive 2"),
    ("Shape \"trianglemesh\" \"integer indices\" [0 1.5 2]", 2, "expected an integer, found 1.5"),
    ("Shape \"trianglemesh\" \"integer indices\" [9999999999]", 2, "expected an integer, found 9999999999"),
    ("AreaLightSource \"diffuse\" \"bool twosided\" 1", 2, "expected true or false, found 1"),
    // state
    ("AttributeBegin\n\n", 2, "this AttributeBegin or TransformBegin is never closed"),
    ("AttributeEnd", 2, "AttributeEnd has no matching Begin"),
    ("WorldBegin", 2, "a second WorldBegin"),
    ("Film \"rgb\"", 2, "Film must come before WorldBegin"),
    ("Rotate 30 0 0 0", 2, "the axis must not be zero"),
    ("LookAt 0 0 0 0 1 0 0 1 0", 2, "do not define a view"),
    ("Transform [1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1]", 2, "not affine"),
    ("Transform 1 0 0 0", 2, "expected [, found 1"),
    ("Scale 1e300 1 1 Scale 1e300 1 1", 2, "no longer finite"),
    ("Scale 1 0 1\nShape \"sphere\"", 3, "its transform is singular"),
    // not supported
    ("Texture \"a\" \"point\" \"constant\"", 2, "a texture of \"point\": only spectrum and float"),
    ("Texture \"a\" \"float\" \"imagemap\"", 2, "\"string filename\" is missing"),
    ("Texture \"a\" \"float\" \"imagemap\" \"string filename\" \"x.png\"", 2, "x.png: cannot read: "),
    (
        "Texture \"a\" \"float\" \"imagemap\" \"string filename\" \"x\" \"string wrap\" \"round\"",
        2,
        "\"wrap\": unknown mode \"round\"",
    ),
    ("Texture \"a\" \"float\" \"checkerboard\" \"float uscale\" 1e39", 2, "\"uscale\": must be finite in f32"),
    ("Texture \"a\" \"float\" \"constant\" \"float value\" 1e39", 2, "\"value\": must be finite in f32, not 1e39"),
    (
        "Texture \"a\" \"float\" \"imagemap\" \"string filename\" \"x\" \"float scale\" 1e39",
        2,
        "\"scale\": must be finite in f32, not 1e39",
    ),
    (
        "Scale 1 0 1 Rotate 20 1 0 0 Rotate -20 1 0 0\nLightSource \"distant\" \"point3 to\" [0 1 0]",
        3,
        "define no direction",
    ),
    ("\nObjectBegin \"a\"", 3, "this ObjectBegin is never closed"),
    ("ObjectEnd", 2, "ObjectEnd has no matching ObjectBegin"),
    ("ObjectBegin \"a\"\nObjectBegin \"b\"", 3, "the one of line 2 is not closed"),
    (
        "ObjectBegin \"a\"\nAttributeBegin\nObjectEnd",
        4,
        "ObjectEnd: the AttributeBegin or TransformBegin of line 3 is not closed",
    ),
    (
        "AttributeBegin\nObjectBegin \"a\"\nAttributeEnd\nObjectEnd",
        4,
        "AttributeEnd: the ObjectBegin of line 3 is not closed",
    ),
    ("ObjectBegin \"a\"\nTransformEnd", 3, "TransformEnd: the ObjectBegin of line 2 is not closed"),
    ("ObjectBegin \"a\" ObjectEnd Scale 1 0 1\nObjectInstance \"a\"", 3, "its transform is singular"),
    ("ObjectBegin \"a\"\nObjectInstance \"a\"", 3, "objects cannot contain instances"),
    ("ActiveTransform Later", 2, "expected All, StartTime or EndTime, found Later"),
    ("Attribute \"camera\" \"float x\" 1", 2, "only shape, light, material, medium, texture"),
    ("Import \"a.pbrt\"", 2, "cannot read"),
    ("Include \"none.pbrt\"", 2, "cannot read"),
    ("Shape \"cube\"", 2, "Shape \"cube\": shape not supported"),
    ("Shape \"sphre\"", 2, "loopsubdiv; did you mean sphere?"),
    ("Material \"difuse\"", 2, "disney; did you mean diffuse?"),
    ("Material \"cloth\"", 2, "material type \"cloth\" is not supported"),
    ("Material \"dielectric\" \"float eta\" 0", 2, "\"eta\": must be from 1e-3 to 1e3, not 0"),
    ("Material \"mix\" \"string materials\" \"a\"", 2, "needs two \"materials\", not 1"),
    ("Material \"diffuse\" \"blackbody reflectance\" 3000", 2, "a light's spectrum is no reflectance"),
    ("Material \"diffuse\" \"spectrum reflectance\" [400 1 300 1]", 2, "wavelengths must ascend: 300 follows 400"),
    ("Material \"diffuse\" \"spectrum reflectance\" []", 2, "needs pairs"),
    ("Material \"diffuse\" \"spectrum reflectance\" [400]", 2, "needs pairs"),
    ("Material \"diffuse\" \"spectrum reflectance\" [400 -1]", 2, "at least 0"),
    ("Material \"diffuse\" \"spectrum reflectance\" [400 nan]", 2, "finite"),
    ("Material \"diffuse\" \"spectrum reflectance\" \"metal-Cu-q\"", 2, "no spectrum is called"),
    ("Material \"diffuse\" \"spectrum reflectance\" \"glass-\"", 2, "no spectrum is called"),
    ("LightSource \"point\" \"spectrum I\" \"stdillum-Z\"", 2, "no spectrum is called"),
    ("Material \"diffuse\" \"spectrum reflectance\" \"x.spd\"", 2, "cannot read"),
    ("Material \"diffuse\" \"spectrum reflectance\" \"brass\"", 2, "no spectrum is called \"brass\""),
    ("MakeNamedMaterial \"m\"", 2, "\"string type\" is missing"),
    ("AreaLightSource \"spot\"", 2, "AreaLightSource \"spot\": not supported"),
    ("AreaLightSource \"diffuse\" \"blackbody L\" 30", 2, "expected a temperature from 200 to 1e6 K, found [30.0]"),
    ("AreaLightSource \"diffuse\" \"spectrum L\" \"metal-Cu-k\"", 2, "this spectrum is no light"),
    ("AreaLightSource \"diffuse\" \"float power\" -3", 2, "\"power\": must be greater than 0, not -3"),
    // values
    ("Material \"diffuse\" \"rgb reflectance\" [.1 .2]", 2, "expected three numbers, found 2"),
    ("Material \"diffuse\" \"rgb reflectance\" [.1 .2 -.5]", 2, "\"reflectance\": must be at least 0, not -0.5"),
    ("AreaLightSource \"diffuse\" \"rgb L\" [1 -2 3]", 2, "\"L\": must be at least 0, not -2"),
    ("AreaLightSource \"diffuse\" \"rgb L\" [1e39 1 1]", 2, "at most 4e37 is supported"),
    ("AreaLightSource \"diffuse\" \"float scale\" -1", 2, "\"scale\": must be at least 0, not -1"),
    // spheres
    ("Shape \"sphere\" \"float radius\" 0", 2, "\"radius\": must be greater than 0 and finite, not 0 "),
    ("Shape \"sphere\" \"float radius\" -3", 2, "\"radius\": must be greater than 0 and finite, not -3 "),
    ("Translate 1e39 0 0\nShape \"sphere\"", 3, "[1e39, 0.0, 0.0], which is not finite in f32"),
    ("Shape \"disk\" \"float radius\" 0", 2, "\"radius\": must be greater than 0 and finite, not 0"),
    ("Shape \"cylinder\" \"float radius\" -2", 2, "\"radius\": must be greater than 0 and finite, not -2"),
    // meshes
    ("Shape \"trianglemesh\"", 2, "\"point3 P\" is missing"),
    ("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1]", 2, "expected a multiple of 3 numbers, found 4"),
    ("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0]", 2, "\"indices\" is missing"),
    ("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 1e39 1 0]", 2, "vertex 2 is at [1e39, 1.0, 0.0]"),
    ("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 inf 1 0]", 2, "the number inf is not finite"),
    (
        "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 3]",
        2,
        "index 3 is out of range: there are 3",
    ),
    (
        "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 -1 2]",
        2,
        "index -1 is out of range",
    ),
    (
        "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 2 0]",
        2,
        "expected a multiple of 3 numbers, found 4",
    ),
    (
        "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"normal N\" [0 0 1]",
        2,
        "\"N\" has 1 values for 3 points",
    ),
    (
        "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0] \"integer indices\" [0 1 2]",
        2,
        "expected a multiple of 4 numbers, found 3",
    ),
    ("Shape \"plymesh\"", 2, "\"string filename\" is missing"),
    ("Shape \"plymesh\" \"string filename\" \"builtin:terrain\"", 2, "cannot read"),
    // numbers are shown as short as they can be
    ("Shape \"sphere\" \"float radius\" 1e-300", 2, "not 1e-300 ("),
    ("AreaLightSource \"diffuse\" \"float scale\" -1e300", 2, "not -1e300"),
    ("Material \"diffuse\" \"rgb reflectance\" [0 -1e-200 0]", 2, "not -1e-200"),
];

/// The same of lights and metals.
const FAULTS_OF_LIGHTS: &[(&str, u32, &str)] = &[
    ("LightSource \"laser\"", 2, "not supported, only \"point\""),
    ("LightSource \"point\" \"float power\" 0", 2, "must be greater than 0, not 0"),
    ("LightSource \"distant\" \"float illuminance\" -3", 2, "must be greater than 0, not -3"),
    ("AreaLightSource \"diffuse\" \"float spread\" 0", 2, "\"spread\": must be from 0.1 to 180 degrees, not 0"),
    ("AreaLightSource \"diffuse\" \"float spread\" 181", 2, "must be from 0.1 to 180 degrees, not 181"),
    ("AreaLightSource \"diffuse\" \"float spread\" 0.1 \"float scale\" 4e36", 2, "at most 1.0"),
    ("LightSource \"point\" \"float scale\" -2", 2, "\"scale\": must be at least 0, not -2"),
    ("LightSource \"point\" \"rgb I\" [1 -3 1]", 2, "\"I\": must be at least 0, not -3"),
    ("LightSource \"point\" \"texture I\" \"a\"", 2, "a light cannot have a texture"),
    ("LightSource \"point\" \"rgb I\" [1e30 0 0] \"float scale\" 1e30", 2, "at most 3.4028235e38 is supported"),
    ("LightSource \"point\" \"point3 from\" [1e39 0 0]", 2, "not finite in f32"),
    ("LightSource \"point\" \"point3 from\" [1 2 3 4 5 6]", 2, "\"from\": expected three numbers, found 6"),
    ("LightSource \"distant\" \"point3 from\" [1 2 3] \"point3 to\" [1 2 3]", 2, "define no direction"),
    (
        "LightSource \"spot\" \"float coneangle\" 200",
        2,
        "\"coneangle\": must be greater than 0 and at most 180 degrees, not 200",
    ),
    (
        "LightSource \"spot\" \"float coneangle\" 20 \"float conedeltaangle\" 21",
        2,
        "\"conedeltaangle\": must be from 0 to the cone angle 20, not 21",
    ),
    ("Scale 1 2 1 LightSource \"spot\"", 2, "stretches its cone"),
    ("Scale 1 2 1 LightSource \"infinite\"", 2, "rotations, reflections and uniform scales"),
    ("Material \"conductor\" \"spectrum eta\" \"metal-Xx-eta\"", 2, "no spectrum is called \"metal-Xx-eta\""),
    ("Material \"conductor\" \"rgb eta\" [1 1 1] \"rgb k\" [1e20 1 1]", 2, "\"k\": [1e20, 1.0, 1.0] is too large"),
    ("Material \"conductor\" \"rgb reflectance\" [1 1 1.5]", 2, "\"reflectance\": must be at most 1, not 1.5"),
    ("Material \"conductor\" \"rgb reflectance\" [1 1 1] \"rgb k\" [1 1 1]", 2, "\"reflectance\" cannot be combined"),
    (
        "Material \"conductor\" \"rgb reflectance\" [1 1 1] \"float roughness\" -.5",
        2,
        "\"roughness\": must be from 0 to 1, not -0.5",
    ),
];

#[test]
fn errors_name_line_and_value() {
    for (text, line, part) in FAULTS.iter().chain(FAULTS_OF_LIGHTS) {
        let message = error(&world(text));
        assert!(message.starts_with(&format!("a.pbrt:{line}: ")), "{message}\n{text}");
        assert!(message.contains(part), "{message}\n{text}");
    }
}

#[test]
fn errors_before_the_world() {
    let cases: &[(&str, u32, &str)] = &[
        ("", 1, "no Camera"),
        ("WorldBegin\n\n", 2, "no Camera"),
        ("Camera \"perspective\"\n", 1, "no WorldBegin"),
        ("Shape \"sphere\"", 1, "Shape must come after WorldBegin"),
        ("LightSource \"point\"", 1, "LightSource must come after WorldBegin"),
        ("Camera \"fisheye\"", 1, "Camera \"fisheye\": not supported"),
        ("WorldEnd", 1, "unknown directive WorldEnd"),
        ("Camera \"perspective\" \"float lensradius\" -.1", 1, "\"lensradius\": must be at least 0, not -0.1"),
        ("Camera \"perspective\" \"float focaldistance\" 0", 1, "\"focaldistance\": must be greater than 0, not 0"),
        ("\nCamera \"perspective\" \"float lensradius\" 1e-45", 2, "radius 1e-45 focused at 1e6"),
        ("Scale 1e-30 1e-30 1e-30\nCamera \"perspective\" \"float lensradius\" 1e9", 2, "out of the range"),
        ("Camera \"perspective\" \"float screenwindow\" [1 -1 -1 1]", 1, "is not x0 x1 y0 y1, ascending"),
        (
            "Camera \"orthographic\" \"float frameaspectratio\" 0",
            1,
            "\"frameaspectratio\": must be greater than 0, not 0",
        ),
        (
            "Camera \"perspective\" \"float fov\" 180",
            1,
            "\"fov\": must be greater than 0 and less than 180 degrees, not 180",
        ),
        (
            "Camera \"perspective\" \"float fov\" 0",
            1,
            "\"fov\": must be greater than 0 and less than 180 degrees, not 0",
        ),
        ("Scale 1 1 0\nCamera \"perspective\"", 2, "its transform is singular"),
        ("Film \"video\"", 1, "Film \"video\": not supported"),
        ("Film \"rgb\" \"integer xresolution\" 0", 1, "0 × 720 pixels"),
        ("Film \"rgb\" \"float diagonal\" 0", 1, "\"diagonal\": must be from 1e-2 to 1e6 mm, not 0e0"),
        ("Film \"rgb\" \"integer yresolution\" -1", 1, "1280 × -1 pixels"),
        ("Film \"rgb\" \"integer xresolution\" 65537", 1, "65537 × 720 pixels"),
        ("Film \"rgb\" \"integer xresolution\" 65536 \"integer yresolution\" 65536", 1, "65536 × 65536 pixels"),
        ("Sampler \"independent\" \"integer pixelsamples\" 0", 1, "0 samples per pixel"),
    ];
    for (text, line, part) in cases {
        let message = error(text);
        assert!(message.starts_with(&format!("a.pbrt:{line}: ")) && message.contains(part), "{message}\n{text}");
    }
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
