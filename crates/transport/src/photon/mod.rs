//! Photons: how they start, travel, are kept, and are found again.

pub mod emission;

pub use emission::{PhotonEmitter, PhotonStart};
