//! Small pictures rendered by an integrator, and their comparison tile by tile.
#![allow(dead_code, unreachable_pub, reason = "each test file uses its own part, and a test exports nothing")]

use hyaline_film::{PixelSample, Rect};
use hyaline_scene::PixelFilter as FilterDescription;
use hyaline_testkit::{Moments, sidak, welch_t};
use hyaline_transport::integrator::by_name;
use hyaline_transport::{RenderSettings, Stats, View};
use hyaline_world::World;
use hyaline_world::camera::PixelFilter;
use std::ops::Range;
use std::sync::atomic::AtomicBool;

/// Differences of means below this fraction are roundings of `f32`, whatever the statistics say.
const ROUNDING: f64 = 2e-5;

/// What to render and how.
#[derive(Clone, Copy)]
pub struct Shot<'a> {
    pub world: &'a World,
    pub integrator: &'a str,
    pub settings: RenderSettings,
    /// Width and height in pixels, as the scene's film says.
    pub size: (u32, u32),
}

impl Shot<'_> {
    pub fn full_frame(&self) -> Rect {
        Rect { x0: 0, y0: 0, x1: self.size.0, y1: self.size.1 }
    }

    /// The samples of `tile` for each pass, and what was counted on the way.
    pub fn render(&self, tile: Rect, passes: Range<u32>, each: impl FnMut(u32, &[PixelSample])) -> Stats {
        let stats = self.render_any(tile, passes, each);
        assert!(stats.never_entered.is_empty(), "left what was never entered: {:?}", stats.never_entered);
        stats
    }

    /// The same, also of scenes with holes in their bodies.
    fn render_any(&self, tile: Rect, passes: Range<u32>, mut each: impl FnMut(u32, &[PixelSample])) -> Stats {
        let (width, height) = self.size;
        let filter = PixelFilter::new(&FilterDescription::Box);
        let view = View { camera: 0, width, height, filter };
        let mut stats = Stats::default();
        let integrator = by_name(self.integrator).unwrap();
        let prepared =
            integrator.prepare(self.world, &view, &self.settings, &AtomicBool::new(false), &mut stats);
        let mut samples = vec![PixelSample::default(); tile.area()];
        for number in passes {
            prepared.begin_pass(number, &mut stats).render_tile(tile, &mut samples, &mut stats);
            each(number, &samples);
        }
        stats
    }

    /// Mean of the full frame over passes.
    pub fn mean(&self, passes: Range<u32>) -> f64 {
        let mut means = Moments::new();
        self.render(self.full_frame(), passes, |_, samples| push_all(&mut means, samples));
        means.mean()
    }

    /// The same, also of scenes with holes in their bodies.
    pub fn mean_of_any(&self, passes: Range<u32>) -> f64 {
        self.mean_counted(passes, &mut Stats::default())
    }

    /// The same, and adds what was counted on the way to `stats`.
    pub fn mean_counted(&self, passes: Range<u32>, stats: &mut Stats) -> f64 {
        let mut means = Moments::new();
        stats.add(&self.render_any(self.full_frame(), passes, |_, samples| push_all(&mut means, samples)));
        means.mean()
    }

    /// Mean over passes of the frame's square tiles of `edge` pixels, row by row; passes are the independent numbers.
    pub fn tiles(&self, edge: u32, passes: Range<u32>) -> Vec<Moments> {
        let (columns, rows) = (self.size.0 / edge, self.size.1 / edge);
        let mut tiles = vec![Moments::new(); (columns * rows) as usize];
        self.render(self.full_frame(), passes, |_, samples| {
            for (tile, value) in tiles.iter_mut().zip(self.tile_means(samples, edge)) {
                tile.push(value);
            }
        });
        tiles
    }

    /// Mean of each tile in one pass.
    pub fn tile_means(&self, samples: &[PixelSample], edge: u32) -> Vec<f64> {
        let (columns, rows) = (self.size.0 / edge, self.size.1 / edge);
        let mut sums = vec![0.0; (columns * rows) as usize];
        for ((x, y), sample) in self.full_frame().pixels().zip(samples) {
            sums[(y / edge * columns + x / edge) as usize] += luminance(sample) / f64::from(edge * edge);
        }
        sums
    }

    /// Mean of the only pixel of a picture of 1 × 1, over passes.
    pub fn pixel(&self, passes: u32) -> (Moments, Stats) {
        assert_eq!(self.size, (1, 1));
        let mut moments = Moments::new();
        let stats =
            self.render(self.full_frame(), 0..passes, |_, samples| moments.push(luminance(&samples[0])));
        (moments, stats)
    }
}

fn push_all(means: &mut Moments, samples: &[PixelSample]) {
    samples.iter().for_each(|sample| means.push(luminance(sample)));
}

/// Mean of the three channels; not finite values fail.
pub fn luminance(sample: &PixelSample) -> f64 {
    let mean = sample.beauty.iter().map(|&c| f64::from(c)).sum::<f64>() / 3.0;
    assert!(mean.is_finite(), "a sample is {:?}", sample.beauty);
    mean
}

/// Fails unless the pictures agree: Welch's t-test per tile, corrected for the number of tiles, and on the whole.
///
/// - `power`: largest relative standard error of the whole picture's mean; more would show nothing.
pub fn assert_same_picture(a: &[Moments], b: &[Moments], power: f64, what: &str) {
    assert_eq!(a.len(), b.len());
    let level = sidak(0.01, a.len());
    for (tile, (a, b)) in a.iter().zip(b).enumerate() {
        let p = p_value(a, b);
        assert!(
            p > level,
            "{what}: tile {tile} is {} in one and {} in the other, p = {p}",
            a.mean(),
            b.mean()
        );
    }
    let (a, b) = (whole(a), whole(b));
    let error = (a.1 + b.1).sqrt();
    assert!(error < power * b.0, "{what}: an error of {error} in {} shows nothing", b.0);
    assert!(
        (a.0 - b.0).abs() < 3.5 * error + ROUNDING * b.0,
        "{what}: {} and {} ± {error} on the whole",
        a.0,
        b.0
    );
}

/// Chance of a difference at least as large as this one.
fn p_value(a: &Moments, b: &Moments) -> f64 {
    if (a.mean() - b.mean()).abs() <= ROUNDING * b.mean().abs() {
        return 1.0;
    }
    welch_t(a.mean(), a.variance_of_mean(), a.count(), b.mean(), b.variance_of_mean(), b.count())
}

/// Mean of all tiles and its variance.
fn whole(tiles: &[Moments]) -> (f64, f64) {
    let count = tiles.len() as f64;
    let mean = tiles.iter().map(Moments::mean).sum::<f64>() / count;
    (mean, tiles.iter().map(Moments::variance_of_mean).sum::<f64>() / (count * count))
}

/// Chance of calling pictures different that are not.
const LEVEL: f64 = 1e-3;

/// Pictures of a way to render at the least: their scatter is known to a fifth.
const FEWEST: u64 = 12;
/// Pictures after which it is given up: a way that needs more is not worth its time in a test.
const MOST: u64 = 100;

/// Mean of the means that `picture` has for each seed, from as many as it takes to know it to `error`, relative.
///
/// Fails where that is not to be had.
pub fn known_to(error: f64, first_seed: u64, picture: impl Fn(u64) -> f64) -> Moments {
    let mut moments = Moments::new();
    for seed in first_seed..first_seed + MOST {
        moments.push(picture(seed));
        if seed + 1 >= first_seed + FEWEST && moments.variance_of_mean().sqrt() < error * moments.mean() {
            return moments;
        }
    }
    panic!("{MOST} pictures have a mean of {} ± {}", moments.mean(), moments.variance_of_mean().sqrt());
}

/// Fails unless the means agree, and are known to `power`.
pub fn assert_same(a: &Moments, b: &Moments, power: f64, what: &str) {
    let error = (a.variance_of_mean() + b.variance_of_mean()).sqrt();
    println!(
        "{what}: {} and {} ± {error}, {:+.2} %, {} and {} pictures",
        a.mean(),
        b.mean(),
        100.0 * (a.mean() / b.mean() - 1.0),
        a.count(),
        b.count()
    );
    assert!(error < power * b.mean(), "{what}: an error of {error} in {} shows nothing", b.mean());
    let chance =
        welch_t(a.mean(), a.variance_of_mean(), a.count(), b.mean(), b.variance_of_mean(), b.count());
    assert!(chance > LEVEL, "{what}: {} and {} ± {error}, p = {chance}", a.mean(), b.mean());
}
