//! The image size in a file's header is accepted only if the file is long enough for it.

use etendue_render::image;
use exr::prelude::{Compression, Encoding, Image, Layer, LayerAttributes, SpecificChannels, WritableImage};
use std::io::Cursor;
use std::path::Path;

/// An image of one colour, which compresses best.
fn plain(side: usize, compression: Compression) -> Vec<u8> {
    let channels = SpecificChannels::rgb(|_| (0.25_f32, 0.5_f32, 0.75_f32));
    let encoding = Encoding { compression, ..Encoding::default() };
    let layer = Layer::new((side, side), LayerAttributes::default(), encoding, channels);
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

#[test]
fn plain_images_are_read_however_they_are_compressed() {
    for compression in [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
        Compression::PXR24,
    ] {
        let bytes = plain(1024, compression);
        let picture = image::decode(Path::new("plain.exr"), &bytes).unwrap();
        println!("{compression}: {:.0} to 1", (1024 * 1024 * 12) as f64 / bytes.len() as f64);
        assert_eq!((picture.width, picture.height, picture.radiance[7_000]), (1024, 1024, [0.25, 0.5, 0.75]));
    }
    let white = vec![[255; 3]; 2000 * 1000];
    let bytes = image::encode_png([2000, 1000], &white).unwrap();
    assert_eq!(image::decode(Path::new("plain.png"), &bytes).unwrap().radiance[7], [1.0; 3]);
}

/// Found by fuzzing: a file of 600 bytes for which 2.7 GB were allocated.
#[test]
fn a_size_that_the_file_cannot_hold_is_an_error() {
    let bytes = include_bytes!("../../../fuzz/seeds/image/oversized");
    let error = image::decode(Path::new("large.exr"), bytes).unwrap_err().to_string();
    assert_eq!(error, "large.exr: 64 × 67108802 pixels: at most 268435456 are supported");
    // changes the last coordinates of the data window of a valid file
    let mut bytes = plain(64, Compression::ZIP16);
    let window = bytes.windows(10).position(|w| w == b"dataWindow").unwrap() + 10 + 1 + 6 + 4;
    assert_eq!(bytes[window + 8..window + 16], [63, 0, 0, 0, 63, 0, 0, 0]);
    bytes[window + 9] = 0xff;
    let error = image::decode(Path::new("wide.exr"), &bytes).unwrap_err().to_string();
    assert!(
        error.starts_with("wide.exr: damaged: 65344 × 64 pixels, 50184192 bytes, do not fit into a file of "),
        "{error}"
    );
    bytes[window + 9..window + 16].copy_from_slice(&[0xff, 0xff, 0, 63, 0xff, 0xff, 0]);
    let error = image::decode(Path::new("huge.exr"), &bytes).unwrap_err().to_string();
    assert_eq!(error, "huge.exr: 16777024 × 16777024 pixels: at most 268435456 are supported");
}

/// Found by fuzzing: an HDR image without rows, whose mean is 0/0.
#[test]
fn an_image_of_nothing_is_an_error() {
    let bytes = include_bytes!("../../../fuzz/seeds/image/zero-rows");
    let error = image::decode(Path::new("flat.hdr"), bytes).unwrap_err().to_string();
    assert_eq!(error, "flat.hdr: the image is empty: 4 × 0 pixels");
}
