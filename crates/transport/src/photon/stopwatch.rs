//! How long look-ups take, for reports alone: nothing that is computed depends on it.
//!
//! Reading the clock costs about as much as a small look-up, so only one call in so many is timed.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Calls of which one is timed.
const STRIDE: u64 = 64;

/// Counts and times calls on one thread.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stopwatch {
    calls: u64,
    timed: u64,
    nanos: u64,
}

impl Stopwatch {
    /// Makes a call, and times it if it is its turn.
    #[inline]
    pub fn time<T>(&mut self, call: impl FnOnce() -> T) -> T {
        self.calls += 1;
        if self.calls % STRIDE != 1 {
            return call();
        }
        let begun = Instant::now();
        let result = call();
        self.timed += 1;
        self.nanos += begun.elapsed().as_nanos() as u64;
        result
    }
}

/// What the stopwatches of all threads add up to.
#[derive(Debug, Default)]
pub struct TotalTime {
    calls: AtomicU64,
    timed: AtomicU64,
    nanos: AtomicU64,
}

impl TotalTime {
    /// Adds the calls of a stopwatch.
    pub fn add(&self, watch: &Stopwatch) {
        for (total, part) in
            [(&self.calls, watch.calls), (&self.timed, watch.timed), (&self.nanos, watch.nanos)]
        {
            total.fetch_add(part, Ordering::Relaxed);
        }
    }

    /// Calls in all.
    pub fn calls(&self) -> u64 {
        self.calls.load(Ordering::Relaxed)
    }

    /// Time of all calls, of all threads together, as that of the timed ones says.
    pub fn time(&self) -> Duration {
        let (nanos, timed) = (self.nanos.load(Ordering::Relaxed), self.timed.load(Ordering::Relaxed));
        Duration::from_secs_f64(nanos as f64 * 1e-9 * self.calls() as f64 / timed.max(1) as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_of_all_calls_is_judged_by_some() {
        let total = TotalTime::default();
        for _thread in 0..2 {
            let mut watch = Stopwatch::default();
            let sum: u64 = (0..640).map(|i| watch.time(|| i)).sum();
            assert_eq!(sum, 639 * 320);
            watch.nanos = 10 * 1_000_000;
            total.add(&watch);
        }
        // 20 timed calls of a millisecond, of 1280.
        assert_eq!((total.calls(), total.time()), (1280, Duration::from_millis(1280)));
        assert_eq!(TotalTime::default().time(), Duration::ZERO);
    }
}
