//! `etendue render`: renders a scene with a given number of samples, or until its error or the time is what was asked for.

use crate::beside::{Beside as OtherImage, Cost, other_work};
use crate::command_line::line;
use crate::hints::{hint, taken, wasted, windows};
use crate::image::ImageOptions;
use crate::interrupt::Interrupt;
use crate::output::{Output, grouped, percent};
use crate::partial::Partial;
use crate::progress::bar;
use clap::Args;
use etendue_laboratory::cost::median;
use etendue_laboratory::options::{named, out, pool, say, whole};
use etendue_laboratory::processor_time::processor_seconds;
use etendue_render::drive::progressive::{self, Beside, Goal, Pass, Progress, Refinement};
use etendue_render::film::claim::{Claim, why_unknown};
use etendue_render::film::{Film, Pixel};
use etendue_render::sampler::{default_sampler, reports_variance};
use etendue_render::scene::area::Area;
use etendue_render::{Identity, RayCount, Sampler, Sensor, Settings, Technique, World};
use serde_json::{Value, json};
use std::error::Error;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

#[derive(Args)]
pub(crate) struct Options {
    #[command(flatten)]
    image: ImageOptions,
    /// Write the image to this EXR file, and a PNG beside it [default: the scene's film filename, or SCENE.exr]
    #[arg(short, long, value_name = "OUT.exr")]
    output: Option<PathBuf>,
    /// Refine the image until this many seconds have passed, those of the trial of `auto` included
    #[arg(long, value_name = "SECONDS", value_parser = seconds, conflicts_with_all = ["spp", "repeat"])]
    time: Option<f64>,
    /// Refine the image until its estimated error (relative RMS) is at most this, such as 0.01 or 1%
    #[arg(long, value_name = "TARGET", value_parser = fraction, conflicts_with_all = ["spp", "repeat"])]
    error: Option<f64>,
    /// Render the same image this many times, for timing
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = whole::<u32>(1..=1_000_000))]
    repeat: u32,
    /// Render the scene by this technique too, in the same time, and write a PNG whose left half is that image
    #[arg(long, value_name = "TECHNIQUE", value_parser = named::<Technique>(&Technique::NAMES), hide_possible_values = true, conflicts_with_all = ["repeat", "json"])]
    beside: Option<Technique>,
    /// Make the PNG brighter by this many stops, each a factor of 2; the EXR file has radiance [default: the film's iso and shutter]
    #[arg(long, value_name = "STOPS", default_value_t = 0.0, value_parser = stops, hide_default_value = true)]
    exposure: f64,
    /// Print the result as one JSON object
    #[arg(long)]
    json: bool,
}

/// Parses `--time`.
pub(crate) fn seconds(text: &str) -> Result<f64, String> {
    let valid = text.parse::<f64>().ok().filter(|s| s.is_finite() && *s > 0.0);
    valid.ok_or_else(|| "must be a number of seconds greater than 0, such as 10 or 0.5".to_owned())
}

/// Parses `--exposure`.
fn stops(text: &str) -> Result<f64, String> {
    let valid = text.parse::<f64>().ok().filter(|stops| stops.abs() <= 100.0);
    valid.ok_or_else(|| "must be a number of stops from -100 to 100, such as -3 or 0.5".to_owned())
}

/// The greatest fraction that `--error` takes without a percent sign: more is likely meant as a percentage.
const MOST_BARE: f64 = 0.2;

/// Parses `--error`: a fraction or a percentage.
pub(crate) fn fraction(text: &str) -> Result<f64, String> {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    let value = text.strip_suffix('%').map_or_else(|| number(text), |percent| number(percent).map(|x| x / 100.0));
    // f32 holds the mean of a pixel to 6e-8 of itself
    let valid = value.filter(|x| (1e-6..=1.0).contains(x));
    let value = valid.ok_or_else(|| "must be from 1e-6 to 1, or a percentage, such as 0.01 or 1%".to_owned())?;
    if value > MOST_BARE && !text.ends_with('%') {
        // without the rounding of the product
        let whole = (1e6 * value).round() / 1e4;
        return Err(format!("is {whole} % of the mean: write {text}% or {whole}%"));
    }
    Ok(value)
}

/// A finished image and what it took.
struct Image {
    film: Film,
    /// Its estimated error, if that is known.
    error: Option<Claim>,
    rays: RayCount,
    /// Samples per pixel.
    spp: u64,
    /// The sampler of most samples.
    sampler: Sampler,
    /// Sets per pixel of each pass.
    sets: u32,
    /// Whether there are several, so that there is a variance.
    has_sets: bool,
    /// Seconds of each repetition; with a goal, those of the trial of `auto`, too.
    seconds: Vec<f64>,
    /// Empty unless there was a goal.
    passes: Vec<Pass>,
    /// What `auto` has taken, if a trial told.
    taken: Option<String>,
}

/// Renders, writes and reports.
pub(crate) fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let interrupt = Interrupt::new()?;
    let start = Instant::now();
    let image = &options.image;
    // what is wrong with it should not be found after a scene was read
    if let Some(path) = &options.output {
        Output::of(path.clone(), &[])?;
    }
    let (mut scene, settings) = image.load()?;
    let load = start.elapsed().as_secs_f64();
    let goal = Goal { seconds: options.time, error: options.error };
    let plan = (goal != Goal::default()).then_some(Refinement { settings, sampler: image.sampler, goal });
    match &plan {
        None => image.check(&settings)?,
        Some(plan) => plan.check().map_err(|what| format!("--{}: {what}", goal.option()))?,
    }
    let mut output = Output::new(options.output.as_deref(), &scene, Path::new(&image.scene))?;
    output.brightness = scene.film.exposure * options.exposure.exp2();
    let output = Arc::new(output);
    let has_sky = scene.environment.is_some();
    let only_pictures = !has_sky
        && scene.delta_lights.is_empty()
        && scene.shapes.iter().filter_map(|shape| shape.emission).all(|emission| emission.picture.is_some());
    let has_goal = plan.is_some();
    let has_portals = scene.environment.as_ref().is_none_or(|sky| !sky.portals.is_empty());
    let beside = options.beside.map(|technique| OtherImage::new(technique, &output, &scene.inputs)).transpose()?;
    let identity = Identity::new(&scene, settings, image.sensor);
    let exposure = identity.exposure;

    let pool = pool(image.threads)?;
    let start = Instant::now();
    let world = image.world(&mut scene, &pool)?;
    world.check(&settings)?;
    if let Some(beside) = &beside {
        world.check(&Settings { technique: beside.technique, ..settings })?;
    }
    let build = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let asked = settings;
    let (settings, trial) = pool.install(|| {
        let view = world.view(&plan.as_ref().map_or(asked, Refinement::of_trial));
        (Settings { spp: asked.spp, ..*view.settings() }, view.trial().copied())
    });
    let spent = start.elapsed().as_secs_f64();
    let trial = trial.map(|trial| (trial, spent));
    let plan = plan.map(|plan| Refinement { settings, goal: plan.goal.after(spent), ..plan });

    let studio = Session { world: &world, identity, settings, output: &output, interrupt: &interrupt };
    let technique = beside.as_ref().map(|beside| beside.technique);
    let (start, processor) = (Instant::now(), processor_seconds());
    let (mut done, other) = pool.install(move || -> Result<_, String> {
        let done = match &plan {
            None => studio.once(options.repeat),
            Some(plan) => studio.refine(plan),
        }?;
        let seconds = median(&done.seconds);
        let other = technique.map(|technique| studio.other(Settings { technique, ..asked }, image.sampler, seconds));
        Ok((done, other.transpose()?))
    })?;

    let processor = processor_seconds().zip(processor).map(|(after, before)| after - before);
    let note = processor.and_then(|p| other_work(start.elapsed().as_secs_f64(), pool.current_num_threads(), p));
    if has_goal {
        done.seconds.iter_mut().for_each(|seconds| *seconds += spent);
    }
    let chosen = settings.technique;
    let times = [load, build, trial.map_or(0.0, |(_, seconds)| seconds)];
    let said = if options.json {
        let object = to_json(options, &asked, chosen, &done, &output, times, pool.current_num_threads());
        writeln!(out(), "{object}")
    } else {
        done.taken = trial.as_ref().map(|trial| taken(&settings, trial));
        print(options, &title(asked.technique, chosen), &scene.name, &done, &output, times)
    };
    said.map_err(|error| output.were_written(&error))?;
    if let (Some(beside), Some((film, left))) = (beside, other) {
        show_beside(&beside, (&film, left), &done, title(asked.technique, chosen), exposure)?;
        if let Some(note) = note {
            writeln!(out(), "note: {note}")?;
        }
    }
    // glTF has no portals
    let name = image.scene.to_string_lossy().to_ascii_lowercase();
    let has_none = has_portals || name.ends_with(".gltf") || name.ends_with(".glb");
    let windows = || if has_none { None } else { windows(&world) };
    let wasted = || if has_goal { None } else { wasted(&settings, image.sampler.is_some()) };
    if let Some(hint) = hint(&done.film, output.brightness, has_sky, only_pictures).or_else(windows).or_else(wasted) {
        say(format_args!("hint: {hint}"));
    }
    if !options.json {
        next_steps(options, &done, chosen)?;
    }
    Ok(())
}

/// Writes the picture of the image and another, and says what each took.
fn show_beside(
    beside: &OtherImage,
    (film, left): (&Film, Cost),
    done: &Image,
    technique: String,
    exposure: f64,
) -> Result<(), Box<dyn Error>> {
    let wrote = beside.write(film, &done.film, exposure)?;
    let (seconds, shadow_rays) = (median(&done.seconds), done.rays.shadow);
    let right = Cost { technique, seconds, spp: done.spp, shadow_rays, error: done.error };
    writeln!(out(), "{wrote}: the same scene in about the same time\n  left   {left}\n  right  {right}")?;
    Ok(())
}

/// Everything that an image is made with.
struct Session<'a> {
    world: &'a World,
    /// What was asked for.
    identity: Identity,
    /// The same, by what `auto` takes.
    settings: Settings,
    output: &'a Arc<Output>,
    interrupt: &'a Interrupt,
}

impl Session<'_> {
    /// Renders the same image `repeat` times and writes it.
    fn once(&self, repeat: u32) -> Result<Image, String> {
        let Settings { width, height, spp, sampler, sets, .. } = self.settings;
        let pixels = u64::from(width) * u64::from(height);
        let bar = bar(pixels * u64::from(repeat), "{wide_bar} {percent:>3} %  {elapsed} of {duration}");
        let stop = self.interrupt.stop(&bar, &self.output.exr);
        let mut seconds = Vec::new();
        let (film, rays) = loop {
            let start = Instant::now();
            let view = self.world.view(&self.settings).stopped_by(&stop.flag);
            let image = view.image(&|done| bar.inc(done));
            seconds.push(start.elapsed().as_secs_f64());
            if stop.is_set() {
                self.interrupt.end(&stop, &self.output.save_part(&image.0, &self.identity)?);
            }
            if seconds.len() as u32 == repeat {
                break image;
            }
        };
        bar.finish_and_clear();
        let error = Claim::new(&film, &self.world.view(&self.settings).foreseen(), spp.into());
        self.output.save(self.interrupt, &film, &self.identity, error)?;
        let has_sets = reports_variance(sampler, spp, sets);
        let sets = sampler.sets(spp, sets);
        Ok(Image {
            film,
            error,
            rays,
            spp: spp.into(),
            sampler,
            sets,
            has_sets,
            seconds,
            passes: Vec::new(),
            taken: None,
        })
    }

    /// Renders passes and writes the image after each.
    fn refine(&self, plan: &Refinement) -> Result<Image, String> {
        let pixels = u64::from(plan.settings.width) * u64::from(plan.settings.height);
        let (length, template) = match plan.goal.seconds {
            Some(seconds) => {
                ((seconds * 1000.0) as u64, format!("{{wide_bar}} {{elapsed}} of {seconds:.2} s  {{msg}}"))
            }
            None => (pixels, "{wide_bar} {percent:>3} % of a pass, {elapsed}  {msg}".to_owned()),
        };
        let bar = bar(length, &template);
        self.interrupt.watch(&bar, &self.output.exr);
        let began = Instant::now();
        let advance = |done: u64| match plan.goal.seconds {
            Some(_) => bar.set_position(began.elapsed().as_millis() as u64),
            None => bar.inc(done),
        };
        let partial = Partial::new(&self.identity.settings);
        let tile = |tile: Area, pixels: &[Pixel]| partial.paste(tile, pixels);
        let beside = Beside { stop: &AtomicBool::new(false), progress: &advance, tile: Some(&tile) };
        let aim = plan.goal.error.map_or_else(String::new, |target| format!(", {} wanted", percent(target)));
        let mut noted = began;
        let start = |known: Option<&Progress>, spp: u32| {
            let error =
                known.and_then(|p| p.error).map_or_else(|| "not known yet".to_owned(), |claim| percent(claim.total()));
            bar.set_message(format!("error {error}{aim}; next {spp} spp"));
            // a file or a pipe has no bar, and whoever waits there for minutes wants to know
            if bar.is_hidden() && noted.elapsed() >= NOTED {
                noted = Instant::now();
                say(format_args!("after {:.0} s: error {error}{aim}; next {spp} spp", began.elapsed().as_secs_f64()));
            }
            if plan.goal.seconds.is_none() {
                bar.set_position(0);
            }
            partial.keep(self.interrupt, self.output, &self.identity);
        };
        let finish = |known: &Progress| {
            let (spp, sampler) = (u32::try_from(known.spp).unwrap_or(u32::MAX), known.passes[0].sampler);
            let settings = Settings { spp, sampler, ..self.identity.settings };
            let identity = Identity { settings, ..self.identity.clone() };
            self.output.save(self.interrupt, &known.film, &identity, known.error)
        };
        let done = progressive::render(self.world, plan, beside, start, finish);
        bar.finish_and_clear();
        let Progress { film, error, spp, passes, seconds, rays } = done?;
        let largest = passes.iter().max_by_key(|p| p.spp).unwrap_or_else(|| unreachable!("there is a first pass"));
        let (sampler, sets) = (largest.sampler, largest.sampler.sets(largest.spp, plan.settings.sets));
        let has_sets = passes.iter().all(|p| reports_variance(p.sampler, p.spp, plan.settings.sets));
        Ok(Image { film, error, rays, spp, sampler, sets, has_sets, seconds: vec![seconds], passes, taken: None })
    }

    /// Renders the scene with other settings, and as many samples as take about so many seconds, and writes nothing. A smaller image before it
    /// tells what a sample takes: in passes, the samples would be worth less than those of an image that is rendered at once.
    fn other(&self, settings: Settings, sampler: Option<Sampler>, seconds: f64) -> Result<(Film, Cost), String> {
        let asked = settings.technique;
        let settings = *self.world.view(&settings).settings();
        let counts = Refinement { settings, sampler, goal: Goal::default() }.counts()?;
        let at_most = |n: f64| progressive::at_most(&counts, n).unwrap_or(counts[0]);
        let bar = bar((seconds * 1000.0) as u64, "{wide_bar} {elapsed} by the other technique");
        let render = |spp: u32| {
            let began = Instant::now();
            let sampler = sampler.unwrap_or_else(|| default_sampler(spp, settings.sets));
            let view = self.world.view(&Settings { spp, sampler, ..settings });
            let (film, rays) = view.image(&|_| bar.set_position(began.elapsed().as_millis() as u64));
            let error = Claim::new(&film, &view.foreseen(), spp.into());
            (film, rays, error, began.elapsed().as_secs_f64())
        };
        let few = at_most(16.0);
        let (.., taken) = render(few);
        let spp = at_most(f64::from(few) * seconds / taken);
        let (film, rays, error, seconds) = render(spp);
        bar.finish_and_clear();
        let technique = title(asked, settings.technique);
        Ok((film, Cost { technique, seconds, spp: spp.into(), shadow_rays: rays.shadow, error }))
    }
}

/// How often passes are noted where no bar shows them, at most.
const NOTED: Duration = Duration::from_secs(60);

fn to_json(
    options: &Options,
    settings: &Settings,
    chosen: Technique,
    image: &Image,
    output: &Output,
    time: [f64; 3],
    threads: usize,
) -> Value {
    let rays = image.rays;
    let passes = image.passes.iter();
    let passes: Vec<Value> = passes
        .map(|p| json!({ "spp": p.spp, "sampler": p.sampler.name(), "seed": p.seed, "seconds": p.seconds }))
        .collect();
    json!({
        "scene": options.image.scene.to_string_lossy(),
        "width": settings.width,
        "height": settings.height,
        "spp": image.spp,
        "sets": image.sets,
        "technique": settings.technique.name(),
        "chosen": chosen.name(),
        "choice": settings.choice.name(),
        "sampler": image.sampler.name(),
        "sensor": options.image.sensor.name(),
        "seed": settings.seed,
        "threads": threads,
        "seconds": { "load": time[0], "build": time[1], "trial": time[2], "render": image.seconds },
        "rays": { "camera": rays.camera, "mirror": rays.mirror, "shadow": rays.shadow, "corner": rays.corner },
        "mean": image.film.mean(),
        "error": image.error.map(|claim| claim.total()),
        "systematic": image.error.map(|claim| claim.systematic),
        "uncertain": image.error.and_then(|claim| claim.uncertain()),
        "pixels": image.error.map(|claim| claim.pixels),
        "missed": image.error.map(|claim| claim.specks.ceil()),
        "passes": if passes.is_empty() { Value::Null } else { passes.into() },
        "output": output.exr.to_string_lossy(),
    })
}

/// The name of a technique, with that of the one that `auto` stands for.
fn title(technique: Technique, chosen: Technique) -> String {
    let (name, other) = (technique.name(), chosen.name());
    if name == other { name.to_owned() } else { format!("{name} ({other})") }
}

/// Prints what the number of shadow rays means, and the commands that a reader may want to try next.
fn next_steps(options: &Options, done: &Image, chosen: Technique) -> io::Result<()> {
    let mut out = out();
    let RayCount { camera, shadow, .. } = done.rays;
    if chosen == Technique::Analytic && shadow < camera / 2 {
        let [shadow, camera] = [shadow, camera].map(grouped);
        writeln!(
            out,
            "{shadow} shadow rays sufficed, where sampling one light for each camera ray takes up to {camera}: the rest was proved"
        )?;
    }
    let scene = &options.image.scene;
    let program = std::env::args_os().next().unwrap_or_else(|| "etendue".into());
    let other = if chosen == Technique::Area { Technique::Auto } else { Technique::Area }.name();
    let compare = line(&[&program, &"render", scene, &"--beside", &other]);
    let compare = options.beside.is_none().then_some(("compare", compare));
    let measure = ("measure", line(&[&program, &"chart", scene, &"--quick"]));
    for (what, command) in compare.into_iter().chain([measure, ("watch", line(&[&program, &"view", scene]))]) {
        write!(out, "{:9}", format!("{what}:"))?;
        out.write_all(&command)?;
        writeln!(out)?;
    }
    Ok(())
}

/// Numbers of rays and how many were traced in a second; those of mirrors only if there are any.
fn rays(count: &RayCount, seconds: f64) -> String {
    let RayCount { camera, look, mirror, shadow, .. } = *count;
    let kinds = [("camera", camera + look), ("mirror", mirror), ("shadow", shadow)].into_iter();
    let kinds = kinds.filter(|&(kind, number)| kind != "mirror" || number > 0);
    let texts = kinds.map(|(kind, number)| {
        format!("{} {kind} rays ({:.3} million/s)", grouped(number), number as f64 / seconds / 1e6)
    });
    texts.collect::<Vec<_>>().join(", ")
}

fn print(
    options: &Options,
    technique: &str,
    scene: &str,
    image: &Image,
    output: &Output,
    [load, build, _]: [f64; 3],
) -> io::Result<()> {
    let mut out = out();
    let Film { width, height, .. } = image.film;
    let sampler = image.sampler.name();
    writeln!(out, "{scene}: {width}x{height}, {} samples per pixel, {technique}, {sampler}", image.spp)?;
    if let Some(taken) = &image.taken {
        writeln!(out, "{taken}")?;
    }
    if !image.passes.is_empty() {
        let spp: Vec<String> = image.passes.iter().map(|p| p.spp.to_string()).collect();
        let less = if spp.len() > 1 { ": their mean has a greater error than as many samples at once" } else { "" };
        writeln!(out, "passes of {} samples per pixel{less}", spp.join(", "))?;
    }
    let render = median(&image.seconds);
    writeln!(out, "load {load:.3} s, build {build:.3} s, render {render:.3} s")?;
    writeln!(out, "{}", rays(&image.rays, render))?;
    let [r, g, b] = image.film.mean();
    match options.image.sensor {
        Sensor::Radiance => writeln!(out, "mean radiance {r:.6} {g:.6} {b:.6}")?,
        Sensor::Irradiance | Sensor::Power => {
            writeln!(out, "mean {} {r:.6e} {g:.6e} {b:.6e}", options.image.sensor.name())?;
        }
    }
    match image.error {
        Some(claim) => {
            write!(out, "estimated error {} (relative RMS)", percent(claim.total()))?;
            if claim.systematic > 0.0 {
                write!(out, ", including at most {} from approximations", percent(claim.systematic))?;
            }
            if let Some(uncertain) = claim.uncertain() {
                write!(out, "; it is uncertain, since {uncertain}")?;
            }
            writeln!(out)?;
        }
        None => writeln!(out, "estimated error not known, because {}", why_unknown(&image.film, image.has_sets))?,
    }
    if let Some(target) = options.error.filter(|target| image.error.is_none_or(|claim| claim.total() > *target)) {
        let never = image.error.is_some_and(|claim| claim.check(target).is_err());
        let what = match options.time {
            _ if never => "no time suffices".to_owned(),
            Some(_) => "the time did not suffice".to_owned(),
            None => {
                let all: u64 = image.passes.iter().map(|pass| u64::from(pass.spp)).sum();
                format!("{all} samples per pixel did not suffice")
            }
        };
        writeln!(out, "{what} for an error of {}", percent(target))?;
    }
    writeln!(out, "wrote {}", output.both())
}
