//! How many passes to start before the next look at the clock.
//!
//! Passes are started in batches, so that all threads have work until the batch ends and the clock is read seldom.
//! Where a batch ends changes nothing that is computed, only when checkpoints and limits are looked at.

/// Length that a batch aims at, seconds.
const BATCH_SECONDS: f64 = 0.3;
/// Samples that a batch of several passes may hold in memory.
const BATCH_SAMPLES: usize = 1 << 20;
/// Longest time between two checkpoints, seconds.
const CHECKPOINT_SECONDS: f64 = 10.0;
/// Time for rendering that each second of writing checkpoints must be worth.
const RENDERING_PER_WRITING: f64 = 20.0;
/// A pass may be expected to end this much after the time limit, as a factor on it.
const OVERTIME: f64 = 1.1;

/// Times of the passes so far, and what follows from them.
#[derive(Clone, Debug)]
pub(crate) struct Pace {
    /// Time limit, seconds.
    limit: Option<f64>,
    /// Passes that fit in memory.
    most_passes: u32,
    /// Expected length of a pass, seconds; `None` before the first.
    pass_seconds: Option<f64>,
    /// When the last checkpoint was written, and how long that took, seconds.
    checkpoint: Option<(f64, f64)>,
}

impl Pace {
    /// - `limit`: time limit, seconds.
    /// - `pixels`: samples of a pass.
    pub(crate) fn new(limit: Option<f64>, pixels: usize) -> Self {
        let most_passes = (BATCH_SAMPLES / pixels.max(1)).clamp(1, 4096) as u32;
        Self { limit, most_passes, pass_seconds: None, checkpoint: None }
    }

    /// Number of passes to start now, 0 where the time is up. The first batch is a single pass, whatever the limit.
    pub(crate) fn next_batch(&self, elapsed: f64) -> u32 {
        let Some(pass_seconds) = self.pass_seconds else { return 1 };
        let wanted = (BATCH_SECONDS / pass_seconds).clamp(1.0, f64::from(self.most_passes)) as u32;
        let Some(limit) = self.limit else { return wanted };
        if elapsed >= limit {
            return 0;
        }
        let until_limit = ((limit - elapsed) / pass_seconds).ceil();
        let until_overtime = ((OVERTIME * limit - elapsed) / pass_seconds).floor();
        // The cast saturates; both numbers are positive or below one.
        wanted.min(until_limit.min(until_overtime) as u32)
    }

    /// Takes note that a batch of `passes` took `seconds`.
    pub(crate) fn record_batch(&mut self, passes: u32, seconds: f64) {
        let measured = (seconds / f64::from(passes.max(1))).max(1e-9);
        self.pass_seconds = Some(self.pass_seconds.map_or(measured, |before| 0.5 * (before + measured)));
    }

    /// Whether to write a checkpoint now: after the first batch, and before the next one would make the last too old.
    pub(crate) fn is_checkpoint_due(&self, elapsed: f64) -> bool {
        let Some((written, writing)) = self.checkpoint else { return true };
        let batch = self.pass_seconds.unwrap_or(0.0).max(BATCH_SECONDS);
        let age = elapsed - written;
        age + batch >= CHECKPOINT_SECONDS && age >= RENDERING_PER_WRITING * writing
    }

    /// Takes note of a checkpoint that was begun at `begun` and finished at `elapsed`.
    pub(crate) fn record_checkpoint(&mut self, begun: f64, elapsed: f64) {
        self.checkpoint = Some((elapsed, elapsed - begun));
    }

    /// Time that `passes` more will take within the limit, seconds.
    pub(crate) fn seconds_left(&self, passes: Option<f64>, elapsed: f64) -> Option<f64> {
        let by_count = passes.zip(self.pass_seconds).map(|(passes, seconds)| passes * seconds);
        let by_time = self.limit.map(|limit| (limit - elapsed).max(0.0));
        match (by_count, by_time) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs passes of a fixed length against a limit; returns their number and when the last ended.
    fn simulate(pass_seconds: f64, limit: f64) -> (u32, f64) {
        let mut pace = Pace::new(Some(limit), 100);
        let (mut passes, mut elapsed) = (0, 0.0);
        loop {
            let batch = pace.next_batch(elapsed);
            if batch == 0 {
                return (passes, elapsed);
            }
            let seconds = f64::from(batch) * pass_seconds;
            passes += batch;
            elapsed += seconds;
            pace.record_batch(batch, seconds);
        }
    }

    #[test]
    fn a_time_limit_is_used_up_and_not_overrun() {
        for pass_seconds in [0.001, 0.07, 0.9, 1.7, 3.0] {
            let (passes, end) = simulate(pass_seconds, 10.0);
            assert!(end <= 11.0, "{passes} passes of {pass_seconds} s end at {end}");
            assert!(end + pass_seconds > 10.0, "{passes} passes of {pass_seconds} s end at {end}");
        }
    }

    #[test]
    fn one_pass_is_made_however_long_it_takes() {
        assert_eq!(simulate(60.0, 10.0), (1, 60.0));
    }

    #[test]
    fn short_passes_come_in_batches_and_long_ones_alone() {
        let mut pace = Pace::new(None, 1000);
        assert_eq!(pace.next_batch(0.0), 1);
        pace.record_batch(1, 0.01);
        assert_eq!(pace.next_batch(0.01), 30);
        pace.record_batch(30, 90.0);
        assert_eq!(pace.next_batch(90.0), 1);
    }

    #[test]
    fn a_batch_of_a_large_picture_holds_one_pass() {
        let mut pace = Pace::new(None, 8_000_000);
        pace.record_batch(1, 0.001);
        assert_eq!(pace.next_batch(1.0), 1);
    }

    #[test]
    fn checkpoints_are_written_first_and_then_every_ten_seconds() {
        let mut pace = Pace::new(None, 100);
        pace.record_batch(1, 0.2);
        assert!(pace.is_checkpoint_due(0.2));
        pace.record_checkpoint(0.2, 0.25);
        assert!(!pace.is_checkpoint_due(5.0));
        assert!(pace.is_checkpoint_due(10.0));
    }

    #[test]
    fn slow_writing_makes_checkpoints_rarer() {
        let mut pace = Pace::new(None, 100);
        pace.record_batch(1, 0.2);
        pace.record_checkpoint(0.0, 2.0);
        assert!(!pace.is_checkpoint_due(30.0));
        assert!(pace.is_checkpoint_due(42.0));
    }
}
