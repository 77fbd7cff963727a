//! A point that shines alike in all directions.

use super::{Cone, DirectSample, EmissionPdf, EmissionSample, UnitBox};
use hyaline_math::{Frame, Vec2, Vec3};
use hyaline_sampling::warp;
use hyaline_spectrum::Spectrum;
use std::f32::consts::PI;

/// Light from one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLight {
    /// Place, world space.
    pub position: Vec3,
    /// Radiant intensity, W sr⁻¹.
    pub intensity: Spectrum,
}

impl PointLight {
    pub(super) fn sample_direct(&self, p: Vec3) -> Option<DirectSample> {
        from_point(self.position, p, |_| self.intensity)
    }

    pub(super) fn sample_emission(&self, u: Vec2) -> EmissionSample {
        EmissionSample {
            origin: self.position,
            p_error: 0.0,
            n: None,
            direction: warp::sample_sphere(u),
            weight: self.power(),
            pdf_position: 1.0,
            pdf_direction: Self::pdf_emission().direction,
            is_delta_position: true,
            is_delta_direction: false,
        }
    }

    pub(super) fn pdf_emission() -> EmissionPdf {
        EmissionPdf { position: 1.0, direction: 0.25 / PI }
    }

    pub(super) fn cone_of_emission(unit_box: &UnitBox) -> Cone {
        let world = Frame { s: Vec3::X, t: Vec3::Y, n: Vec3::Z };
        Cone::about_turned(&world, [2.0 * unit_box.min.x, 2.0 * unit_box.max.x], unit_box)
    }

    pub(super) fn power(&self) -> Spectrum {
        self.intensity * (4.0 * PI)
    }
}

/// Light at `p` from a point that sends `intensity(direction)`, W sr⁻¹: the inverse square law.
pub(super) fn from_point(
    position: Vec3,
    p: Vec3,
    intensity: impl FnOnce(Vec3) -> Spectrum,
) -> Option<DirectSample> {
    let to_light = position - p;
    let wi = to_light.try_normalize()?;
    let intensity = intensity(-wi);
    if intensity.is_zero() {
        return None;
    }
    let radiance = intensity / to_light.length_squared();
    let distance = to_light.length();
    Some(DirectSample { wi, distance, target: None, radiance, pdf_w: 1.0, is_delta: true })
}
