//! Drawings as SVG, made of one part per series, and the elements that they consist of. Lengths are in CSS pixels.

use super::text::escape;
use etendue_render::Sampler;
use std::fmt::Write;

pub(super) const WIDTH: f64 = 480.0;
pub(super) const HEIGHT: f64 = 350.0;
/// Height of a row of a legend.
pub(super) const ROW: f64 = 19.0;
/// Height of letters.
pub(super) const TEXT: f64 = 13.0;
pub(super) const INK: &str = "#333";
pub(super) const GRID: &str = "#e1e1e1";
pub(super) const PALE: &str = "#f3f3f3";
pub(super) const GUIDE: &str = "#828282";

/// Colours that are distinguishable with colour blindness (Okabe and Ito), followed by others.
const PALETTE: [[u8; 3]; 11] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [204, 121, 167],
    [230, 159, 0],
    [86, 180, 233],
    [110, 80, 30],
    [90, 60, 150],
    [120, 130, 140],
    [0, 0, 0],
    [150, 150, 0],
];

/// The colour of the n-th series.
#[must_use]
pub fn color(n: usize) -> String {
    let [r, g, b] = PALETTE[n % PALETTE.len()];
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Lengths of dashes and gaps of the line of each sampler; the first is a solid line.
const DASHES: [&str; Sampler::ALL.len()] = ["none", "7 4", "2 3", "12 3", "4 2", "12 4 2 4"];

/// Lengths of dashes and gaps of the n-th line style.
#[must_use]
pub fn dash(n: usize) -> &'static str {
    DASHES[n % DASHES.len()]
}

/// A place in a drawing, from its upper left corner to the right and down.
pub(super) type DrawingPoint = [f64; 2];

/// Colour, width and dashes of a line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stroke<'a>(pub(super) &'a str, pub(super) f64, pub(super) &'static str);

/// SVG elements, the last one on top.
#[derive(Clone, Debug, Default)]
pub(super) struct Layer(pub(super) String);

/// Which part of a text is at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

fn points(places: &[DrawingPoint]) -> String {
    let list: Vec<String> = places.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
    list.join(" ")
}

impl Layer {
    /// Joins places by lines.
    pub(super) fn line(&mut self, places: &[DrawingPoint], Stroke(color, width, dash): Stroke<'_>) {
        let dash = if dash == "none" { String::new() } else { format!(" stroke-dasharray=\"{dash}\"") };
        let points = points(places);
        let _ = writeln!(
            self.0,
            "<polyline points=\"{points}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\"{dash}/>"
        );
    }
    /// A polygon.
    pub(super) fn polygon(&mut self, places: &[DrawingPoint], fill: &str, edge: &str) {
        let _ = writeln!(self.0, "<polygon points=\"{}\" fill=\"{fill}\" stroke=\"{edge}\"/>", points(places));
    }
    /// A line of text, whose base line is at y.
    pub(super) fn text(&mut self, [x, y]: DrawingPoint, anchor: Anchor, size: f64, color: &str, text: &str) {
        let anchor = ["start", "middle", "end"][anchor as usize];
        let text = escape(text);
        let _ = writeln!(
            self.0,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\" text-anchor=\"{anchor}\" fill=\"{color}\" stroke=\"#fff\" \
             stroke-width=\"3\" paint-order=\"stroke\">{text}</text>"
        );
    }
    /// Elements around a place with what a reader sees who points near it.
    pub(super) fn pointed(&mut self, about: &str, [x, y]: DrawingPoint, elements: &Self) {
        let (about, elements) = (escape(about), &elements.0);
        let _ = writeln!(
            self.0,
            "<g><title>{about}</title><circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"8\" opacity=\"0\"/>\n{elements}</g>"
        );
    }
    /// A group of elements with these attributes.
    pub(super) fn group(&mut self, attributes: &str, elements: &Self) {
        let _ = write!(self.0, "<g {attributes}>\n{}</g>\n", elements.0);
    }
}

/// The part of a drawing that belongs to one series.
#[derive(Clone, Debug)]
pub(super) struct Part {
    /// Identifier of the series in a page.
    pub(super) id: String,
    /// Whether it is visible until the reader chooses otherwise.
    pub(super) shown: bool,
    pub(super) body: Layer,
}

/// A drawing of a chart with its legend below. Its series are separate groups, which a page can hide.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// Height without the legend.
    pub(super) height: f64,
    /// Height of the legend.
    pub(super) legend: f64,
    /// Description for screen readers.
    pub(super) about: String,
    /// Title, axes and guides.
    pub(super) frame: Layer,
    pub(super) parts: Vec<Part>,
    /// The legend.
    pub(super) key: Layer,
}

impl Drawing {
    fn svg(&self, height: f64, contents: &str) -> String {
        let about = escape(&self.about);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" width=\"{WIDTH}\" height=\"{height}\" role=\"img\" \
             aria-label=\"{about}\" font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{contents}\
             </svg>\n"
        )
    }
    /// The parts, or only those shown.
    fn series(&self, all: bool) -> String {
        let mut layer = Layer::default();
        for part in self.parts.iter().filter(|p| all || p.shown) {
            let class = if part.shown { " data-best=\"\"" } else { " class=\"off\"" };
            let class = if all { class } else { "" };
            layer.group(&format!("data-series=\"{}\"{class}", escape(&part.id)), &part.body);
        }
        layer.0
    }
    /// A stand-alone SVG of the series that are shown, with the legend.
    #[must_use]
    pub fn file(&self) -> String {
        self.svg(self.height + self.legend, &[&*self.frame.0, &self.series(false), &self.key.0].concat())
    }
    /// An SVG of all series without the legend, for a page that has its own and can show those that are hidden at first.
    #[must_use]
    pub fn inline(&self) -> String {
        self.svg(self.height, &[&*self.frame.0, &self.series(true)].concat())
    }
}
