//! Photons: how they start, travel, are kept, and are found again.

pub mod emission;

pub use emission::{PhotonEmitter, PhotonStart};
pub mod gather;
pub mod kernel;
pub mod record;
pub mod tree;

pub use gather::{Estimate, Gathered, PhotonMap};
pub use kernel::Kernel;
pub use record::{PackedPhoton, Photon, PhotonKind};
pub use tree::{Disc, Nearest, PointTree, Region};
pub mod radius;
