//! Fits linearly transformed cosines to the light that rough surfaces reflect, and writes the table of the core.
//!
//! `cargo run --release -p etendue-fit` prints how well each cell fits; with `-- --write` it also writes `core/src/reflection/table.rs`.

#![allow(clippy::disallowed_methods, reason = "the table is what counts, wherever it was computed")]

mod cosine;
mod lobe;

use cosine::Transform;
use lobe::{Ggx, Node};
use rayon::prelude::*;
use std::fmt::Write;
use std::process::ExitCode;

/// Rows and columns of the table.
const SIDE: usize = 16;
/// Rows and columns of each of both patterns of the quadrature.
const NODES: usize = 128;

/// The square root of the roughness of a row, and of the cosine to the normal of a column: a place in [0, 1], but for the first, which is a
/// fourth of a step.
fn root(place: f64) -> f64 {
    place.max(0.25 / (SIDE - 1) as f64)
}

/// The cosine of a view; at the normal itself the plane of incidence is unknown.
fn cosine(root: f64) -> f64 {
    (root * root).min(0.999_999)
}

/// What the table holds of a cell.
#[derive(Clone, Copy)]
struct Cell {
    transform: Transform,
    /// All reflected light, with a Fresnel factor of 1.
    albedo: f64,
    /// The mean of (1 − v·m)⁵ over that light.
    schlick: f64,
}

impl Cell {
    /// The fit for a place, from the one of a neighbour.
    fn fit(near: Transform, nodes: &[Node]) -> Self {
        let transform = near.fit(nodes);
        let sum = |of: fn(&Node) -> f64| nodes.iter().map(|n| n.solid_angle * n.reflected * of(n)).sum::<f64>();
        let albedo = sum(|_| 1.0);
        Self { transform, albedo, schlick: sum(|n| n.schlick) / albedo }
    }
    /// The numbers of the table: they vary slowly, and are known where the surface is a mirror: √cosθ, 1, 1, 1, (1 − cosθ)⁵.
    fn numbers(&self, alpha: f64, cos: f64) -> [f64; 5] {
        let Transform { a, b, c } = self.transform;
        let tan = (1.0 - cos * cos).sqrt() / cos;
        [(2.0 * alpha * a).sqrt().sqrt(), b / tan, 2.0 * alpha * c, self.albedo, self.schlick]
    }
    /// The inverse of [`numbers`](Self::numbers).
    fn of([a, b, c, albedo, schlick]: [f64; 5], alpha: f64, cos: f64) -> Self {
        let tan = (1.0 - cos * cos).sqrt() / cos;
        let transform = Transform { a: a.powi(4) / (2.0 * alpha), b: b * tan, c: c / (2.0 * alpha) };
        Self { transform, albedo, schlick }
    }
}

/// Between the four nearest cells, as the core interpolates.
fn between(table: &[Vec<[f64; 5]>], i: usize, j: usize) -> [f64; 5] {
    std::array::from_fn(|k| {
        [[i, j], [i + 1, j], [i, j + 1], [i + 1, j + 1]].map(|[i, j]| table[i][j][k]).iter().sum::<f64>() / 4.0
    })
}

fn print(name: &str, of: impl Fn(usize, usize) -> f64) {
    println!("\n{name}, by the roughness α (rows) and the cosine to the normal (columns)");
    let places: Vec<usize> = (0..SIDE - 1).collect();
    let middle = |k: usize| ((k as f64 + 0.5) / (SIDE - 1) as f64).powi(2);
    println!("        {}", places.iter().map(|&j| format!("{:7.4}", middle(j))).collect::<String>());
    for &i in &places {
        println!("{:7.4} {}", middle(i), places.iter().map(|&j| format!("{:7.3}", of(i, j))).collect::<String>());
    }
}

/// The source of the table.
fn source(table: &[Vec<[f64; 5]>]) -> String {
    let mut text = String::from(
        "//! Transforms of cosines into the light that rough surfaces reflect: `cargo run --release -p etendue-fit -- --write` writes this file.\n\n\
         /// Rows and columns.\npub(super) const SIDE: usize = 16;\n\n\
         /// By the square roots of roughness and of the cosine to the normal, which are a fourth of a step in the first row and column: the\n\
         /// fourth root of 2αa, b over the tangent of the angle to the normal, 2αc, the albedo, and the mean of (1 − v·m)⁵.\n\
         #[rustfmt::skip]\npub(super) const TABLE: [[[f32; 5]; SIDE]; SIDE] = [\n",
    );
    for row in table {
        text.push_str("    [\n");
        for cell in row {
            let numbers: Vec<String> = cell.iter().map(|&x| format!("{:?}", x as f32)).collect();
            writeln!(text, "        [{}],", numbers.join(", ")).expect("a string grows");
        }
        text.push_str("    ],\n");
    }
    text.push_str("];\n");
    text
}

fn main() -> ExitCode {
    let write = match std::env::args().nth(1).as_deref() {
        None => false,
        Some("--write") => true,
        Some(other) => {
            eprintln!("etendue-fit: unknown argument '{other}'; it takes --write or nothing");
            return ExitCode::from(2);
        }
    };
    let place = |k: usize| k as f64 / (SIDE - 1) as f64;
    // for each view, from rough to smooth: a neighbour is a good start
    let columns: Vec<Vec<[f64; 5]>> = (0..SIDE)
        .into_par_iter()
        .map(|j| {
            let cos = cosine(root(place(j)));
            let mut near = Transform { a: 1.0, b: 0.0, c: 1.0 };
            let mut column = vec![[0.0; 5]; SIDE];
            for i in (0..SIDE).rev() {
                let alpha = root(place(i)).powi(2);
                let cell = Cell::fit(near, &Ggx::new(alpha, cos).quadrature(NODES, 0.5));
                near = cell.transform;
                column[i] = cell.numbers(alpha, cos);
            }
            column
        })
        .collect();
    let table: Vec<Vec<[f64; 5]>> = (0..SIDE).map(|i| (0..SIDE).map(|j| columns[j][i]).collect()).collect();
    // halfway between the cells, where interpolation errs most
    let residuals: Vec<Vec<[f64; 4]>> = (0..SIDE - 1)
        .into_par_iter()
        .map(|i| {
            (0..SIDE - 1)
                .map(|j| {
                    let [alpha, cos] = [i, j].map(|k| ((k as f64 + 0.5) / (SIDE - 1) as f64).powi(2));
                    let nodes = Ggx::new(alpha, cos).quadrature(NODES, 0.25);
                    let cell = Cell::of(between(&table, i, j), alpha, cos);
                    let own = Cell::fit(cell.transform, &nodes);
                    let [residual, least] = [cell, own].map(|cell| cell.transform.residual(&nodes));
                    [residual.misplaced, residual.deviation, least.deviation, cell.albedo - own.albedo]
                })
                .collect()
        })
        .collect();
    print("light in the wrong place, as a part of all", |i, j| residuals[i][j][0]);
    print("standard deviation of f/g", |i, j| residuals[i][j][1]);
    print("standard deviation of f/g, with a fit for the place itself", |i, j| residuals[i][j][2]);
    print("error of the albedo", |i, j| residuals[i][j][3]);
    if write {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../core/src/reflection/table.rs");
        if let Err(error) = std::fs::write(path, source(&table)) {
            eprintln!("etendue-fit: {path}: {error}");
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}
