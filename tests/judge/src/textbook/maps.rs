//! Samplers of spheres, triangles and rectangles.

use super::vectors::{V, add, cross, dot, length, normalize, sub, times};
use crate::lights::sampler::{Sample, Sampler};
use core::f32::consts::{PI, TAU};

fn drawn(direction: V, pdf: f32) -> Option<Sample> {
    Some(Sample { direction, pdf, is_hidden: false })
}
/// Whether a ray meets a parallelogram, by Möller and Trumbore.
fn meets([p, e1, e2]: [V; 3], w: V) -> bool {
    let across = cross(w, e2);
    let scale = 1.0 / dot(e1, across);
    let from = times(p, -1.0);
    let (s, over) = (dot(from, across) * scale, cross(from, e1));
    let (t, distance) = (dot(w, over) * scale, dot(e2, over) * scale);
    (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) && distance > 0.0
}

/// A cone by its cosine: cosσ = √(1 − R²/d²), cosθ = 1 − u₀(1 − cosσ), sinθ = √(1 − cos²θ). With `series`,
/// sin²θ = u₀ sin²σ and 1 − cosσ = ½ sin²σ below sin²σ = 0.00068523 (1.5°), as in PBR 4th ed., 6.2.4.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    frame: etendue::Frame<f32>,
    sin_squared: f32,
    small: bool,
    h: f32,
}
impl Cone {
    /// The sphere of a centre and a radius.
    pub(super) fn new(center: V, radius: f32, series: bool) -> Self {
        let distance = length(center);
        let axis = normalize(center);
        let frame = etendue::Frame::new(etendue::Vec3::new(axis[0], axis[1], axis[2]));
        let sin_squared = radius * radius / (distance * distance);
        let small = series && sin_squared < 0.000_685_23;
        let cos_sigma = (1.0 - sin_squared).max(0.0).sqrt();
        Self { frame, sin_squared, small, h: if small { 0.5 * sin_squared } else { 1.0 - cos_sigma } }
    }
}
impl Sampler for Cone {
    fn sample(&self, u: [f32; 2]) -> Option<Sample> {
        let mut cos = 1.0 - u[0] * self.h;
        let mut sin_squared_theta = 1.0 - cos * cos;
        if self.small {
            sin_squared_theta = self.sin_squared * u[0];
            cos = (1.0 - sin_squared_theta).sqrt();
        }
        let sin = sin_squared_theta.max(0.0).sqrt();
        let (s, c) = (TAU * u[1]).sin_cos();
        let w = self.frame.to_world(etendue::Vec3::new(sin * c, sin * s, cos));
        drawn([w.x, w.y, w.z], 1.0 / (TAU * self.h))
    }
    fn pdf(&self, w: V) -> f32 {
        let local = self.frame.to_local(etendue::Vec3::new(w[0], w[1], w[2]));
        let across = local.x * local.x + local.y * local.y;
        if local.z > 0.0 && across <= self.sin_squared { 1.0 / (TAU * self.h) } else { 0.0 }
    }
}

/// How to compute the solid angle of a spherical triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Excess {
    /// α + β + γ − π, with angles by arc cosines of the planes' normals (Girard; Arvo 1995).
    Angles,
    /// 2 atan2(|a·(b×c)|, 1 + a·b + b·c + c·a) on unit vectors (Van Oosterom and Strackee 1983).
    Oosterom,
}

/// A spherical triangle and Arvo's map about b, from a to c ("Stratified Sampling of Spherical Triangles", 1995).
#[derive(Clone, Copy, Debug)]
struct Arvo {
    a: V,
    b: V,
    c: V,
    cos_c: f32,
    angle: [f32; 2],
    solid_angle: f32,
}
impl Arvo {
    /// The triangle of vertices relative to the point.
    fn new([a, b, c]: [V; 3], excess: Excess) -> Self {
        let (a, b, c) = (normalize(a), normalize(b), normalize(c));
        let planes = [cross(a, b), cross(b, c), cross(c, a)].map(normalize);
        let angle = |p: V, q: V| (-dot(p, q)).clamp(-1.0, 1.0).acos();
        let (alpha, beta, gamma) =
            (angle(planes[0], planes[2]), angle(planes[1], planes[0]), angle(planes[2], planes[1]));
        let solid_angle = match excess {
            Excess::Angles => alpha + beta + gamma - PI,
            Excess::Oosterom => {
                let volume = dot(a, cross(b, c)).abs();
                2.0 * volume.atan2(1.0 + dot(a, b) + dot(b, c) + dot(c, a))
            }
        };
        Self { a, b, c, cos_c: dot(a, b), angle: [alpha.sin(), alpha.cos()], solid_angle }
    }
    fn sample(&self, u: [f32; 2]) -> V {
        let [sin_alpha, cos_alpha] = self.angle;
        let (sin_area, cos_area) = (u[0] * self.solid_angle).sin_cos();
        let s = sin_area * cos_alpha - cos_area * sin_alpha;
        let t = cos_area * cos_alpha + sin_area * sin_alpha;
        let p = t - cos_alpha;
        let q = s + sin_alpha * self.cos_c;
        let cos = ((q * t - p * s) * cos_alpha - q) / ((q * s + p * t) * sin_alpha);
        let cos = cos.clamp(-1.0, 1.0);
        let towards = |from: V, to: V| normalize(sub(to, times(from, dot(from, to))));
        let swept = add(times(self.a, cos), times(towards(self.a, self.c), (1.0 - cos * cos).max(0.0).sqrt()));
        let z = 1.0 - u[1] * (1.0 - dot(swept, self.b));
        add(times(self.b, z), times(towards(self.b, swept), (1.0 - z * z).max(0.0).sqrt()))
    }
}

/// A fan of spherical triangles, chosen by u₀.
#[derive(Clone, Debug)]
pub(super) struct Fan {
    parts: Vec<Arvo>,
    whole: f32,
}
impl Fan {
    /// The triangles of vertices relative to the point.
    pub(super) fn new(triangles: &[[V; 3]], excess: Excess) -> Self {
        let parts: Vec<_> = triangles.iter().map(|t| Arvo::new(*t, excess)).collect();
        let whole = parts.iter().map(|part| part.solid_angle).sum();
        Self { parts, whole }
    }
    /// Whether a direction is inside of a part.
    fn meets(&self, w: V) -> bool {
        self.parts.iter().any(|f| {
            let turn = dot(f.a, cross(f.b, f.c)).signum();
            [(f.a, f.b), (f.b, f.c), (f.c, f.a)].iter().all(|&(a, b)| turn * dot(w, cross(a, b)) >= 0.0)
        })
    }
}
impl Sampler for Fan {
    fn sample(&self, u: [f32; 2]) -> Option<Sample> {
        let mut rest = u[0] * self.whole;
        let (last, others) = self.parts.split_last()?;
        for part in others {
            if rest < part.solid_angle {
                return drawn(part.sample([rest / part.solid_angle, u[1]]), 1.0 / self.whole);
            }
            rest -= part.solid_angle;
        }
        drawn(last.sample([rest / last.solid_angle, u[1]]), 1.0 / self.whole)
    }
    fn pdf(&self, w: V) -> f32 {
        if self.meets(w) { 1.0 / self.whole } else { 0.0 }
    }
}

/// The directions of another sampler, whose density is constant or proportional to the cosine to a normal.
pub(super) struct Reweighted {
    pub(super) own: Box<dyn Sampler>,
    /// Per steradian, at a cosine of 1.
    pub(super) density: f32,
    pub(super) normal: Option<V>,
}
impl Reweighted {
    fn at(&self, w: V) -> f32 {
        self.normal.map_or(1.0, |n| dot(w, n).max(0.0)) * self.density
    }
}
impl Sampler for Reweighted {
    fn sample(&self, u: [f32; 2]) -> Option<Sample> {
        let drawn = self.own.sample(u)?;
        Some(Sample { pdf: self.at(drawn.direction), ..drawn })
    }
    fn pdf(&self, w: V) -> f32 {
        if self.own.pdf(w) > 0.0 { self.at(w) } else { 0.0 }
    }
}

/// A spherical rectangle: Ureña, Fajardo and King, "An Area-Preserving Parametrization for Spherical Rectangles", 2013.
#[derive(Clone, Copy, Debug)]
pub(super) struct Urena {
    shape: [V; 3],
    axes: [V; 3],
    x: [f32; 2],
    y: [f32; 2],
    z: f32,
    b: [f32; 2],
    k: f32,
    solid_angle: f32,
}
impl Urena {
    /// The rectangle of a corner and two perpendicular edges.
    pub(super) fn new([p, u, v]: [V; 3]) -> Self {
        let (lu, lv) = (length(u), length(v));
        let (x_axis, y_axis) = (times(u, 1.0 / lu), times(v, 1.0 / lv));
        let mut z_axis = cross(x_axis, y_axis);
        let mut z = dot(p, z_axis);
        if z > 0.0 {
            (z, z_axis) = (-z, times(z_axis, -1.0));
        }
        let (x0, y0) = (dot(p, x_axis), dot(p, y_axis));
        let (x1, y1) = (x0 + lu, y0 + lv);
        let corner = |x, y| [x, y, z];
        let around = [corner(x0, y0), corner(x1, y0), corner(x1, y1), corner(x0, y1)];
        let n: [V; 4] = core::array::from_fn(|i| normalize(cross(around[i], around[(i + 1) % 4])));
        let gamma: [f32; 4] = core::array::from_fn(|i| (-dot(n[i], n[(i + 1) % 4])).clamp(-1.0, 1.0).acos());
        let k = TAU - gamma[2] - gamma[3];
        Self {
            shape: [p, u, v],
            axes: [x_axis, y_axis, z_axis],
            x: [x0, x1],
            y: [y0, y1],
            z,
            b: [n[0][2], n[2][2]],
            k,
            solid_angle: gamma[0] + gamma[1] - k,
        }
    }
    /// The direction for `u`.
    pub(super) fn at(&self, u: [f32; 2]) -> V {
        let [b0, b1] = self.b;
        let (sin, cos) = (u[0] * self.solid_angle + self.k).sin_cos();
        let f = (cos * b0 - b1) / sin;
        let c = (1.0 / (f * f + b0 * b0).sqrt() * if f > 0.0 { 1.0 } else { -1.0 }).clamp(-1.0, 1.0);
        let x = (-(c * self.z) / (1.0 - c * c).max(1e-12).sqrt()).clamp(self.x[0], self.x[1]);
        let d = (x * x + self.z * self.z).sqrt();
        let h = self.y.map(|y| y / (d * d + y * y).sqrt());
        let height = h[0] + u[1] * (h[1] - h[0]);
        let squared = height * height;
        let y = if squared < 1.0 - 1e-6 { height * d / (1.0 - squared).sqrt() } else { self.y[1] };
        let [a, b, n] = self.axes;
        normalize(add(times(a, x), add(times(b, y), times(n, self.z))))
    }
}

impl Sampler for Urena {
    fn sample(&self, u: [f32; 2]) -> Option<Sample> {
        drawn(self.at(u), 1.0 / self.solid_angle)
    }
    fn pdf(&self, w: V) -> f32 {
        if meets(self.shape, w) { 1.0 / self.solid_angle } else { 0.0 }
    }
}
