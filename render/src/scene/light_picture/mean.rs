//! Means of interpolated pictures over shapes.

use super::repeats::Rows;
use crate::scene::texture::{Picture, Wrap};
use std::f64::consts::PI;
use std::ops::RangeInclusive;

/// A corner of a part of a shape: its coordinates on the surface, and its position in units of texels, where the cells between texels have
/// integer corners.
type Corner = [f64; 4];

/// The cells along one axis that a range of positions meets. Those beyond the edges of a clamped picture are part of the outermost ones.
fn cells(low: f64, high: f64, count: usize, wrap: Wrap) -> RangeInclusive<i64> {
    let [low, high] = [low, high].map(|x| x.floor() as i64);
    match wrap {
        Wrap::Clamp => low.clamp(-1, count as i64 - 1)..=high.clamp(-1, count as i64 - 1),
        _ => low..=high,
    }
}

/// Cuts off what is below `at` along one axis of a convex polygon: `below` becomes that part, and `rest` keeps the other one.
fn cut(rest: &mut Vec<Corner>, below: &mut Vec<Corner>, spare: &mut Vec<Corner>, axis: usize, at: f64) {
    below.clear();
    spare.clear();
    for (i, &corner) in rest.iter().enumerate() {
        let next = rest[(i + 1) % rest.len()];
        let is_below = corner[axis] < at;
        let side = if is_below { &mut *below } else { &mut *spare };
        side.push(corner);
        if is_below != (next[axis] < at) {
            let t = (at - corner[axis]) / (next[axis] - corner[axis]);
            let between = std::array::from_fn(|k| if k == axis { at } else { corner[k] + t * (next[k] - corner[k]) });
            below.push(between);
            spare.push(between);
        }
    }
    std::mem::swap(rest, spare);
}

/// ∫ of the weights of the four texels about a cell with this corner, over a polygon in it: exact, by the middles of the edges of its
/// triangles. The weights sum to 1.
fn weights(polygon: &[Corner], [column, row]: [f64; 2]) -> [f64; 4] {
    let mut sum = [0.0; 4];
    for pair in polygon.windows(2).skip(1) {
        let triangle = [polygon[0], pair[0], pair[1]];
        let edge = |k: usize| [triangle[k][0] - triangle[0][0], triangle[k][1] - triangle[0][1]];
        let ([a, b], [c, d]) = (edge(1), edge(2));
        let third = (a * d - b * c).abs() / 6.0;
        for k in 0..3 {
            let (p, q) = (triangle[k], triangle[(k + 1) % 3]);
            // what is beyond the edges has equal texels, whatever their weights
            let inside = |x: f64| x.clamp(0.0, 1.0);
            let (x, y) = (inside(0.5 * (p[2] + q[2]) - column), inside(0.5 * (p[3] + q[3]) - row));
            let own = [(1.0 - x) * (1.0 - y), x * (1.0 - y), (1.0 - x) * y, x * y];
            sum.iter_mut().zip(own).for_each(|(sum, weight)| *sum += third * weight);
        }
    }
    sum
}

/// Adds the integral over a part of the cell between four texels; without interpolation, the first of them is all of the cell.
fn add(picture: &Picture, [column, row]: [i64; 2], weights: [f64; 4], sum: &mut [f64; 3]) {
    let mut texel = |i: i64, j: i64, weight: f64| {
        let texel = picture.texel(column + i, row + j);
        sum.iter_mut().zip(texel).for_each(|(sum, x)| *sum += weight * f64::from(x));
    };
    if picture.bilinear {
        let [a, b, c, d] = weights;
        [(0, 0, a), (1, 0, b), (0, 1, c), (1, 1, d)].into_iter().for_each(|(i, j, weight)| texel(i, j, weight));
    } else {
        texel(0, 0, weights.iter().sum());
    }
}

/// The columns of the cells that are wholly within a part of a shape between two rows, from the first up to the last; empty if there are none.
fn whole_columns(strip: &[Corner], row: i64) -> std::ops::Range<i64> {
    let edge = |y: f64| {
        let on = strip.iter().filter(|corner| corner[3] == y).map(|corner| corner[2]);
        on.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
    };
    let [upper, lower] = [edge(row as f64), edge((row + 1) as f64)];
    let (from, to) = (upper[0].max(lower[0]).ceil(), upper[1].min(lower[1]).floor());
    if from < to { from as i64..to as i64 } else { 0..0 }
}

/// The mean over the shape with these corners in coordinates of its surface; `None` if more than `most` cells would have to be looked at.
pub(super) fn over_polygon(picture: &Picture, corners: &[[f64; 2]], most: &mut u64) -> Option<[f64; 3]> {
    let (width, height) = (picture.texels.width, picture.texels.height);
    let shift = if picture.bilinear { 0.5 } else { 0.0 };
    let place = |&[s, t]: &[f64; 2]| {
        let position = picture.mapping.0.map(|row| {
            let [a, b, c] = row.map(f64::from);
            a * s + b * t + c
        });
        [s, t, position[0] * width as f64 - shift, position[1] * height as f64 - shift]
    };
    let whole: Vec<Corner> = corners.iter().map(place).collect();
    // beyond this, positions have no fraction
    if !whole.as_flattened().iter().all(|x| x.abs() < 1e12) {
        return None;
    }
    let range = |polygon: &[Corner], axis: usize, count: usize| {
        let of = || polygon.iter().map(|corner| corner[axis]);
        let (low, high) = (of().fold(f64::INFINITY, f64::min), of().fold(f64::NEG_INFINITY, f64::max));
        cells(low, high, count, picture.wrap[axis - 2])
    };
    let count = |range: RangeInclusive<i64>| (range.end() - range.start() + 1) as u64;
    let mut sums = Rows::new(picture);
    *most = most.checked_sub(sums.cost(count(range(&whole, 3, height)), count(range(&whole, 2, width))))?;
    let area: f64 = weights(&whole, [0.0; 2]).iter().sum();
    let (mut sum, mut spare) = ([0.0; 3], Vec::new());
    let (mut left, mut row, mut cell) = (whole, Vec::new(), Vec::new());
    let rows = range(&left, 3, height);
    for y in rows.clone() {
        if y == *rows.end() {
            std::mem::swap(&mut left, &mut row);
        } else {
            cut(&mut left, &mut row, &mut spare, 3, (y + 1) as f64);
        }
        let columns = if row.is_empty() { continue } else { range(&row, 2, width) };
        let inner = whole_columns(&row, y);
        // of a clamped picture, cells beyond the edges belong to the outermost ones
        let inner = inner.start.max(columns.start() + 1)..inner.end.min(*columns.end());
        let mut x = *columns.start();
        while x <= *columns.end() {
            if x == inner.start && !inner.is_empty() {
                cut(&mut row, &mut cell, &mut spare, 2, inner.end as f64);
                // the area of each in coordinates of the surface
                let area = weights(&cell, [0.0; 2]).iter().sum::<f64>() / (inner.end - inner.start) as f64;
                let whole = sums.sum(y, inner.start, inner.end);
                (0..3).for_each(|k| sum[k] += area * whole[k]);
                x = inner.end;
                continue;
            }
            if x == *columns.end() {
                std::mem::swap(&mut row, &mut cell);
            } else {
                cut(&mut row, &mut cell, &mut spare, 2, (x + 1) as f64);
            }
            add(picture, [x, y], weights(&cell, [x as f64, y as f64]), &mut sum);
            x += 1;
        }
    }
    Some(sum.map(|sum| sum / area))
}

/// The mean over a sphere, of which each texel but for the interpolation shows the same range of angles.
pub(super) fn over_sphere(picture: &Picture) -> [f64; 3] {
    let (width, height) = (picture.texels.width, picture.texels.height);
    // ∫ of (a + bθ) sinθ is −(a + bθ) cosθ + b sinθ
    let integral = |a: f64, b: f64, from: f64, to: f64| {
        let at = |theta: f64| -(a + b * theta) * libm::cos(theta) + b * libm::sin(theta);
        at(to) - at(from)
    };
    let angle = |row: f64| PI * row.clamp(0.0, height as f64) / height as f64;
    let per_row = height as f64 / PI;
    // what a row of texels contributes: it rises up to its middle, and falls from there
    let weight = |row: usize| {
        let middle = row as f64 + 0.5;
        if !picture.bilinear {
            return integral(0.5, 0.0, angle(middle - 0.5), angle(middle + 0.5));
        }
        let rising = match row {
            0 => integral(0.5, 0.0, 0.0, angle(0.5)),
            _ => integral(0.5 * (1.0 - middle), 0.5 * per_row, angle(middle - 1.0), angle(middle)),
        };
        let falling = match row + 1 {
            last if last == height => integral(0.5, 0.0, angle(middle), PI),
            _ => integral(0.5 * (1.0 + middle), -0.5 * per_row, angle(middle), angle(middle + 1.0)),
        };
        rising + falling
    };
    let mut sum = [0.0; 3];
    for row in 0..height {
        let mut own = [0.0; 3];
        for column in 0..width {
            let texel = picture.texel(column as i64, row as i64);
            own.iter_mut().zip(texel).for_each(|(sum, x)| *sum += f64::from(x));
        }
        let weight = weight(row).max(0.0) / width as f64;
        (0..3).for_each(|k| sum[k] += weight * own[k]);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::hash64;
    use crate::scene::texture::{Colors, Mapping, Texels};
    use std::sync::Arc;

    /// Numbers in [0, 1) by index.
    fn random(index: u64) -> f64 {
        (hash64(index.wrapping_mul(0x9e37_79b9_7f4a_7c15)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn picture([width, height]: [usize; 2], rows: [[f32; 3]; 2], wrap: Wrap, bilinear: bool) -> Picture {
        // most texels are dark, and some very bright
        let color = |i: usize| [random(2 * i as u64), random(2 * i as u64 + 1).powi(8) * 100.0, 0.25].map(|x| x as f32);
        let colors = Colors::Float((0..width * height).map(color).collect());
        let texels = Arc::new(Texels { width, height, colors, alpha: None });
        Picture { texels, mapping: Mapping(rows), wrap: [wrap; 2], bilinear }
    }

    const TRIANGLE: [[f64; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

    /// The mean over the middles of a fine grid.
    fn by_grid(picture: &Picture, is_triangle: bool) -> [f64; 3] {
        let (n, mut sum, mut count) = (600, [0.0; 3], 0.0);
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let [s, t] = [i, j].map(|k| (f64::from(k) + 0.5) / f64::from(n));
            // half of a square on the diagonal is in the triangle
            let weight = if !is_triangle || i + j + 1 < n { 1.0 } else { 0.5 * f64::from(u8::from(i + j + 1 == n)) };
            let color = picture.at([s as f32, t as f32]);
            (0..3).for_each(|k| sum[k] += weight * f64::from(color[k]));
            count += weight;
        }
        sum.map(|x| x / count)
    }

    #[test]
    fn means_are_those_of_a_fine_grid() {
        let turned = [[0.7, -0.4, 0.3], [0.5, 0.6, -0.2]];
        for (size, rows) in [
            ([5, 4], [[1.0, 0.0, 0.0], [0.0, -1.0, 1.0]]),
            ([5, 4], turned),
            ([1, 1], turned),
            // larger than the picture, a part of a texel, and beyond the edges
            ([3, 7], [[2.5, 1.0, -1.0], [-0.5, 3.0, 0.25]]),
            ([8, 8], [[0.01, 0.0, 0.4], [0.0, 0.02, 0.7]]),
            ([4, 4], [[1.0, 0.0, 3.0], [0.0, 1.0, -5.0]]),
            // along a line, and at a point
            ([6, 5], [[0.6, 0.6, 0.1], [0.3, 0.3, 0.1]]),
            ([6, 5], [[0.0, 0.0, 0.6], [0.0, 0.0, 0.3]]),
        ] {
            for wrap in [Wrap::Clamp, Wrap::Repeat, Wrap::Mirror, Wrap::Black] {
                for (bilinear, is_triangle) in [(true, false), (true, true), (false, false), (false, true)] {
                    let picture = picture(size, rows, wrap, bilinear);
                    let corners = if is_triangle { &TRIANGLE[..] } else { &SQUARE[..] };
                    let mean = over_polygon(&picture, corners, &mut 1_000_000).unwrap();
                    let truth = by_grid(&picture, is_triangle);
                    for k in 0..3 {
                        // the grid's own error is that of the steps between texels that are not interpolated
                        let allowed = if bilinear { 2e-4 } else { 1e-2 } * (truth[k] + 0.05);
                        assert!(
                            (mean[k] - truth[k]).abs() <= allowed,
                            "{size:?} {rows:?} {wrap:?} {bilinear} {is_triangle}: {mean:?}, {truth:?}"
                        );
                    }
                }
            }
        }
    }

    /// A single bright texel is never lost: its part of the mean is that of its own tent.
    #[test]
    fn no_texel_is_lost() {
        let (width, height) = (9_usize, 6_usize);
        for bright in 0..width * height {
            let mut colors = vec![[0.0; 3]; width * height];
            colors[bright] = [1.0, 0.0, 1e-30];
            let texels = Arc::new(Texels { width, height, colors: Colors::Float(colors), alpha: None });
            let mapping = Mapping([[1.0, 0.0, 0.0], [0.0, -1.0, 1.0]]);
            let picture = Picture { texels, mapping, wrap: [Wrap::Clamp; 2], bilinear: true };
            let mean = over_polygon(&picture, &SQUARE, &mut 1000).unwrap();
            let share = 1.0 / (width * height) as f64;
            assert!((mean[0] / share - 1.0).abs() < 1e-12 && mean[1] == 0.0, "{bright}: {mean:?}");
            assert!((mean[2] / (1e-30 * share) - 1.0).abs() < 1e-6, "{bright}: {mean:?}");
            assert!(over_sphere(&picture)[0] > 0.1 * share / (height as f64), "{bright}");
        }
    }

    #[test]
    fn means_over_spheres_are_those_of_a_fine_grid() {
        for (size, bilinear) in [([4, 3], true), ([1, 1], true), ([3, 1], true), ([2, 9], true), ([4, 5], false)] {
            let picture = picture(size, [[1.0, 0.0, 0.0], [0.0, -1.0, 1.0]], Wrap::Clamp, bilinear);
            let (n, mut truth) = (1200, [0.0; 3]);
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let [s, t] = [i, j].map(|k| (f64::from(k) + 0.5) / f64::from(n));
                let weight = (PI * t).sin() * PI / 2.0 / f64::from(n * n);
                let color = picture.at([s as f32, t as f32]);
                (0..3).for_each(|k| truth[k] += weight * f64::from(color[k]));
            }
            let mean = over_sphere(&picture);
            assert!((mean[2] - 0.25).abs() < 1e-12, "{size:?}: {mean:?} where the last channel is 0.25 everywhere");
            for k in 0..3 {
                assert!((mean[k] - truth[k]).abs() <= 2e-4 * (truth[k] + 0.05), "{size:?}: {mean:?}, {truth:?}");
            }
        }
    }

    /// A picture that is repeated too often is left to its mean.
    #[test]
    fn the_number_of_cells_is_limited() {
        let many = picture([8, 8], [[1e6, 0.0, 0.0], [0.0, 1e6, 0.0]], Wrap::Repeat, true);
        let mut most = 1 << 20;
        assert_eq!((over_polygon(&many, &SQUARE, &mut most), most), (None, 1 << 20));
        let clamped = Picture { wrap: [Wrap::Clamp; 2], ..many.clone() };
        assert!(over_polygon(&clamped, &SQUARE, &mut most).is_some() && most == (1 << 20) - 81, "{most}");
        let infinite = Picture { mapping: Mapping([[f32::INFINITY, 0.0, 0.0], [0.0, 1.0, 0.0]]), ..many };
        assert_eq!(over_polygon(&infinite, &SQUARE, &mut most), None);
    }
}
