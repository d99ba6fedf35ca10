//! Loop's subdivision of triangle meshes, whose vertices end on the limit surface, with its normals there (Loop 1987; Hoppe et al. 1994).

use crate::transform::{add, cross, scaled, sub};
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};
use std::hash::{BuildHasherDefault, Hasher};

/// Numbers by edges, whose ends are both in one word.
type Edges = HashMap<u64, usize, BuildHasherDefault<Mixed>>;

const fn edge(a: usize, b: usize) -> u64 {
    (a as u64) << 32 | b as u64
}

/// A quick hash of one word: there are millions of edges.
#[derive(Default)]
struct Mixed(u64);

impl Hasher for Mixed {
    fn write(&mut self, _: &[u8]) {}
    fn write_u64(&mut self, word: u64) {
        let h = (word ^ word >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        self.0 = h ^ h >> 32;
    }
    fn finish(&self) -> u64 {
        self.0
    }
}

/// A mesh of triangles.
pub(super) struct Control {
    pub(super) points: Vec<[f64; 3]>,
    pub(super) faces: Vec<[usize; 3]>,
}

/// The neighbours of a vertex in the order of its faces, from one boundary to the other if there are two.
struct Ring {
    around: Vec<usize>,
    is_boundary: bool,
}

impl Control {
    /// For each directed edge the third corner of its face; fails if two faces have the same one.
    fn edges(&self) -> Result<Edges, String> {
        let mut edges = Edges::with_capacity_and_hasher(3 * self.faces.len(), BuildHasherDefault::default());
        for [a, b, c] in &self.faces {
            for [from, to, other] in [[*a, *b, *c], [*b, *c, *a], [*c, *a, *b]] {
                if from == to || edges.insert(edge(from, to), other).is_some() {
                    return Err(format!("the edge from vertex {from} to {to} is not that of one face"));
                }
            }
        }
        Ok(edges)
    }
    fn rings(&self, edges: &Edges) -> Result<Vec<Ring>, String> {
        let mut starts: Vec<Option<usize>> = vec![None; self.points.len()];
        let mut counts = vec![0; self.points.len()];
        for key in edges.keys() {
            let [v, a] = [(key >> 32) as usize, *key as u32 as usize];
            counts[v] += 1;
            // the least one, so that the order of a table does not matter; a boundary before all others
            let key = |a: &usize| (edges.contains_key(&edge(*a, v)), *a);
            starts[v] = starts[v].into_iter().chain([a]).min_by_key(key);
        }
        let ring = |(v, start): (usize, Option<usize>)| {
            let Some(start) = start else { return Ok(Ring { around: Vec::new(), is_boundary: false }) };
            let mut around = vec![start];
            let next = |a: usize| edges.get(&edge(v, a)).copied();
            let mut last = start;
            while let Some(other) = next(last).filter(|other| *other != start) {
                around.push(other);
                last = other;
            }
            let is_boundary = next(last).is_none();
            let is_whole = around.len() - usize::from(is_boundary) == counts[v];
            is_whole
                .then_some(Ring { around, is_boundary })
                .ok_or_else(|| format!("surfaces touch in vertex {v} alone"))
        };
        starts.into_iter().enumerate().map(ring).collect()
    }
    /// Moves a vertex towards its neighbours: in the inside with these weights of each, at a boundary by `at_boundary` of both there.
    fn moved(&self, v: usize, ring: &Ring, each: impl Fn(f64) -> f64, at_boundary: f64) -> [f64; 3] {
        let (Ring { around, is_boundary }, own) = (ring, self.points[v]);
        let (of, weight) = match around[..] {
            [] => return own,
            [first, .., last] if *is_boundary => (vec![first, last], at_boundary),
            _ => (around.clone(), each(around.len() as f64)),
        };
        let sum = of.iter().fold([0.0; 3], |sum, k| add(sum, self.points[*k]));
        add(scaled(own, 1.0 - weight * of.len() as f64), scaled(sum, weight))
    }
    /// Divides each triangle into four.
    pub(super) fn divided(&self) -> Result<Self, String> {
        let edges = self.edges()?;
        let rings = self.rings(&edges)?;
        let mut points: Vec<_> =
            rings.iter().enumerate().map(|(v, ring)| self.moved(v, ring, towards, 0.125)).collect();
        let mut middles = Edges::default();
        let mut middle = |a: usize, b: usize| {
            *middles.entry(edge(a.min(b), a.max(b))).or_insert_with(|| {
                let ends = add(self.points[a], self.points[b]);
                points.push(match (edges.get(&edge(a, b)), edges.get(&edge(b, a))) {
                    (Some(c), Some(d)) => {
                        add(scaled(ends, 0.375), scaled(add(self.points[*c], self.points[*d]), 0.125))
                    }
                    _ => scaled(ends, 0.5),
                });
                points.len() - 1
            })
        };
        let mut faces = Vec::with_capacity(4 * self.faces.len());
        for &[a, b, c] in &self.faces {
            let [d, e, f] = [middle(a, b), middle(b, c), middle(c, a)];
            faces.extend([[a, d, f], [d, b, e], [f, e, c], [d, e, f]]);
        }
        Ok(Self { points, faces })
    }
    /// Moves the vertices to the limit surface, and returns its normals, of any length.
    pub(super) fn limit(&mut self) -> Result<Vec<[f64; 3]>, String> {
        let rings = self.rings(&self.edges()?)?;
        let limit = |n: f64| 1.0 / (n + 0.375 / towards(n));
        let all = rings.iter().enumerate();
        let (points, normals) =
            all.map(|(v, ring)| (self.moved(v, ring, limit, 1.0 / 6.0), self.normal(v, ring))).unzip();
        self.points = points;
        Ok(normals)
    }
    fn normal(&self, v: usize, Ring { around, is_boundary }: &Ring) -> [f64; 3] {
        let sum = |weight: &dyn Fn(usize) -> f64| {
            let of = around.iter().enumerate();
            of.fold([0.0; 3], |sum, (k, p)| add(sum, scaled(sub(self.points[*p], self.points[v]), weight(k))))
        };
        let n = around.len();
        if !is_boundary {
            let angle = |k: usize| TAU * k as f64 / n as f64;
            return cross(sum(&|k| libm::cos(angle(k))), sum(&|k| libm::sin(angle(k))));
        }
        let along = sum(&|k| f64::from(i8::from(k + 1 == n) - i8::from(k == 0)));
        let step = PI / (n - 1) as f64;
        let inwards = match n {
            2 => sum(&|_| 1.0),
            3 => sum(&|k| f64::from(u8::from(k == 1))),
            4 => sum(&|k| [-1.0, 2.0, 2.0, -1.0][k]),
            _ => {
                let sin = |k: usize| libm::sin(step * k as f64);
                let end = |k: usize| k == 0 || k + 1 == n;
                let least = 2.0 - 2.0 * libm::cos(step);
                sum(&|k| if end(k) { -libm::sin(step) } else { least * sin(k) })
            }
        };
        cross(inwards, along)
    }
}

/// The weight of each of `n` neighbours of a vertex.
fn towards(n: f64) -> f64 {
    if n == 3.0 { 0.1875 } else { 0.375 / n }
}
