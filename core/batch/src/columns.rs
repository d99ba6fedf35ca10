//! What a batch reads and writes beside directions.

use crate::packet::{Packet, PacketSpan};
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

/// Where results go, by slices and by pointers: of a field there is one column, an array of columns, or a struct of them.
macro_rules! results {
    ($($(#[$doc:meta])* $name:ident, $columns:ident {
        $($(#[$field_doc:meta])* $field:ident: $([$n:literal])? $kind:ident,)+
    })+) => {$(
        $(#[$doc])*
        #[derive(Debug, Default)]
        pub struct $name<'a> {
            $($(#[$field_doc])* pub $field: results!(slice $([$n])? $kind 'a),)+
        }
        #[doc = concat!("[`", stringify!($name), "`] by pointers, each null or to as many elements as the batch has.")]
        #[derive(Clone, Copy, Debug)]
        #[repr(C)]
        pub struct $columns {
            $($(#[$field_doc])* pub $field: results!(pointer $([$n])? $kind),)+
        }
        impl $name<'_> {
            /// Pointers to them, null for those that are empty.
            #[must_use]
            #[track_caller]
            pub fn columns(self, n: usize) -> $columns {
                $columns { $($field: results!(columns $([$n])? $kind, self.$field, n)),+ }
            }
        }
        // of choices it has no use
        #[allow(dead_code)]
        impl $columns {
            /// The columns from element `i` on.
            pub(crate) fn from(&self, i: usize) -> Self {
                Self { $($field: results!(from $([$n])? $kind, self.$field, i)),+ }
            }
        }
    )+};
    (slice Samples $a:lifetime) => { Samples<$a> };
    (pointer Samples) => { SampleColumns };
    (columns Samples, $samples:expr, $n:ident) => { $samples.columns($n) };
    (from Samples, $samples:expr, $i:ident) => { $samples.from($i) };
    (slice $([$n:literal])? $number:ident $a:lifetime) => { results!(@ $([$n])? &$a mut [$number]) };
    (pointer $([$n:literal])? $number:ident) => { results!(@ $([$n])? *mut $number) };
    (columns [$count:literal] $number:ident, $slices:expr, $n:ident) => { $slices.map(|column| pointer(column, $n)) };
    (columns $number:ident, $slice:expr, $n:ident) => { pointer($slice, $n) };
    (from [$count:literal] $number:ident, $pointers:expr, $i:ident) => { $pointers.map(|column| from(column, $i)) };
    (from $number:ident, $pointer:expr, $i:ident) => { from($pointer, $i) };
    (@ [$n:literal] $type:ty) => { [$type; $n] };
    (@ $type:ty) => { $type };
}
results! {
    /// Where samples go: slices of the length of the batch, or empty slices for what is not wanted. The fields are those of
    /// [`etendue::LightSample`].
    Samples, SampleColumns {
        /// Unit direction from the shading point to the light: x, y and z.
        direction: [3] f32,
        /// Distance to the light along it, in the unit of the coordinates.
        distance: f32,
        /// Probability density of the direction, per steradian; 0 where there is no sample.
        pdf: f32,
        /// 1/pdf where there is a sample and the light emits towards the shading point, 0 elsewhere.
        weight: f32,
        /// Unit normal of the light at the sampled point: x, y and z.
        normal: [3] f32,
        /// Surface coordinates of the sampled point in [0, 1]².
        uv: [2] f32,
        /// 1 where the shading point is on the side of the light that emits, else 0.
        emits: u8,
    }
    /// Where what is known of directions goes: slices of the length of the batch, or empty slices for what is not wanted.
    Evaluations, EvaluationColumns {
        /// The pdf of each direction, per steradian (lines: see [`etendue::Line`]); 0 where it misses the light.
        pdf: f32,
        /// The numbers in [0, 1)² that are mapped to each direction; any where it misses the light.
        u: [2] f32,
        /// The nearest point of the light in each direction, with its pdf; 0 where it misses the light.
        hit: Samples,
    }
    /// Where choices of lights go: slices of the length of the batch, or empty slices for what is not wanted.
    Choices, ChoiceColumns {
        /// Index of the light; [`etendue::select::LightTree::NO_LIGHT`], 2³² − 1, where none was chosen.
        light: u32,
        /// Probability with which it was chosen; 0 where none was.
        pmf: f32,
        /// What is left of the random number: uniform in [0, 1), independent of the light.
        u: f32,
    }
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
    /// The columns of numbers, in the order of the fields.
    fn numbers(&self) -> impl Iterator<Item = *mut f32> {
        let between = [self.distance, self.pdf, self.weight];
        self.direction.into_iter().chain(between).chain(self.normal).chain(self.uv)
    }
    /// True if any column is wanted.
    pub(crate) fn any(&self) -> bool {
        !self.emits.is_null() || self.numbers().any(|column| !column.is_null())
    }
    /// Writes a sample as element `i`.
    pub(crate) unsafe fn store(&self, i: usize, s: &OneSample) {
        let (w, n) = (s.direction, s.normal);
        let numbers = [w.x, w.y, w.z, s.distance, s.pdf, s.weight, n.x, n.y, n.z, s.uv.x, s.uv.y];
        for (column, number) in self.numbers().zip(numbers) {
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
    pub(crate) unsafe fn store_packet<R: Packet>(&self, place: PacketSpan, s: &LightSample<R>) {
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
