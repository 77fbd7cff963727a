//! Where light is worth sending: a histogram over the random numbers that photons start from.
//!
//! A photon's light, place and direction are a function of five numbers. Boxes of them from which light has been found are
//! halved again and again, and drawn from more often; so one histogram serves lights of every kind, and nothing has to
//! be known of what they look like. Numbers are warped box by box, which keeps them evenly spread.
//!
//! Sources: Vorba, Karlík, Šik, Ritschel & Křivánek, On-line learning of parametric mixture models for light transport
//! simulation, ACM TOG 33(4), 2014 (guided emission); Guo, Bauszat, Bikker & Eisemann, Primary sample space path guiding,
//! EGSR 2018 (the histogram over random numbers); Clarberg, Jarosz, Akenine-Möller & Jensen, Wavelet importance sampling,
//! ACM TOG 24(3), 2005 (the warp).

use hyaline_math::float::{ONE_MINUS_EPSILON, f64 as float};

/// Numbers that a photon starts from.
pub const START_NUMBERS: usize = 5;

/// Share of the photons that is spread evenly, whatever has been learned: nothing is left out.
const EVEN_SHARE: f64 = 0.5;
/// Found light that a box must hold to be halved, photons.
const LEAST_FOUND: usize = 8;
/// Halvings of a box, at most.
const DEEPEST: u32 = 24;
/// What one photon counts at most, over the mean of all that count: one lucky find is no rule.
const MOST_WORTH: f64 = 8.0;

/// The random numbers of a photon, and what the light that it brought is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// Each in [0, 1).
    pub numbers: [f32; START_NUMBERS],
    /// ≥ 0, for a photon as it was sent: one sent with twice the density brings half the light.
    pub worth: f32,
}

/// A density over the numbers that photons start from; its mean is 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Guide {
    nodes: Vec<Node>,
}

/// A box of numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Node {
    /// Halved along an axis; the children are `children` and the one after.
    Halved { axis: u8, low_share: f32, children: u32 },
    /// Drawn from with this density.
    Whole { density: f32 },
}

impl Default for Guide {
    /// Nothing is known.
    fn default() -> Self {
        Self { nodes: vec![Node::Whole { density: 1.0 }] }
    }
}

impl Guide {
    /// Learns from photons; nothing is known without any that found something, and where light is found nearly everywhere.
    ///
    /// - `least_gain`: density where light is found, on geometric average, from which on photons are guided: those that find
    ///   something have more to do, and below this it does not pay.
    pub fn learn(found: &[Found], least_gain: f64) -> Self {
        let mut all: Vec<Found> = found.iter().copied().filter(|found| found.worth > 0.0).collect();
        let most = MOST_WORTH * sum(&all) / all.len() as f64;
        for found in &mut all {
            found.worth = found.worth.min(most as f32);
        }
        let total = sum(&all);
        if !(total > 0.0 && total.is_finite()) {
            return Self::default();
        }
        let mut guide = Self::default();
        let whole =
            NumberBox { low: [0.0; START_NUMBERS], size: [1.0; START_NUMBERS], share: 1.0, volume: 1.0 };
        guide.halve(0, &mut all, whole, total, 0);
        let logs = all
            .iter()
            .map(|found| f64::from(found.worth) * float::ln(f64::from(guide.density(&found.numbers))));
        let gain = float::exp(logs.sum::<f64>() / total);
        if gain < least_gain { Self::default() } else { guide }
    }

    /// Turns evenly spread numbers into those that a photon starts from; returns the density there as well.
    pub fn warp(&self, mut numbers: [f32; START_NUMBERS]) -> ([f32; START_NUMBERS], f32) {
        let (mut low, mut size) = ([0.0; START_NUMBERS], [1.0; START_NUMBERS]);
        let mut node = 0;
        loop {
            match self.nodes[node] {
                Node::Whole { density } => {
                    let at = std::array::from_fn(|i| (low[i] + size[i] * numbers[i]).min(ONE_MINUS_EPSILON));
                    return (at, density);
                }
                Node::Halved { axis, low_share, children } => {
                    let axis = usize::from(axis);
                    size[axis] *= 0.5;
                    let u = &mut numbers[axis];
                    let is_low = *u < low_share;
                    *u = if is_low { *u / low_share } else { (*u - low_share) / (1.0 - low_share) };
                    *u = u.min(ONE_MINUS_EPSILON);
                    if !is_low {
                        low[axis] += size[axis];
                    }
                    node = children as usize + usize::from(!is_low);
                }
            }
        }
    }

    /// Density at some numbers.
    pub fn density(&self, numbers: &[f32; START_NUMBERS]) -> f32 {
        let mut within = *numbers;
        let mut node = 0;
        loop {
            match self.nodes[node] {
                Node::Whole { density } => return density,
                Node::Halved { axis, children, .. } => {
                    let u = &mut within[usize::from(axis)];
                    let is_low = *u < 0.5;
                    *u = 2.0 * *u - if is_low { 0.0 } else { 1.0 };
                    node = children as usize + usize::from(!is_low);
                }
            }
        }
    }

    /// - `all`: what was found in the box; it is put in another order.
    fn halve(&mut self, node: usize, all: &mut [Found], whole: NumberBox, total: f64, depth: u32) {
        let density = whole.share / whole.volume;
        self.nodes[node] = Node::Whole { density: density as f32 };
        if all.len() < LEAST_FOUND || depth >= DEEPEST {
            return;
        }
        let worth = sum(all);
        let middle: [f32; START_NUMBERS] =
            std::array::from_fn(|axis| whole.low[axis] + 0.5 * whole.size[axis]);
        let mut low_worth = [0.0; START_NUMBERS];
        for found in all.iter() {
            for axis in (0..START_NUMBERS).filter(|&axis| found.numbers[axis] < middle[axis]) {
                low_worth[axis] += f64::from(found.worth);
            }
        }
        // The axis along which the halves differ most.
        let contrast = low_worth.map(|low| (low - 0.5 * worth).abs());
        let axis = (1..START_NUMBERS)
            .fold(0, |best, axis| if contrast[axis] > contrast[best] { axis } else { best });
        let learned = low_worth[axis];
        let even = 0.5 * EVEN_SHARE * whole.volume;
        let shares =
            [learned, worth - learned].map(|worth| even + (1.0 - EVEN_SHARE) * worth.max(0.0) / total);
        let children = self.nodes.len() as u32;
        let low_share = (shares[0] / (shares[0] + shares[1])) as f32;
        self.nodes[node] = Node::Halved { axis: axis as u8, low_share, children };
        self.nodes.extend([Node::Whole { density: 1.0 }; 2]);
        let is_low = |found: &Found| found.numbers[axis] < middle[axis];
        all.sort_by_key(|found| !is_low(found));
        let split = all.partition_point(is_low);
        let (low, high) = all.split_at_mut(split);
        // By the share as it is rounded, so that numbers are drawn with just the density that is told.
        let share = f64::from(low_share);
        for (i, (part, share)) in [(low, share), (high, 1.0 - share)].into_iter().enumerate() {
            let mut half = whole;
            half.size[axis] *= 0.5;
            if i == 1 {
                half.low[axis] += half.size[axis];
            }
            (half.share, half.volume) = (whole.share * share, 0.5 * whole.volume);
            self.halve(children as usize + i, part, half, total, depth + 1);
        }
    }
}

/// A box of numbers while a guide is learned.
#[derive(Clone, Copy)]
struct NumberBox {
    low: [f32; START_NUMBERS],
    size: [f32; START_NUMBERS],
    /// Share of the photons that start there.
    share: f64,
    volume: f64,
}

fn sum(all: &[Found]) -> f64 {
    all.iter().map(|found| f64::from(found.worth)).sum()
}

#[cfg(test)]
mod tests;
