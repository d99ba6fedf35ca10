//! The image of the built-in scene `sky` matches its formula. `cargo test -p etendue-render-tests sky -- --ignored` writes it again.

use etendue::warp::Octahedral;
use etendue::{Vec2, Vec3, Warp};
use etendue_scene::image;
use exr::prelude::{f16, write_rgb_file};
use std::path::{Path, PathBuf};

const SIDE: usize = 64;

fn path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/sky.exr")
}

/// Radiance at the centre of a texel: a blue sky that fades towards the horizon, a brown ground, and a low sun with a soft edge.
fn texel(x: usize, y: usize) -> [f16; 3] {
    let at = |i: usize| (i as f64 + 0.5) / SIDE as f64;
    let w: Vec3<f64> = Octahedral.sample(Vec2::new(at(x), at(y)));
    let sun = Vec3::<f64>::new(-0.6, -0.5, 0.45).normalize();
    let disk = 60.0 * (-(1.0 - w.dot(sun)) / 0.002).exp() + 0.6 * (-(1.0 - w.dot(sun)) / 0.05).exp();
    let height = w.z.max(0.0);
    let pale = (-height / 0.3).exp();
    let rgb: [f64; 3] = std::array::from_fn(|k| {
        let (sky, horizon) = ([0.12, 0.25, 0.6][k], [0.55, 0.55, 0.5][k]);
        let above = sky + (horizon - sky) * pale + disk * [1.0, 0.8, 0.5][k];
        // the horizon is soft, since texels lie across it
        let ground = [0.09, 0.07, 0.05][k];
        ground + (above - ground) * ((w.z + 0.1) / 0.2).clamp(0.0, 1.0)
    });
    rgb.map(f16::from_f64)
}

#[test]
fn sky_image_is_its_formula() {
    let image = image::read(&path()).unwrap();
    assert_eq!((image.width, image.height), (SIDE, SIDE));
    for (i, found) in image.radiance.iter().enumerate() {
        let expected = texel(i % SIDE, i / SIDE).map(f16::to_f32);
        // the last bit of a half float may differ if the exponential does
        let near = (0..3).all(|k| (found[k] - expected[k]).abs() <= 1e-3 * expected[k]);
        assert!(near, "texel {i}: {found:?}, expected {expected:?}");
    }
}

#[test]
#[ignore = "writes the file that the other test reads"]
fn write_sky_image() {
    write_rgb_file(path(), SIDE, SIDE, |x, y| <(f16, f16, f16)>::from(texel(x, y))).unwrap();
}
