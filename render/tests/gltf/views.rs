//! Tests of cameras and lights.

use crate::gltf::asset::Asset;
use crate::kit::Folder;
use etendue_render::lights::sky::Sky;
use etendue_render::packet::V8;
use etendue_render::scene::{CameraSettings, Screen};
use etendue_scene::{Asked, SceneError, load_as};
use serde_json::{Value, json};
use std::path::Path;

/// A scene under a sky.
fn under(scene: &Path, sky: &Path) -> Result<etendue_render::scene::Scene, SceneError> {
    load_as(scene, &Asked { sky: Some(sky.to_owned()), ..Asked::default() })
}

/// The position of a point in an image, from the top left, by the formula of [`CameraSettings`].
fn project(camera: &CameraSettings, size: [u32; 2], point: [f64; 3]) -> [f64; 2] {
    let offset = [0, 1, 2].map(|k| point[k] - camera.origin[k]);
    let along = |axis: [f64; 3]| axis.iter().zip(offset).map(|(a, b)| a * b).sum::<f64>();
    let depth = along(camera.forward);
    assert!(depth > 0.0, "{point:?} is behind {camera:?}");
    let [_, x, _, y] = camera.edges(size[0], size[1]);
    [(along(camera.right) / depth / x + 1.0) / 2.0, (1.0 - along(camera.up) / depth / y) / 2.0]
}

fn with_camera(perspective: Value, node: Value) -> Asset {
    let mut asset = Asset::of_triangle();
    let camera = asset.add("cameras", json!({"type": "perspective", "perspective": perspective}));
    let node = asset.add("nodes", node);
    asset.json["nodes"][node]["camera"] = json!(camera);
    asset
}

/// The camera of a scene, and the size of its image.
fn camera(asset: &Asset) -> (CameraSettings, [u32; 2]) {
    let scene = asset.read();
    (scene.camera, [scene.film.width, scene.film.height])
}

fn near(found: [f64; 2], wanted: [f64; 2]) {
    assert!((found[0] - wanted[0]).abs() < 1e-4 && (found[1] - wanted[1]).abs() < 1e-4, "{found:?}, not {wanted:?}");
}

#[test]
fn cameras_look_along_minus_z_and_do_not_mirror() {
    let right = std::f64::consts::FRAC_PI_2;
    let asset = with_camera(json!({"yfov": right, "znear": 0.1, "aspectRatio": 2}), json!({"translation": [0, 0, 5]}));
    let (settings, size) = camera(&asset);
    assert_eq!(size, [1280, 640]);
    assert!(matches!(settings.screen, Screen::Half(half) if (half - 1.0).abs() < 1e-6));
    near(project(&settings, size, [0.0; 3]), [0.5, 0.5]);
    // to the right, and up
    near(project(&settings, size, [5.0, 2.5, 0.0]), [0.75, 0.25]);
    assert_eq!(asset.warnings(), [""; 0]);

    // a camera that is turned to look along −x has −z to its right; scales of nodes do not matter
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let node = json!({"translation": [5, 0, 0], "rotation": [0, half, 0, half], "scale": [3, 2, 7]});
    let (settings, size) = camera(&with_camera(json!({"yfov": right, "znear": 0.1}), node));
    assert_eq!(size, [1280, 720]);
    near(project(&settings, size, [0.0, 5.0, 0.0]), [0.5, 0.0]);
    let [x, _] = project(&settings, size, [0.0, 0.0, -5.0]);
    assert!((x - (0.5 + 0.5 * 720.0 / 1280.0)).abs() < 1e-4, "{x}");
}

#[test]
fn the_vertical_angle_of_upright_images_is_kept() {
    let asset = with_camera(json!({"yfov": 1, "znear": 0.1, "aspectRatio": 0.5}), json!({}));
    let (settings, size) = camera(&asset);
    assert_eq!(size, [1280, 2560]);
    let [.., vertical] = settings.edges(size[0], size[1]);
    assert!((vertical - 0.5_f64.tan()).abs() < 1e-9);
    // sizes stay possible
    for (aspect, height) in [(1e-9, 65_536), (1e9, 1)] {
        let (settings, size) = camera(&with_camera(json!({"yfov": 1, "znear": 1, "aspectRatio": aspect}), json!({})));
        assert_eq!(size, [1280, height]);
        assert!((settings.edges(size[0], size[1])[3] - 0.5_f64.tan()).abs() < 1e-9);
    }
}

#[test]
fn the_first_camera_counts() {
    let mut asset = with_camera(json!({"yfov": 0.5, "znear": 1}), json!({}));
    asset.add("cameras", json!({"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}));
    asset.json["nodes"] = json!([{"mesh": 0}, {"camera": 1}, {"camera": 0}]);
    let (first, size) = camera(&asset);
    assert!((first.edges(size[0], size[1])[3] - 0.5_f64.tan()).abs() < 1e-9);
}

/// Negative magnitudes mirror.
#[test]
fn orthographic_cameras() {
    let with = |xmag: f64, ymag: f64| {
        let shown = json!({"xmag": xmag, "ymag": ymag, "zfar": 10, "znear": 0.1});
        let mut asset = with_camera(json!({}), json!({}));
        asset.json["cameras"][0] = json!({"type": "orthographic", "orthographic": shown});
        asset
    };
    for (xmag, ymag, height) in [(3.0, 1.5, 640), (-3.0, 1.5, 640), (2.0, -8.0, 5120)] {
        let (settings, size) = camera(&with(xmag, ymag));
        assert_eq!(size, [1280, height]);
        assert_eq!([settings.right[0], settings.up[1]], [xmag, ymag].map(f64::signum));
    }
    assert_eq!(with(0.0, 1.0).error(), "a.glb: camera 0: xmag 0 and ymag 1: must be finite and not 0");
}

#[test]
fn scenes_without_a_camera_are_framed() {
    let mut asset = Asset::of_triangle();
    asset.json["nodes"][0]["translation"] = json!([100, -3, 7]);
    asset.json["nodes"][0]["scale"] = json!([10, 20, 30]);
    let (settings, size) = camera(&asset);
    assert_eq!((size, settings.screen), ([1280, 720], Screen::Half(libm::tan(40_f64.to_radians() / 2.0))));
    let places = [[100.0, -3.0, 7.0], [110.0, -3.0, 7.0], [100.0, 17.0, 7.0]].map(|p| project(&settings, size, p));
    assert!(places.iter().flatten().all(|x| (0.0..=1.0).contains(x)), "{places:?}");
    // neither mirrored nor upside down
    assert!(places[1][0] > places[0][0] && places[2][1] < places[0][1], "{places:?}");
    near(project(&settings, size, [105.0, 7.0, 7.0]), [0.5, 0.5]);
    // lights count, and a scene of nothing has some camera
    let lit = Asset::of_material(json!({"emissiveFactor": [1, 1, 1]})).read();
    assert!(lit.camera.origin.iter().all(|x| x.abs() < 10.0));
    let empty = Asset::new().read();
    assert!(empty.triangles.is_empty() && empty.camera.origin.iter().all(|x| x.is_finite()));
}

fn light(light: Value, node: Value) -> Asset {
    let mut asset = Asset::of_triangle();
    asset.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [light]}});
    asset.json["extensionsRequired"] = json!(["KHR_lights_punctual"]);
    let node = asset.add("nodes", node);
    asset.json["nodes"][node]["extensions"] = json!({"KHR_lights_punctual": {"light": 0}});
    asset
}

#[test]
fn lights_that_are_dark_or_wrong() {
    let of = |described: Value| light(described, json!({"scale": [0, 0, 0]}));
    let dark = of(json!({"type": "point", "intensity": 0}));
    assert!(dark.read().delta_lights.is_empty());
    assert_eq!(dark.warnings(), ["a.gltf: node 1: its light emits nothing (reported once)"]);
    let cases = [
        (json!({"type": "area"}), "light 0: its type is not \"point\", \"spot\" or \"directional\""),
        (json!({"type": "spot"}), "light 0: a spot light without \"spot\""),
        (json!({"type": "directional"}), "node 1: its transform leaves its light no direction"),
        (
            json!({"type": "point", "intensity": -1}),
            "light 0: color [1.0, 1.0, 1.0] times intensity -1 must be finite and at least 0",
        ),
        (
            json!({"type": "spot", "spot": {"innerConeAngle": 1, "outerConeAngle": 0.5}}),
            "light 0: innerConeAngle 1 and outerConeAngle 0.5: must be from 0 to π/2, and the inner one the lesser",
        ),
    ];
    for (described, wanted) in cases {
        assert_eq!(of(described).error(), format!("a.glb: {wanted}"));
    }
    // flat along the direction of the light, but for rounding; a camera there sees nothing
    let half = std::f64::consts::FRAC_1_SQRT_2;
    for turn in [[-half, 0.0, 0.0, half], [-0.5, -0.5, -0.5, 0.5], [-half, 0.0, 0.0, half + 6e-8]] {
        for kind in ["directional", "spot"] {
            let described = json!({"type": kind, "spot": {"outerConeAngle": 0.5}});
            let mut flat = light(described, json!({"rotation": turn}));
            flat.add("nodes", json!({"scale": [1, 0, 1], "children": [1]}));
            flat.json["scenes"] = json!([{"nodes": [0, 2]}]);
            assert_eq!(flat.error(), "a.glb: node 1: its transform leaves its light no direction", "{turn:?}");
            let mut seen = with_camera(json!({"yfov": 1, "znear": 1}), json!({"rotation": turn}));
            seen.add("nodes", json!({"scale": [1, 0, 1], "children": [1]}));
            seen.json["scenes"] = json!([{"nodes": [0, 2]}]);
            assert_eq!(seen.error(), "a.glb: node 1: the transform of its camera is singular", "{turn:?}");
        }
    }
}

/// Cameras and scenes are chosen by their names or numbers; without a choice, several cameras are a warning.
#[test]
fn cameras_and_scenes_are_chosen() {
    let mut asset = Asset::of_triangle();
    for (name, yfov) in [("wide", 1.5), ("narrow", 0.5)] {
        let perspective = json!({"yfov": yfov, "znear": 1});
        let camera = asset.add("cameras", json!({"type": "perspective", "perspective": perspective, "name": name}));
        asset.add("nodes", json!({"camera": camera, "name": format!("node of {name}"), "translation": [0, 0, yfov]}));
    }
    asset.json["scenes"] = json!([{"nodes": [0, 1, 2], "name": "day"}, {"nodes": [0, 2], "name": "night"}]);
    let folder = Folder::new();
    let path = folder.write("a.gltf", asset.text());
    let of = |camera: Option<&str>, scene: Option<&str>| {
        load_as(&path, &Asked { camera: camera.map(str::to_owned), scene: scene.map(str::to_owned), sky: None })
    };
    let seen = |camera: Option<&str>, scene: Option<&str>| {
        let scene = of(camera, scene).unwrap();
        (scene.camera.origin[2] as f32, scene.warnings.iter().any(|warning| warning.text.contains("cameras")))
    };
    assert_eq!(seen(None, None), (1.5, true));
    for camera in ["narrow", "node of narrow", "1"] {
        assert_eq!(seen(Some(camera), None), (0.5, false), "{camera}");
    }
    assert_eq!(seen(Some("0"), None), (1.5, false));
    assert_eq!([seen(None, Some("night")), seen(None, Some("1"))], [(0.5, false); 2]);
    let wrong = |camera: Option<&str>, scene: Option<&str>| of(camera, scene).unwrap_err().to_string();
    assert!(
        wrong(Some("narow"), None).ends_with("has no camera \"narow\": there are 2, from 0 on; did you mean narrow?")
    );
    assert!(wrong(Some("2"), None).ends_with("has no camera \"2\": there are 2, from 0 on"));
    assert!(wrong(None, Some("nigt")).ends_with("has no scene \"nigt\": there are 2, from 0 on; did you mean night?"));
    let contents = |scene: Option<&str>| {
        etendue_scene::contents(&path, &Asked { scene: scene.map(str::to_owned), ..Asked::default() }).unwrap()
    };
    assert_eq!(
        (contents(None).scenes, contents(None).cameras),
        (vec!["day".to_owned(), "night".into()], vec!["wide".to_owned(), "narrow".into()])
    );
    assert_eq!(contents(Some("night")).cameras, ["narrow"]);
    let plain = folder.write("a.pbrt", b"Camera \"perspective\" WorldBegin");
    let asked = Asked { camera: Some("0".to_owned()), ..Asked::default() };
    let text = load_as(&plain, &asked).unwrap_err().to_string();
    assert!(text.ends_with("files of pbrt have one camera: camera cannot be chosen"), "{text}");
}

/// The right half of the image of a sky is where +z is, with +y up; the warning of a scene without lights goes.
#[test]
fn a_sky_is_added() {
    let folder = Folder::new();
    let asset = Asset::of_triangle();
    let scene = folder.write("a.gltf", asset.text());
    // a PFM image has its lowest row first
    let texels: [f32; 8] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
    let mut image = b"Pf\n4 2\n-1.0\n".to_vec();
    image.extend(texels.iter().flat_map(|x| x.to_le_bytes()));
    let sky = folder.write("sky.pfm", &image);
    let loaded = under(&scene, &sky).unwrap();
    assert!(loaded.warnings.iter().all(|warning| !warning.text.contains("emits")), "{:?}", loaded.warnings);
    assert!([&sky, &scene].iter().all(|path| loaded.inputs.iter().any(|input| input.path == **path)));
    let seen = Sky::new(loaded.environment.as_ref().unwrap());
    let at = |direction: [f32; 3]| seen.radiance(V8::default(), direction.into()).x.to_array()[0];
    // the columns begin at −x, and go on over −z, +x and +z
    let columns = [[-1.0, -0.5], [1.0, -0.5], [1.0, 0.5], [-1.0, 0.5]];
    let found = [-1.0, 1.0].map(|y| columns.map(|[x, z]| at([x, y, z])));
    assert_eq!(found.as_flattened(), texels);

    // in a pbrt file +z is up
    let plain = folder.write("a.pbrt", b"Camera \"perspective\" WorldBegin LightSource \"infinite\"");
    let loaded = under(&plain, &sky).unwrap();
    assert!(loaded.warnings.is_empty());
    let seen = Sky::new(loaded.environment.as_ref().unwrap());
    let up = seen.radiance(V8::default(), [0.1, 0.1, 1.0].into()).x.to_array()[0];
    assert_eq!(up, texels[4]);

    let failed = |path: &Path| under(&plain, path).unwrap_err().to_string();
    let missing = folder.path("none.exr");
    assert!(failed(&missing).starts_with(&format!("{}: cannot read", missing.display())), "{}", failed(&missing));
    let text = failed(&plain);
    assert!(text.starts_with(&format!("{}: not a picture", plain.display())), "{text}");
    image[12..16].copy_from_slice(&f32::NAN.to_le_bytes());
    let text = failed(&folder.write("nan.pfm", &image));
    assert!(text.contains("texel (0, 1)") && text.contains("NaN"), "{text}");
}

/// A node that places its mesh several times is the same as several nodes.
#[test]
fn nodes_that_place_their_mesh_several_times() {
    let shifts = [[1.0, 2.0, 3.0], [-4.0, 0.5, 0.0], [0.0, 0.0, 9.0]];
    let turns = [[0.0, 0.0, 0.6, 0.8], [0.0, 1.0, 0.0, 0.0], [0.5, 0.5, 0.5, 0.5]];
    let scales = [[1.0, 2.0, 3.0], [0.5, 0.5, 0.5], [-1.0, 1.0, 1.0]];
    let above = json!({"translation": [10, 0, 0], "rotation": [0.6, 0, 0, 0.8], "children": []});
    let mut asset = Asset::of_triangle();
    let (t, r, s) = (asset.floats(&shifts), asset.floats(&turns), asset.floats(&scales));
    let attributes = json!({"TRANSLATION": t, "ROTATION": r, "SCALE": s});
    let extension = |attributes: &Value| json!({"EXT_mesh_gpu_instancing": {"attributes": attributes}});
    asset.json["nodes"] = json!([above, {"mesh": 0, "extensions": extension(&attributes)}]);
    asset.json["nodes"][0]["children"] = json!([1]);
    asset.json["scenes"] = json!([{"nodes": [0]}]);
    asset.json["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
    assert!(asset.warnings().is_empty());
    let mut apart = asset.clone();
    let node = |k: usize| json!({"mesh": 0, "translation": shifts[k], "rotation": turns[k], "scale": scales[k]});
    apart.json["nodes"] = json!([above, node(0), node(1), node(2)]);
    apart.json["nodes"][0]["children"] = json!([1, 2, 3]);
    assert_eq!(apart.read().triangles.len(), 3);
    assert_eq!(asset.read().triangles, apart.read().triangles);

    // each attribute may be absent
    let of = |attributes: Value| {
        let mut other = asset.clone();
        other.json["nodes"][1]["extensions"] = extension(&attributes);
        other
    };
    assert_eq!(of(json!({"SCALE": s})).read().triangles.len(), 3);
    assert!(of(json!({})).read().triangles.is_empty());
    let item = "a.glb: node 1, EXT_mesh_gpu_instancing";
    // a flat copy is left out, one without a depth is not
    let mut flat = asset.clone();
    let scales = flat.floats(&[[0.0, 1.0, 1.0], [0.0; 3], [1.0, 1.0, 0.0]]);
    flat.json["nodes"][1]["extensions"] = extension(&json!({"SCALE": scales}));
    assert_eq!((flat.read().triangles.len(), flat.warnings().len()), (1, 1));
    assert_eq!(of(json!({"ROTATION": -1})).error(), format!("{item}: \"ROTATION\" is no index of an accessor: -1"));
    assert!(of(json!({"ROTATION": t})).error().contains("its type is Vec3, not Vec4"));
    let mut short = of(attributes);
    let two = short.floats(&shifts[..2]);
    short.json["nodes"][1]["extensions"] = extension(&json!({"TRANSLATION": two, "SCALE": s}));
    assert_eq!(short.error(), format!("{item}: its attributes are of different lengths"));
    let wrong = short.floats(&[[0.0; 4]]);
    short.json["nodes"][1]["extensions"] = extension(&json!({"ROTATION": wrong}));
    assert!(short.error().starts_with(&format!("{item}, 0: its rotation")), "{}", short.error());
}
