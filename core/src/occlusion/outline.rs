//! Convex polygons as seen from a point, and what planes leave of them.

use super::TooMany;
use crate::math::rsqrt;
use crate::real::{Mask, Real};
use crate::vector::Vec3;

/// A convex polygon with up to `MOST` corners, relative to the point of each lane. Corners may coincide.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outline<R: Real, const MOST: usize> {
    corners: [Vec3<R>; MOST],
    count: usize,
    /// Lanes in which something is left.
    some: R::Mask,
}

impl<R: Real, const MOST: usize> Default for Outline<R, MOST> {
    fn default() -> Self {
        Self { corners: [Vec3::default(); MOST], count: 0, some: R::Mask::splat(false) }
    }
}

/// θ/sinθ from cosθ and sin²θ.
#[inline(always)]
fn angle_over_sine<R: Real>(cos: R, sin_squared: R) -> R {
    let (zero, one) = (R::lit(0.0), R::lit(1.0));
    let cos = cos.clamped(-one, one);
    // the ratio is a smooth function of the cosine up to a right angle; beyond, only the sine keeps the digits of an edge across the point
    let square = R::blend(cos.lt(zero), sin_squared, (one - cos) * (one + cos)).greater(R::lit(1e-30));
    let ratio = cos.acos() * rsqrt(square);
    R::blend(cos.gt(R::lit(0.999_999)), R::lit(1.0 / 3.0).mul_add(one - cos, one), ratio)
}

impl<R: Real, const MOST: usize> Outline<R, MOST> {
    pub(super) fn corners(&self) -> &[Vec3<R>] {
        &self.corners[..self.count]
    }
    /// Starts over with these corners, at most `MOST`, in some of the lanes.
    #[inline(always)]
    pub(super) fn start(&mut self, corners: &[Vec3<R>], some: R::Mask) {
        self.count = corners.len();
        self.corners[..corners.len()].copy_from_slice(corners);
        self.some = some;
    }
    pub(super) fn is_empty(&self) -> bool {
        !self.some.any()
    }
    pub(super) fn some(&self) -> R::Mask {
        self.some
    }

    /// Keeps the part where normal · x ≥ `least`.
    ///
    /// The outline stays closed whatever is rounded: each corner outside becomes a point on an edge that crosses the plane. Where only one
    /// corner is outside, it becomes two, and those after it move on by one.
    #[inline]
    pub(super) fn clip(&mut self, normal: Vec3<R>, least: R) -> Result<(), TooMany> {
        // unrolled for each number of corners, so that they stay in registers
        match self.count {
            3 => self.clip_corners::<3>(normal, least),
            4 => self.clip_corners::<4>(normal, least),
            5 => self.clip_corners::<5>(normal, least),
            6 => self.clip_corners::<6>(normal, least),
            7 => self.clip_corners::<7>(normal, least),
            8 => self.clip_corners::<8>(normal, least),
            9 => self.clip_corners::<9>(normal, least),
            _ => Err(TooMany),
        }
    }

    #[inline]
    fn clip_corners<const N: usize>(&mut self, normal: Vec3<R>, least: R) -> Result<(), TooMany> {
        let (zero, no) = (R::lit(0.0), R::Mask::splat(false));
        let Some(corners) = self.corners.first_chunk_mut::<N>() else { return Err(TooMany) };
        let height = corners.map(|corner| corner.dot(normal) - least);
        let inside = height.map(|height| height.ge(zero));
        let any = inside.iter().fold(no, |any, &inside| any | inside);
        let all = inside.iter().fold(!no, |all, &inside| all & inside);
        self.some = self.some & any;
        if !(self.some & !all).any() {
            return Ok(());
        }
        let next = |i: usize| if i + 1 == N { 0 } else { i + 1 };
        // where edge i crosses the plane, if it does, and the last place at which the outline leaves the inside
        let crossing: [Vec3<R>; N] = core::array::from_fn(|i| {
            let j = next(i);
            (corners[j] - corners[i]).mul_add(height[i] / (height[i] - height[j]), corners[i])
        });
        let mut left = crossing[N - 1];
        for i in 0..N {
            left = Vec3::blend(inside[i] & !inside[next(i)], crossing[i], left);
        }
        let (mut moved, mut carried) = (no, left);
        for i in 0..N {
            let (before, after) = (if i == 0 { N - 1 } else { i - 1 }, next(i));
            let leaves = inside[before] & !inside[i];
            let returns = inside[after] & !inside[i];
            left = Vec3::blend(leaves, crossing[before], left);
            let alone = leaves & returns;
            // only the first corner alone can become two; rounding alone makes another, within its error of the plane
            let stays = inside[i] | (alone & moved);
            let outside = Vec3::blend(returns & !leaves, crossing[i], left);
            let corner = Vec3::blend(stays, corners[i], outside);
            let splits = alone & !moved;
            corners[i] = Vec3::blend(moved, carried, corner);
            carried = Vec3::blend(splits, crossing[i], corner);
            moved = moved | splits;
        }
        if (moved & self.some).any() {
            let last = Vec3::blend(moved, carried, corners[N - 1]);
            *self.corners.get_mut(N).ok_or(TooMany)? = last;
            self.count += 1;
        }
        Ok(())
    }

    /// ½ n·Σ θᵢ Γᵢ, which is Ω⊥ if no part lies below the horizon; 0 in lanes in which nothing is left.
    #[inline]
    pub(super) fn projected_solid_angle(&self, normal: Vec3<R>) -> R {
        let zero = R::lit(0.0);
        let inverse = |v: Vec3<R>| {
            let square = v.length_squared();
            rsqrt(R::blend(square.gt(zero), square, R::lit(1.0)))
        };
        let mut sum = zero;
        let corners = self.corners();
        let mut from = corners[corners.len() - 1];
        let mut inverse_from = inverse(from);
        for &to in corners {
            let inverse_to = inverse(to);
            let scale = inverse_from * inverse_to;
            let across = from.cross(to) * scale;
            sum += across.dot(normal) * angle_over_sine(from.dot(to) * scale, across.length_squared());
            (from, inverse_from) = (to, inverse_to);
        }
        (sum * R::lit(0.5)).abs().keep(self.some)
    }
}
