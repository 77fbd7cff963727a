//! The photon maps of a render: traced once, looked up by every pass.

use super::clip::Clip;
use super::emission::PhotonEmitter;
use super::gather::{Estimate, PhotonMap};
use super::guide::Guide;
use super::record::{Photon, PhotonKind};
use super::stopwatch::TotalTime;
use super::trace::{MapKind, PhotonTracer};
use super::tree::Nearest;
use super::volume::VolumeMaps;
use crate::RenderSettings;
use crate::stats::Stats;
use hyaline_scattering::Medium;
use hyaline_scene::{PhotonMapSettings, ProjectionMaps};
use hyaline_world::World;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// Photons at which a map is asked how far its photons lie apart.
const PROBES: usize = 1024;

/// Largest radius of a look-up over the median radius at photons: where photons are sparse, an estimate of few in a
/// bounded disc is better than one of many from far around.
const SPARSE: f32 = 2.0;

/// Photons that the caustic map's estimate takes for each that the estimate of what caustics throw takes: that light is
/// dim, and wide estimates would carry it into shadows where it is all that there is.
const CAUSTIC_PER_REBOUND: u32 = 3;

/// Photons that the volume map keeps at most for each that is emitted, about: where each scatters oftener, as in milk, one
/// in so many is kept, with the power of all.
const KEPT_PER_VOLUME_PHOTON: f32 = 4.0;

/// Photons that are traced to learn how often they scatter.
const PILOT: u32 = 4096;

/// The maps that `photon-map` looks up.
pub struct PhotonMaps {
    /// Light over specular surfaces alone.
    pub caustic: PhotonMap,
    /// What caustics throw on other surfaces: few rays that gather would meet them, and each would bring a lot.
    pub rebound: PhotonMap,
    /// All light, or all that is neither direct nor caustic: see `holds_all`.
    pub global: PhotonMap,
    /// Light that media scatter; see `PhotonMapSettings::exclude_single_scattering` for what comes straight.
    pub volume: VolumeMaps,
    /// Whether the global map holds direct light and caustics, too.
    pub holds_all: bool,
    /// How the caustic map is looked up.
    pub caustic_estimate: Estimate,
    /// How the map of what caustics throw is looked up.
    pub rebound_estimate: Estimate,
    /// How the global map is looked up.
    pub global_estimate: Estimate,
    /// What was traced and kept; without look-ups, see `statistics_so_far`.
    pub statistics: PhotonStatistics,
    /// Time spent on look-ups.
    pub look_ups: LookUpTimes,
}

/// Time spent on look-ups, by map; for reports alone.
#[derive(Debug, Default)]
pub struct LookUpTimes {
    /// Of the caustic map and of what caustics throw.
    pub caustic: TotalTime,
    /// Of the global map.
    pub global: TotalTime,
    /// Of the volume map.
    pub volume: TotalTime,
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
    /// Estimates made from the map so far.
    pub look_ups: u64,
    /// Time that they took, all threads together; for reports alone.
    pub looking_up: Duration,
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
    /// The volume map, all media together.
    pub volume: MapStatistics,
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
        let volume = volume_maps(world, settings, cancel, stats);
        Self {
            caustic_estimate: estimate(asked, &caustic.0, asked.nearest.caustic),
            rebound_estimate: estimate(
                asked,
                &rebound.0,
                (asked.nearest.caustic / CAUSTIC_PER_REBOUND).max(2),
            ),
            global_estimate: estimate(asked, &global.0, asked.nearest.global),
            statistics: PhotonStatistics {
                caustic: caustic.1,
                rebound: rebound.1,
                global: global.1,
                volume: volume.1,
            },
            caustic: caustic.0,
            rebound: rebound.0,
            global: global.0,
            volume: volume.0,
            holds_all,
            look_ups: LookUpTimes::default(),
        }
    }

    /// What was traced, kept and looked up so far.
    pub fn statistics_so_far(&self) -> PhotonStatistics {
        let LookUpTimes { caustic, global, volume } = &self.look_ups;
        let with = |map: MapStatistics, total: &TotalTime| MapStatistics {
            look_ups: total.calls(),
            looking_up: total.time(),
            ..map
        };
        let told = self.statistics;
        PhotonStatistics {
            caustic: with(told.caustic, caustic),
            global: with(told.global, global),
            volume: with(told.volume, volume),
            ..told
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
            _ => (asked.global_photons, ProjectionMaps::None),
        };
        let emitter = PhotonEmitter::new(world, projection, asked.projection_cells);
        let tracer = tracer(world, settings, &emitter, map);
        let emitted = worth_emitting(&emitter, count);
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
            ..MapStatistics::default()
        };
        (map, statistics)
    }
}

/// Photons to emit of those asked for: where no light reaches anything specular there are no caustics.
fn worth_emitting(emitter: &PhotonEmitter<'_>, asked: u32) -> u32 {
    if emitter.fraction() > 0.0 { asked } else { 0 }
}

fn tracer<'w>(
    world: &'w World,
    settings: &RenderSettings,
    emitter: &'w PhotonEmitter<'w>,
    map: MapKind,
) -> PhotonTracer<'w> {
    let (max_bounces, guide) = (max_bounces(settings, map), Guide::default());
    PhotonTracer { world, emitter, map, seed: settings.seed, max_bounces, guide }
}

/// Traces and builds the maps of media that scatter.
fn volume_maps(
    world: &World,
    settings: &RenderSettings,
    cancel: &AtomicBool,
    stats: &mut Stats,
) -> (VolumeMaps, MapStatistics) {
    if !world.media.iter().any(Medium::scatters) {
        return Default::default();
    }
    let (asked, begun) = (&settings.photon_map, Instant::now());
    let emitter = PhotonEmitter::new(world, ProjectionMaps::None, asked.projection_cells);
    let emitted = worth_emitting(&emitter, asked.volume_photons);
    let trace = |share: f32, count: u32, stats: &mut Stats| {
        let map = MapKind::Volume { with_direct: !asked.exclude_single_scattering, share };
        tracer(world, settings, &emitter, map).trace_in_media(count, cancel, stats)
    };
    let pilot = emitted.min(PILOT);
    let kept = trace(1.0, pilot, &mut Stats::default()).len() as f32 / pilot.max(1) as f32;
    let share = if kept > KEPT_PER_VOLUME_PHOTON { KEPT_PER_VOLUME_PHOTON / kept } else { 1.0 };
    let photons = trace(share, emitted, stats);
    let (tracing, begun) = (begun.elapsed(), Instant::now());
    let maps = VolumeMaps::new(&photons, asked.leaf_size, |map| volume_estimate(asked, map));
    let statistics = MapStatistics {
        emitted: u64::from(emitted),
        stored: photons.len() as u64,
        bytes: maps.iter().map(|volume| volume.map.bytes() as u64).sum(),
        tracing,
        building: begun.elapsed(),
        ..MapStatistics::default()
    };
    (maps, statistics)
}

/// Bounces of photons: with those of the eye they make no longer paths than asked for, but for where rays gather more than
/// once, or end in a medium.
fn max_bounces(settings: &RenderSettings, map: MapKind) -> u32 {
    let by_eye = match map {
        MapKind::Global | MapKind::Indirect if settings.photon_map.final_gather => 2,
        _ => 1,
    };
    let by_depth = settings.max_depth.map_or(u32::MAX, |limit| limit.saturating_sub(by_eye));
    settings.photon_map.max_bounces.min(by_depth)
}

/// How a map of surfaces is looked up.
fn estimate(asked: &PhotonMapSettings, map: &PhotonMap, nearest: u32) -> Estimate {
    bounded(asked, map, nearest, |estimate, photon, scratch| {
        estimate.irradiance(map, photon.p, -photon.direction, |_| true, scratch).radius
    })
}

/// How the map of a medium is looked up.
fn volume_estimate(asked: &PhotonMapSettings, map: &PhotonMap) -> Estimate {
    bounded(asked, map, asked.nearest.volume, |estimate, photon, scratch| {
        estimate.volume(map, photon.p, |_| 1.0, Clip::whole, scratch).radius
    })
}

/// An estimate with a largest radius that fits the map: a multiple of the median radius that look-ups have at its own
/// photons.
///
/// - `radius`: that of a look-up at a photon.
fn bounded(
    asked: &PhotonMapSettings,
    map: &PhotonMap,
    nearest: u32,
    radius: impl Fn(&Estimate, Photon, &mut Nearest) -> f32,
) -> Estimate {
    let unbounded = Estimate {
        kernel: asked.kernel.into(),
        nearest: nearest as usize,
        max_radius: f32::INFINITY,
        collection: asked.collection,
    };
    if let Some(max_radius) = asked.max_radius {
        return Estimate { max_radius: max_radius as f32, ..unbounded };
    }
    // With few photons, all of them are near: an unbounded radius would spread them over infinity.
    let probed = Estimate { nearest: unbounded.nearest.min(map.len() / 2), ..unbounded };
    let (probes, mut scratch) = (map.len().min(PROBES), Nearest::default());
    let mut radii: Vec<f32> = (0..probes)
        .map(|probe| map.photon((probe * map.len() / probes) as u32))
        .map(|photon| radius(&probed, photon, &mut scratch))
        .filter(|radius| radius.is_finite())
        .collect();
    radii.sort_unstable_by(f32::total_cmp);
    let max_radius = radii.get(radii.len() / 2).map_or(f32::MAX.sqrt(), |radius| SPARSE * radius);
    Estimate { max_radius, ..unbounded }
}
