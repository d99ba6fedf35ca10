//! Lights with intensities of their own: IES files, images of directions, and their error messages.

use crate::damaged::damaged;
use crate::kit::Folder;
use crate::pbrt::text::world;
use etendue_render::packet::V8;
use etendue_render::scene::{DeltaLight, Scene};
use etendue_scene::parse;

fn load_in(folder: &Folder, light: &str) -> Result<Scene, String> {
    parse(&world(light), "a.pbrt", folder.root()).map_err(|error| error.to_string())
}

/// Intensities of the only light of a scene in directions of the world, in the red channel.
fn intensities(folder: &Folder, light: &str, directions: &[[f64; 3]]) -> Vec<f64> {
    let scene = load_in(folder, light).unwrap_or_else(|error| panic!("{error}"));
    let DeltaLight::Directed { to_light, intensity, table, .. } = scene.delta_lights[0] else { panic!() };
    let shape = &scene.intensities[table as usize];
    let at = |w: &[f64; 3]| {
        let length = w.iter().map(|x| x * x).sum::<f64>().sqrt();
        let w = V8::splat(w.map(|x| (x / length) as f32).into());
        let [x, y, z] = to_light.map(|row| V8::from(row).dot(w));
        f64::from(shape.at(V8::new(x, y, z)).as_array()[5]) * f64::from(intensity[0])
    };
    directions.iter().map(at).collect()
}

/// A file of this photometric type, with factors that multiply to 6 and another of 0.5 that counts before 2002.
fn file(head: &str, kind: u32, vertical: &str, horizontal: &str, values: &str) -> String {
    let count = |list: &str| list.split_whitespace().count();
    format!(
        "{head}\n[TEST] none\nTILT=NONE\n1 1000 3 {} {} {kind} 2 0 0 0\n2 0.5 100\n{vertical}\n{horizontal}\n{values}\n",
        count(vertical),
        count(horizontal),
    )
}

const NEW: &str = "IESNA:LM-63-2002";
const LAMP: &str = "LightSource \"goniometric\" \"string filename\" \"a.ies\"";
const DOWN: [f64; 3] = [0.0, -1.0, 0.0];

fn near(found: &[f64], truth: &[f64]) {
    assert_eq!(found.len(), truth.len());
    assert!(found.iter().zip(truth).all(|(a, b)| (a - b).abs() < 1e-4 * b.abs().max(0.1)), "{found:?}, not {truth:?}");
}

/// The nadir is −y; horizontal angles run from +x to +z, which is counterclockwise seen from above, as scenes of pbrt are left-handed.
#[test]
fn type_c_has_the_nadir_as_axis() {
    let folder = Folder::new();
    let turn = |degrees: f64| [degrees.to_radians().cos(), -1.0, degrees.to_radians().sin()];
    // all around, by 90 degrees
    folder.write("a.ies", file(NEW, 1, "0 90", "0 90 180 270 360", "8 0 8 2 8 4 8 6 8 0"));
    near(&intensities(&folder, LAMP, &[DOWN, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]), &[48.0, 0.0, 0.0]);
    // half way down, half of each
    near(&intensities(&folder, LAMP, &[0.0, 90.0, 180.0, 270.0, 45.0].map(turn)), &[24.0, 30.0, 36.0, 42.0, 27.0]);
    // one quarter stands for four, one half for two, and one angle for all
    folder.write("a.ies", file(NEW, 1, "0 90", "0 90", "8 0 8 2"));
    near(&intensities(&folder, LAMP, &[0.0, 90.0, 180.0, 270.0, 225.0].map(turn)), &[24.0, 30.0, 24.0, 30.0, 27.0]);
    folder.write("a.ies", file(NEW, 1, "0 90", "0 90 180", "8 0 8 2 8 6"));
    near(&intensities(&folder, LAMP, &[0.0, 90.0, 180.0, 270.0, 225.0].map(turn)), &[24.0, 30.0, 42.0, 30.0, 36.0]);
    folder.write("a.ies", file(NEW, 1, "0 90", "90 180 270", "8 0 8 2 8 6"));
    near(&intensities(&folder, LAMP, &[0.0, 90.0, 180.0, 270.0, 315.0].map(turn)), &[30.0, 24.0, 30.0, 42.0, 36.0]);
    folder.write("a.ies", file(NEW, 1, "0 90", "0", "8 2"));
    near(&intensities(&folder, LAMP, &[0.0, 77.0, 200.0].map(turn)), &[30.0; 3]);
    // before 2002 another factor counts; the light's own factor and transform do, too
    folder.write("a.ies", file("IESNA:LM-63-1995", 1, "0 90", "0", "8 2"));
    let turned = format!("Rotate 90 1 0 0 Scale 2 2 2 {LAMP} \"float scale\" 10 \"rgb I\" [3 1 1]");
    // about +x, −y turns to −z
    near(&intensities(&folder, &turned, &[[0.0, 0.0, -1.0], [0.0, -1.0, 0.0]]), &[720.0, 180.0]);
    // 1986: no first line
    folder.write("a.ies", "a lamp\nTILT=INCLUDE\n1 2 0 90 1 0.9\n1 1000 1 2 1 1 2 0 0 0 1 1 100 0,90\n0\n7 7");
    near(&intensities(&folder, LAMP, &[DOWN]), &[7.0]);
    assert!(load_in(&folder, LAMP).unwrap().warnings[0].text.contains("a.ies:2: the factors of TILT are ignored"));
}

/// Whatever is cut off or damaged, a file is one of a light, or an error that names it.
#[test]
fn damaged_files_are_errors() {
    let whole = file(NEW, 1, "0 1 90 180", "0 30 90", "8 0 8 2 1 2 3 4 5 6 7 8")
        .replace("TILT=NONE", "TILT=INCLUDE\n1 2 0 90 1 1");
    let folder = Folder::new();
    let judge = |text: &str| {
        folder.write("a.ies", text);
        let read = load_in(&folder, LAMP);
        if let Err(error) = &read {
            assert!(error.contains("a.ies:") || error.contains("its greatest intensity is"), "{error}");
        }
        // a dark one is left out
        for light in read.iter().flat_map(|scene| &scene.delta_lights) {
            let DeltaLight::Directed { intensity, table, .. } = light else { panic!("{text}") };
            let flux = read.as_ref().unwrap().intensities[*table as usize].flux();
            assert!((0.0..=12.6).contains(&flux) && intensity[0] >= 0.0, "{flux}: {text}");
        }
        read.is_ok()
    };
    assert!(judge(&whole));
    // only the line's end is not needed
    assert!((0..whole.len()).all(|end| end + 2 > whole.len() || !judge(&whole[..end])));
    let words = ["0", "-1", " 90", "1e-9 ", "1e300", "nan", "-0", "4294967296", "x", " 180 ", "0.5", " 2 "];
    let (mut read, copies) = (0, etendue_oracle::tier::cases(1000, 300_000));
    damaged(whole.as_bytes(), &words, copies, |bytes| read += usize::from(judge(&String::from_utf8_lossy(bytes))));
    assert!(read > copies / 30, "{read}");
    // once mirrored, these are the same
    let close = file(NEW, 1, "0 90", "0 1e-9 90", "8 0 8 2 1 2");
    folder.write("a.ies", close);
    assert!(load_in(&folder, LAMP).unwrap_err().contains("a.ies: angles do not ascend"));
}

#[test]
fn errors_name_file_line_and_value() {
    let folder = Folder::new();
    let faulty = [
        (file(NEW, 1, "0 90", "0", "8"), "a.ies:8: 2 vertical and 1 horizontal angles need 5 numbers, but 4 are left"),
        (file(NEW, 1, "0 90 80", "0", "8 2 1"), "a.ies:6: vertical angles must ascend: 80 follows 90"),
        (file(NEW, 1, "0 90", "0 0", "8 2 1 1"), "a.ies:7: horizontal angles must ascend: 0 follows 0"),
        (file(NEW, 1, "0 90", "0", "8 -2"), "a.ies:8: candela value: must be at least 0, not -2"),
        (file(NEW, 1, "0 90", "0", "8 nan"), "a.ies:8: candela value: expected a finite number, found \"nan\""),
        (file(NEW, 1, "0 90", "0", "8 x"), "a.ies:8: candela value: expected a finite number, found \"x\""),
        (file(NEW, 1, "0 181", "0", "8 2"), "a.ies:6: vertical angle: must be from 0 to 180, not 181"),
        (
            file(NEW, 4, "-90 0", "0 90", "8 2 1 1"),
            "a.ies:4: photometric type: must be 1, 2 or 3, for C, B or A, not 4",
        ),
        (file(NEW, 1, "0 90", "0 45", "8 2 1 1"), "a.ies:7: horizontal angles from 0 to 45: must be from 0 to 90"),
        (file(NEW, 1, "0", "0", "8"), "a.ies:6: a single vertical angle: at least two are needed"),
        (file(NEW, 1, "0 90", "0", "8 2").replace("TILT=NONE", "TILT"), "a.ies: no line begins with TILT="),
        (
            file(NEW, 1, "0 90", "0", "8 2").replace(" 2 1 1 ", " 1000000000000 1 1 "),
            "a.ies:4: number of vertical angles: must be from 1 to the",
        ),
        (
            file(NEW, 1, "0 90", "0", "8 2").replace(" 2 1 1 ", " 1.5 1 1 "),
            "a.ies:4: number of vertical angles: must be",
        ),
        (
            file(NEW, 1, "0 90", "0", "8 2").replace("1000 3", "1000 -3"),
            "a.ies:4: multiplier: must be at least 0, not -3",
        ),
        ("TILT=INCLUDE\n1 2 0 90 1".into(), "a.ies:2: the file ends before tilt angle or factor"),
        ("TILT=NONE\n1 1000 1".into(), "a.ies:2: the file ends before number of vertical angles"),
    ];
    for (text, what) in faulty {
        folder.write("a.ies", &text);
        let error = load_in(&folder, LAMP).unwrap_err();
        assert!(
            error.starts_with("a.pbrt:2: LightSource \"goniometric\": ") && error.contains(what),
            "{text}\n{error}\n{what}"
        );
    }
    folder.write("a.ies", file(NEW, 1, "0 90", "0", "8 2 3"));
    assert!(load_in(&folder, LAMP).unwrap().warnings[0].text.contains("a.ies: 1 numbers after the last candela value"));
    folder.write("a.ies", file(NEW, 1, "0 90", "0", "0 0"));
    assert!(load_in(&folder, LAMP).unwrap().warnings[0].text.contains("emits nothing"));
    folder.picture("odd.exr", [3, 2], |_, _| [1.0, 1.0, 1.0]);
    folder.picture("even.exr", [2, 2], |_, _| [1.0, 1.0, 1.0]);
    folder.picture("nan.exr", [2, 2], |x, _| [x as f32, f32::NAN, 1.0]);
    folder.picture("negative.exr", [2, 2], |x, _| [-(x as f32), 1.0, 1.0]);
    for (light, what) in [
        ("\"goniometric\"", "needs the name of a file"),
        ("\"goniometric\" \"string filename\" \"none.ies\"", "cannot read \"none.ies\""),
        (
            "\"goniometric\" \"string filename\" \"odd.exr\"",
            "odd.exr: 3×2 texels: must be square, or twice as wide as high",
        ),
        ("\"goniometric\" \"string filename\" \"nan.exr\"", "nan.exr: texel (0, 0) is [0.0, NaN, 1.0]: must be finite"),
        ("\"goniometric\" \"string filename\" \"negative.exr\"", "negative.exr: texel (1, 0) is [-1.0, 1.0, 1.0]"),
        (
            "\"goniometric\" \"string filename\" \"even.exr\" \"float power\" -1",
            "\"power\": must be greater than 0, not -1",
        ),
        ("\"goniometric\" \"string filename\" \"even.exr\" \"float scale\" 1e39", "at most 3.4028235e38 is supported"),
    ] {
        let error = load_in(&folder, &format!("LightSource {light}")).unwrap_err();
        assert!(error.starts_with("a.pbrt:2: LightSource ") && error.contains(what), "{error}\n{what}");
    }
    let error =
        load_in(&folder, "Scale 1 2 1 LightSource \"goniometric\" \"string filename\" \"even.exr\"").unwrap_err();
    assert!(error.contains("rotations, reflections and uniform scales"), "{error}");
}

/// Profiles of spot and area lights that are none.
#[test]
fn faulty_profiles_name_what_is_wrong() {
    let folder = Folder::new();
    folder.write("a.ies", file(NEW, 1, "0 90", "0", "8 2"));
    folder.write("up.ies", file(NEW, 1, "90 91 180", "0", "0 8 2"));
    folder.write("lost.ies", file(NEW, 1, "0 90", "0", "8 2").replace("TILT=NONE", "TILT=none.tlt"));
    folder.picture("odd.exr", [3, 2], |_, _| [1.0, 1.0, 1.0]);
    let spot = |more: &str| format!("LightSource \"spot\" \"string profile\" {more}");
    let area = |more: &str| format!("AreaLightSource \"diffuse\" \"string profile\" {more}");
    for (light, what) in [
        (spot("\"none.ies\""), "cannot read \"none.ies\""),
        (area("\"none.ies\""), "cannot read \"none.ies\""),
        (spot("\"odd.exr\""), "odd.exr: 3×2 texels: must be square, or twice as wide as high"),
        (spot("\"up.ies\" \"float power\" -1"), "\"power\": must be greater than 0, not -1"),
        (spot("\"a.ies\" \"float scale\" 2e37"), "its greatest intensity is "),
        (area("\"a.ies\" \"float spread\" 20"), "\"spread\" and \"profile\": a light has one or the other"),
        (area("\"a.ies\" \"float scale\" 3e37"), "at most "),
    ] {
        let error = load_in(&folder, &light).unwrap_err();
        assert!(error.starts_with("a.pbrt:2: ") && error.contains(what), "{light}\n{error}\n{what}");
    }
    let quad = "Shape \"bilinearmesh\" \"point3 P\" [0 0 0  4 0 0  0 3 0  4 3 0]";
    // dark where the light shines; the file of TILT is not read
    for (light, what) in [
        (spot("\"up.ies\""), "emits nothing: its profile is dark in its cone"),
        (area(&format!("\"up.ies\" {quad}")), "emits nothing"),
        (spot("\"lost.ies\""), "lost.ies:3: the factors of TILT are ignored"),
        (spot("\"up.ies\" \"float coneangle\" 20"), "emits nothing"),
    ] {
        let scene = load_in(&folder, &light).unwrap_or_else(|error| panic!("{error}"));
        assert!(scene.warnings[0].text.contains(what), "{light}\n{:?}", scene.warnings);
    }
    let scene = load_in(&folder, &area("\"a.ies\" Shape \"sphere\"")).unwrap();
    let emission = scene.shapes[0].emission.unwrap();
    assert_eq!((emission.spread, emission.profile, scene.stand_ins.len()), (None, None, 1));
    // triangles in a plane share what they have
    let two = "Shape \"trianglemesh\" \"integer indices\" [0 1 2 1 3 2] \"point3 P\" [0 0 0  4 0 0  0 3 0  4 3 0]";
    let scene = load_in(&folder, &area(&format!("\"a.ies\" {two} Rotate 90 1 0 0 {quad}"))).unwrap();
    let profiles: Vec<_> = scene.shapes.iter().map(|shape| shape.emission.unwrap().profile).collect();
    assert_eq!((profiles, scene.profiles.len()), (vec![Some(0), Some(0), Some(1)], 2));
}
