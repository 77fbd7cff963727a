//! Directions toward a sphere, uniform in solid angle.
//!
//! From outside they fill the cone that the sphere is seen in, from inside the whole sphere of directions. All is
//! computed in `f64`, so that a point that all but touches the sphere is no special case.

use hyaline_math::{DVec2, DVec3, float::f64 as float};
use std::f64::consts::TAU;

/// A whole sphere in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SphereDirections {
    pub(super) center: DVec3,
    /// > 0.
    pub(super) radius: f64,
}

/// A direction to a surface and where it ends there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SurfaceDirection {
    /// Unit.
    pub(super) wi: DVec3,
    /// The place on the surface.
    pub(super) q: DVec3,
    /// Outward normal there, unit.
    pub(super) n: DVec3,
    /// Density of `wi`, sr⁻¹.
    pub(super) pdf_w: f64,
}

impl SphereDirections {
    /// A direction from `p` to the sphere, uniform in solid angle.
    ///
    /// Source: Wang, Physically correct direct lighting for distribution ray tracing, Graphics Gems III, 1992.
    pub(super) fn sample(&self, p: DVec3, u: DVec2) -> SurfaceDirection {
        let to_center = self.center - p;
        let axis = to_center.try_normalize().unwrap_or(DVec3::Z);
        // In 1 - cos the cone of a small or distant sphere keeps its precision.
        let h = u.x * self.cone(p);
        let (sin_phi, cos_phi) = float::sin_cos(TAU * u.y);
        let sin_theta = (h * (2.0 - h)).max(0.0).sqrt();
        let (s, t) = axis.any_orthonormal_pair();
        let wi = (s * (sin_theta * cos_phi) + t * (sin_theta * sin_phi) + axis * (1.0 - h)).normalize();
        let n = (p + wi * self.distance_along(p, wi) - self.center).normalize();
        SurfaceDirection { wi, q: self.center + n * self.radius, n, pdf_w: self.uniform_pdf(p) }
    }

    /// Density of `sample` at a place `q` of the sphere in the direction `wi`, sr⁻¹: 0 on the far side, which is never
    /// chosen from outside.
    pub(super) fn pdf(&self, p: DVec3, wi: DVec3, q: DVec3) -> f64 {
        let is_far_side = (q - self.center).dot(wi) > 0.0;
        if is_far_side && self.is_outside(p) { 0.0 } else { self.uniform_pdf(p) }
    }

    /// One over the solid angle, sr⁻¹.
    fn uniform_pdf(&self, p: DVec3) -> f64 {
        1.0 / (TAU * self.cone(p))
    }

    /// 1 - cos of the half-angle of the cone of directions: 2 from inside.
    fn cone(&self, p: DVec3) -> f64 {
        if !self.is_outside(p) {
            return 2.0;
        }
        let sin_squared = self.radius * self.radius / self.center.distance_squared(p);
        sin_squared / (1.0 + (1.0 - sin_squared).sqrt())
    }

    fn is_outside(&self, p: DVec3) -> bool {
        self.center.distance_squared(p) > self.radius * self.radius
    }

    /// Distance to the nearer crossing from outside, to the only one from inside.
    fn distance_along(&self, p: DVec3, wi: DVec3) -> f64 {
        let to_center = self.center - p;
        let middle = to_center.dot(wi);
        let miss = to_center - wi * middle;
        let half_chord = (self.radius * self.radius - miss.length_squared()).max(0.0).sqrt();
        if self.is_outside(p) { middle - half_chord } else { middle + half_chord }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    const UNIT: SphereDirections = SphereDirections { center: DVec3::ZERO, radius: 1.0 };

    #[test]
    fn the_density_is_one_over_the_solid_angle() {
        let p = DVec3::new(0.0, 2.0, 0.0);
        assert!((1.0 / UNIT.uniform_pdf(p) - TAU * (1.0 - 0.75_f64.sqrt())).abs() < 1e-12);
        assert!((1.0 / UNIT.uniform_pdf(DVec3::new(0.5, 0.0, 0.0)) - 4.0 * PI).abs() < 1e-12);
        // Far away it is a disc.
        assert!((1.0 / UNIT.uniform_pdf(DVec3::new(1e8, 0.0, 0.0)) / (PI * 1e-16) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn sampled_points_lie_on_the_sphere_where_the_direction_says() {
        for distance in [0.0, 0.5, 1.0, 1.0 + 1e-12, 1.001, 3.0, 1e6] {
            let p = DVec3::new(0.6, 0.0, 0.8) * distance;
            for i in 0..100 {
                let u = DVec2::new(f64::from(i % 10) / 10.0 + 0.05, f64::from(i / 10) / 10.0 + 0.03);
                let sample = UNIT.sample(p, u);
                assert!((sample.q.length() - 1.0).abs() < 1e-12);
                let to_light = sample.q - p;
                assert!((to_light - sample.wi * to_light.length()).length() < 1e-6, "{distance} {u}");
                let inside = distance <= 1.0;
                assert!(sample.n.dot(sample.wi) * if inside { 1.0 } else { -1.0 } > -1e-6, "{distance} {u}");
            }
        }
    }
}
