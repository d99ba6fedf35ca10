//! Convex polygons as seen from a point, and what planes leave of them.

use super::capacity::TooMany;
use etendue::math::rsqrt;
use etendue::real::polynomial;
use etendue::{Mask, Real, Vec3};

/// A flat light looks compact if the squared distances of its corners from their mean are less than this fraction of that of the mean from
/// the point. What is visible of it is then accurate relative to the square of its size over its distance, not just to the angle around it.
pub const COMPACT: f64 = 0.25;

/// A convex polygon with up to `MOST` corners. Corners may coincide.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outline<R: Real, const MOST: usize> {
    /// The point from which corners are measured, relative to the point of each lane: the middle of the light, so that the rounding of a corner
    /// is relative to the size of the light, not to its distance.
    base: Vec3<R>,
    corners: [Vec3<R>; MOST],
    count: usize,
    /// Lanes in which something is left.
    some: R::Mask,
}

impl<R: Real, const MOST: usize> Default for Outline<R, MOST> {
    fn default() -> Self {
        Self { base: Vec3::default(), corners: [Vec3::default(); MOST], count: 0, some: R::Mask::splat(false) }
    }
}

/// (θ/sinθ − 1)/z in powers of z = 1 − cosθ: 2ⁿ(n!)²/(2n+1)! for n = 1 to 10.
const EXCESS: [f64; 10] = [
    1.0 / 3.0,
    2.0 / 15.0,
    2.0 / 35.0,
    8.0 / 315.0,
    8.0 / 693.0,
    16.0 / 3003.0,
    16.0 / 6435.0,
    128.0 / 109_395.0,
    128.0 / 230_945.0,
    256.0 / 969_969.0,
];

/// θ/sinθ − 1 from z = 1 − cosθ for z in [0, 1], up to a right angle. What the series leaves out is at most 1.1e−7, and 1e−16 in
/// double precision, at a right angle.
#[inline(always)]
fn excess<R: Real>(z: R) -> R {
    let (half, one) = (R::lit(0.5), R::lit(1.0));
    // the terms left out are less than 2e−8 z up to this limit, and 1e−16 z in double precision
    let limit = R::lit(if R::DOUBLE { 0.06 } else { 0.2 });
    let near = |z: R| {
        z * if R::DOUBLE { polynomial(z, EXCESS) } else { polynomial(z, [0, 1, 2, 3, 4, 5, 6].map(|i| EXCESS[i])) }
    };
    let is_near = z.lt(limit);
    if is_near.all() {
        return near(z);
    }
    // with the half θ′ of the angle, θ/sinθ is θ′/sinθ′ over cosθ′
    let halved = |z: R| {
        let cos = z.mul_add(-half, one).greater(half).sqrt();
        (half * z / (one + cos), one / cos)
    };
    let (first, over_first) = halved(z);
    let far = if R::DOUBLE {
        let (second, over_second) = halved(first);
        (near(second) + second) * over_second
    } else {
        near(first)
    };
    R::blend(is_near, near(z), (far + first) * over_first)
}

/// θ/sinθ from cosθ and sin²θ.
#[inline(always)]
fn angle_over_sine<R: Real>(cos: R, sin_squared: R) -> R {
    let one = R::lit(1.0);
    let ratio = one + excess(one - cos.abs().lesser(one));
    let obtuse = cos.lt(R::lit(0.0));
    if !obtuse.any() {
        return ratio;
    }
    // only the sine keeps the digits of an edge across the point
    let rest = R::lit(core::f64::consts::PI) * rsqrt(sin_squared.greater(R::lit(1e-30))) - ratio;
    R::blend(obtuse, rest, ratio)
}

impl<R: Real, const MOST: usize> Outline<R, MOST> {
    /// The corners, measured from the base.
    pub(super) fn corners(&self) -> &[Vec3<R>] {
        &self.corners[..self.count]
    }
    pub(super) fn base(&self) -> Vec3<R> {
        self.base
    }
    /// Starts over with these corners from a base, at most `MOST`, in some of the lanes.
    #[inline(always)]
    pub(super) fn start(&mut self, base: Vec3<R>, corners: &[Vec3<R>], some: R::Mask) {
        self.base = base;
        self.count = corners.len();
        // most have few corners, which a general copy would take longer for
        let to = &mut self.corners;
        match *corners {
            [a, b, c] if MOST > 2 => (to[0], to[1], to[2]) = (a, b, c),
            [a, b, c, d] if MOST > 3 => (to[0], to[1], to[2], to[3]) = (a, b, c, d),
            _ => to[..corners.len()].copy_from_slice(corners),
        }
        self.some = some;
    }
    /// Takes another outline after a linear map.
    #[inline]
    pub(super) fn take(&mut self, other: &Self, map: impl Fn(Vec3<R>) -> Vec3<R>) {
        (self.base, self.count, self.some) = (map(other.base), other.count, other.some);
        for (corner, &from) in self.corners.iter_mut().zip(other.corners()) {
            *corner = map(from);
        }
    }
    pub(super) fn is_empty(&self) -> bool {
        !self.some.any()
    }
    pub(super) fn some(&self) -> R::Mask {
        self.some
    }
    /// Leaves nothing in the other lanes.
    pub(super) fn keep(&mut self, lanes: R::Mask) {
        self.some = self.some & lanes;
    }

    /// Keeps the part where normal · x ≥ `least`.
    ///
    /// The outline stays closed whatever is rounded: each corner outside becomes a point on an edge that crosses the plane. Where only one
    /// corner is outside, it becomes two, and those after it move on by one. Rounding can put corners outside in several places, if they
    /// lie on the plane, as those of neighbours in a mesh do: only those in the place that is farthest outside are clipped.
    #[inline]
    pub(super) fn clip(&mut self, normal: Vec3<R>, least: R) -> Result<(), TooMany> {
        self.clip_in(R::Mask::splat(true), normal, least - self.base.dot(normal))
    }
    /// Clips in these lanes only, and keeps the part where normal · (x − base) ≥ `least`.
    #[inline]
    pub(super) fn clip_in(&mut self, lanes: R::Mask, normal: Vec3<R>, least: R) -> Result<(), TooMany> {
        // unrolled for each number of corners
        let (corners, some) = (&mut self.corners, &mut self.some);
        let splits = match self.count {
            3 => clip_corners::<R, 3>(corners, some, lanes, normal, least),
            4 => clip_corners::<R, 4>(corners, some, lanes, normal, least),
            5 => clip_corners::<R, 5>(corners, some, lanes, normal, least),
            6 => clip_corners::<R, 6>(corners, some, lanes, normal, least),
            7 => clip_corners::<R, 7>(corners, some, lanes, normal, least),
            8 => clip_corners::<R, 8>(corners, some, lanes, normal, least),
            9 => clip_corners::<R, 9>(corners, some, lanes, normal, least),
            10 => clip_corners::<R, 10>(corners, some, lanes, normal, least),
            11 => clip_corners::<R, 11>(corners, some, lanes, normal, least),
            12 => clip_corners::<R, 12>(corners, some, lanes, normal, least),
            _ => Err(TooMany),
        }?;
        self.count += usize::from(splits);
        Ok(())
    }
    /// Lanes in which any corner is inside of a plane that the base is above by `height`, and in which all are.
    #[inline(always)]
    pub(super) fn inside(&self, normal: Vec3<R>, height: R) -> (R::Mask, R::Mask) {
        self.corners().iter().fold((R::Mask::splat(false), R::Mask::splat(true)), |(any, all), corner| {
            let inside = corner.dot(normal).ge(-height);
            (any | inside, all & inside)
        })
    }
    /// Lanes in which the plane cuts what is left, or nearly does: corners are less than `reserve` above it and below it.
    #[inline(always)]
    pub(super) fn crosses(&self, normal: Vec3<R>, height: R, reserve: R) -> R::Mask {
        let (mut low, mut high) = (R::Mask::splat(false), R::Mask::splat(false));
        for corner in self.corners() {
            let above = corner.dot(normal) + height;
            (low, high) = (low | above.lt(reserve), high | above.gt(-reserve));
        }
        self.some & low & high
    }
    /// ½ n·Σ θᵢ Γᵢ, which is Ω⊥ if no part lies below the horizon; 0 in lanes in which nothing is left.
    #[inline]
    pub(super) fn projected_solid_angle(&self, normal: Vec3<R>) -> R {
        let some = self.some;
        let most = self.corners().iter().fold(R::lit(0.0), |most, corner| most.greater(corner.length_squared()));
        let square = self.base.length_squared();
        let compact = most.lt(square * R::lit(COMPACT)) & square.gt(R::lit(1e-30));
        let part = if (compact | !some).all() {
            self.compact_projected_solid_angle(normal)
        } else if (compact & some).any() {
            R::blend(compact, self.compact_projected_solid_angle(normal), self.wide_projected_solid_angle(normal))
        } else {
            self.wide_projected_solid_angle(normal)
        };
        part.keep(some)
    }

    /// Ω⊥ of an outline whose corners are all nearer to the base than half of its distance.
    ///
    /// With xᵢ = x₀ + zᵢ, eᵢ = zᵢ₊₁ − zᵢ and kᵢ = θᵢ/(sinθᵢ |xᵢ| |xᵢ₊₁|) the sum is Σ kᵢ xᵢ × eᵢ. All its terms are of first order in the size
    /// of the outline, while the sum is of second order. Since Σ eᵢ = 0, any constant k̄ can be subtracted from the kᵢ of x₀ × Σ kᵢ eᵢ: with
    /// k̄ = |x₀|⁻² and kᵢ = k̄ (1 + κᵢ), the sum is k̄ (x₀ × Σ κᵢ eᵢ + Σ (1 + κᵢ) zᵢ × eᵢ), whose terms all are of second order. The small
    /// numbers κᵢ come from small numbers: 1 − |x₀|/|xᵢ| from |xᵢ|²/|x₀|² − 1 = (2 x₀ + zᵢ) · zᵢ / |x₀|², and θ/sinθ − 1 from
    /// 1 − cosθ = (|eᵢ|² − (|xᵢ₊₁| − |xᵢ|)²) / (2 |xᵢ| |xᵢ₊₁|).
    #[inline(always)]
    fn compact_projected_solid_angle(&self, normal: Vec3<R>) -> R {
        let (one, base) = (R::lit(1.0), self.base);
        let square = base.length_squared();
        let scale = one / R::blend(square.gt(R::lit(1e-30)), square, one);
        let plain_cross = |a: Vec3<R>, b: Vec3<R>| {
            let of = |a: R, b: R, c: R, d: R| a.mul_add(b, -(c * d));
            Vec3::new(of(a.y, b.z, a.z, b.y), of(a.z, b.x, a.x, b.z), of(a.x, b.y, a.y, b.x))
        };
        // |x|/|x₀|, |x₀|/|x| and 1 − |x₀|/|x|, from |x|²/|x₀|² − 1
        let lengths = |z: Vec3<R>| {
            let longer = (base + base + z).dot(z) * scale;
            let root = (one + longer).greater(R::lit(0.2)).sqrt();
            let over = one / (root * (one + root));
            (root, over * (one + root), longer * over)
        };
        let corners = self.corners();
        let mut from = corners[corners.len() - 1];
        let (mut far_from, mut near_from, mut less_from) = lengths(from);
        let (mut sum, mut area) = (Vec3::default(), Vec3::default());
        for &to in corners {
            let (far_to, near_to, less_to) = lengths(to);
            let edge = to - from;
            let near = near_from * near_to;
            let farther = far_to - far_from;
            let versine = edge.length_squared().mul_add(scale, -(farther * farther)) * near * R::lit(0.5);
            let kappa = excess(versine) * near - (less_from + less_to - less_from * less_to);
            sum += edge * kappa;
            area += plain_cross(from, edge) * (one + kappa);
            (from, far_from, near_from, less_from) = (to, far_to, near_to, less_to);
        }
        (normal.dot(plain_cross(base, sum) + area) * (R::lit(0.5) * scale)).abs()
    }

    /// Ω⊥ of any outline.
    fn wide_projected_solid_angle(&self, normal: Vec3<R>) -> R {
        let zero = R::lit(0.0);
        let inverse = |v: Vec3<R>| {
            let square = v.length_squared();
            // a corner this near to the point, for the size of the outline, is at the point
            rsqrt(R::blend(square.gt(R::lit(1e-30)), square, R::lit(1.0)))
        };
        let mut sum = zero;
        let corners = self.corners();
        let mut from = self.base + corners[corners.len() - 1];
        let mut inverse_from = inverse(from);
        for &to in corners {
            let to = self.base + to;
            let inverse_to = inverse(to);
            let scale = inverse_from * inverse_to;
            let across = from.cross(to) * scale;
            sum += across.dot(normal) * angle_over_sine(from.dot(to) * scale, across.length_squared());
            (from, inverse_from) = (to, inverse_to);
        }
        (sum * R::lit(0.5)).abs()
    }
}

/// Clips the outline of the first `N` corners, of which something is left in some lanes, in these lanes only. Returns whether it now has
/// another corner.
#[inline]
fn clip_corners<R: Real, const N: usize>(
    corners: &mut [Vec3<R>],
    some: &mut R::Mask,
    lanes: R::Mask,
    normal: Vec3<R>,
    least: R,
) -> Result<bool, TooMany> {
    let no = R::Mask::splat(false);
    let Some((corners, free)) = corners.split_first_chunk_mut::<N>() else { return Err(TooMany) };
    let height = corners.map(|corner| corner.dot(normal) - least);
    let mut inside = height.map(|height| height.ge(R::lit(0.0)) | !lanes);
    let any = inside.iter().fold(no, |any, &inside| any | inside);
    let all = inside.iter().fold(!no, |all, &inside| all & inside);
    *some = *some & any;
    if !(*some & !all).any() {
        return Ok(false);
    }
    let next = |i: usize| if i + 1 == N { 0 } else { i + 1 };
    let before = |i: usize| if i == 0 { N - 1 } else { i - 1 };
    let (mut once, mut twice) = (no, no);
    for i in 0..N {
        let leaves = inside[before(i)] & !inside[i];
        twice = twice | (once & leaves);
        once = once | leaves;
    }
    if twice.any() {
        only_the_lowest(&height, &mut inside, twice);
    }
    // where edge i crosses the plane, if it does, and the place at which the outline leaves the inside
    let crossing: [Vec3<R>; N] = core::array::from_fn(|i| {
        let fall = height[i] - height[next(i)];
        let share = height[i] / R::blend(inside[i] ^ inside[next(i)], fall, R::lit(1.0));
        (corners[next(i)] - corners[i]).mul_add(share, corners[i])
    });
    let (mut left, mut back) = (Vec3::default(), Vec3::default());
    for i in 0..N {
        left = Vec3::blend(inside[i] & !inside[next(i)], crossing[i], left);
        back = Vec3::blend(!inside[i] & inside[next(i)], crossing[i], back);
    }
    // Of the corners outside, those before the place where the outline leaves, and the one where it returns, become the point of return.
    // So a corner that other lanes make a lane repeat changes neither with which corner the list begins, nor the order of any sum.
    let (mut gone, mut moved, mut carried) = (no, no, Vec3::default());
    for i in 0..N {
        let outside = !inside[i];
        let (leaves, returns) = (outside & inside[before(i)], outside & inside[next(i)]);
        let splits = leaves & returns;
        gone = gone | leaves;
        let corner = Vec3::blend((returns | !gone) & !leaves, back, left);
        let corner = Vec3::blend(inside[i], corners[i], corner);
        corners[i] = Vec3::blend(moved, carried, corner);
        carried = Vec3::blend(splits, back, corner);
        moved = moved | splits;
    }
    let splits = (moved & *some).any();
    if splits {
        *free.first_mut().ok_or(TooMany)? = Vec3::blend(moved, carried, corners[N - 1]);
    }
    Ok(splits)
}

/// In these lanes, counts corners outside as inside unless they are next to the lowest one.
#[cold]
fn only_the_lowest<R: Real, const N: usize>(height: &[R; N], inside: &mut [R::Mask; N], lanes: R::Mask) {
    let no = R::Mask::splat(false);
    let next = |i: usize| if i + 1 == N { 0 } else { i + 1 };
    let before = |i: usize| if i == 0 { N - 1 } else { i - 1 };
    let lowest = height.iter().fold(R::lit(0.0), |lowest, &height| lowest.lesser(height));
    let (mut found, mut place) = (no, [no; N]);
    for i in 0..N {
        place[i] = height[i].le(lowest) & !inside[i] & !found;
        found = found | place[i];
    }
    // twice around, each way
    for i in (0..N).chain(0..N) {
        place[next(i)] = place[next(i)] | (place[i] & !inside[next(i)]);
    }
    for i in (0..N).chain(0..N).rev() {
        place[before(i)] = place[before(i)] | (place[i] & !inside[before(i)]);
    }
    for i in 0..N {
        inside[i] = inside[i] | (lanes & !place[i]);
    }
}
