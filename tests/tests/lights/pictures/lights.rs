//! The lights that show pictures, in double precision, and their samplers.

use core::f64::consts::{PI, TAU};
use etendue::light::{Picture, Region, TexelSample};
use etendue::{Disk, LightSampler, Parallelogram, Real, Rectangle, Sphere, Triangle, Vec2, Vec3};
use etendue_oracle::{V3, cross, dot, length, sub, unit};

/// A light, as the corners and axes that define it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Light {
    Rectangle,
    Parallelogram,
    Triangle,
    Disk,
    Sphere,
}
pub(crate) use Light::Sphere as Ball;
pub(crate) const LIGHTS: [Light; 5] =
    [Light::Rectangle, Light::Parallelogram, Light::Triangle, Light::Disk, Light::Sphere];
pub(crate) const CORNER: V3 = [-1.0, -0.5, 2.0];
pub(crate) const EDGE_S: V3 = [0.0, 1.5, 0.0];
pub(crate) const EDGE_T: V3 = [2.0, 0.0, 0.25];
pub(crate) const SHEAR: V3 = [0.5, 1.0, 0.0];
pub(crate) const CENTER: V3 = [0.25, 0.5, 2.0];
pub(crate) const RADIUS: f64 = 0.75;

/// What texels are drawn by, besides radiance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum By {
    Area,
    SolidAngle,
    Projected,
    Visible,
}

impl Light {
    pub(crate) fn measures(self) -> &'static [By] {
        if self == Ball { &[By::Visible] } else { &[By::Area, By::SolidAngle, By::Projected] }
    }
    pub(crate) fn region(self) -> Region {
        match self {
            Self::Triangle => Region::Triangle,
            Self::Disk => Region::Disk,
            _ => Region::Square,
        }
    }
    /// The point at surface coordinates, and the normal times the area per unit of them; none where the light is not.
    pub(crate) fn point(self, [s, t]: [f64; 2]) -> Option<(V3, V3)> {
        let plane = |s: f64, t: f64, u: V3, v: V3| -> V3 { core::array::from_fn(|k| CORNER[k] + s * u[k] + t * v[k]) };
        Some(match self {
            Self::Rectangle => (plane(s, t, EDGE_S, EDGE_T), cross(EDGE_S, EDGE_T)),
            Self::Parallelogram => (plane(s, t, EDGE_S, SHEAR), cross(EDGE_S, SHEAR)),
            Self::Triangle if s + t >= 1.0 => return None,
            Self::Triangle => (plane(s, t, EDGE_S, SHEAR), cross(EDGE_S, SHEAR)),
            Self::Disk => {
                let (x, y) = (2.0 * s - 1.0, 2.0 * t - 1.0);
                if x * x + y * y >= 1.0 {
                    return None;
                }
                // the frame of the normal −z
                ([CENTER[0] + RADIUS * x, CENTER[1] - RADIUS * y, CENTER[2]], [0.0, 0.0, -4.0 * RADIUS * RADIUS])
            }
            Ball => {
                let z = 1.0 - 2.0 * s;
                let (sin, cos) = (TAU * t).sin_cos();
                let r = (1.0 - z * z).max(0.0).sqrt();
                let n = [r * cos, r * sin, z];
                (core::array::from_fn(|k| CENTER[k] + RADIUS * n[k]), n.map(|x| x * 4.0 * PI * RADIUS * RADIUS))
            }
        })
    }
    /// Direction from `p` to a point, and steradians per unit of surface coordinates, if the side that emits is seen or the light is flat.
    pub(crate) fn seen(self, p: V3, uv: [f64; 2]) -> Option<(V3, f64)> {
        let (point, normal) = self.point(uv)?;
        let to = sub(point, p);
        let d = length(to);
        let cos = -dot(to, normal) / d;
        let cos = if self == Ball { cos } else { cos.abs() };
        (cos > 0.0).then(|| (to.map(|x| x / d), cos / (d * d)))
    }
    /// Its sampler by a measure, and the method that returns the texel, too.
    pub(crate) fn with<'a, R: Real>(self, picture: Picture<'a>, by: By, p: Vec3<R>, n: Vec3<R>) -> Sampler<'a, R> {
        let v = |x: V3| Vec3::<R>::lit(x);
        let (corner, edge_s) = (v(CORNER), v(EDGE_S));
        macro_rules! sampler {
            ($sampler:expr) => {{
                let sampler = $sampler;
                Sampler { light: Box::new(sampler), draw: Box::new(move |u| sampler.draw(u)) }
            }};
        }
        macro_rules! flat {
            ($light:expr) => {{
                let pictured = picture.on($light);
                match by {
                    By::Area => sampler!(pictured.by_area(p)),
                    By::SolidAngle => sampler!(pictured.by_solid_angle(p)),
                    _ => sampler!(pictured.by_projected_solid_angle(p, n)),
                }
            }};
        }
        match self {
            Self::Rectangle => flat!(Rectangle { corner, edge_s, edge_t: v(EDGE_T) }),
            Self::Parallelogram => flat!(Parallelogram { corner, edge_s, edge_t: v(SHEAR) }),
            Self::Triangle => flat!(Triangle { v0: corner, e1: edge_s, e2: v(SHEAR) }),
            Self::Disk => flat!(Disk { center: v(CENTER), normal: v([0.0, 0.0, -1.0]), radius: R::lit(RADIUS) }),
            Ball => sampler!(picture.on(Sphere { center: v(CENTER), radius: R::lit(RADIUS) }).by_visible_area(p)),
        }
    }
}

pub(crate) struct Sampler<'a, R: Real> {
    pub(crate) light: Box<dyn LightSampler<R> + 'a>,
    pub(crate) draw: Box<dyn Fn(Vec2<R>) -> TexelSample<R> + 'a>,
}

/// Points from which lights are seen: afar, near, touching, from the plane of the flat ones, from behind.
pub(crate) const POINTS: [V3; 6] = [
    [0.0, 0.0, 0.0],
    [0.5, 0.25, 1.875],
    [40.0, -30.0, -50.0],
    [-0.25, 0.25, 2.0625],
    [3.0, 0.5, 1.5],
    [0.0, 0.5, 4.0],
];

pub(crate) fn normal(p: V3) -> V3 {
    // so that the horizon passes through some of them
    unit(sub([0.3, 0.4, 2.2], p).map(|x| x + 0.05)).map(|x| f64::from(x as f32))
}

pub(crate) fn vector<R: Real>(p: V3) -> Vec3<R> {
    Vec3::lit(p)
}
