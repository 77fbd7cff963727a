//! Photons of a pass: from the lights through the scene, kept at every vertex that is not singular but for the first.
//!
//! What comes straight from a light is left to light sampling. Each photon carries the sum of the other ways to make its
//! path, as the path from the eye carries that of its own side (`eye/merges`, `eye/weight`).

use super::landed::{Landed, LandedPhoton};
use super::sender::{Sender, Senders};
use crate::RenderSettings;
use crate::direct;
use crate::in_volume;
use crate::integrator::eye::place::volume_factor;
use crate::integrator::eye::radius::GatherRadius;
use crate::integrator::eye::weight::{self, Side};
use crate::photon::PhotonStart;
use crate::photon::specular::is_specular_event;
use crate::stats::Stats;
use crate::walk::{self, Event, Flown, Vertex, VolumeVertex};
use hyaline_geometry::SurfaceHit;
use hyaline_math::{Ray, Vec2, Vec3};
use hyaline_sampling::Sampler;
use hyaline_scattering::{BsdfSample, MediumSet, Transport};
use hyaline_spectrum::Spectrum;
use hyaline_world::light::Light as WorldLight;
use hyaline_world::{World, mask};
use rayon::prelude::*;
use std::ops::Range;

/// Photons that one task follows; a fixed number, so that the same photons go together for any number of threads.
const CHUNK: u32 = 2048;
/// Vertices after which roulette ends even lossless photons now and then, and shading normals are left.
const PATIENCE: u32 = 64;
/// Key the senders' random numbers apart from the pixels' and from each other's.
const PHOTON_COLUMNS: [u32; 2] = [u32::MAX, u32::MAX - 1];

/// What the photons of a pass have in common.
pub(super) struct Light<'a> {
    pub(super) world: &'a World,
    pub(super) senders: &'a Senders<'a>,
    pub(super) settings: &'a RenderSettings,
    pub(super) radius: GatherRadius,
}

impl Light<'_> {
    /// Sends out the photons of a pass.
    pub(super) fn trace(&self, pass: u32, stats: &mut Stats) -> Landed {
        let (mut surface, mut volume) = (Vec::new(), Vec::new());
        for sender in [&self.senders.aimed, &self.senders.broad] {
            let chunks: Vec<Chunk> = (0..sender.count.div_ceil(CHUNK))
                .into_par_iter()
                .map(|index| self.chunk(sender, pass, index * CHUNK..((index + 1) * CHUNK).min(sender.count)))
                .collect();
            stats.photons += u64::from(sender.count);
            for chunk in chunks {
                surface.extend(chunk.surface);
                volume.extend(chunk.volume);
                stats.add(&chunk.stats);
            }
        }
        Landed::new(surface, volume)
    }

    fn chunk(&self, sender: &Sender<'_>, pass: u32, photons: Range<u32>) -> Chunk {
        let column = PHOTON_COLUMNS[usize::from(sender.is_aimed)];
        let mut chunk = Chunk::default();
        for photon in photons {
            let mut sampler = Sampler::new(self.settings.sampler, self.settings.seed, (column, pass), photon);
            if let Some(photon) = self.start(sender, &mut sampler) {
                self.follow(photon, &mut sampler, &mut chunk);
            }
        }
        chunk
    }

    fn start<'a>(&'a self, sender: &'a Sender<'_>, sampler: &mut Sampler) -> Option<Photon<'a>> {
        let start = sender.emitter.emit(sampler)?;
        let light = self.world.lights.get(start.light as usize);
        let at_light =
            sender.density(self.world, start.light as usize, start.n, start.ray.direction, &start.set);
        let flux = start.flux * (1.0 / sender.count as f32);
        let is_delta = direct::is_delta(light);
        Some(Photon {
            light,
            sender,
            is_delta,
            set: start.set.clone(),
            ray: start.ray,
            flux,
            full: flux.max_lane(self.world.lanes),
            vertices: 0,
            bounces: 0,
            comes_straight: true,
            others: if is_delta { 0.0 } else { (at_light * at_light).recip() },
            at_light,
            start,
        })
    }

    fn follow(&self, mut photon: Photon<'_>, sampler: &mut Sampler, chunk: &mut Chunk) {
        loop {
            let goes_on = match self.walk(&mut photon, sampler, &mut chunk.stats) {
                Flown::Arrived(Event::Sky { .. }) => false,
                Flown::Arrived(Event::Surface(vertex)) => {
                    self.at_surface(&mut photon, vertex, sampler, chunk)
                }
                Flown::Scattered(place) => self.at_place(&mut photon, &place, sampler, chunk),
            };
            if !goes_on || !photon.survives(self.world, sampler) {
                return;
            }
        }
    }

    fn walk(&self, photon: &mut Photon<'_>, sampler: &mut Sampler, stats: &mut Stats) -> Flown {
        let Photon { ray, set, flux, .. } = photon;
        if self.world.has_volumes {
            return walk::fly(self.world, ray, mask::PATH, set, *flux, sampler, stats).0;
        }
        Flown::Arrived(walk::advance(self.world, ray, mask::PATH, set, stats))
    }

    /// Whether a photon may scatter once more where it is, other than as polished surfaces do, and still be counted at
    /// the next vertex.
    fn may_bounce(&self, photon: &Photon<'_>) -> bool {
        self.settings.max_depth.is_none_or(|limit| photon.bounces + 1 < limit)
    }

    /// Lands and scatters; returns whether the photon goes on.
    fn at_surface(
        &self,
        photon: &mut Photon<'_>,
        mut vertex: Vertex,
        sampler: &mut Sampler,
        chunk: &mut Chunk,
    ) -> bool {
        if photon.vertices > PATIENCE {
            vertex.bsdf = vertex.bsdf.without_shading_normal();
        }
        photon.flux *= vertex.transmittance;
        if photon.lands() && !vertex.bsdf.is_delta() {
            chunk.surface.push((vertex.hit.p, photon.landed(photon.flux)));
        }
        let wo = -photon.ray.direction;
        let (u_lobe, u): (f32, Vec2) = (sampler.next_1d(), sampler.next_2d());
        let Some(scattered) = vertex.bsdf.sample(wo, u_lobe, u, Transport::Importance) else { return false };
        let is_specular = is_specular_event(&vertex.bsdf, scattered.is_delta);
        if photon.vertices == 0 && is_specular != photon.sender.is_aimed {
            return false;
        }
        let ior_before = self.world.ior(photon.set.active());
        if scattered.transmits {
            vertex.commit(self.world, &mut photon.set);
        }
        if !scattered.is_delta {
            // What comes straight through straight shadows, the vertex's own shadow rays bring.
            if photon.vertices > 0 && photon.comes_straight || !self.may_bounce(photon) {
                return false;
            }
            self.pass(photon, &vertex, &scattered, ior_before);
        }
        photon.comes_straight &= vertex.passes_straight(scattered.transmits);
        photon.flux *= scattered.weight;
        photon.ray = vertex.leave(scattered.wi, 0.0);
        true
    }

    /// Lands and scatters at a particle; returns whether the photon goes on.
    fn at_place(
        &self,
        photon: &mut Photon<'_>,
        place: &VolumeVertex,
        sampler: &mut Sampler,
        chunk: &mut Chunk,
    ) -> bool {
        photon.flux *= place.weight;
        if photon.lands() {
            chunk.volume.push((place.p, photon.landed(photon.flux)));
        }
        let is_first = photon.vertices == 0;
        let may_scatter = if is_first { !photon.sender.is_aimed } else { !photon.comes_straight };
        if !may_scatter || !self.may_bounce(photon) {
            return false;
        }
        let wo = -photon.ray.direction;
        let phase = in_volume::phase_at(self.world, place);
        let wi = phase.sample(wo, sampler.next_2d());
        let pdf = phase.value(wo, wi);
        let own = volume_factor(self.world, place, self.radius.in_volume(place.p)) / pdf;
        let light = self.light_sampled(photon, place.p, wo, pdf, is_first);
        photon.pass(light, own, 1.0);
        photon.comes_straight = false;
        photon.ray = Ray::new(place.p, wi);
        true
    }

    /// Accounts for a vertex on a surface that is passed by a lobe that is not singular.
    fn pass(&self, photon: &mut Photon<'_>, vertex: &Vertex, scattered: &BsdfSample, ior_before: f32) {
        let wo = -photon.ray.direction;
        let cos = |w: Vec3| w.dot(vertex.hit.ng).abs();
        let toward_receiver =
            Side { pdf: scattered.pdf, ior: self.world.ior(photon.set.active()), cos: cos(scattered.wi) };
        let toward_light = Side { pdf: vertex.bsdf.pdf(scattered.wi, wo), ior: ior_before, cos: cos(wo) };
        let radius = self.radius.on_surface(vertex.hit.p);
        let own = weight::at_receiver(radius, toward_light.ior, toward_light.cos, toward_light.pdf);
        let light = self.light_sampled(photon, vertex.hit.p, wo, toward_light.pdf, photon.vertices == 0);
        photon.pass(light, own, weight::across(toward_receiver, toward_light));
    }

    /// What the vertex next to the light counts for that could have sampled it.
    ///
    /// - `wo`: back along the photon's way; `pdf`: density of that direction, drawn from the eye's side.
    fn light_sampled(&self, photon: &Photon<'_>, p: Vec3, wo: Vec3, pdf: f32, is_first: bool) -> FirstVertex {
        if !is_first {
            return FirstVertex::Not;
        }
        let chance = self.world.lights.direct().probability(photon.start.light as usize);
        if photon.is_delta {
            // No path hits the light: sampling it stands where drawing its direction would.
            let density = photon.at_light * per_cosine(photon.light, &photon.start, p);
            return FirstVertex::Samples { ratio: chance / density, instead_of_pdf: pdf };
        }
        let direct = photon.light.pdf_direct(p, wo, light_hit(&photon.start).as_ref());
        FirstVertex::Samples { ratio: chance * direct / (photon.at_light * pdf), instead_of_pdf: 1.0 }
    }
}

/// What one task collects.
#[derive(Default)]
struct Chunk {
    surface: Vec<(Vec3, LandedPhoton)>,
    volume: Vec<(Vec3, LandedPhoton)>,
    stats: Stats,
}

/// What a vertex has to do with light sampling.
enum FirstVertex {
    /// Nothing: it is not next to the light.
    Not,
    /// It could have sampled the light.
    Samples {
        /// Density of that over that of hitting the light and the light's factor.
        ratio: f32,
        /// Factor on `across`, for lights that no path hits.
        instead_of_pdf: f32,
    },
}

/// A photon on its way.
struct Photon<'a> {
    light: &'a WorldLight,
    sender: &'a Sender<'a>,
    start: PhotonStart,
    /// Whether no path hits the light.
    is_delta: bool,
    ray: Ray,
    set: MediumSet,
    flux: Spectrum,
    /// What the largest lane of its flux was at first.
    full: f32,
    /// Vertices that it has passed.
    vertices: u32,
    /// Those of them that were not singular.
    bounces: u32,
    /// Whether all it has done was to cross surfaces with straight shadows.
    comes_straight: bool,
    others: f32,
    /// The factor of the light.
    at_light: f32,
}

impl Photon<'_> {
    /// Whether it is kept where it is now, if that is not singular.
    fn lands(&self) -> bool {
        // What comes straight, also through straight shadows, the receiver's shadow rays bring.
        self.vertices > 0 && !self.comes_straight
    }

    fn landed(&self, flux: Spectrum) -> LandedPhoton {
        LandedPhoton { direction: self.ray.direction, flux, others: self.others, bounces: self.bounces }
    }

    /// Accounts for a vertex that is not singular; `own` and `across` are its factors, see `weight`.
    fn pass(&mut self, light: FirstVertex, own: f32, across: f32) {
        let mut across = across;
        match light {
            FirstVertex::Not => self.others += own * own,
            FirstVertex::Samples { ratio, instead_of_pdf } => {
                self.others += ratio * ratio;
                across *= instead_of_pdf;
            }
        }
        self.others /= across * across;
        self.bounces += 1;
    }

    /// Roulette after a vertex: what goes on carries about as much as at first.
    fn survives(&mut self, world: &World, sampler: &mut Sampler) -> bool {
        self.vertices += 1;
        let left = self.flux.max_lane(world.lanes) / self.full;
        let survival = if self.vertices > PATIENCE { left.min(0.9) } else { left.min(1.0) };
        // Compared this way round, what is not a number ends the photon.
        let goes_on = sampler.next_1d() < survival;
        self.flux *= 1.0 / survival;
        goes_on
    }
}

/// What stands for the cosine at a light that no path hits: the inverse square of the way to a point, 1 for parallel
/// light.
fn per_cosine(light: &WorldLight, start: &PhotonStart, p: Vec3) -> f32 {
    match light {
        WorldLight::Directional(_) => 1.0,
        _ => 1.0 / start.origin.distance_squared(p),
    }
}

/// The place on a light where a photon started, as a path would hit it.
fn light_hit(start: &PhotonStart) -> Option<SurfaceHit> {
    let n = start.n?;
    let (p, p_error) = (start.origin, start.p_error);
    Some(SurfaceHit { t: 0.0, p, p_error, ng: n, n, uv: Vec2::ZERO, item: 0, primitive: 0 })
}
