//! A sphere about the origin, or the part of one between two azimuths and two latitudes.

use super::error::{ShapeError, positive};
use super::{AngleRange, Crossings, ShapePoint};
use super::{away_from_axis, axis_distance, end_slack, revolved_point, revolved_surface, ring_support};
use hyaline_math::float::f64::{sin, sin_cos};
use hyaline_math::{DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, PI};

/// A sphere or a part of one, about the origin; the normal points away from the center.
///
/// `uv.y` is the fraction of the latitude range, from the lower end up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    radius: f64,
    phi: AngleRange,
    /// Angle in the (r, y) half-plane from the equator up.
    latitude: AngleRange,
    is_whole: bool,
}

impl Sphere {
    /// A whole sphere.
    ///
    /// # Errors
    /// Where the radius is not finite and above 0.
    pub fn new(radius: f64) -> Result<Self, ShapeError> {
        Self::part(radius, super::WHOLE_TURN, [0.0, PI])
    }

    /// A part of a sphere.
    ///
    /// - `phi`: range of azimuth, radians.
    /// - `theta`: range of the angle from +y, radians, within 0…π.
    ///
    /// # Errors
    /// Where the radius is not finite and above 0, or a range is empty or too long.
    pub fn part(radius: f64, phi: [f64; 2], theta: [f64; 2]) -> Result<Self, ShapeError> {
        let [low, high] = theta;
        if low < 0.0 || high > PI * (1.0 + 1e-12) {
            let value = if low < 0.0 { low } else { high };
            return Err(ShapeError::out_of_range("theta", value, "angles from +y go from 0 to π"));
        }
        Self::between_latitudes(radius, phi, [FRAC_PI_2 - high, FRAC_PI_2 - low])
    }

    /// A part of a sphere between two latitudes, radians within -π/2…π/2, counted from the equator towards +y.
    ///
    /// # Errors
    /// As `part`.
    pub fn between_latitudes(radius: f64, phi: [f64; 2], latitude: [f64; 2]) -> Result<Self, ShapeError> {
        let radius = positive("radius", radius)?;
        let phi = AngleRange::new("phi", phi)?;
        let latitude = AngleRange::new("latitude", latitude)?;
        // Directions in the half-plane end at the poles anyway.
        let is_pole_to_pole = latitude.span() >= PI * (1.0 - 1e-12);
        Ok(Self { radius, phi, latitude, is_whole: phi.is_whole() && is_pole_to_pole })
    }

    /// Radius.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    pub(super) fn support(&self, v: DVec3) -> f64 {
        if self.is_whole {
            return self.radius * v.length();
        }
        self.radius * self.latitude.support(DVec2::new(ring_support(v, &self.phi), v.y))
    }

    pub(super) fn crossings(&self, origin: DVec3, direction: DVec3, out: &mut Crossings) {
        let speed2 = direction.length_squared();
        // From the point of closest approach, so that a far origin costs no digits.
        let closest = -origin.dot(direction) / speed2;
        let p = origin + direction * closest;
        let half = ((self.radius * self.radius - p.length_squared()) / speed2).sqrt();
        // NaN, where the line misses, is admitted by no interval.
        for step in [-half, half] {
            let t = closest + step;
            if out.admits(t) && self.is_in_range(p + direction * step, origin) {
                out.push(t);
            }
        }
    }

    fn is_in_range(&self, p: DVec3, origin: DVec3) -> bool {
        if self.is_whole {
            return true;
        }
        let slack = end_slack(self.radius, origin);
        self.phi.contains(DVec2::new(p.z, p.x), slack)
            && self.latitude.contains(DVec2::new(axis_distance(p), p.y), slack)
    }

    pub(super) fn surface_at(&self, p: DVec3) -> ShapePoint {
        let away = away_from_axis(p, &self.phi);
        let normal = DVec2::new(axis_distance(p), p.y).try_normalize().unwrap_or(DVec2::Y);
        let v = self.latitude.fraction(normal);
        let length = self.radius * self.latitude.span();
        revolved_surface(normal * self.radius, normal, away, &self.phi, v, length)
    }

    pub(super) fn area(&self) -> f64 {
        let height = sin(self.latitude.end()) - sin(self.latitude.start());
        self.phi.span() * self.radius * self.radius * height
    }

    pub(super) fn sample_area(&self, u: DVec2) -> (DVec3, DVec3) {
        let (low, r_low) = sin_cos(self.latitude.start());
        let (high, r_high) = sin_cos(self.latitude.end());
        // Equal heights have equal areas (Archimedes). 1 ∓ sin, formed without cancellation near the poles.
        let from_bottom = one_minus(-low, r_low) + u.y * (high - low);
        let from_top = one_minus(high, r_high) + (1.0 - u.y) * (high - low);
        let y = if from_bottom < from_top { from_bottom - 1.0 } else { 1.0 - from_top };
        let r = (from_bottom * from_top).max(0.0).sqrt();
        let (mut n, away) = revolved_point(r, y, self.phi.start() + u.x * self.phi.span());
        n = if r > 0.0 { n.normalize() } else { away * r + DVec3::Y * y.signum() };
        (n * self.radius, n)
    }
}

/// `1 - s` for a sine and its cosine.
fn one_minus(s: f64, c: f64) -> f64 {
    if s > 0.5 { c * c / (1.0 + s) } else { 1.0 - s }
}
