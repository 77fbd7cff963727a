//! What is left of light after a way through a medium.

use super::grid::Grid;
use super::majorants::Stretch;
use crate::Medium;
use hyaline_math::{Ray, Vec3, float};
use hyaline_sampling::Rng;
use hyaline_spectrum::Spectrum;

/// Below this fraction of light left, roulette decides whether to go on.
pub(super) const FAINT: f32 = 0.05;

/// Fraction of light left after a way: exact in a homogeneous medium, elsewhere an unbiased estimate, 0…1.
///
/// - `ray`: the way, from its origin.
/// - `distance`: its length, scene units, ≥ 0; may be infinite.
///
/// The random numbers of the estimate are keyed by the ray.
/// Source: Novák, Selle & Jarosz, Residual ratio tracking for estimating attenuation in participating media, ACM TOG
/// 33(6), 2014, §3.
pub fn transmittance(medium: &Medium, ray: &Ray, distance: f32) -> Spectrum {
    match &medium.grid {
        None => medium.transmittance(distance),
        Some(_) if medium.is_clear() => Spectrum::ONE,
        Some(grid) => {
            let mut rng = rng_of(ray);
            ratio_tracking(medium.sigma_t(), grid, ray, distance, &mut rng)
        }
    }
}

/// Random numbers that a ray alone decides on.
pub(super) fn rng_of(ray: &Ray) -> Rng {
    let key = |v: Vec3| {
        let bits = v.to_array().map(|c| u64::from(c.to_bits()));
        bits[0] ^ bits[1] << 21 ^ bits[2] << 42 ^ bits[2] >> 22
    };
    Rng::new(key(ray.origin), key(ray.direction))
}

fn ratio_tracking(sigma_t: Spectrum, grid: &Grid, ray: &Ray, distance: f32, rng: &mut Rng) -> Spectrum {
    let mut left = Spectrum::ONE;
    let Some(line) = grid.inside(ray.origin, ray.direction, distance) else { return left };
    let strongest = sigma_t.to_lanes().into_iter().fold(0.0, f32::max);
    for Stretch { range, majorant } in grid.majorants().along(line) {
        let rate = majorant * strongest;
        let mut way = 0.0;
        loop {
            way += next_step(rate, rng);
            if way >= range[1] - range[0] {
                break;
            }
            let t = range[0] + way;
            let density = grid.density_in_cube(line.origin + line.direction * t);
            left *= Spectrum::ONE + sigma_t * (-density / rate);
            let most = left.to_lanes().into_iter().fold(0.0, f32::max);
            if most < FAINT {
                if rng.uniform() * FAINT >= most {
                    return Spectrum::ZERO;
                }
                left *= FAINT / most;
            }
        }
    }
    left
}

/// Distance to the next possible collision; infinite where there is none. It is to be added to a way that starts at 0 where
/// the stretch does: beside a distance from far away it could vanish, and the way would never end.
///
/// - `rate`: possible collisions per unit of length, ≥ 0.
pub(super) fn next_step(rate: f32, rng: &mut Rng) -> f32 {
    if rate > 0.0 { -float::ln(1.0 - rng.uniform()) / rate } else { f32::INFINITY }
}
