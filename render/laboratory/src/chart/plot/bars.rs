//! Bar charts.

use super::axis::{Axis, Scale};
use super::{Bar, Drawing, GRID, INK, PALE, ROW, TEXT, UNIT, WIDTH, escape, font, group, layer, rgb, short, stroke};
use plotters::coord::ranged1d::Ranged;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Horizontal bars on a logarithmic scale.
#[derive(Clone, Debug)]
pub struct Bars {
    /// Title above the chart.
    pub title: String,
    /// Label of the axis.
    pub label: String,
    /// Rows from top to bottom: id, name, colour, value, and whether the value supports a claim.
    pub rows: Vec<(String, String, usize, Bar, bool)>,
    /// Value at which bars begin.
    pub origin: f64,
    /// Unit written behind each value.
    pub unit: String,
}

impl Bars {
    /// Draws the chart.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let drawable = |b: &Bar| b.value.is_finite() && b.value > 0.0;
        let values = self.rows.iter().filter(|r| drawable(&r.3)).flat_map(|r| {
            let ends = if r.4 { [r.3.low, r.3.high] } else { [r.3.value; 2] };
            [r.3.value, ends[0], ends[1]]
        });
        let mut axis = Axis::new(Scale::Log, values.chain([self.origin]));
        // leaves room for the numbers behind the bars
        axis.high *= (axis.high / axis.low).powf(0.22);
        axis = Axis { scale: Scale::Log, ..Axis::new(Scale::Log, [axis.low * 1.3, axis.high / 1.3].into_iter()) };
        let (top, left, bottom) = (34, 186, 44);
        let height = top + self.rows.len() as i32 * ROW + bottom;
        let width = WIDTH - left - 12;
        let at = |v: f64| left * UNIT + axis.map(&axis.inside(v), (0, width * UNIT));
        let base = height - bottom;
        let mut body = layer(WIDTH, height, |area| {
            area.draw(&Text::new(self.title.clone(), (12 * UNIT, 8 * UNIT), font(TEXT + 1)))?;
            for v in &axis.light {
                area.draw(&PathElement::new([(at(*v), top * UNIT), (at(*v), base * UNIT)], stroke(PALE, 6)))?;
            }
            for v in &axis.bold {
                area.draw(&PathElement::new([(at(*v), top * UNIT), (at(*v), base * UNIT)], stroke(GRID, 10)))?;
                let style = font(TEXT - 1).pos(Pos::new(HPos::Center, VPos::Top));
                area.draw(&Text::new(axis.label(*v), (at(*v), (base + 5) * UNIT), style))?;
            }
            let style = font(TEXT).pos(Pos::new(HPos::Center, VPos::Top));
            area.draw(&Text::new(self.label.clone(), ((left + width / 2) * UNIT, (base + 22) * UNIT), style))
        });
        for (i, (id, name, color, bar, sure)) in self.rows.iter().enumerate() {
            let y = (top + i as i32 * ROW) * UNIT;
            let drawn = layer(WIDTH, height, |area| {
                let style = font(TEXT - 2).pos(Pos::new(HPos::Right, VPos::Center));
                let middle = y + ROW * UNIT / 2;
                area.draw(&Text::new(name.clone(), ((left - 6) * UNIT, middle), style))?;
                let value = font(TEXT - 2).pos(Pos::new(HPos::Left, VPos::Center));
                if !drawable(bar) {
                    return area.draw(&Text::new("unknown", (at(self.origin) + 6 * UNIT, middle), value));
                }
                let (a, b) = (at(self.origin), at(bar.value));
                let rectangle = [(a.min(b), y + 3 * UNIT), (a.max(b), y + (ROW - 3) * UNIT)];
                if *sure {
                    area.draw(&Rectangle::new(rectangle, rgb(*color).mix(0.75).filled()))?;
                } else {
                    let [(x0, y0), (x1, y1)] = rectangle;
                    let outline = [(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)];
                    area.draw(&PathElement::new(outline, stroke(rgb(*color), 10)))?;
                }
                let ends = [(at(bar.low), middle), (at(bar.high), middle)];
                area.draw(&PathElement::new(ends, stroke(INK, 10)))?;
                let right = b.max(a).max(ends[1].0) + 5 * UNIT;
                let known = if *sure { "" } else { " ?" };
                area.draw(&Text::new(format!("{}{}{known}", short(bar.value), self.unit), (right, middle), value))
            });
            body += &group(&format!("data-series=\"{}\"", escape(id)), &drawn);
        }
        Drawing { width: WIDTH, chart: height, legend: 0, about: self.title.clone(), body, key: String::new() }
    }
}
