//! The vertex of a path at which photons would be merged that come the way that the path goes.
//!
//! It is the last wide vertex; before there is one, the first that is not polished. So every path has one such vertex at
//! most, and is merged in one way only.

use super::weight::{self, SideOfChain};
use super::{Eye, Path};
use crate::walk::{Vertex, VolumeVertex};
use hyaline_scattering::BsdfSample;

/// A receiver, seen from further along the path.
#[derive(Clone, Copy)]
pub(super) struct Receiver {
    /// Density of merging over that of hitting the light, but for the factor of the light.
    pub(super) ratio: f32,
    /// Polished and nearly polished vertices since.
    pub(super) chain: u32,
}

impl Eye<'_> {
    /// Keeps the receiver true where a direction has been drawn from a lobe that is not singular.
    ///
    /// - `ior_before`: index on the side that the path came from.
    /// - `radius`: gather radius at the vertex.
    pub(super) fn note_receiver(
        &self,
        path: &mut Path,
        vertex: &Vertex,
        scattered: &BsdfSample,
        is_wide: bool,
        ior_before: f32,
        radius: f32,
    ) {
        let Some(photons) = &self.photons else { return };
        let wo = -path.ray.direction;
        let ior = self.world.ior(path.set.active());
        let cos = scattered.wi.dot(vertex.hit.ng).abs();
        path.receiver = Some(match path.receiver {
            Some(receiver) if !is_wide => {
                let toward_light = SideOfChain { pdf: scattered.pdf, ior, cos };
                let toward_receiver = SideOfChain {
                    pdf: vertex.bsdf.pdf(scattered.wi, wo),
                    ior: ior_before,
                    cos: wo.dot(vertex.hit.ng).abs(),
                };
                let ratio = receiver.ratio * weight::across(toward_receiver, toward_light);
                Receiver { ratio, chain: receiver.chain + 1 }
            }
            _ => {
                let ratio = weight::at_receiver(photons.landed.sent, radius, ior, cos, scattered.pdf);
                Receiver { ratio, chain: 0 }
            }
        });
    }

    /// The factor of a place in a medium, but for the density of the direction.
    pub(super) fn volume_ratio(&self, place: &VolumeVertex, radius: f32, sent: f32) -> f32 {
        let medium = &self.world.media[place.medium.index()];
        let density = medium.density(place.p);
        let sigma = medium.sigma_t().mean(self.world.lanes) * density;
        weight::in_volume(sent, radius, medium.ior, sigma, 1.0)
    }
}
