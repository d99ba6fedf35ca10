//! How exactly a light determines what its sampler returns.

use super::{AreaLight, LightShape, Measure};
use crate::packets::Coordinates;
use crate::tolerances::ULP;
use etendue::LightSample;
use etendue::real::SAME_BITS;
use etendue_oracle::{V3, along, cross, dot, length, sub, wide};

impl AreaLight {
    /// True for a patch that folds back on itself, or nearly: seen along its middle normal, no convex quadrilateral.
    fn folded(&self) -> bool {
        let (u, v, w) = (wide(self.b), wide(self.c), wide(self.n));
        let twist = sub(sub(w, u), v);
        let normal = |s: f64, t: f64| cross(along(u, twist, t), along(v, twist, s));
        let middle = normal(0.5, 0.5);
        let corners = [normal(0.0, 0.0), normal(1.0, 0.0), normal(0.0, 1.0), normal(1.0, 1.0)];
        !corners.into_iter().all(|corner| dot(corner, middle) > 1e-3 * length(corner) * length(middle))
    }
    /// Relative difference allowed between the pdf of a sample and the pdf of its direction; `None` where the direction says nothing.
    ///
    /// Lines: to the rounding of the direction, over the sine of its angle to the line. Curved lights by area: a rounded direction moves the
    /// point by 16 ulp of the distance, and the cosine there by that over the radius and the cosine; a patch has the radius at which its
    /// normal turns with the point, and points that are four rounded terms. Samples that the light itself hides have the pdf of their own point.
    #[must_use]
    pub fn evaluated_to(&self, s: &LightSample<f32>) -> Option<f64> {
        if self.by == Measure::Delta {
            return None;
        }
        let curved = matches!(self.shape, LightShape::Sphere | LightShape::Patch);
        if self.shape != LightShape::Line && !(curved && self.by == Measure::Area) {
            return Some(0.0);
        }
        let cos = dot(s.direction.at(0), s.normal.at(0));
        if self.shape == LightShape::Line {
            let allowed = 32.0 * ULP / cos.abs();
            return (allowed < 0.05).then_some(allowed);
        }
        if self.shape == LightShape::Patch && self.folded() {
            return None;
        }
        let (size, reach) = match self.shape {
            LightShape::Patch => {
                // |∂s×∂t| and the normal change by a step over the point's own step times the twist
                let (b, c, n) = (wide(self.b), wide(self.c), wide(self.n));
                let (twist, [x, y, _]) = (sub(sub(n, b), c), s.uv.at(0));
                let (along_s, along_t) = (along(b, twist, y), along(c, twist, x));
                let area = length(cross(along_s, along_t));
                let bend = 2.0 * length(twist) * length(along_s) * length(along_t);
                (area * area / bend.max(1e-300), f64::from(s.distance) + length(n))
            }
            _ => (f64::from(self.radius), f64::from(s.distance) + length(wide(self.b)) + length(self.offset())),
        };
        // a point of a patch is a sum of rounded terms, which counts from nearby
        let terms = [self.offset(), wide(self.b), wide(self.c), wide(self.n)].map(length).iter().sum::<f64>();
        let near = if self.shape == LightShape::Patch { 4.0 * terms / f64::from(s.distance) } else { 0.0 };
        let allowed = ULP * (32.0 * (1.0 + reach / size) + near) / (cos * cos);
        (s.emits && allowed < 0.05).then_some(allowed)
    }
    /// Whether the surface coordinates of a hit are those of a point at its distance in its direction.
    #[must_use]
    pub fn has(&self, hit: &LightSample<f32>) -> bool {
        let reach: V3 = hit.direction.at(0).map(|x| x * f64::from(hit.distance));
        let size = [self.b, self.c, self.n].iter().fold(0.0, |sum, v| sum + length(wide(*v)));
        let point = || self.on_patch([f64::from(hit.uv.x), f64::from(hit.uv.y)]);
        // a direction is rounded, and moves the point where it meets the patch at a small angle
        self.shape != LightShape::Patch
            || length(sub(point(), reach)) < 1e-3 * size + 256.0 * ULP * length(self.offset())
    }
    /// Density per steradian by area of a point of the light in the direction `w` at `distance`, and to what part of itself it is known for a
    /// rounded direction.
    #[must_use]
    pub fn density(&self, w: V3, distance: f64) -> Option<(f64, f64)> {
        if self.by != Measure::Area {
            return None;
        }
        let (a, b, c) = (self.offset(), wide(self.b), wide(self.c));
        let (normal, area, turned) = self.surface(w, distance)?;
        // what is subnormal has few digits: so has an edge in units of another that is so much longer
        let flat = matches!(self.shape, LightShape::Triangle | LightShape::Parallelogram | LightShape::Rectangle);
        let (shorter, longer) = (length(b).min(length(c)), length(b).max(length(c)));
        if !(1e-36..1e36).contains(&area) || flat && shorter < 1e-36 * longer {
            return None;
        }
        let cos = dot(w, normal).abs() / length(normal);
        // a product that cancels is known no better than its factors
        let sine = length(cross(b, c)) / (length(b) * length(c));
        let slim = if flat { 8.0 / sine } else { 0.0 };
        // without a fused operation, what is added to the end of a line is rounded first, which counts from nearby
        let is_rounded = self.shape == LightShape::Line && !SAME_BITS;
        let near = if is_rounded { length(b) / distance } else { 0.0 };
        let known = (16.0 + slim + (12.0 + slim + 4.0 * turned) / cos + 4.0 * near) * ULP;
        if flat || self.shape.has_normal() {
            // the direction determines the distance, by its cosine, of which the pdf is a third power
            let distance = dot(a, normal).abs() / (length(normal) * cos);
            return Some((distance * distance / (cos * area), 3.0 * known));
        }
        Some((distance * distance / (cos * area), known))
    }
    /// Flat shapes by projected solid angle, seen from their own plane or a corner but for rounding, have directions of any length up to 1.
    pub(super) fn unit_to(&self) -> f64 {
        let (v, normal) = (self.offset(), cross(wide(self.b), wide(self.c)));
        let flat = matches!(self.shape, LightShape::Triangle | LightShape::Parallelogram | LightShape::Polygon);
        let size = length(wide(self.b)) + length(wide(self.c));
        let edge_on = !(dot(v, normal).abs() > 1e-4 * length(v) * length(normal) && length(v) > 1e-4 * size);
        // what is subnormal has few digits
        let touched = self.shape == LightShape::Line && length(v) < 1e-4 * size || length(v) < 1e-37;
        let coarse = flat && edge_on && self.by == Measure::ProjectedSolidAngle || touched;
        if coarse { 1.0 } else { 12.0 * ULP }
    }
}
