//! The ways to make one path, and what each should count.

use super::by_hand::{End, Finish, Ray, Turn, spread};
use std::f64::consts::PI;

/// The light that a path ends at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lamp {
    /// Where the photon started, and where to.
    pub(super) start: Ray,
    /// What rays from the eye end at.
    pub(super) end: End,
    /// Whether no path hits it.
    pub(super) is_delta: bool,
    /// Photons of a pass that take such ways.
    pub(super) photons: f64,
    /// Lamps that there are.
    pub(super) lamps: usize,
    /// Chances that it is chosen, for photons and for shadow rays.
    pub(super) chances: [f64; 2],
    /// Densities of the photon's start and direction, m⁻² (1 for points) and sr⁻¹ (1 for parallel light).
    pub(super) emission: [f64; 2],
    /// Density of a shadow ray's end, m⁻² on surfaces and sr⁻¹ at infinity; 1 where there is but one.
    pub(super) direct: f64,
}

/// A path from a light to the eye, its vertices in a photon's order: the eye sees the last one, which is not polished.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    pub(super) lamp: Lamp,
    pub(super) turns: Vec<Turn>,
    /// Gather radius at each, for photons that have not been scattered widely, scene units.
    pub(super) radii: Vec<f64>,
    /// Extinction coefficient of the fog, 1 / scene unit.
    pub(super) sigma: f64,
}

/// What hitting the light, sampling it and merging at each vertex count.
#[derive(Clone, Debug)]
pub(super) struct Shares {
    pub(super) hit: f64,
    pub(super) sample: f64,
    pub(super) merges: Vec<f64>,
}

impl Shares {
    /// All of them.
    pub(super) fn all(&self) -> impl Iterator<Item = f64> {
        [self.hit, self.sample].into_iter().chain(self.merges.iter().copied())
    }
}

/// How much farther photons are gathered from on surfaces that have been scattered widely.
const INDIRECT: f64 = 2.0;
/// Share of the photons that leave beams.
const BEAMS: f64 = 1.0 / 64.0;

impl Chain {
    /// Shares by the power heuristic among the densities of all ways.
    ///
    /// What fog lets through is left out of all: it is the same on all ways but for those that draw no distance.
    pub(super) fn shares(&self) -> Shares {
        let merges: Vec<f64> = (0..self.turns.len()).map(|i| self.merging(i).powi(2)).collect();
        let [hit, sample] = [self.hitting(), self.sampling()].map(|density| density * density);
        let sum = hit + sample + merges.iter().sum::<f64>();
        let merges = merges.iter().map(|square| square / sum).collect();
        Shares { hit: hit / sum, sample: sample / sum, merges }
    }

    /// Whether it grazes no surface: there the rounding of a direction to f32 moves the path too far to be compared.
    pub(super) fn is_steady(&self) -> bool {
        self.turns.iter().all(|turn| turn.cos() > 0.05)
    }

    /// Density of all vertices and of the place on the light, by directions drawn from the eye on.
    fn hitting(&self) -> f64 {
        if self.lamp.is_delta {
            return 0.0;
        }
        let nearest = self.turns.iter().position(Turn::is_drawn).expect("the last one is drawn");
        self.eye_density(nearest) * self.leg_to_light(nearest, 0, self.lamp.end)
    }

    /// The same, the place on the light drawn for the vertex next to it.
    fn sampling(&self) -> f64 {
        if !self.turns[0].is_drawn() {
            return 0.0;
        }
        let is_first = self.turns[1..].iter().all(|turn| !turn.is_drawn());
        let [_, chance] = self.lamp.chances;
        let asked = match self.lamp.lamps {
            _ if !is_first => chance,
            // Where it scatters first, a path asks all of a few lamps, else four times by chance.
            ..=4 => 1.0,
            _ => 4.0 * chance,
        };
        self.eye_density(0) * asked * self.lamp.direct
    }

    /// Density of a path from the eye to vertex `i`, times the photons of a pass that come there and are gathered.
    fn merging(&self, i: usize) -> f64 {
        let turn = self.turns[i];
        let is_indirect = self.turns[..i].iter().any(Turn::is_wide);
        let gathered = match turn.finish {
            Finish::Polished => 0.0,
            // A beam is found wherever the eye's ray passes it, not where a distance has been drawn.
            Finish::Fog(_) => {
                let sin = turn.to_light.cross(turn.to_receiver).length();
                BEAMS * 2.0 * self.radii[i] * sin / self.sigma
            }
            // What comes straight from the light is left to shadow rays.
            Finish::Ground(_) | Finish::Matte | Finish::Smoke(_) if i == 0 => 0.0,
            // Photons that stop in a ball.
            Finish::Smoke(_) => 4.0 / 3.0 * PI * self.radii[i].powi(3) * self.sigma,
            Finish::Ground(_) | Finish::Matte => {
                let radius = self.radii[i] * if is_indirect { INDIRECT } else { 1.0 };
                PI * radius * radius
            }
        };
        if gathered == 0.0 {
            return 0.0;
        }
        self.eye_density(i) * self.light_density(i) * gathered
    }

    /// Density of the vertices that are drawn, from the last one down to `i`.
    fn eye_density(&self, i: usize) -> f64 {
        let mut nearer = self.turns.len() - 1;
        let mut density = self.distance(nearer);
        for j in (i..nearer).rev().filter(|&j| self.turns[j].is_drawn()) {
            let turn = &self.turns[j];
            density *= self.leg_to_light(nearer, j + 1, turn.end(turn.to_receiver)) * self.distance(j);
            nearer = j;
        }
        density
    }

    /// Photons of a pass about each unit of the vertices up to `i`; at `i` itself per area, in fog across their way.
    fn light_density(&self, i: usize) -> f64 {
        let ends: Vec<usize> = (0..=i).filter(|&j| self.turns[j].is_drawn()).collect();
        let end = |j: usize| self.turns[j].end(self.turns[j].to_light);
        let Lamp { start, photons, chances: [chance, _], emission: [position, direction], .. } = self.lamp;
        let is_parallel = matches!(self.lamp.end, End::Infinity);
        let first = &self.turns[..ends[0]];
        let mut density = photons * chance * position * direction * chances(first)
            / spread(start, is_parallel, first, end(ends[0]));
        for pair in ends.windows(2) {
            let (from, polished) = (self.turns[pair[0]], &self.turns[pair[0] + 1..pair[1]]);
            let ray = Ray { origin: from.p, direction: from.to_receiver };
            density *= self.distance(pair[0]) * from.pdf() * chances(polished)
                / spread(ray, false, polished, end(pair[1]));
        }
        density
    }

    /// Density of the place along the way: in fog that of stopping there, but for what gets there.
    fn distance(&self, i: usize) -> f64 {
        if matches!(self.turns[i].finish, Finish::Fog(_) | Finish::Smoke(_)) { self.sigma } else { 1.0 }
    }

    /// Density of the place that is reached from vertex `from` over the polished vertices down to `to`.
    fn leg_to_light(&self, from: usize, to: usize, end: End) -> f64 {
        let turn = self.turns[from];
        let ray = Ray { origin: turn.p, direction: turn.to_light };
        let polished: Vec<Turn> = self.turns[to..from].iter().rev().map(|turn| turn.reversed()).collect();
        turn.reversed().pdf() * chances(&polished) / spread(ray, false, &polished, end)
    }
}

/// Chance that polished surfaces all do what they do.
fn chances(polished: &[Turn]) -> f64 {
    polished.iter().map(Turn::pdf).product()
}
