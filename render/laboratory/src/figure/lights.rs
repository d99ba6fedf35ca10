//! Figures of choices among lights: variance and time of many, growth with their number, what the importance of a node is worth, and the
//! choice between lamps, skies and suns.

use super::sheet::Svg;
use super::studio::{Finding, Studio};
use crate::attack::choice::{self, Choice, STAGES};
use crate::chart::pictures::heat;
use crate::chart::plot::{Bar, BarRow, Bars, Chart, Dot, Line, Scale};
use crate::cost::median;
use crate::many_lights::moments::{EXHAUSTIVE, METHODS, Moments, OWN, ratio};
use crate::many_lights::nodes::{Cell, DISTANCES, ELEVATIONS};
use crate::many_lights::scaling::{self, Size};
use crate::many_lights::stage::{Point, Stage};
use crate::many_lights::time::{TIMED, Times};
use std::error::Error;
use std::sync::atomic::Ordering;

/// Scenes of many lights, and the numbers of their points.
const SCENES: [(&str, u32); 3] = [("chandelier", 2048), ("city", 512), ("knot", 96)];
/// Blocks of 8 × 8 pixels whose samples are timed, and the rounds.
const BLOCKS: u32 = 96;
const ROUNDS: usize = 385;
/// Points that the camera sees, in the same figure.
const ENTROPIES: u32 = 64;
/// Samples per pixel in the figure of skies and lamps.
const SPP: u32 = 256;
/// Nodes of each scene in the figure of nodes.
const NODES: u32 = 1500;

/// Points without light do not count where errors are relative.
fn relative(moments: &[Moments], method: usize) -> impl Iterator<Item = (f64, f64)> + Clone {
    let lit = moments.iter().filter(|m| m.squared > 0.0 && m.variance[EXHAUSTIVE].is_finite());
    lit.map(move |m| (m.variance[method] / m.squared, m.variance[EXHAUSTIVE] / m.squared))
}

fn absolute(moments: &[Moments], [a, b]: [usize; 2]) -> (f64, f64) {
    ratio(moments.iter().map(|m| (m.variance[a], m.variance[b])))
}

fn account(stage: &Stage, moments: &[Moments], times: &[Times; TIMED.len()]) -> (Vec<String>, Bars) {
    let mut lines = vec![
        format!(
            "{}: {} lights, {} points; variances relative to exhaustive choice: of radiance (with 95 % interval), of radiance relative to \
             the true one, the median of the points; open: the variance without occlusion relative to the squared radiance",
            stage.name,
            stage.lights.len(),
            moments.len(),
        ),
        format!(
            "  {:15} {:>16} {:>9} {:>9} {:>9} | {:>8} {:>8} {:>8} {:>8} | {:>17} {:>6}",
            "",
            "radiance",
            "relative",
            "median",
            "open",
            "choose",
            "pmf",
            "sample",
            "shadow",
            "this tree's gain",
            "lost"
        ),
    ];
    let mut rows = Vec::new();
    for (method, (which, name)) in METHODS.iter().enumerate() {
        let (variance, half) = absolute(moments, [method, EXHAUSTIVE]);
        let (of_relative, _) = ratio(relative(moments, method));
        let middle = median(&relative(moments, method).map(|(a, b)| a / b).collect::<Vec<_>>());
        let (open, _) = ratio(moments.iter().map(|m| (m.open[method], m.open_squared)));
        let time = TIMED.iter().position(|timed| timed == which).map(|k| times[k]);
        let own = times[TIMED.len() - 1];
        let parts = time.map_or("       –        –        –        –".to_owned(), |t| {
            format!("{:8.1} {:8.1} {:8.1} {:8.1}", t.choose, t.pmf, t.sample, t.shadow)
        });
        let (gain, gain_half) = absolute(moments, [method, OWN]);
        let slower = time.map(|t| t.all() / own.all());
        let gain_text = slower.map_or(String::new(), |s| format!("{:.2} ± {:.2}", gain * s, gain_half * s));
        let lost: u64 = moments.iter().map(|m| m.lost[method]).sum();
        lines.push(format!(
            "  {name:15} {:>16} {of_relative:>9.2} {middle:>9.2} {open:>9.3} | {parts} | {gain_text:>17} {lost:>6}",
            format!("{variance:.2} ± {half:.2}")
        ));
        if let Some(slower) = slower {
            rows.push(BarRow {
                id: (*name).to_owned(),
                name: (*name).to_owned(),
                color: method,
                bar: Bar { value: 1.0 / (gain * slower), low: 1.0 / (gain * slower), high: 1.0 / (gain * slower) },
                sure: true,
                shown: true,
            });
        }
    }
    // where the excess over the exhaustive choice comes from
    let mut worst: Vec<&Moments> = moments.iter().collect();
    let excess = |m: &Moments| m.variance[OWN] - m.variance[EXHAUSTIVE];
    worst.sort_by(|a, b| excess(b).total_cmp(&excess(a)));
    let all: f64 = moments.iter().map(excess).sum();
    for m in worst.iter().take(3) {
        let light = &stage.bounds[m.culprit.light];
        let to: [f32; 3] = std::array::from_fn(|k| light.center[k] - m.point.p[k]);
        let along = |v: [f32; 3]| (0..3).map(|k| to[k] * v[k]).sum::<f32>();
        let distance = along(to).sqrt();
        lines.push(format!(
            "  {:.0} % of the excess at {:.3?}, normal {:.3?}: {:.2} × exhaustive; light {} has {:.0} % of the moment, pmf {:.2e} for \
             {:.2e}, distance {:.3} with radius {:.3}, cosines {:.3} and {:.3}",
            100.0 * excess(m) / all,
            m.point.p,
            m.point.n,
            m.variance[OWN] / m.variance[EXHAUSTIVE],
            m.culprit.light,
            100.0 * m.culprit.share,
            m.culprit.pmf,
            m.culprit.ideal,
            distance,
            light.radius,
            along(m.point.n) / distance,
            -along(light.normal) / distance,
        ));
    }
    let bars = Bars {
        title: format!("{}: {} lights", stage.name, stage.lights.len()),
        label: "1/(variance × time), relative to this tree".to_owned(),
        rows,
        origin: 1.0,
        unit: "×".to_owned(),
    };
    (lines, bars)
}

fn series(name: &str, color: usize, points: impl Iterator<Item = (f64, f64)>) -> Line {
    let dots = points.map(|(x, y)| Dot { x: Bar::exact(x), y: Bar::exact(y), sure: true }).collect();
    Line { id: name.to_owned(), name: name.to_owned(), color, dash: color, joined: true, shown: true, mark: 1.0, dots }
}

impl Studio<'_> {
    fn stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    pub(super) fn lights(&self) -> Result<Finding, Box<dyn Error>> {
        let mut headline = vec![
            "One sample of one light with a shadow ray, at diffuse surfaces that the camera sees; the moments are sums over all \
             lights. Times \
             are nanoseconds of a lane at f32x8, medians of alternating rounds on one thread; the gain is the ratio of variance × \
             (choose + sample + shadow); lost are lights that contribute although their pmf is 0."
                .to_owned(),
        ];
        let mut charts = Vec::new();
        for (name, points) in SCENES {
            if self.stopped() {
                break;
            }
            let stage = Stage::load(name)?;
            let blocks = stage.blocks(points, self.seed);
            let moments = stage.moments(&Point::of(&blocks), self.seed ^ 0x11647);
            let timed = &blocks[..blocks.len().min(BLOCKS as usize)];
            let times = stage.times(timed, self.seed ^ 0x71e, ROUNDS, |_| !self.stopped());
            let (lines, bars) = account(&stage, &moments, &times);
            headline.extend(lines);
            charts.push(Svg::chart(&bars.draw()));
        }
        let caption = "Further right is better. The published tree is that of Conty Estevez and Kulla (2018). Variance is that of one \
        sample of radiance, over random points that the camera sees, exact in the choice of the light.";
        Ok(Finding { svg: Svg::column(charts).captioned(&[caption.to_owned()]), headline })
    }

    pub(super) fn light_tree_scaling(&self) -> Finding {
        let mut headline = vec![
            "Windows on houses; seconds to build on one thread and on all; nanoseconds of a lane at f32x8; the published tree is \
             built on all threads."
                .to_owned(),
            format!(
                "{:>9} {:>8} {:>8} {:>12} {:>7} {:>7} {:>7} | {:>8} {:>12} {:>7} {:>7}",
                "lights", "1 thread", "all", "bytes", "levels", "choose", "pmf", "all", "bytes", "choose", "pmf"
            ),
        ];
        let mut sizes: Vec<Size> = Vec::new();
        for exponent in 2..=7 {
            let count = 10_u32.pow(exponent);
            if count as usize > self.most_lights || self.stopped() {
                break;
            }
            let size = scaling::measure(count, self.seed, exponent < 7);
            let other = size.published.map_or(String::new(), |p| {
                let [choose, pmf] = p.nanoseconds;
                format!("{:8.3} {:12} {choose:7.1} {pmf:7.1}", p.seconds, p.bytes)
            });
            let ([alone, together], [choose, pmf]) = (size.seconds, size.nanoseconds);
            headline.push(format!(
                "{:9} {alone:8.4} {together:8.4} {:12} {:7} {choose:7.1} {pmf:7.1} | {other}",
                size.lights, size.bytes, size.levels
            ));
            sizes.push(size);
        }
        let of = |name: &str, color: usize, y: &dyn Fn(&Size) -> Option<f64>| {
            series(name, color, sizes.iter().filter_map(|s| Some((f64::from(s.lights), y(s)?))))
        };
        let chart = Chart {
            title: "time of a choice and of a pmf".to_owned(),
            x_label: "lights".to_owned(),
            y_label: "nanoseconds of a lane".to_owned(),
            scales: [Scale::Log, Scale::Linear],
            lines: vec![
                of("choose, this tree", 0, &|s| Some(s.nanoseconds[0])),
                of("pmf, this tree", 1, &|s| Some(s.nanoseconds[1])),
                of("choose, published tree", 2, &|s| s.published.map(|p| p.nanoseconds[0])),
                of("pmf, published tree", 3, &|s| s.published.map(|p| p.nanoseconds[1])),
            ],
            guides: Vec::new(),
            equal: false,
        };
        Finding { svg: Svg::chart(&chart.draw()).captioned(&headline[..1]), headline }
    }

    pub(super) fn sky_and_lamp(&self) -> Result<Finding, Box<dyn Error>> {
        let mut headline = vec![format!(
            "Lamps beside skies and suns over floors of ±1 to ±10⁵: efficiency at {SPP} samples per pixel, which is squared radiance over \
             squared error and samples, of this choice, of an equal chance for lamps, sky and suns, and of one by power; and this choice \
             relative to the better of those."
        )];
        let mut charts = Vec::new();
        for stage in STAGES.into_iter().take_while(|_| !self.stopped()) {
            let mut found: Vec<(f64, Choice)> = Vec::new();
            for half in [1.0, 3.0, 10.0, 30.0, 100.0, 1e3, 1e4, 1e5] {
                let choice = choice::measure(&choice::stage(stage, half), [16, SPP], self.seed)?;
                found.extend(choice.map(|choice| (half, choice)));
            }
            let least = found.iter().map(|(_, choice)| choice.ratio()).fold(f64::INFINITY, f64::min);
            headline.push(format!("{}: at least {least:.2} of the better pure choice", stage.0));
            headline.extend(found.iter().map(|(half, Choice { own, equal, by_power })| {
                let ratio = own / equal.max(*by_power);
                format!("  ±{half:9.1} {own:11.3e} {equal:11.3e} {by_power:11.3e} {ratio:7.3}")
            }));
            let of = |name: &str, color: usize, y: fn(&Choice) -> f64| {
                series(name, color, found.iter().map(|(half, choice)| (*half, y(choice))))
            };
            let chart = Chart {
                title: stage.0.to_owned(),
                x_label: "half size of the floor".to_owned(),
                y_label: "1/(squared error × samples)".to_owned(),
                scales: [Scale::Log, Scale::Log],
                lines: vec![
                    of("this choice", 0, |choice| choice.own),
                    of("equal chances", 1, |choice| choice.equal),
                    of("by power", 2, |choice| choice.by_power),
                ],
                guides: Vec::new(),
                equal: false,
            };
            charts.push(Svg::chart(&chart.draw()));
        }
        let rows = charts.chunks(2).map(|pair| Svg::row(pair.to_vec())).collect();
        Ok(Finding { svg: Svg::column(rows).captioned(&headline[..1]), headline })
    }

    pub(super) fn light_tree_nodes(&self) -> Result<Finding, Box<dyn Error>> {
        let mut headline = vec![
            "Children of random nodes, seen from random points at a distance in units of the node's radius and an elevation of its \
             centre above \
             the horizon. Below: the published importance Φ cosθ'ᵢ cosθ'/d² is less than what the child contributes. Zero: a child that \
             contributes has no share. Variance: of a choice among the children, relative to the squared sum. Quantiles of share/true \
             share, weighted by the true share."
                .to_owned(),
        ];
        let mut rows = Vec::new();
        for (name, _) in SCENES {
            if self.stopped() {
                break;
            }
            let stage = Stage::load(name)?;
            let cells = stage.nodes(NODES, self.seed ^ 0x0de5);
            headline.push(format!(
                "{name:12} {:>8} {:>7} {:>5} {:>5} | {:>8} {:>8} | {:>7} {:>7} {:>7} | {:>7} {:>7} {:>7} {:>7}",
                "children",
                "below %",
                "zero",
                "zero",
                "var pub",
                "var own",
                "pub 1 %",
                "5 %",
                "50 %",
                "own 1 %",
                "5 %",
                "50 %",
                "least"
            ));
            let row = |label: String, cell: &Cell| {
                let [p1, p5, p50] = cell.quantiles(0, [0.01, 0.05, 0.5]);
                let [o1, o5, o50] = cell.quantiles(1, [0.01, 0.05, 0.5]);
                let least = cell.ratios[1].iter().map(|r| r.0).fold(f64::INFINITY, f64::min);
                format!(
                    "{label:12} {:8} {:7.2} {:5} {:5} | {:8.4} {:8.4} | {p1:7.3} {p5:7.3} {p50:7.3} | {o1:7.3} {o5:7.3} {o50:7.3} \
                     {least:7.4}",
                    cell.children,
                    100.0 * cell.below as f64 / cell.children as f64,
                    cell.zero[0],
                    cell.zero[1],
                    cell.variance(0),
                    cell.variance(1),
                )
            };
            let sum = |cells: Vec<&Cell>| {
                let mut all = Cell::default();
                cells.into_iter().for_each(|cell| all.merge(cell));
                all
            };
            for (d, distance) in DISTANCES.iter().enumerate() {
                headline.push(row(format!("  d = {distance}"), &sum(cells[d].iter().collect())));
            }
            for (e, elevation) in ELEVATIONS.iter().enumerate() {
                headline.push(row(format!("  {elevation}°"), &sum(cells.iter().map(|row| &row[e]).collect())));
            }
            let all = sum(cells.iter().flatten().collect());
            headline.push(row("  all".to_owned(), &all));
            if let Some(worst) = &all.worst {
                headline.push(format!(
                    "  worst: node {} slot {} of {} lights has {:.2e} for {:.2e}, from {:.4?} with normal {:.4?}",
                    worst.node[0],
                    worst.node[1],
                    worst.lights,
                    worst.shares[0],
                    worst.shares[1],
                    worst.point.p,
                    worst.point.n
                ));
            }
            let points = Point::of(&stage.blocks(ENTROPIES, self.seed));
            let entropy = stage.entropy(&points);
            let bits = |sums: &[f64]| sums.iter().map(|x| format!("{x:7.3}")).collect::<String>();
            headline.push(format!(
                "  bits lost at {} points that the camera sees, by level:{}; by the node's distance over its radius, 0.5 1 2 4 8 16 \
                 more:{}; nodes of lights only:{}",
                points.len(),
                bits(&entropy.levels),
                bits(&entropy.distances),
                bits(&[entropy.lowest])
            ));
            let map = |title: &str, of: &dyn Fn(&Cell) -> f64| {
                let size = [ELEVATIONS.len() as u32, DISTANCES.len() as u32];
                let pixels: Vec<[u8; 3]> = cells.iter().flatten().map(|cell| heat(of(cell))).collect();
                Svg::image(title, size, &pixels, 200.0)
            };
            // 10⁻³ is black, 10 is pale yellow
            let log = |x: f64| (x.max(1e-3).log10() + 3.0) / 4.0;
            rows.push(Svg::row(vec![
                map(&format!("{name}: bound too low"), &|c| c.below as f64 / c.children.max(1) as f64),
                map("variance, published", &|c| log(c.variance(0))),
                map("variance, this tree", &|c| log(c.variance(1))),
            ]));
        }
        let caption = format!(
            "Rows from top to bottom are distances {DISTANCES:?} in units of the node's radius, columns from left to right elevations \
             {ELEVATIONS:?} in degrees. Bound too low: the fraction of children whose published importance is less than what they \
             contribute, \
             black 0, pale yellow 1. Variances of a choice among the children relative to the squared sum, black 0.001 or less, pale \
             yellow 10 or more."
        );
        Ok(Finding { svg: Svg::column(rows).captioned(&[caption]), headline })
    }
}
