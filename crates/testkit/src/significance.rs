//! Tests for equal means, and the correction for asking many times.

use crate::special::{beta_i, erfc};

/// Chance that two samples of the same mean differ at least as much as these do, by Welch's t-test, two-sided.
///
/// - `mean_a`, `var_of_mean_a`: the mean and the variance *of that mean* (sample variance / count).
/// - `n_a`: how many independent numbers it was taken over.
///
/// Returns 0…1. Where neither side varies it is 1 for equal means and 0 for others.
/// Source: Welch, The generalization of Student's problem when several different population variances are involved,
/// Biometrika 34, 1947; NIST DLMF 8.17 for the distribution.
///
/// # Panics
/// Where an argument is not finite, a variance is negative, or a side that varies has fewer than two numbers.
pub fn welch_t(
    mean_a: f64,
    var_of_mean_a: f64,
    n_a: usize,
    mean_b: f64,
    var_of_mean_b: f64,
    n_b: usize,
) -> f64 {
    assert!(mean_a.is_finite() && mean_b.is_finite(), "the means {mean_a} and {mean_b} cannot be compared");
    let variance = var_of_mean_a + var_of_mean_b;
    if variance == 0.0 {
        return if mean_a == mean_b { 1.0 } else { 0.0 };
    }
    let spread = share_of_freedom(var_of_mean_a, n_a) + share_of_freedom(var_of_mean_b, n_b);
    let degrees_of_freedom = variance * variance / spread;
    let t_squared = (mean_a - mean_b) * (mean_a - mean_b) / variance;
    beta_i(0.5 * degrees_of_freedom, 0.5, degrees_of_freedom / (degrees_of_freedom + t_squared))
}

/// Chance that a normal variate lies at least `difference` away from its mean, two-sided.
///
/// - `standard_error`: its standard deviation, > 0; where 0, the result is 1 for a difference of 0 and 0 for others.
///
/// # Panics
/// Where the difference is not a number or the error is negative.
pub fn z_test(difference: f64, standard_error: f64) -> f64 {
    assert!(
        !difference.is_nan() && standard_error >= 0.0,
        "z_test({difference}, {standard_error}) is not defined"
    );
    if difference == 0.0 {
        return 1.0;
    }
    erfc(difference.abs() / (standard_error * std::f64::consts::SQRT_2))
}

/// Level for each of `test_count` independent tests, so that all of them together err with probability `level`.
///
/// Source: Šidák, Rectangular confidence regions for the means of multivariate normal distributions, JASA 62, 1967.
#[allow(
    clippy::disallowed_methods,
    reason = "statistics never reach a picture, and this crate has no dependency"
)]
pub fn sidak(level: f64, test_count: usize) -> f64 {
    assert!(test_count > 0 && (0.0..1.0).contains(&level), "sidak({level}, {test_count}) is not defined");
    -((-level).ln_1p() / test_count as f64).exp_m1()
}

/// One side's term in the Welch-Satterthwaite equation.
fn share_of_freedom(var_of_mean: f64, n: usize) -> f64 {
    assert!(var_of_mean >= 0.0, "a variance cannot be {var_of_mean}");
    if var_of_mean == 0.0 {
        return 0.0;
    }
    assert!(n >= 2, "a mean that varies needs at least two numbers");
    var_of_mean * var_of_mean / (n - 1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Moments, Random};

    #[test]
    fn student_quantiles_have_their_tabulated_probability() {
        // With all the variance on side a, the degrees of freedom are n_a - 1. Two-sided 5 % points of Student's t.
        for (n, t) in [(2, 12.706_204_736), (6, 2.570_581_836), (31, 2.042_272_456), (1001, 1.962_339_081)] {
            let p = welch_t(t, 1.0, n, 0.0, 0.0, 2);
            assert!((p - 0.05).abs() < 1e-9, "n = {n}: p = {p}");
        }
    }

    #[test]
    fn unequal_variances_share_their_degrees_of_freedom() {
        // Equal terms and counts: 2 (n - 1) = 10 degrees of freedom, whose two-sided 1 % point is 3.169272667.
        let p = welch_t(3.169_272_667, 0.5, 6, 0.0, 0.5, 6);
        assert!((p - 0.01).abs() < 1e-9);
    }

    #[test]
    fn constants_are_equal_or_not() {
        assert_eq!(welch_t(1.0, 0.0, 1, 1.0, 0.0, 1), 1.0);
        assert_eq!(welch_t(1.0, 0.0, 1, 1.5, 0.0, 1), 0.0);
        assert_eq!(z_test(0.0, 0.0), 1.0);
        assert_eq!(z_test(1e-9, 0.0), 0.0);
    }

    #[test]
    fn normal_quantiles_have_their_tabulated_probability() {
        assert!((z_test(-1.959_963_985, 1.0) - 0.05).abs() < 1e-9);
        assert!((z_test(2.0 * 2.575_829_304, 2.0) - 0.01).abs() < 1e-9);
    }

    #[test]
    fn many_tests_together_keep_their_level() {
        assert!((sidak(0.05, 1) - 0.05).abs() < 1e-15);
        let each = sidak(0.05, 20);
        assert!((1.0 - (1.0 - each).powi(20) - 0.05).abs() < 1e-12);
    }

    #[test]
    fn welch_rejects_at_its_level_when_the_means_are_equal() {
        let mut random = Random::from_seed(11);
        let mut sample =
            |n: usize, width: f64| -> Moments { (0..n).map(|_| width * random.uniform()).collect() };
        let rejected = (0..4000).filter(|_| {
            let (a, b) = (sample(30, 1.0), sample(50, 1.0));
            welch_t(a.mean(), a.variance_of_mean(), 30, b.mean(), b.variance_of_mean(), 50) < 0.05
        });
        let share = rejected.count() as f64 / 4000.0;
        assert!((share - 0.05).abs() < 4.0 * (0.05_f64 * 0.95 / 4000.0).sqrt(), "rejected {share}");
    }
}
