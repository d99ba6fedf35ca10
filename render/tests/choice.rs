//! Ways to choose a light: all of them give the same image in the mean.

use crate::kit::{builtin, film, read, world};
use etendue_oracle::tier::cases;
use etendue_render::film::Pixel;
use etendue_render::{ChoiceBy, Sampler, Settings, Technique, World};

const SETTINGS: Settings = Settings {
    width: 16,
    height: 12,
    spp: 64,
    technique: Technique::SolidAngle,
    sampler: Sampler::Independent,
    ..Settings::DEFAULT
};

/// A floor with a ball under a point, a spot, a distant light, a sky and panels of different power.
const MIXED: &str = r#"
LookAt 0 2 4 0 0 0 0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 32 "integer yresolution" 24
WorldBegin
LightSource "point" "point3 from" [1 1 0] "rgb I" [1 .5 .2]
LightSource "spot" "point3 from" [-1 2 0] "point3 to" [0 0 0] "float coneangle" 20 "rgb I" [9 9 9]
LightSource "distant" "point3 from" [1 2 1] "point3 to" [0 0 0] "rgb L" [.3 .3 .2]
LightSource "infinite" "rgb L" [.1 .1 .2]
AttributeBegin
AreaLightSource "diffuse" "rgb L" [40 30 20]
Translate -1 .6 -.5
Shape "sphere" "float radius" .05
AttributeEnd
AttributeBegin
AreaLightSource "diffuse" "rgb L" [2 3 2]
Shape "bilinearmesh" "point3 P" [-2 2 -2 2 2 -2 -2 3 -2 2 3 -2]
AttributeEnd
Material "diffuse" "rgb reflectance" [.7 .7 .7]
Shape "bilinearmesh" "point3 P" [-3 0 -3 3 0 -3 -3 0 3 3 0 3]
Material "conductor" "float roughness" .3
Translate .3 .3 0
Shape "sphere" "float radius" .3
"#;

/// The mean radiance of images with different seeds, and its standard error.
fn mean(world: &World, settings: &Settings, images: u64) -> [f64; 2] {
    let mean = |seed: u64| {
        let pixels = world.render(&Settings { seed, ..*settings }, &|_| ()).0.pixels;
        pixels.iter().flat_map(|pixel| pixel.mean).map(f64::from).sum::<f64>() / pixels.len() as f64
    };
    let means: Vec<f64> = (1..=images).map(|seed| mean(seed + settings.seed)).collect();
    let n = images as f64;
    let all = means.iter().sum::<f64>() / n;
    [all, (means.iter().map(|mean| (mean - all).powi(2)).sum::<f64>() / (n * (n - 1.0))).sqrt()]
}

/// Every way to choose a light of a scene, among few and many, delta lights, a sun and a sky, gives the same image in the mean, also
/// combined with samples of the surface.
#[test]
fn all_choices_have_the_same_mean() {
    let mixed = read(MIXED);
    let scenes =
        ["quads", "delta-lights", "plates", "chandelier"].map(|name| (name, etendue_scene::load(name).unwrap()));
    let mut compared = [0; 6];
    for (name, scene) in scenes.into_iter().chain([("mixed", mixed)]) {
        let world = World::new(&scene).unwrap();
        for technique in [Technique::SolidAngle, Technique::MisPower] {
            let of = |choice: ChoiceBy, seed: u64| {
                let settings = Settings { technique, choice, seed, ..SETTINGS };
                world.check(&settings).ok().map(|()| mean(&world, &settings, cases(8, 64)))
            };
            let [auto, own] = of(ChoiceBy::Auto, 0).unwrap();
            for choice in ChoiceBy::ALL {
                let Some([other, error]) = of(choice, 1000) else { continue };
                let z = (other - auto) / own.hypot(error);
                println!("{name} {technique:?} {choice:?}: {other:.5} ± {error:.5}, z {z:.2}");
                assert!(z.abs() < 5.0, "{name} by {choice:?}: {other}, not {auto}, z {z}");
                compared[choice as usize] += 1;
            }
        }
    }
    assert_eq!(compared, [10, 10, 10, 4, 6, 10]);
}

/// A floor of half the side HALF below a ball and a box.
const STAGE: &str = r#"
LookAt 0 2 3 0 0 0 0 1 0
Camera "perspective" "float fov" 20
WorldBegin
Material "diffuse" "rgb reflectance" [.5 .5 .5]
Shape "bilinearmesh" "point3 P" [-HALF 0 HALF HALF 0 HALF -HALF 0 -HALF HALF 0 -HALF]
Shape "bilinearmesh" "point3 P" [-.4 .3 -.2 -.1 .3 -.2 -.4 .3 .1 -.1 .3 .1]
AttributeBegin
Translate .3 .15 0
Shape "sphere" "float radius" .15
AttributeEnd
"#;
const SKY: &str = "LightSource \"infinite\" \"rgb L\" [1 1 1]\n";
const PANEL: &str = "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] Material \"diffuse\" \"rgb reflectance\" [0 0 0] \
                     Shape \"bilinearmesh\" \"point3 P\" [-.5 2 -.5 .5 2 -.5 -.5 2 .5 .5 2 .5] AttributeEnd\n";
const CANDLE: &str = "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [500 500 500] Material \"diffuse\" \"rgb reflectance\" [0 0 0] \
                      Translate -.3 .5 0 Shape \"sphere\" \"float radius\" .02 AttributeEnd\n";
const BULB: &str = "LightSource \"point\" \"point3 from\" [-.3 1 0] \"rgb I\" [2 2 2]\n";

/// So many suns with an irradiance of 3 together.
fn suns(count: u32) -> String {
    let sun = |k: u32| {
        let (x, z) = (0.5 - f64::from(k % 5) / 4.0, f64::from(k / 5) / 4.0 - 0.4);
        let [from, irradiance] = [format!("{x} 1 {z}"), (3.0 / f64::from(count)).to_string()];
        format!(
            "LightSource \"distant\" \"point3 from\" [{from}] \"point3 to\" [0 0 0] \"float illuminance\" {irradiance}\n"
        )
    };
    (0..count).map(sun).collect()
}

/// No size of a floor takes the samples from a lamp beside a sky or suns: the variance is at most twice that of a choice by number and, on a
/// small floor, of one by power. (On a large one that starves the lamp, so that few pixels tell its variance.)
#[test]
fn kinds_of_lights_are_chosen_well() {
    let stages = [
        ("sky and panel", format!("{SKY}{PANEL}")),
        ("sky and candle", format!("{SKY}{CANDLE}")),
        ("sky and bulb", format!("{SKY}{BULB}")),
        ("sun and panel", format!("{}{PANEL}", suns(1))),
        ("sun and bulb", format!("{}{BULB}", suns(1))),
        ("sky, twenty suns and panel", format!("{SKY}{}{PANEL}", suns(20))),
    ];
    for (name, lights) in &stages {
        for half in [1.0, 1e3, 1e5].into_iter().take(cases(2, 3)) {
            let world = world(&format!("{}{lights}", STAGE.replace("HALF", &half.to_string())));
            let images = [ChoiceBy::Uniform, ChoiceBy::Auto, ChoiceBy::Power]
                .map(|choice| film(&world, &Settings { choice, spp: 256, ..SETTINGS }).pixels);
            // what the camera sees of a lamp is not chosen
            let lit = |i: &usize| images[0][*i].mean[1] < 3.0;
            let variance = |pixels: &Vec<Pixel>| -> f64 {
                (0..pixels.len()).filter(lit).map(|i| f64::from(pixels[i].variance[1])).sum()
            };
            let [uniform, own, power] = images.each_ref().map(variance);
            println!("{name} ±{half}: {own:.2e}, by number {uniform:.2e}, by power {power:.2e}");
            let best = if half == 1.0 { uniform.min(power) } else { uniform };
            assert!(own <= 2.0 * best, "{name} ±{half}: {own:e}, by number {uniform:e}, by power {power:e}");
        }
    }
}

/// What a way to choose cannot do is said.
#[test]
fn impossible_choices_are_refused() {
    for (name, choice, what) in [
        ("chandelier", ChoiceBy::Spatial, "the choice spatial needs at most 32 lights, and the scene has 1000"),
        (
            "delta-lights",
            ChoiceBy::Tree,
            "the choice tree needs lights that are somewhere, and the scene has a sun or a sky",
        ),
    ] {
        let world = builtin(name);
        assert_eq!(world.check(&Settings { choice, ..SETTINGS }), Err(what.to_owned()));
        // nothing is chosen where a technique finds all lights
        let (technique, choice) = (Technique::Brdf, ChoiceBy::Spatial);
        assert_eq!(world.check(&Settings { technique, choice, ..SETTINGS }).is_ok(), name == "chandelier");
    }
}
