//! Pearson's chi-square test: do samples follow the density that claims to be theirs?
//!
//! Samples are counted in cells, the density is integrated over each cell, cells too sparse for the test are pooled,
//! and the statistic's tail probability is the result. Source: Pearson, Philosophical Magazine 50, 1900.

use crate::quadrature::{integrate_adaptive, spherical};
use crate::special::gamma_q;
use std::f64::consts::{PI, TAU};

/// Least expected count of a pooled cell, the usual rule for the chi-square approximation.
const MIN_EXPECTED: f64 = 5.0;

/// Error of an integrated expected count that the statistic does not notice.
const COUNT_TOLERANCE: f64 = 0.05;

/// Outcome of a chi-square test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChiSquare {
    /// Σ (observed - expected)² / expected over the pooled cells; infinite where the impossible was observed.
    pub statistic: f64,
    /// Pooled cells less one.
    pub degrees_of_freedom: usize,
    /// Chance of a statistic at least this large if the density is right, 0…1.
    pub p_value: f64,
}

impl ChiSquare {
    /// The impossible was observed.
    const IMPOSSIBLE: Self = Self { statistic: f64::INFINITY, degrees_of_freedom: 0, p_value: 0.0 };
}

/// Compares counts with what was expected.
///
/// - `observed`, `expected`: counts per cell, same length, of about the same sum.
/// - `min_expected`: cells expected to hold less are pooled, sparsest first, until they hold this much; 5 is usual.
///
/// A cell with an expectation of exactly 0 that was hit gives a p-value of 0; one that was not hit is left out.
///
/// # Panics
/// Where the lengths differ, a count is negative or not finite, or fewer than two cells remain (nothing is tested).
pub fn chi_square(observed: &[f64], expected: &[f64], min_expected: f64) -> ChiSquare {
    assert_eq!(observed.len(), expected.len(), "observed and expected cells must match");
    let valid = |count: &f64| count.is_finite() && *count >= 0.0;
    assert!(observed.iter().chain(expected).all(valid), "counts must be finite and not negative");
    let mut cells: Vec<(f64, f64)> = expected.iter().copied().zip(observed.iter().copied()).collect();
    if cells.iter().any(|&(expected, observed)| expected == 0.0 && observed > 0.0) {
        return ChiSquare::IMPOSSIBLE;
    }
    cells.retain(|&(expected, _)| expected > 0.0);
    cells.sort_by(|a, b| a.0.total_cmp(&b.0));
    let pools = pool(&cells, min_expected);
    assert!(
        pools.len() >= 2,
        "fewer than two cells expect {min_expected} samples: take more samples or cells"
    );
    let statistic = pools.iter().map(|(expected, observed)| (observed - expected).powi(2) / expected).sum();
    let degrees_of_freedom = pools.len() - 1;
    ChiSquare {
        statistic,
        degrees_of_freedom,
        p_value: gamma_q(0.5 * degrees_of_freedom as f64, 0.5 * statistic),
    }
}

/// Tests a sampler of directions against its density.
///
/// - `samples`: draws a unit direction, or `None` where the sampler fails; failures are expected to make up what the
///   density leaves of 1.
/// - `pdf`: density per solid angle, sr⁻¹; it may jump, but peaks should not be much narrower than a cell.
/// - `theta_bins`, `phi_bins`: cells in the polar angle from +z and in the azimuth. An even `theta_bins` puts a cell
///   border on the equator, where most densities end.
///
/// A sample that is not finite, or lies in a cell where the density is 0 throughout, gives a p-value of 0.
///
/// # Panics
/// As `chi_square` does.
pub fn chi_square_sphere(
    mut samples: impl FnMut() -> Option<[f64; 3]>,
    pdf: impl Fn([f64; 3]) -> f64,
    sample_count: usize,
    theta_bins: usize,
    phi_bins: usize,
) -> ChiSquare {
    let grid = Grid { x: [0.0, PI], y: [0.0, TAU], nx: theta_bins, ny: phi_bins };
    grid.test(|| samples().map(spherical_angles), spherical(pdf), sample_count)
}

/// Tests a sampler of points in the unit square against its density.
///
/// - `pdf`: density per unit area; it may jump, but peaks should not be much narrower than a cell.
/// - `nx`, `ny`: cells along each axis.
///
/// A sample outside the square gives a p-value of 0.
///
/// # Panics
/// As `chi_square` does.
pub fn chi_square_square(
    mut samples: impl FnMut() -> [f64; 2],
    pdf: impl Fn([f64; 2]) -> f64,
    sample_count: usize,
    nx: usize,
    ny: usize,
) -> ChiSquare {
    let grid = Grid { x: [0.0, 1.0], y: [0.0, 1.0], nx, ny };
    grid.test(|| Some(samples()), |x, y| pdf([x, y]), sample_count)
}

/// Neighbors in order of expectation, joined until each group expects `min_expected`; pairs (expected, observed).
fn pool(cells: &[(f64, f64)], min_expected: f64) -> Vec<(f64, f64)> {
    let mut pools: Vec<(f64, f64)> = Vec::new();
    let mut open = (0.0, 0.0);
    for cell in cells {
        open = (open.0 + cell.0, open.1 + cell.1);
        if open.0 >= min_expected {
            pools.push(std::mem::take(&mut open));
        }
    }
    if let Some(last) = pools.last_mut() {
        *last = (last.0 + open.0, last.1 + open.1);
    }
    pools
}

/// Polar angle from +z and azimuth in 0…2π.
#[allow(
    clippy::disallowed_methods,
    reason = "statistics never reach a picture, and this crate has no dependency"
)]
fn spherical_angles([x, y, z]: [f64; 3]) -> [f64; 2] {
    // atan2 keeps its precision at the poles, where acos(z) does not.
    [x.hypot(y).atan2(z), y.atan2(x).rem_euclid(TAU)]
}

/// A rectangle in `nx × ny` cells.
struct Grid {
    x: [f64; 2],
    y: [f64; 2],
    nx: usize,
    ny: usize,
}

impl Grid {
    fn test(
        &self,
        mut samples: impl FnMut() -> Option<[f64; 2]>,
        pdf: impl Fn(f64, f64) -> f64,
        sample_count: usize,
    ) -> ChiSquare {
        let mut observed = vec![0.0; self.nx * self.ny];
        let mut lost = 0.0;
        for _ in 0..sample_count {
            match samples().map(|p| self.cell(p)) {
                None => lost += 1.0,
                Some(Some(cell)) => observed[cell] += 1.0,
                Some(None) => return ChiSquare::IMPOSSIBLE,
            }
        }
        let mut expected = self.expected(pdf, sample_count as f64);
        // Never exactly 0, so that quadrature error does not turn a single lost sample into an impossibility: a few
        // are pooled with the sparsest cells, many still fail.
        let remainder = sample_count as f64 - expected.iter().sum::<f64>();
        expected.push(remainder.max(f64::MIN_POSITIVE));
        observed.push(lost);
        chi_square(&observed, &expected, MIN_EXPECTED)
    }

    /// The cell that holds the point, if one does.
    fn cell(&self, p: [f64; 2]) -> Option<usize> {
        let index = |v: f64, [low, high]: [f64; 2], n: usize| {
            let inside = (low..=high).contains(&v);
            inside.then(|| (((v - low) / (high - low) * n as f64) as usize).min(n - 1))
        };
        Some(index(p[0], self.x, self.nx)? * self.ny + index(p[1], self.y, self.ny)?)
    }

    /// Expected count of each cell.
    fn expected(&self, pdf: impl Fn(f64, f64) -> f64, sample_count: f64) -> Vec<f64> {
        let edge = |[low, high]: [f64; 2], i: usize, n: usize| low + (high - low) * i as f64 / n as f64;
        let interval = |range: [f64; 2], i: usize, n: usize| [edge(range, i, n), edge(range, i + 1, n)];
        let density = |x: f64, y: f64| sample_count * pdf(x, y);
        let cells = (0..self.nx).flat_map(|i| (0..self.ny).map(move |j| (i, j)));
        cells
            .map(|(i, j)| {
                let (x, y) = (interval(self.x, i, self.nx), interval(self.y, j, self.ny));
                integrate_adaptive(&density, x, y, COUNT_TOLERANCE)
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Moments, Random};

    /// Cosine-weighted direction about +z, for `u` and `v` in [0, 1).
    #[allow(
        clippy::disallowed_methods,
        reason = "tests never reach a picture, and this crate has no dependency"
    )]
    fn cosine_direction(u: f64, v: f64) -> [f64; 3] {
        let (sin_phi, cos_phi) = (TAU * v).sin_cos();
        [u.sqrt() * cos_phi, u.sqrt() * sin_phi, (1.0 - u).sqrt()]
    }

    #[test]
    fn a_fair_die_has_its_textbook_statistic() {
        let result = chi_square(&[5.0, 8.0, 9.0, 8.0, 10.0, 20.0], &[10.0; 6], 5.0);
        assert!((result.statistic - 13.4).abs() < 1e-12);
        assert_eq!(result.degrees_of_freedom, 5);
        assert!((result.p_value - 0.019_905).abs() < 1e-6, "{}", result.p_value);
    }

    #[test]
    fn sparse_cells_are_pooled_and_none_is_dropped() {
        let result = chi_square(&[3.0, 1.0, 2.0, 20.0, 0.0], &[2.0, 2.0, 2.0, 20.0, 0.0], 5.0);
        assert_eq!((result.degrees_of_freedom, result.statistic), (1, 0.0));
        let shortfall = chi_square(&[0.0, 50.0, 58.0], &[4.0, 50.0, 54.0], 5.0);
        assert!(shortfall.statistic > 0.0);
    }

    #[test]
    fn observing_the_impossible_is_refused() {
        assert_eq!(chi_square(&[50.0, 50.0, 1.0], &[50.0, 50.0, 0.0], 5.0).p_value, 0.0);
        assert_eq!(chi_square_square(|| [0.5, 1.5], |_| 1.0, 100, 2, 2).p_value, 0.0);
        assert_eq!(chi_square_sphere(|| Some([f64::NAN, 0.0, 1.0]), |_| 1.0, 100, 2, 2).p_value, 0.0);
    }

    #[test]
    #[should_panic(expected = "fewer than two cells")]
    fn a_test_that_decides_nothing_panics() {
        chi_square(&[1.0, 1.0], &[1.0, 1.0], 5.0);
    }

    #[test]
    fn p_values_are_uniform_for_a_right_density() {
        let mut random = Random::from_seed(3);
        let p: Moments = (0..200)
            .map(|_| {
                let sample = || [random.uniform().sqrt(), random.uniform()];
                chi_square_square(sample, |p| 2.0 * p[0], 4000, 8, 4).p_value
            })
            .collect();
        assert!((p.mean() - 0.5).abs() < 0.08, "mean {}", p.mean());
        assert!((p.variance() - 1.0 / 12.0).abs() < 0.02, "variance {}", p.variance());
    }

    #[test]
    fn cosine_directions_pass_and_their_tilted_density_fails() {
        let mut random = Random::from_seed(4);
        let mut sample = || Some(cosine_direction(random.uniform(), random.uniform()));
        let right = chi_square_sphere(&mut sample, |d| d[2].max(0.0) / PI, 100_000, 20, 40);
        assert!(right.p_value > 0.001, "{right:?}");
        let tilted = |d: [f64; 3]| if d[2] > 0.0 { (d[2] + 0.05 * d[0]).max(0.0) / PI } else { 0.0 };
        let wrong = chi_square_sphere(&mut sample, tilted, 100_000, 20, 40);
        assert!(wrong.p_value < 1e-6, "{wrong:?}");
    }

    #[test]
    fn lost_samples_must_be_what_the_density_leaves_of_one() {
        let mut random = Random::from_seed(5);
        let mut sample = || {
            let d = cosine_direction(random.uniform(), random.uniform());
            (random.uniform() < 0.75).then_some(d)
        };
        let right = chi_square_sphere(&mut sample, |d| 0.75 * d[2].max(0.0) / PI, 50_000, 10, 10);
        assert!(right.p_value > 0.001, "{right:?}");
        let wrong = chi_square_sphere(&mut sample, |d| d[2].max(0.0) / PI, 50_000, 10, 10);
        assert!(wrong.p_value < 1e-6, "{wrong:?}");
    }
}
