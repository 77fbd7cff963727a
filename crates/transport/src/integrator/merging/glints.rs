//! Lamps and suns that are seen in glass as glints smaller than a pixel: more looks at what is polished.
//!
//! Nothing but chance finds a glint: no shadow ray and no photon comes through polished surfaces to the eye. One path in
//! a hundred that sees a lamp makes a speckle of its pixel. But a look costs little, as it ends where light would be
//! scattered. So each pass looks several times at all pixels that show polished things, and what its path has seen of
//! glints is one look among them. Before the first pass, looks all over the picture tell where polished things are, and
//! whether glints are worth it.

use super::{RenderSettings, View};
use crate::integrator::eye::tally::Tally;
use crate::integrator::eye::{Draws, Eye, Seen};
use crate::integrator::per_pixel::ray_through;
use crate::stats::Stats;
use hyaline_sampling::Sampler;
use hyaline_spectrum::Spectrum;
use rayon::prelude::*;

/// Looks at a pixel in a pass, that of its path among them: docs/merging.md tells what more and fewer do.
const LOOKS: u32 = 4;
/// Cells along the longer side of a picture, at most: where a cell or one beside it shows something polished, all its
/// pixels are looked at.
const CELLS: u32 = 96;
/// Pixels of a cell that are looked at first, each twice.
const FIRST_PIXELS: u32 = 4;
/// Squared relative error of a pass by glints above which they are worth more looks.
const WORTH: f32 = 0.01;
/// Turns the seed of the picture into those of first looks and of others.
const FIRST_SEED: u64 = 0x6669_7273_7421_2121;
const LOOKS_SEED: u64 = 0x676c_696e_7473_2121;

/// Where a pass looks again.
pub(super) struct Glints {
    /// Whether something polished is seen, cell by cell, row by row.
    polished: Vec<bool>,
    cells: Cells,
}

/// Squares of pixels that a picture is divided into.
#[derive(Clone, Copy)]
struct Cells {
    columns: u32,
    rows: u32,
    /// Pixels along a side.
    side: u32,
}

impl Glints {
    /// Looks for glints; `None` if none are worth more looks.
    ///
    /// - `eye`: without photons.
    /// - `light`: mean radiance of the picture, roughly.
    pub(super) fn find(eye: &Eye<'_>, view: &View, light: f32, stats: &mut Stats) -> Option<Self> {
        if !eye.settings.techniques.glints || !eye.splits() {
            return None;
        }
        let cells = Cells::of(view);
        let found: Vec<_> =
            (0..cells.count()).into_par_iter().map(|i| cells.look_at(cells.cell(i), eye, view)).collect();
        let found: Vec<Found> = found
            .into_iter()
            .map(|(found, of_cell)| {
                stats.add(&of_cell);
                found
            })
            .collect();
        // Against the light near, for a lamp's edge, that many looks see, makes no speckles.
        let error = |(cell, looks): ((u32, u32), &Found)| {
            let near = mean(cells.about(cell).map(|near| found[near].light));
            looks.variance / (light + near).powi(2)
        };
        let error = mean(cells.all().zip(&found).map(error));
        if error <= WORTH || error.is_nan() {
            return None;
        }
        let polished =
            cells.all().map(|cell| cells.about(cell).any(|near| found[near].is_polished)).collect();
        Some(Self { polished, cells })
    }

    /// Light of a pixel in a pass: what its path has seen, and more looks.
    ///
    /// - `eye`: without photons.
    pub(super) fn look_again(
        &self,
        seen: Seen,
        eye: &Eye<'_>,
        (view, pixel, pass): (&View, (u32, u32), u32),
        stats: &mut Stats,
    ) -> Spectrum {
        if !self.polished[self.cells.index_at(pixel)] {
            return seen.all();
        }
        let settings = RenderSettings { seed: eye.settings.seed ^ LOOKS_SEED, ..*eye.settings };
        let more = LOOKS - 1;
        let others = (0..more)
            .map(|i| look(eye, view, &settings, (pixel, pass.wrapping_mul(more).wrapping_add(i)), stats));
        let glints = others.fold(seen.glints, |sum, glints| sum + glints);
        seen.light + glints * (1.0 / LOOKS as f32)
    }
}

/// What first looks at a cell tell.
struct Found {
    /// Of a look at a pixel.
    variance: f32,
    light: f32,
    is_polished: bool,
}

impl Cells {
    fn of(view: &View) -> Self {
        let side = view.width.max(view.height).div_ceil(CELLS).max(1);
        Self { columns: view.width.div_ceil(side), rows: view.height.div_ceil(side), side }
    }

    fn count(self) -> u32 {
        self.columns * self.rows
    }

    fn cell(self, index: u32) -> (u32, u32) {
        (index % self.columns, index / self.columns)
    }

    fn all(self) -> impl Iterator<Item = (u32, u32)> {
        (0..self.count()).map(move |index| self.cell(index))
    }

    fn index_at(self, (x, y): (u32, u32)) -> usize {
        (y / self.side * self.columns + x / self.side) as usize
    }

    /// Indices of a cell and those beside it.
    fn about(self, (x, y): (u32, u32)) -> impl Iterator<Item = usize> {
        let near = |at: u32, count: u32| at.saturating_sub(1)..count.min(at + 2);
        let columns = near(x, self.columns);
        near(y, self.rows).flat_map(move |y| columns.clone().map(move |x| (y * self.columns + x) as usize))
    }

    /// Looks at some pixels of a cell, along its diagonal.
    fn look_at(self, (x, y): (u32, u32), eye: &Eye<'_>, view: &View) -> (Found, Stats) {
        let settings = RenderSettings { seed: eye.settings.seed ^ FIRST_SEED, ..*eye.settings };
        let (mut found, mut stats) =
            (Found { variance: 0.0, light: 0.0, is_polished: false }, Stats::default());
        for at in 0..FIRST_PIXELS {
            let along = (2 * at + 1) * self.side / (2 * FIRST_PIXELS);
            let pixel = (x * self.side + along, y * self.side + along);
            let before = stats.rays;
            let [a, b] = [2 * at, 2 * at + 1]
                .map(|number| look(eye, view, &settings, (pixel, number), &mut stats).mean(eye.world.lanes));
            // Where nothing is polished, looks end with the two rays of the camera.
            if stats.rays - before > 2 {
                found.is_polished = true;
                if a.is_finite() && b.is_finite() {
                    found.variance += 0.5 * (a - b) * (a - b) / FIRST_PIXELS as f32;
                    found.light += 0.5 * (a + b) / FIRST_PIXELS as f32;
                }
            }
        }
        (found, stats)
    }
}

fn mean(values: impl Iterator<Item = f32>) -> f32 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
    if count > 0.0 { sum / count } else { 0.0 }
}

/// Looks at a pixel once.
fn look(
    eye: &Eye<'_>,
    view: &View,
    settings: &RenderSettings,
    (pixel, number): ((u32, u32), u32),
    stats: &mut Stats,
) -> Spectrum {
    let mut sampler = Sampler::new(settings.sampler, settings.seed, pixel, number);
    let Some((ray, set)) = ray_through(eye.world, view, pixel, &mut sampler) else { return Spectrum::ZERO };
    eye.glints(ray, set, &mut Draws { sampler: &mut sampler, stats, tally: Tally::default() })
}

#[cfg(test)]
mod tests;
