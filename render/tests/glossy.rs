//! Light that rough surfaces reflect, against sums and the formula in double precision.

use crate::kit::{ALBEDO, BLACK, list, narrow, pixel, quad, world};
use etendue_oracle::tier::cases;
use etendue_oracle::{V3, along, basis, cross, dot, integrate, length, sub, unit};
use etendue_render::film::compare::differs;
use etendue_render::{Technique, World};
use std::f64::consts::{PI, TAU};
use std::fmt::Write;

/// A light of radiance 1.
enum Light {
    Panel { corner: V3, edges: [V3; 2] },
    Triangle { corner: V3, edges: [V3; 2] },
    Ball { center: V3, radius: f64 },
}

impl Light {
    fn text(&self, emits: bool) -> String {
        let mut text = format!("AttributeBegin {BLACK}");
        if emits {
            text.push_str("AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"bool twosided\" true\n");
        }
        let shape = match *self {
            Self::Panel { corner, edges } => quad(corner, edges),
            Self::Triangle { corner, edges } => {
                let [a, b] = edges.map(|edge| along(corner, edge, 1.0));
                format!("Shape \"trianglemesh\" \"point3 P\" [{}]", list(&[corner, a, b]))
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

/// A surface at the origin whose normal is +y: microfacets over a diffuse surface.
struct Gloss {
    /// Roughness in a direction, and across.
    alpha: [f64; 2],
    along: V3,
    /// Reflectance at normal and at grazing incidence.
    fresnel: [f64; 2],
    albedo: V3,
    view: V3,
}

const X: V3 = [1.0, 0.0, 0.0];

impl Gloss {
    /// A coat with the same roughness in all directions.
    fn coat(alpha: f64, albedo: V3, view: V3) -> Self {
        Self { alpha: [alpha; 2], along: X, fresnel: [0.04, 1.0], albedo, view: unit(view) }
    }
    fn text(&self) -> String {
        let [r, g, b] = self.albedo;
        format!(
            "Material \"substrate\" \"rgb Kd\" [{r} {g} {b}] \"rgb Ks\" [.04 .04 .04] \"float uroughness\" {} \"float vroughness\" {} \
             \"bool remaproughness\" false\n{FLOOR}",
            self.alpha[0], self.alpha[1]
        )
    }
    /// f cosθ per channel (GGX by glTF 2.0, appendix B; Heitz 2014, equations 85, 86 and 99).
    fn reflected(&self, w: V3) -> V3 {
        let half = unit(along(self.view, w, 1.0));
        let ([i, o, m], [a, b]) = ([self.view, w, half].map(|v| v[1]), self.alpha);
        if o <= 0.0 {
            return [0.0; 3];
        }
        // squares of the components along and across
        let squares = |v: V3| {
            let u = dot(v, self.along);
            [u * u, v[0] * v[0] + v[2] * v[2] - u * u]
        };
        let [u, v] = squares(half);
        let density = 1.0 / (PI * a * b * (u / (a * a) + v / (b * b) + m * m).powi(2));
        let lambda = |w: V3| {
            let [u, v] = squares(w);
            ((1.0 + (a * a * u + b * b * v) / (w[1] * w[1])).sqrt() - 1.0) / 2.0
        };
        let [least, most] = self.fresnel;
        let fresnel = least + (most - least) * (1.0 - dot(half, self.view)).powi(5);
        let shine = fresnel * density / (1.0 + lambda(w) + lambda(self.view)) / (4.0 * i * o);
        self.albedo.map(|albedo| o * ((1.0 - fresnel) * albedo / PI + shine))
    }
}

const FLOOR: &str = "Shape \"bilinearmesh\" \"point3 P\" [-9 0 9  9 0 9  -9 0 -9  9 0 -9]\n";

/// The origin of a surface seen in this direction, with lights and perhaps an occluder.
fn scene(view: V3, surface: &str, lights: &[Light], occluder: Option<&Light>) -> World {
    let lights = lights.iter().map(|light| light.text(true)).chain(occluder.map(|occluder| occluder.text(false)));
    let [x, y, z] = view;
    world(&narrow(&format!("{x} {y} {z}"), &(surface.to_owned() + &lights.collect::<String>())))
}

fn metal(reflectance: f64, alpha: f64) -> String {
    format!(
        "Material \"conductor\" \"rgb reflectance\" [{reflectance} {reflectance} {reflectance}] \"float roughness\" {alpha} \
         \"bool remaproughness\" false\n"
    )
}

/// The reflected light by sums over the lights, which hide each other, behind an occluder, if there is one.
fn truth(coat: &Gloss, lights: &[Light], occluder: Option<&Light>, side: usize) -> V3 {
    let mut sum = [0.0; 3];
    for light in lights {
        for (w, solid_angle) in light.directions(side) {
            let reach = light.meets(w).unwrap_or(f64::INFINITY);
            let before = |other: &Light| other.meets(w).is_some_and(|distance| distance < 0.999 * reach);
            let hidden = lights.iter().chain(occluder).any(before);
            if !hidden {
                sum = along(sum, coat.reflected(w), solid_angle);
            }
        }
    }
    sum
}

/// Coats by every technique have their formula under a sun: with the same roughness in all directions, and with one that differs along u and
/// across.
#[test]
fn coats_have_their_formula() {
    // u and v are linear in x and z, with ∂p/∂u along (1, 0, −1)
    let corners = [[-9.0, 9.0], [9.0, 9.0], [0.0, -9.0]];
    let uv = corners.map(|[x, z]| format!("{} {}", x + 0.3 * z, x + z)).join(" ");
    let skewed = format!("Shape \"trianglemesh\" \"point3 P\" [-9 0 9 9 0 9 0 0 -9] \"point2 uv\" [{uv}]\n");
    let diagonal = unit([1.0, 0.0, -1.0]);
    // of plastic, Ks is a factor of the whole reflectance
    let kinds = [
        ("\"substrate\" \"rgb Kd\" [.8 .5 .2] \"rgb Ks\" [.04 .04 .04]", [0.04, 1.0]),
        ("\"plastic\" \"rgb Kd\" [.8 .5 .2] \"rgb Ks\" [.1 .1 .1]", [0.004, 0.1]),
    ];
    for (shape, along, [a, b]) in
        [(FLOOR, X, [0.5_f64, 0.5_f64]), (FLOOR, X, [0.3, 0.6]), (&*skewed, diagonal, [0.7, 0.2])]
    {
        for (kind, fresnel) in kinds {
            let gloss = Gloss { alpha: [a, b], along, fresnel, albedo: ALBEDO, view: unit([1.0, 5.0, 2.0]) };
            for to in [[-1.0, 5.0, -2.0], [0.0, 1.0, 0.0], [-4.0, 1.0, 0.0], [0.5, 1.0, 3.0]] {
                let [x, y, z] = to;
                let sun = format!("LightSource \"distant\" \"point3 from\" [{x} {y} {z}] \"point3 to\" [0 0 0]");
                let rough = format!("\"float uroughness\" {} \"float vroughness\" {}", a * a, b * b);
                let world = world(&narrow("1 5 2", &format!("{sun} Material {kind} {rough} {shape}")));
                let truth = gloss.reflected(unit(to));
                for technique in Technique::ALL {
                    let [mean, _] = pixel(&world, technique, 8);
                    let is_near = (0..3).all(|k| (mean[k] - truth[k]).abs() <= 3e-5 * truth[k]);
                    assert!(is_near, "{technique:?}, {kind}, {to:?}: {mean:?}, not {truth:?}");
                }
            }
        }
    }
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
    for (name, lights, occluder) in &scenes {
        // where nothing hides a part of a light, the sum has no edge and fewer cells do
        let is_whole = lights.len() == 1 && occluder.is_none() && !name.contains("horizon");
        let side = if is_whole { 400 } else { 1200 };
        for (alpha, albedo, view) in [
            (0.15, [0.0; 3], [0.2, 2.0, 3.0]),
            (0.4, [0.6, 0.3, 0.1], [0.0, 1.0, 2.0]),
            (0.7, [0.5, 0.5, 0.5], [2.0, 2.0, 1.0]),
        ] {
            let coat = Gloss::coat(alpha, albedo, view);
            let truth = truth(&coat, lights, occluder.as_ref(), side);
            let world = scene(view, &coat.text(), lights, occluder.as_ref());
            let claims = [Technique::Analytic, Technique::MisPower].map(|technique| {
                let [mean, claim] = pixel(&world, technique, cases(1 << 12, 1 << 15));
                // the last is the error of the sums, which is that of a cell along the edge of a shadow
                let edges = if occluder.is_some() || lights.len() > 1 { 1e-4 } else { 2e-5 };
                let is_near = (0..3).all(|k| (mean[k] - truth[k]).abs() < 5.0 * (claim[k] + edges * truth[k]));
                assert!(is_near, "{name}, α {alpha}, {technique:?}: {mean:?}, not {truth:?} ± {claim:?}");
                (0..3).map(|k| claim[k] / truth[k]).sum::<f64>()
            });
            println!("{name}, α {alpha}: claims {claims:.5?}");
            let is_known = !name.contains("horizon");
            assert!(claims[0] < claims[1] * if is_known { 0.75 } else { 1.01 }, "{name}, α {alpha}: {claims:?}");
        }
    }
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
        let view = [0.3, 1.0, 2.0];
        let coat = Gloss::coat(alpha, albedo, view);
        let truth = lights
            .iter()
            .fold([0.0; 3], |sum, light| along(sum, truth(&coat, std::slice::from_ref(light), None, 200), 1.0));
        let world = scene(view, &coat.text(), &lights, None);
        for technique in [Technique::SolidAngle, Technique::MisPower, Technique::MisBalance] {
            let [mean, claim] = pixel(&world, technique, cases(1 << 16, 1 << 19));
            let what = format!("α {alpha}, {technique:?}: {mean:?} ± {claim:?}, {truth:?}");
            println!("{what}");
            assert!((0..3).all(|k| (mean[k] - truth[k]).abs() < 5.0 * claim[k] + 1e-4 * truth[k]), "{what}");
            assert!((0..3).all(|k| claim[k] < 0.02 * truth[k]), "{what}");
        }
    }
}

/// Spheres that rough metals reflect are sampled by the lobe alone: the light is that of rays by the BSDF, within the errors that both claim, in
/// the highlight, on the horizon, behind a screen and beside a panel, and it varies less than with MIS.
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
    for (name, lights, occluder) in &scenes {
        for (alpha, view) in [(0.1, [0.2, 2.0, 3.0]), (0.3, [0.0, 1.0, 3.0]), (0.6, [2.0, 0.4, 2.0])] {
            let world = scene(view, &(metal(0.9, alpha) + FLOOR), lights, occluder.as_ref());
            let green = |technique, spp| pixel(&world, technique, spp).map(|rgb| rgb[1]);
            let [truth, doubt] = green(Technique::Brdf, cases(1 << 18, 1 << 22));
            let spp = cases(1 << 14, 1 << 18);
            for technique in [Technique::MisLobe, Technique::Analytic] {
                let [mean, claim] = green(technique, spp);
                let z = (mean - truth).abs() / claim.hypot(doubt);
                assert!(!differs(z), "{name}, α {alpha}, {technique:?}: {mean} ± {claim}, not {truth} ± {doubt}");
            }
            if lights.len() == 1 && occluder.is_none() {
                let [by_lobe, both] = [Technique::MisLobe, Technique::MisPower].map(|by| green(by, spp)[1]);
                println!("{name}, α {alpha}: {:.1} times less variance than mis-power", (both / by_lobe).powi(2));
                assert!(by_lobe < 0.8 * both, "{name}, α {alpha}: ± {by_lobe}, mis-power ± {both}");
            }
        }
    }
}

/// The white furnace: a metal that absorbs nothing reflects the albedo of its microsurface, and not more light than there is, in a room
/// whose walls and ceiling shine alike and stand on its horizon, and below a white sky.
#[test]
fn white_rooms_show_the_albedo() {
    let wall = |corner: V3, edges: [V3; 2]| Light::Panel { corner, edges };
    let (x, y, z) = ([4.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 4.0]);
    let walls = [
        wall([-2.0, 0.0, -2.0], [x, y]),
        wall([-2.0, 0.0, 2.0], [x, y]),
        wall([-2.0, 0.0, -2.0], [z, y]),
        wall([2.0, 0.0, -2.0], [z, y]),
        wall([-2.0, 3.0, -2.0], [x, z]),
    ];
    let floor = "Shape \"bilinearmesh\" \"point3 P\" [-2 0 2  2 0 2  -2 0 -2  2 0 -2]\n";
    for (alpha, cos) in [(0.1, 0.9), (0.1, 0.3), (0.3, 0.6), (0.3, 0.15), (0.7, 0.8), (1.0, 0.3)] {
        let view = [(1.0_f64 - cos * cos).sqrt(), cos, 0.0];
        let white = Gloss { alpha: [alpha; 2], along: X, fresnel: [1.0; 2], albedo: [0.0; 3], view };
        // over both signs of the azimuth
        let mut reflected = |o: f64, azimuth: f64| {
            let sine = (1.0 - o * o).sqrt();
            2.0 * white.reflected([sine * libm::cos(azimuth), o, sine * libm::sin(azimuth)])[0]
        };
        let truth = integrate(&mut reflected, [0.0, 0.0], [1.0, PI], 1e-6);
        assert!(truth > 0.4 && truth < 1.0, "α {alpha}, cosθ {cos}: {truth}");
        let room = scene(view, &(metal(1.0, alpha) + floor), &walls, None);
        let outside = scene(view, &format!("LightSource \"infinite\" {} {floor}", metal(1.0, alpha)), &[], None);
        for (name, world, technique) in [
            ("room", &room, Technique::Analytic),
            ("room", &room, Technique::Brdf),
            ("room", &room, Technique::MisPower),
            ("sky", &outside, Technique::Brdf),
            ("sky", &outside, Technique::MisPower),
        ] {
            let [mean, claim] = pixel(world, technique, cases(1 << 12, 1 << 17)).map(|rgb| rgb[1]);
            let what = format!("{name}, {technique:?}, α {alpha}, cosθ {cos}: {mean:.5} ± {claim:.5}, {truth:.5}");
            println!("{what}");
            // the metal's reflectance is 0.9999, and more at grazing angles
            assert!((mean - truth).abs() < 4.0 * (claim + 1e-4), "{what}");
            assert!(mean < 1.0 && claim < cases(0.02, 0.002), "{what}");
        }
    }
}
