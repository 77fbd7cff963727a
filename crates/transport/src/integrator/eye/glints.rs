//! Which of the light that a path comes to is a glint, and a way to estimate the glints alone.
//!
//! Lights that are seen directly, or over polished surfaces that send much of what comes to them this way, are all that can
//! make a speckle before the first scattering: no other way finds them, and they arrive undimmed. Few branches are that
//! strong, so all of them can be followed, at the cost of a few rays.

use super::split::{share, taken};
use super::{Draws, Eye, Path};
use crate::walk::{Event, Flown};
use hyaline_math::Ray;
use hyaline_scattering::MediumSet;
use hyaline_spectrum::Spectrum;
use smallvec::SmallVec;

/// Share of the light that polished surfaces send the way of a glint, at least; what is fainter makes no speckles.
const STRONG: f32 = 0.1;
/// Polished surfaces before a glint, at most.
const MOST_CROSSINGS: u32 = 32;

/// Radiance along a camera ray.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::integrator) struct Seen {
    /// All but the glints.
    pub(in crate::integrator) light: Spectrum,
    /// Lights that are seen directly or over polished surfaces alone, by ways that these send much of the light.
    pub(in crate::integrator) glints: Spectrum,
}

impl Seen {
    pub(in crate::integrator) fn all(&self) -> Spectrum {
        self.light + self.glints
    }

    pub(super) fn add(&mut self, other: Self) {
        self.light += other.light;
        self.glints += other.glints;
    }
}

impl Path {
    /// Adds the light of a lamp or of the sky that it has come to.
    pub(super) fn find(&mut self, light: Spectrum) {
        *if self.is_strong() { &mut self.seen.glints } else { &mut self.seen.light } += light;
    }

    /// Whether nothing but polished surfaces lies behind, which together send much this way.
    fn is_strong(&self) -> bool {
        self.share >= STRONG && self.crossings <= MOST_CROSSINGS
    }
}

impl Eye<'_> {
    /// What [`Eye::radiance`] estimates as glints.
    pub(in crate::integrator) fn glints(&self, ray: Ray, set: MediumSet, draws: &mut Draws<'_>) -> Spectrum {
        let mut glints = Spectrum::ZERO;
        let mut waiting = SmallVec::<[Path; 4]>::new();
        waiting.push(self.start(ray, set));
        while let Some(mut path) = waiting.pop() {
            let mut at = self.walk(&mut path, draws);
            let goes_on = self.arrive(&mut path, &mut at, &mut None);
            glints += std::mem::take(&mut path.seen).glints;
            let Flown::Arrived(Event::Surface(vertex)) = &at else { continue };
            if !goes_on || !vertex.bsdf.is_delta() {
                continue;
            }
            for branch in vertex.bsdf.branches(-path.ray.direction).iter().flatten() {
                if path.share * share(branch.weight, branch.eta_scale, self.world.lanes) >= STRONG {
                    let mut part = path.clone();
                    self.turn(&mut part, vertex, &taken(branch));
                    waiting.extend(part.is_strong().then_some(part));
                }
            }
        }
        glints
    }
}
