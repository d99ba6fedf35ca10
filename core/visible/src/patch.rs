//! Parts of surfaces, as bounds of the shading points of rays through a rectangle of pixels.

use crate::hull::{CORNERS, FACES_OF_BOX, Hull, V64, corner_of_box, magnitude, unit};

/// How a host computes shading points: it moves them along the normal by [`relative`](Self::relative) of Σ|nₖ pₖ| and by
/// [`least`](Self::least), and rounds them by no more than half of the first.
///
/// So they are at most 3 times the first, of their greatest coordinate, and twice the second from where the ideal surface is, and 0.49 of
/// both or more above it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lift {
    /// Relative to the coordinates: 2⁻²³ for points in single precision.
    pub relative: f64,
    /// In scene units.
    pub least: f64,
}

impl Lift {
    /// How far points can be from the patch whose greatest coordinate this is: moved by less than 1.8 times the lift, and rounded by 0.9.
    fn off(self, magnitude: f64) -> f64 {
        3.0 * self.relative * magnitude + 2.0 * self.least
    }
}

/// Greatest difference between the cosine of a direction, computed in single precision, and the exact one: a normal is rounded by less than
/// 2⁻²⁴, and so is each of three products and sums.
pub(crate) const TILT: f64 = 1.0 / 2_097_152.0;
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
    /// The pyramid between four directions in order around, of any length. For rays that are rounded, they are those of a rectangle that is
    /// wider by an eighth of a pixel on each side.
    #[must_use]
    pub fn new(origin: V64, corners: [V64; 4]) -> Self {
        let middle = corners[0] + corners[1] + corners[2] + corners[3];
        let normals = core::array::from_fn(|k| {
            let normal = unit(corners[k].cross(corners[(k + 1) % 4]));
            if normal.dot(middle) < 0.0 { -normal } else { normal }
        });
        Self { origin, normals }
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
pub(crate) struct Ground {
    /// Unit normal on the side of the viewer.
    pub(crate) normal: V64,
    /// n·x of the plane.
    pub(crate) offset: f64,
    /// Shading points are at least this high above the plane.
    pub(crate) height: f64,
}

/// A bound of the shading points on a part of a flat surface or of a sphere.
#[derive(Clone, Copy, Debug)]
pub struct Patch {
    pub(crate) hull: Hull,
    /// The plane of a flat patch.
    pub(crate) ground: Option<Ground>,
    /// Centre and radius of a sphere.
    pub(crate) ball: Option<(V64, f64)>,
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
    /// A convex polygon of 3 to 8 corners in order around, on the side of its normal (b − a) × (c − a). Shading points are within `off` of
    /// it, in scene units, and at least `height` above its plane, which may be negative: then they may be below their own plane, and what
    /// lies in it may hide lights. `None` if there are too few corners or too many, without area, and for numbers that are not finite.
    #[must_use]
    pub fn polygon(corners: &[V64], off: f64, height: f64) -> Option<Self> {
        let (&[a, b, c, ..], 3..=CORNERS) = (corners, corners.len()) else { return None };
        let normal = unit((b - a).cross(c - a));
        let offset = corners.iter().map(|&p| normal.dot(p)).fold(f64::NEG_INFINITY, f64::max);
        let is_finite = offset.is_finite() && off.is_finite() && height.is_finite();
        let ground = Ground { normal, offset, height };
        is_finite.then(|| Self { hull: Hull::new(corners, off), ground: Some(ground), ball: None })
    }
    /// The part of a triangle that a viewer sees, regardless of occlusion. `None` if there is no such part, and for triangles without area
    /// or seen edge-on.
    #[must_use]
    pub fn triangle(corners: [V64; 3], viewer: Viewer<'_>, lift: Lift) -> Option<Self> {
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
        let height = 0.49 * (lift.relative * offset.abs() + lift.least);
        let off = lift.off(magnitude(polygon.points()));
        let ground = Ground { normal, offset, height };
        Some(Self { hull: Hull::new(polygon.points(), off), ground: Some(ground), ball: None })
    }
    /// The part of the outside of a sphere that a viewer sees, regardless of occlusion. `None` if there is no such part, and from inside.
    #[must_use]
    pub fn sphere(center: V64, radius: f64, viewer: Viewer<'_>, lift: Lift) -> Option<Self> {
        if !(radius > 0.0 && radius.is_finite()) {
            return None;
        }
        let wide = V64::new(radius, radius, radius);
        let mut corners: [V64; 8] = core::array::from_fn(|k| corner_of_box([center - wide, center + wide], k));
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
                let all = V64::new(f64::INFINITY, f64::INFINITY, f64::INFINITY);
                let [mut low, mut high] = [all, -all];
                let mut add = |p: V64| {
                    low = V64::new(low.x.min(p.x), low.y.min(p.y), low.z.min(p.z));
                    high = V64::new(high.x.max(p.x), high.y.max(p.y), high.z.max(p.z));
                };
                for face in FACES_OF_BOX {
                    let polygon = Clipped::new(&face.map(|k| corners[k])).within(pyramid, 16.0 * error)?;
                    polygon.points().iter().for_each(|&p| add(p));
                }
                let relative = pyramid.origin - center;
                if magnitude(&[relative]) <= radius * (1.0 + 1e-9) + 32.0 * error {
                    corners.iter().for_each(|&p| add(p));
                }
                if low.x > high.x {
                    return None;
                }
                corners = core::array::from_fn(|k| corner_of_box([low, high], k));
            }
        }
        let off = lift.off(magnitude(&corners));
        Some(Self { hull: Hull::new(&corners, off), ground: None, ball: Some((center, radius)) })
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
