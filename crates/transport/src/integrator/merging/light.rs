//! Photons of a pass: from the lights through polished and nearly polished surfaces to the first wide one.

use crate::direct;
use crate::integrator::eye::weight::{self, SideOfChain};
use crate::photon::specular::is_specular_event;
use crate::photon::tree::{PointTree, Region};
use crate::photon::{PhotonEmitter, PhotonStart};
use crate::stats::Stats;
use crate::walk::{self, Event, Flown, Vertex};
use crate::{RenderSettings, Techniques, View};
use hyaline_geometry::SurfaceHit;
use hyaline_math::{Ray, Vec2, Vec3};
use hyaline_sampling::Sampler;
use hyaline_scattering::{BsdfSample, MediumSet, Transport};
use hyaline_spectrum::Spectrum;
use hyaline_world::light::Light;
use hyaline_world::{World, mask};
use rayon::prelude::*;

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
pub(in crate::integrator) struct CausticPhoton {
    /// The way it travelled, unit.
    pub(in crate::integrator) direction: Vec3,
    /// W, over all photons of the pass; in a medium what it scatters.
    pub(in crate::integrator) flux: Spectrum,
    /// Sum of the squares of the densities of the other ways to make its path, over that of merging, but for the factor
    /// of the receiver, which the eye's path knows.
    pub(in crate::integrator) others: f32,
}

/// All photons of a pass.
pub(in crate::integrator) struct Landed {
    /// Photons sent out.
    pub(in crate::integrator) sent: f32,
    /// Those on surfaces.
    surface: PointTree<CausticPhoton>,
    /// Those in media.
    volume: PointTree<CausticPhoton>,
}

impl Landed {
    /// Sum of the light of every photon on a surface within a radius.
    pub(in crate::integrator) fn surface(
        &self,
        p: Vec3,
        radius: f32,
        light: impl FnMut(&CausticPhoton) -> Spectrum,
    ) -> Spectrum {
        sum(&self.surface, p, radius, light)
    }

    /// Sum of the light of every photon in a medium within a radius.
    pub(in crate::integrator) fn volume(
        &self,
        p: Vec3,
        radius: f32,
        light: impl FnMut(&CausticPhoton) -> Spectrum,
    ) -> Spectrum {
        sum(&self.volume, p, radius, light)
    }
}

fn sum(
    tree: &PointTree<CausticPhoton>,
    center: Vec3,
    radius: f32,
    mut light: impl FnMut(&CausticPhoton) -> Spectrum,
) -> Spectrum {
    let region = Region { center, radius, disc: None };
    tree.fold_within(&region, Spectrum::ZERO, |sum, index, _| sum + light(tree.payload(index)))
}

/// Photons that a pass sends out: none where no light can reach anything polished.
pub(super) fn count(emitter: &PhotonEmitter<'_>, view: &View) -> u32 {
    if emitter.fraction() > 0.0 { (2 * view.width * view.height).clamp(1 << 12, 1 << 20) } else { 0 }
}

/// Sends out the photons of a pass.
pub(in crate::integrator) fn trace(
    world: &World,
    emitter: &PhotonEmitter<'_>,
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
                chunk.follow(world, emitter, settings.techniques, sampler, 1.0 / photons as f32);
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
pub(in crate::integrator) struct Photon<'w> {
    pub(in crate::integrator) light: &'w Light,
    pub(in crate::integrator) index: usize,
    pub(in crate::integrator) start: PhotonStart,
    /// Whether no path hits the light.
    is_delta: bool,
    techniques: Techniques,
    pub(in crate::integrator) ray: Ray,
    flux: Spectrum,
    /// Polished and nearly polished surfaces that it has met.
    chain: u32,
    /// Whether all it has done was to cross surfaces with straight shadows.
    comes_straight: bool,
    pub(in crate::integrator) others: f32,
    /// The factor of the light, for lights that paths can hit.
    at_light: f32,
}

impl Chunk {
    fn follow(
        &mut self,
        world: &World,
        emitter: &PhotonEmitter<'_>,
        techniques: Techniques,
        mut sampler: Sampler,
        share: f32,
    ) {
        let Some((mut photon, mut set)) = start(world, emitter, techniques, &mut sampler, share) else {
            return;
        };
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
                        if photon.chain > 0 && !photon.comes_straight {
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
            // What comes straight through straight shadows, the receiver's shadow rays bring.
            if photon.chain > 0 && !photon.comes_straight && !vertex.bsdf.is_delta() {
                self.surface.push((vertex.hit.p, photon.land(photon.flux)));
            }
            if !photon.go_on(world, &vertex, &mut set, &mut sampler, full) {
                return;
            }
        }
    }
}

pub(in crate::integrator) fn start<'w>(
    world: &'w World,
    emitter: &PhotonEmitter<'_>,
    techniques: Techniques,
    sampler: &mut Sampler,
    share: f32,
) -> Option<(Photon<'w>, MediumSet)> {
    let start = emitter.emit(sampler)?;
    let index = start.light as usize;
    let light = world.lights.get(index);
    let at_light = emission_density(world, emitter, index, start.n, start.ray.direction, &start.set);
    let is_delta = direct::is_delta(light);
    let others = if is_delta || !techniques.hits { 0.0 } else { (at_light * at_light).recip() };
    let (set, ray, flux) = (start.set.clone(), start.ray, start.flux * share);
    Some((
        Photon {
            light,
            index,
            start,
            is_delta,
            techniques,
            ray,
            flux,
            chain: 0,
            comes_straight: true,
            others,
            at_light,
        },
        set,
    ))
}

/// The factor of a light, for photons that meet something polished first: those the emitter sends out, and their
/// density is that of the light over the share of its light that is sent out.
///
/// - `direction`: the way the photon travels.
pub(in crate::integrator) fn emission_density(
    world: &World,
    emitter: &PhotonEmitter<'_>,
    light: usize,
    n: Option<Vec3>,
    direction: Vec3,
    set: &MediumSet,
) -> f32 {
    let chance = world.lights.emission().probability(light) / emitter.fraction();
    let pdf = world.lights.get(light).pdf_emission(n.unwrap_or(Vec3::Y), direction);
    let cos = n.map_or(1.0, |n| n.dot(direction).abs());
    weight::at_light(chance, pdf.position, pdf.direction, world.ior(set.active()), cos)
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
        if !is_specular_event(&vertex.bsdf, scattered.is_delta) {
            return false;
        }
        self.turn(world, vertex, set, &scattered);
        let left = self.flux.max_lane(world.lanes) / full;
        let survival = if self.chain > PATIENCE { left.min(0.9) } else { left.min(1.0) };
        // Compared this way round, what is not a number ends the photon.
        let goes_on = sampler.next_1d() < survival;
        self.flux *= 1.0 / survival;
        goes_on
    }

    /// Sends the photon on in the direction that was drawn, and keeps true what its weight goes by.
    pub(in crate::integrator) fn turn(
        &mut self,
        world: &World,
        vertex: &Vertex,
        set: &mut MediumSet,
        scattered: &BsdfSample,
    ) {
        let wo = -self.ray.direction;
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
        self.comes_straight &= vertex.passes_straight(scattered.transmits);
        self.flux *= scattered.weight;
        self.ray = vertex.leave(scattered.wi, 0.0);
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
            let is_sampled = f32::from(u8::from(self.techniques.sampling));
            let chance = is_sampled * world.lights.direct().probability(self.index);
            if self.is_delta {
                // No path hits the light: sampling it stands where drawing its direction would.
                factor *= toward_light.pdf;
                sampled = chance / (self.at_light * per_cosine(self.light, &self.start, hit));
            } else {
                let direct = self.light.pdf_direct(hit.p, wo, light_hit(&self.start).as_ref());
                sampled = chance * direct / (self.at_light * toward_light.pdf);
            }
        }
        self.others = (self.others + sampled * sampled) / (factor * factor);
    }
}

/// What stands for the cosine at a light that no path hits: the inverse square of the way to a point, 1 for parallel
/// light.
fn per_cosine(light: &Light, start: &PhotonStart, hit: &SurfaceHit) -> f32 {
    match light {
        Light::Directional(_) => 1.0,
        _ => 1.0 / start.origin.distance_squared(hit.p),
    }
}

/// The place on a light where a photon started, as a path would hit it.
fn light_hit(start: &PhotonStart) -> Option<SurfaceHit> {
    let n = start.n?;
    let (p, p_error) = (start.origin, start.p_error);
    Some(SurfaceHit { t: 0.0, p, p_error, ng: n, n, uv: Vec2::ZERO, item: 0, primitive: 0 })
}
