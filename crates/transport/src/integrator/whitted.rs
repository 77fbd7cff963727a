//! Suffern's recursive ray tracing: both branches at every transparent surface, direct light at every other one.
//!
//! 1. At a singular surface trace the reflected and the transmitted ray; each is filtered by the media on its way.
//! 2. At a matte, Phong or coated surface add the light of every lamp by shadow rays, soft for lamps with area, and the
//!    ambient term; a polished coat is traced as in 1 besides. Glass throws an opaque shadow here, unless its finish has
//!    straight shadows: that is the model, `path` does it right.
//! 3. At a glossy surface trace one ray drawn from its lobe, and add the highlights of lamps too small to be hit.
//! 4. Where media scatter, rays march: at each stop the light of every lamp is scattered once toward the eye. Light that is
//!    scattered twice is not shown.
//! 5. A branch ends when the product of its weights falls below `min_weight`, or at the depth limit.
//!
//! Source: Whitted, CACM 23(6), 1980; Suffern, Ray Tracing from the Ground Up, ch. 24-28.

use super::per_pixel::PerPixel;
use super::{Integrator, Prepared, RenderSettings, View};
use crate::direct::{self, DirectLight};
use crate::first_hit;
use crate::in_volume::VolumeLight;
use crate::march::Found;
use crate::stats::Stats;
use crate::walk::{self, Event, Vertex};
use hyaline_film::PixelSample;
use hyaline_math::{Ray, Vec3};
use hyaline_sampling::Sampler;
use hyaline_scattering::{MediumSet, Transport};
use hyaline_spectrum::Spectrum;
use hyaline_world::{World, mask};
use std::sync::atomic::AtomicBool;

/// Depth of the recursion where the settings name none.
const DEFAULT_DEPTH: u32 = 64;

/// Depth of the recursion at most, whatever the settings say: each level takes its part of the stack.
const DEEPEST: u32 = 1024;

/// Recursive ray tracing.
pub struct WhittedIntegrator;

impl Integrator for WhittedIntegrator {
    fn name(&self) -> &'static str {
        "whitted"
    }

    fn prepare<'w>(
        &self,
        world: &'w World,
        view: &View,
        settings: &RenderSettings,
        _cancel: &AtomicBool,
        _stats: &mut Stats,
    ) -> Box<dyn Prepared + 'w> {
        Box::new(PerPixel { world, view: *view, settings: *settings, estimate: radiance })
    }
}

/// The radiance that arrives along a camera ray, both branches at every transparent surface followed.
fn radiance(
    world: &World,
    settings: &RenderSettings,
    ray: Ray,
    set: MediumSet,
    sampler: &mut Sampler,
    stats: &mut Stats,
    first: Option<&mut PixelSample>,
) -> Spectrum {
    let branch = Branch { weight: 1.0, depth: 0, visible: mask::CAMERA };
    Tracer { world, settings, stats, first, found: Found::default() }.trace(ray, set, branch, *sampler)
}

/// How far a branch has come.
#[derive(Clone, Copy)]
struct Branch {
    /// Product of the largest lanes of all factors so far.
    weight: f32,
    /// Surfaces so far.
    depth: u32,
    /// Mask of the items that its ray sees.
    visible: u8,
}

struct Tracer<'a> {
    world: &'a World,
    settings: &'a RenderSettings,
    stats: &'a mut Stats,
    first: Option<&'a mut PixelSample>,
    found: Found,
}

impl Tracer<'_> {
    /// Radiance that arrives along `ray`, which starts inside `set`.
    fn trace(&mut self, ray: Ray, mut set: MediumSet, branch: Branch, mut sampler: Sampler) -> Spectrum {
        let (event, scattered) = if self.world.has_volumes {
            self.march(&ray, &mut set, branch, &mut sampler)
        } else {
            (walk::advance(self.world, &ray, branch.visible, &mut set, self.stats), Spectrum::ZERO)
        };
        let vertex = match event {
            Event::Sky { transmittance } => {
                let sky = direct::sky_radiance(self.world, &ray, None, branch.visible);
                return scattered + transmittance * sky;
            }
            Event::Surface(vertex) => vertex,
        };
        if let Some(sample) = self.first.take() {
            first_hit::record(sample, &vertex, &ray);
        }
        let weight = branch.weight * vertex.transmittance.max_lane(self.world.lanes);
        if weight < self.settings.min_weight && self.world.has_volumes {
            self.stats.branches_cut += 1;
            return scattered;
        }
        scattered
            + vertex.transmittance * self.shade(&vertex, &ray, &set, Branch { weight, ..branch }, sampler)
    }

    /// To the next surface; and the light that media on the way send, and scatter from every lamp, against `ray`.
    fn march(
        &mut self,
        ray: &Ray,
        set: &mut MediumSet,
        branch: Branch,
        sampler: &mut Sampler,
    ) -> (Event, Spectrum) {
        let (world, way) = (self.world, (ray, branch.visible));
        let event = self.found.march(world, self.settings, way, set, Spectrum::ONE, sampler, self.stats);
        let mut light = self.found.emitted;
        for (stop, set) in self.found.stops() {
            let place = VolumeLight { world, p: stop.p, medium: stop.medium, wo: -ray.direction, set };
            for lamp in world.lights.lights() {
                let count = if lamp.can_be_met() { self.settings.light_samples } else { 1 };
                let factor = stop.weight * stop.sigma_s * (1.0 / count as f32);
                for _ in 0..count {
                    light += factor * place.from_light(lamp, sampler.next_2d(), |_, _| 1.0, self.stats);
                }
            }
        }
        (event, light)
    }

    /// Radiance that leaves `vertex` against `ray`.
    fn shade(
        &mut self,
        vertex: &Vertex,
        ray: &Ray,
        set: &MediumSet,
        branch: Branch,
        mut sampler: Sampler,
    ) -> Spectrum {
        let wo = -ray.direction;
        let emitted = match vertex.light {
            Some(index) => self.world.lights.get(index as usize).radiance_from(&vertex.hit, wo),
            None => Spectrum::ZERO,
        };
        let reflected = if vertex.bsdf.is_delta() {
            self.local_term(vertex, wo, set, &mut sampler)
                + self.both_branches(vertex, wo, set, ray.time, branch, &mut sampler)
        } else if vertex.bsdf.has_diffuse_part() {
            self.world.ambient * vertex.bsdf.albedo_estimate()
                + self.all_lights(vertex, wo, set, &mut sampler)
                + self.both_branches(vertex, wo, set, ray.time, branch, &mut sampler)
        } else {
            self.small_lights(vertex, wo, set, &mut sampler)
                + self.one_glossy_ray(vertex, wo, set, ray.time, branch, &mut sampler)
        };
        emitted + reflected
    }

    /// Reflected and transmitted ray of a singular surface, the reflected one of a polished coat, none of others.
    fn both_branches(
        &mut self,
        vertex: &Vertex,
        wo: Vec3,
        set: &MediumSet,
        time: f32,
        branch: Branch,
        sampler: &mut Sampler,
    ) -> Spectrum {
        let mut result = Spectrum::ZERO;
        for (index, way) in vertex.bsdf.branches(wo).into_iter().enumerate() {
            let Some(way) = way else { continue };
            let fork = sampler.fork(index as u32);
            result += self.follow(
                vertex,
                way.wi,
                way.weight,
                way.transmits,
                way.eta_scale,
                set,
                time,
                branch,
                fork,
            );
        }
        result
    }

    /// One ray drawn from a glossy lobe.
    fn one_glossy_ray(
        &mut self,
        vertex: &Vertex,
        wo: Vec3,
        set: &MediumSet,
        time: f32,
        branch: Branch,
        sampler: &mut Sampler,
    ) -> Spectrum {
        let (u_lobe, u) = (sampler.next_1d(), sampler.next_2d());
        let Some(s) = vertex.bsdf.sample(wo, u_lobe, u, Transport::Radiance) else {
            return Spectrum::ZERO;
        };
        let fork = sampler.fork(0);
        self.follow(vertex, s.wi, s.weight, s.transmits, s.eta_scale, set, time, branch, fork)
    }

    /// Follows one way on from a vertex, unless it counts too little.
    fn follow(
        &mut self,
        vertex: &Vertex,
        wi: Vec3,
        factor: Spectrum,
        transmits: bool,
        eta_scale: f32,
        set: &MediumSet,
        time: f32,
        branch: Branch,
        sampler: Sampler,
    ) -> Spectrum {
        // The n² factor says how radiance changes, not how much the branch counts.
        let weight = branch.weight * factor.max_lane(self.world.lanes) / eta_scale;
        let depth = branch.depth + 1;
        if factor.is_zero() {
            return Spectrum::ZERO;
        }
        if weight < self.settings.min_weight
            || depth > self.settings.max_depth.unwrap_or(DEFAULT_DEPTH).min(DEEPEST)
        {
            self.stats.branches_cut += 1;
            return Spectrum::ZERO;
        }
        let mut set = set.clone();
        if transmits {
            vertex.commit(self.world, &mut set);
        }
        factor
            * self.trace(vertex.leave(wi, time), set, Branch { weight, depth, visible: mask::PATH }, sampler)
    }

    /// Direct light of every lamp.
    fn all_lights(&mut self, vertex: &Vertex, wo: Vec3, set: &MediumSet, sampler: &mut Sampler) -> Spectrum {
        self.lights_where(vertex, wo, set, sampler, |_| true)
    }

    /// Direct light of the lamps that no ray can hit.
    fn small_lights(
        &mut self,
        vertex: &Vertex,
        wo: Vec3,
        set: &MediumSet,
        sampler: &mut Sampler,
    ) -> Spectrum {
        self.lights_where(vertex, wo, set, sampler, |light| !light.can_be_met())
    }

    fn lights_where(
        &mut self,
        vertex: &Vertex,
        wo: Vec3,
        set: &MediumSet,
        sampler: &mut Sampler,
        is_meant: impl Fn(&hyaline_world::light::Light) -> bool,
    ) -> Spectrum {
        let direct = DirectLight { world: self.world, vertex, wo, set, use_mis: false };
        let mut result = Spectrum::ZERO;
        for light in self.world.lights.lights().iter().filter(|light| is_meant(light)) {
            let count = if light.can_be_met() { self.settings.light_samples } else { 1 };
            for _ in 0..count {
                result += direct.from_light(light, 1.0, sampler.next_2d(), self.stats) / count as f32;
            }
        }
        result
    }

    /// Suffern's local term of a transparent material: diffuse and highlights of lamps on top of the two branches.
    fn local_term(&mut self, vertex: &Vertex, wo: Vec3, set: &MediumSet, sampler: &mut Sampler) -> Spectrum {
        let Some(bsdf) = self.world.local_term(&vertex.hit, wo) else { return Spectrum::ZERO };
        let local = vertex.with_bsdf(bsdf);
        self.world.ambient * local.bsdf.albedo_estimate() + self.all_lights(&local, wo, set, sampler)
    }
}
