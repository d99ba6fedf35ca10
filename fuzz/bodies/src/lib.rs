//! Bodies of the fuzz targets of the renderer, scenes, images, certificates, visible parts, daylight and lights that emit
//! other than evenly, and of the C interface. `tests/seeds.rs` runs the same functions without a fuzzer.

mod c_interface;
mod certificates;
mod daylight;
mod emitters;
mod occlusion;

pub use c_interface::c_interface;
pub use certificates::certificates;
pub use daylight::daylight;
pub use emitters::emitters;
use etendue_judge::fuzz_bodies::Target;
use etendue_render::World;
use etendue_render::film::compare::Comparison;
use etendue_render::scene::texture::{Mapping, Picture, Texture, Wrap};
use etendue_scene::image::{self as images, Encoding};
pub use occlusion::occlusion;
use std::path::Path;

/// All targets; each seed has as many damaged copies in a test as its target's share.
pub const TARGETS: &[Target] = &[
    Target { name: "scene", body: scene, share: 500 },
    Target { name: "image", body: image, share: 200 },
    Target { name: "certificates", body: certificates, share: 3000 },
    Target { name: "daylight", body: daylight, share: 500 },
    Target { name: "emitters", body: emitters, share: 500 },
    Target { name: "occlusion", body: occlusion, share: 1000 },
    Target { name: "c_interface", body: c_interface, share: 600 },
];

/// Any text, and any glTF file, gives a scene, or an error with file and line, but never a panic; and a scene that was read can be built.
pub fn scene(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let is_gltf = bytes.starts_with(b"glTF") || text.trim_start().starts_with('{');
    let read = if is_gltf {
        etendue_scene::parse_gltf(bytes, "fuzz.pbrt")
    } else {
        etendue_scene::parse(&text, "fuzz.pbrt", Path::new("no such folder"))
    };
    match read {
        Ok(scene) => {
            assert!(scene.triangles.as_flattened().as_flattened().iter().all(|x| x.is_finite()));
            assert!(scene.triangle_materials.iter().all(|&k| (k as usize) < scene.materials.len()));
            assert!([0, scene.triangles.len()].contains(&scene.details.of_triangles.len()));
            drop(World::new(&scene));
        }
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
    // textures keep bytes, and may be of other formats
    for name in ["fuzz.png", "fuzz.tga"] {
        match images::read_texels(Path::new(name), bytes, Encoding::Srgb) {
            Ok((texels, _)) => {
                let texture = Picture {
                    texels: texels.into(),
                    mapping: Mapping::IDENTITY,
                    wrap: [Wrap::Repeat, Wrap::Black],
                    bilinear: true,
                };
                let value = Texture::Picture(texture).at([0.3, -0.6]);
                assert!(value.iter().all(|x| x.is_finite() && *x >= 0.0), "{value:?}");
            }
            Err(error) => assert!(error.to_string().starts_with(&format!("{name}: ")), "{error}"),
        }
    }
}
