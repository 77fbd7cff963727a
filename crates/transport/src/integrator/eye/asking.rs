//! Which lights a path asks for light: where it scatters first all of them if they are few, else some of them; later one.
//! Where not all are asked chance decides.
//!
//! The choice knows nothing of the place. A lamp and a sky that light a wall alike, chosen as one to four, make most of the
//! noise of that wall; at the first place more shadow rays are a small part of what the path costs.

use super::{Draws, Eye};
use hyaline_world::World;
use hyaline_world::light::LightChoice;
use smallvec::SmallVec;

/// Lights asked where a path scatters first, at most.
const MOST: usize = 4;

impl Eye<'_> {
    /// Lights to ask at a place, with the number of times that each is asked on the mean as its probability: what each brings is
    /// divided by it.
    ///
    /// - `bounces`: scatterings of the path before, singular ones not counted.
    pub(super) fn asked(&self, bounces: u32, draws: &mut Draws<'_>) -> SmallVec<[LightChoice; MOST]> {
        let lights = &self.world.lights;
        if bounces > 0 {
            return lights.direct().sample(draws.sampler.next_1d()).into_iter().collect();
        }
        let powerful = lights.powerful();
        if powerful.len() <= MOST {
            let certain = |&index: &u32| LightChoice { index: index as usize, probability: 1.0, u: 0.0 };
            return powerful.iter().map(certain).collect();
        }
        // Evenly spread choices: what is worth a quarter is asked once at least.
        let u = draws.sampler.next_1d();
        let choices = (0..MOST).filter_map(|i| lights.direct().sample((u + i as f32) / MOST as f32));
        choices
            .map(|choice| LightChoice { probability: choice.probability * MOST as f32, ..choice })
            .collect()
    }
}

/// How often a path asks a light at a place, on the mean.
///
/// - `bounces`: scatterings of the path before, singular ones not counted.
pub(in crate::integrator) fn expected(world: &World, index: usize, bounces: u32) -> f32 {
    let lights = &world.lights;
    let by_choice = lights.direct().probability(index);
    match lights.powerful().len() {
        _ if bounces > 0 || by_choice == 0.0 => by_choice,
        ..=MOST => 1.0,
        _ => by_choice * MOST as f32,
    }
}
