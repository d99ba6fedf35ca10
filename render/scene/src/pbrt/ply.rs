//! Reads the points and faces of PLY mesh files, ASCII or binary, and checks every count against the size of the file.

use crate::message::shortened;
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType, ScalarType,
};
use std::io::ErrorKind;

/// The contents of a mesh file.
#[derive(Debug)]
pub(super) struct Mesh<'a> {
    /// Vertices in the order of the file; numbers may be NaN or infinite.
    pub(super) vertices: Vertices<'a>,
    /// Whether the vertices have normals, of any length.
    pub(super) has_normals: bool,
    /// Whether the vertices have texture coordinates.
    pub(super) has_uvs: bool,
    /// Triangles and quads in the order of the file, with unchecked indices.
    pub(super) faces: Faces<'a>,
    /// Warnings about ignored parts of the file.
    pub(super) warnings: Vec<String>,
}

/// The numbers of vertices: a point, a normal and texture coordinates. Those that the file lacks are NaN.
#[derive(Debug)]
pub(super) enum Vertices<'a> {
    /// Rows of a binary file, each of `size` bytes, and where in them each number is.
    Plain { bytes: &'a [u8], size: usize, places: [Option<Place>; 8] },
    /// Numbers that were read one by one.
    Read(Vec<Vertex>),
}

/// Where a number is in a row: the bytes before it, and its type.
type Place = (usize, ScalarType);

impl Vertices<'_> {
    /// Number of vertices.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Plain { bytes, size, .. } => bytes.len() / size,
            Self::Read(vertices) => vertices.len(),
        }
    }

    /// `N` numbers of each vertex, from number `first` on.
    pub(super) fn numbers<const N: usize>(&self, first: usize) -> impl ExactSizeIterator<Item = [f64; N]> + '_ {
        (0..self.len()).map(move |i| match self {
            Self::Plain { bytes, size, places } => {
                let row = &bytes[i * size..(i + 1) * size];
                std::array::from_fn(|k| places[first + k].as_ref().map_or(f64::NAN, |place| number(row, place)))
            }
            Self::Read(vertices) => std::array::from_fn(|k| vertices[i].0[first + k]),
        })
    }
}

/// The little-endian number at a place in a row.
#[inline(always)]
fn number(row: &[u8], &(start, ref of): &Place) -> f64 {
    macro_rules! read {
        ($type:ty) => {
            f64::from(<$type>::from_le_bytes(row[start..].first_chunk().copied().unwrap_or_default()))
        };
    }
    match of {
        ScalarType::Float => read!(f32),
        ScalarType::Double => read!(f64),
        ScalarType::Char => read!(i8),
        ScalarType::UChar => read!(u8),
        ScalarType::Short => read!(i16),
        ScalarType::UShort => read!(u16),
        ScalarType::Int => read!(i32),
        ScalarType::UInt => read!(u32),
    }
}

/// Bytes of a number.
fn size_of(of: &ScalarType) -> usize {
    match of {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    }
}

/// Triangles and quads.
#[derive(Debug)]
pub(super) enum Faces<'a> {
    /// This many lists of 32-bit indices in a binary file, each after its length in a byte.
    Plain { bytes: &'a [u8], count: usize, is_signed: bool },
    /// Faces that were read one by one.
    Read(Vec<Face>),
}

impl Faces<'_> {
    /// Number of faces.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Plain { count, .. } => *count,
            Self::Read(faces) => faces.len(),
        }
    }

    /// The faces, those of other than 3 or 4 corners, too.
    fn all(&self) -> impl Iterator<Item = Face> + '_ {
        let mut at = 0;
        (0..self.len()).map(move |i| match self {
            Self::Plain { bytes, is_signed, .. } => {
                let corners = usize::from(bytes[at]);
                let list = &bytes[at + 1..at + 1 + 4 * corners];
                at += 1 + 4 * corners;
                let mut indices = [-1; 4];
                for (to, from) in indices.iter_mut().zip(list.chunks_exact(4)) {
                    let index = u32::from_le_bytes(from.first_chunk().copied().unwrap_or_default());
                    *to = if *is_signed { i64::from(index as i32) } else { i64::from(index) };
                }
                Face { indices, corners }
            }
            Self::Read(faces) => faces[i],
        })
    }

    /// The triangles and quads, with their places among all faces.
    pub(super) fn iter(&self) -> impl Iterator<Item = (usize, Face)> + '_ {
        self.all().enumerate().filter(|(_, face)| face.is_supported())
    }
}

/// A triangle or a quad.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    /// Vertex indices in cyclic order; a triangle leaves the last one unused.
    pub(super) indices: [i64; 4],
    /// Number of corners, 3 or 4.
    pub(super) corners: usize,
}

/// The numbers of a vertex: a point, a normal and texture coordinates.
#[derive(Debug)]
pub(super) struct Vertex([f64; 8]);

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

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Vertex([f64::NAN; 8])
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        let Some(axis) = NUMBERS.iter().position(|names| names.contains(&name)) else {
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
    fn is_supported(&self) -> bool {
        (3..=4).contains(&self.corners)
    }

    fn fill<T: Copy + Into<i64>>(&mut self, list: &[T]) {
        self.corners = list.len();
        self.indices.iter_mut().zip(list).for_each(|(to, &from)| *to = from.into());
    }
}

fn is_index_list(name: &str) -> bool {
    name == "vertex_indices" || name == "vertex_index"
}

/// Reads a file that messages call `name`. An error starts with `name:line:` or `name: byte n:`.
pub(super) fn read<'a>(name: &str, bytes: &'a [u8]) -> Result<Mesh<'a>, String> {
    let mut reader = Reader::new(bytes);
    let header = Parser::<Other>::new().read_header(&mut reader);
    let header = header.map_err(|error| describe_header(name, bytes, &error))?;
    check_header(&header, bytes, reader.get_ref().len()).map_err(|why| format!("{name}: header: {why}"))?;

    let (none, no_faces) = (Vertices::Read(Vec::new()), Faces::Read(Vec::new()));
    let mut mesh = Mesh { vertices: none, has_normals: false, has_uvs: false, faces: no_faces, warnings: Vec::new() };
    for (element, def) in &header.elements {
        match element.as_str() {
            "vertex" => {
                let has = |k: usize| NUMBERS[k].iter().any(|name| def.properties.contains_key(*name));
                (mesh.has_normals, mesh.has_uvs) = (has(3) && has(4) && has(5), has(6) && has(7));
                match plain_vertices(def, &header, reader.get_ref()) {
                    Some((vertices, rest)) => (mesh.vertices, reader) = (vertices, Reader::new(rest)),
                    None => mesh.vertices = Vertices::Read(read_element(name, bytes, &mut reader, def, &header)?),
                }
            }
            "face" => match plain_faces(def, &header, reader.get_ref()) {
                Some((faces, rest)) => (mesh.faces, reader) = (faces, Reader::new(rest)),
                None => mesh.faces = Faces::Read(read_element(name, bytes, &mut reader, def, &header)?),
            },
            _ => {
                read_element::<Other>(name, bytes, &mut reader, def, &header)?;
                mesh.warnings.push(format!("{name}: element {element:?} ignored"));
            }
        }
    }
    let others = || mesh.faces.all().enumerate().filter(|(_, face)| !face.is_supported());
    if let Some((i, Face { corners, .. })) = others().next() {
        let count = others().count();
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

/// The vertices of a binary file that have no lists, as most files have them, and the bytes after them. The reader for any layout takes
/// several times as long.
fn plain_vertices<'a>(def: &ElementDef, header: &Header, bytes: &'a [u8]) -> Option<(Vertices<'a>, &'a [u8])> {
    if header.encoding != Encoding::BinaryLittleEndian {
        return None;
    }
    let (mut size, mut places) = (0, [const { None }; 8]);
    for (name, property) in &def.properties {
        let PropertyType::Scalar(of) = &property.data_type else { return None };
        // a later name of the same number counts
        if let Some(k) = NUMBERS.iter().position(|names| names.contains(&name.as_str())) {
            places[k] = Some((size, of.clone()));
        }
        size += size_of(of);
    }
    let (bytes, rest) = bytes.split_at_checked(def.count.checked_mul(size)?)?;
    Some((Vertices::Plain { bytes, size, places }, rest))
}

/// The faces of a binary file that consist of one list of 32-bit indices each, and the bytes after them.
fn plain_faces<'a>(def: &ElementDef, header: &Header, bytes: &'a [u8]) -> Option<(Faces<'a>, &'a [u8])> {
    let mut types = def.properties.values().map(|of| &of.data_type);
    let (Some(PropertyType::List(counts, item)), None) = (types.next(), types.next()) else { return None };
    let is_plain = *counts == ScalarType::UChar && matches!(item, ScalarType::Int | ScalarType::UInt);
    if header.encoding != Encoding::BinaryLittleEndian || !is_plain {
        return None;
    }
    let mut end = 0_usize;
    for _ in 0..def.count {
        end += 1 + 4 * usize::from(*bytes.get(end)?);
    }
    let (bytes, rest) = bytes.split_at_checked(end)?;
    Some((Faces::Plain { bytes, count: def.count, is_signed: *item == ScalarType::Int }, rest))
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
