//! The ends of shadow rays: lamps behind sheets that nearly touch them, and lamps in the same place. And coordinates of any size.
//!
//! Truth is a sum over the points of the lamps, in double precision.

use crate::kit::{read, world};
use etendue_oracle::tier::cases;
use etendue_render::film::Pixel;
use etendue_render::{Sampler, Settings, Technique, World};
use std::f64::consts::PI;

const TECHNIQUES: [Technique; 7] = [
    Technique::Area,
    Technique::SolidAngle,
    Technique::ProjectedSolidAngle,
    Technique::Analytic,
    Technique::MisPower,
    Technique::MisBalance,
    Technique::Brdf,
];

/// A floor at height 0, of which the camera sees the origin from below the lamps; all lengths are in this unit.
fn looking_down(unit: f64, half: f64) -> String {
    let [eye, far] = [0.5, half].map(|x| x * unit);
    format!(
        "LookAt 0 0 {eye:e} 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" 0.1 Film \"rgb\" \"integer xresolution\" 8 \
         \"integer yresolution\" 8 PixelFilter \"box\" WorldBegin Material \"diffuse\" \"rgb reflectance\" [.5 .5 .5] \
         {}",
        sheet(far, 0.0)
    )
}

/// A square of this half side at a height, in two triangles.
fn sheet(half: f64, height: f64) -> String {
    let (h, z) = (half, height);
    format!(
        "Shape \"trianglemesh\" \"point3 P\" [-{h:e} -{h:e} {z:e} {h:e} -{h:e} {z:e} {h:e} {h:e} {z:e} -{h:e} {h:e} {z:e}] \
         \"integer indices\" [0 1 2 0 2 3] "
    )
}

/// A lamp over the part [x, X] × [y, Y] of the plane z = height + slope · x, which shines down unless it is turned over.
#[derive(Clone, Copy)]
struct Lamp {
    x: [f64; 2],
    y: [f64; 2],
    height: f64,
    slope: f64,
    radiance: f64,
    shines_up: bool,
    two_sided: bool,
}

impl Lamp {
    fn new(x: [f64; 2], y: [f64; 2], slope: f64, radiance: f64) -> Self {
        Self { x, y, height: 2.0, slope, radiance, shines_up: false, two_sided: false }
    }
    fn text(&self) -> String {
        let Self { x, y, height, slope, radiance, .. } = self;
        let corners = [[0, 0], [0, 1], [1, 0], [1, 1]].map(|[i, j]| {
            let (x, y) = (x[i], y[j]);
            format!("{x:e} {y:e} {:e}", height + slope * x)
        });
        format!(
            "AttributeBegin Material \"diffuse\" \"rgb reflectance\" [0 0 0] {} AreaLightSource \"diffuse\" \"rgb L\" [{radiance} \
             {radiance} {radiance}] \"bool twosided\" {} Shape \"bilinearmesh\" \"point3 P\" [{}] AttributeEnd ",
            if self.shines_up { "ReverseOrientation" } else { "" },
            self.two_sided,
            corners.join(" ")
        )
    }
    fn contains(&self, x: f64, y: f64) -> bool {
        (self.x[0]..=self.x[1]).contains(&x) && (self.y[0]..=self.y[1]).contains(&y)
    }
}

/// What the origin reflects of lamps in one plane, of which the first is in front.
fn reflected(lamps: &[Lamp]) -> f64 {
    const STEPS: usize = 800;
    let step = 2.0 / STEPS as f64;
    let at = |k: usize| -1.0 + (k as f64 + 0.5) * step;
    let mut sum = 0.0;
    for (x, y) in (0..STEPS).flat_map(|i| (0..STEPS).map(move |k| (at(i), at(k)))) {
        let Some(lamp) = lamps.iter().find(|lamp| !lamp.shines_up && lamp.contains(x, y)) else { continue };
        let z = lamp.height + lamp.slope * x;
        sum += lamp.radiance * z * lamp.height / (x * x + y * y + z * z).powi(2);
    }
    0.5 / PI * sum * step * step
}

fn mean(world: &World, technique: Technique, spp: u32) -> f64 {
    let settings =
        Settings { width: 8, height: 8, spp, technique, sampler: Sampler::Sobol, sets: 1, ..Settings::DEFAULT };
    world.render(&settings, &|_| ()).0.mean()[0]
}

/// Each technique finds one answer where lamps are in the same place, in both orders of the file: what is first in the file, of those that
/// shine towards the point.
#[test]
fn lamps_in_the_same_place_have_one_order() {
    let (all, whole) = ([-1.0, 1.0], |slope| Lamp::new([-1.0, 1.0], [-1.0, 1.0], slope, 1.0));
    for slope in [0.37, 0.0].into_iter().take(cases(1, 2)) {
        let bright = |x, y| Lamp { radiance: 2.0, ..Lamp::new(x, y, slope, 1.0) };
        let raised = 2.0 + 2.0 / 8_388_608.0;
        for (name, a, b) in [
            ("twice", whole(slope), bright(all, all)),
            ("reversed", Lamp { shines_up: true, ..whole(slope) }, bright(all, all)),
            ("overlapping", Lamp::new([-1.0, 0.4], all, slope, 1.0), bright([-0.3, 1.0], [-0.9, 0.8])),
            ("contained", whole(slope), bright([-0.37, 0.41], [-0.53, 0.29])),
            ("nearly equal", whole(slope), Lamp { height: raised, ..bright(all, all) }),
            ("two-sided", Lamp { two_sided: true, ..whole(slope) }, bright(all, all)),
        ] {
            for lamps in [[a, b], [b, a]] {
                let text = looking_down(1.0, 1e3) + &lamps.map(|lamp| lamp.text()).concat();
                let (world, expected) = (world(&text), reflected(&lamps));
                print!("{name:12} {slope:4} right {expected:.6}, off by");
                for technique in TECHNIQUES {
                    let off = mean(&world, technique, cases(1024, 16_384)) / expected - 1.0;
                    print!(" {off:8.1e}");
                    // directions that find lamps by chance have more noise
                    let limit = if technique == Technique::Brdf { cases(1e-2, 1e-3) } else { cases(2e-3, 1e-3) };
                    assert!(off.abs() < limit, "{name}, {slope}, {technique:?}: {off:e}");
                }
                println!();
            }
        }
    }
}

/// Of two lamps back to back, each is seen from its side; of others, the first that shines towards the camera.
#[test]
fn lamps_in_the_same_place_are_seen_from_their_sides() {
    let lamp = |radiance, shines_up| Lamp { radiance, shines_up, ..Lamp::new([-1.0, 1.0], [-1.0, 1.0], 0.2, 1.0) };
    for (lamps, from_below, from_above) in [
        ([lamp(1.0, true), lamp(2.0, false)], 2.0, 1.0),
        ([lamp(2.0, false), lamp(1.0, true)], 2.0, 1.0),
        ([lamp(3.0, false), lamp(2.0, false)], 3.0, 0.0),
        ([lamp(2.0, true), lamp(3.0, true)], 0.0, 2.0),
    ] {
        for (eye, expected) in [(0.0, from_below), (5.0, from_above)] {
            // with a black sheet in the same place, in triangles
            for occluder in [
                "",
                "Material \"diffuse\" \"rgb reflectance\" [0 0 0] Shape \"trianglemesh\" \"point3 P\" \
                                 [-1 -1 1.8 1 -1 2.2 1 1 2.2 -1 1 1.8] \"integer indices\" [0 1 2 0 2 3] ",
            ] {
                let head = format!(
                    "LookAt 0 0 {eye} 0 0 2 0 1 0 Camera \"perspective\" \"float fov\" 15 Film \"rgb\" \"integer xresolution\" 8 \
                     \"integer yresolution\" 8 PixelFilter \"box\" WorldBegin {occluder}"
                );
                let world = world(&(head + &lamps.map(|lamp| lamp.text()).concat()));
                let found = mean(&world, Technique::SolidAngle, 16);
                assert!((found - expected).abs() < 1e-6, "from {eye}: {found} instead of {expected}");
            }
        }
    }
}

/// One warning names the lines of the first lamps in the same place; lamps beside each other have none.
#[test]
fn lamps_in_the_same_place_are_told() {
    let lamp = |x, shines_up| Lamp { shines_up, ..Lamp::new(x, [-1.0, 1.0], 0.2, 1.0) };
    let of = |lamps: &[Lamp]| {
        let text: Vec<String> = lamps.iter().map(Lamp::text).collect();
        read(&(looking_down(1.0, 10.0) + "\n" + &text.join("\n"))).warnings
    };
    let (left, right) = (lamp([-1.0, 0.0], false), lamp([0.0, 1.0], false));
    assert_eq!(of(&[left, right]), []);
    let found = of(&[left, right, lamp([0.25, 2.0], false), right]);
    assert_eq!((found.len(), found[0].line), (1, 4), "{found:?}");
    assert!(found[0].text.contains("as that of line 3 (3 such pairs)") && found[0].text.contains("dark"), "{found:?}");
    let found = of(&[left, lamp([-1.0, 0.0], true)]);
    assert!(found.len() == 1 && found[0].text.contains("each is seen from the side"), "{found:?}");
}

/// A sheet is opaque if a lamp is 16 roundings of its coordinates behind it, and a lamp is bright if it is in the plane of the sheet.
#[test]
fn sheets_are_opaque_up_to_rounding() {
    for (distance, half) in [(1.0, 1.0), (1.0, 0.01), (0.01, 1.0), (100.0, 10.0), (100.0, 0.1)] {
        let ulp = f64::from(f32::EPSILON) * f64::max(distance, half);
        for gap in [0.0, 8.0 * ulp, 1e-3 * f64::min(distance, half)] {
            let lamp =
                Lamp { height: distance + gap, two_sided: true, ..Lamp::new([-half, half], [-half, half], 0.0, 1.0) };
            let text =
                looking_down(0.1 * distance, 1e3) + &sheet(9.0 * f64::max(distance, half), distance) + &lamp.text();
            let world = world(&text);
            // directions by chance hardly meet a small lamp
            let all = if half < distance { &TECHNIQUES[..6] } else { &TECHNIQUES[..] };
            print!("sheet at {distance}, lamp of half side {half} behind it by {gap:7.1e}:");
            for &technique in all {
                let found = mean(&world, technique, 64);
                print!(" {found:.4}");
                assert_eq!(found > 0.0, gap == 0.0, "{distance} {half}, gap {gap:e}, {technique:?}: {found:e}");
            }
            println!();
        }
    }
    // a bulb, too
    for (distance, gap) in [(200.0, 1e-3), (200.0, 3e-4), (1.0, 2e-6)] {
        let bulb = format!("LightSource \"point\" \"point3 from\" [0 0 {:e}] \"rgb I\" [1e6 1e6 1e6]", distance + gap);
        let sheet = sheet(1e3, distance);
        for (text, is_lit) in [(looking_down(1.0, 1e3) + &sheet + &bulb, false), (looking_down(1.0, 1e3) + &bulb, true)]
        {
            assert_eq!(mean(&world(&text), Technique::Area, 16) > 0.0, is_lit, "{distance} {gap}");
        }
    }
}

/// A floor as large as numbers go reflects what a small one does.
#[test]
fn floors_have_any_size() {
    for exponent in [3, 7, 10, 12, 14, 17, 20, 25, 30] {
        let lamp = Lamp::new([-1.0, 1.0], [-1.0, 1.0], 0.0, 1.0);
        let world = world(&(looking_down(1.0, 10_f64.powi(exponent)) + &lamp.text()));
        let expected = reflected(&[lamp]);
        print!("floor of half side 1e{exponent:2}, right {expected:.6}:");
        for technique in [Technique::SolidAngle, Technique::Analytic, Technique::MisPower] {
            let found = mean(&world, technique, 256);
            print!(" {found:.6}");
            assert!((found / expected - 1.0).abs() < 5e-4, "1e{exponent}, {technique:?}: {found} {expected}");
        }
        println!();
    }
}

/// A room in a unit of length.
fn room(unit: f64) -> World {
    let scaled = |numbers: &[f64]| numbers.iter().map(|x| format!("{:e}", x * unit)).collect::<Vec<_>>().join(" ");
    let mesh = |points: &[f64], indices: &str| {
        format!("Shape \"trianglemesh\" \"point3 P\" [{}] \"integer indices\" [{indices}] ", scaled(points))
    };
    let floor = mesh(&[-2.0, -1.0, -2.0, 2.0, -1.0, -2.0, 2.0, -1.0, 2.0, -2.0, -1.0, 2.0], "0 2 1 0 3 2");
    let wall = mesh(&[-2.0, -1.0, 2.0, 2.0, -1.0, 2.0, 2.0, 1.5, 2.0, -2.0, 1.5, 2.0], "0 1 2 0 2 3");
    let block = mesh(
        &[
            -0.5, -1.0, -0.5, 0.5, -1.0, -0.5, 0.5, -0.2, -0.5, -0.5, -0.2, -0.5, -0.5, -1.0, 0.5, 0.5, -1.0, 0.5, 0.5,
            -0.2, 0.5, -0.5, -0.2, 0.5,
        ],
        "0 1 2 0 2 3 5 4 7 5 7 6 4 0 3 4 3 7 1 5 6 1 6 2 3 2 6 3 6 7",
    );
    let sphere = |at: &[f64], radius: f64| {
        format!("Translate {} Shape \"sphere\" \"float radius\" {:e} ", scaled(at), radius * unit)
    };
    let lamp = "Material \"diffuse\" \"rgb reflectance\" [0 0 0] AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] ";
    let panel = scaled(&[-0.4, 1.4, -0.4, 0.4, 1.4, -0.4, -0.4, 1.4, 0.4, 0.4, 1.4, 0.4]);
    world(&format!(
        "LookAt {} {} 0 1 0 Camera \"perspective\" \"float fov\" 50 Film \"rgb\" \"integer xresolution\" 16 \"integer \
         yresolution\" 16 PixelFilter \"box\" WorldBegin Material \"diffuse\" \"rgb reflectance\" [.5 .5 .5] {floor} {wall} \
         {block} AttributeBegin {} AttributeEnd AttributeBegin {lamp} {} AttributeEnd AttributeBegin {lamp} Shape \
         \"bilinearmesh\" \"point3 P\" [{panel}] AttributeEnd",
        scaled(&[0.3, 0.5, -2.6]),
        scaled(&[0.0, 0.2, 0.0]),
        sphere(&[0.9, -0.6, 0.2], 0.4),
        sphere(&[-1.2, 0.6, 0.5], 0.1),
    ))
}

/// The image is the same in units of 1e-20 to 1e30, pixel by pixel, but for what the rounding of coordinates moves.
#[test]
fn images_are_the_same_in_all_units() {
    let settings = |technique| Settings {
        width: 16,
        height: 16,
        spp: 64,
        technique,
        sampler: Sampler::Sobol,
        sets: 1,
        ..Settings::DEFAULT
    };
    for technique in [Technique::SolidAngle, Technique::Analytic, Technique::MisPower] {
        let expected = room(1.0).render(&settings(technique), &|_| ()).0;
        for exponent in (-20..=30).step_by(cases(5, 1)) {
            let found = room(10_f64.powi(exponent)).render(&settings(technique), &|_| ()).0;
            let differs = |(a, b): (&Pixel, &Pixel)| (a.mean[0] - b.mean[0]).abs() > 0.05 * b.mean[0].max(0.05);
            // a sample of 64 more or less in a shadow
            let differing = found.pixels.iter().zip(&expected.pixels).filter(|&pair| differs(pair)).count();
            assert!(differing < 4, "1e{exponent}, {technique:?}: {differing} pixels differ");
            let [a, b] = [&found, &expected].map(|film| film.mean()[0]);
            assert!((a / b - 1.0).abs() < 1e-3, "1e{exponent}, {technique:?}: {a} {b}");
        }
    }
}
