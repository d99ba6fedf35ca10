//! Reading of daylight, and its error messages.

use super::*;
use etendue::light::{EnvironmentMap, ImageEnvironment};
use etendue_render::sky::GeneralSky;

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

/// By a date, and turned with the transform: in Berlin the sun is in the south at 1 pm of summer time.
#[test]
fn the_sun_follows_date_and_transform() {
    let date = "\"float latitude\" 52.52 \"float longitude\" 13.405 \"integer year\" 2026 \"integer month\" 6 \"integer day\" 21 \
                \"float hours\" 13 \"float timezone\" 2 \"float sun\" 1";
    let sun = environment(date).sun.unwrap();
    let (elevation, azimuth) = (60.8748_f64.to_radians(), 176.139_f64.to_radians());
    let wanted = [elevation.cos() * azimuth.sin(), elevation.cos() * azimuth.cos(), elevation.sin()];
    let near = |a: [f32; 3], b: [f64; 3]| (0..3).all(|k| (f64::from(a[k]) - b[k]).abs() < 2e-4);
    assert!(near(sun.direction, wanted), "{sun:?}, expected {wanted:?}");
    // a scene with y up
    let text = directive(date).replace("LightSource", "Rotate -90 1 0 0 LightSource");
    let turned = read(&text).environment.unwrap();
    let sun = turned.sun.unwrap();
    assert!(near(sun.direction, [wanted[0], wanted[2], -wanted[1]]), "{sun:?}");
}

#[test]
fn what_is_no_daylight_is_an_error() {
    let date =
        "\"float latitude\" 10 \"float longitude\" 20 \"integer year\" 2026 \"integer month\" 2 \"integer day\" 21 ";
    let swapped = |from: &str, to: &str| format!("{} \"float hours\" 12", date.replace(from, to));
    for (parameters, what) in [
        ("\"integer type\" 0 \"float elevation\" 30".to_owned(), "\"type\": must be from 1 to 15, not 0"),
        ("\"integer type\" 16 \"float elevation\" 30".to_owned(), "\"type\": must be from 1 to 15, not 16"),
        ("\"integer type\" -3 \"float elevation\" 30".to_owned(), "\"type\": must be from 1 to 15, not -3"),
        (String::new(), "needs \"elevation\", or \"latitude\" and \"longitude\", for its sun"),
        ("\"float latitude\" 3".to_owned(), "needs \"elevation\", or \"latitude\" and \"longitude\", for its sun"),
        ("\"float elevation\" -5".to_owned(), "\"elevation\": must be from 0 to 90 degrees, not -5"),
        ("\"float elevation\" 91".to_owned(), "\"elevation\": must be from 0 to 90 degrees, not 91"),
        (
            "\"float elevation\" 9 \"float latitude\" 3".to_owned(),
            "\"elevation\" and \"latitude\": the sun has one or the other",
        ),
        ("\"float elevation\" 9 \"float sun\" -1".to_owned(), "\"sun\": must be at least 0, not -1"),
        ("\"float elevation\" 9 \"float sun\" 1e38".to_owned(), "of the sky or its sun: at most"),
        ("\"float elevation\" 9 \"float scale\" 1e38".to_owned(), "of the sky or its sun: at most"),
        (
            "\"float elevation\" 9 \"string filename\" \"a.exr\"".to_owned(),
            "\"sky\" and \"filename\" a.exr: a sky has one or the other",
        ),
        (date.to_owned(), "needs \"hours\" for its sun"),
        (swapped("\"integer day\" 21", ""), "needs \"day\" for its sun"),
        (swapped("\"integer day\" 21", "\"integer day\" 29"), "there is no day 2026-2-29"),
        (swapped("\"integer month\" 2", "\"integer month\" -1"), "there is no day 2026--1-21"),
        (swapped("\"integer year\" 2026", "\"integer year\" 99999999"), "there is no day 99999999-2-21"),
        (
            swapped("latitude\" 10", "latitude\" 100"),
            "\"latitude\" must be from -90 to 90 and \"longitude\" from -180 to 180 degrees, not 100 and 20",
        ),
        (
            format!("{date} \"float hours\" 25"),
            "\"hours\" must be from 0 to 24 and \"timezone\" from -24 to 24, not 25 and 0",
        ),
        (format!("{date} \"float hours\" 2"), "degrees below the horizon at that time"),
    ] {
        let error = parse(&directive(&parameters), "a.pbrt", Path::new("none")).map(|_| ()).unwrap_err().to_string();
        assert!(
            error.starts_with("a.pbrt:2: LightSource \"infinite\": ") && error.contains(what),
            "{parameters}: {error}"
        );
    }
    let other = directive("").replace("cie", "hosek");
    let error = parse(&other, "a.pbrt", Path::new("none")).map(|_| ()).unwrap_err().to_string();
    assert_eq!(error, "a.pbrt:2: LightSource \"infinite\": \"sky\": \"hosek\" is not supported, only \"cie\"");
    // overcast skies need no sun
    assert_eq!(environment("\"integer type\" 1").sun, None);
    let dark = read(&directive("\"float scale\" 0 \"integer type\" 5"));
    assert!(dark.environment.is_none() && warnings(&dark)[0].ends_with("emits nothing"), "{:?}", dark.warnings);
}
