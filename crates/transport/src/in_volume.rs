//! Light at a place within a medium: what comes straight from lights, and where a path goes on.

use crate::shadow;
use crate::stats::Stats;
use crate::walk::VolumeVertex;
use hyaline_math::{Vec2, Vec3};
use hyaline_sampling::Sampler;
use hyaline_scattering::{MediumId, MediumSet, Phase};
use hyaline_spectrum::Spectrum;
use hyaline_world::World;
use hyaline_world::light::{DirectSample, Light};

/// A place in a medium that asks for light.
#[derive(Clone, Copy, Debug)]
pub struct VolumeLight<'a> {
    /// Where.
    pub world: &'a World,
    /// The place.
    pub p: Vec3,
    /// The medium in force there.
    pub medium: MediumId,
    /// Unit direction back along the path.
    pub wo: Vec3,
    /// What the place is in.
    pub set: &'a MediumSet,
}

impl VolumeLight<'_> {
    /// Light of one light, chosen at random, that goes on against the path: an estimate of the sum over all lights, the
    /// scattering coefficient left out. For those who find it in no other way.
    pub fn sample_one(&self, sampler: &mut Sampler, stats: &mut Stats) -> Spectrum {
        let (u_choice, u) = (sampler.next_1d(), sampler.next_2d());
        let Some(choice) = self.world.lights.direct().sample(u_choice) else { return Spectrum::ZERO };
        let light = self.world.lights.get(choice.index);
        self.from_light(light, u, |_, _| 1.0, stats) / choice.probability
    }

    /// Light of `light` that goes on against the path, one sample, the scattering coefficient left out.
    ///
    /// - `weight`: what sampling counts beside other ways to find the light, for a sample and the value of the phase
    ///   function.
    pub fn from_light(
        &self,
        light: &Light,
        u: Vec2,
        weight: impl FnOnce(&DirectSample, f32) -> f32,
        stats: &mut Stats,
    ) -> Spectrum {
        let Some(sample) = light.sample_direct(self.p, u) else { return Spectrum::ZERO };
        let phase = self.world.media[self.medium.index()].phase.value(self.wo, sample.wi);
        if phase == 0.0 || sample.radiance.is_zero() {
            return Spectrum::ZERO;
        }
        let weight = weight(&sample, phase);
        let ray = shadow::ray_from(self.p, &sample, 0.0);
        let way = shadow::straight_way(self.world, &ray, self.set, stats);
        let visible = way.shared * weight + way.alone;
        sample.radiance * visible * (phase / sample.pdf_w)
    }
}

/// The phase function in force at a place.
pub fn phase_at<'w>(world: &'w World, vertex: &VolumeVertex) -> &'w Phase {
    &world.media[vertex.medium.index()].phase
}
