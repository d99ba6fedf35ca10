//! Half-spaces around all segments from a patch to a light.

use super::hull::{Hull, V64, magnitude, unit};
use super::patch::{Patch, TILT};
use crate::bvh::Region;
use crate::occlusion::{Convex, ENDS};
use crate::scene::Shape;

/// Rounding of points on lights and of directions to them, relative to the greatest coordinate.
const ROUNDED: f64 = 1.0 / 524_288.0;
/// Rounding in double precision, relative to the greatest coordinate: 32 ulp.
const EPSILON: f64 = 1.0 / (1_u64 << 48) as f64;

/// The outline of a light.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lamp {
    /// Index of its shape.
    pub(super) shape: u32,
    /// Without the rounding of points on it.
    pub(super) hull: Hull,
    pub(super) form: Form,
    two_sided: bool,
}

#[derive(Clone, Copy, Debug)]
pub(super) enum Form {
    /// A unit normal, and n·x of the plane.
    Flat(V64, f64),
    Ball,
}

impl Lamp {
    /// `None` for a light without area, and for a shape that does not emit.
    pub(super) fn new(shape: &Shape, index: u32) -> Option<Self> {
        let two_sided = shape.emission?.two_sided;
        let flat = |corners: &[V64]| {
            let normal = unit((corners[1] - corners[0]).cross(corners[2] - corners[0]));
            let offset = normal.dot(corners[0]);
            offset.is_finite().then(|| (Hull::new(corners, 0.0), Form::Flat(normal, offset)))
        };
        let (hull, form) = match shape.geometry.outline().convex().map(f64::from) {
            Convex::Sphere { center, radius } => {
                if !(radius > 0.0 && radius.is_finite()) {
                    return None;
                }
                (Hull::new(&[center], radius), Form::Ball)
            }
            Convex::Polygon { corners, count } => flat(&corners[..count])?,
            Convex::Parallelogram { corner: p, edges: [u, v] } => flat(&[p, p + u, p + u + v, p + v])?,
        };
        Some(Self { shape: index, hull, form, two_sided })
    }
}

/// What is known of a light before anything between it and a patch is considered.
pub(super) enum Facing {
    /// The light emits towards all of the patch, from above its plane at least in part.
    Towards,
    /// The light does not reach any point of the patch.
    Away,
    /// The patch straddles the light's plane or touches its ball, or the numbers are too large or too small.
    Unknown,
}

/// All segments from a patch to a light, but for their ends.
#[derive(Debug)]
pub(super) struct Shaft {
    pub(super) patch: Hull,
    /// Includes the rounding of points on it.
    pub(super) light: Hull,
    /// Bounds rounding in n·x for vectors of at most unit length and any point of the scene.
    pub(super) epsilon: f64,
    /// More than the height over a surface up to which the end of a segment is [level](ENDS) with it.
    pub(super) ends: f64,
    /// Half-spaces n·x ≤ c that contain the shaft.
    planes: Vec<(V64, f64)>,
    /// The plane of the patch, by its unit normal and n·x, if it is flat.
    pub(super) on_plane: Option<(V64, f64)>,
    /// The centre and radius of the sphere of the patch, if it lies on one.
    pub(super) on_ball: Option<(V64, f64)>,
    /// For a flat light, the unit normal on the side of the patch, n·x of the light and the least height over it that a segment reaches.
    pub(super) end: Option<(V64, f64, f64)>,
}

impl Shaft {
    /// Computes the half-spaces. The shaft is valid only if the light is [`Facing::Towards`] the patch.
    pub(super) fn set(&mut self, patch: &Patch, lamp: &Lamp, reach: f32, region: &mut Region) -> Facing {
        let scale = magnitude(patch.hull.corners()).max(magnitude(lamp.hull.corners()));
        let scale = scale.max(f64::from(reach)).max(lamp.hull.radius);
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
        region.clear();
        let (patch_hull, light) = (&patch.hull, &lamp.hull);
        let between = (light.center - patch_hull.center).length();
        let length = between + patch_hull.extent + light.extent + rounded;
        match lamp.form {
            Form::Flat(mut normal, mut offset) => {
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
                self.push(-normal, -(offset + height), region);
            }
            Form::Ball => {
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
            self.push(-ground.normal, -(ground.offset + floor), region);
        }
        for axis in [V64::new(1.0, 0.0, 0.0), V64::new(0.0, 1.0, 0.0), V64::new(0.0, 0.0, 1.0)] {
            self.support(axis, region);
            self.support(-axis, region);
        }
        match (patch.ground.is_some(), lamp.form) {
            (true, Form::Flat(..)) => {
                self.tangents(&patch.hull, &lamp.hull, region);
                self.tangents(&lamp.hull, &patch.hull, region);
            }
            (true, Form::Ball) => {
                self.tangents_to_ball(&patch.hull, &lamp.hull, region);
                self.around(region);
            }
            (false, _) => self.around(region),
        }
        Facing::Towards
    }
    fn push(&mut self, normal: V64, limit: f64, region: &mut Region) {
        self.planes.push((normal, limit));
        region.push([normal.x, normal.y, normal.z], limit);
    }
    /// Adds the half-space with normal `n`, of at most about unit length, that touches the shaft.
    fn support(&mut self, n: V64, region: &mut Region) {
        let limit = self.patch.support(n).max(self.light.support(n)) + self.epsilon;
        if limit.is_finite() {
            self.push(n, limit, region);
        }
    }
    /// Adds the planes through an edge of one polygon and a corner of the other that have both on one side.
    fn tangents(&mut self, one: &Hull, other: &Hull, region: &mut Region) {
        let tolerance = 1e-9 * (one.extent + other.extent);
        let count = one.corners().len();
        for (i, &a) in one.corners().iter().enumerate() {
            let edge = one.corners()[(i + 1) % count] - a;
            let inwards = one.center - a;
            for &corner in other.corners() {
                let n = unit(edge.cross(corner - a));
                let n = if n.dot(inwards) > 0.0 { -n } else { n };
                if other.corners().iter().all(|&p| n.dot(p - a) <= tolerance) {
                    self.support(n, region);
                    break;
                }
            }
        }
    }
    /// Adds the planes through an edge of a polygon that touch a ball, and have both on one side.
    fn tangents_to_ball(&mut self, polygon: &Hull, ball: &Hull, region: &mut Region) {
        let count = polygon.corners().len();
        for (i, &a) in polygon.corners().iter().enumerate() {
            let edge = unit(polygon.corners()[(i + 1) % count] - a);
            let to = ball.center - a;
            let across = to - edge * edge.dot(to);
            let distance = across.length();
            let across = across * (1.0 / distance);
            let sin = ball.radius / distance;
            let turned = edge.cross(across) * (1.0 - sin * sin).sqrt();
            let inwards = polygon.center - a;
            for n in [turned - across * sin, -turned - across * sin] {
                if n.dot(inwards) <= 0.0 {
                    self.support(n, region);
                }
            }
        }
    }
    /// Adds eight planes that touch balls around patch and light, or are parallel to those.
    fn around(&mut self, region: &mut Region) {
        let axis = self.light.center - self.patch.center;
        let distance = axis.length();
        let axis = axis * (1.0 / distance);
        let sin = ((self.patch.extent - self.light.extent) / distance).clamp(-1.0, 1.0);
        let cos = (1.0 - sin * sin).sqrt();
        let helper = if axis.x.abs() < 0.6 { V64::new(1.0, 0.0, 0.0) } else { V64::new(0.0, 1.0, 0.0) };
        let s = unit(axis.cross(helper));
        let t = axis.cross(s);
        let diagonal = std::f64::consts::FRAC_1_SQRT_2;
        let sides = [s, t, (s + t) * diagonal, (s + t * -1.0) * diagonal];
        for side in sides.into_iter().flat_map(|side| [side, -side]) {
            self.support(side * cos + axis * sin, region);
        }
    }
    /// Is a hull of points, inflated by `radius`, known not to meet the shaft?
    pub(super) fn misses(&self, points: &[V64], radius: f64) -> bool {
        self.planes.iter().any(|&(n, limit)| points.iter().all(|&p| n.dot(p) - radius > limit))
    }
}

impl Default for Shaft {
    fn default() -> Self {
        let nothing = Hull::default();
        Self {
            patch: nothing,
            light: nothing,
            epsilon: 0.0,
            ends: 0.0,
            planes: Vec::with_capacity(40),
            on_plane: None,
            on_ball: None,
            end: None,
        }
    }
}
