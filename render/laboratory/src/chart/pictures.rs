//! Images for comparison: what each technique renders with few samples, its error and its variance per pixel.

use super::measure::{Plan, SETS, inapplicable};
use super::outcome::Outcome;
use super::plot::{ramp, short};
use super::summary::{Summary, Way};
use crate::hash::fnv1a;
use etendue_render::{Settings, image};

/// A PNG with its name and title.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Stem of the file name.
    pub file: String,
    /// Kind of picture: `image`, `difference`, `variance` or `samples`.
    pub kind: &'static str,
    /// Title for the reader.
    pub title: String,
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Bytes of the PNG file.
    pub png: Vec<u8>,
}

/// The colours of a kind of picture, and what their ends and their middle stand for.
#[derive(Clone, Debug)]
pub struct ColorBar {
    /// Kind of picture.
    pub kind: &'static str,
    /// Colours from one end to the other, as a page writes them.
    pub colors: Vec<String>,
    /// What the first colour, the one in the middle and the last stand for.
    pub ends: [String; 3],
    /// What is shown, with its unit.
    pub title: String,
}

impl ColorBar {
    /// The bar of a map of colours, from `low` to 1.
    fn new(kind: &'static str, low: f64, color: fn(f64) -> [u8; 3], ends: [String; 3], title: &str) -> Self {
        let css = |k: u8| {
            let [r, g, b] = color(low + (1.0 - low) * f64::from(k) / 20.0);
            format!("rgb({r},{g},{b})")
        };
        Self { kind, colors: (0..=20).map(css).collect(), ends, title: title.to_owned() }
    }
}

/// The images of a scene.
#[derive(Clone, Debug)]
pub struct Panel {
    /// The scene's name.
    pub scene: String,
    /// Samples per pixel of the images.
    pub spp: u32,
    /// Pictures, starting with the reference.
    pub pictures: Vec<Picture>,
    /// Explanation of the colours.
    pub caption: String,
    /// Their bars.
    pub bars: Vec<ColorBar>,
}

/// Number of images from which variances are computed.
const REPLICATES: u32 = 4;
/// Greatest number of samples per pixel.
const SAMPLES: u32 = 16;

/// Colour map from black through red to pale yellow, for t in [0, 1].
fn heat(t: f64) -> [u8; 3] {
    const STOPS: [(f64, [u8; 3]); 6] = [
        (0.0, [0, 0, 4]),
        (0.2, [66, 10, 104]),
        (0.4, [147, 38, 103]),
        (0.6, [221, 81, 58]),
        (0.8, [252, 165, 10]),
        (1.0, [252, 255, 164]),
    ];
    ramp(&STOPS, t)
}

/// Colour map from blue through white to red, for t in [−1, 1].
fn signed(t: f64) -> [u8; 3] {
    let t = t.clamp(-1.0, 1.0);
    let end = if t < 0.0 { [33.0, 102.0, 172.0] } else { [178.0, 24.0, 43.0] };
    let s = t.abs().sqrt();
    end.map(|e| (255.0 + (e - 255.0) * s).round() as u8)
}

fn png(size: [u32; 2], pixels: impl Iterator<Item = [u8; 3]>) -> Vec<u8> {
    let pixels: Vec<_> = pixels.collect();
    image::encode_png(size, &pixels).unwrap_or_default()
}

/// Upper end of the colour scale for sample counts.
const MOST_SAMPLES: f64 = 4096.0;

/// The first of several replicates of an image, and the variance of each pixel over them, averaged over the channels.
struct Spread {
    first: Vec<[f32; 3]>,
    variance: Vec<f64>,
    /// Sample counts of the first image.
    samples: Vec<u32>,
}

fn spread(plan: &Plan, scene: usize, way: Way, spp: u32) -> Spread {
    let subject = &plan.scenes[scene];
    let [width, height] = subject.size;
    let mut samples = Vec::new();
    let images: Vec<Vec<[f32; 3]>> = (0..u64::from(REPLICATES))
        .map(|k| {
            let text = format!("{}/{}/{}/{spp}/picture/{k}", subject.name, way.method(), way.sampler.name());
            let seed = plan.seed.wrapping_add(fnv1a(text.as_bytes()));
            let Way { technique, choice, sampler } = way;
            let settings =
                Settings { width, height, spp, technique, choice, depth: Settings::DEPTH, sampler, sets: SETS, seed };
            let film = subject.world.render(&settings, &|_| ()).0;
            if k == 0 {
                samples = film.pixels.iter().map(|p| p.samples).collect();
            }
            film.pixels.iter().map(|p| p.mean).collect()
        })
        .collect();
    let n = f64::from(REPLICATES);
    let variance = (0..images[0].len())
        .map(|i| {
            let channel = |c: usize| {
                let mean = images.iter().map(|m| f64::from(m[i][c])).sum::<f64>() / n;
                images.iter().map(|m| (f64::from(m[i][c]) - mean).powi(2)).sum::<f64>() / (n - 1.0)
            };
            (channel(0) + channel(1) + channel(2)) / 3.0
        })
        .collect();
    Spread { first: images.into_iter().next().unwrap_or_default(), variance, samples }
}

/// Renders the pictures of a scene: a few replicates with few samples.
#[must_use]
pub fn panel(outcome: &Outcome, summary: &Summary) -> Panel {
    let plan = &outcome.plan;
    let scene = plan.scenes.iter().position(|s| s.name == summary.scene).unwrap_or(0);
    let subject = &plan.scenes[scene];
    let size = subject.size;
    let truth = &subject.reference.picture.radiance;
    let of_series = summary.series.iter().flat_map(|s| s.points.iter().map(|p| p.spp));
    let spp = of_series.filter(|n| *n <= SAMPLES).max().unwrap_or(SAMPLES);
    // every technique with the baseline's sampler, every sampler with the best technique
    let baseline = summary.baseline.map(|b| summary.series[b].way.sampler);
    let same = summary.gains.iter().filter(|g| Some(summary.series[g.series].way.sampler) == baseline);
    let best = same.max_by(|a, b| a.gain.value.total_cmp(&b.gain.value)).map(|g| summary.series[g.series].way.method());
    let spreads: Vec<(Way, Spread)> = summary
        .series
        .iter()
        .filter(|s| Some(s.way.sampler) == baseline || Some(s.way.method()) == best)
        .filter(|s| inapplicable(s.way.sampler, spp).is_none())
        .map(|s| (s.way, spread(plan, scene, s.way, spp)))
        .collect();
    // one scale for all techniques and samplers
    let mut all: Vec<f64> = spreads.iter().flat_map(|(_, s)| &s.variance).copied().filter(|v| *v > 0.0).collect();
    all.sort_by(f64::total_cmp);
    let quantile = |q: f64| all.get(((all.len() as f64 - 1.0) * q) as usize).copied().unwrap_or(1.0);
    let (low, high) = (quantile(0.05), quantile(0.995).max(quantile(0.05) * 10.0));
    let range = high.sqrt() / 2.0;

    let mut pictures = vec![Picture {
        file: "reference".to_owned(),
        kind: "image",
        title: "reference".to_owned(),
        size,
        png: png(size, truth.iter().map(|p| image::tone_map(*p))),
    }];
    for (way, spread) in &spreads {
        let stem = format!("{}-{}", way.method().replace(' ', "-"), way.sampler.name());
        let mut push = |kind: &'static str, png: Vec<u8>| {
            let (file, title) = (format!("{stem}-{kind}"), way.title());
            pictures.push(Picture { file, kind, title, size, png });
        };
        push("image", png(size, spread.first.iter().map(|p| image::tone_map(*p))));
        let differences = spread.first.iter().zip(truth).map(|(a, b)| {
            let mean: f64 = (0..3).map(|k| f64::from(a[k]) - f64::from(b[k])).sum::<f64>() / 3.0;
            signed(mean / range)
        });
        push("difference", png(size, differences));
        let scaled = spread.variance.iter().map(|v| heat((v.max(low) / low).ln() / (high / low).ln()));
        push("variance", png(size, scaled));
        let number = |n: f64| heat(n.max(1.0).ln() / MOST_SAMPLES.ln());
        if spread.samples.windows(2).any(|w| w[0] != w[1]) {
            push("samples", png(size, spread.samples.iter().map(|n| number(f64::from(*n)))));
        }
    }
    let caption = format!(
        "Images have {spp} samples per pixel, adaptive ones on average. Difference: blue is too dark, red too bright. \
         Variance: that of a pixel over {REPLICATES} replicates. Samples: the number an adaptive sampler took. Both \
         have logarithmic scales.",
    );
    let counts = [1.0, MOST_SAMPLES.sqrt(), MOST_SAMPLES].map(short);
    let bars = vec![
        ColorBar::new("difference", -1.0, signed, [-range, 0.0, range].map(short), "image − reference, W/(m² sr)"),
        ColorBar::new("variance", 0.0, heat, [low, (low * high).sqrt(), high].map(short), "variance, (W/(m² sr))²"),
        ColorBar::new("samples", 0.0, heat, counts, "samples per pixel"),
    ];
    Panel { scene: summary.scene.clone(), spp, pictures, caption, bars }
}
