//! How photons leave the lights: a light by its power, a place on it, a direction.
//!
//! Photon *i* is point *i* of the caller's sequence: one dimension chooses the light, one pair the place, one pair the
//! direction, always in this order. Lights are chosen in proportion to their power, so that all photons carry (nearly)
//! the same flux.

use super::guide::START_NUMBERS;
use super::projection::{Departure, Projection};
use hyaline_math::{Ray, Vec2, Vec3, offset_origin};
use hyaline_sampling::Sampler;
use hyaline_scattering::MediumSet;
use hyaline_scene::ProjectionMaps;
use hyaline_spectrum::Spectrum;
use hyaline_world::World;
use hyaline_world::light::{Light, LightSampler};

/// A photon on its way.
#[derive(Clone, Debug, PartialEq)]
pub struct PhotonStart {
    /// From the light, off its surface if it has one.
    pub ray: Ray,
    /// W; its mean over all calls of `emit_from`, those that give nothing counted as 0, is the power that is aimed at.
    pub flux: Spectrum,
    /// Index of the light.
    pub light: u32,
    /// The place on the light.
    pub origin: Vec3,
    /// Bound on the distance of `origin` from the light's true surface, scene units; 0 without a surface.
    pub p_error: f32,
    /// Geometric normal of the light's surface, unit, outward; `None` without a surface.
    pub n: Option<Vec3>,
    /// What the photon starts in.
    pub set: MediumSet,
}

/// Sends out photons.
#[derive(Clone, Debug)]
pub struct PhotonEmitter<'w> {
    world: &'w World,
    projections: Vec<Projection>,
    choice: LightSampler,
    fraction: f32,
}

impl<'w> PhotonEmitter<'w> {
    /// Prepares the projection maps and the choice among the lights.
    ///
    /// - `maps`: toward what to emit; `ProjectionMaps::None` sends out all light.
    /// - `cells`: cells of a projection map along each of its axes, ≥ 1; large numbers are cut down.
    pub fn new(world: &'w World, maps: ProjectionMaps, cells: u32) -> Self {
        let projections = Projection::of_lights(world, maps, cells);
        let power = |light: &Light| f64::from(light.power().mean(world.lanes));
        let powers = world.lights.lights().iter().map(power);
        let kept: Vec<f64> = powers.clone().zip(&projections).map(|(p, map)| p * map.kept()).collect();
        let total: f64 = powers.sum();
        let fraction = if total > 0.0 { kept.iter().sum::<f64>() / total } else { 0.0 };
        let weights: Vec<f32> = kept.iter().map(|&kept| kept as f32).collect();
        Self { world, projections, choice: LightSampler::new(&weights, 0.0), fraction: fraction as f32 }
    }

    /// Share of all lights' power that is emitted, 0…1; 0 where there is nothing to emit.
    ///
    /// Exact for cells of lights that shine alike in all directions and places; for `Objects` what overlaps is counted
    /// as often as it is covered, though it is emitted once.
    pub fn fraction(&self) -> f32 {
        self.fraction
    }

    /// Memory of the projection maps, bytes.
    pub fn memory(&self) -> usize {
        self.projections.iter().map(Projection::memory).sum()
    }

    /// A photon from its numbers, each in [0, 1): for the light, two for the place, two for the direction. `None` where this choice
    /// has no light, which counts as a photon without flux.
    pub fn emit_from(&self, numbers: [f32; START_NUMBERS]) -> Option<PhotonStart> {
        let [u_choice, x, y, z, w] = numbers;
        let (u_position, u_direction) = (Vec2::new(x, y), Vec2::new(z, w));
        let choice = self.choice.sample(u_choice)?;
        let light = self.world.lights.get(choice.index);
        let departure = self.projections[choice.index].emit(light, choice.u, u_position, u_direction)?;
        Some(self.start(choice.index as u32, &departure, 1.0 / choice.probability))
    }

    fn start(&self, light: u32, departure: &Departure, factor: f32) -> PhotonStart {
        let Departure { origin, p_error, n, direction, flux } = *departure;
        let off_surface = n.map_or(origin, |n| offset_origin(origin, p_error, n, direction));
        let set = self.world.emission_set(light, n, direction).clone();
        let ray = Ray::new(off_surface, direction);
        PhotonStart { ray, flux: flux * factor, light, origin, p_error, n, set }
    }
}

/// The numbers of the next photon.
///
/// - `sampler`: three of its dimensions are used up.
pub fn start_numbers(sampler: &mut Sampler) -> [f32; START_NUMBERS] {
    let (u_choice, u_position, u_direction) = (sampler.next_1d(), sampler.next_2d(), sampler.next_2d());
    [u_choice, u_position.x, u_position.y, u_direction.x, u_direction.y]
}
