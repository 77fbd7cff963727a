//! The eye stage: what a camera path sees, some of it traced, some of it looked up.
//!
//! 1. Specular surfaces are traced: the path goes on in one direction drawn from the BSDF. Lights met count fully;
//!    at narrow lobes they are weighted against light sampling.
//! 2. At the first other surface light comes in four ways, each counted once. Straight from the lights: shadow
//!    rays, weighted against gather rays that meet a light. Over specular surfaces alone: the caustic map. What
//!    caustics throw from elsewhere (L S+ D S* D): a map of its own, as few gather rays would meet a caustic, and
//!    each would bring a lot. All other: gather rays, drawn from the BSDF.
//! 3. A gather ray is traced over specular surfaces to the next other one; lights met behind specular surfaces are
//!    caustics and don't count again. There the global map is looked up, but for its caustics; or only indirect
//!    light, and light sampling adds what comes straight.
//! 4. Where a gather ray is shorter than the radius of that look-up, it would see the light of the place that
//!    gathers: the surface there gathers in its turn.
//! 5. Without final gathering the light at step 2 is looked up as at step 3, caustics included. Glossy surfaces
//!    gather nevertheless: too few photons fall into their lobes.
//!
//! Source: Jensen, Realistic Image Synthesis Using Photon Mapping, 2001, §9.2.

use super::strand::{Origin, Strand};
use crate::direct::DirectLight;
use crate::first_hit;
use crate::integrator::RenderSettings;
use crate::photon::gather::{Estimate, Gathered, PhotonMap};
use crate::photon::maps::PhotonMaps;
use crate::photon::record::PhotonKind;
use crate::photon::specular::is_specular;
use crate::photon::tree::Nearest;
use crate::stats::Stats;
use crate::walk::Vertex;
use hyaline_film::PixelSample;
use hyaline_sampling::Sampler;
use hyaline_spectrum::Spectrum;
use hyaline_world::World;

/// Follows camera paths, one after the other.
pub(super) struct Eye<'a> {
    world: &'a World,
    settings: &'a RenderSettings,
    maps: &'a PhotonMaps,
    stats: &'a mut Stats,
    scratch: Nearest,
}

/// What is done at a surface before the path goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// Nothing is stored here; the path goes on.
    Specular,
    /// Direct light and caustics are added; the rest is gathered.
    Gather,
    /// All light is added, but for lights met straight: they share with light sampling.
    LookUp,
    /// All light is added, and only what a polished part of the finish shows is missing.
    LookUpAll,
}

impl<'a> Eye<'a> {
    pub(super) fn new(
        world: &'a World,
        settings: &'a RenderSettings,
        maps: &'a PhotonMaps,
        stats: &'a mut Stats,
    ) -> Self {
        Self { world, settings, maps, stats, scratch: Nearest::default() }
    }

    /// An estimate of the radiance that a strand brings.
    ///
    /// - `first`: receives what the first surface looks like.
    pub(super) fn follow(
        &mut self,
        mut strand: Strand,
        sampler: &mut Sampler,
        mut first: Option<&mut PixelSample>,
    ) -> Spectrum {
        let mut result = Spectrum::ZERO;
        while let Some(vertex) = strand.walk(self.world, &mut result, self.stats) {
            if let Some(sample) = first.take() {
                first_hit::record(sample, &vertex, &strand.ray);
            }
            let (light, role) = self.light_at(&vertex, &strand, sampler);
            result += strand.throughput * light;
            if role == Role::Gather && !strand.is_split && self.settings.photon_map.gather_rays > 1 {
                return result + self.follow_split(&vertex, &strand, sampler);
            }
            if !strand.scatter(self.world, &vertex, role, self.settings.max_depth, sampler) {
                break;
            }
        }
        result
    }

    /// Goes on from a surface that gathers in several directions at once.
    fn follow_split(&mut self, vertex: &Vertex, strand: &Strand, sampler: &Sampler) -> Spectrum {
        let mut result = Spectrum::ZERO;
        let count = self.settings.photon_map.gather_rays;
        for i in 0..count {
            let (mut strand, mut sampler) = (strand.split(count), sampler.fork(i));
            if strand.scatter(self.world, vertex, Role::Gather, self.settings.max_depth, &mut sampler) {
                result += self.follow(strand, &mut sampler, None);
            }
        }
        result
    }

    /// What the surface is for a strand that comes from afar.
    fn role(&self, vertex: &Vertex, strand: &Strand) -> Role {
        let gathers = match strand.origin {
            Origin::Camera => self.settings.photon_map.final_gather || !vertex.bsdf.has_diffuse_part(),
            Origin::Gather { .. } | Origin::LookUp => false,
        };
        match (is_specular(&vertex.bsdf), gathers) {
            (true, _) => Role::Specular,
            (false, true) => Role::Gather,
            (false, false) if self.maps.holds_all => Role::LookUpAll,
            (false, false) => Role::LookUp,
        }
    }

    /// The light that the surface sends back along the strand and that is counted here; and what the surface is.
    fn light_at(&mut self, vertex: &Vertex, strand: &Strand, sampler: &mut Sampler) -> (Spectrum, Role) {
        let role = self.role(vertex, strand);
        if self.settings.max_depth.is_some_and(|limit| strand.bounces >= limit) {
            return (Spectrum::ZERO, role);
        }
        match role {
            Role::Specular if strand.origin != Origin::Camera || vertex.bsdf.is_delta() => {
                (Spectrum::ZERO, role)
            }
            Role::Specular => (self.direct_light(vertex, strand, sampler), role),
            Role::Gather => (self.first_light(vertex, strand, role, sampler), role),
            Role::LookUp | Role::LookUpAll => {
                let stored = self.stored_light(vertex, strand);
                if strand.is_shorter_than(stored.radius) {
                    (self.first_light(vertex, strand, Role::Gather, sampler), Role::Gather)
                } else if role == Role::LookUpAll {
                    (stored.value, role)
                } else {
                    (stored.value + self.first_light(vertex, strand, role, sampler), role)
                }
            }
        }
    }

    /// Light from the lights, straight or over specular surfaces; where rays gather, that of caustics elsewhere.
    fn first_light(
        &mut self,
        vertex: &Vertex,
        strand: &Strand,
        role: Role,
        sampler: &mut Sampler,
    ) -> Spectrum {
        let mut light = self.direct_light(vertex, strand, sampler);
        let maps = self.maps;
        if strand.origin == Origin::Camera {
            light += self.look_up(&maps.caustic, &maps.caustic_estimate, vertex, strand, |_| true).value;
        }
        if role == Role::Gather {
            light += self.look_up(&maps.rebound, &maps.rebound_estimate, vertex, strand, |_| true).value;
        }
        light
    }

    /// Light in the global map. The caustics that a gather ray meets are counted where it began.
    fn stored_light(&mut self, vertex: &Vertex, strand: &Strand) -> Gathered {
        let counts = |kind| strand.origin == Origin::Camera || kind != PhotonKind::Caustic;
        self.look_up(&self.maps.global, &self.maps.global_estimate, vertex, strand, counts)
    }

    fn direct_light(&mut self, vertex: &Vertex, strand: &Strand, sampler: &mut Sampler) -> Spectrum {
        let (wo, set) = (-strand.ray.direction, &strand.set);
        DirectLight { world: self.world, vertex, wo, set, use_mis: true }.sample_one(sampler, self.stats)
    }

    fn look_up(
        &mut self,
        map: &PhotonMap,
        estimate: &Estimate,
        vertex: &Vertex,
        strand: &Strand,
        counts: impl Fn(PhotonKind) -> bool,
    ) -> Gathered {
        estimate.radiance(map, &vertex.hit, &vertex.bsdf, -strand.ray.direction, counts, &mut self.scratch)
    }
}
