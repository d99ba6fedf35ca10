//! Renders an image pass by pass until its error or the time is what was asked for.
//!
//! Each pass is a whole image with a seed of its own. A pass of n samples has a squared error of about n^−p, with p = 1.5 for nets
//! and p = 1 for independent samples, so passes are averaged with weights n^p. Small passes often have a much larger error than that, so
//! a pass of nets that has eight times the weight of all before it takes their place. The weights depend on the numbers of samples alone,
//! never on the samples. The number of samples of a pass, and the decision to stop, depend on the time, or on the error of the whole
//! image so far; to that a pixel contributes no more than its share in the sum over all pixels. `schedule` decides both.

mod schedule;

use super::view::{Begun, Listener};
use super::world::World;
use crate::bvh::RayCount;
use crate::film::claim::{Claim, Foreseen, why_unknown};
use crate::film::{Film, Pixel};
use crate::sampler::{Sampler, default_sampler, hash64, reports_variance};
use crate::scene::area::{self, Area};
use crate::scene::limits::MOST_SAMPLES;
use crate::settings::Settings;
pub use schedule::{Goal, Pass, Progress, at_most};
use schedule::{Schedule, Timing, is_left_out};
use std::cell::Cell;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// What to render until when.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refinement {
    /// The settings of the first pass, except for `spp` and `sampler`, which are chosen for each pass.
    pub settings: Settings,
    /// The sampler of all passes; `None` for [`default_sampler`] of each pass.
    pub sampler: Option<Sampler>,
    /// When the image is finished.
    pub goal: Goal,
}

impl Goal {
    /// The names of the options that give the goal, for messages.
    #[must_use]
    pub const fn option(&self) -> &'static str {
        if self.error.is_some() { "error" } else { "time" }
    }
    /// What is left of it when so many seconds were spent before the first pass, as on a trial.
    #[must_use]
    pub fn after(self, spent: f64) -> Self {
        Self { seconds: self.seconds.map(|seconds| (seconds - spent).max(0.0)), ..self }
    }
}

impl Refinement {
    fn sampler_of(&self, spp: u32) -> Sampler {
        self.sampler.unwrap_or_else(|| default_sampler(spp, self.settings.sets))
    }
    /// Checks that the goal can be judged.
    ///
    /// # Errors
    /// Fails if the goal is an error, but no number of samples has a variance.
    pub fn check(&self) -> Result<(), String> {
        self.counts().map(|_| ())
    }
    /// The numbers of samples that a pass may have, in increasing order: powers of two, and of [`Sampler::Adaptive`], whose pixels differ in
    /// their numbers anyway, eighths between them.
    ///
    /// # Errors
    /// Fails if the goal is an error, but no number of samples has a variance.
    pub fn counts(&self) -> Result<Vec<u32>, String> {
        let sets = self.settings.sets;
        let from = |power: u32| std::iter::once(power).chain((9..16).map(move |eighths| power / 8 * eighths));
        let all = (0..=MOST_SAMPLES.ilog2()).flat_map(|bits| from(1 << bits));
        let all = all.filter(|n| (1..=MOST_SAMPLES).contains(n));
        let is_fit = |n: u32| n.is_power_of_two() || self.sampler_of(n) == Sampler::Adaptive;
        let is_valid = |&n: &u32| is_fit(n) && self.sampler_of(n).check(n, sets).is_ok();
        let has_variance = |&n: &u32| reports_variance(self.sampler_of(n), n, sets);
        let valid: Vec<u32> = all.filter(is_valid).collect();
        let judging: Vec<u32> = valid.iter().copied().filter(has_variance).collect();
        if !judging.is_empty() {
            return Ok(judging);
        }
        if self.goal.error.is_some() || valid.is_empty() {
            return Err(format!("with --sets {sets}, a pixel has no variance, so the error is not known"));
        }
        Ok(valid)
    }
    /// The settings of the trial before the first pass: with as many samples as the time has room for at a million a second, if these are more.
    #[must_use]
    pub fn of_trial(&self) -> Settings {
        let Settings { width, height, spp, .. } = self.settings;
        let room = 1e6 * self.goal.seconds.unwrap_or(0.0) / (f64::from(width) * f64::from(height));
        let most = self.counts().ok().and_then(|counts| at_most(&counts, room));
        Settings { spp: most.map_or(spp, |most| most.max(spp)), ..self.settings }
    }
    /// The exponent of the number of samples in the squared error, and so in the weight of a pass.
    const fn power(&self) -> f64 {
        match self.sampler {
            Some(Sampler::Independent) => 1.0,
            _ => 1.5,
        }
    }
}

/// Receives an area, and its pixels row by row.
pub type TileListener<'a> = &'a (dyn Fn(Area, &[Pixel]) + Sync);

/// What goes on beside a pass.
#[derive(Clone, Copy)]
pub struct Beside<'a> {
    /// As soon as it is true, the pass ends and is thrown away.
    pub stop: &'a AtomicBool,
    /// Receives the number of newly finished pixels.
    pub progress: &'a (dyn Fn(u64) + Sync),
    /// Receives the pixels of each tile as the image would have them if the pass ended there.
    pub tile: Option<TileListener<'a>>,
}

impl Beside<'_> {
    /// Nothing: no pass ends early.
    pub const NOTHING: Self = Self { stop: &NEVER, progress: &|_| (), tile: None };
}
static NEVER: AtomicBool = AtomicBool::new(false);

/// An image that is refined pass by pass, each of the whole or of a part.
///
/// Passes that are too small for the sampler of larger ones are a preview: they are no part of the image as soon as there is a larger one,
/// since their error is too large for their weight; nor are passes of nets as soon as one has eight times their weight.
#[derive(Clone, Debug)]
pub struct Refined {
    plan: Refinement,
    schedule: Schedule,
    /// See [`View::foreseen`](crate::View::foreseen).
    foreseen: Foreseen,
    /// The sum of the weights of all passes: of all pixels, or of each as soon as one pass was of a part.
    weights: Vec<f64>,
    /// Number of passes so far, also of those that are no part of the image.
    index: u64,
    /// Seconds that a sample of the last pass took.
    pace: f64,
    known: Option<Progress>,
}

impl Refined {
    /// An image without samples.
    ///
    /// # Errors
    /// Fails if no number of samples has a variance, but the goal is an error.
    pub fn new(world: &World, plan: &Refinement) -> Result<Self, String> {
        let counts = plan.counts()?;
        // smaller passes have another sampler
        let full =
            counts.iter().copied().find(|&n| plan.sampler_of(n) == plan.sampler_of(MOST_SAMPLES)).unwrap_or(counts[0]);
        let view = world.view(&plan.settings);
        let (foreseen, plan) = (view.foreseen(), Refinement { settings: *view.settings(), ..*plan });
        let schedule = Schedule { goal: plan.goal, power: plan.power(), counts, full, timing: None };
        Ok(Self { plan, schedule, foreseen, weights: Vec::new(), index: 0, pace: 0.0, known: None })
    }

    /// The settings of the passes but for `spp` and `sampler`, by what `auto` takes.
    #[must_use]
    pub const fn settings(&self) -> &Settings {
        &self.plan.settings
    }

    /// What is known after the last pass.
    #[must_use]
    pub const fn known(&self) -> Option<&Progress> {
        self.known.as_ref()
    }

    /// The number of samples of a pass of an area that takes about as many seconds, from the speed of the last one, but not fewer than the
    /// sampler of large passes allows; the least number before the first pass, even if that then is a preview.
    #[must_use]
    pub fn lasting(&self, seconds: f64, area: Area) -> u32 {
        let last = self.known.as_ref().and_then(|known| known.passes.last());
        let Schedule { counts, full, .. } = &self.schedule;
        let Some(last) = last else { return counts[0] };
        let most = self.schedule.most_after(last.spp).min(seconds / (self.pace * area::count(area) as f64));
        at_most(self.schedule.following(last.spp), most.max(f64::from(*full))).unwrap_or(counts[0])
    }

    /// Renders one more pass, of `spp` samples for each pixel of an area that consists of [tiles](Settings::is_of_tiles), and returns what
    /// is known after it; nothing if it is stopped.
    ///
    /// # Panics
    /// Panics if the first pass is not of the whole image, or the first with the sampler of large ones.
    pub fn pass(&mut self, world: &World, spp: u32, area: Area, beside: Beside<'_>) -> Option<&Progress> {
        self.pass_up_to(world, spp, area, beside, None)
    }

    /// The same, but `grown` decides how many samples there are while it is rendered; it also receives the seconds until its pilot had ended,
    /// and those until now.
    fn pass_up_to(
        &mut self,
        world: &World,
        spp: u32,
        area: Area,
        beside: Beside<'_>,
        grown: Option<&dyn Fn(Begun, [f64; 2]) -> u32>,
    ) -> Option<&Progress> {
        let (settings, began) = (self.plan.settings, Instant::now());
        let (sampler, seed) = (self.plan.sampler_of(spp), seed(settings.seed, self.index));
        let of_pass = Settings { spp, sampler, seed, ..settings };
        let Beside { stop, progress, tile } = beside;
        let (before, is_whole) = (&*self, area == settings.whole());
        let listener = tile.map(|tile| {
            move |area: Area, pixels: &[Pixel], spp: u32| {
                let pass = Pass { spp, sampler, seed, seconds: 0.0 };
                tile(area, &before.joined(pixels, area, &pass, is_whole));
            }
        });
        let view = world.view(&of_pass).stopped_by(stop);
        let view = listener.as_ref().map_or(view, |listener| view.told_to(listener as Listener<'_>));
        let pilot = Cell::new((0, 0.0));
        let decide = |begun: Begun| {
            let now = began.elapsed().as_secs_f64();
            if begun.spp == 0 {
                pilot.set((begun.pilot, now));
            }
            grown.map_or(spp, |grown| grown(begun, [pilot.get().1, now]))
        };
        let decide = grown.is_some().then_some(&decide as &dyn Fn(Begun) -> u32);
        let (pixels, rays, spp) = view.render_up_to(area, progress, decide);
        if stop.load(Ordering::Relaxed) {
            return None;
        }
        self.index += 1;
        let seconds = began.elapsed().as_secs_f64();
        self.pace = seconds / (f64::from(spp) * area::count(area) as f64);
        if spp >= self.schedule.full && is_whole {
            self.schedule.timing = Some(Timing::new(spp, seconds, pilot.get()));
        }
        let pass = Pass { spp, sampler, seed, seconds };
        let (own, whole) = (f64::from(spp).powf(self.plan.power()), settings.whole());
        let joins = self.joins(&pass, is_whole);
        let mean = match self.known.take() {
            Some(mut mean) if joins => {
                if !is_whole && self.weights.len() == 1 {
                    self.weights = vec![self.weights[0]; area::count(whole)];
                }
                add(&mut mean.film, &mut self.weights, &pixels, area, own);
                mean.spp += if is_whole { spp.into() } else { 0 };
                mean.passes.push(pass);
                let claim = Claim::new(&mean.film, &self.foreseen, mean.spp);
                mean.error = claim.map(|claim| claim.of_images(images(&mean.passes, self.plan.power())));
                Progress { seconds: mean.seconds + seconds, rays: sum(mean.rays, rays), ..mean }
            }
            // the first pass with the sampler of all that follow, or one beside which all before it count little
            earlier => {
                assert!(is_whole, "the first pass is of the whole image");
                self.weights = vec![own];
                let (before, rays) = earlier.map_or((0.0, rays), |mean| (mean.seconds, sum(mean.rays, rays)));
                let film = Film { width: settings.width, height: settings.height, pixels };
                let error = Claim::new(&film, &self.foreseen, spp.into());
                Progress { film, error, spp: spp.into(), passes: vec![pass], seconds: before + seconds, rays }
            }
        };
        Some(self.known.insert(mean))
    }

    /// Whether a pass is averaged with what is known.
    fn joins(&self, Pass { spp, sampler, .. }: &Pass, is_whole: bool) -> bool {
        let (own, power) = (f64::from(*spp).powf(self.plan.power()), self.plan.power());
        let has_sampler = self.known.as_ref().is_some_and(|known| known.passes[0].sampler == *sampler);
        has_sampler && !(is_whole && self.weights.iter().all(|&weight| is_left_out(weight, own, power)))
    }

    /// Pixels of an area in a pass of so many samples, joined to what is known of them.
    fn joined(&self, pixels: &[Pixel], area: Area, pass: &Pass, is_whole: bool) -> Vec<Pixel> {
        let Some(known) = self.known.as_ref().filter(|_| self.joins(pass, is_whole)) else { return pixels.to_vec() };
        let (own, width) = (f64::from(pass.spp).powf(self.plan.power()), known.film.width as usize);
        let join = |(pixel, [x, y]): (&Pixel, [u32; 2])| {
            let index = y as usize * width + x as usize;
            let before = self.weights[index.min(self.weights.len() - 1)];
            let mut mean = known.film.pixels[index];
            mean.approach(pixel, own / (before + own));
            mean
        };
        pixels.iter().zip(area::pixels(area)).map(join).collect()
    }
}

/// Renders an image in passes until its goal is reached. `start` receives what is known before each pass and its number of samples, which grows
/// if there is time, and `finish` what is known after it.
///
/// The first pass always completes. After it, a pass begins only if it is predicted to end in time.
///
/// # Errors
/// Fails if no number of samples has a variance, but the goal is an error; if `finish` fails; if the error of the image is
/// unknown because it is black, or too bright for single precision; if no number of samples reaches it, and no time ends the rendering; or
/// if it is stopped.
pub fn render(
    world: &World,
    plan: &Refinement,
    beside: Beside<'_>,
    mut start: impl FnMut(Option<&Progress>, u32),
    mut finish: impl FnMut(&Progress) -> Result<(), String>,
) -> Result<Progress, String> {
    let (settings, goal) = (plan.settings, plan.goal);
    let mut refined = Refined::new(world, plan)?;
    let began = Instant::now();
    let mut next = (refined.schedule.first(), f64::INFINITY);
    loop {
        start(refined.known(), next.0);
        let schedule = refined.schedule.clone();
        let grown = |begun: Begun, [pilot, now]: [f64; 2]| {
            schedule.grown(next, begun, [pilot, now, began.elapsed().as_secs_f64()])
        };
        let grown = goal.seconds.is_some().then_some(&grown as &dyn Fn(Begun, [f64; 2]) -> u32);
        if refined.pass_up_to(world, next.0, settings.whole(), beside, grown).is_none() {
            return Err("the rendering was stopped".to_owned());
        }
        let Some(mut mean) = refined.known.take() else { unreachable!("a pass has ended") };
        mean.seconds = began.elapsed().as_secs_f64();
        if let (Goal { error: Some(target), seconds: None }, Some(claim)) = (goal, mean.error) {
            claim.check(target)?;
        }
        finish(&mean)?;
        match refined.schedule.next(&mean, refined.weights[0], began.elapsed().as_secs_f64()) {
            Some(following) => next = following,
            None if goal.error.is_some() && mean.error.is_none() => {
                return Err(format!("the relative error is not known, because {}", why_unknown(&mean.film, true)));
            }
            None => return Ok(mean),
        }
        refined.known = Some(mean);
    }
}

/// A seed for each pass, that of the first being the seed itself: SplitMix64 (Steele, Lea and Flood 2014).
fn seed(seed: u64, pass: u64) -> u64 {
    if pass == 0 {
        return seed;
    }
    hash64(seed.wrapping_add(pass.wrapping_mul(0x9e37_79b9_7f4a_7c15)))
}

/// Moves the mean towards the pixels of an area in a pass of this weight, and adds it to the weights: one of all pixels, or one of each.
fn add(mean: &mut Film, weights: &mut [f64], pass: &[Pixel], area: Area, own: f64) {
    let width = mean.width;
    if let [weight] = weights {
        *weight += own;
    }
    for (b, [x, y]) in pass.iter().zip(area::pixels(area)) {
        let index = y as usize * width as usize + x as usize;
        let share = if let [weight] = weights {
            own / *weight
        } else {
            weights[index] += own;
            own / weights[index]
        };
        mean.pixels[index].approach(b, share);
    }
}

impl Pixel {
    /// Moves a mean towards a pixel that has this share in it from now on.
    fn approach(&mut self, b: &Self, share: f64) {
        for k in 0..3 {
            let [x, y] = [self.mean[k], b.mean[k]].map(f64::from);
            let [v, w] = [self.variance[k], b.variance[k]].map(f64::from);
            self.mean[k] = (x + share * (y - x)) as f32;
            self.variance[k] = ((1.0 - share).powi(2) * v + share * share * w) as f32;
        }
        self.samples = self.samples.saturating_add(b.samples);
        self.second.add(&b.second, share);
    }
}

/// The number of passes of equal weight that would tell the variance of the image as precisely as these do: (Σv)² / Σv², where v is what each
/// pass adds to that variance.
fn images(passes: &[Pass], power: f64) -> f64 {
    let of = |pass: &Pass| f64::from(pass.spp).powf(power);
    let (sum, squares) = passes.iter().map(of).fold((0.0, 0.0), |(sum, squares), v| (sum + v, squares + v * v));
    sum * sum / squares
}

fn sum(mut a: RayCount, b: RayCount) -> RayCount {
    a += b;
    a
}

#[cfg(test)]
mod tests;
