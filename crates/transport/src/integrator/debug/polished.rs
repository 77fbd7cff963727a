//! What is seen through polished surfaces: the first surface on a ray's way that is not polished.
//!
//! The ray goes on through a surface where light can get through it, and is mirrored elsewhere: one way, always the
//! same, whatever part of the light takes it. At nearly polished surfaces, which photons pass like polished ones, its
//! direction is drawn.

use crate::first_hit;
use crate::photon::specular::is_specular;
use crate::stats::Stats;
use crate::walk::{self, Event, Vertex};
use hyaline_film::PixelSample;
use hyaline_math::{Ray, Vec3};
use hyaline_sampling::Sampler;
use hyaline_scattering::{MediumSet, Transport};
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
    sampler: &mut Sampler,
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
        if !is_specular(&vertex.bsdf) {
            return Sight { end: Some((vertex, wo)), surfaces: surfaces + 1 };
        }
        let Some((wi, transmits)) = way_on(&vertex, wo, sampler) else {
            return Sight { end: None, surfaces: surfaces + 1 };
        };
        ray = vertex.leave(wi, ray.time);
        if transmits {
            vertex.commit(world, &mut set);
        }
        visible = mask::PATH;
    }
    Sight { end: None, surfaces: MOST_CROSSINGS }
}

/// Direction in which the ray goes on, and whether it crosses the surface; `None` where it is swallowed.
fn way_on(vertex: &Vertex, wo: Vec3, sampler: &mut Sampler) -> Option<(Vec3, bool)> {
    let branches = vertex.bsdf.branches(wo);
    let mut all = branches.iter().flatten();
    let polished = all.clone().find(|branch| branch.transmits).or(all.next());
    if vertex.bsdf.is_delta() || polished.is_some() {
        return polished.map(|branch| (branch.wi, branch.transmits));
    }
    let (u_lobe, u) = (sampler.next_1d(), sampler.next_2d());
    let sample = vertex.bsdf.sample(wo, u_lobe, u, Transport::Radiance)?;
    Some((sample.wi, sample.transmits))
}
