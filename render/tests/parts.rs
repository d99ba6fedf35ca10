//! Parts of an image make the image, bit for bit, however it was split, and nothing else.

use crate::kit::Folder;
use crate::random::Random;
use etendue_oracle::tier::cases;
use etendue_render::drive::merge::{MergeOutcome, Merged, merge};
use etendue_render::drive::parts::{self, Piece, PieceFile, PieceKind};
use etendue_render::drive::{Content, Samples};
use etendue_render::film::files::FileError;
use etendue_render::film::{Film, Pixel};
use etendue_render::scene::area::{Area, count};
use etendue_render::{Identity, Sampler, Sensor, Settings, Technique, World, film::image};
use std::ops::Range;
use std::path::{Path, PathBuf};

impl Random {
    fn shuffle<T>(&mut self, items: &mut [T]) {
        for i in (1..items.len()).rev() {
            items.swap(i, self.below(i + 1));
        }
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

/// An image and its parts.
struct Job {
    world: World,
    identity: Identity,
    folder: Folder,
    written: usize,
}

impl Job {
    fn new(name: &str, settings: Settings) -> Self {
        let scene = etendue_scene::load(name).unwrap();
        let identity = Identity::new(&scene, settings, Sensor::Radiance).of_parts();
        Self { world: World::new(&scene).unwrap(), identity, folder: Folder::new(), written: 0 }
    }
    fn film(&self) -> Film {
        self.world.render(&self.identity.settings, &|_| ()).0
    }
    fn write(&mut self, piece: Piece) -> PathBuf {
        let path = self.folder.path(&format!("{}.exr", self.written));
        self.written += 1;
        parts::write(&path, &self.identity, piece).unwrap();
        path
    }
    fn piece(&self, area: Area, samples: Samples) -> Piece {
        let (content, _) = self.world.view(&self.identity.settings).render(area, samples, &|_| ());
        Piece { area, content }
    }
    /// Renders some tiles.
    fn tile(&mut self, area: Area) -> PathBuf {
        let piece = self.piece(area, Samples::All);
        self.write(piece)
    }
    /// Writes the image, as if it were rendered at once.
    fn whole(&mut self) -> PathBuf {
        let path = self.folder.path(&format!("whole-{}.exr", self.identity.settings.seed));
        parts::write_image(&path, &self.identity.clone().of_image(), self.film().pixels).unwrap();
        path
    }
}

/// The image of these files.
fn merged(files: &[PathBuf]) -> Film {
    match merge(files, false, &|_| ()).unwrap().merged {
        Merged::Image(film) => film,
        Merged::Pilot(_) => panic!("not an image"),
    }
}

const SETTINGS: Settings = Settings { width: 50, height: 37, spp: 24, seed: 3, ..Settings::DEFAULT };

#[test]
fn any_tiles_in_any_order_make_the_image() {
    let mut random = Random::new(1);
    for (name, technique, sampler, spp, sets) in [
        ("quads", Technique::Auto, Sampler::Sobol, 64, 0),
        ("quads", Technique::SolidAngle, Sampler::Independent, 21, 0),
        ("cornell-box", Technique::Analytic, Sampler::Stratified, 20, 2),
        ("mirror-room", Technique::Analytic, Sampler::Independent, 33, 0),
        ("terrain", Technique::Analytic, Sampler::ZOrder, 18, 0),
        ("triangle-light", Technique::Analytic, Sampler::Sobol4d, 32, 0),
        ("defocus", Technique::Auto, Sampler::Sobol4d, 12, 1),
        ("chandelier", Technique::Auto, Sampler::Sobol, 16, 0),
        ("sky", Technique::Brdf, Sampler::Sobol, 1, 0),
    ]
    .into_iter()
    .step_by(cases(3, 1))
    {
        let mut job = Job::new(name, Settings { technique, sampler, spp, sets, ..SETTINGS });
        let film = job.film();
        let areas = random.areas(&job.identity.settings);
        let mut files: Vec<_> = areas.into_iter().map(|area| job.tile(area)).collect();
        random.shuffle(&mut files);
        assert!(merged(&files) == film, "{name} {technique:?} {sampler:?} {spp}: {files:?}");
        // twice the same is once; a whole image is one as it is
        if files.len() > 1 {
            let copy = job.folder.path("copy.exr");
            std::fs::copy(&files[0], &copy).unwrap();
            let with_copy = [&files[..], std::slice::from_ref(&copy)].concat();
            let MergeOutcome { duplicates, merged, .. } = merge(&with_copy, false, &|_| ()).unwrap();
            assert!(merged == Merged::Image(film.clone()) && duplicates == [copy], "{name}");
        }
        assert!(merged(&[job.whole()]) == film, "{name}");
    }
}

/// With the adaptive sampler, any tiles of the pilot and any tiles after it make the image.
#[test]
fn adaptive_parts_make_the_image() {
    let mut random = Random::new(2);
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
        let (film, settings) = (job.film(), job.identity.settings);
        let mut pilots = Vec::new();
        for area in random.areas(&settings) {
            let piece = job.piece(area, Samples::Pilot);
            pilots.push(job.write(piece));
        }
        random.shuffle(&mut pilots);
        let missing = merge(&pilots[1..], true, &|_| ());
        assert!(pilots.len() == 1 || missing.unwrap_err().contains("--pilot --tile"), "{name}");
        let Merged::Pilot(whole) = merge(&pilots, false, &|_| ()).unwrap().merged else { panic!("{name}") };
        let pilot = job.write(whole);
        let mut files = Vec::new();
        for area in random.areas(&settings) {
            let piece = PieceFile::open(&pilot).unwrap().read_rows(&(area[1]..area[3])).unwrap();
            let Content::Counts(counts) = &piece.content else { panic!("{name}") };
            let piece = job.piece(area, Samples::Rest(&counts.crop(area)));
            files.push(job.write(piece));
        }
        random.shuffle(&mut files);
        assert!(merged(&files) == film, "{name} {technique:?} {spp}");
        // a pilot is no part of the image
        let error = merge(&[files, pilots].concat(), false, &|_| ()).unwrap_err();
        assert!(error.contains("belongs to the pilot"), "{error}");
    }
}

fn refused(files: &[PathBuf], says: &[&str]) {
    let error = merge(files, false, &|_| ()).unwrap_err();
    says.iter().for_each(|part| assert!(error.contains(part), "{error:?} should contain {part:?}"));
}

fn text(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}

#[test]
fn what_does_not_fit_is_refused_and_named() {
    let mut job = Job::new("quads", SETTINGS);
    let areas = [[0, 0, 32, 16], [0, 16, 32, 37], [32, 0, 50, 37]];
    let parts = areas.map(|area| job.tile(area));
    let film = job.film();
    assert!(merged(&parts) == film);

    // gaps, with the options that fill them
    refused(&parts[2..], &["1 part", "--tile 0,0,32,37"]);
    refused(&[parts[0].clone()], &["2 part", "--tile 32,0,50,37\n--tile 0,16,32,37"]);
    let partial = merge(&parts[1..], true, &|_| ()).unwrap();
    assert_eq!(partial.gaps, [areas[0]]);
    let Merged::Image(some) = partial.merged else { panic!("not an image") };
    for (i, (some, all)) in some.pixels.iter().zip(&film.pixels).enumerate() {
        let nothing = Pixel { variance: [f32::INFINITY; 3], ..Pixel::default() };
        assert_eq!(*some, if i % 50 < 32 && i / 50 < 16 { nothing } else { *all }, "{i}");
    }

    // overlaps, also of the same tile with other values
    let across = job.tile([16, 0, 50, 16]);
    refused(&[&parts[..], &[across]].concat(), &[&text(&parts[0]), "both hold --tile 16,0,32,16"]);
    let mut piece = job.piece(areas[0], Samples::All);
    let Content::Pixels(pixels) = &mut piece.content else { panic!("pixels") };
    pixels[7].mean[1] += 1e-6;
    let wrong = job.write(piece);
    refused(
        &[&parts[..], std::slice::from_ref(&wrong)].concat(),
        &[&text(&parts[0]), &text(&wrong), "both hold --tile 0,0,32,16"],
    );
    refused(&[], &["there are no parts"]);

    // parts of other images
    for (name, settings, says) in [
        ("quads", Settings { seed: 4, ..SETTINGS }, "its seed is 4, not 3"),
        ("quads", Settings { spp: 48, ..SETTINGS }, "its number of samples per pixel is 48, not 24"),
        ("quads", Settings { technique: Technique::Area, ..SETTINGS }, "its technique is \"area\", not \"auto\""),
        ("quads", Settings { sampler: Sampler::Stratified, ..SETTINGS }, "its sampler is"),
        ("quads", Settings { width: 64, ..SETTINGS }, "its width is 64, not 50"),
        ("cornell-box", SETTINGS, "its scene is \"cornell-box\", not \"quads\""),
    ] {
        let mut other = Job::new(name, settings);
        let alien = other.tile(areas[0]);
        let name = text(&alien);
        refused(&[&[alien], &parts[..]].concat(), &[&name, "not a part of the same image", says]);
    }
    job.identity.build = Some("0.0.0 another".into());
    let alien = job.tile(areas[0]);
    refused(&[&[alien], &parts[..]].concat(), &["its build of etendue is \"0.0.0 another\""]);
}

/// Images of different seeds are averaged by the numbers of their samples, at once or in groups, in any order. Anything else that differs,
/// and samples that would count twice, are refused.
#[test]
fn images_of_different_seeds_are_averaged() {
    for sampler in [Sampler::Adaptive, Sampler::Independent] {
        let of = |settings: Settings| Job::new("quads", Settings { sampler, width: 32, height: 20, ..settings });
        let [mut one, mut two, mut three] =
            [(3, 64), (4, 32), (5, 16)].map(|(seed, spp)| of(Settings { seed, spp, ..SETTINGS }));
        let films = [one.film(), two.film(), three.film()];
        let files = [one.whole(), two.whole(), three.whole()];
        let outcome = merge(&files, false, &|_| ()).unwrap();
        let Merged::Image(mean) = &outcome.merged else { panic!("not an image") };
        for (i, pixel) in mean.pixels.iter().enumerate() {
            let all = || films.iter().map(|film| &film.pixels[i]);
            let n: u32 = all().map(|pixel| pixel.samples).sum();
            assert_eq!(pixel.samples, n);
            for k in 0..3 {
                let share = |pixel: &Pixel| f64::from(pixel.samples) / f64::from(n);
                let x: f64 = all().map(|pixel| share(pixel) * f64::from(pixel.mean[k])).sum();
                let v: f64 = all().map(|pixel| share(pixel).powi(2) * f64::from(pixel.variance[k])).sum();
                assert!((f64::from(pixel.mean[k]) - x).abs() <= 1e-7 * x, "{i}: {pixel:?} {x}");
                assert!((f64::from(pixel.variance[k]) - v).abs() <= 1e-7 * v, "{i}: {pixel:?} {v}");
            }
        }
        let identity = outcome.identity.clone();
        assert_eq!(identity.seeds().collect::<Vec<_>>(), [3, 4, 5]);
        assert_eq!(identity.settings.spp, 112);
        let backwards: Vec<_> = files.iter().rev().cloned().collect();
        assert!(merge(&backwards, false, &|_| ()).unwrap().merged == outcome.merged);

        // an average can be averaged with others, but not with itself
        let group = one.folder.path("group.exr");
        let outcome = merge(&files[..2], false, &|_| ()).unwrap();
        let Merged::Image(film) = outcome.merged else { panic!("not an image") };
        parts::write_image(&group, &outcome.identity, film.pixels).unwrap();
        let outcome = merge(&[files[2].clone(), group.clone()], false, &|_| ()).unwrap();
        assert_eq!(outcome.identity, identity);
        refused(&[files[1].clone(), group.clone()], &[&text(&files[1]), &text(&group), "samples of seed 4"]);
        refused(&[files[0].clone(), files[0].clone()], &["samples of seed 3"]);
        // parts are not averaged, even if they hold all
        let area = one.identity.settings.whole();
        refused(&[one.tile(area), two.tile(area)], &["not a part of the same image", "its seed is 4, not 3"]);

        for (job, says) in [
            (of(Settings { seed: 9, depth: 4, ..SETTINGS }), "its depth is 4, not 8"),
            (
                of(Settings { seed: 9, technique: Technique::Area, ..SETTINGS }),
                "its technique is \"area\", not \"auto\"",
            ),
            (Job::new("quads", Settings { seed: 9, sampler, height: 20, ..SETTINGS }), "its width is 50, not 32"),
            (Job::new("plates", Settings { seed: 9, ..SETTINGS }), "its scene is \"plates\", not \"quads\""),
        ] {
            let mut job = job;
            let alien = job.whole();
            refused(&[&files[..], std::slice::from_ref(&alien)].concat(), &[&text(&alien), &text(&files[0]), says]);
        }
    }
}

/// A message begins with the name of the file, and says more than a number of an error.
fn is_explained(error: &FileError, name: &str) -> bool {
    let text = error.to_string();
    let what = text.strip_prefix(&format!("{name}: ")).unwrap_or_default();
    what.len() > 10 && !what.contains("os error") && !what.contains("missing bytes")
}

/// A damaged part is an error that names it, or the part is as it was: never other values. So is a damaged header of an image.
#[test]
fn damaged_files_are_noticed() {
    let mut job = Job::new("quads", Settings { width: 32, height: 20, ..SETTINGS });
    let piece = job.piece([0, 0, 32, 20], Samples::All);
    let path = job.write(piece.clone());
    let name = text(&path);
    let bytes = std::fs::read(&path).unwrap();
    let read = |bytes: &[u8]| {
        let mut part = PieceFile::new(&path, std::io::Cursor::new(bytes.to_vec()), bytes.len() as u64)?;
        Ok::<_, FileError>((part.header.identity.clone(), part.read()?))
    };
    assert_eq!(read(&bytes).unwrap(), (job.identity.clone(), piece.clone()));
    for length in (0..bytes.len()).step_by(1 + bytes.len() / 200) {
        let error = read(&bytes[..length]).unwrap_err().to_string();
        assert!(error.starts_with(&name), "{error}");
    }
    // bits of the header, the fifth of which leads beyond what systems allow in places, and of all
    let mut random = Random::new(5);
    let header = |length: usize| (0..length).flat_map(|at| [(at, at % 8), (at, 4)]);
    let all = (0..1000).map(|_| (random.below(bytes.len()), random.below(8)));
    let mut noticed = [0; 2];
    for (is_all, (at, bit)) in header(1000).map(|flip| (0, flip)).chain(all.map(|flip| (1, flip))) {
        let mut damaged = bytes.clone();
        damaged[at] ^= 1 << bit;
        match read(&damaged) {
            Ok((identity, found)) => assert!(identity != job.identity || found == piece, "byte {at}"),
            Err(error) => {
                assert!(is_explained(&error, &name), "byte {at}, bit {bit}: {error}");
                noticed[is_all] += 1;
            }
        }
    }
    assert!(noticed[0] > 500 && noticed[1] > 900, "{noticed:?}");
    let whole = job.whole();
    let bytes = std::fs::read(&whole).unwrap();
    let refused = header(900).filter(|(at, bit)| {
        let mut damaged = bytes.clone();
        damaged[*at] ^= 1 << bit;
        let error = image::decode_exr(&damaged, &whole).err();
        error.is_some_and(|error| {
            assert!(is_explained(&error, &text(&whole)), "byte {at}, bit {bit}: {error}");
            true
        })
    });
    assert!(refused.count() > 450);
}

/// Every kind of piece is read as it was written, and its header says what it is.
#[test]
fn pieces_are_read_as_written() {
    let mut job = Job::new("quads", Settings { sampler: Sampler::Adaptive, spp: 64, ..SETTINGS });
    let pilot = job.piece(job.identity.settings.whole(), Samples::Pilot);
    let lights = if let PieceKind::Pilot(lights) = pilot.kind() { lights } else { 0 };
    let path = job.write(pilot.clone());
    assert_eq!(PieceFile::open(&path).unwrap().read().unwrap(), pilot);
    let Merged::Pilot(piece) = merge(&[path], false, &|_| ()).unwrap().merged else { panic!("a pilot") };
    let whole = job.write(piece.clone());
    let mut part = PieceFile::open(&whole).unwrap();
    assert_eq!(part.header.kind, PieceKind::Counts(lights));
    assert_eq!(part.read().unwrap(), piece);
    let rows = part.read_rows(&(16..20)).unwrap();
    assert_eq!(rows.area, [0, 16, 50, 32]);
    let (Content::Counts(some), Content::Counts(all)) = (&rows.content, &piece.content) else { panic!("counts") };
    assert_eq!(*some, all.crop([0, 16, 50, 32]));
    assert_eq!(some.packets.len(), count(rows.area));
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
