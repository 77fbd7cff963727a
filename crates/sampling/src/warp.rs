//! Maps from the unit square to discs, triangles and directions, each with the density of its results.
//!
//! Directions are about the local z axis. Every map takes a uniform point `u` of [0, 1)², is continuous but for the
//! azimuth's seam, and keeps a well spread set of points well spread.

use hyaline_math::float::{powf, sin_cos};
use hyaline_math::{Vec2, Vec3};
use std::f32::consts::{FRAC_1_PI, FRAC_PI_2, FRAC_PI_4, TAU};

/// Uniform point of the unit disc.
///
/// Source: Shirley & Chiu, A low distortion map between disk and square, Journal of Graphics Tools 2(3), 1997.
pub fn sample_disc(u: Vec2) -> Vec2 {
    let offset = 2.0 * u - Vec2::ONE;
    if offset == Vec2::ZERO {
        return Vec2::ZERO;
    }
    let (radius, angle) = if offset.x.abs() > offset.y.abs() {
        (offset.x, FRAC_PI_4 * (offset.y / offset.x))
    } else {
        (offset.y, FRAC_PI_2 - FRAC_PI_4 * (offset.x / offset.y))
    };
    let (sin, cos) = sin_cos(angle);
    radius * Vec2::new(cos, sin)
}

/// Density of `sample_disc` at `p`, per unit area.
pub fn pdf_disc(p: Vec2) -> f32 {
    if p.length_squared() <= 1.0 { FRAC_1_PI } else { 0.0 }
}

/// Barycentric coordinates (of the first, second and third corner) of a uniform point of a triangle.
///
/// Divide by the triangle's area for the density per unit area. Each is ≥ 0 and they add up to 1.
/// Source: Heitz, A low-distortion map between triangle and square, 2019.
pub fn sample_triangle(u: Vec2) -> Vec3 {
    let (first, second) = if u.x < u.y {
        let first = 0.5 * u.x;
        (first, u.y - first)
    } else {
        let second = 0.5 * u.y;
        (u.x - second, second)
    };
    Vec3::new(first, second, (1.0 - first - second).max(0.0))
}

/// Density of `sample_triangle` on a triangle of the given area, per unit area.
///
/// - `area`: > 0.
pub fn pdf_triangle(area: f32) -> f32 {
    1.0 / area
}

/// Direction of the upper hemisphere with density proportional to its cosine.
///
/// Source: Malley's method: points of the disc, lifted to the sphere. Pharr et al., Physically Based Rendering, 4th
/// ed., §A.5.3.
pub fn sample_cosine_hemisphere(u: Vec2) -> Vec3 {
    let p = sample_disc(u);
    p.extend((1.0 - p.length_squared()).max(0.0).sqrt())
}

/// Density of `sample_cosine_hemisphere`, sr⁻¹; 0 in the lower hemisphere.
///
/// - `cos_theta`: cosine to the z axis, -1…1.
pub fn pdf_cosine_hemisphere(cos_theta: f32) -> f32 {
    cos_theta.max(0.0) * FRAC_1_PI
}

/// Uniform direction.
pub fn sample_sphere(u: Vec2) -> Vec3 {
    sample_cone(u, 2.0)
}

/// Density of `sample_sphere`, sr⁻¹.
pub fn pdf_sphere() -> f32 {
    0.5 / TAU
}

/// Uniform point of the unit ball.
///
/// - `u`: for the direction; `v`: three uniform numbers in [0, 1), the largest of which is distributed as distances are.
pub fn sample_ball(u: Vec2, v: Vec3) -> Vec3 {
    sample_sphere(u) * v.max_element()
}

/// Uniform direction of the upper hemisphere.
pub fn sample_hemisphere(u: Vec2) -> Vec3 {
    sample_cone(u, 1.0)
}

/// Density of `sample_hemisphere`, sr⁻¹; 0 in the lower hemisphere.
///
/// - `cos_theta`: cosine to the z axis, -1…1.
pub fn pdf_hemisphere(cos_theta: f32) -> f32 {
    if cos_theta >= 0.0 { 1.0 / TAU } else { 0.0 }
}

/// Uniform direction of the cone about the z axis.
///
/// - `one_minus_cos`: 1 less the cosine of the cone's half-angle, 0…2; see `one_minus_cos`.
pub fn sample_cone(u: Vec2, one_minus_cos: f32) -> Vec3 {
    // Working with 1 - cos θ keeps narrow cones exact, where cos θ rounds to 1.
    let versine = u.x * one_minus_cos;
    let sin_theta = (versine * (2.0 - versine)).max(0.0).sqrt();
    direction(sin_theta, 1.0 - versine, u.y)
}

/// Density of `sample_cone`, sr⁻¹, at directions inside the cone.
///
/// - `one_minus_cos`: as for `sample_cone`, > 0.
pub fn pdf_cone(one_minus_cos: f32) -> f32 {
    1.0 / (TAU * one_minus_cos)
}

/// 1 less the cosine of an angle in 0…π/2, from the square of its sine, without cancellation.
///
/// - `sin2`: 0…1; larger counts as 1.
pub fn one_minus_cos(sin2: f32) -> f32 {
    sin2.min(1.0) / (1.0 + (1.0 - sin2).max(0.0).sqrt())
}

/// Direction of the upper hemisphere with density proportional to cosⁿ.
///
/// - `exponent`: n, ≥ 0.
///
/// Source: Lafortune & Willems, Using the modified Phong reflectance model for physically based rendering, 1994.
pub fn sample_phong(u: Vec2, exponent: f32) -> Vec3 {
    let cos_theta = powf(1.0 - u.x, 1.0 / (exponent + 1.0));
    direction((1.0 - cos_theta * cos_theta).max(0.0).sqrt(), cos_theta, u.y)
}

/// Density of `sample_phong`, sr⁻¹; 0 in the lower hemisphere.
///
/// - `cos_theta`: cosine to the z axis, -1…1.
/// - `exponent`: n, ≥ 0.
pub fn pdf_phong(cos_theta: f32, exponent: f32) -> f32 {
    if cos_theta > 0.0 { (exponent + 1.0) / TAU * powf(cos_theta.min(1.0), exponent) } else { 0.0 }
}

/// The unit direction at a polar angle and a fraction `turn` of the full circle.
fn direction(sin_theta: f32, cos_theta: f32, turn: f32) -> Vec3 {
    let (sin_phi, cos_phi) = sin_cos(TAU * turn);
    Vec3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta)
}

#[cfg(test)]
mod tests;
