use super::{Warp, unit_interval};
use crate::real::Real;
use crate::vector::Vec2;

/// Uniform over a triangle, as the barycentric coordinates (b₁, b₂) of its second and third vertex.
///
/// - Formula: b₀ = 1 − √u₀, b₁ = √u₀(1−u₁), b₂ = √u₀u₁.
/// - Domain: u in [0, 1)²; u₀ = 0 maps to the first vertex, whose inverse is (0, 0).
/// - Density: 2 per unit of barycentric area; divide by twice the triangle's area for 1/area.
/// - Greatest error: 1.2e−7.
/// - Source: Turk, "Generating Random Points in Triangles", Graphics Gems, 1990.
#[derive(Clone, Copy, Debug, Default)]
pub struct AreaTriangle;

impl<R: Real> Warp<R> for AreaTriangle {
    type Point = Vec2<R>;
    #[inline]
    fn sample(&self, u: Vec2<R>) -> Vec2<R> {
        let root = u.x.max(R::lit(0.0)).sqrt();
        let b2 = root * u.y;
        Vec2::new(root - b2, b2)
    }
    #[inline]
    fn pdf(&self, b: Vec2<R>) -> R {
        let zero = R::lit(0.0);
        let inside = b.x.ge(zero) & b.y.ge(zero) & (b.x + b.y).le(R::lit(1.0));
        R::lit(2.0).keep(inside)
    }
    #[inline]
    fn invert(&self, b: Vec2<R>) -> Vec2<R> {
        let root = b.x + b.y;
        let some = root.gt(R::lit(0.0));
        Vec2 { x: unit_interval(root * root), y: unit_interval(b.y / R::select(some, root, R::lit(1.0))) }
    }
}
