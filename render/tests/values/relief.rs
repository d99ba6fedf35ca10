//! Normal maps of one texel: a floor that is seen from above and lit by a point light, by pbrt-v4's and glTF's frames.

use super::gltf::{FLOOR, file, looking, narrow, row};
use super::row::{Row, grey, look};
use base64::Engine;
use etendue_oracle::{V3, cross, dot, sub, unit};
use etendue_render::film::image::encode_png;
use serde_json::json;

/// The bytes of the texel.
const TEXEL: [u8; 3] = [200, 90, 220];

/// How texture coordinates (u, v) follow from positions (x, y) on the floor: rows, which another vector is added to.
const FRAMES: [(&str, [[f64; 2]; 2]); 6] = [
    ("as they are", [[1.0, 0.0], [0.0, 1.0]]),
    ("turned", [[0.6, 0.8], [-0.8, 0.6]]),
    ("mirrored", [[-1.0, 0.0], [0.0, 1.0]]),
    ("upside down", [[1.0, 0.0], [0.0, -1.0]]),
    ("narrow", [[0.2, 0.0], [0.0, 3.0]]),
    ("slanted", [[1.0, 0.7], [0.3, -1.1]]),
];

const LIGHT: V3 = [1.2, -0.7, 2.0];

pub(super) fn rows() -> Vec<Row> {
    let mut rows = of_pbrt();
    rows.extend(of_gltf());
    rows
}

/// The unit direction on the floor in which u grows and v does not, and that in which v grows and u does not.
fn directions([[a, b], [c, d]]: [[f64; 2]; 2]) -> [V3; 2] {
    let det = a * d - b * c;
    [[d / det, -c / det, 0.0], [-b / det, a / det, 0.0]].map(unit)
}

/// The normal that the texel stands for, in a frame.
fn normal(scale: f64, axes: [V3; 3]) -> V3 {
    let [x, y, z] = TEXEL.map(|byte| 2.0 * f64::from(byte) / 255.0 - 1.0);
    unit(std::array::from_fn(|k| scale * x * axes[0][k] + scale * y * axes[1][k] + z * axes[2][k]))
}

/// What the origin reflects of a light of 10 candelas per unit of luminance, with albedo 0.5.
fn reflected(normal: V3, light: V3) -> f64 {
    5.0 * std::f64::consts::FRAC_1_PI * dot(normal, unit(light)).max(0.0) / dot(light, light)
}

fn of_pbrt() -> Vec<Row> {
    let mut rows = Vec::new();
    for (name, frame) in FRAMES {
        for (side, reverse) in [(1.0, ""), (-1.0, "ReverseOrientation ")] {
            let corners = [[-900.0, -900.0], [900.0, -900.0], [900.0, 900.0], [-900.0, 900.0]];
            let numbers: Vec<_> = corners
                .iter()
                .flat_map(|p| frame.map(|[a, b]| a * p[0] + b * p[1] + 0.3))
                .map(|x| x.to_string())
                .collect();
            let text = format!(
                "{}LightSource \"point\" \"rgb I\" [10 10 10] \"point3 from\" [1.2 -.7 2]\nMaterial \"diffuse\" \"string normalmap\" \
                 \"relief.png\"\n{reverse}Shape \"trianglemesh\" \"point3 P\" [-900 -900 0 900 -900 0 900 900 0 -900 900 0] \
                 \"integer indices\" [0 1 2 0 2 3] \"point2 uv\" [{}]",
                look([0.1, 0.2, 5.0], [0.0; 3]),
                numbers.join(" ")
            );
            // the frame has the outward normal, and the surface is the same from both sides
            let (along, out) = (directions(frame)[0], [0.0, 0.0, side]);
            let n = normal(1.0, [along, cross(out, along), out]).map(|x| side * x);
            rows.push(Row::new(format!("normalmap {name} {reverse}"), text, grey(reflected(n, LIGHT))).within(1e-4));
        }
    }
    rows
}

fn of_gltf() -> Vec<Row> {
    let picture = base64::engine::general_purpose::STANDARD.encode(png());
    let picture = format!("data:image/png;base64,{picture}");
    let mut rows = Vec::new();
    for (name, frame) in FRAMES {
        for scale in [1.0, -0.5] {
            // the floor's axes x, y and up are x, −z and y of the file
            let node = json!({"translation": [LIGHT[0], LIGHT[2], -LIGHT[1]], "extensions": {"KHR_lights_punctual": {"light": 0}}});
            let nodes = vec![json!({"mesh": 0}), looking([0.1, 5.0, -0.2], [0.0; 3]), node];
            let light = json!({"type": "point", "intensity": 10});
            let mut asset = file(narrow(), json!([light]), nodes, json!({}));
            let uvs = FLOOR.map(|[x, _, z]| frame.map(|[a, b]| (a * f64::from(x) - b * f64::from(z) + 0.3) as f32));
            let uvs = asset.floats(&uvs);
            asset.add("images", json!({"uri": picture}));
            asset.add("textures", json!({"source": 0}));
            asset.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(uvs);
            asset.json["materials"][0]["normalTexture"] = json!({"index": 0, "scale": scale});
            // the second axis is at right angles to the first, on the side where v falls
            let (up, [along, rising]) = ([0.0, 0.0, 1.0], directions(frame));
            let across = cross(up, along);
            let across = if dot(across, rising) > 0.0 { sub([0.0; 3], across) } else { across };
            let right = grey(reflected(normal(scale, [along, across, up]), LIGHT));
            rows.push(row(format!("normalTexture {name}, scale {scale}"), &asset, right).within(1e-4));
        }
    }
    rows
}

/// The texel as a picture.
pub(super) fn png() -> Vec<u8> {
    encode_png([1, 1], &[TEXEL]).unwrap()
}
