//! Half-spaces around all segments from a patch to a light.

use crate::hull::{Hull, V64, magnitude, unit};
use crate::light::Light;
use crate::measure::ENDS;
use crate::patch::{Patch, TILT};
use alloc::vec::Vec;
use etendue::Real;

/// Rounding of points on lights and of directions to them, relative to the greatest coordinate.
const ROUNDED: f64 = 1.0 / 524_288.0;
/// Rounding in double precision, relative to the greatest coordinate: 32 ulp.
const EPSILON: f64 = 1.0 / (1_u64 << 48) as f64;

/// A half-space: the points x with n·x ≤ c, for a vector n of at most about unit length.
pub type HalfSpace = (V64, f64);

/// The convex region that contains all segments from a patch to a light: an intersection of half-spaces, at most 40.
#[derive(Clone, Copy, Debug)]
pub struct Region<'a> {
    planes: &'a [HalfSpace],
}

impl<'a> Region<'a> {
    /// The half-spaces.
    #[must_use]
    pub const fn half_spaces(&self) -> &'a [HalfSpace] {
        self.planes
    }
    /// Whether a box between two corners certainly has no point in the region.
    #[must_use]
    pub fn misses_box(&self, low: V64, high: V64) -> bool {
        let least = |n: f64, low: f64, high: f64| n * if n > 0.0 { low } else { high };
        self.planes.iter().any(|&(n, limit)| {
            least(n.x, low.x, high.x) + least(n.y, low.y, high.y) + least(n.z, low.z, high.z) > limit
        })
    }
}

/// What is known of a light before anything between it and a patch is considered.
pub(crate) enum Facing {
    /// The light emits towards all of the patch, from above its plane at least in part.
    Towards,
    /// The light does not reach any point of the patch.
    Away,
    /// The patch straddles the light's plane or touches its ball, or the numbers are too large or too small.
    Unknown,
}

/// All segments from a patch to a light, but for their ends.
#[derive(Debug, Default)]
pub(crate) struct Shaft {
    pub(crate) patch: Hull,
    /// Includes the rounding of points on it.
    pub(crate) light: Hull,
    /// Bounds rounding in n·x for vectors of at most unit length and any point of the scene.
    pub(crate) epsilon: f64,
    /// More than the height over a surface up to which the end of a segment is [level](ENDS) with it.
    pub(crate) ends: f64,
    /// Half-spaces n·x ≤ c that contain the shaft.
    planes: Vec<HalfSpace>,
    /// The plane of the patch, by its unit normal and n·x, if it is flat.
    pub(crate) on_plane: Option<(V64, f64)>,
    /// The centre and radius of the sphere of the patch, if it lies on one.
    pub(crate) on_ball: Option<(V64, f64)>,
    /// For a flat light, the unit normal on the side of the patch, n·x of the light and the least height over it that a segment reaches.
    pub(crate) end: Option<(V64, f64, f64)>,
}

impl Shaft {
    /// Computes the half-spaces. The shaft is valid only if the light is [`Facing::Towards`] the patch.
    pub(crate) fn set(&mut self, patch: &Patch, lamp: &Light, reach: f64) -> Facing {
        let scale = magnitude(patch.hull.corners()).max(magnitude(lamp.hull.corners()));
        let scale = scale.max(reach).max(lamp.hull.radius);
        // squares and cubes of the numbers in between are finite and not subnormal, in both precisions
        if !(scale > 1e-25 && scale < 1e25) {
            return Facing::Unknown;
        }
        let near = magnitude(patch.hull.corners()).max(magnitude(lamp.hull.corners()));
        let rounded = (near + lamp.hull.radius) * ROUNDED;
        (self.patch, self.light) = (patch.hull, lamp.hull);
        self.light.inflate(rounded);
        self.epsilon = EPSILON * scale;
        self.ends = ENDS * (near + lamp.hull.radius);
        self.on_plane = patch.ground.map(|ground| (ground.normal, ground.offset));
        self.on_ball = patch.ball;
        self.planes.clear();
        self.end = None;
        let (patch_hull, light) = (&patch.hull, &lamp.hull);
        let between = (light.center - patch_hull.center).length();
        let length = between + patch_hull.extent + light.extent + rounded;
        match lamp.plane {
            Some((mut normal, mut offset)) => {
                let [mut least, mut most] = patch_hull.range(normal).map(|x| x - offset);
                let margin = patch_hull.radius + rounded + self.epsilon;
                if most < -margin && !lamp.two_sided {
                    return Facing::Away;
                }
                if most < -margin {
                    (normal, offset, least, most) = (-normal, -offset, -most, -least);
                }
                if !(least > margin && most.is_finite()) {
                    return Facing::Unknown;
                }
                // Heights over the light's plane decrease linearly along a segment.
                // Coordinates are at least a part 1/(2√3) of the length of a segment.
                let height = (least - patch_hull.radius) * (0.28 * ENDS) - self.epsilon;
                self.end = Some((normal, offset, height));
                self.push(-normal, -(offset + height));
            }
            None => {
                let margin = light.radius + rounded + patch_hull.radius + self.epsilon;
                let apart = between > patch_hull.extent + light.radius + rounded + self.epsilon;
                let above = patch.ground.is_some_and(|g| (g.normal.dot(light.center) - g.offset).abs() > margin);
                if !(apart || above) {
                    return Facing::Unknown;
                }
            }
        }
        if let Some(ground) = patch.ground {
            let [least, most] = light.range(ground.normal).map(|x| x - ground.offset);
            // A direction that counts as above the horizon leads at most `slack` below the height of its origin.
            let slack = TILT * length;
            if most + light.radius < ground.height - slack - rounded - self.epsilon {
                return Facing::Away;
            }
            // A segment ends at this height or above, and begins at `height`.
            let end = (least - light.radius).max(ground.height - slack);
            let floor = ground.height.min(end) - self.epsilon;
            self.push(-ground.normal, -(ground.offset + floor));
        }
        for axis in [V64::new(1.0, 0.0, 0.0), V64::new(0.0, 1.0, 0.0), V64::new(0.0, 0.0, 1.0)] {
            self.support(axis);
            self.support(-axis);
        }
        match (patch.ground.is_some(), lamp.plane) {
            (true, Some(_)) => {
                self.tangents(&patch.hull, &lamp.hull);
                self.tangents(&lamp.hull, &patch.hull);
            }
            (true, None) => {
                self.tangents_to_ball(&patch.hull, &lamp.hull);
                self.around();
            }
            (false, _) => self.around(),
        }
        Facing::Towards
    }
    fn push(&mut self, normal: V64, limit: f64) {
        self.planes.push((normal, limit));
    }
    /// Adds the half-space with normal `n`, of at most about unit length, that touches the shaft.
    fn support(&mut self, n: V64) {
        let limit = self.patch.support(n).max(self.light.support(n)) + self.epsilon;
        if limit.is_finite() {
            self.push(n, limit);
        }
    }
    /// Adds the planes through an edge of one polygon and a corner of the other that have both on one side.
    fn tangents(&mut self, one: &Hull, other: &Hull) {
        let tolerance = 1e-9 * (one.extent + other.extent);
        let count = one.corners().len();
        for (i, &a) in one.corners().iter().enumerate() {
            let edge = one.corners()[(i + 1) % count] - a;
            let inwards = one.center - a;
            for &corner in other.corners() {
                let n = unit(edge.cross(corner - a));
                let n = if n.dot(inwards) > 0.0 { -n } else { n };
                if other.corners().iter().all(|&p| n.dot(p - a) <= tolerance) {
                    self.support(n);
                    break;
                }
            }
        }
    }
    /// Adds the planes through an edge of a polygon that touch a ball, and have both on one side.
    fn tangents_to_ball(&mut self, polygon: &Hull, ball: &Hull) {
        let count = polygon.corners().len();
        for (i, &a) in polygon.corners().iter().enumerate() {
            let edge = unit(polygon.corners()[(i + 1) % count] - a);
            let to = ball.center - a;
            let across = to - edge * edge.dot(to);
            let distance = across.length();
            let across = across * (1.0 / distance);
            let sin = ball.radius / distance;
            let turned = edge.cross(across) * Real::sqrt(1.0 - sin * sin);
            let inwards = polygon.center - a;
            for n in [turned - across * sin, -turned - across * sin] {
                if n.dot(inwards) <= 0.0 {
                    self.support(n);
                }
            }
        }
    }
    /// Adds eight planes that touch balls around patch and light, or are parallel to those.
    fn around(&mut self) {
        let axis = self.light.center - self.patch.center;
        let distance = axis.length();
        let axis = axis * (1.0 / distance);
        let sin = ((self.patch.extent - self.light.extent) / distance).clamp(-1.0, 1.0);
        let cos = Real::sqrt(1.0 - sin * sin);
        let helper = if axis.x.abs() < 0.6 { V64::new(1.0, 0.0, 0.0) } else { V64::new(0.0, 1.0, 0.0) };
        let s = unit(axis.cross(helper));
        let t = axis.cross(s);
        let diagonal = core::f64::consts::FRAC_1_SQRT_2;
        let sides = [s, t, (s + t) * diagonal, (s + t * -1.0) * diagonal];
        for side in sides.into_iter().flat_map(|side| [side, -side]) {
            self.support(side * cos + axis * sin);
        }
    }
    /// Half-spaces around the shaft.
    pub(crate) fn region(&self) -> Region<'_> {
        Region { planes: &self.planes }
    }
    /// Is a hull of points, inflated by `radius`, known not to meet the shaft?
    pub(crate) fn misses(&self, points: &[V64], radius: f64) -> bool {
        self.planes.iter().any(|&(n, limit)| points.iter().all(|&p| n.dot(p) - radius > limit))
    }
}
