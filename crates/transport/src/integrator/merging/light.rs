//! Photons of a pass: from the lights through polished and nearly polished surfaces to the first wide one.

use super::weight::{self, SideOfChain};
use crate::photon::tree::PointTree;
use crate::stats::Stats;
use crate::walk::{self, Event, Flown, Vertex};
use crate::{RenderSettings, View};
use hyaline_geometry::SurfaceHit;
use hyaline_math::{Ray, Vec2, Vec3, offset_origin};
use hyaline_sampling::Sampler;
use hyaline_scattering::{MediumSet, SurfaceBsdf, Transport};
use hyaline_spectrum::Spectrum;
use hyaline_world::light::{EmissionSample, Light};
use hyaline_world::material::Finish;
use hyaline_world::{World, mask};
use rayon::prelude::*;

/// Lobes at least as wide as this (on the scale of GGX) end a chain: photons land there and go no further.
const WIDE: f32 = 0.3;
/// Photons that one task follows; a fixed number, so that the same photons go together for any number of threads.
const CHUNK: u32 = 2048;
/// Crossings after which roulette ends even lossless photons now and then, and shading normals are left.
const PATIENCE: u32 = 64;
/// Keys the photons' random numbers apart from the pixels'.
const PHOTON_COLUMN: u32 = u32::MAX;
/// Photons in a leaf of the tree.
const LEAF: u32 = 16;

/// A photon that has landed.
#[derive(Clone, Copy, Debug)]
pub(super) struct CausticPhoton {
    /// The way it travelled, unit.
    pub(super) direction: Vec3,
    /// W, over all photons of the pass; in a medium what it scatters.
    pub(super) flux: Spectrum,
    /// Sum of the squares of the densities of the other ways to make its path, over that of merging, but for the factor
    /// of the receiver, which the eye's path knows.
    pub(super) others: f32,
}

/// All photons of a pass.
pub(super) struct Landed {
    /// Photons sent out.
    pub(super) sent: f32,
    /// Those on surfaces.
    pub(super) surface: PointTree<CausticPhoton>,
    /// Those in media.
    pub(super) volume: PointTree<CausticPhoton>,
}

/// Whether a finish is one that photons land on for good and that eye paths start anew from.
pub(super) fn is_wide(bsdf: &SurfaceBsdf) -> bool {
    !bsdf.is_delta() && bsdf.lobe_width() >= WIDE
}

/// Photons that a pass sends out.
pub(super) fn count(world: &World, view: &View) -> u32 {
    let has_power = world.lights.emission().sample(0.5).is_some();
    let is_specular = world.items.iter().any(|item| {
        let slots = item.slot_materials.iter().chain([&item.material]);
        slots.into_iter().any(|&index| is_specular(&world.materials[index as usize].finish))
    });
    if has_power && is_specular { (4 * view.width * view.height).clamp(1 << 16, 1 << 20) } else { 0 }
}

/// Whether chains can pass a finish.
fn is_specular(finish: &Finish) -> bool {
    !matches!(finish, Finish::Matte { .. } | Finish::Phong { .. } | Finish::Black | Finish::PassThrough)
}

/// Sends out the photons of a pass.
pub(super) fn trace(
    world: &World,
    settings: &RenderSettings,
    pass: u32,
    photons: u32,
    stats: &mut Stats,
) -> Landed {
    let chunks: Vec<Chunk> = (0..photons.div_ceil(CHUNK))
        .into_par_iter()
        .map(|index| {
            let mut chunk = Chunk::default();
            for photon in index * CHUNK..((index + 1) * CHUNK).min(photons) {
                let sampler = Sampler::new(settings.sampler, settings.seed, (PHOTON_COLUMN, pass), photon);
                chunk.follow(world, sampler, 1.0 / photons as f32);
            }
            chunk
        })
        .collect();
    stats.photons += u64::from(photons);
    let (mut surface, mut volume) = (Vec::new(), Vec::new());
    for chunk in chunks {
        surface.extend(chunk.surface);
        volume.extend(chunk.volume);
        stats.add(&chunk.stats);
    }
    let sent = photons as f32;
    Landed { sent, surface: PointTree::build(surface, LEAF), volume: PointTree::build(volume, LEAF) }
}

/// What one task collects.
#[derive(Default)]
struct Chunk {
    surface: Vec<(Vec3, CausticPhoton)>,
    volume: Vec<(Vec3, CausticPhoton)>,
    stats: Stats,
}

/// A photon on its way.
struct Photon<'w> {
    light: &'w Light,
    index: usize,
    start: EmissionSample,
    ray: Ray,
    flux: Spectrum,
    /// Polished and nearly polished surfaces that it has met.
    chain: u32,
    others: f32,
    /// The factor of the light, for lights that paths can hit.
    at_light: f32,
}

impl Chunk {
    fn follow(&mut self, world: &World, mut sampler: Sampler, share: f32) {
        let Some((mut photon, mut set)) = start(world, &mut sampler, share) else { return };
        let full = photon.flux.max_lane(world.lanes);
        loop {
            let event = if world.has_volumes {
                let flown = walk::fly(
                    world,
                    &photon.ray,
                    mask::PATH,
                    &mut set,
                    photon.flux,
                    &mut sampler,
                    &mut self.stats,
                );
                match flown.0 {
                    Flown::Arrived(event) => event,
                    Flown::Scattered(place) => {
                        if photon.chain > 0 {
                            self.volume.push((place.p, photon.land(photon.flux * place.weight)));
                        }
                        return;
                    }
                }
            } else {
                walk::advance(world, &photon.ray, mask::PATH, &mut set, &mut self.stats)
            };
            let Event::Surface(mut vertex) = event else { return };
            if photon.chain > PATIENCE {
                vertex.bsdf = vertex.bsdf.without_shading_normal();
            }
            photon.flux *= vertex.transmittance;
            if photon.chain > 0 && !vertex.bsdf.is_delta() {
                self.surface.push((vertex.hit.p, photon.land(photon.flux)));
            }
            if !photon.go_on(world, &vertex, &mut set, &mut sampler, full) {
                return;
            }
        }
    }
}

fn start<'w>(world: &'w World, sampler: &mut Sampler, share: f32) -> Option<(Photon<'w>, MediumSet)> {
    let (u_choice, u_position, u_direction) = (sampler.next_1d(), sampler.next_2d(), sampler.next_2d());
    let choice = world.lights.emission().sample(u_choice)?;
    let light = world.lights.get(choice.index);
    let start = light.sample_emission(u_position, u_direction)?;
    let origin = match start.n {
        Some(n) => offset_origin(start.origin, start.p_error, n, start.direction),
        None => start.origin,
    };
    let set = world.emission_set(choice.index as u32, start.n, start.direction).clone();
    let ior = world.ior(set.active());
    let cos = start.n.map_or(1.0, |n| n.dot(start.direction).abs());
    let at_light = weight::at_light(choice.probability, start.pdf_position, start.pdf_direction, ior, cos);
    let can_be_hit = !start.is_delta_position && !start.is_delta_direction;
    let others = if can_be_hit { (at_light * at_light).recip() } else { 0.0 };
    let photon = Photon {
        light,
        index: choice.index,
        start,
        ray: Ray::new(origin, start.direction),
        flux: start.weight * (share / choice.probability),
        chain: 0,
        others,
        at_light,
    };
    Some((photon, set))
}

impl Photon<'_> {
    fn land(&self, flux: Spectrum) -> CausticPhoton {
        CausticPhoton { direction: self.ray.direction, flux, others: self.others }
    }

    /// Scatters; returns whether the photon goes on.
    fn go_on(
        &mut self,
        world: &World,
        vertex: &Vertex,
        set: &mut MediumSet,
        sampler: &mut Sampler,
        full: f32,
    ) -> bool {
        let wo = -self.ray.direction;
        let (u_lobe, u): (f32, Vec2) = (sampler.next_1d(), sampler.next_2d());
        let Some(scattered) = vertex.bsdf.sample(wo, u_lobe, u, Transport::Importance) else { return false };
        if !scattered.is_delta && is_wide(&vertex.bsdf) {
            return false;
        }
        let ior_before = world.ior(set.active());
        if scattered.transmits {
            vertex.commit(world, set);
        }
        if !scattered.is_delta {
            let toward_receiver = SideOfChain {
                pdf: scattered.pdf,
                ior: world.ior(set.active()),
                cos: scattered.wi.dot(vertex.hit.ng).abs(),
            };
            let toward_light = SideOfChain {
                pdf: vertex.bsdf.pdf(scattered.wi, wo),
                ior: ior_before,
                cos: wo.dot(vertex.hit.ng).abs(),
            };
            self.pass_rough(world, &vertex.hit, wo, toward_receiver, toward_light);
        }
        self.chain += 1;
        self.flux *= scattered.weight;
        let left = self.flux.max_lane(world.lanes) / full;
        let survival = if self.chain > PATIENCE { left.min(0.9) } else { left.min(1.0) };
        if !(survival > 0.0) || sampler.next_1d() >= survival {
            return false;
        }
        self.flux *= 1.0 / survival;
        self.ray = Ray::new(
            offset_origin(vertex.hit.p, vertex.hit.p_error, vertex.hit.ng, scattered.wi),
            scattered.wi,
        );
        true
    }

    /// Accounts for a rough vertex of the chain; at the first one the light could have been sampled, too.
    fn pass_rough(
        &mut self,
        world: &World,
        hit: &SurfaceHit,
        wo: Vec3,
        toward_receiver: SideOfChain,
        toward_light: SideOfChain,
    ) {
        let mut sampled = 0.0;
        let mut factor = weight::across(toward_receiver, toward_light);
        if self.chain == 0 {
            let chance = world.lights.direct().probability(self.index);
            if self.start.is_delta_position || self.start.is_delta_direction {
                // No path hits the light: sampling it stands where drawing its direction would.
                factor *= toward_light.pdf;
                sampled = chance / (self.at_light * squared_way(&self.start, hit));
            } else {
                let direct = self.light.pdf_direct(hit.p, wo, light_hit(&self.start).as_ref());
                sampled = chance * direct / (self.at_light * toward_light.pdf);
            }
        }
        self.others = (self.others + sampled * sampled) / (factor * factor);
    }
}

/// What stands for the cosine at a light that is a point: 1 / d² for the way to it; 1 for parallel light.
fn squared_way(start: &EmissionSample, hit: &SurfaceHit) -> f32 {
    if start.is_delta_position { 1.0 / start.origin.distance_squared(hit.p) } else { 1.0 }
}

/// The place on a light where a photon started, as a path would hit it.
fn light_hit(start: &EmissionSample) -> Option<SurfaceHit> {
    let n = start.n?;
    let (p, p_error) = (start.origin, start.p_error);
    Some(SurfaceHit { t: 0.0, p, p_error, ng: n, n, uv: Vec2::ZERO, dpdu: Vec3::ZERO, item: 0, primitive: 0 })
}
