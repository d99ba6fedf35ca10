//! Images and their parts, and the files of both.
//!
//! A piece is a rectangle of tiles of an image. It holds the finished pixels; with the adaptive sampler, also what the pilot found, or how
//! many samples the pixels receive after it. An image is a piece of all tiles.
//!
//! The file of a piece is an OpenEXR file. The text `etendue` in its header has three values: `identity` tells what the image depends on,
//! `kind` what the piece holds, and `checksums` are those of sixteen rows each. Numbers of double precision are two integer channels, of the
//! upper and the lower half of the bits.

use super::identity::Identity;
use super::light_weights::APART;
use super::pixel_counts::PixelCounts;
use super::pixel_statistics::{Outline, Statistics};
use super::view::Content;
use crate::film::files::{FileError, failed, make_folder, replace};
use crate::film::image::Compression;
use crate::film::image::layer::{self, Layer, LayerFile, Numbers};
use crate::film::{Pixel, Second, image};
use crate::sampler::Sampler;
use crate::scene::area;
use crate::scene::area::{Area, PlaceInImage};
use crate::settings::Settings;
use serde::{Deserialize, Serialize};
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PieceKind {
    /// Finished pixels.
    Pixels,
    /// What the pilot found, with samples shared among this many lights.
    Pilot(u32),
    /// How many samples follow the pilot, with samples shared among this many lights.
    Counts(u32),
}

impl PieceKind {
    /// Whether an image has such pieces.
    fn fits(self, identity: &Identity) -> bool {
        let Settings { sampler, spp, sets, .. } = identity.settings;
        match self {
            Self::Pixels => true,
            Self::Pilot(lights) | Self::Counts(lights) => {
                let is_adaptive = sampler == Sampler::Adaptive && sampler.check(spp, sets).is_ok();
                is_adaptive && lights as usize <= APART
            }
        }
    }
}

impl Piece {
    /// What kind of content it has.
    pub fn kind(&self) -> PieceKind {
        match &self.content {
            Content::Pixels(_) => PieceKind::Pixels,
            Content::Pilot(pixels) => PieceKind::Pilot(pixels.first().map_or(0, |pixel| pixel.lights as u32)),
            Content::Counts(counts) => PieceKind::Counts(counts.lights as u32),
        }
    }
}

/// Names of the channels.
const RGB: [&str; 3] = ["R", "G", "B"];

/// Names of what tells of the variance.
const SQUARES: [&str; 2] = ["squares", "outline.squares"];

/// Adds planes of numbers of double precision: the bits of each, in two.
fn split(planes: &mut Vec<(String, Numbers)>, name: &str, values: &dyn Fn() -> Vec<f64>) {
    let bits: Vec<u64> = values().into_iter().map(f64::to_bits).collect();
    planes.push((format!("{name}.high"), Numbers::U32(bits.iter().map(|bits| (bits >> 32) as u32).collect())));
    planes.push((format!("{name}.low"), Numbers::U32(bits.iter().map(|bits| *bits as u32).collect())));
}

/// The planes of a content. The channels R, G and B of a pilot are the mean of its samples, for other programs.
fn to_planes(identity: &Identity, content: Content) -> Vec<(String, Numbers)> {
    let sets = identity.sets() as usize;
    let mut planes = Vec::new();
    let lights = |names: &str, lights: usize, of: &dyn Fn(usize) -> Numbers| -> Vec<(String, Numbers)> {
        (0..lights).map(|light| (format!("{names}.{light}"), of(light))).collect()
    };
    match content {
        Content::Pixels(pixels) => planes = image::planes(&pixels),
        Content::Pilot(pixels) => {
            let samples = |pixel: &Statistics| 8 * pixel.packets * sets as u32;
            for (k, name) in RGB.into_iter().enumerate() {
                let sum = |pixel: &Statistics| pixel.sums.iter().map(|set| set[k]).sum::<f64>();
                let mean = |pixel: &Statistics| (sum(pixel) / f64::from(samples(pixel))) as f32;
                planes.push((name.to_owned(), Numbers::F32(pixels.iter().map(mean).collect())));
            }
            planes.push(("samples.N".to_owned(), Numbers::U32(pixels.iter().map(samples).collect())));
            for (set, (k, channel)) in (0..sets).flat_map(|set| RGB.into_iter().enumerate().map(move |c| (set, c))) {
                let of = || pixels.iter().map(|pixel| pixel.sums[set][k]).collect();
                split(&mut planes, &format!("sum.set{set}.{channel}"), &of);
                let of = || pixels.iter().map(|pixel| pixel.seen[set][k]).collect();
                split(&mut planes, &format!("seen.set{set}.{channel}"), &of);
            }
            split(&mut planes, "variance", &|| pixels.iter().map(|pixel| pixel.variance).collect());
            split(&mut planes, "outline", &|| pixels.iter().map(|pixel| pixel.outline.variance).collect());
            planes.push(("outline.part".into(), Numbers::F32(pixels.iter().map(|pixel| pixel.outline.part).collect())));
            planes.push(("part".into(), Numbers::F32(pixels.iter().map(|pixel| pixel.part).collect())));
            planes.push(("packets".into(), Numbers::U32(pixels.iter().map(|pixel| pixel.packets).collect())));
            let count = pixels.first().map_or(0, |pixel| pixel.lights);
            let all = pixels.iter();
            planes.extend(lights("spread", count, &|k| Numbers::F32(all.clone().map(|p| p.spread[k]).collect())));
            planes.extend(lights("pairs", count, &|k| Numbers::U32(all.clone().map(|p| p.pairs[k]).collect())));
            planes.extend(lights("taken", count, &|k| Numbers::U32(all.clone().map(|p| p.taken[k]).collect())));
        }
        Content::Counts(counts) => {
            let PixelCounts { packets, looks, lights: count, weights, squares, begun, sums, seen, expected, .. } =
                &counts;
            for (set, (k, channel)) in (0..sets).flat_map(|set| RGB.into_iter().enumerate().map(move |c| (set, c))) {
                split(&mut planes, &format!("sum.set{set}.{channel}"), &|| sums.iter().map(|s| s[set][k]).collect());
                split(&mut planes, &format!("seen.set{set}.{channel}"), &|| seen.iter().map(|s| s[set][k]).collect());
            }
            planes.push(("packets".into(), Numbers::U32(packets.clone())));
            planes.push(("looks".into(), Numbers::U32(looks.clone())));
            for (k, name) in SQUARES.into_iter().enumerate() {
                planes.push((name.into(), Numbers::F32(squares.iter().map(|of| of[k]).collect())));
            }
            // the same in all pixels
            split(&mut planes, "expected", &|| vec![*expected; packets.len()]);
            let weight = |k: usize| weights.iter().skip(k).step_by(*count).copied().collect();
            planes.extend(lights("weight", *count, &|k| Numbers::F32(weight(k))));
            planes.extend(lights("taken", *count, &|k| Numbers::U32(begun.iter().map(|taken| taken[k]).collect())));
        }
    }
    planes
}

/// The planes of a layer, to be taken by name.
struct LayerPlanes(HashMap<String, Numbers>);

impl LayerPlanes {
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
    fn packets(&mut self, sets: usize, name: &str) -> Option<Vec<u32>> {
        let packets = self.u32(name)?;
        packets.iter().all(|packets| packets.checked_mul(8 * sets as u32).is_some()).then_some(packets)
    }
    fn sums(&mut self, of: &str, sets: usize, pixels: usize) -> Option<Vec<[[f64; 3]; 4]>> {
        let mut sums = vec![[[0.0; 3]; 4]; pixels];
        for set in 0..sets {
            let of_set = self.colors(&|channel| format!("{of}.set{set}.{channel}"))?;
            sums.iter_mut().zip(of_set).for_each(|(sums, sum)| sums[set] = sum);
        }
        Some(sums)
    }
}

/// The content of this kind of the pixels of an area; `None` if a plane is missing.
fn from_planes(identity: &Identity, kind: PieceKind, area: Area, planes: Vec<(String, Numbers)>) -> Option<Content> {
    let count = area::count(area);
    let sets = identity.sets() as usize;
    let mut found = LayerPlanes(planes.into_iter().collect());
    Some(match kind {
        PieceKind::Pixels => {
            let [r, g, b] = RGB.map(|channel| found.f32(channel));
            let [u, v, w] = RGB.map(|channel| found.f32(&format!("variance.{channel}")));
            let (r, g, b, u, v, w, n) = (r?, g?, b?, u?, v?, w?, found.u32("samples.N")?);
            // only images whose error they tell have second sets
            let [s, t, q] = RGB.map(|channel| found.f32(&format!("second.{channel}")));
            let second = s.zip(t).zip(q).zip(found.f32("second.weight"));
            let pixel = |i: usize| Pixel {
                mean: [r[i], g[i], b[i]],
                variance: [u[i], v[i], w[i]],
                samples: n[i],
                second: second.as_ref().map_or(Second::default(), |(((s, t), q), weight)| Second {
                    mean: [s[i], t[i], q[i]],
                    weight: weight[i],
                }),
            };
            Content::Pixels((0..count).map(pixel).collect())
        }
        PieceKind::Pilot(lights) => {
            let lights = lights as usize;
            let (sums, seen) = (found.sums("sum", sets, count)?, found.sums("seen", sets, count)?);
            let (outline, outline_part) = (found.f64("outline")?, found.f32("outline.part")?);
            let (variance, part) = (found.f64("variance")?, found.f32("part")?);
            let packets = found.packets(sets, "packets")?;
            let spread = found.lights("spread", lights, count, LayerPlanes::f32)?;
            let pairs = found.lights("pairs", lights, count, LayerPlanes::u32)?;
            let taken = found.lights("taken", lights, count, LayerPlanes::u32)?;
            let pixel = |i: usize| Statistics {
                sums: sums[i],
                seen: seen[i],
                outline: Outline { variance: outline[i], part: outline_part[i] },
                packets: packets[i],
                variance: variance[i],
                part: part[i],
                lights,
                spread: spread[i],
                pairs: pairs[i],
                taken: taken[i],
            };
            Content::Pilot((0..count).map(pixel).collect())
        }
        PieceKind::Counts(lights) => {
            let lights = lights as usize;
            let weights = found.lights("weight", lights, count, LayerPlanes::f32)?;
            let packets = found.packets(sets, "packets")?;
            let looks = found.packets(sets, "looks")?;
            let [squares, outlines] = SQUARES.map(|name| found.f32(name));
            Content::Counts(PixelCounts {
                area,
                packets,
                looks,
                lights,
                weights: weights.iter().flat_map(|weights| weights[..lights].iter().copied()).collect(),
                squares: squares?.into_iter().zip(outlines?).map(|(own, outline)| [own, outline]).collect(),
                expected: found.f64("expected")?.first().copied().unwrap_or(0.0),
                begun: found.lights("taken", lights, count, LayerPlanes::u32)?,
                sums: found.sums("sum", sets, count)?,
                seen: found.sums("seen", sets, count)?,
            })
        }
    })
}

/// The bytes of the file of a piece.
///
/// # Errors
/// Fails if the piece does not have the numbers that its area needs.
pub fn encode(identity: &Identity, piece: Piece, compression: Compression) -> Result<Vec<u8>, String> {
    let PlaceInImage { start: [x, y], whole } = identity.window();
    let text = json!({ "identity": identity, "kind": piece.kind() });
    let [x0, y0, x1, y1] = piece.area;
    let layer = Layer { area: [x + x0, y + y0, x + x1, y + y1], planes: to_planes(identity, piece.content) };
    layer::encode(whole, text, layer, compression).map_err(|error| error.to_string())
}

/// Writes the file of a part of an image. Makes its folder if there is none, since many tasks may begin at once.
///
/// # Errors
/// Fails if the file cannot be written; an existing file then remains unchanged.
pub fn write(path: &Path, identity: &Identity, piece: Piece) -> Result<(), FileError> {
    let bytes = encode(identity, piece, Compression::Uncompressed).map_err(|what| failed(path, what))?;
    if let Some(folder) = path.parent() {
        make_folder(folder)?;
    }
    replace(path, &bytes)
}

/// Writes an image: an EXR file with its [planes](image::planes). If it has a place in a larger image, that image is the display window, and the place the data window. Equal images give equal bytes.
///
/// # Errors
/// Fails if the file cannot be written; an existing file then remains unchanged.
pub fn write_image(path: &Path, identity: &Identity, pixels: Vec<Pixel>) -> Result<(), FileError> {
    let piece = Piece { area: identity.settings.whole(), content: Content::Pixels(pixels) };
    let bytes = encode(identity, piece, Compression::ZIP16).map_err(|what| failed(path, what))?;
    replace(path, &bytes)
}

/// What the header of a file says of its piece.
#[derive(Clone, Debug, PartialEq)]
pub struct PieceHeader {
    /// The file.
    pub path: PathBuf,
    /// What it is a part of.
    pub identity: Identity,
    /// The pixels [x0, y0, x1, y1).
    pub area: Area,
    /// What is known of them.
    pub kind: PieceKind,
    /// Checksums of the contents.
    pub checksums: Value,
}

/// A file whose header has been read.
pub struct PieceFile<R = BufReader<File>> {
    file: LayerFile<R>,
    /// What the header says.
    pub header: PieceHeader,
}

impl PieceFile {
    /// Opens a file and reads its header.
    ///
    /// # Errors
    /// Fails if the file cannot be read, or holds no piece.
    pub fn open(path: &Path) -> Result<Self, FileError> {
        Self::of(path, LayerFile::open(path)?)
    }
}

impl<R: Read + Seek> PieceFile<R> {
    /// Reads the header from a source of `length` bytes that messages call `path`.
    ///
    /// # Errors
    /// Fails if the source holds no piece.
    pub fn new(path: &Path, source: R, length: u64) -> Result<Self, FileError> {
        Self::of(path, LayerFile::new(path, source, length)?)
    }

    fn of(path: &Path, file: LayerFile<R>) -> Result<Self, FileError> {
        let text = &file.text;
        let identity = Identity::from_json(&text["identity"])
            .map_err(|what| failed(path, format!("damaged: the identity of the image is not valid: {what}")))?;
        let start = identity.window().start;
        let corner = |k: usize| file.area[k].checked_sub(start[k % 2]);
        let area = (|| Some([corner(0)?, corner(1)?, corner(2)?, corner(3)?]))();
        let area = area.filter(|area| identity.settings.is_of_tiles(*area));
        let kind = PieceKind::deserialize(&text["kind"]).ok().filter(|kind| kind.fits(&identity));
        let (Some(area), Some(kind)) = (area, kind) else {
            return Err(failed(path, format!("damaged: no piece of {:?} can be {}", file.area, text["kind"])));
        };
        let header = PieceHeader { path: path.to_owned(), identity, area, kind, checksums: text["checksums"].clone() };
        Ok(Self { file, header })
    }

    /// Reads the piece.
    ///
    /// # Errors
    /// Fails if the file is damaged.
    pub fn read(&mut self) -> Result<Piece, FileError> {
        let [_, y0, _, y1] = self.header.area;
        self.read_rows(&(y0..y1))
    }

    /// Reads the tiles of the piece that are in these rows of the image.
    ///
    /// # Errors
    /// Fails if the file is damaged.
    pub fn read_rows(&mut self, rows: &Range<u32>) -> Result<Piece, FileError> {
        let PieceHeader { path, identity, area: [x0, y0, x1, _], kind, .. } = &self.header;
        let layer = self.file.read(&(rows.start - y0..rows.end - y0))?;
        let above = layer.area[1] - self.file.area[1] + y0;
        let area = [*x0, above, *x1, above + layer.area[3] - layer.area[1]];
        let content = from_planes(identity, *kind, area, layer.planes);
        let content = content.ok_or_else(|| failed(path, "damaged: a channel is missing, or has impossible values"))?;
        Ok(Piece { area, content })
    }
}
