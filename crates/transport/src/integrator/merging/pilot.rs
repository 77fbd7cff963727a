//! Before the first pass: small pictures of the scene tell where photons are worth sending, and whether broad ones pay.
//!
//! 1. Lessons: paths of a coarse picture merge photons, and the `guide` of each sender learns from which numbers those
//!    had started that brought light. The second lesson is guided by the first.
//! 2. A trial: the same picture with broad photons and without, twice each. What has the smaller error for the same work
//!    is done in all passes. Work is counted, not timed, so that the same scene gives the same picture everywhere.
//!
//! All that grows with the pixel, such as the radius, is as in a picture of this size, so that what is learned holds for
//! any other. Seeds are other ones than those of the picture, which must know nothing of what was learned from.

use super::landed::PhotonId;
use super::light::{Light, sampler_of};
use super::sender::{Sender, Senders};
use super::{Photons, RenderSettings, View};
use crate::integrator::eye::aim::Aim;
use crate::integrator::eye::radius::GatherRadius;
use crate::integrator::eye::tally::{Merged, Tally};
use crate::integrator::eye::{Draws, Eye};
use crate::photon::emission::start_numbers;
use crate::photon::guide::{Found, Guide};
use crate::photon::radius::Shrink;
use crate::stats::Stats;
use hyaline_math::Vec2;
use hyaline_sampling::Sampler;
use hyaline_spectrum::Spectrum;
use hyaline_world::World;
use rayon::prelude::*;

/// Pixels of a small picture, about.
const PIXELS: u32 = 4096;
/// Passes that are learned from; more where few photons find anything.
const LESSONS: u32 = 2;
const MOST_LESSONS: u32 = 8;
/// Gain of density from which on photons are guided.
const LEAST_GAIN: f64 = 8.0;
/// Photons that have found something, with which learning may end.
const ENOUGH: usize = 64;
/// What a pixel counts as at least, over the mean of the picture: errors in the dark are seen less.
const DARK: f32 = 0.1;
/// What the squared relative error of a pixel counts at most.
const WORST: f64 = 1000.0;
/// Photons that are looked at in the time of a ray.
const MERGES_PER_RAY: f64 = 8.0;
/// Turns the seed of the picture into that of small ones.
const OTHER_SEED: u64 = 0x7069_6c6f_7473_2121;

/// Teaches the senders of a picture, and decides on the broad one. Returns the mean light of the picture, roughly.
pub(super) fn teach(
    world: &World,
    view: &View,
    settings: &RenderSettings,
    senders: &mut Senders<'_>,
    stats: &mut Stats,
) -> f32 {
    let (pixels, scale) = (view.width * view.height, coarseness(view));
    let size = [view.width, view.height].map(|side| (side as f32 / scale).ceil().max(1.0) as u32);
    let settings = RenderSettings { seed: settings.seed ^ OTHER_SEED, ..*settings };
    let mut pilot = Pilot { world, view, settings, size, scale, light: None, stats };
    let coarse_pixels = size[0] * size[1];
    let techniques = settings.techniques;
    senders.send(coarse_pixels, techniques.broad);
    let mut known = [Vec::new(), Vec::new()];
    let mut lesson = 0;
    while techniques.guiding
        && (lesson < LESSONS || lesson < MOST_LESSONS && is_hard_to_find(senders, &known))
    {
        pilot.learn(senders, lesson, &mut known);
        lesson += 1;
    }
    // In media that scatter it is broad photons that show shafts of light, and paths find those so rarely that a trial would
    // be won by those who miss them.
    let broad = techniques.broad
        && (world.has_volumes || senders.broad.count == 0 || {
            let with = pilot.trial(senders);
            senders.send(coarse_pixels, false);
            !pilot.trial(senders).is_better_than(&with)
        });
    let light = pilot.light.unwrap_or_else(|| mean(&pilot.take(senders, 0).light));
    senders.send(pixels, broad);
    light
}

/// Whether too few photons have found something to learn from.
fn is_hard_to_find(senders: &Senders<'_>, known: &[Vec<Found>; 2]) -> bool {
    let senders = [&senders.aimed, &senders.broad];
    senders.iter().zip(known).any(|(sender, found)| sender.count > 0 && found.len() < ENOUGH)
}

/// Pixels of the picture along the side of one of a small picture.
fn coarseness(view: &View) -> f32 {
    ((view.width * view.height) as f32 / PIXELS as f32).sqrt().max(1.0)
}

struct Pilot<'a> {
    world: &'a World,
    view: &'a View,
    settings: RenderSettings,
    /// Of a small picture, pixels.
    size: [u32; 2],
    scale: f32,
    /// Mean light of the last picture taken.
    light: Option<f32>,
    stats: &'a mut Stats,
}

/// A pass of a small picture.
struct Picture {
    /// Row by row.
    light: Vec<f32>,
    /// Photons that each pixel has merged.
    found: Vec<Vec<Merged>>,
    /// In rays.
    work: f64,
}

impl Pilot<'_> {
    /// Learns from one more pass.
    ///
    /// - `known`: what has been found so far by photons of the aimed and of the broad sender.
    fn learn(&mut self, senders: &mut Senders<'_>, pass: u32, known: &mut [Vec<Found>; 2]) {
        let picture = self.take(senders, pass);
        let dark = DARK * mean(&picture.light);
        let mut worth = [&senders.aimed, &senders.broad].map(|sender| vec![0.0; sender.count as usize]);
        for (&light, found) in picture.light.iter().zip(&picture.found) {
            for Merged { photon, light: brought } in found {
                let brought = brought.mean(self.world.lanes) / light.max(dark);
                worth[of(*photon)][photon.number() as usize] +=
                    if brought.is_finite() { brought } else { 0.0 };
            }
        }
        for ((sender, worth), known) in
            [&mut senders.aimed, &mut senders.broad].into_iter().zip(worth).zip(known)
        {
            known.extend(self.lessons(sender, pass, &worth));
            sender.guide = Guide::learn(known, LEAST_GAIN);
        }
    }

    /// The numbers that photons started from which were worth something.
    fn lessons(&self, sender: &Sender<'_>, pass: u32, worth: &[f32]) -> Vec<Found> {
        let worthy = (0..).zip(worth).filter(|(_, worth)| **worth > 0.0);
        worthy
            .map(|(number, &worth)| {
                let mut sampler = sampler_of(&self.settings, sender, pass, number);
                Found { numbers: sender.guide.warp(start_numbers(&mut sampler)).0, worth }
            })
            .collect()
    }

    fn trial(&mut self, senders: &Senders<'_>) -> Trial {
        let [a, b] = [MOST_LESSONS, MOST_LESSONS + 1].map(|pass| self.take(senders, pass));
        Trial { work: a.work + b.work, light: [a.light, b.light] }
    }

    /// Takes a small picture.
    fn take(&mut self, senders: &Senders<'_>, pass: u32) -> Picture {
        let Self { world, view, settings, .. } = &*self;
        let radius = GatherRadius::new(&world.cameras[view.camera], Shrink::of_pass(0)).widened(self.scale);
        let mut stats = Stats::default();
        let landed = Light { world, senders, settings, radius }.trace(pass, &mut stats);
        let aim = (!senders.any()).then(|| Aim::new(world));
        let photons = senders.any().then_some(Photons { senders, landed: &landed, radius });
        let eye = Eye { world, settings, aim: aim.as_ref(), photons };
        let rows: Vec<_> = (0..self.size[1]).into_par_iter().map(|y| self.row(&eye, y, pass)).collect();
        let mut picture = Picture { light: Vec::new(), found: Vec::new(), work: 0.0 };
        for (light, found, row) in rows {
            picture.light.extend(light);
            picture.found.extend(found);
            stats.add(&row);
        }
        picture.work = stats.rays as f64 + stats.merges as f64 / MERGES_PER_RAY;
        self.stats.add(&stats);
        self.light = Some(mean(&picture.light));
        picture
    }

    fn row(&self, eye: &Eye<'_>, y: u32, pass: u32) -> (Vec<f32>, Vec<Vec<Merged>>, Stats) {
        let (mut light, mut all, mut stats) = (Vec::new(), Vec::new(), Stats::default());
        for x in 0..self.size[0] {
            let mut sampler = Sampler::new(self.settings.sampler, self.settings.seed, (x, y), pass);
            let mut found = Vec::new();
            let at = (Vec2::new(x as f32, y as f32) + sampler.next_2d())
                / Vec2::new(self.size[0] as f32, self.size[1] as f32);
            let lens = sampler.next_2d();
            let ray = self.world.cameras[self.view.camera]
                .ray(at * Vec2::new(self.view.width as f32, self.view.height as f32), lens);
            let seen = ray.map_or(Spectrum::ZERO, |ray| {
                let set = self.world.camera_media[self.view.camera].clone();
                let tally = Tally { found: Some(&mut found), ..Tally::default() };
                let mut draws = Draws { sampler: &mut sampler, stats: &mut stats, tally };
                eye.radiance(ray, set, &mut draws, None).all()
            });
            let seen = seen.mean(self.world.lanes);
            light.push(if seen.is_finite() { seen } else { 0.0 });
            all.push(found);
        }
        (light, all, stats)
    }
}

/// Two passes of the same picture.
struct Trial {
    light: [Vec<f32>; 2],
    work: f64,
}

impl Trial {
    /// Whether the error for the same work is smaller than with broad photons.
    fn is_better_than(&self, with: &Self) -> bool {
        // Only with them the picture is known well enough to say what is bright.
        let bright: Vec<f32> = with.light[0].iter().zip(&with.light[1]).map(|(a, b)| 0.5 * (a + b)).collect();
        let dark = DARK * mean(&bright);
        let error = |trial: &Self| -> f64 {
            let pixel = |i: usize| {
                let off = f64::from(trial.light[0][i] - trial.light[1][i]) / f64::from(bright[i].max(dark));
                (off * off).min(WORST)
            };
            (0..bright.len()).map(pixel).sum()
        };
        error(self) * self.work < error(with) * with.work
    }
}

/// Index of the sender of a photon.
fn of(photon: PhotonId) -> usize {
    usize::from(!photon.is_aimed())
}

fn mean(light: &[f32]) -> f32 {
    light.iter().sum::<f32>() / light.len().max(1) as f32
}

#[cfg(test)]
mod tests;
