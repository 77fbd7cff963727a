//! A polished metal: the mirror direction, weighted by Fresnel's equations with the complex index.

use super::local::{LocalBranch, mirrored};
use hyaline_math::Vec3;
use hyaline_optics::fresnel_conductor;
use hyaline_spectrum::Spectrum;

/// A polished metal, seen from +z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductor {
    /// Index of refraction over the index at +z, > 0.
    pub eta: Spectrum,
    /// Extinction index over the index at +z, ≥ 0.
    pub k: Spectrum,
    /// Factor on the reflected light, 0…1; 1 is physical.
    pub tint: Spectrum,
}

impl Conductor {
    /// Fraction of light reflected where it arrives at the cosine `cos_i`, 0…1, to the normal.
    pub(super) fn reflectance(&self, cos_i: f32) -> Spectrum {
        let (eta, k) = (self.eta.to_lanes(), self.k.to_lanes());
        // Lanes beyond the count have no index.
        let lane = |i: usize| if eta[i] > 0.0 { fresnel_conductor(cos_i, eta[i], k[i]) } else { 0.0 };
        let fresnel = std::array::from_fn(lane);
        Spectrum::from_lanes(fresnel) * self.tint
    }

    pub(super) fn branches(&self, wo: Vec3) -> [Option<LocalBranch>; 2] {
        if wo.z < 0.0 {
            return [None, None];
        }
        let tint = self.reflectance(wo.z.min(1.0));
        [Some(LocalBranch { wi: mirrored(wo), fraction: 1.0, tint, transmits: false }), None]
    }
}
