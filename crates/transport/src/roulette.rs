//! When paths end by chance, and how long those are borne with that lose nothing: paths of the eye and of photons
//! alike.

use hyaline_scattering::{MediumId, MediumSet};

/// Bounces after which roulette may end a path of the eye; shorter ones carry most of the picture.
const FIRST_ROULETTE_BOUNCE: u32 = 3;

/// The same where no photons bring the caustics: then longer paths carry much of them.
const FIRST_LONE_ROULETTE_BOUNCE: u32 = 5;

/// Bounces on surfaces after which roulette ends even paths that lose nothing: in a closed white room they would go on for
/// ever.
const PATIENCE_WITH_BOUNCES: u32 = 128;

/// The same of collisions in the media of objects. Light finds out of a glass of milk by itself after hundreds, and some after
/// thousands; paths that live on by luck are worth the more for it, and would be specks. In the medium of the world they
/// may never find out.
const PATIENCE_WITH_COLLISIONS: u32 = 1 << 14;

/// Singular events in a row after which a path turns to geometric normals: shading normals are not reversible, and
/// light that they let into a mesh may be trapped by total reflection for good.
pub(crate) const PATIENCE_WITH_SHADING_NORMALS: u32 = 32;

/// Singular crossings in a row after which roulette ends even lossless paths now and then: light trapped by
/// total reflection for good would never end otherwise.
const PATIENCE_WITH_CROSSINGS: u32 = 4096;

/// What a path has been through.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Past {
    /// Scatterings so far, singular ones not counted.
    pub(crate) bounces: u32,
    /// Those of them in media of objects.
    pub(crate) collisions: u32,
    /// Singular events in a row.
    pub(crate) crossings: u32,
}

impl Past {
    /// What a collision in a medium adds to `collisions`: nothing in the medium that is about all objects.
    ///
    /// - `set`: what the path is in.
    pub(crate) fn collisions_in(medium: MediumId, set: &MediumSet) -> u32 {
        u32::from(medium != set.base())
    }
}

/// Probability that a path goes on.
///
/// - `weight`: what is left of what it started with, without the n² factors.
pub(crate) fn survival(weight: f32, past: Past) -> f32 {
    let Past { bounces, collisions, crossings } = past;
    if crossings > PATIENCE_WITH_CROSSINGS {
        return weight.clamp(0.05, 0.95);
    }
    let most = match bounces - collisions > PATIENCE_WITH_BOUNCES {
        true => 0.95,
        false if collisions > PATIENCE_WITH_COLLISIONS => 0.99,
        false => 1.0,
    };
    weight.clamp(0.0, most)
}

/// The same for a path of the eye, whose first bounces are spared.
pub(crate) fn eye_survival(weight: f32, past: Past) -> f32 {
    spared(FIRST_ROULETTE_BOUNCE, weight, past)
}

/// The same for a path that has to find caustics by itself, as there are no photons.
pub(crate) fn lone_eye_survival(weight: f32, past: Past) -> f32 {
    spared(FIRST_LONE_ROULETTE_BOUNCE, weight, past)
}

fn spared(first_roulette: u32, weight: f32, past: Past) -> f32 {
    let is_spared = past.bounces < first_roulette && weight > 1e-3;
    if is_spared && past.crossings <= PATIENCE_WITH_CROSSINGS { 1.0 } else { survival(weight, past) }
}
