//! Means over the grid of directions, and how far they may be off.

use super::definition::SIDE;

/// The mean of a function over the middles of the square's cells, and how far it may be off the function's mean over the square.
///
/// Four things are estimated, and three times their sum is allowed: maps about a corner or a centre begin with a square root, of which the
/// middles of cells of width h miss 0.061 √h³, where [`curved`] tells 0.028 √h³.
///
/// `seam` is the u₀ at which the grid goes over from one map to another one, if it does.
pub(super) fn mean(values: &[f64], seam: Option<f64>) -> (f64, f64) {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    (mean, 3.0 * (rough(values) + curved(values) + torn(values, seam) + cut(values)))
}

/// The difference between the means of every second cell, as on a chessboard: what changes from cell to cell is not resolved.
fn rough(values: &[f64]) -> f64 {
    let signed = values.iter().enumerate().map(|(i, v)| v * [1.0, -1.0][(i % SIDE + i / SIDE) % 2]);
    2.0 * signed.sum::<f64>().abs() / values.len() as f64
}

/// What the middles of cells of width h miss of a smooth function: h²/24 (f′(1) − f′(0)) along each side of the square, by Euler and Maclaurin.
fn curved(values: &[f64]) -> f64 {
    let along = |at: &dyn Fn(usize, usize) -> f64| -> f64 {
        let slope = |[a, b, c]: [f64; 3]| 3.0 * b - 2.0 * a - c;
        let ends =
            |line| slope([0, 1, 2].map(|i| at(i, line))) + slope([SIDE - 1, SIDE - 2, SIDE - 3].map(|i| at(i, line)));
        (0..SIDE).map(ends).sum::<f64>().abs()
    };
    let both = along(&|i, line| values[i + line * SIDE]) + along(&|i, line| values[line + i * SIDE]);
    both / 24.0 / values.len() as f64
}

/// Up to half of the step between both maps, in the column of cells that has both of them.
fn torn(values: &[f64], seam: Option<f64>) -> f64 {
    let Some(seam) = seam else { return 0.0 };
    let column = ((seam * SIDE as f64) as usize).clamp(1, SIDE - 2);
    let step = |row: usize| values[column + 1 + row * SIDE] - values[column - 1 + row * SIDE];
    0.5 * (0..SIDE).map(step).sum::<f64>().abs() / (SIDE * SIDE) as f64
}

/// What a horizon does that cuts the function.
///
/// The function is linear there, and changes by s from cell to cell. Of a cell that the horizon crosses, the middle tells either nothing or
/// all that it has there, which is off by up to s/8.
fn cut(values: &[f64]) -> f64 {
    let along = |at: &dyn Fn(usize, usize) -> f64| -> f64 {
        let step = |line: usize, dark: usize, lit: usize, next: usize| {
            let [dark, lit, next] = [dark, lit, next].map(|i| at(i, line));
            if dark == 0.0 && lit != 0.0 { (next - lit).abs() } else { 0.0 }
        };
        let steps = |line| (2..SIDE).map(|i| step(line, i - 2, i - 1, i) + step(line, i, i - 1, i - 2)).sum::<f64>();
        (0..SIDE).map(steps).sum()
    };
    let both = along(&|i, line| values[i + line * SIDE]) + along(&|i, line| values[line + i * SIDE]);
    0.125 * both / values.len() as f64
}

#[cfg(test)]
mod tests {
    use super::mean;
    use crate::area_lights::Measure;
    use crate::lights::definition::{Definition, SIDE};
    use crate::lights::figures::ERROR;
    use crate::lights::sampler::SHAPES;
    use crate::lights::scene::places;
    use etendue_oracle::{V3, dot, tier::cases};

    /// Cosines, whose means are known: the errors bound what is off, but for signs that cancel in them, and that is less than is allowed anyway.
    #[test]
    fn means_are_within_their_errors() {
        for (shape, name) in SHAPES {
            let (mut greatest, mut least_known) = (0.0_f64, 0.0_f64);
            for place in (0..cases(4, 40)).flat_map(|seed| places(shape, Measure::Other, true, seed)) {
                let seen = Definition::new(&place.light).expect("all shapes have a definition");
                let truth = seen.irradiance(seen.normal()) / seen.solid_angle;
                let cosine = |(w, weight): (&V3, f64)| dot(*w, seen.normal()).max(0.0) * weight;
                let values: Vec<f64> = seen.grid().iter().zip(seen.weights()).map(cosine).collect();
                if values.iter().filter(|v| **v > 0.0).count() < SIDE * SIDE / 4 {
                    continue;
                }
                let (mean, error) = mean(&values, seen.seam());
                greatest = greatest.max((mean - truth).abs() / error.max(ERROR * truth));
                least_known = least_known.max(error / truth);
            }
            println!("{name}: {greatest:.2} of what is allowed, which is up to {:.1} %", 100.0 * least_known);
            assert!(greatest <= 1.0 && least_known < 0.1, "{name}: {greatest}, {least_known}");
        }
    }
}
