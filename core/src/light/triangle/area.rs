//! Triangles by area.

use crate::lanewise::lanewise;
use crate::light::plane::AffinePlane;
use crate::light::surface::{AreaSurface, Surface, SurfaceHit, SurfacePoint};
use crate::real::Real;
use crate::vector::{Vec2, Vec3};
use crate::warp::{AreaTriangle, Warp};

lanewise! {
    /// A triangle relative to the shading point. Its surface coordinates are the barycentric coordinates of the second and the third
    /// vertex.
    pub struct PlacedTriangle {
        origin: Vec3<R>,
        first: Vec3<R>,
        second: Vec3<R>,
        plane: AffinePlane<R>,
    }
}

impl<R: Real> PlacedTriangle<R> {
    #[inline(always)]
    pub(in crate::light) fn new(origin: Vec3<R>, first: Vec3<R>, second: Vec3<R>) -> Self {
        Self { origin, first, second, plane: AffinePlane::new(origin, first, second) }
    }
}

impl<R: Real> Surface<R> for PlacedTriangle<R> {
    #[inline(always)]
    fn at(&self, w: Vec3<R>) -> SurfaceHit<R> {
        self.plane.at(w)
    }
}

impl<R: Real> AreaSurface<R> for PlacedTriangle<R> {
    const FLAT: bool = true;
    #[inline(always)]
    fn draw(&self, u: Vec2<R>) -> SurfacePoint<R> {
        let uv: Vec2<R> = AreaTriangle.sample(u);
        let position = self.first.mul_add(uv.x, self.second.mul_add(uv.y, self.origin));
        SurfacePoint { position, normal: self.plane.normal, uv, inverse_pdf: self.area() }
    }
    #[inline(always)]
    fn inverse_pdf(&self, _: Vec2<R>) -> R {
        self.area()
    }
    #[inline(always)]
    fn contains(&self, w: Vec3<R>) -> R::Mask {
        self.plane.contains(w, false)
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let Vec2 { x, y } = self.plane.coordinates(w);
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        AreaTriangle.invert(Vec2::new(x.clamped(zero, one), y.clamped(zero, one)))
    }
    #[inline(always)]
    fn area(&self) -> R {
        self.plane.parallelogram_area() * R::lit(0.5)
    }
}
