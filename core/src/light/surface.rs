//! The surfaces of lights relative to the shading point, which is the origin of all coordinates here.

use crate::real::Real;
use crate::vector::{Vec2, Vec3};

/// Angle in radians by which a direction may leave a shape through rounding: 12 ulp of a component near 1.
pub(super) const SURFACE_SLACK: f64 = 12.0 / 16_777_216.0;

/// Where a direction meets a surface.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceHit<R> {
    /// Distance from the shading point.
    pub distance: R,
    /// Unit normal on the side that emits.
    pub normal: Vec3<R>,
    /// Surface coordinates in [0, 1]².
    pub uv: Vec2<R>,
}

/// A point drawn on a surface.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint<R> {
    /// The point relative to the shading point.
    pub position: Vec3<R>,
    /// Unit normal on the side that emits.
    pub normal: Vec3<R>,
    /// Surface coordinates in [0, 1]².
    pub uv: Vec2<R>,
    /// 1/pdf per unit area there; 0 where there is no sample.
    pub inverse_pdf: R,
}

/// The surface of a light, placed relative to a shading point.
pub trait Surface<R: Real>: Copy {
    /// The nearest point in the unit direction `w`. Only meaningful where `w` hits the surface; finite everywhere.
    fn at(&self, w: Vec3<R>) -> SurfaceHit<R>;
    /// The same where the distance of the point is known.
    #[inline(always)]
    fn at_distance(&self, w: Vec3<R>, distance: R) -> SurfaceHit<R> {
        SurfaceHit { distance, ..self.at(w) }
    }
}

/// A surface that can be sampled by area.
pub trait AreaSurface<R: Real>: Surface<R> {
    /// True where the normal is constant, so that a direction determines the density as well as the point does.
    const FLAT: bool;
    /// A point for `u` in [0, 1)².
    fn draw(&self, u: Vec2<R>) -> SurfacePoint<R>;
    /// 1/pdf per unit area at surface coordinates.
    fn inverse_pdf(&self, uv: Vec2<R>) -> R;
    /// True where the unit direction `w` hits the surface, to within the rounding of the direction.
    fn contains(&self, w: Vec3<R>) -> R::Mask;
    /// The `u` that [`draw`](Self::draw) maps to the nearest point in the direction `w`.
    fn invert(&self, w: Vec3<R>) -> Vec2<R>;
    /// Surface area.
    fn area(&self) -> R;
}
