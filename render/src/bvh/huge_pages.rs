//! Huge pages for the memory of large trees: without them, rays that are alone also wait for the addresses of pages.

/// Moves a large array to huge pages, where the system has them: Linux from 6.1. Elsewhere and on failure, the array stays as it is.
pub(super) fn collapse<T>(items: &[T]) {
    #[cfg(target_os = "linux")]
    {
        const PAGE: usize = 2 << 20;
        const MADV_COLLAPSE: i32 = 25;
        unsafe extern "C" {
            fn madvise(start: *mut core::ffi::c_void, length: usize, advice: i32) -> i32;
        }
        let skipped = items.as_ptr().cast::<u8>().align_offset(PAGE);
        let length = size_of_val(items).saturating_sub(skipped) / PAGE * PAGE;
        if length != 0 {
            let start = items.as_ptr().cast::<u8>().cast_mut().wrapping_add(skipped);
            // SAFETY: the range lies within `items`, and the advice changes nothing but the pages that hold it
            unsafe { madvise(start.cast(), length, MADV_COLLAPSE) };
        }
    }
    #[cfg(not(target_os = "linux"))]
    let _ = items;
}
