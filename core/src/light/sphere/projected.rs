//! Spheres by projected solid angle.

mod lune;
mod segment;

use crate::lanewise::lanewise;
use crate::light::direction::{DirectionSample, above_horizon};
use crate::light::seen::ProjectedShape;
use crate::math::{ratio, rsqrt};
use crate::real::{Real, unit_interval};
use crate::vector::double_word::dot_dw;
use crate::vector::{Frame, Vec2, Vec3};
use crate::warp::{Cone, Warp, concentric, invert_concentric};
use core::f64::consts::{FRAC_PI_2, PI};
use lune::half;
use segment::{invert_segment, segment_of};

pub(in crate::light) use segment::segment;

lanewise! {
    /// Directions from a point to a sphere above the horizon of a surface, by projected solid angle (pdf ∝ cosine to the
    /// normal): for diffuse surfaces, whose direct light from the sphere it samples without variance.
    ///
    /// [`Sphere::by_projected_solid_angle`](crate::Sphere::by_projected_solid_angle) says how.
    pub struct ProjectedCap {
        /// x horizontal, towards the axis; z the normal
        frame: Frame<R>,
        /// unit direction to the centre
        axis: Vec3<R>,
        /// the cap as a cone about `axis`
        cone: Cone<R>,
        /// sinσ
        sin_sigma: R,
        /// cosσ
        cos_sigma: R,
        /// sinω
        sin_omega: R,
        /// cosω
        cos_omega: R,
        /// sinθ, θ half the angle of the horizon that the cap covers
        sin_theta: R,
        /// cosθ = cosσ/sinω
        cos_theta: R,
        /// κ = |cosω|/sinσ, at most 1
        kappa: R,
        /// with the axis above the horizon S(θ), the part on the circle; below, the area of half the lune in the units of its slices
        part: R,
        /// with the axis above the horizon sin²σ cosω S, the part of the ellipse beyond its chord with the circle, which is not drawn; below,
        /// 1 − κ; both accurate relative to their own size
        rest: R,
        /// Ω⊥ in steradians
        projected: R,
        /// x of the centre in the frame, in units of `unit`
        along_x: R,
        /// z of the centre in the frame, in units of `unit`
        along_z: R,
        /// d, the distance of the centre, in units of `unit`
        distance: R,
        /// d²−R², in units of `unit`²
        power: R,
        /// how far the sphere reaches across the horizon, in units of `unit`: 0 where it touches, negative where it is clear
        margin: R,
        /// unit of the lengths above, a power of two
        unit: R,
    }
}

/// Returns 1/|n|, and r|n| − |c·n|, which is how far the sphere reaches across the horizon. The second parameter of these, `height`, is c·n
/// as an unevaluated sum, so that the difference is accurate relative to its own size.
#[inline(always)]
fn tangent_distance<R: Real>(r: R, n: Vec3<R>, [height, rest]: [R; 2]) -> (R, R) {
    let [squared, more] = dot_dw(n, n);
    let shrink = rsqrt(squared);
    let length = squared * shrink;
    let again = length * length;
    let off = (squared - again) - (R::two_prod_error(length, length, again) - more);
    let length_rest = off * (R::lit(0.5) * shrink);
    let reach = r * length;
    let reach_rest = r.mul_add(length_rest, R::two_prod_error(r, length, reach));
    let distance = (reach - height.abs()) + (reach_rest - rest.negate_where(height.lt(R::lit(0.0))));
    // one step of Newton's method rounds 1/|n| once
    let product = shrink * length;
    let off = (R::lit(1.0) - product) - shrink.mul_add(length_rest, R::two_prod_error(shrink, length, product));
    (shrink.mul_add(off, shrink), distance)
}

/// A sphere in the frame of a surface, whose x axis points towards the sphere along the horizon and whose z axis is the normal: where its
/// centre is, how far it reaches across the horizon, and whether the normal has a direction.
struct Upright<R: Real> {
    frame: Frame<R>,
    along_x: R,
    along_z: R,
    margin: R,
    directed: R::Mask,
}

impl<R: Real> Upright<R> {
    #[inline(always)]
    fn new(c: Vec3<R>, r: R, normal: Vec3<R>) -> Self {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        // at any scale
        let normal = normal * normal.max_abs().pow2_scale();
        let flat = normal.max_abs().le(zero);
        let normal = Vec3::new(normal.x, normal.y, R::blend(flat, one, normal.z));
        let [height, rest] = dot_dw(c, normal);
        let (height, rest) = height.two_sum(rest);
        let (shrink, margin) = tangent_distance(r, normal, [height, rest]);
        // y axis: horizontal, perpendicular to the plane of normal and axis, before the normal is rounded
        let across = normal.cross(c);
        let normal = normal * shrink;
        let width_squared = across.length_squared();
        let oblique = width_squared.gt(R::lit(1e-36));
        let inverse_width = rsqrt(R::blend(oblique, width_squared, one));
        let t = Vec3::blend(oblique, across * inverse_width, Frame::new(normal).t);
        let side = t.cross(normal);
        let s = side.mul_add(R::lit(0.5) * (one - side.length_squared()), side);
        Self {
            frame: Frame { s, t, n: normal },
            along_x: (width_squared * inverse_width * shrink).keep(oblique),
            along_z: height * shrink,
            margin: margin * shrink,
            directed: shrink.gt(zero),
        }
    }
}

/// The angles of a cap, which have the names that [`ProjectedCap`] gives them, and whether the cap is whole. Seen from inside the sphere, the
/// cap is the hemisphere about the normal.
struct Angles<R: Real> {
    sin_sigma: R,
    cos_sigma: R,
    sin_omega: R,
    cos_omega: R,
    sin_theta: R,
    cos_theta: R,
    kappa: R,
    whole: R::Mask,
}

impl<R: Real> Angles<R> {
    /// Computes the angles of a sphere with the radius `r` at the distance d: `power` is d² − r², and `inverse` is 1/d.
    #[inline(always)]
    fn new(at: &Upright<R>, [r, power, inverse]: [R; 3], outside: R::Mask) -> Self {
        let (zero, one, &Upright { along_x, along_z, margin, .. }) = (R::lit(0.0), R::lit(1.0), at);
        let pick = |yes: R, no: f64| R::blend(outside, yes, R::lit(no));
        let reciprocal = |square: R| rsqrt(R::blend(square.gt(zero), square, one));
        let by_radius = reciprocal(r.mul_add(r, power.greater(zero)));
        let cos_sigma = pick((power.greater(zero).sqrt() * by_radius).lesser(one), 0.0);
        let by_height = reciprocal(along_x.mul_add(along_x, along_z * along_z));
        let height_squared = (margin * (r + along_z.abs())).greater(zero) * inverse * inverse;
        let height_squared = height_squared.keep(outside);
        // sin²ω = y² + cos²σ
        let by_sin_omega = reciprocal(cos_sigma.mul_add(cos_sigma, height_squared));
        Self {
            sin_sigma: pick((r.greater(zero) * by_radius).lesser(one), 1.0),
            cos_sigma,
            sin_omega: pick((along_x * by_height).lesser(one), 0.0),
            cos_omega: pick((along_z * by_height).clamped(-one, one), 1.0),
            sin_theta: height_squared.sqrt() * by_sin_omega,
            cos_theta: R::blend(height_squared.gt(zero), cos_sigma * by_sin_omega, one),
            kappa: ratio(along_z.abs(), r).lesser(one),
            whole: !outside | (margin.le(zero) & along_z.ge(zero)),
        }
    }
    /// Computes `part`, `rest` and `projected` of the cap, if the sphere has the radius `r` and reaches across the horizon by `margin`.
    #[inline(always)]
    fn areas(&self, margin: R, r: R) -> [R; 3] {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let &Self { sin_sigma, cos_omega, sin_theta, cos_theta, kappa, whole, .. } = self;
        let area = sin_sigma * sin_sigma * cos_omega;
        let near = kappa * cos_theta;
        let over = cos_omega.ge(zero);
        let cut = R::where_any(over & !whole, [zero, zero, R::lit(PI) * area], || {
            let part = segment_of(sin_theta, cos_theta);
            let on_ellipse = segment_of(ratio(sin_theta, sin_sigma).lesser(one), near);
            [part, area * on_ellipse, part + area * (R::lit(PI) - on_ellipse)]
        });
        R::where_any(!over, cut, || {
            let lune = half(cos_theta, near);
            let spread = ratio(margin, r).clamped(zero, one);
            [lune, spread, R::lit(2.0) * sin_theta * sin_theta * sin_theta * spread * lune]
        })
    }
}

impl<R: Real> ProjectedCap<R> {
    /// Prepares for a sphere with its centre at `center` relative to the point (both lengths in one unit), on a surface with
    /// the normal `normal` (of any length).
    #[inline(always)]
    pub fn new(center: Vec3<R>, radius: R, normal: Vec3<R>) -> Self {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        // a difference has overflowed: nothing is visible
        let finite = center.is_within(R::lit(f64::INFINITY)) & radius.abs().lt(R::lit(f64::INFINITY));
        let (center, radius) = (center.keep(finite), radius.keep(finite));
        let scale = center.max_abs().greater(radius.abs()).pow2_scale();
        let (c, r) = (center * scale, radius * scale);
        let power = c.length_squared_minus_square(r);
        let squared = c.length_squared();
        let some = squared.gt(zero);
        let inverse = rsqrt(R::blend(some, squared, one)).keep(some);
        let outside = power.ge(zero) & some;
        let at = Upright::new(c, r, normal);
        let angles = Angles::new(&at, [r, power, inverse], outside);
        let [part, rest, projected] = angles.areas(at.margin, r);
        // nothing where the centre is no number, or the normal has no direction
        let some_sphere = r.gt(zero) & squared.ge(zero) & at.directed;
        let visible = (angles.whole | at.margin.gt(zero)) & some_sphere;
        let axis = c * inverse;
        let Angles { sin_sigma, cos_sigma, sin_omega, cos_omega, sin_theta, cos_theta, kappa, .. } = angles;
        let one_minus_cos = R::blend(outside, sin_sigma * sin_sigma / (one + cos_sigma), R::lit(2.0));
        Self {
            frame: at.frame,
            axis: Vec3::new(axis.x, axis.y, R::blend(some, axis.z, one)),
            cone: Cone { one_minus_cos: one_minus_cos.keep(some_sphere) },
            sin_sigma,
            cos_sigma,
            sin_omega,
            cos_omega,
            sin_theta,
            cos_theta,
            kappa,
            part,
            rest,
            projected: projected.keep(visible),
            along_x: at.along_x,
            along_z: at.along_z,
            distance: squared * inverse,
            power,
            margin: R::blend(outside, at.margin, -one),
            unit: one / scale,
        }
    }

    /// True where the point lies strictly inside the sphere and so sees its inner side.
    #[inline(always)]
    pub fn inside(&self) -> R::Mask {
        self.power.lt(R::lit(0.0))
    }

    #[inline(always)]
    fn whole(&self) -> R::Mask {
        self.margin.le(R::lit(0.0)) & self.cos_omega.ge(R::lit(0.0))
    }

    /// 1 − sinω cosσ, where sinω cosσ is the centre of the ellipse.
    #[inline(always)]
    fn one_minus_centre(&self) -> R {
        let one = R::lit(1.0);
        self.cos_omega * self.cos_omega / (one + self.sin_omega) + self.sin_omega * self.one_minus_cos_sigma()
    }
    #[inline(always)]
    fn one_minus_cos_sigma(&self) -> R {
        self.sin_sigma * self.sin_sigma / (R::lit(1.0) + self.cos_sigma)
    }

    /// Maps `u` to a direction in the local frame and, from outside, (cosine to the axis) − cosσ.
    #[inline(always)]
    fn local(&self, u: Vec2<R>) -> (Vec3<R>, R) {
        let whole = self.whole();
        let below = self.cos_omega.lt(R::lit(0.0));
        let all = R::where_any(whole, (Vec3::default(), R::lit(0.0)), || self.ellipse(u));
        let all = R::where_any(!whole & !below, all, || self.slices(u));
        R::where_any(below, all, || self.lune(u))
    }

    /// The whole cap: the concentric disk.
    #[inline(always)]
    fn ellipse(&self, u: Vec2<R>) -> (Vec3<R>, R) {
        let (zero, one) = (R::lit(0.0), R::lit(1.0));
        let (r, turned) = concentric(u);
        let disk = turned * r;
        let rest = (one - r.abs()) * (one + r.abs());
        self.over_the_ellipse(disk.x, self.sin_sigma * disk.y, (self.sin_sigma * self.sin_sigma * rest).greater(zero))
    }
    /// The point at x on the ellipse's disk and at height y: on its rim or, where `inward` (the square of the rim's y − y²) is
    /// positive, inside it.
    ///
    /// At the same x, the rim has z = cosω cosσ − sinω sinσ x; inside, z² exceeds the square of that by `inward`.
    #[inline(always)]
    fn over_the_ellipse(&self, x: R, y: R, inward: R) -> (Vec3<R>, R) {
        let zero = R::lit(0.0);
        let rim = (self.cos_omega * self.cos_sigma - self.sin_omega * self.sin_sigma * x).greater(zero);
        let z = rim.mul_add(rim, inward).sqrt();
        let point = (self.sin_sigma * self.cos_omega).mul_add(x, self.sin_omega * self.cos_sigma);
        (Vec3::new(point, y, z), self.cos_omega * ratio(inward, z + rim))
    }

    /// The slice at u₀ of a cap cut with its axis above the horizon: whether it ends on the circle rather than on the ellipse, and
    /// the sine and cosine of φ, from the right on the circle and from the left on the ellipse.
    #[inline(always)]
    fn cut_slice(&self, u: R) -> (R::Mask, R, R) {
        let one = R::lit(1.0);
        let area = self.sin_sigma * self.sin_sigma * self.cos_omega;
        let from_right = u * self.projected;
        let on_circle = from_right.lt(self.part);
        // on the ellipse, the area from its nearer end: from the right, the part beyond the chord and what is drawn of the rest, in this
        // order, as a thin ellipse is less than the rounding of the circle's part
        let (from_left, from_end) = ((one - u) * self.projected, (from_right - self.part) + self.rest);
        let late = from_end.lt(from_left) & !on_circle;
        let share = R::blend(on_circle, from_right, ratio(from_left.lesser(from_end), area)).lesser(R::lit(FRAC_PI_2));
        let (s, c) = invert_segment(share);
        (on_circle, s, c.negate_where(late))
    }
    /// The cap cut with its axis above the horizon: two circular segments.
    #[inline]
    fn slices(&self, u: Vec2<R>) -> (Vec3<R>, R) {
        let (zero, one, two) = (R::lit(0.0), R::lit(1.0), R::lit(2.0));
        let (on_circle, s, c) = self.cut_slice(u.x);
        let v = two.mul_add(u.y, -one);
        let inward = (R::lit(4.0) * u.y * (one - u.y)).greater(zero);
        // on the circle: x = cosφ, |y| ≤ sinφ
        let circle = Vec3::new(c, s * v, s * inward.sqrt());
        let versine = s * s / (one + c.greater(zero));
        let lift = self.cos_omega * self.cos_omega / (one + self.sin_omega);
        let (dx, dz) = (lift - versine, circle.z - self.cos_omega);
        let moved = R::lit(0.5) * dx.mul_add(dx, circle.y.mul_add(circle.y, dz * dz));
        let near = (self.one_minus_cos_sigma() - moved).greater(zero);
        let high = self.sin_sigma * s;
        let (ellipse, far) = self.over_the_ellipse(-c, high * v, high * high * inward);
        (Vec3::blend(on_circle, circle, ellipse), R::blend(on_circle, near, far))
    }
}

impl<R: Real> ProjectedShape<R> for ProjectedCap<R> {
    #[inline(always)]
    fn sample_direction(&self, u: Vec2<R>) -> DirectionSample<R> {
        let zero = R::lit(0.0);
        let (w, beyond) = self.local(u);
        // from outside: with δ = cos∠(w, axis) − cosσ, R² − d² sin² = d² δ (2cosσ + δ)
        let cos = self.cos_sigma + beyond;
        let across = (beyond * (self.cos_sigma + cos)).greater(zero).sqrt();
        let near = self.distance * self.cos_sigma * ratio(self.cos_sigma, cos + across);
        let along = w.x.mul_add(self.along_x, w.z * self.along_z);
        let root = (along * along - self.power).greater(zero).sqrt();
        let far = R::blend(along.lt(zero), ratio(-self.power, root - along), root + along);
        let most = R::lit(f64::from(f32::MAX));
        let distance = (R::blend(self.inside(), far, near) * self.unit).lesser(most);
        DirectionSample { direction: above_horizon(self.frame.to_world(w), self.frame.n), distance }
    }
    #[inline(always)]
    fn projected_solid_angle(&self) -> R {
        self.projected
    }
    #[inline(always)]
    fn pdf_at_cosine(&self, cos: R) -> R {
        // a subnormal Ω⊥ has no finite reciprocal
        let some = self.projected.gt(R::lit(1e-37));
        (cos.greater(R::lit(0.0)) / R::blend(some, self.projected, R::lit(1.0))).keep(some)
    }
    #[inline(always)]
    fn contains(&self, w: Vec3<R>) -> R::Mask {
        let moved = (w - self.axis).length_squared() * R::lit(0.5);
        self.cone.contains_turned(moved) | self.inside()
    }
    #[inline(always)]
    fn in_front(&self) -> R::Mask {
        !self.inside()
    }
}

impl<R: Real> Warp<R> for ProjectedCap<R> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        above_horizon(self.frame.to_world(self.local(u).0), self.frame.n)
    }
    /// The pdf per steradian; 0 for a direction that misses the sphere or lies below the horizon.
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        self.pdf_at_cosine(w.dot(self.frame.n)).keep(self.contains(w))
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let (zero, one, half) = (R::lit(0.0), R::lit(1.0), R::lit(0.5));
        let w = self.frame.to_local(w);
        let z = w.z.greater(zero);
        let whole = self.whole();
        let below = self.cos_omega.lt(zero);
        // near the horizon, z determines the position across better than x does
        let round = w.y.mul_add(w.y, z * z);
        let off_centre = R::blend(
            w.x.gt(half),
            self.one_minus_centre() - round / (one + w.x.abs()),
            w.x - self.sin_omega * self.cos_sigma,
        );
        let across = ratio(off_centre, self.sin_sigma * self.cos_omega);
        let u = R::where_any(whole, Vec2::default(), || {
            let p = Vec2::new(across, ratio(w.y, self.sin_sigma));
            // near the limb of a large cap, z determines the distance from the axis better than x and y do
            let rim = (self.cos_omega * self.cos_sigma - self.sin_omega * self.sin_sigma * across).greater(zero);
            let rest = (z - rim) * (z + rim) / (self.sin_sigma * self.sin_sigma).greater(R::lit(1e-37));
            let r = R::blend(z.le(self.sin_sigma) & rest.lt(half), (one - rest).greater(zero).sqrt(), p.length());
            invert_concentric(p, r.lesser(one))
        });
        let u = R::where_any(!whole & !below, u, || {
            let area = self.sin_sigma * self.sin_sigma * self.cos_omega;
            let span = round.sqrt();
            let in_segment = segment_of(span.lesser(one), w.x.clamped(zero, one));
            // of x and the span, the one that changes faster tells on which side of the chord the point is
            let near_side = R::blend(w.x.gt(half), self.sin_theta - span, w.x - self.cos_theta);
            let on_circle = near_side.ge(zero);
            let c = (-across).clamped(-one, one);
            // sinφ from y, and from the height of z above the rim at the same x
            let rim = (self.cos_omega * self.cos_sigma + self.sin_omega * self.sin_sigma * c).greater(zero);
            let s = (w.y.mul_add(w.y, ((z - rim) * (z + rim)).greater(zero)).sqrt() / self.sin_sigma).lesser(one);
            let from_end = segment_of(s, c.abs()) * area;
            let from_chord = (from_end - self.rest).greater(zero);
            let on_ellipse = R::blend(c.lt(zero), self.part + from_chord, self.projected - from_end);
            let from_right = R::blend(on_circle, in_segment, on_ellipse);
            let high = R::blend(on_circle, span, self.sin_sigma * s);
            let x = unit_interval(ratio(from_right, self.projected));
            // u₀ ends before 1, at a slice that may be far from the end of a thin ellipse
            let last = x.ge(R::ONE_MINUS_EPSILON) & !on_circle;
            let high = R::where_any(last, high, || {
                let (circle, s, _) = self.cut_slice(x);
                R::blend(circle, s, self.sin_sigma * s)
            });
            Vec2 { x, y: unit_interval(half.mul_add(ratio(w.y, high), half)) }
        });
        R::where_any(below, u, || self.invert_in_lune(w).map(unit_interval))
    }
}
