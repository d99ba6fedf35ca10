//! Renders what the page wishes, pass by pass, and keeps the files up to date.

use super::draft::{Draft, Way, coarse};
use super::state::{Facts, Picture, Shared, State, Wishes};
use super::watch::Watch;
use crate::image::ImageOptions;
use crate::interrupt::Interrupt;
use crate::output::Output;
use etendue_laboratory::options::say;
use etendue_render::camera::Orbit;
use etendue_render::drive::progressive::{Beside, Goal, Progress, Refined, Refinement};
use etendue_render::film::Pixel;
use etendue_render::film::claim::why_unknown;
use etendue_render::sampler::default_sampler;
use etendue_render::scene::area::{self, Area};
use etendue_render::scene::limits::MOST_SAMPLES;
use etendue_render::scene::{CameraSettings, Scene};
use etendue_render::{Identity, Sensor, Settings, World};
use rayon::ThreadPool;
use std::error::Error;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant, SystemTime};

/// Greatest number of pixels of an image that is viewed: a browser receives 28 bytes of each.
const MOST_PIXELS: u64 = 1 << 24;
/// Bytes of each pixel of an image that is kept: what is rendered, its weight, and what is shown.
const BYTES: u64 = 28 + 8 + 28;
/// Greatest size of all images that are kept, except that the last two are.
const MOST_KEPT: u64 = 1 << 30;
/// A pass takes a quarter of the time so far, within these bounds in seconds, unless its least number of samples takes longer.
const PASS: [f64; 2] = [0.1, 0.4];
/// Files are written no more often than that.
const SAVE: Duration = Duration::from_secs(1);
/// How long the camera must rest before the image is more than coarse, and at least four times as long as that took: the next turn need not
/// wait for a pass to begin.
const REST: Duration = Duration::from_millis(300);
/// Errors are noted at times that differ by this factor, so that a longer rendering has only a few more of them.
const APART: f64 = 1.1;

/// A scene that was read, and when that began.
pub(crate) struct Reading {
    pub(crate) scene: Scene,
    pub(crate) settings: Settings,
    began: SystemTime,
}

impl Reading {
    /// Reads the scene.
    pub(crate) fn new(image: &ImageOptions) -> Result<Self, Box<dyn Error>> {
        let began = SystemTime::now();
        let (scene, settings) = image.load()?;
        let pixels = u64::from(settings.width) * u64::from(settings.height);
        if pixels > MOST_PIXELS {
            let Settings { width, height, .. } = settings;
            let what = format!("--size: an image of at most {MOST_PIXELS} pixels can be viewed, not {width}x{height}");
            return Err(what.into());
        }
        Ok(Self { scene, settings, began })
    }
}

/// A scene that is being viewed.
struct Subject {
    world: World,
    settings: Settings,
    watch: Arc<Watch>,
    facts: Facts,
    identity: Identity,
    /// The camera of the scene, and the distance of what it looks at.
    camera: CameraSettings,
    depth: f64,
    orbit: Option<Orbit>,
    /// Seconds that a sample of the last coarse image took.
    pace: f64,
}

/// An image that is rendered, or was and is kept.
struct Kept {
    way: Way,
    refined: Refined,
    history: Vec<[f64; 2]>,
}

/// What renders.
pub(crate) struct Worker<'a> {
    pub(crate) image: &'a ImageOptions,
    pub(crate) goal: Goal,
    pub(crate) pool: &'a ThreadPool,
    /// The files that the image is kept in, if that is asked for.
    pub(crate) output: Option<Arc<Output>>,
    pub(crate) interrupt: &'a Interrupt,
}

/// What has been done with the image that is shown.
struct Done {
    /// The version that the files have.
    saved: u64,
    /// When they get the next one.
    save: Instant,
}

impl Worker<'_> {
    fn build(&self, Reading { mut scene, settings, began }: Reading) -> Result<Subject, Box<dyn Error>> {
        let watch = Arc::new(Watch::new(scene.inputs.iter().map(|input| &*input.path), began));
        let identity = Identity::new(&scene, settings, self.image.sensor);
        let world = self.image.world(&mut scene, self.pool)?;
        let camera = world.camera().clone();
        let depth = world.depth().unwrap_or_else(|| length(camera.origin)).max(f64::MIN_POSITIVE);
        let facts = Facts {
            scene: scene.name.clone(),
            size: [settings.width, settings.height],
            exposure: identity.exposure,
            sensor: self.image.sensor.name(),
            target: self.goal.error,
            files: self.output.as_ref().map(|output| output.both()),
            copy: self.copy().both(),
            camera: Some((camera.clone(), depth)),
        };
        Ok(Subject { world, settings, watch, facts, identity, camera, depth, orbit: None, pace: 0.0 })
    }

    /// The files of the next copy.
    fn copy(&self) -> Output {
        let mut stem = self.image.stem().to_owned();
        stem.push("-view");
        Output::free(&stem)
    }

    /// What is shared at the beginning.
    pub(crate) fn state(way: Way) -> State {
        let wishes = Wishes { way, crop: None, paused: false, reload: false, save: false, orbit: None };
        State { wishes, facts: Facts::default(), pictures: Vec::new(), watch: Arc::default(), message: None }
    }

    /// Renders until the program is interrupted.
    pub(crate) fn run(self, reading: Reading, shared: &Shared) -> Result<(), Box<dyn Error>> {
        let mut subject = self.build(reading)?;
        subject.share(&mut shared.lock());
        let mut kept: Vec<Kept> = Vec::new();
        let now = Instant::now();
        let mut done = Done { saved: 0, save: now };
        loop {
            let wishes = shared.wishes();
            if wishes.reload {
                self.reload(&mut subject, &mut kept, shared);
                continue;
            }
            // a copy of an image that is only begun waits for its first pass
            if wishes.save && (wishes.paused || shared.lock().picture(wishes.way).is_some()) {
                self.save_copy(wishes.way, &subject, shared);
                continue;
            }
            let (turns, began) = (wishes.orbit != subject.orbit, Instant::now());
            if turns {
                subject.turn(wishes.orbit);
                kept.clear();
                shared.forget();
            }
            if !shared.shows(wishes.way) && subject.world.check(&subject.by(wishes.way)).is_ok() {
                self.pool.install(|| subject.show_coarsely(wishes.way, self.image.sensor, shared));
            }
            if turns {
                shared.wait(&wishes, REST.max(4 * began.elapsed()));
                continue;
            }
            if let Err(what) = subject.choose(wishes.way, &mut kept, shared, self.goal) {
                let mut state = shared.lock();
                state.message = Some(format!("{}: {what}", wishes.way.sampler.name()));
                let Some(last) = kept.last() else { return Err(what.into()) };
                state.wishes.way = last.way;
                continue;
            }
            let Some(current) = kept.last_mut() else { unreachable!("one was chosen") };
            let end = current.refined.known().and_then(|known| self.end(known, wishes.crop));
            let is_idle = wishes.paused || end.is_some();
            if !is_idle {
                let passed = self.pool.install(|| current.pass(&subject, wishes.crop, self.goal, shared));
                let Some(known) = passed else {
                    // tiles of a pass that is thrown away
                    if current.refined.known().is_some() {
                        *shared.draft() = None;
                    }
                    continue;
                };
                let end = self.end(known, wishes.crop);
                let picture = current.picture(shared.version(), end);
                let mut state = shared.lock();
                state.pictures.retain(|picture| picture.way != wishes.way);
                state.pictures.extend(picture);
                drop(state);
                *shared.draft() = None;
            }
            self.keep(&mut done, wishes.way, &subject, shared, is_idle);
            if is_idle {
                shared.wait(&wishes, SAVE);
            }
        }
    }

    /// Reads the scene again, and forgets all images of the old one. If it is faulty, the page says why, and the old one stays.
    fn reload(&self, subject: &mut Subject, kept: &mut Vec<Kept>, shared: &Shared) {
        let read = Reading::new(self.image).and_then(|reading| {
            if let Some(output) = &self.output {
                Output::of(output.exr.clone(), &reading.scene.inputs)?;
            }
            self.build(reading)
        });
        let mut state = shared.lock();
        state.wishes.reload = false;
        match read {
            Ok(read) => {
                *subject = read;
                kept.clear();
                (state.wishes.crop, state.wishes.orbit) = (None, None);
                subject.share(&mut state);
                state.message = None;
                drop(state);
                shared.forget();
            }
            Err(error) => {
                say(format_args!("warning: the scene stays as it was: {error}"));
                state.message = Some(format!("The scene stays as it was: {error}"));
            }
        }
    }

    /// Writes a copy of the image that is shown, into files that did not exist.
    fn save_copy(&self, way: Way, subject: &Subject, shared: &Shared) {
        let picture = shared.lock().picture(way).cloned();
        let output = self.copy();
        let message = match picture {
            None => "There is no image yet, so nothing was written".to_owned(),
            Some(picture) => match output.write(&picture.film, &subject.identity_of(&picture)) {
                Ok(()) => format!("Wrote {}", output.both()),
                Err(error) => format!("Nothing was written: {error}"),
            },
        };
        let copy = self.copy().both();
        let mut state = shared.lock();
        state.wishes.save = false;
        (state.facts.copy, state.message) = (copy, Some(message));
    }

    /// Why an image receives no more samples; `None` if it does.
    fn end(&self, known: &Progress, crop: Option<Area>) -> Option<String> {
        let samples = known.film.pixels.iter().map(|pixel| pixel.samples).max()?;
        if samples >= MOST_SAMPLES {
            return Some(format!("a pixel has {samples} samples, and images can have no more than {MOST_SAMPLES}"));
        }
        // whoever chooses a part wants samples there
        if crop.is_some() {
            return None;
        }
        if let Some(seconds) = self.goal.seconds.filter(|&seconds| known.seconds >= seconds) {
            return Some(format!("{seconds} s are over"));
        }
        let target = self.goal.error?;
        match known.error {
            Some(claim) if claim.excess(target) <= 1.0 => Some("its error is what was asked for".to_owned()),
            Some(claim) => claim.check(target).err(),
            None => Some(format!("its error is not known, because {}", why_unknown(&known.film, true))),
        }
    }

    /// Writes the files if that is due. An interruption writes what they do not have yet.
    fn keep(&self, done: &mut Done, way: Way, subject: &Subject, shared: &Shared, is_idle: bool) {
        let Some(output) = &self.output else { return };
        let Some(picture) = shared.lock().picture(way).cloned() else { return };
        let identity = subject.identity_of(&picture);
        let Picture { film, error, version, .. } = picture;
        if done.saved != version && (is_idle || Instant::now() >= done.save) {
            let began = Instant::now();
            let written = output.save(self.interrupt, &film, &identity, error);
            // large files take no more than a tenth of the time
            (done.saved, done.save) = (version, began + SAVE + 10 * began.elapsed());
            if let Err(error) = written {
                say(format_args!("warning: {error}"));
                shared.lock().message = Some(error);
            }
        } else if done.saved != version {
            let output = Arc::clone(output);
            let last = move || output.write(&film, &identity).map(|()| output.holds(&identity, error));
            self.interrupt.lock().last = Some(Box::new(last));
        }
    }
}

impl Subject {
    /// Tells what is known of the scene.
    fn share(&self, state: &mut State) {
        (state.facts, state.watch) = (self.facts.clone(), Arc::clone(&self.watch));
    }

    /// What an image depends on; also the camera, if that has turned.
    fn identity_of(&self, picture: &Picture) -> Identity {
        let Way { technique, sampler } = picture.way;
        let settings = Settings { technique, sampler, spp: picture.spp.round() as u32, ..self.settings };
        let mut identity = Identity { settings, ..self.identity.clone() };
        if let Some(Orbit { around, over, distance }) = self.orbit {
            identity.digest.push_str(&format!(", turned by {around:?} and {over:?}, at {distance:?} of the distance"));
        }
        identity
    }

    /// The settings with this technique and sampler.
    const fn by(&self, way: Way) -> Settings {
        Settings { technique: way.technique, sampler: way.sampler, ..self.settings }
    }

    /// Shows a coarse image, which no wish interrupts.
    fn show_coarsely(&mut self, way: Way, sensor: Sensor, shared: &Shared) {
        let film = coarse(&self.world, &self.by(way), sensor, &mut self.pace);
        *shared.draft() = Some(Draft::new(way, film, self.facts.size, shared.version()));
    }

    /// Turns the camera.
    fn turn(&mut self, orbit: Option<Orbit>) {
        self.orbit = orbit;
        let turned = orbit.map(|orbit| self.camera.orbited(self.depth, orbit));
        self.world.set_camera(turned.unwrap_or_else(|| self.camera.clone()));
    }

    /// Makes the image that is sampled in this way the last of those that are kept. Old ones are forgotten if all take too much memory.
    fn choose(&self, way: Way, kept: &mut Vec<Kept>, shared: &Shared, goal: Goal) -> Result<(), String> {
        if kept.last().is_some_and(|last| last.way == way) {
            return Ok(());
        }
        if let Some(at) = kept.iter().position(|kept| kept.way == way) {
            let found = kept.remove(at);
            kept.push(found);
            return Ok(());
        }
        let settings = self.by(way);
        self.world.check(&settings)?;
        // the usual sampler has a preview of few samples
        let is_usual = default_sampler(MOST_SAMPLES, settings.sets) == way.sampler;
        let sampler = if is_usual { None } else { Some(way.sampler) };
        let plan = Refinement { settings, sampler, goal };
        let refined = Refined::new(&self.world, &plan)?;
        kept.push(Kept { way, refined, history: Vec::new() });
        for old in forgotten(kept, area::count(settings.whole()) as u64) {
            let [technique, sampler] = [old.way.technique.name(), old.way.sampler.name()];
            let mut state = shared.lock();
            state.pictures.retain(|picture| picture.way != old.way);
            state.message =
                Some(format!("{technique}, {sampler} was forgotten: all images would take too much memory"));
        }
        Ok(())
    }
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Takes the first of some images of so many pixels away, until the rest takes little enough memory or is only two.
fn forgotten<T>(kept: &mut Vec<T>, pixels: u64) -> Vec<T> {
    let most = (MOST_KEPT / (BYTES * pixels)).max(2);
    let excess = (kept.len() as u64).saturating_sub(most) as usize;
    kept.drain(..excess).collect()
}

impl Kept {
    /// Renders one more pass, unless it is stopped.
    fn pass(&mut self, subject: &Subject, crop: Option<Area>, goal: Goal, shared: &Shared) -> Option<&Progress> {
        let whole = subject.settings.whole();
        // passes of a part join one of the whole with the same sampler
        let has_begun = self.refined.known().is_some_and(|known| known.passes[0].sampler == self.way.sampler);
        let area = crop.filter(|_| has_begun).unwrap_or(whole);
        let seconds = self.refined.known().map_or(0.0, |known| known.seconds);
        let left = goal.seconds.filter(|_| crop.is_none()).map_or(f64::INFINITY, |all| all - seconds);
        let spp = self.refined.lasting((0.25 * seconds).clamp(PASS[0], PASS[1]).min(left), area);
        shared.done.store(0, Ordering::Relaxed);
        shared.of.store(area::count(area) as u64, Ordering::Relaxed);
        let progress = |pixels: u64| {
            shared.done.fetch_add(pixels, Ordering::Relaxed);
        };
        if let Some(known) = self.refined.known() {
            *shared.draft() = Some(Draft::new(self.way, known.film.clone(), subject.facts.size, shared.version()));
        }
        let tile = |tile: Area, pixels: &[Pixel]| {
            if let Some(draft) = &mut *shared.draft() {
                draft.paste(tile, pixels, || shared.version());
            }
        };
        let beside = Beside { stop: &shared.stop, progress: &progress, tile: Some(&tile) };
        let known = self.refined.pass(&subject.world, spp, area, beside)?;
        if let Some(claim) = known.error {
            let is_near = |[last, _]: &[f64; 2], before: &[f64; 2]| *last < APART * before[0];
            if let [.., before, last] = &self.history[..]
                && is_near(last, before)
            {
                self.history.pop();
            }
            self.history.push([known.seconds, claim.total()]);
        }
        Some(known)
    }

    /// What to show of it, once it has had a pass.
    fn picture(&self, version: u64, end: Option<String>) -> Option<Picture> {
        let Progress { film, error, seconds, .. } = self.refined.known()?;
        let samples: f64 = film.pixels.iter().map(|pixel| f64::from(pixel.samples)).sum();
        Some(Picture {
            way: self.way,
            chosen: self.refined.settings().technique,
            film: Arc::new(film.clone()),
            version,
            spp: samples / film.pixels.len() as f64,
            error: *error,
            seconds: *seconds,
            history: self.history.clone(),
            end,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn old_images_are_forgotten() {
        let of = |count: u32, pixels: u64| {
            let mut kept: Vec<u32> = (0..count).collect();
            let old = forgotten(&mut kept, pixels);
            assert!((0..count).eq(old.iter().chain(&kept).copied()), "{old:?}, {kept:?}");
            assert!(kept.len() <= 2 || kept.len() as u64 * pixels * BYTES <= MOST_KEPT);
            old.len()
        };
        // 64 bytes of a pixel: 16 images of 1024 × 1024
        assert_eq!([of(16, 1 << 20), of(17, 1 << 20), of(80, 1 << 20)], [0, 1, 64]);
        assert_eq!([of(80, 256 * 256), of(1, MOST_PIXELS), of(2, MOST_PIXELS), of(5, MOST_PIXELS)], [0, 0, 0, 3]);
    }
}
