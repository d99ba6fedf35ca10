//! Visible normals of a GGX microsurface.

use super::{Cone, Warp};
use crate::lanewise::lanewise;
use crate::real::{GREATEST, Real, unit_interval};
use crate::vector::{Vec2, Vec3};

lanewise! {
    /// Normals of a GGX microsurface that are visible from a direction, by the spherical cap: for rough reflection.
    ///
    /// Call `GgxVisibleNormals::new(alpha_x, alpha_y, wi)`, then `sample` a normal and [`reflect`](Self::reflect) about it. A
    /// mirror (α ≤ 1e−15), or a direction that sees nothing, has pdf 0.
    ///
    /// ```
    /// use etendue::{Vec2, Vec3, Warp, warp::GgxVisibleNormals};
    /// let rough = GgxVisibleNormals::new(0.5_f32, 0.25, Vec3::new(0.6, 0.0, 0.8));
    /// let u = Vec2::new(0.3, 0.7);
    /// let m = rough.sample(u);
    /// let back = rough.invert(m);
    /// assert!(rough.pdf(m) > 0.0 && (back.x - u.x).abs() < 1e-5 && (back.y - u.y).abs() < 1e-5);
    /// ```
    ///
    /// - Formula: with M = diag(αx, αy, 1) and the stretched view w = M·wi/|M·wi|, a direction c uniform over the cap z > −w.z
    ///   ([`Cone`] with h = 1 + w.z) reflects w about c + w; the normal is M(c + w), normalised.
    /// - Domain: u in [0, 1)²; αx, αy > 0; any nonzero wi, of any length. Grazing views have no special case; a view from below
    ///   the horizon (wi.z < 0) sees the part of the microsurface that still faces it.
    /// - Density: the pdf is D_v(m) = 2 max(0, wi·m) / (π αx αy l⁴ (|M·wi| + wi.z)) per steradian of the normal, l = |M⁻¹m|,
    ///   for unit wi; 0 for m.z < 0 and for normals that face away. It equals max(0, wi·m) D(m) G₁(wi)/wi.z without the
    ///   quotient that fails at grazing.
    /// - Reflection: the reflected direction is 2(wi·m)m − wi; its pdf per steradian is [`reflected_pdf`](Self::reflected_pdf),
    ///   D_v/(4 wi·m).
    /// - Degenerate input: α ≤ 1e−15 (a mirror), wi = 0 and wi = −z (nothing visible) give pdf 0, and +z or a normal on the
    ///   horizon.
    /// - Greatest error, in units of 2⁻²⁴: 8 in the stretched normal, 8 in the pdf relative to its value and to D_v/(wi·m), and
    ///   24/(1 + w.z) + 16/|c + w| in `invert(sample(u))`. The last is largest where a grazing view sees normals that turn away
    ///   from it, c → −w, which have almost no probability; rounding may make such a normal face away, with pdf 0.
    /// - Source: Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps", HPG 2023, listing 1; for the pdf,
    ///   Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4), 2018, equation 3, rearranged.
    pub struct GgxVisibleNormals {
        alpha: Vec2<R>,
        inverse_alpha: Vec2<R>,
        /// wi, normalised.
        view: Vec3<R>,
        /// w = M·wi/|M·wi|.
        stretched: Vec3<R>,
        /// h = 1 + w.z, the height of the cap.
        height: R,
        /// 2/(π αx αy |M·wi| h), or 0 where degenerate.
        scale: R,
    }
}

impl<R: Real> GgxVisibleNormals<R> {
    /// Prepares for roughness αx, αy and the direction `wi` towards the viewer, in the local frame of the surface (z up).
    #[inline(always)]
    pub fn new(alpha_x: R, alpha_y: R, wi: Vec3<R>) -> Self {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        // first to a length near 1, exactly, so that no square over- or underflows
        let view = (wi * wi.max_abs().pow2_scale()).normalize();
        let least = R::lit(1e-15);
        let rough = alpha_x.gt(least) & alpha_y.gt(least) & alpha_x.lt(R::lit(1e15)) & alpha_y.lt(R::lit(1e15));
        let alpha = Vec2::new(R::blend(rough, alpha_x, one), R::blend(rough, alpha_y, one));
        let inverse_alpha = Vec2::new(one / alpha.x, one / alpha.y);
        let (x, y) = (alpha.x * view.x, alpha.y * view.y);
        let across = x.mul_add(x, y * y);
        let length = view.z.mul_add(view.z, across).sqrt();
        let some = length.gt(zero);
        let inverse_length = one / R::blend(some, length, one);
        let stretched = Vec3::new(x, y, view.z) * inverse_length;
        // |M·wi| + wi.z cancels from below: there, the difference of squares over the sum of magnitudes
        let sum = R::blend(view.z.lt(zero), across / (length + view.z.abs()).greater(R::lit(1e-37)), length + view.z);
        let visible = some & rough & sum.gt(R::lit(1e-33));
        let area = R::lit(core::f64::consts::PI) * alpha.x * alpha.y;
        let scale = (R::lit(2.0) / (area * R::blend(visible, sum, one))).keep(visible);
        Self {
            alpha,
            inverse_alpha,
            view,
            stretched,
            height: sum * inverse_length,
            scale: scale.lesser(R::lit(GREATEST)),
        }
    }
    /// Reflects the view about the normal `m`: 2(wi·m)m − wi.
    #[inline(always)]
    pub fn reflect(&self, m: Vec3<R>) -> Vec3<R> {
        let cos = self.view.dot(m);
        m.mul_add(cos + cos, -self.view)
    }
    /// The pdf of the direction reflected about `m`, per steradian of that direction: D_v(m)/(4 wi·m). It stays finite as wi·m
    /// → 0.
    #[inline(always)]
    pub fn reflected_pdf(&self, m: Vec3<R>) -> R {
        let facing = self.view.dot(m).gt(R::lit(0.0));
        (self.per_cosine(m) * R::lit(0.25)).keep(facing)
    }
    /// D_v(m)/(wi·m).
    #[inline(always)]
    fn per_cosine(&self, m: Vec3<R>) -> R {
        let (x, y) = (m.x * self.inverse_alpha.x, m.y * self.inverse_alpha.y);
        let square = x.mul_add(x, y.mul_add(y, m.z * m.z));
        let some = m.z.ge(R::lit(0.0)) & square.gt(R::lit(0.0));
        let inverse = R::lit(1.0) / R::blend(some, square, R::lit(1.0));
        (self.scale * inverse * inverse).lesser(R::lit(GREATEST)).keep(some)
    }
}

impl<R: Real> Warp<R> for GgxVisibleNormals<R> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        let c = Cone { one_minus_cos: self.height }.sample(u);
        let (x, y) = ((c.x + self.stretched.x) * self.alpha.x, (c.y + self.stretched.y) * self.alpha.y);
        // z = (1 − u₀h) + (h − 1)
        let z = (self.height * (R::lit(1.0) - u.x)).greater(R::lit(0.0));
        let m = Vec3::new(x, y, z);
        let m = (m * m.max_abs().pow2_scale()).normalize();
        let up = Vec3::new(R::lit(0.0), R::lit(0.0), R::lit(1.0));
        Vec3::blend(m.length_squared().gt(R::lit(0.5)), m, up)
    }
    /// The pdf per steradian of the normal.
    #[inline(always)]
    fn pdf(&self, m: Vec3<R>) -> R {
        (self.per_cosine(m) * self.view.dot(m).greater(R::lit(0.0))).lesser(R::lit(GREATEST))
    }
    #[inline(always)]
    fn invert(&self, m: Vec3<R>) -> Vec2<R> {
        let h = Vec3::new(m.x * self.inverse_alpha.x, m.y * self.inverse_alpha.y, m.z);
        let h = (h * h.max_abs().pow2_scale()).normalize();
        let cos = self.stretched.dot(h);
        let c = h.mul_add(cos + cos, -self.stretched);
        let near = Cone { one_minus_cos: self.height }.invert(c);
        // u₀ near 1 comes from the rim of the cap: c.z + w.z = 2(w·h)h.z = (1−u₀)h
        let some = self.height.gt(R::lit(0.0));
        let rest = (cos + cos) * h.z / R::blend(some, self.height, R::lit(1.0));
        let far = unit_interval(R::lit(1.0) - rest.lesser(R::lit(1.0)));
        Vec2 { x: R::blend(near.x.lt(R::lit(0.5)), near.x, far), y: near.y }
    }
}
