//! A triangle wholly above the horizon and not about the zenith: two sectors.
#![expect(unreachable_pub, reason = "the structs of lanewise! are declared pub")]

use super::found::{FoundSector, after};
use super::sector::{Corner, Sector};
use crate::lanewise::lanewise;
use crate::math::{ratio, rsqrt};
use crate::real::{Mask, Real, blended};
use crate::vector::Vec3;

/// Share of the area below which a sector is dropped: a small part of a step of 2⁻²⁴ in `u`, or of the precision.
const NARROWEST: f64 = 1.0 / 4_294_967_296.0;
const NARROWEST_F64: f64 = 1e-16;

#[inline(always)]
pub(in crate::light) fn narrowest<R: Real>() -> R {
    R::lit(if R::DOUBLE { NARROWEST_F64 } else { NARROWEST })
}

lanewise! {
    /// A triangle swept by azimuth: from the first vertex to the middle one, and from there to the last. Or three sectors about the zenith.
    pub struct Piece {
        /// from the first vertex to the middle one
        first: Sector<R>,
        /// from the middle vertex to the last, given from the last
        second: Sector<R>,
        /// about the zenith, a further one after these; otherwise empty
        third: Sector<R>,
        /// horizontal normal of the azimuth plane of the middle vertex: positive beyond it
        middle: Vec3<R>,
        /// 1 if the sectors run counterclockwise, else −1
        turn: R,
        /// sum of the sectors
        pub(in crate::light) area: R,
    }
}

/// A triangle, with the quantities that give its sectors.
#[derive(Clone, Copy, Default)]
pub(in crate::light) struct Corners<R> {
    /// relative to the point
    pub(super) vertices: [Vec3<R>; 3],
    /// unit normals of the planes through the viewpoint and each vertex and the next
    pub(super) poles: [Vec3<R>; 3],
    /// lengths of the cross products of each vertex and the next
    pub(super) lengths: [R; 3],
    /// inner products of those cross products with the normal
    pub(super) areas: [R; 3],
    /// heights of the vertices over the horizon
    pub(super) heights: [R; 3],
    /// det(v₀, v₁, v₂)
    pub(super) volume: R,
}
blended!(Corners { vertices, poles, lengths, areas, heights, volume });

impl<R: Real> Piece<R> {
    /// Prepares two sectors in place; the third must be empty.
    #[inline(never)]
    pub(in crate::light) fn sweep(&mut self, corners: &Corners<R>, normal: Vec3<R>) {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let Corners { vertices: v, poles: pole, lengths: length, areas, heights: z, volume } = *corners;
        let squared = v.map(Vec3::length_squared);
        let shrink = squared.map(|s| rsqrt(s).keep(s.gt(R::lit(1e-36))));
        let next = [1, 2, 0];
        let m_inverse = length.map(|l| ratio(one, l).lesser(R::lit(1e37)));
        let cosine: [R; 3] = core::array::from_fn(|i| (areas[i] * m_inverse[i]).clamped(-one, one));
        let reversed = volume.lt(zero);
        let cosine = cosine.map(|c| c.negate_where(reversed));
        // an edge is inner if its plane lies over the triangle: one is, or two are, since a triangle that contains the zenith has sectors of
        // its own
        let inner = cosine.map(|c| c.lt(zero));
        let two = (inner[0] & inner[1]) | (inner[1] & inner[2]) | (inner[2] & inner[0]);
        let (long0, long1) = (inner[0] ^ two, inner[1] ^ two);
        let cosine = cosine.map(R::abs);
        let pick = |x: [R; 3], i: usize| R::blend(long0, x[next[i]], R::blend(long1, x[next[next[i]]], x[i]));
        let turned =
            |x: [Vec3<R>; 3], i: usize| Vec3::blend(long0, x[next[i]], Vec3::blend(long1, x[next[next[i]]], x[i]));
        let dot: [R; 3] = core::array::from_fn(|i| v[i].dot(v[next[i]]));
        let unit: [Vec3<R>; 3] = core::array::from_fn(|i| v[i] * shrink[i]);
        let height: [R; 3] = core::array::from_fn(|i| z[i] * shrink[i]);
        let sizes: [R; 3] = core::array::from_fn(|i| squared[i] * shrink[i]);
        let poles: [Vec3<R>; 3] = core::array::from_fn(|i| turned(pole, i));
        let cosines: [R; 3] = core::array::from_fn(|i| pick(cosine, i));
        let lengths: [R; 3] = core::array::from_fn(|i| pick(length, i));
        let inverses: [R; 3] = core::array::from_fn(|i| pick(m_inverse, i));
        let dots: [R; 3] = core::array::from_fn(|i| pick(dot, i));
        let (a, c) = (turned(unit, 0), turned(unit, 2));
        let (size_a, size_c) = (pick(sizes, 0), pick(sizes, 2));
        let (height_a, height_c) = (pick(height, 0), pick(height, 2));
        // twice the projected areas on either side of the middle vertex
        let (before, after) = (cosines[0] * lengths[0], cosines[1] * lengths[1]);
        let volume_abs = volume.abs();
        let some = volume_abs.gt(zero);

        let sector = |own: usize, away: R::Mask, apex: Vec3<R>, size: R, height: R, mine: R, other: R| {
            // away: this sector's own edge runs towards the apex; the long edge runs from the last vertex to the first
            let over = Vec3::blend(two, poles[2], poles[own]);
            let over = Vec3::blend(away ^ two, -over, over);
            let tangent = over.cross(apex);
            let far = [mine * lengths[2], (mine * dots[2]).mul_add(one, other * size * size)];
            // sinδ: as small as the triangle, or from the cosine where that is small
            let cos = -poles[own].dot(poles[2]);
            let thin = (volume_abs * size * inverses[own] * inverses[2]).lesser(one);
            let fold = R::blend(cos.abs().lt(R::lit(0.5)), ((one - cos) * (one + cos)).greater(zero).sqrt(), thin);
            let corner = Corner {
                apex,
                tangent,
                height,
                slope: tangent.dot(normal),
                outer: R::blend(two, cosines[2], cosines[own]),
                inner: R::blend(two, cosines[own], cosines[2]),
                fold: [fold, cos],
                end: [R::blend(two, far[0], lengths[own]), R::blend(two, far[1], dots[own])],
            };
            let mut sector = Sector::new(corner);
            sector.area = sector.area.keep(some);
            sector
        };
        let (no, yes) = (R::Mask::splat(false), R::Mask::splat(true));
        self.first = sector(0, no, a, size_a, height_a, before, after);
        self.second = sector(1, yes, c, size_c, height_c, after, before);
        // beside an upright edge a sector has no width, and a direction in it would be pure rounding: only u = 0 falls into it
        let least = narrowest::<R>() * (self.first.area + self.second.area);
        for sector in [&mut self.first, &mut self.second] {
            sector.area = sector.area.keep(sector.area.gt(least));
        }
        // with the long edge outside, the sectors run the other way round
        let turn = one.negate_where(reversed ^ two);
        // of an inner vertex, which may be at the zenith, the azimuth is that of the point of the long edge where the sectors end
        let end = turned(v, 0).mul_add(after, turned(v, 2) * before);
        self.middle = normal.cross(Vec3::blend(two, end, turned(unit, 1))) * turn;
        self.turn = turn;
        self.area = self.first.area + self.second.area;
    }

    /// Three sectors about the zenith; the second counts from its far end.
    #[inline(always)]
    pub(in crate::light) fn about_zenith(first: Sector<R>, second: Sector<R>, third: Sector<R>) -> Self {
        let area = first.area + second.area + third.area;
        Self { first, second, third, area, ..Self::default() }
    }
    #[inline(always)]
    pub(in crate::light) fn sectors(&self) -> [&Sector<R>; 3] {
        [&self.first, &self.second, &self.third]
    }
    /// Drops the sectors whose area is not greater than this.
    #[inline(always)]
    pub(in crate::light) fn drop_below(&mut self, least: R) {
        for sector in [&mut self.first, &mut self.second, &mut self.third] {
            sector.area = sector.area.keep(sector.area.gt(least));
        }
        self.area = self.first.area + self.second.area + self.third.area;
    }

    /// The sector that has the area `swept` before it and `left` after it, and the share of the sector before the azimuth,
    /// counted from its apex: each from the nearer end, where the azimuth is a root of the area.
    #[inline(always)]
    pub(in crate::light) fn choose(&self, swept: R, left: R) -> (Sector<R>, R) {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let later = swept.ge(self.first.area) & self.second.area.gt(zero);
        let two = (Sector::blend(later, self.second, self.first), R::blend(later, left - self.third.area, swept));
        let before = self.first.area + self.second.area;
        let last = swept.ge(before) & self.third.area.gt(zero);
        let (sector, part) = R::where_any(last, two, || (self.third, swept - before));
        let share = ratio(part, sector.area).clamped(zero, one);
        (sector, share)
    }

    /// The sector in which a direction is.
    #[inline(always)]
    pub(in crate::light) fn find(&self, normal: Vec3<R>, w: Vec3<R>, edge: R) -> FoundSector<R> {
        let zero = R::lit(0.0);
        let side = self.middle.dot(w);
        // opposite the middle vertex, which rounding may place on either side, there is only the wider sector
        let ahead = self.middle.cross(normal) * self.turn;
        let opposite = ahead.dot(w).lt(-side.abs());
        let beyond = (opposite & ahead.dot(self.first.apex).ge(zero)) | (!opposite & side.ge(zero));
        let later = after([self.first.area, self.second.area], beyond, edge);
        FoundSector::new(Sector::blend(later, self.second, self.first), self.first.area.keep(later), later)
    }
    /// Whether u₁ in any of the sectors depends on how u₀ is rounded: see [`Sector::at_share`].
    #[inline(always)]
    pub(in crate::light) fn is_narrow(&self, whole: R) -> R::Mask {
        self.first.is_narrow(whole) | self.second.is_narrow(whole) | self.third.is_narrow(whole)
    }
}
