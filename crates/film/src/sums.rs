//! All that a film knows of one pixel.

use crate::fixed::{SquareSum, to_fixed, to_fixed_unit};
use crate::sample::PixelSample;

/// Exact sums over the passes of one pixel. Adding samples and merging commute and associate.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct PixelSums {
    /// Radiance, as `fixed::to_fixed`.
    pub(crate) beauty: [i128; 3],
    /// Squares of the radiance.
    pub(crate) squares: [SquareSum; 3],
    /// Reflectance, as `fixed::to_fixed_unit`.
    pub(crate) albedo: [i64; 3],
    /// Normal, as `fixed::to_fixed_unit`.
    pub(crate) normal: [i64; 3],
    /// Distance over the passes that hit something.
    pub(crate) depth: i128,
    /// Number of passes that hit something at a finite distance.
    pub(crate) hits: u64,
    /// The lowest pass that saw an object, and which.
    pub(crate) object: FirstObject,
}

impl PixelSums {
    /// Adds a sample, which must be finite.
    #[inline]
    pub(crate) fn add(&mut self, pass: u32, sample: &PixelSample) {
        for channel in 0..3 {
            self.beauty[channel] += to_fixed(sample.beauty[channel]);
            self.squares[channel].add_square(sample.beauty[channel]);
            self.albedo[channel] += to_fixed_unit(sample.albedo[channel]);
            self.normal[channel] += to_fixed_unit(sample.normal[channel]);
        }
        if let Some(depth) = sample.depth {
            self.depth += to_fixed(depth);
            self.hits += 1;
        }
        self.object = self.object.min(FirstObject::new(pass, sample.object));
    }

    /// Adds the sums of other passes. Wraps on overflow, which only a forged film can cause.
    pub(crate) fn merge(&mut self, other: &Self) {
        for channel in 0..3 {
            self.beauty[channel] = self.beauty[channel].wrapping_add(other.beauty[channel]);
            self.squares[channel].add(&other.squares[channel]);
            self.albedo[channel] = self.albedo[channel].wrapping_add(other.albedo[channel]);
            self.normal[channel] = self.normal[channel].wrapping_add(other.normal[channel]);
        }
        self.depth = self.depth.wrapping_add(other.depth);
        self.hits = self.hits.wrapping_add(other.hits);
        self.object = self.object.min(other.object);
    }
}

/// The object seen by the lowest pass that saw one; the smaller of two is the one of their union.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct FirstObject(u64);

impl FirstObject {
    /// What `pass` saw; object 0 is nothing.
    #[inline]
    fn new(pass: u32, object: u32) -> Self {
        if object == 0 { Self::default() } else { Self(u64::from(pass) << 32 | u64::from(object)) }
    }

    /// The object; 0 for none.
    pub(crate) fn id(self) -> u32 {
        if self == Self::default() { 0 } else { self.0 as u32 }
    }

    /// A number that is small for early passes, and 0 for none.
    pub(crate) fn to_code(self) -> u64 {
        self.0.wrapping_add(1)
    }

    /// The inverse of `to_code`.
    pub(crate) fn from_code(code: u64) -> Self {
        Self(code.wrapping_sub(1))
    }
}

impl Default for FirstObject {
    fn default() -> Self {
        Self(u64::MAX)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lowest_pass_that_saw_something_names_the_object() {
        let seen = |pass, object| FirstObject::new(pass, object);
        assert_eq!(seen(3, 7).min(seen(2, 9)).min(seen(0, 0)).id(), 9);
        assert_eq!(seen(0, 0).id(), 0);
        assert_eq!(FirstObject::from_code(seen(5, 6).to_code()), seen(5, 6));
        assert_eq!((FirstObject::default().to_code(), FirstObject::from_code(0).id()), (0, 0));
    }
}
