//! What happens to light at a point: which media meet there, what a boundary does, what a medium swallows.

pub mod bsdf;
pub mod medium;
pub mod nesting;
pub mod phase;
pub mod volume;

pub use bsdf::{Branch, Bsdf, BsdfSample, Sides, SurfaceBsdf, Transport};
pub use medium::{Medium, MediumId};
pub use nesting::{Boundaries, BoundaryKind, Crossing, MediumSet, ObjectId, Side, SurfaceCrossing};
pub use phase::Phase;
