use super::{LightSample, direction_to};
use crate::lanewise::lanewise;
use crate::real::{Mask, Real};
use crate::spherical::{DirectionSample, ProjectedSegment, SphericalSegment};
use crate::vector::Vec3;

lanewise! {
    /// A line light: a cylinder so thin that only its width times its radiance counts, which emits to all sides.
    ///
    /// Its samples take one number. `pdf` is the density in the measure of what a unit of width is seen under, sinγ ds/r² (γ from the
    /// line, s along it: steradians per unit of width), so that the estimator is `f · L · width · cosθ / pdf`. Techniques of this
    /// light compare by it. No direction drawn otherwise can hit the light, so `delta` holds.
    pub struct Line {
        /// One end.
        pub p: Vec3<R>,
        /// From there to the other end.
        pub edge: Vec3<R>,
    }
}

impl<R: Real> Line<R> {
    /// Uniform over the length. pdf = r²/(length · sinγ): density 1/length per unit of length.
    ///
    /// Degenerate: a length of 0, a point on the line: pdf 0.
    #[inline(always)]
    pub fn by_length(&self, p: Vec3<R>, u: R) -> LightSample<R> {
        let DirectionSample { direction, distance } = direction_to(self.edge.mul_add(u, self.p - p));
        let scale = self.edge.max_abs().pow2_scale();
        let across = direction.cross(self.edge * scale).length() / scale;
        sample(DirectionSample { direction, distance }, super::solid_angle_pdf(distance, across))
    }
    /// Uniform over the angle, [`SphericalSegment`]: better than by length wherever the point is near. pdf = r/α: density 1/α per
    /// radian.
    #[inline(always)]
    pub fn by_angle(&self, p: Vec3<R>, u: R) -> LightSample<R> {
        let seen = SphericalSegment::new(self.p - p, self.edge);
        let sighting = seen.sample_direction(u);
        sample(sighting, seen.uniform_pdf() * sighting.distance)
    }
    /// By projected solid angle above the horizon of `normal`, [`ProjectedSegment`]: on an unoccluded diffuse surface every sample is
    /// worth the same. pdf 0 where nothing of the line is above the horizon.
    #[inline(always)]
    pub fn by_projected_solid_angle(&self, p: Vec3<R>, normal: Vec3<R>, u: R) -> LightSample<R> {
        let seen = ProjectedSegment::new(self.p - p, self.edge, normal);
        let sighting = seen.sample_direction(u);
        sample(sighting, seen.pdf(sighting.direction) * sighting.distance)
    }
}

#[inline(always)]
fn sample<R: Real>(DirectionSample { direction, distance }: DirectionSample<R>, pdf: R) -> LightSample<R> {
    let pdf = pdf.keep(pdf.lt(R::lit(1e37)));
    LightSample { direction, distance, pdf, emits: pdf.gt(R::lit(0.0)), delta: R::Mask::splat(true) }
}
