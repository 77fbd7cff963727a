//! A piecewise constant density on the unit square: a row by the rows' sums, then a cell of that row.

use crate::distribution::{Distribution1d, DistributionError, pick, probability, push_bounds};
use hyaline_math::Vec2;

/// What a two-dimensional distribution chose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pick2d {
    /// Column of the chosen cell.
    pub x: usize,
    /// Row of the chosen cell.
    pub y: usize,
    /// Uniform point of the cell, in coordinates of the whole square, [0, 1)².
    pub uv: Vec2,
    /// Density at `uv` per unit area of the square, > 0.
    pub pdf: f32,
}

/// Density on [0, 1)² proportional to the weights of a grid of cells, such as an image's pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Distribution2d {
    rows: Distribution1d,
    /// `width + 1` bounds for every row; all 0 where a row has no weight.
    columns: Vec<u32>,
    width: usize,
}

impl Distribution2d {
    /// The distribution of a grid of weights.
    ///
    /// - `weights`: row by row, `width` each; an incomplete last row is left out.
    ///
    /// # Errors
    /// If a weight is negative or not finite (the index is that in `weights`), or none is above 0.
    pub fn new(width: usize, weights: &[f32]) -> Result<Self, DistributionError> {
        if width == 0 || weights.len() < width {
            return Err(DistributionError::Zero);
        }
        let grid = weights.chunks_exact(width);
        let mut columns = Vec::with_capacity(grid.len() * (width + 1));
        for (y, row) in grid.clone().enumerate() {
            match push_bounds(row.iter().map(|&w| f64::from(w)), &mut columns) {
                Ok(()) => {}
                Err(DistributionError::Zero) => columns.resize((y + 1) * (width + 1), 0),
                Err(DistributionError::Invalid(x)) => return Err(DistributionError::Invalid(y * width + x)),
            }
        }
        let sums: Vec<f64> = grid.map(|row| row.iter().map(|&w| f64::from(w)).sum()).collect();
        Ok(Self { rows: Distribution1d::from_f64(sums.iter().copied())?, columns, width })
    }

    /// Chooses a cell, and a point in it.
    ///
    /// - `u`: [0, 1)²; its second coordinate chooses the row.
    pub fn sample(&self, u: Vec2) -> Pick2d {
        let row = self.rows.sample(u.y);
        let column = pick(self.bounds(row.index), u.x);
        let (width, height) = (self.width as f32, self.rows.len() as f32);
        Pick2d {
            x: column.index,
            y: row.index,
            uv: Vec2::new(within(column.index, column.u, width), within(row.index, row.u, height)),
            pdf: row.probability * column.probability * width * height,
        }
    }

    /// Density at a point, per unit area of the square; coordinates are clamped to it.
    pub fn pdf(&self, uv: Vec2) -> f32 {
        let cell = |v: f32, n: usize| ((v.clamp(0.0, 1.0) * n as f32) as usize).min(n - 1);
        let height = self.rows.len();
        let (x, y) = (cell(uv.x, self.width), cell(uv.y, height));
        self.rows.probability(y) * probability(self.bounds(y), x) * self.width as f32 * height as f32
    }

    fn bounds(&self, row: usize) -> &[u32] {
        &self.columns[row * (self.width + 1)..][..self.width + 1]
    }
}

/// Coordinate of the fraction `u` of cell `index` of `count`, never in the next cell.
fn within(index: usize, u: f32, count: f32) -> f32 {
    let next = (index + 1) as f32 / count;
    ((index as f32 + u) / count).min(next.next_down())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;
    use hyaline_testkit::chi_square_square;

    fn checker() -> Distribution2d {
        let weights = [0.0, 1.0, 4.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.1, 0.0, 2.0, 0.0];
        Distribution2d::new(4, &weights).expect("valid")
    }

    #[test]
    fn points_follow_the_density() {
        let distribution = checker();
        let mut rng = Rng::new(1, 0);
        let sample = || {
            let pick = distribution.sample(rng.uniform_2d());
            assert_eq!(pick.pdf, distribution.pdf(pick.uv), "{pick:?}");
            [f64::from(pick.uv.x), f64::from(pick.uv.y)]
        };
        let pdf = |p: [f64; 2]| f64::from(distribution.pdf(Vec2::new(p[0] as f32, p[1] as f32)));
        let result = chi_square_square(sample, pdf, 200_000, 16, 12);
        assert!(result.p_value > 0.001, "{result:?}");
    }

    #[test]
    fn density_is_the_weight_over_the_mean_weight() {
        let distribution = checker();
        let mean = 7.6 / 12.0;
        for (x, y, weight) in [(2, 0, 4.0), (3, 0, 0.5), (0, 1, 0.0), (2, 2, 2.0), (1, 2, 0.0)] {
            let pdf = distribution.pdf(Vec2::new((x as f32 + 0.5) / 4.0, (y as f32 + 0.5) / 3.0));
            assert!((pdf - weight / mean).abs() < 1e-5, "cell {x}, {y}: {pdf}");
        }
    }

    #[test]
    fn the_chosen_cell_holds_the_chosen_point() {
        let mut rng = Rng::new(2, 0);
        let weights: Vec<f32> = (0..77 * 41).map(|_| rng.uniform()).collect();
        let distribution = Distribution2d::new(77, &weights).expect("valid");
        for i in 0..20_000 {
            let end = hyaline_math::float::ONE_MINUS_EPSILON;
            let u = if i == 0 { Vec2::splat(end) } else { rng.uniform_2d() };
            let pick = distribution.sample(u);
            let cell = ((pick.uv.x * 77.0) as usize, (pick.uv.y * 41.0) as usize);
            assert_eq!(cell, (pick.x, pick.y));
        }
    }

    #[test]
    fn grids_without_a_distribution_are_refused() {
        assert_eq!(Distribution2d::new(0, &[]), Err(DistributionError::Zero));
        assert_eq!(Distribution2d::new(3, &[1.0]), Err(DistributionError::Zero));
        assert_eq!(Distribution2d::new(2, &[0.0; 4]), Err(DistributionError::Zero));
        assert_eq!(Distribution2d::new(2, &[1.0, 0.0, 0.0, -1.0]), Err(DistributionError::Invalid(3)));
    }
}
