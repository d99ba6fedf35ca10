//! Coats over diffuse surfaces and over metals.

use super::meanings::SOME;
use super::row::{FLOOR, Row, grey, look, times};
use etendue_oracle::direct::fresnel;

pub(super) fn rows() -> Vec<Row> {
    [coats(), coated_mirrors()].into_iter().flatten().collect()
}

/// A floor of this material, seen at an angle to its normal, under a sun of irradiance 1 at another angle.
fn under_sun(material: &str, view: f64, light: f64) -> String {
    let at = |angle: f64, turn: f64| [angle.sin() * turn.cos(), angle.sin() * turn.sin(), angle.cos()];
    let [x, y, z] = at(light.to_radians(), 130_f64.to_radians());
    let eye = times(at(view.to_radians(), 0.0), 0.5);
    format!(
        "{}LightSource \"distant\" \"point3 from\" [{x} {y} {z}] \"point3 to\" [0 0 0]\n{material}\n{FLOOR}",
        look(eye, [0.0; 3])
    )
}

/// F D G₂ / (4 cosθᵢ) of a GGX interface for directions at these angles, 130° apart (Heitz 2014, equations 85, 86 and 99).
fn shine(alpha: f64, eta: f64, view: f64, light: f64) -> f64 {
    let (view, light) = (view.to_radians(), light.to_radians());
    let turn = 130_f64.to_radians();
    let cos = view.cos() * light.cos() + view.sin() * light.sin() * turn.cos();
    // half of the angle between them, and the cosine of the half vector to the normal
    let half = ((1.0 + cos) / 2.0).sqrt();
    let up = (view.cos() + light.cos()) / (2.0 * half);
    let square = up * up;
    let density = alpha * alpha / (std::f64::consts::PI * (square * (alpha * alpha - 1.0) + 1.0).powi(2));
    let lambda = |angle: f64| 0.5 * ((1.0 + (alpha * angle.tan()).powi(2)).sqrt() - 1.0);
    fresnel(half, eta, 0.0) * density / (1.0 + lambda(view) + lambda(light)) / (4.0 * view.cos())
}

/// Coats over diffuse surfaces: the base by quadrature, and the highlight by its formula.
fn coats() -> Vec<Row> {
    let row = |[alpha, eta, albedo, view, light, under]: [f64; 6]| {
        let material = format!(
            "Material \"coateddiffuse\" \"rgb reflectance\" [{albedo} {albedo} {albedo}] \"float roughness\" {alpha}
             \"bool remaproughness\" false \"float eta\" {eta}"
        );
        // a smooth coat has a highlight elsewhere
        let shine = if alpha > 0.0 { shine(alpha, eta, view, light) } else { 0.0 };
        let name =
            format!("coateddiffuse of roughness {alpha}, eta {eta}, albedo {albedo}, seen at {view}, lit at {light}");
        Row::new(name, under_sun(&material, view, light), grey(under + shine)).within(0.01).by(SOME)
    };
    let numbers = |line: &str| -> [f64; 6] {
        let numbers: Vec<_> = line.split(' ').map(|x| x.parse().unwrap()).collect();
        numbers.try_into().unwrap()
    };
    let lines = include_str!("coats.txt").lines().filter(|line| !line.starts_with('#'));
    let mut rows: Vec<Row> = lines.map(|line| row(numbers(line))).collect();
    // black below a coat is only the coat; defaults are a smooth coat of 1.5 over 0.5, of no albedo
    for (alpha, view, light) in [(0.2, 20.0, 30.0), (0.5, 60.0, 70.0), (1.0, 5.0, 80.0)] {
        let material = format!(
            "Material \"coateddiffuse\" \"rgb reflectance\" [0 0 0] \"float roughness\" {alpha} \"bool remaproughness\" false"
        );
        let name = format!("black coateddiffuse of roughness {alpha}, seen at {view}, lit at {light}");
        let right = grey(shine(alpha, 1.5, view, light));
        rows.push(Row::new(name, under_sun(&material, view, light), right).within(1e-4).by(SOME));
    }
    let [f, g] = [0.0_f64, 45.0].map(|angle| fresnel(angle.to_radians().cos(), 1.5, 0.0));
    let default = (1.0 - f) * (1.0 - g) / 2.25 * 0.5 / (1.0 - 0.5 * 0.596_35) / std::f64::consts::PI;
    let right = grey(default * 45_f64.to_radians().cos());
    let text = under_sun("Material \"coateddiffuse\"", 0.1, 45.0);
    rows.push(Row::new("coateddiffuse without parameters", text, right).within(0.01).by(SOME));
    rows
}

/// Smooth coats over smooth metals are mirrors: what they show of a sky of 1 is a geometric series.
fn coated_mirrors() -> Vec<Row> {
    let mut rows = Vec::new();
    for (eta, k, coat) in [(0.2, 3.9, 1.5), (1.5, 7.6, 1.3), (0.9, 2.4, 2.0), (2.0, 0.5, 1.1)] {
        for angle in [10_f64, 45.0, 75.0] {
            let material = format!(
                "LightSource \"infinite\"\nMaterial \"coatedconductor\" \"rgb conductor.eta\" [{eta} {eta} {eta}]
                 \"rgb conductor.k\" [{k} {k} {k}] \"float interface.eta\" {coat}"
            );
            let cos = angle.to_radians().cos();
            let below = (1.0 - (1.0 - cos * cos) / (coat * coat)).sqrt();
            let (f, r) = (fresnel(cos, coat, 0.0), fresnel(below, eta / coat, k / coat));
            let right = f + (1.0 - f) * (1.0 - f) * r / (1.0 - f * r);
            let eye = [0.5 * angle.to_radians().sin(), 0.0, 0.5 * cos];
            let name = format!("coatedconductor of {eta} + {k}i below {coat}, seen at {angle}");
            rows.push(Row::new(name, format!("{}{material}\n{FLOOR}", look(eye, [0.0; 3])), grey(right)).by(SOME));
        }
    }
    rows
}
