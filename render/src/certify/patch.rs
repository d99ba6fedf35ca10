//! Parts of surfaces, as bounds of the shading points of rays through a rectangle of pixels.

use super::hull::{CORNERS, Hull, V64, magnitude, unit, wide};
use crate::bvh::SHAPE;
use crate::camera::Pinhole;
use crate::geometry::{LEAST, LIFT, Outline};
use crate::occlusion::Convex;
use crate::surfaces::Surfaces;

/// How far shading points can be from the ideal patch, relative to their greatest coordinate: a lift of less than 1.8 · 2⁻²³, and a rounding of
/// less than 1.8 · 2⁻²⁴.
const OFF: f64 = 3.0 * LIFT;
/// Greatest difference between the cosine of a direction, computed in single precision, and the exact one: a normal is rounded by less than
/// 2⁻²⁴, and so is each of three products and sums.
pub(super) const TILT: f64 = 1.0 / 2_097_152.0;
/// Rounding of corners as seen along a ray, relative to their distance: 2⁻²⁰. The edge functions and their sum then place the hit within
/// 12 times that, times the greatest aspect ratio of the projected triangle.
const SEEN: f64 = 12.0 / 1_048_576.0;

/// Rounding of the direction of a camera ray.
const RAY: f64 = 1.0 / 2_097_152.0;

/// Four planes through the pinhole of a camera that bound a rectangle of pixels.
#[derive(Clone, Copy, Debug)]
pub struct Pyramid {
    /// The pinhole.
    origin: V64,
    /// Unit normals; n·(x − origin) ≥ 0 for all points of the rectangle.
    normals: [V64; 4],
}

impl Pyramid {
    /// The pyramid of the pixels in \[x0, x1\] × \[y0, y1\] of the image of a camera, from the top left. It is wider by an eighth of a pixel
    /// on each side, for the rounding of rays.
    pub fn new(pinhole: &Pinhole, [x0, y0, x1, y1]: [f64; 4]) -> Self {
        let (origin, corners) = pinhole.rectangle([x0 - 0.125, y0 - 0.125, x1 + 0.125, y1 + 0.125]);
        let corners = corners.map(V64::from);
        let middle = corners[0] + corners[1] + corners[2] + corners[3];
        let normals = std::array::from_fn(|k| {
            let normal = unit(corners[k].cross(corners[(k + 1) % 4]));
            if normal.dot(middle) < 0.0 { -normal } else { normal }
        });
        Self { origin: origin.into(), normals }
    }
}

/// From where a patch is seen.
#[derive(Clone, Copy, Debug)]
pub enum Viewer<'a> {
    /// By a pinhole, through a rectangle of pixels.
    Pixels(&'a Pyramid),
    /// From anywhere on the side of the normal.
    Front,
    /// From anywhere on the other side.
    Back,
}

/// The plane of a flat patch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ground {
    /// Unit normal on the side of the viewer.
    pub(super) normal: V64,
    /// n·x of the plane.
    pub(super) offset: f64,
    /// Shading points are at least this high above the plane.
    pub(super) height: f64,
}

/// A bound of the shading points on a part of a triangle or sphere.
#[derive(Clone, Copy, Debug)]
pub struct Patch {
    /// The primitive, as in hits.
    pub(super) place: u32,
    pub(super) hull: Hull,
    /// The plane of a triangle.
    pub(super) ground: Option<Ground>,
    /// Centre and radius of a sphere.
    pub(super) ball: Option<(V64, f64)>,
}

/// A convex polygon that is being clipped.
#[derive(Clone, Copy)]
struct Clipped {
    corners: [V64; CORNERS],
    count: usize,
}

impl Clipped {
    fn new(points: &[V64]) -> Self {
        let mut corners = [V64::default(); CORNERS];
        corners[..points.len()].copy_from_slice(points);
        Self { corners, count: points.len() }
    }
    fn points(&self) -> &[V64] {
        &self.corners[..self.count]
    }
    /// The part with n·x ≥ `least`; `None` if there is too little room, or a number that is not finite.
    fn clip(&self, n: V64, least: f64) -> Option<Self> {
        let mut part = Self { corners: self.corners, count: 0 };
        let above = |p: V64| n.dot(p) - least;
        let mut push = |p: V64| {
            let slot = part.corners.get_mut(part.count)?;
            *slot = p;
            part.count += 1;
            Some(())
        };
        for (i, &p) in self.points().iter().enumerate() {
            let q = self.points()[(i + 1) % self.count];
            let (a, b) = (above(p), above(q));
            if !a.is_finite() {
                return None;
            }
            if a >= 0.0 {
                push(p)?;
            }
            if (a >= 0.0) != (b >= 0.0) {
                push(p + (q - p) * (a / (a - b)))?;
            }
        }
        Some(part)
    }
    /// The part inside a pyramid that is widened by `margin`.
    fn within(mut self, pyramid: &Pyramid, margin: f64) -> Option<Self> {
        for n in pyramid.normals {
            self = self.clip(n, n.dot(pyramid.origin) - margin)?;
        }
        Some(self)
    }
}

impl Patch {
    /// The part of a primitive that a viewer sees, regardless of occlusion. `place` is as in the hits of rays. `None` if there is no such
    /// part, and for what is not supported: lights, spheres from inside, triangles without area, and triangles seen edge-on.
    pub fn of(surfaces: &Surfaces, place: u32, viewer: Viewer<'_>) -> Option<Self> {
        if place & SHAPE == 0 {
            return Self::of_triangle(
                surfaces.bvh.corners(place),
                surfaces.bvh.reach_of_points().into(),
                place,
                viewer,
            );
        }
        let shape = &surfaces.shapes()[(place & !SHAPE) as usize];
        let Outline::Exact(Convex::Sphere { center, radius }) = shape.geometry.outline() else { return None };
        Self::of_sphere(center.map(f64::from), f64::from(radius), surfaces.bvh.reach_of_points().into(), place, viewer)
    }
    fn of_triangle(c: [f32; 9], reach: f64, place: u32, viewer: Viewer<'_>) -> Option<Self> {
        let corners = [wide([c[0], c[1], c[2]]), wide([c[3], c[4], c[5]]), wide([c[6], c[7], c[8]])];
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a);
        let area = normal.length();
        let longest = (b - a).length().max((c - b).length()).max((a - c).length());
        if !(area > 0.0 && area.is_finite()) {
            return None;
        }
        let mut normal = normal * (1.0 / area);
        let mut polygon = Clipped::new(&corners);
        match viewer {
            Viewer::Front => {}
            Viewer::Back => normal = -normal,
            Viewer::Pixels(pyramid) => {
                let height = normal.dot(pyramid.origin - a);
                let farthest =
                    |points: &[V64]| points.iter().map(|&p| (p - pyramid.origin).length()).fold(0.0, f64::max);
                let distance = farthest(&corners);
                let steepness = height.abs() / distance;
                let side_known = steepness > TILT;
                if !side_known {
                    return None;
                }
                if height < 0.0 {
                    normal = -normal;
                }
                let aspect = 1.0 + longest * longest / (area * steepness);
                polygon = polygon.within(pyramid, SEEN * distance * aspect)?;
                // Only a hit beyond an edge is not where the ray meets the plane, but at that edge.
                let edges = [(a, b), (b, c), (c, a)];
                let side = |p: V64, (a, b): (V64, V64)| normal.dot((b - a).cross(p - a)) * height.signum();
                let least = 1e-9 * longest * longest;
                if polygon.points().iter().all(|&p| edges.iter().all(|&edge| side(p, edge) > least)) {
                    polygon = polygon.within(pyramid, RAY * farthest(polygon.points()))?;
                }
            }
        }
        if polygon.count == 0 {
            return None;
        }
        let offset = corners.iter().map(|&p| normal.dot(p)).fold(f64::NEG_INFINITY, f64::max);
        // half of the least lift: the rounding of the point takes no more
        let height = 0.49 * (LIFT * offset.abs() + LEAST * reach);
        let off = OFF * magnitude(polygon.points()) + 2.0 * LEAST * reach;
        let ground = Ground { normal, offset, height };
        Some(Self { place, hull: Hull::new(polygon.points(), off), ground: Some(ground), ball: None })
    }
    fn of_sphere(center: V64, radius: f64, reach: f64, place: u32, viewer: Viewer<'_>) -> Option<Self> {
        if !(radius > 0.0 && radius.is_finite()) {
            return None;
        }
        let corner = |k: usize| {
            let side = |bit: usize| if k >> bit & 1 == 0 { -radius } else { radius };
            center + V64::new(side(0), side(1), side(2))
        };
        let mut corners: [V64; 8] = std::array::from_fn(corner);
        match viewer {
            Viewer::Front => {}
            Viewer::Back => return None,
            Viewer::Pixels(pyramid) => {
                let distance = (pyramid.origin - center).length();
                let error = SEEN / 12.0 * (distance + radius);
                let outside = distance > radius + 16.0 * error;
                if !outside {
                    return None;
                }
                // the corners of the clipped box are on its faces, apart from the pinhole
                let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
                let mut add = |p: V64| {
                    for (k, x) in [p.x, p.y, p.z].into_iter().enumerate() {
                        bounds = std::array::from_fn(|side| {
                            std::array::from_fn(|axis| match (axis == k, side) {
                                (true, 0) => bounds[0][axis].min(x),
                                (true, _) => bounds[1][axis].max(x),
                                _ => bounds[side][axis],
                            })
                        });
                    }
                };
                for face in [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]] {
                    let polygon = Clipped::new(&face.map(|k| corners[k])).within(pyramid, 16.0 * error)?;
                    polygon.points().iter().for_each(|&p| add(p));
                }
                let relative = pyramid.origin - center;
                if magnitude(&[relative]) <= radius * (1.0 + 1e-9) + 32.0 * error {
                    corners.iter().for_each(|&p| add(p));
                }
                if bounds[0][0] > bounds[1][0] {
                    return None;
                }
                corners =
                    std::array::from_fn(|k| V64::new(bounds[k & 1][0], bounds[k >> 1 & 1][1], bounds[k >> 2 & 1][2]));
            }
        }
        let off = OFF * magnitude(&corners) + 2.0 * LEAST * reach;
        Some(Self { place, hull: Hull::new(&corners, off), ground: None, ball: Some((center, radius)) })
    }
    /// Corners of the patch on its surface, or of a box around it.
    pub fn corners(&self) -> impl Iterator<Item = [f64; 3]> {
        self.hull.corners().iter().map(|p| [p.x, p.y, p.z])
    }
    /// How far shading points can be from the convex hull of the corners.
    pub fn margin(&self) -> f64 {
        self.hull.radius
    }
    /// How high shading points are above the plane of a flat patch, at least; 0 for a part of a sphere.
    pub fn least_height(&self) -> f64 {
        self.ground.map_or(0.0, |ground| ground.height)
    }
    /// Unit normal of a flat patch on the side of the viewer.
    pub fn normal(&self) -> Option<[f64; 3]> {
        self.ground.map(|ground| [ground.normal.x, ground.normal.y, ground.normal.z])
    }
}
