//! Images as textures: their bytes as they are in the file, which are a quarter of what floating-point numbers take.

use etendue_render::film::files::{FileError, failed};
use etendue_render::film::image::check_size;
use etendue_render::scene::texture::{Colors, Texels};
use image_files::{DynamicImage, ImageDecoder, ImageReader};
use std::io::Cursor;
use std::path::Path;

/// PNG's signature.
pub(super) const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";

/// What the bytes of an image mean; floating-point numbers are linear in any case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Encoding {
    /// sRGB's curve.
    Srgb,
    /// Numbers in proportion to what they stand for.
    Linear,
    /// Powers of them.
    Gamma(f32),
}

/// Texels from the bytes of a PNG, JPEG or TGA file; `None` if the file is of another format.
pub(super) fn from_bytes(path: &Path, bytes: &[u8], encoding: Encoding) -> Option<Result<Texels, FileError>> {
    let texels = if bytes.starts_with(PNG) {
        png_texels(path, bytes)
    } else if bytes.starts_with(&[0xff, 0xd8, 0xff]) || is_tga(path) {
        other_texels(path, bytes)
    } else {
        return None;
    };
    Some(texels.map(|texels| encoded(texels, encoding)))
}

fn encoded(texels: Texels, encoding: Encoding) -> Texels {
    let colors = match (texels.colors, encoding) {
        (Colors::Srgb(bytes), Encoding::Linear) => Colors::Linear(bytes),
        (Colors::Srgb(bytes), Encoding::Gamma(gamma)) => {
            let table: [f32; 256] = std::array::from_fn(|byte| libm::powf(byte as f32 / 255.0, gamma));
            Colors::Float(bytes.iter().map(|rgb| rgb.map(|byte| table[usize::from(byte)])).collect())
        }
        (colors, _) => colors,
    };
    Texels { colors, ..texels }
}

fn is_tga(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("tga"))
}

/// Pixels row by row, as a file has them.
pub(super) struct Rows {
    pub(super) width: usize,
    pub(super) height: usize,
    /// 1 for grey, 2 for grey and opacity, 3 for colours, 4 for colours and opacity.
    pub(super) channels: usize,
    /// Whether a sample has two bytes, the higher one first.
    pub(super) is_wide: bool,
    pub(super) data: Vec<u8>,
}

impl Rows {
    /// The pixels of a PNG file, after libpng's transformations.
    pub(super) fn of_png(path: &Path, bytes: &[u8], changes: png::Transformations) -> Result<Self, FileError> {
        let not_one = |error: png::DecodingError| failed(path, format!("not a valid PNG image: {error}"));
        let mut decoder = png::Decoder::new(Cursor::new(bytes));
        decoder.set_transformations(changes);
        let header = decoder.read_header_info().map_err(not_one)?;
        let [width, height] = [header.width, header.height];
        // one bit per pixel at least
        check_size(path, [width.into(), height.into()], 1, bytes.len())?;
        let mut reader = decoder.read_info().map_err(not_one)?;
        let size = reader.output_buffer_size().ok_or_else(|| failed(path, "too large"))?;
        let mut data = vec![0; size];
        let frame = reader.next_frame(&mut data).map_err(not_one)?;
        data.truncate(frame.buffer_size());
        Ok(Self {
            width: width as usize,
            height: height as usize,
            channels: frame.color_type.samples(),
            is_wide: frame.bit_depth == png::BitDepth::Sixteen,
            data,
        })
    }
}

/// Texels of pixels of one byte a sample.
fn from_rows(width: usize, height: usize, channels: usize, bytes: &[u8]) -> Texels {
    let color = |p: &[u8]| if channels < 3 { [p[0]; 3] } else { [p[0], p[1], p[2]] };
    let has_alpha = channels.is_multiple_of(2);
    Texels {
        width,
        height,
        colors: Colors::Srgb(bytes.chunks_exact(channels).map(color).collect()),
        alpha: has_alpha.then(|| bytes.chunks_exact(channels).map(|p| p[channels - 1]).collect()),
    }
}

fn png_texels(path: &Path, bytes: &[u8]) -> Result<Texels, FileError> {
    // sixteen bits lose their lower half
    let changes = png::Transformations::EXPAND | png::Transformations::STRIP_16;
    let Rows { width, height, channels, data, .. } = Rows::of_png(path, bytes, changes)?;
    Ok(from_rows(width, height, channels, &data))
}

fn other_texels(path: &Path, bytes: &[u8]) -> Result<Texels, FileError> {
    let format = if is_tga(path) { image_files::ImageFormat::Tga } else { image_files::ImageFormat::Jpeg };
    let not_one = |error: image_files::ImageError| failed(path, format!("not a valid JPEG or TGA image: {error}"));
    let decoder = ImageReader::with_format(Cursor::new(bytes), format).into_decoder().map_err(not_one)?;
    let (width, height) = decoder.dimensions();
    // a JPEG of one colour takes a bit for each block of 8 × 8 pixels and channel
    check_size(path, [width.into(), height.into()], 1, bytes.len())?;
    let (width, height) = (width as usize, height as usize);
    Ok(match DynamicImage::from_decoder(decoder).map_err(not_one)? {
        DynamicImage::ImageLuma8(image) => from_rows(width, height, 1, image.as_raw()),
        DynamicImage::ImageLumaA8(image) => from_rows(width, height, 2, image.as_raw()),
        DynamicImage::ImageRgba8(image) => from_rows(width, height, 4, image.as_raw()),
        image => from_rows(width, height, 3, image.into_rgb8().as_raw()),
    })
}
