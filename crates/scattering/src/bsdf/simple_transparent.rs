//! Suffern's simple transparency: the same fractions are reflected and refracted at every angle.

use super::local::{LocalBranch, eta_seen_from, mirrored, normal_towards};
use hyaline_math::Vec3;
use hyaline_optics::refract;
use hyaline_spectrum::Spectrum;

/// A boundary that reflects and refracts constant fractions; under total internal reflection it reflects everything.
///
/// Source: Suffern, Ray Tracing from the Ground Up, 2007, ch. 27.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimpleTransparent {
    /// Fraction reflected, 0…1.
    pub k_r: f32,
    /// Fraction transmitted, 0…1.
    pub k_t: f32,
    /// Index at -z over index at +z, > 0.
    pub eta: f32,
}

impl SimpleTransparent {
    /// Reflection first, then refraction.
    pub(super) fn branches(&self, wo: Vec3) -> [Option<LocalBranch>; 2] {
        let refracted = refract(wo, normal_towards(wo), eta_seen_from(wo, self.eta));
        let k_r = if refracted.is_some() { self.k_r } else { 1.0 };
        let reflection =
            LocalBranch { wi: mirrored(wo), fraction: k_r, tint: Spectrum::ONE, transmits: false };
        let refraction =
            refracted.map(|wi| LocalBranch { wi, fraction: self.k_t, tint: Spectrum::ONE, transmits: true });
        [Some(reflection), refraction]
    }
}
