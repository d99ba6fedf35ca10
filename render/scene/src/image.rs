//! Image files of any format as radiance or as textures.

mod pfm;
mod texels;

pub use texels::Encoding;

use crate::message::shortened;
use etendue_render::film::files::{FileError, failed, read_file};
use etendue_render::film::image::{Picture, check_size, decode_displayed};
use etendue_render::scene::texture::{Colors, Texels, srgb_to_linear};
use image_files::DynamicImage;
use image_files::codecs::hdr::HdrDecoder;
use std::fmt;
use std::io::Cursor;
use std::path::Path;
use texels::{PNG, Rows};

/// Reads a picture from an OpenEXR or Radiance HDR file, or from a PNG file, whose values are decoded from sRGB.
///
/// The picture of an OpenEXR file is its display window. Where its data window has no pixels, it is black, and what it has outside is left out.
///
/// # Errors
/// Fails if the file is missing, damaged or of another format, or has more than 2²⁸ pixels.
pub fn read(path: &Path) -> Result<Picture, FileError> {
    let bytes = read_file(path).map_err(|error| failed(path, format!("cannot read: {error}")))?;
    decode(path, &bytes)
}

/// Like [`read`], from the bytes of a file that messages call `path`.
///
/// # Errors
/// Fails if the bytes are damaged or of another format, or hold more than 2²⁸ pixels.
pub fn decode(path: &Path, bytes: &[u8]) -> Result<Picture, FileError> {
    // OpenEXR's magic number
    if bytes.starts_with(&[0x76, 0x2f, 0x31, 0x01]) {
        return decode_displayed(bytes, path);
    }
    if bytes.starts_with(PNG) {
        return decode_png(bytes, path);
    }
    if let Some(image) = pfm::decode(path, bytes) {
        return image.map(|(width, height, radiance)| Picture {
            width,
            height,
            radiance,
            variance: None,
            second: None,
        });
    }
    let not_one = |error: &dyn fmt::Display| failed(path, format!("not a valid Radiance HDR image: {error}"));
    if !bytes.starts_with(b"#?") {
        return Err(failed(path, format!("not a picture: {}", kind_of(bytes))));
    }
    // ImageMagick and others begin with #?RGBE, and the strict reader takes only #?RADIANCE
    let decoder = HdrDecoder::new_nonstrict(Cursor::new(bytes)).map_err(|error| not_one(&error))?;
    let [width, height] = [decoder.metadata().width, decoder.metadata().height];
    // a run of equal pixels takes few bytes
    check_size(path, [width.into(), height.into()], 1, bytes.len())?;
    let image = DynamicImage::from_decoder(decoder).map_err(|error| not_one(&error))?;
    let radiance = image.into_rgb32f().pixels().map(|p| p.0).collect();
    Ok(Picture { width: width as usize, height: height as usize, radiance, variance: None, second: None })
}

/// What a file is that is no picture that can be read here, as its first bytes tell.
pub(super) fn kind_of(bytes: &[u8]) -> String {
    let is = |magic: &[u8]| bytes.starts_with(magic);
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(40)]);
    if is(b"version https://git-lfs") || is(b"/annex/") || is(b"../") && text.contains("annex") {
        return "the file is a pointer of git: the picture itself was not fetched".to_owned();
    }
    let known: [(&[u8], &str); 8] = [
        (&[0xab, b'K', b'T', b'X', b' ', b'2', b'0'], "a KTX2 file (compressed textures are not supported)"),
        (&[0xab, b'K', b'T', b'X'], "a KTX file (compressed textures are not supported)"),
        (b"DDS ", "a DDS file (compressed textures are not supported)"),
        (b"sB", "a Basis file (compressed textures are not supported)"),
        (b"BM", "a BMP file, which is not supported"),
        (b"GIF8", "a GIF file, which is not supported"),
        (b"<", "text, such as a page of the web"),
        (b"{", "JSON text"),
    ];
    if let Some((_, what)) = known.iter().find(|(magic, _)| is(magic)) {
        return format!("it is {what}");
    }
    if is(b"RIFF") && bytes.get(8..12) == Some(b"WEBP") {
        return "it is a WebP file, which is not supported".to_owned();
    }
    match bytes {
        [] => "the file is empty".to_owned(),
        _ => format!(
            "it begins with {:?}: EXR, HDR, PFM, PNG and, as textures, JPEG and TGA are supported",
            shortened(&text)
        ),
    }
}

/// The name of the format of a picture, as its first bytes tell.
pub(super) fn format_of(bytes: &[u8]) -> Option<&'static str> {
    let known: [(&[u8], &str); 4] =
        [(PNG, "PNG"), (&[0xff, 0xd8, 0xff], "JPEG"), (&[0x76, 0x2f, 0x31, 0x01], "EXR"), (b"#?R", "Radiance HDR")];
    known.into_iter().find(|(magic, _)| bytes.starts_with(magic)).map(|(_, name)| name)
}

/// Reads a PNG file of any depth and colour type; transparency is ignored.
fn decode_png(bytes: &[u8], path: &Path) -> Result<Picture, FileError> {
    let Rows { width, height, channels, is_wide, data } = Rows::of_png(path, bytes, png::Transformations::EXPAND)?;
    let samples: Vec<f32> = if is_wide {
        let pairs = data.chunks_exact(2);
        pairs.map(|b| srgb_to_linear(f64::from(u16::from_be_bytes([b[0], b[1]])) / 65535.0)).collect()
    } else {
        data.iter().map(|&b| srgb_to_linear(f64::from(b) / 255.0)).collect()
    };
    // grey, or grey and alpha, have one colour channel
    let color = |p: &[f32]| if channels < 3 { [p[0]; 3] } else { [p[0], p[1], p[2]] };
    let radiance = samples.chunks_exact(channels).map(color).collect();
    Ok(Picture { width, height, radiance, variance: None, second: None })
}

/// Reads a texture from the bytes of a PNG, JPEG, TGA, OpenEXR or Radiance HDR file that messages call `path`. Negative values become 0;
/// also returns the number of texels that have some.
///
/// # Errors
/// Fails if the bytes are damaged or of another format, hold more than 2²⁸ pixels, or a texel that is not finite.
pub fn read_texels(path: &Path, bytes: &[u8], encoding: Encoding) -> Result<(Texels, usize), FileError> {
    if let Some(texels) = texels::from_bytes(path, bytes, encoding) {
        return texels.map(|texels| (texels, 0));
    }
    let Picture { width, height, radiance, .. } = decode(path, bytes)?;
    if let Some(i) = radiance.iter().position(|rgb| !rgb.iter().all(|x| x.is_finite())) {
        let (x, y, texel) = (i % width, i / width, radiance[i]);
        return Err(failed(path, format!("texel ({x}, {y}) is {texel:?}: must be finite")));
    }
    let negative = radiance.iter().filter(|rgb| rgb.iter().any(|&x| x < 0.0)).count();
    let colors = Colors::Float(radiance.iter().map(|rgb| rgb.map(|x| x.max(0.0))).collect());
    Ok((Texels { width, height, colors, alpha: None }, negative))
}

/// The texels of an image that messages call `name`, with a warning if some were negative.
pub(super) fn sound((texels, negative): (Texels, usize), name: &str, warn: impl FnOnce(String)) -> Texels {
    if negative > 0 {
        warn(format!("{}: negative values in {negative} texel(s) are replaced by 0", shortened(name)));
    }
    texels
}
