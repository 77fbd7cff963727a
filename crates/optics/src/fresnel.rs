//! How much light a smooth boundary reflects: Fresnel's equations for dielectrics and conductors.

use crate::refraction::cos_t;

/// Fraction of power reflected at a smooth dielectric boundary, unpolarized light.
///
/// - `cos_i`: cosine on the incident side, 0…1.
/// - `eta`: `eta_t / eta_i`, > 0.
///
/// Returns 0…1; exactly 1 under total internal reflection, exactly 0 for `eta` = 1. The rest is transmitted.
/// Source: Born & Wolf, Principles of Optics, 7th ed., §1.5.3, with the amplitudes of §1.5.2, eq. 21.
pub fn fresnel_dielectric(cos_i: f32, eta: f32) -> f32 {
    if eta == 1.0 {
        return 0.0;
    }
    match cos_t(cos_i, eta) {
        None => 1.0,
        Some(cos_t) => {
            let (par, perp) = (r_par(cos_i, cos_t, eta), r_perp(cos_i, cos_t, eta));
            0.5 * (par * par + perp * perp)
        }
    }
}

/// Amplitude reflected, light polarized parallel to the plane of incidence.
///
/// - `cos_i`, `cos_t`: cosines on the incident and the far side, 0…1, not both 0.
/// - `eta`: `eta_t / eta_i`, > 0.
///
/// Returns -1…1; 0 at the Brewster angle.
/// Source: Born & Wolf, Principles of Optics, 7th ed., §1.5.2, eq. 21.
pub fn r_par(cos_i: f32, cos_t: f32, eta: f32) -> f32 {
    (eta * cos_i - cos_t) / (eta * cos_i + cos_t)
}

/// Amplitude reflected, light polarized perpendicular to the plane of incidence.
///
/// - `cos_i`, `cos_t`: cosines on the incident and the far side, 0…1, not both 0.
/// - `eta`: `eta_t / eta_i`, > 0.
///
/// Returns -1…1.
/// Source: Born & Wolf, Principles of Optics, 7th ed., §1.5.2, eq. 21.
pub fn r_perp(cos_i: f32, cos_t: f32, eta: f32) -> f32 {
    (cos_i - eta * cos_t) / (cos_i + eta * cos_t)
}

/// Fraction of power reflected at a smooth boundary with a conductor, unpolarized light.
///
/// - `cos_i`: cosine on the incident side, 0…1.
/// - `eta`, `k`: index of refraction (> 0) and extinction index (≥ 0) of the conductor, both over the index of the
///   side the ray arrives from.
///
/// Returns 0…1; the rest is absorbed. With `k` = 0 it is the dielectric law.
/// Source: Born & Wolf, Principles of Optics, 7th ed., §14.2: the dielectric law with the complex index.
pub fn fresnel_conductor(cos_i: f32, eta: f32, k: f32) -> f32 {
    if eta == 1.0 && k == 0.0 {
        return 0.0;
    }
    // The square of the complex index, n² = re + i im, and s = a + i b = n cos_t, the root of n² - sin².
    let (re, im) = (eta * eta - k * k, 2.0 * eta * k);
    let (a, b) = complex_sqrt((eta - 1.0) * (eta + 1.0) + cos_i * cos_i - k * k, im);
    let perp = square(cos_i - a, b) / square(cos_i + a, b);
    let par = square(re * cos_i - a, im * cos_i - b) / square(re * cos_i + a, im * cos_i + b);
    0.5 * (par + perp)
}

/// Squared length of `x + i y`.
fn square(x: f32, y: f32) -> f32 {
    x * x + y * y
}

/// Root of `x + i y` in the first quadrant, for y ≥ 0; the larger part is found first, so that nothing cancels.
fn complex_sqrt(x: f32, y: f32) -> (f32, f32) {
    let larger = (0.5 * (square(x, y).sqrt() + x.abs())).sqrt();
    if larger == 0.0 {
        return (0.0, 0.0);
    }
    let smaller = 0.5 * y / larger;
    if x >= 0.0 { (larger, smaller) } else { (smaller, larger) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::refraction::brewster_angle;
    use hyaline_math::float;

    fn cos_of_degrees(degrees: f64) -> f32 {
        float::f64::cos(degrees.to_radians()) as f32
    }

    #[test]
    fn reflectance_matches_the_table_from_normal_to_grazing() {
        const DEGREES: [f64; 7] = [0.0, 30.0, 45.0, 60.0, 75.0, 85.0, 89.9];
        let table: [(f32, [f32; 7]); 5] = [
            (1.5, [0.04, 0.041_522_63, 0.050_239_91, 0.089_186_71, 0.253_060_56, 0.612_799_65, 0.989_911_88]),
            (
                1.333,
                [
                    0.020_373_19,
                    0.021_436_47,
                    0.027_898_36,
                    0.059_690_92,
                    0.212_377_58,
                    0.583_523_48,
                    0.989_067_62,
                ],
            ),
            (
                2.42,
                [
                    0.172_394_92,
                    0.173_882_97,
                    0.181_521_06,
                    0.211_597_57,
                    0.330_627_17,
                    0.621_621_62,
                    0.989_227_56,
                ],
            ),
            (1.0 / 1.5, [0.04, 0.055_190_17, 1.0, 1.0, 1.0, 1.0, 1.0]),
            (1.333 / 1.5, [0.003_474_88, 0.004_007_08, 0.009_359_36, 0.146_585_51, 1.0, 1.0, 1.0]),
        ];
        for (eta, row) in table {
            for (degrees, want) in DEGREES.into_iter().zip(row) {
                let got = fresnel_dielectric(cos_of_degrees(degrees), eta);
                assert!(
                    (got - want).abs() < 2e-6 * want.max(0.2),
                    "eta {eta}, {degrees} deg: {got} not {want}"
                );
                let conductor = fresnel_conductor(cos_of_degrees(degrees), eta, 0.0);
                assert!(
                    (conductor - want).abs() < 2e-6 * want.max(0.2),
                    "conductor, eta {eta}, {degrees} deg"
                );
            }
        }
    }

    #[test]
    fn normal_incidence_has_its_closed_form() {
        for eta in [1.0003_f32, 1.31, 1.5, 2.42, 4.0] {
            let want = ((eta - 1.0) / (eta + 1.0)).powi(2);
            assert!((fresnel_dielectric(1.0, eta) - want).abs() < 1e-6 * want);
            assert!((fresnel_dielectric(1.0, 1.0 / eta) - want).abs() < 1e-6 + 1e-6 * want);
        }
        let (eta, k) = (0.2_f32, 3.5_f32);
        let want = ((eta - 1.0).powi(2) + k * k) / ((eta + 1.0).powi(2) + k * k);
        assert!((fresnel_conductor(1.0, eta, k) - want).abs() < 1e-6);
    }

    #[test]
    fn total_internal_reflection_reflects_everything() {
        assert_eq!(fresnel_dielectric(cos_of_degrees(41.82), 1.0 / 1.5), 1.0);
        assert!(fresnel_dielectric(cos_of_degrees(41.80), 1.0 / 1.5) < 0.96);
        assert_eq!(fresnel_dielectric(0.0, 1.0 / 1.5), 1.0);
    }

    #[test]
    fn grazing_light_is_reflected_and_equal_indices_reflect_nothing() {
        for eta in [1.000_001, 1.333, 2.4] {
            assert_eq!(fresnel_dielectric(0.0, eta), 1.0);
            assert!((fresnel_conductor(0.0, eta, 2.0) - 1.0).abs() < 1e-6);
        }
        for i in 0..=100 {
            assert_eq!(fresnel_dielectric(i as f32 * 0.01, 1.0), 0.0);
            assert_eq!(fresnel_conductor(i as f32 * 0.01, 1.0, 0.0), 0.0);
        }
    }

    #[test]
    fn parallel_light_is_not_reflected_at_the_brewster_angle() {
        for eta in [1.333_f32, 1.5, 1.0 / 1.5, 2.42] {
            let cos_i = float::cos(brewster_angle(eta));
            let cos_t = cos_t(cos_i, eta).unwrap();
            assert!(r_par(cos_i, cos_t, eta).abs() < 1e-6);
            assert!(r_perp(cos_i, cos_t, eta).abs() > 0.1);
        }
    }

    #[test]
    fn both_sides_reflect_alike_and_power_is_conserved() {
        for eta in [1.05_f32, 1.333, 1.5, 2.42] {
            for i in 1..=1000 {
                let cos_i = i as f32 / 1000.0;
                let cos_far = cos_t(cos_i, eta).unwrap();
                let outside = fresnel_dielectric(cos_i, eta);
                let inside = fresnel_dielectric(cos_far, 1.0 / eta);
                // Close to the critical angle the rounding of cos_far alone shows.
                let tolerance = 1e-6 + 6e-7 * eta * eta / cos_i;
                assert!((outside - inside).abs() < tolerance, "eta {eta}, cos {cos_i}: {outside} {inside}");
                // Power through the boundary, from the transmitted amplitudes of Born & Wolf, §1.5.2, eq. 20.
                let t_par = 2.0 * cos_i / (eta * cos_i + cos_far);
                let t_perp = 2.0 * cos_i / (cos_i + eta * cos_far);
                let k_t = 0.5 * eta * cos_far / cos_i * (t_par * t_par + t_perp * t_perp);
                assert!((outside + k_t - 1.0).abs() < 2e-6, "eta {eta}, cos {cos_i}: {}", outside + k_t);
            }
        }
    }

    #[test]
    fn conductors_reflect_between_nothing_and_everything_at_every_angle() {
        for (eta, k) in [(0.05_f32, 4.2_f32), (1.5, 7.6), (3.0, 3.3), (0.2, 0.01), (1e-3, 8.0)] {
            for i in 0..=1000 {
                let f = fresnel_conductor(i as f32 / 1000.0, eta, k);
                assert!((0.0..=1.000_001).contains(&f), "{eta} {k} {i}: {f}");
            }
        }
    }

    #[test]
    fn aluminum_at_45_degrees_matches_an_independent_calculation() {
        // Polarized reflectances at 45° obey R_par = R_perp² (Born & Wolf, §1.5.3), for complex indices too.
        let (eta, k, cos_i) = (1.37_f32, 7.4_f32, std::f32::consts::FRAC_1_SQRT_2);
        let (a, b) = complex_sqrt(eta * eta - k * k - 0.5, 2.0 * eta * k);
        let perp = square(cos_i - a, b) / square(cos_i + a, b);
        let want = 0.5 * (perp + perp * perp);
        assert!((fresnel_conductor(cos_i, eta, k) - want).abs() < 1e-6);
    }
}
