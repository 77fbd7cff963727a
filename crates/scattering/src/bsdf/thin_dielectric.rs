//! A pane too thin to bend or to measure: all reflections between its two faces at once.

use super::local::{LocalBranch, mirrored};
use hyaline_math::Vec3;
use hyaline_optics::fresnel_dielectric;
use hyaline_spectrum::Spectrum;

/// A thin pane with the same medium on both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThinDielectric {
    /// Index of the pane over that of its surroundings, > 0.
    pub eta: f32,
    /// Factor on the transmitted light, 0…1.
    pub tint: Spectrum,
}

impl ThinDielectric {
    pub(super) fn branches(&self, wo: Vec3) -> [Option<LocalBranch>; 2] {
        let reflected = self.reflectance(wo.z.abs().min(1.0));
        let reflection =
            LocalBranch { wi: mirrored(wo), fraction: reflected, tint: Spectrum::ONE, transmits: false };
        let transmission =
            LocalBranch { wi: -wo, fraction: 1.0 - reflected, tint: self.tint, transmits: true };
        [Some(reflection), Some(transmission)]
    }

    /// Fraction transmitted at the cosine `cos`, 0…1.
    pub(super) fn transmittance(&self, cos: f32) -> Spectrum {
        self.tint * (1.0 - self.reflectance(cos))
    }

    fn reflectance(&self, cos: f32) -> f32 {
        let once = fresnel_dielectric(cos, self.eta);
        // The sum of R + T²R + T²R³ + ... over the bounces within the pane, T = 1 - R: the geometric series of a
        // lossless pane, whose transmittance (1 - R) / (1 + R) is the rest.
        2.0 * once / (1.0 + once)
    }
}
