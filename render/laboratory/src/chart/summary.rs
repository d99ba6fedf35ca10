//! Summarises measurements for the charts.

use super::clock::Clock;
use super::measure::{ChartedScene, Key, Measurement, Plan, Rows, method};
use super::reference::Reference;
use super::stats::{self, Cost, Estimate, Reach};
use etendue_render::{ChoiceBy, Sampler, Technique};

/// The errors whose times are compared: relative RMS, the root of the mean squared error over the mean of the reference.
pub const ERRORS: [f64; 3] = [0.03, 0.01, 0.003];
/// The one of them by which series are ordered.
pub(super) const ORDER: usize = 1;

/// A technique with a choice of a light and a sampler.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Way {
    /// How lights are sampled.
    pub technique: Technique,
    /// How one of them is chosen.
    pub choice: ChoiceBy,
    /// How random numbers are generated.
    pub sampler: Sampler,
}

impl Way {
    /// Name of the technique, with the choice of a light unless that is `auto`.
    #[must_use]
    pub fn method(&self) -> String {
        method(self.technique, self.choice)
    }
    /// Number of the colour of the technique and choice.
    #[must_use]
    pub fn color(&self) -> usize {
        self.technique as usize + self.choice as usize
    }
    /// Technique and sampler in a sentence, such as `area with stratified`.
    #[must_use]
    pub fn phrase(&self) -> String {
        format!("{} with {}", self.method(), self.sampler.name())
    }
    /// Name of technique and sampler, such as `area, stratified`.
    #[must_use]
    pub fn title(&self) -> String {
        format!("{}, {}", self.method(), self.sampler.name())
    }
}

/// The results of a technique and sampler at one sample count.
#[derive(Clone, Debug)]
pub struct Point {
    /// Samples per pixel.
    pub spp: u32,
    /// Mean squared error minus that of the reference; the interval includes the uncertainty of the latter.
    pub mse: Estimate,
    /// Mean squared error relative to the square of the reference, see [`super::reference::Difference::relative`], likewise.
    pub relative: Estimate,
    /// Rendering time of an image in seconds on the wall.
    pub wall: Estimate,
    /// The time that counts, in seconds.
    pub seconds: Estimate,
    /// Seconds that all threads together ran for an image, where the system tells.
    pub cpu: Option<Estimate>,
    /// Mean number of rays of an image.
    pub rays: f64,
    /// Mean difference from the reference, as a part of the reference's mean.
    pub offset: f64,
    /// The same in standard errors; far from 0 it indicates a bias. NaN for one replicate.
    pub bias: f64,
    /// Costs of the replicates, in order.
    pub costs: Vec<Cost>,
}

impl Point {
    fn new(spp: u32, rows: &[Measurement], reference: &Reference, clock: Clock) -> Self {
        let costs: Vec<Cost> = rows.iter().map(|r| r.cost(reference, clock)).collect();
        // the errors of the reference were taken off, and are known to some per cent
        let less_reference = |of: fn(&Cost) -> f64, error: f64| {
            let estimate = Estimate::of(&costs.iter().map(of).collect::<Vec<_>>());
            Estimate { half: estimate.half + reference.known_to * error, ..estimate }
        };
        let mse = less_reference(|c| c.mse, reference.error);
        let relative = less_reference(|c| c.relative, reference.relative_error);
        let seconds = Estimate::of(&costs.iter().map(|c| c.seconds).collect::<Vec<_>>());
        let wall = Estimate::of(&rows.iter().map(|r| r.seconds).collect::<Vec<_>>());
        let cpu = rows.iter().map(|r| r.cpu).collect::<Option<Vec<_>>>().map(|cpu| Estimate::of(&cpu));
        let n = rows.len() as f64;
        let rays = rows.iter().map(|r| r.rays.iter().sum::<u64>() as f64).sum::<f64>() / n;
        // channels share their samples, so the reference's error of a pixel counts once
        let own = reference.error / reference.picture.radiance.len() as f64;
        let (mean, deviation) = stats::moments(&rows.iter().map(|r| r.difference.mean).collect::<Vec<_>>());
        let bias = if rows.len() < 2 { f64::NAN } else { mean / (deviation * deviation / n + own).sqrt() };
        Self { spp, mse, relative, wall, seconds, cpu, rays, offset: mean / reference.mean(), bias, costs }
    }
}

/// One line of a chart.
#[derive(Clone, Debug)]
pub struct Series {
    /// Technique and sampler.
    pub way: Way,
    /// Points in order of samples per pixel.
    pub points: Vec<Point>,
    /// Slope of log MSE over log samples per pixel, from the points with narrow intervals.
    pub slope: Option<Estimate>,
    /// When it reaches each of the [`ERRORS`].
    pub reaches: [Option<Reach>; ERRORS.len()],
}

impl Series {
    fn new(way: Way, points: Vec<Point>, reference: &Reference) -> Self {
        let sure: Vec<&Point> = points.iter().filter(|p| p.mse.is_sure()).collect();
        let replicates = sure.iter().map(|p| p.costs.len()).min().unwrap_or(0);
        let errors = |r: usize| sure.iter().map(|p| p.costs[r].mse).collect();
        let errors: Vec<Vec<f64>> = (0..replicates).map(errors).collect();
        let slope = stats::slope(&sure.iter().map(|p| f64::from(p.spp)).collect::<Vec<_>>(), &errors);
        let costs: Vec<&[Cost]> = points.iter().map(|p| &*p.costs).collect();
        let known = reference.known_to * reference.error;
        let reaches = ERRORS.map(|error| stats::reach(&costs, (error * reference.mean()).powi(2), known));
        Self { way, points, slope, reaches }
    }
    /// What is found of a bias: the points whose mean differs from the reference by more than `limit` standard errors, or that there are none.
    #[must_use]
    pub fn bias(&self, limit: f64) -> String {
        if self.points.iter().all(|p| p.bias.is_nan()) {
            return "?".to_owned();
        }
        let found = self.points.iter().filter(|p| p.bias.abs() > limit);
        let list: Vec<String> = found
            .map(|p| format!("{:+.2} % at {} spp ({:.1} σ)", 100.0 * p.offset, p.spp, p.bias.abs()).replace('-', "−"))
            .collect();
        if list.is_empty() { "none found".to_owned() } else { list.join(", ") }
    }
}

/// The results for one scene.
#[derive(Clone, Debug)]
pub struct Summary {
    /// Scene name as given by the user.
    pub scene: String,
    /// Lines of the scene's charts, in the order of `etendue list`.
    pub series: Vec<Series>,
    /// Index of the baseline series.
    pub baseline: Option<usize>,
    /// Which time counts.
    pub clock: Clock,
    /// Mean of the reference over pixels and channels.
    pub mean: f64,
    /// The number of standard errors beyond which chance brings a difference from the reference in one of twenty charts.
    pub bias_limit: f64,
    /// Indices of the series by their time to an error of 1 %, the shortest first; series without a positive error come last.
    pub ranking: Vec<usize>,
}

impl Summary {
    /// Summarises scene `scene` of a plan. If `baseline` was not measured, the first series takes its place.
    #[must_use]
    pub fn new(plan: &Plan, rows: &Rows, scene: usize, baseline: Way, clock: Clock) -> Self {
        let series = lines(plan, rows, scene, clock);
        let found = series.iter().position(|s| s.way == baseline);
        let baseline = found.or(if series.is_empty() { None } else { Some(0) });
        let time = |index: usize| series[index].reaches[ORDER].map_or(f64::INFINITY, |reach| reach.seconds);
        let mut ranking: Vec<usize> = (0..series.len()).collect();
        ranking.sort_by(|a, b| time(*a).total_cmp(&time(*b)));
        // Bonferroni's correction: the points of a chart together are wrong once in twenty times
        let judged = series.iter().flat_map(|s| &s.points).filter(|p| !p.bias.is_nan());
        let replicates = judged.clone().map(|p| p.costs.len()).min().unwrap_or(0);
        let bias_limit = stats::student(replicates, 0.05 / judged.count().max(1) as f64);
        let ChartedScene { name, reference, .. } = &plan.scenes[scene];
        Self { scene: name.clone(), series, baseline, clock, mean: reference.mean(), bias_limit, ranking }
    }

    /// The best series of each technique and choice, the first to reach 1 % first.
    #[must_use]
    pub fn leaders(&self) -> Vec<usize> {
        let mut methods = Vec::new();
        let first = |index: &usize| {
            let method = self.series[*index].way.method();
            let fresh = !methods.contains(&method);
            methods.push(method);
            fresh
        };
        self.ranking.iter().copied().filter(first).collect()
    }

    /// Name of a series in this scene's charts: what not all series have in common.
    #[must_use]
    pub fn name(&self, way: &Way) -> String {
        let [technique, choice, sampler] = self.varies();
        let method = if choice && !technique { format!("by {}", way.choice.name()) } else { way.method() };
        if sampler || !(technique || choice) { format!("{method}, {}", way.sampler.name()) } else { method }
    }
    /// What [`Summary::name`] leaves out, for titles; begins with a comma unless it is empty.
    #[must_use]
    pub fn common(&self) -> String {
        let [technique, choice, sampler] = self.varies();
        let mut text = String::new();
        if let Some(Series { way, .. }) = self.series.first() {
            if choice && !technique {
                text += &format!(", {}", way.technique.name());
            }
            if (technique || choice) && !sampler {
                text += &format!(", {}", way.sampler.name());
            }
        }
        text
    }
    /// Whether series differ in technique, choice of a light and sampler.
    fn varies(&self) -> [bool; 3] {
        let ways = || self.series.iter().map(|s| s.way);
        let Some(first) = ways().next() else { return [false; 3] };
        [
            ways().any(|w| w.technique != first.technique),
            ways().any(|w| w.choice != first.choice),
            ways().any(|w| w.sampler != first.sampler),
        ]
    }
}

/// The series of a scene, in the order of `etendue list`.
fn lines(plan: &Plan, rows: &Rows, scene: usize, clock: Clock) -> Vec<Series> {
    let reference = &plan.scenes[scene].reference;
    let way_of = |key: &Key| Way { technique: key.technique, choice: key.choice, sampler: key.sampler };
    let keys = || plan.keys.iter().filter(|k| k.scene == scene);
    let mut ways: Vec<Way> = Vec::new();
    for way in keys().map(way_of) {
        if !ways.contains(&way) {
            ways.push(way);
        }
    }
    ways.sort_by_key(|w| (w.technique as usize, w.choice as usize, w.sampler as usize));
    let mut series = Vec::new();
    for way in ways {
        let measured = keys().filter(|key| way_of(key) == way);
        let mut points: Vec<Point> =
            measured.filter_map(|key| Some(Point::new(key.spp, rows.get(key)?, reference, clock))).collect();
        points.sort_by_key(|p| p.spp);
        if !points.is_empty() {
            series.push(Series::new(way, points, reference));
        }
    }
    series
}
