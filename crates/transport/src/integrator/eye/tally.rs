//! What paths note of the photons that they merge.

use crate::integrator::merging::PhotonId;
use hyaline_spectrum::Spectrum;

/// A photon that a path has merged.
#[derive(Clone, Copy, Debug)]
pub(in crate::integrator) struct Merged {
    pub(in crate::integrator) photon: PhotonId,
    /// What it brings to the picture.
    pub(in crate::integrator) light: Spectrum,
}

/// Counts photons, and keeps them for those who ask.
#[derive(Default)]
pub(in crate::integrator) struct Tally<'a> {
    /// Photons that have been looked at.
    pub(in crate::integrator) merges: u64,
    /// Receives those that brought light.
    pub(in crate::integrator) found: Option<&'a mut Vec<Merged>>,
}

impl Tally<'_> {
    /// Notes a photon that has been looked at.
    ///
    /// - `light`: what it brings to the picture.
    pub(super) fn note(&mut self, photon: PhotonId, light: Spectrum) {
        self.merges += 1;
        if let Some(found) = &mut self.found
            && !light.is_zero()
        {
            found.push(Merged { photon, light });
        }
    }
}
