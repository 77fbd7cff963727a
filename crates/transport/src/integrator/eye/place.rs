//! What a path does at a particle of a medium.

use super::merges::{Beyond, Passed, Place};
use super::radius::GatherRadius;
use super::within::{self, Part};
use super::{Draws, Eye, Path, weight};
use crate::direct::LastScatter;
use crate::in_volume::{self, VolumeLight};
use crate::integrator::merging::{BEAM_SHARE, Landing, Photons};
use crate::roulette::Past;
use crate::walk::VolumeVertex;
use hyaline_math::{Ray, Vec3};
use hyaline_spectrum::Spectrum;
use hyaline_world::light::{DirectSample, LightChoice};
use hyaline_world::{World, mask};
use std::f32::consts::PI;

/// Collisions after which a path is deep in something dense, where most shadow rays end at its boundary: few more are shot.
const MANY_COLLISIONS: u32 = 8;
/// Chance that a path asks for light at a collision then.
const CHANCE_AFTER_MANY: f32 = 0.25;

impl Eye<'_> {
    /// Gathers, samples a light and scatters; returns whether the path goes on.
    pub(super) fn at_place(&self, path: &mut Path, place: &VolumeVertex, draws: &mut Draws<'_>) -> bool {
        let wo = -path.ray.direction;
        path.throughput *= place.weight;
        let aim = self.aim.and_then(|aim| aim.at_place(place.p));
        if self.may_bounce(path) {
            let medium = &self.world.media[place.medium.index()];
            if let Some(photons) = &self.photons
                && Place::in_medium(medium) == Place::Grid
            {
                path.seen.light += self.gather_in_volume(path, place, wo, photons, draws);
            }
            let chance = if path.collisions < MANY_COLLISIONS { 1.0 } else { CHANCE_AFTER_MANY };
            if chance == 1.0 || draws.sampler.next_1d() < chance {
                let light = self.sampled_light_in_volume(path, place, wo, draws);
                path.seen.light += path.throughput * light * (1.0 / chance);
            }
            if let Some(cones) = &aim {
                path.seen.light += self.aimed_light_in_volume(path, place, wo, cones, draws);
            }
        }
        let phase = in_volume::phase_at(self.world, place);
        let wi = phase.sample(wo, draws.sampler.next_2d());
        let pdf = phase.value(wo, wi);
        self.turn_at_place(path, place, wi, pdf);
        path.rival = aim.map_or(0.0, |cones| cones.pdf(wi) / pdf);
        self.survives(path, draws)
    }

    /// Sends the path on in the direction that was drawn, and keeps all true that weights go by.
    ///
    /// - `pdf`: density of `wi`, sr⁻¹.
    pub(super) fn turn_at_place(&self, path: &mut Path, place: &VolumeVertex, wi: Vec3, pdf: f32) {
        let wo = -path.ray.direction;
        path.bounces += 1;
        path.collisions += Past::collisions_in(place.medium, &path.set);
        (path.crossings, path.rival, path.share) = (0, 0.0, 0.0);
        path.last = LastScatter { sampled: Some((place.p, pdf)), is_covered: false };
        if let Some(photons) = &self.photons {
            let own = volume_factor(self.world, place, &photons.radius, [wo, wi]) / pdf;
            let place = Place::in_medium(&self.world.media[place.medium.index()]);
            path.merges.pass(&Passed { place, own, across: 1.0, is_specular: false });
        }
        path.ray = Ray { time: path.ray.time, ..Ray::new(place.p, wi) };
        path.visible = mask::PATH;
    }

    /// Light that the photons about a particle bring to the picture.
    fn gather_in_volume(
        &self,
        path: &Path,
        place: &VolumeVertex,
        wo: Vec3,
        photons: &Photons<'_>,
        draws: &mut Draws<'_>,
    ) -> Spectrum {
        let medium = &self.world.media[place.medium.index()];
        let radius = photons.radius.in_volume(place.p);
        let part = Part::about(medium, place.p);
        let carried = path.throughput * (1.0 / (4.0 / 3.0 * PI * radius * radius * radius));
        let points = self.points_about(path, place, photons);
        let left = self.bounces_left(path);
        let light = photons.landed.volume(place.p, radius, |photon| {
            let Landing::Volume { density } = photon.landing else { return Spectrum::ZERO };
            if photon.bounces >= left || !part.holds(density) {
                return Spectrum::ZERO;
            }
            let phase = medium.phase.value(wo, -photon.direction);
            let light = carried * photon.flux * (phase * points.weight_of(phase, photon.others));
            draws.tally.note(photon.id, light);
            light
        });
        if light.is_zero() {
            return light;
        }
        light * within::ball_over_part(self.world, (place.p, radius), (&path.set, &part), draws)
    }

    /// What weights of photons about a particle have in common.
    pub(super) fn points_about(&self, path: &Path, place: &VolumeVertex, photons: &Photons<'_>) -> Points {
        let radius = photons.radius.in_volume(place.p);
        let own = point_factor(self.world, place, radius);
        Points { own, behind: path.merges.behind(Beyond::Wide) }
    }

    /// Light of the lights that are asked, by a shadow ray to each.
    fn sampled_light_in_volume(
        &self,
        path: &Path,
        place: &VolumeVertex,
        wo: Vec3,
        draws: &mut Draws<'_>,
    ) -> Spectrum {
        let VolumeVertex { p, medium, .. } = *place;
        let asking = VolumeLight { world: self.world, p, medium, wo, set: &path.set };
        let asked = self.asked(path.bounces, draws);
        asked.into_iter().fold(Spectrum::ZERO, |sum, choice| {
            let weight = |sample: &DirectSample, phase: f32| {
                self.sample_weight_in_volume(path, place, wo, &choice, sample, phase)
            };
            let light = self.world.lights.get(choice.index);
            sum + asking.from_light(light, draws.sampler.next_2d(), weight, draws.stats) / choice.probability
        })
    }

    /// What sampling a light counts beside hitting it and merging.
    ///
    /// - `phase`: value of the phase function toward the light, sr⁻¹.
    pub(super) fn sample_weight_in_volume(
        &self,
        path: &Path,
        place: &VolumeVertex,
        wo: Vec3,
        choice: &LightChoice,
        sample: &DirectSample,
        phase: f32,
    ) -> f32 {
        let techniques = self.settings.techniques;
        let density = sample.pdf_w * choice.probability;
        let across = phase / density;
        let hitting = if techniques.hits && !sample.is_delta { phase / density } else { 0.0 };
        let merging = self.photons.as_ref().map_or(0.0, |photons| {
            let light =
                photons.senders.of(false).density_of_sample(self.world, choice.index, sample, &path.set);
            // A photon straight from the light is merged as a beam alone.
            let own = match Place::in_medium(&self.world.media[place.medium.index()]) {
                Place::Beams => volume_factor(self.world, place, &photons.radius, [wo, sample.wi]) / density,
                Place::Grid | Place::Surface => 0.0,
            };
            let behind = path.merges.behind(Beyond::Wide);
            (behind * across * across + own * own) * light * light
        });
        weight::share(techniques.sampling, hitting * hitting + merging)
    }
}

/// Photons about a particle.
pub(super) struct Points {
    /// The factor of the place, but for the density of the direction.
    own: f32,
    /// Merges behind it.
    behind: f32,
}

impl Points {
    /// What merging a photon counts beside the other ways to make the path.
    ///
    /// - `phase`: value of the phase function, sr⁻¹; `others`: what the photon's side knows of them.
    pub(super) fn weight_of(&self, phase: f32, others: f32) -> f32 {
        // Phase functions are the same both ways.
        let ratio = phase / self.own;
        weight::power((others + self.behind) * ratio * ratio)
    }
}

/// The factor of a place in a medium, but for the density of the direction: that of beams in homogeneous media, of points
/// in others.
///
/// - `ways`: the two directions that meet there.
pub(in crate::integrator) fn volume_factor(
    world: &World,
    place: &VolumeVertex,
    radius: &GatherRadius,
    ways: [Vec3; 2],
) -> f32 {
    let medium = &world.media[place.medium.index()];
    if Place::in_medium(medium) == Place::Grid {
        return point_factor(world, place, radius.in_volume(place.p));
    }
    let sin = ways[0].cross(ways[1]).length();
    weight::of_beam(BEAM_SHARE, radius.of_beams(place.p), sin, medium.ior, medium.sigma_t().mean(world.lanes))
}

fn point_factor(world: &World, place: &VolumeVertex, radius: f32) -> f32 {
    let medium = &world.media[place.medium.index()];
    let sigma = medium.sigma_t().mean(world.lanes) * medium.density(place.p);
    weight::in_volume(radius, medium.ior, sigma, 1.0)
}
