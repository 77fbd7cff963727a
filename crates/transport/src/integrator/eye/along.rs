//! What a path gathers all along its way through a homogeneous medium: the beams that it passes.

use super::asking;
use super::merges::{Beyond, Merges};
use super::{weight, within};
use crate::integrator::merging::{BEAM_SHARE, Beam, Passing, PhotonId, Photons};
use crate::walk::Stretch;
use hyaline_math::Ray;
use hyaline_scattering::Medium;
use hyaline_scattering::volume::BeamWeight;
use hyaline_spectrum::Spectrum;
use hyaline_world::World;

/// Chance that a path which has bounced gathers beams on its way at all: what it finds there counts for less, and costs as
/// much.
pub(super) const CHANCE_AFTER_BOUNCES: f32 = 0.25;

/// A path on its way, for the beams that it passes.
pub(super) struct Along<'a> {
    pub(super) photons: &'a Photons<'a>,
    pub(super) world: &'a World,
    /// What the path carries at the start of its way.
    pub(super) throughput: Spectrum,
    pub(super) merges: Merges,
    /// Scatterings of the path so far.
    pub(super) bounces: u32,
    /// Bounces that merged photons may have made, and one more.
    pub(super) bounces_left: u32,
}

impl Along<'_> {
    /// Light of the beams about a stretch, as it arrives where the path's way starts.
    ///
    /// - `note`: is told the light of every beam that is looked at; `rays` counts what is traced.
    pub(super) fn gather(
        &self,
        stretch: &Stretch<'_>,
        rays: &mut u64,
        mut note: impl FnMut(PhotonId, Spectrum),
    ) -> Spectrum {
        let Stretch { medium, id, ray, way, flown, left, .. } = stretch;
        let own_weight = BeamWeight::new(medium, self.throughput * *left, self.world.lanes);
        let scattered = medium.sigma_s * *left;
        let mut sum = Spectrum::ZERO;
        self.photons.landed.beams(ray, own_weight.length(*way, *flown), *id, |beam, passing| {
            if beam.bounces >= self.bounces_left {
                return;
            }
            let phase = medium.phase.value(-ray.direction, -beam.direction);
            let weight = self.weight_of(beam, passing, ray, medium, phase);
            let kernel = 1.0 / (self.kernel_width(stretch, beam, passing, rays) * passing.sin);
            let light = own_weight.at(passing.on_ray)
                * beam.weight.at(passing.on_beam)
                * beam.flux
                * scattered
                * (phase * weight * kernel);
            note(beam.id, light);
            sum += light;
        });
        sum
    }

    /// Width of the kernel across the ray and a beam, scene units.
    fn kernel_width(&self, stretch: &Stretch<'_>, beam: &Beam, passing: &Passing, rays: &mut u64) -> f32 {
        let Stretch { set, ray, way, .. } = stretch;
        let Passing { on_ray, radius, sin, .. } = *passing;
        if !within::is_near_an_end(on_ray, *way, radius) {
            return 2.0 * radius;
        }
        let across = ray.direction.cross(beam.direction) / sin;
        within::kernel_width(self.world, (ray.at(on_ray), radius), across, set, rays)
    }

    /// What merging a beam counts beside the other ways to make the path.
    ///
    /// - `phase`: value of the phase function between the two, sr⁻¹.
    pub(super) fn weight_of(
        &self,
        beam: &Beam,
        passing: &Passing,
        ray: &Ray,
        medium: &Medium,
        phase: f32,
    ) -> f32 {
        let sigma = medium.sigma_t().mean(self.world.lanes);
        let own = weight::of_beam(BEAM_SHARE, passing.radius, passing.sin, medium.ior, sigma);
        let behind = self.merges.behind(Beyond::Wide);
        let squares = beam.straight_from.map_or_else(
            || (beam.others + behind) * (phase / own) * (phase / own),
            |origin| {
                // No path hits a delta light: sampling it stands where drawing its direction would.
                let pdf = if origin.is_delta { 1.0 } else { phase };
                let chance = asking::expected(self.world, origin.light as usize, self.bounces);
                let at = ray.at(passing.on_ray);
                let sampled = chance * origin.sampled(self.world, at, -beam.direction) / pdf;
                let across = phase / pdf;
                let others = beam.others + sampled * sampled + behind * across * across;
                others * (pdf / own) * (pdf / own)
            },
        );
        weight::power(squares)
    }
}
