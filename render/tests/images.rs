//! Images in files: their sizes, which are accepted only if the file is long enough, and their windows.

use crate::kit::Folder;
use etendue_render::film::files::check_replaceable;
use etendue_render::film::image::Picture;
use etendue_render::film::{Film, Pixel, Second};
use etendue_render::scene::area::PlaceInImage;
use etendue_render::scene::texture::Colors;
use etendue_render::{Identity, Sampler, Sensor, Settings, Technique, film::image};
use etendue_scene::image::{Encoding as TexelEncoding, read_texels};
use exr::math::Vec2;
use exr::meta::attribute::IntegerBounds;
use exr::prelude::{
    Compression, Encoding, Image, ImageAttributes, Layer, LayerAttributes, MetaData, SpecificChannels, WritableImage,
};
use image_files::{DynamicImage, ImageFormat};
use std::io::Cursor;
use std::path::Path;

/// A file can be written where there is none yet, or a file, in a folder that is there.
#[test]
fn files_are_replaced_in_folders_that_exist() {
    let folder = Folder::new();
    let path = folder.path("image.exr");
    check_replaceable(&path).unwrap();
    assert!(!path.exists());
    folder.write("image.exr", "");
    check_replaceable(&path).unwrap();
    for (path, why) in [(folder.path(""), "this is a folder"), (folder.path("none/image.exr"), "does not exist")] {
        let error = check_replaceable(&path).unwrap_err().to_string();
        assert!(error.contains(why), "{error}");
    }
}

/// An image of one colour, which compresses best.
fn plain(side: usize, compression: Compression) -> Vec<u8> {
    let channels = SpecificChannels::rgb(|_| (0.25_f32, 0.5_f32, 0.75_f32));
    let encoding = Encoding { compression, ..Encoding::default() };
    let layer = Layer::new((side, side), LayerAttributes::default(), encoding, channels);
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

/// A picture of a data window of which column x and row y have the value (x, y, 1), in a display window.
fn windows(data: [[i32; 2]; 2], display: [[i32; 2]; 2]) -> Vec<u8> {
    let size = |[low, high]: [[i32; 2]; 2]| [0, 1].map(|k| (high[k] - low[k] + 1) as usize);
    let ([x, y], [across, down]) = (data[0], size(data));
    let channels =
        SpecificChannels::rgb(move |at: Vec2<usize>| ((x + at.0 as i32) as f32, (y + at.1 as i32) as f32, 1.0_f32));
    let attributes = LayerAttributes { layer_position: Vec2(x, y), ..LayerAttributes::default() };
    let layer = Layer::new((across, down), attributes, Encoding::UNCOMPRESSED, channels);
    let ([left, top], [width, height]) = (display[0], size(display));
    let bounds = IntegerBounds { position: Vec2(left, top), size: Vec2(width, height) };
    let mut bytes = Cursor::new(Vec::new());
    let image = Image::new(ImageAttributes::new(bounds), layer);
    image.write().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

/// A picture is its display window: black where there are no data, and without those outside. Only what is measured of images counts their
/// data.
#[test]
fn pictures_are_display_windows() {
    for (data, display) in [
        ([[0, 0], [4, 2]], [[0, 0], [4, 2]]),
        // a part, one that is larger, and one that is partly outside
        ([[2, 1], [3, 1]], [[0, 0], [4, 2]]),
        ([[-3, -2], [9, 9]], [[0, 0], [4, 2]]),
        ([[-3, 1], [1, 8]], [[0, 0], [4, 2]]),
        ([[-3, 1], [1, 8]], [[-2, -1], [3, 2]]),
        ([[7, 7], [8, 9]], [[0, 0], [4, 2]]),
    ] {
        let bytes = windows(data, display);
        let picture = etendue_scene::image::decode(Path::new("a.exr"), &bytes).unwrap();
        let [[x0, y0], [x1, y1]] = display;
        assert_eq!([picture.width, picture.height], [x1 - x0 + 1, y1 - y0 + 1].map(|side| side as usize));
        let mut pixels = picture.radiance.iter();
        for (x, y) in (y0..=y1).flat_map(|y| (x0..=x1).map(move |x| (x, y))) {
            let is_there = (data[0][0]..=data[1][0]).contains(&x) && (data[0][1]..=data[1][1]).contains(&y);
            let wanted = if is_there { [x as f32, y as f32, 1.0] } else { [0.0; 3] };
            assert_eq!(pixels.next(), Some(&wanted), "{data:?} in {display:?}: ({x}, {y})");
        }
        let own = image::decode_exr(&bytes, Path::new("a.exr")).unwrap();
        assert_eq!((own.radiance.len(), own.radiance[0][2]), (own.width * own.height, 1.0));
        assert_eq!(own.radiance[0][..2], data[0].map(|at| at as f32));
    }
    // 16 bytes of pixels do not need 3 GB
    let error =
        etendue_scene::image::decode(Path::new("a.exr"), &windows([[0, 0], [0, 0]], [[0, 0], [16_383, 16_383]]))
            .unwrap_err();
    assert!(error.to_string().starts_with("a.exr: damaged: 16384 × 16384 pixels"), "{error}");
}

/// A part of an image is written in its place, from where it is read again.
#[test]
fn parts_have_places() {
    let second = |i: u32| Second { mean: [1.5, i as f32, 2.0], weight: (i % 3) as f32 };
    let pixel = |i: u32| Pixel { mean: [i as f32, 1.0, 2.0], variance: [0.5; 3], samples: i, second: second(i) };
    let film = Film { width: 10, height: 4, pixels: (0..40).map(pixel).collect() };
    let (technique, sampler) = (Technique::Auto, Sampler::Sobol);
    let settings = Settings { width: 10, height: 4, spp: 4, technique, sampler, ..Settings::DEFAULT };
    let identity = Identity::new(&etendue_scene::load("quads").unwrap(), settings, Sensor::Radiance);
    let file = std::env::temp_dir().join(format!("etendue-place-{}.exr", std::process::id()));
    for (place, start, whole) in [
        (Some(PlaceInImage { start: [10, 5], whole: [64, 32] }), [10, 5], [64, 32]),
        (Some(PlaceInImage { start: [54, 28], whole: [64, 32] }), [54, 28], [64, 32]),
        (None, [0, 0], [10, 4]),
    ] {
        let identity = Identity { place, ..identity.clone() };
        identity.write_image(&file, &film.pixels).unwrap();
        assert_eq!(Identity::scene_of(&file), Some([identity.scene.clone(), identity.digest.clone()]));
        let header = MetaData::read_from_file(&file, false).unwrap().headers[0].clone();
        let display = header.shared_attributes.display_window;
        assert_eq!((display.position, display.size), (Vec2(0, 0), Vec2(whole[0], whole[1])));
        assert_eq!(header.own_attributes.layer_position, Vec2(start[0], start[1]));
        assert_eq!(header.layer_size, Vec2(10, 4));
        assert_eq!(image::read_exr(&file).unwrap(), image::Picture::from(&film));
        let picture = etendue_scene::image::read(&file).unwrap();
        assert_eq!([picture.width, picture.height], whole);
        let at = |x: usize, y: usize| picture.radiance[y * whole[0] + x];
        assert_eq!(at(start[0] as usize + 3, start[1] as usize + 2), [23.0, 1.0, 2.0]);
        assert_eq!(picture.radiance.iter().map(|rgb| rgb[1]).sum::<f32>(), 40.0);
    }
    // a damaged header is an error that names the file and says more than a number, or the image is read
    let bytes = std::fs::read(&file).unwrap();
    let refused = (0..900).flat_map(|at| [(at, at % 8), (at, 4)]).filter(|(at, bit)| {
        let mut damaged = bytes.clone();
        damaged[*at] ^= 1 << bit;
        let Err(error) = image::decode_exr(&damaged, Path::new("a.exr")) else { return false };
        let error = error.to_string();
        let what = error.strip_prefix("a.exr: ").unwrap_or_default();
        let is_explained = what.len() > 10 && !what.contains("os error") && !what.contains("missing bytes");
        assert!(is_explained, "byte {at}, bit {bit}: {error}");
        true
    });
    assert!(refused.count() > 450);
    std::fs::remove_file(&file).unwrap();
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
        let picture = etendue_scene::image::decode(Path::new("plain.exr"), &bytes).unwrap();
        println!("{compression}: {:.0} to 1", (1024 * 1024 * 12) as f64 / bytes.len() as f64);
        assert_eq!((picture.width, picture.height, picture.radiance[7_000]), (1024, 1024, [0.25, 0.5, 0.75]));
    }
    let white = vec![[255; 3]; 2000 * 1000];
    let bytes = image::encode_png([2000, 1000], &white).unwrap();
    assert_eq!(etendue_scene::image::decode(Path::new("plain.png"), &bytes).unwrap().radiance[7], [1.0; 3]);
}

/// Found by fuzzing: a file of 600 bytes for which 2.7 GB were allocated.
#[test]
fn a_size_that_the_file_cannot_hold_is_an_error() {
    let bytes = include_bytes!("../../fuzz/seeds/image/oversized");
    let error = etendue_scene::image::decode(Path::new("large.exr"), bytes).unwrap_err().to_string();
    assert_eq!(error, "large.exr: 64 × 67108802 pixels: at most 268435456 are supported");
    // changes the last coordinates of the data window of a valid file
    let mut bytes = plain(64, Compression::ZIP16);
    let window = bytes.windows(10).position(|w| w == b"dataWindow").unwrap() + 10 + 1 + 6 + 4;
    assert_eq!(bytes[window + 8..window + 16], [63, 0, 0, 0, 63, 0, 0, 0]);
    bytes[window + 9] = 0xff;
    let error = etendue_scene::image::decode(Path::new("wide.exr"), &bytes).unwrap_err().to_string();
    assert!(
        error.starts_with("wide.exr: damaged: 65344 × 64 pixels, 50184192 bytes, do not fit into a file of "),
        "{error}"
    );
    bytes[window + 9..window + 16].copy_from_slice(&[0xff, 0xff, 0, 63, 0xff, 0xff, 0]);
    let error = etendue_scene::image::decode(Path::new("huge.exr"), &bytes).unwrap_err().to_string();
    assert_eq!(error, "huge.exr: 16777024 × 16777024 pixels: at most 268435456 are supported");
}

/// Found by fuzzing: an HDR image without rows, whose mean is 0/0.
#[test]
fn an_image_of_nothing_is_an_error() {
    let bytes = include_bytes!("../../fuzz/seeds/image/zero-rows");
    let error = etendue_scene::image::decode(Path::new("flat.hdr"), bytes).unwrap_err().to_string();
    assert_eq!(error, "flat.hdr: the image is empty: 4 × 0 pixels");
}

fn pfm(header: &str, numbers: &[f32], little: bool) -> Result<Picture, String> {
    let bytes = numbers.iter().flat_map(|x| if little { x.to_le_bytes() } else { x.to_be_bytes() });
    let bytes: Vec<u8> = header.bytes().chain(bytes).collect();
    etendue_scene::image::decode(Path::new("a.pfm"), &bytes).map_err(|error| error.to_string())
}

#[test]
fn rows_of_pfm_files_begin_at_the_bottom_in_either_order_of_bytes() {
    let numbers: Vec<f32> = (0..12_u8).map(f32::from).collect();
    for (header, little, factor) in [("PF\n2 2\n-1.0\n", true, 1.0), ("PF 2 2 2\n", false, 2.0)] {
        let picture = pfm(header, &numbers, little).unwrap();
        let wanted = [[6.0, 7.0, 8.0], [9.0, 10.0, 11.0], [0.0, 1.0, 2.0], [3.0, 4.0, 5.0]];
        assert_eq!((picture.width, picture.height), (2, 2));
        assert_eq!(picture.radiance, wanted.map(|rgb: [f32; 3]| rgb.map(|x| factor * x)));
    }
    assert_eq!(pfm("Pf\n1 2\n-1\n", &[3.0, 4.0], true).unwrap().radiance, [[4.0; 3], [3.0; 3]]);
    assert!(pfm("P6 1 1 255\n", &[], true).unwrap_err().contains("not a picture"));
}

#[test]
fn damaged_pfm_files_are_refused() {
    for (header, what) in [
        ("PF\n-2 2\n-1\n", "width is \"-2\""),
        ("PF\n2 x\n-1\n", "height is \"x\""),
        ("PF\n2 2\n0\n", "scale is \"0\""),
        ("PF\n2 2\nnan\n", "scale is \"nan\""),
        ("PF\n0 2\n1\n", "empty"),
        ("PF\n2 2\n1\n", "of 0 bytes instead of 48"),
        ("PF\n60000 60000\n1\n", "pixels"),
        ("PF\n", "width is \"\""),
    ] {
        let message = pfm(header, &[], true).unwrap_err();
        assert!(message.contains(what), "{header:?}: {message}");
    }
}

#[test]
fn textures_are_read_from_jpeg_and_tga_files() {
    let bytes_of = |image: &DynamicImage, format: ImageFormat| {
        let mut bytes = Cursor::new(Vec::new());
        image.write_to(&mut bytes, format).unwrap();
        bytes.into_inner()
    };
    let read = |name: &str, bytes: &[u8], encoding| read_texels(Path::new(name), bytes, encoding).unwrap().0;
    // of one colour, which JPEG keeps nearly
    let image = DynamicImage::ImageRgb8(image_files::RgbImage::from_pixel(20, 12, image_files::Rgb([200, 100, 50])));
    let texels = read("a.jpg", &bytes_of(&image, ImageFormat::Jpeg), TexelEncoding::Srgb);
    let Colors::Srgb(colors) = &texels.colors else { panic!("{texels:?}") };
    assert_eq!((texels.width, texels.height, colors.len(), &texels.alpha), (20, 12, 240, &None));
    assert!(colors.iter().all(|c| (0..3).all(|k| c[k].abs_diff([200, 100, 50][k]) <= 3)), "{:?}", colors[0]);
    let mut image = image_files::RgbaImage::from_pixel(3, 2, image_files::Rgba([200, 100, 50, 7]));
    image.put_pixel(2, 1, image_files::Rgba([0, 51, 255, 9]));
    let bytes = bytes_of(&DynamicImage::ImageRgba8(image), ImageFormat::Tga);
    let texels = read("a.TGA", &bytes, TexelEncoding::Linear);
    let last = Colors::Linear([vec![[200, 100, 50]; 5], vec![[0, 51, 255]]].concat());
    assert!(texels.colors == last && texels.alpha == Some(vec![7, 7, 7, 7, 7, 9]), "{texels:?}");
    let Colors::Float(colors) = read("a.tga", &bytes, TexelEncoding::Gamma(2.0)).colors else { panic!() };
    assert!(colors[5][0] == 0.0 && (colors[5][1] - 0.04).abs() < 1e-6 && colors[5][2] == 1.0, "{:?}", colors[5]);
    // TGA has no signature: only its name tells
    assert!(read_texels(Path::new("a"), &bytes, TexelEncoding::Srgb).is_err());
}
