//! C interface of [`etendue`]. The header `include/etendue.h` documents it for its users.
//!
//! Every function takes plain structs and pointers and checks the pointers for null; nothing is allocated or kept. The functions of
//! batches choose the instructions of the processor at run time, see [`etendue_batch`].
#![cfg_attr(panic = "abort", no_std)]
// one rule for all functions: every pointer is null, or points to what the header says
#![allow(clippy::missing_safety_doc)]

mod sampler;
// samples come first in the header
mod light;
mod reflected;
mod sequence;
mod tree;
// after the lights, as in the header
mod environment;
mod picture;
mod portal;
mod spread;
mod warp;

use etendue_batch::Batch;

pub use environment::*;
pub use light::*;
pub use picture::*;
pub use portal::*;
pub use reflected::*;
pub use sampler::{EtendueLightSample, EtendueSampleColumns};
pub use sequence::*;
pub use spread::*;
pub use tree::*;
pub use warp::*;

/// What a function says that could not do its work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub enum EtendueStatus {
    /// The function did its work.
    Ok = 0,
    /// A pointer is NULL that must not be.
    NullPointer = 1,
    /// A count is too large.
    Count = 2,
    /// A value is not one of those allowed.
    Value = 3,
}

/// The instructions that batches use on this processor: 0 for those of every processor of the architecture, 3 for x86-64-v3 (AVX2,
/// fused multiply-add), 4 for x86-64-v4 (AVX-512).
#[unsafe(no_mangle)]
pub extern "C" fn etendue_level() -> u32 {
    match Batch::new().level() {
        etendue_batch::Level::Build => 0,
        etendue_batch::Level::V3 => 3,
        etendue_batch::Level::V4 => 4,
    }
}

/// Returns [`EtendueStatus::NullPointer`] if a pointer is null.
macro_rules! refuse_null {
    ($($pointer:expr),+ $(,)?) => {
        if $($pointer.is_null())||+ {
            return $crate::EtendueStatus::NullPointer;
        }
    };
}
use refuse_null;

/// Columns of coordinates, if all of them are there.
unsafe fn columns<const N: usize>(columns: *const *const f32) -> Option<[*const f32; N]> {
    if columns.is_null() {
        return None;
    }
    // SAFETY: the caller's array has N pointers
    let columns = unsafe { columns.cast::<[*const f32; N]>().read_unaligned() };
    (!columns.iter().any(|column| column.is_null())).then_some(columns)
}

/// Columns of results, any of which may be null.
unsafe fn outputs<const N: usize>(columns: *const *mut f32) -> Option<[*mut f32; N]> {
    // SAFETY: the caller's array has N pointers
    (!columns.is_null()).then(|| unsafe { columns.cast::<[*mut f32; N]>().read_unaligned() })
}

/// N numbers in a row as columns of one element.
unsafe fn each<const N: usize>(numbers: *const f32) -> [*const f32; N] {
    core::array::from_fn(|i| numbers.wrapping_add(i))
}

/// N numbers in a row as columns of one element, for results.
unsafe fn each_mut<const N: usize>(numbers: *mut f32) -> [*mut f32; N] {
    core::array::from_fn(|i| numbers.wrapping_add(i))
}

/// The precompiled `core` names it, although nothing unwinds.
#[cfg(panic = "abort")]
#[unsafe(no_mangle)]
extern "C" fn rust_eh_personality() {}

#[cfg(panic = "abort")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    // no routine panics; if one did, it must not return to the caller
    loop {}
}
