//! What a light looks like from a point, by definition, in f64 and 106 bits: its directions, solid angle, irradiance and densities. Nothing
//! here calls a sampler.

use crate::area_lights::{AreaLight, LightShape, Measure};
use core::cell::OnceCell;
use core::f64::consts::{PI, TAU};
use etendue_oracle::curves::{Ellipse, projected_disk};
use etendue_oracle::double_double::{Dd, Dd3, dd, determinant};
use etendue_oracle::flat::Fan;
use etendue_oracle::{
    V3, above_horizon, along, basis, cap, cross, dot, lambert, length, projected_cap, sub, unit, wide,
};

/// Cells per dimension of the unit square in which densities are evaluated.
pub const SIDE: usize = 32;

/// Middles of the cells of the unit square.
pub fn middles() -> impl Iterator<Item = [f64; 2]> + Clone {
    let at = |i: usize| (i as f64 + 0.5) / SIDE as f64;
    (0..SIDE * SIDE).map(move |i| [at(i % SIDE), at(i / SIDE)])
}

/// A map of the unit square onto the directions of a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Chart {
    /// Uniform by solid angle.
    SolidAngle,
    /// Uniform by area, over what is seen of it.
    Area,
}

#[derive(Clone, Debug)]
enum Body {
    Sphere {
        center: V3,
        radius: f64,
        axes: [V3; 3],
        one_minus_cos: f64,
        sigma: f64,
    },
    /// A triangle is one fan; a parallelogram is two about the corner. Corners go around.
    Flat {
        fans: Vec<Fan>,
        corners: Vec<V3>,
        edges: [V3; 2],
        exact: Vec<Dd3>,
    },
    Disk {
        center: V3,
        normal: V3,
        radius: f64,
        cone: Box<Ellipse>,
    },
}

/// A light as it is seen from a point.
#[derive(Clone, Debug)]
pub struct Definition {
    body: Body,
    normal: V3,
    grid: OnceCell<Vec<V3>>,
    lit: OnceCell<f64>,
    /// Solid angle, in steradians.
    pub solid_angle: f64,
    /// Greatest angle between two directions to the light, and the width across that, in radians.
    pub size: [f64; 2],
    /// Area of the surface, in squared units of length.
    pub area: f64,
    /// Part of the area that is seen.
    seen: f64,
    /// Greatest distance of a point of the light, in units of length.
    pub farthest: f64,
    /// Rounding of the coordinates, over the least distance.
    pub rounding: f64,
}

/// Where a ray meets a light.
#[derive(Clone, Copy, Debug)]
pub struct Met {
    /// In units of length.
    pub distance: f64,
    /// Cosine between the ray and the surface's normal.
    pub cosine: f64,
}

/// The angle between unit vectors, accurate if small.
fn angle(a: V3, b: V3) -> f64 {
    length(cross(a, b)).atan2(dot(a, b))
}
/// The greatest angle between a direction and those of an arc: at an end, or where the arc passes next to the opposite direction.
fn farthest(from: V3, [a, b]: [V3; 2]) -> f64 {
    let n = cross(a, b);
    let opposite = along(n.map(|x| x * dot(from, n) / dot(n, n)), from, -1.0);
    let is_between = dot(cross(a, opposite), n) > 0.0 && dot(cross(opposite, b), n) > 0.0;
    let ends = angle(from, a).max(angle(from, b));
    if is_between { ends.max(angle(from, opposite)) } else { ends }
}
fn versine(a: V3, b: V3) -> f64 {
    let d = sub(a, b);
    0.5 * dot(d, d)
}
fn turns(y: f64, x: f64) -> f64 {
    (y.atan2(x) / TAU).rem_euclid(1.0)
}
/// Solid angle of a triangle of unit vectors.
fn triangle(a: V3, b: V3, c: V3) -> f64 {
    let volume = dot(a, cross(sub(b, a), sub(c, a))).abs();
    2.0 * volume.atan2(1.0 + dot(a, b) + dot(b, c) + dot(c, a))
}

impl Definition {
    /// The light as it is seen from its shading point; `None` for shapes without a definition here.
    #[must_use]
    pub fn new(light: &AreaLight) -> Option<Self> {
        let [p, a, b, c, n] = [light.p, light.a, light.b, light.c, light.n].map(wide);
        let (from, radius) = (sub(a, p), f64::from(light.radius));
        let (body, solid_angle, greatest, area) = match light.shape {
            LightShape::Sphere => {
                let (one_minus_cos, sigma) = cap(from, radius);
                let axis = if from == [0.0; 3] { [0.0, 0.0, 1.0] } else { unit(from) };
                let (s, t) = basis(axis);
                let body = Body::Sphere { center: from, radius, axes: [s, t, axis], one_minus_cos, sigma };
                (body, TAU * one_minus_cos, (2.0 * sigma).min(PI), 2.0 * TAU * radius * radius)
            }
            LightShape::Disk => {
                let cone = Box::new(Ellipse::new(from, b, radius, |axis| basis(axis).0));
                let (solid_angle, greatest) = (cone.solid_angle(), 2.0 * cone.sines[1].min(1.0).asin());
                (
                    Body::Disk { center: from, normal: unit(b), radius, cone },
                    solid_angle,
                    greatest,
                    PI * radius * radius,
                )
            }
            LightShape::Triangle | LightShape::Parallelogram | LightShape::Rectangle | LightShape::Polygon => {
                let around = light.exact_corners();
                let fan = |i: usize, from: usize, to: usize| {
                    let edge = |k: usize| core::array::from_fn(|axis| around[k][axis] - around[i][axis]);
                    Fan::new(around[i], edge(from), edge(to))
                };
                let fans = if around.len() == 3 { vec![fan(0, 1, 2)] } else { vec![fan(1, 0, 2), fan(2, 0, 3)] };
                let corners: Vec<V3> = around.iter().map(|v| v.map(Dd::to_f64)).collect();
                let units: Vec<V3> = corners.iter().copied().map(unit).collect();
                let n = units.len();
                let sides = (0..n).map(|i| [units[i], units[(i + 1) % n]]);
                let pairs = sides.flat_map(|side| units.iter().map(move |corner| farthest(*corner, side)));
                let greatest = pairs.fold(0.0, f64::max);
                let area = length(cross(b, c)) * if around.len() == 3 { 0.5 } else { 1.0 };
                let solid_angle = fans.iter().map(Fan::solid_angle).sum();
                (Body::Flat { fans, corners, edges: [b, c], exact: around }, solid_angle, greatest, area)
            }
            _ => return None,
        };
        let (mut nearest, mut farthest) = (length(from), length(from) + radius);
        let mut seen = 1.0;
        match &body {
            Body::Flat { corners, .. } => {
                nearest = corners.iter().copied().map(length).fold(f64::INFINITY, f64::min);
                farthest = corners.iter().copied().map(length).fold(0.0, f64::max);
            }
            Body::Sphere { radius, .. } if nearest > *radius => {
                seen = 0.5 * (nearest - radius) / nearest;
                nearest -= radius;
            }
            Body::Sphere { .. } => nearest = (radius - nearest).abs(),
            Body::Disk { .. } => {}
        }
        let coordinate = [p, a].concat().into_iter().map(f64::abs).fold(0.0, f64::max);
        let rounding = coordinate / 16_777_216.0 / nearest.max(1e-300);
        let size = [greatest, (solid_angle / greatest).min(greatest)];
        Some(Self {
            body,
            normal: unit(n),
            grid: OnceCell::new(),
            lit: OnceCell::new(),
            solid_angle,
            size,
            area,
            seen,
            farthest,
            rounding,
        })
    }

    /// Corners of a flat light relative to the point, in order.
    #[must_use]
    pub fn corners(&self) -> &[V3] {
        if let Body::Flat { corners, .. } = &self.body { corners } else { &[] }
    }
    /// Whether the corners of a flat light all turn the same way, as seen from the point: rounding them may leave a polygon that is none.
    #[must_use]
    pub fn is_convex(&self) -> bool {
        let Body::Flat { exact, .. } = &self.body else { return true };
        let n = exact.len();
        let turn = |i: usize| determinant(exact[i], exact[(i + 1) % n], exact[(i + 2) % n]).to_f64();
        n == 3 || (0..n).all(|i| turn(i) >= 0.0) != (0..n).all(|i| turn(i) <= 0.0)
    }
    /// Whether the point is inside of the light.
    #[must_use]
    pub fn is_inside(&self) -> bool {
        matches!(self.body, Body::Sphere { sigma, .. } if sigma > 3.0)
    }

    /// The direction at a point of the unit square, and steradians per unit of the square there.
    #[must_use]
    pub fn at(&self, chart: Chart, u: [f64; 2]) -> (V3, f64) {
        if chart == Chart::SolidAngle {
            return (self.by_solid_angle(u), self.solid_angle);
        }
        let (sine, cosine) = (TAU * u[1]).sin_cos();
        let point = match &self.body {
            Body::Sphere { center, radius, axes: [s, t, axis], .. } => {
                // 1 − cosine of the angle at the centre, from the direction of the point
                let k = 2.0 * self.seen * u[0];
                let across = (k * (2.0 - k)).sqrt() * radius;
                let back = along(*center, *axis, -radius * (1.0 - k));
                along(along(back, *s, across * cosine), *t, across * sine)
            }
            Body::Flat { corners, edges: [b, c], .. } => {
                let (x, y) =
                    if corners.len() == 3 { (u[0].sqrt() * (1.0 - u[1]), u[0].sqrt() * u[1]) } else { (u[0], u[1]) };
                along(along(corners[0], *b, x), *c, y)
            }
            Body::Disk { center, normal, radius, .. } => {
                let ((s, t), r) = (basis(*normal), radius * u[0].sqrt());
                along(along(*center, s, r * cosine), t, r * sine)
            }
        };
        let w = unit(point);
        (w, self.steradians(chart, w))
    }
    fn by_solid_angle(&self, u: [f64; 2]) -> V3 {
        match &self.body {
            Body::Sphere { axes: [s, t, axis], one_minus_cos, .. } => {
                let k = u[0] * one_minus_cos;
                let (across, (sine, cosine)) = ((k * (2.0 - k)).sqrt(), (TAU * u[1]).sin_cos());
                along(along(axis.map(|x| x * (1.0 - k)), *s, across * cosine), *t, across * sine)
            }
            Body::Flat { fans, .. } => {
                let mut rest = u[0] * self.solid_angle;
                for fan in fans {
                    if rest <= fan.solid_angle() || core::ptr::eq(fan, &fans[fans.len() - 1]) {
                        return fan.at((Dd::from((rest / fan.solid_angle()).clamp(0.0, 1.0)), u[1]));
                    }
                    rest -= fan.solid_angle();
                }
                unreachable!("the last fan takes the rest")
            }
            Body::Disk { cone, .. } => cone.at(u),
        }
    }
    /// Steradians per unit of the square, in a direction of the light.
    #[must_use]
    pub fn steradians(&self, chart: Chart, w: V3) -> f64 {
        match (chart, self.met(w)) {
            (Chart::SolidAngle, _) => self.solid_angle,
            (Chart::Area, Some(met)) => self.seen * self.area * met.cosine / (met.distance * met.distance),
            (Chart::Area, None) => 0.0,
        }
    }
    /// The point of the unit square for a direction, the nearest one if that is outside of the light.
    #[must_use]
    pub fn place(&self, chart: Chart, w: V3) -> [f64; 2] {
        let place = match (&self.body, chart) {
            (Body::Sphere { axes: [s, t, axis], one_minus_cos, .. }, Chart::SolidAngle) => {
                [versine(w, *axis) / one_minus_cos, turns(dot(w, *t), dot(w, *s))]
            }
            (Body::Sphere { center, axes: [s, t, axis], .. }, Chart::Area) => {
                let distance = self.met(w).map_or(length(*center), |met| met.distance);
                let out = unit(along(center.map(|x| -x), w, distance));
                let k = versine(out, axis.map(|x| -x));
                [k / (2.0 * self.seen), turns(dot(w, *t), dot(w, *s))]
            }
            (Body::Flat { corners, .. }, Chart::Area) => {
                let [x, y] = self.coordinates(w);
                if corners.len() == 3 { [(x + y) * (x + y), y / (x + y).max(1e-300)] } else { [x, y] }
            }
            (Body::Flat { corners, fans, .. }, Chart::SolidAngle) => {
                let [x, y] = self.coordinates(w);
                let apex = unit(corners[usize::from(fans.len() == 1)]);
                let second = fans.len() == 2 && y > x;
                let [a, c] = match (fans.len(), second) {
                    (1, _) => [corners[0], corners[2]],
                    (_, false) => [corners[1], corners[2]],
                    (_, true) => [corners[2], corners[3]],
                }
                .map(unit);
                let swept = unit(cross(cross(apex, w), cross(a, c)));
                let swept = if dot(swept, along(a, c, 1.0)) < 0.0 { swept.map(|x| -x) } else { swept };
                let before = if second { fans[0].solid_angle() } else { 0.0 };
                [(before + triangle(a, apex, swept)) / self.solid_angle, versine(apex, w) / versine(apex, swept)]
            }
            (Body::Disk { center, normal, radius, .. }, Chart::Area) => {
                let (s, t) = basis(*normal);
                let aside = sub(w.map(|x| x * dot(*center, *normal) / dot(w, *normal)), *center);
                let (x, y) = (dot(aside, s) / radius, dot(aside, t) / radius);
                [x * x + y * y, turns(y, x)]
            }
            (Body::Disk { cone, .. }, Chart::SolidAngle) => cone.place(w),
        };
        place.map(|x| if x.is_finite() { x.clamp(0.0, 1.0) } else { 0.5 })
    }
    /// Coordinates of a direction along the two edges of a flat light.
    fn coordinates(&self, w: V3) -> [f64; 2] {
        let Body::Flat { corners, edges: [b, c], .. } = &self.body else { return [0.5; 2] };
        let normal = cross(*b, *c);
        let aside = sub(w.map(|x| x * dot(corners[0], normal) / dot(w, normal)), corners[0]);
        let squared = dot(normal, normal);
        [dot(cross(aside, *c), normal) / squared, dot(cross(*b, aside), normal) / squared]
    }

    /// Where a ray in the direction meets the light, or its plane if the direction is beside it.
    #[must_use]
    pub fn met(&self, w: V3) -> Option<Met> {
        match &self.body {
            Body::Sphere { center, radius, .. } => {
                let (near, aside) = (dot(*center, w), length(cross(*center, w)));
                let half = ((radius - aside) * (radius + aside)).max(0.0).sqrt();
                let d = length(*center);
                // the product of both roots is the power of the point
                let distance = if d > *radius { (d - radius) * (d + radius) / (near + half) } else { near + half };
                (distance > 0.0).then_some(Met { distance, cosine: half / radius })
            }
            Body::Flat { corners, edges: [b, c], .. } => plane(corners[0], cross(*b, *c), w),
            Body::Disk { center, normal, .. } => plane(*center, *normal, w),
        }
    }
    /// How far a direction is outside of the light, in radians; 0 inside.
    #[must_use]
    pub fn beyond(&self, w: V3) -> f64 {
        self.from_edge(w).max(0.0)
    }
    /// The angle between a direction and the light's boundary, in radians; negative inside.
    #[must_use]
    pub fn from_edge(&self, w: V3) -> f64 {
        match &self.body {
            Body::Sphere { axes, sigma, .. } => angle(w, axes[2]) - sigma,
            Body::Flat { corners, .. } => {
                let middle = corners.iter().fold([0.0; 3], |sum, c| along(sum, *c, 1.0));
                if dot(w, middle) <= 0.0 && self.size[0] < 1.5 {
                    return PI;
                }
                let n = corners.len();
                let side = |i: usize| {
                    let normal = unit(cross(corners[i], sub(corners[(i + 1) % n], corners[i])));
                    -dot(normal, w) * dot(normal, middle).signum()
                };
                (0..n).map(side).fold(f64::NEG_INFINITY, f64::max)
            }
            Body::Disk { cone, .. } => cone.beyond(w),
        }
    }
    /// How far beyond the light's boundary, in radians, a direction may still meet it in single precision.
    ///
    /// A hit is tested within the light's plane. The direction's own rounding (four units), that of its product with the plane's normal (three), of
    /// the plane's distance (three) and of the difference to the light's middle (two) move the point at which it meets the plane by twelve
    /// units over the sine of the angle between them, relative to the light's distance; the light's size is measured from its middle, and adds
    /// to that distance. The test tells directions beside the light no better than those above it.
    #[must_use]
    pub fn blur(&self, w: V3) -> f64 {
        let (normal, middle, reach) = match &self.body {
            Body::Sphere { .. } => return 0.0,
            Body::Flat { corners, edges: [b, c], .. } => (unit(cross(*b, *c)), corners[0], length(*b).max(length(*c))),
            Body::Disk { center, normal, radius, .. } => (*normal, *center, *radius),
        };
        12.0 / 16_777_216.0 * (1.0 + reach / length(middle)) / dot(w, normal).abs()
    }
    /// Directions for means by solid angle: those of the middles of the square's cells. Spheres have more of them towards their limb, where
    /// densities by area grow without bound.
    #[must_use]
    pub fn grid(&self) -> &[V3] {
        let graded = |[x, y]: [f64; 2]| if self.has_limb() { [x * (2.0 - x), y] } else { [x, y] };
        self.grid.get_or_init(|| middles().map(|u| self.by_solid_angle(graded(u))).collect())
    }
    /// What each direction of the grid counts, 1 in the mean.
    pub fn weights(&self) -> impl Iterator<Item = f64> + Clone {
        middles().map(|[x, _]| if self.has_limb() { 2.0 * (1.0 - x) } else { 1.0 })
    }
    /// Whether the surface turns away from the point at the light's boundary.
    #[must_use]
    pub fn has_limb(&self) -> bool {
        matches!(self.body, Body::Sphere { .. })
    }
    /// The u₀ at which that grid goes over from one of two triangles to the other one.
    #[must_use]
    pub fn seam(&self) -> Option<f64> {
        match &self.body {
            Body::Flat { fans, .. } if fans.len() == 2 => Some(fans[0].solid_angle() / self.solid_angle),
            _ => None,
        }
    }
    /// Irradiance of a receiver with the unit normal `n`, per unit of radiance.
    #[must_use]
    pub fn irradiance(&self, n: V3) -> f64 {
        if n == self.normal { *self.lit.get_or_init(|| self.projected(n)) } else { self.projected(n) }
    }
    fn projected(&self, n: V3) -> f64 {
        match &self.body {
            Body::Sphere { center, radius, .. } => projected_cap(*center, *radius, n),
            Body::Flat { exact, .. } => {
                let above = above_horizon(exact, dd(n));
                if above.len() < 3 { 0.0 } else { lambert(&above, dd(n)).max(0.0) }
            }
            Body::Disk { center, normal, radius, .. } => projected_disk(*center, *normal, *radius, n),
        }
    }
    /// Normal of the receiver.
    #[must_use]
    pub fn normal(&self) -> V3 {
        self.normal
    }
    /// Density per steradian of a measure in a direction of the light; `None` if the measure says nothing of it.
    #[must_use]
    pub fn density(&self, by: Measure, w: V3) -> Option<f64> {
        match by {
            Measure::SolidAngle => Some(1.0 / self.solid_angle),
            Measure::ProjectedSolidAngle => Some(dot(w, self.normal).max(0.0) / self.irradiance(self.normal)),
            Measure::Area => {
                let met = self.met(w)?;
                (met.cosine > 0.0).then_some(met.distance * met.distance / (self.area * met.cosine))
            }
            Measure::Delta | Measure::Other => None,
        }
    }
    /// Relative change of a density per radian that its direction turns.
    #[must_use]
    pub fn steepness(&self, by: Measure, w: V3) -> f64 {
        match (by, self.met(w)) {
            (Measure::SolidAngle, _) => 0.0,
            (Measure::ProjectedSolidAngle, _) => 1.0 / dot(w, self.normal).abs().max(1e-300),
            // the distance and the cosine turn by 1/cosine each, a sphere's normal by the distance over the radius besides
            (_, Some(met)) => {
                let curved = match &self.body {
                    Body::Sphere { radius, .. } => met.distance / radius,
                    _ => 0.0,
                };
                let cosine = met.cosine.max(1e-300);
                (3.0 + curved) / cosine / cosine.min(1.0)
            }
            (_, None) => f64::INFINITY,
        }
    }
}

fn plane(point: V3, normal: V3, w: V3) -> Option<Met> {
    let (height, slope) = (dot(point, normal), dot(w, normal));
    let met = Met { distance: height / slope, cosine: slope.abs() / length(normal) };
    (slope != 0.0 && met.distance > 0.0).then_some(met)
}
