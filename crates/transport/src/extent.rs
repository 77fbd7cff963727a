//! How far a medium goes: what gathers photons of a medium from all around must not count what lies beyond its end.

use hyaline_math::{Ray, Vec3, offset_origin};
use hyaline_scattering::MediumSet;
use hyaline_world::{World, mask};

/// Boundaries of no effect that are crossed along one ray, at most.
const MOST_CROSSINGS: u32 = 16;

/// Least share of what is gathered from that counts as within: a place squeezed between walls must not shine without bound.
pub(crate) const LEAST_SHARE: f32 = 0.05;

/// Where the medium ends along a ray, before the ray's end: the distance, the place and the normal there.
///
/// - `set`: what the ray's origin is in.
/// - `rays`: counts what is traced.
pub(crate) fn end_of_medium(
    world: &World,
    mut ray: Ray,
    set: &MediumSet,
    rays: &mut u64,
) -> Option<(f32, Vec3, Vec3)> {
    let (mut set, within, mut gone) = (set.clone(), set.active(), 0.0);
    for _ in 0..MOST_CROSSINGS {
        *rays += 1;
        let candidate = world.geometry.closest(&ray, mask::PATH)?;
        // What was never entered is told by the rays that carry light.
        let (hit, encounter) = world.meet(&ray, &candidate, &mut set, mask::PATH, &mut |_| ());
        encounter.commit(world, &mut set);
        if encounter.crossing.is_none() || set.active() != within {
            return Some((gone + hit.t, hit.p, hit.ng));
        }
        gone += hit.t;
        ray.origin = offset_origin(hit.p, hit.p_error, hit.ng, ray.direction);
        ray.t_max -= hit.t;
    }
    None
}
