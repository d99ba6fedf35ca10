//! What a way to choose a light is.

use crate::lights::LightRecord;
use crate::packet::{V8, X8};
use etendue::select::{Choice, Gloss, LightBound};
use rayon::prelude::*;

/// A way to choose a light at the shading points of a packet.
pub(super) trait ChooseLight {
    /// The choice at some points.
    type At<'a>
    where
        Self: 'a;
    /// Prepares the choice at points `p` of surfaces with these unit normals, in view of what glossy ones reflect.
    fn at(&self, p: V8, normal: V8, gloss: Option<&Gloss<X8>>) -> Self::At<'_>;
    /// Chooses by the first number, and by the digits of the second among many lights. Where no light can contribute, the pmf is 0, but the
    /// index is valid. What is left of the first number is as good as new.
    fn choose(at: &Self::At<'_>, numbers: [X8; 2]) -> Choice<X8>;
    /// The pmf with which a light is chosen: the same bits, and greater than 0 wherever it can contribute.
    fn pmf(at: &Self::At<'_>, light: u32) -> X8;
}

/// Bounds of lights. Their powers are relative to the greatest, so that all are finite; lights infinitely far away have none.
pub(super) fn bounds(all: &[LightRecord]) -> Vec<LightBound> {
    let greatest = all.iter().fold(f64::MIN_POSITIVE, |most, light| most.max(light.power));
    all.par_iter().map(|light| light.bound(light.power / greatest)).collect()
}
