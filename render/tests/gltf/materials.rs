//! Tests of materials, textures and what emits.

use crate::gltf::asset::{Asset, QUAD, TRIANGLE};
use crate::kit::{Folder, pixel};
use base64::Engine;
use etendue_render::film::image::encode_png;
use etendue_render::scene::texture::{Mask, Texture, Wrap};
use etendue_render::scene::{Emission, Material, Roughness, Varying};
use etendue_render::{Technique, World};
use etendue_scene::{Asked, load, load_as, parse_gltf};
use serde_json::{Value, json};

/// A picture of 2 × 2 pixels as a data URI: red, green, blue, and grey of 51 (a fifth).
fn picture() -> String {
    let pixels = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [51; 3]];
    let png = encode_png([2, 2], &pixels).unwrap();
    format!("data:image/png;base64,{}", base64::engine::general_purpose::STANDARD.encode(png))
}

/// A file whose material may use texture 0.
fn textured(material: Value) -> Asset {
    let mut asset = Asset::of_material(material);
    asset.add("images", json!({"uri": picture()}));
    asset.add("samplers", json!({"magFilter": 9728, "wrapS": 33071, "wrapT": 33648}));
    asset.add("textures", json!({"source": 0, "sampler": 0}));
    asset
}

fn material(asset: &Asset) -> Material {
    let scene = asset.read();
    scene.materials[scene.triangle_materials[0] as usize]
}

fn varying(asset: &Asset) -> Varying {
    let scene = asset.read();
    assert_eq!(scene.materials[scene.triangle_materials[0] as usize], Material::Varying(0));
    scene.varying[0].clone()
}

fn near(found: [f32; 3], wanted: [f32; 3]) {
    assert!(found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-6), "{found:?}, not {wanted:?}");
}

#[test]
fn constant_materials() {
    // white, metallic and rough
    let Material::Glossy { diffuse, specular, roughness, .. } = material(&Asset::of_triangle()) else { panic!() };
    assert_eq!((diffuse, specular, roughness), ([0.0; 3], [1.0; 3], 1.0.into()));
    let surface = json!({"baseColorFactor": [0.2, 0.4, 0.8, 1], "metallicFactor": 0, "roughnessFactor": 0.5});
    let asset = Asset::of_material(json!({"pbrMetallicRoughness": surface}));
    let Material::Glossy { diffuse, specular, roughness, .. } = material(&asset) else { panic!() };
    near(diffuse, [0.2, 0.4, 0.8]);
    near(specular, [0.04; 3]);
    assert_eq!(roughness, 0.25.into());
    assert_eq!(asset.warnings(), [""; 0]);

    let asset = Asset::of_material(json!({"pbrMetallicRoughness": {"baseColorFactor": [1.5, -1, 0, 1]}}));
    assert_eq!(asset.warnings(), ["a.gltf: material 0: baseColorFactor [1.5, -1.0, 0.0, 1.0] is clamped to 0 to 1"]);
    let Material::Glossy { specular, .. } = material(&asset) else { panic!() };
    assert_eq!(specular, [1.0, 0.0, 0.0]);
}

#[test]
fn base_colours_are_srgb_and_products() {
    let asset = textured(json!({"pbrMetallicRoughness": {
        "baseColorFactor": [0.5, 1, 0.25, 1], "baseColorTexture": {"index": 0}, "metallicFactor": 0,
    }}));
    let Varying::Metallic { base, metallic, roughness } = varying(&asset) else { panic!() };
    assert_eq!(base.at([0.25, 0.25]), [0.5, 0.0, 0.0]);
    assert_eq!(base.at([0.75, 0.25]), [0.0, 1.0, 0.0]);
    assert_eq!(base.at([0.25, 0.75]), [0.0, 0.0, 0.25]);
    let grey = 0.033_104_767;
    near(base.at([0.75, 0.75]), [0.5 * grey, grey, 0.25 * grey]);
    assert_eq!((metallic, roughness), (Texture::number(0.0), Texture::number(1.0)));
    let Texture::Product(of) = base else { panic!("{base:?}") };
    let Texture::Picture(picture) = &of[1] else { panic!("{of:?}") };
    assert_eq!((picture.wrap, picture.bilinear), ([Wrap::Clamp, Wrap::Mirror], false));
    assert_eq!(asset.read().details.corners[0].uvs, [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
}

#[test]
fn roughness_is_green_and_metal_is_blue() {
    let asset = textured(json!({"pbrMetallicRoughness": {
        "metallicRoughnessTexture": {"index": 0}, "metallicFactor": 0.5, "roughnessFactor": 0.5,
    }}));
    let Varying::Metallic { base, metallic, roughness } = varying(&asset) else { panic!() };
    assert_eq!(base, Texture::number(1.0));
    let at = |u: f32, v: f32| [metallic.at([u, v])[0], roughness.at([u, v])[0]];
    assert_eq!([at(0.25, 0.25), at(0.75, 0.25), at(0.25, 0.75)], [[0.0, 0.0], [0.0, 0.5], [0.5, 0.0]]);
    // linear, not sRGB
    assert!((at(0.75, 0.75)[0] - 0.1).abs() < 1e-6);
}

#[test]
fn sets_of_texture_coordinates_and_transforms() {
    let mut asset = textured(json!({"pbrMetallicRoughness": {"baseColorTexture": {
        "index": 0, "texCoord": 5, "extensions": {"KHR_texture_transform": {
            "texCoord": 1, "offset": [0.0, 1.0], "rotation": std::f32::consts::FRAC_PI_2, "scale": [0.5, 0.25],
        }},
    }}}));
    let uvs = [[0.5, 0.5], [1.0, 0.25], [0.0, 0.75]];
    let set = asset.floats(&uvs);
    asset.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = json!(set);
    let scene = asset.read();
    assert_eq!(scene.details.corners[0].uvs, uvs);
    let Varying::Metallic { base: Texture::Picture(picture), .. } = varying(&asset) else { panic!() };
    // a turn that is counter-clockwise to the eye takes +u to −v, and v to u
    let rows = picture.mapping.0;
    let wanted = [[0.0, 0.25, 0.0], [-0.5, 0.0, 1.0]];
    assert!(rows.iter().flatten().zip(wanted.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-6), "{rows:?}");
    assert_eq!(asset.warnings(), [""; 0]);

    // the base colour's set is that of all textures
    let surface = json!({"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 0, "texCoord": 1}});
    let asset = textured(json!({"pbrMetallicRoughness": surface}));
    let text = "its textures use several sets of texture coordinates: all use 0 (reported once)";
    assert_eq!(asset.warnings(), [format!("a.gltf: material 0: {text}")]);
    // a set that is missing, and coordinates that are not finite
    let mut asset = textured(json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 1}}}));
    let text = "its material uses TEXCOORD_1, which it does not have: 0 stands for it (reported once)";
    assert_eq!(asset.warnings(), [format!("a.gltf: mesh 0, primitive 0: {text}")]);
    let set = asset.floats(&[[f32::NAN, 1.0], [1.0, f32::INFINITY], [0.5, 0.5]]);
    asset.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = json!(set);
    assert_eq!(asset.read().details.corners[0].uvs, [[0.0; 2], [0.0; 2], [0.5; 2]]);
}

#[test]
fn images_in_buffers_and_files() {
    let pixels = [[255, 0, 0], [0, 255, 0]];
    let png = encode_png([1, 2], &pixels).unwrap();
    let surface = json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}});
    let mut asset = Asset::of_material(surface);
    let view = asset.view(&png);
    asset.add("images", json!({"bufferView": view, "mimeType": "image/png"}));
    asset.add("textures", json!({"source": 0}));
    let colors = |varying: Varying| {
        let Varying::Metallic { base, .. } = varying else { panic!() };
        // the default sampler is bilinear and repeats
        let Texture::Picture(picture) = &base else { panic!() };
        assert!(picture.bilinear && picture.wrap == [Wrap::Repeat; 2]);
        [base.at([0.5, 0.25]), base.at([0.5, 0.75])]
    };
    assert_eq!(colors(varying(&asset)), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(parse_gltf(&asset.binary(), "a.glb").unwrap().varying.len(), 1);

    let folder = Folder::new();
    let image = folder.write("ä.png", &png);
    asset.json["images"][0] = json!({"uri": "%C3%A4.png"});
    let path = folder.write("a.gltf", asset.text());
    let scene = load(&path).unwrap();
    assert_eq!(colors(scene.varying[0].clone()), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let inputs: Vec<_> = scene.inputs.iter().map(|input| &input.path).collect();
    assert_eq!(inputs, [&image, &path]);
}

#[test]
fn opacity_makes_holes() {
    let mask = |material: Value| {
        let asset = textured(material);
        let mut scene = asset.read();
        assert_eq!(asset.warnings(), [""; 0]);
        assert_eq!(scene.details.corners.len(), scene.masks.len().max(usize::from(!scene.varying.is_empty())));
        scene.masks.pop().map(|(material, mask)| {
            assert_eq!(scene.triangle_materials, [material]);
            mask
        })
    };
    let of = |mode: &str, alpha: f32| json!({"alphaMode": mode, "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, alpha]}});
    assert_eq!(mask(of("OPAQUE", 0.25)), None);
    // the default cutoff is 0.5
    assert_eq!([mask(of("MASK", 0.5)), mask(of("BLEND", 1.0))], [None, None]);
    let number = |x: f32, least: Option<f32>| Some(Mask { opacity: Texture::number(x), least });
    assert_eq!(mask(of("MASK", 0.25)), number(0.25, Some(0.5)));
    assert_eq!(mask(of("BLEND", 0.25)), number(0.25, None));

    let mut png = Vec::new();
    let mut encoder = png::Encoder::new(&mut png, 2, 1);
    encoder.set_color(png::ColorType::Rgba);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&[9, 9, 9, 51, 9, 9, 9, 255]).unwrap();
    writer.finish().unwrap();
    let uri = format!("data:image/png;base64,{}", base64::engine::general_purpose::STANDARD.encode(png));
    let texture = json!({"baseColorTexture": {"index": 0}, "baseColorFactor": [1, 1, 1, 0.5]});
    let mut asset = textured(json!({"alphaMode": "MASK", "alphaCutoff": 0.3, "pbrMetallicRoughness": texture}));
    asset.json["images"][0]["uri"] = json!(uri);
    let scene = asset.read();
    let [(_, mask)] = &scene.masks[..] else { panic!("{:?}", scene.masks) };
    assert_eq!(mask.least, Some(0.3));
    let opacities = [0.25, 0.75].map(|u| mask.opacity.at([u, 0.5])[0]);
    assert!((opacities[0] - 0.1).abs() < 1e-6 && (opacities[1] - 0.5).abs() < 1e-6, "{opacities:?}");
}

#[test]
fn what_materials_ignore_is_reported_once() {
    let ignored = json!({
        "occlusionTexture": {"index": 0},
        "extensions": {
            "KHR_materials_transmission": {"transmissionFactor": 1},
            "KHR_materials_clearcoat": {},
            "ABC_new": {},
        },
    });
    let mut asset = textured(ignored.clone());
    asset.add("materials", ignored);
    asset.add("materials", json!({"alphaMode": "OTHER"}));
    for material in 1..3 {
        asset.shown(json!({"attributes": {"POSITION": 0}, "material": material}));
    }
    asset.json["extensionsUsed"] = json!(["ABC_new", "KHR_materials_clearcoat", "KHR_materials_transmission"]);
    let wanted = [
        "ABC_new is not supported and ignored",
        "KHR_materials_clearcoat is ignored",
        "KHR_materials_transmission is ignored: the surface is opaque",
        "its occlusionTexture is ignored",
    ];
    let mut wanted = wanted.map(|text| format!("a.gltf: material 0: {text} (reported once)")).to_vec();
    wanted.push("a.gltf: material 2: its alphaMode is unknown: the surface is opaque (reported once)".into());
    assert_eq!(asset.warnings(), wanted);
}

#[test]
fn what_does_not_emit_is_a_surface() {
    let dark = Asset::of_material(json!({"emissiveFactor": [0, 0, 0]})).read();
    assert_eq!((dark.triangles.len(), dark.shapes.len()), (1, 0));
    let scene = Asset::of_material(json!({"emissiveFactor": [1, 1, 1]})).read();
    assert!(!scene.warnings.iter().any(|message| message.text.contains("black")), "{:?}", scene.warnings);
}

#[test]
fn triangles_show_their_parts_of_emissive_textures() {
    let mut asset = Asset::new();
    let positions = asset.floats(&QUAD);
    // the left half of the image is black, the right one white
    let uvs = asset.floats(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]);
    let indices = asset.indices(&[0, 1, 3, 0, 3, 2]);
    let primitive = json!({
        "attributes": {"POSITION": positions, "TEXCOORD_0": uvs}, "indices": indices, "material": 0,
    });
    asset.shown(primitive.clone());
    asset.add("materials", json!({"emissiveFactor": [1, 0.5, 0], "emissiveTexture": {"index": 0}}));
    let png = encode_png([2, 1], &[[0; 3], [255; 3]]).unwrap();
    let view = asset.view(&png);
    asset.add("images", json!({"bufferView": view}));
    asset.add("samplers", json!({"magFilter": 9728, "wrapS": 33071}));
    asset.add("textures", json!({"source": 0, "sampler": 0}));
    let scene = asset.read();
    assert_eq!((scene.shapes.len(), scene.pictures.len(), asset.warnings()), (2, 2, Vec::<String>::new()));
    // three quarters of the lower triangle are in the right half
    for (k, share) in [0.75, 0.25].into_iter().enumerate() {
        let Emission { radiance, picture, .. } = scene.shapes[k].emission.unwrap();
        assert_eq!(picture, Some(k as u32));
        assert!((radiance[0] - share).abs() < 1e-6 && radiance[1] == 0.5 * radiance[0], "{radiance:?}");
        assert_eq!((radiance[2], scene.pictures[k].factor), (0.0, [1.0, 0.5, 0.0]));
    }
    // from the corner (0, 0), s is along the lower edge of the first triangle, and along the diagonal of the second one
    let at = |k: usize, st: [f32; 2]| scene.pictures[k].picture.at(st)[0];
    assert_eq!([at(0, [0.4, 0.0]), at(0, [0.6, 0.0]), at(0, [0.0, 0.4]), at(0, [0.0, 0.6])], [0.0, 1.0, 0.0, 1.0]);
    assert_eq!([at(1, [0.4, 0.5]), at(1, [0.6, 0.0]), at(1, [0.0, 0.9])], [0.0, 1.0, 0.0]);

    // a triangle of black texels emits nothing
    let dark = asset.floats(&[[0.0, 0.0], [0.1, 0.0], [0.0, 1.0], [0.2, 1.0]]);
    asset.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(dark);
    let scene = asset.read();
    assert_eq!((scene.shapes.len(), scene.triangles.len()), (0, 2));
}

#[test]
fn unlit_surfaces_are_diffuse() {
    let asset = Asset::of_material(json!({
        "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 1]}, "extensions": {"KHR_materials_unlit": {}},
    }));
    assert_eq!(material(&asset), Material::Diffuse([0.5, 0.25, 1.0]));
    let text = "KHR_materials_unlit: a diffuse surface of its base colour stands for it (reported once)";
    assert_eq!(asset.warnings(), [format!("a.gltf: material 0: {text}")]);
}

#[test]
fn indices_of_refraction_and_speculars() {
    let of = |extensions: Value, metallic: f32| {
        let surface =
            json!({"metallicFactor": metallic, "roughnessFactor": 0.5, "baseColorFactor": [0.5, 0.5, 0.5, 1]});
        material(&Asset::of_material(json!({"pbrMetallicRoughness": surface, "extensions": extensions})))
    };
    let Material::Glossy { diffuse, specular, grazing, roughness, .. } =
        of(json!({"KHR_materials_ior": {"ior": 2.0}}), 0.0)
    else {
        panic!()
    };
    near(specular, [1.0 / 9.0; 3]);
    assert_eq!((diffuse, grazing, roughness), ([0.5; 3], [1.0; 3], 0.25.into()));
    let Material::Glossy { diffuse, specular, .. } = of(json!({"KHR_materials_ior": {"ior": 2.0}}), 0.5) else {
        panic!()
    };
    near(diffuse, [0.25; 3]);
    near(specular, [0.5 / 9.0 + 0.25; 3]);
    let none = json!({"KHR_materials_specular": {"specularFactor": 0}});
    assert_eq!(of(none, 0.0), Material::Diffuse([0.5; 3]));
    let tinted = json!({"KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [1, 0, 50]}});
    let Material::Glossy { specular, grazing, .. } = of(tinted.clone(), 0.0) else { panic!() };
    near(specular, [0.02, 0.0, 0.5]);
    near(grazing, [0.5; 3]);
    // a metal reflects all at grazing incidence
    let Material::Glossy { specular, grazing, .. } = of(tinted, 0.75) else { panic!() };
    near(specular, [0.38, 0.375, 0.5]);
    near(grazing, [0.875; 3]);
    let asset = Asset::of_material(json!({"extensions": {"KHR_materials_ior": {"ior": 0.5}}}));
    assert_eq!(asset.error(), "a.glb: material 0: ior: must be 0, or finite and at least 1, not 0.5");
}

/// Specular-glossiness: α is (1 − glossiness)², and the diffuse part has what no channel of the specular part reflects.
#[test]
fn glossiness() {
    let of = |extension: Value| {
        let mut asset = textured(json!({"extensions": {"KHR_materials_pbrSpecularGlossiness": extension}}));
        asset.json["extensionsRequired"] = json!(["KHR_materials_pbrSpecularGlossiness"]);
        asset
    };
    let plain =
        of(json!({"diffuseFactor": [0.1, 0.2, 0.3, 1], "specularFactor": [0.5, 0.6, 0.7], "glossinessFactor": 0.5}));
    let (diffuse, specular) = ([0.1, 0.2, 0.3], [0.5, 0.6, 0.7]);
    let wanted = Material::Glossy { diffuse, specular, grazing: [1.0; 3], roughness: 0.25.into(), greatest: true };
    assert_eq!(material(&plain), wanted);
    assert_eq!(plain.warnings(), [""; 0]);
    let Varying::Glossy { diffuse, specular, .. } =
        varying(&of(json!({"diffuseTexture": {"index": 0}, "specularFactor": [0, 0, 0]})))
    else {
        panic!()
    };
    assert_eq!((diffuse.at([0.25, 0.25]), specular.constant()), ([1.0, 0.0, 0.0], Some([0.0; 3])));
    let text = of(json!({"specularFactor": ["red"]})).error();
    assert!(text.contains("invalid type: string \"red\", expected f32 (column "), "{text}");
    assert!(of(json!({"diffuseTexture": {"index": "x"}})).error().contains("invalid type: string \"x\""));
}

/// Properties that the list of the format lacks are warnings, and what may be misspelt is what `--strict` refuses.
#[test]
fn unknown_properties_are_named() {
    let mut asset = Asset::of_material(json!({
        "pbrMetallicRoughness": {"roughnesFactor": 0.2, "extras": {"anything": 1}},
        "colour": [1, 0, 0],
        "extensions": {"KHR_materials_ior": {"oir": 2}},
    }));
    asset.json["nodes"][0]["translaton"] = json!([1, 2, 3]);
    asset.json["meshes"][0]["primitives"][0]["attributes"]["_TEMPERATURE"] = json!(0);
    asset.json["extensionsUsed"] = json!(["KHR_xmp_json_ld", "EXT_structural_metadata"]);
    let scene = asset.read();
    let misspelt = [
        "material 0, KHR_materials_ior: unknown property \"oir\"; did you mean ior?",
        "material 0, pbrMetallicRoughness: unknown property \"roughnesFactor\"; did you mean roughnessFactor?",
        "node 0: unknown property \"translaton\"; did you mean translation?",
    ];
    let texts = |list: &[etendue_render::scene::Message]| list.iter().map(|of| of.text.clone()).collect::<Vec<_>>();
    assert_eq!(texts(&scene.stand_ins), misspelt);
    let unknown = "material 0: unknown property \"colour\" (reported once)".to_owned();
    let warnings: Vec<String> = texts(&scene.warnings).into_iter().filter(|text| text.contains("unknown")).collect();
    assert_eq!(warnings.len(), 4);
    assert!(warnings.contains(&unknown), "{warnings:?}");
}

#[test]
fn anisotropic_roughness() {
    let of = |extension: Value| {
        let surface = json!({"metallicFactor": 0.5, "roughnessFactor": 0.5, "baseColorFactor": [0.5, 0.5, 0.5, 1]});
        let extensions = json!({"KHR_materials_anisotropy": extension});
        let mut asset = Asset::of_material(json!({"pbrMetallicRoughness": surface, "extensions": extensions}));
        asset.json["extensionsRequired"] = json!(["KHR_materials_anisotropy"]);
        asset
    };
    let brushed = of(json!({"anisotropyStrength": 0.5, "anisotropyRotation": 0.75}));
    let scene = brushed.read();
    let Material::Glossy { diffuse, specular, roughness, .. } = scene.materials[scene.triangle_materials[0] as usize]
    else {
        panic!()
    };
    near(diffuse, [0.25; 3]);
    near(specular, [0.27; 3]);
    // 0.25 + (1 − 0.25) · 0.5²
    assert_eq!(roughness, Roughness { along: 0.4375, across: 0.25, turn: 0.75 });
    assert_eq!(brushed.warnings(), [""; 0]);
    assert!(scene.details.of(0).is_some(), "the direction depends on the texture coordinates");
    // without strength it is as without the extension
    let Material::Glossy { roughness, .. } = material(&of(json!({"anisotropyRotation": 1}))) else { panic!() };
    assert_eq!(roughness, 0.25.into());
    let text = of(json!({"anisotropyStrength": "0.5"})).error();
    assert_eq!(text, "a.glb: material 0: KHR_materials_anisotropy: anisotropyStrength: must be a finite number");
    let mapped = of(json!({"anisotropyStrength": 1, "anisotropyTexture": {"index": 0}})).warnings();
    assert!(mapped[0].contains("KHR_materials_anisotropy: its anisotropyTexture is ignored"), "{mapped:?}");
}

#[test]
fn textures_of_unsupported_extensions() {
    let mut asset = textured(json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}));
    asset.json["textures"][0]["extensions"] = json!({"KHR_texture_basisu": {"source": 7}});
    assert_eq!(asset.read().varying.len(), 1);
    asset.json["textures"][0].as_object_mut().unwrap().remove("source");
    let text = "texture 0: has no image: its only image is that of KHR_texture_basisu, which is not supported";
    assert_eq!(asset.error(), format!("a.glb: {text}"));
}

/// Colours of vertices, in any type that the format has, multiply the base colour between them, also of copies and beside meshes without any.
#[test]
fn vertices_have_colors() {
    let colors = [[1.0_f32, 0.5, 0.0], [0.0, 1.0, 0.5], [0.5, 0.0, 1.0]];
    let bytes = colors.map(|[r, g, b]| [r, g, b, 0.25].map(|x| (x * 255.0).round() as u8));
    for kind in ["floats", "bytes", "white"] {
        let mut asset = Asset::new();
        let positions = asset.floats(&TRIANGLE);
        let color = match kind {
            "floats" => asset.floats(&colors),
            "bytes" => asset.accessor("VEC4", 5121, 3, bytes.as_flattened()),
            _ => asset.floats(&[[1.0_f32; 3]; 3]),
        };
        if kind == "bytes" {
            asset.json["accessors"][color]["normalized"] = json!(true);
        }
        let base = json!({"baseColorFactor": [0.5, 0.25, 1, 1]});
        asset.add("materials", json!({"pbrMetallicRoughness": base, "extensions": {"KHR_materials_unlit": {}}}));
        // one without colours, but with normals of its own, precedes it
        let normals = asset.floats(&[[0.6_f32, 0.0, 0.8], [0.0, 0.6, 0.8], [0.0, 0.0, 1.0]]);
        let plain = asset.shown(json!({"attributes": {"POSITION": positions, "NORMAL": normals}, "material": 0}));
        asset.json["nodes"][plain]["translation"] = json!([-3, 0, 0]);
        let of = json!({"attributes": {"POSITION": positions, "COLOR_0": color}, "material": 0});
        asset.shown(of);
        asset.add("nodes", json!({"mesh": 1, "translation": [5, 0, 0]}));
        let (x, y) = (0.5, 0.3);
        asset.add(
            "cameras",
            json!({"type": "perspective", "perspective": {"yfov": 1e-5, "aspectRatio": 1, "znear": 0.1}}),
        );
        for (shift, name) in [(0.0, "first"), (5.0, "copy")] {
            asset.add("nodes", json!({"camera": 0, "translation": [x + shift, y, 4], "name": name}));
        }
        asset.add("nodes", json!({"extensions": {"KHR_lights_punctual": {"light": 0}}}));
        let light = json!({"type": "directional", "intensity": std::f64::consts::PI});
        asset.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [light]}});
        let right: [f64; 3] = std::array::from_fn(|k| {
            let of = |corner: usize| if kind == "white" { 1.0 } else { f64::from(colors[corner][k]) };
            [0.5, 0.25, 1.0][k] * ((1.0 - x - y) * of(0) + x * of(1) + y * of(2))
        });
        let folder = Folder::new();
        let path = folder.write("a.gltf", asset.text());
        for camera in ["first", "copy"] {
            let asked = Asked { camera: Some(camera.to_owned()), ..Asked::default() };
            let scene = load_as(&path, &asked).unwrap();
            assert!(!scene.warnings.iter().any(|warning| warning.text.contains("COLOR")), "{:?}", scene.warnings);
            let [seen, _] = pixel(&World::new(&scene).unwrap(), Technique::Auto, 16);
            assert!((0..3).all(|k| (seen[k] - right[k]).abs() < 3e-3), "{kind}, {camera}: {seen:?}, right {right:?}");
        }
    }
    let mut asset = Asset::of_triangle();
    let short = asset.floats(&[[1.0_f32; 3]; 2]);
    asset.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(short);
    assert!(asset.error().contains("3 elements of POSITION, but 2 of COLOR_0"), "{}", asset.error());
}
