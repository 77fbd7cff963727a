//! What integrators share whose samples share nothing: each sample of a pixel is an estimate along one camera ray.

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
        let camera = CameraRays { world, view, settings, pass: self.pass };
        camera.render_tile(tile, samples, |_, (ray, start), sampler, sample| {
            estimate(world, settings, ray, start, sampler, stats, Some(sample))
        });
    }
}

/// A ray of the camera through a pixel, and what it starts in; `None` where the camera sees nothing there.
pub(super) fn ray_through(
    world: &World,
    view: &View,
    (x, y): (u32, u32),
    sampler: &mut Sampler,
) -> Option<(Ray, MediumSet)> {
    let film = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) + view.filter.sample(sampler.next_2d());
    let ray = world.cameras[view.camera].ray(film, sampler.next_2d())?;
    Some((ray, world.camera_media[view.camera].clone()))
}

/// The camera rays of one pass, one a pixel.
pub(super) struct CameraRays<'a> {
    pub(super) world: &'a World,
    pub(super) view: &'a View,
    pub(super) settings: &'a RenderSettings,
    pub(super) pass: u32,
}

impl CameraRays<'_> {
    /// Fills the samples of a tile: `estimate` gives the radiance that arrives along a ray, which starts inside the
    /// given set, and notes what the first surface looks like.
    pub(super) fn render_tile(
        &self,
        tile: Rect,
        samples: &mut [PixelSample],
        mut estimate: impl FnMut((u32, u32), (Ray, MediumSet), &mut Sampler, &mut PixelSample) -> Spectrum,
    ) {
        for (pixel, sample) in tile.pixels().zip(samples) {
            let mut sampler = Sampler::new(self.settings.sampler, self.settings.seed, pixel, self.pass);
            *sample = PixelSample::default();
            if let Some(camera_ray) = ray_through(self.world, self.view, pixel, &mut sampler) {
                sample.beauty = estimate(pixel, camera_ray, &mut sampler, sample).to_rgb();
            }
        }
    }
}
