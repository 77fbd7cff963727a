//! How far photons are gathered from: a few pixels, as large as they are there.

use crate::photon::radius::Shrink;
use hyaline_math::{Bounds, Vec3};
use hyaline_world::camera::{Camera, PixelSpread};

/// Gather radius in pixels, before it shrinks.
const PIXELS: f32 = 2.5;
/// How much larger it is on surfaces for photons that have been scattered widely on their way: what they bring is smooth,
/// and they are few.
pub(in crate::integrator) const INDIRECT: f32 = 2.0;

/// The radius at every place of the scene. It goes by the straight way to the camera alone, so that photons that pass a
/// vertex know it as well as paths that come to it: their weights ask for it.
#[derive(Clone, Copy, Debug)]
pub(in crate::integrator) struct GatherRadius {
    spread: PixelSpread,
    camera: Vec3,
    /// What this pass makes of it, on surfaces and in volumes.
    shrink: Shrink,
}

impl GatherRadius {
    /// Of one pass.
    pub(in crate::integrator) fn new(camera: &Camera, shrink: Shrink) -> Self {
        Self { spread: camera.spread(), camera: camera.position().as_vec3(), shrink }
    }

    /// As of pixels so many times as wide.
    pub(in crate::integrator) fn widened(mut self, scale: f32) -> Self {
        self.spread.width *= scale;
        self.spread.angle *= scale;
        self
    }

    /// On surfaces, scene units, for photons that come over polished surfaces alone; others are gathered from [`INDIRECT`]
    /// times as far.
    pub(in crate::integrator) fn on_surface(&self, p: Vec3) -> f32 {
        self.before_it_shrinks(p) * self.shrink.surface
    }

    /// Of points in volumes, scene units.
    pub(in crate::integrator) fn in_volume(&self, p: Vec3) -> f32 {
        self.before_it_shrinks(p) * self.shrink.volume
    }

    /// Of beams, scene units.
    pub(in crate::integrator) fn of_beams(&self, p: Vec3) -> f32 {
        self.before_it_shrinks(p) * self.shrink.beam
    }

    /// The largest radius of beams anywhere in a box, and within that radius of it.
    pub(in crate::integrator) fn of_beams_within(&self, bounds: &Bounds) -> f32 {
        let farthest = (bounds.min - self.camera).abs().max((bounds.max - self.camera).abs());
        let there = self.at_distance(farthest.length()) * self.shrink.beam;
        // A ray within the radius of the box may be farther off than the box, and its radius larger by as much.
        there / (1.0 - PIXELS * self.spread.angle * self.shrink.beam).max(0.1)
    }

    fn before_it_shrinks(&self, p: Vec3) -> f32 {
        self.at_distance(p.distance(self.camera))
    }

    fn at_distance(&self, distance: f32) -> f32 {
        PIXELS * (self.spread.width + self.spread.angle * distance)
    }
}
