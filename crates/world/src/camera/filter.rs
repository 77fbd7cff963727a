//! Pixel filters, sampled in proportion to their value, so that each sample belongs to one pixel with weight 1.
//!
//! Source: Ernst, Stamminger, Greiner, Filter Importance Sampling, IEEE Symposium on Interactive Ray Tracing 2006.

use hyaline_math::{Vec2, float::f64 as float};
use hyaline_scene::PixelFilter as FilterDescription;
use std::f64::consts::TAU;

/// A filter that knows how to draw offsets from the pixel's center.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelFilter(Kernel);

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kernel {
    Box,
    Tent { radius: f64 },
    Gaussian { variance: f64, radius: f64, mass: f64 },
}

impl PixelFilter {
    /// The filter of a description. A tent or bell whose size is not a positive number is taken as the box.
    ///
    /// The bell is cut off at a circle: that keeps it round, and its integral has a closed form.
    pub fn new(description: &FilterDescription) -> Self {
        let positive = |x: f32| x > 0.0 && x.is_finite();
        Self(match *description {
            FilterDescription::Tent(radius) if positive(radius) => Kernel::Tent { radius: f64::from(radius) },
            FilterDescription::Gaussian { sigma, radius } if positive(sigma) && positive(radius) => {
                let (variance, radius) = (f64::from(sigma).powi(2), f64::from(radius));
                let mass = 1.0 - float::exp(-0.5 * radius * radius / variance);
                Kernel::Gaussian { variance, radius, mass }
            }
            FilterDescription::Box | FilterDescription::Tent(_) | FilterDescription::Gaussian { .. } => {
                Kernel::Box
            }
        })
    }

    /// An offset from the pixel's center, pixels, with density `pdf`.
    pub fn sample(&self, u: Vec2) -> Vec2 {
        match self.0 {
            Kernel::Box => u - Vec2::splat(0.5),
            Kernel::Tent { radius } => Vec2::new(sample_tent(u.x), sample_tent(u.y)) * radius as f32,
            Kernel::Gaussian { variance, mass, .. } => {
                // Inverse of the radial distribution [Box & Muller 1958], restricted to the disc's share `mass`.
                let r = (-2.0 * variance * float::ln(1.0 - f64::from(u.x) * mass)).sqrt();
                let (sin, cos) = float::sin_cos(TAU * f64::from(u.y));
                Vec2::new((r * cos) as f32, (r * sin) as f32)
            }
        }
    }

    /// Density of `sample`, pixels⁻²: the normalized filter itself.
    pub fn pdf(&self, offset: Vec2) -> f32 {
        let q = offset.as_dvec2();
        let density = match self.0 {
            Kernel::Box if q.abs().max_element() <= 0.5 => 1.0,
            Kernel::Box => 0.0,
            Kernel::Tent { radius } => {
                let height = |x: f64| (1.0 - x.abs() / radius).max(0.0) / radius;
                height(q.x) * height(q.y)
            }
            Kernel::Gaussian { radius, .. } if q.length_squared() > radius * radius => 0.0,
            Kernel::Gaussian { variance, mass, .. } => {
                float::exp(-0.5 * q.length_squared() / variance) / (TAU * variance * mass)
            }
        };
        density as f32
    }

    /// Half the side of the square that holds all offsets, pixels.
    pub fn radius(&self) -> f32 {
        match self.0 {
            Kernel::Box => 0.5,
            Kernel::Tent { radius } | Kernel::Gaussian { radius, .. } => radius as f32,
        }
    }
}

/// Inverse of the distribution of 1 - |x| on -1…1.
fn sample_tent(u: f32) -> f32 {
    if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 - 2.0 * u).sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_testkit::{Random, chi_square_square};

    fn examples() -> [PixelFilter; 4] {
        [
            FilterDescription::Box,
            FilterDescription::Tent(1.5),
            FilterDescription::Gaussian { sigma: 0.5, radius: 2.0 },
            FilterDescription::Gaussian { sigma: 1.0, radius: 0.8 },
        ]
        .map(|description| PixelFilter::new(&description))
    }

    #[test]
    fn offsets_follow_the_density() {
        for (seed, filter) in examples().into_iter().enumerate() {
            let mut random = Random::from_seed(40 + seed as u64);
            // A square somewhat larger than the filter, so that the outside is tested too.
            let side = 2.2 * f64::from(filter.radius());
            let sample = || {
                let q = filter.sample(Vec2::new(random.uniform_f32(), random.uniform_f32()));
                [f64::from(q.x) / side + 0.5, f64::from(q.y) / side + 0.5]
            };
            let pdf = |q: [f64; 2]| {
                let offset = Vec2::new(((q[0] - 0.5) * side) as f32, ((q[1] - 0.5) * side) as f32);
                f64::from(filter.pdf(offset)) * side * side
            };
            let result = chi_square_square(sample, pdf, 100_000, 22, 22);
            assert!(result.p_value > 1e-3, "{filter:?}: {result:?}");
        }
    }

    #[test]
    fn no_offset_leaves_the_filter_for_the_extreme_random_numbers() {
        let last = hyaline_math::float::ONE_MINUS_EPSILON;
        for filter in examples() {
            for u in [Vec2::ZERO, Vec2::splat(last), Vec2::new(last, 0.0), Vec2::new(0.0, last)] {
                let q = filter.sample(u);
                assert!(q.abs().max_element() <= filter.radius() * 1.000_001, "{filter:?} at {u}: {q}");
            }
        }
    }

    #[test]
    fn filters_without_extent_are_the_box() {
        let boxed = PixelFilter::new(&FilterDescription::Box);
        assert_eq!(PixelFilter::new(&FilterDescription::Tent(f32::NAN)), boxed);
        assert_eq!(PixelFilter::new(&FilterDescription::Gaussian { sigma: 0.0, radius: 1.0 }), boxed);
    }
}
