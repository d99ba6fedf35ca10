//! Summarises measurements for the charts.

use super::measure::{Key, Measurement, Plan, Rows, method};
use super::plot::short;
use super::reference::KNOWN_TO;
use super::stats::{self, Cost, Estimate};
use etendue_render::{ChoiceBy, Sampler, Technique};

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
    fn phrase(&self) -> String {
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
    /// Rendering time of an image in seconds.
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
    fn new(spp: u32, rows: &[Measurement], plan: &Plan, key: &Key) -> Self {
        let reference = &plan.scenes[key.scene].reference;
        let costs: Vec<Cost> = rows.iter().map(|r| r.cost(reference)).collect();
        // the errors of the reference were taken off, and are known to some per cent
        let less_reference = |of: fn(&Cost) -> f64, error: f64| {
            let estimate = Estimate::of(&costs.iter().map(of).collect::<Vec<_>>());
            Estimate { half: estimate.half + KNOWN_TO * error, ..estimate }
        };
        let mse = less_reference(|c| c.mse, reference.error);
        let relative = less_reference(|c| c.relative, reference.relative_error);
        let seconds = Estimate::of(&costs.iter().map(|c| c.seconds).collect::<Vec<_>>());
        let cpu = rows.iter().map(|r| r.cpu).collect::<Option<Vec<_>>>().map(|cpu| Estimate::of(&cpu));
        let n = rows.len() as f64;
        let rays = rows.iter().map(|r| r.rays.iter().sum::<u64>() as f64).sum::<f64>() / n;
        // channels share their samples, so the reference's error of a pixel counts once
        let own = reference.error / reference.picture.radiance.len() as f64;
        let (mean, deviation) = stats::moments(&rows.iter().map(|r| r.difference.mean).collect::<Vec<_>>());
        let bias = if rows.len() < 2 { f64::NAN } else { mean / (deviation * deviation / n + own).sqrt() };
        Self { spp, mse, relative, seconds, cpu, rays, offset: mean / reference.mean(), bias, costs }
    }
    /// Whether the intervals of both error and time are narrow enough to support a claim.
    #[must_use]
    pub fn is_sure(&self) -> bool {
        self.mse.is_sure() && self.seconds.is_sure()
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
    /// Slope of log MSE over log time, likewise.
    pub slope_in_time: Option<Estimate>,
}

impl Series {
    fn new(way: Way, points: Vec<Point>) -> Self {
        let of = |sure: fn(&Point) -> bool, x: fn(&Point) -> f64| {
            let sure: Vec<&Point> = points.iter().filter(|p| sure(p)).collect();
            let replicates = sure.iter().map(|p| p.costs.len()).min().unwrap_or(0);
            let errors = |r: usize| sure.iter().map(|p| p.costs[r].mse).collect();
            let errors: Vec<Vec<f64>> = (0..replicates).map(errors).collect();
            stats::slope(&sure.iter().map(|p| x(p)).collect::<Vec<_>>(), &errors)
        };
        let slope = of(|p| p.mse.is_sure(), |p| f64::from(p.spp));
        let slope_in_time = of(Point::is_sure, |p| p.seconds.value);
        Self { way, points, slope, slope_in_time }
    }
    /// Squared error that an image of this many seconds has, from the points with narrow intervals or, if there are none, from all.
    #[must_use]
    pub fn error_in(&self, seconds: f64) -> Option<f64> {
        let of = |sure: bool| {
            let points: Vec<_> = self.points.iter().filter(|p| !sure || p.is_sure()).collect();
            stats::level(&points.iter().map(|p| (p.seconds.value, p.mse.value)).collect::<Vec<_>>(), seconds)
        };
        of(true).or_else(|| of(false))
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
    /// The point at this number of samples per pixel.
    #[must_use]
    pub fn at(&self, spp: u32) -> Option<&Point> {
        self.points.iter().find(|p| p.spp == spp)
    }
}

/// Efficiency of a series relative to the baseline.
#[derive(Clone, Copy, Debug)]
pub struct Gain {
    /// Index of the series.
    pub series: usize,
    /// Efficiency as a multiple of the baseline's.
    pub gain: Estimate,
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
    /// Samples per pixel at which efficiencies are compared.
    pub spp: u32,
    /// Efficiencies relative to the baseline at `spp`.
    pub gains: Vec<Gain>,
    /// Seconds per image at which errors are compared: the shortest time of a series at `spp`.
    pub seconds: f64,
    /// The number of standard errors beyond which chance brings a difference from the reference in one of twenty charts.
    pub bias_limit: f64,
    /// Indices of the series by their error after `seconds`, the least first; series without a positive error come last.
    pub ranking: Vec<usize>,
}

impl Summary {
    /// Summarises scene `scene` of a plan. If `baseline` was not measured, the first series takes its place.
    #[must_use]
    pub fn new(plan: &Plan, rows: &Rows, scene: usize, baseline: Way) -> Self {
        let series = lines(plan, rows, scene);
        let found = series.iter().position(|s| s.way == baseline);
        let baseline = found.or(if series.is_empty() { None } else { Some(0) });
        let spp = common_spp(&series, baseline);
        let mut gains = Vec::new();
        if let Some(base) = baseline.and_then(|b| series[b].at(spp)) {
            for (index, one) in series.iter().enumerate() {
                if let Some(gain) = one.at(spp).and_then(|p| stats::gain(&p.costs, &base.costs)) {
                    gains.push(Gain { series: index, gain });
                }
            }
        }
        let at_spp = series.iter().filter_map(|s| s.at(spp));
        let seconds = at_spp.map(|p| p.seconds.value).fold(f64::INFINITY, f64::min);
        let errors: Vec<f64> = series.iter().map(|s| s.error_in(seconds).unwrap_or(f64::INFINITY)).collect();
        let mut ranking: Vec<usize> = (0..series.len()).collect();
        ranking.sort_by(|a, b| errors[*a].total_cmp(&errors[*b]));
        // Bonferroni's correction: the points of a chart together are wrong once in twenty times
        let judged = series.iter().flat_map(|s| &s.points).filter(|p| !p.bias.is_nan());
        let replicates = judged.clone().map(|p| p.costs.len()).min().unwrap_or(0);
        let bias_limit = stats::student(replicates, 0.05 / judged.count().max(1) as f64);
        let scene = plan.scenes[scene].name.clone();
        Self { scene, series, baseline, spp, gains, seconds, bias_limit, ranking }
    }

    /// The best series of each technique and choice, the least error first.
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

    /// One line: which series has the least error at equal time, and how that compares with the best series of another technique, or of
    /// another choice of a light where the technique is one, and with the baseline.
    #[must_use]
    pub fn headline(&self) -> String {
        let error = |index: usize| self.series[index].error_in(self.seconds);
        let Some((best, least)) = self.ranking.first().and_then(|&best| Some((best, error(best)?))) else {
            return format!("{} — no error is large enough to be measured", self.scene);
        };
        let way = |index: usize| self.series[index].way;
        let mut line = format!("{} — best: {}", self.scene, way(best).phrase());
        let [is_technique, ..] = self.varies();
        let differs = |other: &usize| {
            if is_technique {
                way(*other).technique != way(best).technique
            } else {
                way(*other).choice != way(best).choice
            }
        };
        let other = self.ranking.iter().copied().find(differs);
        let kind = if is_technique { "technique" } else { "choice" };
        let mut compared: Vec<(usize, String)> = Vec::new();
        compared.extend(other.map(|other| (other, format!("{}, the best other {kind}", way(other).phrase()))));
        let baseline = self.baseline.filter(|b| *b != best && Some(*b) != other);
        compared.extend(baseline.map(|baseline| {
            let is_plain = way(baseline).technique == Technique::Area && way(baseline).sampler == Sampler::Independent;
            (baseline, if is_plain { "plain area sampling".to_owned() } else { way(baseline).phrase() })
        }));
        let sure = |index: usize| self.series[index].points.iter().any(Point::is_sure);
        let all_sure = sure(best) && compared.iter().all(|(index, _)| sure(*index));
        let parts: Vec<String> = compared
            .into_iter()
            .filter_map(|(index, name)| Some(format!("1/{} of that of {name}", short(error(index)? / least))))
            .collect();
        if !parts.is_empty() {
            line += &format!("; its squared error after {} s is {}", short(self.seconds), parts.join(", and "));
        }
        if !all_sure {
            line += "; uncertain, because the intervals are wide";
        }
        line
    }
}

/// The series of a scene, in the order of `etendue list`.
fn lines(plan: &Plan, rows: &Rows, scene: usize) -> Vec<Series> {
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
            measured.filter_map(|key| Some(Point::new(key.spp, rows.get(key)?, plan, key))).collect();
        points.sort_by_key(|p| p.spp);
        if !points.is_empty() {
            series.push(Series::new(way, points));
        }
    }
    series
}

/// The largest sample count among those that most series have, and that the baseline has.
fn common_spp(series: &[Series], baseline: Option<usize>) -> u32 {
    let measured = |spp: u32| series.iter().filter(|s| s.at(spp).is_some_and(|p| p.costs.len() > 1)).count();
    let all = series.iter().flat_map(|s| s.points.iter().map(|p| p.spp));
    let in_baseline = |spp: &u32| baseline.is_none_or(|b| series[b].at(*spp).is_some());
    all.filter(in_baseline).max_by_key(|&n| (measured(n), n)).unwrap_or(0)
}
