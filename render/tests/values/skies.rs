//! Light from infinitely far away.

use super::place::{NamedTransform, similar};
use super::row::{Row, grey, look, on_floor, reflected, times};
use etendue_oracle::{V3, cross, dot, sub, unit};
use etendue_render::Technique;
use std::f64::consts::PI;

/// A constant sky has no noise by this.
const PROJECTED: &[Technique] = &[Technique::ProjectedSolidAngle];

pub(super) fn rows() -> Vec<Row> {
    [constant(), images(), windows(), daylight(), portals()].into_iter().flatten().collect()
}

fn constant() -> Vec<Row> {
    let mut rows = Vec::new();
    for place in similar(&NamedTransform::new().translate([3.0, 2.0, 1.0])) {
        for (text, radiance) in [
            ("", grey(1.0)),
            ("\"rgb L\" [1 2 4]", [1.0, 2.0, 4.0]),
            ("\"float scale\" 3", grey(3.0)),
            ("\"rgb L\" [1 2 4] \"float scale\" .5", [0.5, 1.0, 2.0]),
            ("\"float illuminance\" 10", grey(10.0 / PI)),
            ("\"float illuminance\" 10 \"float scale\" .1", grey(1.0 / PI)),
            ("\"rgb L\" [1 1 1] \"float illuminance\" 10 \"float scale\" 7", grey(70.0 / PI)),
        ] {
            let sky = place.holds(&format!("LightSource \"infinite\" {text}"));
            let name = format!("sky {text}, {}", place.name);
            rows.push(Row::new(name.clone(), on_floor(&sky), reflected(times(radiance, PI))).by(PROJECTED));
            rows.push(Row::new(
                format!("{name}, seen"),
                format!("{}{sky}", look([0.0; 3], [0.3, 0.4, -0.5])),
                radiance,
            ));
        }
    }
    let colours = "LightSource \"infinite\" \"rgb L\" [1 2 4]";
    let right = reflected([PI, 2.0 * PI, 4.0 * PI]);
    rows.push(Row::new("sky by each technique", on_floor(colours), right).by(&Technique::ALL).samples(1 << 15));
    // with a pdf proportional to the cosine, all samples have the same value
    let cosines = &[Technique::CosineHemisphere, Technique::Brdf, Technique::ProjectedSolidAngle];
    rows.push(Row { is_exact: true, ..Row::new("sky by cosines", on_floor(colours), right).by(cosines) });
    let two = "LightSource \"infinite\" \"rgb L\" [1 2 3] LightSource \"infinite\" \"rgb L\" [1 1 1]";
    rows.push(Row::new("two skies", on_floor(two), reflected([2.0 * PI, 3.0 * PI, 4.0 * PI])).by(PROJECTED));
    rows
}

/// The value of an image in a direction of its own space. A square image is pbrt-v4's equal-area map, of which the quarters are those of x
/// and y; others show longitude from +x over +y, and the north at the top.
fn texel(file: &str, w: V3) -> f64 {
    if file == "quarters.exr" {
        return [1.0, 2.0, 3.0, 4.0][usize::from(w[0] > 0.0) + 2 * usize::from(w[1] > 0.0)];
    }
    let turn = w[1].atan2(w[0]).rem_euclid(2.0 * PI) / (2.0 * PI);
    1.0 + (turn * 4.0).floor() + 4.0 * f64::from(u8::from(w[2] < 0.0))
}

fn images() -> Vec<Row> {
    let mut rows = Vec::new();
    // the illuminance of a surface that faces the sky's +z: each quarter has a quarter of π
    let illuminance = 2.5 * PI;
    for file in ["quarters.exr", "longitudes.exr"] {
        for place in similar(&NamedTransform::new().rotate(25.0, [0.3, -1.0, 0.2])) {
            for (text, factor) in [
                ("", 1.0),
                ("\"float scale\" 3", 3.0),
                ("\"float illuminance\" 10", 10.0 / illuminance),
                ("\"float illuminance\" 10 \"float scale\" .1", 1.0 / illuminance),
            ] {
                let sky = place.holds(&format!("LightSource \"infinite\" \"string filename\" \"{file}\" {text}"));
                for w in [[0.5, 0.6, 0.7], [-0.4, 0.5, 0.8], [0.3, -0.5, 0.2], [-0.6, -0.3, -0.4], [0.4, -0.3, -0.9]] {
                    let value = texel(file, place.inverse_vector(w)) * factor;
                    let name = format!("sky {file} {text}, {}, seen towards {w:?}", place.name);
                    rows.push(Row::new(name, format!("{}{sky}", look([0.0; 3], w)), grey(value)).within(1e-4));
                }
            }
        }
        // what it measures is what arrives
        let text = format!("LightSource \"infinite\" \"string filename\" \"{file}\" \"float illuminance\" 10");
        let row = Row::new(format!("floor below {file} of 10"), on_floor(&text), reflected(grey(10.0)));
        rows.push(row.by(&Technique::ALL).samples(1 << 16));
    }
    for size in ["one.exr", "1x3.exr", "3x3.exr", "7x7.exr", "6x2.exr", "4x3.exr"] {
        let text = format!("LightSource \"infinite\" \"string filename\" \"{size}\" \"float illuminance\" 10");
        let right = reflected(grey(10.0));
        rows.push(Row::new(format!("floor below a sky of {size} of 10"), on_floor(&text), right).samples(1 << 16));
    }
    // beside a constant one, in either order
    let (image, constant) =
        ("LightSource \"infinite\" \"string filename\" \"one.exr\"", "LightSource \"infinite\" \"rgb L\" [1 2 4]");
    for skies in [format!("{image} {constant}"), format!("{constant} {image}")] {
        let text = format!("{}{skies}", look([0.0; 3], [0.3, 0.4, -0.5]));
        rows.push(Row::new("an image and a constant sky", text, [2.0, 3.0, 5.0]));
    }
    rows
}

/// A picture whose data window is a part of its display window shines in its place: of the map of 4 × 4 texels, only the one of column 2
/// and row 1, which is a sixteenth of all directions.
fn windows() -> Vec<Row> {
    let sky = "LightSource \"infinite\" \"string filename\" \"window.exr\"";
    // by pbrt-v4's equal-area map: a texel beside the middle is near the pole, and belongs to +x and −y
    let towards = |w: V3| format!("{}{sky}", look([0.0; 3], w));
    vec![
        Row::new("data window, in its place", towards([0.1, -0.2, 1.0]), [1.0, 2.0, 4.0]),
        Row::new("data window, beside it", towards([0.1, 0.2, 1.0]), grey(0.0)),
        Row::new("data window, behind it", towards([0.1, -0.2, -1.0]), grey(0.0)),
        Row::new("data window, below its texel", towards([0.9, -0.8, 0.1]), grey(0.0)),
        // the texel's part of the illuminance: see `near_pole`
        Row::new("floor below a data window", on_floor(sky), reflected(times([1.0, 2.0, 4.0], near_pole())))
            .samples(1 << 16),
    ]
}

/// ∫ cosθ dω over a texel of 4 × 4 that touches the middle of the equal-area map.
///
/// In the quarter, let s and t be the distances from the middle in units of half a side, and r = s + t. The ring between r and r + dr has
/// cosθ = 1 − r² and the solid angle 2πr dr · 1/4 of a quarter of a turn; the texel has all azimuths for r ≤ 1/2, and for r from 1/2 to 1 the
/// part (1 − r)/r of them.
fn near_pole() -> f64 {
    let n = 100_000;
    let ring = |k: i32| {
        let r = (f64::from(k) + 0.5) / f64::from(n);
        let part = if r <= 0.5 { 1.0 } else { (1.0 - r) / r };
        (1.0 - r * r) * part * r * PI / f64::from(n)
    };
    (0..n).map(ring).sum()
}

/// Irradiance at the origin with this normal by a polygon of radiance 1 above the horizon (Lambert 1760).
fn polygon(corners: &[V3], normal: V3) -> f64 {
    let edge = |k: usize| {
        let [a, b] = [corners[k], corners[(k + 1) % corners.len()]].map(unit);
        let c = cross(a, b);
        dot(unit(c), normal) * dot(a, b).clamp(-1.0, 1.0).acos()
    };
    0.5 * (0..corners.len()).map(edge).sum::<f64>().abs()
}

/// Daylight with a sun has the illuminance of both; the image of the sky has it to 2e−4.
fn daylight() -> Vec<Row> {
    let sky = "LightSource \"infinite\" \"string sky\" \"cie\" \"integer type\" 12 \"float elevation\" 30 \
               \"float illuminance\" 10 \"float sun\" 8";
    let techniques = &[Technique::SolidAngle, Technique::ProjectedSolidAngle, Technique::MisPower];
    let row = Row::new("daylight and a sun", on_floor(sky), reflected(grey(10.0 + 8.0 * 0.5)));
    vec![row.by(techniques).samples(1 << 16).within(2e-4)]
}

/// What comes through a portal, which is in world space whatever the transform, lights the floor as if the portal emitted it.
fn portals() -> Vec<Row> {
    // pbrt's side is that of the cross product of the last edge and the first
    let corners = [[-0.5, -0.3, 2.0], [-0.5, 0.9, 2.0], [0.7, 0.9, 2.0], [0.7, -0.3, 2.0]];
    let text = corners.iter().flatten().map(f64::to_string).collect::<Vec<_>>().join(" ");
    let share = polygon(&corners, [0.0, 0.0, 1.0]);
    let mut rows = Vec::new();
    for place in ["", "Rotate 35 1 2 3", "Scale 2 2 2"] {
        for (given, radiance) in
            [("\"rgb L\" [1 2 4]", [1.0, 2.0, 4.0]), ("\"rgb L\" [1 1 1] \"float scale\" 5", grey(5.0))]
        {
            let sky = format!("{place} LightSource \"infinite\" {given} \"point3 portal\" [{text}]");
            let right = reflected(times(radiance, share));
            rows.push(Row::new(format!("portal {given} {place}"), on_floor(&sky), right).samples(4096).by(PROJECTED));
        }
    }
    // from where the eye is not in line with it, the sky is black
    let sky = format!("LightSource \"infinite\" \"point3 portal\" [{text}]");
    let through = |p: V3| format!("{}{sky}", look([0.0, 0.0, 0.1], p));
    rows.push(Row::new("through a portal", through([0.1, 0.2, 2.0]), grey(1.0)));
    let behind = format!("{}{sky}", look([0.0, 0.0, 4.0], [0.1, 0.2, 2.0]));
    rows.push(Row::new("from behind a portal", behind, grey(0.0)));
    rows.push(Row::new("beside a portal", through(sub([0.1, 0.2, 2.0], [1.0, 0.0, 0.0])), grey(0.0)));
    rows
}
