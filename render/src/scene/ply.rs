//! Reads the points and faces of PLY mesh files, ASCII or binary, and checks every count against the size of the file.

use super::lexer::shortened;
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType, ScalarType,
};
use std::io::ErrorKind;

/// The contents of a mesh file.
#[derive(Debug)]
pub(super) struct Mesh {
    /// Vertices in the order of the file; coordinates may be NaN or infinite.
    pub(super) points: Vec<[f64; 3]>,
    /// Faces in the order of the file, with unchecked indices.
    pub(super) faces: Vec<Face>,
    /// Normals of the vertices, of any length; none if the file has none.
    pub(super) normals: Vec<[f64; 3]>,
    /// Texture coordinates of the vertices; none if the file has none.
    pub(super) uvs: Vec<[f64; 2]>,
    /// Warnings about ignored parts of the file.
    pub(super) warnings: Vec<String>,
}

/// A triangle or a quad.
#[derive(Debug)]
pub(super) struct Face {
    /// Vertex indices in cyclic order; a triangle leaves the last one unused.
    pub(super) indices: [i64; 4],
    /// Number of corners, 3 or 4.
    pub(super) corners: usize,
}

/// The first N of the numbers of a vertex: a point, a normal and texture coordinates.
struct Vertex<const N: usize>([f64; N]);

/// Names of the numbers of a vertex. Texture coordinates have several.
const NUMBERS: [&[&str]; 8] = [
    &["x"],
    &["y"],
    &["z"],
    &["nx"],
    &["ny"],
    &["nz"],
    &["u", "s", "texture_u", "texture_s"],
    &["v", "t", "texture_v", "texture_t"],
];

struct Other;

impl<const N: usize> PropertyAccess for Vertex<N> {
    fn new() -> Self {
        Vertex([f64::NAN; N])
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        let Some(axis) = NUMBERS[..N].iter().position(|names| names.contains(&name)) else {
            return PropertyAccessResult::Ignored;
        };
        self.0[axis] = match value {
            Property::Char(x) => x.into(),
            Property::UChar(x) => x.into(),
            Property::Short(x) => x.into(),
            Property::UShort(x) => x.into(),
            Property::Int(x) => x.into(),
            Property::UInt(x) => x.into(),
            Property::Float(x) => x.into(),
            Property::Double(x) => x,
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Face { indices: [-1; 4], corners: 0 }
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        if !is_index_list(name) {
            return PropertyAccessResult::Ignored;
        }
        match value {
            Property::ListChar(list) => self.fill(&list),
            Property::ListUChar(list) => self.fill(&list),
            Property::ListShort(list) => self.fill(&list),
            Property::ListUShort(list) => self.fill(&list),
            Property::ListInt(list) => self.fill(&list),
            Property::ListUInt(list) => self.fill(&list),
            _ => return PropertyAccessResult::UnsupportedType,
        }
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Other {
    fn new() -> Self {
        Other
    }
}

impl Face {
    fn fill<T: Copy + Into<i64>>(&mut self, list: &[T]) {
        self.corners = list.len();
        self.indices.iter_mut().zip(list).for_each(|(to, &from)| *to = from.into());
    }
}

fn is_index_list(name: &str) -> bool {
    name == "vertex_indices" || name == "vertex_index"
}

/// Reads a file that messages call `name`. An error starts with `name:line:` or `name: byte n:`.
pub(super) fn read(name: &str, bytes: &[u8]) -> Result<Mesh, String> {
    let mut reader = Reader::new(bytes);
    let header = Parser::<Other>::new().read_header(&mut reader);
    let header = header.map_err(|error| describe_header(name, bytes, &error))?;
    check_header(&header, bytes, reader.get_ref().len()).map_err(|why| format!("{name}: header: {why}"))?;

    let mut mesh =
        Mesh { points: Vec::new(), faces: Vec::new(), normals: Vec::new(), uvs: Vec::new(), warnings: Vec::new() };
    for (element, def) in &header.elements {
        match element.as_str() {
            "vertex" => {
                let has = |k: usize| NUMBERS[k].iter().any(|name| def.properties.contains_key(*name));
                let [has_normals, has_uvs] = [has(3) && has(4) && has(5), has(6) && has(7)];
                if !has_normals && !has_uvs {
                    let vertices = vertices::<3>(name, bytes, &mut reader, def, &header)?;
                    mesh.points = vertices.into_iter().map(|vertex| vertex.0).collect();
                    continue;
                }
                let vertices = vertices::<8>(name, bytes, &mut reader, def, &header)?;
                mesh.points = vertices.iter().map(|Vertex([x, y, z, ..])| [*x, *y, *z]).collect();
                if has_normals {
                    mesh.normals = vertices.iter().map(|Vertex([_, _, _, x, y, z, ..])| [*x, *y, *z]).collect();
                }
                if has_uvs {
                    mesh.uvs = vertices.iter().map(|Vertex([.., u, v])| [*u, *v]).collect();
                }
            }
            "face" => match plain_faces(def, &header, reader.get_ref()) {
                Some((faces, rest)) => (mesh.faces, reader) = (faces, Reader::new(rest)),
                None => mesh.faces = read_element::<Face>(name, bytes, &mut reader, def, &header)?,
            },
            _ => {
                read_element::<Other>(name, bytes, &mut reader, def, &header)?;
                mesh.warnings.push(format!("{name}: element {element:?} ignored"));
            }
        }
    }
    if let Some(i) = mesh.faces.iter().position(|face| !(3..=4).contains(&face.corners)) {
        let (corners, before) = (mesh.faces[i].corners, mesh.faces.len());
        mesh.faces.retain(|face| (3..=4).contains(&face.corners));
        let count = before - mesh.faces.len();
        mesh.warnings.push(format!(
            "{name}: face {i} has {corners} corners: {count} face(s) of other than 3 or 4 are left out, as in pbrt"
        ));
    }
    let rest = *reader.get_ref();
    if !rest.iter().all(u8::is_ascii_whitespace) {
        mesh.warnings.push(format!("{name}: {} bytes after the last element ignored", rest.len()));
    }
    Ok(mesh)
}

/// The vertices of a binary file whose numbers are all in single precision, as most files have them, and the bytes after them. The reader
/// for any layout takes several times as long.
fn plain_vertices<'a, const N: usize>(
    def: &ElementDef,
    header: &Header,
    bytes: &'a [u8],
) -> Option<(Vec<Vertex<N>>, &'a [u8])> {
    let is_plain = def.properties.values().all(|of| of.data_type == PropertyType::Scalar(ScalarType::Float));
    if header.encoding != Encoding::BinaryLittleEndian || !is_plain {
        return None;
    }
    let names: Vec<&str> = def.properties.keys().map(String::as_str).collect();
    // a later name of the same number counts
    let place = |k: usize| names.iter().rposition(|name| NUMBERS[k].contains(name));
    let places: [Option<usize>; N] = std::array::from_fn(place);
    let size = 4 * names.len();
    let (own, rest) = bytes.split_at_checked(def.count.checked_mul(size)?)?;
    let number = |row: &[u8], k: usize| {
        let bytes = row[4 * k..].first_chunk().copied().unwrap_or_default();
        f64::from(f32::from_le_bytes(bytes))
    };
    let vertex = |row: &[u8]| Vertex(places.map(|place| place.map_or(f64::NAN, |k| number(row, k))));
    Some((own.chunks_exact(size).map(vertex).collect(), rest))
}

/// The faces of a binary file that consist of one list of 32-bit indices each, and the bytes after them.
fn plain_faces<'a>(def: &ElementDef, header: &Header, mut bytes: &'a [u8]) -> Option<(Vec<Face>, &'a [u8])> {
    let mut types = def.properties.values().map(|of| &of.data_type);
    let (Some(PropertyType::List(counts, item)), None) = (types.next(), types.next()) else { return None };
    let is_plain = *counts == ScalarType::UChar && matches!(item, ScalarType::Int | ScalarType::UInt);
    if header.encoding != Encoding::BinaryLittleEndian || !is_plain {
        return None;
    }
    let is_signed = *item == ScalarType::Int;
    let mut faces = Vec::with_capacity(def.count);
    for _ in 0..def.count {
        let (&count, rest) = bytes.split_first()?;
        let corners = usize::from(count);
        let (list, rest) = rest.split_at_checked(4 * corners)?;
        let mut face = Face { indices: [-1; 4], corners };
        for (to, from) in face.indices.iter_mut().zip(list.chunks_exact(4)) {
            let index = u32::from_le_bytes(from.first_chunk().copied().unwrap_or_default());
            *to = if is_signed { i64::from(index as i32) } else { i64::from(index) };
        }
        faces.push(face);
        bytes = rest;
    }
    Some((faces, bytes))
}

/// Reads vertices of any layout.
fn vertices<const N: usize>(
    name: &str,
    bytes: &[u8],
    reader: &mut Reader<&[u8]>,
    def: &ElementDef,
    header: &Header,
) -> Result<Vec<Vertex<N>>, String> {
    match plain_vertices(def, header, reader.get_ref()) {
        Some((vertices, rest)) => {
            *reader = Reader::new(rest);
            Ok(vertices)
        }
        None => read_element(name, bytes, reader, def, header),
    }
}

fn read_element<E: PropertyAccess>(
    name: &str,
    bytes: &[u8],
    reader: &mut Reader<&[u8]>,
    def: &ElementDef,
    header: &Header,
) -> Result<Vec<E>, String> {
    let elements = Parser::<E>::new().read_payload_for_element(reader, def, header);
    elements.map_err(|error| {
        let byte = (header.encoding != Encoding::Ascii).then(|| bytes.len() - reader.get_ref().len());
        let text = match error.line() {
            Some(_) => describe(name, bytes, &error, byte, &format!("element {:?}", def.name)),
            // the line is not UTF-8
            None => format!("{name}:{}: {error}", reader.line()),
        };
        shortened_lines(&text)
    })
}

/// Rejects what the crate accepts: repeated names, elements without properties, and counts that do not fit into the file.
fn check_header(header: &Header, bytes: &[u8], body: usize) -> Result<(), String> {
    // the crate keeps only one of two equal names, and would then read the body in the wrong layout
    let text = &bytes[..bytes.len() - body];
    let declared = text.split(|&b| b == b'\n').filter(|l| l.starts_with(b"element") || l.starts_with(b"property"));
    let kept: usize = header.elements.values().map(|def| 1 + def.properties.len()).sum();
    if declared.count() != kept {
        return Err("an element or a property is declared twice".into());
    }
    for (name, def) in &header.elements {
        // the fewest bytes of an element; a face needs at least three indices
        let least = if name == "face" { 4 } else { def.properties.len() };
        if least == 0 {
            return Err(format!("element {name:?} has no properties"));
        }
        if def.count.checked_mul(least).is_none_or(|needed| needed > body) {
            return Err(format!("{} elements {name:?} do not fit into the {body} bytes that follow", def.count));
        }
    }
    let vertex = header.elements.get("vertex").ok_or("no element \"vertex\"")?;
    for axis in ["x", "y", "z"] {
        match vertex.properties.get(axis).map(|def| &def.data_type) {
            Some(PropertyType::Scalar(_)) => {}
            _ => return Err(format!("element \"vertex\" needs a scalar property {axis:?}")),
        }
    }
    let face = header.elements.get("face").ok_or("no element \"face\"")?;
    let lists = face.properties.values().filter(|def| is_index_list(&def.name));
    let mut types = lists.map(|def| &def.data_type);
    match (types.next(), types.next()) {
        (Some(PropertyType::List(_, item)), None) if !matches!(item, ScalarType::Float | ScalarType::Double) => Ok(()),
        _ => Err("element \"face\" needs one list of integers, \"vertex_indices\"".into()),
    }
}

/// Why the header cannot be read, in a one-line message that starts with the file and the line.
fn describe_header(name: &str, bytes: &[u8], error: &ParseError) -> String {
    let line = error.line().unwrap_or(1);
    let text = bytes.split(|&b| b == b'\n').nth(line - 1).unwrap_or_default();
    let is_last = bytes.iter().filter(|&&b| b == b'\n').count() < line;
    let shown = shortened(String::from_utf8_lossy(&text[..text.len().min(240)]).trim());
    let full = error.to_string();
    if line == 1 && error.line().is_some() {
        format!("{name}:1: the header: {shown:?}: a PLY file starts with the line \"ply\"")
    } else if error.kind() == ErrorKind::InvalidData {
        format!("{name}: the header is not UTF-8")
    } else if error.line().is_none() && error.kind() == ErrorKind::InvalidInput {
        // a whole header, except for one line
        format!("{name}: the header has no valid line \"format\", such as \"format ascii 1.0\"")
    } else if is_last || error.kind() == ErrorKind::UnexpectedEof {
        format!("{name}:{line}: the file ends within the header: the line \"end_header\" is missing")
    } else if let Some(what) = full.split_once("Unexpected 'ply'").map(|_| "a second line \"ply\"") {
        format!("{name}:{line}: the header: {shown:?}: {what}")
    } else if full.contains("contradicting") {
        format!("{name}:{line}: the header: {shown:?}: contradicts an earlier line \"format\"")
    } else if full.contains("without preceding") {
        format!("{name}:{line}: the header: {shown:?}: no line \"element\" precedes this property")
    } else {
        format!("{name}:{line}: the header: {shown:?}: not a valid line of a header, which ends with \"end_header\"")
    }
}

/// Why an element cannot be read, in a one-line message with the file, the line or byte, and the text of that line.
fn describe(name: &str, bytes: &[u8], error: &ParseError, byte: Option<usize>, what: &str) -> String {
    let full = error.to_string();
    let reason = match full.rsplit("Error: ").next().unwrap_or(&full) {
        // the crate shows its grammar, or "ParseFloatError { kind: Invalid }"
        rust if rust.contains('{') || rust.starts_with("error at") => "not a number of the declared type",
        reason => reason,
    };
    let line = error.line().unwrap_or(1);
    let ended = error.kind() == ErrorKind::UnexpectedEof;
    match byte {
        Some(byte) if ended => format!("{name}: byte {byte}: the file ends within {what}"),
        Some(byte) => format!("{name}: byte {byte}: {what}: {}", shortened_lines(reason)),
        None if ended => format!("{name}:{line}: the file ends within {what}"),
        None => {
            let text = bytes.split(|&b| b == b'\n').nth(line - 1).unwrap_or_default();
            let text = shortened(String::from_utf8_lossy(&text[..text.len().min(240)]).trim());
            format!("{name}:{line}: {what}: {text:?}: {}", shortened_lines(reason))
        }
    }
}

/// `text` on one line and cut to 300 characters.
fn shortened_lines(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ").chars().take(300).collect()
}
