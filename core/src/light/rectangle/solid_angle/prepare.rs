//! Prepares a rectangle for a point: its ends and the strips of Ureña et al., with the names of
//! [`Rectangle::by_solid_angle`](crate::Rectangle::by_solid_angle).

use super::{RECTANGLE_SLACK, SphericalRectangle, Strip, corners, window};
use crate::math::{ratio, rsqrt};
use crate::real::Real;
use crate::vector::double_word::{cross_dw, dot_dw, height_over, rounded_sum, sum_dw};
use crate::vector::{Vec2, Vec3};

/// Returns the normal of the plane through `p` along both edges, and the height p·normal. From a far corner that height is a small
/// difference, so it is formed in twice the working precision.
#[inline(always)]
fn normal_and_height<R: Real>(p: Vec3<R>, [u, v]: [&Extent<R>; 2]) -> (Vec3<R>, R) {
    let cross = u.unit.cross(v.unit);
    // the edges are perpendicular
    let inverse = u.inverse * v.inverse;
    (cross * inverse, height_over(p, [u.unit, v.unit], cross) * inverse)
}

/// Reverses the vector where the mask is true.
#[inline(always)]
fn turned<R: Real>(v: Vec3<R>, mask: R::Mask) -> Vec3<R> {
    v.map(|x| x.negate_where(mask))
}

/// The range that the rectangle covers along one of its edges, in coordinates from the foot. The axis points to the far end.
struct Extent<R: Real> {
    /// Whether the axis points against the edge.
    flip: R::Mask,
    /// Unit vector along the axis.
    side: Vec3<R>,
    /// Coordinates of the near and of the far end, and their difference, in the unit of p.
    near: R,
    far: R,
    size: R,
    /// The edge times a power of two, and 1 over the length of that.
    unit: Vec3<R>,
    inverse: R,
}

impl<R: Real> Extent<R> {
    /// Measures the range of an edge that begins at the corner p. Coordinates of far corners are small differences.
    #[inline(always)]
    fn new(p: Vec3<R>, edge: Vec3<R>) -> Self {
        let zero = R::lit(0.0);
        let unit = edge * edge.max_abs().pow2_scale();
        let squared = unit.length_squared();
        let inverse = rsqrt(squared).keep(squared.gt(zero));
        let (from, reach) = (dot_dw(p, unit), dot_dw(edge, unit));
        let (low, high) = ((from[0] + from[1]) * inverse, rounded_sum(from, reach) * inverse);
        let size = (reach[0] + reach[1]) * inverse;
        // rounding may lose a tiny size in both ends; the near end is the one of smaller magnitude
        let flip = (low + high).lt(zero);
        let near = R::blend(flip, -high, low).greater(R::lit(-0.5) * size);
        Self { flip, side: turned(unit * inverse, flip), near, far: near + size, size, unit, inverse }
    }
    /// Whether coordinates are measured from the far edge.
    #[inline(always)]
    fn anchored(&self) -> R::Mask {
        (self.near + self.near).ge(self.far)
    }
    /// Sorts the planes through the sides at which the edge begins and ends: the one at the near end comes first.
    #[inline(always)]
    fn sorted(&self, [low, high]: [Plane<R>; 2]) -> [Plane<R>; 2] {
        let pick = |yes: &Plane<R>, no: &Plane<R>| Plane {
            normal: Vec3::blend(self.flip, yes.normal, no.normal),
            slack: R::blend(self.flip, yes.slack, no.slack),
        };
        [pick(&high, &low), pick(&low, &high)]
    }
}

/// Returns the origin of X and Y, which is computed from the far corner or from the foot, whichever is nearer to it.
#[inline(always)]
fn base<R: Real>([x, y]: [&Extent<R>; 2], [p, u, v]: [Vec3<R>; 3], foot: Vec3<R>, z: R) -> Vec3<R> {
    let far_corner = p + u.keep(!x.flip) + v.keep(!y.flip);
    let (there_x, there_y) = (x.far.keep(x.anchored()), y.far.keep(y.anchored()));
    let (gone_x, gone_y) = (x.far - there_x, y.far - there_y);
    let from_corner = far_corner - x.side * gone_x - y.side * gone_y;
    let from_foot = x.side.mul_add(there_x, y.side.mul_add(there_y, foot));
    let gone = gone_x.greater(gone_y);
    Vec3::blend(gone.le(there_x.greater(there_y).greater(z)), from_corner, from_foot)
}

impl<R: Real> Strip<R> {
    /// The strip to x, given the distances of its corners there, and the distances m₀ and m₁ of those at x = 0.
    #[inline(always)]
    fn new(x: R, y: &Extent<R>, z: R, [r0, r1]: [R; 2], inverse_mm: R) -> Self {
        let (one, &Extent { near: y0, far: y1, size: dy, .. }) = (R::lit(1.0), y);
        let (zz, yy, xx) = (z * z, y0 * y1, x * x);
        let across = y0.lt(R::lit(0.0));
        let (d, rr) = (xx + zz, r0 * r1);
        // what is degenerate has no pdf, and its samples are clamped
        let id = one / d;
        let sum = y1.mul_add(r0, y0.abs() * r1);
        let cross = R::blend(across, sum * id, dy * (y1 + y0) / sum);
        // rr ∓ |y₀y₁|, the smaller one over d
        let plus = rr + yy.abs();
        let minus = y0.mul_add(y0, y1.mul_add(y1, d)) / plus + one;
        let along = zz * inverse_mm;
        Self {
            sin: x * z * cross * inverse_mm,
            cos: xx.mul_add(yy, zz * rr) * id * inverse_mm,
            above_p: along * dy * dy / R::blend(across, d * minus, plus + d),
            above_s: along * R::blend(across, (plus + d) * id, minus),
        }
    }
}

/// A plane through the viewpoint and a side: its unit normal, pointing inwards, and its tolerance.
struct Plane<R> {
    normal: Vec3<R>,
    slack: R,
}

/// Returns the planes at both ends of u, then those at both ends of v. They follow from p, u and v, since the other corners are rounded sums.
#[inline(always)]
fn planes<R: Real>([p, u, v]: [Vec3<R>; 3], corners: [Vec3<R>; 4], behind: R::Mask) -> [[Plane<R>; 2]; 2] {
    let (pu, pv, uv) = (cross_dw(p, u), cross_dw(p, v), cross_dw(u, v));
    let minus = |n: [Vec3<R>; 2]| n.map(|n| -n);
    let plane = |n: [Vec3<R>; 2], a: Vec3<R>, b: Vec3<R>| {
        let (unit, length) = (n[0] + n[1]).unit_and_length();
        let slack = ratio(-a.dot(b), length).greater(R::lit(1.0)).lesser(R::lit(1e18)) * R::lit(RECTANGLE_SLACK);
        Plane { normal: turned(unit, behind), slack }
    };
    let [a, b, c, d] = corners;
    [[plane(minus(pv), a, d), plane(sum_dw(pv, uv), b, c)], [plane(pu, a, b), plane(sum_dw(uv, minus(pu)), d, c)]]
}

/// Multiplies the corner and the edges by a power of two, so that no length exceeds 2. Returns that factor, too, and whether every point of
/// the rectangle is at a finite distance.
#[inline(always)]
fn scaled<R: Real>([p, u, v]: [Vec3<R>; 3]) -> ([Vec3<R>; 3], R, R::Mask) {
    let reach = p.max_abs().greater(u.max_abs()).greater(v.max_abs());
    let sum = p.max_abs() + u.max_abs() + v.max_abs();
    let finite = (sum + sum).lt(R::lit(f64::INFINITY));
    let scale = reach.pow2_scale();
    ([p.keep(finite) * scale, u.keep(finite) * scale, v.keep(finite) * scale], scale, finite)
}

impl<R: Real> SphericalRectangle<R> {
    /// Prepares for the corners p, p+u, p+u+v, p+v, with p relative to the point and u perpendicular to v; all in one unit of
    /// length.
    #[inline(always)]
    pub fn new(p: Vec3<R>, u: Vec3<R>, v: Vec3<R>) -> Self {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let ([p, u, v], scale, finite) = scaled([p, u, v]);
        let vertices = [p, p + u, p + u + v, p + v];
        let (x, y) = (Extent::new(p, u), Extent::new(p, v));
        let (z_axis, signed) = normal_and_height(p, [&x, &y]);
        let (z, side) = (signed.abs(), one.copysign(signed));
        let (near, far, size) = (Vec2::new(x.near, y.near), Vec2::new(x.far, y.far), Vec2::new(x.size, y.size));
        let distances = corners(near, far, z);
        let mm = |y: R| y.mul_add(y, z * z);
        let inverse_mm = rsqrt(mm(y.near) * mm(y.far));
        let strip = Strip::new(x.far, &y, z, distances[1], inverse_mm);
        let straddles = x.near.lt(zero);
        let beyond = || Strip::new(-x.near, &y, z, distances[0], inverse_mm);
        let near_strip = R::where_any(straddles, Strip::default(), beyond);
        // Ω, and whether the rectangle can be sampled
        let solid_angle = window(distances, near, far, size, z);
        let some = solid_angle.gt(R::lit(1e-36)) & solid_angle.lt(R::lit(7.0)) & strip.sin.gt(zero);
        // edges that are nearly parallel have no plane
        let some = finite & some & z.gt(R::lit(1e-18)) & z_axis.max_abs().gt(R::lit(1e-3));
        let [along_u, along_v] = planes([p, u, v], vertices, side.lt(zero));
        let ([near_x, far_x], [near_y, far_y]) = (x.sorted(along_u), y.sorted(along_v));
        Self {
            base: base([&x, &y], [p, u, v], z_axis * signed, z),
            side_x: x.side,
            side_y: y.side,
            near_x: near_x.normal,
            far_x: far_x.normal,
            near_y: near_y.normal,
            far_y: far_y.normal,
            slack: Vec2::new(near_x.slack, near_y.slack),
            slack_far: Vec2::new(far_x.slack, far_y.slack),
            normal: z_axis.normalize() * side,
            near,
            far,
            size,
            height: z,
            anchor: Vec2::new(one.keep(x.anchored()), one.keep(y.anchored())),
            flip: Vec2::new(one.keep(x.flip), one.keep(y.flip)),
            strip,
            inv_sin_w1: one / strip.sin,
            near_strip,
            half: R::blend(straddles, R::lit(0.5), R::lit(2.0)),
            solid_angle: solid_angle.keep(some),
            side,
            unit: one / scale,
        }
    }
}
