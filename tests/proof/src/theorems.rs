//! What is proved: for each routine the box of its parameters and the limits of its errors.

mod cone;
mod fixed;
mod sphere;
mod triangle;

use crate::search::{Limit, Range, Theorem};
use crate::tape;
use crate::traced::Traced;
use cone::Directions;
use etendue::{Real, Vec2, Vec3};
use fixed::{Barycentrics, Disk, Hemisphere};
use sphere::Sphere;
use triangle::Triangle;

/// What a theorem is about. That of a direction has more parameters.
#[derive(Clone, Copy, PartialEq)]
enum Quantity {
    Direction,
    Pdf,
}

/// All theorems; if not `whole`, for less wide boxes where the widest take minutes.
#[must_use]
pub fn all(whole: bool) -> Vec<Box<dyn Theorem>> {
    let mut all: Vec<Box<dyn Theorem>> = vec![
        Box::new(Disk),
        Box::new(Hemisphere),
        Box::new(Barycentrics),
        Box::new(Directions { heights: if whole { [1e-30, 4.0] } else { [1e-6, 4.0] } }),
    ];
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            for quantity in [Quantity::Direction, Quantity::Pdf] {
                if whole || axis == 2 {
                    let radii = if whole { [1e-4, 0.9] } else { [0.2, 0.9] };
                    all.push(Box::new(Sphere { axis, sign, radii, quantity }));
                }
            }
        }
    }
    // 50° across, and 1° across
    let triangles = [
        ([[0.5, -0.25, 1.0], [-0.5, -0.25, 1.0], [0.0, 0.5, 1.0]], 1.0),
        ([[1.0, 1.0, 1.0], [1.0, 1.015625, 1.0], [1.0, 1.0, 1.015625]], 1.0 / 64.0),
    ];
    for (corners, size) in triangles {
        for (quantity, by) in [(Quantity::Direction, 1.0 / 256.0), (Quantity::Pdf, 1.0 / 16.0)] {
            let by = size * by;
            all.push(Box::new(Triangle { corners, by, quantity }));
        }
    }
    all
}

/// The results of a routine, in single precision and traced, by one body.
macro_rules! outputs {
    () => {
        fn run(&self, x: &[f32]) -> Vec<f32> {
            self.outputs(x)
        }
        fn trace(&self, x: &[Traced]) -> Vec<Traced> {
            self.outputs(x)
        }
    };
}
use outputs;

fn point<R: Real>(p: Vec2<R>) -> Vec<R> {
    vec![p.x, p.y]
}
fn direction<R: Real>(w: Vec3<R>) -> Vec<R> {
    vec![w.x, w.y, w.z]
}

/// A bound of the length of an error.
fn length(components: &[Traced]) -> f64 {
    components.iter().map(|c| c.error().powi(2)).sum::<f64>().sqrt().next_up()
}
/// A bound of the relative error of a number.
fn relative(x: Traced) -> f64 {
    let (least, error) = (x.between().least(), x.error());
    if least > 0.0 { (error / least).next_up() } else { f64::INFINITY }
}
const fn limit(what: &'static str, most: f64) -> Limit {
    Limit { what, most }
}
fn unit_square() -> Vec<Range> {
    vec![Range::UNIT; 2]
}
fn pair<R: Real>(x: &[R]) -> Vec2<R> {
    Vec2::new(x[0], x[1])
}
/// The routine's test whether a sample is inside, which must not fail by rounding.
const INSIDE: Limit = limit("error of the test whether a sample is inside, over its tolerance", 1.0);
/// The greatest error of what was assumed, over its margin in exact arithmetic.
fn over_margin(assumed: &[tape::Assumed], margin: f64) -> f64 {
    let over = |a: &tape::Assumed| if margin > 0.0 { a.error() / margin } else { f64::INFINITY };
    assumed.iter().map(over).fold(0.0, f64::max).next_up()
}
/// Where a comparison has less than this margin in exact arithmetic, a difference from the definition.
fn margins(assumed: &[tape::Assumed], margin: f64) -> impl Iterator<Item = [f64; 3]> {
    let missing = move |a: &tape::Assumed| (margin - a.exact_margin()).max(0.0) / margin;
    assumed.iter().map(missing).map(|missing| [missing, 0.0, 1.0]).collect::<Vec<_>>().into_iter()
}
/// How many values of u there are.
const STEPS: u32 = 1 << 24;
fn at_least(u: Traced, step: u32) -> bool {
    u.computed().lo >= f64::from(step) / f64::from(STEPS)
}
