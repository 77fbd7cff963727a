//! Phase functions: where a particle sends the light that it scatters.
//!
//! `cos_theta` is the cosine of the angle between the directions in which light travels before and after; 1 is straight
//! on. Every function is normalized over the sphere and symmetric in its two directions, so it serves eye paths and
//! photons alike, and is its own density where it is sampled.

use hyaline_math::float;
use std::f32::consts::PI;

/// The same in all directions, sr⁻¹.
pub const ISOTROPIC: f32 = 0.25 / PI;

/// Henyey and Greenstein's phase function, sr⁻¹.
///
/// - `cos_theta`: -1…1.
/// - `g`: mean cosine, -1…1 exclusive; positive scatters forward.
///
/// Source: Henyey & Greenstein, Diffuse radiation in the galaxy, Astrophysical Journal 93, 1941, eq. 2.
pub fn henyey_greenstein(cos_theta: f32, g: f32) -> f32 {
    // Written so that 1 - g near 1 keeps its digits: 1 + g² - 2 g cos = (1 - g)² + 2 g (1 - cos).
    let squared = (1.0 - g) * (1.0 - g) + 2.0 * g * (1.0 - cos_theta);
    let squared = squared.max(f32::MIN_POSITIVE);
    ISOTROPIC * (1.0 - g * g) / (squared * squared.sqrt())
}

/// Cosine of the angle that Henyey and Greenstein's phase function scatters by.
///
/// - `g`: mean cosine, -1…1 exclusive.
/// - `u`: uniform in [0, 1).
///
/// Returns -1…1.
/// Source: Witt, Multiple scattering in reflection nebulae I, Astrophysical Journal Supplement 35, 1977, eq. 19.
pub fn sample_henyey_greenstein(g: f32, u: f32) -> f32 {
    if g.abs() < 1e-3 {
        // The exact form divides by g: its first two terms are closer.
        let isotropic = 2.0 * u - 1.0;
        return (isotropic + 1.5 * g * (1.0 - isotropic * isotropic)).clamp(-1.0, 1.0);
    }
    let fraction = (1.0 - g * g) / (1.0 - g + 2.0 * g * u);
    ((1.0 + g * g - fraction * fraction) / (2.0 * g)).clamp(-1.0, 1.0)
}

/// Rayleigh's phase function for unpolarized light, sr⁻¹: of particles much smaller than the wavelength.
///
/// Source: Chandrasekhar, Radiative Transfer, 1960, §3, eq. 10.
pub fn rayleigh(cos_theta: f32) -> f32 {
    0.75 * ISOTROPIC * (1.0 + cos_theta * cos_theta)
}

/// Cosine of the angle that Rayleigh's phase function scatters by.
///
/// - `u`: uniform in [0, 1).
///
/// Source: Frisvad, Importance sampling the Rayleigh phase function, JOSA A 28(12), 2011, eq. 5.
pub fn sample_rayleigh(u: f32) -> f32 {
    let a = 2.0 * (2.0 * f64::from(u) - 1.0);
    let z = float::f64::cbrt(a + (a * a + 1.0).sqrt());
    ((z - 1.0 / z) as f32).clamp(-1.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_testkit::{Random, chi_square, integrate};
    use std::f64::consts::TAU;

    const MEANS: [f32; 7] = [-0.95, -0.4, 0.0, 5e-4, 0.3, 0.8, 0.97];

    fn moment(f: impl Fn(f32) -> f32, power: i32) -> f64 {
        // Narrow lobes want many panels near ±1: cos = 1 - 2 s² and its mirror image.
        let half = |sign: f64| {
            integrate(
                |s| {
                    let cos = sign * (1.0 - s * s);
                    TAU * f64::from(f(cos as f32)) * cos.powi(power) * 2.0 * s
                },
                0.0,
                1.0,
                4000,
            )
        };
        half(1.0) + half(-1.0)
    }

    #[test]
    fn phase_functions_are_normalized_and_have_their_mean_cosine() {
        for g in MEANS {
            let f = |cos: f32| henyey_greenstein(cos, g);
            assert!((moment(f, 0) - 1.0).abs() < 2e-4, "{g}: {}", moment(f, 0));
            assert!((moment(f, 1) - f64::from(g)).abs() < 2e-4, "{g}: {}", moment(f, 1));
        }
        assert!((moment(rayleigh, 0) - 1.0).abs() < 1e-5);
        assert!(moment(rayleigh, 1).abs() < 1e-5);
        assert!((moment(rayleigh, 2) - 0.4).abs() < 1e-5);
    }

    #[test]
    fn published_values_come_out() {
        // (1 - 0.25) / (4 pi (1.25 - cos)^1.5) for g = 0.5.
        for (cos, expected) in [(1.0, 0.477_464_8), (0.0, 0.042_705_4), (-1.0, 0.017_683_9)] {
            let got = henyey_greenstein(cos, 0.5);
            assert!((got - expected).abs() < 1e-6, "{cos}: {got}");
        }
        assert!((rayleigh(1.0) - 0.119_366_2).abs() < 1e-7);
    }

    #[test]
    fn samples_follow_the_phase_functions() {
        let follows = |f: &dyn Fn(f32) -> f32, sample: &dyn Fn(f32) -> f32, what: &str| {
            let (bins, count) = (40, 200_000);
            let mut observed = vec![0.0; bins];
            let mut random = Random::from_seed(5);
            for _ in 0..count {
                let cos = sample(random.uniform_f32());
                observed[(((f64::from(cos) + 1.0) * 0.5 * bins as f64) as usize).min(bins - 1)] += 1.0;
            }
            let edge = |i: usize| -1.0 + 2.0 * i as f64 / bins as f64;
            let mass = |i: usize| integrate(|c| TAU * f64::from(f(c as f32)), edge(i), edge(i + 1), 400);
            let expected: Vec<f64> = (0..bins).map(|i| f64::from(count) * mass(i)).collect();
            let total: f64 = expected.iter().sum();
            let expected: Vec<f64> = expected.iter().map(|e| e * f64::from(count) / total).collect();
            let result = chi_square(&observed, &expected, 5.0);
            assert!(result.p_value > 1e-3, "{what}: {result:?}");
        };
        for g in MEANS {
            follows(&|c| henyey_greenstein(c, g), &|u| sample_henyey_greenstein(g, u), &format!("g = {g}"));
        }
        follows(&rayleigh, &sample_rayleigh, "Rayleigh");
    }
}
