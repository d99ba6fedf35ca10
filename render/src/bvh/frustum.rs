//! The common frustum of a group of packets.

use super::Rays;
use super::tree::Node;
use crate::packet::{M8, V8, X8, max, min, select};
use etendue::{Mask, Real};

/// A frustum that contains all rays of a group. All rays run the same way along one axis; across it, they are bounded by their least
/// and greatest slopes. One test finds the children of a node that any ray of the group can enter.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frustum {
    axis: usize,
    negative: bool,
    /// Least and greatest origin, widened.
    origin: [[f32; 3]; 2],
    /// Least and greatest slope: change of a coordinate per unit along the axis, in the direction of the rays.
    slope: [[f32; 3]; 2],
    /// Greatest step along the axis per unit of distance.
    along: f32,
}

/// Groups whose slopes differ by more than this share too few leaves: they are faster as a stream.
const SPREAD: f32 = 0.02;

impl Frustum {
    /// The frustum of the active rays; `None` if they share no axis or spread too far.
    pub(super) fn new(rays: &[Rays], active: &[M8]) -> Option<Self> {
        let first = active.iter().position(|a| a.any())?;
        let lane = active[first].bits().trailing_zeros() as usize & 7;
        let direction = <[f32; 3]>::from(rays[first].direction.lane(lane));
        let axis = (0..3).max_by(|&a, &b| direction[a].abs().total_cmp(&direction[b].abs()))?;
        let negative = direction[axis] < 0.0;
        let infinite = X8::lit(f64::INFINITY);
        let mut least = [infinite; 7];
        let mut most = [-infinite; 7];
        let mut pad = 0.0_f32;
        for (r, &a) in rays.iter().zip(active) {
            let d = [r.direction.x, r.direction.y, r.direction.z][axis].negate_where(M8::splat(negative));
            let slope = r.direction * (X8::lit(1.0) / d);
            if Self::wide(slope, a) {
                return None;
            }
            let values = [r.origin.x, r.origin.y, r.origin.z, slope.x, slope.y, slope.z, d];
            for (k, value) in values.into_iter().enumerate() {
                least[k] = min(least[k], select(a, value, infinite));
                most[k] = max(most[k], select(a, value, -infinite));
            }
            pad = pad.max(r.pad);
        }
        let low = least.map(|x| x.to_array().into_iter().fold(f32::INFINITY, f32::min));
        let high = most.map(|x| x.to_array().into_iter().fold(f32::NEG_INFINITY, f32::max));
        // a NaN or an infinity among the slopes fails the comparison
        let narrow = (3..6).all(|k| high[k] - low[k] <= SPREAD);
        (low[6] > 0.0 && narrow).then(|| Self {
            axis,
            negative,
            origin: [std::array::from_fn(|k| low[k] - pad), std::array::from_fn(|k| high[k] + pad)],
            slope: [[low[3], low[4], low[5]], [high[3], high[4], high[5]]],
            along: high[6],
        })
    }

    /// Whether this packet alone spreads too far.
    #[inline(always)]
    fn wide(slope: V8, active: M8) -> bool {
        let lead = slope.lane(active.bits().trailing_zeros() as usize & 7);
        let apart = slope - V8::splat(lead);
        // a NaN fails the comparison, too
        let near = max(max(apart.x.abs(), apart.y.abs()), apart.z.abs()).le(X8::splat(SPREAD));
        (active & !near).any()
    }

    /// The children of a node that a ray of the group may enter within `reach`, and lower bounds of their entry distances.
    #[inline(always)]
    pub(super) fn enter(&self, node: &Node, reach: f32) -> (X8, M8) {
        let k = self.axis;
        let [low, high] = self.origin;
        let (lower, upper) = (X8::from(node.planes[0][k]), X8::from(node.planes[1][k]));
        let (near, far) = if self.negative {
            (X8::splat(low[k]) - upper, X8::splat(high[k]) - lower)
        } else {
            (lower - X8::splat(high[k]), upper - X8::splat(low[k]))
        };
        let near = max(near, X8::lit(0.0));
        let far = min(far, X8::splat(reach * self.along));
        let across = |i: usize| {
            let (least, greatest) = (self.slope[0][i], self.slope[1][i]);
            let from = if least < 0.0 { far } else { near };
            let to = if greatest < 0.0 { near } else { far };
            let from = X8::splat(least).mul_add(from, X8::splat(low[i]));
            let to = X8::splat(greatest).mul_add(to, X8::splat(high[i]));
            from.le(X8::from(node.planes[1][i])) & to.ge(X8::from(node.planes[0][i]))
        };
        let mask = near.le(far) & across((k + 1) % 3) & across((k + 2) % 3);
        // a distance is at least the step along the axis
        (near, mask)
    }
}
