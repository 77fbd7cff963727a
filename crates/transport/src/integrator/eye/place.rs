//! What a path does at a particle of a medium.

use super::{Draws, Eye, Path, weight};
use crate::direct::LastScatter;
use crate::in_volume;
use crate::integrator::merging::Photons;
use crate::walk::VolumeVertex;
use hyaline_math::{Ray, Vec3};
use hyaline_spectrum::Spectrum;
use hyaline_world::World;
use hyaline_world::light::{DirectSample, LightChoice};
use std::f32::consts::PI;

impl Eye<'_> {
    /// Gathers, samples a light and scatters; returns whether the path goes on.
    pub(super) fn at_place(&self, path: &mut Path, place: &VolumeVertex, draws: &mut Draws<'_>) -> bool {
        let wo = -path.ray.direction;
        path.throughput *= place.weight;
        if self.may_bounce(path) {
            if let Some(photons) = &self.photons {
                path.light += path.throughput * self.gather_in_volume(path, place, wo, photons);
            }
            path.light += path.throughput * self.sampled_light_in_volume(path, place, wo, draws);
        }
        let phase = in_volume::phase_at(self.world, place);
        let wi = phase.sample(wo, draws.sampler.next_2d());
        let pdf = phase.value(wo, wi);
        path.bounces += 1;
        path.crossings = 0;
        path.last = LastScatter { sampled: Some((place.p, pdf)), is_covered: false };
        if let Some(photons) = &self.photons {
            let own = volume_factor(self.world, place, photons.radius.in_volume(place.p));
            path.merges.pass(own / pdf, 1.0, false);
        }
        path.ray = Ray { time: path.ray.time, ..Ray::new(place.p, wi) };
        self.survives(path, draws)
    }

    /// Light of the photons about a particle.
    fn gather_in_volume(
        &self,
        path: &Path,
        place: &VolumeVertex,
        wo: Vec3,
        photons: &Photons<'_>,
    ) -> Spectrum {
        let medium = &self.world.media[place.medium.index()];
        let radius = photons.radius.in_volume(place.p);
        let own = volume_factor(self.world, place, radius);
        let left = self.bounces_left(path);
        let sum = photons.landed.volume(place.p, radius, |photon| {
            if photon.bounces >= left {
                return Spectrum::ZERO;
            }
            let phase = medium.phase.value(wo, -photon.direction);
            // Phase functions are the same both ways.
            let ratio = phase / own;
            photon.flux * (phase * weight::power((photon.others + path.merges.behind()) * ratio * ratio))
        });
        // Photons count what they scatter; what the path scatters is in its throughput already.
        let density = medium.density(place.p);
        let sigma_s = (medium.sigma_s * density).map(|sigma| if sigma > 0.0 { 1.0 / sigma } else { 0.0 });
        sum * sigma_s * (1.0 / (4.0 / 3.0 * PI * radius * radius * radius))
    }

    /// Light of one light, chosen at random, by a shadow ray.
    fn sampled_light_in_volume(
        &self,
        path: &Path,
        place: &VolumeVertex,
        wo: Vec3,
        draws: &mut Draws<'_>,
    ) -> Spectrum {
        let merging = |choice: &LightChoice, sample: &DirectSample, phase: f32| {
            let Some(photons) = &self.photons else { return 0.0 };
            let across = phase / (sample.pdf_w * choice.probability);
            let light =
                photons.senders.of(false).density_of_sample(self.world, choice.index, sample, &path.set);
            let factor = across * light;
            path.merges.behind() * factor * factor
        };
        in_volume::sample_one_light(self.world, place, wo, &path.set, merging, draws.sampler, draws.stats)
    }
}

/// The factor of a place in a medium, but for the density of the direction.
pub(in crate::integrator) fn volume_factor(world: &World, place: &VolumeVertex, radius: f32) -> f32 {
    let medium = &world.media[place.medium.index()];
    let sigma = medium.sigma_t().mean(world.lanes) * medium.density(place.p);
    weight::in_volume(radius, medium.ior, sigma, 1.0)
}
