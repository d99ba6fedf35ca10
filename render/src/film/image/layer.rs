//! EXR files of named planes of numbers for a rectangle of an image, and a text.
//!
//! Each file has a checksum for every sixteen rows, which are read and compressed together.

use super::size::check_size;
use crate::film::files::{FileError, failed};
use crate::scene::area::Area;
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
use std::fmt::Display;
use std::fs::File;
use std::io::{self, BufReader, Cursor, Read, Seek};
use std::ops::Range;
use std::path::{Path, PathBuf};
use xxhash_rust::xxh3::Xxh3;

/// Rows that are compressed together, and share a checksum.
const ROWS: u32 = 16;
/// Name of the text in a file.
const TEXT: &str = "etendue";

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

/// Numbers for the pixels of a rectangle.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// The pixels [x0, y0, x1, y1).
    pub area: Area,
    /// Planes of numbers and their names, which differ.
    pub planes: Vec<(String, Numbers)>,
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
fn plain(text: &Value) -> Text {
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

/// The bytes of a file whose display window has this size. The text, a JSON object, receives the checksums. Equal layers give equal bytes.
///
/// # Errors
/// Fails if the planes do not have the size of the layer.
pub fn encode(
    size: [u32; 2],
    mut text: Value,
    mut layer: Layer,
    compression: Compression,
) -> exr::error::Result<Vec<u8>> {
    let [x0, y0, x1, y1] = layer.area;
    let window = IntegerBounds { position: Vec2(0, 0), size: Vec2(size[0] as usize, size[1] as usize) };
    // increasing line order makes the bytes independent of the number of compressing threads
    let encoding = Encoding { compression, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    let mut own = LayerAttributes { layer_position: Vec2(x0 as i32, y0 as i32), ..LayerAttributes::default() };
    layer.planes.sort_by(|a, b| a.0.cmp(&b.0));
    text["checksums"] = json!(checksums(layer.area, &layer.planes));
    own.other.insert(TEXT.into(), AttributeValue::Text(plain(&text)));
    let channels = layer.planes.into_iter().map(|(name, numbers)| {
        let samples = match numbers {
            Numbers::F32(values) => FlatSamples::F32(values),
            Numbers::U32(values) => FlatSamples::U32(values),
        };
        AnyChannel::new(name.as_str(), samples)
    });
    let size = ((x1 - x0) as usize, (y1 - y0) as usize);
    let layer = ExrLayer::new(size, own, encoding, AnyChannels::sort(channels.collect()));
    let mut bytes = Cursor::new(Vec::new());
    Image::new(ImageAttributes::new(window), layer).write().to_buffered(&mut bytes)?;
    Ok(bytes.into_inner())
}

/// A file whose header has been read.
pub struct LayerFile<R> {
    path: PathBuf,
    source: R,
    header: Header,
    /// The pixels [x0, y0, x1, y1) of the display window.
    pub area: Area,
    /// The text, with the checksums.
    pub text: Value,
}

impl LayerFile<BufReader<File>> {
    /// Opens a file and reads its header.
    ///
    /// # Errors
    /// Fails if the file cannot be read, or is not one that [`encode`] made.
    pub fn open(path: &Path) -> Result<Self, FileError> {
        let cannot = |error| failed(path, format!("cannot read: {error}"));
        let file = crate::film::files::open_file(path).map_err(cannot)?;
        let length = file.metadata().map_err(cannot)?.len();
        Self::new(path, BufReader::new(file), length)
    }
}

impl<R: Read + Seek> LayerFile<R> {
    /// Reads the header from a source of `length` bytes that messages call `path`.
    ///
    /// # Errors
    /// Fails if the source is not a file that [`encode`] made.
    pub fn new(path: &Path, mut source: R, length: u64) -> Result<Self, FileError> {
        let not_one = |what: &dyn Display| failed(path, format!("not an image of etendue, nor a part of one: {what}"));
        let meta =
            exr::meta::MetaData::read_from_buffered(&mut source, false).map_err(|error| not_one(&why(&error)))?;
        let [header] = meta.headers.as_slice() else { return Err(not_one(&"it has several layers")) };
        let window = header.shared_attributes.display_window;
        let [width, height] = [window.size.0, window.size.1].map(|side| u32::try_from(side).unwrap_or(u32::MAX));
        let position = header.own_attributes.layer_position;
        let size = [header.layer_size.0, header.layer_size.1];
        let start = [position.0, position.1].map(i64::from);
        let end = [0, 1].map(|k| start[k].saturating_add_unsigned(size[k] as u64));
        let inside = start[0] >= 0 && start[1] >= 0 && end[0] <= width.into() && end[1] <= height.into();
        if !inside || size[0] == 0 || size[1] == 0 {
            return Err(not_one(&format!("the pixels from {start:?} to {end:?} are not in {width} × {height}")));
        }
        let full =
            |c: &exr::meta::attribute::ChannelDescription| c.sampling == Vec2(1, 1) && c.sample_type != SampleType::F16;
        if header.deep || header.blocks != exr::meta::BlockDescription::ScanLines {
            return Err(not_one(&"it does not consist of rows"));
        }
        if !header.channels.list.iter().all(full) {
            return Err(not_one(&"its channels are not of 32 bits for each pixel"));
        }
        let bits = 32 * header.channels.list.len() as u128;
        check_size(path, size.map(|side| side as u128), bits, length as usize)?;
        let Some(AttributeValue::Text(text)) = header.own_attributes.other.get(&Text::from(TEXT)) else {
            return Err(not_one(&format!("it has no text {TEXT:?}")));
        };
        let text = serde_json::from_str(&text.to_string());
        let text = text.map_err(|error| not_one(&format!("the text {TEXT:?} is damaged: {error}")))?;
        let area = [start[0], start[1], end[0], end[1]].map(|x| x as u32);
        Ok(Self { path: path.to_owned(), source, header: header.clone(), area, text })
    }

    /// Reads the rows in this range of the rows of the layer, and those before and after which are stored with them. The area of the
    /// result says which these are.
    ///
    /// # Errors
    /// Fails if the file is damaged.
    pub fn read(&mut self, rows: &Range<u32>) -> Result<Layer, FileError> {
        let path = &self.path;
        let damaged = |what: &dyn Display| failed(path, format!("damaged: {what}"));
        let [x0, y0, x1, y1] = self.area;
        let band = rows.start / ROWS * ROWS..rows.end.next_multiple_of(ROWS).min(y1 - y0);
        self.source.rewind().map_err(|error| damaged(&error))?;
        let reader = exr::block::read(&mut self.source, false).map_err(|error| damaged(&why(&error)))?;
        let meta = exr::meta::MetaData {
            requirements: reader.meta_data().requirements,
            headers: reader.headers().iter().cloned().collect(),
        };
        if meta.headers.as_slice() != std::slice::from_ref(&self.header) {
            return Err(damaged(&"it has changed meanwhile"));
        }
        let wanted = |block: &exr::block::BlockIndex| {
            block.layer == 0 && (band.start as usize..band.end as usize).contains(&block.pixel_position.1)
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
        let (across, down) = ((x1 - x0) as usize, band.len());
        let zeros = |kind| match kind {
            SampleType::U32 => Numbers::U32(vec![0; across * down]),
            _ => Numbers::F32(vec![0.0; across * down]),
        };
        let channels = &self.header.channels;
        let mut planes: Vec<(String, Numbers)> =
            channels.list.iter().map(|channel| (channel.name.to_string(), zeros(channel.sample_type))).collect();
        let mut rows_found = 0;
        for block in &blocks {
            // the reader selects chunks by a table, but they have positions of their own
            if !wanted(&block.index) || block.index.pixel_size.0 != across {
                return Err(damaged(&"its rows are not where its table says"));
            }
            for (range, line) in LineIndex::lines_in_block(block.index, channels) {
                let row = line.position.1 - band.start as usize;
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
            rows_found += block.index.pixel_size.1;
        }
        let area = [x0, y0 + band.start, x1, y0 + band.end];
        let noted = self.text["checksums"].as_array().map_or(&[][..], Vec::as_slice);
        let noted = noted.get((band.start / ROWS) as usize..band.end.div_ceil(ROWS) as usize).unwrap_or(&[]);
        let sums = checksums(area, &planes);
        if rows_found != down || noted.len() != sums.len() || noted.iter().zip(&sums).any(|(noted, sum)| noted != sum) {
            return Err(damaged(&"its contents do not have their checksums"));
        }
        Ok(Layer { area, planes })
    }
}
