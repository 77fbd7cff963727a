//! Paths from the eye, which gather photons on their way.

use super::footprint::Footprint;
use super::light::{self, CausticPhoton, Landed};
use super::weight::{self, SideOfChain};
use crate::direct::LastScatter;
use crate::photon::PhotonEmitter;
use crate::photon::radius::Shrink;
use crate::photon::specular::is_specular;
use crate::photon::tree::{PointTree, Region};
use crate::roulette::{PATIENCE_WITH_SHADING_NORMALS, eye_survival};
use crate::walk::{self, Event, Flown, Vertex, VolumeVertex};
use crate::{RenderSettings, Stats, first_hit, in_volume, shadow};
use hyaline_film::PixelSample;
use hyaline_math::{Ray, Vec3};
use hyaline_sampling::Sampler;
use hyaline_scattering::{BsdfSample, MediumSet, Transport};
use hyaline_spectrum::Spectrum;
use hyaline_world::camera::PixelSpread;
use hyaline_world::light::DirectSample;
use hyaline_world::{World, mask};
use std::f32::consts::PI;

/// What the paths of a pass share.
pub(super) struct Eye<'a> {
    pub(super) world: &'a World,
    pub(super) settings: &'a RenderSettings,
    pub(super) emitter: &'a PhotonEmitter<'a>,
    pub(super) landed: &'a Landed,
    pub(super) shrink: Shrink,
    pub(super) spread: PixelSpread,
}

/// The vertex of a path at which photons would be merged, and what lies behind it.
#[derive(Clone, Copy)]
struct Receiver {
    /// Density of merging over that of hitting the light, but for the factor of the light.
    ratio: f32,
    /// Polished and nearly polished vertices since.
    chain: u32,
}

/// A path under way.
struct Path {
    ray: Ray,
    set: MediumSet,
    throughput: Spectrum,
    /// The n² factors collected so far.
    index_scale: f32,
    last: LastScatter,
    receiver: Option<Receiver>,
    footprint: Footprint,
    visible: u8,
    bounces: u32,
    crossings: u32,
}

impl Eye<'_> {
    /// One estimate of the radiance that arrives along `ray`, which starts inside `set`.
    pub(super) fn radiance(
        &self,
        ray: Ray,
        set: MediumSet,
        sampler: &mut Sampler,
        stats: &mut Stats,
        sample: &mut PixelSample,
    ) -> Spectrum {
        let mut path = Path {
            ray,
            set,
            throughput: Spectrum::ONE,
            index_scale: 1.0,
            last: LastScatter::default(),
            receiver: None,
            footprint: Footprint::of_pixel(self.spread),
            visible: mask::CAMERA,
            bounces: 0,
            crossings: 0,
        };
        let mut first = Some(sample);
        let mut result = Spectrum::ZERO;
        loop {
            let event = if self.world.has_volumes {
                let (flown, emitted) = walk::fly(
                    self.world,
                    &path.ray,
                    path.visible,
                    &mut path.set,
                    path.throughput,
                    sampler,
                    stats,
                );
                result += path.throughput * emitted;
                match flown {
                    Flown::Arrived(event) => event,
                    Flown::Scattered(place) => {
                        first = None;
                        if !self.at_place(&mut path, &place, &mut result, sampler, stats) {
                            return result;
                        }
                        continue;
                    }
                }
            } else {
                walk::advance(self.world, &path.ray, path.visible, &mut path.set, stats)
            };
            let mut vertex = match event {
                Event::Sky { transmittance } => {
                    return result + path.throughput * transmittance * self.sky(&path);
                }
                Event::Surface(vertex) => vertex,
            };
            if path.crossings > PATIENCE_WITH_SHADING_NORMALS {
                vertex.bsdf = vertex.bsdf.without_shading_normal();
            }
            path.throughput *= vertex.transmittance;
            path.footprint.travel(vertex.distance);
            if let Some(sample) = first.take() {
                first_hit::record(sample, &vertex, &path.ray);
            }
            result += path.throughput * self.emitted(&path, &vertex);
            if !self.at_surface(&mut path, &vertex, &mut result, sampler, stats) {
                return result;
            }
        }
    }

    /// Gathers, samples a light and scatters; returns whether the path goes on.
    fn at_surface(
        &self,
        path: &mut Path,
        vertex: &Vertex,
        result: &mut Spectrum,
        sampler: &mut Sampler,
        stats: &mut Stats,
    ) -> bool {
        let wo = -path.ray.direction;
        let radius = path.footprint.radius() * self.shrink.surface;
        let is_wide = !is_specular(&vertex.bsdf);
        let may_bounce = self.settings.max_depth.is_none_or(|limit| path.bounces < limit);
        if !vertex.bsdf.is_delta() && may_bounce {
            if is_wide || path.receiver.is_none() {
                *result += path.throughput * self.gather(path, vertex, wo, radius);
            }
            *result += path.throughput * self.light(path, vertex, wo, is_wide, sampler, stats);
        }
        let (u_lobe, u) = (sampler.next_1d(), sampler.next_2d());
        let Some(scattered) = vertex.bsdf.sample(wo, u_lobe, u, Transport::Radiance) else { return false };
        path.throughput *= scattered.weight;
        path.index_scale *= scattered.eta_scale;
        if path.throughput.is_zero() {
            return false;
        }
        let ior_before = self.world.ior(path.set.active());
        if scattered.transmits {
            vertex.commit(self.world, &mut path.set);
        }
        path.last.record(vertex, &scattered);
        if scattered.is_delta {
            path.crossings += 1;
            path.receiver.iter_mut().for_each(|receiver| receiver.chain += 1);
        } else {
            path.bounces += 1;
            path.crossings = 0;
            self.pass_rough(path, vertex, &scattered, is_wide, ior_before, radius);
            path.footprint.scatter(scattered.pdf);
        }
        path.ray = vertex.leave(scattered.wi, path.ray.time);
        self.survives(path, sampler)
    }

    /// Keeps the receiver true at a vertex that is not polished.
    fn pass_rough(
        &self,
        path: &mut Path,
        vertex: &Vertex,
        scattered: &BsdfSample,
        is_wide: bool,
        ior_before: f32,
        radius: f32,
    ) {
        let wo = -path.ray.direction;
        let ior = self.world.ior(path.set.active());
        let cos = scattered.wi.dot(vertex.hit.ng).abs();
        path.receiver = Some(match path.receiver {
            Some(receiver) if !is_wide => {
                let toward_light = SideOfChain { pdf: scattered.pdf, ior, cos };
                let toward_receiver = SideOfChain {
                    pdf: vertex.bsdf.pdf(scattered.wi, wo),
                    ior: ior_before,
                    cos: wo.dot(vertex.hit.ng).abs(),
                };
                let ratio = receiver.ratio * weight::across(toward_receiver, toward_light);
                Receiver { ratio, chain: receiver.chain + 1 }
            }
            _ => {
                let ratio = weight::at_receiver(self.landed.sent, radius, ior, cos, scattered.pdf);
                Receiver { ratio, chain: 0 }
            }
        });
    }

    /// Gathers, samples a light and scatters at a particle of a medium; returns whether the path goes on.
    fn at_place(
        &self,
        path: &mut Path,
        place: &VolumeVertex,
        result: &mut Spectrum,
        sampler: &mut Sampler,
        stats: &mut Stats,
    ) -> bool {
        let wo = -path.ray.direction;
        path.throughput *= place.weight;
        path.footprint.travel(place.distance);
        let radius = path.footprint.radius() * self.shrink.volume;
        if self.settings.max_depth.is_none_or(|limit| path.bounces < limit) {
            *result += path.throughput * self.gather_in_volume(place, wo, radius);
            let light = in_volume::sample_one_light(self.world, place, wo, &path.set, sampler, stats);
            *result += path.throughput * light;
        }
        let phase = in_volume::phase_at(self.world, place);
        let wi = phase.sample(wo, sampler.next_2d());
        let pdf = phase.value(wo, wi);
        path.bounces += 1;
        path.crossings = 0;
        path.last = LastScatter { sampled: Some((place.p, pdf)), is_covered: false };
        let ratio = self.volume_ratio(place, radius) / pdf;
        path.receiver = Some(Receiver { ratio, chain: 0 });
        path.footprint.scatter(pdf);
        path.ray = Ray { time: path.ray.time, ..Ray::new(place.p, wi) };
        self.survives(path, sampler)
    }

    /// The factor of a place in a medium, but for the density of the direction.
    fn volume_ratio(&self, place: &VolumeVertex, radius: f32) -> f32 {
        let medium = &self.world.media[place.medium.index()];
        let density = medium.grid.as_ref().map_or(1.0, |grid| grid.density(place.p));
        let sigma = medium.sigma_t().mean(self.world.lanes) * density;
        weight::in_volume(self.landed.sent, radius, medium.ior, sigma, 1.0)
    }

    /// Roulette, once a path has scattered.
    fn survives(&self, path: &mut Path, sampler: &mut Sampler) -> bool {
        path.visible = mask::PATH;
        let roulette = sampler.next_1d();
        let weight = path.throughput.max_lane(self.world.lanes) / path.index_scale;
        let survival = eye_survival(weight, path.bounces, path.crossings);
        if self.settings.max_depth.is_some_and(|limit| path.bounces > limit) || roulette >= survival {
            return false;
        }
        path.throughput *= 1.0 / survival;
        true
    }

    /// Light of the photons about a vertex.
    fn gather(&self, path: &Path, vertex: &Vertex, wo: Vec3, radius: f32) -> Spectrum {
        let hit = &vertex.hit;
        let own = weight::at_receiver(self.landed.sent, radius, 1.0, 1.0, 1.0);
        let ior = self.world.ior(path.set.active());
        let mut sum = Spectrum::ZERO;
        visit(&self.landed.surface, hit.p, radius, |photon| {
            let wi = -photon.direction;
            let cos = wi.dot(hit.ng).abs();
            let f = vertex.bsdf.eval(wo, wi, Transport::Radiance);
            if f.is_zero() || cos == 0.0 {
                return;
            }
            let crosses = (wi.dot(hit.ng) > 0.0) != (wo.dot(hit.ng) > 0.0);
            let ior =
                if crosses { self.world.ior(vertex.far_set(self.world, &path.set).active()) } else { ior };
            let ratio = own * ior * ior * cos / vertex.bsdf.pdf(wo, wi);
            sum += f * photon.flux * (weight::power(photon.others / (ratio * ratio)) / cos);
        });
        sum * (1.0 / (PI * radius * radius))
    }

    /// The same at a particle of a medium.
    fn gather_in_volume(&self, place: &VolumeVertex, wo: Vec3, radius: f32) -> Spectrum {
        if self.landed.volume.is_empty() {
            return Spectrum::ZERO;
        }
        let medium = &self.world.media[place.medium.index()];
        let density = medium.grid.as_ref().map_or(1.0, |grid| grid.density(place.p));
        let own = self.volume_ratio(place, radius);
        let mut sum = Spectrum::ZERO;
        visit(&self.landed.volume, place.p, radius, |photon| {
            let phase = medium.phase.value(wo, -photon.direction);
            let ratio = own / phase;
            sum += photon.flux * (phase * weight::power(photon.others / (ratio * ratio)));
        });
        // Photons count what they scatter; what the path scatters is in its throughput already.
        let sigma_s = (medium.sigma_s * density).map(|sigma| if sigma > 0.0 { 1.0 / sigma } else { 0.0 });
        sum * sigma_s * (1.0 / (4.0 / 3.0 * PI * radius * radius * radius))
    }

    /// Light of one light, chosen at random, by a shadow ray.
    fn light(
        &self,
        path: &Path,
        vertex: &Vertex,
        wo: Vec3,
        is_wide: bool,
        sampler: &mut Sampler,
        stats: &mut Stats,
    ) -> Spectrum {
        let (u_choice, u) = (sampler.next_1d(), sampler.next_2d());
        let lights = &self.world.lights;
        let Some(choice) = lights.direct().sample(u_choice) else { return Spectrum::ZERO };
        let light = lights.get(choice.index);
        let hit = &vertex.hit;
        let Some(sample) = light.sample_direct(hit.p, u) else { return Spectrum::ZERO };
        let contribution = vertex.bsdf.eval(wo, sample.wi, Transport::Radiance) * sample.radiance;
        if contribution.is_zero() {
            return contribution;
        }
        let crosses = (sample.wi.dot(hit.ng) > 0.0) != (wo.dot(hit.ng) > 0.0);
        let far = crosses.then(|| vertex.far_set(self.world, &path.set));
        let set = far.as_ref().unwrap_or(&path.set);
        let density = sample.pdf_w * choice.probability;
        let pdf = vertex.bsdf.pdf(wo, sample.wi);
        let hitting = if sample.is_delta { 0.0 } else { pdf / density };
        let merging = match path.receiver {
            Some(receiver) if !is_wide => {
                let toward_light = SideOfChain {
                    // For lights that no path hits, sampling stands where drawing the direction would.
                    pdf: if sample.is_delta { choice.probability } else { density },
                    ior: self.world.ior(set.active()),
                    cos: sample.wi.dot(hit.ng).abs(),
                };
                let toward_receiver = SideOfChain {
                    pdf: vertex.bsdf.pdf(sample.wi, wo),
                    ior: self.world.ior(path.set.active()),
                    cos: wo.dot(hit.ng).abs(),
                };
                let across = weight::across(toward_receiver, toward_light);
                receiver.ratio * across * self.emission_of(choice.index, &sample, set)
            }
            _ => 0.0,
        };
        let weight = weight::power(hitting * hitting + merging * merging);
        let ray = shadow::ray_to_light(hit, &sample, 0.0);
        let way = shadow::straight_way(self.world, &ray, set, stats);
        contribution * (way.shared * weight + way.alone) * (1.0 / density)
    }

    /// Light of the surface that the path hits.
    fn emitted(&self, path: &Path, vertex: &Vertex) -> Spectrum {
        let Some(index) = vertex.light.filter(|_| !path.last.is_covered) else { return Spectrum::ZERO };
        let light = self.world.lights.get(index as usize);
        let (hit, direction) = (&vertex.hit, path.ray.direction);
        let radiance = light.radiance_from(hit, -direction);
        if radiance.is_zero() {
            return radiance;
        }
        let sampling = path.last.sampled.map_or(0.0, |(p, pdf)| {
            let chance = self.world.lights.direct().probability(index as usize);
            chance * light.pdf_direct(p, direction, Some(hit)) / pdf
        });
        let merging = self.merging(path, index as usize, Some(hit.ng));
        radiance * weight::power(sampling * sampling + merging * merging)
    }

    /// Light of the surroundings.
    fn sky(&self, path: &Path) -> Spectrum {
        let mut result = Spectrum::ZERO;
        if path.last.is_covered {
            return result;
        }
        let lights = &self.world.lights;
        let seen = if path.visible == mask::CAMERA { &self.world.camera_sky } else { lights.environments() };
        for &index in seen {
            let light = lights.get(index as usize);
            let sampling = path.last.sampled.map_or(0.0, |(p, pdf)| {
                lights.direct().probability(index as usize) * light.pdf_direct(p, path.ray.direction, None)
                    / pdf
            });
            let merging = self.merging(path, index as usize, None);
            let weight = weight::power(sampling * sampling + merging * merging);
            result += light.radiance_of_sky(path.ray.direction) * weight;
        }
        result
    }

    /// Density of merging over that of hitting the light that the path has come to.
    fn merging(&self, path: &Path, index: usize, n: Option<Vec3>) -> f32 {
        match path.receiver {
            Some(receiver) if receiver.chain > 0 => {
                let direction = -path.ray.direction;
                let density =
                    light::emission_density(self.world, self.emitter, index, n, direction, &path.set);
                receiver.ratio * density
            }
            _ => 0.0,
        }
    }

    /// The factor of a light that was sampled.
    fn emission_of(&self, index: usize, sample: &DirectSample, set: &MediumSet) -> f32 {
        let n = sample.target.map(|target| target.n);
        let density = light::emission_density(self.world, self.emitter, index, n, -sample.wi, set);
        let is_point = sample.is_delta && sample.distance.is_finite();
        // For a point the square of the way stands for the cosine.
        if is_point { density / (sample.distance * sample.distance) } else { density }
    }
}

/// Every photon within a radius.
fn visit(tree: &PointTree<CausticPhoton>, center: Vec3, radius: f32, mut f: impl FnMut(&CausticPhoton)) {
    let region = Region { center, radius, disc: None };
    tree.within(&region, &mut |index, _| f(tree.payload(index)));
}
