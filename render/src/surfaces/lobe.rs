//! What is nearly the light that rough surfaces reflect, with closed forms: the fit of a metal's or a coat's BSDF.

use crate::packet::{M8, V8, X8};
use etendue::reflection::Reflection;
use etendue::select::Gloss;
use etendue::{Real, Warp};
use std::f64::consts::FRAC_1_PI;

/// The fit of the BSDFs of eight surfaces: f cosθ is about `specular` times the pdf of the reflection, and `diffuse` · cosθ/π.
#[derive(Clone, Copy)]
pub struct Lobe {
    /// Lanes of rough surfaces that have such a fit. The others have none of the numbers below.
    pub lanes: M8,
    /// The lobe of the microsurface.
    pub reflection: Reflection<X8>,
    /// The part of light from all directions alike that the microsurface reflects, per channel.
    pub specular: V8,
    /// The part that a diffuse surface below a coat reflects, per channel.
    pub diffuse: V8,
    /// Lanes with such a surface.
    pub coats: M8,
}

/// The mean of Schlick's weight (1 − v·m)⁵ over light by the cosine, for a view with this cosine: 2.6e−2 at the horizon, 8e−5 above. To 9e−6.
#[inline]
pub fn schlick_of_diffuse(cos: X8) -> X8 {
    let x = X8::lit(1.0) - cos.greater(X8::lit(0.0)).lesser(X8::lit(1.0));
    [8.995_495e-3, 7.723_49e-3, 9.349_493e-3, 2.013_267e-3, 8.256_414e-5]
        .into_iter()
        .fold(X8::lit(0.0), |sum, coefficient| sum.mul_add(x, X8::lit(coefficient)))
}

/// The cosine c with (1 − c)⁵ = `weight`, in [0, 1], to 1e−3: the one that has the mean Fresnel factor.
#[inline]
pub fn cosine_of_schlick(weight: X8) -> X8 {
    let one = X8::lit(1.0);
    let weight = weight.greater(X8::lit(1e-15)).lesser(one);
    // Newton's method for the fifth root, from the power 3/16, which is a little above it
    let eighth = weight.sqrt().sqrt().sqrt();
    let mut root = eighth * eighth.sqrt();
    for _ in 0..4 {
        let square = root * root;
        root = X8::lit(0.8).mul_add(root, X8::lit(0.2) * weight / (square * square));
    }
    (one - root).greater(X8::lit(0.0)).lesser(one)
}

/// The least albedo of the diffuse part in a choice of lights, which makes up for what the fit lacks far from the lobe.
const LEAST_DIFFUSE: f64 = 1e-3;

impl Lobe {
    /// What the choice of lights depends on; other lanes than those with a fit are diffuse.
    #[inline]
    pub fn gloss(&self) -> Gloss<X8> {
        let most = |v: V8| v.x.greater(v.y).greater(v.z);
        let diffuse = most(self.diffuse).greater(X8::lit(LEAST_DIFFUSE));
        Gloss::new(
            Real::blend(self.lanes, diffuse, X8::lit(1.0)),
            most(self.specular).keep(self.lanes),
            &self.reflection,
        )
    }
    /// Lanes with a rough metal, which reflects nothing but the lobe.
    #[inline]
    pub fn metals(&self) -> M8 {
        self.lanes & !self.coats
    }
    /// The fit of f cosθ in the unit direction `w`, per steradian, below the cosine `cos` to the normal.
    #[inline]
    pub fn evaluate(&self, w: V8, cos: X8) -> V8 {
        let cosine = (cos.greater(X8::lit(0.0)) * X8::lit(FRAC_1_PI)).keep(self.coats);
        self.diffuse.mul_add(cosine, self.specular * self.reflection.pdf(w).keep(self.lanes))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_and_means_are_those_of_double_precision() {
        for i in 0..=100 {
            let cos = f64::from(i) / 100.0;
            let weight = (1.0 - cos).powi(5);
            let found = f64::from(cosine_of_schlick(X8::splat(weight as f32)).lane(2));
            assert!((found - cos).abs() < 2e-3, "{cos}: {found}");
            // Malley's map of a grid
            let (side, view) = (200, [(1.0 - cos * cos).sqrt(), cos]);
            let mut sum = 0.0;
            for k in 0..side * side {
                let [u, v] = [k / side, k % side].map(|i| (f64::from(i) + 0.5) / f64::from(side));
                let w = [u.sqrt() * libm::cos(std::f64::consts::TAU * v), (1.0 - u).sqrt()];
                let half = (0.5 * (1.0 + view[0] * w[0] + view[1] * w[1])).max(0.0).sqrt();
                sum += (1.0 - half).powi(5);
            }
            let mean = sum / f64::from(side * side);
            let found = f64::from(schlick_of_diffuse(X8::splat(cos as f32)).lane(5));
            assert!((found - mean).abs() < 2e-5, "{cos}: {found}, not {mean}");
        }
    }
}
