//! Photons traced in small scenes, and estimates from them.
#![allow(dead_code, unreachable_pub, reason = "each test file uses its own part, and a test exports nothing")]

use hyaline_math::DVec3;
use hyaline_scene::{Collection, ProjectionMaps};
use hyaline_transport::Stats;
use hyaline_transport::photon::emission::PhotonEmitter;
use hyaline_transport::photon::gather::{Estimate, PhotonMap};
use hyaline_transport::photon::guide::Guide;
use hyaline_transport::photon::kernel::Kernel;
use hyaline_transport::photon::record::Photon;
use hyaline_transport::photon::trace::{MapKind, PhotonTracer};
use hyaline_transport::photon::tree::Nearest;
use hyaline_world::World;
use std::sync::atomic::AtomicBool;

/// Photons of one map.
pub fn trace(world: &World, map: MapKind, count: u32) -> Vec<Photon> {
    let projection = if map == MapKind::Caustic { ProjectionMaps::Cells } else { ProjectionMaps::None };
    let emitter = PhotonEmitter::new(world, projection, 64);
    let guide = Guide::default();
    let tracer = PhotonTracer { world, emitter: &emitter, map, seed: 1, max_bounces: 1000, guide };
    let mut stats = Stats::default();
    let photons = tracer.trace(count, &AtomicBool::new(false), &mut stats);
    assert!(stats.never_entered.is_empty(), "left what was never entered: {:?}", stats.never_entered);
    assert_eq!(stats.photons, u64::from(count));
    photons
}

/// All power of some photons, W, mean of the lanes.
pub fn power(photons: &[Photon]) -> f64 {
    photons.iter().map(|photon| f64::from(photon.flux.mean(3))).sum()
}

/// Irradiance of the side of a surface that `n` points to, from the photons within `radius`.
pub fn irradiance(map: &PhotonMap, p: DVec3, n: DVec3, radius: f32) -> f64 {
    let estimate = Estimate {
        kernel: Kernel::Constant,
        nearest: usize::MAX / 2,
        max_radius: radius,
        collection: Collection::Disc { thickness: 0.25 },
    };
    let found = estimate.irradiance(map, p.as_vec3(), n.as_vec3(), |_| true, &mut Nearest::default());
    assert!(found.found > 300, "only {} photons at {p}", found.found);
    f64::from(found.value.mean(3))
}

/// Fails unless the two agree within a fraction.
pub fn assert_close(value: f64, expected: f64, tolerance: f64, what: &str) {
    let error = value / expected - 1.0;
    assert!(error.abs() < tolerance, "{what}: {value}, expected {expected}: off by {error}");
}
