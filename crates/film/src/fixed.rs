//! Fixed-point numbers whose sums are exact, so that addition is associative.
//!
//! A radiance is rounded once, to a multiple of 2⁻⁴⁸ (3.6e-15), and limited to ±2³⁹ (5.5e11); every `f32` from
//! 6e-8 up to the limit is kept exactly. Its square is a multiple of 2⁻⁸⁰. With at most 2³² passes the sums stay below
//! 2³⁹⁺⁴⁸⁺³² = 2¹¹⁹ and 2⁷⁸⁺⁸⁰⁺³² = 2¹⁹⁰, so they overflow neither 128 nor 192 bits and no sum ever saturates,
//! which would spoil the associativity.

/// 2⁴⁸: steps per unit of a sum.
const STEPS: f64 = (1_u64 << 48) as f64;

/// Largest magnitude of one sample.
pub(crate) const LIMIT: f32 = (1_u64 << 39) as f32;

/// 2⁶⁴.
const LIMB: f64 = 18_446_744_073_709_551_616.0;

/// 2³⁰: steps per unit of a sum of unit vectors or reflectances.
const UNIT_STEPS: f64 = (1_u64 << 30) as f64;

/// A finite sample in steps of 2⁻⁴⁸.
#[inline]
pub(crate) fn to_fixed(value: f32) -> i128 {
    let steps = (f64::from(value.clamp(-LIMIT, LIMIT)) * STEPS).round_ties_even();
    // Most values fit into 63 bits, where the conversion is one instruction.
    if steps.abs() < 9e18 { i128::from(steps as i64) } else { steps as i128 }
}

/// The number of so many steps of 2⁻⁴⁸.
pub(crate) fn from_fixed(sum: i128) -> f64 {
    sum as f64 / STEPS
}

/// A finite component of -1…1 in steps of 2⁻³⁰; 2³² of them fit into an `i64`.
#[inline]
pub(crate) fn to_fixed_unit(value: f32) -> i64 {
    (f64::from(value.clamp(-1.0, 1.0)) * UNIT_STEPS).round_ties_even() as i64
}

/// The number of so many steps of 2⁻³⁰.
pub(crate) fn from_fixed_unit(sum: i64) -> f64 {
    sum as f64 / UNIT_STEPS
}

/// A sum of squares: 192 bits, lowest limb first, in steps of 2⁻⁸⁰.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct SquareSum(pub(crate) [u64; 3]);

impl SquareSum {
    /// Adds the square of a finite sample.
    #[inline]
    pub(crate) fn add_square(&mut self, value: f32) {
        // The value is mantissa · 2^exponent, so its square is an integer of 48 bits, shifted; three times as fast as by
        // way of f64.
        let bits = value.abs().min(LIMIT).to_bits();
        let biased = bits >> 23;
        let mantissa = u64::from(bits & 0x7f_ffff | u32::from(biased > 0) << 23);
        let shift = 2 * (biased.max(1) as i32 - 150) + 80;
        let square = mantissa * mantissa;
        match shift {
            ..-63 => {}
            -63..0 => self.add_low(u128::from((square + (1 << (-shift - 1))) >> -shift)),
            0..64 => self.add_low(u128::from(square) << shift),
            64.. => self.add_high(u128::from(square) << (shift - 64)),
        }
    }

    /// Adds another sum.
    pub(crate) fn add(&mut self, other: &Self) {
        self.add_low(other.0[0].into());
        self.add_high(other.high());
    }

    /// The sum as a number.
    pub(crate) fn to_f64(self) -> f64 {
        (self.high() as f64 + self.0[0] as f64 / LIMB) / 65_536.0
    }

    #[inline]
    fn add_low(&mut self, steps: u128) {
        let (sum, carry) = self.low().overflowing_add(steps);
        (self.0[0], self.0[1]) = (sum as u64, (sum >> 64) as u64);
        self.0[2] = self.0[2].wrapping_add(u64::from(carry));
    }

    #[inline]
    fn add_high(&mut self, limbs: u128) {
        let sum = self.high().wrapping_add(limbs);
        (self.0[1], self.0[2]) = (sum as u64, (sum >> 64) as u64);
    }

    fn low(&self) -> u128 {
        u128::from(self.0[1]) << 64 | u128::from(self.0[0])
    }

    fn high(&self) -> u128 {
        u128::from(self.0[2]) << 64 | u128::from(self.0[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn usual_radiances_are_exact() {
        for value in [0.0_f32, 1.0, -0.1, 1e-7, 3.3333, 65_504.0, 1e9, -1e9, LIMIT] {
            assert_eq!(from_fixed(to_fixed(value)), f64::from(value));
        }
    }

    #[test]
    fn resolution_is_below_a_billionth_and_range_above_a_billion() {
        assert!((from_fixed(to_fixed(1e-9)) / 1e-9 - 1.0).abs() < 1e-5);
        assert_eq!(to_fixed(1e30), to_fixed(LIMIT));
        assert_eq!(to_fixed(-f32::MAX), -to_fixed(LIMIT));
        assert_eq!(to_fixed(1e-20), 0);
    }

    #[test]
    fn as_many_samples_as_there_are_passes_fit() {
        assert!(to_fixed(LIMIT).checked_mul(1 << 32).is_some());
        assert!(to_fixed_unit(1.0).checked_mul(1 << 32).is_some());
        let mut sum = SquareSum::default();
        sum.add_square(LIMIT);
        for _ in 0..32 {
            let copy = sum;
            sum.add(&copy);
        }
        assert_eq!(sum.to_f64(), f64::from(LIMIT) * f64::from(LIMIT) * 4_294_967_296.0);
    }

    #[test]
    fn squares_are_exact_over_the_whole_range() {
        for value in [0.0_f32, 1.0, -0.3, 1.7e-4, 12_345.678, 8.4e6, 1e9, LIMIT] {
            let mut sum = SquareSum::default();
            sum.add_square(value);
            assert_eq!(sum.to_f64(), f64::from(value) * f64::from(value), "{value}");
        }
        let mut tiny = SquareSum::default();
        tiny.add_square(1e-9);
        assert!((tiny.to_f64() / 1e-18 - 1.0).abs() < 1e-5);
    }

    #[test]
    fn carries_pass_through_all_limbs() {
        let mut sum = SquareSum([u64::MAX, u64::MAX, 0]);
        sum.add(&SquareSum([1, 0, 0]));
        assert_eq!(sum, SquareSum([0, 0, 1]));
    }
}
