//! Path tracing: one path per pixel and pass, light sampling and BSDF sampling combined by MIS.
//!
//! 1. Walk to the next surface; what lies between is filtered by the medium the path is in.
//! 2. If the surface shines, add its light, weighted against light sampling from the last rough vertex.
//! 3. If the surface is not singular, sample a light and add what reaches the vertex.
//! 4. Go on in a direction drawn from the BSDF. Singular crossings are free: there is no limit on them.
//! 5. Weak paths end by roulette on their throughput without the n² factor, so none dies for being inside glass.

use super::per_pixel::PerPixel;
use super::{Integrator, Prepared, RenderSettings, View};
use crate::direct::{self, DirectLight};
use crate::first_hit;
use crate::in_volume;
use crate::stats::Stats;
use crate::walk::{self, Event, Flown, Vertex};
use hyaline_film::PixelSample;
use hyaline_math::{Ray, Vec3, offset_origin};
use hyaline_sampling::{Sampler, mis};
use hyaline_scattering::{MediumSet, Transport};
use hyaline_spectrum::Spectrum;
use hyaline_world::{World, mask};
use std::sync::atomic::AtomicBool;

/// Bounces after which roulette may end a path; shorter ones carry most of the picture.
const FIRST_ROULETTE_BOUNCE: u32 = 3;

/// Bounces after which roulette ends even paths that lose nothing: in a closed white room they would go on for ever.
const PATIENCE_WITH_BOUNCES: u32 = 128;

/// Singular events in a row after which a path turns to geometric normals: shading normals are not reversible, and
/// light that they let into a mesh may be trapped by total reflection for good.
pub(super) const PATIENCE_WITH_SHADING_NORMALS: u32 = 32;

/// Singular crossings in a row after which roulette ends even lossless paths now and then: light trapped by
/// total reflection for good would never end otherwise.
const PATIENCE_WITH_CROSSINGS: u32 = 4096;

/// Unidirectional path tracing with light sampling.
pub struct PathIntegrator;

impl Integrator for PathIntegrator {
    fn name(&self) -> &'static str {
        "path"
    }

    fn prepare<'w>(
        &self,
        world: &'w World,
        view: &View,
        settings: &RenderSettings,
        _cancel: &AtomicBool,
        _stats: &mut Stats,
    ) -> Box<dyn Prepared + 'w> {
        Box::new(PerPixel { world, view: *view, settings: *settings, estimate: radiance })
    }
}

/// How the path came to where it is, for weighing the lights it hits.
struct LastScatter {
    /// The last vertex at which light sampling was possible, and the density of the direction taken there.
    /// `None` after the camera and after singular vertices: light sampling could not have made the path.
    sampled: Option<(Vec3, f32)>,
}

/// One estimate of the radiance that arrives along `ray`, which starts inside `set`.
///
/// - `first`: receives what the first surface looks like.
pub fn radiance(
    world: &World,
    settings: &RenderSettings,
    mut ray: Ray,
    mut set: MediumSet,
    sampler: &mut Sampler,
    stats: &mut Stats,
    mut first: Option<&mut PixelSample>,
) -> Spectrum {
    let mut result = Spectrum::ZERO;
    let mut throughput = Spectrum::ONE;
    // The n² factors collected so far: radiance inside a medium is larger, but the path is not worth more there.
    let mut index_scale = 1.0;
    let mut last = LastScatter { sampled: None };
    let mut visible = mask::CAMERA;
    let (mut bounces, mut crossings) = (0, 0);
    loop {
        let event = if world.has_volumes {
            let (flown, emitted) = walk::fly(world, &ray, visible, &mut set, throughput, sampler, stats);
            result += throughput * emitted;
            match flown {
                Flown::Arrived(event) => event,
                Flown::Scattered(place) => {
                    first = None;
                    throughput *= place.weight;
                    let wo = -ray.direction;
                    if settings.max_depth.is_none_or(|limit| bounces < limit) {
                        let light = in_volume::sample_one_light(world, &place, wo, &set, sampler, stats);
                        result += throughput * light;
                    }
                    bounces += 1;
                    crossings = 0;
                    let weight = throughput.max_lane(world.lanes) / index_scale;
                    let roulette = sampler.next_1d();
                    match survival(weight, bounces, crossings) {
                        q if roulette >= q => break,
                        q => throughput *= 1.0 / q,
                    }
                    if settings.max_depth.is_some_and(|limit| bounces > limit) {
                        break;
                    }
                    let phase = in_volume::phase_at(world, &place);
                    let wi = phase.sample(wo, sampler.next_2d());
                    last.sampled = Some((place.p, phase.value(wo, wi)));
                    ray = Ray { time: ray.time, ..Ray::new(place.p, wi) };
                    visible = mask::PATH;
                    continue;
                }
            }
        } else {
            walk::advance(world, &ray, visible, &mut set, stats)
        };
        let mut vertex = match event {
            Event::Sky { transmittance } => {
                let light = direct::sky_radiance(world, &ray, last.sampled, visible);
                result += throughput * transmittance * light;
                break;
            }
            Event::Surface(vertex) => vertex,
        };
        if crossings > PATIENCE_WITH_SHADING_NORMALS {
            vertex.bsdf = vertex.bsdf.without_shading_normal();
        }
        throughput *= vertex.transmittance;
        if let Some(sample) = first.take() {
            first_hit::record(sample, &vertex, &ray);
        }
        result += throughput * emitted(world, &vertex, &ray, &last);

        let wo = -ray.direction;
        if !vertex.bsdf.is_delta() && settings.max_depth.is_none_or(|limit| bounces < limit) {
            let light = DirectLight { world, vertex: &vertex, wo, set: &set, use_mis: true };
            result += throughput * light.sample_one(sampler, stats);
        }
        let (u_lobe, u) = (sampler.next_1d(), sampler.next_2d());
        let Some(scattered) = vertex.bsdf.sample(wo, u_lobe, u, Transport::Radiance) else { break };
        throughput *= scattered.weight;
        index_scale *= scattered.eta_scale;
        if throughput.is_zero() {
            break;
        }
        if scattered.is_delta {
            crossings += 1;
            last.sampled = None;
        } else {
            bounces += 1;
            crossings = 0;
            last.sampled = Some((vertex.hit.p, scattered.pdf));
        }
        if settings.max_depth.is_some_and(|limit| bounces > limit) {
            break;
        }
        let roulette = sampler.next_1d();
        match survival(throughput.max_lane(world.lanes) / index_scale, bounces, crossings) {
            q if roulette >= q => break,
            q => throughput *= 1.0 / q,
        }
        ray = leave(&vertex, scattered.wi, ray.time);
        if scattered.transmits {
            vertex.commit(world, &mut set);
        }
        visible = mask::PATH;
    }
    result
}

/// The ray that leaves a vertex.
fn leave(vertex: &Vertex, wi: Vec3, time: f32) -> Ray {
    let origin = offset_origin(vertex.hit.p, vertex.hit.p_error, vertex.hit.ng, wi);
    Ray { time, ..Ray::new(origin, wi) }
}

/// Light of the surface hit, towards the start of `ray`.
fn emitted(world: &World, vertex: &Vertex, ray: &Ray, last: &LastScatter) -> Spectrum {
    let Some(index) = vertex.light else { return Spectrum::ZERO };
    let light = world.lights.get(index as usize);
    let radiance = light.radiance_from(&vertex.hit, -ray.direction);
    if radiance.is_zero() {
        return radiance;
    }
    match last.sampled {
        None => radiance,
        Some((p, pdf)) => {
            let pdf_light = world.lights.direct().probability(index as usize)
                * light.pdf_direct(p, ray.direction, Some(&vertex.hit));
            radiance * mis::power(pdf, pdf_light)
        }
    }
}

/// Probability that a path goes on, given its largest lane without the n² factors.
pub(super) fn survival(weight: f32, bounces: u32, crossings: u32) -> f32 {
    if crossings > PATIENCE_WITH_CROSSINGS {
        return weight.clamp(0.05, 0.95);
    }
    if bounces > PATIENCE_WITH_BOUNCES {
        return weight.clamp(0.0, 0.95);
    }
    if bounces < FIRST_ROULETTE_BOUNCE && weight > 1e-3 { 1.0 } else { weight.clamp(0.0, 1.0) }
}
