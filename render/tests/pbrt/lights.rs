//! Reading of skies, spreads, metals and mirrors.

use crate::kit::Folder;
use crate::pbrt::text::{LIGHT, TRIANGLE, read, warnings, world};
use etendue::light::EnvironmentMap;
use etendue_render::scene::{Material, Roughness, SkyRadiance};
use etendue_scene::parse;

#[test]
fn dark_skies_are_none() {
    let dark = read(&world("LightSource \"infinite\" \"rgb L\" [0 0 0]"));
    assert!(dark.environment.is_none());
    assert_eq!(warnings(&dark).len(), 2, "{:?}", warnings(&dark));
}

/// Reads EXR, HDR and PNG images, square and 2:1, and rejects values that no light can have.
#[test]
fn images_of_the_sky() {
    let folder = Folder::new();
    let write = |name: &str, size: [usize; 2], odd: f32| {
        folder.picture(name, size, |x, y| if (x, y) == (1, 0) { [odd, 2.0, 3.0] } else { [x as f32, y as f32, 1.0] });
    };
    write("square.exr", [4, 4], 1.0);
    write("wide.exr", [4, 2], 1.0);
    write("nan.exr", [4, 2], f32::NAN);
    write("negative.exr", [4, 2], -5.0);
    folder.write("text.exr", "not an image");
    // one RGBE texel: mantissas 128, 64, 0 with exponent 129 are 1, ½ and 0
    let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x40\x00\x81";
    folder.write("one.hdr", hdr);
    let mut png = Vec::new();
    let mut encoder = png::Encoder::new(&mut png, 1, 1);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().unwrap().write_image_data(&[255, 188, 0]).unwrap();
    folder.write("one.png", png);

    let load = |name: &str| {
        let text = world(&format!("LightSource \"infinite\" \"string filename\" \"{name}\" \"float scale\" 2"));
        parse(&text, "a.pbrt", folder.root())
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
        ("text.exr", "not a picture: it begins with"),
        ("none.exr", "cannot read"),
    ] {
        let message = load(name).unwrap_err().to_string();
        assert!(message.starts_with("a.pbrt:2: LightSource \"infinite\": ") && message.contains(what), "{message}");
        assert!(message.contains(name), "{message}");
    }
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
