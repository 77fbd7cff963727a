//! A rough boundary of two clear media: microfacets, each a polished one.

use super::dielectric::Dielectric;
use super::local::{LocalSample, eta_seen_from};
use hyaline_math::{Vec2, Vec3};
use hyaline_optics::{Ggx, fresnel_dielectric, reflect, refract};
use hyaline_spectrum::Spectrum;

/// A rough boundary of two clear media, single scattering; ground glass.
///
/// Source: Walter et al., Microfacet Models for Refraction through Rough Surfaces, EGSR 2007, eq. 20 and 21; there for
/// radiance, here without its n² factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughDielectric {
    /// Each facet; its index is not 1.
    pub smooth: Dielectric,
    /// GGX width, `MIN_ALPHA`…1.
    pub alpha: f32,
}

/// A facet that takes `wo` to `wi`, and what it does to densities.
struct Facet {
    h: Vec3,
    /// Solid angle of facet normals per solid angle of `wi`. [Walter 2007, eq. 14 and 17]
    jacobian: f32,
    /// Fraction reflected.
    fresnel: f32,
}

impl RoughDielectric {
    pub(super) fn sample(&self, wo: Vec3, u_lobe: f32, u2: Vec2, lanes: usize) -> Option<LocalSample> {
        let eta = eta_seen_from(wo, self.smooth.eta);
        let up = upright(wo, wo);
        let ggx = Ggx::isotropic(self.alpha);
        let h = ggx.sample_visible_normal(up, u2.to_array());
        let cos_h = up.dot(h);
        if up.z == 0.0 || cos_h <= 0.0 {
            return None;
        }
        let fresnel = fresnel_dielectric(cos_h.min(1.0), eta);
        let chance = self.chance_of_reflection(fresnel, lanes)?;
        let transmits = u_lobe >= chance;
        let wi = if transmits { refract(up, h, eta)? } else { reflect(up, h).normalize() };
        if wi.z == 0.0 || transmits != (wi.z < 0.0) {
            return None;
        }
        let facet = Facet { h, jacobian: jacobian(up, wi, h, eta), fresnel };
        let (share, chance) = self.share(&facet, chance, transmits);
        let weight = share / chance * (ggx.g2(up, wi) / ggx.g1(up));
        let pdf = chance * ggx.pdf_visible_normal(up, h) * facet.jacobian;
        Some(LocalSample { wi: upright(wo, wi), weight, pdf, is_delta: false, transmits })
    }

    pub(super) fn eval(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        let (up, wi, eta) = (upright(wo, wo), upright(wo, wi), eta_seen_from(wo, self.smooth.eta));
        let Some(facet) = facet(up, wi, eta) else {
            return Spectrum::ZERO;
        };
        let ggx = Ggx::isotropic(self.alpha);
        let (share, _) = self.share(&facet, 0.0, wi.z < 0.0);
        share * (ggx.d(facet.h) * ggx.g2(up, wi) * up.dot(facet.h) * facet.jacobian / up.z)
    }

    pub(super) fn pdf(&self, wo: Vec3, wi: Vec3, lanes: usize) -> f32 {
        let (up, wi, eta) = (upright(wo, wo), upright(wo, wi), eta_seen_from(wo, self.smooth.eta));
        let Some(facet) = facet(up, wi, eta) else {
            return 0.0;
        };
        let Some(chance) = self.chance_of_reflection(facet.fresnel, lanes) else {
            return 0.0;
        };
        let (_, chance) = self.share(&facet, chance, wi.z < 0.0);
        chance * Ggx::isotropic(self.alpha).pdf_visible_normal(up, facet.h) * facet.jacobian
    }

    /// Probability with which a facet reflects; `None` where it does nothing.
    fn chance_of_reflection(&self, fresnel: f32, lanes: usize) -> Option<f32> {
        let reflected = self.smooth.tint_r.mean(lanes) * fresnel;
        let transmitted = self.smooth.tint_t.mean(lanes) * (1.0 - fresnel);
        let total = reflected + transmitted;
        (total > 0.0).then(|| reflected / total)
    }

    /// Fraction of the power that takes the branch, and the branch's probability.
    fn share(&self, facet: &Facet, chance_of_reflection: f32, transmits: bool) -> (Spectrum, f32) {
        if transmits {
            (self.smooth.tint_t * (1.0 - facet.fresnel), 1.0 - chance_of_reflection)
        } else {
            (self.smooth.tint_r * facet.fresnel, chance_of_reflection)
        }
    }
}

/// `w` in the frame whose z axis is on the side of `wo`; its own inverse, because GGX looks alike from both sides.
fn upright(wo: Vec3, w: Vec3) -> Vec3 {
    if wo.z >= 0.0 { w } else { Vec3::new(w.x, w.y, -w.z) }
}

/// The facet that takes `wo` (above) to `wi`, if one can.
fn facet(wo: Vec3, wi: Vec3, eta: f32) -> Option<Facet> {
    let transmits = wi.z < 0.0;
    // [Walter 2007, eq. 13 and 16], pointing up.
    let h = if transmits { wo + wi * eta } else { wo + wi }.try_normalize()?;
    let h = if h.z < 0.0 { -h } else { h };
    let (cos_o, cos_i) = (wo.dot(h), wi.dot(h));
    // Both directions must see the side of the facet that faces them.
    if wo.z <= 0.0 || cos_o <= 0.0 || transmits != (cos_i < 0.0) {
        return None;
    }
    Some(Facet { h, jacobian: jacobian(wo, wi, h, eta), fresnel: fresnel_dielectric(cos_o.min(1.0), eta) })
}

fn jacobian(wo: Vec3, wi: Vec3, h: Vec3, eta: f32) -> f32 {
    let (cos_o, cos_i) = (wo.dot(h), wi.dot(h));
    if wi.z < 0.0 {
        let denominator = cos_o + eta * cos_i;
        eta * eta * cos_i.abs() / (denominator * denominator)
    } else {
        0.25 / cos_o
    }
}
