//! How far photons are gathered from: a few pixels, as large as they are there.

use hyaline_math::{DVec3, Vec3};
use hyaline_world::camera::{Camera, PixelSpread};

/// Gather radius in pixels, before it shrinks.
const PIXELS: f32 = 2.5;

/// The radius at every place of the scene. It goes by the straight way to the camera alone, so that photons that pass a
/// vertex know it as well as paths that come to it: their weights ask for it.
#[derive(Clone, Copy, Debug)]
pub(in crate::integrator) struct GatherRadius {
    spread: PixelSpread,
    camera: Vec3,
    /// What this pass makes of it, on surfaces and in volumes.
    shrink: crate::photon::radius::Shrink,
}

impl GatherRadius {
    /// Of one pass.
    pub(in crate::integrator) fn new(camera: &Camera, shrink: crate::photon::radius::Shrink) -> Self {
        let position: DVec3 = camera.position();
        Self { spread: camera.spread(), camera: position.as_vec3(), shrink }
    }

    /// On surfaces, scene units.
    pub(in crate::integrator) fn on_surface(&self, p: Vec3) -> f32 {
        self.before_it_shrinks(p) * self.shrink.surface
    }

    /// In volumes, scene units.
    pub(in crate::integrator) fn in_volume(&self, p: Vec3) -> f32 {
        self.before_it_shrinks(p) * self.shrink.volume
    }

    fn before_it_shrinks(&self, p: Vec3) -> f32 {
        PIXELS * (self.spread.width + self.spread.angle * p.distance(self.camera))
    }
}
