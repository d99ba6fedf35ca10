//! Rays in packets of eight, and their hits.

use super::primitive::{PrimitiveId, PrimitiveIds};
use crate::packet::{M8, V8, X8};
use etendue::{Frame, Mask, Real, Vec3};

/// Greatest number of packets in a group.
pub const GROUP: usize = 8;

/// Eight rays, prepared for traversal.
#[derive(Clone, Copy, Debug)]
pub struct Rays {
    /// Origins.
    pub origin: V8,
    /// Unit directions.
    pub direction: V8,
    /// Two unit vectors that complete the direction to a frame; vertices are projected onto them along the ray.
    pub(super) frame: [V8; 2],
    pub(super) inverse: V8,
    /// −(origin ± pad)/direction, for the lower and the upper planes of boxes.
    pub(super) offset: [V8; 2],
    /// Whether the rays run towards − along each axis; `None` if they disagree along one.
    pub(super) common_sign: Option<[bool; 3]>,
    /// Greatest distance by which boxes are widened.
    pub(super) pad: f32,
    /// The primitives on which the rays begin.
    pub(super) from: PrimitiveIds,
}

impl Default for Rays {
    fn default() -> Self {
        let zero = V8::default();
        Self {
            origin: zero,
            direction: zero,
            frame: [zero; 2],
            inverse: zero,
            offset: [zero; 2],
            common_sign: None,
            pad: 0.0,
            from: PrimitiveIds::none(),
        }
    }
}

impl Rays {
    /// Prepares eight rays. `reach` is the greatest magnitude of a coordinate in the scene; slabs are widened in proportion to it.
    #[inline(always)]
    pub fn new(origin: V8, direction: V8, reach: f32) -> Self {
        let frame = Frame::new(direction);
        // 2⁻²⁰ of the largest coordinate involved: 16 times the rounding of a vertex relative to the origin
        let pad = (origin.max_abs() + X8::splat(reach)) * X8::lit(1.0 / 1_048_576.0);
        let own = Self { origin, direction, frame: [frame.s, frame.t], ..Self::default() };
        own.entering(origin, direction, pad)
    }
    /// The same rays, which enter boxes of another space, where they have this origin and direction and the same distances.
    /// Boxes are widened by `pad`.
    #[inline(always)]
    pub(super) fn entering(&self, origin: V8, direction: V8, pad: X8) -> Self {
        // components below 1e−18 count as 1e−18, with which a ray never reaches the planes across that axis; in scenes beyond 1e19 they are
        // as great as the range of numbers asks for
        let least = (pad * X8::lit(1e-31)).greater(X8::lit(1e-18));
        let invert = |d: X8| X8::lit(1.0) / d.abs().greater(least).copysign(d);
        let inverse = Vec3::new(invert(direction.x), invert(direction.y), invert(direction.z));
        let plane = |o: V8, pad: X8| {
            Vec3::new(-((o.x + pad) * inverse.x), -((o.y + pad) * inverse.y), -((o.z + pad) * inverse.z))
        };
        let negative =
            [direction.x, direction.y, direction.z].map(|d| X8::lit(1.0).copysign(d).lt(X8::lit(0.0)).bits());
        let common = negative.iter().all(|&bits| bits == 0 || bits == 0xff);
        Self {
            inverse,
            offset: [plane(origin, pad), plane(origin, -pad)],
            common_sign: common.then(|| negative.map(|bits| bits != 0)),
            pad: pad.to_array().into_iter().fold(0.0, f32::max),
            ..*self
        }
    }
    /// The same rays, which begin on these primitives. A flat primitive never occludes its own points, and a sphere only those
    /// on its inside.
    #[inline(always)]
    #[must_use]
    pub fn leaving(self, from: PrimitiveIds) -> Self {
        Self { from, ..self }
    }
}

/// The nearest hits of eight rays.
#[derive(Clone, Copy, Debug)]
pub struct Hits {
    /// Distances; the rays' limits for misses.
    pub distance: X8,
    /// What the rays hit.
    pub primitives: PrimitiveIds,
}

impl Hits {
    /// Misses, with hits to be searched nearer than `limit`.
    #[inline]
    pub fn none(limit: X8) -> Self {
        Self { distance: limit, primitives: PrimitiveIds::none() }
    }
    /// Lanes that hit something.
    #[inline]
    pub fn any(&self) -> M8 {
        self.primitives.some()
    }
    #[inline]
    pub(super) fn nearest(&self, lane: usize) -> Nearest {
        Nearest { distance: self.distance.as_array()[lane], primitive: self.primitives.lane(lane) }
    }
    #[inline]
    pub(super) fn put(&mut self, lane: usize, nearest: &Nearest) {
        self.distance.as_mut_array()[lane] = nearest.distance;
        self.primitives.set(lane, nearest.primitive);
    }
    /// Lanes that hit a shape.
    #[inline]
    pub fn shapes(&self) -> M8 {
        self.primitives.shapes()
    }
}

/// The nearest hit of one ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nearest {
    pub(super) distance: f32,
    pub(super) primitive: PrimitiveId,
}

/// The signs of direction that all rays of a group share, if they do.
#[inline]
pub(super) fn common_sign(rays: &[Rays]) -> Option<[bool; 3]> {
    let sign = rays[0].common_sign?;
    rays[1..].iter().all(|r| r.common_sign == Some(sign)).then_some(sign)
}

/// The octant of a group: bit k is set if all rays run towards − along axis k; 8 means that they disagree.
pub(super) fn octant(rays: &[Rays]) -> usize {
    common_sign(rays).map_or(8, |sign| (0..3).fold(0, |octant, k| octant | usize::from(sign[k]) << k))
}

/// Calls a function that is specialised to the octant of the rays, or to `other` if there is none.
macro_rules! by_octant {
    ($octant:expr, else $other:literal, $function:ident::<$any:ident>($($argument:expr),*)) => {
        match $octant {
            0 => $function::<$any, 0>($($argument),*),
            1 => $function::<$any, 1>($($argument),*),
            2 => $function::<$any, 2>($($argument),*),
            3 => $function::<$any, 3>($($argument),*),
            4 => $function::<$any, 4>($($argument),*),
            5 => $function::<$any, 5>($($argument),*),
            6 => $function::<$any, 6>($($argument),*),
            7 => $function::<$any, 7>($($argument),*),
            _ => $function::<$any, $other>($($argument),*),
        }
    };
}
pub(super) use by_octant;

/// Whether a ray of the group is active.
#[inline]
pub(super) fn any(active: &[M8]) -> bool {
    active.iter().any(|a| a.any())
}
