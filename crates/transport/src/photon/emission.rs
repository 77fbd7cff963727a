//! How photons leave the lights: a light by its power, a place on it, a direction.
//!
//! Photon *i* is point *i* of the caller's sequence: one dimension chooses the light, one pair the place, one pair the
//! direction, always in this order. Lights are chosen in proportion to their power, so that all photons carry (nearly)
//! the same flux.

use hyaline_math::{Ray, offset_origin};
use hyaline_sampling::Sampler;
use hyaline_scattering::MediumSet;
use hyaline_scene::ProjectionMaps;
use hyaline_spectrum::Spectrum;
use hyaline_world::World;
use hyaline_world::light::{EmissionSample, LightSampler};

/// A photon on its way.
#[derive(Clone, Debug, PartialEq)]
pub struct PhotonStart {
    /// From the light, off its surface if it has one.
    pub ray: Ray,
    /// W; its mean over all calls of `emit`, those that give nothing counted as 0, is the power that is aimed at.
    pub flux: Spectrum,
    /// Index of the light.
    pub light: u32,
    /// What the photon starts in.
    pub set: MediumSet,
}

/// Sends out photons.
#[derive(Clone, Debug)]
pub struct PhotonEmitter<'w> {
    world: &'w World,
    choice: LightSampler,
    fraction: f32,
}

impl<'w> PhotonEmitter<'w> {
    /// Prepares the choice among the lights and the projection maps.
    ///
    /// - `maps`: toward what to emit; `ProjectionMaps::None` sends out all light.
    /// - `cells`: cells of a projection map along each of its axes, ≥ 1.
    pub fn new(world: &'w World, _maps: ProjectionMaps, _cells: u32) -> Self {
        let powers: Vec<f32> = world.lights.lights().iter().map(|l| l.power().mean(world.lanes)).collect();
        let fraction = if powers.iter().any(|&power| power > 0.0) { 1.0 } else { 0.0 };
        Self { world, choice: LightSampler::new(&powers, 0.0), fraction }
    }

    /// Share of all lights' power that is emitted, 0…1; 0 where there is nothing to emit.
    pub fn fraction(&self) -> f32 {
        self.fraction
    }

    /// One photon; `None` where this choice has no light, which counts as a photon without flux.
    ///
    /// - `sampler`: three of its dimensions are used up.
    pub fn emit(&self, sampler: &mut Sampler) -> Option<PhotonStart> {
        let (u_choice, u_position, u_direction) = (sampler.next_1d(), sampler.next_2d(), sampler.next_2d());
        let choice = self.choice.sample(u_choice)?;
        let sample = self.world.lights.get(choice.index).sample_emission(u_position, u_direction)?;
        Some(self.start(choice.index as u32, &sample, 1.0 / choice.probability))
    }

    fn start(&self, light: u32, sample: &EmissionSample, factor: f32) -> PhotonStart {
        let direction = sample.direction;
        let origin = match sample.n {
            Some(n) => offset_origin(sample.origin, sample.p_error, n, direction),
            None => sample.origin,
        };
        let set = self.world.emission_set(light, sample.n, direction).clone();
        PhotonStart { ray: Ray::new(origin, direction), flux: sample.weight * factor, light, set }
    }
}
