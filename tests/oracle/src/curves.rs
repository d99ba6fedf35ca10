//! The maps of disks and line segments by definition, set up in 106 bits, integrated and inverted in f64.

use crate::double_double::{Dd, Dd3, add, cross, dd, dot, length, narrow, normalized, times};
use crate::quadrature::{gauss_legendre, integral, root};
use crate::vectors::V3;
use core::f64::consts::{FRAC_PI_2, PI};

/// The elliptic cone of a disk as seen from the point. With χ the eccentric angle from the major axis, dΩ = sinα sinβ dχ/(1+D), where
/// D² = cos²β cos²χ + cos²α sin²χ is the squared height of the rim. u₀ sets χ, quadrant by quadrant, and 1−cosθ is the fraction u₁ of
/// that of the rim.
#[derive(Clone, Debug)]
pub struct Ellipse {
    /// Minor axis, major axis and the cone's axis.
    axes: [V3; 3],
    /// Sines of the half-angles α and β, across and along the major axis.
    pub sines: [f64; 2],
    /// Cosines of the half-angles.
    pub cosines: [f64; 2],
    nodes: [(f64, f64); 16],
    /// Values of χ, and the integral of 1/(1+D) up to each.
    panels: Vec<[f64; 2]>,
    solid_angle: f64,
}
impl Ellipse {
    /// The cone of a disk with normal `n` of any length. If the disk faces the point, every axis is a major axis: `facing` chooses one,
    /// perpendicular to the cone's axis.
    pub fn new(center: V3, n: V3, radius: f64, facing: impl FnOnce(V3) -> V3) -> Self {
        let (c, n, r) = (dd(center), dd(n), Dd::from(radius));
        let signed = dot(c, n) / length(n);
        let (z, towards) = (signed.abs(), normalized(n.map(|x| if signed.to_f64() < 0.0 { -x } else { x })));
        let power = dot(c, c) - r * r;
        let twice = z * r + z * r;
        let h = (power * power + twice * twice).sqrt();
        let alpha = 0.5 * twice.to_f64().atan2(power.to_f64());
        let sin = alpha.sin();
        let cos = if power.to_f64() >= 0.0 { alpha.cos() } else { (twice / h).to_f64() / (2.0 * sin) };
        let beta = radius.atan2(h.to_f64().sqrt() * cos);
        let (sines, cosines) = ([sin, beta.sin()], [cos, beta.cos()]);
        // the cone's axis is c − sin²β (c − z n)
        let offset = add(c, times(towards, -z));
        let axis = add(times(towards, z), times(offset, Dd::from(cosines[1] * cosines[1])));
        let axis = normalized(if length(axis).to_f64() > 0.0 { axis } else { towards });
        let across = cross(n, c);
        let across = if length(across).to_f64() > 0.0 { normalized(across) } else { dd(facing(narrow(axis))) };
        let axes = [normalized(cross(across, axis)), across, axis].map(narrow);
        let mut this = Self { axes, sines, cosines, nodes: gauss_legendre(), panels: vec![[0.0; 2]], solid_angle: 0.0 };
        // finer near the major axis, where the integrand of a large disk has a kink
        let mut sum = 0.0;
        for k in (0..40).rev() {
            let (low, high) = (this.panels[this.panels.len() - 1][0], FRAC_PI_2 * 0.5_f64.powi(k));
            sum += integral(&this.nodes, low, high, |chi| 1.0 / (1.0 + this.rim(chi)));
            this.panels.push([high, sum]);
        }
        if z.to_f64() > 0.0 && radius > 0.0 {
            this.solid_angle = 4.0 * sines[0] * sines[1] * sum;
        }
        this
    }
    fn rim(&self, chi: f64) -> f64 {
        (self.cosines[1] * chi.cos()).hypot(self.cosines[0] * chi.sin())
    }
    /// Solid angle in steradians.
    #[must_use]
    pub fn solid_angle(&self) -> f64 {
        self.solid_angle
    }
    /// The direction for `u`.
    #[must_use]
    pub fn at(&self, u: [f64; 2]) -> V3 {
        let turned = 4.0 * u[0];
        let quadrant = (turned as usize).min(3);
        let part = (turned - [0.0, 2.0, 2.0, 4.0][quadrant]).abs();
        let target = part * self.panels[self.panels.len() - 1][1];
        let i = self.panels.iter().position(|p| p[1] >= target).unwrap_or(self.panels.len() - 1).max(1);
        let ([low, before], [high, after]) = (self.panels[i - 1], self.panels[i]);
        let up_to = |step: f64| integral(&self.nodes, low, low + step, |chi| 1.0 / (1.0 + self.rim(chi)));
        let chi = low + root(high - low, after - before, target - before, up_to);
        let (s, c) = chi.sin_cos();
        let (x, y) = (self.sines[0] * s, self.sines[1] * c);
        // 1−D² is the squared radius of the rim
        let (squared, d) = (x * x + y * y, self.rim(chi));
        let k = u[1] * squared / (1.0 + d);
        let factor = (u[1] * (2.0 - k) / (1.0 + d)).sqrt();
        let x = x * factor * [1.0, 1.0, -1.0, -1.0][quadrant];
        let y = y * factor * [1.0, -1.0, -1.0, 1.0][quadrant];
        core::array::from_fn(|i| self.axes[0][i] * x + self.axes[1][i] * y + self.axes[2][i] * (1.0 - k))
    }
}

impl Ellipse {
    /// How far a direction is outside of the cone, in radians, to first order; negative inside.
    #[must_use]
    pub fn beyond(&self, w: V3) -> f64 {
        let [x, y, z] = self.axes.map(|axis| crate::vectors::dot(axis, w));
        if z <= 0.0 {
            return FRAC_PI_2;
        }
        let tangents = [0, 1].map(|k| self.sines[k] / self.cosines[k]);
        let (x, y) = (x / z / tangents[0], y / z / tangents[1]);
        let (outside, slope) = (x * x + y * y - 1.0, 2.0 * (x / tangents[0]).hypot(y / tangents[1]));
        // tangents grow faster than angles
        outside / slope.max(1e-300) * z * z
    }
    /// The inverse of [`at`](Self::at) for a direction within the cone.
    #[must_use]
    pub fn place(&self, w: V3) -> [f64; 2] {
        let [x, y, z] = self.axes.map(|axis| crate::vectors::dot(axis, w));
        let chi = (x.abs() / self.sines[0]).atan2(y.abs() / self.sines[1]);
        let (s, c) = chi.sin_cos();
        let (a, b) = (self.sines[0] * s, self.sines[1] * c);
        // 1−cosθ, without cancellation
        let k = (x * x + y * y) / (1.0 + z);
        let last = self.panels[self.panels.len() - 1][1];
        let i = self.panels.iter().position(|p| p[0] >= chi).unwrap_or(self.panels.len() - 1).max(1);
        let [low, before] = self.panels[i - 1];
        let part = (before + integral(&self.nodes, low, chi, |chi| 1.0 / (1.0 + self.rim(chi)))) / last;
        let u0 = match (x >= 0.0, y >= 0.0) {
            (true, true) => part,
            (true, false) => 2.0 - part,
            (false, false) => 2.0 + part,
            (false, true) => 4.0 - part,
        };
        [0.25 * u0, k * (1.0 + self.rim(chi)) / (a * a + b * b)]
    }
}

/// Projected solid angle of the part of a disk with the unit normal `m` that is above the horizon of the unit vector `n`: half of Lambert's
/// integral n · (w × dw) around it, along an arc of the rim and the chord between its ends.
#[must_use]
pub fn projected_disk(center: V3, m: V3, radius: f64, n: V3) -> f64 {
    use crate::vectors::{along, basis, cross, dot, length, unit};
    // the rim, from the point that is nearest to the shading point
    let aside = along(m.map(|x| x * dot(center, m)), center, -1.0);
    let e = if length(aside) > 1e-12 * length(center) { unit(aside) } else { basis(m).0 };
    let g = cross(m, e);
    let rim = |t: f64| along(along(center, e, radius * t.cos()), g, radius * t.sin());
    // its height above the horizon is that of the centre and a cosine of t − middle
    let [x, y] = [dot(n, e), dot(n, g)];
    let (height, swing, middle) = (dot(n, center), radius * x.hypot(y), y.atan2(x));
    if height + swing <= 0.0 {
        return 0.0;
    }
    let half = if height >= swing { PI } else { (-height / swing).acos() };
    let [first, last] = [middle - half, middle + half];
    // finer towards the nearest point, where the integrand of a large disk has a peak
    let steps = (0..40).flat_map(|k| [0.5_f64.powi(k), -0.5_f64.powi(k)].map(|x| x * PI)).chain([0.0]);
    let mut ends: Vec<f64> = steps.flat_map(|t| [t - 2.0 * PI, t, t + 2.0 * PI]).collect();
    ends.retain(|t| first < *t && *t < last);
    ends.extend([first, last]);
    ends.sort_by(f64::total_cmp);
    let nodes = gauss_legendre();
    let along_rim = |t: f64| {
        let (p, slope) = (rim(t), along(e.map(|x| -x * radius * t.sin()), g, radius * t.cos()));
        dot(n, cross(p, slope)) / dot(p, p)
    };
    let arc: f64 = ends.windows(2).map(|t| integral(&nodes, t[0], t[1], along_rim)).sum();
    let (from, to) = (rim(last), rim(first));
    let normal = cross(from, to);
    let chord = if height >= swing { 0.0 } else { length(normal).atan2(dot(from, to)) * dot(normal, n).signum() };
    0.5 * (arc + chord).abs()
}

/// One end of an [`Arc`]: its direction, the tangent towards the other end, and sinγ and cosθ there with their derivatives by the angle.
#[derive(Clone, Copy, Debug)]
struct End {
    way: V3,
    turn: V3,
    sine: [f64; 2],
    cosine: [f64; 2],
    half: f64,
}
impl End {
    /// sinγ cosθ at angle x from this end.
    fn product(&self, x: f64) -> f64 {
        let (s, c) = x.sin_cos();
        ((self.sine[0] * c + self.sine[1] * s) * (self.cosine[0] * c + self.cosine[1] * s)).max(0.0)
    }
}

/// The arc of a segment as seen from the point, possibly clipped to a horizon.
#[derive(Clone, Copy, Debug)]
pub struct Arc {
    ends: [End; 2],
    /// Angle that the segment subtends, in radians.
    pub angle: f64,
    /// Unit vector along the perpendicular to the line.
    pub foot: V3,
    nodes: [(f64, f64); 16],
    /// ∫ sinγ cosθ over the arc.
    pub whole: f64,
}
impl Arc {
    /// The arc from `a` to `a + edge`, clipped to the horizon of a normal if given.
    #[must_use]
    pub fn new(a: Dd3, edge: Dd3, normal: Option<Dd3>) -> Self {
        let b = add(a, edge);
        let plane = cross(a, edge);
        let (mut from, mut to) = (a, b);
        let mut seen = length(plane).to_f64() > 0.0;
        if let Some(n) = normal {
            let (low, high) = (dot(a, n), dot(b, n));
            let there = |part: Dd| add(a, times(edge, part));
            let crosses = (low.to_f64() < 0.0) != (high.to_f64() < 0.0);
            if crosses && low.to_f64() < 0.0 {
                from = there(low / (low - high));
            } else if crosses {
                to = there(low / (low - high));
            }
            seen &= low.to_f64() > 0.0 || high.to_f64() > 0.0;
        }
        let pole = normalized(plane);
        let foot = normalized(cross(edge, plane));
        let n = normal.map_or([Dd::default(); 3], normalized);
        let end = |p: Dd3, sign: f64| {
            let way = normalized(p);
            let turn = times(cross(pole, way), Dd::from(sign));
            // exactly on the horizon
            let height = dot(way, n).to_f64();
            let cosine = [if height < 1e-25 { 0.0 } else { height }, dot(turn, n).to_f64()];
            let sine = [(length(plane) / (length(p) * length(edge))).to_f64(), dot(turn, foot).to_f64()];
            End { way: narrow(way), turn: narrow(turn), sine, cosine, half: 0.0 }
        };
        let angle = length(cross(from, to)).atan2(dot(from, to)).to_f64();
        let mut this = Self {
            ends: [end(from, 1.0), end(to, -1.0)],
            angle: if seen { angle } else { 0.0 },
            foot: narrow(foot),
            nodes: gauss_legendre(),
            whole: 0.0,
        };
        let halves = [0, 1].map(|i| this.up_to(i, 0.5 * this.angle));
        this.ends[0].half = halves[0];
        this.ends[1].half = halves[1];
        this.whole = halves[0] + halves[1];
        this
    }
    fn up_to(&self, end: usize, x: f64) -> f64 {
        integral(&self.nodes, 0.0, x, |x| self.ends[end].product(x))
    }
    /// Angle from the first end up to which the integral is the fraction `u` of the whole.
    #[must_use]
    pub fn angle_of(&self, u: f64) -> f64 {
        let near = u * self.whole <= self.ends[0].half;
        let (end, target) = if near { (0, u * self.whole) } else { (1, (1.0 - u) * self.whole) };
        let x = root(0.5 * self.angle, self.ends[end].half, target, |x| self.up_to(end, x));
        if near { x } else { self.angle - x }
    }
    /// The direction at an angle from the first end.
    #[must_use]
    pub fn at(&self, x: f64) -> V3 {
        let near = x <= 0.5 * self.angle;
        let (end, x) = if near { (&self.ends[0], x) } else { (&self.ends[1], self.angle - x) };
        let (s, c) = x.sin_cos();
        core::array::from_fn(|i| end.way[i] * c + end.turn[i] * s)
    }
    /// Angle of a direction from the first end.
    #[must_use]
    pub fn angle_to(&self, w: V3) -> f64 {
        let [first, last] = [0, 1].map(|i| {
            let End { way, turn, .. } = &self.ends[i];
            crate::vectors::dot(w, *turn).atan2(crate::vectors::dot(w, *way))
        });
        if first <= 0.5 * self.angle { first } else { self.angle - last }
    }
    /// sinγ cosθ at an angle from the first end.
    #[must_use]
    pub fn product(&self, x: f64) -> f64 {
        if x <= 0.5 * self.angle { self.ends[0].product(x) } else { self.ends[1].product(self.angle - x) }
    }
}
