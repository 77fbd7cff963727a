//! Photons that have come over polished surfaces, traced once to learn from: where they landed, and where they came from.
//!
//! A few go first. Where many of them miss all that is polished, or are lost on the way, the rest start as those did that
//! arrived: light of the sky that a wall keeps from the glass teaches nothing.

use crate::RenderSettings;
use crate::integrator::merging::projection_cells;
use crate::photon::guide::Guide;
use crate::photon::{MapKind, Photon, PhotonEmitter, PhotonKind, PhotonTracer};
use crate::shadow;
use crate::stats::Stats;
use hyaline_math::{Ray, Vec3};
use hyaline_sampling::{Sampler, SamplerKind};
use hyaline_scene::ProjectionMaps;
use hyaline_world::{World, mask};
use rayon::prelude::*;
use std::sync::atomic::AtomicBool;

/// Photons that are sent out for each pixel.
const PHOTONS_PER_PIXEL: u32 = 4;
/// Photons that are sent out, at least and at most.
const PHOTONS: [u32; 2] = [1 << 15, 1 << 19];
/// Those that go first, of all.
const FIRST: u32 = 4;
/// Gain of density from which on the first lead the rest: paths of those that arrive cost more.
const LEAST_GAIN: f64 = 1.5;
/// How far a photon is moved back before the way it came is looked for, over its coordinates.
const STEP: f32 = 1e-5;

/// A photon's last straight way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arrival {
    pub(super) landed: Vec3,
    /// Where it left the surface before.
    pub(super) left: Vec3,
    /// W.
    pub(super) power: f32,
}

/// Photons on wide surfaces.
#[derive(Clone, Debug, Default)]
pub(super) struct Arrivals {
    /// That polished surfaces alone have sent here.
    pub(super) caustic: Vec<Arrival>,
    /// That have made a caustic elsewhere, and have been scattered once, there.
    pub(super) thrown: Vec<Arrival>,
}

/// Traces photons, the same for any number of threads.
pub(super) fn arrivals(
    world: &World,
    pixels: u32,
    settings: &RenderSettings,
    cancel: &AtomicBool,
    stats: &mut Stats,
) -> Arrivals {
    let emitter = PhotonEmitter::new(world, ProjectionMaps::Cells, projection_cells(pixels));
    if emitter.fraction() == 0.0 || !world.lights.any_can_be_met() {
        return Arrivals::default();
    }
    let max_bounces = settings.max_depth.map_or(u32::MAX, |limit| limit.saturating_sub(1));
    let (map, seed) = (MapKind::Caustic, settings.seed);
    let mut tracer =
        PhotonTracer { world, emitter: &emitter, map, seed, max_bounces, guide: Guide::default() };
    let count = pixels.saturating_mul(PHOTONS_PER_PIXEL).clamp(PHOTONS[0], PHOTONS[1]);
    let worth = |photon: &Photon| match photon.kind {
        PhotonKind::Caustic => photon.flux.mean(world.lanes),
        PhotonKind::Direct | PhotonKind::Indirect => 0.0,
    };
    tracer.guide = Guide::learn(&tracer.starts(count / FIRST, worth, cancel, stats), LEAST_GAIN);
    let photons = tracer.trace(count, cancel, stats);
    stats.rays += photons.len() as u64;
    let of_kind = |kind| {
        let photons = photons.par_iter().filter(move |photon| photon.kind == kind);
        photons.filter_map(|photon| arrival(world, photon)).collect()
    };
    Arrivals { caustic: of_kind(PhotonKind::Caustic), thrown: of_kind(PhotonKind::Indirect) }
}

/// Irradiance by lamps and sky about where a photon has landed, W per square scene unit, mean of the lanes: one sample.
///
/// Walls keep it off; what dims it on the way is left out of account.
///
/// - `number`: of the sample.
pub(super) fn irradiance_of_lamps(world: &World, arrival: &Arrival, number: usize) -> f32 {
    let mut sampler = Sampler::new(SamplerKind::Sobol, 0, (u32::MAX, 0), number as u32);
    let (u_choice, u) = (sampler.next_1d(), sampler.next_2d());
    let (p, way) = (arrival.landed, arrival.left - arrival.landed);
    let step = STEP * p.abs().max_element();
    let back = way.normalize_or(Vec3::Z);
    let above = p + back * step;
    let onto = Ray { t_max: 2.0 * step, ..Ray::new(above, -back) };
    let found = world.geometry.closest(&onto, mask::PATH);
    let n = found.map_or(back, |candidate| world.geometry.surface(&onto, &candidate).ng);
    let n = if n.dot(back) < 0.0 { -n } else { n };
    let Some(choice) = world.lights.direct().sample(u_choice) else { return 0.0 };
    let Some(sample) = world.lights.get(choice.index).sample_direct(p, u) else { return 0.0 };
    let cos = sample.wi.dot(n);
    if cos <= 0.0 || world.geometry.occluded(&shadow::ray_from(above, &sample, 0.0), mask::BLOCKS) {
        return 0.0;
    }
    sample.radiance.mean(world.lanes) * cos / (sample.pdf_w * choice.probability)
}

fn arrival(world: &World, photon: &Photon) -> Option<Arrival> {
    let back = -photon.direction;
    let ray = Ray::new(photon.p + back * (STEP * photon.p.abs().max_element()), back);
    let candidate = world.geometry.closest(&ray, mask::PATH)?;
    let left = world.geometry.surface(&ray, &candidate).p;
    Some(Arrival { landed: photon.p, left, power: photon.flux.mean(world.lanes) })
}
