//! Tests of the glTF reader: geometry and nodes. `materials` and `views` have the rest of what files describe, `faulty` has faulty files, and `asset`
//! makes files.

pub(crate) mod asset;
mod faulty;
mod listed;
mod materials;
mod views;

use crate::gltf::asset::{Asset, FLOAT, QUAD, TRIANGLE};
use crate::kit::Folder;
use etendue_render::scene::Details;
use etendue_scene::{SceneError, load, parse_gltf};
use serde_json::{Value, json};

#[test]
fn text_and_binary_files_are_the_same() {
    let asset = Asset::of_triangle();
    let scene = asset.read();
    assert_eq!(scene.triangles, [TRIANGLE]);
    assert_eq!(scene.name, "a");
    assert_eq!((scene.triangle_materials.len(), scene.materials.len(), scene.shapes.len()), (1, 1, 0));
    assert_eq!((scene.film.width, scene.film.height, scene.pixel_samples), (1280, 720, 16));
    assert!(scene.inputs.is_empty() && scene.details.of_triangles.is_empty());
    let same = parse_gltf(&asset.binary(), "b.glb").unwrap();
    assert_eq!((same.triangles, same.name.as_str()), (scene.triangles, "b"));
    // a byte order mark, as some editors write it
    let marked = [b"\xef\xbb\xbf", &*asset.text()].concat();
    assert_eq!(parse_gltf(&marked, "a.gltf").unwrap().triangles, [TRIANGLE]);
    let warnings: Vec<_> = scene.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(
        warnings,
        [
            "a.gltf: no camera: framing the whole scene",
            "a.gltf: nothing emits light: the image will be black; --environment FILE adds a sky"
        ]
    );
}

#[test]
fn other_files_are_read_and_listed() {
    let folder = Folder::new();
    let mut asset = Asset::of_triangle();
    folder.write("a buffer.bin", &asset.bytes);
    asset.json["buffers"] = json!([{"byteLength": asset.bytes.len(), "uri": "a%20buffer.bin"}]);
    let path = folder.write("Scene.GLTF", asset.text());
    let scene = load(&path).unwrap();
    assert_eq!(scene.triangles, [TRIANGLE]);
    assert_eq!(scene.name, "Scene");
    let inputs: Vec<_> = scene.inputs.iter().map(|input| &input.path).collect();
    assert_eq!(inputs, [&folder.path("a buffer.bin"), &path]);
    // the first bytes tell as well
    let path = folder.write("scene", Asset::of_triangle().binary());
    assert_eq!(load(&path).unwrap().triangles, [TRIANGLE]);

    asset.json["buffers"][0]["uri"] = json!("none.bin");
    let path = folder.write("missing.gltf", asset.text());
    let error = load(&path).unwrap_err();
    assert!(matches!(error, SceneError::At(_)));
    let shown = error.to_string();
    assert!(shown.contains("missing.gltf: buffer 0: cannot read ") && shown.contains("none.bin"), "{shown}");
}

#[test]
fn lists_strips_and_fans_with_and_without_indices() {
    let [a, b, c, d] = QUAD;
    let triangles = |mode: u32, order: Option<&[u16]>| {
        let mut asset = Asset::new();
        let positions = asset.floats(&QUAD);
        let mut primitive = json!({"attributes": {"POSITION": positions}, "mode": mode});
        if let Some(order) = order {
            primitive["indices"] = json!(asset.indices(order));
        }
        asset.shown(primitive);
        asset.read().triangles
    };
    assert_eq!(triangles(4, Some(&[0, 1, 3, 0, 3, 2])), [[a, b, d], [a, d, c]]);
    assert_eq!(triangles(4, None), [[a, b, c]]);
    assert_eq!(triangles(5, None), [[a, b, c], [b, d, c]]);
    assert_eq!(triangles(5, Some(&[0, 1, 2, 3])), [[a, b, c], [b, d, c]]);
    assert_eq!(triangles(6, Some(&[0, 1, 3, 2])), [[b, d, a], [d, c, a]]);
    assert!(triangles(1, None).is_empty() && triangles(0, None).is_empty());
    assert!(triangles(5, Some(&[0, 1])).is_empty() && triangles(4, Some(&[])).is_empty());
}

#[test]
fn indices_of_all_types() {
    for (component, size) in [(5121, 1), (5123, 2), (5125, 4)] {
        let mut asset = Asset::new();
        let positions = asset.floats(&QUAD);
        let bytes: Vec<u8> = [3_u32, 1, 0].iter().flat_map(|x| x.to_le_bytes()[..size].to_vec()).collect();
        let indices = asset.accessor("SCALAR", component, 3, &bytes);
        asset.shown(json!({"attributes": {"POSITION": positions}, "indices": indices}));
        assert_eq!(asset.read().triangles, [[QUAD[3], QUAD[1], QUAD[0]]]);
    }
}

#[test]
fn vectors_of_all_types() {
    // components, whether they are normalized, bytes, and what the greatest number stands for
    let cases: [(u32, bool, &[u8], f32); 8] = [
        (5120, false, &[127], 127.0),
        (5120, true, &[127], 1.0),
        (5121, false, &[255], 255.0),
        (5121, true, &[255], 1.0),
        (5122, false, &[0xff, 0x7f], 32_767.0),
        (5122, true, &[0xff, 0x7f], 1.0),
        (5123, false, &[0xff, 0xff], 65_535.0),
        (5123, true, &[0xff, 0xff], 1.0),
    ];
    for (component, normalized, one, wanted) in cases {
        let mut asset = Asset::new();
        let zero = vec![0; one.len()];
        // four bytes at least from one vector to the next
        let vector = |axis: usize| (0..4).flat_map(|k| if k == axis { one } else { &zero[..] }).copied().collect();
        let bytes: Vec<u8> = [3, 0, 1].iter().flat_map(|&axis| -> Vec<u8> { vector(axis) }).collect();
        let positions = asset.accessor("VEC3", component, 3, &bytes);
        asset.json["accessors"][positions]["normalized"] = json!(normalized);
        asset.json["bufferViews"][0]["byteStride"] = json!(4 * one.len());
        asset.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
        asset.shown(json!({"attributes": {"POSITION": positions}}));
        assert_eq!(asset.read().triangles, [TRIANGLE.map(|p| p.map(|x| x * wanted))], "{component} {normalized}");
    }
}

#[test]
fn interleaved_and_sparse_accessors() {
    let mut asset = Asset::new();
    let vertices = TRIANGLE.map(|[x, y, z]| [x, y, z, 0.0, 0.0, 2.0]);
    let bytes: Vec<u8> = vertices.iter().flatten().flat_map(|x: &f32| x.to_le_bytes()).collect();
    let positions = asset.accessor("VEC3", FLOAT, 3, &bytes);
    asset.json["bufferViews"][0]["byteStride"] = json!(24);
    let mut normals = asset.json["accessors"][0].clone();
    normals["byteOffset"] = json!(12);
    let normals = asset.add("accessors", normals);
    asset.shown(json!({"attributes": {"POSITION": positions, "NORMAL": normals}}));
    assert_eq!(asset.read().triangles, [TRIANGLE]);

    let values = asset.view(&[3.0_f32, 4.0, 5.0].map(f32::to_le_bytes).concat());
    let places = asset.view(&[1, 0]);
    asset.json["accessors"][0]["sparse"] = json!({
        "count": 1,
        "indices": {"bufferView": places, "componentType": 5123},
        "values": {"bufferView": values},
    });
    assert_eq!(asset.read().triangles, [[TRIANGLE[0], [3.0, 4.0, 5.0], TRIANGLE[2]]]);

    // zeros with one exception
    asset.json["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    assert!(asset.read().triangles.is_empty());
    assert_eq!(asset.warnings(), ["a.gltf: 1 triangle(s) without area are left out"]);
}

#[test]
fn normals_make_triangles_smooth() {
    let smooth = |normals: [[f32; 3]; 3], node: Value| {
        let mut asset = Asset::of_triangle();
        let normals = asset.floats(&normals);
        asset.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(normals);
        asset.json["nodes"][0] = node;
        asset.read()
    };
    let plain = json!({"mesh": 0});
    let normals = [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8], [0.0, 0.6, 0.8]];
    let scene = smooth(normals, plain.clone());
    assert_eq!(scene.details.of_triangles, [0]);
    assert_eq!(scene.details.corners[0].normals, normals);
    // the normals of a stretched surface are those of the surface
    let scene = smooth(normals, json!({"mesh": 0, "scale": [2, 1, 1]}));
    let [x, y, z] = scene.details.corners[0].normals[1];
    assert!((x / z - 0.375).abs() < 1e-6 && y == 0.0, "{x} {y} {z}");
    // normals of flat triangles say nothing, and those that are not finite do not count
    for odd in [0.0, f32::NAN, f32::INFINITY] {
        let scene = smooth([[0.0, 0.0, 1.0], [odd, 0.0, 0.0], [0.6, 0.0, 0.8]], plain.clone());
        assert!(scene.details.of_triangles.iter().all(|&index| index == Details::NONE), "{odd}: {:?}", scene.details);
    }
}

#[test]
fn transforms_of_nodes_compose() {
    let mut asset = Asset::of_triangle();
    let half = std::f32::consts::FRAC_1_SQRT_2;
    asset.json["nodes"] = json!([
        {"translation": [10, 0, 0], "children": [1, 2]},
        {"mesh": 0, "scale": [2, 3, 4], "rotation": [0, 0, half, half]},
        {"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 7, 1]},
    ]);
    let scene = asset.read();
    // scaled, then turned by 90° from x to y, then moved
    let wanted = [[[10.0, 0.0, 0.0], [10.0, 2.0, 0.0], [7.0, 0.0, 0.0]], TRIANGLE.map(|[x, y, _]| [x + 10.0, y, 7.0])];
    for (found, wanted) in scene.triangles.iter().flatten().flatten().zip(wanted.iter().flatten().flatten()) {
        assert!((found - wanted).abs() < 1e-5, "{:?}", scene.triangles);
    }
    assert_eq!(scene.triangles.len(), 2);
}

/// What the specification allows, and the reader of JSON does not expect.
#[test]
fn rare_files_are_read() {
    let mut asset = Asset::of_triangle();
    asset.json["scenes"] = json!([{"name": "empty"}]);
    asset.json["scene"] = json!(0);
    assert!(asset.read().triangles.is_empty());
    let mut asset = Asset::of_triangle();
    asset.json["animations"] = json!([{"channels": [{"sampler": 0, "target": {"path": "pointer"}}], "samplers": []}]);
    assert_eq!(asset.read().triangles, [TRIANGLE]);
    let mut asset = Asset::of_triangle();
    asset.json["accessors"][0]["count"] = json!(3.0);
    assert_eq!(asset.read().triangles, [TRIANGLE]);
    // an accessor without a view is zeros
    let mut asset = Asset::of_triangle();
    asset.json["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    assert!(asset.read().triangles.is_empty());
}

#[test]
fn the_default_scene_or_the_first_or_all_nodes() {
    let mut asset = Asset::of_triangle();
    asset.json["nodes"] = json!([{"mesh": 0}, {"children": [2]}, {"mesh": 0, "translation": [0, 0, 1]}]);
    let heights = |asset: &Asset| asset.read().triangles.iter().map(|triangle| triangle[0][2]).collect::<Vec<_>>();
    assert_eq!(heights(&asset), [0.0, 1.0]);
    asset.json["scenes"] = json!([{"nodes": [0]}, {"nodes": [1]}]);
    assert_eq!(heights(&asset), [0.0]);
    asset.json["scene"] = json!(1);
    assert_eq!(heights(&asset), [1.0]);
}

#[test]
fn what_is_ignored_is_reported_once() {
    let mut asset = Asset::of_triangle();
    for mode in [0, 1, 2, 3] {
        asset.shown(json!({"attributes": {"POSITION": 0}, "mode": mode}));
    }
    for _ in 0..2 {
        asset.shown(json!({"attributes": {"POSITION": 0, "COLOR_0": 0}, "targets": [{"POSITION": 0}], "mode": 4}));
        asset.shown(json!({"attributes": {"_OTHER": 0}}));
    }
    asset.json["animations"] = json!([{"channels": [], "samplers": []}, {"channels": [], "samplers": []}]);
    asset.json["extensionsUsed"] = json!(["KHR_xmp_json_ld", "KHR_lights_punctual"]);
    assert_eq!(
        asset.warnings(),
        [
            "a.gltf: animations are ignored: the pose at rest is rendered (reported once)",
            "a.gltf: mesh 1, primitive 0: Points are ignored: only triangles are supported (reported once)",
            "a.gltf: mesh 6, primitive 0: it has no POSITION and is ignored (reported once)",
        ]
    );
    let mut asset = Asset::new();
    let positions = asset.floats(&QUAD);
    asset.shown(json!({"attributes": {"POSITION": positions}}));
    let text = "a.gltf: mesh 0, primitive 0: 4 corners make no whole number of triangles: the last are ignored";
    assert_eq!(asset.warnings(), [format!("{text} (reported once)")]);
}

/// Morph targets move vertices and normals by the weights of the mesh, or of the node, which is the shape at rest.
#[test]
fn morph_targets_have_the_weights_of_the_file() {
    let mut asset = Asset::new();
    let positions = asset.floats(&TRIANGLE);
    let moves = [asset.floats(&[[0.0, 0.0, 1.0]; 3]), asset.floats(&[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0; 3]])];
    let targets = json!([{"POSITION": moves[0]}, {"POSITION": moves[1]}]);
    let node = asset.shown(json!({"attributes": {"POSITION": positions}, "targets": targets}));
    let corners = |asset: &Asset| asset.read().triangles[0];
    assert_eq!(corners(&asset), TRIANGLE, "without weights, nothing moves");
    asset.json["meshes"][0]["weights"] = json!([0.5, 0.25]);
    assert_eq!(corners(&asset), [[0.0, 0.0, 0.5], [1.5, 0.0, 0.5], [0.0, 1.0, 0.5]]);
    asset.json["nodes"][node]["weights"] = json!([0, 1]);
    assert_eq!(corners(&asset), [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    // two nodes of one mesh with weights of their own are no copies of each other
    asset.add("nodes", json!({"mesh": 0, "weights": [1, 0]}));
    let scene = asset.read();
    assert_eq!(scene.triangles[1], [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]]);
    assert!(!asset.warnings().iter().any(|text| text.contains("morph")));
    let short = asset.floats(&[[0.0_f32; 3]; 2]);
    asset.json["meshes"][0]["primitives"][0]["targets"][1]["POSITION"] = json!(short);
    assert!(asset.error().contains("3 elements of POSITION, but 2 of a morph target"), "{}", asset.error());
}

/// Skins move vertices and turn normals by the weighted sum of their joints, wherever the node of the mesh is.
#[test]
fn skins_have_the_pose_of_the_file() {
    let mut asset = Asset::new();
    let positions = asset.floats(&TRIANGLE);
    let normals = asset.floats(&[[0.0, 0.0, 1.0]; 3]);
    let joints = asset.accessor("VEC4", 5121, 3, &[0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0]);
    // the first half and half, the second of the first joint alone, the third of the second, by weights that are no whole
    let weights = asset.floats(&[[0.5, 0.5, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.75, 0.0, 0.0, 0.0]]);
    let attributes = json!({"POSITION": positions, "NORMAL": normals, "JOINTS_0": joints, "WEIGHTS_0": weights});
    let node = asset.shown(json!({"attributes": attributes}));
    asset.json["nodes"][node]["translation"] = json!([100, 100, 100]);
    asset.json["nodes"][node]["skin"] = json!(0);
    let first = asset.add("nodes", json!({"translation": [0, 0, 2]}));
    let second = asset.add("nodes", json!({"translation": [0, 4, 0]}));
    // the second joint was bound when it was at (0, 1, 0)
    let mut matrices = [[0.0_f32; 16]; 2];
    for matrix in &mut matrices {
        [0, 5, 10, 15].iter().for_each(|k| matrix[*k] = 1.0);
    }
    matrices[1][13] = -1.0;
    let bytes: Vec<u8> = matrices.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
    let bound = asset.accessor("MAT4", FLOAT, 2, &bytes);
    asset.add("skins", json!({"joints": [first, second], "inverseBindMatrices": bound}));
    let scene = asset.read();
    assert_eq!(scene.triangles, [[[0.0, 1.5, 1.0], [1.0, 0.0, 2.0], [0.0, 4.0, 0.0]]]);
    assert!(asset.warnings().is_empty(), "{:?}", asset.warnings());
    let mut wrong = asset.clone();
    wrong.json["skins"][0]["joints"] = json!([first]);
    assert!(wrong.error().contains("joint 1 of a vertex: there are 1"), "{}", wrong.error());
    wrong.json["skins"][0]["joints"] = json!([first, second, second]);
    assert!(wrong.error().contains("fewer inverseBindMatrices than joints"), "{}", wrong.error());
    asset.json["skins"][0]["joints"] = json!([first, 77]);
    assert!(asset.read().stand_ins[0].text.contains("its skin is ignored: a joint is not in the scene"));
}

#[test]
fn extras_may_be_anything() {
    let mut asset = Asset::of_triangle();
    for (k, extras) in [json!(1), json!("a"), json!([null]), json!({"a": {"b": []}})].into_iter().enumerate() {
        let list = ["asset", "nodes", "meshes", "accessors"][k];
        let item = if k == 0 { &mut asset.json[list] } else { &mut asset.json[list][0] };
        item["extras"] = extras;
        item["name"] = json!("a name");
    }
    assert_eq!(asset.read().triangles, [TRIANGLE]);
}
