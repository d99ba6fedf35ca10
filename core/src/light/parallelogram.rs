//! Parallelograms.

pub(super) mod area;
pub(super) mod solid_angle;

use super::bound::{LightBound, wide};
use super::polygon::projected::ProjectedParallelogram;
use super::sampler::{ByArea, ByProjectedSolidAngle, ByReflection, BySolidAngle};
use crate::lanewise::lanewise;
use crate::real::Real;
use crate::reflection::Reflection;
use crate::vector::Vec3;
use area::PlacedParallelogram;
use solid_angle::SphericalParallelogram;

lanewise! {
    /// A parallelogram light corner + s·edge_s + t·edge_t, s and t in [0, 1], that emits from the side of edge_s × edge_t.
    ///
    /// For rectangles whose strata should follow the edges take [`Rectangle`](crate::Rectangle). A point in the plane of the parallelogram, or a
    /// parallelogram without area, gives pdf 0. Surface coordinates: (s, t).
    ///
    /// ```
    /// use etendue::{LightSampler, Parallelogram, Vec2};
    /// let panel = Parallelogram::new([-1.0, 2.0, -1.0].into(), [2.0, 0.0, 0.0].into(), [0.0, 0.0, 2.0_f32].into());
    /// let sampler = panel.by_solid_angle([0.0; 3].into());
    /// let s = sampler.sample(Vec2::new(0.3, 0.6));
    /// assert!((s.direction.y * s.distance - 2.0).abs() < 1e-6 && s.pdf == 1.0 / sampler.solid_angle());
    /// ```
    pub struct Parallelogram {
        /// Corner, in the coordinates of the scene.
        pub corner: Vec3<R>,
        /// Edge along s.
        pub edge_s: Vec3<R>,
        /// Edge along t.
        pub edge_t: Vec3<R>,
    }
}

impl<R: Real> Parallelogram<R> {
    /// The parallelogram with this corner and these edges from there.
    #[inline(always)]
    pub fn new(corner: Vec3<R>, edge_s: Vec3<R>, edge_t: Vec3<R>) -> Self {
        Self { corner, edge_s, edge_t }
    }
    #[inline(always)]
    fn placed(&self, p: Vec3<R>) -> PlacedParallelogram<R> {
        PlacedParallelogram::new(self.corner - p, self.edge_s, self.edge_t)
    }
    /// Uniform over the surface, seen from the point `p`: pdf distance²/(|cosθ'| A) per steradian, with the error of
    /// [`Triangle::by_area`](crate::Triangle::by_area).
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>) -> ParallelogramByArea<R> {
        ByArea { surface: self.placed(p) }
    }
    /// Uniform over the solid angle Ω at the point `p`: pdf 1/Ω per steradian.
    ///
    /// It consists of two spherical triangles with the corner in common: u₀ sweeps about that corner from one side to the
    /// other, across the diagonal without a jump, so that strata of the square stay connected.
    ///
    /// - Formula: Ω = Ω₁ + Ω₂; u₀ < Ω₁/Ω takes the triangle (p+u, p, p+u+v) at u₀Ω/Ω₁, else (p+u+v, p, p+v) with the remainder.
    /// - Domain: u in [0, 1)²; any parallelogram, from any side.
    /// - Density: the pdf is 1/Ω per steradian inside (and within the triangle's 12 ulp beyond), 0 outside.
    /// - Degenerate input: the point in the plane, zero area, lengths whose sums overflow, or a sliver so narrow that one of the
    ///   triangles has none: Ω = 0 and pdf 0.
    /// - Greatest error: Ω 5e−7 relative. The direction is as for the triangle, if the point is at least 1e−5 of the
    ///   parallelogram's size above its plane; add what half a step of 2⁻²⁴ in u₀ does to the direction, over the sine of the
    ///   elevation of the nearest corner, since u₀ = Ω₁/Ω, where the second triangle begins, is rounded. The inverse is as for
    ///   the triangle.
    /// - Source: as for [`Triangle::by_solid_angle`](crate::Triangle::by_solid_angle).
    #[inline(always)]
    pub fn by_solid_angle(&self, p: Vec3<R>) -> ParallelogramBySolidAngle<R> {
        let shape = SphericalParallelogram::new(self.corner - p, self.edge_s, self.edge_t);
        BySolidAngle { surface: self.placed(p), shape }
    }
    /// Uniform over the projected solid angle Ω⊥ above the horizon of the unit normal `n` at the point `p`: pdf
    /// cosθ/Ω⊥ per steradian, 0 where nothing of the parallelogram is above the horizon. On an unoccluded diffuse surface every sample
    /// has the same value.
    #[inline(always)]
    pub fn by_projected_solid_angle(&self, p: Vec3<R>, n: Vec3<R>) -> ParallelogramByProjectedSolidAngle<R> {
        let shape = ProjectedParallelogram::default();
        let mut sampler = ByProjectedSolidAngle { normal: n, surface: self.placed(p), shape };
        sampler.shape.prepare_parallelogram(self.corner - p, [self.edge_s, self.edge_t], n);
        sampler
    }
    /// In proportion to the lobe of a rough surface at the point `p`: as [`Triangle::by_reflection`](crate::Triangle::by_reflection).
    #[inline(always)]
    pub fn by_reflection(&self, p: Vec3<R>, reflection: &Reflection<R>) -> ParallelogramByReflection<R> {
        let [corner, s, t] = [self.corner - p, self.edge_s, self.edge_t].map(|v| reflection.to_cosine(v));
        let shape = ProjectedParallelogram::default();
        let mut sampler = ByReflection { reflection: *reflection, surface: self.placed(p), shape };
        sampler.shape.prepare_parallelogram(corner, [s, t], Vec3::lit([0.0, 0.0, 1.0]));
        sampler
    }
}

impl<R: Real<Scalar = R>> Parallelogram<R> {
    /// What it can contribute with this radiance. One that is not positive gives the power 0.
    #[must_use]
    pub fn bound(&self, radiance: R) -> LightBound {
        let [s, t] = [self.edge_s, self.edge_t].map(wide);
        LightBound::flat(wide(self.corner), &[Vec3::default(), s, s + t, t], radiance.lane_f64(0))
    }
}

/// A [`Parallelogram`] or a [`Rectangle`](crate::Rectangle) sampled by the lobe of a rough surface.
pub type ParallelogramByReflection<R> = ByReflection<R, PlacedParallelogram<R>, ProjectedParallelogram<R>>;
/// A [`Parallelogram`] or a [`Rectangle`](crate::Rectangle) sampled by area from a point.
pub type ParallelogramByArea<R> = ByArea<PlacedParallelogram<R>>;
/// A [`Parallelogram`] sampled by solid angle from a point.
pub type ParallelogramBySolidAngle<R> = BySolidAngle<PlacedParallelogram<R>, SphericalParallelogram<R>>;
/// A [`Parallelogram`] or a [`Rectangle`](crate::Rectangle) sampled by projected solid angle from a point on a surface.
pub type ParallelogramByProjectedSolidAngle<R> =
    ByProjectedSolidAngle<R, PlacedParallelogram<R>, ProjectedParallelogram<R>>;
