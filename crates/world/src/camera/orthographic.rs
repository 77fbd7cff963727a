//! Parallel rays.

use super::LocalRay;
use hyaline_math::{DVec2, DVec3};

/// All rays go along the view axis; they start in the plane through the camera's place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Orthographic {
    /// Width of a pixel, scene units.
    pixel: f64,
}

impl Orthographic {
    /// - `height`: what the film's height spans, scene units.
    /// - `size`: film, pixels.
    pub(super) fn new(height: f64, size: DVec2) -> Self {
        Self { pixel: height / size.y }
    }

    /// - `q`: pixels right and up of the film's center.
    pub(super) fn ray(&self, q: DVec2) -> LocalRay {
        LocalRay { origin: (q * self.pixel).extend(0.0), direction: -DVec3::Z }
    }

    /// Width of every pixel, scene units.
    pub(super) fn pixel_width(&self) -> f64 {
        self.pixel
    }
}
