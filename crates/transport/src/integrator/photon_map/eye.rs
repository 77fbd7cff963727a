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
//! 5. Where media scatter, a ray from the camera marches: at each stop it asks for the light that comes straight from a
//!    lamp by a shadow ray, and the volume map for all other; with single scattering in the map, for all. A gather ray flies
//!    instead, and where a particle scatters it asks for the same and ends.
//! 6. Without final gathering the light at step 2 is looked up as at step 3, caustics included. Glossy surfaces
//!    gather nevertheless: too few photons fall into their lobes.
//!
//! Source: Jensen, Realistic Image Synthesis Using Photon Mapping, 2001, §9.2 and §10.4.

use super::strand::{Origin, Strand};
use crate::direct::DirectLight;
use crate::first_hit;
use crate::in_volume::VolumeLight;
use crate::integrator::RenderSettings;
use crate::march::Found;
use crate::photon::gather::{Estimate, Gathered, PhotonMap};
use crate::photon::maps::PhotonMaps;
use crate::photon::record::PhotonKind;
use crate::photon::specular::is_specular;
use crate::photon::stopwatch::Stopwatch;
use crate::photon::tree::Nearest;
use crate::stats::Stats;
use crate::walk::{Flown, Vertex};
use hyaline_film::PixelSample;
use hyaline_math::Vec3;
use hyaline_sampling::Sampler;
use hyaline_scattering::MediumSet;
use hyaline_spectrum::Spectrum;
use hyaline_world::World;

/// Follows camera paths, one after the other.
pub(super) struct Eye<'a> {
    world: &'a World,
    settings: &'a RenderSettings,
    maps: &'a PhotonMaps,
    stats: &'a mut Stats,
    scratch: Nearest,
    found: Found,
    times: Times,
}

/// Time spent on look-ups.
#[derive(Default)]
struct Times {
    caustic: Stopwatch,
    global: Stopwatch,
    volume: Stopwatch,
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
        Self {
            world,
            settings,
            maps,
            stats,
            scratch: Nearest::default(),
            found: Found::default(),
            times: Times::default(),
        }
    }

    /// Adds the times of look-ups to those of all threads.
    pub(super) fn tell_times(&self) {
        let totals = &self.maps.look_ups;
        totals.caustic.add(&self.times.caustic);
        totals.global.add(&self.times.global);
        totals.volume.add(&self.times.volume);
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
        while let Some(vertex) = self.walk(&mut strand, &mut result, sampler) {
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

    /// Walks to the next surface. The light of media on the way, of the surface and of the surroundings is added to
    /// `light`.
    fn walk(&mut self, strand: &mut Strand, light: &mut Spectrum, sampler: &mut Sampler) -> Option<Vertex> {
        let flown = strand.fly(self.world, self.settings, &mut self.found, sampler, self.stats);
        if !self.world.has_volumes {
            let Flown::Arrived(event) = flown else { return None };
            return strand.arrive(self.world, event, light);
        }
        *light += self.light_of_media(strand, &flown, sampler);
        let Flown::Arrived(event) = flown else { return None };
        let vertex = strand.arrive(self.world, event, light)?;
        strand.survives_fog(self.world.lanes, sampler).then_some(vertex)
    }

    /// Light that media on a strand's way send and scatter back along it.
    fn light_of_media(&mut self, strand: &Strand, flown: &Flown, sampler: &mut Sampler) -> Spectrum {
        let wo = -strand.ray.direction;
        let may_scatter = self.settings.max_depth.is_none_or(|limit| strand.bounces < limit);
        let mut light = match strand.origin {
            Origin::LookUp => return Spectrum::ZERO,
            Origin::Camera | Origin::Gather { .. } => self.found.emitted,
        };
        if !may_scatter {
            return strand.throughput * light;
        }
        if let Flown::Scattered(place) = flown {
            let medium = &self.world.media[place.medium.index()];
            let sigma_s = medium.sigma_s_at(place.p, medium.density(place.p));
            let scattered = self.scattered((place.p, sigma_s), wo, &strand.set, sampler);
            light +=
                place.weight * scattered * sigma_s.map(|sigma| if sigma > 0.0 { 1.0 / sigma } else { 0.0 });
        } else if strand.origin == Origin::Camera {
            let found = std::mem::take(&mut self.found);
            for (stop, set) in found.stops() {
                light += stop.weight * self.scattered((stop.p, stop.sigma_s), wo, set, sampler);
            }
            self.found = found;
        }
        strand.throughput * light
    }

    /// Light that a unit of path scatters toward `wo` at a place of known scattering coefficient: σ_s ∫ p L dω.
    fn scattered(
        &mut self,
        (p, sigma_s): (Vec3, Spectrum),
        wo: Vec3,
        set: &MediumSet,
        sampler: &mut Sampler,
    ) -> Spectrum {
        let (world, maps) = (self.world, self.maps);
        let mut light = Spectrum::ZERO;
        if self.settings.photon_map.exclude_single_scattering {
            let place = VolumeLight { world, p, medium: set.active(), wo, set };
            light += sigma_s * place.sample_one(sampler, self.stats);
        }
        let known = (&mut self.scratch, &mut *self.stats);
        let look_up = || maps.volume.scattered(world, p, wo, set, sampler, known);
        if let Some(gathered) = self.times.volume.time(look_up) {
            light += gathered.value;
        }
        light
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
        let (maps, wo, scratch) = (self.maps, -strand.ray.direction, &mut self.scratch);
        let mut look_up = |map: &PhotonMap, estimate: &Estimate| {
            let radiance = || estimate.radiance(map, &vertex.hit, &vertex.bsdf, wo, |_| true, scratch);
            self.times.caustic.time(radiance).value
        };
        if strand.origin == Origin::Camera {
            light += look_up(&maps.caustic, &maps.caustic_estimate);
        }
        if role == Role::Gather {
            light += look_up(&maps.rebound, &maps.rebound_estimate);
        }
        light
    }

    /// Light in the global map. The caustics that a gather ray meets are counted where it began.
    fn stored_light(&mut self, vertex: &Vertex, strand: &Strand) -> Gathered {
        let counts = |kind| strand.origin == Origin::Camera || kind != PhotonKind::Caustic;
        let (map, estimate, scratch) = (&self.maps.global, &self.maps.global_estimate, &mut self.scratch);
        let wo = -strand.ray.direction;
        self.times.global.time(|| estimate.radiance(map, &vertex.hit, &vertex.bsdf, wo, counts, scratch))
    }

    fn direct_light(&mut self, vertex: &Vertex, strand: &Strand, sampler: &mut Sampler) -> Spectrum {
        let (wo, set) = (-strand.ray.direction, &strand.set);
        DirectLight { world: self.world, vertex, wo, set, use_mis: true }.sample_one(sampler, self.stats)
    }
}
