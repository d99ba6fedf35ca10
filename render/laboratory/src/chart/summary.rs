//! Summarises measurements for the charts.

use super::measure::{Key, Plan, Row, Rows, method};
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
    /// Rendering time of an image in seconds.
    pub seconds: Estimate,
    /// Mean difference from the reference, in standard errors; far from 0 it indicates a bias. NaN for one replicate.
    pub bias: f64,
    /// Costs of the replicates, in order.
    pub costs: Vec<Cost>,
}

impl Point {
    fn new(spp: u32, rows: &[Row], plan: &Plan, key: &Key) -> Self {
        let reference = &plan.scenes[key.scene].reference;
        let costs: Vec<Cost> = rows.iter().map(|r| r.cost(reference)).collect();
        let mut mse = Estimate::of(&costs.iter().map(|c| c.mse).collect::<Vec<_>>());
        mse.half += KNOWN_TO * reference.error;
        let seconds = Estimate::of(&costs.iter().map(|c| c.seconds).collect::<Vec<_>>());
        // channels share their samples, so the reference's error of a pixel counts once
        let own = reference.error / reference.picture.radiance.len() as f64;
        let (mean, deviation) = stats::moments(&rows.iter().map(|r| r.difference).collect::<Vec<_>>());
        let n = rows.len() as f64;
        let bias = if rows.len() < 2 { f64::NAN } else { mean / (deviation * deviation / n + own).sqrt() };
        Self { spp, mse, seconds, bias, costs }
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
    /// Seconds to reach a squared error. The flag is true if that is extrapolated, or if a time has a wide interval.
    #[must_use]
    pub fn seconds_to(&self, mse: f64) -> Option<(f64, bool)> {
        let known = || self.points.iter().filter(|p| p.mse.is_sure());
        let points: Vec<_> = known().map(|p| (p.seconds.value, p.mse.value)).collect();
        let (seconds, beyond) = stats::reach(&points, mse)?;
        Some((seconds, beyond || known().any(|p| !p.seconds.is_sure())))
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
    /// The mean squared error to reach.
    pub target: f64,
    /// Seconds per image at which errors are compared: the shortest time of a series at `spp`.
    pub seconds: f64,
    /// Indices of the series by their error after `seconds`, the least first; series without a positive error come last.
    pub ranking: Vec<usize>,
}

impl Summary {
    /// Summarises scene `scene` of a plan. If `baseline` was not measured, the first series takes its place. The default target is
    /// the error of the best technique, with the baseline's sampler, at the median sample count.
    #[must_use]
    pub fn new(plan: &Plan, rows: &Rows, scene: usize, baseline: Way, target: Option<f64>) -> Self {
        let mut series: Vec<Series> = Vec::new();
        let mut ways: Vec<Way> = Vec::new();
        for key in plan.keys.iter().filter(|k| k.scene == scene) {
            let way = Way { technique: key.technique, choice: key.choice, sampler: key.sampler };
            if !ways.contains(&way) {
                ways.push(way);
            }
        }
        // in the order of `etendue list`
        ways.sort_by_key(|w| (w.technique as usize, w.choice as usize, w.sampler as usize));
        for way in ways {
            let of_way = |k: &&Key| {
                k.scene == scene && (k.technique, k.choice, k.sampler) == (way.technique, way.choice, way.sampler)
            };
            let mut points: Vec<Point> = plan
                .keys
                .iter()
                .filter(of_way)
                .filter_map(|key| Some(Point::new(key.spp, rows.get(key)?, plan, key)))
                .collect();
            points.sort_by_key(|p| p.spp);
            if !points.is_empty() {
                series.push(Series::new(way, points));
            }
        }
        let found = series.iter().position(|s| s.way == baseline);
        let baseline = found.or(if series.is_empty() { None } else { Some(0) });
        let measured = |spp: u32| series.iter().filter(|s| s.at(spp).is_some_and(|p| p.costs.len() > 1)).count();
        // the largest sample count among those that most series have
        let all: Vec<u32> = series.iter().flat_map(|s| s.points.iter().map(|p| p.spp)).collect();
        let in_baseline = |spp: &u32| baseline.is_none_or(|b| series[b].at(*spp).is_some());
        let spp = all.iter().copied().filter(in_baseline).max_by_key(|&n| (measured(n), n)).unwrap_or(0);
        let mut gains = Vec::new();
        if let Some(base) = baseline.and_then(|b| series[b].at(spp)) {
            for (index, one) in series.iter().enumerate() {
                if let Some(gain) = one.at(spp).and_then(|p| stats::gain(&p.costs, &base.costs)) {
                    gains.push(Gain { series: index, gain });
                }
            }
        }
        let middle = baseline.map_or(0.0, |b| {
            let sampler = series[b].way.sampler;
            let spps: Vec<u32> = series[b].points.iter().map(|p| p.spp).collect();
            let spp = spps[spps.len() / 2];
            let of_sampler = series.iter().filter(|s| s.way.sampler == sampler);
            let errors = of_sampler.filter_map(|s| Some(s.at(spp)?.mse.value)).filter(|m| *m > 0.0);
            errors.fold(f64::INFINITY, f64::min)
        });
        let scene = plan.scenes[scene].name.clone();
        let at_spp = || series.iter().filter_map(|s| s.at(spp));
        let seconds = at_spp().map(|p| p.seconds.value).fold(f64::INFINITY, f64::min);
        let errors: Vec<f64> = series.iter().map(|s| s.error_in(seconds).unwrap_or(f64::INFINITY)).collect();
        let mut ranking: Vec<usize> = (0..series.len()).collect();
        ranking.sort_by(|a, b| errors[*a].total_cmp(&errors[*b]));
        Self { scene, series, baseline, spp, gains, target: target.unwrap_or(middle), seconds, ranking }
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

    /// One line: which series has the least error at equal time, and what it gains over independent samples of the same technique. If
    /// that is the best itself, or was not measured, the baseline takes its place, and then the next best.
    #[must_use]
    pub fn headline(&self) -> String {
        let error = |index: usize| self.series[index].error_in(self.seconds);
        let Some((best, least)) = self.ranking.first().and_then(|&best| Some((best, error(best)?))) else {
            return format!("{} — no error is large enough to be measured", self.scene);
        };
        let way = self.series[best].way;
        let independent = Way { sampler: Sampler::Independent, ..way };
        let plain = self.series.iter().position(|s| s.way == independent);
        let others = [plain, self.baseline, self.ranking.get(1).copied()];
        let other =
            others.into_iter().flatten().find_map(|other| Some((other, error(other).filter(|_| other != best)?)));
        let mut line = format!("{} — best: {}", self.scene, way.phrase());
        if let Some((other, more)) = other {
            let (factor, other_way) = (short(more / least), self.series[other].way);
            line += &if other_way.sampler == Sampler::Independent {
                // whose error falls as 1/time
                format!(", which reaches the same error in 1/{factor} of the time of {}", other_way.phrase())
            } else {
                format!(", whose error is 1/{factor} of that of {} at equal time", other_way.phrase())
            };
            line += &format!(" ({} s per image)", short(self.seconds));
            let sure = |index: usize| self.series[index].points.iter().any(Point::is_sure);
            if !sure(best) || !sure(other) {
                line += "; uncertain, because the intervals are wide";
            }
        }
        line
    }
}
