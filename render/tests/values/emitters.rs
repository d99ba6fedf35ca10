//! Diffuse area lights on shapes of every kind, seen from both sides and by what they light.

use super::place::{NamedTransform, all, similar};
use super::row::{ROUNDING, Row, grey, look, on_floor, reflected, times};
use etendue_oracle::tier::is_long;
use etendue_oracle::{V3, along, cross, dot, length, sub, unit};
use etendue_render::Technique;
use std::f64::consts::PI;

/// A shape: its text, and its surface in double precision.
struct Form {
    name: &'static str,
    text: &'static str,
    /// A point for (s, t) in [0, 1]², and the normal there on the side that emits.
    at: fn(f64, f64) -> (V3, V3),
    /// Where it is looked at.
    middle: [f64; 2],
    /// How far triangles that stand for it are off: the area of a polygon of n sides, as a fraction, or twice that for a sphere's.
    tolerance: f64,
}

fn round(s: f64, t: f64, turns: f64) -> V3 {
    let ((sin, cos), (r, z)) = ((turns * s * PI).sin_cos(), (t * PI).sin_cos());
    [r * cos, r * sin, -z]
}

const QUAD: &str = "\"point3 P\" [-1 -1 0 1 -1 0 1 1 0 -1 1 0] \"integer indices\" [0 1 2 0 2 3]";

/// The square of side 2 about the origin in the plane z = 0, which some forms share.
const SQUARE: Form = Form {
    name: "",
    text: "",
    at: |s, t| ([2.0 * s - 1.0, 2.0 * t - 1.0, 0.0], [0.0, 0.0, 1.0]),
    middle: [0.31, 0.57],
    tolerance: ROUNDING,
};

const FORMS: [Form; 11] = [
    Form {
        name: "trianglemesh",
        text: "Shape \"trianglemesh\" \"point3 P\" [-1 -1 0 1 -1 0 1 1 0 -1 1 0] \"integer indices\" [0 1 2 0 2 3]",
        ..SQUARE
    },
    // the order of corners is clockwise, but the normals tell the side
    Form {
        name: "trianglemesh with normals",
        text: "Shape \"trianglemesh\" \"normal N\" [0 0 1 0 0 1 0 0 1 0 0 1] \
               \"point3 P\" [-1 -1 0 1 -1 0 1 1 0 -1 1 0] \"integer indices\" [0 2 1 0 3 2]",
        ..SQUARE
    },
    Form { name: "bilinearmesh", text: "Shape \"bilinearmesh\" \"point3 P\" [-1 -1 0 1 -1 0 -1 1 0 1 1 0]", ..SQUARE },
    // rows of it are 3/2, and the next 1 long
    Form {
        name: "bilinearmesh that is a trapezium",
        text: "Shape \"bilinearmesh\" \"point3 P\" [-1.5 -1 0 1.5 -1 0 -1 1 0 1 1 0]",
        at: |s, t| ([(2.0 * s - 1.0) * (1.5 - 0.5 * t), 2.0 * t - 1.0, 0.0], [0.0, 0.0, 1.0]),
        middle: [0.31, 0.57],
        tolerance: 1e-3,
    },
    Form { name: "plymesh", text: "Shape \"plymesh\" \"string filename\" \"quad.ply\"", ..SQUARE },
    Form {
        name: "sphere",
        text: "Shape \"sphere\" \"float radius\" .8",
        at: |s, t| (times(round(s, t, 2.0), 0.8), round(s, t, 2.0)),
        middle: [0.13, 0.7],
        tolerance: 1e-2,
    },
    Form {
        name: "part of a sphere",
        text: "Shape \"sphere\" \"float radius\" 1 \"float zmin\" -.5 \"float zmax\" .7 \"float phimax\" 200",
        at: |s, t| {
            let (z, (sin, cos)) = (-0.5 + 1.2 * t, (200_f64.to_radians() * s).sin_cos());
            let r = (1.0 - z * z).sqrt();
            ([r * cos, r * sin, z], [r * cos, r * sin, z])
        },
        middle: [0.37, 0.6],
        tolerance: 1e-2,
    },
    Form {
        name: "disk",
        text: "Shape \"disk\" \"float radius\" 1.2 \"float height\" .5",
        at: |s, t| {
            let (sin, cos) = (2.0 * PI * s).sin_cos();
            ([1.2 * t * cos, 1.2 * t * sin, 0.5], [0.0, 0.0, 1.0])
        },
        middle: [0.1, 0.6],
        tolerance: 2e-3,
    },
    Form {
        name: "part of a ring",
        text: "Shape \"disk\" \"float radius\" 1.2 \"float innerradius\" .4 \"float phimax\" 90",
        at: |s, t| {
            let ((sin, cos), r) = ((0.5 * PI * s).sin_cos(), 0.4 + 0.8 * t);
            ([r * cos, r * sin, 0.0], [0.0, 0.0, 1.0])
        },
        middle: [0.6, 0.6],
        tolerance: 2e-3,
    },
    Form {
        name: "cylinder",
        text: "Shape \"cylinder\" \"float radius\" .7 \"float zmin\" -1 \"float zmax\" .5",
        at: |s, t| {
            let (sin, cos) = (2.0 * PI * s).sin_cos();
            ([0.7 * cos, 0.7 * sin, -1.0 + 1.5 * t], [cos, sin, 0.0])
        },
        middle: [0.13, 0.45],
        tolerance: 2e-3,
    },
    Form {
        name: "part of a cylinder",
        text: "Shape \"cylinder\" \"float radius\" 1 \"float zmin\" 0 \"float zmax\" 1 \"float phimax\" 120",
        at: |s, t| {
            let (sin, cos) = (120_f64.to_radians() * s).sin_cos();
            ([cos, sin, t], [cos, sin, 0.0])
        },
        middle: [0.4, 0.45],
        tolerance: 2e-3,
    },
];

/// Sums over midpoints of a grid: for each, the point and normal in the world, and the area.
fn sum(form: &Form, place: &NamedTransform, of: impl Fn(V3, V3, f64) -> f64) -> f64 {
    let (n, step) = (96, 1e-5);
    let mut total = 0.0;
    for (i, j) in (0..n).flat_map(|j| (0..n).map(move |i| (i, j))) {
        let [s, t] = [i, j].map(|k| (f64::from(k) + 0.5) / f64::from(n));
        let point = |s: f64, t: f64| place.point((form.at)(s, t).0);
        let [ds, dt] = [sub(point(s + step, t), point(s - step, t)), sub(point(s, t + step), point(s, t - step))];
        let area = length(cross(ds, dt)) / (4.0 * step * step * f64::from(n * n));
        total += of(point(s, t), place.normal((form.at)(s, t).1), area);
    }
    total
}

fn area(form: &Form, place: &NamedTransform) -> f64 {
    sum(form, place, |_, _, area| area)
}

/// Parameters, the radiance of the front for an area, and whether the back emits as well.
///
/// pbrt-v4: the radiance is L times the scale. A power is what leaves the sides that emit, and the scale multiplies it.
type Strength = (&'static str, fn(f64) -> V3, bool);

const STRENGTHS: [Strength; 7] = [
    ("", |_| grey(1.0), false),
    ("\"rgb L\" [1 2 4] \"float scale\" .5", |_| [0.5, 1.0, 2.0], false),
    ("\"rgb L\" [1 2 4] \"bool twosided\" true", |_| [1.0, 2.0, 4.0], true),
    ("\"float power\" 100", |area| grey(100.0 / (PI * area)), false),
    ("\"float power\" 100 \"bool twosided\" true", |area| grey(50.0 / (PI * area)), true),
    ("\"float power\" 100 \"float scale\" .1", |area| grey(10.0 / (PI * area)), false),
    (
        "\"rgb L\" [1 1 1] \"float power\" 100 \"float scale\" 3 \"bool twosided\" true",
        |area| grey(150.0 / (PI * area)),
        true,
    ),
];

pub(super) fn rows() -> Vec<Row> {
    [seen(), lit(), pictures(), disks(), others()].into_iter().flatten().collect()
}

/// What a camera sees of a lamp is what it emits, without what it reflects of its other parts.
const BLACK: &str = "Material \"diffuse\" \"rgb reflectance\" [0 0 0]";

/// The radiance of either side, as a camera sees it.
fn seen() -> Vec<Row> {
    let mut rows = Vec::new();
    let places = all(&NamedTransform::new().translate([0.5, 1.0, 2.0]));
    for (form, (k, place)) in FORMS.iter().flat_map(|form| places.iter().enumerate().map(move |place| (form, place))) {
        let area = area(form, place);
        let (point, normal) = (form.at)(form.middle[0], form.middle[1]);
        let (point, normal) = (place.point(point), place.normal(normal));
        // elsewhere, only sides and areas are others
        let strengths = if k == 0 || is_long() { &STRENGTHS[..] } else { &STRENGTHS[2..4] };
        for &(strength, radiance, two_sided) in strengths {
            for (reverse, side) in [("", 1.0), ("", -1.0), ("ReverseOrientation", 1.0), ("ReverseOrientation", -1.0)] {
                // those that are reversed differ only by the side
                if !reverse.is_empty() && strength.contains("scale") {
                    continue;
                }
                let is_front = (side > 0.0) == reverse.is_empty();
                let right = if is_front || two_sided { radiance(area) } else { grey(0.0) };
                let light = format!("{reverse} AreaLightSource \"diffuse\" {strength} {}", form.text);
                // from near, so that nothing is between, and obliquely
                let off = along([0.01, -0.02, 0.015], normal, 0.12 * side);
                let text = format!("{}{BLACK} {}", look(along(point, off, 1.0), point), place.holds(&light));
                let name = format!("{} {strength} {reverse}, {}, side {side}", form.name, place.name);
                let tolerance = if strength.contains("power") { form.tolerance } else { ROUNDING };
                rows.push(Row::new(name, text, right).within(tolerance));
            }
        }
    }
    rows
}

/// By each technique, and before a sky, of which it hides as much: a disk of radiance L that is seen under the angle θ from its axis causes the
/// irradiance πL sin²θ.
fn disks() -> Vec<Row> {
    let disk = |text: &str| {
        format!(
            "AreaLightSource \"diffuse\" {text} Translate 0 0 2 ReverseOrientation Shape \"disk\" \"float radius\" 2"
        )
    };
    let before_sky = format!("LightSource \"infinite\" \"rgb L\" [1 1 1] {}", disk("\"rgb L\" [5 5 5]"));
    vec![
        Row::new("a disk", on_floor(&disk("")), reflected(grey(0.5 * PI))).by(&Technique::ALL).samples(1 << 16),
        Row::new("a disk before a sky", on_floor(&before_sky), reflected(grey(3.0 * PI))).samples(1 << 16),
    ]
}

/// Irradiance of the floor at the origin by the front of a shape of radiance 1 above it that is convex, as seen from the front.
fn irradiance(form: &Form, place: &NamedTransform) -> f64 {
    sum(form, place, |p, n, area| {
        let (w, squared) = (unit(p), dot(p, p));
        w[2].max(0.0) * (-dot(n, w)).max(0.0) * area / squared
    })
}

/// What a shape lights; those that are open show their backs, which are dark.
fn lit() -> Vec<Row> {
    let mut rows = Vec::new();
    let base = NamedTransform::new().translate([0.4, 0.6, 7.0]).rotate(160.0, [1.0, 0.2, 0.1]);
    for (form, place) in FORMS.iter().flat_map(|form| all(&base).into_iter().map(move |place| (form, place))) {
        // what is beyond the rim of an open shape may hide its front
        if ["part of a sphere", "part of a cylinder"].contains(&form.name) {
            continue;
        }
        let (area, irradiance) = (area(form, &place), irradiance(form, &place));
        for strength in [STRENGTHS[1], STRENGTHS[5]] {
            let (text, radiance, _) = strength;
            let light = place.holds(&format!("AreaLightSource \"diffuse\" {text} {}", form.text));
            let right = reflected(times(radiance(area), irradiance));
            let name = format!("{} {text} {}, above a floor", form.name, place.name);
            // the sum over the grid is as good as its steps allow
            rows.push(Row::new(name, on_floor(&light), right).within(form.tolerance.max(3e-4)).samples(4096));
        }
    }
    rows
}

/// Pictures: pbrt's u goes to the right and v upwards, and texels are interpolated.
fn pictures() -> Vec<Row> {
    let mut rows = Vec::new();
    // texels from the top left, of quarters.exr; v = 1 is the top
    let texel = |u: f64, v: f64| [1.0, 2.0, 3.0, 4.0][usize::from(u > 0.5) + 2 * usize::from(v < 0.5)];
    let meshes = [
        format!("Shape \"trianglemesh\" {QUAD} \"point2 uv\" [0 0 1 0 1 1 0 1]"),
        "Shape \"bilinearmesh\" \"point3 P\" [-1 -1 0 1 -1 0 -1 1 0 1 1 0]".to_owned(),
    ];
    for (mesh, place) in meshes.iter().flat_map(|mesh| {
        all(&NamedTransform::new().translate([0.5, 1.0, 2.0])).into_iter().map(move |place| (mesh, place))
    }) {
        let area = area(&FORMS[0], &place);
        let strengths: [(&str, f64); 4] = [
            ("", 1.0),
            ("\"float scale\" 3", 3.0),
            ("\"float power\" 100", 100.0 / (PI * area * 2.5)),
            ("\"float power\" 100 \"float scale\" .1", 10.0 / (PI * area * 2.5)),
        ];
        for (text, factor) in strengths {
            for (u, v) in [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)] {
                // a little off the middle of a texel, and of the diagonal
                let point = place.point([2.0 * u - 1.0 + 1e-4, 2.0 * v - 1.0, 0.0]);
                let eye = along(point, place.normal([0.0, 0.0, 1.0]), 0.1);
                let light = format!("AreaLightSource \"diffuse\" \"string filename\" \"quarters.exr\" {text} {mesh}");
                let name = format!("picture {text} at {u}, {v} on {}, {}", &mesh[7..16], place.name);
                let right = grey(factor * texel(u, v));
                rows.push(Row::new(name, format!("{}{}", look(eye, point), place.holds(&light)), right).within(1e-3));
            }
        }
    }
    // on what triangles stand for, u goes around and v along the axis, and the power is by the mean over the area
    let curved = FORMS.iter().filter(|form| form.name.ends_with("cylinder"));
    for (form, place) in
        curved.flat_map(|form| similar(&NamedTransform::new()).into_iter().map(move |place| (form, place)))
    {
        let factor = 100.0 / (PI * area(form, &place) * 2.5);
        for (u, v) in [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)] {
            // a little beside an edge of triangles
            let (point, normal) = (form.at)(u + 2e-3, v);
            let (point, normal) = (place.point(point), place.normal(normal));
            let light = format!(
                "AreaLightSource \"diffuse\" \"string filename\" \"quarters.exr\" \"float power\" 100 {}",
                form.text
            );
            let text = format!("{}{}", look(along(point, normal, 0.1), point), place.holds(&light));
            let name = format!("picture at {u}, {v} on {}, {}", form.name, place.name);
            rows.push(Row::new(name, text, grey(factor * texel(u, v))).within(1e-2));
        }
    }
    // a sphere: u by the angle from +x to +y, v from the south to the north; a row of the lowest texels is 3 and 4
    for (degrees, north, value) in [(90.0, 1.0, 1.0), (270.0, 1.0, 2.0), (90.0, -1.0, 3.0), (270.0, -1.0, 4.0)] {
        let ((sin, cos), r) = (f64::to_radians(degrees).sin_cos(), 0.5_f64.sqrt());
        let point = [r * cos, r * sin, r * north];
        let light = "AreaLightSource \"diffuse\" \"string filename\" \"quarters.exr\" Shape \"sphere\"";
        let text = format!("{}{light}", look(times(point, 1.1), point));
        rows.push(Row::new(format!("picture on a sphere at {degrees}"), text, grey(value)).within(1e-3));
    }
    rows
}

/// Closed forms of some that light a floor.
fn others() -> Vec<Row> {
    let quad = |z: f64, half: f64| {
        format!(
            "Shape \"trianglemesh\" \"point3 P\" [-{half} -{half} {z} -{half} {half} {z} {half} {half} {z} {half} -{half} {z}] \"integer indices\" [0 1 2 0 2 3]"
        )
    };
    // a square seen from below its middle
    let square = |half: f64, z: f64| {
        let (a, b) = (half / z, (1.0 + (half / z).powi(2)).sqrt());
        4.0 * a / b * (a / b).atan()
    };
    let area = "AreaLightSource \"diffuse\"";
    let lamp = |text: &str, shape: &str| format!("AttributeBegin {area} {text} {shape} AttributeEnd\n");
    let disk = "AttributeBegin Translate 0 0 6 Scale 2 2 2 AreaLightSource \"diffuse\" \"float power\" 100 ReverseOrientation \
                Shape \"disk\" \"float radius\" 1 AttributeEnd";
    let sky = format!("{}LightSource \"infinite\" \"rgb L\" [1 1 1]", lamp("\"rgb L\" [5 5 5]", &quad(2.0, 0.5)));
    let ball = |r: f64, p: V3| {
        format!(
            "AttributeBegin Translate {} {} {} {area} Shape \"sphere\" \"float radius\" {r} AttributeEnd",
            p[0], p[1], p[2]
        )
    };
    let of_ball = |r: f64, p: V3| PI * r * r * p[2] / length(p).powi(3);
    // what a camera before a face with these normals sees; a distant light of irradiance π from above
    let normals = "LightSource \"distant\" \"point3 from\" [0 1 0] \"point3 to\" [0 0 0] \"rgb L\" [3.14159265 3.14159265 3.14159265] \
                   Material \"diffuse\" \"rgb reflectance\" [1 1 1] Shape \"trianglemesh\" \"integer indices\" [0 1 2] \
                   \"point3 P\" [-1 0 0 1 0 0 0 0 2] \"normal N\" [-.9805807 .1961161 0 .9805807 .1961161 0 0 1 0]";
    let both = "Material \"diffuse\" \"rgb reflectance\" [.7 .7 .7] AreaLightSource \"diffuse\" \"bool twosided\" true \
                Shape \"sphere\" \"float radius\" .7";
    let object = "ObjectBegin \"o\" AreaLightSource \"diffuse\" Shape \"disk\" ObjectEnd ObjectInstance \"o\"";
    let hidden = format!(
        "{area} Shape \"trianglemesh\" \"float alpha\" 0 {}",
        quad(2.0, 0.5).replace("Shape \"trianglemesh\"", "")
    );
    let inside =
        "AttributeBegin Scale -10 10 10 AreaLightSource \"diffuse\" ReverseOrientation Shape \"sphere\" AttributeEnd";
    vec![
        Row::new("a square", on_floor(&lamp("", &quad(2.0, 0.5))), reflected(grey(square(0.5, 2.0)))),
        Row::new(
            "a square of watts",
            on_floor(&lamp("\"float power\" 9", &quad(3.0, 1.0))),
            reflected(grey(9.0 / (4.0 * PI) * square(1.0, 3.0))),
        ),
        Row::new("a disk of watts", on_floor(disk), reflected(grey(100.0 / (PI * 4.0 * PI) * PI * 4.0 / 40.0)))
            .samples(1 << 16),
        // the square hides what it hides of the sky
        Row::new("a square before a sky", on_floor(&sky), reflected(grey(PI + 4.0 * square(0.5, 2.0))))
            .samples(1 << 16),
        Row::new("a ball", on_floor(&ball(0.5, [1.0, 2.0, 3.0])), reflected(grey(of_ball(0.5, [1.0, 2.0, 3.0])))),
        Row::new("a ball near", on_floor(&ball(0.9, [0.0, 0.6, 1.5])), reflected(grey(of_ball(0.9, [0.0, 0.6, 1.5])))),
        Row::new("within a mirrored ball", on_floor(inside), reflected(grey(PI))).within(2e-2).samples(4096),
        Row::new(
            "normals that are far apart",
            format!("{}{normals}", look([0.1, 3.0, 0.3], [0.0, 0.0, 0.3])),
            grey(1.0),
        ),
        Row::new(
            "a ball of two sides, from outside",
            format!("{}{both}", look([2.0, 1.0, 0.5], [0.5, 0.1, 0.45])),
            grey(1.0),
        ),
        Row::new("a lamp in an object", format!("{}{object}", look([0.1, 0.2, 1.0], [0.1, 0.1, 0.0])), grey(0.0)),
        Row::new("below a lamp of alpha 0", on_floor(&hidden), reflected(grey(square(0.5, 2.0)))),
        Row::new("a lamp of alpha 0", format!("{}{hidden}", look([0.1, 0.2, 1.0], [0.1, 0.2, 2.0])), grey(0.0)),
        Row::new(
            "a hundred times smaller",
            on_floor(&lamp("", &quad(0.2, 0.002))),
            reflected(grey(square(0.002, 0.2))),
        )
        .within(1e-3),
    ]
}
