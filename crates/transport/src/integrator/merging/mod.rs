//! The default: path tracing and photon merging under multiple importance sampling, in independent passes.
//!
//! Path tracing is hard to beat but for one kind of light: what reaches a rough surface (or a particle of a medium)
//! through polished ones, a caustic. There photons do what paths cannot. A pass does this:
//!
//! 1. `light` sends out photons and follows them through polished and nearly polished surfaces to the first wide one,
//!    where they are kept (L S+ D).
//! 2. `integrator/eye` traces one path per pixel, as `path` does. At its wide vertices it also gathers the photons about them,
//!    within a radius of a few pixels that shrinks from pass to pass.
//! 3. `integrator/eye/weight` says what the two count where they make the same path: a lamp hit through glass is weighed against the
//!    photons that would have come through it.
//!
//! Passes know nothing of each other, but for the radius, which is a closed form of the pass's number. Sources: Knaus
//! & Zwicker, Progressive photon mapping: a probabilistic approach, ACM TOG 30(3), 2011; Georgiev, Křivánek, Davidovič &
//! Slusallek, Light transport simulation with vertex connection and merging, ACM TOG 31(6), 2012; Grittmann, Pérard-Gayot,
//! Slusallek & Křivánek, Efficient caustic rendering with lightweight photon mapping, CGF 37(4), 2018.

mod light;

use super::eye::{Draws, Eye};
use super::per_pixel::CameraRays;
use super::{Integrator, Pass, Prepared, RenderSettings, View};
use crate::photon::{PhotonEmitter, radius};
use crate::stats::Stats;
use hyaline_film::{PixelSample, Rect};
use hyaline_scene::ProjectionMaps;
use hyaline_world::World;
pub(super) use light::{Landed, emission_density};
#[cfg(test)]
pub(super) use light::{Photon, start, trace};
use std::sync::atomic::AtomicBool;

/// Cells of the projection maps along each axis.
const PROJECTION_CELLS: u32 = 64;

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
        _cancel: &AtomicBool,
        _stats: &mut Stats,
    ) -> Box<dyn Prepared + 'w> {
        let emitter = PhotonEmitter::new(world, ProjectionMaps::Cells, PROJECTION_CELLS);
        let photons = if settings.techniques.merging { light::count(&emitter, view) } else { 0 };
        Box::new(Merging { world, view: *view, settings: *settings, emitter, photons })
    }
}

/// What all passes share.
struct Merging<'w> {
    world: &'w World,
    view: View,
    settings: RenderSettings,
    emitter: PhotonEmitter<'w>,
    /// Photons that a pass sends out; none where no light can reach a polished surface.
    photons: u32,
}

impl Prepared for Merging<'_> {
    fn begin_pass<'a>(&'a self, pass: u32, stats: &mut Stats) -> Box<dyn Pass + 'a> {
        let landed = light::trace(self.world, &self.emitter, &self.settings, pass, self.photons, stats);
        Box::new(MergingPass { merging: self, pass, landed, shrink: radius::Shrink::of_pass(pass) })
    }
}

/// Photons of a pass, for paths that gather them.
#[derive(Clone, Copy)]
pub(super) struct Photons<'a> {
    pub(super) emitter: &'a PhotonEmitter<'a>,
    pub(super) landed: &'a Landed,
    pub(super) shrink: radius::Shrink,
}

/// One pass: its photons, and its paths.
struct MergingPass<'a> {
    merging: &'a Merging<'a>,
    pass: u32,
    landed: Landed,
    shrink: radius::Shrink,
}

impl Pass for MergingPass<'_> {
    fn render_tile(&self, tile: Rect, samples: &mut [PixelSample], stats: &mut Stats) {
        let Merging { world, view, settings, emitter, photons } = self.merging;
        let spread = world.cameras[view.camera].spread();
        let camera = CameraRays { world, view, settings, pass: self.pass };
        let photons =
            (*photons > 0).then_some(Photons { emitter, landed: &self.landed, shrink: self.shrink });
        let eye = Eye { world, settings, spread, photons };
        camera.render_tile(tile, samples, |ray, set, sampler, sample| {
            eye.radiance(ray, set, &mut Draws { sampler, stats }, Some(sample))
        });
    }
}
