//! An image depends on its scene and its settings alone: one hash per scene, technique and sampler of the bits of all pixels. The committed
//! table, `render/bits/images.txt`, is the reference.
//!
//! `cargo run --release -p etendue-image-bits` compares; `-- SCENE` compares the images of one scene, and `-- --write "WHY"` replaces the
//! table and adds a line to its changelog, `render/bits/CHANGELOG.md`.

use etendue_render::drive::progressive::{Beside, Goal, Refinement};
use etendue_render::film::Film;
use etendue_render::{Sampler, Settings, Technique, World, drive::progressive};
use std::fs;
use std::path::{Path, PathBuf};

/// The committed table.
pub const TABLE: &str = include_str!("../images.txt");
/// How to replace it.
pub const REPLACE: &str = "cargo run --release -p etendue-image-bits -- --write \"WHY\"";

/// The samplers of each technique, and their samples per pixel: packets with lanes that are left over, whole packets, and a pilot with
/// second sets.
const SAMPLERS: [(Sampler, u32); 3] = [(Sampler::Independent, 3), (Sampler::ZOrder, 8), (Sampler::Adaptive, 16)];
/// The techniques of which there is an image until an error is reached, as with `--error`.
const UNTIL_ERROR: [Technique; 2] = [Technique::Auto, Technique::MisPower];
/// That error, and the number of passes after which an image counts as it is: noisy ones would take minutes.
const ERROR: f64 = 0.02;
const PASSES: usize = 2;
/// Pixels across and down: nine tiles.
const SIDE: u32 = 48;
/// Scenes with lights that the built-in ones lack, in `render/gallery/emitters`.
const EMITTERS: [&str; 5] = ["panel", "television", "washers", "window", "windows"];

/// The hashes of the images of a scene by one technique.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ImageHashes {
    /// The scene and the technique, or the scene, the technique and `error`.
    pub name: String,
    /// A hash for each sampler, or for the image until an error is reached.
    pub hashes: Vec<u64>,
}

/// The names of all scenes.
#[must_use]
pub fn scenes() -> Vec<&'static str> {
    etendue_scene::builtin().iter().map(|(name, _)| *name).chain(EMITTERS).collect()
}

/// The hashes of all images of a scene.
#[must_use]
pub fn rows(scene: &str) -> Vec<ImageHashes> {
    let gallery = Path::new(env!("CARGO_MANIFEST_DIR")).join("../gallery/emitters");
    let file =
        if EMITTERS.contains(&scene) { gallery.join(scene).with_extension("pbrt") } else { PathBuf::from(scene) };
    let mut loaded = etendue_scene::load(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    let world = World::from_scene(&mut loaded).unwrap_or_else(|error| panic!("{scene}: {error}"));
    let all = Settings { width: SIDE, height: SIDE, seed: 73, ..Settings::DEFAULT };
    let mut rows = Vec::new();
    for technique in Technique::ALL {
        let image = |(sampler, spp)| world.render(&Settings { technique, sampler, spp, ..all }, &|_| ()).0;
        rows.push(ImageHashes {
            name: format!("{scene}/{}", technique.name()),
            hashes: SAMPLERS.map(|sampled| hash(&image(sampled))).to_vec(),
        });
    }
    for technique in UNTIL_ERROR {
        let goal = Goal { seconds: None, error: Some(ERROR) };
        let plan = Refinement { settings: Settings { technique, ..all }, sampler: None, goal };
        let (mut film, mut passes, enough) = (None, 0, "enough passes");
        let ended = progressive::render(
            &world,
            &plan,
            Beside::NOTHING,
            |_, _| (),
            |known| {
                (film, passes) = (Some(hash(&known.film)), passes + 1);
                if passes < PASSES { Ok(()) } else { Err(enough.into()) }
            },
        );
        let ended = ended.map(|_| ()).or_else(|error| if error == enough { Ok(()) } else { Err(error) });
        ended.unwrap_or_else(|error| panic!("{scene} by {}: {error}", technique.name()));
        rows.push(ImageHashes {
            name: format!("{scene}/{}/error", technique.name()),
            hashes: film.into_iter().collect(),
        });
    }
    rows
}

/// FNV-1a of 64 bits, word by word, of all that a film has.
#[must_use]
pub fn hash(film: &Film) -> u64 {
    let pixels = film.pixels.iter().flat_map(|pixel| {
        let radiance = pixel.mean.into_iter().chain(pixel.variance).map(f32::to_bits);
        radiance.chain([pixel.samples])
    });
    let words = [film.width, film.height].into_iter().chain(pixels);
    words.fold(0xcbf2_9ce4_8422_2325, |hash, word| (hash ^ u64::from(word)).wrapping_mul(0x0100_0000_01b3))
}

/// The lines of the table.
#[must_use]
pub fn text(rows: &[ImageHashes]) -> String {
    let line = |ImageHashes { name, hashes }: &ImageHashes| {
        let hashes: String = hashes.iter().map(|hash| format!(" {hash:016x}")).collect();
        format!("{name}{hashes}\n")
    };
    rows.iter().map(line).collect()
}

/// What differs from the lines of the table that belong to these scenes: a line for each image.
#[must_use]
pub fn differences(rows: &[ImageHashes], scenes: &[&str], table: &str) -> Vec<String> {
    let name = |line: &str| line.split(' ').next().unwrap_or_default().to_owned();
    let is_asked = |line: &&str| scenes.contains(&line.split('/').next().unwrap_or_default());
    let mut expected: Vec<&str> = table.lines().filter(is_asked).collect();
    let mut all = Vec::new();
    for row in rows {
        let Some(at) = expected.iter().position(|line| name(line) == row.name) else {
            all.push(format!("{}: not in the table", row.name));
            continue;
        };
        let (found, line) = (expected.swap_remove(at), text(std::slice::from_ref(row)));
        let (found, line) = (found.split(' ').skip(1), line.trim_end().split(' ').skip(1));
        if found.clone().count() != row.hashes.len() {
            all.push(format!("{}: another number of images than in the table", row.name));
        }
        for ((found, now), (sampler, _)) in found.zip(line).zip(SAMPLERS) {
            if found != now {
                let sampler = if row.hashes.len() == 1 { "its image" } else { sampler.name() };
                all.push(format!("{}: {sampler} differs from the table", row.name));
            }
        }
    }
    all.extend(expected.iter().map(|line| format!("{line}: no such image")));
    all
}

/// Replaces the table by all rows, and adds the reason to its changelog.
///
/// # Errors
/// Fails without a reason, and if a file cannot be written.
pub fn write(rows: &[ImageHashes], why: &str) -> Result<(), String> {
    let why = why.trim();
    if why.is_empty() || why.contains('\n') {
        return Err("--write needs a line for the changelog that says why images change".into());
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let changelog = folder.join("CHANGELOG.md");
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    let mut log = fs::read_to_string(&changelog).map_err(failed)?;
    let changed = differences(rows, &scenes(), TABLE).len();
    log.push_str(&format!("- {why} ({changed} of {} rows or images changed)\n", rows.len()));
    fs::write(changelog, log).map_err(failed)?;
    fs::write(folder.join("images.txt"), text(rows)).map_err(failed)
}
