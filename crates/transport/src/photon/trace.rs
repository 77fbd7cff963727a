//! Photons from the lights to where they are kept.
//!
//! 1. Emit photon i with its own random numbers: toward anything for the global map, toward specular surfaces for
//!    caustics.
//! 2. Walk to the next surface; the medium on the way takes its share of the flux.
//! 3. At a surface that is not specular, keep the photon if its kind is wanted.
//! 4. Draw a direction from the BSDF and go on. Singular bounces are free.
//! 5. Roulette on what is left of the flux decides whether the photon goes on, so that all kept carry about the
//!    same.
//!
//! Photons are traced in chunks of fixed size, kept in order: the same map for any number of threads.
//! Source: Jensen, Realistic Image Synthesis Using Photon Mapping, 2001, ch. 5.

use super::emission::{PhotonEmitter, PhotonStart};
use super::record::{Photon, PhotonKind};
use super::specular::{is_specular, is_specular_event};
use crate::roulette::{PATIENCE_WITH_SHADING_NORMALS, survival};
use crate::stats::Stats;
use crate::walk::{self, Event, Vertex};
use hyaline_math::Ray;
use hyaline_sampling::{Sampler, SamplerKind};
use hyaline_scattering::{MediumSet, Transport};
use hyaline_spectrum::Spectrum;
use hyaline_world::{World, mask};
use rayon::prelude::*;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

/// Photons that one thread traces at a time.
const CHUNK: u32 = 4096;

/// Which photons are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapKind {
    /// L S+ D: light that came over specular surfaces alone. And L S+ D S* D, as `PhotonKind::Indirect`: what it
    /// throws on other surfaces.
    Caustic,
    /// All light.
    Global,
    /// Light that was scattered by a surface that is not specular; the rest is counted in other ways.
    Indirect,
}

impl MapKind {
    /// Whether photons of this kind are kept.
    fn keeps(self, kind: PhotonKind) -> bool {
        match self {
            Self::Caustic => kind != PhotonKind::Direct,
            Self::Global => true,
            Self::Indirect => kind == PhotonKind::Indirect,
        }
    }

    /// Whether photons of this kind go on when a surface that is not specular has scattered them.
    fn follows(self, kind: PhotonKind) -> bool {
        match self {
            Self::Caustic => kind == PhotonKind::Caustic,
            Self::Global | Self::Indirect => true,
        }
    }

    /// Column of the pixel whose random numbers the photons use: none that a film has.
    fn tag(self) -> u32 {
        match self {
            Self::Caustic => u32::MAX,
            Self::Global | Self::Indirect => u32::MAX - 1,
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
}

impl PhotonTracer<'_> {
    /// Emits `count` photons; returns those kept, their flux divided by `count`, in the order of their numbers.
    ///
    /// Stops early, with fewer photons, when `cancel` is set.
    pub fn trace(&self, count: u32, cancel: &AtomicBool, stats: &mut Stats) -> Vec<Photon> {
        let chunks: Vec<(Vec<Photon>, Stats)> = (0..count.div_ceil(CHUNK))
            .into_par_iter()
            .map(|chunk| {
                let begin = chunk * CHUNK;
                self.trace_chunk(begin..count.min(begin.saturating_add(CHUNK)), cancel)
            })
            .collect();
        let mut photons = Vec::with_capacity(chunks.iter().map(|(photons, _)| photons.len()).sum());
        for (chunk, counts) in chunks {
            photons.extend(chunk);
            stats.add(&counts);
        }
        let share = 1.0 / count as f32;
        photons.iter_mut().for_each(|photon| photon.flux *= share);
        photons
    }

    fn trace_chunk(&self, numbers: Range<u32>, cancel: &AtomicBool) -> (Vec<Photon>, Stats) {
        let (mut photons, mut stats) = (Vec::new(), Stats::default());
        for number in numbers {
            if cancel.load(Ordering::Relaxed) {
                break;
            }
            stats.photons += 1;
            let mut sampler = Sampler::new(SamplerKind::Sobol, self.seed, (self.map.tag(), u32::MAX), number);
            if let Some(start) = self.emitter.emit(&mut sampler) {
                Flight::new(self, start).run(&mut sampler, &mut photons, &mut stats);
            }
        }
        (photons, stats)
    }
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
    /// Surfaces met so far.
    events: u32,
    /// Those of them that scattered, singular ones not counted.
    bounces: u32,
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
            crossings: 0,
        }
    }

    /// Flies until nothing more can be kept.
    fn run(mut self, sampler: &mut Sampler, photons: &mut Vec<Photon>, stats: &mut Stats) {
        while let Some(vertex) = self.fly(sampler, stats) {
            if self.tracer.map.keeps(self.kind) && !is_specular(&vertex.bsdf) {
                photons.push(self.photon_at(&vertex));
            }
            if !self.scatter(&vertex, sampler) {
                return;
            }
        }
    }

    /// To the next surface; `None` where the photon is lost or swallowed on the way.
    fn fly(&mut self, sampler: &mut Sampler, stats: &mut Stats) -> Option<Vertex> {
        match walk::advance(self.tracer.world, &self.ray, mask::PATH, &mut self.set, stats) {
            Event::Sky { .. } => None,
            Event::Surface(mut vertex) => {
                if self.crossings > PATIENCE_WITH_SHADING_NORMALS {
                    vertex.bsdf = vertex.bsdf.without_shading_normal();
                }
                self.lose(vertex.transmittance, sampler).then_some(vertex)
            }
        }
    }

    fn photon_at(&self, vertex: &Vertex) -> Photon {
        Photon {
            p: vertex.hit.p,
            direction: self.ray.direction,
            flux: self.flux,
            kind: self.kind,
            bounces: self.events,
        }
    }

    /// Draws where the photon goes on; returns whether it does.
    fn scatter(&mut self, vertex: &Vertex, sampler: &mut Sampler) -> bool {
        let wo = -self.ray.direction;
        let (u_lobe, u) = (sampler.next_1d(), sampler.next_2d());
        let Some(scattered) = vertex.bsdf.sample(wo, u_lobe, u, Transport::Importance) else { return false };
        if is_specular_event(&vertex.bsdf, scattered.is_delta) {
            if self.kind == PhotonKind::Direct {
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
        let q = survival(left, self.bounces, self.crossings);
        if sampler.next_1d() >= q {
            return false;
        }
        self.flux *= 1.0 / q;
        true
    }
}
