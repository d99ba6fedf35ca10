//! Rays per second for triangles and rays read from files, to compare with other programs on the same input.
//!
//! `cargo run --release -p etendue-benches --example trace -- TRIANGLES RAYS… [--repetitions 7] [--only obvhs,single,stream,groups] [--json FILE]`
//!
//! `trace --make FOLDER` writes such files for the scene `terrain`.
//!
//! The files hold little-endian f32: nine per triangle; eight per ray, which are the origin, the least distance (0), the unit direction and
//! the greatest distance. One thread traces the rays 64 at a time in file order. Each line gives the median, least and greatest speed of
//! the repetitions, the number of hits and, for closest hits, the sum of their distances. "single" traces ray by ray; "stream" traces 64
//! rays together; "groups" is what the renderer does: 64 rays as one frustum if that is narrow, else as a stream.

use etendue::Mask;
use etendue_render::bvh::{Bvh, GROUP, Hits, PrimitiveIds, Rays, Scratch, ShapeSet, Traversal};
use etendue_render::packet::{M8, V8, X8};
use etendue_routines::baseline::{self, Baseline};
use etendue_routines::rays::Workload;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

fn main() -> ExitCode {
    etendue_benches::exit_code(run())
}

/// Reads a file of numbers, `row` per row, all finite; in rows of 8, infinity is allowed too.
fn read(path: &str, row: usize) -> Result<Vec<f32>, String> {
    let bytes = std::fs::read(path).map_err(|e| format!("{path}: {e}"))?;
    if bytes.is_empty() || bytes.len() % (4 * row) != 0 {
        return Err(format!("{path}: {} bytes are not rows of {row} numbers of 4 bytes", bytes.len()));
    }
    let numbers: Vec<_> = bytes.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    match numbers.iter().position(|x| !(x.is_finite() || row == 8 && *x == f32::INFINITY)) {
        Some(i) => Err(format!("{path}: row {}, column {}: {} is not finite", i / row, i % row, numbers[i])),
        None => Ok(numbers),
    }
}

struct Ray {
    origin: [f32; 3],
    direction: [f32; 3],
    limit: f32,
}

fn read_rays(path: &str) -> Result<Vec<Ray>, String> {
    let rows = read(path, 8)?;
    let rays = rows.chunks_exact(8).enumerate().map(|(i, r)| {
        let direction = [r[4], r[5], r[6]];
        let length = direction.iter().map(|x| x * x).sum::<f32>().sqrt();
        if (length - 1.0).abs() > 1e-5 {
            return Err(format!("{path}: row {i}: a direction of length {length}, not 1"));
        }
        if r[3] != 0.0 {
            return Err(format!("{path}: row {i}: least distance {}, not 0", r[3]));
        }
        Ok(Ray { origin: [r[0], r[1], r[2]], direction, limit: r[7] })
    });
    rays.collect()
}

/// Eight rays, before the preparation for tracing.
#[derive(Clone, Copy)]
struct Packet {
    origin: V8,
    direction: V8,
    limit: X8,
    active: M8,
}

type Group = [Packet; GROUP];

fn groups(rays: &[Ray]) -> Vec<Group> {
    let group = |rays: &[Ray]| {
        std::array::from_fn(|p| {
            let at = |lane: usize| rays.get(8 * p + lane).unwrap_or(&rays[0]);
            let axis = |f: &dyn Fn(&Ray) -> f32| X8::from(std::array::from_fn(|lane| f(at(lane))));
            let point =
                |f: &dyn Fn(&Ray) -> [f32; 3]| V8::new(axis(&|r| f(r)[0]), axis(&|r| f(r)[1]), axis(&|r| f(r)[2]));
            let count = rays.len().saturating_sub(8 * p).min(8);
            Packet {
                origin: point(&|r| r.origin),
                direction: point(&|r| r.direction),
                limit: axis(&|r| r.limit),
                active: M8::from_bits((1 << count) - 1),
            }
        })
    };
    rays.chunks(8 * GROUP).map(group).collect()
}

/// The hits of one way of tracing.
#[derive(Clone, Copy, PartialEq)]
struct TracedHits {
    hits: u64,
    distances: f64,
}

fn closest(bvh: &Bvh, groups: &[Group], stack: &mut Scratch) -> TracedHits {
    let mut found = TracedHits { hits: 0, distances: 0.0 };
    for group in groups {
        let rays: [Rays; GROUP] = std::array::from_fn(|p| bvh.rays(group[p].origin, group[p].direction));
        let mut hits = group.map(|p| Hits::none(p.limit));
        bvh.closest(&rays, &group.map(|p| p.active), &mut hits, stack);
        for hits in &hits {
            let bits = hits.any().bits();
            found.hits += u64::from(bits.count_ones());
            let distances = hits.distance.as_array().iter().enumerate();
            found.distances += distances.filter(|(i, _)| bits >> i & 1 != 0).map(|(_, &d)| f64::from(d)).sum::<f64>();
        }
    }
    found
}

fn occluded(bvh: &Bvh, groups: &[Group], stack: &mut Scratch) -> TracedHits {
    let mut hits = 0;
    for group in groups {
        let rays: [Rays; GROUP] = std::array::from_fn(|p| bvh.rays(group[p].origin, group[p].direction));
        let before = group.map(|p| p.active);
        let mut open = before;
        bvh.occluded(&rays, &mut open, &group.map(|p| p.limit), &[PrimitiveIds::none(); GROUP], stack);
        hits += before.iter().zip(&open).map(|(b, o)| u64::from((b.bits() & !o.bits()).count_ones())).sum::<u64>();
    }
    TracedHits { hits, distances: 0.0 }
}

/// Median, least and greatest speed in million rays per second, and the hits.
fn measure(repetitions: usize, rays: usize, mut trace: impl FnMut() -> TracedHits) -> ([f64; 3], TracedHits) {
    let mut found = trace();
    let mut speeds: Vec<_> = (0..repetitions)
        .map(|_| {
            let start = Instant::now();
            found = trace();
            rays as f64 / start.elapsed().as_secs_f64() / 1e6
        })
        .collect();
    speeds.sort_by(f64::total_cmp);
    ([speeds[speeds.len() / 2], speeds[0], speeds[speeds.len() - 1]], found)
}

/// The scene that `--make` takes.
const MADE: &str = "terrain";

fn run() -> Result<(), String> {
    let mut files = Vec::new();
    let (mut repetitions, mut only, mut json) = (7, String::new(), None);
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{argument} needs a value"));
        match argument.as_str() {
            "--repetitions" => {
                let text = value()?;
                repetitions = text
                    .parse()
                    .ok()
                    .filter(|n| *n > 0)
                    .ok_or(format!("--repetitions {text}: not a positive integer"))?;
            }
            "--make" => {
                let folder = value()?;
                return Workload::new(MADE, 4096).write(MADE, Path::new(&folder)).map_err(|e| format!("{folder}: {e}"));
            }
            "--only" => only = value()?,
            "--json" => json = Some(value()?),
            _ if argument.starts_with("--") => return Err(format!("no option {argument}")),
            _ => files.push(argument),
        }
    }
    let [triangles, rays @ ..] = &files[..] else { return Err("usage: trace TRIANGLES RAYS…".to_owned()) };
    if rays.is_empty() {
        return Err("no ray file is given".to_owned());
    }
    let path = triangles;
    let triangles: Vec<[[f32; 3]; 3]> = read(path, 9)?
        .chunks_exact(9)
        .map(|t| std::array::from_fn(|v| std::array::from_fn(|k| t[3 * v + k])))
        .collect();
    let shapes = ShapeSet::none();
    let start = Instant::now();
    let mut bvh = Bvh::new(&triangles, shapes).map_err(|e| e.to_string())?;
    let build = start.elapsed().as_secs_f64();
    let per_triangle = bvh.bytes() as f64 / triangles.len() as f64;
    println!("{path}: {} triangles, built in {build:.3} s, {per_triangle:.1} bytes per triangle", triangles.len());
    let baseline = (only.is_empty() || only.contains("obvhs")).then(|| Baseline::new(&triangles));
    let mut stack = Scratch::default();
    let mut rows = Vec::new();
    for path in rays {
        let rays = read_rays(path)?;
        println!(
            "{path}: {} rays\n  {:22} {:>8}  {:>19}  {:>9}  sum of distances",
            rays.len(),
            "M rays/s",
            "median",
            "[least, greatest]",
            "hits"
        );
        let mut report = |name: &str, ([median, least, greatest], found): ([f64; 3], TracedHits)| {
            println!(
                "  {name:22} {median:8.3}  [{least:8.3} {greatest:8.3}]  {:9}  {:.9e}",
                found.hits, found.distances
            );
            rows.push(serde_json::json!({
                "rays": path, "what": name, "median": median, "least": least, "greatest": greatest,
                "hits": found.hits, "distances": found.distances,
            }));
        };
        if let Some(baseline) = &baseline {
            let rays: Vec<_> = rays.iter().map(|r| baseline::ray(r.origin, r.direction, r.limit)).collect();
            let all = || {
                let each = rays.iter().filter_map(|&r| baseline.closest(r));
                each.fold(TracedHits { hits: 0, distances: 0.0 }, |f, t| TracedHits {
                    hits: f.hits + 1,
                    distances: f.distances + f64::from(t),
                })
            };
            report("closest obvhs", measure(repetitions, rays.len(), all));
            let all =
                || TracedHits { hits: rays.iter().filter(|&&r| baseline.occluded(r)).count() as u64, distances: 0.0 };
            report("any obvhs", measure(repetitions, rays.len(), all));
        }
        let groups = groups(&rays);
        for (way, name) in [(Traversal::Single, "single"), (Traversal::Stream, "stream"), (Traversal::Choose, "groups")]
        {
            if !only.is_empty() && !only.contains(name) {
                continue;
            }
            bvh = bvh.with_traversal(way);
            let speed = measure(repetitions, rays.len(), || closest(&bvh, &groups, &mut stack));
            report(&format!("closest {name}"), speed);
            let speed = measure(repetitions, rays.len(), || occluded(&bvh, &groups, &mut stack));
            report(&format!("any {name}"), speed);
        }
    }
    if let Some(file) = json {
        let summary = serde_json::json!({ "triangles": triangles.len(), "build_seconds": build, "bytes_per_triangle": per_triangle, "rows": rows });
        std::fs::write(&file, format!("{summary:#}\n")).map_err(|e| format!("{file}: {e}"))?;
    }
    Ok(())
}
