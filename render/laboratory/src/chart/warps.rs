//! Measures each warp on its own: time per sample at each width, and the greatest error in single precision.

use super::charts::Figure;
use super::plot::{Bar, Chart, Dot, Line, PALETTE, Scale, escape, short};
use super::stats::Estimate;
use crate::cost::{self, Rounds};
use etendue::light::shapes::{
    ProjectedCap, SphericalCap, SphericalParallelogram, SphericalRectangle, SphericalTriangle,
};
use etendue::sequence::{Independent, Sequence};
use etendue::warp::{
    AreaTriangle, Bilinear, ConcentricDisk, Cone, CosineHemisphere, GgxVisibleNormals, LowDistortionTriangle,
    PolarDisk, UniformHemisphere, UniformSphere, Warp,
};
use etendue::{Real, Uint, Vec2, Vec3, f32x4, f32x8};
use etendue_oracle::{Greatest, length, sub};
use std::fmt::Write;
use std::hint::black_box;
use std::sync::atomic::{AtomicBool, Ordering};

/// Samples in a batch, whose `u` and points fit into the L1 cache.
const SAMPLES: usize = 1024;
/// Number of interleaved rounds.
const ROUNDS: usize = 41;
/// Batches that are timed together.
const BATCHES: u32 = 4;
/// Number of random points at which errors are measured.
const PLACES: u32 = 1 << 18;

/// One warp with its parameters.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Name, such as `spherical triangle, a thousandth`.
    pub name: String,
    /// Nanoseconds per sample with f32, f32x4 and f32x8: means over medians of groups of rounds.
    pub nanoseconds: [Estimate; 3],
    /// Greatest distance of a point or unit direction in f32 from that of the f64 instance, and its `u`.
    pub point: Greatest<[f64; 2]>,
    /// Greatest relative error of a pdf in f32, compared with the f64 instance, and its `u`.
    pub density: Greatest<[f64; 2]>,
}

/// Conversion between points and numbers.
trait Coordinates<R: Real> {
    fn numbers(&self, lane: usize) -> [f64; 3];
    fn of(numbers: [f64; 3]) -> Self;
}

impl<R: Real> Coordinates<R> for Vec2<R> {
    fn numbers(&self, lane: usize) -> [f64; 3] {
        [self.x.lane_f64(lane), self.y.lane_f64(lane), 0.0]
    }
    fn of([x, y, _]: [f64; 3]) -> Self {
        Self::new(R::lit(x), R::lit(y))
    }
}

impl<R: Real> Coordinates<R> for Vec3<R> {
    fn numbers(&self, lane: usize) -> [f64; 3] {
        [self.x, self.y, self.z].map(|v| v.lane_f64(lane))
    }
    fn of([x, y, z]: [f64; 3]) -> Self {
        Self::new(R::lit(x), R::lit(y), R::lit(z))
    }
}

/// Random points of the unit square, from index `first`.
fn square<R: Real>(first: u32) -> Vec2<R> {
    Independent::new(3).pair(R::Uint::splat(0), R::Uint::from_fn(|lane| first + lane as u32), 0)
}

/// Greatest errors of a point and of a pdf.
type Errors = [Greatest<[f64; 2]>; 2];

fn errors<W, V>(single: &W, double: &V) -> Errors
where
    W: Warp<f32x8>,
    V: Warp<f64>,
    W::Point: Coordinates<f32x8> + Copy,
    V::Point: Coordinates<f64> + Copy,
{
    let [mut point, mut density] = [Greatest::NONE; 2];
    for first in (0..PLACES).step_by(8) {
        let u = square::<f32x8>(first);
        let found = single.sample(u);
        let pdf = single.pdf(found);
        for lane in 0..8 {
            let u = [u.x.lane_f64(lane), u.y.lane_f64(lane)];
            let truth = double.sample(Vec2::new(u[0], u[1])).numbers(0);
            let at = found.numbers(lane);
            point.take(length(sub(at, truth)), u);
            // the pdf at the rounded point itself, unless that is outside the shape
            let known = double.pdf(V::Point::of(at));
            if known > 0.0 {
                density.take((pdf.lane_f64(lane) / known - 1.0).abs(), u);
            }
        }
    }
    [point, density]
}

/// Draws [`SAMPLES`] samples.
type Routine = Box<dyn FnMut()>;

fn routine<R: Real + 'static, T>(sample: impl Fn(Vec2<R>) -> T + 'static) -> Routine {
    let squares: Vec<Vec2<R>> = (0..SAMPLES / R::LANES)
        .map(|k| Independent::new(1).pair(R::Uint::splat(0), R::Uint::from_fn(|lane| (k * R::LANES + lane) as u32), 0))
        .collect();
    Box::new(move || {
        for &u in &squares {
            black_box(sample(u));
        }
    })
}

struct Entry {
    name: String,
    routines: [Routine; 3],
    errors: Errors,
}

/// Adds a warp that is prepared once. Its expression is evaluated at each width, for which `R` stands.
macro_rules! warp {
    ($list:ident, $name:expr, $R:ident => $make:expr) => {{
        macro_rules! at {
            ($width:ty) => {{
                // unused by warps without parameters
                #[allow(dead_code)]
                type $R = $width;
                $make
            }};
        }
        macro_rules! timed {
            ($width:ty) => {{
                let warp = at!($width);
                routine::<$width, _>(move |u| warp.sample(u))
            }};
        }
        $list.push(Entry {
            name: $name.to_owned(),
            routines: [timed!(f32), timed!(f32x4), timed!(f32x8)],
            errors: errors(&at!(f32x8), &at!(f64)),
        });
    }};
}

/// Also adds the warp prepared anew for every sample, as a renderer does for every shading point. Its parameters pass through a
/// `black_box` each time.
macro_rules! prepared {
    ($list:ident, $name:expr, $R:ident => $make:expr) => {{
        warp!($list, $name, $R => $make);
        let errors = $list.last().map_or([Greatest::NONE; 2], |e| e.errors);
        macro_rules! timed {
            ($width:ty) => {
                routine::<$width, _>(move |u| {
                    type $R = $width;
                    $make.sample(u)
                })
            };
        }
        $list.push(Entry {
            name: format!("{}, prepared per sample", $name),
            routines: [timed!(f32), timed!(f32x4), timed!(f32x8)],
            errors,
        });
    }};
}

fn vector<R: Real>(v: [f64; 3]) -> Vec3<R> {
    // rounded to f32, so that both precisions get the same shape
    let [x, y, z] = v.map(|x| R::lit(f64::from(x as f32)));
    black_box(Vec3::new(x, y, z))
}

fn number<R: Real>(x: f64) -> R {
    black_box(R::lit(f64::from(x as f32)))
}

fn entries() -> Vec<Entry> {
    let mut list = Vec::new();
    warp!(list, "concentric disk", R => ConcentricDisk);
    warp!(list, "polar disk", R => PolarDisk);
    warp!(list, "uniform hemisphere", R => UniformHemisphere);
    warp!(list, "uniform sphere", R => UniformSphere);
    warp!(list, "cosine hemisphere", R => CosineHemisphere);
    warp!(list, "cone, 1−cos 0.1", R => Cone { one_minus_cos: number::<R>(0.1) });
    warp!(list, "cone, 1−cos 1e-8", R => Cone { one_minus_cos: number::<R>(1e-8) });
    warp!(list, "area triangle", R => AreaTriangle);
    warp!(list, "low-distortion triangle", R => LowDistortionTriangle);
    warp!(list, "bilinear", R => Bilinear { corners: [1.0, 2.0, 0.5, 4.0].map(number::<R>) });
    warp!(list, "GGX visible normals", R => GgxVisibleNormals::new(number::<R>(0.4), number(0.2), vector([0.6, 0.0, 0.8])));
    for (name, scale) in [("", 1.0), (", a thousandth", 1e-3)] {
        // radii of 0.2 and 2e-4 times the distance
        let radius = 0.2 * scale;
        prepared!(list, format!("spherical cap{name}"), R => SphericalCap::new(vector([0.6, 0.0, 0.8]), number::<R>(radius)));
        let edges = [[1.0, 0.2, -0.3], [0.1, 0.9, 0.4]].map(|v| v.map(|x| x * scale));
        prepared!(list, format!("spherical triangle{name}"), R => {
            let (v0, e1, e2) = (vector::<R>([-0.3, -0.4, 2.0]), vector::<R>(edges[0]), vector::<R>(edges[1]));
            SphericalTriangle::with_edges(v0, v0 + e1, v0 + e2, e1, e2)
        });
        prepared!(list, format!("spherical parallelogram{name}"), R => {
            SphericalParallelogram::new(vector::<R>([-0.3, -0.4, 2.0]), vector(edges[0]), vector(edges[1]))
        });
        let sides = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|v| v.map(|x| x * scale));
        prepared!(list, format!("spherical rectangle{name}"), R => {
            SphericalRectangle::new(vector::<R>([-0.3, -0.4, 2.0]), vector(sides[0]), vector(sides[1]))
        });
    }
    let up = [0.0, 0.0, 1.0];
    prepared!(list, "projected cap, whole", R => ProjectedCap::new(vector::<R>([0.6, 0.0, 0.8]), number(0.2), vector(up)));
    prepared!(list, "projected cap, cut", R => ProjectedCap::new(vector::<R>([0.995, 0.0, 0.1]), number(0.2), vector(up)));
    list
}

/// Measures all warps in interleaved rounds; fewer rounds if `stop` is set.
#[must_use]
pub fn measure(stop: &AtomicBool, progress: impl Fn(u64, u64)) -> Vec<Measured> {
    let (mut routines, mut named) = (Vec::new(), Vec::new());
    for Entry { name, routines: widths, errors } in entries() {
        routines.extend(widths);
        named.push((name, errors));
    }
    let rounds = Rounds { count: ROUNDS, calls: BATCHES, samples: SAMPLES };
    let times = cost::measure(&mut routines, rounds, |done| {
        progress(done as u64, ROUNDS as u64);
        done < 9 || !stop.load(Ordering::Relaxed)
    });
    // medians of groups, so that interrupted batches do not count
    let estimate = |times: &Vec<f64>| {
        let groups = times.chunks_exact((times.len() / 5).max(1)).map(cost::median);
        Estimate::of(&groups.collect::<Vec<_>>())
    };
    let one = |((name, [point, density]), times): ((String, Errors), &[Vec<f64>])| Measured {
        name,
        nanoseconds: [0, 1, 2].map(|width| estimate(&times[width])),
        point,
        density,
    };
    named.into_iter().zip(times.chunks(3)).map(one).collect()
}

/// Draws the greatest error against the time per sample.
#[must_use]
pub fn figure(measured: &[Measured]) -> Figure {
    let line = |(i, m): (usize, &Measured)| Line {
        id: format!("warp/{i}"),
        name: m.name.clone(),
        color: i,
        dash: i / PALETTE.len(),
        shown: true,
        dots: m
            .nanoseconds
            .iter()
            .map(|t| Dot { x: (*t).into(), y: Bar::exact(m.point.error()), sure: t.is_sure() })
            .collect(),
    };
    let chart = Chart {
        title: "warps: greatest error against time".to_owned(),
        x_label: "nanoseconds per sample: x8, x4, f32 from left to right".to_owned(),
        y_label: "greatest error of a point or direction".to_owned(),
        scales: [Scale::Log, Scale::Log],
        lines: measured.iter().enumerate().map(line).collect(),
        guides: Vec::new(),
    };
    let caption = "Each line is one warp at three widths, which give the same bits and thus the same error. Errors are differences from \
                   the f64 instance of the same code for the same inputs, over 262,144 random points; directions have length 1."
        .to_owned();
    Figure { file: "warps", drawing: chart.draw(), caption }
}

/// The measurements as an HTML table.
#[must_use]
pub fn table(measured: &[Measured]) -> String {
    let mut text =
        "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"warps\"><table><tr><th>warp</th><th>f32</th><th>x4</th><th>x8</th><th>speed-up x8</th>\
                    <th>greatest error of point</th><th>of pdf</th></tr>\n"
            .to_owned();
    for m in measured {
        let [a, b, c] = m.nanoseconds.each_ref().map(|t| short(t.value));
        let _ = writeln!(
            text,
            "<tr><td>{}</td><td>{a} ns</td><td>{b} ns</td><td>{c} ns</td><td>{}×</td><td>{:.1e}</td><td>{:.1e}</td></tr>",
            escape(&m.name),
            short(m.nanoseconds[0].value / m.nanoseconds[2].value),
            m.point.error(),
            m.density.error()
        );
    }
    text + "</table></div>\n"
}

/// The measurements as CSV.
#[must_use]
pub fn csv(measured: &[Measured]) -> String {
    let mut text =
        "warp,ns_f32,ns_f32x4,ns_f32x8,half_f32,half_f32x4,half_f32x8,greatest_point_error,greatest_pdf_error\n"
            .to_owned();
    for m in measured {
        let [a, b, c] = &m.nanoseconds;
        let (name, values, halves) = (m.name.replace('"', ""), [a.value, b.value, c.value], [a.half, b.half, c.half]);
        let numbers: Vec<String> = values
            .iter()
            .chain(&halves)
            .map(|x| format!("{x:.4}"))
            .chain([m.point, m.density].map(|g| g.error()).map(|x| format!("{x:e}")))
            .collect();
        let _ = writeln!(text, "\"{name}\",{}", numbers.join(","));
    }
    text
}
