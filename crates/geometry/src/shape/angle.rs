//! A range of directions in a plane, tested without an inverse trigonometric function.

use super::error::{ShapeError, finite};
use hyaline_math::DVec2;
use hyaline_math::float::f64::{atan2, sin_cos};
use std::f64::consts::{PI, TAU};

/// Directions between two angles, counter-clockwise from the first to the second, both included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AngleRange {
    start: f64,
    span: f64,
    from: DVec2,
    to: DVec2,
}

impl AngleRange {
    /// The range `[start, end]`, radians; a span within rounding of 2π is the whole turn.
    ///
    /// - `quantity`: name of the range in the error.
    ///
    /// # Errors
    /// Where an end is not finite, the end is not above the start, or the span exceeds a whole turn.
    pub fn new(quantity: &'static str, [start, end]: [f64; 2]) -> Result<Self, ShapeError> {
        finite(quantity, start)?;
        let span = finite(quantity, end)? - start;
        if span <= 0.0 || span > TAU * (1.0 + 1e-9) {
            let remedy = "the range must end above its start and span at most a whole turn";
            return Err(ShapeError::out_of_range(quantity, span, remedy));
        }
        Ok(Self::from_start_and_span(start, span))
    }

    /// For a finite start and a span in 0…2π.
    pub(crate) fn from_start_and_span(start: f64, span: f64) -> Self {
        let span = if span >= TAU * (1.0 - 1e-12) { TAU } else { span };
        let unit = |angle: f64| {
            let (sin, cos) = sin_cos(angle);
            DVec2::new(cos, sin)
        };
        Self { start, span, from: unit(start), to: unit(start + span) }
    }

    /// First angle, radians.
    pub fn start(&self) -> f64 {
        self.start
    }

    /// Last angle, radians.
    pub fn end(&self) -> f64 {
        self.start + self.span
    }

    /// Last angle less first, radians, above 0 and at most 2π.
    pub fn span(&self) -> f64 {
        self.span
    }

    /// Unit vector of the first angle.
    pub fn from(&self) -> DVec2 {
        self.from
    }

    /// Whether the range is the whole turn.
    pub fn is_whole(&self) -> bool {
        self.span == TAU
    }

    /// Whether the direction of `v` is in the range, or `v` lies within `slack` of it.
    pub fn contains(&self, v: DVec2, slack: f64) -> bool {
        if self.is_whole() {
            return true;
        }
        if self.span <= PI {
            return self.from.perp_dot(v) >= -slack && v.perp_dot(self.to) >= -slack;
        }
        // What is left out is less than half a turn: between the end and the start.
        self.to.perp_dot(v) <= slack || v.perp_dot(self.from) <= slack
    }

    /// Where in the range the direction of `v` lies, 0…1; directions outside count as the nearer end.
    pub fn fraction(&self, v: DVec2) -> f64 {
        let mut past = (atan2(v.y, v.x) - self.start).rem_euclid(TAU);
        if past > self.span + 0.5 * (TAU - self.span) {
            past = 0.0;
        }
        (past / self.span).min(1.0)
    }

    /// The largest value of `v · d` over the unit directions d of the range.
    pub fn support(&self, v: DVec2) -> f64 {
        if self.contains(v, 0.0) { v.length() } else { v.dot(self.from).max(v.dot(self.to)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_testkit::Random;

    fn direction(angle: f64) -> DVec2 {
        let (sin, cos) = sin_cos(angle);
        DVec2::new(cos, sin)
    }

    #[test]
    fn membership_and_fraction_agree_with_the_angles() {
        let mut random = Random::from_seed(1);
        for _ in 0..20_000 {
            let (start, span) = (random.between(-7.0, 7.0), random.between(0.01, TAU));
            let range = AngleRange::new("φ", [start, start + span]).unwrap();
            let past = random.between(0.0, TAU);
            let v = direction(start + past) * random.between(0.1, 3.0);
            if (past - span).abs() > 1e-9 && past > 1e-9 && past < TAU - 1e-9 {
                assert_eq!(range.contains(v, 0.0), past < span, "{range:?} at {past}");
            }
            if past < span {
                assert!((range.fraction(v) - past / span).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn ends_count_with_a_slack_and_map_to_the_nearer_end() {
        for span in [0.5, PI, 4.0] {
            let range = AngleRange::new("φ", [1.0, 1.0 + span]).unwrap();
            let (before, after) = (direction(1.0 - 1e-10), direction(1.0 + span + 1e-10));
            assert!(range.contains(before, 1e-9) && range.contains(after, 1e-9));
            assert!(!range.contains(before, 1e-11) && !range.contains(after, 1e-11));
            assert_eq!((range.fraction(before), range.fraction(after)), (0.0, 1.0));
        }
    }

    #[test]
    fn support_is_the_largest_projection() {
        let mut random = Random::from_seed(2);
        for _ in 0..200 {
            let start = random.between(-7.0, 7.0);
            let range = AngleRange::new("φ", [start, start + random.between(0.01, TAU)]).unwrap();
            let v = direction(random.between(0.0, TAU)) * 2.0;
            let steps =
                (0..=1000).map(|i| direction(range.start() + range.span() * i as f64 / 1000.0).dot(v));
            let brute = steps.fold(f64::NEG_INFINITY, f64::max);
            assert!((range.support(v) - brute).abs() < 5e-5 && range.support(v) > brute - 1e-12);
        }
    }

    #[test]
    fn ranges_that_are_empty_or_too_long_are_refused() {
        for ends in [[1.0, 1.0], [2.0, 1.0], [0.0, 7.0], [f64::NAN, 1.0], [0.0, f64::INFINITY]] {
            assert!(AngleRange::new("φ", ends).is_err());
        }
        assert!(AngleRange::new("φ", [0.0, TAU]).unwrap().is_whole());
    }
}
