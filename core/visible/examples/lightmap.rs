//! A host that is no renderer: bakes the light of two panels in a furnished room into lightmaps, with shapes and a tree of its own.
//!
//! For each square of 8 × 8 texels and each light it asks what hides the light, smaller squares where that is not proved, and traces rays
//! only for texels of which nothing is. `cargo run --release --example lightmap` prints what that saves against rays alone.

use etendue::Vec3;
use etendue_visible::{Light, Occluder, Patch, Proof, Prover, Region, Solid};
use std::time::Instant;

type V = Vec3<f64>;
const TEXELS: usize = 96; // along the sides of a wall
const SQUARE: usize = 8; // texels along the sides of a square that is asked about first
const RAYS: usize = 16; // from a texel, along the sides of a light

/// A shape of the room.
enum Shape {
    Quad(V, [V; 2]), // a corner and two edges; it faces (first × second)
    Block(V, V),     // two corners
    Ball(V, f64),    // a centre and a radius
}

impl Shape {
    fn bounds(&self) -> [V; 2] {
        match *self {
            Self::Quad(p, [u, v]) => [p + u, p + v, p + u + v].into_iter().fold([p, p], |all, p| joined(all, [p, p])),
            Self::Block(low, high) => [low, high],
            Self::Ball(center, r) => [center - V::new(r, r, r), center + V::new(r, r, r)],
        }
    }
    fn solid(&self) -> Solid {
        match *self {
            Self::Quad(corner, edges) => Solid::Parallelogram { corner, edges },
            Self::Block(low, high) => Solid::block(low, high).expect("blocks have volumes"),
            Self::Ball(center, radius) => Solid::Sphere { center, radius },
        }
    }
    /// Whether the segment from p to p + d meets it.
    fn hides(&self, p: V, d: V) -> bool {
        match *self {
            Self::Quad(corner, [u, v]) => {
                let (n, to) = (u.cross(v), p - corner);
                let t = -n.dot(to) / n.dot(d);
                let at = to + d * t;
                let inside = |x: f64, edge: V| x >= 0.0 && x <= edge.length_squared();
                t > 1e-9 && t < 1.0 - 1e-6 && inside(at.dot(u), u) && inside(at.dot(v), v)
            }
            Self::Block(low, high) => meets_box([low, high], p, d),
            Self::Ball(center, radius) => {
                let to = p - center;
                let (a, b, c) = (d.length_squared(), d.dot(to), to.length_squared() - radius * radius);
                let root = b * b - a * c;
                let t = (-b - root.max(0.0).sqrt()) / a;
                root > 0.0 && t > 1e-9 && t < 1.0
            }
        }
    }
}

/// The box around two boxes.
fn joined([a, b]: [V; 2], [c, d]: [V; 2]) -> [V; 2] {
    [V::new(a.x.min(c.x), a.y.min(c.y), a.z.min(c.z)), V::new(b.x.max(d.x), b.y.max(d.y), b.z.max(d.z))]
}

/// Whether the segment from p to p + d meets a box, or is inside.
fn meets_box([low, high]: [V; 2], p: V, d: V) -> bool {
    let (mut enters, mut leaves) = (1e-9_f64, 1.0_f64);
    for (low, high, p, d) in [(low.x, high.x, p.x, d.x), (low.y, high.y, p.y, d.y), (low.z, high.z, p.z, d.z)] {
        let (a, b) = ((low - p) / d, (high - p) / d);
        (enters, leaves) = (enters.max(a.min(b)), leaves.min(a.max(b)));
    }
    enters <= leaves
}

/// A tree of boxes over the shapes.
enum Tree {
    Leaf(usize),
    Node([V; 2], Box<[Self; 2]>),
}

impl Tree {
    fn new(shapes: &[Shape], mut ids: Vec<usize>) -> Self {
        if let [id] = ids[..] {
            return Self::Leaf(id);
        }
        let all = ids.iter().map(|&id| shapes[id].bounds()).reduce(joined).expect("some shapes");
        let size = all[1] - all[0];
        let middle = |id: &usize| {
            let [low, high] = shapes[*id].bounds();
            let V { x, y, z } = low + high;
            if size.x >= size.y.max(size.z) {
                x
            } else if size.y >= size.z {
                y
            } else {
                z
            }
        };
        ids.sort_by(|a, b| middle(a).total_cmp(&middle(b)));
        let rest = ids.split_off(ids.len() / 2);
        Self::Node(all, Box::new([Self::new(shapes, ids), Self::new(shapes, rest)]))
    }
    /// Whether anything but one shape hides p + d from p.
    fn hides(&self, shapes: &[Shape], p: V, d: V, but: usize) -> bool {
        match self {
            Self::Leaf(id) => *id != but && shapes[*id].hides(p, d),
            Self::Node(bounds, children) => {
                meets_box(*bounds, p, d) && children.iter().any(|child| child.hides(shapes, p, d, but))
            }
        }
    }
    /// Calls `found` with all that may meet a region, until it returns false.
    fn visit(&self, region: Region<'_>, found: &mut dyn FnMut(usize) -> bool) -> bool {
        match self {
            Self::Leaf(id) => found(*id),
            Self::Node([low, high], children) => {
                region.misses_box(*low, *high) || children.iter().all(|child| child.visit(region, found))
            }
        }
    }
}

struct Room {
    shapes: Vec<Shape>,
    solids: Vec<Solid>,
    tree: Tree,
    lights: Vec<(usize, Light)>, // the shapes that emit, with a radiance of 1
}

/// Texels of one wall.
struct Lightmap<'a> {
    room: &'a Room,
    wall: usize,
    corner: V,
    edges: [V; 2],
    normal: V,
}

impl Room {
    fn new() -> Self {
        let quad = |p: [f64; 3], u: [f64; 3], w: [f64; 3]| Shape::Quad(V::lit(p), [V::lit(u), V::lit(w)]);
        let block = |low: [f64; 3], high: [f64; 3]| Shape::Block(V::lit(low), V::lit(high));
        // floor, ceiling and four walls, which face the inside: 6 m × 3 m × 5 m
        let [x, y, z] = [[6.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 5.0]];
        let mut shapes = vec![quad([0.0; 3], z, x), quad(y, x, z), quad([0.0; 3], y, z)];
        shapes.extend([quad(x, z, y), quad([0.0; 3], x, y), quad(z, y, x)]);
        // two panels under the ceiling, which face down
        let panels = [1.4, 4.1].map(|x| quad([x, 2.9, 2.0], [0.6, 0.0, 0.0], [0.0, 0.0, 1.2]));
        let light = |(panel, id): (&Shape, usize)| (id, Light::new(panel.solid(), false).expect("panels have areas"));
        let lights = panels.iter().zip(shapes.len()..).map(light).collect();
        shapes.extend(panels);
        // a table with four chairs, a cupboard, shelves on a wall, and two globes; feet are in the floor
        shapes.push(block([2.2, 0.7, 1.9], [3.8, 0.75, 3.1]));
        for (x, z) in [(2.3, 2.0), (3.65, 2.0), (2.3, 2.95), (3.65, 2.95)] {
            shapes.push(block([x, -0.1, z], [x + 0.06, 0.7, z + 0.06]));
        }
        for (x, z, back) in [(2.5, 1.5, 1.5), (3.2, 1.5, 1.5), (2.5, 3.2, 3.55), (3.2, 3.2, 3.55)] {
            shapes.push(block([x, -0.1, z], [x + 0.4, 0.45, z + 0.4]));
            shapes.push(block([x, 0.45, back], [x + 0.4, 0.9, back + 0.04]));
        }
        shapes.push(block([5.3, -0.1, 0.5], [5.9, 2.0, 1.9]));
        shapes.extend([1.0, 1.4, 1.8].map(|y| block([0.05, y, 1.0], [0.3, y + 0.03, 4.0])));
        shapes.extend([2.6, 3.3].map(|x| Shape::Ball(V::new(x, 1.0, 2.5), 0.15)));
        let tree = Tree::new(&shapes, (0..shapes.len()).collect());
        let solids = shapes.iter().map(Shape::solid).collect();
        Self { shapes, solids, tree, lights }
    }
    fn map(&self, wall: usize) -> Lightmap<'_> {
        let Shape::Quad(corner, edges) = self.shapes[wall] else { unreachable!("walls are flat") };
        Lightmap { room: self, wall, corner, edges, normal: edges[0].cross(edges[1]).normalize() }
    }
}

impl Lightmap<'_> {
    fn at(&self, x: f64, y: f64) -> V {
        self.corner + self.edges[0] * (x / TEXELS as f64) + self.edges[1] * (y / TEXELS as f64)
    }
    /// The irradiance of a point by rays to `rays` × `rays` points of a light.
    fn sampled(&self, p: V, (id, _): &(usize, Light), rays: usize) -> f64 {
        let Room { shapes, tree, .. } = self.room;
        let Shape::Quad(corner, [u, v]) = shapes[*id] else { unreachable!("panels are flat") };
        let (area, step) = (u.cross(v), 1.0 / rays as f64);
        let point = |k: usize| {
            let [s, t] = [k % rays, k / rays].map(|i| (i as f64 + 0.5) * step);
            let d = corner + u * s + v * t - p;
            let (cos, emits, square) = (self.normal.dot(d), -area.dot(d), d.length_squared());
            let lit = cos > 0.0 && emits > 0.0 && !tree.hides(shapes, p, d, *id);
            if lit { cos * emits / (square * square) } else { 0.0 }
        };
        (0..rays * rays).map(point).sum::<f64>() * step * step
    }
    fn by_rays(&self, k: usize, rays: usize) -> f64 {
        let p = self.at((k % TEXELS) as f64 + 0.5, (k / TEXELS) as f64 + 0.5);
        self.room.lights.iter().map(|light| self.sampled(p, light, rays)).sum()
    }
    /// Adds the light of `size` × `size` texels from [x, y]. Returns the number of texels from which rays were traced.
    fn bake(&self, prover: &mut Prover, light: &(usize, Light), [x, y, size]: [usize; 3], texels: &mut [f64]) -> usize {
        let Room { solids, tree, .. } = self.room;
        let corners =
            [[0, 0], [size, 0], [size, size], [0, size]].map(|[i, j]| self.at((x + i) as f64, (y + j) as f64));
        let patch = Patch::polygon(&corners, 1e-9, 0.0).expect("texels have areas");
        let mut seen = prover.prove(&patch, &light.1, |region, found| {
            let own = [self.wall, light.0];
            tree.visit(region, &mut |id| own.contains(&id) || found(Occluder::Whole(solids[id].clone())))
        });
        if size > 1 && seen.proof == Proof::Open {
            let half = size / 2;
            let parts = [[x, y], [x + half, y], [x, y + half], [x + half, y + half]];
            return parts.map(|[x, y]| self.bake(prover, light, [x, y, half], texels)).iter().sum();
        }
        let mut traced = 0;
        for [x, y] in (0..size * size).map(|k| [x + k % size, y + k / size]) {
            let p = self.at(x as f64 + 0.5, y as f64 + 0.5);
            let found = seen.irradiance(p, self.normal).map(|irradiance| irradiance.value);
            traced += usize::from(found.is_none());
            texels[y * TEXELS + x] += found.unwrap_or_else(|| self.sampled(p, light, RAYS));
        }
        traced
    }
}

fn main() {
    let (room, mut prover) = (Room::new(), Prover::new(6.0));
    let (mut traced, mut all, mut seconds) = (0, 0, [0.0; 2]);
    let ([mut worst, mut brightest], mut at) = ([0.0_f64; 2], (0, 0, 0.0));
    for map in (0..6).map(|wall| room.map(wall)) {
        let began = Instant::now();
        let mut texels = vec![0.0; TEXELS * TEXELS];
        for (light, k) in room.lights.iter().flat_map(|light| (0..(TEXELS / SQUARE).pow(2)).map(move |k| (light, k))) {
            let [x, y] = [k % (TEXELS / SQUARE), k / (TEXELS / SQUARE)].map(|k| k * SQUARE);
            traced += map.bake(&mut prover, light, [x, y, SQUARE], &mut texels);
        }
        seconds[0] += began.elapsed().as_secs_f64();
        let began = Instant::now();
        let brute: Vec<f64> = (0..texels.len()).map(|k| map.by_rays(k, RAYS)).collect();
        seconds[1] += began.elapsed().as_secs_f64();
        all += brute.len() * room.lights.len();
        for (k, (texel, brute)) in texels.iter().zip(&brute).enumerate() {
            brightest = brightest.max(*brute);
            if (texel - brute).abs() > worst {
                (worst, at) = ((texel - brute).abs(), (map.wall, k, *texel));
            }
        }
    }
    let finer = (at.2 - room.map(at.0).by_rays(at.1, 64 * RAYS)).abs();
    let percent = |part: f64, of: f64| 100.0 * part / of;
    println!("{all} texels and lights; rays from {traced} of them, {:.2} %", percent(traced as f64, all as f64));
    println!("{:.3} s instead of {:.3} s, {:.1} %", seconds[0], seconds[1], percent(seconds[0], seconds[1]));
    println!("greatest difference from {RAYS}² rays: {:.3} % of the brightest texel,", percent(worst, brightest));
    println!("and there from {}² rays: {:.4} %", 64 * RAYS, percent(finer, brightest));
}
