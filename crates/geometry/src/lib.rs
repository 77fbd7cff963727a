//! Shapes, compound objects and vessels, meshes, and the hierarchies that rays descend.
//!
//! Everything is solved in object space; nothing here knows of materials or media.

pub mod aggregate;
pub mod bvh;
mod edges;
pub mod hit;
pub mod mesh;
pub mod primitive;
pub mod shape;
pub mod vessel;

pub use aggregate::{Aggregate, Item, ItemGeometry};
pub use hit::{Candidate, SurfaceHit, Tangents};
pub use mesh::Mesh;
pub use primitive::{AreaSample, Primitive};
pub use shape::Shape;
