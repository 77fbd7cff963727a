//! Photons from the lights to where they are kept.
//!
//! 1. Emit photon i with its own random numbers, which a guide may have warped: toward anything for the global map,
//!    toward specular surfaces for caustics.
//! 2. Walk to the next surface; the medium on the way takes its share of the flux. Or, but for caustics, to the particle
//!    of a medium that scatters the photon before.
//! 3. At a surface that is not specular, keep the photon if its kind is wanted; at a particle likewise.
//! 4. Draw a direction from the BSDF or the phase function and go on. Singular bounces are free.
//! 5. Roulette on what is left of the flux decides whether the photon goes on, so that all kept carry about the
//!    same.
//!
//! Photons are traced in chunks of fixed size, kept in order: the same map for any number of threads.
//! Source: Jensen, Realistic Image Synthesis Using Photon Mapping, 2001, ch. 5 and §10.3.

use super::emission::{PhotonEmitter, PhotonStart, start_numbers};
use super::guide::{Found, Guide, START_NUMBERS};
use super::record::{Photon, PhotonKind};
use super::specular::{is_specular, is_specular_event};
use crate::in_volume;
use crate::roulette::{PATIENCE_WITH_SHADING_NORMALS, Past, survival};
use crate::stats::Stats;
use crate::walk::{self, Event, Flown, Vertex, VolumeVertex};
use hyaline_math::{Ray, Vec3};
use hyaline_sampling::{Sampler, SamplerKind};
use hyaline_scattering::{MediumId, MediumSet, Transport};
use hyaline_spectrum::Spectrum;
use hyaline_world::{World, mask};
use rayon::prelude::*;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

/// Photons that one thread traces at a time.
const CHUNK: u32 = 4096;

/// Which photons are kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MapKind {
    /// L S+ D: light that came over specular surfaces alone. And L S+ D S* D, as `PhotonKind::Indirect`: what it
    /// throws on other surfaces.
    Caustic,
    /// All light.
    Global,
    /// Light that was scattered by a surface that is not specular or by a medium; the rest is counted in other ways.
    Indirect,
    /// Light that media scatter, kept where they do.
    Volume {
        /// Whether light that comes straight from its lamp is kept, too.
        with_direct: bool,
        /// Share of the photons that is kept, 0…1, with the power of all.
        share: f32,
    },
}

impl MapKind {
    /// Whether photons of this kind are kept on surfaces.
    fn keeps(self, kind: PhotonKind) -> bool {
        match self {
            Self::Caustic => kind != PhotonKind::Direct,
            Self::Global => true,
            Self::Indirect => kind == PhotonKind::Indirect,
            Self::Volume { .. } => false,
        }
    }

    /// Share of the photons of this kind that is kept at particles of media.
    fn share_in_media(self, kind: PhotonKind) -> f32 {
        match self {
            Self::Volume { with_direct, share } if with_direct || kind != PhotonKind::Direct => share,
            _ => 0.0,
        }
    }

    /// Whether photons of this kind go on when a surface that is not specular has scattered them.
    fn follows(self, kind: PhotonKind) -> bool {
        match self {
            Self::Caustic => kind == PhotonKind::Caustic,
            Self::Global | Self::Indirect | Self::Volume { .. } => true,
        }
    }

    /// Column of the pixel whose random numbers the photons use: none that a film has.
    fn tag(self) -> u32 {
        match self {
            Self::Caustic => u32::MAX,
            Self::Global | Self::Indirect => u32::MAX - 1,
            Self::Volume { .. } => u32::MAX - 2,
        }
    }
}

/// Photons to be traced.
pub struct PhotonTracer<'w> {
    /// Where.
    pub world: &'w World,
    /// How they start.
    pub emitter: &'w PhotonEmitter<'w>,
    /// What is kept.
    pub map: MapKind,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Bounces at most, singular ones not counted.
    pub max_bounces: u32,
    /// What they start from more often than the lights by themselves have it.
    pub guide: Guide,
}

impl PhotonTracer<'_> {
    /// Emits `count` photons; returns those kept, their flux divided by `count`, in the order of their numbers.
    ///
    /// Stops early, with fewer photons, when `cancel` is set.
    pub fn trace(&self, count: u32, cancel: &AtomicBool, stats: &mut Stats) -> Vec<Photon> {
        self.trace_all(count, cancel, stats).photons
    }

    /// The same for photons that are kept in media, each with the medium that it is in.
    pub fn trace_in_media(
        &self,
        count: u32,
        cancel: &AtomicBool,
        stats: &mut Stats,
    ) -> Vec<(MediumId, Photon)> {
        let Kept { photons, media } = self.trace_all(count, cancel, stats);
        media.into_iter().zip(photons).collect()
    }

    /// What those of `count` photons start from that are worth something where they are kept.
    ///
    /// Stops early, with fewer photons, when `cancel` is set.
    ///
    /// - `worth`: of a photon, ≥ 0.
    pub fn starts(
        &self,
        count: u32,
        worth: impl Fn(&Photon) -> f32 + Sync,
        cancel: &AtomicBool,
        stats: &mut Stats,
    ) -> Vec<Found> {
        let chunk = |chunk: u32| {
            let begin = chunk * CHUNK;
            let (mut kept, mut stats) = (Kept::default(), Stats::default());
            let numbers = begin..count.min(begin.saturating_add(CHUNK));
            let numbers = numbers.take_while(|_| !cancel.load(Ordering::Relaxed));
            let found = numbers.filter_map(|number| {
                kept.photons.clear();
                let numbers = self.trace_one(number, &mut kept, &mut stats);
                let worth = kept.photons.iter().map(&worth).sum();
                (worth > 0.0).then_some(Found { numbers, worth })
            });
            (found.collect(), stats)
        };
        let chunks: Vec<(Vec<Found>, Stats)> =
            (0..count.div_ceil(CHUNK)).into_par_iter().map(chunk).collect();
        chunks.iter().for_each(|(_, counts)| stats.add(counts));
        chunks.into_iter().flat_map(|(found, _)| found).collect()
    }

    fn trace_all(&self, count: u32, cancel: &AtomicBool, stats: &mut Stats) -> Kept {
        let chunks: Vec<(Kept, Stats)> = (0..count.div_ceil(CHUNK))
            .into_par_iter()
            .map(|chunk| {
                let begin = chunk * CHUNK;
                self.trace_chunk(begin..count.min(begin.saturating_add(CHUNK)), cancel)
            })
            .collect();
        let total = chunks.iter().map(|(kept, _)| kept.photons.len()).sum();
        let mut all = Kept { photons: Vec::with_capacity(total), media: Vec::new() };
        for (kept, counts) in chunks {
            all.photons.extend(kept.photons);
            all.media.extend(kept.media);
            stats.add(&counts);
        }
        let share = 1.0 / count as f32;
        all.photons.iter_mut().for_each(|photon| photon.flux *= share);
        all
    }

    fn trace_chunk(&self, numbers: Range<u32>, cancel: &AtomicBool) -> (Kept, Stats) {
        let (mut kept, mut stats) = (Kept::default(), Stats::default());
        for number in numbers {
            if cancel.load(Ordering::Relaxed) {
                break;
            }
            self.trace_one(number, &mut kept, &mut stats);
        }
        (kept, stats)
    }

    /// Returns what the photon has started from.
    fn trace_one(&self, number: u32, kept: &mut Kept, stats: &mut Stats) -> [f32; START_NUMBERS] {
        stats.photons += 1;
        let mut sampler = Sampler::new(SamplerKind::Sobol, self.seed, (self.map.tag(), u32::MAX), number);
        let (numbers, density) = self.guide.warp(start_numbers(&mut sampler));
        if let Some(start) = self.emitter.emit_from(numbers) {
            let start = PhotonStart { flux: start.flux * (1.0 / density), ..start };
            Flight::new(self, start).run(&mut sampler, kept, stats);
        }
        numbers
    }
}

/// Photons that were kept.
#[derive(Default)]
struct Kept {
    photons: Vec<Photon>,
    /// The medium of each; empty for those on surfaces.
    media: Vec<MediumId>,
}

/// A photon on its way.
struct Flight<'a> {
    tracer: &'a PhotonTracer<'a>,
    ray: Ray,
    set: MediumSet,
    flux: Spectrum,
    /// Power at the start, mean over lanes, W.
    start_power: f32,
    /// What it would be kept as.
    kind: PhotonKind,
    /// Surfaces and particles met so far.
    events: u32,
    /// Those of them that scattered, singular ones not counted.
    bounces: u32,
    /// Those of them in media of objects.
    collisions: u32,
    /// Singular ones in a row.
    crossings: u32,
}

impl<'a> Flight<'a> {
    fn new(tracer: &'a PhotonTracer<'a>, start: PhotonStart) -> Self {
        Self {
            tracer,
            ray: start.ray,
            set: start.set,
            flux: start.flux,
            start_power: start.flux.mean(tracer.world.lanes),
            kind: PhotonKind::Direct,
            events: 0,
            bounces: 0,
            collisions: 0,
            crossings: 0,
        }
    }

    /// Flies until nothing more can be kept.
    fn run(mut self, sampler: &mut Sampler, kept: &mut Kept, stats: &mut Stats) {
        loop {
            let goes_on = match self.fly(sampler, stats) {
                Flown::Arrived(Event::Sky { .. }) => false,
                Flown::Arrived(Event::Surface(vertex)) => self.meet_surface(vertex, sampler, kept),
                Flown::Scattered(place) => self.meet_particle(&place, sampler, kept),
            };
            if !goes_on {
                return;
            }
        }
    }

    /// To the next surface or particle.
    fn fly(&mut self, sampler: &mut Sampler, stats: &mut Stats) -> Flown {
        let world = self.tracer.world;
        // Caustics end where a medium scatters them: what it leaves of them is known better than by chance.
        if !world.has_volumes || self.tracer.map == MapKind::Caustic {
            return Flown::Arrived(walk::advance(world, &self.ray, mask::PATH, &mut self.set, stats));
        }
        walk::fly(world, &self.ray, mask::PATH, &mut self.set, self.flux, sampler, stats).0
    }

    /// Is kept at a surface and scattered by it; returns whether the photon goes on.
    fn meet_surface(&mut self, mut vertex: Vertex, sampler: &mut Sampler, kept: &mut Kept) -> bool {
        if self.crossings > PATIENCE_WITH_SHADING_NORMALS {
            vertex.bsdf = vertex.bsdf.without_shading_normal();
        }
        if !self.lose(vertex.transmittance, sampler) {
            return false;
        }
        if self.tracer.map.keeps(self.kind) && !is_specular(&vertex.bsdf) {
            kept.photons.push(self.photon_at(vertex.hit.p));
        }
        self.scatter(&vertex, sampler)
    }

    /// The same at a particle.
    fn meet_particle(&mut self, place: &VolumeVertex, sampler: &mut Sampler, kept: &mut Kept) -> bool {
        self.flux *= place.weight;
        let share = self.tracer.map.share_in_media(self.kind);
        if share > 0.0 && (share >= 1.0 || sampler.next_1d() < share) {
            let photon = self.photon_at(place.p);
            kept.photons.push(Photon { flux: photon.flux * (1.0 / share), ..photon });
            kept.media.push(place.medium);
        }
        self.kind = PhotonKind::Indirect;
        self.events += 1;
        self.bounces += 1;
        self.collisions += Past::collisions_in(place.medium, &self.set);
        self.crossings = 0;
        let direction =
            in_volume::phase_at(self.tracer.world, place).sample(-self.ray.direction, sampler.next_2d());
        self.ray = Ray { time: self.ray.time, ..Ray::new(place.p, direction) };
        self.bounces <= self.tracer.max_bounces && self.lose(Spectrum::ONE, sampler)
    }

    fn photon_at(&self, p: Vec3) -> Photon {
        Photon { p, direction: self.ray.direction, flux: self.flux, kind: self.kind, bounces: self.events }
    }

    /// Draws where the photon goes on; returns whether it does.
    fn scatter(&mut self, vertex: &Vertex, sampler: &mut Sampler) -> bool {
        let wo = -self.ray.direction;
        let (u_lobe, u) = (sampler.next_1d(), sampler.next_2d());
        let Some(scattered) = vertex.bsdf.sample(wo, u_lobe, u, Transport::Importance) else { return false };
        if is_specular_event(&vertex.bsdf, scattered.is_delta) {
            // What comes straight through straight shadows, the receiver's shadow rays bring.
            if self.kind == PhotonKind::Direct && !vertex.passes_straight(scattered.transmits) {
                self.kind = PhotonKind::Caustic;
            }
        } else if !self.tracer.map.follows(self.kind) {
            return false;
        } else {
            self.kind = PhotonKind::Indirect;
        }
        self.events += 1;
        if scattered.is_delta {
            self.crossings += 1;
        } else {
            self.crossings = 0;
            self.bounces += 1;
        }
        if self.bounces > self.tracer.max_bounces || !self.lose(scattered.weight, sampler) {
            return false;
        }
        self.ray = vertex.leave(scattered.wi, self.ray.time);
        if scattered.transmits {
            vertex.commit(self.tracer.world, &mut self.set);
        }
        true
    }

    /// Takes a factor on the flux; returns whether roulette lets the photon go on with the flux that it had.
    fn lose(&mut self, factor: Spectrum, sampler: &mut Sampler) -> bool {
        self.flux *= factor;
        let left = self.flux.mean(self.tracer.world.lanes) / self.start_power;
        let Self { bounces, collisions, crossings, .. } = self;
        let q = survival(left, Past { bounces: *bounces, collisions: *collisions, crossings: *crossings });
        if sampler.next_1d() >= q {
            return false;
        }
        self.flux *= 1.0 / q;
        true
    }
}
