//! Where the sample points of a pixel come from: a padded, scrambled Sobol' sequence, or independent numbers.
//!
//! Sample p of a pixel is point p of its sequence, keyed by (seed, pixel, dimension): any pass can be made alone.

use crate::hash::{GOLDEN, combine, mix64, unit_f32};
use crate::sobol;
use hyaline_math::Vec2;

/// Which points a sampler gives.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SamplerKind {
    /// Owen-scrambled Sobol' points, two dimensions at a time: lowest error.
    #[default]
    Sobol,
    /// Independent uniform numbers, for statistical tests: passes are then uncorrelated.
    Independent,
}

/// The random numbers of one sample of one pixel, one dimension after the other.
///
/// A dimension is a number or a pair, whatever is drawn: `next_1d` and `next_2d` use up one each. Dimensions of one
/// sample are independent of each other; within a dimension the samples of a pixel fill the unit interval or square
/// as evenly as can be: 2ᵐ samples in a row, starting at a multiple of 2ᵐ, are a (0, m, 2)-net.
/// Source: Burley, Practical hash-based Owen scrambling, JCGT 9(4), 2020.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampler {
    key: u64,
    /// Bit reversal of the sample's number.
    reversed_index: u32,
    dimension: u32,
    kind: SamplerKind,
}

impl Sampler {
    /// The numbers of sample `pass` of a pixel.
    ///
    /// - `pixel`: column and row in the full frame, so that a crop sees the same numbers.
    pub fn new(kind: SamplerKind, seed: u64, pixel: (u32, u32), pass: u32) -> Self {
        let pixel = u64::from(pixel.1) << 32 | u64::from(pixel.0);
        let pixel_key = combine(combine(0, seed), pixel);
        let key = match kind {
            SamplerKind::Sobol => pixel_key,
            SamplerKind::Independent => combine(pixel_key, u64::from(pass)),
        };
        Self { key, reversed_index: pass.reverse_bits(), dimension: 0, kind }
    }

    /// A number in [0, 1); uses up one dimension.
    #[inline]
    pub fn next_1d(&mut self) -> f32 {
        let [a, b, _] = self.next_bits();
        match self.kind {
            SamplerKind::Sobol => unit_f32(sobol::first_dimension(sobol::shuffle(self.reversed_index, a), b)),
            SamplerKind::Independent => unit_f32(a),
        }
    }

    /// A point of the unit square, both coordinates in [0, 1); uses up one dimension.
    #[inline]
    pub fn next_2d(&mut self) -> Vec2 {
        let [a, b, c] = self.next_bits();
        match self.kind {
            SamplerKind::Sobol => {
                let index = sobol::shuffle(self.reversed_index, a);
                let (x, y) = (sobol::first_dimension(index, b), sobol::second_dimension(index, c));
                Vec2::new(unit_f32(x), unit_f32(y))
            }
            SamplerKind::Independent => Vec2::new(unit_f32(a), unit_f32(b)),
        }
    }

    /// The dimension that the next draw uses, counted from 0.
    pub fn dimension(&self) -> u32 {
        self.dimension
    }

    /// Goes on at the given dimension.
    ///
    /// An integrator that gives every bounce a block of dimensions keeps the numbers of later bounces in place when an
    /// earlier one draws fewer. Drawing one dimension twice gives the same numbers twice.
    pub fn set_dimension(&mut self, dimension: u32) {
        self.dimension = dimension;
    }

    /// A sampler for branch `branch` of the recursion at this point, at dimension 0.
    ///
    /// Its numbers are independent of this one's and of every other branch's; over the passes they are again evenly
    /// spread. This sampler is left as it is.
    pub fn fork(&self, branch: u32) -> Self {
        let branch = u64::from(branch) << 32 | u64::from(self.dimension);
        Self { key: combine(self.key ^ GOLDEN, branch), dimension: 0, ..*self }
    }

    /// Three random words for the current dimension, which is then used up.
    #[inline]
    fn next_bits(&mut self) -> [u32; 3] {
        let counter = self.key.wrapping_add(u64::from(self.dimension).wrapping_mul(GOLDEN));
        self.dimension = self.dimension.wrapping_add(1);
        let bits = mix64(counter);
        let more = mix64(counter ^ 0x5851_f42d_4c95_7f2d);
        [bits as u32, (bits >> 32) as u32, (more >> 32) as u32]
    }
}

#[cfg(test)]
mod tests;
