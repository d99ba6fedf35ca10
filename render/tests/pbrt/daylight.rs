//! Reading of daylight.

use crate::pbrt::text::{read, warnings, world};
use etendue::light::{EnvironmentMap, ImageEnvironment};
use etendue_render::lights::sky::GeneralSky;
use etendue_render::scene::{Environment, SkyRadiance};

fn directive(parameters: &str) -> String {
    world(&format!("LightSource \"infinite\" \"string sky\" \"cie\" {parameters}"))
}

fn environment(parameters: &str) -> Environment {
    let scene = read(&directive(parameters));
    assert_eq!(warnings(&scene), [""; 0]);
    scene.environment.unwrap()
}

fn texels(environment: &Environment) -> &[[f32; 3]] {
    let SkyRadiance::Image { width: 512, map: EnvironmentMap::EqualArea, texels } = &environment.sky else {
        panic!("no image")
    };
    texels
}

/// Texels are those of the formula, with the zenith's radiance or the illuminance that is asked for.
#[test]
fn daylight_is_that_of_the_formula() {
    let read = environment(
        "\"integer type\" 13 \"float elevation\" 30 \"float azimuth\" 90 \"rgb L\" [1 2 3] \"float scale\" 2",
    );
    let sky = GeneralSky::new(13, [0.75_f64.sqrt(), 0.0, 0.5]).unwrap();
    let buffer = vec![0.0; ImageEnvironment::buffer(512, 512)];
    let map = ImageEnvironment::from_buffer(&buffer, 512, EnvironmentMap::EqualArea).unwrap();
    for (i, texel) in texels(&read).iter().enumerate().step_by(37) {
        let [x, y] = [i % 512, i / 512].map(|k| k as u32);
        let middle = etendue::light::Texel { x, y, offset: etendue::Vec2::new(0.5_f64, 0.5) };
        let w = map.direction(&middle);
        // the mean is not the middle where the horizon or the tip of the corona is
        if w.z.abs() > 0.02 && w.x < 0.8 {
            let wanted = 2.0 * sky.luminance(w);
            assert!(
                (f64::from(texel[0]) - wanted).abs() < 2e-2 * wanted + 1e-9,
                "{texel:?}, expected {wanted} at {w:?}"
            );
        }
        assert!(
            (texel[1] - 2.0 * texel[0]).abs() <= 1e-6 * texel[1]
                && (texel[2] - 3.0 * texel[0]).abs() <= 1e-6 * texel[2]
        );
    }
    assert_eq!(read.sun, None);

    let bright = environment("\"float elevation\" 50 \"float sun\" 7");
    let sun = bright.sun.unwrap();
    let elevation = 50.0_f64.to_radians();
    let direction = [0.0, -elevation.cos(), elevation.sin()];
    assert!((0..3).all(|k| (f64::from(sun.direction[k]) - direction[k]).abs() < 1e-6), "{sun:?}");
    // πL sin²σ
    let angle = 0.2675_f64.to_radians();
    let facing = f64::from(sun.radiance[0]) * std::f64::consts::PI * angle.sin().powi(2);
    assert!((facing / 7.0 - 1.0).abs() < 2e-3, "{facing}");
}

/// The sun turns with the transform.
#[test]
fn the_sun_follows_the_transform() {
    let elevation = 50.0_f64.to_radians();
    // in a scene with y up
    let text = directive("\"float elevation\" 50 \"float azimuth\" 90 \"float sun\" 1");
    let turned = read(&text.replace("LightSource", "Rotate -90 1 0 0 LightSource")).environment.unwrap();
    let (sun, wanted) = (turned.sun.unwrap(), [elevation.cos(), elevation.sin(), 0.0]);
    assert!((0..3).all(|k| (f64::from(sun.direction[k]) - wanted[k]).abs() < 1e-6), "{sun:?}, expected {wanted:?}");
}

#[test]
fn overcast_and_dark_skies_have_no_sun() {
    // overcast skies need no sun
    assert_eq!(environment("\"integer type\" 1").sun, None);
    let dark = read(&directive("\"float scale\" 0 \"integer type\" 5"));
    assert!(dark.environment.is_none() && warnings(&dark)[0].ends_with("emits nothing"), "{:?}", dark.warnings);
}
