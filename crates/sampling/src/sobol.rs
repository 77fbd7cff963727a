//! The two-dimensional Sobol' sequence, its Owen scrambling, and its shuffling, all by integer hashing.
//!
//! Numbers are handled with their bits reversed (the most significant binary digit in bit 0), because both the
//! generator matrices and the scramble are simplest there.

/// A random permutation of 32-bit numbers in which every bit depends on the seed and on the bits below it alone.
///
/// On bit-reversed numbers this is nested uniform (Owen) scrambling: equal leading digits stay equal.
/// Source: Laine & Karras, Stratified sampling for stochastic transparency, EGSR 2011, in the
/// form of Burley, Practical hash-based Owen scrambling, JCGT 9(4), 2020: x ^= x · even, and sums and odd products with
/// the seed; steps and multipliers of Vegdahl, Building a better LK hash, 2021, whose avalanche is the most even.
#[inline]
fn scramble_reversed(x: u32, seed: u32) -> u32 {
    let x = x ^ x.wrapping_mul(0x3d20_adea);
    let x = x.wrapping_add(seed).wrapping_mul((seed >> 16) | 1);
    let x = x ^ x.wrapping_mul(0x0552_6c56);
    x ^ x.wrapping_mul(0x53a2_2864)
}

/// Position in the sequence of the sample whose index has the bit reversal `reversed_index`.
///
/// A nested uniform scramble of the index: each aligned block of 2ᵐ samples goes to an aligned block of 2ᵐ points.
/// Source: Burley 2020.
#[inline]
pub(crate) fn shuffle(reversed_index: u32, seed: u32) -> u32 {
    scramble_reversed(reversed_index, seed).reverse_bits()
}

/// First coordinate of point `index`, Owen-scrambled, as a 32-bit fraction: van der Corput's radical inverse.
#[inline]
pub(crate) fn first_dimension(index: u32, seed: u32) -> u32 {
    scramble_reversed(index, seed).reverse_bits()
}

/// Second coordinate of point `index`, Owen-scrambled, as a 32-bit fraction.
///
/// Digit i of the plain coordinate is Σⱼ C(j, i) aⱼ mod 2 over the digits aⱼ of the index. By Lucas' theorem C(j, i) is
/// odd exactly when the bits of i are among those of j, so the matrix product is a sum over supersets: five steps.
/// Source: Sobol', On the distribution of points in a cube, USSR Comput. Math. Math. Phys. 7(4), 1967 (primitive
/// polynomial x + 1, whose generator matrix is Pascal's triangle mod 2).
#[inline]
pub(crate) fn second_dimension(index: u32, seed: u32) -> u32 {
    let mut digits = index;
    digits ^= (digits >> 1) & 0x5555_5555;
    digits ^= (digits >> 2) & 0x3333_3333;
    digits ^= (digits >> 4) & 0x0f0f_0f0f;
    digits ^= (digits >> 8) & 0x00ff_00ff;
    digits ^= digits >> 16;
    scramble_reversed(digits, seed).reverse_bits()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;

    /// Pascal's triangle mod 2 row by row, the slow way.
    fn second_dimension_by_matrix(index: u32) -> u32 {
        let mut direction = 1_u32 << 31;
        let mut point = 0;
        for bit in 0..32 {
            if index >> bit & 1 == 1 {
                point ^= direction;
            }
            direction ^= direction >> 1;
        }
        point
    }

    #[test]
    fn superset_sums_are_the_generator_matrix() {
        let mut rng = Rng::new(5, 0);
        for _ in 0..1000 {
            let index = rng.next_u64() as u32;
            // Undo the scramble with seed 0 by scrambling the expectation in the same way.
            let expected =
                scramble_reversed(second_dimension_by_matrix(index).reverse_bits(), 0).reverse_bits();
            assert_eq!(second_dimension(index, 0), expected);
        }
    }

    #[test]
    fn scrambling_keeps_equal_leading_digits_equal() {
        let mut rng = Rng::new(6, 0);
        for _ in 0..1000 {
            let (a, b, seed) = (rng.next_u64() as u32, rng.next_u64() as u32, rng.next_u64() as u32);
            let digits = rng.below(31) + 1;
            let mask = u32::MAX >> (32 - digits);
            let same_start = (b & !mask) | (a & mask);
            let (sa, sb) = (scramble_reversed(a, seed), scramble_reversed(same_start, seed));
            assert_eq!(sa & mask, sb & mask);
        }
    }

    #[test]
    fn scrambling_flips_every_digit_about_half_the_time() {
        let mut rng = Rng::new(7, 0);
        let mut flips = [0_u32; 32];
        for _ in 0..20_000 {
            let (x, seed) = (rng.next_u64() as u32, rng.next_u64() as u32);
            let flipped = x ^ scramble_reversed(x, seed);
            (0..32).for_each(|bit| flips[bit] += flipped >> bit & 1);
        }
        // Four standard deviations of a share of 20 000 fair flips are 0.014.
        assert!(flips.iter().all(|&n| (f64::from(n) / 20_000.0 - 0.5).abs() < 0.014), "{flips:?}");
    }
}
