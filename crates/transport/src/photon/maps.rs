//! The photon maps of a render: traced once, looked up by every pass.

use super::emission::PhotonEmitter;
use super::gather::{Estimate, PhotonMap};
use super::trace::{MapKind, PhotonTracer};
use super::tree::Nearest;
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
const SPARSE: f32 = 2.0;

/// The maps that `photon-map` looks up.
pub struct PhotonMaps {
    /// Light over specular surfaces alone.
    pub caustic: PhotonMap,
    /// Caustics as other surfaces are lit by them: few rays that gather would meet them, and each would bring a lot.
    /// Empty where nothing gathers.
    pub rebound: PhotonMap,
    /// All light, or all that is neither direct nor caustic: see `holds_all`.
    pub global: PhotonMap,
    /// Whether the global map holds direct light and caustics, too.
    pub holds_all: bool,
    /// How the caustic map is looked up.
    pub caustic_estimate: Estimate,
    /// How the map of lit caustics is looked up.
    pub rebound_estimate: Estimate,
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
    /// The map of light that caustics throw on other surfaces.
    pub rebound: MapStatistics,
    /// The global map.
    pub global: MapStatistics,
}

impl PhotonMaps {
    /// Traces and builds the maps that the settings ask for; stops early, with fewer photons, when `cancel` is set.
    pub fn new(world: &World, settings: &RenderSettings, cancel: &AtomicBool, stats: &mut Stats) -> Self {
        let asked = &settings.photon_map;
        let holds_all = asked.final_gather && !asked.exclude_direct;
        let stage = Stage { world, settings, cancel };
        let kind = if holds_all { MapKind::Global } else { MapKind::Indirect };
        let (caustic, caustic_statistics) =
            stage.make(MapKind::Caustic, asked.caustic_photons, asked.projection, stats);
        let (rebound, rebound_statistics) =
            stage.make(MapKind::Rebound, asked.caustic_photons / 2, asked.projection, stats);
        let (global, global_statistics) = stage.make(kind, asked.global_photons, ProjectionMaps::None, stats);
        Self {
            caustic_estimate: estimate(asked, &caustic, asked.nearest.caustic),
            rebound_estimate: estimate(asked, &rebound, asked.nearest.caustic),
            global_estimate: estimate(asked, &global, asked.nearest.global),
            caustic,
            rebound,
            global,
            holds_all,
            statistics: PhotonStatistics {
                caustic: caustic_statistics,
                rebound: rebound_statistics,
                global: global_statistics,
            },
        }
    }
}

/// What the making of all maps shares.
struct Stage<'a> {
    world: &'a World,
    settings: &'a RenderSettings,
    cancel: &'a AtomicBool,
}

impl Stage<'_> {
    fn make(
        &self,
        kind: MapKind,
        count: u32,
        projection: ProjectionMaps,
        stats: &mut Stats,
    ) -> (PhotonMap, MapStatistics) {
        let asked = &self.settings.photon_map;
        let begun = Instant::now();
        let emitter = PhotonEmitter::new(self.world, projection, asked.projection_cells);
        // Where no light reaches anything specular there are no caustics.
        let emitted = if emitter.fraction() > 0.0 { count } else { 0 };
        let max_bounces = self.max_bounces();
        let tracer = PhotonTracer {
            world: self.world,
            emitter: &emitter,
            map: kind,
            seed: self.settings.seed,
            max_bounces,
        };
        let photons = tracer.trace(emitted, self.cancel, stats);
        let traced = Instant::now();
        let map = PhotonMap::from_photons(&photons, asked.leaf_size);
        let statistics = MapStatistics {
            emitted: u64::from(emitted),
            stored: photons.len() as u64,
            bytes: map.bytes() as u64,
            tracing: traced - begun,
            building: traced.elapsed(),
        };
        (map, statistics)
    }

    /// Bounces of photons: with those of the eye they make no longer paths than asked for, but where rays gather
    /// more than once.
    fn max_bounces(&self) -> u32 {
        let asked = &self.settings.photon_map;
        let by_eye = if asked.final_gather { 2 } else { 1 };
        let by_depth = self.settings.max_depth.map_or(u32::MAX, |limit| limit.saturating_sub(by_eye));
        asked.max_bounces.min(by_depth)
    }
}

/// How a map is looked up.
fn estimate(asked: &PhotonMapSettings, map: &PhotonMap, nearest: u32) -> Estimate {
    let nearest = nearest as usize;
    let unbounded = Estimate {
        kernel: asked.kernel.into(),
        nearest,
        max_radius: f32::INFINITY,
        collection: asked.collection,
    };
    let max_radius = asked.max_radius.map_or_else(|| bounded_radius(map, unbounded), |radius| radius as f32);
    Estimate { max_radius, ..unbounded }
}

/// A largest radius that fits the map: a multiple of the median radius that look-ups have at its own photons.
fn bounded_radius(map: &PhotonMap, unbounded: Estimate) -> f32 {
    // With few photons, all of them are near: an unbounded radius would spread them over infinity.
    let estimate = Estimate { nearest: unbounded.nearest.min(map.len() / 2), ..unbounded };
    let probes = map.len().min(PROBES);
    let mut scratch = Nearest::default();
    let mut radii: Vec<f32> = (0..probes)
        .map(|probe| {
            let photon = map.photon((probe * map.len() / probes) as u32);
            estimate.irradiance(map, photon.p, -photon.direction, |_| true, &mut scratch).radius
        })
        .filter(|radius| radius.is_finite())
        .collect();
    radii.sort_unstable_by(f32::total_cmp);
    radii.get(radii.len() / 2).map_or(f32::MAX.sqrt(), |radius| SPARSE * radius)
}
