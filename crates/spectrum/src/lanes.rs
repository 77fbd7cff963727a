//! Radiance in lanes: what transport carries along a path.

use hyaline_math::{Vec4, float};
use std::ops::{Add, AddAssign, Div, Index, Mul, MulAssign, Sub};

/// Four lanes of a spectral quantity; only the first `World::lanes` of them mean something, the rest are 0 in
/// light and 1 or 0 in factors, and never reach a mean or a choice.
///
/// In `rgb` mode lanes 0 to 2 are linear Rec. 709.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spectrum(Vec4);

impl Spectrum {
    /// No light.
    pub const ZERO: Self = Self(Vec4::ZERO);
    /// The factor that changes nothing.
    pub const ONE: Self = Self(Vec4::ONE);

    /// All lanes alike.
    pub const fn splat(value: f32) -> Self {
        Self(Vec4::splat(value))
    }

    /// From the four lanes.
    pub const fn from_lanes(lanes: [f32; 4]) -> Self {
        Self(Vec4::from_array(lanes))
    }

    /// The four lanes.
    pub const fn to_lanes(self) -> [f32; 4] {
        self.0.to_array()
    }

    /// From linear Rec. 709, for `rgb` mode; lane 3 is 0.
    pub const fn from_rgb([r, g, b]: [f32; 3]) -> Self {
        Self::from_lanes([r, g, b, 0.0])
    }

    /// Linear Rec. 709, in `rgb` mode.
    pub const fn to_rgb(self) -> [f32; 3] {
        let [r, g, b, _] = self.to_lanes();
        [r, g, b]
    }

    /// Mean over the first `lanes` lanes.
    pub fn mean(self, lanes: usize) -> f32 {
        self.to_lanes()[..lanes].iter().sum::<f32>() / lanes as f32
    }

    /// Largest of the first `lanes` lanes.
    pub fn max_lane(self, lanes: usize) -> f32 {
        self.to_lanes()[..lanes].iter().fold(f32::NEG_INFINITY, |a, &b| a.max(b))
    }

    /// Whether every lane is exactly 0.
    pub fn is_zero(self) -> bool {
        self.0 == Vec4::ZERO
    }

    /// Whether every lane is a finite number.
    pub fn is_finite(self) -> bool {
        self.0.is_finite()
    }

    /// e to the power of each lane.
    pub fn exp(self) -> Self {
        Self(Vec4::from_array(self.to_lanes().map(float::exp)))
    }

    /// Each lane mapped by `f`.
    pub fn map(self, f: impl FnMut(f32) -> f32) -> Self {
        Self(Vec4::from_array(self.to_lanes().map(f)))
    }
}

impl Add for Spectrum {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Sub for Spectrum {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl AddAssign for Spectrum {
    fn add_assign(&mut self, other: Self) {
        self.0 += other.0;
    }
}

impl Mul for Spectrum {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

impl Mul<f32> for Spectrum {
    type Output = Self;
    fn mul(self, factor: f32) -> Self {
        Self(self.0 * factor)
    }
}

impl MulAssign for Spectrum {
    fn mul_assign(&mut self, other: Self) {
        self.0 *= other.0;
    }
}

impl MulAssign<f32> for Spectrum {
    fn mul_assign(&mut self, factor: f32) {
        self.0 *= factor;
    }
}

impl Div<f32> for Spectrum {
    type Output = Self;
    fn div(self, divisor: f32) -> Self {
        Self(self.0 / divisor)
    }
}

impl Index<usize> for Spectrum {
    type Output = f32;
    fn index(&self, lane: usize) -> &f32 {
        &self.0.as_ref()[lane]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lanes_beyond_the_count_do_not_reach_means() {
        let s = Spectrum::from_lanes([1.0, 2.0, 3.0, 1000.0]);
        assert_eq!(s.mean(3), 2.0);
        assert_eq!(s.max_lane(3), 3.0);
        assert_eq!(s.mean(4), 251.5);
    }

    #[test]
    fn colors_pass_through_the_first_three_lanes() {
        let s = Spectrum::from_rgb([0.1, 0.2, 0.3]);
        assert_eq!(s.to_lanes(), [0.1, 0.2, 0.3, 0.0]);
        assert_eq!(s.to_rgb(), [0.1, 0.2, 0.3]);
    }
}
