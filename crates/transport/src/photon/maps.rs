//! The photon maps of a render: traced once, looked up by every pass.

use super::emission::PhotonEmitter;
use super::gather::{Estimate, PhotonMap};
use super::trace::{MapKind, PhotonTracer};
use crate::RenderSettings;
use crate::stats::Stats;
use hyaline_scene::{PhotonMapSettings, ProjectionMaps};
use hyaline_world::World;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// Photons at which a map is asked how far its photons lie apart.
const PROBES: usize = 1024;

/// Largest radius of a look-up over the median radius at photons: where photons are sparse, an estimate of few in a
/// bounded disc is better than one of many from far around.
const SPARSE: f32 = 3.0;

/// The maps that `photon-map` looks up.
pub struct PhotonMaps {
    /// Light over specular surfaces alone.
    pub caustic: PhotonMap,
    /// All light, or all that is neither direct nor caustic: see `holds_all`.
    pub global: PhotonMap,
    /// Whether the global map holds direct light and caustics, too.
    pub holds_all: bool,
    /// How the caustic map is looked up.
    pub caustic_estimate: Estimate,
    /// How the global map is looked up.
    pub global_estimate: Estimate,
    /// What was traced and kept.
    pub statistics: PhotonStatistics,
}

/// What one map took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MapStatistics {
    /// Photons emitted.
    pub emitted: u64,
    /// Photons kept.
    pub stored: u64,
    /// Memory of the map, bytes.
    pub bytes: u64,
    /// Time to trace the photons; for reports alone.
    pub tracing: Duration,
    /// Time to build the map; for reports alone.
    pub building: Duration,
}

/// What the photon stage did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PhotonStatistics {
    /// The caustic map.
    pub caustic: MapStatistics,
    /// The global map.
    pub global: MapStatistics,
}
