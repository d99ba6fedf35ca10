//! Takes glTF files apart: the JSON text and the binary chunk.

use gltf_json::Root;
use serde_json::Value;

/// The first bytes of a binary file.
pub(super) const MAGIC: &[u8] = b"glTF";

/// The JSON text of a file, and the binary chunk, if it has one.
pub(super) fn split(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), String> {
    if !bytes.starts_with(MAGIC) {
        // some editors write a byte order mark
        return Ok((bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), None));
    }
    let number = |at: usize| {
        let four = bytes.get(at..at + 4).and_then(|four| four.try_into().ok());
        four.map(u32::from_le_bytes).ok_or_else(|| format!("truncated: the file ends at byte {}", bytes.len()))
    };
    let version = number(4)?;
    if version != 2 {
        return Err(format!("a binary glTF file of version {version}: only 2 is supported"));
    }
    let length = number(8)? as usize;
    if length > bytes.len() {
        return Err(format!("truncated: {} of {length} bytes", bytes.len()));
    }
    let chunk = |at: usize, name: &str| {
        let (size, kind) = (number(at)? as usize, number(at + 4)?);
        let end = (at + 8).checked_add(size).filter(|&end| end <= length);
        let end = end.ok_or_else(|| format!("the {name} chunk of {size} bytes does not fit into {length} bytes"))?;
        Ok::<_, String>((kind.to_le_bytes(), &bytes[at + 8..end], end))
    };
    let (kind, json, mut at) = chunk(12, "first")?;
    if &kind != b"JSON" {
        return Err(format!("the first chunk is {:?}, not \"JSON\"", String::from_utf8_lossy(&kind)));
    }
    // chunks of other kinds are allowed
    while at + 8 <= length {
        let (kind, data, end) = chunk(at, "next")?;
        if &kind == b"BIN\0" {
            return Ok((json, Some(data)));
        }
        at = end;
    }
    Ok((json, None))
}

/// Reads the JSON text; an error comes with its line.
pub(super) fn parse(json: &[u8]) -> Result<Root, (usize, String)> {
    let version_of = || {
        let value: serde_json::Value = serde_json::from_slice(json).ok()?;
        Some(value.get("asset")?.get("version")?.as_str()?.to_owned())
    };
    let unsupported = |version: &str| (0, format!("glTF of version {version:?}: only 2 is supported"));
    let is_two = |version: &str| version.split('.').next() == Some("2");
    // not a generic function of serde_json, which would compile the whole reader a second time, in this crate
    let read = Root::from_slice(json);
    match read.or_else(|error| lenient(json).ok_or(error)) {
        Ok(root) if is_two(&root.asset.version) => Ok(root),
        Ok(root) => Err(unsupported(&root.asset.version)),
        Err(error) => Err(match version_of().filter(|version| !is_two(version)) {
            Some(version) => unsupported(&version),
            None => {
                let text = error.to_string();
                // the message has the line of its own
                let text = text.rsplit_once(" at line ").map_or(&*text, |(text, _)| text);
                (error.line(), format!("not glTF: {text} (column {})", error.column()))
            }
        }),
    }
}

/// Reads JSON that the reader takes for invalid though it is not: a scene without nodes, an animation of no node, whole numbers with a
/// fraction of zeros.
fn lenient(json: &[u8]) -> Option<Root> {
    let mut value: Value = serde_json::from_slice(json).ok()?;
    value.as_object_mut()?.remove("animations");
    for scene in value.get_mut("scenes").and_then(Value::as_array_mut).into_iter().flatten() {
        scene.as_object_mut()?.entry("nodes").or_insert_with(|| Value::Array(Vec::new()));
    }
    let mut rest = vec![&mut value];
    while let Some(value) = rest.pop() {
        match value {
            Value::Array(list) => rest.extend(list),
            Value::Object(map) => rest.extend(map.values_mut()),
            Value::Number(number) => {
                let whole = number.as_f64().filter(|x| number.is_f64() && x.fract() == 0.0 && (0.0..=9e15).contains(x));
                if let Some(x) = whole {
                    *value = Value::from(x as u64);
                }
            }
            _ => {}
        }
    }
    // as text, for the same reader
    Root::from_slice(&serde_json::to_vec(&value).ok()?).ok()
}
