//! Lanes of radiance, colour spaces, and the catalogue of named glasses, liquids and metals.

pub mod catalogue;
pub mod color;
mod lanes;

pub use lanes::Spectrum;
