//! Where a medium ends, what is gathered from reaches beyond its boundary: what of it lies within holds photons, the
//! rest none. Without a mend, milk would be darker along its skin, by as much as half of what is gathered there. Where smoke
//! is thin, few photons tell of the light, each of them loudly: what is much thinner than the place is left out, too.

use super::Draws;
use super::reach::whole_over_part;
use crate::extent::{LEAST_SHARE, end_of_medium};
use hyaline_math::{Ray, Vec3};
use hyaline_sampling::warp;
use hyaline_scattering::{Medium, MediumSet};
use hyaline_world::World;

/// How near to an end of its stretch a ray passes a beam where the boundary may be within the radius, in radii. A boundary
/// that comes as near, far from both ends, is one that the ray grazes.
const NEAR_AN_END: f32 = 8.0;

/// Density of what is gathered from over that of the place, at least.
const LEAST_DENSITY: f32 = 1.0 / 8.0;

/// What a place in a medium with a grid gathers from.
pub(super) struct Part<'a> {
    medium: &'a Medium,
    least_density: f32,
}

impl<'a> Part<'a> {
    /// - `p`: the place.
    pub(super) fn about(medium: &'a Medium, p: Vec3) -> Self {
        Self { medium, least_density: LEAST_DENSITY * medium.density(p) }
    }

    /// Whether what is so dense counts.
    pub(super) fn holds(&self, density: f32) -> bool {
        density >= self.least_density
    }
}

/// An estimate of the ball about a place over the part of it that is gathered from, ≥ 1.
///
/// - `set`: what `p` is in.
pub(super) fn ball_over_part(
    world: &World,
    (p, radius): (Vec3, f32),
    (set, part): (&MediumSet, &Part<'_>),
    draws: &mut Draws<'_>,
) -> f32 {
    whole_over_part(|| {
        let v = draws.sampler.next_2d().extend(draws.sampler.next_1d());
        let way = warp::sample_ball(draws.sampler.next_2d(), v) * radius;
        let ray = Ray { t_max: way.length(), ..Ray::new(p, way.normalize_or(Vec3::Z)) };
        part.holds(part.medium.density(p + way))
            && end_of_medium(world, ray, set, &mut draws.stats.rays).is_none()
    })
}

/// Whether a beam that is passed at `on_ray` may be cut off by an end of the stretch `0..way`.
pub(super) fn is_near_an_end(on_ray: f32, way: f32, radius: f32) -> bool {
    on_ray.min(way - on_ray) < NEAR_AN_END * radius
}

/// Width of the kernel of beams about a place, from the boundary on one side to that on the other where they are nearer
/// than the radius.
///
/// - `across`: unit, square to the ray and to the beam.
/// - `set`: what `p` is in; `rays` counts what is traced.
pub(super) fn kernel_width(
    world: &World,
    (p, radius): (Vec3, f32),
    across: Vec3,
    set: &MediumSet,
    rays: &mut u64,
) -> f32 {
    let mut reach = |direction| {
        let ray = Ray { t_max: radius, ..Ray::new(p, direction) };
        end_of_medium(world, ray, set, rays).map_or(radius, |(t, ..)| t)
    };
    (reach(across) + reach(-across)).max(2.0 * LEAST_SHARE * radius)
}
