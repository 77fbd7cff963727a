//! The x86-64 kinds.

mod avx2;
mod sse2;

pub(super) use avx2::run_avx2;
pub(super) use sse2::Sse2;

/// A ray for boxes: one register per number.
pub(super) struct Boxes<V> {
    inverse: [V; 3],
    near: [V; 3],
    far: [V; 3],
    t_min: V,
    /// Where the near planes begin in a node, in numbers; the far planes begin at the same with `ROW` flipped.
    starts: [usize; 3],
}

/// Numbers of a row of planes.
const ROW: usize = crate::bvh::node::WIDTH;
