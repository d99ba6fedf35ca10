//! Packets of numbers, and how they are read from columns and written to them.
//!
//! Columns are raw pointers, since callers in other languages pass them so, since an output may be null, and since an output may be
//! the same memory as an input.

use crate::sealed::Sealed;
use core::mem::MaybeUninit;
use core::ptr::copy_nonoverlapping;
use etendue::real::SAME_BITS;
use etendue::{Mask, Real, Uint, Vec3};

/// A packet that consists of its lanes, in order; a number is one lane.
///
/// # Safety
/// `Self` is `LANES` numbers in a row, and nothing else.
pub unsafe trait Packet: Real<Scalar = f32> + Sealed {}
macro_rules! packets {
    ($($packet:ty),+) => {$(
        impl Sealed for $packet {}
        // SAFETY: a number is one lane, and `wide` has `as_array` for packets
        unsafe impl Packet for $packet {}
    )+};
}
packets!(f32, etendue::f32x4, etendue::f32x8, etendue::f32x16);

/// True where the same bits are asked for of a processor without fused multiply-add: software then rounds once, in many instructions. A packet of
/// eight gains little, and whatever is there already is called. (On WebAssembly one register of four lanes takes two thirds of the time of single
/// numbers.)
pub(crate) const IS_LONG: bool =
    SAME_BITS && !cfg!(any(target_feature = "fma", target_arch = "aarch64", target_feature = "simd128"));

/// The packet of this compilation, unless [`IS_LONG`].
#[cfg(feature = "level-v4")]
pub(crate) type Lanes = etendue::f32x16;
#[cfg(all(not(feature = "level-v4"), not(target_feature = "simd128")))]
pub(crate) type Lanes = etendue::f32x8;
#[cfg(all(not(feature = "level-v4"), target_feature = "simd128"))]
pub(crate) type Lanes = etendue::f32x4;

/// The elements of a batch that one packet holds: `count` of them from `at` on.
#[derive(Clone, Copy)]
pub(crate) struct PacketSpan {
    pub(crate) at: usize,
    pub(crate) count: usize,
}

impl PacketSpan {
    /// The element of a lane. Lanes past the end repeat the first one, so that they are as harmless as that.
    #[inline(always)]
    pub(crate) fn element(self, lane: usize) -> usize {
        self.at + if lane < self.count { lane } else { 0 }
    }
    #[inline(always)]
    pub(crate) unsafe fn load<R: Packet>(self, column: *const f32) -> R {
        if self.count == R::LANES {
            let mut packet = MaybeUninit::<R>::uninit();
            // SAFETY: the caller's column has an element for every lane, and a packet consists of its lanes
            unsafe {
                // as bytes, since columns have any alignment
                copy_nonoverlapping(column.add(self.at).cast::<u8>(), packet.as_mut_ptr().cast::<u8>(), 4 * R::LANES);
                packet.assume_init()
            }
        } else if self.count == 1 {
            // SAFETY: the caller's column has this element
            R::splat(unsafe { column.add(self.at).read_unaligned() })
        } else {
            // SAFETY: the caller's
            unsafe { self.load_some(column) }
        }
    }
    /// The last packet, in a function of its own: the loops have many columns.
    #[cold]
    #[inline(never)]
    unsafe fn load_some<R: Packet>(self, column: *const f32) -> R {
        // SAFETY: the caller's column has an element for every lane below `count`
        R::from_fn(|lane| unsafe { column.add(self.element(lane)).read_unaligned() })
    }
    #[inline(always)]
    pub(crate) unsafe fn load_uint<U: Uint>(self, column: *const u32) -> U {
        // SAFETY: the caller's column has an element for every lane
        U::from_fn(|lane| unsafe { column.add(self.element(lane)).read_unaligned() })
    }
    /// Writes a column, unless it is null.
    #[inline(always)]
    pub(crate) unsafe fn store<R: Packet>(self, column: *mut f32, value: R) {
        if column.is_null() {
            return;
        }
        if self.count == R::LANES {
            // SAFETY: the caller's column has an element for every lane, and a packet consists of its lanes
            unsafe {
                let bytes = (&raw const value).cast::<u8>();
                copy_nonoverlapping(bytes, column.add(self.at).cast::<u8>(), 4 * R::LANES);
            }
        } else if self.count == 1 {
            // SAFETY: the caller's column has this element
            unsafe { column.add(self.at).write_unaligned(value.lane(0)) };
        } else {
            // SAFETY: the caller's
            unsafe { self.store_some(column, value) };
        }
    }
    #[cold]
    #[inline(never)]
    unsafe fn store_some<R: Packet>(self, column: *mut f32, value: R) {
        for lane in 0..self.count {
            // SAFETY: the caller's column has an element for every lane below `count`
            unsafe { column.add(self.at + lane).write_unaligned(value.lane(lane)) };
        }
    }
    #[inline(always)]
    pub(crate) unsafe fn store3<R: Packet>(self, columns: [*mut f32; 3], value: Vec3<R>) {
        let [x, y, z] = columns;
        // SAFETY: the caller's
        unsafe {
            self.store(x, value.x);
            self.store(y, value.y);
            self.store(z, value.z);
        }
    }
    /// Writes a column of truths, unless it is null.
    #[inline(always)]
    pub(crate) unsafe fn store_mask<M: Mask>(self, column: *mut u8, mask: M) {
        if column.is_null() {
            return;
        }
        let bits = mask.bits();
        for lane in 0..self.count {
            // SAFETY: the caller's column has an element for every lane below `count`
            unsafe { column.add(self.at + lane).write((bits >> lane & 1) as u8) };
        }
    }
}

/// Calls `f` for each packet of a batch of `n`.
#[inline(always)]
pub(crate) fn packets(n: usize, lanes: usize, mut f: impl FnMut(PacketSpan)) {
    let mut at = 0;
    while at < n {
        let count = (n - at).min(lanes);
        f(PacketSpan { at, count });
        at += count;
    }
}
