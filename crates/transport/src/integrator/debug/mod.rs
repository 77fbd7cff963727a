//! Pictures of what a scene is and of what a renderer knows of it, in place of light.
//!
//! Values are written as if they were radiance, so that an EXR holds them as they are and `--exposure` scales them
//! for a PNG. Three families, each in a file of its own:
//!
//! - `surface_view`: the first surface of a camera ray, by itself;
//! - `polished`: what lies behind polished surfaces;
//! - `photon_view`: the photons, as points (`point_cloud`) or as the estimates that are made of them.

mod code_color;
mod photon_view;
mod point_cloud;
mod polished;
mod surface_view;

use self::photon_view::PhotonView;
use super::per_pixel::PerPixel;
use super::{Integrator, Prepared, RenderSettings, View};
use crate::stats::Stats;
use hyaline_scene::DebugView;
use hyaline_world::World;
use std::sync::atomic::AtomicBool;

/// Shows what [`RenderSettings::debug`] names.
pub struct DebugIntegrator;

impl Integrator for DebugIntegrator {
    fn name(&self) -> &'static str {
        "debug"
    }

    fn prepare<'w>(
        &self,
        world: &'w World,
        view: &View,
        settings: &RenderSettings,
        cancel: &AtomicBool,
        stats: &mut Stats,
    ) -> Box<dyn Prepared + 'w> {
        if shows_photons(settings.debug) {
            return Box::new(PhotonView::new(world, view, settings, cancel, stats));
        }
        Box::new(PerPixel { world, view: *view, settings: *settings, estimate: surface_view::value })
    }
}

/// Whether a view needs photons to be traced.
pub fn shows_photons(view: DebugView) -> bool {
    match view {
        DebugView::Normal
        | DebugView::GeometricNormal
        | DebugView::Depth
        | DebugView::Uv
        | DebugView::Medium
        | DebugView::Object
        | DebugView::Albedo
        | DebugView::Crossings => false,
        DebugView::PhotonPower
        | DebugView::PhotonDepth
        | DebugView::PhotonMap
        | DebugView::Irradiance
        | DebugView::CausticIrradiance
        | DebugView::PhotonsFound
        | DebugView::PhotonRadius => true,
    }
}
