//! Ranges of numbers, with words for messages.

/// Largest coordinate or length: beyond it squares and products leave the range of `f32`.
pub(crate) const LARGEST_LENGTH: f64 = 1e15;
/// Smallest length that is not taken for zero.
pub(crate) const SMALLEST_LENGTH: f64 = 1e-15;

/// An interval that a value must lie in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Limits {
    low: f64,
    high: f64,
    low_is_open: bool,
    high_is_open: bool,
}

impl Limits {
    /// Every finite number.
    pub(crate) const ANY: Self = Self::from(f64::NEG_INFINITY);
    /// Above 0.
    pub(crate) const POSITIVE: Self = Self::above(0.0);
    /// 0 or more.
    pub(crate) const NOT_NEGATIVE: Self = Self::from(0.0);
    /// 0…1.
    pub(crate) const FRACTION: Self = Self::between(0.0, 1.0);
    /// 0…1 without 0.
    pub(crate) const TRANSMITTANCE: Self = Self { low_is_open: true, ..Self::FRACTION };

    /// `low` or more.
    pub(crate) const fn from(low: f64) -> Self {
        Self { low, high: f64::INFINITY, low_is_open: false, high_is_open: true }
    }

    /// More than `low`.
    pub(crate) const fn above(low: f64) -> Self {
        Self { low_is_open: true, ..Self::from(low) }
    }

    /// `low` to `high`, both included.
    pub(crate) const fn between(low: f64, high: f64) -> Self {
        Self { low, high, low_is_open: false, high_is_open: false }
    }

    /// Between `low` and `high`, neither included.
    pub(crate) const fn inside(low: f64, high: f64) -> Self {
        Self { low, high, low_is_open: true, high_is_open: true }
    }

    /// Above `low` and up to `high`.
    pub(crate) const fn above_to(low: f64, high: f64) -> Self {
        Self { low, high, low_is_open: true, high_is_open: false }
    }

    /// Whether `value` is finite and within.
    pub(crate) fn contain(&self, value: f64) -> bool {
        let low = if self.low_is_open { value > self.low } else { value >= self.low };
        let high = if self.high_is_open { value < self.high } else { value <= self.high };
        value.is_finite() && low && high
    }

    /// The range in words, to be put after "must be".
    pub(crate) fn words(&self) -> String {
        let (low, high) = (self.low, self.high);
        match (low.is_finite(), high.is_finite()) {
            (false, false) => "a finite number".to_owned(),
            (true, false) if self.low_is_open => format!("above {low}"),
            (true, false) => format!("{low} or more"),
            (false, true) => format!("at most {high}"),
            (true, true) => match (self.low_is_open, self.high_is_open) {
                (false, false) => format!("from {low} to {high}"),
                (true, true) => format!("between {low} and {high}, neither included"),
                (true, false) => format!("above {low} and at most {high}"),
                (false, true) => format!("at least {low} and below {high}"),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_belong_or_do_not() {
        assert!(!Limits::POSITIVE.contain(0.0));
        assert!(Limits::NOT_NEGATIVE.contain(0.0));
        assert!(Limits::TRANSMITTANCE.contain(1.0) && !Limits::TRANSMITTANCE.contain(0.0));
        assert!(!Limits::inside(-1.0, 1.0).contain(1.0));
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(!Limits::ANY.contain(bad));
        }
    }

    #[test]
    fn words_tell_the_range() {
        assert_eq!(Limits::POSITIVE.words(), "above 0");
        assert_eq!(Limits::TRANSMITTANCE.words(), "above 0 and at most 1");
        assert_eq!(Limits::ANY.words(), "a finite number");
    }
}
