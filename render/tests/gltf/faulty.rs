//! Tests of faulty files: each gives an error that names the item, and never a panic.

use crate::damaged::damaged;
use crate::gltf::asset::Asset;
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

/// The error of [`full`] with other values.
fn error(changes: &[(&str, Value)]) -> String {
    let mut asset = full();
    asset.json["buffers"] = json!([{"byteLength": asset.bytes.len()}]);
    for (pointer, value) in changes {
        set(&mut asset.json, pointer, value.clone());
    }
    asset.error()
}

#[test]
fn items_that_do_not_exist() {
    assert_eq!(full().read().shapes.len(), 1);
    let cases = [
        ("/scene", "the default scene: scene 9 does not exist: there are 1"),
        ("/scenes/0/nodes/0", "scene 0: node 9 does not exist: there are 2"),
        ("/nodes/0/children/0", "node 0: node 9 does not exist: there are 2"),
        ("/nodes/0/mesh", "node 0: mesh 9 does not exist: there are 1"),
        ("/nodes/1/camera", "node 1: camera 9 does not exist: there are 1"),
        ("/meshes/0/primitives/0/material", "mesh 0, primitive 0: material 9 does not exist: there are 1"),
        ("/meshes/0/primitives/0/indices", "mesh 0, primitive 0: accessor 9 does not exist: there are 4"),
        ("/meshes/0/primitives/0/attributes/POSITION", "mesh 0, primitive 0: accessor 9 does not exist: there are 4"),
        ("/meshes/0/primitives/0/attributes/NORMAL", "mesh 0, primitive 0: accessor 9 does not exist: there are 4"),
        ("/meshes/0/primitives/0/attributes/TEXCOORD_0", "mesh 0, primitive 0: accessor 9 does not exist: there are 4"),
        ("/materials/0/emissiveTexture/index", "material 0: texture 9 does not exist: there are 1"),
        ("/textures/0/source", "texture 0: image 9 does not exist: there are 1"),
        ("/textures/0/sampler", "texture 0: sampler 9 does not exist: there are 1"),
        ("/images/0/bufferView", "image 0: bufferView 9 does not exist: there are 5"),
        ("/accessors/0/bufferView", "accessor 0: bufferView 9 does not exist: there are 5"),
        ("/bufferViews/0/buffer", "bufferView 0: buffer 9 does not exist: there are 1"),
    ];
    for (pointer, wanted) in cases {
        assert_eq!(error(&[(pointer, json!(9))]), format!("a.glb: {wanted}"), "{pointer}");
    }
    let light = json!({"KHR_lights_punctual": {"light": 3}});
    assert_eq!(error(&[("/nodes/1/extensions", light)]), "a.glb: node 1: light 3 does not exist: there are 0");
}

#[test]
fn elements_that_do_not_fit() {
    let huge = json!(u64::MAX);
    for (pointer, value, [count, bytes, apart, start, room, view]) in [
        ("/accessors/0/count", json!(4), [4, 12, 12, 0, 36, 0]),
        ("/accessors/0/count", huge.clone(), [u64::MAX, 12, 12, 0, 36, 0]),
        ("/accessors/0/byteOffset", json!(1), [3, 12, 12, 1, 36, 0]),
        ("/accessors/0/byteOffset", huge.clone(), [3, 12, 12, u64::MAX, 36, 0]),
        ("/bufferViews/0/byteStride", json!(16), [3, 12, 16, 0, 36, 0]),
        ("/bufferViews/0/byteStride", huge.clone(), [3, 12, u64::MAX, 0, 36, 0]),
        ("/accessors/3/count", json!(30), [30, 2, 2, 0, 6, 3]),
    ] {
        let elements =
            format!("accessor {view}: {count} elements of {bytes} bytes, {apart} apart, from byte {start} on");
        let wanted = format!("a.glb: {elements} do not fit into the {room} bytes of bufferView {view}");
        assert_eq!(error(&[(pointer, value)]), wanted, "{pointer}");
    }
    let text = error(&[("/bufferViews/0/byteStride", json!(0))]);
    assert_eq!(text, "a.glb: accessor 0: elements of 12 bytes are 0 bytes apart");
    let size = full().bytes.len();
    for (pointer, value, offset, length) in [
        ("/bufferViews/0/byteLength", json!(1000), 0, 1000),
        ("/bufferViews/0/byteOffset", json!(1000), 1000, 36),
        ("/bufferViews/0/byteOffset", huge.clone(), u64::MAX, 36),
        ("/bufferViews/0/byteLength", huge, 0, u64::MAX),
    ] {
        let text = error(&[(pointer, value)]);
        let room = size.next_multiple_of(4);
        let wanted = format!("{length} bytes from byte {offset} on do not fit into the {room} bytes of buffer 0");
        assert_eq!(text, format!("a.glb: bufferView 0: {wanted}"));
    }
    let text = error(&[("/buffers/0/byteLength", json!(100_000))]);
    assert!(text.starts_with("a.glb: buffer 0: has ") && text.ends_with(" bytes, but should have 100000"), "{text}");
    // counts without bytes
    let sparse = json!({"count": 1, "indices": {"bufferView": 3, "componentType": 5123}, "values": {"bufferView": 0}});
    let zeros = json!({"count": u64::MAX, "componentType": 5126, "type": "VEC3", "sparse": sparse});
    let text =
        "accessor 0, of mesh 0, primitive 0: 18446744073709551615 elements, but no bufferView: at most 4194304 are";
    assert_eq!(error(&[("/accessors/0", zeros)]), format!("a.glb: {text} supported"));
}

#[test]
fn sparse_accessors() {
    let sparse = |count: u64, component: u32, view: u32| {
        let indices = json!({"bufferView": view, "componentType": component});
        error(&[("/accessors/0/sparse", json!({"count": count, "indices": indices, "values": {"bufferView": 0}}))])
    };
    assert_eq!(sparse(4, 5123, 3), "a.glb: accessor 0: has 4 sparse elements of 3");
    assert_eq!(sparse(1, 5126, 3), "a.glb: accessor 0: the componentType of its sparse indices is unknown");
    assert_eq!(sparse(1, 5123, 9), "a.glb: accessor 0: sparse indices: bufferView 9 does not exist: there are 5");
    // the first two indices of the triangle, 0 and 1, as one number
    assert_eq!(sparse(1, 5125, 3), "a.glb: accessor 0: the sparse index 65536 is not below 3");
}

#[test]
fn types_and_numbers() {
    let of = "of mesh 0, primitive 0:";
    let cases = [
        ("/accessors/0/componentType", json!(1), format!("accessor 0, {of} its componentType is unknown")),
        (
            "/accessors/0/componentType",
            json!(5125),
            format!("accessor 0, {of} its components are 32-bit integers, which only indices may be"),
        ),
        ("/accessors/3/componentType", json!(5126), format!("accessor 3, {of} F32 is no type of unsigned integers")),
        ("/accessors/0/type", json!("VEC2"), format!("accessor 0, {of} its type is Vec2, not Vec3")),
        ("/accessors/0/type", json!("X"), format!("accessor 0, {of} its type is unknown")),
        ("/accessors/2/count", json!(2), "mesh 0, primitive 0: 3 elements of POSITION, but 2 of NORMAL".into()),
        ("/accessors/1/count", json!(2), "mesh 0, primitive 0: 3 elements of POSITION, but 2 of TEXCOORD".into()),
        ("/meshes/0/primitives/0/mode", json!(7), "mesh 0, primitive 0: its mode is unknown".into()),
        ("/nodes/0/rotation", json!([0, 0, 0, 0]), "node 0: its rotation [0.0, 0.0, 0.0, 0.0] is no quaternion".into()),
        (
            "/nodes/0/matrix",
            json!([1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]),
            "node 0: its matrix is not affine: the last row is [1.0, 0.0, 0.0, 1.0]".into(),
        ),
        ("/nodes/0/translation", json!([1e39, 0, 0]), "node 0: its transform is not finite".into()),
        ("/nodes/0/scale", json!([0, 0, 0]), "node 1: the transform of its camera is singular".into()),
        (
            "/cameras/0/perspective/yfov",
            json!(0),
            "camera 0: yfov: must be greater than 0 and less than π, not 0".into(),
        ),
        (
            "/cameras/0/perspective/aspectRatio",
            json!(0),
            "camera 0: aspectRatio: must be finite and greater than 0, not 0".into(),
        ),
        ("/cameras/0/type", json!("fish"), "camera 0: its type is not \"perspective\" or \"orthographic\"".into()),
        ("/cameras/0/perspective", json!(null), "camera 0: a perspective camera without \"perspective\"".into()),
        (
            "/materials/0/emissiveFactor",
            json!([-1, 0, 0]),
            "material 0: emissiveFactor [-1.0, 0.0, 0.0] times emissiveStrength 1: must be from 0 to 4e37".into(),
        ),
        ("/images/0", json!({}), "image 0: has neither a URI nor a bufferView".into()),
    ];
    for (pointer, value, wanted) in cases {
        assert_eq!(error(&[(pointer, value)]), format!("a.glb: {wanted}"), "{pointer}");
    }
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
fn extensions_that_are_required() {
    let compressed = ": its geometry is compressed";
    for (name, why) in [
        ("KHR_draco_mesh_compression", compressed),
        ("EXT_meshopt_compression", compressed),
        ("KHR_texture_basisu", ""),
        ("ABC_new", ""),
    ] {
        let text = format!("a.glb: requires the extension {name:?}, which is not supported{why}");
        assert_eq!(error(&[("/extensionsRequired", json!([name]))]), text);
    }
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
fn uris() {
    let of = |uri: &str| error(&[("/buffers/0", json!({"byteLength": 10, "uri": uri}))]);
    assert_eq!(of("data:;base64"), "a.glb: buffer 0: \"data:;base64\" has no comma");
    assert_eq!(of("data:;base64,AA*A"), "a.glb: buffer 0: damaged base64 data: Invalid symbol 42, offset 2.");
    assert_eq!(of("data:,abc%41"), "a.glb: buffer 0: has 4 bytes, but should have 10");
    assert_eq!(of("data:;base64,AAAA"), "a.glb: buffer 0: has 3 bytes, but should have 10");
    // without padding, or with percent signs
    assert_eq!(of("data:;base64,AAA"), "a.glb: buffer 0: has 2 bytes, but should have 10");
    assert_eq!(of("data:;base64,AA%3D%3D"), "a.glb: buffer 0: has 1 bytes, but should have 10");
    assert_eq!(of("http://a.b/c.bin"), "a.glb: buffer 0: \"http://a.b/c.bin\": only files and data URIs are supported");
    assert_eq!(of("c.bin"), "a.glb: buffer 0: \"c.bin\": other files cannot be read here");
    assert_eq!(of("%ff"), "a.glb: buffer 0: the URI \"%ff\" is not UTF-8");
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
