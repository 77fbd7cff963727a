//! Counter-based mixing: integers in, integers out that look random, and no state in between.

/// 2⁶⁴ over the golden ratio, odd: steps by it spread counters evenly.
pub const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// A bijection of 64 bits in which every input bit flips every output bit with probability close to 1/2.
///
/// 0 is its own image; add something first where that matters.
/// Source: Steele, Lea & Flood, Fast splittable pseudorandom number generators, OOPSLA 2014, `mix64` with the
/// constants of Stafford's 13th variant of the MurmurHash3 finalizer.
#[inline]
pub const fn mix64(x: u64) -> u64 {
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// Folds `value` into `key`; the order of folding matters.
///
/// `combine(key, ·)` is a bijection for every key: equal results of one key come from equal values.
#[inline]
pub const fn combine(key: u64, value: u64) -> u64 {
    mix64(mix64(key.wrapping_add(GOLDEN)) ^ value).wrapping_add(key)
}

/// 24 bits as a number in [0, 1): the topmost 24 of `bits`, each value equally likely.
#[inline]
pub const fn unit_f32(bits: u32) -> f32 {
    // 2²⁴ equal steps are the finest that an f32 below 1 resolves everywhere, so that no value rounds up to 1.
    (bits >> 8) as f32 * (1.0 / (1_u32 << 24) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_input_bit_flips_half_of_the_output_bits() {
        for bit in 0..64 {
            let inputs = 1_u64..2000;
            let flips: u32 = inputs
                .map(|x| {
                    (mix64(x.wrapping_mul(GOLDEN)) ^ mix64(x.wrapping_mul(GOLDEN) ^ (1 << bit))).count_ones()
                })
                .sum();
            let mean = f64::from(flips) / 1999.0;
            // The standard deviation of the mean of 1999 binomial(64, 1/2) counts is 4 / sqrt(1999) = 0.09.
            assert!((mean - 32.0).abs() < 0.45, "bit {bit} flips {mean} bits on average");
        }
    }

    #[test]
    fn neighboring_keys_and_values_do_not_collide() {
        let mut all: Vec<u64> = (0..300_u64).flat_map(|a| (0..300).map(move |b| combine(a, b))).collect();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), 300 * 300);
    }

    #[test]
    fn the_largest_bits_stay_below_one() {
        assert_eq!(unit_f32(u32::MAX), hyaline_math::float::ONE_MINUS_EPSILON);
        assert_eq!(unit_f32(0), 0.0);
    }
}
