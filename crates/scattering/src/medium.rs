//! A medium: everything about a volume, and nothing about its boundary.

use crate::phase::Phase;
use crate::volume::Grid;
use hyaline_math::Vec3;
use hyaline_spectrum::Spectrum;
use std::sync::Arc;

/// Index of a medium in the world's list of media.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MediumId(pub u32);

impl MediumId {
    /// The index as a list's.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A medium: the same everywhere, or as dense as a grid says.
#[derive(Clone, Debug, PartialEq)]
pub struct Medium {
    /// Index of refraction, > 0; 1 is vacuum, and air is taken for it.
    pub ior: f32,
    /// Absorption coefficient where the density is 1, 1 / scene unit, ≥ 0.
    pub sigma_a: Spectrum,
    /// Scattering coefficient where the density is 1, 1 / scene unit, ≥ 0.
    pub sigma_s: Spectrum,
    /// Where scattered light goes.
    pub phase: Phase,
    /// Light that it sends out by itself where the density is 1, W sr⁻¹ m⁻³.
    pub emission: Spectrum,
    /// Where it is how dense; `None` is density 1 everywhere.
    pub grid: Option<Arc<Grid>>,
}

impl Medium {
    /// Vacuum, as which air is rendered.
    pub const VACUUM: Self = Self::clear(1.0);

    /// A medium that neither absorbs nor scatters.
    ///
    /// - `ior`: index of refraction, > 0.
    pub const fn clear(ior: f32) -> Self {
        Self {
            ior,
            sigma_a: Spectrum::ZERO,
            sigma_s: Spectrum::ZERO,
            phase: Phase::Isotropic,
            emission: Spectrum::ZERO,
            grid: None,
        }
    }

    /// Extinction coefficient where the density is 1, 1 / scene unit.
    pub fn sigma_t(&self) -> Spectrum {
        self.sigma_a + self.sigma_s
    }

    /// Whether light passes unchanged.
    pub fn is_clear(&self) -> bool {
        self.sigma_a.is_zero() && self.sigma_s.is_zero()
    }

    /// Density at a point of the world, ≥ 0.
    pub fn density(&self, p: Vec3) -> f32 {
        self.grid.as_ref().map_or(1.0, |grid| grid.density(p))
    }

    /// Scattering coefficient at a point of the world where the density is known, 1 / scene unit.
    pub fn sigma_s_at(&self, p: Vec3, density: f32) -> Spectrum {
        match self.grid.as_ref().and_then(|grid| grid.albedo(p)) {
            Some(albedo) => self.sigma_t() * albedo * density,
            None => self.sigma_s * density,
        }
    }

    /// Whether it sends out light.
    pub fn shines(&self) -> bool {
        !self.emission.is_zero()
    }

    /// Whether it sends light elsewhere.
    pub fn scatters(&self) -> bool {
        !self.sigma_s.is_zero() || self.grid.as_ref().is_some_and(|grid| grid.has_albedo())
    }

    /// Fraction of light, per lane, that a homogeneous medium neither absorbs nor scatters; see
    /// [`crate::volume::transmittance`] for those with a grid.
    ///
    /// - `distance`: length of the way, scene units, ≥ 0; may be infinite.
    pub fn transmittance(&self, distance: f32) -> Spectrum {
        debug_assert!(self.grid.is_none(), "a grid's transmittance depends on the way");
        if self.is_clear() {
            return Spectrum::ONE;
        }
        self.sigma_t().map(|sigma_t| hyaline_optics::transmittance(sigma_t, distance))
    }

    /// Whether a boundary to `other` neither bends nor reflects.
    pub fn is_index_matched(&self, other: &Self) -> bool {
        self.ior == other.ior
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transmittance_follows_extinction() {
        let medium = Medium {
            sigma_a: Spectrum::from_lanes([1.0, 0.0, 0.5, 0.0]),
            sigma_s: Spectrum::from_lanes([0.0, 2.0, 0.5, 0.0]),
            ..Medium::clear(1.333)
        };
        let got = medium.transmittance(0.75).to_lanes();
        for (got, expected) in got.into_iter().zip([0.472_366_55, 0.223_130_16, 0.472_366_55, 1.0]) {
            assert!((got - expected).abs() < 1e-6, "{got} is not {expected}");
        }
        assert_eq!(medium.transmittance(0.0), Spectrum::ONE);
    }

    #[test]
    fn endless_ways_are_dark_only_where_something_is_extinguished() {
        let medium = Medium { sigma_a: Spectrum::from_lanes([1.0, 0.0, 0.0, 0.0]), ..Medium::VACUUM };
        assert_eq!(medium.transmittance(f32::INFINITY).to_lanes(), [0.0, 1.0, 1.0, 1.0]);
        assert_eq!(Medium::VACUUM.transmittance(f32::INFINITY), Spectrum::ONE);
    }
}
