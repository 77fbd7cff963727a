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
    let steps = rounded(f64::from(value.clamp(-LIMIT, LIMIT)) * STEPS);
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
    rounded(f64::from(value.clamp(-1.0, 1.0)) * UNIT_STEPS) as i64
}

/// The number of so many steps of 2⁻³⁰.
pub(crate) fn from_fixed_unit(sum: i64) -> f64 {
    sum as f64 / UNIT_STEPS
}

/// The nearest integer, even ones at ties, of a number of at most 50 significant bits.
///
/// Twice as fast as the library's `round_ties_even`, which is a function call on plain x86-64.
#[inline]
fn rounded(x: f64) -> f64 {
    // Beside 1.5 · 2⁵² an f64 has no bits for fractions; above 2⁵⁰ there are none to begin with.
    const PUSH: f64 = 6_755_399_441_055_744.0;
    if x.abs() < (1_u64 << 50) as f64 { (x + PUSH) - PUSH } else { x }
}

/// A sum of squares: 192 bits, lowest limb first, in steps of 2⁻⁸⁰.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct SquareSum(pub(crate) [u64; 3]);

impl SquareSum {
    /// Adds the square of a finite sample.
    #[inline]
    pub(crate) fn add_square(&mut self, value: f32) {
        let value = f64::from(value.clamp(-LIMIT, LIMIT));
        // 2¹⁶ steps per unit of the middle limb. The square of an f32 is exact in f64, and so is scaling.
        let upper = value * value * 65_536.0;
        let high = if upper < 9e18 { u128::from(upper as u64) } else { upper as u128 };
        // A remainder of 53 bits is at most 1 - 2⁻⁵³, so it never rounds up to a whole limb.
        let low = rounded((upper - high as f64) * LIMB) as u64;
        self.add(&Self::from_parts(low, high));
    }

    /// Adds another sum.
    #[inline]
    pub(crate) fn add(&mut self, other: &Self) {
        let (low, carry) = self.0[0].overflowing_add(other.0[0]);
        let high = self.high().wrapping_add(other.high()).wrapping_add(u128::from(carry));
        *self = Self::from_parts(low, high);
    }

    /// The sum as a number.
    pub(crate) fn to_f64(self) -> f64 {
        (self.high() as f64 + self.0[0] as f64 / LIMB) / 65_536.0
    }

    fn from_parts(low: u64, high: u128) -> Self {
        Self([low, high as u64, (high >> 64) as u64])
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
    fn rounding_is_to_the_nearest_with_ties_to_even() {
        for i in -4000..4000 {
            let x = f64::from(i) / 8.0;
            assert_eq!(rounded(x), x.round_ties_even());
            assert_eq!(rounded(x * 1e12), (x * 1e12).round_ties_even());
        }
        assert_eq!(rounded(2.0_f64.powi(80)), 2.0_f64.powi(80));
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
