//! What a batch reads and writes beside directions.

use crate::packet::{Packet, Place};
use etendue::{LightSample, Vec2, Vec3};

/// One sample of a light, or the point of a light that a direction hits, in single numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct OneSample {
    /// Unit direction from the shading point to the light.
    pub direction: Vec3<f32>,
    /// Distance to the light along it, in the unit of the coordinates.
    pub distance: f32,
    /// Probability density of the direction, per steradian (lines: see [`etendue::Line`]); 0 where there is no sample.
    pub pdf: f32,
    /// 1/pdf where there is a sample and the light emits towards the shading point, 0 elsewhere.
    pub weight: f32,
    /// Unit normal of the light at the sampled point. Not meaningful where the pdf is 0.
    pub normal: Vec3<f32>,
    /// Surface coordinates of the sampled point in [0, 1]². Not meaningful where the pdf is 0.
    pub uv: Vec2<f32>,
    /// 1 where the shading point is on the side of the light that emits, else 0.
    pub emits: u8,
}

impl OneSample {
    #[inline(always)]
    pub(crate) fn new(s: &LightSample<f32>) -> Self {
        let LightSample { direction, distance, pdf, normal, uv, emits, .. } = *s;
        Self { direction, distance, pdf, weight: s.weight(), normal, uv, emits: u8::from(emits) }
    }
}

/// Where samples go: slices of the length of the batch, or empty slices for what is not wanted. The fields are those of
/// [`etendue::LightSample`].
#[derive(Debug, Default)]
pub struct Samples<'a> {
    /// Unit direction from the shading point to the light.
    pub direction: [&'a mut [f32]; 3],
    /// Distance to the light along it, in the unit of the coordinates.
    pub distance: &'a mut [f32],
    /// Probability density of the direction, per steradian; 0 where there is no sample.
    pub pdf: &'a mut [f32],
    /// 1/pdf where there is a sample and the light emits towards the shading point, 0 elsewhere.
    pub weight: &'a mut [f32],
    /// Unit normal of the light at the sampled point.
    pub normal: [&'a mut [f32]; 3],
    /// Surface coordinates of the sampled point in [0, 1]².
    pub uv: [&'a mut [f32]; 2],
    /// 1 where the shading point is on the side of the light that emits, else 0.
    pub emits: &'a mut [u8],
}

/// [`Samples`] by pointers, each null or to as many elements as the batch has.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct SampleColumns {
    /// Unit direction from the shading point to the light: x, y and z.
    pub direction: [*mut f32; 3],
    /// Distance to the light along the direction, in the unit of the coordinates.
    pub distance: *mut f32,
    /// Probability density of the direction, per steradian; 0 where there is no sample.
    pub pdf: *mut f32,
    /// 1/pdf where there is a sample and the light emits towards the shading point, 0 elsewhere.
    pub weight: *mut f32,
    /// Unit normal of the light at the sampled point: x, y and z.
    pub normal: [*mut f32; 3],
    /// Surface coordinates of the sampled point in [0, 1]².
    pub uv: [*mut f32; 2],
    /// 1 where the shading point is on the side of the light that emits, else 0.
    pub emits: *mut u8,
}

/// The numbers of element `i`.
pub(crate) unsafe fn numbers<const N: usize>(columns: [*const f32; N], i: usize) -> [f32; N] {
    // SAFETY: the caller's columns have this element
    columns.map(|column| unsafe { column.add(i).read_unaligned() })
}
/// Writes element `i` of a column, unless it is null.
pub(crate) unsafe fn store(column: *mut f32, i: usize, number: f32) {
    if !column.is_null() {
        // SAFETY: the caller's column has this element
        unsafe { column.add(i).write_unaligned(number) };
    }
}

impl SampleColumns {
    /// True if the normal or the surface coordinates are wanted.
    #[inline(always)]
    pub(crate) fn needs_surface(&self) -> bool {
        !self.normal.iter().chain(&self.uv).all(|column| column.is_null())
    }
    /// True if any column is wanted.
    pub(crate) fn any(&self) -> bool {
        let mut others = self.direction.iter().chain([&self.distance, &self.pdf, &self.weight]);
        self.needs_surface() || !self.emits.is_null() || !others.all(|column| column.is_null())
    }
    /// Writes a sample as element `i`.
    pub(crate) unsafe fn store(&self, i: usize, s: &OneSample) {
        let Self { direction: w, normal: n, uv, .. } = self;
        let numbers = [
            (w[0], s.direction.x),
            (w[1], s.direction.y),
            (w[2], s.direction.z),
            (self.distance, s.distance),
            (self.pdf, s.pdf),
            (self.weight, s.weight),
            (n[0], s.normal.x),
            (n[1], s.normal.y),
            (n[2], s.normal.z),
            (uv[0], s.uv.x),
            (uv[1], s.uv.y),
        ];
        for (column, number) in numbers {
            // SAFETY: the caller's columns have this element
            unsafe { store(column, i, number) };
        }
        if !self.emits.is_null() {
            // SAFETY: the caller's column has this element
            unsafe { self.emits.add(i).write(s.emits) };
        }
    }
    /// Writes the samples of a packet.
    #[inline(always)]
    pub(crate) unsafe fn store_packet<R: Packet>(&self, place: Place, s: &LightSample<R>) {
        // SAFETY: the caller's
        unsafe {
            place.store3(self.direction, s.direction);
            place.store(self.distance, s.distance);
            place.store(self.pdf, s.pdf);
            place.store(self.weight, s.weight());
            // in one branch, so that the compiler moves there what only the surface needs
            if self.needs_surface() {
                place.store3(self.normal, s.normal);
                place.store(self.uv[0], s.uv.x);
                place.store(self.uv[1], s.uv.y);
            }
            place.store_mask(self.emits, s.emits);
        }
    }
    /// The columns from element `i` on.
    pub(crate) fn from(&self, i: usize) -> Self {
        Self {
            direction: self.direction.map(|column| from(column, i)),
            distance: from(self.distance, i),
            pdf: from(self.pdf, i),
            weight: from(self.weight, i),
            normal: self.normal.map(|column| from(column, i)),
            uv: self.uv.map(|column| from(column, i)),
            emits: from(self.emits, i),
        }
    }
}

impl Samples<'_> {
    #[track_caller]
    pub(crate) fn columns(self, n: usize) -> SampleColumns {
        SampleColumns {
            direction: self.direction.map(|column| pointer(column, n)),
            distance: pointer(self.distance, n),
            pdf: pointer(self.pdf, n),
            weight: pointer(self.weight, n),
            normal: self.normal.map(|column| pointer(column, n)),
            uv: self.uv.map(|column| pointer(column, n)),
            emits: pointer(self.emits, n),
        }
    }
}

/// Where what is known of directions goes: slices of the length of the batch, or empty slices for what is not wanted.
#[derive(Debug, Default)]
pub struct Evaluations<'a> {
    /// The pdf of each direction, per steradian (lines: see [`etendue::Line`]); 0 where it misses the light.
    pub pdf: &'a mut [f32],
    /// The numbers in [0, 1)² that are mapped to each direction; any where it misses the light.
    pub u: [&'a mut [f32]; 2],
    /// The nearest point of the light in each direction, with its pdf; 0 where it misses the light.
    pub hit: Samples<'a>,
}

/// [`Evaluations`] by pointers, each null or to as many elements as the batch has.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EvaluationColumns {
    /// The pdf of each direction, per steradian; 0 where it misses the light.
    pub pdf: *mut f32,
    /// The numbers in [0, 1)² that are mapped to each direction.
    pub u: [*mut f32; 2],
    /// The nearest point of the light in each direction, with its pdf.
    pub hit: SampleColumns,
}

impl EvaluationColumns {
    /// The columns from element `i` on.
    pub(crate) fn from(&self, i: usize) -> Self {
        Self { pdf: from(self.pdf, i), u: self.u.map(|column| from(column, i)), hit: self.hit.from(i) }
    }
}

impl Evaluations<'_> {
    #[track_caller]
    pub(crate) fn columns(self, n: usize) -> EvaluationColumns {
        let u = self.u.map(|column| pointer(column, n));
        EvaluationColumns { pdf: pointer(self.pdf, n), u, hit: self.hit.columns(n) }
    }
}

/// Where choices of lights go: slices of the length of the batch, or empty slices for what is not wanted.
#[derive(Debug, Default)]
pub struct Choices<'a> {
    /// Index of the light; [`etendue::select::NO_LIGHT`] where none was chosen.
    pub light: &'a mut [u32],
    /// Probability with which it was chosen; 0 where none was.
    pub pmf: &'a mut [f32],
    /// What is left of the random number: uniform in [0, 1), independent of the light.
    pub u: &'a mut [f32],
}

/// [`Choices`] by pointers, each null or to as many elements as the batch has.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct ChoiceColumns {
    /// Index of the light; 2³² − 1 where none was chosen.
    pub light: *mut u32,
    /// Probability with which it was chosen; 0 where none was.
    pub pmf: *mut f32,
    /// What is left of the random number: uniform in [0, 1), independent of the light.
    pub u: *mut f32,
}

impl Choices<'_> {
    #[track_caller]
    pub(crate) fn columns(self, n: usize) -> ChoiceColumns {
        ChoiceColumns { light: pointer(self.light, n), pmf: pointer(self.pmf, n), u: pointer(self.u, n) }
    }
}

/// Which pairs of a sequence a batch needs.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Counters {
    /// The pixel of all elements, if `pixels` is null.
    pub pixel: u32,
    /// The sample of the first element, if `samples` is null; the others follow.
    pub sample: u32,
    /// The dimension of all elements.
    pub dimension: u32,
    /// The pixel of each element, or null.
    pub pixels: *const u32,
    /// The sample of each element, or null.
    pub samples: *const u32,
}

impl Default for Counters {
    fn default() -> Self {
        Self { pixel: 0, sample: 0, dimension: 0, pixels: core::ptr::null(), samples: core::ptr::null() }
    }
}

/// A column from element `i` on.
fn from<T>(column: *mut T, i: usize) -> *mut T {
    if column.is_null() { column } else { column.wrapping_add(i) }
}

#[track_caller]
pub(crate) fn pointer<T>(column: &mut [T], n: usize) -> *mut T {
    if column.is_empty() {
        return core::ptr::null_mut();
    }
    assert!(column.len() == n, "a column of {} elements in a batch of {n}", column.len());
    column.as_mut_ptr()
}
