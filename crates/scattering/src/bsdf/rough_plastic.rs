//! A matte base under a rough clear coat: varnish, eggshell paint.

use super::coat::RoughCoat;
use super::local::LocalSample;
use super::rough_conductor::half_vector;
use hyaline_math::{Vec2, Vec3};
use hyaline_optics::{Ggx, fresnel_dielectric, reflect};
use hyaline_sampling::warp;
use hyaline_spectrum::Spectrum;

/// A matte base under a rough clear coat, seen and lit from +z: f = F D G2 / (4 cos cos) + base T(wo) T(wi) / π, single
/// scattering in the coat.
///
/// Source: Walter et al., Microfacet Models for Refraction through Rough Surfaces, EGSR 2007, eq. 20, for the coat; for
/// the base see [`super::coat`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughPlastic {
    eta: f32,
    alpha: f32,
    pub(super) specular: Spectrum,
    /// Factor of the base; see `base_factor`.
    pub(super) base: Spectrum,
    coat: RoughCoat,
}

impl RoughPlastic {
    /// - `eta`, `diffuse`, `specular`, `nonlinear`: as for [`super::Plastic::new`].
    /// - `alpha`: GGX width, `MIN_ALPHA`…1; `coat`: that of this `eta` and width.
    pub fn new(
        eta: f32,
        alpha: f32,
        coat: RoughCoat,
        diffuse: Spectrum,
        specular: Spectrum,
        nonlinear: bool,
    ) -> Self {
        Self { eta, alpha, specular, base: coat.base_factor(diffuse, eta, nonlinear), coat }
    }

    pub(super) fn sample(&self, wo: Vec3, u_lobe: f32, u2: Vec2, lanes: usize) -> Option<LocalSample> {
        let wi = if u_lobe < self.chance_of_coat(wo, lanes)? {
            let h = Ggx::isotropic(self.alpha).sample_visible_normal(wo, u2.to_array());
            reflect(wo, h).normalize()
        } else {
            warp::sample_cosine_hemisphere(u2)
        };
        let pdf = self.pdf(wo, wi, lanes);
        let weight = self.eval(wo, wi) / pdf;
        (pdf > 0.0).then_some(LocalSample { wi, weight, pdf, is_delta: false, transmits: false })
    }

    pub(super) fn eval(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        let Some(h) = half_vector(wo, wi) else {
            return Spectrum::ZERO;
        };
        let ggx = Ggx::isotropic(self.alpha);
        let fresnel = fresnel_dielectric(wo.dot(h).clamp(0.0, 1.0), self.eta);
        let through = self.coat.transmittance(wo.z) * self.coat.transmittance(wi.z);
        self.specular * (fresnel * ggx.d(h) * ggx.g2(wo, wi) / (4.0 * wo.z))
            + self.base * (through * warp::pdf_cosine_hemisphere(wi.z))
    }

    pub(super) fn pdf(&self, wo: Vec3, wi: Vec3, lanes: usize) -> f32 {
        let (Some(h), Some(chance)) = (half_vector(wo, wi), self.chance_of_coat(wo, lanes)) else {
            return 0.0;
        };
        let coat = Ggx::isotropic(self.alpha).pdf_visible_normal(wo, h) / (4.0 * wo.dot(h));
        chance * coat + (1.0 - chance) * warp::pdf_cosine_hemisphere(wi.z)
    }

    /// GGX width of the coat.
    pub(super) fn alpha(&self) -> f32 {
        self.alpha
    }

    /// Whether there is a base below the coat.
    pub(super) fn has_base(&self) -> bool {
        !self.base.is_zero()
    }

    pub(super) fn albedo_estimate(&self) -> Spectrum {
        let through = self.coat.transmittance(1.0);
        // Evenly spread light gets through about as light at 60 degrees does.
        self.base * (through * self.coat.transmittance(0.5)) + self.specular * (1.0 - through)
    }

    /// Probability of the coat's lobe, about in proportion to the power; `None` where nothing is reflected.
    fn chance_of_coat(&self, wo: Vec3, lanes: usize) -> Option<f32> {
        if wo.z <= 0.0 {
            return None;
        }
        let through = self.coat.transmittance(wo.z);
        let coat = self.specular.mean(lanes) * (1.0 - through);
        let base = self.base.mean(lanes) * through;
        (coat + base > 0.0).then(|| coat / (coat + base))
    }
}
