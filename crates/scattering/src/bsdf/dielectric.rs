//! A polished boundary of two clear media: reflection and refraction in the proportion of Fresnel's equations.

use super::local::{LocalBranch, eta_seen_from, mirrored, normal_towards};
use hyaline_math::Vec3;
use hyaline_optics::{fresnel_dielectric, refract};
use hyaline_spectrum::Spectrum;

/// A polished boundary of two clear media.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dielectric {
    /// Index at -z over index at +z, > 0.
    pub eta: f32,
    /// Factor on the reflected light, 0…1; 1 is physical.
    pub tint_r: Spectrum,
    /// Factor on the transmitted light, 0…1; 1 is physical.
    pub tint_t: Spectrum,
}

impl Dielectric {
    /// Reflection first, then refraction.
    pub(super) fn branches(&self, wo: Vec3) -> [Option<LocalBranch>; 2] {
        let eta = eta_seen_from(wo, self.eta);
        let reflected = fresnel_dielectric(wo.z.abs().min(1.0), eta);
        let refracted = refract(wo, normal_towards(wo), eta);
        let reflection =
            LocalBranch { wi: mirrored(wo), fraction: reflected, tint: self.tint_r, transmits: false };
        let refraction = refracted.map(|wi| LocalBranch {
            wi,
            fraction: 1.0 - reflected,
            tint: self.tint_t,
            transmits: true,
        });
        [Some(reflection), refraction]
    }
}
