//! Bar charts.

use super::axis::{Axis, Bar, Scale};
use super::drawing::{Anchor, Drawing, GRID, INK, Layer, PALE, Part, ROW, Stroke, TEXT, WIDTH, color};

/// One bar.
#[derive(Clone, Debug)]
pub struct BarRow {
    /// Identifier in a page.
    pub id: String,
    /// Name to the left of the bar.
    pub name: String,
    /// Index of the colour.
    pub color: usize,
    /// Where the bar ends.
    pub bar: Bar,
    /// The value, as it is written behind the bar.
    pub text: String,
    /// Whether the value supports a claim; otherwise the bar is hollow.
    pub sure: bool,
    /// Whether a page shows it at first; files contain only what is shown.
    pub shown: bool,
}

/// Horizontal bars on a logarithmic scale, with the axis above them, so that rows can be added and removed below.
#[derive(Clone, Debug)]
pub struct Bars {
    /// Title above the chart.
    pub title: String,
    /// Label of the axis.
    pub label: String,
    /// Rows from top to bottom.
    pub rows: Vec<BarRow>,
    /// Value at which bars begin.
    pub origin: f64,
}

/// Where the axis is, and where rows begin.
const ACROSS: [f64; 2] = [186.0, WIDTH - 12.0];
const TOP: f64 = 70.0;
/// Width of the numbers behind bars.
const NUMBER: f64 = 64.0;

fn drawable(bar: &Bar) -> bool {
    bar.value.is_finite() && bar.value > 0.0
}

impl Bars {
    /// Draws the chart.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let values = self.rows.iter().filter(|r| drawable(&r.bar)).flat_map(|r| {
            let ends = if r.sure { [r.bar.low, r.bar.high] } else { [r.bar.value; 2] };
            [r.bar.value, ends[0], ends[1]]
        });
        let mut axis = Axis::new(Scale::Log, values.chain([self.origin]));
        // leaves room for the numbers behind the bars
        axis.high *= (axis.high / axis.low).powf(0.22);
        axis = Axis::new(Scale::Log, [axis.low * 1.3, axis.high / 1.3].into_iter());
        let part = |row: &BarRow| Part { id: row.id.clone(), shown: row.shown, body: self.row(row, &axis) };
        let parts = self.rows.iter().map(part).collect();
        let (about, frame) = (self.title.clone(), self.frame(&axis));
        Drawing { height: TOP, legend: 0.0, about, frame, parts, key: Layer::default(), row: ROW }
    }

    /// Title and axis, with lines down through all rows.
    fn frame(&self, axis: &Axis) -> Layer {
        let mut layer = Layer::default();
        layer.text([12.0, 20.0], Anchor::Start, TEXT + 1.0, INK, &self.title);
        let bottom = TOP + self.rows.len() as f64 * ROW;
        for (values, stroke) in [(&axis.light, Stroke(PALE, 0.6, "none")), (&axis.bold, Stroke(GRID, 1.0, "none"))] {
            for value in values {
                let x = axis.place(*value, ACROSS);
                layer.line(&[[x, TOP], [x, bottom]], stroke);
            }
        }
        for value in &axis.bold {
            let x = axis.place(*value, ACROSS);
            layer.text([x, TOP - 6.0], Anchor::Middle, TEXT - 1.0, INK, &axis.label(*value));
        }
        // a long label ends at the edge
        let middle = 0.5 * (ACROSS[0] + ACROSS[1]).min(2.0 * (WIDTH - 8.0) - 6.2 * self.label.chars().count() as f64);
        layer.text([middle, TOP - 24.0], Anchor::Middle, TEXT, INK, &self.label);
        layer
    }

    fn row(&self, row: &BarRow, axis: &Axis) -> Layer {
        let BarRow { bar, sure, .. } = row;
        let mut layer = Layer::default();
        let (middle, base) = (TOP + 0.5 * ROW, TOP + 0.5 * ROW + 4.0);
        layer.text([ACROSS[0] - 6.0, base], Anchor::End, TEXT - 2.0, INK, &row.name);
        let at = |value: f64| axis.place(value, ACROSS);
        let origin = at(self.origin);
        if !drawable(bar) {
            layer.text([origin + 6.0, base], Anchor::Start, TEXT - 2.0, INK, &row.text);
            return layer;
        }
        let (end, color) = (at(bar.value), color(row.color));
        let [top, bottom] = [TOP + 3.0, TOP + ROW - 3.0];
        let fill = if *sure { &*color } else { "none" };
        layer.polygon(&[[origin, top], [end, top], [end, bottom], [origin, bottom]], fill, &color);
        // an interval that reaches the edge leaves room for the number, too
        let most = (ACROSS[1] - NUMBER).max(end);
        let high = at(bar.high).min(most);
        layer.line(&[[at(bar.low), middle], [high, middle]], Stroke(INK, 1.0, "none"));
        let right = end.max(origin).max(high) + 5.0;
        layer.text([right, base], Anchor::Start, TEXT - 2.0, INK, &row.text);
        let mut whole = Layer::default();
        whole.pointed(&format!("{}: {}", row.name, row.text), [0.5 * (origin + end), middle], &layer);
        whole
    }
}
