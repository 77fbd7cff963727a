//! A rough metal: microfacets, each a polished one.

use super::conductor::Conductor;
use super::local::LocalSample;
use hyaline_math::{Vec2, Vec3};
use hyaline_optics::{Ggx, reflect};
use hyaline_spectrum::Spectrum;

/// A rough metal, seen and lit from +z; f = F D G2 / (4 cos cos), single scattering.
///
/// Source: Walter et al., Microfacet Models for Refraction through Rough Surfaces, EGSR 2007, eq. 20.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughConductor {
    /// Each facet.
    pub smooth: Conductor,
    /// GGX width, `MIN_ALPHA`…1.
    pub alpha: f32,
}

impl RoughConductor {
    pub(super) fn sample(&self, wo: Vec3, u2: Vec2) -> Option<LocalSample> {
        if wo.z <= 0.0 {
            return None;
        }
        let ggx = Ggx::isotropic(self.alpha);
        let h = ggx.sample_visible_normal(wo, u2.to_array());
        let wi = reflect(wo, h).normalize();
        let cos_h = wo.dot(h);
        if wi.z <= 0.0 || cos_h <= 0.0 {
            return None;
        }
        let weight = self.smooth.reflectance(cos_h.min(1.0)) * (ggx.g2(wo, wi) / ggx.g1(wo));
        let pdf = ggx.pdf_visible_normal(wo, h) / (4.0 * cos_h);
        Some(LocalSample { wi, weight, pdf, is_delta: false, transmits: false })
    }

    pub(super) fn eval(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        let Some(h) = half_vector(wo, wi) else {
            return Spectrum::ZERO;
        };
        let ggx = Ggx::isotropic(self.alpha);
        let fresnel = self.smooth.reflectance(wo.dot(h).clamp(0.0, 1.0));
        fresnel * (ggx.d(h) * ggx.g2(wo, wi) / (4.0 * wo.z))
    }

    pub(super) fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        half_vector(wo, wi)
            .map_or(0.0, |h| Ggx::isotropic(self.alpha).pdf_visible_normal(wo, h) / (4.0 * wo.dot(h)))
    }
}

/// Normal of the facet that mirrors `wo` to `wi`; `None` where one of them is not above the surface.
pub(super) fn half_vector(wo: Vec3, wi: Vec3) -> Option<Vec3> {
    if wo.z > 0.0 && wi.z > 0.0 { (wo + wi).try_normalize() } else { None }
}
