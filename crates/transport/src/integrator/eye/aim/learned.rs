//! Where the light of caustics comes from, place by place, as photons have found it.
//!
//! Photons that have come over polished surfaces are traced once. Those that landed close together are a cell. They left
//! the last polished surface at some points: on the near arm of a ring, on the rim of a glass. They are divided by these
//! points, and the beams through what belongs together are what wide surfaces in the cell aim along, each as often as its
//! photons are bright.
//!
//! All this can only help or waste directions: whatever photons say, a direction counts by its density.
//!
//! Source: Jensen, Importance driven path tracing using the photon map, Eurographics Workshop on Rendering, 1995, where
//! each look-up makes a histogram of its nearest photons.

use super::beam::{Beam, Incidence, Moments};
use crate::RenderSettings;
use crate::integrator::merging::projection_cells;
use crate::photon::{MapKind, PhotonEmitter, PhotonTracer};
use crate::stats::Stats;
use hyaline_math::{Bounds, Ray, Vec3};
use hyaline_scene::ProjectionMaps;
use hyaline_world::{World, mask};
use rayon::prelude::*;
use std::sync::atomic::AtomicBool;

/// Photons that are sent out for each pixel.
const PHOTONS_PER_PIXEL: u32 = 4;
/// Photons that are sent out, at least and at most.
const PHOTONS: [u32; 2] = [1 << 15, 1 << 19];
/// Photons of a cell, at most.
const CELL: usize = 192;
/// Things to aim at from a cell, at most.
const MOST_SOURCES: usize = 12;
/// Photons of a source, at least: fewer do not show how wide it is.
const FEWEST: usize = 6;
/// How far beyond its photons a cell reaches, over its diagonal.
const MARGIN: f32 = 0.25;
/// Cuts of a cluster that are tried along an axis, about.
const CUTS: usize = 32;
/// How far a photon is moved back before the way it came is looked for, over its coordinates.
const STEP: f32 = 1e-5;
/// Chance of asking where hardly any photons have landed.
pub(super) const LEAST_CHANCE: f32 = 0.1;
/// Chance of asking over the irradiance of the cell, as a multiple of that of all cells together.
const EAGERNESS: f32 = 2.0;

/// A photon's last straight way.
#[derive(Clone, Copy, Debug)]
struct Arrival {
    landed: Vec3,
    /// Where it left the last polished surface.
    left: Vec3,
    /// W.
    power: f32,
}

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

#[derive(Clone, Debug)]
struct Cell {
    /// Of its photons, and a little about them.
    reach: Bounds,
    sources: Vec<Source>,
    /// W.
    power: f32,
    /// Of the surface it is on, about; scene units squared.
    area: f32,
    /// Of asking for the light of its sources at all, 0…1.
    chance: f32,
}

impl Learned {
    /// Traces photons, the same for any number of threads.
    pub(super) fn new(
        world: &World,
        pixels: u32,
        settings: &RenderSettings,
        cancel: &AtomicBool,
        stats: &mut Stats,
    ) -> Self {
        let emitter = PhotonEmitter::new(world, ProjectionMaps::Cells, projection_cells(pixels));
        if emitter.fraction() == 0.0 || !world.lights.any_can_be_met() {
            return Self::default();
        }
        let max_bounces = settings.max_depth.map_or(u32::MAX, |limit| limit.saturating_sub(1));
        let (map, seed) = (MapKind::Caustic, settings.seed);
        let tracer = PhotonTracer { world, emitter: &emitter, map, seed, max_bounces };
        let count = pixels.saturating_mul(PHOTONS_PER_PIXEL);
        let photons = tracer.trace(count.clamp(PHOTONS[0], PHOTONS[1]), cancel, stats);
        stats.rays += photons.len() as u64;
        let arrivals = photons.par_iter().filter_map(|photon| {
            let back = -photon.direction;
            let ray = Ray::new(photon.p + back * (STEP * photon.p.abs().max_element()), back);
            let candidate = world.geometry.closest(&ray, mask::PATH)?;
            let left = world.geometry.surface(&ray, &candidate).p;
            Some(Arrival { landed: photon.p, left, power: photon.flux.mean(world.lanes) })
        });
        Self::from_arrivals(arrivals.collect())
    }

    fn from_arrivals(mut arrivals: Vec<Arrival>) -> Self {
        let (mut nodes, mut parts) = (Vec::new(), Vec::new());
        if arrivals.len() >= FEWEST {
            divide(&mut arrivals, &mut nodes, &mut parts);
        }
        let mut cells: Vec<Cell> = parts.into_par_iter().map(Cell::new).collect();
        let [power, area] =
            [|cell: &Cell| cell.power, |cell: &Cell| cell.area].map(|f| cells.iter().map(f).sum::<f32>());
        for cell in &mut cells {
            let brightness = cell.power * area / (cell.area * power);
            // Not a number where all photons are in one place.
            cell.chance = if brightness > 0.0 {
                (EAGERNESS * brightness).clamp(LEAST_CHANCE, 1.0)
            } else {
                LEAST_CHANCE
            };
        }
        Self { nodes, cells }
    }

    /// Whether no photons have landed anywhere.
    pub(super) fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// What to aim at from a place, and the chance with which to ask for it; nothing where no photons landed about it.
    pub(super) fn at(&self, p: Vec3) -> (&[Source], f32) {
        let mut node = 0;
        loop {
            match self.nodes.get(node) {
                Some(&Node::Split { axis, at, high }) => node = if p[axis] < at { node + 1 } else { high },
                Some(&Node::Cell(index)) => {
                    let Cell { reach, sources, chance, .. } = &self.cells[index];
                    let is_near = reach.overlaps(&Bounds { min: p, max: p });
                    return (if is_near { sources } else { &[] }, *chance);
                }
                None => return (&[], 0.0),
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
    fn new(arrivals: &mut [Arrival]) -> Self {
        let bounds = Bounds::from_points(arrivals.iter().map(|arrival| arrival.landed));
        let reach = bounds.expanded(MARGIN * bounds.size().length());
        let power: f32 = arrivals.iter().map(|arrival| arrival.power).sum();
        let sources = clusters(arrivals)
            .into_iter()
            .map(|cluster| Source {
                beam: Beam::through(&cluster.iter().map(Arrival::ray).collect::<Vec<_>>()),
                share: cluster.iter().map(|arrival| arrival.power).sum::<f32>() / power,
            })
            .filter(|source| source.share > 0.0)
            .collect();
        let [x, y, z] = bounds.size().to_array();
        let area = (x * y).max(y * z).max(z * x);
        Self { reach, sources, power, area, chance: 1.0 }
    }
}

/// Divides photons by where they came from, so that beams through them are narrow.
fn clusters(arrivals: &mut [Arrival]) -> Vec<&mut [Arrival]> {
    let first = best_cut(arrivals);
    let mut clusters = vec![(arrivals, first)];
    while clusters.len() < MOST_SOURCES {
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
        let learned = Learned::from_arrivals(arrivals.clone());
        assert!(learned.cells.len() > 20_000 / CELL);
        for Arrival { landed, left, .. } in arrivals {
            let (sources, _) = learned.at(landed);
            let u = (left - landed).normalize();
            let holds =
                |source: &Source| 0.5 * (source.beam.axis(landed) - u).length_squared() <= source.beam.whole;
            assert!(sources.iter().any(holds), "nothing from {left} at {landed}");
        }
    }

    #[test]
    fn sources_are_small_and_share_all_of_the_power() {
        let learned = Learned::from_arrivals(arrivals(20_000));
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
        assert!(Learned::default().at(Vec3::ZERO).0.is_empty());
        assert!(Learned::from_arrivals(arrivals(20_000)).at(Vec3::splat(9.0)).0.is_empty());
        let same = Arrival { landed: Vec3::ONE, left: Vec3::ZERO, power: 1.0 };
        let learned = Learned::from_arrivals(vec![same; 1000]);
        assert_eq!(learned.at(Vec3::ONE).0.len(), 1);
        assert!(Learned::from_arrivals(vec![same; FEWEST - 1]).at(Vec3::ONE).0.is_empty());
    }
}
