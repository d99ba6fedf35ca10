//! What closed forms leave to be sampled.

use crate::allocation::FEW;
use crate::bvh::GROUP;
use crate::estimate::{Integrand, Points, Proof};
use crate::packet::{M8, V8, X8};
use etendue::{Mask, Real, u32x8};

/// What is left of the light of a group of shading points, for each light and packet.
pub(super) struct Left {
    /// Lanes in which the light remains, whole or in part.
    pub(super) remaining: Vec<[M8; GROUP]>,
    /// The part of it that has been counted as visible, if lights have such parts.
    pub(super) parts: Option<Vec<[X8; GROUP]>>,
    /// What is proved of it where rough surfaces have a fit.
    pub(super) proofs: Vec<[Proof; GROUP]>,
}

impl Left {
    /// For up to [`FEW`] lights, with or without parts.
    pub(super) fn new(has_parts: bool) -> Self {
        Self {
            remaining: vec![[M8::splat(false); GROUP]; FEW],
            parts: has_parts.then(|| vec![[X8::lit(0.0); GROUP]; FEW]),
            proofs: vec![[Proof::default(); GROUP]; FEW],
        }
    }
}

/// The integrand that closed forms leave. Estimators add its integral to what closed forms have added, so that the sum is all of the light:
/// a light that does not remain has been added whole; where a fit was integrated, f cosθ counts less the fit; and where a part of a light
/// was added, its visibility counts less that part.
pub(super) struct Residual<'a> {
    pub(super) left: &'a Left,
    pub(super) points: &'a Points,
    /// Whether no light remains.
    pub(super) is_empty: bool,
}

impl Integrand for Residual<'_> {
    #[inline(always)]
    fn remaining(&self) -> Option<&[[M8; GROUP]]> {
        Some(&self.left.remaining)
    }
    #[inline(always)]
    fn is_empty(&self) -> bool {
        self.is_empty
    }
    #[inline]
    fn proof(&self, packet: usize, lights: u32x8) -> Option<Proof> {
        if self.points.lobes[packet].is_none() || !self.points.places[packet].fitted.any() {
            return None;
        }
        let mut all = Proof::default();
        for (lane, &light) in lights.as_array().iter().enumerate() {
            let Some(of) = self.left.proofs.get(light as usize) else { continue };
            let (lane, Proof { fitted, lit, dark }) = (M8::from_bits(1 << lane), of[packet]);
            all.fitted = all.fitted | fitted & lane;
            all.lit = all.lit | lit & lane;
            all.dark = all.dark | dark & lane;
        }
        Some(all)
    }
    #[inline]
    fn fit(&self, packet: usize, w: V8, cos: X8) -> V8 {
        self.points.lobes[packet].as_ref().map_or(V8::default(), |lobe| lobe.evaluate(w, cos))
    }
    #[inline(always)]
    fn part(&self, packet: usize, lights: u32x8) -> Option<X8> {
        let parts = self.left.parts.as_ref()?;
        let lights = lights.as_array();
        Some(X8::from_fn(|lane| parts.get(lights[lane] as usize).map_or(0.0, |of| of[packet].lane(lane))))
    }
}
