//! What is proved: for each routine the box of its parameters and the limits of its errors.

use crate::interval::Interval;
use crate::search::{Limit, Range, Theorem, Trial};
use crate::tape;
use crate::traced::Traced;
use core::f64::consts::{FRAC_1_PI, PI, TAU};
use etendue::spherical::{SphericalCap, SphericalTriangle};
use etendue::warp::{AreaTriangle, ConcentricDisk, Cone, CosineHemisphere, PolarDisk, Warp};
use etendue::{Mask, Real, Vec2, Vec3, f32x8};

/// All theorems; if not `whole`, for less wide boxes where the widest take minutes.
#[must_use]
pub fn all(whole: bool) -> Vec<Box<dyn Theorem>> {
    let mut all: Vec<Box<dyn Theorem>> = vec![
        Box::new(Disk),
        Box::new(Polar),
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

/// What a theorem is about. That of a direction has more parameters.
#[derive(Clone, Copy, PartialEq)]
enum Quantity {
    Direction,
    Pdf,
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
/// So many values next to an end are tried one by one.
const TRIED: u32 = 4;
/// In the last values of u₀, the worst roundings of all operations together could move a sample out of a cone.
const EXCEPTED: u32 = 16;
/// The pdf of a disk is positive up to x² + y² = 1 + 4e−7, rounded.
const RIM: f64 = 3.9e-7;
fn at_most(u: Traced, step: u32) -> bool {
    u.computed().hi <= f64::from(step) / f64::from(STEPS)
}
fn at_least(u: Traced, step: u32) -> bool {
    u.computed().lo >= f64::from(step) / f64::from(STEPS)
}
/// The concentric map, by angles.
fn concentric([u, v]: [f64; 2]) -> [f64; 2] {
    let (a, b) = (2.0 * u - 1.0, 2.0 * v - 1.0);
    if a == 0.0 && b == 0.0 {
        return [0.0, 0.0];
    }
    let (r, angle) = if a.abs() > b.abs() { (a, PI / 4.0 * (b / a)) } else { (b, PI / 2.0 - PI / 4.0 * (a / b)) };
    [r * angle.cos(), r * angle.sin()]
}

struct Disk;
impl Disk {
    fn outputs<R: Real>(&self, x: &[R]) -> Vec<R> {
        point(ConcentricDisk.sample(pair(x)))
    }
}
impl Theorem for Disk {
    outputs!();
    fn name(&self) -> &'static str {
        "ConcentricDisk"
    }
    fn domain(&self) -> String {
        "all 2⁴⁸ pairs u".to_owned()
    }
    fn ranges(&self) -> Vec<Range> {
        unit_square()
    }
    fn limits(&self) -> Vec<Limit> {
        vec![limit("error of the point, in radii", 2.2e-7), limit("relative error of the pdf", 6e-8), INSIDE]
    }
    fn bounds(&self, x: &[Traced]) -> Vec<f64> {
        let p = ConcentricDisk.sample(pair(x));
        let (pdf, assumed) = tape::assume(|| ConcentricDisk.pdf(p));
        // in exact arithmetic, x² + y² = r²
        let r = |u: Traced| (u.computed() * Interval::point(2.0) - Interval::point(1.0)).greatest();
        let inside = over_margin(&assumed, RIM + (1.0 - r(x[0]).max(r(x[1])).powi(2)));
        let tried = x.iter().any(|u| at_most(*u, TRIED - 1) || at_least(*u, STEPS - TRIED));
        vec![length(&[p.x, p.y]), relative(pdf), if tried { 0.0 } else { inside }]
    }
    fn trial(&self) -> Option<Trial> {
        let (all, first, last) = ((0, STEPS - 1), (0, TRIED - 1), (STEPS - TRIED, STEPS - 1));
        Some(Trial {
            what: "the pdf of samples at the rim is positive",
            ranges: vec![[first, all], [last, all], [all, first], [all, last]],
            holds: |u| ConcentricDisk.pdf(ConcentricDisk.sample(u)).gt(f32x8::splat(0.0)).all(),
        })
    }
    fn definition(&self, x: &[Traced], values: &[f64]) -> Vec<[f64; 3]> {
        let p = ConcentricDisk.sample(pair(x));
        let truth = concentric([values[0], values[1]]);
        let (pdf, assumed) = tape::assume(|| ConcentricDisk.pdf(p));
        vec![[p.x.exact(), truth[0], 1.0], [p.y.exact(), truth[1], 1.0], [pdf.exact(), FRAC_1_PI, 1.0]]
            .into_iter()
            .chain(margins(&assumed, RIM))
            .collect()
    }
}

struct Polar;
impl Polar {
    fn outputs<R: Real>(&self, x: &[R]) -> Vec<R> {
        point(PolarDisk.sample(pair(x)))
    }
}
impl Theorem for Polar {
    outputs!();
    fn name(&self) -> &'static str {
        "PolarDisk"
    }
    fn domain(&self) -> String {
        "all 2⁴⁸ pairs u".to_owned()
    }
    fn ranges(&self) -> Vec<Range> {
        unit_square()
    }
    fn limits(&self) -> Vec<Limit> {
        vec![limit("error of the point, in radii", 2.2e-7), limit("relative error of the pdf", 6e-8), INSIDE]
    }
    fn bounds(&self, x: &[Traced]) -> Vec<f64> {
        let p = PolarDisk.sample(pair(x));
        let (pdf, assumed) = tape::assume(|| PolarDisk.pdf(p));
        // in exact arithmetic, x² + y² = u₀
        let inside = over_margin(&assumed, RIM + (1.0 - x[0].computed().hi));
        let tried = at_least(x[0], STEPS - TRIED);
        vec![length(&[p.x, p.y]), relative(pdf), if tried { 0.0 } else { inside }]
    }
    fn trial(&self) -> Option<Trial> {
        Some(Trial {
            what: "the pdf of samples at the rim is positive",
            ranges: vec![[(STEPS - TRIED, STEPS - 1), (0, STEPS - 1)]],
            holds: |u| PolarDisk.pdf(PolarDisk.sample(u)).gt(f32x8::splat(0.0)).all(),
        })
    }
    fn definition(&self, x: &[Traced], values: &[f64]) -> Vec<[f64; 3]> {
        let p = PolarDisk.sample(pair(x));
        let (r, angle) = (values[0].sqrt(), TAU * values[1]);
        let (pdf, assumed) = tape::assume(|| PolarDisk.pdf(p));
        vec![[p.x.exact(), r * angle.cos(), 1.0], [p.y.exact(), r * angle.sin(), 1.0], [pdf.exact(), FRAC_1_PI, 1.0]]
            .into_iter()
            .chain(margins(&assumed, RIM))
            .collect()
    }
}

struct Hemisphere;
impl Hemisphere {
    fn outputs<R: Real>(&self, x: &[R]) -> Vec<R> {
        direction(CosineHemisphere.sample(pair(x)))
    }
}
impl Theorem for Hemisphere {
    outputs!();
    fn name(&self) -> &'static str {
        "CosineHemisphere"
    }
    fn domain(&self) -> String {
        "all pairs u but those on the edges u₀ = 0 and u₁ = 0, which are directions along the horizon".to_owned()
    }
    fn ranges(&self) -> Vec<Range> {
        vec![Range::Steps(1, (1 << 24) - 1); 2]
    }
    fn limits(&self) -> Vec<Limit> {
        vec![limit("error of the direction, in radians", 2.4e-7), limit("relative error of the pdf", 2.7e-7)]
    }
    fn bounds(&self, x: &[Traced]) -> Vec<f64> {
        let w = CosineHemisphere.sample(pair(x));
        vec![length(&[w.x, w.y, w.z]), relative(CosineHemisphere.pdf(w))]
    }
    fn definition(&self, x: &[Traced], values: &[f64]) -> Vec<[f64; 3]> {
        let w = CosineHemisphere.sample(pair(x));
        let [a, b] = concentric([values[0], values[1]]);
        // cosθ = √(1 − r²), r the greater of |2u₀ − 1| and |2u₁ − 1|
        let r = values[..2].iter().map(|u| (2.0 * u - 1.0).abs()).fold(0.0, f64::max);
        let z = ((1.0 - r) * (1.0 + r)).sqrt();
        let pdf = CosineHemisphere.pdf(w);
        vec![[w.x.exact(), a, 1.0], [w.y.exact(), b, 1.0], [w.z.exact(), z, z], [pdf.exact(), z * FRAC_1_PI, z]]
    }
}

struct Barycentrics;
impl Barycentrics {
    fn outputs<R: Real>(&self, x: &[R]) -> Vec<R> {
        point(AreaTriangle.sample(pair(x)))
    }
}
impl Theorem for Barycentrics {
    outputs!();
    fn name(&self) -> &'static str {
        "AreaTriangle"
    }
    fn domain(&self) -> String {
        "all 2⁴⁸ pairs u".to_owned()
    }
    fn ranges(&self) -> Vec<Range> {
        unit_square()
    }
    fn limits(&self) -> Vec<Limit> {
        vec![limit("error of the barycentric coordinates", 1.3e-7), limit("relative error of the pdf", 1e-300), INSIDE]
    }
    fn bounds(&self, x: &[Traced]) -> Vec<f64> {
        let b = AreaTriangle.sample(pair(x));
        let (pdf, assumed) = tape::assume(|| AreaTriangle.pdf(b));
        // the sum of both is √u₀
        let margin = 1.0 - x[0].computed().hi.sqrt().next_up();
        let tried = at_least(x[0], STEPS - TRIED);
        vec![length(&[b.x, b.y]), relative(pdf), if tried { 0.0 } else { over_margin(&assumed, margin) }]
    }
    fn trial(&self) -> Option<Trial> {
        Some(Trial {
            what: "the pdf of samples next to the edge opposite the first vertex is positive",
            ranges: vec![[(STEPS - TRIED, STEPS - 1), (0, STEPS - 1)]],
            holds: |u| AreaTriangle.pdf(AreaTriangle.sample(u)).gt(f32x8::splat(0.0)).all(),
        })
    }
    fn definition(&self, x: &[Traced], values: &[f64]) -> Vec<[f64; 3]> {
        let b = AreaTriangle.sample(pair(x));
        let root = values[0].sqrt();
        let pdf = tape::assume(|| AreaTriangle.pdf(b)).0;
        vec![
            [pdf.exact(), 2.0, 1.0],
            [b.x.exact(), root * (1.0 - values[1]), 1.0],
            [b.y.exact(), root * values[1], 1.0],
        ]
    }
}

struct Directions {
    heights: [f32; 2],
}
impl Directions {
    fn outputs<R: Real>(&self, x: &[R]) -> Vec<R> {
        let cone = Self::cone(x);
        direction(cone.sample(pair(x))).into_iter().chain([cone.uniform_pdf()]).collect()
    }
    fn cone<R: Real>(x: &[R]) -> Cone<R> {
        Cone { one_minus_cos: x[2] }
    }
    /// The least sin σ, or 1 beyond 90°.
    fn width(h: Interval) -> f64 {
        let sin = (h * (Interval::point(2.0) - h)).sqrt().map_or(0.0, |s| s.lo);
        if h.lo >= 1.0 { 1.0 } else { sin }
    }
    /// The least tolerance of the cone in 1 − cosθ: 4 units of 2⁻²⁴ times the greater of sin σ and 1 − cosσ − 1.
    fn tolerance(h: Interval) -> f64 {
        let sin = (h * (Interval::point(2.0) - h)).sqrt().map_or(0.0, |s| s.lo);
        4.0 / f64::from(STEPS) * sin.max(h.lo - 1.0) * (1.0 - 1e-6)
    }
}
impl Theorem for Directions {
    outputs!();
    fn name(&self) -> &'static str {
        "Cone"
    }
    fn domain(&self) -> String {
        format!(
            "all 2⁴⁸ pairs u (the pdf of samples is proved to be positive up to u₀ = 1 − 2⁻²⁰), 1 − cosσ from {:e} to {}, where 2 and more is the sphere",
            self.heights[0], self.heights[1]
        )
    }
    fn ranges(&self) -> Vec<Range> {
        vec![Range::UNIT, Range::UNIT, Range::Logarithmic(self.heights[0], self.heights[1])]
    }
    fn limits(&self) -> Vec<Limit> {
        vec![
            limit("error across the axis, in sin σ, or in 1 beyond 90°", 4e-7),
            limit("error along the axis, in 1", 1.3e-7),
            limit("relative error of the pdf", 1.7e-7),
            INSIDE,
        ]
    }
    fn bounds(&self, x: &[Traced]) -> Vec<f64> {
        let cone = Self::cone(x);
        let w = cone.sample(pair(x));
        let (pdf, assumed) = tape::assume(|| cone.pdf(w));
        // 1 − cosθ = u₀h in exact arithmetic
        let h = x[2].computed().lesser(Interval::point(2.0));
        let margin = h.lo * (1.0 - x[0].computed().hi) + Self::tolerance(h);
        let inside = if at_least(x[0], STEPS - EXCEPTED) { 0.0 } else { over_margin(&assumed, margin) };
        vec![length(&[w.x, w.y]) / Self::width(h), w.z.error(), relative(pdf), inside]
    }
    fn definition(&self, x: &[Traced], values: &[f64]) -> Vec<[f64; 3]> {
        let cone = Self::cone(x);
        let w = cone.sample(pair(x));
        let assumed = tape::assume(|| cone.pdf(w)).1;
        let (h, angle) = (values[2].min(2.0), TAU * values[1]);
        let k = values[0] * h;
        let sin = (k * (2.0 - k)).sqrt();
        let width = if h < 1.0 { (h * (2.0 - h)).sqrt() } else { 1.0 };
        vec![
            [w.x.exact(), sin * angle.cos(), width],
            [w.y.exact(), sin * angle.sin(), width],
            [w.z.exact(), 1.0 - k, 1.0],
            [cone.uniform_pdf().exact(), 1.0 / (TAU * h), 1.0 / (TAU * h)],
        ]
        .into_iter()
        .chain(margins(&assumed, h * (1.0 - values[0]) + Self::tolerance(Interval::point(h))))
        .collect()
    }
}

/// Spheres whose centre is farthest along one axis.
struct Sphere {
    axis: usize,
    sign: f32,
    radii: [f32; 2],
    quantity: Quantity,
}
impl Sphere {
    /// The centre from its coordinates, the greatest first.
    fn turned<T: Copy>(&self, c: [T; 3]) -> [T; 3] {
        core::array::from_fn(|i| c[(i + 3 - self.axis) % 3])
    }
    fn outputs<R: Real>(&self, x: &[R]) -> Vec<R> {
        let cap = self.cap(x);
        direction(cap.sample(pair(x))).into_iter().chain([cap.uniform_pdf()]).collect()
    }
    fn cap<R: Real>(&self, x: &[R]) -> SphericalCap<R> {
        let [a, b, c] = self.turned([x[2], x[3], x[4]]);
        SphericalCap::new(Vec3::new(a, b, c), x[5])
    }
}
impl Theorem for Sphere {
    outputs!();
    fn name(&self) -> &'static str {
        "SphericalCap"
    }
    fn domain(&self) -> String {
        let sign = if self.sign > 0.0 { '+' } else { '−' };
        format!(
            "all 2⁴⁸ pairs u, centres whose {sign}{} is in [1, 2] and whose other coordinates are in [−2, 2], radii from {} to {} (and these \
             lengths times any power of two)",
            ["x", "y", "z"][self.axis],
            self.radii[0],
            self.radii[1]
        )
    }
    fn ranges(&self) -> Vec<Range> {
        let first = if self.sign > 0.0 { Range::Linear(1.0, 2.0) } else { Range::Linear(-2.0, -1.0) };
        let other = Range::Linear(-2.0, 2.0);
        // the pdf of a sample does not depend on u
        let u = if self.quantity == Quantity::Pdf { Range::Steps(0, 0) } else { Range::UNIT };
        vec![u, u, first, other, other, Range::Logarithmic(self.radii[0], self.radii[1])]
    }
    fn limits(&self) -> Vec<Limit> {
        if self.quantity == Quantity::Pdf {
            vec![limit("relative error of the pdf", 2e-6)]
        } else {
            vec![limit("error of the direction, in radians", 1.5e-6)]
        }
    }
    fn bounds(&self, x: &[Traced]) -> Vec<f64> {
        let cap = self.cap(x);
        if self.quantity == Quantity::Pdf {
            return vec![relative(cap.uniform_pdf())];
        }
        let w = cap.sample(pair(x));
        vec![length(&[w.x, w.y, w.z])]
    }
    fn definition(&self, x: &[Traced], values: &[f64]) -> Vec<[f64; 3]> {
        let cap = self.cap(x);
        let w = cap.sample(pair(x));
        let c = self.turned([values[2], values[3], values[4]]);
        let squared = c.iter().map(|c| c * c).sum::<f64>();
        let [nx, ny, nz] = c.map(|c| c / squared.sqrt());
        let sin_squared = values[5] * values[5] / squared;
        let h = sin_squared / (1.0 + (1.0 - sin_squared).sqrt());
        let (k, angle) = (values[0] * h, TAU * values[1]);
        let sin = (k * (2.0 - k)).sqrt();
        let (lx, ly, lz) = (sin * angle.cos(), sin * angle.sin(), 1.0 - k);
        // the frame of Duff et al. 2017
        let sign = 1.0_f64.copysign(nz);
        let (a, b) = (-1.0 / (sign + nz), -nx * ny / (sign + nz));
        let s = [1.0 + sign * nx * nx * a, sign * b, -sign * nx];
        let t = [b, sign + ny * ny * a, -ny];
        let world = |i: usize| s[i] * lx + t[i] * ly + [nx, ny, nz][i] * lz;
        let pdf = cap.uniform_pdf();
        vec![
            [w.x.exact(), world(0), 1.0],
            [w.y.exact(), world(1), 1.0],
            [w.z.exact(), world(2), 1.0],
            [pdf.exact(), 1.0 / (TAU * h), 1.0 / (TAU * h)],
        ]
    }
}

/// Triangles whose corners are near these.
struct Triangle {
    corners: [[f32; 3]; 3],
    /// How far each coordinate may be from that of the corner.
    by: f32,
    quantity: Quantity,
}
impl Triangle {
    fn outputs<R: Real>(&self, x: &[R]) -> Vec<R> {
        let triangle = Self::prepare(x);
        direction(triangle.sample(pair(x))).into_iter().chain([triangle.uniform_pdf()]).collect()
    }
    fn prepare<R: Real>(x: &[R]) -> SphericalTriangle<R> {
        let v = |i: usize| Vec3::new(x[i], x[i + 1], x[i + 2]);
        SphericalTriangle::new(v(2), v(5), v(8))
    }
}
impl Theorem for Triangle {
    outputs!();
    fn name(&self) -> &'static str {
        "SphericalTriangle"
    }
    fn domain(&self) -> String {
        format!(
            "all 2⁴⁸ pairs u, triangles whose corners are within {} of {:?} in each coordinate (and these lengths times any power of two)",
            self.by, self.corners
        )
    }
    fn ranges(&self) -> Vec<Range> {
        let u = if self.quantity == Quantity::Pdf { Range::Steps(0, 0) } else { Range::UNIT };
        let corners = self.corners.iter().flatten().map(|c| Range::Linear(c - self.by, c + self.by));
        [u, u].into_iter().chain(corners).collect()
    }
    fn limits(&self) -> Vec<Limit> {
        if self.quantity == Quantity::Pdf {
            vec![limit("relative error of the pdf", 4e-6)]
        } else {
            vec![limit("error of the direction, in radians", 5e-6)]
        }
    }
    fn bounds(&self, x: &[Traced]) -> Vec<f64> {
        let triangle = Self::prepare(x);
        if self.quantity == Quantity::Pdf {
            return vec![relative(triangle.uniform_pdf())];
        }
        let w = triangle.sample(pair(x));
        vec![length(&[w.x, w.y, w.z])]
    }
    fn definition(&self, x: &[Traced], values: &[f64]) -> Vec<[f64; 3]> {
        let triangle = Self::prepare(x);
        let [v0, v1, v2] = [2, 5, 8].map(|i| unit([values[i], values[i + 1], values[i + 2]]));
        let total = solid_angle(v0, v1, v2);
        let mut pairs = vec![[triangle.uniform_pdf().exact() * total, 1.0, 1.0]];
        if self.quantity == Quantity::Direction {
            let w = triangle.sample(pair(x));
            let w = [w.x.exact(), w.y.exact(), w.z.exact()];
            // the arc from v1 through w ends on the edge from v0 to v2 at P
            let p = unit(cross(cross(v1, w), cross(v0, v2)));
            let p = if dot(p, v0) + dot(p, v2) < 0.0 { p.map(|x| -x) } else { p };
            let apart = |a: [f64; 3]| 0.5 * (0..3).map(|i| (a[i] - v1[i]).powi(2)).sum::<f64>();
            // next to v1 the direction of the arc is lost
            let near = apart(w).sqrt().max(1e-9);
            pairs.push([solid_angle(v0, v1, p) / total, values[0], 1e-3 / near.min(1e-3)]);
            pairs.push([apart(w) / apart(p), values[1], 1.0]);
            pairs.push([dot(w, w), 1.0, 1.0]);
        }
        pairs
    }
}
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}
fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}
fn unit(a: [f64; 3]) -> [f64; 3] {
    a.map(|x| x / dot(a, a).sqrt())
}
/// Van Oosterom and Strackee 1983, for unit vectors.
fn solid_angle(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    2.0 * dot(a, cross(b, c)).abs().atan2(1.0 + dot(a, b) + dot(b, c) + dot(c, a))
}
