//! Sums over pictures that are repeated often, in time that is linear in their texels.

use crate::scene::texture::{Picture, Wrap};
use std::collections::HashMap;

/// Cells in a block of a row.
const BLOCK: i64 = 32;

/// After so many texels, a wrapped axis begins anew; `None` if it does not.
fn period(count: usize, wrap: Wrap) -> Option<i64> {
    match wrap {
        Wrap::Repeat => Some(count as i64),
        Wrap::Mirror => Some(2 * count as i64),
        Wrap::Clamp | Wrap::Black => None,
    }
}

/// The mean over all of a cell between four texels; without interpolation, it is all of the first of them.
fn cell(picture: &Picture, column: i64, row: i64) -> [f64; 3] {
    let at = |i: i64, j: i64| picture.texel(column + i, row + j).map(f64::from);
    if !picture.bilinear {
        return at(0, 0);
    }
    let corners = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)];
    std::array::from_fn(|k| corners.iter().map(|corner| 0.25 * corner[k]).sum())
}

/// Sums over whole cells of rows. No sum is a difference, so that it is 0 only where all is dark.
pub(super) struct Rows<'a> {
    picture: &'a Picture,
    /// The sums of the blocks of each row within one period; none for a row that was asked for only once, since they take all of the row.
    blocks: HashMap<i64, Option<Vec<[f64; 3]>>>,
}

impl<'a> Rows<'a> {
    pub(super) fn new(picture: &'a Picture) -> Self {
        Self { picture, blocks: HashMap::new() }
    }
    /// About how many cells must be looked at for so many rows of so many columns.
    pub(super) fn cost(&self, rows: u64, columns: u64) -> u64 {
        let [width, height] = [self.picture.texels.width, self.picture.texels.height];
        let in_blocks =
            |width: u64| rows.min(2 * height as u64).saturating_mul(width).saturating_add(rows * BLOCK as u64);
        let by_cells = rows.saturating_mul(columns);
        period(width, self.picture.wrap[0]).map_or(by_cells, |width| by_cells.min(in_blocks(width as u64)))
    }
    /// The sum over the cells of a row from a column up to another one.
    pub(super) fn sum(&mut self, row: i64, from: i64, to: i64) -> [f64; 3] {
        let picture = self.picture;
        let [width, height] = [picture.texels.width, picture.texels.height];
        let mut sum = [0.0; 3];
        let mut add = |part: [f64; 3], times: f64| (0..3).for_each(|k| sum[k] += times * part[k]);
        let Some(period_of_row) = period(width, picture.wrap[0]) else {
            // beyond the edges there is nothing, or what is there is no cell of its own
            let (from, to) = (from.max(-1), to.min(width as i64));
            (from..to).for_each(|column| add(cell(picture, column, row), 1.0));
            return sum;
        };
        let row = period(height, picture.wrap[1]).map_or(row, |period| row.rem_euclid(period));
        let is_long = to - from >= period_of_row;
        let is_first = !is_long && !self.blocks.contains_key(&row);
        if is_first {
            self.blocks.insert(row, None);
            (from..to).for_each(|column| add(cell(picture, column, row), 1.0));
            return sum;
        }
        let blocks = self.blocks.entry(row).or_default().get_or_insert_with(|| {
            let block = |start: i64| {
                let cells = (start..(start + BLOCK).min(period_of_row)).map(|column| cell(picture, column, row));
                cells.fold([0.0; 3], |sum, cell| std::array::from_fn(|k| sum[k] + cell[k]))
            };
            (0..period_of_row).step_by(BLOCK as usize).map(block).collect()
        });
        let mut at = from;
        while at < to {
            let inside = at.rem_euclid(period_of_row);
            let length = BLOCK.min(period_of_row - inside);
            if inside == 0 && to - at >= period_of_row {
                let times = (to - at) / period_of_row;
                blocks.iter().for_each(|block| add(*block, times as f64));
                at += times * period_of_row;
            } else if inside % BLOCK == 0 && to - at >= length {
                add(blocks[(inside / BLOCK) as usize], 1.0);
                at += length;
            } else {
                add(cell(picture, at, row), 1.0);
                at += 1;
            }
        }
        sum
    }
}

/// Means of a picture over blocks of 1, 4, 16, … texels, of the sums of its channels.
pub(crate) struct Pyramid<'a> {
    picture: &'a Picture,
    /// Widths and means, row by row.
    levels: Vec<(usize, Vec<f32>)>,
}

impl<'a> Pyramid<'a> {
    pub(crate) fn new(picture: &'a Picture) -> Self {
        let (mut width, mut height) = (picture.texels.width, picture.texels.height);
        let texel = |i: usize| picture.texel((i % width) as i64, (i / width) as i64).iter().sum();
        let mut levels: Vec<(usize, Vec<f32>)> = vec![(width, (0..width * height).map(texel).collect())];
        while width > 1 || height > 1 {
            let (_, finer) = &levels[levels.len() - 1];
            let (w, h) = (width.div_ceil(2), height.div_ceil(2));
            let block = |i: usize| {
                let ([x, y], mut sum, mut count) = ([i % w, i / w], 0.0, 0.0);
                for (x, y) in [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| (2 * x + i, 2 * y + j)) {
                    if x < width && y < height {
                        sum += finer[y * width + x];
                        count += 1.0_f32;
                    }
                }
                sum / count
            };
            let coarser = (0..w * h).map(block).collect();
            levels.push((w, coarser));
            (width, height) = (w, h);
        }
        Self { picture, levels }
    }
    /// The mean over blocks that cover what lies between two corners in units of texels: more than 0 where any of it is.
    pub(crate) fn about(&self, low: [f64; 2], high: [f64; 2]) -> f64 {
        // beyond this, positions have no fraction
        if !low.iter().chain(&high).all(|x| x.abs() < 1e12) {
            return self.levels.last().map_or(0.0, |(_, means)| means[0].into());
        }
        let size = [self.picture.texels.width as i64, self.picture.texels.height as i64];
        let span = (0..2).fold(1.0_f64, |span, k| span.max(high[k] - low[k]));
        let level = (libm::log2(span).floor().max(0.0) as usize).min(self.levels.len() - 1);
        let (width, means) = &self.levels[level];
        // interpolation reaches one texel further
        let blocks = |k: usize| {
            let [from, to] = [low[k].floor() as i64 - 1, high[k].ceil() as i64 + 1];
            let (step, mut all) = (1 << level, Vec::new());
            let (n, wrap) = (size[k], self.picture.wrap[k]);
            let inside = |i: i64| match wrap {
                Wrap::Repeat => i.rem_euclid(n),
                Wrap::Mirror => i.rem_euclid(2 * n).min(2 * n - 1 - i.rem_euclid(2 * n)),
                Wrap::Clamp | Wrap::Black => i.clamp(0, n - 1),
            };
            let is_across = from.div_euclid(n) != to.div_euclid(n);
            // the last block of an axis may be short: a step could pass over it
            let ends = if is_across { [0, n - 1] } else { [inside(to); 2] };
            let places = (from..=to.min(from + n)).step_by(step).map(inside).chain(ends);
            all.extend(places.map(|i| i as usize >> level));
            all.sort_unstable();
            all.dedup();
            all
        };
        let (columns, rows) = (blocks(0), blocks(1));
        let of_row = |y: &usize| columns.iter().map(|x| f64::from(means[y * width + x])).sum::<f64>();
        rows.iter().map(of_row).sum::<f64>() / (columns.len() * rows.len()) as f64
    }
}
