//! Whether a point that a host has computed lies on a light.

use super::direction::to_unit;
use super::{
    BilinearPatch, DirectionalLight, Disk, Line, Parallelogram, PointLight, Polygon, Rectangle, Sphere, SpotLight, Sun,
    Triangle,
};
use crate::real::{Mask, Real};
use crate::vector::Vec3;

/// How far from a light a point of it may be, in units of the last place of the greatest coordinate of either. Barycentric coordinates and
/// hits of rays from points with coordinates no greater take up to 6; a ray from n times as far, n times as many.
const ULPS: f64 = 16.0;

/// That distance where the greatest coordinate is 1.
#[inline(always)]
fn slack<R: Real>() -> R {
    R::lit(if R::DOUBLE { ULPS / 9_007_199_254_740_992.0 } else { ULPS / 16_777_216.0 })
}

/// Whether a point is in the plane through `origin` along two edges. The edges are in units of their own, however different they are.
#[inline(always)]
fn in_plane<R: Real>(p: Vec3<R>, origin: Vec3<R>, [a, b]: [Vec3<R>; 2]) -> R::Mask {
    let [([e], _), ([f], _)] = [a, b].map(|edge| to_unit([edge]));
    let normal = e.cross(f).unit_and_length().0;
    let ([p, origin, a, b], _) = to_unit([p, origin, a, b]);
    near_plane(p, origin, normal, a.max_abs() + b.max_abs())
}

#[inline(always)]
fn near_plane<R: Real>(p: Vec3<R>, origin: Vec3<R>, normal: Vec3<R>, more: R) -> R::Mask {
    let reach = p.max_abs() + origin.max_abs() + more;
    let is_plane = normal.max_abs().gt(R::lit(0.0));
    (p - origin).dot(normal).abs().le(reach * slack()) & is_plane
}

macro_rules! on_surface {
    ($($(#[$doc:meta])* $light:ty $([$n:ident])?: |$self:ident, $p:ident| $is_on:expr;)+) => {$(
        impl<R: Real $(, const $n: usize)?> $light {
            $(#[$doc])*
            #[inline(always)]
            pub fn on_surface(&self, p: Vec3<R>) -> R::Mask {
                let ($self, $p) = (self, p);
                $is_on
            }
        }
    )+};
}
on_surface! {
    /// Whether the point `p` is in the plane of the light, to within the rounding of its own computation: 16 units of the last place of the
    /// greatest coordinate. True for every point of the light that a host has computed from its vertices, or as the hit of a ray from a point
    /// whose coordinates are at most twice as great. Half of these are in front of the light through rounding, and would be lit; the host
    /// passes over the light then. (The hit of a ray from farther away has the rounding of the ray's length; barycentric coordinates
    /// make a better point of it.) False where there is no plane.
    Triangle<R>: |light, p| in_plane(p, light.v0, [light.e1, light.e2]);
    /// Whether the point `p` is in the plane of the light, to within the rounding of its own computation: as of a
    /// [`Triangle`](Triangle::on_surface).
    Parallelogram<R>: |light, p| in_plane(p, light.corner, [light.edge_s, light.edge_t]);
    /// Whether the point `p` is in the plane of the light, to within the rounding of its own computation: as of a
    /// [`Triangle`](Triangle::on_surface).
    Rectangle<R>: |light, p| in_plane(p, light.corner, [light.edge_s, light.edge_t]);
    /// Whether the point `p` is in the plane of the light, to within the rounding of its own computation: as of a
    /// [`Triangle`](Triangle::on_surface).
    Disk<R>: |light, p| light.near(p, R::lit(0.0));
    /// Whether the point `p` is in the plane of the light, to within the rounding of its own computation: as of a
    /// [`Triangle`](Triangle::on_surface).
    Polygon<R, N> [N]: |light, p| {
        let first = light.corners[0];
        let (edges, _) = to_unit(light.corners.map(|corner| corner - first));
        let normal = edges.windows(2).fold(Vec3::ZERO, |sum, pair| sum + pair[0].cross(pair[1])).unit_and_length().0;
        let most = light.corners.iter().fold(R::lit(0.0), |most, corner| most.greater(corner.max_abs()));
        let ([p, origin, most], _) = to_unit([p, first, Vec3::new(most, most, most)]);
        near_plane(p, origin, normal, most.x)
    };
    /// Whether the point `p` is on the sphere, to within the rounding of its own computation: as of a [`Triangle`](Triangle::on_surface).
    Sphere<R>: |light, p| light.near(p, R::lit(0.0));
    /// False: a patch that is not flat may light itself, so that no host passes over it.
    BilinearPatch<R>: |_light, _p| R::Mask::splat(false);
    /// False: no point lies on a light without a surface.
    Line<R>: |_light, _p| R::Mask::splat(false);
    /// False: no point lies on a light without a surface.
    PointLight<R>: |_light, _p| R::Mask::splat(false);
    /// False: no point lies on a light without a surface.
    SpotLight<R>: |_light, _p| R::Mask::splat(false);
    /// False: no point lies on a light that is infinitely far away.
    DirectionalLight<R>: |_light, _p| R::Mask::splat(false);
    /// False: no point lies on a light that is infinitely far away.
    Sun<R>: |_light, _p| R::Mask::splat(false);
}

impl<R: Real> Disk<R> {
    /// Whether a point is in the plane, where the greatest coordinate is `more` beside those of disk and point.
    #[inline(always)]
    pub(super) fn near(&self, p: Vec3<R>, more: R) -> R::Mask {
        let numbers = Vec3::new(self.radius.abs(), more, R::lit(0.0));
        let ([p, center, numbers], _) = to_unit([p, self.center, numbers]);
        near_plane(p, center, self.normal.unit_and_length().0, numbers.x + numbers.y)
    }
}
impl<R: Real> Sphere<R> {
    /// Whether a point is on the sphere, where the greatest coordinate is `more` beside those of sphere and point.
    #[inline(always)]
    pub(super) fn near(&self, p: Vec3<R>, more: R) -> R::Mask {
        let ([p, center, numbers], _) = to_unit([p, self.center, Vec3::new(self.radius, more, R::lit(0.0))]);
        let reach = p.max_abs() + center.max_abs() + numbers.x + numbers.y;
        ((p - center).length() - numbers.x).abs().le(reach * slack()) & numbers.x.gt(R::lit(0.0))
    }
}
