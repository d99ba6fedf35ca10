//! Closed forms of the visible part of a light, in single and in double precision, for packets of single precision.

use super::visible::Visible;
use crate::packet::{V8, X8, widen, widen_points};
use etendue::f64x8;
use etendue::reflection::Reflection;
use etendue_visible::{Occlusion, Solid};

/// Computes closed forms, and holds the memory for it.
#[derive(Default)]
pub(super) struct ClosedForms {
    pub(super) visible: Visible,
    /// Made when it is first needed.
    exact: Option<Box<Occlusion<f64x8>>>,
}

impl ClosedForms {
    /// As of [`Occlusion::visible`], or with a lobe of [`Occlusion::reflected`], in single precision.
    pub(super) fn part(
        &mut self,
        point: V8,
        normal: V8,
        lobe: Option<&Reflection<X8>>,
        light: &Solid,
        blockers: &[Solid],
    ) -> Option<X8> {
        let occlusion = &mut self.visible.one;
        match lobe {
            Some(lobe) => occlusion.reflected(point, normal, lobe, light, blockers),
            None => occlusion.visible(point, normal, light, blockers),
        }
    }
    /// The same in double precision.
    pub(super) fn exact_part(
        &mut self,
        point: V8,
        normal: V8,
        lobe: Option<&Reflection<X8>>,
        light: &Solid,
        blockers: &[Solid],
    ) -> Option<X8> {
        let occlusion = self.exact.get_or_insert_default();
        let (point, normal) = (widen_points(point), widen_points(normal));
        let visible = match lobe {
            Some(lobe) => occlusion.reflected(point, normal, &lobe.map(widen), light, blockers)?,
            None => occlusion.visible(point, normal, light, blockers)?,
        };
        Some(X8::from(visible.to_array().map(|part| part as f32)))
    }
}
