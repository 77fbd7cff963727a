//! The photons of a pass where they have landed.

use crate::photon::tree::{PointTree, Region};
use hyaline_math::Vec3;
use hyaline_spectrum::Spectrum;

/// Photons in a leaf of the tree.
const LEAF: u32 = 16;

/// A photon that has landed.
#[derive(Clone, Copy, Debug)]
pub(in crate::integrator) struct LandedPhoton {
    /// The way it travelled, unit.
    pub(in crate::integrator) direction: Vec3,
    /// W, over all photons of its sender in the pass; in a medium what it scatters.
    pub(in crate::integrator) flux: Spectrum,
    /// Sum of the squares of the densities of the other ways to make its path, over that of merging here but for the
    /// factor of the receiver: those ways that the light's side of the path knows.
    pub(in crate::integrator) others: f32,
    /// Scatterings before it landed, singular ones not counted.
    pub(in crate::integrator) bounces: u32,
}

/// All photons of a pass.
pub(in crate::integrator) struct Landed {
    /// Those on surfaces.
    surface: PointTree<LandedPhoton>,
    /// Those in media.
    volume: PointTree<LandedPhoton>,
}

impl Landed {
    pub(super) fn new(surface: Vec<(Vec3, LandedPhoton)>, volume: Vec<(Vec3, LandedPhoton)>) -> Self {
        Self { surface: PointTree::build(surface, LEAF), volume: PointTree::build(volume, LEAF) }
    }

    /// Sum of the light of every photon on a surface within a radius.
    pub(in crate::integrator) fn surface(
        &self,
        p: Vec3,
        radius: f32,
        light: impl FnMut(&LandedPhoton) -> Spectrum,
    ) -> Spectrum {
        sum(&self.surface, p, radius, light)
    }

    /// Sum of the light of every photon in a medium within a radius.
    pub(in crate::integrator) fn volume(
        &self,
        p: Vec3,
        radius: f32,
        light: impl FnMut(&LandedPhoton) -> Spectrum,
    ) -> Spectrum {
        sum(&self.volume, p, radius, light)
    }
}

fn sum(
    tree: &PointTree<LandedPhoton>,
    center: Vec3,
    radius: f32,
    mut light: impl FnMut(&LandedPhoton) -> Spectrum,
) -> Spectrum {
    let region = Region { center, radius, disc: None };
    tree.fold_within(&region, Spectrum::ZERO, |sum, index, _| sum + light(tree.payload(index)))
}
