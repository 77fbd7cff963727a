//! A flight through a homogeneous medium, seen as a beam: what it carries at every place of its way, not only where it
//! scatters.
//!
//! Over the first mean free path the beam goes on whether or not the flight has scattered, and dims as light does (a
//! long beam); beyond, it ends where the flight scatters, and carries there what a flight that has come so far does (a
//! short beam). Its mean is the transmitted light all along.
//!
//! Source: Jarosz, Nowrouzezahrai, Thomas, Sloan & Zwicker, Progressive photon beams, ACM TOG 30(6), 2011, §5.

use super::flight::{shares_of, weighted};
use crate::Medium;
use hyaline_spectrum::Spectrum;

/// Mean free paths after which a beam ends in any case, where some lanes are not dimmed at all.
const LONGEST: f32 = 1e3;

/// What a beam carries, as a fraction of what it started with.
#[derive(Clone, Copy, Debug)]
pub struct BeamWeight {
    sigma_t: Spectrum,
    shares: [f32; 4],
    is_gray: bool,
    /// One mean free path, scene units.
    long: f32,
}

impl BeamWeight {
    /// - `medium`: homogeneous, and scatters.
    /// - `carried`: what the flight carries at its start; its lanes decide where it scatters, see [`super::Flyer`].
    pub fn new(medium: &Medium, carried: Spectrum, lanes: usize) -> Self {
        let sigma_t = medium.sigma_t();
        let by_lane = sigma_t.to_lanes();
        let is_gray = by_lane[..lanes].iter().all(|&sigma| sigma == by_lane[0]);
        Self { sigma_t, shares: shares_of(carried, lanes), is_gray, long: 1.0 / sigma_t.mean(lanes) }
    }

    /// Length of the beam of a flight.
    ///
    /// - `way`: to the medium's boundary; may be infinite.
    /// - `flown`: to where it scatters, or `way`.
    pub fn length(&self, way: f32, flown: f32) -> f32 {
        way.min(flown.max(self.long)).min(self.long * LONGEST)
    }

    /// The fraction at a distance from its start, within its length; per lane, may be above 1.
    pub fn at(&self, distance: f32) -> Spectrum {
        if distance >= self.long && self.is_gray {
            return Spectrum::ONE;
        }
        if self.is_gray {
            return Spectrum::ONE * hyaline_optics::transmittance(self.sigma_t.to_lanes()[0], distance);
        }
        let left = self.sigma_t.map(|sigma| hyaline_optics::transmittance(sigma, distance));
        if distance < self.long {
            return left;
        }
        let probability = weighted(&self.shares, left);
        if probability > 0.0 { left / probability } else { Spectrum::ZERO }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Flyer;
    use super::*;
    use hyaline_math::{Ray, Vec2, Vec3};
    use hyaline_sampling::Rng;

    #[test]
    fn the_mean_of_beams_is_the_transmittance() {
        let medium = Medium {
            sigma_a: Spectrum::from_lanes([0.2, 0.1, 0.4, 0.0]),
            sigma_s: Spectrum::from_lanes([1.0, 0.5, 2.0, 0.0]),
            ..Medium::VACUUM
        };
        let carried = Spectrum::from_lanes([1.0, 2.0, 0.5, 0.0]);
        let weight = BeamWeight::new(&medium, carried, 3);
        let mut rng = Rng::new(1, 0);
        let ray = Ray::new(Vec3::ZERO, Vec3::X);
        let places = [0.3, 1.0, 2.0];
        let mut sums = [Spectrum::ZERO; 3];
        let count = 400_000;
        for _ in 0..count {
            let u = Vec2::new(rng.uniform(), rng.uniform());
            let flight = Flyer { throughput: carried, lanes: 3, u }.fly(&medium, &ray, 5.0);
            let length = weight.length(5.0, flight.scatters_at.unwrap_or(5.0));
            for (sum, place) in sums.iter_mut().zip(places) {
                if place < length {
                    *sum += weight.at(place);
                }
            }
        }
        for (sum, place) in sums.into_iter().zip(places) {
            let (got, expected) = ((sum / count as f32).to_lanes(), medium.transmittance(place).to_lanes());
            for lane in 0..3 {
                assert!((got[lane] / expected[lane] - 1.0).abs() < 0.02, "{place}: {got:?} {expected:?}");
            }
        }
    }
}
