//! Reading of delta lights, environments and materials, and their error messages.

use super::*;
use etendue::light::EnvironmentMap;
use exr::prelude::write_rgb_file;
use std::fs;

fn light(text: &str) -> DeltaLight {
    let scene = read(&world(text));
    assert_eq!(warnings(&scene), [""; 0]);
    assert_eq!(scene.delta_lights.len(), 1);
    scene.delta_lights[0]
}

fn error(text: &str) -> String {
    parse(&world(text), "a.pbrt", Path::new("no such directory")).map(|_| ()).unwrap_err().to_string()
}

#[test]
fn points_have_the_defaults_of_pbrt() {
    assert_eq!(light("LightSource \"point\""), DeltaLight::Point { position: [0.0; 3], intensity: [1.0; 3] });
    let text = "Translate 1 2 3 Scale 2 2 2\nLightSource \"point\" \"point3 from\" [1 0 -1] \"rgb I\" [1 2 3] \"float scale\" 2";
    assert_eq!(light(text), DeltaLight::Point { position: [3.0, 2.0, 1.0], intensity: [2.0, 4.0, 6.0] });
}

#[test]
fn spots_have_the_defaults_of_pbrt() {
    let DeltaLight::Spot { position, axis, one_minus_cos_inner, one_minus_cos_outer, intensity } =
        light("LightSource \"spot\"")
    else {
        panic!("not a spot");
    };
    assert_eq!((position, axis, intensity), ([0.0; 3], [0.0, 0.0, 1.0], [1.0; 3]));
    let near = |x: f32, degrees: f64| (f64::from(x) / (1.0 - degrees.to_radians().cos()) - 1.0).abs() < 1e-7;
    assert!(near(one_minus_cos_inner, 25.0) && near(one_minus_cos_outer, 30.0));
    // rotated about x: +z becomes −y
    let text = "Rotate 90 1 0 0\nLightSource \"spot\" \"point3 from\" [0 0 -2] \"point3 to\" [0 0 3] \"float coneangle\" 60 \"float conedeltaangle\" 0";
    let DeltaLight::Spot { position, axis, one_minus_cos_inner, one_minus_cos_outer, .. } = light(text) else {
        panic!("not a spot");
    };
    let near = |a: [f32; 3], b: [f32; 3]| (0..3).all(|k| (a[k] - b[k]).abs() < 1e-6);
    assert!(near(position, [0.0, 2.0, 0.0]) && near(axis, [0.0, -1.0, 0.0]), "{position:?} {axis:?}");
    assert!(one_minus_cos_inner == one_minus_cos_outer && (one_minus_cos_outer - 0.5).abs() < 1e-7);
    // θ²/2 of an angle whose cosine differs from 1 by a fourth of a rounding
    let narrow = "LightSource \"spot\" \"float coneangle\" 0.01 \"float conedeltaangle\" 0";
    let DeltaLight::Spot { one_minus_cos_outer, .. } = light(narrow) else { panic!("not a spot") };
    assert!((one_minus_cos_outer / 1.523_087_1e-8 - 1.0).abs() < 1e-6, "{one_minus_cos_outer}");
}

#[test]
fn distant_lights_shine_from_from_to_to() {
    let from = |text| match light(text) {
        DeltaLight::Distant { direction, irradiance } => (direction, irradiance),
        other => panic!("{other:?}"),
    };
    assert_eq!(from("LightSource \"distant\""), ([0.0, 0.0, -1.0], [1.0; 3]));
    let text = "Scale 1 -1 1\nLightSource \"distant\" \"point3 from\" [0 7 0] \"point3 to\" [0 3 0] \"rgb L\" [0 0 5]";
    assert_eq!(from(text), ([0.0, -1.0, 0.0], [0.0, 0.0, 5.0]));
}

#[test]
fn infinite_lights_turn_with_their_transform() {
    let scene =
        read(&world("Rotate -90 1 0 0 Scale 3 3 3\nLightSource \"infinite\" \"rgb L\" [1 2 3] \"float scale\" 0.5"));
    let environment = scene.environment.unwrap();
    assert_eq!(environment.sky, SkyRadiance::Constant([0.5, 1.0, 1.5]));
    // up in world space is z in light space
    let up: [f32; 3] = environment.to_light.map(|row| row[1]);
    assert!(up[0].abs() < 1e-6 && up[1].abs() < 1e-6 && (up[2] - 1.0).abs() < 1e-6, "{up:?}");
    let two = read(&world("LightSource \"infinite\"\nLightSource \"infinite\" \"rgb L\" [1 2 3]"));
    assert_eq!(two.environment.unwrap().sky, SkyRadiance::Constant([2.0, 3.0, 4.0]));
    let dark = read(&world("LightSource \"infinite\" \"rgb L\" [0 0 0]"));
    assert!(dark.environment.is_none());
    assert_eq!(warnings(&dark).len(), 2, "{:?}", warnings(&dark));
}

/// Reads EXR, HDR and PNG images, square and 2:1, and rejects values that no light can have.
#[test]
fn images_of_the_sky() {
    let folder = std::env::temp_dir().join(format!("etendue-sky-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let write = |name: &str, w: usize, h: usize, odd: f32| {
        let pixel = |x: usize, y: usize| if (x, y) == (1, 0) { (odd, 2.0, 3.0) } else { (x as f32, y as f32, 1.0) };
        write_rgb_file(folder.join(name), w, h, pixel).unwrap();
    };
    write("square.exr", 4, 4, 1.0);
    write("wide.exr", 4, 2, 1.0);
    write("odd.exr", 4, 3, 1.0);
    write("nan.exr", 4, 2, f32::NAN);
    write("negative.exr", 4, 2, -5.0);
    fs::write(folder.join("text.exr"), "not an image").unwrap();
    // one RGBE texel: mantissas 128, 64, 0 with exponent 129 are 1, ½ and 0
    let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x40\x00\x81";
    fs::write(folder.join("one.hdr"), hdr).unwrap();
    let mut png = Vec::new();
    let mut encoder = png::Encoder::new(&mut png, 1, 1);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().unwrap().write_image_data(&[255, 188, 0]).unwrap();
    fs::write(folder.join("one.png"), png).unwrap();

    let load = |name: &str| {
        let text = world(&format!("LightSource \"infinite\" \"string filename\" \"{name}\" \"float scale\" 2"));
        parse(&text, "a.pbrt", &folder)
    };
    let texels = |name: &str| match load(name).unwrap_or_else(|e| panic!("{e}")).environment.unwrap().sky {
        SkyRadiance::Image { width, map, texels } => (width, map, texels),
        SkyRadiance::Constant(_) => panic!("not an image"),
    };
    let (width, map, square) = texels("square.exr");
    assert_eq!((width, map, square.len()), (4, EnvironmentMap::EqualArea, 16));
    assert_eq!((square[1], square[7]), ([2.0, 4.0, 6.0], [6.0, 2.0, 2.0]));
    let (width, map, wide) = texels("wide.exr");
    assert_eq!((width, map, wide.len()), (4, EnvironmentMap::Equirectangular, 8));
    assert_eq!(texels("one.hdr").2, [[2.0, 1.0, 0.0]]);
    let png = texels("one.png").2[0];
    assert!(png[0] == 2.0 && (png[1] - 2.0 * 0.502_886_5).abs() < 1e-5 && png[2] == 0.0, "{png:?}");
    let scene = load("negative.exr").unwrap();
    assert!(warnings(&scene)[0].contains("negative values in 1 texel(s)"), "{:?}", warnings(&scene));

    for (name, what) in [
        ("nan.exr", "texel (1, 0) is [NaN, 2.0, 3.0], times [2.0, 2.0, 2.0]: must be finite"),
        ("text.exr", "not a valid EXR, HDR, PFM or PNG image"),
        ("none.exr", "cannot read"),
    ] {
        let message = load(name).unwrap_err().to_string();
        assert!(message.starts_with("a.pbrt:2: LightSource \"infinite\": ") && message.contains(what), "{message}");
        assert!(message.contains(name), "{message}");
    }
    fs::remove_dir_all(&folder).unwrap();
}

/// The spread is the full angle in degrees, as in Cycles; a sphere has none.
#[test]
fn area_lights_have_a_spread() {
    let spread =
        |text: &str| read(&world(&format!("AreaLightSource \"diffuse\" {text}"))).shapes[0].emission.unwrap().spread;
    let found = spread(&format!("\"float spread\" 90 {TRIANGLE}")).unwrap();
    assert!(
        (found.tan_half - 1.0).abs() < 1e-6 && (found.gain - 1.0 / (1.0 - std::f32::consts::FRAC_PI_4)).abs() < 1e-5
    );
    assert_eq!(spread(&format!("\"float spread\" 180 {TRIANGLE}")), None);
    assert_eq!(spread(TRIANGLE), None);
    let sphere = read(&world("AreaLightSource \"diffuse\" \"float spread\" 90 Shape \"sphere\""));
    assert_eq!((sphere.shapes[0].emission.unwrap().spread, sphere.stand_ins.len()), (None, 1));
}

#[test]
fn metals_and_mirrors() {
    let material = |text: &str| {
        let scene = read(&world(&format!("{LIGHT}{text}\n{TRIANGLE}")));
        assert_eq!(warnings(&scene), [""; 0]);
        scene.materials[0]
    };
    assert_eq!(material("Material \"mirror\""), Material::Mirror([0.9; 3]));
    let gold = "Material \"conductor\" \"rgb eta\" [0.1 0.4 1.4] \"rgb k\" [4 2 1.5] \"float roughness\" 0.25";
    let metal = |along, across| {
        let roughness = Roughness { along, across, turn: 0.0 };
        Material::Conductor { eta: [0.1, 0.4, 1.4], k: [4.0, 2.0, 1.5], roughness }
    };
    assert_eq!(material(gold), metal(0.5, 0.5));
    assert_eq!(material(&format!("{gold} \"bool remaproughness\" false")), metal(0.25, 0.25));
    assert_eq!(material(&format!("{gold} \"float vroughness\" 0.04")), metal(0.5, 0.2));
    // smooth in one direction alone is as smooth there as numbers allow
    assert_eq!(material(&format!("{gold} \"float uroughness\" 0")), metal(1e-4, 0.5));
    assert!(metal(0.5, 0.5).is_glossy() && metal(0.0, 0.0).is_mirror() && !metal(0.5, 0.5).is_mirror());
    assert!(metal(0.0, 0.5).is_glossy() && !metal(0.0, 0.5).is_mirror());
    // reflectance ½ at normal incidence: k² = 4
    let half = material("Material \"conductor\" \"rgb reflectance\" [0.5 0 1]");
    let Material::Conductor { eta, k, roughness } = half else { panic!("{half:?}") };
    assert!(
        eta == [1.0; 3]
            && (k[0] - 2.0).abs() < 1e-6
            && k[1] == 0.0
            && (k[2] - 199.99).abs() < 1e-2
            && roughness == 0.0.into()
    );
    let named = "MakeNamedMaterial \"m\" \"string type\" \"mirror\" \"rgb Kr\" [.5 .5 .5]\nNamedMaterial \"m\"";
    assert_eq!(material(named), Material::Mirror([0.5; 3]));
}

#[test]
fn errors_name_line_and_value() {
    for (text, what) in [
        ("LightSource \"laser\"", "not supported, only \"point\""),
        ("LightSource \"point\" \"float power\" 0", "must be greater than 0, not 0"),
        ("LightSource \"distant\" \"float illuminance\" -3", "must be greater than 0, not -3"),
        ("AreaLightSource \"diffuse\" \"float spread\" 0", "\"spread\": must be from 0.1 to 180 degrees, not 0"),
        ("AreaLightSource \"diffuse\" \"float spread\" 181", "must be from 0.1 to 180 degrees, not 181"),
        ("AreaLightSource \"diffuse\" \"float spread\" 0.1 \"float scale\" 4e36", "at most 1.0"),
        ("LightSource \"point\" \"float scale\" -2", "\"scale\": must be at least 0, not -2"),
        ("LightSource \"point\" \"rgb I\" [1 -3 1]", "\"I\": must be at least 0, not -3"),
        ("LightSource \"point\" \"texture I\" \"a\"", "a light cannot have a texture"),
        ("LightSource \"point\" \"rgb I\" [1e30 0 0] \"float scale\" 1e30", "at most 3.4028235e38 is supported"),
        ("LightSource \"point\" \"point3 from\" [1e39 0 0]", "not finite in f32"),
        ("LightSource \"point\" \"point3 from\" [1 2 3 4 5 6]", "\"from\": expected three numbers, found 6"),
        ("LightSource \"distant\" \"point3 from\" [1 2 3] \"point3 to\" [1 2 3]", "define no direction"),
        (
            "LightSource \"spot\" \"float coneangle\" 200",
            "\"coneangle\": must be greater than 0 and at most 180 degrees, not 200",
        ),
        (
            "LightSource \"spot\" \"float coneangle\" 20 \"float conedeltaangle\" 21",
            "\"conedeltaangle\": must be from 0 to the cone angle 20, not 21",
        ),
        ("Scale 1 2 1 LightSource \"spot\"", "stretches its cone"),
        ("Scale 1 2 1 LightSource \"infinite\"", "rotations, reflections and uniform scales"),
        ("Material \"conductor\" \"spectrum eta\" \"metal-Xx-eta\"", "no spectrum is called \"metal-Xx-eta\""),
        ("Material \"conductor\" \"rgb eta\" [1 1 1] \"rgb k\" [1e20 1 1]", "\"k\": [1e20, 1.0, 1.0] is too large"),
        ("Material \"conductor\" \"rgb reflectance\" [1 1 1.5]", "\"reflectance\": must be at most 1, not 1.5"),
        ("Material \"conductor\" \"rgb reflectance\" [1 1 1] \"rgb k\" [1 1 1]", "\"reflectance\" cannot be combined"),
        (
            "Material \"conductor\" \"rgb reflectance\" [1 1 1] \"float roughness\" -.5",
            "\"roughness\": must be from 0 to 1, not -0.5",
        ),
    ] {
        let message = error(text);
        assert!(message.starts_with("a.pbrt:2: ") && message.contains(what), "{text}\n{message}");
    }
    let before = parse("LightSource \"point\"", "a.pbrt", Path::new(".")).unwrap_err().to_string();
    assert!(before.contains("LightSource must come after WorldBegin"), "{before}");
}

#[test]
fn new_builtin_scenes_are_sound() {
    for (name, _) in &builtin()[4..9] {
        let scene = load(name).unwrap();
        assert_eq!(warnings(&scene), [""; 0], "{name}");
        assert_eq!((scene.name.as_str(), scene.pixel_samples), (*name, 64));
        // sky.exr is its map
        let file = if *name == "sky" { "sky-render" } else { name };
        assert_eq!(
            scene.film,
            FilmSettings {
                width: 256,
                height: 256,
                diagonal: 35.0,
                filename: Some(format!("{file}.exr")),
                place: None
            }
        );
    }
    let cornell = load("cornell-box").unwrap();
    assert_eq!((cornell.triangles.len(), cornell.shapes.len()), (30, 1));
    // the light faces down
    assert!(normal(&cornell.shapes[0].geometry)[1] < 0.0);
    assert_eq!(load("delta-lights").unwrap().delta_lights.len(), 3);
    assert!(load("sky").unwrap().environment.is_some());
    assert_eq!(load("plates").unwrap().materials.iter().filter(|m| m.is_glossy()).count(), 4);
    assert_eq!(load("mirror-room").unwrap().materials.iter().filter(|m| m.is_mirror()).count(), 3);
    // only the built-in scene may refer to its image
    let text = world("LightSource \"infinite\" \"string filename\" \"sky.exr\"");
    assert!(parse(&text, "a.pbrt", Path::new("no such directory")).is_err());
}
