//! Light at a place within a medium: what comes straight from lights, and where a path goes on.

use crate::shadow;
use crate::stats::Stats;
use crate::walk::VolumeVertex;
use hyaline_math::Vec3;
use hyaline_sampling::Sampler;
use hyaline_scattering::{MediumSet, Phase};
use hyaline_spectrum::Spectrum;
use hyaline_world::World;
use hyaline_world::light::{DirectSample, LightChoice};

/// Light of one light, chosen at random, that the medium sends back along the path: an estimate of the sum over all
/// lights, to be shared with directions drawn from the phase function.
///
/// - `wo`: unit, back along the path.
/// - `set`: what the place is in.
/// - `weight`: what sampling counts beside the other ways to find the light, for a sample and the value of the phase
///   function.
pub fn sample_one_light(
    world: &World,
    vertex: &VolumeVertex,
    wo: Vec3,
    set: &MediumSet,
    weight: impl FnOnce(&LightChoice, &DirectSample, f32) -> f32,
    sampler: &mut Sampler,
    stats: &mut Stats,
) -> Spectrum {
    let (u_choice, u) = (sampler.next_1d(), sampler.next_2d());
    let Some(choice) = world.lights.direct().sample(u_choice) else { return Spectrum::ZERO };
    let Some(sample) = world.lights.get(choice.index).sample_direct(vertex.p, u) else {
        return Spectrum::ZERO;
    };
    let phase = phase_at(world, vertex).value(wo, sample.wi);
    if phase == 0.0 || sample.radiance.is_zero() {
        return Spectrum::ZERO;
    }
    let density = sample.pdf_w * choice.probability;
    let weight = weight(&choice, &sample, phase);
    let ray = shadow::ray_from(vertex.p, &sample, 0.0);
    let way = shadow::straight_way(world, &ray, set, stats);
    let visible = way.shared * weight + way.alone;
    sample.radiance * visible * (phase / density)
}

/// The phase function in force at a place.
pub fn phase_at<'w>(world: &'w World, vertex: &VolumeVertex) -> &'w Phase {
    &world.media[vertex.medium.index()].phase
}
