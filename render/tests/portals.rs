//! The sky through portals: what they show is what windows show, whichever way it is sampled, with less noise.

use crate::kit::{film, settings, sum, world};
use etendue_oracle::tier::cases;
use etendue_render::film::Film;
use etendue_render::film::compare::LIMIT;
use etendue_render::scene::{DeltaLight, Scene};
use etendue_render::{Settings, Technique, World};
use etendue_scene::parse;
use std::path::Path;

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
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    parse(&text, "room.pbrt", &scenes).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// The image of the built-in scene, turned so that its sun shines in; daylight with a sun of its own, which does so too.
const SKIES: [&str; 2] = [
    "\"string filename\" \"sky.exr\"",
    "\"string sky\" \"cie\" \"float elevation\" 25 \"float azimuth\" 285 \"float illuminance\" 2 \"float sun\" 4",
];

fn render(world: &World, technique: Technique, spp: u32) -> Film {
    film(world, &Settings { width: 24, height: 18, ..settings(technique, 0, spp) })
}

/// A room with three windows has the same image with portals in them as without, by every technique, also beside a lamp, and with much less noise.
#[test]
fn portals_change_noise_alone() {
    use Technique::{CosineHemisphere, MisBalance, MisPower, SolidAngle};
    for (sky, has_lamp, gain) in [(SKIES[0], false, 100.0), (SKIES[1], false, 8.0), (SKIES[0], true, 1.0)] {
        let [plain, with] = [false, true].map(|portals| {
            let mut scene = room(portals, sky);
            if has_lamp {
                scene.delta_lights.push(DeltaLight::Point { position: [0.0, 1.0, 2.0], intensity: [0.05; 3] });
            }
            World::new(&scene).unwrap()
        });
        let spp = cases(128, 4096);
        let [mean, variance] = sum(&render(&plain, MisPower, 4 * spp));
        assert!(mean > 0.0);
        for technique in [SolidAngle, MisPower, CosineHemisphere, MisBalance] {
            let [own, spread] = sum(&render(&with, technique, spp));
            let z = (own - mean) / (variance + spread).sqrt();
            println!("{sky}, {technique:?}: {own:.4} of {mean:.4}, z = {z:.2}");
            // chance finds a sun so rarely that its error is unknown
            if technique != CosineHemisphere || !sky.contains("sun") {
                assert!(z.abs() < LIMIT, "{technique:?}: {own}, expected {mean}, z = {z}");
            }
        }
        let [without, spread] = [&plain, &with].map(|world| sum(&render(world, SolidAngle, spp))[1]);
        println!("variance without portals over that with them: {:.1}", without / spread);
        assert!(spread * gain < without, "variance {spread} with portals, {without} without");
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
        [Technique::SolidAngle, Technique::MisPower].map(|technique| render(&world(&text), technique, 16).pixels)
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
        let settings = Settings { width: 24, height: 18, ..settings(Technique::SolidAngle, 0, 16) };
        let (film, rays) = world(&text).render(&settings, &|_| ());
        assert_eq!(rays.camera, 24 * 18 * 16);
        (rays.shadow, sum(&film)[0])
    };
    let (floor, light) = shadow_rays(-1.0, 0.5);
    assert!(floor == 24 * 18 * 16 && light > 0.0, "{floor} rays, {light}");
    // a ceiling sees but the ground through the portal
    assert_eq!(shadow_rays(3.0, 0.5), (0, 0.0));
    assert_eq!(shadow_rays(-1.0, 0.0), (0, 0.0));
}
