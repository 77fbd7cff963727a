//! The x86-64 kinds.

mod avx2;
mod sse2;

pub(super) use avx2::run_avx2;
pub(super) use sse2::Sse2;

use crate::bvh::ray::BoxRay;

/// A ray for boxes: one register per number.
pub(super) struct Boxes<V> {
    inverse: [V; 3],
    near: [V; 3],
    far: [V; 3],
    t_min: V,
    /// Rows of the near planes; the far planes are their neighbors.
    rows: [usize; 3],
}

/// Rows of the near planes.
#[inline(always)]
fn near_rows(ray: &BoxRay) -> [usize; 3] {
    [ray.is_downward[0] & 1, 2 + (ray.is_downward[1] & 1), 4 + (ray.is_downward[2] & 1)]
}
