//! Sequences of random numbers.

use crate::arrays::{Argument, FieldKind};
use crate::results::{Object, refuse, rows, run, zero_columns};
use etendue::Vec2;
use etendue_batch::{Batch, BatchSequence, Counters};
use pyo3::exceptions::{PyMemoryError, PyValueError};
use pyo3::prelude::*;

/// A sequence of any kind.
trait Pairs: Send + Sync {
    fn pairs(&self, counters: Counters, out: Vec2<&mut [f32]>);
}
impl<S: BatchSequence + Send + Sync> Pairs for S {
    fn pairs(&self, counters: Counters, out: Vec2<&mut [f32]>) {
        Batch::new().pairs(self, counters, out);
    }
}

/// A sequence of pairs of random numbers in [0, 1): each of its subclasses is one. The same counters give the same numbers, always.
#[pyclass(module = "etendue", subclass, frozen)]
pub(crate) struct Sequence {
    sequence: Box<dyn Pairs>,
}

#[pymethods]
impl Sequence {
    /// The pairs of `count` samples from sample `first` on: (count, 2). Pixels, an integer or an array of them (...), and dimensions are
    /// independent; an array of pixels gives (..., count, 2). All counters have 32 bits.
    #[pyo3(signature = (count, *, pixel=None, dimension=0, first=0))]
    fn pairs<'py>(
        &self,
        py: Python<'py>,
        count: i128,
        pixel: Option<&Object<'py>>,
        dimension: i128,
        first: i128,
    ) -> PyResult<Object<'py>> {
        let (dimension, first) = (unsigned("dimension", dimension)?, unsigned::<u32>("first", first)?);
        let count: u64 = unsigned("count", count)?;
        if count > (1 << 32) - u64::from(first) {
            refuse!("first + count must be at most 2**32, not {first} + {count}");
        }
        let (mut shape, pixels) = match pixel {
            None => (vec![], vec![0]),
            Some(pixel) => {
                let pixel = Argument::new("pixel", FieldKind::Index, pixel)?;
                let pixels = pixel.indices(&pixel.shape)?;
                (pixel.shape, pixels)
            }
        };
        let count = count as usize;
        let total = count.checked_mul(pixels.len());
        let total = total.ok_or_else(|| PyMemoryError::new_err("no memory for so many numbers"))?;
        shape.push(count);
        let mut columns = zero_columns(2, total)?;
        run(py, total, || {
            let [x, y] = &mut columns[..] else { return };
            let places = x.chunks_mut(count.max(1)).zip(y.chunks_mut(count.max(1)));
            for (&pixel, (x, y)) in pixels.iter().zip(places) {
                let counters = Counters { pixel, dimension, sample: first, ..Counters::default() };
                self.sequence.pairs(counters, Vec2::new(x, y));
            }
        });
        rows(py, &shape, &columns)
    }
}

fn unsigned<T: TryFrom<i128>>(name: &str, number: i128) -> PyResult<T> {
    let bits = 8 * size_of::<T>();
    let wrong = |_| PyValueError::new_err(format!("{name} must be in [0, 2**{bits}), not {number}"));
    number.try_into().map_err(wrong)
}
/// A number of samples in the domain of stratified sequences.
fn strata(count: i128) -> PyResult<u32> {
    if !(1..=1 << 22).contains(&count) {
        refuse!("count must be in [1, 2**22], not {count}");
    }
    unsigned("count", count)
}

macro_rules! sequences {
    ($($(#[$doc:meta])* $name:ident($($argument:ident: $type:ty),+) $signature:tt $build:expr;)+) => {
        $($(#[$doc])*
        #[pyclass(module = "etendue", extends = Sequence, frozen)]
        pub(crate) struct $name;
        #[pymethods]
        impl $name {
            #[new]
            #[pyo3(signature = $signature)]
            fn new($($argument: $type),+) -> PyResult<PyClassInitializer<Self>> {
                Ok(PyClassInitializer::from(Sequence { sequence: Box::new($build) }).add_subclass(Self))
            }
        })+
        /// Adds the sequences to the module.
        pub(crate) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
            module.add_class::<Sequence>()?;
            $(module.add_class::<$name>()?;)+
            Ok(())
        }
    };
}
sequences! {
    /// Independent numbers by a hash of the counters.
    Independent(seed: i128) (seed=0) etendue::sequence::Independent::new(unsigned("seed", seed)?);
    /// Owen-scrambled Sobol pairs: in each dimension, 2ᵐ samples from a multiple of 2ᵐ on are a (0, m, 2)-net. Best with powers of two.
    OwenSobol(seed: i128) (seed=0) etendue::sequence::OwenSobol::new(unsigned("seed", seed)?);
    /// Owen-scrambled Sobol points in eight dimensions: dimensions 0 to 3 of a sample belong to one point.
    JointSobol(seed: i128) (seed=0) etendue::sequence::JointSobol::new(unsigned("seed", seed)?);
    /// Jittered strata: `count` samples, at most 2²², have one in each cell of a grid.
    Stratified(seed: i128, count: i128) (seed, count) etendue::sequence::Stratified::new(unsigned("seed", seed)?, strata(count)?);
}
