//! Nothing but a change of medium: light goes straight on, undiminished.

use super::local::LocalBranch;
use hyaline_math::Vec3;
use hyaline_spectrum::Spectrum;

/// A surface that light does not notice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PassThrough;

impl PassThrough {
    pub(super) fn branches(&self, wo: Vec3) -> [Option<LocalBranch>; 2] {
        [None, Some(LocalBranch { wi: -wo, fraction: 1.0, tint: Spectrum::ONE, transmits: true })]
    }
}
