//! Light that rough surfaces reflect, by the fit of their lobes and samples of the rest, against sums over the lights in double precision.

use etendue_oracle::tier::cases;
use etendue_oracle::{V3, along, basis, cross, dot, length, sub, unit};
use etendue_render::compare::differs;
use etendue_render::{Sampler, Settings, Technique, World};
use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use std::path::Path;

fn settings(technique: Technique, spp: u32) -> Settings {
    Settings {
        width: 1,
        height: 1,
        spp,
        technique,
        depth: 2,
        sampler: Sampler::Independent,
        seed: 1,
        ..Settings::DEFAULT
    }
}

/// A light of radiance 1.
enum Light {
    Panel { corner: V3, edges: [V3; 2] },
    Triangle { corner: V3, edges: [V3; 2] },
    Ball { center: V3, radius: f64 },
}

impl Light {
    fn text(&self, emits: bool) -> String {
        let mut text = String::from("AttributeBegin Material \"diffuse\" \"rgb reflectance\" [0 0 0]\n");
        if emits {
            text.push_str("AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"bool twosided\" true\n");
        }
        let list = |points: &[V3]| points.iter().flatten().map(f64::to_string).collect::<Vec<_>>().join(" ");
        let shape = match *self {
            Self::Panel { corner, edges: [u, v] } => {
                let corners =
                    [corner, along(corner, u, 1.0), along(corner, v, 1.0), along(along(corner, u, 1.0), v, 1.0)];
                format!("Shape \"bilinearmesh\" \"point3 P\" [{}]", list(&corners))
            }
            Self::Triangle { corner, edges: [u, v] } => {
                format!(
                    "Shape \"trianglemesh\" \"point3 P\" [{}]",
                    list(&[corner, along(corner, u, 1.0), along(corner, v, 1.0)])
                )
            }
            Self::Ball { center, radius } => {
                let [x, y, z] = center;
                format!("Translate {x} {y} {z} Shape \"sphere\" \"float radius\" {radius}")
            }
        };
        writeln!(text, "{shape} AttributeEnd").unwrap();
        text
    }
    /// Whether a ray from the origin meets it, and if so at which distance.
    fn meets(&self, w: V3) -> Option<f64> {
        match *self {
            Self::Panel { corner, edges: [u, v] } | Self::Triangle { corner, edges: [u, v] } => {
                let normal = cross(u, v);
                let distance = dot(corner, normal) / dot(w, normal);
                let at = sub(w.map(|x| x * distance), corner);
                let square = dot(normal, normal);
                let [s, t] = [dot(cross(at, v), normal) / square, dot(cross(u, at), normal) / square];
                let whole = if matches!(self, Self::Panel { .. }) { s <= 1.0 && t <= 1.0 } else { s + t <= 1.0 };
                (distance > 0.0 && s >= 0.0 && t >= 0.0 && whole).then_some(distance)
            }
            Self::Ball { center, radius } => {
                let along = dot(w, center);
                let under = radius * radius - (dot(center, center) - along * along);
                (under > 0.0 && along > 0.0).then(|| along - under.sqrt())
            }
        }
    }
    /// Directions to it, with solid angles.
    fn directions(&self, side: usize) -> Vec<(V3, f64)> {
        let place = |k: usize| [k / side, k % side].map(|i| (i as f64 + 0.5) / side as f64);
        let count = (side * side) as f64;
        let of = |k: usize| match *self {
            Self::Panel { corner, edges: [u, v] } | Self::Triangle { corner, edges: [u, v] } => {
                let ([x, y], is_triangle) = (place(k), matches!(self, Self::Triangle { .. }));
                let (y, part) = if is_triangle { ((1.0 - x) * y, 1.0 - x) } else { (y, 1.0) };
                let at = along(along(corner, u, x), v, y);
                (unit(at), part * dot(at, cross(u, v)).abs() / length(at).powi(3) / count)
            }
            Self::Ball { center, radius } => {
                let [x, y] = place(k);
                let sine = radius / length(center);
                let versine = sine * sine / (1.0 + (1.0 - sine * sine).sqrt());
                let (z, turn) = (1.0 - versine * x, TAU * y);
                let (s, t) = basis(unit(center));
                let r = (1.0 - z * z).sqrt();
                let w = along(along(unit(center).map(|c| c * z), s, r * turn.cos()), t, r * turn.sin());
                (w, TAU * versine / count)
            }
        };
        (0..side * side).map(of).collect()
    }
}

/// A surface at the origin whose normal is +y, with Schlick's reflectance of 0.04 over a diffuse one.
struct Coat {
    alpha: f64,
    albedo: V3,
    view: V3,
}

impl Coat {
    fn text(&self) -> String {
        let [r, g, b] = self.albedo;
        format!(
            "Material \"coateddiffuse\" \"rgb reflectance\" [{r} {g} {b}] \"float roughness\" {} \"bool remaproughness\" false\n\
             Shape \"bilinearmesh\" \"point3 P\" [-9 0 9  9 0 9  -9 0 -9  9 0 -9]\n",
            self.alpha
        )
    }
    /// f cosθ per channel.
    fn reflected(&self, w: V3) -> V3 {
        let half = unit(along(self.view, w, 1.0));
        let [i, o, m] = [self.view, w, half].map(|v| v[1]);
        if o <= 0.0 {
            return [0.0; 3];
        }
        let square = self.alpha * self.alpha;
        let density = square / (PI * (m * m * (square - 1.0) + 1.0).powi(2));
        let root = |cos: f64| (square + (1.0 - square) * cos * cos).sqrt();
        let fresnel = 0.04 + 0.96 * (1.0 - dot(half, self.view)).powi(5);
        let shine = fresnel * density / (2.0 * (o * root(i) + i * root(o)));
        self.albedo.map(|albedo| o * ((1.0 - fresnel) * albedo / PI + shine))
    }
}

/// The reflected light by sums over the lights, which hide each other, behind a blocker, if there is one.
fn truth(coat: &Coat, lights: &[Light], blocker: Option<&Light>) -> V3 {
    let mut sum = [0.0; 3];
    for light in lights {
        for (w, solid_angle) in light.directions(1200) {
            let reach = light.meets(w).unwrap_or(f64::INFINITY);
            let before = |other: &Light| other.meets(w).is_some_and(|distance| distance < 0.999 * reach);
            let hidden = lights.iter().chain(blocker).any(before);
            if !hidden {
                let reflected = coat.reflected(w);
                (0..3).for_each(|k| sum[k] += solid_angle * reflected[k]);
            }
        }
    }
    sum
}

/// Panels, triangles and balls in the highlight and beside it, whole and behind something, on black and on coloured surfaces: closed forms
/// and samples together have the light of the sums, within five of the errors that they claim, which are small.
#[test]
fn rough_surfaces_reflect_the_sums() {
    let panel = |x: f64| Light::Panel { corner: [x, 2.0, -3.0], edges: [[1.5, 0.0, 0.0], [0.0, 1.0, 0.5]] };
    let triangle = || Light::Triangle { corner: [-2.0, 1.0, -1.0], edges: [[1.0, 0.0, -1.0], [0.0, 1.5, 0.0]] };
    let ball = |y: f64| Light::Ball { center: [0.5, y, -2.0], radius: 0.6 };
    let screen = || Light::Panel { corner: [-0.1, 0.9, -1.2], edges: [[2.0, 0.0, 0.0], [0.0, 0.6, 0.0]] };
    let scenes: [(&str, Vec<Light>, Option<Light>); 6] = [
        ("a panel", vec![panel(-0.7)], None),
        ("a triangle", vec![triangle()], None),
        ("a ball", vec![ball(1.5)], None),
        // the floor hides its lower half: it is sampled
        ("a ball on the horizon", vec![ball(0.1)], None),
        ("a panel behind a screen", vec![panel(-0.7)], Some(screen())),
        ("all", vec![panel(-2.5), triangle(), ball(2.5)], None),
    ];
    let mut worst = 0.0_f64;
    for (name, lights, blocker) in &scenes {
        for (alpha, albedo, view) in [
            (0.15, [0.0; 3], [0.2, 2.0, 3.0]),
            (0.4, [0.6, 0.3, 0.1], [0.0, 1.0, 2.0]),
            (0.7, [0.5, 0.5, 0.5], [2.0, 2.0, 1.0]),
        ] {
            let coat = Coat { alpha, albedo, view: unit(view) };
            let truth = truth(&coat, lights, blocker.as_ref());
            let [x, y, z] = view;
            let mut text =
                format!("LookAt {x} {y} {z}  0 0 0  0.1 1 0.2 Camera \"perspective\" \"float fov\" 1e-3 WorldBegin\n");
            text += &coat.text();
            lights.iter().for_each(|light| text += &light.text(true));
            blocker.iter().for_each(|blocker| text += &blocker.text(false));
            let world = World::new(&etendue_scene::parse(&text, "glossy.pbrt", Path::new(".")).unwrap()).unwrap();
            let mut errors = [0.0; 2];
            for (error, technique) in errors.iter_mut().zip([Technique::Analytic, Technique::MisPower]) {
                let (film, _) = world.render(&settings(technique, cases(1 << 12, 1 << 15)), &|_| ());
                let pixel = film.pixels[0];
                for (k, truth) in truth.into_iter().enumerate() {
                    let claim = f64::from(pixel.variance[k]).sqrt();
                    let off = (f64::from(pixel.mean[k]) - truth).abs();
                    // the last is the error of the sums, which is that of a cell along the edge of a shadow
                    let edges = if blocker.is_some() || lights.len() > 1 { 1e-4 } else { 2e-5 };
                    let z = off / (claim + edges * truth);
                    worst = worst.max(z);
                    assert!(z < 5.0, "{name}, α {alpha}, {technique:?}: {}, not {} ± {claim}", pixel.mean[k], truth);
                    *error += claim / truth;
                }
            }
            println!(
                "{name}, α {alpha}: claims {errors:.5?}, {:.1} times less variance",
                (errors[1] / errors[0]).powi(2)
            );
            let is_known = !name.contains("horizon");
            assert!(errors[0] < errors[1] * if is_known { 0.75 } else { 1.01 }, "{name}, α {alpha}: {errors:?}");
        }
    }
    println!("greatest deviation {worst:.1} of what is claimed");
}

/// Forty small panels, of which a coat and a rough floor each reflect a few: a tree chooses among them in view of the lobe, and both techniques
/// that combine light and BSDF weigh by the same probabilities, so that the reflected light is that of the sum, within five of the errors that
/// they claim.
#[test]
fn many_lights_are_chosen_in_view_of_the_lobe() {
    let panel = |k: usize| {
        let [x, z] = [k % 8, k / 8].map(|i| i as f64);
        Light::Panel { corner: [1.1 * x - 4.0, 1.5, -1.0 - 1.1 * z], edges: [[0.5, 0.0, 0.0], [0.0, 0.0, -0.5]] }
    };
    let lights: Vec<_> = (0..40).map(panel).collect();
    for (alpha, albedo) in [(0.1, [0.0; 3]), (0.3, [0.6, 0.3, 0.1])] {
        let coat = Coat { alpha, albedo, view: unit([0.3, 1.0, 2.0]) };
        let mut truth = [0.0; 3];
        for (w, solid_angle) in lights.iter().flat_map(|light| light.directions(200)) {
            let reflected = coat.reflected(w);
            (0..3).for_each(|k| truth[k] += solid_angle * reflected[k]);
        }
        let [x, y, z] = coat.view;
        let mut text =
            format!("LookAt {x} {y} {z}  0 0 0  0.1 1 0.2 Camera \"perspective\" \"float fov\" 1e-3 WorldBegin\n");
        text += &coat.text();
        lights.iter().for_each(|light| text += &light.text(true));
        let world = World::new(&etendue_scene::parse(&text, "many.pbrt", Path::new(".")).unwrap()).unwrap();
        for technique in [Technique::SolidAngle, Technique::MisPower, Technique::MisBalance] {
            let (film, _) = world.render(&settings(technique, cases(1 << 16, 1 << 19)), &|_| ());
            let pixel = film.pixels[0];
            for (k, truth) in truth.into_iter().enumerate() {
                let claim = f64::from(pixel.variance[k]).sqrt();
                let off = (f64::from(pixel.mean[k]) - truth).abs();
                println!("α {alpha}, {technique:?}: {} ± {claim}, {truth}", pixel.mean[k]);
                assert!(
                    off < 5.0 * claim + 1e-4 * truth,
                    "α {alpha}, {technique:?}: {} ± {claim}, {truth}",
                    pixel.mean[k]
                );
                assert!(claim < 0.02 * truth, "α {alpha}, {technique:?}: ± {claim}, {truth}");
            }
        }
    }
}

/// Spheres that rough metals reflect are sampled by the lobe alone: the light is that of rays by the BSDF, within four of the errors that both
/// claim, in the highlight, on the horizon, behind a screen and beside a panel, and it varies less than with MIS.
#[test]
fn metals_reflect_spheres_as_by_the_bsdf() {
    let ball = |y: f64, radius: f64| Light::Ball { center: [-0.3, y, -2.0], radius };
    let screen = || Light::Panel { corner: [-0.1, 0.4, -1.2], edges: [[2.0, 0.0, 0.0], [0.0, 0.6, 0.0]] };
    let panel = || Light::Panel { corner: [0.7, 1.0, -2.0], edges: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.5]] };
    let scenes: [(&str, Vec<Light>, Option<Light>); 5] = [
        ("a ball", vec![ball(1.5, 0.6)], None),
        ("a ball on the horizon", vec![ball(0.1, 0.6)], None),
        ("a great ball", vec![ball(1.9, 1.8)], None),
        ("a ball behind a screen", vec![ball(1.5, 0.6)], Some(screen())),
        ("balls and a panel", vec![ball(1.5, 0.4), ball(0.3, 0.5), panel()], None),
    ];
    let mut worst = 0.0_f64;
    for (name, lights, blocker) in &scenes {
        for (alpha, [x, y, z]) in [(0.1, [0.2, 2.0, 3.0]), (0.3, [0.0, 1.0, 3.0]), (0.6, [2.0, 0.4, 2.0])] {
            let mut text =
                format!("LookAt {x} {y} {z}  0 0 0  0.1 1 0.2 Camera \"perspective\" \"float fov\" 1e-3 WorldBegin\n");
            writeln!(
                text,
                "Material \"conductor\" \"rgb reflectance\" [0.9 0.9 0.9] \"float roughness\" {alpha} \"bool remaproughness\" false\n\
                 Shape \"bilinearmesh\" \"point3 P\" [-9 0 9  9 0 9  -9 0 -9  9 0 -9]"
            )
            .unwrap();
            lights.iter().for_each(|light| text += &light.text(true));
            blocker.iter().for_each(|blocker| text += &blocker.text(false));
            let world = World::new(&etendue_scene::parse(&text, "metal.pbrt", Path::new(".")).unwrap()).unwrap();
            let pixel = |technique, spp| {
                let (film, _) = world.render(&settings(technique, spp), &|_| ());
                [f64::from(film.pixels[0].mean[1]), f64::from(film.pixels[0].variance[1]).sqrt()]
            };
            let [truth, doubt] = pixel(Technique::Brdf, cases(1 << 19, 1 << 22));
            let spp = cases(1 << 15, 1 << 18);
            for technique in [Technique::MisLobe, Technique::Analytic] {
                let [mean, claim] = pixel(technique, spp);
                let z = (mean - truth).abs() / claim.hypot(doubt);
                worst = worst.max(z);
                assert!(!differs(z), "{name}, α {alpha}, {technique:?}: {mean} ± {claim}, not {truth} ± {doubt}");
            }
            if lights.len() == 1 && blocker.is_none() {
                let [by_lobe, both] = [Technique::MisLobe, Technique::MisPower].map(|by| pixel(by, spp)[1]);
                println!("{name}, α {alpha}: {:.1} times less variance than mis-power", (both / by_lobe).powi(2));
                assert!(by_lobe < 0.8 * both, "{name}, α {alpha}: ± {by_lobe}, mis-power ± {both}");
            }
        }
    }
    println!("greatest deviation {worst:.1} of what is claimed");
}
