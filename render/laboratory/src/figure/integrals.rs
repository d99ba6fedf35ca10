//! Figures of integrals with a variance in closed form.

use super::images::ratio_text;
use super::sheet::Svg;
use super::studio::Finding;
use crate::chart::charts::with_interval;
use crate::chart::pictures::heat;
use crate::chart::plot::{Bar, Chart, Dot, Line, Scale};
use crate::chart::stats::{self, Cost, Estimate, gain};
use etendue::sequence::{Independent, Sequence, Stratified};
use etendue::{Vec2, u32x8};

/// exp(−1000(x−¼)²), whose integral over [0, 1] is √(π/1000) to 10⁻²⁸.
fn bump(x: f64) -> f64 {
    (-1000.0 * (x - 0.25) * (x - 0.25)).exp()
}

/// A pdf that is `inside` between 0.15 and 0.35 and `outside` elsewhere.
#[derive(Clone, Copy)]
struct Steps {
    outside: f64,
    inside: f64,
}

impl Steps {
    fn pdf(self, x: f64) -> f64 {
        if (0.15..0.35).contains(&x) { self.inside } else { self.outside }
    }
    fn sample(self, u: f64) -> f64 {
        let (left, middle) = (0.15 * self.outside, 0.2 * self.inside);
        if u < left {
            u / self.outside
        } else if u < left + middle {
            0.15 + (u - left) / self.inside
        } else {
            0.35 + (u - left - middle) / self.outside
        }
    }
}

fn line(name: String, n: usize, points: impl Iterator<Item = (f64, Bar, bool)>, joined: bool) -> Line {
    let dots = points.map(|(x, y, sure)| Dot { x: Bar::exact(x), y, sure }).collect();
    Line { id: name.clone(), name, color: n, dash: n, joined, shown: true, mark: 1.0, dots }
}

/// A curve without dots.
fn curve(name: &str, n: usize, f: impl Fn(f64) -> f64) -> Line {
    let mut line =
        line(name.to_owned(), n, (0..=400).map(|i| f64::from(i) / 400.0).map(|x| (x, Bar::exact(f(x)), true)), true);
    line.mark = 0.0;
    line
}

pub(super) fn importance(seed: u64) -> Finding {
    const BATCHES: usize = 64;
    const SAMPLES: u32 = 65_536;
    let [good, bad] = [(0.1, 4.6), (1.2, 0.2)].map(|(outside, inside)| Steps { outside, inside });
    let sigma = 1.0 / 2000.0_f64.sqrt();
    let perfect = |x: f64| bump(x) / (sigma * std::f64::consts::TAU.sqrt());
    let integral = (std::f64::consts::PI / 1000.0).sqrt();
    let sequence = Independent::new(seed);
    // the variance of one sample in each batch
    let batches = |key: u32, estimate: &dyn Fn(Vec2<f64>) -> f64| -> Vec<f64> {
        (0..BATCHES as u32)
            .map(|batch| {
                let of = |i: u32| {
                    let u: Vec2<f64> = sequence.pair(batch, i, key);
                    (estimate(u) - integral).powi(2)
                };
                (0..SAMPLES).map(of).sum::<f64>() / f64::from(SAMPLES)
            })
            .collect()
    };
    let uniform = batches(0, &|u| bump(u.x));
    let by_steps = |key, p: Steps| {
        batches(key, &move |u| {
            let x = p.sample(u.x);
            bump(x) / p.pdf(x)
        })
    };
    let (like, unlike) = (by_steps(1, good), by_steps(2, bad));
    let exact = batches(3, &|u| {
        // a normal distribution, by Box and Muller's method
        let x = sigma.mul_add((-2.0 * (-u.x).ln_1p()).sqrt() * (std::f64::consts::TAU * u.y).cos(), 0.25);
        bump(x) / perfect(x)
    });
    let costs = |v: &[f64]| -> Vec<Cost> { v.iter().map(|&mse| Cost { mse, seconds: 1.0 }).collect() };
    let of = |v: &[f64]| Estimate::of(v);
    let known =
        |a: &[f64], b: &[f64]| gain(&costs(a), &costs(b)).unwrap_or(Estimate { value: f64::NAN, half: f64::NAN });
    let (better, worse) = (known(&like, &uniform), known(&uniform, &unlike));
    let shapes = Chart {
        title: "f(x) = exp(−1000(x−¼)²) and three pdfs".to_owned(),
        x_label: "x".to_owned(),
        y_label: "f and pdfs".to_owned(),
        scales: [Scale::Linear, Scale::Linear],
        lines: vec![
            curve("f", 8, bump),
            curve("0.1 | 4.6 | 0.1", 2, |x| good.pdf(x)),
            curve("1.2 | 0.2 | 1.2", 1, |x| bad.pdf(x)),
            curve("uniform", 0, |_| 1.0),
        ],
        guides: Vec::new(),
        equal: false,
    };
    // the variance of the mean of N samples, derived from that of one
    let errors = |name: &str, n: usize, v: &[f64]| {
        let e = of(v);
        let points = (0..=10).map(|k| f64::from(1 << k)).map(|count| {
            let scaled = Estimate { value: e.value / count, half: e.half / count };
            (count, Bar::from(scaled), true)
        });
        line(name.to_owned(), n, points, true)
    };
    let convergence = Chart {
        title: "variance of the mean of N samples".to_owned(),
        x_label: "N".to_owned(),
        y_label: "variance".to_owned(),
        scales: [Scale::Binary, Scale::Log],
        lines: vec![
            errors("1.2 | 0.2 | 1.2", 1, &unlike),
            errors("uniform", 0, &uniform),
            errors("0.1 | 4.6 | 0.1", 2, &like),
        ],
        guides: Vec::new(),
        equal: false,
    };
    let headline = vec![
        format!(
            "variance of a uniform sample {:.6} ± {:.6} (0.036492 in closed form)",
            of(&uniform).value,
            of(&uniform).half
        ),
        format!("pdf 0.1 | 4.6 | 0.1: variance lower by a factor of {} (6.67 in closed form)", ratio_text(&better)),
        format!("pdf 1.2 | 0.2 | 1.2: variance higher by a factor of {} (5.34 in closed form)", ratio_text(&worse)),
        format!("pdf proportional to f: variance {:.1e}, which is rounding error", of(&exact).value),
    ];
    let charts = Svg::row(vec![Svg::chart(&shapes.draw()), Svg::chart(&convergence.draw())]);
    Finding { svg: charts.captioned(&headline), headline }
}

/// Calls `each` with the points of a stratified or independent set.
fn points(sequence: &impl Sequence, replicate: u32, n: u32, mut each: impl FnMut(f64, f64)) {
    for start in (0..n).step_by(8) {
        let samples = u32x8::new(std::array::from_fn(|k| start + k as u32));
        let pair: Vec2<etendue::f32x8> = sequence.pair(u32x8::splat(replicate), samples, 0);
        let (x, y) = (pair.x.to_array(), pair.y.to_array());
        for k in 0..(n - start).min(8) as usize {
            each(f64::from(x[k]), f64::from(y[k]));
        }
    }
}

pub(super) fn stratification(seed: u64) -> Finding {
    /// An integrand minus its integral, as a function of x, y and a number that differs between replicates.
    type Integrand = fn(f64, f64, f64) -> f64;
    const EDGE: Integrand = |x, _, offset| f64::from(x < offset) - offset;
    const SMOOTH: Integrand = |x, _, _| x - 0.5;
    const COUNTS: [u32; 6] = [4, 16, 64, 256, 1024, 4096];
    const GROUPS: u32 = 8;
    const REPLICATES: u32 = 400;
    let offsets = Independent::new(seed ^ 0x0ff5e7);
    let measure = |f: Integrand, jittered: bool, key: u32| -> Vec<Vec<f64>> {
        (0..GROUPS)
            .map(|group| {
                COUNTS
                    .map(|n| {
                        // fewer replicates of larger sets, so that all take similar time
                        let replicates = (REPLICATES * 256 / n).clamp(REPLICATES / 2, 4 * REPLICATES);
                        let square = |r: u32| {
                            let id = (key * GROUPS + group) * 4 * REPLICATES + r;
                            let offset: Vec2<f64> = offsets.pair(id, n, 0);
                            let mut sum = 0.0;
                            let add = |x: f64, y: f64| sum += f(x, y, offset.x);
                            if jittered {
                                points(&Stratified::new(seed, n), id, n, add);
                            } else {
                                points(&Independent::new(seed), id, n, add);
                            }
                            (sum / f64::from(n)).powi(2)
                        };
                        (0..replicates).map(square).sum::<f64>() / f64::from(replicates)
                    })
                    .to_vec()
            })
            .collect()
    };
    let counts = COUNTS.map(f64::from);
    let rates = [
        // with the theoretical rates and constants
        ("edge, independent", EDGE, false, -1.0, ("1/6", 6.0)),
        ("edge, jittered", EDGE, true, -1.5, ("1/6", 6.0)),
        ("x, independent", SMOOTH, false, -1.0, ("1/12", 12.0)),
        ("x, jittered", SMOOTH, true, -2.0, ("1/12", 12.0)),
    ];
    let mut headline = Vec::new();
    let mut lines = Vec::new();
    for (i, (name, f, jittered, rate, (constant, divisor))) in rates.into_iter().enumerate() {
        let groups = measure(f, jittered, i as u32);
        let slope = stats::slope(&counts, &groups).unwrap_or(Estimate { value: f64::NAN, half: f64::NAN });
        let dots: Vec<_> = (0..COUNTS.len())
            .map(|k| {
                let e = Estimate::of(&groups.iter().map(|g| g[k]).collect::<Vec<_>>());
                (counts[k], Bar::from(e), e.is_sure())
            })
            .collect();
        let text = with_interval(&slope).replace('-', "−");
        let over: Vec<f64> = groups.iter().map(|g| g[3] * divisor / counts[3].powf(rate)).collect();
        let over = Estimate::of(&over);
        headline.push(format!(
            "{name}: slope {text}; at N = 256 {:.3} ± {:.3} of {constant}·N^{rate}",
            over.value, over.half
        ));
        lines.push(line(format!("{name} {text}"), i, dots.into_iter(), true));
    }
    let chart = Chart {
        title: "variance of the mean of N points of the unit square".to_owned(),
        x_label: "N".to_owned(),
        y_label: "variance".to_owned(),
        scales: [Scale::Binary, Scale::Log],
        lines,
        guides: vec![-1.0, -1.5, -2.0],
        equal: false,
    };
    let picture = |f: &dyn Fn(f64) -> f64| -> Vec<[u8; 3]> {
        (0..96 * 96).map(|i| heat(f((f64::from(i % 96) + 0.5) / 96.0))).collect()
    };
    let images = Svg::column(vec![
        Svg::image("an edge at a random position", [96, 96], &picture(&|x| f64::from(x < 0.63)), 190.0),
        Svg::image("x", [96, 96], &picture(&|x| x), 190.0),
    ]);
    Finding { svg: Svg::row(vec![Svg::chart(&chart.draw()), images]).captioned(&headline), headline }
}
