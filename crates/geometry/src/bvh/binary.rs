//! The binary tree that wide trees are made of.
//!
//! obvhs builds it over boxes moved and scaled to the unit cube, so that areas neither overflow nor vanish whatever
//! the scene's unit is. Only its shape is kept; the boxes are put together anew from the primitives, exactly. The
//! result does not depend on the number of threads: each sort has a total order.
//!
//! Source: Meister and Bittner, Parallel Locally-Ordered Clustering for BVH Construction, TVCG 24(3), 2018;
//! Parallel Reinsertion for BVH Optimization, Computer Graphics Forum 37(2), 2018.

use hyaline_math::{Bounds, Vec3};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};
use rayon::prelude::*;

/// A node of a binary tree in depth-first order: the left child of an inner node follows it.
#[derive(Clone, Copy, Debug)]
pub(super) struct BinaryNode {
    pub(super) bounds: Bounds,
    /// Primitives below.
    pub(super) count: u32,
    /// The right child of an inner node, the primitive of a leaf.
    pub(super) link: u32,
}

impl BinaryNode {
    pub(super) fn is_leaf(&self) -> bool {
        self.count == 1
    }
}

/// Share of the nodes that each round of reinsertion tries to move; the largest boxes matter most. Twice the work
/// saves rays 2 % of their steps.
const REINSERTION_ROUNDS: [f32; 3] = [0.2, 0.1, 0.05];

/// A tree deeper than this is given up; obvhs searches with a stack of fixed size.
const MAX_BINARY_DEPTH: usize = 160;

/// The tree that obvhs builds, unless it is too deep.
pub(super) fn optimized(boxes: &[Bounds]) -> Option<Vec<BinaryNode>> {
    let aabbs = normalized(boxes);
    let indices = (0..boxes.len() as u32).collect();
    let mut bvh = PlocBuilder::with_capacity(boxes.len()).build(
        PlocSearchDistance::Low,
        &aabbs,
        indices,
        SortPrecision::U64,
        2,
    );
    let mut optimizer = ReinsertionOptimizer::default();
    for share in REINSERTION_ROUNDS {
        if boxes.len() < 4 || depth_exceeds(&bvh, MAX_BINARY_DEPTH) {
            break;
        }
        bvh.init_parents_if_uninit();
        let candidates = largest_nodes(&bvh, share);
        optimizer.run_with_candidates(&mut bvh, &candidates, 1);
    }
    flatten(&bvh, boxes)
}

/// The boxes in the cube of edge 1 about the origin.
fn normalized(boxes: &[Bounds]) -> Vec<Aabb> {
    let all = boxes.iter().fold(Bounds::EMPTY, |all, b| all.union(*b));
    let (low, high) = (all.min.as_dvec3(), all.max.as_dvec3());
    let center = 0.5 * (low + high);
    let size = (high - low).max_element();
    let scale = if size > 0.0 { size.recip() } else { 0.0 };
    // Only the shape of the tree depends on this, so a coordinate that is not a number may be anywhere.
    let inside = |x: f64| if x.is_nan() { 0.0 } else { x.clamp(-1.0, 1.0) };
    let map = |p: Vec3| ((p.as_dvec3() - center) * scale).map(inside).as_vec3a();
    boxes.par_iter().map(|b| Aabb::new(map(b.min), map(b.max))).collect()
}

/// Indices of the largest among the first nodes, largest first; obvhs leaves the upper nodes in front.
fn largest_nodes(bvh: &Bvh2, share: f32) -> Vec<u32> {
    let count = ((bvh.nodes.len() as f32 * share) as usize).clamp(1, bvh.nodes.len() - 1);
    let looked_at = (2 * count).min(bvh.nodes.len() - 1);
    let mut keys: Vec<u64> = (1..=looked_at)
        .map(|i| u64::from(!bvh.nodes[i].aabb().half_area().to_bits()) << 32 | i as u64)
        .collect();
    keys.par_sort_unstable();
    keys.truncate(count);
    keys.into_iter().map(|key| key as u32).collect()
}

/// Whether some node has more than `limit` nodes above it.
fn depth_exceeds(bvh: &Bvh2, limit: usize) -> bool {
    let mut pending = vec![(0, 0)];
    while let Some((node, depth)) = pending.pop() {
        let node: &obvhs::bvh2::node::Bvh2Node = &bvh.nodes[node as usize];
        if depth > limit {
            return true;
        }
        if !node.is_leaf() {
            pending.extend([(node.first_index, depth + 1), (node.first_index + 1, depth + 1)]);
        }
    }
    false
}

/// The nodes in depth-first order, with exact boxes; `None` where some node has more than `MAX_BINARY_DEPTH` above it.
fn flatten(bvh: &Bvh2, boxes: &[Bounds]) -> Option<Vec<BinaryNode>> {
    let mut nodes = Vec::with_capacity(bvh.nodes.len());
    // Each entry is a node, its depth, and the parent whose right child it is, if it is one.
    let mut pending = vec![(0_u32, 0, None::<usize>)];
    while let Some((index, depth, parent)) = pending.pop() {
        if depth > MAX_BINARY_DEPTH {
            return None;
        }
        if let Some(parent) = parent {
            let here = nodes.len() as u32;
            let parent: &mut BinaryNode = &mut nodes[parent];
            parent.link = here;
        }
        let node = &bvh.nodes[index as usize];
        if node.is_leaf() {
            let primitive = bvh.primitive_indices[node.first_index as usize];
            nodes.push(BinaryNode { bounds: boxes[primitive as usize], count: 1, link: primitive });
        } else {
            pending.push((node.first_index + 1, depth + 1, Some(nodes.len())));
            pending.push((node.first_index, depth + 1, None));
            nodes.push(BinaryNode { bounds: Bounds::EMPTY, count: 0, link: 0 });
        }
    }
    refit(&mut nodes);
    Some(nodes)
}

/// Boxes and counts of the inner nodes, from the leaves up.
fn refit(nodes: &mut [BinaryNode]) {
    for i in (0..nodes.len()).rev() {
        if !nodes[i].is_leaf() {
            let (left, right) = (nodes[i + 1], nodes[nodes[i].link as usize]);
            nodes[i].bounds = left.bounds.union(right.bounds);
            nodes[i].count = left.count + right.count;
        }
    }
}

/// A tree as shallow as can be: the primitives are halved along the longest axis of their centers.
pub(super) fn halved(boxes: &[Bounds]) -> Vec<BinaryNode> {
    let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
    let mut nodes = Vec::with_capacity(2 * boxes.len());
    let mut pending = vec![(0, order.len(), None::<usize>)];
    while let Some((start, end, parent)) = pending.pop() {
        if let Some(parent) = parent {
            let here = nodes.len() as u32;
            let parent: &mut BinaryNode = &mut nodes[parent];
            parent.link = here;
        }
        if end - start == 1 {
            let primitive = order[start];
            nodes.push(BinaryNode { bounds: boxes[primitive as usize], count: 1, link: primitive });
            continue;
        }
        let part = &mut order[start..end];
        let center = |i: u32| boxes[i as usize].center();
        let axis = longest_axis(Bounds::from_points(part.iter().map(|&i| center(i))).size());
        let half = part.len() / 2;
        part.select_nth_unstable_by(half, |&a, &b| {
            center(a)[axis].total_cmp(&center(b)[axis]).then(a.cmp(&b))
        });
        pending.push((start + half, end, Some(nodes.len())));
        pending.push((start, start + half, None));
        nodes.push(BinaryNode { bounds: Bounds::EMPTY, count: 0, link: 0 });
    }
    refit(&mut nodes);
    nodes
}

fn longest_axis(size: Vec3) -> usize {
    match (size.x >= size.y, size.x >= size.z, size.y >= size.z) {
        (true, true, _) => 0,
        (false, _, true) => 1,
        _ => 2,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(nodes: &[BinaryNode], boxes: &[Bounds]) {
        assert_eq!(nodes.len(), 2 * boxes.len() - 1);
        assert_eq!(nodes[0].count as usize, boxes.len());
        let mut seen = vec![false; boxes.len()];
        for node in nodes.iter().filter(|n| n.is_leaf()) {
            assert!(!std::mem::replace(&mut seen[node.link as usize], true));
        }
    }

    #[test]
    fn both_builders_hold_each_primitive_once() {
        for count in [1, 2, 3, 5, 100] {
            let boxes: Vec<Bounds> = (0..count)
                .map(|i| {
                    let p = Vec3::new(i as f32, (i * 7 % 11) as f32, (i * 5 % 13) as f32);
                    Bounds { min: p, max: p + Vec3::ONE }
                })
                .collect();
            check(&optimized(&boxes).unwrap(), &boxes);
            check(&halved(&boxes), &boxes);
        }
    }

    #[test]
    fn coincident_boxes_are_halved_evenly() {
        let boxes = vec![Bounds { min: Vec3::ZERO, max: Vec3::ONE }; 64];
        let nodes = halved(&boxes);
        check(&nodes, &boxes);
        assert_eq!(nodes[1].count, 32);
    }
}
