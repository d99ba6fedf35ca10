//! What is rendered: shapes with their reflection and emission, and the rays of a camera. All of it is plain data.

use super::pattern::Pattern;
use crate::vectors::{V3, along, cross, dot, length, sub, unit};
use std::sync::Arc;

/// The form of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// A whole sphere; its normal points outwards.
    Sphere {
        /// Centre.
        center: V3,
        /// Radius, greater than 0.
        radius: f64,
    },
    /// The triangle or parallelogram at one corner; the normal is the cross product of the edges.
    Flat {
        /// One corner.
        corner: V3,
        /// The edges from that corner.
        edges: [V3; 2],
        /// Whether it is the triangle between the edges, or else the parallelogram that they span.
        is_triangle: bool,
    },
}

/// How a surface reflects, on both of its sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Finish {
    /// Lambertian, with this albedo.
    Diffuse(f64),
    /// A perfect mirror, with this reflectance at every angle.
    Mirror(f64),
    /// A metal with Fresnel reflectance and microfacets by GGX, whose shadowing and masking is that of Smith, correlated by height.
    Metal {
        /// Real part of the index of refraction.
        eta: f64,
        /// Imaginary part of the index of refraction.
        k: f64,
        /// Roughness α; 0 is a perfect mirror.
        alpha: f64,
    },
    /// Such microfacets, with Schlick's reflectance F, over a Lambertian surface, which has the part 1 − F of its own reflection.
    Coat {
        /// Albedo of the Lambertian surface.
        albedo: f64,
        /// Reflectance of the microfacets at normal incidence.
        reflectance: f64,
        /// Roughness α, greater than 0.
        alpha: f64,
    },
}

/// Constant emission of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emission {
    /// Emitted radiance.
    pub radiance: f64,
    /// Whether both sides emit, or only the side of the normal.
    pub two_sided: bool,
}

/// What varies over a triangle. Its corners are that of [`Form::Flat`] and the ends of both edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Detail {
    /// Texture coordinates of the corners.
    pub uvs: [[f64; 2]; 3],
    /// Normals at the corners, of any length and on the same side, of the smooth surface for which the triangle stands; 0 if it is flat.
    /// Between them the normal is linear; it is turned to the side from which the triangle is seen, and then, by adding a part of the
    /// direction to the viewer, until its cosine to that is 1/100 of the unit normal's length before.
    pub normals: [V3; 3],
    /// The albedo, if it varies; what is beyond \[0, 1\] counts as 0 or 1.
    pub albedo: Option<Arc<Pattern>>,
    /// The chance that a ray which meets the triangle is stopped, if that is less than 1 somewhere.
    pub opacity: Option<Opacity>,
}

/// The opacity of a surface with holes.
#[derive(Clone, Debug, PartialEq)]
pub struct Opacity {
    /// The chance that a ray is stopped; more than 1 is 1, and less than 0 is 0.
    pub chance: Arc<Pattern>,
    /// If given, rays are stopped where `chance` is at least this, and nowhere else.
    pub least: Option<f64>,
}

/// A shape with its surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Form and position.
    pub form: Form,
    /// How it reflects.
    pub finish: Finish,
    /// What it emits, if it is a light.
    pub emission: Option<Emission>,
    /// What varies, if it is flat and something does.
    pub detail: Option<Arc<Detail>>,
}

/// A camera: the ray through position (x, y) in pixels, from the top left, has direction `corner + across·x + down·y`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Pixels across and down.
    pub size: [usize; 2],
    /// The pinhole, or the centre of the lens.
    pub origin: V3,
    /// Direction at the top left corner, and its change per pixel to the right and downwards.
    pub corner: V3,
    /// Change of the direction for a pixel to the right.
    pub across: V3,
    /// Change of the direction for a pixel downwards.
    pub down: V3,
    /// Change of the origin for a pixel to the right and downwards; 0 unless the camera is orthographic.
    pub slides: [V3; 2],
    /// The lens, if there is one.
    pub lens: Option<Lens>,
}

/// A thin lens: through its point (a, b) of the unit disk, a ray starts `a·radii[0] + b·radii[1]` from the centre, and its direction is
/// `a·bends[0] + b·bends[1]` less.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Radii to the right and upwards.
    pub radii: [V3; 2],
    /// The radii over the distance of the plane of focus.
    pub bends: [V3; 2],
}

impl View {
    /// Origin and direction, of any length, of the ray through a position in pixels and a point of the unit disk.
    #[must_use]
    pub fn ray(&self, [x, y]: [f64; 2], [a, b]: [f64; 2]) -> (V3, V3) {
        let direction = along(along(self.corner, self.across, x), self.down, y);
        let origin = along(along(self.origin, self.slides[0], x), self.slides[1], y);
        let Some(Lens { radii, bends }) = &self.lens else { return (origin, direction) };
        let origin = along(along(origin, radii[0], a), radii[1], b);
        (origin, along(along(direction, bends[0], -a), bends[1], -b))
    }
}

impl View {
    /// The pixels around what the image shows of a form: the least and the greatest column and row. `None` if it shows nothing of it, if some
    /// of it is behind the camera, and of an orthographic camera.
    pub(super) fn around(&self, form: &Form) -> Option<[[usize; 2]; 2]> {
        let n = cross(self.across, self.down);
        let points = match form {
            Form::Sphere { center, radius } => {
                let axis = |k: usize| std::array::from_fn(|i| if i == k { *radius } else { 0.0 });
                (0..6).map(|k| along(*center, axis(k % 3), if k < 3 { 1.0 } else { -1.0 })).collect()
            }
            Form::Flat { .. } => form.corners([0.0; 3]).0.to_vec(),
        };
        let (mut least, mut most) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in points {
            let to = sub(point, self.origin);
            let far = dot(to, n) / dot(self.corner, n);
            if !(far > 0.0 && far.is_finite()) {
                return None;
            }
            let place = sub(to.map(|x| x / far), self.corner);
            let at = [cross(self.down, n), cross(n, self.across)];
            let at = [dot(place, at[0]) / dot(self.across, at[0]), dot(place, at[1]) / dot(self.down, at[1])];
            (least, most) = ([0, 1].map(|k| least[k].min(at[k])), [0, 1].map(|k| most[k].max(at[k])));
        }
        let is_seen = (0..2).all(|k| most[k] >= 0.0 && least[k] < self.size[k] as f64);
        let pixel = |x: f64, k: usize| (x.max(0.0) as usize).min(self.size[k] - 1);
        is_seen.then(|| [[0, 1].map(|k| pixel(least[k], k)), [0, 1].map(|k| pixel(most[k], k))])
    }
}

impl Form {
    /// The corners of a flat form in order around, relative to `from`, and how many there are; none of a sphere.
    #[must_use]
    pub fn corners(&self, from: V3) -> ([V3; 4], usize) {
        let Self::Flat { corner, edges: [u, v], is_triangle } = self else { return ([[0.0; 3]; 4], 0) };
        let p = sub(*corner, from);
        let (a, b) = (along(p, *u, 1.0), along(p, *v, 1.0));
        if *is_triangle { ([p, a, b, b], 3) } else { ([p, a, along(a, *v, 1.0), b], 4) }
    }
}

/// A body with what the tests of rays need.
#[derive(Clone, Debug)]
pub(super) struct Prepared {
    pub(super) body: Body,
    /// Unit normal of a flat form.
    pub(super) normal: V3,
    /// The vectors whose dot products with a place in the plane, from the corner, are its coordinates along the edges.
    dual: [V3; 2],
    /// Greatest magnitude of its coordinates.
    reach: f64,
}

/// What a ray hits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hit {
    pub(super) index: usize,
    /// Length of the ray in units of its direction.
    pub(super) t: f64,
}

/// Normals that are shorter than this cancel each other.
const SHORTEST: f64 = 1e-6;
/// The cosine between a smooth normal and the direction to the viewer below which the normal is turned.
const STEEPEST: f64 = 0.01;

/// Distances from a plane below this fraction of the coordinates are rounding.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

impl Prepared {
    pub(super) fn new(body: Body) -> Self {
        let greatest = |v: V3| v.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        match body.form {
            Form::Sphere { center, radius } => {
                Self { body, normal: [0.0; 3], dual: [[0.0; 3]; 2], reach: greatest(center) + radius }
            }
            Form::Flat { corner, edges: [u, v], .. } => {
                let area = cross(u, v);
                let squared = dot(area, area);
                let dual = [cross(v, area), cross(area, u)].map(|w| w.map(|x| x / squared));
                Self { body, normal: unit(area), dual, reach: greatest(corner) + greatest(u) + greatest(v) }
            }
        }
    }
    /// Coordinates along the edges of a point in the plane of a flat form.
    fn coordinates(&self, p: V3) -> [f64; 2] {
        let Form::Flat { corner, .. } = self.body.form else { return [0.0; 2] };
        self.dual.map(|w| dot(w, sub(p, corner)))
    }
    /// Texture coordinates at a point, both of which are off by the fraction `lift` of the greatest coordinates.
    fn uv(&self, detail: &Detail, p: V3, lift: f64) -> [f64; 2] {
        let ([s, t], [a, b, c]) = (self.coordinates(p), detail.uvs);
        let off = lift * p.iter().fold(self.reach, |m, x| m.max(x.abs()));
        let [s, t] = [s + off * length(self.dual[0]), t + off * length(self.dual[1])];
        let greatest = |k: usize| a[k].abs().max(b[k].abs()).max(c[k].abs());
        [0, 1].map(|k| a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]) + lift * greatest(k))
    }
    /// Whether some rays may pass through.
    pub(super) fn has_holes(&self) -> bool {
        self.body.detail.as_ref().is_some_and(|detail| detail.opacity.is_some())
    }
    /// The chance that a ray which meets the body at a point is stopped, with positions in pictures moved by the fraction `lift`.
    pub(super) fn opacity(&self, p: V3, lift: f64) -> f64 {
        let Some(detail) = &self.body.detail else { return 1.0 };
        let Some(Opacity { chance, least }) = &detail.opacity else { return 1.0 };
        let chance = chance.at(self.uv(detail, p, lift), lift);
        least.map_or(chance.clamp(0.0, 1.0), |least| if chance >= least { 1.0 } else { 0.0 })
    }
    /// How the body reflects at a point.
    pub(super) fn finish(&self, p: V3, lift: f64) -> Finish {
        let Some(detail) = &self.body.detail else { return self.body.finish };
        let Some(albedo) = &detail.albedo else { return self.body.finish };
        let albedo = albedo.at(self.uv(detail, p, lift), lift).clamp(0.0, 1.0);
        match self.body.finish {
            Finish::Coat { reflectance, alpha, .. } => Finish::Coat { albedo, reflectance, alpha },
            _ => Finish::Diffuse(albedo),
        }
    }
    /// The normal of the smooth surface at a point, seen along `direction` on the side of the unit normal `flat`; `None` on a flat one.
    pub(super) fn smooth(&self, p: V3, flat: V3, direction: V3) -> Option<V3> {
        let normals = self.body.detail.as_ref()?.normals;
        let [s, t] = self.coordinates(p);
        let mixed = along(along(normals[0].map(|x| x * (1.0 - s - t)), normals[1], s), normals[2], t);
        if length(mixed) <= SHORTEST {
            return None;
        }
        let sign = if dot(mixed, flat) < 0.0 { -1.0 } else { 1.0 };
        let normal = unit(mixed).map(|x| x * sign);
        let lack = STEEPEST + dot(normal, direction);
        Some(if lack > 0.0 { unit(along(normal, direction, -lack)) } else { normal })
    }
    /// Whether a point is in the plane of a flat form, up to rounding.
    pub(super) fn is_level(&self, x: V3) -> bool {
        let Form::Flat { corner, .. } = self.body.form else { return false };
        let reach = x.iter().fold(self.reach, |m, x| m.max(x.abs()));
        dot(self.normal, sub(x, corner)).abs() <= ROUNDING * reach
    }
    /// Where the ray from `o` along `d` enters the body, beyond its origin. `own` says that the origin is on this body.
    pub(super) fn meets(&self, o: V3, d: V3, own: bool) -> Option<f64> {
        match self.body.form {
            Form::Sphere { center, radius } => {
                let to = sub(o, center);
                let squared = dot(d, d);
                let b = -dot(to, d) / squared;
                if own {
                    // one root is the origin itself
                    return (b > 0.0).then_some(2.0 * b);
                }
                let across = along(to, d, b);
                let rest = radius * radius - dot(across, across);
                if rest <= 0.0 {
                    return None;
                }
                let half = (rest / squared).sqrt();
                let least = ROUNDING * (self.reach + length(o)) / squared.sqrt();
                [b - half, b + half].into_iter().find(|t| *t > least)
            }
            Form::Flat { corner, is_triangle, .. } => {
                if own || self.is_level(o) {
                    return None;
                }
                let to = sub(corner, o);
                let t = dot(to, self.normal) / dot(d, self.normal);
                if !(t > 0.0 && t < f64::INFINITY) {
                    return None;
                }
                let place = sub(d.map(|x| x * t), to);
                let [s, r] = self.dual.map(|w| dot(w, place));
                let inside = s >= 0.0 && r >= 0.0 && if is_triangle { s + r <= 1.0 } else { s <= 1.0 && r <= 1.0 };
                inside.then_some(t)
            }
        }
    }
}

/// What a ray that starts on the body `own`, if on any, may hit: bodies with holes that are nearer than the first without, and that.
/// Each has the chance that the ray comes there and is stopped.
pub(super) fn hits(bodies: &[Prepared], o: V3, d: V3, own: Option<usize>, lift: f64) -> Vec<(Hit, f64)> {
    let mut first: Option<Hit> = None;
    let mut found = Vec::new();
    for (index, body) in bodies.iter().enumerate() {
        let Some(t) = body.meets(o, d, own == Some(index)) else { continue };
        if body.has_holes() {
            found.push(Hit { index, t });
        } else if first.is_none_or(|hit| t < hit.t) {
            first = Some(Hit { index, t });
        }
    }
    if let Some(first) = first {
        found.retain(|hit| hit.t < first.t);
        found.push(first);
    }
    found.sort_by(|a, b| a.t.total_cmp(&b.t));
    let mut left = 1.0;
    let chance = |hit: &Hit| {
        let stopped = left * bodies[hit.index].opacity(along(o, d, hit.t), lift);
        left -= stopped;
        stopped
    };
    let chances: Vec<f64> = found.iter().map(chance).collect();
    found.into_iter().zip(chances).filter(|(_, chance)| *chance > 0.0).collect()
}
