//! How large a pixel is at a vertex of its path: what the gather radius goes by.
//!
//! A cone of rays starts as wide as the pixel. Polished surfaces pass it on as it is; wide ones open it by the lobe that
//! the next direction was drawn from, so that light gathered after a diffuse bounce is gathered from further around:
//! nobody sees where exactly it fell.

use hyaline_world::camera::PixelSpread;

/// Gather radius in pixels, before it shrinks.
const PIXELS: f32 = 2.5;
/// Share of a scattering lobe's width by which the cone opens.
const OPENING: f32 = 0.006;

/// The cone of a path.
#[derive(Clone, Copy, Debug)]
pub(super) struct Footprint {
    width: f32,
    angle: f32,
}

impl Footprint {
    /// That of a camera ray.
    pub(super) fn of_pixel(spread: PixelSpread) -> Self {
        Self { width: spread.width, angle: spread.angle }
    }

    /// Follows the path over a distance.
    pub(super) fn travel(&mut self, distance: f32) {
        self.width += self.angle * distance;
    }

    /// Passes a lobe that is not singular.
    ///
    /// - `pdf`: density of the direction taken, sr⁻¹.
    pub(super) fn scatter(&mut self, pdf: f32) {
        self.angle = self.angle.max(OPENING / pdf.max(1e-3).sqrt());
    }

    /// Radius from which photons are gathered in the first pass, scene units.
    pub(super) fn radius(&self) -> f32 {
        PIXELS * self.width
    }
}
