//! Flat lights that emit within an angle of their normal.

use super::disk::solid_angle::SphericalDisk;
use super::disk::{Disk, DiskBySolidAngle};
use super::parallelogram::area::PlacedParallelogram;
use super::parallelogram::solid_angle::SphericalParallelogram;
use super::parallelogram::{Parallelogram, ParallelogramBySolidAngle};
use super::rectangle::solid_angle::SphericalRectangle;
use super::rectangle::{Rectangle, RectangleBySolidAngle};
use super::sampler::BySolidAngle;
use crate::lanewise::lanewise;
use crate::math::{quotient, ratio};
use crate::real::Real;
use crate::vector::Vec3;

/// Rounding of the visible part, relative to the lengths that it comes from: it is enlarged by so much.
const SLACK: f64 = 32.0 / 16_777_216.0;

lanewise! {
    /// How a flat light emits within a cone about its normal, as through a honeycomb before it: the spread of Cycles.
    ///
    /// A host multiplies the radiance of the light by [`attenuation`](Self::attenuation). The power does not depend on the spread, so that
    /// a narrow cone is bright. A point sees only a disk of the plane of the light, which [`Parallelogram::visible_part`],
    /// [`Rectangle::by_spread`], [`Parallelogram::by_spread`] and [`Disk::by_spread`] sample.
    ///
    /// - Formula: (tan σ − tan θ)/(tan σ − σ) for θ < σ, with the angle θ to the normal and σ half of the spread; 0 beyond.
    /// - Domain: full angles from 1e−3 to below π, in radians. As the spread nears π the factor nears 1.
    /// - Density: none; ∫ attenuation · cosθ dω = π, as without a spread.
    /// - Greatest error: 4e−7 of the factor on the axis, tan σ/(tan σ − σ).
    /// - Source: Cycles, `intern/cycles/kernel/light/area.h`, derived anew.
    ///
    /// ```
    /// use etendue::{LightSampler, Rectangle, Vec2, light::Spread};
    /// let panel = Rectangle::<f32>::new([-9.0, 1.0, -9.0].into(), [18.0, 0.0, 0.0].into(), [0.0, 0.0, 18.0].into());
    /// let spread = Spread::new(90_f64.to_radians());
    /// let p = [0.0; 3].into();
    /// // of 18 × 18, the point sees 2 × 2
    /// let s = panel.by_spread(p, &spread).sample(Vec2::new(0.999, 0.5));
    /// assert!((s.direction.x / s.direction.y - 1.0).abs() < 0.01 && (s.uv.x - 10.0 / 18.0).abs() < 0.001);
    /// assert!(spread.attenuation(s.direction, s.normal) < 0.05);
    /// ```
    pub struct Spread {
        /// tan σ.
        pub tan_half: R,
        /// 1/(tan σ − σ).
        pub gain: R,
    }
}

impl<R: Real> Spread<R> {
    /// A spread with this full angle in radians.
    #[must_use]
    pub fn new(angle: f64) -> Self {
        let half = 0.5 * angle.clamped(1e-3, core::f64::consts::PI);
        let (sin, cos) = (half / core::f64::consts::TAU).sin_cos_turns();
        let tangent = sin / cos.greater(1e-6);
        // where the difference cancels, its series
        let square = half * half;
        let series =
            (square * (2.0 / 5.0 + square * (17.0 / 105.0 + square * (62.0 / 945.0))) + 1.0) * half * square / 3.0;
        let excess = if half < 0.05 { series } else { tangent - half };
        Self { tan_half: R::lit(tangent), gain: R::lit(1.0 / excess) }
    }
    /// The factor of the radiance in or against the unit direction `w` of a light with the unit normal `n`, on either side.
    #[inline(always)]
    pub fn attenuation(&self, w: Vec3<R>, n: Vec3<R>) -> R {
        let (zero, cos) = (R::lit(0.0), w.dot(n).abs());
        let some = cos.gt(zero);
        let tangent = w.cross(n).length() / R::blend(some, cos, R::lit(1.0));
        ((self.tan_half - tangent) * self.gain).greater(zero).keep(some)
    }
}

/// The part of corner + s·edge_s + t·edge_t, relative to the point, that has what the point sees of the plane: ranges of s and t. They are
/// empty where it sees nothing. Coordinates are rounded numbers of up to `reach`.
#[inline(always)]
fn ranges<R: Real>(light: &Parallelogram<R>, reach: R, tan_half: R) -> [[R; 2]; 2] {
    let (zero, one) = (R::lit(0.0), R::lit(1.0));
    let Parallelogram { corner, edge_s, edge_t } = *light;
    let unit = corner.max_abs().greater(edge_s.max_abs()).greater(edge_t.max_abs()).greater(reach).pow2_scale();
    let [corner, edge_s, edge_t] = [corner, edge_s, edge_t].map(|v| v * unit);
    let (long_s, long_t) = (edge_s.length(), edge_t.length());
    let cross = edge_s.cross(edge_t);
    let area = cross.length();
    let normal = cross * ratio(one, area);
    let height = corner.dot(normal);
    // the normal of edges that are nearly parallel is known less well
    let slack = (corner.length() + long_s + long_t + reach * unit) * ratio(long_s * long_t, area) * R::lit(SLACK);
    let radius = (height.abs() + slack).mul_add(tan_half, slack);
    let foot = normal * height - corner;
    let range = |along: Vec3<R>, other: Vec3<R>, length: R| {
        let upright = other.cross(normal);
        let across = along.dot(upright);
        let middle = quotient(foot.dot(upright), across);
        let half = ratio(radius * length, across.abs());
        [middle - half, middle + half].map(|x| x.clamped(zero, one))
    };
    [range(edge_s, edge_t, long_t), range(edge_t, edge_s, long_s)]
}

/// The part of a parallelogram, relative to the point, that has what the point sees.
#[inline(always)]
fn part<R: Real>(light: &Parallelogram<R>, reach: R, tan_half: R) -> Parallelogram<R> {
    let [s, t] = ranges(light, reach, tan_half);
    let Parallelogram { corner, edge_s, edge_t } = *light;
    Parallelogram {
        corner: edge_s.mul_add(s[0], edge_t.mul_add(t[0], corner)),
        edge_s: edge_s * (s[1] - s[0]),
        edge_t: edge_t * (t[1] - t[0]),
    }
}

impl<R: Real> Parallelogram<R> {
    #[inline(always)]
    fn relative(&self, p: Vec3<R>) -> (Self, R) {
        (Self { corner: self.corner - p, ..*self }, self.corner.max_abs() + p.max_abs())
    }
    /// The part of the light that the point `p` sees, if it has this spread: the smallest parallelogram with edges along its own about what
    /// of its plane is within the angle. It is without area where the point sees nothing, and the light itself where it sees all.
    #[inline(always)]
    #[must_use]
    pub fn visible_part(&self, p: Vec3<R>, spread: &Spread<R>) -> Self {
        let (relative, reach) = self.relative(p);
        let part = part(&relative, reach, spread.tan_half);
        let whole = part.edge_s.max_abs().ge(self.edge_s.max_abs()) & part.edge_t.max_abs().ge(self.edge_t.max_abs());
        Self::blend(whole, *self, Self { corner: part.corner + p, ..part })
    }
    /// Uniform over the solid angle of the [visible part](Self::visible_part) at the point `p` of a light with this spread. Surface
    /// coordinates are those of the whole light.
    #[inline(always)]
    pub fn by_spread(&self, p: Vec3<R>, spread: &Spread<R>) -> ParallelogramBySolidAngle<R> {
        let (relative, reach) = self.relative(p);
        let surface = PlacedParallelogram::new(relative.corner, relative.edge_s, relative.edge_t).of_part();
        let part = part(&relative, reach, spread.tan_half);
        let shape = SphericalParallelogram::new(part.corner, part.edge_s, part.edge_t);
        BySolidAngle { surface, shape }
    }
}

impl<R: Real> Rectangle<R> {
    /// Uniform over the solid angle of what the point `p` sees of a light with this spread: [`Parallelogram::visible_part`]. Surface
    /// coordinates are those of the whole light.
    #[inline(always)]
    pub fn by_spread(&self, p: Vec3<R>, spread: &Spread<R>) -> RectangleBySolidAngle<R> {
        let (relative, reach) = Parallelogram::from(*self).relative(p);
        let surface = PlacedParallelogram::new(relative.corner, relative.edge_s, relative.edge_t).of_part();
        let part = part(&relative, reach, spread.tan_half);
        let shape = SphericalRectangle::new(part.corner, part.edge_s, part.edge_t);
        BySolidAngle { surface, shape }
    }
}

impl<R: Real> Disk<R> {
    /// Uniform over the solid angle of what the point `p` sees of a light with this spread, if that is a disk within the light; else, of the
    /// whole light. Surface coordinates are those of the whole light.
    #[inline(always)]
    pub fn by_spread(&self, p: Vec3<R>, spread: &Spread<R>) -> DiskBySolidAngle<R> {
        let sampler = self.by_solid_angle(p);
        let center = self.center - p;
        let height = center.dot(self.normal);
        let foot = self.normal * height;
        let slack = (center.length() + self.center.max_abs() + p.max_abs()) * R::lit(SLACK);
        let radius = (height.abs() + slack).mul_add(spread.tan_half, slack);
        let within = ((center - foot).length() + radius).le(self.radius);
        let (center, radius) = (Vec3::blend(within, foot, center), R::blend(within, radius, self.radius));
        BySolidAngle { shape: SphericalDisk::new(center, self.normal, radius), ..sampler }
    }
}
