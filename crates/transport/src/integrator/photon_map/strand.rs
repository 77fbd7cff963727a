//! A path of the eye, from the camera or from a place that gathers.

use super::eye::Role;
use crate::RenderSettings;
use crate::direct;
use crate::march::Found;
use crate::photon::specular::is_specular_event;
use crate::roulette::{PATIENCE_WITH_SHADING_NORMALS, Past, eye_survival};
use crate::stats::Stats;
use crate::walk::{self, Event, Flown, Vertex};
use hyaline_math::{Ray, Vec3};
use hyaline_sampling::Sampler;
use hyaline_scattering::bsdf::BsdfSample;
use hyaline_scattering::{MediumSet, Transport};
use hyaline_spectrum::Spectrum;
use hyaline_world::{World, mask};

/// What is left of a strand behind a medium below which roulette decides whether it goes on.
const FAINT: f32 = 1e-3;

/// Where a strand comes from, over specular surfaces or straight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Origin {
    /// The camera: all light met is seen.
    Camera,
    /// A surface that gathers, and has counted its direct light and its caustics already.
    Gather {
        /// Length of the way since, scene units.
        distance: f32,
        /// Whether it went over specular surfaces.
        is_specular: bool,
    },
    /// A surface that has looked its light up, but for what light sampling leaves to rays: only a light that is met
    /// straight counts.
    LookUp,
}

/// A path of the eye at work.
#[derive(Clone)]
pub(super) struct Strand {
    pub(super) ray: Ray,
    pub(super) set: MediumSet,
    pub(super) throughput: Spectrum,
    pub(super) origin: Origin,
    /// Scatterings so far, singular ones not counted.
    pub(super) bounces: u32,
    /// Whether it is one of the gather rays that a camera path was split into.
    pub(super) is_split: bool,
    /// What the throughput holds that says nothing of how much the strand counts: n² factors, the share of a split.
    scale: f32,
    /// The last vertex at which light was sampled, and the density of the direction taken there; `None` where light
    /// sampling could not have made the strand.
    sampled: Option<(Vec3, f32)>,
    visible: u8,
    crossings: u32,
}

impl Strand {
    /// The beginning of a camera path.
    pub(super) fn from_camera(ray: Ray, set: MediumSet) -> Self {
        Self {
            ray,
            set,
            throughput: Spectrum::ONE,
            origin: Origin::Camera,
            bounces: 0,
            is_split: false,
            scale: 1.0,
            sampled: None,
            visible: mask::CAMERA,
            crossings: 0,
        }
    }

    /// One of `count` strands that share the work of this one.
    pub(super) fn split(&self, count: u32) -> Self {
        let share = 1.0 / count as f32;
        Self {
            throughput: self.throughput * share,
            scale: self.scale * share,
            is_split: true,
            ..self.clone()
        }
    }

    /// Walks to the next surface, or from a place that gathers to a particle that scatters before.
    ///
    /// - `found`: receives where a ray of the camera asks media for light.
    pub(super) fn fly(
        &mut self,
        world: &World,
        settings: &RenderSettings,
        found: &mut Found,
        sampler: &mut Sampler,
        stats: &mut Stats,
    ) -> Flown {
        let (ray, visible, set, throughput) = (&self.ray, self.visible, &mut self.set, self.throughput);
        match self.origin {
            _ if !world.has_volumes => Flown::Arrived(walk::advance(world, ray, visible, set, stats)),
            Origin::Camera => {
                Flown::Arrived(found.march(world, settings, (ray, visible), set, throughput, sampler, stats))
            }
            Origin::Gather { .. } => {
                let (flown, emitted) = walk::fly(world, ray, visible, set, throughput, sampler, stats);
                found.emitted = emitted;
                flown
            }
            // Where light was looked up, all that media scatter was, too.
            Origin::LookUp => Flown::Arrived(walk::advance(world, ray, visible, set, stats)),
        }
    }

    /// Arrives where a walk ends: at a surface or nowhere; its light is added to `light`.
    pub(super) fn arrive(&mut self, world: &World, event: Event, light: &mut Spectrum) -> Option<Vertex> {
        match event {
            Event::Sky { transmittance } => {
                if self.sees_lights() {
                    let sky = direct::sky_radiance(world, &self.ray, self.sampled, self.visible);
                    *light += self.throughput * transmittance * sky;
                }
                None
            }
            Event::Surface(mut vertex) => {
                if self.crossings > PATIENCE_WITH_SHADING_NORMALS {
                    vertex.bsdf = vertex.bsdf.without_shading_normal();
                }
                self.throughput *= vertex.transmittance;
                if let Origin::Gather { distance, .. } = &mut self.origin {
                    *distance += vertex.distance;
                }
                if self.sees_lights() {
                    let radiance = direct::surface_radiance(world, &vertex, &self.ray, self.sampled);
                    *light += self.throughput * radiance;
                }
                (self.origin != Origin::LookUp).then_some(vertex)
            }
        }
    }

    /// Roulette where media have left hardly anything; returns whether the strand goes on.
    pub(super) fn survives_fog(&mut self, lanes: usize, sampler: &mut Sampler) -> bool {
        let left = self.throughput.max_lane(lanes) / self.scale;
        if left >= FAINT {
            return true;
        }
        self.throughput *= FAINT / left;
        sampler.next_1d() * FAINT < left
    }

    /// Whether a light that the strand meets counts. Light over specular surfaces onto one that gathers is a caustic:
    /// the caustic map has it.
    fn sees_lights(&self) -> bool {
        match self.origin {
            Origin::Camera | Origin::LookUp => true,
            Origin::Gather { is_specular, .. } => !is_specular,
        }
    }

    /// Whether it comes from a surface that gathers and is nearer than `radius`.
    pub(super) fn is_shorter_than(&self, radius: f32) -> bool {
        matches!(self.origin, Origin::Gather { distance, .. } if distance < radius)
    }

    /// Goes on in a direction drawn at `vertex`; returns whether it does.
    pub(super) fn scatter(
        &mut self,
        world: &World,
        vertex: &Vertex,
        role: Role,
        max_bounces: Option<u32>,
        sampler: &mut Sampler,
    ) -> bool {
        let (u_lobe, u) = (sampler.next_1d(), sampler.next_2d());
        let wo = -self.ray.direction;
        let Some(scattered) = vertex.bsdf.sample(wo, u_lobe, u, Transport::Radiance) else { return false };
        let is_specular = is_specular_event(&vertex.bsdf, scattered.is_delta);
        if role == Role::LookUpAll && !is_specular {
            return false;
        }
        self.count(vertex, &scattered);
        self.origin = match self.origin {
            Origin::Gather { distance, .. } if is_specular => Origin::Gather { distance, is_specular },
            origin if is_specular => origin,
            _ if role == Role::LookUp => Origin::LookUp,
            _ => Origin::Gather { distance: 0.0, is_specular: false },
        };
        if max_bounces.is_some_and(|limit| self.bounces > limit) || !self.survives(world.lanes, sampler) {
            return false;
        }
        self.ray = vertex.leave(scattered.wi, self.ray.time);
        if scattered.transmits {
            vertex.commit(world, &mut self.set);
        }
        true
    }

    /// Counts a direction drawn at `vertex`.
    fn count(&mut self, vertex: &Vertex, scattered: &BsdfSample) {
        self.throughput *= scattered.weight;
        self.scale *= scattered.eta_scale;
        self.visible = mask::PATH;
        if scattered.is_delta {
            self.crossings += 1;
            self.sampled = None;
        } else {
            self.crossings = 0;
            self.bounces += 1;
            self.sampled = Some((vertex.hit.p, scattered.pdf));
        }
    }

    fn survives(&mut self, lanes: usize, sampler: &mut Sampler) -> bool {
        let past = Past { bounces: self.bounces, collisions: 0, crossings: self.crossings };
        let q = eye_survival(self.throughput.max_lane(lanes) / self.scale, past);
        self.throughput *= 1.0 / q;
        sampler.next_1d() < q
    }
}
