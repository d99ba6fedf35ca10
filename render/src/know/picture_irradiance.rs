//! The irradiance from a picture on a parallelogram, without samples.
//!
//! The kernel of the integral, the cosine at the receiver over the fourth power of the distance, is smooth as long as the picture is far for
//! its size and all of it is above the horizon. So it is interpolated between 10 × 10 points of the picture, and each of these has a weight,
//! which is the exact integral of the picture times its Lagrange polynomial. Where the picture is too near, its halves are taken, and so on:
//! those of a box are on the longer of its sides.

use crate::geometry::{Geometry, Parallelogram};
use crate::packet::{M8, V8, X8};
use crate::scene::light_picture::LightPicture;
use crate::scene::limits::MOST_RADIANCE;
use crate::scene::texture::Picture;
use etendue::{Mask, Real, Vec3};
use std::f64::consts::PI;
use std::sync::LazyLock;

const ORDER: usize = PictureIrradiance::ORDER;
const FAR: f64 = PictureIrradiance::FAR;
/// How often the picture is halved: at most 64 boxes are far at a point, which is then some 0.4 of the light's half diagonal away.
const HALVINGS: usize = 6;

/// The positions of the points along a side, from −1 to 1: zeros of a Chebyshev polynomial.
fn places() -> [f64; ORDER] {
    std::array::from_fn(|i| -libm::cos((2 * i + 1) as f64 * PI / (2 * ORDER) as f64))
}

/// The Lagrange polynomials of the points, at a position from −1 to 1.
fn lagrange(at: f64) -> [f64; ORDER] {
    let places = places();
    let factor = |i: usize, j: usize| (at - places[j]) / (places[i] - places[j]);
    std::array::from_fn(|i| (0..ORDER).filter(|&j| j != i).map(|j| factor(i, j)).product())
}

/// Abscissas and weights of Gauss and Legendre's rule on [0, 1], exact up to degree 11: a polynomial of the points times a linear function.
const GAUSS: [(f64, f64); 6] = {
    const HALF: [(f64, f64); 3] = [
        (0.238_619_186_083_196_9, 0.467_913_934_572_691_05),
        (0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
        (0.932_469_514_203_152, 0.171_324_492_379_170_36),
    ];
    let mut all = [(0.0, 0.0); 6];
    let mut i = 0;
    while i < 3 {
        let (x, w) = HALF[i];
        all[2 * i] = (0.5 - 0.5 * x, 0.5 * w);
        all[2 * i + 1] = (0.5 + 0.5 * x, 0.5 * w);
        i += 1;
    }
    all
};

/// The weights of the points of a box for the three channels.
type Weights = [[f32; 3]; ORDER * ORDER];

/// A grid of boxes.
#[derive(Clone, Debug)]
struct Level {
    /// Boxes along both sides.
    boxes: [usize; 2],
    /// The side that the next level halves.
    axis: usize,
    /// Half the edges of a box.
    edges: [Vec3<f32>; 2],
    /// The squared distance from which a box is far.
    far: f32,
    /// Row by row.
    weights: Vec<Weights>,
}

/// The irradiance from a picture on a parallelogram.
///
/// - Formula: ∫ L cosθ cosθ'/d² dA = Σ wᵢ k(xᵢ), with the kernel k at 100 points of each box, and wᵢ the integral of the radiance L times the
///   Lagrange polynomial of the point: tensor products of Chebyshev interpolation (Trefethen 2013, Approximation Theory and Approximation
///   Practice, chapters 2 and 5).
/// - Domain: any points; what is too near, or crosses the horizon in a box, is unknown.
/// - Greatest error: 1e−5 of the irradiance of a surface that faces the picture.
#[derive(Clone, Debug)]
pub struct PictureIrradiance {
    /// Where the coordinates of the surface are 0.
    corner: Vec3<f32>,
    edges: [Vec3<f32>; 2],
    /// Their cross product.
    normal: Vec3<f32>,
    /// One over the longest edge: distances are in its units, so that their powers are finite.
    unit: f32,
    /// From the whole on.
    levels: Vec<Level>,
}

/// Integrals over a box, from `low` to `high` in [0, 1], of each texel's part in the interpolation along one axis times the Lagrange
/// polynomials of the box: the first texel, and those of it and the following ones.
fn along(texels: usize, bilinear: bool, [low, high]: [f64; 2]) -> (usize, Vec<[f64; ORDER]>) {
    let n = texels as f64;
    // interpolation has its knots in the middles of texels
    let shift = if bilinear { 0.5 } else { 0.0 };
    let (from, to) = (low * n - shift, high * n - shift);
    let clamped = |i: i64| i.clamp(0, texels as i64 - 1) as usize;
    let (begin, end) = (from.floor() as i64, to.ceil() as i64);
    let first = clamped(begin);
    let mut sums = vec![[0.0; ORDER]; clamped(end) + 1 - first];
    for knot in begin..end {
        let (x0, x1) = ((knot as f64).max(from), (knot as f64 + 1.0).min(to));
        for (at, weight) in GAUSS {
            let x = x0 + (x1 - x0) * at;
            let weight = weight * (x1 - x0) / n;
            let values = lagrange(2.0 * (x - from) / (to - from) - 1.0);
            let right = if bilinear { x - knot as f64 } else { 0.0 };
            for (texel, part) in [(knot, 1.0 - right), (knot + 1, right)] {
                if part > 0.0 {
                    let sums = &mut sums[clamped(texel) - first];
                    sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * part * value);
                }
            }
        }
    }
    (first, sums)
}

/// The sums of a row of texels times the integrals of a column of boxes.
fn across(
    picture: &LightPicture,
    mirrored: [bool; 2],
    row: usize,
    (first, parts): &(usize, Vec<[f64; ORDER]>),
) -> [[f64; 3]; ORDER] {
    let mut sums = [[0.0; 3]; ORDER];
    for (column, part) in (*first..).zip(parts) {
        let color = picture.whole_texel(mirrored, [column, row]);
        for (sum, part) in sums.iter_mut().zip(part) {
            sum.iter_mut().zip(color).for_each(|(sum, x)| *sum += part * f64::from(x));
        }
    }
    sums
}

/// The weights of a box with halves along an axis: its polynomials at the points of both halves.
fn joined(
    all: &[[[f64; 3]; ORDER * ORDER]],
    boxes: [usize; 2],
    axis: usize,
    at: [usize; 2],
    halves: &[[[f64; ORDER]; ORDER]; 2],
) -> [[f64; 3]; ORDER * ORDER] {
    let columns = if axis == 0 { 2 * boxes[0] } else { boxes[0] };
    let mut sums = [[0.0; 3]; ORDER * ORDER];
    for (half, values) in halves.iter().enumerate() {
        let mut of = at;
        of[axis] = 2 * of[axis] + half;
        let weights = &all[of[1] * columns + of[0]];
        for (i, sum) in sums.iter_mut().enumerate() {
            let [column, row] = [i % ORDER, i / ORDER];
            for point in 0..ORDER {
                let (weight, value) = if axis == 0 {
                    (weights[row * ORDER + point], values[point][column])
                } else {
                    (weights[point * ORDER + column], values[point][row])
                };
                (0..3).for_each(|k| sum[k] += weight[k] * value);
            }
        }
    }
    sums
}

/// The weights times the kernel at the points of a box with this centre and half edges. The centre has this height above the horizon, and
/// the half edges rise by these.
#[inline]
fn sum_of(weights: &Weights, center: V8, [s, t]: [V8; 2], height: X8, rise: [X8; 2]) -> V8 {
    static PLACES: LazyLock<[f32; ORDER]> = LazyLock::new(|| places().map(|x| x as f32));
    let places = PLACES.map(X8::splat);
    let (mut sum, squared) = (V8::default(), s.length_squared());
    for (row, along_t) in weights.chunks_exact(ORDER).zip(places) {
        let middle = t.mul_add(along_t, center);
        let (square, height) = (middle.length_squared(), rise[1].mul_add(along_t, height));
        let slope = middle.dot(s) * X8::lit(2.0);
        for (&[r, g, b], along_s) in row.iter().zip(places) {
            let square = squared.mul_add(along_s, slope).mul_add(along_s, square);
            let kernel = rise[0].mul_add(along_s, height) / (square * square);
            sum.x = kernel.mul_add(X8::splat(r), sum.x);
            sum.y = kernel.mul_add(X8::splat(g), sum.y);
            sum.z = kernel.mul_add(X8::splat(b), sum.z);
        }
    }
    sum
}

impl PictureIrradiance {
    /// Points along each side of a box.
    pub const ORDER: usize = 10;
    /// A box counts as far at so many times half its diagonal. Then the interpolation changes the irradiance by at most 1e−5 of what a surface
    /// that faces the picture would receive; 5e−6 measured by `cargo test -p etendue-render-tests picture_irradiance -- --nocapture`.
    pub const FAR: f64 = 3.0;

    /// `None` unless the shape is a parallelogram that shows all of a picture, upright or mirrored, and clamped at its edges if it is
    /// interpolated.
    #[must_use]
    pub fn new(shown: &LightPicture, geometry: &Geometry) -> Option<Self> {
        let Geometry::Parallelogram(Parallelogram { p: corner, u, v }) = *geometry else { return None };
        let [corner, u, v] = [corner, u, v].map(Vec3::<f32>::from);
        let mirrored = shown.whole(geometry)?;
        let Picture { texels, bilinear, .. } = &shown.picture;
        let size = [texels.width, texels.height];
        let most = (0..size[0] * size[1]).map(|i| shown.whole_texel(mirrored, [i % size[0], i / size[0]]));
        if most.flatten().any(|x| !(0.0..=MOST_RADIANCE).contains(&x)) {
            return None;
        }
        let wide = |v: Vec3<f32>| v.map(f64::from);
        let lengths = [u, v].map(|edge| wide(edge).length());
        let unit = 1.0 / lengths[0].max(lengths[1]);
        let narrow = |v: Vec3<f64>| Vec3::<f32>::from([v.x, v.y, v.z].map(|x| x as f32));
        let edges = [u, v].map(|edge| wide(edge) * unit);
        let mut levels = Vec::new();
        let mut boxes = [1, 1];
        for _ in 0..=HALVINGS {
            let axis = usize::from(lengths[1] / boxes[1] as f64 > lengths[0] / boxes[0] as f64);
            let half: [Vec3<f64>; 2] = std::array::from_fn(|k| edges[k] * (0.5 / boxes[k] as f64));
            let diagonals = [half[0] + half[1], half[0] - half[1]].map(|diagonal| diagonal.length_squared());
            let far = (FAR * FAR * diagonals[0].max(diagonals[1])) as f32;
            levels.push(Level { boxes, axis, edges: half.map(narrow), far, weights: Vec::new() });
            boxes[axis] *= 2;
        }
        let sides = |boxes: usize, i: usize| [i, i + 1].map(|i| i as f64 / boxes as f64);
        // those of the smallest boxes from texels, and those of the others from their halves
        let leaves = levels.last_mut()?;
        let [columns, rows] = [0, 1].map(|k| -> Vec<_> {
            (0..leaves.boxes[k]).map(|i| along(size[k], *bilinear, sides(leaves.boxes[k], i))).collect()
        });
        let mut weights: Vec<[[f64; 3]; ORDER * ORDER]> = Vec::new();
        for (first, rows) in &rows {
            for column in &columns {
                let mut sums = [[0.0; 3]; ORDER * ORDER];
                for (row, parts) in (*first..).zip(rows) {
                    let of_row = across(shown, mirrored, row, column);
                    for (i, sum) in sums.iter_mut().enumerate() {
                        (0..3).for_each(|k| sum[k] += parts[i / ORDER] * of_row[i % ORDER][k]);
                    }
                }
                weights.push(sums);
            }
        }
        let halves = [-0.5, 0.5].map(|middle| places().map(|x| lagrange(middle + 0.5 * x)));
        for level in (0..levels.len()).rev() {
            levels[level].weights = weights.iter().map(|of| of.map(|color| color.map(|x| x as f32))).collect();
            if level == 0 {
                break;
            }
            let Level { boxes, axis, .. } = levels[level - 1];
            weights = (0..boxes[0] * boxes[1])
                .map(|i| joined(&weights, boxes, axis, [i % boxes[0], i / boxes[0]], &halves))
                .collect();
        }
        let normal = narrow(edges[0].cross(edges[1]));
        Some(Self { corner, edges: edges.map(narrow), normal, unit: unit as f32, levels })
    }

    /// Irradiance at points `p` of surfaces with the unit normal `n`, in the unit of radiance times steradian, if nothing hides the picture.
    /// Both of its sides emit. Also, the lanes in which it is known: where all of the picture is on one side of the horizon, as far as
    /// smaller and smaller boxes of texels tell, and not too near.
    pub fn at(&self, p: V8, n: V8, lanes: M8) -> (V8, M8) {
        let scale = X8::splat(self.unit);
        let from = (V8::splat(self.corner) - p) * scale;
        let mut sum = V8::default();
        let mut known = lanes;
        // each box leaves at most one for later
        let mut stack = [(0_usize, [0_usize; 2], lanes); HALVINGS + 2];
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let (depth, at, here) = stack[count];
            let level = &self.levels[depth];
            let middle = |k: usize| V8::splat(self.edges[k]) * X8::lit((at[k] as f64 + 0.5) / level.boxes[k] as f64);
            let center = from + middle(0) + middle(1);
            let [s, t] = level.edges.map(V8::splat);
            let (height, rise) = (center.dot(n), [s.dot(n), t.dot(n)]);
            let most = rise[0].abs() + rise[1].abs();
            let here = here & !height.le(-most);
            let is_far = here & center.length_squared().gt(X8::splat(level.far)) & height.ge(most);
            if is_far.any() {
                let weights = &level.weights[at[1] * level.boxes[0] + at[0]];
                let part = sum_of(weights, center, [s, t], height, rise);
                sum += V8::blend(is_far, part, V8::default());
            }
            let near = here & !is_far;
            if near.any() {
                if depth + 1 == self.levels.len() {
                    known = known & !near;
                    continue;
                }
                for half in 0..2 {
                    let mut at = at;
                    at[level.axis] = 2 * at[level.axis] + half;
                    stack[count] = (depth + 1, at, near);
                    count += 1;
                }
            }
        }
        let factor = from.dot(V8::splat(self.normal)).abs();
        let sum = sum * factor;
        let known = known & (sum.x + sum.y + sum.z).lt(X8::lit(f64::INFINITY));
        (V8::blend(known, sum, V8::default()), known)
    }
}
