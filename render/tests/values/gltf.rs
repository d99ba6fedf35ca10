//! Lights, emissive surfaces and cameras of glTF files.

use super::place::{NamedTransform, similar};
use super::row::{Row, Text, grey, reflected, times};
use crate::gltf::asset::Asset;
use etendue_oracle::{V3, along, basis, dot, length, sub, unit};
use serde_json::{Value, json};

/// The corners of the floor.
pub(super) const FLOOR: [[f32; 3]; 4] =
    [[500.0, 0.0, -500.0], [-500.0, 0.0, -500.0], [-500.0, 0.0, 500.0], [500.0, 0.0, 500.0]];

/// A file with this camera, these lights and these nodes; mesh 0 is a floor in the plane y = 0, mesh 1 a square of half side 1 that faces +z.
pub(super) fn file(camera: Value, lights: Value, nodes: Vec<Value>, emissive: Value) -> Asset {
    let mut asset = Asset::new();
    let square = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
    let positions = [asset.floats(&FLOOR), asset.floats(&square)];
    let indices = asset.indices(&[0, 1, 2, 0, 2, 3]);
    for (material, positions) in positions.into_iter().enumerate() {
        let primitive = json!({"attributes": {"POSITION": positions}, "indices": indices, "material": material});
        asset.add("meshes", json!({"primitives": [primitive]}));
    }
    let matt = json!({"baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0, "roughnessFactor": 1});
    let dull = json!({"KHR_materials_specular": {"specularFactor": 0}});
    asset.add("materials", json!({"pbrMetallicRoughness": matt, "extensions": dull}));
    asset.add("materials", emissive);
    asset.add("cameras", camera);
    let roots: Vec<_> = (0..nodes.len()).filter(|k| nodes[*k]["is child"].is_null()).collect();
    asset.add("scenes", json!({"nodes": roots}));
    for mut node in nodes {
        node.as_object_mut().unwrap().remove("is child");
        asset.add("nodes", node);
    }
    asset.json["extensionsUsed"] =
        json!(["KHR_lights_punctual", "KHR_materials_specular", "KHR_materials_emissive_strength"]);
    asset.json["extensions"] = json!({"KHR_lights_punctual": {"lights": lights}});
    asset
}

const NARROW: f64 = 1e-6;

pub(super) fn narrow() -> Value {
    json!({"type": "perspective", "perspective": {"yfov": NARROW, "aspectRatio": 1, "znear": 0.001}})
}

/// A matrix of columns.
fn matrix(place: &NamedTransform, shift: V3) -> Vec<f64> {
    let axis = |v: V3| place.vector(v);
    let columns = [axis([1.0, 0.0, 0.0]), axis([0.0, 1.0, 0.0]), axis([0.0, 0.0, 1.0])];
    let mut all: Vec<f64> = columns.iter().flat_map(|c| [c[0], c[1], c[2], 0.0]).collect();
    all.extend([shift[0], shift[1], shift[2], 1.0]);
    all
}

/// A node whose −z axis is along `towards`.
fn aimed(place: &NamedTransform, at: V3, towards: V3) -> Vec<f64> {
    // in the space of the node, by columns right, up, back
    let back = unit(place.inverse_vector(times(towards, -1.0)));
    let (right, up) = basis(back);
    let columns = [right, up, back].map(|v| place.vector(v));
    let mut all: Vec<f64> = columns.iter().flat_map(|c| [c[0], c[1], c[2], 0.0]).collect();
    all.extend([at[0], at[1], at[2], 1.0]);
    all
}

/// The node of a camera that looks from `eye` at `target`.
pub(super) fn looking(eye: V3, target: V3) -> Value {
    json!({"camera": 0, "matrix": aimed(&NamedTransform::new(), eye, unit(sub(target, eye)))})
}

pub(super) fn row(name: String, asset: &Asset, right: V3) -> Row {
    Row { text: Text::Gltf(asset.text()), ..Row::new(name, String::new(), right) }
}

pub(super) fn rows() -> Vec<Row> {
    [lights(), emissive(), sides(), cameras(), speculars()].into_iter().flatten().collect()
}

/// The diffuse part gets the light that no channel of a tinted specular part reflects (`KHR_materials_specular`): a floor of roughness 1, seen
/// along its normal and lit at 45°, by appendix B of glTF 2.0.
fn speculars() -> Vec<Row> {
    let half = (std::f64::consts::PI / 8.0).cos();
    let lambda = 0.5 * (2_f64.sqrt() - 1.0);
    let (shine, lit) = (std::f64::consts::FRAC_1_PI / (1.0 + lambda) / 4.0, 0.5_f64.sqrt());
    let mut rows = Vec::new();
    for (ior, factor, tint, metallic) in [
        (1.5, 1.0, [1.0, 1.0, 1.0], 0.0),
        (1.5, 1.0, [10.0, 2.0, 0.0], 0.0),
        (0.0, 1.0, [0.8, 0.1, 0.1], 0.0),
        (0.0, 0.5, [0.1, 0.9, 0.2], 0.0),
        (2.42, 0.7, [0.2, 0.3, 1.0], 0.0),
        (1.5, 1.0, [5.0, 1.0, 1.0], 0.5),
    ] {
        let light = json!({"type": "directional", "color": [1, 1, 1], "intensity": 1});
        let matrix = aimed(&NamedTransform::new(), [0.0; 3], [1.0, -1.0, 0.0]);
        let node = json!({"matrix": matrix, "extensions": {"KHR_lights_punctual": {"light": 0}}});
        let nodes = vec![json!({"mesh": 0}), looking([0.0, 0.5, 0.0], [0.0; 3]), node];
        let mut asset = file(narrow(), json!([light]), nodes, json!({}));
        let surface = json!({"baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": metallic, "roughnessFactor": 1});
        asset.json["materials"][0] = json!({"pbrMetallicRoughness": surface, "extensions": {
            "KHR_materials_specular": {"specularFactor": factor, "specularColorFactor": tint},
            "KHR_materials_ior": {"ior": ior},
        }});
        let ratio: f64 = (ior - 1.0) / (ior + 1.0);
        let reflected = tint.map(|x: f64| {
            let dielectric = (x * ratio * ratio).min(1.0) * factor;
            let normal = dielectric + (0.5 - dielectric) * metallic;
            let grazing = factor + (1.0 - factor) * metallic;
            normal + (grazing - normal) * (1.0 - half).powi(5)
        });
        let most = reflected.iter().fold(0.0_f64, |most, x| most.max(*x));
        let diffuse = (1.0 - most) * 0.5 * (1.0 - metallic) * std::f64::consts::FRAC_1_PI;
        let right = reflected.map(|f| lit * diffuse + f * shine);
        let name = format!("KHR_materials_specular {factor} {tint:?}, ior {ior}, metallic {metallic}");
        rows.push(row(name, &asset, right));
    }
    rows
}

/// Candelas and lux of the same number as watts: pbrt-like renderers have no others. KHR_lights_punctual: a node's light shines along its −z
/// axis, scales do not matter, and a spot falls off by the square of a linear function of the cosine.
fn lights() -> Vec<Row> {
    let mut rows = Vec::new();
    let on_floor = |light: Value, matrix: Vec<f64>| {
        let node = json!({"matrix": matrix, "extensions": {"KHR_lights_punctual": {"light": 0}}});
        let nodes = vec![json!({"mesh": 0}), looking([0.0, 0.5, 0.0], [0.0; 3]), node];
        file(narrow(), json!([light]), nodes, json!({}))
    };
    let lit = |p: V3| p[1] / length(p).powi(3);
    for place in similar(&NamedTransform::new()) {
        for (color, intensity) in [([1.0, 1.0, 1.0], 100.0), ([1.0, 0.5, 0.25], 3.0)] {
            let strength = times(color, intensity);
            let described = |kind: &str| json!({"type": kind, "color": color, "intensity": intensity});
            let at = [0.4, 2.0, -0.3];
            let text = on_floor(described("point"), matrix(&place, at));
            let name = |kind: &str| format!("glTF {kind} {intensity}, {}", place.name);
            rows.push(row(name("point"), &text, reflected(times(strength, lit(at)))));
            for towards in [[0.0, -1.0, 0.0], [0.5, -0.7, 0.3], [0.2, 0.4, 0.1]] {
                let text = on_floor(described("directional"), aimed(&place, at, towards));
                let right = times(strength, (-unit(towards)[1]).max(0.0));
                rows.push(row(format!("{} {towards:?}", name("directional")), &text, reflected(right)));
            }
            for (inner, outer) in [(0.0, 0.785), (0.2, 0.4), (0.3, 0.3001)] {
                for target in [[0.0, 0.0, 0.0], [0.6, 0.0, 0.1], [3.0, 0.0, 0.0]] {
                    let mut light = described("spot");
                    light["spot"] = json!({"innerConeAngle": inner, "outerConeAngle": outer});
                    let axis = unit(sub(target, at));
                    let cos = dot(axis, unit(times(at, -1.0)));
                    let [from, to] = [f64::cos(outer), f64::cos(inner)];
                    let falloff = ((cos - from) / (to - from)).clamp(0.0, 1.0).powi(2);
                    let text = on_floor(light, aimed(&place, at, axis));
                    let right = times(strength, falloff * lit(at));
                    rows.push(
                        row(format!("{} {inner} {outer} {target:?}", name("spot")), &text, reflected(right))
                            .within(2e-4),
                    );
                }
            }
        }
    }
    // without specular reflection, a surface is diffuse from everywhere
    let grazing = unit([1.0, 0.05, 0.0]);
    let node = json!({"matrix": aimed(&NamedTransform::new(), [0.0; 3], [1.0, -0.05, 0.0]), "extensions": {"KHR_lights_punctual": {"light": 0}}});
    let nodes = vec![json!({"mesh": 0}), looking(grazing, [0.0; 3]), node];
    let text = file(narrow(), json!([{"type": "directional"}]), nodes, json!({}));
    rows.push(row("glTF without specular reflection".into(), &text, reflected(grey(grazing[1]))));
    // a light within a scaled and turned node
    let parent = json!({"translation": [0, 3, 0], "rotation": [-0.5_f64.sqrt(), 0, 0, 0.5_f64.sqrt()], "scale": [2, 2, 2], "children": [3]});
    let child =
        json!({"translation": [0, 0, 0.5], "is child": true, "extensions": {"KHR_lights_punctual": {"light": 0}}});
    for (kind, right) in [("point", 1.0 / 16.0), ("directional", 1.0)] {
        let nodes = vec![json!({"mesh": 0}), looking([0.0, 0.5, 0.0], [0.0; 3]), parent.clone(), child.clone()];
        let text = file(narrow(), json!([{"type": kind}]), nodes, json!({}));
        rows.push(row(format!("glTF {kind} within a node"), &text, reflected(grey(right))));
    }
    let mut ranged = row(
        "glTF point of a range".into(),
        &on_floor(json!({"type": "point", "range": 1.5}), matrix(&NamedTransform::new(), [0.0, 2.0, 0.0])),
        grey(0.0),
    );
    ranged = ranged.differs(reflected(grey(0.25)), "a range is a hint, and no light ends there");
    rows.push(ranged);
    rows
}

/// A material's emissiveFactor times its emissiveStrength is the radiance of the front, and of the back if it is double-sided. A node that
/// mirrors turns no front into a back.
fn emissive() -> Vec<Row> {
    let mut rows = Vec::new();
    for place in similar(&NamedTransform::new()) {
        for (material, radiance, double) in [
            (json!({"emissiveFactor": [1, 0.5, 0.25]}), [1.0, 0.5, 0.25], false),
            (json!({"emissiveFactor": [1, 0.5, 0.25], "doubleSided": true}), [1.0, 0.5, 0.25], true),
            (
                json!({"emissiveFactor": [1, 1, 0.5], "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8}}}),
                [8.0, 8.0, 4.0],
                false,
            ),
        ] {
            for side in [1.0, -1.0] {
                let at = [0.5, 3.0, -1.0];
                let point = along(place.vector([0.3, -0.2, 0.0]), at, 1.0);
                let eye = along(point, along([0.02, 0.01, -0.01], place.normal([0.0, 0.0, 1.0]), side), 1.0);
                let nodes = vec![looking(eye, point), json!({"mesh": 1, "matrix": matrix(&place, at)})];
                let right = if side > 0.0 || double { radiance } else { grey(0.0) };
                let name = format!("glTF {material}, {}, side {side}", place.name);
                rows.push(row(name, &file(narrow(), json!([]), nodes, material.clone()), right));
            }
        }
    }
    rows
}

/// The camera sees the floor through the back of a single-sided square, which still hides the light that falls on the floor.
fn sides() -> Vec<Row> {
    let mut rows = Vec::new();
    for (double, faces_up, light_x) in
        [false, true].iter().flat_map(|d| [(*d, true, 3.0), (*d, true, 0.0), (*d, false, 3.0), (*d, false, 0.0)])
    {
        let node = json!({"translation": [light_x, 4, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}});
        // the square is half way from the eye to the floor, or from the light
        let turn = if faces_up { -0.5_f64.sqrt() } else { 0.5_f64.sqrt() };
        let square = json!({"mesh": 1, "translation": [0, 1, 0], "scale": [0.3, 0.3, 0.3], "rotation": [turn, 0, 0, 0.5_f64.sqrt()]});
        let nodes = vec![json!({"mesh": 0}), looking([0.0, 2.0, 0.0], [0.0; 3]), node, square];
        let dark = json!({"pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0}, "doubleSided": double,
            "extensions": {"KHR_materials_specular": {"specularFactor": 0}}});
        let light = json!({"type": "point", "intensity": 10});
        let is_seen = double || faces_up;
        let right = if is_seen || light_x == 0.0 { 0.0 } else { 5.0 / std::f64::consts::PI * 4.0 / 125.0 };
        let name = format!("doubleSided {double}, the front up {faces_up}, light at {light_x}");
        rows.push(row(name, &file(narrow(), json!([light]), nodes, dark), grey(right)));
    }
    rows
}

/// An orthographic camera shows 2 xmag by 2 ymag around its axis, from where it is.
fn cameras() -> Vec<Row> {
    let mut rows = Vec::new();
    // half of what it sees is the square of half side 1 before it
    let camera = |xmag: f64, ymag: f64| json!({"type": "orthographic", "orthographic": {"xmag": xmag, "ymag": ymag, "zfar": 100, "znear": 0.1}});
    for (xmag, ymag, share) in [(1.0, 1.0, 1.0), (2.0, 2.0, 0.25), (0.5, 0.5, 1.0)] {
        let node = json!({"camera": 0, "translation": [0, 0, 5], "scale": [3, 3, 3]});
        let nodes = vec![node, json!({"mesh": 1})];
        let text = file(camera(xmag, ymag), json!([]), nodes, json!({"emissiveFactor": [1, 1, 1]}));
        rows.push(row(format!("glTF orthographic {xmag} {ymag}"), &text, grey(share)).samples(1 << 16));
    }
    // a tangent of 0.4 of half the angle, at distance 5
    let yfov = 2.0 * 0.4_f64.atan();
    let seen = json!({"type": "perspective", "perspective": {"yfov": yfov, "aspectRatio": 1, "znear": 0.1}});
    let nodes = vec![json!({"camera": 0, "translation": [0, 0, 5]}), json!({"mesh": 1})];
    let text = file(seen, json!([]), nodes, json!({"emissiveFactor": [1, 1, 1]}));
    rows.push(row("glTF perspective".into(), &text, grey(0.25)).samples(1 << 16));
    // behind the camera
    let nodes = vec![json!({"camera": 0, "translation": [0, 0, -1]}), json!({"mesh": 1})];
    let text = file(camera(1.0, 1.0), json!([]), nodes, json!({"emissiveFactor": [1, 1, 1]}));
    rows.push(row("glTF orthographic, before what it sees".into(), &text, grey(0.0)));
    rows
}
