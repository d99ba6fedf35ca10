//! Single numbers of either precision beside the plainest formulas: a sample with its preparation, by a light's own technique and by a set of lights,
//! and the pdf of a direction after a sample at the same point.

use crate::textbook;
use etendue::lights::{Lights, LightsAt, Receiver, Side};
use etendue::{LightSampler, Rectangle, Sphere, Triangle, Vec2, Vec3};
use std::hint::black_box;
use std::time::Instant;

/// Samples of a run, and runs, of which the fastest counts.
const N: usize = 4096;
const RUNS: usize = 15;

fn timed(run: impl Fn() -> f64) -> (f64, f64) {
    let (mut least, mut sum) = (f64::MAX, 0.0);
    for _ in 0..RUNS {
        let start = Instant::now();
        sum = black_box(run());
        least = least.min(start.elapsed().as_secs_f64());
    }
    (least * 1e9 / N as f64, sum / N as f64)
}

/// Nanoseconds: ours, the plainest form's, a set's sample, and a set's sample and pdf.
pub struct Times(pub [f64; 4]);

macro_rules! scalars {
    ($name:ident, $number:ident, $plain:ident) => {
        pub fn $name() -> Vec<(&'static str, Times)> {
            use textbook::$plain::{Vector, rectangle, sphere, triangle};
            let mut state = 1_u32;
            let mut next = || {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                (state >> 8) as $number / 16_777_216.0
            };
            let points: Vec<Vector> = (0..N).map(|_| [2.0 * next() - 1.0, next() - 1.5, 2.0 * next() - 1.0]).collect();
            let numbers: Vec<[$number; 2]> = (0..N).map(|_| [next(), next()]).collect();
            #[inline(never)]
            fn each(
                points: &[Vector],
                numbers: &[[$number; 2]],
                sample: impl Fn(Vector, [$number; 2]) -> $number,
            ) -> (f64, f64) {
                timed(|| points.iter().zip(numbers).map(|(p, u)| f64::from(sample(*p, *u))).sum())
            }
            fn set(at: &LightsAt<'_, $number>, u: [$number; 2]) -> ($number, $number) {
                let s = at.sample([0.5, u[0], u[1]]);
                // a ray of the surface hits the light a little further on
                let pdf = at.pdf(s.which, s.direction);
                (s.direction.y * s.weight(), pdf)
            }
            let corners: [Vector; 3] = black_box([[0.0, 1.0, 0.0], [1.0, 1.2, 0.0], [0.2, 1.0, 1.0]]);
            let (corner, edges): (Vector, [Vector; 2]) =
                black_box(([-0.5, 1.0, -0.5], [[1.0, 0.0, 0.0], [0.0, 0.0, 1.2]]));
            let (center, radius): (Vector, $number) = black_box(([0.0, 2.0, 0.0], 0.5));
            let v = |v: Vector| -> Vec3<$number> { v.into() };
            let [a, b, c] = corners.map(v);
            let mut rows = Vec::new();
            macro_rules! row {
                ($title:literal, $light:expr, |$p:ident, $u:ident| $plain_call:expr) => {{
                    let light = $light;
                    let plainest = each(&points, &numbers, |$p, $u| {
                        let (w, pdf) = $plain_call;
                        w[1] / pdf
                    });
                    let ours = each(&points, &numbers, |p, [x, y]| {
                        let s = light.by_solid_angle(v(p)).sample(Vec2::new(x, y));
                        s.direction.y * s.weight()
                    });
                    let lights = Lights::new([(light, 1.0)]).expect("one light");
                    let at = |p| lights.at(Receiver { point: v(p), side: Side::None, on: None });
                    let sample = each(&points, &numbers, |p, u| {
                        let s = at(p).sample([0.5, u[0], u[1]]);
                        s.direction.y * s.weight()
                    });
                    let both = each(&points, &numbers, |p, u| {
                        let (x, pdf) = set(&at(p), u);
                        if pdf >= 0.0 { x } else { 0.0 }
                    });
                    for (_, mean) in [ours] {
                        assert!(
                            (mean / plainest.1 - 1.0).abs() < 0.02,
                            "of the {}, the means are {mean} and {}",
                            $title,
                            plainest.1
                        );
                    }
                    for (_, mean) in [sample, both] {
                        assert!(mean > 0.0);
                    }
                    rows.push(($title, Times([ours.0, plainest.0, sample.0, both.0])));
                }};
            }
            row!("triangle", Triangle::new(a, b, c), |p, u| triangle(&corners, p, u));
            row!("rectangle", Rectangle::new(v(corner), v(edges[0]), v(edges[1])), |p, u| rectangle(
                corner, edges, p, u
            ));
            row!("sphere", Sphere::new(v(center), radius), |p, u| sphere(center, radius, p, u));
            rows
        }
    };
}
scalars!(single, f32, single);
scalars!(double, f64, double);

/// Prints a row for each number type.
pub fn print(build: &str) {
    for (number, rows) in [("f32", single()), ("f64", double())] {
        let cells = |of: &dyn Fn(&[f64; 4]) -> String| {
            rows.iter().map(|(_, Times(times))| of(times)).collect::<Vec<_>>().join(" / ")
        };
        println!(
            "| {build}, {number} | {} | {} | {} | {} | {} |",
            cells(&|[ours, ..]| format!("{ours:.1}")),
            cells(&|[_, plainest, ..]| format!("{plainest:.1}")),
            cells(&|[ours, plainest, ..]| format!("{:.2}", ours / plainest)),
            cells(&|[_, _, set, _]| format!("{set:.1}")),
            cells(&|[_, _, set, both]| format!("{:.2}", (both - set) / set)),
        );
    }
}
