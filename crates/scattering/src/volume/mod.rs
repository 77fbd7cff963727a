//! How light gets through a medium: what is left of it after a way, where a path scatters on it, and
//! where a march along it asks for light.
//!
//! In a homogeneous medium both are known in closed form. Where a grid says how dense it is, paths are followed from one
//! possible collision to the next, against local upper bounds of the density (delta and ratio tracking).

mod beam;
mod flight;
mod grid;
mod majorants;
mod march;
#[cfg(test)]
mod tests;
mod tracking;

pub use beam::BeamWeight;
pub use flight::{Flight, Flyer};
pub use grid::{AlbedoGrid, Grid};
pub use march::{Marched, Marcher, Station, Step};
pub use tracking::transmittance;
