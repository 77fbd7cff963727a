//! What a path does at a particle of a medium.

use super::receiver::Receiver;
use super::{Draws, Eye, Path, weight};
use crate::direct::LastScatter;
use crate::in_volume;
use crate::integrator::merging::Photons;
use crate::walk::VolumeVertex;
use hyaline_math::{Ray, Vec3};
use hyaline_spectrum::Spectrum;
use std::f32::consts::PI;

impl Eye<'_> {
    /// Gathers, samples a light and scatters; returns whether the path goes on.
    pub(super) fn at_place(&self, path: &mut Path, place: &VolumeVertex, draws: &mut Draws<'_>) -> bool {
        let wo = -path.ray.direction;
        path.throughput *= place.weight;
        path.footprint.travel(place.distance);
        let shrink = self.photons.as_ref().map_or(0.0, |photons| photons.shrink.volume);
        let radius = path.footprint.radius() * shrink;
        if self.may_bounce(path) {
            if let Some(photons) = &self.photons {
                path.light += path.throughput * self.gather_in_volume(place, wo, photons, radius);
            }
            let light = in_volume::sample_one_light(
                self.world,
                self.settings,
                place,
                wo,
                &path.set,
                draws.sampler,
                draws.stats,
            );
            path.light += path.throughput * light;
        }
        let phase = in_volume::phase_at(self.world, place);
        let wi = phase.sample(wo, draws.sampler.next_2d());
        self.turn_at_place(path, place, wi, phase.value(wo, wi), radius);
        self.survives(path, draws)
    }

    /// Sends the path on in the direction that was drawn, and keeps all true that weights go by.
    ///
    /// - `pdf`: density of `wi`, sr⁻¹; `radius`: gather radius at the place.
    pub(super) fn turn_at_place(
        &self,
        path: &mut Path,
        place: &VolumeVertex,
        wi: Vec3,
        pdf: f32,
        radius: f32,
    ) {
        path.bounces += 1;
        path.crossings = 0;
        path.last = LastScatter { sampled: Some((place.p, pdf)), is_covered: false };
        path.receiver = self.photons.as_ref().map(|photons| Receiver {
            ratio: self.volume_ratio(place, radius, photons.landed.sent) / pdf,
            chain: 0,
        });
        path.footprint.scatter(pdf);
        path.ray = Ray { time: path.ray.time, ..Ray::new(place.p, wi) };
    }

    /// Light of the photons about a particle.
    fn gather_in_volume(
        &self,
        place: &VolumeVertex,
        wo: Vec3,
        photons: &Photons<'_>,
        radius: f32,
    ) -> Spectrum {
        let medium = &self.world.media[place.medium.index()];
        let density = medium.density(place.p);
        let own = self.volume_ratio(place, radius, photons.landed.sent);
        let sum = photons.landed.volume(place.p, radius, |photon| {
            let phase = medium.phase.value(wo, -photon.direction);
            let ratio = own / phase;
            photon.flux * (phase * weight::power(photon.others / (ratio * ratio)))
        });
        // Photons count what they scatter; what the path scatters is in its throughput already.
        let sigma_s = (medium.sigma_s * density).map(|sigma| if sigma > 0.0 { 1.0 / sigma } else { 0.0 });
        sum * sigma_s * (1.0 / (4.0 / 3.0 * PI * radius * radius * radius))
    }
}
