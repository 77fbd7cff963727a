//! Path tracing: one path per pixel and pass, light sampling and BSDF sampling combined by MIS; see `eye` for the steps.

use super::eye::{Draws, Eye};
use super::per_pixel::PerPixel;
use super::{Integrator, Prepared, RenderSettings, View};
use crate::stats::Stats;
use hyaline_film::PixelSample;
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
        _cancel: &AtomicBool,
        _stats: &mut Stats,
    ) -> Box<dyn Prepared + 'w> {
        Box::new(PerPixel { world, view: *view, settings: *settings, estimate: radiance })
    }
}

/// One estimate of the radiance that arrives along `ray`, which starts inside `set`.
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
    let eye = Eye { world, settings, photons: None };
    eye.radiance(ray, set, &mut Draws { sampler, stats }, first)
}
