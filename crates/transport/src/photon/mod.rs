//! Photons: how they start, travel, are kept, and are found again.

pub mod emission;
mod projection;

pub use emission::{PhotonEmitter, PhotonStart};
