//! From the power of a lamp to its radiant intensity.
//!
//! Radiance is in W sr⁻¹ m⁻² whatever the scene's unit, so that a picture does not change with it. Distances and
//! areas are in scene units, therefore powers and intensities are stored per square of the unit's length in metres.

use hyaline_math::float::f64::{cos, sin};
use hyaline_scene::{Rgb, SpotFalloff};
use std::f64::consts::TAU;

/// Radiant intensity on the axis, W/sr.
///
/// - `power`: W in all, per channel.
/// - `solid_angle`: integral over the sphere of the intensity relative to that on the axis, sr: 4π for a point.
pub(crate) fn intensity_from_power(power: Rgb, solid_angle: f64) -> Rgb {
    power.map(|watts| (f64::from(watts) / solid_angle) as f32)
}

/// A power or an intensity for distances in units of `metres`.
pub(crate) fn per_square_unit(color: Rgb, metres: f64) -> Rgb {
    color.map(|value| (f64::from(value) / (metres * metres)) as f32)
}

/// Integral over the sphere of a spot's intensity relative to that on its axis, sr.
///
/// - `inner`, `outer`: half-angles, radians, 0 ≤ inner ≤ outer ≤ π, outer > 0.
///
/// With a smooth step in the cosine the rim counts half, as ∫₀¹ t²(3 - 2t) dt = 1/2:
/// 2π (1 - (cos inner + cos outer) / 2). Linear in the angle, integration by parts of (outer - θ) sin θ gives
/// 2π (1 - (sin outer - sin inner) / (outer - inner)).
pub(crate) fn spot_solid_angle(inner: f64, outer: f64, falloff: SpotFalloff) -> f64 {
    let fraction = match falloff {
        SpotFalloff::Smooth => 1.0 - 0.5 * (cos(inner) + cos(outer)),
        // The quotient is a difference quotient of the sine; where the angles meet it is the cosine.
        SpotFalloff::LinearInAngle if outer - inner < 1e-6 => 1.0 - cos(0.5 * (inner + outer)),
        SpotFalloff::LinearInAngle => 1.0 - (sin(outer) - sin(inner)) / (outer - inner),
    };
    TAU * fraction.max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same integral by the midpoint rule.
    fn by_quadrature(inner: f64, outer: f64, falloff: SpotFalloff) -> f64 {
        let steps = 200_000;
        let width = outer / f64::from(steps);
        let intensity = |theta: f64| {
            if theta <= inner {
                return 1.0;
            }
            match falloff {
                SpotFalloff::Smooth => {
                    let t = (cos(theta) - cos(outer)) / (cos(inner) - cos(outer));
                    t * t * (3.0 - 2.0 * t)
                }
                SpotFalloff::LinearInAngle => (outer - theta) / (outer - inner),
            }
        };
        let term = |i: i32| {
            let theta = (f64::from(i) + 0.5) * width;
            intensity(theta) * sin(theta) * width
        };
        TAU * (0..steps).map(term).sum::<f64>()
    }

    #[test]
    fn spot_integrals_agree_with_quadrature() {
        for falloff in [SpotFalloff::Smooth, SpotFalloff::LinearInAngle] {
            for (inner, outer) in [(0.0, 0.5), (0.3, 0.5), (0.1, 1.5), (1.0, 3.1), (0.2, 0.2 + 1e-5)] {
                let (closed, numeric) =
                    (spot_solid_angle(inner, outer, falloff), by_quadrature(inner, outer, falloff));
                assert!(
                    (closed - numeric).abs() < 2e-4 * numeric,
                    "{falloff:?} {inner} {outer}: {closed} {numeric}"
                );
            }
        }
    }

    #[test]
    fn a_spot_as_wide_as_the_sphere_is_a_point() {
        let whole = 2.0 * TAU;
        for falloff in [SpotFalloff::Smooth, SpotFalloff::LinearInAngle] {
            let solid_angle = spot_solid_angle(std::f64::consts::PI, std::f64::consts::PI, falloff);
            assert!((solid_angle - whole).abs() < 1e-9, "{solid_angle}");
        }
        let intensity = intensity_from_power([100.0; 3], whole)[0];
        assert!((intensity - 7.957_747).abs() < 1e-5, "100 W / 4 pi: {intensity}");
    }
}
