//! Arranges drawings and images on a sheet.

use crate::chart::plot::{Drawing, escape};
use base64::Engine;
use etendue_render::image;
use std::fmt::Write;

/// A part of a sheet, with sizes in CSS pixels.
#[derive(Clone, Debug)]
pub(super) struct Svg {
    width: f64,
    height: f64,
    body: String,
}

const GAP: f64 = 12.0;
const LINE: f64 = 17.0;

impl Svg {
    /// A part with a chart and its legend.
    pub(super) fn chart(drawing: &Drawing) -> Self {
        let [width, height] = drawing.size().map(f64::from);
        Self { width, height, body: drawing.file() }
    }
    /// A part with an image of this `width` below its title.
    pub(super) fn image(title: &str, size: [u32; 2], pixels: &[[u8; 3]], width: f64) -> Self {
        let png = image::encode_png(size, pixels).unwrap_or_default();
        let height = width * f64::from(size[1]) / f64::from(size[0]);
        let uri = base64::engine::general_purpose::STANDARD.encode(png);
        let body = format!(
            "<text x=\"{}\" y=\"14\" font-size=\"13\" text-anchor=\"middle\" fill=\"#333\">{}</text>\n\
             <image y=\"22\" width=\"{width}\" height=\"{height}\" style=\"image-rendering:pixelated\" \
             href=\"data:image/png;base64,{uri}\"/>\n",
            width / 2.0,
            escape(title),
        );
        Self { width, height: height + 22.0, body }
    }
    /// Arranges parts from left to right.
    pub(super) fn row(parts: Vec<Self>) -> Self {
        let height = parts.iter().map(|p| p.height).fold(0.0, f64::max);
        let (mut x, mut body) = (0.0, String::new());
        for part in parts {
            let _ = writeln!(body, "<g transform=\"translate({x} 0)\">\n{}</g>", part.body);
            x += part.width + GAP;
        }
        Self { width: (x - GAP).max(0.0), height, body }
    }
    /// Arranges parts from top to bottom, centred.
    pub(super) fn column(parts: Vec<Self>) -> Self {
        let width = parts.iter().map(|p| p.width).fold(0.0, f64::max);
        let (mut y, mut body) = (0.0, String::new());
        for part in parts {
            let _ =
                writeln!(body, "<g transform=\"translate({} {y})\">\n{}</g>", (width - part.width) / 2.0, part.body);
            y += part.height + GAP;
        }
        Self { width, height: (y - GAP).max(0.0), body }
    }
    /// Adds lines of text below, wrapped to the width.
    pub(super) fn captioned(self, lines: &[String]) -> Self {
        let (mut y, mut body) = (self.height + 20.0, self.body);
        let most = (self.width / 6.9) as usize;
        for line in lines.iter().flat_map(|l| wrapped(l, most)) {
            let _ = writeln!(body, "<text x=\"0\" y=\"{y}\" font-size=\"13\" fill=\"#333\">{}</text>", escape(&line));
            y += LINE;
        }
        Self { height: y - LINE + 6.0, body, ..self }
    }
    /// The SVG file, with a margin.
    pub(super) fn file(&self) -> String {
        let (w, h) = (self.width + 2.0 * GAP, self.height + 2.0 * GAP);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" font-family=\"sans-serif\">\n\
             <rect width=\"{w}\" height=\"{h}\" fill=\"#fff\"/>\n<g transform=\"translate({GAP} {GAP})\">\n{}</g>\n</svg>\n",
            self.body
        )
    }
}

/// Wraps text into lines of at most `most` characters.
fn wrapped(text: &str, most: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let line = lines.last_mut().unwrap_or_else(|| unreachable!("there is always a line"));
        if line.is_empty() {
            line.push_str(word);
        } else if line.chars().count() + 1 + word.chars().count() <= most {
            line.push(' ');
            line.push_str(word);
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}
