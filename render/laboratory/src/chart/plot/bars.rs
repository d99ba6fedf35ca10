//! Bar charts.

use super::axis::{Axis, Bar, Scale};
use super::canvas::{Drawing, GRID, INK, PALE, Part, ROW, TEXT, UNIT, WIDTH, font, layer, rgb, stroke};
use plotters::coord::ranged1d::Ranged;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

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

impl Bars {
    /// Draws the chart.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let drawable = |b: &Bar| b.value.is_finite() && b.value > 0.0;
        let values = self.rows.iter().filter(|r| drawable(&r.bar)).flat_map(|r| {
            let ends = if r.sure { [r.bar.low, r.bar.high] } else { [r.bar.value; 2] };
            [r.bar.value, ends[0], ends[1]]
        });
        let mut axis = Axis::new(Scale::Log, values.chain([self.origin]));
        // leaves room for the numbers behind the bars
        axis.high *= (axis.high / axis.low).powf(0.22);
        axis = Axis { scale: Scale::Log, ..Axis::new(Scale::Log, [axis.low * 1.3, axis.high / 1.3].into_iter()) };
        let (top, left) = (70, 186);
        let base = top + self.rows.len() as i32 * ROW;
        let width = WIDTH - left - 12;
        let at = |v: f64| left * UNIT + axis.map(&axis.inside(v), (0, width * UNIT));
        let frame = layer(WIDTH, base, |area| {
            area.draw(&Text::new(self.title.clone(), (12 * UNIT, 8 * UNIT), font(TEXT + 1)))?;
            for v in &axis.light {
                area.draw(&PathElement::new([(at(*v), top * UNIT), (at(*v), base * UNIT)], stroke(PALE, 6)))?;
            }
            for v in &axis.bold {
                area.draw(&PathElement::new([(at(*v), top * UNIT), (at(*v), base * UNIT)], stroke(GRID, 10)))?;
                let style = font(TEXT - 1).pos(Pos::new(HPos::Center, VPos::Bottom));
                area.draw(&Text::new(axis.label(*v), (at(*v), (top - 4) * UNIT), style))?;
            }
            let style = font(TEXT).pos(Pos::new(HPos::Center, VPos::Bottom));
            area.draw(&Text::new(self.label.clone(), ((left + width / 2) * UNIT, (top - 21) * UNIT), style))
        });
        let part = |row: &BarRow| {
            let BarRow { bar, sure, .. } = row;
            let y = top * UNIT;
            let body = layer(WIDTH, base, |area| {
                let style = font(TEXT - 2).pos(Pos::new(HPos::Right, VPos::Center));
                let middle = y + ROW * UNIT / 2;
                area.draw(&Text::new(row.name.clone(), ((left - 6) * UNIT, middle), style))?;
                let value = font(TEXT - 2).pos(Pos::new(HPos::Left, VPos::Center));
                if !drawable(bar) {
                    return area.draw(&Text::new(row.text.clone(), (at(self.origin) + 6 * UNIT, middle), value));
                }
                let (a, b) = (at(self.origin), at(bar.value));
                let rectangle = [(a.min(b), y + 3 * UNIT), (a.max(b), y + (ROW - 3) * UNIT)];
                if *sure {
                    area.draw(&Rectangle::new(rectangle, rgb(row.color).mix(0.75).filled()))?;
                } else {
                    let [(x0, y0), (x1, y1)] = rectangle;
                    let outline = [(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)];
                    area.draw(&PathElement::new(outline, stroke(rgb(row.color), 10)))?;
                }
                // an interval that reaches the edge leaves room for the number, too
                let most = (left + width - 64) * UNIT;
                let ends = [(at(bar.low), middle), (at(bar.high).min(most.max(b)), middle)];
                area.draw(&PathElement::new(ends, stroke(INK, 10)))?;
                let right = b.max(a).max(ends[1].0) + 5 * UNIT;
                area.draw(&Text::new(row.text.clone(), (right, middle), value))
            });
            Part { id: row.id.clone(), shown: row.shown, body }
        };
        let parts = self.rows.iter().map(part).collect();
        let about = self.title.clone();
        Drawing { width: WIDTH, height: top, legend: 0, about, frame, parts, key: String::new(), row: ROW }
    }
}
