//! The photons of a pass where they have landed.

use super::beams::{Beam, Beams, Passing};
use crate::integrator::eye::radius::GatherRadius;
use crate::integrator::eye::reach::RoughNormal;
use crate::photon::tree::{PointTree, Region};
use hyaline_math::{Ray, Vec3};
use hyaline_scattering::MediumId;
use hyaline_spectrum::Spectrum;

/// Photons in a leaf of the tree.
const LEAF: u32 = 16;

/// Which photon of a pass it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::integrator) struct PhotonId(u32);

/// The bit that tells the senders apart.
const AIMED: u32 = 1 << 31;

impl PhotonId {
    pub(super) fn new(is_aimed: bool, number: u32) -> Self {
        Self(number | if is_aimed { AIMED } else { 0 })
    }

    /// Whether the aimed sender has sent it.
    pub(in crate::integrator) fn is_aimed(self) -> bool {
        self.0 & AIMED != 0
    }

    /// Its number among those of its sender.
    pub(in crate::integrator) fn number(self) -> u32 {
        self.0 & !AIMED
    }
}

/// A photon that has landed.
#[derive(Clone, Copy, Debug)]
pub(in crate::integrator) struct LandedPhoton {
    /// The way it travelled, unit.
    pub(in crate::integrator) direction: Vec3,
    pub(in crate::integrator) landing: Landing,
    /// W, over all photons of its sender in the pass; in a medium times the way that it goes before it is scattered there,
    /// scene units.
    pub(in crate::integrator) flux: Spectrum,
    /// Sum of the squares of the densities of the other ways to make its path, over that of merging here but for the
    /// factor of the receiver: those ways that the light's side of the path knows.
    pub(in crate::integrator) others: f32,
    /// Scatterings before it landed, singular ones not counted.
    pub(in crate::integrator) bounces: u32,
    pub(in crate::integrator) id: PhotonId,
}

/// What a photon has landed on, or in.
#[derive(Clone, Copy, Debug)]
pub(in crate::integrator) enum Landing {
    Surface {
        /// Its geometric normal.
        n: RoughNormal,
        /// What lies in front of it, where the photon came from.
        medium: MediumId,
    },
    Volume {
        /// Density of the medium, which has a grid.
        density: f32,
    },
}

/// Photons that have landed at points.
#[derive(Default)]
pub(super) struct Points {
    pub(super) caustic: Vec<(Vec3, LandedPhoton)>,
    pub(super) indirect: Vec<(Vec3, LandedPhoton)>,
    pub(super) volume: Vec<(Vec3, LandedPhoton)>,
}

impl Points {
    pub(super) fn extend(&mut self, other: Self) {
        self.caustic.extend(other.caustic);
        self.indirect.extend(other.indirect);
        self.volume.extend(other.volume);
    }
}

/// All photons of a pass.
pub(in crate::integrator) struct Landed {
    /// Those on surfaces that have come over polished and nearly polished ones alone.
    caustic: PointTree<LandedPhoton>,
    /// Those on surfaces that have been scattered widely on their way.
    indirect: PointTree<LandedPhoton>,
    /// Those in media with a grid.
    volume: PointTree<LandedPhoton>,
    /// Those in homogeneous media.
    beams: Beams,
}

impl Landed {
    pub(super) fn new(points: Points, beams: Vec<Beam>, radius: GatherRadius) -> Self {
        let Points { caustic, indirect, volume } = points;
        let [caustic, indirect, volume] =
            [caustic, indirect, volume].map(|photons| PointTree::build(photons, LEAF));
        Self { caustic, indirect, volume, beams: Beams::new(beams, radius) }
    }

    /// Visits every beam of a medium that a ray of some length passes within the radius.
    pub(in crate::integrator) fn beams(
        &self,
        ray: &Ray,
        length: f32,
        medium: MediumId,
        visit: impl FnMut(&Beam, &Passing),
    ) {
        self.beams.passed(ray, length, medium, visit);
    }

    /// Sum of the light of every photon on a surface within a radius: of those that have been scattered widely on their way,
    /// or of those that have come over polished and nearly polished surfaces alone.
    ///
    /// - `light`: of a photon at a place.
    pub(in crate::integrator) fn on_surface(
        &self,
        is_indirect: bool,
        p: Vec3,
        radius: f32,
        light: impl FnMut(Vec3, &LandedPhoton) -> Spectrum,
    ) -> Spectrum {
        sum(if is_indirect { &self.indirect } else { &self.caustic }, p, radius, light)
    }

    /// Sum of the light of every photon in a medium with a grid within a radius.
    pub(in crate::integrator) fn volume(
        &self,
        p: Vec3,
        radius: f32,
        mut light: impl FnMut(&LandedPhoton) -> Spectrum,
    ) -> Spectrum {
        sum(&self.volume, p, radius, |_, photon| light(photon))
    }
}

fn sum(
    tree: &PointTree<LandedPhoton>,
    center: Vec3,
    radius: f32,
    mut light: impl FnMut(Vec3, &LandedPhoton) -> Spectrum,
) -> Spectrum {
    let region = Region { center, radius, disc: None };
    tree.fold_within(&region, Spectrum::ZERO, |sum, index, _| {
        sum + light(tree.position(index), tree.payload(index))
    })
}
