//! The sky through portals: what they show is what windows show, whichever way it is sampled, with less noise.

use etendue_oracle::tier::cases;
use etendue_render::compare::LIMIT;
use etendue_render::film::Film;
use etendue_render::scene::{Environment, Scene};
use etendue_render::{Sampler, Settings, Technique, World};
use etendue_scene::parse;
use std::path::Path;
use std::time::Instant;

fn by_solid_angle(width: u32, height: u32) -> Settings {
    let (technique, sampler) = (Technique::SolidAngle, Sampler::Independent);
    Settings { width, height, spp: 16, technique, sampler, seed: 3, ..Settings::DEFAULT }
}

/// A wall of the room 4 × 4 × 3 about (0, 0, 1.5), in the plane x = 2, with windows between these y and z.
fn wall(windows: &[[f64; 4]]) -> String {
    let mut all = String::new();
    let mut add = |[y0, y1, z0, z1]: [f64; 4]| {
        if y1 > y0 && z1 > z0 {
            all += &format!(
                "Shape \"trianglemesh\" \"point3 P\" [2 {y0} {z0}  2 {y1} {z0}  2 {y1} {z1}  2 {y0} {z1}] \
                 \"integer indices\" [0 2 1  0 3 2]\n"
            );
        }
    };
    let mut y = -2.0;
    for &[y0, y1, z0, z1] in windows {
        add([y, y0, 0.0, 3.0]);
        add([y0, y1, 0.0, z0]);
        add([y0, y1, z1, 3.0]);
        y = y1;
    }
    add([y, 2.0, 0.0, 3.0]);
    all
}

const WINDOWS: [[f64; 4]; 3] = [[-1.6, -0.9, 0.8, 2.2], [-0.4, 0.4, 0.9, 2.0], [0.9, 1.5, 0.3, 2.4]];

/// The room, with a camera that looks at the corner of the floor and the far wall.
fn room(portals: bool, sky: &str) -> Scene {
    let quad = |p: &str| format!("Shape \"trianglemesh\" \"point3 P\" [{p}] \"integer indices\" [0 1 2  0 2 3]\n");
    let faces = [
        "-2 -2 0  2 -2 0  2 2 0  -2 2 0",
        "-2 -2 3  -2 2 3  2 2 3  2 -2 3",
        "-2 -2 0  -2 2 0  -2 2 3  -2 -2 3",
        "-2 -2 0  -2 -2 3  2 -2 3  2 -2 0",
        "-2 2 0  2 2 0  2 2 3  -2 2 3",
    ];
    let faces: String = faces.iter().map(|p| quad(p)).collect();
    // (p3 − p0) × (p1 − p0) is +x
    let corners =
        WINDOWS.map(|[y0, y1, z0, z1]| format!("2 {y0} {z0}  2 {y0} {z1}  2 {y1} {z1}  2 {y1} {z0}")).join("  ");
    let portal = if portals { format!("\"point3 portal\" [{corners}]") } else { String::new() };
    let sky = format!("AttributeBegin Rotate 200 0 0 1 LightSource \"infinite\" {sky} {portal} AttributeEnd\n");
    let text = format!(
        "LookAt 1.5 -1.6 1.6  -1 0.5 0.9  0 0 1\nCamera \"perspective\" \"float fov\" 75\nWorldBegin\n{sky}\
         Material \"diffuse\" \"rgb reflectance\" [.7 .6 .5]\n{faces}{}",
        wall(&WINDOWS)
    );
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    parse(&text, "room.pbrt", &scenes).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// The image of the built-in scene, turned so that its sun shines in; daylight with a sun of its own, which does so too.
const SKIES: [&str; 2] = [
    "\"string filename\" \"sky.exr\"",
    "\"string sky\" \"cie\" \"float elevation\" 25 \"float azimuth\" 285 \"float illuminance\" 2 \"float sun\" 4",
];

fn render(world: &World, technique: Technique, spp: u32) -> Film {
    let settings =
        Settings { width: 24, height: 18, spp, technique, sampler: Sampler::Independent, seed: 3, ..Settings::DEFAULT };
    world.render(&settings, &|_| ()).0
}

/// Sum of all pixels, and its variance.
fn sum(film: &Film) -> (f64, f64) {
    let pixels = film.pixels.iter();
    pixels.fold((0.0, 0.0), |(mean, variance), pixel| {
        (mean + f64::from(pixel.mean[1]), variance + f64::from(pixel.variance[1]))
    })
}

/// A room with three windows has the same image with portals in them as without, by every technique, and with much less noise.
#[test]
fn portals_change_noise_alone() {
    for (sky, gain) in SKIES.iter().zip([100.0, 8.0]) {
        let (plain, with) = (World::new(&room(false, sky)).unwrap(), World::new(&room(true, sky)).unwrap());
        let spp = cases(256, 4096) as u32;
        let (mean, variance) = sum(&render(&plain, Technique::MisPower, 4 * spp));
        assert!(mean > 0.0);
        for technique in
            [Technique::SolidAngle, Technique::MisPower, Technique::CosineHemisphere, Technique::MisBalance]
        {
            let (own, spread) = sum(&render(&with, technique, spp));
            let z = (own - mean) / (variance + spread).sqrt();
            println!("{sky}, {technique:?}: {own:.4} of {mean:.4}, z = {z:.2}");
            // chance finds a sun so rarely that its error is unknown
            if technique != Technique::CosineHemisphere || !sky.contains("sun") {
                assert!(z.abs() < LIMIT, "{technique:?}: {own}, expected {mean}, z = {z}");
            }
            if technique == Technique::SolidAngle {
                let timed = |world: &World| {
                    let start = Instant::now();
                    (sum(&render(world, technique, spp)).1, start.elapsed().as_secs_f64())
                };
                let ((without, before), (_, after)) = (timed(&plain), timed(&with));
                let ratio = without / spread;
                println!(
                    "variance without portals over that with them: {ratio:.1}; at equal time: {:.1}",
                    ratio * before / after
                );
                assert!(spread * gain < without, "variance {spread} with portals, {without} without");
            }
        }
    }
}

/// A white plane under the open sky reflects the illuminance of sky and sun over π, by each technique that samples lights.
#[test]
fn daylight_has_the_illuminance_that_is_asked_for() {
    let text = "LookAt 0 0 5  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 1\nWorldBegin\n\
        LightSource \"infinite\" \"string sky\" \"cie\" \"integer type\" 12 \"float elevation\" 30 \"float illuminance\" 10 \
        \"float sun\" 8\nMaterial \"diffuse\" \"rgb reflectance\" [1 1 1]\n\
        Shape \"trianglemesh\" \"point3 P\" [-1 -1 0  1 -1 0  1 1 0  -1 1 0] \"integer indices\" [0 1 2  0 2 3]";
    let world = World::new(&parse(text, "a.pbrt", Path::new("")).unwrap()).unwrap();
    let truth = (10.0 + 8.0 * 0.5) / std::f64::consts::PI;
    for technique in [Technique::SolidAngle, Technique::ProjectedSolidAngle, Technique::MisPower] {
        let film = render(&world, technique, cases(1024, 1 << 15) as u32);
        let (own, spread) = sum(&film);
        let (own, error) = (own / film.pixels.len() as f64, spread.sqrt() / film.pixels.len() as f64);
        println!("{technique:?}: {own:.5} ± {error:.5}, expected {truth:.5}");
        // the image of the sky has it to 2e−4
        assert!(
            (own - truth).abs() < LIMIT * error + 2e-4 * truth && error < 0.01 * truth,
            "{technique:?}: {own} ± {error}"
        );
    }
}

/// A point light adds up with the sky through portals.
#[test]
fn portals_among_other_lights() {
    let lamp = |mut scene: Scene| {
        let (position, intensity) = ([0.0, 1.0, 2.0], [0.05; 3]);
        scene.delta_lights.push(etendue_render::scene::DeltaLight::Point { position, intensity });
        World::new(&scene).unwrap()
    };
    let (plain, with) = (lamp(room(false, SKIES[0])), lamp(room(true, SKIES[0])));
    let spp = cases(256, 4096) as u32;
    let (mean, variance) = sum(&render(&plain, Technique::MisPower, 4 * spp));
    for technique in [Technique::SolidAngle, Technique::MisPower] {
        let (own, spread) = sum(&render(&with, technique, spp));
        let z = (own - mean) / (variance + spread).sqrt();
        assert!(z.abs() < LIMIT, "{technique:?}: {own}, expected {mean}, z = {z}");
    }
}

/// A portal below the horizon of a surface takes no sample: with it, the image has the same bytes.
#[test]
fn portals_below_the_horizon_take_no_sample() {
    let floor = |below: &str| {
        let text = format!(
            "LookAt 0 0 3  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 30\nWorldBegin\n\
             LightSource \"infinite\" \"rgb L\" [3 2 1] \"point3 portal\" [2 -1 1  2 -1 2  2 1 2  2 1 1 {below}]\n\
             Material \"diffuse\" \"rgb reflectance\" [1 1 1]\n\
             Shape \"trianglemesh\" \"point3 P\" [-1 -1 0  1 -1 0  1 1 0  -1 1 0] \"integer indices\" [0 1 2  0 2 3]"
        );
        let world = World::new(&parse(&text, "a.pbrt", Path::new("")).unwrap()).unwrap();
        [Technique::SolidAngle, Technique::MisPower].map(|technique| render(&world, technique, 16).pixels)
    };
    let without = floor("");
    assert!(without.iter().flatten().all(|pixel| pixel.mean[1] > 0.0 && pixel.variance[1] > 0.0));
    assert_eq!(floor("-1 -1 -1  1 -1 -1  1 1 -1  -1 1 -1"), without);
}

/// No ray is sent in a direction from which no light can come: through a portal to the dark half of the sky, or from a black surface.
#[test]
fn no_ray_to_what_is_dark() {
    let shadow_rays = |up: f64, reflectance: f64| {
        let text = format!(
            "LookAt 0 0 0  0 0 {up}  0 1 0\nCamera \"perspective\" \"float fov\" 30\nWorldBegin\n\
             LightSource \"infinite\" \"string sky\" \"cie\" \"float elevation\" 40 \"point3 portal\" [2 -1 1  2 -1 2  2 1 2  2 1 1]\n\
             Material \"diffuse\" \"float reflectance\" {reflectance}\n\
             Shape \"trianglemesh\" \"point3 P\" [-2 -2 {up}  2 -2 {up}  2 2 {up}  -2 2 {up}] \"integer indices\" [0 1 2  0 2 3]"
        );
        let world = World::new(&parse(&text, "a.pbrt", Path::new("")).unwrap()).unwrap();
        let settings = by_solid_angle(24, 18);
        let (film, rays) = world.render(&settings, &|_| ());
        assert_eq!(rays.camera, 24 * 18 * 16);
        (rays.shadow, sum(&film).0)
    };
    let (floor, light) = shadow_rays(-1.0, 0.5);
    assert!(floor == 24 * 18 * 16 && light > 0.0, "{floor} rays, {light}");
    // a ceiling sees but the ground through the portal
    assert_eq!(shadow_rays(3.0, 0.5), (0, 0.0));
    assert_eq!(shadow_rays(-1.0, 0.0), (0, 0.0));
}

/// As in pbrt, a ray that escapes beside the portals meets black, and from behind they show nothing.
#[test]
fn beside_portals_it_is_black() {
    let view = |from: &str, to: &str| {
        let text = format!(
            "LookAt {from}  {to}  0 0 1\nCamera \"perspective\" \"float fov\" 1e-3\nWorldBegin\n\
             LightSource \"infinite\" \"rgb L\" [3 2 1] \"point3 portal\" [2 -1 1  2 -1 2  2 1 2  2 1 1]"
        );
        let scene = parse(&text, "a.pbrt", Path::new("")).unwrap();
        assert!(scene.environment.as_ref().is_some_and(|environment: &Environment| environment.portals.len() == 1));
        let world = World::new(&scene).unwrap();
        let settings = by_solid_angle(1, 1);
        world.render(&settings, &|_| ()).0.pixels[0].mean
    };
    assert_eq!(view("0 0 0", "2 0.5 1.5"), [3.0, 2.0, 1.0]);
    assert_eq!(view("0 0 0", "2 0.5 2.5"), [0.0; 3]);
    assert_eq!(view("4 0 0", "2 0.5 1.5"), [0.0; 3]);
    assert_eq!(view("0 0 0", "-2 -0.5 -1.5"), [0.0; 3]);
}
