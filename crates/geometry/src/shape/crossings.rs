//! The few crossings of a line and one shape.

/// Crossings within an interval, ascending; at most four, as a line meets none of our shapes oftener.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossings {
    values: [f64; 4],
    count: usize,
    t_min: f64,
    t_max: f64,
}

impl Crossings {
    /// No crossings yet.
    pub fn new() -> Self {
        Self { values: [0.0; 4], count: 0, t_min: 0.0, t_max: 0.0 }
    }

    /// The crossings, ascending.
    pub fn as_slice(&self) -> &[f64] {
        &self.values[..self.count]
    }

    /// Empties the list and sets the open interval that `push` obeys.
    pub(super) fn restart(&mut self, t_min: f64, t_max: f64) {
        (self.count, self.t_min, self.t_max) = (0, t_min, t_max);
    }

    /// Whether `t` is strictly inside the interval; NaN never is.
    pub(super) fn admits(&self, t: f64) -> bool {
        self.t_min < t && t < self.t_max
    }

    /// Whether anything from `first` to `last` may be inside the interval; in doubt, as with NaN, it may.
    pub(super) fn admits_within(&self, first: f64, last: f64) -> bool {
        !(first >= self.t_max || last <= self.t_min)
    }

    /// Takes `t` in its place if it is strictly inside the interval.
    pub(super) fn push(&mut self, t: f64) {
        if !self.admits(t) || self.count == self.values.len() {
            return;
        }
        let mut i = self.count;
        while i > 0 && self.values[i - 1] > t {
            self.values[i] = self.values[i - 1];
            i -= 1;
        }
        self.values[i] = t;
        self.count += 1;
    }
}

impl Default for Crossings {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crossings_are_sorted_and_strictly_inside() {
        let mut crossings = Crossings::new();
        crossings.restart(1.0, 4.0);
        for t in [3.0, 1.0, 2.0, 4.0, f64::NAN, f64::INFINITY, 1.5] {
            crossings.push(t);
        }
        assert_eq!(crossings.as_slice(), [1.5, 2.0, 3.0]);
    }

    #[test]
    fn nothing_is_admitted_within_ranges_before_or_beyond_the_interval() {
        let mut crossings = Crossings::new();
        crossings.restart(1.0, 4.0);
        assert!(!crossings.admits_within(0.0, 1.0) && !crossings.admits_within(4.0, 5.0));
        assert!(crossings.admits_within(0.0, 1.5) && crossings.admits_within(3.9, 5.0));
        assert!(crossings.admits_within(0.0, 9.0) && crossings.admits_within(2.0, 3.0));
        assert!(crossings.admits_within(f64::NAN, f64::NAN));
    }
}
