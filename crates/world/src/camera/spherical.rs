//! The latitude-longitude camera: longitude across the film, latitude down.

use super::LocalRay;
use hyaline_math::{DVec2, DVec3, float};

/// Sees all directions, or a patch of them about the view axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spherical {
    /// Angle of a pixel in longitude and latitude, radians.
    pixel: DVec2,
}

impl Spherical {
    /// - `longitude`, `latitude`: what the film's width and height span, radians.
    /// - `size`: film, pixels.
    pub(super) fn new(longitude: f64, latitude: f64, size: DVec2) -> Self {
        Self { pixel: DVec2::new(longitude, latitude) / size }
    }

    /// - `q`: pixels right and up of the film's center.
    pub(super) fn ray(&self, q: DVec2) -> LocalRay {
        let angles = q * self.pixel;
        let (sin_longitude, cos_longitude) = float::f64::sin_cos(angles.x);
        let (sin_latitude, cos_latitude) = float::f64::sin_cos(angles.y);
        let direction = DVec3::new(cos_latitude * sin_longitude, sin_latitude, -cos_latitude * cos_longitude);
        LocalRay { origin: DVec3::ZERO, direction }
    }

    /// The larger of a pixel's two angles on the horizon, radians.
    pub(super) fn pixel_angle(&self) -> f64 {
        self.pixel.max_element()
    }
}
