//! The figure of the choice between lamps, skies and suns, by how well it serves floors of any size.

use super::sheet::Svg;
use super::studio::{Finding, Studio};
use crate::attack::choice::{self, Choice, STAGES};
use crate::chart::plot::{Bar, Chart, Dot, Line, Scale};
use std::error::Error;
use std::sync::atomic::Ordering;

/// Samples per pixel.
const SPP: u32 = 256;

fn series(name: &str, color: usize, points: impl Iterator<Item = (f64, f64)>) -> Line {
    let dots = points.map(|(x, y)| Dot { x: Bar::exact(x), y: Bar::exact(y), sure: true }).collect();
    Line { id: name.to_owned(), name: name.to_owned(), color, dash: color, shown: true, dots }
}

impl Studio<'_> {
    pub(super) fn sky_and_lamp(&self) -> Result<Finding, Box<dyn Error>> {
        let mut headline = vec![format!(
            "Lamps beside skies and suns over floors of ±1 to ±10⁵: efficiency at {SPP} samples per pixel, which is squared radiance over \
             squared error and samples, of this choice, of an equal chance for lamps, sky and suns, and of one by power; and this choice \
             relative to the better of those."
        )];
        let mut charts = Vec::new();
        for stage in STAGES.into_iter().take_while(|_| !self.stop.load(Ordering::Relaxed)) {
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
            };
            charts.push(Svg::chart(&chart.draw()));
        }
        let rows = charts.chunks(2).map(|pair| Svg::row(pair.to_vec())).collect();
        Ok(Finding { svg: Svg::column(rows).captioned(&headline[..1]), headline })
    }
}
