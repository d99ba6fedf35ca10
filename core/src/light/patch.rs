use super::{LightSample, finite_by_area};
use crate::lanewise::lanewise;
use crate::real::Real;
use crate::vector::{Vec2, Vec3};
use crate::warp::{PatchSurface, Warp};

lanewise! {
    /// A bilinear patch p + su + tv + st(w − u − v), s and t in [0, 1], that emits on the side of ∂s×∂t.
    pub struct BilinearPatch {
        /// Corner.
        pub p: Vec3<R>,
        /// From there to the next corner, s = 1.
        pub u: Vec3<R>,
        /// From there to the other next corner, t = 1.
        pub v: Vec3<R>,
        /// From there to the opposite corner.
        pub w: Vec3<R>,
    }
}

impl<R: Real> BilinearPatch<R> {
    /// Nearly uniform over the surface, [`PatchSurface`], with the density as it is. pdf = distance²/|cosθ'| times that.
    #[inline(always)]
    pub fn by_area(&self, p: Vec3<R>, u: Vec2<R>) -> LightSample<R> {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let surface = PatchSurface { p: self.p - p, u: self.u, v: self.v, w: self.w };
        let parameters = surface.parameters();
        let st = parameters.sample(u);
        let density = parameters.pdf(st);
        let some = density.gt(zero);
        let part = (one / R::blend(some, density, one)).keep(some);
        // |∂s×∂t| over the density of (s, t) is what a flat light has for its area
        finite_by_area(surface.p + surface.offset(st), surface.normal(st) * part)
    }
}
