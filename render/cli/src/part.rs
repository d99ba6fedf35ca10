//! The options that make `etendue render` render a part of an image, and how it does.

use crate::image::ImageOptions;
use crate::interrupt::Interrupt;
use crate::output::named;
use crate::progress::bar;
use clap::Args;
use etendue_laboratory::options::{out, pool, say};
use etendue_render::drive::Samples;
use etendue_render::drive::merge;
use etendue_render::drive::parts::{self, Piece, PieceFile, PieceKind};
use etendue_render::film::files;
use etendue_render::scene::Scene;
use etendue_render::scene::area;
use etendue_render::scene::area::Area;
use etendue_render::{Identity, Sampler, Settings, film::image};
use serde_json::json;
use std::error::Error;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

#[derive(Args)]
#[group(id = "parts", multiple = true)]
pub(crate) struct PartOptions {
    /// Render only the pixels from column X0 to X1-1 and from row Y0 to Y1-1, as a part of the image for `etendue merge`; all are multiples of 16, or the image's size
    #[arg(long, value_name = "X0,Y0,X1,Y1", value_parser = tile)]
    tile: Option<Tile>,
    /// Render only the first samples of the sampler adaptive, as a part of its pilot
    #[arg(long, conflicts_with = "after")]
    pilot: bool,
    /// Render the samples of the sampler adaptive that follow this merged pilot, as a part of the image
    #[arg(long, value_name = "PILOT.exr")]
    after: Option<PathBuf>,
}

/// The pixels [x0, y0, x1, y1).
#[derive(Clone, Copy)]
struct Tile(Area);

/// Parses `--tile`.
fn tile(text: &str) -> Result<Tile, String> {
    let sides: Option<Vec<u32>> = text.split(',').map(|side| side.parse().ok()).collect();
    let valid = sides.and_then(|sides| <Area>::try_from(sides).ok()).map(Tile);
    valid.ok_or_else(|| "must be four numbers, such as 0,0,64,64".to_owned())
}

/// The pixels and samples of a part.
pub(crate) struct PartContent {
    area: Area,
    what: What,
}

enum What {
    All,
    Pilot,
    After(PathBuf),
}

impl PartOptions {
    /// Whether a part is asked for.
    pub(crate) const fn is_asked(&self) -> bool {
        self.tile.is_some() || self.pilot || self.after.is_some()
    }
    /// The part that is asked for, if one is.
    pub(crate) fn content(&self, settings: &Settings) -> Result<Option<PartContent>, String> {
        if !self.is_asked() {
            return Ok(None);
        }
        let &Settings { width, height, sampler, .. } = settings;
        let area = self.tile.map_or(settings.whole(), |tile| tile.0);
        if !settings.is_of_tiles(area) {
            let [x0, y0, x1, y1] = area;
            return Err(format!(
                "--tile {x0},{y0},{x1},{y1}: the numbers must be multiples of {}, or the size of the image, {width}x{height}, and the first two less than the others",
                Settings::TILE
            ));
        }
        let is_adaptive = sampler == Sampler::Adaptive;
        if is_adaptive != (self.pilot || self.after.is_some()) {
            return Err(if is_adaptive {
                "the sampler adaptive takes its samples in two rounds, --pilot and --after PILOT.exr: \
                 `etendue plan` prints the commands; or choose another, such as --sampler sobol"
            } else {
                "--pilot and --after are only for --sampler adaptive"
            }
            .into());
        }
        let what = match (&self.after, self.pilot) {
            (Some(file), _) => What::After(file.clone()),
            (None, true) => What::Pilot,
            (None, false) => What::All,
        };
        Ok(Some(PartContent { area, what }))
    }
}

/// The name of the file of a part: what it holds.
pub(crate) fn file_name([x0, y0, x1, y1]: Area) -> String {
    format!("x{x0:04}-{x1:04}-y{y0:04}-{y1:04}.exr")
}

/// Why a file is not the part that is wanted; `None` if it is.
fn flaw(path: &Path, identity: &Identity, area: Area, what: &What) -> Option<String> {
    let mut part = match PieceFile::open(path) {
        Ok(part) => part,
        Err(error) => return Some(error.to_string()),
    };
    if let Some(difference) = identity.difference(&part.header.identity) {
        return Some(format!("{}: a part of another image: {difference}", path.display()));
    }
    let is_pilot = matches!(part.header.kind, PieceKind::Pilot(_));
    if part.header.area != area || is_pilot != matches!(what, What::Pilot) {
        return Some(format!("{}: holds other pixels or samples of the image", path.display()));
    }
    part.read().err().map(|error| error.to_string())
}

/// Whether a file is an image, which is not to be replaced by a part, unlike another part or one that is damaged.
fn is_image(path: &Path) -> bool {
    let is_part = PieceFile::open(path).is_ok_and(|part| part.header.identity.build.is_some());
    !is_part && image::read_exr(path).is_ok()
}

/// Renders the part and writes it, unless the file holds it already.
pub(crate) fn run(
    options: &ImageOptions,
    part: &PartContent,
    output: Option<&Path>,
    mut scene: Scene,
    settings: Settings,
    as_json: bool,
    interrupt: &Interrupt,
) -> Result<(), Box<dyn Error>> {
    let start = Instant::now();
    let identity = Identity::new(&scene, settings, options.sensor).of_parts();
    let PartContent { area, what } = part;
    let name = || named(options.stem(), &format!("-{}", file_name(*area)));
    let path = output.map_or_else(name, Path::to_owned);
    if !path.extension().is_some_and(|e| e.eq_ignore_ascii_case("exr")) {
        return Err(format!("--output {}: the name must end in .exr", path.display()).into());
    }
    if scene.inputs.iter().any(|input| files::is_same(&input.path, &path)) {
        return Err(format!("{}: the scene has been read from this file", path.display()).into());
    }
    if let What::After(pilot) = what
        && files::is_same(pilot, &path)
    {
        let what = "the pilot is read from this file, so the part cannot be written to it: choose another name with -o";
        return Err(format!("{}: {what}", path.display()).into());
    }
    let report = |rendered: bool| {
        let samples = match what {
            What::All => "all samples",
            What::Pilot => "the pilot",
            What::After(_) => "the samples after the pilot",
        };
        let seconds = start.elapsed().as_secs_f64();
        let mut out = out();
        if as_json {
            let object =
                json!({ "output": path.to_string_lossy(), "area": area, "rendered": rendered, "seconds": seconds });
            return writeln!(out, "{object}");
        }
        let did = if rendered { "wrote" } else { "kept" };
        let [x0, y0, x1, y1] = area;
        let pixels = format!("columns {x0} to {}, rows {y0} to {}", x1 - 1, y1 - 1);
        writeln!(out, "{did} {}: {samples} of {pixels}, {seconds:.3} s", path.display())
    };
    if path.exists() {
        match flaw(&path, &identity, *area, what) {
            None => return Ok(report(false)?),
            Some(_) if is_image(&path) => {
                let what = "this is an image, which a part must not replace: delete it, or choose another name with -o";
                return Err(format!("{}: {what}", path.display()).into());
            }
            Some(flaw) => say(format_args!("warning: {flaw}; it is rendered again")),
        }
    }
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        files::make_folder(folder)?;
    }
    files::check_replaceable(&path)?;
    let counts = if let What::After(file) = what { Some(merge::pixel_counts(file, &identity, *area)?) } else { None };

    let pool = pool(options.threads)?;
    let world = options.world(&mut scene, &pool)?;
    world.check(&settings)?;
    let bar = bar(area::count(*area) as u64, "{wide_bar} {percent:>3} %  {elapsed} of {duration}");
    interrupt.watch(&bar, &path);
    let progress = |done: u64| bar.inc(done);
    let samples = match (what, &counts) {
        (What::Pilot, _) => Samples::Pilot,
        (_, Some(counts)) => Samples::Rest(counts),
        _ => Samples::All,
    };
    let (content, _) = pool.install(|| world.view(&settings).render(*area, samples, &progress));
    bar.finish_and_clear();
    {
        let _status = interrupt.lock();
        parts::write(&path, &identity, Piece { area: *area, content })?;
    }
    Ok(report(true)?)
}
