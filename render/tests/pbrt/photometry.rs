//! Powers, illuminances and scales beside those of the renderer's table of values.

use crate::kit::Folder;
use crate::pbrt::text::{LIGHT, TRIANGLE, read, warnings, world};
use etendue_render::scene::{DeltaLight, Environment, SkyRadiance};
use etendue_scene::parse;
use std::path::Path;

/// pbrt-v4 multiplies by the scale after what a light shall have.
#[test]
fn scales_multiply_powers_and_illuminances() {
    let folder = Folder::new();
    folder.picture("p.exr", [2, 2], |x, y| [1.0 / (1 + x + y) as f32, 0.5, (x % 2) as f32]);
    folder.write("a.ies", "IESNA:LM-63-2019\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 9\n0 90\n0\n8 2\n");
    // the radiance or intensity of the only light, in the green channel
    let strength = |text: &str| {
        let scene = parse(&world(text), "a.pbrt", folder.root()).unwrap_or_else(|error| panic!("{error}\n{text}"));
        f64::from(match (&scene.delta_lights[..], &scene.environment) {
            ([DeltaLight::Directed { intensity, .. }], _) => intensity[1],
            (_, Some(Environment { sky: SkyRadiance::Image { texels, .. }, .. })) => {
                texels.iter().fold(0.0, |most: f32, texel| most.max(texel[1]))
            }
            _ => scene.shapes[0].emission.unwrap().radiance[1],
        })
    };
    for light in [
        "LightSource \"spot\" \"string profile\" \"a.ies\" \"float power\" 3 SCALE",
        "LightSource \"spot\" \"string profile\" \"p.exr\" \"float power\" 3 SCALE",
        "LightSource \"infinite\" \"string sky\" \"cie\" \"integer type\" 1 \"float illuminance\" 3 SCALE",
        "AreaLightSource \"diffuse\" \"string profile\" \"a.ies\" \"float power\" 3 SCALE Shape \"disk\"",
        "AreaLightSource \"diffuse\" \"float spread\" 40 \"float power\" 3 SCALE Shape \"disk\"",
    ] {
        let of = |scale: &str| strength(&light.replace("SCALE", scale));
        let plain = of("");
        assert!((of("\"float scale\" .25") / plain - 0.25).abs() < 1e-6, "{light}: {plain}");
        assert!((of("\"float scale\" 3 \"rgb I\" [2 2 2] \"rgb L\" [2 2 2]") / plain - 3.0).abs() < 1e-6, "{light}");
        assert!((of("\"rgb scale\" [1 .5 2]") / plain - 0.5).abs() < 0.3, "{light}: {plain}");
    }
}

#[test]
fn extreme_powers() {
    let of = |power: &str| {
        parse(&world(&format!("{LIGHT} \"float power\" {power}\nShape \"disk\"")), "a.pbrt", Path::new(""))
    };
    assert_eq!(of("1e-50").unwrap().shapes[0].emission.unwrap().radiance, [f32::MIN_POSITIVE; 3]);
    let error = of("1e40").unwrap_err().to_string();
    assert!(error.starts_with("a.pbrt:4: Shape \"disk\": its power makes the radiance ["), "{error}");
    // black bodies have the power and the luminance of 1 that are asked for
    let radiance =
        |light: &str| read(&world(&format!("{LIGHT} {light} {TRIANGLE}"))).shapes[0].emission.unwrap().radiance;
    let luminance = |[r, g, b]: [f32; 3]| 0.2126 * r + 0.7152 * g + 0.0722 * b;
    let warm = radiance("\"float power\" 10 \"blackbody L\" 3000");
    assert!((luminance(warm) * std::f32::consts::PI * 0.5 - 10.0).abs() < 1e-3 && warm[0] > 2.0 * warm[2], "{warm:?}");
    let scaled = radiance("\"blackbody L\" 3000 \"float scale\" 5");
    assert!((luminance(scaled) - 5.0).abs() < 1e-3, "{scaled:?}");
    assert_eq!(radiance("\"spectrum L\" \"stdillum-D65\""), [1.0; 3]);
    // the upper half of a sky is dark; only some lights have pictures
    let folder = Folder::new();
    folder.picture("below.exr", [1, 2], |_, y| [y as f32; 3]);
    let below = world("LightSource \"infinite\" \"string filename\" \"below.exr\" \"float illuminance\" 10");
    let below = warnings(&parse(&below, "a.pbrt", folder.root()).unwrap());
    assert!(below[0].contains("the upper half of the sky is dark"), "{below:?}");
    let plain = read(&world("LightSource \"point\" \"string filename\" \"none.exr\""));
    assert!(plain.stand_ins.is_empty() && warnings(&plain).len() == 1, "{:?}", plain.warnings);
}

/// Chromaticities on the Planckian locus (Wyszecki and Stiles 1982), of luminance 1, from linear sRGB (IEC 61966-2-1).
#[test]
fn black_bodies_have_the_colours_of_their_temperatures() {
    for (kelvins, x, y) in
        [(2856.0, 0.4476, 0.4074), (4000.0, 0.3805, 0.3768), (6500.0, 0.3135, 0.3237), (10000.0, 0.2807, 0.2884)]
    {
        let scene = read(&format!(
            "Camera \"perspective\" WorldBegin LightSource \"point\" \"blackbody I\" {kelvins}\n{TRIANGLE}"
        ));
        let DeltaLight::Point { intensity, .. } = scene.delta_lights[0] else { panic!() };
        let [r, g, b] = intensity.map(f64::from);
        let xyz = [
            0.4124 * r + 0.3576 * g + 0.1805 * b,
            0.2126 * r + 0.7152 * g + 0.0722 * b,
            0.0193 * r + 0.1192 * g + 0.9505 * b,
        ];
        let sum: f64 = xyz.iter().sum();
        assert!((xyz[0] / sum - x).abs() < 5e-4 && (xyz[1] / sum - y).abs() < 5e-4, "{kelvins}: {xyz:?}");
        assert!((xyz[1] - 1.0).abs() < 1e-3, "{kelvins}: {xyz:?}");
    }
}
