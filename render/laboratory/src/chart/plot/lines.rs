//! Charts of lines and points.

use super::axis::{Axis, Bar, Scale};
use super::drawing::{
    Anchor, Drawing, DrawingPoint, GRID, GUIDE, HEIGHT, INK, Layer, PALE, Part, ROW, Stroke, TEXT, WIDTH, color, dash,
};

/// A point with error bars.
#[derive(Clone, Debug)]
pub struct Dot {
    /// Abscissa.
    pub x: Bar,
    /// Ordinate.
    pub y: Bar,
    /// Whether the interval is narrow enough to support a claim; otherwise the point is hollow.
    pub sure: bool,
    /// What a reader sees who points at it.
    pub about: String,
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

/// Number of markers: one for each sampler.
const MARKERS: usize = 7;

/// Corners of the n-th marker around a place.
fn marker(n: usize, [x, y]: DrawingPoint) -> Vec<DrawingPoint> {
    // number of corners, turn of the first one in parts of a circle, and size
    let (count, turn, size): (usize, f64, f64) = match n % MARKERS {
        0 => (24, 0.0, 1.0),
        1 => (4, 0.125, 1.2),
        2 => (3, -0.25, 1.35),
        3 => (4, 0.0, 1.3),
        4 => (3, 0.25, 1.35),
        5 => (5, -0.25, 1.25),
        _ => (3, 0.0, 1.35),
    };
    let corner = |i: usize| {
        let angle = (i as f64 / count as f64 + turn) * std::f64::consts::TAU;
        [x + 3.4 * size * angle.cos(), y + 3.4 * size * angle.sin()]
    };
    (0..count).map(corner).collect()
}

/// Where the axes are: from left to right, and from below.
const ACROSS: [f64; 2] = [66.0, WIDTH - 14.0];
const UPWARDS: [f64; 2] = [HEIGHT - 48.0, 30.0];
const THIN: f64 = 0.9;

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
        let mut frame = self.frame(&axes);
        frame.group("class=\"guides\"", &self.guides(&axes));
        let part = |line: &Line| Part { id: line.id.clone(), shown: line.shown, body: draw_line(line, &axes) };
        let parts = self.lines.iter().map(part).collect();
        let shown: Vec<&Line> = self.lines.iter().filter(|l| l.shown).collect();
        let (key, legend) = legend(&shown, HEIGHT);
        Drawing { height: HEIGHT, legend, about: self.title.clone(), frame, parts, key }
    }

    /// Title, axes and their labels.
    fn frame(&self, [x, y]: &[Axis; 2]) -> Layer {
        let mut layer = Layer::default();
        let ([left, right], [bottom, top]) = (ACROSS, UPWARDS);
        layer.text([WIDTH / 2.0, 20.0], Anchor::Middle, TEXT + 1.0, INK, &self.title);
        let vertical = |value: &f64| [x.place(*value, ACROSS); 2].map(|x| [x, bottom]);
        let horizontal = |value: &f64| [y.place(*value, UPWARDS); 2].map(|y| [left, y]);
        for (xs, ys, stroke) in
            [(&x.light, &y.light, Stroke(PALE, 0.6, "none")), (&x.bold, &y.bold, Stroke(GRID, 1.0, "none"))]
        {
            for [from, [across, _]] in xs.iter().map(vertical) {
                layer.line(&[from, [across, top]], stroke);
            }
            for [from, [_, height]] in ys.iter().map(horizontal) {
                layer.line(&[from, [right, height]], stroke);
            }
        }
        layer.line(&[[left, top], [left, bottom], [right, bottom]], Stroke(INK, 1.0, "none"));
        for value in &x.bold {
            let across = x.place(*value, ACROSS);
            layer.line(&[[across, bottom], [across, bottom + 4.0]], Stroke(INK, 1.0, "none"));
            layer.text([across, bottom + 17.0], Anchor::Middle, TEXT - 1.0, INK, &x.label(*value));
        }
        for value in &y.bold {
            let height = y.place(*value, UPWARDS);
            layer.line(&[[left - 4.0, height], [left, height]], Stroke(INK, 1.0, "none"));
            layer.text([left - 7.0, height + 4.0], Anchor::End, TEXT - 1.0, INK, &y.label(*value));
        }
        layer.text([0.5 * (left + right), HEIGHT - 10.0], Anchor::Middle, TEXT, INK, &self.x_label);
        let mut upright = Layer::default();
        upright.text([-0.5 * (top + bottom), 18.0], Anchor::Middle, TEXT, INK, &self.y_label);
        layer.group("transform=\"rotate(-90)\"", &upright);
        layer
    }

    /// Guide lines of the given slopes, from near the upper left corner; captions name the slopes.
    fn guides(&self, [x, y]: &[Axis; 2]) -> Layer {
        let mut layer = Layer::default();
        for slope in &self.guides {
            let start = (x.low * (x.high / x.low).powf(0.04), y.high / (y.high / y.low).powf(0.03));
            // up to the edge of the chart
            let reach = (x.high / start.0).min((y.low / start.1).powf(1.0 / slope)).powf(0.97);
            let at = |share: f64| {
                let factor = reach.powf(share);
                [x.place(start.0 * factor, ACROSS), y.place(start.1 * factor.powf(*slope), UPWARDS)]
            };
            layer.line(&[at(0.0), at(1.0)], Stroke(GUIDE, 0.8, "3 3"));
        }
        layer
    }
}

fn draw_line(line: &Line, [x, y]: &[Axis; 2]) -> Layer {
    let mut whole = Layer::default();
    let color = color(line.color);
    let drawable = |d: &&Dot| [d.x.value, d.y.value].iter().all(|v| v.is_finite() && *v > 0.0);
    let dots: Vec<&Dot> = line.dots.iter().filter(drawable).collect();
    let (across, upwards) = (|value: f64| x.place(value, ACROSS), |value: f64| y.place(value, UPWARDS));
    let at = |dot: &&Dot| [across(dot.x.value), upwards(dot.y.value)];
    if dots.len() > 1 {
        whole.line(&dots.iter().map(at).collect::<Vec<_>>(), Stroke(&color, 1.6, dash(line.dash)));
    }
    for dot in &dots {
        let mut layer = Layer::default();
        let [center, height] = at(dot);
        let thin = Stroke(&color, THIN, "none");
        if dot.y.low < dot.y.high && dot.y.high.is_finite() {
            let ends = [dot.y.low, dot.y.high].map(|v| [center, upwards(v)]);
            layer.line(&ends, thin);
            ends.iter().for_each(|[a, b]| layer.line(&[[a - 3.0, *b], [a + 3.0, *b]], thin));
        }
        if dot.x.low < dot.x.high && dot.x.high.is_finite() {
            let ends = [dot.x.low, dot.x.high].map(|v| [across(v), height]);
            layer.line(&ends, thin);
            ends.iter().for_each(|[a, b]| layer.line(&[[*a, b - 3.0], [*a, b + 3.0]], thin));
        }
        layer.polygon(&marker(line.dash, [center, height]), if dot.sure { &color } else { "#fff" }, &color);
        whole.pointed(&dot.about, [center, height], &layer);
    }
    whole
}

/// A legend from `top` on, in two columns if the names are short, with its height.
fn legend(lines: &[&Line], top: f64) -> (Layer, f64) {
    let mut layer = Layer::default();
    let longest = lines.iter().map(|l| l.name.chars().count()).max().unwrap_or(0);
    let rows = lines.len().div_ceil(if longest > 34 { 1 } else { 2 });
    for (i, line) in lines.iter().enumerate() {
        let (x, y) = (12.0 + (i / rows) as f64 * 234.0, top + ((i % rows) as f64 + 0.5) * ROW);
        let color = color(line.color);
        layer.line(&[[x, y], [x + 26.0, y]], Stroke(&color, 1.6, dash(line.dash)));
        layer.polygon(&marker(line.dash, [x + 13.0, y]), &color, &color);
        layer.text([x + 32.0, y + 4.0], Anchor::Start, TEXT - 2.0, INK, &line.name);
    }
    (layer, if rows > 0 { rows as f64 * ROW + 8.0 } else { 0.0 })
}
