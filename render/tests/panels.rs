//! Lights with a spread, a profile or a picture, by every technique, against sums over the lights in double
//! precision.

use crate::kit::{BLACK, Folder, PLANE, list, narrow, nearly, world};
use etendue_oracle::tier::cases;
use etendue_oracle::{V3, along, cross, dot, unit};
use std::f64::consts::PI;

/// A cell of a light: a point, its area times the unit normal of the front, and its coordinates.
type Cell = (V3, V3, [f64; 2]);

/// A parallelogram that emits on the side of the cross product of its edges.
#[derive(Clone, Copy)]
struct Panel<'a> {
    corner: V3,
    edges: [V3; 2],
    /// Whether it is two triangles.
    is_cut: bool,
    /// More parameters.
    more: &'a str,
}

impl Panel<'_> {
    const fn new(corner: V3, edges: [V3; 2]) -> Self {
        Self { corner, edges, is_cut: false, more: "" }
    }
    const fn cut(self) -> Self {
        Self { is_cut: true, ..self }
    }
    fn at(&self, [s, t]: [f64; 2]) -> V3 {
        along(along(self.corner, self.edges[0], s), self.edges[1], t)
    }
    /// The shape alone.
    fn text(&self) -> String {
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|st| self.at(st));
        let kind = if self.is_cut { "\"trianglemesh\" \"integer indices\" [0 1 2 1 3 2]" } else { "\"bilinearmesh\"" };
        format!("Shape {kind} \"point3 P\" [{}] {}\n", list(&corners), self.more)
    }
    /// The shape as a light.
    fn lamp(&self, light: &str) -> String {
        format!("AttributeBegin {BLACK} AreaLightSource \"diffuse\" {light} {} AttributeEnd\n", self.text())
    }
    fn cells(self, n: u32) -> impl Iterator<Item = Cell> {
        let area = cross(self.edges[0], self.edges[1]).map(|x| x / f64::from(n * n));
        (0..n * n).map(move |k| {
            let st = [k % n, k / n].map(|k| (f64::from(k) + 0.5) / f64::from(n));
            (self.at(st), area, st)
        })
    }
}

/// Cells of a sphere whose pole is its own +z, in these axes.
fn ball(center: V3, radius: f64, [x, y, z]: [V3; 3], n: u32) -> impl Iterator<Item = Cell> {
    (0..n * n).map(move |k| {
        let [u, v] = [k % n, k / n].map(|k| (f64::from(k) + 0.5) / f64::from(n));
        let ((sin, cos), (slope, height)) = ((2.0 * PI * u).sin_cos(), (PI * (1.0 - v)).sin_cos());
        let normal: V3 = std::array::from_fn(|k| slope * (cos * x[k] + sin * y[k]) + height * z[k]);
        let area = radius * radius * slope * 2.0 * PI * PI / f64::from(n * n);
        (along(center, normal, radius), normal.map(|x| x * area), [u, v])
    })
}

/// Irradiance at the origin of the plane y = 0 with this normal by the front of cells, or both sides, whose radiance depends on the direction
/// towards them and on their coordinates.
fn irradiance(
    cells: impl Iterator<Item = Cell>,
    normal: V3,
    two_sided: bool,
    radiance: impl Fn(V3, [f64; 2]) -> V3,
) -> V3 {
    let mut sum = [0.0; 3];
    for (p, area, st) in cells.filter(|(p, ..)| p[1] > 0.0) {
        let (w, facing) = (unit(p), -dot(unit(p), area));
        let facing = if two_sided { facing.abs() } else { facing.max(0.0) };
        sum = along(sum, radiance(w, st), dot(w, normal).max(0.0) * facing / dot(p, p));
    }
    sum
}

const UP: V3 = [0.0, 1.0, 0.0];
/// A point light above the origin, and its irradiance.
const LAMP: &str = "LightSource \"point\" \"point3 from\" [0 .5 0] \"float scale\" .25";

fn grey(value: f64) -> V3 {
    [value; 3]
}

/// Panels with a spread: where a point sees all of the cone, the irradiance is πL whatever the spread is; else that of a sum over the panel,
/// also among other lights, and of many.
#[test]
fn spreads_narrow_panels() {
    let spread = |degrees: f64| format!("\"rgb L\" [2 2 2] \"float spread\" {degrees}");
    // the tangent of the angle to the normal of a level panel tells its radiance
    let emitted = |degrees: f64| {
        let half = 0.5 * degrees.to_radians();
        move |w: V3, _: [f64; 2]| grey(2.0 * (half.tan() - w[0].hypot(w[2]) / w[1]).max(0.0) / (half.tan() - half))
    };
    let shows = |lights: &str, truth: V3, what: &str| {
        nearly(&world(&narrow("1 .3 2", &format!("{PLANE}{lights}"))), truth, 3e-5, 1 << 14, what);
    };
    let big = Panel::new([-3.0, 1.0, -3.0], [[6.0, 0.0, 0.0], [0.0, 0.0, 6.0]]);
    for degrees in [30.0, 90.0, 140.0] {
        shows(&big.lamp(&spread(degrees)), grey(2.0 * PI), "a large panel");
    }
    shows(&big.cut().lamp(&spread(90.0)), grey(2.0 * PI), "two triangles");
    let skewed = Panel::new([0.2, 1.0, -1.0], [[1.8, 0.0, 0.0], [0.4, 0.0, 1.5]]);
    let truth = irradiance(skewed.cells(1000), UP, false, emitted(100.0));
    shows(&skewed.lamp(&spread(100.0)), truth, "an edge cuts the cone");
    shows(&format!("{}{LAMP}", skewed.lamp(&spread(100.0))), along(truth, grey(1.0), 1.0), "beside a lamp");
    let small = |i: u32| {
        let corner = [f64::from(i % 7) * 0.4 - 1.2, 1.0, f64::from(i / 7) * 0.4 - 1.2];
        Panel::new(corner, [[0.1, 0.0, 0.0], [0.0, 0.0, 0.1]])
    };
    let many: String = (0..49).map(|i| small(i).lamp(&spread(60.0))).collect();
    let truth = irradiance((0..49).flat_map(|i| small(i).cells(100)), UP, false, emitted(60.0));
    nearly(&world(&narrow("1 .5 2", &format!("{PLANE}{many}"))), truth, 3e-5, 1 << 15, "many panels");
}

/// Cosine of the angle to the normal from which on intensities fall.
fn least() -> f64 {
    85_f64.to_radians().cos()
}

/// An intensity by the angle to the normal and the turn about it, in degrees.
type Intensity = fn(f64, f64) -> f64;

/// π over the sum of the intensity over the hemisphere, with the fall next to its plane.
fn gain(intensity: Intensity) -> f64 {
    let (rows, columns) = (1200, 180);
    let mut flux = 0.0;
    for (i, j) in (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j))) {
        let theta = (f64::from(i) + 0.5) / f64::from(rows) * PI / 2.0;
        let turn = (f64::from(j) + 0.5) / f64::from(columns) * 360.0;
        flux += intensity(theta.to_degrees(), turn) * (theta.cos() / least()).min(1.0) * theta.sin();
    }
    // steps of ½π/rows and 2π/columns
    f64::from(rows * columns) / (flux * PI)
}

/// The radiance of a level panel with this profile. It hangs with its photometric horizontal at +x, and angles run from there to +z.
fn profiled(intensity: Intensity) -> impl Fn(V3, [f64; 2]) -> V3 {
    let gain = gain(intensity);
    move |w, _| {
        let (theta, turn) = (w[1].min(1.0).acos().to_degrees(), (-w[2]).atan2(-w[0]).to_degrees().rem_euclid(360.0));
        grey(2.0 * gain * intensity(theta, turn) / w[1].max(least()))
    }
}

/// Panels with profiles: a wide one, one that differs around the axis, a beam so narrow that points see a part of the panel, and half of an
/// image; of one parallelogram and of two triangles, alone, among other lights, of many, and of two sides.
#[test]
fn profiles_change_panels() {
    let folder = Folder::new();
    folder.ies("wide.ies", "0 90", "0", "1 3");
    folder.ies("skew.ies", "0 90", "0 180", "2 1 2 5");
    folder.ies("beam.ies", "0 15 30", "0", "4 1 0");
    // longitude and latitude, of which the lower row is towards the nadir: dark at half of the azimuths, from +x over +z
    folder.picture("half.exr", [4, 2], |x, y| [if y == 1 && x < 2 { 3.0 } else { 0.0 }; 3]);
    // three quarters of the intensity go up, to where the normal is not
    folder.ies("both.ies", "0 89.999 90.001 180", "0", "1 1 3 3");
    let skew: Intensity = |theta, turn| {
        let side = 1.0 + 4.0 * turn.min(360.0 - turn) / 180.0;
        2.0 + (side - 2.0) * theta / 90.0
    };
    let beam: Intensity = |theta, _| if theta < 15.0 { 4.0 - 0.2 * theta } else { (2.0 - theta / 15.0).max(0.0) };
    let level = |corner: V3, [a, b]: [f64; 2]| Panel::new(corner, [[a, 0.0, 0.0], [0.0, 0.0, b]]);
    let panels = [
        level([-0.4, 0.8, -0.2], [1.0, 0.7]),
        level([0.0, 0.9, -0.5], [0.5, 0.6]).cut(),
        level([-2.0, 1.0, -1.5], [4.0, 3.0]),
    ];
    let small = |i: u32| level([f64::from(i % 8) * 0.2 - 0.9, 1.0, f64::from(i / 8) * 0.2 - 0.4], [0.1, 0.15]);
    let shows = |lights: &str, truth: V3, what: &str| {
        nearly(&folder.world(&narrow("1 .3 2", &format!("{PLANE}{lights}"))), truth, 1e-4, 1 << 14, what);
    };
    let profiles: [(&str, Intensity); 3] =
        [("wide", |theta, _| 1.0 + 2.0 * theta / 90.0), ("skew", skew), ("beam", beam)];
    for (name, intensity) in profiles {
        let radiance = profiled(intensity);
        let light = format!("\"rgb L\" [2 2 2] \"string profile\" \"{name}.ies\"");
        let truth = panels.map(|panel| irradiance(panel.cells(600), UP, false, &radiance));
        for (panel, truth) in panels.iter().zip(truth) {
            shows(&panel.lamp(&light), truth, name);
        }
        shows(&format!("{}{LAMP}", panels[0].lamp(&light)), along(truth[0], grey(1.0), 1.0), name);
        let many: String = (0..40).map(|i| small(i).lamp(&light)).collect();
        shows(&many, irradiance((0..40).flat_map(|i| small(i).cells(100)), UP, false, &radiance), name);
    }
    for (file, more, intensity, share) in [
        ("half.exr", "", (|_, turn| if turn < 180.0 { 1.0 } else { 0.0 }) as Intensity, 1.0),
        ("both.ies", "\"bool twosided\" true", |_, _| 1.0, 0.5),
    ] {
        let light = format!("\"rgb L\" [2 2 2] \"string profile\" \"{file}\" {more}");
        let truth = irradiance(panels[0].cells(600), UP, false, profiled(intensity));
        shows(&panels[0].lamp(&light), truth.map(|x| x * share), file);
    }
}

const SIZE: [usize; 2] = [16, 9];

/// A picture whose left part is dark, with few bright texels: red at the top, green in a corner, and blue everywhere on the right.
fn texel(x: i64, y: i64) -> [f32; 3] {
    let (x, y) = (x.clamp(0, SIZE[0] as i64 - 1), y.clamp(0, SIZE[1] as i64 - 1));
    let red = if y == 1 && x >= 6 { 20.0 } else { 0.0 };
    let green = if x == 15 && y == 8 { 100.0 } else { 0.0 };
    [red, green, if x > 6 { 0.5 + (x * y % 5) as f32 } else { 0.0 }]
}

/// What pbrt shows at texture coordinates: the first row at v = 1, texels interpolated, the outermost ones continued.
fn shown([u, v]: [f64; 2]) -> V3 {
    let (x, y) = (u * SIZE[0] as f64 - 0.5, (1.0 - v) * SIZE[1] as f64 - 0.5);
    let (column, row) = (x.floor(), y.floor());
    let mut sum = [0.0; 3];
    for (i, j) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
        let weight = |at: f64, low: f64, k: i64| if k == 0 { 1.0 - (at - low) } else { at - low };
        let texel = texel(column as i64 + i, row as i64 + j).map(f64::from);
        sum = along(sum, texel, weight(x, column, i) * weight(y, row, j));
    }
    sum
}

/// Pictures on panels that are near, far, at a grazing angle and partly below the horizon, in triangles with coordinates of their own, behind
/// occluders that hide more of the picture's light than of its area, or less, among other lights, and on spheres.
#[test]
fn pictures_shine_as_they_look() {
    let folder = Folder::new();
    folder.picture("p.exr", SIZE, |x, y| texel(x as i64, y as i64));
    let picture = "\"string filename\" \"p.exr\"";
    let two_sided = format!("{picture} \"bool twosided\" true");
    let sum = |panel: Panel<'_>, n: u32, two_sided: bool| irradiance(panel.cells(n), UP, two_sided, |_, st| shown(st));
    let near = Panel::new([-1.6, 0.5, -0.7], [[1.5, 0.1, 0.0], [0.1, 0.3, 1.25]]);
    let far = Panel::new([30.0, 50.0, 20.0], [[1.0, 0.25, 0.0], [0.0, -0.5, 1.0]]);
    let grazing = Panel::new([-2.0, -0.7, 1.0], [[2.0, 0.0, -1.8], [0.0, 1.5, 0.2]]);
    let mapped = Panel {
        more: "\"point2 uv\" [.3 .2  1.1 .1  .5 1  1.3 .9]",
        ..Panel::new([-1.5, 1.5, -1.0], [[1.2, 0.0, 0.2], [0.0, 0.3, 1.5]]).cut()
    };
    let uv = |[s, t]: [f64; 2]| [0.3 + 0.8 * s + 0.2 * t, 0.2 - 0.1 * s + 0.8 * t];
    let mut rows = vec![
        ("near", near.lamp(picture), sum(near, 900, false)),
        ("far", far.lamp(&two_sided), sum(far, 300, true)),
        ("grazing", grazing.lamp(&two_sided), sum(grazing, 1200, true)),
        ("triangles", mapped.lamp(picture), irradiance(mapped.cells(900), UP, false, |_, st| shown(uv(st)))),
    ];
    // the camera's ray passes behind the occluder
    let hidden = Panel::new([-1.5, 7.5, -1.8], [[3.0, 0.0, 0.0], [0.0, 0.0, 2.0]]);
    for (name, [from, to]) in [("left hidden", [-4.0, 0.03]), ("right hidden", [0.03, 4.0])] {
        let occluder = Panel::new([from, 1.0, -3.0], [[to - from, 0.0, 0.0], [0.0, 0.0, 3.2]]);
        let visible = hidden.cells(900).filter(|([x, y, _], ..)| !(from..to).contains(&(x / y)));
        let truth = irradiance(visible, UP, true, |_, st| shown(st));
        rows.push((name, format!("{}{}", occluder.text(), hidden.lamp(&two_sided)), truth));
    }
    let plain = Panel { corner: [-1.0, 3.0, 1.0], ..near };
    let (raised, other) =
        (Panel { corner: [-1.6, 1.5, -0.7], ..near }, Panel::new([1.0, 2.0, -2.0], [[1.0, 0.5, 0.0], [0.0, 0.0, 1.0]]));
    let lights = format!("{}{}{}", raised.lamp(picture), plain.lamp("\"rgb L\" [1 2 3]"), other.lamp(picture));
    let truth = along(sum(raised, 900, false), sum(other, 600, false), 1.0);
    let even = irradiance(plain.cells(300), UP, false, |_, _| [1.0, 2.0, 3.0]);
    rows.push(("several", lights, along(truth, even, 1.0)));
    // with its lower or its upper pole down
    for (name, turn, y, z) in [("south", -90, [0.0, 0.0, -1.0], UP), ("north", 90, [0.0, 0.0, 1.0], [0.0, -1.0, 0.0])] {
        let place = format!("{BLACK} Translate -1.2 1.4 .3 Rotate {turn} 1 0 0 AreaLightSource \"diffuse\" {picture}");
        let light = format!("AttributeBegin {place} Shape \"sphere\" \"float radius\" .7 AttributeEnd");
        let cells = ball([-1.2, 1.4, 0.3], 0.7, [[1.0, 0.0, 0.0], y, z], 1500);
        rows.push((name, light, irradiance(cells, UP, false, |_, st| shown(st))));
    }
    for (name, lights, truth) in rows {
        let world = folder.world(&narrow("1 5 2", &format!("{PLANE}{lights}")));
        // the irradiance of a picture is that of its means
        nearly(&world, truth, 4e-4, cases(1 << 14, 1 << 17), name);
    }
}
