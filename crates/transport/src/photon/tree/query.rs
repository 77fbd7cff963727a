//! How queries descend the tree: the children of a node by one test, nearest first where that matters.

use super::PointTree;
use super::layout::{FAN, PACKET, Packet};
use super::nearest::Nearest;
use super::region::{Probe, Region};
use super::simd::{Distances, Lanes, Query, prefetch};

/// Most nodes that wait: trees have at most 10 levels, and of each all children but the one being looked at can wait.
const STACK_SIZE: usize = 10 * FAN;

/// The mask of a packet that is inside as a whole.
const ALL_LANES: u32 = (1 << PACKET) - 1;

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
        if let Some(probe) = Probe::new(region).filter(|_| !self.is_empty()) {
            self.level.run(Within { tree: self, probe, visit });
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

/// See [`PointTree::within`].
struct Within<'a, T, V> {
    tree: &'a PointTree<T>,
    probe: Probe,
    visit: &'a mut V,
}

impl<T: Copy + Send + Sync, V: FnMut(u32, f32)> Query for Within<'_, T, V> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let Self { tree, probe, visit } = self;
        let limit = probe.limit;
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
                    let (Distances(distances), mask) = lanes.point_distances(&probe, packet, limit);
                    if mask == ALL_LANES {
                        // Deep inside a region this is the rule, and needs no search for bits.
                        for (i, distance) in (first..).zip(distances) {
                            visit(i, distance);
                        }
                        continue;
                    }
                    for lane in set_bits(mask) {
                        visit(first + lane, distances[lane as usize]);
                    }
                }
            }
        }
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
