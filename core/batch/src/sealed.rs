//! What keeps the traits of batches to this crate.

/// A type of this crate's lists. [`Batch`](crate::Batch) takes memory as written by the functions of such types, without a look, so that no
/// other type may have the traits above this one.
///
/// ```compile_fail,E0277
/// use etendue::light::SphereByArea;
/// use etendue::{LightSampler, Real};
/// use etendue_batch::Prepared;
/// #[derive(Clone, Copy)]
/// struct Mine;
/// impl Prepared for Mine {
///     const INDEX: usize = 0;
///     type Of<'a, R: Real> = SphereByArea<R>;
///     fn over<R: Real<Scalar = f32>, T>(&self, _: impl FnOnce(&SphereByArea<R>) -> T) -> T {
///         loop {}
///     }
/// }
/// ```
pub trait Sealed<Kind = ()> {}
/// The kind of techniques.
#[derive(Clone, Copy, Debug)]
pub struct Techniques;
/// The kind of prepared lights.
#[derive(Clone, Copy, Debug)]
pub struct Samplers;
