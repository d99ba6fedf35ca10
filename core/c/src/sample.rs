//! Samples.

use core::mem::size_of;
use etendue_batch::{OneSample, SampleColumns};

/// One sample of a light as seen from a shading point, or the point of a light that a ray hits.
///
/// The estimator of reflected radiance is f L cos(theta) weight, once a shadow ray along `direction` has reached `distance`.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct EtendueLightSample {
    /// Unit direction from the shading point to the light.
    pub direction: [f32; 3],
    /// Distance to the light along it, in the unit of the coordinates; FLT_MAX for lights at infinity.
    pub distance: f32,
    /// Probability density of the direction, per steradian (lines: per unit of their measure); 0 where there is no sample.
    pub pdf: f32,
    /// 1/pdf where there is a sample and the light emits towards the shading point, 0 elsewhere.
    pub weight: f32,
    /// Unit normal of the light at the sampled point. Not meaningful where the pdf is 0.
    pub normal: [f32; 3],
    /// Surface coordinates of the sampled point in [0, 1]^2, for textures: of a triangle, the barycentric coordinates of its second and
    /// third vertex. Not meaningful where the pdf is 0.
    pub uv: [f32; 2],
    /// 1 where the shading point is on the side of the light that emits, which is the side of the normal, else 0.
    pub emits: u8,
}

/// Columns of samples, each NULL or of as many elements as the batch has. The fields are those of [`EtendueLightSample`].
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueSampleColumns {
    /// Unit direction from the shading point to the light.
    pub direction: [*mut f32; 3],
    /// Distance to the light along it, in the unit of the coordinates.
    pub distance: *mut f32,
    /// Probability density of the direction, per steradian; 0 where there is no sample.
    pub pdf: *mut f32,
    /// 1/pdf where there is a sample and the light emits towards the shading point, 0 elsewhere.
    pub weight: *mut f32,
    /// Unit normal of the light at the sampled point.
    pub normal: [*mut f32; 3],
    /// Surface coordinates of the sampled point.
    pub uv: [*mut f32; 2],
    /// 1 where the shading point is on the side of the light that emits, else 0.
    pub emits: *mut u8,
}

impl EtendueSampleColumns {
    pub(crate) fn columns(&self) -> SampleColumns {
        let Self { direction, distance, pdf, weight, normal, uv, emits } = *self;
        SampleColumns { direction, distance, pdf, weight, normal, uv, emits }
    }
}

/// The fields of both samples are at the same places.
const _: () = {
    use core::mem::offset_of;
    assert!(size_of::<EtendueLightSample>() == size_of::<OneSample>());
    assert!(offset_of!(EtendueLightSample, direction) == offset_of!(OneSample, direction));
    assert!(offset_of!(EtendueLightSample, distance) == offset_of!(OneSample, distance));
    assert!(offset_of!(EtendueLightSample, pdf) == offset_of!(OneSample, pdf));
    assert!(offset_of!(EtendueLightSample, weight) == offset_of!(OneSample, weight));
    assert!(offset_of!(EtendueLightSample, normal) == offset_of!(OneSample, normal));
    assert!(offset_of!(EtendueLightSample, uv) == offset_of!(OneSample, uv));
    assert!(offset_of!(EtendueLightSample, emits) == offset_of!(OneSample, emits));
};
