//! Linearly transformed cosines that keep the horizon, and their fit to a lobe.

use crate::lobe::{Node, Vector};
use std::f64::consts::PI;

/// The transform (x, y, z) → (a (x + b z), c y, z) under which the reflected light becomes a cosine. Heights stay, so that the horizon
/// stays the horizon.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Transform {
    /// Stretch in the plane of incidence.
    pub(crate) a: f64,
    /// Shift along the plane of incidence, in units of the height.
    pub(crate) b: f64,
    /// Stretch across the plane of incidence.
    pub(crate) c: f64,
}

/// How well a transform fits, as parts of all light that the surface reflects.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Residual {
    /// Half of the integral of |f − g|: the light that is in the wrong place.
    pub(crate) misplaced: f64,
    /// √(∫(f − g)²/g): the standard deviation of f/g, which is the noise of a sample of the whole lobe.
    pub(crate) deviation: f64,
    /// The greatest f/g.
    pub(crate) greatest: f64,
}

impl Transform {
    /// The density of the transformed cosine, per steradian.
    pub(crate) fn density(&self, w: Vector) -> f64 {
        let [x, y, z] = [self.a * (w[0] + self.b * w[2]), self.c * w[1], w[2]];
        let square = x * x + y * y + z * z;
        z.max(0.0) * self.a * self.c / (PI * square * square)
    }
    fn numbers(self) -> [f64; 3] {
        [self.a.ln(), self.b, self.c.ln()]
    }
    fn of([a, b, c]: [f64; 3]) -> Self {
        Self { a: a.exp(), b, c: c.exp() }
    }
    /// What is left of the lobe beside this transform scaled to all of its light.
    pub(crate) fn residual(&self, nodes: &[Node]) -> Residual {
        let all: f64 = nodes.iter().map(|node| node.solid_angle * node.reflected).sum();
        let mut residual = Residual { misplaced: 0.0, deviation: 0.0, greatest: 0.0 };
        for node in nodes {
            let (f, g) = (node.reflected / all, self.density(node.direction));
            residual.misplaced += node.solid_angle * (f - g).abs() / 2.0;
            residual.deviation += node.solid_angle * (f - g) * (f - g) / g;
            residual.greatest = residual.greatest.max(f / g);
        }
        residual.deviation = residual.deviation.sqrt();
        residual
    }
    /// The nearest least of ∫(f − g)²/g from here: Levenberg and Marquardt's method, with derivatives by differences.
    pub(crate) fn fit(self, nodes: &[Node]) -> Self {
        let all: f64 = nodes.iter().map(|node| node.solid_angle * node.reflected).sum();
        let differences = |numbers: [f64; 3]| -> Vec<f64> {
            let transform = Self::of(numbers);
            let of = |node: &Node| {
                let g = transform.density(node.direction).max(1e-30).sqrt();
                node.solid_angle.sqrt() * (node.reflected / (all * g) - g)
            };
            nodes.iter().map(of).collect()
        };
        let sum = |d: &[f64]| d.iter().map(|x| x * x).sum::<f64>();
        let mut numbers = self.numbers();
        let mut here = differences(numbers);
        let (mut least, mut damping) = (sum(&here), 1e-3);
        for _ in 0..200 {
            let slopes = [0, 1, 2].map(|k| {
                let (mut moved, step) = (numbers, 1e-5);
                moved[k] += step;
                let there = differences(moved);
                here.iter().zip(there).map(|(a, b)| (b - a) / step).collect::<Vec<_>>()
            });
            let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let matrix = [0, 1, 2].map(|i| [0, 1, 2].map(|j| product(&slopes[i], &slopes[j])));
            let right = [0, 1, 2].map(|i| -product(&slopes[i], &here));
            let mut better = false;
            while damping < 1e12 {
                let mut damped = matrix;
                for (k, row) in damped.iter_mut().enumerate() {
                    row[k] *= 1.0 + damping;
                }
                let step = solve(damped, right);
                let next = [0, 1, 2].map(|k| numbers[k] + step[k]);
                let there = differences(next);
                let size = sum(&there);
                if size < least {
                    better = least - size > 1e-10 * least;
                    (numbers, here, least, damping) = (next, there, size, damping * 0.3);
                    break;
                }
                damping *= 4.0;
            }
            if !better {
                break;
            }
        }
        Self::of(numbers)
    }
}

/// Solves three linear equations by Cramer's rule.
fn solve(rows: [[f64; 3]; 3], right: [f64; 3]) -> [f64; 3] {
    let determinant = |m: [[f64; 3]; 3]| {
        let minor = |i: usize, j: usize| m[1][i] * m[2][j] - m[1][j] * m[2][i];
        m[0][0] * minor(1, 2) - m[0][1] * minor(0, 2) + m[0][2] * minor(0, 1)
    };
    let whole = determinant(rows);
    [0, 1, 2].map(|k| {
        let mut replaced = rows;
        for (row, value) in replaced.iter_mut().zip(right) {
            row[k] = value;
        }
        determinant(replaced) / whole
    })
}
