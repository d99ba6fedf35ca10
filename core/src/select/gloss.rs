//! What surfaces reflect, for the choice of lights.

use crate::lanewise::{lanewise, only};
use crate::real::Real;
use crate::reflection::Reflection;
use crate::vector::Vec3;

/// The least factor, relative to the albedos, so that no light that contributes vanishes.
const LEAST: f64 = 1.0 / (1_u64 << 40) as f64;
/// The greatest ratio of squared lengths, so that no factor overflows.
const GREATEST: f64 = 1e9;

lanewise! {
    /// What glossy surfaces reflect towards the viewer, as far as the choice of lights depends on it: a diffuse part, and a rough one that
    /// reflects more from some directions than from others.
    ///
    /// [`LightTree::at_glossy`](super::LightTree::at_glossy) and [`SpatialLights::at_glossy`](super::SpatialLights::at_glossy) take it.
    ///
    /// - Formula: the weight of a light, which is by the cosine, is multiplied by ρ + σ · ac · (N/N′)², with N = |v|² + δ and N′ = |v′|² + δ′.
    ///   ρ and σ are the albedos of both parts; the map of the [`Reflection`] takes v, the vector to the lights' mean position, to v′, and has
    ///   the determinant ac; δ is the variance of their positions, except along v, and δ′ the same after the map. Without a variance,
    ///   ac(N/N′)² is the pdf of the reflection over cosθ/π. With one, the lobe is wider.
    /// - Domain: albedos from 0 to 1, not both 0.
    /// - Bounds: the factor is at least 2⁻⁴⁰ of the sum of the albedos, so that no light is lost.
    /// - Accuracy: a factor is a weight, and the pmf of the choice stays exact. Without a variance it is that of the fit, whose error
    ///   [`Reflection`] has.
    /// - Source: the map after Heitz, Dupuy, Hill and Neubelt 2016, as in [`Reflection`]; the widening by the variance is derived here.
    /// - Degenerate: without a rough part, the factor is ρ, and the choice has the bits of the one without gloss if ρ is 1.
    pub struct Gloss {
        /// The rows of the map.
        x: Vec3<R>,
        y: Vec3<R>,
        z: Vec3<R>,
        /// The squared lengths of its columns.
        columns: Vec3<R>,
        diffuse: R,
        /// The albedo of the rough part, times the determinant ac of the map.
        rough: R,
        least: R,
    }
}

impl<R: Real> Gloss<R> {
    /// Prepares for surfaces with this albedo of their diffuse part, and a rough part with this reflection and albedo.
    #[inline(always)]
    pub fn new(diffuse: R, rough: R, reflection: &Reflection<R>) -> Self {
        let [x, y, z] = reflection.rows();
        let column = |x: R, y: R, z: R| x.mul_add(x, y.mul_add(y, z * z));
        Self {
            x,
            y,
            z,
            columns: Vec3::new(column(x.x, y.x, z.x), column(x.y, y.y, z.y), column(x.z, y.z, z.z)),
            diffuse,
            rough: rough * reflection.determinant(),
            least: (diffuse + rough) * R::lit(LEAST),
        }
    }
    /// The sum of both albedos: the factor for light from all around.
    #[must_use]
    #[inline]
    pub fn albedo(&self) -> R {
        self.least * R::lit(1.0 / LEAST)
    }
    /// The factor for lights whose mean position is at `v` from the surface, with these variances along the axes.
    #[inline(always)]
    pub(super) fn factor(&self, v: Vec3<R>, variances: Vec3<R>) -> R {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let Self { x, y, z, columns, .. } = *self;
        let squares = |v: Vec3<R>| Vec3::new(v.x * v.x, v.y * v.y, v.z * v.z);
        let one_unless_zero = |x: R| R::blend(x.gt(zero), x, one);
        let [a, b, c] = [x.dot(v), y.dot(v), z.dot(v)];
        let (length, mapped) = (v.length_squared(), a.mul_add(a, b.mul_add(b, c * c)));
        // the variances without those along the vectors, which change no direction
        let back = x * a + y * b + z * c;
        let along = variances.dot(squares(v)) / one_unless_zero(length);
        let mapped_along = variances.dot(squares(back)) / one_unless_zero(mapped);
        let variance = (variances.x + variances.y + variances.z - along).greater(zero);
        let spread = (columns.dot(variances) - mapped_along).greater(zero);
        let (size, below) = (length + variance, mapped + spread);
        let some = below.gt(zero) & size.gt(zero);
        let ratio = (size / R::blend(some, below, one)).lesser(R::lit(GREATEST));
        let lobe = (ratio * ratio).keep(some);
        self.rough.mul_add(lobe, self.diffuse).greater(self.least)
    }
}

only!(Gloss { x: Vec3, y: Vec3, z: Vec3, columns: Vec3, diffuse: R, rough: R, least: R });
