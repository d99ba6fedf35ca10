//! Directions by the octahedral map.

use super::Warp;
use crate::real::{Real, unit_interval};
use crate::vector::{Vec2, Vec3};

const HALF_ROOT: f64 = core::f64::consts::FRAC_1_SQRT_2;

/// Directions of the whole sphere, uniform in solid angle, by an octahedron unfolded to the square: the map of environment
/// images in pbrt-v4.
///
/// Call `Octahedral.sample(u)`; there is nothing to set up and no degenerate input.
///
/// ```
/// use etendue::{Vec2, Warp, warp::Octahedral};
/// let up = Octahedral.sample(Vec2::new(0.5_f32, 0.5));
/// assert_eq!((up.x, up.y, up.z), (0.0, 0.0, 1.0));
/// ```
///
/// - Formula, with a = |2u₀−1|, b = |2u₁−1| and r = min(a + b, 2 − a − b): |z| = 1−r², z ≥ 0 where a + b ≤ 1; the azimuth
///   within its octant is (π/4)((b−a)/r + 1); x and y have the signs of 2u₀−1 and 2u₁−1.
/// - Domain: u in [0, 1)²; the centre of the square is +z, its corners are −z, and the midpoints of its edges are the
///   horizontal axes. The map is continuous, except that each edge of the square is folded onto itself about its midpoint.
/// - Density: the pdf is 1/(4π) per steradian.
/// - Greatest error: 2.4e−7 in the direction; 1.5e−7 in `invert(sample(u))`, given a direction with that error.
/// - Source: Clarberg, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD", JGT 13(3), 2008; PBR 4th ed., 3.8.3.
#[derive(Clone, Copy, Debug, Default)]
pub struct Octahedral;

impl<R: Real> Warp<R> for Octahedral {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        let (one, two) = (R::lit(1.0), R::lit(2.0));
        // both exact
        let (signed_a, signed_b) = (two.mul_add(u.x, -one), two.mul_add(u.y, -one));
        let (a, b) = (signed_a.abs(), signed_b.abs());
        let sum = a + b;
        let upper = sum.le(one);
        // 2 − a − b from two differences that are exact near the corners
        let r = R::blend(upper, sum, (one - a) + (one - b));
        let some = r.gt(R::lit(0.0));
        // azimuth from the diagonal, in quarter turns
        let turn = ((b - a) * R::lit(0.5) / R::blend(some, r, one)).clamped(R::lit(-0.5), R::lit(0.5));
        let (s, c) = turn.sin_cos_quarters();
        let square = r * r;
        let sin = r * (two - square).sqrt() * R::lit(HALF_ROOT);
        let z = one - square;
        Vec3 { x: (sin * (c - s)).copysign(signed_a), y: (sin * (c + s)).copysign(signed_b), z: R::blend(upper, z, -z) }
    }
    /// The pdf per steradian.
    #[inline(always)]
    fn pdf(&self, _: Vec3<R>) -> R {
        R::lit(0.25 * core::f64::consts::FRAC_1_PI)
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let (one, half) = (R::lit(1.0), R::lit(0.5));
        // 1 − |z| without cancellation
        let r = (w.x.mul_add(w.x, w.y * w.y) / (one + w.z.abs())).sqrt();
        // azimuth: 0 on the x axis, 1 on the y axis, measured from the nearer one
        let (x, y) = (w.x.abs(), w.y.abs());
        let steep = y.gt(x);
        let (large, small) = (R::blend(steep, y, x), R::blend(steep, x, y));
        let minor = r * (small.atan2(large) * R::lit(2.0 * core::f64::consts::FRAC_1_PI));
        let major = r - minor;
        let (a, b) = (R::blend(steep, minor, major), R::blend(steep, major, minor));
        let lower = w.z.lt(R::lit(0.0));
        let (a, b) = (R::blend(lower, one - b, a), R::blend(lower, one - a, b));
        let place = |x: R, sign: R| unit_interval(x.copysign(sign).mul_add(half, half));
        Vec2 { x: place(a, w.x), y: place(b, w.y) }
    }
}
