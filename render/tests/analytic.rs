//! Light computed from certificates: few rays, little noise, and what is dark.

use crate::kit::{BLACK, Folder, PLANE, builtin, world};
use etendue_oracle::tier::cases;
use etendue_render::film::Film;
use etendue_render::{RayCount, Sampler, Settings, Technique, World};

const SETTINGS: Settings =
    Settings { width: 64, height: 64, spp: 64, technique: Technique::Analytic, sets: 4, ..Settings::DEFAULT };

fn render(world: &World, settings: &Settings) -> (Film, RayCount) {
    world.render(settings, &|_| ())
}

/// Where everything is known, no ray is traced, and the variance is that of the pixels' edges.
#[test]
fn traces_few_rays() {
    // greatest parts of the shadow rays and of the variance with sampled lights
    for (name, rays, variance) in
        [("sphere-light", 0.0, 0.3), ("quads", 0.06, 0.1), ("triangle-light", 0.1, 1.1), ("cornell-box", 0.12, 1.1)]
    {
        let world = builtin(name);
        let (film, count) = render(&world, &SETTINGS);
        let (sampled, other) = render(&world, &Settings { technique: Technique::SolidAngle, ..SETTINGS });
        let sum = |film: &Film| film.pixels.iter().map(|p| f64::from(p.variance[1])).sum::<f64>();
        let part = sum(&film) / sum(&sampled);
        println!("{name}: {} of {} shadow rays, {part:.4} of the variance", count.shadow, other.shadow);
        assert!(count.shadow as f64 <= rays * other.shadow as f64, "{name}: {} shadow rays", count.shadow);
        assert!(part < variance, "{name}: {part} of the variance");
    }
}

/// The light of a picture is known, too, where nothing hides it.
#[test]
fn pictures_need_no_rays() {
    let folder = Folder::new();
    folder.picture("p.exr", [4, 4], |x, y| [x as f32, y as f32, 1.0]);
    let world = folder.world(&format!(
        "LookAt 1 2 2  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 30 WorldBegin {PLANE}
         {BLACK} AreaLightSource \"diffuse\" \"string filename\" \"p.exr\" \"bool twosided\" true
         Shape \"bilinearmesh\" \"point3 P\" [-1 3 -1  1 3 -1  -1 3 1  1 3 1]"
    ));
    let (film, count) = render(&world, &SETTINGS);
    assert!(count.shadow == 0 && film.mean()[2] > 0.0, "{} shadow rays, mean {:?}", count.shadow, film.mean());
}

/// In images that are too small for a trial, `auto` leaves lenses and lights without an area to samples.
#[test]
fn auto_chooses() {
    let settings = Settings { technique: Technique::Auto, ..SETTINGS };
    let expected = [
        ("sphere-light", Technique::Analytic),
        ("triangle-light", Technique::Analytic),
        ("quads", Technique::Analytic),
        ("cornell-box", Technique::Analytic),
        ("mirror-room", Technique::Analytic),
        ("terrain", Technique::Analytic),
        ("defocus", Technique::SolidAngle),
        ("delta-lights", Technique::SolidAngle),
        ("plates", Technique::Analytic),
        ("sky", Technique::MisLobe),
    ];
    for (name, technique) in expected {
        let world = World::from_scene(&mut etendue_scene::load(name).unwrap()).unwrap();
        assert_eq!(world.view(&settings).technique(), technique, "{name}");
        if name == "quads" {
            assert_eq!(render(&world, &settings), render(&world, &Settings { technique, ..settings }));
        }
    }
}

/// Where nothing hides a light, the bound of the closed form's error is 1e−5 of the pixels, seen directly or in a mirror. What is sampled
/// has none.
#[test]
fn the_error_of_closed_forms_is_bounded() {
    let scene = |camera: &str, mirror: &str| {
        let text = format!(
            "{camera} Camera \"perspective\" \"float fov\" 30 WorldBegin {mirror}
            Material \"diffuse\" \"rgb reflectance\" [ 0.8 0.5 0.2 ]
            Shape \"trianglemesh\" \"point3 P\" [ -9 0 -9  9 0 -9  0 0 18 ] \"integer indices\" [ 0 2 1 ]
            AreaLightSource \"diffuse\" \"rgb L\" [ 3 2 1 ] \"bool twosided\" true Translate 0 1 2
            Shape \"sphere\" \"float radius\" 0.25"
        );
        world(&text)
    };
    let down = "LookAt 0 2 0  0 0 0  0 0 1";
    let up = "LookAt 0 2 0  0 9 0  0 0 1";
    let mirror = "Material \"mirror\" \"rgb Kr\" [ 0.5 0.5 0.5 ]
        Shape \"trianglemesh\" \"point3 P\" [ -9 3 -9  9 3 -9  0 3 18 ] \"integer indices\" [ 0 1 2 ] ";
    for world in [scene(down, ""), scene(up, mirror)] {
        let (film, _) = render(&world, &SETTINGS);
        let squares = film.pixels.iter().flat_map(|p| p.mean).map(|x| f64::from(x).powi(2));
        let expected = 1e-5 * (squares.sum::<f64>() / (3 * film.pixels.len()) as f64).sqrt();
        let bound = world.view(&SETTINGS).foreseen().systematic;
        assert!(expected > 0.0 && (bound / expected - 1.0).abs() < 0.05, "{bound:e} {expected:e}");
        assert_eq!(world.view(&Settings { technique: Technique::SolidAngle, ..SETTINGS }).foreseen().systematic, 0.0);
    }
}

/// Samples go to the light of which nothing is known, not to the seven that are: its noise is that of a scene where it is alone.
#[test]
fn known_lights_take_no_samples_from_others() {
    let light = |x: f64, y: f64, rgb: &str| {
        format!(
            "AttributeBegin Material \"diffuse\" \"rgb reflectance\" [0 0 0] AreaLightSource \"diffuse\" \"rgb L\" [{rgb}] \
             Shape \"bilinearmesh\" \"point3 P\" [{x} {y} 2  {x} {} 2  {} {y} 2  {} {} 2] AttributeEnd\n",
            y + 0.2,
            x + 0.2,
            x + 0.2,
            y + 0.2
        )
    };
    // leaves before the first light
    let leaf = |k: u32| {
        let (x, y) = (0.6 + 0.1 * f64::from(k % 10), -0.5 + 0.1 * f64::from(k / 10));
        format!("{x} {y} 1.5  {} {y} 1.5  {x} {} 1.52 ", x + 0.06, y + 0.06)
    };
    let leaves: String = (0..100).map(leaf).collect();
    let corners: String = (0..300).map(|k| format!("{k} ")).collect();
    let world = |known: usize| {
        let others: String = (0..known).map(|k| light(-1.8 + 0.1 * k as f64, -1.8 + 0.5 * k as f64, "9 9 9")).collect();
        let text = format!(
            "LookAt 0 0 3  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 50\nWorldBegin\n{}{others}\
             Shape \"trianglemesh\" \"point3 P\" [{leaves}] \"integer indices\" [{corners}]\n\
             Shape \"bilinearmesh\" \"point3 P\" [-3 -3 0  3 -3 0  -3 3 0  3 3 0]\n",
            light(1.0, 0.0, "30 30 30")
        );
        world(&text)
    };
    let noise = |known: usize| {
        let world = world(known);
        let settings = Settings { sampler: Sampler::Adaptive, ..SETTINGS };
        let variance = |seed: u64| {
            let film = render(&world, &Settings { seed, ..settings }).0;
            film.pixels.iter().map(|p| f64::from(p.variance[1])).sum::<f64>()
        };
        (0..cases(2, 8)).map(variance).sum::<f64>() / cases(2, 8) as f64
    };
    let ratio = noise(7) / noise(0);
    println!("{ratio:.2} times the variance");
    assert!(ratio < 1.5, "{ratio}");
}
