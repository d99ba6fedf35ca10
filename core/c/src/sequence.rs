//! Sequences of random numbers.

use crate::memory::{outputs, refuse_null};
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

/// The function of one sequence.
macro_rules! sequence {
    ($(#[$doc:meta])* $type:ty, ($($name:ident: $kind:ty),+), $value:expr, $pairs:ident) => {
        $(#[$doc])*
        ///
        /// Writes the pairs, in [0, 1)^2, to two columns.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $pairs(
            $($name: $kind,)+ counters: *const EtendueCounters, n: usize, u: *const *mut f32,
        ) -> EtendueStatus {
            if n == 0 {
                return EtendueStatus::Ok;
            }
            refuse_null!(counters);
            // SAFETY: the pointers are not null, and point to what the header says
            unsafe {
                let Some([x, y]) = outputs(u) else { return EtendueStatus::NullPointer };
                let EtendueCounters { pixel, sample, dimension, pixels, samples } = *counters;
                let counters = Counters { pixel, sample, dimension, pixels, samples };
                Batch::new().sequence::<$type>()(from_ref(&$value).cast(), n, &counters, Vec2::new(x, y));
            }
            EtendueStatus::Ok
        }
    };
}
sequence!(
    /// Independent random numbers: a counter, hashed.
    sequence::Independent, (seed: u64), sequence::Independent::new(seed), etendue_independent_pairs
);
sequence!(
    /// Owen-scrambled Sobol pairs, each dimension on its own: the choice where the count is a power of two.
    sequence::OwenSobol, (seed: u64), sequence::OwenSobol::new(seed), etendue_owen_sobol_pairs
);
sequence!(
    /// Owen-scrambled Sobol pairs whose dimensions are stratified together.
    sequence::JointSobol, (seed: u64), sequence::JointSobol::new(seed), etendue_joint_sobol_pairs
);
sequence!(
    /// Stratified pairs, of `count` samples a pixel.
    sequence::Stratified, (seed: u64, count: u32), sequence::Stratified::new(seed, count), etendue_stratified_pairs
);
