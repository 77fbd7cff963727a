//! Both ways at the first polished surfaces: a path from the camera is split there, in place of going one way by chance.
//!
//! What glass mirrors is faint but for lamps: one path in 25 would see them, 25 times as bright, and every highlight would be
//! a speckle. Split paths see them all, each by its share. A faint part pays for itself: once it leaves polished surfaces
//! it goes on by roulette, so that all parts of a path together cost little more than one.

use super::{Draws, Eye, Path};
use crate::walk::Vertex;
use hyaline_math::Vec3;
use hyaline_scattering::{Branch, BsdfSample};

/// Parts that wait to be followed, at most: where more are asked for, chance decides again.
const MOST_WAITING: usize = 12;
/// What a part carries at least, of what the whole path started with.
const FAINTEST: f32 = 1e-2;
/// Chance that a part goes on from a surface that is not polished, over what it carries.
const SURVIVAL: f32 = 1.0;

impl Eye<'_> {
    /// Splits a path at a polished surface, if it is to be split there.
    ///
    /// - `wo`: unit, back along the path.
    /// - `waiting`: receives the fainter part.
    ///
    /// Returns the direction of the other part, with its share as weight; `None` where chance decides.
    pub(super) fn split(
        &self,
        path: &Path,
        vertex: &Vertex,
        wo: Vec3,
        waiting: &mut Vec<Path>,
    ) -> Option<BsdfSample> {
        if !vertex.bsdf.is_delta() || path.bounces > 0 || waiting.len() >= MOST_WAITING {
            return None;
        }
        let [Some(first), Some(second)] = vertex.bsdf.branches(wo) else { return None };
        let carried = |branch: &Branch| {
            let weight = branch.weight * path.throughput;
            weight.max_lane(self.world.lanes) / (path.index_scale * branch.eta_scale)
        };
        let (strong, faint) =
            if carried(&first) >= carried(&second) { (first, second) } else { (second, first) };
        if carried(&faint) < FAINTEST {
            return None;
        }
        let mut part = path.part();
        self.turn(&mut part, vertex, &drawn(&faint));
        waiting.push(part);
        Some(drawn(&strong))
    }

    /// Roulette for a part that comes to a vertex which is not singular; returns whether it goes on.
    pub(super) fn part_survives(&self, path: &mut Path, draws: &mut Draws<'_>) -> bool {
        if !path.is_part || path.bounces > 0 {
            return true;
        }
        let carried = path.throughput.max_lane(self.world.lanes) / path.index_scale;
        let survival = (SURVIVAL * carried).min(1.0);
        if survival < 1.0 && draws.sampler.next_1d() >= survival {
            return false;
        }
        path.throughput *= 1.0 / survival;
        true
    }
}

/// A branch that is taken for certain.
fn drawn(branch: &Branch) -> BsdfSample {
    let Branch { wi, weight, transmits, eta_scale } = *branch;
    BsdfSample { wi, weight, pdf: 1.0, is_delta: true, transmits, eta_scale }
}
