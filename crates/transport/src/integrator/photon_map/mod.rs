//! Jensen's photon mapping: photons are traced into maps once, then every camera path looks light up there.
//!
//! 1. Photon stage, in `prepare`: a caustic map of light that comes over specular surfaces alone, from photons
//!    emitted toward those, and of what it throws on other surfaces; a global map of all light.
//!    With media that scatter also a map of what they scatter.
//! 2. Eye stage, in every pass: see `eye`.
//!
//! The maps are the same in all passes, so their noise stays however many passes are made; it shows as blur and
//! blotches of the size of the look-up radius, and shrinks with more photons.
//! Source: Jensen, Realistic Image Synthesis Using Photon Mapping, 2001, ch. 9.

mod eye;
mod strand;

use super::per_pixel::CameraRays;
use super::{Integrator, Pass, Prepared, RenderSettings, View};
use crate::photon::maps::{PhotonMaps, PhotonStatistics};
use crate::stats::Stats;
use eye::Eye;
use hyaline_film::{PixelSample, Rect};
use hyaline_world::World;
use std::sync::atomic::AtomicBool;
use strand::Strand;

/// Photon mapping.
pub struct PhotonMapIntegrator;

impl Integrator for PhotonMapIntegrator {
    fn name(&self) -> &'static str {
        "photon-map"
    }

    fn prepare<'w>(
        &self,
        world: &'w World,
        view: &View,
        settings: &RenderSettings,
        cancel: &AtomicBool,
        stats: &mut Stats,
    ) -> Box<dyn Prepared + 'w> {
        let maps = PhotonMaps::new(world, settings, cancel, stats);
        Box::new(EyeStage { world, view: *view, settings: *settings, maps })
    }
}

/// The maps, ready to be looked up.
struct EyeStage<'w> {
    world: &'w World,
    view: View,
    settings: RenderSettings,
    maps: PhotonMaps,
}

impl Prepared for EyeStage<'_> {
    fn begin_pass<'a>(&'a self, pass: u32, _stats: &mut Stats) -> Box<dyn Pass + 'a> {
        Box::new(EyePass { stage: self, pass })
    }

    fn photon_statistics(&self) -> Option<PhotonStatistics> {
        Some(self.maps.statistics_so_far())
    }
}

struct EyePass<'a> {
    stage: &'a EyeStage<'a>,
    pass: u32,
}

impl Pass for EyePass<'_> {
    fn render_tile(&self, tile: Rect, samples: &mut [PixelSample], stats: &mut Stats) {
        let EyeStage { world, view, settings, maps } = self.stage;
        let camera = CameraRays { world, view, settings, pass: self.pass };
        let mut eye = Eye::new(world, settings, maps, stats);
        camera.render_tile(tile, samples, |_, (ray, set), sampler, sample| {
            eye.follow(Strand::from_camera(ray, set), sampler, Some(sample))
        });
        eye.tell_times();
    }
}
