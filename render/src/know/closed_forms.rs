//! Closed forms of the visible part of a light, in single and in double precision, for packets of single precision.

use super::visible::Visible;
use crate::packet::{V8, X8, widen, widen_points};
use etendue::reflection::Reflection;
use etendue::{Real, Vec3, f64x8};
use etendue_visible::{Occlusion, Precision, Solid};

/// Computes closed forms, and holds the memory for it.
#[derive(Default)]
pub(super) struct ClosedForms {
    pub(super) visible: Visible,
    /// Made when it is first needed.
    exact: Option<Box<Occlusion<f64x8>>>,
}

impl ClosedForms {
    /// What points with these normals see of a light past occluders, or reflect by a lobe: [`Occlusion::visible`] or
    /// [`Occlusion::reflected`] in the precision that the occluders need.
    pub(super) fn part(
        &mut self,
        at: [V8; 2],
        lobe: Option<&Reflection<X8>>,
        light: &Solid,
        (occluders, precision): (&[Solid], Precision),
    ) -> Option<X8> {
        if precision != Precision::Double {
            return part(&mut self.visible.one, at, lobe, light, occluders);
        }
        let (exact, lobe) = (self.exact.get_or_insert_default(), lobe.map(|lobe| lobe.map(widen)));
        let part = part(exact, at.map(widen_points), lobe.as_ref(), light, occluders)?;
        Some(X8::from(part.to_array().map(|part| part as f32)))
    }
}

#[inline]
fn part<R: Real>(
    occlusion: &mut Occlusion<R>,
    [point, normal]: [Vec3<R>; 2],
    lobe: Option<&Reflection<R>>,
    light: &Solid,
    occluders: &[Solid],
) -> Option<R> {
    match lobe {
        Some(lobe) => occlusion.reflected(point, normal, lobe, light, occluders),
        None => occlusion.visible(point, normal, light, occluders),
    }
}
