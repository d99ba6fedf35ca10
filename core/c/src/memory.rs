//! Pointers to numbers and to columns of them.

use core::mem::size_of;
use etendue::{Vec2, Vec3};

/// Returns [`EtendueStatus::NullPointer`](crate::EtendueStatus::NullPointer) if a pointer is null.
macro_rules! refuse_null {
    ($($pointer:expr),+ $(,)?) => {
        if $($pointer.is_null())||+ {
            return $crate::EtendueStatus::NullPointer;
        }
    };
}
pub(crate) use refuse_null;

/// Returns [`EtendueStatus::Value`](crate::EtendueStatus::Value) unless all `count` random numbers are in [0, 1).
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
/// N numbers in a row as columns of one element, for results.
pub(crate) unsafe fn each_mut<const N: usize>(numbers: *mut f32) -> [*mut f32; N] {
    core::array::from_fn(|i| numbers.wrapping_add(i))
}
