//! Pictures on lights: which texel, in proportion to its radiance and to its measure as seen from a point.

use super::cells::{Cells, Drawn, Halves, Level, Lower, Region, STEPS, Walk};
use crate::discrete::TableError;
use crate::real::{Real, Uint};
use crate::vector::Vec2;

/// A picture's hierarchy, in the caller's memory: how much of the radiance of each box of texels is in its lower half.
///
/// [`on`](Self::on) puts it on a light, whose samplers then draw a texel in proportion to its radiance times its area, solid angle or
/// projected solid angle as seen from a point.
///
/// - Formula: a box of 2ᵏ × 2ᵐ texels is halved along the longer side until one texel is left. Of the half with the radiance Lᵢ and the
///   measure mᵢ per area, the share is Lᵢmᵢ/(L₁m₁ + L₂m₂). What is left of u₀ after the halvings along columns, and of u₁ after those along
///   rows, is the position in the texel.
/// - Exact probabilities: a share is rounded to whole steps of 2⁻²⁴ of the `u` that it divides, and each half that has radiance keeps at
///   least a step for each of its columns or rows. So the pmf of a texel is what is drawn, the product of two multiples of 2⁻²⁴, and no
///   texel with radiance is lost.
/// - Domain: 1 to 2²⁴ columns and rows; finite weights ≥ 0, in any unit.
/// - Cost: log₂ w + log₂ h steps.
/// - Source: Clarberg, Jarosz, Akenine-Möller and Jensen 2005, "Wavelet Importance Sampling", for warping by a hierarchy; measures for its
///   boxes, and steps, are ours.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'a> {
    /// By level, from the whole picture on, and row by row: the share of the lower half.
    shares: &'a [f32],
    /// Number of cells.
    size: [u32; 2],
    region: Region,
    /// The values between which a picture is interpolated, if it is, row by row.
    values: Option<&'a [f32]>,
}

/// A level of the hierarchy in memory.
#[derive(Clone, Copy)]
struct Boxes {
    /// Where its entries begin.
    offset: u32,
    /// Boxes are 2ᵏ columns wide and as many rows high.
    log: [u32; 2],
    /// The side that is halved: 0 along columns, 1 along rows.
    axis: usize,
    /// The rows of its entries are 2ᵏ long.
    stride: u32,
}

/// The levels of a picture of this size.
struct Levels {
    size: [u32; 2],
    offset: u32,
    log: [u32; 2],
}

impl Levels {
    const fn new(size: [u32; 2]) -> Self {
        Self { size, offset: 0, log: [log2_above(size[0]), log2_above(size[1])] }
    }
    /// The next level, while a box has more than one texel.
    const fn advance(&mut self) -> Option<Boxes> {
        let log = self.log;
        if log[0] == 0 && log[1] == 0 {
            return None;
        }
        let axis = (log[1] > log[0]) as usize;
        let stride = log2_above(self.size[0]) - log[0];
        let level = Boxes { offset: self.offset, log, axis, stride };
        self.offset += self.size[1].div_ceil(1 << log[1]) << stride;
        self.log[axis] -= 1;
        Some(level)
    }
}

impl Iterator for Levels {
    type Item = Boxes;
    #[inline(always)]
    fn next(&mut self) -> Option<Boxes> {
        self.advance()
    }
}

/// The least k with 2ᵏ ≥ n.
const fn log2_above(n: u32) -> u32 {
    if n > 1 { 32 - (n - 1).leading_zeros() } else { 0 }
}

impl<'a> Picture<'a> {
    /// Length of the buffer for w × h texels: wh − 1 if both are powers of two, and less than 4wh + 64 always.
    #[must_use]
    pub const fn buffer(width: usize, height: usize) -> usize {
        let mut levels = Levels::new([width as u32, height as u32]);
        while levels.advance().is_some() {}
        levels.offset as usize
    }
    /// Builds the hierarchy in the caller's buffer, of [`buffer`](Self::buffer) entries, from the mean radiance of each texel, row by row:
    /// its luminance, or a sum of its channels. [`mean_of_bilinear`] is that mean where the host interpolates. Columns are u, rows v, of the
    /// light's surface coordinates.
    ///
    /// # Errors
    /// If the lengths do not belong together, a weight is invalid, or all are 0 within the region.
    pub fn build(weights: &[f32], width: usize, region: Region, buffer: &'a mut [f32]) -> Result<Self, TableError> {
        let height = weights.len().checked_div(width).unwrap_or(0);
        let whole = width.max(height) <= STEPS as usize && weights.len() == width * height && height > 0;
        if !whole || weights.len() > u32::MAX as usize / 2 || buffer.len() != Self::buffer(width, height) {
            return Err(TableError::Length);
        }
        if weights.iter().any(|w| !(0.0..=f32::MAX).contains(w)) {
            return Err(TableError::Weight);
        }
        let weight = |x: usize, y: usize| {
            let w = f64::from(weights[y * width + x]);
            if w > 0.0 && region != Region::Square { w * region.part([x, y], [width, height]) } else { w }
        };
        let shares = Self::fill(buffer, [width, height], weight)?;
        Ok(Self { shares, size: [width as u32, height as u32], region, values: None })
    }
    /// Fills the buffer with shares, given the weight of each cell times its area.
    fn fill(
        buffer: &'a mut [f32],
        [width, height]: [usize; 2],
        weight: impl Fn(usize, usize) -> f64,
    ) -> Result<&'a [f32], TableError> {
        let size = [width as u32, height as u32];
        let sum = |[x0, y0]: [usize; 2], [x1, y1]: [usize; 2]| -> f64 {
            (y0..y1.min(height)).map(|y| (x0..x1.min(width)).map(|x| weight(x, y)).sum::<f64>()).sum()
        };
        for Boxes { offset, log: [kx, ky], axis, stride } in Levels::new(size) {
            for (i, share) in buffer[offset as usize..].iter_mut().enumerate() {
                let (nx, ny) = (i & ((1 << stride) - 1), i >> stride);
                let ([x0, y0], [x1, y1]) = ([nx << kx, ny << ky], [(nx + 1) << kx, (ny + 1) << ky]);
                if y0 >= height {
                    break;
                }
                let [lower, upper] = if axis == 0 {
                    let middle = x0.midpoint(x1);
                    [sum([x0, y0], [middle, y1]), sum([middle, y0], [x1, y1])]
                } else {
                    let middle = y0.midpoint(y1);
                    [sum([x0, y0], [x1, middle]), sum([x0, middle], [x1, y1])]
                };
                let least = f64::from(f32::EPSILON) / 2.0;
                *share = match (lower > 0.0, upper > 0.0) {
                    // neither may be rounded away
                    (true, true) => (lower / (lower + upper)).max(f64::from(f32::MIN_POSITIVE)).min(1.0 - least) as f32,
                    (false, true) => 0.0,
                    _ => 1.0,
                };
            }
        }
        if sum([0, 0], [width, height]) > 0.0 { Ok(buffer) } else { Err(TableError::Empty) }
    }
    /// The picture that [`build`](Self::build) has left in the buffer. The contents are not checked: with others, the pmf is still what is
    /// drawn.
    ///
    /// # Errors
    /// If the length of the buffer is not that of a picture of this size.
    pub fn from_buffer(buffer: &'a [f32], [width, height]: [usize; 2], region: Region) -> Result<Self, TableError> {
        let sizes = 1..=STEPS as usize;
        let fits = sizes.contains(&width) && sizes.contains(&height) && width * height <= u32::MAX as usize / 2;
        if !fits || buffer.len() != Self::buffer(width, height) {
            return Err(TableError::Length);
        }
        Ok(Self { shares: buffer, size: [width as u32, height as u32], region, values: None })
    }
    /// Builds the hierarchy of a picture that is interpolated bilinearly between the centres of its texels, and continued by its outermost
    /// ones: what pbrt-v4 does with pictures on lights, and Mitsuba 3 with textures that are clamped. The pdf is then in proportion to the
    /// interpolated radiance: cells are between the centres of four texels.
    ///
    /// `values` is the radiance at the centres, row by row, and must live as long as the picture. The buffer has
    /// [`buffer`](Self::buffer)(width + 1, height + 1) entries, and [`size`](Self::size) is one more than that of the image.
    ///
    /// # Errors
    /// As for [`build`](Self::build).
    pub fn interpolated(values: &'a [f32], width: usize, buffer: &'a mut [f32]) -> Result<Self, TableError> {
        let height = values.len().checked_div(width).unwrap_or(0);
        let [columns, rows] = [width, height].map(|n| n + 1);
        let whole = columns.max(rows) <= STEPS as usize && values.len() == width * height && height > 0;
        if !whole || columns * rows > u32::MAX as usize / 2 || buffer.len() != Self::buffer(columns, rows) {
            return Err(TableError::Length);
        }
        if values.iter().any(|w| !(0.0..=f32::MAX).contains(w)) {
            return Err(TableError::Weight);
        }
        let value = |x: usize, y: usize| f64::from(values[y * width + x]);
        // of a cell at the rim, only a half is in the picture
        let part = |i: usize, n: usize| if i == 0 || i == n { 0.5 } else { 1.0 };
        let ends = |i: usize, n: usize| [i.saturating_sub(1), i.min(n - 1)];
        let weight = |x: usize, y: usize| {
            let ([left, right], [top, bottom]) = (ends(x, width), ends(y, height));
            let sum = value(left, top) + value(right, top) + value(left, bottom) + value(right, bottom);
            0.25 * sum * part(x, width) * part(y, height)
        };
        let shares = Self::fill(buffer, [columns, rows], weight)?;
        Ok(Self { shares, size: [columns, rows].map(|n| n as u32), region: Region::Square, values: Some(values) })
    }
    /// The interpolated picture that [`interpolated`](Self::interpolated) has built in the buffer.
    ///
    /// # Errors
    /// As for [`from_buffer`](Self::from_buffer).
    pub fn interpolated_from_buffer(values: &'a [f32], width: usize, buffer: &'a [f32]) -> Result<Self, TableError> {
        let height = values.len().checked_div(width).unwrap_or(0);
        if height == 0 || values.len() != width * height {
            return Err(TableError::Length);
        }
        Ok(Self { values: Some(values), ..Self::from_buffer(buffer, [width + 1, height + 1], Region::Square)? })
    }
    /// Columns and rows.
    #[inline(always)]
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        self.size.map(|n| n as usize)
    }
    /// The part of the surface coordinates that its light covers.
    #[inline(always)]
    #[must_use]
    pub fn region(&self) -> Region {
        self.region
    }
}

impl<R: Real> Cells<R> for Picture<'_> {
    #[inline(always)]
    fn counts(&self) -> Vec2<R> {
        let [w, h] = self.size.map(|n| R::lit(f64::from(n)));
        Vec2::new(w, h)
    }
    #[inline(always)]
    fn region(&self) -> Region {
        self.region
    }
    #[inline(always)]
    fn is_interpolated(&self) -> bool {
        self.values.is_some()
    }
    #[inline(always)]
    fn corners(&self, cell: Vec2<R>) -> Option<[R; 4]> {
        let values = self.values?;
        let [width, height] = self.size.map(|n| n as usize - 1);
        let (x, y) = (cell.x.to_uint(), cell.y.to_uint());
        let value = |right: usize, below: usize| {
            R::from_fn(|lane| {
                let at = |i: u32, next: usize, n: usize| (i as usize + next).saturating_sub(1).min(n - 1);
                let index = at(y.lane(lane), below, height) * width + at(x.lane(lane), right, width);
                R::Scalar::lit(f64::from(values.get(index).copied().unwrap_or(0.0)))
            })
        };
        Some([value(0, 0), value(1, 0), value(0, 1), value(1, 1)])
    }
    // by far the longest part: one copy for each measure
    #[inline]
    fn walk(&self, halves: &impl Halves<R>, lower: &impl Lower<R>) -> Drawn<R> {
        let mut walk = Walk::<R, Self>::of(self);
        for Boxes { offset, log, axis, stride } in Levels::new(self.size) {
            let index = {
                let [x, y] = [walk.texel[0].to_uint().shr(log[0]), walk.texel[1].to_uint().shr(log[1])];
                y.shl(stride).wrapping_add(x).wrapping_add(R::Uint::splat(offset))
            };
            let share = R::from_fn(|lane| {
                let share = self.shares.get(index.lane(lane) as usize).copied().unwrap_or(1.0);
                R::Scalar::lit(f64::from(share))
            });
            let half = R::lit(f64::from(1_u32 << (log[axis] - 1)));
            let size = R::lit(f64::from(1_u32 << log[1 - axis]));
            walk.descend(&Level { axis, half, size, share }, halves, lower);
        }
        walk.drawn()
    }
}

/// The mean over the texel in column `x` and row `y` of an image that is interpolated bilinearly between the centres of its texels, and
/// continued by its outermost ones: what pbrt-v4 does with pictures on lights, and Mitsuba 3 with textures that are clamped.
///
/// It is ⅛, ¾ and ⅛ of a texel and its neighbours, in both directions, so that it is above 0 wherever the interpolation is.
///
/// # Panics
/// If the texel is not in the image.
#[must_use]
pub fn mean_of_bilinear(values: &[f32], width: usize, [x, y]: [usize; 2]) -> f32 {
    let height = values.len() / width;
    let around = |i: usize, n: usize| [(i.saturating_sub(1), 0.125), (i, 0.75), ((i + 1).min(n - 1), 0.125)];
    let row = |y: usize| around(x, width).map(|(x, part)| part * f64::from(values[y * width + x])).iter().sum::<f64>();
    around(y, height).map(|(y, part)| part * row(y)).iter().sum::<f64>() as f32
}
