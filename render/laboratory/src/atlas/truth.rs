//! Exact results for a shape seen from a point, by the oracle: solid angles, pdfs and the maps themselves. Nothing here calls the code under
//! test, except for the directions of projected shapes (see [`Truth::direction`]).

use super::pose::{Pose, Shape, ShapeKind};
use core::f64::consts::{FRAC_PI_2, PI, TAU};
use etendue::light::shapes::{ProjectedCap, ProjectedParallelogram, ProjectedPolygon, ProjectedTriangle};
use etendue::warp::ConcentricDisk;
use etendue::{Frame, Vec2, Vec3, Warp};
use etendue_oracle::curves::{Arc, Ellipse};
use etendue_oracle::double_double::{Dd, Dd3, add, cross, dd, determinant, dot, length, narrow, normalized, times};
use etendue_oracle::flat::{Fan, Window};
use etendue_oracle::{V3, above_horizon, cap, lambert, projected_cap, unit, wide};

#[derive(Clone, Debug)]
enum Map {
    Cap { frame: Frame<f64>, one_minus_cos: f64 },
    Fans(Vec<Fan>),
    Window(Window),
    Disk(Box<Ellipse>),
    Line(Arc),
    Surface(Arc),
    // the f64 instances, which tests compare with closed forms
    Lune(Box<ProjectedCap<f64>>),
    Triangle(Box<ProjectedTriangle<f64>>),
    Quad(Box<ProjectedParallelogram<f64>>),
    Hexagon(Box<ProjectedPolygon<f64, 6>>),
}

/// The exact results for one pose.
#[derive(Clone, Debug)]
pub struct Truth {
    map: Map,
    /// Solid angle, or projected solid angle.
    pub measure: f64,
    /// Greatest angle between two directions to the shape.
    pub extent: f64,
    /// Whether the shape is one: rounding the corners of a polygon may leave it no longer convex as seen from the viewpoint, where that is
    /// nearer to the plane than the rounding.
    pub defined: bool,
    projected: bool,
    normal: V3,
    shape: Shape,
    kind: ShapeKind,
}

/// Angle between unit vectors.
fn between(a: Dd3, b: Dd3) -> f64 {
    length(cross(a, b)).to_f64().atan2(dot(a, b).to_f64())
}

fn vector(v: V3) -> Vec3<f64> {
    Vec3::new(v[0], v[1], v[2])
}

/// The map of a triangle or parallelogram by a corner and two edges, its measure and its extent.
fn flat(kind: ShapeKind, shape: [V3; 3], normal: V3) -> (Map, f64, f64) {
    let (wide_normal, n) = (vector(normal), dd(normal));
    let [pw, uw, vw] = shape.map(vector);
    let [p, u, v] = shape.map(dd);
    let minus = |a: Dd3| a.map(|x| -x);
    let (pu, puv, pv) = (add(p, u), add(add(p, u), v), add(p, v));
    match kind {
        ShapeKind::Rectangle => {
            let window = Window::new(p, u, v);
            let measure = window.solid_angle;
            (Map::Window(window), measure, widest(&[p, pu, puv, pv]))
        }
        ShapeKind::Triangle => {
            let fan = Fan::new(p, u, v);
            let measure = fan.solid_angle();
            (Map::Fans(vec![fan]), measure, widest(&[p, pu, pv]))
        }
        ShapeKind::ProjectedTriangle => {
            let body = ProjectedTriangle::with_edges(pw, pw + uw, pw + vw, uw, vw, wide_normal);
            let corners = [p, pu, pv];
            let measure = facing(&corners, n);
            (Map::Triangle(Box::new(body)), measure, widest(&corners))
        }
        ShapeKind::ProjectedParallelogram => {
            let body = ProjectedPolygon::parallelogram(pw, uw, vw, wide_normal);
            let corners = [p, pu, puv, pv];
            let measure = facing(&corners, n);
            (Map::Quad(Box::new(body)), measure, widest(&corners))
        }
        _ => {
            let fans = vec![Fan::new(pu, minus(u), v), Fan::new(puv, minus(add(u, v)), minus(u))];
            let measure = fans.iter().map(Fan::solid_angle).sum();
            (Map::Fans(fans), measure, widest(&[p, pu, puv, pv]))
        }
    }
}

impl Truth {
    /// The exact results for a kind of shape in a pose.
    #[must_use]
    pub fn new(kind: ShapeKind, pose: &Pose) -> Self {
        let projected = kind.projected();
        let normal = unit(wide(pose.normal));
        let n = dd(wide(pose.normal));
        let (map, measure, extent) = match &pose.shape {
            Shape::Sphere { center, radius } => {
                let (c, r) = (wide(*center), f64::from(*radius));
                let (h, sigma) = cap(c, r);
                let sigma = sigma.min(FRAC_PI_2);
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
                let ellipse = Ellipse::new(wide(*center), wide(*normal), f64::from(*radius), |axis| {
                    let t = Frame::new(vector(axis)).t;
                    [t.x, t.y, t.z]
                });
                let (measure, extent) = (ellipse.solid_angle(), 2.0 * ellipse.sines[1].min(1.0).asin());
                (Map::Disk(Box::new(ellipse)), measure, extent)
            }
            Shape::Segment { a, edge } => {
                let (a, edge) = (dd(wide(*a)), dd(wide(*edge)));
                let arc = Arc::new(a, edge, projected.then_some(n));
                let (measure, extent) = if projected { (arc.whole, arc.angle) } else { (arc.angle, arc.angle) };
                (if projected { Map::Surface(arc) } else { Map::Line(arc) }, measure, extent)
            }
            Shape::Flat { p, u, v } => flat(kind, [*p, *u, *v].map(wide), wide(pose.normal)),
            Shape::Corners(corners) => {
                let c = corners.map(|c| dd(wide(c)));
                if projected {
                    let body = ProjectedPolygon::new(corners.map(|c| vector(wide(c))), vector(wide(pose.normal)));
                    (Map::Hexagon(Box::new(body)), facing(&c, n), widest(&c))
                } else {
                    let edge = |from: Dd3, to: Dd3| add(to, from.map(|x| -x));
                    let fans: Vec<_> = (1..5).map(|i| Fan::new(c[i], edge(c[i], c[0]), edge(c[i], c[i + 1]))).collect();
                    let measure = fans.iter().map(Fan::solid_angle).sum();
                    (Map::Fans(fans), measure, widest(&c))
                }
            }
        };
        let defined = match &pose.shape {
            Shape::Corners(corners) => convex(&corners.map(|c| dd(wide(c)))),
            _ => true,
        };
        Self { map, measure, extent, defined, projected, normal, shape: pose.shape.clone(), kind }
    }

    /// The direction for `u`, computed from the definition of the map. For projected spheres, triangles, parallelograms and polygons it
    /// comes from the f64 instance, whose pdf the tests compare with the closed form.
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

    /// Whether the map has one dimension.
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
                let part = if matches!(self.kind, ShapeKind::Triangle | ShapeKind::ProjectedTriangle) {
                    1.0 / 3.0
                } else {
                    0.5
                };
                core::array::from_fn(|i| f64::from(p[i]) + part * (f64::from(u[i]) + f64::from(v[i])))
            }
            Shape::Corners(c) => core::array::from_fn(|i| c.iter().map(|c| f64::from(c[i])).sum::<f64>()),
            Shape::Segment { a, edge } => core::array::from_fn(|i| f64::from(a[i]) + 0.5 * f64::from(edge[i])),
        };
        if middle == [0.0; 3] { self.normal } else { unit(middle) }
    }

    /// Whether this coordinate of u is an azimuth.
    #[must_use]
    pub fn periodic(&self, axis: usize) -> bool {
        matches!((&self.map, axis), (Map::Cap { .. }, 1) | (Map::Disk(_), 0))
    }

    /// The pdf at a direction of the shape, and its change per radian of error of the direction.
    #[must_use]
    pub fn pdf(&self, w: V3) -> [f64; 2] {
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

    /// The direction and its pdf if `u` is uniform over the area; the pdf is 0 if it is not finite.
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
                let (b1, b2, part) = if matches!(self.kind, ShapeKind::Triangle | ShapeKind::ProjectedTriangle) {
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

/// The determinant of each corner and the next two.
fn turns(corners: &[Dd3]) -> impl Iterator<Item = f64> + '_ {
    let n = corners.len();
    (0..n).map(move |i| determinant(corners[i], corners[(i + 1) % n], corners[(i + 2) % n]).to_f64())
}

/// Whether a polygon has corners that all turn the same way, as seen from the viewpoint.
fn convex(corners: &[Dd3]) -> bool {
    let (mut left, mut right) = (true, true);
    for turn in turns(corners) {
        left &= turn >= 0.0;
        right &= turn <= 0.0;
    }
    left != right
}

/// Projected solid angle of a polygon; 0 from its plane, where Lambert's sum has half of the hemisphere on either side.
fn facing(corners: &[Dd3], n: Dd3) -> f64 {
    let touches = turns(corners).all(|turn| turn == 0.0);
    if touches { 0.0 } else { lambert(&above_horizon(corners, n), n) }
}

fn sampled(body: &impl Warp<f64, Point = Vec3<f64>>, u: [f64; 2]) -> V3 {
    let w = body.sample(Vec2::new(u[0], u[1]));
    [w.x, w.y, w.z]
}

impl Truth {
    /// Irradiance of a receiver with unit normal `n`, per unit of radiance, in closed form; for a segment, times the height above its line
    /// and per unit of its width. NaN for a disk, which has no closed form.
    #[must_use]
    pub fn irradiance(&self, n: V3) -> f64 {
        let n = dd(n);
        match &self.shape {
            Shape::Sphere { center, radius } => projected_cap(wide(*center), f64::from(*radius), narrow(n)),
            Shape::Flat { p, u, v } => {
                let (p, u, v) = (dd(wide(*p)), dd(wide(*u)), dd(wide(*v)));
                let (pu, puv, pv) = (add(p, u), add(add(p, u), v), add(p, v));
                let corners = if matches!(self.kind, ShapeKind::Triangle | ShapeKind::ProjectedTriangle) {
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
    /// Height of the point above a line; 1 for other shapes.
    #[must_use]
    pub fn height(&self) -> f64 {
        let Shape::Segment { a, edge } = &self.shape else { return 1.0 };
        let (a, edge) = (dd(wide(*a)), dd(wide(*edge)));
        (length(cross(a, edge)) / length(edge)).to_f64()
    }
    /// Distance of a line in a direction within the plane of point and line, over the height; 1 for other shapes.
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
