//! Path tracing: one path per pixel and pass, light sampling and BSDF sampling combined by MIS.
//!
//! 1. Walk to the next surface; what lies between is filtered by the medium the path is in.
//! 2. If the surface shines, add its light, weighted against light sampling from the last rough vertex; not where
//!    that vertex's shadow rays came this way alone, through surfaces with straight shadows.
//! 3. If the surface is not singular, sample a light and add what reaches the vertex.
//! 4. Go on in a direction drawn from the BSDF. Singular crossings are free: there is no limit on them.
//! 5. Weak paths end by roulette on their throughput without the n² factor, so none dies for being inside glass.

use super::per_pixel::PerPixel;
use super::{Integrator, Prepared, RenderSettings, View};
use crate::direct::{self, DirectLight, LastScatter};
use crate::first_hit;
use crate::in_volume;
use crate::roulette::{PATIENCE_WITH_SHADING_NORMALS, eye_survival};
use crate::stats::Stats;
use crate::walk::{self, Event, Flown};
use hyaline_film::PixelSample;
use hyaline_math::Ray;
use hyaline_sampling::Sampler;
use hyaline_scattering::{MediumSet, Transport};
use hyaline_spectrum::Spectrum;
use hyaline_world::{World, mask};
use std::sync::atomic::AtomicBool;

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
    let mut last = LastScatter::default();
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
                    match eye_survival(weight, bounces, crossings) {
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
                if !last.is_covered {
                    let light = direct::sky_radiance(world, &ray, last.sampled, visible);
                    result += throughput * transmittance * light;
                }
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
        if !last.is_covered {
            result += throughput * direct::surface_radiance(world, &vertex, &ray, last.sampled);
        }

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
        last.record(&vertex, &scattered);
        if scattered.is_delta {
            crossings += 1;
        } else {
            bounces += 1;
            crossings = 0;
        }
        if settings.max_depth.is_some_and(|limit| bounces > limit) {
            break;
        }
        let roulette = sampler.next_1d();
        match eye_survival(throughput.max_lane(world.lanes) / index_scale, bounces, crossings) {
            q if roulette >= q => break,
            q => throughput *= 1.0 / q,
        }
        ray = vertex.leave(scattered.wi, ray.time);
        if scattered.transmits {
            vertex.commit(world, &mut set);
        }
        visible = mask::PATH;
    }
    result
}
