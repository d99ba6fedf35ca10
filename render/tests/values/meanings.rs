//! What files mean where readers are often wrong: spectra and illuminants, motion, attributes, lamps that are not seen, and files of
//! other programs.

use super::row::{FLOOR, Row, WHITE_FLOOR, grey, look, on_floor, reflected, times};
use etendue_render::Technique;

/// Light, and two techniques of which one finds lights by chance.
pub(super) const SOME: &[Technique] = &[Technique::Auto, Technique::SolidAngle, Technique::MisPower];

pub(super) fn rows() -> Vec<Row> {
    let tables = [spectra(), motion(), attributes(), mixtures(), panes(), unseen(), files(), floodlights()];
    tables.into_iter().flatten().collect()
}

/// A black disk that shines with luminance 1, seen from above.
fn seen_lamp(light: &str) -> String {
    let black = "Material \"diffuse\" \"rgb reflectance\" [0 0 0]";
    format!("{}{black}\nAreaLightSource \"diffuse\" {light}\nShape \"disk\"", look([0.01, 0.02, 5.0], [0.0; 3]))
}

/// Colours by CIE 1931 at 1 nm and CIE's spectra, from the package "colour", in sRGB without what is beyond its gamut, of luminance 1.
fn spectra() -> Vec<Row> {
    let mut rows = Vec::new();
    for (range, right) in [
        ([500, 600], [0.360_8, 1.291_0, 0.0]),
        ([450, 550], [0.0, 1.299_2, 0.981_9]),
        ([420, 680], [1.183_3, 0.959_8, 0.857_9]),
        ([600, 650], [4.702_8, 0.0, 0.0]),
    ] {
        let [low, high] = range;
        let light = format!("\"spectrum L\" [{low} 1 {high} 1]");
        rows.push(Row::new(format!("light from {low} to {high} nm"), seen_lamp(&light), right).within(4e-3));
    }
    for (range, right) in [
        ([500, 600], [0.213_0, 1.029_2, 0.0]),
        ([450, 550], [0.0, 0.706_1, 0.584_2]),
        ([420, 680], [0.980_6, 1.0, 0.952_2]),
    ] {
        let [low, high] = range;
        let surface = format!("{SUN}\nMaterial \"diffuse\" \"spectrum reflectance\" [{low} .8 {high} .8]");
        let text = format!("{}{surface}\n{FLOOR}", look([0.1, 0.2, 5.0], [0.0; 3]));
        let right = if low == 420 { [0.784_5, 0.806_4, 0.761_8] } else { times(right, 0.8) };
        rows.push(Row::new(format!("a surface from {low} to {high} nm"), text, right).within(5e-3));
    }
    for (name, right) in [
        ("stdillum-A", [1.845_3, 0.826_1, 0.233_3]),
        ("stdillum-D50", [1.176_3, 0.975_7, 0.721_8]),
        ("stdillum-D65", [1.0, 1.0, 1.0]),
        ("illum-acesD60", [1.046_8, 0.994_6, 0.915_7]),
        ("stdillum-F1", [0.954_4, 1.019_3, 0.943_4]),
        ("stdillum-F2", [1.340_3, 0.943_0, 0.562_7]),
        ("stdillum-F3", [1.576_6, 0.891_1, 0.380_8]),
        ("stdillum-F4", [1.806_5, 0.834_2, 0.267_0]),
        ("stdillum-F5", [0.915_5, 1.036_2, 0.890_0]),
        ("stdillum-F6", [1.316_2, 0.957_8, 0.486_4]),
        ("stdillum-F7", [1.000_5, 1.000_2, 0.997_1]),
        ("stdillum-F8", [1.176_8, 0.975_7, 0.719_9]),
        ("stdillum-F9", [1.376_9, 0.931_4, 0.569_1]),
        ("stdillum-F10", [1.174_6, 0.976_5, 0.719_0]),
        ("stdillum-F11", [1.412_3, 0.924_7, 0.531_4]),
        ("stdillum-F12", [1.768_7, 0.845_1, 0.270_7]),
    ] {
        rows.push(Row::new(name, seen_lamp(&format!("\"spectrum L\" \"{name}\"")), right).within(3e-3));
    }
    rows
}

/// A sun at the zenith whose irradiance is π.
const SUN: &str =
    "LightSource \"distant\" \"float scale\" 3.141592653589793 \"point3 from\" [0 0 1] \"point3 to\" [0 0 0]";

/// The floor below the middle of a ball of radius 1 at height 6, of radiance 1: ρ (r/d)².
fn below_ball(before: &str, place: &str) -> String {
    let ball = "AreaLightSource \"diffuse\"\nShape \"sphere\" \"float radius\" 1";
    let camera = "LookAt .01 .02 .5 0 0 0 .1 .7 .3";
    format!(
        "{camera} {before} Camera \"perspective\" \"float fov\" 1e-4\nWorldBegin\n{WHITE_FLOOR}AttributeBegin\n{place}\n{ball}\nAttributeEnd"
    )
}

/// Motion becomes a still at its start: transforms of its end change nothing.
fn motion() -> Vec<Row> {
    let right = grey(0.5 / 36.0);
    let end = |what: &str| format!("ActiveTransform EndTime {what} ActiveTransform All");
    let up = "Translate 0 0 6";
    [
        ("a camera that moves, and a world after it", below_ball("ActiveTransform EndTime Translate 0 0 1", up)),
        ("a camera that turns at its end", below_ball(&end("Rotate 20 0 1 0"), up)),
        ("an identity at the end", below_ball("", &format!("{up} {}", end("Identity Translate 0 0 7")))),
        (
            "a matrix at the end",
            below_ball("", &format!("{up} {}", end("Transform [2 0 0 0 0 2 0 0 0 0 2 0 9 9 9 1]"))),
        ),
        ("a system of coordinates at the end", below_ball("", &format!("{up} {}", end("LookAt 1 2 3 0 0 0 0 0 1")))),
        (
            "a block that begins at the end",
            below_ball("", &format!("{up} ActiveTransform EndTime AttributeBegin AttributeEnd ActiveTransform All")),
        ),
        ("the start alone", below_ball("", &format!("ActiveTransform StartTime {up} ActiveTransform All"))),
        (
            "an identity of the start",
            below_ball("", &format!("Translate 9 9 9 ActiveTransform StartTime Identity {up} ActiveTransform All")),
        ),
        ("times of motion", below_ball("TransformTimes 0 1", up)),
        ("a matrix with a weight", below_ball("", "ConcatTransform [2 0 0 0  0 2 0 0  0 0 2 0  0 0 12 2]")),
    ]
    .map(|(name, text)| Row::new(name, text, right).by(SOME))
    .into()
}

/// Parameters of `Attribute` are defaults of what follows, the newest first.
fn attributes() -> Vec<Row> {
    let under_sky = |text: &str| format!("{}{SUN}\n{text}\n{FLOOR}", look([0.1, 0.2, 5.0], [0.0; 3]));
    let of = "Attribute \"material\" \"rgb reflectance\" [.8 .8 .8]";
    let named = "MakeNamedMaterial \"m\" \"string type\" \"diffuse\"";
    let leaf = "Material \"diffusetransmission\" \"rgb reflectance\" [.5 .5 .5]";
    let texture = "Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [.6 .6 .6]";
    [
        ("Attribute and Material", under_sky(&format!("{of} Material \"diffuse\"")), 0.8),
        ("Attribute and MakeNamedMaterial", under_sky(&format!("{of} {named} NamedMaterial \"m\"")), 0.8),
        ("Attribute with a type", under_sky("Attribute \"material\" \"string type\" \"diffuse\" MakeNamedMaterial \"m\" \"rgb reflectance\" [.3 .3 .3] NamedMaterial \"m\""), 0.3),
        ("a newer Attribute", under_sky(&format!("{of} Attribute \"material\" \"rgb reflectance\" [.2 .2 .2] {named} NamedMaterial \"m\"")), 0.2),
        ("Attribute and what is given", under_sky(&format!("{of} {named} \"rgb reflectance\" [.4 .4 .4] NamedMaterial \"m\"")), 0.4),
        ("Attribute in a block that ended", under_sky(&format!("AttributeBegin {of} AttributeEnd {named} NamedMaterial \"m\"")), 0.5),
        ("Attribute and Texture", under_sky("Attribute \"texture\" \"rgb value\" [.7 .7 .7] Texture \"t\" \"spectrum\" \"constant\" Material \"diffuse\" \"texture reflectance\" \"t\""), 0.7),
        ("diffusetransmission, scaled", under_sky(&format!("{leaf} \"float scale\" .5")), 0.25),
        ("diffusetransmission without a scale", under_sky(leaf), 0.5),
        ("diffusetransmission without parameters", under_sky("Material \"diffusetransmission\""), 0.25),
        ("diffusetransmission of a texture, scaled", under_sky(&format!("{texture} Material \"diffusetransmission\" \"texture reflectance\" \"t\" \"float scale\" .5")), 0.3),
    ]
    .map(|(name, text, right)| Row::new(name, text, grey(right)).by(SOME))
    .into()
}

/// Mixtures reflect the shares of their materials, and lights have the material of the greater share.
fn mixtures() -> Vec<Row> {
    let grey_of = |name: &str, albedo: f64| {
        format!(
            "MakeNamedMaterial \"{name}\" \"string type\" \"diffuse\" \"rgb reflectance\" [{albedo} {albedo} {albedo}]\n"
        )
    };
    let known = format!(
        "{}{}{}MakeNamedMaterial \"none\" \"string type\" \"interface\"\n",
        grey_of("a", 0.8),
        grey_of("b", 0.2),
        grey_of("c", 0.5)
    );
    let mix = |one: &str, other: &str, amount: &str| {
        format!("Material \"mix\" \"string materials\" [\"{one}\" \"{other}\"] {amount}")
    };
    let half = "Texture \"t\" \"float\" \"checkerboard\" \"float uscale\" 3 \"float vscale\" 3 \"float tex1\" 0.25 \"float tex2\" .25";
    let inner =
        "MakeNamedMaterial \"m\" \"string type\" \"mix\" \"string materials\" [\"a\" \"b\"] \"float amount\" .5";
    [
        ("of a quarter", mix("a", "b", "\"float amount\" .25"), 0.65),
        ("without an amount", mix("a", "b", ""), 0.5),
        ("of nothing of the second", mix("a", "b", "\"float amount\" 0"), 0.8),
        ("of all of the second", mix("a", "b", "\"float amount\" 1"), 0.2),
        ("by a texture", format!("{half}\n{}", mix("a", "b", "\"texture amount\" \"t\"")), 0.65),
        ("of a mixture", format!("{inner}\n{}", mix("m", "c", "\"float amount\" .2")), 0.5),
        ("with a mixture", format!("{inner}\n{}", mix("a", "m", "\"float amount\" .4")), 0.68),
        ("with what is no surface", mix("none", "a", "\"float amount\" .25"), 0.2),
        ("with no surface below", mix("a", "none", "\"float amount\" .25"), 0.6),
    ]
    .map(|(name, material, right)| {
        // beside the edge between both triangles of the floor, each of which would have its chance there
        let text = format!("{}{SUN}\n{known}{material}\n{FLOOR}", look([0.1, 0.2, 5.0], [0.7, 0.1, 0.0]));
        Row::new(format!("a mixture {name}"), text, grey(right)).samples(1 << 16).within(1e-3).by(SOME)
    })
    .into()
}

/// Smooth glass lets straight through what it does not reflect: a lamp above a pane and the camera above both, all at normal incidence.
fn panes() -> Vec<Row> {
    let pane = |material: &str, height: f64| {
        format!(
            "Material {material}\nShape \"bilinearmesh\" \"point3 P\" [-800 -800 {height}  800 -800 {height}  -800 800 {height}  800 800 {height}]\n"
        )
    };
    let text = |panes: &str| format!("{}{SUN}\n{WHITE_FLOOR}{panes}", look([0.7, 0.1, 5.0], [0.7, 0.1, 0.0]));
    let once = |eta: f64| ((eta - 1.0) / (eta + 1.0)).powi(2);
    let thin = |eta: f64| 1.0 - 2.0 * once(eta) / (1.0 + once(eta));
    let (glass, other) = ("\"thindielectric\"", "\"thindielectric\" \"float eta\" 2");
    let solid = |eta: f64| format!("\"dielectric\" \"float eta\" {eta}");
    // the camera and the sun each pass all of them; the camera's rays also go back and forth between two
    let between = |one: f64, other: f64| 1.0 / (1.0 - (1.0 - one) * (1.0 - other)).sqrt();
    [
        ("a thin pane", text(&pane(glass, 2.0)), thin(1.5)),
        ("a thin pane of index 2", text(&pane(other, 2.0)), thin(2.0)),
        (
            "two thin panes",
            text(&format!("{}{}", pane(glass, 2.0), pane(other, 1.0))),
            thin(1.5) * thin(2.0) * between(thin(1.5), thin(2.0)),
        ),
        ("one side of a solid", text(&pane(&solid(1.5), 2.0)), 1.0 - once(1.5)),
        (
            "both sides of a solid",
            text(&format!("{}{}", pane(&solid(1.7), 2.0), pane(&solid(1.7), 1.0))),
            (1.0 - once(1.7)).powi(2) * between(1.0 - once(1.7), 1.0 - once(1.7)),
        ),
    ]
    .map(|(name, text, through)| {
        let right = grey(0.5 * through * through);
        Row::new(format!("a floor below {name}"), text, right).samples(1 << 16).within(1e-3).by(SOME)
    })
    .into()
}

/// Lamps of alpha 0 light the scene, and are neither seen nor in the way.
fn unseen() -> Vec<Row> {
    let eye = look([0.0, 0.0, 20.0], [0.0; 3]);
    let hidden = |place: &str, shape: &str, light: &str| {
        format!(
            "{eye}{WHITE_FLOOR}AttributeBegin {place} AreaLightSource \"diffuse\" {light} Shape {shape} \"float alpha\" 0 AttributeEnd"
        )
    };
    let square = "\"bilinearmesh\" \"point3 P\" [-.001 .001 2  .001 .001 2  -.001 -.001 2  .001 -.001 2]";
    let far =
        "AttributeBegin Translate 0 0 6 AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] Shape \"sphere\" AttributeEnd";
    let all = |row: Row| row.by(&Technique::ALL).samples(1 << 16);
    let ball = |radius: f64| 0.5 * (radius / 6.0).powi(2);
    vec![
        Row::new(
            "below an unseen ball, through it",
            hidden("Translate 0 0 6", "\"sphere\" \"float radius\" 2", ""),
            grey(ball(2.0)),
        )
        .by(SOME),
        all(Row::new(
            "below an unseen small ball, by all techniques",
            hidden("Translate 0 0 6", "\"sphere\" \"float radius\" .5", ""),
            grey(ball(0.5)),
        )),
        Row::new(
            "below an unseen square",
            hidden("", square, "\"rgb L\" [1e6 1e6 1e6]"),
            grey(0.5 / std::f64::consts::PI),
        )
        .within(1e-3)
        .by(SOME),
        Row::new(
            "an unseen lamp does not hide another",
            {
                let text = format!("{}\n{far}", hidden("Translate 0 0 3", "\"disk\"", ""));
                text.replace(&eye, &look([0.0, 0.0, 2.0], [0.0; 3]))
            },
            grey(ball(1.0)),
        )
        .by(SOME),
        Row::new("an unseen disk that shines up", hidden("Translate 0 0 3", "\"disk\"", ""), grey(0.0)),
        Row::new(
            "an unseen disk that shines down",
            hidden("Translate 0 0 3 Scale 1 1 -1", "\"disk\" \"float radius\" 2", ""),
            grey(0.5 * 4.0 / 13.0),
        )
        .by(SOME),
    ]
}

/// Files of other programs, with the same light as each of them has by its specification.
fn files() -> Vec<Row> {
    let sky = |name: &str| on_floor(&format!("LightSource \"infinite\" \"string filename\" \"{name}\""));
    let textured = |name: &str| {
        let texture = format!("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"{name}\"");
        let material = "Material \"diffuse\" \"texture reflectance\" \"t\"";
        let light = "LightSource \"point\" \"rgb I\" [10 10 10] \"point3 from\" [0 0 2]";
        format!("{}{texture}\n{material}\n{light}\n{FLOOR}", look([0.1, 0.2, 5.0], [0.0; 3]))
    };
    let mut rows = vec![
        Row::new("a sky that begins with #?RGBE", sky("rgbe.hdr"), [0.5, 0.25, 0.125]).within(5e-3).samples(1 << 16),
        Row::new("a texture of one channel Y", textured("grey.exr"), grey(0.3 * 2.5 / std::f64::consts::PI))
            .within(1e-3),
        Row::new(
            "a texture of one channel of another name",
            textured("height.exr"),
            grey(0.3 * 2.5 / std::f64::consts::PI),
        )
        .within(1e-3),
    ];
    for name in super::IES_KINDS {
        let light = format!(
            "AttributeBegin Translate 0 0 2 Rotate 90 1 0 0 LightSource \"goniometric\" \"string filename\" \"{name}.ies\" AttributeEnd"
        );
        // 100 cd downwards at a distance of 2
        rows.push(Row::new(format!("IES file: {name}"), on_floor(&light), reflected(grey(25.0))).within(1e-3));
    }
    for name in super::PLY_KINDS {
        let lamp = format!(
            "AttributeBegin Translate 0 0 2 AreaLightSource \"diffuse\" \"bool twosided\" true Shape \"plymesh\" \"string filename\" \"{name}.ply\" AttributeEnd"
        );
        let side: f64 = 1.0 / 2.0;
        let corner = 1.0 / (1.0 + side * side).sqrt();
        // form factor of a square of half side 1 at the distance 2 (Howell, B-3, four times a corner)
        let factor = 4.0 / std::f64::consts::PI * side * corner * (side * corner).atan();
        rows.push(
            Row::new(format!("PLY file: {name}"), on_floor(&lamp), grey(0.5 * factor))
                .by(SOME)
                .samples(4096)
                .within(1e-3),
        );
    }
    rows
}

/// Photometric types A and B: the floor below a lamp whose beam is downwards and whose right side is +x, by its angles.
fn floodlights() -> Vec<Row> {
    let mut rows = Vec::new();
    // 8 values at each of the angles -90, -30, 0, 60, 90, in both lists
    let angles = [-90.0, -30.0, 0.0, 60.0, 90.0];
    let value = |v: usize, h: usize| [10.0, 40.0, 100.0, 30.0, 5.0][v] * [2.0, 5.0, 9.0, 7.0, 1.0][h] / 9.0;
    let between = |angle: f64| {
        let i = (0..4).rev().find(|i| angles[*i] <= angle).unwrap_or(0);
        (i, (angle - angles[i]) / (angles[i + 1] - angles[i]))
    };
    for (kind, is_b) in [("a", false), ("b", true)] {
        for [x, y] in [[0.0, 0.0], [0.5, 0.0], [0.0, 0.7], [-1.2, 0.4], [2.5, -3.0]] {
            let (x, y): (f64, f64) = (x, y);
            let square = x * x + y * y + 4.0;
            let [right, up, beam] = [x, y, 2.0].map(|c| c / square.sqrt());
            let (v, h) = match is_b {
                true => (up.atan2(beam), right.asin()),
                false => (up.asin(), right.atan2(beam)),
            };
            let ((i, s), (j, t)) = (between(v.to_degrees()), between(h.to_degrees()));
            let at = |i: usize| value(i, j) * (1.0 - t) + value(i, j + 1) * t;
            let intensity = at(i) * (1.0 - s) + at(i + 1) * s;
            let light = format!(
                "AttributeBegin Translate {} {} 2 Rotate 90 1 0 0 LightSource \"goniometric\" \"string filename\" \"type-{kind}.ies\" AttributeEnd",
                -x, -y
            );
            let name = format!("IES file of type {kind} at {x}, {y}");
            rows.push(Row::new(name, on_floor(&light), reflected(grey(intensity * beam / square))).within(1e-4));
        }
    }
    // half a table is symmetric
    let symmetric = "AttributeBegin Translate .7 .3 2 Rotate 90 1 0 0 LightSource \"goniometric\" \"string filename\" \"half-b.ies\" AttributeEnd";
    let square: f64 = 0.49 + 0.09 + 4.0;
    let [right, up, beam] = [0.7, 0.3, 2.0].map(|c: f64| c / square.sqrt());
    let (v, h) = (up.atan2(beam).to_degrees(), right.asin().to_degrees());
    let intensity = 90.0 * (1.0 - v / 90.0) * (1.0 - h / 90.0);
    rows.push(
        Row::new("IES file of type b, symmetric", on_floor(symmetric), reflected(grey(intensity * beam / square)))
            .within(1e-4),
    );
    rows
}
