//! Pictures on lights: which texel, in proportion to its radiance and to its measure as seen from a point.

use super::cells::{Drawn, Grid, Measure, Region, STEPS};
use super::hierarchy::Hierarchy;
use crate::discrete::TableError;
use crate::real::{Real, Uint, unit_interval};
use crate::vector::Vec2;

/// A picture's hierarchy, in the caller's memory: how the radiance of each box of texels is divided among its parts.
///
/// [`on`](Self::on) puts it on a light, whose samplers then draw a texel in proportion to its radiance times its area, solid angle or
/// projected solid angle as seen from a point.
///
/// - Formula: a box of 2ᵏ × 2ᵏ texels is cut into four rows of boxes, and one of these rows into its four boxes, until one texel is left;
///   once, if k is odd, into two and two. Of the part with the radiance Lᵢ and the measure mᵢ per area, the share is Lᵢmᵢ/ΣLⱼmⱼ. What is
///   left of u₁ after the cuts between rows, and of u₀ after those between columns, is the position in the texel.
/// - Exact probabilities: each part that has radiance keeps a step of 2⁻²⁴ of `u` for each of its columns or rows, and the other steps are
///   divided in proportion to the shares, rounded to whole ones. So the pmf of a texel is what is drawn, the product of two multiples of
///   2⁻²⁴, and no texel with radiance is lost.
/// - Domain: 1 to 2²⁴ columns and rows; finite weights ≥ 0, in any unit.
/// - Cost: two steps for each factor of 4 of the longer side. Prepared for each packet of `f32x8`, a sample of 1024 × 1024 texels by solid
///   angle takes 2.3 times as long as one of the rectangle without a picture, seen from as far as it is wide, and 1.5 times from 25 times as
///   far; of 16 × 16 texels, 1.5 times and as long. (`cargo bench -p etendue-benches --bench summary -- "by solid angle"`)
/// - Source: Clarberg, Jarosz, Akenine-Möller and Jensen 2005, "Wavelet Importance Sampling", for warping by a hierarchy; measures for its
///   boxes, and steps, are ours.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'a> {
    hierarchy: Hierarchy<'a>,
    region: Region,
    /// The values between which a picture is interpolated, if it is, row by row.
    values: Option<&'a [f32]>,
}

impl<'a> Picture<'a> {
    /// Length of the buffer for w × h texels: 16(wh − 1)/15 if both are the same power of four, and less than 13wh always. Cache lines are
    /// best used if it begins at a multiple of 64 bytes.
    #[inline]
    #[must_use]
    pub const fn buffer(width: usize, height: usize) -> usize {
        Hierarchy::length([width as u32, height as u32])
    }
    /// Builds the hierarchy in the caller's buffer, of [`buffer`](Self::buffer) entries, from the mean radiance of each texel, row by row:
    /// its luminance, or a sum of its channels. [`mean_of_bilinear`](Self::mean_of_bilinear) is that mean where the host interpolates. Columns are u, rows v, of the
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
        let size = [width as u32, height as u32];
        Hierarchy::fill(buffer, size, weight).ok_or(TableError::Empty)?;
        Ok(Self { hierarchy: Hierarchy::new(buffer, size), region, values: None })
    }
    /// The picture that [`build`](Self::build) has left in the buffer. The contents are not checked: with others, the pmf is still what is
    /// drawn.
    ///
    /// # Errors
    /// If the length of the buffer is not that of a picture of this size.
    #[inline]
    pub fn from_buffer(buffer: &'a [f32], [width, height]: [usize; 2], region: Region) -> Result<Self, TableError> {
        let sizes = 1..=STEPS as usize;
        let fits = sizes.contains(&width) && sizes.contains(&height) && width * height <= u32::MAX as usize / 2;
        if !fits || buffer.len() != Self::buffer(width, height) {
            return Err(TableError::Length);
        }
        let size = [width as u32, height as u32];
        Ok(Self { hierarchy: Hierarchy::new(buffer, size), region, values: None })
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
        let size = [columns, rows].map(|n| n as u32);
        Hierarchy::fill(buffer, size, weight).ok_or(TableError::Empty)?;
        Ok(Self { hierarchy: Hierarchy::new(buffer, size), region: Region::Square, values: Some(values) })
    }
    /// The interpolated picture that [`interpolated`](Self::interpolated) has built in the buffer.
    ///
    /// # Errors
    /// As for [`from_buffer`](Self::from_buffer).
    #[inline]
    pub fn interpolated_from_buffer(values: &'a [f32], width: usize, buffer: &'a [f32]) -> Result<Self, TableError> {
        let height = values.len().checked_div(width).unwrap_or(0);
        if height == 0 || values.len() != width * height {
            return Err(TableError::Length);
        }
        Ok(Self { values: Some(values), ..Self::from_buffer(buffer, [width + 1, height + 1], Region::Square)? })
    }
    /// Returns the mean over the texel in column `x` and row `y` of an image that is interpolated bilinearly between the centres of its texels,
    /// and continued by its outermost ones: this is what pbrt-v4 does with pictures on lights, and Mitsuba 3 with textures that are clamped.
    ///
    /// It is ⅛, ¾ and ⅛ of a texel and its neighbours, in both directions, so that it is above 0 wherever the interpolation is.
    ///
    /// # Panics
    /// If the texel is not in the image.
    #[must_use]
    pub fn mean_of_bilinear(values: &[f32], width: usize, [x, y]: [usize; 2]) -> f32 {
        let height = values.len() / width;
        let around = |i: usize, n: usize| [(i.saturating_sub(1), 0.125), (i, 0.75), ((i + 1).min(n - 1), 0.125)];
        let row =
            |y: usize| around(x, width).map(|(x, part)| part * f64::from(values[y * width + x])).iter().sum::<f64>();
        around(y, height).map(|(y, part)| part * row(y)).iter().sum::<f64>() as f32
    }
    /// Columns and rows.
    #[inline(always)]
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        self.hierarchy.size().map(|n| n as usize)
    }
    /// The part of the surface coordinates that its light covers.
    #[inline(always)]
    #[must_use]
    pub fn region(&self) -> Region {
        self.region
    }
}

/// What samplers ask of a picture.
impl Picture<'_> {
    #[inline(always)]
    pub(super) fn grid(&self) -> Grid {
        Grid { size: self.hierarchy.size(), is_interpolated: self.values.is_some() }
    }
    /// Radiance at the corners of a cell, in which it is bilinear; none where it is constant.
    #[inline(always)]
    pub(super) fn corners<R: Real>(&self, cell: Vec2<R>) -> Option<[R; 4]> {
        let values = self.values?;
        let [width, height] = self.size().map(|n| n - 1);
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
    /// The cell that `u` draws, and the position in it.
    #[inline(always)]
    pub(super) fn draw<R: Real>(&self, u: Vec2<R>, measure: &impl Measure<R>) -> (Drawn<R>, Vec2<R>) {
        let (zero, steps) = (R::lit(0.0), R::lit(STEPS));
        let least = |x: R| x.clamped(zero, R::ONE_MINUS_EPSILON) * steps;
        let at = Vec2::new(least(u.x), least(u.y));
        let before = |axis, step, _| if axis == 0 { at.x.lt(step) } else { at.y.lt(step) };
        let drawn = self.hierarchy.walk(self.grid(), measure, before);
        // the differences are exact
        let within = |at: R, start: R, steps: R| unit_interval((at - start) / steps);
        let Drawn { start, steps, .. } = drawn;
        (drawn, Vec2::new(within(at.x, start.x, steps.x), within(at.y, start.y, steps.y)))
    }
    /// A cell, given its column and row, and how it is drawn.
    #[inline(always)]
    pub(super) fn find<R: Real>(&self, cell: Vec2<R>, measure: &impl Measure<R>) -> Drawn<R> {
        let before = |axis, _, edge| if axis == 0 { cell.x.lt(edge) } else { cell.y.lt(edge) };
        self.hierarchy.walk(self.grid(), measure, before)
    }
}
