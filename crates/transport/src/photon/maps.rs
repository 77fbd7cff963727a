//! The photon maps of a render: traced once, looked up by every pass.

use super::emission::PhotonEmitter;
use super::gather::{Estimate, PhotonMap};
use super::record::{Photon, PhotonKind};
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
    /// What caustics throw on other surfaces: few rays that gather would meet them, and each would bring a lot.
    pub rebound: PhotonMap,
    /// All light, or all that is neither direct nor caustic: see `holds_all`.
    pub global: PhotonMap,
    /// Whether the global map holds direct light and caustics, too.
    pub holds_all: bool,
    /// How the caustic map is looked up.
    pub caustic_estimate: Estimate,
    /// How the map of what caustics throw is looked up.
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
    /// The map of what caustics throw on other surfaces, from the same photons.
    pub rebound: MapStatistics,
    /// The global map.
    pub global: MapStatistics,
}

impl PhotonMaps {
    /// Traces and builds the maps that the settings ask for; stops early, with fewer photons, when `cancel` is set.
    pub fn new(world: &World, settings: &RenderSettings, cancel: &AtomicBool, stats: &mut Stats) -> Self {
        let asked = &settings.photon_map;
        let holds_all = asked.final_gather && !asked.exclude_direct;
        let kind = if holds_all { MapKind::Global } else { MapKind::Indirect };
        let caustics = Traced::new(world, settings, MapKind::Caustic, cancel, stats);
        let (caustic, rebound) = caustics.split(|photon| photon.kind == PhotonKind::Caustic);
        let [caustic, rebound, global] =
            [caustic, rebound, Traced::new(world, settings, kind, cancel, stats)].map(|t| t.build(asked));
        Self {
            caustic_estimate: estimate(asked, &caustic.0, asked.nearest.caustic),
            rebound_estimate: estimate(asked, &rebound.0, asked.nearest.caustic),
            global_estimate: estimate(asked, &global.0, asked.nearest.global),
            statistics: PhotonStatistics { caustic: caustic.1, rebound: rebound.1, global: global.1 },
            caustic: caustic.0,
            rebound: rebound.0,
            global: global.0,
            holds_all,
        }
    }
}

/// Photons for a map.
struct Traced {
    photons: Vec<Photon>,
    emitted: u32,
    time: Duration,
}

impl Traced {
    fn new(
        world: &World,
        settings: &RenderSettings,
        map: MapKind,
        cancel: &AtomicBool,
        stats: &mut Stats,
    ) -> Self {
        let (asked, begun) = (&settings.photon_map, Instant::now());
        let (count, projection) = match map {
            MapKind::Caustic => (asked.caustic_photons, asked.projection),
            MapKind::Global | MapKind::Indirect => (asked.global_photons, ProjectionMaps::None),
        };
        let emitter = PhotonEmitter::new(world, projection, asked.projection_cells);
        // Where no light reaches anything specular there are no caustics.
        let emitted = if emitter.fraction() > 0.0 { count } else { 0 };
        let (seed, max_bounces) = (settings.seed, max_bounces(settings, map));
        let tracer = PhotonTracer { world, emitter: &emitter, map, seed, max_bounces };
        Self { photons: tracer.trace(emitted, cancel, stats), emitted, time: begun.elapsed() }
    }

    /// Those for which `is_first` holds, and the others. The time goes to the first.
    fn split(self, is_first: impl Fn(&Photon) -> bool) -> (Self, Self) {
        let (first, others) = self.photons.into_iter().partition(is_first);
        (
            Self { photons: first, ..self },
            Self { photons: others, emitted: self.emitted, time: Duration::ZERO },
        )
    }

    fn build(self, asked: &PhotonMapSettings) -> (PhotonMap, MapStatistics) {
        let begun = Instant::now();
        let map = PhotonMap::from_photons(&self.photons, asked.leaf_size);
        let statistics = MapStatistics {
            emitted: u64::from(self.emitted),
            stored: self.photons.len() as u64,
            bytes: map.bytes() as u64,
            tracing: self.time,
            building: begun.elapsed(),
        };
        (map, statistics)
    }
}

/// Bounces of photons: with those of the eye they make no longer paths than asked for, but where rays gather more than
/// once.
fn max_bounces(settings: &RenderSettings, map: MapKind) -> u32 {
    let by_eye = match map {
        MapKind::Global | MapKind::Indirect if settings.photon_map.final_gather => 2,
        MapKind::Caustic | MapKind::Global | MapKind::Indirect => 1,
    };
    let by_depth = settings.max_depth.map_or(u32::MAX, |limit| limit.saturating_sub(by_eye));
    settings.photon_map.max_bounces.min(by_depth)
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
