//! The sector in which a direction is.
#![expect(unreachable_pub, reason = "the structs of lanewise! are declared pub")]

use super::sector::Sector;
use crate::lanewise::lanewise;
use crate::real::Real;
use crate::vector::{Vec2, Vec3};

lanewise! {
    /// The sector in which a direction is, and the areas that its u₀ is between.
    pub struct FoundSector {
        sector: Sector<R>,
        /// area before the sector
        before: R,
        /// 1 if the sector counts from its far end, else 0
        backwards: R,
        /// bounds of the area before the direction, which keep it away from jumps of the map
        low: R,
        high: R,
    }
}

impl<R: Real> FoundSector<R> {
    /// A sector that begins after an area.
    #[inline(always)]
    pub(in crate::light) fn new(sector: Sector<R>, before: R, backwards: R::Mask) -> Self {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        Self { sector, before, backwards: one.keep(backwards), low: zero, high: R::lit(8.0) }
    }
    /// What is found in a light to which a further part is added after the area `sum`, in which the direction is `other`. Areas are kept
    /// `edge` away from the border between them.
    #[inline(always)]
    pub(in crate::light) fn or(self, other: Self, later: R::Mask, [sum, part, edge]: [R; 3]) -> Self {
        let before = self.high.lesser(sum - edge);
        let own = Self { high: R::blend(part.gt(R::lit(0.0)), before, self.high), ..self };
        let low = sum + other.low.greater(edge);
        let other = Self { before: sum + other.before, low, high: sum + other.high, ..other };
        Self::blend(later, other, own)
    }
    /// The area before the direction, and u₁.
    #[inline(always)]
    pub(in crate::light) fn place(&self, normal: Vec3<R>, w: Vec3<R>) -> Vec2<R> {
        let place = self.sector.locate(normal, w);
        let share = R::blend(self.backwards.gt(R::lit(0.0)), R::lit(1.0) - place.x, place.x);
        let area = share.mul_add(self.sector.area, self.before);
        Vec2 { x: area.lesser(self.high).greater(self.low), y: place.y }
    }
}

/// Whether a direction counts to the second of two areas, on the far side of the border between them (`beyond`): into one that is no larger
/// than `edge`, only rounding places a direction.
#[inline(always)]
pub(in crate::light) fn after<R: Real>([before, area]: [R; 2], beyond: R::Mask, edge: R) -> R::Mask {
    (beyond | before.le(edge)) & area.gt(before.lesser(edge))
}

/// Two steps of u₀, in units of area: between two parts the map may jump, and u₀Ω⊥ is known only to this accuracy.
#[inline(always)]
pub(in crate::light) fn edge<R: Real>(whole: R) -> R {
    let step = R::lit(1.0) - R::ONE_MINUS_EPSILON;
    whole * (step + step)
}
