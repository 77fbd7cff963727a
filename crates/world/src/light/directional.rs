//! Parallel light from infinitely far.

use super::{DirectSample, EmissionPdf, EmissionSample, SceneSphere};
use hyaline_math::{Vec2, Vec3};
use hyaline_spectrum::Spectrum;

/// Light from one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionalLight {
    /// Unit direction in which the light travels.
    pub direction: Vec3,
    /// Irradiance of a surface that faces the light, W m⁻².
    pub irradiance: Spectrum,
    /// What it shines on.
    pub scene: SceneSphere,
}

impl DirectionalLight {
    pub(super) fn sample_direct(&self) -> DirectSample {
        DirectSample {
            wi: -self.direction,
            distance: f32::INFINITY,
            target: None,
            radiance: self.irradiance,
            pdf_w: 1.0,
            is_delta: true,
        }
    }

    pub(super) fn sample_emission(&self, u: Vec2) -> EmissionSample {
        EmissionSample {
            origin: self.scene.sample_disc(self.direction, u),
            p_error: 0.0,
            n: None,
            direction: self.direction,
            weight: self.power(),
            pdf_position: self.pdf_emission().position,
            pdf_direction: 1.0,
            is_delta_position: false,
            is_delta_direction: true,
        }
    }

    pub(super) fn pdf_emission(&self) -> EmissionPdf {
        EmissionPdf { position: self.scene.disc_pdf(), direction: 1.0 }
    }

    pub(super) fn power(&self) -> Spectrum {
        self.irradiance * self.scene.disc_area()
    }
}
