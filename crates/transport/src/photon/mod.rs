//! Photons: how they start, travel, are kept, and are found again.

mod clip;
pub mod emission;
pub mod gather;
pub mod guide;
pub mod kernel;
pub mod maps;
mod projection;
pub mod radius;
pub mod record;
pub mod specular;
pub mod stopwatch;
pub mod trace;
pub mod tree;
pub mod volume;

pub use clip::Clip;
pub use emission::{PhotonEmitter, PhotonStart};
pub use gather::{Estimate, Gathered, PhotonMap};
pub use kernel::Kernel;
pub use maps::{MapStatistics, PhotonMaps, PhotonStatistics};
pub use record::{PackedPhoton, Photon, PhotonKind};
pub use trace::{MapKind, PhotonTracer};
pub use tree::{Accept, All, Disc, Nearest, PointTree, Region};
pub use volume::{VolumeMap, VolumeMaps};
