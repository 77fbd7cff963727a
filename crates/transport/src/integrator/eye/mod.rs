//! Paths from the eye: what `path` and `merging` trace, the one without and the other with photons about.
//!
//! 1. Walk to the next surface or, in a medium that scatters, to the next particle; what lies between is filtered by the
//!    medium the path is in.
//! 2. If the surface shines, add its light, weighed against the other ways to find it.
//! 3. If the vertex is not singular, gather the photons about it, sample a light, and add what reaches the vertex. Without
//!    photons, ask for light over polished surfaces, too (`aimed`).
//! 4. Go on in a direction drawn from the BSDF or phase function, or toward bright caustics (`onward`). Singular crossings are free: there is no limit on them.
//!    At the first polished surfaces more than one way is gone (`split`).
//! 5. Weak paths end by roulette on their throughput without the n² factor, so none dies for being inside glass.

pub(super) mod aim;
mod aimed;
mod along;
pub(super) mod asking;
mod glints;
mod hit;
pub(super) mod merges;
mod onward;
pub(super) mod place;
pub(super) mod radius;
pub(super) mod reach;
mod split;
mod surface;
pub(super) mod tally;
#[cfg(test)]
mod tests;
pub(super) mod weight;
mod within;

use crate::direct::LastScatter;
use crate::first_hit;
use crate::integrator::RenderSettings;
use crate::integrator::merging::Photons;
use crate::roulette::{PATIENCE_WITH_SHADING_NORMALS, Past, eye_survival, lone_eye_survival};
use crate::stats::Stats;
use crate::walk::{self, Event, Flown, Stretch};
use aim::Aim;
use along::Along;
pub(super) use glints::Seen;
use hyaline_film::PixelSample;
use hyaline_math::Ray;
use hyaline_sampling::Sampler;
use hyaline_scattering::MediumSet;
use hyaline_spectrum::Spectrum;
use hyaline_world::{World, mask};
use merges::Merges;
use split::Arrived;
use tally::Tally;

/// What paths have in common.
pub(super) struct Eye<'a> {
    pub(super) world: &'a World,
    pub(super) settings: &'a RenderSettings,
    /// Where to look for caustics; `None` where photons bring them.
    pub(super) aim: Option<&'a Aim>,
    /// Photons to gather.
    pub(super) photons: Option<Photons<'a>>,
}

/// What a path draws from and counts in.
pub(super) struct Draws<'a> {
    pub(super) sampler: &'a mut Sampler,
    pub(super) stats: &'a mut Stats,
    pub(super) tally: Tally<'a>,
}

/// A path under way.
#[derive(Clone)]
struct Path {
    ray: Ray,
    set: MediumSet,
    throughput: Spectrum,
    /// The n² factors collected so far: radiance inside a medium is larger, but the path is not worth more there.
    index_scale: f32,
    last: LastScatter,
    merges: Merges,
    /// Density of the other way that has led from the last wide vertex to the light, over that of this one: see `aimed`.
    rival: f32,
    /// Which items the next ray sees.
    visible: u8,
    /// Scatterings so far, singular ones not counted.
    bounces: u32,
    /// Those of them in media of objects.
    collisions: u32,
    /// Singular events in a row.
    crossings: u32,
    /// Light found so far.
    seen: Seen,
    /// What the polished surfaces behind send its way, of what comes to them; 0 once it was scattered.
    share: f32,
}

impl Eye<'_> {
    /// One estimate of the radiance that arrives along `ray`, which starts inside `set`.
    ///
    /// - `first`: receives what the first surface looks like.
    pub(super) fn radiance(
        &self,
        ray: Ray,
        set: MediumSet,
        draws: &mut Draws<'_>,
        mut first: Option<&mut PixelSample>,
    ) -> Seen {
        let seen = self.estimate(self.start(ray, set), draws, &mut first);
        draws.stats.merges += std::mem::take(&mut draws.tally.merges);
        seen
    }

    /// Whether more than one way is gone at polished surfaces.
    pub(super) fn splits(&self) -> bool {
        self.settings.techniques.splitting && self.world.lights.any_can_be_met()
    }

    fn estimate(&self, path: Path, draws: &mut Draws<'_>, first: &mut Option<&mut PixelSample>) -> Seen {
        if !self.splits() {
            return self.follow(path, draws, first);
        }
        let (mut seen, arrived) = self.over_polished(path, draws, first);
        let Some(Arrived { mut path, at }) = arrived else { return seen };
        seen.add(match self.scatter(&mut path, &at, draws) {
            true => self.follow(path, draws, first),
            false => path.seen,
        });
        seen
    }

    /// Follows a path to its end.
    fn follow(&self, mut path: Path, draws: &mut Draws<'_>, first: &mut Option<&mut PixelSample>) -> Seen {
        loop {
            let mut at = self.walk(&mut path, draws);
            if !self.arrive(&mut path, &mut at, first) || !self.scatter(&mut path, &at, draws) {
                return path.seen;
            }
        }
    }

    /// Adds the light that the path has come to; returns whether there is something that may scatter it.
    fn arrive(&self, path: &mut Path, at: &mut Flown, first: &mut Option<&mut PixelSample>) -> bool {
        match at {
            Flown::Arrived(Event::Sky { transmittance }) => {
                path.find(path.throughput * *transmittance * self.sky(path));
                return false;
            }
            Flown::Arrived(Event::Surface(vertex)) => {
                if path.crossings > PATIENCE_WITH_SHADING_NORMALS {
                    vertex.bsdf = vertex.bsdf.without_shading_normal();
                }
                path.throughput *= vertex.transmittance;
                if let Some(sample) = first.take() {
                    first_hit::record(sample, vertex, &path.ray);
                }
                path.find(path.throughput * self.emitted(path, vertex));
            }
            Flown::Scattered(_) => *first = None,
        }
        true
    }

    /// Gathers, samples a light and scatters, on a surface or in a medium; returns whether the path goes on.
    fn scatter(&self, path: &mut Path, at: &Flown, draws: &mut Draws<'_>) -> bool {
        match at {
            Flown::Arrived(Event::Sky { .. }) => false,
            Flown::Arrived(Event::Surface(vertex)) => self.at_surface(path, vertex, draws),
            Flown::Scattered(place) => self.at_place(path, place, draws),
        }
    }

    fn start(&self, ray: Ray, set: MediumSet) -> Path {
        Path {
            ray,
            set,
            throughput: Spectrum::ONE,
            index_scale: 1.0,
            last: LastScatter::default(),
            merges: Merges::default(),
            rival: 0.0,
            visible: mask::CAMERA,
            bounces: 0,
            collisions: 0,
            crossings: 0,
            seen: Seen::default(),
            share: 1.0,
        }
    }

    /// To the next vertex. Where no medium does more than dim, nothing is drawn for it.
    fn walk(&self, path: &mut Path, draws: &mut Draws<'_>) -> Flown {
        let bounces_left = self.bounces_left(path);
        let chance = if path.bounces == 0 { 1.0 } else { along::CHANCE_AFTER_BOUNCES };
        let gathers = self.photons.is_some()
            && self.world.has_volumes
            && bounces_left > 0
            && (path.bounces == 0 || draws.sampler.next_1d() < chance);
        let Path { ray, set, visible, throughput, merges, bounces, .. } = path;
        let bounces = *bounces;
        if !self.world.has_volumes {
            return walk::advance_flown(self.world, ray, *visible, set, draws.stats);
        }
        let along = self.photons.as_ref().filter(|_| gathers).map(|photons| Along {
            photons,
            world: self.world,
            throughput: *throughput,
            merges: *merges,
            bounces,
            bounces_left,
        });
        let (mut gathered, mut rays) = (Spectrum::ZERO, 0);
        let Draws { sampler, stats, tally } = draws;
        let carried = *throughput * (1.0 / chance);
        let watch = |stretch: &Stretch<'_>| {
            gathered += along.as_ref().map_or(Spectrum::ZERO, |along| {
                along.gather(stretch, &mut rays, |photon, light| tally.note(photon, carried * light))
            });
        };
        let (flown, emitted) =
            walk::fly_watched(self.world, ray, *visible, set, *throughput, sampler, stats, watch);
        draws.stats.rays += rays;
        path.seen.light += path.throughput * emitted + carried * gathered;
        flown
    }

    /// Whether the path may scatter once more and still be counted.
    fn may_bounce(&self, path: &Path) -> bool {
        self.settings.max_depth.is_none_or(|limit| path.bounces < limit)
    }

    /// Bounces that photons merged at the next vertex may have made, and one more.
    fn bounces_left(&self, path: &Path) -> u32 {
        self.settings.max_depth.map_or(u32::MAX, |limit| limit.saturating_sub(path.bounces))
    }

    /// Roulette, once a path has scattered; returns whether it goes on.
    fn survives(&self, path: &mut Path, draws: &mut Draws<'_>) -> bool {
        let roulette = draws.sampler.next_1d();
        let weight = path.throughput.max_lane(self.world.lanes) / path.index_scale;
        let survival_of = if self.photons.is_some() { eye_survival } else { lone_eye_survival };
        let Path { bounces, collisions, crossings, .. } = *path;
        let survival = survival_of(weight, Past { bounces, collisions, crossings });
        if self.settings.max_depth.is_some_and(|limit| path.bounces > limit) || roulette >= survival {
            return false;
        }
        path.throughput *= 1.0 / survival;
        true
    }
}
