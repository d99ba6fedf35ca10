//! Compares images of a scene with the oracle's, and with the sum of the images of its lights, block by block.

use super::bridge::{CHANNEL, bodies, framed, sources, straighten, view};
use super::draft::{Draft, Frame, Look, Map, Part};
use super::regimes::named;
use crate::kit::Folder;
use etendue_oracle::direct::{self, Block, Body, SurfacelessLight, View};
use etendue_render::film::Film;
use etendue_render::film::compare::{LIMIT, differs};
use etendue_render::scene::{Affine, Instance, Scene};
use etendue_render::{Settings, Technique, World};

/// How precisely a scene is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Effort {
    /// Width and height of the images in pixels.
    pub(crate) side: u32,
    /// Width and height of the blocks that are compared, in pixels.
    pub(crate) block: u32,
    /// Samples per pixel of each technique.
    pub(crate) spp: u32,
    /// Points per pixel of the oracle: four times the square of this.
    pub(crate) points: usize,
    /// Seed of all random numbers.
    pub(crate) seed: u64,
}

impl Effort {
    /// Images of this size with so many samples per pixel.
    pub(crate) fn new(side: u32, spp: u32, seed: u64) -> Self {
        let points = (f64::from(spp).sqrt() / 4.0).max(1.0) as usize;
        Self { side, block: side.div_ceil(3), spp, points, seed: seed.wrapping_mul(0x9e37_79b9) }
    }
    /// The same scene again, with other random numbers and more of them.
    pub(crate) const fn again(self) -> Self {
        Self { spp: 4 * self.spp, points: 2 * self.points, seed: self.seed ^ 0x5bd1_e995, ..self }
    }
}

/// Beside noise, a block may be off by this fraction of the light that would arrive if nothing hid it, …
pub(crate) const TOLERANCE: f64 = 2e-5;
/// … and by what it changes if points are off their surface by this fraction of their coordinates, two units in the last place, and if the
/// ends of ways to lights are spared, so that a surface that cuts a light hides a strip less of it.
pub(crate) const ROUNDING: f64 = 1.0 / 4_194_304.0;
/// That end, as a fraction of the way.
const SPARED: f64 = 1.0 / 131_072.0;
/// Of fewer samples than this that see a light, or do not, an image cannot tell its own error.
const FEW: f64 = 10.0;

/// A scene to render, and what it shows.
#[derive(Clone, Debug)]
pub(crate) struct Trial {
    /// The scene, as it is written.
    scene: Scene,
    /// Width and height of its images in pixels.
    size: [u32; 2],
    /// What the oracle renders, unless that takes too long.
    exact: Option<(Vec<Body>, Vec<SurfacelessLight>, View)>,
    /// The scenes of its lights alone, if they are to be summed.
    alone: Vec<Scene>,
}

/// What an image is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Against {
    /// The oracle's.
    Oracle,
    /// The sum of those of its lights alone.
    Sum,
}

/// One technique against the oracle, or against a sum.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct JudgedTechnique {
    /// What it is compared with.
    pub(crate) against: Against,
    /// How lights were sampled.
    pub(crate) technique: Technique,
    /// The technique that `auto` chose, or the same.
    pub(crate) chosen: Technique,
    /// Difference of each block in standard errors, beyond the tolerance.
    pub(crate) z: Vec<f64>,
    /// The part of the difference of each block that is more than three standard errors, relative to its light if nothing hid it.
    pub(crate) relative: Vec<f64>,
}

/// The judgement of a scene.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Verdict {
    /// What the oracle has computed.
    pub(crate) truth: Vec<Block>,
    /// One row per technique.
    pub(crate) rows: Vec<JudgedTechnique>,
}

impl JudgedTechnique {
    /// Whether a block differs.
    fn differs(&self, i: usize) -> bool {
        differs(self.z[i])
    }
    /// The blocks that differ.
    pub(crate) fn failing(&self) -> impl Iterator<Item = usize> {
        (0..self.z.len()).filter(|&i| self.differs(i))
    }
    /// The greatest |z|.
    pub(crate) fn greatest_z(&self) -> f64 {
        self.z.iter().fold(0.0, |m: f64, z| if z.is_nan() { f64::INFINITY } else { m.max(z.abs()) })
    }
    /// The difference of greatest magnitude, relative to the light of its block if nothing hid it.
    pub(crate) fn greatest_difference(&self) -> f64 {
        self.relative.iter().fold(0.0, |m: f64, x| if x.abs() > m.abs() { *x } else { m })
    }
}

impl Verdict {
    /// Techniques with a block that differs.
    pub(crate) fn failing(&self) -> impl Iterator<Item = Technique> {
        self.rows.iter().filter(|row| row.failing().next().is_some()).map(|row| row.technique)
    }
}

/// Reads the text of a draft, exactly as a scene file, with its pictures.
pub(crate) fn read(draft: &Draft) -> Result<Scene, String> {
    if !draft.is_shared {
        return with_pictures(draft);
    }
    // what is copied behind all else, and once
    let (copied, mut parts): (Vec<Part>, Vec<Part>) =
        draft.parts.iter().cloned().partition(|part| !part.copies.is_empty());
    parts.extend(copied.iter().map(|part| Part { copies: Vec::new(), ..part.clone() }));
    let mut scene = with_pictures(&Draft { parts, ..draft.clone() })?;
    let mut end = scene.triangles.len() - copied.iter().map(|part| part.form.triangles().len()).sum::<usize>();
    for (object, part) in (0..).zip(&copied) {
        let start = end;
        end += part.form.triangles().len();
        scene.objects.push(start..end);
        let narrow = |map: &Map| Affine(map.map(|row| row.map(|x| x as f32)));
        scene.instances.extend(part.copies.iter().map(|map| Instance { object, to_world: narrow(map) }));
    }
    Ok(scene)
}

fn with_pictures(draft: &Draft) -> Result<Scene, String> {
    let folder = Folder::new();
    draft.pictures().for_each(|picture| drop(folder.write(&picture.name(), picture.bytes())));
    etendue_scene::parse(&draft.to_string(), "attack.pbrt", &folder.path("")).map_err(|error| error.to_string())
}

/// The techniques that are compared: what images use by default, and two that share little with it.
pub(crate) const TECHNIQUES: [Technique; 4] =
    [Technique::Auto, Technique::Analytic, Technique::SolidAngle, Technique::Area];

/// Those of them whose images are compared with sums.
const SUMMED: [Technique; 2] = [Technique::Auto, Technique::SolidAngle];
/// The oracle takes no scene in which each point of a surface asks for more bodies than this.
const MOST: usize = 3000;

impl Trial {
    /// Images of this width and height of a scene, which is what it says.
    pub(crate) fn new(scene: Scene, side: u32) -> Self {
        let exact = (bodies(&scene), Vec::new(), view(&scene.camera, side, side));
        Self { scene, size: [side; 2], exact: Some(exact), alone: Vec::new() }
    }
    /// A draft, whose images have this width and height, unless it has a film of its own.
    pub(crate) fn read(draft: &Draft, side: u32) -> Result<Self, String> {
        let scene = read(draft)?;
        let frame = draft.look.frame;
        let size = frame.map_or([side; 2], |Frame { window, .. }| window.map(|[from, to]| to - from));
        let plain = read(&Draft { look: Look { frame: None, ..draft.look }, ..draft.clone() })?;
        let mut bodies = bodies(&plain);
        straighten(draft, &mut bodies);
        let emitting = bodies.iter().filter(|body| body.emission.is_some()).count();
        let is_small = (emitting + 4 * draft.sources.len()) * bodies.len() <= MOST;
        let view = frame.map_or_else(|| view(&plain.camera, side, side), |frame| framed(&frame, &plain.camera));
        let exact = is_small.then(|| (bodies, sources(&draft.sources), view));
        let alone = draft.alone();
        let alone = if is_small && alone.len() < 2 { Vec::new() } else { alone };
        let alone = alone.iter().map(read).collect::<Result<_, _>>()?;
        Ok(Self { scene, size, exact, alone })
    }
}

/// Judges a scene by these techniques.
pub(crate) fn judge(trial: &Trial, techniques: &[Technique], effort: &Effort) -> Result<Verdict, String> {
    let &Effort { block, spp, seed, .. } = effort;
    let [width, height] = trial.size;
    let settings = |technique, i: u64| Settings {
        width,
        height,
        spp,
        technique,
        sets: 4,
        seed: seed.wrapping_mul(64).wrapping_add(i),
        ..Settings::DEFAULT
    };
    let world = |scene: &Scene| World::new(scene).map_err(|error| error.to_string());
    let truth = exact(trial, effort, [0.0, direct::SPARED]);
    let mut slack = vec![0.0; truth.len()];
    let whole = world(&trial.scene)?;
    let mut images: Vec<([Technique; 2], Vec<[f64; 2]>)> = Vec::new();
    for (i, &technique) in (0..).zip(techniques) {
        let view = whole.view(&settings(technique, i));
        let chosen = view.technique();
        if technique == Technique::Auto || images.iter().all(|([_, other], _)| *other != technique) {
            images.push(([technique, chosen], blocks(&view.image(&|_| ()).0, block)));
        }
    }
    let against = |slack: &[f64]| -> Vec<JudgedTechnique> {
        images.iter().map(|(by, image)| compare(*by, image, &truth, slack, effort)).collect()
    };
    let mut rows = if truth.is_empty() { Vec::new() } else { against(&slack) };
    if rows.iter().any(|row| row.failing().next().is_some()) {
        // the same random numbers, so that the difference has hardly any noise
        let lifted = exact(trial, effort, [ROUNDING, SPARED]);
        slack = truth.iter().zip(&lifted).map(|(a, b)| (a.mean - b.mean).abs()).collect();
        rows = against(&slack);
    }
    if !trial.alone.is_empty() {
        let mut sum = vec![[0.0; 2]; images.first().map_or(0, |(_, image)| image.len())];
        for (i, scene) in (8..).zip(&trial.alone) {
            let film = world(scene)?.render(&settings(Technique::Auto, i), &|_| ()).0;
            for (sum, [mean, variance]) in sum.iter_mut().zip(blocks(&film, block)) {
                *sum = [sum[0] + mean, sum[1] + variance];
            }
        }
        // closed forms of lights alone are as accurate as a fraction of what would arrive if nothing hid them
        let hidden = |(slack, block): (&f64, &Block)| slack + TOLERANCE * block.unoccluded;
        let slack: Vec<f64> = slack.iter().zip(&truth).map(hidden).collect();
        let summed = images.iter().filter(|([technique, _], _)| SUMMED.contains(technique));
        rows.extend(summed.map(|(by, image)| compare_sum(*by, image, &sum, &slack)));
    }
    Ok(Verdict { truth, rows })
}

/// Mean and squared standard error of the blocks of an image.
fn blocks(film: &Film, side: u32) -> Vec<[f64; 2]> {
    let columns = film.width.div_ceil(side);
    let mut sums = vec![[0.0; 3]; (columns * film.height.div_ceil(side)) as usize];
    for (i, pixel) in (0..).zip(&film.pixels) {
        let (x, y) = (i % film.width, i / film.width);
        let sum = &mut sums[(y / side * columns + x / side) as usize];
        let values = [f64::from(pixel.mean[CHANNEL]), f64::from(pixel.variance[CHANNEL]), 1.0];
        *sum = std::array::from_fn(|k| sum[k] + values[k]);
    }
    sums.into_iter().map(|[mean, variance, count]| [mean / count, variance / (count * count)]).collect()
}

/// The oracle's blocks, with its points off their surface by a fraction of their coordinates, and this end of each way to a light spared.
fn exact(trial: &Trial, effort: &Effort, [lift, spared]: [f64; 2]) -> Vec<Block> {
    let Some((bodies, sources, view)) = &trial.exact else { return Vec::new() };
    let &Effort { block, points, seed, .. } = effort;
    let effort =
        direct::Effort { replicates: 4, side: points, points: 16, depth: Settings::DEPTH as usize, seed, lift, spared };
    direct::render(bodies, sources, view, block as usize, &effort)
}

/// The variance of the mean of so many samples that a few of them would show, if each is at most `greatest`; 0 if they are not few.
fn unseen(mean: f64, greatest: f64, samples: f64) -> f64 {
    let few = samples * mean / greatest;
    if few < FEW { few * (greatest / samples).powi(2) } else { 0.0 }
}

/// What a block differs by beyond the tolerance and `slack`, in standard errors; and by more than three of these, relative to `scale`.
fn score(difference: f64, scale: f64, slack: f64, error: f64) -> [f64; 2] {
    let beyond = (difference.abs() - TOLERANCE * scale - slack).max(0.0);
    let z = if beyond > 0.0 { beyond / error.max(1e-9 * scale) * difference.signum() } else { 0.0 };
    let relative = (difference.abs() - 3.0 * error).max(0.0).copysign(difference) / scale;
    [if difference.is_nan() { f64::NAN } else { z }, relative]
}

/// Compares an image with the oracle's.
fn compare(
    [technique, chosen]: [Technique; 2],
    image: &[[f64; 2]],
    truth: &[Block],
    slack: &[f64],
    effort: &Effort,
) -> JudgedTechnique {
    let (mut z, mut relative) = (Vec::new(), Vec::new());
    let samples = f64::from(effort.block).powi(2) * f64::from(effort.spp);
    let total: f64 = truth.iter().map(|block| block.unoccluded).sum();
    for (([mean, variance], block), slack) in image.iter().zip(truth).zip(slack) {
        // a block that hardly receives light is judged by the light of the image
        let scale = block.unoccluded.max(1e-3 * total / truth.len() as f64).max(f64::MIN_POSITIVE);
        // samples may all miss the little that is seen of a light, and a shadow that is rarely met; closed forms meet every shadow
        let lit = unseen(block.mean, scale.max(block.greatest), samples);
        let is_sampled = chosen != Technique::Analytic || *variance == 0.0;
        let hidden = if is_sampled { unseen((scale - block.mean).max(0.0), scale, samples) } else { 0.0 };
        let error = (variance.max(lit + hidden) + block.error * block.error).sqrt();
        let scores = score(mean - block.mean, scale, *slack, error);
        z.push(scores[0]);
        relative.push(scores[1]);
    }
    JudgedTechnique { against: Against::Oracle, technique, chosen, z, relative }
}

/// Compares an image with the sum of others; what comes of points off their surfaces is known if the oracle has been asked.
fn compare_sum(
    [technique, chosen]: [Technique; 2],
    image: &[[f64; 2]],
    sum: &[[f64; 2]],
    slack: &[f64],
) -> JudgedTechnique {
    let total: f64 = sum.iter().map(|[mean, _]| mean).sum();
    let (mut z, mut relative) = (Vec::new(), Vec::new());
    let slack = slack.iter().copied().chain(std::iter::repeat(0.0));
    for (([mean, variance], [expected, of_sum]), slack) in image.iter().zip(sum).zip(slack) {
        let scale = expected.max(1e-3 * total / sum.len() as f64).max(f64::MIN_POSITIVE);
        let scores = score(mean - expected, scale, slack, (variance + of_sum).sqrt());
        z.push(scores[0]);
        relative.push(scores[1]);
    }
    JudgedTechnique { against: Against::Sum, technique, chosen, z, relative }
}

/// Further judgements of what differs. A sliver of light that some technique samples, or the oracle, may be missed even by thousands of
/// samples, and its error with it; each judgement takes four times as many as the one before.
const AGAIN: usize = 3;
/// Where so many blocks differ twice, it is no sliver.
const PLAIN: usize = 5;

/// Judges a scene, and again by those techniques that differ: what is left differs in the same block each time.
pub(crate) fn confirmed(trial: &Trial, techniques: &[Technique], effort: &Effort) -> Result<Verdict, String> {
    let mut first = judge(trial, techniques, effort)?;
    let mut effort = *effort;
    for round in 0..AGAIN {
        let is_plain = |row: &JudgedTechnique| row.failing().next().is_none() || row.failing().count() >= PLAIN;
        if round > 0 && first.rows.iter().all(is_plain) {
            break;
        }
        let suspects: Vec<Technique> =
            techniques.iter().copied().filter(|by| first.failing().any(|t| t == *by)).collect();
        if suspects.is_empty() {
            break;
        }
        effort = effort.again();
        let other = judge(trial, &suspects, &effort)?;
        for row in &mut first.rows {
            let same = |other: &&JudgedTechnique| (other.technique, other.against) == (row.technique, row.against);
            let Some(other) = other.rows.iter().find(same) else { continue };
            let refuted: Vec<usize> =
                row.failing().filter(|&i| !other.differs(i) || other.z[i].signum() != row.z[i].signum()).collect();
            for i in refuted {
                (row.z[i], row.relative[i]) = (other.z[i].clamp(-LIMIT, LIMIT) * 0.999, other.relative[i]);
            }
        }
    }
    Ok(first)
}

/// Neither judge passes an image with a light too many.
#[test]
fn judges_notice_a_light() {
    let mut seen = 0;
    for seed in 0..6 {
        let draft = named("skies").draft(seed);
        let mut trial = Trial::read(&draft, 16).unwrap();
        if trial.alone.len() < 2 || seen == etendue_oracle::tier::cases(3, 6) {
            continue;
        }
        seen += 1;
        // which is a source, and one that matters
        trial.alone.pop();
        trial.exact.as_mut().unwrap().1.pop();
        let verdict = judge(&trial, &TECHNIQUES[..1], &Effort::new(16, 64, 1)).unwrap();
        let fails =
            |against: Against| verdict.rows.iter().any(|row| row.against == against && row.failing().next().is_some());
        assert!(fails(Against::Oracle) && fails(Against::Sum), "{draft}{verdict:?}");
    }
    assert!(seen > 2, "{seen}");
}
