//! Pointers to numbers and to columns of them.

use crate::status::EtendueStatus;
use core::mem::size_of;
use core::ptr::null_mut;
use core::slice::{from_raw_parts, from_raw_parts_mut};
use etendue::{Vec2, Vec3};
use etendue_batch::{Batch, BatchMap};

/// Returns [`EtendueStatus::NullPointer`] if a pointer is null.
macro_rules! refuse_null {
    ($($pointer:expr),+ $(,)?) => {
        if $($pointer.is_null())||+ {
            return $crate::EtendueStatus::NullPointer;
        }
    };
}
pub(crate) use refuse_null;

/// Returns [`EtendueStatus::Ok`] for a batch of no elements.
macro_rules! skip_empty {
    ($n:ident) => {
        if $n == 0 {
            return $crate::EtendueStatus::Ok;
        }
    };
}
pub(crate) use skip_empty;

/// Returns [`EtendueStatus::Value`] unless all `count` random numbers are in [0, 1).
macro_rules! refuse_outside {
    ($u:ident, $count:expr) => {
        // SAFETY: the pointer is not null, and points to what the header says
        if !unsafe { $crate::memory::are_random($u, $count) } {
            return $crate::EtendueStatus::Value;
        }
    };
}
pub(crate) use refuse_outside;

pub(crate) fn vec3<T>([x, y, z]: [T; 3]) -> Vec3<T> {
    Vec3::new(x, y, z)
}
pub(crate) fn vec2<T>([x, y]: [T; 2]) -> Vec2<T> {
    Vec2::new(x, y)
}

/// Columns of coordinates, if all of them are there.
pub(crate) unsafe fn columns<const N: usize>(columns: *const *const f32) -> Option<[*const f32; N]> {
    if columns.is_null() {
        return None;
    }
    // SAFETY: the caller's array has N pointers
    let columns = unsafe { columns.cast::<[*const f32; N]>().read_unaligned() };
    (!columns.iter().any(|column| column.is_null())).then_some(columns)
}
/// Columns of results, any of which may be null.
pub(crate) unsafe fn outputs<const N: usize>(columns: *const *mut f32) -> Option<[*mut f32; N]> {
    // SAFETY: the caller's array has N pointers
    (!columns.is_null()).then(|| unsafe { columns.cast::<[*mut f32; N]>().read_unaligned() })
}
/// Whether an array of so many columns is there, and all of them are.
pub(crate) unsafe fn are_there(columns: *const *const f32, count: usize) -> bool {
    // SAFETY: the caller's array has so many pointers
    count == 0 || !columns.is_null() && (0..count).all(|i| unsafe { !columns.add(i).read_unaligned().is_null() })
}
/// Whether so many numbers are in [0, 1).
pub(crate) unsafe fn are_random(u: *const f32, count: usize) -> bool {
    // SAFETY: the caller's pointer is to so many numbers
    (0..count).map(|i| unsafe { u.add(i).read_unaligned() }).all(|u| (0.0..1.0).contains(&u))
}
/// How many pointers a struct of columns consists of.
pub(crate) const fn count_of<C>() -> usize {
    size_of::<C>() / size_of::<*const f32>()
}

/// N numbers in a row as columns of one element.
pub(crate) unsafe fn each<const N: usize>(numbers: *const f32) -> [*const f32; N] {
    core::array::from_fn(|i| numbers.wrapping_add(i))
}
/// Builds a table of `length` elements from the weights of so many texels. Returns [`EtendueStatus::Value`] if a weight is negative, infinite or
/// NaN, if all are 0, and if `build` refuses them.
pub(crate) unsafe fn build_table<T>(
    weights: *const f32,
    texels: usize,
    table: *mut T,
    length: usize,
    build: impl FnOnce(&[f32], &mut [T]) -> bool,
) -> EtendueStatus {
    // SAFETY: the caller's pointers are to so many elements; every one of the table is written before it is read
    unsafe {
        let weights = from_raw_parts(weights, texels);
        // before the table is written
        if weights.iter().any(|w| !(0.0..f32::INFINITY).contains(w)) || weights.iter().all(|&w| w == 0.0) {
            return EtendueStatus::Value;
        }
        table.write_bytes(0, length);
        if build(weights, from_raw_parts_mut(table, length)) { EtendueStatus::Ok } else { EtendueStatus::Value }
    }
}

/// The only result of a map of columns of numbers.
pub(crate) unsafe fn map<M: BatchMap>(map: *const M, n: usize, numbers: [*const f32; 6], out: *mut f32) {
    let results = [out, null_mut(), null_mut(), null_mut()];
    // SAFETY: the caller's columns have `n` elements
    unsafe { Batch::new().map_function::<M>()(map.cast(), n, &numbers, &results, null_mut()) };
}
