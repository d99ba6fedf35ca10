//! Where a shape stands: the two sweeps, with lengths that are exact in f32.

use clap::ValueEnum;

/// A vector in f64.
pub type V3 = [f64; 3];

/// f32 to f64.
#[must_use]
pub fn wide(a: [f32; 3]) -> V3 {
    a.map(f64::from)
}
/// Unit vector; 0 stays 0.
#[must_use]
pub fn unit(a: V3) -> V3 {
    let l = a[0].hypot(a[1]).hypot(a[2]);
    if l > 0.0 { a.map(|x| x / l) } else { a }
}
fn narrow(a: V3) -> [f32; 3] {
    a.map(|x| x as f32)
}
fn cross(a: V3, b: V3) -> V3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// What the atlas sweeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Kind {
    /// A sphere by solid angle
    Sphere,
    /// A sphere by projected solid angle
    ProjectedSphere,
    /// A triangle by solid angle
    Triangle,
    /// A parallelogram by solid angle
    Parallelogram,
    /// A rectangle by solid angle
    Rectangle,
    /// A convex hexagon by solid angle
    Polygon,
}
impl Kind {
    /// As on the command line.
    #[must_use]
    pub fn name(self) -> String {
        self.to_possible_value().map_or_else(String::new, |v| v.get_name().to_owned())
    }
    /// What it is.
    #[must_use]
    pub fn about(self) -> String {
        let help = self.to_possible_value().and_then(|v| v.get_help().map(ToString::to_string));
        help.unwrap_or_default()
    }
    fn round(self) -> bool {
        matches!(self, Self::Sphere | Self::ProjectedSphere)
    }
}

/// A shape relative to the viewpoint.
#[derive(Clone, Debug)]
pub enum Shape {
    /// Centre and radius.
    Sphere {
        /// Centre.
        center: [f32; 3],
        /// Radius.
        radius: f32,
    },
    /// A triangle or a parallelogram: corner and edges.
    Flat {
        /// Corner.
        p: [f32; 3],
        /// Edge.
        u: [f32; 3],
        /// Edge.
        v: [f32; 3],
    },
    /// A hexagon.
    Corners([[f32; 3]; 6]),
}

/// A shape, and the receiver's normal.
#[derive(Clone, Debug)]
pub struct Pose {
    /// Relative to the viewpoint.
    pub shape: Shape,
    /// Of the receiver.
    pub normal: [f32; 3],
}

/// One value of an axis.
#[derive(Clone, Debug)]
pub struct Tick {
    /// The value.
    pub value: f64,
    /// As written on the axis.
    pub label: String,
}

/// Two axes.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// As in the table.
    pub name: &'static str,
    /// Over the map.
    pub title: &'static str,
    /// Across.
    pub x_title: &'static str,
    /// Upwards.
    pub y_title: &'static str,
    /// Across.
    pub x: Vec<Tick>,
    /// Upwards.
    pub y: Vec<Tick>,
    /// Is it the first sweep of its kind?
    first: bool,
}

fn power(exponent: f64) -> Tick {
    let whole = (exponent - exponent.round()).abs() < 1e-9;
    let label = if whole { format!("1e{}", exponent.round()) } else { String::new() };
    Tick { value: 10.0_f64.powf(exponent), label }
}
fn named(value: f64, label: &str) -> Tick {
    Tick { value, label: label.to_owned() }
}
fn powers(low: i32, high: i32, per_decade: i32) -> Vec<Tick> {
    (low * per_decade..=high * per_decade).map(|i| power(f64::from(i) / f64::from(per_decade))).collect()
}

/// From the nadir to the zenith: sines, finest at the horizon.
fn elevations(per_decade: i32) -> Vec<Tick> {
    let mut up: Vec<_> = powers(-7, -1, per_decade);
    up.extend([named(0.3, ""), named(0.6, ""), named(0.9, ""), named(1.0, "1")]);
    let down = up.iter().rev().map(|t| {
        let label = if t.label.is_empty() { String::new() } else { format!("-{}", t.label) };
        Tick { value: -t.value, label }
    });
    let mut all: Vec<_> = down.collect();
    all.push(named(0.0, "0"));
    all.extend(up);
    all
}

/// The sweeps of a kind; coarse if `quick`.
#[must_use]
pub fn sweeps(kind: Kind, quick: bool) -> Vec<Sweep> {
    let fine = if quick { 1 } else { 2 };
    if kind.round() {
        // to the surface, and inside
        let mut x = powers(-9, -1, fine);
        x.extend([named(0.3, ""), named(0.7, ""), named(0.9, "0.9")]);
        x.extend((2..=7).map(|k| named(1.0 - 0.1_f64.powi(k), if k == 7 { "1-1e-7" } else { "" })));
        x.extend([named(1.0, "1"), named(1.0 + 1e-6, ""), named(1.1, ""), named(1e3, "1e3")]);
        let mut near: Vec<_> =
            (1..=7).rev().map(|k| named(1.0 - 0.1_f64.powi(k), if k == 7 { "1-1e-7" } else { "" })).collect();
        near.extend([named(0.7, ""), named(0.5, "0.5"), named(0.2, "")]);
        near.extend([-2.0, -4.0, -6.0].map(power));
        let mut y: Vec<_> = [1.1, 1.001, 1.0 + 1e-6].map(|v| named(v, "")).to_vec();
        y[0].label = "1.1".into();
        y.push(named(1.0, "1"));
        y.extend(near);
        let below: Vec<_> = y
            .iter()
            .rev()
            .map(|t| Tick {
                value: -t.value,
                label: if t.label.is_empty() { String::new() } else { format!("-{}", t.label) },
            })
            .collect();
        y.push(named(0.0, "0"));
        y.extend(below);
        y.reverse();
        let title = "size × elevation of the centre over the horizon";
        return vec![
            Sweep {
                name: "size-elevation",
                title,
                x_title: "radius / distance",
                y_title: "sine of elevation",
                x: x.clone(),
                y: elevations(fine),
                first: true,
            },
            Sweep {
                name: "size-horizon",
                title: "size × elevation in units of the size: where the horizon cuts",
                x_title: "radius / distance",
                y_title: "sine of elevation / (radius/distance)",
                x: x.into_iter().filter(|t| t.value < 1.0).collect(),
                y,
                first: false,
            },
        ];
    }
    let mut distances = vec![named(0.0, "0")];
    distances.extend(powers(-6, 9, fine));
    vec![
        Sweep {
            name: "size-elevation",
            title: "size × elevation of the viewpoint over the plane of the light",
            x_title: "size / distance",
            y_title: "sine of elevation",
            x: powers(-9, 5, fine),
            y: elevations(fine),
            first: true,
        },
        Sweep {
            name: "aspect-distance",
            title: "aspect ratio × distance",
            x_title: "length / width",
            y_title: "distance / length",
            x: powers(0, 6, 2 * fine),
            y: distances,
            first: false,
        },
    ]
}

/// SplitMix64.
struct Random(u64);
impl Random {
    fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }
    fn unit(&mut self) -> f64 {
        (self.word() >> 11) as f64 / 9_007_199_254_740_992.0
    }
}

/// `n` points of the square, biased to its edges: multiples of 2⁻²⁴.
#[must_use]
pub fn square(n: usize, seed: u64) -> Vec<[f32; 2]> {
    const EDGES: [f32; 7] = [0.0, 1.0 / 16_777_216.0, 1e-3, 0.5, 0.75, 0.999, 1.0 - 1.0 / 16_777_216.0];
    let mut random = Random(seed ^ 0x5eed);
    (0..n)
        .map(|i| {
            let mut axis = |edge: bool| {
                let word = random.word();
                if edge { EDGES[(word % 7) as usize] } else { (word >> 40) as f32 / 16_777_216.0 }
            };
            // a quarter in a corner, a half at a side
            [axis(i % 4 < 2), axis(i % 4 == 0 || i % 4 == 2)]
        })
        .collect()
}

/// To 8 bits.
fn coarse(x: f64) -> f64 {
    if x == 0.0 {
        return 0.0;
    }
    let unit = (x.abs().log2().floor() - 7.0).exp2();
    (x / unit).round() * unit
}

/// Three perpendicular vectors whose products with numbers of 8 bits are exact in f32: columns of the rotation by a quaternion of small
/// integers. The third has length 1. `upright`: the third is the z axis, so that a height of 0 is exact.
fn axes(random: &mut Random, upright: bool) -> [V3; 3] {
    let mut pick = || (random.word() % 13) as f64 - 6.0;
    let (a, d) = (pick() + 0.5, pick());
    let (b, c) = if upright { (0.0, 0.0) } else { (pick(), pick()) };
    let u = [a * a + b * b - c * c - d * d, 2.0 * (b * c + a * d), 2.0 * (b * d - a * c)];
    let v = [2.0 * (b * c - a * d), a * a - b * b + c * c - d * d, 2.0 * (c * d + a * b)];
    [u, v, unit(cross(u, v))]
}

impl Sweep {
    /// The pose of a cell; each `turn` is another rotation of it.
    #[must_use]
    pub fn pose(&self, kind: Kind, x: f64, y: f64, turn: u64) -> Pose {
        let mut random = Random(turn.wrapping_mul(0x1234_5678_9abc_def1) ^ x.to_bits() ^ y.to_bits().rotate_left(17));
        let exact = if self.first { y == 0.0 } else { !kind.round() && y == 0.0 };
        let axes = axes(&mut random, exact);
        let units = axes.map(unit);
        let at = |v: V3| -> V3 { core::array::from_fn(|i| (0..3).map(|k| units[k][i] * v[k]).sum()) };
        let up = narrow(units[2]);
        if kind.round() {
            let sin = if self.first { y } else { y * x };
            let (s, c) = (std::f64::consts::TAU * random.unit()).sin_cos();
            let level = ((1.0 - sin) * (1.0 + sin)).max(0.0).sqrt();
            let center = narrow(at([level * c, level * s, sin]));
            return Pose { shape: Shape::Sphere { center, radius: x as f32 }, normal: up };
        }
        // the light lies across the third axis; its centre is at `center`
        let (length, width, center) = if self.first {
            let (s, c) = (std::f64::consts::TAU * random.unit()).sin_cos();
            let level = ((1.0 - y) * (1.0 + y)).max(0.0).sqrt();
            (x, 0.7 * x, [level * c, level * s, y])
        } else {
            (1.0, 1.0 / x, [0.5 * y, 0.2 * y, 0.843 * y])
        };
        let edge = |k: usize, size: f64| {
            let l = axes[k][0].hypot(axes[k][1]).hypot(axes[k][2]);
            axes[k].map(|x| x * coarse(size / l))
        };
        let (u, mut v) = (edge(0, length), edge(1, width));
        let skew = match kind {
            Kind::Triangle => 0.3,
            Kind::Parallelogram if self.first => 0.4,
            _ => 0.0,
        };
        v = core::array::from_fn(|i| v[i] + skew * u[i]);
        let middle = if kind == Kind::Triangle { 1.0 / 3.0 } else { 0.5 };
        let center = at(center);
        let towards_viewer = narrow(if center == [0.0; 3] { units[2] } else { unit(center) });
        let shape = if kind == Kind::Polygon {
            let corner = |i: usize| {
                let (s, c) = (std::f64::consts::TAU * i as f64 / 6.0).sin_cos();
                narrow(core::array::from_fn(|k| center[k] + 0.5 * (u[k] * c + v[k] * s)))
            };
            Shape::Corners(core::array::from_fn(corner))
        } else {
            let (u, v) = (narrow(u), narrow(v));
            // touching: within, on a vertex, on an edge
            let (s, t) = match turn % 3 {
                1 if !self.first && y == 0.0 => (0.0, 0.0),
                2 if !self.first && y == 0.0 => (0.5, 0.0),
                _ => (middle, middle),
            };
            let p = core::array::from_fn(|i| center[i] - s * f64::from(u[i]) - t * f64::from(v[i]));
            Shape::Flat { p: narrow(p), u, v }
        };
        Pose { shape, normal: towards_viewer }
    }
}
