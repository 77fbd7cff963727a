//! Path tracing: one path per pixel and pass; light sampling, BSDF sampling and aim at what throws caustics combined by
//! MIS. See `eye` for the steps.

use super::eye::aim::Aim;
use super::eye::tally::Tally;
use super::eye::{Draws, Eye};
use super::per_pixel::CameraRays;
use super::{Integrator, Pass, Prepared, RenderSettings, View};
use crate::stats::Stats;
use hyaline_film::{PixelSample, Rect};
use hyaline_math::Ray;
use hyaline_sampling::Sampler;
use hyaline_scattering::MediumSet;
use hyaline_spectrum::Spectrum;
use hyaline_world::World;
use std::sync::atomic::AtomicBool;

/// Unidirectional path tracing with light sampling.
pub struct PathIntegrator;

impl Integrator for PathIntegrator {
    fn name(&self) -> &'static str {
        "path"
    }

    fn prepare<'w>(
        &self,
        world: &'w World,
        view: &View,
        settings: &RenderSettings,
        cancel: &AtomicBool,
        stats: &mut Stats,
    ) -> Box<dyn Prepared + 'w> {
        let aim = Aim::taught(world, view.width * view.height, settings, cancel, stats);
        Box::new(Paths { world, view: *view, settings: *settings, aim })
    }
}

/// What all passes share.
struct Paths<'w> {
    world: &'w World,
    view: View,
    settings: RenderSettings,
    aim: Aim,
}

impl Prepared for Paths<'_> {
    fn begin_pass<'a>(&'a self, pass: u32, _stats: &mut Stats) -> Box<dyn Pass + 'a> {
        Box::new(PathPass { paths: self, pass })
    }
}

struct PathPass<'a> {
    paths: &'a Paths<'a>,
    pass: u32,
}

impl Pass for PathPass<'_> {
    fn render_tile(&self, tile: Rect, samples: &mut [PixelSample], stats: &mut Stats) {
        let Paths { world, view, settings, aim } = self.paths;
        let camera = CameraRays { world, view, settings, pass: self.pass };
        let eye = Eye { world, settings, aim: Some(aim), photons: None };
        camera.render_tile(tile, samples, |_, (ray, set), sampler, sample| {
            eye.radiance(ray, set, &mut Draws { sampler, stats, tally: Tally::default() }, Some(sample)).all()
        });
    }
}

/// One estimate of the radiance that arrives along `ray`, which starts inside `set`; without aim.
///
/// - `first`: receives what the first surface looks like.
pub fn radiance(
    world: &World,
    settings: &RenderSettings,
    ray: Ray,
    set: MediumSet,
    sampler: &mut Sampler,
    stats: &mut Stats,
    first: Option<&mut PixelSample>,
) -> Spectrum {
    let eye = Eye { world, settings, aim: None, photons: None };
    eye.radiance(ray, set, &mut Draws { sampler, stats, tally: Tally::default() }, first).all()
}
