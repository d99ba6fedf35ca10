//! EXR files as layers of named planes, with a text for the file and one for each layer.
//!
//! Layers may be of any part of the image. Each layer has a checksum for every sixteen rows, which are read and compressed together.

use super::size::believe;
use crate::area::Area;
use crate::files::{FileError, failed};
use exr::block::UncompressedBlock;
use exr::block::lines::LineIndex;
use exr::math::Vec2;
use exr::meta::attribute::{AttributeValue, IntegerBounds, SampleType, Text};
use exr::meta::header::Header;
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, ImageAttributes, Layer as ExrLayer,
    LayerAttributes, LineOrder, WritableImage,
};
use rayon::prelude::*;
use serde_json::{Value, json};
use std::fs::File;
use std::io::{self, BufReader, Cursor, Read, Seek};
use std::ops::Range;
use std::path::Path;
use xxhash_rust::xxh3::Xxh3;

/// Rows that are compressed together, and share a checksum.
const ROWS: u32 = 16;
/// Names of the texts in a file.
const FILE: &str = "etendue.frame";
const LAYER: &str = "etendue.part";

/// Numbers of a kind that EXR files hold, row by row.
#[derive(Clone, Debug, PartialEq)]
pub enum Numbers {
    /// Single-precision numbers.
    F32(Vec<f32>),
    /// Unsigned integers.
    U32(Vec<u32>),
}

impl Numbers {
    fn bits(&self, range: Range<usize>) -> Vec<u8> {
        match self {
            Self::F32(values) => values[range].iter().flat_map(|x| x.to_bits().to_le_bytes()).collect(),
            Self::U32(values) => values[range].iter().flat_map(|x| x.to_le_bytes()).collect(),
        }
    }
}

/// Numbers for the pixels of a rectangle of the image.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// The pixels [x0, y0, x1, y1).
    pub area: Area,
    /// Planes of numbers and their names, which differ.
    pub planes: Vec<(String, Numbers)>,
    /// Whatever else there is to say, as a JSON object.
    pub text: Value,
}

/// What the header of a file says of a layer.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerHeader {
    /// The pixels [x0, y0, x1, y1).
    pub area: Area,
    /// As in [`Layer`], with the checksums.
    pub text: Value,
    /// The names of its planes, in the order of the file.
    pub names: Vec<String>,
}

/// What the headers of a file say.
#[derive(Clone, Debug, PartialEq)]
pub struct Contents {
    /// The text of the file.
    pub text: Value,
    /// Its layers.
    pub layers: Vec<LayerHeader>,
}

/// What is wrong with a file that cannot be read, for a message.
pub(super) fn why(error: &exr::error::Error) -> String {
    use exr::error::Error;
    match error {
        // systems refuse to go to a place that no file has
        Error::Io(error) if error.kind() == io::ErrorKind::InvalidInput => OUTSIDE.to_owned(),
        Error::Invalid(what) if what == "reference to missing bytes" => OUTSIDE.to_owned(),
        other => other.to_string(),
    }
}

const OUTSIDE: &str = "it is cut off, or its table leads to a place outside of it";

/// One checksum for every sixteen rows.
fn checksums([x0, y0, x1, y1]: Area, planes: &[(String, Numbers)]) -> Vec<String> {
    let (across, rows) = ((x1 - x0) as usize, (y1 - y0) as usize);
    let bands = (0..rows).step_by(ROWS as usize).collect::<Vec<_>>().into_par_iter();
    let checksum = |row: usize| {
        let mut hash = Xxh3::new();
        for (_, numbers) in planes {
            hash.update(&numbers.bits(row * across..(row + ROWS as usize).min(rows) * across));
        }
        format!("{:016x}", hash.digest())
    };
    bands.map(checksum).collect()
}

/// A JSON text of the characters that EXR files may have.
fn latin(text: &Value) -> Text {
    let mut plain = String::new();
    for c in text.to_string().chars() {
        if c.is_ascii() {
            plain.push(c);
        } else {
            plain.extend(c.encode_utf16(&mut [0; 2]).iter().map(|unit| format!("\\u{unit:04x}")));
        }
    }
    Text::new_or_panic(plain)
}

/// The bytes of a file of layers of an image of this size; equal layers give equal bytes. Layers without a text have none, and no checksums,
/// in the file.
///
/// # Errors
/// Fails if the planes of a layer do not have its size.
pub fn encode(
    size: [u32; 2],
    text: &Value,
    layers: Vec<Layer>,
    compression: Compression,
) -> exr::error::Result<Vec<u8>> {
    let whole = size.map(|side| side as usize);
    let window = IntegerBounds { position: Vec2(0, 0), size: Vec2(whole[0], whole[1]) };
    let mut attributes = ImageAttributes::new(window);
    if !text.is_null() {
        attributes.other.insert(FILE.into(), AttributeValue::Text(latin(text)));
    }
    // increasing line order makes the bytes independent of the number of compressing threads
    let encoding = Encoding { compression, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    let several = layers.len() > 1;
    let encoded = layers.into_iter().enumerate().map(|(index, mut layer)| {
        let [x0, y0, x1, y1] = layer.area;
        let mut own = LayerAttributes { layer_position: Vec2(x0 as i32, y0 as i32), ..LayerAttributes::default() };
        if several {
            own.layer_name = Some(Text::new_or_panic(format!("part{index}")));
        }
        layer.planes.sort_by(|a, b| a.0.cmp(&b.0));
        if !layer.text.is_null() {
            layer.text["checksums"] = json!(checksums(layer.area, &layer.planes));
            own.other.insert(LAYER.into(), AttributeValue::Text(latin(&layer.text)));
        }
        let channels = layer.planes.into_iter().map(|(name, numbers)| {
            let samples = match numbers {
                Numbers::F32(values) => FlatSamples::F32(values),
                Numbers::U32(values) => FlatSamples::U32(values),
            };
            AnyChannel::new(name.as_str(), samples)
        });
        let size = ((x1 - x0) as usize, (y1 - y0) as usize);
        ExrLayer::new(size, own, encoding, AnyChannels::sort(channels.collect()))
    });
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layers(attributes, encoded.collect::<exr::image::Layers<_>>()).write().to_buffered(&mut bytes)?;
    Ok(bytes.into_inner())
}

/// A file whose headers have been read.
pub struct LayerFile<R> {
    path: std::path::PathBuf,
    source: R,
    headers: Vec<Header>,
    /// What the headers say.
    pub contents: Contents,
}

impl LayerFile<BufReader<File>> {
    /// Opens a file and reads its headers.
    ///
    /// # Errors
    /// Fails if the file cannot be read, or is not one that [`encode`] made.
    pub fn open(path: &Path) -> Result<Self, FileError> {
        let cannot = |error| failed(path, format!("cannot read: {error}"));
        let file = crate::files::open_file(path).map_err(cannot)?;
        let length = file.metadata().map_err(cannot)?.len();
        Self::new(path, BufReader::new(file), length)
    }
}

impl<R: Read + Seek> LayerFile<R> {
    /// Reads the headers from a source of `length` bytes that messages call `path`.
    ///
    /// # Errors
    /// Fails if the source is not a file that [`encode`] made.
    pub fn new(path: &Path, mut source: R, length: u64) -> Result<Self, FileError> {
        let not_one = |what: &dyn std::fmt::Display| failed(path, format!("not a part of an image: {what}"));
        let meta =
            exr::meta::MetaData::read_from_buffered(&mut source, false).map_err(|error| not_one(&why(&error)))?;
        let headers = meta.headers.to_vec();
        let text = |value: Option<&AttributeValue>, name: &str| -> Result<Value, FileError> {
            let Some(AttributeValue::Text(text)) = value else {
                return Err(not_one(&format!("it has no text {name:?}")));
            };
            let text = text.to_string();
            serde_json::from_str(&text).map_err(|error| not_one(&format!("the text {name:?} is damaged: {error}")))
        };
        let mut contents = Contents { text: Value::Null, layers: Vec::new() };
        for header in &headers {
            let window = header.shared_attributes.display_window;
            let [width, height] = [window.size.0, window.size.1].map(|side| u32::try_from(side).unwrap_or(u32::MAX));
            let position = header.own_attributes.layer_position;
            let size = [header.layer_size.0, header.layer_size.1];
            let start = [position.0, position.1].map(i64::from);
            let end = [0, 1].map(|k| start[k].saturating_add_unsigned(size[k] as u64));
            let inside = start[0] >= 0 && start[1] >= 0 && end[0] <= width.into() && end[1] <= height.into();
            if !inside || size[0] == 0 || size[1] == 0 {
                return Err(not_one(&format!("a layer from {start:?} to {end:?} is not in {width} × {height} pixels")));
            }
            let names = header.channels.list.iter().map(|channel| channel.name.to_string()).collect();
            let plain = |c: &exr::meta::attribute::ChannelDescription| {
                c.sampling == Vec2(1, 1) && c.sample_type != SampleType::F16
            };
            if header.deep || header.blocks != exr::meta::BlockDescription::ScanLines {
                return Err(not_one(&"it does not consist of rows"));
            }
            if !header.channels.list.iter().all(plain) {
                return Err(not_one(&"its channels are not of 32 bits for each pixel"));
            }
            let bits = 32 * header.channels.list.len() as u128;
            believe(path, size.map(|side| side as u128), bits, length as usize)?;
            // the reader does not tell which texts belong to the whole file
            let own = &header.own_attributes.other;
            contents.text = text(own.get(&Text::from(FILE)), FILE)?;
            let [x0, y0, x1, y1] = [start[0], start[1], end[0], end[1]].map(|x| x as u32);
            contents.layers.push(LayerHeader {
                area: [x0, y0, x1, y1],
                text: text(own.get(&Text::from(LAYER)), LAYER)?,
                names,
            });
        }
        Ok(Self { path: path.to_owned(), source, headers, contents })
    }

    /// Reads the rows of some layers that are in this range of the rows of the image, and those before and after which are stored with
    /// them. The areas of the results say which these are.
    ///
    /// # Errors
    /// Fails if the file is damaged.
    pub fn read(&mut self, layers: Range<usize>, rows: &Range<u32>) -> Result<Vec<Layer>, FileError> {
        let path = &self.path;
        let damaged = |what: &dyn std::fmt::Display| failed(path, format!("damaged: {what}"));
        let mut bands = Vec::new();
        for header in &self.contents.layers[layers.clone()] {
            let [_, y0, _, y1] = header.area;
            let first = rows.start.saturating_sub(y0) / ROWS * ROWS;
            let last = rows.end.saturating_sub(y0).next_multiple_of(ROWS).min(y1 - y0);
            if first >= last {
                return Err(damaged(&format!("it has no rows {} to {}", rows.start, rows.end)));
            }
            bands.push(first..last);
        }
        self.source.rewind().map_err(|error| damaged(&error))?;
        let reader = exr::block::read(&mut self.source, false).map_err(|error| damaged(&why(&error)))?;
        let meta = exr::meta::MetaData {
            requirements: reader.meta_data().requirements,
            headers: reader.headers().iter().cloned().collect(),
        };
        if meta.headers.as_slice() != self.headers.as_slice() {
            return Err(damaged(&"it has changed meanwhile"));
        }
        let wanted = |block: &exr::block::BlockIndex| {
            let band = block.layer.checked_sub(layers.start).and_then(|layer| bands.get(layer));
            band.is_some_and(|band| (band.start as usize..band.end as usize).contains(&block.pixel_position.1))
        };
        let chunks = reader
            .filter_chunks(false, |_, _, block| wanted(&block))
            .and_then(Iterator::collect::<exr::error::Result<Vec<_>>>)
            .map_err(|error| damaged(&why(&error)))?;
        let blocks: Vec<_> = chunks
            .into_par_iter()
            .map(|chunk| UncompressedBlock::decompress_chunk(chunk, &meta, false))
            .collect::<exr::error::Result<_>>()
            .map_err(|error| damaged(&why(&error)))?;
        let empty = |(header, band): (&LayerHeader, &Range<u32>)| {
            let [x0, y0, x1, _] = header.area;
            let area = [x0, y0 + band.start, x1, y0 + band.end];
            Layer { area, planes: Vec::new(), text: header.text.clone() }
        };
        let mut found: Vec<Layer> = self.contents.layers[layers.clone()].iter().zip(&bands).map(empty).collect();
        for (layer, header) in found.iter_mut().zip(&meta.headers[layers.clone()]) {
            let [x0, y0, x1, y1] = layer.area.map(|at| at as usize);
            let count = (x1 - x0) * (y1 - y0);
            let zeros = |kind| match kind {
                SampleType::U32 => Numbers::U32(vec![0; count]),
                _ => Numbers::F32(vec![0.0; count]),
            };
            let planes = header.channels.list.iter();
            layer.planes = planes.map(|channel| (channel.name.to_string(), zeros(channel.sample_type))).collect();
        }
        let mut rows_found = vec![0; found.len()];
        for block in &blocks {
            // the reader selects chunks by a table, but they have positions of their own
            let misplaced = || damaged(&"its rows are not where its table says");
            if !wanted(&block.index) {
                return Err(misplaced());
            }
            let index = block.index.layer - layers.start;
            let Layer { area: [x0, _, x1, _], planes, .. } = &mut found[index];
            let across = (*x1 - *x0) as usize;
            if block.index.pixel_size.0 != across {
                return Err(misplaced());
            }
            for (range, line) in LineIndex::lines_in_block(block.index, &meta.headers[block.index.layer].channels) {
                let row = line.position.1 - bands[index].start as usize;
                let bytes = block.data[range].as_chunks::<4>().0;
                let place = row * across..(row + 1) * across;
                match &mut planes[line.channel].1 {
                    Numbers::F32(values) => {
                        let values = values[place].iter_mut().zip(bytes);
                        values.for_each(|(value, bytes)| *value = f32::from_ne_bytes(*bytes));
                    }
                    Numbers::U32(values) => {
                        let values = values[place].iter_mut().zip(bytes);
                        values.for_each(|(value, bytes)| *value = u32::from_ne_bytes(*bytes));
                    }
                }
            }
            rows_found[index] += block.index.pixel_size.1;
        }
        for ((layer, band), rows) in found.iter().zip(&bands).zip(rows_found) {
            let noted = layer.text["checksums"].as_array().map_or(&[][..], Vec::as_slice);
            let noted = noted.get((band.start / ROWS) as usize..band.end.div_ceil(ROWS) as usize).unwrap_or(&[]);
            let sums = checksums(layer.area, &layer.planes);
            let is_same = noted.len() == sums.len() && noted.iter().zip(&sums).all(|(noted, sum)| noted == sum);
            if rows != band.len() || !is_same {
                return Err(damaged(&"its contents do not have their checksums"));
            }
        }
        Ok(found)
    }
}
