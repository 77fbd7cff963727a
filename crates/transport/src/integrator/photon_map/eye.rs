//! The eye stage: what a camera path sees, some of it traced, some of it looked up.
//!
//! 1. Specular surfaces are traced: the path goes on in one direction drawn from the BSDF. Lights met count fully;
//!    at narrow lobes they are weighted against light sampling.
//! 2. At the first other surface light comes in three ways, each counted once. Straight from the lights: shadow
//!    rays, weighted against gather rays that meet a light. Over specular surfaces alone: the caustic map. All
//!    other: gather rays, drawn from the BSDF.
//! 3. A gather ray is traced over specular surfaces to the next other one; lights met behind specular surfaces are
//!    caustics and don't count again. There the global map is looked up, which holds all light; or only indirect
//!    light, and shadow rays and the caustic map add the rest.
//! 4. Where a gather ray is shorter than the radius of that look-up, it would see the light of the place that
//!    gathers: the surface there gathers in its turn.
//! 5. Without final gathering the light at step 2 is looked up as at step 3. Glossy surfaces gather nevertheless:
//!    too few photons fall into their lobes.
//!
//! Source: Jensen, Realistic Image Synthesis Using Photon Mapping, 2001, §9.2.

use super::strand::{Origin, Strand};
use super::{PhotonMaps, RenderSettings, World};
use crate::direct::DirectLight;
use crate::first_hit;
use crate::photon::gather::Scratch;
use crate::photon::specular::is_specular;
use crate::stats::Stats;
use crate::walk::Vertex;
use hyaline_film::PixelSample;
use hyaline_sampling::Sampler;
use hyaline_spectrum::Spectrum;

/// Follows camera paths, one after the other.
pub(super) struct Eye<'a> {
    world: &'a World,
    settings: &'a RenderSettings,
    maps: &'a PhotonMaps,
    stats: &'a mut Stats,
    scratch: Scratch,
}

/// What is done at a surface before the path goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    /// Nothing is stored here; the path goes on.
    Specular,
    /// Direct light and caustics are added; the rest is gathered.
    Gather,
    /// All light is added.
    LookUp,
}

impl<'a> Eye<'a> {
    pub(super) fn new(
        world: &'a World,
        settings: &'a RenderSettings,
        maps: &'a PhotonMaps,
        stats: &'a mut Stats,
    ) -> Self {
        Self { world, settings, maps, stats, scratch: Scratch::default() }
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
            let role = self.role(&vertex, &strand);
            if self.settings.max_depth.is_none_or(|limit| strand.bounces < limit) {
                result += strand.throughput * self.light_at(&vertex, &strand, role, sampler);
            }
            if role == Role::Gather && !strand.is_split && self.settings.photon_map.gather_rays > 1 {
                return result + self.follow_split(&vertex, &strand, sampler);
            }
            let limit = self.settings.max_depth;
            if !strand.scatter(self.world, &vertex, role == Role::LookUp, limit, sampler) {
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
            if strand.scatter(self.world, vertex, false, self.settings.max_depth, &mut sampler) {
                result += self.follow(strand, &mut sampler, None);
            }
        }
        result
    }

    fn role(&self, vertex: &Vertex, strand: &Strand) -> Role {
        if is_specular(&vertex.bsdf) {
            return Role::Specular;
        }
        let looks_up = match strand.origin {
            Origin::Camera => !self.settings.photon_map.final_gather && vertex.bsdf.has_diffuse_part(),
            Origin::Gather { distance, .. } => distance >= self.maps.corner,
        };
        if looks_up { Role::LookUp } else { Role::Gather }
    }

    /// The light that the surface sends back along the strand and that is counted here.
    fn light_at(&mut self, vertex: &Vertex, strand: &Strand, role: Role, sampler: &mut Sampler) -> Spectrum {
        match role {
            Role::Specular if strand.origin != Origin::Camera || vertex.bsdf.is_delta() => Spectrum::ZERO,
            Role::Specular => self.direct_light(vertex, strand, true, sampler),
            Role::Gather => {
                self.direct_light(vertex, strand, true, sampler) + self.caustics(vertex, strand)
            }
            Role::LookUp => {
                let mut light = self.stored_light(vertex, strand);
                if !self.maps.holds_all {
                    light += self.direct_light(vertex, strand, false, sampler);
                    light += self.caustics(vertex, strand);
                }
                light
            }
        }
    }

    fn direct_light(
        &mut self,
        vertex: &Vertex,
        strand: &Strand,
        use_mis: bool,
        sampler: &mut Sampler,
    ) -> Spectrum {
        let light =
            DirectLight { world: self.world, vertex, wo: -strand.ray.direction, set: &strand.set, use_mis };
        light.sample_one(sampler, self.stats)
    }
}
