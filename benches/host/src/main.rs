//! A small host: directions to a triangle, a rectangle and a sphere, uniform in solid angle, each from a point of its own. Prints nanoseconds
//! per sample with its preparation, ours beside a textbook's, as rows of a table. `benches/host/run` builds it for each kind of host.

mod packets;
mod scalars;
mod textbook;

use etendue::{LightSampler, Rectangle, Sphere, Triangle, Vec2, Vec3, f32x8};
use std::hint::black_box;
use std::time::Instant;
use textbook::single::{self, Vector};

/// Samples of a run.
const N: usize = 4096;
/// Runs, of which the fastest counts.
const RUNS: usize = 15;

const CORNERS: [Vector; 3] = [[0.0, 1.0, 0.0], [1.0, 1.2, 0.0], [0.2, 1.0, 1.0]];
const CORNER: Vector = [-0.5, 1.0, -0.5];
const EDGES: [Vector; 2] = [[1.0, 0.0, 0.0], [0.0, 0.0, 1.2]];
const CENTER: Vector = [0.0, 2.0, 0.0];
const RADIUS: f32 = 0.5;

/// Shading points below the lights, and random numbers: one by one, and eight at once.
struct Input {
    points: Vec<Vector>,
    numbers: Vec<[f32; 2]>,
    packets: Vec<(Vec3<f32x8>, Vec2<f32x8>)>,
}

impl Input {
    fn new() -> Self {
        let mut state = 1_u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / 16_777_216.0
        };
        let points: Vec<_> = (0..N).map(|_| [2.0 * next() - 1.0, next() - 1.5, 2.0 * next() - 1.0]).collect();
        let numbers: Vec<_> = (0..N).map(|_| [next(), next()]).collect();
        let packet = |f: &dyn Fn(usize) -> f32| f32x8::from(std::array::from_fn::<f32, 8, _>(f));
        let packets = (0..N).step_by(8).map(|i| {
            let [x, y, z] = [0, 1, 2].map(|axis| packet(&|k| points[i + k][axis]));
            let [u, v] = [0, 1].map(|axis| packet(&|k| numbers[i + k][axis]));
            (Vec3::new(x, y, z), Vec2::new(u, v))
        });
        let packets = packets.collect();
        Self { points, numbers, packets }
    }
    /// Nanoseconds per sample, and the mean of what `sample` returns: the height of a direction over its pdf.
    #[inline(never)] // each loop is a function of its own, as in a host
    fn one_by_one(&self, sample: impl Fn(Vector, [f32; 2]) -> f32) -> (f64, f64) {
        timed(|| self.points.iter().zip(&self.numbers).map(|(p, u)| f64::from(sample(*p, *u))).sum())
    }
    /// The same of eight samples at once.
    #[inline(never)]
    fn eight_at_once(&self, sample: impl Fn(Vec3<f32x8>, Vec2<f32x8>) -> f32x8) -> (f64, f64) {
        timed(|| {
            let mut sum = f32x8::default();
            for (p, u) in &self.packets {
                sum += sample(*p, *u);
            }
            sum.to_array().map(f64::from).iter().sum()
        })
    }
}

fn timed(run: impl Fn() -> f64) -> (f64, f64) {
    let (mut least, mut sum) = (f64::MAX, 0.0);
    for _ in 0..RUNS {
        let start = Instant::now();
        sum = black_box(run());
        least = least.min(start.elapsed().as_secs_f64());
    }
    (least * 1e9 / N as f64, sum / N as f64)
}

/// One light: ours and the textbook's times, one by one and eight at once.
struct Times {
    ours: [f64; 2],
    textbook: [f64; 2],
}

/// Times of a light by closures, which must agree about the mean.
fn times(
    input: &Input,
    one: impl Fn(Vector, [f32; 2]) -> f32,
    eight: impl Fn(Vec3<f32x8>, Vec2<f32x8>) -> f32x8,
    textbook: impl Fn(Vector, [f32; 2]) -> f32,
    textbook_of_eight: impl Fn(Vec3<f32x8>, Vec2<f32x8>) -> f32x8,
) -> Times {
    let of_numbers = input.one_by_one(textbook);
    let of_packets = input.eight_at_once(textbook_of_eight);
    let (one, eight) = (input.one_by_one(one), input.eight_at_once(eight));
    for (_, mean) in [one, eight, of_packets] {
        assert!((mean / of_numbers.1 - 1.0).abs() < 0.02, "the means are {mean} and {}", of_numbers.1);
    }
    Times { ours: [one.0, eight.0], textbook: [of_numbers.0, of_packets.0] }
}

fn eight(v: Vector) -> Vec3<f32x8> {
    Vec3::from(v).map(f32x8::splat)
}

/// Times of a light.
macro_rules! times {
    ($input:expr, $light:expr, $textbook:expr, $textbook_of_eight:expr) => {{
        let light = black_box($light);
        let of_eight = light.map(f32x8::splat);
        let one = move |p: Vector, [x, y]: [f32; 2]| {
            let s = light.by_solid_angle(p.into()).sample(Vec2::new(x, y));
            s.direction.y * s.weight()
        };
        let eight = move |p, u| {
            let s = of_eight.by_solid_angle(p).sample(u);
            s.direction.y * s.weight()
        };
        let textbook = $textbook;
        let textbook_of_eight = $textbook_of_eight;
        times(
            $input,
            one,
            eight,
            move |p, u| {
                let (w, pdf) = textbook(p, u);
                w[1] / pdf
            },
            move |p, u| {
                let (w, pdf) = textbook_of_eight(p, u);
                w.y / pdf
            },
        )
    }};
}

fn main() {
    let build = std::env::args().nth(1).unwrap_or_else(|| "this build".into());
    if std::env::args().nth(2).as_deref() == Some("scalars") {
        return scalars::print(&build);
    }
    let input = &Input::new();
    let (corners, corner, edges) = black_box((CORNERS, CORNER, EDGES));
    let (center, radius) = black_box((CENTER, RADIUS));
    let [a, b, c] = corners.map(Vec3::from);
    let lights = [
        times!(input, Triangle::new(a, b, c), move |p, u| single::triangle(&corners, p, u), move |p, u| {
            packets::triangle(corners.map(eight), p, u)
        }),
        times!(
            input,
            Rectangle::new(corner.into(), edges[0].into(), edges[1].into()),
            move |p, u| single::rectangle(corner, edges, p, u),
            move |p, u| packets::rectangle(eight(corner), edges.map(eight), p, u)
        ),
        times!(
            input,
            Sphere::new(center.into(), radius),
            move |p, u| single::sphere(center, radius, p, u),
            move |p, u| packets::sphere(eight(center), f32x8::splat(radius), p, u)
        ),
    ];
    for (width, name) in ["x1", "x8"].into_iter().enumerate() {
        let cells = |digits: usize, of: fn(&Times, usize) -> f64| {
            lights.each_ref().map(|light| format!("{:.digits$}", of(light, width))).join(" / ")
        };
        let ours = cells(1, |times, width| times.ours[width]);
        let textbook = cells(1, |times, width| times.textbook[width]);
        let ratio = cells(2, |times, width| times.ours[width] / times.textbook[width]);
        println!("| {build}, {name} | {ours} | {textbook} | {ratio} |");
    }
}
