//! Cones of directions, hemispheres and spheres, uniform in solid angle.

use super::Warp;
use crate::lanewise::lanewise;
use crate::math::atan2_turns;
use crate::real::{Mask, Real, unit_interval};
use crate::vector::{Frame, Vec2, Vec3};

const INV_TWO_PI: f64 = 0.5 / core::f64::consts::PI;
/// Angle by which rounding may move a direction out of its cone: 4 ulp of a component near 1.
const CONE_SLACK: f64 = 4.0 / 16_777_216.0;
/// Bound of what rounding, and the slack, add to 1−cosθ as the axis alone gives it.
const BESIDE_LIMB: f64 = 64.0 / 16_777_216.0;

lanewise! {
    /// Directions within an angle σ of +z, uniform in solid angle: for suns, spheres and anything else that looks like a cap.
    ///
    /// Set `one_minus_cos` to 1 − cosσ, then call `sample`, `pdf` or `invert`. An empty cone has pdf 0 and samples +z.
    ///
    /// - Formula, with h = 1−cosσ: 1−cosθ = u₀h, sinθ = √(u₀h · ((2−h) + h(1−u₀))), φ = 2πu₁. No term cancels, whatever σ, not
    ///   even near the far pole.
    /// - Domain: u in [0, 1)²; h in [0, 2], clamped to it.
    /// - Density: the pdf is 1/(2πh) per steradian within σ (and within 4 ulp beyond, so that no sample falls out by rounding),
    ///   0 elsewhere.
    /// - Degenerate input: h = 0 gives +z and pdf 0.
    /// - Greatest error: pdf 1.2e−7 relative, direction 1.8e−7 of the cone's width, at every size (proved for all u and h ≥ 1e−30: pdf
    ///   1.7e−7, direction 4e−7 of the width across the axis and 1.3e−7 along it).
    /// - Source: the inverse of the cap's distribution function, in terms of 1−cosθ.
    pub struct Cone {
        /// h = 1 − cosσ, where σ is the half-angle of the cone: in [0, 2], clamped to it.
        pub one_minus_cos: R,
    }
}

impl<R: Real> Cone<R> {
    /// h clamped to [0, 2]; NaN counts as 0.
    #[inline(always)]
    fn height(&self) -> R {
        self.one_minus_cos.clamped(R::lit(0.0), R::lit(2.0))
    }
    /// Solid angle 2πh in steradians.
    #[inline(always)]
    pub fn solid_angle(&self) -> R {
        R::lit(2.0 * core::f64::consts::PI) * self.height()
    }
    /// The pdf per steradian of every direction inside, 1/(2πh); 0 for an empty cone.
    #[inline(always)]
    pub fn uniform_pdf(&self) -> R {
        let h = self.height();
        // a subnormal h has no finite reciprocal
        let some = h.gt(R::lit(1e-37));
        (R::lit(INV_TWO_PI) / R::blend(some, h, R::lit(1.0))).keep(some)
    }
    /// Tells whether the cone contains a direction whose angle θ from the axis has 1 − cosθ = `one_minus_cos`; allows for the
    /// rounding of the direction.
    #[inline(always)]
    pub fn contains(&self, one_minus_cos: R) -> R::Mask {
        self.contains_but_for(one_minus_cos, CONE_SLACK)
    }
    #[inline(always)]
    fn contains_but_for(&self, one_minus_cos: R, slack: f64) -> R::Mask {
        let h = self.height();
        // 1−cos(σ + ε) = h + ε sinσ + ½ε² cosσ + …
        let sin = (h * (R::lit(2.0) - h)).sqrt();
        // behind, 1−cos is computed as 1−z, whose rounding counts
        let slack = R::lit(slack).mul_add(sin.greater(h - R::lit(1.0)), R::lit(0.5 * slack * slack));
        one_minus_cos.le(h + slack)
    }
    /// [`contains`](Self::contains) for a direction that has been rotated into a frame and back: allows for 10 ulp.
    #[inline(always)]
    pub(crate) fn contains_turned(&self, one_minus_cos: R) -> R::Mask {
        self.contains_but_for(one_minus_cos, 2.5 * CONE_SLACK)
    }
    /// The pdf per steradian of a direction that has been rotated into a frame and back.
    #[inline(always)]
    pub(crate) fn pdf_in_frame(&self, frame: &Frame<R>, w: Vec3<R>) -> R {
        // the axis alone decides, unless the direction is beside the limb
        let beyond = R::lit(1.0) - w.dot(frame.n) - self.height();
        let beside = beyond.abs().le(R::lit(BESIDE_LIMB));
        let pdf = self.uniform_pdf();
        let exactly = || pdf.keep(self.contains_turned(one_minus_z(frame.to_local(w))));
        R::where_any(beside, pdf.keep(beyond.lt(R::lit(0.0))), exactly)
    }
}

/// 1−cosθ for the angle θ between a unit vector and +z: from the distance to the axis in front, and from z elsewhere, where a
/// rounded length matters less.
#[inline(always)]
fn one_minus_z<R: Real>(w: Vec3<R>) -> R {
    let one = R::lit(1.0);
    let front = w.x.mul_add(w.x, w.y * w.y) / (one + w.z.abs());
    R::blend(w.z.gt(R::lit(0.5)), front, one - w.z)
}

impl<R: Real> Warp<R> for Cone<R> {
    type Point = Vec3<R>;
    #[inline(always)]
    fn sample(&self, u: Vec2<R>) -> Vec3<R> {
        let h = self.height();
        let k = u.x * h;
        // 2 − k without cancellation: both terms are ≥ 0, and 2−h is exact where h is near 2
        let rest = h.mul_add(R::lit(1.0) - u.x, R::lit(2.0) - h);
        let sin = (k * rest).greater(R::lit(0.0)).sqrt();
        let (s, c) = u.y.sin_cos_turns();
        Vec3::new(sin * c, sin * s, R::lit(1.0) - k)
    }
    /// The pdf per steradian; 0 outside the cone.
    #[inline(always)]
    fn pdf(&self, w: Vec3<R>) -> R {
        self.uniform_pdf().keep(self.contains(one_minus_z(w)))
    }
    #[inline(always)]
    fn invert(&self, w: Vec3<R>) -> Vec2<R> {
        let h = self.height();
        let u = one_minus_z(w) / R::blend(h.gt(R::lit(0.0)), h, R::lit(1.0));
        Vec2 { x: unit_interval(u), y: atan2_turns(w.y, w.x) }
    }
}

macro_rules! whole_cone {
    ($(#[$doc:meta])* $name:ident, $h:literal) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default)]
        pub struct $name;
        impl<R: Real> Warp<R> for $name {
            type Point = Vec3<R>;
            #[inline(always)]
            fn sample(&self, u: Vec2<R>) -> Vec3<R> {
                Cone { one_minus_cos: R::lit($h) }.sample(u)
            }
            /// The pdf per steradian.
            #[inline(always)]
            fn pdf(&self, w: Vec3<R>) -> R {
                // the whole sphere holds every direction; the hemisphere ends at the horizon, exactly
                let inside = w.z.ge(R::lit(0.0)) | R::Mask::splat($h > 1.5);
                R::lit(INV_TWO_PI / $h).keep(inside)
            }
            #[inline(always)]
            fn invert(&self, w: Vec3<R>) -> Vec2<R> {
                Cone { one_minus_cos: R::lit($h) }.invert(w)
            }
        }
    };
}
whole_cone!(
    /// Directions with z ≥ 0, uniform in solid angle: a baseline for surfaces without a better technique.
    ///
    /// Call `UniformHemisphere.sample(u)`; there is nothing to set up and no degenerate input.
    ///
    /// - Formula: the [`Cone`] with h = 1: z = 1−u₀, sinθ = √(u₀(2−u₀)), φ = 2πu₁.
    /// - Domain: u in [0, 1)²; samples never fall below the horizon.
    /// - Density: the pdf is 1/(2π) per steradian for z ≥ 0, else 0.
    /// - Greatest error: 1.5e−7 in the direction.
    UniformHemisphere,
    1.0
);
whole_cone!(
    /// Directions of the whole sphere, uniform in solid angle: for constant environments.
    ///
    /// Call `UniformSphere.sample(u)`; there is nothing to set up and no degenerate input.
    ///
    /// - Formula: the [`Cone`] with h = 2: z = 1−2u₀, sinθ = 2√(u₀(1−u₀)), φ = 2πu₁; nothing cancels near the poles.
    /// - Domain: u in [0, 1)².
    /// - Density: the pdf is 1/(4π) per steradian.
    /// - Greatest error: 1.5e−7 in the direction.
    UniformSphere,
    2.0
);
