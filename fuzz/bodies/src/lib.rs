//! Bodies of the fuzz targets of the renderer, scenes, images, parts of images and certificates, and of the C interface. `tests/seeds.rs` runs
//! the same functions without a fuzzer.

mod c_interface;
mod certificates;
mod part;

pub use c_interface::c_interface;
pub use certificates::certificates;
use etendue_render::compare::Comparison;
use etendue_render::{World, image as images, scene};
pub use part::part;
use std::path::Path;

/// Any text gives a scene, or an error with file and line, but never a panic; and a scene that was read can be built.
pub fn scene(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    match scene::parse(&text, "fuzz.pbrt", Path::new("no such folder")) {
        Ok(scene) => drop(World::new(&scene)),
        Err(error) => assert!(error.to_string().starts_with("fuzz.pbrt:"), "{error}"),
    }
}

/// Any bytes give an image, or an error with the file's name, but never a panic; and the image equals itself.
pub fn image(bytes: &[u8]) {
    match images::decode(Path::new("fuzz.exr"), bytes) {
        Ok(picture) => {
            assert_eq!(picture.radiance.len(), picture.width * picture.height);
            if let Ok(same) = Comparison::new(&picture, &picture, 0.0) {
                assert!(same.mse == 0.0, "{} from itself", same.mse);
            }
        }
        Err(error) => assert!(error.to_string().starts_with("fuzz.exr: "), "{error}"),
    }
}
