//! Why a shape can't be built.

use std::fmt;

/// Why a shape can't be built; the message names the quantity, its value and the remedy.
#[derive(Clone, Debug, PartialEq)]
pub enum ShapeError {
    /// A number is outside its range.
    OutOfRange {
        /// What it measures.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// What to give instead.
        remedy: String,
    },
    /// A profile has too few points.
    TooFewPoints {
        /// How many it has.
        count: usize,
    },
    /// A profile crosses or touches itself.
    CrossesItself {
        /// Which profile.
        profile: &'static str,
        /// Number of one of the pieces that meet, from 0.
        first: usize,
        /// Number of the other.
        second: usize,
        /// Where: (radius, height).
        at: [f64; 2],
        /// What to do about it.
        remedy: &'static str,
    },
}

impl ShapeError {
    /// A number outside its range.
    pub fn out_of_range(quantity: &'static str, value: f64, remedy: impl Into<String>) -> Self {
        Self::OutOfRange { quantity, value, remedy: remedy.into() }
    }
}

impl fmt::Display for ShapeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfRange { quantity, value, remedy } => write!(f, "{quantity} is {value}: {remedy}"),
            Self::TooFewPoints { count } => {
                write!(f, "the profile has {count} distinct points: give at least 2")
            }
            Self::CrossesItself { profile, first, second, at: [r, y], remedy } => write!(
                f,
                "{profile} meets itself near radius {r}, height {y} (pieces {first} and {second}): {remedy}"
            ),
        }
    }
}

impl std::error::Error for ShapeError {}

/// `value` where it is finite and above 0.
pub(crate) fn positive(quantity: &'static str, value: f64) -> Result<f64, ShapeError> {
    if value.is_finite() && value > 0.0 {
        Ok(value)
    } else {
        Err(ShapeError::out_of_range(quantity, value, "give a finite number above 0"))
    }
}

/// `value` where it is finite and not below 0.
pub(crate) fn not_negative(quantity: &'static str, value: f64) -> Result<f64, ShapeError> {
    if value.is_finite() && value >= 0.0 {
        Ok(value)
    } else {
        Err(ShapeError::out_of_range(quantity, value, "give a finite number not below 0"))
    }
}

/// `value` where it is finite.
pub(crate) fn finite(quantity: &'static str, value: f64) -> Result<f64, ShapeError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(ShapeError::out_of_range(quantity, value, "give a finite number"))
    }
}
