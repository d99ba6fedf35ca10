//! Image files: EXR with the variance of the estimate, and PNG for viewing. No other module uses the exr and png crates.

mod size;

pub use size::check_size;

use super::files::{FileError, failed, open_file, replace};
use super::pixels::{Film, Pixel, Second};
use crate::scene::area::PlaceInImage;
use exr::block::chunk::CompressedBlock;
use exr::math::Vec2;
use exr::meta::attribute::{AttributeValue, IntegerBounds, Text};
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, ImageAttributes, Layer,
    LayerAttributes, LineOrder, ReadChannels, ReadLayers, WritableImage,
};
use serde_json::Value;
use std::io::{self, BufReader, BufWriter, Cursor};
use std::path::Path;

const CHANNELS: [&str; 3] = ["R", "G", "B"];

/// However short a file is, its display window can have 2²⁴ pixels, as can one of so many bytes.
const SHORT: usize = 1 << 10;

/// Name of the text in a file.
const TEXT: &str = "etendue";

/// The bytes of an EXR file with the channels R, G, B, `variance.R`, `variance.G`, `variance.B` and `samples.N`; and, if any pixel has a
/// [second set](Second), `second.R`, `second.G`, `second.B` and `second.weight`. Its header has a text. Equal images give equal bytes.
///
/// # Errors
/// Fails if the number of pixels does not match the size.
pub fn encode_exr(
    pixels: &[Pixel],
    [width, height]: [u32; 2],
    place: PlaceInImage,
    text: &Value,
) -> exr::error::Result<Vec<u8>> {
    let channel =
        |name: &str, f: &dyn Fn(&Pixel) -> f32| AnyChannel::new(name, FlatSamples::F32(pixels.iter().map(f).collect()));
    let samples = FlatSamples::U32(pixels.iter().map(|p| p.samples).collect());
    let mut channels = vec![AnyChannel::new("samples.N", samples)];
    let judged = pixels.iter().any(|p| p.second.weight != 0.0);
    for (k, name) in CHANNELS.into_iter().enumerate() {
        channels.push(channel(name, &|p| p.mean[k]));
        channels.push(channel(&format!("variance.{name}"), &|p| p.variance[k]));
        if judged {
            channels.push(channel(&format!("second.{name}"), &|p| p.second.mean[k]));
        }
    }
    if judged {
        channels.push(channel("second.weight", &|p| p.second.weight));
    }
    // increasing line order makes the bytes independent of the number of compressing threads
    let encoding =
        Encoding { compression: Compression::ZIP16, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    let [[x, y], [across, down]] = [place.start, place.whole].map(|at| at.map(|at| at as usize));
    let mut own = LayerAttributes { layer_position: Vec2(x as i32, y as i32), ..LayerAttributes::default() };
    own.other.insert(TEXT.into(), AttributeValue::Text(plain(text)));
    let size = (width as usize, height as usize);
    let layer = Layer::new(size, own, encoding, AnyChannels::sort(channels.into_iter().collect()));
    let window = IntegerBounds { position: Vec2(0, 0), size: Vec2(across, down) };
    let mut bytes = Cursor::new(Vec::new());
    Image::new(ImageAttributes::new(window), layer).write().to_buffered(&mut bytes)?;
    Ok(bytes.into_inner())
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

/// The text in the header of a file that [`encode_exr`] made; `None` if the file has none, or cannot be read.
pub fn text_of(path: &Path) -> Option<Value> {
    let mut source = BufReader::new(open_file(path).ok()?);
    let meta = exr::meta::MetaData::read_from_buffered(&mut source, false).ok()?;
    let AttributeValue::Text(text) = meta.headers.first()?.own_attributes.other.get(&Text::from(TEXT))? else {
        return None;
    };
    serde_json::from_str(&text.to_string()).ok()
}

/// What is wrong with a file that cannot be read, for a message.
fn why(error: &exr::error::Error) -> String {
    use exr::error::Error;
    const OUTSIDE: &str = "it is cut off, or its table leads to a place outside of it";
    match error {
        // systems refuse to go to a place that no file has
        Error::Io(error) if error.kind() == io::ErrorKind::InvalidInput => OUTSIDE.to_owned(),
        Error::Invalid(what) if what == "reference to missing bytes" => OUTSIDE.to_owned(),
        other => other.to_string(),
    }
}

/// Writes a tone-mapped PNG: Reinhard's extended curve on luminance, white at radiance 4, then 8-bit sRGB.
///
/// # Errors
/// Fails if the file cannot be written; an existing file then remains unchanged.
pub fn write_png(path: &Path, film: &Film) -> Result<(), FileError> {
    let data: Vec<[u8; 3]> = film.pixels.iter().map(|p| tone_map(p.mean)).collect();
    let bytes = encode_png([film.width, film.height], &data).map_err(|error| failed(path, error))?;
    replace(path, &bytes)
}

/// Encodes sRGB pixels, row by row, as a PNG file.
///
/// # Errors
/// Fails if the number of pixels does not match the size.
pub fn encode_png([width, height]: [u32; 2], pixels: &[[u8; 3]]) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(BufWriter::new(&mut bytes), width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels.as_flattened())?;
    writer.finish()?;
    Ok(bytes)
}

/// The tone-mapped sRGB value of a radiance, as in [`write_png`].
pub fn tone_map(radiance: [f32; 3]) -> [u8; 3] {
    let [r, g, b] = radiance;
    let luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    let scale = (1.0 + luminance / 16.0) / (1.0 + luminance);
    radiance.map(|x| {
        let x = (x * scale).clamp(0.0, 1.0);
        let encoded = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
        (encoded * 255.0).round() as u8
    })
}

/// An image read from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// R, G, B of each pixel, row by row from the top left.
    pub radiance: Vec<[f32; 3]>,
    /// Variance of the mean of each pixel, if the file has it.
    pub variance: Option<Vec<[f32; 3]>>,
    /// The second set of each pixel, if the file has any.
    pub second: Option<Vec<Second>>,
}

impl From<&Film> for Picture {
    fn from(film: &Film) -> Self {
        Self {
            width: film.width as usize,
            height: film.height as usize,
            radiance: film.pixels.iter().map(|p| p.mean).collect(),
            variance: Some(film.pixels.iter().map(|p| p.variance).collect()),
            second: Some(film.pixels.iter().map(|p| p.second).collect()),
        }
    }
}

/// Reads the channels R, G, B, or a single one, as grey, and, if present, those of the variance and of second sets, of the data window.
///
/// # Errors
/// Fails if the file is missing or damaged, has neither R, G, B nor Y nor a single channel, or has more than 2²⁸ pixels.
pub fn read_exr(path: &Path) -> Result<Picture, FileError> {
    let bytes = crate::film::files::read_file(path).map_err(|error| failed(path, format!("cannot read: {error}")))?;
    decode_exr(&bytes, path)
}

/// Like [`read_exr`], from the bytes of a file that messages call `path`.
///
/// # Errors
/// Fails if the file is damaged, has no R, G, B, or has more than 2²⁸ pixels.
pub fn decode_exr(bytes: &[u8], path: &Path) -> Result<Picture, FileError> {
    decode_windows(bytes, path).map(|(data, ..)| data)
}

/// Like [`decode_exr`], but of the display window: where the data window has no pixels, it is black, and what it has outside is left out.
///
/// # Errors
/// Fails if the file is damaged, has no R, G, B, or has more than 2²⁸ pixels.
pub fn decode_displayed(bytes: &[u8], path: &Path) -> Result<Picture, FileError> {
    decode_windows(bytes, path).and_then(|(data, start, display)| displayed(path, bytes.len(), data, start, display))
}

/// What a display window shows of the pixels of a data window whose first one is `start`, in a file of `length` bytes.
fn displayed(
    path: &Path,
    length: usize,
    data: Picture,
    start: [i64; 2],
    display: IntegerBounds,
) -> Result<Picture, FileError> {
    let first = [display.position.0, display.position.1].map(i64::from);
    let [width, height] = [display.size.0, display.size.1];
    if start == first && [data.width, data.height] == [width, height] {
        return Ok(data);
    }
    // a small data window takes few bytes, however large the display window is
    let size = [width as u128, height as u128];
    check_size(path, size, 1, length.max(SHORT))?;
    let mut radiance = vec![[0.0; 3]; width * height];
    // of a pixel of the display window, the one of the data window
    let inside = |k: usize, at: usize, side: usize| {
        let at = usize::try_from(first[k] + at as i64 - start[k]).ok()?;
        (at < side).then_some(at)
    };
    for (y, row) in radiance.chunks_exact_mut(width).enumerate() {
        let Some(from) = inside(1, y, data.height) else { continue };
        for (x, pixel) in row.iter_mut().enumerate() {
            if let Some(column) = inside(0, x, data.width) {
                *pixel = data.radiance[from * data.width + column];
            }
        }
    }
    Ok(Picture { width, height, radiance, variance: None, second: None })
}

/// The data window of an EXR file, its first pixel, and the display window.
fn decode_windows(bytes: &[u8], path: &Path) -> Result<(Picture, [i64; 2], IntegerBounds), FileError> {
    let not_one = |error: exr::error::Error| failed(path, format!("not a valid EXR image: {}", why(&error)));
    let meta = exr::meta::MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(not_one)?;
    for header in &meta.headers {
        let samples = header.channels.list.iter().map(|c| c.sample_type.bytes_per_sample() as u128);
        let size = [header.layer_size.width() as u128, header.layer_size.height() as u128];
        // other channels may be subsampled, but R, G and B must not be: a pixel takes at least four bytes
        let full = header.channels.list.iter().all(|c| c.sampling == Vec2(1, 1));
        check_size(path, size, 8 * if full { samples.sum() } else { 4 }, bytes.len())?;
    }
    // the reader selects chunks by the offset table but stores them by their own coordinates: both must agree
    let full_size = Vec2(0, 0);
    let chunks = exr::block::read(Cursor::new(bytes), false)
        .and_then(|reader| reader.filter_chunks(false, |_, tile, _| tile.level_index == full_size))
        .map_err(not_one)?;
    for chunk in chunks {
        if let CompressedBlock::Tile(tile) = chunk.map_err(not_one)?.compressed_block {
            let level = tile.coordinates.level_index;
            if level != full_size {
                return Err(failed(
                    path,
                    format!("damaged: a tile listed at full size claims to be of level {}, {}", level.x(), level.y()),
                ));
            }
        }
    }
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(not_one)?;
    let layer = &image.layer_data;
    let (width, height) = (layer.size.width(), layer.size.height());
    let channel = |name: &str| -> Option<Vec<f32>> {
        let found = layer.channel_data.list.iter().find(|c| c.name.to_string() == name)?;
        let values: Vec<f32> = found.sample_data.values_as_f32().collect();
        (values.len() == width * height).then_some(values)
    };
    let three = |prefix: &str| -> Option<Vec<[f32; 3]>> {
        let [r, g, b] = CHANNELS.map(|name| channel(&format!("{prefix}{name}")));
        let (r, g, b) = (r?, g?, b?);
        Some((0..width * height).map(|i| [r[i], g[i], b[i]]).collect())
    };
    // maps of heights and of opacities have a single channel, most often Y
    let grey = || -> Option<Vec<[f32; 3]>> {
        let [only] = &layer.channel_data.list[..] else { return None };
        Some(channel(&only.name.to_string())?.into_iter().map(|y| [y; 3]).collect())
    };
    let has = |name: &str| layer.channel_data.list.iter().any(|c| c.name.to_string() == name);
    let radiance = three("").or_else(grey).or_else(|| {
        // with opacity beside it
        let y = channel("Y").filter(|_| !has("RY") && !has("BY"))?;
        Some(y.into_iter().map(|y| [y; 3]).collect())
    });
    let radiance = radiance.ok_or_else(|| {
        let why = if has("RY") {
            "luminance and chroma (Y, RY, BY) are not supported"
        } else {
            "they are missing or not of full resolution"
        };
        failed(path, format!("needs the channels R, G and B, or a single one: {why}"))
    })?;
    let start = [layer.attributes.layer_position.0, layer.attributes.layer_position.1].map(i64::from);
    let second = three("second.").zip(channel("second.weight"));
    let second =
        second.map(|(means, w)| means.into_iter().zip(w).map(|(mean, weight)| Second { mean, weight }).collect());
    let data = Picture { width, height, radiance, variance: three("variance."), second };
    Ok((data, start, image.attributes.display_window))
}
