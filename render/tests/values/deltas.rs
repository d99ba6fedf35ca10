//! Lights without area: of a point, a direction or a cone, and those whose intensity differs by direction.

use super::place::{NamedTransform, all, similar};
use super::row::{Row, grey, on_floor, reflected, times};
use etendue_oracle::{V3, along, dot, length, sub, unit};
use std::f64::consts::PI;

/// Irradiance of the floor at the origin by an intensity of 1 from a point.
fn from_point(p: V3) -> f64 {
    p[2].max(0.0) / length(p).powi(3)
}

/// Parameters of strength, and what they make of a light of which a strength of 1 has a power (or illuminance) of `per_unit`.
///
/// pbrt-v4: the strength is the colour times the scale. A power or illuminance sets the strength of a white light, and the scale multiplies
/// it.
fn strengths(color: &str, photometric: &str, per_unit: f64) -> Vec<(String, V3)> {
    let given = |value: f64| value / per_unit;
    vec![
        (String::new(), grey(1.0)),
        (format!("\"rgb {color}\" [1 2 4]"), [1.0, 2.0, 4.0]),
        ("\"float scale\" 3".into(), grey(3.0)),
        (format!("\"rgb {color}\" [1 2 4] \"float scale\" .5"), [0.5, 1.0, 2.0]),
        (format!("\"float {photometric}\" 100"), grey(given(100.0))),
        (format!("\"float {photometric}\" 100 \"float scale\" .1"), grey(given(10.0))),
        (format!("\"rgb {color}\" [1 1 1] \"float {photometric}\" 100 \"float scale\" 7"), grey(given(700.0))),
    ]
}

pub(super) fn rows() -> Vec<Row> {
    let kinds = [points(), distant(), spots(), goniometric(), lamps(), together(), beside_colours()];
    // as light from one direction has no noise, every technique has the values of one place exactly
    let exactly = |row: Row| if row.name.contains(NamedTransform::new().name.as_str()) { row.exactly() } else { row };
    kinds.into_iter().flatten().map(exactly).collect()
}

fn points() -> Vec<Row> {
    let mut rows = Vec::new();
    for place in all(&NamedTransform::new().translate([0.2, 0.3, 4.0])) {
        for (text, strength) in strengths("I", "power", 4.0 * PI) {
            let light = place.holds(&format!("LightSource \"point\" {text} \"point3 from\" [.5 -.4 .3]"));
            let right = reflected(times(strength, from_point(place.point([0.5, -0.4, 0.3]))));
            rows.push(Row::new(format!("point {text}, {}", place.name), on_floor(&light), right));
        }
    }
    let below = on_floor("LightSource \"point\" \"point3 from\" [0 0 -1]");
    rows.push(Row::new("point below", below, grey(0.0)));
    let several = "LightSource \"point\" \"point3 from\" [0 0 2] LightSource \"point\" \"point3 from\" [0 0 1]";
    rows.push(Row::new("two points", on_floor(several), reflected(grey(1.25))));
    rows
}

fn distant() -> Vec<Row> {
    let mut rows = Vec::new();
    for place in all(&NamedTransform::new().translate([3.0, 2.0, -1.0])) {
        // from a direction of the world, whatever the transform
        for towards in [[0.0, 0.0, 1.0], [0.6, -0.3, 0.5], [0.3, 0.3, -0.5]] {
            let local = place.inverse_vector(towards);
            let cos = unit(towards)[2].max(0.0);
            for (text, strength) in strengths("L", "illuminance", 1.0) {
                let from = along([1.0, 2.0, 3.0], local, 1.0);
                let [x, y, z] = from;
                let light =
                    format!("LightSource \"distant\" {text} \"point3 from\" [{x} {y} {z}] \"point3 to\" [1 2 3]");
                let right = reflected(times(strength, cos));
                let name = format!("distant {text}, {}, from {towards:?}", place.name);
                rows.push(Row::new(name, on_floor(&place.holds(&light)), right));
            }
        }
    }
    // by default it shines along +z
    rows.push(Row::new("distant by default", on_floor("LightSource \"distant\""), grey(0.0)));
    let flipped = "AttributeBegin Scale 1 1 -1 LightSource \"distant\" AttributeEnd";
    rows.push(Row::new("distant by default, mirrored", on_floor(flipped), reflected(grey(1.0))));
    rows
}

/// The falloff of a spot light at this cosine.
fn falloff(cos: f64, [inner, outer]: [f64; 2]) -> f64 {
    let [inner, outer] = [inner, outer].map(|degrees| degrees.to_radians().cos());
    let t = ((cos - outer) / (inner - outer)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn spots() -> Vec<Row> {
    let mut rows = Vec::new();
    let angles = [12.0_f64, 20.0];
    let [inner, outer] = angles.map(|degrees| degrees.to_radians().cos());
    let per_unit = 2.0 * PI * ((1.0 - inner) + (inner - outer) / 2.0);
    let from = [0.2, -0.3, 0.4];
    for place in similar(&NamedTransform::new().translate([0.1, 0.2, 4.0])) {
        // the axis meets the floor within the inner cone of the origin, between both, and outside
        for target in [[0.3, 0.2, 0.0], [1.3, 0.3, 0.0], [3.0, 0.1, 0.0]] {
            let position = place.point(from);
            let cos = dot(unit(sub(target, position)), unit(sub([0.0; 3], position)));
            let [x, y, z] = place.inverse_point(target);
            for (text, strength) in strengths("I", "power", per_unit) {
                let cone = "\"float coneangle\" 20 \"float conedeltaangle\" 8";
                let ends = format!("\"point3 from\" [.2 -.3 .4] \"point3 to\" [{x} {y} {z}]");
                let light = place.holds(&format!("LightSource \"spot\" {text} {cone} {ends}"));
                let right = reflected(times(strength, from_point(position) * falloff(cos, angles)));
                // the cosine of single precision is off by 6e-8 of the 0.04 between those of both angles, and the falloff by more
                let row = Row::new(format!("spot {text}, {}, at {target:?}", place.name), on_floor(&light), right);
                rows.push(row.within(1e-4));
            }
        }
    }
    // 30 degrees, of which 5 fall off, along +z
    for (offset, name) in [(0.4, "inside"), (0.53, "between"), (0.6, "outside")] {
        let light = format!("AttributeBegin Translate {offset} 0 1 Scale 1 1 -1 LightSource \"spot\" AttributeEnd");
        let position: V3 = [offset, 0.0, 1.0];
        let value = from_point(position) * falloff(position[2] / length(position), [25.0, 30.0]);
        rows.push(Row::new(format!("spot by default, {name}"), on_floor(&light), reflected(grey(value))).within(1e-4));
    }
    // narrow ones, at 0.9 and 1.1 of the radius
    for (angle, tolerance) in [(0.5_f64, 1e-3), (0.1, 1e-3), (0.01, 1e-3)] {
        for part in [0.9, 1.1] {
            let x = 2.0 * (part * angle).to_radians().tan();
            let ends = format!("\"point3 from\" [{x} 0 2] \"point3 to\" [{x} 0 0]");
            let cone = format!("\"float coneangle\" {angle} \"float conedeltaangle\" 0");
            let lit = if part < 1.0 { from_point([x, 0.0, 2.0]) } else { 0.0 };
            let text = on_floor(&format!("LightSource \"spot\" {ends} {cone}"));
            let row = Row::new(format!("spot of {angle} degrees at {part} of it"), text, reflected(grey(lit)));
            rows.push(row.within(tolerance));
        }
    }
    rows
}

/// The values of `quarters.exr`, row by row from the top.
const QUARTERS: [V3; 4] = [[1.0, 1.0, 1.0], [2.0, 2.0, 2.0], [3.0, 3.0, 3.0], [4.0, 4.0, 4.0]];

fn goniometric() -> Vec<Row> {
    let mut rows = Vec::new();
    for place in similar(&NamedTransform::new().translate([0.4, 0.6, 3.0])) {
        let position = place.point([0.0; 3]);
        // the image's y axis is the light's z axis, and the other way round
        let [x, _, z] = place.inverse_vector(sub([0.0; 3], position));
        let shown = QUARTERS[usize::from(z > 0.0) * 2 + usize::from(x > 0.0)];
        // the texels have equal solid angles
        for (text, strength) in strengths("I", "power", 4.0 * PI * 2.5) {
            let light = format!("LightSource \"goniometric\" \"string filename\" \"quarters.exr\" {text}");
            let right: V3 = std::array::from_fn(|k| shown[k] * strength[k] * from_point(position));
            let name = format!("goniometric {text}, {}", place.name);
            rows.push(Row::new(name, on_floor(&place.holds(&light)), reflected(right)));
        }
    }
    rows
}

/// Lamps of IES files, whose nadir is −y.
fn lamps() -> Vec<Row> {
    let mut rows = Vec::new();
    // the lamp turns about the direction from which the floor is seen, 2 above and 1 beside the origin
    let angle = 0.5_f64.atan().to_degrees();
    let base = || NamedTransform::new().translate([1.0, 0.0, 2.0]).rotate(90.0, [1.0, 0.0, 0.0]);
    for turn in [0.0, -angle, 50.0] {
        let place = base().rotate(turn, [0.0, 0.0, 1.0]);
        let down = unit(place.inverse_vector([-1.0, 0.0, -2.0]));
        let value = 90.0 * (1.0 - (-down[1]).acos().to_degrees() / 60.0).max(0.0);
        let right = reflected(grey(value * from_point([1.0, 0.0, 2.0])));
        let light = place.holds("LightSource \"goniometric\" \"string filename\" \"cone.ies\"");
        rows.push(Row::new(format!("lamp turned by {turn}, as it is"), on_floor(&light), right).within(1e-4));
    }
    for (text, strength) in strengths("I", "power", 2.0 * PI) {
        // without a power, the file has 9 cd
        let value = if text.contains("power") { strength } else { times(strength, 9.0) };
        let light = base().holds(&format!("LightSource \"goniometric\" \"string filename\" \"below.ies\" {text}"));
        let right = reflected(times(value, from_point([1.0, 0.0, 2.0])));
        rows.push(Row::new(format!("lamp {text}"), on_floor(&light), right).within(1e-4));
    }
    rows
}

/// Several lights at once, and what hides them, whichever technique is used.
fn together() -> Vec<Row> {
    let lamp = "LightSource \"point\" \"point3 from\" [.15 .1 2] \"rgb I\" [1 2 3]";
    let lit = times([1.0, 2.0, 3.0], from_point([0.15, 0.1, 2.0]));
    let sun = "LightSource \"distant\" \"point3 from\" [3 0 4] \"point3 to\" [0 0 0] \"rgb L\" [1 .5 2]";
    let both = along([0.8, 0.4, 1.6], lit, 1.0);
    let glow = "AttributeBegin Material \"diffuse\" \"rgb reflectance\" [0 0 0] AreaLightSource \"diffuse\" Translate 0 0 5 \
                Shape \"sphere\" \"float radius\" .2 AttributeEnd";
    let screen = "Shape \"bilinearmesh\" \"point3 P\" [-9 -9 1 9 -9 1 -9 9 1 9 9 1]";
    let metal = "Material \"conductor\" \"rgb reflectance\" [1 1 1] \"float roughness\" .3";
    let row = |name: &str, lights: String, right: V3| Row::new(name, on_floor(&lights), reflected(right)).exactly();
    vec![
        row("a point and a distant light", format!("{lamp} {sun}"), both),
        row(
            "a point behind a ball",
            format!("{lamp} Translate .07 .05 1 Shape \"sphere\" \"float radius\" .2"),
            grey(0.0),
        ),
        row("lights behind a mirror", format!("{lamp} {glow} Material \"mirror\" {screen}"), grey(0.0)),
        row("lights behind a rough metal", format!("{lamp} {glow} {metal} {screen}"), grey(0.0)),
    ]
}

/// pbrt-v4 multiplies a power by the colour beside it; here the light has the power.
fn beside_colours() -> Vec<Row> {
    let why = "a colour beside a power is only a hue: the luminance is that of the power";
    let y = 0.2126 * 1.0 + 0.7152 * 2.0 + 0.0722 * 4.0;
    let color = [1.0, 2.0, 4.0];
    let point = "LightSource \"point\" \"rgb I\" [1 2 4] \"float power\" 100 \"point3 from\" [0 0 2]";
    let sun = "LightSource \"distant\" \"rgb L\" [1 2 4] \"float illuminance\" 100 \"point3 from\" [0 0 2] \"point3 to\" [0 0 0]";
    let of = |name: &str, text: &str, factor: f64| {
        let right = reflected(times(color, factor));
        Row::new(name, on_floor(text), right).differs(times(right, 1.0 / y), why).within(1e-4)
    };
    vec![
        of("point of a colour and a power", point, 100.0 / (4.0 * PI) / 4.0),
        of("distant of a colour and an illuminance", sun, 100.0),
    ]
}
