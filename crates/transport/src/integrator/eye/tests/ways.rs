//! The ways to make one path, and what each should count.

use super::by_hand::{End, Ray, Shape, Turn, spread};
use hyaline_math::DVec3;

/// The light that a path ends at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lamp {
    /// Where the photon started, and where to.
    pub(super) start: Ray,
    /// What rays from the eye end at.
    pub(super) end: End,
    /// Whether no path hits it.
    pub(super) is_delta: bool,
    /// Chances that it is chosen, for photons and for shadow rays.
    pub(super) chances: [f64; 2],
    /// Densities of the photon's start and direction, m⁻² (1 for points) and sr⁻¹ (1 for parallel light).
    pub(super) emission: [f64; 2],
    /// Density of a shadow ray's end, m⁻² on surfaces and sr⁻¹ at infinity; 1 where there is but one.
    pub(super) direct: f64,
}

/// The vertex at which photons are merged.
#[derive(Clone, Copy, Debug)]
pub(super) struct Receiver {
    pub(super) p: DVec3,
    /// What photons cross there; in a medium the plane across their way.
    pub(super) shape: Shape,
    /// Unit, to where the light comes from.
    pub(super) to_light: DVec3,
    /// Density of that direction for the path, sr⁻¹.
    pub(super) pdf: f64,
    /// Photons gathered for a density of 1 m⁻².
    pub(super) gathered: f64,
}

/// A path from a receiver to a light, its vertices in a photon's order.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    pub(super) lamp: Lamp,
    pub(super) turns: Vec<Turn>,
    pub(super) receiver: Receiver,
}

/// What hitting the light, sampling it and merging count.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shares {
    pub(super) hit: f64,
    pub(super) sample: f64,
    pub(super) merge: f64,
}

impl Chain {
    /// Shares by the power heuristic among the densities of the three ways.
    pub(super) fn shares(&self) -> Shares {
        let [hit, sample, merge] = [self.hitting(), self.sampling(), self.merging()].map(|d| d * d);
        let sum = hit + sample + merge;
        Shares { hit: hit / sum, sample: sample / sum, merge: merge / sum }
    }

    /// Indices of the rough vertices.
    fn rough(&self) -> Vec<usize> {
        (0..self.turns.len()).filter(|&i| self.turns[i].alpha.is_some()).collect()
    }

    /// Density of the rough vertices and of the place on the light, by directions drawn from the receiver on.
    fn hitting(&self) -> f64 {
        if self.lamp.is_delta { 0.0 } else { self.eye_to_rough() * self.last_leg() }
    }

    /// The same, the place on the light drawn for the last rough vertex, where nothing lies between.
    fn sampling(&self) -> f64 {
        if self.turns[0].alpha.is_none() {
            return 0.0;
        }
        self.eye_to_rough() * self.lamp.chances[1] * self.lamp.direct
    }

    /// Density of the rough vertices, drawn from the receiver on.
    fn eye_to_rough(&self) -> f64 {
        let mut density = 1.0;
        let mut nearer = self.turns.len();
        for &i in self.rough().iter().rev() {
            density *= self.leg_to_light(nearer, i + 1, End::Surface(self.turns[i].shape));
            nearer = i;
        }
        density
    }

    /// Density of the end of the last leg, from the rough vertex nearest to the light (or the receiver).
    fn last_leg(&self) -> f64 {
        let from = self.rough().first().copied().unwrap_or(self.turns.len());
        self.leg_to_light(from, 0, self.lamp.end)
    }

    /// Density of the place that is reached from vertex `from` (the receiver where it is beyond all) over the polished
    /// vertices down to `to`.
    fn leg_to_light(&self, from: usize, to: usize, end: End) -> f64 {
        let (ray, pdf) = match self.turns.get(from) {
            None => (Ray { origin: self.receiver.p, direction: self.receiver.to_light }, self.receiver.pdf),
            Some(turn) => (Ray { origin: turn.p, direction: turn.to_light }, turn.reversed().pdf()),
        };
        let polished: Vec<Turn> = self.turns[to..from].iter().rev().map(|turn| turn.reversed()).collect();
        pdf * chances(&polished) / spread(ray, false, &polished, end)
    }

    /// The same of a photon that is merged at the receiver.
    fn merging(&self) -> f64 {
        let rough = self.rough();
        let ends: Vec<usize> = rough.iter().copied().chain([self.turns.len()]).collect();
        let Lamp { start, chances: [chance, _], emission: [position, direction], .. } = self.lamp;
        let is_parallel = matches!(self.lamp.end, End::Infinity);
        let first = &self.turns[..ends[0]];
        let mut density = chance * position * direction * chances(first)
            / spread(start, is_parallel, first, self.end_of(ends[0]));
        for pair in ends.windows(2) {
            let (from, polished) = (self.turns[pair[0]], &self.turns[pair[0] + 1..pair[1]]);
            let ray = Ray { origin: from.p, direction: from.to_receiver };
            density *= from.pdf() * chances(polished) / spread(ray, false, polished, self.end_of(pair[1]));
        }
        density * self.receiver.gathered
    }

    /// Where a photon ends that goes to vertex `i`, the receiver where that is beyond all.
    fn end_of(&self, i: usize) -> End {
        End::Surface(self.turns.get(i).map_or(self.receiver.shape, |turn| turn.shape))
    }
}

/// Chance that polished surfaces all do what they do.
fn chances(polished: &[Turn]) -> f64 {
    polished.iter().map(Turn::pdf).product()
}
