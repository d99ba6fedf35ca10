//! Parts of an image, rendered apart: what is in a part, and its file.
//!
//! A part has pieces, which are of a rectangle of tiles each. A piece holds the finished pixels, or the sums of a range of the samples of
//! each pixel. With the adaptive sampler, it holds what the pilot found, or how many samples the pixels receive after it.
//!
//! Its file is an OpenEXR file. In its header, `etendue.frame` identifies the image, and `etendue.part` says what the part holds, with
//! checksums. A range has the sum of each block of samples in double precision, `sum.FIRST-END.R` and so on, as two integer channels: the
//! upper and the lower half of the bits.

use crate::area;
use crate::area::Area;
use crate::drive::{APART, Allotment, Content, Statistics};
use crate::files::{FileError, failed, make_folder, replace};
use crate::film::Pixel;
use crate::frame::Frame;
use crate::image::layers::{self, Contents, Layer, LayerFile, LayerHeader, Numbers};
use crate::image::{self, Compression};
use crate::sampler::Sampler;
use crate::sums::{Block, Planes, blocks};
use serde_json::{Value, json};
use std::collections::HashMap;
use std::fs::File;
use std::io::{BufReader, Read, Seek};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A rectangle of an image.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// The pixels [x0, y0, x1, y1), which form tiles (see [`Settings::is_of_tiles`](crate::Settings::is_of_tiles)).
    pub area: Area,
    /// What is known of them.
    pub content: Content,
}

/// What kind of content a piece has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PieceKind {
    /// Finished pixels.
    Pixels,
    /// Sums of this range of samples.
    Range(Range<u32>),
    /// What the pilot found, with samples shared among this many lights.
    Pilot(u32),
    /// How many samples follow the pilot, with samples shared among this many lights.
    Allotment(u32),
}

impl PieceKind {
    /// The range of the samples of each pixel that a piece of this kind knows, out of `spp`.
    pub fn range(&self, spp: u32) -> Range<u32> {
        match self {
            Self::Range(range) => range.clone(),
            Self::Pixels | Self::Pilot(_) | Self::Allotment(_) => 0..spp,
        }
    }
    fn to_json(&self) -> Value {
        match self {
            Self::Pixels => json!({ "content": "pixels" }),
            Self::Range(range) => json!({ "content": "range", "range": [range.start, range.end] }),
            Self::Pilot(lights) => json!({ "content": "pilot", "lights": lights }),
            Self::Allotment(lights) => json!({ "content": "allotment", "lights": lights }),
        }
    }
    fn from_json(value: &Value) -> Option<Self> {
        let small = |value: &Value| value.as_u64().and_then(|x| u32::try_from(x).ok());
        let lights = || small(&value["lights"]).filter(|&lights| lights as usize <= APART);
        Some(match value["content"].as_str()? {
            "pixels" => Self::Pixels,
            "range" => Self::Range(small(&value["range"][0])?..small(&value["range"][1])?),
            "pilot" => Self::Pilot(lights()?),
            "allotment" => Self::Allotment(lights()?),
            _ => return None,
        })
    }
    /// Whether a frame has such pieces.
    fn fits(&self, frame: &Frame) -> bool {
        let is_adaptive = frame.settings.sampler == Sampler::Adaptive;
        match self {
            Self::Pixels => true,
            Self::Range(range) => !is_adaptive && range.start < range.end && range.end <= frame.settings.spp,
            Self::Pilot(_) | Self::Allotment(_) => is_adaptive,
        }
    }
}

impl Piece {
    /// What kind of content it has.
    pub fn kind(&self) -> PieceKind {
        match &self.content {
            Content::Pixels(_) => PieceKind::Pixels,
            Content::Range(range, _) => PieceKind::Range(range.clone()),
            Content::Pilot(pixels) => PieceKind::Pilot(pixels.first().map_or(0, |pixel| pixel.lights as u32)),
            Content::Allotment(allotment) => PieceKind::Allotment(allotment.lights as u32),
        }
    }
}

/// Names of the channels.
const RGB: [&str; 3] = ["R", "G", "B"];

/// Adds planes of numbers of double precision: the bits of each, in two.
fn split(planes: &mut Vec<(String, Numbers)>, name: &str, values: &dyn Fn() -> Vec<f64>) {
    let bits: Vec<u64> = values().into_iter().map(f64::to_bits).collect();
    planes.push((format!("{name}.high"), Numbers::U32(bits.iter().map(|bits| (bits >> 32) as u32).collect())));
    planes.push((format!("{name}.low"), Numbers::U32(bits.iter().map(|bits| *bits as u32).collect())));
}

/// Names of the planes of a block of samples.
fn block_name(block: &Block, span: u32, what: &str, channel: &str) -> String {
    let first = block.set * span + block.first;
    format!("{what}.{first}-{}.{channel}", first + block.count)
}

/// The layer of a piece. Its channels R, G and B are the mean of its samples, for other programs.
fn to_layer(frame: &Frame, piece: Piece) -> Layer {
    let (area, text) = (piece.area, piece.kind().to_json());
    let span = frame.span();
    let sets = frame.sets() as usize;
    let mut planes = Vec::new();
    let mut preview = |sum: &dyn Fn(usize, usize) -> f64, count: &dyn Fn(usize) -> u32, pixels: usize| {
        for (k, name) in RGB.into_iter().enumerate() {
            let mean = |i: usize| (sum(i, k) / f64::from(count(i))) as f32;
            planes.push((name.to_owned(), Numbers::F32((0..pixels).map(mean).collect())));
        }
        planes.push(("samples.N".to_owned(), Numbers::U32((0..pixels).map(count).collect())));
    };
    let lights = |names: &str, lights: usize, of: &dyn Fn(usize) -> Numbers| -> Vec<(String, Numbers)> {
        (0..lights).map(|light| (format!("{names}.{light}"), of(light))).collect()
    };
    match piece.content {
        Content::Pixels(pixels) => planes = image::planes(&pixels),
        Content::Range(range, of_blocks) => {
            let pixels = of_blocks.first().map_or(0, |planes| planes.sums.len());
            let total = |i: usize, k: usize| of_blocks.iter().map(|planes| planes.sums[i][k]).sum();
            preview(&total, &|_| range.end - range.start, pixels);
            for (block, of_block) in blocks(range, span).zip(&of_blocks) {
                for (k, channel) in RGB.into_iter().enumerate() {
                    let of = |values: &[[f64; 3]]| values.iter().map(|value| value[k]).collect();
                    split(&mut planes, &block_name(&block, span, "sum", channel), &|| of(&of_block.sums));
                    if !of_block.squares.is_empty() {
                        split(&mut planes, &block_name(&block, span, "squares", channel), &|| of(&of_block.squares));
                    }
                }
            }
        }
        Content::Pilot(pixels) => {
            let total = |i: usize, k: usize| pixels[i].sums.iter().map(|set| set[k]).sum();
            preview(&total, &|i| 8 * pixels[i].packets * sets as u32, pixels.len());
            for (set, (k, channel)) in (0..sets).flat_map(|set| RGB.into_iter().enumerate().map(move |c| (set, c))) {
                let of = || pixels.iter().map(|pixel| pixel.sums[set][k]).collect();
                split(&mut planes, &format!("sum.set{set}.{channel}"), &of);
            }
            split(&mut planes, "variance", &|| pixels.iter().map(|pixel| pixel.variance).collect());
            planes.push(("packets".into(), Numbers::U32(pixels.iter().map(|pixel| pixel.packets).collect())));
            let count = pixels.first().map_or(0, |pixel| pixel.lights);
            let all = pixels.iter();
            planes.extend(lights("spread", count, &|k| Numbers::F32(all.clone().map(|p| p.spread[k]).collect())));
            planes.extend(lights("pairs", count, &|k| Numbers::U32(all.clone().map(|p| p.pairs[k]).collect())));
            planes.extend(lights("taken", count, &|k| Numbers::U32(all.clone().map(|p| p.taken[k]).collect())));
        }
        Content::Allotment(allotment) => {
            let Allotment { packets, lights: count, weights, squares, begun, sums, .. } = &allotment;
            for (set, (k, channel)) in (0..sets).flat_map(|set| RGB.into_iter().enumerate().map(move |c| (set, c))) {
                split(&mut planes, &format!("sum.set{set}.{channel}"), &|| sums.iter().map(|s| s[set][k]).collect());
            }
            planes.push(("packets".into(), Numbers::U32(packets.clone())));
            planes.push(("squares".into(), Numbers::F32(squares.clone())));
            let weight = |k: usize| weights.iter().skip(k).step_by(*count).copied().collect();
            planes.extend(lights("weight", *count, &|k| Numbers::F32(weight(k))));
            planes.extend(lights("taken", *count, &|k| Numbers::U32(begun.iter().map(|taken| taken[k]).collect())));
        }
    }
    Layer { area, planes, text }
}

/// The planes of a layer, to be taken by name.
struct Found(HashMap<String, Numbers>);

impl Found {
    fn f32(&mut self, name: &str) -> Option<Vec<f32>> {
        if let Numbers::F32(values) = self.0.remove(name)? { Some(values) } else { None }
    }
    fn u32(&mut self, name: &str) -> Option<Vec<u32>> {
        if let Numbers::U32(values) = self.0.remove(name)? { Some(values) } else { None }
    }
    /// Puts the halves of numbers of double precision together.
    fn f64(&mut self, name: &str) -> Option<Vec<f64>> {
        let [high, low] = [self.u32(&format!("{name}.high"))?, self.u32(&format!("{name}.low"))?];
        let join = |(high, low): (u32, u32)| f64::from_bits(u64::from(high) << 32 | u64::from(low));
        Some(high.into_iter().zip(low).map(join).collect())
    }
    /// Three channels.
    fn colors(&mut self, name: &dyn Fn(&str) -> String) -> Option<Vec<[f64; 3]>> {
        let [r, g, b] = RGB.map(|channel| self.f64(&name(channel)));
        let (r, g, b) = (r?, g?, b?);
        Some((0..r.len()).map(|i| [r[i], g[i], b[i]]).collect())
    }
    /// One number for each of the first lights.
    fn lights<T: Copy + Default>(
        &mut self,
        name: &str,
        lights: usize,
        pixels: usize,
        take: impl Fn(&mut Self, &str) -> Option<Vec<T>>,
    ) -> Option<Vec<[T; APART]>> {
        let mut all = vec![[T::default(); APART]; pixels];
        for light in 0..lights {
            let values = take(self, &format!("{name}.{light}"))?;
            all.iter_mut().zip(values).for_each(|(of, value)| of[light] = value);
        }
        Some(all)
    }
    /// Packets in each set, unless there are more than can be counted.
    fn packets(&mut self, sets: usize) -> Option<Vec<u32>> {
        let packets = self.u32("packets")?;
        packets.iter().all(|packets| packets.checked_mul(8 * sets as u32).is_some()).then_some(packets)
    }
    fn sums(&mut self, sets: usize, pixels: usize) -> Option<Vec<[[f64; 3]; 4]>> {
        let mut sums = vec![[[0.0; 3]; 4]; pixels];
        for set in 0..sets {
            let of_set = self.colors(&|channel| format!("sum.set{set}.{channel}"))?;
            sums.iter_mut().zip(of_set).for_each(|(sums, sum)| sums[set] = sum);
        }
        Some(sums)
    }
}

/// The piece of a layer of this kind; `None` if a plane is missing.
fn from_layer(frame: &Frame, kind: &PieceKind, layer: Layer) -> Option<Piece> {
    let Layer { area, planes, .. } = layer;
    let count = area::count(area);
    let sets = frame.sets() as usize;
    let mut found = Found(planes.into_iter().collect());
    let content = match kind {
        PieceKind::Pixels => {
            let [r, g, b] = RGB.map(|channel| found.f32(channel));
            let [u, v, w] = RGB.map(|channel| found.f32(&format!("variance.{channel}")));
            let (r, g, b, u, v, w, n) = (r?, g?, b?, u?, v?, w?, found.u32("samples.N")?);
            let pixel = |i: usize| Pixel { mean: [r[i], g[i], b[i]], variance: [u[i], v[i], w[i]], samples: n[i] };
            Content::Pixels((0..count).map(pixel).collect())
        }
        PieceKind::Range(range) => {
            let (span, independent) = (frame.span(), !frame.settings.sampler.has_sets());
            let planes = blocks(range.clone(), span).map(|block| {
                Some(Planes {
                    sums: found.colors(&|channel| block_name(&block, span, "sum", channel))?,
                    squares: if independent {
                        found.colors(&|channel| block_name(&block, span, "squares", channel))?
                    } else {
                        Vec::new()
                    },
                })
            });
            Content::Range(range.clone(), planes.collect::<Option<_>>()?)
        }
        PieceKind::Pilot(lights) => {
            let lights = *lights as usize;
            let (sums, variance) = (found.sums(sets, count)?, found.f64("variance")?);
            let packets = found.packets(sets)?;
            let spread = found.lights("spread", lights, count, Found::f32)?;
            let pairs = found.lights("pairs", lights, count, Found::u32)?;
            let taken = found.lights("taken", lights, count, Found::u32)?;
            let pixel = |i: usize| Statistics {
                sums: sums[i],
                packets: packets[i],
                variance: variance[i],
                lights,
                spread: spread[i],
                pairs: pairs[i],
                taken: taken[i],
            };
            Content::Pilot((0..count).map(pixel).collect())
        }
        PieceKind::Allotment(lights) => {
            let lights = *lights as usize;
            let weights = found.lights("weight", lights, count, Found::f32)?;
            let packets = found.packets(sets)?;
            Content::Allotment(Allotment {
                area,
                packets,
                lights,
                weights: weights.iter().flat_map(|weights| weights[..lights].iter().copied()).collect(),
                squares: found.f32("squares")?,
                begun: found.lights("taken", lights, count, Found::u32)?,
                sums: found.sums(sets, count)?,
            })
        }
    };
    Some(Piece { area, content })
}

/// How the planes of parts are compressed.
const COMPRESSION: Compression = Compression::Uncompressed;

/// The bytes of the file of a part.
///
/// # Errors
/// Fails if a piece does not have the numbers that its area needs.
pub fn encode(frame: &Frame, pieces: Vec<Piece>) -> Result<Vec<u8>, String> {
    let layers = pieces.into_iter().map(|piece| to_layer(frame, piece)).collect();
    let size = [frame.settings.width, frame.settings.height];
    layers::encode(size, &frame.to_json(), layers, COMPRESSION).map_err(|error| error.to_string())
}

/// Writes the file of a part. Makes its folder if there is none, since many tasks may begin at once.
///
/// # Errors
/// Fails if the file cannot be written; an existing file then remains unchanged.
pub fn write(path: &Path, frame: &Frame, pieces: Vec<Piece>) -> Result<(), FileError> {
    let bytes = encode(frame, pieces).map_err(|what| failed(path, what))?;
    if let Some(folder) = path.parent() {
        make_folder(folder)?;
    }
    replace(path, &bytes)
}

/// A part whose headers have been read.
pub struct PartFile<R = BufReader<File>> {
    path: PathBuf,
    file: LayerFile<R>,
    /// What it is a part of.
    pub frame: Frame,
    /// Area, kind and checksums of each piece.
    pub pieces: Vec<PieceHeader>,
}

/// What the header of a part says of a piece.
#[derive(Clone, Debug, PartialEq)]
pub struct PieceHeader {
    /// The pixels [x0, y0, x1, y1).
    pub area: Area,
    /// What is known of them.
    pub kind: PieceKind,
    /// Checksums of the contents.
    pub checksums: Value,
}

impl PartFile {
    /// Opens a part and reads its headers.
    ///
    /// # Errors
    /// Fails if the file cannot be read, or is not a part.
    pub fn open(path: &Path) -> Result<Self, FileError> {
        Self::of(path, LayerFile::open(path)?)
    }
}

impl<R: Read + Seek> PartFile<R> {
    /// Reads the headers from a source of `length` bytes that messages call `path`.
    ///
    /// # Errors
    /// Fails if the source is not a part.
    pub fn new(path: &Path, source: R, length: u64) -> Result<Self, FileError> {
        Self::of(path, LayerFile::new(path, source, length)?)
    }

    fn of(path: &Path, file: LayerFile<R>) -> Result<Self, FileError> {
        let Contents { text, layers } = &file.contents;
        let frame =
            Frame::from_json(text).map_err(|what| failed(path, format!("damaged: the frame is not valid: {what}")))?;
        let piece = |LayerHeader { area, text, .. }: &LayerHeader| {
            let kind = PieceKind::from_json(text).filter(|kind| kind.fits(&frame) && frame.settings.is_of_tiles(*area));
            let kind = kind.ok_or_else(|| failed(path, format!("damaged: no piece of {area:?} can be {text}")))?;
            Ok(PieceHeader { area: *area, kind, checksums: text["checksums"].clone() })
        };
        let pieces = layers.iter().map(piece).collect::<Result<_, _>>()?;
        Ok(Self { path: path.to_owned(), pieces, frame, file })
    }

    /// Reads all pieces.
    ///
    /// # Errors
    /// Fails if the file is damaged.
    pub fn read(&mut self) -> Result<Vec<Piece>, FileError> {
        self.read_rows(&(0..self.frame.settings.height))
    }

    /// Reads the tiles of all pieces that are in these rows of the image.
    ///
    /// # Errors
    /// Fails if the file is damaged, or if a piece has no such tiles.
    pub fn read_rows(&mut self, rows: &Range<u32>) -> Result<Vec<Piece>, FileError> {
        let layers = self.file.read(0..self.pieces.len(), rows)?;
        let piece = |(layer, header): (Layer, &PieceHeader)| from_layer(&self.frame, &header.kind, layer);
        let pieces = layers.into_iter().zip(&self.pieces).map(piece).collect::<Option<_>>();
        pieces.ok_or_else(|| failed(&self.path, "damaged: a channel is missing, or has impossible values"))
    }
}
