//! The volume map: photons where media scattered them, one tree for each medium, so that none is looked up from another
//! medium however near it lies.
//!
//! A photon holds the power that leaves its collision, so that an estimate is the light that a unit of path scatters
//! toward the eye, σ_s ∫ p L dω; who wants ∫ p L dω divides by σ_s.
//! Source: Jensen & Christensen, Efficient simulation of light transport in scenes with participating media using photon
//! maps, SIGGRAPH 1998.

use super::clip::Clip;
use super::gather::{Estimate, Gathered, PhotonMap};
use super::record::Photon;
use super::tree::Nearest;
use crate::stats::Stats;
use hyaline_math::Vec3;
use hyaline_sampling::Sampler;
use hyaline_scattering::{MediumId, MediumSet};
use hyaline_world::World;

/// Photons in media.
#[derive(Clone, Debug, Default)]
pub struct VolumeMaps {
    /// By index of the medium; empty where it holds no photon.
    maps: Vec<Option<VolumeMap>>,
}

/// Photons in one medium.
#[derive(Clone, Debug)]
pub struct VolumeMap {
    /// The photons.
    pub map: PhotonMap,
    /// How they are looked up.
    pub estimate: Estimate,
}

impl VolumeMaps {
    /// Sorts photons by medium and builds a map of each; `estimate` says how it is looked up.
    pub fn new(
        photons: &[(MediumId, Photon)],
        leaf_size: u32,
        estimate: impl Fn(&PhotonMap) -> Estimate,
    ) -> Self {
        let count = photons.iter().map(|(medium, _)| medium.index() + 1).max().unwrap_or(0);
        let mut sorted = vec![Vec::new(); count];
        for (medium, photon) in photons {
            sorted[medium.index()].push(*photon);
        }
        let build = |photons: Vec<Photon>| {
            (!photons.is_empty()).then(|| {
                let map = PhotonMap::from_photons(&photons, leaf_size);
                VolumeMap { estimate: estimate(&map), map }
            })
        };
        Self { maps: sorted.into_iter().map(build).collect() }
    }

    /// The map of a medium; `None` where it holds no photon.
    pub fn of(&self, medium: MediumId) -> Option<&VolumeMap> {
        self.maps.get(medium.index())?.as_ref()
    }

    /// All maps that there are.
    pub fn iter(&self) -> impl Iterator<Item = &VolumeMap> {
        self.maps.iter().flatten()
    }

    /// Light that a unit of path scatters at `p` toward `wo`, by the photons of the medium there: σ_s ∫ p L dω, W sr⁻¹
    /// m⁻³. `None` where the medium holds no photon.
    ///
    /// - `wo`: unit, toward the eye.
    /// - `set`: what `p` is in.
    pub fn scattered(
        &self,
        world: &World,
        p: Vec3,
        wo: Vec3,
        set: &MediumSet,
        sampler: &mut Sampler,
        (scratch, stats): (&mut Nearest, &mut Stats),
    ) -> Option<Gathered> {
        let VolumeMap { map, estimate } = self.of(set.active())?;
        let phase = &world.media[set.active().index()].phase;
        let turn = (sampler.next_2d(), sampler.next_1d());
        let clip = |radius| Clip::of_medium(world, (p, radius), set, estimate.kernel, turn, stats);
        Some(estimate.volume(map, p, |direction| phase.value(wo, -direction), clip, scratch))
    }
}
