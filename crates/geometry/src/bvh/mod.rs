//! Bounding volume hierarchies: 8-wide trees of boxes over triangles or items, and how a ray descends them.
//!
//! 1. `partition` cuts what is large into parts; each becomes a tree of its own, and one more joins them.
//! 2. `binary` makes a binary tree of single primitives: obvhs sorts and joins them (PLOC) and improves the result by
//!    reinsertion.
//! 3. `collapse` turns it into the cheapest tree of nodes with up to eight children.
//! 4. `traverse` descends it with one box test for eight children. Box tests and the triangle filter are padded by
//!    their rounding error, so they may differ between processors and yet never lose a hit; whether a triangle is hit
//!    is decided by `mesh::triangle` alone.

mod binary;
mod collapse;
mod mesh_bvh;
mod node;
mod partition;
mod query;
mod ray;
mod simd;
#[cfg(test)]
mod tests;
mod traverse;

pub use mesh_bvh::MeshBvh;
pub use simd::{SimdLevel, with_capacity_in_large_pages};

pub(crate) use collapse::build;
pub(crate) use node::Tree;
pub(crate) use query::{Any, Closest, Every, Sink};
pub(crate) use ray::SlabRay;
pub(crate) use simd::{Lanes, Query, VerifiedLevel};
pub(crate) use traverse::{Visitor, traverse};
