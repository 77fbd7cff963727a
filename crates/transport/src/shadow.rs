//! How much light gets from one point to another in a straight line.
//!
//! Glass stops it, for it bends light; unless its finish has straight shadows, the architect's glass. Then the ray passes,
//! dimmed by Fresnel's equations at every face and by the media, as if nothing were bent. That is a model and not the
//! truth: light arrives a little beside where it should, and is not gathered into caustics. In return there is no noise
//! and no way for a lamp behind a pane to be missed. See `Vertex::passes_straight` for what keeps this light from
//! being counted twice.

use crate::stats::Stats;
use crate::walk::LONGEST_WALK;
use hyaline_geometry::SurfaceHit;
use hyaline_math::{Ray, Vec3, offset_origin};
use hyaline_scattering::{MediumSet, volume};
use hyaline_world::light::DirectSample;
use hyaline_world::{StraightWay, World, mask};

/// A shadow ray stops this fraction short of its target: the rounding of the distance itself.
const SHORTENING: f32 = 4.0 * f32::EPSILON;

/// The ray from a surface towards a sampled point of a light, ending just before it; endless for a light at infinity.
pub fn ray_to_light(from: &SurfaceHit, sample: &DirectSample, time: f32) -> Ray {
    ray_from(offset_origin(from.p, from.p_error, from.ng, sample.wi), sample, time)
}

/// The same from a point in the open, on no surface.
pub fn ray_from(origin: Vec3, sample: &DirectSample, time: f32) -> Ray {
    let Some(target) = &sample.target else {
        return Ray { time, t_max: sample.distance, ..Ray::new(origin, sample.wi) };
    };
    let end = offset_origin(target.p, target.p_error, target.n, -sample.wi);
    let way: Vec3 = end - origin;
    let length = way.length();
    Ray { time, t_max: length * (1.0 - SHORTENING), ..Ray::new(origin, way / length) }
}

/// Fraction of light that passes along `ray` up to its `t_max`; `set` holds where the ray starts.
///
/// Boundaries that reflect or bend stop it, where they don't have straight shadows: light through them does not come
/// straight.
///
/// It is told apart by who else finds that light.
pub fn straight_way(world: &World, ray: &Ray, set: &MediumSet, stats: &mut Stats) -> StraightWay {
    stats.rays += 1;
    if world.geometry.occluded(ray, mask::BLOCKS) {
        return StraightWay::BLOCKED;
    }
    if !world.has_permeable {
        return StraightWay::shared(volume::transmittance(
            &world.media[set.active().index()],
            ray,
            ray.t_max,
        ));
    }
    through_boundaries(world, *ray, set.clone(), stats)
}

/// The same, crossing what can be crossed straight.
fn through_boundaries(world: &World, mut ray: Ray, mut set: MediumSet, stats: &mut Stats) -> StraightWay {
    let mut result = StraightWay::OPEN;
    let end = ray.at(ray.t_max);
    for _ in 0..LONGEST_WALK {
        stats.rays += 1;
        let within = set.active();
        let medium = &world.media[within.index()];
        let Some(candidate) = world.geometry.closest(&ray, mask::PATH) else {
            return result.then(StraightWay::shared(volume::transmittance(medium, &ray, ray.t_max)));
        };
        let (hit, encounter) = world
            .meet(&ray, &candidate, &mut set, mask::PATH, &mut |object| stats.count_never_entered(object));
        result = result
            .then(StraightWay::shared(volume::transmittance(medium, &ray, hit.t)))
            .then(world.straight_way(&ray, &hit, &encounter, within));
        if result.transmittance().is_zero() {
            return result;
        }
        encounter.commit(world, &mut set);
        ray.origin = offset_origin(hit.p, hit.p_error, hit.ng, ray.direction);
        if ray.t_max.is_finite() {
            // Each crossing steps a little aside: aimed anew, the ray still ends just before its target.
            let way = end - ray.origin;
            ray.t_max = way.length();
            ray.direction = way.try_normalize().unwrap_or(ray.direction);
        }
    }
    StraightWay::BLOCKED
}
