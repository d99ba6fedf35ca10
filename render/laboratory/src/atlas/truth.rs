//! Exact results for a light seen from the origin: what the judge knows of it, and the map of the library's technique by its definition. Nothing
//! here calls the code under test, except for the directions of projected shapes (see [`Truth::direction`]).

use super::pose::ShapeKind;
use core::f64::consts::TAU;
use etendue::light::shapes::{ProjectedCap, ProjectedParallelogram, ProjectedPolygon, ProjectedTriangle};
use etendue::{Frame, Vec2, Vec3, Warp};
use etendue_judge::area_lights::{AreaLight, LightShape, Measure};
use etendue_judge::lights::definition::{Chart, Definition};
use etendue_oracle::curves::Ellipse;
use etendue_oracle::flat::Window;
use etendue_oracle::{V3, dd, dot, unit, wide};

/// A map of the unit square to directions.
#[derive(Clone, Debug)]
enum Map {
    Cap { frame: Frame<f64>, one_minus_cos: f64 },
    // triangle by triangle
    Fans,
    Window(Window),
    Disk(Box<Ellipse>),
    // the f64 instances, which tests compare with closed forms
    Lune(Box<ProjectedCap<f64>>),
    Triangle(Box<ProjectedTriangle<f64>>),
    Parallelogram(Box<ProjectedParallelogram<f64>>),
    Polygon(Box<ProjectedPolygon<f64, 4>>),
}

/// The exact results for one light.
#[derive(Clone, Debug)]
pub struct Truth {
    map: Map,
    /// The light as it is seen.
    pub seen: Definition,
    /// Solid angle, or projected solid angle, in steradians.
    pub measure: f64,
    projected: bool,
    has_rounded_corners: bool,
    towards: V3,
}

fn vector(v: [f32; 3]) -> Vec3<f64> {
    wide(v).into()
}

impl Truth {
    /// The exact results for a kind of shape; `None` if there is no shape: rounding the corners of a polygon may leave it no longer convex as
    /// seen from the viewpoint, where that is nearer to the plane than the rounding.
    #[must_use]
    pub fn new(kind: ShapeKind, light: &AreaLight) -> Option<Self> {
        let seen = Definition::new(light).filter(Definition::is_convex)?;
        let projected = kind.projected();
        let AreaLight { shape, a, b, c, n, radius, .. } = *light;
        let [p, u, v, normal] = [a, b, c, n].map(vector);
        let part = if shape == LightShape::Triangle { 1.0 / 3.0 } else { 0.5 };
        let middle = match shape {
            LightShape::Sphere | LightShape::Disk => wide(a),
            _ => core::array::from_fn(|i| f64::from(a[i]) + part * (f64::from(b[i]) + f64::from(c[i]))),
        };
        let towards = if middle == [0.0; 3] { unit(wide(n)) } else { unit(middle) };
        let map = match (shape, projected) {
            (LightShape::Sphere, false) => {
                let axis = if wide(a) == [0.0; 3] { [0.0, 0.0, 1.0] } else { unit(wide(a)) };
                Map::Cap { frame: Frame::new(axis.into()), one_minus_cos: seen.solid_angle / TAU }
            }
            (LightShape::Sphere, true) => Map::Lune(Box::new(ProjectedCap::new(p, f64::from(radius), normal))),
            (LightShape::Disk, _) => Map::Disk(Box::new(Ellipse::new(wide(a), wide(b), f64::from(radius), |axis| {
                let t = Frame::new(axis.into()).t;
                [t.x, t.y, t.z]
            }))),
            (LightShape::Rectangle, _) => {
                let [p, u, v] = [a, b, c].map(|v| dd(wide(v)));
                Map::Window(Window::new(p, u, v))
            }
            (_, false) => Map::Fans,
            (LightShape::Triangle, true) => {
                Map::Triangle(Box::new(ProjectedTriangle::with_edges(p, p + u, p + v, u, v, normal)))
            }
            (LightShape::Parallelogram, true) => {
                Map::Parallelogram(Box::new(ProjectedPolygon::parallelogram(p, u, v, normal)))
            }
            (_, true) => {
                let corners = core::array::from_fn(|i| seen.corners()[i].into());
                Map::Polygon(Box::new(ProjectedPolygon::new(corners, normal)))
            }
        };
        let measure = match projected {
            false => seen.solid_angle,
            // from its plane, Lambert's sum has half of the hemisphere on either side
            true => {
                if seen.solid_angle > 0.0 {
                    seen.irradiance(seen.normal())
                } else {
                    0.0
                }
            }
        };
        Some(Self { map, seen, measure, projected, has_rounded_corners: shape == LightShape::Polygon, towards })
    }

    /// The direction for `u`, computed from the definition of the map. For projected shapes it comes from the f64 instance, whose pdf the
    /// tests compare with the closed form.
    #[must_use]
    pub fn direction(&self, u: [f64; 2]) -> V3 {
        let at = Vec2::new(u[0], u[1]);
        let drawn = match &self.map {
            Map::Cap { frame, one_minus_cos } => {
                let k = u[0] * one_minus_cos;
                let sin = (k * (2.0 - k)).sqrt();
                let (s, c) = (TAU * u[1]).sin_cos();
                frame.to_world(Vec3::new(sin * c, sin * s, 1.0 - k))
            }
            Map::Fans => return self.seen.at(Chart::SolidAngle, u).0,
            Map::Window(window) => return window.at(u),
            Map::Disk(ellipse) => return ellipse.at(u),
            Map::Lune(body) => body.sample(at),
            Map::Triangle(body) => body.sample(at),
            Map::Parallelogram(body) => body.sample(at),
            Map::Polygon(body) => body.sample(at),
        };
        [drawn.x, drawn.y, drawn.z]
    }

    /// Normal of the receiver whose irradiance is estimated: that of projected shapes; otherwise it faces the light.
    #[must_use]
    pub fn receiver(&self) -> V3 {
        if self.projected { self.seen.normal() } else { self.towards }
    }

    /// Whether this coordinate of u is an azimuth.
    #[must_use]
    pub fn periodic(&self, axis: usize) -> bool {
        matches!((&self.map, axis), (Map::Cap { .. }, 1) | (Map::Disk(_), 0))
    }

    /// The pdf at a direction of the shape, and its change per radian of error of the direction.
    #[must_use]
    pub fn pdf(&self, w: V3) -> [f64; 2] {
        if self.projected {
            [dot(w, self.seen.normal()).max(0.0) / self.measure, 1.0 / self.measure]
        } else {
            [1.0 / self.measure, 0.0]
        }
    }
    /// The same for a technique by area; zeros where nothing is known: the corners of a polygon are rounded.
    #[must_use]
    pub fn pdf_by_area(&self, w: V3) -> [f64; 2] {
        let pdf = self.seen.density(Measure::Area, w).filter(|pdf| *pdf < 1e36 && !self.has_rounded_corners);
        let pdf = pdf.unwrap_or(0.0);
        [pdf, pdf * self.seen.steepness(Measure::Area, w)]
    }
}
