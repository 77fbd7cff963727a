//! The photons, traced as `photon-map` traces them: as points, or as the estimates that are made of them.
//!
//! Estimates are made at the first surface that is not polished, seen through all that are, and shown as they are,
//! without the surface's color. Points are shown where the camera sees the surface that they lie on.

use super::point_cloud::PointCloud;
use super::polished;
use crate::integrator::per_pixel::CameraRays;
use crate::integrator::{Pass, Prepared, RenderSettings, View};
use crate::photon::maps::{PhotonMaps, PhotonStatistics};
use crate::photon::tree::Nearest;
use crate::photon::{Estimate, Gathered, PhotonMap};
use crate::stats::Stats;
use crate::walk::Vertex;
use hyaline_film::{PixelSample, Rect};
use hyaline_math::Vec3;
use hyaline_scene::DebugView;
use hyaline_spectrum::Spectrum;
use hyaline_world::World;
use std::sync::atomic::AtomicBool;

/// The maps, ready to be shown.
pub(super) struct PhotonView<'w> {
    world: &'w World,
    view: View,
    settings: RenderSettings,
    maps: PhotonMaps,
}

impl<'w> PhotonView<'w> {
    /// Traces the photons.
    pub(super) fn new(
        world: &'w World,
        view: &View,
        settings: &RenderSettings,
        cancel: &AtomicBool,
        stats: &mut Stats,
    ) -> Self {
        let maps = PhotonMaps::new(world, settings, cancel, stats);
        Self { world, view: *view, settings: *settings, maps }
    }
}

impl Prepared for PhotonView<'_> {
    fn begin_pass<'a>(&'a self, pass: u32, _stats: &mut Stats) -> Box<dyn Pass + 'a> {
        Box::new(PhotonPass { shown: self, pass })
    }

    fn photon_statistics(&self) -> Option<PhotonStatistics> {
        Some(self.maps.statistics)
    }
}

struct PhotonPass<'a> {
    shown: &'a PhotonView<'a>,
    pass: u32,
}

impl Pass for PhotonPass<'_> {
    fn render_tile(&self, tile: Rect, samples: &mut [PixelSample], stats: &mut Stats) {
        let PhotonView { world, view, settings, maps } = self.shown;
        let camera = CameraRays { world, view, settings, pass: self.pass };
        let cloud =
            PointCloud { world, maps, spread: world.cameras[view.camera].spread(), show: settings.debug };
        let mut scratch = Nearest::default();
        camera.render_tile(tile, samples, |_, (ray, set), sampler, sample| {
            if cloud.is_wanted() {
                return cloud.color(&ray, set, stats, sample);
            }
            match polished::look(world, ray, set, sampler, stats, Some(sample)).end {
                Some((vertex, wo)) => estimate(maps, settings.debug, &vertex, wo, &mut scratch),
                None => Spectrum::ZERO,
            }
        });
    }
}

/// What the maps say of a place: irradiance, or how it was found.
fn estimate(
    maps: &PhotonMaps,
    view: DebugView,
    vertex: &Vertex,
    wo: Vec3,
    scratch: &mut Nearest,
) -> Spectrum {
    let ng = vertex.hit.ng;
    let n = if wo.dot(ng) < 0.0 { -ng } else { ng };
    let mut gather =
        |map: &PhotonMap, estimate: &Estimate| estimate.irradiance(map, vertex.hit.p, n, |_| true, scratch);
    if view == DebugView::CausticIrradiance {
        return gather(&maps.caustic, &maps.caustic_estimate).value;
    }
    let global = gather(&maps.global, &maps.global_estimate);
    if view == DebugView::Irradiance {
        return global.value;
    }
    let caustic = gather(&maps.caustic, &maps.caustic_estimate);
    let figure = |gathered: Gathered| match (view, gathered.found) {
        (_, 0) => 0.0,
        (DebugView::PhotonsFound, found) => found as f32,
        _ => gathered.radius,
    };
    Spectrum::from_rgb([figure(global), figure(caustic), 0.0])
}
