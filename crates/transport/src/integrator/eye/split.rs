//! Both ways at the first polished surfaces: a path from the camera is split there, in place of going one way by chance.
//!
//! What glass mirrors is faint but for lamps: one path in 25 would see them, 25 times as bright, and every highlight would
//! be a speckle. Split paths see them all, each by its share. Of the places where the parts leave polished surfaces one is
//! chosen, by what its part carries, and the path goes on from there alone: behind polished surfaces it costs what it did.

use super::{Draws, Eye, Path, Seen};
use crate::walk::{Event, Flown};
use hyaline_film::PixelSample;
use hyaline_scattering::{Branch, BsdfSample};
use hyaline_spectrum::Spectrum;
use smallvec::SmallVec;

/// Parts that wait to be followed, at most: where more are asked for, chance decides.
const MOST_WAITING: usize = 8;
/// What each part of a split path carries at least, of what the whole path started with.
const FAINTEST: f32 = 0.015;
/// Chance of a place that sends nothing on, over that of a white one.
const LEAST_ALBEDO: f32 = 0.02;

/// A part that has come to where it scatters.
pub(super) struct Arrived {
    pub(super) path: Path,
    pub(super) at: Flown,
}

impl Eye<'_> {
    /// Follows a path, and all parts that it is split into, to where they scatter.
    ///
    /// Returns what is seen on the way, and the part that goes on, if one does; what that has seen is among it.
    pub(super) fn over_polished(
        &self,
        path: Path,
        draws: &mut Draws<'_>,
        first: &mut Option<&mut PixelSample>,
    ) -> (Seen, Option<Arrived>) {
        let mut seen = Seen::default();
        let mut chosen = Chosen::default();
        let mut waiting = SmallVec::<[Path; MOST_WAITING]>::new();
        let mut next = Some(path);
        while let Some(mut path) = next {
            let mut at = self.walk(&mut path, draws);
            let goes_on = self.arrive(&mut path, &mut at, first);
            seen.add(std::mem::take(&mut path.seen));
            let is_polished = matches!(&at, Flown::Arrived(Event::Surface(v)) if v.bsdf.is_delta());
            next = if !goes_on {
                waiting.pop()
            } else if is_polished {
                let part = self.split(&mut path, &at, waiting.len());
                let goes_on = part.is_some() || self.scatter(&mut path, &at, draws);
                waiting.extend(part);
                if goes_on { Some(path) } else { waiting.pop() }
            } else {
                let carried = self.carried(&path) * self.albedo(&at).max(LEAST_ALBEDO);
                chosen.offer(Arrived { path, at }, carried, draws);
                waiting.pop()
            };
        }
        (seen, chosen.take())
    }

    /// Splits a path at a polished surface, if it is to be split there: the path goes the stronger way.
    ///
    /// Returns the part that goes the other way.
    fn split(&self, path: &mut Path, at: &Flown, waiting: usize) -> Option<Path> {
        let Flown::Arrived(Event::Surface(vertex)) = at else { return None };
        if waiting >= MOST_WAITING {
            return None;
        }
        let [Some(first), Some(second)] = vertex.bsdf.branches(-path.ray.direction) else { return None };
        let share = |branch: &Branch| share(branch.weight, branch.eta_scale, self.world.lanes);
        let (strong, faint) = if share(&first) >= share(&second) { (first, second) } else { (second, first) };
        if self.carried(path) * share(&faint) < FAINTEST {
            return None;
        }
        let mut part = path.clone();
        self.turn(&mut part, vertex, &taken(&faint));
        self.turn(path, vertex, &taken(&strong));
        Some(part)
    }

    /// What is left of what the path started with, without the n² factors.
    fn carried(&self, path: &Path) -> f32 {
        path.throughput.max_lane(self.world.lanes) / path.index_scale
    }

    /// Roughly the part of light that is scattered where the path is.
    fn albedo(&self, at: &Flown) -> f32 {
        match at {
            Flown::Arrived(Event::Surface(vertex)) => {
                vertex.bsdf.albedo_estimate().max_lane(self.world.lanes)
            }
            Flown::Arrived(Event::Sky { .. }) => 0.0,
            Flown::Scattered(place) => place.weight.max_lane(self.world.lanes),
        }
    }
}

/// One of several parts, each chosen with a probability in proportion to what it carries.
#[derive(Default)]
struct Chosen {
    arrived: Option<Arrived>,
    carried: f32,
    total: f32,
}

impl Chosen {
    fn offer(&mut self, arrived: Arrived, carried: f32, draws: &mut Draws<'_>) {
        if carried == 0.0 {
            return;
        }
        self.total += carried;
        let is_first = self.arrived.is_none();
        if is_first || draws.sampler.next_1d() * self.total < carried {
            (self.arrived, self.carried) = (Some(arrived), carried);
        }
    }

    /// The choice, with the weight of those that were not chosen.
    fn take(self) -> Option<Arrived> {
        let mut arrived = self.arrived?;
        arrived.path.throughput *= self.total / self.carried;
        Some(arrived)
    }
}

/// What a polished surface sends one way, of the light that comes to it.
///
/// - `weight`: of the way if it is taken for certain.
pub(super) fn share(weight: Spectrum, eta_scale: f32, lanes: usize) -> f32 {
    weight.max_lane(lanes) / eta_scale
}

/// A branch that is taken for certain.
pub(super) fn taken(branch: &Branch) -> BsdfSample {
    let Branch { wi, weight, transmits, eta_scale } = *branch;
    BsdfSample { wi, weight, pdf: 1.0, is_delta: true, transmits, eta_scale }
}
