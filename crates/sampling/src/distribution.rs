//! Choice among numbered things, each in proportion to its weight.

use hyaline_math::float::ONE_MINUS_EPSILON;
use std::fmt;

/// Steps into which the unit interval is divided: the resolution of an `f32` just below 1.
const STEPS: u32 = 1 << 24;

/// Why weights are no distribution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DistributionError {
    /// There is no weight, or all are 0.
    Zero,
    /// The weight at this index is negative, infinite or not a number.
    Invalid(usize),
}

impl fmt::Display for DistributionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Zero => write!(f, "all weights are 0"),
            Self::Invalid(index) => write!(f, "weight {index} is negative or not finite"),
        }
    }
}

impl std::error::Error for DistributionError {}

/// What a distribution chose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pick {
    /// Index of the chosen thing.
    pub index: usize,
    /// Chance of this choice, > 0…1.
    pub probability: f32,
    /// What is left of the random number, uniform in [0, 1) again (with fewer random bits).
    pub u: f32,
}

/// A discrete distribution, and with it a piecewise constant density on [0, 1).
///
/// Chances are whole multiples of 2⁻²⁴, the steps of the random numbers, so that the reported chance is exactly the one
/// at which things are drawn. A weight above 0 gets at least one step (below four million such weights), however small
/// it is: what has a chance in the file has one in the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Distribution1d {
    /// Steps before each thing, and all of them at the end.
    bounds: Vec<u32>,
}

impl Distribution1d {
    /// The distribution of these weights, which need no particular sum.
    ///
    /// # Errors
    /// If a weight is negative or not finite, or none is above 0.
    pub fn new(weights: &[f32]) -> Result<Self, DistributionError> {
        Self::from_f64(weights.iter().map(|&w| f64::from(w)))
    }

    /// As `new`, for weights in double precision.
    ///
    /// # Errors
    /// As `new`.
    pub fn from_f64(weights: impl ExactSizeIterator<Item = f64> + Clone) -> Result<Self, DistributionError> {
        let mut bounds = Vec::with_capacity(weights.len() + 1);
        push_bounds(weights, &mut bounds)?;
        Ok(Self { bounds })
    }

    /// Number of things.
    pub fn len(&self) -> usize {
        self.bounds.len() - 1
    }

    /// Never true: there is always something to choose.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Chooses a thing.
    ///
    /// - `u`: [0, 1).
    pub fn sample(&self, u: f32) -> Pick {
        pick(&self.bounds, u)
    }

    /// Chance of `index`, 0…1; 0 beyond the end.
    pub fn probability(&self, index: usize) -> f32 {
        probability(&self.bounds, index)
    }
}

/// Appends the bounds of a distribution: 0, then the steps up to and including each weight.
pub(crate) fn push_bounds(
    weights: impl Iterator<Item = f64> + Clone,
    bounds: &mut Vec<u32>,
) -> Result<(), DistributionError> {
    if let Some(index) = weights.clone().position(|w| !(w >= 0.0 && w.is_finite())) {
        return Err(DistributionError::Invalid(index));
    }
    let positive = weights.clone().filter(|&w| w > 0.0).count();
    let largest = weights.clone().fold(0.0, f64::max);
    if largest == 0.0 {
        return Err(DistributionError::Zero);
    }
    // Scaled by the largest, so that no sum overflows.
    let total: f64 = weights.clone().map(|w| w / largest).sum();
    let floor = u32::from(positive < STEPS as usize / 4);
    let shared = f64::from(STEPS - floor * positive.min(STEPS as usize) as u32);
    let (mut sum, mut floors) = (0.0, 0);
    bounds.push(0);
    bounds.extend(weights.map(|w| {
        sum += w / largest;
        floors += floor * u32::from(w > 0.0);
        (sum / total * shared).round() as u32 + floors
    }));
    Ok(())
}

/// The thing between whose bounds `u` falls.
pub(crate) fn pick(bounds: &[u32], u: f32) -> Pick {
    let position = u.clamp(0.0, ONE_MINUS_EPSILON) * STEPS as f32;
    let step = position as u32;
    let index = (bounds.partition_point(|&bound| bound <= step) - 1).min(bounds.len() - 2);
    let width = (bounds[index + 1] - bounds[index]) as f32;
    let rest = (position - bounds[index] as f32) / width;
    Pick { index, probability: width / STEPS as f32, u: rest.min(ONE_MINUS_EPSILON) }
}

/// Chance of `index`; 0 beyond the end.
pub(crate) fn probability(bounds: &[u32], index: usize) -> f32 {
    match bounds.get(index..) {
        Some([low, high, ..]) => (high - low) as f32 / STEPS as f32,
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;
    use hyaline_testkit::chi_square;

    #[test]
    fn things_are_chosen_at_their_probabilities() {
        let weights = [0.0, 3.0, 0.0, 0.5, 1e-3, 7.0, 0.0];
        let distribution = Distribution1d::new(&weights).expect("valid");
        let mut rng = Rng::new(1, 0);
        let mut counts = [0.0; 7];
        for _ in 0..1_000_000 {
            let pick = distribution.sample(rng.uniform());
            assert_eq!(pick.probability, distribution.probability(pick.index));
            counts[pick.index] += 1.0;
        }
        let total: f64 = 10.501;
        let expected = weights.map(|w| f64::from(w) / total * 1e6);
        assert!(chi_square(&counts, &expected, 5.0).p_value > 0.001);
    }

    #[test]
    fn every_step_is_accounted_for_exactly() {
        let mut rng = Rng::new(2, 0);
        let weights: Vec<f32> =
            (0..1000).map(|i| if i % 7 == 0 { 0.0 } else { rng.uniform().powi(20) }).collect();
        let distribution = Distribution1d::new(&weights).expect("valid");
        assert_eq!(distribution.bounds[1000], STEPS);
        assert_eq!((0..1000).map(|i| f64::from(distribution.probability(i))).sum::<f64>(), 1.0);
        for (i, &weight) in weights.iter().enumerate() {
            assert_eq!(distribution.probability(i) > 0.0, weight > 0.0, "weight {i}");
        }
    }

    #[test]
    fn the_rest_of_the_random_number_is_uniform() {
        let distribution = Distribution1d::new(&[1.0, 2.0, 5.0]).expect("valid");
        let mut rng = Rng::new(3, 0);
        let mut counts = [0.0; 60];
        for _ in 0..600_000 {
            let pick = distribution.sample(rng.uniform());
            assert!((0.0..1.0).contains(&pick.u));
            counts[pick.index * 20 + (pick.u * 20.0) as usize] += 1.0;
        }
        let expected: Vec<f64> = (0..60).map(|i| 600_000.0 * [1.0, 2.0, 5.0][i / 20] / 160.0).collect();
        assert!(chi_square(&counts, &expected, 5.0).p_value > 0.001);
    }

    #[test]
    fn things_without_weight_are_never_chosen() {
        let distribution = Distribution1d::new(&[0.0, 0.0, 1e-30, 0.0, 1e30, 0.0]).expect("valid");
        assert_eq!(distribution.sample(0.0).index, 2);
        assert_eq!(distribution.sample(0.5).index, 4);
        assert_eq!(distribution.sample(ONE_MINUS_EPSILON).index, 4);
        assert_eq!(distribution.sample(1.5).index, 4);
        assert_eq!(distribution.probability(6), 0.0);
    }

    #[test]
    fn weights_without_a_distribution_are_refused() {
        assert_eq!(Distribution1d::new(&[]), Err(DistributionError::Zero));
        assert_eq!(Distribution1d::new(&[0.0, 0.0]), Err(DistributionError::Zero));
        assert_eq!(Distribution1d::new(&[1.0, f32::NAN]), Err(DistributionError::Invalid(1)));
        assert_eq!(Distribution1d::new(&[-1.0]), Err(DistributionError::Invalid(0)));
        assert_eq!(Distribution1d::new(&[1.0, f32::INFINITY]), Err(DistributionError::Invalid(1)));
    }

    #[test]
    fn huge_weights_do_not_overflow() {
        let distribution = Distribution1d::from_f64([f64::MAX, f64::MAX].into_iter()).expect("valid");
        assert_eq!(distribution.probability(0), 0.5);
    }
}
