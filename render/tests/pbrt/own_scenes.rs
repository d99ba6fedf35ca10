//! What scene files of others have: textures, objects, spectra, powers, and what stands for something else.

use crate::kit::Folder;
use crate::pbrt::text::{LIGHT, TRIANGLE, read, sub, warnings, world};
use etendue_render::scene::texture::Texture;
use etendue_render::scene::{Details, Disk, Geometry, Material, Roughness, Scene, Screen, Sphere, Varying};
use etendue_scene::parse;

/// A scene with a light, so that the only warnings are those of the text.
fn lit(text: &str) -> Scene {
    read(&world(&format!("LightSource \"point\"\n{text}")))
}
/// The material of the first triangle or shape.
fn material(text: &str) -> (Material, Scene) {
    let scene = lit(&format!("{text}\n{TRIANGLE}"));
    (scene.materials[scene.triangle_materials[0] as usize], scene)
}
/// The material where it varies, at some texture coordinates.
fn varied(text: &str, uv: [f32; 2]) -> Material {
    match material(text) {
        (Material::Varying(index), scene) => scene.varying[index as usize].at(uv),
        (constant, _) => panic!("{text}: {constant:?} does not vary"),
    }
}

#[test]
fn textures_are_read_and_combined() {
    let board = "Texture \"b\" \"spectrum\" \"checkerboard\" \"float uscale\" 2 \"float vscale\" 2 \"rgb tex1\" [.1 .2 .3] \"rgb tex2\" [.4 .5 .6]\n";
    let use_b = "Material \"diffuse\" \"texture reflectance\" \"b\"";
    assert_eq!(varied(&format!("{board}{use_b}"), [0.1, 0.1]), Material::Diffuse([0.1, 0.2, 0.3]));
    assert_eq!(varied(&format!("{board}{use_b}"), [0.6, 0.1]), Material::Diffuse([0.4, 0.5, 0.6]));
    let scaled =
        format!("{board}Texture \"b\" \"spectrum\" \"scale\" \"texture tex\" \"b\" \"float scale\" 0.5\n{use_b}");
    assert_eq!(varied(&scaled, [0.6, 0.1]), Material::Diffuse([0.2, 0.25, 0.3]));
    let mixed = format!(
        "{board}Texture \"b\" \"spectrum\" \"mix\" \"texture tex1\" \"b\" \"rgb tex2\" [0 0 0] \"float amount\" 0.75\n{use_b}"
    );
    assert_eq!(varied(&mixed, [0.6, 0.1]), Material::Diffuse([0.1, 0.125, 0.15]));
    // a texture that is the same everywhere makes no material that varies
    let constant = "Texture \"c\" \"spectrum\" \"constant\" \"rgb value\" [.1 .2 .3]\nMaterial \"diffuse\" \"texture reflectance\" \"c\"";
    assert_eq!(material(constant).0, Material::Diffuse([0.1, 0.2, 0.3]));
    let rough = "Texture \"r\" \"float\" \"checkerboard\" \"float tex1\" 0.25 \"float tex2\" 1\n\
        Material \"conductor\" \"spectrum reflectance\" [300 .5 900 .5] \"texture roughness\" \"r\"";
    let Material::Glossy { diffuse, specular, roughness, .. } = varied(rough, [0.5, 0.5]) else { panic!() };
    assert!(diffuse == [0.0; 3] && specular.iter().all(|x| (x - 0.5).abs() < 1e-6) && roughness == 0.5.into());
    let unknown = lit("Texture \"w\" \"float\" \"windy\" \"float x\" 1\nTexture \"v\" \"float\" \"windy\"");
    assert_eq!(warnings(&unknown).len(), 1);
    assert!(unknown.stand_ins[0].text.contains("becomes 0.5 everywhere"), "{:?}", unknown.stand_ins);
}

#[test]
fn pictures_are_read_once_and_turned_upright() {
    let dir = Folder::new();
    let mut png = Vec::new();
    let mut encoder = png::Encoder::new(&mut png, 1, 2);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header().unwrap().write_image_data(&[255, 0, 0, 7, 0, 255, 51, 9]).unwrap();
    dir.write("p.png", &png);
    let text = |options: &str| {
        format!(
            "LightSource \"point\"\nTexture \"p\" \"spectrum\" \"imagemap\" \"string filename\" \"p.png\" \"string filter\" \"point\" {options}\n\
             Texture \"q\" \"spectrum\" \"imagemap\" \"string filename\" \"p.png\"\n\
             Material \"diffuse\" \"texture reflectance\" \"p\"\n{TRIANGLE}"
        )
    };
    let scene = |options: &str| parse(&world(&text(options)), "a.pbrt", dir.root()).unwrap();
    let at = |options: &str, uv| scene(options).varying[0].at(uv);
    // the first row is the upper one, where v is near 1
    assert_eq!(at("", [0.5, 0.9]), Material::Diffuse([1.0, 0.0, 0.0]));
    let Material::Diffuse([r, g, b]) = at("", [0.5, 0.1]) else { panic!() };
    assert!(r == 0.0 && g == 1.0 && (b - 0.0331).abs() < 1e-4, "{b}");
    assert_eq!(at("\"string encoding\" \"linear\"", [0.5, 0.1]), Material::Diffuse([0.0, 1.0, 0.2]));
    assert_eq!(at("\"float vdelta\" 0.5", [0.5, 0.1]), Material::Diffuse([1.0, 0.0, 0.0]));
    assert_eq!(at("\"bool invert\" true", [0.5, 0.9]), Material::Diffuse([0.0, 1.0, 1.0]));
    let read = scene("");
    let Varying::Diffuse(Texture::Picture(picture)) = &read.varying[0] else { panic!("{:?}", read.varying) };
    assert_eq!(std::sync::Arc::strong_count(&picture.texels), 1, "the second texture is not used");
    assert_eq!(picture.texels.alpha.as_deref(), Some(&[7, 9][..]));
    assert_eq!(read.inputs.iter().filter(|input| input.path.ends_with("p.png")).count(), 1, "each file once");
}

/// What pbrt accepts although it is of no use, and what its third version has.
#[test]
fn odd_and_older_files() {
    let twice = lit("Shape \"sphere\" \"float radius\" 1\n\"float radius\" 2 WorldEnd");
    assert!(matches!(twice.shapes[0].geometry, Geometry::Sphere(Sphere { radius: 2.0, .. })));
    assert!(
        warnings(&twice)[0].contains(":4: Shape \"sphere\": \"radius\": given twice: this one counts"),
        "{:?}",
        warnings(&twice)
    );
    let cameras = read("Camera \"perspective\" \"float fov\" 20 Camera \"perspective\" \"float fov\" 30 WorldBegin");
    let half = libm::tan(15_f64.to_radians());
    assert!(cameras.camera.screen == Screen::Half(half) && warnings(&cameras)[0].contains("the last one counts"));

    // a name may precede what it names
    let later = lit(&format!("NamedMaterial \"a\" MakeNamedMaterial \"a\" \"string type\" \"mirror\" {TRIANGLE}"));
    assert_eq!(later.materials[later.triangle_materials[0] as usize], Material::Mirror([0.9; 3]));
    let last = lit(&format!(
        "NamedMaterial \"a\" {TRIANGLE} Texture \"c\" \"spectrum\" \"checkerboard\" \
         MakeNamedMaterial \"a\" \"string type\" \"diffuse\" \"texture reflectance\" \"c\""
    ));
    assert!(matches!(last.materials[last.triangle_materials[0] as usize], Material::Varying(1)));
    assert!(last.details.of(0).is_some());
    // with and without holes
    let holes = TRIANGLE.trim_end().to_owned() + " \"float alpha\" .5";
    let both =
        lit(&format!("NamedMaterial \"a\" {holes} {TRIANGLE} MakeNamedMaterial \"a\" \"string type\" \"mirror\""));
    let of = |i: usize| {
        (
            both.materials[both.triangle_materials[i] as usize],
            both.masks.iter().any(|(k, _)| *k == both.triangle_materials[i]),
        )
    };
    assert_eq!([of(0), of(1)], [(Material::Mirror([0.9; 3]), true), (Material::Mirror([0.9; 3]), false)]);
    let (rough, scene) = material("Material \"conductor\" \"float roughness\" 5.8");
    assert!(
        matches!(rough, Material::Conductor { roughness: Roughness { along: 1.0, across: 1.0, .. }, .. })
            && warnings(&scene)[0].contains("5.8 counts as 1")
    );
    // copper has what is missing
    let Material::Conductor { eta, k, .. } = material("Material \"conductor\" \"rgb eta\" [1 2 3]").0 else { panic!() };
    let Material::Conductor { k: copper, .. } = material("Material \"conductor\"").0 else { panic!() };
    assert_eq!((eta, k), ([1.0, 2.0, 3.0], copper));
    let older = lit("AreaLightSource \"area\" \"rgb scale\" [1 2 3] Shape \"sphere\"");
    assert_eq!(older.shapes[0].emission.unwrap().radiance, [1.0, 2.0, 3.0]);
    // a light that rays pass
    let passed = lit(&format!("Material \"interface\" AreaLightSource \"diffuse\" {TRIANGLE}"));
    assert!(passed.shapes.is_empty() && warnings(&passed)[0].contains("emits nothing"));
    let unseen = lit("AreaLightSource \"diffuse\" Shape \"sphere\" \"float alpha\" 0");
    assert!(unseen.shapes[0].emission.unwrap().is_unseen && unseen.warnings.is_empty());

    let mesh = |uv: &str| {
        format!(
            "Material \"diffuse\" \"texture reflectance\" \"c\" Shape \"trianglemesh\" \"point P\" [0 0 0 1 0 0 0 1 0] {uv}"
        )
    };
    let board = "Texture \"c\" \"color\" \"checkerboard\"\n";
    for uv in ["\"float uv\" [0 0 3 0 0 4]", "\"float st\" [0 0 3 0 0 4]", "\"point2 uv\" [0 0 3 0 0 4]"] {
        let scene = lit(&format!("{board}{}", mesh(uv)));
        assert_eq!(scene.details.corners[0].uvs, [[0.0, 0.0], [3.0, 0.0], [0.0, 4.0]], "{uv}");
    }
}

#[test]
fn alpha_makes_holes() {
    let texture =
        "Texture \"a\" \"float\" \"checkerboard\" Texture \"b\" \"float\" \"checkerboard\" \"float uscale\" 3\n";
    let square = |alpha: &str| {
        format!(
            "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0] \"integer indices\" [0 1 2 1 3 2] {alpha}\n"
        )
    };
    let lit = |text: &str| lit(&format!("{texture}{text}"));
    let all = [
        "\"texture alpha\" \"a\"",
        "\"texture alpha\" \"b\"",
        "\"texture alpha\" \"a\"",
        "\"float alpha\" .5",
        "\"float alpha\" 0",
        "\"float alpha\" 1",
    ];
    let scene = lit(&all.map(square).concat());
    // equal masks of equal materials are one; what is not there is left out
    assert_eq!((scene.triangles.len(), scene.masks.len(), scene.warnings.len()), (10, 3, 0));
    let of = |triangle: usize| scene.masks.iter().find(|(material, _)| *material == scene.triangle_materials[triangle]);
    assert!((0..8).all(|i| of(i).is_some()) && of(8).is_none() && of(0) == of(4) && of(0) != of(2));
    assert_eq!(of(6).unwrap().1.opacity.constant(), Some([0.5; 3]));
    assert!((0..8).all(|i| scene.details.of(i).is_some()) && scene.details.of(8).is_none());
    // a sphere with holes becomes triangles, and a light has none
    assert!(lit("Shape \"sphere\" \"float alpha\" .5").shapes.is_empty());
    let lamp = lit(&format!("AreaLightSource \"diffuse\" {}", square("\"float alpha\" .5")));
    assert!(lamp.masks.is_empty() && lamp.stand_ins.len() == 1, "{:?}", lamp.warnings);
}

#[test]
fn triangles_keep_what_their_materials_need() {
    let board = "Texture \"b\" \"spectrum\" \"checkerboard\"\nMaterial \"diffuse\" \"texture reflectance\" \"b\"\n";
    let uv = "\"point2 uv\" [0 0 1 0 0 1]";
    let mesh =
        |normals: &str, uv: &str| format!("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] {normals} {uv}\n");
    let flat = "\"normal N\" [0 0 2 0 0 1 0 0 -3]";
    let bent = "\"normal N\" [0 0 1 0 1 1 1 0 -1]";
    // a plain surface keeps neither texture coordinates nor normals that are its own
    assert!(lit(&mesh(flat, uv)).details.of_triangles.is_empty());
    let scene = lit(&format!("{}{board}{}{}", mesh("", uv), mesh(flat, uv), mesh(bent, "")));
    assert_eq!(scene.details.of_triangles, [Details::NONE, 0, 1]);
    assert_eq!(scene.details.corners[0].uvs, [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    assert_eq!(scene.details.corners[0].normals, [[0.0; 3]; 3]);
    // pbrt's coordinates of a triangle without any; normals are of length 1, and as they are given
    assert_eq!(scene.details.corners[1].uvs, [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]);
    let half = std::f32::consts::FRAC_1_SQRT_2;
    assert_eq!(scene.details.corners[1].normals, [[0.0, 0.0, 1.0], [0.0, half, half], [half, 0.0, -half]]);
    let later = lit(&format!("{}{}", mesh(bent, ""), mesh("", "")));
    assert_eq!(later.details.of_triangles, [0, Details::NONE]);
    // normals turn as planes do, not as points
    let turned = lit(&format!("Scale 1 1 4\n{}", mesh(bent, "")));
    let [_, [x, y, z], _] = turned.details.corners[0].normals;
    assert!(x == 0.0 && (y / z - 4.0).abs() < 1e-6, "{y} {z}");
}

#[test]
fn objects_are_copied() {
    let object = format!("ObjectBegin \"o\" Translate 1 0 0 {TRIANGLE} ObjectEnd\n");
    let scene = lit(&format!("{object}{TRIANGLE}"));
    assert_eq!(scene.triangles.len(), 1, "an object is no part of the scene itself");
    assert_eq!(scene.triangles[0][0], [0.0; 3], "an object restores the state");
    let placed = format!(
        "{object}AttributeBegin Translate 0 5 0 ObjectInstance \"o\" AttributeEnd Scale 2 2 2 ObjectInstance \"o\""
    );
    let scene = lit(&placed);
    assert_eq!(
        scene.triangles,
        [[[1.0, 5.0, 0.0], [2.0, 5.0, 0.0], [1.0, 6.0, 0.0]], [[2.0, 0.0, 0.0], [4.0, 0.0, 0.0], [2.0, 2.0, 0.0]]]
    );
    // mirrored copies keep the side of their normals
    let bent = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"normal N\" [0 0 1 0 1 1 1 0 1]";
    let mirrored = lit(&format!("ObjectBegin \"o\" {bent} ObjectEnd Scale 1 -1 1 ObjectInstance \"o\""));
    let [corners] = mirrored.details.corners[..] else { panic!() };
    assert!(corners.normals.iter().all(|n| n[2] > 0.5) && corners.normals.iter().any(|n| n[1] < -0.5), "{corners:?}");
    let light = lit(&format!("ObjectBegin \"o\" {LIGHT}{TRIANGLE} ObjectEnd ObjectInstance \"o\""));
    assert!(light.shapes.is_empty() && light.stand_ins.len() == 1);
    let sphere = lit("ObjectBegin \"o\" Shape \"sphere\" ObjectEnd ObjectInstance \"o\"");
    assert!(sphere.triangles.len() > 3000 && sphere.shapes.is_empty());
}

#[test]
fn attributes_imports_and_media() {
    let dir = Folder::new();
    dir.write("in.pbrt", format!("Translate 1 0 0 Material \"mirror\" {TRIANGLE}").as_bytes());
    dir.write("open.pbrt", b"AttributeBegin");
    let read = |text: &str| parse(&world(&format!("LightSource \"point\" {text}")), "a.pbrt", dir.root());
    let scene = read(&format!("Import \"in.pbrt\" {TRIANGLE}")).unwrap();
    assert_eq!([scene.triangles[0][0][0], scene.triangles[1][0][0]], [1.0, 0.0]);
    assert!(scene.materials[scene.triangle_materials[1] as usize] == Material::Diffuse([0.5; 3]));
    dir.write("closed.pbrt", b"AttributeEnd");
    for (text, what) in [
        ("Import \"open.pbrt\"", "open.pbrt:1: Import: the file does not close what this line opens"),
        ("AttributeBegin Import \"closed.pbrt\"", "a.pbrt:2: Import: the file closes more than it opens"),
        ("ObjectBegin \"a\" Include \"closed.pbrt\"", "AttributeEnd: the ObjectBegin of a.pbrt:2 is not closed"),
    ] {
        let error = read(text).unwrap_err().to_string();
        assert!(error.contains(what), "{error}");
    }
    let scene = lit(
        "Attribute \"shape\" \"float radius\" 3 AttributeBegin Attribute \"shape\" \"float radius\" 2 Shape \"sphere\"\n\
         Shape \"sphere\" \"float radius\" 7 AttributeEnd Shape \"sphere\" MediumInterface \"a\" \"b\" MakeNamedMedium \"a\" \"string type\" \"cloud\"\n\
         TransformTimes 0 1 ActiveTransform EndTime Translate 9 9 9 ActiveTransform All Shape \"sphere\"",
    );
    let radii = scene.shapes.iter().map(|shape| match shape.geometry {
        Geometry::Sphere(Sphere { radius, center }) => [radius, center[0]],
        _ => panic!(),
    });
    let radii = radii.collect::<Vec<_>>();
    assert_eq!(radii, [[2.0, 0.0], [7.0, 0.0], [3.0, 0.0], [3.0, 0.0]]);
    assert_eq!(scene.stand_ins.len(), 2, "{:?}", scene.stand_ins);
}

#[test]
fn materials_become_what_direct_light_shows() {
    let coat = |text: &str| match material(text).0 {
        Material::Glossy { diffuse, specular, grazing, roughness, .. } => ([diffuse, grazing], specular, roughness),
        other => panic!("{text}: {other:?}"),
    };
    let near = |a: [f32; 3], b: f32| a.iter().all(|x| (x - b).abs() < 1e-6);
    let layered = |text: &str| match material(text).0 {
        Material::Layered { diffuse, eta, roughness } => (diffuse, eta, roughness),
        other => panic!("{text}: {other:?}"),
    };
    let rough = layered("Material \"coateddiffuse\" \"float roughness\" 0.25 \"float eta\" 1.7");
    assert_eq!(rough, ([0.5; 3], 1.7, 0.5.into()));
    assert_eq!(layered("Material \"coateddiffuse\""), ([0.5; 3], 1.5, Roughness::LEAST.into()));
    let ([diffuse, grazing], specular, _) = coat("Material \"plastic\" \"rgb Kd\" [.3 .3 .3] \"rgb Ks\" [.5 .5 .5]");
    assert!(near(diffuse, 0.3) && near(grazing, 0.5) && near(specular, 0.02));
    let conductor = |text: &str| match material(text).0 {
        Material::Conductor { eta, k, roughness } => (eta, k, roughness),
        other => panic!("{text}: {other:?}"),
    };
    assert_eq!(conductor("Material \"conductor\"").2, 0.0.into());
    assert!(conductor("Material \"conductor\"").1[0] > 3.9);
    let gold = "\"spectrum conductor.eta\" \"metal-Au-eta\" \"spectrum conductor.k\" \"metal-Au-k\"";
    let smooth = material(&format!("Material \"coatedconductor\" {gold}")).0;
    assert!(smooth.is_mirror());
    assert!(matches!(smooth, Material::CoatedConductor { eta, coat: 1.5, .. } if (eta[2] - 1.4425).abs() < 1e-6));
    let rough = "\"float conductor.roughness\" .04 \"float interface.roughness\" .25";
    let Material::CoatedConductor { roughness, interface, .. } =
        material(&format!("Material \"coatedconductor\" {gold} {rough}")).0
    else {
        panic!()
    };
    assert_eq!((roughness, interface), (0.2.into(), 0.5.into()));
    let (eta, k, roughness) =
        conductor("Material \"dielectric\" \"spectrum eta\" \"glass-BK7\" \"float roughness\" .25");
    assert_eq!((eta, k, roughness), ([1.5168; 3], [0.0; 3], 0.5.into()));
    // a smooth one is a mirror with holes, as many as let through what it does not reflect
    let pane = lit(&format!("Material \"dielectric\" \"float roughness\" 0 {TRIANGLE}"));
    let [(_, mask)] = &pane.masks[..] else { panic!() };
    assert_eq!(pane.materials[pane.triangle_materials[0] as usize], Material::Mirror([1.0; 3]));
    assert!((mask.opacity.mean()[0] - 0.04).abs() < 1e-6 && mask.least.is_none());
    // and a lamp of it shines
    assert_eq!(lit(&format!("Material \"dielectric\" {LIGHT} {TRIANGLE}")).shapes.len(), 1);
    assert!(coat("Material \"metal\" \"rgb reflectance\" [1 1 1]\nMaterial \"substrate\"").2.along > 0.3);
    for (text, expected) in [
        ("Material \"matte\" \"rgb Kd\" [.2 .2 .2]", Material::Diffuse([0.2; 3])),
        ("Material \"hair\" \"float eumelanin\" 3", Material::Diffuse([0.5; 3])),
        ("Material \"diffusetransmission\"", Material::Diffuse([0.25; 3])),
    ] {
        assert_eq!(material(text).0, expected, "{text}");
    }
    // a surface without a material is none
    assert!(lit(&format!("Material \"interface\" {TRIANGLE}")).triangles.is_empty());
    assert!(lit("Shape \"sphere\" \"float alpha\" 0").shapes.is_empty());
    assert_eq!(lit("Shape \"sphere\" \"float alpha\" 0.5").stand_ins.len(), 1);
    // a sphere knows no direction of roughness: it becomes triangles with texture coordinates, unless it emits
    let brushed = "Material \"conductor\" \"float uroughness\" .25 \"float vroughness\" .04\n";
    let sphere = lit(&format!("{brushed}Shape \"sphere\""));
    let roughness = Roughness { along: 0.5, across: 0.2, turn: 0.0 };
    assert!(sphere.shapes.is_empty() && sphere.details.of(0).is_some());
    assert_eq!(sphere.materials[sphere.triangle_materials[0] as usize].roughness(), Some(roughness));
    assert_eq!(lit(&format!("{brushed}AreaLightSource \"diffuse\" Shape \"sphere\"")).shapes.len(), 1);
}

/// Whole disks are disks, whether they emit or not, unless they are stretched, textured or in an object.
#[test]
fn whole_disks_are_kept() {
    let place = "Translate 1 2 3 Rotate 90 1 0 0 Scale 2 2 -2";
    for (reverse, y) in [("", 1.0), ("ReverseOrientation", -1.0)] {
        for light in ["", LIGHT] {
            let scene =
                lit(&format!("{light} {place} {reverse} Shape \"disk\" \"float radius\" 3 \"float height\" .5"));
            let [shape] = &scene.shapes[..] else { panic!("{:?}", scene.shapes) };
            let Geometry::Disk(Disk { center, normal, radius }) = shape.geometry else { panic!("{shape:?}") };
            let near = |a: [f32; 3], b: [f32; 3]| sub(a, b).iter().all(|x| x.abs() < 1e-6);
            assert!(near(center, [1.0, 3.0, 3.0]) && near(normal, [0.0, y, 0.0]) && radius == 6.0, "{shape:?}");
            assert!(scene.stand_ins.is_empty() && shape.emission.is_some() != light.is_empty());
        }
    }
    let checks = "Texture \"t\" \"spectrum\" \"checkerboard\" Material \"diffuse\" \"texture reflectance\" \"t\"";
    for text in [
        "Scale 1 1 2 Shape \"disk\"",
        &format!("{checks} Shape \"disk\""),
        "ObjectBegin \"o\" Shape \"disk\" ObjectEnd ObjectInstance \"o\"",
    ] {
        let scene = lit(text);
        assert!(scene.shapes.is_empty() && scene.triangles.len() >= 64 && scene.stand_ins.len() == 1, "{text}");
    }
    assert!(matches!(lit(&format!("{LIGHT} {checks} Shape \"disk\"")).shapes[0].geometry, Geometry::Disk(_)));
}

#[test]
fn other_shapes_become_triangles() {
    for text in ["disk\" \"float phimax\" 359", "cylinder\"", "sphere\" \"float zmin\" 0"] {
        let scene = lit(&format!("Shape \"{text}"));
        assert!(scene.triangles.len() >= 64 && scene.shapes.is_empty() && scene.stand_ins.len() == 1, "{text}");
    }
    assert_eq!(lit("Shape \"curve\" Shape \"curve\" \"float width\" 1").stand_ins.len(), 1);
    let flat = lit("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 2 0 0] \"integer indices\" [0 1 2 0 1 3]");
    assert!(flat.triangles.len() == 1 && warnings(&flat)[0].contains("1 triangle(s) without area are left out"));
}
