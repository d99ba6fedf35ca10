//! Puts the tiles of an image together, exactly and in any order, and averages images of different seeds.

use super::identity::Identity;
use super::parts::{Piece, PieceFile, PieceHeader, PieceKind};
use super::pixel_counts::PixelCounts;
use super::pixel_statistics::Statistics;
use super::view::Content;
use crate::film::files::FileError;
use crate::film::{Film, Pixel, Second};
use crate::scene::area::{Area, count, paste};
use crate::settings::Settings;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// Most problems that a message lists.
const LISTED: usize = 10;

/// What the files make.
#[derive(Clone, Debug, PartialEq)]
pub enum Merged {
    /// An image.
    Image(Film),
    /// The whole pilot of an image.
    Pilot(Piece),
}

/// The files, put together.
#[derive(Clone, Debug, PartialEq)]
pub struct MergeOutcome {
    /// What they make an image of.
    pub identity: Identity,
    /// What they make.
    pub merged: Merged,
    /// The number of files that were used.
    pub used: usize,
    /// The files of which others have the same contents.
    pub duplicates: Vec<PathBuf>,
    /// The areas that no part holds.
    pub gaps: Vec<Area>,
}

/// Merges these files. Several finished images are averaged, with the numbers of their samples as weights; anything else are tiles of one
/// image, or of its pilot. If it may be `partial`, an image has no samples where tiles are missing. `progress` receives the number of files
/// that have been read since the last call.
///
/// # Errors
/// Fails if a file is no piece of an image, is damaged, or belongs to another image than most; if two images have a seed in common, or two
/// tiles some pixels, unless their contents are the same; and if tiles are missing, unless they may be. The message names the files, with
/// the values that differ, and the gaps.
pub fn merge(files: &[PathBuf], partial: bool, progress: &(dyn Fn(u64) + Sync)) -> Result<MergeOutcome, String> {
    let headers = read_headers(files)?;
    let is_whole = |file: &PieceHeader| file.kind == PieceKind::Pixels && file.area == file.identity.settings.whole();
    // a part of all tiles is none: where it lies among those of another seed, it does so by mistake
    let is_image = |file: &PieceHeader| file.identity.build.is_none() && is_whole(file);
    if headers.len() > 1 && headers.iter().all(is_image) {
        return average(headers, progress);
    }
    let identity = common(&headers, "not a part of the same image as", Identity::clone)?;
    let pilots = headers.iter().all(|file| matches!(file.kind, PieceKind::Pilot(_)));
    let line = |file: &PieceHeader| {
        let what = match file.kind {
            PieceKind::Pixels => return None,
            PieceKind::Pilot(_) => "belongs to the pilot, others do not",
            PieceKind::Counts(_) => "is a whole pilot already, for --after",
        };
        Some(format!("{}: {what}", file.path.display()))
    };
    refuse(if pilots { Vec::new() } else { headers.iter().filter_map(line).collect() })?;
    let Tiling { used, duplicates, gaps } = Tiling::new(&headers, &identity.settings)?;
    if !gaps.is_empty() && (pilots || !partial) {
        let (what, help) = if pilots { ("pilot", "") } else { ("image", "; --partial writes an image without them") };
        let option = if pilots { "--pilot --tile" } else { "--tile" };
        let lines = gaps.iter().map(|area| format!("{option} {}", text_of(*area))).collect();
        return Err(format!("the {what} lacks {} part(s){help}:\n{}", gaps.len(), list(lines)));
    }
    let whole = identity.settings.whole();
    let merged = if pilots {
        let of_pilot = |content| if let Content::Pilot(pixels) = content { Some(pixels) } else { None };
        let pilot = assemble(&used, whole, Statistics::default(), of_pilot, progress)?;
        let counts = PixelCounts::new(&identity.settings, whole, &pilot);
        Merged::Pilot(Piece { area: whole, content: Content::Counts(counts) })
    } else {
        let nothing = Pixel::of_sets(std::iter::empty(), false);
        let pixels = assemble(&used, whole, nothing, finished, progress)?;
        Merged::Image(Film { width: whole[2], height: whole[3], pixels })
    };
    Ok(MergeOutcome { identity, merged, used: used.len(), duplicates, gaps })
}

/// How many samples follow the pilot in this file, for the pixels of an area. The file is the merge of a pilot.
///
/// # Errors
/// Fails if the file is damaged, holds no whole pilot, or that of another image than `identity`.
pub fn pixel_counts(path: &Path, identity: &Identity, area: Area) -> Result<PixelCounts, String> {
    let wrong = |what: &str| format!("{}: {what}", path.display());
    let mut file = PieceFile::open(path).map_err(|error| error.to_string())?;
    if let Some(difference) = identity.difference(&file.header.identity) {
        return Err(wrong(&format!("the pilot of another image: {difference}")));
    }
    if !matches!(file.header.kind, PieceKind::Counts(_)) || file.header.area != identity.settings.whole() {
        return Err(wrong("not the whole pilot, which `etendue merge` makes of its parts"));
    }
    let piece = file.read_rows(&(area[1]..area[3])).map_err(|error| error.to_string())?;
    let Content::Counts(counts) = piece.content else { return Err(wrong("not what its header says")) };
    Ok(counts.crop(area))
}

/// The mean of images, with the numbers of their samples as weights.
fn average(mut files: Vec<PieceHeader>, progress: &(dyn Fn(u64) + Sync)) -> Result<MergeOutcome, String> {
    let mut identity = common(&files, "not of the same image as", Identity::of_average)?;
    let mut known: BTreeMap<u64, &Path> = BTreeMap::new();
    let mut errors = Vec::new();
    for (seed, file) in files.iter().flat_map(|file| file.identity.seeds().map(move |seed| (seed, &*file.path))) {
        if let Some(first) = known.insert(seed, file) {
            let [first, second] = [first, file].map(Path::display);
            errors.push(format!("{first} and {second} both have samples of seed {seed}, which are the same samples"));
        }
    }
    refuse(errors)?;
    let mut seeds = known.into_keys();
    identity.settings.seed = seeds.next().unwrap_or(0);
    identity.averaged = seeds.collect();
    identity.settings.spp = files.iter().fold(0, |sum, file| file.identity.settings.spp.saturating_add(sum));
    // the sum is the same in whatever order the files are given
    files.sort_by_key(|file| file.identity.settings.seed);
    let [_, _, width, height] = identity.settings.whole();
    let mut pixels = vec![Average::default(); count(identity.settings.whole())];
    for file in &files {
        let piece = PieceFile::open(&file.path).and_then(|mut file| file.read()).map_err(|error| error.to_string())?;
        let Content::Pixels(own) = piece.content else { return Err(changed(file)) };
        pixels.par_iter_mut().zip(own).for_each(|(sum, pixel)| sum.add(&pixel));
        progress(1);
    }
    let pixels = pixels.par_iter().map(Average::mean).collect();
    let merged = Merged::Image(Film { width, height, pixels });
    Ok(MergeOutcome { identity, merged, used: files.len(), duplicates: Vec::new(), gaps: Vec::new() })
}

/// A pixel of several images.
#[derive(Clone, Copy, Default)]
struct Average {
    /// Σnx over the means x of n samples.
    sum: [f64; 3],
    /// Σn²v over their variances v.
    variance: [f64; 3],
    samples: u32,
    second: Second,
}

impl Average {
    fn add(&mut self, pixel: &Pixel) {
        if pixel.samples == 0 {
            return;
        }
        let n = f64::from(pixel.samples);
        for k in 0..3 {
            self.sum[k] += n * f64::from(pixel.mean[k]);
            self.variance[k] += n * n * f64::from(pixel.variance[k]);
        }
        self.samples = self.samples.saturating_add(pixel.samples);
        self.second.add(&pixel.second, n / f64::from(self.samples));
    }
    fn mean(&self) -> Pixel {
        if self.samples == 0 {
            return Pixel::of_sets(std::iter::empty(), false);
        }
        let n = f64::from(self.samples);
        let (mean, variance) = (self.sum.map(|x| (x / n) as f32), self.variance.map(|x| (x / (n * n)) as f32));
        Pixel { mean, variance, samples: self.samples, second: self.second }
    }
}

/// A message of at most [`LISTED`] lines.
fn list(mut lines: Vec<String>) -> String {
    let more = lines.len().saturating_sub(LISTED);
    lines.truncate(LISTED);
    let mut text = lines.join("\n");
    if more > 0 {
        let _ = write!(text, "\nand {more} more");
    }
    text
}

/// Fails if there are problems.
fn refuse(problems: Vec<String>) -> Result<(), String> {
    if problems.is_empty() { Ok(()) } else { Err(list(problems)) }
}

fn text_of([x0, y0, x1, y1]: Area) -> String {
    format!("{x0},{y0},{x1},{y1}")
}

fn changed(file: &PieceHeader) -> String {
    format!("{}: not what its header says", file.path.display())
}

fn read_headers(files: &[PathBuf]) -> Result<Vec<PieceHeader>, String> {
    let read: Vec<Result<PieceHeader, FileError>> =
        files.par_iter().map(|path| PieceFile::open(path).map(|file| file.header)).collect();
    let (mut headers, mut errors) = (Vec::new(), Vec::new());
    for file in read {
        match file {
            Ok(file) => headers.push(file),
            Err(error) => errors.push(error.to_string()),
        }
    }
    refuse(errors)?;
    if headers.is_empty() { Err("there are no parts".into()) } else { Ok(headers) }
}

/// What most files have in common, if they have it all; `fault` says what others are.
fn common(headers: &[PieceHeader], fault: &str, of: impl Fn(&Identity) -> Identity) -> Result<Identity, String> {
    let mut counts: Vec<(Identity, &Path, usize)> = Vec::new();
    for file in headers {
        let own = of(&file.identity);
        match counts.iter_mut().find(|(identity, ..)| *identity == own) {
            Some((.., count)) => *count += 1,
            None => counts.push((own, &file.path, 1)),
        }
    }
    // the first of the most frequent ones
    let most = counts.iter().map(|(.., count)| *count).max();
    let found = counts.iter().find(|(.., count)| Some(*count) == most);
    let (identity, first, _) = found.unwrap_or_else(|| unreachable!("there is a file"));
    let other = |file: &PieceHeader| {
        let difference = identity.difference(&of(&file.identity))?;
        Some(format!("{}: {fault} {}: {difference}", file.path.display(), first.display()))
    };
    refuse(headers.iter().filter_map(other).collect())?;
    Ok(identity.clone())
}

/// Which tiles of an image there are.
struct Tiling<'a> {
    /// Files that have no pixels in common.
    used: Vec<&'a PieceHeader>,
    duplicates: Vec<PathBuf>,
    gaps: Vec<Area>,
}

impl<'a> Tiling<'a> {
    fn new(headers: &'a [PieceHeader], settings: &Settings) -> Result<Self, String> {
        let [across, down] = [settings.width, settings.height].map(|side| side.div_ceil(Settings::TILE) as usize);
        let tiles = |[x0, y0, x1, y1]: Area| {
            let [x0, y0] = [x0, y0].map(|at| (at / Settings::TILE) as usize);
            let [x1, y1] = [x1, y1].map(|at| at.div_ceil(Settings::TILE) as usize);
            (y0..y1).flat_map(move |y| (x0..x1).map(move |x| y * across + x))
        };
        let mut of_tile: Vec<Option<&PieceHeader>> = vec![None; across * down];
        let (mut used, mut duplicates, mut overlaps) = (Vec::new(), Vec::new(), Vec::new());
        for file in headers {
            match tiles(file.area).find_map(|tile| of_tile[tile]) {
                None => used.push(file),
                Some(other) if (other.area, &other.checksums) == (file.area, &file.checksums) => {
                    duplicates.push(file.path.clone());
                }
                Some(other) => {
                    let (a, b) = (other.area, file.area);
                    let both = [a[0].max(b[0]), a[1].max(b[1]), a[2].min(b[2]), a[3].min(b[3])];
                    let [first, second] = [other, file].map(|file| file.path.display());
                    overlaps.push(format!("{first} and {second} both hold --tile {}", text_of(both)));
                }
            }
            tiles(file.area).for_each(|tile| of_tile[tile] = of_tile[tile].or(Some(file)));
        }
        refuse(overlaps)?;
        let mut is_there: Vec<bool> = of_tile.iter().map(Option::is_some).collect();
        let mut gaps = Vec::new();
        // the widest rectangle that begins with the first tile that is missing, and then the highest
        for first in 0..is_there.len() {
            if is_there[first] {
                continue;
            }
            let (x, y) = (first % across, first / across);
            let wide = (x..across).take_while(|x| !is_there[y * across + x]).count();
            let is_open = |row: &usize| (x..x + wide).all(|x| !is_there[row * across + x]);
            let high = (y..down).take_while(is_open).count();
            let side = |tile: usize, end: u32| (tile as u32 * Settings::TILE).min(end);
            let [x1, y1] = [side(x + wide, settings.width), side(y + high, settings.height)];
            let gap = [side(x, settings.width), side(y, settings.height), x1, y1];
            tiles(gap).for_each(|tile| is_there[tile] = true);
            gaps.push(gap);
        }
        Ok(Self { used, duplicates, gaps })
    }
}

fn finished(content: Content) -> Option<Vec<Pixel>> {
    if let Content::Pixels(pixels) = content { Some(pixels) } else { None }
}

/// Reads the values of tiles, of which `take` has those of each; where there are none, they are `nothing`.
fn assemble<T: Copy + Send>(
    files: &[&PieceHeader],
    whole: Area,
    nothing: T,
    take: impl Fn(Content) -> Option<Vec<T>> + Sync,
    progress: &(dyn Fn(u64) + Sync),
) -> Result<Vec<T>, String> {
    let all = Mutex::new(vec![nothing; count(whole)]);
    let read = |file: &&PieceHeader| {
        let piece = PieceFile::open(&file.path).and_then(|mut file| file.read());
        progress(1);
        let Piece { area, content } = piece.map_err(|error| error.to_string())?;
        let values = take(content).filter(|_| area == file.area).ok_or_else(|| changed(file))?;
        paste(&mut all.lock().unwrap_or_else(|_| unreachable!("nothing panics")), whole, area, values);
        Ok(())
    };
    let read: Vec<Result<(), String>> = files.par_iter().map(read).collect();
    refuse(read.into_iter().filter_map(Result::err).collect())?;
    Ok(all.into_inner().unwrap_or_else(|_| unreachable!("nothing panics")))
}
