//! The Python package of Étendue: the batches of [`etendue_batch`] with numpy arrays.
//!
//! All arguments are copied, so that no other thread can change them while a batch runs without Python's lock. Results go to new arrays, or to
//! those of the caller, which no other call of this package uses meanwhile.
#![forbid(unsafe_code)]

mod arrays;
mod each;
mod environment;
mod lights;
mod pictures;
mod portals;
mod reflections;
mod results;
mod samplers;
mod samples;
mod sequences;
mod tree;
mod warps;

use etendue_batch::{Batch, Level};
use pyo3::exceptions::PyImportError;
use pyo3::prelude::*;

/// The instructions in use: "v4" for x86-64-v4 (AVX-512), "v3" for x86-64-v3 (AVX2 and fused multiply-add), "build" for those that every
/// processor has.
#[pyfunction]
fn level() -> &'static str {
    match Batch::new().level() {
        Level::V4 => "v4",
        Level::V3 => "v3",
        // a wheel for one machine is compiled for its processor
        Level::Build if cfg!(all(target_feature = "avx512f", target_feature = "avx512vl")) => "v4",
        Level::Build if cfg!(all(target_feature = "avx2", target_feature = "fma")) => "v3",
        Level::Build => "build",
    }
}

/// Fails on a processor that lacks instructions for which the package was compiled: `pip` compiles for that of its machine.
fn check_processor() -> PyResult<()> {
    #[cfg(target_arch = "x86_64")]
    {
        macro_rules! need {
            ($($feature:tt)*) => {
                $(if cfg!(target_feature = $feature) && !std::arch::is_x86_feature_detected!($feature) {
                    return Err(PyImportError::new_err(concat!(
                        "etendue was compiled for a processor with ", $feature, ", which this one lacks: install it again on this machine"
                    )));
                })*
            };
        }
        need!("avx" "avx2" "fma" "avx512f" "avx512bw" "avx512cd" "avx512dq" "avx512vl");
    }
    Ok(())
}

/// Light sampling: maps of random numbers to directions, their densities and inverses, over numpy arrays of single precision.
///
///     u = etendue.OwenSobol(seed=1).pairs(1024)
///     sampler = etendue.Triangle([0, 2, 0], [1, 2, 0], [0, 2, 1]).by_solid_angle(p=[0, 0, 0])
///     s = sampler.sample(u)
///     irradiance = (s.direction[:, 1] * s.weight).mean()
///
/// Arguments may be anything that numpy makes an array of. Random numbers u are in [0, 1), pdfs per steradian, angles in radians, lengths
/// in any unit. Degenerate input has pdf 0 and weight 0.
#[pymodule]
#[pyo3(name = "etendue")]
fn extension(module: &Bound<'_, PyModule>) -> PyResult<()> {
    check_processor()?;
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_function(wrap_pyfunction!(level, module)?)?;
    samples::add(module)?;
    samplers::add(module)?;
    lights::add(module)?;
    environment::add(module)?;
    pictures::add(module)?;
    portals::add(module)?;
    warps::add(module)?;
    reflections::add(module)?;
    sequences::add(module)?;
    tree::add(module)
}
