//! Sequences of random numbers.

use crate::memory::{outputs, refuse_null, skip_empty};
use crate::status::EtendueStatus;
use core::ptr::from_ref;
use etendue::Vec2;
use etendue::sequence;
use etendue_batch::{Batch, Counters};

/// Which pairs of a sequence a batch needs.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EtendueCounters {
    /// The pixel of all elements, if `pixels` is NULL.
    pub pixel: u32,
    /// The sample of the first element, if `samples` is NULL; the others follow.
    pub sample: u32,
    /// The dimension of all elements, which is a pair of coordinates: 0 might be the pixel, 1 the light, 2 the lens.
    pub dimension: u32,
    /// The pixel of each element, or NULL.
    pub pixels: *const u32,
    /// The sample of each element, or NULL.
    pub samples: *const u32,
}

/// The function of each sequence.
macro_rules! sequences {
    ($($(#[$doc:meta])* $pairs:ident($($name:ident: $kind:ty),+) $sequence:ident;)+) => {$(
        $(#[$doc])*
        ///
        /// Writes the pairs, in [0, 1)^2, to two columns.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $pairs(
            $($name: $kind,)+ counters: *const EtendueCounters, n: usize, u: *const *mut f32,
        ) -> EtendueStatus {
            skip_empty!(n);
            refuse_null!(counters);
            // SAFETY: the pointers are not null, and point to what the header says
            unsafe {
                let Some([x, y]) = outputs(u) else { return EtendueStatus::NullPointer };
                let EtendueCounters { pixel, sample, dimension, pixels, samples } = *counters;
                let sequence = sequence::$sequence::new($($name),+);
                let counters = Counters { pixel, sample, dimension, pixels, samples };
                Batch::new().sequence::<sequence::$sequence>()(from_ref(&sequence).cast(), n, &counters, Vec2::new(x, y));
            }
            EtendueStatus::Ok
        }
    )+};
}
sequences! {
    /// Independent random numbers: a counter, hashed.
    etendue_independent_pairs(seed: u64) Independent;
    /// Owen-scrambled Sobol pairs, each dimension on its own: the choice where the count is a power of two.
    etendue_owen_sobol_pairs(seed: u64) OwenSobol;
    /// Owen-scrambled Sobol pairs whose dimensions are stratified together.
    etendue_joint_sobol_pairs(seed: u64) JointSobol;
    /// Stratified pairs, of `count` samples a pixel.
    etendue_stratified_pairs(seed: u64, count: u32) Stratified;
}
