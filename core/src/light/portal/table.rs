//! Sums over the rectangles of a table, and exact draws from one of them.

use crate::discrete::TableError;
use core::hint::select_unpredictable;

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
    #[inline(always)]
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
    #[inline(always)]
    pub(super) fn cells(&self) -> u32 {
        self.last - self.first + 1
    }
    /// Where a cell begins, as a fraction of the span.
    #[inline(always)]
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
    #[inline(always)]
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
    #[inline(always)]
    pub(super) fn part_of_one(&self) -> f64 {
        if self.first == self.last { self.high - self.low } else { 1.0 }
    }
    /// Parts of the first and the last cell that it covers, greater than 0; 1 of a single cell.
    #[inline(always)]
    fn parts(&self) -> [f64; 2] {
        if self.first == self.last {
            return [1.0; 2];
        }
        let part = |x: f64| x.clamp(1.0 / WHOLE_ROW as f64, 1.0);
        [part(f64::from(self.first + 1) - self.low), part(self.high - f64::from(self.last))]
    }
}

/// A weight as a real number. Weights of tables that have been built are below 2⁶³; so the conversion of signed integers serves, which is
/// an instruction of its own.
#[inline(always)]
fn real(weight: u64) -> f64 {
    (weight & (u64::MAX >> 1)) as f64
}

/// The weights of cells, as sums.
pub(super) trait Sums {
    /// Sum of the weights of the cells before one, which may be the one past the last.
    fn before(&self, cell: u32) -> u64;
}

/// Columns, by what some rows of them weigh.
pub(super) struct Columns<'a> {
    table: PortalTable<'a>,
    /// The first and the last row, and the parts of them that count, in 2⁻¹⁵.
    rows: [usize; 2],
    parts: [u64; 2],
}

impl Sums for Columns<'_> {
    #[inline(always)]
    fn before(&self, cell: u32) -> u64 {
        let (sums, [first, last]) = (self.table.column(cell), self.rows);
        let part = |from: usize, to: usize, part: u64| sums[to].wrapping_sub(sums[from]).wrapping_mul(part);
        let head = part(first, first + 1, self.parts[0]);
        if first == last {
            return head;
        }
        let inner = part(first + 1, last, WHOLE_ROW);
        head.wrapping_add(inner).wrapping_add(part(last, last + 1, self.parts[1]))
    }
}

/// The rows of a column.
pub(super) struct Rows<'a> {
    /// Sums over the columns before it, and with it.
    sums: [&'a [u64]; 2],
}

impl Sums for Rows<'_> {
    #[inline(always)]
    fn before(&self, cell: u32) -> u64 {
        let [without, with] = self.sums.map(|sums| sums[cell as usize]);
        with.wrapping_sub(without)
    }
}

/// The distribution over the cells of a span.
pub(super) struct Distribution<S> {
    span: Span,
    sums: S,
    /// Sum before the second cell.
    base: u64,
    /// Weight of the part of the first cell.
    head: f64,
    /// Weight of all.
    pub(super) total: f64,
}

impl<S: Sums> Distribution<S> {
    #[inline(always)]
    fn new(span: Span, sums: S) -> Self {
        let [head, tail] = span.parts();
        let base = sums.before(span.first + 1);
        let head = real(base.saturating_sub(sums.before(span.first))) * head;
        let own = Self { span, sums, base, head, total: head };
        if span.first == span.last {
            return own;
        }
        let before = own.weight_before(span.last);
        let last = real(own.sums.before(span.last + 1).saturating_sub(own.sums.before(span.last)));
        Self { total: before + last * tail, ..own }
    }
    /// Weight of the cells before one that is neither the first nor past the last. No cell has a negative weight: no rounding has one either.
    #[inline(always)]
    fn weight_before(&self, cell: u32) -> f64 {
        self.head + real(self.sums.before(cell).saturating_sub(self.base))
    }
    /// Fraction of the weight before a cell, in [0, 1].
    #[inline(always)]
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
pub(super) struct SpanPlace {
    /// Number of cells, of all spans, and of those before this one.
    pub(super) cells: [u32; 2],
    /// Weight of all spans, and of those before this one.
    pub(super) weights: [f64; 2],
}

/// A cell that has been drawn or found.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FoundCell {
    pub(super) cell: u32,
    /// The first of its steps of `u`, and their number: at least 1.
    steps: [f64; 2],
    /// Where it begins and ends in its span, as fractions.
    ends: [f64; 2],
}

impl FoundCell {
    /// The position in the span to which `u` goes.
    #[inline(always)]
    pub(super) fn place(&self, u: f64) -> f64 {
        let [first, count] = self.steps;
        let [start, end] = self.ends;
        let within = ((u * STEPS - first) / count.max(1.0)).clamp(0.0, 1.0);
        (start + within * (end - start)).min(1.0)
    }
    /// Whether a position in the span is certainly within the cell.
    #[inline(always)]
    pub(super) fn has(&self, place: f64) -> bool {
        let [start, end] = self.ends;
        start <= place && place < end
    }
    /// The `u` that goes to a position in the span.
    #[inline(always)]
    pub(super) fn invert(&self, place: f64) -> f64 {
        let [first, count] = self.steps;
        let [start, end] = self.ends;
        let size = end - start;
        let within = if size > 0.0 { ((place - start) / size).clamp(0.0, 1.0) } else { 0.0 };
        (first + within * count) / STEPS
    }
    /// Probability of the cell over its part of the span.
    #[inline(always)]
    pub(super) fn density(&self) -> f64 {
        let [start, end] = self.ends;
        self.steps[1] / STEPS / (end - start).max(1e-12)
    }
}

impl SpanPlace {
    /// A span alone.
    #[inline(always)]
    pub(super) fn only(span: &Span) -> Self {
        Self { cells: [span.cells(), 0], weights: [1.0, 0.0] }
    }
    /// The place after this one, of a span with this weight.
    #[inline(always)]
    pub(super) fn after(&self, span: &Span, weight: f64) -> Self {
        let ([cells, before], [total, lighter]) = (self.cells, self.weights);
        Self { cells: [cells, before + span.cells()], weights: [total, lighter + weight] }
    }
    /// The step at which it begins.
    #[inline(always)]
    pub(super) fn begin(&self) -> f64 {
        self.step(self.cells[1], self.weights[1])
    }
    /// The step at which something begins that has so many cells and this weight before it.
    #[inline(always)]
    fn step(&self, cells: u32, weight: f64) -> f64 {
        let free = STEPS - f64::from(self.cells[0]);
        let share = if self.weights[0] > 0.0 { (weight / self.weights[0]).min(1.0) } else { 0.0 };
        f64::from(cells) + f64::from((share * free) as u32)
    }
    #[inline(always)]
    fn step_of<S: Sums>(&self, own: &Distribution<S>, weight: f64, cell: u32) -> f64 {
        self.step(self.cells[1] + cell - own.span.first, self.weights[1] + weight * own.share_before(cell))
    }
    /// What is known of a cell of a distribution with this weight.
    #[inline(always)]
    pub(super) fn find<S: Sums>(&self, own: &Distribution<S>, weight: f64, cell: u32) -> FoundCell {
        let first = self.step_of(own, weight, cell);
        let count = (self.step_of(own, weight, cell + 1) - first).max(0.0);
        FoundCell { cell, steps: [first, count], ends: [own.span.edge(cell), own.span.edge(cell + 1)] }
    }
    /// Begins to search for the cell to which `u` goes.
    #[inline(always)]
    pub(super) fn search<S: Sums>(&self, own: Distribution<S>, weight: f64, u: f64) -> Search<S> {
        let (free, scale) = (STEPS - f64::from(self.cells[0]), own.total / weight);
        let weight_of_step = self.weights[0] / free * scale;
        let most = (u * STEPS - f64::from(self.cells[1])) * weight_of_step - self.weights[1] * scale;
        let (cell, count) = (own.span.first, own.span.cells());
        Search { place: *self, own, weight, step: u * STEPS, most, weight_of_step, cell, count }
    }
}

/// A search for the cell to which a step of `u` goes: without divisions by where a cell begins, solved for the weight before it, which is
/// exact but for rounding.
pub(super) struct Search<S> {
    place: SpanPlace,
    own: Distribution<S>,
    weight: f64,
    /// The step, and the greatest weight before the cell: that of all cells before it, and one of them for each.
    step: f64,
    most: f64,
    weight_of_step: f64,
    /// The first of the cells that are left, and their number.
    cell: u32,
    count: u32,
}

impl<S: Sums> Search<S> {
    /// Runs searches side by side, so that none waits for the memory that another needs.
    #[inline(always)]
    pub(super) fn all(searches: &mut [Option<Self>]) {
        let mut most = 0;
        for search in searches.iter().flatten() {
            most = search.count.max(most);
        }
        while most > 1 {
            for search in searches.iter_mut().flatten() {
                search.halve();
            }
            most -= most / 2;
        }
    }
    /// Leaves half of the cells; of one cell, itself.
    #[inline(always)]
    fn halve(&mut self) {
        let half = self.count / 2;
        let middle = self.cell + half;
        let before = self.own.weight_before(middle) + f64::from(middle - self.own.span.first) * self.weight_of_step;
        self.cell = select_unpredictable(before <= self.most, middle, self.cell);
        self.count -= half;
    }
    /// What has been found.
    #[inline(always)]
    pub(super) fn found(&self) -> FoundCell {
        let span = self.own.span;
        let mut found = self.find(self.cell);
        // rounding may have crossed an edge
        while found.cell > span.first && self.step < found.steps[0] {
            found = self.find(found.cell - 1);
        }
        while found.cell < span.last && self.step >= found.steps[0] + found.steps[1] {
            found = self.find(found.cell + 1);
        }
        found
    }
    #[inline(always)]
    fn find(&self, cell: u32) -> FoundCell {
        self.place.find(&self.own, self.weight, cell)
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
    #[inline]
    #[must_use]
    pub const fn buffer(width: usize, height: usize) -> usize {
        (width + 1) * (height + 1) + 1
    }
    #[inline]
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
    #[inline]
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
    /// Sums over the rows of the columns before one. A table has one more of them than columns, each with one more entry than rows.
    #[inline(always)]
    fn column(&self, column: u32) -> &'a [u64] {
        let stride = self.height + 1;
        &self.sums[column as usize * stride..][..stride]
    }
    /// The columns, by what these rows of them weigh, in 2⁻¹⁵ of the unit.
    #[inline(always)]
    pub(super) fn columns(&self, columns: Span, rows: Span) -> Distribution<Columns<'a>> {
        let parts = rows.parts().map(|part| (part * WHOLE_ROW as f64) as u64);
        let rows = [rows.first, rows.last].map(|row| row as usize);
        Distribution::new(columns, Columns { table: *self, rows, parts })
    }
    /// These rows of a column.
    #[inline(always)]
    pub(super) fn rows(&self, column: u32, rows: Span) -> Distribution<Rows<'a>> {
        Distribution::new(rows, Rows { sums: [column, column + 1].map(|column| self.column(column)) })
    }
}
