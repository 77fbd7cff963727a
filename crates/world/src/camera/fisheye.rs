//! The equidistant fisheye: the angle from the axis is proportional to the distance from the film's center.

use super::LocalRay;
use hyaline_math::{DVec2, DVec3, float};

/// Sees a cone of directions in the film's inscribed circle and nothing outside the circle.
///
/// Source: Suffern, Ray Tracing from the Ground Up, 2007, ch. 11.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Fisheye {
    /// Radius of the circle, pixels.
    radius: f64,
    /// Angle from the axis at the circle, radians.
    half_fov: f64,
}

impl Fisheye {
    /// - `fov`: full angle across the circle, radians.
    /// - `size`: film, pixels.
    pub(super) fn new(fov: f64, size: DVec2) -> Self {
        Self { radius: 0.5 * size.min_element(), half_fov: 0.5 * fov }
    }

    /// - `q`: pixels right and up of the film's center.
    pub(super) fn ray(&self, q: DVec2) -> Option<LocalRay> {
        let distance = q.length();
        if distance > self.radius {
            return None;
        }
        let (sin, cos) = float::f64::sin_cos(distance / self.radius * self.half_fov);
        let sideways = q.try_normalize().unwrap_or(DVec2::ZERO) * sin;
        Some(LocalRay { origin: DVec3::ZERO, direction: sideways.extend(-cos) })
    }

    /// Angle of a pixel along the radius, radians; the same everywhere.
    pub(super) fn pixel_angle(&self) -> f64 {
        self.half_fov / self.radius
    }
}
