//! Beer-Lambert's law and the three ways to say how strongly a clear medium absorbs.
//!
//! A filter color per unit, an absorption coefficient, a color at a distance: all become `sigma_a`, whose unit is
//! 1 / scene unit, so the same number in a scene of another scale is another substance.

use hyaline_math::float;

/// Fraction of light left after a distance in a clear medium.
///
/// - `sigma`: absorption (or extinction) coefficient, ≥ 0, 1 / scene unit; may be infinite.
/// - `distance`: ≥ 0, scene units; may be infinite.
///
/// Returns 0…1; exactly 1 where either is 0, even if the other is infinite.
/// Source: Bouguer-Beer-Lambert law, Chandrasekhar, Radiative Transfer, 1960, §7.
pub fn transmittance(sigma: f32, distance: f32) -> f32 {
    if sigma == 0.0 || distance == 0.0 { 1.0 } else { float::exp(-sigma * distance) }
}

/// Absorption coefficient of a filter color, the fraction of light left after one scene unit.
///
/// - `c_f`: 0…1; 1 is clear, 0 is opaque.
///
/// Returns ≥ 0, 1 / scene unit; exactly 0 for 1, infinite for 0.
/// Source: Suffern, Ray Tracing from the Ground Up, 2007, ch. 28: L(d) = c_f^d L(0).
pub fn sigma_from_filter(c_f: f32) -> f32 {
    // Not -ln: that would make -0 of a clear filter.
    0.0 - float::ln(c_f)
}

/// Absorption coefficient of a medium that leaves `color` of the light after `distance`.
///
/// - `color`: 0…1.
/// - `distance`: > 0, scene units; infinite means clear, whatever the color.
///
/// Returns ≥ 0, 1 / scene unit; exactly 0 for an infinite distance or a color of 1.
/// Source: Khronos, glTF extension KHR_materials_volume, attenuation.
pub fn sigma_from_color_at_distance(color: f32, distance: f32) -> f32 {
    if color == 1.0 || distance == f32::INFINITY { 0.0 } else { sigma_from_filter(color) / distance }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_three_spellings_say_the_same() {
        for c_f in [0.01_f32, 0.3, 0.85, 0.999] {
            let sigma = sigma_from_filter(c_f);
            assert!((transmittance(sigma, 1.0) - c_f).abs() < 1e-6);
            assert!((transmittance(sigma, 2.5) - float::powf(c_f, 2.5)).abs() < 1e-6);
            let at_distance = sigma_from_color_at_distance(float::powf(c_f, 0.2), 0.2);
            assert!((at_distance - sigma).abs() < 1e-5 * sigma.max(1.0));
        }
    }

    #[test]
    fn clear_and_opaque_media_are_exact() {
        assert_eq!(sigma_from_filter(1.0).to_bits(), 0.0_f32.to_bits());
        assert_eq!(sigma_from_filter(0.0), f32::INFINITY);
        assert_eq!(sigma_from_color_at_distance(0.0, f32::INFINITY), 0.0);
        assert_eq!(sigma_from_color_at_distance(0.5, f32::INFINITY), 0.0);
        assert_eq!(sigma_from_color_at_distance(1.0, 0.1), 0.0);
    }

    #[test]
    fn infinities_never_make_a_nan() {
        assert_eq!(transmittance(0.0, f32::INFINITY), 1.0);
        assert_eq!(transmittance(f32::INFINITY, 0.0), 1.0);
        assert_eq!(transmittance(1e-20, f32::INFINITY), 0.0);
        assert_eq!(transmittance(f32::INFINITY, 1e-20), 0.0);
    }

    #[test]
    fn light_left_over_two_stretches_is_the_product() {
        let (sigma, a, b) = (0.7_f32, 1.3_f32, 0.4_f32);
        assert!(
            (transmittance(sigma, a) * transmittance(sigma, b) - transmittance(sigma, a + b)).abs() < 1e-6
        );
    }
}
