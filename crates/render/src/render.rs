//! A render: prepare, then batches of passes until a limit is reached.

use crate::batch::{Batches, PassSamples};
use crate::job::{Job, Outcome};
use crate::pace::Pace;
use crate::progress::{Progress, Stage};
use crate::tile;
use crate::watch::{self, Watch};
use hyaline_film::{Film, PassSet};
use hyaline_transport::{Integrator, Prepared, Stats};
use hyaline_world::World;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Makes the passes that `job` asks for and adds them to `film`.
///
/// - `film`: empty, or resumed; its pixels are those of the job's crop. Passes that it holds are not made again.
/// - `progress`: called now and then, ten times a second in a long pass.
/// - `checkpoint`: called with the film after the first batch of passes, then at least every ten seconds while passes
///   are shorter and writing takes less than a twentieth of the time; not at the end.
///
/// The film is the same, bit for bit, for any number of threads and any limit that leads to the same passes.
pub fn render(
    world: &World,
    integrator: &dyn Integrator,
    job: &Job<'_>,
    film: Film,
    progress: &mut dyn FnMut(Progress),
    checkpoint: &mut dyn FnMut(&Film),
) -> Outcome {
    let begun = (job.elapsed)();
    let mut stats = Stats::default();
    // Taken apart, because the clock stays on this thread.
    let Job { view, settings, cancel, workers, .. } = job;
    let prepared = workers.run_watched(
        || integrator.prepare(world, view, settings, cancel, &mut stats),
        || progress(PREPARING),
    );
    let prepared_at = (job.elapsed)();
    let mut run = Run::new(job, film, stats);
    run.make_passes(prepared.as_ref(), progress, checkpoint);
    Outcome {
        film: run.film,
        passes_made: run.passes_made,
        stats: run.stats,
        photons: prepared.photon_statistics(),
        prepare_time: prepared_at.saturating_sub(begun),
        render_time: (job.elapsed)().saturating_sub(prepared_at),
        was_canceled: job.cancel.load(Ordering::SeqCst),
    }
}

/// Progress while an integrator prepares.
const PREPARING: Progress = Progress {
    stage: Stage::Preparing,
    passes_done: 0,
    passes_wanted: None,
    fraction: 0.0,
    seconds_left: None,
    error: None,
};

/// A render at work.
struct Run<'a> {
    job: &'a Job<'a>,
    film: Film,
    stats: Stats,
    pace: Pace,
    watch: Watch,
    passes_made: u32,
    /// Passes to make in all by this run; `None` where only time or error ends it.
    passes_wanted: Option<u32>,
}

impl<'a> Run<'a> {
    fn new(job: &'a Job<'a>, film: Film, stats: Stats) -> Self {
        let range = &job.limits.passes;
        let held = held_passes(film.passes(), range);
        let mut watch = Watch::new(job.limits.error, job.watches_error);
        watch.look(&film);
        Self {
            pace: Pace::new(job.limits.time.map(|time| time.as_secs_f64()), job.crop.area()),
            watch,
            passes_wanted: (!job.limits.are_open()).then_some(range.end - range.start - held),
            job,
            film,
            stats,
            passes_made: 0,
        }
    }

    /// Makes passes until a limit is reached or the render is canceled.
    fn make_passes(
        &mut self,
        prepared: &dyn Prepared,
        progress: &mut dyn FnMut(Progress),
        checkpoint: &mut dyn FnMut(&Film),
    ) {
        let tiles = tile::tiles(self.job.crop);
        let tiles_done = AtomicUsize::new(0);
        let batches = Batches {
            prepared,
            crop: self.job.crop,
            tiles: &tiles,
            cancel: self.job.cancel,
            tiles_done: &tiles_done,
        };
        let mut memory = Vec::new();
        let mut next_pass = self.job.limits.passes.start;
        loop {
            let start = self.elapsed();
            let held = watch::count(&self.film);
            if self.watch.is_reached(held) {
                return;
            }
            let batch = self.pace.next_batch(start).min(self.watch.until_next(held).unwrap_or(u32::MAX));
            let passes = self.choose_passes(&mut next_pass, batch);
            if passes.is_empty() || self.job.cancel.load(Ordering::SeqCst) {
                return;
            }
            tiles_done.store(0, Ordering::Relaxed);
            let watch =
                || progress(self.progress(tiles_done.load(Ordering::Relaxed) as f64 / tiles.len() as f64));
            let stats = self.job.workers.run_watched(|| batches.render(&passes, &mut memory), watch);
            self.stats.add(&stats);
            self.add_whole_passes(&batches, &memory);
            self.watch.look(&self.film);
            self.pace.record_batch(passes.len() as u32, self.elapsed() - start);
            progress(self.progress(0.0));
            self.write_checkpoint(checkpoint);
        }
    }

    fn elapsed(&self) -> f64 {
        (self.job.elapsed)().as_secs_f64()
    }

    /// The next `count` passes that the film lacks.
    fn choose_passes(&self, next: &mut u32, count: u32) -> Vec<u32> {
        let mut passes = Vec::new();
        while passes.len() < count as usize && *next < self.job.limits.passes.end {
            if !self.film.passes().contains(*next) {
                passes.push(*next);
            }
            *next += 1;
        }
        passes
    }

    /// Adds the passes that a batch has finished. The first of which part is missing is given up, and so are those
    /// after it: a canceled render, too, has made a run of passes without gaps.
    fn add_whole_passes(&mut self, batches: &Batches<'_>, memory: &[PassSamples]) {
        for pass in memory.iter().take_while(|pass| batches.is_whole(pass)) {
            let film = &mut self.film;
            self.job.workers.run(|| film.add_tile(pass.number, batches.crop, &pass.samples));
            // Only passes that the film lacks are begun, so that none is refused here.
            let finished = self.film.finish_pass(pass.number);
            debug_assert!(finished.is_ok(), "{finished:?}");
            self.passes_made += 1;
        }
    }

    /// Writes a checkpoint if one is due.
    fn write_checkpoint(&mut self, checkpoint: &mut dyn FnMut(&Film)) {
        let begun = self.elapsed();
        if self.passes_made > 0 && self.pace.is_checkpoint_due(begun) {
            checkpoint(&self.film);
            self.pace.record_checkpoint(begun, self.elapsed());
        }
    }

    /// How far the render is, when `passes_at_work` passes have been made since the last batch ended.
    fn progress(&self, passes_at_work: f64) -> Progress {
        let elapsed = self.elapsed();
        let done = f64::from(self.passes_made) + passes_at_work;
        let wanted = self.passes_expected();
        let left = wanted.map(|wanted| (wanted - done).max(0.0));
        let by_count = wanted.map_or(0.0, |wanted| done / wanted.max(1.0));
        let by_time = self.job.limits.time.map_or(0.0, |limit| elapsed / limit.as_secs_f64());
        Progress {
            stage: Stage::Rendering,
            passes_done: self.passes_made,
            passes_wanted: self.passes_wanted,
            fraction: by_count.max(by_time).clamp(0.0, 1.0),
            seconds_left: self.pace.seconds_left(left, elapsed),
            error: self.watch.error(),
        }
    }

    /// Passes that this run will make, by their number or by the error that is wanted, as far as either is known.
    fn passes_expected(&self) -> Option<f64> {
        let held_before = f64::from(watch::count(&self.film)) - f64::from(self.passes_made);
        let by_error = self.watch.expected_passes().map(|passes| passes - held_before);
        let by_count = self.passes_wanted.map(f64::from);
        by_count.into_iter().chain(by_error).reduce(f64::min)
    }
}

/// How many passes of `range` a film holds.
fn held_passes(held: &PassSet, range: &Range<u32>) -> u32 {
    let overlap = |&(first, last): &(u32, u32)| {
        let end = u64::from(range.end).min(u64::from(last) + 1);
        end.saturating_sub(u64::from(range.start.max(first)))
    };
    held.ranges().iter().map(overlap).sum::<u64>() as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn held_passes_are_those_within_the_range() {
        let held = PassSet::from_ranges(vec![(0, 3), (8, 9), (20, u32::MAX)]).unwrap();
        assert_eq!(held_passes(&held, &(2..9)), 3);
        assert_eq!(held_passes(&held, &(4..8)), 0);
        assert_eq!(held_passes(&held, &(0..30)), 16);
    }
}
