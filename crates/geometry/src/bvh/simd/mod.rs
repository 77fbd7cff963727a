//! The wide box test and triangle filter for each kind of processor, and the stack: all `unsafe` of this crate.
//!
//! The kind is chosen once for a query, around the whole descent; everything below is inlined into it. All kinds are
//! conservative in the same bounds, but not bit for bit alike: they decide what is looked at, never what is hit.

#![allow(unsafe_code, reason = "vector instructions and a stack that is not cleared for every ray")]

mod memory;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use memory::with_capacity_in_large_pages;
pub(crate) use memory::{Stack, collect_in_large_pages, prefetch};

use super::node::{BLOCK, Block, Node};
use super::ray::{BoxRay, FilterRay};

/// A kind of processor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SimdLevel {
    /// One number at a time; any processor.
    Scalar,
    /// Four at a time; any x86-64.
    Sse2,
    /// Eight at a time with fused steps; x86-64 since about 2013.
    Avx2,
}

impl SimdLevel {
    /// All levels, slowest first.
    pub const ALL: [Self; 3] = [Self::Scalar, Self::Sse2, Self::Avx2];

    /// The best level of this processor.
    pub fn detect() -> Self {
        Self::ALL.into_iter().rev().find(|level| level.is_supported()).unwrap_or(Self::Scalar)
    }

    /// Whether this processor has the level.
    pub fn is_supported(self) -> bool {
        match self {
            Self::Scalar => true,
            Self::Sse2 => cfg!(target_arch = "x86_64"),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma"),
            #[cfg(not(target_arch = "x86_64"))]
            Self::Avx2 => false,
        }
    }
}

/// A level that this processor has; the field is private so that nothing else can be one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VerifiedLevel(SimdLevel);

impl VerifiedLevel {
    /// The level, or the best one where the processor lacks it.
    pub(crate) fn new(level: SimdLevel) -> Self {
        Self(if level.is_supported() { level } else { SimdLevel::detect() })
    }

    pub(crate) fn level(self) -> SimdLevel {
        self.0
    }

    /// Runs a query with the instructions of this level.
    #[inline(always)]
    pub(crate) fn run<Q: Query>(self, query: Q) -> Q::Output {
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            SimdLevel::Sse2 => query.run(x86::Sse2),
            #[cfg(target_arch = "x86_64")]
            // SAFETY: a verified level is one the processor has.
            SimdLevel::Avx2 => unsafe { x86::run_avx2(query) },
            _ => query.run(Scalar),
        }
    }
}

/// Work to be done with some kind of lanes. `run` must be inlined, so that it is compiled for the level.
pub(crate) trait Query {
    type Output;
    fn run<L: Lanes>(self, lanes: L) -> Self::Output;
}

/// Where the boxes of a node begin.
#[repr(align(32))]
pub(crate) struct Nears(pub(crate) [f32; 8]);

/// The wide operations.
pub(crate) trait Lanes: Copy {
    /// A ray in registers, for boxes.
    type Boxes;
    /// A ray in registers, for triangles.
    type Triangles;

    fn prepare_boxes(self, ray: &BoxRay) -> Self::Boxes;

    /// The boxes that the ray may meet up to `limit`, as bits, and where they begin (0 or later).
    fn hit_boxes(self, ray: &Self::Boxes, node: &Node, limit: f32) -> (Nears, u32);

    fn prepare_triangles(self, ray: &FilterRay) -> Self::Triangles;

    /// The triangles that the ray may cross up to `limit`, as bits.
    fn filter(self, ray: &Self::Triangles, block: &Block, limit: f32) -> u32;
}

/// One number at a time. It does not filter triangles.
#[derive(Clone, Copy)]
pub(crate) struct Scalar;

impl Lanes for Scalar {
    type Boxes = BoxRay;
    type Triangles = ();

    fn prepare_boxes(self, ray: &BoxRay) -> BoxRay {
        *ray
    }

    #[inline(always)]
    fn hit_boxes(self, ray: &BoxRay, node: &Node, limit: f32) -> (Nears, u32) {
        let mut nears = Nears([ray.t_min; 8]);
        let mut fars = [limit; 8];
        for axis in 0..3 {
            let near_plane = &node.planes[ray.near_rows[axis]];
            let far_plane = &node.planes[ray.near_rows[axis] ^ 1];
            for slot in 0..8 {
                nears.0[slot] = nears.0[slot].max(near_plane[slot] * ray.inverse[axis] - ray.near[axis]);
                fars[slot] = fars[slot].min(far_plane[slot] * ray.inverse[axis] - ray.far[axis]);
            }
        }
        let hits = (0..8).fold(0, |hits, slot| hits | u32::from(nears.0[slot] <= fars[slot]) << slot);
        (nears, hits)
    }

    fn prepare_triangles(self, _: &FilterRay) {}

    #[inline(always)]
    fn filter(self, (): &(), block: &Block, _: f32) -> u32 {
        (0..BLOCK).fold(0, |lanes, lane| lanes | (block.faces[lane] >> 31 ^ 1) << lane)
    }
}
