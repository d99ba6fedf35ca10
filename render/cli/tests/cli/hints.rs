//! Hints after an image, its exposure, and the list of what a file has.

use crate::{Folder, scene};
use std::fs;

/// The PNG is as bright as the film's speed and `--exposure` say, the EXR is not, and one line says what may help.
#[test]
fn pictures_for_viewing_are_exposed() {
    let folder = Folder::new();
    let lit = |strength: &str, film: &str| {
        let text = scene("").replace("[2 2 2]", strength).replace("Film \"rgb\"", &format!("Film \"rgb\" {film}"));
        fs::write(folder.path("a.pbrt"), text).unwrap();
    };
    let render = |more: &[&str]| {
        let output = folder.run(&[&["render", "a.pbrt", "--spp", "4", "--seed", "1", "-o", "a.exr"], more].concat());
        let said = String::from_utf8(output.stderr).unwrap();
        let read = |name: &str| fs::read(folder.path(name)).unwrap();
        (
            read("a.exr"),
            read("a.png"),
            said.lines().filter(|line| line.starts_with("hint:")).map(str::to_owned).collect::<Vec<_>>(),
        )
    };
    lit("[2 2 2]", "");
    let (exr, png, hints) = render(&[]);
    assert_eq!(hints, [""; 0]);
    let brighter = render(&["--exposure", "2"]);
    assert!(brighter.0 == exr && brighter.1 != png);
    lit("[2 2 2]", "\"float iso\" 400");
    let fast = render(&[]);
    assert_eq!(fast.1, brighter.1, "four times the speed are two stops");
    assert_eq!(render(&["--exposure", "-2"]).1, png);
    lit("[2e5 2e5 2e5]", "");
    let [hint] = &render(&[]).2[..] else { panic!() };
    assert!(hint.starts_with("hint: the PNG is nearly white: --exposure -"), "{hint}");
    lit("[2e-4 2e-4 2e-4]", "");
    let [hint] = &render(&[]).2[..] else { panic!() };
    assert!(hint.contains("nearly black: --exposure ") && hint.ends_with("--environment FILE adds a sky"), "{hint}");
    lit("[0 0 0]", "");
    let [hint] = &render(&[]).2[..] else { panic!() };
    assert!(hint.contains("the image is black"), "{hint}");
}

/// Where only textures emit, a sky may be missing, and where a number of samples makes a sampler useless, another one is named.
#[test]
fn screens_and_odd_numbers_have_hints() {
    let folder = Folder::new();
    let said = |light: &str, more: &[&str]| {
        let text = format!(
            "LookAt 0 3 0.1 0 0 0 0 0 1 Camera \"perspective\" Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\n\
             WorldBegin {light}\nShape \"bilinearmesh\" \"point3 P\" [-4 5 -4  4 5 -4  -4 5 4  4 5 4]\n\
             AttributeEnd Shape \"bilinearmesh\" \"point3 P\" [-9 0 9  9 0 9  -9 0 -9  9 0 -9]"
        );
        fs::write(folder.path("a.pbrt"), text).unwrap();
        let output = folder.run(&[&["render", "a.pbrt", "-o", "a.exr"], more].concat());
        let said = String::from_utf8(output.stderr).unwrap();
        said.lines().filter(|line| line.starts_with("hint:")).map(str::to_owned).collect::<Vec<_>>()
    };
    fs::write(
        folder.path("a.pfm"),
        [
            &b"PF\n2 1\n-1\n"[..],
            &[0.5_f32, 0.25].map(|x| [x; 3]).as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>(),
        ]
        .concat(),
    )
    .unwrap();
    let screen = "AttributeBegin AreaLightSource \"diffuse\" \"string filename\" \"a.pfm\" \"float scale\" 0.1";
    let [hint] = &said(screen, &["--spp", "4"])[..] else { panic!() };
    assert_eq!(hint, "hint: only textures of surfaces emit light: --environment FILE adds a sky");
    assert!(said(&screen.replace("0.1", "9"), &["--spp", "4"]).is_empty(), "a bright screen lights the scene");
    let lamp = "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]";
    assert!(said(lamp, &["--spp", "4"]).is_empty());
    let [hint] = &said(lamp, &["--spp", "7"])[..] else { panic!() };
    assert!(hint.contains("--spp 8 has less noise"), "{hint}");
    assert!(said(lamp, &["--spp", "7", "--sampler", "independent"]).is_empty(), "who asks for it has it");
    let [hint] = &said(lamp, &["--spp", "4", "--sets", "4", "--sampler", "sobol"])[..] else { panic!() };
    assert!(hint.contains("sets of one sample") && hint.contains("--spp 16"), "{hint}");
}

/// A sky that lights a room through a window is worth a portal, and one line says so; with it, or in the open, there is none.
#[test]
fn windows_are_worth_a_portal() {
    let folder = Folder::new();
    // a room of a floor, a ceiling and four walls, of which the one ahead has a gap
    let wall = |points: &str| format!("Shape \"bilinearmesh\" \"point3 P\" [{points}]\n");
    let room = [
        "-2 0 -2  2 0 -2  -2 0 2  2 0 2",
        "-2 3 -2  2 3 -2  -2 3 2  2 3 2",
        "-2 0 -2  -2 3 -2  -2 0 2  -2 3 2",
        "2 0 -2  2 3 -2  2 0 2  2 3 2",
        "-2 0 2  2 0 2  -2 3 2  2 3 2",
        "-2 0 -2  -.5 0 -2  -2 3 -2  -.5 3 -2",
        ".5 0 -2  2 0 -2  .5 3 -2  2 3 -2",
    ];
    let said = |portal: &str, walls: &[&str]| {
        let walls: String = walls.iter().map(|points| wall(points)).collect();
        let text = format!(
            "LookAt 0 1.5 1.5 0 .5 0 0 1 0 Camera \"perspective\" Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\n\
             WorldBegin LightSource \"infinite\" {portal}\n{walls}"
        );
        fs::write(folder.path("a.pbrt"), text).unwrap();
        let output = folder.run(&["render", "a.pbrt", "--spp", "64", "-o", "a.exr"]);
        String::from_utf8(output.stderr).unwrap()
    };
    let hint = said("", &room);
    assert!(hint.starts_with("hint: what the camera sees is open to the sky in ") && hint.contains("portal"), "{hint}");
    assert_eq!(said("\"point3 portal\" [-.5 0 -2  .5 0 -2  .5 3 -2  -.5 3 -2]", &room), "");
    assert_eq!(said("", &room[..1]), "");
}

/// The scenes and cameras of a file are listed with their numbers.
#[test]
fn files_are_listed() {
    let folder = Folder::new();
    let camera = |name: &str| {
        format!(r#"{{"type": "perspective", "name": "{name}", "perspective": {{"yfov": 1, "znear": 1}}}}"#)
    };
    let text = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0, 1], "name": "day"}}, {{"nodes": [1]}}],
            "nodes": [{{"camera": 0}}, {{"camera": 1}}], "cameras": [{}, {}]}}"#,
        camera("left"),
        camera("right")
    );
    fs::write(folder.path("a.gltf"), text).unwrap();
    let all = folder.succeed(&["list", "a.gltf"]);
    assert_eq!(all, "scenes\n  0    day\n  1    \ncameras\n  0    left\n  1    right\n");
    assert!(folder.succeed(&["list", "a.gltf", "--scene", "1"]).ends_with("cameras\n  0    right\n"));
}
