//! What is true of a shape seen from a point: solid angles, densities and the maps themselves in 106 bits. Nothing here calls the bodies
//! under test, but for the directions of projected shapes (see [`Truth::direction`]).

use super::curves::{Arc, Ellipse};
use super::double_double::{Dd, Dd3, above_horizon, cross, dot, lambert};
use super::pose::{Kind, Pose, Shape, V3, unit, wide};
use core::f64::consts::{FRAC_PI_2, PI, TAU};
use etendue::seen::{ProjectedCap, ProjectedPolygon, ProjectedTriangle};
use etendue::warp::ConcentricDisk;
use etendue::{Frame, Vec2, Vec3, Warp};

pub(super) fn dd(a: V3) -> Dd3 {
    a.map(Dd::from)
}
pub(super) fn add(a: Dd3, b: Dd3) -> Dd3 {
    core::array::from_fn(|i| a[i] + b[i])
}
pub(super) fn times(a: Dd3, s: Dd) -> Dd3 {
    a.map(|x| x * s)
}
pub(super) fn length(a: Dd3) -> Dd {
    dot(a, a).sqrt()
}
pub(super) fn normalized(a: Dd3) -> Dd3 {
    let l = length(a);
    if l.to_f64() > 0.0 { a.map(|x| x / l) } else { a }
}
pub(super) fn narrow(a: Dd3) -> V3 {
    a.map(Dd::to_f64)
}

/// Solid angle of a triangle with the corners a, b, c, whose a·(b×c) is known, by Van Oosterom and Strackee.
fn solid_angle(a: Dd3, b: Dd3, c: Dd3, volume: Dd) -> Dd {
    let [la, lb, lc] = [a, b, c].map(length);
    let under = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    Dd::from(2.0) * volume.abs().atan2(under)
}

/// A triangle and Arvo's map about its vertex `v1`: the area swept from `v0` is u₀Ω, 1−cos of the angle from `v1` is u₁ of the whole.
#[derive(Clone, Debug)]
pub struct Fan {
    units: [Dd3; 3],
    /// tan(Ω/2) = g0/(g1+g2)
    g: [Dd; 3],
    solid_angle: Dd,
}
impl Fan {
    /// From a vertex and the edges to the two others.
    #[must_use]
    pub fn new(v0: Dd3, e1: Dd3, e2: Dd3) -> Self {
        let (v1, v2) = (add(v0, e1), add(v0, e2));
        // of edges: a small triangle's volume is a product, not a difference
        let volume = dot(v0, cross(e1, e2));
        let units = [v0, v1, v2].map(normalized);
        let lengths = length(v0) * length(v1) * length(v2);
        let one = Dd::from(1.0);
        let g0 = if lengths.to_f64() > 0.0 { volume.abs() / lengths } else { Dd::default() };
        let g = [g0, dot(add(units[0], units[1]), units[2]), one + dot(units[0], units[1])];
        let touches = g0.to_f64() <= 0.0;
        let omega = if touches { Dd::default() } else { solid_angle(v0, v1, v2, volume) };
        Self { units, g, solid_angle: omega }
    }
    /// In steradians.
    #[must_use]
    pub fn solid_angle(&self) -> f64 {
        self.solid_angle.to_f64()
    }
    /// The unit vector to the point of the edge `v0 v2` for `u₀`.
    #[must_use]
    pub fn swept(&self, u0: Dd) -> Dd3 {
        // near v2 what is left is small
        let (s, c) = (Dd::from(0.5) * u0 * self.solid_angle).sin_cos();
        let [a, _, b] = self.units;
        let alpha = self.g[0] * c - self.g[1] * s;
        let beta = self.g[2] * s;
        let both = beta * (alpha + beta * dot(a, b));
        normalized(add(times(a, (alpha - beta) * (alpha + beta)), times(b, both + both)))
    }
    /// The direction for `u`.
    #[must_use]
    pub fn at(&self, u: (Dd, f64)) -> V3 {
        let (p, apex) = (self.swept(u.0), self.units[1]);
        let (normal, cos) = (cross(apex, p), dot(apex, p));
        let one = Dd::from(1.0);
        let versine = if cos.to_f64() > 0.0 { dot(normal, normal) / (one + cos) } else { one - cos };
        let k = Dd::from(u.1) * versine;
        let tangent = normalized(cross(normal, apex));
        let sin = (k * (Dd::from(2.0) - k)).sqrt();
        narrow(add(times(apex, one - k), times(tangent, sin)))
    }
    /// Of the part of it that `u₀` has swept, from the point that [`swept`](Self::swept) gives: u₀Ω if the map is right.
    #[must_use]
    pub fn area_swept(&self, u0: f64) -> f64 {
        let p = self.swept(Dd::from(u0));
        let [a, b, _] = self.units;
        solid_angle(a, b, p, dot(p, cross(a, b))).to_f64()
    }
}

/// A rectangle, and the map of Ureña et al.: the strip up to x has the solid angle u₀Ω, y/√(x²+y²+z²) is linear in u₁.
#[derive(Clone, Debug)]
pub struct Window {
    corner: Dd3,
    axes: [Dd3; 2],
    near: [Dd; 2],
    size: [Dd; 2],
    height: Dd,
    solid_angle: f64,
}
impl Window {
    fn new(p: Dd3, u: Dd3, v: Dd3) -> Self {
        let axes = [normalized(u), normalized(v)];
        let normal = normalized(cross(u, v));
        let near = axes.map(|a| dot(p, a));
        let mut window = Self {
            corner: p,
            axes,
            near,
            size: [length(u), length(v)],
            height: dot(p, normal).abs(),
            solid_angle: 0.0,
        };
        window.solid_angle = window.strip(window.size[0]);
        window
    }
    /// Solid angle from the near side in x to `dx` beyond it.
    fn strip(&self, dx: Dd) -> f64 {
        if self.height.to_f64() <= 0.0 || dx.to_f64() <= 0.0 {
            return 0.0;
        }
        let at = |x: Dd, y: Dd| [self.near[0] + x, self.near[1] + y, self.height];
        let zero = Dd::default();
        let [a, b, c, d] = [at(zero, zero), at(dx, zero), at(dx, self.size[1]), at(zero, self.size[1])];
        let volume = self.height * dx * self.size[1];
        (solid_angle(a, b, c, volume) + solid_angle(a, c, d, volume)).to_f64()
    }
    fn at(&self, u: [f64; 2]) -> V3 {
        let target = u[0] * self.solid_angle;
        // by the angle at the foot of the perpendicular, in which the strip grows evenly
        let z = self.height;
        let (x0, x1) = (self.near[0], self.near[0] + self.size[0]);
        let turn = self.size[0] * z;
        let whole = turn.to_f64().atan2((z * z + x0 * x1).to_f64());
        // x − x₀ = (z² + x₀²) t/(z − x₀ t), t = tan of the angle from the near side
        let moved = |angle: f64| {
            let (s, c) = (Dd::from(angle.sin()), Dd::from(angle.cos()));
            let dx = (z * z + x0 * x0) * s / (z * c - x0 * s);
            if dx.to_f64() >= 0.0 && dx.to_f64() <= self.size[0].to_f64() { dx } else { self.size[0] }
        };
        let angle = root(whole, self.solid_angle, target, |angle| self.strip(moved(angle)));
        let dx = if u[0] > 0.0 { moved(angle) } else { Dd::default() };
        let x = x0 + dx;
        let d = (x * x + z * z).sqrt();
        let sine = |y: Dd| y / (d * d + y * y).sqrt();
        let (y0, y1) = (self.near[1], self.near[1] + self.size[1]);
        let h = sine(y0) + Dd::from(u[1]) * (sine(y1) - sine(y0));
        let y = d * h / (Dd::from(1.0) - h * h).sqrt();
        narrow(normalized(add(self.corner, add(times(self.axes[0], dx), times(self.axes[1], y - y0)))))
    }
}

/// Where an increasing function with f(0) = 0 and f(`end`) = `top` is `target`: false position (Illinois), and halves where that is slow.
pub(super) fn root(end: f64, top: f64, target: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, end);
    let (mut f_low, mut f_high) = (-target, top - target);
    if f_high <= 0.0 {
        return end;
    }
    for step in 0..80 {
        let width = high - low;
        let x = if step % 4 == 3 { low + 0.5 * width } else { low + width * (f_low / (f_low - f_high)) };
        let value = f(x) - target;
        if value.abs() <= 1e-15 * target || width <= 1e-15 * high {
            return x;
        }
        if value < 0.0 {
            (low, f_low) = (x, value);
            f_high *= 0.5;
        } else {
            (high, f_high) = (x, value);
            f_low *= 0.5;
        }
    }
    0.5 * (low + high)
}

/// 1−cosσ of a sphere; 2 from inside.
#[must_use]
pub fn cap(center: V3, radius: f64) -> f64 {
    let (c, r) = (dd(center), Dd::from(radius));
    let squared = dot(c, c);
    let power = squared - r * r;
    if power.to_f64() < 0.0 {
        return 2.0;
    }
    let cos = (power / squared).sqrt();
    (r * r / squared / (Dd::from(1.0) + cos)).to_f64()
}

/// Projected solid angle of a sphere above the horizon of `normal`, in closed form; π from inside.
#[must_use]
pub fn projected_cap(center: V3, radius: f64, normal: V3) -> f64 {
    let (c, r, n) = (dd(center), Dd::from(radius), dd(normal));
    let squared = dot(c, c);
    let power = squared - r * r;
    if power.to_f64() < 0.0 {
        return PI;
    }
    let (sin, cos) = (r / squared.sqrt(), (power / squared).sqrt());
    let height = dot(c, n) / (squared * dot(n, n)).sqrt();
    if (height - sin).to_f64() >= 0.0 {
        return PI * (sin * sin * height).to_f64();
    }
    if (height + sin).to_f64() <= 0.0 {
        return 0.0;
    }
    let y = ((sin - height) * (sin + height)).sqrt();
    // a thin lune is a small difference of the three
    (y.atan2(cos) + sin * sin * height * y.atan2(-(cos * height)) - y * cos).to_f64()
}

#[derive(Clone, Debug)]
enum Map {
    Cap { frame: Frame<f64>, one_minus_cos: f64 },
    Fans(Vec<Fan>),
    Window(Window),
    Disk(Box<Ellipse>),
    Line(Arc),
    Surface(Arc),
    // the f64 bodies, whose laws the tests hold to closed forms
    Lune(Box<ProjectedCap<f64>>),
    Triangle(Box<ProjectedTriangle<f64>>),
    Quad(Box<ProjectedPolygon<f64, 4>>),
    Hexagon(Box<ProjectedPolygon<f64, 6>>),
}

/// Of one pose.
#[derive(Clone, Debug)]
pub struct Truth {
    map: Map,
    /// Solid angle, or projected solid angle.
    pub measure: f64,
    /// Greatest angle between two directions to it.
    pub extent: f64,
    projected: bool,
    normal: V3,
    shape: Shape,
    kind: Kind,
}

/// Angle between unit vectors.
fn between(a: Dd3, b: Dd3) -> f64 {
    length(cross(a, b)).to_f64().atan2(dot(a, b).to_f64())
}

impl Truth {
    /// Of a kind of shape in a pose.
    #[must_use]
    pub fn new(kind: Kind, pose: &Pose) -> Self {
        let projected = kind.projected();
        let normal = unit(wide(pose.normal));
        let n = dd(wide(pose.normal));
        let vector = |v: V3| Vec3::new(v[0], v[1], v[2]);
        let (map, measure, extent) = match &pose.shape {
            Shape::Sphere { center, radius } => {
                let (c, r) = (wide(*center), f64::from(*radius));
                let h = if r > 0.0 { cap(c, r) } else { 0.0 };
                let sigma = if h >= 2.0 { FRAC_PI_2 } else { (h * (2.0 - h)).sqrt().atan2(1.0 - h) };
                if projected {
                    let body = ProjectedCap::new(vector(c), r, vector(wide(pose.normal)));
                    (Map::Lune(Box::new(body)), projected_cap(c, r, wide(pose.normal)), 2.0 * sigma)
                } else {
                    let axis = if c == [0.0; 3] { [0.0, 0.0, 1.0] } else { unit(c) };
                    let frame = Frame::new(Vec3::new(axis[0], axis[1], axis[2]));
                    (Map::Cap { frame, one_minus_cos: h }, TAU * h, 2.0 * sigma)
                }
            }
            Shape::Disk { center, normal, radius } => {
                let ellipse = Ellipse::new(wide(*center), wide(*normal), f64::from(*radius));
                let (measure, extent) = (ellipse.solid_angle(), 2.0 * ellipse.sines[1].min(1.0).asin());
                (Map::Disk(Box::new(ellipse)), measure, extent)
            }
            Shape::Segment { a, edge } => {
                let (a, edge) = (dd(wide(*a)), dd(wide(*edge)));
                let arc = Arc::new(a, edge, projected.then_some(n));
                let (measure, extent) = if projected { (arc.whole, arc.angle) } else { (arc.angle, arc.angle) };
                (if projected { Map::Surface(arc) } else { Map::Line(arc) }, measure, extent)
            }
            Shape::Flat { p, u, v } => {
                let wide_normal = vector(wide(pose.normal));
                let (pw, uw, vw) = (vector(wide(*p)), vector(wide(*u)), vector(wide(*v)));
                let (p, u, v) = (dd(wide(*p)), dd(wide(*u)), dd(wide(*v)));
                let minus = |a: Dd3| a.map(|x| -x);
                let (pu, puv, pv) = (add(p, u), add(add(p, u), v), add(p, v));
                match kind {
                    Kind::Rectangle => {
                        let window = Window::new(p, u, v);
                        let measure = window.solid_angle;
                        (Map::Window(window), measure, widest(&[p, pu, puv, pv]))
                    }
                    Kind::Triangle => {
                        let fan = Fan::new(p, u, v);
                        let measure = fan.solid_angle();
                        (Map::Fans(vec![fan]), measure, widest(&[p, pu, pv]))
                    }
                    Kind::ProjectedTriangle => {
                        let body = ProjectedTriangle::with_edges(pw, pw + uw, pw + vw, uw, vw, wide_normal);
                        let corners = [p, pu, pv];
                        let measure = lambert(&above_horizon(&corners, n), n);
                        (Map::Triangle(Box::new(body)), measure, widest(&corners))
                    }
                    Kind::ProjectedParallelogram => {
                        let body = ProjectedPolygon::parallelogram(pw, uw, vw, wide_normal);
                        let corners = [p, pu, puv, pv];
                        let measure = lambert(&above_horizon(&corners, n), n);
                        (Map::Quad(Box::new(body)), measure, widest(&corners))
                    }
                    _ => {
                        let fans = vec![Fan::new(pu, minus(u), v), Fan::new(puv, minus(add(u, v)), minus(u))];
                        let measure = fans.iter().map(Fan::solid_angle).sum();
                        (Map::Fans(fans), measure, widest(&[p, pu, puv, pv]))
                    }
                }
            }
            Shape::Corners(corners) => {
                let c = corners.map(|c| dd(wide(c)));
                if projected {
                    let body = ProjectedPolygon::new(corners.map(|c| vector(wide(c))), vector(wide(pose.normal)));
                    let measure = lambert(&above_horizon(&c, n), n);
                    return Self {
                        map: Map::Hexagon(Box::new(body)),
                        measure,
                        extent: widest(&c),
                        projected,
                        normal,
                        shape: pose.shape.clone(),
                        kind,
                    };
                }
                let edge = |from: Dd3, to: Dd3| add(to, from.map(|x| -x));
                let fans: Vec<_> = (1..5).map(|i| Fan::new(c[i], edge(c[i], c[0]), edge(c[i], c[i + 1]))).collect();
                let measure = fans.iter().map(Fan::solid_angle).sum();
                (Map::Fans(fans), measure, widest(&c))
            }
        };
        Self { map, measure, extent, projected, normal, shape: pose.shape.clone(), kind }
    }

    /// The direction for `u`, computed from the map's definition; but of projected spheres, triangles, parallelograms and polygons it is
    /// that of the f64 body, whose density the laws of the tests hold to the closed form.
    #[must_use]
    pub fn direction(&self, u: [f64; 2]) -> V3 {
        match &self.map {
            Map::Cap { frame, one_minus_cos } => {
                let k = u[0] * one_minus_cos;
                let sin = (k * (2.0 - k)).sqrt();
                let (s, c) = (TAU * u[1]).sin_cos();
                let w = frame.to_world(Vec3::new(sin * c, sin * s, 1.0 - k));
                [w.x, w.y, w.z]
            }
            Map::Fans(fans) => {
                let whole = fans.iter().fold(Dd::default(), |sum, f| sum + f.solid_angle);
                let mut rest = Dd::from(u[0]) * whole;
                let last = fans.iter().rposition(|f| f.solid_angle() > 0.0).unwrap_or(0);
                for (i, fan) in fans.iter().enumerate() {
                    let beyond = (rest - fan.solid_angle).to_f64();
                    if i == last || beyond < 0.0 {
                        let part = if fan.solid_angle() > 0.0 { rest / fan.solid_angle } else { Dd::default() };
                        return fan.at((part, u[1]));
                    }
                    rest = rest - fan.solid_angle;
                }
                [0.0, 0.0, 1.0]
            }
            Map::Window(window) => window.at(u),
            Map::Disk(ellipse) => ellipse.at(u),
            Map::Line(arc) => arc.at(u[0] * arc.angle),
            Map::Surface(arc) => arc.at(arc.angle_of(u[0])),
            Map::Lune(body) => sampled(&**body, u),
            Map::Triangle(body) => sampled(&**body, u),
            Map::Quad(body) => sampled(&**body, u),
            Map::Hexagon(body) => sampled(&**body, u),
        }
    }

    /// Has it one dimension?
    #[must_use]
    pub fn line(&self) -> bool {
        self.kind.line()
    }
    /// Unit vector to the middle of the shape.
    #[must_use]
    pub fn towards(&self) -> V3 {
        let middle = match &self.shape {
            Shape::Sphere { center, .. } | Shape::Disk { center, .. } => wide(*center),
            Shape::Flat { p, u, v } => {
                let part = if matches!(self.kind, Kind::Triangle | Kind::ProjectedTriangle) { 1.0 / 3.0 } else { 0.5 };
                core::array::from_fn(|i| f64::from(p[i]) + part * (f64::from(u[i]) + f64::from(v[i])))
            }
            Shape::Corners(c) => core::array::from_fn(|i| c.iter().map(|c| f64::from(c[i])).sum::<f64>()),
            Shape::Segment { a, edge } => core::array::from_fn(|i| f64::from(a[i]) + 0.5 * f64::from(edge[i])),
        };
        if middle == [0.0; 3] { self.normal } else { unit(middle) }
    }

    /// Is a coordinate of u an azimuth?
    #[must_use]
    pub fn periodic(&self, axis: usize) -> bool {
        matches!((&self.map, axis), (Map::Cap { .. }, 1) | (Map::Disk(_), 0))
    }

    /// The density at a direction of the shape: its value, and by how much an error of the direction changes it, per radian.
    #[must_use]
    pub fn density(&self, w: V3) -> [f64; 2] {
        let cos: f64 = (0..3).map(|i| w[i] * self.normal[i]).sum();
        if let Map::Surface(arc) = &self.map {
            let sin: f64 = (0..3).map(|i| w[i] * arc.foot[i]).sum();
            [sin.max(0.0) * cos.max(0.0) / self.measure, (sin.abs() + cos.abs()) / self.measure]
        } else if self.projected {
            [cos.max(0.0) / self.measure, 1.0 / self.measure]
        } else {
            [1.0 / self.measure, 0.0]
        }
    }

    /// The direction for `u` and its density where `u` is uniform over the area: 0 where that has no finite value.
    #[must_use]
    pub fn by_area(&self, u: [f64; 2]) -> (V3, f64) {
        let (point, normal) = match &self.shape {
            Shape::Sphere { center, radius } => {
                let (c, r) = (wide(*center), f64::from(*radius));
                let k = 2.0 * u[0];
                let sin = (k * (2.0 - k)).sqrt();
                let (s, cos) = (TAU * u[1]).sin_cos();
                let n = [sin * cos, sin * s, 1.0 - k];
                let area = 4.0 * PI * r * r;
                (add(dd(c), dd(n.map(|x| x * r))), dd(n.map(|x| x * area)))
            }
            Shape::Flat { p, u: e1, v: e2 } => {
                let (p, e1, e2) = (dd(wide(*p)), dd(wide(*e1)), dd(wide(*e2)));
                let normal = cross(e1, e2);
                let (b1, b2, part) = if matches!(self.kind, Kind::Triangle | Kind::ProjectedTriangle) {
                    let root = u[0].sqrt();
                    (root * (1.0 - u[1]), root * u[1], 0.5)
                } else {
                    (u[0], u[1], 1.0)
                };
                let point = add(p, add(times(e1, Dd::from(b1)), times(e2, Dd::from(b2))));
                (point, times(normal, Dd::from(part)))
            }
            Shape::Corners(corners) => {
                let c = corners.map(|c| dd(wide(c)));
                let edge: [Dd3; 5] = core::array::from_fn(|i| add(c[i + 1], c[0].map(|x| -x)));
                let normals: [Dd3; 4] = core::array::from_fn(|i| cross(edge[i], edge[i + 1]));
                let areas = normals.map(|n| length(n).to_f64());
                let total: f64 = areas.iter().sum();
                let (mut place, mut i) = (u[0] * total, 0);
                while i < 3 && place >= areas[i] {
                    place -= areas[i];
                    i += 1;
                }
                let root = (place / areas[i]).clamp(0.0, 1.0).sqrt();
                let (b1, b2) = (Dd::from(root * (1.0 - u[1])), Dd::from(root * u[1]));
                let point = add(c[0], add(times(edge[i], b1), times(edge[i + 1], b2)));
                let whole = normals.into_iter().reduce(add).unwrap_or(normals[0]);
                (point, times(whole, Dd::from(0.5)))
            }
            Shape::Disk { center, normal, radius } => {
                let n = unit(wide(*normal));
                let frame = Frame::new(Vec3::new(n[0], n[1], n[2]));
                let r = f64::from(*radius);
                let q = ConcentricDisk.sample(Vec2::new(u[0], u[1])) * r;
                let offset = frame.s * q.x + frame.t * q.y;
                let area = dd(wide(*normal)).map(|x| x * Dd::from(PI * r * r));
                (add(dd(wide(*center)), dd([offset.x, offset.y, offset.z])), area)
            }
            Shape::Segment { a, edge } => {
                let (a, edge) = (dd(wide(*a)), dd(wide(*edge)));
                let point = add(a, times(edge, Dd::from(u[0])));
                let across = length(cross(a, edge)).to_f64();
                let pdf = if across > 0.0 { dot(point, point).to_f64() / across } else { 0.0 };
                return (narrow(normalized(point)), pdf);
            }
        };
        let d = length(point);
        let along = dot(point, normal).abs();
        if d.to_f64() <= 0.0 || along.to_f64() <= 0.0 {
            return (narrow(normalized(point)), 0.0);
        }
        (narrow(normalized(point)), (d * d * d / along).to_f64())
    }
}

fn sampled(body: &impl Warp<f64, Point = Vec3<f64>>, u: [f64; 2]) -> V3 {
    let w = body.sample(Vec2::new(u[0], u[1]));
    [w.x, w.y, w.z]
}

impl Truth {
    /// What the shape gives to a receiver with the unit normal `n`, per unit of radiance; of a segment, times the height over its line and
    /// per unit of its width. By closed form; NaN for a disk, which has none.
    #[must_use]
    pub fn irradiance(&self, n: V3) -> f64 {
        let n = dd(n);
        match &self.shape {
            Shape::Sphere { center, radius } => projected_cap(wide(*center), f64::from(*radius), narrow(n)),
            Shape::Flat { p, u, v } => {
                let (p, u, v) = (dd(wide(*p)), dd(wide(*u)), dd(wide(*v)));
                let (pu, puv, pv) = (add(p, u), add(add(p, u), v), add(p, v));
                let corners = if matches!(self.kind, Kind::Triangle | Kind::ProjectedTriangle) {
                    vec![p, pu, pv]
                } else {
                    vec![p, pu, puv, pv]
                };
                lambert(&above_horizon(&corners, n), n)
            }
            Shape::Corners(corners) => lambert(&above_horizon(&corners.map(|c| dd(wide(c))), n), n),
            Shape::Disk { .. } => f64::NAN,
            Shape::Segment { a, edge } => Arc::new(dd(wide(*a)), dd(wide(*edge)), Some(n)).whole,
        }
    }
    /// Of the point over a line; 1 for what is none.
    #[must_use]
    pub fn height(&self) -> f64 {
        let Shape::Segment { a, edge } = &self.shape else { return 1.0 };
        let (a, edge) = (dd(wide(*a)), dd(wide(*edge)));
        (length(cross(a, edge)) / length(edge)).to_f64()
    }
    /// The distance of a line in a direction of the plane of point and line over the height; 1 for what is none.
    #[must_use]
    pub fn stretch(&self, w: V3) -> f64 {
        let Shape::Segment { edge, .. } = &self.shape else { return 1.0 };
        1.0 / length(cross(dd(w), dd(unit(wide(*edge))))).to_f64()
    }
}

fn widest(corners: &[Dd3]) -> f64 {
    let units: Vec<_> = corners.iter().map(|c| normalized(*c)).collect();
    let mut most = 0.0_f64;
    for (i, a) in units.iter().enumerate() {
        for b in &units[..i] {
            most = most.max(between(*a, *b));
        }
    }
    most
}
