//! Suffern's perfect specular reflector: the mirror direction, and the same fraction at every angle.

use super::local::{LocalBranch, mirrored};
use hyaline_math::Vec3;
use hyaline_spectrum::Spectrum;

/// A mirror of constant reflectance, seen from +z.
///
/// Source: Suffern, Ray Tracing from the Ground Up, 2007, ch. 24.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mirror {
    /// Fraction of light reflected, 0…1.
    pub reflectance: Spectrum,
}

impl Mirror {
    pub(super) fn branches(&self, wo: Vec3) -> [Option<LocalBranch>; 2] {
        let branch =
            LocalBranch { wi: mirrored(wo), fraction: 1.0, tint: self.reflectance, transmits: false };
        [(wo.z >= 0.0).then_some(branch), None]
    }
}
