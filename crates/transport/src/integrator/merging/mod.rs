//! The default: path tracing and photon merging under multiple importance sampling, in independent passes.
//!
//! Path tracing is hard to beat but for two kinds of light: what reaches a rough surface (or a particle of a medium)
//! through polished ones, a caustic, and what a small bright place throws into the room. There photons do what paths
//! cannot. Before the first pass, `pilot` learns from small pictures where photons are worth sending. A pass does this:
//!
//! 1. `sender` says how many photons leave the lights, and where to: some are aimed at what throws caustics, some go
//!    everywhere.
//! 2. `light` follows them through the scene; `landed` keeps them at every vertex but the first that is not singular.
//! 3. `integrator/eye` traces one path per pixel, as `path` does. At its vertices it also gathers the photons about
//!    them, within a radius of a few pixels that shrinks from pass to pass.
//! 4. `integrator/eye/weight` says what each counts where they make the same path: a lamp hit through glass is weighed
//!    against the photons that would have come through it.
//!
//! Passes know nothing of each other, but for the radius, which is a closed form of the pass's number. Sources: Knaus
//! & Zwicker, Progressive photon mapping: a probabilistic approach, ACM TOG 30(3), 2011; Georgiev, Křivánek, Davidovič &
//! Slusallek, Light transport simulation with vertex connection and merging, ACM TOG 31(6), 2012; Grittmann, Pérard-Gayot,
//! Slusallek & Křivánek, Efficient caustic rendering with lightweight photon mapping, CGF 37(4), 2018.

mod beams;
mod glints;
mod landed;
mod light;
mod origin;
mod pilot;
#[cfg(test)]
#[path = "../../../tests/scene_kit/mod.rs"]
mod scene_kit;
mod sender;

use super::eye::aim::Aim;
use super::eye::radius::GatherRadius;
use super::eye::tally::Tally;
use super::eye::{Draws, Eye};
use super::per_pixel::CameraRays;
use super::{Integrator, Pass, Prepared, RenderSettings, View};
use crate::photon::radius;
use crate::stats::Stats;
pub(super) use beams::{Beam, Passing};
use glints::Glints;
use hyaline_film::{PixelSample, Rect};
use hyaline_world::World;
pub(super) use landed::{Landed, LandedPhoton, Landing, PhotonId};
pub(super) use light::Light;
#[cfg(test)]
pub(super) use light::Photon;
pub(super) use sender::{BEAM_SHARE, Senders, projection_cells};
use std::sync::atomic::AtomicBool;

/// Path tracing and photon merging.
pub struct MergingIntegrator;

impl Integrator for MergingIntegrator {
    fn name(&self) -> &'static str {
        "merging"
    }

    fn prepare<'w>(
        &self,
        world: &'w World,
        view: &View,
        settings: &RenderSettings,
        cancel: &AtomicBool,
        stats: &mut Stats,
    ) -> Box<dyn Prepared + 'w> {
        let mut senders = Senders::new(world, view, settings.techniques);
        let light = senders.any().then(|| pilot::teach(world, view, settings, &mut senders, stats));
        let pixels = view.width * view.height;
        let aim = (!senders.any()).then(|| Aim::taught(world, pixels, settings, cancel, stats));
        let eye = Eye { world, settings, aim: aim.as_ref(), photons: None };
        let glints = light.and_then(|light| Glints::find(&eye, view, light, stats));
        Box::new(Merging { world, view: *view, settings: *settings, senders, aim, glints })
    }
}

/// What all passes share.
struct Merging<'w> {
    world: &'w World,
    view: View,
    settings: RenderSettings,
    senders: Senders<'w>,
    /// Where no photons are sent, paths aim as those of `path` do.
    aim: Option<Aim>,
    glints: Option<Glints>,
}

impl Prepared for Merging<'_> {
    fn begin_pass<'a>(&'a self, pass: u32, stats: &mut Stats) -> Box<dyn Pass + 'a> {
        let Self { world, view, settings, senders, .. } = self;
        let shrunk = if settings.techniques.shrinking { pass } else { 0 };
        let radius = GatherRadius::new(&world.cameras[view.camera], radius::Shrink::of_pass(shrunk));
        let landed = Light { world, senders, settings, radius }.trace(pass, stats);
        Box::new(MergingPass { merging: self, pass, landed, radius })
    }
}

/// Photons of a pass, for paths that gather them.
#[derive(Clone, Copy)]
pub(super) struct Photons<'a> {
    pub(super) senders: &'a Senders<'a>,
    pub(super) landed: &'a Landed,
    pub(super) radius: GatherRadius,
}

/// One pass: its photons, and its paths.
struct MergingPass<'a> {
    merging: &'a Merging<'a>,
    pass: u32,
    landed: Landed,
    radius: GatherRadius,
}

impl Pass for MergingPass<'_> {
    fn render_tile(&self, tile: Rect, samples: &mut [PixelSample], stats: &mut Stats) {
        let Merging { world, view, settings, senders, aim, glints } = self.merging;
        let camera = CameraRays { world, view, settings, pass: self.pass };
        let photons = senders.any().then_some(Photons { senders, landed: &self.landed, radius: self.radius });
        let eye = Eye { world, settings, aim: aim.as_ref(), photons };
        let looking = Eye { photons: None, ..eye };
        camera.render_tile(tile, samples, |pixel, (ray, set), sampler, sample| {
            let mut draws = Draws { sampler, stats, tally: Tally::default() };
            let seen = eye.radiance(ray, set, &mut draws, Some(sample));
            match glints {
                Some(glints) => glints.look_again(seen, &looking, (view, pixel, self.pass), stats),
                None => seen.all(),
            }
        });
    }
}
