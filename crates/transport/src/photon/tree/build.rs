//! Building the tree: points are ordered by splits at medians, then boxes are made from the leaves up.
//!
//! Threads share the work by ranges of points that depend on their number alone, so that the order never depends on
//! who is how fast.

use super::PointTree;
use super::layout::{FAN, Node, PACKET, Packet};
use super::simd::VerifiedLevel;
use hyaline_geometry::bvh::{SimdLevel, with_capacity_in_large_pages};
use hyaline_math::{Bounds, Vec3};
use rayon::prelude::*;

/// Ranges with fewer points are not worth another thread.
const SHARED_SIZE: usize = 4096;

/// See [`PointTree::build`].
pub(super) fn build<T: Copy + Send + Sync>(mut points: Vec<(Vec3, T)>, leaf_size: u32) -> PointTree<T> {
    points.retain(|(p, _)| p.is_finite());
    assert!(u32::try_from(points.len()).is_ok(), "a tree holds at most 2^32 - 1 points");
    let leaf_size = leaf_size.clamp(PACKET as u32, 1024).next_power_of_two() as usize;
    order(&mut points, leaf_size);
    let packets =
        in_large_pages(points.par_chunks(PACKET).map(|chunk| Packet::new(chunk.iter().map(|(p, _)| *p))));
    let payloads = in_large_pages(points.into_par_iter().map(|(_, payload)| payload));
    let leaf_packets = leaf_size / PACKET;
    let levels = build_levels(&packets, leaf_packets);
    let bounds = levels.last().map_or(Bounds::EMPTY, |top| top[0].bounds());
    let (nodes, first_leaf) = join_levels(levels);
    let level = VerifiedLevel::new(SimdLevel::detect());
    PointTree { packets, payloads, nodes, first_leaf, leaf_packets: leaf_packets as u32, bounds, level }
}

/// Collects in memory that queries find their way in quickly.
fn in_large_pages<T: Send>(values: impl IndexedParallelIterator<Item = T>) -> Vec<T> {
    let mut list = with_capacity_in_large_pages(values.len());
    values.collect_into_vec(&mut list);
    list
}

/// Orders points so that leaves, and all nodes above them, are ranges.
fn order<T: Copy + Send>(points: &mut [(Vec3, T)], leaf_size: usize) {
    if points.len() <= leaf_size {
        return;
    }
    let bounds = Bounds::from_points(points.iter().map(|(p, _)| *p));
    let axis = longest_axis(bounds);
    let middle = split_position(points.len(), leaf_size);
    let (low, _, high) = points.select_nth_unstable_by(middle, |a, b| a.0[axis].total_cmp(&b.0[axis]));
    let low_size = low.len();
    let is_shared = low_size + high.len() + 1 > SHARED_SIZE;
    let (low, high) = points.split_at_mut(low_size);
    if is_shared {
        rayon::join(|| order(low, leaf_size), || order(high, leaf_size));
    } else {
        order(low, leaf_size);
        order(high, leaf_size);
    }
}

fn longest_axis(bounds: Bounds) -> usize {
    let size = bounds.size();
    if size.x >= size.y && size.x >= size.z {
        0
    } else if size.y >= size.z {
        1
    } else {
        2
    }
}

/// How many of the points go to the left: half of the children that they fill, which are full but for the last one.
fn split_position(point_count: usize, leaf_size: usize) -> usize {
    let mut child_size = leaf_size;
    while child_size * FAN < point_count {
        child_size *= FAN;
    }
    point_count.div_ceil(child_size) / 2 * child_size
}

/// Nodes by level, from those above the leaves up to the root.
fn build_levels(packets: &[Packet], leaf_packets: usize) -> Vec<Vec<Node>> {
    let mut levels = Vec::new();
    if packets.is_empty() {
        return levels;
    }
    let leaf_bounds =
        |leaf: &[Packet]| leaf.iter().fold(Bounds::EMPTY, |bounds, packet| bounds.union(packet.bounds()));
    let lowest = packets.par_chunks(leaf_packets * FAN);
    let mut level: Vec<Node> =
        lowest.map(|leaves| Node::new(leaves.chunks(leaf_packets).map(leaf_bounds))).collect();
    while level.len() > 1 {
        let above = level.par_chunks(FAN).map(|nodes| Node::new(nodes.iter().map(Node::bounds))).collect();
        levels.push(std::mem::replace(&mut level, above));
    }
    levels.push(level);
    levels
}

/// One array of all levels, the root first, and the index at which leaves would begin.
fn join_levels(levels: Vec<Vec<Node>>) -> (Vec<Node>, u32) {
    let above_lowest = (1..levels.len()).fold(0, |first, _| first * FAN + 1);
    let lowest = levels.first().map_or(0, Vec::len);
    let mut nodes: Vec<Node> = with_capacity_in_large_pages(above_lowest + lowest);
    // Level d begins after all that could be above it: at (8^d - 1) / 7.
    let mut first = 0;
    for level in levels.into_iter().rev() {
        nodes.resize(first, Node::EMPTY);
        nodes.extend(level);
        first = first * FAN + 1;
    }
    (nodes, first as u32)
}
