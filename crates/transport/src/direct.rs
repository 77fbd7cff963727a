//! Light that reaches a vertex straight from a light.

use crate::shadow;
use crate::stats::Stats;
use crate::walk::Vertex;
use hyaline_math::{Ray, Vec3};
use hyaline_sampling::{Sampler, mis};
use hyaline_scattering::BsdfSample;
use hyaline_scattering::{MediumSet, Transport};
use hyaline_spectrum::Spectrum;
use hyaline_world::light::{DirectSample, Light};
use hyaline_world::{StraightWay, World, mask};

/// How a path came to where it is, for weighing the lights that it hits.
#[derive(Clone, Copy, Debug, Default)]
pub struct LastScatter {
    /// The last vertex at which light sampling was possible, and the density of the direction taken there.
    /// `None` after the camera and after singular vertices: light sampling could not have made the path.
    pub sampled: Option<(Vec3, f32)>,
    /// Whether such a vertex has been left, and since then straight shadows crossed and nothing else: its shadow rays
    /// have brought all light that comes this way, so that what is hit now adds nothing.
    pub is_covered: bool,
}

impl LastScatter {
    /// Takes note of a scattering event; see `Vertex::passes_straight` for the rule.
    pub fn record(&mut self, vertex: &Vertex, scattered: &BsdfSample) {
        let was_receiver = self.sampled.is_some() || self.is_covered;
        self.is_covered = was_receiver && vertex.passes_straight(scattered.transmits);
        self.sampled = (!scattered.is_delta).then_some((vertex.hit.p, scattered.pdf));
    }
}

/// A vertex that asks for light.
pub struct DirectLight<'a> {
    /// Where.
    pub world: &'a World,
    /// The vertex; its BSDF is not singular.
    pub vertex: &'a Vertex,
    /// Unit direction back along the path.
    pub wo: Vec3,
    /// What the path is in before the vertex.
    pub set: &'a MediumSet,
    /// Whether BSDF sampling finds lights too, so that the two share them.
    pub use_mis: bool,
}

impl DirectLight<'_> {
    /// Scattered light of one light, chosen at random: an estimate of the sum over all lights.
    pub fn sample_one(&self, sampler: &mut Sampler, stats: &mut Stats) -> Spectrum {
        let (u_choice, u) = (sampler.next_1d(), sampler.next_2d());
        match self.world.lights.direct().sample(u_choice) {
            None => Spectrum::ZERO,
            Some(choice) => {
                let light = self.world.lights.get(choice.index);
                self.from_light(light, choice.probability, u, stats) / choice.probability
            }
        }
    }

    /// Scattered light of `light`, one sample; `probability` is that of having chosen it, for MIS.
    pub fn from_light(
        &self,
        light: &Light,
        probability: f32,
        u: hyaline_math::Vec2,
        stats: &mut Stats,
    ) -> Spectrum {
        let hit = &self.vertex.hit;
        let Some(sample) = light.sample_direct(hit.p, u) else { return Spectrum::ZERO };
        let f = self.vertex.bsdf.eval(self.wo, sample.wi, Transport::Radiance);
        let contribution = f * sample.radiance;
        if contribution.is_zero() {
            return contribution;
        }
        let weight = self.mis_weight(&sample, probability);
        let way = self.straight_way(&sample, stats);
        contribution * way.shared * (weight / sample.pdf_w) + contribution * way.alone * (1.0 / sample.pdf_w)
    }

    fn mis_weight(&self, sample: &DirectSample, probability: f32) -> f32 {
        if sample.is_delta || !self.use_mis {
            return 1.0;
        }
        mis::power(sample.pdf_w * probability, self.vertex.bsdf.pdf(self.wo, sample.wi))
    }

    fn straight_way(&self, sample: &DirectSample, stats: &mut Stats) -> StraightWay {
        let hit = &self.vertex.hit;
        let ray = shadow::ray_to_light(hit, sample, 0.0);
        let crosses = (sample.wi.dot(hit.ng) > 0.0) != (self.wo.dot(hit.ng) > 0.0);
        if crosses {
            shadow::straight_way(self.world, &ray, &self.vertex.far_set(self.world, self.set), stats)
        } else {
            shadow::straight_way(self.world, &ray, self.set, stats)
        }
    }
}

/// Radiance of the surface hit towards the start of `ray`, weighted against light sampling where the path came from a
/// vertex that sampled lights: `sampled` is that vertex and the density of the direction.
pub fn surface_radiance(world: &World, vertex: &Vertex, ray: &Ray, sampled: Option<(Vec3, f32)>) -> Spectrum {
    let Some(index) = vertex.light else { return Spectrum::ZERO };
    let light = world.lights.get(index as usize);
    let radiance = light.radiance_from(&vertex.hit, -ray.direction);
    match sampled {
        Some((p, pdf)) if !radiance.is_zero() => {
            let pdf_light = world.lights.direct().probability(index as usize)
                * light.pdf_direct(p, ray.direction, Some(&vertex.hit));
            radiance * mis::power(pdf, pdf_light)
        }
        _ => radiance,
    }
}

/// Radiance of the surroundings against `ray`, weighted against light sampling where the path came from a vertex
/// that sampled lights: `sampled` is that vertex and the density of the direction.
pub fn sky_radiance(world: &World, ray: &Ray, sampled: Option<(Vec3, f32)>, visible: u8) -> Spectrum {
    let mut result = Spectrum::ZERO;
    let seen = if visible == mask::CAMERA { &world.camera_sky } else { world.lights.environments() };
    for &index in seen {
        let light = world.lights.get(index as usize);
        let radiance = light.radiance_of_sky(ray.direction);
        let weight = match sampled {
            None => 1.0,
            Some((p, pdf)) => {
                let pdf_light = light.pdf_direct(p, ray.direction, None);
                mis::power(pdf, world.lights.direct().probability(index as usize) * pdf_light)
            }
        };
        result += radiance * weight;
    }
    result
}
