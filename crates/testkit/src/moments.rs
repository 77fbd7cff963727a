//! Running mean and variance.

/// Mean and variance of numbers that arrive one at a time.
///
/// Source: Welford, Note on a method for calculating corrected sums of squares and products, Technometrics 4(3),
/// 1962; merging by Chan, Golub & LeVeque, Updating formulae and a pairwise algorithm, 1979, eq. 2.1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    count: usize,
    mean: f64,
    /// Sum of squared distances from the mean.
    squares: f64,
}

impl Moments {
    /// No numbers yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Takes in one number.
    pub fn push(&mut self, x: f64) {
        self.count += 1;
        let delta = x - self.mean;
        self.mean += delta / self.count as f64;
        self.squares += delta * (x - self.mean);
    }

    /// Takes in all the numbers that `other` has seen.
    pub fn merge(&mut self, other: &Self) {
        if other.count == 0 {
            return;
        }
        let (n, m) = (self.count as f64, other.count as f64);
        let delta = other.mean - self.mean;
        self.count += other.count;
        self.mean += delta * m / (n + m);
        self.squares += other.squares + delta * delta * n * m / (n + m);
    }

    /// How many numbers there were.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Their mean; 0 for none.
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// Unbiased sample variance.
    ///
    /// # Panics
    /// For fewer than two numbers, which have none.
    pub fn variance(&self) -> f64 {
        assert!(self.count >= 2, "a variance needs two numbers, there are {}", self.count);
        self.squares / (self.count - 1) as f64
    }

    /// Variance of the mean as an estimate of the true mean.
    ///
    /// # Panics
    /// For fewer than two numbers.
    pub fn variance_of_mean(&self) -> f64 {
        self.variance() / self.count as f64
    }
}

impl Extend<f64> for Moments {
    fn extend<T: IntoIterator<Item = f64>>(&mut self, numbers: T) {
        numbers.into_iter().for_each(|x| self.push(x));
    }
}

impl FromIterator<f64> for Moments {
    fn from_iter<T: IntoIterator<Item = f64>>(numbers: T) -> Self {
        let mut moments = Self::new();
        moments.extend(numbers);
        moments
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_numbers_have_their_known_moments() {
        let m: Moments = [2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0].into_iter().collect();
        assert_eq!(m.count(), 8);
        assert!((m.mean() - 5.0).abs() < 1e-15);
        assert!((m.variance() - 32.0 / 7.0).abs() < 1e-14);
        assert!((m.variance_of_mean() - 4.0 / 7.0).abs() < 1e-14);
    }

    #[test]
    fn a_large_offset_does_not_hide_the_variance() {
        let m: Moments = [4.0, 7.0, 13.0, 16.0].into_iter().map(|x| 1e9 + x).collect();
        assert!((m.variance() - 30.0).abs() < 1e-6);
    }

    #[test]
    fn merged_parts_are_the_whole() {
        let numbers: Vec<f64> = (0..100).map(|i| ((i * 37) % 101) as f64 * 0.1).collect();
        let whole: Moments = numbers.iter().copied().collect();
        let mut merged = Moments::new();
        for part in numbers.chunks(17) {
            merged.merge(&part.iter().copied().collect());
        }
        assert_eq!(merged.count(), whole.count());
        assert!((merged.mean() - whole.mean()).abs() < 1e-12);
        assert!((merged.variance() - whole.variance()).abs() < 1e-12);
    }
}
