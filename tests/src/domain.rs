//! Arguments: points of the square biased to its edges, and shapes from each regime in which some method fails.

use crate::subjects::{
    Bilinear, Cap, Cone, CosineRectangle, CosineTriangle, CylinderSide, Disk, DiskSurface, Exponential,
    GgxVisibleNormals, Hexagon, Linear, Normal, Parallelogram, PatchSurface, ProjectedCap, ProjectedParallelogram,
    ProjectedPentagon, ProjectedSegment, ProjectedTriangle, Rectangle, Segment, SphereSurface, Tent, Triangle,
};
use std::collections::BTreeMap;
use std::sync::Mutex;

/// SplitMix64: nothing of the generators under test.
#[derive(Clone, Debug)]
pub struct Random(u64);
impl Random {
    /// A stream.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x1234_5678_9abc_def0)
    }
    /// 64 bits.
    pub fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }
    /// A multiple of 2⁻²⁴ in [0, 1).
    pub fn unit(&mut self) -> f32 {
        (self.word() >> 40) as f32 / 16_777_216.0
    }
    /// In [0, 1).
    pub fn unit_f64(&mut self) -> f64 {
        (self.word() >> 11) as f64 / 9_007_199_254_740_992.0
    }
    /// Uniform between the two.
    pub fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit_f64()
    }
    /// Uniform on a logarithmic scale between the two.
    pub fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        self.range(low.ln(), high.ln()).exp()
    }
    /// A unit vector, uniform.
    pub fn direction(&mut self) -> [f64; 3] {
        let (z, phi) = (self.range(-1.0, 1.0), self.range(0.0, core::f64::consts::TAU));
        let r = (1.0 - z * z).sqrt();
        [r * phi.cos(), r * phi.sin(), z]
    }
    /// Any finite f32: random bits.
    pub fn any_f32(&mut self) -> f32 {
        loop {
            let x = f32::from_bits(self.word() as u32);
            if x.is_finite() {
                return x;
            }
        }
    }
}

const EPSILON: f32 = 1.0 / 16_777_216.0;
/// Numbers of [0, 1) at which maps break: the ends, the middle, their neighbours.
pub const EDGES: [f32; 11] = [
    0.0,
    EPSILON,
    2.0 * EPSILON,
    1e-3,
    0.25,
    0.5 - EPSILON,
    0.5,
    0.5 + EPSILON,
    0.75,
    1.0 - 2.0 * EPSILON,
    1.0 - EPSILON,
];

/// All pairs of [`EDGES`] and `random` points more.
#[must_use]
pub fn square(random: usize, seed: u64) -> Vec<[f32; 2]> {
    let mut rng = Random::new(seed);
    let mut all: Vec<_> = EDGES.iter().flat_map(|&x| EDGES.map(|y| [x, y])).collect();
    all.extend((0..random).map(|_| [rng.unit(), rng.unit()]));
    all
}

/// A number in [0, 1): in one of three from [`EDGES`].
pub fn unit_or_edge(random: &mut Random) -> f64 {
    let word = random.word();
    if word.is_multiple_of(3) { f64::from(EDGES[(word >> 32) as usize % EDGES.len()]) } else { random.unit_f64() }
}

/// A shape and the regime that it stands for.
pub type Case<S> = (&'static str, S);

fn narrow(a: [f64; 3]) -> [f32; 3] {
    a.map(|x| x as f32)
}
fn frame(random: &mut Random) -> [[f64; 3]; 3] {
    let n = random.direction();
    let (s, t) = crate::oracle::basis(n);
    let turn = random.range(0.0, core::f64::consts::TAU);
    let mix = |a: [f64; 3], b: [f64; 3], c: f64, d: f64| core::array::from_fn(|i| a[i] * c + b[i] * d);
    [mix(s, t, turn.cos(), turn.sin()), mix(s, t, -turn.sin(), turn.cos()), n]
}
fn combine(axes: &[[f64; 3]; 3], x: f64, y: f64, z: f64) -> [f64; 3] {
    core::array::from_fn(|i| axes[0][i] * x + axes[1][i] * y + axes[2][i] * z)
}

/// Cones from 1e−6 to π, by half-angle.
#[must_use]
pub fn cones() -> Vec<Case<Cone>> {
    let of = |sigma: f64| Cone { one_minus_cos: (2.0 * (sigma / 2.0).sin().powi(2)) as f32 };
    let mut all: Vec<_> = [
        ("1e-15", 1e-15),
        ("1e-9", 1e-9),
        ("1e-6", 1e-6),
        ("1e-4", 1e-4),
        ("series seam of others", 0.0262),
        ("0.1", 0.1),
        ("1", 1.0),
        ("just below a hemisphere", 1.57),
        ("beyond a hemisphere", 1.58),
        ("2.5", 2.5),
        ("near the sphere", 3.1),
        ("nearer the sphere", 3.139),
    ]
    .map(|(name, sigma)| (name, of(sigma)))
    .to_vec();
    all.push(("hemisphere", Cone { one_minus_cos: 1.0 }));
    all.push(("sphere", Cone { one_minus_cos: 2.0 }));
    all.push(("sphere, all but a point", Cone { one_minus_cos: 2.0 - 2.0 * EPSILON }));
    all
}

/// Linear densities: flat, rising, falling, nearly flat, from and to nothing; tiny and huge units.
#[must_use]
pub fn linears() -> Vec<Case<Linear>> {
    [
        ("flat", 1.0, 1.0),
        ("ordinary", 1.0, 3.0),
        ("falling", 5.0, 0.5),
        ("nearly flat", 1.0, 1.0 + 2.0 * EPSILON),
        ("from 0", 0.0, 2.0),
        ("to 0", 2.0, 0.0),
        ("from almost 0", 1e-7, 1.0),
        ("to almost 0", 1.0, 1e-7),
        ("tiny units", 1e-30, 3e-30),
        ("huge units", 2e31, 1e31),
    ]
    .map(|(name, a, b)| (name, Linear { a, b }))
    .to_vec()
}

/// Sizes of things on the line.
const SIZES: [(&str, f32); 7] = [
    ("1", 1.0),
    ("ordinary", 0.37),
    ("tiny 1e-6", 1e-6),
    ("tiny 1e-20", 1.3e-20),
    ("huge 1e6", 1.7e6),
    ("huge 1e20", 1e20),
    ("tiny 1e-30", 1e-30),
];

/// Tents of every size.
#[must_use]
pub fn tents() -> Vec<Case<Tent>> {
    SIZES.map(|(name, radius)| (name, Tent { radius })).to_vec()
}

/// Exponentials of every rate.
#[must_use]
pub fn exponentials() -> Vec<Case<Exponential>> {
    SIZES.map(|(name, size)| (name, Exponential { rate: 1.0 / size })).to_vec()
}

/// Normal distributions of every size, about 0 and about means that are large and small beside σ.
#[must_use]
pub fn normals() -> Vec<Case<Normal>> {
    let mut all = SIZES.map(|(name, sigma)| (name, Normal { mean: 0.0, sigma })).to_vec();
    all.push(("mean of 3σ", Normal { mean: 0.3, sigma: 0.1 }));
    all.push(("mean of -100σ", Normal { mean: -100.0, sigma: 1.0 }));
    all.push(("mean of 1e-3σ", Normal { mean: 1.0, sigma: 1e3 }));
    all
}

/// Bilinear densities: flat, ordinary, with zero corners and sides, steep, in tiny and huge units.
#[must_use]
pub fn bilinears() -> Vec<Case<Bilinear>> {
    [
        ("flat", [1.0; 4]),
        ("ordinary", [1.0, 2.0, 0.5, 4.0]),
        ("one corner", [0.0, 0.0, 3.0, 0.0]),
        ("opposite corners", [1.0, 0.0, 0.0, 1.0]),
        ("one side", [1.0, 0.0, 2.0, 0.0]),
        ("steep", [1e-3, 1.0, 0.03, 0.01]),
        ("tiny units", [1e-30, 2e-30, 3e-30, 4e-30]),
        ("huge units", [1e31, 2e31, 3e31, 1e30]),
    ]
    .map(|(name, corners)| (name, Bilinear { corners }))
    .to_vec()
}

/// Microsurfaces: rough, smooth and anisotropic, from above, grazing and below.
#[must_use]
pub fn microsurfaces() -> Vec<Case<GgxVisibleNormals>> {
    [
        ("ordinary", [0.3, 0.3], [0.5, 0.2, 0.8]),
        ("rough 1", [1.0, 1.0], [-0.3, 0.6, 0.4]),
        ("from the normal", [0.2, 0.4], [0.0, 0.0, 1.0]),
        ("anisotropic", [0.5, 0.1], [0.6, 0.3, 0.5]),
        ("smooth 1e-3", [1e-3, 1e-3], [0.5, 0.2, 0.8]),
        ("smooth 1e-6", [1e-6, 2e-6], [0.5, 0.2, 0.8]),
        ("sliver 1e3", [1.0, 1e-3], [0.3, 0.6, 0.5]),
        ("grazing 1e-2", [0.4, 0.4], [0.8, 0.6, 1e-2]),
        ("grazing 1e-5", [0.4, 0.2], [0.8, -0.6, 1e-5]),
        ("on the horizon", [0.5, 0.5], [0.0, 1.0, 0.0]),
        ("below", [0.5, 0.4], [0.8, 0.3, -0.3]),
        ("far below", [0.5, 0.5], [0.3, 0.0, -1.0]),
        ("rough 10", [10.0, 5.0], [0.3, 0.2, 0.6]),
    ]
    .map(|(name, alpha, wi)| (name, GgxVisibleNormals { alpha, wi }))
    .to_vec()
}

/// A corner and two edges, about the given axes.
type Place<'a> = dyn FnMut(&mut Random, [[f64; 3]; 3]) -> [[f64; 3]; 3] + 'a;

/// Flat shapes by regime: corner, two edges. `each` random ones of every regime.
fn flats(each: usize, seed: u64) -> Vec<(&'static str, [[f32; 3]; 3])> {
    let mut random = Random::new(seed);
    let mut all = Vec::new();
    for _ in 0..each {
        let mut push = |name, f: &mut Place<'_>| {
            let axes = frame(&mut random);
            all.push((name, f(&mut random, axes).map(narrow)));
        };
        // edges in the plane z = const of the frame, around the axis
        let facing = |r: &mut Random, a: [[f64; 3]; 3], size: f64, shift: f64| {
            let (x, y) = (r.range(-1.0, 1.0) * shift, r.range(-1.0, 1.0) * shift);
            let angle = r.range(0.6, 2.4);
            let e1 = combine(&a, size, 0.0, 0.0);
            let e2 = combine(&a, size * angle.cos(), size * angle.sin(), 0.0);
            let v0 = combine(&a, x - 0.4 * size, y - 0.3 * size, 1.0);
            [v0, e1, e2]
        };
        push("ordinary", &mut |r, a| facing(r, a, 1.0, 0.7));
        push("small 1e-2", &mut |r, a| facing(r, a, 1e-2, 0.7));
        push("tiny 1e-5", &mut |r, a| facing(r, a, 1e-5, 0.7));
        push("tiny 1e-7", &mut |r, a| facing(r, a, 1e-7, 0.7));
        push("tiny 1e-9", &mut |r, a| facing(r, a, 1e-9, 0.7));
        push("far 1e9", &mut |r, a| facing(r, a, 1e-9, 0.7).map(|v| v.map(|x| x * 1e12)));
        let upright = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        push("on the axis, 1e-4", &mut |r, _| facing(r, upright, 1e-4, 1e-4));
        push("on the axis, 1e-9", &mut |r, _| facing(r, upright, 1e-9, 1e-9));
        push("large 6", &mut |r, a| facing(r, a, 6.0, 1.0));
        push("near-hemisphere 30", &mut |r, a| facing(r, a, 30.0, 3.0));
        push("near-hemisphere 1e3", &mut |r, a| facing(r, a, 1e3, 30.0));
        push("near-hemisphere 1e5", &mut |r, a| facing(r, a, 1e5, 1e3));
        push("oblique", &mut |r, a| {
            let v0 = combine(&a, r.range(-1.0, 1.0), 2.0, 1.0);
            [v0, combine(&a, 1.0, 0.2, 0.6), combine(&a, -0.5, 0.4, -0.8)]
        });
        push("grazing 1e-2", &mut |r, a| {
            [combine(&a, r.range(-1.0, 1.0), 2.0, 1e-2), combine(&a, 1.0, 0.2, 0.0), combine(&a, 0.3, 1.0, 0.0)]
        });
        push("grazing 1e-4", &mut |r, a| {
            [combine(&a, r.range(-1.0, 1.0), 2.0, 1e-4), combine(&a, 1.0, 0.2, 0.0), combine(&a, 0.3, 1.0, 0.0)]
        });
        push("sliver 1e2", &mut |r, a| {
            [combine(&a, -0.5, r.range(-1.0, 1.0), 1.0), combine(&a, 1.0, 0.0, 0.0), combine(&a, 0.5, 1e-2, 0.0)]
        });
        push("sliver 1e4", &mut |r, a| {
            [combine(&a, -0.5, r.range(-1.0, 1.0), 1.0), combine(&a, 1.0, 0.0, 0.0), combine(&a, 0.5, 1e-4, 0.0)]
        });
        push("sliver 1e4 from its end", &mut |r, a| {
            [combine(&a, r.range(0.1, 1.0), 0.0, 1.0), combine(&a, 1e-4, 0.0, 0.0), combine(&a, 0.0, 1.0, 0.0)]
        });
        push("near a vertex", &mut |r, a| {
            [combine(&a, 1e-3 * r.range(-1.0, 1.0), 1e-3, 1e-3), combine(&a, 1.0, 0.0, 0.0), combine(&a, 0.3, 0.9, 0.0)]
        });
        push("near an edge", &mut |r, a| {
            [combine(&a, -0.5, 1e-3 * r.range(-1.0, 1.0), 1e-3), combine(&a, 1.0, 0.0, 0.0), combine(&a, 0.3, 0.9, 0.0)]
        });
    }
    all
}

/// Corner and edges of flat shapes so nearly in a plane with the viewpoint that f32 hardly tells on which side it is.
#[must_use]
pub fn nearly_in_plane(each: usize, seed: u64) -> Vec<[[f32; 3]; 3]> {
    let mut random = Random::new(seed);
    let mut one = |height: f64| {
        let a = frame(&mut random);
        if random.word() & 1 == 0 {
            let v0 = combine(&a, random.range(-1.0, 1.0), 2.0, height);
            return [v0, combine(&a, 1.0, 0.2, 0.0), combine(&a, 0.3, 1.0, 0.0)].map(narrow);
        }
        // the far edge square to the view, so that its whole is about as far as its ends
        let v0 = combine(&a, random.range(-0.1, 0.1), random.range(0.2, 2.0), height);
        [v0, combine(&a, -0.3, 1.0, 0.0), combine(&a, 0.3, 1.0, 0.0)].map(narrow)
    };
    [1e-5, 1e-6, 1e-7, 1e-8].into_iter().flat_map(|height| (0..each).map(|_| one(height)).collect::<Vec<_>>()).collect()
}

/// Triangles of every regime.
#[must_use]
pub fn triangles(each: usize, seed: u64) -> Vec<Case<Triangle>> {
    flats(each, seed)
        .into_iter()
        .enumerate()
        .map(|(i, (name, [v0, e1, e2]))| {
            let by_edges = Triangle::by_edges(v0, e1, e2);
            // a corner that is moved to the viewpoint loses a tiny shape, and the sum rounds: then the shape is another, but exact
            let add = |a: [f32; 3], b: [f32; 3]| core::array::from_fn(|k| a[k] + b[k]);
            let by_vertices = Triangle::by_vertices(v0, add(v0, e1), add(v0, e2));
            let whole = !(name.contains("tiny") || name.contains("far") || name.contains("sliver 1e4"));
            (name, if whole && i % 2 == 0 { by_vertices } else { by_edges })
        })
        .collect()
}

/// Parallelograms of every regime.
#[must_use]
pub fn parallelograms(each: usize, seed: u64) -> Vec<Case<Parallelogram>> {
    flats(each, seed).into_iter().map(|(name, [p, u, v])| (name, Parallelogram::new(p, u, v))).collect()
}

/// Two perpendicular vectors of a random orientation whose products with numbers of 8 bits are exact in f32, and the unit normal: columns of
/// the rotation by a quaternion of small integers.
fn exact_axes(random: &mut Random) -> [[f64; 3]; 3] {
    let mut pick = || (random.word() % 13) as f64 - 6.0;
    let (a, b, c, d) = (pick() + 0.5, pick(), pick(), pick());
    let u = [a * a + b * b - c * c - d * d, 2.0 * (b * c + a * d), 2.0 * (b * d - a * c)];
    let v = [2.0 * (b * c - a * d), a * a - b * b + c * c - d * d, 2.0 * (c * d + a * b)];
    [u, v, crate::oracle::unit(crate::oracle::cross(u, v))]
}
/// Rounded to 8 bits.
fn coarse(x: f64) -> f64 {
    let unit = (x.abs().log2().floor() - 7.0).exp2();
    (x / unit).round() * unit
}

/// In a frame whose z axis is the normal.
type SizeAndCorner = ([f64; 2], [f64; 3]);

/// Rectangles of every regime, with right angles that no rounding has changed.
#[must_use]
pub fn rectangles(each: usize, seed: u64) -> Vec<Case<Rectangle>> {
    let mut random = Random::new(seed);
    let mut all = Vec::new();
    for _ in 0..each {
        // size, and the corner in a frame whose z axis is the normal
        let mut push = |name, f: &dyn Fn(&mut Random) -> SizeAndCorner| {
            let a = exact_axes(&mut random);
            let unit = [a[0], a[1], a[2]].map(crate::oracle::unit);
            let (size, corner) = f(&mut random);
            let edge = |k: usize| a[k].map(|x| x * coarse(size[k] / crate::oracle::length(a[k])));
            let (mut u, mut v) = (edge(0), edge(1));
            if random.word() & 1 == 0 {
                (u, v) = (v, u);
            }
            all.push((
                name,
                Rectangle::new(narrow(combine(&unit, corner[0], corner[1], corner[2])), narrow(u), narrow(v)),
            ));
        };
        let facing = |r: &mut Random, size: f64, shift: f64| {
            let at = |r: &mut Random| r.range(-1.0, 1.0) * shift - 0.5 * size;
            ([size, size * r.range(0.5, 1.0)], [at(r), at(r), 1.0])
        };
        push("ordinary", &|r| facing(r, 1.0, 0.7));
        push("ordinary, aside", &|r| facing(r, 1.0, 3.0));
        push("small 1e-2", &|r| facing(r, 1e-2, 1.0));
        push("tiny 1e-5", &|r| facing(r, 1e-5, 1.0));
        push("tiny 1e-7", &|r| facing(r, 1e-7, 1.0));
        push("tiny 1e-9", &|r| facing(r, 1e-9, 1.0));
        push("tiny 1e-9 below", &|r| facing(r, 1e-9, 1e-9));
        push("far 1e9", &|r| {
            let (size, corner) = facing(r, 1e-9, 1.0);
            (size.map(|x| x * 1e12), corner.map(|x| x * 1e12))
        });
        push("large 6", &|r| facing(r, 6.0, 1.0));
        push("near-hemisphere 30", &|r| facing(r, 30.0, 3.0));
        push("near-hemisphere 1e3", &|r| facing(r, 1e3, 30.0));
        push("near-hemisphere 1e5", &|r| facing(r, 1e5, 1e3));
        push("grazing 1e-2", &|r| ([1.0, 1.0], [r.range(-1.0, 1.0), 2.0, 1e-2]));
        push("grazing 1e-4", &|r| ([1.0, 1.0], [r.range(-1.0, 1.0), 2.0, 1e-4]));
        push("grazing 1e-4, diagonal", &|r| ([1.0, 0.6], [r.range(0.2, 1.0), r.range(-2.0, -1.0), 1e-4]));
        push("sliver 1e2", &|r| ([1.0, 1e-2], [-0.5, r.range(-1.0, 1.0), 1.0]));
        push("sliver 1e4", &|r| ([1.0, 1e-4], [-0.5, r.range(-1.0, 1.0), 1.0]));
        push("sliver 1e4 from its end", &|r| ([1e-4, 1.0], [r.range(0.1, 1.0), 0.0, 1.0]));
        push("near a vertex", &|r| ([1.0, 0.9], [1e-3 * r.range(-1.0, 1.0), 1e-3, 1e-3]));
        push("near an edge", &|r| ([1.0, 0.9], [-0.5, 1e-3 * r.range(-1.0, 1.0), 1e-3]));
        // tilted rectangles on the z axis of the world, whose coordinates tell less than 1
        let tilt = exact_axes(&mut random);
        let length = crate::oracle::length(tilt[0]);
        for (name, size) in [("on the axis, 1e-4", 1e-4), ("on the axis, 1e-9", 1e-9)] {
            let edge = |k: usize, size: f64| tilt[k].map(|x| x * coarse(size / length));
            let (u, v) = (edge(0, size), edge(1, 0.7 * size));
            let p = [-0.4 * (u[0] + v[0]), -0.3 * (u[1] + v[1]), 1.0];
            all.push((name, Rectangle::new(narrow(p), narrow(u), narrow(v))));
        }
    }
    all
}

/// Spheres of every regime.
#[must_use]
pub fn caps(each: usize, seed: u64) -> Vec<Case<Cap>> {
    let mut random = Random::new(seed);
    let mut all = Vec::new();
    for _ in 0..each {
        for (name, ratio, unit) in [
            ("ordinary", 0.3, 1.0),
            ("small 1e-3", 1e-3, 1.0),
            ("tiny 1e-7", 1e-7, 1.0),
            ("tiny 1e-9", 1e-9, 1.0),
            ("far 1e9", 1e-9, 1e12),
            ("small units", 0.2, 1e-12),
            ("close", 0.9, 1.0),
            ("touching 1e-3", 0.999, 1.0),
            ("touching 1e-5", 0.99999, 1.0),
            ("inside, near the surface", 1.0001, 1.0),
            ("inside", 1.5, 1.0),
            ("deep inside", 1e3, 1.0),
        ] {
            let center = narrow(random.direction().map(|x| x * unit));
            all.push((name, Cap::new(center, (ratio * unit) as f32)));
        }
        let size = random.magnitude(1e-9, 1e-2);
        all.push(("on the axis", Cap::new([0.0, 0.0, 1.0], size as f32)));
    }
    all
}

/// Convex hexagons: by the semi-axes of the ellipse about them, and where its centre lies.
#[must_use]
pub fn hexagons(each: usize, seed: u64) -> Vec<Case<Hexagon>> {
    let mut random = Random::new(seed);
    let mut all = Vec::new();
    for _ in 0..each {
        for (name, size, center) in [
            ("ordinary", [0.6, 0.4], [0.2, 0.3, 1.0]),
            ("tiny 1e-3", [1e-3, 1e-3], [0.2, 0.3, 1.0]),
            ("close", [3.0, 2.0], [0.5, -0.3, 0.7]),
            ("near-hemisphere", [30.0, 20.0], [1.0, 2.0, 1.0]),
            ("grazing 1e-2", [1.0, 1.0], [3.0, 0.0, 1e-2]),
            ("sliver 1e2", [0.5, 5e-3], [0.1, 0.2, 1.0]),
        ] {
            let axes = frame(&mut random);
            let corner = |i: usize, random: &mut Random| {
                let angle = (i as f64 + random.range(-0.3, 0.3)) * core::f64::consts::TAU / 6.0;
                let [x, y, z] = center;
                narrow(combine(&axes, x + size[0] * angle.cos(), y + size[1] * angle.sin(), z))
            };
            all.push((name, Hexagon::new(core::array::from_fn(|i| corner(i, &mut random)))));
        }
    }
    all
}

/// Spheres over a horizon, of every regime: by ratio of radius to distance, and cosine from normal to axis (in units of that ratio if small).
#[must_use]
pub fn projected_caps(each: usize, seed: u64) -> Vec<Case<ProjectedCap>> {
    let mut random = Random::new(seed);
    let mut all = Vec::new();
    for _ in 0..each {
        for (name, ratio, cos) in [
            ("ordinary", 0.3, 0.8),
            ("tiny 1e-6", 1e-6, 0.8),
            ("large, whole", 0.9, 0.95),
            ("nearly tangent to the horizon", 0.3, 0.3001),
            ("nearly tangent from below", 0.3, 0.2999),
            ("tiny, over the horizon", 1e-6, 3e-6),
            ("cut", 0.5, 0.3),
            ("cut, large", 0.95, 0.6),
            ("cut, nearly touching", 0.99999, 0.5),
            ("cut, tiny 1e-3", 1e-3, 4e-4),
            ("cut, tiny 1e-6", 1e-6, 4e-7),
            ("axis near the horizon", 0.4, 1e-5),
            ("axis below", 0.5, -0.2),
            ("axis below, large", 0.9, -0.5),
            ("axis below, tiny 1e-3", 1e-3, -4e-4),
            ("axis below, tiny 1e-6", 1e-6, -4e-7),
            ("sliver of a lune", 0.5, -0.45),
            ("axis far below, large", 0.95, -0.8),
        ] {
            let a = frame(&mut random);
            let center = narrow(combine(&a, f64::sqrt(1.0 - cos * cos), 0.0, cos));
            all.push((name, ProjectedCap::new(center, ratio as f32, narrow(a[2]))));
        }
        let normal = narrow(random.direction());
        // exactly: beside the normal by rounding alone, the azimuth is that of the rounding
        all.push((
            "along the normal",
            ProjectedCap::new([0.0, 0.0, 3.0], random.range(0.1, 3.0) as f32, [0.0, 0.0, 1.0]),
        ));
        let beside = [1e-4, 3e-4, 1.0].map(|x: f32| x * random.range(0.5, 1.0) as f32);
        all.push(("nearly along the normal", ProjectedCap::new(beside, 0.3, [0.0, 0.0, 1.0])));
        all.push(("inside", ProjectedCap::new(narrow(random.direction()), 1.5, normal)));
        let about = [0.3, 0.1, 1e-7].map(|x: f32| x * random.range(-1.0, 1.0) as f32);
        all.push(("horizon of coordinates", ProjectedCap::new(about, 1e-3, [0.0, 0.0, 1.0])));
    }
    all
}

/// Distances and sizes of surfaces in space.
const PLACES: [(&str, f32, f32); 5] = [
    ("ordinary", 1.0, 0.7),
    ("small 1e-3", 1.0, 1e-3),
    ("large 1e3", 1.0, 1e3),
    ("small units", 1e-9, 2e-10),
    ("huge units", 1e9, 4e8),
];
const PLACE: [f32; 3] = [0.48, -0.64, 0.6];
const AXIS: [f32; 3] = [0.36, 0.48, -0.8];
fn times(v: [f32; 3], s: f32) -> [f32; 3] {
    v.map(|x| x * s)
}
/// Disks in space.
#[must_use]
pub fn disk_surfaces() -> [Case<DiskSurface>; 5] {
    PLACES.map(|(name, d, radius)| (name, DiskSurface { center: times(PLACE, d), normal: AXIS, radius }))
}
/// Spheres in space.
#[must_use]
pub fn sphere_surfaces() -> [Case<SphereSurface>; 5] {
    PLACES.map(|(name, d, radius)| (name, SphereSurface { center: times(PLACE, d), radius }))
}
/// Sides of cylinders in space: of their own width, long and short.
#[must_use]
pub fn cylinder_sides() -> Vec<Case<CylinderSide>> {
    let of = |(name, d, radius)| (name, CylinderSide { p: times(PLACE, d), axis: times(AXIS, 2.0 * radius), radius });
    let mut all = PLACES.map(of).to_vec();
    all.push(("long", CylinderSide { p: PLACE, axis: times(AXIS, 10.0), radius: 0.1 }));
    all.push(("short", CylinderSide { p: PLACE, axis: times(AXIS, 0.1), radius: 1.0 }));
    all
}

/// Bilinear patches in space: flat, twisted, a trapezium, long, and with two corners in one place.
#[must_use]
pub fn patch_surfaces() -> Vec<Case<PatchSurface>> {
    let u = [0.8, 0.36, -0.2];
    let v = [-0.3, 0.9, 0.5];
    let sum = |s: f32, t: f32, lift: f32| -> [f32; 3] {
        let n = [0.36, -0.34, 0.83];
        core::array::from_fn(|k| s * u[k] + t * v[k] + lift * n[k])
    };
    let mut all: Vec<Case<PatchSurface>> = PLACES
        .map(|(name, d, size)| {
            let [u, v, w] = [u, v, sum(1.0, 1.0, 0.4)].map(|e| times(e, size));
            (name, PatchSurface { p: times(PLACE, d), u, v, w })
        })
        .to_vec();
    for (name, w) in [
        ("flat", sum(1.0, 1.0, 0.0)),
        ("trapezium", sum(0.6, 1.0, 0.0)),
        ("kite", sum(2.0, 1.7, 0.0)),
        ("strongly twisted", sum(1.0, 1.0, 1.5)),
        ("nearly a triangle", sum(0.02, 1.0, 0.0)),
    ] {
        all.push((name, PatchSurface { p: PLACE, u, v, w }));
    }
    let long = times(u, 0.01);
    let w = core::array::from_fn(|k| 1.5 * long[k] + v[k]);
    all.push(("sliver 1e2", PatchSurface { p: PLACE, u: long, v, w }));
    all
}

/// Regimes of flat shapes over which a cosine varies, or is at a far end of them.
fn with_normals<S, W>(shapes: Vec<Case<S>>, seed: u64, of: impl Fn(S, [f32; 3]) -> W) -> Vec<Case<W>> {
    const KEPT: [&str; 7] = ["ordinary", "ordinary, aside", "small 1e-2", "tiny 1e-5", "far 1e9", "large 6", "oblique"];
    let mut random = Random::new(seed);
    let kept = shapes.into_iter().filter(|case| KEPT.contains(&case.0));
    kept.map(|(name, shape)| (name, of(shape, narrow(random.direction())))).collect()
}
/// Triangles on surfaces of any orientation.
#[must_use]
pub fn cosine_triangles(each: usize, seed: u64) -> Vec<Case<CosineTriangle>> {
    with_normals(triangles(each, seed), seed, |shape, normal| CosineTriangle { shape, normal })
}
/// Rectangles on surfaces of any orientation.
#[must_use]
pub fn cosine_rectangles(each: usize, seed: u64) -> Vec<Case<CosineRectangle>> {
    with_normals(rectangles(each, seed), seed, |shape, normal| CosineRectangle { shape, normal })
}

/// Disks of every regime.
#[must_use]
pub fn disks(each: usize, seed: u64) -> Vec<Case<Disk>> {
    disk_parameters(each, seed).into_iter().map(|(name, (c, n, r))| (name, Disk::new(c, n, r))).collect()
}
/// Centre, normal and radius of [`disks`]: from the radius, the height of the point over the plane, and its offset from the axis.
#[must_use]
#[expect(clippy::type_complexity, reason = "vectors and a number")]
pub fn disk_parameters(each: usize, seed: u64) -> Vec<Case<([f32; 3], [f32; 3], f32)>> {
    let mut random = Random::new(seed);
    let mut all = Vec::new();
    for _ in 0..each {
        for (name, radius, height, offset) in [
            ("ordinary", 0.6, 1.0, 0.4),
            ("oblique", 1.0, 1.0, 2.0),
            ("small 1e-3", 1e-3, 1.0, 0.7),
            ("tiny 1e-7", 1e-7, 1.0, 0.7),
            ("tiny 1e-9", 1e-9, 1.0, 0.7),
            ("far 1e9", 1e3, 1e12, 7e11),
            ("on the axis", 0.8, 1.0, 0.0),
            ("nearly on the axis", 0.8, 1.0, 1e-4),
            ("grazing 1e-2", 1.0, 1e-2, 2.5),
            ("grazing 1e-4", 1.0, 1e-4, 2.5),
            ("grazing and far", 1.0, 1e-3, 1e3),
            ("close over it", 1.0, 1e-2, 0.6),
            ("close 1e-4", 1.0, 1e-4, 0.6),
            ("near-hemisphere 1e3", 1e3, 1.0, 30.0),
            ("near-hemisphere 1e5", 1e5, 1.0, 3e4),
            ("over the rim 1e-2", 1.0, 1e-2, 1.0),
            ("over the rim 1e-4", 1.0, 1e-4, 1.0),
            ("beside the rim 1e-2", 1.0, 1e-3, 1.01),
            ("beside the rim 1e-4", 1.0, 1e-3, 1.0001),
            ("within the rim 1e-3", 1.0, 1e-4, 0.999),
        ] {
            let axes = frame(&mut random);
            let center = narrow(combine(&axes, offset, 0.0, height));
            all.push((name, (center, narrow(axes[2]), radius as f32)));
        }
        all.push(("exactly on the axis", ([0.0, 0.0, -2.0], [0.0, 0.0, 1.0], random.range(0.1, 4.0) as f32)));
    }
    all
}

/// Line segments of every regime, and over a horizon.
#[must_use]
pub fn segments(each: usize, seed: u64) -> (Vec<Case<Segment>>, Vec<Case<ProjectedSegment>>) {
    let (plain, over) = segment_parameters(each, seed);
    let plain = plain.into_iter().map(|(name, [a, edge])| (name, Segment::new(a, edge))).collect();
    let over = over.into_iter().map(|(name, [a, edge, n])| (name, ProjectedSegment::new(a, edge, n)));
    (plain, over.filter(|(_, s)| s.seen()).collect())
}
/// Two names as one, made once.
fn joined(name: &'static str, place: &'static str) -> &'static str {
    static NAMES: Mutex<BTreeMap<[&str; 2], &str>> = Mutex::new(BTreeMap::new());
    let mut names = NAMES.lock().expect("nothing panics here");
    names.entry([name, place]).or_insert_with(|| Box::leak(format!("{name}, {place}").into_boxed_str()))
}
/// One end and the edge from there, and besides the normal of the surface, of [`segments`]: from one end, in the plane of point and segment (along the direction to it, and across), the edge; and the
/// height over the horizon of either end.
#[must_use]
#[expect(clippy::type_complexity, reason = "vectors")]
pub fn segment_parameters(each: usize, seed: u64) -> (Vec<Case<[[f32; 3]; 2]>>, Vec<Case<[[f32; 3]; 3]>>) {
    let mut random = Random::new(seed);
    let (mut plain, mut projected) = (Vec::new(), Vec::new());
    for _ in 0..each {
        for (name, a, edge) in [
            ("ordinary", [1.0, -0.3], [0.2, 0.9]),
            ("oblique", [1.0, 0.2], [1.5, 0.4]),
            ("small 1e-3", [1.0, 0.3], [4e-4, 1e-3]),
            ("tiny 1e-5", [1.0, 0.3], [4e-6, 1e-5]),
            ("tiny 1e-9", [1.0, 0.3], [4e-10, 1e-9]),
            ("far 1e9", [1e12, 3e11], [400.0, 1e3]),
            ("end-on 1e-2", [1.0, 0.0], [1.0, 1e-2]),
            ("end-on 1e-4", [1.0, 0.0], [1.0, 1e-4]),
            ("long 1e2", [1.0, -40.0], [3.0, 100.0]),
            ("long 1e5", [1.0, -4e4], [1e3, 1e5]),
            ("long 1e5, from its end", [1.0, -0.1], [1e3, 1e5]),
            ("close 1e-3", [1e-3, -0.5], [1e-3, 1.0]),
            ("close 1e-6", [1e-6, -0.5], [0.0, 1.0]),
            ("touching an end 1e-3", [1e-3, 0.0], [3e-4, 1.0]),
        ] {
            let axes = frame(&mut random);
            let [p, e] = [a, edge].map(|v| narrow(combine(&axes, v[0], v[1], 0.0)));
            plain.push((name, [p, e]));
            // in units of the distance, so that small segments cross the horizon too
            let size = f64::hypot(edge[0], edge[1]).min(1.0) / f64::hypot(a[0], a[1]).max(1.0);
            for (place, tilt, lift) in [
                ("overhead", 0.7, 0.7),
                ("turned", -0.5, 0.6),
                ("cut", 0.6, -0.1 * size),
                ("cut at the other end", -0.6, 0.2 * size),
                ("low 1e-2", 0.3, 1e-2),
            ] {
                // the height of a is its direction's part of the normal along it
                let unit = crate::oracle::unit([a[0], a[1], 0.0]);
                let side = [-unit[1], unit[0], 0.0];
                let towards = side[0] * edge[0] + side[1] * edge[1] > 0.0;
                let tilt = if towards { tilt } else { -tilt };
                let rest = f64::sqrt((1.0 - lift * lift - tilt * tilt).max(0.01));
                let mix = |k: usize| unit[k] * lift + side[k] * tilt;
                let normal = combine(&axes, mix(0), mix(1), rest);
                projected.push((joined(name, place), [p, e, narrow(normal)]));
            }
        }
    }
    let level = [0.0, 0.0, 1.0];
    projected.push(("an end on the horizon", [[1.0, 0.5, 0.0], [0.5, 1.0, 2.0], level]));
    projected.push(("half the sky", [[-1e4, 0.0, 1.0], [2e4, 0.0, 0.0], level]));
    projected.push(("a sliver of sky", [[1.0, 0.0, -1.0], [1e3, 0.0, 3.0], level]));
    (plain, projected)
}

/// Where a flat shape lies over a horizon.
#[derive(Clone, Copy, Debug)]
enum Lie {
    /// Its middle in this direction (elevation's sine), turned at random about it.
    At(f64),
    /// The horizon passes so far (in units of its size) above its middle.
    Cut(f64),
    /// The horizon passes through its first corner.
    Corner,
    /// The zenith is at these coordinates of its edges.
    Zenith(f64, f64),
}

/// Flat shapes over a horizon, of every regime: corner, edges and normal.
#[must_use]
pub fn over_horizon(each: usize, seed: u64) -> Vec<Case<[[f32; 3]; 4]>> {
    use Lie::{At, Corner, Cut, Zenith};
    let mut random = Random::new(seed);
    let mut all = Vec::new();
    for _ in 0..each {
        // size, length over width, and its distance off the nearest point of its plane
        for (name, size, aspect, shift, lie) in [
            ("ordinary", 1.0, 1.0, 0.7, At(0.6)),
            ("overhead", 1.0, 1.0, 0.7, At(0.95)),
            ("small 1e-2", 1e-2, 1.0, 0.7, At(0.5)),
            ("tiny 1e-4", 1e-4, 1.0, 0.7, At(0.5)),
            ("tiny 1e-7", 1e-7, 1.0, 0.7, At(0.5)),
            ("tiny 1e-7 overhead", 1e-7, 1.0, 0.7, At(1.0)),
            ("huge 30", 30.0, 1.0, 3.0, At(0.8)),
            ("huge 30, tilted", 30.0, 1.0, 3.0, At(0.2)),
            ("near-hemisphere 1e3", 1e3, 1.0, 30.0, At(1.0)),
            ("near-hemisphere 1e3, tilted", 1e3, 1.0, 30.0, At(0.5)),
            ("sliver 1e2", 1.0, 1e2, 0.7, At(0.5)),
            ("sliver 1e3 overhead", 2.0, 1e3, 0.3, At(0.97)),
            ("grazing 1e-2", 1.0, 1.0, 100.0, At(0.5)),
            ("low 1e-3", 1e-4, 1.0, 0.7, At(1e-3)),
            ("cut", 1.0, 1.0, 0.7, Cut(0.0)),
            ("cut, middle below", 1.0, 1.0, 0.7, Cut(0.2)),
            ("cut, middle above", 1.0, 1.0, 0.7, Cut(-0.2)),
            ("cut, huge 30", 30.0, 1.0, 3.0, Cut(0.1)),
            ("cut, tiny 1e-4", 1e-4, 1.0, 0.7, Cut(0.1)),
            ("cut, tiny 1e-6", 1e-6, 1.0, 0.7, Cut(-0.1)),
            ("cut, sliver 1e2", 1.0, 1e2, 0.7, Cut(0.0)),
            ("almost below", 1.0, 1.0, 0.7, Cut(0.33)),
            ("horizon through a corner", 1.0, 1.0, 0.7, Corner),
            ("horizon through a corner, tiny 1e-5", 1e-5, 1.0, 0.7, Corner),
            ("zenith inside", 1.0, 1.0, 0.7, Zenith(0.3, 0.4)),
            ("zenith inside, tiny 1e-6", 1e-6, 1.0, 0.7, Zenith(0.3, 0.4)),
            ("zenith inside, huge 30", 30.0, 1.0, 3.0, Zenith(0.3, 0.4)),
            ("zenith inside, sliver 1e2", 1.0, 1e2, 0.7, Zenith(0.3, 0.4)),
            ("zenith on an edge", 1.0, 1.0, 0.7, Zenith(0.3, 0.0)),
            ("zenith on an edge, huge 30", 30.0, 1.0, 3.0, Zenith(0.3, 0.0)),
            ("zenith on a corner", 1.0, 1.0, 0.7, Zenith(0.0, 0.0)),
            ("zenith off an edge by 1e-3", 1.0, 1.0, 0.7, Zenith(0.3, -1e-3)),
            ("zenith off an edge by 1e-6", 1.0, 1.0, 0.7, Zenith(0.6, -1e-6)),
        ] {
            let axes = frame(&mut random);
            let angle = random.range(0.8, 2.2);
            let e1 = combine(&axes, size, 0.0, 0.0);
            let e2 = combine(&axes, size / aspect * angle.cos(), size / aspect * angle.sin(), 0.0);
            let (x, y) = (random.range(-1.0, 1.0) * shift, random.range(0.5, 1.0) * shift);
            let corner = combine(&axes, x - 0.4 * size, y - 0.3 * size / aspect, 1.0);
            let at = |s: f64, t: f64| core::array::from_fn::<f64, 3, _>(|i| corner[i] + e1[i] * s + e2[i] * t);
            let [a, b] = {
                let (a, b) = crate::oracle::basis(crate::oracle::unit(at(0.33, 0.33)));
                let turn = random.range(0.0, core::f64::consts::TAU);
                [a, b].map(|_| core::array::from_fn::<f64, 3, _>(|i| a[i] * turn.cos() + b[i] * turn.sin()))
            };
            let middle = crate::oracle::unit(at(0.33, 0.33));
            // perpendicular to p, as near as may be to the given vector
            let upright = |p: [f64; 3], v: [f64; 3]| {
                let p = crate::oracle::unit(p);
                crate::oracle::unit(crate::oracle::along(v, p, -crate::oracle::dot(v, p)))
            };
            let normal = match lie {
                At(sin) => {
                    let cos = f64::sqrt(1.0 - sin * sin);
                    core::array::from_fn(|i| middle[i] * sin + a[i] * cos)
                }
                Cut(below) => {
                    // up to the sign the plane through p of which the tangent is b
                    let reach = size / aspect / crate::oracle::length(at(0.33, 0.33));
                    let lift = f64::atan(reach * below);
                    let up = upright(middle, b);
                    core::array::from_fn(|i| up[i] * lift.cos() - middle[i] * lift.sin())
                }
                Corner => upright(corner, b),
                Zenith(s, t) => crate::oracle::unit(at(s, t)),
            };
            // any length will do
            let normal = normal.map(|x: f64| x * random.magnitude(0.1, 10.0));
            all.push((name, [corner, e1, e2, normal].map(narrow)));
        }
        // exactly in the planes of the coordinates
        let upright = [[0.2, 0.0, 1.0], [1.0, 0.0, 0.0], [0.5, random.range(0.2, 1.0), 0.0], [0.0, 0.0, 1.0]];
        all.push(("azimuth of an edge", upright.map(narrow)));
        let lying = [[-1.0, 2.0, 0.0], [1.5, 0.0, 0.0], [0.5, 0.2, random.range(0.2, 1.0)], [0.0, 0.0, 1.0]];
        all.push(("an edge on the horizon", lying.map(narrow)));
    }
    all
}

/// Triangles over a horizon, of every regime.
#[must_use]
pub fn projected_triangles(each: usize, seed: u64) -> Vec<Case<ProjectedTriangle>> {
    let add = |a: [f32; 3], b: [f32; 3]| core::array::from_fn(|k| a[k] + b[k]);
    over_horizon(each, seed)
        .into_iter()
        .enumerate()
        .map(|(i, (name, [v, a, b, n]))| {
            let whole = !(name.contains("tiny") || name.contains("sliver") || name.contains("low"));
            let by_vertices = whole && i % 2 == 0;
            let of = ProjectedTriangle::by_vertices;
            (name, if by_vertices { of(v, add(v, a), add(v, b), n) } else { ProjectedTriangle::by_edges(v, a, b, n) })
        })
        .filter(|(_, t)| t.projected_solid_angle() > 0.0)
        .collect()
}

/// Parallelograms over a horizon, of every regime.
#[must_use]
pub fn projected_parallelograms(each: usize, seed: u64) -> Vec<Case<ProjectedParallelogram>> {
    over_horizon(each, seed)
        .into_iter()
        .map(|(name, [p, u, v, n])| (name, ProjectedParallelogram::new(p, u, v, n)))
        .filter(|(_, t)| t.projected_solid_angle() > 0.0)
        .collect()
}

/// Convex pentagons over a horizon.
#[must_use]
pub fn projected_pentagons(each: usize, seed: u64) -> Vec<Case<ProjectedPentagon>> {
    let mut random = Random::new(seed);
    let mut all = Vec::new();
    for _ in 0..each {
        for (name, size, center, normal) in [
            ("ordinary", [0.6, 0.4], [0.2, 0.3, 1.0], [0.3, 0.2, 0.8]),
            ("small 1e-2", [1e-2, 1e-2], [0.2, 0.3, 1.0], [0.3, -0.2, 0.8]),
            ("cut", [0.6, 0.4], [0.2, 0.3, 1.0], [1.0, 0.0, -0.1]),
            ("close", [3.0, 2.0], [0.5, -0.3, 0.7], [1.0, 0.5, 0.3]),
            ("zenith inside", [3.0, 2.0], [0.5, -0.3, 0.7], [0.1, 0.2, 1.0]),
            ("grazing 1e-1", [1.0, 1.0], [3.0, 0.0, 1e-1], [0.5, 0.2, 0.8]),
        ] {
            let axes = frame(&mut random);
            let corner = |i: usize, random: &mut Random| {
                let angle = (i as f64 + random.range(-0.3, 0.3)) * core::f64::consts::TAU / 5.0;
                let [x, y, z] = center;
                narrow(combine(&axes, x + size[0] * angle.cos(), y + size[1] * angle.sin(), z))
            };
            let corners = core::array::from_fn(|i| corner(i, &mut random));
            let normal = narrow(combine(&axes, normal[0], normal[1], normal[2]));
            all.push((name, ProjectedPentagon::new(corners, normal)));
        }
    }
    all
}

/// Lengths and coordinates that break naive code.
pub const NASTY: [f32; 14] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    1e-30,
    -1e-30,
    1e30,
    -1e30,
    1e-42,
    1e-45,
    f32::MIN_POSITIVE,
    1.0 + 2.0 * EPSILON,
    f32::MAX,
    -f32::MAX,
];

/// A vector of [`NASTY`] coordinates, often with equal ones.
pub fn nasty(random: &mut Random) -> [f32; 3] {
    let mut pick = || NASTY[(random.word() % NASTY.len() as u64) as usize];
    let (a, b, c) = (pick(), pick(), pick());
    match random.word() % 4 {
        0 => [0.0, a, 0.0],
        1 => [a, a, b],
        _ => [a, b, c],
    }
}
