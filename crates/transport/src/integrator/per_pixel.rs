//! What integrators share whose passes share nothing: each sample of a pixel is an estimate along one camera ray.

use super::{Pass, Prepared, RenderSettings, View};
use crate::stats::Stats;
use hyaline_film::{PixelSample, Rect};
use hyaline_math::{Ray, Vec2};
use hyaline_sampling::Sampler;
use hyaline_scattering::MediumSet;
use hyaline_spectrum::Spectrum;
use hyaline_world::World;

/// One estimate of the radiance that arrives along a ray, which starts inside the given set; the last argument
/// receives what the first surface looks like.
pub(super) type Estimate = fn(
    &World,
    &RenderSettings,
    Ray,
    MediumSet,
    &mut Sampler,
    &mut Stats,
    Option<&mut PixelSample>,
) -> Spectrum;

/// An integrator with nothing to prepare.
pub(super) struct PerPixel<'w> {
    pub(super) world: &'w World,
    pub(super) view: View,
    pub(super) settings: RenderSettings,
    pub(super) estimate: Estimate,
}

impl Prepared for PerPixel<'_> {
    fn begin_pass<'a>(&'a self, pass: u32, _stats: &mut Stats) -> Box<dyn Pass + 'a> {
        Box::new(PixelPass { prepared: self, pass })
    }
}

struct PixelPass<'a> {
    prepared: &'a PerPixel<'a>,
    pass: u32,
}

impl Pass for PixelPass<'_> {
    fn render_tile(&self, tile: Rect, samples: &mut [PixelSample], stats: &mut Stats) {
        let PerPixel { world, view, settings, estimate } = self.prepared;
        for (pixel, sample) in tile.pixels().zip(samples) {
            camera_sample(world, settings, view, pixel, self.pass, sample, |ray, set, sampler, sample| {
                estimate(world, settings, ray, set, sampler, stats, Some(sample))
            });
        }
    }
}

/// Makes sample number `pass` of a pixel from an estimate of the radiance along its camera ray.
pub(super) fn camera_sample(
    world: &World,
    settings: &RenderSettings,
    view: &View,
    (x, y): (u32, u32),
    pass: u32,
    sample: &mut PixelSample,
    estimate: impl FnOnce(Ray, MediumSet, &mut Sampler, &mut PixelSample) -> Spectrum,
) {
    let mut sampler = Sampler::new(settings.sampler, settings.seed, (x, y), pass);
    let film = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) + view.filter.sample(sampler.next_2d());
    let lens = sampler.next_2d();
    *sample = PixelSample::default();
    if let Some(ray) = world.cameras[view.camera].ray(film, lens) {
        let start = world.camera_media[view.camera].clone();
        sample.beauty = estimate(ray, start, &mut sampler, sample).to_rgb();
    }
}
