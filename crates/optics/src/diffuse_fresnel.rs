//! How much of evenly scattered light a smooth boundary reflects: Fresnel's equations averaged over all directions.

use hyaline_math::float::f64::ln;

/// With indices closer than this the closed form loses its digits to cancellation, and hardly any light is reflected.
const MIN_INDEX_STEP: f64 = 1e-4;

/// Fraction of Lambertian light that a smooth dielectric boundary reflects: 2 ∫ F(c) c dc over the cosines c, 0…1.
///
/// - `eta`: `eta_t / eta_i`, > 0.
///
/// Returns 0…1; 0.0918 for light from air to glass of 1.5, 0.5964 for light from within such glass.
/// Source: Walsh, The Reflection Factor of a Polished Glass Surface for Diffused Light, 1926, as given by Duntley,
/// J. Opt. Soc. Am. 32, 1942, eq. 62; light from within by reciprocity, eq. 63.
pub fn diffuse_fresnel(eta: f32) -> f32 {
    let eta = f64::from(eta);
    if (eta - 1.0).abs() < MIN_INDEX_STEP {
        return 0.0;
    }
    let reflected =
        if eta > 1.0 { from_outside(eta) } else { 1.0 - (1.0 - from_outside(1.0 / eta)) * eta * eta };
    reflected.clamp(0.0, 1.0) as f32
}

/// The closed form for n > 1.
fn from_outside(n: f64) -> f64 {
    let n2 = n * n;
    let (plus, minus) = (n2 + 1.0, n2 - 1.0);
    let product = plus * minus;
    0.5 + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * (n + 1.0) * (n + 1.0))
        + n2 * minus * minus / (plus * plus * plus) * ln((n - 1.0) / (n + 1.0))
        - 2.0 * n2 * n * (n2 + 2.0 * n - 1.0) / (plus * product)
        + 8.0 * n2 * n2 * (n2 * n2 + 1.0) / (plus * product * product) * ln(n)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel_dielectric;
    use hyaline_testkit::integrate;

    #[test]
    fn the_closed_form_is_the_mean_of_fresnel_over_all_directions() {
        for eta in [1.000_05_f32, 1.01, 1.333, 1.5, 2.42, 1.0 / 1.01, 1.0 / 1.333, 1.0 / 1.5, 1.0 / 2.42] {
            let mean = integrate(|c| 2.0 * c * f64::from(fresnel_dielectric(c as f32, eta)), 0.0, 1.0, 4000);
            let got = f64::from(diffuse_fresnel(eta));
            assert!((got - mean).abs() < 3e-4, "eta {eta}: {got}, by quadrature {mean}");
        }
        assert!((diffuse_fresnel(1.5) - 0.091_78).abs() < 1e-5);
        assert_eq!(diffuse_fresnel(1.0), 0.0);
    }
}
