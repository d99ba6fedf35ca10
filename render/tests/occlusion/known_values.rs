//! Lights that are as small as a search by sampling or subdivision in double precision cannot know them, in double precision.

use etendue::{Vec3, f64x4};
use etendue_visible::{Occlusion, Solid, V64};

/// The greatest relative error allowed.
const BOUND: f64 = 1e-13;

/// The exact value of a point in single precision.
fn rounded(v: [f32; 3]) -> V64 {
    v.map(f64::from).into()
}

/// The projected solid angle of a light without occluders.
fn visible(p: [f64; 3], n: [f64; 3], light: &Solid) -> f64 {
    let vector = |v: [f64; 3]| Vec3::<f64x4>::from(v);
    let found = Occlusion::<f64x4>::default().visible(vector(p), vector(n), light, &[]);
    found.unwrap().to_array()[0]
}

/// The expected values have been computed with 60 digits by mpmath: by Lambert's formula, and as the integral over a sphere's cap.
#[test]
fn low_and_tiny_lights_agree_with_sixty_digits() {
    let sphere = Solid::Sphere { center: rounded([180.10497, 864.8909, 340.59827]), radius: f64::from(13.872385_f32) };
    let found = visible(
        [-296.53302001953125, 303.62445068359375, -89.92357635498047],
        [0.5438033938407898, 0.14724990725517273, -0.8261932730674744],
        &sphere,
    );
    assert!((found / 3.223_015_451_245_791_4e-13 - 1.0).abs() < BOUND, "{found:e}");
    let parallelogram = Solid::Parallelogram {
        corner: rounded([123_667.26, 369_362.0, -145_745.66]),
        edges: [
            rounded([-3.341_177e-5, 9.767_203e-6, -3.135_673_6e-5]),
            rounded([1.458_765_1e-5, -3.365_224_3e-5, 3.946_128_3e-5]),
        ],
    };
    let found = visible(
        [0.155_950_230_340_263_37, 2.099_579_887_726_577e-8, -0.082_525_029_778_480_53],
        [0.0, 1.0, 0.0],
        &parallelogram,
    );
    assert!((found / 1.137_104_394_009_954_315e-21 - 1.0).abs() < BOUND, "{found:e}");
}
