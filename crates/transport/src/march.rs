//! Rays of the eye that march: where media scatter, stops are made on the way to the next surface, at which light is asked
//! for.

use crate::RenderSettings;
use crate::stats::Stats;
use crate::walk::{self, Between, Event, Flown};
use hyaline_math::{Ray, Vec3};
use hyaline_sampling::{Rng, Sampler};
use hyaline_scattering::volume::{self, Marcher, Step};
use hyaline_scattering::{Medium, MediumId, MediumSet};
use hyaline_scene::MarchStep;
use hyaline_spectrum::Spectrum;
use hyaline_world::World;

/// A place in a medium where light is asked for.
#[derive(Clone, Copy, Debug)]
pub struct Stop {
    /// Where.
    pub p: Vec3,
    /// The medium.
    pub medium: MediumId,
    /// Factor on the light that a unit of path scatters back along the ray, scene units.
    pub weight: Spectrum,
    /// Scattering coefficient there, 1 / scene unit.
    pub sigma_s: Spectrum,
    /// Which of the sets holds there.
    set: usize,
}

/// What a ray found on its way. One is used for many rays, to save allocations.
#[derive(Debug, Default)]
pub struct Found {
    /// Light that media send out by themselves, as it arrives at the ray's origin.
    pub emitted: Spectrum,
    stops: Vec<Stop>,
    sets: Vec<MediumSet>,
}

impl Found {
    /// The stops, in order, and what each is in.
    pub fn stops(&self) -> impl Iterator<Item = (&Stop, &MediumSet)> {
        self.stops.iter().map(|stop| (stop, &self.sets[stop.set]))
    }

    /// Marches along `ray` to the next surface that does something; `set` is kept true on the way.
    ///
    /// - `visible`: mask of the items that the ray sees.
    /// - `throughput`: what the path carries; lanes that carry much decide where stops are made.
    pub fn march(
        &mut self,
        world: &World,
        settings: &RenderSettings,
        (ray, visible): (&Ray, u8),
        set: &mut MediumSet,
        throughput: Spectrum,
        sampler: &mut Sampler,
        stats: &mut Stats,
    ) -> Event {
        self.emitted = Spectrum::ZERO;
        self.stops.clear();
        self.sets.clear();
        let u = sampler.next_2d();
        let rng = Rng::new(u64::from(u.x.to_bits()) << 32 | u64::from(u.y.to_bits()), 0);
        let step = match settings.march {
            MarchStep::Adaptive { stations } => Step::Adaptive { stations },
            MarchStep::Fixed { length } => Step::Fixed { length: length as f32 },
        };
        let mut marching = Marching { step, throughput, lanes: world.lanes, rng, found: self };
        match walk::walk(world, ray, visible, set, &mut marching, stats) {
            Flown::Arrived(event) => event,
            Flown::Scattered(_) => unreachable!("a march passes what scatters"),
        }
    }
}

/// Media are marched through.
struct Marching<'a> {
    step: Step,
    throughput: Spectrum,
    lanes: usize,
    rng: Rng,
    found: &'a mut Found,
}

impl Between for Marching<'_> {
    fn pass(
        &mut self,
        set: &MediumSet,
        medium: &Medium,
        ray: &Ray,
        distance: f32,
        left: &mut Spectrum,
    ) -> Option<f32> {
        if !medium.scatters() && !medium.shines() {
            *left *= volume::transmittance(medium, ray, distance);
            return None;
        }
        let Found { emitted, stops, sets } = &mut *self.found;
        let (before, id, index) = (*left, set.active(), sets.len());
        let marcher = Marcher { step: self.step, throughput: self.throughput * before, lanes: self.lanes };
        let marched = marcher.march(medium, ray, distance, &mut self.rng, &mut |station| {
            let weight = before * station.weight;
            let (p, sigma_s) = (ray.at(station.t), station.sigma_s);
            stops.push(Stop { p, medium: id, weight, sigma_s, set: index });
        });
        if stops.last().is_some_and(|stop| stop.set == index) {
            sets.push(set.clone());
        }
        *emitted += before * marched.emitted;
        *left *= marched.transmittance;
        None
    }
}
