//! The canvas: sizes, colours, and drawings made of one part per series. Only the modules of `plot` use plotters.

use super::text::escape;
use etendue_render::Sampler;
use plotters::prelude::*;

/// Units of the drawing per unit of the chart: plotters uses integer coordinates.
pub(super) const UNIT: i32 = 8;
pub(super) const WIDTH: i32 = 480;
pub(super) const HEIGHT: i32 = 350;
pub(super) const ROW: i32 = 19;
pub(super) const TEXT: i32 = 13;
pub(super) const INK: RGBColor = RGBColor(51, 51, 51);
pub(super) const GRID: RGBColor = RGBColor(225, 225, 225);
pub(super) const PALE: RGBColor = RGBColor(243, 243, 243);
pub(super) const GUIDE: RGBColor = RGBColor(130, 130, 130);

/// Colours that are distinguishable with colour blindness (Okabe and Ito), followed by others.
pub const PALETTE: [[u8; 3]; 11] = [
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
pub fn color(n: usize) -> [u8; 3] {
    PALETTE[n % PALETTE.len()]
}

pub(super) fn rgb(n: usize) -> RGBColor {
    let [r, g, b] = color(n);
    RGBColor(r, g, b)
}

/// Lengths of dash and gap of the line of each sampler; the first is a solid line.
const DASHES: [Option<(i32, i32)>; Sampler::Adaptive as usize + 1] =
    [None, Some((7, 4)), Some((2, 3)), Some((12, 3)), Some((4, 2)), Some((1, 2)), Some((16, 8))];

/// Lengths of dash and gap of the n-th line style.
#[must_use]
pub fn dash(n: usize) -> Option<(i32, i32)> {
    DASHES[n % DASHES.len()]
}

/// The part of a drawing that belongs to one series.
#[derive(Clone, Debug)]
pub(super) struct Part {
    /// Identifier of the series in a page.
    pub(super) id: String,
    /// Whether it is visible until the reader chooses otherwise.
    pub(super) shown: bool,
    /// The SVG elements.
    pub(super) body: String,
}

/// A drawing of a chart with its legend below. Its series are separate groups, which a page can hide.
#[derive(Clone, Debug)]
pub struct Drawing {
    pub(super) width: i32,
    /// Height without legend and stacked rows.
    pub(super) height: i32,
    pub(super) legend: i32,
    /// Description for screen readers.
    pub(super) about: String,
    /// Title, axes and guides.
    pub(super) frame: String,
    pub(super) parts: Vec<Part>,
    pub(super) key: String,
    /// Height of a row if the parts are rows, which are stacked below one another; otherwise 0.
    pub(super) row: i32,
}

impl Drawing {
    fn svg(&self, height: i32, attributes: &str, contents: &str) -> String {
        let (w, h) = (self.width * UNIT, height * UNIT);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{}\" height=\"{height}\" role=\"img\" \
             aria-label=\"{}\" font-family=\"sans-serif\"{attributes}>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{contents}\
             </svg>\n",
            self.width,
            escape(&self.about),
        )
    }
    fn rows(&self) -> i32 {
        self.row * self.parts.iter().filter(|p| p.shown).count() as i32
    }
    /// The parts, or only those shown, each below the previous one if they are rows.
    fn stacked(&self, all: bool) -> String {
        let mut text = String::new();
        let mut y = 0;
        for part in self.parts.iter().filter(|p| all || p.shown) {
            let class = if part.shown { " data-best=\"\"" } else { " class=\"off\"" };
            let class = if all { class } else { "" };
            let place = if self.row > 0 { format!(" transform=\"translate(0 {y})\"") } else { String::new() };
            text += &group(&format!("data-series=\"{}\"{class}{place}", escape(&part.id)), &part.body);
            y += if part.shown { self.row * UNIT } else { 0 };
        }
        text
    }
    /// Width and height of [`file`](Self::file).
    #[must_use]
    pub fn size(&self) -> [i32; 2] {
        [self.width, self.height + self.rows() + self.legend]
    }
    /// A stand-alone SVG of the series that are shown, with the legend.
    #[must_use]
    pub fn file(&self) -> String {
        self.svg(self.size()[1], "", &[&*self.frame, &self.stacked(false), &self.key].concat())
    }
    /// An SVG of all series without the legend, for a page that has its own and can show those that are hidden at first.
    #[must_use]
    pub fn inline(&self) -> String {
        let attributes = match self.row {
            0 => String::new(),
            row => format!(" data-top=\"{}\" data-row=\"{}\"", self.height * UNIT, row * UNIT),
        };
        self.svg(self.height + self.rows(), &attributes, &[&*self.frame, &self.stacked(true)].concat())
    }
}

pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;
/// Writing to a string never fails, and what plotters cannot draw is left out.
pub(super) type Drawn<'a> = Result<(), DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>>;

/// The SVG that `draw` creates on a canvas of this size, without the outermost element.
pub(super) fn layer(width: i32, height: i32, draw: impl for<'a> FnOnce(&Area<'a>) -> Drawn<'a>) -> String {
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

pub(super) fn font<'a>(size: i32) -> TextStyle<'a> {
    TextStyle::from(("sans-serif", size * UNIT).into_font()).color(&INK)
}

pub(super) fn stroke(color: RGBColor, tenths: i32) -> ShapeStyle {
    color.stroke_width((tenths * UNIT / 10).max(1) as u32)
}

pub(super) fn group(attributes: &str, body: &str) -> String {
    format!("<g {attributes}>\n{body}</g>\n")
}
