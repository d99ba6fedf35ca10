//! What `auto` loses against the best fixed setting: efficiency, the inverse of squared error times processor time.

use crate::attack::{judge, regimes::REGIMES};
use etendue_render::film::{Film, Pixel};
use etendue_render::scene::Scene;
use etendue_render::{ChoiceBy, RayCount, Sampler, Settings, Technique, World};
use std::fs;
use std::path::Path;
use std::time::Instant;

/// Samples per pixel.
const SPP: u32 = 64;
/// Images of each setting, which take turns.
const TURNS: u64 = 2;
/// So many times the samples has the image that is taken for the truth.
const FINER: u32 = 2;
/// Pixels of an image.
const PIXELS: f64 = 65_536.0;
/// Settings of less than this part of the best efficiency in an image of a sixteenth of the pixels are left out.
const WORTH: f64 = 0.5;

/// The choice of a light and the sampler of `auto`.
const USUAL: (ChoiceBy, Sampler) = (ChoiceBy::Auto, Sampler::Adaptive);

/// Settings that are compared: the techniques, then the ways to choose a light, then the samplers.
fn settings(scene: &Scene, size: [u32; 2]) -> Vec<Settings> {
    let [width, height] = size;
    let auto = Settings { width, height, spp: SPP, sampler: Sampler::Adaptive, ..Settings::DEFAULT };
    let is_glossy = scene.materials.iter().any(etendue_render::scene::Material::is_glossy);
    let sampled = if is_glossy { Technique::MisLobe } else { Technique::SolidAngle };
    let blind = [Technique::UniformHemisphere, Technique::CosineHemisphere, Technique::MisBalance];
    let techniques = Technique::ALL.into_iter().filter(|technique| !blind.contains(technique));
    let by_technique = techniques.map(|technique| Settings { technique, ..auto });
    let by_choice = ChoiceBy::ALL.into_iter().map(|choice| Settings { technique: sampled, choice, ..auto });
    let by_sampler = [Sampler::Sobol, Sampler::Sobol4d, Sampler::ZOrder, Sampler::Stratified];
    let by_sampler = by_sampler.into_iter().map(|sampler| Settings { sampler, ..auto });
    by_technique.chain(by_choice).chain(by_sampler).collect()
}

fn title(settings: &Settings) -> String {
    let Settings { technique, choice, sampler, .. } = settings;
    let choice = if *choice == ChoiceBy::Auto { String::new() } else { format!(" {}", choice.name()) };
    let sampler = if *sampler == Sampler::Adaptive { String::new() } else { format!(" {}", sampler.name()) };
    format!("{}{choice}{sampler}", technique.name())
}

/// Seconds that this thread has run on a processor.
fn processor() -> f64 {
    let text = fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|ns| ns.parse::<f64>().ok()).map_or(f64::NAN, |ns| 1e-9 * ns)
}

/// What images of a setting took.
struct Taken {
    settings: Settings,
    /// Mean squared difference from the truth, of each image.
    squares: Vec<f64>,
    seconds: Vec<f64>,
    rays: RayCount,
    first: Vec<[f32; 3]>,
}

impl Taken {
    fn square(&self) -> f64 {
        self.squares.iter().sum::<f64>() / self.squares.len() as f64
    }
    /// The least time counts: others were interrupted.
    fn seconds(&self) -> f64 {
        self.seconds.iter().copied().fold(f64::INFINITY, f64::min)
    }
    fn efficiency(&self) -> f64 {
        1.0 / (self.square() * self.seconds())
    }
}

/// An image that is taken for the truth, and its own mean squared error.
struct Truth {
    film: Film,
    own: f64,
}

impl Truth {
    /// By the rule: the error of what samples where others compute would hide theirs.
    fn new(world: &World, rule: Technique, [width, height]: [u32; 2]) -> Self {
        let (spp, technique, sampler) = (FINER * SPP, rule, Sampler::Adaptive);
        let settings = Settings { width, height, spp, technique, sampler, seed: 1 << 40, ..Settings::DEFAULT };
        let (film, _) = world.render(&settings, &|_| ());
        let own = film.pixels.iter().flat_map(|p| p.variance).map(f64::from).sum::<f64>();
        Self { own: own / (3.0 * film.pixels.len() as f64), film }
    }
    /// The mean squared error of an image.
    fn square(&self, film: &Film) -> f64 {
        let square = |(a, b): (&Pixel, &Pixel)| (0..3).map(|k| f64::from(a.mean[k] - b.mean[k]).powi(2)).sum::<f64>();
        let sum: f64 = film.pixels.iter().zip(&self.film.pixels).map(square).sum();
        (sum / (3.0 * film.pixels.len() as f64) - self.own).max(0.1 * self.own)
    }
}

/// Renders images by some settings in turns. Of two that stand for the same, the first is measured; `auto` has a time of its own.
fn images(world: &World, all: &[Settings], truth: &Truth, turns: u64) -> Vec<Taken> {
    let taken = |&settings: &Settings| Taken {
        settings,
        squares: vec![],
        seconds: vec![],
        rays: RayCount::default(),
        first: vec![],
    };
    let mut all: Vec<Taken> = all.iter().map(taken).collect();
    for turn in 0..turns {
        let mut k = 0;
        while k < all.len() {
            let began = processor();
            let (film, rays) = world.render(&Settings { seed: turn + 1, ..all[k].settings }, &|_| ());
            let seconds = processor() - began;
            let first: Vec<_> = film.pixels.iter().map(|p| p.mean).collect();
            let is_auto = |one: &Taken| one.settings.technique == Technique::Auto;
            if turn == 0 && !is_auto(&all[k]) && all[..k].iter().any(|other| !is_auto(other) && other.first == first) {
                all.remove(k);
                continue;
            }
            let one = &mut all[k];
            one.squares.push(truth.square(&film));
            one.seconds.push(seconds);
            (one.first, one.rays) = if turn == 0 { (first, rays) } else { (std::mem::take(&mut one.first), one.rays) };
            k += 1;
        }
    }
    all
}

/// What a sample of an image consists of, each with its name, the nanoseconds that trials take it to need, and how many there are; and the
/// nanoseconds that it took.
struct Row {
    kinds: Vec<(&'static str, f64, f64)>,
    ns: f64,
}

/// Prints the times by which trials count costs beside those that are nearest to the times of images, and how far both are from these.
fn print_times(rows: &[Row]) {
    let mut times: Vec<f64> = rows[0].kinds.iter().map(|kind| kind.1).collect();
    let counted =
        |row: &Row, times: &[f64]| row.kinds.iter().zip(times).map(|(kind, t)| kind.2 * t).sum::<f64>() / row.ns;
    let far = |times: &[f64]| {
        let mut all: Vec<f64> = rows.iter().map(|row| counted(row, times)).collect();
        all.sort_by(f64::total_cmp);
        [1, 5, 9].map(|tenth| format!("{:.2}", all[tenth * all.len() / 10])).join(", ")
    };
    println!("counted over measured times of {} images, first, fifth and ninth tenth: {}", rows.len(), far(&times));
    // the least sum of squared relative differences, by one time after the other, none of which is less than nothing
    let count = times.len();
    for k in (0..4000 * count).map(|step| step % count) {
        let sums = rows.iter().fold([0.0, 0.0], |[above, below], row| {
            let n = row.kinds[k].2 / row.ns;
            [above + n * (1.0 - counted(row, &times) + n * times[k]), below + n * n]
        });
        times[k] = if sums[1] > 0.0 { (sums[0] / sums[1]).max(0.0) } else { 0.0 };
    }
    for (kind, time) in rows[0].kinds.iter().zip(&times) {
        println!("    {:34} {:6.0} ns, nearest {time:6.1}", kind.0, kind.1);
    }
    println!("with the nearest: {}", far(&times));
}

/// Measures a scene; returns the efficiencies of the rule of small images and of `auto` relative to the best.
fn measure(name: &str, scene: &Scene, rows: &mut Vec<Row>) -> Option<[f64; 2]> {
    let aspect = f64::from(scene.film.width) / f64::from(scene.film.height);
    let height = (PIXELS / aspect).sqrt().round().max(4.0);
    let size = [(height * aspect).round().max(4.0) as u32, height as u32];
    let world = World::new(scene).ok()?;
    // so small an image takes no trial, and what is far from the best in it is left out
    let [width, height] = size.map(|side| side / 4);
    let auto = Settings { width, height, spp: SPP, sampler: Sampler::Adaptive, ..Settings::DEFAULT };
    let rule = world.view(&auto).technique();
    let small = std::iter::once(Settings { technique: rule, ..auto }).chain(settings(scene, [width, height]));
    let small: Vec<Settings> = small.filter(|settings| world.check(settings).is_ok()).collect();
    let small = images(&world, &small, &Truth::new(&world, rule, [width, height]), 1);
    let most = small.iter().map(Taken::efficiency).fold(0.0, f64::max);
    let always = [Technique::Auto, Technique::Analytic, rule];
    let is_kept = |one: &&Taken| {
        one.efficiency() >= WORTH * most
            || always.contains(&one.settings.technique) && (one.settings.choice, one.settings.sampler) == USUAL
    };
    let kept: Vec<Settings> =
        small.iter().filter(is_kept).map(|one| Settings { width: size[0], height: size[1], ..one.settings }).collect();
    let truth = Truth::new(&world, rule, size);
    let all = images(&world, &kept, &truth, TURNS);
    let best = all.iter().map(Taken::efficiency).fold(0.0, f64::max);
    let mean = truth.film.mean().iter().sum::<f64>() / 3.0;
    let of = |technique: Technique| {
        all.iter()
            .find(|one| one.settings.technique == technique && (one.settings.choice, one.settings.sampler) == USUAL)
    };
    let auto = of(Technique::Auto)?;
    let regret = [of(rule)?, auto].map(|one| one.efficiency() / best);
    let view = world.view(&auto.settings);
    let found = view.trial().map_or_else(String::new, |trial| {
        let over = title(&Settings { technique: trial.over.0, choice: trial.over.1, ..auto.settings });
        format!("{:.2} × {over}, {} tiles, {:.1} %", trial.times, trial.tiles, 100.0 * trial.part)
    });
    let chosen = title(view.settings());
    println!(
        "{name:22} before {:.3} ({}), auto {:.3} ({chosen}) {found}  truth's error {:.2e}",
        regret[0],
        rule.name(),
        regret[1],
        truth.own.sqrt() / mean
    );
    let mut order: Vec<&Taken> = all.iter().collect();
    order.sort_by(|a, b| b.efficiency().total_cmp(&a.efficiency()));
    for one in order {
        let samples = truth.film.pixels.len() as f64 * f64::from(SPP);
        let ns = 1e9 * one.seconds() / samples;
        let kinds = world.view(&one.settings).kinds(&one.rays).into_iter();
        let kinds: Vec<_> = kinds.map(|(name, time, count)| (name, time, count / samples)).collect();
        let counts: String = kinds.iter().map(|kind| format!(" {:.3}", kind.2)).collect();
        let relative = one.efficiency() / best;
        println!(
            "    {:28} {relative:.3}  error {:.2e}  {ns:6.1} ns {counts}",
            title(&one.settings),
            one.square().sqrt() / mean
        );
        // the time of a trial is not counted
        if one.settings.technique != Technique::Auto {
            rows.push(Row { kinds, ns });
        }
    }
    Some(regret)
}

/// The scenes of the table.
fn scenes() -> Vec<(String, Scene)> {
    let mut all: Vec<(String, Scene)> = etendue_scene::builtin()
        .iter()
        .map(|(name, _)| ((*name).to_owned(), etendue_scene::load(name).unwrap()))
        .collect();
    let gallery = Path::new(env!("CARGO_MANIFEST_DIR")).join("../gallery");
    for file in [
        "emitters/panel",
        "emitters/television",
        "emitters/washers",
        "emitters/window",
        "emitters/windows",
        "glossy/floor",
        "glossy/varnish",
    ] {
        let scene = etendue_scene::load(gallery.join(file).with_extension("pbrt")).unwrap();
        if file == "emitters/windows" {
            let mut bare = etendue_scene::load(gallery.join(file).with_extension("pbrt")).unwrap();
            bare.environment.iter_mut().for_each(|sky| sky.portals.clear());
            all.push(("windows, no portals".into(), bare));
        }
        all.push((file.into(), scene));
    }
    for (i, regime) in REGIMES.iter().enumerate().take(30) {
        if let Ok(scene) = judge::read(&regime.draft(i as u64)) {
            all.push((format!("{} {i}", regime.name), scene));
        }
    }
    let only = std::env::var("ETENDUE_SCENES").unwrap_or_default();
    all.retain(|(name, _)| only.is_empty() || only.split(',').any(|one| name.starts_with(one)));
    all
}

#[test]
#[ignore = "53 scenes by some 30 images: ten minutes; ETENDUE_SCENES=studio,metals has these alone"]
fn regret_of_auto_as_a_table() {
    let began = Instant::now();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build().unwrap();
    let mut rows = Vec::new();
    let all: Vec<[f64; 2]> =
        pool.install(|| scenes().iter().filter_map(|(name, scene)| measure(name, scene, &mut rows)).collect());
    print_times(&rows);
    for (k, what) in ["the rule of small images", "auto"].into_iter().enumerate() {
        let mut all: Vec<f64> = all.iter().map(|both| both[k]).collect();
        all.sort_by(f64::total_cmp);
        println!("{} scenes, {what}: median {:.3}, least {:.3}", all.len(), all[all.len() / 2], all[0]);
    }
    println!("{:.0} s", began.elapsed().as_secs_f64());
}
