//! Photons of a pass: from the lights through the scene, kept at every vertex that is not singular but for the first.
//!
//! What comes straight from a light is left to light sampling. Each photon carries the sum of the other ways to make its
//! path, as the path from the eye carries that of its own side (`eye/merges`, `eye/weight`).

use super::beams::Beam;
use super::landed::{Landed, LandedPhoton, Landing, PhotonId, Points};
use super::origin::Origin;
use super::sender::{BEAM_SHARE, Sender, Senders};
use crate::RenderSettings;
use crate::in_volume;
use crate::integrator::eye::asking;
use crate::integrator::eye::merges::Place;
use crate::integrator::eye::place::volume_factor;
use crate::integrator::eye::radius::{GatherRadius, INDIRECT};
use crate::integrator::eye::reach::RoughNormal;
use crate::integrator::eye::weight::{self, Side};
use crate::photon::emission::start_numbers;
use crate::photon::specular::is_specular_event;
use crate::roulette::{PATIENCE_WITH_SHADING_NORMALS, Past, survival};
use crate::stats::Stats;
use crate::walk::{self, Event, Flown, Stretch, Vertex, VolumeVertex};
use hyaline_math::{Ray, Vec2, Vec3};
use hyaline_sampling::Sampler;
use hyaline_scattering::volume::BeamWeight;
use hyaline_scattering::{BsdfSample, Medium, MediumSet, Transport};
use hyaline_spectrum::Spectrum;
use hyaline_world::{World, mask};
use rayon::prelude::*;
use std::ops::Range;

/// Photons that one task follows; a fixed number, so that the same photons go together for any number of threads.
const CHUNK: u32 = 2048;
/// Key the senders' random numbers apart from the pixels' and from each other's.
const PHOTON_COLUMNS: [u32; 2] = [u32::MAX, u32::MAX - 1];

/// What the photons of a pass have in common.
pub(in crate::integrator) struct Light<'a> {
    pub(in crate::integrator) world: &'a World,
    pub(in crate::integrator) senders: &'a Senders<'a>,
    pub(in crate::integrator) settings: &'a RenderSettings,
    pub(in crate::integrator) radius: GatherRadius,
}

impl Light<'_> {
    /// Sends out the photons of a pass.
    pub(in crate::integrator) fn trace(&self, pass: u32, stats: &mut Stats) -> Landed {
        let (mut points, mut beams) = (Points::default(), Vec::new());
        for sender in [&self.senders.aimed, &self.senders.broad] {
            let chunks: Vec<Chunk> = (0..sender.count.div_ceil(CHUNK))
                .into_par_iter()
                .map(|index| self.chunk(sender, pass, index * CHUNK..((index + 1) * CHUNK).min(sender.count)))
                .collect();
            stats.photons += u64::from(sender.count);
            for chunk in chunks {
                points.extend(chunk.points);
                beams.extend(chunk.beams);
                stats.add(&chunk.stats);
            }
        }
        Landed::new(points, beams, self.radius)
    }

    fn chunk(&self, sender: &Sender<'_>, pass: u32, photons: Range<u32>) -> Chunk {
        let mut chunk = Chunk::default();
        for photon in photons {
            let mut sampler = sampler_of(self.settings, sender, pass, photon);
            if let Some(photon) = self.start(sender, photon, &mut sampler) {
                self.follow(photon, &mut sampler, &mut chunk);
            }
        }
        chunk
    }

    /// - `number`: of the photon, among those of its sender.
    pub(in crate::integrator) fn start<'a>(
        &'a self,
        sender: &'a Sender<'_>,
        number: u32,
        sampler: &mut Sampler,
    ) -> Option<Photon<'a>> {
        let (numbers, guided) = sender.guide.warp(start_numbers(sampler));
        let start = sender.emitter.emit_from(numbers)?;
        let at_light =
            sender.density(self.world, start.light as usize, start.n, start.ray.direction, &start.set);
        let flux = start.flux * (1.0 / (sender.count as f32 * guided));
        let origin = Origin::new(self.world, &start, at_light, self.settings.techniques);
        Some(Photon {
            sender,
            origin,
            set: start.set,
            ray: start.ray,
            flux,
            full: flux.max_lane(self.world.lanes),
            vertices: 0,
            bounces: 0,
            collisions: 0,
            crossings: 0,
            comes_straight: true,
            leaves_beams: number < sender.beams(),
            id: PhotonId::new(sender.is_aimed, number),
            is_indirect: false,
            others: origin.hit(),
        })
    }

    fn follow(&self, mut photon: Photon<'_>, sampler: &mut Sampler, chunk: &mut Chunk) {
        loop {
            let goes_on = match self.walk(&mut photon, sampler, chunk) {
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

    /// To the next vertex; where the photon leaves beams, they are kept.
    fn walk(&self, photon: &mut Photon<'_>, sampler: &mut Sampler, chunk: &mut Chunk) -> Flown {
        let straight_from = photon.straight_from();
        let keeps_beams = photon.leaves_beams && photon.beams_count();
        let (others, bounces, id) = (photon.others, photon.bounces, photon.id);
        let Photon { ray, set, flux, .. } = photon;
        let flux = *flux;
        if !self.world.has_volumes {
            return Flown::Arrived(walk::advance(self.world, ray, mask::PATH, set, &mut chunk.stats));
        }
        let (beams, stats) = (&mut chunk.beams, &mut chunk.stats);
        let keep = |stretch: &Stretch<'_>| {
            if !keeps_beams {
                return;
            }
            let carried = flux * stretch.left;
            let weight = BeamWeight::new(stretch.medium, carried, self.world.lanes);
            beams.push(Beam {
                origin: stretch.ray.origin,
                direction: stretch.ray.direction,
                length: weight.length(stretch.way, stretch.flown),
                medium: stretch.id,
                flux: carried * (1.0 / BEAM_SHARE),
                weight,
                straight_from,
                others,
                bounces,
                id,
            });
        };
        walk::fly_watched(self.world, ray, mask::PATH, set, flux, sampler, stats, keep).0
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
        if photon.crossings > PATIENCE_WITH_SHADING_NORMALS {
            vertex.bsdf = vertex.bsdf.without_shading_normal();
        }
        photon.flux *= vertex.transmittance;
        if photon.lands() && !vertex.bsdf.is_delta() {
            let points = &mut chunk.points;
            let points = if photon.is_indirect { &mut points.indirect } else { &mut points.caustic };
            points.push((vertex.hit.p, photon.landed_on(vertex.hit.ng)));
        }
        let wo = -photon.ray.direction;
        let (u_lobe, u): (f32, Vec2) = (sampler.next_1d(), sampler.next_2d());
        let Some(scattered) = vertex.bsdf.sample(wo, u_lobe, u, Transport::Importance) else { return false };
        let is_specular = is_specular_event(&vertex.bsdf, scattered.is_delta);
        if photon.vertices == 0 && is_specular != photon.sender.is_aimed {
            return false;
        }
        // What comes straight through straight shadows, the vertex's own shadow rays bring.
        let is_theirs = photon.vertices > 0 && photon.comes_straight;
        if !scattered.is_delta && (is_theirs || !self.may_bounce(photon)) {
            return false;
        }
        self.turn(photon, &vertex, &scattered);
        true
    }

    /// Sends the photon on in the direction that was drawn, and keeps all true that weights go by.
    pub(in crate::integrator) fn turn(
        &self,
        photon: &mut Photon<'_>,
        vertex: &Vertex,
        scattered: &BsdfSample,
    ) {
        let ior_before = self.world.ior(photon.set.active());
        if scattered.transmits {
            vertex.commit(self.world, &mut photon.set);
        }
        if scattered.is_delta {
            photon.crossings += 1;
        } else {
            photon.crossings = 0;
            self.pass(photon, vertex, scattered, ior_before);
            photon.is_indirect |= !is_specular_event(&vertex.bsdf, false);
        }
        photon.comes_straight &= vertex.passes_straight(scattered.transmits);
        photon.flux *= scattered.weight;
        photon.ray = vertex.leave(scattered.wi, 0.0);
        photon.vertices += 1;
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
        let medium = &self.world.media[place.medium.index()];
        if photon.lands() && Place::in_medium(medium) == Place::Grid {
            chunk.points.volume.push((place.p, photon.landed_in(medium, place.p)));
        }
        let may_scatter = if photon.vertices == 0 { !photon.sender.is_aimed } else { !photon.comes_straight };
        if !may_scatter || !self.may_bounce(photon) {
            return false;
        }
        let wo = -photon.ray.direction;
        let phase = in_volume::phase_at(self.world, place);
        let wi = phase.sample(wo, sampler.next_2d());
        self.turn_at_place(photon, place, wi, phase.value(wo, wi));
        true
    }

    /// Sends the photon on in the direction that was drawn, and keeps all true that weights go by.
    ///
    /// - `pdf`: density of `wi`, sr⁻¹.
    pub(in crate::integrator) fn turn_at_place(
        &self,
        photon: &mut Photon<'_>,
        place: &VolumeVertex,
        wi: Vec3,
        pdf: f32,
    ) {
        let wo = -photon.ray.direction;
        let is_beam = Place::in_medium(&self.world.media[place.medium.index()]) == Place::Beams;
        let own = volume_factor(self.world, place, &self.radius, [wo, wi]) / pdf;
        let merges = photon.vertices > 0 || is_beam;
        photon.pass(self.world, place.p, pdf, if merges { own } else { 0.0 }, 1.0);
        (photon.comes_straight, photon.is_indirect) = (false, true);
        photon.collisions += Past::collisions_in(place.medium, &photon.set);
        photon.crossings = 0;
        photon.ray = Ray::new(place.p, wi);
        photon.vertices += 1;
    }

    /// Accounts for a vertex on a surface that is passed by a lobe that is not singular.
    fn pass(&self, photon: &mut Photon<'_>, vertex: &Vertex, scattered: &BsdfSample, ior_before: f32) {
        let wo = -photon.ray.direction;
        let cos = |w: Vec3| w.dot(vertex.hit.ng).abs();
        let toward_receiver =
            Side { pdf: scattered.pdf, ior: self.world.ior(photon.set.active()), cos: cos(scattered.wi) };
        let toward_light = Side { pdf: vertex.bsdf.pdf(scattered.wi, wo), ior: ior_before, cos: cos(wo) };
        let radius = self.radius.on_surface(vertex.hit.p) * if photon.is_indirect { INDIRECT } else { 1.0 };
        let own = match photon.vertices {
            0 => 0.0,
            _ => weight::at_receiver(radius, toward_light.ior, toward_light.cos, toward_light.pdf),
        };
        let across = weight::across(toward_receiver, toward_light);
        photon.pass(self.world, vertex.hit.p, toward_light.pdf, own, across);
    }
}

/// The random numbers of a photon.
pub(super) fn sampler_of(settings: &RenderSettings, sender: &Sender<'_>, pass: u32, number: u32) -> Sampler {
    let column = PHOTON_COLUMNS[usize::from(sender.is_aimed)];
    Sampler::new(settings.sampler, settings.seed, (column, pass), number)
}

/// What one task collects.
#[derive(Default)]
struct Chunk {
    points: Points,
    beams: Vec<Beam>,
    stats: Stats,
}

/// A photon on its way.
#[derive(Clone)]
pub(in crate::integrator) struct Photon<'a> {
    pub(in crate::integrator) sender: &'a Sender<'a>,
    pub(in crate::integrator) origin: Origin,
    pub(in crate::integrator) ray: Ray,
    pub(in crate::integrator) set: MediumSet,
    pub(in crate::integrator) flux: Spectrum,
    /// What the largest lane of its flux was at first.
    pub(in crate::integrator) full: f32,
    /// Vertices that it has passed.
    pub(in crate::integrator) vertices: u32,
    /// Those of them that were not singular.
    pub(in crate::integrator) bounces: u32,
    /// Those of them in media of objects.
    pub(in crate::integrator) collisions: u32,
    /// Singular ones in a row.
    pub(in crate::integrator) crossings: u32,
    /// Whether all it has done was to cross surfaces with straight shadows.
    pub(in crate::integrator) comes_straight: bool,
    /// Whether its ways through homogeneous media are kept.
    pub(in crate::integrator) leaves_beams: bool,
    pub(in crate::integrator) id: PhotonId,
    /// Whether it has been scattered widely.
    pub(in crate::integrator) is_indirect: bool,
    pub(in crate::integrator) others: f32,
}

impl Photon<'_> {
    /// Whether it is kept where it is now, if that is not singular.
    pub(in crate::integrator) fn lands(&self) -> bool {
        // What comes straight, also through straight shadows, the receiver's shadow rays bring.
        self.vertices > 0 && !self.comes_straight
    }

    /// Whether beams of its way are kept, if it leaves any.
    pub(in crate::integrator) fn beams_count(&self) -> bool {
        self.lands() || self.vertices == 0 && !self.sender.is_aimed
    }

    /// Where it comes from, if straight from there.
    pub(in crate::integrator) fn straight_from(&self) -> Option<Origin> {
        (self.vertices == 0).then_some(self.origin)
    }

    /// - `n`: geometric normal of the surface.
    fn landed_on(&self, n: Vec3) -> LandedPhoton {
        self.landed(Landing::Surface { n: RoughNormal::new(n), medium: self.set.active() }, self.flux)
    }

    /// - `p`: where the medium has scattered it, which its flux has been told.
    fn landed_in(&self, medium: &Medium, p: Vec3) -> LandedPhoton {
        let density = medium.density(p);
        let way = medium.sigma_s_at(p, density).map(|sigma| if sigma > 0.0 { 1.0 / sigma } else { 0.0 });
        self.landed(Landing::Volume { density }, self.flux * way)
    }

    fn landed(&self, landing: Landing, flux: Spectrum) -> LandedPhoton {
        let Self { others, bounces, id, .. } = *self;
        LandedPhoton { direction: self.ray.direction, landing, flux, others, bounces, id }
    }

    /// Accounts for a vertex that is not singular.
    ///
    /// - `p`: where it is; `pdf`: density of the photon's way back, drawn from the eye's side.
    /// - `own`, `across`: its factors, see `weight`; `own` is 0 where photons straight from the light are not merged.
    fn pass(&mut self, world: &World, p: Vec3, pdf: f32, own: f32, across: f32) {
        // No path hits a delta light: sampling it stands where drawing its direction would, and the density cancels.
        let drawn = if self.vertices == 0 && self.origin.is_delta { 1.0 / pdf } else { 1.0 };
        let sampled = match self.vertices {
            0 => {
                // Where it is merged, the path from the eye scatters first.
                let chance = asking::expected(world, self.origin.light as usize, 1);
                chance * self.origin.sampled(world, p, -self.ray.direction) / (pdf * drawn)
            }
            _ => 0.0,
        };
        let (own, across) = (own / drawn, across / drawn);
        self.others = (self.others + sampled * sampled + own * own) / (across * across);
        self.bounces += 1;
    }

    /// Roulette after a vertex: what goes on carries about as much as at first.
    fn survives(&mut self, world: &World, sampler: &mut Sampler) -> bool {
        let left = self.flux.max_lane(world.lanes) / self.full;
        let Self { bounces, collisions, crossings, .. } = *self;
        let survival = survival(left, Past { bounces, collisions, crossings });
        // Compared this way round, what is not a number ends the photon.
        let goes_on = sampler.next_1d() < survival;
        self.flux *= 1.0 / survival;
        goes_on
    }
}
