//! Puts the parts of an image together: exactly, in any order and grouping.

use crate::area::{Area, count, crop, paste};
use crate::drive::{Allotment, Content, Statistics};
use crate::film::{Film, Pixel};
use crate::frame::Frame;
use crate::parts::{PartFile, Piece, PieceKind};
use crate::sums::{Block, Moments, Planes, Sums, blocks};
use rayon::prelude::*;
use serde_json::Value;
use std::collections::{BTreeMap, HashMap};
use std::fmt::Write;
use std::mem::take;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Most problems that a message lists.
const LISTED: usize = 10;
/// About the most numbers that are read at once.
const AT_ONCE: usize = 1 << 25;

/// What to make of the parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MergeGoal {
    /// The whole image; what is missing is an error.
    Image,
    /// An image of the samples that are there.
    Partial,
    /// One part that knows all that they know.
    Part,
}

/// What the parts make.
#[derive(Clone, Debug, PartialEq)]
pub enum Merged {
    /// An image.
    Image(Film),
    /// The contents of one part.
    Part(Vec<Piece>),
}

/// An area, and a range of the samples of its pixels, that no part holds.
pub type Gap = (Area, Range<u32>);

/// The parts, put together.
#[derive(Clone, Debug, PartialEq)]
pub struct MergeOutcome {
    /// What they are parts of.
    pub frame: Frame,
    /// What they make.
    pub merged: Merged,
    /// The number of files that were used.
    pub used: usize,
    /// The files of which others have the same contents.
    pub duplicates: Vec<PathBuf>,
    /// What is missing.
    pub gaps: Vec<Gap>,
}

/// A gap as the options that render it.
fn options(area: Area, range: &Range<u32>) -> String {
    format!("--range {}:{} --tile {}", range.start, range.end, text_of(area))
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

/// The headers of a file.
struct Headers {
    path: PathBuf,
    frame: Frame,
    pieces: Vec<((Area, PieceKind), Value)>,
}

/// The rectangles between all edges of all pieces. A piece covers each of them wholly or not at all.
struct Cells {
    columns: Vec<u32>,
    rows: Vec<u32>,
}

impl Cells {
    fn new(areas: impl Iterator<Item = Area>) -> Self {
        let (mut columns, mut rows) = (Vec::new(), Vec::new());
        for [x0, y0, x1, y1] in areas {
            columns.extend([x0, x1]);
            rows.extend([y0, y1]);
        }
        for edges in [&mut columns, &mut rows] {
            edges.sort_unstable();
            edges.dedup();
        }
        Self { columns, rows }
    }
    /// The indices of the cells of an area, row by row.
    fn of(&self, [x0, y0, x1, y1]: Area) -> impl Iterator<Item = usize> {
        let at = |edges: &[u32], edge| edges.partition_point(|&other| other < edge);
        let (across, width) = (at(&self.columns, x0)..at(&self.columns, x1), self.columns.len() - 1);
        (at(&self.rows, y0)..at(&self.rows, y1)).flat_map(move |y| across.clone().map(move |x| y * width + x))
    }
    fn area(&self, cell: usize) -> Area {
        let width = self.columns.len() - 1;
        let (x, y) = (cell % width, cell / width);
        [self.columns[x], self.rows[y], self.columns[x + 1], self.rows[y + 1]]
    }
    fn count(&self) -> usize {
        (self.columns.len() - 1) * (self.rows.len() - 1)
    }
}

/// What is known of a cell.
#[derive(Clone, Default)]
struct Cell {
    pixels: Option<Vec<Pixel>>,
    sums: Sums<Planes>,
}

impl Cell {
    /// The finished pixels, once all samples are there.
    fn complete(&mut self, frame: &Frame) {
        if self.pixels.is_none() && self.sums.count() == frame.settings.spp {
            self.pixels = Some(self.finish(frame));
        }
    }
    /// The pixels of the samples that are there.
    fn finish(&mut self, frame: &Frame) -> Vec<Pixel> {
        let mut sums = take(&mut self.sums);
        let sets = sums.finish();
        let moments = |planes: &Planes, i: usize| Moments {
            sum: planes.sums[i],
            squares: planes.squares.get(i).copied().unwrap_or_default(),
        };
        let pixels = sets.first().map_or(0, |(_, planes)| planes.sums.len());
        let independent = !frame.settings.sampler.has_sets();
        let pixel = |i: usize| {
            Pixel::of_sets(sets.iter().map(|(block, planes)| (block.count, moments(planes, i))), independent)
        };
        (0..pixels).into_par_iter().map(pixel).collect()
    }
    /// The pieces of a part: finished pixels, or one piece for each run of samples without a gap.
    fn pieces(&mut self, area: Area, frame: &Frame) -> Vec<Piece> {
        if let Some(pixels) = self.pixels.take() {
            return vec![Piece { area, content: Content::Pixels(pixels) }];
        }
        let mut runs: Vec<(Range<u32>, Vec<Planes>)> = Vec::new();
        for (block, planes) in take(&mut self.sums).into_blocks() {
            let first = block.set * frame.span() + block.first;
            match runs.last_mut().filter(|(range, _)| range.end == first) {
                Some((range, all)) => {
                    range.end += block.count;
                    all.push(planes);
                }
                None => runs.push((first..first + block.count, vec![planes])),
            }
        }
        let piece = |(range, planes)| Piece { area, content: Content::Range(range, planes) };
        runs.into_iter().map(piece).collect()
    }
}

/// Puts the parts in these files together. `progress` receives the number of files that have been read since the last call.
///
/// # Errors
/// Fails if a file is not a part, is damaged, or is a part of another image than most; if two files have some samples in common, unless
/// their contents are the same; and if samples are missing, unless the goal allows it. The message names the files and the gaps.
pub fn merge(files: &[PathBuf], goal: MergeGoal, progress: &(dyn Fn(u64) + Sync)) -> Result<MergeOutcome, String> {
    let headers = read_headers(files)?;
    let frame = common_frame(&headers)?;
    let is_pilot = |kind: &PieceKind| matches!(kind, PieceKind::Pilot(_));
    let pilots = headers.iter().all(|file| file.pieces.iter().all(|((_, kind), _)| is_pilot(kind)));
    if !pilots {
        let of_pilot = |kind: &PieceKind| matches!(kind, PieceKind::Pilot(_) | PieceKind::Allotment(_));
        let odd = headers.iter().filter(|file| file.pieces.iter().any(|((_, kind), _)| of_pilot(kind)));
        let line = |file: &Headers| {
            let is_whole = file.pieces.iter().any(|((_, kind), _)| matches!(kind, PieceKind::Allotment(_)));
            let what =
                if is_whole { "is a whole pilot already, for --after" } else { "belongs to the pilot, others do not" };
            format!("{}: {what}", file.path.display())
        };
        let odd: Vec<_> = odd.map(line).collect();
        if !odd.is_empty() {
            return Err(list(odd));
        }
    }
    let (used, duplicates) = without_duplicates(&headers)?;
    let areas = used.iter().flat_map(|file| file.pieces.iter().map(|((area, _), _)| *area));
    let cells = Cells::new(areas.chain([frame.settings.whole()]));
    let gaps = gaps(&used, &cells, &frame)?;
    if !gaps.is_empty() && (goal == MergeGoal::Image || pilots && goal == MergeGoal::Partial) {
        let (what, help) = if pilots { ("pilot", "") } else { ("image", "; --partial writes an image without them") };
        let line = |(area, range): &Gap| {
            if pilots { format!("--pilot --tile {}", text_of(*area)) } else { options(*area, range) }
        };
        let count = gaps.len();
        return Err(format!("the {what} lacks {count} part(s){help}:\n{}", list(gaps.iter().map(line).collect())));
    }
    let merged = if pilots {
        let pieces = read_pieces(&used, progress)?;
        if goal == MergeGoal::Part { Merged::Part(pieces) } else { Merged::Part(vec![allot(&frame, pieces)?]) }
    } else {
        join(&used, &cells, &frame, goal, progress)?
    };
    let (used, duplicates) = (used.len(), duplicates.into_iter().map(|file| file.path.clone()).collect());
    Ok(MergeOutcome { frame, merged, used, duplicates, gaps })
}

/// How many samples follow the pilot in this file, for the pixels of an area. The file is the merge of a pilot, or a part that holds all
/// of one.
///
/// # Errors
/// Fails if the file is damaged, holds no whole pilot, or that of another image than `frame`.
pub fn allotment(path: &Path, frame: &Frame, area: Area) -> Result<Allotment, String> {
    let wrong = |what: &str| format!("{}: {what}", path.display());
    let mut file = PartFile::open(path).map_err(|error| error.to_string())?;
    if let Some(difference) = frame.difference(&file.frame) {
        return Err(wrong(&format!("the pilot of another image: {difference}")));
    }
    let whole = frame.settings.whole();
    let merged =
        matches!(&file.pieces[..], [piece] if piece.area == whole && matches!(piece.kind, PieceKind::Allotment(_)));
    let piece = if merged {
        file.read_rows(&(area[1]..area[3])).map_err(|error| error.to_string())?.remove(0)
    } else {
        if !file.pieces.iter().all(|piece| matches!(piece.kind, PieceKind::Pilot(_))) {
            return Err(wrong("this is no pilot"));
        }
        let headers = read_headers(&[path.to_owned()])?;
        let used: Vec<&Headers> = headers.iter().collect();
        let cells = Cells::new(file.pieces.iter().map(|piece| piece.area).chain([whole]));
        let gaps = gaps(&used, &cells, frame)?;
        if !gaps.is_empty() {
            let lines = gaps.iter().map(|(area, _)| format!("--pilot --tile {}", text_of(*area))).collect();
            return Err(wrong(&format!(
                "not the whole pilot; merge it with the parts that it lacks:\n{}",
                list(lines)
            )));
        }
        allot(frame, read_pieces(&used, &|_| ())?)?
    };
    let Content::Allotment(allotment) = piece.content else { return Err(wrong("not what its header says")) };
    Ok(allotment.crop(area))
}

fn text_of([x0, y0, x1, y1]: Area) -> String {
    format!("{x0},{y0},{x1},{y1}")
}

fn read_headers(files: &[PathBuf]) -> Result<Vec<Headers>, String> {
    let read = |path: &PathBuf| {
        let file = PartFile::open(path)?;
        let pieces = file.pieces.into_iter().map(|piece| ((piece.area, piece.kind), piece.checksums)).collect();
        Ok(Headers { path: path.clone(), frame: file.frame, pieces })
    };
    let read: Vec<Result<Headers, crate::files::FileError>> = files.par_iter().map(read).collect();
    let (mut headers, mut errors) = (Vec::new(), Vec::new());
    for file in read {
        match file {
            Ok(file) => headers.push(file),
            Err(error) => errors.push(error.to_string()),
        }
    }
    if headers.is_empty() && errors.is_empty() {
        return Err("there are no parts".into());
    }
    if errors.is_empty() { Ok(headers) } else { Err(list(errors)) }
}

/// The frame that most files are parts of.
fn common_frame(headers: &[Headers]) -> Result<Frame, String> {
    let mut counts: Vec<(&Frame, usize)> = Vec::new();
    for file in headers {
        match counts.iter_mut().find(|(frame, _)| **frame == file.frame) {
            Some((_, count)) => *count += 1,
            None => counts.push((&file.frame, 1)),
        }
    }
    // the first of the most frequent ones
    let most = counts.iter().map(|(_, count)| *count).max().unwrap_or(0);
    let frame =
        counts.iter().find(|(_, count)| *count == most).map_or_else(|| unreachable!("there is a file"), |f| f.0);
    let first = headers.iter().find(|file| file.frame == *frame).unwrap_or_else(|| unreachable!("it is a file's"));
    let other = |file: &Headers| {
        let difference = frame.difference(&file.frame)?;
        Some(format!("{}: not a part of the same image as {}: {difference}", file.path.display(), first.path.display()))
    };
    let others: Vec<_> = headers.iter().filter_map(other).collect();
    if others.is_empty() { Ok(frame.clone()) } else { Err(list(others)) }
}

/// The files without those that have the same contents as one before, and the latter.
fn without_duplicates(headers: &[Headers]) -> Result<(Vec<&Headers>, Vec<&Headers>), String> {
    let mut known: HashMap<Vec<String>, &Headers> = HashMap::new();
    let (mut used, mut duplicates, mut errors) = (Vec::new(), Vec::new(), Vec::new());
    for file in headers {
        let key = file.pieces.iter().map(|((area, kind), _)| format!("{area:?} {kind:?}")).collect();
        match known.get(&key) {
            None => {
                known.insert(key, file);
                used.push(file);
            }
            Some(first) if first.pieces == file.pieces => duplicates.push(file),
            Some(first) => errors.push(format!(
                "{} and {} hold different values for the same samples: render both again",
                first.path.display(),
                file.path.display()
            )),
        }
    }
    if errors.is_empty() { Ok((used, duplicates)) } else { Err(list(errors)) }
}

/// What is missing in each cell.
fn gaps(files: &[&Headers], cells: &Cells, frame: &Frame) -> Result<Vec<Gap>, String> {
    let spp = frame.settings.spp;
    let mut of_cell: Vec<Vec<(Range<u32>, usize)>> = vec![Vec::new(); cells.count()];
    for (index, file) in files.iter().enumerate() {
        for ((area, kind), _) in &file.pieces {
            for cell in cells.of(*area) {
                of_cell[cell].push((kind.range(spp), index));
            }
        }
    }
    let (mut gaps, mut overlaps) = (Vec::new(), Vec::new());
    for (cell, ranges) in of_cell.iter_mut().enumerate() {
        ranges.sort_by_key(|(range, index)| (range.start, range.end, *index));
        let mut next = 0;
        let mut last = 0;
        for (range, index) in ranges {
            if range.start < next {
                let [first, second] = [last, *index].map(|index: usize| files[index].path.display());
                let both = range.start..range.end.min(next);
                let pair = format!("{first} and {second} both hold {}", options(cells.area(cell), &both));
                overlaps.push(pair);
            } else if range.start > next {
                gaps.push((cells.area(cell), next..range.start));
            }
            if range.end > next {
                (next, last) = (range.end, *index);
            }
        }
        if next < spp {
            gaps.push((cells.area(cell), next..spp));
        }
    }
    if overlaps.is_empty() { Ok(gaps) } else { Err(list(overlaps)) }
}

/// Files of about [`AT_ONCE`] numbers, but at least one.
fn batches<'a>(files: &'a [&'a Headers]) -> impl Iterator<Item = &'a [&'a Headers]> {
    let mut start = 0;
    std::iter::from_fn(move || {
        let numbers = |file: &&Headers| -> usize { file.pieces.iter().map(|((area, _), _)| 16 * count(*area)).sum() };
        let mut sum = 0;
        let fits = |file: &&&Headers| {
            let is_first = sum == 0;
            sum += numbers(file);
            is_first || sum <= AT_ONCE
        };
        let taken = files[start..].iter().take_while(fits).count();
        let batch = &files[start..start + taken];
        start += taken;
        (taken > 0).then_some(batch)
    })
}

fn read_batch(batch: &[&Headers], progress: &(dyn Fn(u64) + Sync)) -> Result<Vec<Piece>, String> {
    let read = |file: &&Headers| {
        let pieces = PartFile::open(&file.path).and_then(|mut part| part.read());
        progress(1);
        pieces
    };
    let (mut all, mut errors) = (Vec::new(), Vec::new());
    for pieces in batch.par_iter().map(read).collect::<Vec<_>>() {
        match pieces {
            Ok(pieces) => all.extend(pieces),
            Err(error) => errors.push(error.to_string()),
        }
    }
    if errors.is_empty() { Ok(all) } else { Err(list(errors)) }
}

fn read_pieces(files: &[&Headers], progress: &(dyn Fn(u64) + Sync)) -> Result<Vec<Piece>, String> {
    let mut all = Vec::new();
    for batch in batches(files) {
        all.extend(read_batch(batch, progress)?);
    }
    Ok(all)
}

fn allot(frame: &Frame, pieces: Vec<Piece>) -> Result<Piece, String> {
    let whole = frame.settings.whole();
    let mut pilot = vec![Statistics::default(); count(whole)];
    for Piece { area, content } in pieces {
        let Content::Pilot(pixels) = content else { return Err("a part is not what its header says".into()) };
        paste(&mut pilot, whole, area, pixels);
    }
    Ok(Piece { area: whole, content: Content::Allotment(Allotment::new(&frame.settings, frame.lens, whole, &pilot)) })
}

fn join(
    files: &[&Headers],
    cells: &Cells,
    frame: &Frame,
    goal: MergeGoal,
    progress: &(dyn Fn(u64) + Sync),
) -> Result<Merged, String> {
    let whole = frame.settings.whole();
    let nothing = Pixel::of_sets(std::iter::empty(), false);
    let mut film = if goal == MergeGoal::Part { Vec::new() } else { vec![nothing; count(whole)] };
    let mut open: BTreeMap<usize, Cell> = BTreeMap::new();
    for batch in batches(files) {
        for Piece { area, content } in read_batch(batch, progress)? {
            for index in cells.of(area) {
                let cell = open.entry(index).or_default();
                let place = cells.area(index);
                match &content {
                    Content::Pixels(pixels) => cell.pixels = Some(crop(pixels, area, place, 1)),
                    Content::Range(range, of_blocks) => {
                        let cropped = |planes: &Planes| Planes {
                            sums: crop(&planes.sums, area, place, 1),
                            squares: if planes.squares.is_empty() {
                                Vec::new()
                            } else {
                                crop(&planes.squares, area, place, 1)
                            },
                        };
                        let blocks = blocks(range.clone(), frame.span());
                        let pairs: Vec<(Block, &Planes)> = blocks.zip(of_blocks).collect();
                        pairs.into_iter().for_each(|(block, planes)| cell.sums.insert(block, cropped(planes)));
                        cell.complete(frame);
                    }
                    Content::Pilot(_) | Content::Allotment(_) => {
                        return Err("a part is not what its header says".into());
                    }
                }
                if goal != MergeGoal::Part
                    && let Some(pixels) = cell.pixels.take()
                {
                    paste(&mut film, whole, place, pixels);
                    open.remove(&index);
                }
            }
        }
    }
    if goal == MergeGoal::Part {
        let pieces = open.into_iter().flat_map(|(index, mut cell)| cell.pieces(cells.area(index), frame));
        return Ok(Merged::Part(pieces.collect()));
    }
    for (index, mut cell) in open {
        paste(&mut film, whole, cells.area(index), cell.finish(frame));
    }
    Ok(Merged::Image(Film { width: whole[2], height: whole[3], pixels: film }))
}
