//! Glossy scenes by closed forms and by samples of the BSDF alone, which know nothing of each other, and rough metals in white rooms.

use etendue_oracle::integrate;
use etendue_oracle::tier::cases;
use etendue_render::scene::Scene;
use etendue_render::{Sampler, Settings, Technique, World};
use std::f64::consts::PI;
use std::fmt::Write;
use std::path::Path;

/// Sides of images and of their regions in pixels.
const SIDE: u32 = 32;
const REGION: u32 = 16;
/// Independent images.
const SEEDS: u32 = 32;
const REGIONS: usize = ((SIDE / REGION) * (SIDE / REGION)) as usize;

fn panel([p, u, v]: [[f64; 3]; 3], radiance: [f64; 3]) -> String {
    let mut numbers = String::new();
    for [s, t] in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]] {
        (0..3).for_each(|k| write!(numbers, "{} ", p[k] + s * u[k] + t * v[k]).unwrap());
    }
    let [r, g, b] = radiance;
    format!(
        "AttributeBegin Material \"diffuse\" \"rgb reflectance\" [0 0 0]\n\
         AreaLightSource \"diffuse\" \"rgb L\" [{r} {g} {b}] \"bool twosided\" true\n\
         Shape \"bilinearmesh\" \"point3 P\" [{numbers}] AttributeEnd\n"
    )
}

fn ball(center: [f64; 3], radius: f64, what: &str) -> String {
    let [x, y, z] = center;
    format!("AttributeBegin {what}\nTranslate {x} {y} {z} Shape \"sphere\" \"float radius\" {radius} AttributeEnd\n")
}

fn metal(reflectance: f64, alpha: f64) -> String {
    format!(
        "Material \"conductor\" \"rgb reflectance\" [{reflectance} {reflectance} {reflectance}] \"float roughness\" {alpha} \
         \"bool remaproughness\" false\n"
    )
}

const GROUND: &str = "Shape \"bilinearmesh\" \"point3 P\" [-30 0 30  30 0 30  -30 0 -30  30 0 -30]\n";
const GLOWING: &str = "Material \"diffuse\" \"rgb reflectance\" [0 0 0] AreaLightSource \"diffuse\" \"rgb L\" [6 5 4]";

/// A wet street at night: lamps above, shop windows beside and a sign at the end, behind cars.
fn street() -> String {
    let mut text = String::from(
        "LookAt 0 1.6 4  0 0 -1.5  0 1 0 Camera \"perspective\" \"float fov\" 30 WorldBegin\n\
         Material \"coateddiffuse\" \"rgb reflectance\" [0.06 0.06 0.07] \"float roughness\" 0.2 \"bool remaproughness\" false\n",
    );
    text += GROUND;
    for k in 0..5 {
        let z = -2.0 - 3.0 * f64::from(k);
        for x in [-3.0, 2.4] {
            text += &panel([[x, 3.5, z], [0.6, 0.0, 0.0], [0.0, 0.0, 0.8]], [12.0, 9.0, 5.0]);
        }
    }
    for z in [-5.0, -10.0] {
        text += &panel([[-4.0, 0.5, z], [0.0, 1.5, 0.0], [0.0, 0.0, 2.5]], [3.0, 3.0, 2.0]);
        text += &panel([[4.0, 0.5, z], [0.0, 1.5, 0.0], [0.0, 0.0, 2.5]], [1.0, 2.0, 4.0]);
    }
    text += &panel([[-1.0, 2.0, -14.0], [2.0, 0.0, 0.0], [0.0, 0.7, 0.0]], [8.0, 0.5, 0.5]);
    for [x, z] in [[-1.5, -3.0], [1.2, -6.0]] {
        writeln!(
            text,
            "AttributeBegin Material \"diffuse\" \"rgb reflectance\" [0.5 0.1 0.1] Translate {x} 0 {z} Scale 0.7 1 1.6\n\
             Shape \"trianglemesh\" \"point3 P\" [-.5 0 -.5  .5 0 -.5  -.5 1 -.5  .5 1 -.5  -.5 0 .5  .5 0 .5  -.5 1 .5  .5 1 .5]\n\
             \"integer indices\" [4 6 2  4 2 0  1 3 7  1 7 5  1 5 4  1 4 0  2 6 7  2 7 3  2 3 1  2 1 0  4 5 7  4 7 6] AttributeEnd"
        )
        .unwrap();
    }
    text
}

/// Metal spheres, from smooth to rough, on a metal ground, under a panel, a ball and a triangle.
fn spheres() -> String {
    let mut text = String::from("LookAt 0 3 7  0 0.6 0  0 1 0 Camera \"perspective\" \"float fov\" 32 WorldBegin\n");
    text += &metal(0.5, 0.5);
    text += GROUND;
    for (k, alpha) in [0.1, 0.2, 0.35, 0.6].into_iter().enumerate() {
        text += &ball([1.6 * k as f64 - 2.4, 0.7, 0.0], 0.7, &metal(0.9, alpha));
    }
    text += &panel([[-2.0, 4.0, -2.0], [3.0, 0.0, 0.0], [0.0, 0.0, 2.0]], [3.0; 3]);
    text += &ball([3.0, 3.0, 2.0], 0.8, GLOWING);
    text += "AttributeBegin Material \"diffuse\" \"rgb reflectance\" [0 0 0]\n\
             AreaLightSource \"diffuse\" \"rgb L\" [2 4 8] \"bool twosided\" true\n\
             Shape \"trianglemesh\" \"point3 P\" [-4 0.5 1  -4 3 -1  -3 0.5 -3] AttributeEnd\n";
    text
}

/// A metal ground seen from near the horizon, with lights that stand on it, cross it and are sunk in it.
fn horizon() -> String {
    let mut text = String::from("LookAt 0 0.5 6  0 0 3.2  0 1 0 Camera \"perspective\" \"float fov\" 12 WorldBegin\n");
    text += &metal(0.9, 0.25);
    text += GROUND;
    text += &panel([[-3.0, 0.0, -2.0], [2.0, 0.0, 0.0], [0.0, 1.5, 0.3]], [1.0, 2.0, 3.0]);
    text += &panel([[1.2, -0.5, -1.0], [1.5, 0.0, -0.8], [0.0, 1.5, 0.0]], [3.0, 1.5, 1.0]);
    text += &ball([0.0, 0.1, -1.0], 0.6, GLOWING);
    text
}

/// Means of the regions of an image, and of the whole, per channel.
type Means = [[f64; 3]; REGIONS + 1];

/// Images of independent seeds: their mean and the variance of that mean.
fn moments(world: &World, technique: Technique, spp: u32) -> [Means; 2] {
    let (mut sums, mut squares) = ([[0.0; 3]; REGIONS + 1], [[0.0; 3]; REGIONS + 1]);
    for seed in 0..SEEDS {
        let settings = Settings {
            width: SIDE,
            height: SIDE,
            spp,
            technique,
            depth: 1,
            seed: u64::from(seed) + 1000 * technique as u64,
            ..Settings::DEFAULT
        };
        let (film, _) = world.render(&settings, &|_| ());
        let mut means = [[0.0; 3]; REGIONS + 1];
        for (k, pixel) in (0..).zip(&film.pixels) {
            let [x, y] = [k % SIDE, k / SIDE].map(|at| at / REGION);
            for (channel, mean) in pixel.mean.into_iter().enumerate() {
                means[(y * (SIDE / REGION) + x) as usize][channel] += f64::from(mean) / f64::from(REGION * REGION);
                means[REGIONS][channel] += f64::from(mean) / f64::from(SIDE * SIDE);
            }
        }
        for (k, channel) in (0..=REGIONS).flat_map(|k| [0, 1, 2].map(|channel| (k, channel))) {
            sums[k][channel] += means[k][channel];
            squares[k][channel] += means[k][channel] * means[k][channel];
        }
    }
    let count = f64::from(SEEDS);
    let means = sums.map(|region| region.map(|sum| sum / count));
    let mut variances = [[0.0; 3]; REGIONS + 1];
    for (k, channel) in (0..=REGIONS).flat_map(|k| [0, 1, 2].map(|channel| (k, channel))) {
        let mean = means[k][channel];
        variances[k][channel] = (squares[k][channel] / count - mean * mean).max(0.0) / (count - 1.0);
    }
    [means, variances]
}

/// A scene of a file, with another camera, so that no light is in the image: most of the noise would be that of its edges.
fn from_near(file: &str, camera: [&str; 2], fov: [&str; 2]) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.contains(camera[0]) && text.contains(fov[0]), "{file} has another camera");
    parsed(&text.replace(camera[0], camera[1]).replace(fov[0], fov[1]))
}

fn parsed(text: &str) -> Scene {
    etendue_scene::parse(text, "soundness.pbrt", Path::new(".")).unwrap()
}

/// The light of glossy scenes is that of samples of the BSDF alone, and that of combined samples, in the image and in each of its regions.
#[test]
fn closed_forms_agree_with_samples_of_the_bsdf() {
    let room = ["LookAt 0 3 9   0 0.3 0", "LookAt 0 3 9   0 0 2.2"];
    let plates = ["LookAt 0 3.2 12.5   0 -0.75 0", "LookAt 0 3.2 12.5   0 -1.9 2.3"];
    let scenes = [
        ("spheres", parsed(&spheres())),
        ("horizon", parsed(&horizon())),
        ("plates", from_near("scenes/plates.pbrt", plates, ["fov\" 34", "fov\" 17"])),
        ("floor", from_near("gallery/glossy/floor.pbrt", room, ["fov\" 40", "fov\" 27"])),
        ("varnish", from_near("gallery/glossy/varnish.pbrt", room, ["fov\" 40", "fov\" 27"])),
        ("street", parsed(&street())),
    ];
    for (name, scene) in scenes.iter().take(cases(2, 6)) {
        let world = World::new(scene).unwrap();
        let [ours, own] = moments(&world, Technique::Analytic, cases(4, 16));
        for (technique, spp) in [(Technique::Brdf, cases(32, 256)), (Technique::MisPower, cases(4, 32))] {
            let [means, variances] = moments(&world, technique, spp);
            let mut worst = 0.0_f64;
            for (k, channel) in (0..=REGIONS).flat_map(|k| [0, 1, 2].map(|channel| (k, channel))) {
                let error = (own[k][channel] + variances[k][channel]).sqrt();
                let off = (ours[k][channel] - means[k][channel]).abs();
                // rounding errors where there is no noise
                let z = off / (error + 1e-6 * means[k][channel]);
                worst = worst.max(z);
                assert!(
                    z < 4.0,
                    "{name}, region {k}, channel {channel}: {}, by {technique:?} {}, which is {z} standard errors",
                    ours[k][channel],
                    means[k][channel]
                );
            }
            let [ours, theirs] = [ours, means].map(|means| means[REGIONS][1]);
            let part = 100.0 * (own[REGIONS][1] + variances[REGIONS][1]).sqrt() / theirs;
            println!(
                "{name}: analytic differs from {technique:?} by {:.3} % ± {part:.3} %; greatest deviation of a region {worst:.2}",
                100.0 * (ours / theirs - 1.0)
            );
            // agreement means little without precision
            assert!(part < cases(1.5, 0.8), "{name}, {technique:?}: ± {part} %");
        }
    }
}

/// What a surface of GGX with a Fresnel factor of 1 reflects of white surroundings towards a view with this cosine, by quadrature over the
/// hemisphere.
fn white_albedo(alpha: f64, cos: f64) -> f64 {
    let (view, square) = ([(1.0 - cos * cos).sqrt(), cos], alpha * alpha);
    let root = |cos: f64| (square + (1.0 - square) * cos * cos).sqrt();
    let mut reflected = |o: f64, azimuth: f64| {
        let sine = (1.0 - o * o).sqrt();
        let (x, y) = (view[0] - sine * libm::cos(azimuth), sine * libm::sin(azimuth));
        let height = view[1] + o;
        let length = x * x + y * y + height * height;
        let density = square / (PI * ((x * x + y * y + square * height * height) / length).powi(2));
        // both signs of the azimuth
        2.0 * o * density / (2.0 * (o * root(cos) + cos * root(o)))
    };
    integrate(&mut reflected, [0.0, 0.0], [1.0, PI], 1e-6)
}

/// The white furnace: a metal that absorbs nothing reflects the albedo of its microsurface, and not more light than there is, in a room
/// whose walls and ceiling shine alike and stand on its horizon, and below a white sky.
#[test]
fn white_rooms_show_the_albedo() {
    let walls = [
        panel([[-2.0, 0.0, -2.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]], [1.0; 3]),
        panel([[-2.0, 0.0, 2.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]], [1.0; 3]),
        panel([[-2.0, 0.0, -2.0], [0.0, 0.0, 4.0], [0.0, 3.0, 0.0]], [1.0; 3]),
        panel([[2.0, 0.0, -2.0], [0.0, 0.0, 4.0], [0.0, 3.0, 0.0]], [1.0; 3]),
        panel([[-2.0, 3.0, -2.0], [4.0, 0.0, 0.0], [0.0, 0.0, 4.0]], [1.0; 3]),
    ];
    let sky = "LightSource \"infinite\" \"rgb L\" [1 1 1]\n";
    let spp = cases(1 << 12, 1 << 17);
    for (alpha, cos) in [(0.1, 0.9), (0.1, 0.3), (0.3, 0.6), (0.3, 0.15), (0.7, 0.8), (1.0, 0.3)] {
        let truth = white_albedo(alpha, cos);
        assert!(truth > 0.4 && truth < 1.0, "α {alpha}, cosθ {cos}: {truth}");
        let camera = format!(
            "LookAt {} {cos} 0  0 0 0  0 0 1 Camera \"perspective\" \"float fov\" 1e-3 WorldBegin\n",
            (1.0_f64 - cos * cos).sqrt()
        );
        let floor = metal(1.0, alpha) + "Shape \"bilinearmesh\" \"point3 P\" [-2 0 2  2 0 2  -2 0 -2  2 0 -2]\n";
        let room = World::new(&parsed(&(camera.clone() + &floor + &walls.concat()))).unwrap();
        let outside = World::new(&parsed(&(camera + &floor + sky))).unwrap();
        for (name, world, technique) in [
            ("room", &room, Technique::Analytic),
            ("room", &room, Technique::Brdf),
            ("room", &room, Technique::MisPower),
            ("sky", &outside, Technique::Brdf),
            ("sky", &outside, Technique::MisPower),
        ] {
            let settings = Settings {
                width: 1,
                height: 1,
                spp,
                technique,
                depth: 1,
                sampler: Sampler::Independent,
                seed: 7,
                ..Settings::DEFAULT
            };
            let pixel = world.render(&settings, &|_| ()).0.pixels[0];
            let [mean, claim] = [f64::from(pixel.mean[1]), f64::from(pixel.variance[1]).sqrt()];
            // the metal's reflectance is 0.9999, and more at grazing angles
            let off = (mean - truth).abs() / (claim + 1e-4);
            println!("{name}, {technique:?}, α {alpha}, cosθ {cos}: {mean:.5} ± {claim:.5}, {truth:.5}, {off:.2}");
            assert!(off < 4.0, "{name}, {technique:?}, α {alpha}, cosθ {cos}: {mean} ± {claim}, not {truth}");
            assert!(
                mean < 1.0 && claim < cases(0.02, 0.002),
                "{name}, {technique:?}, α {alpha}, cosθ {cos}: {mean} ± {claim}"
            );
        }
    }
}
