//! From measurements to what the charts show.

use super::measure::{Key, Plan, Row, Rows};
use super::name;
use super::reference::KNOWN_TO;
use super::stats::{self, Cost, Estimate};
use crate::{Sampler, Technique};

/// A technique with a sampler.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Way {
    /// How lights are sampled.
    pub technique: Technique,
    /// Where the random numbers come from.
    pub sampler: Sampler,
}

impl Way {
    /// As in `area, stratified`.
    #[must_use]
    pub fn title(&self) -> String {
        format!("{}, {}", name(self.technique), name(self.sampler))
    }
}

/// One way at one number of samples per pixel.
#[derive(Clone, Debug)]
pub struct Point {
    /// Samples per pixel.
    pub spp: u32,
    /// Squared error less the reference's; its interval includes what the latter is not known to.
    pub mse: Estimate,
    /// Time for an image.
    pub seconds: Estimate,
    /// Mean difference from the reference in its standard errors; a bias if it is far from 0. NaN for one replicate.
    pub bias: f64,
    /// Each replicate, in their order.
    pub costs: Vec<Cost>,
}

impl Point {
    fn new(spp: u32, rows: &[Row], plan: &Plan, key: &Key) -> Self {
        let reference = &plan.scenes[key.scene].reference;
        let costs: Vec<Cost> = rows.iter().map(|r| r.cost(reference)).collect();
        let mut mse = Estimate::of(&costs.iter().map(|c| c.mse).collect::<Vec<_>>());
        mse.half += KNOWN_TO * reference.error;
        let seconds = Estimate::of(&costs.iter().map(|c| c.seconds).collect::<Vec<_>>());
        // channels share their samples: the reference's error of a pixel counts once
        let own = reference.error / reference.picture.radiance.len() as f64;
        let (mean, deviation) = stats::moments(&rows.iter().map(|r| r.difference).collect::<Vec<_>>());
        let n = rows.len() as f64;
        let bias = if rows.len() < 2 { f64::NAN } else { mean / (deviation * deviation / n + own).sqrt() };
        Self { spp, mse, seconds, bias, costs }
    }
    /// Do the intervals of both error and time support a claim?
    #[must_use]
    pub fn is_sure(&self) -> bool {
        self.mse.is_sure() && self.seconds.is_sure()
    }
}

/// One line of a chart.
#[derive(Clone, Debug)]
pub struct Series {
    /// Which.
    pub way: Way,
    /// In the order of samples per pixel.
    pub points: Vec<Point>,
    /// Of log MSE over log samples per pixel, from the points that are sure.
    pub slope: Option<Estimate>,
    /// Of log MSE over log time.
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
    /// Seconds to reach a squared error; the flag says whether that lies beyond what was measured, or a time is not sure.
    #[must_use]
    pub fn seconds_to(&self, mse: f64) -> Option<(f64, bool)> {
        let known = || self.points.iter().filter(|p| p.mse.is_sure());
        let points: Vec<_> = known().map(|p| (p.seconds.value, p.mse.value)).collect();
        let (seconds, beyond) = stats::reach(&points, mse)?;
        Some((seconds, beyond || known().any(|p| !p.seconds.is_sure())))
    }
    /// The point at so many samples per pixel.
    #[must_use]
    pub fn at(&self, spp: u32) -> Option<&Point> {
        self.points.iter().find(|p| p.spp == spp)
    }
}

/// Efficiency of a series over the baseline's.
#[derive(Clone, Copy, Debug)]
pub struct Gain {
    /// Index of the series.
    pub series: usize,
    /// How many times the baseline's.
    pub gain: Estimate,
}

/// All about one scene.
#[derive(Clone, Debug)]
pub struct Summary {
    /// As the user named it.
    pub scene: String,
    /// Lines of its charts.
    pub series: Vec<Series>,
    /// Index of the series that others are compared with.
    pub baseline: Option<usize>,
    /// Samples per pixel at which efficiencies are compared.
    pub spp: u32,
    /// Efficiency over the baseline's at `spp`.
    pub gains: Vec<Gain>,
    /// The squared error to be reached.
    pub target: f64,
}

impl Summary {
    /// Of scene `scene` of a plan. The baseline is `baseline` or, where that was not measured, the first series. The target is
    /// `target`, or what the best technique of the baseline's sampler has at the middle of the samples per pixel.
    #[must_use]
    pub fn new(plan: &Plan, rows: &Rows, scene: usize, baseline: Way, target: Option<f64>) -> Self {
        let mut series: Vec<Series> = Vec::new();
        let mut ways: Vec<Way> = Vec::new();
        for key in plan.keys.iter().filter(|k| k.scene == scene) {
            let way = Way { technique: key.technique, sampler: key.sampler };
            if !ways.contains(&way) {
                ways.push(way);
            }
        }
        // in the order of the techniques, as they are listed
        ways.sort_by_key(|w| (w.technique as usize, w.sampler as usize));
        for way in ways {
            let of_way = |k: &&Key| k.scene == scene && k.technique == way.technique && k.sampler == way.sampler;
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
        // the largest number of samples that most series have
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
        Self { scene, series, baseline, spp, gains, target: target.unwrap_or(middle) }
    }
}
