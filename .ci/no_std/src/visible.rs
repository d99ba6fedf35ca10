//! `etendue-visible` without std and libc, with 4 MiB for alloc (Linux, x86-64). The exit code is 42 if a box is proved to hide part of a
//! light, and its irradiance is that of the light without what it hides; 1 to 3 name what fails, 255 means a panic.
#![no_std]
#![no_main]

mod start;

use core::alloc::{GlobalAlloc, Layout};
use core::cell::UnsafeCell;
use core::sync::atomic::{AtomicUsize, Ordering};
use etendue::Vec3;
use etendue_visible::{Light, Occluder, Patch, Proof, Prover, Solid};
use start::exit;

const BYTES: usize = 4 << 20;

/// Memory that is never given back.
#[repr(align(64))]
struct Heap(UnsafeCell<[u8; BYTES]>, AtomicUsize);

// SAFETY: the counter hands out each byte once
unsafe impl Sync for Heap {}

// SAFETY: what is handed out is aligned, and never overlaps
unsafe impl GlobalAlloc for Heap {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let from = self.1.fetch_add(layout.size() + layout.align(), Ordering::Relaxed).next_multiple_of(layout.align());
        if from + layout.size() > BYTES {
            return core::ptr::null_mut();
        }
        // SAFETY: the range is within the array
        unsafe { self.0.get().cast::<u8>().add(from) }
    }
    unsafe fn dealloc(&self, _: *mut u8, _: Layout) {}
}

#[global_allocator]
static HEAP: Heap = Heap(UnsafeCell::new([0; BYTES]), AtomicUsize::new(0));

#[unsafe(no_mangle)]
extern "C" fn main() -> ! {
    let square = |y: f64, half: f64| {
        [[-half, -half], [half, -half], [half, half], [-half, half]].map(|[x, z]| Vec3::new(x, y, z))
    };
    let Some(light) = Light::new(Solid::quadrilateral(square(2.0, 1.0)), true) else { exit(1) };
    let Some(block) = Solid::block(Vec3::new(-0.25, 1.0, -0.25), Vec3::new(0.25, 1.25, 0.25)) else { exit(1) };
    let mut corners = square(0.0, 0.1);
    corners.reverse();
    let Some(patch) = Patch::polygon(&corners, 1e-9, 0.0) else { exit(1) };
    let mut prover = Prover::new(2.0);
    let mut value = |blocks: &[Solid], expected: Proof<'_>| {
        let mut seen =
            prover.prove(&patch, &light, |_, found| blocks.iter().all(|block| found(Occluder::Whole(block.clone()))));
        if seen.proof != expected {
            exit(2);
        }
        seen.irradiance(Vec3::default(), Vec3::new(0.0, 1.0, 0.0)).map_or(0.0, |e| e.value)
    };
    let blocks = [block];
    let (all, left) = (value(&[], Proof::Lit), value(&blocks, Proof::Behind(&blocks)));
    // the bottom of the block, whose sides are behind it, has the side 0.5 at the distance 1
    let form = |half: f64, y: f64| {
        let x = half / y;
        4.0 * x / etendue::Real::sqrt(1.0 + x * x) * etendue::Real::atan2(x, etendue::Real::sqrt(1.0 + x * x))
    };
    let near = |a: f64, b: f64| (a - b).abs() < 1e-12;
    exit(if near(all, form(1.0, 2.0)) && near(left, all - form(0.25, 1.0)) { 42 } else { 3 })
}
