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

/// Points along each side of a box.
const ORDER: usize = 10;
/// A box counts as far at so many times half its diagonal. Then the interpolation changes the irradiance by at most 1e−5 of what a surface
/// that faces the picture would receive (5e−6 measured, by the test below).
const FAR: f64 = 3.0;
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
pub(super) struct PictureIrradiance {
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
    /// `None` unless the shape is a parallelogram that shows all of a picture, upright or mirrored, and clamped at its edges if it is
    /// interpolated.
    #[must_use]
    pub(super) fn new(shown: &LightPicture, geometry: &Geometry) -> Option<Self> {
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
    pub(super) fn at(&self, p: V8, n: V8, lanes: M8) -> (V8, M8) {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Parallelogram;
    use crate::scene::texture::{Colors, Mapping, Texels, Wrap};
    use std::sync::Arc;

    /// The kernel's error, relative to that of a receiver that faces the point of the light, is greatest for thin lights, in line with them.
    #[test]
    fn far_boxes_are_interpolated_to_the_stated_error() {
        let places = places();
        let at = |i: usize| i as f64 / 8.0 - 1.0;
        let values: Vec<[f64; ORDER]> = (0..17).map(|i| lagrange(at(i))).collect();
        let mut worst = 0.0_f64;
        for (thin, skew) in
            [0.01, 0.1, 0.3, 0.5, 0.7, 0.85, 1.0].into_iter().flat_map(|a| [0.0, 0.6, -0.9].map(|b| (a, b)))
        {
            let (s, t) = (Vec3::new(1.0, 0.0, 0.0), Vec3::new(skew * thin, thin * f64::sqrt(1.0 - skew * skew), 0.0));
            let half = (s + t).length().max((s - t).length());
            for (turn, up) in (0..13).flat_map(|i| [0.0, 0.1, 0.3, 0.6, 1.0].map(|up| (PI * i as f64 / 12.0, up))) {
                let flat = f64::sqrt(1.0 - up * up);
                let center = Vec3::new(flat * turn.cos(), flat * turn.sin(), up) * (FAR * half);
                let point = |x: f64, y: f64| center + s * x + t * y;
                let kernel = |v: Vec3<f64>| v * (1.0 / v.length_squared().powi(2));
                for (x, y) in (0..17).flat_map(|i| (0..17).map(move |j| (i, j))) {
                    let exact = point(at(x), at(y));
                    let mut sum = Vec3::default();
                    for (i, j) in (0..ORDER).flat_map(|i| (0..ORDER).map(move |j| (i, j))) {
                        sum += kernel(point(places[i], places[j])) * (values[x][i] * values[y][j]);
                    }
                    worst = worst.max((sum - kernel(exact)).length() * exact.length().powi(3));
                }
            }
        }
        println!("greatest error {worst:.1e}");
        assert!((1e-6..6e-6).contains(&worst), "{worst}");
    }

    fn picture(width: usize, height: usize, bilinear: bool, mapping: Mapping) -> LightPicture {
        let color = |i: usize| {
            [((i * 7919) % 101) as f32, ((i * 104_729) % 37) as f32, if i.is_multiple_of(11) { 500.0 } else { 0.0 }]
        };
        let colors = Colors::Float((0..width * height).map(color).collect());
        let texels = Arc::new(Texels { width, height, colors, alpha: None });
        let picture = Picture { texels, mapping, wrap: [Wrap::Clamp; 2], bilinear };
        LightPicture { picture, factor: [1.0, 0.5, 0.25], axes: crate::scene::light_picture::WORLD }
    }

    /// By a rule of Gauss with 3 × 3 points in cells of at most half a texel, in double precision: it knows only the picture's look-up.
    fn quadrature(shown: &LightPicture, [p, u, v]: [[f32; 3]; 3], at: [f64; 3], n: [f64; 3]) -> [f64; 3] {
        let wide = |v: [f32; 3]| Vec3::<f64>::from(v.map(f64::from));
        let (p, u, v, at, n) = (wide(p), wide(u), wide(v), Vec3::from(at), Vec3::from(n));
        let Texels { width, height, .. } = *shown.picture.texels;
        let [w, h] = [width, height].map(|n| 2 * n * 48_usize.div_ceil(n));
        let rule = [(-0.6_f64.sqrt(), 5.0 / 18.0), (0.0, 8.0 / 18.0), (0.6_f64.sqrt(), 5.0 / 18.0)];
        let mut sum = [0.0; 3];
        for (i, j) in (0..w).flat_map(|i| (0..h).map(move |j| (i, j))) {
            for ((x, a), (y, b)) in rule.into_iter().flat_map(|x| rule.map(|y| (x, y))) {
                let (s, t) = ((i as f64 + 0.5 + 0.5 * x) / w as f64, (j as f64 + 0.5 + 0.5 * y) / h as f64);
                let to = p + u * s + v * t - at;
                let kernel = to.dot(n) * to.dot(u.cross(v)).abs() / to.length_squared().powi(2);
                let color = shown.picture.at([s as f32, t as f32]);
                for k in 0..3 {
                    sum[k] += a * b * kernel * f64::from(color[k] * shown.factor[k]) / (w * h) as f64;
                }
            }
        }
        sum
    }

    #[test]
    fn irradiance_is_that_of_a_quadrature() {
        let flip = Mapping([[-1.0, 0.0, 1.0], [0.0, 1.0, 0.0]]);
        let shapes = [
            [[-1.0, 2.0, 0.5], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
            [[1e3, 2e3, 500.0], [0.0, 900.0, 0.0], [100.0, 0.0, 2e3]],
            [[-1e-3, 2e-3, 5e-4], [2e-3, 1e-3, 0.0], [0.0, 0.0, 1e-4]],
        ];
        let mut checked = 0;
        for (size, bilinear, mapping) in [
            ([1, 1], true, Mapping::IDENTITY),
            ([37, 20], true, flip),
            ([64, 64], false, Mapping::IDENTITY),
            ([3, 130], true, Mapping::IDENTITY),
        ] {
            let shown = picture(size[0], size[1], bilinear, mapping);
            for shape @ [p, u, v] in shapes {
                let geometry = Geometry::Parallelogram(Parallelogram { p, u, v });
                let irradiance = PictureIrradiance::new(&shown, &geometry).expect("a whole picture");
                let size = (Vec3::<f32>::from(u) + Vec3::from(v)).length();
                let middle: [f32; 3] = std::array::from_fn(|k| p[k] + 0.5 * (u[k] + v[k]));
                for (k, away) in [0.4, 0.7, 1.1, 1.8, 3.0, 5.0, 20.0, 1e3].into_iter().enumerate() {
                    let turn = 2.4 * k as f32;
                    let toward = [turn.cos() * 0.8, turn.sin() * 0.8, 0.6];
                    let at: [f32; 3] = std::array::from_fn(|i| middle[i] + toward[i] * away * size);
                    let lift = [0.1, -0.2, 0.15];
                    let n = Vec3::<f32>::from(std::array::from_fn::<f32, 3, _>(|i| lift[i] - toward[i])).normalize();
                    let (sum, known) = irradiance.at(at.into(), V8::splat(n), M8::splat(true));
                    let want = quadrature(&shown, shape, at.map(f64::from), [n.x, n.y, n.z].map(f64::from));
                    if known.all() {
                        checked += 1;
                        for (got, want) in [sum.x, sum.y, sum.z].map(|x| f64::from(x.lane(3))).into_iter().zip(want) {
                            assert!((got - want).abs() <= 3e-5 * want.abs(), "{size} {shape:?} {away}: {got} {want}");
                        }
                    }
                }
            }
        }
        println!("{checked} of 96 points are known");
        assert!(checked >= 84, "{checked}");
    }

    #[test]
    fn what_is_below_the_horizon_is_dark_and_what_crosses_it_is_unknown() {
        let shown = picture(32, 32, true, Mapping::IDENTITY);
        let geometry =
            Geometry::Parallelogram(Parallelogram { p: [-1.0, 2.0, -1.0], u: [2.0, 0.0, 0.0], v: [0.0, 0.0, 2.0] });
        let irradiance = PictureIrradiance::new(&shown, &geometry).expect("a whole picture");
        let at = |p: [f32; 3], n: [f32; 3]| {
            let (sum, known) = irradiance.at(p.into(), n.into(), M8::splat(true));
            (sum.x.lane(0), known.all())
        };
        assert_eq!(at([0.0, 0.0, 0.0], [0.0, -1.0, 0.0]), (0.0, true));
        assert_eq!(at([0.0, 1.99, 0.0], [0.0, -1.0, 0.0]), (0.0, true));
        assert!(at([0.0, 0.0, 0.0], [0.0, 1.0, 0.0]).0 > 1.0);
        assert!(!at([0.0, 0.0, 0.0], [0.6, 0.0, 0.8]).1);
        assert!(!at([0.0, 1.99, 0.0], [0.0, 1.0, 0.0]).1);
        for odd in [f32::MAX, -f32::MAX, f32::NAN, f32::INFINITY, 1e-40] {
            for p in [[odd; 3], [0.0, odd, 0.0], [0.5, 2.0, odd]] {
                let (sum, is_known) = at(p, [0.6, 0.8, 0.0]);
                assert!(sum.is_finite(), "{p:?}: {sum}, {is_known}");
            }
        }
    }
}
