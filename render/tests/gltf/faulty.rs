//! Tests of faulty files: each gives an error that names the item, and never a panic.

use crate::damaged::damaged;
use crate::gltf::asset::Asset;
use crate::kit::faults;
use etendue_scene::parse_gltf;
use serde_json::{Value, json};

/// An indexed triangle with normals and texture coordinates, in accessors 0 to 3, with a textured material, a camera and a child node.
fn full() -> Asset {
    let mut asset = Asset::of_material(json!({
        "emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0},
        "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
    }));
    let normals = asset.floats(&[[0.0, 0.0, 1.0]; 3]);
    let indices = asset.indices(&[0, 1, 2]);
    asset.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(normals);
    asset.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
    let png = etendue_render::film::image::encode_png([1, 1], &[[255; 3]]).unwrap();
    let view = asset.view(&png);
    asset.add("images", json!({"bufferView": view}));
    asset.add("samplers", json!({}));
    asset.add("textures", json!({"source": 0, "sampler": 0}));
    asset.add("cameras", json!({"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}));
    let node = asset.add("nodes", json!({"camera": 0}));
    asset.json["nodes"][0]["children"] = json!([node]);
    asset.add("scenes", json!({"nodes": [0]}));
    asset.json["scene"] = json!(0);
    asset
}

/// Sets the value at a JSON pointer, whose parent exists.
fn set(json: &mut Value, pointer: &str, value: Value) {
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    let parent = json.pointer_mut(parent).unwrap_or_else(|| panic!("{pointer}"));
    match key.parse::<usize>() {
        Ok(index) if parent.is_array() => parent[index] = value,
        _ => parent[key] = value,
    }
}

/// Each value of the table, at its place in [`full`], gives the error that follows it.
#[test]
fn values_that_cannot_be() {
    let whole = full();
    assert_eq!(whole.read().shapes.len(), 1);
    let size = whole.bytes.len().next_multiple_of(4).to_string();
    for (text, said) in faults(include_str!("faults.txt")) {
        let (pointer, value) = text.split_once(' ').unwrap();
        let mut asset = whole.clone();
        asset.json["buffers"] = json!([{"byteLength": asset.bytes.len()}]);
        set(&mut asset.json, pointer, serde_json::from_str(value).unwrap());
        assert_eq!(asset.error(), format!("a.glb: {}", said.replace("SIZE", &size)), "{text}");
    }
    let mut asset = whole;
    asset.json["buffers"] = json!([{"byteLength": 100_000}]);
    let text = asset.error();
    assert!(text.starts_with("a.glb: buffer 0: has ") && text.ends_with(" bytes, but should have 100000"), "{text}");
}

#[test]
fn vertices_and_indices() {
    let mut asset = Asset::new();
    let positions = asset.floats(&[[0.0; 3], [1.0, f32::NAN, 0.0], [0.0, 1.0, 0.0]]);
    asset.shown(json!({"attributes": {"POSITION": positions}}));
    let text = "a.glb: mesh 0, primitive 0: vertex 1 is at [1.0, NaN, 0.0], which is not finite in f32";
    assert_eq!(asset.error(), text);
    let mut asset = Asset::of_triangle();
    asset.json["nodes"][0]["scale"] = json!([3e38, 1, 1]);
    asset.json["nodes"] = json!([{"scale": [1e30, 1, 1], "children": [1]}, {"mesh": 0, "scale": [1e30, 1, 1]}]);
    assert!(asset.error().starts_with("a.glb: mesh 0, primitive 0: vertex 1 is at [1"), "{}", asset.error());
    let mut asset = Asset::of_triangle();
    let indices = asset.indices(&[0, 1, 3]);
    asset.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
    assert_eq!(asset.error(), "a.glb: mesh 0, primitive 0: index 2 is 3, but there are 3 vertices");
}

#[test]
fn node_trees_that_are_none() {
    let nodes = |nodes: Value, scenes: Value| {
        let mut asset = Asset::of_triangle();
        asset.json["nodes"] = nodes;
        asset.json["scenes"] = scenes;
        asset.error()
    };
    let scene = json!([{"nodes": [0]}]);
    let cycle = json!([{"children": [1]}, {"children": [0]}]);
    assert_eq!(nodes(cycle.clone(), scene.clone()), "a.glb: node 0: is its own descendant");
    assert_eq!(nodes(cycle, json!([])), "a.glb: node 0: it or one of those above it is its own descendant");
    assert_eq!(nodes(json!([{"children": [0]}]), scene.clone()), "a.glb: node 0: is its own descendant");
    let twice = json!([{"children": [1, 2]}, {"children": [2]}, {}]);
    assert_eq!(nodes(twice, scene.clone()), "a.glb: node 2: appears twice in the node tree");
    assert_eq!(nodes(json!([{}]), json!([{"nodes": [0, 0]}])), "a.glb: node 0: appears twice in the node tree");
    let chain =
        |count: usize| (0..count).map(move |k| if k + 1 < count { json!({"children": [k + 1]}) } else { json!({}) });
    let mut deep = Asset::of_triangle();
    deep.json["nodes"] = chain(1024).collect();
    assert!(deep.read().triangles.is_empty());
    assert_eq!(nodes(chain(1025).collect(), scene), "a.glb: node 1024: is more than 1024 nodes deep");
}

#[test]
fn extensions_that_may_be_missing() {
    // what a material may lack is ignored, required or not
    let mut required = full();
    required.json["extensionsRequired"] = json!(["KHR_materials_transmission", "KHR_materials_variants"]);
    assert_eq!(required.read().shapes.len(), 1);
    // what is not required has something to stand for it
    let mut asset = full();
    asset.json["meshes"][0]["primitives"][0]["extensions"] = json!({"KHR_draco_mesh_compression": {"bufferView": 99}});
    assert_eq!(asset.read().shapes.len(), 1);
}

#[test]
fn files_that_are_truncated_or_no_gltf() {
    let whole = full().binary();
    assert!(parse_gltf(&whole, "a.glb").is_ok());
    for length in 0..whole.len() {
        let error = parse_gltf(&whole[..length], "a.glb").map(|_| ()).unwrap_err().to_string();
        assert!(error.starts_with("a.glb:"), "{length}: {error}");
    }
    let changed = |at: usize, bytes: &[u8]| {
        let mut file = whole.clone();
        file[at..at + bytes.len()].copy_from_slice(bytes);
        parse_gltf(&file, "a.glb").unwrap_err().to_string()
    };
    assert_eq!(changed(4, &[1]), "a.glb: a binary glTF file of version 1: only 2 is supported");
    assert_eq!(changed(16, b"BIN\0"), "a.glb: the first chunk is \"BIN\\0\", not \"JSON\"");
    let text = format!("a.glb: the first chunk of 4294967295 bytes does not fit into {} bytes", whole.len());
    assert_eq!(changed(12, &[0xff; 4]), text);
    // a length that is too small
    assert_eq!(
        changed(8, &[3, 0, 0, 0]),
        text.replace(&format!("{}", whole.len()), "3")
            .replace("4294967295", &u32::from_le_bytes(whole[12..16].try_into().unwrap()).to_string())
    );
    assert_eq!(parse_gltf(b"glTF", "a.glb").unwrap_err().to_string(), "a.glb: truncated: the file ends at byte 4");

    let text = |json: &str| parse_gltf(json.as_bytes(), "a.gltf").unwrap_err().to_string();
    assert_eq!(text(""), "a.gltf:1: not glTF: EOF while parsing a value (column 0)");
    assert_eq!(
        text("{\n\"asset\": 3}"),
        "a.gltf:2: not glTF: invalid type: integer `3`, expected struct Asset (column 10)"
    );
    assert_eq!(text(r#"{"asset": {"version": "1.0"}}"#), "a.gltf: glTF of version \"1.0\": only 2 is supported");
    let old = r#"{"asset": {"version": "1.0"}, "nodes": {"a": {}}}"#;
    assert_eq!(text(old), "a.gltf: glTF of version \"1.0\": only 2 is supported");
    let deep = format!("{{\"asset\": {}{}", "[".repeat(100_000), "]".repeat(100_000));
    assert!(text(&deep).starts_with("a.gltf:1: not glTF: "));
    let extras =
        format!(r#"{{"asset": {{"version": "2.0", "extras": {0}{1}}}}}"#, "[".repeat(100_000), "]".repeat(100_000));
    assert!(parse_gltf(extras.as_bytes(), "a.gltf").is_ok_and(|scene| scene.triangles.is_empty()));
}

#[test]
fn a_buffer_without_data() {
    let none = full().text();
    let text = String::from_utf8(none).unwrap();
    let start = text.find("\"uri\"").unwrap();
    let end = start + text[start..].find('\n').unwrap();
    let without = format!("{}\"name\": \"b\"{}", &text[..start], &text[end..]);
    let shown = parse_gltf(without.as_bytes(), "a.gltf").unwrap_err().to_string();
    assert_eq!(shown, "a.gltf: buffer 0: has neither a URI nor a binary chunk");
}

#[test]
fn images_that_are_damaged() {
    let mut asset = full();
    let view = asset.view(b"\x89PNG\r\n\x1a\nno image");
    asset.json["images"][0]["bufferView"] = json!(view);
    assert!(asset.error().starts_with("a.glb: image 0: not a valid PNG image: "), "{}", asset.error());
    asset.json["images"][0] = json!({"uri": "data:image/webp;base64,UklGRgAAAABXRUJQ"});
    assert!(asset.error().starts_with("a.glb: image 0: "), "{}", asset.error());
}

#[test]
fn damaged_copies_never_panic() {
    for file in [full().text(), full().binary()] {
        damaged(&file, &["0", "[", "{", "-", "null,"], 1000, |bytes| {
            if let Err(error) = parse_gltf(bytes, "a.gltf") {
                assert!(error.to_string().starts_with("a.gltf:"), "{error}");
            }
        });
    }
}
