//! What the Python package must return bit by bit, computed by the core alone.

use etendue::light::*;
use etendue::reflection::Reflection;
use etendue::sequence::{Independent, OwenSobol, Sequence};
use etendue::warp::{CosineHemisphere, Warp};
use etendue::{LightSampler, Real, Vec2, Vec3};

/// The words of a sample.
fn words(s: &LightSample<f32>) -> [u32; 12] {
    let v = |v: Vec3<f32>| [v.x.to_bits(), v.y.to_bits(), v.z.to_bits()];
    let ([a, b, c], [d, e, f]) = (v(s.direction), v(s.normal));
    let [g, h, i, j, k] = [s.distance, s.pdf, s.weight(), s.uv.x, s.uv.y].map(f32::to_bits);
    [a, b, c, g, h, i, d, e, f, j, k, u32::from(s.emits)]
}
/// FNV-1a over words.
fn hash(words: impl IntoIterator<Item = u32>) -> u64 {
    let step = |hash: u64, word: u32| (hash ^ u64::from(word)).wrapping_mul(0x0100_0000_01b3);
    words.into_iter().fold(0xcbf2_9ce4_8422_2325, step)
}
fn pair(pixel: u32, sample: u32, dimension: u32) -> Vec2<f32> {
    Independent::new(7).pair(pixel, sample, dimension)
}

/// What `sample`, `hit`, `pdf` and `invert` return for numbers and for directions all around.
fn everything(sampler: &impl LightSampler<f32>) -> Vec<u32> {
    let mut all = Vec::new();
    for i in 0..64 {
        let s = sampler.sample(pair(1, i, 0));
        all.extend(words(&s));
        for w in [s.direction, etendue::warp::UniformSphere.sample(pair(2, i, 0))] {
            let (hit, pdf, u) = (sampler.hit(w), sampler.pdf(w), sampler.invert(w));
            all.extend(words(&hit));
            all.push(pdf.to_bits());
            // any number where the direction misses the light
            all.extend([u.x, u.y].map(|x| if pdf > 0.0 { x.to_bits() } else { 0 }));
        }
    }
    all
}

/// A convex polygon of N corners on an ellipse, in some plane, and the same with its last corner repeated up to eight.
fn polygons<const N: usize>(case: u32) -> (Polygon<f32, N>, Polygon<f32, 8>) {
    let number = |k: u32| 2.0 * pair(case, k, 3).x - 1.0;
    let vector = |k: u32| Vec3::new(number(k), number(k + 1), number(k + 2));
    let (center, a, b) = (vector(0) + Vec3::new(0.0, 1.5, 0.0), vector(3), vector(6));
    let mut angles: [f32; N] = core::array::from_fn(|i| (i as f32 + 0.9 * pair(case, i as u32, 4).x) / N as f32);
    angles.sort_by(f32::total_cmp);
    let corner = |turns: f32| {
        let (sin, cos) = Real::sin_cos_turns(turns);
        center + a * cos + b * sin
    };
    let corners = angles.map(corner);
    (Polygon::new(corners), Polygon::new(core::array::from_fn(|i| corners[i.min(N - 1)])))
}

/// How many of 200 polygons return other bits by area and by solid angle.
fn differing<const N: usize>() -> [usize; 2] {
    let p = Vec3::new(0.1, 0.2, 0.3);
    let (mut differ, mut seen) = ([0; 2], 0);
    for case in 0..200 {
        let (native, padded) = polygons::<N>(case);
        seen += usize::from(native.by_solid_angle(p).solid_angle() > 0.0);
        let area = everything(&native.by_area(p)) != everything(&padded.by_area(p));
        let solid = everything(&native.by_solid_angle(p)) != everything(&padded.by_solid_angle(p));
        for (count, differs) in differ.iter_mut().zip([area, solid]) {
            *count += usize::from(differs);
        }
    }
    assert!(seen > 100, "only {seen} polygons are seen");
    differ
}

/// Repeating the last corner changes no bit by area and by solid angle. By projected solid angle it changes the last bits of some.
#[test]
fn polygons_are_padded() {
    let differ = [differing::<3>(), differing::<4>(), differing::<5>(), differing::<6>(), differing::<7>()];
    assert_eq!(differ, [[0; 2]; 5], "by area and by solid angle");
}

/// `test_package.py` reads them here.
#[test]
fn hashes() {
    let (p, n) = (Vec3::new(0.1, 0.2, 0.3), Vec3::new(0.0, 0.8, 0.6));
    let triangle = Triangle::new(Vec3::new(0.0, 2.0, 0.0), Vec3::new(1.0, 2.5, 0.0), Vec3::new(0.0, 2.0, 1.0));
    let sphere = Sphere::new(Vec3::new(0.3, 1.5, 0.2), 0.4);
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.5, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let polygon = Polygon::new(corners.map(|[x, z]| Vec3::new(x, 2.0, z)));
    let samples = |sampler: &dyn LightSampler<f32>| hash((0..1000).flat_map(|i| words(&sampler.sample(pair(3, i, 0)))));
    let sobol = |i: u32| {
        let u: Vec2<f32> = OwenSobol::new(1).pair(5, i, 2);
        [u.x.to_bits(), u.y.to_bits()]
    };
    let cosine = |i: u32| {
        let w = CosineHemisphere.sample(pair(3, i, 0));
        [w.x.to_bits(), w.y.to_bits(), w.z.to_bits()]
    };
    let lobe = Reflection::new(0.5, n, Vec3::new(0.0, 1.0, 0.0));
    let reflected = |i: u32| {
        let w = lobe.sample(pair(3, i, 0));
        [w.x.to_bits(), w.y.to_bits(), w.z.to_bits()]
    };
    let covered = |i: u32| lobe.sphere(etendue::warp::UniformSphere.sample(pair(3, i, 0)), 0.4).to_bits();
    let (corner, s, t) = (Vec3::new(0.0, 2.0, 0.0), Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 1.0));
    let padded: Polygon<f32, 8> = Polygon::new(core::array::from_fn(|i| polygon.corners[i.min(4)]));
    let found = [
        hash((0..1000).flat_map(sobol)),
        hash((0..1000).flat_map(cosine)),
        samples(&triangle.by_area(p)),
        samples(&triangle.by_solid_angle(p)),
        samples(&triangle.by_projected_solid_angle(p, n)),
        samples(&sphere.by_solid_angle(p)),
        samples(&polygon.by_solid_angle(p)),
        hash((0..1000).flat_map(reflected)),
        hash((0..1000).map(covered)),
        samples(&triangle.by_reflection(p, &lobe)),
        samples(&Parallelogram::new(corner, s, t).by_reflection(p, &lobe)),
        samples(&Rectangle::new(corner, s, t).by_reflection(p, &lobe)),
        samples(&padded.by_reflection(p, &lobe)),
    ];
    assert_eq!(found, HASHES, "{found:#018x?}");
}

/// Owen-Sobol pairs, the cosine hemisphere, triangles by area, by solid angle and by projected solid angle, a sphere and a polygon by solid
/// angle, directions and spheres of a reflection, and a triangle, a parallelogram, a rectangle and a padded polygon by it.
const HASHES: [u64; 13] = [
    0x439e_036c_2d2d_0933,
    0x49d5_0300_2e88_bf3e,
    0x816c_598b_e881_736f,
    0x5094_e656_c94e_e85f,
    0x97c5_a8d1_d416_3335,
    0x88da_275c_ede7_2706,
    0xf609_1c96_d970_2b83,
    0x6072_b659_d515_b1d3,
    0x42fd_24ad_be55_7f13,
    0xf15d_28f8_ea13_59ca,
    0x3d23_c8a9_a74a_db47,
    0x3d23_c8a9_a74a_db47,
    0x4f71_1318_6901_c3e9,
];

/// The same hashes are in `test_images.py`.
#[test]
fn hashes_of_images() {
    let (p, n) = (Vec3::new(0.1, 0.2, 0.3), Vec3::new(0.0, 0.8, 0.6));
    let weights = [0.0, 1.0, 0.3, 1e-3, 7.0, 2.0, 0.0, 0.5, 3.0, 1.0, 4.0, 0.25, 1.0, 0.0, 6.0];
    let mut buffers = ([0.0; Picture::buffer(5, 3)], [0.0; Picture::buffer(6, 4)]);
    let picture = Picture::build(&weights, 5, Region::Square, &mut buffers.0).unwrap();
    let smooth = Picture::interpolated(&weights, 5, &mut buffers.1).unwrap();
    let (corner, s, t) = (Vec3::new(-0.5, 2.0, -0.3), Vec3::new(0.1, 0.2, 1.1), Vec3::new(1.2, 0.1, 0.2));
    let panel = Parallelogram { corner, edge_s: s, edge_t: t };
    let sphere = Sphere::new(Vec3::new(0.3, 2.0, 0.1), 0.5);
    let mut sums = [0; PortalTable::buffer(5, 3)];
    let tables = [PortalTable::build(&weights, 5, &mut sums).unwrap(); 2];
    let portals = [[-0.5, 1.0, -0.5], [0.25, 1.5, 0.0]]
        .map(|corner| Portal::new(corner, [0.0, 0.25, 1.0], [1.0, 0.0, 0.0]).unwrap());
    let sky = PortalEnvironment::new(&portals, &tables).unwrap();

    let samples = |sampler: &dyn LightSampler<f32>| hash((0..1000).flat_map(|i| words(&sampler.sample(pair(3, i, 0)))));
    let found = [
        samples(&picture.on(panel).by_area(p)),
        samples(&picture.on(panel).by_solid_angle(p)),
        samples(&smooth.on(panel).by_projected_solid_angle(p, n)),
        samples(&smooth.on(sphere).by_visible_area(p)),
        samples(&sky.by_radiance(p)),
    ];
    assert_eq!(found, HASHES_OF_IMAGES, "{found:#018x?}");
}

/// Pictures on a parallelogram by area and by solid angle, interpolated ones by projected solid angle and on a sphere,
/// portals.
const HASHES_OF_IMAGES: [u64; 5] =
    [0xb3e9_a919_1528_b9b0, 0x76c9_25b0_f93d_98e2, 0x565a_a82d_44cd_ff91, 0x532b_a930_22b4_f2d6, 0x673f_edd3_2d64_ecd2];
