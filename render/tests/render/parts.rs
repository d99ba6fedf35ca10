//! Parts of an image make the image, bit for bit, however it was split, and nothing else.

use etendue_oracle::tier::cases;
use etendue_render::area::{Area, count};
use etendue_render::drive::{Content, Samples};
use etendue_render::film::Film;
use etendue_render::merge::{MergeGoal, MergeOutcome, Merged, merge};
use etendue_render::parts::{self, PartFile, Piece, PieceKind};
use etendue_render::sums::{Block, Join, Moments, Planes, Sums, blocks};
use etendue_render::{Frame, Sampler, Sensor, Settings, Technique, World, scene};
use std::ops::Range;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU32, Ordering};

/// A random number generator (Knuth's MMIX).
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % n
    }
    fn shuffle<T>(&mut self, items: &mut [T]) {
        for i in (1..items.len()).rev() {
            items.swap(i, self.below(i + 1));
        }
    }
    /// A number from 0 to 1 with an exponent of its own.
    fn number(&mut self) -> f32 {
        let exponent = 12 - self.below(24) as i32;
        (self.below(1 << 24) as f32 / (1 << 24) as f32) * (exponent as f32).exp2()
    }
    /// Splits a range into ranges with ends anywhere.
    fn split(&mut self, range: Range<u32>, most: usize) -> Vec<Range<u32>> {
        let mut ends: Vec<u32> =
            (0..self.below(most)).map(|_| range.start + self.below(range.len()) as u32).chain([range.start]).collect();
        ends.sort_unstable();
        ends.dedup();
        ends.push(range.end);
        ends.windows(2).map(|pair| pair[0]..pair[1]).collect()
    }
    /// Splits an area into tiles at random, also at different places in each row.
    fn areas(&mut self, settings: &Settings) -> Vec<Area> {
        let tiles = |side: u32| 0..side.div_ceil(16);
        let mut all = Vec::new();
        for rows in self.split(tiles(settings.height), 3) {
            for columns in self.split(tiles(settings.width), 3) {
                let [x0, x1] = [columns.start, columns.end].map(|x| (16 * x).min(settings.width));
                let [y0, y1] = [rows.start, rows.end].map(|y| (16 * y).min(settings.height));
                all.push([x0, y0, x1, y1]);
            }
        }
        all
    }
}

/// A temporary folder, removed when the test ends.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Self {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let name = format!("etendue-parts-{}-{}", std::process::id(), NEXT.fetch_add(1, Ordering::Relaxed));
        let path = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// An image and its parts.
struct Job {
    world: World,
    frame: Frame,
    folder: Folder,
    written: usize,
}

impl Job {
    fn new(name: &str, settings: Settings) -> Self {
        let scene = scene::load(name).unwrap();
        let frame = Frame::new(&scene, settings, Sensor::Radiance).unwrap();
        Self { world: World::new(&scene).unwrap(), frame, folder: Folder::new(), written: 0 }
    }
    fn film(&self) -> Film {
        self.world.render(&self.frame.settings, &|_| ()).0
    }
    fn write_of(&mut self, frame: &Frame, pieces: Vec<Piece>) -> PathBuf {
        let path = self.folder.0.join(format!("{}.exr", self.written));
        self.written += 1;
        parts::write(&path, frame, pieces).unwrap();
        path
    }
    fn write(&mut self, pieces: Vec<Piece>) -> PathBuf {
        self.write_of(&self.frame.clone(), pieces)
    }
    fn piece(&self, area: Area, range: Range<u32>) -> Piece {
        let settings = &self.frame.settings;
        let samples = if range == (0..settings.spp) { Samples::All } else { Samples::Range(range) };
        let (content, _) = self.world.view(settings).render(area, samples, &|_| ());
        Piece { area, content }
    }
    /// Renders all parts of a random split.
    fn split(&mut self, random: &mut Random, most: usize) -> Vec<PathBuf> {
        let mut files = Vec::new();
        for area in random.areas(&self.frame.settings) {
            for range in random.split(0..self.frame.settings.spp, most) {
                let piece = self.piece(area, range);
                files.push(self.write(vec![piece]));
            }
        }
        files
    }
    fn image(&self, files: &[PathBuf]) -> Film {
        match merge(files, MergeGoal::Image, &|_| ()).unwrap().merged {
            Merged::Image(film) => film,
            Merged::Part(_) => panic!("not an image"),
        }
    }
    /// Merges some of the files to a part, which replaces them.
    fn group(&mut self, files: &mut Vec<PathBuf>, random: &mut Random) {
        random.shuffle(files);
        let some: Vec<_> = files.drain(..1 + random.below(files.len())).collect();
        let outcome = merge(&some, MergeGoal::Part, &|_| ()).unwrap();
        let Merged::Part(pieces) = outcome.merged else { panic!("not a part") };
        files.push(self.write(pieces));
    }
}

const SETTINGS: Settings = Settings {
    width: 50,
    height: 37,
    spp: 24,
    technique: Technique::Auto,
    depth: 8,
    sampler: Sampler::Sobol,
    sets: 0,
    seed: 3,
};

/// All samplers with sets of whole packets, of parts of packets and of several lengths; techniques that choose lights in every way.
const JOBS: [(&str, Technique, Sampler, u32, u32); 16] = [
    ("quads", Technique::Auto, Sampler::Sobol, 64, 0),
    ("quads", Technique::SolidAngle, Sampler::Sobol, 32, 1),
    ("quads", Technique::SolidAngle, Sampler::Independent, 21, 0),
    ("quads", Technique::MisPower, Sampler::Stratified, 36, 0),
    ("cornell-box", Technique::Analytic, Sampler::Stratified, 20, 2),
    ("mirror-room", Technique::Analytic, Sampler::Sobol, 20, 0),
    ("mirror-room", Technique::Analytic, Sampler::Independent, 33, 0),
    ("plates", Technique::Auto, Sampler::Sobol, 24, 4),
    ("terrain", Technique::Analytic, Sampler::ZOrder, 18, 0),
    ("triangle-light", Technique::Analytic, Sampler::Stratified4d, 32, 0),
    ("defocus", Technique::Auto, Sampler::Sobol4d, 12, 1),
    ("defocus", Technique::Analytic, Sampler::Independent, 16, 0),
    ("sky", Technique::Brdf, Sampler::Sobol, 10, 0),
    ("sphere-light", Technique::UniformHemisphere, Sampler::Independent, 5, 0),
    ("chandelier", Technique::Auto, Sampler::Sobol, 16, 0),
    ("quads", Technique::Area, Sampler::Sobol, 1, 0),
];

#[test]
fn any_split_order_and_grouping_makes_the_image() {
    let mut random = Random(1);
    for (name, technique, sampler, spp, sets) in JOBS.into_iter().step_by(cases(3, 1)) {
        let mut job = Job::new(name, Settings { technique, sampler, spp, sets, ..SETTINGS });
        let film = job.film();
        for most in [4, 9] {
            let mut files = job.split(&mut random, most);
            assert!(job.image(&files) == film, "{name} {technique:?} {sampler:?} {spp}: {files:?}");
            random.shuffle(&mut files);
            assert!(job.image(&files) == film, "{name} {technique:?} {sampler:?} {spp}, shuffled: {files:?}");
            while files.len() > 1 {
                job.group(&mut files, &mut random);
                assert!(job.image(&files) == film, "{name} {technique:?} {sampler:?} {spp}, grouped: {files:?}");
            }
            // idempotent: the whole, as a part, is the whole, and twice the same is once
            job.group(&mut files, &mut random);
            let copy = job.folder.0.join("copy.exr");
            std::fs::copy(&files[0], &copy).unwrap();
            let MergeOutcome { duplicates, merged, .. } =
                merge(&[files[0].clone(), copy.clone()], MergeGoal::Image, &|_| ()).unwrap();
            assert!(merged == Merged::Image(film.clone()) && duplicates == [copy], "{name}");
        }
    }
}

/// With the adaptive sampler, any tiles of the pilot and any tiles after it make the image.
#[test]
fn adaptive_parts_make_the_image() {
    let mut random = Random(2);
    for (name, technique, spp, sets) in [
        ("quads", Technique::SolidAngle, 64, 0),
        ("quads", Technique::Auto, 32, 1),
        ("mirror-room", Technique::Auto, 100, 2),
        ("plates", Technique::MisPower, 48, 0),
        ("city", Technique::Auto, 32, 0),
    ]
    .into_iter()
    .take(cases(2, 5))
    {
        let sampler = Sampler::Adaptive;
        let mut job = Job::new(name, Settings { technique, sampler, spp, sets, ..SETTINGS });
        let (film, settings) = (job.film(), job.frame.settings);
        let mut pilots = Vec::new();
        for area in random.areas(&settings) {
            let (content, _) = job.world.view(&settings).render(area, Samples::Pilot, &|_| ());
            pilots.push(job.write(vec![Piece { area, content }]));
        }
        random.shuffle(&mut pilots);
        let missing = merge(&pilots[1..], MergeGoal::Partial, &|_| ());
        assert!(pilots.len() == 1 || missing.unwrap_err().contains("--pilot --tile"), "{name}");
        let Merged::Part(whole) = merge(&pilots, MergeGoal::Image, &|_| ()).unwrap().merged else { panic!("{name}") };
        let pilot = job.write(whole);
        let mut files = Vec::new();
        for area in random.areas(&settings) {
            let pieces = PartFile::open(&pilot).unwrap().read_rows(&(area[1]..area[3])).unwrap();
            let Content::Allotment(allotment) = &pieces[0].content else { panic!("{name}") };
            let (content, _) = job.world.view(&settings).render(area, Samples::Rest(&allotment.crop(area)), &|_| ());
            files.push(job.write(vec![Piece { area, content }]));
        }
        random.shuffle(&mut files);
        assert!(job.image(&files) == film, "{name} {technique:?} {spp}");
        // a pilot is no part of the image
        let error = merge(&[files, pilots].concat(), MergeGoal::Image, &|_| ()).unwrap_err();
        assert!(error.contains("belongs to the pilot"), "{error}");
    }
}

#[test]
fn what_does_not_fit_is_refused_and_named() {
    let mut job = Job::new("quads", SETTINGS);
    let [left, right] = [[0, 0, 32, 37], [32, 0, 50, 37]];
    let add = |job: &mut Job, area, range: Range<u32>| {
        let piece = job.piece(area, range);
        job.write(vec![piece])
    };
    let parts = [add(&mut job, left, 0..8), add(&mut job, left, 8..24), add(&mut job, right, 0..24)];
    let film = job.film();
    assert!(job.image(&parts) == film);
    let refused = |files: &[PathBuf], goal: MergeGoal, says: &[&str]| {
        let error = merge(files, goal, &|_| ()).unwrap_err();
        says.iter().for_each(|part| assert!(error.contains(part), "{error:?} should contain {part:?}"));
    };
    let names: Vec<_> = parts.iter().map(|path| path.to_string_lossy().into_owned()).collect();

    // gaps, with the options that fill them
    refused(&parts[1..], MergeGoal::Image, &["1 part", "--range 0:8 --tile 0,0,32,37"]);
    refused(&parts[..2], MergeGoal::Image, &["--range 0:24 --tile 32,0,50,37"]);
    let partial = merge(&parts[1..], MergeGoal::Partial, &|_| ()).unwrap();
    assert_eq!(partial.gaps, [(left, 0..8)]);
    let Merged::Image(some) = partial.merged else { panic!("not an image") };
    for (i, (some, all)) in some.pixels.iter().zip(&film.pixels).enumerate() {
        let is_left = i % 50 < 32;
        assert_eq!(some.samples, if is_left { 16 } else { 24 });
        assert!(some == all || is_left, "{i}");
        // 4 samples of the first set and 12 of the second
        assert!(some.variance.iter().all(|v| v.is_finite()), "{i}: {some:?}");
    }
    let Merged::Image(some) = merge(&parts[..1], MergeGoal::Partial, &|_| ()).unwrap().merged else {
        panic!("not an image")
    };
    assert!(
        some.pixels[40] == etendue_render::film::Pixel { mean: [0.0; 3], variance: [f32::INFINITY; 3], samples: 0 }
    );

    // overlaps, of ranges and of areas
    let [twice, across] = [add(&mut job, left, 7..9), add(&mut job, [16, 0, 50, 37], 0..24)];
    refused(&[&parts[..], &[twice]].concat(), MergeGoal::Image, &[&names[0], "both hold --range 7:8 --tile 0,0,32,37"]);
    refused(
        &[&parts[..], &[across]].concat(),
        MergeGoal::Image,
        &[&names[0], "both hold --range 0:8 --tile 16,0,32,37"],
    );

    // parts of other images
    let settings = SETTINGS;
    for (name, settings, says) in [
        ("quads", Settings { seed: 4, ..settings }, "its seed is 4, not 3"),
        ("quads", Settings { spp: 48, ..settings }, "its number of samples per pixel is 48, not 24"),
        ("quads", Settings { technique: Technique::Area, ..settings }, "its technique is \"area\", not \"auto\""),
        ("quads", Settings { sampler: Sampler::Stratified, ..settings }, "its sampler is"),
        ("quads", Settings { width: 64, ..settings }, "its width is 64, not 50"),
        ("cornell-box", settings, "its scene is \"cornell-box\", not \"quads\""),
    ] {
        let mut other = Job::new(name, settings);
        let alien = add(&mut other, left, 0..8);
        let alien_name = alien.to_string_lossy().into_owned();
        refused(
            &[&[alien], &parts[..]].concat(),
            MergeGoal::Image,
            &[&alien_name, "not a part of the same image", says],
        );
    }
    let build = Frame { build: "0.0.0 another".into(), ..job.frame.clone() };
    let piece = job.piece(left, 0..8);
    let alien = job.write_of(&build, vec![piece]);
    refused(&[&[alien], &parts[..]].concat(), MergeGoal::Image, &["its build of etendue is \"0.0.0 another\""]);

    // other values for the same samples
    let mut piece = job.piece(left, 0..8);
    let Content::Range(_, planes) = &mut piece.content else { panic!("a range") };
    planes[0].sums[7][1] += 1e-9;
    let wrong = job.write(vec![piece]);
    let wrong_name = wrong.to_string_lossy().into_owned();
    refused(&[&parts[..], &[wrong]].concat(), MergeGoal::Image, &[&names[0], &wrong_name, "different values"]);
    refused(&[], MergeGoal::Image, &["there are no parts"]);
}

/// A damaged part is an error that names it, or the part is as it was: never other values.
#[test]
fn damaged_parts_are_noticed() {
    let mut job = Job::new("quads", Settings { width: 32, height: 20, ..SETTINGS });
    let piece = job.piece([0, 0, 32, 20], 3..19);
    let path = job.write(vec![piece.clone()]);
    let bytes = std::fs::read(&path).unwrap();
    let read = |bytes: &[u8]| {
        let mut part = PartFile::new(&path, std::io::Cursor::new(bytes.to_vec()), bytes.len() as u64)?;
        Ok::<_, etendue_render::files::FileError>((part.frame.clone(), part.read()?))
    };
    assert_eq!(read(&bytes).unwrap(), (job.frame.clone(), vec![piece.clone()]));
    let name = path.to_string_lossy().into_owned();
    let mut random = Random(5);
    for length in (0..bytes.len()).step_by(1 + bytes.len() / 200) {
        let error = read(&bytes[..length]).unwrap_err().to_string();
        assert!(error.starts_with(&name), "{error}");
    }
    let (mut noticed, tries) = (0, 1000);
    for _ in 0..tries {
        let mut damaged = bytes.clone();
        let at = random.below(bytes.len());
        damaged[at] ^= 1 << random.below(8);
        match read(&damaged) {
            Ok((frame, pieces)) => assert!(frame != job.frame || pieces == [piece.clone()], "byte {at}"),
            Err(error) => {
                assert!(error.to_string().starts_with(&name), "{error}");
                noticed += 1;
            }
        }
    }
    assert!(noticed > tries * 9 / 10, "{noticed} of {tries}");
}

/// A pixel's sums do not depend on the order in which blocks arrive, and are as exact as sums of f32 in octets can be.
#[test]
fn sums_are_those_of_a_tree() {
    let mut random = Random(6);
    for count in [1_u32, 2, 3, 7, 8, 9, 16, 31, 64, 100, 1000, 4097] {
        let samples: Vec<[f32; 3]> = (0..count).map(|_| [(); 3].map(|()| random.number())).collect();
        let one = |first: u32| {
            let sum = samples[first as usize].map(f64::from);
            (Block { set: 0, first, count: 1 }, Moments { sum, squares: [0.0; 3] })
        };
        let mut whole = Sums::<Moments>::default();
        (0..count).for_each(|first| whole.insert(one(first).0, one(first).1));
        let expected: Vec<_> = blocks(0..count, 0).collect();
        assert_eq!(whole.blocks().iter().map(|(block, _)| *block).collect::<Vec<_>>(), expected);
        let mut order: Vec<u32> = (0..count).collect();
        for _ in 0..4 {
            random.shuffle(&mut order);
            let mut other = Sums::<Moments>::default();
            order.iter().for_each(|&first| other.insert(one(first).0, one(first).1));
            assert_eq!(other, whole);
        }
        let folded = whole.finish();
        assert_eq!(folded.len(), 1);
        let n = f64::from(count);
        for k in 0..3 {
            let values = || samples.iter().map(|x| f64::from(x[k]));
            let (sum, mean) = (values().sum::<f64>(), values().sum::<f64>() / n);
            let squares = values().map(|x| (x - mean).powi(2)).sum::<f64>();
            let Moments { sum: own_sum, squares: own_squares } = folded[0].1;
            // three roundings to f32 of positive numbers
            assert!((own_sum[k] - sum).abs() <= 3.0 * sum * 2.0_f64.powi(-24), "{count}: {} {sum}", own_sum[k]);
            assert!((own_squares[k] - squares).abs() <= 1e-6 * (squares + mean * mean), "{count}: {squares}");
        }
    }
    // planes join as pixels do
    let [left, right] = [0, 4].map(|first| Block { set: 1, first, count: 4 });
    let of = |x: f64| Moments { sum: [x, 2.0 * x, 1.0], squares: [0.5, x, 0.0] };
    let mut pixel = of(0.1);
    pixel.join(left, of(0.3), right);
    let mut planes = Planes { sums: vec![of(0.1).sum; 2], squares: vec![of(0.1).squares; 2] };
    planes.join(left, Planes { sums: vec![of(0.3).sum; 2], squares: vec![of(0.3).squares; 2] }, right);
    assert_eq!(planes, Planes { sums: vec![pixel.sum; 2], squares: vec![pixel.squares; 2] });
}

/// The blocks of a range are in the tree, in order, without gaps, and as few as can be.
#[test]
fn blocks_are_the_largest_of_the_tree() {
    for span in [0, 1, 7, 8, 16, 20] {
        for (start, end) in (0..40).flat_map(|start| (start..40).map(move |end| (start, end))) {
            let mut next = start;
            for block in blocks(start..end, span) {
                assert_eq!(block.set * span + block.first, next);
                assert!(block.count.is_power_of_two() && block.first.is_multiple_of(block.count));
                let twice = block.first / (2 * block.count) * (2 * block.count);
                let parent = block.set * span + twice..block.set * span + twice + 2 * block.count;
                let is_whole =
                    parent.start >= start && parent.end <= end && (span == 0 || twice + 2 * block.count <= span);
                assert!(!is_whole, "{start}..{end} {span}: {block:?}");
                next += block.count;
            }
            assert_eq!(next, end, "{start}..{end} {span}");
        }
    }
}

/// Every kind of piece is read as it was written, and its header says what it is.
#[test]
fn pieces_are_read_as_written() {
    let mut job = Job::new("quads", Settings { sampler: Sampler::Adaptive, spp: 64, ..SETTINGS });
    let (settings, area) = (job.frame.settings, job.frame.settings.whole());
    let (content, _) = job.world.view(&settings).render(area, Samples::Pilot, &|_| ());
    let pilot = Piece { area, content };
    let lights = if let PieceKind::Pilot(lights) = pilot.kind() { lights } else { 0 };
    let path = job.write(vec![pilot.clone()]);
    assert_eq!(PartFile::open(&path).unwrap().read().unwrap(), [pilot]);
    let Merged::Part(pieces) = merge(&[path], MergeGoal::Image, &|_| ()).unwrap().merged else { panic!("a part") };
    let whole = job.write(pieces.clone());
    let mut part = PartFile::open(&whole).unwrap();
    assert_eq!(part.pieces[0].kind, PieceKind::Allotment(lights));
    assert_eq!(part.read().unwrap(), pieces);
    let rows = part.read_rows(&(16..20)).unwrap();
    assert_eq!(rows[0].area, [0, 16, 50, 32]);
    let (Content::Allotment(some), Content::Allotment(all)) = (&rows[0].content, &pieces[0].content) else {
        panic!("an allotment")
    };
    assert_eq!(*some, all.crop([0, 16, 50, 32]));
    assert_eq!(some.packets.len(), count(rows[0].area));
}

/// Areas of whole tiles: their sides are multiples of 16 or the image's edges, they are not empty, and they lie within the image.
#[test]
fn only_whole_tiles_are_an_area_of_tiles() {
    let settings = Settings { width: 40, height: 32, ..SETTINGS };
    let sides =
        |end: u32| [0, 1, 15, 16, 17, 31, 32, 33, 39, 40, 41, 48].map(move |at| (at, at % 16 == 0 || at == end));
    for (x0, is_x0) in sides(40) {
        for (x1, is_x1) in sides(40) {
            for (y0, is_y0) in sides(32) {
                for (y1, is_y1) in sides(32) {
                    let within = x0 < x1 && x1 <= 40 && y0 < y1 && y1 <= 32;
                    let expected = within && is_x0 && is_x1 && is_y0 && is_y1;
                    assert_eq!(settings.is_of_tiles([x0, y0, x1, y1]), expected, "{:?}", [x0, y0, x1, y1]);
                }
            }
        }
    }
}
