//! Where light comes from, place by place, as photons have found it.
//!
//! Photons that landed close together are a cell. They left the last surface at some points: on the near arm of a ring, on the
//! rim of a glass. They are divided by these points, and the beams through what belongs together are what wide surfaces in
//! the cell aim along, each as often as its photons are bright.
//!
//! All this can only help or waste directions: whatever photons say, a direction counts by its density.
//!
//! Source: Jensen, Importance driven path tracing using the photon map, Eurographics Workshop on Rendering, 1995, where
//! each look-up makes a histogram of its nearest photons.

use super::beam::{Beam, Incidence, Moments};
use super::cones::NARROWEST;
use super::lesson::Arrival;
use hyaline_math::{Bounds, Vec3};
use rayon::prelude::*;

/// Photons of a cell, at most.
const CELL: usize = 192;
/// Photons of a source, at least: fewer do not show how wide it is.
const FEWEST: usize = 6;
/// How far beyond its photons a cell reaches, over its diagonal.
const MARGIN: f32 = 0.25;
/// Cuts of a cluster that are tried along an axis, about.
const CUTS: usize = 32;
/// Photons of a cell where other light is measured.
const PROBES: usize = 8;

/// Light that comes to a cell from about one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Source {
    pub(super) beam: Beam,
    /// Of the power that lands in the cell.
    pub(super) share: f32,
}

/// The cells, found by descending a tree.
#[derive(Clone, Debug, Default)]
pub(super) struct Learned {
    /// The first is the root; the low child of a split follows it.
    nodes: Vec<Node>,
    cells: Vec<Cell>,
}

#[derive(Clone, Copy, Debug)]
enum Node {
    /// Places at `at` and beyond are found from the node `high`.
    Split {
        axis: usize,
        at: f32,
        high: usize,
    },
    Cell(usize),
}

/// Photons that landed close together.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    /// Of its photons, and a little about them.
    reach: Bounds,
    pub(super) sources: Vec<Source>,
    /// By its photons, about; W per square scene unit.
    pub(super) irradiance: f32,
    /// That light over the sum of it and of what else is asked for, 0…1.
    pub(super) part: f32,
}

impl Learned {
    /// What photons show.
    ///
    /// - `most_sources`: of a cell, at most.
    /// - `other`: irradiance where a photon has landed by what else is asked for, W per square scene unit: a sample of the given
    ///   number.
    pub(super) fn new(
        mut arrivals: Vec<Arrival>,
        most_sources: usize,
        other: impl Fn(&Arrival, usize) -> f32 + Sync,
    ) -> Self {
        let (mut nodes, mut parts) = (Vec::new(), Vec::new());
        if arrivals.len() >= FEWEST {
            divide(&mut arrivals, &mut nodes, &mut parts);
        }
        let cell = |part: &mut [Arrival]| Cell::new(part, most_sources, &other);
        Self { nodes, cells: parts.into_par_iter().map(cell).collect() }
    }

    /// Keeps the sources that make noise where they are found by chance alone.
    ///
    /// - `least`: variance that a source makes, over the square of the light of the place.
    pub(super) fn noisy(mut self, least: f32) -> Self {
        for Cell { sources, part, .. } in &mut self.cells {
            sources.retain(|Source { beam, share }| {
                // Twice the versine is the chance that a matte surface finds it, if it faces it.
                let light = *part * share;
                light * light > least * 2.0 * beam.core.max(NARROWEST)
            });
        }
        self
    }

    /// Whether no photons have landed anywhere.
    pub(super) fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// What to aim at from a place; `None` where no photons landed about it.
    pub(super) fn at(&self, p: Vec3) -> Option<&Cell> {
        let mut node = 0;
        loop {
            match *self.nodes.get(node)? {
                Node::Split { axis, at, high } => node = if p[axis] < at { node + 1 } else { high },
                Node::Cell(index) => {
                    let cell = &self.cells[index];
                    return cell.reach.overlaps(&Bounds { min: p, max: p }).then_some(cell);
                }
            }
        }
    }
}

/// Halves photons by where they landed, along the axis on which they are farthest apart, until they are few.
fn divide<'a>(arrivals: &'a mut [Arrival], nodes: &mut Vec<Node>, parts: &mut Vec<&'a mut [Arrival]>) {
    let size = Bounds::from_points(arrivals.iter().map(|arrival| arrival.landed)).size();
    if arrivals.len() <= CELL || size.max_element() == 0.0 {
        nodes.push(Node::Cell(parts.len()));
        parts.push(arrivals);
        return;
    }
    let axis = size.max_position();
    arrivals.sort_unstable_by(|a, b| a.landed[axis].total_cmp(&b.landed[axis]));
    let key = |i: usize| arrivals[i].landed[axis];
    // Many may lie in one plane; they stay together.
    let middle = arrivals.len() / 2;
    let below = arrivals.partition_point(|arrival| arrival.landed[axis] < key(middle));
    let cut = if below > 0 {
        below
    } else {
        arrivals.partition_point(|arrival| arrival.landed[axis] <= key(middle))
    };
    let (node, at) = (nodes.len(), key(cut));
    nodes.push(Node::Cell(0));
    let (low, high) = arrivals.split_at_mut(cut);
    divide(low, nodes, parts);
    nodes[node] = Node::Split { axis, at, high: nodes.len() };
    divide(high, nodes, parts);
}

impl Cell {
    fn new(arrivals: &mut [Arrival], most_sources: usize, other: impl Fn(&Arrival, usize) -> f32) -> Self {
        let bounds = Bounds::from_points(arrivals.iter().map(|arrival| arrival.landed));
        let reach = bounds.expanded(MARGIN * bounds.size().length());
        let power: f32 = arrivals.iter().map(|arrival| arrival.power).sum();
        let [x, y, z] = bounds.size().to_array();
        let irradiance = power / (x * y).max(y * z).max(z * x);
        let step = arrivals.len().div_ceil(PROBES);
        let probes = arrivals.iter().step_by(step).enumerate();
        let others =
            probes.map(|(i, arrival)| other(arrival, i)).sum::<f32>() / arrivals.len().div_ceil(step) as f32;
        // Photons in one place are all the light; where there is none of any kind, that is not a number.
        let part = (1.0 / (1.0 + others / irradiance)).max(0.0);
        let sources = clusters(arrivals, most_sources)
            .into_iter()
            .map(|cluster| Source {
                beam: Beam::through(&cluster.iter().map(Arrival::ray).collect::<Vec<_>>()),
                share: cluster.iter().map(|arrival| arrival.power).sum::<f32>() / power,
            })
            .filter(|source| source.share > 0.0)
            .collect();
        Self { reach, sources, irradiance, part }
    }
}

/// Divides photons by where they came from, so that beams through them are narrow.
fn clusters(arrivals: &mut [Arrival], most: usize) -> Vec<&mut [Arrival]> {
    let first = best_cut(arrivals);
    let mut clusters = vec![(arrivals, first)];
    while clusters.len() < most {
        let gains = clusters.iter().enumerate().filter_map(|(i, (_, cut))| Some((i, cut.as_ref()?.gain)));
        let Some((i, _)) = gains.max_by(|a, b| a.1.total_cmp(&b.1)) else { break };
        let (cluster, Some(Cut { axis, at, .. })) = clusters.swap_remove(i) else { break };
        sort_along(cluster, axis);
        let (low, high) = cluster.split_at_mut(at);
        let cuts = [best_cut(low), best_cut(high)];
        clusters.extend([low, high].into_iter().zip(cuts));
    }
    clusters.into_iter().map(|(cluster, _)| cluster).collect()
}

/// A way to divide a cluster.
struct Cut {
    axis: usize,
    at: usize,
    /// How much less the clusters cost.
    gain: f64,
}

/// The best of all cuts that gain anything.
fn best_cut(cluster: &mut [Arrival]) -> Option<Cut> {
    let count = cluster.len();
    let mut best = Cut { axis: 0, at: 0, gain: 0.0 };
    let base = cluster[0].ray();
    let whole = Moments::of(cluster.iter().map(Arrival::ray), &base);
    let whole_cost = whole.cost();
    let step = (count / CUTS).max(1);
    for axis in 0..3 {
        sort_along(cluster, axis);
        let mut low = Moments::ZERO;
        for (at, arrival) in cluster.iter().enumerate() {
            if at >= FEWEST && count - at >= FEWEST && at.is_multiple_of(step) {
                let gain = whole_cost - low.cost() - (whole - low).cost();
                if gain > best.gain {
                    best = Cut { axis, at, gain };
                }
            }
            low = low.including(&arrival.ray(), &base);
        }
    }
    (best.gain > 0.0).then_some(best)
}

fn sort_along(cluster: &mut [Arrival], axis: usize) {
    cluster.sort_unstable_by(|a, b| a.left[axis].total_cmp(&b.left[axis]));
}

impl Arrival {
    fn ray(&self) -> Incidence {
        Incidence { p: self.landed.as_dvec3(), u: (self.left - self.landed).normalize_or_zero().as_dvec3() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hyaline_testkit::Random;

    const MOST_SOURCES: usize = 12;

    fn dark(_: &Arrival, _: usize) -> f32 {
        0.0
    }

    /// Photons on a floor and on a wall, from two lines over them.
    fn arrivals(count: usize) -> Vec<Arrival> {
        let mut random = Random::from_seed(5);
        let mut uniform = || random.uniform_f32();
        let arrival = |i: usize| {
            let (u, v) = (uniform(), uniform());
            let landed = if i.is_multiple_of(3) { Vec3::new(u, v, 0.0) } else { Vec3::new(u, 0.0, v) };
            let left = Vec3::new(u, 1.0 + 0.1 * v, if i.is_multiple_of(2) { 0.0 } else { 1.0 });
            Arrival { landed, left, power: 1.0 }
        };
        (0..count).map(arrival).collect()
    }

    #[test]
    fn every_photon_is_aimed_at_from_where_it_landed() {
        let arrivals = arrivals(20_000);
        let learned = Learned::new(arrivals.clone(), MOST_SOURCES, dark);
        assert!(learned.cells.len() > 20_000 / CELL);
        for Arrival { landed, left, .. } in arrivals {
            let sources = &learned.at(landed).expect("a photon landed here").sources;
            let u = (left - landed).normalize();
            let holds =
                |source: &Source| 0.5 * (source.beam.axis(landed) - u).length_squared() <= source.beam.whole;
            assert!(sources.iter().any(holds), "nothing from {left} at {landed}");
        }
    }

    #[test]
    fn sources_are_small_and_share_all_of_the_power() {
        let learned = Learned::new(arrivals(20_000), MOST_SOURCES, dark);
        for cell in &learned.cells {
            let total: f32 = cell.sources.iter().map(|source| source.share).sum();
            assert!((total - 1.0).abs() < 1e-4 && cell.sources.len() <= MOST_SOURCES);
            // The two lines lie 1 apart: hardly a beam holds light of both.
            let narrow = cell.sources.iter().filter(|source| source.beam.whole < 0.1);
            let power: f32 = narrow.map(|source| source.share).sum();
            assert!(power > 0.8, "{:?}", cell.sources);
        }
    }

    #[test]
    fn places_without_photons_and_equal_photons_are_no_trouble() {
        assert!(Learned::default().at(Vec3::ZERO).is_none());
        assert!(Learned::new(arrivals(20_000), MOST_SOURCES, dark).at(Vec3::splat(9.0)).is_none());
        let same = Arrival { landed: Vec3::ONE, left: Vec3::ZERO, power: 1.0 };
        let learned = Learned::new(vec![same; 1000], MOST_SOURCES, dark);
        assert_eq!(learned.at(Vec3::ONE).map(|cell| cell.sources.len()), Some(1));
        assert!(Learned::new(vec![same; FEWEST - 1], MOST_SOURCES, dark).at(Vec3::ONE).is_none());
    }

    #[test]
    fn what_is_faint_beside_other_light_makes_no_noise() {
        let bright = |_: &Arrival, _: usize| 1e9;
        let [alone, outshone] = [
            Learned::new(arrivals(20_000), MOST_SOURCES, dark),
            Learned::new(arrivals(20_000), MOST_SOURCES, bright),
        ];
        assert!(alone.cells.iter().all(|cell| cell.part == 1.0 && cell.irradiance > 0.0));
        assert!(outshone.cells.iter().all(|cell| cell.part < 1e-3));
        let sources =
            |learned: Learned| learned.noisy(0.02).cells.iter().map(|cell| cell.sources.len()).sum::<usize>();
        let all: usize = alone.cells.iter().map(|cell| cell.sources.len()).sum();
        // Of the beams of two lines most are narrow.
        assert!(sources(alone) > all / 2);
        assert_eq!(sources(outshone), 0);
    }
}
