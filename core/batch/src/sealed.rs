//! What keeps the traits of batches to this crate.

/// A type of this crate's lists. [`Batch`](crate::Batch) takes memory as written by the functions of such types, without a look, so that no
/// other type may have the traits above this one.
///
/// ```compile_fail,E0277
/// use etendue::{Mask, Real};
/// use etendue_batch::{BatchMap, MOST_NUMBERS, MOST_RESULTS, MapFunctions, Table};
/// #[derive(Clone, Copy)]
/// struct Mine;
/// impl BatchMap for Mine {
///     const NUMBERS: usize = 1;
///     const RESULTS: usize = 1;
///     fn map<R: Real<Scalar = f32>>(&self, _: [R; MOST_NUMBERS]) -> ([R; MOST_RESULTS], R::Mask) {
///         ([R::lit(0.0); MOST_RESULTS], R::Mask::splat(true))
///     }
///     fn map_functions(_: &'static Table) -> MapFunctions<Self> {
///         loop {}
///     }
/// }
/// ```
pub trait Sealed {}
