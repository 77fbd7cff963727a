//! When paths end by chance, and how long those are borne with that lose nothing: paths of the eye and of photons
//! alike.

/// Bounces after which roulette may end a path of the eye; shorter ones carry most of the picture.
const FIRST_ROULETTE_BOUNCE: u32 = 3;

/// The same where no photons bring the caustics: then longer paths carry much of them.
const FIRST_LONE_ROULETTE_BOUNCE: u32 = 5;

/// Bounces after which roulette ends even paths that lose nothing: in a closed white room they would go on for ever.
const PATIENCE_WITH_BOUNCES: u32 = 128;

/// Singular events in a row after which a path turns to geometric normals: shading normals are not reversible, and
/// light that they let into a mesh may be trapped by total reflection for good.
pub(crate) const PATIENCE_WITH_SHADING_NORMALS: u32 = 32;

/// Singular crossings in a row after which roulette ends even lossless paths now and then: light trapped by
/// total reflection for good would never end otherwise.
const PATIENCE_WITH_CROSSINGS: u32 = 4096;

/// Probability that a path goes on.
///
/// - `weight`: what is left of what it started with, without the n² factors.
/// - `bounces`: scatterings so far, singular ones not counted.
/// - `crossings`: singular events in a row.
pub(crate) fn survival(weight: f32, bounces: u32, crossings: u32) -> f32 {
    if crossings > PATIENCE_WITH_CROSSINGS {
        return weight.clamp(0.05, 0.95);
    }
    weight.clamp(0.0, if bounces > PATIENCE_WITH_BOUNCES { 0.95 } else { 1.0 })
}

/// The same for a path of the eye, whose first bounces are spared.
pub(crate) fn eye_survival(weight: f32, bounces: u32, crossings: u32) -> f32 {
    spared(FIRST_ROULETTE_BOUNCE, weight, bounces, crossings)
}

/// The same for a path that has to find caustics by itself, as there are no photons.
pub(crate) fn lone_eye_survival(weight: f32, bounces: u32, crossings: u32) -> f32 {
    spared(FIRST_LONE_ROULETTE_BOUNCE, weight, bounces, crossings)
}

fn spared(first_roulette: u32, weight: f32, bounces: u32, crossings: u32) -> f32 {
    let is_spared = bounces < first_roulette && weight > 1e-3;
    if is_spared && crossings <= PATIENCE_WITH_CROSSINGS { 1.0 } else { survival(weight, bounces, crossings) }
}
