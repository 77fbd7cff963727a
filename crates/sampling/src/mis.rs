//! Weights that combine several ways to sample the same thing: multiple importance sampling.

/// Weight of a sample drawn with density `pdf_a` that the other strategy would have drawn with `pdf_b`: lower in
/// variance than the balance heuristic where one strategy is far better than the other.
///
/// - `pdf_a`, `pdf_b`: ≥ 0, in the same measure, times the number of samples taken; infinity is allowed and wins.
///
/// Returns 0…1; 0 where `pdf_a` is 0; the weights of both strategies add up to 1. Squares of densities never occur, so
/// that nothing overflows.
/// Source: Veach, Robust Monte Carlo methods for light transport simulation, 1997, §9.2.3, the power heuristic, β = 2.
#[inline]
pub fn power(pdf_a: f32, pdf_b: f32) -> f32 {
    match ratio(pdf_a, pdf_b) {
        Some(ratio) => 1.0 / (1.0 + ratio * ratio),
        None => 0.0,
    }
}

/// `pdf_b / pdf_a`, 1 if both are infinite; `None` where the sample could not have been drawn.
#[inline]
fn ratio(pdf_a: f32, pdf_b: f32) -> Option<f32> {
    debug_assert!(pdf_a >= 0.0 && pdf_b >= 0.0, "densities {pdf_a} and {pdf_b}");
    if pdf_a == f32::INFINITY && pdf_b == f32::INFINITY {
        return Some(1.0);
    }
    (pdf_a > 0.0).then(|| pdf_b / pdf_a)
}

#[cfg(test)]
mod tests {
    use super::*;

    const DENSITIES: [f32; 9] = [0.0, 1e-45, 1e-30, 1e-3, 1.0, 7.5, 1e30, f32::MAX, f32::INFINITY];

    #[test]
    fn weights_of_both_strategies_add_up_to_one() {
        for a in DENSITIES {
            for b in DENSITIES {
                let sum = power(a, b) + power(b, a);
                let possible = a > 0.0 || b > 0.0;
                assert!((sum - f32::from(u8::from(possible))).abs() < 1e-6, "{a}, {b}: {sum}");
            }
        }
    }

    #[test]
    fn weights_are_veachs() {
        assert!((power(1.0, 3.0) - 0.1).abs() < 1e-7);
    }

    #[test]
    fn a_certain_strategy_takes_all() {
        assert_eq!((power(f32::INFINITY, 1e30), power(1e30, f32::INFINITY)), (1.0, 0.0));
        assert_eq!((power(2.0, 0.0), power(0.0, 2.0), power(0.0, 0.0)), (1.0, 0.0, 0.0));
    }
}
