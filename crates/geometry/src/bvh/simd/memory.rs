//! Memory as traversal needs it: prefetching, large pages, and a stack that is not cleared for every ray.

use crate::bvh::node::STACK_SIZE;
use std::mem::MaybeUninit;

/// Begins to load an item of a list into the cache; nothing happens where there is none.
#[inline(always)]
pub(crate) fn prefetch<T>(list: &[T], index: usize) {
    let item = list.as_ptr().wrapping_add(index);
    #[cfg(target_arch = "x86_64")]
    for line in 0..size_of::<T>().div_ceil(64) {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: a prefetch changes nothing but the cache, whatever the address.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(item.cast::<i8>().wrapping_add(64 * line)) };
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = item;
}

/// Collects values in large pages; see [`with_capacity_in_large_pages`].
pub(crate) fn collect_in_large_pages<T>(values: impl ExactSizeIterator<Item = T>) -> Vec<T> {
    let mut list = with_capacity_in_large_pages(values.len());
    list.extend(values);
    list
}

/// An empty list in memory for which the system is asked to use large pages: a query touches a tree all over, and with
/// small pages half of its time goes into finding out where they are.
pub fn with_capacity_in_large_pages<T>(capacity: usize) -> Vec<T> {
    let mut list = Vec::with_capacity(capacity);
    advise_large_pages(list.spare_capacity_mut());
    list
}

/// Asks for large pages under memory that nothing was written to yet.
fn advise_large_pages<T>(memory: &mut [MaybeUninit<T>]) {
    #[cfg(target_os = "linux")]
    {
        const PAGE: usize = 4096;
        const MADV_HUGEPAGE: i32 = 14;
        unsafe extern "C" {
            fn madvise(address: *mut std::ffi::c_void, length: usize, advice: i32) -> i32;
        }
        let skip = memory.as_ptr().addr().next_multiple_of(PAGE) - memory.as_ptr().addr();
        let length = size_of_val(memory).saturating_sub(skip) / PAGE * PAGE;
        if length > 0 {
            let first = memory.as_mut_ptr().cast::<u8>().wrapping_add(skip);
            // SAFETY: the whole pages lie within the memory; the advice changes how they are mapped, not what is in
            // them. Whether it is taken does not matter.
            let _ = unsafe { madvise(first.cast(), length, MADV_HUGEPAGE) };
        }
    }
    #[cfg(not(target_os = "linux"))]
    let _ = memory;
}

/// A stack of pending children.
pub(crate) struct Stack {
    entries: [MaybeUninit<u64>; STACK_SIZE],
    len: usize,
}

impl Stack {
    #[inline(always)]
    pub(crate) fn new() -> Self {
        Self { entries: [const { MaybeUninit::uninit() }; STACK_SIZE], len: 0 }
    }

    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    /// # Panics
    /// Where it is full; trees are built shallow enough that it never is.
    #[inline(always)]
    pub(crate) fn push(&mut self, entry: u64) {
        self.entries[self.len] = MaybeUninit::new(entry);
        self.len += 1;
    }

    #[inline(always)]
    pub(crate) fn pop(&mut self) -> Option<u64> {
        self.len = self.len.checked_sub(1)?;
        // SAFETY: `push` wrote all entries below the length, and the bound was checked there.
        Some(unsafe { self.entries.get_unchecked(self.len).assume_init() })
    }

    /// Moves the last entry down, at most to `start`, past the entries that are smaller.
    #[inline(always)]
    pub(crate) fn sink_last(&mut self, start: usize) {
        let entries = &mut self.entries[start..self.len];
        for i in (1..entries.len()).rev() {
            // SAFETY: `push` wrote all entries below the length.
            let (below, above) = unsafe { (entries[i - 1].assume_init(), entries[i].assume_init()) };
            if below >= above {
                break;
            }
            entries.swap(i - 1, i);
        }
    }
}
