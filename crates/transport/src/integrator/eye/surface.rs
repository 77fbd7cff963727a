//! What a path does at a surface.

use super::weight::{self, SideOfChain};
use super::{Draws, Eye, Path};
use crate::integrator::merging::{Photons, emission_density};
use crate::photon::specular::is_specular;
use crate::shadow;
use crate::walk::Vertex;
use hyaline_math::Vec3;
use hyaline_scattering::{BsdfSample, MediumSet, Transport};
use hyaline_spectrum::Spectrum;
use hyaline_world::light::{DirectSample, LightChoice};
use std::f32::consts::PI;

impl Eye<'_> {
    /// Gathers, samples a light and scatters; returns whether the path goes on.
    pub(super) fn at_surface(&self, path: &mut Path, vertex: &Vertex, draws: &mut Draws<'_>) -> bool {
        let wo = -path.ray.direction;
        let is_wide = !is_specular(&vertex.bsdf);
        let shrink = self.photons.as_ref().map_or(0.0, |photons| photons.shrink.surface);
        let radius = path.footprint.radius() * shrink;
        if !vertex.bsdf.is_delta() && self.may_bounce(path) {
            if let Some(photons) = &self.photons
                && (is_wide || path.receiver.is_none())
            {
                path.light += path.throughput * self.gather(path, vertex, wo, photons, radius);
            }
            path.light += path.throughput * self.sampled_light(path, vertex, wo, is_wide, draws);
        }
        let (u_lobe, u) = (draws.sampler.next_1d(), draws.sampler.next_2d());
        let Some(scattered) = vertex.bsdf.sample(wo, u_lobe, u, Transport::Radiance) else { return false };
        path.throughput *= scattered.weight;
        path.index_scale *= scattered.eta_scale;
        if path.throughput.is_zero() {
            return false;
        }
        self.turn(path, vertex, &scattered, is_wide, radius);
        self.survives(path, draws)
    }

    /// Sends the path on in the direction that was drawn, and keeps all true that weights go by.
    ///
    /// - `radius`: gather radius at the vertex.
    pub(super) fn turn(
        &self,
        path: &mut Path,
        vertex: &Vertex,
        scattered: &BsdfSample,
        is_wide: bool,
        radius: f32,
    ) {
        let ior_before = self.world.ior(path.set.active());
        if scattered.transmits {
            vertex.commit(self.world, &mut path.set);
        }
        path.last.record(vertex, scattered);
        if scattered.is_delta {
            path.crossings += 1;
            path.receiver.iter_mut().for_each(|receiver| receiver.chain += 1);
        } else {
            path.bounces += 1;
            path.crossings = 0;
            self.note_receiver(path, vertex, scattered, is_wide, ior_before, radius);
            path.footprint.scatter(scattered.pdf);
        }
        path.ray = vertex.leave(scattered.wi, path.ray.time);
    }

    /// Light of the photons about a vertex.
    fn gather(&self, path: &Path, vertex: &Vertex, wo: Vec3, photons: &Photons<'_>, radius: f32) -> Spectrum {
        let hit = &vertex.hit;
        let own = weight::at_receiver(photons.landed.sent, radius, 1.0, 1.0, 1.0);
        let ior = self.world.ior(path.set.active());
        let sum = photons.landed.surface(hit.p, radius, |photon| {
            let wi = -photon.direction;
            let cos = wi.dot(hit.ng).abs();
            let f = vertex.bsdf.eval(wo, wi, Transport::Radiance);
            if f.is_zero() || cos == 0.0 {
                return Spectrum::ZERO;
            }
            let ratio = self.photon_ratio(path, vertex, wo, wi, own, ior);
            f * photon.flux * (weight::power(photon.others / (ratio * ratio)) / cos)
        });
        sum * (1.0 / (PI * radius * radius))
    }

    /// [`weight::at_receiver`] of a vertex that a photon has come to.
    ///
    /// - `wi`: unit, against the photon.
    /// - `own`: the factor for an index, a cosine and a density of 1.
    /// - `ior`: index on the side that the path came from.
    #[inline]
    pub(super) fn photon_ratio(
        &self,
        path: &Path,
        vertex: &Vertex,
        wo: Vec3,
        wi: Vec3,
        own: f32,
        ior: f32,
    ) -> f32 {
        let ior = match crosses(vertex, wo, wi) {
            true => self.world.ior(vertex.far_set(self.world, &path.set).active()),
            false => ior,
        };
        own * ior * ior * wi.dot(vertex.hit.ng).abs() / vertex.bsdf.pdf(wo, wi)
    }

    /// Light of one light, chosen at random, by a shadow ray.
    fn sampled_light(
        &self,
        path: &Path,
        vertex: &Vertex,
        wo: Vec3,
        is_wide: bool,
        draws: &mut Draws<'_>,
    ) -> Spectrum {
        let (u_choice, u) = (draws.sampler.next_1d(), draws.sampler.next_2d());
        let Some(choice) = self.world.lights.direct().sample(u_choice) else { return Spectrum::ZERO };
        let Some(sample) = self.world.lights.get(choice.index).sample_direct(vertex.hit.p, u) else {
            return Spectrum::ZERO;
        };
        let contribution = vertex.bsdf.eval(wo, sample.wi, Transport::Radiance) * sample.radiance;
        if contribution.is_zero() {
            return contribution;
        }
        let far = crosses(vertex, wo, sample.wi).then(|| vertex.far_set(self.world, &path.set));
        let set = far.as_ref().unwrap_or(&path.set);
        let density = sample.pdf_w * choice.probability;
        let weight = self.sample_weight(path, vertex, wo, is_wide, &choice, &sample, set);
        let ray = shadow::ray_to_light(&vertex.hit, &sample, 0.0);
        let way = shadow::straight_way(self.world, &ray, set, draws.stats);
        contribution * (way.shared * weight + way.alone) * (1.0 / density)
    }

    /// What sampling a light counts beside hitting it and merging.
    ///
    /// - `set`: what the path to the light is in.
    pub(super) fn sample_weight(
        &self,
        path: &Path,
        vertex: &Vertex,
        wo: Vec3,
        is_wide: bool,
        choice: &LightChoice,
        sample: &DirectSample,
        set: &MediumSet,
    ) -> f32 {
        let techniques = self.settings.techniques;
        let is_hit = techniques.hits && !sample.is_delta;
        let density = sample.pdf_w * choice.probability;
        let hitting = if is_hit { vertex.bsdf.pdf(wo, sample.wi) / density } else { 0.0 };
        let merging = if is_wide { 0.0 } else { self.merging_of(path, vertex, wo, choice, sample, set) };
        weight::share(techniques.sampling, hitting * hitting + merging * merging)
    }

    /// Density of merging over that of sampling a light from a nearly polished vertex.
    ///
    /// - `set`: what the path to the light is in.
    fn merging_of(
        &self,
        path: &Path,
        vertex: &Vertex,
        wo: Vec3,
        choice: &LightChoice,
        sample: &DirectSample,
        set: &MediumSet,
    ) -> f32 {
        let (Some(receiver), Some(photons)) = (path.receiver, &self.photons) else { return 0.0 };
        let ng = vertex.hit.ng;
        let toward_light = SideOfChain {
            // For lights that no path hits, sampling stands where drawing the direction would.
            pdf: choice.probability * if sample.is_delta { 1.0 } else { sample.pdf_w },
            ior: self.world.ior(set.active()),
            cos: sample.wi.dot(ng).abs(),
        };
        let toward_receiver = SideOfChain {
            pdf: vertex.bsdf.pdf(sample.wi, wo),
            ior: self.world.ior(path.set.active()),
            cos: wo.dot(ng).abs(),
        };
        let n = sample.target.map(|target| target.n);
        let light = emission_density(self.world, photons.emitter, choice.index, n, -sample.wi, set);
        let is_point = sample.is_delta && sample.distance.is_finite();
        // For a point the square of the way stands for the cosine.
        let light = if is_point { light / (sample.distance * sample.distance) } else { light };
        receiver.ratio * weight::across(toward_receiver, toward_light) * light
    }
}

/// Whether light from `wi` crosses the surface on its way to `wo`.
fn crosses(vertex: &Vertex, wo: Vec3, wi: Vec3) -> bool {
    (wi.dot(vertex.hit.ng) > 0.0) != (wo.dot(vertex.hit.ng) > 0.0)
}
