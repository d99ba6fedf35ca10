//! Sums over the rectangles of a table, and exact draws from one of them.

use crate::discrete::TableError;

/// Steps of `u` in the unit interval.
pub(super) const STEPS: f64 = 16_777_216.0;
/// The sum of all weights, in the table's own unit.
const WHOLE: f64 = (1_u64 << 47) as f64;
/// Greatest number of columns and of rows.
const MOST_CELLS: usize = 4096;
/// A whole row, in the unit in which parts of rows are counted.
const WHOLE_ROW: u64 = 1 << 15;

/// What a portal sees of a range of columns or rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    low: f64,
    high: f64,
    first: u32,
    last: u32,
}

impl Span {
    /// The span that begins at `start` in [0, 1] and has this size, over so many cells.
    #[inline]
    pub(super) fn new(start: f64, size: f64, cells: usize) -> Self {
        let most = cells as f64;
        let low = start.clamp(0.0, 1.0) * most;
        let high = (low + size * most).max(low).min(most);
        let first = (low as u32).min(cells as u32 - 1);
        let end = high as u32;
        let last = if f64::from(end) < high { end } else { end.saturating_sub(1) };
        Self { low, high, first, last: last.clamp(first, cells as u32 - 1) }
    }
    /// Number of cells that it touches.
    #[inline]
    pub(super) fn cells(&self) -> u32 {
        self.last - self.first + 1
    }
    /// Where a cell begins, as a fraction of the span.
    #[inline]
    pub(super) fn edge(&self, cell: u32) -> f64 {
        if cell <= self.first {
            0.0
        } else if cell > self.last {
            1.0
        } else {
            ((f64::from(cell) - self.low) / (self.high - self.low)).clamp(0.0, 1.0)
        }
    }
    /// The cell at a fraction of the span.
    #[inline]
    pub(super) fn cell(&self, fraction: f64) -> u32 {
        let near = ((self.low + fraction * (self.high - self.low)) as u32).clamp(self.first, self.last);
        // rounding may have crossed an edge
        if near > self.first && fraction < self.edge(near) {
            near - 1
        } else if near < self.last && fraction >= self.edge(near + 1) {
            near + 1
        } else {
            near
        }
    }
    /// What it covers of its cell, if it has only one; else 1.
    #[inline]
    pub(super) fn part_of_one(&self) -> f64 {
        if self.first == self.last { self.high - self.low } else { 1.0 }
    }
    /// Parts of the first and the last cell that it covers, greater than 0; 1 of a single cell.
    #[inline]
    fn parts(&self) -> [f64; 2] {
        if self.first == self.last {
            return [1.0; 2];
        }
        let part = |x: f64| x.clamp(1.0 / WHOLE_ROW as f64, 1.0);
        [part(f64::from(self.first + 1) - self.low), part(self.high - f64::from(self.last))]
    }
}

/// The distribution over the cells of a span, by a function that sums the weights of the cells before one.
pub(super) struct Distribution<F> {
    span: Span,
    sum: F,
    /// Sum before the second cell.
    base: u64,
    /// Weight of the part of the first cell.
    head: f64,
    /// Weight of all.
    pub(super) total: f64,
}

impl<F: Fn(u32) -> u64> Distribution<F> {
    #[inline]
    fn new(span: Span, sum: F) -> Self {
        let [head, tail] = span.parts();
        let base = sum(span.first + 1);
        let head = base.saturating_sub(sum(span.first)) as f64 * head;
        let own = Self { span, sum, base, head, total: head };
        if span.first == span.last {
            return own;
        }
        let before = own.weight_before(span.last);
        let last = (own.sum)(span.last + 1).saturating_sub((own.sum)(span.last)) as f64;
        Self { total: before + last * tail, ..own }
    }
    /// Weight of the cells before one that is neither the first nor past the last. No cell has a negative weight: no rounding has one either.
    #[inline]
    fn weight_before(&self, cell: u32) -> f64 {
        self.head + (self.sum)(cell).saturating_sub(self.base) as f64
    }
    /// Fraction of the weight before a cell, in [0, 1].
    #[inline]
    fn share_before(&self, cell: u32) -> f64 {
        if cell <= self.span.first {
            0.0
        } else if cell > self.span.last {
            1.0
        } else if self.total > 0.0 {
            (self.weight_before(cell) / self.total).min(1.0)
        } else {
            0.0
        }
    }
}

/// Where the cells of a span are among the steps of `u`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Number of cells, of all spans, and of those before this one.
    pub(super) cells: [u32; 2],
    /// Weight of all spans, and of those before this one.
    pub(super) weights: [f64; 2],
}

/// A cell that has been drawn or found.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Found {
    pub(super) cell: u32,
    /// The first of its steps of `u`, and their number: at least 1.
    steps: [f64; 2],
    /// Where it begins in its span, and its size there, as fractions.
    part: [f64; 2],
}

impl Found {
    /// The position in the span to which `u` goes.
    #[inline]
    pub(super) fn place(&self, u: f64) -> f64 {
        let [first, count] = self.steps;
        let [start, size] = self.part;
        let within = ((u * STEPS - first) / count.max(1.0)).clamp(0.0, 1.0);
        (start + within * size).min(1.0)
    }
    /// The `u` that goes to a position in the span.
    #[inline]
    pub(super) fn invert(&self, place: f64) -> f64 {
        let [first, count] = self.steps;
        let [start, size] = self.part;
        let within = if size > 0.0 { ((place - start) / size).clamp(0.0, 1.0) } else { 0.0 };
        (first + within * count) / STEPS
    }
    /// Probability of the cell over its part of the span.
    #[inline]
    pub(super) fn density(&self) -> f64 {
        self.steps[1] / STEPS / self.part[1].max(1e-12)
    }
}

impl Place {
    /// A span alone.
    #[inline]
    pub(super) fn only(span: &Span) -> Self {
        Self { cells: [span.cells(), 0], weights: [1.0, 0.0] }
    }
    /// The step at which something begins that has so many cells and this weight before it.
    #[inline]
    pub(super) fn step(&self, cells: u32, weight: f64) -> f64 {
        let free = STEPS - f64::from(self.cells[0]);
        let share = if self.weights[0] > 0.0 { (weight / self.weights[0]).min(1.0) } else { 0.0 };
        f64::from(cells) + f64::from((share * free) as u32)
    }
    #[inline]
    fn step_of<F: Fn(u32) -> u64>(&self, own: &Distribution<F>, weight: f64, cell: u32) -> f64 {
        self.step(self.cells[1] + cell - own.span.first, self.weights[1] + weight * own.share_before(cell))
    }
    /// What is known of a cell of a distribution with this weight.
    #[inline]
    pub(super) fn find<F: Fn(u32) -> u64>(&self, own: &Distribution<F>, weight: f64, cell: u32) -> Found {
        let first = self.step_of(own, weight, cell);
        let count = (self.step_of(own, weight, cell + 1) - first).max(0.0);
        let start = own.span.edge(cell);
        Found { cell, steps: [first, count], part: [start, own.span.edge(cell + 1) - start] }
    }
    /// Draws a cell.
    #[inline]
    pub(super) fn draw<F: Fn(u32) -> u64>(&self, own: &Distribution<F>, weight: f64, u: f64) -> Found {
        let (mut low, mut high) = (own.span.first, own.span.last);
        while low < high {
            let middle = low + (high - low).div_ceil(2);
            if self.step_of(own, weight, middle) <= u * STEPS {
                low = middle;
            } else {
                high = middle - 1;
            }
        }
        self.find(own, weight, low)
    }
}

/// The sky in the coordinates of a portal, as a table of sums over its rectangles.
///
/// - Formula: weights are counted in 2⁻⁴⁷ of their sum, plus one for each texel, so that no texel is without a chance; an entry is the sum over
///   all texels of lower columns and rows. Sums and their differences are exact.
/// - Domain: 1 to 4096 columns and rows; finite weights ≥ 0, in any unit: the light that comes through each texel, so radiance times solid
///   angle.
/// - Source: Crow, "Summed-Area Tables for Texture Mapping", SIGGRAPH 1984; Bitterli, Novák and Jarosz, "Portal-Masked Environment Map
///   Sampling", EGSR 2015.
#[derive(Clone, Copy, Debug)]
pub struct PortalTable<'a> {
    /// By columns, each of height + 1 entries.
    sums: &'a [u64],
    width: usize,
    height: usize,
    /// The weight that is counted as 1.
    pub(super) unit: f64,
}

impl<'a> PortalTable<'a> {
    /// Length of the buffer for w × h texels: (w + 1)(h + 1) + 1.
    #[must_use]
    pub const fn buffer(width: usize, height: usize) -> usize {
        (width + 1) * (height + 1) + 1
    }
    fn is_size(width: usize, height: usize) -> bool {
        (1..=MOST_CELLS).contains(&width) && (1..=MOST_CELLS).contains(&height)
    }
    /// Builds the table in the caller's buffer, of [`buffer`](Self::buffer) entries, from a weight for each texel, row by row.
    ///
    /// # Errors
    /// If the lengths do not belong together, a weight is invalid, or all are 0.
    pub fn build(weights: &[f32], width: usize, buffer: &'a mut [u64]) -> Result<Self, TableError> {
        let height = weights.len().checked_div(width).unwrap_or(0);
        if !Self::is_size(width, height)
            || weights.len() != width * height
            || buffer.len() != Self::buffer(width, height)
        {
            return Err(TableError::Length);
        }
        if weights.iter().any(|w| !(0.0..=f32::MAX).contains(w)) {
            return Err(TableError::Weight);
        }
        let total: f64 = weights.iter().map(|&w| f64::from(w)).sum();
        if total <= 0.0 {
            return Err(TableError::Empty);
        }
        let (unit, sums) = buffer.split_first_mut().ok_or(TableError::Length)?;
        *unit = (total / WHOLE).to_bits();
        sums[..=height].fill(0);
        for i in 0..width {
            let (before, own) = sums[i * (height + 1)..(i + 2) * (height + 1)].split_at_mut(height + 1);
            let mut column = 0;
            own[0] = 0;
            for j in 0..height {
                column += (f64::from(weights[j * width + i]) / total * WHOLE) as u64 + 1;
                own[j + 1] = before[j + 1] + column;
            }
        }
        Self::from_buffer(buffer, width)
    }
    /// The table that [`build`](Self::build) has left in the buffer. The contents are not validated, but no contents cause a panic.
    ///
    /// # Errors
    /// If the length of the buffer is not that of a table with so many columns.
    pub fn from_buffer(buffer: &'a [u64], width: usize) -> Result<Self, TableError> {
        let (unit, sums) = buffer.split_first().ok_or(TableError::Length)?;
        let height = (sums.len() / width.saturating_add(1)).saturating_sub(1);
        if !Self::is_size(width, height) || buffer.len() != Self::buffer(width, height) {
            return Err(TableError::Length);
        }
        let unit = f64::from_bits(*unit);
        let unit = if unit > 0.0 && unit < f64::INFINITY { unit } else { f64::MIN_POSITIVE };
        Ok(Self { sums, width, height, unit })
    }
    /// Columns and rows.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }
    #[inline]
    fn sum(&self, column: u32, row: u32) -> u64 {
        self.sums.get(column as usize * (self.height + 1) + row as usize).copied().unwrap_or(0)
    }
    /// The columns, by what these rows of them weigh, in 2⁻¹⁵ of the unit.
    #[inline]
    pub(super) fn columns(&self, columns: Span, rows: Span) -> Distribution<impl Fn(u32) -> u64> {
        let parts = rows.parts().map(|part| (part * WHOLE_ROW as f64) as u64);
        let table = *self;
        Distribution::new(columns, move |column| {
            let sum = |row: u32| table.sum(column, row);
            let (first, last) = (rows.first, rows.last);
            let head = sum(first + 1).saturating_sub(sum(first)).saturating_mul(parts[0]);
            if first == last {
                return head;
            }
            let inner = sum(last).saturating_sub(sum(first + 1)).saturating_mul(WHOLE_ROW);
            let tail = sum(last + 1).saturating_sub(sum(last)).saturating_mul(parts[1]);
            head.saturating_add(inner).saturating_add(tail)
        })
    }
    /// These rows of a column.
    #[inline]
    pub(super) fn rows(&self, column: u32, rows: Span) -> Distribution<impl Fn(u32) -> u64> {
        let table = *self;
        Distribution::new(rows, move |row| table.sum(column + 1, row).saturating_sub(table.sum(column, row)))
    }
}
