//! Several passes at once: tiles of all of them are handed to the threads, so that none waits for a pass to end.

use crate::tile;
use hyaline_film::{PixelSample, Rect};
use hyaline_transport::{Pass, Prepared, Stats};
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// The samples of one pass.
#[derive(Debug, Default)]
pub(crate) struct PassSamples {
    /// Number of the pass.
    pub(crate) number: u32,
    /// Its samples, row by row over the crop.
    pub(crate) samples: Vec<PixelSample>,
    /// Tiles that have been rendered.
    tiles_done: AtomicUsize,
}

/// What all batches of a render share.
pub(crate) struct Batches<'a> {
    /// What all passes share.
    pub(crate) prepared: &'a dyn Prepared,
    /// Pixels to render.
    pub(crate) crop: Rect,
    /// Tiles of the crop.
    pub(crate) tiles: &'a [Rect],
    /// Asks to stop.
    pub(crate) cancel: &'a AtomicBool,
    /// Tiles rendered so far, for progress.
    pub(crate) tiles_done: &'a AtomicUsize,
}

/// One tile of one pass.
struct TileJob<'a> {
    pass: &'a dyn Pass,
    tile: Rect,
    /// Its part of the pass's rows.
    rows: Vec<&'a mut [PixelSample]>,
    pass_tiles_done: &'a AtomicUsize,
}

impl Batches<'_> {
    /// Renders these passes on the threads it is called from, into `memory`, one element for each pass.
    ///
    /// Returns the counts. Passes that were begun when `cancel` was set may be left in part.
    pub(crate) fn render(&self, passes: &[u32], memory: &mut Vec<PassSamples>) -> Stats {
        let mut stats = Stats::default();
        let begun: Vec<Box<dyn Pass + '_>> =
            passes.iter().map(|&pass| self.prepared.begin_pass(pass, &mut stats)).collect();
        memory.resize_with(passes.len(), PassSamples::default);
        for (memory, &pass) in memory.iter_mut().zip(passes) {
            memory.number = pass;
            memory.tiles_done = AtomicUsize::new(0);
            memory.samples.resize(self.crop.area(), PixelSample::default());
        }
        let jobs: Vec<TileJob<'_>> =
            begun.iter().zip(memory).flat_map(|(pass, memory)| self.jobs(pass.as_ref(), memory)).collect();
        let tiles =
            jobs.into_par_iter().with_max_len(1).map(|job| self.render_tile(job)).reduce(Stats::default, sum);
        sum(stats, tiles)
    }

    /// Whether all of a pass is there.
    pub(crate) fn is_whole(&self, pass: &PassSamples) -> bool {
        pass.tiles_done.load(Ordering::SeqCst) == self.tiles.len()
    }

    /// The tiles of a pass, each with its place in memory.
    fn jobs<'a>(&self, pass: &'a dyn Pass, memory: &'a mut PassSamples) -> impl Iterator<Item = TileJob<'a>> {
        let PassSamples { samples, tiles_done, .. } = memory;
        let rows = tile::part(self.crop, samples);
        self.tiles.iter().zip(rows).map(|(&tile, rows)| TileJob {
            pass,
            tile,
            rows,
            pass_tiles_done: tiles_done,
        })
    }

    fn render_tile(&self, job: TileJob<'_>) -> Stats {
        let mut stats = Stats::default();
        if self.cancel.load(Ordering::Relaxed) {
            return stats;
        }
        let mut samples = [PixelSample::default(); (tile::SIDE * tile::SIDE) as usize];
        job.pass.render_tile(job.tile, &mut samples[..job.tile.area()], &mut stats);
        let rendered = samples.chunks_exact(job.tile.width() as usize);
        job.rows.into_iter().zip(rendered).for_each(|(row, rendered)| row.copy_from_slice(rendered));
        job.pass_tiles_done.fetch_add(1, Ordering::SeqCst);
        self.tiles_done.fetch_add(1, Ordering::Relaxed);
        stats
    }
}

fn sum(mut a: Stats, b: Stats) -> Stats {
    a.add(&b);
    a
}
