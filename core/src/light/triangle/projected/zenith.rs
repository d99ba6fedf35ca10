//! A polygon that contains the zenith: for every edge the sector between it and the zenith, and along the horizon where that cuts.

use super::found::FoundSector;
use super::piece::{Piece, narrowest};
use super::sector::{Corner, Sector, border};
use crate::math::{ratio, rsqrt};
use crate::real::{Mask, Real};
use crate::vector::Vec3;

/// An edge of a polygon, from `a` to `b`.
pub(in crate::light) struct Side<R> {
    pub(in crate::light) a: Vec3<R>,
    pub(in crate::light) b: Vec3<R>,
    /// a × b
    pub(in crate::light) product: Vec3<R>,
    /// (a × b)·normal
    pub(in crate::light) area: R,
    /// heights of a and b over the horizon
    pub(in crate::light) heights: [R; 2],
}

#[inline(always)]
fn unit<R: Real>(v: Vec3<R>) -> Vec3<R> {
    let squared = v.length_squared();
    v * rsqrt(squared).keep(squared.gt(R::lit(1e-36)))
}

/// An edge seen from the zenith, and where it meets the horizon.
struct Slice<R: Real> {
    ends: [Vec3<R>; 2],
    heights: [R; 2],
    /// whether the ends are above the horizon
    up: [R::Mask; 2],
    /// whether the edge crosses the horizon
    cut: R::Mask,
    /// the point where it does
    meet: Vec3<R>,
    /// the shares of `product` before and after that point
    parts: [R; 2],
    /// unit vector and length of `product`
    pole: Vec3<R>,
    length: R,
    /// `product`·normal, and that over its length; positive
    area: R,
    cosine: R,
    /// 1 if the polygon runs counterclockwise about the normal, else −1
    turn: R,
}
impl<R: Real> Slice<R> {
    #[inline(never)]
    fn new(side: &Side<R>, normal: Vec3<R>, turn: R) -> Self {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let Side { a, b, product, heights, .. } = *side;
        let squared = product.length_squared();
        let inverse = rsqrt(squared).keep(squared.gt(R::lit(1e-36)));
        let (pole, length) = (product * inverse, squared * inverse);
        let area = (side.area * turn).greater(zero);
        let up = heights.map(|z| z.ge(zero));
        // where the edge meets the horizon: the sum of both ends, or where that cancels, the line common to both planes
        let [high, low] = heights.map(R::abs);
        let [before, after] = [high, low].map(|z| ratio(z, high + low));
        let sum = a.mul_add(after, b * before);
        let line = pole.cross(normal);
        let (line_squared, squares) = (line.length_squared(), [a.length_squared(), b.length_squared()]);
        let better = (line_squared * squares[0].greater(squares[1])).gt(sum.length_squared());
        let line = line * rsqrt(line_squared.greater(R::lit(1e-36))).negate_where(sum.dot(line).lt(zero));
        // as long as its cross product with the end at the greater angle demands
        let across = pole.cross(line);
        let (sine_a, sine_b) = (a.dot(across).abs(), b.dot(across).abs());
        let by_a = (sine_a * sine_a * squares[1]).gt(sine_b * sine_b * squares[0]);
        let size = length * R::blend(by_a, ratio(before, sine_a), ratio(after, sine_b));
        Self {
            ends: [a, b],
            heights,
            up,
            cut: up[0] ^ up[1],
            meet: Vec3::blend(better, line * size, sum),
            parts: [before, after],
            pole,
            length,
            area,
            cosine: (area * inverse).lesser(one),
            turn,
        }
    }
    /// The share of the edge that is above the horizon (`above`) or below.
    #[inline(always)]
    fn part(&self, above: bool) -> R {
        let [before, after] = if above { self.parts } else { [self.parts[1], self.parts[0]] };
        R::blend(self.cut, R::blend(self.up[0], before, after), R::lit(1.0))
    }
    /// The sector between the part above the horizon and the zenith, counted from its end if `backwards`.
    #[inline(never)]
    fn under_edge(&self, normal: Vec3<R>, backwards: bool) -> Sector<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let above = [0, 1].map(|i| Vec3::blend(self.cut & !self.up[i], self.meet, self.ends[i]));
        let (i, from, to) = if backwards { (1, above[1], above[0]) } else { (0, above[0], above[1]) };
        let pole = if backwards { -self.pole } else { self.pole };
        let apex = unit(from);
        let tangent = pole.cross(apex);
        let mut sector = Sector::new(Corner {
            apex,
            tangent,
            height: (self.heights[i] * rsqrt(from.length_squared().greater(R::lit(1e-36)))).keep(self.up[i]),
            slope: tangent.dot(normal),
            outer: self.cosine,
            inner: zero,
            fold: [one, zero],
            end: [self.length * self.part(true), from.dot(to)],
        });
        sector.area = sector.area.keep(self.up[0] | self.up[1]);
        sector
    }
    /// The sector between the horizon and the zenith, over the part below the horizon.
    #[inline(never)]
    fn under_horizon(&self, normal: Vec3<R>, backwards: bool) -> Sector<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let below = [0, 1].map(|i| Vec3::blend(self.up[i], self.meet, self.ends[i] - normal * self.heights[i]));
        let (from, to) = if backwards { (below[1], below[0]) } else { (below[0], below[1]) };
        let turn = if backwards { -self.turn } else { self.turn };
        let apex = unit(from);
        let mut sector = Sector::new(Corner {
            apex,
            tangent: normal.cross(apex) * turn,
            height: zero,
            slope: zero,
            outer: one,
            inner: zero,
            fold: [one, zero],
            end: [self.area * self.part(false), from.dot(to)],
        });
        sector.area = sector.area.keep(!(self.up[0] & self.up[1]));
        sector
    }
    /// Both sectors in the order of azimuth, each counted from its end if `backwards`.
    #[inline(always)]
    fn sectors(&self, normal: Vec3<R>, backwards: [bool; 2]) -> [Sector<R>; 2] {
        let [up, _] = self.up;
        let edge = self.under_edge(normal, backwards[0]);
        let first = R::where_any(!up, edge, || self.under_horizon(normal, backwards[0]));
        let second = R::where_any(self.cut, Sector::default(), || {
            let [edge, level] = [self.under_edge(normal, backwards[1]), self.under_horizon(normal, backwards[1])];
            Sector::blend(up, level, edge)
        });
        [first, second]
    }
}

/// Whether the zenith is inside the polygon: on the inner side of every edge.
#[inline(always)]
pub(in crate::light) fn surrounds<R: Real, const N: usize>(areas: &[R; N], turn: R) -> R::Mask {
    let mut inside = R::Mask::splat(true);
    for &area in areas {
        inside = inside & (area * turn).ge(R::lit(0.0));
    }
    inside
}

/// The sectors about the zenith for triangle `i` of a fan of N − 2: those of its outer edge, before them in the first triangle and after
/// them in the last those of the other outer edge.
#[inline(always)]
pub(in crate::light) fn sectors<R: Real, const N: usize>(
    sides: &[Side<R>; N],
    i: usize,
    normal: Vec3<R>,
    turn: R,
) -> [Piece<R>; 2] {
    let none = [Sector::default(); 2];
    // the second sector of a piece counts from its end
    let of = |side: &Side<R>, backwards: [bool; 2]| Slice::new(side, normal, turn).sectors(normal, backwards);
    let begin = if i == 0 { of(&sides[0], [false, true]) } else { none };
    let middle = of(&sides[i + 1], [false, false]);
    let end = if i + 3 == N { of(&sides[N - 1], [true, false]) } else { none };
    [Piece::about_zenith(begin[0], begin[1], middle[0]), Piece::about_zenith(middle[1], end[0], end[1])]
}

/// Drops the sectors with next to no area, so that only u = 0 falls into them.
#[inline(always)]
pub(in crate::light) fn drop_narrow<R: Real>(pieces: &mut [Piece<R>; 2], whole: R) {
    let least = narrowest::<R>() * whole;
    for piece in pieces {
        piece.drop_below(least);
    }
}

/// The sector about the zenith that contains the azimuth of a direction, as far as it has been searched for.
pub(in crate::light) struct Search<R> {
    pub(in crate::light) found: FoundSector<R>,
    /// area of all sectors so far
    sum: R,
    /// angle from the azimuth of the direction to the sector
    miss: R,
}
impl<R: Real> Default for Search<R> {
    #[inline(always)]
    fn default() -> Self {
        let none = FoundSector::new(Sector::default(), R::lit(0.0), R::Mask::splat(false));
        Self { found: none, sum: R::lit(0.0), miss: R::lit(8.0) }
    }
}
impl<R: Real> Search<R> {
    /// Looks in the sectors of a piece, but for those that are no larger than `edge`: into one of them, only rounding places a direction.
    #[inline(always)]
    pub(in crate::light) fn look(mut self, piece: &Piece<R>, normal: Vec3<R>, w: Vec3<R>, edge: R) -> Self {
        for (i, sector) in piece.sectors().into_iter().enumerate() {
            let some = sector.area.gt(edge);
            (self.found, self.miss) = R::where_any(some, (self.found, self.miss), || {
                let miss = sector.miss(normal, w);
                // a direction on the border belongs to the sector before
                let here = (miss + border()).lt(self.miss);
                let found = FoundSector::new(*sector, self.sum, R::Mask::splat(i == 1));
                (FoundSector::blend(here, found, self.found), R::blend(here, miss, self.miss))
            });
            self.sum += sector.area;
        }
        self
    }
}
