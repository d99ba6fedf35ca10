//! The figure of lobes: one square light on glossy surfaces, by every sampler.

use super::sheet::Svg;
use super::studio::Finding;
use crate::chart::pictures::heat;
use crate::lobes::cell::{COSINES, Cell, PLACES, ROUGHNESSES, SIZES};
use crate::lobes::moments::{METHODS, MIS, Moments, OF_LIGHT, REFLECTION, REST};
use crate::lobes::samples::Drawn;
use rayon::prelude::*;

/// Cells across and down a map.
const ACROSS: usize = COSINES.len() * SIZES.len();
const DOWN: usize = PLACES.len() * ROUGHNESSES.len();
/// Deviations below this are not worth a comparison.
const SMALL: f64 = 0.01;
/// Width of a map in pixels.
const WIDTH: f64 = 224.0;
/// Decades of the colours: from 10⁻³ to 10³.
const DECADES: i32 = 3;
/// The colour of each method where it has the least deviation.
const COLOURS: [[u8; 3]; METHODS.len()] =
    [[180, 180, 180], [120, 120, 120], [236, 150, 60], [132, 204, 110], [206, 52, 44], [34, 52, 120], [110, 170, 240]];

/// Three digits or more.
fn digits(x: f64) -> String {
    match x {
        0.0..0.99995 => format!("{x:.4}"),
        ..9.9995 => format!("{x:.3}"),
        ..999.95 => format!("{x:.1}"),
        _ => format!("{x:.1e}"),
    }
}

/// Where the light is, in words.
fn place(cell: &Cell) -> &'static str {
    PLACES.iter().find(|(place, _)| *place == cell.place).map_or("", |(_, name)| name)
}

fn text(cell: &Cell) -> String {
    format!("α {}, cosθ {}, {}, {}°", cell.alpha, cell.cos, place(cell), cell.size)
}

/// The method with the least deviation for as many samples.
fn least(moments: &Moments) -> usize {
    let of = |method: usize| moments.of_two_samples(method);
    (0..METHODS.len()).fold(0, |best, method| if of(method) < of(best) { method } else { best })
}

fn row(moments: &Moments) -> String {
    let Moments { cell, radiance, closed, deviations } = moments;
    format!(
        "{:>5} {:>5} {:8}{:>3} {radiance:>9.2e} {closed:>6.3} {}  {}",
        cell.alpha,
        cell.cos,
        place(cell),
        cell.size,
        deviations.map(|x| format!("{:>8}", digits(x))).concat(),
        METHODS[least(moments)]
    )
}

/// In how many cells of a place one method deviates more than another at as many samples, and not little, and where most.
fn failures(all: &[Moments], method: usize, others: &[usize]) -> Vec<String> {
    let mut lines = Vec::new();
    for (place, name) in PLACES {
        let here = all.iter().filter(|m| m.cell.place == place);
        let ratio = |m: &Moments| {
            let other = others.iter().map(|&k| m.of_two_samples(k)).fold(f64::INFINITY, f64::min);
            m.of_two_samples(method) / other
        };
        let count = here.clone().count();
        let worse = here.filter(|m| m.of_two_samples(method) > SMALL && ratio(m) > 1.0);
        let worst = worse.clone().max_by(|a, b| ratio(a).total_cmp(&ratio(b)));
        if let Some(worst) = worst {
            lines.push(format!(
                "  {name}: in {} of {count} cells, at worst {:.2} times as much, {} instead of {} ({})",
                worse.count(),
                ratio(worst),
                digits(worst.of_two_samples(method)),
                digits(worst.of_two_samples(method) / ratio(worst)),
                text(&worst.cell)
            ));
        } else {
            lines.push(format!("  {name}: in none of {count} cells"));
        }
    }
    lines
}

/// A map with a pixel for each cell.
fn map(title: &str, all: &[Moments], colour: impl Fn(&Moments) -> [u8; 3]) -> Svg {
    let mut pixels = vec![[0; 3]; ACROSS * DOWN];
    for (k, moments) in all.iter().enumerate() {
        // as in the list of cells: by roughness, then by cosine, place and size
        let [size, place] = [k % SIZES.len(), k / SIZES.len() % PLACES.len()];
        let k = k / (SIZES.len() * PLACES.len());
        let [cos, alpha] = [k % COSINES.len(), k / COSINES.len()];
        pixels[(place * ROUGHNESSES.len() + alpha) * ACROSS + cos * SIZES.len() + size] = colour(moments);
    }
    Svg::image(title, [ACROSS as u32, DOWN as u32], &pixels, WIDTH)
}

pub(super) fn lobes() -> Finding {
    let all: Vec<Moments> = Cell::all().par_iter().map(Moments::new).collect();
    // what the samplers draw has the mean of the quadrature
    let side = 128;
    let drawn = |m: &Moments| (Drawn::new(&m.cell, side).means[REFLECTION] / m.radiance - 1.0).abs();
    let off = all.par_iter().map(drawn).reduce(|| 0.0, f64::max);
    let mut headline = vec![
        "Standard deviation of one sample of what a GGX surface reflects of a square light, relative to that radiance, without occlusion. The \
         light's sides subtend so many degrees; its middle is in the mirror direction, atan(6α) beside it, or on the horizon. MIS takes two \
         samples, by solid angle and by BSDF; fit + rest is the closed form of the fit, and two such samples of what is left. Fit: the closed \
         form alone, relative to the radiance. Least: the one with the least deviation for as many samples."
            .to_owned(),
        format!(
            "{:>5} {:>5} {:8}{:>3} {:>9} {:>6} {}  least",
            "α",
            "cosθ",
            "light",
            "°",
            "radiance",
            "fit",
            ["area", "solid", "project", "BSDF", "MIS", "reflect", "fit+rest"].map(|name| format!("{name:>8}")).concat()
        ),
    ];
    headline.extend(all.iter().map(row));
    let summary = [
        vec![format!(
            "The means of {side}² stratified samples by reflection, in single precision, are within {:.2} % of the radiance in all cells.",
            100.0 * off
        )],
        vec![format!("A sample by reflection deviates by more than {SMALL}, and more than the best by area, solid angle or projected solid angle:")],
        failures(&all, REFLECTION, &OF_LIGHT[..3]),
        vec![format!("Samples by reflection deviate by more than {SMALL}, and more than as many of MIS:")],
        failures(&all, REFLECTION, &[MIS]),
        vec![format!("The fit and the rest deviate by more than {SMALL}, and more than MIS:")],
        failures(&all, REST, &[MIS]),
    ]
    .concat();
    headline.extend(summary.iter().cloned());
    let of = |x: f64| heat((libm::log10(x.max(1e-9)) / f64::from(DECADES) + 1.0) / 2.0);
    let mut maps: Vec<Svg> = (0..METHODS.len()).map(|k| map(METHODS[k], &all, |m| of(m.deviations[k]))).collect();
    maps.push(map("least for as many samples", &all, |m| COLOURS[least(m)]));
    let names: Vec<String> = (-DECADES..=DECADES).map(|k| format!("{}", 10.0_f64.powi(k))).collect();
    let scale: Vec<_> = names.iter().zip(-DECADES..).map(|(name, k)| (name.as_str(), of(10.0_f64.powi(k)))).collect();
    let methods: Vec<_> = METHODS.into_iter().zip(COLOURS).collect();
    let second = maps.split_off(maps.len() / 2);
    let list = |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
    let axes = format!(
        "{} From left to right, the view has the cosines {} to the normal, and for each the light subtends {} degrees. From top to bottom, the \
         light is in the mirror direction, beside it and on the horizon, and for each the roughness is {}.",
        headline[0],
        list(&COSINES),
        list(&SIZES),
        list(&ROUGHNESSES)
    );
    let rows = vec![Svg::row(maps), Svg::row(second), Svg::legend(&scale), Svg::legend(&methods)];
    Finding { svg: Svg::column(rows).captioned(&[vec![axes], summary].concat()), headline }
}
