//! Reading of pictures that shapes emit.

use crate::kit::Folder;
use crate::pbrt::text::{warnings, world};
use etendue_render::scene::light_picture::LightPicture;
use etendue_render::scene::{Geometry, Parallelogram, Scene, Shape};
use etendue_scene::parse;

/// A folder with a picture of 3 × 2 texels, (column, row, 1) in each.
fn folder() -> Folder {
    let folder = Folder::new();
    folder.picture("p.exr", [3, 2], |x, y| [x as f32, y as f32, 1.0]);
    folder
}

const LIGHT: &str = "AreaLightSource \"diffuse\" \"string filename\" \"p.exr\"";
const QUAD: &str = "Shape \"bilinearmesh\" \"point3 P\" [0 0 0  4 0 0  0 3 0  4 3 0]";

fn load(folder: &Folder, text: &str) -> Scene {
    parse(&world(text), "a.pbrt", folder.root()).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// What the picture of a shape shows at coordinates of its surface.
fn at(scene: &Scene, shape: usize, st: [f32; 2]) -> [f32; 3] {
    let LightPicture { picture, factor, .. } =
        &scene.pictures[scene.shapes[shape].emission.unwrap().picture.unwrap() as usize];
    let color = picture.at(st);
    std::array::from_fn(|k| color[k] * factor[k])
}

fn near(found: [f32; 3], wanted: [f32; 3]) {
    assert!((0..3).all(|k| (found[k] - wanted[k]).abs() < 1e-5), "{found:?}, {wanted:?}");
}

/// The first row of the image is at v = 1, as in pbrt.
#[test]
fn quads_show_pictures_upright() {
    let folder = folder();
    let scene = load(&folder, &format!("{LIGHT} \"float scale\" 2 {QUAD}"));
    assert_eq!((warnings(&scene), scene.shapes.len()), (Vec::new(), 1));
    near(scene.shapes[0].emission.unwrap().radiance, [2.0, 1.0, 2.0]);
    near(at(&scene, 0, [0.5 / 3.0, 0.75]), [0.0, 0.0, 2.0]);
    near(at(&scene, 0, [1.0, 0.0]), [4.0, 2.0, 2.0]);
    // beyond the middles of the outermost texels, their values go on
    near(at(&scene, 0, [0.9, 0.5]), [4.0, 1.0, 2.0]);
    // a shape that is turned around keeps the picture in its place
    let turned = load(&folder, &format!("{LIGHT} ReverseOrientation {QUAD}"));
    let Geometry::Parallelogram(Parallelogram { u, v, .. }) = turned.shapes[0].geometry else { panic!() };
    assert_eq!((u, v), ([0.0, 3.0, 0.0], [4.0, 0.0, 0.0]));
    near(at(&turned, 0, [0.0, 1.0]), [2.0, 1.0, 1.0]);
    // the file is read once
    let two = load(&folder, &format!("{LIGHT} {QUAD} {LIGHT} \"rgb L\" [1 0 3] Translate 0 0 1 {QUAD}"));
    let texels = |k: usize| std::sync::Arc::as_ptr(&two.pictures[k].picture.texels);
    assert_eq!((two.pictures[1].factor, texels(0)), ([1.0, 0.0, 3.0], texels(1)));
    assert!(two.inputs.iter().any(|input| input.path == folder.path("p.exr")), "{:?}", two.inputs);
}

#[test]
fn triangles_and_given_coordinates() {
    let folder = folder();
    let mesh = "\"point3 P\" [0 0 0  1 0 0  0 1 0]";
    let plain = load(&folder, &format!("{LIGHT} Shape \"trianglemesh\" {mesh}"));
    // pbrt's default coordinates are (0, 0), (1, 0), (1, 1)
    near(at(&plain, 0, [0.0, 0.0]), [0.0, 1.0, 1.0]);
    near(at(&plain, 0, [0.0, 1.0]), [2.0, 0.0, 1.0]);
    // turned around by its normals
    let given = format!("{mesh} \"point2 uv\" [.5 .25  .5 .75  .5 .25] \"normal N\" [0 0 -1  0 0 -1  0 0 -1]");
    let turned = load(&folder, &format!("{LIGHT} Shape \"trianglemesh\" {given}"));
    near(at(&turned, 0, [0.0, 1.0]), [1.0, 0.0, 1.0]);
    near(at(&turned, 0, [1.0, 0.0]), [1.0, 1.0, 1.0]);
    near(turned.shapes[0].emission.unwrap().radiance, [1.0, 2.0 / 3.0, 1.0]);
    // coordinates that no affine map gives to a quad make triangles
    let bent = load(&folder, &format!("{LIGHT} {QUAD} \"point2 uv\" [0 0  1 0  0 1  .5 .5]"));
    assert!(bent.shapes.len() >= 8 && bent.shapes.iter().all(|s| matches!(s.geometry, Geometry::Triangle(_))));
    let area = |shape: &Shape| shape.geometry.area();
    let mean = bent.shapes.iter().map(|s| area(s) * f64::from(s.emission.unwrap().radiance[2])).sum::<f64>() / 12.0;
    assert!((mean - 1.0).abs() < 1e-5, "{mean}");
}

/// Textures of reflectance, roughness and opacity name what no surface can have, as lights do.
#[test]
fn faulty_textures_are_named() {
    let folder = Folder::new();
    for (name, x) in [("nan.exr", f32::NAN), ("infinite.exr", f32::INFINITY), ("negative.exr", -0.5)] {
        folder.picture(name, [2, 2], |c, r| [if (c, r) == (1, 0) { x } else { 0.25 }, 1.0, 0.5]);
    }
    for (value, user) in [
        ("spectrum", "Material \"diffuse\" \"texture reflectance\" \"t\""),
        ("float", "Material \"conductor\" \"texture roughness\" \"t\""),
        ("float", "Attribute \"shape\" \"texture alpha\" \"t\""),
    ] {
        let read = |name: &str| {
            let texture = format!("Texture \"t\" \"{value}\" \"imagemap\" \"string filename\" \"{name}\"");
            parse(&world(&format!("LightSource \"point\"\n{texture}\n{user}\n{QUAD}")), "a.pbrt", folder.root())
        };
        for (name, what) in [("nan.exr", "[NaN, 1.0, 0.5]"), ("infinite.exr", "[inf, 1.0, 0.5]")] {
            let error = read(name).unwrap_err().to_string();
            assert!(error.starts_with("a.pbrt:3: Texture \"t\": "), "{error}");
            assert!(error.contains(&format!("{name}: texel (1, 0) is {what}: must be finite")), "{error}");
        }
        let found = warnings(&read("negative.exr").unwrap());
        let wanted = "a.pbrt:3: Texture \"t\": negative.exr: negative values in 1 texel(s) are replaced by 0";
        assert_eq!(found, [wanted], "{user}");
    }
}

/// What shows only dark texels is an ordinary surface.
#[test]
fn dark_parts_are_no_lights() {
    let folder = folder();
    folder.picture("p.exr", [8, 1], |x, _| [0.0, if x == 7 { 1e-44 } else { 0.0 }, 0.0]);
    let dark = "\"point2 uv\" [0 0  .5 0  0 1  .5 1]";
    let scene = load(&folder, &format!("{LIGHT} {QUAD} {dark} Translate 0 0 1 {QUAD}"));
    assert_eq!((scene.shapes.len(), scene.triangles.len(), scene.pictures.len()), (1, 2, 1));
    let radiance = scene.shapes[0].emission.unwrap().radiance;
    assert_eq!(radiance, [0.0, f32::MIN_POSITIVE, 0.0]);
    folder.picture("p.exr", [2, 2], |_, _| [0.0; 3]);
    let scene = load(&folder, &format!("{LIGHT}\n{QUAD}"));
    assert!(scene.shapes.is_empty() && warnings(&scene)[0].contains("emits nothing"), "{:?}", warnings(&scene));
}

#[test]
fn faulty_pictures_are_named() {
    let folder = folder();
    let write = |name: &str, x: f32| {
        folder.picture(name, [2, 2], |c, r| [if (c, r) == (1, 0) { x } else { 1.0 }, 1.0, 1.0]);
    };
    write("nan.exr", f32::NAN);
    write("infinite.exr", f32::INFINITY);
    write("bright.exr", 3e37);
    write("negative.exr", -1.0);
    folder.write("text.png", "text");
    let light = |name: &str, more: &str| {
        let text = format!("AreaLightSource \"diffuse\" \"string filename\" \"{name}\" {more}\n{QUAD}");
        parse(&world(&text), "a.pbrt", folder.root())
    };
    for (name, more, what) in [
        ("nan.exr", "", "nan.exr: texel (1, 0) is [NaN, 1.0, 1.0]: must be finite"),
        ("infinite.exr", "", "infinite.exr: texel (1, 0) is [inf, 1.0, 1.0]: must be finite"),
        ("bright.exr", "\"float scale\" 2", "the radiance [6"),
        ("text.png", "", "not a picture: it begins with \"text\""),
        ("none.exr", "", "cannot read"),
    ] {
        let message = light(name, more).unwrap_err().to_string();
        assert!(message.starts_with("a.pbrt:2: AreaLightSource \"diffuse\": ") && message.contains(what), "{message}");
    }
    let scene = light("negative.exr", "").unwrap();
    assert!(warnings(&scene)[0].contains("negative.exr: negative values in 1 texel(s)"), "{:?}", warnings(&scene));
    near(scene.shapes[0].emission.unwrap().radiance, [0.75, 1.0, 1.0]);
}

/// A changed texture or mesh makes another scene, even if the scene file stays as it was.
#[test]
fn digests_depend_on_all_files_of_a_scene() {
    let folder = Folder::new();
    let ply = |x: u8| {
        format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
             element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n{x} 0 0\n0 1 0\n3 0 1 2\n"
        )
    };
    let picture = |x: f32| [&b"PF\n1 1\n-1.0\n"[..], &[x; 3].map(f32::to_le_bytes).concat()].concat();
    folder.write("mesh.ply", ply(1));
    folder.write("picture.pfm", picture(0.25));
    folder.write(
        "scene.pbrt",
        "Camera \"perspective\"\nWorldBegin\nLightSource \"point\"\n\
         Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"picture.pfm\"\n\
         Material \"diffuse\" \"texture reflectance\" \"t\"\nShape \"plymesh\" \"string filename\" \"mesh.ply\"\n",
    );
    let load = || etendue_scene::load(folder.path("scene.pbrt")).unwrap();
    let found = || load().digest();
    let first = found();
    assert_eq!(found(), first);
    folder.write("picture.pfm", picture(0.5));
    let second = found();
    assert_ne!(second, first);
    folder.write("mesh.ply", ply(2));
    assert_ne!(found(), second);
    folder.write("picture.pfm", picture(0.25));
    folder.write("mesh.ply", ply(1));
    assert_eq!(found(), first);
    // what counts is what was read, even if the file has changed since
    let scene = load();
    folder.write("mesh.ply", ply(2));
    assert_eq!(scene.digest(), first);
}
