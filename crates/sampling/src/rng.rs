//! A small generator of independent random numbers, one per stream.

use crate::hash::{GOLDEN, combine, mix64, unit_f32};
use hyaline_math::Vec2;

/// SplitMix64 with a step of its own for every stream.
///
/// Source: Steele, Lea & Flood, Fast splittable pseudorandom number generators, OOPSLA 2014.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rng {
    counter: u64,
    step: u64,
}

impl Rng {
    /// The stream numbered `stream` of `seed`; any two differ as if drawn by different generators.
    pub fn new(seed: u64, stream: u64) -> Self {
        let key = combine(combine(GOLDEN, seed), stream);
        Self { counter: key, step: step_from_bits(mix64(key ^ GOLDEN)) }
    }

    /// The next 64 random bits.
    #[inline]
    pub fn next_u64(&mut self) -> u64 {
        self.counter = self.counter.wrapping_add(self.step);
        mix64(self.counter)
    }

    /// Uniform in [0, 1), a multiple of 2⁻²⁴.
    #[inline]
    pub fn uniform(&mut self) -> f32 {
        unit_f32((self.next_u64() >> 32) as u32)
    }

    /// Uniform in the unit square, both coordinates in [0, 1).
    #[inline]
    pub fn uniform_2d(&mut self) -> Vec2 {
        let bits = self.next_u64();
        Vec2::new(unit_f32((bits >> 32) as u32), unit_f32(bits as u32))
    }

    /// Uniform in 0…n-1; 0 for `n` = 0.
    ///
    /// The chances of two values differ by less than 2⁻³² of their size.
    /// Source: Lemire, Fast random integer generation in an interval, TOMACS 29(1), 2019, without the rejection.
    #[inline]
    pub fn below(&mut self, n: u32) -> u32 {
        ((u128::from(self.next_u64()) * u128::from(n)) >> 64) as u32
    }
}

/// An odd step with enough changes between neighboring bits to advance the counter irregularly.
fn step_from_bits(bits: u64) -> u64 {
    let step = bits | 1;
    // [Steele 2014, mixGamma]
    if (step ^ (step >> 1)).count_ones() < 24 { step ^ 0xaaaa_aaaa_aaaa_aaaa } else { step }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_testkit::{chi_square, chi_square_square};

    #[test]
    fn numbers_are_uniform_in_the_unit_square() {
        let mut rng = Rng::new(1, 2);
        let point = || {
            let p = rng.uniform_2d();
            [f64::from(p.x), f64::from(p.y)]
        };
        assert!(chi_square_square(point, |_| 1.0, 200_000, 32, 32).p_value > 0.001);
    }

    #[test]
    fn successive_numbers_are_independent() {
        let mut rng = Rng::new(0, 0);
        let pair = || [f64::from(rng.uniform()), f64::from(rng.uniform())];
        assert!(chi_square_square(pair, |_| 1.0, 200_000, 32, 32).p_value > 0.001);
    }

    #[test]
    fn neighboring_streams_and_seeds_are_independent() {
        for neighbor in [|i| Rng::new(7, i), |i| Rng::new(i, 7)] {
            let mut stream = 0;
            let pair = || {
                stream += 1;
                [f64::from(neighbor(stream).uniform()), f64::from(neighbor(stream + 1).uniform())]
            };
            assert!(chi_square_square(pair, |_| 1.0, 200_000, 32, 32).p_value > 0.001);
        }
    }

    #[test]
    fn integers_below_a_bound_are_equally_likely() {
        let mut rng = Rng::new(3, 0);
        let mut counts = [0.0; 7];
        for _ in 0..70_000 {
            counts[rng.below(7) as usize] += 1.0;
        }
        assert!(chi_square(&counts, &[10_000.0; 7], 5.0).p_value > 0.001);
        assert_eq!((rng.below(0), rng.below(1)), (0, 0));
    }
}
