//! Charts of lines and points.

use super::axis::{Axis, Bar, Scale};
use super::canvas::{
    Area, Drawing, Drawn, GRID, GUIDE, HEIGHT, INK, PALE, Part, ROW, TEXT, UNIT, WIDTH, dash, font, group, layer, rgb,
    stroke,
};
use super::text::short;
use plotters::element::DashedPathElement;
use plotters::prelude::*;

/// A point with error bars.
#[derive(Clone, Copy, Debug)]
pub struct Dot {
    /// Abscissa.
    pub x: Bar,
    /// Ordinate.
    pub y: Bar,
    /// Whether the interval is narrow enough to support a claim; otherwise the point is hollow.
    pub sure: bool,
}

/// One series.
#[derive(Clone, Debug)]
pub struct Line {
    /// Identifier in a page.
    pub id: String,
    /// Name in the legend.
    pub name: String,
    /// Index of the colour.
    pub color: usize,
    /// Index of the line style.
    pub dash: usize,
    /// Whether a page shows it at first; files contain only what is shown.
    pub shown: bool,
    /// Points in the order in which they are joined.
    pub dots: Vec<Dot>,
}

/// A chart of lines and points.
#[derive(Clone, Debug)]
pub struct Chart {
    /// Title above the chart.
    pub title: String,
    /// Label of the x axis.
    pub x_label: String,
    /// Label of the y axis.
    pub y_label: String,
    /// Scales of x and y.
    pub scales: [Scale; 2],
    /// The series.
    pub lines: Vec<Line>,
    /// Slopes of guide lines, in a log-log chart.
    pub guides: Vec<f64>,
}

/// A marker, filled if `sure`, otherwise hollow.
fn marker((x, y): (i32, i32), n: usize, color: RGBColor, sure: bool) -> Polygon<(i32, i32)> {
    let style = if sure { color.filled() } else { WHITE.filled() };
    Polygon::new(outline(n).into_iter().map(|(dx, dy)| (x + dx, y + dy)).collect::<Vec<_>>(), style)
}

/// Number of markers: one for each sampler.
const MARKERS: usize = 7;

/// Corners of the n-th marker relative to its centre.
fn outline(n: usize) -> Vec<(i32, i32)> {
    let r = 3.4 * f64::from(UNIT);
    let regular = |count: usize, turn: f64, size: f64| {
        (0..count)
            .map(|i| {
                let angle = (i as f64 / count as f64 + turn) * std::f64::consts::TAU;
                ((size * r * angle.cos()).round() as i32, (size * r * angle.sin()).round() as i32)
            })
            .collect()
    };
    match n % MARKERS {
        0 => regular(24, 0.0, 1.0),
        1 => regular(4, 0.125, 1.2),
        2 => regular(3, -0.25, 1.35),
        3 => regular(4, 0.0, 1.3),
        4 => regular(3, 0.25, 1.35),
        5 => regular(5, -0.25, 1.25),
        _ => regular(3, 0.0, 1.35),
    }
}

impl Chart {
    /// Draws the chart.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let sure = |d: &&Dot| d.sure;
        let dots = || self.lines.iter().flat_map(|l| &l.dots);
        // wide intervals do not stretch the axes
        let across = dots().map(|d| d.x.value).chain(dots().filter(sure).flat_map(|d| [d.x.low, d.x.high]));
        let upwards = dots().map(|d| d.y.value).chain(dots().filter(sure).flat_map(|d| [d.y.low, d.y.high]));
        let axes = [Axis::new(self.scales[0], across), Axis::new(self.scales[1], upwards)];

        let mut frame = layer(WIDTH, HEIGHT, |area| self.frame(area, &axes));
        frame += &group("class=\"guides\"", &self.plane(&axes, |plane| self.draw_guides(plane, &axes)));
        let part = |line: &Line| {
            let body = self.plane(&axes, |plane| draw_line(plane, line, &axes));
            Part { id: line.id.clone(), shown: line.shown, body }
        };
        let parts = self.lines.iter().map(part).collect();
        let shown: Vec<&Line> = self.lines.iter().filter(|l| l.shown).collect();
        let (key, legend) = legend(&shown, HEIGHT);
        Drawing { width: WIDTH, height: HEIGHT, legend, about: self.title.clone(), frame, parts, key, row: 0 }
    }

    /// Draws axes and labels.
    fn frame<'a>(&self, area: &Area<'a>, axes: &[Axis; 2]) -> Drawn<'a> {
        let mut chart = self.builder(area, true).build_cartesian_2d(axes[0].clone(), axes[1].clone())?;
        let (x, y) = (axes[0].clone(), axes[1].clone());
        chart
            .configure_mesh()
            .x_desc(&self.x_label)
            .y_desc(&self.y_label)
            .axis_desc_style(font(TEXT))
            .label_style(font(TEXT - 1))
            .x_label_formatter(&move |v| x.label(*v))
            .y_label_formatter(&move |v| y.label(*v))
            .bold_line_style(stroke(GRID, 10))
            .light_line_style(stroke(PALE, 6))
            .axis_style(stroke(INK, 10))
            .set_all_tick_mark_size(4 * UNIT)
            .draw()
    }

    fn builder<'a, 'b, 'c>(&'b self, area: &'a Area<'c>, titled: bool) -> ChartBuilder<'a, 'b, SVGBackend<'c>> {
        let mut builder = ChartBuilder::on(area);
        // the same margins whether or not the title is drawn
        let title = TextStyle {
            color: if titled { INK.to_backend_color() } else { TRANSPARENT.to_backend_color() },
            ..font(TEXT + 1)
        };
        builder
            .caption(&self.title, title)
            .margin(8 * UNIT)
            .margin_right(14 * UNIT)
            .x_label_area_size(40 * UNIT)
            .y_label_area_size(58 * UNIT);
        builder
    }

    /// Draws a layer between the axes.
    fn plane(
        &self,
        axes: &[Axis; 2],
        draw: impl for<'a> FnOnce(&DrawingArea<SVGBackend<'a>, Cartesian2d<Axis, Axis>>) -> Drawn<'a>,
    ) -> String {
        layer(WIDTH, HEIGHT, |area| {
            let chart = self.builder(area, false).build_cartesian_2d(axes[0].clone(), axes[1].clone())?;
            draw(chart.plotting_area())
        })
    }

    /// Draws guide lines of the given slopes from the middle of the upper edge.
    fn draw_guides<'a>(
        &self,
        plane: &DrawingArea<SVGBackend<'a>, Cartesian2d<Axis, Axis>>,
        [x, y]: &[Axis; 2],
    ) -> Drawn<'a> {
        for slope in &self.guides {
            let start = (x.low * (x.high / x.low).powf(0.04), y.high / (y.high / y.low).powf(0.03));
            // up to the edge of the chart
            let reach = (x.high / start.0).min((y.low / start.1).powf(1.0 / slope));
            let reach = reach.powf(0.97);
            let end = (start.0 * reach, start.1 * reach.powf(*slope));
            let style = stroke(GUIDE, 8);
            plane.draw(&DashedPathElement::new([start, end], 3 * UNIT, 3 * UNIT, style))?;
            let share = 0.72;
            let at = (start.0 * reach.powf(share), start.1 * reach.powf(slope * share));
            let text = TextStyle { color: GUIDE.to_backend_color(), ..font(TEXT - 2) };
            let label = format!("slope {}", short(*slope).replace('-', "−"));
            plane.draw(&(EmptyElement::at(at) + Text::new(label, (4 * UNIT, -12 * UNIT), text)))?;
        }
        Ok(())
    }
}

fn draw_line<'a>(
    plane: &DrawingArea<SVGBackend<'a>, Cartesian2d<Axis, Axis>>,
    line: &Line,
    [x, y]: &[Axis; 2],
) -> Drawn<'a> {
    let color = rgb(line.color);
    let drawable = |d: &&Dot| [d.x.value, d.y.value].iter().all(|v| v.is_finite() && *v > 0.0);
    let dots: Vec<&Dot> = line.dots.iter().filter(drawable).collect();
    if dots.len() > 1 {
        let path: Vec<_> = dots.iter().map(|d| (d.x.value, d.y.value)).collect();
        let style = stroke(color, 16);
        match dash(line.dash) {
            None => plane.draw(&PathElement::new(path, style))?,
            Some((on, off)) => {
                plane.draw(&DashedPathElement::new(path, on * UNIT, off * UNIT, style))?;
            }
        }
    }
    for dot in dots {
        let (at, width) = ((dot.x.value, dot.y.value), 3 * UNIT);
        let thin = stroke(color, 9);
        for (low, high, vertical) in [(dot.y.low, dot.y.high, true), (dot.x.low, dot.x.high, false)] {
            if low >= high {
                continue;
            }
            let end = |v: f64| if vertical { (at.0, y.inside(v)) } else { (x.inside(v), at.1) };
            plane.draw(&PathElement::new([end(low), end(high)], thin))?;
            for v in [low, high] {
                let cap = if vertical { [(-width, 0), (width, 0)] } else { [(0, -width), (0, width)] };
                plane.draw(&(EmptyElement::at(end(v)) + PathElement::new(cap, thin)))?;
            }
        }
        plane.draw(&(EmptyElement::at(at) + marker((0, 0), line.dash, color, dot.sure)))?;
        if !dot.sure {
            let mut edge = outline(line.dash);
            edge.push(edge[0]);
            plane.draw(&(EmptyElement::at(at) + PathElement::new(edge, stroke(color, 10))))?;
        }
    }
    Ok(())
}

/// Draws a legend from `top` on, in two columns if the names are short; returns it with its height.
fn legend(lines: &[&Line], top: i32) -> (String, i32) {
    if lines.is_empty() {
        return (String::new(), 0);
    }
    let longest = lines.iter().map(|l| l.name.chars().count()).max().unwrap_or(0);
    let columns = if longest > 34 { 1 } else { 2 };
    let rows = (lines.len() as i32 + columns - 1) / columns;
    let height = rows * ROW + 8;
    let body = layer(WIDTH, top + height, |area| {
        for (i, line) in lines.iter().enumerate() {
            let i = i as i32;
            let (x, y) = ((12 + (i / rows) * 234) * UNIT, (top + (i % rows) * ROW + ROW / 2) * UNIT);
            let color = rgb(line.color);
            let ends = [(x, y), (x + 26 * UNIT, y)];
            match dash(line.dash) {
                None => area.draw(&PathElement::new(ends, stroke(color, 16)))?,
                Some((on, off)) => {
                    let path = DashedPathElement::new(ends, on * UNIT, off * UNIT, stroke(color, 16));
                    area.draw(&path)?;
                }
            }
            area.draw(&marker((x + 13 * UNIT, y), line.dash, color, true))?;
            area.draw(&Text::new(line.name.clone(), (x + 32 * UNIT, y - (TEXT - 2) * UNIT / 2), font(TEXT - 2)))?;
        }
        Ok(())
    });
    (body, height)
}
