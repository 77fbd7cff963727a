//! Lambert's law: a surface that looks equally bright from everywhere.

use super::local::LocalSample;
use hyaline_math::{Vec2, Vec3};
use hyaline_sampling::warp;
use hyaline_spectrum::Spectrum;

/// A matte surface, seen and lit from +z; f = `reflectance` / π.
///
/// Source: Lambert, Photometria, 1760; Suffern, Ray Tracing from the Ground Up, 2007, ch. 13.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matte {
    /// Fraction of light reflected, 0…1.
    pub reflectance: Spectrum,
}

impl Matte {
    pub(super) fn sample(&self, wo: Vec3, u2: Vec2) -> Option<LocalSample> {
        let wi = warp::sample_cosine_hemisphere(u2);
        let pdf = self.pdf(wo, wi);
        let weight = self.reflectance;
        (pdf > 0.0).then_some(LocalSample { wi, weight, pdf, is_delta: false, transmits: false })
    }

    pub(super) fn eval(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        self.reflectance * self.pdf(wo, wi)
    }

    pub(super) fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        if wo.z > 0.0 { warp::pdf_cosine_hemisphere(wi.z) } else { 0.0 }
    }
}
