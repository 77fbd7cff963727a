//! Vectors, rays, frames, bounds, transforms and root finding: the arithmetic every other crate stands on.
//!
//! Rays, boxes and meshes are `f32`, which keeps traversal fast; shape solvers and transforms are `f64`.

pub mod bounds;
pub mod float;
pub mod frame;
pub mod polynomial;
pub mod ray;
pub mod transform;

pub use bounds::Bounds;
pub use frame::Frame;
pub use glam::{DMat3, DVec2, DVec3, Mat3, Vec2, Vec3, Vec3A, Vec4};
pub use ray::{Ray, offset_origin};
pub use transform::Transform;
