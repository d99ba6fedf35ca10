//! Rough surfaces beside diffuse ones, and boxes with holes; `attack` has veils and what is behind them.

use crate::kit::{self, narrow, world};
use etendue_render::film::compare::LIMIT;
use etendue_render::{Technique, World};

const TECHNIQUES: [Technique; 4] =
    [Technique::SolidAngle, Technique::MisPower, Technique::Analytic, Technique::CosineHemisphere];

/// Mean and standard error of the green channel of the only pixel.
fn pixel(world: &World, technique: Technique, spp: u32) -> [f64; 2] {
    kit::pixel(world, technique, spp).map(|color| color[1])
}

fn seen(camera: &str, scene: &str) -> World {
    world(&narrow(camera, scene))
}

fn square(size: f64, height: f64, parameters: &str) -> String {
    let (a, h) = (size, height);
    format!(
        "Shape \"trianglemesh\" \"point3 P\" [-{a} {h} {a}  {a} {h} {a}  {a} {h} -{a}  -{a} {h} -{a}] \
         \"point2 uv\" [0 0  1 0  1 1  0 1] \"integer indices\" [0 1 2  0 2 3] {parameters}\n"
    )
}

const LAMP: &str = "AttributeBegin Material \"diffuse\" \"rgb reflectance\" [0 0 0] AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] \
    Shape \"bilinearmesh\" \"point3 P\" [-.5 3 -.5  .5 3 -.5  -.5 3 .5  .5 3 .5] AttributeEnd\n";

/// Beside rough surfaces, `analytic` combines light and BSDF on these alone: under a light so large that each has a great weight, all
/// floors have the brightness that the BSDF finds by chance.
#[test]
fn only_rough_surfaces_combine_light_and_bsdf() {
    let lamp = LAMP.replace("-.5 3 -.5  .5 3 -.5  -.5 3 .5  .5 3 .5", "-6 1 -6  6 1 -6  -6 1 6  6 1 6");
    assert_ne!(lamp, LAMP);
    let ball =
        "AttributeBegin Translate 40 0 0 Material \"conductor\" \"float roughness\" .3 Shape \"sphere\" AttributeEnd\n";
    let bent = "\"normal N\" [-.1 1 0  .1 1 0  .1 1 0  -.1 1 0]";
    for (material, parameters) in [
        ("\"diffuse\"", ""),
        ("\"diffuse\"", bent),
        ("\"conductor\" \"float roughness\" .5", ""),
        ("\"coateddiffuse\" \"float roughness\" .3", bent),
    ] {
        let world = seen("2 .6 0", &format!("{lamp}{ball}Material {material}\n{}", square(9.0, 0.0, parameters)));
        let [truth, more] = pixel(&world, Technique::Brdf, 1 << 14);
        assert!(truth > 0.1, "{material}: {truth}");
        for technique in [Technique::Analytic, Technique::MisPower] {
            let [mean, error] = pixel(&world, technique, 1 << 14);
            let error = error.hypot(more).max(2e-4 * truth);
            assert!((mean - truth).abs() < LIMIT * error, "{technique:?} {material}: {mean}, {truth} ± {error}");
            assert!(error < 0.01 * truth, "{technique:?} {material}: {error} of {truth}");
        }
    }
}

/// A box with holes is no body that certificates know: light passes both of its walls by chance.
#[test]
fn boxes_with_holes_are_no_bodies() {
    let floor = square(9.0, 0.0, "");
    let corners =
        (0..8).map(|k| format!("{} {} {} ", (k & 1) * 4 - 2, 1.0 + f64::from(k >> 1 & 1) * 0.5, (k >> 2) * 4 - 2));
    let corners = corners.collect::<String>();
    let mesh = |parameters: &str, indices: &str| {
        format!("Shape \"trianglemesh\" \"point3 P\" [{corners}] {parameters} \"integer indices\" [{indices}]\n")
    };
    let (holes, level) = ("\"float alpha\" .4", "0 4 5 0 5 1  2 3 7 2 7 6");
    let upright = "0 1 3 0 3 2  4 6 7 4 7 5  0 2 6 0 6 4  1 5 7 1 7 3";
    // all of it, or only what is level
    let cages = ["", holes].map(|sides| format!("{}{}", mesh(holes, level), mesh(sides, upright)));
    // half of the upper side is solid, beside the middle of the lamp
    let (below, above) = (mesh(holes, "0 4 5 0 5 1"), mesh(holes, "2 3 7") + &mesh("", "2 7 6"));
    let half = format!("{below}{above}{}", mesh("", upright));
    for technique in TECHNIQUES {
        let seen = |cage: &str| pixel(&seen("5 .5 0", &format!("{LAMP}{floor}{cage}")), technique, 1 << 14);
        let [open, more] = seen("");
        for cage in &cages {
            let [mean, error] = seen(cage);
            let (wanted, error) = (0.36 * open, error.hypot(0.36 * more));
            assert!((mean - wanted).abs() < LIMIT * error, "{technique:?}: {mean} of {wanted}, error {error}");
        }
        // the lamp is symmetric about the middle
        let ([mean, error], wanted) = (seen(&half), 0.18 * open);
        let error = error.hypot(0.18 * more);
        assert!((mean - wanted).abs() < LIMIT * error, "{technique:?}: half {mean} of {wanted}, error {error}");
    }
}
