//! Where two surfaces meet, or one ends, a disc about a place reaches over the edge: what of it lies on the surface, within
//! the medium of the place.
//!
//! Photons on the other surface have seen other light and are left out, and so are those in another medium: the floor is
//! darker under glass than beside it. So the disc is smaller than it was taken for, by a factor that random tries tell: the
//! mean number of points that are drawn until one lies in the part is the whole disc over the part.

use super::Draws;
use crate::walk::Vertex;
use hyaline_math::{Frame, Ray, Vec3, offset_origin};
use hyaline_sampling::warp;
use hyaline_scattering::{MediumId, MediumSet};
use hyaline_world::{World, mask};

/// Cosine between the normals of what may pass for one surface.
const FLAT: f32 = 0.7;
/// Where tries look from: above the place, over the radius.
const LIFT: f32 = 0.5;
/// How far tries look, over the way to the plane: surfaces bend.
const BEYOND: f32 = 1.5;
/// Tries, at most: a little dark is left where the part is less than a quarter of the whole.
const MOST_TRIES: u32 = 8;
/// Surfaces that let light through and that a try looks through, at most.
const MOST_HIDING: u32 = 6;

/// A normal, rough enough to be small: good for telling walls from floors.
#[derive(Clone, Copy, Debug)]
pub(in crate::integrator) struct RoughNormal([i8; 3]);

impl RoughNormal {
    /// - `n`: unit.
    pub(in crate::integrator) fn new(n: Vec3) -> Self {
        Self((n * 127.0).to_array().map(|x| x as i8))
    }

    /// Whether a place with this normal and one with another may be on one surface.
    pub(super) fn is_one_surface(self, n: Vec3) -> bool {
        Vec3::from_array(self.0.map(f32::from)).dot(n).abs() > FLAT * 127.0
    }
}

/// A point above a vertex, from which the surface about it is looked at.
pub(super) struct Outlook<'a> {
    world: &'a World,
    vertex: &'a Vertex,
    /// The vertex's medium.
    within: MediumId,
    from: Vec3,
    /// What `from` is in.
    set: MediumSet,
}

impl<'a> Outlook<'a> {
    /// - `side`: a direction to the side that is looked at; `set`: what the path is in there.
    /// - `radius`: of what is looked at; `rays` counts what is traced.
    pub(super) fn new(
        world: &'a World,
        vertex: &'a Vertex,
        (side, set): (Vec3, &MediumSet),
        radius: f32,
        rays: &mut u64,
    ) -> Self {
        let hit = &vertex.hit;
        let n = if side.dot(hit.ng) < 0.0 { -hit.ng } else { hit.ng };
        let start = offset_origin(hit.p, hit.p_error, hit.ng, n);
        let look = || Look { world, vertex, set: set.clone() };
        let up = |lift| Ray { t_max: lift, ..Ray::new(start, n) };
        let (mut lift, mut above) = (LIFT * radius, look());
        *rays += 1;
        if world.geometry.occluded(&up(lift), mask::PATH)
            && let Seen::Surface { t, .. } = above.along(up(lift), rays)
        {
            (lift, above) = (0.5 * t, look());
            above.along(up(lift), rays);
        }
        Self { world, vertex, within: set.active(), from: start + n * lift, set: above.set }
    }

    /// Whether the surface lies at a point, or above or below it, in the medium of the vertex.
    ///
    /// - `p`: near the plane of the surface.
    pub(super) fn holds(&self, p: Vec3, rays: &mut u64) -> bool {
        let way = p - self.from;
        let ray = Ray { t_max: BEYOND * way.length(), ..Ray::new(self.from, way.normalize()) };
        let mut look = Look { world: self.world, vertex: self.vertex, set: self.set.clone() };
        let seen = look.along(ray, rays);
        matches!(seen, Seen::Surface { is_own: true, .. }) && look.set.active() == self.within
    }

    /// An estimate of the disc about the vertex over the part of it that lies on the surface, in the medium of the
    /// vertex, ≥ 1.
    pub(super) fn disc_over_part(&self, radius: f32, draws: &mut Draws<'_>) -> f32 {
        let frame = Frame::from_normal(self.vertex.hit.ng);
        whole_over_part(|| {
            let at = warp::sample_disc(draws.sampler.next_2d()) * radius;
            let p = self.vertex.hit.p + frame.to_world(Vec3::new(at.x, at.y, 0.0));
            self.holds(p, &mut draws.stats.rays)
        })
    }
}

/// A look at the surface of a vertex from near it.
struct Look<'a> {
    world: &'a World,
    vertex: &'a Vertex,
    /// What the look is in.
    set: MediumSet,
}

/// What a look ends at.
enum Seen {
    Nothing,
    Surface {
        /// Distance, scene units.
        t: f32,
        /// Whether it may be the surface of the vertex.
        is_own: bool,
    },
}

impl Look<'_> {
    /// What is seen along a ray; what lets light through hides nothing, as photons land in front of it and behind.
    fn along(&mut self, mut ray: Ray, rays: &mut u64) -> Seen {
        let mut gone = 0.0;
        for _ in 0..MOST_HIDING {
            *rays += 1;
            let Some(candidate) = self.world.geometry.closest(&ray, mask::PATH) else { return Seen::Nothing };
            let (hit, boundary) = self.world.look_at(&ray, &candidate, &mut self.set, mask::PATH);
            let is_flat = hit.ng.dot(self.vertex.hit.ng).abs() > FLAT;
            let is_own = is_flat && boundary.is_some() == self.vertex.is_boundary();
            let hides = boundary.is_none() && !self.world.is_specular_face(hit.item, hit.primitive);
            if is_own || hides {
                return Seen::Surface { t: gone + hit.t, is_own };
            }
            if let Some(boundary) = boundary {
                boundary.commit(self.world, &mut self.set);
            }
            gone += hit.t;
            ray.origin = offset_origin(hit.p, hit.p_error, hit.ng, ray.direction);
            ray.t_max -= hit.t;
        }
        Seen::Nothing
    }
}

/// An estimate of a whole over its part, ≥ 1: points of the whole that are drawn until one lies in the part.
///
/// - `lies_in_part`: draws a point, uniform, and tells.
pub(super) fn whole_over_part(mut lies_in_part: impl FnMut() -> bool) -> f32 {
    (1..MOST_TRIES).find(|_| lies_in_part()).unwrap_or(MOST_TRIES) as f32
}
