//! The special functions behind p-values: gamma and beta integrals and the complementary error function.

use std::f64::consts::PI;

/// Terms after which a series or fraction that has not converged is a bug of the caller.
const MAX_TERMS: usize = 1_000_000;

/// Natural logarithm of the gamma function.
///
/// - `x`: > 0.
///
/// Source: NIST DLMF, eq. 5.5.1 (recurrence up to x ≥ 15) and eq. 5.11.1 (asymptotic series).
#[allow(
    clippy::disallowed_methods,
    reason = "statistics never reach a picture, and this crate has no dependency"
)]
pub fn ln_gamma(x: f64) -> f64 {
    assert!(x > 0.0, "ln_gamma is for positive numbers, got {x}");
    let (mut z, mut product) = (x, 1.0);
    while z < 15.0 {
        product *= z;
        z += 1.0;
    }
    let w = 1.0 / (z * z);
    let series = (1.0 / 12.0 - w * (1.0 / 360.0 - w * (1.0 / 1260.0 - w * (1.0 / 1680.0 - w / 1188.0)))) / z;
    (z - 0.5) * z.ln() - z + 0.5 * (2.0 * PI).ln() + series - product.ln()
}

/// Upper regularized incomplete gamma function Q(a, x): the chance that a gamma variate of shape `a` exceeds `x`.
///
/// - `a`: > 0; `x`: ≥ 0.
///
/// Returns 0…1.
/// Source: NIST DLMF, eq. 8.7.1 (series, x < a + 1) and eq. 8.9.2 (continued fraction, its even part).
#[allow(
    clippy::disallowed_methods,
    reason = "statistics never reach a picture, and this crate has no dependency"
)]
pub fn gamma_q(a: f64, x: f64) -> f64 {
    assert!(a > 0.0 && x >= 0.0, "gamma_q({a}, {x}) is not defined");
    if x == 0.0 {
        return 1.0;
    }
    if x.is_infinite() {
        return 0.0;
    }
    let front = (a * x.ln() - x - ln_gamma(a)).exp();
    if x < a + 1.0 { 1.0 - front * lower_gamma_series(a, x) } else { front * upper_gamma_fraction(a, x) }
}

/// Regularized incomplete beta function I_x(a, b).
///
/// - `a`, `b`: > 0; `x`: 0…1.
///
/// Returns 0…1.
/// Source: NIST DLMF, eq. 8.17.22 (continued fraction) and eq. 8.17.4 (symmetry).
#[allow(
    clippy::disallowed_methods,
    reason = "statistics never reach a picture, and this crate has no dependency"
)]
pub fn beta_i(a: f64, b: f64, x: f64) -> f64 {
    assert!(a > 0.0 && b > 0.0 && (0.0..=1.0).contains(&x), "beta_i({a}, {b}, {x}) is not defined");
    if x == 0.0 || x == 1.0 {
        return x;
    }
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - beta_i(b, a, 1.0 - x);
    }
    let ln_front = ln_gamma(a + b) - ln_gamma(a) - ln_gamma(b) + a * x.ln() + b * (-x).ln_1p();
    ln_front.exp() / a * beta_fraction(a, b, x)
}

/// Complementary error function, with full relative precision in its tail.
///
/// Source: NIST DLMF, eq. 7.11.2: erfc(x) = Q(1/2, x²) for x ≥ 0.
pub fn erfc(x: f64) -> f64 {
    let tail = gamma_q(0.5, x * x);
    if x >= 0.0 { tail } else { 2.0 - tail }
}

/// Σ xᵏ / (a (a+1) … (a+k)).
fn lower_gamma_series(a: f64, x: f64) -> f64 {
    let mut term = 1.0 / a;
    let mut sum = term;
    for k in 1..MAX_TERMS {
        term *= x / (a + k as f64);
        sum += term;
        if term < sum * f64::EPSILON {
            return sum;
        }
    }
    panic!("the incomplete gamma series does not converge for a = {a}, x = {x}");
}

/// 1 / (x+1-a - 1(1-a) / (x+3-a - 2(2-a) / …)).
fn upper_gamma_fraction(a: f64, x: f64) -> f64 {
    let numerator = |k: usize| if k == 0 { 1.0 } else { k as f64 * (a - k as f64) };
    continued_fraction(numerator, |k| x + (2 * k + 1) as f64 - a)
}

/// The fraction of DLMF 8.17.22, 1 / (1 + d₁ / (1 + d₂ / …)).
fn beta_fraction(a: f64, b: f64, x: f64) -> f64 {
    let coefficient = |n: usize| {
        let m = (n / 2) as f64;
        match n {
            0 => 1.0,
            n if n % 2 == 0 => m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m)),
            _ => -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0)),
        }
    };
    continued_fraction(coefficient, |_| 1.0)
}

/// a₀ / (b₀ + a₁ / (b₁ + …)) by the modified Lentz method.
///
/// Source: Thompson & Barnett, Coulomb and Bessel functions of complex arguments and order, J. Comput. Phys. 64, 1986.
fn continued_fraction(a: impl Fn(usize) -> f64, b: impl Fn(usize) -> f64) -> f64 {
    const TINY: f64 = 1e-300;
    let nonzero = |x: f64| if x.abs() < TINY { TINY } else { x };
    let (mut value, mut c, mut d) = (TINY, TINY, 0.0);
    for k in 0..MAX_TERMS {
        d = 1.0 / nonzero(b(k) + a(k) * d);
        c = nonzero(b(k) + a(k) / c);
        value *= c * d;
        if (c * d - 1.0).abs() < 4.0 * f64::EPSILON {
            return value;
        }
    }
    panic!("a continued fraction does not converge");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn assert_near(got: f64, want: f64) {
        assert!((got - want).abs() <= 2e-13 * want.abs().max(1e-300), "got {got:e}, want {want:e}");
    }

    #[test]
    fn gamma_function_has_its_factorials_and_half_integers() {
        assert_near(ln_gamma(0.5), 0.572_364_942_924_700_1);
        assert_near(ln_gamma(11.0), 15.104_412_573_075_516);
        assert_near(ln_gamma(100.0), 359.134_205_369_575_4);
        assert!(ln_gamma(1.0).abs() < 1e-14 && ln_gamma(2.0).abs() < 1e-14);
    }

    #[test]
    fn gamma_integral_has_its_closed_forms() {
        for x in [0.1_f64, 1.0, 2.0, 7.5, 30.0] {
            #[allow(clippy::disallowed_methods, reason = "the comparison is the point")]
            let e = (-x).exp();
            assert_near(gamma_q(1.0, x), e);
            assert_near(gamma_q(3.0, x), e * (1.0 + x + x * x / 2.0));
        }
        assert!((gamma_q(5000.0, 5000.0) - 0.498_119_331_3).abs() < 1e-6);
    }

    #[test]
    fn beta_integral_has_its_closed_forms() {
        for x in [0.05, 0.3, 0.5, 0.77, 0.99] {
            assert_near(beta_i(1.0, 3.0, x), 1.0 - (1.0 - x) * (1.0 - x) * (1.0 - x));
            assert_near(beta_i(2.0, 2.0, x), x * x * (3.0 - 2.0 * x));
        }
        assert_near(beta_i(7.0, 7.0, 0.5), 0.5);
    }

    #[test]
    fn error_function_is_right_in_the_middle_and_in_the_tail() {
        assert_near(erfc(0.0), 1.0);
        assert_near(erfc(0.5), 0.479_500_122_186_953_5);
        assert_near(erfc(1.0), 0.157_299_207_050_285_13);
        assert_near(erfc(-1.0), 1.842_700_792_949_714_9);
        assert_near(erfc(5.0), 1.537_459_794_428_034_8e-12);
    }
}
