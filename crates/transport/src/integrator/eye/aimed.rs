//! Light that reaches a wide vertex over polished surfaces, asked for as light sampling asks for what comes straight.
//!
//! Beside the path itself a second one leaves each wide vertex, in a direction drawn from the cones of `aim`. It goes
//! over polished surfaces alone and brings the light that it comes to; anything else ends it. The path may come to the same
//! light by itself, so the two share it by MIS: each counts by the square of its density toward the first polished
//! surface (power heuristic), as all that follows is the same for both.

use super::aim::Cones;
use super::onward::Onward;
use super::{Draws, Eye, Path, Seen};
use crate::in_volume;
use crate::walk::{Event, Flown, Vertex, VolumeVertex};
use hyaline_math::Vec3;
use hyaline_scattering::{BsdfSample, Transport};
use hyaline_spectrum::Spectrum;

impl Eye<'_> {
    /// Aimed light of a surface.
    pub(super) fn aimed_light(
        &self,
        path: &Path,
        (vertex, wo): (&Vertex, Vec3),
        cones: &Cones,
        onward: &Onward,
        draws: &mut Draws<'_>,
    ) -> Spectrum {
        let Some(wi) = aimed_direction(cones, draws) else { return Spectrum::ZERO };
        let (f, of_finish) = vertex.bsdf.eval_with_pdf(wo, wi, Transport::Radiance);
        let (drawn, pdf) = (onward.pdf(of_finish, wi), cones.pdf(wi));
        let weight = f / pdf;
        if !weight.is_finite() || weight.is_zero() {
            return Spectrum::ZERO;
        }
        let mut second = self.second(path);
        let scattered = BsdfSample { wi, weight, pdf, is_delta: false, transmits: false, eta_scale: 1.0 };
        self.turn(&mut second, vertex, &scattered);
        second.index_scale *= weight.max_lane(self.world.lanes);
        second.rival = self.hits_over_aimed(drawn, pdf);
        self.over_polished_to_light(second, draws)
    }

    /// Aimed light of a particle.
    pub(super) fn aimed_light_in_volume(
        &self,
        path: &Path,
        place: &VolumeVertex,
        wo: Vec3,
        cones: &Cones,
        draws: &mut Draws<'_>,
    ) -> Spectrum {
        let Some(wi) = aimed_direction(cones, draws) else { return Spectrum::ZERO };
        let (drawn, pdf) = (in_volume::phase_at(self.world, place).value(wo, wi), cones.pdf(wi));
        let weight = drawn / pdf;
        if !weight.is_finite() || weight == 0.0 {
            return Spectrum::ZERO;
        }
        let mut second = self.second(path);
        second.throughput *= weight;
        self.turn_at_place(&mut second, place, wi, pdf);
        second.index_scale *= weight;
        second.rival = self.hits_over_aimed(drawn, pdf);
        self.over_polished_to_light(second, draws)
    }

    /// A path to be aimed. Its throughput falls where it is drawn densely, which says nothing of what it is worth: what it
    /// falls by there is to be left out of roulette, as the n² factors are.
    fn second(&self, path: &Path) -> Path {
        Path { seen: Seen::default(), ..path.clone() }
    }

    /// Density of the path's own way over that of the aimed one; 0 where what paths come to does not count.
    fn hits_over_aimed(&self, drawn: f32, pdf: f32) -> f32 {
        if self.settings.techniques.hits { drawn / pdf } else { 0.0 }
    }

    /// Light that a path comes to over polished surfaces, one of them at least.
    fn over_polished_to_light(&self, mut path: Path, draws: &mut Draws<'_>) -> Spectrum {
        let mut light = Spectrum::ZERO;
        loop {
            let mut at = self.walk(&mut path, draws);
            // What a medium sends out on the way is left to the path itself, what comes straight to light sampling.
            path.seen = Seen::default();
            let goes_on = self.arrive(&mut path, &mut at, &mut None);
            if path.crossings > 0 {
                light += path.seen.all();
            }
            let is_polished = matches!(&at, Flown::Arrived(Event::Surface(v)) if v.bsdf.is_delta());
            if !goes_on || !is_polished || !self.scatter(&mut path, &at, draws) {
                return light;
            }
        }
    }
}

fn aimed_direction(cones: &Cones, draws: &mut Draws<'_>) -> Option<Vec3> {
    cones.sample(draws.sampler.next_1d(), draws.sampler.next_2d())
}
