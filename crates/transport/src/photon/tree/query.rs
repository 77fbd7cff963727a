//! How queries descend the tree: the children of a node by one test, nearest first where that matters.

use super::PointTree;
use super::layout::{FAN, PACKET, Packet};
use super::nearest::{Nearest, packet_mut};
use super::region::{Probe, Region};
use super::simd::{Distances, Lanes, Query, prefetch};

/// Most nodes that wait: trees have at most 10 levels, and of each all children but the one being looked at can wait.
const STACK_SIZE: usize = 10 * FAN;

/// Whether a point counts.
pub trait Accept {
    /// Whether all points count, so that none needs to be asked for.
    const TAKES_ALL: bool = false;

    /// Whether point `i` counts.
    fn takes(&self, i: u32) -> bool;
}

impl<F: Fn(u32) -> bool> Accept for F {
    #[inline(always)]
    fn takes(&self, i: u32) -> bool {
        self(i)
    }
}

/// All points count.
#[derive(Clone, Copy, Debug)]
pub struct All;

impl Accept for All {
    const TAKES_ALL: bool = true;

    #[inline(always)]
    fn takes(&self, _: u32) -> bool {
        true
    }
}

impl<T: Copy + Send + Sync> PointTree<T> {
    /// Visits all points of a region, with their indices and squared distances.
    pub fn within(&self, region: &Region, visit: &mut impl FnMut(u32, f32)) {
        self.fold_within(region, (), |(), i, distance2| visit(i, distance2));
    }

    /// Folds all points of a region into a state, by their indices and squared distances: [`Self::within`] where speed
    /// matters, as the state stays in registers.
    pub fn fold_within<S>(&self, region: &Region, initial: S, fold: impl FnMut(S, u32, f32) -> S) -> S {
        match Probe::new(region).filter(|_| !self.is_empty()) {
            Some(probe) => self.level.run(FoldWithin { tree: self, probe, initial, fold }),
            None => initial,
        }
    }

    /// Finds the `k` nearest points of a region among those that count; fewer where there are not as many.
    ///
    /// Of points at one and the same distance it is open which are taken; it depends on the tree and the region alone.
    ///
    /// - `accept`: which points count, by index; or [`All`].
    /// - `found`: memory for the answer, which replaces what was in it.
    pub fn nearest(&self, region: &Region, k: usize, accept: impl Accept, found: &mut Nearest) {
        found.begin(k);
        if let Some(probe) = Probe::new(region).filter(|_| k > 0 && !self.is_empty()) {
            self.level.run(FindNearest { tree: self, probe, accept, found });
        }
    }

    /// Packets of a leaf, and the index of its first point.
    #[inline(always)]
    fn leaf(&self, id: u32) -> (&[Packet], u32) {
        let first = ((id - self.first_leaf) * self.leaf_packets) as usize;
        let end = (first + self.leaf_packets as usize).min(self.packets.len());
        (&self.packets[first..end], (first * PACKET) as u32)
    }
}

/// The bits that are set, from the lowest.
#[inline(always)]
fn set_bits(mut mask: u32) -> impl Iterator<Item = u32> {
    std::iter::from_fn(move || {
        let lane = mask.trailing_zeros();
        (mask != 0).then(|| mask &= mask - 1).map(|()| lane)
    })
}

/// See [`PointTree::fold_within`].
struct FoldWithin<'a, T, S, F> {
    tree: &'a PointTree<T>,
    probe: Probe,
    initial: S,
    fold: F,
}

impl<T: Copy + Send + Sync, S, F: FnMut(S, u32, f32) -> S> Query for FoldWithin<'_, T, S, F> {
    type Output = S;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> S {
        let Self { tree, probe, initial: mut state, mut fold } = self;
        let limit = probe.limit;
        let mut hits = Hits::new();
        let mut stack = [0; STACK_SIZE];
        let mut waiting = 1;
        while waiting > 0 {
            waiting -= 1;
            let id: u32 = stack[waiting];
            let (_, mask) = lanes.box_distances(&probe, &tree.nodes[id as usize], limit);
            let first_child = id * FAN as u32 + 1;
            if first_child < tree.first_leaf {
                for slot in set_bits(mask) {
                    stack[waiting] = first_child + slot;
                    waiting += 1;
                }
                continue;
            }
            for slot in set_bits(mask) {
                prefetch(tree.leaf(first_child + slot).0);
            }
            for slot in set_bits(mask) {
                let (packets, first) = tree.leaf(first_child + slot);
                for (packet, first) in packets.iter().zip((first..).step_by(PACKET)) {
                    let (distances, mask) = lanes.point_distances(&probe, packet, limit);
                    hits.push(lanes, &distances, mask, first);
                    if hits.is_full() {
                        state = hits.drain(state, &mut fold);
                    }
                }
            }
        }
        hits.drain(state, &mut fold)
    }
}

/// Points that wait to be folded: going through many at once costs less than through those of each packet, as a
/// processor guesses the end of a loop wrong each time.
struct Hits {
    distances: [f32; HITS],
    indices: [u32; HITS],
    len: usize,
}

/// Points that can wait.
const HITS: usize = 8 * PACKET;

impl Hits {
    fn new() -> Self {
        Self { distances: [0.0; HITS], indices: [0; HITS], len: 0 }
    }

    /// Adds the points of a packet that are in `mask`; there must be room for all of it.
    #[inline(always)]
    fn push<L: Lanes>(&mut self, lanes: L, distances: &Distances, mask: u32, first: u32) {
        let indices: [u32; PACKET] = std::array::from_fn(|lane| first + lane as u32);
        lanes.compress(&distances.0, mask, packet_mut(&mut self.distances, self.len));
        lanes.compress(&indices, mask, packet_mut(&mut self.indices, self.len));
        self.len += mask.count_ones() as usize;
    }

    /// Whether there is no room for another packet.
    #[inline(always)]
    fn is_full(&self) -> bool {
        self.len > HITS - PACKET
    }

    /// Folds all into a state.
    #[inline(always)]
    fn drain<S>(&mut self, mut state: S, fold: &mut impl FnMut(S, u32, f32) -> S) -> S {
        for (&distance2, &i) in self.distances[..self.len].iter().zip(&self.indices[..self.len]) {
            state = fold(state, i, distance2);
        }
        self.len = 0;
        state
    }
}

/// See [`PointTree::nearest`].
struct FindNearest<'a, T, A> {
    tree: &'a PointTree<T>,
    probe: Probe,
    accept: A,
    found: &'a mut Nearest,
}

impl<T: Copy + Send + Sync, A: Accept> Query for FindNearest<'_, T, A> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let Self { tree, probe, accept, found } = self;
        let mut limit = probe.limit;
        // A squared distance above the node's index: the order of these numbers is that of the distances.
        let mut stack = [0_u64; STACK_SIZE];
        let mut waiting = 1;
        while waiting > 0 {
            waiting -= 1;
            let (distance, id) = (f32::from_bits((stack[waiting] >> 32) as u32), stack[waiting] as u32);
            if distance >= limit {
                continue;
            }
            if id >= tree.first_leaf {
                let (packets, first) = tree.leaf(id);
                for (packet, first) in packets.iter().zip((first..).step_by(PACKET)) {
                    let (distances, mut mask) = lanes.point_distances(&probe, packet, limit);
                    if !A::TAKES_ALL {
                        for lane in set_bits(mask) {
                            mask &= !(u32::from(!accept.takes(first + lane)) << lane);
                        }
                    }
                    found.push(lanes, &distances, mask, first);
                }
                limit = found.tighten(lanes, limit);
                continue;
            }
            let (distances, mask) = lanes.box_distances(&probe, &tree.nodes[id as usize], limit);
            let start = waiting;
            for slot in set_bits(mask) {
                let child = u64::from(id * FAN as u32 + 1 + slot);
                let entry = u64::from(distances[slot as usize].to_bits()) << 32 | child;
                let mut place = waiting;
                while place > start && stack[place - 1] < entry {
                    stack[place] = stack[place - 1];
                    place -= 1;
                }
                stack[place] = entry;
                waiting += 1;
            }
        }
        found.finish(lanes);
    }
}
