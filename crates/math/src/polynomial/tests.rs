//! Polynomials of known roots, scaled and clustered, and the parity of what is found.

use super::*;
use crate::float::f64::powf;
use hyaline_testkit::Random;

/// Coefficients, constant first, of `scale Π (x - root)`.
fn expand<const N: usize>(roots: &[f64], scale: f64) -> [f64; N] {
    let mut c = [0.0; N];
    c[0] = scale;
    for (degree, root) in roots.iter().enumerate() {
        for i in (0..=degree).rev() {
            c[i + 1] += c[i];
            c[i] *= -root;
        }
    }
    c
}

fn sorted(mut roots: Vec<f64>) -> Vec<f64> {
    roots.sort_by(f64::total_cmp);
    roots
}

#[test]
fn expanded_coefficients_are_those_of_vieta() {
    assert_eq!(expand::<4>(&[1.0, 2.0, 3.0], 2.0), [-12.0, 22.0, -12.0, 2.0]);
}

#[test]
fn well_separated_roots_are_found_to_the_last_digits() {
    let mut random = Random::from_seed(1);
    for _ in 0..20_000 {
        let roots = sorted((0..4).map(|i| i as f64 * 2.0 - 4.0 + random.uniform()).collect());
        let scale = random.between(-3.0, 3.0);
        for (found, expected) in [
            (quadratic_roots(expand(&roots[..2], scale), -10.0, 10.0), &roots[..2]),
            (cubic_roots(expand(&roots[..3], scale), -10.0, 10.0), &roots[..3]),
            (quartic_roots(expand(&roots, scale), -10.0, 10.0), &roots[..]),
        ] {
            assert_eq!(found.len(), expected.len());
            for (x, y) in found.iter().zip(expected) {
                assert!((x - y).abs() < 1e-12, "{x} for {y} of {roots:?}");
            }
        }
    }
}

#[test]
fn coefficients_of_any_scale_give_the_same_roots() {
    let roots = [-3.0, -0.5, 0.25, 7.0];
    for exponent in [-200, -30, 0, 30, 200] {
        let c: [f64; 5] = expand(&roots, 10.0_f64.powi(exponent));
        let found = quartic_roots(c, f64::NEG_INFINITY, f64::INFINITY);
        assert_eq!(found.len(), 4, "scale 1e{exponent}");
        assert!(found.iter().zip(roots).all(|(x, y)| (x - y).abs() < 1e-13));
    }
}

#[test]
fn roots_of_any_magnitude_are_found_to_relative_precision() {
    for exponent in [-20, -8, 8, 20] {
        let unit = 10.0_f64.powi(exponent);
        let roots = [-3.0 * unit, 0.5 * unit, 2.0 * unit, 7.0 * unit];
        let found = quartic_roots(expand(&roots, 1.0), f64::NEG_INFINITY, f64::INFINITY);
        assert_eq!(found.len(), 4, "unit 1e{exponent}");
        assert!(found.iter().zip(roots).all(|(x, y)| (x - y).abs() < 1e-13 * unit));
    }
}

#[test]
fn the_small_root_of_a_quadratic_does_not_cancel() {
    let found = quadratic_roots([1.0, -1e9, 1.0], f64::NEG_INFINITY, f64::INFINITY);
    assert_eq!(found.len(), 2);
    assert!((found[0] * 1e9 - 1.0).abs() < 1e-15 && (found[1] * 1e-9 - 1.0).abs() < 1e-15);
}

#[test]
fn the_discriminant_of_a_nearly_double_root_keeps_its_digits() {
    // x² - 2 (1 + h) x + (1 + 2 h), whose roots are 1 and 1 + 2 h.
    let h = 2.0_f64.powi(-40);
    let found = quadratic_roots([1.0 + 2.0 * h, -2.0 * (1.0 + h), 1.0], 0.0, 2.0);
    assert_eq!(&found[..], [1.0, 1.0 + 2.0 * h]);
}

#[test]
fn clustered_roots_are_found_as_well_as_their_coefficients_determine_them() {
    let mut random = Random::from_seed(2);
    for _ in 0..20_000 {
        let gap = powf(10.0, random.between(-6.0, -1.0));
        let first = random.between(-2.0, 1.0);
        let roots = [first, first + gap, 3.0, 4.0];
        let found = quartic_roots(expand(&roots, random.between(0.1, 3.0)), -10.0, 10.0);
        assert_eq!(found.len(), 4, "{roots:?}");
        for (x, y) in found.iter().zip(roots) {
            // Rounded coefficients move a root by about ε / |f'|, and the slope there is about the gap.
            assert!((x - y).abs() < 1e-13 / gap, "{x} for {y}, gap {gap}");
        }
    }
}

#[test]
fn a_touch_gives_two_roots_or_none() {
    let mut random = Random::from_seed(3);
    let mut both = [0, 0];
    for _ in 0..20_000 {
        let touch = random.between(-1.0, 1.0);
        let roots = [touch, touch, random.between(2.0, 3.0)];
        let scale = if random.uniform() < 0.5 { -1.0 } else { 1.0 };
        let found = cubic_roots(expand(&roots, scale), -10.0, 10.0);
        assert!(found.len() == 1 || found.len() == 3, "{found:?}");
        both[found.len() / 2] += 1;
        assert!(found[..found.len() - 1].iter().all(|x| (x - touch).abs() < 1e-6));
    }
    assert!(both[0] > 0 && both[1] > 0);
    assert_eq!(quadratic_roots([1.0, -2.0, 1.0], 0.0, 2.0).len(), 2);
    assert_eq!(quartic_roots([0.0, 0.0, 1.0, 0.0, 1.0], -1.0, 1.0).len() % 2, 0);
}

#[test]
fn random_polynomials_change_sign_once_a_root_and_nowhere_else() {
    let mut random = Random::from_seed(4);
    for _ in 0..20_000 {
        let c: [f64; 5] = std::array::from_fn(|_| random.between(-1.0, 1.0));
        let (a, b) = (-2.0, 2.0);
        let found = quartic_roots(c, a, b);
        let signs = |x: f64| horner(&c, x).0 < 0.0;
        assert_eq!(found.len() % 2 == 1, signs(a) != signs(b));
        let changes: Vec<f64> = (0..400).map(|i| a + (b - a) * i as f64 / 400.0).collect();
        for x in changes {
            let y = x + (b - a) / 400.0;
            let inside = found.iter().filter(|&&root| x < root && root <= y).count();
            assert_eq!(inside % 2 == 1, signs(x) != signs(y), "{c:?} in {x}..{y}: {found:?}");
        }
        assert!(found.windows(2).all(|pair| pair[0] <= pair[1]));
    }
}

#[test]
fn only_roots_of_the_interval_are_returned() {
    let c: [f64; 5] = expand(&[-2.0, -1.0, 1.0, 2.0], 1.0);
    assert_eq!(quartic_roots(c, -1.5, 1.5).len(), 2);
    assert_eq!(quartic_roots(c, 3.0, 9.0).len(), 0);
    assert_eq!(quartic_roots(c, 1.5, -1.5).len(), 0);
    assert_eq!(&quartic_roots(c, -1.0, 1.0)[..], [-1.0, 1.0]);
}

#[test]
fn missing_leading_coefficients_lower_the_degree() {
    assert_eq!(&quartic_roots([2.0, -3.0, 1.0, 0.0, 0.0], -9.0, 9.0)[..], [1.0, 2.0]);
    assert_eq!(&cubic_roots([-4.0, 2.0, 0.0, 0.0], -9.0, 9.0)[..], [2.0]);
    assert!(quartic_roots([0.0; 5], -9.0, 9.0).is_empty());
    let nearly = quartic_roots([2.0, -3.0, 1.0, 0.0, 1e-18], -9.0, 9.0);
    assert!(nearly.len() == 2 && (nearly[0] - 1.0).abs() < 1e-15 && (nearly[1] - 2.0).abs() < 1e-15);
}

#[test]
fn coefficients_that_are_not_finite_end_in_no_panic() {
    for bad in [f64::NAN, f64::INFINITY, f64::MAX] {
        for i in 0..5 {
            let mut c = [1.0, -2.0, 0.5, 1.0, -1.0];
            c[i] = bad;
            assert!(quartic_roots(c, -3.0, 3.0).iter().all(|x| x.abs() <= 3.0));
        }
    }
}
