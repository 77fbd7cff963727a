//! A small random source for tests, so that a crate below `sampling` can draw numbers too.

use std::f64::consts::TAU;

/// A deterministic stream of random numbers.
///
/// Source: Steele, Lea & Flood, Fast splittable pseudorandom number generators, OOPSLA 2014 (SplitMix64).
#[derive(Clone, Debug)]
pub struct Random {
    state: u64,
}

impl Random {
    /// The stream of this seed.
    pub fn from_seed(seed: u64) -> Self {
        Self { state: seed }
    }

    /// The next 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [0, 1).
    pub fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform in [0, 1), exact in `f32`, so that it never rounds up to 1.
    pub fn uniform_f32(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / (1_u32 << 24) as f32
    }

    /// Uniform in [a, b).
    pub fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.uniform()
    }

    /// A unit vector, uniform on the sphere.
    #[allow(
        clippy::disallowed_methods,
        reason = "tests never reach a picture, and this crate has no dependency"
    )]
    pub fn direction(&mut self) -> [f64; 3] {
        let z = self.between(-1.0, 1.0);
        let (sin_phi, cos_phi) = (TAU * self.uniform()).sin_cos();
        let r = (1.0 - z * z).sqrt();
        [r * cos_phi, r * sin_phi, z]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Moments;

    #[test]
    fn uniform_numbers_have_the_moments_of_the_uniform_distribution() {
        let mut random = Random::from_seed(1);
        let m: Moments = (0..100_000).map(|_| random.uniform()).collect();
        assert!((m.mean() - 0.5).abs() < 4.0 * m.variance_of_mean().sqrt());
        assert!((m.variance() - 1.0 / 12.0).abs() < 1e-3);
    }

    #[test]
    fn the_first_number_is_that_of_the_published_generator() {
        // Output of the reference implementation for seed 1234567.
        let mut random = Random::from_seed(1_234_567);
        assert_eq!(random.bits(), 6_457_827_717_110_365_317);
        assert_eq!(random.bits(), 3_203_168_211_198_807_973);
    }
}
