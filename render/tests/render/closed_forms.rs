//! Compares lights and mirrors with closed forms: point, spot and distant lights over a plane, a mirror image, a sky.

use etendue_render::compare::{Comparison, LIMIT};
use etendue_render::image::Picture;
use etendue_render::{Sampler, Settings, Technique, World};
use std::f64::consts::PI;
use std::path::Path;

fn world(text: &str) -> World {
    let scene = etendue_scene::parse(text, "test.pbrt", Path::new("no such directory"))
        .unwrap_or_else(|e| panic!("{e}\n{text}"));
    World::new(&scene).unwrap()
}

/// A camera that sees the origin from `camera`, with a view so narrow that a pixel is a point.
fn narrow(camera: &str, scene: &str) -> World {
    world(&format!("LookAt {camera} 0 0 0  0.1 1 0.2\nCamera \"perspective\" \"float fov\" 1e-3\nWorldBegin\n{scene}"))
}

const PLANE: &str = "Material \"diffuse\" \"rgb reflectance\" [.8 .5 .2]\n\
    Shape \"bilinearmesh\" \"point3 P\" [-9 0 9  9 0 9  -9 0 -9  9 0 -9]\n";

fn settings(technique: Technique, sampler: Sampler, spp: u32, side: u32) -> Settings {
    Settings { width: side, height: side, spp, technique, sampler, seed: 3, ..Settings::DEFAULT }
}

/// Mean and standard error of a pixel.
fn pixel(world: &World, technique: Technique, spp: u32) -> ([f64; 3], [f64; 3]) {
    let (film, _) = world.render(&settings(technique, Sampler::Independent, spp, 1), &|_| ());
    let pixel = film.pixels[0];
    (pixel.mean.map(f64::from), pixel.variance.map(|v| f64::from(v).sqrt()))
}

/// Every technique gives exactly this irradiance times albedo/π, without noise, for lights with a single direction.
fn exactly(world: &World, irradiance: [f64; 3]) {
    for technique in Technique::ALL {
        let (mean, error) = pixel(world, technique, 24);
        for (k, albedo) in [0.8, 0.5, 0.2].into_iter().enumerate() {
            let truth = irradiance[k] * albedo / PI;
            assert!((mean[k] - truth).abs() <= 3e-5 * truth, "{technique:?}: {mean:?}, {truth} in channel {k}");
            assert!(error[k] <= 1e-4 * truth, "{technique:?}: {error:?} of {truth}");
        }
    }
}

#[test]
fn point_over_a_plane() {
    let scene = format!("{PLANE}LightSource \"point\" \"point3 from\" [.3 2 -.5] \"rgb I\" [1 2 3]");
    let squared: f64 = 0.09 + 4.0 + 0.25;
    let each = 2.0 / squared.sqrt() / squared;
    exactly(&narrow("1 5 2", &scene), [each, 2.0 * each, 3.0 * each]);
    // no light reaches the other side, or passes through a ball
    exactly(&narrow("1 -5 2", &scene), [0.0; 3]);
    let hidden = format!("{scene} Translate .15 1 -.25 Shape \"sphere\" \"float radius\" .2");
    exactly(&narrow("1 5 2", &hidden), [0.0; 3]);
}

#[test]
fn spot_over_a_plane() {
    // the axis points past the origin, which lies between the two angles
    let scene = format!(
        "{PLANE}LightSource \"spot\" \"point3 from\" [0 2 0] \"point3 to\" [.5 0 0] \"float coneangle\" 20 \"float conedeltaangle\" 10"
    );
    let cos = |degrees: f64| degrees.to_radians().cos();
    let t = ((2.0 / 4.25_f64.sqrt()) - cos(20.0)) / (cos(10.0) - cos(20.0));
    assert!(t > 0.1 && t < 0.9);
    exactly(&narrow("1 5 2", &scene), [t * t * (3.0 - 2.0 * t) / 4.0; 3]);
    exactly(&narrow("1 5 2", &scene.replace("[.5 0 0]", "[2 0 0]")), [0.0; 3]);
}

/// A lamp of an IES file and a projected image: what arrives has one value.
#[test]
fn directed_lights_over_a_plane() {
    let folder = std::env::temp_dir().join(format!("etendue-directed-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    // 90 cd at the nadir, 0 from 60 degrees on
    let lamp = "IESNA:LM-63-2019\nTILT=NONE\n1 -1 3 2 1 1 2 0 0 0\n1 1 9\n0 60\n0\n30 0\n";
    std::fs::write(folder.join("lamp.ies"), lamp).unwrap();
    // the texel at the right and below has a colour, the others are black
    let texel = |x: usize, y: usize| if (x, y) == (1, 1) { (1.0_f32, 2.0_f32, 4.0_f32) } else { (0.0, 0.0, 0.0) };
    exr::prelude::write_rgb_file(folder.join("slide.exr"), 2, 2, texel).unwrap();
    let world = |lights: &str| {
        let text = format!(
            "LookAt 1 5 2 0 0 0  0.1 1 0.2\nCamera \"perspective\" \"float fov\" 1e-3\nWorldBegin\n{PLANE}{lights}"
        );
        World::new(&etendue_scene::parse(&text, "test.pbrt", &folder).unwrap_or_else(|e| panic!("{e}"))).unwrap()
    };
    let ies = |turn: f64| {
        format!(
            "AttributeBegin Translate 1 2 0 Rotate {turn} 0 0 1\nLightSource \"goniometric\" \"string filename\" \"lamp.ies\"\nAttributeEnd\n"
        )
    };
    let (squared, angle) = (5.0_f64, 0.5_f64.atan().to_degrees());
    let lamp = 90.0 * (1.0 - angle / 60.0) * 2.0 / squared.sqrt() / squared;
    exactly(&world(&ies(0.0)), [lamp; 3]);
    // turned about z by an angle, the nadir is that angle nearer, or farther
    exactly(&world(&ies(-angle)), [90.0 * 2.0 / squared.sqrt() / squared; 3]);
    exactly(&world(&ies(50.0)), [0.0; 3]);
    // projected downwards, with +y of the image towards −x of the world, and its right towards −z: the origin is below, in the left half
    let slide = |place: &str| {
        format!(
            "AttributeBegin Transform [0 0 -1 0  -1 0 0 0  0 -1 0 0  {place} 1] LightSource \"projection\" \"string filename\" \"slide.exr\" \"float fov\" 100 AttributeEnd\n"
        )
    };
    let squared = 4.0_f64 + 0.25 + 0.04;
    let each = 2.0 / squared.sqrt() / squared;
    exactly(&world(&slide("-.5 2 .2")), [each, 2.0 * each, 4.0 * each]);
    for place in ["-.5 2 -.2", ".5 2 .2", ".5 2 -.2", "-.5 -2 .2", "-3 2 .2"] {
        exactly(&world(&slide(place)), [0.0; 3]);
    }
    // several lights, of several kinds
    let both = format!("{}{}{}", ies(0.0), slide("-.5 2 .2"), slide("-.5 2 -.2"));
    exactly(&world(&both), [lamp + each, lamp + 2.0 * each, lamp + 4.0 * each]);
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn parallel_light_over_a_plane() {
    let scene =
        format!("{PLANE}LightSource \"distant\" \"point3 from\" [3 4 0] \"rgb L\" [1 .5 2] \"point3 to\" [0 0 0]");
    exactly(&narrow("1 5 2", &scene), [0.8, 0.4, 1.6]);
    // three lights are all sampled, still without noise
    let more = format!(
        "{scene} LightSource \"distant\" \"point3 from\" [0 1 0] \"point3 to\" [0 0 0] LightSource \"point\" \"point3 from\" [0 1 0]"
    );
    exactly(&narrow("1 5 2", &more), [2.8, 2.4, 3.6]);
}

/// One of more than 32 delta lights, or of delta lights mixed with others, is chosen at random.
#[test]
fn many_delta_lights_and_mixed_ones() {
    let mut scene = PLANE.to_owned();
    let mut irradiance = 0.0;
    for i in 0..50 {
        let intensity = 0.1 + f64::from(i % 7);
        let height = 1.0 + 0.1 * f64::from(i);
        scene += &format!("LightSource \"point\" \"point3 from\" [0 {height} 0] \"float scale\" {intensity}\n");
        irradiance += intensity / (height * height);
    }
    let sphere = "AttributeBegin Material \"diffuse\" \"rgb reflectance\" [0 0 0] AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] \
                  Translate 2 2 0 Shape \"sphere\" \"float radius\" .5 AttributeEnd";
    // a facing sphere gives π sin²σ
    let ball = 5.0 * PI * 0.25 / 8.0 / 2.0_f64.sqrt();
    for (scene, irradiance) in [(scene.clone(), irradiance), (format!("{scene}{sphere}"), irradiance + ball)] {
        let world = narrow("1 5 2", &scene);
        for technique in Technique::ALL {
            let (mean, error) = pixel(&world, technique, 4096);
            let z = (mean[0] - irradiance * 0.8 / PI) / error[0];
            assert!(z.abs() < LIMIT && error[0] < 0.1 * mean[0], "{technique:?}: {mean:?} ± {error:?}, {irradiance}");
        }
    }
}

/// Every technique gives this irradiance in every channel, but for its noise.
fn nearly(world: &World, irradiance: f64, spp: u32) {
    for technique in Technique::ALL {
        let (mean, error) = pixel(world, technique, spp);
        let truth = irradiance * 0.8 / PI;
        let off = (mean[0] - truth).abs();
        assert!(off <= LIMIT * error[0] + 3e-5 * truth, "{technique:?}: {mean:?} ± {error:?}, not {truth}");
        // where nothing is lost, no technique is blind
        assert!(error[0] < 0.2 * truth, "{technique:?}: {mean:?} ± {error:?}");
    }
}

/// A panel with a spread: where a point sees all of the cone, the irradiance is πL whatever the spread is; where it sees a part of it, that
/// of a sum over the panel.
#[test]
fn panels_with_a_spread() {
    let panel = |spread: f64, corners: &str, shape: &str| {
        format!(
            "{PLANE}AttributeBegin Material \"diffuse\" \"rgb reflectance\" [0 0 0] AreaLightSource \"diffuse\" \"rgb L\" [2 2 2] \
             \"float spread\" {spread} Shape \"{shape}\" \"point3 P\" [{corners}] AttributeEnd\n"
        )
    };
    let big = "-3 1 -3  3 1 -3  -3 1 3  3 1 3";
    for spread in [30.0, 90.0, 140.0] {
        nearly(&narrow("1 .5 2", &panel(spread, big, "bilinearmesh")), 2.0 * PI, 1 << 14);
    }
    // two triangles, which are not clipped
    let triangles = "\"integer indices\" [0 1 2 1 3 2]";
    let two = panel(90.0, big, "trianglemesh").replace("AttributeEnd", &format!("{triangles} AttributeEnd"));
    nearly(&narrow("1 .5 2", &two), 2.0 * PI, 1 << 14);
    // an edge cuts the cone, and the panel is skewed
    let (spread, [x0, x1], [z0, z1], skew) = (100.0_f64, [0.2, 2.0], [-1.0, 0.5], 0.4);
    let cut = format!("{x0} 1 {z0}  {x1} 1 {z0}  {} 1 {z1}  {} 1 {z1}", x0 + skew, x1 + skew);
    let (half, n) = (0.5 * spread.to_radians(), 1000);
    let mut irradiance = 0.0;
    for i in 0..n * n {
        let [s, t] = [i % n, i / n].map(|k| (f64::from(k) + 0.5) / f64::from(n));
        let (x, z) = (x0 + (x1 - x0) * s + skew * t, z0 + (z1 - z0) * t);
        let area = (x1 - x0) * (z1 - z0) / f64::from(n * n);
        let factor = (half.tan() - x.hypot(z)).max(0.0) / (half.tan() - half);
        irradiance += 2.0 * factor * area / (1.0 + x * x + z * z).powi(2);
    }
    let scene = panel(spread, &cut, "bilinearmesh");
    nearly(&narrow("1 .5 2", &scene), irradiance, 1 << 14);
    // among other lights, and one of many
    let lamp = "LightSource \"point\" \"point3 from\" [0 .5 0] \"float scale\" .25";
    nearly(&narrow("1 .3 2", &format!("{scene} {lamp}")), irradiance + 1.0, 1 << 14);
    let mut many = PLANE.to_owned();
    let mut sum = 0.0;
    for i in 0..49 {
        let (x, z, side) = (f64::from(i % 7 - 3) * 0.4, f64::from(i / 7 - 3) * 0.4, 0.1);
        let corners = format!("{x} 1 {z}  {} 1 {z}  {x} 1 {}  {} 1 {}", x + side, z + side, x + side, z + side);
        many += &panel(60.0, &corners, "bilinearmesh").replace(PLANE, "");
        let half = 30_f64.to_radians();
        for k in 0..100 * 100 {
            let [x, z] = [x + side * (f64::from(k % 100) + 0.5) / 100.0, z + side * (f64::from(k / 100) + 0.5) / 100.0];
            let factor = (half.tan() - x.hypot(z)).max(0.0) / (half.tan() - half);
            sum += 2.0 * factor * side * side * 1e-4 / (1.0 + x * x + z * z).powi(2);
        }
    }
    nearly(&narrow("1 .5 2", &many), sum, 1 << 15);
}

#[test]
fn uniform_sky() {
    let scene = format!("{PLANE}LightSource \"infinite\" \"rgb L\" [1 2 4]");
    let world = narrow("1 5 2", &scene);
    for technique in Technique::ALL {
        let (mean, error) = pixel(&world, technique, 4096);
        for (k, truth) in [0.8, 1.0, 0.8].into_iter().enumerate() {
            let off = (mean[k] - truth).abs();
            assert!(off < LIMIT * error[k] + 1e-5, "{technique:?}: {mean:?} ± {error:?}");
            assert!(error[k] < 0.03, "{technique:?}: {error:?}");
            // with a pdf proportional to the cosine, all samples have the same value
            if matches!(technique, Technique::CosineHemisphere | Technique::Brdf | Technique::ProjectedSolidAngle) {
                assert!(off < 1e-5 && error[k] < 1e-5, "{technique:?}: {mean:?} ± {error:?}");
            }
        }
    }
    // the sky is visible
    let (mean, _) = pixel(&narrow("1 5 2", "LightSource \"infinite\" \"rgb L\" [1 2 4]"), Technique::MisPower, 8);
    assert_eq!(mean, [1.0, 2.0, 4.0]);
}

/// An image of two texels makes half of the sky white: checks the irradiance of a plane, and where the white half is.
#[test]
fn half_a_sky() {
    let folder = std::env::temp_dir().join(format!("etendue-half-sky-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    // the white half has azimuths about z from +x over +y to −x
    exr::prelude::write_rgb_file(folder.join("half.exr"), 2, 1, |x, _| {
        if x == 0 { (1.0_f32, 1.0_f32, 1.0_f32) } else { (0.0, 0.0, 0.0) }
    })
    .unwrap();
    let load = |camera: &str, transform: &str, rest: &str| {
        let text = format!(
            "LookAt {camera} 0 0 0  0.1 0.2 1\nCamera \"perspective\" \"float fov\" 1e-3\nWorldBegin\n\
             AttributeBegin {transform} LightSource \"infinite\" \"string filename\" \"half.exr\" AttributeEnd\n{rest}"
        );
        World::new(&etendue_scene::parse(&text, "test.pbrt", &folder).unwrap_or_else(|e| panic!("{e}"))).unwrap()
    };
    let plane = "Material \"diffuse\" \"rgb reflectance\" [.8 .8 .8] Rotate 30 1 0 0\n\
                 Shape \"trianglemesh\" \"point3 P\" [-9 -9 0  9 -9 0  0 9 0]";
    // the white half covers a lune of 60° of the hemisphere about the plane's normal (0, −½, √¾): π(1 + cos120°)/2
    let world = load("0 -1 4", "", plane);
    for technique in Technique::ALL {
        let (mean, error) = pixel(&world, technique, 4096);
        let truth = 0.8 * (1.0 - 0.5) / 2.0;
        assert!((mean[0] - truth).abs() < LIMIT * error[0] && error[0] < 0.02, "{technique:?}: {mean:?} ± {error:?}");
    }
    let seen = |camera: &str, transform: &str| pixel(&load(camera, transform, ""), Technique::MisPower, 8).0[0];
    assert_eq!([seen("0 -5 1", ""), seen("0 5 1", "")], [1.0, 0.0]);
    // rotated by 90° about z: +y becomes −x
    assert_eq!([seen("5 0 1", "Rotate 90 0 0 1"), seen("-5 0 1", "Rotate 90 0 0 1")], [1.0, 0.0]);
    assert_eq!([seen("0 -5 1", "Scale 1 -1 1"), seen("0 5 1", "Scale 1 -1 1")], [0.0, 1.0]);
    std::fs::remove_dir_all(&folder).unwrap();
}

/// A camera sees in a mirror floor what its mirror image sees of the scene, upside down.
#[test]
fn a_mirror_shows_the_mirror_image() {
    let objects = "AttributeBegin Material \"diffuse\" \"rgb reflectance\" [0 0 0] AreaLightSource \"diffuse\" \"rgb L\" [5 4 3] \
        Shape \"bilinearmesh\" \"point3 P\" [-1 3 -1  1 3 -1  -1 3 1  1 3 1] AttributeEnd\n\
        AttributeBegin Translate .5 1 0 Material \"diffuse\" \"rgb reflectance\" [.7 .2 .7] \
        Shape \"sphere\" \"float radius\" .6 AttributeEnd\n\
        LightSource \"point\" \"point3 from\" [-2 1 2] \"rgb I\" [3 3 9]\n\
        Shape \"trianglemesh\" \"point3 P\" [-1.5 .5 -.5  -.2 .5 -.5  -.8 2 .3]\n";
    let view =
        |camera: &str, up: &str| format!("LookAt {camera} {up} Camera \"perspective\" \"float fov\" 40 WorldBegin\n");
    let floor = "Material \"mirror\" \"rgb Kr\" [1 1 1] Shape \"bilinearmesh\" \"point3 P\" [-90 0 90  90 0 90  -90 0 -90  90 0 -90]\n";
    let above = world(&format!("{}{objects}{floor}", view("0 2 5  0 -1.5 0", "0 1 0")));
    let below = world(&format!("{}{objects}", view("0 -2 5  0 1.5 0", "0 1 0")));
    for technique in [Technique::SolidAngle, Technique::Area, Technique::MisPower, Technique::Brdf] {
        let [a, b] = [(&above, 3), (&below, 4)].map(|(world, seed)| {
            let settings = Settings { seed, ..settings(technique, Sampler::Independent, 128, 48) };
            Picture::from(&world.render(&settings, &|_| ()).0)
        });
        let flip = |rows: &[[f32; 3]]| rows.chunks(48).rev().flatten().copied().collect::<Vec<_>>();
        let b = Picture { radiance: flip(&b.radiance), variance: b.variance.as_deref().map(flip), ..b };
        let p = Comparison::new(&b, &a, 0.0).unwrap().predicted.unwrap();
        assert!(p.agrees(), "{technique:?}: {p:?}");
        assert!(a.radiance.iter().flatten().any(|&x| x > 4.5), "the light is not in view");
        // the check rejects an image that is upside down
        let p = Comparison::new(&Picture { radiance: flip(&b.radiance), ..b.clone() }, &a, 0.0).unwrap();
        assert!(p.predicted.unwrap().z_mse > 20.0);
    }
}

/// Between two facing mirrors, a light is seen after exactly `depth` reflections, and each attenuates it by Kr.
#[test]
fn chains_of_mirrors_end_at_their_depth() {
    let mirrors = "Material \"mirror\" \"rgb Kr\" [.5 .5 .5]\n\
        Shape \"bilinearmesh\" \"point3 P\" [-50 -2 9  50 -2 9  -50 -2 -9  50 -2 -9]\n\
        Shape \"bilinearmesh\" \"point3 P\" [-50 2 9  50 2 9  -50 2 -9  50 2 -9]\n";
    // in the plane z = 0, a ray from (−18, 0) towards (−16, −2) runs at 45 degrees and is reflected every 4 units of x
    for (depth, x) in [(1, -14.0), (2, -10.0), (3, -6.0), (5, 2.0)] {
        // midway between two reflections, at y = 0
        let light = format!(
            "AttributeBegin Material \"diffuse\" \"rgb reflectance\" [0 0 0] AreaLightSource \"diffuse\" \"rgb L\" [8 8 8] \
             Translate {x} 0 0 Shape \"sphere\" \"float radius\" .2 AttributeEnd\n"
        );
        let text = format!(
            "LookAt -18 0 0 -17 -1 0 0 0 1 Camera \"perspective\" \"float fov\" 1e-3 WorldBegin\n{mirrors}{light}"
        );
        let world = world(&text);
        for allowed in 0..8 {
            let settings = Settings { depth: allowed, ..settings(Technique::SolidAngle, Sampler::Stratified, 11, 2) };
            let (film, rays) = world.render(&settings, &|_| ());
            let expected = if allowed >= depth { 8.0 * 0.5_f32.powi(depth as i32) } else { 0.0 };
            let seen = film.pixels[3].mean;
            assert!((seen[1] - expected).abs() < 1e-5, "{depth} mirrors, {allowed} allowed: {seen:?}");
            assert_eq!(rays.mirror, 44 * u64::from(allowed.min(depth)));
        }
    }
}

/// Mirrors and rough metals block shadow rays with every technique.
#[test]
fn mirrors_block() {
    for material in ["Material \"mirror\"", "Material \"conductor\" \"rgb reflectance\" [1 1 1] \"float roughness\" .3"]
    {
        let scene = format!(
            "{PLANE}LightSource \"distant\" \"point3 from\" [0 1 0] \"point3 to\" [0 0 0]\n\
             AttributeBegin Material \"diffuse\" \"rgb reflectance\" [0 0 0] AreaLightSource \"diffuse\" \
             Translate 0 3 0 Shape \"sphere\" \"float radius\" .2 AttributeEnd\n\
             {material} Shape \"bilinearmesh\" \"point3 P\" [-9 1 9  9 1 9  -9 1 -9  9 1 -9]"
        );
        exactly(&narrow("1 .5 .2", &scene), [0.0; 3]);
    }
}

/// Spheres keep their own colour if all triangles share one that comes later in the file.
#[test]
fn materials_are_not_mixed_up() {
    let scene = "Material \"diffuse\" \"rgb reflectance\" [.8 .5 .2] Shape \"sphere\" \"float radius\" 1e-3\n\
        Material \"diffuse\" \"rgb reflectance\" [0 1 0] Shape \"trianglemesh\" \"point3 P\" [-9 -1 9  9 -1 9  0 -1 -9]\n\
        LightSource \"distant\" \"point3 from\" [0 1 0] \"point3 to\" [0 0 0]";
    let (mean, _) = pixel(&narrow("0 5 1e-9", scene), Technique::SolidAngle, 64);
    for (k, albedo) in [0.8, 0.5, 0.2].into_iter().enumerate() {
        assert!((mean[k] - albedo / PI).abs() < 0.02 * albedo, "{mean:?}");
    }
}

type V3 = [f64; 3];

fn dot(a: V3, b: V3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
fn cross(a: V3, b: V3) -> V3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
fn unit(a: V3) -> V3 {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}

/// A triangle around the origin in the plane y = 0, and the weights of its corners there: areas over the whole area.
const CORNERS: [V3; 3] = [[-3.0, 0.0, 2.0], [1.0, 0.0, -5.0], [4.0, 0.0, 1.0]];
fn weights() -> V3 {
    let area = |a: V3, b: V3| cross(a, b)[1];
    let [a, b, c] = CORNERS;
    let parts = [area(b, c), area(c, a), area(a, b)];
    parts.map(|part| part / parts.iter().sum::<f64>())
}
fn mesh(parameters: &str) -> String {
    let points: Vec<_> = CORNERS.iter().flatten().map(f64::to_string).collect();
    format!("Shape \"trianglemesh\" \"point3 P\" [{}] {parameters}\n", points.join(" "))
}
fn sun(to: V3) -> String {
    let [x, y, z] = to;
    format!("LightSource \"distant\" \"point3 from\" [{x} {y} {z}] \"point3 to\" [0 0 0]\n")
}

/// A checkerboard of n × n squares over u shows whether the interpolated u is in an even one: the digits of each corner's weight.
#[test]
fn textures_are_where_their_coordinates_say() {
    for (corner, weight) in weights().into_iter().enumerate() {
        for n in 2..40 {
            let uv: Vec<_> = (0..3).map(|k| if k == corner { "1 0.3" } else { "0 0.3" }).collect();
            let text = format!(
                "{}Texture \"b\" \"spectrum\" \"checkerboard\" \"float uscale\" {n} \"rgb tex1\" [.8 .5 .2] \"rgb tex2\" [.1 .2 .3]\n\
                 Material \"diffuse\" \"texture reflectance\" \"b\"\n{}",
                sun([0.0, 1.0, 0.0]),
                mesh(&format!("\"point2 uv\" [{}]", uv.join(" ")))
            );
            let place = weight * f64::from(n);
            if (place - place.round()).abs() < 1e-3 {
                continue;
            }
            let albedo = if place.floor() % 2.0 == 0.0 { [0.8, 0.5, 0.2] } else { [0.1, 0.2, 0.3] };
            let (mean, _) = pixel(&narrow("1 5 2", &text), Technique::Auto, 8);
            for k in 0..3 {
                assert!((mean[k] * PI / albedo[k] - 1.0).abs() < 1e-5, "corner {corner}, {n} squares: {mean:?}");
            }
        }
    }
}

/// Interpolated normals by every technique: the cosine is that of the smooth surface, and no light passes through either surface.
#[test]
fn smooth_normals_are_interpolated() {
    let normals: [V3; 3] = [[0.3, 1.0, 0.1], [-0.4, 1.0, 0.6], [0.2, 1.0, -0.7]];
    let list: Vec<_> = normals.iter().flatten().map(f64::to_string).collect();
    let surface = format!(
        "Material \"diffuse\" \"rgb reflectance\" [.8 .5 .2]\n{}",
        mesh(&format!("\"normal N\" [{}]", list.join(" ")))
    );
    let units = normals.map(unit);
    let w = weights();
    let smooth = unit(std::array::from_fn(|k| (0..3).map(|i| w[i] * units[i][k]).sum()));
    assert!(smooth[1] < 0.999, "{smooth:?}");
    for to in [[0.0, 1.0, 0.0], [1.0, 1.0, 0.5], [-3.0, 1.0, 1.0]] {
        let cos = dot(unit(to), smooth);
        exactly(&narrow("1 5 2", &format!("{}{surface}", sun(to))), [cos; 3]);
    }
    // more than 90° apart, as those of a smooth cube or octahedron are
    let apart: [V3; 3] = [[-0.98, 0.196, 0.0], [0.7, 0.3, -0.6], [0.2, 0.2, 0.95]];
    let text: Vec<_> = apart.iter().flatten().map(f64::to_string).collect();
    let bent = surface.replace(&list.join(" "), &text.join(" "));
    let units = apart.map(unit);
    assert!(dot(units[0], units[1]) < -0.5 && dot(units[0], units[2]) < 0.0);
    let mixed = unit(std::array::from_fn(|k| (0..3).map(|i| w[i] * units[i][k]).sum()));
    exactly(&narrow("1 5 2", &format!("{}{bent}", sun([0.0, 1.0, 0.0]))), [mixed[1]; 3]);
    // whichever way the normals point in the file, and from below
    let turned: Vec<_> = normals.iter().flatten().map(|x| (-x).to_string()).collect();
    let turned = surface.replace(&list.join(" "), &turned.join(" "));
    let to = [1.0, 1.0, 0.5];
    let cos = dot(unit(to), smooth);
    exactly(&narrow("1 5 2", &format!("{}{turned}", sun(to))), [cos; 3]);
    exactly(&narrow("-1 -5 -2", &format!("{}{surface}", sun(to.map(|x| -x)))), [cos; 3]);
    // a normal that faces away from the viewer is turned until its cosine to him is 0.01
    let (away, view) = (unit([-1.0, 1.0, 0.0]), unit([5.0, 1.0, 0.0]));
    let facing = |n: V3| unit(std::array::from_fn(|k| n[k] + (0.01 - dot(n, view)) * view[k]));
    let steep =
        format!("Material \"diffuse\" \"rgb reflectance\" [.8 .5 .2]\n{}", mesh("\"normal N\" [-1 1 0 -1 1 0 -1 1 0]"));
    assert!(dot(away, view) < -0.5);
    exactly(&narrow("5 1 0", &format!("{}{steep}", sun([0.0, 1.0, 0.0]))), [facing(away)[1]; 3]);
    // tilted so far that the sun is above one surface alone
    let tilted = |n: &str| format!("Material \"diffuse\"\n{}", mesh(&format!("\"normal N\" [{n} {n} {n}]")));
    for (to, n) in [([3.0, -0.2, 0.0], "1 1 0"), ([3.0, 0.2, 0.0], "-1 1 0")] {
        let up = dot(unit(to), [if n == "1 1 0" { 1.0 } else { -1.0 }, 1.0, 0.0]);
        assert!((up > 0.0) != (to[1] > 0.0));
        exactly(&narrow("1 5 2", &format!("{}{}", sun(to), tilted(n))), [0.0; 3]);
    }
}

/// A coat over a diffuse surface by every technique, against its formula (glTF 2.0, appendix B; Heitz 2014, equations 85, 86 and 99) in
/// double precision: with the same roughness in all directions, and with one that differs along u and across.
#[test]
fn coats_have_their_formula() {
    // u and v are linear in x and z, with ∂p/∂u along (1, 0, −1)
    let corners = [[-9.0, 9.0], [9.0, 9.0], [0.0, -9.0]];
    let uv = corners.map(|[x, z]| format!("{} {}", x + 0.3 * z, x + z)).join(" ");
    let skewed = format!("Shape \"trianglemesh\" \"point3 P\" [-9 0 9 9 0 9 0 0 -9] \"point2 uv\" [{uv}]\n");
    let plane = PLANE.split_once('\n').unwrap().1;
    let diagonal = unit([1.0, 0.0, -1.0]);
    for (shape, along, [a, b]) in [
        (plane, [1.0, 0.0, 0.0], [0.5_f64, 0.5_f64]),
        (plane, [1.0, 0.0, 0.0], [0.3, 0.6]),
        (&*skewed, diagonal, [0.7, 0.2]),
    ] {
        coat_has_its_formula(shape, along, [a, b]);
    }
}

fn coat_has_its_formula(shape: &str, along: V3, [a, b]: [f64; 2]) {
    let albedo = [0.8, 0.5, 0.2];
    let roughness = format!("\"float uroughness\" {} \"float vroughness\" {}\n", a * a, b * b);
    // of plastic, Ks is a factor of the whole reflectance
    let coated = format!("Material \"coateddiffuse\" \"rgb reflectance\" [.8 .5 .2] {roughness}");
    let plastic = format!("Material \"plastic\" \"rgb Kd\" [.8 .5 .2] \"rgb Ks\" [.1 .1 .1] {roughness}");
    let view = unit([1.0, 5.0, 2.0]);
    for to in [[-1.0, 5.0, -2.0], [0.0, 1.0, 0.0], [-4.0, 1.0, 0.0], [0.5, 1.0, 3.0]] {
        let light = unit(to);
        let half = unit(std::array::from_fn(|k| light[k] + view[k]));
        let (i, o) = (light[1], view[1]);
        // squares of the components along and across
        let squares = |w: V3| {
            let u = dot(w, along);
            [u * u, w[0] * w[0] + w[2] * w[2] - u * u]
        };
        let [u, v] = squares(half);
        let distribution = 1.0 / (PI * a * b * (u / (a * a) + v / (b * b) + half[1] * half[1]).powi(2));
        let lambda = |w: V3| {
            let [u, v] = squares(w);
            ((1.0 + (a * a * u + b * b * v) / (w[1] * w[1])).sqrt() - 1.0) / 2.0
        };
        let shadowing = 1.0 / (1.0 + lambda(light) + lambda(view));
        for (text, factor) in [(&coated, 1.0), (&plastic, 0.1)] {
            let fresnel = factor * (0.04 + 0.96 * (1.0 - dot(view, half)).powi(5));
            let rough = fresnel * distribution * shadowing / (4.0 * i * o);
            let world = narrow("1 5 2", &format!("{}{text}{shape}", sun(to)));
            for technique in Technique::ALL {
                let (mean, _) = pixel(&world, technique, 8);
                for (k, albedo) in albedo.into_iter().enumerate() {
                    let truth = ((1.0 - fresnel) * albedo / PI + rough) * i;
                    assert!(
                        (mean[k] - truth).abs() <= 3e-5 * truth,
                        "{technique:?}, {text}, {to:?}: {mean:?}, {truth} in channel {k}"
                    );
                }
            }
        }
    }
}

/// A smooth mirror does not reflect what is below its flat surface.
#[test]
fn smooth_mirrors_do_not_see_through_themselves() {
    let mirror = |n: &str| {
        let scene =
            format!("LightSource \"infinite\"\nMaterial \"mirror\"\n{}", mesh(&format!("\"normal N\" [{n} {n} {n}]")));
        pixel(&narrow("5 1 0", &scene), Technique::Auto, 8).0
    };
    // the mirror image of the direction to the viewer, (5, 1, 0), is (−4.47, 2.45, 0) and (−4.95, −1.20, 0) with these normals
    assert!((mirror(".05 1 0")[0] - 0.9).abs() < 1e-5, "{:?}", mirror(".05 1 0"));
    assert_eq!(mirror("-.19 .98 0"), [0.0; 3]);
}

/// Panels over a surface with a smooth normal, by every technique, against sums over the panels in double precision: one that is above
/// both horizons, and an upright one of which half is below the flat surface, but most of that above the smooth one.
#[test]
fn panels_light_smooth_surfaces() {
    let side = 400;
    let share = |i: i32| (f64::from(i) + 0.5) / f64::from(side);
    for (corner, edges, normal) in [
        ([-2.0, 2.0, -1.0], [[1.0, 0.0, 0.0], [0.0, 0.0, 2.0]], [0.5, 1.0, -0.3]),
        ([-2.0, -2.0, -1.0], [[0.0, 4.0, 0.0], [0.0, 0.0, 2.0]], [-0.5, 1.0, -0.3]),
    ] {
        let across = cross(edges[0], edges[1]);
        let n = unit(normal);
        let irradiance = (0..side * side)
            .map(|i| {
                let [s, t] = [share(i % side), share(i / side)];
                let to: V3 = std::array::from_fn(|k| corner[k] + s * edges[0][k] + t * edges[1][k]);
                let (w, square) = (unit(to), dot(to, to));
                if w[1] > 0.0 { dot(w, n).max(0.0) * -dot(w, across) / square / f64::from(side * side) } else { 0.0 }
            })
            .sum::<f64>()
            * 5.0;
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|[s, t]| {
            let p: V3 = std::array::from_fn(|k| corner[k] + s * edges[0][k] + t * edges[1][k]);
            p.map(|x| x.to_string()).join(" ")
        });
        let normals = vec![normal.map(|x| x.to_string()).join(" "); 3].join(" ");
        let scene = format!(
            "AttributeBegin Material \"diffuse\" \"rgb reflectance\" [0 0 0] AreaLightSource \"diffuse\" \"rgb L\" [5 5 5]\n\
             Shape \"bilinearmesh\" \"point3 P\" [{}] AttributeEnd\nMaterial \"diffuse\" \"rgb reflectance\" [.8 .5 .2]\n{}",
            corners.join(" "),
            mesh(&format!("\"normal N\" [{normals}]"))
        );
        let (world, truth) = (narrow("1 5 2", &scene), irradiance * 0.8 / PI);
        for technique in Technique::ALL {
            let (mean, error) = pixel(&world, technique, 4096);
            assert!(
                (mean[0] - truth).abs() < LIMIT * error[0] + 1e-4 * truth,
                "{technique:?}: {mean:?} ± {error:?}, {truth}"
            );
            assert!(error[0] < 0.1 * truth, "{technique:?}: {error:?}");
        }
    }
}
