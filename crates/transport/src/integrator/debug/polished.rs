//! What is seen through polished surfaces: the first surface on a ray's way that is not polished.
//!
//! The ray goes on through a surface where light can get through it, and is mirrored elsewhere: one way, always the
//! same, whatever part of the light takes it.

use crate::first_hit;
use crate::stats::Stats;
use crate::walk::{self, Event, Vertex};
use hyaline_film::PixelSample;
use hyaline_math::{Ray, Vec3};
use hyaline_scattering::{Branch, MediumSet};
use hyaline_world::{World, mask};

/// Polished surfaces after which a ray is taken for trapped.
const MOST_CROSSINGS: u32 = 1024;

/// What a ray comes to.
pub(super) struct Sight {
    /// The first surface that is not polished, with the direction back along the ray; `None` for the surroundings.
    pub(super) end: Option<(Vertex, Vec3)>,
    /// Surfaces met, the last among them.
    pub(super) surfaces: u32,
}

/// Follows a camera ray, which starts inside `set`, through all polished surfaces.
///
/// - `first`: receives what the first surface looks like.
pub(super) fn look(
    world: &World,
    mut ray: Ray,
    mut set: MediumSet,
    stats: &mut Stats,
    mut first: Option<&mut PixelSample>,
) -> Sight {
    let mut visible = mask::CAMERA;
    for surfaces in 0..MOST_CROSSINGS {
        let Event::Surface(vertex) = walk::advance(world, &ray, visible, &mut set, stats) else {
            return Sight { end: None, surfaces };
        };
        if let Some(sample) = first.take() {
            first_hit::record(sample, &vertex, &ray);
        }
        let wo = -ray.direction;
        let Some(branch) = way_on(&vertex, wo) else {
            return Sight { end: Some((vertex, wo)), surfaces: surfaces + 1 };
        };
        ray = vertex.leave(branch.wi, ray.time);
        if branch.transmits {
            vertex.commit(world, &mut set);
        }
        visible = mask::PATH;
    }
    Sight { end: None, surfaces: MOST_CROSSINGS }
}

/// Through a polished surface, else back from it; `None` at all others.
fn way_on(vertex: &Vertex, wo: Vec3) -> Option<Branch> {
    let branches = vertex.bsdf.branches(wo);
    branches.iter().flatten().find(|branch| branch.transmits).or(branches.iter().flatten().next()).copied()
}
