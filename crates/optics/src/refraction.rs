//! Where light goes at a smooth boundary: mirror direction, Snell's law and its two special angles.

use hyaline_math::{Vec3, float};

/// Cosine of the angle of refraction: Snell's law.
///
/// - `cos_i`: cosine on the incident side, 0…1.
/// - `eta`: `eta_t / eta_i`, > 0.
///
/// Returns 0…1, exactly `cos_i` for `eta` = 1; `None` under total internal reflection.
/// Source: Born & Wolf, Principles of Optics, 7th ed., §1.5.1, eq. 8.
pub fn cos_t(cos_i: f32, eta: f32) -> Option<f32> {
    debug_assert!(cos_i >= 0.0 && eta > 0.0, "cos_t({cos_i}, {eta})");
    // 1 - (1 - cos_i²) / eta², over a common denominator: nothing cancels at grazing angles or near eta = 1.
    let scaled = (eta - 1.0) * (eta + 1.0) + cos_i * cos_i;
    (scaled >= 0.0).then(|| scaled.sqrt() / eta)
}

/// Direction of the refracted ray.
///
/// - `wo`: unit, away from the surface, towards where the light or path came from.
/// - `n`: unit normal on the side of `wo`.
/// - `eta`: `eta_t / eta_i`, > 0; `eta_i` is the index on the side of `wo`.
///
/// Returns the unit direction on the far side; `None` under total internal reflection.
/// Source: Snell's law in vector form, Glassner (ed.), An Introduction to Ray Tracing, 1989, ch. 4.
pub fn refract(wo: Vec3, n: Vec3, eta: f32) -> Option<Vec3> {
    let cos_i = wo.dot(n);
    let cos_t = cos_t(cos_i.max(0.0), eta)?;
    // Normalized, so that rounding does not build up along paths of many crossings.
    Some((n * (cos_i / eta - cos_t) - wo / eta).normalize())
}

/// Mirror image of a direction about a normal.
///
/// - `wo`: away from the surface.
/// - `n`: unit normal, either side.
///
/// Returns a direction of the length of `wo`, on its side.
/// Source: Born & Wolf, Principles of Optics, 7th ed., §1.5.1, eq. 6.
pub fn reflect(wo: Vec3, n: Vec3) -> Vec3 {
    n * (2.0 * wo.dot(n)) - wo
}

/// Angle of incidence beyond which reflection is total, in radians from the normal.
///
/// - `eta`: `eta_t / eta_i`, > 0.
///
/// Returns `None` where no angle is: `eta` ≥ 1.
/// Source: Born & Wolf, Principles of Optics, 7th ed., §1.5.4.
pub fn critical_angle(eta: f32) -> Option<f32> {
    (eta < 1.0).then(|| float::asin(eta))
}

/// Angle of incidence at which light polarized parallel to the plane of incidence is not reflected, in radians from
/// the normal.
///
/// - `eta`: `eta_t / eta_i`, > 0.
///
/// Source: Born & Wolf, Principles of Optics, 7th ed., §1.5.3.
pub fn brewster_angle(eta: f32) -> f32 {
    float::atan(eta)
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_testkit::Random;

    fn random_direction(random: &mut Random) -> Vec3 {
        Vec3::from_array(random.direction().map(|c| c as f32))
    }

    #[test]
    fn equal_indices_do_not_bend() {
        let mut random = Random::from_seed(1);
        for _ in 0..1000 {
            let (wo, n) = (random_direction(&mut random), random_direction(&mut random));
            let n = if wo.dot(n) < 0.0 { -n } else { n };
            assert!((refract(wo, n, 1.0).unwrap() + wo).length() < 1e-6);
        }
        for i in 0..=1000 {
            let cos_i = i as f32 / 1000.0;
            assert_eq!(cos_t(cos_i, 1.0), Some(cos_i));
        }
    }

    #[test]
    fn sines_are_in_the_ratio_of_the_indices_and_stay_in_the_plane_of_incidence() {
        let mut random = Random::from_seed(2);
        for _ in 0..10_000 {
            let (wo, n) = (random_direction(&mut random), random_direction(&mut random));
            let n = if wo.dot(n) < 0.0 { -n } else { n };
            let eta = random.between(0.4, 2.5) as f32;
            let Some(wi) = refract(wo, n, eta) else {
                assert!(wo.cross(n).length() > eta - 1e-6);
                continue;
            };
            assert!((wi.length() - 1.0).abs() < 1e-6);
            assert!(wi.dot(n) <= 1e-6);
            // The cross products are equal, not opposite, because both directions point away from the surface.
            assert!((wo.cross(n) + wi.cross(n) * eta).length() < 3e-6);
        }
    }

    #[test]
    fn refraction_is_reversible() {
        let mut random = Random::from_seed(3);
        for _ in 0..10_000 {
            let wo = random_direction(&mut random);
            let n = if wo.z < 0.0 { -Vec3::Z } else { Vec3::Z };
            let eta = random.between(1.0, 2.5) as f32;
            let wi = refract(wo, n, eta).unwrap();
            let back = refract(wi, -n, 1.0 / eta);
            // Near grazing the way back may be total within rounding.
            match back {
                Some(back) => assert!((back - wo).length() < 2e-3, "{back} {wo}"),
                None => assert!(wo.dot(n) < 2e-3),
            }
            if wo.dot(n) > 0.1 {
                assert!((back.unwrap() - wo).length() < 1e-5);
            }
        }
    }

    #[test]
    fn reflection_keeps_the_normal_part_and_turns_the_rest() {
        let n = Vec3::new(0.0, 0.6, 0.8);
        let wo = Vec3::new(1.0, 2.0, 3.0).normalize();
        let wi = reflect(wo, n);
        assert!((wi.dot(n) - wo.dot(n)).abs() < 1e-6);
        assert!((wi + wo - n * (2.0 * wo.dot(n))).length() < 1e-6);
        assert!((reflect(wi, n) - wo).length() < 1e-6);
        assert!((reflect(wo, -n) - wi).length() < 1e-6);
    }

    #[test]
    fn total_reflection_starts_at_the_critical_angle() {
        for (eta, degrees) in [(1.0 / 1.5, 41.8103_f32), (1.333 / 1.5, 62.7062), (1.0 / 1.333, 48.607)] {
            let critical = critical_angle(eta).unwrap();
            assert!((critical.to_degrees() - degrees).abs() < 1e-3);
            assert!(cos_t(float::cos(critical - 1e-4), eta).is_some());
            assert!(cos_t(float::cos(critical + 1e-4), eta).is_none());
            let wo = Vec3::new(float::sin(critical + 1e-4), 0.0, float::cos(critical + 1e-4));
            assert!(refract(wo, Vec3::Z, eta).is_none());
        }
        assert_eq!(critical_angle(1.0), None);
        assert_eq!(critical_angle(1.5), None);
    }

    #[test]
    fn brewster_angle_of_glass_is_56_degrees() {
        assert!((brewster_angle(1.5).to_degrees() - 56.3099).abs() < 1e-4);
    }
}
