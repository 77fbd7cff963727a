//! Lambert's law plus a lobe about the mirror direction, normalized.

use super::local::{LocalSample, mirrored};
use hyaline_math::{Frame, Vec2, Vec3};
use hyaline_sampling::warp;
use hyaline_spectrum::Spectrum;

/// A Phong surface, seen and lit from +z: f = d / π + s (e + 2) / 2π · cos(angle to the mirror direction)^e.
///
/// It reflects no more than `diffuse` + `specular`, and satisfies reciprocity.
/// Source: Lafortune & Willems, Using the Modified Phong Reflectance Model for Physically Based Rendering, CW 197,
/// KU Leuven, 1994.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phong {
    /// Diffuse reflectance, 0…1.
    pub diffuse: Spectrum,
    /// Reflectance of the lobe, 0…1; no lane of the sum should exceed 1.
    pub specular: Spectrum,
    /// Exponent of the lobe, ≥ 0.
    pub exponent: f32,
}

impl Phong {
    pub(super) fn sample(&self, wo: Vec3, u_lobe: f32, u2: Vec2, lanes: usize) -> Option<LocalSample> {
        let wi = if u_lobe < self.chance_of_diffuse(lanes)? {
            warp::sample_cosine_hemisphere(u2)
        } else {
            sample_lobe(wo, self.exponent, u2)
        };
        let pdf = self.pdf(wo, wi, lanes);
        let weight = self.eval(wo, wi) / pdf;
        (pdf > 0.0).then_some(LocalSample { wi, weight, pdf, is_delta: false, transmits: false })
    }

    pub(super) fn eval(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        self.diffuse * pdf_diffuse(wo, wi) + self.specular * eval_lobe(wo, wi, self.exponent)
    }

    pub(super) fn pdf(&self, wo: Vec3, wi: Vec3, lanes: usize) -> f32 {
        self.chance_of_diffuse(lanes).map_or(0.0, |chance| {
            chance * pdf_diffuse(wo, wi) + (1.0 - chance) * pdf_lobe(wo, wi, self.exponent)
        })
    }

    /// Probability of the diffuse part; `None` for a black surface.
    fn chance_of_diffuse(&self, lanes: usize) -> Option<f32> {
        let (diffuse, specular) = (self.diffuse.mean(lanes), self.specular.mean(lanes));
        (diffuse + specular > 0.0).then(|| diffuse / (diffuse + specular))
    }
}

/// Direction about the mirror direction of `wo`; may lie below the surface.
pub(super) fn sample_lobe(wo: Vec3, exponent: f32, u2: Vec2) -> Vec3 {
    Frame::from_normal(mirrored(wo)).to_world(warp::sample_phong(u2, exponent))
}

/// f |cos| of a lobe of reflectance 1, sr⁻¹.
pub(super) fn eval_lobe(wo: Vec3, wi: Vec3, exponent: f32) -> f32 {
    (exponent + 2.0) / (exponent + 1.0) * pdf_lobe(wo, wi, exponent) * wi.z
}

/// Density of `sample_lobe` above the surface, sr⁻¹; 0 below, where its directions are refused.
pub(super) fn pdf_lobe(wo: Vec3, wi: Vec3, exponent: f32) -> f32 {
    let is_above = wo.z > 0.0 && wi.z > 0.0;
    if is_above { warp::pdf_phong(mirrored(wo).dot(wi).min(1.0), exponent) } else { 0.0 }
}

/// Width on the scale of GGX: the Blinn-Phong exponent of the same lobe is about four times the Phong exponent, and
/// its width √(2 / (4 e + 2)).
///
/// Source: Walter et al., Microfacet Models for Refraction through Rough Surfaces, EGSR 2007, §5.2, for the width.
pub(super) fn width(exponent: f32) -> f32 {
    (1.0 / (2.0 * exponent + 1.0)).sqrt()
}

fn pdf_diffuse(wo: Vec3, wi: Vec3) -> f32 {
    if wo.z > 0.0 { warp::pdf_cosine_hemisphere(wi.z) } else { 0.0 }
}
