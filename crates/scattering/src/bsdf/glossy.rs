//! Suffern's glossy reflector: a lobe about the mirror direction and nothing else.

use super::local::LocalSample;
use super::phong::{eval_lobe, pdf_lobe, sample_lobe};
use hyaline_math::{Vec2, Vec3};
use hyaline_spectrum::Spectrum;

/// A glossy reflector, seen and lit from +z: the lobe of [`super::Phong`] alone.
///
/// Source: Suffern, Ray Tracing from the Ground Up, 2007, ch. 25, normalized.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlossySpecular {
    /// Fraction reflected at normal incidence and large exponents, 0…1; the bound at others.
    pub reflectance: Spectrum,
    /// Exponent of the lobe, ≥ 0; narrower as it grows.
    pub exponent: f32,
}

impl GlossySpecular {
    pub(super) fn sample(&self, wo: Vec3, u2: Vec2) -> Option<LocalSample> {
        let wi = sample_lobe(wo, self.exponent, u2);
        let pdf = self.pdf(wo, wi);
        let weight = self.reflectance * (eval_lobe(wo, wi, self.exponent) / pdf);
        (pdf > 0.0).then_some(LocalSample { wi, weight, pdf, is_delta: false, transmits: false })
    }

    pub(super) fn eval(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        self.reflectance * eval_lobe(wo, wi, self.exponent)
    }

    pub(super) fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        pdf_lobe(wo, wi, self.exponent)
    }
}
