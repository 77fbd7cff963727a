//! Where two surfaces meet, or one ends, a disc about a place reaches over the edge: what of it lies on the surface.
//!
//! Photons on the other surface have seen other light and are left out. So the disc is smaller than it was taken for, by a
//! factor that random tries tell: the mean number of points that are drawn until one lies on the surface is the whole disc
//! over the part that does.

use super::Draws;
use crate::walk::Vertex;
use hyaline_math::{Frame, Ray, Vec3};
use hyaline_sampling::warp;
use hyaline_world::{World, mask};

/// Cosine between the normals of what may pass for one surface.
const FLAT: f32 = 0.7;
/// Where tries look from: above the place, over the radius.
const LIFT: f32 = 0.5;
/// How far tries look, over the way to the plane: surfaces bend.
const BEYOND: f32 = 1.5;
/// Tries, at most: a little dark is left where the part is less than a quarter of the whole.
const MOST_TRIES: u32 = 8;
/// Polished surfaces that a try looks through, at most.
const MOST_HIDING: u32 = 6;

/// A normal, rough enough to be small: good for telling walls from floors.
#[derive(Clone, Copy, Debug)]
pub(in crate::integrator) struct RoughNormal([i8; 3]);

impl RoughNormal {
    /// - `n`: unit, or 0 for none.
    pub(in crate::integrator) fn new(n: Vec3) -> Self {
        Self((n * 127.0).to_array().map(|x| x as i8))
    }

    /// Whether a place with this normal and one with another may be on one surface.
    pub(super) fn is_one_surface(self, n: Vec3) -> bool {
        Vec3::from_array(self.0.map(f32::from)).dot(n).abs() > FLAT * 127.0
    }
}

/// An estimate of the disc about a vertex over the part of it that lies on the surface, ≥ 1.
///
/// - `wo`: unit, to the side that is looked at.
pub(super) fn disc_over_part(
    world: &World,
    vertex: &Vertex,
    wo: Vec3,
    radius: f32,
    draws: &mut Draws<'_>,
) -> f32 {
    let (p, ng) = (vertex.hit.p, vertex.hit.ng);
    let n = if wo.dot(ng) < 0.0 { -ng } else { ng };
    let frame = Frame::from_normal(n);
    let from = p + n * (LIFT * radius);
    let lies_on_it = |draws: &mut Draws<'_>| {
        let at = warp::sample_disc(draws.sampler.next_2d()) * radius;
        let to = p + frame.to_world(Vec3::new(at.x, at.y, 0.0));
        let way = to - from;
        let mut ray = Ray { t_max: BEYOND * way.length(), ..Ray::new(from, way.normalize()) };
        // Polished surfaces hide nothing: photons land in front of them and behind.
        for _ in 0..MOST_HIDING {
            draws.stats.rays += 1;
            let Some(candidate) = world.geometry.closest(&ray, mask::PATH) else { return false };
            if world.geometry.surface(&ray, &candidate).ng.dot(ng).abs() > FLAT {
                return true;
            }
            if !world.is_specular_face(candidate.item, candidate.primitive) {
                return false;
            }
            ray.t_min = candidate.t.next_up();
        }
        false
    };
    whole_over_part(|| lies_on_it(draws))
}

/// An estimate of a whole over its part, ≥ 1: points of the whole that are drawn until one lies in the part.
///
/// - `lies_in_part`: draws a point, uniform, and tells.
pub(super) fn whole_over_part(mut lies_in_part: impl FnMut() -> bool) -> f32 {
    (1..MOST_TRIES).find(|_| lies_in_part()).unwrap_or(MOST_TRIES) as f32
}
