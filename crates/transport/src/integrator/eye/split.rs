//! Both ways at the first polished surfaces: a path from the camera is split there, in place of going one way by chance.
//!
//! What glass mirrors is faint but for lamps: one path in 25 would see them, 25 times as bright, and every highlight would
//! be a speckle. Split paths see them all, each by its share. Of the places where the parts leave polished surfaces one is
//! chosen, by what its part carries, and the path goes on from there alone: behind polished surfaces it costs what it did.
//!
//! Where no photons bring the caustics, these are noisier than highlights, and more paths do more for both than many parts do:
//! of the faint parts of a path one is drawn, by what it carries, and stands for all.

use super::{Draws, Eye, Path, Seen};
use crate::walk::{Event, Flown, Vertex};
use hyaline_film::PixelSample;
use hyaline_scattering::{Branch, BsdfSample};
use hyaline_spectrum::Spectrum;
use smallvec::SmallVec;

/// Parts that wait to be followed, at most: where more are asked for, chance decides.
const MOST_WAITING: usize = 8;
/// Parts that are drawn one after the other, at most: then, too.
const MOST_DRAWN: u32 = 8;
/// What each part of a split path carries at least, of what the whole path started with, where all parts are followed.
const FAINTEST: f32 = 0.015;
/// The same where one of them is drawn: those that are not cost nothing.
const FAINTEST_DRAWN: f32 = 0.005;
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
        // Places where the parts leave polished surfaces, and faint parts of which one is followed.
        let mut left = Choice::new(draws.sampler.next_1d());
        let mut drawn = Choice::new(draws.sampler.next_1d());
        let mut waiting = SmallVec::<[Path; MOST_WAITING]>::new();
        let mut rounds = 0;
        let mut next = Some(path);
        while let Some(mut path) = next {
            let mut at = self.walk(&mut path, draws);
            let goes_on = self.arrive(&mut path, &mut at, first);
            seen.add(std::mem::take(&mut path.seen));
            let polished = match &at {
                Flown::Arrived(Event::Surface(vertex)) if vertex.bsdf.is_delta() => Some(vertex),
                _ => None,
            };
            next = if !goes_on {
                None
            } else if let Some(vertex) = polished {
                let may_split = waiting.len() < MOST_WAITING && rounds < MOST_DRAWN;
                match self.ways(&path, vertex).filter(|_| may_split) {
                    Some([strong, faint]) => {
                        let part = || {
                            let mut part = path.clone();
                            self.turn(&mut part, vertex, &taken(&faint));
                            part
                        };
                        match self.follows_one() {
                            true => drawn.offer(self.carried(&path) * self.share(&faint), part),
                            false => waiting.push(part()),
                        }
                        self.turn(&mut path, vertex, &taken(&strong));
                        Some(path)
                    }
                    None => self.scatter(&mut path, &at, draws).then_some(path),
                }
            } else {
                let carried = self.carried(&path) * self.albedo(&at).max(LEAST_ALBEDO);
                left.offer(carried, || Arrived { path, at });
                None
            };
            next = next.or_else(|| waiting.pop()).or_else(|| {
                rounds += 1;
                let (part, weight) = drawn.take()?;
                Some(part.weighted(weight))
            });
        }
        let goes_on =
            left.take().map(|(Arrived { path, at }, weight)| Arrived { path: path.weighted(weight), at });
        (seen, goes_on)
    }

    /// Whether of the faint parts of a path one is followed, and not all.
    fn follows_one(&self) -> bool {
        self.aim.is_some()
    }

    /// The stronger way and the fainter one at a polished surface, if the path is to go both.
    fn ways(&self, path: &Path, vertex: &Vertex) -> Option<[Branch; 2]> {
        let [Some(first), Some(second)] = vertex.bsdf.branches(-path.ray.direction) else { return None };
        let [strong, faint] =
            if self.share(&first) >= self.share(&second) { [first, second] } else { [second, first] };
        let faintest = if self.follows_one() { FAINTEST_DRAWN } else { FAINTEST };
        (self.carried(path) * self.share(&faint) >= faintest).then_some([strong, faint])
    }

    fn share(&self, branch: &Branch) -> f32 {
        share(branch.weight, branch.eta_scale, self.world.lanes)
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

impl Path {
    fn weighted(mut self, weight: f32) -> Self {
        self.throughput *= weight;
        self
    }
}

/// One of several things, each chosen with a probability in proportion to what it carries.
struct Choice<T> {
    chosen: Option<T>,
    carried: f32,
    total: f32,
    /// Uniform in 0…1, whatever has been chosen: one number is enough for all, and those of the sampler that follow mean the
    /// same for all paths of a pixel.
    u: f32,
}

impl<T> Choice<T> {
    fn new(u: f32) -> Self {
        Self { chosen: None, carried: 0.0, total: 0.0, u }
    }

    /// Chooses among what was offered before and this; `thing` is made only if it is chosen.
    fn offer(&mut self, carried: f32, thing: impl FnOnce() -> T) {
        if carried == 0.0 {
            return;
        }
        self.total += carried;
        let chance = carried / self.total;
        if self.u < chance {
            (self.chosen, self.carried, self.u) = (Some(thing()), carried, self.u / chance);
        } else {
            self.u = (self.u - chance) / (1.0 - chance);
        }
    }

    /// What was chosen, and its weight, with which it stands for all; there is no choice then.
    fn take(&mut self) -> Option<(T, f32)> {
        let chosen = self.chosen.take()?;
        Some((chosen, std::mem::take(&mut self.total) / self.carried))
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
