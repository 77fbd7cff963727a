//! Random numbers, low-discrepancy samplers, warps with their densities, distributions, MIS.
//!
//! Everything is keyed by counters, so that any pass of any pixel can be made alone, in any order, on any thread.

pub mod distribution;
pub mod distribution2d;
pub mod hash;
pub mod mis;
pub mod rng;
pub mod sampler;
mod sobol;
pub mod spherical_rectangle;
pub mod warp;

pub use distribution::{Distribution1d, DistributionError, Pick};
pub use distribution2d::{Distribution2d, Pick2d};
pub use rng::Rng;
pub use sampler::{Sampler, SamplerKind};
pub use spherical_rectangle::{RectangleFrame, SphericalRectangle};
