//! A glTF file that is put together from parts.

use base64::Engine;
use etendue_render::scene::Scene;
use etendue_scene::parse_gltf;
use serde_json::{Value, json};

/// A file that is put together from parts. All its numbers are in one buffer.
#[derive(Clone)]
pub(crate) struct Asset {
    pub(crate) json: Value,
    pub(crate) bytes: Vec<u8>,
}

pub(crate) const TRIANGLE: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
pub(crate) const QUAD: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
pub(crate) const FLOAT: u32 = 5126;

impl Asset {
    pub(crate) fn new() -> Self {
        Self { json: json!({"asset": {"version": "2.0"}}), bytes: Vec::new() }
    }

    /// Adds an item to a list, and returns its index.
    pub(crate) fn add(&mut self, list: &str, item: Value) -> usize {
        let list = &mut self.json[list];
        if list.is_null() {
            *list = json!([]);
        }
        let list = list.as_array_mut().unwrap();
        list.push(item);
        list.len() - 1
    }

    pub(crate) fn view(&mut self, bytes: &[u8]) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let view = json!({"buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len()});
        self.bytes.extend_from_slice(bytes);
        self.add("bufferViews", view)
    }

    pub(crate) fn accessor(&mut self, kind: &str, component: u32, count: usize, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        self.add("accessors", json!({"bufferView": view, "componentType": component, "count": count, "type": kind}))
    }

    pub(crate) fn floats<const N: usize>(&mut self, elements: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = elements.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        self.accessor(["SCALAR", "VEC2", "VEC3", "VEC4"][N - 1], FLOAT, elements.len(), &bytes)
    }

    pub(crate) fn indices(&mut self, indices: &[u16]) -> usize {
        let bytes: Vec<u8> = indices.iter().flat_map(|x| x.to_le_bytes()).collect();
        self.accessor("SCALAR", 5123, indices.len(), &bytes)
    }

    /// Adds a mesh of one primitive, and a node that has it.
    pub(crate) fn shown(&mut self, primitive: Value) -> usize {
        let mesh = self.add("meshes", json!({"primitives": [primitive]}));
        self.add("nodes", json!({"mesh": mesh}))
    }

    /// A triangle and its node.
    pub(crate) fn of_triangle() -> Self {
        let mut asset = Self::new();
        let positions = asset.floats(&TRIANGLE);
        asset.shown(json!({"attributes": {"POSITION": positions}}));
        asset
    }

    /// A triangle with this material and a texture coordinate set of its positions.
    pub(crate) fn of_material(material: Value) -> Self {
        let mut asset = Self::of_triangle();
        asset.add("materials", material);
        let uvs = asset.floats(&TRIANGLE.map(|[x, y, _]| [x, y]));
        asset.json["meshes"][0]["primitives"][0]["material"] = json!(0);
        asset.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(uvs);
        asset
    }

    pub(crate) fn text(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        if !self.bytes.is_empty() && json["buffers"].is_null() {
            let data = base64::engine::general_purpose::STANDARD.encode(&self.bytes);
            let uri = format!("data:application/octet-stream;base64,{data}");
            json["buffers"] = json!([{"byteLength": self.bytes.len(), "uri": uri}]);
        }
        serde_json::to_vec_pretty(&json).unwrap()
    }

    pub(crate) fn binary(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        if !self.bytes.is_empty() && json["buffers"].is_null() {
            json["buffers"] = json!([{"byteLength": self.bytes.len()}]);
        }
        let mut text = serde_json::to_vec(&json).unwrap();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut data = self.bytes.clone();
        data.resize(data.len().next_multiple_of(4), 0);
        let mut file = b"glTF\x02\0\0\0".to_vec();
        let number = |x: usize| (x as u32).to_le_bytes();
        file.extend(number(28 + text.len() + data.len()));
        for (chunk, kind) in [(&text, b"JSON"), (&data, b"BIN\0")] {
            file.extend(number(chunk.len()));
            file.extend(kind);
            file.extend(chunk);
        }
        file
    }

    pub(crate) fn read(&self) -> Scene {
        parse_gltf(&self.text(), "a.gltf").unwrap_or_else(|error| panic!("{error}\n{:#}", self.json))
    }

    pub(crate) fn error(&self) -> String {
        match parse_gltf(&self.binary(), "a.glb") {
            Ok(_) => panic!("no error\n{:#}", self.json),
            Err(error) => error.to_string(),
        }
    }

    /// Warnings, but for those of cameras and darkness.
    pub(crate) fn warnings(&self) -> Vec<String> {
        let expected = ["no camera", "nothing emits light"];
        let warnings = self.read().warnings.into_iter().map(|message| message.to_string());
        warnings.filter(|text| !expected.iter().any(|expected| text.contains(expected))).collect()
    }
}
