//! Which lights a path asks for light: where it scatters first all of them if they are few, later one chosen at random.
//!
//! The choice knows nothing of the place. A lamp and a sky that light a wall alike, chosen as one to four, make most of the
//! noise of that wall; at the first place a second shadow ray is a small part of what the path costs.

use super::{Draws, Eye};
use hyaline_world::World;
use hyaline_world::light::LightChoice;
use smallvec::SmallVec;

impl Eye<'_> {
    /// Lights to ask at a place.
    ///
    /// - `bounces`: scatterings of the path before, singular ones not counted.
    pub(super) fn asked(&self, bounces: u32, draws: &mut Draws<'_>) -> SmallVec<[LightChoice; 4]> {
        let lights = &self.world.lights;
        match lights.few().filter(|_| bounces == 0) {
            Some(few) => few
                .iter()
                .map(|&index| LightChoice { index: index as usize, probability: 1.0, u: 0.0 })
                .collect(),
            None => lights.direct().sample(draws.sampler.next_1d()).into_iter().collect(),
        }
    }
}

/// Chance that a path asks a light at a place, 0…1.
///
/// - `bounces`: scatterings of the path before, singular ones not counted.
pub(in crate::integrator) fn chance(world: &World, index: usize, bounces: u32) -> f32 {
    let by_choice = world.lights.direct().probability(index);
    if bounces == 0 && by_choice > 0.0 && world.lights.few().is_some() { 1.0 } else { by_choice }
}
