//! The atlas: bounds on the errors that it finds in every technique.

use core::f64::consts::PI;
use etendue_atlas::methods;
use etendue_atlas::pose::{ShapeKind, Sweep, sweeps};
use etendue_atlas::survey::{Detail, Figures, LIMIT, survey};
use etendue_atlas::truth::Truth;
use etendue_judge::area_lights::AreaLight;
use etendue_oracle::tier::cases;
use etendue_oracle::{dot, length, wide};
use std::fs;
use std::path::Path;
use std::process::Command;

fn close(a: f64, b: f64, tolerance: f64, what: &str) {
    assert!((a / b - 1.0).abs() <= tolerance, "{what}: {a:e}, expected {b:e}, off by {:.1e}", a / b - 1.0);
}

/// The fraction of cells in which each technique keeps the contract must not fall.
#[test]
fn cells_within_the_contract() {
    let detail = Detail { turns: 1, samples: cases(4, 16), strata: 4, quick: true };
    let charts = survey(ShapeKind::all(), detail, || ());
    let is_ours = |(name, ours): &(String, bool)| *ours && !name.ends_with("Area");
    for summary in etendue_atlas::page::summary(&charts) {
        let (kind, name) = (summary.kind, &summary.method.0);
        let part = summary.cells[0] as f64 / summary.cells[2] as f64;
        println!("{:24} {name:36} {part:.3}", kind.name());
        let least = LEAST.iter().find(|l| l.0 == kind).map(|l| l.1).expect("each kind has a limit");
        assert!(!is_ours(&summary.method) || part >= least, "{name} keeps the contract in only {part:.3} of the cells");
        let is_baseline = !summary.method.1;
        assert!(!is_baseline || part < 0.75, "{}: the textbook {name} is too good: {part:.3}", kind.name());
    }
    for &(kind, direction, pdf, bias) in &MOST {
        let charts = charts.iter().filter(|c| c.kind == kind && is_ours(&c.method));
        for cell in charts.flat_map(|c| &c.cells) {
            let within = |x: f64, most: f64| x.is_nan() || x <= most;
            let all = within(cell.direction, direction) && within(cell.pdf, pdf) && within(cell.bias, bias);
            assert!(all, "{}: {cell:?}", kind.name());
        }
    }
    let (mut inside, mut caps) = (0, 0);
    for chart in charts.iter().filter(|c| is_ours(&c.method)) {
        let (kind, sweep) = (chart.kind, &chart.sweep);
        for (i, cell) in chart.cells.iter().enumerate() {
            let (x, y) = (sweep.x[i % sweep.x.len()].value, sweep.y[i / sweep.x.len()].value);
            if kind == ShapeKind::ProjectedSphere {
                caps += 1;
                cap_within_domain(sweep, [x, y], cell);
            }
            if flat(kind) && within_domain(kind, sweep.name, x, y.abs()) {
                inside += 1;
                // cosines of specks on the horizon are below the rounding of directions
                let unbiased = cell.bias.is_nan() || cell.bias <= LIMIT || (sweep.name == "size-horizon" && x <= 1e-5);
                assert!(cell.meets() && unbiased, "{} {}: {x:e} {y:e} {cell:?}", kind.name(), sweep.name);
            }
        }
    }
    assert!(inside > 3000 && caps > 1000, "{inside} {caps}");
}
/// Also where a light is nearly a hemisphere, and where the horizon leaves slivers of it, the u of a direction leads back to it.
#[test]
fn inverses_lead_back() {
    use ShapeKind::{Polygon, ProjectedParallelogram, ProjectedPolygon, ProjectedTriangle};
    for kind in [Polygon, ProjectedTriangle, ProjectedParallelogram, ProjectedPolygon] {
        let charts = survey(&[kind], Detail::new(true), || ());
        let cells = charts.iter().filter(|c| c.method.1 && !c.method.0.ends_with("Area")).flat_map(|c| &c.cells);
        let greatest = cells.map(|cell| cell.round_trip).fold(0.0, f64::max);
        println!("{:24} {greatest:.1e}", kind.name());
        assert!(greatest < 0.03, "{}: {greatest}", kind.name());
    }
}
/// Projected spheres keep the contract in every cell, except for the inverse where the axis is within 4e−7 of the horizon, and are unbiased
/// if they rise above it by more than 1e−6, as the documentation states.
fn cap_within_domain(sweep: &Sweep, [x, y]: [f64; 2], cell: &Figures) {
    let sine = if sweep.name == "size-horizon" { x * y } else { y };
    let forward = Figures { round_trip: f64::NAN, ..*cell };
    let held = if sine.abs() > 4e-7 { cell.meets() } else { forward.meets() };
    assert!(held, "ProjectedCap {}: {x:e} {y:e} {cell:?}", sweep.name);
    // the pose whose bias is measured: rounding moves small spheres by more than their size
    let pose = sweep.pose(ShapeKind::ProjectedSphere, x, y, 1);
    let (c, n, radius) = (wide(pose.a), wide(pose.n), pose.radius);
    let elevation = (dot(c, n) / (length(c) * length(n))).clamp(-1.0, 1.0).asin();
    let rise = elevation + (f64::from(radius) / length(c)).min(1.0).asin();
    assert!(
        cell.bias.is_nan() || cell.bias <= LIMIT || rise <= 1e-6,
        "ProjectedCap {}: {x:e} {y:e} {cell:?}",
        sweep.name
    );
}
fn flat(kind: ShapeKind) -> bool {
    use ShapeKind::*;
    matches!(
        kind,
        Triangle | Parallelogram | Rectangle | Polygon | ProjectedTriangle | ProjectedParallelogram | ProjectedPolygon
    )
}
/// The domain in which flat shapes keep the contract in every cell, as the documentation states it.
fn within_domain(kind: ShapeKind, sweep: &str, x: f64, y: f64) -> bool {
    let above = |nearest: f64| !(x >= 10.0 && y / x <= nearest);
    match (kind.projected(), sweep) {
        // within rounding of the plane of a shape that surrounds the point; specks edge-on
        (false, "size-elevation") => above(1e-12) && !(x <= 1e-5 && y <= 1e-7),
        // beside edges a million times longer than the shape is wide
        (false, _) => !(x >= 1e5 && y <= 1e-6),
        (true, "size-elevation") => above(1e-2) && !(x <= 1e-5 && y <= 1e-5),
        // a fan with an edge next to the zenith
        (true, "size-horizon") => kind == ShapeKind::ProjectedTriangle || x < 0.1,
        _ => true,
    }
}
/// Bounds on the errors of direction, pdf and irradiance in every cell, for the techniques that have them.
const MOST: [(ShapeKind, f64, f64, f64); 4] = [
    (ShapeKind::Sphere, 1e-5, 5e-7, 1e-6),
    (ShapeKind::Triangle, 2e-5, 1e-4, 1e-4),
    (ShapeKind::Parallelogram, 1e-5, 1e-6, 2e-6),
    (ShapeKind::Disk, 1e-5, 1e-6, 1e-6),
];
/// The least part of the cells in which the library's technique keeps the contract.
const LEAST: [(ShapeKind, f64); 10] = [
    (ShapeKind::Sphere, 1.0),
    (ShapeKind::ProjectedSphere, 1.0),
    (ShapeKind::Triangle, 0.99),
    (ShapeKind::Parallelogram, 0.99),
    (ShapeKind::Rectangle, 0.99),
    (ShapeKind::Polygon, 0.99),
    (ShapeKind::Disk, 1.0),
    (ShapeKind::ProjectedTriangle, 0.97),
    (ShapeKind::ProjectedParallelogram, 0.96),
    (ShapeKind::ProjectedPolygon, 0.97),
];

/// A shape without size has measure 0, and a sphere around the viewpoint covers all directions.
#[test]
fn degenerate() {
    let pose = sweeps(ShapeKind::Sphere, true)[0].pose(ShapeKind::Sphere, 0.5, 0.5, 0);
    let measure = |kind, radius| Truth::new(kind, &AreaLight { radius, ..pose }).map(|truth| truth.measure);
    assert_eq!(measure(ShapeKind::Sphere, 0.0), Some(0.0));
    close(measure(ShapeKind::Sphere, 2.0).unwrap(), 4.0 * PI, 1e-15, "inside");
    close(measure(ShapeKind::ProjectedSphere, 2.0).unwrap(), PI, 1e-15, "inside, projected");
    assert_eq!(methods::methods(ShapeKind::Sphere).len(), 4);
}

/// Runs the program in a folder: its exit code, what it says and its message.
fn run(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let program =
        Command::new(env!("CARGO_BIN_EXE_etendue-atlas")).current_dir(folder).args(arguments).output().unwrap();
    let [said, error] = [program.stdout, program.stderr].map(|text| String::from_utf8(text).unwrap());
    (program.status.code(), said, error)
}
#[test]
fn the_program_maps_one_shape_and_names_mistakes() {
    let folder = std::env::temp_dir().join(format!("etendue-atlas-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let (code, said, error) = run(&folder, &["--quick", "--shape", "sphere", "-o", "maps"]);
    assert!(code == Some(0) && error.is_empty(), "{error}");
    assert!(said.contains("sphere by SolidAngle") && said.ends_with("atlas.html\n"), "{said}");
    let mut names: Vec<_> = fs::read_dir(folder.join("maps")).unwrap().map(|e| e.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["atlas.csv", "atlas.html", "sphere-size-elevation.svg", "sphere-size-horizon.svg"]);
    let page = fs::read_to_string(folder.join("maps/atlas.html")).unwrap();
    assert!(page.contains("cone, series below 1.5°") && page.contains("<svg"));
    // each cell of each map tells its value to whoever points at it
    for map in page.split("<svg data-x=\"").skip(1) {
        let attribute =
            |name: &str| map.split(&format!("{name}=\"")).nth(1).unwrap().split('"').next().unwrap().split(',').count();
        let cells = map.split('"').next().unwrap().split(',').count() * attribute("data-y");
        assert_eq!(attribute("data-cells"), cells);
    }
    assert!(["{{", ">NaN", "\"NaN"].iter().all(|gap| !page.contains(gap)), "a placeholder or value is missing");
    let mut table = csv::Reader::from_path(folder.join("maps/atlas.csv")).unwrap();
    let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
    // every cell of four techniques; ours is within the contract in all cells
    assert!(rows.len().is_multiple_of(4) && rows.len() > 600, "{}", rows.len());
    let ours = |r: &&csv::StringRecord| &r[2] == "sphere by SolidAngle";
    let last = table.headers().unwrap().len() - 1;
    assert!(rows.iter().filter(ours).all(|r| &r[last] == "true"));
    assert!(rows.iter().filter(|r| !ours(r)).any(|r| &r[last] == "false"));

    let (code, _, error) = run(&folder, &["--shape", "torus", "-o", "other"]);
    assert!(code == Some(2) && error.contains("torus") && error.contains("projected-sphere"), "{error}");
    let (code, _, error) = run(&folder, &["--threads", "-1"]);
    assert!(code == Some(2) && error.contains("-1"), "{error}");
    fs::write(folder.join("taken"), "a file").unwrap();
    let (code, _, error) = run(&folder, &["--quick", "--shape", "sphere", "-o", "taken"]);
    assert!(code == Some(2) && error.contains("taken: cannot make this folder"), "{error}");
    assert_eq!(fs::read_to_string(folder.join("taken")).unwrap(), "a file");
    assert!(!folder.join("other").exists());
    fs::remove_dir_all(&folder).unwrap();
}
