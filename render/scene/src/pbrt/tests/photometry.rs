//! What powers, illuminances and scales mean, and on which side lights emit.

use super::meshes::Scratch;
use super::*;
use etendue_render::packet::V8;
use etendue_render::sky::Sky;
use exr::prelude::write_rgb_file;
use std::f64::consts::PI;

/// A folder with a picture of 5 × 4 texels, of which the upper left one is the brightest, a profile, and skies of few texels.
fn folder(name: &str) -> Scratch {
    let folder = Scratch::new(name);
    let texel = |x: usize, y: usize| (1.0 / (1 + x + y) as f32, 0.5, (x % 2) as f32);
    write_rgb_file(folder.path.join("p.exr"), 5, 4, texel).unwrap();
    for (width, height) in [(1, 1), (2, 2), (3, 3), (4, 4), (7, 7), (2, 1), (1, 2), (1, 3), (4, 3), (6, 2)] {
        write_rgb_file(folder.path.join(format!("{width}x{height}.exr")), width, height, texel).unwrap();
    }
    folder.write("a.ies", b"IESNA:LM-63-2019\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 9\n0 90\n0\n8 2\n");
    folder
}

fn load_in(folder: &Scratch, text: &str) -> Scene {
    parse(&world(text), "a.pbrt", &folder.path).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn luminance([r, g, b]: [f32; 3]) -> f64 {
    0.212_639 * f64::from(r) + 0.715_168_7 * f64::from(g) + 0.072_192_3 * f64::from(b)
}

/// The power of the shapes of a scene that emit: πAL for each side of each.
fn power(scene: &Scene) -> f64 {
    let of = |shape: &Shape| {
        let emission = shape.emission.unwrap();
        PI * shape.geometry.area() * luminance(emission.radiance) * if emission.two_sided { 2.0 } else { 1.0 }
    };
    scene.shapes.iter().map(of).sum()
}

const SHAPES: [&str; 12] = [
    "\"sphere\" \"float radius\" 2",
    "\"sphere\" \"float zmin\" 0",
    "\"sphere\" \"float phimax\" 200",
    "\"disk\" \"float radius\" 3",
    "\"disk\" \"float innerradius\" .5 \"float phimax\" 90",
    "\"cylinder\" \"float zmax\" 4",
    "\"bilinearmesh\" \"point3 P\" [0 0 0  1 0 0  0 1 0  1 1 .5]",
    "\"bilinearmesh\" \"point3 P\" [0 0 0  1 0 0  0 2 0  1 2 0]",
    "\"bilinearmesh\" \"point3 P\" [0 0 0  1 0 0  0 2 0  1 2 0  4 0 0  4 2 0] \"integer indices\" [0 1 2 3 1 4 3 5]",
    "\"trianglemesh\" \"point3 P\" [0 0 0  4 0 0  4 1 0  0 3 0] \"integer indices\" [0 1 2 0 2 3] \"point2 uv\" [0 0 1 0 1 .5 0 1]",
    "\"loopsubdiv\" \"point3 P\" [0 0 0  1 0 0  0 1 0  1 1 1] \"integer indices\" [0 1 2 1 3 2]",
    "\"trianglemesh\" \"point3 P\" [0 0 0  1 0 0  0 1 0]",
];

/// A shape has its power in all, however many parts it has, and all parts have the same radiance where the picture has.
#[test]
fn power_is_that_of_the_whole_shape() {
    let folder = folder("power");
    for transform in ["", "Scale 1 -2 3", "Rotate 30 1 2 3 Scale 2 2 2"] {
        for shape in SHAPES {
            for more in
                ["", "\"bool twosided\" true", "\"rgb L\" [.5 2 4]", "\"float scale\" .25", "\"float spread\" 60"]
            {
                let directive =
                    |light: &str| format!("{transform} AreaLightSource \"diffuse\" {light} {more} Shape {shape}");
                let wanted = if more.contains("scale") { 2.5 } else { 10.0 };
                let plain = load_in(&folder, &directive("\"float power\" 10"));
                let first = plain.shapes[0].emission.unwrap().radiance;
                assert!(plain.shapes.iter().all(|part| part.emission.unwrap().radiance == first), "{shape}");
                assert!((power(&plain) / wanted - 1.0).abs() < 1e-6, "{transform} {shape} {more}: {}", power(&plain));
                if more.contains("L\"") {
                    continue;
                }
                let shown = load_in(&folder, &directive("\"float power\" 10 \"string filename\" \"p.exr\""));
                let first = shown.pictures[0].factor;
                assert!(shown.pictures.iter().all(|picture| picture.factor == first), "{shape}");
                assert!((power(&shown) / wanted - 1.0).abs() < 1e-6, "{transform} {shape} {more}: {}", power(&shown));
            }
        }
    }
    // each shape of a light has it, as each light of a scene
    let two =
        load_in(&folder, &format!("AreaLightSource \"diffuse\" \"float power\" 10 Shape {0} Shape {0}", SHAPES[3]));
    assert!((power(&two) - 20.0).abs() < 1e-5);
    let faint = load_in(&folder, &format!("AreaLightSource \"diffuse\" \"float power\" 1e-50 Shape {}", SHAPES[3]));
    assert_eq!(faint.shapes[0].emission.unwrap().radiance, [f32::MIN_POSITIVE; 3]);
    let bright = world(&format!("AreaLightSource \"diffuse\" \"float power\" 1e40\nShape {}", SHAPES[3]));
    let error = parse(&bright, "a.pbrt", &folder.path).unwrap_err().to_string();
    assert!(error.starts_with("a.pbrt:3: Shape \"disk\": its power makes the radiance ["), "{error}");
}

/// pbrt-v4 multiplies by the scale after what a light shall have.
#[test]
fn scales_multiply_powers_and_illuminances() {
    let folder = folder("scales");
    // the radiance, intensity or irradiance of the only light, in the green channel
    let strength = |text: &str| {
        let scene = load_in(&folder, text);
        f64::from(match (&scene.delta_lights[..], &scene.environment) {
            ([DeltaLight::Point { intensity, .. }], _) => intensity[1],
            ([DeltaLight::Spot { intensity, .. } | DeltaLight::Directed { intensity, .. }], _) => intensity[1],
            ([DeltaLight::Distant { irradiance, .. }], _) => irradiance[1],
            (_, Some(Environment { sky: SkyRadiance::Constant(rgb), .. })) => rgb[1],
            (_, Some(Environment { sky: SkyRadiance::Image { texels, .. }, .. })) => {
                texels.iter().fold(0.0, |most: f32, texel| most.max(texel[1]))
            }
            _ => scene.shapes[0].emission.unwrap().radiance[1],
        })
    };
    let area = |more: &str| format!("AreaLightSource \"diffuse\" {more} \"float power\" 3 SCALE Shape \"disk\"");
    for light in [
        "LightSource \"point\" \"float power\" 3 SCALE",
        "LightSource \"spot\" \"float power\" 3 SCALE",
        "LightSource \"spot\" \"string profile\" \"a.ies\" \"float power\" 3 SCALE",
        "LightSource \"spot\" \"string profile\" \"2x2.exr\" \"float power\" 3 SCALE",
        "LightSource \"distant\" \"float illuminance\" 3 SCALE",
        "LightSource \"goniometric\" \"string filename\" \"a.ies\" \"float power\" 3 SCALE",
        "LightSource \"goniometric\" \"string filename\" \"4x4.exr\" \"float power\" 3 SCALE",
        "LightSource \"projection\" \"string filename\" \"p.exr\" \"float power\" 3 SCALE",
        "LightSource \"infinite\" \"float illuminance\" 3 SCALE",
        "LightSource \"infinite\" \"string filename\" \"4x4.exr\" \"float illuminance\" 3 SCALE",
        "LightSource \"infinite\" \"string sky\" \"cie\" \"integer type\" 1 \"float illuminance\" 3 SCALE",
        &area(""),
        &area("\"string filename\" \"p.exr\""),
        &area("\"string profile\" \"a.ies\""),
        &area("\"float spread\" 40"),
    ] {
        let of = |scale: &str| strength(&light.replace("SCALE", scale));
        let (plain, colour) =
            (of(""), if light.contains("filename") { "" } else { "\"rgb I\" [2 2 2] \"rgb L\" [2 2 2]" });
        assert!((of("\"float scale\" .25") / plain - 0.25).abs() < 1e-6, "{light}: {plain}");
        assert!((of(&format!("\"float scale\" 3 {colour}")) / plain - 3.0).abs() < 1e-6, "{light}: {plain}");
        assert!((of("\"rgb scale\" [1 .5 2]") / plain - 0.5).abs() < 0.3, "{light}: {plain}");
    }
}

/// The irradiance of a surface that faces the light's +z, summed over directions of the hemisphere.
#[test]
fn illuminances_are_those_of_skies_of_any_size() {
    let folder = folder("skies");
    for size in ["1x1", "2x2", "3x3", "4x4", "7x7", "2x1", "1x2", "1x3", "4x3", "6x2"] {
        for transform in ["", "Rotate -90 1 0 0", "Rotate 40 1 2 3 Scale -3 3 3"] {
            let light = format!("LightSource \"infinite\" \"string filename\" \"{size}.exr\" \"float illuminance\" 10");
            let environment = load_in(&folder, &format!("{transform} {light}")).environment.unwrap();
            let sky = Sky::new(&environment);
            let (n, mut sum) = (480, 0.0);
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                // by the cosine
                let (square, turn) = ((f64::from(i) + 0.5) / f64::from(n), (f64::from(j) + 0.5) / f64::from(n));
                let (sin, cos) = (2.0 * PI * turn).sin_cos();
                let own = [square.sqrt() * cos, square.sqrt() * sin, (1.0 - square).sqrt()];
                let row = |k: usize| (0..3).map(|i| own[i] * f64::from(environment.to_light[i][k])).sum::<f64>() as f32;
                let radiance = sky.radiance(V8::default(), [row(0), row(1), row(2)].into());
                sum += luminance([radiance.x, radiance.y, radiance.z].map(|x| x.to_array()[0]));
            }
            let illuminance = PI * sum / f64::from(n * n);
            assert!((illuminance / 10.0 - 1.0).abs() < 2e-3, "{size} {transform}: {illuminance}");
        }
    }
    // one texel is π times its radiance
    let one = load_in(&folder, "LightSource \"infinite\" \"string filename\" \"1x1.exr\" \"float illuminance\" 10");
    let SkyRadiance::Image { texels, .. } = one.environment.unwrap().sky else { panic!() };
    assert!((PI * luminance(texels[0]) - 10.0).abs() < 1e-5, "{texels:?}");
    write_rgb_file(folder.path.join("below.exr"), 1, 2, |_, y| (y as f32, y as f32, y as f32)).unwrap();
    let below = load_in(&folder, "LightSource \"infinite\" \"string filename\" \"below.exr\" \"float illuminance\" 10");
    assert!(warnings(&below)[0].contains("the upper half of the sky is dark"), "{:?}", below.warnings);
}

/// The normal of the untransformed shape, moved as normals are, tells the side that emits, and `ReverseOrientation` turns it around. Without
/// normals, that of a mesh is by the order of its vertices.
#[test]
fn lights_emit_on_the_side_of_their_normal() {
    let ball = "\"point3 P\" [1 0 0  -1 0 0  0 1 0  0 -1 0  0 0 1  0 0 -1]";
    let faces = "[0 2 4  2 1 4  1 3 4  3 0 4  2 0 5  1 2 5  3 1 5  0 3 5]";
    let mesh = format!("\"trianglemesh\" {ball} \"integer indices\" {faces}");
    for (shape, side) in [
        ("\"sphere\"", 1.0),
        ("\"sphere\" \"float zmin\" -.9", 1.0),
        ("\"cylinder\"", 1.0),
        ("\"disk\" \"float height\" 1", 1.0),
        ("\"bilinearmesh\" \"point3 P\" [-1 -1 1  1 -1 1  -1 1 1  1 1 1]", 1.0),
        ("\"bilinearmesh\" \"point3 P\" [-1 -1 1  1 -1 1  -1 1 1  1 1 2]", 1.0),
        (&mesh, 1.0),
        (&format!("{mesh} \"normal N\" [1 0 0  -1 0 0  0 1 0  0 -1 0  0 0 1  0 0 -1]"), 1.0),
        (&format!("{mesh} \"normal N\" [-1 0 0  1 0 0  0 -1 0  0 1 0  0 0 -1  0 0 1]"), -1.0),
        (&format!("\"loopsubdiv\" {ball} \"integer indices\" {faces} \"integer levels\" 1"), 1.0),
    ] {
        for transform in
            ["", "Scale -1 1 1", "Scale 3 3 -3", "Rotate 50 3 1 2 Scale 1 -1 1 Translate 0 0 .1", "Scale 1 -2 3"]
        {
            for reverse in [false, true] {
                let directive =
                    format!("{transform} {} {LIGHT} Shape {shape}", if reverse { "ReverseOrientation" } else { "" });
                let scene = read(&world(&directive));
                // away from the origin, which is inside of or below each shape
                let out = |geometry: &Geometry| match *geometry {
                    Geometry::Sphere { .. } => 1.0,
                    Geometry::Triangle(corners) => along(geometry, corners[0]),
                    Geometry::Parallelogram { p, .. } => along(geometry, p),
                };
                // the order of vertices is mirrored, too, and pbrt turns it back
                let wanted = if reverse { -side } else { side };
                for part in scene.shapes.iter().filter(|part| part.emission.is_some()) {
                    assert_eq!(out(&part.geometry), wanted, "{directive}: {:?}", part.geometry);
                }
            }
        }
    }
}

/// Whether the normal of a flat shape leads away from the origin or towards it.
fn along(geometry: &Geometry, corner: [f32; 3]) -> f32 {
    let n = normal(geometry);
    (n[0] * corner[0] + n[1] * corner[1] + n[2] * corner[2]).signum()
}

#[test]
fn skies_have_the_illuminance_that_is_asked_for() {
    let dir = Scratch::new("illuminance");
    // longitude and latitude: 1 above the horizon, 3 below it
    write_rgb_file(dir.path.join("s.exr"), 64, 16, |_, y| if y < 8 { (1.0, 1.0, 1.0) } else { (3.0, 3.0, 3.0_f32) })
        .unwrap();
    let sky = |text: &str| parse(&world(text), "a.pbrt", &dir.path).unwrap().environment.unwrap().sky;
    let light = "LightSource \"infinite\" \"string filename\" \"s.exr\"";
    let SkyRadiance::Image { texels, .. } = sky(&format!("{light} \"float illuminance\" 6")) else { panic!() };
    // the illuminance of a hemisphere of radiance L is πL
    let above = 6.0 / std::f32::consts::PI;
    assert!(
        (texels[0][1] / above - 1.0).abs() < 5e-3 && (texels[1000][1] / texels[0][1] - 3.0).abs() < 1e-5,
        "{:?}",
        texels[0]
    );
    for both in [
        format!("{light} LightSource \"infinite\" \"rgb L\" [1 2 4]"),
        format!("LightSource \"infinite\" \"rgb L\" [1 2 4] {light}"),
    ] {
        let SkyRadiance::Image { texels, .. } = sky(&both) else { panic!() };
        assert_eq!([texels[0], texels[1000]], [[2.0, 3.0, 5.0], [4.0, 5.0, 7.0]]);
    }
}
