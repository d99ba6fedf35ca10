//! C interface of [`etendue`]. The header `include/etendue.h` documents it for its users.
//!
//! Every function takes plain structs and pointers and checks the pointers for null; but for sets of lights, nothing is allocated or kept. The functions of
//! batches choose the instructions of the processor at run time, see [`etendue_batch`].
#![cfg_attr(panic = "abort", no_std)]
// one rule for all functions: every pointer is null, or points to what the header says
#![allow(clippy::missing_safety_doc)]

extern crate alloc;

mod environment;
mod light;
mod lights;
mod list;
mod memory;
mod picture;
mod portal;
mod reflection;
mod sample;
mod sequence;
mod status;
mod surface;
mod technique;
mod tree;
mod warp;

use etendue_batch::Batch;

pub use environment::*;
pub use light::*;
pub use lights::*;
pub use list::*;
pub use picture::*;
pub use portal::*;
pub use reflection::*;
pub use sample::*;
pub use sequence::*;
pub use status::*;
pub use surface::*;
pub use technique::*;
pub use tree::*;
pub use warp::*;

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
