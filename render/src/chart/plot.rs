//! Charts as SVG, by plotters: the one file that names it.
//!
//! Each series is a group of its own (`<g data-series="…">`), so that a page can switch it off.

use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::element::DashedPathElement;
use plotters::prelude::*;

/// Units of the drawing per unit of the chart: plotters draws at whole units.
const UNIT: i32 = 8;
const WIDTH: i32 = 480;
const HEIGHT: i32 = 350;
const ROW: i32 = 19;
const TEXT: i32 = 13;
const INK: RGBColor = RGBColor(51, 51, 51);
const GRID: RGBColor = RGBColor(225, 225, 225);
const GUIDE: RGBColor = RGBColor(130, 130, 130);

/// Colours that most eyes tell apart, after Okabe and Ito; then more.
pub const PALETTE: [[u8; 3]; 10] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [204, 121, 167],
    [230, 159, 0],
    [86, 180, 233],
    [110, 80, 30],
    [90, 60, 150],
    [0, 0, 0],
    [150, 150, 0],
];

/// The colour of the n-th.
#[must_use]
pub fn color(n: usize) -> [u8; 3] {
    PALETTE[n % PALETTE.len()]
}

fn rgb(n: usize) -> RGBColor {
    let [r, g, b] = color(n);
    RGBColor(r, g, b)
}

/// Lengths of dash and gap of the n-th style; the first is a whole line.
#[must_use]
pub fn dash(n: usize) -> Option<(i32, i32)> {
    [None, Some((7, 4)), Some((2, 3)), Some((12, 3)), Some((4, 2)), Some((1, 2)), Some((9, 6))][n % 7]
}

/// A value with the ends of its interval.
#[derive(Clone, Copy, Debug)]
pub struct Bar {
    /// The value.
    pub value: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Bar {
    /// Without an interval.
    #[must_use]
    pub const fn exact(value: f64) -> Self {
        Self { value, low: value, high: value }
    }
}

impl From<super::stats::Estimate> for Bar {
    fn from(e: super::stats::Estimate) -> Self {
        Self { value: e.value, low: e.low(), high: e.high() }
    }
}

/// A point with its error bars; hollow where it is not sure.
#[derive(Clone, Copy, Debug)]
pub struct Dot {
    /// Across.
    pub x: Bar,
    /// Upwards.
    pub y: Bar,
    /// Whether its interval is narrow enough to support a claim.
    pub sure: bool,
}

/// One series.
#[derive(Clone, Debug)]
pub struct Line {
    /// What a page calls it.
    pub id: String,
    /// In the legend.
    pub name: String,
    /// Which of the colours.
    pub color: usize,
    /// Which of the dashes.
    pub dash: usize,
    /// Whether its points are joined.
    pub joined: bool,
    /// Size of its markers, 1 as a rule and 0 for none.
    pub mark: f64,
    /// In order.
    pub dots: Vec<Dot>,
}

/// A scale of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Even steps.
    Linear,
    /// Even factors.
    Log,
    /// Even factors, ticks at powers of two.
    Binary,
}

/// A chart of lines and points.
#[derive(Clone, Debug)]
pub struct Chart {
    /// Above it.
    pub title: String,
    /// Below it.
    pub x_label: String,
    /// Beside it.
    pub y_label: String,
    /// Of x and y.
    pub scales: [Scale; 2],
    /// The series.
    pub lines: Vec<Line>,
    /// Slopes to compare with, in a chart of two logarithms.
    pub guides: Vec<f64>,
    /// Whether a unit is as long across as upwards.
    pub equal: bool,
}

/// A drawing: the chart, and below it the legend.
#[derive(Clone, Debug)]
pub struct Drawing {
    width: i32,
    chart: i32,
    legend: i32,
    /// What a reader who cannot see it is told.
    about: String,
    body: String,
    key: String,
}

impl Drawing {
    fn svg(&self, height: i32, parts: &[&str]) -> String {
        let (w, h) = (self.width * UNIT, height * UNIT);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{}\" height=\"{height}\" role=\"img\" \
             aria-label=\"{}\" font-family=\"sans-serif\">\n<rect width=\"{w}\" height=\"{h}\" fill=\"#fff\"/>\n{}</svg>\n",
            self.width,
            escape(&self.about),
            parts.concat()
        )
    }
    /// Width and height with the legend.
    #[must_use]
    pub const fn size(&self) -> [i32; 2] {
        [self.width, self.chart + self.legend]
    }
    /// A file of its own, with the legend.
    #[must_use]
    pub fn file(&self) -> String {
        self.svg(self.chart + self.legend, &[&self.body, &self.key])
    }
    /// For a page that has a legend of its own.
    #[must_use]
    pub fn inline(&self) -> String {
        self.svg(self.chart, &[&self.body])
    }
}

/// Text that is safe in HTML, and in values of attributes.
#[must_use]
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// 10 to a whole power, in small raised digits.
fn power_of_ten(exponent: i32) -> String {
    let digit = |c: char| match c {
        '-' => '⁻',
        c => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][c as usize & 15],
    };
    match exponent {
        0 => "1".to_owned(),
        1 => "10".to_owned(),
        _ => format!("10{}", exponent.to_string().chars().map(digit).collect::<String>()),
    }
}

/// A number with three digits.
#[must_use]
pub fn short(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 || !x.is_finite() {
        format!("{x}")
    } else if !(1e-3..1e5).contains(&size) {
        format!("{x:.2e}")
    } else {
        let places = (2 - size.log10().floor() as i32).max(0) as usize;
        let text = format!("{x:.places$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    }
}

/// An axis of any scale.
#[derive(Clone, Debug)]
struct Axis {
    scale: Scale,
    low: f64,
    high: f64,
    bold: Vec<f64>,
    light: Vec<f64>,
}

impl Axis {
    /// Around all of the values, with a margin.
    fn new(scale: Scale, values: impl Iterator<Item = f64>) -> Self {
        let usable = |x: &f64| x.is_finite() && (scale == Scale::Linear || *x > 0.0);
        let (low, high) =
            values.filter(usable).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        let (low, high) = if low > high { (0.5, 2.0) } else { (low, high) };
        match scale {
            Scale::Linear => {
                let span = if high > low { high - low } else { high.abs().max(1.0) };
                let (low, high) = (low - 0.05 * span, high + 0.05 * span);
                let rough = (high - low) / 6.0;
                let decade = 10_f64.powf(rough.log10().floor());
                let step = [1.0, 2.0, 5.0, 10.0].map(|k| k * decade).into_iter().find(|s| *s >= rough);
                let step = step.unwrap_or(decade);
                let ticks = ((low / step).ceil() as i64..=(high / step).floor() as i64).map(|k| k as f64 * step);
                Self { scale, low, high, bold: ticks.collect(), light: Vec::new() }
            }
            Scale::Log | Scale::Binary => {
                let margin = (high / low).powf(0.04).max(1.3);
                let (low, high) = (low / margin, high * margin);
                let base: f64 = if scale == Scale::Log { 10.0 } else { 2.0 };
                let (first, last) = (low.log(base).ceil() as i32, high.log(base).floor() as i32);
                let every = ((last - first) / 7 + 1).max(1) as usize;
                let mut bold: Vec<f64> = (first..=last).step_by(every).map(|e| base.powi(e)).collect();
                let mut light: Vec<f64> = (first..=last).map(|e| base.powi(e)).collect();
                if scale == Scale::Log && last - first < 9 {
                    let steps = (first - 1..=last).flat_map(|e| (2..10).map(move |k| f64::from(k) * 10_f64.powi(e)));
                    light.extend(steps.filter(|x| (low..=high).contains(x)));
                }
                if scale == Scale::Log && bold.len() < 2 {
                    // less than two powers of ten in view: 2 and 5 of each as well
                    let more = (first - 1..=last).flat_map(|e| [2.0, 5.0].map(|k| k * 10_f64.powi(e)));
                    bold.extend(more.filter(|x| (low..=high).contains(x)));
                    bold.sort_by(f64::total_cmp);
                }
                Self { scale, low, high, bold, light }
            }
        }
    }
    fn label(&self, x: f64) -> String {
        let exponent = x.log10().round();
        let whole = (x.log10() - exponent).abs() < 1e-9;
        match self.scale {
            Scale::Log if whole && !(-2.5..3.5).contains(&exponent) => power_of_ten(exponent as i32),
            _ => short(x),
        }
    }
    /// Into the chart, so that an interval that includes 0 ends at its edge.
    fn inside(&self, x: f64) -> f64 {
        if x.is_nan() { self.low } else { x.clamp(self.low, self.high) }
    }
}

impl Ranged for Axis {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;
    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let (low, high, x) = match self.scale {
            Scale::Linear => (self.low, self.high, *value),
            _ => (self.low.ln(), self.high.ln(), value.ln()),
        };
        let share = (x - low) / (high - low);
        limit.0 + (share * f64::from(limit.1 - limit.0)).round() as i32
    }
    fn key_points<H: KeyPointHint>(&self, hint: H) -> Vec<f64> {
        if hint.weight().allow_light_points() { self.light.clone() } else { self.bold.clone() }
    }
    fn range(&self) -> std::ops::Range<f64> {
        self.low..self.high
    }
}

type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;
/// Writing to a string does not fail; what plotters cannot draw it leaves out.
type Drawn<'a> = Result<(), DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>>;

/// What `draw` draws on a canvas of this size, without the outermost element.
fn layer(width: i32, height: i32, draw: impl for<'a> FnOnce(&Area<'a>) -> Drawn<'a>) -> String {
    let mut text = String::new();
    {
        let size = ((width * UNIT) as u32, (height * UNIT) as u32);
        let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
        if let Err(error) = draw(&area) {
            debug_assert!(false, "{error}");
        }
        let _ = area.present();
    }
    let start = text.find('>').map_or(0, |i| i + 1);
    let end = text.rfind("</svg>").unwrap_or(text.len());
    text[start..end].trim_start().to_owned()
}

fn font<'a>(size: i32) -> TextStyle<'a> {
    TextStyle::from(("sans-serif", size * UNIT).into_font()).color(&INK)
}

fn stroke(color: RGBColor, tenths: i32) -> ShapeStyle {
    color.stroke_width((tenths * UNIT / 10).max(1) as u32)
}

/// A marker at a place of a canvas: filled, or hollow where it is not sure.
fn marker((x, y): (i32, i32), (n, size): (usize, f64), color: RGBColor, sure: bool) -> Polygon<(i32, i32)> {
    let style = if sure { color.filled() } else { WHITE.filled() };
    Polygon::new(outline(n, size).into_iter().map(|(dx, dy)| (x + dx, y + dy)).collect::<Vec<_>>(), style)
}

/// Corners of the n-th marker around its middle.
fn outline(n: usize, size: f64) -> Vec<(i32, i32)> {
    let r = 3.4 * size * f64::from(UNIT);
    let regular = |count: usize, turn: f64, size: f64| {
        (0..count)
            .map(|i| {
                let angle = (i as f64 / count as f64 + turn) * std::f64::consts::TAU;
                ((size * r * angle.cos()).round() as i32, (size * r * angle.sin()).round() as i32)
            })
            .collect()
    };
    match n % 5 {
        0 => regular(24, 0.0, 1.0),
        1 => regular(4, 0.125, 1.2),
        2 => regular(3, -0.25, 1.35),
        3 => regular(4, 0.0, 1.3),
        _ => regular(3, 0.25, 1.35),
    }
}

impl Chart {
    /// Draws it.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let sure = |d: &&Dot| d.sure;
        let dots = || self.lines.iter().flat_map(|l| &l.dots);
        // the intervals of what is not sure do not stretch the axes
        let across = dots().map(|d| d.x.value).chain(dots().filter(sure).flat_map(|d| [d.x.low, d.x.high]));
        let upwards = dots().map(|d| d.y.value).chain(dots().filter(sure).flat_map(|d| [d.y.low, d.y.high]));
        let mut axes = [Axis::new(self.scales[0], across), Axis::new(self.scales[1], upwards)];
        if self.equal {
            // what the labels leave is about 400 by 270
            let [x, y] = &mut axes;
            let (middle, half) = ((x.low + x.high) / 2.0, (y.high - y.low) * 400.0 / 270.0 / 2.0);
            (x.low, x.high) = (middle - half, middle + half);
        }

        let mut body = layer(WIDTH, HEIGHT, |area| self.frame(area, &axes));
        body += &group("class=\"guides\"", &self.plane(&axes, |plane| self.draw_guides(plane, &axes)));
        for line in &self.lines {
            let drawn = self.plane(&axes, |plane| draw_line(plane, line, &axes));
            body += &group(&format!("data-series=\"{}\"", escape(&line.id)), &drawn);
        }
        let (key, legend) = legend(&self.lines, HEIGHT);
        Drawing { width: WIDTH, chart: HEIGHT, legend, about: self.title.clone(), body, key }
    }

    /// Axes and labels.
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
            .light_line_style(stroke(RGBColor(243, 243, 243), 6))
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

    /// A layer between the axes.
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

    /// Lines of the given slopes, from the middle of the upper edge.
    fn draw_guides<'a>(
        &self,
        plane: &DrawingArea<SVGBackend<'a>, Cartesian2d<Axis, Axis>>,
        [x, y]: &[Axis; 2],
    ) -> Drawn<'a> {
        for slope in &self.guides {
            let start = (x.low * (x.high / x.low).powf(0.04), y.high / (y.high / y.low).powf(0.03));
            // as far as the chart goes
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
    let drawable = |d: &&Dot| {
        let positive = |v: f64, scale| v.is_finite() && (scale == Scale::Linear || v > 0.0);
        positive(d.x.value, x.scale) && positive(d.y.value, y.scale)
    };
    let dots: Vec<&Dot> = line.dots.iter().filter(drawable).collect();
    if line.joined && dots.len() > 1 {
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
        if line.mark == 0.0 {
            continue;
        }
        if line.joined || dot.sure {
            plane.draw(&(EmptyElement::at(at) + marker((0, 0), (line.dash, line.mark), color, dot.sure)))?;
        }
        if !dot.sure {
            let mut edge = outline(line.dash, line.mark);
            edge.push(edge[0]);
            plane.draw(&(EmptyElement::at(at) + PathElement::new(edge, stroke(color, 10))))?;
        }
    }
    Ok(())
}

fn group(attributes: &str, body: &str) -> String {
    format!("<g {attributes}>\n{body}</g>\n")
}

/// Samples of the lines with their names, two to a row, from `top` on; and its height.
fn legend(lines: &[Line], top: i32) -> (String, i32) {
    if lines.is_empty() {
        return (String::new(), 0);
    }
    let rows = (lines.len() as i32 + 1) / 2;
    let height = rows * ROW + 8;
    let body = layer(WIDTH, top + height, |area| {
        for (i, line) in lines.iter().enumerate() {
            let i = i as i32;
            let (x, y) = ((12 + (i / rows) * 234) * UNIT, (top + (i % rows) * ROW + ROW / 2) * UNIT);
            let color = rgb(line.color);
            if line.joined {
                let ends = [(x, y), (x + 26 * UNIT, y)];
                match dash(line.dash) {
                    None => area.draw(&PathElement::new(ends, stroke(color, 16)))?,
                    Some((on, off)) => {
                        let path = DashedPathElement::new(ends, on * UNIT, off * UNIT, stroke(color, 16));
                        area.draw(&path)?;
                    }
                }
            }
            if line.mark > 0.0 {
                area.draw(&marker((x + 13 * UNIT, y), (line.dash, line.mark), color, true))?;
            }
            area.draw(&Text::new(line.name.clone(), (x + 32 * UNIT, y - (TEXT - 2) * UNIT / 2), font(TEXT - 2)))?;
        }
        Ok(())
    });
    (body, height)
}

/// Bars to the right, from 1, on a logarithmic scale.
#[derive(Clone, Debug)]
pub struct Bars {
    /// Above it.
    pub title: String,
    /// Below it.
    pub label: String,
    /// From top to bottom: id, name, colour, value, and whether it is sure.
    pub rows: Vec<(String, String, usize, Bar, bool)>,
    /// Where bars begin.
    pub origin: f64,
    /// How a value is written behind its bar.
    pub unit: String,
}

impl Bars {
    /// Draws it.
    #[must_use]
    pub fn draw(&self) -> Drawing {
        let drawable = |b: &Bar| b.value.is_finite() && b.value > 0.0;
        let values = self.rows.iter().filter(|r| drawable(&r.3)).flat_map(|r| {
            let ends = if r.4 { [r.3.low, r.3.high] } else { [r.3.value; 2] };
            [r.3.value, ends[0], ends[1]]
        });
        let mut axis = Axis::new(Scale::Log, values.chain([self.origin]));
        // room for the numbers behind the bars
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
                area.draw(&PathElement::new(
                    [(at(*v), top * UNIT), (at(*v), base * UNIT)],
                    stroke(RGBColor(243, 243, 243), 6),
                ))?;
            }
            for v in &axis.bold {
                area.draw(&PathElement::new([(at(*v), top * UNIT), (at(*v), base * UNIT)], stroke(GRID, 10)))?;
                let style = font(TEXT - 1).pos(plotters::style::text_anchor::Pos::new(
                    plotters::style::text_anchor::HPos::Center,
                    plotters::style::text_anchor::VPos::Top,
                ));
                area.draw(&Text::new(axis.label(*v), (at(*v), (base + 5) * UNIT), style))?;
            }
            let style = font(TEXT).pos(plotters::style::text_anchor::Pos::new(
                plotters::style::text_anchor::HPos::Center,
                plotters::style::text_anchor::VPos::Top,
            ));
            area.draw(&Text::new(self.label.clone(), ((left + width / 2) * UNIT, (base + 22) * UNIT), style))
        });
        for (i, (id, name, color, bar, sure)) in self.rows.iter().enumerate() {
            let y = (top + i as i32 * ROW) * UNIT;
            let drawn = layer(WIDTH, height, |area| {
                let style = font(TEXT - 2).pos(plotters::style::text_anchor::Pos::new(
                    plotters::style::text_anchor::HPos::Right,
                    plotters::style::text_anchor::VPos::Center,
                ));
                let middle = y + ROW * UNIT / 2;
                area.draw(&Text::new(name.clone(), ((left - 6) * UNIT, middle), style))?;
                let value = font(TEXT - 2).pos(plotters::style::text_anchor::Pos::new(
                    plotters::style::text_anchor::HPos::Left,
                    plotters::style::text_anchor::VPos::Center,
                ));
                if !drawable(bar) {
                    return area.draw(&Text::new("not known", (at(self.origin) + 6 * UNIT, middle), value));
                }
                let (a, b) = (at(self.origin), at(bar.value));
                let rectangle = [(a.min(b), y + 3 * UNIT), (a.max(b), y + (ROW - 3) * UNIT)];
                if *sure {
                    area.draw(&Rectangle::new(rectangle, rgb(*color).mix(0.75).filled()))?;
                } else {
                    area.draw(&Rectangle::new(rectangle, stroke(rgb(*color), 10)))?;
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
