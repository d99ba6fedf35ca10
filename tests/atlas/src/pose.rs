//! Poses of shapes, and the sweeps over them, with lengths that are exact in f32.

use clap::ValueEnum;
use etendue_judge::area_lights::{AreaLight, LightShape, Measure};
use etendue_judge::generators::{Random, coarse, exact_axes, small_integer};
use etendue_oracle::{V3, cross, length as norm, narrow, unit};

/// A kind of shape and the measure by which it is sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ShapeKind {
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
    /// A polygon of rounded corners by solid angle
    Polygon,
    /// A disk by solid angle
    Disk,
    /// A triangle by projected solid angle
    ProjectedTriangle,
    /// A parallelogram by projected solid angle
    ProjectedParallelogram,
    /// A polygon of rounded corners by projected solid angle
    ProjectedPolygon,
}
impl ShapeKind {
    /// All kinds.
    #[must_use]
    pub fn all() -> &'static [Self] {
        Self::value_variants()
    }
    /// The name on the command line.
    #[must_use]
    pub fn name(self) -> String {
        self.to_possible_value().map_or_else(String::new, |v| v.get_name().to_owned())
    }
    /// A description.
    #[must_use]
    pub fn about(self) -> String {
        let help = self.to_possible_value().and_then(|v| v.get_help().map(ToString::to_string));
        help.unwrap_or_default()
    }
    /// The shape, and what it is sampled by.
    #[must_use]
    pub fn light(self) -> (LightShape, Measure) {
        use ShapeKind as Kind;
        let shape = match self {
            Kind::Sphere | Kind::ProjectedSphere => LightShape::Sphere,
            Kind::Triangle | Kind::ProjectedTriangle => LightShape::Triangle,
            Kind::Parallelogram | Kind::ProjectedParallelogram => LightShape::Parallelogram,
            Kind::Rectangle => LightShape::Rectangle,
            Kind::Polygon | Kind::ProjectedPolygon => LightShape::Polygon,
            Kind::Disk => LightShape::Disk,
        };
        (shape, if self.projected() { Measure::ProjectedSolidAngle } else { Measure::SolidAngle })
    }
    fn round(self) -> bool {
        self.light().0 == LightShape::Sphere
    }
    /// Whether its pdf is proportional to the irradiance of a receiver.
    #[must_use]
    pub fn projected(self) -> bool {
        use ShapeKind::{ProjectedParallelogram, ProjectedPolygon, ProjectedSphere, ProjectedTriangle};
        matches!(self, ProjectedSphere | ProjectedTriangle | ProjectedParallelogram | ProjectedPolygon)
    }
}

/// One value of an axis.
#[derive(Clone, Debug)]
pub struct Tick {
    /// The value.
    pub value: f64,
    /// Label on the axis; empty for none.
    pub label: String,
}

/// A sweep over two parameters.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// Name in file names and in the table.
    pub name: &'static str,
    /// Title of the maps.
    pub title: &'static str,
    /// Title of the x axis.
    pub x_title: &'static str,
    /// Title of the y axis.
    pub y_title: &'static str,
    /// Values of the x axis.
    pub x: Vec<Tick>,
    /// Values of the y axis.
    pub y: Vec<Tick>,
    /// Parameters that vary.
    axes: Axes,
}

/// The parameters of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Axes {
    /// Size, and elevation of a sphere above the horizon or of the viewpoint above a flat shape.
    Elevation,
    /// Size, and elevation of the light above the horizon in units of its size.
    Horizon,
    /// Aspect ratio and distance.
    Aspect,
    /// Distance of the viewpoint's foot on the disk's plane from the centre, and height above the plane.
    Foot,
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

/// Sines of elevations from the nadir to the zenith, densest at the horizon.
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

/// Elevations in units of the size, densest where the horizon touches the shape.
fn cuts() -> Vec<Tick> {
    let near = |k: i32| named(1.0 - 0.1_f64.powi(k), if k == 7 { "nearly 1" } else { "" });
    let mut up = vec![named(1.1, "1.1"), named(1.001, ""), named(1.0 + 1e-6, ""), named(1.0, "1")];
    up.extend((1..=7).rev().map(near));
    up.extend([named(0.7, ""), named(0.5, "0.5"), named(0.2, "")]);
    up.extend([-2.0, -4.0, -6.0].map(power));
    let down = up.iter().map(|t| {
        let label = if t.label.is_empty() { String::new() } else { format!("-{}", t.label) };
        Tick { value: -t.value, label }
    });
    let mut all: Vec<_> = down.collect();
    all.push(named(0.0, "0"));
    all.extend(up.into_iter().rev());
    all
}

/// The sweeps of spheres, with so many steps per decade.
fn round_sweeps(fine: i32) -> Vec<Sweep> {
    // up to the surface, and inside
    let mut x = powers(-9, -1, fine);
    x.extend([named(0.3, ""), named(0.7, ""), named(0.9, "0.9")]);
    x.extend((2..=7).map(|k| named(1.0 - 0.1_f64.powi(k), if k == 7 { "nearly 1" } else { "" })));
    x.extend([named(1.0, "1"), named(1.0 + 1e-6, ""), named(1.1, ""), named(1e3, "1e3")]);
    vec![
        Sweep {
            name: "size-elevation",
            title: "size × elevation of the centre above the horizon",
            x_title: "radius / distance",
            y_title: "sine of elevation",
            x: x.clone(),
            y: elevations(fine),
            axes: Axes::Elevation,
        },
        Sweep {
            name: "size-horizon",
            title: "size × elevation in units of the size: where the horizon cuts",
            x_title: "radius / distance",
            y_title: "sine of elevation / (radius/distance)",
            x: x.into_iter().filter(|t| t.value < 1.0).collect(),
            y: cuts(),
            axes: Axes::Horizon,
        },
    ]
}

/// The sweeps of a kind; coarse if `quick`.
#[must_use]
pub fn sweeps(kind: ShapeKind, quick: bool) -> Vec<Sweep> {
    let fine = if quick { 1 } else { 2 };
    if kind.round() {
        return round_sweeps(fine);
    }
    let mut list = vec![Sweep {
        name: "size-elevation",
        title: "size × elevation of the viewpoint above the plane of the light",
        x_title: "size / distance",
        y_title: "sine of elevation",
        x: powers(-9, 5, fine),
        y: elevations(fine),
        axes: Axes::Elevation,
    }];
    if kind.projected() {
        list.push(Sweep {
            name: "size-horizon",
            title: "size × elevation of the light above the surface, in units of its size: where the horizon cuts",
            x_title: "size / distance",
            y_title: "height of the centre / half the size",
            x: powers(-9, 2, fine),
            y: cuts(),
            axes: Axes::Horizon,
        });
    }
    let mut heights = vec![named(0.0, "0")];
    heights.extend(powers(-6, 9, fine));
    if kind == ShapeKind::Disk {
        let mut x = vec![named(0.0, "0")];
        x.extend(powers(-6, -1, fine));
        x.push(named(0.5, ""));
        x.extend((1..=6).map(|k| named(1.0 - 0.1_f64.powi(k), if k == 6 { "nearly 1" } else { "" })));
        x.extend([named(1.0, "1"), named(1.0 + 1e-6, ""), named(1.0 + 1e-3, ""), named(1.5, "1.5")]);
        x.extend(powers(1, 6, fine));
        list.push(Sweep {
            name: "foot-height",
            title: "foot of the viewpoint on the disk's plane × height of the viewpoint",
            x_title: "distance of the foot from the centre / radius",
            y_title: "height / radius",
            x,
            y: heights,
            axes: Axes::Foot,
        });
    } else {
        list.push(Sweep {
            name: "aspect-distance",
            title: "aspect ratio × distance",
            x_title: "length / width",
            y_title: "distance / length",
            x: powers(0, 6, 2 * fine),
            y: heights,
            axes: Axes::Aspect,
        });
    }
    list
}

/// `n` points of the unit square, many of them at its edges; coordinates are multiples of 2⁻²⁴.
#[must_use]
pub fn square(n: usize, seed: u64) -> Vec<[f32; 2]> {
    const EDGES: [f32; 7] = [0.0, 1.0 / 16_777_216.0, 1e-3, 0.5, 0.75, 0.999, 1.0 - 1.0 / 16_777_216.0];
    let mut random = Random::new(seed);
    (0..n)
        .map(|i| {
            let mut axis = |edge: bool| {
                let word = random.word();
                if edge { EDGES[(word % 7) as usize] } else { (word >> 40) as f32 / 16_777_216.0 }
            };
            // a quarter of them in a corner, half of them at an edge
            [axis(i % 4 < 2), axis(i % 4 == 0 || i % 4 == 2)]
        })
        .collect()
}

impl Sweep {
    /// Whether the sweep varies the distance to a shape of fixed size.
    #[must_use]
    pub fn touches(&self) -> bool {
        matches!(self.axes, Axes::Aspect | Axes::Foot)
    }

    /// The light of a cell as it is seen from the origin, rotated at random for each `turn`.
    #[must_use]
    pub fn pose(&self, kind: ShapeKind, x: f64, y: f64, turn: u64) -> AreaLight {
        let mut random =
            Random::new(turn.wrapping_mul(0x1234_5678_9abc_def1) ^ x.to_bits() ^ y.to_bits().rotate_left(17));
        let exact = y == 0.0 && (kind.round() == (self.axes == Axes::Elevation) || !kind.round());
        let [a, d] = [(); 2].map(|()| small_integer(&mut random));
        // a height of 0 is exact where the third axis is upright
        let is_upright = exact && self.axes != Axes::Horizon;
        let [b, c] = [(); 2].map(|()| if is_upright { 0.0 } else { small_integer(&mut random) });
        let axes = exact_axes([a + 0.5, b, c, d]);
        let units = axes.map(unit);
        let at = |v: V3| -> V3 { core::array::from_fn(|i| (0..3).map(|k| units[k][i] * v[k]).sum()) };
        let up = narrow(units[2]);
        let around = |random: &mut Random| (std::f64::consts::TAU * random.unit_f64()).sin_cos();
        let level = |sine: f64| ((1.0 - sine) * (1.0 + sine)).max(0.0).sqrt();
        let (shape, by) = kind.light();
        let none = [0.0; 3];
        let light = AreaLight { shape, by, p: none, a: none, b: none, c: none, n: up, radius: 0.0 };
        if kind.round() {
            let sin = if self.axes == Axes::Elevation { y } else { y * x };
            let (s, c) = around(&mut random);
            let center = narrow(at([level(sin) * c, level(sin) * s, sin]));
            return AreaLight { a: center, radius: x as f32, ..light };
        }
        // the light is perpendicular to the third axis
        let (length, width, center) = match self.axes {
            Axes::Elevation => {
                let (s, c) = around(&mut random);
                (x, 0.7 * x, [level(y) * c, level(y) * s, y])
            }
            Axes::Horizon => (x, 0.7 * x, [0.3, 0.48, 0.824_621]),
            Axes::Aspect => (1.0, 1.0 / x, [0.5 * y, 0.2 * y, 0.843 * y]),
            Axes::Foot => {
                let (s, c) = around(&mut random);
                (1.0, 1.0, [x * c, x * s, y])
            }
        };
        let center = at(center);
        // the receiver faces the light, or has it at the horizon
        let towards = if center == [0.0; 3] { units[2] } else { unit(center) };
        let normal = if self.axes == Axes::Horizon {
            let across = unit(cross(towards, units[(turn % 3) as usize]));
            let sine = (y * 0.5 * x).clamp(-1.0, 1.0);
            let flat = cross(across, towards);
            narrow(core::array::from_fn(|i| towards[i] * sine + flat[i] * level(sine)))
        } else {
            narrow(towards)
        };
        let light = AreaLight { n: normal, ..light };
        if shape == LightShape::Disk {
            let radius = if self.axes == Axes::Foot { 1.0 } else { 0.5 * length } as f32;
            return AreaLight { a: narrow(center), b: up, radius, ..light };
        }
        let edge = |k: usize, size: f64| axes[k].map(|x| x * coarse(size / norm(axes[k])));
        let (u, v) = (edge(0, length), edge(1, width));
        let skew = match shape {
            LightShape::Triangle => 0.3,
            LightShape::Parallelogram | LightShape::Polygon if self.axes != Axes::Aspect => 0.4,
            _ => 0.0,
        };
        let (b, c) = (narrow(u), narrow(core::array::from_fn(|i| v[i] + skew * u[i])));
        let middle = if shape == LightShape::Triangle { 1.0 / 3.0 } else { 0.5 };
        // if it touches: the viewpoint is inside, at a vertex or on an edge
        let (s, t) = match turn % 3 {
            1 if self.axes == Axes::Aspect && y == 0.0 => (0.0, 0.0),
            2 if self.axes == Axes::Aspect && y == 0.0 => (0.5, 0.0),
            _ => (middle, middle),
        };
        let corner = core::array::from_fn(|i| center[i] - s * f64::from(b[i]) - t * f64::from(c[i]));
        AreaLight { a: narrow(corner), b, c, ..light }
    }
}
