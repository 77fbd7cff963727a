//! When the error of a film is looked at, and what it was.
//!
//! Working the error out takes a good part of a pass's time, so that it is done at few numbers of passes. They are the
//! same for every run: which of them is the first with a small enough error depends on the picture alone, not on threads,
//! clocks or how often the render was resumed.

use hyaline_film::{Film, error_estimate};

/// Passes that the first look needs: fewer tell too little.
const FIRST: u32 = 8;
/// Share by which passes grow until the next look.
const GROWTH: u32 = 8;

/// The error of a film, as last looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Watch {
    /// Passes then, and the error.
    last: Option<(u32, f64)>,
    /// The error that is small enough.
    limit: Option<f64>,
    /// Whether to look at all.
    is_on: bool,
}

impl Watch {
    /// - `is_shown`: whether anyone wants to know the error.
    pub(crate) fn new(limit: Option<f64>, is_shown: bool) -> Self {
        Self { last: None, limit, is_on: is_shown || limit.is_some() }
    }

    /// Looks at the film if this is a number of passes to look at.
    pub(crate) fn look(&mut self, film: &Film) {
        let passes = count(film);
        if self.is_on && is_due(passes) {
            self.last = error_estimate(film).map(|error| (passes, error));
        }
    }

    /// The error when last looked at.
    pub(crate) fn error(&self) -> Option<f64> {
        self.last.map(|(_, error)| error)
    }

    /// Whether the film of so many passes is good enough.
    pub(crate) fn is_reached(&self, passes: u32) -> bool {
        let small = self.last.zip(self.limit).filter(|&((_, error), limit)| error < limit);
        small.is_some_and(|((at, _), _)| at == passes)
    }

    /// Passes from `passes` to the next look, ≥ 1, where that may end the render; `None` where it may not.
    pub(crate) fn until_next(&self, passes: u32) -> Option<u32> {
        self.limit.map(|_| (next(passes) - passes).max(1))
    }

    /// Passes at which the error will be small enough if it falls as their number grows.
    pub(crate) fn expected_passes(&self) -> Option<f64> {
        let ((passes, error), limit) = self.last.zip(self.limit)?;
        Some(f64::from(passes) * (error / limit).max(1.0))
    }
}

/// Number of passes of a film.
pub(crate) fn count(film: &Film) -> u32 {
    u32::try_from(film.passes().len()).unwrap_or(u32::MAX)
}

/// Whether to look after so many passes.
fn is_due(passes: u32) -> bool {
    passes > 0 && next(passes - 1) == passes
}

/// The first number of passes to look at that is larger than `passes`.
fn next(passes: u32) -> u32 {
    let mut look = FIRST;
    while look <= passes && look < u32::MAX {
        look = look.saturating_add(look / GROWTH);
    }
    look
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn looks_grow_by_an_eighth() {
        let looks: Vec<u32> = (0..40).filter(|&passes| is_due(passes)).collect();
        assert_eq!(looks, [8, 9, 10, 11, 12, 13, 14, 15, 16, 18, 20, 22, 24, 27, 30, 33, 37]);
        assert_eq!(next(u32::MAX - 1), u32::MAX);
    }

    #[test]
    fn an_error_counts_for_the_passes_it_was_found_at() {
        let watch = Watch { last: Some((16, 0.01)), limit: Some(0.02), is_on: true };
        assert!(watch.is_reached(16) && !watch.is_reached(17));
        assert!(!Watch { limit: Some(0.01), ..watch }.is_reached(16));
        assert!(!Watch { limit: None, ..watch }.is_reached(16));
        assert_eq!(Watch { limit: Some(0.0025), ..watch }.expected_passes(), Some(64.0));
        assert_eq!(watch.until_next(16), Some(2));
        assert_eq!(Watch { limit: None, ..watch }.until_next(16), None);
    }
}
