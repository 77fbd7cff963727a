//! Integrators: how light is carried from lights to the camera.

#[cfg(test)]
extern crate self as hyaline_transport;

pub mod direct;
mod extent;
pub mod first_hit;
pub mod in_volume;
pub mod integrator;
pub mod march;
pub mod photon;
mod roulette;
pub mod shadow;
pub mod stats;
pub mod walk;

pub use integrator::{Integrator, Pass, Prepared, RenderSettings, View};
pub use stats::Stats;
