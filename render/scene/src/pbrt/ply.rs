//! Reads the points and faces of PLY mesh files, ASCII or binary, and checks every count against the size of the file.

use crate::message::shortened;

/// The contents of a mesh file.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Mesh {
    /// Vertices in the order of the file; numbers may be NaN or infinite.
    pub(super) points: Vec<[f64; 3]>,
    /// Normals of any length, one for each vertex or none.
    pub(super) normals: Vec<[f64; 3]>,
    /// Texture coordinates, one for each vertex or none.
    pub(super) uvs: Vec<[f64; 2]>,
    /// Triangles and quads in the order of the file.
    pub(super) faces: Vec<Face>,
    /// Warnings about ignored parts of the file.
    pub(super) warnings: Vec<String>,
}

/// A triangle or a quad, by the indices of its vertices in cyclic order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Face {
    Triangle([u32; 3]),
    Quad([u32; 4]),
}

#[derive(Clone, Copy, PartialEq)]
enum Format {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// The types of numbers by their names.
macro_rules! kinds {
    ($($kind:ident $type:ident $name:literal $other:literal),*) => {
        /// The type of a number.
        #[derive(Clone, Copy, PartialEq)]
        enum Kind {
            $($kind),*
        }
        impl Kind {
            fn named(word: &str) -> Option<Self> {
                match word {
                    $($name | $other => Some(Self::$kind),)*
                    _ => None,
                }
            }
            /// Takes a number from the beginning of bytes, if they have it.
            fn take(self, bytes: &mut &[u8], is_big: bool) -> Option<f64> {
                match self {
                    $(Self::$kind => {
                        let (first, rest) = bytes.split_first_chunk()?;
                        *bytes = rest;
                        Some(if is_big { $type::from_be_bytes(*first) } else { $type::from_le_bytes(*first) }.into())
                    })*
                }
            }
            /// The number that a word means, if it is one of this type.
            fn parse(self, word: &str) -> Option<f64> {
                let number = match self {
                    $(Self::$kind => f64::from(word.parse::<$type>().ok()?),)*
                };
                (!number.is_nan()).then_some(number)
            }
        }
    };
}

kinds!(
    I8 i8 "char" "int8", U8 u8 "uchar" "uint8", I16 i16 "short" "int16", U16 u16 "ushort" "uint16", I32 i32 "int" "int32",
    U32 u32 "uint" "uint32", F32 f32 "float" "float32", F64 f64 "double" "float64"
);

/// A number of each row of an element, or a list of numbers after their count.
struct Property {
    name: String,
    count: Option<Kind>,
    kind: Kind,
}

struct Element {
    name: String,
    count: usize,
    properties: Vec<Property>,
}

impl Element {
    /// The place of the first property that has one of these names.
    fn place(&self, names: &[&str]) -> Option<usize> {
        self.properties.iter().position(|property| names.contains(&property.name.as_str()))
    }
    /// The places of numbers, if the rows have all of them.
    fn places<const N: usize>(&self, names: [&[&str]; N]) -> Option<[usize; N]> {
        let mut places = [0; N];
        for (place, names) in places.iter_mut().zip(names) {
            *place = self.place(names).filter(|&k| self.properties[k].count.is_none())?;
        }
        Some(places)
    }
}

/// Reads a file that messages call `name`. An error starts with `name:line:` or `name: byte n:`.
///
/// Rows of ASCII files are lines, so that messages can tell which one is wrong. If they are not, numbers are taken as they come, as pbrt
/// does, if that takes all of them.
pub(super) fn read(name: &str, bytes: &[u8]) -> Result<Mesh, String> {
    let (elements, body) = header(name, bytes)?;
    let is_ascii = body.format == Format::Ascii;
    let unlined = is_ascii.then(|| Body { is_lined: false, ..body.clone() });
    read_body(&elements, body).map(|(mesh, _)| mesh).or_else(|wrong| {
        let mesh = unlined.and_then(|body| read_body(&elements, body).ok()).filter(|(_, is_whole)| *is_whole);
        mesh.map(|(mesh, _)| mesh).ok_or(wrong)
    })
}

/// Reads the elements, and tells whether nothing follows them.
fn read_body(elements: &[Element], mut body: Body<'_>) -> Result<(Mesh, bool), String> {
    let name = body.name;
    let wrong = |why: String| format!("{name}: header: {why}");
    check(elements, body.rest.len()).map_err(wrong)?;
    let of = |wanted: &str| elements.iter().find(|element| element.name == wanted);
    let vertices = of("vertex").ok_or_else(|| wrong("no element \"vertex\"".into()))?;
    for axis in ["x", "y", "z"] {
        let missing = || wrong(format!("element \"vertex\" needs a scalar property {axis:?}"));
        vertices.places([&[axis]]).ok_or_else(missing)?;
    }
    of("face").ok_or_else(|| wrong("no element \"face\"".into()))?;

    let mut mesh = Mesh::default();
    for element in elements {
        match element.name.as_str() {
            "vertex" => read_vertices(&mut mesh, element, &mut body)?,
            "face" => read_faces(&mut mesh, element, vertices.count, &mut body)?,
            _ => {
                (0..element.count).try_for_each(|_| body.row(element))?;
                mesh.warnings.push(format!("{name}: element {:?} ignored", element.name));
            }
        }
    }
    let is_whole = body.rest.iter().all(u8::is_ascii_whitespace);
    if !is_whole {
        mesh.warnings.push(format!("{name}: {} bytes after the last element ignored", body.rest.len()));
    }
    Ok((mesh, is_whole))
}

fn read_vertices(mesh: &mut Mesh, element: &Element, body: &mut Body<'_>) -> Result<(), String> {
    let points = element.places([&["x"], &["y"], &["z"]]).unwrap_or_default();
    let normals = element.places([&["nx"], &["ny"], &["nz"]]);
    let uvs = element.places([&["u", "s", "texture_u", "texture_s"], &["v", "t", "texture_v", "texture_t"]]);
    mesh.points.reserve(element.count);
    for _ in 0..element.count {
        body.row(element)?;
        mesh.points.push(points.map(|k| body.number(k)));
        mesh.normals.extend(normals.map(|places| places.map(|k| body.number(k))));
        mesh.uvs.extend(uvs.map(|places| places.map(|k| body.number(k))));
    }
    Ok(())
}

fn read_faces(mesh: &mut Mesh, element: &Element, vertices: usize, body: &mut Body<'_>) -> Result<(), String> {
    let is_list = |property: &&Property| property.name == "vertex_indices" || property.name == "vertex_index";
    let mut lists = element.properties.iter().filter(is_list);
    let (Some(Property { name, count: Some(_), kind }), None) = (lists.next(), lists.next()) else {
        return Err(format!("{}: header: {INDICES}", body.name));
    };
    if matches!(kind, Kind::F32 | Kind::F64) {
        return Err(format!("{}: header: {INDICES}", body.name));
    }
    let list = element.place(&[name]).unwrap_or_default();
    let mut others: Option<(usize, usize)> = None;
    let mut count = 0;
    mesh.faces.reserve(element.count);
    for face in 0..element.count {
        body.row(element)?;
        let index = |x: f64| {
            let index = if x >= 0.0 && x < vertices as f64 { Some(x as u32) } else { None };
            let why = || format!("face {face}: index {x} is out of range: there are {vertices} vertices");
            index.ok_or_else(|| format!("{}: {}", body.name, why()))
        };
        match *body.list(list) {
            [a, b, c] => mesh.faces.push(Face::Triangle([index(a)?, index(b)?, index(c)?])),
            [a, b, c, d] => mesh.faces.push(Face::Quad([index(a)?, index(b)?, index(c)?, index(d)?])),
            ref other => {
                count += 1;
                others.get_or_insert((face, other.len()));
            }
        }
    }
    if let Some((face, corners)) = others {
        mesh.warnings.push(format!(
            "{}: face {face} has {corners} corners: {count} face(s) of other than 3 or 4 are left out, as in pbrt",
            body.name
        ));
    }
    Ok(())
}

const INDICES: &str = "element \"face\" needs one list of integers, \"vertex_indices\"";

/// What follows the header.
#[derive(Clone)]
struct Body<'a> {
    name: &'a str,
    format: Format,
    /// Whether each row of an ASCII file is a line.
    is_lined: bool,
    /// Size of the file in bytes.
    size: usize,
    rest: &'a [u8],
    /// Number of lines that have been read.
    line: usize,
    /// The numbers of the last row, and for each property the place of its first one.
    numbers: Vec<f64>,
    starts: Vec<usize>,
}

impl Body<'_> {
    fn number(&self, property: usize) -> f64 {
        self.numbers[self.starts[property]]
    }
    fn list(&self, property: usize) -> &[f64] {
        let end = self.starts.get(property + 1).copied().unwrap_or(self.numbers.len());
        &self.numbers[self.starts[property]..end]
    }
    /// Reads a row of an element.
    fn row(&mut self, element: &Element) -> Result<(), String> {
        self.numbers.clear();
        self.starts.clear();
        if self.format == Format::Ascii {
            return if self.is_lined { self.line_of(element) } else { self.words_of(element).ok_or_else(String::new) };
        }
        let (is_big, mut rest) = (self.format == Format::BigEndian, self.rest);
        let (name, size) = (self.name, self.size);
        let ended = || format!("{name}: byte {size}: the file ends within element {:?}", element.name);
        self.take(element, |kind| kind.take(&mut rest, is_big).ok_or_else(ended))?;
        self.rest = rest;
        Ok(())
    }
    /// Takes the numbers of a row one after the other.
    fn take<E>(&mut self, element: &Element, mut next: impl FnMut(Kind) -> Result<f64, E>) -> Result<(), E> {
        for property in &element.properties {
            self.starts.push(self.numbers.len());
            let count = property.count.map_or(Ok(1.0), &mut next)?;
            for _ in 0..count as usize {
                self.numbers.push(next(property.kind)?);
            }
        }
        Ok(())
    }
    /// Reads a row from the next words, wherever lines end.
    fn words_of(&mut self, element: &Element) -> Option<()> {
        let mut rest = self.rest;
        let mut word = |kind: Kind| {
            let start = rest.iter().position(|b| !b.is_ascii_whitespace())?;
            let after = &rest[start..];
            let end = after.iter().position(u8::is_ascii_whitespace).unwrap_or(after.len());
            rest = &after[end..];
            kind.parse(std::str::from_utf8(&after[..end]).ok()?)
        };
        self.take(element, |kind| word(kind).ok_or(())).ok()?;
        self.rest = rest;
        Some(())
    }
    /// Reads a row from a line.
    fn line_of(&mut self, element: &Element) -> Result<(), String> {
        let (line, rest) = split_line(self.rest);
        (self.line, self.rest) = (self.line + 1, rest.unwrap_or_default());
        let place = format!("{}:{}:", self.name, self.line);
        if rest.is_none() && line.is_empty() {
            return Err(format!("{place} the file ends within element {:?}", element.name));
        }
        let text = String::from_utf8_lossy(line);
        let wrong = |why: &str| format!("{place} element {:?}: {:?}: {why}", element.name, shortened(text.trim()));
        let mut words = text.split_ascii_whitespace();
        self.take(element, |kind| {
            let word = words.next().ok_or_else(|| wrong("fewer numbers than declared"))?;
            kind.parse(word).ok_or_else(|| wrong("not a number of the declared type"))
        })?;
        if words.next().is_some() { Err(wrong("more numbers than declared")) } else { Ok(()) }
    }
}

/// The first line, and what follows its end if it has one.
fn split_line(bytes: &[u8]) -> (&[u8], Option<&[u8]>) {
    match bytes.iter().position(|&b| b == b'\n') {
        Some(end) => (&bytes[..end], Some(&bytes[end + 1..])),
        None => (bytes, None),
    }
}

/// Reads the header; returns what follows it, too.
fn header<'a>(name: &'a str, bytes: &'a [u8]) -> Result<(Vec<Element>, Body<'a>), String> {
    let (mut format, mut elements): (_, Vec<Element>) = (None, Vec::new());
    let (mut rest, mut number) = (bytes, 0);
    loop {
        let (line, after) = split_line(rest);
        number += 1;
        let text = String::from_utf8_lossy(&line[..line.len().min(240)]);
        let wrong = |why: &str| Err(format!("{name}:{number}: the header: {:?}: {why}", shortened(text.trim())));
        if number == 1 && !line.is_empty() && text.trim_end() != "ply" {
            return wrong("a PLY file starts with the line \"ply\"");
        }
        let Some(after) = after else {
            let why = "the file ends within the header: the line \"end_header\" is missing";
            return Err(format!("{name}:{number}: {why}"));
        };
        rest = after;
        let words: Vec<&str> = text.split_ascii_whitespace().collect();
        match words[..] {
            ["ply"] if number == 1 => {}
            ["ply"] => return wrong("a second line \"ply\""),
            [] | ["comment" | "obj_info", ..] => {}
            ["format", kind, version] => {
                let known = match (kind, version) {
                    ("ascii", "1.0") => Some(Format::Ascii),
                    ("binary_little_endian", "1.0") => Some(Format::LittleEndian),
                    ("binary_big_endian", "1.0") => Some(Format::BigEndian),
                    _ => None,
                };
                if format.is_some() && format != known {
                    return wrong("contradicts an earlier line \"format\"");
                }
                format = known;
            }
            ["element", of, count] if elements.iter().all(|element| element.name != of) => match count.parse() {
                Ok(count) => elements.push(Element { name: of.to_owned(), count, properties: Vec::new() }),
                Err(_) => return wrong("no number of elements"),
            },
            ["property", "list", _, _, of] | ["property", _, of] => {
                let Some(element) = elements.last_mut() else {
                    return wrong("no line \"element\" precedes this property");
                };
                if element.place(&[of]).is_some() {
                    return wrong("declared twice");
                }
                let count = (words.len() == 5)
                    .then(|| Kind::named(words[2]).filter(|kind| !matches!(kind, Kind::F32 | Kind::F64)));
                let (Some(kind), None | Some(Some(_))) = (Kind::named(words[words.len() - 2]), count) else {
                    return wrong("not a type of numbers");
                };
                element.properties.push(Property { name: of.to_owned(), count: count.flatten(), kind });
            }
            ["element", ..] if words.len() == 3 => return wrong("declared twice"),
            ["end_header"] => break,
            _ => return wrong("not a valid line of a header, which ends with \"end_header\""),
        }
    }
    let unknown = "the header has no valid line \"format\", such as \"format ascii 1.0\"";
    let format = format.ok_or_else(|| format!("{name}: {unknown}"))?;
    let (numbers, starts) = (Vec::new(), Vec::new());
    Ok((elements, Body { name, format, is_lined: true, size: bytes.len(), rest, line: number, numbers, starts }))
}

/// Rejects elements without properties, and counts that do not fit into the file.
fn check(elements: &[Element], body: usize) -> Result<(), String> {
    for Element { name, count, properties } in elements {
        // the fewest bytes of an element; a face needs at least three indices
        let least = if name == "face" { 4 } else { properties.len() };
        if least == 0 {
            return Err(format!("element {name:?} has no properties"));
        }
        if count.checked_mul(least).is_none_or(|needed| needed > body) {
            return Err(format!("{count} elements {name:?} do not fit into the {body} bytes that follow"));
        }
    }
    Ok(())
}
