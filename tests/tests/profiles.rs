//! Intensity profiles and projected images against definitions in double precision, and by quadrature.

use core::f64::consts::{PI, TAU};
use etendue::discrete::TableError;
use etendue::light::{EnvironmentMap, ImageEnvironment, Profile, ProfileError, ProjectedImage, Projector};
use etendue::{LightSampler, Mask, PointLight, Real, Vec2, Vec3, Warp, f32x8, f32x16};
use etendue_oracle::tier::cases;
use etendue_oracle::{V3, length, sub};
use etendue_properties::generators::Random;
use etendue_properties::properties::{Coordinates, squares_of};

/// A table that owns its numbers.
#[derive(Debug)]
struct Table {
    polar: Vec<f32>,
    azimuth: Vec<f32>,
    values: Vec<f32>,
}

impl Table {
    fn profile(&self) -> Profile<'_> {
        Profile::new(&self.polar, &self.azimuth, &self.values).unwrap()
    }
    /// Some table; of every third, the azimuths do not go all around.
    fn random(random: &mut Random, kind: usize) -> Self {
        let mut angles = |low: f64, high: f64, most: f64| {
            let count = random.range(0.0, most) as usize;
            let mut all: Vec<f32> = (0..count).map(|_| random.range(low, high) as f32).collect();
            all.extend([low as f32, high as f32]);
            all.sort_by(f32::total_cmp);
            all.dedup();
            all
        };
        let polar = match kind % 4 {
            0 => angles(0.0, 180.0, 9.0),
            1 => angles(0.0, 90.0, 5.0),
            2 => angles(90.0, 180.0, 5.0),
            _ => angles(20.0, 71.0, 3.0),
        };
        let azimuth = match kind % 3 {
            0 => vec![0.0],
            1 => angles(0.0, 360.0, 9.0),
            _ => angles(-90.0, 90.0, 4.0),
        };
        let mut values: Vec<f32> =
            (0..polar.len() * azimuth.len()).map(|_| (random.range(-1.0, 2.0) as f32).max(0.0)).collect();
        values[0] = 1.0;
        Self { polar, azimuth, values }
    }
    /// Value at angles in degrees, by a search from the start.
    fn at(&self, polar: f64, azimuth: f64) -> f64 {
        let n = self.polar.len();
        let wide = |angles: &[f32]| -> Vec<f64> { angles.iter().map(|&a| f64::from(a)).collect() };
        let (rows, columns) = (wide(&self.polar), wide(&self.azimuth));
        let Some(j) = (0..n - 1).find(|&j| rows[j] <= polar && polar <= rows[j + 1]) else { return 0.0 };
        let t = (polar - rows[j]) / (rows[j + 1] - rows[j]);
        let value =
            |i: usize| f64::from(self.values[i * n + j]) * (1.0 - t) + f64::from(self.values[i * n + j + 1]) * t;
        if columns.len() == 1 {
            return value(0);
        }
        for azimuth in [azimuth, azimuth - 360.0] {
            if let Some(i) = (0..columns.len() - 1).find(|&i| columns[i] <= azimuth && azimuth <= columns[i + 1]) {
                let s = (azimuth - columns[i]) / (columns[i + 1] - columns[i]);
                return value(i) * (1.0 - s) + value(i + 1) * s;
            }
        }
        0.0
    }
    fn angles(w: V3) -> [f64; 2] {
        [w[0].hypot(w[1]).atan2(w[2]).to_degrees(), w[1].atan2(w[0]).to_degrees().rem_euclid(360.0)]
    }
    /// ∫ I dω between angles, by the midpoint rule between the angles of the table.
    fn integral(&self, polar: [f64; 2], azimuth: [f64; 2]) -> f64 {
        let cut = |range: [f64; 2], at: &[f32], steps: usize| {
            let mut cuts: Vec<f64> = at.iter().flat_map(|&a| [f64::from(a), f64::from(a) + 360.0]).collect();
            cuts.extend(range);
            cuts.retain(|a| (range[0]..=range[1]).contains(a));
            cuts.sort_by(f64::total_cmp);
            let pairs: Vec<[f64; 2]> = cuts.windows(2).map(|pair| [pair[0], pair[1]]).collect();
            pairs.into_iter().flat_map(move |[a, b]| {
                (0..steps).map(move |k| (a + (b - a) * (k as f64 + 0.5) / steps as f64, (b - a) / steps as f64))
            })
        };
        let mut sum = 0.0;
        for (theta, height) in cut(polar, &self.polar, 400) {
            let across: f64 = cut(azimuth, &self.azimuth, 1).map(|(phi, width)| width * self.at(theta, phi)).sum();
            sum += across * height * theta.to_radians().sin();
        }
        sum * (PI / 180.0).powi(2)
    }
}

fn directions(random: &mut Random, count: usize) -> Vec<V3> {
    let mut all = vec![[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [1.0, -0.0, 0.0], [-1.0, -0.0, 0.0]];
    all.extend((0..count).map(|_| random.direction().map(|x| f64::from(x as f32))));
    all
}

/// Bilinear between angles, in both precisions, also at poles and seams; packets have the same bits.
#[test]
fn intensity_is_that_of_the_table() {
    let mut random = Random::new(3);
    for kind in 0..cases(60, 600) {
        let table = Table::random(&mut random, kind);
        let profile = table.profile();
        for w in directions(&mut random, 200) {
            let [polar, azimuth] = Table::angles(w);
            // the value, and those within the rounding of the angles: at its edges, a table is not continuous
            let truths = |slack: f64, of_value: f64| {
                let sides = [-slack, 0.0, slack];
                let across = slack / polar.to_radians().sin().max(slack.to_radians());
                let azimuths = [-across.min(180.0), 0.0, across.min(180.0)].map(|d| (azimuth + d).rem_euclid(360.0));
                let near: Vec<f64> = sides
                    .into_iter()
                    .flat_map(|d| azimuths.map(|a| table.at((polar + d).clamp(0.0, 180.0), a)))
                    .collect();
                let [low, high] = [f64::min, f64::max].map(|f| near.iter().copied().reduce(f).unwrap());
                [low - of_value, high + of_value]
            };
            let [low, high] = truths(1e-6_f64.to_degrees(), 4e-7 * 2.0);
            let narrow = f64::from(profile.intensity::<f32>(Coordinates::gather(&[w])));
            assert!((low..=high).contains(&narrow), "{narrow} at {w:?}, expected {low} to {high}: {table:?}");
            let [low, high] = truths(1e-12, 1e-14);
            let wide = profile.intensity(Vec3::<f64>::new(w[0], w[1], w[2]));
            assert!((low..=high).contains(&wide), "{wide} at {w:?}, expected {low} to {high}: {table:?}");
        }
        for _ in 0..8 {
            let w = directions(&mut random, 11);
            let (eight, sixteen): (Vec3<f32x8>, Vec3<f32x16>) = (Coordinates::gather(&w[..8]), Coordinates::gather(&w));
            let (eight, sixteen) = (profile.intensity(eight), profile.intensity(sixteen));
            for (lane, w) in w.iter().enumerate() {
                let alone = profile.intensity::<f32>(Coordinates::gather(&[*w]));
                assert_eq!(alone.to_bits(), sixteen.lane(lane).to_bits());
                assert!(lane >= 8 || alone.to_bits() == eight.lane(lane).to_bits());
            }
        }
    }
}

/// The power has a closed form for tables that are linear in the polar angle; elsewhere quadrature tells it, and that of each texel.
#[test]
fn powers_and_means_are_integrals() {
    let all_around = Profile::new(&[0.0, 180.0], &[0.0], &[2.0, 2.0]).unwrap();
    assert!((all_around.power() - 8.0 * PI).abs() < 1e-13);
    // ∫ (1 − θ/b) sinθ dθ from 0 to b is 1 − sin b/b
    for b in [1.0_f32, 20.0, 90.0, 135.0, 180.0] {
        let polar = [0.0, b];
        let cone = Profile::new(&polar, &[0.0], &[3.0, 0.0]).unwrap();
        let radians = f64::from(b).to_radians();
        let truth = 3.0 * TAU * (1.0 - radians.sin() / radians);
        assert!((cone.power() / truth - 1.0).abs() < 1e-12, "{b}: {} for {truth}", cone.power());
    }
    let mut random = Random::new(5);
    for kind in 0..cases(12, 60) {
        let table = Table::random(&mut random, kind);
        let profile = table.profile();
        let truth = table.integral([0.0, 180.0], [0.0, 360.0]);
        assert!((profile.power() / truth - 1.0).abs() < 1e-5, "{} for {truth}: {table:?}", profile.power());
        let (width, height) = (5, 7);
        let mut means = [0.0; 35];
        profile.means(width, &mut means).unwrap();
        let mut sum = 0.0;
        for (i, &mean) in means.iter().enumerate() {
            let (x, y) = ((i % width) as f64, (i / width) as f64);
            let (rows, columns) = (180.0 / height as f64, 360.0 / width as f64);
            let truth = table.integral([y * rows, (y + 1.0) * rows], [x * columns, (x + 1.0) * columns]);
            let solid_angle = EnvironmentMap::Equirectangular.texel_solid_angle(width, height, i / width);
            sum += f64::from(mean) * solid_angle;
            assert!((f64::from(mean) * solid_angle - truth).abs() < 2e-5 * truth + 1e-7, "{mean} in {i}: {table:?}");
        }
        assert!((sum / profile.power() - 1.0).abs() < 1e-6);
    }
}

/// Every direction with an intensity can be drawn, the inverse returns what was drawn, and the estimator of the power is right.
#[test]
fn emission_is_sampled_wherever_there_is_light() {
    let mut random = Random::new(7);
    for kind in 0..cases(24, 240) {
        let table = Table::random(&mut random, kind);
        let profile = table.profile();
        let (width, height) = (16, 12);
        let mut means = vec![0.0; width * height];
        profile.means(width, &mut means).unwrap();
        let mut buffer = vec![0.0; ImageEnvironment::buffer(width, height)];
        let emission = ImageEnvironment::build(&means, width, EnvironmentMap::Equirectangular, &mut buffer).unwrap();
        for w in directions(&mut random, 300) {
            let w: Vec3<f32> = Coordinates::gather(&[w]);
            // at the pole, and at an edge that rounding misses, there is nothing to draw
            let lit = profile.intensity(w) > 1e-3;
            assert!(!lit || emission.pdf(w) > 0.0, "{w:?} is dark: {table:?}");
        }
        let (mut sum, mut squares, n) = (0.0, 0.0, 64);
        for i in 0..n * n {
            let u = [(i % n) as f64, (i / n) as f64].map(|k| ((k + random.unit_f64()) / n as f64) as f32);
            let drawn = emission.draw(squares_of::<f32>(&[u]));
            let value = f64::from(profile.intensity(drawn.light.direction) / drawn.light.pdf);
            sum += value;
            squares += value * value;
        }
        let count = (n * n) as f64;
        let mean = sum / count;
        let deviation = ((squares / count - mean * mean).max(0.0) / count).sqrt();
        assert!((mean - profile.power()).abs() < 5.0 * deviation + 1e-4 * mean, "{mean} for {}", profile.power());
    }
}

/// Beyond the cone all is dark; within, the last angle counts.
#[test]
fn cones_contain_the_light() {
    let mut random = Random::new(9);
    for kind in 0..cases(60, 600) {
        let table = Table::random(&mut random, kind);
        let profile = table.profile();
        for w in directions(&mut random, 200) {
            let w: Vec3<f32> = Coordinates::gather(&[w]);
            assert!(profile.intensity(w) == 0.0 || w.z >= profile.cos_cone(), "{w:?}: {table:?}");
        }
    }
    let cone = |polar: &[f32], values: &[f32]| Profile::new(polar, &[0.0], values).unwrap().cos_cone();
    assert_eq!(cone(&[0.0, 90.0], &[1.0, 1.0]), 0.0);
    assert_eq!(cone(&[0.0, 60.0, 90.0], &[1.0, 0.0, 0.0]), 0.5);
    assert_eq!(cone(&[0.0, 60.0, 180.0], &[1.0, 1.0, 0.0]), -1.0);
    assert_eq!(cone(&[0.0, 60.0], &[0.0, 0.0]), 1.0);
}

#[test]
fn tables_that_are_none_are_refused() {
    let error = |polar: &[f32], azimuth: &[f32], values: &[f32]| Profile::new(polar, azimuth, values).err();
    let one = [1.0; 4];
    assert_eq!(error(&[0.0], &[0.0], &one[..1]), Some(ProfileError::Length));
    assert_eq!(error(&[0.0, 1.0], &[], &[]), Some(ProfileError::Length));
    assert_eq!(error(&[0.0, 1.0], &[0.0], &one), Some(ProfileError::Length));
    for polar in [[0.0, 0.0], [1.0, 0.0], [-1.0, 2.0], [0.0, 181.0], [f32::NAN, 1.0], [0.0, f32::NAN]] {
        assert_eq!(error(&polar, &[0.0], &one[..2]), Some(ProfileError::Angle), "{polar:?}");
    }
    for azimuth in [[0.0, 0.0], [1.0, 2.0], [-360.0, 0.0], [-1.0, 359.5], [f32::NAN, 1.0], [0.0, f32::NAN]] {
        assert_eq!(error(&[0.0, 1.0], &azimuth, &one), Some(ProfileError::Angle), "{azimuth:?}");
    }
    for value in [-1.0, f32::NAN, f32::INFINITY, 2e37] {
        assert_eq!(error(&[0.0, 1.0], &[0.0], &[0.0, value]), Some(ProfileError::Value));
    }
    let profile = Profile::new(&[0.0, 1.0], &[0.0], &[0.0, 1.0]).unwrap();
    assert_eq!(
        [(0, 4), (3, 4), (1, 0)].map(|(w, n)| profile.means(w, &mut { one }[..n])),
        [Err(ProfileError::Length); 3]
    );
}

/// A point light with a profile: pdf distance²/intensity, and none where it is dark.
#[test]
fn point_lights_take_profiles() {
    let light = PointLight::<f32>::new([0.0, 0.0, 4.0].into());
    let at = |w: Vec3<f32>| if w.z < 0.0 { 0.5 } else { 0.0 };
    let below = light.by_profile([0.0; 3].into(), at).sample(Vec2::new(0.1, 0.2));
    assert_eq!((below.pdf, below.distance, below.valid(), below.delta), (32.0, 4.0, true, true));
    let above = light.by_profile([0.0, 0.0, 9.0].into(), at).sample(Vec2::new(0.1, 0.2));
    assert_eq!((above.pdf, above.valid(), above.weight()), (0.0, false, 0.0));
}

const PROJECTORS: [[f32; 2]; 5] = [[1.0, 1.0], [0.5, 0.1], [1e-3, 2e-3], [20.0, 0.3], [3.0, 100.0]];

/// Places and directions are inverse, packets have the same bits, and the solid angles of the texels sum to that of the image.
#[test]
fn projectors_map_the_image() {
    let mut random = Random::new(13);
    for tan_half in PROJECTORS {
        let projector = Projector { tan_half };
        let [across, up] = tan_half.map(f64::from);
        for _ in 0..cases(200, 20_000) {
            let uv = [random.unit_f64(), random.unit_f64()];
            let w = projector.direction(Vec2::<f64>::new(uv[0], uv[1]));
            // its point in the plane of the image
            let point = [w.x / w.z, w.y / w.z];
            assert!((point[0] - (2.0 * uv[0] - 1.0) * across).abs() < 1e-13 * across.max(1.0) * (1.0 + across));
            assert!((point[1] - (1.0 - 2.0 * uv[1]) * up).abs() < 1e-13 * up.max(1.0) * (1.0 + up));
            assert!((w.length() - 1.0).abs() < 1e-15 && w.z >= f64::from(projector.cos_cone()));
            let (back, inside) = projector.place(w);
            assert!(inside && (back.x - uv[0]).abs() < 1e-12 && (back.y - uv[1]).abs() < 1e-12, "{uv:?} {back:?}");
            let narrow: Vec3<f32> = Coordinates::gather(&[[w.x, w.y, w.z]]);
            let (back, inside) = projector.place(narrow);
            let slack = 3e-7 / w.z;
            let off = [f64::from(back.x) - uv[0], f64::from(back.y) - uv[1]];
            let edge = uv.iter().any(|&x| x < slack || x > 1.0 - slack);
            assert!(edge || inside && off.iter().all(|x| x.abs() < slack), "{uv:?} {back:?}");
        }
        for w in directions(&mut random, 300) {
            let (_, inside) = projector.place(Vec3::<f64>::new(w[0], w[1], w[2]));
            let there = w[2] > 0.0 && (w[0] / w[2]).abs() < across && (w[1] / w[2]).abs() < up;
            assert_eq!(inside, there, "{w:?}");
        }
        let w = directions(&mut random, 3);
        let w: Vec<V3> = w.into_iter().map(|w| [w[0] * 0.1, w[1] * 0.1, w[2]]).collect();
        let (uv, inside) = projector.place::<f32x8>(Coordinates::gather(&w));
        for (lane, w) in w.iter().enumerate() {
            let alone = projector.place::<f32>(Coordinates::gather(&[*w]));
            assert_eq!((uv.lane(lane).x, uv.lane(lane).y, inside.lane(lane)), (alone.0.x, alone.0.y, alone.1));
        }
        // Ω = 4 asin(sin α sin β) for half angles α and β of a pyramid
        let sin = |t: f64| t / t.hypot(1.0);
        let whole = 4.0 * (sin(across) * sin(up)).asin();
        for [w, h] in [[1, 1], [2, 3], [64, 33]] {
            let sum: f64 = (0..w * h).map(|i| projector.texel_solid_angle([w, h], [i % w, i / w])).sum();
            assert!((sum / whole - 1.0).abs() < 1e-9, "{tan_half:?}: {sum} for {whole}");
        }
    }
}

/// The pdf integrates to 1, is that of its own samples, and is positive at every texel with a weight; the inverse returns the number.
#[test]
fn projected_images_are_sampled() {
    let mut random = Random::new(17);
    for tan_half in PROJECTORS {
        let projector = Projector { tan_half };
        for (width, height) in [(1, 1), (3, 2), (8, 5)] {
            let weights: Vec<f32> =
                (0..width * height).map(|i| if i % 3 == 1 { 0.0 } else { random.range(0.1, 2.0) as f32 }).collect();
            let mut buffer = vec![0.0; ProjectedImage::buffer(width, height)];
            let image = ProjectedImage::build(projector, &weights, width, &mut buffer).unwrap();
            let solid_angle = |i: usize| projector.texel_solid_angle([width, height], [i % width, i / width]);
            let total: f64 = (0..width * height).map(|i| f64::from(weights[i]) * solid_angle(i)).sum();
            // ∫ pdf dω over each texel, in the plane of the image, is its share
            let steps = 40;
            for (i, &weight) in weights.iter().enumerate() {
                let mut integral = 0.0;
                for k in 0..steps * steps {
                    let at =
                        |cell: usize, k: usize, n: usize| (cell as f64 + (k as f64 + 0.5) / steps as f64) / n as f64;
                    let uv = Vec2::new(at(i % width, k % steps, width), at(i / width, k / steps, height));
                    let w = projector.direction::<f64>(uv);
                    let area =
                        4.0 * f64::from(tan_half[0]) * f64::from(tan_half[1]) / (width * height * steps * steps) as f64;
                    integral += image.pdf(w) * w.z.powi(3) * area;
                }
                let share = f64::from(weight) * solid_angle(i) / total;
                assert!((integral - share).abs() < 3e-7, "{tan_half:?}, texel {i}: {integral} for {share}");
                assert_eq!(integral > 0.0, weight > 0.0);
            }
            for _ in 0..cases(100, 10_000) {
                let u = [random.unit_f64(), random.unit_f64()];
                let w = image.sample(Vec2::<f64>::new(u[0], u[1]));
                let back = image.invert(w);
                assert!(image.pdf(w) > 0.0 && (back.x - u[0]).abs() + (back.y - u[1]).abs() < 1e-6, "{u:?} {back:?}");
                let narrow = image.sample(squares_of::<f32>(&[u.map(|x| x as f32)]));
                let off = length(sub(narrow.at(0), [w.x, w.y, w.z]));
                // where a texel has a small share, a step of u is wide
                let least = (0..width * height).map(solid_angle).filter(|s| *s > 0.0).fold(total, f64::min);
                assert!(off < 1e-5 * (1.0 + total / least).min(1e5), "{off}");
            }
            let eight: Vec<[f32; 2]> =
                (0..8).map(|_| [random.unit_f64(), random.unit_f64()].map(|x| x as f32)).collect();
            let many = image.sample(squares_of::<f32x8>(&eight));
            for (lane, u) in eight.iter().enumerate() {
                let alone = image.sample(squares_of::<f32>(&[*u]));
                assert_eq!(many.at(lane), alone.at(0));
                assert_eq!(image.pdf(many).lane(lane), image.pdf(alone));
            }
        }
        let mut buffer = [0.0; ProjectedImage::buffer(2, 1)];
        let error = |weights: &[f32], buffer: &mut [f32]| ProjectedImage::build(projector, weights, 2, buffer).err();
        assert_eq!(error(&[0.0; 2], &mut buffer), Some(TableError::Empty));
        assert_eq!(error(&[-1.0, 1.0], &mut buffer), Some(TableError::Weight));
        assert_eq!(error(&[1.0; 3], &mut buffer), Some(TableError::Length));
    }
}
