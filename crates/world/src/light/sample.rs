//! What sampling a light gives: a direction to it, or a ray from it.

use hyaline_math::{Bounds, Frame, Vec2, Vec3};
use hyaline_sampling::warp;
use hyaline_spectrum::Spectrum;
use std::f32::consts::PI;

/// Light that may reach a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectSample {
    /// Unit direction from the point to the light.
    pub wi: Vec3,
    /// Distance to the light, scene units; infinite for lights at infinity.
    pub distance: f32,
    /// The place on the light, for lights with a surface.
    pub target: Option<LightPoint>,
    /// Radiance from `wi`, unoccluded; for delta lights the irradiance of a surface that faces `wi`.
    pub radiance: Spectrum,
    /// Density of `wi`, sr⁻¹; 1 for delta lights.
    pub pdf_w: f32,
    /// Whether no other direction brings light, so that no ray can find it by chance.
    pub is_delta: bool,
}

/// A place on the surface of a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightPoint {
    /// The point, world space.
    pub p: Vec3,
    /// Bound on its distance from the true surface, scene units.
    pub p_error: f32,
    /// Geometric normal, unit, outward.
    pub n: Vec3,
}

/// Light that starts on its way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmissionSample {
    /// Where it starts, world space.
    pub origin: Vec3,
    /// Bound on the distance of `origin` from the light's true surface, scene units; 0 without a surface.
    pub p_error: f32,
    /// Geometric normal of the light's surface, unit, outward; `None` without a surface.
    pub n: Option<Vec3>,
    /// Unit direction in which it travels.
    pub direction: Vec3,
    /// Radiance (or intensity, or irradiance) × cosine over both densities: W; its mean is the light's power.
    pub weight: Spectrum,
    /// Density of `origin`, m⁻²; 1 where `is_delta_position`.
    pub pdf_position: f32,
    /// Density of `direction`, sr⁻¹; 1 where `is_delta_direction`.
    pub pdf_direction: f32,
    /// Whether all light starts at one point.
    pub is_delta_position: bool,
    /// Whether all light travels in one direction.
    pub is_delta_direction: bool,
}

/// Densities of an emitted ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmissionPdf {
    /// Of its origin, m⁻²; 1 where the light has but one.
    pub position: f32,
    /// Of its direction, sr⁻¹; 1 where the light has but one.
    pub direction: f32,
}

/// A ball about everything that can be lit; lights at infinity send their light through it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneSphere {
    /// Center.
    pub center: Vec3,
    /// Radius, scene units; 0 where there is nothing.
    pub radius: f32,
}

impl SceneSphere {
    /// The ball about a box, with some slack against rounding.
    pub fn from_bounds(bounds: &Bounds) -> Self {
        let center = if bounds.is_empty() { Vec3::ZERO } else { bounds.center() };
        Self { center, radius: bounds.radius() * 1.000_01 }
    }

    /// Area of the disc that covers the ball, m².
    pub fn disc_area(&self) -> f32 {
        PI * self.radius * self.radius
    }

    /// A uniform point of the disc that touches the ball where light of this direction comes from.
    pub(super) fn sample_disc(&self, direction: Vec3, u: Vec2) -> Vec3 {
        self.point_of_disc(&Frame::from_normal(direction), u)
    }

    /// The same point in a frame about the direction of the light.
    ///
    /// - `u`: two uniform random numbers in [0, 1).
    pub fn point_of_disc(&self, frame: &Frame, u: Vec2) -> Vec3 {
        let q = warp::sample_disc(u) * self.radius;
        self.center - frame.n * self.radius + frame.s * q.x + frame.t * q.y
    }

    /// Density of `sample_disc`, m⁻²; 0 for an empty ball.
    pub(super) fn disc_pdf(&self) -> f32 {
        if self.radius > 0.0 { 1.0 / self.disc_area() } else { 0.0 }
    }
}
