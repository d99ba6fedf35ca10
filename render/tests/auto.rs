//! What `auto` takes: the same for every seed and number of threads, and no way that misses light.

use crate::kit::read;
use etendue::light::EnvironmentMap;
use etendue_render::drive::AutoTrial;
use etendue_render::scene::{Environment, SkyRadiance};
use etendue_render::{ChoiceBy, Sampler, Settings, Technique, World};
use rayon::ThreadPoolBuilder;

const LARGE: Settings = Settings { width: 256, height: 256, spp: 64, sampler: Sampler::Adaptive, ..Settings::DEFAULT };

fn taken(world: &World, settings: &Settings) -> (Technique, ChoiceBy, Option<AutoTrial>) {
    let view = world.view(settings);
    (view.settings().technique, view.settings().choice, view.trial().copied())
}

/// A room that the sky lights through a window. The radiance of the sky is 1, but for a spot.
fn room(spot: f32) -> World {
    let wall = |p: &str| format!("Shape \"bilinearmesh\" \"point3 P\" [{p}] ");
    let walls = [
        "-1 -1 0  1 -1 0  -1 1 0  1 1 0",
        "-1 -1 2  1 -1 2  -1 1 2  1 1 2",
        "-1 -1 0  -1 1 0  -1 -1 2  -1 1 2",
        "1 -1 0  1 1 0  1 -1 2  1 1 2",
        "-1 -1 0  1 -1 0  -1 -1 2  1 -1 2",
        // the window is above
        "-1 1 0  1 1 0  -1 1 1.3  1 1 1.3",
    ];
    let walls: String = walls.map(wall).concat();
    let mut scene = read(&format!(
        "LookAt 0 0.9 1  0 -1 0.7  0 0 1 Camera \"perspective\" \"float fov\" 70 WorldBegin
        LightSource \"infinite\" \"rgb L\" [1 1 1]
        Material \"diffuse\" \"rgb reflectance\" [.7 .7 .7] {walls}"
    ));
    let mut texels = vec![[1.0; 3]; 64 * 64];
    texels[64 * 40 + 7] = [spot; 3];
    let sky = SkyRadiance::Image { width: 64, map: EnvironmentMap::EqualArea, texels };
    scene.environment = scene.environment.map(|environment| Environment { sky, ..environment });
    World::new(&scene).unwrap()
}

/// Directions by the surface find the window more often than those by the sky. They would nearly always miss a sun, which is brightest, whether
/// a tile of the trial shows where it shines or not.
#[test]
fn auto_takes_what_does_not_miss_the_sun() {
    let (even, sunny) = (room(1.0), room(4000.0));
    let all = [1, 3].map(|threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| taken(&even, &LARGE))
    });
    assert_eq!(all[0], all[1]);
    assert_eq!(all[0], taken(&even, &Settings { seed: 7, ..LARGE }));
    let (technique, choice, Some(trial)) = all[0] else { panic!("{all:?}") };
    assert_eq!((technique, choice), (Technique::Brdf, ChoiceBy::Auto), "{trial:?}");
    assert_eq!(trial.over, (Technique::SolidAngle, ChoiceBy::Auto));
    assert!(trial.times > 1.1 && trial.part <= 0.03 && (6..=16).contains(&trial.tiles), "{trial:?}");
    // the image is that of what was taken
    let area = [16, 32, 48, 64];
    let image = |settings: &Settings| even.view(settings).render(area, &|_| ());
    assert_eq!(image(&LARGE).0, image(&Settings { technique, choice, ..LARGE }).0);
    let (technique, _, trial) = taken(&sunny, &LARGE);
    assert_ne!(technique, Technique::Brdf, "{trial:?}");
    // what misses neither the window nor the sun is tried, too
    let trial = trial.unwrap();
    let tried = [technique, trial.over.0];
    assert!(tried.contains(&Technique::MisPower) && tried.contains(&Technique::SolidAngle), "{trial:?}");
}

/// One lamp over diffuse surfaces is sampled by projected solid angle in a trial, which says that the rule was kept.
#[test]
fn one_lamp_is_tried_by_projected_solid_angle() {
    let lamp = World::new(&etendue_scene::load("sphere-light").unwrap()).unwrap();
    let (technique, _, trial) = taken(&lamp, &LARGE);
    let trial = trial.unwrap();
    assert_eq!((technique, trial.over.0), (Technique::Analytic, Technique::ProjectedSolidAngle), "{trial:?}");
    assert!(trial.is_rule && trial.times > 1.1, "{trial:?}");
}

/// Through a lens closed forms are not the rule, but taken where they are better: where the image has no edges.
#[test]
fn closed_forms_are_taken_behind_a_lens_where_they_pay() {
    let scene = read(
        "LookAt 0 -5 3  0 0 0  0 0 1 Camera \"perspective\" \"float fov\" 30 \"float lensradius\" .05 \"float focaldistance\" 5.8
        WorldBegin AttributeBegin Translate 0 0 6 AreaLightSource \"diffuse\" \"rgb L\" [9 9 9] Shape \"sphere\" \"float radius\" 1
        AttributeEnd Material \"diffuse\" \"rgb reflectance\" [.7 .7 .7]
        Shape \"bilinearmesh\" \"point3 P\" [-20 -20 0  20 -20 0  -20 20 0  20 20 0]",
    );
    let world = World::new(&scene).unwrap();
    let (technique, _, trial) = taken(&world, &LARGE);
    assert!(technique == Technique::Analytic && trial.is_some_and(|trial| !trial.is_rule), "{technique:?} {trial:?}");
    assert_eq!(taken(&world, &Settings { width: 64, height: 64, ..LARGE }).0, Technique::SolidAngle);
}

/// Where a trial would take more than 3 % of the samples, the rule decides, and where there is only one way, nothing does.
#[test]
fn small_images_take_no_trial() {
    let quads = World::new(&etendue_scene::load("quads").unwrap()).unwrap();
    for small in [
        Settings { width: 64, height: 64, ..LARGE },
        Settings { spp: 8, ..LARGE },
        Settings { spp: 2, sampler: Sampler::Sobol, ..LARGE },
    ] {
        assert_eq!(taken(&quads, &small), (Technique::Analytic, ChoiceBy::Auto, None), "{small:?}");
    }
    let deltas = World::new(&etendue_scene::load("delta-lights").unwrap()).unwrap();
    assert_eq!(taken(&deltas, &LARGE), (Technique::SolidAngle, ChoiceBy::Auto, None));
}
